//! Channel frequency classes of SAE J211-1: a two-pole Butterworth filter, run over the record forwards and backwards.

use super::issue::{TestIssue, TestIssues};
use super::record::{Clock, Record};
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, Real};
use alloc::vec::Vec;

/// A channel frequency class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ChannelClass {
    /// CFC 60, for barrier forces.
    Cfc60,
    /// CFC 180, for accelerations to be integrated.
    Cfc180,
    /// CFC 600.
    Cfc600,
    /// CFC 1000.
    Cfc1000,
}

/// The filter of a class at a sampling interval, in the notation of SAE J211-1, Annex C: Y_t = a₀ (X_t + 2 X_t−1 + X_t−2) + b₁ Y_t−1 + b₂ Y_t−2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChannelFilter<T = f64> {
    /// a₀ = a₂ = a₁/2: coefficient of the samples.
    pub feed: T,
    /// b₁: coefficient of the last filtered sample.
    pub last: T,
    /// b₂: coefficient of the filtered sample before the last.
    pub last_but_one: T,
    /// The time between two samples, Δt, in s.
    pub step: T,
}

impl ChannelClass {
    /// All classes.
    pub const ALL: [ChannelClass; 4] = [ChannelClass::Cfc60, ChannelClass::Cfc180, ChannelClass::Cfc600, ChannelClass::Cfc1000];

    /// Returns the number of the class, the frequency F_H in Hz up to which the response is flat.
    pub fn number(self) -> i32 {
        match self {
            ChannelClass::Cfc60 => 60,
            ChannelClass::Cfc180 => 180,
            ChannelClass::Cfc600 => 600,
            ChannelClass::Cfc1000 => 1000,
        }
    }

    /// Returns the longest sampling interval, in s: a tenth of a period of F_H, so CFC 60 needs 600 Hz and CFC 1000 needs 10 kHz.
    pub fn longest_step<T: Field>(self) -> T {
        T::int(10 * self.number()).inv()
    }
}

impl<T: Real + Ordered<Mask = bool>> ChannelFilter<T> {
    /// Creates the filter of a class for samples that are `step` seconds apart.
    ///
    /// ```
    /// use planar_impact::barrier::{ChannelClass, ChannelFilter};
    /// let filter = ChannelFilter::<f64>::new(ChannelClass::Cfc60, 1e-4)?;
    /// // −3 dB at 100 Hz, after both passes.
    /// assert!((20.0 * filter.gain(100.0).log10() + 3.0).abs() < 0.05);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the step is not above zero, or is longer than [`ChannelClass::longest_step`].
    pub fn new(class: ChannelClass, step: T) -> Result<Self, TestIssues<T>> {
        let longest: T = class.longest_step();
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        issues.positive(Place::of("step", Measure::Time), &step);
        issues.finish()?;
        if (longest.clone() + longest.clone() * crate::scalar::slack()).less(&step) {
            return Err(TestIssue::SampledTooSlowly { step, longest }.into());
        }
        let pi = T::int(0).arctangent(T::int(-1));
        // ω_d = 2π · 2.0775 CFC is the −3 dB frequency of one pass; that of two passes is 5/3 CFC.
        let corner = T::int(2) * pi * T::int(20775 * class.number()) / T::int(10_000);
        let (sin, cos) = (corner * step.clone()).half().sin_and_cos();
        Ok(Self::of_warped_corner(step, sin / cos, T::int(2).square_root()))
    }

    /// Returns the gain of both passes at a frequency in Hz. The phase is zero.
    pub fn gain(&self, frequency: T) -> T {
        let pi = T::int(0).arctangent(T::int(-1));
        let (sin, cos) = (T::int(2) * pi * frequency * self.step.clone()).sin_and_cos();
        let (sin_twice, cos_twice) = (T::int(2) * sin.clone() * cos.clone(), cos.clone().squared() - sin.clone().squared());
        let ahead = (T::int(2) * self.feed.clone() * (T::int(1) + cos.clone())).squared();
        let real = T::int(1) - self.last.clone() * cos - self.last_but_one.clone() * cos_twice;
        let imaginary = self.last.clone() * sin + self.last_but_one.clone() * sin_twice;
        ahead / (real.squared() + imaginary.squared())
    }
}

