//! Quantiles: the number below which a distribution has a given probability.
//!
//! That of the normal distribution is algorithm AS 241 (Wichura, "The percentage points of the normal distribution", Applied Statistics 37, 1988), to 16
//! digits. It has the same bits on every platform.

use super::Distribution::{self, LogNormal, Normal, StudentT, Triangular, TruncatedNormal, Uniform};
use super::{degrees_of_freedom, standard_error, student};
use crate::scalar::{Real, logarithm};

/// Half the width of the middle range of the normal distribution.
const MIDDLE: f64 = 0.425;
/// Root of the negative logarithm of a tail up to which the first of two formulas holds.
const NEAR: f64 = 5.0;
/// A tail whose root is below that: 4.8.
const FAR: f64 = 1e-10;

impl Distribution {
    /// Returns the number below which a number of this distribution lies with a probability. At 0 and 1 it is an end of the support; beyond, not a number.
    ///
    /// ```
    /// use planar_impact::Distribution;
    /// let friction = Distribution::Normal { mean: 0.7, sd: 0.05 };
    /// assert_eq!(friction.quantile(0.5), 0.7);
    /// assert!((friction.quantile(0.975) - 0.798).abs() < 1e-3);
    /// ```
    pub fn quantile(&self, probability: f64) -> f64 {
        let p = probability;
        if !(0.0..=1.0).contains(&p) {
            return f64::NAN;
        }
        match *self {
            Normal { mean, sd } => mean + sd * standard(p),
            TruncatedNormal { mode, scale, min, max } => {
                let [below, above] = [min - mode, mode - max].map(|x| cumulative(x / scale));
                let between = 1.0 - below - above;
                // From the nearer end, where the probability has all its digits.
                let z = if below + p * between <= 0.5 { standard(below + p * between) } else { -standard(above + (1.0 - p) * between) };
                (mode + scale * z).clamp(min, max)
            }
            // Rounded, the whole width may end beyond the end.
            Uniform { min, max } => (min + p * (max - min)).min(max),
            Triangular { min, mode, max } => {
                let (rise, width) = (mode - min, max - min);
                if p * width < rise { min + libm::sqrt(p * width * rise) } else { max - libm::sqrt((1.0 - p) * width * (max - mode)) }
            }
            LogNormal { median, log_sd } => median * libm::exp(log_sd * standard(p)),
            StudentT { mean, sd, n } => mean + standard_error(sd, n) * student::quantile(p, degrees_of_freedom(n)),
        }
    }
}

/// Returns the probability that a standard normal number is below x.
pub(crate) fn cumulative(x: f64) -> f64 {
    0.5 * libm::erfc(-x * core::f64::consts::FRAC_1_SQRT_2)
}

/// Returns the quantile of the standard normal distribution.
pub(crate) fn standard(p: f64) -> f64 {
    if is_in_the_middle(p) { in_the_middle(p) } else { in_a_tail(p) }
}

/// Returns `true` if [`in_the_middle`] holds.
#[inline]
pub(crate) fn is_in_the_middle(p: f64) -> bool {
    (p - 0.5).abs() <= MIDDLE
}

/// Returns the quantile of a probability between 0.075 and 0.925, without a branch.
#[inline]
pub(crate) fn in_the_middle(p: f64) -> f64 {
    let q = p - 0.5;
    let r = MIDDLE * MIDDLE - q * q;
    q * ratio(
        r,
        [
            3.387_132_872_796_366_5,
            133.141_667_891_784_38,
            1_971.590_950_306_551_3,
            13_731.693_765_509_46,
            45_921.953_931_549_87,
            67_265.770_927_008_7,
            33_430.575_583_588_13,
            2_509.080_928_730_122_7,
        ],
        [
            1.0,
            42.313_330_701_600_91,
            687.187_007_492_057_9,
            5_394.196_021_424_751,
            21_213.794_301_586_597,
            39_307.895_800_092_71,
            28_729.085_735_721_943,
            5_226.495_278_852_854,
        ],
    )
}

/// Returns the quantile of any other probability.
pub(crate) fn in_a_tail(p: f64) -> f64 {
    let tail = tail_of(p);
    if tail >= FAR {
        return in_a_near_tail(p);
    }
    let r = libm::sqrt(-libm::log(tail));
    let z = if r == f64::INFINITY {
        r
    } else if r <= NEAR {
        of_near_root(r)
    } else {
        ratio(
            r - NEAR,
            [
                6.657_904_643_501_103,
                5.463_784_911_164_114,
                1.784_826_539_917_291_3,
                0.296_560_571_828_504_87,
                0.026_532_189_526_576_124,
                0.001_242_660_947_388_078_4,
                2.711_555_568_743_487_6e-5,
                2.010_334_399_292_288e-7,
            ],
            [
                1.0,
                0.599_832_206_555_888,
                0.136_929_880_922_735_8,
                0.014_875_361_290_850_615,
                0.000_786_869_131_145_613_2,
                1.846_318_317_510_054_8e-5,
                1.421_511_758_316_446e-7,
                2.044_263_103_389_94e-15,
            ],
        )
    };
    if p < 0.5 { -z } else { z }
}

/// Returns `true` if [`in_a_near_tail`] holds outside the middle.
#[cfg(feature = "simulation")]
#[inline]
pub(crate) fn is_in_a_near_tail(p: f64) -> bool {
    tail_of(p) >= FAR
}

/// Returns the quantile of a probability outside the middle and at least 10⁻¹⁰ from 0 and 1, without a branch.
#[inline]
pub(crate) fn in_a_near_tail(p: f64) -> f64 {
    let z = of_near_root((-logarithm::of_normal(tail_of(p))).square_root());
    if p < 0.5 { -z } else { z }
}

