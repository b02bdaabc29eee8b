//! Sine, cosine and arctangent of f64: one algorithm for a number and for each of many side by side, with the same bits on every target.
//!
//! Within a stated range they are additions, multiplications, one division and selections by bits, without a branch, so that a loop over many numbers becomes
//! one over vectors; no fused multiplication, which not every target has. Beyond the range `libm` computes them.
//!
//! The polynomials are those of FDLIBM (Sun Microsystems, 1993: `k_sin.c`, `k_cos.c`, `s_atan.c`).
//!
//! # Error
//!
//! At most 4 units of the last place u of the result, with η = 2⁻⁵³ the error of one operation relative to its result, and η at most u:
//!
//! - **Reduction.** n `HALF_PI[0]` and n `HALF_PI[1]` are exact (33 and at most 17 bits), the first difference is exact (Sterbenz), and the other two round: the remainder r
//!   has at most 2 η of itself. What the three parts lack of π/2 is below 2⁻¹¹⁵, while no remainder of a float below 10⁵ is less than 2⁻⁶⁰.
//! - **Sine** is r + r z P(z): 2 η from r, the second summand is at most 0.11 r and has at most 8 η of itself, and the sum rounds once: 3.9 η.
//! - **Cosine** is (1 − z/2) + z² Q(z), at least 0.7: r tan r · 2 η or 1.6 η from r, η/0.7 from the first difference and 0.45 η from z/2 in it, 0.2 η from the second summand, which is
//!   at most 0.016, and the sum rounds once where it is below 1, so that its η is half a unit: below 4 u.
//! - **Arctangent** is k π/4 ± near, with π/4 in two parts. The quotient t has at most 3 η, near = t − t z P(z) another 1.5 η, and is at most 0.4, a result beside π/4 at least as
//!   much; there the unit is 2⁻⁵⁴: 0.4 · 4.5 η are 3.6 u/2, and the sum rounds once.
//!
//! The polynomials themselves differ from the functions by less than 2⁻⁵⁷ (FDLIBM). Beside 140 bits, of 200 000 numbers, the largest errors are 2.2, 2.1 and 1.9 u. Keeping what
//! the reduction and the first difference lose would make 0.8 u of the first two, and a batch a sixth slower.

// The constants have the digits of their source, one or two more than an f64 keeps.
#![allow(clippy::excessive_precision)]

use core::f64::consts::FRAC_2_PI;

/// π/2 in three parts; the first two have 33 bits, so that a multiple of up to 2²⁰ of them is exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_614_17, 6.077_100_506_303_965_976_60e-11, 2.022_266_248_795_950_631_54e-21];

/// π/4 in two parts; a multiple of up to four of the first is exact.
const EIGHTH: [f64; 2] = [0.5 * HALF_PI[0], 3.038_550_253_253_096e-11];

/// Largest angle that is reduced here.
pub(crate) const LARGEST_ANGLE: f64 = 1e5;

/// Largest coordinate of a direction whose arctangent is taken here: the sum of two does not overflow.
pub(crate) const LARGEST_COORDINATE: f64 = 1e300;

/// 1.5 × 2⁵²: adding it rounds a number to an integer, in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

const SIN: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-1,
    8.333_333_333_322_489_461_24e-3,
    -1.984_126_982_985_794_931_34e-4,
    2.755_731_370_707_006_767_89e-6,
    -2.505_076_025_340_686_341_95e-8,
    1.589_690_995_211_550_102_21e-10,
];

const COS: [f64; 6] = [
    4.166_666_666_666_660_190_37e-2,
    -1.388_888_888_887_410_957_49e-3,
    2.480_158_728_947_672_941_78e-5,
    -2.755_731_435_139_066_330_35e-7,
    2.087_572_321_298_174_827_90e-9,
    -1.135_964_755_778_819_482_65e-11,
];

const ATAN: [f64; 11] = [
    3.333_333_333_333_293_180_27e-1,
    -1.999_999_999_987_648_324_76e-1,
    1.428_571_427_250_346_637_11e-1,
    -1.111_111_040_546_235_578_80e-1,
    9.090_887_133_436_506_561_96e-2,
    -7.691_876_205_044_829_994_95e-2,
    6.661_073_137_387_531_206_69e-2,
    -5.833_570_133_790_573_486_45e-2,
    4.976_877_994_615_932_360_17e-2,
    -3.653_157_274_421_691_552_70e-2,
    1.628_582_011_536_578_236_23e-2,
];

