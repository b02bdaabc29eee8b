//! Symmetries: exchange of the vehicles, direction of the axes, observer, and units.

use crate::rational::Rational;
use crate::strategies::{Draw, computable, config, half_tangent};
use planar_impact::*;
use proptest::prelude::*;

type Exact = Collision<Rational>;

fn int(n: i32) -> Rational {
    Rational::int(n)
}

fn each_vehicle(collision: Exact, f: impl Fn(Vehicle<Rational>) -> Vehicle<Rational>) -> Exact {
    let party = |party| match party {
        Party::Vehicle(vehicle) => Party::Vehicle(f(vehicle)),
        Party::Barrier => Party::Barrier,
    };
    Collision { one: party(collision.one), two: party(collision.two), ..collision }
}

fn mirror(v: Xy<Rational>) -> Xy<Rational> {
    Xy { x: v.x, y: -v.y }
}

/// Returns the mirror image of an impulse ratio.
fn opposite(ratio: ImpulseRatio<Rational>) -> ImpulseRatio<Rational> {
    match ratio {
        ImpulseRatio::Given(ratio) => ImpulseRatio::Given(-ratio),
        other => other,
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_vehicles_may_be_exchanged(draw in computable()) {
        let collision = draw.exact();
        let here = collision.evaluate();
        let there = Collision { one: collision.two.clone(), two: collision.one.clone(), ..collision }.evaluate();
        prop_assert_eq!((here.one, here.two), (there.two, there.one));
        prop_assert_eq!(here.work, there.work);
        prop_assert_eq!(here.impulse, -there.impulse);
    }

    #[test]
    fn the_ground_may_be_turned(draw in computable(), by in half_tangent()) {
        let turned = Heading::from_half_tangent(by.of::<Rational>());
        let rotate = |v: Xy<Rational>| turned.to_ground(ForwardLeft { forward: v.x, left: v.y });
        let collision = draw.exact();
        let here = collision.evaluate();
        let around = each_vehicle(collision.clone(), |vehicle| Vehicle {
            heading: {
                let ahead = rotate(Xy { x: vehicle.heading.cos, y: vehicle.heading.sin });
                Heading { cos: ahead.x, sin: ahead.y }
            },
            motion: Motion { velocity: rotate(vehicle.motion.velocity), yaw_rate: vehicle.motion.yaw_rate },
            ..vehicle
        });
        let normal = rotate(Xy { x: collision.crush_plane.cos.clone(), y: collision.crush_plane.sin.clone() });
        let there = Collision { crush_plane: CrushPlane { cos: normal.x, sin: normal.y }, ..around }.evaluate();
        prop_assert_eq!((&here.impulse, &here.approach, &here.separation), (&there.impulse, &there.approach, &there.separation));
        prop_assert_eq!((&here.work, &here.kinetic_energy), (&there.work, &there.kinetic_energy));
        for (here, there) in [(here.one, there.one), (here.two, there.two)] {
            prop_assert_eq!(rotate(here.after.velocity), there.after.velocity);
            prop_assert_eq!(here.after.yaw_rate, there.after.yaw_rate);
            prop_assert_eq!(here.delta_v_in_vehicle, there.delta_v_in_vehicle);
        }
    }

    #[test]
    fn the_mirror_image_does_the_mirror_image(draw in computable()) {
        let collision = draw.exact();
        let here = collision.evaluate();
        let image = each_vehicle(collision.clone(), |vehicle| Vehicle {
            heading: Heading { cos: vehicle.heading.cos, sin: -vehicle.heading.sin },
            impact_center: ForwardLeft { forward: vehicle.impact_center.forward, left: -vehicle.impact_center.left },
            motion: Motion { velocity: mirror(vehicle.motion.velocity), yaw_rate: -vehicle.motion.yaw_rate },
            ..vehicle
        });
        let plane = collision.crush_plane.clone();
        let there = Collision {
            crush_plane: CrushPlane { cos: plane.cos, sin: -plane.sin },
            impulse_ratio: opposite(collision.impulse_ratio),
            ..image
        }
        .evaluate();
        prop_assert_eq!(here.work, there.work);
        prop_assert_eq!((here.impulse.n, -here.impulse.t), (there.impulse.n, there.impulse.t));
        prop_assert_eq!(mirror(here.one.after.velocity), there.one.after.velocity);
        prop_assert_eq!(-here.one.after.yaw_rate, there.one.after.yaw_rate);
        prop_assert_eq!(-here.two.after.yaw_rate, there.two.after.yaw_rate);
    }

    #[test]
    fn a_moving_observer_sees_the_same_impact(draw in computable(), x in -9..=9_i32, y in -9..=9_i32) {
        let collision = Draw { barrier: false, ..draw }.exact();
        prop_assume!(Draw { barrier: false, ..draw }.is_computable());
        let drift = Xy { x: int(x), y: int(y) };
        let here = collision.evaluate();
        let there = each_vehicle(collision, |vehicle| Vehicle {
            motion: Motion { velocity: vehicle.motion.velocity + drift.clone(), yaw_rate: vehicle.motion.yaw_rate },
            ..vehicle
        })
        .evaluate();
        prop_assert_eq!((&here.impulse, &here.work), (&there.impulse, &there.work));
        prop_assert_eq!(here.one.after.velocity + drift.clone(), there.one.after.velocity);
        prop_assert_eq!(here.two.after.velocity + drift, there.two.after.velocity);
        prop_assert_eq!(here.one.after.yaw_rate, there.one.after.yaw_rate);
    }

    #[test]
    fn the_crush_plane_has_two_normals(draw in computable()) {
        let collision = draw.exact();
        let plane = collision.crush_plane.clone();
        let turned = Collision { crush_plane: CrushPlane { cos: -plane.cos, sin: -plane.sin }, ..collision.clone() };
        let (here, there) = (collision.evaluate(), turned.evaluate());
        prop_assert_eq!((here.one, here.two), (there.one, there.two));
        prop_assert_eq!((here.work, here.kinetic_energy), (there.work, there.kinetic_energy));
        prop_assert_eq!(here.impulse_on_ground, there.impulse_on_ground);
        prop_assert_eq!(here.impulse, -there.impulse);
    }

    #[test]
    fn units_scale_each_quantity_by_its_power(draw in computable(), m in 1..=9_i32, l in 1..=9_i32, t in 1..=9_i32) {
        let (mass, length, time) = (int(m) / int(4), int(l) / int(5), int(t) / int(3));
        let speed = &length / &time;
        let collision = draw.exact();
        let here = collision.evaluate();
        let there = each_vehicle(collision, |vehicle| Vehicle {
            mass: vehicle.mass * &mass,
            yaw_inertia: vehicle.yaw_inertia * &mass * &length * &length,
            impact_center: vehicle.impact_center * length.clone(),
            motion: Motion { velocity: vehicle.motion.velocity * speed.clone(), yaw_rate: vehicle.motion.yaw_rate / &time },
            heading: vehicle.heading,
        })
        .evaluate();
        let energy = &mass * &speed * &speed;
        prop_assert_eq!(here.impulse * (&mass * &speed), there.impulse);
        prop_assert_eq!(here.approach * speed.clone(), there.approach);
        prop_assert_eq!(here.separation * speed.clone(), there.separation);
        prop_assert_eq!(here.one.after.velocity * speed.clone(), there.one.after.velocity);
        prop_assert_eq!(here.two.delta_v * speed, there.two.delta_v);
        prop_assert_eq!(here.one.after.yaw_rate / &time, there.one.after.yaw_rate);
        prop_assert_eq!(here.work.map(|w| w * &energy), there.work);
        prop_assert_eq!(here.kinetic_energy.map(|t| t * &energy), there.kinetic_energy);
    }

    #[test]
    fn a_perfectly_elastic_impact_can_be_undone(draw in computable()) {
        // e = 1 and the same impulse on reversed motions: sticking with restitution of both components is its own inverse.
        let collision = Collision { restitution: int(1), law: Law::KudlichSlibar, impulse_ratio: ImpulseRatio::Critical, ..draw.exact() };
        let there = collision.evaluate();
        let mut back = collision.clone();
        for (party, response) in [(&mut back.one, &there.one), (&mut back.two, &there.two)] {
            if let Party::Vehicle(vehicle) = party {
                vehicle.motion = Motion { velocity: -response.after.velocity.clone(), yaw_rate: -response.after.yaw_rate.clone() };
            }
        }
        let again = back.evaluate();
        let start = collision.one.vehicle().expect("vehicle 1 is one").motion.clone();
        prop_assert_eq!(again.loss(), int(0));
        prop_assert_eq!(-again.one.after.velocity, start.velocity);
        prop_assert_eq!(-again.one.after.yaw_rate, start.yaw_rate);
    }
}
