//! Operations that a number must support, in three levels.
//!
//! | level | use | scalars |
//! |---|---|---|
//! | [`Field`] | everything that needs only + − × ÷: all of the mechanics | f32, f64, every dual number, rationals, complex numbers, [`Lanes`](lanes::Lanes), [`Interval`](interval::Interval) |
//! | [`Ordered`] | comparing two numbers to select one of two results: the friction limit | all of these except complex numbers |
//! | [`Real`] | angles as input, magnitudes or directions as output | floats, dual numbers, lanes, intervals, symbols |
//! | [`Power`] | in addition to the three: powers with any exponent, for one law of crush | floats, dual numbers |
//!
//! A function requires the lowest level that it needs. The first two are blanket implementations over `num-traits` and `core`, so a number type of another
//! crate needs no additional code.
//!
//! # Design
//!
//! **Why not `Copy`?** Rationals and heap-allocated duals are not. Arguments are taken by value and cloned only if they are used twice; for a `Copy` type
//! that costs nothing.
//!
//! **Why [`Inv`]?** It excludes the integers, which have all four operations, and would silently give a wrong impulse.
//!
//! **Why no `Zero` or `One`?** `is_zero` has no correct result on four lanes or on an interval. Small integers come from [`Field::int`].
//!
//! **Why a mask?** Four lanes compare in four ways at once, and two overlapping intervals cannot be compared at all. A mask that selects works for both: lane
//! by lane, or the hull of both results. A symbol keeps both and the condition.
//!
//! **Why own circular functions?** The sine of the standard library differs between platforms in its last bit. Those of the module `circular` and of `libm`
//! give the same bits everywhere, and for a number the same as for each of many side by side.
//!
//! **Why no decimal literals?** `0.1` is not the same number on every scalar. Measured constants are arguments.

pub(crate) mod circular;
pub mod interval;
#[cfg(feature = "lanes")]
pub mod lanes;
pub(crate) mod logarithm;
pub mod power;
mod predicate;
#[cfg(feature = "symbols")]
pub mod symbol;

pub use power::Power;
#[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
pub(crate) use predicate::rounding_at;
pub(crate) use predicate::{Logic, is_finite, is_positive, is_single, is_zero, rounding, slack, tolerance};

use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{FromPrimitive, Inv};

/// A field: closed under the four operations, and containing the small integers.
///
/// It is implemented for every type that meets its supertraits. Integers do not:
///
/// ```compile_fail,E0277
/// // ½ of 3 kg·m/s would be 1, if integers were allowed:
/// let work = planar_impact::energy::work(3, 1, 0);
/// ```
///
/// ```
/// let work = planar_impact::energy::work(3.0, 1.0, 0.0);
/// assert_eq!(work, -1.5);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a field that the mechanics can be computed in",
    note = "integers are not: use a float, a rational, a dual number, lanes or an interval"
)]
pub trait Field:
    Clone
    + FromPrimitive
    + Neg<Output = Self>
    + Inv<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// Returns the integer `n` as an element of the field.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn int(n: i32) -> Self {
        Self::from_i32(n).expect("every field contains the small integers")
    }

    /// Returns half of it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn half(self) -> Self {
        self * (Self::int(1) / Self::int(2))
    }

    /// Returns its square.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn squared(self) -> Self {
        self.clone() * self
    }
}

impl<T> Field for T where
    T: Clone + FromPrimitive + Neg<Output = T> + Inv<Output = T> + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>
{
}

/// A field whose elements can be compared, with a result that selects.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be compared as the friction limit requires",
    note = "a field that is `PartialOrd` is `Ordered`; a type that compares in several ways at once implements `Ordered` with a mask"
)]
pub trait Ordered: Field {
    /// The result of a comparison: `bool` for one number, a mask for lanes, three-valued for intervals.
    type Mask: Clone;

    /// Returns the mask of `self < other`.
    fn less(&self, other: &Self) -> Self::Mask;

