//! LOWESS: locally weighted lines through the nearest samples of a record (Cleveland 1979), with the uncertainty of their value and slope.

use super::estimate::Estimate;
use super::issue::{TestIssue, TestIssues, finite, finite_estimate};
use super::noise::student;
use super::record::{Record, slack_of_times, whole};
use super::weight::dot;
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, is_finite, is_positive, rounding};
use alloc::vec::Vec;
use core::cmp::Ordering;

/// Settings of the smoother.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lowess {
    /// Number of samples in a local line. The farthest of them has zero weight, so at least four are needed.
    pub neighbors: usize,
    /// Number of passes that refit the lines with less weight on samples far from them (bisquare): 0 for clean data, 3 with outliers.
    pub robust_passes: usize,
}

/// A smoothed record, which can evaluate a local line at any time within it.
#[derive(Clone, Debug, PartialEq)]
pub struct Smoothed<T = f64> {
    times: Vec<T>,
    values: Vec<T>,
    neighbors: usize,
    /// What each sample counts for.
    trust: Vec<Trust<T>>,
    /// Variance of one sample about the smoothed record.
    noise: T,
    /// The degrees of freedom from which the noise is estimated.
    freedom: T,
}

/// The local line at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct LocalLine<T = f64> {
    /// The smoothed value, in the unit of the record.
    pub value: Estimate<T>,
    /// The slope at that time, in the same unit per second.
    pub slope: Estimate<T>,
}

/// What a sample counts for by its residual r, which enters the lines as δ r.
#[derive(Clone, Debug, PartialEq)]
struct Trust<T> {
    /// The robustness weight δ.
    weight: T,
    /// The derivative of δ r: by how much the lines follow the sample.
    slope: T,
}

impl<T: Field> Trust<T> {
    /// That of every sample without robustness weights.
    fn whole() -> Self {
        Trust { weight: T::int(1), slope: T::int(1) }
    }
}

/// The weight of each sample in the value and in the slope of a local line.
struct Shares<T> {
    value: Vec<T>,
    slope: Vec<T>,
    /// `false` if too few samples are trusted for a line, so that it is fitted to all that are near.
    is_trusted: bool,
}

impl Lowess {
    /// Smooths a record: at t it fits a least-squares line through the nearest samples, weighted by the tricube (1 − (|t_i − t|/h)³)³, where h is the
    /// distance of the farthest.
    ///
    /// The noise is that of the residuals r = (1 − L) y over its degrees of freedom, Σ r_i² / Σ ‖row i of 1 − L‖², where L is the smoother. It must be the same
    /// for all samples and independent from one to the next. With robustness weights δ the variance of an estimate is that of an M-estimate (Huber 1973):
    /// the mean of ψ² over the square of the mean of ψ′, where ψ = δ r. Weights that are taken as given would make it a quarter too small. A record that is curved within
    /// the span adds a bias that no standard deviation here includes: compare with a shorter span.
    ///
    /// Where the robustness weights leave too few samples for a line, as in a sharp bend that is large beside the noise elsewhere, the line is fitted without them,
    /// and its noise is not less than the scatter about itself.
    ///
    /// The cost grows with the square of the number of samples: a film of a thousand frames takes a million steps for each fit of the lines.
    ///
    /// # Errors
    ///
    /// If there are more neighbors than samples, or the span is too narrow for a line or for measuring the noise from the residuals.
    pub fn smooth<T: Ordered<Mask = bool>>(&self, record: &Record<T>) -> Result<Smoothed<T>, TestIssues<T>> {
        self.smooth_points(record.times(), record.values().to_vec())
    }

    fn smooth_points<T: Ordered<Mask = bool>>(&self, times: Vec<T>, values: Vec<T>) -> Result<Smoothed<T>, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        issues.at_least(Place::plain("neighbors"), self.neighbors, 2);
        issues.at_least(Place::plain("samples for so many neighbors"), values.len(), self.neighbors);
        issues.finish()?;
        let trust = alloc::vec![Trust::whole(); values.len()];
        let mut smoothed = Smoothed { times, values, neighbors: self.neighbors, trust, noise: T::int(0), freedom: T::int(0) };
        for _ in 0..self.robust_passes {
            let Some(trust) = bisquare(&smoothed.residuals()?) else { break };
            smoothed.trust = trust;
        }
        let (noise, freedom) = smoothed.estimate_noise()?;
        (smoothed.noise, smoothed.freedom) = (finite(Place::plain("noise"), noise)?, freedom);
        Ok(smoothed)
    }
}

