//! What a channel recorded over time: its baseline, its integral, and how uncertain noise leaves the integral.

use super::estimate::Estimate;
use super::findings::{Findings, finite};
use super::problem::{Place, Problem, Problems};
use super::weight::dot;
use crate::scalar::{Field, Ordered};
use alloc::vec::Vec;

/// When a channel was sampled.
#[derive(Clone, Debug, PartialEq)]
pub enum Clock<T = f64> {
    /// At equal intervals.
    Uniform {
        /// The time of the first sample, in s.
        start: T,
        /// From one sample to the next, in s.
        step: T,
    },
    /// At these times, in s.
    Given(Vec<T>),
}

/// A channel over time. Between its samples it is taken to be straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Record<T = f64> {
    clock: Clock<T>,
    values: Vec<T>,
}

/// A stretch of time, both ends in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window<T = f64> {
    /// Its beginning.
    pub from: T,
    /// Its end, later than its beginning.
    pub to: T,
}

impl<T: Ordered<Mask = bool>> Record<T> {
    /// A channel that was sampled at equal intervals: the time of its first sample and the step to the next, in s, and its values.
    ///
    /// # Errors
    ///
    /// Fewer than two values, a step that is not above zero, values that are not finite.
    pub fn uniform(start: T, step: T, values: Vec<T>) -> Result<Self, Problems<T>> {
        let mut findings = check_values(&values);
        findings.finite(Place::of("start"), &start);
        findings.positive(Place::of("step"), &step);
        findings.done()?;
        Ok(Record { clock: Clock::Uniform { start, step }, values })
    }

    /// A channel with the time of each value, in s.
    ///
    /// # Errors
    ///
    /// Fewer than two values, not as many times, times that do not increase, numbers that are not finite.
    pub fn at_times(times: Vec<T>, values: Vec<T>) -> Result<Self, Problems<T>> {
        let mut findings = check_values(&values);
        if times.len() != values.len() {
            findings.push(Problem::NotAlike { place: Place::of("times"), like: "the values, one for each" });
        }
        findings.all_finite("times", &times);
        for (i, pair) in times.windows(2).enumerate() {
            if pair.iter().all(crate::solve::is_finite) && !pair[0].less(&pair[1]) {
                findings.push(Problem::OutOfOrder { place: Place::of("time").at(i + 1), value: pair[1].clone(), before: pair[0].clone() });
            }
        }
        findings.done()?;
        Ok(Record { clock: Clock::Given(times), values })
    }

    /// What the channel reads where nothing acts on it: the mean of the samples in a window before the event, and the variance of one sample about it.
    ///
    /// # Errors
    ///
    /// A window that is none or reaches beyond the record, and fewer than two samples in it.
    pub fn baseline(&self, window: &Window<T>) -> Result<Estimate<T>, Problems<T>> {
        self.check_window(window)?;
        let inside: Vec<T> = self.indices_in(window).map(|i| self.values[i].clone()).collect();
        let mut findings = Findings::none();
        findings.at_least("samples in the baseline", inside.len(), 2);
        findings.done()?;
        let count = whole::<T>(inside.len());
        let value = inside.iter().fold(T::int(0), |sum, each| sum + each.clone()) / count.clone();
        let squares = inside.iter().fold(T::int(0), |sum, each| sum + (each.clone() - value.clone()).squared());
        Ok(Estimate { value, variance: squares / (count - T::int(1)) })
    }

    /// The record less its baseline.
    ///
    /// # Errors
    ///
    /// As [`Self::baseline`].
    pub fn corrected(&self, before: &Window<T>) -> Result<Self, Problems<T>> {
        let offset = self.baseline(before)?.value;
        Ok(self.with_values(self.values.iter().map(|value| value.clone() - offset.clone()).collect()))
    }

    /// The integral over a window by trapezoids, in the unit of the channel times s: of forces in N an impulse in N s. Where the window begins or ends between
    /// two samples, the straight line between them is cut there.
    ///
    /// # Errors
    ///
    /// A window that is none or reaches beyond the record.
    pub fn impulse_over(&self, window: &Window<T>) -> Result<T, Problems<T>> {
        self.check_window(window)?;
        let weights = self.weights_over(window);
        finite("impulse", dot(&weights, &self.values))
    }

