//! The page of `compare`: the cases, the inputs in which they differ, and their outputs, side by side.

use planar_impact_app::compare::{CaseComparison, ComparedCase, ComparedInput, ComparedOutput, InputValue};
use planar_impact_app::plain_text::shorten;
use planar_impact_app::reconstruct::Interval;
use planar_impact_app::units::{Measure, Units, trim};

use super::Facts;
use super::uncertainty::with_digits;
use crate::block::{Block, Table};

/// Number of cases in a table that fits a terminal.
const ABREAST: usize = 4;
/// Widest name and title of a case, in columns.
const NAME_WIDTH: usize = 60;
const TITLE_WIDTH: usize = 60;
/// Widest word of a case file in a cell, in columns.
const WORD_WIDTH: usize = 24;

impl Facts for CaseComparison {
    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks: Vec<Block> = self.cases.iter().enumerate().flat_map(|(place, case)| heading(place, case, units)).collect();
        if self.inputs.is_empty() {
            blocks.push(Block::paragraph("The cases do not differ in any entry of their files."));
        }
        let places: Vec<usize> = (0..self.cases.len()).collect();
        for places in places.chunks(ABREAST) {
            if !self.inputs.is_empty() {
                blocks.push(table("inputs that differ", places, self.inputs.iter().map(|input| of_input(input, places, units)).collect()));
            }
            if !self.outputs.is_empty() {
                blocks.push(table("outputs", places, self.outputs.iter().flat_map(|output| of_output(output, places, units)).collect()));
            }
        }
        blocks
    }
}

/// Returns the measure in which a number is printed: every speed as on the road.
pub(crate) fn printed(measure: Measure) -> Measure {
    if measure == Measure::Speed { Measure::RoadSpeed } else { measure }
}

/// Says which case a number stands for, and what became of it.
fn heading(place: usize, case: &ComparedCase, units: Units) -> Vec<Block> {
    let title = if case.title.is_empty() { String::new() } else { format!(": {}", shorten(&case.title, TITLE_WIDTH)) };
    let verdict = case.verdict.map_or_else(String::new, |verdict| format!(", {verdict}"));
    let label = format!("[{}] ", place + 1);
    let mut blocks = vec![Block::item(label, format!("{}{title} ({}{verdict})", shorten(&case.name, NAME_WIDTH), case.verb))];
    blocks.extend(case.refusals.iter().map(|refusal| {
        let path = if refusal.path.is_empty() { String::new() } else { format!("{}: ", refusal.path) };
        let what = if case.is_refused() { "refused" } else { "no unique answer" };
        Block::item("! ", format!("[{}] {what}: {path}{}.", place + 1, units.sentence(&refusal.message.0)))
    }));
    blocks
}

fn table(what: &str, places: &[usize], rows: Vec<Vec<String>>) -> Block {
    let header = [what.to_owned(), "unit".to_owned()].into_iter().chain(places.iter().map(|place| format!("[{}]", place + 1)));
    let columns = "ll".to_owned() + &"r".repeat(places.len());
    Table::new(header, &columns, rows).narrow().into()
}

fn of_input(input: &ComparedInput, places: &[usize], units: Units) -> Vec<String> {
    let measure = printed(input.measure);
    let number = |value: &Option<InputValue>| if let Some(InputValue::Number(value)) = value { value.abs() } else { 0.0 };
    let greatest = input.values.iter().map(number).fold(0.0, f64::max);
    // Six digits, or all where inputs that differ would look the same.
    let numbers = input.values.iter().flatten().filter_map(|value| if let InputValue::Number(value) = value { Some(*value) } else { None });
    let texts: Vec<(f64, String)> = numbers.map(|value| (value, trim(units.convert(measure, value)))).collect();
    let looks_same =
        texts.iter().any(|(one, text)| texts.iter().any(|(other, same)| text == same && (one - other).abs() > 1e-12 * greatest));
    let cell = |place: &usize| match &input.values[*place] {
        None => "-".to_owned(),
        Some(InputValue::Word(word)) => shorten(word, WORD_WIDTH),
        Some(InputValue::Number(value)) if value.abs() <= 1e-12 * greatest => "0".to_owned(),
        Some(InputValue::Number(value)) if looks_same => units.convert(measure, *value).to_string(),
        Some(InputValue::Number(value)) => trim(units.convert(measure, *value)),
    };
    let has_number = input.values.iter().flatten().any(|value| matches!(value, InputValue::Number(_)));
    let unit = if has_number { units.unit(measure) } else { "" };
    [input.name.clone(), unit.to_owned()].into_iter().chain(places.iter().map(cell)).collect()
}

/// Renders the values of an output, and below them the intervals where there are any.
fn of_output(output: &ComparedOutput, places: &[usize], units: Units) -> Vec<Vec<String>> {
    let measure = printed(output.measure);
    let cell = |place: &usize| value(output, *place, units);
    let mut rows =
        vec![[output.name.clone(), units.unit(measure).to_owned()].into_iter().chain(places.iter().map(cell)).collect::<Vec<_>>()];
    let intervals: Vec<Option<&Interval>> = places.iter().map(|place| output.intervals[*place].as_ref()).collect();
    if let Some(first) = intervals.iter().flatten().next() {
        let level = format!("  {} % from", trim(100.0 * first.level));
        for (name, place) in [(level, 0), ("  to".to_owned(), 1)] {
            let of = |interval: &Interval| [interval.low, interval.high][place];
            let cell = |interval: &Option<&Interval>| {
                interval.map_or_else(String::new, |interval| {
                    of(interval).map_or_else(|| "-".to_owned(), |si| end(interval, measure, si, units))
                })
            };
            rows.push([name, String::new()].into_iter().chain(intervals.iter().map(cell)).collect());
        }
    }
    rows
}

/// Formats the value of an output in a case, with the digits of its interval if it has one.
pub(crate) fn value(output: &ComparedOutput, place: usize, units: Units) -> String {
    let measure = printed(output.measure);
    match (output.values[place], &output.intervals[place]) {
        (None, _) => "-".to_owned(),
        (Some(value), Some(interval)) => end(interval, measure, value, units),
        (Some(value), None) => units.number(measure, value, output.scale),
    }
}

/// Formats a value with two digits of a quarter of the interval.
pub(crate) fn end(interval: &Interval, measure: Measure, si: f64, units: Units) -> String {
    let width = interval.low.zip(interval.high).map_or(0.0, |(low, high)| high - low);
    with_digits(units, measure, si, 0.25 * width)
}
