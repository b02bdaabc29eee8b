//! Motions of the vehicles after the impact.

use super::{Figure, Finding, Limit, Meaning, Question};
use crate::input::Side;
use crate::output::Output;
use crate::reconstruct::{Measurand, Solution};

const LEVER: &str = "angular momentum: the moment of the impulse about the center of mass is the change of yaw";

/// Checks that each vehicle rotates in the direction of the moment of the force.
pub(super) fn rotation(solution: &Solution) -> Vec<Finding> {
    let found: Vec<Finding> = [Side::One, Side::Two].into_iter().filter_map(|side| of_vehicle(solution, side)).collect();
    if !found.is_empty() {
        return found;
    }
    let why = "not checked: no separation yaw rate is in the evidence; look whether the vehicles turned the way the reconstruction has it";
    vec![Finding::not_checked(Question::Rotation, Limit::SameSign, LEVER, why)]
}

fn of_vehicle(solution: &Solution, side: Side) -> Option<Finding> {
    let observed = solution.evidence.iter().find(|evidence| evidence.of == Measurand::Output(Output::YawRate(side)))?;
    let (party, response) = match side {
        Side::One => (&solution.collision.one, &solution.impact.one),
        Side::Two => (&solution.collision.two, &solution.impact.two),
    };
    let before = party.vehicle()?.motion.yaw_rate;
    let (seen, computed) = (observed.given - before, response.after.yaw_rate - before);
    // A rotation that is small compared with its uncertainty has no direction.
    let is_seen = observed.sd.is_none_or(|sd| seen.abs() > 2.0 * sd);
    let number = side as usize + 1;
    let turns = |rate: f64| if rate >= 0.0 { "counter-clockwise" } else { "clockwise" };
    let meaning = if is_seen {
        Meaning::of(format!("the impulse turns vehicle {number} {}, by ", turns(computed)))
            .figure(Figure::YawRate(computed.abs()))
            .words(format!("; the evidence has it turn {}, by ", turns(seen)))
            .figure(Figure::YawRate(seen.abs()))
            .words(
                ". Where the two are of opposite sign, the impact center is on the wrong side of the line of force, or the force points elsewhere",
            )
    } else {
        Meaning::of(format!("vehicle {number} hardly turned: the evidence of it is within two standard deviations of none"))
    };
    let agreement = if is_seen { seen.signum() * computed.signum() } else { 0.0 };
    Some(Finding::new(Question::Rotation, Figure::Number(agreement), Limit::SameSign, LEVER, meaning))
}

/// Checks that the vehicles reach a common velocity at the contact.
pub(super) fn common_velocity(solution: &Solution) -> Finding {
    let limit = Limit::AtMost(Figure::Share(0.1));
    let source = "EDCRASH's run-time diagnostics: 10 %";
    let impact = &solution.impact;
    let share = impact.separation.length() / impact.approach.length();
    let meaning = Meaning::of("of the relative velocity at the impact center ")
        .figure(Figure::Speed(impact.separation.n.abs()))
        .words(" is left along the normal and ")
        .figure(Figure::Speed(impact.separation.t.abs()))
        .words(" along the crush plane; methods that assume a common velocity, as CRASH3 does, hold as far as nothing is left");
    Finding::new(Question::CommonVelocity, Figure::Share(share), limit, source, meaning)
}
