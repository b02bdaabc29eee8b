//! The inputs, and every other entry, in which cases differ.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use planar_impact::reconstruct::Uncertainty;
use planar_impact::{Distribution, ImpulseRatio, Input, Side};

use super::{ComparedInput, InputValue, Variant};
use crate::case::{Case, EntryValue, Parameter, UncertainInput, parameter_of};
use crate::solve::TangentialLaw;
use crate::units::{Measure, beyond_rounding};

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
    // What the file gives of a point mass beside its mass stands among the other entries.
    let is_of_point = |key: &Parameter| !case.model.is_angular() && key.is_of_extended_body();
    for key in keys.iter().copied().filter(|key| !is_of_point(key)) {
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
pub(super) fn differing(variants: &[Variant]) -> Vec<ComparedInput> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_distribution_has_its_shape_and_its_ends() {
        let rows = |distribution: Distribution, values: Option<std::sync::Arc<[f64]>>| -> Vec<(String, Option<f64>)> {
            let parameter = Parameter::Input(Input::Mass(planar_impact::Side::One));
            let key = "vehicle.1.mass".to_owned();
            let input = UncertainInput { parameter, key, nominal: 1500.0, distribution, values, is_for_95: false };
            let row = |row: Row| match row.value {
                InputValue::Number(value) => (row.name, Some(value)),
                InputValue::Word(word) => (format!("{}: {word}", row.name), None),
            };
            of_distribution(&input).into_iter().map(row).collect()
        };
        let (mean, sd, min, max) = (1500.0, 50.0, 1400.0, 1600.0);
        for (distribution, shape, has_ends) in [
            (Distribution::Normal { mean, sd }, "normal", false),
            (Distribution::TruncatedNormal { mode: mean, scale: sd, min, max }, "truncated normal", true),
            (Distribution::Uniform { min, max }, "uniform", true),
            (Distribution::Triangular { min, mode: mean, max }, "triangular", true),
            (Distribution::of_factor(mean, 1.1), "log-normal", false),
            (Distribution::StudentT { mean, sd, n: 5 }, "Student's t", false),
        ] {
            let found = rows(distribution, None);
            assert_eq!(found[0], ("vehicle.1.mass sd".to_owned(), Some(distribution.sd())));
            assert_eq!(found[1], (format!("vehicle.1.mass distribution: {shape}"), None));
            let ends = [("vehicle.1.mass min".to_owned(), Some(min)), ("vehicle.1.mass max".to_owned(), Some(max))];
            assert_eq!(found[2..], if has_ends { ends.to_vec() } else { Vec::new() }, "{shape}");
        }
        let measured = rows(Distribution::Normal { mean, sd }, Some(std::sync::Arc::from([1450.0, 1550.0])));
        assert_eq!(measured[1].0, "vehicle.1.mass distribution: measured values");
    }

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
