//! The page of `sweep`: a table of all points.

use planar_impact_app::sweep::Sweep;
use planar_impact_app::units::{Measure, Units, beyond_rounding};

use super::Facts;
use crate::block::{Block, Table};
use crate::text::WIDTH;

/// A column of the table.
struct Column {
    header: String,
    align: char,
    cells: Vec<String>,
}

impl Column {
    fn width(&self) -> usize {
        let lines = self.header.lines().chain(self.cells.iter().map(String::as_str));
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    }
}

impl Facts for Sweep {
    /// The table, or as many one below the other as the columns need.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let sweep = self;
        let varied: Vec<Column> = (0..sweep.ranges.len()).map(|range| varied(sweep, range)).collect();
        let refusal = |code: &Option<String>| code.clone().unwrap_or_default();
        let refused = sweep.has_refused().then(|| Column {
            header: "refused\n".to_owned(),
            align: 'l',
            cells: sweep.refusal.iter().map(refusal).collect(),
        });
        let used: usize = varied.iter().chain(&refused).map(|column| column.width() + 3).sum();
        let mut groups: Vec<Vec<Column>> = Vec::new();
        let mut room = 0;
        for output in 0..sweep.outputs.len() {
            let column = computed(sweep, output, units);
            let width = column.width() + 3;
            match groups.last_mut() {
                Some(group) if width <= room => group.push(column),
                _ => {
                    groups.push(vec![column]);
                    room = WIDTH.saturating_sub(used);
                }
            }
            room = room.saturating_sub(width);
        }
        // The reason stands behind the outputs that it explains.
        let table = |group: &Vec<Column>| {
            let columns: Vec<&Column> = varied.iter().chain(group).chain(&refused).collect();
            let rows = (0..sweep.len()).map(|point| columns.iter().map(|column| column.cells[point].clone()).collect()).collect();
            let aligned: String = columns.iter().map(|column| column.align).collect();
            Block::from(Table::new(columns.iter().map(|column| column.header.as_str()), &aligned, rows))
        };
        groups.iter().map(table).collect()
    }
}

fn varied(sweep: &Sweep, at: usize) -> Column {
    let range = &sweep.ranges[at];
    let decimals = written_decimals(&range.shown);
    let name = range.parameter.symbol().map_or_else(|| range.parameter.to_string(), str::to_owned);
    Column {
        header: format!("{name}\n{}", range.unit),
        align: 'r',
        cells: (0..sweep.len()).map(|point| number(sweep.shown(point, at), decimals)).collect(),
    }
}

fn computed(sweep: &Sweep, at: usize, units: Units) -> Column {
    let output = sweep.outputs[at];
    let measure = output.measure();
    let conversion = units.conversion(measure);
    let convert = |value: &f64| conversion.of_si(beyond_rounding(*value, sweep.scales[at]));
    let values: Vec<f64> = sweep.column(at).iter().map(convert).collect();
    let usual = match measure {
        Measure::Ratio => 3,
        Measure::Speed | Measure::Length => 2,
        _ => 1,
    };
    let decimals = decimals(&values, usual, units.convert(measure, sweep.scales[at]));
    Column {
        header: format!("{}\n{}", output.short_name(), units.unit(measure)),
        align: 'r',
        cells: values.iter().map(|&value| if value.is_nan() { String::new() } else { number(value, decimals) }).collect(),
    }
}

/// Returns the usual number of decimals, or as many as give the total change two digits. A change below 10⁻¹² of the scale is rounding.
fn decimals(values: &[f64], usual: usize, scale: f64) -> usize {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let change = finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min);
    if !change.is_finite() || beyond_rounding(change, scale) == 0.0 {
        return usual;
    }
    usual.max((1.0 - libm::log10(change)).ceil().clamp(0.0, 12.0) as usize)
}

/// Returns the number of decimals with which the values of an input were given.
fn written_decimals(values: &[f64]) -> usize {
    let is_written = |value: &f64, digits: usize| format!("{value:.digits$}").parse() == Ok(*value);
    (0..=12).find(|&digits| values.iter().all(|value| is_written(value, digits))).unwrap_or(6)
}

fn number(value: f64, decimals: usize) -> String {
    if value.abs() >= 1e12 {
        return format!("{value:.4e}");
    }
    let text = format!("{value:.decimals$}");
    // A minus sign before a rounded zero is removed.
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
