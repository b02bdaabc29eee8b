//! The closed form from rest position to separation, compared with the integrated slide.

use num_dual::Dual64;
use planar_impact::reconstruct::closed_form::*;
use planar_impact::reconstruct::{Measurand, ReconstructionProblem, Search, Uncertainty, Variable, Verdict};
use planar_impact::*;

use super::scene::{Source, Truth};

const CASES: usize = 3_000;

fn with_motions(collision: &Collision, one: Motion, two: Motion) -> Collision {
    let moving = |party: &Party, motion| match party {
        Party::Barrier => Party::Barrier,
        Party::Vehicle(vehicle) => Vehicle { motion, ..*vehicle }.into(),
    };
    Collision { one: moving(&collision.one, one), two: moving(&collision.two, two), ..*collision }
}

fn against_barrier(source: &mut Source) -> Collision {
    loop {
        let mut collision = Collision { two: Party::Barrier, impulse_ratio: ImpulseRatio::Critical, ..source.collision() };
        if let Party::Vehicle(car) = &mut collision.one {
            // A crab angle: the car does not move along its heading.
            car.motion.velocity = Heading::from_angle(source.between(-0.6, 0.6)).to_ground(ForwardLeft { forward: 15.0, left: 0.0 });
        }
        if collision.solve().is_ok() {
            return collision;
        }
    }
}

#[test]
fn a_barrier_with_a_known_crab_angle_gives_the_speed_back() {
    let mut source = Source::of(11);
    for _ in 0..CASES {
        let truth = against_barrier(&mut source);
        let crush_energy = -truth.solve().expect("possible").work.n;
        let slower = at_crush_energy(&truth, crush_energy / 9.0);
        let back = at_crush_energy(&slower, crush_energy);
        let velocity = |collision: &Collision| collision.one.vehicle().expect("a car").motion.velocity;
        assert!((velocity(&slower) - velocity(&truth) * (1.0 / 3.0)).length() < 1e-12);
        assert!((velocity(&back) - velocity(&truth)).length() < 1e-12);
    }
}

#[test]
fn the_search_finds_what_the_formula_has() {
    let mut source = Source::of(12);
    let mut searched = 0;
    for _ in 0..CASES {
        let collision = source.collision();
        let standing = with_motions(&collision, collision.one.vehicle().expect("a car").motion, Motion::rest());
        let Ok(impact) = standing.solve() else { continue };
        searched += 1;
        let crush_energy = -impact.work.n * source.between(0.3, 3.0);
        let expected = at_crush_energy(&standing, crush_energy).one.vehicle().expect("a car").motion.velocity.length();
        let question = ReconstructionProblem::of(standing).between(Variable::Speed(Side::One), 10.0, 0.0, 100.0).evidence(
            Measurand::CrushEnergy,
            crush_energy,
            Uncertainty::Exact,
        );
        let answer = question.solve(&Search::default()).expect("it has an answer");
        // The formula gives the start, and the only one.
        assert_eq!((answer.verdict, answer.searches), (Verdict::Agrees, 1));
        assert!((answer.best().unknowns[0].value - expected).abs() < 1e-11 * expected);
    }
    assert!(2 * searched > CASES, "{searched}");
}

#[test]
fn the_closing_speed_follows_from_crush_energy_and_compliance() {
    let mut source = Source::of(13);
    for _ in 0..CASES {
        let collision = source.collision();
        let impact = collision.solve().expect("possible");
        let compliance = collision.contact().compliance.along_ratio(impact.impulse_ratio());
        let speed = closing_speed(compliance, collision.restitution, -impact.work.n);
        assert!((speed / impact.approach.n.abs() - 1.0).abs() < 1e-9, "{collision:?}");
    }
}

