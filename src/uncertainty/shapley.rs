//! Shapley effects: the part of the variance of an output that each uncertain number has, correlated or not.
//!
//! The value of a set of numbers is Var(E(output | the set)), and the effect of a number what it adds to the sets before it, on average over all orders (Owen,
//! "Sobol' indices and Shapley value", SIAM/ASA Journal on Uncertainty Quantification 2, 2014; Song, Nelson and Staum, "Shapley effects for global sensitivity
//! analysis: theory and computation", the same 4, 2016). Each pair of samples takes one random order. The factor of the correlations in that order makes normal
//! scores of independent ones, so that to know the first numbers is to know the first independent scores. These change from those of one sample to those of the
//! other, one after the other; the steps between, y₀ to y_d, give (y_k − y_{k−1}) (y_d − (y_k + y_{k−1})/2), whose mean is what the k-th number adds (Goda,
//! "A simple algorithm for global sensitivity analysis with Shapley effects", Reliability Engineering and System Safety 213, 2021, for independent numbers).

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::model::Model;
use super::monte_carlo::Estimated;
use super::number::score;
use super::tally::nearest_turn;
use super::{MonteCarlo, Uncertain};
use crate::simulation::fill::write_probabilities;
use crate::simulation::{Reduce, RefusedSamples, Samples, SolvedSamples, Source, reduce};

/// The Shapley effects of uncertain numbers on outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapleyEffects {
    /// The samples drawn, refused ones included: each pair with the steps between.
    pub samples: u64,
    /// Those that physics refuses; a pair counts only if it is accepted with all its steps.
    pub refused: RefusedSamples,
    /// For each output of the question, the effect of each number. They add up to 1.
    pub outputs: Vec<Vec<Estimated>>,
}

/// Pairs of samples with the steps between them, each pair in an order of its own.
struct Steps<'a, M> {
    of: &'a Uncertain<M>,
    seed: u64,
}

/// Returns the order of the numbers in each of some pairs: that of random numbers.
fn orders(seed: u64, numbers: usize, pairs: &Range<u64>) -> Vec<Vec<usize>> {
    let random = ChaCha8Rng::seed_from_u64(seed);
    let keys: Vec<Vec<f64>> = (0..numbers).map(|number| column(&random, 2 * numbers + number, pairs)).collect();
    let order = |pair: usize| {
        let mut order: Vec<usize> = (0..numbers).collect();
        order.sort_by(|one, other| keys[*one][pair].total_cmp(&keys[*other][pair]));
        order
    };
    (0..(pairs.end - pairs.start) as usize).map(order).collect()
}

/// Returns a random probability for each of some pairs.
fn column(random: &ChaCha8Rng, stream: usize, pairs: &Range<u64>) -> Vec<f64> {
    let mut column = Vec::new();
    write_probabilities(random, stream as u64, pairs.clone(), &mut column);
    column
}

impl<M: Model> Source for Steps<'_, M> {
    type Output = M::Output;

    /// A pair, and a step after each number but the last.
    fn together(&self) -> u64 {
        1 + self.of.numbers.len() as u64
    }

    fn solve(&self, samples: Range<u64>, of: &[M::Output]) -> SolvedSamples {
        let random = ChaCha8Rng::seed_from_u64(self.seed);
        let (together, numbers) = (self.together(), self.of.numbers.len());
        let pairs = samples.start / together..samples.end.div_ceil(together);
        let scores = |stream: usize| column(&random, stream, &pairs).into_iter().map(score).collect::<Vec<f64>>();
        let [one, other] = [0, numbers].map(|first| (first..first + numbers).map(scores).collect::<Vec<_>>());
        let is_correlated: Vec<bool> = (0..numbers).map(|number| self.of.correlation.is_correlated(number)).collect();
        let rows = (samples.end - samples.start) as usize;
        let mut columns = vec![vec![0.0; rows]; numbers];
        for (pair, order) in orders(self.seed, numbers, &pairs).iter().enumerate() {
            // The places of the numbers that have correlations, and those numbers.
            let (places, correlated): (Vec<usize>, Vec<usize>) =
                order.iter().copied().enumerate().filter(|(_, number)| is_correlated[*number]).unzip();
            let factor = self.of.correlation.factor_in(&correlated);
            let first = (pairs.start + pair as u64) * together;
            for sample in (first..first + together).filter(|sample| samples.contains(sample)) {
                // The scores at the places before the step are those of one sample, and the others those of the other.
                let step = (sample - first) as usize;
                let independent = |place: usize| if place < step { one[place][pair] } else { other[place][pair] };
                let mut rows = factor.iter();
                for (place, number) in order.iter().enumerate() {
                    let score = match is_correlated[*number].then(|| rows.next()).flatten() {
                        Some(row) => row.iter().zip(&places).map(|(entry, place)| entry * independent(*place)).sum(),
                        None => independent(place),
                    };
                    columns[*number][(sample - samples.start) as usize] = self.of.numbers[*number].of_score(score);
                }
            }
        }
        self.of.model.solve(rows, &mut columns, of)
    }
}

