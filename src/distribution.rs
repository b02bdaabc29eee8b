//! Probability distributions of uncertain numbers.
//!
//! | distribution | given by | density |
//! |---|---|---|
//! | [`Normal`] | mean, standard deviation | φ((x − m)/s)/s |
//! | [`TruncatedNormal`] | the normal that is truncated, limits | the same over its probability between the limits |
//! | [`Uniform`] | limits | 1/(b − a) |
//! | [`Triangular`] | limits, mode | rises linearly to the mode, then falls |
//! | [`LogNormal`] | median, standard deviation of the logarithm | φ(ln(x/m)/s)/(s x) |
//! | [`StudentT`] | mean, standard deviation and number of measurements | t((x − m) √n/s) √n/s with n − 1 degrees of freedom |

pub(crate) mod quantile;
pub(crate) mod student;

use crate::issue::{InputIssue, InputIssueKind, IssueCollector, Issues, Place};

/// The distribution of an uncertain number.
///
/// ```
/// use planar_impact::Distribution;
/// let mass = Distribution::Triangular { min: 1500.0, mode: 1600.0, max: 1800.0 };
/// assert_eq!(mass.check(), Ok(()));
/// assert_eq!((mass.nominal(), mass.support()), (1600.0, (1500.0, 1800.0)));
/// assert!((mass.mean() - 4900.0 / 3.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Distribution {
    /// Normal.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation, above zero.
        sd: f64,
    },
    /// Normal between two limits, which exclude its tails.
    TruncatedNormal {
        /// The mode, which is the mean of the normal distribution before truncation. It lies between the limits.
        mode: f64,
        /// The standard deviation before truncation, above zero.
        scale: f64,
        /// The lower limit.
        min: f64,
        /// The upper limit.
        max: f64,
    },
    /// Equally likely anywhere between two limits.
    Uniform {
        /// The lower limit.
        min: f64,
        /// The upper limit.
        max: f64,
    },
    /// Density that rises linearly from the lower limit to the mode, and falls linearly to the upper limit.
    Triangular {
        /// The lower limit.
        min: f64,
        /// The most likely value, between the limits.
        mode: f64,
        /// The upper limit.
        max: f64,
    },
    /// Positive number whose logarithm is normal.
    LogNormal {
        /// The median, above zero.
        median: f64,
        /// The standard deviation of the natural logarithm, above zero.
        log_sd: f64,
    },
    /// What a few measurements tell of the mean of a quantity: (x − mean)/(sd/√n) has Student's t distribution with n − 1 degrees of freedom.
    ///
    /// The measurements are independent and normal, and nothing else is known of their mean and standard deviation. Three skid tests leave the mean friction
    /// with an infinite standard deviation, and with this 95 % range:
    ///
    /// ```
    /// use planar_impact::Distribution;
    /// let friction = Distribution::StudentT { mean: 0.72, sd: 0.03, n: 3 };
    /// assert_eq!(friction.sd(), f64::INFINITY);
    /// let half = 4.303 * 0.03 / 3.0_f64.sqrt();
    /// assert!((friction.quantile(0.975) - (0.72 + half)).abs() < 1e-5);
    /// ```
    StudentT {
        /// The mean of the measurements.
        mean: f64,
        /// Their standard deviation with the divisor n − 1, above zero.
        sd: f64,
        /// Their number, at least 2.
        n: u32,
    },
}

use Distribution::{LogNormal, Normal, StudentT, Triangular, TruncatedNormal, Uniform};

impl Distribution {
    /// Standard deviations from the mean, to either side, within which 95 % of a normal distribution lie.
    pub const NORMAL_95: f64 = 1.959_963_984_540_054;

    /// Creates the uniform distribution of a number that is recorded in steps: anything within half a step of the value.
    pub fn of_resolution(value: f64, step: f64) -> Self {
        Uniform { min: value - 0.5 * step, max: value + 0.5 * step }
    }

    /// Creates the log-normal distribution that lies between the median divided and multiplied by `factor` as often as a normal one lies within one
    /// standard deviation of its mean.
    pub fn of_factor(median: f64, factor: f64) -> Self {
        LogNormal { median, log_sd: libm::log(factor) }
    }

