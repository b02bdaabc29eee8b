//! Branch and bound for the least value of an objective over a box.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use super::RefusedPart;
use super::objective::{Attained, Bounded, Objective};
use crate::cells::{LeastFirst, halves, is_divisible, middle, middle_of};
use crate::scalar::interval::Interval;
use crate::scalar::{Field, Ordered};
use crate::sensitivity::dual::Dual;

/// Width, as a share of the range, below which a cell of which physics may refuse a part is not divided.
const SMALLEST: f64 = 1e-10;

/// Widest enclosure of a point that is taken for the rounding of its value, as a share of it or in SI. A wider one is that of a formula near a pole.
const ROUNDING: f64 = 1e-9;

/// Distance of a bound from the best value, as a share of it, from which second derivatives help more than dividing the cell.
const NEAR: f64 = 1e-3;

/// Most free numbers of a cell whose second derivatives are enclosed.
pub(super) const MOST_BENT: usize = 3;

/// Cells between two questions whether the search goes on.
const STRIDE: usize = 256;

/// The result of a search.
pub(super) struct Minimum {
    /// No value is below it.
    pub(super) bound: f64,
    /// The least value found.
    pub(super) attained: Attained,
    pub(super) is_tight: bool,
    pub(super) cells: usize,
}

struct Cell {
    ranges: Vec<Interval>,
    /// Whether physics refuses no part of it.
    is_possible: bool,
    /// The number to divide, or `None` if the cell is too small.
    divide: Option<usize>,
}

/// Returns half of the width of a range; the width itself may overflow.
fn half_width(range: Interval) -> f64 {
    0.5 * range.upper() - 0.5 * range.lower()
}

