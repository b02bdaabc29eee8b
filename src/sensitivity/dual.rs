//! A number with one derivative, on any scalar: the definition of a derivative needs no other crate, and nested in itself it has second derivatives.

use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{FromPrimitive, Inv};

use crate::scalar::{Logic, Ordered, Real, is_zero};

/// A dual number.
///
/// On intervals it encloses a function and its derivative over a box. Where a comparison is not decided it has the hull of both derivatives: for a function
/// that is continuous there, an enclosure of its generalized gradient, so that the mean value theorem holds. It says nothing of a function that jumps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<T> {
    pub(crate) value: T,
    pub(crate) derivative: T,
}

impl<T: Real> Dual<T> {
    pub(crate) fn constant(value: T) -> Self {
        Dual { value, derivative: T::int(0) }
    }
}

impl<T: Real + From<f64>> From<f64> for Dual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from(value: f64) -> Self {
        Dual::constant(T::from(value))
    }
}

impl<T: Real + Copy> Add for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, derivative: self.derivative + other.derivative }
    }
}

impl<T: Real + Copy> Sub for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, derivative: self.derivative - other.derivative }
    }
}

impl<T: Real + Copy> Mul for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        Dual { value: self.value * other.value, derivative: self.derivative * other.value + self.value * other.derivative }
    }
}

impl<T: Real + Copy> Div for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual { value, derivative: (self.derivative - value * other.derivative) / other.value }
    }
}

impl<T: Real + Copy> Neg for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Dual { value: -self.value, derivative: -self.derivative }
    }
}

impl<T: Real + Copy> Inv for Dual<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inv(self) -> Self {
        let value = self.value.inv();
        Dual { value, derivative: -(self.derivative * value * value) }
    }
}

impl<T: Real> FromPrimitive for Dual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i64(n: i64) -> Option<Self> {
        T::from_i64(n).map(Dual::constant)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_u64(n: u64) -> Option<Self> {
        T::from_u64(n).map(Dual::constant)
    }
}

