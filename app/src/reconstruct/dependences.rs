//! How separations from rest positions follow what is not certain of the vehicles: a heading, an impact center, a mass, a yaw inertia.

use planar_impact::post_impact::Separation;
use planar_impact::reconstruct::{Dependence, Measurand, ReconstructionProblem, Solution, Unknown, Variable};
use planar_impact::{Motion, Output, Side};

use super::from_rest::{Separations, key};
use super::question::{key_of, name_in};
use crate::case::{Case, Parameter, RestOfVehicle, vehicle_number};
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

impl Dependences {
    /// Finds those of the separations of a case on its unknowns.
    pub fn of(case: &Case, separations: &Separations, unknowns: &[Unknown]) -> Dependences {
        let mut found = Dependences::default();
        for (side, separation) in Side::ALL.into_iter().zip(separations) {
            let Some(separation) = separation else { continue };
            let mut names = Vec::new();
            for unknown in unknowns {
                let Some(parameter) = key_of(unknown.of, case) else { continue };
                let Ok(at) = case.inputs.value(parameter) else { continue };
                let Some(slopes) = slopes(case, side, separation, parameter, (at, step(unknown, at))) else { continue };
                let name = name_in(unknown.of, case);
                let Ok(slopes) = slopes else {
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
                let message = format!("vehicle.{}: its separation follows {}, to first order", vehicle_number(side), names.join(" and "));
                found.notices.push(Notice::note("separation-follows", key(side), message));
            }
        }
        found
    }
}

/// Warns of each separation that at the solution is another than its line has, by more than a standard deviation.
pub fn bent(case: &Case, separations: &Separations, asked: &ReconstructionProblem, best: &Solution) -> Vec<Notice> {
    let known: Vec<(Variable, f64)> = best.unknowns.iter().map(|estimate| (estimate.of, estimate.value)).collect();
    let values: Vec<(Parameter, f64)> = known.iter().filter_map(|(of, value)| Some((key_of(*of, case)?, *value))).collect();
    let of_solution = case.inputs.set_all(&values).vehicles;
    let mut notices = Vec::new();
    for (side, separation) in Side::ALL.into_iter().zip(separations) {
        let Some((separation, rest)) = separation.as_ref().zip(case.rest.as_ref()) else { continue };
        let on_line = outputs(side).map(|of| {
            let own = asked.dependences.iter().filter(|dependence| dependence.of == of);
            let change =
                |one: &Dependence| known.iter().find(|(of, _)| *of == one.on).map_or(0.0, |(_, value)| one.slope * (value - one.at));
            own.map(change).sum::<f64>()
        });
        if on_line == [0.0; 3] {
            continue;
        }
        let there = rest.of(&of_solution).vehicles[side as usize].as_ref().and_then(|rest| motion_near(rest, separation));
        let changed = there.map(|there| components(&there)).into_iter().flatten().zip(components(&separation.motion));
        let off = changed
            .zip(on_line)
            .zip(separation.covariance.deviations())
            .any(|(((there, known), line), sd)| (there - known - line).abs() > sd);
        if off || there.is_none() {
            let message = format!(
                "vehicle.{}: at the solution its separation is another than to first order, by more than its standard deviation; give the case the \
                 values of the solution, and reconstruct it again",
                vehicle_number(side)
            );
            notices.push(Notice::warning("separation-bends", key(side), message));
        }
    }
    notices
}

fn outputs(side: Side) -> [Measurand; 3] {
    [Output::VelocityX(side), Output::VelocityY(side), Output::YawRate(side)].map(Measurand::Output)
}

fn components(of: &Motion) -> [f64; 3] {
    [of.velocity.x, of.velocity.y, of.yaw_rate]
}

/// Returns the motion at the separation of a vehicle, or of a pose, beside a known one.
fn motion_near(rest: &RestOfVehicle, known: &Separation) -> Option<Motion> {
    rest.slide.motion_near(rest.evidence.as_ref()?, rest.method, &known.motion)
}

/// Returns a change of an unknown that matters: its standard deviation, or a hundredth.
fn step(unknown: &Unknown, at: f64) -> f64 {
    unknown.prior.unwrap_or(0.01 * at.abs().max(1.0))
}

/// Returns the slopes of a separation by a parameter, by central differences of a step or, where there is no slide so far away, of a part of it. `None` if neither
/// the vehicle that slides nor its pose at separation depends on the parameter, and an error if there are no slides beside the known one.
fn slopes(case: &Case, side: Side, known: &Separation, parameter: Parameter, (at, step): (f64, f64)) -> Option<Result<[f64; 3], ()>> {
    let rest = case.rest.as_ref()?;
    let with = |value: f64| {
        let inputs = case.inputs.set_all(&[(parameter, value)]);
        rest.of(&inputs.vehicles).vehicles[side as usize].clone()
    };
    if with(at + step) == with(at) {
        return None;
    }
    let motion = |value: f64| motion_near(with(value).as_ref()?, known).map(|of| components(&of));
    let by = |step: f64| {
        let (more, less) = (motion(at + step)?, motion(at - step)?);
        let slopes: [f64; 3] = std::array::from_fn(|i| (more[i] - less[i]) / (2.0 * step));
        slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
    };
    Some([1.0, 0.1, 0.01].into_iter().find_map(|share| by(share * step)).ok_or(()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::control::Uncontrolled;
    use planar_impact::Input;

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
