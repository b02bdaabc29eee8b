//! Predicates of a number, for scalars whose comparisons are true or false.

use super::Ordered;

/// Returns `true` if the scalar has only the 24 bits of an f32, for which 2²⁴ + 1 is 2²⁴.
pub(crate) fn is_single<T: Ordered<Mask = bool>>() -> bool {
    let limit = T::int(1 << 24);
    !limit.less(&(limit.clone() + T::int(1)))
}

/// Returns 2⁻⁴⁸, or 2⁻²⁰ for an f32: a sum below this share of its terms is their rounding.
pub(crate) fn rounding<T: Ordered<Mask = bool>>() -> T {
    let step = T::int(1) / T::int(if is_single::<T>() { 1 << 10 } else { 1 << 24 });
    step.squared()
}

/// Returns 2⁻⁴⁰, or 2⁻¹⁶ for an f32: accepted deviation of a given direction from unit length, and of a given ratio from a critical one computed elsewhere.
pub(crate) fn slack<T: Ordered<Mask = bool>>() -> T {
    tolerance::<T>().squared()
}

/// Returns 2⁻²⁰, or 2⁻⁸ for an f32: accepted deviation of a result from a law due to rounding, as a share of its terms.
pub(crate) fn tolerance<T: Ordered<Mask = bool>>() -> T {
    T::int(1) / T::int(if is_single::<T>() { 1 << 8 } else { 1 << 20 })
}

pub(crate) fn is_finite<T: Ordered<Mask = bool>>(x: &T) -> bool {
    // Zero for every finite number, and NaN for the others.
    let nothing = x.clone() - x.clone();
    nothing.less(&T::int(1)) && T::int(-1).less(&nothing)
}

pub(crate) fn is_positive<T: Ordered<Mask = bool>>(x: &T) -> bool {
    T::int(0).less(x)
}

pub(crate) fn is_zero<T: Ordered<Mask = bool>>(x: &T) -> bool {
    !is_positive(x) && !x.less(&T::int(0))
}
