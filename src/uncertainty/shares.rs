//! The share of each uncertain number in the variance of an output: indices of Sobol'.
//!
//! Two independent samples u = f(A) and v = f(B) are mixed: f(AB) has the number in question from B and all others from A. The correlation of f(B) and f(AB),
//! which have only that number in common, is its share alone; one less that of f(A) and f(AB), which have all others in common, its share with others
//! (Jansen, "Analysis of variance designs for model output", Computer Physics Communications 117, 1999; the correlation as in Janon, Klein, Lagnoux, Nodet and
//! Prieur, "Asymptotic normality and efficiency of two Sobol index estimators", ESAIM: Probability and Statistics 18, 2014).

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::model::Model;
use super::monte_carlo::Estimated;
use super::points::Filled;
use super::tally::nearest_turn;
use super::{MonteCarlo, Points, Uncertain, UncertainNumber};
use crate::simulation::fill::write_probabilities;
use crate::simulation::{Reduce, RefusedSamples, Samples, SolvedSamples, Source, reduce};

/// The shares of numbers, or of groups of them, in the variances of outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares {
    /// The samples drawn, refused ones included: each pair of independent ones and their mixtures.
    pub samples: u64,
    /// Those that physics refuses; a pair counts only if it is accepted with all its mixtures.
    pub refused: RefusedSamples,
    /// For each output of the question, the share of each group.
    pub outputs: Vec<Vec<Share>>,
}

/// The share of a number, or of a group, in the variance of an output.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Share {
    /// Alone: the part of the variance that would go if it were known.
    pub first: Estimated,
    /// With all others: the part that would be left if all others were known.
    pub total: Estimated,
}

/// Two correlated numbers that are not in the same group: the variance has no shares of theirs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Correlated(pub usize, pub usize);

impl fmt::Display for Correlated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the numbers {} and {} are correlated, and have no shares of their own; put them in one group", self.0, self.1)
    }
}

impl core::error::Error for Correlated {}

/// Pairs of samples with their mixtures, each group of numbers in turn.
struct Mixed<'a, M> {
    of: &'a Uncertain<M>,
    groups: &'a [Vec<usize>],
    seed: u64,
}

impl<M: Model> Source for Mixed<'_, M> {
    type Output = M::Output;

    /// A pair with its mixtures.
    fn together(&self) -> u64 {
        2 + self.groups.len() as u64
    }

    fn solve(&self, samples: Range<u64>, of: &[M::Output]) -> SolvedSamples {
        let rows = (samples.end - samples.start) as usize;
        let random = ChaCha8Rng::seed_from_u64(self.seed);
        let together = self.together();
        let pairs = samples.start / together..samples.end.div_ceil(together);
        let numbers = self.of.numbers.len();
        let (mut one, mut other) = (Vec::new(), Vec::new());
        let mixed = (0..numbers).map(|number| {
            write_probabilities(&random, number as u64, pairs.clone(), &mut one);
            write_probabilities(&random, (numbers + number) as u64, pairs.clone(), &mut other);
            let of_sample = |sample: u64| {
                let pair = (sample / together - pairs.start) as usize;
                match sample % together {
                    0 => one[pair],
                    1 => other[pair],
                    mixture if self.groups[mixture as usize - 2].contains(&number) => other[pair],
                    _ => one[pair],
                }
            };
            samples.clone().map(of_sample).collect()
        });
        let mixed: Vec<Vec<f64>> = mixed.collect();
        self.of.solve(rows, &mixed, of)
    }
}

/// Sums over pairs (u, v) of numbers about a center.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sums {
    pairs: f64,
    sum: f64,
    product: f64,
    squares: f64,
    product_squared: f64,
    product_times_squares: f64,
    squares_squared: f64,
}

impl Sums {
    fn add(&mut self, u: f64, v: f64) {
        let (product, squares) = (u * v, 0.5 * (u * u + v * v));
        self.merge(&Sums {
            pairs: 1.0,
            sum: 0.5 * (u + v),
            product,
            squares,
            product_squared: product * product,
            product_times_squares: product * squares,
            squares_squared: squares * squares,
        });
    }

    fn merge(&mut self, later: &Sums) {
        self.pairs += later.pairs;
        self.sum += later.sum;
        self.product += later.product;
        self.squares += later.squares;
        self.product_squared += later.product_squared;
        self.product_times_squares += later.product_times_squares;
        self.squares_squared += later.squares_squared;
    }

    /// Returns the correlation of the two.
    fn correlation(&self) -> Estimated {
        let mean = |sum: f64| sum / self.pairs;
        let m = mean(self.sum);
        let variance = mean(self.squares) - m * m;
        let value = (mean(self.product) - m * m) / variance;
        // The center is the mean, but for a small part of the deviation.
        let spread = mean(self.product_squared) - 2.0 * value * mean(self.product_times_squares)
            + value * value * mean(self.squares_squared)
            - square(mean(self.product) - value * mean(self.squares));
        Estimated { value, standard_error: libm::sqrt(if spread > 0.0 { spread } else { 0.0 } / self.pairs) / variance }
    }
}

