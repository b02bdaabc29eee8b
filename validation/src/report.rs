//! What a run found, and whether it holds.

use crate::account::{Cell, Computed, Verdict};
use crate::ledger::{Bound, LARGEST_SLACK, Ledger, Misprint, first};
use crate::statement::Statement;
use std::collections::HashSet;
use std::fmt;

/// Everything that a run found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The tables, in the order of the paper.
    pub tables: Vec<TableReport>,
    /// What the paper says in words, and checks across cells.
    pub statements: Vec<Statement>,
    /// The bounds of this run.
    pub bounds: Vec<Bound>,
    /// The misprints of this run.
    pub misprints: Vec<Misprint>,
}

/// One table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableReport {
    /// Its name, such as `Table 1`.
    pub name: &'static str,
    /// Its computed cells, row by row.
    pub cells: Vec<Cell>,
    /// How many there should be.
    pub expected_cells: usize,
    /// Columns that are given or measured: nothing computes them.
    pub not_computed: &'static str,
}

/// How many cells have which verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells that agree to the last printed digit.
    pub agree: usize,
    /// Cells that agree within a stated bound.
    pub within_bound: usize,
    /// Cells that are wrong in print.
    pub misprints: usize,
    /// Cells that are not accounted for.
    pub unaccounted: usize,
}

/// Why a report does not hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// A table is missing, or stands there twice.
    Table {
        /// Its name.
        name: &'static str,
    },
    /// A table has more or fewer computed cells than the paper.
    CellCount {
        /// The table.
        table: &'static str,
        /// How many it should have.
        expected: usize,
        /// How many it has.
        found: usize,
    },
    /// A cell stands there twice.
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
    /// A bound is wider than [`LARGEST_SLACK`] times what it covers.
    LooseBound {
        /// The bound.
        bound: Bound,
        /// The largest difference that it covers, as a fraction of it.
        used: f64,
    },
    /// A listed misprint is no misprint of any cell.
    StaleMisprint(Misprint),
    /// Fewer statements were checked than there are.
    StatementCount {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A statement does not stand as expected.
    Statement(Statement),
}

/// The tables of the paper that are held to account, with the number of their computed cells.
pub(crate) const TABLES: [(&str, usize, &str); 3] = [
    (crate::perpendicular::TABLE_1, 27 * 3, "v_1x, v_2y, e and the position are given"),
    (crate::perpendicular::TABLE_2, 13 * 3, "Γ is given"),
    (crate::barrier::TABLE_B1, 6 * 11, "v_i and e are given; μ, Ω and ΔV of the tests are measured"),
];

impl TableReport {
    pub(crate) fn judged(which: usize, cells: Vec<Computed>, ledger: &Ledger) -> Self {
        let (name, expected_cells, not_computed) = TABLES[which];
        TableReport {
            name,
            cells: cells.into_iter().map(|computed| Cell::judged(computed, ledger)).collect(),
            expected_cells,
            not_computed,
        }
    }

    /// Its cells by verdict.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for cell in &self.cells {
            match cell.verdict {
                Verdict::Agrees => counts.agree += 1,
                Verdict::WithinBound { .. } => counts.within_bound += 1,
                Verdict::Misprint { .. } => counts.misprints += 1,
                _ => counts.unaccounted += 1,
            }
        }
        counts
    }

    /// A cell by row and column.
    pub fn cell(&self, row: &str, column: &str) -> Option<&Cell> {
        self.cells.iter().find(|cell| cell.row == row && cell.column == column)
    }
}

impl Counts {
    /// All of them.
    pub fn total(&self) -> usize {
        self.agree + self.within_bound + self.misprints + self.unaccounted
    }
}

impl Report {
    /// A table by name.
    pub fn table(&self, name: &str) -> Option<&TableReport> {
        self.tables.iter().find(|table| table.name == name)
    }

    /// Every cell of every table.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.tables.iter().flat_map(|table| &table.cells)
    }

    /// The cells of all tables by verdict.
    pub fn counts(&self) -> Counts {
        self.tables.iter().map(TableReport::counts).fold(Counts::default(), |sum, table| Counts {
            agree: sum.agree + table.agree,
            within_bound: sum.within_bound + table.within_bound,
            misprints: sum.misprints + table.misprints,
            unaccounted: sum.unaccounted + table.unaccounted,
        })
    }

    /// Whether every cell and statement is there and accounted for, and every bound and misprint is needed.
    pub fn holds(&self) -> bool {
        self.problems().is_empty()
    }

    /// Why it does not hold; empty if it does.
    pub fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        for (name, expected, _) in TABLES {
            let mut found = self.tables.iter().filter(|table| table.name == name);
            match (found.next(), found.next()) {
                (Some(table), None) if table.cells.len() == expected => (),
                (Some(table), None) => problems.push(Problem::CellCount { table: name, expected, found: table.cells.len() }),
                _ => problems.push(Problem::Table { name }),
            }
        }
        let mut seen = HashSet::new();
        for cell in self.cells() {
            if !seen.insert((cell.table, &cell.row, cell.column)) {
                problems.push(Problem::Repeated { table: cell.table, row: cell.row.clone(), column: cell.column });
            }
            if !cell.verdict.is_accounted_for() {
                problems.push(Problem::Cell(cell.clone()));
            }
        }
        for (bound, used) in self.bounds.iter().zip(self.bounds_used()) {
            match used {
                None => problems.push(Problem::UnusedBound(bound.clone())),
                Some(used) if used * LARGEST_SLACK < 1.0 => problems.push(Problem::LooseBound { bound: bound.clone(), used }),
                Some(_) => (),
            }
        }
        problems.extend(self.misprints.iter().filter(|misprint| !self.has(misprint)).cloned().map(Problem::StaleMisprint));
        let expected = crate::statement::COUNT;
        if self.statements.len() != expected {
            problems.push(Problem::StatementCount { expected, found: self.statements.len() });
        }
        problems.extend(self.statements.iter().filter(|statement| !statement.is_as_expected()).cloned().map(Problem::Statement));
        problems
    }

    /// For each bound, the largest difference among the cells that need it, as a fraction of the bound; None if no cell needs it.
    pub fn bounds_used(&self) -> Vec<Option<f64>> {
        let mut used = vec![None; self.bounds.len()];
        for cell in self.cells() {
            if let Some((which, bound)) = first(&self.bounds, cell.table, &cell.row, cell.column) {
                used[which] = bound.need_of(cell).into_iter().chain(used[which]).reduce(f64::max);
            }
        }
        used
    }

    fn has(&self, misprint: &Misprint) -> bool {
        self.cells().any(|cell| {
            let place = cell.table == misprint.table && cell.row == misprint.row && cell.column == misprint.column;
            let verdict = matches!(&cell.verdict, Verdict::Misprint { holds, .. } if *holds == misprint.holds);
            place && verdict && cell.printed.text() == misprint.printed.text()
        })
    }

    /// The outcome in one line.
    pub fn summary(&self) -> String {
        let Counts { agree, within_bound, misprints, unaccounted } = self.counts();
        let total = self.counts().total();
        let outcome = if self.holds() { "all accounted for" } else { "NOT all accounted for" };
        format!(
            "{total} cells: {agree} agree to the last digit, {within_bound} within a stated bound, {misprints} misprinted, {unaccounted} unaccounted for; {} statements; {outcome}",
            self.statements.len()
        )
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Table { name } => write!(f, "{name} must be there once"),
            Problem::CellCount { table, expected, found } => write!(f, "{table} has {found} computed cells, and should have {expected}"),
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
        }
    }
}