/// Sums over pairs of what a number adds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Added {
    sum: f64,
    square: f64,
    /// Times that of all numbers.
    product: f64,
}

impl Added {
    fn add(&mut self, added: f64, all: f64) {
        self.merge(&Added { sum: added, square: added * added, product: added * all });
    }

    fn merge(&mut self, later: &Added) {
        self.sum += later.sum;
        self.square += later.square;
        self.product += later.product;
    }
}

/// The sums of an output, in a unit in which its variance is near 1: what each number adds, and all of them together.
#[derive(Clone, Debug, PartialEq)]
struct Sums<K> {
    of: K,
    is_angle: bool,
    center: f64,
    scale: f64,
    pairs: f64,
    all: Added,
    each: Vec<Added>,
}

impl<K> Sums<K> {
    /// Adds a pair: the outputs before the first number, and after each in an order.
    fn add(&mut self, steps: &[f64], order: &[usize]) {
        let about = |x: f64| (if self.is_angle { nearest_turn(x, self.center) } else { x } - self.center) / self.scale;
        let (first, last) = (about(steps[0]), about(steps[order.len()]));
        let all = 0.5 * (last - first) * (last - first);
        for (pair, number) in steps.windows(2).zip(order) {
            let [before, after] = [about(pair[0]), about(pair[1])];
            self.each[*number].add((after - before) * (last - 0.5 * (before + after)), all);
        }
        self.all.add(all, all);
        self.pairs += 1.0;
    }

    /// Returns the effects: ratios of means, with their standard errors.
    fn effects(&self) -> Vec<Estimated> {
        let mean = |sum: f64| sum / self.pairs;
        let variance = mean(self.all.sum);
        let effect = |added: &Added| {
            let value = mean(added.sum) / variance;
            let spread = mean(added.square) - 2.0 * value * mean(added.product) + value * value * mean(self.all.square);
            Estimated { value, standard_error: libm::sqrt(if spread > 0.0 { spread } else { 0.0 } / self.pairs) / variance }
        };
        self.each.iter().map(effect).collect()
    }
}

/// The sums of each output.
#[derive(Clone, Debug, PartialEq)]
struct Summary<K> {
    seed: u64,
    numbers: usize,
    outputs: Vec<Sums<K>>,
}

impl<K: Copy + PartialEq + fmt::Debug + Send + Sync> Reduce<K> for Summary<K> {
    fn outputs(&self) -> Vec<K> {
        self.outputs.iter().map(|sums| sums.of).collect()
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        let columns: Vec<&[f64]> = self.outputs.iter().map(|sums| samples.column(sums.of)).collect();
        let count = columns.first().map_or(0, |column| column.len());
        let together = self.numbers + 1;
        let pair_at = |place: usize| samples.number(place) / together as u64;
        if count == 0 {
            return;
        }
        let first = pair_at(0);
        let orders = orders(self.seed, self.numbers, &(first..pair_at(count - 1) + 1));
        let mut start = 0;
        while start < count {
            let pair = pair_at(start);
            let end = (start..count).find(|place| pair_at(*place) != pair).unwrap_or(count);
            // A pair of which a sample is refused has no steps to compare.
            if end - start == together {
                let order = &orders[(pair - first) as usize];
                self.outputs.iter_mut().zip(&columns).for_each(|(sums, column)| sums.add(&column[start..end], order));
            }
            start = end;
        }
    }

    fn merge(&mut self, later: Self) {
        for (sums, later) in self.outputs.iter_mut().zip(&later.outputs) {
            sums.pairs += later.pairs;
            sums.all.merge(&later.all);
            sums.each.iter_mut().zip(&later.each).for_each(|(added, later)| added.merge(later));
        }
    }
}

impl<M: Model> Uncertain<M> {
    /// Returns the Shapley effect of each number on each output, from at most so many samples: its part of the variance, in which what it shares with others
    /// by correlation or interaction is divided evenly. The effects of an output add up to 1, and none is negative but for the error of samples.
    pub fn shapley(&self, of: &[M::Output], samples: u64, seed: u64) -> ShapleyEffects {
        self.shapley_while(of, samples, seed, &|_| true)
    }