/// tan(π/8), where the expansion point of the arctangent changes from 0 to π/4.
const TAN_EIGHTH_PI: f64 = 0.414_213_562_373_095_03;

const SIGN: u64 = 1 << 63;

/// Returns a + x y, rounded once if multiplication and addition are fused.
#[cfg_attr(not(debug_assertions), inline(always))]
fn plus<const FUSED: bool>(a: f64, x: f64, y: f64) -> f64 {
    #[cfg(feature = "batch")]
    if FUSED {
        return x.mul_add(y, a);
    }
    a + x * y
}

// Both polynomials are summed in pairs, pairs of pairs and so on: term by term, each would wait for the previous one.

#[cfg_attr(not(debug_assertions), inline(always))]
fn six_terms<const FUSED: bool>(x: f64, c: &[f64; 6]) -> f64 {
    let x2 = x * x;
    let pair = |i: usize| plus::<FUSED>(c[i], x, c[i + 1]);
    plus::<FUSED>(pair(0), x2, plus::<FUSED>(pair(2), x2, pair(4)))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn eleven_terms<const FUSED: bool>(x: f64, c: &[f64; 11]) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let pair = |i: usize| plus::<FUSED>(c[i], x, c[i + 1]);
    let low = plus::<FUSED>(pair(0), x2, pair(2));
    let high = plus::<FUSED>(plus::<FUSED>(pair(4), x2, pair(6)), x4, plus::<FUSED>(pair(8), x2, c[10]));
    plus::<FUSED>(low, x4, high)
}

/// Returns all bits if a condition is true, and none otherwise.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mask(condition: bool) -> u64 {
    if condition { u64::MAX } else { 0 }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn and(x: f64, mask: u64) -> f64 {
    f64::from_bits(x.to_bits() & mask)
}

/// Returns `true` if the magnitude of a number is at most a limit, and `false` if it is not a number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_within(x: f64, limit: f64) -> bool {
    and(x, !SIGN) <= limit
}

/// Returns `true` if that holds for each of several numbers.
#[cfg(any(feature = "batch", feature = "lanes"))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn are_within<const N: usize>(numbers: &[f64; N], limit: f64) -> bool {
    let mut all = true;
    let mut i = 0;
    while i < N {
        all &= is_within(numbers[i], limit);
        i += 1;
    }
    all
}

/// Returns sine and cosine of an angle in radians.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    if is_within(x, LARGEST_ANGLE) { sin_cos_within(x) } else { sin_cos_beyond(x) }
}

// Apart, so that what is seldom needed does not stand in the way of what is.
#[cold]
#[inline(never)]
fn sin_cos_beyond(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// The same for a magnitude of at most [`LARGEST_ANGLE`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos_within(x: f64) -> (f64, f64) {
    sin_cos_of::<false>(x)
}

/// The same, on request with fused multiplication and addition, which rounds less often: with other last bits.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos_of<const FUSED: bool>(x: f64) -> (f64, f64) {
    let rounded = x * FRAC_2_PI + ROUNDER;
    let quadrant = rounded.to_bits();
    let n = rounded - ROUNDER;
    let r = HALF_PI.iter().fold(x, |r, part| plus::<FUSED>(r, -n, *part));
    let z = r * r;
    let sin = plus::<FUSED>(r, r * z, six_terms::<FUSED>(z, &SIN)).to_bits();
    let cos = plus::<FUSED>(1.0 - z * 0.5, z * z, six_terms::<FUSED>(z, &COS)).to_bits();
    let odd = 0_u64.wrapping_sub(quadrant & 1);
    let sin_sign = (quadrant & 2) << 62;
    let cos_sign = (quadrant.wrapping_add(1) & 2) << 62;
    // Exchanged in odd quadrants: an exclusive or applied to both.
    let exchange = (sin ^ cos) & odd;
    (f64::from_bits(sin ^ exchange ^ sin_sign), f64::from_bits(cos ^ exchange ^ cos_sign))
}

/// Returns the angle of the direction (`x`, `y`), in [−π, π].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    let is_within = is_within(y, LARGEST_COORDINATE) && is_within(x, LARGEST_COORDINATE);
    if is_within { atan2_within(y, x) } else { atan2_beyond(y, x) }
}

