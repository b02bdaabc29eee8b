//! The findings of a run, and whether they all hold.

use crate::account::{Cell, Verdict};
use crate::chain::Link;
use crate::entries::{Entries, Given};
use crate::figure::Figure;
use crate::ledger::{Bound, LARGEST_SLACK, Ledger, Misprint, first};
use crate::measured::Measured;
use crate::problem::Problem;
use crate::statement::Statement;
use crate::tables::{Expected, TABLES};
use std::collections::HashSet;

/// Everything that a run found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The tables, in the order of the paper.
    pub tables: Vec<TableReport>,
    /// Statements of the paper in words, and checks across cells.
    pub statements: Vec<Statement>,
    /// The bounds of this run.
    pub bounds: Vec<Bound>,
    /// The misprints of this run.
    pub misprints: Vec<Misprint>,
    /// The chain by which one misprint caused another.
    pub chain: Vec<Link>,
    /// Figures 6 and 7, computed from the same numbers.
    pub figures: Vec<Figure>,
    /// The second stage: measured tests not in the paper.
    pub measured: Measured,
}

/// One table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableReport {
    /// Its name, such as `Table 1`.
    pub name: &'static str,
    /// Its computed cells.
    pub cells: Vec<Cell>,
    /// Its cells that are not computed.
    pub given: Vec<Given>,
    /// Number of computed cells that follow from other cells: copies, sums, unit conversions and the like.
    pub derived: usize,
    /// Number of cells in its text, computed or not.
    pub printed_cells: usize,
    /// Expected number of computed cells.
    pub expected_cells: usize,
    /// Expected number of given and measured cells.
    pub expected_given: usize,
    /// The cells that are given, measured, or taken from another table.
    pub remark: &'static str,
}

/// Number of cells with each verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells that agree to the last printed digit.
    pub agree: usize,
    /// Cells that agree within a stated bound.
    pub within_bound: usize,
    /// Cells that are misprinted.
    pub misprints: usize,
    /// Cells that are given or measured, and not computed.
    pub given: usize,
    /// Cells that are not accounted for.
    pub unaccounted: usize,
}

impl TableReport {
    pub(crate) fn judged(expected: &Expected, entries: Entries, ledger: &Ledger) -> Self {
        TableReport {
            name: expected.name,
            derived: entries.computed.iter().filter(|cell| (expected.derived)(&cell.row, cell.column)).count(),
            cells: entries.computed.into_iter().map(|computed| Cell::judged(computed, ledger)).collect(),
            given: entries.given,
            printed_cells: entries.printed,
            expected_cells: expected.computed,
            expected_given: expected.given,
            remark: expected.remark,
        }
    }

    /// Counts its cells by verdict.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts { given: self.given.len(), ..Counts::default() };
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

    /// Returns the problems with the number of its cells.
    fn miscounts(&self) -> Vec<Problem> {
        let (table, computed, given) = (self.name, self.cells.len(), self.given.len());
        let mut problems = Vec::new();
        if computed != self.expected_cells {
            problems.push(Problem::CellCount { table, expected: self.expected_cells, found: computed });
        }
        if given != self.expected_given {
            problems.push(Problem::GivenCount { table, expected: self.expected_given, found: given });
        }
        if computed + given != self.printed_cells {
            problems.push(Problem::LeftOut { table, printed: self.printed_cells, accounted: computed + given });
        }
        problems
    }

    /// Returns a computed cell by row and column.
    pub fn cell(&self, row: &str, column: &str) -> Option<&Cell> {
        self.cells.iter().find(|cell| cell.row == row && cell.column == column)
    }
}

impl Counts {
    /// Returns the total number of printed cells.
    pub fn total(&self) -> usize {
        self.agree + self.within_bound + self.misprints + self.given + self.unaccounted
    }
}

impl Report {
    /// Returns a table by name.
    pub fn table(&self, name: &str) -> Option<&TableReport> {
        self.tables.iter().find(|table| table.name == name)
    }

    /// Returns every computed cell of every table.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.tables.iter().flat_map(|table| &table.cells)
    }

    /// Counts the cells of all tables by verdict.
    pub fn counts(&self) -> Counts {
        self.tables.iter().map(TableReport::counts).fold(Counts::default(), |sum, table| Counts {
            agree: sum.agree + table.agree,
            within_bound: sum.within_bound + table.within_bound,
            misprints: sum.misprints + table.misprints,
            given: sum.given + table.given,
            unaccounted: sum.unaccounted + table.unaccounted,
        })
    }

    /// Returns the number of computed cells that follow from other cells, in all tables.
    pub fn derived(&self) -> usize {
        self.tables.iter().map(|table| table.derived).sum()
    }

    /// Returns `true` if every cell and statement is present and accounted for, and every bound and misprint is needed.
    pub fn holds(&self) -> bool {
        self.problems().is_empty()
    }

    /// Returns the reasons why it does not hold; empty if it does.
    pub fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        for Expected { name, .. } in TABLES {
            let mut found = self.tables.iter().filter(|table| table.name == name);
            match (found.next(), found.next()) {
                (Some(table), None) => problems.extend(table.miscounts()),
                _ => problems.push(Problem::Table { name }),
            }
        }
        let mut seen = HashSet::new();
        let given = self.tables.iter().flat_map(|table| &table.given).map(|given| (given.table, &given.row, given.column));
        for (table, row, column) in self.cells().map(|cell| (cell.table, &cell.row, cell.column)).chain(given) {
            if !seen.insert((table, row, column)) {
                problems.push(Problem::Repeated { table, row: row.clone(), column });
            }
        }
        for cell in self.cells() {
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
        problems.extend(self.chain.iter().filter(|link| !link.follows).cloned().map(Problem::Chain));
        if self.chain.is_empty() {
            problems.push(Problem::NoChain);
        }
        if self.figures.iter().map(|figure| figure.number).ne([6, 7]) {
            problems.push(Problem::Figures);
        }
        problems.extend(self.measured.problems().into_iter().map(Problem::Measured));
        problems
    }

    /// Returns for each bound the largest difference among the cells that need it, as a fraction of the bound, or
    /// `None` if no cell needs it.
    pub fn bounds_used(&self) -> Vec<Option<f64>> {
        let mut used = vec![None; self.bounds.len()];
        for cell in self.cells() {
            if let Some((which, bound)) = first(&self.bounds, cell.table, &cell.row, cell.column) {
                used[which] = cell.need_of(bound).into_iter().chain(used[which]).reduce(f64::max);
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

    /// Returns the outcome in one line.
    pub fn summary(&self) -> String {
        let Counts { agree, within_bound, misprints, given, unaccounted } = self.counts();
        let total = self.counts().total();
        let derived = self.derived();
        let mechanics = self.cells().count() - derived;
        let outcome = if self.holds() { "all accounted for" } else { "NOT all accounted for" };
        format!(
            "{total} cells: {agree} agree to the last digit, {within_bound} within a stated bound, {misprints} misprinted, {given} given or measured, {unaccounted} unaccounted for; the mechanics computes {mechanics} of them, {derived} follow from other cells; {} statements; {outcome}",
            self.statements.len()
        )
    }
}