    /// Returns the distribution of the number divided by `divisor`, which is above zero.
    ///
    /// ```
    /// use planar_impact::Distribution;
    /// let weight = Distribution::Uniform { min: 9806.65, max: 19613.3 };
    /// assert_eq!(weight.over(9.80665), Distribution::Uniform { min: 1000.0, max: 2000.0 });
    /// ```
    #[must_use]
    pub fn over(self, divisor: f64) -> Self {
        let over = |value: f64| value / divisor;
        match self {
            Normal { mean, sd } => Normal { mean: over(mean), sd: over(sd) },
            TruncatedNormal { mode, scale, min, max } => {
                TruncatedNormal { mode: over(mode), scale: over(scale), min: over(min), max: over(max) }
            }
            Uniform { min, max } => Uniform { min: over(min), max: over(max) },
            Triangular { min, mode, max } => Triangular { min: over(min), mode: over(mode), max: over(max) },
            LogNormal { median, log_sd } => LogNormal { median: over(median), log_sd },
            StudentT { mean, sd, n } => StudentT { mean: over(mean), sd: over(sd), n },
        }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// Every parameter that is not finite, not above zero where it must be, or out of order.
    pub fn check(&self) -> Result<(), Issues<InputIssue>> {
        let mut found = IssueCollector::<InputIssue>::new();
        let place = Place::plain;
        match *self {
            Normal { mean, sd } => {
                found.finite(place("mean"), &mean);
                found.positive(place("sd"), &sd);
            }
            TruncatedNormal { mode, scale, min, max } => {
                found.positive(place("scale"), &scale);
                ordered(&mut found, min, max, Some(mode));
            }
            Uniform { min, max } => ordered(&mut found, min, max, None),
            Triangular { min, mode, max } => ordered(&mut found, min, max, Some(mode)),
            LogNormal { median, log_sd } => {
                found.positive(place("median"), &median);
                found.positive(place("log_sd"), &log_sd);
            }
            StudentT { mean, sd, n } => {
                found.finite(place("mean"), &mean);
                found.positive(place("sd"), &sd);
                found.within(place("n"), &f64::from(n), 2.0, None);
            }
        }
        found.finish()
    }

    /// Returns the value that a computation with one number uses: the mean of a normal distribution or of measurements, the mode of a truncated or a
    /// triangular one, the median of a log-normal one, the middle of a uniform one.
    pub fn nominal(&self) -> f64 {
        match *self {
            Normal { mean, .. } | StudentT { mean, .. } => mean,
            TruncatedNormal { mode, .. } | Triangular { mode, .. } => mode,
            Uniform { min, max } => min + 0.5 * (max - min),
            LogNormal { median, .. } => median,
        }
    }

    /// Returns the mean; not a number for [`StudentT`] of two measurements, whose distribution has none.
    pub fn mean(&self) -> f64 {
        match *self {
            Normal { mean, .. } => mean,
            TruncatedNormal { mode, scale, min, max } => mode + scale * Truncation::of(mode, scale, min, max).mean(),
            Uniform { .. } => self.nominal(),
            Triangular { min, mode, max } => mode + ((min - mode) + (max - mode)) / 3.0,
            LogNormal { median, log_sd } => median * libm::exp(0.5 * log_sd * log_sd),
            StudentT { mean, n, .. } if n > 2 => mean,
            StudentT { .. } => f64::NAN,
        }
    }

    /// Returns the standard deviation; infinite for [`StudentT`] of two or three measurements.
    pub fn sd(&self) -> f64 {
        match *self {
            Normal { sd, .. } => sd,
            TruncatedNormal { mode, scale, min, max } => scale * libm::sqrt(Truncation::of(mode, scale, min, max).variance()),
            Uniform { min, max } => (max - min) / libm::sqrt(12.0),
            Triangular { min, mode, max } => {
                let (rise, fall) = (mode - min, max - mode);
                libm::sqrt((rise * rise + rise * fall + fall * fall) / 18.0)
            }
            LogNormal { log_sd, .. } => self.mean() * libm::sqrt(libm::expm1(log_sd * log_sd)),
            StudentT { sd, n, .. } => {
                let freedom = degrees_of_freedom(n);
                if freedom > 2.0 { standard_error(sd, n) * libm::sqrt(freedom / (freedom - 2.0)) } else { f64::INFINITY }
            }
        }
    }

    /// Returns the natural logarithm of the density; −∞ outside the support.
    pub fn log_density(&self, x: f64) -> f64 {
        let (least, most) = self.support();
        if !(least..=most).contains(&x) {
            return if x.is_nan() { f64::NAN } else { f64::NEG_INFINITY };
        }
        match *self {
            Normal { mean, sd } => log_normal_density((x - mean) / sd) - libm::log(sd),
            TruncatedNormal { mode, scale, min, max } => {
                log_normal_density((x - mode) / scale) - libm::log(scale * Truncation::of(mode, scale, min, max).probability())
            }
            Uniform { min, max } => -libm::log(max - min),
            Triangular { min, mode, max } => {
                let side = if x < mode {
                    (x - min) / (mode - min)
                } else if x > mode {
                    (max - x) / (max - mode)
                } else {
                    1.0
                };
                libm::log(2.0 * side / (max - min))
            }
            // The density has the limit 0 at 0, where the logarithm has none.
            LogNormal { .. } if x == 0.0 => f64::NEG_INFINITY,
            LogNormal { median, log_sd } => log_normal_density(libm::log(x / median) / log_sd) - libm::log(log_sd * x),
            StudentT { mean, sd, n } => {
                let scale = standard_error(sd, n);
                student::log_density((x - mean) / scale, degrees_of_freedom(n)) - libm::log(scale)
            }
        }
    }

    /// Returns the least and the greatest possible value, which may be infinite.
    pub fn support(&self) -> (f64, f64) {
        match *self {
            Normal { .. } | StudentT { .. } => (f64::NEG_INFINITY, f64::INFINITY),
            TruncatedNormal { min, max, .. } | Uniform { min, max } | Triangular { min, max, .. } => (min, max),
            LogNormal { .. } => (0.0, f64::INFINITY),
        }
    }
}

/// Returns the number of degrees of freedom of the standard deviation of n measurements.
pub(crate) fn degrees_of_freedom(n: u32) -> f64 {
    f64::from(n) - 1.0
}

/// Returns the standard deviation of the mean of n measurements.
pub(crate) fn standard_error(sd: f64, n: u32) -> f64 {
    sd / libm::sqrt(f64::from(n))
}

/// Checks limits, and a mode between them.
fn ordered(found: &mut IssueCollector<InputIssue>, min: f64, max: f64, mode: Option<f64>) {
    let finite = [("min", min), ("max", max)].map(|(name, value)| found.finite(Place::plain(name), &value));
    if finite != [true, true] {
        return;
    }
    if min >= max {
        found.push(InputIssue::out_of_order(Place::plain("max"), max, min));
    } else if let Some(value) = mode.filter(|mode| !(min..=max).contains(mode)) {
        let kind = InputIssueKind::OutOfRange { value, least: min, greatest: Some(max) };
        found.push(InputIssue { at: Place::plain("mode"), kind });
    }
}

/// Returns the logarithm of the standard normal density, −½ x² − ½ ln 2π.
fn log_normal_density(x: f64) -> f64 {
    /// ½ ln 2π.
    const HALF_LOG_TWO_PI: f64 = 0.918_938_533_204_672_8;
    -0.5 * x * x - HALF_LOG_TWO_PI
}

/// A standard normal distribution between two limits, one on each side of 0.
struct Truncation {
    low: f64,
    high: f64,
}

impl Truncation {
    fn of(mode: f64, scale: f64, min: f64, max: f64) -> Self {
        Truncation { low: (min - mode) / scale, high: (max - mode) / scale }
    }

