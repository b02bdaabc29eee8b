//! Why a question has no answer, at its place in the file and in the user's units.

use planar_impact::reconstruct::{Measurable, Problem, Stop, Unsolved, Variable};
use planar_impact::{Input, Refusal, Refusals};

use super::question::{Complaint, Question, measure_in};
use crate::case::{measure_of, vehicle_number};
use crate::exit::Failure;
use crate::units::Units;

/// The question is wrong, or the search for an answer does not end.
pub fn failure(question: &Question, unsolved: &Unsolved, units: Units) -> Failure {
    let case = &question.case;
    match unsolved {
        Unsolved::Problems(problems) => case.unfit(problems.list().iter().map(|problem| wrong(question, problem, units))),
        Unsolved::NoStart { starts, refusals } => {
            let message = format!("the mechanics refuses the collision at each of {starts} starts; the reasons at the first follow");
            let help = "give starts, and bounds, between which the vehicles close".to_owned();
            let reasons = refusals.reasons().iter().map(|refusal| {
                let (key, message, help) = crate::wording::refusal(refusal, units);
                (key.to_owned(), message, help)
            });
            let first = ("unknown".to_owned(), message, Some(help));
            case.refused(std::iter::once(first).chain(reasons))
        }
        Unsolved::NotConverged { searches, converged, nearest } => {
            let message = match converged {
                0 => format!("none of {searches} searches converged"),
                _ => format!("{converged} of {searches} searches converged, none as low as where another had to stop"),
            };
            case.refused([("unknown".to_owned(), message, Some(trace(question, nearest, units)))])
        }
        other => case.refused([("unknown".to_owned(), other.to_string(), None)]),
    }
}

/// Where the nearest search stopped, why, and what may help.
fn trace(question: &Question, nearest: &Stop, units: Units) -> String {
    let at = |(of, value): &(Variable, f64)| format!("{} = {}", of.name(), units.quantity(measure_in(*of, &question.case), *value));
    let values: Vec<String> = nearest.unknowns.iter().map(at).collect();
    let mut trace = format!(
        "the nearest stopped after {} steps at {}, with chi-square {:.4}; it still wanted a step of {:.3e} (in m/s, rad/s and tenths of the rest)",
        nearest.iterations,
        values.join(", "),
        nearest.chi_square,
        nearest.step
    );
    if let Some(refusals) = &nearest.beyond {
        trace.push_str(&format!("; where that leads the mechanics refuses the collision: {}", reasons(refusals, units)));
    }
    trace.push_str(match nearest.beyond.as_ref().and_then(sliding_limit) {
        // No start leads past what no sliding gives.
        Some(Sliding::EndsBefore) => {
            "; the evidence asks for more tangential impulse than ends the sliding: something snagged, or the crush plane is another"
        }
        Some(Sliding::WouldSpeedUp) => {
            "; the evidence asks for a tangential impulse that speeds the sliding up, which friction never does: re-examine the crush plane and the directions"
        }
        None => "; try bounds, another start, or more --starts",
    });
    trace
}

/// How a tangential impulse is one that sliding does not give.
enum Sliding {
    /// It is larger than the one that ends the sliding.
    EndsBefore,
    /// It has the direction of the sliding.
    WouldSpeedUp,
}

fn sliding_limit(refusals: &Refusals) -> Option<Sliding> {
    refusals.reasons().iter().find_map(|refusal| match refusal {
        Refusal::BeyondCritical { ratio, critical: Some(critical) } if ratio * critical > 0.0 => Some(Sliding::EndsBefore),
        Refusal::BeyondCritical { .. } => Some(Sliding::WouldSpeedUp),
        _ => None,
    })
}

fn reasons(refusals: &Refusals, units: Units) -> String {
    let each: Vec<String> = refusals.reasons().iter().map(|refusal| crate::wording::refusal(refusal, units).1).collect();
    each.join("; ")
}

