//! The noise of an unloaded channel, whose samples may be correlated.

use super::record::whole;
use super::weight::dot;
use crate::scalar::{Field, Ordered};
use alloc::vec::Vec;

/// The noise of a channel at equal steps.
pub(super) struct Noise<T> {
    /// The covariances of two samples that are none, one, two, … steps apart, and zero beyond.
    covariances: Vec<T>,
    /// The number of samples that they were found from.
    samples: usize,
}

impl<T: Ordered<Mask = bool>> Noise<T> {
    /// Estimates the noise from at least two samples of the unloaded channel.
    ///
    /// Of n samples with deviations d from their mean, the sums S_k = Σ d_i d_{i+k} are used up to the first that is not positive, K + 1, or to n/4. The mean is
    /// subject to the noise too, and deviations from it lack its variance v = (γ_0 + 2 Σ γ_k)/n. With γ_k = S_k/n + v this gives
    /// v = (S_0 + 2 Σ S_k)/(n (n − 2K − 1)): for K = 0, γ_0 is the usual S_0/(n − 1).
    pub fn of(samples: &[T], mean: &T) -> Self {
        /// Most steps apart, which bounds the work.
        const MOST: usize = 1000;
        let deviations: Vec<T> = samples.iter().map(|value| value.clone() - mean.clone()).collect();
        let sum = |apart: usize| dot(&deviations[apart..], &deviations);
        let furthest = (samples.len() / 4).min(MOST);
        let correlated = (1..=furthest).map(sum).take_while(|sum| T::int(0).less(sum));
        let sums: Vec<T> = core::iter::once(sum(0)).chain(correlated).collect();
        let count = whole::<T>(samples.len());
        let of_mean = both_ways(&sums) / (count.clone() * whole::<T>(samples.len() + 1 - 2 * sums.len()));
        let covariances = sums.into_iter().map(|sum| sum / count.clone() + of_mean.clone()).collect();
        Noise { covariances, samples: samples.len() }
    }

    /// Computes the variance of a weighted sum of samples; at least that of samples that are independent.
    pub fn variance_of_sum(&self, weights: &[T]) -> T {
        let of_pairs = |(apart, covariance): (usize, &T)| dot(&weights[apart..], weights) * covariance.clone();
        let terms: Vec<T> = self.covariances.iter().enumerate().map(of_pairs).collect();
        both_ways(&terms).larger(terms[0].clone())
    }

    /// Computes the variance of the normal distribution whose 95 % are those of a weighted sum of samples whose noise is not known better than from these:
    /// Student's distribution with ν = n/(2K + 1) − 1 degrees of freedom. The noise of a long sum is a spectral density at frequency zero, and its estimate from
    /// covariances up to K steps apart has n/(2K + 1) of them (Priestley 1981, chapter 6), of which the mean takes one.
    pub fn wide_variance_of_sum(&self, weights: &[T]) -> T {
        let freedom = whole::<T>(self.samples) / whole::<T>(2 * self.covariances.len() - 1) - T::int(1);
        self.variance_of_sum(weights) * student(freedom)
    }

    /// Computes the number of independent samples whose mean would be as uncertain, n γ_0/(γ_0 + 2 Σ γ_k).
    pub fn independent_samples(&self) -> T {
        let count = whole::<T>(self.samples);
        let sum = both_ways(&self.covariances);
        if T::int(0).less(&sum) { count * self.covariances[0].clone() / sum } else { count }
    }
}

/// Returns the variance of the normal distribution of which 95 % are those of Student's distribution, over that of the same samples.
///
/// The square of the ratio of the two quantiles is (ν² + 0.764 ν + 1.265)/(ν² − 1.6567 ν + 0.7288) from ν = 1 degree of freedom on, to 0.5 %; for large ν it is
/// 1 + (1.96² + 1)/(2 ν).
pub(super) fn student<T: Ordered>(freedom: T) -> T {
    let ten_thousandths = |numerator: i32| T::int(numerator) / T::int(10_000);
    let freedom = freedom.larger(T::int(1));
    let squared = freedom.clone().squared();
    let numerator = squared.clone() + ten_thousandths(7640) * freedom.clone() + ten_thousandths(12_650);
    numerator / (squared - ten_thousandths(16_567) * freedom + ten_thousandths(7288))
}

/// Adds the terms of samples that are none, one, two, … steps apart, in both directions.
fn both_ways<T: Field>(terms: &[T]) -> T {
    terms[1..].iter().fold(terms[0].clone(), |sum, each| sum + T::int(2) * each.clone())
}

#[cfg(test)]
mod tests;
