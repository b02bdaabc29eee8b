//! The sweep as a table for people.

use super::Sweep;
use crate::report::clean;
use crate::table::{self, Align, wrap};
use crate::units::Measure;

/// The widest line.
const WIDTH: usize = 80;

/// A column of the table.
struct Column {
    header: String,
    cells: Vec<String>,
}

impl Column {
    fn width(&self) -> usize {
        let lines = self.header.lines().chain(self.cells.iter().map(String::as_str));
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    }
}

/// The table, or as many one below the other as the columns need.
pub fn render(sweep: &Sweep<'_>) -> String {
    let mut text = String::new();
    if !sweep.case.title.is_empty() {
        text.push_str(&wrap(&clean(&sweep.case.title), ""));
        text.push('\n');
    }
    let mut fixed: Vec<Column> = (0..sweep.ranges.len()).map(|i| varied(sweep, i)).collect();
    if sweep.points.iter().any(Result::is_err) {
        let short = |point: &Result<_, super::Refused>| point.as_ref().err().map_or("", |refused| refused.short).to_owned();
        fixed.push(Column { header: "refused\n".to_owned(), cells: sweep.points.iter().map(short).collect() });
    }
    let used: usize = fixed.iter().map(|column| column.width() + 3).sum();
    let mut blocks: Vec<Vec<Column>> = Vec::new();
    let mut room = 0;
    for answer in 0..sweep.answers.len() {
        let column = answers(sweep, answer);
        let width = column.width() + 3;
        match blocks.last_mut() {
            Some(block) if width <= room => block.push(column),
            _ => {
                blocks.push(vec![column]);
                room = WIDTH.saturating_sub(used);
            }
        }
        room = room.saturating_sub(width);
    }
    for block in &blocks {
        // The reason stands behind the answers that it explains.
        let varied = &fixed[..sweep.ranges.len()];
        let columns: Vec<&Column> = varied.iter().chain(block).chain(&fixed[sweep.ranges.len()..]).collect();
        let aligned: Vec<Align> =
            columns.iter().map(|column| if column.header.starts_with("refused") { Align::Left } else { Align::Right }).collect();
        let headers: Vec<&str> = columns.iter().map(|column| column.header.as_str()).collect();
        let rows: Vec<Vec<String>> =
            (0..sweep.points.len()).map(|point| columns.iter().map(|column| column.cells[point].clone()).collect()).collect();
        text.push_str(&table::render(&headers, &aligned, &rows));
        text.push_str("\n\n");
    }
    for note in &sweep.case.notes {
        text.push_str(&wrap(&format!("{note}."), "Note: "));
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn varied(sweep: &Sweep<'_>, at: usize) -> Column {
    let range = &sweep.ranges[at];
    let decimals = written_decimals(&range.shown);
    let place = |point: usize| sweep.at(point).nth(at).map_or(0, |(_, i)| i);
    let name = range.parameter.symbol().map_or_else(|| range.parameter.to_string(), str::to_owned);
    Column {
        header: format!("{name}\n{}", range.unit),
        cells: (0..sweep.points.len()).map(|point| number(range.shown[place(point)], decimals)).collect(),
    }
}

fn answers(sweep: &Sweep<'_>, at: usize) -> Column {
    let (answer, units) = (sweep.answers[at], sweep.units);
    let measure = answer.measure();
    let conversion = units.conversion(measure);
    let convert = |value: f64| if value.abs() <= 1e-12 * sweep.scales[at] { 0.0 } else { conversion.of_si(value) };
    let values: Vec<f64> = sweep.column(at).into_iter().map(convert).collect();
    let usual = match measure {
        Measure::Ratio => 3,
        Measure::Speed | Measure::Length => 2,
        _ => 1,
    };
    let decimals = decimals(&values, usual, units.convert(measure, sweep.scales[at]));
    let name = answer.symbol().map_or_else(|| answer.to_string(), str::to_owned);
    Column {
        header: format!("{name}\n{}", units.unit(measure)),
        cells: values.iter().map(|&value| if value.is_nan() { String::new() } else { number(value, decimals) }).collect(),
    }
}

/// The usual decimals, or so many more that the whole change has two digits. What is 10⁻¹² of the scale is no change.
fn decimals(values: &[f64], usual: usize, scale: f64) -> usize {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let change = finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min);
    if !change.is_finite() || change <= 1e-12 * scale {
        return usual;
    }
    usual.max((1.0 - change.log10()).ceil().clamp(0.0, 12.0) as usize)
}

/// The decimals that the values of an input were given with.
fn written_decimals(values: &[f64]) -> usize {
    let is_written = |value: &f64, digits: usize| format!("{value:.digits$}").parse() == Ok(*value);
    (0..=12).find(|&digits| values.iter().all(|value| is_written(value, digits))).unwrap_or(6)
}

fn number(value: f64, decimals: usize) -> String {
    if value.abs() >= 1e12 {
        return format!("{value:.4e}");
    }
    let text = format!("{value:.decimals$}");
    // A minus before nothing but zeros is rounding.
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_show_the_change() {
        assert_eq!(decimals(&[0.434, 0.947], 3, 1.0), 3);
        assert_eq!(decimals(&[100.0, 100.001], 1, 1e3), 4);
        assert_eq!(decimals(&[49_980.8, 49_980.8 + 1e-11], 1, 1e5), 1);
        assert_eq!(decimals(&[f64::NAN], 2, 0.0), 2);
        assert_eq!(written_decimals(&[-10.0, 0.25, 7.5]), 2);
        assert_eq!(written_decimals(&[1.0 / 3.0]), 6);
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(-0.01, 2), "-0.01");
        assert_eq!(number(1.5e15, 1), "1.5000e15");
    }
}
