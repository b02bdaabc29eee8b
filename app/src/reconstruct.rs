//! The verb `reconstruct`: determines the collision from evidence, with the uncertainty of the answer.

mod about_solution;
mod answer;
mod by_friction;
mod crush_bend;
mod dependences;
pub mod diagnostics;
mod doubts;
mod estimated;
mod followed;
mod from_crush;
mod from_rest;
mod from_skids;
mod guaranteed;
mod inputs;
mod levels;
mod posterior;
mod question;
mod rolled;
mod slides;
mod slips;
mod solve_error;
mod solved;
mod statement;

use planar_impact::momentum::approach_speeds;
use planar_impact::reconstruct::{
    Answer as Found, Measurand, ReconstructionProblem, Sampling, Search, Solution, Variable, Verdict, by_chi_square,
};
use planar_impact::{Impact, Input, Output, Side};

use crate::answer::Answer;
use crate::case::{Case, Parameter};
use crate::control::{Control, Uncontrolled};
use crate::crash3::Comparison;
use crate::issue::{Cause, Issues};
use crate::message::Message;
use crate::notice::Notice;
use crate::scene::Scene;
use crate::uncertainty::wrong_bounds_sd;
use crate::units::Measure;
use from_rest::Separations;
use posterior::Drawn;
use question::{Question, name_in, values_of};
use solved::{Height, Solved};
use statement::Statement;

pub use answer::{Alternative, Derived, Evidence, FurthestOff, Influence, Interval, ProfileLevel, Reconstruction, Unknown};
pub use estimated::Estimated;
pub use from_rest::{SeparationFromRest, SlideFit};
pub use guaranteed::Guaranteed;
pub use posterior::{Draws, PairDensity, Posterior, PosteriorDensity};

/// Options of the search, and what is asked of the posterior.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Number of starts: the first is given, the others are drawn within the bounds.
    pub starts: usize,
    /// The seed of those draws, and of those of the posterior.
    pub seed: u64,
    /// The level of confidence of the intervals, and the probability of the ranges of the posterior.
    pub level: f64,
    /// `true` for the profile of the likelihood of each unknown and of what follows from them.
    pub profile: bool,
    /// `true` for the guaranteed range of each unknown.
    pub guaranteed: bool,
    /// Standard deviations at which a guaranteed range ends evidence and inputs without limits.
    pub bounds_sd: f64,
    /// `true` to draw from the posterior.
    pub posterior: bool,
    /// Statements whose probability under the posterior is wanted, such as `vehicle.1.speed > 50 km/h`. With any, the posterior is drawn.
    pub probabilities: Vec<String>,
    /// `true` to return the values of each draw.
    pub draws: bool,
}

impl Options {
    fn draws_from_posterior(&self) -> bool {
        self.posterior || self.draws || !self.probabilities.is_empty()
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            starts: 64,
            seed: 1,
            level: 0.95,
            profile: false,
            guaranteed: false,
            bounds_sd: 3.0,
            posterior: false,
            probabilities: Vec::new(),
            draws: false,
        }
    }
}

