//! Predicates of a number, and the rounding that they allow.

use core::ops::{BitAnd, BitOr, BitXor, Not};

use super::Ordered;

/// A mask that can be combined with others: `bool`, or one of lanes.
pub trait Logic: BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> + Not<Output = Self> + Copy {}

impl<M: BitAnd<Output = M> + BitOr<Output = M> + BitXor<Output = M> + Not<Output = M> + Copy> Logic for M {}

/// Returns `true` if the scalar has only the 24 bits of an f32, for which 2²⁴ + 1 is 2²⁴.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_single<T: Ordered<Mask: Logic>>() -> T::Mask {
    let limit = T::int(1 << 24);
    !limit.less(&(limit.clone() + T::int(1)))
}

/// Returns 2 to the power of −`double`, or of −`single` for an f32.
#[cfg_attr(not(debug_assertions), inline(always))]
fn two_to_minus<T: Ordered<Mask: Logic>>(double: u32, single: u32) -> T {
    T::int(1) / T::select(is_single::<T>(), T::int(1 << single), T::int(1 << double))
}

/// Returns 2⁻⁴⁸, or 2⁻²⁰ for an f32: a sum below this share of its terms is their rounding.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rounding<T: Ordered<Mask: Logic>>() -> T {
    two_to_minus::<T>(24, 10).squared()
}

/// Returns how far a quantity in SI may be from a value that it is, by rounding.
#[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
pub(crate) fn rounding_at(value: f64) -> f64 {
    // Every number is below infinity.
    if value.is_finite() { 1e-12 * (1.0 + value.abs()) } else { 0.0 }
}

/// Returns 2⁻⁴⁰, or 2⁻¹⁶ for an f32: accepted deviation of a given direction from unit length, and of a given ratio from a critical one computed elsewhere.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn slack<T: Ordered<Mask: Logic>>() -> T {
    tolerance::<T>().squared()
}

/// Returns 2⁻²⁰, or 2⁻⁸ for an f32: accepted deviation of a result from a law due to rounding, as a share of its terms.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn tolerance<T: Ordered<Mask: Logic>>() -> T {
    two_to_minus(20, 8)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_finite<T: Ordered<Mask: Logic>>(x: &T) -> T::Mask {
    x.finite()
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_positive<T: Ordered>(x: &T) -> T::Mask {
    T::int(0).less(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_zero<T: Ordered<Mask: Logic>>(x: &T) -> T::Mask {
    !is_positive(x) & !x.less(&T::int(0))
}
