//! Whether a record holds the whole of what it recorded: its resolution, flat tops of an overloaded channel, an end before the event was over.

use super::record::Record;
use crate::scalar::Ordered;
use alloc::vec::Vec;
use core::cmp::Ordering;

/// Least number of equal samples that make a flat top.
const FLAT: usize = 3;

/// A stretch in which a channel stays at its extreme value, as one does that is driven beyond its range.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct FlatTop<T = f64> {
    /// The value, in the unit of the channel.
    pub value: T,
    /// The time of its first sample, in s.
    pub from: T,
    /// The time of its last sample, in s.
    pub to: T,
    /// The number of its samples.
    pub samples: usize,
}

impl<T: Ordered<Mask = bool>> Record<T> {
    /// Returns the smallest difference between two values of the record: its resolution, if it stores steps. `None` if all values are equal.
    pub fn resolution(&self) -> Option<T> {
        self.gaps(self.values()).into_iter().reduce(|least, gap| if gap.less(&least) { gap } else { least })
    }

    /// Returns the differences between neighbors of some numbers in their order, without those that are rounding.
    fn gaps(&self, of: &[T]) -> Vec<T> {
        let mut sorted = of.to_vec();
        sorted.sort_by(|a, b| if a.less(b) { Ordering::Less } else { Ordering::Greater });
        let slack = self.slack();
        sorted.windows(2).map(|pair| pair[1].clone() - pair[0].clone()).filter(|gap| slack.less(gap)).collect()
    }

    /// Returns what readings may be rounded to: the resolution, or the smallest difference between two differences of neighbors, as of 0, 2 and 5.
    fn unit(&self, resolution: &T) -> T {
        let of_gaps = self.gaps(&self.gaps(self.values()));
        of_gaps.into_iter().fold(resolution.clone(), |least, gap| if gap.less(&least) { gap } else { least })
    }

    /// Returns the first stretch at the greatest or at the least value that is too flat for a peak: the channel was driven beyond its range.
    ///
    /// A peak that is stored in steps is flat for some samples too. About such a peak the values fall by at most nine steps within as many samples on each
    /// side as the flat part has, if it is a parabola; a flat top falls by more than twelve on both. A stretch that lasts to the end of the record, such as
    /// the final velocity change, is a flat top if it is reached at once: by at least two steps, and by more than three fifths of the greatest change from
    /// one sample to the next, whatever both are rounded by, after three samples or more; one of the last two changes is at least four fifths of it. Within
    /// a tenth of the whole range from zero or from the first sample lies the unloaded reading, which is never a flat top.
    ///
    /// ```
    /// use planar_impact::barrier::Record;
    /// let pulse = |i: i32| (f64::from(i) * 0.01 * core::f64::consts::PI).sin();
    /// let whole = Record::uniform(0.0, 1e-3, (0..=100).map(pulse).collect())?;
    /// let clipped = Record::uniform(0.0, 1e-3, (0..=100).map(|i| pulse(i).min(0.9)).collect())?;
    /// assert_eq!(whole.flat_top(), None);
    /// assert_eq!(clipped.flat_top().map(|top| (top.value, top.samples)), Some((0.9, 29)));
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    pub fn flat_top(&self) -> Option<FlatTop<T>> {
        let step = self.resolution()?;
        let first = &self.values()[0];
        let extreme = |is_beyond: fn(&T, &T) -> bool| {
            self.values().iter().fold(first.clone(), |best, value| if is_beyond(value, &best) { value.clone() } else { best })
        };
        let [greatest, least] = [extreme(|a, b| b.less(a)), extreme(T::less)];
        let range = greatest.clone() - least.clone();
        let is_far = |from: T| range.less(&(from.magnitude() * T::int(10)));
        let is_loaded = |value: &T| is_far(value.clone()) && is_far(value.clone() - first.clone());
        [greatest, least].into_iter().filter(is_loaded).find_map(|value| self.flat_at(&value, &step))
    }

