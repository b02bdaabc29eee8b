//! The four operations of intervals.
//!
//! The usual case is short: finite bounds, no zero among the results. Everything else is computed apart, product by product.

use super::Interval;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::Inv;

/// Returns the next float above a finite number, and zero as it is.
#[inline]
pub(super) fn above(x: f64) -> f64 {
    let bits = x.to_bits() as i64;
    let step = (bits >> 63) | 1;
    f64::from_bits(bits.wrapping_add(if x == 0.0 { 0 } else { step }) as u64)
}

/// Returns the next float below a finite number, and zero as it is.
#[inline]
pub(super) fn below(x: f64) -> f64 {
    let bits = x.to_bits() as i64;
    let step = (bits >> 63) | 1;
    f64::from_bits(bits.wrapping_sub(if x == 0.0 { 0 } else { step }) as u64)
}

// The selections of one instruction each; not a number is excluded beforehand.

#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Returns the interval around sums that were rounded to nearest. A sum of zero is exact.
#[inline]
fn around_sums(lower: f64, upper: f64) -> Interval {
    // Finite only if both are.
    if (lower + upper).is_finite() { Interval { lower: below(lower), upper: above(upper) } } else { around_large_sums(lower, upper) }
}

#[cold]
#[inline(never)]
fn around_large_sums(lower: f64, upper: f64) -> Interval {
    let keep = |x: f64, moved: f64| if x == 0.0 { x } else { moved };
    Interval { lower: keep(lower, lower.next_down()), upper: keep(upper, upper.next_up()) }
}

/// Returns the interval around four results that were rounded to nearest, or `None` if one of them is not finite, or if a bound is zero, which may be exact or
/// too small for a float.
#[inline]
fn around(results: [f64; 4]) -> Option<Interval> {
    let [a, b, c, d] = results;
    let lower = lesser(lesser(a, b), lesser(c, d));
    let upper = greater(greater(a, b), greater(c, d));
    let is_usual = ((a + b) + (c + d)).is_finite() & (lower != 0.0) & (upper != 0.0);
    is_usual.then(|| Interval { lower: below(lower), upper: above(upper) })
}

/// Returns the hull of four results, each computed for one bound of the one interval and one of the other.
#[inline]
fn hull_of_bounds(one: Interval, other: Interval, of: impl Fn(f64, f64) -> Interval) -> Interval {
    of(one.lower, other.lower).hull(of(one.lower, other.upper)).hull(of(one.upper, other.lower)).hull(of(one.upper, other.upper))
}

fn product_of_bounds(a: f64, b: f64) -> Interval {
    // An infinite bound is never attained: times zero it is zero.
    if a == 0.0 || b == 0.0 { Interval::ZERO } else { Interval::outward(a * b, a * b) }
}

fn quotient_of_bounds(a: f64, b: f64) -> Interval {
    let quotient = a / b;
    if a == 0.0 {
        Interval::ZERO
    } else if quotient.is_nan() {
        Interval::ENTIRE
    } else {
        Interval::outward(quotient, quotient)
    }
}

#[inline(never)]
fn unusual_product(one: Interval, other: Interval) -> Interval {
    if one == Interval::ZERO || other == Interval::ZERO { Interval::ZERO } else { hull_of_bounds(one, other, product_of_bounds) }
}

#[inline(never)]
fn unusual_quotient(one: Interval, other: Interval) -> Interval {
    if other.contains(0.0) { Interval::ENTIRE } else { hull_of_bounds(one, other, quotient_of_bounds) }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Interval { lower: -self.upper, upper: -self.lower }
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        around_sums(self.lower + other.lower, self.upper + other.upper)
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        around_sums(self.lower - other.upper, self.upper - other.lower)
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let products = [self.lower * other.lower, self.lower * other.upper, self.upper * other.lower, self.upper * other.upper];
        around(products).unwrap_or_else(|| unusual_product(self, other))
    }
}

impl Inv for Interval {
    type Output = Self;
    #[inline]
    fn inv(self) -> Self {
        let (lower, upper) = (1.0 / self.upper, 1.0 / self.lower);
        // Of one sign, finite and not zero.
        if lower * upper > 0.0 && (lower + upper).is_finite() {
            Interval { lower: below(lower), upper: above(upper) }
        } else {
            unusual_quotient(Interval { lower: 1.0, upper: 1.0 }, self)
        }
    }
}

impl Div for Interval {
    type Output = Self;
    /// Returns all real numbers if the divisor may be zero.
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Interval::ENTIRE;
        }
        let quotients = [self.lower / other.lower, self.lower / other.upper, self.upper / other.lower, self.upper / other.upper];
        around(quotients).unwrap_or_else(|| unusual_quotient(self, other))
    }
}