impl<T: Real<Mask: Logic> + Copy> Ordered for Dual<T> {
    type Mask = T::Mask;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less(&self, other: &Self) -> T::Mask {
        self.value.less(&other.value)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Dual { value: T::select(mask, yes.value, no.value), derivative: T::select(mask, yes.derivative, no.derivative) }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn larger(self, other: Self) -> Self {
        let derivative = T::select(self.less(&other), other.derivative, self.derivative);
        Dual { value: self.value.larger(other.value), derivative }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn smaller(self, other: Self) -> Self {
        let derivative = T::select(other.less(&self), other.derivative, self.derivative);
        Dual { value: self.value.smaller(other.value), derivative }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finite(&self) -> T::Mask {
        self.value.finite()
    }
}

impl<T: Real<Mask: Logic> + Copy> Real for Dual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn square_root(self) -> Self {
        let value = self.value.square_root();
        Dual { value, derivative: T::select(is_zero(&value), T::int(0), self.derivative.half() / value) }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_and_cos();
        (Dual { value: sin, derivative: cos * self.derivative }, Dual { value: cos, derivative: -(sin * self.derivative) })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arctangent(self, x: Self) -> Self {
        let is_at_origin = is_zero(&self.value) & is_zero(&x.value);
        // Of the magnitudes, whose squares are not negative on an interval either.
        let length_squared = self.value.magnitude().squared() + x.value.magnitude().squared();
        let derivative = (self.derivative * x.value - x.derivative * self.value) / length_squared;
        Dual { value: self.value.arctangent(x.value), derivative: T::select(is_at_origin, T::int(0), derivative) }
    }
}

#[cfg(test)]
#[cfg(feature = "dual")]
mod tests {
    use super::*;
    use crate::scalar::Field;
    use num_dual::{DualNum, HyperDual64};

    /// Nested: the value with both derivatives and the mixed one, in the order of num-dual.
    fn parts(x: Dual<Dual<f64>>) -> [f64; 4] {
        [x.value.value, x.derivative.value, x.value.derivative, x.derivative.derivative]
    }

    #[test]
    fn each_operation_is_that_of_num_dual() {
        let nested =
            |re, eps1, eps2, both| Dual { value: Dual { value: re, derivative: eps2 }, derivative: Dual { value: eps1, derivative: both } };
        for i in -20..20 {
            let x = 0.37 * f64::from(i) + 0.1;
            let [a, b] = [nested(x, 1.0, 0.5, -0.25), nested(2.5 - x, -3.0, 2.0, 0.75)];
            let [c, d] = [HyperDual64::new(x, 1.0, 0.5, -0.25), HyperDual64::new(2.5 - x, -3.0, 2.0, 0.75)];
            let root = |x: f64| if x > 0.0 { 1.0 } else { -1.0 };
            let [s, t] = [Dual::int(root(x) as i32), Dual::int(root(2.5 - x) as i32)];
            let pairs = [
                (a + b, c + d),
                (a - b, c - d),
                (a * b, c * d),
                (a / b, c / d),
                (-a, -c),
                (a.inv(), c.recip()),
                ((a * s).square_root(), Real::square_root(c * root(x))),
                (a.sin_and_cos().0, c.sin()),
                (a.sin_and_cos().1, c.cos()),
                (a.arctangent(b * t), Real::arctangent(c, d * root(2.5 - x))),
                (Ordered::magnitude(a), Ordered::magnitude(c)),
            ];
            for (number, (own, other)) in pairs.into_iter().enumerate() {
                let other = [other.re, other.eps1, other.eps2, other.eps1eps2];
                let size = other.iter().fold(1.0, |size: f64, part| size.max(part.abs()));
                for (own, other) in parts(own).into_iter().zip(other) {
                    assert!((own - other).abs() <= 1e-13 * size, "operation {number} at {x}: {own}, {other}");
                }
            }
        }
    }

    #[test]
    fn on_intervals_a_derivative_encloses_that_at_every_point() {
        use crate::scalar::interval::Interval;
        let of = |lower, upper| Interval::new(lower, upper).expect("in order");
        let seeded = |lower, upper| Dual { value: of(lower, upper), derivative: Interval::from(1.0) };
        let points = |range: Interval| (0..=20).map(move |i| range.lower() + range.width() * f64::from(i) / 20.0);
        // Across the cut behind, across an axis, and in a quadrant. The derivative has no cut, and is narrow away from the origin.
        for (y, x) in [((-0.5, 0.5), (-3.0, -2.0)), ((1.0, 2.0), (-1.0, 1.0)), ((1.0, 2.0), (1.0, 1.0))] {
            let (y, x) = (seeded(y.0, y.1), of(x.0, x.1));
            let by_y = y.arctangent(Dual::constant(x)).derivative;
            assert!(by_y.width() < 2.1, "{by_y}");
            for (y, x) in points(y.value).flat_map(|y| points(x).map(move |x| (y, x))) {
                assert!(by_y.contains(x / (x * x + y * y)), "at {y}, {x}: {by_y}");
            }
        }
        assert_eq!(seeded(-1.0, 1.0).arctangent(Dual::constant(of(-1.0, 1.0))).derivative, Interval::ENTIRE);
        assert_eq!(seeded(0.0, 1.0).square_root().derivative, Interval::ENTIRE);
        let root = seeded(1.0, 4.0).square_root().derivative;
        assert!(root.contains(0.5) && root.contains(0.25) && root.width() < 0.26, "{root}");
        // A comparison that is not decided has both derivatives.
        assert_eq!(seeded(-1.0, 2.0).magnitude().derivative, of(-1.0, 1.0));
        assert_eq!(seeded(1.0, 2.0).magnitude().derivative, of(1.0, 1.0));
    }

    #[test]
    fn there_are_no_derivatives_at_a_root_of_zero_and_an_angle_of_nothing() {
        let zero = Dual { value: 0.0, derivative: 1.0 };
        assert_eq!((zero.square_root().value, zero.square_root().derivative), (0.0, 0.0));
        assert_eq!((zero.arctangent(zero).value, zero.arctangent(zero).derivative), (0.0, 0.0));
    }
}
