//! A channel over time: its baseline, its integral, and the uncertainty of the integral from noise.

use super::estimate::Estimate;
use super::issue::{TestIssue, TestIssues, finite, finite_estimate};
use super::noise::Noise;
use super::sampling::Bends;
use super::weight::dot;
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered};
use alloc::vec::Vec;

/// Sampling times of a channel.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Clock<T = f64> {
    /// At equal intervals.
    Uniform {
        /// The time of the first sample, in s.
        start: T,
        /// Time from one sample to the next, in s.
        step: T,
    },
    /// At these times, in s.
    Given(Vec<T>),
}

/// A channel over time, linear between its samples.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "UncheckedRecord<T>", bound(deserialize = "T: serde::Deserialize<'de> + Ordered<Mask = bool> + core::fmt::Display"))
)]
pub struct Record<T = f64> {
    clock: Clock<T>,
    values: Vec<T>,
}

/// A channel as stored, whose numbers may be invalid.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedRecord<T> {
    clock: Clock<T>,
    values: Vec<T>,
}

#[cfg(feature = "serde")]
impl<T: Ordered<Mask = bool>> TryFrom<UncheckedRecord<T>> for Record<T> {
    type Error = TestIssues<T>;

    fn try_from(stored: UncheckedRecord<T>) -> Result<Self, TestIssues<T>> {
        match stored.clock {
            Clock::Uniform { start, step } => Record::uniform(start, step, stored.values),
            Clock::Given(times) => Record::at_times(times, stored.values),
        }
    }
}

/// An interval of time, both ends in s.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Window<T = f64> {
    /// Its beginning.
    pub from: T,
    /// Its end, later than its beginning.
    pub to: T,
}

impl<T: Ordered<Mask = bool>> Record<T> {
    /// Creates a channel that was sampled at equal intervals: the time of its first sample and the step to the next, in s, and its values.
    ///
    /// # Errors
    ///
    /// If there are fewer than two values, the step is not above zero, or values are not finite.
    pub fn uniform(start: T, step: T, values: Vec<T>) -> Result<Self, TestIssues<T>> {
        let mut issues = check_values(&values);
        issues.finite(Place::of("start", Measure::Time), &start);
        issues.positive(Place::of("step", Measure::Time), &step);
        issues.finish()?;
        Ok(Record { clock: Clock::Uniform { start, step }, values })
    }

    /// Creates a channel with the time of each value, in s.
    ///
    /// # Errors
    ///
    /// If there are fewer than two values, the number of times differs, times do not increase, or numbers are not finite.
    pub fn at_times(times: Vec<T>, values: Vec<T>) -> Result<Self, TestIssues<T>> {
        let mut issues = check_values(&values);
        if times.len() != values.len() {
            issues.push(TestIssue::UnequalLengths { at: Place::plain("times"), like: "the values" });
        }
        issues.all_finite(Place::plain("times"), &times);
        for (i, pair) in times.windows(2).enumerate() {
            if pair.iter().all(crate::scalar::is_finite) && !pair[0].less(&pair[1]) {
                issues.push(InputIssue::out_of_order(Place::of("time", Measure::Time).at(i + 1), pair[1].clone(), pair[0].clone()));
            }
        }
        issues.finish()?;
        Ok(Record { clock: Clock::Given(times), values })
    }

    /// Returns the reading of the unloaded channel: the mean of the samples in a window before the event, and the variance of one sample about it.
    ///
    /// # Errors
    ///
    /// If the window is invalid or extends beyond the record, or contains fewer than two samples.
    pub fn baseline(&self, window: &Window<T>) -> Result<Estimate<T>, TestIssues<T>> {
        self.check_window(window)?;
        let inside: Vec<T> = self.indices_in(window).map(|i| self.values[i].clone()).collect();
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        issues.at_least(Place::plain("samples in the baseline"), inside.len(), 2);
        issues.finish()?;
        let count = whole::<T>(inside.len());
        let value = inside.iter().fold(T::int(0), |sum, each| sum + each.clone()) / count.clone();
        let squares = inside.iter().fold(T::int(0), |sum, each| sum + (each.clone() - value.clone()).squared());
        finite_estimate("baseline", Estimate { value, variance: squares / (count - T::int(1)) })
    }

