//! Bounds on the polynomials behind a value.

use core::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use num_bigint::BigUint;
use num_traits::{FromPrimitive, Inv, One, Zero};

/// A bound on a polynomial with integer coefficients.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Extent {
    /// An upper bound on its total degree in all variables.
    pub degree: u64,
    /// An upper bound on the sum of the absolute values of its coefficients; zero only for the zero polynomial.
    pub norm: BigUint,
}

/// Bounds on a rational function of the variables, found by evaluating it: its numerator, and each factor of its
/// denominator with its power.
///
/// ```text
/// variable        degree 1, norm 1
/// integer         degree 0, norm |n|
/// product         degrees add, norms multiply
/// sum             over the common denominator: the larger degree, the sum of the norms
/// inverse         the numerator becomes a factor of the denominator
/// ```
///
/// Nothing is ever canceled, so the numerator is that of the exact steps of the code, and the factors of the
/// denominator are all divisors used: where the value is defined, it is zero exactly where the numerator is zero.
///
/// A factor is identified by its address in memory. Two divisors computed separately count as two, even if they are
/// equal; that can only increase a bound.
#[derive(Clone, Debug)]
pub struct Size {
    numerator: Extent,
    denominator: Vec<Factor>,
}

#[derive(Clone, Debug)]
struct Factor {
    polynomial: Rc<Extent>,
    power: u32,
}

impl Extent {
    fn constant(norm: BigUint) -> Self {
        Extent { degree: 0, norm }
    }

    fn one() -> Self {
        Extent::constant(BigUint::one())
    }

    fn times(&self, other: &Extent) -> Self {
        if self.norm.is_zero() || other.norm.is_zero() {
            return Extent::constant(BigUint::zero());
        }
        Extent { degree: self.degree + other.degree, norm: &self.norm * &other.norm }
    }

    fn plus(&self, other: &Extent) -> Self {
        Extent { degree: self.degree.max(other.degree), norm: &self.norm + &other.norm }
    }

    /// Returns a bound that holds for both of two polynomials.
    pub(crate) fn or(self, other: Extent) -> Self {
        Extent { degree: self.degree.max(other.degree), norm: self.norm.max(other.norm) }
    }
}

impl Factor {
    fn is(&self, other: &Factor) -> bool {
        Rc::ptr_eq(&self.polynomial, &other.polynomial)
    }

    fn times(&self, powers: u32, extent: &Extent) -> Extent {
        (0..powers).fold(extent.clone(), |product, _| product.times(&self.polynomial))
    }
}

impl Size {
    /// Creates a free variable.
    pub fn variable() -> Self {
        Size { numerator: Extent { degree: 1, norm: BigUint::one() }, denominator: Vec::new() }
    }

    /// Returns the bound on its numerator.
    pub fn numerator(&self) -> &Extent {
        &self.numerator
    }

    fn power_of(&self, factor: &Factor) -> u32 {
        self.denominator.iter().find(|known| known.is(factor)).map_or(0, |known| known.power)
    }

    /// Combines the factors of both denominators, each with the power that `power` computes from its two powers.
    fn joint(&self, other: &Size, power: fn(u32, u32) -> u32) -> Vec<Factor> {
        let only_other = other.denominator.iter().filter(|factor| self.power_of(factor) == 0);
        let factors = self.denominator.iter().chain(only_other);
        factors.map(|factor| Factor { power: power(self.power_of(factor), other.power_of(factor)), ..factor.clone() }).collect()
    }

    /// Returns its numerator over a multiple of its denominator.
    fn numerator_over(&self, denominator: &[Factor]) -> Extent {
        denominator.iter().fold(self.numerator.clone(), |numerator, factor| factor.times(factor.power - self.power_of(factor), &numerator))
    }
}

impl FromPrimitive for Size {
    fn from_i64(n: i64) -> Option<Self> {
        Self::from_u64(n.unsigned_abs())
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Size { numerator: Extent::constant(n.into()), denominator: Vec::new() })
    }
}

