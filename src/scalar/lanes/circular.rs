//! Sine, cosine and arctangent of four numbers at once.
//!
//! `wide` has these functions, but on the baseline x86-64 instructions it takes their integer steps lane by lane, and a collision from angles gains nothing
//! from lanes. The functions here use additions, multiplications, one division, and masks; no fused multiplication, so that every target gives the same bits.
//!
//! The polynomials are those of FDLIBM (Sun Microsystems, 1993: `k_sin.c`, `k_cos.c`, `s_atan.c`), accurate to less than one unit of the last place on their
//! intervals; the rounding of the steps around them adds about one more.

// The constants have the digits of their source, one or two more than an f64 keeps.
#![allow(clippy::excessive_precision)]

use wide::{f64x4, i64x4};

/// π/2 in three parts; the first two have 33 bits, so that a multiple of up to 2²⁰ of them is exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_614_17, 6.077_100_506_303_965_976_60e-11, 2.022_266_248_795_950_631_54e-21];

/// Largest angle that is reduced exactly.
const LARGEST_ANGLE: f64 = 1e5;

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

// Both polynomials are summed in pairs, pairs of pairs and so on: term by term, each would wait for the previous one.

#[inline(always)]
fn six_terms(x: f64x4, c: &[f64; 6]) -> f64x4 {
    let pair = |i: usize| f64x4::splat(c[i]) + x * f64x4::splat(c[i + 1]);
    let x2 = x * x;
    pair(0) + x2 * (pair(2) + x2 * pair(4))
}

#[inline(always)]
fn eleven_terms(x: f64x4, c: &[f64; 11]) -> f64x4 {
    let pair = |i: usize| f64x4::splat(c[i]) + x * f64x4::splat(c[i + 1]);
    let x2 = x * x;
    let x4 = x2 * x2;
    (pair(0) + x2 * pair(2)) + x4 * ((pair(4) + x2 * pair(6)) + x4 * (pair(8) + x2 * f64x4::splat(c[10])))
}

#[inline(always)]
fn as_bits(x: f64x4) -> i64x4 {
    wide::bytemuck::cast(x)
}

#[inline(always)]
fn as_mask(x: i64x4) -> f64x4 {
    wide::bytemuck::cast(x)
}

/// Computes angles that are too large to reduce here, or are not finite, one by one.
#[cold]
#[inline(never)]
fn sin_cos_one_by_one(x: f64x4) -> (f64x4, f64x4) {
    let both = x.to_array().map(libm::sincos);
    (f64x4::new(both.map(|(sin, _)| sin)), f64x4::new(both.map(|(_, cos)| cos)))
}

#[inline(always)]
pub(super) fn sin_cos(x: f64x4) -> (f64x4, f64x4) {
    // One branch for all lanes: `all` would need one for each half.
    if x.abs().simd_le(f64x4::splat(LARGEST_ANGLE)).to_bitmask() != 0b1111 {
        return sin_cos_one_by_one(x);
    }
    let rounded = x * f64x4::splat(core::f64::consts::FRAC_2_PI) + f64x4::splat(ROUNDER);
    let quadrant = as_bits(rounded);
    let n = rounded - f64x4::splat(ROUNDER);
    let r = x - n * f64x4::splat(HALF_PI[0]) - n * f64x4::splat(HALF_PI[1]) - n * f64x4::splat(HALF_PI[2]);
    let z = r * r;
    let sin = r + (r * z) * six_terms(z, &SIN);
    let cos = (f64x4::splat(1.0) - z * f64x4::splat(0.5)) + (z * z) * six_terms(z, &COS);

    let odd = as_mask(i64x4::splat(0) - (quadrant & i64x4::splat(1)));
    let sin_sign = as_mask((quadrant & i64x4::splat(2)) << 62);
    let cos_sign = as_mask(((quadrant + i64x4::splat(1)) & i64x4::splat(2)) << 62);
    // Exchanged in odd quadrants: an exclusive or applied to both.
    let exchange = (sin ^ cos) & odd;
    (sin ^ exchange ^ sin_sign, cos ^ exchange ^ cos_sign)
}

