//! What samples say of an uncertain output, with the standard error of each figure.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;
use core::fmt;

use super::model::Model;
use super::points::Filled;
use super::tally::{Moments, Sorted, Tally, nearest_turn};
use super::{Points, Uncertain, UncertainNumber};
use crate::output::Output;
use crate::scalar::rounding_at;
use crate::simulation::{Reduce, RefusedSamples, Samples, reduce};

/// Samples that find where the outputs lie.
const PILOT: u64 = 1024;

/// Independent parts of points that are not independent within: their differences are the standard errors.
const PARTS: u64 = 16;

/// Bins of a density.
const BINS: usize = 60;

/// The probabilities of the quantiles that every output has.
pub const QUANTILES: [f64; 7] = [0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975];

/// A question to samples.
#[derive(Clone, Debug, PartialEq)]
pub struct MonteCarlo<K = Output> {
    /// The number of samples, refused ones included; with a precision, the greatest.
    pub samples: u64,
    /// The seed: the samples depend on nothing else.
    pub seed: u64,
    /// Where they lie.
    pub points: Points,
    /// The standard error at which the mean of every output is good enough, as a share of its magnitude or of its standard deviation, whichever is greater.
    pub precision: Option<f64>,
    /// The probabilities of quantiles beside [`QUANTILES`].
    pub quantiles: Vec<f64>,
    /// The statements whose probability is asked for.
    pub statements: Vec<Threshold<K>>,
}

impl<K> MonteCarlo<K> {
    /// Creates a question to so many random samples.
    #[must_use]
    pub fn of(samples: u64) -> Self {
        MonteCarlo { samples, seed: 0, points: Points::Random, precision: None, quantiles: Vec::new(), statements: Vec::new() }
    }
}

/// A statement: an output is above or below a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold<K = Output> {
    /// The output.
    pub of: K,
    /// `true` if it is said to be above the value, `false` if below.
    pub is_above: bool,
    /// `true` if the value itself counts.
    pub or_equal: bool,
    /// The value in SI; an angle counts from the nominal one, within half a turn.
    pub value: f64,
}

/// A figure from samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimated {
    /// The figure.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The answer of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled<K = Output> {
    /// The samples drawn, refused ones included: fewer than asked for if they were stopped, or if the precision was reached.
    pub samples: u64,
    /// Those that physics refuses; all figures are of the others.
    pub refused: RefusedSamples,
    /// The outputs, in the order of the question.
    pub outputs: Vec<SampledOutput<K>>,
    /// The probability of each statement.
    pub probabilities: Vec<Estimated>,
    /// Whether the precision was reached, if one was asked for.
    pub is_precise: bool,
}

/// An output of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledOutput<K = Output> {
    /// The output.
    pub of: K,
    /// Its mean.
    pub mean: Estimated,
    /// Its standard deviation.
    pub sd: Estimated,
    /// Its third central moment divided by the cube of its standard deviation.
    pub skewness: f64,
    /// Its quantiles, each with its probability: [`QUANTILES`] and those asked for, in increasing order. Beyond all samples, where less than one is expected, the standard
    /// error is NaN.
    pub quantiles: Vec<(f64, Estimated)>,
    /// Edges of bins of equal width, one more than bins, between the quantiles of 0.1 % and 99.9 %.
    pub edges: Vec<f64>,
    /// The share of the samples in each bin.
    pub shares: Vec<f64>,
}

impl<K: Copy + PartialEq + fmt::Debug> Sampled<K> {
    /// Returns an output.
    ///
    /// # Panics
    ///
    /// If the question did not have it.
    pub fn output(&self, of: K) -> &SampledOutput<K> {
        let found = self.outputs.iter().find(|output| output.of == of);
        found.unwrap_or_else(|| panic!("{of:?} is not among the outputs of the question"))
    }
}

/// How many samples fulfill a statement.
#[derive(Clone, Debug, PartialEq)]
struct Count<K> {
    of: Threshold<K>,
    is_angle: bool,
    center: f64,
    samples: u64,
    holds: u64,
}

impl<K: Copy + PartialEq + fmt::Debug + Send + Sync> Reduce<K> for Count<K> {
    fn outputs(&self) -> Vec<K> {
        vec![self.of.of]
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        let Threshold { of, is_above, or_equal, value } = self.of;
        let slack = rounding_at(value);
        let holds = |x: &&f64| {
            let x = if self.is_angle { nearest_turn(**x, self.center) } else { **x };
            let beyond = if is_above { x - value } else { value - x };
            // What is the value itself, such as a friction that limits the ratio, is so but for rounding.
            beyond > slack || (or_equal && beyond >= -slack)
        };
        let column = samples.column(of);
        self.samples += column.len() as u64;
        self.holds += column.iter().filter(holds).count() as u64;
    }