    /// Returns the record less its baseline.
    ///
    /// # Errors
    ///
    /// As [`Self::baseline`].
    pub fn corrected(&self, before: &Window<T>) -> Result<Self, TestIssues<T>> {
        let offset = self.baseline(before)?.value;
        Ok(self.with_values(self.values.iter().map(|value| value.clone() - offset.clone()).collect()))
    }

    /// Computes the integral over a window by trapezoids, in the unit of the channel times s: forces in N give an impulse in N s. If the window begins or
    /// ends between two samples, the straight line between them is cut there.
    ///
    /// # Errors
    ///
    /// If the window is invalid or extends beyond the record.
    pub fn impulse_over(&self, window: &Window<T>) -> Result<T, TestIssues<T>> {
        self.check_window(window)?;
        let weights = self.weights_over(window);
        finite(Place::plain("impulse"), dot(&weights, &self.values))
    }

    /// Computes the impulse over a window from a raw record, less the baseline, in N s, with its variance from the noise.
    ///
    /// The impulse is a weighted sum Σ (w_i − Δt/n₀ in the baseline) F_i over the samples. Of white noise it has the variance found in the baseline times the
    /// sum of the squares of the weights: the contribution of the baseline grows with the length Δt of the window. Noise that is correlated from sample to
    /// sample, such as that of a filter in the recorder, adds the covariances found in the baseline. They are found the less well, the fewer samples it has and the
    /// farther these are correlated, so that the variance is widened: 1.96 of its root are 95 % of Student's distribution. Integrate the raw record; the filter
    /// does not change an impulse that begins and ends inside the record.
    ///
    /// Between samples the channel is not known, and where its slope changes by Δs, trapezoids of a step h err by up to h²Δs/12. That is the standard deviation
    /// of each such error in the variance: of white noise some hundredths of its own, of a half-sine in ten samples 0.6 % of the impulse. What alternates from
    /// sample to sample beyond the noise is not resolved: each sample then errs by itself, with all of its weight.
    ///
    /// # Errors
    ///
    /// As [`Self::baseline`] and [`Self::impulse_over`].
    pub fn impulse(&self, over: &Window<T>, before: &Window<T>) -> Result<Estimate<T>, TestIssues<T>> {
        let baseline = self.baseline(before)?;
        self.check_window(over)?;
        let mut weights = self.weights_over(over);
        let of_sampling = Bends::of(self).variance_of_integral(&weights, self.indices_in(before), &baseline.variance);
        let duration = over.to.clone() - over.from.clone();
        let share = duration / whole::<T>(self.indices_in(before).count());
        for i in self.indices_in(before) {
            weights[i] = weights[i].clone() - share.clone();
        }
        let variance = self.noise(before, &baseline).wide_variance_of_sum(&weights) + of_sampling;
        finite_estimate("impulse", Estimate { value: dot(&weights, &self.values), variance })
    }

