//! Angles in, magnitudes and directions out: laws that need real numbers.

use crate::strategies::{Draw, RatioDraw, bits, config, draw};
use num_dual::{Dual64, HyperDual64};
use planar_impact::scalar::lanes::Lanes;
use planar_impact::*;
use proptest::prelude::*;

fn with_angles<T: Real>(draw: &Draw, headings: [T; 2], crush_plane: T) -> Collision<T> {
    let mut collision = draw.of::<T>();
    let [one, two] = headings;
    for (party, heading) in [(&mut collision.one, one), (&mut collision.two, two)] {
        if let Party::Vehicle(vehicle) = party {
            vehicle.heading = Heading::from_angle(heading);
        }
    }
    collision.crush_plane = CrushPlane::from_angle(crush_plane);
    collision
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn derivatives_by_angle_are_those_of_differences(draw in draw(), a in -3.0..3.0_f64, b in -3.0..3.0_f64, gamma in -3.0..3.0_f64) {
        let draw = Draw { ratio: RatioDraw::Critical, ..draw };
        let loss = |gamma: f64| with_angles(&draw, [a, b], gamma).evaluate().work.n;
        let dual = with_angles(&draw, [a.into(), b.into()], Dual64::new(gamma, 1.0)).evaluate().work.n;
        prop_assert_eq!(dual.re.is_finite(), loss(gamma).is_finite());
        // The error of a difference quotient is proportional to the square of its step: half the step leaves about a
        // quarter of the error, or rounding.
        let error = |step: f64| ((loss(gamma + step) - loss(gamma - step)) / (2.0 * step) - dual.eps).abs();
        let approach = with_angles(&draw, [a, b], gamma).contact().approach.length_squared();
        let scale = 1.0 + dual.eps.abs() + f64::from(draw.one.mass + draw.two.mass) * approach;
        let (coarse, fine) = (error(2e-4), error(1e-4));
        prop_assert!(fine <= 0.5 * coarse + 1e-9 * scale, "{} after {}, derivative {}", fine, coarse, dual.eps);
    }

    #[test]
    fn second_derivatives_are_symmetric(draw in draw(), a in -3.0..3.0_f64, gamma in -3.0..3.0_f64) {
        let draw = Draw { ratio: RatioDraw::Critical, barrier: true, ..draw };
        let at = |heading: HyperDual64, plane: HyperDual64| with_angles(&draw, [heading, 0.0.into()], plane).evaluate().loss();
        let here = at(HyperDual64::new(a, 1.0, 0.0, 0.0), HyperDual64::new(gamma, 0.0, 1.0, 0.0));
        let there = at(HyperDual64::new(a, 0.0, 1.0, 0.0), HyperDual64::new(gamma, 1.0, 0.0, 0.0));
        let energy = f64::from(draw.one.mass) * with_angles(&draw, [a, 0.0], gamma).contact().approach.length_squared();
        let scale = 1.0 + energy + here.eps1.abs() + here.eps2.abs() + here.eps1eps2.abs();
        prop_assert!((here.eps1eps2 - there.eps1eps2).abs() <= 1e-11 * scale);
        prop_assert!((here.eps1 - there.eps2).abs() <= 1e-12 * scale && (here.eps2 - there.eps1).abs() <= 1e-12 * scale);
    }

    #[test]
    fn magnitude_and_direction_are_those_of_the_change_of_velocity(draw in draw(), a in -3.0..3.0_f64, b in -3.0..3.0_f64, gamma in -3.0..3.0_f64) {
        let draw = Draw { ratio: RatioDraw::Critical, barrier: false, ..draw };
        let impact = with_angles(&draw, [a, b], gamma).evaluate();
        for response in [&impact.one, &impact.two] {
            let (dv, pdof) = (response.delta_v_magnitude(), response.principal_direction_of_force());
            // Clockwise from straight ahead, towards the origin of the force.
            prop_assert!((dv * pdof.cos() + response.delta_v_in_vehicle.forward).abs() <= 1e-13 * (1.0 + dv));
            prop_assert!((dv * pdof.sin() - response.delta_v_in_vehicle.left).abs() <= 1e-13 * (1.0 + dv));
        }
    }

    #[test]
    fn lanes_have_the_bits_of_floats(draw in draw(), a in -6.0..6.0_f64, b in -6.0..6.0_f64, gamma in -6.0..6.0_f64) {
        let single = with_angles(&draw, [a, b], gamma);
        let lanes = with_angles(&draw, [a, b].map(Lanes::<8>::splat), Lanes::splat(gamma));
        let (single, lanes) = (Outputs::of(&single, &single.evaluate()), Outputs::of(&lanes, &lanes.evaluate()));
        for (i, output) in Output::ALL.into_iter().enumerate() {
            prop_assert_eq!(bits(lanes[output].to_array()[i % 8]), bits(single[output]), "{}", output);
        }
    }
}

/// A force along each axis of the vehicle, and no force.
#[test]
fn where_the_force_comes_from() {
    use core::f64::consts::{FRAC_PI_2, PI};
    let pushed = |forward: f64, left: f64| {
        let at_rest = Motion { velocity: Xy { x: 0.0, y: 0.0 }, yaw_rate: 0.0 };
        Response { after: at_rest, delta_v: Xy { x: forward, y: left }, delta_v_in_vehicle: ForwardLeft { forward, left } }
    };
    assert_eq!(pushed(-1.0, 0.0).principal_direction_of_force(), 0.0);
    assert_eq!(pushed(-1.0, -0.0).principal_direction_of_force().to_bits(), 0.0_f64.to_bits());
    // Pushed to the left: the force comes from the right, a quarter turn clockwise.
    assert_eq!(pushed(0.0, 1.0).principal_direction_of_force(), FRAC_PI_2);
    assert_eq!(pushed(0.0, -1.0).principal_direction_of_force(), -FRAC_PI_2);
    assert_eq!(pushed(1.0, 0.0).principal_direction_of_force(), PI);
    assert_eq!(pushed(1.0, -0.0).principal_direction_of_force(), PI);
    assert_eq!(pushed(0.0, 0.0).principal_direction_of_force(), 0.0);
    assert_eq!(pushed(0.0, 0.0).delta_v_magnitude(), 0.0);
    let still = Response { delta_v: Xy { x: Dual64::from(0.0), y: Dual64::from(0.0) }, ..pushed(0.0, 0.0).map(Dual64::from) };
    assert_eq!((still.delta_v_magnitude().eps, still.principal_direction_of_force().eps), (0.0, 0.0));
}
