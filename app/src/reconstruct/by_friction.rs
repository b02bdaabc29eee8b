//! Errors of separations by the friction of the road, which is common to both vehicles and grows with the motion.

use planar_impact::post_impact::Separation;
use planar_impact::reconstruct::{GrowingError, Measurand, ReconstructionProblem, Solution, Variable};
use planar_impact::{Motion, Side, Xy};

use super::from_rest::{Separations, are_near, outputs};
use super::question::Question;
use crate::notice::Notice;

/// Standard deviations by which errors differ that are alike.
const ALIKE: f64 = 0.01;

/// Returns how many times as far from the given motion that is with which an error by the friction grows: a way on locked wheels, which is compared as a way, grows as the square of
/// its motion, which is twice as much to first order.
fn times_of_way(asked: &ReconstructionProblem, side: Side) -> f64 {
    if asked.separation_from_rest[side as usize] { 2.0 } else { 1.0 }
}

/// Returns the motions that the errors by the friction grow with: those of the fit.
pub fn motions_by_friction(asked: &ReconstructionProblem, best: &Solution, separations: &Separations) -> [Motion; 2] {
    let motion = |side: Side| {
        let given = separations[side as usize].as_ref()?.motion.components();
        let times = times_of_way(asked, side);
        let off = outputs(side).map(|of| best.evidence.iter().find(|fitted| fitted.of == of).map_or(0.0, |fitted| fitted.residual));
        let [x, y, yaw_rate] = std::array::from_fn(|i| given[i] - times * off[i]);
        Some(Motion { velocity: Xy { x, y }, yaw_rate })
    };
    Side::ALL.map(|side| motion(side).unwrap_or(Motion::rest()))
}

/// Returns the errors by the friction as they grow with the motion, of separations and of the same with the errors that the evidence has. Empty where skid speeds depend on the
/// same friction: those are first-order parts of priors.
pub fn growing_errors(asked: &ReconstructionProblem, about: &Separations, weighed: &Separations, gyrations: [f64; 2]) -> Vec<GrowingError> {
    let of_side = |side: Side| {
        let place = side as usize;
        let (about, weighed) = (about[place].as_ref()?, weighed[place].as_ref()?);
        let (share, times) = (about.share_by_friction(gyrations[place]), times_of_way(asked, side));
        // Speeds grow with the root of the friction.
        let (slope, relative_sd, power) = (times * share, 2.0 * share, -0.5 * times);
        let parts = about.by_friction.components().into_iter().zip(weighed.by_friction.components());
        let error = move |(of, (at_given, at_fit))| GrowingError { of, at_fit, at_given, slope, relative_sd, power };
        let is_in_question = |error: &GrowingError| asked.evidence.iter().any(|evidence| evidence.of == error.of);
        (relative_sd > 0.0).then(|| outputs(side).into_iter().zip(parts).map(error).filter(is_in_question))
    };
    if shares_friction_with_skids(asked) {
        return Vec::new();
    }
    Side::ALL.into_iter().filter_map(of_side).flatten().collect()
}

/// Returns `true` if skid speeds depend on the friction of the separations.
fn shares_friction_with_skids(asked: &ReconstructionProblem) -> bool {
    let is_skid = |of: Measurand| matches!(of, Measurand::Variable(Variable::SkidSpeed(_)));
    asked.correlations.iter().any(|pair| is_skid(pair.one) || is_skid(pair.other))
}

/// Returns the separations with the errors by the friction of motions.
pub fn with_friction_at(separations: &Separations, motions: &[Motion; 2], gyrations: [f64; 2]) -> Separations {
    let weighed = |side: Side| {
        let place = side as usize;
        separations[place].as_ref().map(|separation| separation.with_friction_at(&motions[place], gyrations[place]))
    };
    Side::ALL.map(weighed)
}

/// Returns `true` if separations, and their errors by the friction, are alike.
pub fn are_alike(one: Option<&Separation>, other: Option<&Separation>) -> bool {
    one.zip(other).is_none_or(|(one, other)| {
        let sds = one.covariance.deviations();
        [[one.motion, other.motion], [one.by_friction, other.by_friction]].into_iter().all(|pair| are_near(pair, sds, ALIKE))
    })
}

/// Returns a warning of a posterior by a friction that is far from exact and that skid speeds depend on too: the errors that it causes grow with the motion, and draws have those of
/// the fitted one.
pub fn of_posterior(question: &Question, separations: &Separations) -> Option<Notice> {
    /// Share of a separation speed, by the friction alone. Of 0.65 ± 0.05, which is just below it, the median lies 0.15 standard deviations below that of an exact friction.
    const STRAIGHT: f64 = 0.04;
    let is_wide = |separation: &&Separation| separation.by_friction.velocity.length() > STRAIGHT * separation.motion.velocity.length();
    let is_doubtful = question.asked.growing_error.is_empty() && separations.iter().flatten().any(|separation| is_wide(&separation));
    is_doubtful.then(|| {
        let message = "the draws of the posterior have the errors by the friction that the fitted motion has, and those of a faster one are larger: speeds are drawn too low, \
                       and the intervals hold; give the friction with a smaller uncertainty, or read the intervals";
        Notice::warning("posterior-friction", "rest.friction", message)
    })
}
