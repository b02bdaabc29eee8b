//! The verb `compare`: variants of a case side by side, with the inputs in which they differ.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use planar_impact::reconstruct::{Uncertainty, Verdict};
use planar_impact::{Distribution, ImpulseRatio, Input, Side};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, EntryValue, Parameter, UncertainInput, parameter_of};
use crate::control::Control;
use crate::issue::{Cause, Issue, Issues};
use crate::message::Sentence;
use crate::notice::{Notice, Notices};
use crate::reconstruct::{self, Interval, Reconstruction};
use crate::solve::{self, Solution, TangentialLaw, Vehicle};
use crate::units::{Measure, beyond_rounding};

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
        inputs: differing_inputs(variants),
        outputs: outputs(variants, &answers),
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

/// A row of the inputs of one case.
struct Row {
    name: String,
    measure: Measure,
    value: InputValue,
    /// Differences below 10⁻¹² of this are rounding.
    scale: f64,
}

impl Row {
    fn number(name: String, measure: Measure, value: f64) -> Row {
        Row { name, measure, value: InputValue::Number(value), scale: value.abs() }
    }

    fn word(name: String, word: impl Into<Cow<'static, str>>) -> Row {
        Row { name, measure: Measure::Ratio, value: InputValue::Word(word.into()), scale: 0.0 }
    }
}

/// What follows the name of an input in the row of the shape of its distribution.
const SHAPE: &str = " distribution";

/// The rows of a case: its inputs, its evidence, and every other entry of its file.
fn rows(case: &Case, keys: &[Parameter]) -> Vec<Row> {
    let sought: Vec<Parameter> =
        case.knowledge.unknowns.iter().filter_map(|unknown| unknown.called.or_else(|| parameter_of(unknown.of))).collect();
    let is_sought = |key: Parameter| match key {
        Parameter::Input(Input::VelocityX(side) | Input::VelocityY(side)) => {
            sought.contains(&key) || sought.contains(&Parameter::Speed(side))
        }
        Parameter::Input(Input::YawInertia(side)) => sought.contains(&key) || sought.contains(&Parameter::RadiusOfGyration(side)),
        _ => sought.contains(&key),
    };
    let mut all = Vec::new();
    for &key in keys {
        if is_sought(key) {
            all.push(Row::word(key.to_string(), "unknown"));
            // What stands where the unknown would be given is the start of its search too.
            if let Some(start) = case.inputs.value(key).ok().filter(|_| sought.contains(&key)) {
                let row = Row::number(format!("unknown.{key}.start"), key.measure(), start);
                all.push(Row { scale: scale(case, key).max(row.scale), ..row });
            }
        } else if key == Parameter::Input(Input::ImpulseRatio) && case.inputs.contact.impulse_ratio == ImpulseRatio::Critical {
            all.push(Row::word(key.to_string(), "critical"));
        } else if let Ok(value) = case.inputs.value(key) {
            let row = Row::number(key.to_string(), key.measure(), value);
            all.push(Row { scale: scale(case, key).max(row.scale), ..row });
        } else {
            continue;
        }
        if let Some(uncertain) = case.uncertain.of(key) {
            all.extend(of_distribution(uncertain));
        }
    }
    let law = match case.inputs.contact.law.into() {
        TangentialLaw::Brach => "brach",
        TangentialLaw::KudlichSlibar => "kudlich-slibar",
    };
    all.push(Row::word("contact.tangential_law".to_owned(), law));
    if case.model.is_momentum() {
        all.push(Row::word("contact.model".to_owned(), "momentum"));
    }
    for known in &case.knowledge.evidence {
        let (name, measure) = (format!("evidence.{}", known.of.name()), known.of.measure());
        all.push(Row::number(name.clone(), measure, known.value));
        match known.uncertainty {
            Uncertainty::StandardDeviation(sd) => all.push(Row::number(format!("{name} sd"), measure, sd)),
            Uncertainty::Resolution(step) => all.push(Row::number(format!("{name} resolution"), measure, step)),
            Uncertainty::Exact => (),
        }
    }
    // A word such as a law or `critical` is among the inputs.
    let named: HashSet<String> = all.iter().map(|row| row.name.clone()).collect();
    let further = case.further_entries().into_iter().filter(|entry| !named.contains(&entry.name));
    all.extend(further.map(|entry| match entry.value {
        EntryValue::Number(value, measure) => Row::number(entry.name, measure, value),
        EntryValue::Word(word) => Row::word(entry.name, word),
    }));
    all
}

/// Returns the size that the rounding of an input goes by: of a component of a velocity it is the speed.
fn scale(case: &Case, key: Parameter) -> f64 {
    match key {
        Parameter::Input(Input::VelocityX(side) | Input::VelocityY(side)) => {
            let component = |input: fn(Side) -> Input| case.inputs.value(Parameter::Input(input(side))).unwrap_or(0.0);
            component(Input::VelocityX).abs().max(component(Input::VelocityY).abs())
        }
        _ => 0.0,
    }
}