/// Searches for the unknowns of a case.
///
/// # Errors
///
/// Everything wrong with the question, or why no search converges.
pub fn reconstruct(case: &Case, options: &Options, control: &dyn Control) -> Result<Answer<Reconstruction>, Issues> {
    control.proceed(0, 1)?;
    if let Some(issue) = wrong_bounds_sd(options.bounds_sd) {
        return Err(Issues::of_call(vec![issue]));
    }
    case.needs_one_restitution()?;
    if case.rest.is_some() {
        // A search for slides may take minutes: faults that do not depend on it are reported first.
        let question = Question::of(case, &[None, None])?;
        solve_error::check_with_any_evidence(&question)?;
        Statement::read_all(&options.probabilities, &question)?;
    }
    let (combinations, mut notices) = from_rest::combinations(&case.separations_from_rest(control)?);
    let mut answers: Vec<Answer<Reconstruction>> = Vec::new();
    let mut refused: Option<Issues> = None;
    for separations in &combinations {
        match by_separations(case, separations, options, control) {
            Ok(answer) => answers.push(answer),
            // What the physics refuses is no alternative.
            Err(issues) if combinations.len() > 1 && issues.cause() == Cause::Physics => {
                let message = "one of the separations that lead to the same rest positions leads to no collision";
                notices.0.push(Notice::note("separation-refused", "rest", message));
                refused.get_or_insert(issues);
            }
            Err(issues) => return Err(issues),
        }
    }
    // The sort is stable: of equally good ones the first stays first.
    answers.sort_by(|a, b| by_chi_square(a.facts.total_chi_square(), b.facts.total_chi_square()));
    let mut answers = answers.into_iter();
    let Some(mut best) = answers.next() else { return Err(refused.unwrap_or_else(|| Issues::defect("no separation was reconstructed"))) };
    let others: Vec<Reconstruction> = answers.map(|answer| answer.facts).collect();
    if !others.is_empty() {
        best.facts = best.facts.with_others(others);
        if best.facts.other_separations {
            let of = if best.facts.posterior.is_some() { "intervals, posterior and probabilities are" } else { "intervals are" };
            let message = format!("the {of} those of the first separation alone; the others fit as well, and have other speeds");
            best.notices.0.push(Notice::warning("first-separation-alone", "rest", message));
        }
    }
    best.notices.0.extend(notices.0);
    Ok(best)
}

/// Searches for the unknowns of a case whose vehicles separated in a certain way.
fn by_separations(
    case: &Case,
    separations: &Separations,
    options: &Options,
    control: &dyn Control,
) -> Result<Answer<Reconstruction>, Issues> {
    let separations = &dependences::widened(case, separations)?;
    let search = Search { starts: options.starts, seed: options.seed, ..Search::default() };
    let question = Question::of(case, separations)?;
    let statements = Statement::read_all(&options.probabilities, &question)?;
    solve_error::check(&question)?;
    let solve = |asked: &ReconstructionProblem| asked.solve_while(&search, &|done, total| control.goes_on(done, total));
    let (question, answer, there) = about_solution::solved(case, separations, question, &solve, control)?;
    let (solved, impact) = solved(&question.case, answer.best());
    let mut notices = question.notices.clone();
    notices.0.extend(statements.iter().filter_map(|statement| statement.notice.clone()));
    let (mut diagnostics, mut crash3) = (Vec::new(), None);
    if answer.is_one() {
        if question.case.model.is_momentum() {
            notices.0.extend(solved.unusual_motions());
            notices.0.extend(without_rotation(case));
        } else {
            diagnostics = diagnostics::of(&question, &solved, answer.best());
            crash3 = through_crash3(&solved, answer.best(), &mut notices.0);
            notices.0.extend(solved.warnings(&impact));
        }
    }
    notices.0.extend(slides::bends(case, &question, separations));
    notices.0.extend(without_slope(&question, answer.best()));
    if matches!(answer.verdict, Verdict::Contradicted | Verdict::BoundsExclude) {
        notices.0.extend(by_momentum(&question));
    }
    if answer.verdict == Verdict::Contradicted {
        let by_slides = slides::of_contradiction(&question, separations, answer.best());
        if by_slides.is_empty() {
            notices.0.extend(slips::of(case, separations, &question, answer.best(), &|| control.goes_on(0, 1)));
        }
        notices.0.extend(by_slides);
    }
    let derived = question.asked.derived().filter(|of| !question::has_rotation(*of, case));
    let of: Vec<Measurand> = question.asked.unknowns.iter().map(|unknown| Measurand::Variable(unknown.of)).chain(derived).collect();
    let intervals = question.asked.intervals_while(&answer, options.level, &of, &|done, total| control.goes_on(done, total));
    let intervals = intervals.ok_or_else(Issues::interrupted)?;
    notices.0.extend(dependences::bends(case, &question, answer.best(), &there, &intervals));
    notices.0.extend(levels::of_few(case, options.level));
    notices.0.extend(levels::of_uniform(case, &question, options.level));
    notices.0.extend(levels::beyond_deviations(&question.case, &intervals));
    let profile = options.profile.then(|| heights(&question, &answer, &of, control)).transpose()?;
    let guaranteed =
        if options.guaranteed { guaranteed::ranges(&question, options.bounds_sd, control, &mut notices.0)? } else { Vec::new() };
    let drawn = if options.draws_from_posterior() {
        notices.0.extend(by_friction::of_posterior(&question, separations));
        let sampling = Sampling { seed: options.seed, ..Sampling::for_level(options.level) };
        let asked = posterior::Asked { sampling, statements: &statements, level: options.level, has_values: options.draws };
        Some(Drawn::of(&question, &answer, &of, &asked, control, &mut notices.0)?)
    } else {
        None
    };
    let scene = answer.is_one().then(|| Scene::of(&solved.with_rest(case.rest.clone()), &impact));
    let solved = Solved {
        question: &question,
        answer: &answer,
        impact,
        intervals,
        level: options.level,
        profile,
        guaranteed: (guaranteed, options.bounds_sd),
        search,
        case: &solved,
        diagnostics,
        crash3,
        drawn,
    };
    let mut facts = solved.reconstruction();
    facts.scene = scene.map(|(scene, notices)| (scene.with_ranges(&facts), notices));
    Ok(Answer::new(&case.title, facts, notices))
}

