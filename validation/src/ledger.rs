//! Known deviations: bounds with their reasons, and misprints.

use crate::data::DataError;
use crate::sheet::{Printed, Sheet};

/// A bound on the difference of some cells from the printed values.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The table.
    pub table: String,
    /// A row's label, or its first word, or `*` for every row.
    pub rows: String,
    /// The column.
    pub column: String,
    /// The bound.
    pub size: f64,
    /// `true` if the size is a percentage of the cell; otherwise it is in the cell's unit.
    pub is_percent: bool,
    /// Reason for the difference.
    pub reason: String,
}

/// A misprinted cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Misprint {
    /// The table.
    pub table: String,
    /// The row's label.
    pub row: String,
    /// The column.
    pub column: String,
    /// The printed value.
    pub printed: Printed,
    /// The correct value.
    pub holds: Printed,
    /// Evidence for the misprint.
    pub why: String,
}

/// Maximum ratio of a bound to the largest difference that it covers.
pub const LARGEST_SLACK: f64 = 1.5;

impl Bound {
    /// Returns the bound in the unit of a cell with this value.
    pub fn around(&self, value: f64) -> f64 {
        if self.is_percent { value.abs() * self.size / 100.0 } else { self.size }
    }

    /// Returns `true` if the bound applies to a cell.
    pub fn covers(&self, table: &str, row: &str, column: &str) -> bool {
        let rows = self.rows == "*" || self.rows == row || row.split(' ').next() == Some(self.rows.as_str());
        self.table == table && self.column == column && rows
    }
}

/// The bounds and misprints of a run.
#[derive(Clone, Debug)]
pub(crate) struct Ledger {
    pub(crate) bounds: Vec<Bound>,
    pub(crate) misprints: Vec<Misprint>,
}

impl Ledger {
    pub(crate) fn read(bounds: &str, misprints: &str) -> Result<Self, DataError> {
        const BOUNDS: &str = "bounds.csv";
        let sheet = Sheet::read(BOUNDS, bounds)?;
        let bounds = sheet.rows().map(|row| {
            let size = row.number("bound")?;
            if size.value() <= 0.0 {
                return Err(DataError::NotANumber { file: BOUNDS, column: "bound", field: size.text().to_owned() });
            }
            let is_percent = match row.text("kind")? {
                "absolute" => false,
                "percent" => true,
                field => return Err(DataError::UnknownWord { file: BOUNDS, column: "kind", field: field.to_owned() }),
            };
            Ok(Bound {
                table: row.text("table")?.to_owned(),
                rows: row.text("rows")?.to_owned(),
                column: row.text("column")?.to_owned(),
                size: size.value(),
                is_percent,
                reason: stated(BOUNDS, "reason", row.text("reason")?)?,
            })
        });
        let bounds = bounds.collect::<Result<_, _>>()?;
        let sheet = Sheet::read("misprints.csv", misprints)?;
        let misprints = sheet.rows().map(|row| {
            Ok(Misprint {
                table: row.text("table")?.to_owned(),
                row: row.text("row")?.to_owned(),
                column: row.text("column")?.to_owned(),
                printed: row.number("printed")?,
                holds: row.number("holds")?,
                why: stated("misprints.csv", "why", row.text("why")?)?,
            })
        });
        Ok(Ledger { bounds, misprints: misprints.collect::<Result<_, _>>()? })
    }

    /// Returns the first bound for a cell. A second bound would cover nothing, and be reported as unused.
    pub(crate) fn bound_of(&self, table: &str, row: &str, column: &str) -> Option<&Bound> {
        first(&self.bounds, table, row, column).map(|(_, bound)| bound)
    }

    /// Returns the misprint of a cell, if the cell has the printed value of the misprint.
    pub(crate) fn misprint_of(&self, table: &str, row: &str, column: &str, printed: &Printed) -> Option<&Misprint> {
        let listed = |m: &&Misprint| m.table == table && m.row == row && m.column == column;
        self.misprints.iter().filter(listed).find(|misprint| misprint.printed.text() == printed.text())
    }
}

/// Returns the first bound for a cell, with its index.
pub(crate) fn first<'a>(bounds: &'a [Bound], table: &str, row: &str, column: &str) -> Option<(usize, &'a Bound)> {
    bounds.iter().enumerate().find(|(_, bound)| bound.covers(table, row, column))
}

fn stated(file: &'static str, column: &'static str, text: &str) -> Result<String, DataError> {
    if text.is_empty() { Err(DataError::UnknownWord { file, column, field: String::new() }) } else { Ok(text.to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn a_bound_is_for_a_row_its_first_word_or_all() {
        let bound = |rows: &str| Bound {
            table: "Table 1".into(),
            rows: rows.into(),
            column: "W_n".into(),
            size: 1.0,
            is_percent: false,
            reason: "made up".into(),
        };
        for (rows, covered) in [("*", true), ("B", true), ("B -40 40 0.00", true), ("-40", false), ("B -40", false), ("A", false)] {
            assert_eq!(bound(rows).covers("Table 1", "B -40 40 0.00", "W_n"), covered, "{rows}");
        }
        assert!(!bound("*").covers("Table 2", "0", "W_n"));
        assert!(!bound("*").covers("Table 1", "B", "W_t"));
    }

    #[test]
    fn bounds_need_a_size_a_kind_and_a_reason() {
        let texts = Texts::embedded();
        for (from, to) in [(",1.1,", ",0,"), (",1.1,", ",-1.1,"), (",1.1,", ",wide,"), (",percent,", ",relative,")] {
            assert!(Ledger::read(&texts.bounds.replace(from, to), texts.misprints).is_err(), "{to}");
        }
        let bare = "table,rows,column,bound,kind,reason\nTable 1,B,W_n,1.1,absolute,\n";
        assert!(matches!(Ledger::read(bare, texts.misprints), Err(DataError::UnknownWord { column: "reason", .. })));
        assert!(Ledger::read(texts.bounds, &texts.misprints.replace("43197.30,", "many,")).is_err());
    }
}
