//! The function whose least value is sought: an output, or its negative, of the uncertain numbers, on any scalar.

use alloc::vec::Vec;

use super::smooth::Smooth;
use crate::scalar::Real;
use crate::scalar::interval::{Interval, Truth};
use crate::sensitivity::dual::Dual;

/// A function of uncertain numbers, written once for every scalar, so that [`bounds_of`](super::bounds_of) can guarantee its range.
pub trait Bounded: Sync {
    /// Returns how many numbers there are.
    fn numbers(&self) -> usize;

    /// Computes the value without checking that physics accepts the numbers.
    ///
    /// It is computed on floats, intervals and both with derivatives. Where a comparison selects one of two results the function has to be continuous, or
    /// [`is_continuous`](Self::is_continuous) has to say that it is not.
    fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T;

    /// Returns the value at a point that physics accepts, else `None`.
    fn at(&self, point: &[f64]) -> Option<f64>;

    /// Returns whether physics accepts the points of a cell.
    fn is_possible(&self, cell: &[Interval]) -> Truth;

    /// Returns whether the function is continuous over a cell, given its enclosure there.
    fn is_continuous(&self, cell: &[Interval], value: Interval) -> bool;

    /// Returns the value over a cell with [`is_possible`](Self::is_possible) and [`is_continuous`](Self::is_continuous); to be replaced where they share work.
    fn over(&self, cell: &[Interval]) -> Enclosure {
        let value = self.value(cell);
        Enclosure { value, is_possible: self.is_possible(cell), is_continuous: self.is_continuous(cell, value) }
    }

    /// Prepares for a search around a point that physics accepts: an angle is measured from its direction there.
    fn turn_to(&mut self, accepted: &[f64]) {
        let _ = accepted;
    }
}

/// Enclosure of a function over a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// No value over the cell is outside.
    pub value: Interval,
    /// Whether physics accepts the points of the cell.
    pub is_possible: Truth,
    /// Whether the function is continuous over the cell.
    pub is_continuous: bool,
}

/// A function to be minimized: that of which the range is wanted, or its negative.
pub(super) struct Objective<'a, F> {
    of: &'a F,
    is_negated: bool,
}

/// A point that physics accepts, and the value of the objective there.
#[derive(Clone, Debug)]
pub(super) struct Attained {
    pub(super) point: Vec<f64>,
    pub(super) value: f64,
}

impl<'a, F: Bounded> Objective<'a, F> {
    pub(super) fn new(of: &'a F) -> Self {
        Objective { of, is_negated: false }
    }

    pub(super) fn negated(&self) -> Self {
        Objective { of: self.of, is_negated: !self.is_negated }
    }

    fn signed<T: Real>(&self, value: T) -> T {
        if self.is_negated { -value } else { value }
    }

    /// Returns the value at a point, if physics accepts it.
    pub(super) fn at(&self, point: &[f64]) -> Option<f64> {
        self.of.at(point).filter(|value| value.is_finite()).map(|value| self.signed(value))
    }

    /// Returns the value at a point with its derivative and its second derivative by one of the numbers. It is not checked.
    pub(super) fn curve(&self, point: &[f64], by: usize) -> [f64; 3] {
        let seeded = |i: usize| f64::from(u8::from(i == by));
        let numbers: Vec<Dual<Dual<f64>>> = point
            .iter()
            .enumerate()
            .map(|(i, x)| Dual { value: Dual { value: *x, derivative: seeded(i) }, derivative: Dual::constant(seeded(i)) })
            .collect();
        let value = self.signed(self.of.value(&numbers));
        [value.value.value, value.value.derivative, value.derivative.derivative]
    }

    /// Returns the enclosure over a cell.
    pub(super) fn over(&self, cell: &[Interval]) -> Enclosure {
        let over = self.of.over(cell);
        Enclosure { value: self.signed(over.value), ..over }
    }

    /// Returns whether physics accepts the points of a cell.
    pub(super) fn is_possible(&self, cell: &[Interval]) -> Truth {
        self.of.is_possible(cell)
    }

    /// Returns the enclosure of the value over a cell, unchecked: for a point, that of its rounding.
    pub(super) fn value_over(&self, cell: &[Interval]) -> Interval {
        self.signed(self.of.value(cell))
    }

    /// Returns the derivative by one of the numbers over a cell, with the value.
    pub(super) fn slope_over(&self, numbers: &mut [Dual<Interval>], by: usize) -> Dual<Interval> {
        numbers[by].derivative = Interval::from(1.0);
        let value = self.signed(self.of.value(numbers));
        numbers[by].derivative = Interval::default();
        value
    }

    /// Returns the second derivative by two of the numbers over a cell, all real numbers if the objective may not be smooth there.
    pub(super) fn bend_over(&self, cell: &[Interval], by: [usize; 2]) -> Interval {
        let seed = |i: usize, by: usize| Smooth::from(f64::from(u8::from(i == by)));
        let number = |(i, x): (usize, &Interval)| Dual {
            value: Dual { value: Smooth(*x), derivative: seed(i, by[0]) },
            derivative: Dual::constant(seed(i, by[1])),
        };
        let numbers: Vec<Dual<Dual<Smooth>>> = cell.iter().enumerate().map(number).collect();
        self.signed(self.of.value(&numbers)).derivative.derivative.0
    }
}
