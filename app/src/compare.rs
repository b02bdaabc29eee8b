//! The verb `compare`: variants of a case side by side, with the inputs in which they differ.

mod inputs;
mod outputs;

use std::borrow::Cow;

use planar_impact::reconstruct::Verdict;
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::Case;
use crate::control::Control;
use crate::issue::{Cause, Issue, Issues};
use crate::message::Sentence;
use crate::notice::{Notice, Notices};
use crate::reconstruct::{self, Interval, Reconstruction};
use crate::solve::{self, Solution};
use crate::units::Measure;

/// The least and the greatest number of cases.
pub const COUNT: [usize; 2] = [2, 20];

/// A case to compare.
pub struct Variant {
    /// Its name, such as its file.
    pub name: String,
    /// The case.
    pub case: Case,
}

/// Cases side by side, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CaseComparison {
    /// The cases, in the order of the call.
    pub cases: Vec<ComparedCase>,
    /// The inputs and the evidence that differ between the cases.
    pub inputs: Vec<ComparedInput>,
    /// The principal outputs.
    pub outputs: Vec<ComparedOutput>,
}

/// A case with what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparedCase {
    /// Its name, such as its file.
    pub name: String,
    /// Its title; empty if it has none.
    pub title: String,
    /// The verb that answers it: `reconstruct` where it has unknowns, else `solve`.
    pub verb: &'static str,
    /// The verdict of `reconstruct`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<&'static str>,
    /// Why it has no answer; empty if it has one, or if the verdict is the reason.
    pub refusals: Vec<ComparedRefusal>,
    /// `false` if it is refused, or if its reconstruction is no unique answer.
    pub is_answer: bool,
}

/// A reason why a case has no answer.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparedRefusal {
    /// Its code, such as `tensile`.
    pub code: &'static str,
    /// The path that it refers to; may be empty.
    pub path: String,
    /// The sentence.
    pub message: Sentence,
}

/// An input, or a piece of evidence, that differs between the cases.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparedInput {
    /// Its name; evidence has `evidence.` before it, a standard deviation ` sd` after it, and the shape and the limits of a distribution ` distribution`,
    /// ` min` and ` max`. Any other entry of a file has its path.
    pub name: String,
    /// Its value in each case; `null` where the case does not have it.
    pub values: Vec<Option<InputValue>>,
    /// Its measure.
    #[serde(skip)]
    pub measure: Measure,
}

/// The value of an input.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum InputValue {
    /// A number in SI.
    Number(f64),
    /// A word: a law, `critical`, `unknown`, or any text of the file.
    Word(Cow<'static, str>),
}

/// An output in each case.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparedOutput {
    /// Its name.
    pub name: String,
    /// Its value in each case; `null` where there is none.
    pub values: Vec<Option<f64>>,
    /// Its interval in each case that is reconstructed; `null` in the others.
    pub intervals: Vec<Option<Interval>>,
    /// Values below 10⁻¹² of this are rounding.
    #[serde(skip)]
    pub scale: f64,
    /// Its measure.
    #[serde(skip)]
    pub measure: Measure,
}

/// Answers each case, by `reconstruct` where it has unknowns and else by `solve`, and puts inputs and outputs side by side.
///
/// # Errors
///
/// Fewer than 2 cases or more than 20; everything wrong with a case. A case that the physics refuses, or for which no search converges, is part of the answer.
pub fn compare(variants: &[Variant], _: &(), control: &dyn Control) -> Result<Answer<CaseComparison>, Issues> {
    let [least, most] = COUNT;
    if !(least..=most).contains(&variants.len()) {
        let message = format!("{} cases cannot be compared: give {least} to {most}", variants.len());
        return Err(Issues::of_call(vec![Issue::of_call("CASE", message, None)]));
    }
    let mut answers = Vec::with_capacity(variants.len());
    for variant in variants {
        answers.push(Answered::of(&variant.case, control)?);
    }
    let comparison = CaseComparison {
        cases: variants.iter().zip(&answers).map(|(variant, answered)| ComparedCase::of(variant, answered)).collect(),
        inputs: inputs::differing(variants),
        outputs: outputs::of(variants, &answers),
    };
    Ok(Answer::new(&variants[0].case.title, comparison, notices(&answers)))
}

