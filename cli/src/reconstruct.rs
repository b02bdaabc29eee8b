//! The verb `reconstruct`: from what is left after the crash to how it happened, and how sure that is.

mod diagnostics;
mod document;
mod from_rest;
mod question;
mod text;
mod unsolved;
mod wording;

use planar_impact::reconstruct::diagnosis::Finding;
use planar_impact::reconstruct::{Answer, Estimate, Fitted, Measurable, Search, Solution, Unknown, Variable, Verdict};

use crate::Done;
use crate::arguments::{Format, Reconstruct as Call};
use crate::case::{Case, Parameter};
use crate::crash3::Comparison;
use crate::exit::Failure;
use crate::units::Units;
use question::{Question, key_of};

/// Reads the case, searches for the unknowns and prints every solution with what it is worth.
///
/// # Errors
///
/// Everything wrong with the file or the question, or why no search converges.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read_with_unknowns(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let question = Question::of(&case, units)?;
    let search = Search { starts: call.starts as usize, seed: call.seed, ..Search::default() };
    let answer = question.asked.solve(&search).map_err(|unsolved| unsolved::failure(&question, &unsolved, units))?;
    let result = Reconstructed::of(question, answer, search, units);
    let text = match call.format {
        Format::Text => text::render(&result, units),
        Format::Json => {
            let text = serde_json::to_string_pretty(&document::Document::of(&result)).map_err(|error| Failure::Data(error.to_string()))?;
            text + "\n"
        }
    };
    Ok(if result.verdict() == Verdict::Agrees { Done::with(text) } else { Done::without_agreement(text) })
}

/// The question, its answer and what follows from the best solution.
struct Reconstructed {
    question: Question,
    answer: Answer,
    search: Search,
    /// The case with the best solution in it.
    solved: Case,
    /// What to look at first.
    findings: Vec<Finding>,
    /// What CRASH3 makes of the same evidence.
    crash3: Option<Comparison>,
    notes: Vec<String>,
}

impl Reconstructed {
    fn of(question: Question, answer: Answer, search: Search, units: Units) -> Self {
        let solved = solved(&question.case, answer.best());
        let mut notes = question.notes.clone();
        let (mut findings, mut crash3) = (Vec::new(), None);
        // Where an unknown is open, the best is one of many.
        if answer.verdict != Verdict::Undetermined {
            findings = diagnostics::of(&question, &solved, answer.best());
            crash3 = through_crash3(&solved, answer.best(), units, &mut notes);
            notes.extend(solved.cautions(&answer.best().impact));
        }
        Reconstructed { question, answer, search, solved, findings, crash3, notes }
    }

    /// What the answer is worth. Of vehicles that could have separated in other ways it is one of several.
    fn verdict(&self) -> Verdict {
        match self.answer.verdict {
            Verdict::Agrees if self.question.has_other_separations => Verdict::SeveralSolutions,
            verdict => verdict,
        }
    }

    /// Whether the numbers of the best solution stand for something, if only for the least disagreement.
    fn has_solution(&self) -> bool {
        self.answer.verdict != Verdict::Undetermined
    }

    /// The piece of evidence, or the prior, that the best solution is furthest off, in standard deviations.
    fn furthest(&self) -> Option<(&Fitted, f64)> {
        let best = self.answer.best();
        let off = |fitted| Fitted::standardised_residual(fitted).map(|residual| (fitted, residual));
        let all = best.evidence.iter().chain(&best.priors).filter_map(off);
        all.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))
    }

    /// What the search has for an unknown beforehand.
    fn unknown(&self, of: Variable) -> Option<&Unknown> {
        self.question.asked.unknowns.iter().find(|unknown| unknown.of == of)
    }
}

/// The case with a solution in it.
fn solved(case: &Case, solution: &Solution) -> Case {
    let value = |estimate: &Estimate| Some((key_of(estimate.of, case)?, estimate.value));
    let values: Vec<(Parameter, f64)> = solution.unknowns.iter().filter_map(value).collect();
    case.with_collision(&values, solution.collision)
}

/// What CRASH3 makes of the crush of every vehicle, or else of the crush energy that the evidence has or the solution.
fn through_crash3(solved: &Case, best: &Solution, units: Units, notes: &mut Vec<String>) -> Option<Comparison> {
    let parties = [&solved.collision.one, &solved.collision.two];
    let has_crush = (0..2).all(|i| parties[i].vehicle().is_none() || solved.setup.crush[i].is_some());
    let comparison = if has_crush {
        Comparison::of(solved, units).ok()
    } else {
        let given = best.evidence.iter().find(|fitted| fitted.of == Measurable::CrushEnergy);
        let energy = given.map_or(-best.impact.work.n, |fitted| fitted.given);
        if given.is_none() {
            notes.push("CRASH3 starts from a crush energy, and the evidence has none: it is given that of the solution".to_owned());
        }
        Some(Comparison::of_energy(solved, energy, units))
    };
    match &comparison {
        None => notes.push("CRASH3 has nothing to say: no push brings the vehicles to a common velocity".to_owned()),
        Some(comparison) => notes.extend(comparison.notes().iter().map(|note| format!("CRASH3: {note}"))),
    }
    comparison.filter(|comparison| !comparison.is_empty())
}
