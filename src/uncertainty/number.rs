//! The distribution of one uncertain number.

use alloc::vec::Vec;

use crate::distribution::Distribution;
use crate::distribution::quantile::{cumulative, standard};
use crate::issue::{InputIssue, IssueCollector, Issues, Place};

/// The distribution of an uncertain number, by a formula or by values that were measured.
#[derive(Clone, Debug, PartialEq)]
pub enum UncertainNumber {
    /// A distribution that has a formula.
    Of(Distribution),
    /// Values, each as likely as any other: draws take them with replacement.
    Values(Values),
}

/// Measured values of a number, in increasing order.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(Vec<f64>);

impl Values {
    /// Creates the distribution of measured values.
    ///
    /// # Errors
    ///
    /// Each value that is not finite, and fewer than two values.
    pub fn new(mut values: Vec<f64>) -> Result<Self, Issues<InputIssue>> {
        let mut found = IssueCollector::<InputIssue>::new();
        values.iter().for_each(|value| {
            found.finite(Place::plain("values"), value);
        });
        if values.len() < 2 {
            found.push(InputIssue::too_few(Place::plain("values"), values.len(), 2));
        }
        found.finish()?;
        values.sort_by(f64::total_cmp);
        Ok(Values(values))
    }

    /// Returns the values in increasing order.
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }

    fn mean_of(&self, f: impl Fn(f64) -> f64) -> f64 {
        self.0.iter().map(|x| f(*x)).sum::<f64>() / self.0.len() as f64
    }
}

/// Central moments of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Central {
    pub(super) second: f64,
    pub(super) third: f64,
    pub(super) fourth: f64,
}

impl From<Distribution> for UncertainNumber {
    fn from(distribution: Distribution) -> Self {
        UncertainNumber::Of(distribution)
    }
}

impl UncertainNumber {
    /// Returns the number below which a draw lies with a probability. At 0 and 1 it is an end of the support.
    pub fn quantile(&self, probability: f64) -> f64 {
        match self {
            UncertainNumber::Of(distribution) => distribution.quantile(probability),
            UncertainNumber::Values(Values(values)) => {
                let place = (probability * values.len() as f64) as usize;
                if probability.is_nan() { f64::NAN } else { values[place.min(values.len() - 1)] }
            }
        }
    }

    /// Returns the quantile at which a standard normal number has the same probability below it.
    pub(super) fn of_score(&self, score: f64) -> f64 {
        match self {
            UncertainNumber::Of(Distribution::Normal { mean, sd }) => mean + sd * score,
            UncertainNumber::Of(Distribution::LogNormal { median, log_sd }) => median * libm::exp(log_sd * score),
            // By symmetry, because a probability near 1 has lost the digits of a long tail.
            UncertainNumber::Of(Distribution::StudentT { mean, .. }) if score > 0.0 => 2.0 * mean - self.quantile(cumulative(-score)),
            _ => self.quantile(cumulative(score)),
        }
    }

    /// Returns the value that a computation with one number uses; of values their mean.
    pub fn nominal(&self) -> f64 {
        match self {
            UncertainNumber::Of(distribution) => distribution.nominal(),
            UncertainNumber::Values(_) => self.mean(),
        }
    }

    /// Returns the mean; NaN if there is none.
    pub fn mean(&self) -> f64 {
        match self {
            UncertainNumber::Of(distribution) => distribution.mean(),
            UncertainNumber::Values(values) => values.mean_of(|x| x),
        }
    }

    /// Returns the standard deviation; infinite or NaN if there is none.
    pub fn sd(&self) -> f64 {
        match self {
            UncertainNumber::Of(distribution) => distribution.sd(),
            UncertainNumber::Values(values) => {
                let mean = self.mean();
                libm::sqrt(values.mean_of(|x| (x - mean) * (x - mean)))
            }
        }
    }

    /// Returns the range of its values, infinite ends replaced by the quantiles of a normal number at so many standard deviations.
    pub fn range(&self, deviations: f64) -> (f64, f64) {
        match self {
            UncertainNumber::Of(distribution) => {
                let (least, greatest) = distribution.support();
                let is_log = matches!(distribution, Distribution::LogNormal { .. });
                let end = |end: f64, score: f64| if end.is_finite() && !is_log { end } else { self.of_score(score) };
                (end(least, -deviations), end(greatest, deviations))
            }
            UncertainNumber::Values(Values(values)) => (values[0], values[values.len() - 1]),
        }
    }

