//! Rational numbers: rationals of any size, by a crate whose small ones need no allocation.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_ratio::RBig;
use num_traits::{FromPrimitive, Inv};

/// A rational number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rational(RBig);

impl Rational {
    /// Returns the exact value of a float, or `None` if it is not finite.
    pub fn from_float(x: f64) -> Option<Self> {
        RBig::try_from(x).ok().map(Rational)
    }

    /// Returns the nearest float.
    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}

impl FromPrimitive for Rational {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Rational(RBig::from(n)))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Rational(RBig::from(n)))
    }

    fn from_f64(x: f64) -> Option<Self> {
        Rational::from_float(x)
    }
}

// By value and by reference on either side, as the numbers of other crates have them.
macro_rules! operators {
    ($($operator:ident $method:ident $symbol:tt),*) => {
        $(operators!(@ $operator $method $symbol Rational, Rational);
        operators!(@ $operator $method $symbol Rational, &Rational);
        operators!(@ $operator $method $symbol &Rational, Rational);
        operators!(@ $operator $method $symbol &Rational, &Rational);)*
    };
    (@ $operator:ident $method:ident $symbol:tt $one:ty, $other:ty) => {
        impl $operator<$other> for $one {
            type Output = Rational;
            fn $method(self, other: $other) -> Rational {
                let (Rational(x), Rational(y)) = (self, other);
                Rational(x $symbol y)
            }
        }
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        Rational(-self.0)
    }
}

impl Inv for Rational {
    type Output = Self;
    fn inv(self) -> Self {
        Rational(RBig::ONE / self.0)
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
