//! The cells of one table before they are judged: those that are computed, and those that nothing computes.

use crate::account::Computed;
use crate::data::DataError;
use crate::sheet::{Printed, Row, Sheet};

/// A printed cell that nothing computes.
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
    /// What the paper prints.
    pub printed: Printed,
    /// Why nothing computes it.
    pub nature: Nature,
}

/// Why nothing computes a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// The paper chose it.
    Chosen,
    /// It was measured in a test.
    Measured,
}

impl Nature {
    /// The reason in a word.
    pub fn name(self) -> &'static str {
        match self {
            Nature::Chosen => "given",
            Nature::Measured => "measured",
        }
    }
}

/// A column that nothing computes: its header in the text, its name in reports, its unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GivenColumn {
    pub(crate) header: &'static str,
    pub(crate) column: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) nature: Nature,
}

/// Both kinds of cells of a table, and how many its text holds.
#[derive(Clone, Debug)]
pub(crate) struct Entries {
    pub(crate) table: &'static str,
    pub(crate) computed: Vec<Computed>,
    pub(crate) given: Vec<Given>,
    /// Fields of the text that are not empty, labels aside: no cell may be left out.
    pub(crate) printed: usize,
}

impl Entries {
    /// None yet, of a text some of whose columns are no cells but labels of the rows.
    pub(crate) fn of(table: &'static str, sheet: &Sheet, labels: &[&str]) -> Self {
        Entries { table, computed: Vec::new(), given: Vec::new(), printed: sheet.filled(labels) }
    }

    pub(crate) fn compute(&mut self, row: &str, column: &'static str, unit: &'static str, printed: Printed, value: f64) {
        self.computed.push(Computed { table: self.table, row: row.to_owned(), column, unit, printed, value });
    }

    /// Adds the cells of a row that nothing computes. Where a column is empty in print there is none.
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
