//! Resolves names of inputs and outputs in a call, and checks them against the case.

use crate::case::{CaseOutput, Inputs, Parameter, Setup};
use crate::issue::Issue;
use crate::quantity::{did_you_mean, excerpt};

/// The name that selects everything.
const ALL: &str = "all";

/// Returns the named outputs, in order and without repetition; `None` without names.
pub fn outputs(option: &str, names: &[String], setup: &Setup, issues: &mut Vec<Issue>) -> Option<Vec<CaseOutput>> {
    let all = setup.outputs();
    select(names, &all, |name| {
        let answer = CaseOutput::named(name).ok_or_else(|| {
            if Parameter::named(name).is_some() {
                return issue(option, name, "this is an input, not an output", None);
            }
            let known = all.iter().flat_map(|answer| [Some(answer.to_string()), answer.symbol().map(str::to_owned)]);
            unknown(option, name, "output", known.flatten())
        })?;
        match setup.lacks(answer) {
            Some(why) => Err(issue(option, name, &why, None)),
            None => Ok(answer),
        }
    })
    .map_err(|found| issues.extend(found))
    .unwrap_or_default()
}

/// Returns the named inputs, in order and without repetition; `None` without names.
pub fn parameters(option: &str, names: &[String], inputs: &Inputs, issues: &mut Vec<Issue>) -> Option<Vec<Parameter>> {
    let all = inputs.parameters();
    select(names, &all, |name| {
        let parameter = parameter(option, name, inputs)?;
        match inputs.value(parameter) {
            // The impulse ratio is listed even if the file leaves it to the collision.
            Err(why) if !all.contains(&parameter) => Err(issue(option, name, &why, None)),
            _ => Ok(parameter),
        }
    })
    .map_err(|found| issues.extend(found))
    .unwrap_or_default()
}

/// Returns the input with this name, whether or not the case has it.
pub fn parameter(option: &str, name: &str, inputs: &Inputs) -> Result<Parameter, Issue> {
    Parameter::named(name).ok_or_else(|| {
        if CaseOutput::named(name).is_some() {
            return issue(option, name, "this is an output, not an input", None);
        }
        let known =
            inputs.parameters().into_iter().flat_map(|parameter| [Some(parameter.to_string()), parameter.symbol().map(str::to_owned)]);
        unknown(option, name, "input", known.flatten())
    })
}

/// Creates an issue with a word of the call.
pub fn issue(option: &str, word: &str, message: &str, help: Option<String>) -> Issue {
    Issue::of_call(&format!("{option} {}", excerpt(word).trim_matches('`')), message.to_owned(), help)
}

fn unknown(option: &str, name: &str, what: &str, known: impl Iterator<Item = String>) -> Issue {
    let help = did_you_mean(&in_letters(name), known);
    let message = if name.is_empty() { format!("the name of an {what} is missing") } else { format!("unknown {what}") };
    issue(option, name, &message, help)
}

/// Writes the symbols of the paper in the letters of this program: `μ₀` as `mu0`.
pub(crate) fn in_letters(name: &str) -> String {
    let letter = |c: char| match c {
        'μ' | 'µ' => "mu".to_owned(),
        'Γ' => "Gamma".to_owned(),
        'Δ' => "d".to_owned(),
        'Ω' => "Omega".to_owned(),
        'ω' => "omega".to_owned(),
        '₀'..='₉' => (u32::from(c) - u32::from('₀')).to_string(),
        _ => c.to_string(),
    };
    name.chars().map(letter).collect()
}

fn select<N: Copy + PartialEq>(names: &[String], all: &[N], find: impl Fn(&str) -> Result<N, Issue>) -> Result<Option<Vec<N>>, Vec<Issue>> {
    if names.is_empty() {
        return Ok(None);
    }
    let (mut chosen, mut issues): (Vec<N>, Vec<Issue>) = (Vec::new(), Vec::new());
    for name in names.iter().map(|name| name.trim()) {
        let found = if name == ALL { Ok(all.to_vec()) } else { find(name).map(|one| vec![one]) };
        match found {
            Ok(found) => found.into_iter().for_each(|one| {
                if !chosen.contains(&one) {
                    chosen.push(one);
                }
            }),
            Err(issue) => issues.push(issue),
        }
    }
    if issues.is_empty() { Ok(Some(chosen)) } else { Err(issues) }
}
