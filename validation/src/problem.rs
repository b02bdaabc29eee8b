//! Problems of a report that does not hold.

use crate::account::Cell;
use crate::chain::Link;
use crate::ledger::{Bound, Misprint};
use crate::measured::MeasuredProblem;
use crate::statement::Statement;
use std::fmt;

/// Reason why a report does not hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// A table is missing, or occurs twice.
    Table {
        /// Its name.
        name: &'static str,
    },
    /// A table has more or fewer computed cells than the paper.
    CellCount {
        /// The table.
        table: &'static str,
        /// Expected number.
        expected: usize,
        /// Actual number.
        found: usize,
    },
    /// A table has more or fewer cells that are not computed than the paper.
    GivenCount {
        /// The table.
        table: &'static str,
        /// Expected number.
        expected: usize,
        /// Actual number.
        found: usize,
    },
    /// Cells of a table's text are neither computed nor given.
    LeftOut {
        /// The table.
        table: &'static str,
        /// Number of cells in its text.
        printed: usize,
        /// Number of those in the report.
        accounted: usize,
    },
    /// A cell occurs twice.
    Repeated {
        /// The table.
        table: &'static str,
        /// The row's label.
        row: String,
        /// The column.
        column: &'static str,
    },
    /// A cell is not accounted for.
    Cell(Cell),
    /// A bound covers no cell that needs it.
    UnusedBound(Bound),
    /// A bound is wider than [`LARGEST_SLACK`](crate::LARGEST_SLACK) times the largest difference that it covers.
    LooseBound {
        /// The bound.
        bound: Bound,
        /// The largest difference that it covers, as a fraction of the bound.
        used: f64,
    },
    /// A listed misprint matches no cell.
    StaleMisprint(Misprint),
    /// The number of statements checked is not the expected one.
    StatementCount {
        /// Expected number.
        expected: usize,
        /// Actual number.
        found: usize,
    },
    /// A statement does not have the expected standing.
    Statement(Statement),
    /// A link of the chain of misprints does not follow from the one before.
    Chain(Link),
    /// The chain of misprints is missing.
    NoChain,
    /// A figure is missing, or occurs twice.
    Figures,
    /// A measured test differs from its record, or cannot be right.
    Measured(MeasuredProblem),
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Table { name } => write!(f, "{name} must be there once"),
            Problem::CellCount { table, expected, found } => write!(f, "{table} has {found} computed cells, and should have {expected}"),
            Problem::GivenCount { table, expected, found } => {
                write!(f, "{table} has {found} given or measured cells, and should have {expected}")
            }
            Problem::LeftOut { table, printed, accounted } => {
                write!(f, "{table} has {printed} cells in print, and {accounted} in the report")
            }
            Problem::Repeated { table, row, column } => write!(f, "{table}, {row}, {column} stands there twice"),
            Problem::Cell(cell) => {
                let (table, row, column, verdict) = (cell.table, &cell.row, cell.column, cell.verdict.name());
                write!(f, "{table}, {row}, {column}: {verdict}: printed {}, computed {}", cell.printed.text(), cell.computed)
            }
            Problem::UnusedBound(bound) => {
                write!(f, "the bound of {}, {}, {} is for no cell that needs it", bound.table, bound.rows, bound.column)
            }
            Problem::LooseBound { bound, used } => {
                write!(f, "the bound of {}, {}, {} is too wide: {used:.2} of it is used", bound.table, bound.rows, bound.column)
            }
            Problem::StaleMisprint(misprint) => {
                let Misprint { table, row, column, .. } = misprint;
                write!(f, "{table}, {row}, {column} is listed as a misprint of {}, and is none", misprint.holds.text())
            }
            Problem::StatementCount { expected, found } => write!(f, "{found} statements were checked, and {expected} should have been"),
            Problem::Statement(statement) => {
                let (was, is) = (statement.expected.name(), statement.standing.name());
                write!(f, "{}: {is}, and should be: {was}; found {}", statement.name, statement.found)
            }
            Problem::Chain(link) => write!(f, "{}: {} does not follow: {}", link.place, link.printed, link.how),
            Problem::NoChain => write!(f, "the chain of misprints is missing"),
            Problem::Figures => write!(f, "figures 6 and 7 must be there once"),
            Problem::Measured(problem) => problem.fmt(f),
        }
    }
}