#[cold]
#[inline(never)]
fn atan2_beyond(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// The same for coordinates of at most [`LARGEST_COORDINATE`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan2_within(y: f64, x: f64) -> f64 {
    atan2_of::<false>(y, x)
}

/// The same, on request with fused multiplication and addition.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan2_of<const FUSED: bool>(y: f64, x: f64) -> f64 {
    let (across, along) = (and(y, !SIGN), and(x, !SIGN));
    let steep = across > along;
    let (greater, lesser) = if steep { (across, along) } else { (along, across) };
    // About 0 up to an eighth of a half turn, about π/4 beyond it. The smallest float in place of zero makes 0/0 the direction of x.
    let middle = mask(lesser > greater * TAN_EIGHTH_PI);
    let numerator = lesser - and(greater, middle);
    let denominator = greater + and(lesser, middle);
    let t = numerator / if denominator > 0.0 { denominator } else { f64::from_bits(1) };
    let z = t * t;
    let near = plus::<FUSED>(t, -(t * z), eleven_terms::<FUSED>(z, &ATAN));
    // By its sign, so that a negative zero is behind.
    let behind = (x.to_bits() & SIGN) != 0;
    let eighths = and(1.0, middle);
    let (eighths, near) = if steep { (2.0 - eighths, -near) } else { (eighths, near) };
    let (eighths, near) = if behind { (4.0 - eighths, -near) } else { (eighths, near) };
    let half = eighths * EIGHTH[0] + (eighths * EIGHTH[1] + near);
    f64::from_bits(half.to_bits() | (y.to_bits() & SIGN))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the distance in units of the last place of the larger.
    fn ulps(a: f64, b: f64) -> f64 {
        if a == b {
            return 0.0;
        }
        let unit = a.abs().max(b.abs());
        (a - b).abs() / (unit.next_up() - unit)
    }

    fn angles() -> impl Iterator<Item = f64> {
        let about_quadrants = (-9..=9).flat_map(|n| {
            let at = f64::from(n) * core::f64::consts::FRAC_PI_4;
            [at, at.next_up(), at.next_down(), at + 1e-9, at - 1e-9]
        });
        let spread = (0..40_000).map(|i| (f64::from(i) - 20_000.0) * 1.234_567e-3);
        let large = (0..4_000).map(|i| (f64::from(i) - 2_000.0) * 49.9);
        about_quadrants.chain(spread).chain(large)
    }

    // `libm` is within one unit itself.

    #[test]
    fn sine_and_cosine_are_within_two_units_of_those_of_libm() {
        for x in angles() {
            let (sin, cos) = sin_cos(x);
            assert!(ulps(sin, libm::sin(x)) <= 2.0, "sin {x:e}");
            assert!(ulps(cos, libm::cos(x)) <= 2.0, "cos {x:e}");
        }
    }

    #[test]
    fn arctangent_is_within_three_units_of_that_of_libm_in_every_quadrant() {
        for angle in angles().filter(|a| a.abs() < 4.0) {
            for scale in [5e-324, 1e-310, 1e-150, 0.3, 1.0, 1e150, 1e300, 1e301, 1e308] {
                let (y, x) = (scale * libm::sin(angle), scale * libm::cos(angle));
                assert!(ulps(atan2(y, x), libm::atan2(y, x)) <= 3.0, "atan2({y:e}, {x:e}) = {:e}", atan2(y, x));
            }
        }
    }

    #[test]
    fn large_angles_and_no_numbers_are_those_of_libm() {
        for x in [1e22, 1.000_000_1e5, -3e9] {
            assert_eq!(sin_cos(x), libm::sincos(x));
        }
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
        }
        let odd = [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX, 5e-324];
        for (y, x) in odd.into_iter().flat_map(|y| odd.map(|x| (y, x))) {
            let (got, want) = (atan2(y, x), libm::atan2(y, x));
            assert!(
                got.to_bits() == want.to_bits() || (got.is_nan() && want.is_nan()) || ulps(got, want) <= 1.0,
                "atan2({y:?}, {x:?}) = {got:?}"
            );
        }
        for (y, x) in [0.0, -0.0].into_iter().flat_map(|y| [0.0, -0.0, 1.0, -1.0, f64::INFINITY].map(|x| (y, x))) {
            assert_eq!(atan2(y, x).to_bits(), libm::atan2(y, x).to_bits(), "atan2({y:?}, {x:?})");
        }
    }
}
