//! The search for the solution about which separations from rest positions are followed.

use planar_impact::post_impact::Separation;
use planar_impact::reconstruct::{Answer, Dependence, Estimate, Measurand, ReconstructionProblem, Solution, SolveError, Unknown, Verdict};
use planar_impact::{Motion, Side};

use super::by_friction::{are_alike, growing_errors, motions_by_friction, with_friction_at};
use super::dependences::is_followed;
use super::doubts::reconciled;
use super::followed::Followed;
use super::from_rest::{SeparationFromRest, Separations, key, outputs};
use super::question::{Question, name_in, values_of};
use super::rolled::{self, Rolled};
use super::solve_error;
use crate::case::{Case, Inputs, vehicle_number};
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::units::Measure;

/// Largest number of times that separations are followed anew, about the solution that the ones before lead to.
const MOST: usize = 20;
/// Largest number of times that errors by the friction are weighed anew.
const MOST_WEIGHTS: usize = 4;
/// Largest number of times that separations on wheels that roll are taken about the fitted motion.
const MOST_ROLLED: usize = 8;
/// Standard deviations, and shares of a covariance, that do not matter.
const NEAR: f64 = 0.01;

/// Solves the question of a case whose vehicles separated in a certain way. What separations follow is taken about the solution: that about the values of the case leads
/// there, within the reach of first order, and from there again. Returns the question about the solution, its answer, and the separations there.
///
/// Where chance hardly explains the best fit, motions elsewhere that lead near the rest position on wheels that roll are tried too, and those that fit best count.
///
/// # Errors
///
/// Those of the question and of the search, and a separation that cannot be followed to a solution.
pub fn solved(
    case: &Case,
    separations: &Separations,
    question: Question,
    solve: &Solve<'_>,
    control: &dyn Control,
) -> Result<Solved, Issues> {
    /// Probability of chi-square below which motions elsewhere are looked for: less often than in one case of twenty without need.
    const IMPROBABLE: f64 = 0.05;
    let mut best = solved_from(case, separations, separations.clone(), [None, None], question, solve)?;
    if best.1.best().probability >= IMPROBABLE {
        return Ok(best);
    }
    for from in rolled::elsewhere(case, separations, control)? {
        let weighed = rolled::about(case, separations, &from);
        let question = Question::about(case, &case.inputs, &weighed);
        let other = question.and_then(|question| solved_from(case, separations, weighed, from, question, solve));
        // A way that leads to no answer is none.
        best = match other {
            Ok(other) if other.1.best().chi_square < best.1.best().chi_square => other,
            _ => best,
        };
        control.proceed(0, 1)?;
    }
    Ok(best)
}

/// A search for the unknowns of a problem.
type Solve<'a> = dyn Fn(&ReconstructionProblem) -> Result<Answer, SolveError> + 'a;
/// The question about a solution, its answer, and the separations there.
type Solved = (Question, Answer, Separations);

