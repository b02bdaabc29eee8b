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
