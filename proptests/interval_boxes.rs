//! The mechanics on boxes of inputs: every number of the impact encloses that of every point of the box, in rational arithmetic.

use crate::rational::Rational;
use crate::strategies::{Draw, computable, fewer};
use planar_impact::scalar::interval::Interval;
use planar_impact::*;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Returns every number of an impact, in a fixed order.
fn numbers<T: Field>(impact: Impact<T>) -> Vec<T> {
    let mut all = Vec::new();
    impact.map(|x| all.push(x));
    all
}

/// Returns a box of collisions about one and a collision in it. Each number reaches 0 to 15 units of 2⁻ⁿ down and up.
fn box_and_point(draw: &Draw, reaches: &[(u8, u8, u8)], n: i32) -> (Collision<Interval>, Collision<Rational>) {
    let unit = 2_f64.powi(-n);
    let (mut at, mut point_at) = (0, 0);
    let base = draw.of::<f64>();
    let about = base.map(|x| {
        let (down, up, _) = reaches[at % reaches.len()];
        at += 1;
        Interval::new(x - f64::from(down) * unit, x + f64::from(up) * unit).expect("in order")
    });
    let point = about.map(|bounds| {
        let (_, _, share) = reaches[point_at % reaches.len()];
        point_at += 1;
        let [lower, upper] = [bounds.lower(), bounds.upper()].map(|x| Rational::from_float(x).expect("finite"));
        lower.clone() + (upper - lower) * Rational::int(share.into()) / Rational::int(255)
    });
    (about, point)
}

/// Returns `true` if the impact divides by zero, which rationals do not have.
fn divides_by_zero(collision: &Collision<Rational>) -> bool {
    let zero = Rational::int(0);
    let has_no_inverse =
        |party: &Party<Rational>| party.vehicle().is_some_and(|vehicle| vehicle.mass == zero || vehicle.yaw_inertia == zero);
    if collision.parties().into_iter().any(has_no_inverse) {
        return true;
    }
    let contact = collision.contact();
    let wedges = |ratio: Rational| contact.compliance.along_ratio(ratio) == zero;
    *contact.compliance.determinant() == zero
        || match &collision.impulse_ratio {
            ImpulseRatio::Critical => false,
            ImpulseRatio::Given(ratio) => wedges(ratio.clone()),
            ImpulseRatio::LimitedByFriction(friction) => wedges(friction.clone()) || wedges(-friction.clone()),
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() }.impulse(&contact).0;
                sticking.n == zero || wedges(fraction.clone() * sticking.t / sticking.n)
            }
        }
}

type Reaches = Vec<(u8, u8, u8)>;

fn boxes() -> impl Strategy<Value = (Draw, Reaches, i32)> {
    let reach =
        (0..16_u8, 0..16_u8, any::<u8>()).prop_map(|(down, up, share)| if share % 4 == 0 { (0, 0, share) } else { (down, up, share) });
    (computable(), prop::collection::vec(reach, 25), prop_oneof![4..12_i32, 20..50_i32])
}

fn every_point_is_enclosed((draw, reaches, n): (Draw, Reaches, i32)) -> Result<(), TestCaseError> {
    let (about, point) = box_and_point(&draw, &reaches, n);
    if divides_by_zero(&point) {
        return Ok(());
    }
    for (enclosed, exact) in numbers(about.evaluate()).into_iter().zip(numbers(point.evaluate())) {
        let rational = |x: f64| Rational::from_float(x);
        prop_assert!(rational(enclosed.lower()).is_none_or(|lower| lower <= exact), "{} below {}", exact, enclosed);
        prop_assert!(rational(enclosed.upper()).is_none_or(|upper| exact <= upper), "{} above {}", exact, enclosed);
    }
    Ok(())
}

proptest! {
    #![proptest_config(fewer(2))]

    #[test]
    fn the_impact_of_a_box_encloses_that_of_every_point(case in boxes()) {
        every_point_is_enclosed(case)?;
    }
}

/// The same a million times.
#[ignore = "some minutes"]
#[test]
fn the_impact_of_a_million_boxes_encloses_that_of_every_point() {
    let config =
        Config { cases: 1_000_000, max_global_rejects: 10_000_000, max_local_rejects: 10_000_000, failure_persistence: None, ..fewer(1) };
    TestRunner::new(config).run(&boxes(), every_point_is_enclosed).expect("every box encloses its points");
}