fn square(x: f64) -> f64 {
    x * x
}

/// The sums of an output: for each group, those of what has it in common and of what has all others in common.
#[derive(Clone, Debug, PartialEq)]
struct Pairs<K> {
    of: K,
    is_angle: bool,
    center: f64,
    scale: f64,
    together: u64,
    sums: Vec<[Sums; 2]>,
}

impl<K: Copy + PartialEq + fmt::Debug + Send + Sync> Reduce<K> for Pairs<K> {
    fn outputs(&self) -> Vec<K> {
        vec![self.of]
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        let column = samples.column(self.of);
        let together = self.together as usize;
        let mut start = 0;
        while start < column.len() {
            let pair = samples.number(start) / self.together;
            let end = (start..column.len()).find(|place| samples.number(*place) / self.together != pair).unwrap_or(column.len());
            // A pair of which a sample is refused has no mixtures to compare.
            if end - start == together {
                let about = |x: f64| (if self.is_angle { nearest_turn(x, self.center) } else { x } - self.center) / self.scale;
                let (one, other) = (about(column[start]), about(column[start + 1]));
                for (mixture, [alone, others]) in column[start + 2..end].iter().zip(&mut self.sums) {
                    alone.add(other, about(*mixture));
                    others.add(one, about(*mixture));
                }
            }
            start = end;
        }
    }

    fn merge(&mut self, later: Self) {
        self.sums.iter_mut().flatten().zip(later.sums.iter().flatten()).for_each(|(sums, later)| sums.merge(later));
    }
}

/// Samples of slopes: each takes as long as many of an output.
const SLOPES: usize = 1000;

impl<M: Model> Uncertain<M> {
    /// Returns, for each number, what its share with others in the variance of an output is at most: C E f′² of the variance, with C the Poincaré constant of its
    /// distribution (Sobol' and Kucherenko, "Derivative based global sensitivity measures", Mathematics and Computers in Simulation 79, 2009). `None` for a
    /// distribution that has no such constant: a log-normal one, Student's t, and measured values.
    ///
    /// # Errors
    ///
    /// [`Correlated`] if two numbers are correlated.
    pub fn shares_at_most(&self, of: M::Output, seed: u64) -> Result<Vec<Option<Estimated>>, Correlated> {
        let alone: Vec<Vec<usize>> = (0..self.numbers.len()).map(|number| vec![number]).collect();
        self.check_groups(&alone)?;
        let pilot = self.monte_carlo(&[of], &MonteCarlo { seed, ..MonteCarlo::of(16_384) });
        let sd = pilot.output(of).sd.value;
        let points = Filled { of: self, points: Points::Random, seed, part: 0 };
        let mut probabilities: Vec<Vec<f64>> = self.numbers.iter().map(|_| Vec::new()).collect();
        points.write_probabilities(0..SLOPES as u64, &mut probabilities);
        let columns = self.draw(SLOPES, &probabilities);
        let sample = |i: usize| columns.iter().map(|column| column[i]).collect::<Vec<f64>>();
        let slopes: Vec<Vec<f64>> = (0..SLOPES).filter_map(|i| self.model.slope(&sample(i), of).ok()).map(|slope| slope.by).collect();
        let n = slopes.len() as f64;
        let limit = |(place, number): (usize, &UncertainNumber)| {
            let factor = number.poincare()? / (sd * sd);
            let mean = slopes.iter().map(|by| square(by[place])).sum::<f64>() / n;
            let spread = slopes.iter().map(|by| square(square(by[place]) - mean)).sum::<f64>() / n;
            Some(Estimated { value: factor * mean, standard_error: factor * libm::sqrt(spread / n) })
        };
        Ok(self.numbers.iter().enumerate().map(limit).collect())
    }

    fn check_groups(&self, groups: &[Vec<usize>]) -> Result<(), Correlated> {
        let group = |number: usize| groups.iter().position(|group| group.contains(&number));
        for one in 0..self.numbers.len() {
            if let Some(other) = (0..one).find(|other| self.correlation.coefficient(one, *other) != 0.0 && group(one) != group(*other)) {
                return Err(Correlated(other, one));
            }
        }
        Ok(())
    }

    /// Returns the share of each number in the variance of each output, from at most so many samples.
    ///
    /// # Errors
    ///
    /// [`Correlated`] if two numbers are correlated: see [`Self::shares_of_groups`].
    pub fn shares(&self, of: &[M::Output], samples: u64, seed: u64) -> Result<Shares, Correlated> {
        let alone: Vec<Vec<usize>> = (0..self.numbers.len()).map(|number| vec![number]).collect();
        self.shares_of_groups(of, &alone, samples, seed, &|_| true)
    }