impl Neg for Size {
    type Output = Self;
    fn neg(self) -> Self {
        self
    }
}

impl Add for Size {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let denominator = self.joint(&other, u32::max);
        let numerator = self.numerator_over(&denominator).plus(&other.numerator_over(&denominator));
        Size { numerator, denominator }
    }
}

impl Sub for Size {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Size {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Size { denominator: self.joint(&other, |a, b| a + b), numerator: self.numerator.times(&other.numerator) }
    }
}

impl Inv for Size {
    type Output = Self;
    fn inv(self) -> Self {
        let numerator = self.denominator.iter().fold(Extent::one(), |product, factor| factor.times(factor.power, &product));
        // Dividing by a numerator of 1 or −1 adds no factor.
        let divides = self.numerator != Extent::one();
        let denominator = divides.then(|| Factor { polynomial: Rc::new(self.numerator), power: 1 }).into_iter().collect();
        Size { numerator, denominator }
    }
}

impl Div for Size {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "a quotient is the product with the inverse")]
    fn div(self, other: Self) -> Self {
        self * other.inv()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::{CrushPlane, Field};

    fn bounds(size: &Size) -> (u64, u64) {
        (size.numerator.degree, (&size.numerator.norm).try_into().expect("small"))
    }

    #[test]
    fn a_polynomial_is_bounded_by_itself() {
        // (x + 2y)² − 3x = x² + 4xy + 4y² − 3x
        let (x, y) = (Size::variable(), Size::variable());
        let square = (x.clone() + Size::int(2) * y).squared();
        assert_eq!(bounds(&square), (2, 9));
        assert_eq!(bounds(&(square - Size::int(3) * x)), (2, 12));
    }

    #[test]
    fn a_sum_of_fractions_has_their_common_denominator() {
        let (x, y) = (Size::variable(), Size::variable());
        let one = Size::int(1);
        // 1/x + 1/y = (y + x)/(x y)
        let (over_x, over_y) = (one.clone() / x.clone(), one / y);
        let sum = over_x.clone() + over_y.clone();
        assert_eq!((bounds(&sum), sum.denominator.len()), ((1, 2), 2));
        // 1/x² + 1/(x y) = (y + x)/(x² y): the larger power of x is kept.
        let sum = over_x.clone().squared() + over_x.clone() * over_y;
        assert_eq!(bounds(&sum), (1, 2));
        // x/(x + 1) − 1 = (x − (x + 1))/(x + 1): nothing is canceled.
        let quotient = x.clone() / (x + Size::int(1)) - Size::int(1);
        assert_eq!(bounds(&quotient), (1, 3));
    }

    #[test]
    fn an_inverse_turns_over() {
        let x = Size::variable();
        assert_eq!(bounds(&x.clone().inv()), (0, 1));
        assert_eq!(bounds(&x.clone().inv().inv()), (1, 1));
        assert_eq!(bounds(&(Size::int(1) - x.clone()).inv().squared().inv()), (2, 4));
        assert_eq!(bounds(&(x * Size::int(0))), (0, 0));
    }

    #[test]
    fn nothing_is_canceled_behind_a_division() {
        // (1/x − 1/x)·x is the polynomial zero, bounded by x − x.
        let x = Size::variable();
        let nothing = (x.clone().inv() - x.clone().inv()) * x;
        assert_eq!(bounds(&nothing).0, 2);
    }

    #[test]
    fn the_half_tangent_has_degree_four() {
        // cos² + sin² − 1 over (1 + h²)²: (1 − h²)² + (2h)² − (1 + h²)².
        let plane = CrushPlane::from_half_tangent(Size::variable());
        let unit = plane.cos.squared() + plane.sin.squared() - Size::int(1);
        assert_eq!(bounds(&unit), (4, 12));
    }
}
