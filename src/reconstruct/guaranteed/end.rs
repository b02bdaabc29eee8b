//! The search for one end of a range.

use std::collections::BinaryHeap;

use super::elimination::Pivots;
use super::equations::Equations;
use super::{GuaranteedSearch, NoRange};
use crate::cells::{LeastFirst, halves, middle, middle_of};
use crate::scalar::Ordered;
use crate::scalar::interval::Interval;
use crate::sensitivity::dual::Dual;

/// Cells between two questions whether the search goes on.
const STRIDE: usize = 64;

struct Cell {
    ranges: Vec<Interval>,
    /// The number to divide, or `None` if the cell is too small.
    divide: Option<usize>,
}

/// A search for the least value of an unknown, times a sign.
pub(super) struct End<'a, 'p> {
    equations: &'a Equations<'p>,
    of: usize,
    sign: f64,
    /// The point of the least value found.
    best: Option<Vec<f64>>,
    open: BinaryHeap<LeastFirst<Cell>>,
}

/// The end that was found.
pub(super) struct Found {
    pub(super) bound: f64,
    pub(super) attained: Vec<f64>,
    pub(super) cells: usize,
}

impl<'a, 'p> End<'a, 'p> {
    /// Begins with points that meet the equations.
    pub(super) fn least(equations: &'a Equations<'p>, of: usize, points: &[Vec<f64>]) -> Self {
        End::from(equations, of, 1.0, points)
    }

    /// The other end.
    pub(super) fn greatest(equations: &'a Equations<'p>, of: usize, points: &[Vec<f64>]) -> Self {
        End::from(equations, of, -1.0, points)
    }

    fn from(equations: &'a Equations<'p>, of: usize, sign: f64, points: &[Vec<f64>]) -> Self {
        let best = points.iter().min_by(|one, other| (sign * one[of]).total_cmp(&(sign * other[of]))).cloned();
        End { equations, of, sign, best, open: BinaryHeap::new() }
    }

    fn bound(&self, range: Interval) -> f64 {
        if self.sign > 0.0 { range.lower() } else { -range.upper() }
    }

    fn value(&self, point: &[f64]) -> f64 {
        self.sign * point[self.of]
    }

