//! Sine, cosine, arctangent and square root of intervals compared with fixed-point arithmetic of 320 bits.

use crate::strategies::{config, fewer};
use num_bigint::{BigInt, Sign};
use planar_impact::scalar::interval::Interval;
use planar_impact::*;
use proptest::prelude::*;
use std::sync::LazyLock;

/// Bits after the point.
const BITS: u32 = 320;

/// Twice the greatest error of the reference, in its last place: some hundred terms are truncated.
const ERROR: u32 = 2_000;

/// Half of π, by Machin's formula.
static HALF_PI: LazyLock<BigInt> = LazyLock::new(|| 8 * arctangent_of_inverse(5) - 2 * arctangent_of_inverse(239));

fn one() -> BigInt {
    BigInt::from(1) << BITS
}

fn arctangent_of_inverse(n: i32) -> BigInt {
    let (mut power, mut sum) = (one() / n, BigInt::ZERO);
    for k in 0.. {
        if power == BigInt::ZERO {
            break;
        }
        let term: BigInt = &power / (2 * k + 1);
        sum += if k % 2 == 0 { term } else { -term };
        power /= n * n;
    }
    sum
}

/// Returns a float in fixed point; bits below the last place are lost.
fn fixed(x: f64) -> BigInt {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i64;
    let mantissa = (bits & ((1 << 52) - 1)) | if exponent == 0 { 0 } else { 1 << 52 };
    let shift = exponent.max(1) - 1075 + i64::from(BITS);
    let size = BigInt::from_biguint(Sign::Plus, mantissa.into());
    let size = if shift >= 0 { size << shift } else { size >> -shift };
    if x.is_sign_negative() { -size } else { size }
}

fn times(a: &BigInt, b: &BigInt) -> BigInt {
    (a * b) >> BITS
}

