//! The report as JSON.

mod measured;

use planar_impact_validation::{Cell, Given, Link, Report, Statement, Verdict};
use serde::Serialize;

use measured::Measured;

/// The JSON document of `validate`.
#[derive(Serialize)]
pub struct Document<'a> {
    schema: u32,
    holds: bool,
    cells: Vec<CellEntry<'a>>,
    given: Vec<GivenEntry<'a>>,
    chain: Vec<LinkEntry<'a>>,
    statements: Vec<StatementEntry<'a>>,
    measured: Measured<'a>,
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
    pub fn of(report: &'a Report) -> Self {
        Document {
            schema: 1,
            holds: report.holds(),
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
#[derive(Serialize)]
struct GivenEntry<'a> {
    table: &'a str,
    row: &'a str,
    column: &'a str,
    unit: &'a str,
    printed: &'a str,
    nature: &'a str,
}

impl<'a> GivenEntry<'a> {
    fn of(given: &'a Given) -> Self {
        let Given { table, row, column, unit, printed, nature } = given;
        GivenEntry { table, row, column, unit, printed: printed.text(), nature: nature.name() }
    }
}

/// A link of the chain of misprints.
#[derive(Serialize)]
struct LinkEntry<'a> {
    place: &'a str,
    printed: &'a str,
    holds: &'a str,
    how: &'a str,
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
