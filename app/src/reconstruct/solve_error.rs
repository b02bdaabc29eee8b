//! Reports why a question has no answer, at its place in the file.

use planar_impact::reconstruct::{Measurand, ReconstructionIssue, SolveError, Stop, Variable};
use planar_impact::{Input, InputIssue, Issue as _, Measure, Message, Part, Refusal, Refusals};

use super::question::{Question, measure_in};
use crate::case::vehicle_number;
use crate::issue::{Issue, Issues};
use crate::wording;

/// Returns the issues of an invalid question, or of a search that does not converge.
pub fn issues(question: &Question, unsolved: &SolveError) -> Issues {
    let case = &question.case;
    match unsolved {
        SolveError::Problems(problems) => case.unfit(problems.iter().map(|problem| wrong(question, problem))),
        SolveError::NoStart { starts, refusals } => {
            let message = format!("the mechanics refuses the collision at each of {starts} starts; the reasons at the first follow");
            let help = "give starts, and bounds, between which the vehicles approach each other";
            let first = Issue::at("no-start", "unknown", message).with_help(help);
            case.refuse_physics(std::iter::once(first).chain(refusals.iter().map(wording::refusal)))
        }
        SolveError::NotConverged { searches, converged, nearest } => {
            let message = match converged {
                0 => format!("none of {searches} searches converged"),
                _ => format!("{converged} of {searches} searches converged, none as low as where another had to stop"),
            };
            case.refuse_physics([Issue::at("not-converged", "unknown", message).with_help(stopped(question, nearest))])
        }
        SolveError::Stopped => Issues::interrupted(),
        other => case.refuse_physics([Issue::at("not-converged", "unknown", other.to_string())]),
    }
}

/// Checks that there is as much evidence as there are unknowns under `[unknown]`. Uncertain inputs between limits need none.
pub fn check(question: &Question) -> Result<(), Issues> {
    let asked = &question.asked;
    let evidence = asked.evidence.len() + asked.unknowns.iter().filter(|unknown| unknown.prior.is_some()).count();
    let unknowns = asked.unknowns.iter().filter(|unknown| unknown.prior.is_some() || !question.inputs.contains(&unknown.of));
    let unknowns: Vec<Variable> = unknowns.map(|unknown| unknown.of).collect();
    if unknowns.len() <= evidence {
        return Ok(());
    }
    let few = ReconstructionIssue::TooLittleEvidence { unknowns, evidence };
    Err(question.case.unfit(wrong_with_any_evidence(question).chain([wrong(question, &few)])))
}

/// Checks what more evidence does not mend.
pub fn check_with_any_evidence(question: &Question) -> Result<(), Issues> {
    let issues: Vec<Issue> = wrong_with_any_evidence(question).collect();
    if issues.is_empty() { Ok(()) } else { Err(question.case.unfit(issues)) }
}

fn wrong_with_any_evidence(question: &Question) -> impl Iterator<Item = Issue> {
    let issues = question.asked.check().err().into_iter().flatten();
    issues.filter(|issue| !matches!(issue, ReconstructionIssue::TooLittleEvidence { .. })).map(|issue| wrong(question, &issue))
}

/// Describes where and why the nearest search stopped, and what may help.
fn stopped(question: &Question, nearest: &Stop) -> Message {
    let mut message = Message::from(format!("the nearest stopped after {} steps at ", nearest.iterations));
    for (i, (of, value)) in nearest.unknowns.iter().enumerate() {
        let separator = if i > 0 { ", " } else { "" };
        message = message.text(format!("{separator}{} = ", of.name())).figure(measure_in(*of, &question.case), *value);
    }
    message = message.text(format!(
        ", with chi-square {:.4}; the next step would have been {:.3e} (in m/s, rad/s and tenths of the rest)",
        nearest.chi_square, nearest.step
    ));
    if let Some(refusals) = &nearest.beyond {
        message = message.text("; there the mechanics refuses the collision: ").join(wording::reasons(refusals));
    }
    message.text(match nearest.beyond.as_ref().and_then(sliding_limit) {
        // No other start helps if sliding cannot produce the impulse.
        Some(Sliding::EndsBefore) => {
            "; the evidence implies more tangential impulse than ends the sliding: something snagged, or the crush plane is another"
        }
        Some(Sliding::WouldSpeedUp) => {
            "; the evidence implies a tangential impulse that speeds the sliding up, which friction never does: re-examine the crush plane and the directions"
        }
        None => "; try bounds, another start, or more --starts",
    })
}

/// Reason why sliding cannot produce a tangential impulse.
enum Sliding {
    /// It is larger than the impulse that ends the sliding.
    EndsBefore,
    /// It acts in the direction of sliding.
    WouldSpeedUp,
}

fn sliding_limit(refusals: &Refusals) -> Option<Sliding> {
    refusals.iter().find_map(|refusal| match refusal {
        Refusal::BeyondCritical { ratio, critical: Some(critical) } if ratio * critical > 0.0 => Some(Sliding::EndsBefore),
        Refusal::BeyondCritical { .. } => Some(Sliding::WouldSpeedUp),
        _ => None,
    })
}