#[test]
fn two_cars_on_one_line_go_back_to_their_speeds() {
    let mut source = Source::of(14);
    for _ in 0..CASES {
        let (v_1, v_2) = (source.between(-5.0, 30.0), source.between(-30.0, -6.0));
        let car = |mass, heading, velocity| Vehicle {
            mass,
            yaw_inertia: 2000.0,
            heading: Heading::from_angle(heading),
            impact_center: ForwardLeft { forward: 2.0, left: 0.0 },
            motion: Motion { velocity: Xy { x: velocity, y: 0.0 }, yaw_rate: 0.0 },
        };
        let (m_1, m_2) = (source.between(800.0, 2000.0), source.between(800.0, 2000.0));
        let collision = Collision {
            one: car(m_1, 0.0, v_1).into(),
            two: car(m_2, std::f64::consts::PI, v_2).into(),
            crush_plane: CrushPlane::from_angle(0.0),
            restitution: source.between(0.0, 0.4),
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        };
        let impact = collision.solve().expect("they close");
        let line = Collinear {
            inverse_mass_1: 1.0 / m_1,
            inverse_mass_2: 1.0 / m_2,
            restitution: collision.restitution,
            crush_energy: -impact.work.n,
        };
        let before = line.before(impact.one.after.velocity.x);
        assert!((before.one - v_1).abs() < 1e-10 && (before.two - v_2).abs() < 1e-10, "{before:?} for {v_1}, {v_2}");
    }
}

#[test]
fn known_motions_after_it_and_crush_energy_give_the_motions_before() {
    let mut source = Source::of(15);
    let mut tried = 0;
    for _ in 0..CASES {
        // The textbook case: e = 0 and sliding ended, so that both have a common velocity at the impact center; and any other case.
        let common = source.between(0.0, 1.0) < 0.5;
        let collision = source.collision();
        let collision = if common { collision.at_common_velocity() } else { collision };
        let Ok(impact) = collision.solve() else { continue };
        let after = with_motions(&collision, impact.one.after, impact.two.after);
        for direction in [Direction::Ratio(impact.impulse_ratio()), Direction::AlongHeading(Side::One), Direction::AlongHeading(Side::Two)]
        {
            let roots = before_separation(&after, -impact.work.n, direction).expect("there is the energy of the impact itself");
            let miss = |before: &Collision| {
                let far = |one: &Party, other: &Party| {
                    let (one, other) = (one.vehicle().expect("a car").motion, other.vehicle().expect("a car").motion);
                    (one.velocity - other.velocity).length() + (one.yaw_rate - other.yaw_rate).abs()
                };
                far(&before.one, &collision.one) + far(&before.two, &collision.two) + (before.restitution - collision.restitution).abs()
            };
            let nearest = roots.iter().map(miss).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{direction:?}: {nearest:e} in {collision:?}");
            // Both roots lead to the given motions, whether possible or not.
            for root in roots {
                let again = root.evaluate();
                let off = (again.one.after.velocity - impact.one.after.velocity).length();
                assert!(off < 1e-6 * (1.0 + root.one.vehicle().expect("a car").motion.velocity.length()), "{off:e}");
            }
            tried += 1;
        }
    }
    assert!(tried > CASES);
}

#[test]
fn no_impulse_along_the_heading_of_a_barrier() {
    let mut source = Source::of(16);
    let collision = against_barrier(&mut source);
    assert_eq!(before_separation(&collision, 1e4, Direction::AlongHeading(Side::Two)), None);
    // No impulse has an energy below zero.
    assert_eq!(before_separation(&collision, -1e12, Direction::Ratio(0.0)), None);
}

#[test]
fn the_formulas_carry_derivatives() {
    // dv/dE = v/(2 E) for a speed proportional to the root of the energy.
    let mut source = Source::of(17);
    for _ in 0..100 {
        let truth = Truth::of(against_barrier(&mut source), 1.0);
        let crush_energy = truth.measured(Measurand::CrushEnergy);
        let energy = Dual64::new(crush_energy, 1.0);
        let back = at_crush_energy(&truth.collision.map(Dual64::from), energy);
        let speed = back.one.vehicle().expect("a car").motion.velocity.length();
        assert!((speed.eps - speed.re / (2.0 * crush_energy)).abs() < 1e-12 * speed.eps);
    }
}
