//! Comparison of the two coefficients of the impact with published values.

use super::{Figure, Finding, Limit, Meaning, Question};
use crate::input::Input;
use crate::least_squares::Bound;
use crate::reconstruct::{ReconstructionProblem, Solution, Variable};

/// The closing speed along the normal, in m/s, up to which bumpers spring back. A velocity change of up to 5 mph of the struck vehicle, of the same mass,
/// corresponds to a closing speed 2 ΔV/(1 + e) of up to 3.4 m/s at e = 0.3.
const LOW_SPEED: f64 = 3.5;

/// Checks that the restitution is consistent with tests at this closing speed.
pub(super) fn restitution(solution: &Solution) -> Finding {
    let closing = solution.impact.approach.n.abs();
    let e = solution.collision.restitution;
    let (least, most, source) = if closing <= LOW_SPEED {
        (
            0.2,
            0.4,
            "SAE 931842: 0.2 to 0.4 in rear impacts with velocity changes of 2 to 5 mph, here taken for closing speeds up to 3.5 m/s",
        )
    } else {
        (0.0, 0.3, "the paper, on choosing e: 0 to 0.3 in most collisions of light vehicles, most of them low")
    };
    let meaning = Meaning::of("at a normal closing speed of ")
        .figure(Figure::Speed(closing))
        .words(format!(" tests show {least} to {most}; the more is crushed, the less springs back, save at an axle or another hard point"));
    Finding::new(Question::Restitution, Figure::Number(e), Limit::Between(Figure::Number(least), Figure::Number(most)), source, meaning)
}

/// Checks the paper's guideline: a restitution that the fit drives to its upper bound indicates another problem.
pub(super) fn restitution_bound(solution: &Solution, question: &ReconstructionProblem) -> Finding {
    let source = "the paper, on choosing e: a value at the upper extreme without a reason";
    let unknown = Variable::Input(Input::Restitution);
    let upper = question.unknowns.iter().find(|other| other.of == unknown).map(|other| other.max.unwrap_or(1.0));
    let (Some(upper), Some(estimate)) = (upper, solution.estimate(unknown)) else {
        let limit = Limit::AtMost(Figure::Number(1.0));
        return Finding::not_checked(Question::RestitutionBound, limit, source, "not checked: the restitution is given");
    };
    let is_at_top = estimate.at == Some(Bound::Max);
    let meaning = if is_at_top {
        format!(
            "e is at its upper bound of {upper}. Unless there is a reason for it, as an impact at an axle, re-examine the geometry: the impact center, the crush plane, the \
             headings"
        )
    } else {
        format!("e is below its upper bound of {upper}")
    };
    // A value on the bound is beyond the assumption of the guideline.
    let limit = Limit::AtMost(Figure::Number(if is_at_top { upper - super::ON_BOUND } else { upper }));
    Finding::new(Question::RestitutionBound, Figure::Number(estimate.value), limit, source, Meaning::of(meaning))
}

/// Checks that the impulse ratio is the critical one: that at which sliding ends by the law in force.
pub(super) fn impulse_ratio(solution: &Solution) -> Finding {
    let limit = Limit::Between(Figure::Share(0.9), Figure::Share(1.0));
    let source = "the paper, on choosing mu: sliding ends in most collisions of light vehicles, mu = mu0; within 10 %";
    let sticking = solution.collision.sticking_impulse(&solution.collision.contact());
    let critical = sticking.t / sticking.n;
    let ratio = solution.impact.impulse_ratio();
    if critical.abs() < 1e-9 {
        let why = "not checked: the critical ratio is zero, so there is nothing tangential to compare";
        return Finding::not_checked(Question::ImpulseRatio, limit, source, why);
    }
    let share = ratio / critical;
    let said = if limit.admits(Figure::Share(share)) || (1.0..=1.0 + 1e-9).contains(&share) {
        "sliding has ended, or nearly, as in most collisions"
    } else if (0.0..1.0).contains(&share) {
        "the vehicles slide past each other to the end. That is a sideswipe; the traces of it should be there"
    } else if share > 1.0 {
        "more than ends the sliding. Something snagged, or the crush plane is another"
    } else {
        "it works against the end of the sliding. Something snagged, or the crush plane is another"
    };
    let meaning = Meaning::of("mu is ")
        .figure(Figure::Number(ratio))
        .words(", the critical ratio ")
        .figure(Figure::Number(critical))
        .words(format!(": {said}"));
    Finding::new(Question::ImpulseRatio, Figure::Share(share), limit, source, meaning)
}