/// Returns the intervals at each height of a profile.
fn heights(question: &Question, answer: &Found, of: &[Measurand], control: &dyn Control) -> Result<Vec<Height>, Issues> {
    /// Roots of the heights, which are standard deviations where the evidence is linear in the unknowns.
    const ROOTS: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0];
    let height = |(done, root): (usize, f64)| {
        let level = libm::erf(root * std::f64::consts::FRAC_1_SQRT_2);
        let goes_on = |of_height, steps| control.goes_on(done * steps + of_height, ROOTS.len() * steps);
        let intervals = question.asked.intervals_while(answer, level, of, &goes_on).ok_or_else(Issues::interrupted)?;
        Ok(Height { chi_square: root * root, level, intervals })
    };
    ROOTS.into_iter().enumerate().map(height).collect()
}

/// Returns the case with the values of a solution, and its impact. Momentum alone has no crush plane: the normal is along the impulse.
fn solved(case: &Case, solution: &Solution) -> (Case, Impact) {
    let mut values = values_of(case, solution);
    if !case.model.is_momentum() {
        return (case.with_collision(&values, solution.collision), solution.impact);
    }
    let impulse = solution.impact.impulse_on_ground;
    let collision = solution.collision.along_impulse(impulse);
    let of_contact = [(Input::CrushPlane, libm::atan2(impulse.y, impulse.x)), (Input::Restitution, collision.restitution)];
    values.extend(of_contact.map(|(input, value)| (Parameter::Input(input), value)));
    (case.with_collision(&values, collision), collision.impact_by(impulse))
}

/// Says why a best fit has no standard deviations that lies on no bound and no limit of the physics.
fn without_slope(question: &Question, best: &Solution) -> Option<Notice> {
    let is_uncertain = question.asked.evidence.iter().any(|piece| piece.uncertainty.standard_deviation().is_some());
    let lacks_sd = best.unknowns.iter().any(|estimate| estimate.is_determined && estimate.at.is_none() && estimate.sd.is_none());
    if !(is_uncertain && lacks_sd && best.limits.is_empty()) {
        return None;
    }
    let folded: Vec<String> = best.at_fold.iter().map(|of| name_in(*of, &question.case)).collect();
    let (path, place) = match &folded[..] {
        [] => ("contact.friction", "where friction begins to hold, a corner without a slope".to_owned()),
        [first, ..] => (&first[..], format!("where the evidence has an extremum along {}, without a slope", folded.join(" and "))),
    };
    let message = format!("the best fit lies {place}: standard deviations are left out, and the intervals hold");
    Some(Notice::note("no-slope", path, message))
}

/// Notes that the energies of point masses are those of translation.
fn without_rotation(case: &Case) -> Option<Notice> {
    let message = "the energies are those of translation alone: a rotation after the impact would make the loss smaller; it has no interval, and is no evidence, without `yaw_inertia` and `impact_center` of both vehicles";
    (!case.model.is_angular()).then(|| Notice::note("without-rotation", "energy", message))
}