    /// Returns `true` if its range is limited, without a choice of deviations.
    pub fn is_limited(&self) -> bool {
        match self {
            UncertainNumber::Of(distribution) => {
                let (least, greatest) = distribution.support();
                least.is_finite() && greatest.is_finite()
            }
            UncertainNumber::Values(_) => true,
        }
    }

    /// Returns a number C for which the variance of any function f of it is at most C times the mean of f′² (a Poincaré constant), or `None` if there is none.
    pub(super) fn poincare(&self) -> Option<f64> {
        // Payne and Weinberger: any density with a concave logarithm between limits has that of the uniform one at most.
        let between = |min: f64, max: f64| (max - min) * (max - min) / (core::f64::consts::PI * core::f64::consts::PI);
        match self {
            UncertainNumber::Of(Distribution::Normal { sd, .. }) => Some(sd * sd),
            UncertainNumber::Of(Distribution::Uniform { min, max } | Distribution::Triangular { min, max, .. }) => {
                Some(between(*min, *max))
            }
            // Truncation does not widen a normal density.
            UncertainNumber::Of(Distribution::TruncatedNormal { scale, min, max, .. }) => Some(between(*min, *max).min(scale * scale)),
            UncertainNumber::Of(_) | UncertainNumber::Values(_) => None,
        }
    }

    /// Returns its central moments; infinite or NaN where there are none.
    pub(super) fn central(&self) -> Central {
        let second = self.sd() * self.sd();
        let of = |third: f64, fourth: f64| Central { second, third, fourth };
        match self {
            UncertainNumber::Of(Distribution::Normal { .. }) => of(0.0, 3.0 * second * second),
            UncertainNumber::Of(Distribution::Uniform { .. }) => of(0.0, 1.8 * second * second),
            UncertainNumber::Of(Distribution::Triangular { min, mode, max }) => {
                let (a, b, c) = (*min, *max, *mode);
                of((a + b - 2.0 * c) * (2.0 * a - b - c) * (a - 2.0 * b + c) / 270.0, 2.4 * second * second)
            }
            UncertainNumber::Of(Distribution::LogNormal { log_sd, .. }) => {
                let w = libm::exp(log_sd * log_sd);
                let skewness = (w + 2.0) * libm::sqrt(w - 1.0);
                of(skewness * second * self.sd(), (w * w * (w * w + 2.0 * w + 3.0) - 3.0) * second * second)
            }
            UncertainNumber::Values(values) => {
                let mean = self.mean();
                of(values.mean_of(|x| libm::pow(x - mean, 3.0)), values.mean_of(|x| libm::pow(x - mean, 4.0)))
            }
            // With ν degrees of freedom moments below the ν-th are finite.
            UncertainNumber::Of(Distribution::StudentT { n, .. }) => {
                let freedom = f64::from(*n) - 1.0;
                let fourth = if freedom > 4.0 { (3.0 + 6.0 / (freedom - 4.0)) * second * second } else { f64::INFINITY };
                of(if freedom > 3.0 { 0.0 } else { f64::NAN }, fourth)
            }
            UncertainNumber::Of(_) => {
                let mean = self.mean();
                of(self.expected(|x, _| libm::pow(x - mean, 3.0)), self.expected(|x, _| libm::pow(x - mean, 4.0)))
            }
        }
    }

    /// Returns the expected value of a function of the number and its normal score, to about six digits: the trapezoidal rule over scores.
    fn expected(&self, f: impl Fn(f64, f64) -> f64) -> f64 {
        scores().map(|(score, weight)| weight * f(self.of_score(score), score)).sum()
    }

    /// Returns the first coefficients of its Hermite series in the normal score, x = Σ c_k He_k(z)/√k!, but for the constant.
    pub(super) fn hermite(&self) -> [f64; TERMS] {
        if let UncertainNumber::Of(Distribution::Normal { sd, .. }) = self {
            let mut only = [0.0; TERMS];
            only[0] = *sd;
            return only;
        }
        let mut found = [0.0; TERMS];
        if let UncertainNumber::Values(Values(values)) = self {
            // A step at z adds ∫ He_k φ from z on, which is He_{k−1}(z) φ(z).
            for (i, pair) in values.windows(2).enumerate() {
                let z = standard((i + 1) as f64 / values.len() as f64);
                let step = (pair[1] - pair[0]) * libm::exp(-0.5 * z * z) / libm::sqrt(2.0 * core::f64::consts::PI);
                let polynomials = core::iter::once(1.0).chain(normalized_hermite(z));
                found.iter_mut().zip(polynomials).enumerate().for_each(|(k, (to, at_z))| *to += step * at_z / libm::sqrt((k + 1) as f64));
            }
            return found;
        }
        for (score, weight) in scores() {
            let weighted = weight * self.of_score(score);
            found.iter_mut().zip(normalized_hermite(score)).for_each(|(to, at_score)| *to += weighted * at_score);
        }
        found
    }
}

