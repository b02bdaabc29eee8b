//! Statements of the paper in words, and checks across cells.

mod crabbed;
mod crush_plane;
mod energies;
mod impulses;
mod restitution;
mod speeds;
mod units;

use crate::account::Computed;
use crate::data::DataError;
use crate::entries::Entries;
use crate::geometry::Geometry;
use crate::reconstruction::Reconstructions;
use crate::series::Series;
use crate::sheet::Printed;

/// A statement, with the computed result.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Its permanent name.
    pub name: &'static str,
    /// Its place in the paper; `this crate` for a check added by this crate.
    pub place: &'static str,
    /// The statement.
    pub says: &'static str,
    /// The computed result.
    pub found: String,
    /// The standing found by this run.
    pub standing: Standing,
    /// The known standing. A run in which the two differ does not hold.
    pub expected: Standing,
}

/// Standing of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Holds as worded.
    Holds,
    /// Holds under a condition that is missing from the statement and given in the result.
    HoldsConditionally,
    /// Does not hold as worded.
    Fails,
}

/// Number of statements that a run checks.
pub(crate) const COUNT: usize = 37;

/// The cells of the tables, before their comparison.
pub(crate) struct Cells<'a> {
    pub(crate) table_1: &'a [Computed],
    pub(crate) table_2: &'a [Computed],
    pub(crate) table_3: &'a Entries,
    pub(crate) table_5: &'a [Computed],
    pub(crate) table_6: &'a [Computed],
    /// The cells of Table B1 computed by planar impact mechanics.
    pub(crate) table_b1: &'a [Computed],
    pub(crate) table_b2: &'a [Computed],
}

/// The crabbed tests and the results from their crush.
pub(crate) struct Crabbed<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) series: &'a Series,
    pub(crate) found: &'a Reconstructions,
}

/// Checks every statement.
pub(crate) fn all(cells: &Cells<'_>, crabbed: &Crabbed<'_>, table_b1: &str) -> Result<Vec<Statement>, DataError> {
    let geometry = crabbed.geometry;
    let mut statements = restitution::statements(cells.table_1);
    statements.extend(speeds::statements(geometry, cells.table_1)?);
    statements.extend(crush_plane::statements(geometry, cells.table_2)?);
    statements.extend(impulses::statements(cells, crabbed));
    statements.extend(crabbed::statements(crabbed, cells.table_b1, table_b1)?);
    statements.extend(energies::statements(cells, crabbed)?);
    statements.extend(units::statements(cells));
    Ok(statements)
}

impl Statement {
    /// Returns `true` if its standing is the known one.
    pub fn is_as_expected(&self) -> bool {
        self.standing == self.expected
    }
}

impl Standing {
    /// Returns the standing in words.
    pub fn name(self) -> &'static str {
        match self {
            Standing::Holds => "holds",
            Standing::HoldsConditionally => "holds under a condition",
            Standing::Fails => "does not hold",
        }
    }

    fn of(holds: bool) -> Self {
        if holds { Standing::Holds } else { Standing::Fails }
    }

    /// Returns the standing of a statement from its truth where its condition is met, and elsewhere.
    fn conditional(where_met: bool, elsewhere: bool) -> Self {
        match (where_met, elsewhere) {
            (true, true) => Standing::Holds,
            (true, false) => Standing::HoldsConditionally,
            (false, _) => Standing::Fails,
        }
    }
}

/// Returns `true` if a computed number rounds to digits of the paper's text.
fn rounds_to(computed: f64, digits: &str) -> bool {
    Printed::parse(digits).is_some_and(|printed| printed.agrees_with(computed))
}

/// Returns the largest of some numbers; NaN if one of them is NaN, or if there are none.
fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let bigger = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
    numbers.into_iter().reduce(bigger).unwrap_or(f64::NAN)
}

fn joined(numbers: impl IntoIterator<Item = f64>, decimals: usize) -> String {
    let numbers: Vec<_> = numbers.into_iter().map(|number| format!("{number:.decimals$}")).collect();
    match &numbers[..] {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        _ => numbers.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    fn run() -> Vec<Statement> {
        crate::run_on(&Texts::embedded()).expect("embedded").statements
    }

    #[test]
    fn every_statement_stands_as_expected() {
        for statement in run() {
            assert!(statement.is_as_expected(), "{statement:#?}");
        }
    }

    #[test]
    fn names_are_unique_and_their_number_is_known() {
        let mut names = run().into_iter().map(|statement| statement.name).collect::<Vec<_>>();
        assert_eq!(names.len(), COUNT);
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), COUNT);
    }

    #[test]
    fn the_largest_does_not_lose_a_nan() {
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan() && largest([f64::NAN, 2.0]).is_nan() && largest([]).is_nan());
    }
}
