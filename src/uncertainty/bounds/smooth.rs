//! Intervals of functions that are smooth, for second derivatives.

use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{FromPrimitive, Inv};

use crate::scalar::interval::{Interval, Truth};
use crate::scalar::{Ordered, Real};

/// An interval with which a choice that is not decided is all real numbers: where a function changes from one formula to another its derivative may jump, and
/// the hull of both second derivatives says nothing of that.
///
/// Its operations are calls: written out at each place, they took two of the eight megabytes of a program for WebAssembly, and more time.
#[derive(Clone, Copy)]
pub(super) struct Smooth(pub(super) Interval);

impl From<f64> for Smooth {
    fn from(x: f64) -> Self {
        Smooth(Interval::from(x))
    }
}

macro_rules! of_intervals {
    ($($operator:ident $name:ident),*) => {
        $(impl $operator for Smooth {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                Smooth(self.0.$name(other.0))
            }
        })*
    };
}

of_intervals!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Smooth {
    type Output = Self;

    fn neg(self) -> Self {
        Smooth(-self.0)
    }
}

impl Inv for Smooth {
    type Output = Self;

    fn inv(self) -> Self {
        Smooth(self.0.inv())
    }
}

impl FromPrimitive for Smooth {
    fn from_i64(n: i64) -> Option<Self> {
        Interval::from_i64(n).map(Smooth)
    }

    fn from_u64(n: u64) -> Option<Self> {
        Interval::from_u64(n).map(Smooth)
    }
}

impl Ordered for Smooth {
    type Mask = Truth;

    fn less(&self, other: &Self) -> Truth {
        self.0.less(&other.0)
    }

    fn select(mask: Truth, yes: Self, no: Self) -> Self {
        match mask.decided() {
            Some(true) => yes,
            Some(false) => no,
            None => Smooth(Interval::ENTIRE),
        }
    }

    fn finite(&self) -> Truth {
        self.0.finite()
    }
}

impl Real for Smooth {
    fn square_root(self) -> Self {
        Smooth(self.0.square_root())
    }

    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_and_cos();
        (Smooth(sin), Smooth(cos))
    }

    fn arctangent(self, x: Self) -> Self {
        Smooth(self.0.arctangent(x.0))
    }
}