/// Returns the speeds that momentum alone gives, if the evidence has the velocities after the impact and both speeds are unknown.
fn by_momentum(question: &Question) -> Option<Notice> {
    /// Least sine of the angle between the headings: nearly parallel ones leave one speed open.
    const LEAST: f64 = 0.05;
    let [one, two] = question.asked.collision.parties();
    let (one, two) = (one.vehicle()?, two.vehicle()?);
    let [after_1, after_2] = question.case.knowledge.separation();
    let is_unknown = |of: Variable| question.asked.unknowns.iter().any(|unknown| unknown.of == of);
    let turned = Side::ALL.into_iter().any(|side| is_unknown(Variable::Input(Input::Heading(side))));
    let apart = one.heading.cos * two.heading.sin - one.heading.sin * two.heading.cos;
    if question.case.model.is_momentum()
        || turned
        || apart.abs() < LEAST
        || !Side::ALL.into_iter().all(|side| is_unknown(Variable::Speed(side)))
    {
        return None;
    }
    let [v1, v2] = approach_speeds([one, two], [after_1?, after_2?]);
    let has_yaw_rates = question.asked.evidence.iter().any(|piece| matches!(piece.of, Measurand::Output(Output::YawRate(_))));
    let message = Message::from("momentum alone gives vehicle.1.speed ")
        .figure(Measure::RoadSpeed, v1)
        .text(" and vehicle.2.speed ")
        .figure(Measure::RoadSpeed, v2)
        .text(if has_yaw_rates {
            ", from the velocities after the impact; `model = \"momentum\"` in [contact] uses the yaw rates too, and has intervals"
        } else {
            ": `model = \"momentum\"` in [contact] has their intervals"
        });
    Some(Notice::note("by-momentum", "contact", message))
}

/// Runs CRASH3 with the crush of every vehicle, or else with the crush energy of the evidence or of the solution.
fn through_crash3(solved: &Case, best: &Solution, notices: &mut Vec<Notice>) -> Option<Comparison> {
    let parties = solved.collision.parties();
    let has_crush = (0..2).all(|i| parties[i].vehicle().is_none() || solved.setup.crush[i].is_some());
    let mut of_crash3 = Vec::new();
    let comparison = if has_crush {
        // Rest positions are evidence by now: nothing is searched for.
        Comparison::of(solved, &mut of_crash3, &Uncontrolled).ok()
    } else {
        let given = best.evidence.iter().find(|fitted| fitted.of == Measurand::CrushEnergy);
        let energy = given.map_or(-best.impact.work.n, |fitted| fitted.given);
        if given.is_none() {
            let message = "CRASH3 starts from a crush energy, and the evidence has none: that of the solution is used";
            notices.push(Notice::note("crash3-energy-of-solution", "", message));
        }
        Some(Comparison::of_energy(solved, energy, &mut of_crash3))
    };
    match &comparison {
        None => {
            let message = "CRASH3 has no answer: no push brings the vehicles to a common velocity";
            notices.push(Notice::warning("crash3-no-answer", "", message));
        }
        Some(_) => notices.extend(of_crash3.into_iter().map(|notice| notice.prefixed("CRASH3: "))),
    }
    comparison.filter(|comparison| !comparison.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::control::Noted;

    /// A search for slides takes minutes where there is none.
    #[test]
    fn a_question_is_checked_before_slides_are_searched_for() {
        let case = |more: &str| {
            let text = format!("{}\n{more}", include_str!("../../cli/examples/to-rest.toml"));
            Case::parse(Source::new("to-rest.toml", text)).expect("a case")
        };
        let unknown = "[unknown]\nvehicle.1.speed = { start = \"20 m/s\" }\nvehicle.2.speed = { start = \"10 m/s\" }\n";
        for (more, probability, code) in [("", None, "nothing-unknown"), (unknown, Some("vehicle.1.speed > 3 kg"), "call")] {
            let options = Options { probabilities: probability.map(str::to_owned).into_iter().collect(), ..Options::default() };
            let noted = Noted::default();
            let refused = reconstruct(&case(more), &options, &noted).map(|_| ()).expect_err("a wrong question");
            let codes: Vec<&str> = refused.list().iter().map(|issue| issue.code).collect();
            assert_eq!((&codes[..], noted.steps().len()), (&[code][..], 1), "{refused}");
        }
    }
}
