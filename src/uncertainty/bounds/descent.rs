//! Local improvement of an accepted point, in f64. Nothing proven depends on it.

use alloc::vec::Vec;

use super::objective::{Attained, Bounded, Objective};
use crate::cells::middle;
use crate::scalar::interval::Interval;

/// Rounds of one step for each number.
const ROUNDS: usize = 40;

/// Halvings of a step that does not improve the value, and of one that physics refuses: the edge of what it accepts may be anywhere.
const HALVINGS: usize = 6;
const HALVINGS_TO_EDGE: usize = 40;

/// Most numbers of which every corner of the box is tried.
const CORNERS: usize = 6;

impl<F: Bounded> Objective<'_, F> {
    /// Returns an accepted point of a box: its middle, a corner, or the first of points that fill the box evenly.
    pub(super) fn accepted_in(&self, whole: &[Interval], points: usize) -> Option<Vec<f64>> {
        // Additive recurrence by the powers of the root of x^(n+1) = x + 1 (Roberts 2018).
        let dimension = whole.len() as f64 + 1.0;
        let root =
            (0..60).fold(1.5, |x: f64, _| x - (libm::pow(x, dimension) - x - 1.0) / (dimension * libm::pow(x, dimension - 1.0) - 1.0));
        let spread = |number: usize| {
            let place = |(i, range): (usize, &Interval)| {
                let share = (0.5 + number as f64 / libm::pow(root, i as f64 + 1.0)) % 1.0;
                ((1.0 - share) * range.lower() + share * range.upper()).clamp(range.lower(), range.upper())
            };
            whole.iter().enumerate().map(place).collect::<Vec<f64>>()
        };
        core::iter::once(middle(whole))
            .chain(corners(whole))
            .chain((0..points.min(10_000)).map(spread))
            .find(|point| self.at(point).is_some())
    }

    /// Returns the best point that is found from an accepted one and from the corners.
    pub(super) fn descend(&self, start: &[f64], whole: &[Interval]) -> Attained {
        let mut best = Attained { point: start.to_vec(), value: self.at(start).unwrap_or(f64::INFINITY) };
        let mut at_middle = best.clone();
        self.improve(&mut at_middle, whole);
        for point in corners(whole) {
            if let Some(value) = self.at(&point)
                && value < best.value
            {
                best = Attained { point, value };
            }
        }
        self.improve(&mut best, whole);
        if at_middle.value < best.value { at_middle } else { best }
    }

    /// Moves one number after the other: by a step of Newton's method where the objective is convex, else to the end of the range that it falls to.
    pub(super) fn improve(&self, best: &mut Attained, whole: &[Interval]) {
        for _ in 0..ROUNDS {
            let before = best.value;
            for (i, range) in whole.iter().enumerate().filter(|(_, range)| range.width() > 0.0) {
                let [_, slope, bend] = self.curve(&best.point, i);
                let here = best.point[i];
                let end = if slope > 0.0 { range.lower() } else { range.upper() };
                let aim = if bend > 0.0 { (here - slope / bend).clamp(range.lower(), range.upper()) } else { end };
                if slope.is_nan() || aim == here || aim.is_nan() {
                    continue;
                }
                self.step(best, i, aim);
            }
            let is_settled = best.value >= before - 1e-15 * before.abs();
            if is_settled {
                break;
            }
        }
    }

    /// Moves one number towards a place, and half as far until that is accepted and better.
    fn step(&self, best: &mut Attained, i: usize, aim: f64) {
        let here = best.point[i];
        let mut to = aim;
        let (mut worse, mut refused) = (0, 0);
        while to != here && worse < HALVINGS && refused < HALVINGS_TO_EDGE {
            best.point[i] = to;
            match self.at(&best.point) {
                Some(value) if value < best.value => {
                    best.value = value;
                    return;
                }
                Some(_) => worse += 1,
                None => refused += 1,
            }
            to = 0.5 * here + 0.5 * to;
        }
        best.point[i] = here;
    }
}

/// Returns the corners of a box of few numbers.
fn corners(whole: &[Interval]) -> impl Iterator<Item = Vec<f64>> + '_ {
    let free = whole.iter().filter(|range| range.width() > 0.0).count();
    let count = if free <= CORNERS { 1_u32 << free } else { 0 };
    (0..count).map(move |corner| {
        let mut bit = 0;
        let end = |range: &Interval| {
            if range.width() > 0.0 {
                bit += 1;
                if corner >> (bit - 1) & 1 == 1 {
                    return range.upper();
                }
            }
            range.lower()
        };
        whole.iter().map(end).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Real;
    use crate::scalar::interval::Truth;

    /// (x − 0.3)² + (y + 0.2)², accepted where x and y are each in a range.
    struct Bowl([[f64; 2]; 2]);

    impl Bounded for Bowl {
        fn numbers(&self) -> usize {
            2
        }

        fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
            (numbers[0] - T::from(0.3)).squared() + (numbers[1] + T::from(0.2)).squared()
        }

        fn at(&self, point: &[f64]) -> Option<f64> {
            let is_accepted = point.iter().zip(self.0).all(|(x, [low, high])| (low..=high).contains(x));
            is_accepted.then(|| self.value(point))
        }

        fn is_possible(&self, _: &[Interval]) -> Truth {
            Truth::UNKNOWN
        }

        fn is_continuous(&self, _: &[Interval], _: Interval) -> bool {
            true
        }
    }

    fn range(low: f64, high: f64) -> Interval {
        Interval::new(low, high).expect("in order")
    }

    #[test]
    fn a_convex_function_is_improved_to_its_least_value_or_to_the_edge() {
        let whole = [range(-1.0, 1.0), range(-1.0, 1.0)];
        for (accepted, wanted) in [([[-1.0, 1.0], [-1.0, 1.0]], [0.3, -0.2]), ([[0.5, 1.0], [-1.0, 1.0]], [0.5, -0.2])] {
            let bowl = Bowl(accepted);
            let objective = Objective::new(&bowl);
            let mut best = Attained { point: vec![1.0, 1.0], value: objective.at(&[1.0, 1.0]).expect("accepted") };
            objective.improve(&mut best, &whole);
            assert!(best.point.iter().zip(wanted).all(|(x, wanted)| (x - wanted).abs() < 1e-6), "{best:?}");
            assert_eq!(Some(best.value), objective.at(&best.point));
        }
    }

    /// Each of 64 parts of a box, of which neither the middle nor a corner need be accepted, has one of its first 400 points.
    #[test]
    fn the_points_of_a_box_fill_it() {
        let whole = [range(0.0, 1.0), range(2.0, 4.0)];
        for part in 0..64 {
            let (x, y) = (f64::from(part % 8) / 8.0, 2.0 + f64::from(part / 8) / 4.0);
            let bowl = Bowl([[x, x + 0.125], [y, y + 0.25]]);
            assert!(Objective::new(&bowl).accepted_in(&whole, 400).is_some(), "{x} {y}");
        }
    }
}
