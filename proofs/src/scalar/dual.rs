//! A value and its derivative, over any field.

use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{FromPrimitive, Inv};
use planar_impact::Field;

/// a + a′ε with ε² = 0: a value and its derivative with respect to one variable. The rules of differentiation are the
/// rules of calculating with ε.
///
/// num-dual requires an ordered field; this type accepts any field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub re: T,
    /// Its derivative.
    pub eps: T,
}

impl<T: Field> Dual<T> {
    /// Creates a value that does not depend on the variable.
    pub fn constant(value: T) -> Self {
        Dual { re: value, eps: T::int(0) }
    }

    /// Creates the variable itself.
    pub fn variable(value: T) -> Self {
        Dual { re: value, eps: T::int(1) }
    }
}

impl<T: Field> FromPrimitive for Dual<T> {
    fn from_i64(n: i64) -> Option<Self> {
        T::from_i64(n).map(Dual::constant)
    }

    fn from_u64(n: u64) -> Option<Self> {
        T::from_u64(n).map(Dual::constant)
    }
}

impl<T: Field> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { re: -self.re, eps: -self.eps }
    }
}

impl<T: Field> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { re: self.re + other.re, eps: self.eps + other.eps }
    }
}

impl<T: Field> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { re: self.re - other.re, eps: self.eps - other.eps }
    }
}

impl<T: Field> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Dual { re: self.re.clone() * other.re.clone(), eps: self.eps * other.re + self.re * other.eps }
    }
}

impl<T: Field> Inv for Dual<T> {
    type Output = Self;
    /// (1/a)′ = −a′/a².
    fn inv(self) -> Self {
        let re = self.re.inv();
        Dual { eps: -(self.eps * re.clone().squared()), re }
    }
}

impl<T: Field> Div for Dual<T> {
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

    #[test]
    fn derivatives_of_a_quotient() {
        // (x² − 1)/(3x): value 4/3 − 1/12, derivative 1/3 + 1/(3x²) at x = 4.
        let int = Dual::<Rational>::int;
        let x = Dual::variable(Rational::int(4));
        let y = (x.clone().squared() - int(1)) / (int(3) * x.clone());
        assert_eq!(y.re, Rational::int(5) / Rational::int(4));
        assert_eq!(y.eps, Rational::int(17) / Rational::int(48));
        assert_eq!((-x).eps, Rational::int(-1));
    }

    #[test]
    fn what_is_undefined_has_no_derivative() {
        let zero = Dual::variable(Rational::int(0));
        assert_eq!(zero.inv().eps.value(), None);
    }
}