impl<T: Field> ChannelFilter<T> {
    /// Creates the filter from ω_a = tan(ω_d Δt/2) and √2, which is irrational. A constant passes unchanged whatever their values.
    #[doc(hidden)]
    pub fn of_warped_corner(step: T, corner: T, root_two: T) -> Self {
        let square = corner.clone().squared();
        let damping = root_two * corner;
        let one = T::int(1);
        let scale = (one.clone() + damping.clone() + square.clone()).inv();
        ChannelFilter {
            feed: square.clone() * scale.clone(),
            last: T::int(2) * (one.clone() - square.clone()) * scale.clone(),
            last_but_one: (damping - one - square) * scale,
            step,
        }
    }

    /// Filters equally spaced samples forwards and backwards, so that nothing is delayed.
    ///
    /// At both ends the whole record is continued by its reflection in its end point, 2 x₀ − x_i, and the filter starts as if the outermost value had always
    /// been there. A constant passes unchanged; so does a straight line, except for what remains of the filter's start-up transient after the length of a
    /// record.
    pub fn filter(&self, samples: &[T]) -> Vec<T> {
        let ([first, tail @ ..], Some(last)) = (samples, samples.last()) else {
            return Vec::new();
        };
        let mirrored = |end: &T, value: &T| T::int(2) * end.clone() - value.clone();
        let before = tail.iter().rev().map(|value| mirrored(first, value));
        let after = samples[..tail.len()].iter().rev().map(|value| mirrored(last, value));
        let mut run: Vec<T> = before.chain(samples.iter().cloned()).chain(after).collect();
        self.pass(&mut run);
        run.reverse();
        self.pass(&mut run);
        run.reverse();
        run.drain(..tail.len());
        run.truncate(samples.len());
        run
    }

    /// Runs one pass, in place.
    fn pass(&self, samples: &mut [T]) {
        let Some(start) = samples.first().cloned() else { return };
        let [mut x1, mut x2, mut y1, mut y2] = [start.clone(), start.clone(), start.clone(), start];
        for sample in samples {
            let x = sample.clone();
            let y = self.feed.clone() * (x.clone() + T::int(2) * x1.clone() + x2)
                + self.last.clone() * y1.clone()
                + self.last_but_one.clone() * y2;
            (x2, x1) = (x1, x);
            (y2, y1) = (y1, y.clone());
            *sample = y;
        }
    }
}

