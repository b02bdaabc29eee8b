//! Square root, sine, cosine and arctangent of intervals.
//!
//! The floats of [`circular`](crate::scalar::circular) have a proven error of at most 4 units of the last place, which is less than 2⁻⁵⁰ of the result: each
//! bound is moved outward by that much and one float more. Beyond the range of that proof sine and cosine are in [−1, 1] and an angle is in [−π, π].

use super::Interval;
use super::arithmetic::{above, below};
use crate::scalar::{Real, circular};
use core::f64::consts::FRAC_2_PI;

/// More than the error of a circular function relative to its result: 4 units of the last place are at most 2⁻⁵⁰ of it.
const ERROR: f64 = 8.881_784_197_001_252e-16;

/// More than the error of x · 2/π ± this number for a magnitude of at most [`circular::LARGEST_ANGLE`]: the product is at most 63 662, and the constant, the
/// product and the sum round by less than 2⁻⁵³ of it each. An angle so near a multiple of π/2 has the sine or the cosine 1 to within 10⁻²⁰.
const ERROR_IN_QUADRANTS: f64 = 1e-10;

/// Every angle in [−π, π]; the float π is below π.
const ALL_ANGLES: Interval = Interval { lower: -PI_ABOVE, upper: PI_ABOVE };
const PI_ABOVE: f64 = 3.141_592_653_589_793_6;

/// Sines and cosines of all angles.
const ALL_SINES: Interval = Interval { lower: -1.0, upper: 1.0 };

/// Coordinates below this magnitude are doubled so many times that none of them is subnormal.
const SMALL: f64 = 1e-200;
const DOUBLED: f64 = 1.606_938_044_258_990_3e60; // 2²⁰⁰

/// Returns a number below and one above the exact result of a circular function, given the computed one.
#[inline]
fn around(computed: f64) -> (f64, f64) {
    let error = computed.abs() * ERROR;
    ((computed - error).next_down(), (computed + error).next_up())
}

/// Returns sine and cosine of every angle between two of which the sines and cosines are given, where n is the number of the first multiple of π/2 that may
/// lie between them or at one of them, and `count` how many may.
fn hull_of_quadrants(ends: [Interval; 2], first: i64, count: i64) -> [Interval; 2] {
    let [mut sin, mut cos] = ends;
    for n in first..first + count.min(4) {
        // Extremes, in order: cosine 1, sine 1, cosine −1, sine −1.
        match n.rem_euclid(4) {
            0 => cos.upper = 1.0,
            1 => sin.upper = 1.0,
            2 => cos.lower = -1.0,
            _ => sin.lower = -1.0,
        }
    }
    [sin, cos]
}

fn sine_and_cosine(angle: Interval) -> [Interval; 2] {
    let is_within = circular::is_within(angle.lower, circular::LARGEST_ANGLE) && circular::is_within(angle.upper, circular::LARGEST_ANGLE);
    if !is_within {
        return [ALL_SINES; 2];
    }
    let (sin, cos) = circular::sin_cos_within(angle.lower);
    // Only the sine of zero is zero.
    let around_sine = |sin: f64| if sin == 0.0 { (0.0, 0.0) } else { around(sin) };
    let (near_sin, near_cos) = (around_sine(sin), around(cos));
    let ends = if angle.lower == angle.upper {
        [near_sin, near_cos].map(|(lower, upper)| Interval { lower, upper })
    } else {
        let (sin, cos) = circular::sin_cos_within(angle.upper);
        let hull = |one: (f64, f64), other: (f64, f64)| Interval { lower: one.0.min(other.0), upper: one.1.max(other.1) };
        [hull(near_sin, around_sine(sin)), hull(near_cos, around(cos))]
    };
    // A multiple of π/2 so near an end that it cannot be decided on which side counts as between.
    let first = libm::ceil(angle.lower * FRAC_2_PI - ERROR_IN_QUADRANTS);
    let last = libm::floor(angle.upper * FRAC_2_PI + ERROR_IN_QUADRANTS);
    let ends = if first <= last { hull_of_quadrants(ends, first as i64, (last - first) as i64 + 1) } else { ends };
    ends.map(|values| Interval { lower: values.lower.max(-1.0), upper: values.upper.min(1.0) })
}

/// Returns a number below and one above the angle of a direction that is not zero, both finite and within the range of the proof.
#[inline]
fn angle_around(y: f64, x: f64) -> (f64, f64) {
    let is_small = y.abs() < SMALL && x.abs() < SMALL;
    // By a power of two, which is exact.
    let (y, x) = if is_small { (y * DOUBLED, x * DOUBLED) } else { (y, x) };
    // A negative zero would count as just below the cut.
    around(circular::atan2_within(y + 0.0, x + 0.0))
}

fn angle(y: Interval, x: Interval) -> Interval {
    let limit = circular::LARGEST_COORDINATE;
    let is_within = [y.lower, y.upper, x.lower, x.upper].into_iter().all(|bound| circular::is_within(bound, limit));
    let meets_cut = x.lower < 0.0 && y.lower < 0.0 && y.upper >= 0.0;
    if !is_within || meets_cut || (y.contains(0.0) && x.contains(0.0)) {
        return ALL_ANGLES;
    }
    if y.upper <= 0.0 && y.lower < 0.0 {
        return -angle_above(-y, x);
    }
    angle_above(y, x)
}

/// Returns the angles of directions that do not reach below the axis, unless all of them are ahead.
#[inline]
fn angle_above(y: Interval, x: Interval) -> Interval {
    // The angle falls with x above the axis, rises with y ahead and falls with it behind.
    let (first, last) = if y.lower >= 0.0 {
        let at_first = if x.upper > 0.0 { y.lower } else { y.upper };
        let at_last = if x.lower > 0.0 { y.upper } else { y.lower };
        ((at_first, x.upper), (at_last, x.lower))
    } else {
        ((y.lower, x.lower), (y.upper, x.lower))
    };
    let (lower, _) = angle_around(first.0, first.1);
    let (_, upper) = angle_around(last.0, last.1);
    Interval { lower: lower.max(-PI_ABOVE), upper: upper.min(PI_ABOVE) }
}

impl Interval {
    /// Returns the square roots of its numbers that have one, or `None` if none has.
    #[inline]
    pub fn sqrt(self) -> Option<Self> {
        (self.upper >= 0.0).then(|| {
            let lower = if self.lower > 0.0 { below(libm::sqrt(self.lower)) } else { 0.0 };
            let upper = libm::sqrt(self.upper);
            Interval { lower, upper: if upper.is_finite() { above(upper) } else { upper } }
        })
    }
}

impl Real for Interval {
    /// Returns the square roots of its numbers that have one, as [`Interval::sqrt`], and all real numbers if none has: that is no result, as NaN is for a float.
    #[inline]
    fn square_root(self) -> Self {
        self.sqrt().unwrap_or(Interval::ENTIRE)
    }

    #[inline]
    fn sin_and_cos(self) -> (Self, Self) {
        let [sin, cos] = sine_and_cosine(self);
        (sin, cos)
    }

    /// Returns the angles of all directions, [−π, π] if zero or the cut behind it is among them. The cut belongs to the angle π; zero here is the number, which
    /// has no sign.
    #[inline]
    fn arctangent(self, x: Self) -> Self {
        angle(self, x)
    }
}
