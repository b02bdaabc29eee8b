//! How separations from rest positions follow what is not certain of the vehicles: a heading, an impact center, a mass, a yaw inertia.

use planar_impact::Side;
use planar_impact::reconstruct::{Dependence, Interval, Measurand, ReconstructionProblem, Solution, Unknown};

use super::followed::Followed;
use super::from_rest::{Separations, key, outputs};
use super::question::{Question, key_of, name_in, values_of};
use crate::case::{Case, Inputs, vehicle_number};
use crate::issue::{Issue, Issues};
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
    /// Finds those of separations of a case on its unknowns, about values of its inputs at which they are the separations.
    pub fn of(case: &Case, inputs: &Inputs, separations: &Separations, unknowns: &[Unknown]) -> Dependences {
        let mut found = Dependences::default();
        for about in Followed::all(case, inputs, separations) {
            let side = about.side;
            let mut names = Vec::new();
            for unknown in unknowns {
                let Some((parameter, at)) = key_of(unknown.of, case).and_then(|key| Some((key, inputs.value(key).ok()?))) else {
                    continue;
                };
                if !about.depends_on(parameter, step(unknown, at)) {
                    continue;
                }
                let name = name_in(unknown.of, case);
                let Some(slopes) = about.slopes(at, step(unknown, at), |value| about.with(&[(parameter, value)])) else {
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

/// Adds to the uncertainty of separations that of the numbers which a slide alone has: yaw inertia and impact center of a vehicle that is a point mass in the collision.
///
/// # Errors
///
/// Numbers that have no standard deviation, or that the separation cannot be followed by.
pub fn widened(case: &Case, separations: &Separations) -> Result<Separations, Issues> {
    let mut wider = separations.clone();
    let mut issues = Vec::new();
    for about in Followed::all(case, &case.inputs, separations) {
        match about.widened() {
            Ok(separation) => wider[about.side as usize] = Some(separation),
            Err(found) => issues.extend(found),
        }
    }
    if issues.is_empty() { Ok(wider) } else { Err(case.unfit(issues)) }
}

/// Returns a warning of each separation that, at an end of the interval of what it follows, is another than to first order, by more than a standard deviation.
pub fn bends(case: &Case, question: &Question, best: &Solution, separations: &Separations, intervals: &[Interval]) -> Vec<Notice> {
    let inputs = case.inputs.set_all(&values_of(case, best));
    let warning = |about: Followed<'_>| {
        let bent = |interval: &Interval| {
            let Measurand::Variable(on) = interval.of else { return None };
            let of_side = |one: &&Dependence| one.on == on && outputs(about.side).contains(&one.of);
            let slopes: Vec<&Dependence> = question.asked.dependences.iter().filter(of_side).collect();
            let parameter = key_of(on, case).filter(|_| !slopes.is_empty())?;
            let is_off = |end: f64| {
                let there = about.with(&[(parameter, end)]).and_then(|rest| about.near(&rest));
                let line = |(slope, sd): (&&Dependence, f64)| (slope.slope * (end - interval.value), sd);
                let lines = slopes.iter().zip(about.separation.covariance.deviations()).map(line);
                there.is_none_or(|there| {
                    let changes = there.motion.components().into_iter().zip(about.separation.motion.components());
                    changes.zip(lines).any(|((there, here), (line, sd))| (there - here - line).abs() > sd)
                })
            };
            let is_bent = [interval.low, interval.high].into_iter().filter(|end| end.is_finite()).any(is_off);
            is_bent.then(|| name_in(on, case))
        };
        let names: Vec<String> = intervals.iter().filter_map(bent).collect();
        (!names.is_empty()).then(|| {
            let message = format!(
                "vehicle.{}: at the ends of the interval of {} its separation is another than to first order: give a smaller uncertainty, or the separation \
                 velocity as evidence instead",
                vehicle_number(about.side),
                names.join(" and ")
            );
            Notice::warning("separation-bends", key(about.side), message)
        })
    };
    Followed::all(case, &inputs, separations).filter_map(warning).collect()
}

/// Returns `true` if the separation of a vehicle follows an unknown.
pub fn is_followed(asked: &ReconstructionProblem, side: Side) -> bool {
    asked.dependences.iter().any(|one| outputs(side).contains(&one.of))
}

/// Returns a change of an unknown that matters: its standard deviation, or a hundredth.
fn step(unknown: &Unknown, at: f64) -> f64 {
    unknown.prior.unwrap_or(0.01 * at.abs().max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::control::Uncontrolled;
    use planar_impact::Input;
    use planar_impact::post_impact::Separation;
    use planar_impact::reconstruct::Variable;

    fn case(heading: f64, inertia: f64, forward: f64, rest: &str) -> Case {
        let text = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = {inertia}\nheading = {heading}\nspeed = 15\nimpact_center = [{forward}, 0.3]\n\
             [[vehicle]]\nmass = 1200\nyaw_inertia = 2000\nheading = 3.1\nspeed = 0\nimpact_center = [2, 0]\n\
             [contact]\ncrush_plane = 0\nrestitution = 0\n[scene]\nimpact_point = [0, 0]\n[rest]\nfriction = \"0.7 ± 0.05\"\n\
             [rest.vehicle.1]\nposition = [\"3 m ± 0.1 m\", \"1 m ± 0.1 m\"]\nheading = \"120 deg ± 3 deg\"\n\
             front_axle = 1.2\nrear_axle = 1.4\ntrack = 1.5\nwheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }}\n{rest}"
        );
        Case::parse(Source::new("case.toml", text)).unwrap_or_else(|issues| panic!("{issues}"))
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
                let nominal_case = of(nominal);
                let found = Dependences::of(&nominal_case, &nominal_case.inputs, &separations, &[unknown]);
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

    #[test]
    fn a_step_is_the_uncertainty_or_a_hundredth() {
        let free = Unknown::free(Variable::Speed(Side::One), 15.0);
        assert_eq!([15.0, -15.0, 0.2].map(|at| step(&free, at)), [0.15, 0.15, 0.01]);
        assert_eq!(step(&Unknown { prior: Some(0.4), ..free }, 15.0), 0.4);
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
        let found = Dependences::of(&nominal, &nominal.inputs, &separations, &unknowns.collect::<Vec<_>>());
        assert!(found.all.is_empty() && found.notices.is_empty() && found.issues.is_empty(), "{:?}", found.all);
    }
}
