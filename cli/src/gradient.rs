//! The verb `gradient`: exact derivatives of the outputs by the inputs.

mod text;

use serde::Serialize;

use crate::Done;
use crate::arguments::{Format, Gradient as Call};
use crate::case::{Answer, Answers, Case, Crash3Key, Parameter};
use crate::derivative;
use crate::document::{Problem, Problems};
use crate::exit::Failure;
use crate::named::{Named, plain};
use crate::names;

/// The most derivatives computed at once, so that a file with a million depths cannot fill the memory.
const MOST: usize = 250_000;

/// Reads the case, solves it and prints the derivatives.
///
/// # Errors
///
/// Everything wrong with the file or the names, or every reason why the physics refuses the case.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let mut problems = Vec::new();
    let of = names::answers("--of", &call.of, &case.setup, &mut problems);
    let wrt = names::parameters("--wrt", &call.wrt, &case.inputs, &mut problems);
    let json = call.format == Format::Json;
    let choice = Choice {
        answers: of.clone().unwrap_or_else(|| if json { case.setup.answers() } else { text::principal(&case) }),
        parameters: wrt.clone().unwrap_or_else(|| if json { case.inputs.parameters() } else { case.inputs.keys() }),
        second: call.second,
    };
    problems.extend(choice.too_many());
    if !problems.is_empty() {
        return Err(Failure::Input(Problems::of_call(problems)));
    }
    let impact = case.collision.solve().map_err(|refusals| case.refuse(&refusals, units))?;
    let gradient = Gradient::of(&case, &choice, case.setup.answers_of(&impact));
    let mut notes = case.notes.clone();
    notes.extend(case.cautions(&impact));
    notes.push(HOLDS.to_owned());
    if let Some(note) = text::ratio_note(&case) {
        notes.push(note);
    }
    if json {
        let document = serde_json::to_string_pretty(&Document::of(&case, &gradient, &notes));
        return document.map(|text| Done::with(text + "\n")).map_err(|error| Failure::Data(error.to_string()));
    }
    let page = text::Page { case: &case, gradient: &gradient, units, every_answer: of.is_some(), every_parameter: wrt.is_some() };
    Ok(Done::with(page.render(&notes)))
}

const HOLDS: &str = "a derivative by one input holds the other keys of the file as they are given: with its heading a vehicle turns its speed, \
                     but not a velocity given by components, and with its mass it changes the yaw inertia of a given radius of gyration";

/// What to differentiate by what.
struct Choice {
    answers: Vec<Answer>,
    parameters: Vec<Parameter>,
    second: bool,
}

impl Choice {
    fn too_many(&self) -> Option<Problem> {
        let by = self.parameters.len().saturating_pow(if self.second { 2 } else { 1 });
        let count = self.answers.len().saturating_mul(by);
        let message = format!("{count} derivatives are more than the {MOST} that are computed at once");
        (count > MOST).then(|| Problem::of_call("--wrt", message, Some("name the inputs that matter".to_owned())))
    }
}

/// The answers with their derivatives.
struct Gradient {
    parameters: Vec<Parameter>,
    answers: Answers,
    rows: Vec<Row>,
}

/// One answer with its derivatives, in the order of the parameters; not a number where there is none.
struct Row {
    answer: Answer,
    value: f64,
    first: Vec<f64>,
    /// All of them, both ways round; empty unless asked for.
    second: Vec<Vec<f64>>,
}

impl Gradient {
    fn of(case: &Case, choice: &Choice, answers: Answers) -> Self {
        let row = |&answer: &Answer| {
            let value = plain(answers.get(answer).unwrap_or(f64::NAN));
            Row { answer, value, first: Vec::new(), second: Vec::new() }
        };
        let mut rows: Vec<Row> = choice.answers.iter().map(row).collect();
        for &parameter in &choice.parameters {
            let by = derivative::by(&case.inputs, parameter);
            for row in &mut rows {
                row.first.push(row.defined(&[parameter], by.get(row.answer).map(|dual| dual.eps)));
            }
        }
        if choice.second {
            let size = choice.parameters.len();
            rows.iter_mut().for_each(|row| row.second = vec![vec![0.0; size]; size]);
            for (i, &one) in choice.parameters.iter().enumerate() {
                for (j, &two) in choice.parameters.iter().enumerate().skip(i) {
                    let by = derivative::by_both(&case.inputs, one, two);
                    for row in &mut rows {
                        let value = row.defined(&[one, two], by.get(row.answer).map(|dual| dual.eps1eps2));
                        (row.second[i][j], row.second[j][i]) = (value, value);
                    }
                }
            }
        }
        Gradient { parameters: choice.parameters.clone(), answers, rows }
    }
}

impl Row {
    /// A root has no derivative at zero: speeds of a crush energy have none by what the energy is made of, and do not move by the rest.
    fn defined(&self, by: &[Parameter], derivative: Option<f64>) -> f64 {
        let is_root = matches!(self.answer, Answer::EquivalentEnergySpeed(_) | Answer::Crash3(_, Crash3Key::DeltaVMagnitude));
        let at_corner = is_root && self.value == 0.0 && by.iter().any(|parameter| matches!(parameter, Parameter::Crush(..)));
        derivative.filter(|_| !at_corner).map_or(f64::NAN, plain)
    }
}

/// The JSON document of `gradient`.
#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    title: &'a str,
    /// The value of each input; `null` for the impulse ratio where the file does not give it.
    wrt: Named<Option<f64>>,
    of: Named<Entry>,
    notes: &'a [String],
}

#[derive(Serialize)]
struct Entry {
    value: f64,
    d: Named<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    d2: Option<Named<Named<f64>>>,
}

impl<'a> Document<'a> {
    fn of(case: &'a Case, gradient: &Gradient, notes: &'a [String]) -> Self {
        let named = |values: &[f64]| gradient.parameters.iter().zip(values.iter().copied()).collect::<Named<f64>>();
        let entry = |row: &Row| {
            let second = || gradient.parameters.iter().zip(row.second.iter().map(|values| named(values))).collect();
            let entry = Entry { value: row.value, d: named(&row.first), d2: (!row.second.is_empty()).then(second) };
            (row.answer, entry)
        };
        Document {
            schema: 1,
            title: &case.title,
            wrt: gradient.parameters.iter().map(|&parameter| (parameter, case.inputs.value(parameter).ok().map(plain))).collect(),
            of: gradient.rows.iter().map(entry).collect(),
            notes,
        }
    }
}