/// Returns sine and cosine by their series, about the nearest multiple of π/2.
fn sine_and_cosine(x: &BigInt) -> (BigInt, BigInt) {
    let half = &*HALF_PI / 2;
    let quadrant = (x + &half) / &*HALF_PI - i32::from(x + &half < BigInt::ZERO);
    let r = x - &quadrant * &*HALF_PI;
    let square = times(&r, &r);
    let series = |first: BigInt, n: u32| {
        let (mut term, mut sum) = (first.clone(), first);
        for k in (n..).step_by(2).take(60) {
            term = -times(&term, &square) / (k * (k + 1));
            sum += &term;
        }
        sum
    };
    let (sin, cos) = (series(r, 2), series(one(), 1));
    let turned = ((&quadrant % 4) + 4) % 4;
    match u32::try_from(&turned).expect("of four") {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Returns `true` if an interval contains a number but for the error of the reference.
fn encloses(enclosed: Interval, number: &BigInt) -> bool {
    fixed(enclosed.lower()) <= number + ERROR && number - ERROR <= fixed(enclosed.upper())
}

/// Generates angles of every size to beyond the range of the proof, and some next to multiples of π/2.
fn angle() -> impl Strategy<Value = f64> {
    let near_a_quadrant = (-70_000..70_000_i32, -3..=3_i32, any::<bool>()).prop_map(|(n, steps, far)| {
        let at = f64::from(if far { n } else { n % 9 }) * core::f64::consts::FRAC_PI_2;
        (0..steps.abs()).fold(at, |x, _| if steps > 0 { x.next_up() } else { x.next_down() })
    });
    prop_oneof![3 => -8.0..8.0, 1 => -1.1e5..1.1e5, 1 => (-60..1_i32, -1.0..1.0).prop_map(|(k, x): (i32, f64)| x * 2_f64.powi(k)), 2 => near_a_quadrant]
}

/// Generates coordinates of every size, many of them of the same.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -2.0..2.0, 1 => Just(0.0), 1 => (-60..60_i32, -1.0..1.0).prop_map(|(k, x): (i32, f64)| x * 2_f64.powi(k)), 1 => (-3..=3_i32).prop_map(f64::from)]
}

fn interval(x: f64, y: f64) -> Interval {
    Interval::new(x.min(y), x.max(y)).expect("in order")
}

/// Generates an interval and a number in it: of one number, narrow, or wide.
fn interval_with<S: Strategy<Value = f64>>(bound: fn() -> S) -> impl Strategy<Value = (Interval, f64)> {
    (bound(), bound(), 0..3_u32, 0.0..=1.0).prop_map(|(x, y, kind, share): (f64, f64, u32, f64)| {
        let y = match kind {
            0 => x,
            1 => x + (y - x) * 1e-9,
            _ => y,
        };
        (interval(x, y), (x + share * (y - x)).clamp(x.min(y), x.max(y)))
    })
}

proptest! {
    #![proptest_config(fewer(2))]

    #[test]
    fn sine_and_cosine_enclose_those_of_every_angle((angles, at) in interval_with(angle)) {
        let (sin, cos) = angles.sin_and_cos();
        for x in [angles.lower(), at, angles.upper()] {
            let exact = sine_and_cosine(&fixed(x));
            prop_assert!(encloses(sin, &exact.0), "sin {} is not in {} of {}", x, sin, angles);
            prop_assert!(encloses(cos, &exact.1), "cos {} is not in {} of {}", x, cos, angles);
            let float = x.sin_and_cos();
            prop_assert!(sin.contains(float.0) && cos.contains(float.1));
        }
        // Every extreme between the bounds, and those alone.
        if angles.lower().abs().max(angles.upper().abs()) <= 1e5 {
            let quadrant = |x: f64, by: f64| u32::try_from((fixed(x + by) + &*HALF_PI * 100_000) / &*HALF_PI).expect("small");
            let has = |n: u32, by: f64| (quadrant(angles.lower(), -by) + 1..=quadrant(angles.upper(), by)).any(|k| k % 4 == n);
            let one = |x: f64| x.abs() == 1.0;
            for (n, bound) in [(0, cos.upper()), (1, sin.upper()), (2, cos.lower()), (3, sin.lower())] {
                prop_assert!(one(bound) || !has(n, 0.0), "{} has an extreme that {} and {} do not", angles, sin, cos);
                prop_assert!(!one(bound) || has(n, 1e-7), "{} has no extreme, but {} and {} do", angles, sin, cos);
            }
        }
    }

    #[test]
    fn the_sine_and_the_cosine_of_a_number_are_narrow(x in angle()) {
        prop_assume!(x.abs() <= 1e5);
        let (sin, cos) = Interval::from(x).sin_and_cos();
        for values in [sin, cos] {
            prop_assert!(values.width() <= 20.0 * f64::EPSILON * values.magnitude().upper() + 1e-323, "{} is {} wide", values, values.width());
        }
    }

    #[test]
    fn the_arctangent_encloses_the_angle_of_every_direction((ys, y) in interval_with(coordinate), (xs, x) in interval_with(coordinate)) {
        let angles = ys.arctangent(xs);
        let all = Interval::new(-core::f64::consts::PI.next_up(), core::f64::consts::PI.next_up()).expect("in order");
        prop_assert!(all.encloses(&angles));
        let meets_cut = xs.lower() < 0.0 && ys.lower() < 0.0 && ys.upper() >= 0.0;
        prop_assert_eq!(angles == all, meets_cut || (xs.contains(0.0) && ys.contains(0.0)), "{} for {} and {}", angles, ys, xs);
        for (y, x) in [(y, x), (ys.lower(), xs.lower()), (ys.lower(), xs.upper()), (ys.upper(), xs.lower()), (ys.upper(), xs.upper())] {
            prop_assert!(angles.contains((y + 0.0).arctangent(x + 0.0)), "the angle of {} and {} is not in {}", y, x, angles);
            if angles == all {
                continue;
            }
            // To the left of the first direction and to the right of the last one, by less than a half turn.
            let across = |angle: f64| {
                let (sin, cos) = sine_and_cosine(&fixed(angle));
                let is_far = (angle - y.atan2(x)).abs() > 3.0;
                if is_far { BigInt::ZERO } else { times(&fixed(y), &cos) - times(&fixed(x), &sin) }
            };
            prop_assert!(across(angles.lower()) >= (-8 * i64::from(ERROR)).into(), "the angle of {} and {} is below {}", y, x, angles);
            prop_assert!(across(angles.upper()) <= (8 * i64::from(ERROR)).into(), "the angle of {} and {} is above {}", y, x, angles);
        }
    }

    #[test]
    fn the_arctangent_of_two_numbers_is_narrow(y in coordinate(), x in coordinate()) {
        prop_assume!(y != 0.0);
        let angle = Interval::from(y).arctangent(Interval::from(x));
        prop_assert!(angle.width() <= 20.0 * f64::EPSILON * angle.magnitude().upper(), "{} is {} wide", angle, angle.width());
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_root_of_a_real_is_that_of_the_part_that_has_one((numbers, _) in interval_with(coordinate)) {
        let root = numbers.square_root();
        prop_assert_eq!(root, numbers.sqrt().unwrap_or(Interval::ENTIRE));
        prop_assert_eq!(root.lower() >= 0.0, numbers.upper() >= 0.0);
    }
}

#[test]
fn extreme_arguments_are_enclosed() {
    let all = |x: f64| [Interval::from(x), Interval::new(f64::NEG_INFINITY, x).expect("in order"), Interval::ENTIRE];
    for x in [0.0, -0.0, 5e-324, 1e5, 1e5_f64.next_up(), 1e22, f64::MAX] {
        for angles in all(x) {
            let (sin, cos) = angles.sin_and_cos();
            let float = x.sin_and_cos();
            assert!(sin.contains(float.0) && cos.contains(float.1), "{angles}");
        }
        for y in [0.0, 5e-324, 1e-300, 1.0, 1e300, 1e301, f64::MAX] {
            for (ys, xs) in all(y).into_iter().flat_map(|ys| all(x).map(|xs| (ys, xs))) {
                assert!(ys.arctangent(xs).contains(y.arctangent(x + 0.0)), "{ys} and {xs}");
            }
        }
    }
    assert_eq!(Interval::from(0.0).sin_and_cos().0, Interval::from(0.0));
}
