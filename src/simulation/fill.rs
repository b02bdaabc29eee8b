//! Where the numbers of samples come from.

use alloc::vec::Vec;
use core::ops::Range;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::batch::{Instructions, Vectors};
use crate::distribution::Distribution;
use crate::distribution::quantile::{in_a_near_tail, in_a_tail, in_the_middle, is_in_a_near_tail, is_in_the_middle};
use crate::input::Input;

/// Numbers that are drawn, or looked through, together.
const PART: usize = 256;

/// A source of samples.
pub trait Fill: Sync {
    /// Returns the inputs that it fills, each once.
    fn inputs(&self) -> &[Input];

    /// Replaces the numbers of each column, that of an input, by those of some samples. The numbers of a sample may depend on nothing but its own number: the
    /// same sample may be asked for more than once, and from any thread.
    fn fill(&self, samples: Range<u64>, columns: &mut [Vec<f64>]);
}

/// Independent random numbers of given distributions.
///
/// They are quantiles of ChaCha8 (crate `rand_chacha`), which is counted: a stream for each input, two words for each sample.
#[derive(Clone, Debug, Default)]
pub struct Draws {
    seed: u64,
    inputs: Vec<Input>,
    distributions: Vec<Distribution>,
}

impl Draws {
    pub(super) fn push(&mut self, input: Input, distribution: Distribution) {
        self.inputs.push(input);
        self.distributions.push(distribution);
    }

    pub(super) fn set_seed(&mut self, seed: u64) {
        self.seed = seed;
    }
}

impl Fill for Draws {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn fill(&self, samples: Range<u64>, columns: &mut [Vec<f64>]) {
        let random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut probabilities = Vec::new();
        for ((input, distribution), column) in self.inputs.iter().zip(&self.distributions).zip(columns) {
            write_probabilities(&random, input.index() as u64, samples.clone(), &mut probabilities);
            column.clear();
            column.resize(probabilities.len(), 0.0);
            match *distribution {
                Distribution::Normal { mean, sd } => write_normals(&probabilities, mean, sd, column),
                _ => probabilities.iter().zip(column).for_each(|(p, to)| *to = distribution.quantile(*p)),
            }
        }
    }
}

/// Replaces numbers by random probabilities of some samples, two words of a stream for each.
pub(crate) fn write_probabilities(random: &ChaCha8Rng, stream: u64, samples: Range<u64>, to: &mut Vec<f64>) {
    let mut random = random.clone();
    random.set_stream(stream);
    random.set_word_pos(2 * u128::from(samples.start));
    to.clear();
    let mut words = [0; 8 * PART];
    let mut rest = (samples.end - samples.start) as usize;
    while rest > 0 {
        let part = rest.min(PART);
        random.fill_bytes(&mut words[..8 * part]);
        let (words, _) = words[..8 * part].as_chunks();
        to.extend(words.iter().map(|word| between_zero_and_one(u64::from_le_bytes(*word))));
        rest -= part;
    }
}

/// Writes the quantiles of a normal distribution at some probabilities.
pub(crate) fn write_normals(probabilities: &[f64], mean: f64, sd: f64, to: &mut [f64]) {
    Instructions::best().run(&mut Normals { probabilities, mean, sd, to });
}

/// Returns the middle of one of 2⁵² equal parts, so neither 0 nor 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn between_zero_and_one(random: u64) -> f64 {
    const WHOLE: f64 = (1_u64 << 52) as f64;
    // The last bits of 2⁵² are a whole number: not every set of vector instructions converts integers of 64 bits.
    let part = f64::from_bits(WHOLE.to_bits() | (random >> 12)) - WHOLE;
    (part + 0.5) / WHOLE
}

/// Normal numbers, by loops without a branch: those of the middle where they stand, and those of the tails side by side.
struct Normals<'a> {
    probabilities: &'a [f64],
    mean: f64,
    sd: f64,
    to: &'a mut [f64],
}