    fn merge(&mut self, later: Self) {
        self.samples += later.samples;
        self.holds += later.holds;
    }
}

impl<K> Count<K> {
    fn share(&self) -> f64 {
        self.holds as f64 / self.samples as f64
    }
}

/// The summaries of one run.
type Summary<K> = (Vec<Tally<K>>, Vec<Count<K>>);

/// A run of samples, or of an independent part of them.
struct Part<K> {
    samples: u64,
    refused: RefusedSamples,
    summary: Summary<K>,
}

impl<M: Model> Uncertain<M> {
    /// Draws samples, and returns moments, quantiles and probabilities of outputs, each with its standard error.
    #[must_use]
    pub fn monte_carlo(&self, of: &[M::Output], question: &MonteCarlo<M::Output>) -> Sampled<M::Output> {
        self.monte_carlo_while(of, question, &|_| true)
    }

    /// The same, stopped when a function of the number of samples that are done returns `false`: it is called from any thread.
    #[must_use]
    pub fn monte_carlo_while(
        &self,
        of: &[M::Output],
        question: &MonteCarlo<M::Output>,
        goes_on: &(dyn Fn(u64) -> bool + Sync),
    ) -> Sampled<M::Output> {
        let empty = self.pilot(of, question);
        let Some(precision) = question.precision else { return self.sampled(question, question.samples, &empty, goes_on) };
        let mut samples = question.samples.min(16 * PILOT);
        loop {
            let found = self.sampled(question, samples, &empty, goes_on);
            // The standard error falls with the root of the number of samples.
            let worst = found.outputs.iter().map(|output| relative(&output.mean, &output.sd) / precision).fold(0.0, f64::max);
            let is_precise = worst <= 1.0;
            let is_stopped = found.samples < samples;
            if is_precise || is_stopped || samples >= question.samples {
                return Sampled { is_precise, ..found };
            }
            let wanted = samples as f64 * worst * worst * 1.1;
            samples = (wanted as u64).clamp(samples + samples / 8, question.samples.max(samples + 1)).min(question.samples);
        }
    }

    /// Finds where the outputs lie, and returns summaries without samples.
    fn pilot(&self, of: &[M::Output], question: &MonteCarlo<M::Output>) -> Summary<M::Output> {
        let nominal: Vec<f64> = self.numbers.iter().map(UncertainNumber::nominal).collect();
        let center = |of: M::Output| Some(self.model.value(&nominal, of)).filter(|x| x.is_finite()).unwrap_or(0.0);
        let first = of.iter().map(|of| Tally::of(*of, self.model.is_angle(*of), center(*of), 1.0)).collect();
        let about = self.part(question, 0, PILOT.min(question.samples), (first, Vec::new()), &|_| true).summary.0;
        let around = |tally: &Tally<M::Output>| {
            let Moments { mean, sd, .. } = tally.moments();
            Tally::of(tally.output(), tally.is_angle(), mean, sd)
        };
        let count = |of: &Threshold<M::Output>| Count {
            of: *of,
            is_angle: self.model.is_angle(of.of),
            // An angle counts within half a turn of zero, as it is printed, if the value lies there.
            center: if of.value.abs() <= PI { 0.0 } else { center(of.of) },
            samples: 0,
            holds: 0,
        };
        (about.iter().map(around).collect(), question.statements.iter().map(count).collect())
    }

    fn part(
        &self,
        question: &MonteCarlo<M::Output>,
        part: u64,
        samples: u64,
        empty: Summary<M::Output>,
        goes_on: &(dyn Fn(u64) -> bool + Sync),
    ) -> Part<M::Output> {
        let fill = Filled { of: self, points: question.points, seed: question.seed, part };
        let reduced = reduce(&fill, samples, empty, goes_on);
        Part { samples: reduced.samples, refused: reduced.refused, summary: reduced.summary }
    }

    fn sampled(
        &self,
        question: &MonteCarlo<M::Output>,
        samples: u64,
        empty: &Summary<M::Output>,
        goes_on: &(dyn Fn(u64) -> bool + Sync),
    ) -> Sampled<M::Output> {
        let several = match question.points {
            Points::Random => 1,
            Points::Sobol => PARTS.min(samples.max(1)),
        };
        let shares: Vec<u64> = (0..several).map(|part| samples / several + u64::from(part < samples % several)).collect();
        let mut parts: Vec<Part<M::Output>> = Vec::with_capacity(shares.len());
        let mut done = 0;
        for (i, share) in shares.into_iter().enumerate() {
            let part = self.part(question, i as u64, share, empty.clone(), &|of_part| goes_on(done + of_part));
            done += part.samples;
            let is_stopped = part.samples < share;
            parts.push(part);
            if is_stopped {
                break;
            }
        }
        answer(question, parts)
    }
}

