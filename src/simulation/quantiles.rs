//! Quantiles without storing the samples.

use alloc::vec;
use alloc::vec::Vec;

use super::{Reduce, Samples};
use crate::output::Output;

/// Bits of the significand that tell bins apart: 256 bins between a number and its double.
const BITS: u32 = 8;

/// Quantiles of outputs, each within 0.4 % of itself.
///
/// A bin is what the leading bits of a number say: its sign, its exponent and eight bits of its significand. So the bins need no limits, no logarithm and no
/// order: summaries that are merged in any order are the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantiles {
    of: Vec<Output>,
    found: Vec<Bins>,
}

/// How many numbers are in each bin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Bins {
    below_zero: Window,
    zero: u64,
    above_zero: Window,
    not_a_number: u64,
    range: Option<[f64; 2]>,
}

/// The bins of one sign from the first to the last that has a number.
#[derive(Clone, Debug, Default, PartialEq)]
struct Window {
    first: usize,
    counts: Vec<u64>,
}

impl Quantiles {
    /// Creates the summary of no samples.
    #[must_use]
    pub fn of(of: &[Output]) -> Self {
        Quantiles { of: of.to_vec(), found: vec![Bins::default(); of.len()] }
    }

    /// Returns the value below which an output lies in a share of the samples; NaN without a sample, for a share outside [0, 1], and if the output is not a
    /// number in one of them.
    ///
    /// # Panics
    ///
    /// If the summary does not have the output.
    pub fn quantile(&self, of: Output, share: f64) -> f64 {
        let place = self.of.iter().position(|output| *output == of);
        self.found[place.unwrap_or_else(|| panic!("{of} is not among the outputs of the summary"))].quantile(share)
    }
}

impl Reduce for Quantiles {
    fn outputs(&self) -> Vec<Output> {
        self.of.clone()
    }

    fn take(&mut self, samples: &Samples<'_>) {
        for (of, bins) in self.of.iter().zip(&mut self.found) {
            samples.column(*of).iter().for_each(|x| bins.add(*x));
        }
    }

    fn merge(&mut self, later: Self) {
        self.found.iter_mut().zip(&later.found).for_each(|(bins, later)| bins.merge(later));
    }
}

impl Bins {
    pub(crate) fn add(&mut self, x: f64) {
        if x.is_nan() {
            self.not_a_number += 1;
            return;
        }
        match &mut self.range {
            Some([least, greatest]) => {
                *least = if x < *least { x } else { *least };
                *greatest = if x > *greatest { x } else { *greatest };
            }
            none => *none = Some([x; 2]),
        }
        if x == 0.0 {
            self.zero += 1;
        } else if x < 0.0 {
            self.below_zero.add(bin(-x), 1);
        } else {
            self.above_zero.add(bin(x), 1);
        }
    }

    pub(crate) fn merge(&mut self, later: &Bins) {
        self.below_zero.merge(&later.below_zero);
        self.zero += later.zero;
        self.above_zero.merge(&later.above_zero);
        self.not_a_number += later.not_a_number;
        self.range = match (self.range, later.range) {
            (Some([a, b]), Some([c, d])) => Some([if c < a { c } else { a }, if d > b { d } else { b }]),
            (own, later) => own.or(later),
        };
    }

    /// Returns each bin that has a number, in order: its ends, and how many.
    fn in_order(&self) -> impl Iterator<Item = ([f64; 2], u64)> + Clone + '_ {
        let below = self.below_zero.bins().rev().map(|(bin, count)| ([-edge(bin + 1), -edge(bin)], count));
        let above = self.above_zero.bins().map(|(bin, count)| ([edge(bin), edge(bin + 1)], count));
        below.chain([([0.0; 2], self.zero)]).chain(above).filter(|(_, count)| *count > 0)
    }

    /// Returns the share of the numbers that are less than a number; those of a bin are taken as evenly spread in it.
    #[cfg(feature = "uncertainty")]
    pub(crate) fn share_below(&self, x: f64) -> f64 {
        let (mut below, mut all) = (0.0, 0.0);
        for ([start, end], count) in self.in_order() {
            let share = if x >= end { 1.0 } else { ((x - start) / (end - start)).max(0.0) };
            (below, all) = (below + share * count as f64, all + count as f64);
        }
        below / all
    }

    pub(crate) fn quantile(&self, share: f64) -> f64 {
        let Some([least, greatest]) = self.range.filter(|_| self.not_a_number == 0 && (0.0..=1.0).contains(&share)) else {
            return f64::NAN;
        };
        // The ends are known.
        if share == 0.0 || share == 1.0 {
            return if share == 0.0 { least } else { greatest };
        }
        let all = self.in_order();
        let samples: u64 = all.clone().map(|(_, count)| count).sum();
        // The rank of the sample, from 0, between two of them if need be.
        let rank = share * (samples - 1) as f64;
        let mut before = 0;
        for ([start, end], count) in all {
            // The samples of a bin are taken as evenly spread in it.
            let place = (rank - before as f64 + 0.5) / count as f64;
            if place <= 1.0 || before + count == samples {
                let (start, end) = (if start < least { least } else { start }, if end > greatest { greatest } else { end });
                return if start == end { start } else { start + place.clamp(0.0, 1.0) * (end - start) };
            }
            before += count;
        }
        greatest
    }
}

impl Window {
    fn add(&mut self, bin: usize, count: u64) {
        if self.counts.is_empty() {
            self.first = bin;
        } else if bin < self.first {
            self.counts.splice(0..0, core::iter::repeat_n(0, self.first - bin));
            self.first = bin;
        }
        let place = bin - self.first;
        if place >= self.counts.len() {
            self.counts.resize(place + 1, 0);
        }
        self.counts[place] += count;
    }

    fn merge(&mut self, later: &Window) {
        // The ends first, so that the window grows once.
        let bins = later.bins().filter(|(_, count)| *count > 0);
        bins.clone().rev().take(1).chain(bins.clone().take(1)).for_each(|(bin, _)| self.add(bin, 0));
        bins.for_each(|(bin, count)| self.add(bin, count));
    }

    fn bins(&self) -> impl DoubleEndedIterator<Item = (usize, u64)> + Clone + '_ {
        self.counts.iter().enumerate().map(|(i, count)| (self.first + i, *count))
    }
}

/// Returns the bin of a number above zero.
fn bin(x: f64) -> usize {
    (x.to_bits() >> (f64::MANTISSA_DIGITS - 1 - BITS)) as usize
}

/// Returns the least number of a bin.
fn edge(bin: usize) -> f64 {
    f64::from_bits((bin as u64) << (f64::MANTISSA_DIGITS - 1 - BITS))
}
