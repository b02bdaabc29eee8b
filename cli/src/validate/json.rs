//! The report as JSON.

use planar_impact_validation::{Cell, Frontal, Given, Link, Reading, Report, RootMeanSquare, SmallOverlap, Statement, Verdict};
use serde::Serialize;

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

/// The measured tests.
#[derive(Serialize)]
struct Measured<'a> {
    small_overlap: Vec<SmallOverlapEntry<'a>>,
    small_overlap_root_mean_square: RootMeanSquares,
    full_frontal: Vec<FrontalEntry<'a>>,
}

#[derive(Serialize)]
struct ReadingEntry<'a> {
    unit: &'a str,
    measured: &'a str,
    computed: f64,
    error: f64,
    percent: f64,
    within_digits: bool,
    recorded_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kudlich_slibar: Option<Other>,
}

/// The same by the other tangential law.
#[derive(Serialize)]
struct Other {
    computed: f64,
    error: f64,
    percent: f64,
}

#[derive(Serialize)]
struct SmallOverlapEntry<'a> {
    test: &'a str,
    delta_v: ReadingEntry<'a>,
    yaw_rate: ReadingEntry<'a>,
    turns_as_measured: bool,
    reason: &'a str,
}

#[derive(Serialize)]
struct RootMeanSquares {
    brach: Errors,
    kudlich_slibar: Errors,
}

#[derive(Serialize)]
struct Errors {
    delta_v: Size,
    yaw_rate: Size,
}

#[derive(Serialize)]
struct Size {
    error: f64,
    percent: f64,
}

#[derive(Serialize)]
struct FrontalEntry<'a> {
    test: &'a str,
    vehicle: &'a str,
    mean_depth: f64,
    coefficients: Vec<CoefficientEntry<'a>>,
    crush_energy: ReadingEntry<'a>,
    unevenness: f64,
    speed: &'a str,
    speed_of_crush: f64,
    reason: &'a str,
}

#[derive(Serialize)]
struct CoefficientEntry<'a> {
    name: &'a str,
    unit: &'a str,
    computed: f64,
    published: Option<&'a str>,
}

impl<'a> Measured<'a> {
    fn of(measured: &'a planar_impact_validation::Measured) -> Self {
        let tests = &measured.small_overlap;
        Measured {
            small_overlap: tests.iter().map(SmallOverlapEntry::of).collect(),
            small_overlap_root_mean_square: RootMeanSquares {
                brach: Errors::of(SmallOverlap::root_mean_squares(tests)),
                kudlich_slibar: Errors::of(SmallOverlap::kudlich_slibar_root_mean_squares(tests)),
            },
            full_frontal: measured.frontal.iter().map(FrontalEntry::of).collect(),
        }
    }
}

impl<'a> ReadingEntry<'a> {
    fn of(reading: &'a Reading, kudlich_slibar: Option<f64>) -> Self {
        let other = |computed| Other { computed, error: reading.error_of(computed), percent: reading.percent_of(computed) };
        ReadingEntry {
            unit: reading.unit,
            measured: reading.measured.text(),
            computed: reading.computed,
            error: reading.error(),
            percent: reading.percent(),
            within_digits: reading.is_within_digits(),
            recorded_percent: reading.recorded.as_ref().map(|recorded| recorded.value()),
            kudlich_slibar: kudlich_slibar.map(other),
        }
    }
}

impl<'a> SmallOverlapEntry<'a> {
    fn of(test: &'a SmallOverlap) -> Self {
        SmallOverlapEntry {
            test: &test.test,
            delta_v: ReadingEntry::of(&test.delta_v, Some(test.kudlich_slibar_delta_v)),
            yaw_rate: ReadingEntry::of(&test.yaw_rate, Some(test.kudlich_slibar_yaw_rate)),
            turns_as_measured: test.turns_as_measured(),
            reason: &test.reason,
        }
    }
}

impl Errors {
    fn of([delta_v, yaw_rate]: [RootMeanSquare; 2]) -> Self {
        let size = |RootMeanSquare { error, percent }| Size { error, percent };
        Errors { delta_v: size(delta_v), yaw_rate: size(yaw_rate) }
    }
}

impl<'a> FrontalEntry<'a> {
    fn of(test: &'a Frontal) -> Self {
        let coefficients = test.coefficients.iter().map(|coefficient| CoefficientEntry {
            name: coefficient.name,
            unit: coefficient.unit,
            computed: coefficient.computed,
            published: coefficient.published.as_ref().map(|published| published.text()),
        });
        FrontalEntry {
            test: &test.test,
            vehicle: &test.vehicle,
            mean_depth: test.mean_depth,
            coefficients: coefficients.collect(),
            crush_energy: ReadingEntry::of(&test.energy, None),
            unevenness: test.unevenness,
            speed: test.speed.text(),
            speed_of_crush: test.speed_of_crush,
            reason: &test.reason,
        }
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
