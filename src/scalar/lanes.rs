//! Several collisions at a time.

mod gather;

use super::{Ordered, Real, circular};
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};
use num_traits::{FromPrimitive, Inv};

/// N f64 side by side, each an independent number: those of N collisions.
///
/// Not `PartialOrd`: N numbers compare in N ways, so a comparison gives a mask. Every operation has the bits of that of f64, on every target.
///
/// ```
/// use planar_impact::{Nt, scalar::lanes::Lanes};
/// let velocity = Nt { n: Lanes::new([1.0, 2.0, 3.0, 4.0]), t: Lanes::splat(1.0) };
/// assert_eq!(velocity.length_squared().to_array(), [2.0, 5.0, 10.0, 17.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<const N: usize = 4>([f64; N]);

/// The lanes in which a comparison is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaneMask<const N: usize = 4>([bool; N]);

// Loops over arrays, and neither closures nor iterators: these are not always compiled into a loop, and only a loop becomes one instruction.
macro_rules! lane_by_lane {
    ($i:ident => $lane:expr) => {{
        let mut lanes = [0.0; N];
        let mut $i = 0;
        while $i < N {
            lanes[$i] = $lane;
            $i += 1;
        }
        Lanes(lanes)
    }};
}

impl<const N: usize> Lanes<N> {
    /// Number of lanes.
    pub const WIDTH: usize = N;

    /// Creates a value with one number in each lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(lanes: [f64; N]) -> Self {
        Lanes(lanes)
    }

    /// Creates a value from the first numbers of a slice.
    ///
    /// # Panics
    ///
    /// If there are fewer numbers than lanes.
    #[cfg(feature = "batch")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(numbers: &[f64]) -> Self {
        let mut lanes = [0.0; N];
        lanes.copy_from_slice(&numbers[..N]);
        Lanes(lanes)
    }

    /// Creates a value with the same number in every lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn splat(x: f64) -> Self {
        Lanes([x; N])
    }

    /// Returns the numbers, lane by lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn to_array(self) -> [f64; N] {
        self.0
    }

    /// Returns the numbers where they are, lane by lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn as_array(&self) -> &[f64; N] {
        &self.0
    }
}

impl<const N: usize> From<f64> for Lanes<N> {
    /// The same number in every lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from(x: f64) -> Self {
        Lanes::splat(x)
    }
}

impl<const N: usize> Default for Lanes<N> {
    /// Zero in every lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn default() -> Self {
        Lanes::splat(0.0)
    }
}

impl<const N: usize> LaneMask<N> {
    /// Returns `true` for each lane in which the comparison is true.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn to_array(self) -> [bool; N] {
        self.0
    }

    /// Returns `true` if the comparison is true in every lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn all(self) -> bool {
        self == LaneMask([true; N])
    }
}

macro_rules! mask_operators {
    ($($operator:ident $method:ident $symbol:tt),*) => {
        $(impl<const N: usize> $operator for LaneMask<N> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $method(mut self, other: Self) -> Self {
                let mut i = 0;
                while i < N {
                    self.0[i] $symbol other.0[i];
                    i += 1;
                }
                self
            }
        })*
    };
}

mask_operators!(BitAnd bitand &=, BitOr bitor |=, BitXor bitxor ^=);

impl<const N: usize> Not for LaneMask<N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn not(self) -> Self {
        self ^ LaneMask([true; N])
    }
}