    /// Returns the share of each group of numbers in the variance of each output, from at most so many samples. `goes_on` stops the samples as in
    /// [`Simulation::reduce`](crate::simulation::Simulation::reduce).
    ///
    /// # Errors
    ///
    /// [`Correlated`] if two numbers of different groups are correlated.
    pub fn shares_of_groups(
        &self,
        of: &[M::Output],
        groups: &[Vec<usize>],
        samples: u64,
        seed: u64,
        goes_on: &(dyn Fn(u64) -> bool + Sync),
    ) -> Result<Shares, Correlated> {
        self.check_groups(groups)?;
        let fill = Mixed { of: self, groups, seed };
        let together = fill.together();
        let pilot = self.monte_carlo(of, &MonteCarlo { seed, ..MonteCarlo::of(4096) });
        let empty: Vec<Pairs<M::Output>> = pilot
            .outputs
            .iter()
            .map(|output| {
                let scale = if output.sd.value > 0.0 { output.sd.value } else { 1.0 };
                Pairs {
                    of: output.of,
                    is_angle: self.model.is_angle(output.of),
                    center: output.mean.value,
                    scale,
                    together,
                    sums: vec![[Sums::default(); 2]; groups.len()],
                }
            })
            .collect();
        let reduced = reduce(&fill, samples / together * together, empty, goes_on);
        let share = |[alone, others]: &[Sums; 2]| {
            let others = others.correlation();
            Share { first: alone.correlation(), total: Estimated { value: 1.0 - others.value, ..others } }
        };
        let outputs = reduced.summary.iter().map(|pairs| pairs.sums.iter().map(share).collect()).collect();
        Ok(Shares { samples: reduced.samples, refused: reduced.refused, outputs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// Returns the shares of each argument of a function of uniform numbers.
    fn shares_of<const N: usize>(f: impl Fn([f64; N]) -> f64, center: f64) -> [Share; N] {
        let random = ChaCha8Rng::seed_from_u64(11);
        let mut columns = vec![Vec::new(); 2 * N];
        columns.iter_mut().enumerate().for_each(|(i, column)| write_probabilities(&random, i as u64, 0..100_000, column));
        let row = |from: usize, k: usize| -> [f64; N] { core::array::from_fn(|j| columns[from + j][k]) };
        core::array::from_fn(|i| {
            let [mut alone, mut others] = [Sums::default(); 2];
            for k in 0..columns[0].len() {
                let (one, other) = (row(0, k), row(N, k));
                let mut mixture = one;
                mixture[i] = other[i];
                alone.add(f(other) - center, f(mixture) - center);
                others.add(f(one) - center, f(mixture) - center);
            }
            let others = others.correlation();
            Share { first: alone.correlation(), total: Estimated { value: 1.0 - others.value, ..others } }
        })
    }

    fn check(found: &[Share], wanted: &[[f64; 2]]) {
        for (share, [first, total]) in found.iter().zip(wanted) {
            for (found, wanted) in [(share.first, first), (share.total, total)] {
                assert!((found.value - wanted).abs() < 4.0 * found.standard_error, "{share:?} {wanted}");
                assert!(found.standard_error < 0.01);
            }
        }
    }

    #[test]
    fn shares_are_those_of_the_function_of_ishigami() {
        // sin x + 7 sin² y + 0.1 z⁴ sin x on (−π, π)³: Ishigami and Homma 1990.
        let (a, b) = (7.0, 0.1);
        let f = |p: [f64; 3]| {
            let [x, y, z] = p.map(|p| PI * (2.0 * p - 1.0));
            x.sin() + a * y.sin() * y.sin() + b * z.powi(4) * x.sin()
        };
        let of_x = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
        let of_y = a * a / 8.0;
        let of_both = b * b * PI.powi(8) * 8.0 / 225.0;
        let variance = of_x + of_y + of_both;
        let wanted = [[of_x, of_x + of_both], [of_y, of_y], [0.0, of_both]].map(|pair| pair.map(|part| part / variance));
        check(&shares_of(f, 3.5), &wanted);
    }

    #[test]
    fn shares_are_those_of_the_g_function_of_sobol() {
        // Π (|4 x − 2| + a)/(1 + a) with a = 0, 1, 9.
        let a = [0.0, 1.0, 9.0];
        let f = |p: [f64; 3]| p.iter().zip(a).map(|(p, a)| ((4.0 * p - 2.0).abs() + a) / (1.0 + a)).product();
        let part = a.map(|a: f64| 1.0 / (3.0 * (1.0 + a).powi(2)));
        let variance = part.iter().map(|part| 1.0 + part).product::<f64>() - 1.0;
        let total = |i: usize| part[i] * (0..3).filter(|j| *j != i).map(|j| 1.0 + part[j]).product::<f64>() / variance;
        let wanted = [0, 1, 2].map(|i| [part[i] / variance, total(i)]);
        check(&shares_of(f, 1.0), &wanted);
    }
}
