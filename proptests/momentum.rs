//! Momentum alone.

use crate::rational::Rational;
use crate::strategies::{OrReject, computable, config, draw, solved};
use planar_impact::momentum::approach_speeds;
use planar_impact::*;
use proptest::prelude::*;

/// Returns the collision of point masses with the same motions.
fn without_arms<T: Field>(mut collision: Collision<T>) -> Collision<T> {
    for party in [&mut collision.one, &mut collision.two] {
        if let Party::Vehicle(vehicle) = party {
            vehicle.impact_center = ForwardLeft::zero();
        }
    }
    collision
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_impulse_of_an_impact_makes_it_again(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        prop_assert_eq!(collision.impact_by(impact.impulse_on_ground.clone()), impact);
    }

    #[test]
    fn along_its_impulse_an_impact_has_no_tangential_part(draw in solved()) {
        let collision = draw.of::<f64>();
        let impact = collision.solve().or_reject("refused")?;
        let along = collision.along_impulse(impact.impulse_on_ground);
        let again = along.evaluate();
        let close = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-9 * size;
        let size = impact.impulse.length();
        prop_assert!(close(again.impulse.n, size, size) && again.impulse.t == 0.0, "{:?}", again.impulse);
        prop_assert!(close(again.loss(), impact.loss(), impact.kinetic_energy.before));
        for (again, impact) in [(&again.one, &impact.one), (&again.two, &impact.two)] {
            let speed = impact.after.velocity.length().max(impact.delta_v.length()).max(1e-3);
            prop_assert!((again.after.velocity - impact.after.velocity).length() <= 1e-9 * speed);
            prop_assert!(close(again.after.yaw_rate, impact.after.yaw_rate, impact.after.yaw_rate.abs().max(speed)));
        }
        // It is the impact that the impulse alone makes, and momentum alone accepts it.
        let by_impulse = collision.solve_by(impact.impulse_on_ground).or_reject("refused")?;
        prop_assert!((by_impulse.one.after.velocity - impact.one.after.velocity).length() <= 1e-9 * impact.one.after.velocity.length().max(impact.one.delta_v.length()));
    }

    #[test]
    fn approach_speeds_have_the_momentum_after(draw in draw(), after in [[-99..=99_i32, -99..=99], [-99..=99_i32, -99..=99]]) {
        let (one, two) = (draw.one.of::<Rational>(), draw.two.of::<Rational>());
        let along = |vehicle: &Vehicle<Rational>| vehicle.heading.to_ground(ForwardLeft { forward: Rational::int(1), left: Rational::int(0) });
        prop_assume!(along(&one).cross(along(&two)) != Rational::int(0));
        let after = after.map(|[x, y]| Xy { x: Rational::int(x), y: Rational::int(y) });
        let [v1, v2] = approach_speeds([&one, &two], after.clone());
        let [after_1, after_2] = after;
        let before = along(&one) * (v1 * &one.mass) + along(&two) * (v2 * &two.mass);
        prop_assert_eq!(before, after_1 * one.mass.clone() + after_2 * two.mass.clone());
    }

    #[test]
    fn point_masses_close_from_any_side(draw in draw()) {
        let collision = Collision { restitution: Rational::int(0), impulse_ratio: ImpulseRatio::Critical, ..without_arms(draw.exact()) };
        let approach = collision.contact().approach.n;
        let solved = collision.solve();
        prop_assert_eq!(solved.is_ok(), !draw.barrier && approach != Rational::int(0), "{:?}", solved);
        // Their common velocity is that of their momentum.
        if let (Ok(impact), Party::Vehicle(one), Party::Vehicle(two)) = (solved, &collision.one, &collision.two) {
            let momentum = one.motion.velocity.clone() * one.mass.clone() + two.motion.velocity.clone() * two.mass.clone();
            prop_assert_eq!(&impact.one.after.velocity, &impact.two.after.velocity);
            prop_assert_eq!(impact.one.after.velocity * (one.mass.clone() + &two.mass), momentum);
        }
        prop_assert_eq!(without_arms(draw.of::<f64>()).solve().is_ok(), without_arms(draw.exact()).solve().is_ok());
    }
}

#[test]
fn an_impulse_that_gains_energy_or_is_no_number_is_refused() {
    let car = |speed: f64| Vehicle::new(1000.0, 1000.0).with_speed(speed);
    let collision = Collision::new(car(10.0), car(-10.0));
    // At ±10 m/s each an impulse of 20,000 N s returns the whole energy.
    assert!(collision.solve_by(Xy { x: -20e3, y: 0.0 }).is_ok());
    let refused = |x: f64| collision.solve_by(Xy { x, y: 0.0 }).expect_err("refused").as_slice().to_vec();
    assert!(matches!(refused(-20.001e3)[..], [Refusal::EnergyGain { .. }]));
    assert!(matches!(refused(1.0)[..], [Refusal::EnergyGain { .. }]), "it would push them together");
    assert_eq!(refused(f64::NAN), [Refusal::OutOfFloatRange]);
    assert_eq!(refused(1e300), [Refusal::OutOfFloatRange]);
    let massless = Collision { one: Vehicle::new(0.0, 1.0).into(), ..collision };
    assert!(matches!(massless.solve_by(Xy { x: -1.0, y: 0.0 }).expect_err("refused").as_slice(), [Refusal::Input(_)]));
}
