//! Means, variances and covariances.

use alloc::vec;
use alloc::vec::Vec;

use super::{Reduce, Samples};
use crate::output::Output;

/// Numbers that are added side by side: the order is part of the definition, so that the sum has the same bits whatever the vector instructions.
const WIDTH: usize = 8;

/// Mean and variance of outputs, and on request the covariance of each pair.
///
/// Sums are of deviations from a mean, and merged as by Chan, Golub and LeVeque ("Algorithms for computing the sample variance", The American Statistician 37,
/// 1983): nothing cancels, however great the mean. An output that is not finite in one sample has a mean that is not.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments {
    of: Vec<Output>,
    has_pairs: bool,
    samples: u64,
    means: Vec<f64>,
    /// Sums of products of deviations: of each output with itself and, if there are pairs, with those before it.
    products: Vec<Vec<f64>>,
}

impl Moments {
    /// Creates the summary of no samples.
    #[must_use]
    pub fn of(of: &[Output]) -> Self {
        Moments {
            of: of.to_vec(),
            has_pairs: false,
            samples: 0,
            means: vec![0.0; of.len()],
            products: of.iter().map(|_| vec![0.0]).collect(),
        }
    }

    /// Returns the same with the covariance of each pair.
    #[must_use]
    pub fn with_covariances(mut self) -> Self {
        self.has_pairs = true;
        self.products = (0..self.of.len()).map(|i| vec![0.0; i + 1]).collect();
        self
    }

    /// Returns the number of samples.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Returns the mean of an output; NaN without a sample.
    ///
    /// # Panics
    ///
    /// If the summary does not have the output.
    pub fn mean(&self, of: Output) -> f64 {
        if self.samples == 0 { f64::NAN } else { self.means[self.place(of)] }
    }

    /// Returns the variance of an output, that of the population estimated from the samples; NaN below two.
    ///
    /// # Panics
    ///
    /// If the summary does not have the output.
    pub fn variance(&self, of: Output) -> f64 {
        let products = &self.products[self.place(of)];
        self.of_product(products[products.len() - 1])
    }

    /// Returns the standard error of the mean of an output.
    ///
    /// # Panics
    ///
    /// If the summary does not have the output.
    pub fn standard_error(&self, of: Output) -> f64 {
        libm::sqrt(self.variance(of) / self.samples as f64)
    }

    /// Returns the covariance of two outputs, as [`Self::variance`].
    ///
    /// # Panics
    ///
    /// If the summary does not have the outputs, or no covariances.
    pub fn covariance(&self, one: Output, other: Output) -> f64 {
        assert!(self.has_pairs, "covariances are computed by `Moments::with_covariances`");
        let (one, other) = (self.place(one), self.place(other));
        self.of_product(self.products[one.max(other)][one.min(other)])
    }

    fn of_product(&self, product: f64) -> f64 {
        if self.samples < 2 { f64::NAN } else { product / (self.samples - 1) as f64 }
    }

    fn place(&self, of: Output) -> usize {
        self.of.iter().position(|output| *output == of).unwrap_or_else(|| panic!("{of} is not among the outputs of the summary"))
    }

    /// Returns the partners of an output: itself, and those before it if there are pairs.
    fn partners(&self, i: usize) -> core::ops::RangeInclusive<usize> {
        if self.has_pairs { 0..=i } else { i..=i }
    }

    /// Adds the moments of other samples.
    fn add(&mut self, samples: u64, means: &[f64], products: &[Vec<f64>]) {
        if samples == 0 {
            return;
        }
        let (here, there) = (self.samples as f64, samples as f64);
        let away: Vec<f64> = means.iter().zip(&self.means).map(|(other, own)| other - own).collect();
        for i in 0..self.of.len() {
            for (k, j) in self.partners(i).enumerate() {
                self.products[i][k] += products[i][k] + away[i] * away[j] * (here * there / (here + there));
            }
            self.means[i] += away[i] * (there / (here + there));
        }
        self.samples += samples;
    }
}

impl Reduce for Moments {
    fn outputs(&self) -> Vec<Output> {
        self.of.clone()
    }

    fn take(&mut self, samples: &Samples<'_>) {
        let columns: Vec<&[f64]> = self.of.iter().map(|output| samples.column(*output)).collect();
        let Some(rows) = columns.first().map(|column| column.len()) else { return };
        let means: Vec<f64> = columns.iter().map(|column| sum(column) / rows.max(1) as f64).collect();
        let product = |i: usize, j: usize| product(columns[i], means[i], columns[j], means[j]);
        let products: Vec<Vec<f64>> = (0..columns.len()).map(|i| self.partners(i).map(|j| product(i, j)).collect()).collect();
        self.add(rows as u64, &means, &products);
    }

    fn merge(&mut self, later: Self) {
        self.add(later.samples, &later.means, &later.products);
    }
}

fn sum(column: &[f64]) -> f64 {
    let mut sums = [0.0; WIDTH];
    let (eights, rest) = column.as_chunks::<WIDTH>();
    for eight in eights {
        for (sum, x) in sums.iter_mut().zip(eight) {
            *sum += x;
        }
    }
    sums.iter().chain(rest).sum()
}

/// Returns the sum of products of deviations.
fn product(one: &[f64], mean: f64, other: &[f64], mean_of_other: f64) -> f64 {
    let mut sums = [0.0; WIDTH];
    let ((ones, rest), (others, rest_of_other)) = (one.as_chunks::<WIDTH>(), other.as_chunks::<WIDTH>());
    for (x, y) in ones.iter().zip(others) {
        for i in 0..WIDTH {
            sums[i] += (x[i] - mean) * (y[i] - mean_of_other);
        }
    }
    sums.iter().sum::<f64>() + rest.iter().zip(rest_of_other).map(|(x, y)| (x - mean) * (y - mean_of_other)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The variance of a population has one sample less in it than there are.
    #[test]
    fn one_sample_has_no_variance_and_two_have() {
        const OF: [Output; 2] = [Output::Loss, Output::NormalSeparation];
        let of = |columns: &[Vec<f64>]| {
            let mut found = Moments::of(&OF).with_covariances();
            found.take(&Samples { of: &OF, columns, first: 0, places: None });
            found
        };
        let one = of(&[vec![5.0], vec![-2.0]]);
        assert!(one.variance(OF[0]).is_nan() && one.covariance(OF[0], OF[1]).is_nan());
        let two = of(&[vec![1.0, 3.0], vec![-2.0, -8.0]]);
        assert_eq!((two.variance(OF[0]), two.variance(OF[1]), two.covariance(OF[1], OF[0])), (2.0, 18.0, -6.0));
    }
}
