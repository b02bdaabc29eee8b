//! Fits in which a vehicle whose direction is evidence stops.
//!
//! Just before it stands still, a vehicle may have any direction: its direction then says nothing, and the fit is best where it stops, whatever the rest of
//! the evidence prefers there. Near such a point steps by slopes end anywhere. The search goes on with the vehicle almost at rest in the given direction.

use super::given::{Evidence, ReconstructionProblem, Uncertainty};
use super::measurand::Measurand;
use super::residuals::Model;
use crate::input::Side;
use crate::least_squares::{self, Minimum, ParameterBounds, Residuals};
use crate::output::Output;

/// Largest speed of separation, in m/s, at which a search has come near a standstill.
const NEAR: f64 = 1e-2;
/// Speed that remains, in m/s, so that there is a direction, and its standard deviation.
const CREEPING: f64 = 1e-7;
const AS_GOOD_AS_EXACT: f64 = 1e-9;

/// Returns the best fit near the result of a search with the vehicle almost at rest whose direction is evidence, if the search came near that and ended no lower.
pub(super) fn best_at_standstill(model: &Model<'_>, unknowns: &[f64], spans: &[ParameterBounds], iterations: usize) -> Option<Minimum> {
    let mut directions = model.evidence.iter().filter_map(|evidence| match evidence.of {
        Measurand::SeparationDirection(side) => Some((side, evidence.value)),
        _ => None,
    });
    let (placed, impact) = model.solve(unknowns).ok()?;
    let stops = |side| Measurand::SeparationSpeed(side).of(&placed, &impact).is_some_and(|speed: f64| speed < NEAR);
    let (side, direction) = directions.find(|(side, _)| stops(*side))?;
    let question = creeping(model.question, side, direction)?;
    let found = least_squares::minimum(&Model::of(&question), unknowns, spans, iterations).ok()?;
    let sum_of_squares = model.at(&found.unknowns)?.iter().map(|residual| residual * residual).sum();
    let before: f64 = model.at(unknowns)?.iter().map(|residual| residual * residual).sum();
    (sum_of_squares <= before).then_some(Minimum { sum_of_squares, ..found })
}

/// Returns the problem with the velocity instead of the direction, or `None` if they are correlated.
fn creeping(question: &ReconstructionProblem, side: Side, direction: f64) -> Option<ReconstructionProblem> {
    let [x, y] = [Output::VelocityX(side), Output::VelocityY(side)].map(Measurand::Output);
    let without = Measurand::SeparationDirection(side);
    let replaced = [x, y, without];
    if question.correlations.iter().any(|correlation| replaced.contains(&correlation.one) || replaced.contains(&correlation.other)) {
        return None;
    }
    let mut question = question.clone();
    question.evidence.retain(|evidence| evidence.of != without);
    let (sin, cos) = libm::sincos(direction);
    let at = |of, value| Evidence { of, value: CREEPING * value, uncertainty: Uncertainty::StandardDeviation(AS_GOOD_AS_EXACT) };
    question.evidence.extend([at(x, cos), at(y, sin)]);
    Some(question)
}