/// Returns normal scores with their weights: the trapezoidal rule.
fn scores() -> impl Iterator<Item = (f64, f64)> {
    /// A step that divides the range, where a density with corners is the hardest.
    const STEP: f64 = 1.0 / 256.0;
    const END: i32 = 9 * 256;
    let unit = STEP / libm::sqrt(2.0 * core::f64::consts::PI);
    (-END..=END).map(move |k| {
        let score = f64::from(k) * STEP;
        (score, unit * libm::exp(-0.5 * score * score))
    })
}

/// Number of terms of a Hermite series: those of measured values, which have steps, fall slowly, and all count where two numbers are closely correlated.
pub(super) const TERMS: usize = 96;

/// Returns He_k(z)/√k! for k = 1, 2 and so on by its recurrence.
fn normalized_hermite(z: f64) -> impl Iterator<Item = f64> {
    let (mut before, mut here) = (0.0, 1.0);
    (0..TERMS).map(move |i| {
        let i = i as f64;
        (before, here) = (here, (z * here - libm::sqrt(i) * before) / libm::sqrt(i + 1.0));
        here
    })
}

/// Returns the covariance of two numbers whose normal scores have a coefficient of correlation: Σ ρ^k c_k d_k.
pub(super) fn covariance(one: &[f64; TERMS], other: &[f64; TERMS], coefficient: f64) -> f64 {
    let mut power = 1.0;
    one.iter()
        .zip(other)
        .map(|(c, d)| {
            power *= coefficient;
            power * c * d
        })
        .sum()
}

