//! Intervals that are guaranteed to contain the exact result.
//!
//! One law: if x ∈ X and y ∈ Y then x ∘ y ∈ X ∘ Y, for each of the four operations, [`Ordered::select`] and the functions of
//! [`Real`](super::Real). Each bound is computed in f64 and then moved outward: by one float where f64 rounds correctly, by the proven error for sine, cosine
//! and arctangent.
//!
//! Enclosures are valid but not always sharp: an argument that occurs twice in a formula counts as two. Comparisons are three-valued ([`Truth`]).

mod arithmetic;
mod circular;
mod truth;

pub use truth::Truth;

use super::Ordered;
use core::fmt;
use num_traits::FromPrimitive;

/// A closed interval of real numbers, possibly unbounded.
///
/// ```
/// use planar_impact::scalar::interval::Interval;
/// let third = Interval::from(1.0) / Interval::from(3.0);
/// assert!(third.contains(1.0 / 3.0) && third.width() < 2e-16);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// Zero.
    pub(crate) const ZERO: Interval = Interval { lower: 0.0, upper: 0.0 };

    /// All real numbers: the enclosure of an unknown result.
    pub const ENTIRE: Interval = Interval { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// Creates an interval from the lower and the upper bound. Returns `None` if they are not in order, are NaN, or contain no real number.
    #[inline]
    pub fn new(lower: f64, upper: f64) -> Option<Self> {
        (lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY).then_some(Interval { lower, upper })
    }

    /// Returns the lower bound.
    #[inline]
    pub fn lower(&self) -> f64 {
        self.lower
    }

    /// Returns the upper bound.
    #[inline]
    pub fn upper(&self) -> f64 {
        self.upper
    }

    /// Returns upper less lower bound, rounded.
    #[inline]
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }

    /// Returns `true` if the number lies in the interval.
    #[inline]
    pub fn contains(&self, x: f64) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// Returns `true` if the other interval lies in this one.
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        self.lower <= other.lower && other.upper <= self.upper
    }

    /// Returns the smallest interval that contains both.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Interval { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// Moves bounds that were rounded to nearest outward.
    #[inline]
    fn outward(lower: f64, upper: f64) -> Self {
        Interval { lower: lower.next_down(), upper: upper.next_up() }
    }
}

impl Default for Interval {
    /// Zero.
    #[inline]
    fn default() -> Self {
        Interval::ZERO
    }
}

impl From<f64> for Interval {
    /// Returns the number alone, or all real numbers if it is not finite.
    #[inline]
    fn from(x: f64) -> Self {
        if x.is_finite() { Interval { lower: x, upper: x } } else { Interval::ENTIRE }
    }
}

impl FromPrimitive for Interval {
    #[inline]
    fn from_i32(n: i32) -> Option<Self> {
        Some(f64::from(n).into())
    }

    #[inline]
    fn from_i64(n: i64) -> Option<Self> {
        let near = n as f64;
        Some(if near as i128 == i128::from(n) { near.into() } else { Interval::outward(near, near) })
    }

    #[inline]
    fn from_u64(n: u64) -> Option<Self> {
        let near = n as f64;
        Some(if near as u128 == u128::from(n) { near.into() } else { Interval::outward(near, near) })
    }

    #[inline]
    fn from_f64(x: f64) -> Option<Self> {
        x.is_finite().then(|| x.into())
    }
}

impl Ordered for Interval {
    /// Not decided if the intervals overlap, so that some pairs are in order and some are not.
    type Mask = Truth;

    #[inline]
    fn less(&self, other: &Self) -> Truth {
        if self.upper < other.lower {
            Truth::TRUE
        } else if other.upper <= self.lower {
            Truth::FALSE
        } else {
            Truth::UNKNOWN
        }
    }

    #[inline]
    fn select(mask: Truth, yes: Self, no: Self) -> Self {
        match mask.decided() {
            Some(true) => yes,
            Some(false) => no,
            None => yes.hull(no),
        }
    }

    #[inline]
    fn larger(self, other: Self) -> Self {
        Interval { lower: self.lower.max(other.lower), upper: self.upper.max(other.upper) }
    }

    #[inline]
    fn smaller(self, other: Self) -> Self {
        Interval { lower: self.lower.min(other.lower), upper: self.upper.min(other.upper) }
    }

    #[inline]
    fn magnitude(self) -> Self {
        if self.lower >= 0.0 {
            self
        } else if self.upper <= 0.0 {
            -self
        } else {
            Interval { lower: 0.0, upper: (-self.lower).max(self.upper) }
        }
    }