    /// The same, stopped by `goes_on` as in [`Simulation::reduce`](crate::simulation::Simulation::reduce).
    pub fn shapley_while(&self, of: &[M::Output], samples: u64, seed: u64, goes_on: &(dyn Fn(u64) -> bool + Sync)) -> ShapleyEffects {
        let steps = Steps { of: self, seed };
        let (together, numbers) = (steps.together(), self.numbers.len());
        let pilot = self.monte_carlo(of, &MonteCarlo { seed, ..MonteCarlo::of(4096) });
        let sums = pilot.outputs.iter().map(|output| Sums {
            of: output.of,
            is_angle: self.model.is_angle(output.of),
            center: output.mean.value,
            scale: if output.sd.value > 0.0 { output.sd.value } else { 1.0 },
            pairs: 0.0,
            all: Added::default(),
            each: vec![Added::default(); numbers],
        });
        let empty = Summary { seed, numbers, outputs: sums.collect() };
        let reduced = reduce(&steps, samples / together * together, empty, goes_on);
        let outputs = reduced.summary.outputs.iter().map(Sums::effects).collect();
        ShapleyEffects { samples: reduced.samples, refused: reduced.refused, outputs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Distribution;
    use crate::refusal::Refusals;
    use crate::uncertainty::{Bend, Slope, UncertainNumber};

    /// A polynomial of numbers: a linear part, and the product of the first two with a factor.
    struct Polynomial {
        slopes: Vec<f64>,
        product: f64,
    }

    impl Model for Polynomial {
        type Output = ();

        fn numbers(&self) -> usize {
            self.slopes.len()
        }

        fn is_angle(&self, (): ()) -> bool {
            false
        }

        fn value(&self, numbers: &[f64], (): ()) -> f64 {
            self.slopes.iter().zip(numbers).map(|(slope, x)| slope * x).sum::<f64>() + self.product * numbers[0] * numbers[1]
        }

        fn solve(&self, samples: usize, numbers: &mut [Vec<f64>], of: &[()]) -> SolvedSamples {
            let value = |sample: usize| self.value(&numbers.iter().map(|column| column[sample]).collect::<Vec<_>>(), ());
            SolvedSamples { columns: of.iter().map(|()| (0..samples).map(value).collect()).collect(), refused: Vec::new() }
        }

        fn slope(&self, _: &[f64], (): ()) -> Result<Slope, Refusals> {
            unimplemented!("effects need no derivatives")
        }

        fn bend(&self, _: &[f64], (): ()) -> Result<Bend, Refusals> {
            unimplemented!("effects need no derivatives")
        }
    }

    fn effects(slopes: &[f64], sds: &[f64], product: f64, pairs: &[(usize, usize, f64)]) -> Vec<Estimated> {
        let numbers = sds.iter().map(|sd| UncertainNumber::from(Distribution::Normal { mean: 0.0, sd: *sd })).collect();
        let model =
            Uncertain::new(Polynomial { slopes: slopes.to_vec(), product }, numbers).with_correlations(pairs).expect("correlations");
        let found = model.shapley(&[()], 300_000, 5);
        assert_eq!((found.samples, found.refused.samples), (300_000 / (slopes.len() as u64 + 1) * (slopes.len() as u64 + 1), 0));
        found.outputs[0].clone()
    }

    fn hold(found: &[Estimated], wanted: &[f64]) {
        assert!((found.iter().map(|effect| effect.value).sum::<f64>() - 1.0).abs() < 1e-9, "{found:?}");
        for (found, wanted) in found.iter().zip(wanted) {
            let is_near = (found.value - wanted).abs() <= 4.0 * found.standard_error + 1e-12;
            assert!(is_near && found.standard_error < 0.006, "{found:?}, not {wanted}");
        }
    }

    #[test]
    fn effects_on_a_linear_output_of_two_numbers_are_those_of_owen_and_prieur() {
        // "On Shapley value for measuring importance of dependent inputs", SIAM/ASA Journal on Uncertainty Quantification 5, 2017: with a = β₁σ₁ and b = β₂σ₂ the
        // first has a² (1 − ρ²/2) + ρ a b + b² ρ²/2 of the variance.
        for (slopes, sds, r) in
            [([1.0, 1.0], [1.0, 2.0], 0.0), ([1.0, 1.0], [1.0, 2.0], 0.6), ([2.0, -1.0], [1.0, 1.5], 0.9), ([1.0, 0.0], [1.0, 1.0], -0.8)]
        {
            let [a, b] = [slopes[0] * sds[0], slopes[1] * sds[1]];
            let part = |a: f64, b: f64| a * a * (1.0 - 0.5 * r * r) + r * a * b + 0.5 * b * b * r * r;
            let variance = a * a + b * b + 2.0 * r * a * b;
            let pairs = if r == 0.0 { Vec::new() } else { vec![(0, 1, r)] };
            hold(&effects(&slopes, &sds, 0.0, &pairs), &[part(a, b) / variance, part(b, a) / variance]);
        }
    }

    #[test]
    fn effects_on_a_linear_output_of_more_numbers_are_those_of_all_orders() {
        // Iooss and Prieur, "Shapley effects for sensitivity analysis with correlated inputs", International Journal for Uncertainty Quantification 9, 2019: a number
        // that is correlated with no other has its part alone, and of a pair as of two numbers.
        let (a, b, c, r) = (1.0, 0.7, 1.2, -0.5);
        let part = |b: f64, c: f64| b * b * (1.0 - 0.5 * r * r) + r * b * c + 0.5 * c * c * r * r;
        let variance = a * a + b * b + c * c + 2.0 * r * b * c;
        hold(&effects(&[a, b, c], &[1.0; 3], 0.0, &[(1, 2, r)]), &[a * a / variance, part(b, c) / variance, part(c, b) / variance]);
        // Numbers that are exchanged for each other have the same part, and so has a number given twice.
        hold(
            &effects(&[1.0; 4], &[1.0; 4], 0.0, &[(0, 1, 0.4), (0, 2, 0.4), (0, 3, 0.4), (1, 2, 0.4), (1, 3, 0.4), (2, 3, 0.4)]),
            &[0.25; 4],
        );
        hold(&effects(&[1.0, 0.0, 1.0], &[1.0; 3], 0.0, &[(0, 1, 1.0)]), &[0.25, 0.25, 0.5]);
    }

    #[test]
    fn effects_on_a_linear_output_of_three_numbers_are_the_mean_of_their_six_orders() {
        // Of standard normal numbers with covariances g with the output, one explains g², and two (g² + h² − 2 r g h)/(1 − r²).
        let (slopes, r): ([f64; 3], _) = ([1.0, -0.5, 2.0], [[1.0, 0.8, -0.3], [0.8, 1.0, 0.2], [-0.3, 0.2, 1.0]]);
        let g = [0, 1, 2].map(|i: usize| slopes.iter().zip(r[i]).map(|(slope, r)| slope * r).sum::<f64>());
        let all: f64 = slopes.iter().zip(g).map(|(slope, g)| slope * g).sum();
        let two = |i: usize, j: usize| (g[i] * g[i] + g[j] * g[j] - 2.0 * r[i][j] * g[i] * g[j]) / (1.0 - r[i][j] * r[i][j]);
        let wanted = [(0, 1, 2), (1, 0, 2), (2, 0, 1)].map(|(i, j, k)| {
            let last = all - two(j, k);
            let middle = 0.5 * (two(i, j) - g[j] * g[j] + two(i, k) - g[k] * g[k]);
            (g[i] * g[i] + middle + last) / (3.0 * all)
        });
        hold(&effects(&slopes, &[1.0; 3], 0.0, &[(0, 1, r[0][1]), (0, 2, r[0][2]), (1, 2, r[1][2])]), &wanted);
    }

    #[test]
    fn an_interaction_is_divided_evenly() {
        // x + x y has the variances 1 of x alone and 1 of both.
        hold(&effects(&[1.0, 0.0], &[1.0, 1.0], 1.0, &[]), &[0.75, 0.25]);
    }

    #[test]
    fn a_standard_error_is_the_deviation_of_many_seeds() {
        let numbers = || [1.0, 2.0, 0.5].map(|sd| UncertainNumber::from(Distribution::Normal { mean: 0.0, sd })).to_vec();
        let model = Uncertain::new(Polynomial { slopes: vec![1.0, 1.0, 3.0], product: 0.4 }, numbers());
        let model = model.with_correlations(&[(0, 1, 0.5), (1, 2, -0.3)]).expect("correlations");
        let found: Vec<Estimated> = (0..100).map(|seed| model.shapley(&[()], 8000, seed).outputs[0][1]).collect();
        let mean = found.iter().map(|effect| effect.value).sum::<f64>() / 100.0;
        let sd = (found.iter().map(|effect| (effect.value - mean).powi(2)).sum::<f64>() / 99.0).sqrt();
        let claimed = found.iter().map(|effect| effect.standard_error).sum::<f64>() / 100.0;
        assert!((0.75..1.33).contains(&(sd / claimed)), "{sd} of seeds, {claimed} claimed");
    }
}
