//! A number with bounds on its distance from the quantity it represents.
//!
//! A further scalar for the mechanics, with affine arithmetic. Each input i that has a resolution u_i varies as x_i + u_i ε_i with |ε_i| ≤ 1, and a result is
//!
//! ```text
//! value + Σ spread_i ε_i ± rest
//! ```
//!
//! The spreads are u_i times the exact partial derivatives, so an input that occurs twice in a formula cancels correctly; the rest bounds everything of
//! second order. The bound is therefore never too narrow, and too wide only to second order.
//!
//! `size` is the same formula with the magnitudes of all terms added up, to first order in what a difference has lost; rounding is a share of it.

use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{FromPrimitive, Inv};

/// The largest share of a size that is taken for its rounding: that of single precision.
const COARSEST: f64 = 1e-6;

/// A number that depends on N inputs with a resolution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uncertain<const N: usize> {
    /// The value computed from the nominal inputs.
    pub(super) value: f64,
    /// The sum of the magnitudes of its terms.
    pub(super) size: f64,
    /// Change of the value by each input, within its resolution.
    pub(super) spread: [f64; N],
    /// Bound on the second-order changes by all inputs together.
    pub(super) rest: f64,
}

impl<const N: usize> Uncertain<N> {
    /// Returns the mean of two.
    pub(super) fn mean(self, other: Self) -> Self {
        (self + other).scaled(0.5)
    }

    /// Creates an exact number.
    pub(super) fn exact(value: f64) -> Self {
        Uncertain { value, size: value.abs(), spread: [0.0; N], rest: 0.0 }
    }

    /// Creates an input in a slot, with its resolution. A slot beyond N discards the resolution, which must then be zero.
    pub(super) fn input(value: f64, place: usize, resolution: f64) -> Self {
        let mut made = Self::exact(value);
        if let Some(spread) = made.spread.get_mut(place) {
            *spread = resolution;
        }
        made
    }

    /// Returns the largest change of the value by all inputs together.
    pub(super) fn radius(&self) -> f64 {
        self.spread.iter().fold(self.rest, |sum, spread| sum + spread.abs())
    }

    /// Returns `true` for zero itself, without a resolution.
    pub(super) fn is_zero(&self) -> bool {
        self.value == 0.0 && self.radius() == 0.0
    }

    /// Returns three standard uncertainties, for resolutions that are standard uncertainties of independent inputs.
    pub(super) fn three_sigma(&self) -> f64 {
        let variance = self.spread.iter().fold(0.0, |sum, spread| sum + spread * spread);
        // The rest is a bound for changes of one resolution each; being of second order, it grows with the square.
        3.0 * libm::sqrt(variance) + 9.0 * self.rest
    }

    /// Returns its magnitude: the number with the sign of its value, which is less by up to twice what lies beyond zero, within the resolution or, of which a
    /// ninth counts, within three standard uncertainties.
    pub(super) fn magnitude(self) -> Self {
        let (size, radius) = (self.value.abs(), self.radius());
        let beyond = (radius - size).max((3.0 * radius - size) / 9.0).max(0.0);
        let signed = if self.value < 0.0 { -self } else { self };
        Uncertain { rest: signed.rest + 2.0 * beyond, ..signed }
    }

    /// Multiplies by an exact factor.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.value *= factor;
        self.size *= factor.abs();
        self.spread.iter_mut().for_each(|spread| *spread *= factor);
        self.rest *= factor.abs();
        self
    }

    /// Applies a function with the value `value`, the derivative `slope` and, over the whole range, a second derivative within `curvature`.
    pub(super) fn through(self, value: f64, slope: f64, curvature: f64) -> Self {
        let radius = self.radius();
        let scaled = self.scaled(slope);
        Uncertain { value, size: scaled.size + value.abs(), rest: scaled.rest + 0.5 * curvature * radius * radius, ..scaled }
    }
}