impl<T: Ordered<Mask = bool>> Smoothed<T> {
    /// Returns the local line at a time within the record, in s.
    ///
    /// # Errors
    ///
    /// If the time is outside the record: a smoother does not extrapolate.
    pub fn at(&self, time: T) -> Result<LocalLine<T>, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        if let [first, .., last] = self.times.as_slice() {
            let slack = slack_of_times(first, last);
            issues.within(Place::of("time", Measure::Time), &time, first.clone() - slack.clone(), Some(last.clone() + slack));
        }
        issues.finish()?;
        let shares = self.shares_at(&time)?;
        let noise = if shares.is_trusted { self.noise.clone() } else { self.noise.clone().larger(self.scatter_about(&time, &shares)) };
        let estimate = |name, shares: &[T]| -> Result<Estimate<T>, TestIssues<T>> {
            finite_estimate(name, Estimate { value: dot(shares, &self.values), variance: dot(shares, shares) * noise.clone() })
        };
        Ok(LocalLine { value: estimate("smoothed value", &shares.value)?, slope: estimate("slope", &shares.slope)? })
    }

    /// Returns the same with a variance of one sample that is not below another, such as a twelfth of the square of the step in which it was read: readings
    /// that a uniform motion crosses in whole steps lie on one line, however coarse they are.
    #[must_use]
    pub fn with_noise_of_at_least(self, noise: T) -> Self {
        Smoothed { noise: self.noise.clone().larger(noise), ..self }
    }

    /// Returns the variance of one sample about the smoothed record, in the square of its unit.
    pub fn noise(&self) -> T {
        self.noise.clone()
    }

    /// Returns the same with a variance of one sample of which 1.96 standard deviations are 95 % of Student's distribution: few samples hardly tell their noise.
    ///
    /// ```
    /// use planar_impact::barrier::{Lowess, Record, TestIssues};
    /// // A point that moves uniformly, with errors to and fro.
    /// let widening = |frames: u32| -> Result<f64, TestIssues> {
    ///     let distances = (0..frames).map(|i| 0.02 * f64::from(i) + if i % 2 == 0 { 1e-3 } else { -1e-3 }).collect();
    ///     let film: Record = Record::uniform(0.0, 0.01, distances)?;
    ///     let smoothed = Lowess { neighbors: 9, robust_passes: 0 }.smooth(&film)?;
    ///     Ok(smoothed.clone().widened().noise() / smoothed.noise())
    /// };
    /// assert!(widening(9)? > 1.4 && widening(90)? < 1.1);
    /// # Ok::<(), TestIssues>(())
    /// ```
    #[must_use]
    pub fn widened(self) -> Self {
        Smoothed { noise: self.noise * student(self.freedom.clone()), ..self }
    }

    fn residuals(&self) -> Result<Vec<T>, TestIssues<T>> {
        let residual = |(time, value): (&T, &T)| Ok(value.clone() - dot(&self.shares_at(time)?.value, &self.values));
        self.times.iter().zip(&self.values).map(residual).collect()
    }

    /// Computes the noise, and its degrees of freedom, from the residuals of the samples that have robustness weights, or of all samples if those leave no degree of freedom.
    fn estimate_noise(&self) -> Result<(T, T), TestIssues<T>> {
        self.noise_with_weights().or_else(|_| {
            let trust = alloc::vec![Trust::whole(); self.values.len()];
            Smoothed { trust, ..self.clone() }.noise_with_weights()
        })
    }

    /// Computes the variance of one sample of which the lines, with their weights taken as given, have the variance of an M-estimate:
    /// σ² = Σψ² (Σδ)³ / ((Σψ′)² Σδ² Σ δ ‖row of 1 − L‖²).
    fn noise_with_weights(&self) -> Result<(T, T), TestIssues<T>> {
        let (mut squares, mut freedom) = (T::int(0), T::int(0));
        for ((i, time), Trust { weight, .. }) in self.times.iter().enumerate().zip(&self.trust) {
            let mut row: Vec<T> = self.shares_at(time)?.value.into_iter().map(|share| -share).collect();
            row[i] = row[i].clone() + T::int(1);
            squares = squares + (weight.clone() * dot(&row, &self.values)).squared();
            freedom = freedom + weight.clone() * dot(&row, &row);
        }
        // Lines through two samples each leave residuals of rounding only.
        if !rounding::<T>().less(&freedom) {
            return Err(TestIssue::SpanTooNarrow { neighbors: self.neighbors, time: self.times[0].clone() }.into());
        }
        let sum = |of: fn(&Trust<T>) -> T| self.trust.iter().map(of).fold(T::int(0), |sum, each| sum + each);
        let (weights, slopes, weights_squared) =
            (sum(|each| each.weight.clone()), sum(|each| each.slope.clone()), sum(|each| each.weight.clone().squared()));
        Ok((squares / freedom.clone() * (weights.clone() / slopes).squared() * weights / weights_squared, freedom))
    }

    /// Computes the variance of one sample about the line at a time, of the samples that have a weight in it.
    fn scatter_about(&self, time: &T, line: &Shares<T>) -> T {
        let (value, slope) = (dot(&line.value, &self.values), dot(&line.slope, &self.values));
        let apart: Vec<T> = self.times.iter().map(|each| each.clone() - time.clone()).collect();
        let (mut squares, mut count) = (T::int(0), 0);
        for ((weight, each), sample) in tricube(&apart, self.neighbors).iter().zip(&apart).zip(&self.values) {
            if is_positive(weight) {
                squares = squares + (sample.clone() - value.clone() - slope.clone() * each.clone()).squared();
                count += 1;
            }
        }
        // Two of them are in the line itself.
        squares / whole::<T>(count.max(3) - 2)
    }

    /// Computes the least-squares line at a time, as the weights of its sums over the samples: of those that are trusted, or of all if those are too few.
    fn shares_at(&self, time: &T) -> Result<Shares<T>, TestIssues<T>> {
        let apart: Vec<T> = self.times.iter().map(|each| each.clone() - time.clone()).collect();
        let near = tricube(&apart, self.neighbors);
        let trusted = near.iter().zip(&self.trust).map(|(near, trust)| near.clone() * trust.weight.clone()).collect();
        self.shares_of(trusted, &apart, time, true).or_else(|_| self.shares_of(near, &apart, time, false))
    }

    fn shares_of(&self, weights: Vec<T>, apart: &[T], time: &T, is_trusted: bool) -> Result<Shares<T>, TestIssues<T>> {
        let total = weights.iter().fold(T::int(0), |sum, weight| sum + weight.clone());
        let too_narrow = || TestIssue::SpanTooNarrow { neighbors: self.neighbors, time: time.clone() };
        if !is_positive(&total) {
            return Err(too_narrow().into());
        }
        let middle = dot(&weights, apart) / total.clone();
        let levers: Vec<T> = weights.iter().zip(apart).map(|(w, each)| w.clone() * (each.clone() - middle.clone())).collect();
        let spread = dot(&levers, apart);
        let size = weights.iter().zip(apart).fold(T::int(0), |sum, (w, each)| sum + w.clone() * each.clone().squared());
        if !(size * rounding::<T>()).less(&spread) {
            return Err(too_narrow().into());
        }
        let slope: Vec<T> = levers.into_iter().map(|lever| lever / spread.clone()).collect();
        let value = weights.into_iter().zip(&slope).map(|(w, lever)| w / total.clone() - middle.clone() * lever.clone()).collect();
        Ok(Shares { value, slope, is_trusted })
    }
}

