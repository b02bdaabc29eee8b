//! One row of a batch, as a scalar.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{FromPrimitive, Inv};

use crate::frame::Xy;
use crate::scalar::{Real, circular};

/// An f64 whose functions have no branch, so that a loop over rows is one over vectors. Within the range of [`circular`] it has the bits of f64.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(super) struct Row(pub(super) f64);

impl PartialOrd for Row {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }

    // One comparison instead of two.
    #[inline(always)]
    fn lt(&self, other: &Self) -> bool {
        self.0 < other.0
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $symbol:tt),*) => {
        $(impl $operator for Row {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Row(self.0 $symbol other.0)
            }
        })*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Row {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Row(-self.0)
    }
}

impl Inv for Row {
    type Output = Self;
    #[inline(always)]
    fn inv(self) -> Self {
        Row(1.0 / self.0)
    }
}

impl FromPrimitive for Row {
    #[inline(always)]
    fn from_i32(n: i32) -> Option<Self> {
        Some(Row(f64::from(n)))
    }

    #[inline(always)]
    fn from_i64(n: i64) -> Option<Self> {
        Some(Row(n as f64))
    }

    #[inline(always)]
    fn from_u64(n: u64) -> Option<Self> {
        Some(Row(n as f64))
    }
}

impl Real for Row {
    #[inline(always)]
    fn square_root(self) -> Self {
        Row(self.0.sqrt())
    }

    #[inline(always)]
    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = circular::sin_cos_within(self.0);
        (Row(sin), Row(cos))
    }

    #[inline(always)]
    fn arctangent(self, x: Self) -> Self {
        Row(circular::atan2_within(self.0, x.0))
    }
}

/// Returns the vector of two numbers of a row.
#[inline(always)]
pub(super) fn vector(x: f64, y: f64) -> Xy<Row> {
    Xy { x: Row(x), y: Row(y) }
}
