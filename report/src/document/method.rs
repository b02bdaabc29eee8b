//! What was asked, by which equations, and what they assume.

use planar_impact_app::report::{CaseReport, MainAnswer, ReportVerb};
use planar_impact_app::solve::{ImpulseRatioGiven, Solution, TangentialLaw};

use crate::block::Block;

/// What of the program is proven.
pub const PROOF: &str = "Proven: the equations are written once, for any kind of number. The identities of the mechanics (conservation of momentum, the energy \
                         account, restitution, the critical impulse ratio, their derivatives) are proven over the rational numbers by evaluating the same \
                         code there; `planar-impact prove` prints each of them.";

/// How a stiffness is fitted.
pub const STIFFNESS: &str = "The crush energy of each test is the kinetic energy of the normal approach less that of the rebound; E* = sqrt(2 E_C/w) grows linearly \
                             with the depth of the crush: E* = d0 + d1 C, with A = d0 d1 and B = d1^2. The line is fitted to the tests by least squares, on the \
                             mean depth of each and on its profile.";

/// What validation does not show.
pub const LIMITS: &str = "These comparisons show that the program computes what the published method says. How well the method describes this collision depends on \
                          the inputs and on the assumptions above: reconstructions from crush err by tens of per cent, however many digits agree.";

/// Returns what a report asks.
pub fn question(verb: ReportVerb) -> &'static str {
    match verb {
        ReportVerb::Solve => "How do the vehicles leave the collision, and what energy does it take?",
        ReportVerb::Reconstruct => "Which values of the unknowns agree with the evidence, and how certain are they?",
        ReportVerb::Crush => "Which energy is in the residual crush?",
        ReportVerb::Crash3 => "Which change of velocity follows from the residual crush by CRASH3?",
        ReportVerb::Uncertainty => "How uncertain are the outputs, given the uncertainty of the inputs?",
    }
}

/// Renders the method of a report.
pub fn blocks(report: &CaseReport) -> Vec<Block> {
    let mut blocks = vec![Block::paragraph(method(report))];
    if !report.formulas.is_empty() {
        blocks.push(Block::paragraph(
            "The formulas that the program computes, of the critical impulse ratio and of the energy lost by way of the impulse, as its own code writes them:",
        ));
    }
    for formula in &report.formulas {
        blocks.push(Block::Heading { level: 3, text: formula.subject.clone() });
        let text: Vec<&str> = formula.definitions.iter().map(|definition| definition.text.as_str()).collect();
        blocks.push(Block::Formula { latex: formula.formula.latex(), text: text.join("\n") });
    }
    blocks.push(Block::Heading { level: 2, text: "Assumptions".to_owned() });
    blocks.extend(assumptions(report).into_iter().map(|text| Block::item("- ", text)));
    blocks
}

/// Describes the mechanics of a solution: its bodies, what they exchange, and the law of the tangential impulse.
fn impact(solution: &Solution) -> String {
    let has_barrier = solution.vehicles.iter().any(|vehicle| vehicle.barrier);
    let bodies = if has_barrier { "a rigid body and a fixed barrier exchange" } else { "two rigid bodies exchange" };
    let what = if solution.contact.impulse.moment.is_some() { ", and a moment impulse" } else { "" };
    let kept = if has_barrier {
        "The momentum and the angular momentum of the body change by the impulse, which the barrier takes"
    } else {
        "Momentum and angular momentum are conserved"
    };
    let law = match solution.contact.tangential_law {
        TangentialLaw::Brach => "is limited by the critical ratio mu0 at which sliding ends",
        TangentialLaw::KudlichSlibar => "is limited by the ratio at which the tangential velocity comes back with e as the normal one does",
    };
    format!(
        "Planar impact mechanics (Brach and Brach): {bodies} one impulse at a common point{what}. {kept}; the coefficient of restitution e relates the normal \
         velocities at the impact center before and after; the impulse ratio mu relates tangential to normal impulse, and {law}."
    )
}

