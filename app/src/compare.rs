//! The verb `compare`: variants of a case side by side, with the inputs in which they differ.

use planar_impact::reconstruct::Uncertainty;
use planar_impact::{ImpulseRatio, Input};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, Parameter, parameter_of};
use crate::control::Control;
use crate::issue::{Cause, Issue, Issues};
use crate::message::Sentence;
use crate::notice::{Notice, Notices};
use crate::reconstruct::{self, Interval, Reconstruction};
use crate::solve::{self, Solution, TangentialLaw, Vehicle};
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
    /// Why it has no answer; empty if it has one.
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
    /// Its name; evidence has `evidence.` before it, and a standard deviation ` sd` after it.
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
    /// A word: a law, `critical`, `unknown`.
    Word(&'static str),
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
    let mut notices = Vec::new();
    for variant in variants {
        let answered = Answered::of(&variant.case, control)?;
        // What is said of each case in turn, once.
        for notice in answered.notices() {
            if !notices.contains(notice) {
                notices.push(notice.clone());
            }
        }
        answers.push(answered);
    }
    let comparison = CaseComparison {
        cases: variants.iter().zip(&answers).map(|(variant, answered)| ComparedCase::of(variant, answered)).collect(),
        inputs: differing_inputs(variants),
        outputs: outputs(variants, &answers),
    };
    Ok(Answer::new(&variants[0].case.title, comparison, Notices(notices)))
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
            _ => Vec::new(),
        };
        ComparedCase {
            name: variant.name.clone(),
            title: variant.case.title.clone(),
            verb: if is_reconstructed(&variant.case) { "reconstruct" } else { "solve" },
            verdict: answered.reconstruction().map(|found| found.verdict),
            is_answer: refusals.is_empty() && answered.reconstruction().is_none_or(|found| found.is_answer),
            refusals,
        }
    }
}

impl CaseComparison {
    /// Returns `true` if every case has an answer.
    pub fn is_complete(&self) -> bool {
        self.cases.iter().all(|case| case.is_answer)
    }
}

/// The inputs of a case: name, measure and value, in file order.
fn inputs(case: &Case, keys: &[Parameter]) -> Vec<(String, Measure, InputValue)> {
    let sought: Vec<Parameter> =
        case.knowledge.unknowns.iter().filter_map(|unknown| unknown.called.or_else(|| parameter_of(unknown.of))).collect();
    let mut all = Vec::new();
    for &key in keys {
        let value = if sought.contains(&key) {
            InputValue::Word("unknown")
        } else if key == Parameter::Input(Input::ImpulseRatio) && case.inputs.contact.impulse_ratio == ImpulseRatio::Critical {
            InputValue::Word("critical")
        } else if let Ok(value) = case.inputs.value(key) {
            InputValue::Number(value)
        } else {
            continue;
        };
        all.push((key.to_string(), key.measure(), value));
        if let Some(uncertain) = case.uncertain.of(key) {
            all.push((format!("{key} sd"), key.measure(), InputValue::Number(uncertain.distribution.sd())));
        }
    }
    let law = match case.inputs.contact.law.into() {
        TangentialLaw::Brach => "brach",
        TangentialLaw::KudlichSlibar => "kudlich-slibar",
    };
    all.push(("contact.tangential_law".to_owned(), Measure::Ratio, InputValue::Word(law)));
    if case.model.is_momentum() {
        all.push(("contact.model".to_owned(), Measure::Ratio, InputValue::Word("momentum")));
    }
    for known in &case.knowledge.evidence {
        let (name, measure) = (format!("evidence.{}", known.of.name()), known.of.measure());
        all.push((name.clone(), measure, InputValue::Number(known.value)));
        match known.uncertainty {
            Uncertainty::StandardDeviation(sd) => all.push((format!("{name} sd"), measure, InputValue::Number(sd))),
            Uncertainty::Resolution(step) => all.push((format!("{name} resolution"), measure, InputValue::Number(step))),
            Uncertainty::Exact => (),
        }
    }
    all
}

/// Returns the inputs that are not the same in all cases, in the order in which the cases have them.
fn differing_inputs(variants: &[Variant]) -> Vec<ComparedInput> {
    // A key of one file may follow from other keys of another.
    let mut keys: Vec<Parameter> = Vec::new();
    let ratio = Parameter::Input(Input::ImpulseRatio);
    for key in variants.iter().flat_map(|variant| variant.case.inputs.keys()).chain([ratio]) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let of_cases: Vec<_> = variants.iter().map(|variant| inputs(&variant.case, &keys)).collect();
    let mut all: Vec<ComparedInput> = Vec::new();
    for (place, of_case) in of_cases.into_iter().enumerate() {
        for (name, measure, value) in of_case {
            let at = all.iter().position(|input| input.name == name).unwrap_or_else(|| {
                all.push(ComparedInput { name, values: vec![None; variants.len()], measure });
                all.len() - 1
            });
            all[at].values[place] = Some(value);
        }
    }
    all.retain(|input| input.values.iter().any(|value| *value != input.values[0]));
    all
}

