//! How separations from rest positions follow what is not certain of the vehicles: a heading, an impact center, a mass, a yaw inertia.

use planar_impact::reconstruct::{Answer, Dependence, Measurand, ReconstructionProblem, Solution, SolveError, Unknown, Variable};
use planar_impact::{Motion, Side};

use super::from_rest::{Separations, components, key, outputs};
use super::question::{key_of, name_in};
use crate::case::{Case, Inputs, Parameter, RestInputs, RestOfVehicle, vehicle_number};
use crate::issue::Issue;
use crate::notice::Notice;

/// What the separations follow.
#[derive(Default)]
pub struct Dependences {
    /// The slopes.
    pub all: Vec<Dependence>,
    /// That they are of first order.
    pub notices: Vec<Notice>,
    /// Unknowns that a separation could not be followed by.
    pub issues: Vec<Issue>,
}

/// Largest number of times that slopes are taken anew, about the solution that the ones before lead to.
const MOST: usize = 6;

impl Dependences {
    /// Finds those of the separations of a case on its unknowns, about the values of the case.
    pub fn of(case: &Case, separations: &Separations, unknowns: &[Unknown]) -> Dependences {
        let mut found = Dependences::default();
        for (side, separation) in Side::ALL.into_iter().zip(separations) {
            let Some((separation, rest)) = separation.as_ref().zip(case.rest.as_ref()) else { continue };
            let about = About { rest, inputs: &case.inputs, side, motion: separation.motion };
            let mut names = Vec::new();
            for unknown in unknowns {
                let Some((parameter, at)) = key_of(unknown.of, case).and_then(|key| Some((key, case.inputs.value(key).ok()?))) else {
                    continue;
                };
                if !about.depends_on(parameter, step(unknown, at)) {
                    continue;
                }
                let name = name_in(unknown.of, case);
                let Some(slopes) = about.slopes(parameter, step(unknown, at)) else {
                    let message = format!("vehicle.{}: its separation cannot be followed as {name} changes", vehicle_number(side));
                    let help = format!("give {name} without an uncertainty, or the separation velocity as evidence instead");
                    found.issues.push(Issue::at("no-separation", key(side), message).with_help(help));
                    continue;
                };
                names.push(name);
                let dependence = |(of, slope)| Dependence { of, on: unknown.of, at, slope };
                found.all.extend(outputs(side).into_iter().zip(slopes).map(dependence));
            }
            if !names.is_empty() {
                let message = format!(
                    "vehicle.{}: its separation follows {}, to first order about the solution",
                    vehicle_number(side),
                    names.join(" and ")
                );
                found.notices.push(Notice::note("separation-follows", key(side), message));
            }
        }
        found
    }
}

/// Solves a question, with the slopes of its separations about the solution: those about the values of the case lead there. Returns a warning of each separation that at
/// the solution is still another than its line has, by more than a hundredth of its standard deviations.
///
/// # Errors
///
/// Those of the search.
pub fn solved(
    case: &Case,
    separations: &Separations,
    asked: &mut ReconstructionProblem,
    solve: &dyn Fn(&ReconstructionProblem) -> Result<Answer, SolveError>,
) -> Result<(Answer, Vec<Notice>), SolveError> {
    let mut answer = solve(asked)?;
    let mut bent = bent(case, separations, asked, answer.best());
    for _ in 0..MOST {
        let mut moved = asked.clone();
        let take = |(side, motion): &(Side, Option<Motion>)| take_about(case, &mut moved, answer.best(), *side, (*motion)?);
        if bent.is_empty() || !bent.iter().map(take).all(|taken| taken.is_some()) {
            break;
        }
        answer = solve(&moved)?;
        *asked = moved;
        bent = self::bent(case, separations, asked, answer.best());
    }
    let warning = |(side, _): (Side, Option<Motion>)| {
        let message = format!(
            "vehicle.{}: at the solution its separation is another than to first order: give what it follows with a smaller uncertainty, or the separation \
             velocity as evidence instead",
            vehicle_number(side)
        );
        Notice::warning("separation-bends", key(side), message)
    };
    Ok((answer, bent.into_iter().map(warning).collect()))
}

