//! How separations from rest positions follow what is not certain of the vehicles: a heading, an impact center, a mass, a yaw inertia.

use planar_impact::Side;
use planar_impact::post_impact::Separation;
use planar_impact::reconstruct::{
    Answer, Dependence, Estimate, Interval, Measurand, ReconstructionProblem, Solution, SolveError, Unknown, Verdict,
};

use super::followed::{Doubt, Followed};
use super::from_rest::{BY_CHANCE, Separations, components, key, outputs};
use super::question::{Question, key_of, name_in};
use super::solve_error;
use crate::case::{Case, Inputs, Parameter, vehicle_number};
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

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

/// Largest number of times that separations are followed anew, about the solution that the ones before lead to.
const MOST: usize = 12;

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

/// Solves the question of a case whose vehicles separated in a certain way. What separations follow is taken about the solution: that about the values of the case leads
/// there, within the reach of first order, and from there again. Returns the question about the solution, its answer, and the separations there.
///
/// # Errors
///
/// Those of the question and of the search, and a separation that cannot be followed to a solution.
pub fn solved(
    case: &Case,
    separations: &Separations,
    mut question: Question,
    solve: &dyn Fn(&ReconstructionProblem) -> Result<Answer, SolveError>,
) -> Result<(Question, Answer, Separations), Issues> {
    let mut about = separations.clone();
    for _ in 0..MOST {
        let asked = within_reach(&question.asked);
        let answer = solve(&asked).map_err(|unsolved| solve_error::issues(&question, &unsolved))?;
        let inputs = case.inputs.set_all(&values(case, answer.best()));
        let Some(there) = moved(case, &inputs, &about, &question.asked) else { break };
        let is_in_reach = |solution: &Solution| solution.unknowns.iter().all(|estimate| is_inside(estimate, &asked, &question.asked));
        let is_about = |side: Side| {
            let [about, there] = [&about, &there].map(|separations| separations[side as usize].as_ref());
            !is_followed(&question.asked, side)
                || about.zip(there).is_some_and(|(about, there)| is_alike(&question.asked, answer.best(), side, about, there))
        };
        if is_in_reach(answer.best()) && Side::ALL.into_iter().all(is_about) {
            let answer = without(answer, |solution| !is_in_reach(solution));
            return reconciled(case, &inputs, question, answer, about);
        }
        question = Question::about(case, &inputs, &there)?;
        about = there;
    }
    let mut names: Vec<String> = question.asked.dependences.iter().map(|one| name_in(one.on, case)).collect();
    names.dedup();
    let names = names.join(" and ");
    let help = format!("give {names} between bounds or with a smaller uncertainty, or the separation velocity as evidence instead");
    let issue = |side| {
        let message = format!("vehicle.{}: its separation cannot be followed to a solution", vehicle_number(side));
        Issue::at("no-separation", key(side), message).with_help(help.clone())
    };
    Err(case.unfit(Side::ALL.into_iter().filter(|side| is_followed(&question.asked, *side)).map(issue)))
}

/// Returns `true` if the separation of a vehicle follows an unknown.
fn is_followed(asked: &ReconstructionProblem, side: Side) -> bool {
    asked.dependences.iter().any(|one| outputs(side).contains(&one.of))
}

/// Removes the solutions, other than the best, that lie where separations are followed no further: they are none.
fn without(mut answer: Answer, is_beyond: impl Fn(&Solution) -> bool) -> Answer {
    answer.solutions.retain(|solution| !is_beyond(solution));
    answer.worse.retain(|solution| !is_beyond(solution));
    if answer.without_bounds.as_deref().is_some_and(&is_beyond) {
        answer.without_bounds = None;
    }
    answer.verdict = match answer.verdict {
        Verdict::SeveralSolutions if answer.solutions.len() == 1 => Verdict::Agrees,
        Verdict::BoundsExclude if answer.without_bounds.is_none() => Verdict::Contradicted,
        verdict => verdict,
    };
    answer
}

/// Returns `true` for a value that lies on no bound of reach; on a bound of the file it may.
fn is_inside(estimate: &Estimate, within: &ReconstructionProblem, given: &ReconstructionProblem) -> bool {
    let [within, given] = [within, given].map(|asked| asked.unknowns.iter().find(|unknown| unknown.of == estimate.of));
    let is_beyond = |value: f64, [min, max]: [Option<f64>; 2]| {
        min.is_some_and(|min| value <= min || near(value, min)) || max.is_some_and(|max| value >= max || near(value, max))
    };
    within.zip(given).is_none_or(|(within, given)| {
        let of_reach = |bound: Option<f64>, given: Option<f64>| bound.filter(|_| bound != given);
        !is_beyond(estimate.value, [of_reach(within.min, given.min), of_reach(within.max, given.max)])
    })
}