impl<T: Real + Ordered<Mask = bool>> Record<T> {
    /// Returns the record filtered to a channel frequency class, without delay. See [`ChannelFilter::filter`] for the treatment of its ends.
    ///
    /// # Errors
    ///
    /// If the record is not sampled at equal intervals, or is sampled too slowly for the class.
    pub fn filtered(&self, class: ChannelClass) -> Result<Self, TestIssues<T>> {
        let Clock::Uniform { step, .. } = self.clock() else {
            return Err(TestIssue::NotUniform.into());
        };
        let filter = ChannelFilter::new(class, step.clone())?;
        Ok(self.with_values(filter.filter(self.values())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::issue::InputIssue;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    fn decibel(class: ChannelClass, frequency: f64, step: f64) -> f64 {
        let filter = ChannelFilter::new(class, step).expect("fast enough");
        20.0 * filter.gain(frequency).log10()
    }

    #[test]
    fn three_decibels_are_lost_where_the_standard_says() {
        // SAE J211-1: F_N of the classes, in Hz. 2.0775 puts −3 dB of two passes at 1.665 CFC.
        for (class, limit) in ChannelClass::ALL.into_iter().zip([100.0, 300.0, 1000.0, 1650.0]) {
            assert_abs_diff_eq!(decibel(class, limit, 1e-5), -3.0, epsilon = 0.1);
        }
    }

    #[test]
    fn the_response_stays_in_the_corridor() {
        // SAE J211-1, Figure 1: ±½ dB up to F_H, at least −1 dB at F_H, −4 dB at F_N, and beyond it a fall of 9 to 24 dB per octave.
        for class in ChannelClass::ALL {
            let f_h = f64::from(class.number());
            let f_n = if class == ChannelClass::Cfc1000 { 1650.0 } else { f_h / 0.6 };
            for i in 1..=100 {
                let f = f_h * f64::from(i) / 100.0;
                let lower = if i == 100 { -1.0 } else { -0.5 };
                let got = decibel(class, f, 1e-5);
                assert!((lower..=0.5).contains(&got), "{class:?}: {got} dB at {f} Hz");
            }
            for i in 0..=20 {
                let octaves = f64::from(i) / 20.0;
                let (upper, lower) = (0.5 - 9.0 * octaves, -4.0 - 24.0 * octaves);
                let got = decibel(class, f_n * octaves.exp2(), 1e-5);
                assert!((lower..=upper).contains(&got), "{class:?}: {got} dB {octaves} octaves above F_N");
            }
        }
    }

    #[test]
    fn a_sine_keeps_its_phase_and_its_gain() {
        let (step, frequency) = (1e-4, 80.0);
        let filter = ChannelFilter::new(ChannelClass::Cfc60, step).expect("fast enough");
        let phase = |i: i32| core::f64::consts::TAU * frequency * step * f64::from(i);
        let sine: Vec<f64> = (0..4000).map(|i| phase(i).sin()).collect();
        let filtered = filter.filter(&sine);
        let gain = filter.gain(frequency);
        for i in 1000..3000 {
            assert_abs_diff_eq!(filtered[i], gain * sine[i], epsilon = 1e-9);
        }
    }

    #[test]
    fn the_coefficients_are_those_of_the_standard() {
        // SAE J211-1, Annex C, its formulas as printed, at CFC 180 and 10 kHz.
        let wd = 2.0 * core::f64::consts::PI * 180.0 * 2.0775;
        let wa = (wd * 1e-4 / 2.0).sin() / (wd * 1e-4 / 2.0).cos();
        let below = 1.0 + 2_f64.sqrt() * wa + wa * wa;
        let filter = ChannelFilter::new(ChannelClass::Cfc180, 1e-4).expect("fast enough");
        assert_relative_eq!(filter.feed, wa * wa / below, max_relative = 1e-14);
        assert_relative_eq!(filter.last, -2.0 * (wa * wa - 1.0) / below, max_relative = 1e-14);
        assert_relative_eq!(filter.last_but_one, (-1.0 + 2_f64.sqrt() * wa - wa * wa) / below, max_relative = 1e-14);
    }

    #[test]
    fn a_record_too_slow_or_uneven_is_refused() {
        assert!(ChannelFilter::new(ChannelClass::Cfc60, 1.0 / 600.0).is_ok());
        let issues = ChannelFilter::new(ChannelClass::Cfc1000, 1.1e-4).expect_err("too slow");
        assert_eq!(issues.as_slice(), [TestIssue::SampledTooSlowly { step: 1.1e-4, longest: 1e-4 }]);
        let problem = |step: f64| ChannelFilter::new(ChannelClass::Cfc60, step).expect_err("no step").as_slice().to_vec();
        assert!(matches!(
            problem(f64::NAN)[..],
            [TestIssue::Input(InputIssue { kind: crate::issue::InputIssueKind::NotFinite { .. }, .. })]
        ));
        assert_eq!(problem(-1.0), [InputIssue::not_positive(Place::of("step", Measure::Time), -1.0).into()]);
        let uneven = Record::at_times(alloc::vec![0.0, 1.0, 3.0], alloc::vec![0.0; 3]).expect("a good record");
        assert_eq!(uneven.filtered(ChannelClass::Cfc60).expect_err("uneven").as_slice(), [TestIssue::NotUniform]);
    }

    #[test]
    fn a_straight_line_passes_up_to_its_ends() {
        let filter = ChannelFilter::new(ChannelClass::Cfc60, 1e-4).expect("fast enough");
        let line: Vec<f64> = (0..2000).map(|i| 5.0 + 0.01 * f64::from(i)).collect();
        for (value, expected) in filter.filter(&line).into_iter().zip(line) {
            assert_abs_diff_eq!(value, expected, epsilon = 1e-9);
        }
    }

    #[test]
    fn short_and_constant_records_pass() {
        let filter = ChannelFilter::new(ChannelClass::Cfc60, 1e-4).expect("fast enough");
        assert!(filter.filter(&[]).is_empty());
        assert_relative_eq!(filter.filter(&[3.0])[0], 3.0, max_relative = 1e-13);
        for value in filter.filter(&[3.0; 50]) {
            assert_relative_eq!(value, 3.0, max_relative = 1e-12);
        }
    }
}