/// Returns the vehicles whose separation at a solution is not what the evidence has for it, each with the one that it is, if there is one.
fn bent(case: &Case, separations: &Separations, asked: &ReconstructionProblem, best: &Solution) -> Vec<(Side, Option<Motion>)> {
    /// Standard deviations that do not matter.
    const NEAR: f64 = 0.01;
    let inputs = case.inputs.set_all(&values(case, best));
    let of_side = |side: Side| {
        let (separation, rest) = separations[side as usize].as_ref().zip(case.rest.as_ref())?;
        if !asked.dependences.iter().any(|dependence| outputs(side).contains(&dependence.of)) {
            return None;
        }
        let motion = About { rest, inputs: &inputs, side, motion: separation.motion }.moved();
        let is_near = |there: Motion| {
            let all = outputs(side).into_iter().zip(components(&there)).zip(separation.covariance.deviations());
            let mut known = all.filter_map(|((of, there), sd)| Some((there, evidence(asked, of, best)?, sd)));
            known.all(|(there, on_line, sd)| (there - on_line).abs() <= NEAR * sd)
        };
        (!motion.is_some_and(is_near)).then_some((side, motion))
    };
    Side::ALL.into_iter().filter_map(of_side).collect()
}

/// Returns what evidence of a quantity says at a solution, with what it follows.
fn evidence(asked: &ReconstructionProblem, of: Measurand, best: &Solution) -> Option<f64> {
    let value = asked.evidence.iter().find(|evidence| evidence.of == of)?.value;
    let change = |one: &Dependence| {
        let estimate = best.unknowns.iter().find(|estimate| estimate.of == one.on);
        estimate.map_or(0.0, |estimate| one.slope * (estimate.value - one.at))
    };
    Some(value + asked.dependences.iter().filter(|one| one.of == of).map(change).sum::<f64>())
}

/// Takes the evidence of a separation, and its slopes, about a solution at which it has a motion. `None` if it cannot be followed there.
fn take_about(case: &Case, asked: &mut ReconstructionProblem, best: &Solution, side: Side, motion: Motion) -> Option<()> {
    let inputs = case.inputs.set_all(&values(case, best));
    let about = About { rest: case.rest.as_ref()?, inputs: &inputs, side, motion };
    for (of, value) in outputs(side).into_iter().zip(components(&motion)) {
        asked.evidence.iter_mut().filter(|evidence| evidence.of == of).for_each(|evidence| evidence.value = value);
    }
    let of_side: Vec<Variable> = asked.dependences.iter().filter(|one| one.of == outputs(side)[0]).map(|one| one.on).collect();
    for on in of_side {
        let unknown = asked.unknowns.iter().find(|unknown| unknown.of == on)?;
        let parameter = key_of(on, case)?;
        let at = inputs.value(parameter).ok()?;
        let slopes = about.slopes(parameter, step(unknown, at))?;
        for dependence in asked.dependences.iter_mut().filter(|one| one.on == on) {
            if let Some(place) = outputs(side).iter().position(|of| *of == dependence.of) {
                (dependence.at, dependence.slope) = (at, slopes[place]);
            }
        }
    }
    Some(())
}

/// Returns the values of a solution that the case has.
fn values(case: &Case, best: &Solution) -> Vec<(Parameter, f64)> {
    best.unknowns.iter().filter_map(|estimate| Some((key_of(estimate.of, case)?, estimate.value))).collect()
}

/// Returns a change of an unknown that matters: its standard deviation, or a hundredth.
fn step(unknown: &Unknown, at: f64) -> f64 {
    unknown.prior.unwrap_or(0.01 * at.abs().max(1.0))
}

/// The inputs of a case, and a motion at the separation of one vehicle, that they lead to or nearly so.
struct About<'a> {
    rest: &'a RestInputs,
    inputs: &'a Inputs,
    side: Side,
    motion: Motion,
}