/// A principal output: its name, its measure, and its value in a collision.
type PrincipalOutput = (&'static str, Measure, fn(&Solution) -> Option<f64>);

fn of_vehicle(solution: &Solution, place: usize, value: impl Fn(&Vehicle) -> f64) -> Option<f64> {
    Some(&solution.vehicles[place]).filter(|vehicle| !vehicle.barrier).map(value)
}

/// The principal outputs, those of which a reconstruction has an interval by their names there.
const OUTPUTS: [PrincipalOutput; 13] = [
    ("vehicle.1.delta_v_magnitude", Measure::Speed, |of| of_vehicle(of, 0, |vehicle| vehicle.delta_v_magnitude)),
    ("vehicle.2.delta_v_magnitude", Measure::Speed, |of| of_vehicle(of, 1, |vehicle| vehicle.delta_v_magnitude)),
    ("vehicle.1.pdof", Measure::Angle, |of| of_vehicle(of, 0, |vehicle| vehicle.pdof)),
    ("vehicle.2.pdof", Measure::Angle, |of| of_vehicle(of, 1, |vehicle| vehicle.pdof)),
    ("result.vehicle.1.yaw_rate", Measure::YawRate, |of| of_vehicle(of, 0, |vehicle| vehicle.yaw_rate)),
    ("result.vehicle.2.yaw_rate", Measure::YawRate, |of| of_vehicle(of, 1, |vehicle| vehicle.yaw_rate)),
    ("contact.impulse.normal", Measure::Impulse, |of| Some(of.contact.impulse.normal)),
    ("contact.impulse.tangential", Measure::Impulse, |of| Some(of.contact.impulse.tangential)),
    ("result.contact.impulse_ratio", Measure::Ratio, |of| Some(of.contact.impulse_ratio)),
    ("contact.critical_impulse_ratio", Measure::Ratio, |of| Some(of.contact.critical_impulse_ratio)),
    ("energy.normal_work", Measure::Energy, |of| Some(of.energy.normal_work)),
    ("energy.tangential_work", Measure::Energy, |of| Some(of.energy.tangential_work)),
    ("energy.loss", Measure::Energy, |of| Some(of.energy.loss)),
];

/// Returns the unknowns of the reconstructions, of which a solved case has its given value, then the principal outputs; without those that no case has.
fn outputs(variants: &[Variant], answers: &[Answered]) -> Vec<ComparedOutput> {
    let mut unknowns: Vec<(&str, Measure)> = Vec::new();
    for (name, unknown) in answers.iter().filter_map(Answered::reconstruction).flat_map(|found| found.unknown.iter()) {
        if !unknowns.iter().any(|(known, _)| *known == name) {
            unknowns.push((name, unknown.measure));
        }
    }
    let of_unknown = |(name, measure): (&str, Measure)| {
        let found = |answered: &Answered| answered.reconstruction()?.unknown.get(name).cloned();
        let given = |case: &Case| Parameter::named(name).and_then(|parameter| case.inputs.value(parameter).ok());
        let value = |(variant, answered): (&Variant, &Answered)| match answered {
            Answered::Solved(_) => given(&variant.case),
            _ => found(answered)?.value,
        };
        let values = variants.iter().zip(answers).map(value).collect();
        let intervals = answers.iter().map(|answered| found(answered).map(|unknown| unknown.interval)).collect();
        ComparedOutput { name: name.to_owned(), values, intervals, scale: 0.0, measure }
    };
    let of_output = |(name, measure, value): PrincipalOutput| {
        let plain = name.strip_prefix("result.").unwrap_or(name);
        let interval = |answered: &Answered| Some(answered.reconstruction()?.derived.get(plain)?.interval.clone());
        let solutions = || answers.iter().map(Answered::solution);
        ComparedOutput {
            name: name.to_owned(),
            values: solutions().map(|solution| solution.and_then(value).filter(|value| value.is_finite())).collect(),
            intervals: answers.iter().map(interval).collect(),
            scale: solutions().flatten().map(|solution| solution.scale(measure)).fold(0.0, f64::max),
            measure,
        }
    };
    let all = unknowns.into_iter().map(of_unknown).chain(OUTPUTS.into_iter().map(of_output));
    all.filter(|output| output.values.iter().any(Option::is_some) || output.intervals.iter().any(Option::is_some)).collect()
}
