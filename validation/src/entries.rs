//! The cells of one table before their comparison: those that are computed, and those that are not.

use crate::account::Computed;
use crate::data::DataError;
use crate::sheet::{Printed, Row, Sheet};

/// A printed cell that is not computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The table.
    pub table: &'static str,
    /// The row's label.
    pub row: String,
    /// The column.
    pub column: &'static str,
    /// Its unit; `1` for a ratio.
    pub unit: &'static str,
    /// The value printed in the paper.
    pub printed: Printed,
    /// Reason why it is not computed.
    pub nature: Nature,
}

/// Reason why a cell is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// The paper chose it.
    Chosen,
    /// It was measured in a test.
    Measured,
}

impl Nature {
    /// Returns the reason in one word.
    pub fn name(self) -> &'static str {
        match self {
            Nature::Chosen => "given",
            Nature::Measured => "measured",
        }
    }
}

/// A column that is not computed: its header in the text, its name in reports, its unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GivenColumn {
    pub(crate) header: &'static str,
    pub(crate) column: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) nature: Nature,
}

/// Both kinds of cells of a table, and the number of cells in its text.
#[derive(Clone, Debug)]
pub(crate) struct Entries {
    pub(crate) table: &'static str,
    pub(crate) computed: Vec<Computed>,
    pub(crate) given: Vec<Given>,
    /// Number of nonempty fields in the text, without labels; used to check that no cell is left out.
    pub(crate) printed: usize,
}

impl Entries {
    /// Creates an empty collection for a table; the columns `labels` are row labels, not cells.
    pub(crate) fn of(table: &'static str, sheet: &Sheet, labels: &[&str]) -> Self {
        Entries { table, computed: Vec::new(), given: Vec::new(), printed: sheet.filled(labels) }
    }

    pub(crate) fn compute(&mut self, row: &str, column: &'static str, unit: &'static str, printed: Printed, value: f64) {
        self.computed.push(Computed { table: self.table, row: row.to_owned(), column, unit, printed, value });
    }

    /// Adds the cells of a row that are not computed, except for columns that are empty in print.
    pub(crate) fn give(&mut self, row: &Row<'_>, label: &str, columns: &[GivenColumn]) -> Result<(), DataError> {
        for &GivenColumn { header, column, unit, nature } in columns {
            if let Some(printed) = row.number_if_any(header)? {
                self.given.push(Given { table: self.table, row: label.to_owned(), column, unit, printed, nature });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEED: GivenColumn = GivenColumn { header: "v", column: "v_i", unit: "ft/s", nature: Nature::Chosen };

    #[test]
    fn labels_and_blanks_are_no_cells() {
        let sheet = Sheet::read("t.csv", "test,v,w\n1,2.0,\n2,,3\n").expect("well formed");
        let mut entries = Entries::of("T", &sheet, &["test"]);
        assert_eq!(entries.printed, 2);
        for row in sheet.rows() {
            entries.give(&row, "1", &[SPEED]).expect("digits");
        }
        assert_eq!(entries.given.iter().map(|given| given.printed.text()).collect::<Vec<_>>(), ["2.0"]);
    }

    #[test]
    fn a_given_cell_is_a_number() {
        let sheet = Sheet::read("t.csv", "v\nfast\n").expect("well formed");
        let row = sheet.rows().next().expect("one row");
        let error = Entries::of("T", &sheet, &[]).give(&row, "1", &[SPEED]).err();
        assert!(matches!(error, Some(DataError::NotANumber { column: "v", .. })));
    }
}