#[inline]
fn tail_of(p: f64) -> f64 {
    if p < 0.5 { p } else { 1.0 - p }
}

/// Returns the distance from the mean where the root of the negative logarithm of the tail is at most [`NEAR`].
#[inline]
fn of_near_root(r: f64) -> f64 {
    ratio(
        r - 1.6,
        [
            1.423_437_110_749_683_5,
            4.630_337_846_156_546,
            5.769_497_221_460_691,
            3.647_848_324_763_204_5,
            1.270_458_252_452_368_4,
            0.241_780_725_177_450_6,
            0.022_723_844_989_269_184,
            0.000_774_545_014_278_341_4,
        ],
        [
            1.0,
            2.053_191_626_637_759,
            1.676_384_830_183_803_8,
            0.689_767_334_985_1,
            0.148_103_976_427_480_08,
            0.015_198_666_563_616_457,
            0.000_547_593_808_499_534_5,
            1.050_750_071_644_416_9e-9,
        ],
    )
}

/// Returns the ratio of two polynomials from their coefficients, that of the constant first.
#[inline]
fn ratio(x: f64, above: [f64; 8], below: [f64; 8]) -> f64 {
    let (mut top, mut bottom) = (above[7], below[7]);
    let mut i = 7;
    while i > 0 {
        i -= 1;
        (top, bottom) = (top * x + above[i], bottom * x + below[i]);
    }
    top / bottom
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentage_points_are_those_of_the_tables() {
        // Wichura's own examples, and the 97.5th percentile of any table.
        for (p, z) in [(0.25, -0.674_489_750_196_081_7), (0.001, -3.090_232_306_167_813_5), (1e-20, -9.262_340_089_798_408)] {
            assert!((standard(p) / z - 1.0).abs() < 1e-15, "{p}: {}", standard(p));
        }
        assert!((standard(0.975) - 1.959_963_984_540_054).abs() < 4e-15);
        assert_eq!([standard(0.5), standard(0.0), standard(1.0)], [0.0, f64::NEG_INFINITY, f64::INFINITY]);
    }

    #[test]
    fn the_probability_below_a_quantile_is_that_asked_for() {
        for k in 1..4000 {
            let p = f64::from(k) / 4000.0;
            assert!((cumulative(standard(p)) - p).abs() < 4e-16, "{p}");
            assert_eq!(standard(1.0 - p), -standard(1.0 - (1.0 - p)));
            let tail = 0.5_f64.powi(k / 4);
            assert!((cumulative(standard(tail)) / tail - 1.0).abs() < 1e-12, "{tail}");
        }
    }

    #[test]
    fn quantiles_undo_the_integral_of_the_density() {
        let all = [
            Normal { mean: -3.0, sd: 2.0 },
            TruncatedNormal { mode: 0.2, scale: 0.5, min: 0.0, max: 1.0 },
            TruncatedNormal { mode: 1.0, scale: 3.0, min: 0.9, max: 1.0 },
            Uniform { min: -1.0, max: 5.0 },
            Uniform { min: 0.93, max: 1.99 },
            Triangular { min: 1.0, mode: 1.5, max: 4.0 },
            Triangular { min: 1.0, mode: 1.0, max: 4.0 },
            LogNormal { median: 20.0, log_sd: 0.4 },
            StudentT { mean: 0.7, sd: 0.05, n: 2 },
            StudentT { mean: 0.7, sd: 0.05, n: 3 },
            StudentT { mean: -7.0, sd: 0.5, n: 12 },
        ];
        for distribution in all {
            let (start, end) = (distribution.quantile(0.1), distribution.quantile(0.9));
            let steps = 20_000;
            let width = (end - start) / f64::from(steps);
            let at = |i: i32| libm::exp(distribution.log_density(start + (f64::from(i) + 0.5) * width));
            let between: f64 = (0..steps).map(at).sum::<f64>() * width;
            assert!((between - 0.8).abs() < 1e-8, "{distribution:?}: {between}");
            let middle = distribution.quantile(0.5);
            assert!(start < middle && middle < end);
            let (least, most) = distribution.support();
            assert_eq!((distribution.quantile(0.0), distribution.quantile(1.0)), (least, most), "{distribution:?}");
            assert!(
                distribution.quantile(-0.1).is_nan() && distribution.quantile(1.1).is_nan() && distribution.quantile(f64::NAN).is_nan()
            );
        }
    }

    #[test]
    fn the_median_of_each_is_where_half_lie_below() {
        assert_eq!(LogNormal { median: 20.0, log_sd: 0.4 }.quantile(0.5), 20.0);
        assert_eq!(Uniform { min: -1.0, max: 5.0 }.quantile(0.25), 0.5);
        // (x − 1)²/(3 · 0.5) = 1/3 at the mode.
        assert!((Triangular { min: 1.0, mode: 1.5, max: 4.0 }.quantile(0.5 / 3.0) - 1.5).abs() < 1e-15);
        let whole = TruncatedNormal { mode: 2.0, scale: 1.0, min: -60.0, max: 60.0 };
        assert!((whole.quantile(0.025) - (2.0 - 1.959_963_984_540_054)).abs() < 1e-14);
        // Either tail has its digits: it is that of the whole distribution.
        for p in [1e-300, 1e-12, 0.25] {
            let distance = Normal { mean: 0.0, sd: 1.0 }.quantile(p);
            assert!(((whole.quantile(p) - 2.0) / distance - 1.0).abs() < 1e-14, "{p}");
        }
    }
}