impl<const N: usize> FromPrimitive for Lanes<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i32(n: i32) -> Option<Self> {
        Some(Lanes::splat(f64::from(n)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_i64(n: i64) -> Option<Self> {
        Some(Lanes::splat(n as f64))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_u64(n: u64) -> Option<Self> {
        Some(Lanes::splat(n as f64))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_f64(x: f64) -> Option<Self> {
        Some(Lanes::splat(x))
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        lane_by_lane!(i => -self.0[i])
    }
}

impl<const N: usize> Inv for Lanes<N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inv(self) -> Self {
        lane_by_lane!(i => 1.0 / self.0[i])
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $symbol:tt),*) => {
        $(impl<const N: usize> $operator for Lanes<N> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $method(self, other: Self) -> Self {
                lane_by_lane!(i => self.0[i] $symbol other.0[i])
            }
        })*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<const N: usize> Ordered for Lanes<N> {
    type Mask = LaneMask<N>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less(&self, other: &Self) -> LaneMask<N> {
        let mut mask = [false; N];
        let mut i = 0;
        while i < N {
            mask[i] = self.0[i] < other.0[i];
            i += 1;
        }
        LaneMask(mask)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: LaneMask<N>, yes: Self, no: Self) -> Self {
        lane_by_lane!(i => if mask.0[i] { yes.0[i] } else { no.0[i] })
    }
}

/// Computes lanes that are beyond the range of the vectors one by one.
#[cold]
#[inline(never)]
fn one_by_one<const N: usize>(of: fn(f64, f64) -> f64, one: [f64; N], other: [f64; N]) -> Lanes<N> {
    lane_by_lane!(i => of(one[i], other[i]))
}

impl<const N: usize> Real for Lanes<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn square_root(self) -> Self {
        lane_by_lane!(i => libm::sqrt(self.0[i]))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_and_cos(self) -> (Self, Self) {
        if !circular::are_within(&self.0, circular::LARGEST_ANGLE) {
            let [sin, cos] = [|x, _| circular::sin_cos(x).0, |x, _| circular::sin_cos(x).1];
            return (one_by_one(sin, self.0, self.0), one_by_one(cos, self.0, self.0));
        }
        let (mut sin, mut cos) = ([0.0; N], [0.0; N]);
        let mut i = 0;
        while i < N {
            (sin[i], cos[i]) = circular::sin_cos_within(self.0[i]);
            i += 1;
        }
        (Lanes(sin), Lanes(cos))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arctangent(self, x: Self) -> Self {
        if !(circular::are_within(&self.0, circular::LARGEST_COORDINATE) && circular::are_within(&x.0, circular::LARGEST_COORDINATE)) {
            return one_by_one(circular::atan2, self.0, x.0);
        }
        lane_by_lane!(i => circular::atan2_within(self.0[i], x.0[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_of_any_type_is_that_number_in_every_lane() {
        let all = [Lanes::<2>::from_i32(-3), Lanes::from_i64(-3), Lanes::from_f64(-3.0)];
        assert_eq!(all.map(|lanes| lanes.map(|lanes| lanes.0)), [Some([-3.0; 2]); 3]);
        assert_eq!(Lanes::<2>::from_u64(3).map(|lanes| lanes.0), Some([3.0; 2]));
    }

    /// Numbers of every size, with those beyond the range of the vectors in some of the lanes.
    fn numbers() -> impl Iterator<Item = [f64; 8]> {
        let odd = [1e22, f64::INFINITY, f64::NAN, -1e5, 1e5, 1e301, -0.0, 5e-324];
        (0..4_000_i32).map(move |i| {
            core::array::from_fn(|lane| {
                let x = f64::from(i - 2_000) * 1.234_567e-2 * f64::from(1 + lane as i32);
                if i % 3 == 0 && lane == (i as usize / 3) % 8 { odd[(i as usize / 24) % 8] } else { x }
            })
        })
    }

    fn bits(lanes: Lanes<8>) -> [u64; 8] {
        // Every NaN counts as the same.
        lanes.to_array().map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() })
    }

    #[test]
    fn every_lane_has_the_bits_of_the_float() {
        for x in numbers() {
            let y = core::array::from_fn(|lane| x[(lane + 3) % 8] * 0.7);
            let (a, b) = (Lanes::new(x), Lanes::new(y));
            let of = |f: fn(f64, f64) -> f64| bits(Lanes::new(core::array::from_fn(|lane| f(x[lane], y[lane]))));
            assert_eq!(bits(a + b), of(|x, y| x + y));
            assert_eq!(bits(a - b), of(|x, y| x - y));
            assert_eq!(bits(a * b), of(|x, y| x * y));
            assert_eq!(bits(a / b), of(|x, y| x / y));
            assert_eq!(bits(-a), of(|x, _| -x));
            assert_eq!(bits(a.inv()), of(|x, _| 1.0 / x));
            assert_eq!(bits(a.square_root()), of(|x, _| Real::square_root(x)));
            assert_eq!(bits(a.sin_and_cos().0), of(|x, _| x.sin_and_cos().0));
            assert_eq!(bits(a.sin_and_cos().1), of(|x, _| x.sin_and_cos().1));
            assert_eq!(bits(a.arctangent(b)), of(|x, y| x.arctangent(y)));
            assert_eq!(bits(Lanes::select(a.less(&b), a, b)), of(|x, y| if x < y { x } else { y }));
            assert_eq!(a.less(&b).to_array(), core::array::from_fn(|lane| x[lane] < y[lane]));
        }
    }
}