/// Returns the notices of all cases, each once, with the places of its cases before it, as in `[1, 3] `.
fn notices(answers: &[Answered]) -> Notices {
    let mut all: Vec<(&Notice, Vec<String>)> = Vec::new();
    for (place, answered) in answers.iter().enumerate() {
        for notice in answered.notices() {
            let place = (place + 1).to_string();
            match all.iter_mut().find(|(other, _)| *other == notice) {
                Some((_, places)) if places.contains(&place) => (),
                Some((_, places)) => places.push(place),
                None => all.push((notice, vec![place])),
            }
        }
    }
    let of_cases = |(notice, places): (&Notice, Vec<String>)| notice.clone().prefixed(format!("[{}] ", places.join(", ")));
    Notices(all.into_iter().map(of_cases).collect())
}

/// What became of a case.
enum Answered {
    Solved(Box<Answer<Solution>>),
    Reconstructed(Box<Answer<Reconstruction>>),
    Refused(Issues),
}

fn is_reconstructed(case: &Case) -> bool {
    !case.knowledge.unknowns.is_empty()
}

impl Answered {
    fn of(case: &Case, control: &dyn Control) -> Result<Self, Issues> {
        let answered = if is_reconstructed(case) {
            reconstruct::reconstruct(case, &reconstruct::Options::default(), control)
                .map(|answer| Answered::Reconstructed(Box::new(answer)))
        } else {
            solve::solve(case, &(), control).map(|answer| Answered::Solved(Box::new(answer)))
        };
        match answered {
            Err(issues) if issues.cause() == Cause::Physics => Ok(Answered::Refused(issues)),
            other => other,
        }
    }

    fn notices(&self) -> &[Notice] {
        match self {
            Answered::Solved(answer) => &answer.notices.0,
            Answered::Reconstructed(answer) => &answer.notices.0,
            Answered::Refused(_) => &[],
        }
    }

    /// Returns the collision that was solved or found.
    fn solution(&self) -> Option<&Solution> {
        match self {
            Answered::Solved(answer) => Some(answer),
            Answered::Reconstructed(answer) => answer.solution.as_deref(),
            Answered::Refused(_) => None,
        }
    }

    fn reconstruction(&self) -> Option<&Reconstruction> {
        match self {
            Answered::Reconstructed(answer) => Some(answer),
            _ => None,
        }
    }
}

impl ComparedCase {
    fn of(variant: &Variant, answered: &Answered) -> Self {
        let refusal =
            |issue: &Issue| ComparedRefusal { code: issue.code, path: issue.path.clone(), message: Sentence(issue.message.clone()) };
        let refusals = match answered {
            Answered::Refused(issues) => issues.list().iter().map(refusal).collect(),
            Answered::Reconstructed(answer) => open_unknowns(answer),
            Answered::Solved(_) => Vec::new(),
        };
        ComparedCase {
            name: variant.name.clone(),
            title: variant.case.title.clone(),
            verb: if is_reconstructed(&variant.case) { "reconstruct" } else { "solve" },
            verdict: answered.reconstruction().map(|found| found.verdict),
            is_answer: !matches!(answered, Answered::Refused(_)) && answered.reconstruction().is_none_or(|found| found.is_answer),
            refusals,
        }
    }
}

/// Returns why a reconstruction is no unique answer although the evidence agrees with it: the unknowns that it does not narrow down.
fn open_unknowns(found: &Reconstruction) -> Vec<ComparedRefusal> {
    let message = || Sentence("its interval is no narrower than its bounds, so the evidence does not determine it".to_owned().into());
    let reason = |path: &str| ComparedRefusal { code: "not-narrowed", path: path.to_owned(), message: message() };
    if found.status == Verdict::Agrees { found.not_narrowed().map(reason).collect() } else { Vec::new() }
}

impl ComparedCase {
    /// Returns `true` if it is refused, and so has no outputs; a reconstruction that is no unique answer has some.
    pub fn is_refused(&self) -> bool {
        self.verdict.is_none() && !self.refusals.is_empty()
    }
}

impl CaseComparison {
    /// Returns `true` if every case has an answer.
    pub fn is_complete(&self) -> bool {
        self.cases.iter().all(|case| case.is_answer)
    }
}
