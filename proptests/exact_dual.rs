//! Dual numbers over the rationals, to test derivatives as equalities.
//!
//! An angle is stored as its cosine and sine, which are rational; roots, directions and quotients by zero are not, so
//! anything computed from them is undefined.

use crate::rational::Rational;
use num_traits::{FromPrimitive, Inv};
use planar_impact::{Field, Ordered, Real};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A rational number and its derivative, an angle and its derivative, or undefined.
#[derive(Clone, Debug)]
pub enum ExactDual {
    Number { value: Rational, slope: Rational },
    Angle { cos: Rational, sin: Rational, slope: Rational },
    Nothing,
}

use ExactDual::{Angle, Nothing, Number};

impl ExactDual {
    pub fn number(value: Rational, slope: i32) -> Self {
        Number { value, slope: Rational::int(slope) }
    }

    pub fn angle(cos: Rational, sin: Rational, slope: i32) -> Self {
        Angle { cos, sin, slope: Rational::int(slope) }
    }

    /// Returns the value and the derivative.
    pub fn parts(self) -> Option<(Rational, Rational)> {
        match self {
            Number { value, slope } => Some((value, slope)),
            _ => None,
        }
    }

    fn with(self, other: Self, f: impl FnOnce([Rational; 2], [Rational; 2]) -> Option<[Rational; 2]>) -> Self {
        let numbers = self.parts().zip(other.parts());
        numbers.and_then(|((a, da), (b, db))| f([a, da], [b, db])).map_or(Nothing, |[value, slope]| Number { value, slope })
    }
}

impl FromPrimitive for ExactDual {
    fn from_i64(n: i64) -> Option<Self> {
        Some(ExactDual::number(Rational::from_i64(n)?, 0))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(ExactDual::number(Rational::from_u64(n)?, 0))
    }
}

impl Add for ExactDual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, |[a, da], [b, db]| Some([a + b, da + db]))
    }
}

impl Sub for ExactDual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, |[a, da], [b, db]| Some([a - b, da - db]))
    }
}

impl Mul for ExactDual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.with(other, |[a, da], [b, db]| Some([&a * &b, da * b + a * db]))
    }
}

impl Div for ExactDual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.with(other, |[a, da], [b, db]| {
            let quotient = (b != Rational::int(0)).then(|| a / &b)?;
            let slope = (da - &quotient * db) / b;
            Some([quotient, slope])
        })
    }
}

impl Neg for ExactDual {
    type Output = Self;
    fn neg(self) -> Self {
        self.parts().map_or(Nothing, |(value, slope)| Number { value: -value, slope: -slope })
    }
}

impl Inv for ExactDual {
    type Output = Self;
    fn inv(self) -> Self {
        ExactDual::number(Rational::int(1), 0) / self
    }
}

impl Ordered for ExactDual {
    /// `None` if either value is undefined.
    type Mask = Option<bool>;

    fn less(&self, other: &Self) -> Option<bool> {
        let ((a, _), (b, _)) = self.clone().parts().zip(other.clone().parts())?;
        Some(a < b)
    }

    fn select(mask: Option<bool>, yes: Self, no: Self) -> Self {
        match mask {
            Some(true) => yes,
            Some(false) => no,
            None => Nothing,
        }
    }
}

impl Real for ExactDual {
    fn square_root(self) -> Self {
        Nothing
    }

    fn sin_and_cos(self) -> (Self, Self) {
        match self {
            Angle { cos, sin, slope } => {
                let sine = Number { value: sin.clone(), slope: &cos * &slope };
                (sine, Number { value: cos, slope: -(sin * slope) })
            }
            _ => (Nothing, Nothing),
        }
    }

    fn arctangent(self, _: Self) -> Self {
        Nothing
    }
}