impl<const N: usize> FromPrimitive for Uncertain<N> {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Self::exact(n as f64))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Self::exact(n as f64))
    }

    fn from_f64(x: f64) -> Option<Self> {
        Some(Self::exact(x))
    }
}

impl<const N: usize> Neg for Uncertain<N> {
    type Output = Self;
    fn neg(mut self) -> Self {
        self.value = -self.value;
        self.spread.iter_mut().for_each(|spread| *spread = -*spread);
        self
    }
}

impl<const N: usize> Add for Uncertain<N> {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self.value += other.value;
        self.size += other.size;
        for (spread, more) in self.spread.iter_mut().zip(&other.spread) {
            *spread += more;
        }
        self.rest += other.rest;
        self
    }
}

impl<const N: usize> Sub for Uncertain<N> {
    type Output = Self;
    fn sub(mut self, other: Self) -> Self {
        self.value -= other.value;
        self.size += other.size;
        for (spread, less) in self.spread.iter_mut().zip(&other.spread) {
            *spread -= less;
        }
        self.rest += other.rest;
        self
    }
}

impl<const N: usize> Mul for Uncertain<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let second_order = if N == 0 { 0.0 } else { self.radius() * other.radius() };
        let mut product = self;
        product.value = a * b;
        // What each factor has lost by cancelling is rounded once with the other factor, and both losses together only to second order: bodies far from the
        // origin have short arms.
        let (lost, also_lost) = (self.size - a.abs(), other.size - b.abs());
        product.size = self.size * other.size - if lost > 0.0 && also_lost > 0.0 { (1.0 - COARSEST) * lost * also_lost } else { 0.0 };
        for (spread, more) in product.spread.iter_mut().zip(&other.spread) {
            *spread = *spread * b + more * a;
        }
        product.rest = self.rest * b.abs() + other.rest * a.abs() + second_order;
        product
    }
}

impl<const N: usize> Inv for Uncertain<N> {
    type Output = Self;
    /// Returns the reciprocal, with an unbounded rest if the number may be zero.
    fn inv(self) -> Self {
        let value = 1.0 / self.value;
        let least = self.value.abs() - self.radius();
        let curvature = if least > 0.0 { 2.0 / (least * least * least) } else { f64::INFINITY };
        let mut inverse = self.through(value, -value * value, if self.radius() > 0.0 { curvature } else { 0.0 });
        inverse.size = self.size * value * value;
        inverse
    }
}

impl<const N: usize> Div for Uncertain<N> {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the inverse has the bound of a quotient")]
    fn div(self, other: Self) -> Self {
        self * other.inv()
    }
}

/// Returns the more precise of two.
pub(super) fn sharper<T>(a: T, b: T, radius: impl Fn(&T) -> f64) -> T {
    if radius(&b) < radius(&a) { b } else { a }
}

/// Returns the more precise of two, either of which may be missing.
pub(super) fn sharper_known<T>(a: Option<T>, b: Option<T>, radius: impl Fn(&T) -> f64) -> Option<T> {
    match (a, b) {
        (Some(a), Some(b)) => Some(sharper(a, b, radius)),
        (a, b) => a.or(b),
    }
}

