//! One output of many samples: its moments and quantiles.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};
use core::fmt;

use crate::batch::{Instructions, Vectors};
use crate::simulation::quantiles::{self, Bins};
use crate::simulation::{Reduce, Samples};

/// Numbers that are added side by side, so that the sum has the same bits whatever the vector instructions.
const WIDTH: usize = 8;

/// Distances from the center below this share of the scale count as none.
const NEAREST: f64 = 1.0 / (1 << 20) as f64;

/// Sums of powers and bins of an output, in a unit in which it is near 1 and about 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tally<K> {
    of: K,
    is_angle: bool,
    center: f64,
    scale: f64,
    samples: u64,
    sums: [f64; 4],
    bins: Bins,
}

/// Moments of an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moments {
    pub(super) mean: f64,
    pub(super) sd: f64,
    pub(super) skewness: f64,
    /// The fourth central moment divided by the square of the variance.
    pub(super) kurtosis: f64,
}

impl<K: Copy> Tally<K> {
    /// Creates the summary of no samples of an output that is expected about a center, within a few times a scale of it.
    pub(super) fn of(of: K, is_angle: bool, center: f64, scale: f64) -> Self {
        let is_usable = center.is_finite() && scale.is_finite() && scale > 0.0;
        let (center, scale) = if is_usable { (center, scale) } else { (if center.is_finite() { center } else { 0.0 }, 1.0) };
        Tally { of, is_angle, center, scale, samples: 0, sums: [0.0; 4], bins: Bins::default() }
    }

    pub(super) fn is_angle(&self) -> bool {
        self.is_angle
    }

    pub(super) fn output(&self) -> K {
        self.of
    }

    pub(super) fn samples(&self) -> u64 {
        self.samples
    }

    /// Returns the moments; NaN where there are too few samples, or one is not finite.
    pub(super) fn moments(&self) -> Moments {
        let n = self.samples as f64;
        let [m, s2, s3, s4] = self.sums.map(|sum| sum / n);
        let second = s2 - m * m;
        // Rounding of numbers that are all the same.
        let second = if second < 0.0 { 0.0 } else { second };
        let third = s3 - 3.0 * m * s2 + 2.0 * m * m * m;
        let fourth = s4 - 4.0 * m * s3 + 6.0 * m * m * s2 - 3.0 * m * m * m * m;
        Moments {
            mean: self.center + self.scale * m,
            sd: if self.samples < 2 { f64::NAN } else { self.scale * libm::sqrt(second * (n / (n - 1.0))) },
            skewness: third / (second * libm::sqrt(second)),
            kurtosis: fourth / (second * second),
        }
    }

    /// Returns the samples in order.
    pub(super) fn sorted(&self) -> Sorted {
        Sorted { center: self.center, scale: self.scale, bins: self.bins.sorted() }
    }
}

/// Samples in order.
pub(super) struct Sorted {
    center: f64,
    scale: f64,
    bins: quantiles::Sorted,
}

impl Sorted {
    /// Returns the value below which a share of the samples lies.
    pub(super) fn quantile(&self, share: f64) -> f64 {
        self.center + self.scale * self.bins.quantile(share)
    }

    /// Returns the shares of the samples between edges.
    pub(super) fn shares(&self, edges: &[f64]) -> Vec<f64> {
        let below: Vec<f64> = edges.iter().map(|edge| self.bins.share_below((edge - self.center) / self.scale)).collect();
        below.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }
}

