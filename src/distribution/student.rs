//! Student's t distribution, whose number of degrees of freedom ν is whole.
//!
//! The probability above t is that of the incomplete beta function, by the continued fraction of Didonato and Morris ("Algorithm 708", ACM Transactions on
//! Mathematical Software 18, 1992) with its λ = ν (t² − 1)/(2 (ν + t²)), so that no digits cancel for any ν. The quantile solves it by Newton's method on
//! logarithms. Everything has the same bits on every platform.

use super::quantile::standard;

/// Where the continued fraction takes over from the series.
const OUTER: f64 = 1.5;

/// Beyond this t²/ν the density is a power of t to the last digit.
const FAR: f64 = 1e17;

/// Returns the natural logarithm of the density.
pub(super) fn log_density(t: f64, freedom: f64) -> f64 {
    let square = t * t / freedom;
    // ln(1 + t²/ν), where t² may be beyond every float.
    let log = if square > FAR { 2.0 * libm::log(t.abs()) - libm::log(freedom) } else { libm::log1p(square) };
    libm::log(gamma_ratio(0.5 * freedom) / libm::sqrt(core::f64::consts::PI * freedom)) - 0.5 * (freedom + 1.0) * log
}

/// Returns the natural logarithm of t times the density, which may be below every float.
fn log_product(t: f64, freedom: f64) -> f64 {
    libm::log(t) + log_density(t, freedom)
}

/// Returns the probability above t.
#[cfg(any(test, feature = "reconstruct"))]
pub(crate) fn above(t: f64, freedom: f64) -> f64 {
    if t.abs() >= OUTER {
        let beyond = if t.is_infinite() { 0.0 } else { libm::exp(log_product(t.abs(), freedom)) * outer(t.abs(), freedom) };
        if t > 0.0 { beyond } else { 1.0 - beyond }
    } else {
        0.5 - t * libm::exp(log_density(t, freedom)) * inner(t, freedom)
    }
}

/// Returns the number below which lies a given probability, from 0 to 1; not a number without a degree of freedom.
pub(super) fn quantile(p: f64, freedom: f64) -> f64 {
    let tail = p.min(1.0 - p);
    let size = if freedom < 1.0 {
        f64::NAN
    } else if tail == 0.0 {
        f64::INFINITY
    } else {
        upper_quantile(tail, freedom)
    };
    if p < 0.5 { -size } else { size }
}

/// Returns the number above which lies a probability between 0 and ½.
fn upper_quantile(tail: f64, freedom: f64) -> f64 {
    let from_middle = 0.5 - tail;
    if from_middle == 0.0 {
        return 0.0;
    }
    if freedom == 1.0 {
        // The Cauchy distribution.
        let angle = core::f64::consts::PI * tail.min(from_middle);
        return if tail < from_middle { 1.0 / libm::tan(angle) } else { libm::tan(angle) };
    }
    if freedom == 2.0 {
        return 2.0 * from_middle / libm::sqrt(2.0 * tail * (1.0 - tail));
    }
    // The approximation of Wallace (Annals of Mathematical Statistics 30, 1959) to the normal number that is exceeded as often.
    let z = standard(tail) * (8.0 * freedom + 3.0) / (8.0 * freedom + 1.0);
    let mut t = libm::sqrt(freedom * libm::expm1(z * z / freedom));
    let is_outer = t >= OUTER;
    // The logarithm of either probability is a concave function of ln t: after one step, those that follow approach from one side.
    for _ in 0..50 {
        let step = if is_outer {
            let ratio = outer(t, freedom);
            ratio * (log_product(t, freedom) + libm::log(ratio) - libm::log(tail))
        } else {
            let ratio = inner(t, freedom);
            -ratio * libm::log(t * libm::exp(log_density(t, freedom)) * ratio / from_middle)
        };
        t *= libm::exp(step);
        // Each step squares the error of the one before.
        if step.abs() < 1e-9 {
            break;
        }
    }
    t
}

/// Returns the probability above t over t times the density, for t above 1.
fn outer(t: f64, freedom: f64) -> f64 {
    let square = t * t;
    if square > FAR * freedom {
        return 1.0 / freedom;
    }
    let (a, b) = (0.5 * freedom, 0.5);
    let (x, y) = (freedom / (freedom + square), square / (freedom + square));
    let lambda = 0.5 * freedom * ((square - 1.0) / (freedom + square));
    // The method of Lentz.
    let mut fraction = a / (a + 1.0) * (lambda + 1.0);
    let (mut c, mut d) = (fraction, 0.0);
    for n in 1..1000 {
        let n = f64::from(n);
        let odd = a + 2.0 * n - 1.0;
        let above = (a + n - 1.0) / odd * ((a + b + n - 1.0) / odd) * n * (b - n) * x * x;
        let beside = n + n * (b - n) * x / odd + (a + n) / (a + 2.0 * n + 1.0) * (lambda + 1.0 + n * (1.0 + y));
        d = 1.0 / (beside + above * d);
        c = beside + above / c;
        fraction *= c * d;
        if (c * d - 1.0).abs() <= f64::EPSILON {
            break;
        }
    }
    0.5 / fraction
}

