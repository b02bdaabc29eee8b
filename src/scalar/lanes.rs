//! Four collisions at a time.

mod circular;

use super::{Ordered, Real};
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{FromPrimitive, Inv};
use wide::f64x4;

/// Four f64 in parallel, each an independent number.
///
/// Not `PartialOrd`: four numbers compare in four ways, so a comparison gives a mask. The four operations and the root are those of f64, to the bit; sine,
/// cosine and arctangent agree with those of f64 to two or three units of the last place. All have the same bits on every target.
///
/// ```
/// use planar_impact::{Nt, scalar::lanes::Lanes};
/// let velocity = Nt { n: Lanes::new([1.0, 2.0, 3.0, 4.0]), t: Lanes::splat(1.0) };
/// assert_eq!(velocity.length_squared().to_array(), [2.0, 5.0, 10.0, 17.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes(f64x4);

/// The lanes in which a comparison is true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneMask(f64x4);

impl Lanes {
    /// Number of lanes.
    pub const WIDTH: usize = 4;

    /// Creates a value with one number in each lane.
    #[inline(always)]
    pub fn new(lanes: [f64; Self::WIDTH]) -> Self {
        Lanes(f64x4::new(lanes))
    }

    /// Creates a value with the same number in every lane.
    #[inline(always)]
    pub fn splat(x: f64) -> Self {
        Lanes(f64x4::splat(x))
    }

    /// Returns the numbers, lane by lane.
    #[inline(always)]
    pub fn to_array(self) -> [f64; Self::WIDTH] {
        self.0.to_array()
    }
}

impl LaneMask {
    /// Returns `true` for each lane in which the comparison is true.
    #[inline(always)]
    pub fn to_array(self) -> [bool; Lanes::WIDTH] {
        self.0.to_array().map(|lane| lane.to_bits() != 0)
    }
}

impl FromPrimitive for Lanes {
    #[inline(always)]
    fn from_i32(n: i32) -> Option<Self> {
        Some(Lanes::splat(f64::from(n)))
    }

    #[inline(always)]
    fn from_i64(n: i64) -> Option<Self> {
        Some(Lanes::splat(n as f64))
    }

    #[inline(always)]
    fn from_u64(n: u64) -> Option<Self> {
        Some(Lanes::splat(n as f64))
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Option<Self> {
        Some(Lanes::splat(x))
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(-self.0)
    }
}

impl Inv for Lanes {
    type Output = Self;
    #[inline(always)]
    fn inv(self) -> Self {
        Lanes(f64x4::splat(1.0) / self.0)
    }
}

macro_rules! lane_by_lane {
    ($($operator:ident $method:ident),*) => {
        $(impl $operator for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Lanes(self.0.$method(other.0))
            }
        })*
    };
}

lane_by_lane!(Add add, Sub sub, Mul mul, Div div);

impl Ordered for Lanes {
    type Mask = LaneMask;

    #[inline(always)]
    fn less(&self, other: &Self) -> LaneMask {
        LaneMask(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn select(mask: LaneMask, yes: Self, no: Self) -> Self {
        Lanes(mask.0.select(yes.0, no.0))
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn square_root(self) -> Self {
        Lanes(self.0.sqrt())
    }

    #[inline(always)]
    fn sin_and_cos(self) -> (Self, Self) {
        let (sin, cos) = circular::sin_cos(self.0);
        (Lanes(sin), Lanes(cos))
    }

    #[inline(always)]
    fn arctangent(self, x: Self) -> Self {
        Lanes(circular::atan2(self.0, x.0))
    }
}
