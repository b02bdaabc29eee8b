//! The verb `validate`: the paper's tables beside what is computed, cell by cell.

mod figure;
mod json;
mod measured;

use std::fmt::Write;

use planar_impact_validation::{Cell, Link, Report, Statement, TableReport, Verdict};

use crate::Done;
use crate::arguments::{Format, Validate};
use crate::exit::{Failure, Status};
use crate::table::{self, Align, wrap};

/// Runs the validation and prints every cell, or draws a figure.
///
/// # Errors
///
/// When the tables that come with the program cannot be read.
pub fn run(call: &Validate) -> Result<Done, Failure> {
    let report = planar_impact_validation::run().map_err(|error| Failure::Data(error.to_string()))?;
    let text = match (call.figure, call.format) {
        (Some(number), _) => figure::svg(&report, number)?,
        (None, Format::Text) => render(&report),
        (None, Format::Json) => {
            serde_json::to_string_pretty(&json::Document::of(&report)).map_err(|error| Failure::Data(error.to_string()))? + "\n"
        }
    };
    let status = if report.holds() { Status::Done } else { Status::DoesNotHold };
    Ok(Done { text, status })
}

fn render(report: &Report) -> String {
    let mut text = String::from("The tables of the paper, as printed and as computed.\n\n");
    for table in &report.tables {
        text.push_str(&cells(table));
        text.push_str("\n\n");
    }
    text.push_str("What the paper says in words\n");
    for statement in &report.statements {
        text.push_str(&in_words(statement));
    }
    text.push_str("\nThe chain of misprints\n");
    for link in &report.chain {
        text.push_str(&in_the_chain(link));
    }
    text.push('\n');
    text.push_str(&measured::section(&report.measured));
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
    let counts = format!(
        "{} cells: {} agree to the last digit, {} within a bound, {} misprinted, {} given or measured",
        counts.total(),
        counts.agree,
        counts.within_bound,
        counts.misprints,
        counts.given
    );
    let mut text = wrap(&counts, &format!("{}, ", table.name));
    let columns = [Align::Left, Align::Left, Align::Right, Align::Right, Align::Left];
    text.push_str(&table::render(&["row", "column", "printed", "computed", "verdict"], &columns, &rows));
    text.push('\n');
    for (i, reason) in reasons.iter().enumerate() {
        text.push_str(&wrap(reason, &format!(" [{}] ", i + 1)));
    }
    text.push_str(&wrap(table.remark, " not computed: "));
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

fn in_the_chain(link: &Link) -> String {
    let printed = if link.printed == link.holds { link.printed.clone() } else { format!("{} ({} holds)", link.printed, link.holds) };
    "\n".to_owned() + &wrap(&format!("{}: {printed}", link.place), "  ") + &wrap(&link.how, "    follows: ")
}

fn in_words(statement: &Statement) -> String {
    "\n".to_owned()
        + &wrap(statement.says, &format!("  {}: ", statement.place))
        + &wrap(&statement.found, &format!("    {}: ", statement.standing.name()))
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
            assert!(text.contains(&format!("{}, {} cells: ", table.name, table.printed_cells)));
        }
        assert!(text.contains("-21631.2; -21639.2 holds"), "the misprint of Table 2");
        assert!(text.contains("49197.30; 43197.30 holds"), "the misprint of Table B1");
        assert!(text.contains("61334 (51334 holds)") && text.contains("83.3 (69.6 holds)"), "the chain");
        assert!(text.lines().all(|line| line.chars().count() <= 80), "80 columns");
        assert!(!text.contains("PROBLEM"));
    }
}