fn wrong(question: &Question, problem: &ReconstructionIssue) -> Issue {
    let places = &question.places;
    let of_unknown = |of: Variable, message: Message| Issue::at("unknown", places.of_unknown(of), message);
    let of_evidence = |of: Measurand, message: Message| Issue::at("evidence", places.of_evidence(of), message);
    let value = |of: Variable, value: f64| Message::new().figure(measure_in(of, &question.case), value);
    match problem {
        ReconstructionIssue::NothingUnknown => {
            let help = "say what is to be solved for in [unknown], such as vehicle.1.speed = { start = \"30 mph\" }";
            Issue::at("nothing-unknown", "unknown", "nothing is unknown").with_help(help)
        }
        ReconstructionIssue::TooLittleEvidence { .. } => {
            let pieces: Vec<&str> = question.asked.evidence.iter().map(|evidence| evidence.of.name()).collect();
            let pieces = if pieces.is_empty() { String::new() } else { format!(": {}", pieces.join(", ")) };
            let help = "add evidence, take an unknown as known, or give it a standard deviation, which counts as evidence";
            Issue::at("too-little-evidence", "unknown", format!("{problem}{pieces}")).with_help(help)
        }
        ReconstructionIssue::NotInCase(of) => not_in_case(question, *of),
        ReconstructionIssue::NothingToMeasure(of) => {
            let issue = of_evidence(*of, "the collision has no such quantity".into());
            match (of.side().map(vehicle_number), of) {
                (Some(vehicle), Measurand::ApproachDirection(_)) if of.is_in(&question.case.collision) => {
                    issue.with_help(format!("vehicle {vehicle} stands still before the impact, and its velocity has no direction"))
                }
                (Some(vehicle), _) if !of.is_in(&question.case.collision) => {
                    issue.with_help(format!("vehicle {vehicle} is a fixed barrier"))
                }
                _ => issue,
            }
        }
        ReconstructionIssue::UnknownTwice(of) => of_unknown(*of, "it is unknown twice, by two of its names".into()),
        ReconstructionIssue::EvidenceTwice(of) => of_evidence(*of, format!("there is evidence of {} twice", of.name()).into())
            .with_help("combine them into one value with one standard deviation"),
        ReconstructionIssue::SpeedAndVelocity(side) => {
            of_unknown(Variable::Speed(*side), "a component of the same velocity is unknown too".into())
        }
        ReconstructionIssue::Unknown { of, issue } => {
            let issue = number(issue, measure_in(*of, &question.case));
            Issue { path: places.of_unknown(*of), ..issue }
        }
        ReconstructionIssue::Evidence { of, issue } => {
            let issue = number(issue, of.measure());
            Issue { path: places.of_evidence(*of), ..issue }
        }
        ReconstructionIssue::StartOutside { of, start, min, max } => {
            let message = Message::from("the start, ").join(value(*of, *start)).text(", must be ");
            of_unknown(*of, message.join(range(*min, *max, &|x| value(*of, x))))
        }
        ReconstructionIssue::BoundOutside { of, bound, least, most } => {
            let message = Message::from("a bound is ").join(value(*of, *bound)).text("; it must be ");
            of_unknown(*of, message.join(range(*least, *most, &|x| value(*of, x))))
        }
        ReconstructionIssue::ShareUnknown(of) => {
            let help = "give crush_energy of both vehicles, or contact.crush_share, the share of vehicle 1, in [evidence] or [unknown]";
            of_evidence(*of, "it is a share of the crush energy, and nothing says how the vehicles share it".into()).with_help(help)
        }
        other => Issue { path: "evidence".to_owned(), ..wording::library_issue(other) },
    }
}

/// Creates an issue with a number of the problem, whose figures have the measure that the case uses.
fn number(issue: &InputIssue, measure: Measure) -> Issue {
    let figures = issue.message().parts().iter().fold(Message::new(), |all, part| match part {
        Part::Text(text) => all.text(text.clone()),
        Part::Figure { value, .. } => all.figure(measure, *value),
        _ => all,
    });
    Issue { message: figures, ..wording::library_issue(issue) }
}

fn not_in_case(question: &Question, of: Variable) -> Issue {
    let issue = |message: String| Issue::at("not-in-case", question.places.of_unknown(of), message);
    if let Some(side) = of.side() {
        return issue(format!("vehicle {} is a fixed barrier", vehicle_number(side)));
    }
    match of {
        Variable::Input(Input::ImpulseRatio) => {
            let help =
                "leave impulse_ratio out of [contact], or write impulse_ratio = { of_critical = 1 } there to solve for a fraction of it";
            issue("the contact is at the critical impulse ratio, which follows from the other inputs".to_owned()).with_help(help)
        }
        Variable::CrushShare => issue("a barrier has no crush to share".to_owned()),
        Variable::Impulse(_) => issue("a barrier takes any momentum".to_owned()),
        _ => issue(format!("the collision has no {}", of.name())),
    }
}

/// Describes a range of two values, either of which may be unbounded.
fn range(min: f64, max: f64, value: &dyn Fn(f64) -> Message) -> Message {
    /// The smallest allowed mass or inertia.
    const NOTHING: f64 = 1e-300;
    match (min.is_finite(), max.is_finite()) {
        (true, true) => Message::from("from ").join(value(min)).text(" to ").join(value(max)),
        (true, false) if min > 0.0 && min < NOTHING => "above zero".into(),
        (true, false) => Message::from("at least ").join(value(min)),
        _ => Message::from("at most ").join(value(max)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_beyond_the_critical_one_ends_sliding_or_speeds_it_up() {
        let of = |refusal: Refusal| sliding_limit(&Refusals::from(refusal));
        let beyond = |ratio: f64, critical: Option<f64>| of(Refusal::BeyondCritical { ratio, critical });
        for sign in [1.0, -1.0] {
            assert!(matches!(beyond(0.4 * sign, Some(0.3 * sign)), Some(Sliding::EndsBefore)));
            assert!(matches!(beyond(-0.4 * sign, Some(0.3 * sign)), Some(Sliding::WouldSpeedUp)));
            assert!(matches!(beyond(0.4 * sign, None), Some(Sliding::WouldSpeedUp)));
        }
        assert!(of(Refusal::OutOfFloatRange).is_none());
    }
}