/// Returns the rows of the distribution of an input: its standard deviation, its shape, and the limits that a shape has.
fn of_distribution(uncertain: &UncertainInput) -> Vec<Row> {
    let (name, measure) = (uncertain.parameter.to_string(), uncertain.parameter.measure());
    let shape = match uncertain.distribution {
        _ if uncertain.values.is_some() => "measured values",
        Distribution::Normal { .. } => "normal",
        Distribution::TruncatedNormal { .. } => "truncated normal",
        Distribution::Uniform { .. } => "uniform",
        Distribution::Triangular { .. } => "triangular",
        Distribution::LogNormal { .. } => "log-normal",
        Distribution::StudentT { .. } => "Student's t",
        _ => "another",
    };
    let mut rows =
        vec![Row::number(format!("{name} sd"), measure, uncertain.distribution.sd()), Row::word(format!("{name}{SHAPE}"), shape)];
    if let Distribution::TruncatedNormal { min, max, .. } | Distribution::Uniform { min, max } | Distribution::Triangular { min, max, .. } =
        uncertain.distribution
    {
        rows.extend([("min", min), ("max", max)].map(|(end, value)| Row::number(format!("{name} {end}"), measure, value)));
    }
    rows
}

/// A row of all cases.
struct MergedRow {
    input: ComparedInput,
    /// Differences below 10⁻¹² of this are rounding.
    scale: f64,
    /// The place of the row of the first case that it follows, or of its own there; then the case that has it first, and its place there.
    order: [usize; 3],
}

/// Returns the inputs and the other entries that are not the same in all cases, in the order of the first case. What it does not have follows what is before it
/// in the first case that has it.
fn differing_inputs(variants: &[Variant]) -> Vec<ComparedInput> {
    // A key of one file may follow from other keys of another.
    let mut keys: Vec<Parameter> = Vec::new();
    let ratio = Parameter::Input(Input::ImpulseRatio);
    for key in variants.iter().flat_map(|variant| variant.case.inputs.keys()).chain([ratio]) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let mut all: Vec<MergedRow> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for (case, variant) in variants.iter().enumerate() {
        let mut after = 0;
        for (place, Row { name, measure, value, scale }) in rows(&variant.case, &keys).into_iter().enumerate() {
            let at = *places.entry(name).or_insert_with_key(|name| {
                let input = ComparedInput { name: name.clone(), values: vec![None; variants.len()], measure };
                all.push(MergedRow { input, scale: 0.0, order: [if case == 0 { place } else { after }, case, place] });
                all.len() - 1
            });
            let merged = &mut all[at];
            // A word has no measure.
            if matches!(value, InputValue::Number(_)) {
                merged.input.measure = measure;
            }
            merged.input.values[case] = Some(value);
            merged.scale = merged.scale.max(scale);
            after = merged.order[0];
        }
    }
    all.sort_by_key(|row| row.order);
    all.into_iter().filter(|row| differs(&row.input, row.scale)).map(|row| row.input).collect()
}

/// Returns `true` if the values of an input differ by more than rounding. Where an input is certain in a case, its other rows say so.
fn differs(input: &ComparedInput, scale: f64) -> bool {
    let is_shape = input.name.ends_with(SHAPE);
    let is_same = |one: &Option<InputValue>, other: &Option<InputValue>| match (one, other) {
        (Some(InputValue::Number(one)), Some(InputValue::Number(other))) => {
            one.total_cmp(other).is_eq() || beyond_rounding(one - other, scale) == 0.0
        }
        (None, Some(_)) | (Some(_), None) => is_shape,
        _ => one == other,
    };
    let first = input.values.iter().find(|value| value.is_some() || !is_shape);
    first.is_some_and(|first| !input.values.iter().all(|value| is_same(first, value)))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_differ_by_more_than_rounding_of_their_scale() {
        let of = |one: f64, other: f64, scale: f64| {
            let values = [one, other].map(|value| Some(InputValue::Number(value))).to_vec();
            differs(&ComparedInput { name: "vehicle.1.mass".to_owned(), values, measure: Measure::Mass }, scale)
        };
        for scale in [1e-3, 1.0, 2e3] {
            assert!(!of(scale, scale * (1.0 + 4e-13), scale), "{scale}");
            assert!(of(scale, scale * (1.0 + 4e-12), scale), "{scale}");
        }
        // Beside a scale of zero only equal numbers are the same.
        assert!(!of(1e-300, 1e-300, 0.0) && of(1e-300, 2e-300, 0.0));
    }
}