impl About<'_> {
    fn with(&self, values: &[(Parameter, f64)]) -> Option<RestOfVehicle> {
        self.rest.of(&self.inputs.set_all(values).vehicles).vehicles[self.side as usize].clone()
    }

    /// Returns the motion to which values of the inputs lead.
    fn motion_with(&self, values: &[(Parameter, f64)]) -> Option<Motion> {
        let RestOfVehicle { slide, evidence, method, .. } = self.with(values)?;
        slide.motion_near(&evidence?, method, &self.motion)
    }

    /// Returns the motion to which the inputs lead.
    fn moved(&self) -> Option<Motion> {
        self.motion_with(&[])
    }

    /// Returns `true` if the vehicle that slides, or its pose at separation, changes with a parameter.
    fn depends_on(&self, parameter: Parameter, step: f64) -> bool {
        self.inputs.value(parameter).is_ok_and(|at| self.with(&[(parameter, at + step)]) != self.with(&[]))
    }

    /// Returns the slopes of the separation by a parameter, by central differences of a step or, where there is no slide so far away, of a part of it.
    fn slopes(&self, parameter: Parameter, step: f64) -> Option<[f64; 3]> {
        let at = self.inputs.value(parameter).ok()?;
        let by = |step: f64| {
            let [more, less] = [at + step, at - step].map(|value| self.motion_with(&[(parameter, value)]).map(|of| components(&of)));
            let (more, less) = (more?, less?);
            let slopes: [f64; 3] = std::array::from_fn(|i| (more[i] - less[i]) / (2.0 * step));
            slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
        };
        [1.0, 0.1, 0.01].into_iter().find_map(|share| by(share * step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::control::Uncontrolled;
    use planar_impact::Input;
    use planar_impact::post_impact::Separation;

    fn case(heading: f64, inertia: f64, forward: f64, rest: &str) -> Case {
        let text = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = {inertia}\nheading = {heading}\nspeed = 15\nimpact_center = [{forward}, 0.3]\n\
             [[vehicle]]\nmass = 1200\nyaw_inertia = 2000\nheading = 3.1\nspeed = 0\nimpact_center = [2, 0]\n\
             [contact]\ncrush_plane = 0\nrestitution = 0\n[scene]\nimpact_point = [0, 0]\n[rest]\nfriction = \"0.7 ± 0.05\"\n\
             [rest.vehicle.1]\nposition = [\"3 m ± 0.1 m\", \"1 m ± 0.1 m\"]\nheading = \"120 deg ± 3 deg\"\n\
             front_axle = 1.2\nrear_axle = 1.4\ntrack = 1.5\nwheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }}\n{rest}"
        );
        Case::parse(Source { name: "case.toml".to_owned(), text }).unwrap_or_else(|issues| panic!("{issues}"))
    }

    fn separation(case: &Case) -> Separation {
        let [one, _] = case.separations_from_rest(&Uncontrolled).expect("a slide");
        one.expect("vehicle 1 has a rest position")
    }

    /// Whole searches beside the known separation have its slopes.
    #[test]
    fn slopes_are_those_of_whole_searches() {
        // The place of each among heading, yaw inertia and impact center, with its nominal value and a step.
        let nominal = [0.1, 2500.0, 2.0];
        let inputs = [
            (Input::Heading(Side::One), 0, 0.01),
            (Input::YawInertia(Side::One), 1, 50.0),
            (Input::ImpactCenterForward(Side::One), 2, 0.02),
        ];
        for rest in ["", "method = \"closed-form\""] {
            let of = |[heading, inertia, forward]: [f64; 3]| case(heading, inertia, forward, rest);
            let separations = [Some(separation(&of(nominal))), None];
            for (input, place, step) in inputs {
                let at = nominal[place];
                let unknown = Unknown { prior: Some(step), ..Unknown::free(Variable::Input(input), at) };
                let found = Dependences::of(&of(nominal), &separations, &[unknown]);
                let [more, less] = [at + step, at - step].map(|x| {
                    let mut moved = nominal;
                    moved[place] = x;
                    separation(&of(moved)).motion
                });
                let change = [more.velocity.x - less.velocity.x, more.velocity.y - less.velocity.y, more.yaw_rate - less.yaw_rate];
                assert!(found.issues.is_empty() && found.all.len() == 3, "{input}: {:?}", found.issues);
                assert_eq!(found.notices.iter().map(|notice| notice.code).collect::<Vec<_>>(), ["separation-follows"]);
                for (dependence, change) in found.all.iter().zip(change) {
                    assert!((dependence.slope * 2.0 * step - change).abs() < 1e-6, "{input}: {dependence:?} {change}");
                    assert_eq!((dependence.on, dependence.at), (Variable::Input(input), at));
                }
                assert!(change.iter().any(|change| change.abs() > 1e-3), "{input}: {change:?}");
            }
        }
    }

    /// A pose at separation that is given does not follow the heading before the impact, and nothing follows the speed.
    #[test]
    fn what_is_given_follows_nothing() {
        let nominal = case(0.1, 2500.0, 2.0, "separation = { position = [-2, 0], heading = 0.1 }");
        let separations = [Some(separation(&nominal)), None];
        let inputs = [Input::Heading(Side::One), Input::ImpactCenterLeft(Side::One), Input::Heading(Side::Two)];
        let unknowns = inputs
            .map(|input| Unknown::free(Variable::Input(input), 0.1))
            .into_iter()
            .chain([Unknown::free(Variable::Speed(Side::One), 15.0)]);
        let found = Dependences::of(&nominal, &separations, &unknowns.collect::<Vec<_>>());
        assert!(found.all.is_empty() && found.notices.is_empty() && found.issues.is_empty(), "{:?}", found.all);
    }
}