/// Returns the more precise of two measurements of one thing, either of which may be missing, or the mean of two that are equally precise, so that neither comes
/// first.
pub(super) fn best_known<T>(a: Option<T>, b: Option<T>, radius: impl Fn(&T) -> f64, mean: impl FnOnce(T, T) -> T) -> Option<T> {
    match (a, b) {
        (Some(a), Some(b)) if radius(&a) == radius(&b) => Some(mean(a, b)),
        (a, b) => sharper_known(a, b, radius),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Two = Uncertain<2>;

    fn pair(x: f64, dx: f64, y: f64, dy: f64) -> (Two, Two) {
        (Two::input(x, 0, dx), Two::input(y, 1, dy))
    }

    /// Checks that every corner and many points in between lie within the bound, and that the bound is of first order.
    #[track_caller]
    fn holds(formula: fn(Two, Two) -> Two, plain: fn(f64, f64) -> f64, x: f64, dx: f64, y: f64, dy: f64) {
        let (a, b) = pair(x, dx, y, dy);
        let result = formula(a, b);
        assert_eq!(result.value, plain(x, y));
        let mut farthest = 0.0_f64;
        for i in -10..=10 {
            for j in -10..=10 {
                let moved = plain(x + dx * f64::from(i) / 10.0, y + dy * f64::from(j) / 10.0);
                farthest = farthest.max((moved - result.value).abs());
            }
        }
        let radius = result.radius();
        assert!(farthest <= radius * (1.0 + 1e-12) + 1e-14, "{farthest} beyond {radius}");
        assert!(farthest >= 0.7 * radius, "{farthest} far within {radius}");
    }

    #[test]
    fn bounds_hold_and_are_sharp() {
        for (dx, dy) in [(0.1, 0.0), (0.0, 0.2), (0.1, 0.2), (1e-6, 1e-3)] {
            holds(|x, y| x * y, |x, y| x * y, 3.0, dx, -7.0, dy);
            holds(|x, y| x / y, |x, y| x * (1.0 / y), 3.0, dx, -7.0, dy);
            holds(|x, y| x * x - y, |x, y| x * x - y, 3.0, dx, -7.0, dy);
            holds(|x, y| (x - y) * (x + y), |x, y| (x - y) * (x + y), 3.0, dx, -7.0, dy);
        }
    }

    #[test]
    fn an_input_cancels_where_it_should() {
        let (x, y) = pair(3.0, 0.1, 2.0, 0.1);
        assert_eq!((x - x).radius(), 0.0);
        let zero = (x + y) * (x - y) - (x * x - y * y);
        // The first order cancels; the second remains.
        assert!(zero.radius() < 10.0 * 0.1 * 0.1, "{zero:?}");
    }

    #[test]
    fn of_the_inverse_of_what_may_be_zero_nothing_is_known() {
        let (x, _) = pair(0.1, 0.2, 0.0, 0.0);
        assert_eq!(x.inv().radius(), f64::INFINITY);
        assert_eq!(Two::exact(0.1).inv().radius(), 0.0);
    }

    #[test]
    fn the_size_of_a_difference_is_that_of_its_terms() {
        let (x, y) = pair(1e6, 0.0, 1e6, 0.0);
        let difference = x - y;
        assert_eq!((difference.value, difference.size), (0.0, 2e6));
        assert_eq!((difference * y).size, 2e12);
        // (0 ± ε 2e6)²: of second order.
        assert!((difference * difference).size <= 1.0001e-6 * 4e12, "{:?}", difference * difference);
        // (1 ± ε (2e6 + 1)) squared is 1 ± ε (4e6 + 1).
        let one = difference + Two::exact(1.0);
        assert!(((one * one).size / (4e6 + 1.0) - 1.0).abs() < 1.1, "{:?}", one * one);
        assert_eq!(y.inv().size, 1e-6);
    }

    /// Compares value, size, spreads and rest with numbers by hand, exact in binary.
    #[track_caller]
    fn is(number: Two, value: f64, size: f64, spread: [f64; 2], rest: f64) {
        assert_eq!((number.value, number.size, number.spread, number.rest), (value, size, spread, rest));
    }

    #[test]
    fn second_order_is_counted_by_hand() {
        let (x, y) = pair(3.0, 0.5, -2.0, 0.25);
        let product = x * y;
        is(product, -6.0, 6.0, [-1.0, 0.75], 0.125);
        is(product * y, 12.0, 12.0, [2.0, -3.0], 0.125 * 2.0 + 1.875 * 0.25);
        is(y * product, 12.0, 12.0, [2.0, -3.0], 0.125 * 2.0 + 1.875 * 0.25);
        is(-product, 6.0, 6.0, [1.0, -0.75], 0.125);
        is(product.magnitude(), 6.0, 6.0, [1.0, -0.75], 0.125);
        is(x.magnitude(), 3.0, 3.0, [0.5, 0.0], 0.0);
        // Within its resolution −3 ± 5 is from −8 to 2, and its magnitude up to 4 more than the number with the other sign; 3 ± 2 is from −3 to 9 within three.
        is(pair(-3.0, 5.0, 0.0, 0.0).0.magnitude(), 3.0, 3.0, [-5.0, 0.0], 4.0);
        is(pair(3.0, 2.0, 0.0, 0.0).0.magnitude(), 3.0, 3.0, [2.0, 0.0], 2.0 / 3.0);
        is(product.scaled(-2.0), 12.0, 12.0, [2.0, -1.5], 0.25);
        is(product + x, -3.0, 9.0, [-0.5, 0.75], 0.125);
        is(x - product, 9.0, 9.0, [1.5, -0.75], 0.125);
        is(product - product, 0.0, 12.0, [0.0, 0.0], 0.25);
        is(product + product, -12.0, 12.0, [-2.0, 1.5], 0.25);
        is(x.through(7.0, -2.0, 4.0), 7.0, 13.0, [-1.0, 0.0], 0.5);
        is(product.through(7.0, -2.0, 4.0), 7.0, 19.0, [2.0, -1.5], 0.25 + 2.0 * 1.875 * 1.875);
        assert_eq!((product.radius(), x.radius()), (1.875, 0.5));
    }

    #[test]
    fn a_reciprocal_is_bounded_by_its_curvature_at_the_near_end() {
        let (x, _) = pair(2.0, 0.5, 0.0, 0.0);
        // 1/x has the slope −1/4 and at most the second derivative 2/1.5³.
        let inverse = x.inv();
        is(inverse, 0.5, 0.5, [-0.125, 0.0], 0.5 * (2.0 / (1.5 * 1.5 * 1.5)) * 0.25);
        let negative = (-x).inv();
        is(negative, -0.5, 0.5, [0.125, 0.0], inverse.rest);
        // A resolution as large as the number itself.
        assert_eq!(Two::input(0.5, 0, 0.5).inv().rest, f64::INFINITY);
    }

    #[test]
    fn the_more_precise_of_two_is_the_first_if_both_are() {
        let (fine, coarse) = (Two::input(1.0, 0, 0.1), Two::input(2.0, 0, 0.2));
        let of = |a, b| sharper(a, b, Two::radius).value;
        assert_eq!((of(fine, coarse), of(coarse, fine), of(fine, Two::input(3.0, 1, 0.1))), (1.0, 1.0, 1.0));
        assert_eq!(sharper_known(None, Some(fine), Two::radius).map(|x| x.value), Some(1.0));
        assert_eq!(sharper_known(Some(coarse), Some(fine), Two::radius).map(|x| x.value), Some(1.0));
        assert!(sharper_known(None, None, Two::radius).is_none());
        let best = |a, b| best_known(Some(a), Some(b), Two::radius, Two::mean).map(|x| x.value);
        assert_eq!([best(coarse, fine), best(fine, coarse), best(Two::exact(1.0), Two::exact(4.0))], [1.0, 1.0, 2.5].map(Some));
    }

    #[test]
    fn an_exact_number_has_no_second_order_and_a_slot_beyond_the_last_none() {
        let (x, y) = (Uncertain::<0>::input(3.0, 5, 0.0), Uncertain::<0>::exact(-2.0));
        assert_eq!(((x * y).rest, (x * y).radius(), x.size, y.size), (0.0, 0.0, 3.0, 2.0));
    }

    #[test]
    fn standard_uncertainties_add_in_squares() {
        let (x, y) = pair(0.0, 3.0, 0.0, 4.0);
        assert_eq!(((x + y).radius(), (x + y).three_sigma()), (7.0, 15.0));
        // The second order of a product, 12 within one resolution, is nine times that within three.
        assert_eq!((x + y + x * y).three_sigma(), 15.0 + 9.0 * 12.0);
    }
}
