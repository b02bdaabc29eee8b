//! Interval arithmetic compared with exact arithmetic: every result is enclosed, and no bound is further out than two floats.

use crate::rational::Rational;
use crate::strategies::config;
use num_traits::{FromPrimitive, Inv};
use planar_impact::scalar::interval::{Interval, Truth};
use planar_impact::*;
use proptest::prelude::*;

/// Generates floats of every size, subnormal, huge and zero, and floats close enough to each other for their sum to cancel.
fn float() -> impl Strategy<Value = f64> {
    let of_every_size = any::<u64>().prop_map(f64::from_bits).prop_map(|x| if x.is_finite() { x } else { f64::MAX.copysign(x) });
    let special = prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, f64::MIN_POSITIVE, 5e-324, -5e-324, f64::MAX, f64::MIN]);
    prop_oneof![3 => of_every_size, 3 => -2.0..2.0, 1 => (-9..=9_i32).prop_map(f64::from), 1 => special]
}

/// Generates two numbers in order, often the same.
fn bounds() -> impl Strategy<Value = [f64; 2]> {
    (float(), float(), any::<bool>()).prop_map(|(x, y, single)| if single { [x, x] } else { [x.min(y), x.max(y)] })
}

fn interval([lower, upper]: [f64; 2]) -> Interval {
    Interval::new(lower, upper).expect("in order")
}

fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("finite")
}

/// Returns `true` if the first number is below the second one or equal to it.
fn in_order(bound: f64, number: &Rational) -> bool {
    if bound.is_finite() { exact(bound) <= *number } else { bound < 0.0 }
}

/// Tests that an interval contains all these numbers, the least and the greatest of them no further inside than two floats.
fn encloses(enclosed: Interval, numbers: &[Rational]) -> Result<(), TestCaseError> {
    let least = numbers.iter().min().expect("some");
    let greatest = numbers.iter().max().expect("some");
    let (lower, upper) = (enclosed.lower(), enclosed.upper());
    prop_assert!(
        in_order(lower, least) && in_order(-upper, &-greatest.clone()),
        "{} does not enclose {} and {}",
        enclosed,
        least,
        greatest
    );
    let inside = (lower.next_up().next_up(), upper.next_down().next_down());
    prop_assert!(!in_order(inside.0, least), "{} is far below {}", enclosed, least);
    prop_assert!(!in_order(-inside.1, &-greatest.clone()), "{} is far above {}", enclosed, greatest);
    Ok(())
}