/// Returns the widest number of a cell beside the whole box, that can be divided.
fn widest(ranges: &[Interval], whole: &[Interval]) -> Option<(usize, f64)> {
    let share = |i: usize| half_width(ranges[i]) / half_width(whole[i]);
    let divisible = (0..ranges.len()).filter(|&i| is_divisible(ranges[i]));
    divisible.map(|i| (i, share(i))).max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Finds out which part of a box physics refuses, and a point that it accepts, within a number of cells.
pub(super) fn refused_part<F: Bounded>(of: &Objective<'_, F>, whole: &[Interval], cells: usize) -> (RefusedPart, Option<Vec<f64>>) {
    let mut open = alloc::vec![whole.to_vec()];
    let mut accepted = None;
    let (mut any_refused, mut all_refused, mut spent) = (false, true, 0);
    while let Some(cell) = open.pop() {
        let truth = of.is_possible(&cell);
        any_refused |= truth.is_excluded();
        all_refused &= truth.is_excluded();
        if truth.is_excluded() {
            continue;
        }
        let point = middle(&cell);
        match of.at(&point) {
            Some(_) if accepted.is_none() => accepted = Some(point),
            Some(_) => (),
            None => any_refused = true,
        }
        if truth.is_certain() {
            continue;
        }
        let by = widest(&cell, whole).filter(|_| spent < cells && !(any_refused && accepted.is_some()));
        let Some((by, _)) = by else { return (RefusedPart::Some, accepted) };
        spent += 1;
        open.extend(halves(&cell, by));
    }
    let part = match (all_refused, any_refused) {
        (true, _) => RefusedPart::All,
        (false, true) => RefusedPart::Some,
        (false, false) => RefusedPart::None,
    };
    (part, accepted)
}

/// Finds the least value over a box, from a point that physics accepts, to within a distance.
pub(super) fn minimum<F: Bounded>(
    of: &Objective<'_, F>,
    whole: &[Interval],
    start: Attained,
    is_possible: bool,
    within: f64,
    budget: usize,
    goes_on: &dyn Fn(u64) -> bool,
) -> Minimum {
    let mut search = Minimization { of, whole, rounding: 0.0, best: start, open: BinaryHeap::new() };
    search.measure_rounding();
    search.enter(whole.to_vec(), is_possible);
    let mut cells = 0;
    let is_tight = loop {
        let Some(first) = search.open.peek() else { break true };
        // The bound of the first cell is the least of all.
        if search.best.value - first.bound <= within + search.rounding {
            break true;
        }
        let Some(by) = first.cell.divide else { break false };
        if cells == budget || (cells % STRIDE == STRIDE - 1 && !goes_on(cells as u64)) {
            break false;
        }
        let Some(LeastFirst { cell, .. }) = search.open.pop() else { break true };
        cells += 1;
        for half in halves(&cell.ranges, by) {
            search.enter(half, cell.is_possible);
        }
    };
    // Cells that are no longer open have no value below the best one.
    let bound = search.open.peek().map_or(search.best.value, |first| first.bound.min(search.best.value));
    let is_tight = is_tight && within >= 0.0;
    Minimum { bound, attained: search.best, is_tight, cells }
}

struct Minimization<'a, 'b, F> {
    of: &'a Objective<'b, F>,
    whole: &'a [Interval],
    /// The width of the enclosure at the best point, if it is no more than rounding.
    rounding: f64,
    best: Attained,
    open: BinaryHeap<LeastFirst<Cell>>,
}

impl<F: Bounded> Minimization<'_, '_, F> {
    fn measure_rounding(&mut self) {
        let point: Vec<Interval> = self.best.point.iter().copied().map(Interval::from).collect();
        let width = self.of.value_over(&point).width();
        self.rounding = if width <= ROUNDING * self.best.value.abs().max(1.0) { width } else { 0.0 };
    }

    /// Takes a point if physics accepts it and it is better than the best one.
    fn consider(&mut self, point: Vec<f64>) {
        if let Some(value) = self.of.at(&point)
            && value < self.best.value
        {
            self.best = Attained { point, value };
            self.of.improve(&mut self.best, self.whole);
            self.measure_rounding();
        }
    }

    /// Bounds a cell and adds it to the open ones, unless it has no accepted point or none better than the best one.
    fn enter(&mut self, mut ranges: Vec<Interval>, mut is_possible: bool) {
        loop {
            let over = self.of.over(&ranges);
            if over.is_possible.is_excluded() {
                return;
            }
            is_possible |= over.is_possible.is_certain();
            let mut bound = over.value.lower();
            let mut slopes = alloc::vec![Interval::default(); ranges.len()];
            let mut has_slopes = over.is_continuous;
            let mut numbers: Vec<Dual<Interval>> = ranges.iter().copied().map(Dual::constant).collect();
            for i in 0..ranges.len() {
                if has_slopes && ranges[i].width() > 0.0 {
                    let slope = self.of.slope_over(&mut numbers, i);
                    bound = bound.max(slope.value.lower());
                    slopes[i] = slope.derivative;
                    has_slopes &= slope.derivative.finite().is_certain();
                }
            }
            let mut divide = widest(&ranges, self.whole);
            if !is_possible && divide.is_some_and(|(_, share)| share < SMALLEST) {
                divide = None;
            }
            let mut point = middle(&ranges);
            if has_slopes {
                // The center at which the theorem of the mean has the greatest bound.
                for (x, (range, slope)) in point.iter_mut().zip(ranges.iter().zip(&slopes)) {
                    *x = best_center(*range, *slope);
                }
                let center: Vec<Interval> = point.iter().copied().map(Interval::from).collect();
                let at_center = self.of.value_over(&center);
                let sum = (0..ranges.len()).fold(at_center, |sum, i| sum + slopes[i] * (ranges[i] - center[i]));
                bound = bound.max(sum.lower());
                let is_near = self.best.value - bound <= NEAR * self.best.value.abs();
                if bound < self.best.value && is_near && !is_held_next(&ranges, &slopes, is_possible) {
                    bound = bound.max(self.second_order(&ranges, &center, at_center));
                }
                let effect = |i: usize| half_width(ranges[i]) * slopes[i].magnitude().upper();
                let most = (0..ranges.len()).filter(|&i| is_divisible(ranges[i])).max_by(|&i, &j| effect(i).total_cmp(&effect(j)));
                divide = divide.and(most.map(|i| (i, effect(i))));
            }
            if bound >= self.best.value {
                return;
            }
            self.consider(point);
            if has_slopes && is_possible && hold_monotone(&mut ranges, &slopes) {
                continue;
            }
            self.open.push(LeastFirst { bound, cell: Cell { ranges, is_possible, divide: divide.map(|(i, _)| i) } });
            return;
        }
    }
}

impl<F: Bounded> Minimization<'_, '_, F> {
    /// Returns the lower bound of Taylor's theorem to second order over a cell of few free numbers, else −∞. Where the objective hardly depends on one of them,
    /// as ΔV on Γ at e = 0, it is too low by the cube of the width and not by its square.
    fn second_order(&self, ranges: &[Interval], center: &[Interval], at_center: Interval) -> f64 {
        let free: Vec<usize> = (0..ranges.len()).filter(|&i| ranges[i].width() > 0.0).collect();
        if free.len() > MOST_BENT {
            return f64::NEG_INFINITY;
        }
        let off = |i: usize| ranges[i] - center[i];
        let mut at: Vec<Dual<Interval>> = center.iter().copied().map(Dual::constant).collect();
        let mut sum = at_center;
        for (place, &i) in free.iter().enumerate() {
            sum = sum + self.of.slope_over(&mut at, i).derivative * off(i);
            sum = sum + self.of.bend_over(ranges, [i, i]).half() * off(i).magnitude().squared();
            for &j in &free[..place] {
                sum = sum + self.of.bend_over(ranges, [i, j]) * off(i) * off(j);
            }
        }
        if sum.finite().is_certain() { sum.lower() } else { f64::NEG_INFINITY }
    }
}

/// Returns the center about which the mean value theorem has the greatest lower bound (Baumann): the end to which the function falls where it is monotone.
fn best_center(range: Interval, slope: Interval) -> f64 {
    if slope.lower() >= 0.0 {
        range.lower()
    } else if slope.upper() <= 0.0 {
        range.upper()
    } else {
        let share = slope.upper() / (slope.upper() - slope.lower());
        let center = share * range.lower() + (1.0 - share) * range.upper();
        if center.is_nan() { middle_of(range) } else { center.clamp(range.lower(), range.upper()) }
    }
}

fn is_monotone(range: &Interval, slope: &Interval) -> bool {
    range.width() > 0.0 && (slope.lower() >= 0.0 || slope.upper() <= 0.0)
}

/// Returns `true` if [`hold_monotone`] comes next, which is better than any bound of the cell.
fn is_held_next(ranges: &[Interval], slopes: &[Interval], is_possible: bool) -> bool {
    is_possible && ranges.iter().zip(slopes).any(|(range, slope)| is_monotone(range, slope))
}

/// Holds each number in which the objective is monotone at the end where it is least, and returns `true` if there is one.
fn hold_monotone(ranges: &mut [Interval], slopes: &[Interval]) -> bool {
    let mut holds = false;
    for (range, slope) in ranges.iter_mut().zip(slopes) {
        if is_monotone(range, slope) {
            *range = Interval::from(best_center(*range, *slope));
            holds = true;
        }
    }
    holds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Real;
    use crate::scalar::interval::Truth;

    /// 2 x³ − 3 x y + y³ + x y z − z² with a corner, where x is 1/3, if it has one.
    struct Cubic {
        corner: f64,
    }

    impl Bounded for Cubic {
        fn numbers(&self) -> usize {
            3
        }

        fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
            let [x, y, z] = [numbers[0], numbers[1], numbers[2]];
            let beyond = x - T::int(1) / T::int(3);
            let corner = beyond.larger(T::int(0)) * T::from(self.corner);
            T::int(2) * x * x * x - T::int(3) * x * y + y * y * y + x * y * z - z * z + corner
        }

        fn at(&self, point: &[f64]) -> Option<f64> {
            Some(self.value(point))
        }

        fn is_possible(&self, _: &[Interval]) -> Truth {
            Truth::TRUE
        }

        fn is_continuous(&self, _: &[Interval], _: Interval) -> bool {
            true
        }
    }

    /// x, which physics refuses below 1/3; about it a cell is not decided.
    struct FromAThird;

    impl Bounded for FromAThird {
        fn numbers(&self) -> usize {
            1
        }

        fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
            numbers[0]
        }

        fn at(&self, point: &[f64]) -> Option<f64> {
            (point[0] >= 1.0 / 3.0).then_some(point[0])
        }

        fn is_possible(&self, cell: &[Interval]) -> Truth {
            !cell[0].less(&Interval::from(1.0 / 3.0))
        }

        fn is_continuous(&self, _: &[Interval], _: Interval) -> bool {
            true
        }
    }

    /// 2⁻³⁴ is the first power of a half below 10⁻¹⁰.
    #[test]
    fn a_cell_that_physics_may_refuse_is_not_divided_for_ever() {
        let whole = [Interval::new(0.0, 1.0).expect("in order")];
        let start = Attained { point: alloc::vec![1.0], value: 1.0 };
        let found = minimum(&Objective::new(&FromAThird), &whole, start, false, -1.0, 1_000, &|_| true);
        assert_eq!((found.is_tight, found.cells), (false, 34));
        assert!(found.bound <= 1.0 / 3.0 && found.attained.value - 1.0 / 3.0 < 2.0 * SMALLEST, "{} {}", found.bound, found.attained.value);
    }

    fn second_order(of: &Cubic, cell: [(f64, f64); 3]) -> f64 {
        let ranges = cell.map(|(low, high)| Interval::new(low, high).expect("in order"));
        let center = ranges.map(|range| Interval::from(middle_of(range)));
        let objective = Objective::new(of);
        let best = Attained { point: Vec::new(), value: f64::INFINITY };
        let search = Minimization { of: &objective, whole: &ranges, rounding: 0.0, best, open: BinaryHeap::new() };
        search.second_order(&ranges, &center, of.value(&center))
    }

    #[test]
    fn the_second_order_is_below_every_value_and_near_the_least() {
        let of = Cubic { corner: 0.0 };
        for width in [0.5, 0.1, 0.01] {
            for place in 0..200 {
                let at = |share: f64| -2.0 + (f64::from(place) * share).fract() * 4.0;
                let from = [at(0.618_034), at(0.754_878), at(0.569_84)];
                for free in [[1, 0, 0], [0, 0, 1], [1, 1, 0], [1, 1, 1]] {
                    let cell: [(f64, f64); 3] = core::array::from_fn(|i| (from[i], from[i] + width * f64::from(free[i])));
                    let bound = second_order(&of, cell);
                    let grid = |(low, high): (f64, f64)| (0..=8).map(move |step| low + (high - low) * f64::from(step) / 8.0);
                    let points = grid(cell[0]).flat_map(|x| grid(cell[1]).flat_map(move |y| grid(cell[2]).map(move |z| [x, y, z])));
                    let least = points.map(|point| of.value(&point)).fold(f64::INFINITY, f64::min);
                    assert!(bound <= least, "{cell:?}: {bound}, {least}");
                    // What the second derivatives of the quadratic part leave: about their half, times the square of the width.
                    assert!(least - bound <= 40.0 * width * width, "{cell:?}: {bound}, {least}");
                }
            }
        }
    }

    #[test]
    fn across_a_corner_there_is_no_second_order() {
        let beside = second_order(&Cubic { corner: -50.0 }, [(0.0, 0.3), (1.0, 1.0), (0.0, 0.0)]);
        let across = second_order(&Cubic { corner: -50.0 }, [(0.0, 0.5), (1.0, 1.0), (0.0, 0.0)]);
        assert!(beside > -10.0 && across == f64::NEG_INFINITY, "{beside}, {across}");
        assert_eq!(second_order(&Cubic { corner: 0.0 }, [(0.0, f64::MAX), (1.0, 1.0), (0.0, 0.0)]), f64::NEG_INFINITY);
    }
}
