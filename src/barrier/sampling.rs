//! What a channel does between its samples, and what that adds to the variance of its integral.

use alloc::vec::Vec;

use super::record::{Record, whole};
use crate::scalar::Ordered;

/// How a channel bends at its samples, all but the first and the last.
pub(super) struct Bends<T> {
    /// The bend at the second sample, and so on.
    inner: Vec<Bend<T>>,
}

struct Bend<T> {
    /// The change of slope times the longer step beside the sample.
    size: T,
    /// The longer step.
    longer: T,
    /// The mean of both steps.
    mean: T,
}

impl<T: Ordered<Mask = bool>> Bends<T> {
    /// Finds those of a channel.
    pub(super) fn of(record: &Record<T>) -> Bends<T> {
        let (times, values) = (record.times(), record.values());
        let at = |(times, values): (&[T], &[T])| {
            let [before, after] = [0, 1].map(|i| times[i + 1].clone() - times[i].clone());
            let slope = |i: usize, step: &T| (values[i + 1].clone() - values[i].clone()) / step.clone();
            let change = slope(1, &after) - slope(0, &before);
            let mean = (times[2].clone() - times[0].clone()).half();
            let longer = before.larger(after);
            Bend { size: longer.clone() * change, longer, mean }
        };
        Bends { inner: times.windows(3).zip(values.windows(3)).map(at).collect() }
    }

    /// Computes what sampling adds to the variance of an integral with a weight for each sample, given the samples of the unloaded channel and their variance.
    pub(super) fn variance_of_integral(&self, weights: &[T], unloaded: impl Iterator<Item = usize>, noise: &T) -> T {
        // The weights of all samples but the first and the last.
        let shares: Vec<T> = self.inner.iter().zip(&weights[1..]).map(|(bend, weight)| bend.share_inside(weight)).collect();
        self.variance_of_kinks(&shares) + self.variance_of_alternation(&shares, unloaded, noise)
    }

    /// Computes what kinks between the samples add: (h²Δs/12)² of each sample, where the slope changes by Δs and the longer of its steps is h. By the formula of
    /// Euler and Maclaurin −h²Δs B₂(θ)/2 is the error of the trapezoids at a kink a share θ of a step after a sample, at most that of a kink on a sample,
    /// where B₂ = 1/6.
    fn variance_of_kinks(&self, shares: &[T]) -> T {
        let zero = T::int(0);
        let inside = self.inner.iter().zip(shares).filter(|(_, share)| zero.less(share));
        inside
            .fold(zero.clone(), |sum, (bend, share)| sum + share.clone() * (bend.longer.clone() * bend.size.clone() / T::int(12)).squared())
    }

    /// Computes what a channel that its samples do not resolve adds: s² Σ h_i h_{i+1}, where h_i is the mean of the steps beside a sample.
    ///
    /// Samples of a smooth channel bend the same way, and of one with kinks each by itself. Those that vary by themselves with a variance s² bend to and fro: the
    /// mean product of the bends of neighbors is −4s². Noise does so too, and is in the variance already, so that only what is beyond twice the noise
    /// of the unloaded channel counts.
    fn variance_of_alternation(&self, shares: &[T], unloaded: impl Iterator<Item = usize>, noise: &T) -> T {
        let zero = T::int(0);
        let varies = |pair: &[Bend<T>]| pair[0].size.clone() * pair[1].size.clone() / T::int(-4);
        // The first and the last sample of the baseline bend towards others.
        let unloaded: Vec<usize> = unloaded.collect();
        let pairs = unloaded.windows(4);
        let count = whole(pairs.len().max(1));
        let of_noise = pairs.fold(zero.clone(), |sum, four| sum + varies(&self.inner[four[0]..four[2]])) / count;
        let noise = noise.clone().larger(of_noise);
        let pairs = self.inner.windows(2).zip(shares.windows(2));
        let inside = pairs.filter(|(_, shares)| shares.iter().all(|share| zero.less(share)));
        let beyond = inside.fold(zero.clone(), |sum, (pair, shares)| {
            let [one, other] = [0, 1].map(|i| shares[i].clone() * pair[i].mean.clone());
            sum + one * other * (varies(pair) - T::int(2) * noise.clone())
        });
        zero.larger(beyond)
    }
}

impl<T: Ordered<Mask = bool>> Bend<T> {
    /// Computes the share with which a sample of a weight counts as one of a window. A sample on its edge, which has half of its weight, counts in full; beyond the edge
    /// one counts smoothly less, so that there is a derivative by the edge.
    fn share_inside(&self, weight: &T) -> T {
        let of_weight = T::int(1).smaller(weight.clone() * T::int(2) / self.mean.clone());
        of_weight.clone() * (T::int(2) - of_weight)
    }
}
