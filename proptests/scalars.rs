//! One definition for every scalar: the results agree, and enclose each other where the types allow it.

use crate::rational::Rational;
use crate::strategies::{Draw, Fraction, RatioDraw, bits, computable, config, draw};
use num_complex::Complex64;
use num_dual::{Dual, Dual2_64, Dual64, DualSVec64, HyperDual64};
use planar_impact::scalar::interval::Interval;
use planar_impact::scalar::lanes::Lanes;
use planar_impact::*;
use proptest::prelude::*;

/// Returns every number of an impact, in a fixed order.
fn numbers<T: Field>(impact: Impact<T>) -> Vec<T> {
    let mut all = Vec::new();
    impact.map(|x| all.push(x));
    all
}

/// Returns the greatest magnitude among them; errors are relative to it.
fn scale(exact: &[f64]) -> f64 {
    exact.iter().fold(1.0, |greatest, x| x.abs().max(greatest))
}

fn as_f64(impact: Impact<Rational>) -> Vec<f64> {
    numbers(impact).iter().map(Rational::to_f64).collect()
}

/// Returns `true` if the collision is not close to wedging, where the impulse has a pole, or to the point where the
/// friction limit reverses with the approach; near these, floats lose their accuracy.
fn well_conditioned(draw: &Draw) -> bool {
    let collision = draw.of::<f64>();
    let contact = collision.contact();
    let impact = collision.evaluate();
    let ratio = impact.impulse_ratio();
    let closes = contact.approach.n.abs() > 1e-6;
    closes && contact.compliance.along_ratio(ratio).abs() > 1e-3 * contact.compliance.nn() && impact.impulse.length() < 1e6
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_interval_encloses_the_rational_and_holds_the_float(draw in computable()) {
        let exact = numbers(draw.exact().evaluate());
        let enclosed = numbers(draw.of::<Interval>().evaluate());
        let float = numbers(draw.of::<f64>().evaluate());
        for ((exact, enclosed), float) in exact.iter().zip(&enclosed).zip(&float) {
            let rational = |x: f64| Rational::from_float(x);
            prop_assert!(rational(enclosed.lower()).is_none_or(|lower| &lower <= exact), "{} below {}", exact, enclosed);
            prop_assert!(rational(enclosed.upper()).is_none_or(|upper| exact <= &upper), "{} above {}", exact, enclosed);
            prop_assert!(!float.is_finite() || enclosed.contains(*float), "{} outside {}", float, enclosed);
        }
    }

    #[test]
    fn enclosures_of_a_sound_impact_are_narrow(draw in computable()) {
        let draw = Draw { ratio: RatioDraw::Critical, ..draw };
        let exact = as_f64(draw.exact().evaluate());
        let enclosed = numbers(draw.of::<Interval>().evaluate());
        let scale = scale(&exact);
        for enclosed in enclosed {
            prop_assert!(enclosed.width() <= 1e-9 * scale, "{} is wider than 1e-9 of {}", enclosed, scale);
        }
    }

    #[test]
    fn f64_is_within_a_few_roundings(draw in computable()) {
        prop_assume!(well_conditioned(&draw));
        let exact = as_f64(draw.exact().evaluate());
        let float = numbers(draw.of::<f64>().evaluate());
        let scale = scale(&exact);
        for (exact, float) in exact.iter().zip(float) {
            prop_assert!((exact - float).abs() <= 1e-11 * scale, "{} for {}", float, exact);
        }
    }

    #[test]
    fn lanes_are_floats_with_their_verdicts(draws in [draw(), draw(), draw(), draw()], alike in any::<bool>()) {
        // One law and one kind of ratio in all lanes, as in a sweep.
        let of_first = |draw: Draw| Draw { law: draws[0].law, ratio: draws[0].ratio, barrier: draws[0].barrier, ..draw };
        let singles = draws.map(|draw| if alike { of_first(draw) } else { draw }.of::<f64>());
        let form = |collision: &Collision| {
            let kinds = (std::mem::discriminant(&collision.impulse_ratio), std::mem::discriminant(&collision.moment));
            (collision.parties().map(|party| party.vehicle().is_some()), collision.law, kinds)
        };
        let is_of_one_form = singles.iter().all(|single| form(single) == form(&singles[0]));
        let Some(together) = Collision::<Lanes>::gather(&singles) else {
            prop_assert!(!is_of_one_form);
            return Ok(());
        };
        prop_assert!(is_of_one_form);
        let (impact, accepted) = together.solve_lanes();
        let impacts = impact.scatter();
        for ((single, impact), accepted) in singles.iter().zip(impacts).zip(accepted.to_array()) {
            prop_assert_eq!(accepted, single.solve().is_ok());
            prop_assert!(numbers(impact).into_iter().map(bits).eq(numbers(single.evaluate()).into_iter().map(bits)));
        }
        prop_assert_eq!(accepted.all(), singles.iter().all(|single| single.solve().is_ok()));
    }

    #[test]
    fn every_scalar_agrees_with_f64(draw in computable()) {
        prop_assume!(well_conditioned(&draw));
        let float = numbers(draw.of::<f64>().evaluate());
        let scale = scale(&float);
        let close = |other: Vec<f64>, tolerance: f64| float.iter().zip(other).all(|(a, b)| (a - b).abs() <= tolerance * scale);
        prop_assert!(close(numbers(draw.of::<Dual64>().evaluate()).iter().map(|x| x.re).collect(), 1e-11), "Dual64");
        prop_assert!(close(numbers(draw.of::<DualSVec64<3>>().evaluate()).iter().map(|x| x.re).collect(), 1e-11), "DualSVec64");
        prop_assert!(close(numbers(draw.of::<HyperDual64>().evaluate()).iter().map(|x| x.re).collect(), 1e-11), "HyperDual64");
        prop_assert!(close(numbers(draw.of::<Dual2_64>().evaluate()).iter().map(|x| x.re).collect(), 1e-11), "Dual2_64");
        prop_assert!(close(numbers(draw.of::<Dual<Dual64>>().evaluate()).iter().map(|x| x.re.re).collect(), 1e-11), "nested dual");
    }

    #[test]
    fn f32_agrees_to_its_precision(draw in computable()) {
        let draw = Draw { ratio: RatioDraw::Critical, ..draw };
        prop_assume!(draw.of::<f64>().contact().compliance.determinant() > &1e-4);
        let float = numbers(draw.of::<f64>().evaluate());
        let scale = scale(&float);
        for (exact, single) in float.iter().zip(numbers(draw.of::<f32>().evaluate())) {
            prop_assert!((exact - f64::from(single)).abs() <= 1e-3 * scale);
        }
    }

    #[test]
    fn complex_step_dual_and_difference_agree(draw in computable(), eighths in 1..=7_i32) {
        // ∂/∂e of everything at the critical ratio. Complex numbers have no order, so they use only functions of a field.
        let draw = Draw { ratio: RatioDraw::Critical, restitution: Fraction(eighths, 8), law: Law::Brach, ..draw };
        let e = f64::from(eighths) / 8.0;
        let through = |collision: Collision<Complex64>| {
            let contact = collision.contact();
            let change = Law::Brach.change(contact.approach, collision.restitution);
            numbers(collision.impact_of(&contact, contact.compliance.impulse_for(change), None))
        };
        let step = 1e-100;
        let complex: Vec<f64> =
            through(Collision { restitution: Complex64::new(e, step), ..draw.of() }).iter().map(|x| x.im / step).collect();
        let dual = numbers(Collision { restitution: Dual64::new(e, 1.0), ..draw.of() }.evaluate());
        let at = |e: f64| numbers(Collision { restitution: e, ..draw.of::<f64>() }.evaluate());
        let (high, low) = (at(e + 1e-5), at(e - 1e-5));
        let scale = scale(&high);
        for (i, dual) in dual.iter().enumerate() {
            prop_assert!((dual.eps - complex[i]).abs() <= 1e-10 * scale, "number {}: {} by dual, {} by complex step", i, dual.eps, complex[i]);
            // The results are quadratic in e, so a central difference is exact except for rounding.
            let difference = (high[i] - low[i]) / 2e-5;
            prop_assert!((dual.eps - difference).abs() <= 1e-7 * scale, "number {}: {} by dual, {} by difference", i, dual.eps, difference);
        }
    }
}
