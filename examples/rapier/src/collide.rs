//! Simulates one collision of two boxes in Rapier, and records it.

use planar_impact::Xy;
use planar_impact::check::{Model, Profile, Record, State, Subject};
use rapier2d_f64::prelude::*;

/// Two boxes on a collision course.
pub struct Pair {
    seed: u64,
    sides: [Side; 2],
    restitution: f64,
    friction: f64,
}

struct Side {
    half: Vector,
    density: f64,
    place: Vector,
    heading: f64,
    velocity: Vector,
    yaw_rate: f64,
}

const STEP: f64 = 1.0 / 960.0;
/// Number of steps that the slowest pair needs to touch and separate.
const STEPS: usize = 2000;

impl Pair {
    /// Draws a pair from a seed; the same seed gives the same pair.
    pub fn draw(seed: u64, restitution: f64, friction: f64) -> Pair {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d;
        let mut between = |low: f64, high: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
        };
        let mut side = |x: f64, towards: f64| Side {
            half: Vector::new(between(1.9, 2.6), between(0.8, 1.0)),
            density: between(120.0, 220.0),
            place: Vector::new(x, between(-0.8, 0.8)),
            heading: between(-3.1, 3.1),
            velocity: Vector::new(towards * between(5.0, 15.0), between(-4.0, 4.0)),
            yaw_rate: between(-0.5, 0.5),
        };
        Pair { seed, sides: [side(-3.5, 1.0), side(3.5, -1.0)], restitution, friction }
    }
}

/// Returns the state of a body for a record.
fn state(body: &RigidBody) -> State {
    State { velocity: Some(Xy { x: body.linvel().x, y: body.linvel().y }), yaw_rate: Some(body.angvel()) }
}

fn center(body: &RigidBody) -> Xy {
    Xy { x: body.center_of_mass().x, y: body.center_of_mass().y }
}

/// Steps until the pair has touched and separated. Returns `None` if they miss each other, or touch at more than one
/// point, which a record of one contact cannot represent.
pub fn collide(pair: &Pair) -> Option<Record> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = STEP;
    let [one, two] = pair.sides.each_ref().map(|side| {
        let body = RigidBodyBuilder::dynamic().translation(side.place).rotation(side.heading).linvel(side.velocity).angvel(side.yaw_rate);
        let collider = ColliderBuilder::cuboid(side.half.x, side.half.y)
            .density(side.density)
            .restitution(pair.restitution)
            .restitution_combine_rule(CoefficientCombineRule::Average)
            .friction(pair.friction);
        world.insert(body.can_sleep(false), collider)
    });
    // Rapier computes the masses in its first step.
    world.step();

    let mut touched: Option<Record> = None;
    for _ in 0..STEPS {
        let before = [one.0, two.0].map(|body| (state(&world.bodies[body]), center(&world.bodies[body])));
        world.step();
        let bodies = [one.0, two.0].map(|body| &world.bodies[body]);
        let after = bodies.map(state);
        let pushed = (0..2).any(|i| after[i] != before[i].0);
        match &mut touched {
            None if pushed => {
                let contact = world.narrow_phase.contact_pair(one.1, two.1)?;
                let (manifold, point) = contact.find_deepest_contact()?;
                let (normal, first) = (manifold.data.normal, world.colliders[contact.collider1].position() * point.local_p1);
                let second = world.colliders[contact.collider2].position() * point.local_p2;
                let subject = |i: usize| Subject {
                    mass: Some(bodies[i].mass()),
                    yaw_inertia: Some(1.0 / bodies[i].mass_properties().local_mprops.inv_principal_inertia),
                    center: Some(before[i].1),
                    before: before[i].0,
                    after: after[i],
                    ..Subject::default()
                };
                touched = Some(Record {
                    id: format!("pair-{}", pair.seed),
                    profile: Profile::Stepper,
                    one: subject(0),
                    two: subject(1),
                    point: Some(Xy { x: (first.x + second.x) / 2.0, y: (first.y + second.y) / 2.0 }),
                    normal_angle: Some(normal.y.atan2(normal.x)),
                    model: Model { restitution: Some(pair.restitution), ..Model::default() },
                    ..Record::default()
                });
            }
            Some(record) if pushed => {
                record.one.after = after[0];
                record.two.after = after[1];
            }
            Some(_) => return touched,
            None => (),
        }
    }
    touched
}