/// Computes the weight of each sample by its distance, zero from the distance of the last neighbor onward.
fn tricube<T: Ordered<Mask = bool>>(apart: &[T], neighbors: usize) -> Vec<T> {
    let distances: Vec<T> = apart.iter().map(|each| each.clone().magnitude()).collect();
    let mut sorted = distances.clone();
    sorted.sort_by(order);
    let reach = sorted[neighbors - 1].clone();
    let weight = |distance: T| {
        if !distance.less(&reach) {
            return T::int(0);
        }
        let share = distance / reach.clone();
        cubed(T::int(1) - cubed(share))
    };
    distances.into_iter().map(weight).collect()
}

/// Returns δ = (1 − (r/6s)²)² with the median s of the magnitudes, and the slope of δ r, 5 δ − 4 √δ; or `None` if the median is at rounding level: the lines
/// pass through the samples.
fn bisquare<T: Ordered<Mask = bool>>(residuals: &[T]) -> Option<Vec<Trust<T>>> {
    let magnitudes: Vec<T> = residuals.iter().map(|each| each.clone().magnitude()).collect();
    let mut sorted = magnitudes.clone();
    sorted.sort_by(order);
    let half = sorted.len() / 2;
    let median = if sorted.len() % 2 == 1 { sorted[half].clone() } else { (sorted[half - 1].clone() + sorted[half].clone()).half() };
    let mean = magnitudes.iter().fold(T::int(0), |sum, each| sum + each.clone()) / whole::<T>(magnitudes.len());
    let reach = T::int(6) * median;
    if !(mean / T::int(10_000_000)).less(&reach) {
        return None;
    }
    let trust = |magnitude: T| {
        let root = if magnitude.less(&reach) { T::int(1) - (magnitude / reach.clone()).squared() } else { T::int(0) };
        Trust { weight: root.clone().squared(), slope: root.clone() * (T::int(5) * root - T::int(4)) }
    };
    Some(magnitudes.into_iter().map(trust).collect())
}