    /// The impulse over a window, less the baseline, with its variance from the noise: raw record in, impulse out, in N s.
    ///
    /// The noise is taken as white, of the variance that the baseline shows. Then the impulse, a weighted sum Σ (w_i − Δt/n₀ in the baseline) F_i over the samples, has that
    /// variance times the sum of the squares of the weights: the baseline's own uncertainty grows with the length Δt of the window. Noise that was filtered is
    /// not white; integrate the raw record, as the filter changes no impulse that begins and ends inside the record.
    ///
    /// # Errors
    ///
    /// As [`Self::baseline`] and [`Self::impulse_over`].
    pub fn impulse(&self, over: &Window<T>, before: &Window<T>) -> Result<Estimate<T>, Problems<T>> {
        let baseline = self.baseline(before)?;
        self.check_window(over)?;
        let mut weights = self.weights_over(over);
        let duration = over.to.clone() - over.from.clone();
        let share = duration / whole::<T>(self.indices_in(before).count());
        for i in self.indices_in(before) {
            weights[i] = weights[i].clone() - share.clone();
        }
        let variance = finite("variance of the impulse", dot(&weights, &weights) * baseline.variance)?;
        Ok(Estimate { value: finite("impulse", dot(&weights, &self.values))?, variance })
    }

    fn check_window(&self, window: &Window<T>) -> Result<(), Problems<T>> {
        let mut findings = Findings::none();
        let (first, last) = (self.time(0), self.time(self.len() - 1));
        // Times from a start and a step are rounded.
        let slack = (last.clone() - first.clone()) * crate::solve::slack();
        let (least, greatest) = (first - slack.clone(), last + slack);
        let from = findings.within(Place::of("window from"), &window.from, least.clone(), Some(greatest.clone()));
        let to = findings.within(Place::of("window to"), &window.to, least, Some(greatest));
        if from && to && !window.from.less(&window.to) {
            findings.push(Problem::OutOfOrder { place: Place::of("window to"), value: window.to.clone(), before: window.from.clone() });
        }
        findings.done()
    }

    fn indices_in(&self, window: &Window<T>) -> impl Iterator<Item = usize> {
        (0..self.len()).filter(|&i| {
            let time = self.time(i);
            !time.less(&window.from) && !window.to.less(&time)
        })
    }

    /// What each sample counts in the integral over a window.
    fn weights_over(&self, window: &Window<T>) -> Vec<T> {
        let mut weights = alloc::vec![T::int(0); self.len()];
        let (mut here, mut next) = (self.time(0), self.time(0));
        for i in 0..self.len() - 1 {
            core::mem::swap(&mut here, &mut next);
            next = self.time(i + 1);
            // On a sample, the window's end is taken: the integral moves with it, and with the sample it does not.
            let from = T::select(window.from.less(&here), here.clone(), window.from.clone());
            let to = T::select(next.less(&window.to), next.clone(), window.to.clone());
            if !from.less(&to) {
                continue;
            }
            // The middle of the stretch, as a share of the interval, divides the weight of the line between its two samples.
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
    /// The integral over the whole record by trapezoids, in the unit of the channel times s.
    ///
    /// ```
    /// use planar_impact::barrier::Record;
    /// // A triangle of 20 kN and 0.1 s.
    /// let force = Record::uniform(0.0, 0.05, vec![0.0, 20e3, 0.0])?;
    /// assert_eq!(force.integral(), 1000.0);
    /// # Ok::<(), planar_impact::barrier::Problems>(())
    /// ```
    pub fn integral(&self) -> T {
        self.running_integral().pop().unwrap_or_else(|| T::int(0))
    }

    /// The integral from the first sample to each, by trapezoids.
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

    /// The times of the samples, in s.
    pub fn times(&self) -> Vec<T> {
        (0..self.values.len()).map(|i| self.time(i)).collect()
    }

    pub(super) fn time(&self, index: usize) -> T {
        match &self.clock {
            Clock::Uniform { start, step } => start.clone() + whole::<T>(index) * step.clone(),
            Clock::Given(times) => times[index].clone(),
        }
    }

    /// The same channel with other values, as many as before.
    pub(super) fn with_values(&self, values: Vec<T>) -> Self {
        Record { clock: self.clock.clone(), values }
    }
}

impl<T> Record<T> {
    /// When it was sampled.
    pub fn clock(&self) -> &Clock<T> {
        &self.clock
    }

    /// Its values, one for each sample.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// How many samples it has: two or more.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.values.len()
    }
}

/// A count as a number.
pub(super) fn whole<T: Field>(count: usize) -> T {
    T::from_usize(count).expect("every field contains the integers")
}

fn check_values<T: Ordered<Mask = bool>>(values: &[T]) -> Findings<T> {
    let mut findings = Findings::none();
    findings.at_least("values", values.len(), 2);
    findings.all_finite("values", values);
    findings
}

#[cfg(test)]
mod tests;