fn wrong(question: &Question, problem: &Problem, units: Units) -> Complaint {
    let places = &question.places;
    let value = |of: Variable, value: f64| units.quantity(measure_in(of, &question.case), value);
    let measured = |of: Measurable, value: f64| units.quantity(measure_of(of), value);
    match problem {
        Problem::NothingUnknown => {
            let help = "say what is to be solved for in [unknown], such as vehicle.1.speed = { start = \"30 mph\" }";
            ("unknown".to_owned(), "nothing is unknown".to_owned(), Some(help.to_owned()))
        }
        Problem::TooLittleEvidence { .. } => {
            let pieces: Vec<&str> = question.asked.evidence.iter().map(|evidence| evidence.of.name()).collect();
            let pieces = if pieces.is_empty() { String::new() } else { format!(": {}", pieces.join(", ")) };
            let help = "add evidence, take an unknown as known, or give it a standard deviation, which counts as evidence";
            ("unknown".to_owned(), format!("{problem}{pieces}"), Some(help.to_owned()))
        }
        Problem::NotInCase(of) => not_in_case(question, *of),
        Problem::NothingToMeasure(of) => {
            let help = of.side().map(|side| format!("vehicle {} is a fixed barrier", vehicle_number(side)));
            (places.of_evidence(*of), "the collision has nothing of the kind".to_owned(), help)
        }
        Problem::UnknownTwice(of) => (places.of_unknown(*of), "it is unknown twice, by two of its names".to_owned(), None),
        Problem::EvidenceTwice(of) => {
            let help = "combine them to one value with one standard deviation";
            (places.of_evidence(*of), format!("there is evidence of {} twice", of.name()), Some(help.to_owned()))
        }
        Problem::SpeedAndVelocity(side) => {
            (places.of_unknown(Variable::Speed(*side)), "a component of the same velocity is unknown too".to_owned(), None)
        }
        Problem::UnknownNotFinite { of, .. } => (places.of_unknown(*of), problem.to_string(), None),
        Problem::EvidenceNotFinite { of, .. } => (places.of_evidence(*of), problem.to_string(), None),
        Problem::NotPositive { of, what, value } => {
            (places.of_evidence(*of), format!("the {what} is {}; it must be above zero", measured(*of, *value)), None)
        }
        Problem::BelowZero { of, value } => {
            (places.of_evidence(*of), format!("it is {}; it cannot be below zero", measured(*of, *value)), None)
        }
        Problem::BoundsCrossed { of, min, max } => {
            (places.of_unknown(*of), format!("min, {}, is not below max, {}", value(*of, *min), value(*of, *max)), None)
        }
        Problem::StartOutside { of, start, min, max } => {
            let range = range(*min, *max, &|x| value(*of, x));
            (places.of_unknown(*of), format!("the start, {}, must be {range}", value(*of, *start)), None)
        }
        Problem::BoundOutside { of, bound, least, most } => {
            let range = range(*least, *most, &|x| value(*of, x));
            (places.of_unknown(*of), format!("a bound is {}; it must be {range}", value(*of, *bound)), None)
        }
        Problem::ShareUnknown(of) => {
            let help = "give crush_energy of both vehicles, or contact.crush_share, the share of vehicle 1, in [evidence] or [unknown]";
            let message = "it is a share of the crush energy, and nothing says how the vehicles share it";
            (places.of_evidence(*of), message.to_owned(), Some(help.to_owned()))
        }
        Problem::NotAShare(_) => (places.of_evidence(Measurable::Variable(Variable::CrushShare)), problem.to_string(), None),
        other => ("evidence".to_owned(), other.to_string(), None),
    }
}

fn not_in_case(question: &Question, of: Variable) -> Complaint {
    let key = question.places.of_unknown(of);
    if let Some(side) = of.side() {
        return (key, format!("vehicle {} is a fixed barrier", vehicle_number(side)), None);
    }
    match of {
        Variable::Input(Input::ImpulseRatio) => {
            let help =
                "leave impulse_ratio out of [contact], or write impulse_ratio = { of_critical = 1 } there to ask for a fraction of it";
            (key, "the contact is at the critical impulse ratio, which follows from the rest".to_owned(), Some(help.to_owned()))
        }
        Variable::CrushShare => (key, "a barrier has no crush to share".to_owned(), None),
        _ => (key, format!("the collision has no {}", of.name()), None),
    }
}

/// Between two values, of which one may be no bound.
fn range(min: f64, max: f64, say: &dyn Fn(f64) -> String) -> String {
    /// The least that mass and inertia can be.
    const NOTHING: f64 = 1e-300;
    match (min.is_finite(), max.is_finite()) {
        (true, true) => format!("from {} to {}", say(min), say(max)),
        (true, false) if min > 0.0 && min < NOTHING => "above zero".to_owned(),
        (true, false) => format!("at least {}", say(min)),
        _ => format!("at most {}", say(max)),
    }
}