#[inline(always)]
pub(super) fn atan2(y: f64x4, x: f64x4) -> f64x4 {
    let (across, along) = (y.abs(), x.abs());
    let steep = across.simd_gt(along);
    let (greater, lesser) = (across.fast_max(along), across.fast_min(along));
    // About 0 up to an eighth of a half turn, about π/4 beyond it. The smallest float in place of zero makes 0/0 the direction of x.
    let middle = lesser.simd_gt(greater * f64x4::splat(TAN_EIGHTH_PI));
    let numerator = lesser - (greater & middle);
    let denominator = (greater + (lesser & middle)).fast_max(f64x4::splat(f64::from_bits(1)));
    let t = numerator / denominator;
    let z = t * t;
    let near = t - (t * z) * eleven_terms(z, &ATAN);
    let octant = (f64x4::splat(core::f64::consts::FRAC_PI_4) & middle) + near;
    let quadrant = steep.select(f64x4::splat(core::f64::consts::FRAC_PI_2) - octant, octant);
    let behind = x.simd_lt(f64x4::splat(0.0));
    let half = behind.select(f64x4::splat(core::f64::consts::PI) - quadrant, quadrant);
    half | (y & f64x4::splat(-0.0))
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

    #[test]
    fn sine_and_cosine_are_within_two_units_of_the_last_place() {
        for x in angles() {
            let (sin, cos) = sin_cos(f64x4::splat(x));
            assert!(ulps(sin.to_array()[0], libm::sin(x)) <= 2.0, "sin {x:e}");
            assert!(ulps(cos.to_array()[3], libm::cos(x)) <= 2.0, "cos {x:e}");
        }
    }

    #[test]
    fn large_angles_and_no_numbers_are_those_of_libm() {
        let x = f64x4::new([1e22, 3.0, f64::INFINITY, f64::NAN]);
        let (sin, cos) = sin_cos(x);
        assert_eq!(sin.to_array()[..2], [libm::sin(1e22), libm::sin(3.0)]);
        assert_eq!(cos.to_array()[..2], [libm::cos(1e22), libm::cos(3.0)]);
        assert!(sin.to_array()[2..].iter().chain(&cos.to_array()[2..]).all(|x| x.is_nan()));
    }

    #[test]
    fn lanes_do_not_mix() {
        let x = [0.1, 1.7, -2.5, 40.0];
        let (sin, cos) = sin_cos(f64x4::new(x));
        for (i, &x) in x.iter().enumerate() {
            assert!(ulps(sin.to_array()[i], libm::sin(x)) <= 2.0);
            assert!(ulps(cos.to_array()[i], libm::cos(x)) <= 2.0);
        }
    }

    #[test]
    fn arctangent_is_within_three_units_of_the_last_place_in_every_quadrant() {
        for angle in angles().filter(|a| a.abs() < 4.0) {
            for scale in [1e-150, 0.3, 1.0, 1e150] {
                let (y, x) = (scale * angle.sin(), scale * angle.cos());
                let got = atan2(f64x4::splat(y), f64x4::splat(x)).to_array()[1];
                assert!(ulps(got, libm::atan2(y, x)) <= 3.0, "atan2({y:e}, {x:e}) = {got:e}");
            }
        }
    }

    #[test]
    fn arctangent_on_the_axes_keeps_the_sign_of_zero() {
        for (y, x) in [(0.0, 1.0), (-0.0, 1.0), (0.0, -1.0), (-0.0, -1.0), (1.0, 0.0), (-1.0, -0.0), (0.0, 0.0), (-0.0, 0.0)] {
            let got = atan2(f64x4::splat(y), f64x4::splat(x)).to_array()[2];
            assert_eq!(got.to_bits(), libm::atan2(y, x).to_bits(), "atan2({y:?}, {x:?}) = {got:?}");
        }
    }
}
