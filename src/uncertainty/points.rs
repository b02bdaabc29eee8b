//! Samples of uncertain numbers.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Uncertain;
use super::model::Model;
use super::number::{UncertainNumber, score};
use crate::distribution::Distribution;
use crate::simulation::fill::{write_normals, write_probabilities};
use crate::simulation::{SolvedSamples, Source};

/// Where samples lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Points {
    /// Independent of each other: random numbers of ChaCha8 (crate `rand_chacha`), counted by sample and number.
    #[default]
    Random,
    /// Points of Sobol', scrambled as by Owen (crate `sobol_burley`), several times independently: they fill the space more evenly than chance, so that a mean
    /// needs far fewer. Up to [`Points::MOST_NUMBERS`] numbers.
    Sobol,
}

impl Points {
    /// Greatest number of uncertain numbers for points of Sobol'.
    pub const MOST_NUMBERS: usize = sobol_burley::NUM_DIMENSIONS as usize;

    /// Bits of the number of a sample within its scrambling; the next begins after so many.
    const BITS: u32 = 16;
}

/// Samples of a seed, or one of several independent parts of those.
pub(super) struct Filled<'a, M> {
    pub(super) of: &'a Uncertain<M>,
    pub(super) points: Points,
    pub(super) seed: u64,
    /// Which of several parts.
    pub(super) part: u64,
}

impl<M: Model> Source for Filled<'_, M> {
    type Output = M::Output;

    fn solve(&self, samples: Range<u64>, of: &[M::Output]) -> SolvedSamples {
        let rows = (samples.end - samples.start) as usize;
        let mut probabilities: Vec<Vec<f64>> = self.of.numbers.iter().map(|_| Vec::new()).collect();
        self.write_probabilities(samples, &mut probabilities);
        self.of.solve(rows, &probabilities, of)
    }
}

impl<M: Model> Filled<'_, M> {
    pub(super) fn write_probabilities(&self, samples: Range<u64>, to: &mut [Vec<f64>]) {
        let random = ChaCha8Rng::seed_from_u64(self.seed);
        for (number, column) in to.iter_mut().enumerate() {
            write_probabilities(&random, number as u64, samples.clone(), column);
            if self.points == Points::Sobol {
                let mut scrambling = self.scrambling(&random, samples.start);
                for (sample, p) in samples.clone().zip(column) {
                    let place = sample & ((1 << Points::BITS) - 1);
                    if place == 0 {
                        scrambling = self.scrambling(&random, sample);
                    }
                    *p = finer(sobol_burley::sample(place as u32, number as u32, scrambling), *p);
                }
            }
        }
    }
}

impl<M> Filled<'_, M> {
    /// Returns the seed of the scrambling of a sample.
    fn scrambling(&self, random: &ChaCha8Rng, sample: u64) -> u32 {
        let mut random = random.clone();
        random.set_stream(u64::MAX - self.part);
        random.set_word_pos(u128::from(sample >> Points::BITS));
        random.next_u32()
    }
}

/// Returns a number whose leading 24 bits are those of a point, and the others are random: neither 0 nor 1.
fn finer(point: f32, random: f64) -> f64 {
    const PART: f64 = 1.0 / (1 << 24) as f64;
    const FINEST: f64 = (1 << 28) as f64;
    f64::from(point) + PART * (((random * FINEST) as u32 as f64 + 0.5) / FINEST)
}

impl<M: Model> Uncertain<M> {
    /// Solves samples whose numbers have given probabilities.
    pub(super) fn solve(&self, samples: usize, probabilities: &[Vec<f64>], of: &[M::Output]) -> SolvedSamples {
        self.model.solve(samples, &mut self.draw(samples, probabilities), of)
    }

    /// Returns the numbers of samples that have given probabilities, a column of each.
    pub(super) fn draw(&self, samples: usize, probabilities: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut numbers: Vec<Vec<f64>> = probabilities.iter().map(|_| vec![0.0; samples]).collect();
        let scores: Vec<Vec<f64>> = probabilities.iter().enumerate().map(|(i, p)| self.scores(i, p)).collect();
        for (i, (number, to)) in self.numbers.iter().zip(&mut numbers).enumerate() {
            if self.correlation.is_correlated(i) {
                for (sample, to) in to.iter_mut().enumerate() {
                    *to = number.of_score(self.correlation.score(i, |k| scores[k].get(sample).copied().unwrap_or(0.0)));
                }
                continue;
            }
            match number {
                UncertainNumber::Of(Distribution::Normal { mean, sd }) => write_normals(&probabilities[i], *mean, *sd, to),
                _ => to.iter_mut().zip(&probabilities[i]).for_each(|(to, p)| *to = number.quantile(*p)),
            }
        }
        numbers
    }

    /// Returns the independent scores of a number that has correlations, and nothing for others.
    fn scores(&self, number: usize, probabilities: &[f64]) -> Vec<f64> {
        if self.correlation.is_correlated(number) { probabilities.iter().map(|p| score(*p)).collect() } else { Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::finer;

    #[test]
    fn a_point_keeps_its_bits_and_random_ones_follow() {
        let last = 1.0 / (1 << 24) as f64;
        for point in [0.0, 0.25, 1.0 - last] {
            for random in [1e-300, 0.3, 1.0 - 1e-16] {
                let behind = (finer(point as f32, random) - point) / last;
                // Up to 2⁻²⁸ and the rounding of the whole.
                assert!(behind > 0.0 && behind < 1.0 && (behind - random).abs() < 3e-8, "{point} {random}: {behind}");
            }
        }
    }
}
