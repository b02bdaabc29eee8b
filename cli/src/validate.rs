//! The verb `validate`: the paper's tables beside what is computed, cell by cell.

use std::fmt::Write;

use planar_impact_validation::{Cell, Report, Statement, TableReport, Verdict};
use serde::Serialize;

use crate::Done;
use crate::arguments::{Format, Validate};
use crate::exit::{Failure, Status};
use crate::table::{self, Align, wrap};

/// Runs the validation and prints every cell.
///
/// # Errors
///
/// When the tables that come with the program cannot be read.
pub fn run(call: &Validate) -> Result<Done, Failure> {
    let report = planar_impact_validation::run().map_err(|error| Failure::Data(error.to_string()))?;
    let text = match call.format {
        Format::Text => render(&report),
        Format::Json => serde_json::to_string_pretty(&Document::of(&report)).map_err(|error| Failure::Data(error.to_string()))? + "\n",
    };
    let status = if report.holds() { Status::Done } else { Status::DoesNotHold };
    Ok(Done { text, status })
}

fn render(report: &Report) -> String {
    let mut text = String::from("The tables of the paper, as printed and as computed, in ft/s and ft lb.\n\n");
    for table in &report.tables {
        text.push_str(&cells(table));
        text.push_str("\n\n");
    }
    text.push_str("What the paper says in words\n");
    for statement in &report.statements {
        text.push_str(&in_words(statement));
    }
    text.push('\n');
    for problem in report.problems() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "PROBLEM: {problem}");
    }
    text.push_str(&wrap(&report.summary(), ""));
    text
}

fn cells(table: &TableReport) -> String {
    let mut reasons = Vec::new();
    let rows: Vec<Vec<String>> = table
        .cells
        .iter()
        .map(|cell| {
            let note = match &cell.verdict {
                Verdict::WithinBound { reason, .. } => mark(&mut reasons, reason),
                Verdict::Misprint { holds, why } => {
                    mark(&mut reasons, &format!("printed {}; {} holds: {why}", cell.printed.text(), holds.text()))
                }
                _ => String::new(),
            };
            vec![
                cell.row.clone(),
                cell.column.to_owned(),
                cell.printed.text().to_owned(),
                computed(cell),
                format!("{} {note}", cell.verdict.name()).trim_end().to_owned(),
            ]
        })
        .collect();
    let counts = table.counts();
    let mut text = format!(
        "{}: {} cells, {} to the last digit, {} within a bound, {} misprinted\n",
        table.name,
        counts.total(),
        counts.agree,
        counts.within_bound,
        counts.misprints
    );
    let columns = [Align::Left, Align::Left, Align::Right, Align::Right, Align::Left];
    text.push_str(&table::render(&["row", "column", "printed", "computed", "verdict"], &columns, &rows));
    text.push('\n');
    for (i, reason) in reasons.iter().enumerate() {
        text.push_str(&wrap(reason, &format!(" [{}] ", i + 1)));
    }
    text.push_str(&wrap(table.not_computed, " not computed: "));
    text.pop();
    text
}

/// The footnote of a reason, which several cells may share.
fn mark(reasons: &mut Vec<String>, reason: &str) -> String {
    let at = reasons.iter().position(|known| known == reason).unwrap_or_else(|| {
        reasons.push(reason.to_owned());
        reasons.len() - 1
    });
    format!("[{}]", at + 1)
}

/// One digit more than is printed.
fn computed(cell: &Cell) -> String {
    let decimals = cell.printed.text().split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{:.*}", decimals + 1, cell.computed)
}

fn in_words(statement: &Statement) -> String {
    "\n".to_owned()
        + &wrap(statement.says, &format!("  {}: ", statement.place))
        + &wrap(&statement.found, &format!("    {}: ", statement.standing.name()))
}

/// The JSON document of `validate`.
#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    holds: bool,
    cells: Vec<CellEntry<'a>>,
    statements: Vec<StatementEntry<'a>>,
    problems: Vec<String>,
    summary: String,
}

#[derive(Serialize)]
struct CellEntry<'a> {
    table: &'a str,
    row: &'a str,
    column: &'a str,
    unit: &'a str,
    printed: &'a str,
    computed: f64,
    verdict: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    holds: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
}

#[derive(Serialize)]
struct StatementEntry<'a> {
    name: &'a str,
    place: &'a str,
    says: &'a str,
    found: &'a str,
    standing: &'a str,
    as_expected: bool,
}

impl<'a> Document<'a> {
    fn of(report: &'a Report) -> Self {
        Document {
            schema: 1,
            holds: report.holds(),
            cells: report.cells().map(CellEntry::of).collect(),
            statements: report.statements.iter().map(StatementEntry::of).collect(),
            problems: report.problems().iter().map(ToString::to_string).collect(),
            summary: report.summary(),
        }
    }
}

impl<'a> CellEntry<'a> {
    fn of(cell: &'a Cell) -> Self {
        let (bound, holds, why) = match &cell.verdict {
            Verdict::WithinBound { bound, reason } => (Some(*bound), None, Some(reason.as_str())),
            Verdict::Misprint { holds, why } => (None, Some(holds.text()), Some(why.as_str())),
            _ => (None, None, None),
        };
        CellEntry {
            table: cell.table,
            row: &cell.row,
            column: cell.column,
            unit: cell.unit,
            printed: cell.printed.text(),
            computed: cell.computed,
            verdict: cell.verdict.name(),
            bound,
            holds,
            why,
        }
    }
}

impl<'a> StatementEntry<'a> {
    fn of(statement: &'a Statement) -> Self {
        StatementEntry {
            name: statement.name,
            place: statement.place,
            says: statement.says,
            found: &statement.found,
            standing: statement.standing.name(),
            as_expected: statement.is_as_expected(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_and_every_misprint_is_shown() {
        let report = planar_impact_validation::run().expect("the tables can be read");
        let text = render(&report);
        assert!(report.holds());
        for table in &report.tables {
            assert!(text.contains(&format!("{}: {} cells", table.name, table.expected_cells)));
        }
        assert!(text.contains("-21631.2; -21639.2 holds"), "the misprint of Table 2");
        assert!(text.contains("49197.30; 43197.30 holds"), "the misprint of Table B1");
        assert!(text.lines().all(|line| line.chars().count() <= 80), "80 columns");
        assert!(!text.contains("PROBLEM"));
    }

    #[test]
    fn the_json_has_every_cell() {
        let report = planar_impact_validation::run().expect("the tables can be read");
        let json = serde_json::to_value(Document::of(&report)).expect("plain data");
        assert_eq!(json["cells"].as_array().map(Vec::len), Some(81 + 39 + 66)); // Tables 1, 2 and B1
        assert_eq!(json["holds"], true);
    }
}
