//! One row of a batch, as a scalar: with the bits of f64, or with fused multiplication and addition.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{FromPrimitive, Inv};

use crate::scalar::{Ordered, Real, circular};

/// The scalar of a tile.
pub(super) trait Number: Real<Mask = bool> + Copy {
    /// Whether multiplications and additions are fused.
    const FUSED: bool;

    fn new(x: f64) -> Self;

    fn get(self) -> f64;
}

/// An f64 whose functions have no branch, so that a loop over rows is one over vectors. Within the range of [`circular`] it has the bits of f64.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(super) struct Row(f64);

impl Number for Row {
    const FUSED: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new(x: f64) -> Self {
        Row(x)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn get(self) -> f64 {
        self.0
    }
}

impl PartialOrd for Row {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }

    // One comparison instead of two.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lt(&self, other: &Self) -> bool {
        self.0 < other.0
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $symbol:tt),*) => {
        $(impl $operator for Row {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $method(self, other: Self) -> Self {
                Row(self.0 $symbol other.0)
            }
        })*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Row {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Row(-self.0)
    }
}

impl Inv for Row {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inv(self) -> Self {
        Row(1.0 / self.0)
    }
}

impl FromPrimitive for Row {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i32(n: i32) -> Option<Self> {
        Some(Row(f64::from(n)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i64(n: i64) -> Option<Self> {
        Some(Row(n as f64))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_u64(n: u64) -> Option<Self> {
        Some(Row(n as f64))
    }
}

impl Real for Row {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn square_root(self) -> Self {
        Row(self.0.sqrt())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = circular::sin_cos_within(self.0);
        (Row(sin), Row(cos))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arctangent(self, x: Self) -> Self {
        Row(circular::atan2_within(self.0, x.0))
    }
}

/// An f64 that is added to, or subtracted from, another by one fused operation if it is a product.
///
/// It keeps its factors until then. All of that is known when the code is compiled: what runs is multiplications, additions and fused operations, and the
/// formulas are those of every scalar.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fused {
    value: f64,
    factors: Option<[f64; 2]>,
}

impl Number for Fused {
    const FUSED: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new(x: f64) -> Self {
        Fused { value: x, factors: None }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn get(self) -> f64 {
        self.value
    }
}

impl Add for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Fused::new(match (self.factors, other.factors) {
            (Some([x, y]), _) => x.mul_add(y, other.value),
            (None, Some([x, y])) => x.mul_add(y, self.value),
            (None, None) => self.value + other.value,
        })
    }
}

impl Sub for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        Fused { value: self.value * other.value, factors: Some([self.value, other.value]) }
    }
}

impl Div for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        Fused::new(self.value / other.value)
    }
}

impl Neg for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Fused { value: -self.value, factors: self.factors.map(|[x, y]| [-x, y]) }
    }
}

impl Inv for Fused {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inv(self) -> Self {
        Fused::new(1.0 / self.value)
    }
}

impl FromPrimitive for Fused {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i32(n: i32) -> Option<Self> {
        Row::from_i32(n).map(|Row(x)| Fused::new(x))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i64(n: i64) -> Option<Self> {
        Row::from_i64(n).map(|Row(x)| Fused::new(x))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_u64(n: u64) -> Option<Self> {
        Row::from_u64(n).map(|Row(x)| Fused::new(x))
    }
}

impl Ordered for Fused {
    type Mask = bool;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less(&self, other: &Self) -> bool {
        self.value < other.value
    }

    // Without its factors: which of two numbers is a product would be known only while the program runs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        Fused::new(if mask { yes.value } else { no.value })
    }
}

impl Real for Fused {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn square_root(self) -> Self {
        Fused::new(self.value.sqrt())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = circular::sin_cos_of::<true>(self.value);
        (Fused::new(sin), Fused::new(cos))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arctangent(self, x: Self) -> Self {
        Fused::new(circular::atan2_of::<true>(self.value, x.value))
    }
}