    /// Returns `yes` if the mask is true and `no` otherwise; for an undecided interval the hull of both.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Returns the larger of two: the first if they are equal, and if either is not a number. Of intervals it is sharper than a selection.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn larger(self, other: Self) -> Self {
        Self::select(self.less(&other), other, self)
    }

    /// Returns the smaller of two: the first if they are equal, and if either is not a number. Of intervals it is sharper than a selection.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn smaller(self, other: Self) -> Self {
        Self::select(other.less(&self), other, self)
    }

    /// Returns the absolute value.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn magnitude(self) -> Self {
        let mask = self.less(&Self::int(0));
        Self::select(mask, -self.clone(), self)
    }

    /// Returns the mask of whether it is a finite number.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finite(&self) -> Self::Mask
    where
        Self::Mask: Logic,
    {
        // Zero for every finite number, and NaN for the others.
        let nothing = self.clone() - self.clone();
        nothing.less(&Self::int(1)) & Self::int(-1).less(&nothing)
    }
}

impl<T: Field + PartialOrd> Ordered for T {
    type Mask = bool;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less(&self, other: &Self) -> bool {
        self < other
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

/// An ordered field with the square root and the circular functions.
///
/// Floats and dual numbers have the same bits of sine, cosine and arctangent on every platform (f64 within 4 units of the last place, measured 2.2, f32 from
/// `libm`), and the real part of a dual number is the float.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no angles and magnitudes",
    note = "implement `Real`: a square root, sine and cosine, and the arctangent of two numbers; without them give directions as cosine and sine, or by \
            `from_half_tangent`"
)]
pub trait Real: Ordered {
    /// Returns the square root. At 0 it is 0 without derivatives, which do not exist there.
    fn square_root(self) -> Self;

    /// Returns sine and cosine of an angle in radians.
    fn sin_and_cos(self) -> (Self, Self);

    /// Returns the angle of the direction (`x`, `self`), in [−π, π] with the sign of a zero `self`. For (0, 0) it is that of the floats, without derivatives.
    fn arctangent(self, x: Self) -> Self;
}

/// Functions of a primitive float whose result differs between platforms.
trait Portable: Sized {
    fn portable_sin_cos(self) -> (Self, Self);
    fn portable_atan2(self, x: Self) -> Self;
    #[cfg(feature = "dual")]
    fn portable_pow(self, exponent: Self) -> Self;
    #[cfg(feature = "dual")]
    fn portable_ln(self) -> Self;
}

impl Portable for f64 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn portable_sin_cos(self) -> (Self, Self) {
        circular::sin_cos(self)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn portable_atan2(self, x: Self) -> Self {
        circular::atan2(self, x)
    }

    #[cfg(feature = "dual")]
    fn portable_pow(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }

    #[cfg(feature = "dual")]
    fn portable_ln(self) -> Self {
        libm::log(self)
    }
}

impl Portable for f32 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn portable_sin_cos(self) -> (Self, Self) {
        libm::sincosf(self)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn portable_atan2(self, x: Self) -> Self {
        libm::atan2f(self, x)
    }

    #[cfg(feature = "dual")]
    fn portable_pow(self, exponent: Self) -> Self {
        libm::powf(self, exponent)
    }

    #[cfg(feature = "dual")]
    fn portable_ln(self) -> Self {
        libm::logf(self)
    }
}

#[cfg(feature = "dual")]
mod dual {
    use super::{Portable, Real};
    use num_dual::{DualNum, DualStruct};
    use num_traits::Zero;

    // The bound on the primitive is private on purpose: num-dual has two primitives, and both meet it.
    #[allow(private_bounds)]
    impl<T> Real for T
    where
        T: DualNum + DualStruct<Real = <T as DualNum>::Primitive>,
        <T as DualNum>::Primitive: Portable,
    {
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn square_root(self) -> Self {
            let re = self.re();
            if T::NDERIV > 0 && re.is_zero() {
                return T::from(re);
            }
            DualNum::sqrt(&self)
        }

        /// Applies the addition theorem about the real part: `self` less its real part is exactly zero there, where sine and cosine are exact on every
        /// platform, and carries only the derivatives.
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn sin_and_cos(self) -> (Self, Self) {
            let re = self.re();
            let (sin, cos) = re.portable_sin_cos();
            let (sin, cos) = (T::from(sin), T::from(cos));
            if T::NDERIV == 0 {
                return (sin, cos);
            }
            let (sin_rest, cos_rest) = DualNum::sin_cos(&(self - T::from(re)));
            (sin.clone() * cos_rest.clone() + cos.clone() * sin_rest.clone(), cos * cos_rest - sin * sin_rest)
        }

        /// Adds the angle of the real parts and the angle from there to the full number, which is zero except for its derivatives.
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn arctangent(self, x: Self) -> Self {
            let (y_re, x_re) = (self.re(), x.re());
            let angle = T::from(y_re.portable_atan2(x_re));
            if T::NDERIV == 0 || (y_re.is_zero() && x_re.is_zero()) {
                return angle;
            }
            let (y_re, x_re) = (T::from(y_re), T::from(x_re));
            let across = self.clone() * x_re.clone() - x.clone() * y_re.clone();
            let along = x * x_re + self * y_re;
            angle + DualNum::atan2(&across, along)
        }
    }
}