/// The same from one beginning: the motions that separations on wheels that roll are at first taken about, and what these are about them.
fn solved_from(
    case: &Case,
    separations: &Separations,
    mut weighed: Separations,
    mut from: [Option<Motion>; 2],
    mut question: Question,
    solve: &Solve<'_>,
) -> Result<Solved, Issues> {
    let mut about = separations.clone();
    for tries in 1..=MOST {
        let asked = within_reach(&question.asked);
        let answer = solve(&asked).map_err(|unsolved| solve_error::issues(&question, &unsolved))?;
        let inputs = case.inputs.set_all(&values_of(case, answer.best()));
        let Some(there) = moved(case, &inputs, &about, &question.asked) else { break };
        let is_in_reach = |solution: &Solution| solution.unknowns.iter().all(|estimate| is_inside(estimate, &asked, &question.asked));
        let is_about = |side: Side| {
            let [about, there] = [&about, &there].map(|separations| separations[side as usize].as_ref());
            !is_followed(&question.asked, side)
                || about.zip(there).is_some_and(|(about, there)| is_alike(&question.asked, answer.best(), side, about, there))
        };
        let motions = motions_by_friction(&question.asked, answer.best(), &weighed);
        let gyrations = question.asked.collision.parties().map(|party| party.vehicle().map_or(0.0, |vehicle| vehicle.radius_of_gyration()));
        let rolled = if tries <= MOST_ROLLED { Rolled::of(case, &inputs, &about, &from, &motions) } else { [None, None] };
        let weigh = |separations: &Separations| {
            let [one, two] = with_friction_at(separations, &motions, gyrations);
            let [on_one, on_two] = rolled.each_ref().map(|rolled| Some(rolled.as_ref()?.separation.clone()));
            [on_one.or(one), on_two.or(two)]
        };
        let next = weigh(&about);
        let is_settled = |side: Side| {
            let is_alike = || are_alike(next[side as usize].as_ref(), weighed[side as usize].as_ref());
            match &rolled[side as usize] {
                Some(rolled) => rolled.is_fitted && is_alike(),
                // Where the evidence contradicts itself, no motion is one to weigh at.
                None if from[side as usize].is_some() => false,
                None => tries > MOST_WEIGHTS || answer.verdict == Verdict::Contradicted || is_alike(),
            }
        };
        let is_weighed = tries > MOST_ROLLED + 1 || Side::ALL.into_iter().all(is_settled);
        if is_in_reach(answer.best()) && Side::ALL.into_iter().all(is_about) && is_weighed {
            let answer = without(answer, |solution| !is_in_reach(solution));
            let growing = growing_errors(&question.asked, &about, &weighed, gyrations);
            let ask = |about: &Separations| Question::about(case, &inputs, &with_fits_of(&weighed, about));
            let (mut question, answer, about) = reconciled(case, &inputs, question, answer, about, &ask)?;
            question.asked.growing_error = growing;
            // Those that lead to the rest positions are shown.
            let mut shown = with_fits_of(&weighed, &about);
            for side in Side::ALL {
                let place = side as usize;
                let Some(at_rest) = about[place].as_ref().filter(|_| from[place].is_some() || rolled[place].is_some()) else { continue };
                shown[place] = Some(at_rest.clone());
                if let Some(rolled) = &rolled[place] {
                    question.about_fit[place] = true;
                    question.notices.0.extend(rolled.notice(side, at_rest));
                }
            }
            question.separations = SeparationFromRest::of(case, &shown);
            return Ok((question, answer, about));
        }
        weighed = weigh(&there);
        from = rolled.each_ref().map(|rolled| Some(rolled.as_ref()?.about));
        question = Question::about(case, &inputs, &weighed)?;
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

/// Returns the separations with the fits of others.
fn with_fits_of(separations: &Separations, others: &Separations) -> Separations {
    let mut all = separations.clone();
    for (one, other) in all.iter_mut().zip(others) {
        if let (Some(one), Some(other)) = (one, other) {
            one.fit.clone_from(&other.fit);
        }
    }
    all
}

/// Returns `true` if a separation at a solution is that of the evidence there, with its covariance.
fn is_alike(asked: &ReconstructionProblem, best: &Solution, side: Side, about: &Separation, there: &Separation) -> bool {
    let sds = there.covariance.deviations();
    let mut motion = outputs(side).into_iter().zip(about.motion.components()).zip(there.motion.components()).zip(sds);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;

    /// The evidence of a case with a bound that excludes the solution.
    fn excluded() -> Answer {
        let text = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n\
                    [contact]\ncrush_plane = 0\nrestitution = 0\n[evidence]\nW_n = \"-75 kJ ± 1 kJ\"\n[unknown]\nvehicle.1.speed = { start = 5, min = 0, max = 6 }\n";
        let case = Case::parse(Source::new("case.toml", text)).unwrap_or_else(|issues| panic!("{issues}"));
        let question = Question::of(&case, &[None, None]).unwrap_or_else(|issues| panic!("{issues}"));
        question.asked.solve(&planar_impact::reconstruct::Search::default()).expect("an answer")
    }

    #[test]
    fn a_value_on_a_bound_is_near_it() {
        assert!(near(0.0, 0.0) && near(9e-7, 0.0) && !near(2e-6, 0.0));
        assert!(near(-50.00004, -50.0) && !near(-50.0001, -50.0) && !near(50.0, -50.0));
    }

    #[test]
    fn a_solution_without_bounds_counts_where_separations_are_followed() {
        let answer = excluded();
        assert!(answer.verdict == Verdict::BoundsExclude && answer.without_bounds.is_some());
        assert_eq!(without(answer.clone(), |_| false), answer);
        let best = answer.best().clone();
        let without_it = without(answer, |solution| *solution != best);
        assert_eq!((without_it.verdict, without_it.without_bounds), (Verdict::Contradicted, None));
    }
}