impl<K: Copy + PartialEq + fmt::Debug + Send + Sync> Reduce<K> for Tally<K> {
    fn outputs(&self) -> Vec<K> {
        vec![self.of]
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        let column = samples.column(self.of);
        self.samples += column.len() as u64;
        let mut powers = Powers { column, center: self.center, per_scale: 1.0 / self.scale, away: vec![0.0; column.len()], sums: [0.0; 4] };
        let turned: Vec<f64>;
        if self.is_angle && column.iter().any(|x| (x - self.center).abs() > PI) {
            // An angle counts from the center, so that it does not jump by a turn.
            turned = column.iter().map(|x| nearest_turn(*x, self.center)).collect();
            powers.column = &turned;
        }
        Instructions::best().run(&mut powers);
        self.sums.iter_mut().zip(powers.sums).for_each(|(sum, more)| *sum += more);
        self.bins.add(&powers.away);
    }

    fn merge(&mut self, later: Self) {
        self.samples += later.samples;
        self.sums.iter_mut().zip(later.sums).for_each(|(sum, more)| *sum += more);
        self.bins.merge(&later.bins);
    }
}

/// The distance of samples from a center, with the sums of its powers.
struct Powers<'a> {
    column: &'a [f64],
    center: f64,
    per_scale: f64,
    /// The distances; nothing where they are below [`NEAREST`].
    away: Vec<f64>,
    sums: [f64; 4],
}

impl Vectors for Powers<'_> {
    #[inline]
    fn compute(&mut self) {
        let mut sums = [[0.0; WIDTH]; 4];
        let (eights, rest) = self.column.as_chunks::<WIDTH>();
        let (to_eights, to_rest) = self.away.as_chunks_mut::<WIDTH>();
        for (eight, to) in eights.iter().zip(to_eights) {
            for i in 0..WIDTH {
                let y = (eight[i] - self.center) * self.per_scale;
                let square = y * y;
                sums[0][i] += y;
                sums[1][i] += square;
                sums[2][i] += square * y;
                sums[3][i] += square * square;
                to[i] = if y.abs() < NEAREST { 0.0 } else { y };
            }
        }
        for (i, (x, to)) in rest.iter().zip(to_rest).enumerate() {
            let y = (x - self.center) * self.per_scale;
            let square = y * y;
            for (sums, power) in sums.iter_mut().zip([y, square, square * y, square * square]) {
                sums[i] += power;
            }
            *to = if y.abs() < NEAREST { 0.0 } else { y };
        }
        self.sums = sums.map(|sums| sums.iter().sum());
    }
}

/// Returns an angle less the whole turns between it and another.
pub(super) fn nearest_turn(angle: f64, other: f64) -> f64 {
    angle - TAU * libm::round((angle - other) / TAU)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(samples: &[f64], is_angle: bool, center: f64, scale: f64) -> Moments {
        let mut tally = Tally::of((), is_angle, center, scale);
        tally.take(&Samples { of: &[()], columns: &[samples.to_vec()], first: 0, places: None });
        tally.moments()
    }

    #[test]
    fn moments_do_not_depend_on_the_center_that_was_expected() {
        // About the mean 3: 1, 1, 0, 0, −2, so that the second moment is 6/5, the third −6/5 and the fourth 18/5.
        for (center, scale) in [(3.0, 1.0), (1.0, 2.0), (7.5, 0.5)] {
            let Moments { mean, sd, skewness, kurtosis } = moments(&[4.0, 4.0, 3.0, 3.0, 1.0], false, center, scale);
            assert!((mean - 3.0).abs() < 1e-12 && (sd - 1.5_f64.sqrt()).abs() < 1e-12, "{center}");
            assert!((skewness + 1.2 / 1.2_f64.powf(1.5)).abs() < 1e-11 && (kurtosis - 3.6 / 1.44).abs() < 1e-11, "{center}");
        }
    }

    #[test]
    fn an_angle_is_that_of_the_turn_next_to_the_center() {
        for center in [3.1, -3.1] {
            let found = moments(&[-center, -center - 0.02, -center + 0.02], true, center, 0.1);
            assert!((found.mean - (center.signum() * TAU - center)).abs() < 1e-12, "{center} {found:?}");
            assert!((moments(&[-center], false, center, 0.1).mean + center).abs() < 1e-12);
        }
    }
}