    /// Returns the probability between the limits: a sum of two terms that are not negative, so that no digits cancel.
    fn probability(&self) -> f64 {
        0.5 * (libm::erf(self.high * core::f64::consts::FRAC_1_SQRT_2) - libm::erf(self.low * core::f64::consts::FRAC_1_SQRT_2))
    }

    /// Returns the mean, (φ(a) − φ(b))/Z.
    fn mean(&self) -> f64 {
        let below = |x: f64| libm::expm1(-0.5 * x * x);
        (below(self.low) - below(self.high)) * libm::exp(log_normal_density(0.0)) / self.probability()
    }

    /// Returns the variance, 1 + (a φ(a) − b φ(b))/Z − mean², or its integral where the difference would cancel.
    fn variance(&self) -> f64 {
        let mean = self.mean();
        if self.high - self.low < 1.0 {
            return self.second_moment_about(mean) / self.probability();
        }
        let end = |x: f64| if x.is_finite() { x * libm::exp(log_normal_density(x)) } else { 0.0 };
        1.0 + (end(self.low) - end(self.high)) / self.probability() - mean * mean
    }

    /// Returns ∫ (x − m)² φ(x) dx by five Gauss points in each of four parts, exact to rounding over a width of less than 1.
    fn second_moment_about(&self, mean: f64) -> f64 {
        const PARTS: i32 = 4;
        // Abramowitz and Stegun, table 25.4.
        const NODES: [(f64, f64); 5] = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_1),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        ];
        let half = 0.5 * (self.high - self.low) / f64::from(PARTS);
        let at = |x: f64| (x - mean) * (x - mean) * libm::exp(log_normal_density(x));
        let part = |k: i32| {
            let middle = self.low + half * f64::from(2 * k + 1);
            NODES.iter().map(|(node, weight)| weight * at(middle + half * node)).sum::<f64>()
        };
        half * (0..PARTS).map(part).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Distribution; 11] = [
        Normal { mean: 3.0, sd: 0.5 },
        TruncatedNormal { mode: 1.0, scale: 2.0, min: -1.0, max: 4.0 },
        TruncatedNormal { mode: 1.0, scale: 2.0, min: 1.0, max: 1.5 },
        TruncatedNormal { mode: 1650.0, scale: 50.0, min: 1500.0, max: 1800.0 },
        Uniform { min: -2.0, max: 1.0 },
        Triangular { min: 1.0, mode: 2.0, max: 5.0 },
        Triangular { min: 1.0, mode: 1.0, max: 5.0 },
        LogNormal { median: 2.0, log_sd: 0.25 },
        LogNormal { median: 1e-3, log_sd: 0.7 },
        StudentT { mean: 0.7, sd: 0.03, n: 6 },
        StudentT { mean: -20.0, sd: 4.0, n: 40 },
    ];

    /// Returns ∫ f(x) p(x) dx by Simpson's rule, over twelve standard deviations of the variable that is normal, or for Student's t of u = arsinh((x − m)/s)
    /// until the second moment of the tails is beyond the last digit.
    fn integral(distribution: &Distribution, f: impl Fn(f64) -> f64) -> f64 {
        const STEPS: usize = 200_000;
        // x and dx/du.
        let of = |u: f64| match *distribution {
            LogNormal { median, .. } => (median * u.exp(), median * u.exp()),
            StudentT { mean, sd, .. } => (mean + sd * u.sinh(), sd * u.cosh()),
            _ => (u, 1.0),
        };
        let (from, to) = match distribution {
            Normal { mean, sd } => (mean - 12.0 * sd, mean + 12.0 * sd),
            LogNormal { log_sd, .. } => (-12.0 * log_sd, 12.0 * log_sd),
            StudentT { .. } => (-14.0, 14.0),
            other => other.support(),
        };
        let step = (to - from) / STEPS as f64;
        let at = |i: usize| {
            let (x, by) = of(if i == STEPS { to } else { from + step * i as f64 });
            f(x) * distribution.log_density(x).exp() * by
        };
        let weight = |i: usize| if i == 0 || i == STEPS { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
        (0..=STEPS).map(|i| weight(i) * at(i)).sum::<f64>() * step / 3.0
    }

    #[test]
    fn the_density_has_the_mean_and_the_standard_deviation() {
        for distribution in ALL {
            let (mean, sd) = (distribution.mean(), distribution.sd());
            assert_eq!(distribution.check(), Ok(()), "{distribution:?}");
            // Simpson's rule loses its order at the kink of a triangle.
            let tolerance = if matches!(distribution, Triangular { .. }) { 1e-9 } else { 1e-11 };
            assert!((integral(&distribution, |_| 1.0) - 1.0).abs() < tolerance, "{distribution:?}");
            assert!((integral(&distribution, |x| (x - mean) / sd)).abs() < tolerance, "{distribution:?}");
            assert!((integral(&distribution, |x| ((x - mean) / sd).powi(2)) - 1.0).abs() < tolerance, "{distribution:?}");
        }
    }

    #[test]
    fn the_density_is_zero_outside_the_support() {
        for distribution in ALL {
            let (least, most) = distribution.support();
            assert!((least..=most).contains(&distribution.nominal()) && (least..=most).contains(&distribution.mean()), "{distribution:?}");
            assert!(distribution.log_density(distribution.nominal()).is_finite(), "{distribution:?}");
            for outside in [least - 1.0, most + 1.0].into_iter().filter(|x| x.is_finite()) {
                assert_eq!(distribution.log_density(outside), f64::NEG_INFINITY, "{distribution:?}");
            }
            assert!(distribution.log_density(f64::NAN).is_nan(), "{distribution:?}");
        }
        assert_eq!(LogNormal { median: 1.0, log_sd: 1.0 }.log_density(0.0), f64::NEG_INFINITY);
    }

    #[test]
    fn values_by_hand() {
        let close = |got: f64, want: f64| assert!((got - want).abs() <= 1e-14 * want.abs(), "{got} {want}");
        // Half-normal: mean √(2/π), variance 1 − 2/π.
        let half = TruncatedNormal { mode: 0.0, scale: 1.0, min: 0.0, max: 60.0 };
        close(half.mean(), (2.0 / std::f64::consts::PI).sqrt());
        close(half.sd(), (1.0 - 2.0 / std::f64::consts::PI).sqrt());
        close(Triangular { min: 0.0, mode: 1.0, max: 2.0 }.sd(), 6.0_f64.sqrt().recip()); // a symmetric triangle of half-width 1
        close(Uniform { min: 0.0, max: 12.0 }.sd(), 12.0_f64.sqrt());
        close(LogNormal { median: 2.0, log_sd: 1.0 }.mean(), 2.0 * 0.5_f64.exp());
        // Nine measurements: a third of their standard deviation, times √(8/6).
        let measured = |n| StudentT { mean: 0.7, sd: 0.03, n };
        close(measured(9).sd(), 0.01 * (8.0_f64 / 6.0).sqrt());
        assert_eq!([measured(4).mean(), measured(3).mean(), measured(2).nominal()], [0.7; 3]);
        assert!(measured(2).mean().is_nan());
        assert_eq!([measured(2).sd(), measured(3).sd()], [f64::INFINITY; 2]);
        // The density of Cauchy, 1/(π s) in its middle and half of it at s = 0.03/√2 from there.
        let cauchy = (std::f64::consts::PI * 0.03 / 2.0_f64.sqrt()).recip();
        close(measured(2).log_density(0.7).exp(), cauchy);
        assert!((measured(2).log_density(0.7 + 0.03 / 2.0_f64.sqrt()).exp() / cauchy - 0.5).abs() < 1e-14);
        assert_eq!(Distribution::of_resolution(10.0, 0.5), Uniform { min: 9.75, max: 10.25 });
        assert_eq!(Distribution::of_resolution(10.0, 0.5).nominal(), 10.0);
    }

    #[test]
    fn limits_of_a_truncated_normal() {
        let close = |got: f64, want: f64, tolerance: f64| assert!((got - want).abs() <= tolerance * want.abs(), "{got} {want}");
        // Far limits leave a normal distribution, and narrow ones a uniform one.
        let far = TruncatedNormal { mode: 5.0, scale: 0.5, min: -1e3, max: 1e3 };
        close(far.mean(), 5.0, 1e-15);
        close(far.sd(), 0.5, 1e-15);
        for width in [1e-3, 1e-6, 1e-9] {
            let narrow = TruncatedNormal { mode: 0.25 * width, scale: 1.0, min: 0.0, max: width };
            close(narrow.mean(), 0.5 * width, width);
            close(narrow.sd(), width / 12.0_f64.sqrt(), width * width + 1e-14);
        }
        // The two ways to its variance meet where one takes over from the other.
        let [below, above] = [1.0 - 1e-9, 1.0].map(|width| TruncatedNormal { mode: 0.0, scale: 1.0, min: 0.0, max: width });
        close(above.sd(), below.sd(), 2e-9);
        let slope = (above.sd() - below.sd()) / 1e-9;
        assert!((slope - 0.28).abs() < 0.02, "{slope}"); // the standard deviation is nearly proportional to the width
    }

    #[test]
    fn other_units_change_the_moments_in_proportion() {
        let (factor, offset) = (0.3048, -7.0);
        let to = |x: f64| factor * x + offset;
        for distribution in ALL {
            let moved = match distribution {
                Normal { mean, sd } => Normal { mean: to(mean), sd: factor * sd },
                TruncatedNormal { mode, scale, min, max } => {
                    TruncatedNormal { mode: to(mode), scale: factor * scale, min: to(min), max: to(max) }
                }
                Uniform { min, max } => Uniform { min: to(min), max: to(max) },
                Triangular { min, mode, max } => Triangular { min: to(min), mode: to(mode), max: to(max) },
                StudentT { mean, sd, n } => StudentT { mean: to(mean), sd: factor * sd, n },
                LogNormal { .. } => continue,
            };
            assert!((moved.mean() - to(distribution.mean())).abs() < 1e-12 * to(distribution.mean()).abs().max(1.0), "{distribution:?}");
            assert!((moved.sd() / (factor * distribution.sd()) - 1.0).abs() < 1e-12, "{distribution:?}");
            let x = distribution.mean();
            assert!((moved.log_density(to(x)) + factor.ln() - distribution.log_density(x)).abs() < 1e-11, "{distribution:?}");
        }
    }

    #[test]
    fn impossible_parameters() {
        let codes = |distribution: Distribution| -> Vec<String> {
            distribution.check().err().into_iter().flatten().map(|issue| format!("{} {:?}", issue.at.name, issue.kind)).collect()
        };
        assert_eq!(codes(Normal { mean: f64::NAN, sd: 0.0 }).len(), 2);
        assert_eq!(codes(Normal { mean: 1.0, sd: -1.0 }), ["sd NotPositive { value: -1.0 }"]);
        assert_eq!(codes(Uniform { min: 1.0, max: 1.0 }), ["max OutOfOrder { value: 1.0, before: 1.0 }"]);
        assert_eq!(codes(Uniform { min: f64::NEG_INFINITY, max: f64::INFINITY }).len(), 2);
        assert_eq!(
            codes(Triangular { min: 0.0, mode: 3.0, max: 2.0 }),
            ["mode OutOfRange { value: 3.0, least: 0.0, greatest: Some(2.0) }"]
        );
        assert_eq!(codes(TruncatedNormal { mode: f64::NAN, scale: 0.0, min: 0.0, max: 1.0 }).len(), 2);
        assert_eq!(codes(LogNormal { median: 0.0, log_sd: 0.0 }).len(), 2);
        assert_eq!(codes(StudentT { mean: f64::NAN, sd: 0.0, n: 1 }).len(), 3);
        assert_eq!(codes(StudentT { mean: 1.0, sd: 1.0, n: 1 }), ["n OutOfRange { value: 1.0, least: 2.0, greatest: None }"]);
        assert_eq!(codes(StudentT { mean: 1.0, sd: -1.0, n: 2 }), ["sd NotPositive { value: -1.0 }"]);
    }
}