/// Judges points along a path with what is uncertain of the vehicle: where it is contradicted at the solution, and not beside it, within what is known beforehand, it is
/// not, and a warning says where.
fn reconciled(
    case: &Case,
    inputs: &Inputs,
    question: Question,
    answer: Answer,
    mut about: Separations,
) -> Result<(Question, Answer, Separations), Issues> {
    let mut warnings = Vec::new();
    for followed in Followed::all(case, inputs, &about.clone()) {
        let doubt = |unknown: &Unknown| {
            question.asked.dependences.iter().find(|one| one.on == unknown.of && outputs(followed.side).contains(&one.of))?;
            let parameter = key_of(unknown.of, case)?;
            let span = [unknown.min.unwrap_or(f64::NEG_INFINITY), unknown.max.unwrap_or(f64::INFINITY)];
            Some(Doubt { parameter, value: inputs.value(parameter).ok()?, sd: unknown.prior.unwrap_or(f64::INFINITY), span })
        };
        let doubts: Vec<Doubt> = question.asked.unknowns.iter().filter_map(doubt).collect();
        let Some(fit) = about[followed.side as usize].as_mut().and_then(|separation| separation.fit.as_mut()) else { continue };
        if doubts.is_empty() || fit.probability >= BY_CHANCE {
            continue;
        }
        let (chi_square, at) = followed.reconciled(&doubts);
        let with_doubts = fit.clone().with_chi_square(chi_square);
        if with_doubts.probability >= BY_CHANCE {
            *fit = with_doubts;
            let mut message = Message::from(format!("vehicle.{}: a slide comes past its points with ", vehicle_number(followed.side)));
            for (i, (doubt, value)) in doubts.iter().zip(at).enumerate() {
                let and = if i == 0 { "" } else { " and " };
                message = message.text(format!("{and}{} = ", doubt.parameter)).figure(doubt.parameter.measure(), value);
            }
            let message = message.text(", and with the values of the solution none does: the points say more of them than the answer uses");
            warnings.push(Notice::warning("points-move-inputs", format!("{}.points", key(followed.side)), message));
        }
    }
    if warnings.is_empty() {
        return Ok((question, answer, about));
    }
    let mut question = Question::about(case, inputs, &about)?;
    question.notices.0.extend(warnings);
    Ok((question, answer, about))
}

/// Returns a warning of each separation that, at an end of the interval of what it follows, is another than to first order, by more than a standard deviation.
pub fn bends(case: &Case, question: &Question, best: &Solution, separations: &Separations, intervals: &[Interval]) -> Vec<Notice> {
    let inputs = case.inputs.set_all(&values(case, best));
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
                    let changes = components(&there.motion).into_iter().zip(components(&about.separation.motion));
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

/// Returns the problem with what separations follow in reach of where they are followed: beyond, a line has solutions that no slide has.
fn within_reach(asked: &ReconstructionProblem) -> ReconstructionProblem {
    let mut within = asked.clone();
    for unknown in &mut within.unknowns {
        let Some(at) = asked.dependences.iter().find(|one| one.on == unknown.of).map(|one| one.at) else { continue };
        let reach = reach(unknown, at);
        let [mut min, mut max] = [at - reach, at + reach];
        // The middle of a prior is its evidence, and remains.
        if unknown.prior.is_some() {
            (min, max) = (min.min(unknown.start), max.max(unknown.start));
        }
        let [min, max] = [unknown.min.map_or(min, |bound| bound.max(min)), unknown.max.map_or(max, |bound| bound.min(max))];
        if min < max {
            (unknown.min, unknown.max) = (Some(min), Some(max));
            unknown.start = unknown.start.clamp(min, max);
        }
    }
    within
}

/// Returns how far a separation is followed to first order in one step.
fn reach(unknown: &Unknown, at: f64) -> f64 {
    /// Of angles in rad, of lengths in m, and of other numbers as a share.
    const REACH: f64 = 0.3;
    let usual = match unknown.of.measure() {
        Measure::Angle | Measure::Length => REACH,
        _ => REACH * at.abs(),
    };
    usual.max(5.0 * unknown.prior.unwrap_or(0.0))
}

/// Returns `true` for a value on a bound.
fn near(value: f64, bound: f64) -> bool {
    (value - bound).abs() <= 1e-6 * bound.abs().max(1.0)
}

/// Returns the separations at values of the inputs, near those at others; `None` if a slide does not lead there. Those that follow nothing stay as they are.
fn moved(case: &Case, inputs: &Inputs, separations: &Separations, asked: &ReconstructionProblem) -> Option<Separations> {
    let mut there = separations.clone();
    for about in Followed::all(case, inputs, separations) {
        if is_followed(asked, about.side) {
            let separation = &about.near(&about.with(&[])?)?;
            there[about.side as usize] = Some(Followed { separation, ..about }.widened().ok()?);
        }
    }
    Some(there)
}

/// Returns `true` if a separation at a solution is that of the evidence there, with its covariance.
fn is_alike(asked: &ReconstructionProblem, best: &Solution, side: Side, about: &Separation, there: &Separation) -> bool {
    /// Standard deviations, and shares of a covariance, that do not matter.
    const NEAR: f64 = 0.01;
    let sds = there.covariance.deviations();
    let mut motion = outputs(side).into_iter().zip(components(&about.motion)).zip(components(&there.motion)).zip(sds);
    let on_line = |of: Measurand| -> f64 {
        let change = |one: &Dependence| {
            let estimate = best.unknowns.iter().find(|estimate| estimate.of == one.on);
            estimate.map_or(0.0, |estimate| one.slope * (estimate.value - one.at))
        };
        asked.dependences.iter().filter(|one| one.of == of).map(change).sum()
    };
    let is_near = motion.all(|(((of, about), there), sd)| (about + on_line(of) - there).abs() <= NEAR * sd);
    let (one, other) = (&about.covariance.0, &there.covariance.0);
    is_near && (0..3).all(|i| (0..3).all(|k| (one[i][k] - other[i][k]).abs() <= 2.0 * NEAR * sds[i] * sds[k]))
}

/// Returns the values of a solution that the case has.
fn values(case: &Case, best: &Solution) -> Vec<(Parameter, f64)> {
    best.unknowns.iter().filter_map(|estimate| Some((key_of(estimate.of, case)?, estimate.value))).collect()
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