#[cfg(not(feature = "dual"))]
mod float {
    use super::{Portable, Real};

    macro_rules! real {
        ($float:ty, $sqrt:path) => {
            impl Real for $float {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn square_root(self) -> Self {
                    $sqrt(self)
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn sin_and_cos(self) -> (Self, Self) {
                    self.portable_sin_cos()
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn arctangent(self, x: Self) -> Self {
                    self.portable_atan2(x)
                }
            }
        };
    }
    real!(f32, libm::sqrtf);
    real!(f64, libm::sqrt);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnitude_takes_the_sign_off() {
        assert_eq!((-3.0).magnitude(), 3.0);
        assert_eq!(3.0_f32.magnitude(), 3.0);
    }

    /// Functions of single precision are those of double precision, rounded.
    #[test]
    fn single_precision_rounds_double_precision() {
        let near = |single: f32, double: f64| assert!((f64::from(single) - double).abs() <= 2e-7 * double.abs(), "{single}, {double}");
        for (y, x) in [(1.0_f32, 2.0), (-0.3, 0.7), (0.5, -1.5), (-2.0, -0.1)] {
            near(y.portable_atan2(x), f64::from(y).portable_atan2(x.into()));
            near(y.abs().portable_ln(), f64::from(y.abs()).portable_ln());
            near(y.abs().portable_pow(x), f64::from(y.abs()).portable_pow(x.into()));
        }
    }

    #[test]
    fn half_and_square_are_exact() {
        assert_eq!(3.0.half(), 1.5);
        assert_eq!(1.5.squared(), 2.25);
    }

    #[cfg(feature = "dual")]
    mod dual {
        use super::*;
        use num_dual::{Dual2_64, Dual64, HyperDual64};

        #[test]
        fn real_parts_are_the_bits_of_the_float() {
            for i in -40..40 {
                let a = 0.37 * f64::from(i);
                let (s, c) = Real::sin_and_cos(a);
                let (ds, dc) = Real::sin_and_cos(HyperDual64::from(a).derivative1().derivative2());
                assert_eq!((s.to_bits(), c.to_bits()), (ds.re.to_bits(), dc.re.to_bits()));
                let t = Real::arctangent(s, c);
                let dt = Real::arctangent(ds, dc);
                assert_eq!(t.to_bits(), dt.re.to_bits());
            }
        }

        #[test]
        fn derivatives_of_the_circle() {
            let a = 1.1;
            let (s, c) = Real::sin_and_cos(Dual2_64::new(a, 1.0, 0.0));
            assert!((s.v1 - a.cos()).abs() < 1e-15 && (s.v2 + a.sin()).abs() < 1e-15);
            assert!((c.v1 + a.sin()).abs() < 1e-15 && (c.v2 + a.cos()).abs() < 1e-15);
            let back = Real::arctangent(s, c);
            assert!((back.re - a).abs() < 1e-15 && (back.v1 - 1.0).abs() < 1e-15 && back.v2.abs() < 1e-14);
        }

        #[test]
        fn nested_duals_differentiate_twice() {
            use num_dual::Dual;
            let a = 0.7;
            let x = Dual::new(Dual64::new(a, 1.0), Dual64::new(1.0, 0.0));
            let (s, _) = Real::sin_and_cos(x);
            assert!((s.eps.eps + a.sin()).abs() < 1e-15);
        }
    }
}
