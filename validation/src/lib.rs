#![doc = include_str!("../README.md")]
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod account;
mod barrier;
mod chain;
mod comparison;
mod data;
mod entries;
mod figure;
mod geometry;
mod impulses;
mod ledger;
mod measured;
mod perpendicular;
mod problem;
mod reconstruction;
mod report;
mod series;
mod sheet;
mod statement;
mod tables;

pub use account::{Cell, Verdict};
pub use chain::Link;
pub use data::{DataError, Texts};
pub use entries::{Given, Nature};
pub use figure::{Axis, Curve, Figure, Point, Style};
pub use ledger::{Bound, LARGEST_SLACK, Misprint};
pub use measured::{Coefficient, Frontal, Measured, MeasuredProblem, Reading, RootMeanSquare, SmallOverlap, Worked};
pub use problem::Problem;
pub use report::{Counts, Report, TableReport};
pub use sheet::Printed;
pub use statement::{Standing, Statement};

/// Computes every cell of the embedded tables and compares it with the printed value; then computes the measured tests.
///
/// # Errors
///
/// Returns a [`DataError`] if a text is malformed. A disagreement is not an error but a [`Problem`] of the report.
pub fn run() -> Result<Report, DataError> {
    run_on(&Texts::embedded())
}

/// Runs the validation on other texts.
///
/// # Errors
///
/// Returns a [`DataError`] if a text is malformed, or if the library refuses a collision.
pub fn run_on(texts: &Texts<'_>) -> Result<Report, DataError> {
    let geometry = geometry::Geometry::read(texts.geometry)?;
    let ledger = ledger::Ledger::read(texts.bounds, texts.misprints)?;
    let table_1 = perpendicular::table_1(&geometry, texts.table_1)?;
    let table_2 = perpendicular::table_2(&geometry, texts.table_2)?;
    let table_3 = impulses::table_3(texts.table_3)?;
    let table_4 = impulses::table_4(texts.table_4)?;
    let measurements = impulses::Measurements { table_3: &table_3.computed, table_4: &table_4.computed };
    let crabbed = barrier::table_b1(&geometry, texts.table_b1, geometry::Wall::Fixed)?;
    let table_b1 = barrier::entries(&crabbed, &measurements, texts.table_b1)?;
    let series = series::Series::read(texts.table_b1, texts.table_b2)?;
    let found = reconstruction::Reconstructions::of(&geometry, &series, geometry::Wall::Fixed)?;
    let table_b2 = reconstruction::table_b2(&geometry, &series, &found, &measurements, texts.table_b2)?;
    let table_5 = comparison::table_5(&series, &found, texts.table_5)?;
    let table_6 = comparison::table_6(&series, &found, texts.table_6)?;
    let cells = statement::Cells {
        table_1: &table_1.computed,
        table_2: &table_2.computed,
        table_3: &table_3,
        table_5: &table_5.computed,
        table_6: &table_6.computed,
        table_b1: &crabbed,
        table_b2: &table_b2.computed,
    };
    let tests = statement::Crabbed { geometry: &geometry, series: &series, found: &found };
    let statements = statement::all(&cells, &tests, texts.table_b1)?;
    let chain = chain::links(&table_b2.computed, &table_5.computed, &table_6.computed);
    let figures = figure::all(&geometry, &series, &found);
    let entries = [table_1, table_2, table_3, table_4, table_5, table_6, table_b1, table_b2];
    let tables = tables::TABLES.iter().zip(entries).map(|(expected, entries)| TableReport::judged(expected, entries, &ledger)).collect();
    let measured = Measured::read(texts.iihs, texts.nhtsa, texts.worked)?;
    Ok(Report { tables, statements, bounds: ledger.bounds, misprints: ledger.misprints, chain, figures, measured })
}

#[cfg(test)]
mod tests;
