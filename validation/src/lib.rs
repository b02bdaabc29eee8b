#![doc = include_str!("../README.md")]

mod account;
mod barrier;
mod data;
mod geometry;
mod ledger;
mod perpendicular;
mod report;
mod sheet;
mod statement;

pub use account::{Cell, Verdict};
pub use data::{DataError, Texts};
pub use ledger::{Bound, LARGEST_SLACK, Misprint};
pub use report::{Counts, Problem, Report, TableReport};
pub use sheet::Printed;
pub use statement::{Standing, Statement};

/// Computes every cell of the tables that come with the crate, and holds it against the print.
///
/// # Errors
///
/// [`DataError`]: a text is malformed. Disagreement is not an error but a [`Problem`] of the report.
pub fn run() -> Result<Report, DataError> {
    run_on(&Texts::embedded())
}

/// The same for other texts.
///
/// # Errors
///
/// [`DataError`]: a text is malformed, or the library refuses a collision.
pub fn run_on(texts: &Texts<'_>) -> Result<Report, DataError> {
    let geometry = geometry::Geometry::read(texts.geometry)?;
    let ledger = ledger::Ledger::read(texts.bounds, texts.misprints)?;
    let table_1 = perpendicular::table_1(&geometry, texts.table_1)?;
    let table_2 = perpendicular::table_2(&geometry, texts.table_2)?;
    let table_b1 = barrier::table_b1(&geometry, texts.table_b1, geometry::Wall::Fixed)?;
    let cells = statement::Cells { table_1: &table_1, table_2: &table_2, table_b1: &table_b1 };
    let statements = statement::all(&geometry, &cells, texts.table_b1)?;
    let tables = [table_1, table_2, table_b1].into_iter().enumerate();
    let tables = tables.map(|(which, cells)| TableReport::judged(which, cells, &ledger)).collect();
    Ok(Report { tables, statements, bounds: ledger.bounds, misprints: ledger.misprints })
}

#[cfg(test)]
mod tests;