impl Vectors for Normals<'_> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn compute(&mut self) {
        for (p, to) in self.probabilities.iter().zip(&mut *self.to) {
            *to = self.mean + self.sd * in_the_middle(*p);
        }
        for (probabilities, to) in self.probabilities.chunks(PART).zip(self.to.chunks_mut(PART)) {
            write_tails(probabilities, self.mean, self.sd, to);
        }
    }
}

/// Replaces the numbers whose probabilities lie in the tails.
#[cfg_attr(not(debug_assertions), inline(always))]
fn write_tails(probabilities: &[f64], mean: f64, sd: f64, to: &mut [f64]) {
    let (mut places, mut tails, mut scores, mut found) = ([0; PART], [0.5; PART], [0.0; PART], 0);
    for (place, p) in probabilities.iter().enumerate() {
        (places[found], tails[found]) = (place, *p);
        found += usize::from(!is_in_the_middle(*p));
    }
    for (p, score) in tails[..found].iter().zip(&mut scores) {
        *score = in_a_near_tail(*p);
    }
    for ((place, p), score) in places[..found].iter().zip(&tails).zip(&scores) {
        let score = if is_in_a_near_tail(*p) { *score } else { in_a_tail(*p) };
        to[*place] = mean + sd * score;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    fn draws() -> Draws {
        let mut draws = Draws::default();
        draws.push(Input::Restitution, Distribution::Uniform { min: 0.0, max: 1.0 });
        draws.push(Input::Mass(Side::Two), Distribution::Normal { mean: 1500.0, sd: 100.0 });
        draws
    }

    fn filled(draws: &Draws, samples: Range<u64>) -> Vec<Vec<f64>> {
        let mut columns = draws.inputs.iter().map(|_| Vec::new()).collect::<Vec<_>>();
        draws.fill(samples, &mut columns);
        columns
    }

    #[test]
    fn a_sample_has_its_numbers_whatever_is_drawn_beside_it() {
        let whole = filled(&draws(), 0..1000);
        let part = filled(&draws(), 137..140);
        assert_eq!(part, whole.iter().map(|column| column[137..140].to_vec()).collect::<Vec<_>>());
        let mut alone = Draws::default();
        alone.push(Input::Mass(Side::Two), Distribution::Normal { mean: 1500.0, sd: 100.0 });
        assert_eq!(filled(&alone, 0..1000), whole[1..]);
        let mut other = draws();
        other.set_seed(1);
        assert!(filled(&other, 0..10)[0].iter().zip(&whole[0]).all(|(one, other)| one != other));
        // Far from the start.
        assert_eq!(filled(&draws(), 1 << 60..(1 << 60) + 2)[0].len(), 2);
    }

    #[test]
    fn normal_numbers_of_the_farthest_tails_are_quantiles() {
        let lower = [5e-324, 1e-300, 1e-20, 9.9e-11, 1.01e-10, 1e-6, 0.02, 0.3];
        let probabilities: Vec<f64> = lower.iter().copied().chain(lower[3..].iter().map(|p| 1.0 - p)).collect();
        let mut normals = vec![0.0; probabilities.len()];
        write_normals(&probabilities, 2.0, 3.0, &mut normals);
        let normal = Distribution::Normal { mean: 2.0, sd: 3.0 };
        assert_eq!(normals, probabilities.iter().map(|p| normal.quantile(*p)).collect::<Vec<_>>());
    }

    #[test]
    fn normal_numbers_are_quantiles() {
        let columns = filled(&draws(), 0..10_000);
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(Input::Mass(Side::Two).index() as u64);
        let normal = Distribution::Normal { mean: 1500.0, sd: 100.0 };
        for found in &columns[1] {
            assert_eq!(*found, normal.quantile(between_zero_and_one(random.next_u64())));
        }
        assert_eq!([between_zero_and_one(0) > 0.0, between_zero_and_one(u64::MAX) < 1.0], [true, true]);
    }
}