/// Returns the score of a probability.
pub(super) fn score(probability: f64) -> f64 {
    standard(probability)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Distribution::{LogNormal, Normal, StudentT, Triangular, TruncatedNormal, Uniform};

    fn shapes() -> [UncertainNumber; 7] {
        [
            Normal { mean: 3.0, sd: 2.0 }.into(),
            Uniform { min: -1.0, max: 5.0 }.into(),
            Triangular { min: 1.0, mode: 1.5, max: 4.0 }.into(),
            LogNormal { median: 20.0, log_sd: 0.4 }.into(),
            TruncatedNormal { mode: 0.2, scale: 0.5, min: 0.0, max: 1.0 }.into(),
            StudentT { mean: 0.7, sd: 0.1, n: 40 }.into(),
            UncertainNumber::Values(Values::new(vec![1.0, 2.0, 2.0, 7.0]).expect("values")),
        ]
    }

    #[test]
    fn central_moments_are_those_of_quantiles() {
        for number in shapes() {
            // The midpoint rule in u, with the probability u³ (10 − 15 u + 6 u²), whose slope leaves nothing at the ends of long tails.
            let n = 20_000;
            let nodes: Vec<(f64, f64)> = (0..n)
                .map(|i| (f64::from(i) + 0.5) / f64::from(n))
                .map(|u| (u * u * u * (10.0 + u * (6.0 * u - 15.0)), 30.0 * (u * (1.0 - u)).powi(2) / f64::from(n)))
                .map(|(probability, weight)| (number.quantile(probability) - number.mean(), weight))
                .collect();
            let moment = |k: i32| nodes.iter().map(|(x, weight)| weight * x.powi(k)).sum::<f64>();
            let Central { second, third, fourth } = number.central();
            for (k, found) in [(1, 0.0), (2, second), (3, third), (4, fourth)] {
                let (wanted, scale) = (moment(k), number.sd().powi(k));
                // Steps of values lie between two nodes; Student's t is near a power in its tails.
                assert!((found - wanted).abs() < 1e-3 * scale, "{number:?} {k}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn a_covariance_is_that_of_the_copula() {
        let series = shapes().map(|shape| (shape.hermite(), shape));
        for (i, (of_one, one)) in series.iter().enumerate() {
            for (of_other, other) in &series[..=i] {
                for r in [-0.8, 0.5] {
                    let found = covariance(of_one, of_other, r);
                    // The midpoint rule over two independent scores; the steps of values make both sides coarse.
                    let has_steps = [one, other].into_iter().any(|shape| matches!(shape, UncertainNumber::Values(_)));
                    let (per_score, coarse) = if has_steps { (20, 0.02) } else { (8, 1e-4) };
                    let scores = || (0..12 * per_score).map(|i| (f64::from(i) + 0.5) / f64::from(per_score) - 6.0);
                    let weight = |z: f64| (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt() / f64::from(per_score);
                    let along = |z: f64| -> f64 {
                        scores().map(|w| weight(w) * (other.of_score(r * z + (1.0 - r * r).sqrt() * w) - other.mean())).sum()
                    };
                    let wanted: f64 = scores().map(|z| weight(z) * (one.of_score(z) - one.mean()) * along(z)).sum();
                    assert!((found - wanted).abs() < coarse * one.sd() * other.sd(), "{one:?} {other:?} {r}: {found} {wanted}");
                }
            }
        }
        // The signs of two normal scores, and two uniform numbers, have covariances with a formula.
        let signs = UncertainNumber::Values(Values::new(vec![-1.0, 1.0]).expect("values")).hermite();
        let uniform = UncertainNumber::from(Uniform { min: 0.0, max: 1.0 }).hermite();
        for r in [-0.95, -0.5, 0.2, 0.9] {
            let found = [covariance(&signs, &signs, r), covariance(&uniform, &uniform, r)];
            let wanted = [2.0 / core::f64::consts::PI * libm::asin(r), 0.5 / core::f64::consts::PI * libm::asin(0.5 * r)];
            assert!((found[0] - wanted[0]).abs() < 1e-4 && (found[1] - wanted[1]).abs() < 1e-7, "{r}: {found:?} {wanted:?}");
        }
        let of_three = UncertainNumber::from(StudentT { mean: 0.7, sd: 0.03, n: 3 }).central();
        assert!(of_three.second == f64::INFINITY && of_three.third.is_nan() && of_three.fourth == f64::INFINITY);
        let [normal, ..] = shapes();
        assert_eq!(covariance(&normal.hermite(), &normal.hermite(), 0.25), 1.0);
    }

    #[test]
    fn a_greater_score_has_a_greater_quantile() {
        for number in shapes() {
            let quantiles = (-80..=80).map(|i| number.of_score(f64::from(i) / 10.0)).collect::<Vec<_>>();
            assert!(quantiles.is_sorted() && quantiles.iter().all(|x| x.is_finite()), "{number:?}");
        }
        let student = UncertainNumber::from(StudentT { mean: 0.7, sd: 0.1, n: 40 });
        // Beyond a score of 8.3 the probability below is 1 as a float.
        assert!((student.of_score(9.0) + student.of_score(-9.0) - 1.4).abs() < 1e-15 && student.of_score(9.0) > student.of_score(8.0));
    }

    #[test]
    fn values_are_drawn_as_they_are() {
        let [.., values] = shapes();
        assert_eq!([0.0, 0.2, 0.3, 0.74, 0.75, 1.0].map(|p| values.quantile(p)), [1.0, 1.0, 2.0, 2.0, 7.0, 7.0]);
        assert_eq!((values.nominal(), values.range(3.0), values.is_limited()), (3.0, (1.0, 7.0), true));
        assert!(Values::new(vec![]).is_err() && Values::new(vec![1.0]).is_err());
        assert!(Values::new(vec![1.0, f64::NAN]).is_err());
    }

    #[test]
    fn ranges_have_limits_or_deviations() {
        let [normal, uniform, _, log_normal, truncated, ..] = shapes();
        assert_eq!((normal.range(2.0), normal.is_limited()), ((-1.0, 7.0), false));
        assert_eq!((uniform.range(2.0), uniform.is_limited()), ((-1.0, 5.0), true));
        assert_eq!(truncated.range(1.0), (0.0, 1.0));
        let (low, high) = log_normal.range(3.0);
        assert!((low * high / 400.0 - 1.0).abs() < 1e-14 && (high / 20.0 - 1.2_f64.exp()).abs() < 1e-14 && !log_normal.is_limited());
    }

    #[test]
    fn values_are_kept_in_order() {
        assert_eq!(Values::new(vec![7.0, 1.0, 2.0]).map(|values| values.as_slice().to_vec()), Ok(vec![1.0, 2.0, 7.0]));
    }
}
