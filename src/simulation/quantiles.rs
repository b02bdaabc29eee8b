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
    /// Those above zero, and those below.
    signed: [Window; 2],
    zero: u64,
    not_a_number: u64,
    range: Option<[f64; 2]>,
}

/// Bins by which a window grows.
const STEP: usize = 4 << BITS;

/// The bins of one sign from about the first to about the last that has a number.
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
        self.found[place.unwrap_or_else(|| panic!("{of} is not among the outputs of the summary"))].sorted().quantile(share)
    }
}

impl Reduce for Quantiles {
    fn outputs(&self) -> Vec<Output> {
        self.of.clone()
    }

    fn take(&mut self, samples: &Samples<'_>) {
        for (of, bins) in self.of.iter().zip(&mut self.found) {
            bins.add(samples.column(*of));
        }
    }

    fn merge(&mut self, later: Self) {
        self.found.iter_mut().zip(&later.found).for_each(|(bins, later)| bins.merge(later));
    }
}

impl Bins {
    pub(crate) fn add(&mut self, numbers: &[f64]) {
        let mut rest = numbers;
        while let Some((x, later)) = self.count(rest).split_first() {
            // Neither zero nor what is not a number is in a window.
            match *x {
                x if x.is_nan() => self.not_a_number += 1,
                0.0 => self.zero += 1,
                x => self.signed[usize::from(x.is_sign_negative())].add(bin(x.abs()), 1),
            }
            rest = later;
        }
        self.widen(ends(numbers));
    }

    /// Counts the numbers up to the first that is outside the windows, and returns it with those after it.
    fn count<'a>(&mut self, numbers: &'a [f64]) -> &'a [f64] {
        // Apart from the windows, which would be read anew for each number.
        let [above, below] = self.signed.each_mut().map(|window| (window.first, window.counts.as_mut_slice()));
        for (place, x) in numbers.iter().enumerate() {
            let (first, counts) = if x.is_sign_negative() { (below.0, &mut *below.1) } else { (above.0, &mut *above.1) };
            match counts.get_mut(bin(x.abs()).wrapping_sub(first)) {
                Some(count) => *count += 1,
                None => return &numbers[place..],
            }
        }
        &[]
    }

    /// Takes in the ends of other numbers.
    fn widen(&mut self, ends: Option<[f64; 2]>) {
        self.range = match (self.range, ends) {
            (Some([a, b]), Some([c, d])) => Some([if c < a { c } else { a }, if d > b { d } else { b }]),
            (own, others) => own.or(others),
        };
    }

    pub(crate) fn merge(&mut self, later: &Bins) {
        self.signed.iter_mut().zip(&later.signed).for_each(|(window, later)| window.merge(later));
        self.zero += later.zero;
        self.not_a_number += later.not_a_number;
        self.widen(later.range);
    }

    /// Returns the numbers in order, from which quantiles are read.
    pub(crate) fn sorted(&self) -> Sorted {
        let [above, below] = &self.signed;
        let below = below.bins().rev().map(|(bin, count)| ([-edge(bin + 1), -edge(bin)], count));
        let above = above.bins().map(|(bin, count)| ([edge(bin), edge(bin + 1)], count));
        let mut before = 0;
        let bins = below.chain([([0.0; 2], self.zero)]).chain(above).filter(|(_, count)| *count > 0).map(|(ends, count)| {
            before += count;
            (ends, before - count, count)
        });
        Sorted { bins: bins.collect(), range: self.range.filter(|_| self.not_a_number == 0) }
    }
}

/// Bins in order.
pub(crate) struct Sorted {
    /// The ends of a bin, the numbers before it, and those in it.
    bins: Vec<([f64; 2], u64, u64)>,
    /// The least and the greatest number; nothing if there is none, or one is not a number.
    range: Option<[f64; 2]>,
}

impl Sorted {
    fn count(&self) -> u64 {
        self.bins.last().map_or(0, |(_, before, count)| before + count)
    }

    /// Returns the share of the numbers that are less than a number; those of a bin are taken as evenly spread in it.
    #[cfg(feature = "uncertainty")]
    pub(crate) fn share_below(&self, x: f64) -> f64 {
        let place = self.bins.partition_point(|([_, end], ..)| *end <= x);
        let below = match self.bins.get(place) {
            Some(([start, end], before, count)) if *start < x => *before as f64 + *count as f64 * ((x - start) / (end - start)),
            Some((_, before, _)) => *before as f64,
            None => self.count() as f64,
        };
        below / self.count() as f64
    }

