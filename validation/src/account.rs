//! A cell of a table and its verdict.

use crate::ledger::{Bound, Ledger, Misprint};
use crate::sheet::Printed;

/// A printed cell that the paper computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The table, such as `Table 1`.
    pub table: &'static str,
    /// The row's label: the inputs that identify it.
    pub row: String,
    /// The column.
    pub column: &'static str,
    /// Its unit; `1` for a ratio.
    pub unit: &'static str,
    /// The value printed in the paper.
    pub printed: Printed,
    /// The value that the library computes.
    pub computed: f64,
    /// Result of the comparison.
    pub verdict: Verdict,
}

/// Result of comparing a computed value with the printed one.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The computed value rounds to the printed one.
    Agrees,
    /// The computed value does not round to the printed one, for a stated reason, but differs from it by no more than a stated bound.
    WithinBound {
        /// The bound, in the unit of the cell.
        bound: f64,
        /// The reason.
        reason: String,
    },
    /// The printed value is wrong: the computed value agrees with another one.
    Misprint {
        /// The correct value.
        holds: Printed,
        /// Evidence for the misprint.
        why: String,
    },
    /// The difference exceeds the allowed one: a failure.
    Disagrees {
        /// The allowed difference, in the unit of the cell.
        allowed: f64,
    },
    /// The cell is listed as a misprint but agrees: a failure.
    MisprintAgrees,
    /// The cell is listed as a misprint, but the computed value does not agree with the correction: a failure.
    CorrectionDisagrees {
        /// The correction.
        holds: Printed,
        /// The allowed difference, in the unit of the cell.
        allowed: f64,
    },
}

impl Cell {
    /// Returns the fraction of its bound that the cell needs, or `None` if it does not need the bound.
    pub(crate) fn need_of(&self, bound: &Bound) -> Option<f64> {
        let difference = match &self.verdict {
            Verdict::WithinBound { .. } => self.difference(),
            Verdict::Misprint { holds, .. } if !holds.agrees_with(self.computed) => self.computed - holds.value(),
            _ => return None,
        };
        Some(difference.abs() / bound.around(self.computed))
    }
}

impl Verdict {
    /// Returns `true` if the cell is accounted for.
    pub fn is_accounted_for(&self) -> bool {
        matches!(self, Verdict::Agrees | Verdict::WithinBound { .. } | Verdict::Misprint { .. })
    }

    /// Returns the verdict in one or two words.
    pub fn name(&self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::WithinBound { .. } => "within bound",
            Verdict::Misprint { .. } => "misprint",
            Verdict::Disagrees { .. } => "disagrees",
            Verdict::MisprintAgrees => "listed as a misprint, and agrees",
            Verdict::CorrectionDisagrees { .. } => "correction disagrees",
        }
    }
}

impl Cell {
    /// Returns computed minus printed.
    pub fn difference(&self) -> f64 {
        self.computed - self.printed.value()
    }

    pub(crate) fn judged(computed: Computed, ledger: &Ledger) -> Self {
        let Computed { table, row, column, unit, printed, value } = computed;
        let bound = ledger.bound_of(table, &row, column);
        let verdict = match ledger.misprint_of(table, &row, column, &printed) {
            Some(misprint) => judge_misprint(misprint, &printed, value, bound),
            None => judge(&printed, value, bound),
        };
        Cell { table, row, column, unit, printed, computed: value, verdict }
    }
}

/// A cell before its comparison.
#[derive(Clone, Debug)]
pub(crate) struct Computed {
    pub(crate) table: &'static str,
    pub(crate) row: String,
    pub(crate) column: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) printed: Printed,
    pub(crate) value: f64,
}

/// Returns the computed value of a cell; NaN, which agrees with nothing, if there is no such cell.
pub(crate) fn value(cells: &[Computed], row: &str, column: &str) -> f64 {
    find(cells, row, column).map_or(f64::NAN, |cell| cell.value)
}

/// Returns the printed value of a cell; NaN if there is no such cell.
pub(crate) fn printed(cells: &[Computed], row: &str, column: &str) -> f64 {
    find(cells, row, column).map_or(f64::NAN, |cell| cell.printed.value())
}

/// Returns the cell in a row and column.
pub(crate) fn find<'a>(cells: &'a [Computed], row: &str, column: &str) -> Option<&'a Computed> {
    cells.iter().find(|cell| cell.row == row && cell.column == column)
}

