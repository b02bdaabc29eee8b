//! Cells of a box, which branch and bound divides.

use alloc::vec::Vec;
use core::cmp::Ordering;

use crate::scalar::interval::Interval;

/// Something with a bound, in a heap: that with the least bound is the greatest, and comes first.
pub(crate) struct LeastFirst<C> {
    pub(crate) bound: f64,
    pub(crate) cell: C,
}

impl<C> Ord for LeastFirst<C> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl<C> PartialOrd for LeastFirst<C> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<C> PartialEq for LeastFirst<C> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<C> Eq for LeastFirst<C> {}

/// Returns a number in the middle of an interval with finite bounds.
pub(crate) fn middle_of(range: Interval) -> f64 {
    (0.5 * range.lower() + 0.5 * range.upper()).clamp(range.lower(), range.upper())
}

pub(crate) fn middle(cell: &[Interval]) -> Vec<f64> {
    cell.iter().copied().map(middle_of).collect()
}

pub(crate) fn is_divisible(range: Interval) -> bool {
    let middle = middle_of(range);
    range.lower() < middle && middle < range.upper()
}

/// Returns the two halves of a cell.
pub(crate) fn halves(ranges: &[Interval], by: usize) -> [Vec<Interval>; 2] {
    let middle = middle_of(ranges[by]);
    let half = |lower, upper| {
        let mut half = ranges.to_vec();
        half[by] = Interval::new(lower, upper).unwrap_or(half[by]);
        half
    };
    [half(ranges[by].lower(), middle), half(middle, ranges[by].upper())]
}