fn method(report: &CaseReport) -> String {
    let text = match &report.main {
        MainAnswer::Solve(solution) => return impact(solution),
        MainAnswer::Reconstruct(answer) if answer.solution.as_ref().is_some_and(|solution| solution.contact.model.is_some()) => {
            "Conservation of momentum: the velocities after the impact, which the evidence gives, and the directions before it determine the speeds before. No \
             contact model is used. Every unknown is found by least squares, weighted by the uncertainty of the evidence; intervals are profile likelihoods."
        }
        MainAnswer::Reconstruct(_) => {
            "Planar impact mechanics (Brach and Brach), in reverse: the values of the unknowns with which two rigid bodies that exchange one impulse at a \
             common point come closest to the evidence, by least squares weighted with its uncertainty (chi-square), from many starting points, within the \
             bounds and the limits of the physics. The interval of an unknown is its profile likelihood: the range over which the best fit of everything \
             else stays within a quantile of chi-square of the least one. It accounts for bounds and for curved evidence."
        }
        MainAnswer::Crush(_) => {
            "The crush energy of a profile of residual depths: at each place across the width the force per width is A + B C, with C the depth there, linear \
             between the measured stations. The energy is the integral of that force over the depth, with G = A^2/(2 B) for the force without residual crush."
        }
        MainAnswer::Crash3(_) => {
            "CRASH3: the crush energies of both vehicles, corrected for the direction of the force, give the change of velocity of each under the assumption of \
             a common velocity at the end; planar impact mechanics from the same energy stands beside it."
        }
        MainAnswer::Uncertainty(_) => {
            "Planar impact mechanics (Brach and Brach), with inputs that have distributions: by exact first and second derivatives, by samples, and by \
             guaranteed bounds. Samples that physics refuses are counted, and never moved."
        }
    };
    text.to_owned()
}

/// Names what the method assumes of this case.
fn assumptions(report: &CaseReport) -> Vec<String> {
    let impact = [
        "The impulse acts at one point, the impact center, and in no time: positions and headings do not change during the impact.",
        "Other forces, of tires and of gravity, are small beside the impulse.",
        "The motion is planar: no pitch, roll or override.",
        "The vehicles are rigid but for the crush, which does not change their mass, inertia or center of mass.",
    ];
    let mut all: Vec<String> = impact.map(str::to_owned).into();
    if matches!(&report.main, MainAnswer::Solve(answer) if answer.contact.impulse.moment.is_some()) {
        all.push(
            "The moment impulse of the file acts beside it, as of a contact over an area, and its work is in the energy lost.".to_owned(),
        );
    }
    let solution = match &report.main {
        MainAnswer::Solve(answer) => Some(answer.as_ref()),
        MainAnswer::Reconstruct(answer) => answer.solution.as_ref(),
        MainAnswer::Crush(_) | MainAnswer::Crash3(_) => {
            return vec![
                "The stiffness, of tests with another crush than this one, holds for this vehicle and for this part of it.".to_owned(),
                "The force grows linearly with the depth, and the depth between two stations is that of the line between them.".to_owned(),
                "The crush is all from this collision.".to_owned(),
            ];
        }
        MainAnswer::Uncertainty(_) => None,
    };
    if let Some(contact) = solution.map(|solution| &solution.contact).filter(|contact| contact.model.is_none()) {
        all.push(match (contact.impulse_ratio_given, contact.tangential_law) {
            (ImpulseRatioGiven::Critical, TangentialLaw::Brach) => {
                "Sliding at the impact center ends before the vehicles separate: the impulse ratio is critical.".to_owned()
            }
            (ImpulseRatioGiven::Critical, TangentialLaw::KudlichSlibar) => {
                "Sliding at the impact center is reversed before the vehicles separate: the impulse ratio is the limit of this law."
                    .to_owned()
            }
            (ImpulseRatioGiven::Number, _) => "The impulse ratio is the number that the file gives.".to_owned(),
            (ImpulseRatioGiven::OfCritical, _) => "The impulse ratio is a fraction of the critical one.".to_owned(),
            (ImpulseRatioGiven::Friction, _) => {
                let is = if contact.slides_by_friction() { "the friction: the vehicles still slide at separation" } else { "the limit" };
                format!("The impulse ratio is the limit of the law below, or the friction if that is less. Here it is {is}.")
            }
        });
        all.push(match contact.tangential_law {
            TangentialLaw::Brach => {
                "Law of Brach: at the critical ratio the tangential relative velocity at separation is zero.".to_owned()
            }
            TangentialLaw::KudlichSlibar => "Law of Kudlich and Slibar: restitution holds for the tangential velocity too.".to_owned(),
        });
    }
    if let MainAnswer::Reconstruct(answer) = &report.main {
        let which = if answer.facts.separations.is_empty() {
            "are independent."
        } else {
            "are independent, but for those of the separations from rest positions: what is uncertain of the slides correlates them, and on locked \
             wheels the error of the way is normal."
        };
        all.push(format!("Errors of the evidence are normally distributed with the standard deviations of the file, and {which}"));
    }
    all
}
