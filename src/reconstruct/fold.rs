//! Directions that the evidence constrains without a slope: at a fold it has an extremum, and only its curvature limits the unknowns.

use super::determined::is_moved;
use super::measurand::Measurand;
use super::piece::Piece;
use super::residuals::Model;
use super::search::INDISTINCT;
use super::within_limits::{Fixed, WithinLimits};
use crate::least_squares::limited::{self, Until};
use crate::least_squares::{Bound, Minimum, ParameterBounds};

/// A standard deviation, in scales, from which χ² would not rise noticeably over the distances that are looked at.
const NO_RISE: f64 = 100.0;

/// Returns `true` if a direction in which the evidence has no slope leads away from a minimum to fits that are as good.
pub(super) fn is_open(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], direction: &[f64]) -> bool {
    (0..direction.len()).any(|i| is_moved(direction[i], direction) && !bends(model, minimum, spans, i))
}

/// Returns `true` if a standard deviation from slopes is so large that it contradicts χ²: the minimum is a fold but for rounding.
pub(super) fn contradicts(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], i: usize, sd: f64) -> bool {
    sd > NO_RISE * spans[i].scale && bends(model, minimum, spans, i)
}

/// Returns `true` if χ² rises on both sides of a minimum when an unknown is moved, unless a bound holds it there.
fn bends(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], i: usize) -> bool {
    let sides = [(Bound::Min, -1.0), (Bound::Max, 1.0)];
    sides.into_iter().all(|(bound, side)| minimum.at[i] == Some(bound) || rises(model, minimum, spans, i, side) == Some(true))
}

/// Returns whether the best fit of everything else becomes worse while an unknown is moved to one side. `None` if a bound, a limit of the physics or the edge of a
/// piece of the mechanics comes first.
fn rises(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], i: usize, side: f64) -> Option<bool> {
    /// Distances of the unknown from the minimum, in scales.
    const DISTANCES: [f64; 4] = [1.0 / 16.0, 0.25, 1.0, 4.0];
    const ITERATIONS: usize = 40;
    let (placed, impact) = model.solve(&minimum.unknowns).ok()?;
    let mut problem = WithinLimits::around(model, &minimum.unknowns, &placed, &impact);
    problem.keep_to(Piece::of(&placed));
    let of = Measurand::Variable(model.question.unknowns[i].of);
    let mut at = minimum.unknowns.clone();
    for distance in DISTANCES {
        let value = minimum.unknowns[i] + side * distance * spans[i].scale;
        if !(spans[i].min..=spans[i].max).contains(&value) {
            return None;
        }
        problem.hold(Some(Fixed { of, value, scale: spans[i].scale, period: None }));
        let reached = limited::minimum(&problem, &at, spans, limited::LONG, ITERATIONS, Until::Sum).ok()?;
        if reached.sum_of_squares > minimum.sum_of_squares + INDISTINCT {
            return Some(true);
        }
        at = reached.unknowns;
    }
    Some(false)
}
