//! Dual numbers over the rationals, to test derivatives as equalities.
//!
//! An angle is stored as its cosine and sine, which are rational; roots, directions and quotients by zero are not, so
//! anything computed from them is undefined.

use num_rational::BigRational;
use num_traits::{FromPrimitive, Inv, Zero};
use planar_impact::{Ordered, Real};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A rational number and its derivative, an angle and its derivative, or undefined.
#[derive(Clone, Debug)]
pub enum ExactDual {
    Number { value: BigRational, slope: BigRational },
    Angle { cos: BigRational, sin: BigRational, slope: BigRational },
    Nothing,
}

use ExactDual::{Angle, Nothing, Number};

impl ExactDual {
    pub fn number(value: BigRational, slope: i32) -> Self {
        Number { value, slope: BigRational::from_integer(slope.into()) }
    }

    pub fn angle(cos: BigRational, sin: BigRational, slope: i32) -> Self {
        Angle { cos, sin, slope: BigRational::from_integer(slope.into()) }
    }

    /// Returns the value and the derivative.
    pub fn parts(self) -> Option<(BigRational, BigRational)> {
        match self {
            Number { value, slope } => Some((value, slope)),
            _ => None,
        }
    }

    fn with(self, other: Self, f: impl FnOnce([BigRational; 2], [BigRational; 2]) -> Option<[BigRational; 2]>) -> Self {
        let numbers = self.parts().zip(other.parts());
        numbers.and_then(|((a, da), (b, db))| f([a, da], [b, db])).map_or(Nothing, |[value, slope]| Number { value, slope })
    }
}

impl FromPrimitive for ExactDual {
    fn from_i64(n: i64) -> Option<Self> {
        Some(ExactDual::number(BigRational::from_integer(n.into()), 0))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(ExactDual::number(BigRational::from_integer(n.into()), 0))
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
            let quotient = (!b.is_zero()).then(|| a / &b)?;
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
        ExactDual::number(BigRational::from_integer(1.into()), 0) / self
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