/// Returns the standard error of a mean as a share of the mean or of the standard deviation.
fn relative(mean: &Estimated, sd: &Estimated) -> f64 {
    let scale = if mean.value.abs() > sd.value { mean.value.abs() } else { sd.value };
    if mean.standard_error == 0.0 { 0.0 } else { mean.standard_error / scale }
}

/// Returns the figures of all parts together. Their standard errors follow from the sample itself, or from the differences of several parts.
fn answer<K: Copy + PartialEq + fmt::Debug + Send + Sync>(question: &MonteCarlo<K>, parts: Vec<Part<K>>) -> Sampled<K> {
    let mut levels: Vec<f64> = QUANTILES.into_iter().chain(question.quantiles.iter().copied()).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut refused = RefusedSamples::default();
    let mut samples = 0;
    for part in &parts {
        samples += part.samples;
        refused.merge(&part.refused);
    }
    let whole = parts.iter().map(|part| part.summary.clone()).reduce(|mut whole, later| {
        whole.merge(later);
        whole
    });
    let (tallies, counts) = whole.unwrap_or_default();
    let several = (parts.len() > 1).then_some(&parts[..]);
    let spread = |of: &dyn Fn(&Summary<K>) -> f64| several.map(|parts| error_of_mean(parts.iter().map(|part| of(&part.summary))));
    let outputs = tallies.iter().enumerate().map(|(i, tally)| {
        let Moments { mean, sd, skewness, kurtosis } = tally.moments();
        let n = tally.samples() as f64;
        let sorted = tally.sorted();
        let parts: Option<Vec<Sorted>> = several.map(|parts| parts.iter().map(|part| part.summary.0[i].sorted()).collect());
        let quantile = |p: f64| {
            let value = sorted.quantile(p);
            let own = || {
                // The probability has a standard error, and the quantile that of its slope.
                let error = libm::sqrt(p * (1.0 - p) / n);
                let (low, high) = ((p - error).max(0.0), (p + error).min(1.0));
                (sorted.quantile(high) - sorted.quantile(low)) * (error / (high - low))
            };
            let of_parts = parts.as_ref().map(|parts| error_of_mean(parts.iter().map(|part| part.quantile(p))));
            // Of a quantile beyond all samples they know that it is no nearer than the outermost one.
            let is_beyond = p.min(1.0 - p) * n < 1.0;
            let standard_error = if is_beyond { f64::NAN } else { of_parts.unwrap_or_else(own) };
            (p, Estimated { value, standard_error })
        };
        let (least, greatest) = (sorted.quantile(0.001), sorted.quantile(0.999));
        let edges: Vec<f64> = (0..=BINS).map(|bin| least + (greatest - least) * (bin as f64 / BINS as f64)).collect();
        SampledOutput {
            of: tally.output(),
            mean: Estimated { value: mean, standard_error: spread(&|part| part.0[i].moments().mean).unwrap_or(sd / libm::sqrt(n)) },
            sd: Estimated {
                value: sd,
                standard_error: spread(&|part| part.0[i].moments().sd)
                    .unwrap_or_else(|| if sd == 0.0 { 0.0 } else { sd * libm::sqrt((kurtosis - 1.0) / (4.0 * n)) }),
            },
            skewness,
            quantiles: levels.iter().map(|p| quantile(*p)).collect(),
            shares: sorted.shares(&edges),
            edges,
        }
    });
    let probability = |(i, count): (usize, &Count<K>)| {
        let p = count.share();
        let n = count.samples as f64;
        // That none or all of the samples fulfill a statement does not make it certain: the next one may be the first.
        let least = (1.0 - 1.0 / n) / n;
        let variance = p * (1.0 - p);
        let own = || libm::sqrt(if variance > least { variance } else { least } / n);
        let of_parts = spread(&|part| part.1[i].share()).filter(|error| *error > 0.0);
        Estimated { value: p, standard_error: of_parts.unwrap_or_else(own) }
    };
    Sampled {
        samples,
        refused,
        outputs: outputs.collect(),
        probabilities: counts.iter().enumerate().map(probability).collect(),
        is_precise: true,
    }
}

/// Returns the standard error of the mean of independent figures.
fn error_of_mean(figures: impl Iterator<Item = f64> + Clone) -> f64 {
    let n = figures.clone().count() as f64;
    let mean = figures.clone().sum::<f64>() / n;
    libm::sqrt(figures.map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n * (n - 1.0)))
}

#[cfg(test)]
mod tests {
    use super::error_of_mean;

    #[test]
    fn the_error_of_a_mean_is_that_of_the_textbook() {
        // Deviations −4/3, −1/3 and 5/3 from the mean: 42/9 over 3 · 2.
        assert!((error_of_mean([1.0, 2.0, 4.0].into_iter()) - (7.0_f64 / 9.0).sqrt()).abs() < 1e-15);
    }
}