/// Returns the results of an operation on every pair of bounds, which include the least and the greatest result.
fn corners(x: [f64; 2], y: [f64; 2], of: impl Fn(Rational, Rational) -> Rational) -> Vec<Rational> {
    x.iter().flat_map(|x| y.iter().map(|y| of(exact(*x), exact(*y)))).collect()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_four_operations_enclose_the_exact_result(x in bounds(), y in bounds()) {
        let (one, other) = (interval(x), interval(y));
        encloses(one + other, &corners(x, y, |x, y| x + y))?;
        encloses(one - other, &corners(x, y, |x, y| x - y))?;
        encloses(one * other, &corners(x, y, |x, y| x * y))?;
        prop_assert_eq!(-one, interval([-x[1], -x[0]]));
        if other.contains(0.0) {
            prop_assert_eq!((one / other, other.inv()), (Interval::ENTIRE, Interval::ENTIRE));
        } else {
            encloses(one / other, &corners(x, y, |x, y| x / y))?;
            encloses(other.inv(), &corners(y, y, |y, _| y.inv()))?;
        }
    }

    /// A bound may be infinite; every number between the bounds counts.
    #[test]
    fn unbounded_operands_enclose_every_result(x in bounds(), y in bounds(), open in any::<[bool; 4]>(), at in [float(), float()]) {
        let opened = |[lower, upper]: [f64; 2], [below, above]: [bool; 2]| {
            [if below { f64::NEG_INFINITY } else { lower }, if above { f64::INFINITY } else { upper }]
        };
        let (wide_x, wide_y) = (opened(x, [open[0], open[1]]), opened(y, [open[2], open[3]]));
        let (one, other) = (interval(wide_x), interval(wide_y));
        for x in [x[0], x[1], at[0].clamp(wide_x[0], wide_x[1])] {
            for y in [y[0], y[1], at[1].clamp(wide_y[0], wide_y[1])] {
                let holds = |enclosed: Interval, number: Rational| in_order(enclosed.lower(), &number) && in_order(-enclosed.upper(), &-number);
                let (p, q) = (exact(x), exact(y));
                prop_assert!(holds(one + other, &p + &q), "{} + {}", one, other);
                prop_assert!(holds(one - other, &p - &q), "{} - {}", one, other);
                prop_assert!(holds(one * other, &p * &q), "{} * {}", one, other);
                prop_assert!(y == 0.0 || holds(one / other, &p / &q), "{} / {}", one, other);
                prop_assert!(holds(one.squared(), &p * &p) && holds(one.half(), p / exact(2.0)), "{}", one);
                prop_assert!(one.magnitude().contains(x.abs()) && one.hull(other).contains(x) && one.hull(other).contains(y));
                match one.less(&other).decided() {
                    Some(less) => prop_assert_eq!(less, x < y),
                    None => prop_assert!(wide_x[0] < wide_y[1] && wide_y[0] <= wide_x[1], "{} and {} are in order", one, other),
                }
            }
        }
        let select = |mask| Interval::select(mask, one, other);
        prop_assert_eq!([select(Truth::TRUE), select(Truth::FALSE), select(Truth::UNKNOWN)], [one, other, one.hull(other)]);
        prop_assert_eq!(one.finite().is_certain(), one.lower().is_finite() && one.upper().is_finite());
        prop_assert_eq!(one.encloses(&other), one.hull(other) == one);
        prop_assert!(one.encloses(&one));
    }

    #[test]
    fn the_square_of_a_root_encloses_its_number(x in bounds()) {
        let Some(root) = interval(x).sqrt() else { prop_assert!(x[1] < 0.0); return Ok(()) };
        let squared = |root: f64| if root.is_finite() { exact(root) * exact(root) } else { exact(f64::MAX) };
        let (lower, upper) = (root.lower(), root.upper());
        prop_assert!(x[1] >= 0.0 && lower >= 0.0);
        // Numbers without a root do not count.
        let least = exact(x[0].max(0.0));
        prop_assert!(squared(lower) <= least && squared(lower.next_up().next_up()) > least, "{} of {}", root, x[0]);
        let greatest = exact(x[1]);
        let inside = upper.next_down().next_down().max(0.0);
        prop_assert!(squared(upper) >= greatest && (squared(inside) < greatest || inside == 0.0), "{} of {}", root, x[1]);
    }

    #[test]
    fn integers_are_enclosed_and_exact_where_a_float_is(n in prop_oneof![(any::<i64>(), 0..64_u32).prop_map(|(n, shift)| n >> shift), prop::sample::select(vec![i64::MAX, i64::MIN, -1])]) {
        let of = |enclosed: Option<Interval>, n: Rational| {
            let enclosed = enclosed.expect("an integer");
            let near = n.to_string().parse().expect("a number");
            encloses(enclosed, std::slice::from_ref(&n))?;
            prop_assert_eq!(enclosed.width() == 0.0, exact(near) == n, "{}", enclosed);
            Ok(())
        };
        of(Interval::from_i64(n), Rational::from_i64(n).expect("an integer"))?;
        of(Interval::from_u64(n as u64), Rational::from_u64(n as u64).expect("an integer"))?;
        of(Interval::from_i32(n as i32), Rational::from_i32(n as i32).expect("an integer"))?;
        prop_assert_eq!(Interval::from_f64(n as f64), Some(interval([n as f64, n as f64])));
    }
}