/// Orders from small to large, with infinities and NaN last, so that the order is total.
fn order<T: Ordered<Mask = bool>>(a: &T, b: &T) -> Ordering {
    is_finite(b).cmp(&is_finite(a)).then_with(|| b.less(a).cmp(&a.less(b)))
}

fn cubed<T: Field>(x: T) -> T {
    x.clone().squared() * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    // R's data set `cars`: speed and stopping distance.
    const SPEED: [u8; 50] = [
        4, 4, 7, 7, 8, 9, 10, 10, 10, 11, 11, 12, 12, 12, 12, 13, 13, 13, 13, 14, 14, 14, 14, 15, 15, 15, 16, 16, 17, 17, 17, 18, 18, 18,
        18, 19, 19, 19, 20, 20, 20, 20, 20, 22, 23, 24, 24, 24, 24, 25,
    ];
    const DISTANCE: [u8; 50] = [
        2, 10, 4, 22, 16, 10, 18, 26, 34, 17, 28, 14, 20, 24, 28, 26, 34, 34, 46, 26, 36, 60, 80, 20, 26, 54, 32, 40, 32, 40, 50, 42, 56,
        76, 84, 36, 46, 68, 32, 48, 52, 56, 64, 66, 54, 70, 92, 93, 120, 85,
    ];

    #[test]
    fn what_r_makes_of_cars() {
        // R, lowess(cars): f = 2/3, so 33 of the 50, and 3 robust passes; at the 19 different speeds.
        let expected = [
            4.965459, 13.124495, 15.858633, 18.579691, 21.280313, 24.129277, 27.119549, 30.027276, 32.962506, 36.757728, 40.435075,
            43.463492, 46.885479, 50.793152, 56.491224, 67.585824, 73.079695, 78.643164, 84.328698,
        ];
        let mut speeds = SPEED.to_vec();
        let points = |from: &[u8]| from.iter().map(|&each| f64::from(each)).collect::<Vec<_>>();
        let smoothed = Lowess { neighbors: 33, robust_passes: 3 }.smooth_points(points(&SPEED), points(&DISTANCE)).expect("enough points");
        speeds.dedup();
        assert_eq!(speeds.len(), expected.len());
        for (speed, expected) in speeds.into_iter().zip(expected) {
            // R assigns weight 0 or 1 to samples within 0.1 % of the span's end, or of the residuals'.
            assert_abs_diff_eq!(smoothed.at(f64::from(speed)).expect("inside").value.value, expected, epsilon = 5e-6);
        }
    }

    #[test]
    fn residuals_far_beyond_the_median_have_no_weight() {
        // (1 − (r/6s)²)² with the median s, in the middle or between the two middle ones.
        for (residuals, median) in [(&[1.0, -2.0, 3.0, -4.0, 30.0][..], 3.0), (&[1.0, -2.0, 4.0, -40.0], 3.0), (&[1.0, 5.0, 2.0], 2.0)] {
            let trust = bisquare(residuals).expect("residuals");
            for (found, residual) in trust.iter().zip(residuals) {
                let weight = |residual: f64| (1.0 - (residual / (6.0 * median)).powi(2)).max(0.0).powi(2);
                assert_abs_diff_eq!(found.weight, weight(*residual), epsilon = 1e-15);
                let [after, before] = [1e-6, -1e-6].map(|step| (residual + step) * weight(residual + step));
                assert_abs_diff_eq!(found.slope, (after - before) / 2e-6, epsilon = 1e-8);
            }
        }
    }

    #[test]
    fn samples_at_one_time_have_no_line() {
        for at in 1..40 {
            let time = 5.0 + 0.04 * f64::from(at);
            let smoothed = Smoothed {
                times: alloc::vec![5.0, 5.0, 9.0],
                values: alloc::vec![1.0, 2.0, 3.0],
                neighbors: 3,
                trust: [1.0, 0.3, 1.0].map(|weight| Trust { weight, slope: 1.0 }).to_vec(),
                noise: 1.0,
                freedom: 1.0,
            };
            assert!(smoothed.at(time).is_err(), "{time}");
        }
    }

    #[test]
    fn one_line_through_all_is_the_textbook() {
        // With a very distant neighbor the weights are all but equal, so the line, its slope and their deviations are those of simple regression.
        // By hand: t = −1, 0, 1, y = 0, 3, 3: slope 3/2, mean 2, residuals −½, 1, −½, σ² = 3/2 over one degree of freedom.
        let smoothed = Smoothed {
            times: alloc::vec![-1.0, 0.0, 1.0, 1e9],
            values: alloc::vec![0.0, 3.0, 3.0, 0.0],
            neighbors: 4,
            trust: alloc::vec![Trust::whole(); 4],
            noise: 1.5,
            freedom: 1.0,
        };
        let line = smoothed.at(0.0).expect("inside");
        assert_abs_diff_eq!(line.value.value, 2.0, epsilon = 1e-9);
        assert_abs_diff_eq!(line.slope.value, 1.5, epsilon = 1e-9);
        assert_abs_diff_eq!(line.value.variance, 0.5, epsilon = 1e-9);
        assert_abs_diff_eq!(line.slope.variance, 0.75, epsilon = 1e-9);
    }

    #[test]
    fn robustness_forgets_an_outlier() {
        let times: Vec<f64> = (0..40).map(f64::from).collect();
        let mut values: Vec<f64> = times.iter().map(|t| 2.0 * t + if t % 2.0 == 0.0 { 0.5 } else { -0.5 }).collect();
        values[20] += 50.0;
        let slope = |robust_passes| {
            let record = Record::at_times(times.clone(), values.clone()).expect("a good record");
            Lowess { neighbors: 15, robust_passes }.smooth(&record).expect("wide enough").at(17.0).expect("inside").slope.value
        };
        assert!((slope(0) - 2.0).abs() > 1.0);
        // The remaining error comes from the zigzag of ½.
        assert_abs_diff_eq!(slope(3), 2.0, epsilon = 0.05);
    }

    /// Slopes at the end and in the middle of uniform motion, whose standard deviations hold the zero as often as two of them should, but for the few degrees of
    /// freedom of short records; weights taken as given would make these shares 0.87 to 0.92 at the end.
    #[test]
    fn robust_slopes_are_as_uncertain_as_they_say() {
        use rand::SeedableRng as _;
        use rand_distr::{Distribution as _, StandardNormal};
        const TRIALS: usize = 600;
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        for (count, neighbors, at_end, noise) in [(21, 9, 0.9, 0.97), (21, 15, 0.915, 0.99), (60, 21, 0.925, 1.0)] {
            let (mut held, mut mean) = ([0; 2], 0.0);
            for _ in 0..TRIALS {
                let values = (0..count).map(|_| StandardNormal.sample(&mut random)).collect();
                let record: Record = Record::uniform(0.0, 1.0, values).expect("a record");
                let smoothed = Lowess { neighbors, robust_passes: 3 }.smooth(&record).expect("wide enough");
                for (held, at) in held.iter_mut().zip([count - 1, count / 2]) {
                    let slope = smoothed.at(at as f64).expect("inside").slope;
                    *held += usize::from(slope.value.abs() <= 2.0 * slope.variance.sqrt());
                }
                mean += smoothed.noise() / TRIALS as f64;
            }
            let [end, middle] = held.map(|held| held as f64 / TRIALS as f64);
            assert!(end > at_end && end < 0.97 && middle > 0.93 && middle < 0.99, "{count} {neighbors}: {end} {middle}");
            assert_abs_diff_eq!(mean, noise, epsilon = 0.06);
        }
    }

    /// Slopes at the end and in the middle of uniform motion in few samples: 1.96 standard deviations that are widened hold 95 %, or more where the lines are short; those
    /// of the residuals as they are hold 81 to 94 % at the end.
    #[test]
    fn widened_slopes_of_few_samples_hold_at_their_rate() {
        use rand::SeedableRng as _;
        use rand_distr::{Distribution as _, StandardNormal};
        const TRIALS: usize = 2000;
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        for (count, neighbors) in [(6, 5), (8, 8), (10, 9), (12, 9), (20, 9), (20, 15), (60, 21)] {
            for robust_passes in [0, 3] {
                let mut held = [0; 2];
                for _ in 0..TRIALS {
                    let values = (0..count).map(|_| StandardNormal.sample(&mut random)).collect();
                    let record: Record = Record::uniform(0.0, 1.0, values).expect("a record");
                    let smoothed = Lowess { neighbors, robust_passes }.smooth(&record).expect("wide enough").widened();
                    for (held, at) in held.iter_mut().zip([count - 1, count / 2]) {
                        let slope = smoothed.at(at as f64).expect("inside").slope;
                        *held += usize::from(slope.value.abs() <= 1.96 * slope.variance.sqrt());
                    }
                }
                let [end, middle] = held.map(|held| held as f64 / TRIALS as f64);
                let most = if count < 10 { 0.985 } else { 0.975 };
                assert!(
                    end > 0.935 && end < most && middle > 0.94 && middle < 0.998,
                    "{count} {neighbors} {robust_passes}: {end} {middle}"
                );
            }
        }
    }

    #[test]
    fn narrow_spans_and_times_outside_are_refused() {
        let record = Record::uniform(0.0, 1.0, alloc::vec![0.0, 1.0, 4.0, 9.0, 16.0]).expect("a good record");
        for neighbors in [0, 1, 2, 3, 6, usize::MAX] {
            assert!(Lowess { neighbors, robust_passes: 0 }.smooth(&record).is_err(), "{neighbors}");
        }
        let smoothed = Lowess { neighbors: 5, robust_passes: 0 }.smooth(&record).expect("wide enough");
        for time in [-0.1, 4.1, f64::NAN] {
            assert!(smoothed.at(time).is_err());
        }
    }

    /// Where the samples beside a time are not trusted, all of them make its line, and their scatter about it is its noise.
    #[test]
    fn a_line_of_samples_that_are_not_trusted_has_their_scatter() {
        let times: Vec<f64> = (0..7).map(f64::from).collect();
        let values = vec![0.0, 1.0, 4.0, 1.0, 4.0, 5.0, 6.0];
        let trust = [true, true, false, false, false, true, true]
            .map(|is_trusted| if is_trusted { Trust::whole() } else { Trust { weight: 0.0, slope: 0.0 } });
        let smoothed = Smoothed { times, values, neighbors: 3, trust: trust.to_vec(), noise: 0.01, freedom: 1.0 };
        // The nearest three are at −1, 0 and 1, and those at the reach have no weight; of four they have (1 − (½)³)³.
        let wide = Smoothed { neighbors: 5, ..smoothed };
        let line = wide.at(3.0).expect("a line");
        // With equal weights w at −1 and 1 and one at 0 the line is level at (1 + 8 w)/(1 + 2 w).
        let w = 0.875_f64.powi(3);
        let level = (1.0 + 8.0 * w) / (1.0 + 2.0 * w);
        let scatter = 2.0 * (4.0 - level).powi(2) + (1.0 - level).powi(2);
        assert_abs_diff_eq!(line.value.value, level, epsilon = 1e-12);
        assert_abs_diff_eq!(line.value.variance, scatter * (1.0 + 2.0 * w * w) / (1.0 + 2.0 * w).powi(2), epsilon = 1e-9);
        assert_abs_diff_eq!(line.slope.variance, scatter / 2.0, epsilon = 1e-9);
        // Of five samples with a weight two are in the line.
        let apart = [-2.0_f64, -1.0, 0.0, 1.0, 2.0];
        let (values, weights) = ([1.0, 4.0, 1.0, 4.0, 5.0], apart.map(|t| (1.0 - (t.abs() / 3.0).powi(3)).powi(3)));
        let trust = [true, false, false, false, false, false, true]
            .map(|is_trusted| if is_trusted { Trust::whole() } else { wide.trust[2].clone() });
        let line = Smoothed { neighbors: 7, trust: trust.to_vec(), ..wide.clone() }.at(3.0).expect("a line");
        let sum = |of: &dyn Fn(usize) -> f64| (0..5).map(of).sum::<f64>();
        let total = sum(&|i| weights[i]);
        let (level, slope) = (
            sum(&|i| weights[i] * values[i]) / total,
            sum(&|i| weights[i] * apart[i] * values[i]) / sum(&|i| weights[i] * apart[i] * apart[i]),
        );
        let scatter = sum(&|i| (values[i] - level - slope * apart[i]).powi(2)) / 3.0;
        assert_abs_diff_eq!(line.value.variance, scatter * sum(&|i| weights[i] * weights[i]) / (total * total), epsilon = 1e-9);
    }
}
