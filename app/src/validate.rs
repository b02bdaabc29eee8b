//! The verb `validate`: the paper's tables beside what is computed, cell by cell, and measured tests.

mod measured;

use planar_impact_validation::{Cell, Counts, Given, Link, Report, Statement, TableReport, Verdict};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::answer::SCHEMA;
use crate::control::Control;
use crate::issue::Issues;
use measured::Measured;

/// The answer of `validate`. Its JSON has a line for each cell, statement and measured test.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct Validation {
    /// The report of the validation.
    #[serde(serialize_with = "serialize")]
    #[schemars(with = "Document<'static>")]
    pub report: Report,
}

/// Compares every printed value of the paper's tables with what is computed.
///
/// # Errors
///
/// An issue if the caller stops it, or a defect: the tables that come with the program cannot be read.
pub fn validate(_: &(), control: &dyn Control) -> Result<Validation, Issues> {
    control.proceed(0, 1)?;
    planar_impact_validation::run().map(|report| Validation { report }).map_err(Issues::defect)
}

fn serialize<S: Serializer>(report: &Report, serializer: S) -> Result<S::Ok, S::Error> {
    Document::of(report).serialize(serializer)
}

/// The JSON document of `validate`.
#[derive(Serialize, JsonSchema)]
#[schemars(inline)]
struct Document<'a> {
    /// The version of this document.
    schema: u32,
    /// `true` if every cell, statement and measured test comes out as stated.
    holds: bool,
    /// The tables of the paper, with their counts.
    tables: Vec<TableEntry<'a>>,
    /// The cells that are computed.
    cells: Vec<CellEntry<'a>>,
    /// The cells that nothing computes.
    given: Vec<GivenEntry<'a>>,
    /// Misprints that follow from one another.
    chain: Vec<LinkEntry<'a>>,
    /// Statements of the paper and of this program, each with its result.
    statements: Vec<StatementEntry<'a>>,
    /// Measured tests beside their computation.
    measured: Measured<'a>,
    /// Problems of the report; empty if it holds.
    problems: Vec<String>,
    /// The result in a sentence.
    summary: String,
}

/// Numbers of cells of a table, by verdict.
#[derive(Serialize, JsonSchema)]
struct TableEntry<'a> {
    /// Its name, such as `Table 1`.
    name: &'a str,
    /// Cells that are not computed, and why.
    remark: &'a str,
    /// All of its cells.
    cells: usize,
    /// Cells that round to the printed value.
    agree: usize,
    /// Cells within a stated bound of it.
    within_bound: usize,
    /// Misprinted cells.
    misprints: usize,
    /// Cells that are given or measured.
    given: usize,
}

impl<'a> TableEntry<'a> {
    fn of(table: &'a TableReport) -> Self {
        let counts = table.counts();
        let Counts { agree, within_bound, misprints, given, .. } = counts;
        TableEntry { name: table.name, remark: table.remark, cells: counts.total(), agree, within_bound, misprints, given }
    }
}

/// A printed cell beside its computed value.
#[derive(Serialize, JsonSchema)]
struct CellEntry<'a> {
    /// The table.
    table: &'a str,
    /// The label of the row.
    row: &'a str,
    /// The column.
    column: &'a str,
    /// Its unit; `1` for a ratio.
    unit: &'a str,
    /// The value as printed.
    printed: &'a str,
    /// The computed value.
    computed: f64,
    /// The comparison: `agrees`, `within bound`, `misprint`, or what is wrong with the comparison.
    verdict: &'a str,
    /// The bound, in the unit of the cell, where the value is within one.
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<f64>,
    /// The value that should be printed, where the print is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    holds: Option<&'a str>,
    /// The reason of the bound or of the misprint.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
}

/// A statement and whether it holds.
#[derive(Serialize, JsonSchema)]
struct StatementEntry<'a> {
    /// Its name.
    name: &'a str,
    /// Its place in the paper; `this crate` for a check of this program.
    place: &'a str,
    /// The statement.
    says: &'a str,
    /// The computed result.
    found: &'a str,
    /// Its result in a word.
    standing: &'a str,
    /// `true` if that is as expected.
    as_expected: bool,
}

impl<'a> Document<'a> {
    fn of(report: &'a Report) -> Self {
        Document {
            schema: SCHEMA,
            holds: report.holds(),
            tables: report.tables.iter().map(TableEntry::of).collect(),
            cells: report.cells().map(CellEntry::of).collect(),
            given: report.tables.iter().flat_map(|table| &table.given).map(GivenEntry::of).collect(),
            chain: report.chain.iter().map(LinkEntry::of).collect(),
            statements: report.statements.iter().map(StatementEntry::of).collect(),
            measured: Measured::of(&report.measured),
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

/// A cell that nothing computes.
#[derive(Serialize, JsonSchema)]
struct GivenEntry<'a> {
    /// The table.
    table: &'a str,
    /// The label of the row.
    row: &'a str,
    /// The column.
    column: &'a str,
    /// Its unit; `1` for a ratio.
    unit: &'a str,
    /// The value as printed.
    printed: &'a str,
    /// Reason for which nothing computes it, in a word.
    nature: &'a str,
}

impl<'a> GivenEntry<'a> {
    fn of(given: &'a Given) -> Self {
        let Given { table, row, column, unit, printed, nature } = given;
        GivenEntry { table, row, column, unit, printed: printed.text(), nature: nature.name() }
    }
}

/// A link of the chain of misprints.
#[derive(Serialize, JsonSchema)]
struct LinkEntry<'a> {
    /// Its place in the paper.
    place: &'a str,
    /// The value as printed.
    printed: &'a str,
    /// The value that should be printed.
    holds: &'a str,
    /// The derivation in numbers.
    how: &'a str,
    /// `true` if the numbers confirm it.
    follows: bool,
}

impl<'a> LinkEntry<'a> {
    fn of(link: &'a Link) -> Self {
        LinkEntry { place: link.place, printed: &link.printed, holds: &link.holds, how: &link.how, follows: link.follows }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_has_every_cell_and_every_measured_test() {
        let report = planar_impact_validation::run().expect("the tables can be read");
        let json = serde_json::to_value(Document::of(&report)).expect("plain data");
        let count = |key: &str| json[key].as_array().map_or(0, Vec::len);
        assert_eq!(count("cells") + count("given"), report.counts().total());
        assert_eq!((count("chain"), json["holds"].as_bool()), (3, Some(true)));
        let tests = json["measured"]["small_overlap"].as_array().expect("tests");
        for (test, known) in tests.iter().zip(&report.measured.small_overlap) {
            assert_eq!(test["yaw_rate"]["percent"].as_f64(), Some(known.yaw_rate.percent()));
            assert_eq!(test["delta_v"]["kudlich_slibar"]["computed"].as_f64(), Some(known.kudlich_slibar_delta_v));
        }
        assert!(json["measured"]["full_frontal"][0]["crush_energy"].get("kudlich_slibar").is_none());
    }
}