fn judge(printed: &Printed, value: f64, bound: Option<&Bound>) -> Verdict {
    if printed.agrees_with(value) {
        return Verdict::Agrees;
    }
    match bound {
        // A percentage of infinity is not a bound.
        Some(bound) if value.is_finite() && (value - printed.value()).abs() <= bound.around(value) => {
            Verdict::WithinBound { bound: bound.around(value), reason: bound.reason.clone() }
        }
        // Not "greater than", because a NaN must disagree, too.
        _ => Verdict::Disagrees { allowed: allowed(printed, value, bound) },
    }
}

fn judge_misprint(misprint: &Misprint, printed: &Printed, value: f64, bound: Option<&Bound>) -> Verdict {
    let holds = &misprint.holds;
    let near = |number: &Printed| !matches!(judge(number, value, bound), Verdict::Disagrees { .. });
    if near(printed) {
        Verdict::MisprintAgrees
    } else if near(holds) {
        Verdict::Misprint { holds: holds.clone(), why: misprint.why.clone() }
    } else {
        Verdict::CorrectionDisagrees { holds: holds.clone(), allowed: allowed(holds, value, bound) }
    }
}

fn allowed(printed: &Printed, value: f64, bound: Option<&Bound>) -> f64 {
    bound.map_or(0.0, |bound| bound.around(value)).max(printed.half_unit())
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: &str = "table,rows,column,bound,kind,reason\nT,B,w,1.1,absolute,rounded weights\nT,C,w,1,percent,a hundredth\n";
    const MISPRINTS: &str = "table,row,column,printed,holds,why\nT,A 1,w,49.2,43.2,the sum\nT,B 1,w,49.2,43.2,the sum\n";

    /// Judges a cell of an invented table.
    fn verdict(row: &str, printed: &str, value: f64) -> Verdict {
        let ledger = Ledger::read(BOUNDS, MISPRINTS).expect("well formed");
        let printed = Printed::parse(printed).expect("digits");
        Cell::judged(Computed { table: "T", row: row.into(), column: "w", unit: "1", printed, value }, &ledger).verdict
    }

    #[test]
    fn without_a_bound_the_last_digit_decides() {
        assert_eq!(verdict("A 2", "10.0", 10.04), Verdict::Agrees);
        assert_eq!(verdict("A 2", "10.0", 10.06), Verdict::Disagrees { allowed: 0.05 });
        assert!(!verdict("A 2", "10.0", f64::NAN).is_accounted_for());
    }

    #[test]
    fn a_bound_is_the_second_resort() {
        assert_eq!(verdict("B 2", "10.0", 10.04), Verdict::Agrees);
        assert_eq!(verdict("B 2", "10.0", 11.0), Verdict::WithinBound { bound: 1.1, reason: "rounded weights".into() });
        assert_eq!(verdict("B 2", "10.0", 11.2), Verdict::Disagrees { allowed: 1.1 });
        assert!(matches!(verdict("C", "100.0", 100.5), Verdict::WithinBound { bound, .. } if (bound - 1.005).abs() < 1e-12));
        assert!(!verdict("C", "100.0", f64::INFINITY).is_accounted_for());
    }

    #[test]
    fn a_misprint_must_disagree_and_its_correction_agree() {
        assert!(matches!(verdict("A 1", "49.2", 43.21), Verdict::Misprint { .. }));
        assert_eq!(verdict("A 1", "49.2", 49.21), Verdict::MisprintAgrees);
        assert!(matches!(verdict("A 1", "49.2", 44.0), Verdict::CorrectionDisagrees { allowed: 0.05, .. }));
        assert!(matches!(verdict("A 1", "49.2", f64::NAN), Verdict::CorrectionDisagrees { .. }));
        // With a bound of 1.1 both the correction and the printed value may differ by that much.
        assert!(matches!(verdict("B 1", "49.2", 44.0), Verdict::Misprint { .. }));
        assert_eq!(verdict("B 1", "49.2", 48.5), Verdict::MisprintAgrees);
    }

    #[test]
    fn a_misprint_of_other_digits_is_not_this_one() {
        assert_eq!(verdict("A 1", "43.2", 43.21), Verdict::Agrees);
    }
}