    fn flat_at(&self, value: &T, step: &T) -> Option<FlatTop<T>> {
        let (values, slack) = (self.values(), self.slack());
        let fall = |i: usize| (values[i].clone() - value.clone()).magnitude();
        let is_flat = |i: usize| !slack.less(&fall(i));
        let exceeds = |fall: T, steps: i32| (step.clone() * T::int(steps)).less(&fall);
        let mut from = 1;
        while let Some(begin) = (from..values.len()).find(|&i| is_flat(i)) {
            let end = (begin..values.len()).find(|&i| !is_flat(i)).unwrap_or(values.len());
            let count = end - begin;
            let is_cut = if end == values.len() {
                let at_once = fall(begin - 1);
                let greatest = values.windows(2).map(|pair| (pair[1].clone() - pair[0].clone()).magnitude());
                let greatest = greatest.reduce(|most, change| if most.less(&change) { change } else { most });
                let unit = self.unit(step);
                // Of a whole half-sine in eight readings the last change is less than a third of the greatest.
                let is_abrupt = greatest.as_ref().is_some_and(|most| {
                    let rounded = (most.clone() + unit.clone()) * T::int(9);
                    (most.clone() * T::int(3)).less(&(at_once.clone() * T::int(5)))
                        && rounded.less(&((at_once.clone() - unit) * T::int(20)))
                });
                let before = if begin >= FLAT { fall(begin - 2) - at_once.clone() } else { T::int(0) };
                let latest = if before.less(&at_once) { at_once.clone() } else { before };
                let is_fast = greatest.is_some_and(|most| !(latest * T::int(5)).less(&(most * T::int(4))));
                begin >= FLAT && is_abrupt && is_fast && !at_once.less(&(step.clone() * T::int(2)))
            } else {
                let beside = [begin.saturating_sub(count), (end - 1 + count).min(values.len() - 1)];
                beside.into_iter().all(|i| exceeds(fall(i), 12))
            };
            if count >= FLAT && is_cut {
                return Some(FlatTop { value: value.clone(), from: self.time(begin), to: self.time(end - 1), samples: count });
            }
            from = end;
        }
        None
    }

