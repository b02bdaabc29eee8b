//! Counts in bins of equal width.

use alloc::vec;
use alloc::vec::Vec;

use super::{Reduce, Samples};
use crate::output::Output;

/// How many samples have an output in each of several bins of equal width.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    of: Output,
    least: f64,
    width: f64,
    counts: Vec<u64>,
    /// Samples below the first bin.
    pub below: u64,
    /// Samples from the end of the last bin on.
    pub above: u64,
    /// Samples in which the output is not a number.
    pub not_a_number: u64,
}

impl Histogram {
    /// Creates the summary of no samples, with bins from `least` to `greatest`.
    ///
    /// # Panics
    ///
    /// Unless the limits are finite and in order, and there is a bin.
    #[must_use]
    pub fn of(of: Output, least: f64, greatest: f64, bins: usize) -> Self {
        let width = (greatest - least) / bins as f64;
        assert!(width.is_finite() && width > 0.0, "{bins} bins from {least} to {greatest}");
        Histogram { of, least, width, counts: vec![0; bins], below: 0, above: 0, not_a_number: 0 }
    }

    /// Returns the number of samples in each bin.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// Returns the lower edge of a bin, or for the number of bins the end of the last.
    pub fn edge(&self, bin: usize) -> f64 {
        self.least + bin as f64 * self.width
    }
}

impl Reduce for Histogram {
    fn outputs(&self) -> Vec<Output> {
        vec![self.of]
    }

    fn take(&mut self, samples: &Samples<'_>) {
        for x in samples.column(self.of) {
            let place = (x - self.least) / self.width;
            if place.is_nan() {
                self.not_a_number += 1;
            } else if place < 0.0 {
                self.below += 1;
            } else {
                // The greatest numbers are clamped to that of no bin.
                match self.counts.get_mut(place as usize) {
                    Some(count) => *count += 1,
                    None => self.above += 1,
                }
            }
        }
    }

    fn merge(&mut self, later: Self) {
        self.counts.iter_mut().zip(&later.counts).for_each(|(count, later)| *count += later);
        self.below += later.below;
        self.above += later.above;
        self.not_a_number += later.not_a_number;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bin_begins_at_its_edge_and_nothing_is_lost() {
        let column = vec![vec![-0.5, 0.0, 0.999, 1.0, 2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY]];
        let mut found = Histogram::of(Output::Loss, 0.0, 2.0, 2);
        found.take(&Samples { of: &[Output::Loss], columns: &column, first: 0, places: None });
        assert_eq!(found.outputs(), [Output::Loss]);
        assert_eq!((found.counts(), found.below, found.above, found.not_a_number), (&[2, 1][..], 2, 2, 1));
        let twice = found.clone();
        found.merge(twice);
        assert_eq!((found.counts(), found.below, found.above, found.not_a_number), (&[4, 2][..], 4, 4, 2));
        assert_eq!([0, 1, 2].map(|bin| found.edge(bin)), [0.0, 1.0, 2.0]);
    }
}