    /// Not decided if a bound is infinite: the number may be beyond every float.
    #[inline]
    fn finite(&self) -> Truth {
        if self.lower.is_finite() && self.upper.is_finite() { Truth::TRUE } else { Truth::UNKNOWN }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{}, {}]", self.lower, self.upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lower: f64, upper: f64) -> Interval {
        Interval::new(lower, upper).expect("in order")
    }

    #[test]
    fn bounds_out_of_order_make_no_interval() {
        assert_eq!(Interval::new(1.0, 0.0), None);
        assert_eq!(Interval::new(f64::NAN, 0.0), None);
        assert_eq!(Interval::new(f64::INFINITY, f64::INFINITY), None);
        assert_eq!(Interval::new(f64::NEG_INFINITY, f64::NEG_INFINITY), None);
        assert!(Interval::new(1.0, 1.0).is_some());
    }

    #[test]
    fn rounding_widens() {
        let tenth = Interval::from(1.0) / Interval::from(10.0);
        assert!(tenth.lower() < 0.1 && 0.1 < tenth.upper());
        assert_eq!(tenth.lower(), 0.1_f64.next_down());
        assert_eq!(tenth.upper(), 0.1_f64.next_up());
    }

    #[test]
    fn every_corner_is_enclosed() {
        let bounds = [-3.0, -0.5, 0.0, 0.25, 7.0];
        for (i, &a) in bounds.iter().enumerate() {
            for &b in &bounds[i..] {
                for (j, &c) in bounds.iter().enumerate() {
                    for &d in &bounds[j..] {
                        let (x, y) = (of(a, b), of(c, d));
                        for (p, q) in [(a, c), (a, d), (b, c), (b, d)] {
                            assert!((x + y).contains(p + q));
                            assert!((x - y).contains(p - q));
                            assert!((x * y).contains(p * q));
                            assert!(q == 0.0 || (x / y).contains(p / q));
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn unbounded_operands_bound_what_they_can() {
        let half_line = of(0.0, f64::INFINITY);
        assert!((half_line * of(0.0, 0.0)).contains(0.0));
        assert_eq!((half_line * of(2.0, 3.0)).upper(), f64::INFINITY);
        assert!((half_line * of(2.0, 3.0)).lower() > -1e-300);
        assert_eq!(half_line - half_line, Interval::ENTIRE);
        assert_eq!(of(1.0, 2.0) / of(-1.0, 1.0), Interval::ENTIRE);
        assert_eq!(of(1.0, f64::INFINITY) / of(1.0, f64::INFINITY), Interval::ENTIRE);
        assert_eq!(Interval::from(f64::NAN), Interval::ENTIRE);
        assert_eq!(Interval::from_f64(f64::NAN), None);
    }

    #[test]
    fn overflow_keeps_the_largest_float_below() {
        let big = Interval::from(f64::MAX) + Interval::from(f64::MAX);
        assert_eq!(big, of(f64::MAX, f64::INFINITY));
    }

    #[test]
    fn integers_beyond_the_mantissa_are_enclosed() {
        let n = (1_i64 << 53) + 1;
        let enclosed = Interval::from_i64(n).expect("an integer");
        assert!(enclosed.lower() < enclosed.upper());
        assert!(enclosed.lower() as i64 <= n && n <= enclosed.upper() as i64);
        assert_eq!(Interval::from_u64(7), Some(7.0.into()));
        assert!(Interval::from_u64(u64::MAX).is_some_and(|i| i.width() > 0.0));
    }

    #[test]
    fn an_undecided_comparison_selects_the_hull() {
        let (yes, no) = (Interval::from(1.0), Interval::from(2.0));
        assert_eq!(Interval::select(of(0.0, 2.0).less(&of(1.0, 3.0)), yes, no), of(1.0, 2.0));
        assert_eq!(Interval::select(of(0.0, 1.0).less(&of(2.0, 3.0)), yes, no), yes);
        assert_eq!(Interval::select(of(2.0, 3.0).less(&of(0.0, 2.0)), yes, no), no);
        assert_eq!(of(1.0, 2.0).less(&of(2.0, 3.0)), Truth::UNKNOWN);
        assert_eq!([of(-1.0, 2.0), of(-3.0, 2.0), of(-3.0, -2.0)].map(Ordered::magnitude), [of(0.0, 2.0), of(0.0, 3.0), of(2.0, 3.0)]);
    }

    #[test]
    fn the_larger_and_the_smaller_of_what_is_not_in_order_are_sharp() {
        let (one, other) = (of(-1.0, 4.0), of(0.0, 2.0));
        assert_eq!([one.larger(other), other.larger(one)], [of(0.0, 4.0); 2]);
        assert_eq!([one.smaller(other), other.smaller(one)], [of(-1.0, 2.0); 2]);
    }

    #[test]
    fn roots() {
        assert_eq!(of(-2.0, -1.0).sqrt(), None);
        let root = of(-1.0, 4.0).sqrt().expect("4 has a root");
        assert!(root.contains(0.0) && root.contains(2.0) && root.lower() == 0.0);
        assert!(of(0.0, 1.0).encloses(&of(0.5, 1.0)) && !of(0.0, 1.0).encloses(&of(0.5, 1.5)));
    }
}