    /// Returns how many independent samples would tell the mean over a window before the event as well: fewer than the samples in it, where noise is correlated.
    ///
    /// # Errors
    ///
    /// As [`Self::baseline`].
    ///
    /// ```
    /// use planar_impact::barrier::{Record, Window};
    /// let slow = Record::uniform(0.0, 1.0, vec![1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0])?;
    /// assert!(slow.independent_samples(&Window { from: 0.0, to: 7.0 })? < 5.0);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    pub fn independent_samples(&self, before: &Window<T>) -> Result<T, TestIssues<T>> {
        let baseline = self.baseline(before)?;
        finite(Place::plain("samples in the baseline"), self.noise(before, &baseline).independent_samples())
    }

    fn noise(&self, before: &Window<T>, baseline: &Estimate<T>) -> Noise<T> {
        let samples: Vec<T> = self.indices_in(before).map(|i| self.values[i].clone()).collect();
        Noise::of(&samples, &baseline.value)
    }

    fn check_window(&self, window: &Window<T>) -> Result<(), TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        let (first, last) = (self.time(0), self.time(self.len() - 1));
        let slack = self.slack_of_time();
        let (least, greatest) = (first - slack.clone(), last + slack);
        let from = issues.within(Place::of("window from", Measure::Time), &window.from, least.clone(), Some(greatest.clone()));
        let to = issues.within(Place::of("window to", Measure::Time), &window.to, least, Some(greatest));
        if from && to && !window.from.less(&window.to) {
            issues.push(InputIssue::out_of_order(Place::of("window to", Measure::Time), window.to.clone(), window.from.clone()));
        }
        issues.finish()
    }

    /// Returns the indices of the samples in a window, those on its edges among them.
    pub fn indices_in(&self, window: &Window<T>) -> impl Iterator<Item = usize> {
        let slack = self.slack_of_time();
        let (from, to) = (window.from.clone() - slack.clone(), window.to.clone() + slack);
        (0..self.len()).filter(move |&i| {
            let time = self.time(i);
            !time.less(&from) && !to.less(&time)
        })
    }

    fn slack_of_time(&self) -> T {
        slack_of_times(&self.time(0), &self.time(self.len() - 1))
    }

    /// Computes the weight of each sample in the integral over a window.
    fn weights_over(&self, window: &Window<T>) -> Vec<T> {
        let mut weights = alloc::vec![T::int(0); self.len()];
        let (mut here, mut next) = (self.time(0), self.time(0));
        for i in 0..self.len() - 1 {
            core::mem::swap(&mut here, &mut next);
            next = self.time(i + 1);
            // If the window ends on a sample, use the window's end: the integral depends on it, and not on the sample.
            let from = window.from.clone().larger(here.clone());
            let to = window.to.clone().smaller(next.clone());
            if !from.less(&to) {
                continue;
            }
            // The middle of the interval, as a share of the step, divides the weight of the line between its two samples.
            let middle = ((from.clone() + to.clone()).half() - here.clone()) / (next.clone() - here.clone());
            let duration = to - from;
            let later = middle * duration.clone();
            weights[i] = weights[i].clone() + duration - later.clone();
            weights[i + 1] = weights[i + 1].clone() + later;
        }
        weights
    }
}

impl<T: Field> Record<T> {
    /// Computes the integral over the whole record by trapezoids, in the unit of the channel times s.
    ///
    /// ```
    /// use planar_impact::barrier::Record;
    /// // A triangle of 20 kN and 0.1 s.
    /// let force = Record::uniform(0.0, 0.05, vec![0.0, 20e3, 0.0])?;
    /// assert_eq!(force.integral(), 1000.0);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    pub fn integral(&self) -> T {
        self.running_integral().pop().unwrap_or_else(|| T::int(0))
    }

    /// Computes the integral from the first sample to each, by trapezoids.
    pub fn running_integral(&self) -> Vec<T> {
        let mut sum = T::int(0);
        let mut sums = alloc::vec![sum.clone()];
        for (i, pair) in self.values.windows(2).enumerate() {
            let interval = match &self.clock {
                Clock::Uniform { step, .. } => step.clone(),
                Clock::Given(times) => times[i + 1].clone() - times[i].clone(),
            };
            sum = sum + (pair[0].clone() + pair[1].clone()).half() * interval;
            sums.push(sum.clone());
        }
        sums
    }

    /// Returns the times of the samples, in s.
    pub fn times(&self) -> Vec<T> {
        (0..self.values.len()).map(|i| self.time(i)).collect()
    }

    pub(super) fn time(&self, index: usize) -> T {
        match &self.clock {
            Clock::Uniform { start, step } => start.clone() + whole::<T>(index) * step.clone(),
            Clock::Given(times) => times[index].clone(),
        }
    }

    /// Returns the same channel with other values, as many as before.
    pub(super) fn with_values(&self, values: Vec<T>) -> Self {
        Record { clock: self.clock.clone(), values }
    }
}

impl<T> Record<T> {
    /// Returns the sampling times.
    pub fn clock(&self) -> &Clock<T> {
        &self.clock
    }

    /// Returns its values, one for each sample.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// Returns the number of samples, at least two.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.values.len()
    }
}

/// Returns the difference of times between two others that are the same: those computed from a start and a step are rounded.
pub(super) fn slack_of_times<T: Ordered<Mask = bool>>(first: &T, last: &T) -> T {
    (last.clone() - first.clone()) * crate::scalar::slack()
}

/// Converts a count to a number.
pub(super) fn whole<T: Field>(count: usize) -> T {
    T::from_usize(count).expect("every field contains the integers")
}

fn check_values<T: Ordered<Mask = bool>>(values: &[T]) -> IssueCollector<TestIssue<T>> {
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    issues.at_least(Place::plain("values"), values.len(), 2);
    issues.all_finite(Place::plain("values"), values);
    issues
}

#[cfg(test)]
mod tests;
