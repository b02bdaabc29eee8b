//! The names of inputs and outputs in a call, each checked against what the case has.

use crate::case::{Answer, Inputs, Parameter, Setup};
use crate::document::Problem;
use crate::quantity::{excerpt, nearest};

/// What stands for everything.
const ALL: &str = "all";

/// The outputs named, in the order named and each once; none when no name is given.
pub fn answers(option: &str, names: &[String], setup: &Setup, problems: &mut Vec<Problem>) -> Option<Vec<Answer>> {
    let all = setup.answers();
    select(names, &all, |name| {
        let answer = Answer::named(name).ok_or_else(|| {
            if Parameter::named(name).is_some() {
                return problem(option, name, "this is an input, not an output", None);
            }
            let known = all.iter().flat_map(|answer| [Some(answer.to_string()), answer.symbol().map(str::to_owned)]);
            unknown(option, name, "output", known.flatten())
        })?;
        match setup.lacks(answer) {
            Some(why) => Err(problem(option, name, &why, None)),
            None => Ok(answer),
        }
    })
    .map_err(|found| problems.extend(found))
    .unwrap_or_default()
}

/// The inputs named, in the order named and each once; none when no name is given.
pub fn parameters(option: &str, names: &[String], inputs: &Inputs, problems: &mut Vec<Problem>) -> Option<Vec<Parameter>> {
    let all = inputs.parameters();
    select(names, &all, |name| {
        let parameter = parameter(option, name, inputs)?;
        match inputs.value(parameter) {
            // The impulse ratio is listed although the file may leave it to the collision.
            Err(why) if !all.contains(&parameter) => Err(problem(option, name, &why, None)),
            _ => Ok(parameter),
        }
    })
    .map_err(|found| problems.extend(found))
    .unwrap_or_default()
}

/// The input of a name, whether or not the case has it.
pub fn parameter(option: &str, name: &str, inputs: &Inputs) -> Result<Parameter, Problem> {
    Parameter::named(name).ok_or_else(|| {
        if Answer::named(name).is_some() {
            return problem(option, name, "this is an output, not an input", None);
        }
        let known =
            inputs.parameters().into_iter().flat_map(|parameter| [Some(parameter.to_string()), parameter.symbol().map(str::to_owned)]);
        unknown(option, name, "input", known.flatten())
    })
}

/// A problem with a word of the call.
pub fn problem(option: &str, word: &str, message: &str, help: Option<String>) -> Problem {
    Problem::of_call(&format!("{option} {}", excerpt(word).trim_matches('`')), message.to_owned(), help)
}

fn unknown(option: &str, name: &str, what: &str, known: impl Iterator<Item = String>) -> Problem {
    let known: Vec<String> = known.collect();
    let help = nearest(name, known.iter().map(String::as_str)).map(|name| format!("did you mean `{name}`?"));
    let message = if name.is_empty() { format!("the name of an {what} is missing") } else { format!("unknown {what}") };
    problem(option, name, &message, help)
}

fn select<N: Copy + PartialEq>(
    names: &[String],
    all: &[N],
    find: impl Fn(&str) -> Result<N, Problem>,
) -> Result<Option<Vec<N>>, Vec<Problem>> {
    if names.is_empty() {
        return Ok(None);
    }
    let (mut chosen, mut problems): (Vec<N>, Vec<Problem>) = (Vec::new(), Vec::new());
    for name in names.iter().map(|name| name.trim()) {
        let found = if name == ALL { Ok(all.to_vec()) } else { find(name).map(|one| vec![one]) };
        match found {
            Ok(found) => found.into_iter().for_each(|one| {
                if !chosen.contains(&one) {
                    chosen.push(one);
                }
            }),
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Ok(Some(chosen)) } else { Err(problems) }
}