    /// Returns the values that differ by rounding alone: a share of the greatest magnitude.
    fn slack(&self) -> T {
        let greatest = self.values().iter().fold(T::int(0), |most, value| {
            let size = value.clone().magnitude();
            if most.less(&size) { size } else { most }
        });
        greatest * crate::scalar::slack()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// A half-sine of 100 ms, 1 ms apart, after 20 ms of nothing, in whole steps.
    fn pulse(height: f64, limit: f64) -> Record {
        let value = |i: i32| (height * (PI * f64::from(i - 20) * 0.01).sin()).clamp(0.0, limit).round();
        Record::uniform(-0.02, 1e-3, (0..140).map(|i| if !(20..=120).contains(&i) { 0.0 } else { value(i) }).collect())
            .expect("a good record")
    }

    #[test]
    fn a_pulse_in_steps_has_no_flat_top() {
        for height in [5.0, 20.0, 100.0, 4000.0] {
            assert_eq!(pulse(height, f64::INFINITY).flat_top(), None, "{height}");
            let negative = pulse(height, f64::INFINITY).values().iter().map(|value| -value).collect();
            assert_eq!(Record::uniform(0.0, 1e-3, negative).expect("a good record").flat_top(), None);
        }
    }

    #[test]
    fn the_resolution_is_the_least_step() {
        assert_eq!(pulse(100.0, f64::INFINITY).resolution(), Some(1.0));
        let thirds: Record =
            Record::uniform(0.0, 1.0, [0.0, 1.0, 3.0, 2.0, 2.0].map(|value: f64| value / 3.0).to_vec()).expect("a good record");
        assert!((thirds.resolution().expect("steps") - 1.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn a_clipped_pulse_has_one_of_either_sign() {
        for share in [0.5, 0.8, 0.95] {
            let clipped = pulse(4000.0, 4000.0 * share);
            let top = clipped.flat_top().expect("a flat top");
            // sin⁻¹ of the share on both sides of the middle, at 50 ms.
            let half = (0.5 - share.asin() / PI) * 0.1;
            assert!((top.value - 4000.0 * share).abs() < 1e-9 && (top.from - (0.05 - half)).abs() < 1.1e-3, "{top:?}");
            let mirrored = Record::uniform(-0.02, 1e-3, clipped.values().iter().map(|value| -value).collect()).expect("a good record");
            assert_eq!(mirrored.flat_top(), Some(FlatTop { value: -top.value, ..top }));
        }
    }

    #[test]
    fn a_final_velocity_is_flat_only_where_it_stops_at_once() {
        // Whole km/h every 10 ms: it slows down before it is constant, or it reaches the end of the range.
        let speeds = |all: &[f64]| Record::uniform(0.0, 0.01, all.to_vec()).expect("a good record");
        assert_eq!(speeds(&[0.0, 3.0, 9.0, 16.0, 22.0, 26.0, 28.0, 28.0, 28.0, 28.0]).flat_top(), None);
        assert_eq!(speeds(&[0.0, 3.0, 9.0, 16.0, 22.0, 26.0, 28.0, 28.0, 28.0, 27.0, 27.0, 27.0]).flat_top(), None);
        let top = speeds(&[0.0, -3.0, -9.0, -16.0, -22.0, -22.0, -22.0]).flat_top().expect("a flat top");
        assert_eq!((top.value, top.from, top.samples), (-22.0, 0.04, 3));
        // It slows down first, by less than the steps before, and holds for longer than it takes to fall again.
        assert_eq!(speeds(&[0.0, 10.0, 20.0, 30.0, 31.0, 36.0, 36.0, 36.0]).flat_top(), None);
        assert_eq!(speeds(&[0.0, 50.0, 100.0, 100.0, 100.0, 99.0, 98.0, 97.0, 60.0, 20.0, 0.0]).flat_top(), None);
        // A half-sine of 90 ms in whole km/h, which ends in three steps at once.
        let half_sine = [0.0, -1.0, -3.0, -6.0, -11.0, -15.0, -20.0, -24.0, -27.0, -30.0, -30.0, -30.0, -30.0, -30.0];
        assert_eq!(speeds(&half_sine).flat_top(), None);
        // Slow in coarse steps, or too few samples to tell.
        assert_eq!(speeds(&[0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0]).flat_top(), None);
        assert_eq!(speeds(&[0.0, 20.0, 20.0, 20.0]).flat_top(), None);
        assert_eq!(speeds(&[2.0; 5]).flat_top(), None);
        assert_eq!(speeds(&[2.0; 5]).resolution(), None);
    }

    /// Wherever a record begins, and whatever its first sample reads by chance, what is left after the pulse is no flat top.
    #[test]
    fn an_unloaded_end_is_no_flat_top() {
        let sound = |values: Vec<f64>| assert_eq!(Record::uniform(0.0, 1e-3, values).expect("a good record").flat_top(), None);
        for (height, offset) in [(300.0, 0.0), (-300.0, 0.0), (300.0, 40.0)] {
            let whole: Vec<f64> =
                pulse(300.0, f64::INFINITY).values().iter().chain(&[0.0; 30]).map(|value| value * height / 300.0 + offset).collect();
            for noise in [-2.0, -1.0, 1.0, 2.0] {
                let mut values = whole.clone();
                values[0] += noise;
                sound(values);
            }
            // It begins within the pulse.
            if offset == 0.0 {
                (21..70).for_each(|begin| sound(whole[begin..].to_vec()));
            }
        }
        // A car that brakes to a stop.
        sound(vec![18.0, 15.0, 12.0, 9.0, 6.0, 3.0, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_pause_between_two_pulses_is_no_flat_top() {
        let twice: Vec<f64> = pulse(100.0, 1e9).values().iter().chain(pulse(100.0, 1e9).values()).copied().collect();
        assert_eq!(Record::uniform(0.0, 1e-3, twice).expect("a good record").flat_top(), None);
    }
}