    /// Returns the least value found; infinite without any.
    fn best_value(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |point| self.value(point))
    }

    pub(super) fn find(mut self, search: &GuaranteedSearch, budget: usize, goes_on: &dyn Fn(usize) -> bool) -> Result<Found, NoRange> {
        let scale = self.equations.scale(self.of);
        self.enter(self.equations.whole.clone());
        let mut cells = 0;
        // The least bound of cells too small to divide, in which no point was found.
        let mut undivided = f64::INFINITY;
        loop {
            let best = self.best_value();
            let first = self.open.peek().map_or(f64::INFINITY, |first| first.bound);
            if best.is_finite() && search.is_tight(first.min(undivided), best, scale) {
                break;
            }
            // A better point would not bring the bound closer.
            if (best.is_finite() && undivided <= first) || cells >= budget || (cells % STRIDE == STRIDE - 1 && !goes_on(cells)) {
                break;
            }
            let Some(LeastFirst { bound, cell }) = self.open.pop() else { break };
            cells += 1;
            match cell.divide {
                Some(by) => halves(&cell.ranges, by).into_iter().for_each(|half| self.enter(half)),
                None => undivided = undivided.min(bound),
            }
        }
        let best = self.best_value();
        // Cells that are no longer open have no value below the best one.
        let bound = self.open.peek().map_or(best, |first| first.bound.min(best)).min(undivided);
        match self.best {
            Some(attained) => Ok(Found { bound, attained, cells }),
            None if self.open.is_empty() && undivided.is_infinite() => Err(NoRange::Excluded),
            None => Err(NoRange::NoPoint { cells }),
        }
    }

    /// Narrows a cell and adds it to the open ones, unless nothing in it meets the equations or is better than the best one.
    fn enter(&mut self, mut ranges: Vec<Interval>) {
        let mut divide = None;
        if self.best.is_none() {
            self.consider_unknowns(&ranges);
        }
        for pass in 0..4 {
            let over = self.equations.over(&ranges);
            if !over.may_hold || self.bound(ranges[self.of]) >= self.best_value() {
                return;
            }
            let slopes = derivatives(self.equations.slopes(&ranges));
            if !over.is_continuous || slopes.iter().flatten().any(|slope| !slope.finite().is_certain()) {
                self.consider_middle(&ranges);
                divide = self.equations.widest(&ranges);
                break;
            }
            let pivots = Pivots::of(&slopes, &ranges, Some(self.of));
            let rows = pivots.combine(&slopes);
            let corner = self.corner(&ranges, &pivots, &rows);
            let is_within = |point: &Vec<f64>| point.iter().zip(&ranges).all(|(x, range)| range.contains(*x));
            let corner = self.consider(&corner, &pivots).filter(is_within).unwrap_or(corner);
            let before = ranges.clone();
            for center in [middle(&before), corner] {
                if !self.narrow(&mut ranges, &center, &slopes, &rows, &pivots) {
                    return;
                }
            }
            divide = self.choose(&ranges, &slopes, &rows, &pivots);
            let shrinks = |i: usize| ranges[i].width() < 0.5 * before[i].width();
            if pass > 0 && !(0..ranges.len()).any(shrinks) {
                break;
            }
        }
        let bound = self.bound(ranges[self.of]);
        if bound < self.best_value() {
            self.open.push(LeastFirst { bound, cell: Cell { ranges, divide } });
        }
    }

    /// Returns the row of the unknown, if it is one of the numbers that the equations are solved for.
    fn row<'r>(&self, pivots: &Pivots, rows: &'r [Vec<Interval>]) -> Option<&'r Vec<Interval>> {
        pivots.of.iter().position(|pivot| *pivot == self.of).map(|row| &rows[row])
    }

    /// Returns the corner at which the unknown is least, as far as the equations make it so.
    fn corner(&self, ranges: &[Interval], pivots: &Pivots, rows: &[Vec<Interval>]) -> Vec<f64> {
        let mut corner = middle(ranges);
        if let Some(row) = self.row(pivots, rows).filter(|row| !row[self.of].contains(0.0)) {
            for i in (0..ranges.len()).filter(|i| !pivots.of.contains(i)) {
                corner[i] = toward_least(ranges[i], -row[i] / row[self.of] * Interval::from(self.sign));
            }
        }
        corner
    }

    /// Returns the number by which a cell is divided.
    fn choose(&self, ranges: &[Interval], slopes: &[Vec<Interval>], rows: &[Vec<Interval>], pivots: &Pivots) -> Option<usize> {
        let change = |row: &[Interval], i: usize| row[i].magnitude().upper() * ranges[i].width();
        let is_solved = pivots.of.len() == slopes.len() && pivots.of.iter().zip(rows).all(|(pivot, row)| !row[*pivot].contains(0.0));
        // NaN is not to be chosen.
        let only = |is_one: bool, size: f64| if is_one { size } else { f64::NAN };
        let chosen = match self.row(pivots, rows) {
            // Where the equations do not determine their numbers over the cell: the unknown that changes the residuals most.
            _ if !is_solved => {
                let totals: Vec<f64> = slopes.iter().map(|row| (0..ranges.len()).map(|i| change(row, i)).sum()).collect();
                let smear = |i: usize| slopes.iter().zip(&totals).map(|(row, total)| change(row, i) / total).sum::<f64>();
                self.equations.greatest(ranges, |i| {
                    let smear = smear(i);
                    only(i < self.equations.unknowns() && smear > 0.0, smear)
                })
            }
            Some(row) => self.equations.greatest(ranges, |i| only(!pivots.of.contains(&i), change(row, i))),
            None => self.equations.greatest(ranges, |i| only(i == self.of, 0.0)),
        };
        chosen.or_else(|| self.equations.widest(ranges))
    }

    /// Narrows a cell by the theorem of the mean about a point of it, and returns `false` if nothing in it meets the equations.
    fn narrow(&self, ranges: &mut [Interval], center: &[f64], slopes: &[Vec<Interval>], rows: &[Vec<Interval>], pivots: &Pivots) -> bool {
        let at: Vec<Interval> = center.iter().copied().map(Interval::from).collect();
        let values: Vec<Vec<Interval>> = self.equations.over(&at).of.into_iter().map(|value| vec![value]).collect();
        let combined = pivots.combine(&values);
        for (row, value) in slopes.iter().zip(&values).chain(rows.iter().zip(&combined)) {
            for i in 0..ranges.len() {
                if row[i].contains(0.0) || ranges[i].width() == 0.0 {
                    continue;
                }
                let others = (0..ranges.len()).filter(|j| *j != i).fold(value[0], |sum, j| sum + row[j] * (ranges[j] - at[j]));
                match intersection(ranges[i], at[i] - others / row[i]) {
                    Some(narrower) => ranges[i] = narrower,
                    None => return false,
                }
            }
        }
        true
    }

    /// Considers the unknowns in the middle of a cell with the errors that they have, if each piece of evidence has one: a first point, wherever it is.
    fn consider_unknowns(&mut self, ranges: &[Interval]) {
        let errors: Vec<usize> = (self.equations.unknowns()..ranges.len()).collect();
        let point = self.equations.solve(&middle(ranges), &errors).filter(|_| errors.len() == self.equations.problem.evidence.len());
        self.best = point.filter(|point| self.equations.accepts(point));
    }

    /// Considers what is found from the middle of a cell without derivatives over it.
    fn consider_middle(&mut self, ranges: &[Interval]) {
        let start = middle(ranges);
        let points: Vec<Interval> = start.iter().copied().map(Interval::from).collect();
        let pivots = Pivots::of(&derivatives(self.equations.slopes(&points)), &self.equations.whole, Some(self.of));
        self.consider(&start, &pivots);
    }

    /// Solves the equations for their numbers from a point, takes what is found if it is better than the best, and returns it.
    fn consider(&mut self, start: &[f64], pivots: &Pivots) -> Option<Vec<f64>> {
        let point = self.equations.solve(start, &pivots.of)?;
        if self.value(&point) < self.best_value() && self.equations.accepts(&point) {
            self.best = Some(point.clone());
        }
        Some(point)
    }
}

fn derivatives(rows: Vec<Vec<Dual<Interval>>>) -> Vec<Vec<Interval>> {
    rows.into_iter().map(|row| row.into_iter().map(|dual| dual.derivative).collect()).collect()
}

/// Returns the end to which a function with this slope falls, or the middle if it does not fall to one.
fn toward_least(range: Interval, slope: Interval) -> f64 {
    if slope.lower() >= 0.0 {
        range.lower()
    } else if slope.upper() <= 0.0 {
        range.upper()
    } else {
        middle_of(range)
    }
}

fn intersection(one: Interval, other: Interval) -> Option<Interval> {
    Interval::new(one.lower().max(other.lower()), one.upper().min(other.upper()))
}
