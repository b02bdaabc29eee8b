//! Numbers that record a division by zero.

use core::ops::{Add, Div, Mul, Neg, Sub};

use num_rational::BigRational;
use num_traits::{FromPrimitive, Inv, Zero};

/// A type that can be added and multiplied, and in part inverted.
pub trait Ring: Clone + FromPrimitive + Neg<Output = Self> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Returns its inverse, if it has one.
    fn inverse(self) -> Option<Self>;
}

impl Ring for BigRational {
    fn inverse(self) -> Option<Self> {
        (!self.is_zero()).then(|| self.recip())
    }
}

/// A number, or undefined after a division by zero. Every operation on an undefined number is undefined.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Partial<T>(Option<T>);

impl<T> Partial<T> {
    /// Creates a defined number.
    pub const fn defined(value: T) -> Self {
        Partial(Some(value))
    }

    /// Returns the number, unless it is undefined.
    pub const fn value(&self) -> Option<&T> {
        self.0.as_ref()
    }
}

impl<T: Ring> FromPrimitive for Partial<T> {
    fn from_i64(n: i64) -> Option<Self> {
        T::from_i64(n).map(Partial::defined)
    }

    fn from_u64(n: u64) -> Option<Self> {
        T::from_u64(n).map(Partial::defined)
    }
}

impl<T: Ring> Neg for Partial<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Partial(self.0.map(Neg::neg))
    }
}

impl<T: Ring> Inv for Partial<T> {
    type Output = Self;
    fn inv(self) -> Self {
        Partial(self.0.and_then(Ring::inverse))
    }
}

macro_rules! both_defined {
    ($operation:ident, $method:ident) => {
        impl<T: Ring> $operation for Partial<T> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Partial(self.0.zip(other.0).map(|(a, b)| a.$method(b)))
            }
        }
    };
}
both_defined!(Add, add);
both_defined!(Sub, sub);
both_defined!(Mul, mul);

impl<T: Ring> Div for Partial<T> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "a quotient is the product with the inverse")]
    fn div(self, other: Self) -> Self {
        self * other.inv()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;
    use planar_impact::Field;

    #[test]
    fn nothing_leads_back_from_a_division_by_zero() {
        let (zero, two) = (Rational::int(0), Rational::int(2));
        assert_eq!((two.clone() / zero.clone()).value(), None);
        assert_eq!((zero.clone() * zero.clone().inv()).value(), None);
        assert_eq!((-(two.clone() - zero.clone().inv())).value(), None);
        assert_eq!(two.clone() * two.clone().inv() - Rational::int(1), zero);
    }
}