    pub(crate) fn quantile(&self, share: f64) -> f64 {
        let (Some([least, greatest]), true) = (self.range, (0.0..=1.0).contains(&share)) else { return f64::NAN };
        // The ends are known.
        if share == 0.0 || share == 1.0 {
            return if share == 0.0 { least } else { greatest };
        }
        // The rank of the sample, from 0, between two of them if need be.
        let rank = share * (self.count() - 1) as f64;
        // The samples of a bin are taken as evenly spread in it.
        let place = |before: u64, count: u64| (rank - before as f64 + 0.5) / count as f64;
        let at = self.bins.partition_point(|(_, before, count)| place(*before, *count) > 1.0).min(self.bins.len() - 1);
        let ([start, end], before, count) = self.bins[at];
        let (start, end) = (if start < least { least } else { start }, if end > greatest { greatest } else { end });
        if start == end { start } else { start + place(before, count).clamp(0.0, 1.0) * (end - start) }
    }
}

/// Returns the least and the greatest of some numbers, or nothing if none is one.
fn ends(numbers: &[f64]) -> Option<[f64; 2]> {
    const WIDTH: usize = 8;
    let (mut least, mut greatest) = ([f64::INFINITY; WIDTH], [f64::NEG_INFINITY; WIDTH]);
    let (eights, rest) = numbers.as_chunks::<WIDTH>();
    for eight in eights {
        for i in 0..WIDTH {
            least[i] = if eight[i] < least[i] { eight[i] } else { least[i] };
            greatest[i] = if eight[i] > greatest[i] { eight[i] } else { greatest[i] };
        }
    }
    let least = least.iter().chain(rest).fold(f64::INFINITY, |least, x| if *x < least { *x } else { least });
    let greatest = greatest.iter().chain(rest).fold(f64::NEG_INFINITY, |greatest, x| if *x > greatest { *x } else { greatest });
    (least <= greatest).then_some([least, greatest])
}

impl Window {
    fn add(&mut self, bin: usize, count: u64) {
        self.reach(bin);
        self.counts[bin - self.first] += count;
    }

    /// Extends the window to a bin, by whole steps so that it is seldom moved.
    fn reach(&mut self, bin: usize) {
        let start = bin / STEP * STEP;
        if self.counts.is_empty() {
            self.first = start;
        } else if bin < self.first {
            self.counts.splice(0..0, core::iter::repeat_n(0, self.first - start));
            self.first = start;
        }
        if bin - self.first >= self.counts.len() {
            self.counts.resize(start + STEP - self.first, 0);
        }
    }

    fn merge(&mut self, later: &Window) {
        if later.counts.is_empty() {
            return;
        }
        self.reach(later.first + later.counts.len() - 1);
        self.reach(later.first);
        let own = &mut self.counts[later.first - self.first..];
        own.iter_mut().zip(&later.counts).for_each(|(count, later)| *count += later);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(numbers: &[f64]) -> Bins {
        let mut bins = Bins::default();
        bins.add(numbers);
        bins
    }

    #[test]
    fn parts_that_are_merged_say_what_the_whole_says() {
        let numbers: Vec<f64> = (0..1000).map(|i| if i % 10 == 0 { 0.0 } else { libm::sin(f64::from(i)) * 1e3 }).collect();
        let whole = of(&numbers).sorted();
        for at in [0, 1, 500, 1000] {
            let (one, other) = numbers.split_at(at);
            for [first, then] in [[one, other], [other, one]] {
                let mut merged = of(first);
                merged.merge(&of(then));
                let merged = merged.sorted();
                assert_eq!(merged.count(), 1000);
                for share in [0.0, 0.1, 0.45, 0.5, 0.9, 1.0] {
                    assert_eq!(merged.quantile(share), whole.quantile(share), "{at} {share}");
                }
            }
        }
    }

    #[test]
    fn one_that_is_not_a_number_leaves_no_quantile_wherever_it_is_merged() {
        let (good, bad) = (of(&[1.0, 2.0]), of(&[3.0, f64::NAN]));
        for [first, then] in [[&good, &bad], [&bad, &good]] {
            let mut merged = first.clone();
            merged.merge(then);
            assert!(merged.sorted().quantile(0.5).is_nan());
        }
        assert_eq!(good.sorted().quantile(1.0), 2.0);
    }

    #[cfg(feature = "uncertainty")]
    #[test]
    fn the_share_below_is_that_of_evenly_spread_numbers() {
        // Some 400 numbers in each bin.
        let even: Vec<f64> = (0..100_000).map(|i| 1.0 + (f64::from(i) + 0.5) * 1e-5).collect();
        for sign in [1.0, -1.0] {
            let numbers: Vec<f64> = even.iter().map(|x| sign * x).collect();
            let sorted = of(&numbers).sorted();
            for x in [1.0, 1.000_1, 1.37, 1.5, 1.999, 2.0] {
                let wanted = if sign > 0.0 { x - 1.0 } else { 2.0 - x };
                assert!((sorted.share_below(sign * x) - wanted).abs() < 1e-5, "{x}: {}", sorted.share_below(sign * x));
            }
            assert_eq!([-3.0, 3.0].map(|x| sorted.share_below(x)), [0.0, 1.0]);
        }
    }
}