/// Returns the probability between 0 and t over t times the density, a series of positive terms.
fn inner(t: f64, freedom: f64) -> f64 {
    let y = t * t / (freedom + t * t);
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 0..1000 {
        let k = f64::from(k);
        term *= y * (0.5 * freedom + 0.5 + k) / (1.5 + k);
        sum += term;
        if term <= 0.5 * f64::EPSILON * sum {
            break;
        }
    }
    sum
}

/// Returns Γ(a + ½)/Γ(a), by its asymptotic series after a recurrence.
fn gamma_ratio(a: f64) -> f64 {
    let (mut a, mut factor) = (a, 1.0);
    while a < 32.0 {
        factor *= a / (a + 0.5);
        a += 1.0;
    }
    // In powers of (a − ¼)⁻² (Luke, "The special functions and their approximations" I, 1969, section 2.11).
    let w = a - 0.25;
    let v = 1.0 / (w * w);
    let series = 1.0 + v * (1.0 / 64.0 - v * (19.0 / 8_192.0 - v * (631.0 / 524_288.0 - v * (174_317.0 / 134_217_728.0))));
    factor * libm::sqrt(w) * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_out_the_tail_is_a_power() {
        // P/(t f) = 1/ν (1 + (ν + 1)/(ν + 2) ν/t² + …), from P′ = −f.
        for (t, freedom) in [(4e8, 4e9), (1e9, 1e8), (1e7, 1e3)] {
            let share = freedom / (t * t);
            let found = outer(t, freedom) * freedom - 1.0;
            assert!((found - share * (freedom + 1.0) / (freedom + 2.0)).abs() < 4e-15, "{t} {freedom}: {found} {share}");
        }
    }

    /// Probabilities from the middle to a far tail.
    const TAILS: [f64; 6] = [0.4, 0.25, 0.07, 0.025, 1e-3, 1e-12];

    const FREEDOMS: [f64; 12] = [1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 17.0, 64.0, 999.0, 1e5, 1e8, 4_294_967_294.0];

    #[test]
    fn quantiles_are_those_of_many_digits() {
        // Roots of the regularized incomplete beta function of mpmath 1.3.0 with 60 digits, for each of the probabilities above as a float.
        let known = [
            (
                1.0,
                [
                    0.324_919_696_232_906_23,
                    1.0,
                    4.473_742_829_211_554,
                    12.706_204_736_174_705,
                    318.308_838_985_550_44,
                    318_309_886_183.790_7,
                ],
            ),
            (
                2.0,
                [
                    0.288_675_134_594_812_8,
                    0.816_496_580_927_726,
                    2.383_378_180_536_881,
                    4.302_652_729_749_464,
                    22.327_124_770_119_877,
                    707_106.781_185_486_8,
                ],
            ),
            (
                3.0,
                [
                    0.276_670_662_332_689_83,
                    0.764_892_328_404_345_3,
                    1.995_022_077_391_569_4,
                    3.182_446_305_283_709_5,
                    10.214_531_852_407_386,
                    10_331.108_244_292_485,
                ],
            ),
            (
                4.0,
                [
                    0.270_722_294_707_597_34,
                    0.740_697_084_112_682_6,
                    1.837_523_514_944_866_8,
                    2.776_445_105_197_794_3,
                    7.173_182_219_782_308_5,
                    1_316.072_746_559_256_5,
                ],
            ),
            (
                5.0,
                [
                    0.267_180_865_704_145_07,
                    0.726_686_843_800_422_7,
                    1.752_890_157_875_486_7,
                    2.570_581_835_636_315_5,
                    5.893_429_531_356_01,
                    393.956_959_577_603_75,
                ],
            ),
            (
                9.0,
                [
                    0.260_955_336_473_910_95,
                    0.702_722_146_751_326_4,
                    1.618_538_423_929_658_3,
                    2.262_157_162_798_205_3,
                    4.296_805_662_729_919,
                    51.414_916_023_282_23,
                ],
            ),
            (
                29.0,
                [
                    0.255_683_634_571_256_1,
                    0.683_043_860_821_613_2,
                    1.517_370_278_736_893,
                    2.045_229_642_132_704_3,
                    3.396_240_288_356_803,
                    11.613_158_011_561_406,
                ],
            ),
            (
                100.0,
                [
                    0.254_022_182_458_227_8,
                    0.676_951_043_011_471_5,
                    1.487_611_231_833_816_6,
                    1.983_971_518_523_552_2,
                    3.173_739_493_738_783,
                    8.025_825_594_493_254,
                ],
            ),
            (
                1000.0,
                [
                    0.253_414_515_839_498_7,
                    0.674_735_164_607_009_4,
                    1.476_964_476_059_105_2,
                    1.962_339_080_826_408_5,
                    3.098_402_163_912_923,
                    7.124_228_925_314_409_5,
                ],
            ),
            (
                100_000.0,
                [
                    0.253_347_777_157_179_9,
                    0.674_492_203_553_292_2,
                    1.475_802_753_282_850_2,
                    1.959_987_707_534_609_5,
                    3.090_313_809_427_237_8,
                    7.035_371_742_393_576,
                ],
            ),
        ];
        for (freedom, quantiles) in known {
            for (p, wanted) in TAILS.into_iter().zip(quantiles) {
                let found = upper_quantile(p, freedom);
                assert!((found / wanted - 1.0).abs() < 4e-15, "{freedom} {p}: {found} {wanted}");
                assert!((above(wanted, freedom) / p - 1.0).abs() < 2e-14, "{freedom} {p}: {}", above(wanted, freedom));
            }
        }
    }

    #[test]
    fn the_probability_above_a_quantile_is_that_asked_for() {
        for freedom in FREEDOMS {
            for k in 1..2000 {
                let tail = 0.5_f64.powf(1.0 + f64::from(k) / 40.0);
                let t = upper_quantile(tail, freedom);
                // A relative error of t is one of the probability, by t times the density.
                let by_log = t * libm::exp(log_density(t, freedom));
                assert!((above(t, freedom) - tail).abs() / by_log < 2e-14, "{freedom} {tail}: {t} {}", above(t, freedom));
                assert!((above(-t, freedom) - (1.0 - tail)).abs() < 4e-15, "{freedom} {tail}: {}", above(-t, freedom));
            }
        }
    }

    #[test]
    fn quantiles_rise_and_are_symmetric() {
        for freedom in FREEDOMS {
            let mut before = f64::NEG_INFINITY;
            for k in 0..=4096 {
                let p = f64::from(k) / 4096.0;
                let t = quantile(p, freedom);
                assert!(t > before || k == 0, "{freedom} {p}");
                assert_eq!(t, -quantile(1.0 - p, freedom), "{freedom} {p}");
                before = t;
            }
            assert_eq!([0.0, 0.5, 1.0].map(|p| quantile(p, freedom)), [f64::NEG_INFINITY, 0.0, f64::INFINITY]);
            let far = [1e-30, 1e-100, 1e-300].map(|p| quantile(p, freedom));
            assert!(far[0] > far[1] && far[1] > far[2] && far[2] > f64::MIN, "{freedom}: {far:?}");
            // Beyond every float with one degree of freedom.
            assert!(quantile(5e-324, freedom).is_finite() == (freedom > 1.0), "{freedom}");
        }
    }

    #[test]
    fn one_and_two_degrees_of_freedom_have_closed_forms() {
        for t in [-1e200, -3.0, -1.6, -1.0, 0.0, 0.3, 1.0, 1.5, 2.0, 50.0, 1e9, 1e200_f64] {
            let cauchy = if t > 1.0 { (1.0 / t).atan() / core::f64::consts::PI } else { 0.5 - t.atan() / core::f64::consts::PI };
            assert!((above(t, 1.0) / cauchy - 1.0).abs() < 1e-13, "{t}: {}", above(t, 1.0));
            // ½ − t/(2 r) = 1/(r (r + t)), where r² = 2 + t².
            let root = 2.0_f64.sqrt().hypot(t);
            let two = if t > 0.0 { 1.0 / (root * (root + t)) } else { 0.5 - 0.5 * t / root };
            assert!((above(t, 2.0) - two).abs() <= 1e-13 * two, "{t}: {}", above(t, 2.0));
        }
        assert_eq!([f64::INFINITY, f64::NEG_INFINITY].map(|t| above(t, 3.0)), [0.0, 1.0]);
        assert!(above(f64::NAN, 3.0).is_nan() && quantile(0.1, 0.0).is_nan());
    }

    #[test]
    fn many_degrees_of_freedom_are_nearly_normal() {
        // The first two terms of the expansion of Cornish and Fisher.
        let freedom = 1e9;
        for p in [0.49, 0.3, 0.05, 1e-6, 1e-12] {
            let z = -standard(p);
            let wanted = z + z * (z * z + 1.0) / (4.0 * freedom);
            assert!((upper_quantile(p, freedom) / wanted - 1.0).abs() < 2e-15, "{p}");
        }
    }

    #[test]
    fn a_ratio_of_gamma_functions() {
        // From Γ(1)/Γ(½) on: the product of the ratios at a and at a + ½ is a.
        let mut wanted = core::f64::consts::PI.sqrt().recip();
        let mut a = 0.5;
        while a < 200.0 {
            assert!((gamma_ratio(a) / wanted - 1.0).abs() < 1e-14, "{a}");
            wanted = a / wanted;
            a += 0.5;
        }
    }
}
