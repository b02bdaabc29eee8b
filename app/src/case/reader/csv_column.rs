//! One column of a CSV text, whose first line names the columns.

use csv_core::{ReadRecordResult, Reader};

use crate::batch::Header;
use crate::quantity::QuantityError;
use crate::wording::ragged;

/// A column of a table.
#[derive(Debug, PartialEq)]
pub(super) struct CsvColumn {
    /// The unit in its header.
    pub(super) unit: Option<String>,
    /// The line of each row, counted from 1, and the text of its cell.
    pub(super) cells: Vec<(usize, Result<String, NoCell>)>,
}

/// The error of a table that has not exactly one column of a name.
#[derive(Debug, PartialEq)]
pub(super) struct NoColumn {
    /// The name.
    pub(super) name: String,
    /// How many columns have it.
    pub(super) count: usize,
    /// The names of all columns, at most [`MOST_NAMES`].
    pub(super) names: Vec<String>,
}

/// The error of a row without a text in the column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoCell {
    /// The cell is empty.
    Empty,
    /// The row has more cells or fewer than the table has columns, so that any of them may be meant.
    Ragged {
        /// The number of cells in the row.
        cells: usize,
        /// The number of columns.
        columns: usize,
    },
}

/// Maximum number of column names that a message lists.
const MOST_NAMES: usize = 20;

impl CsvColumn {
    /// Finds a column by its name, and reads its cells.
    pub(super) fn of(text: &str, name: &str) -> Result<CsvColumn, NoColumn> {
        let mut rows = Rows::of(text);
        let headers: Vec<Header> = rows.next().into_iter().flat_map(|(_, cells)| cells).map(|cell| Header::read(&cell)).collect();
        let found: Vec<usize> = (0..headers.len()).filter(|&i| headers[i].name == name).collect();
        let [place] = found[..] else {
            let names = headers.into_iter().map(|header| header.name).take(MOST_NAMES).collect();
            return Err(NoColumn { name: name.to_owned(), count: found.len(), names });
        };
        let cell = |(line, cells): (usize, Vec<String>)| {
            let cell = match cells.get(place).map(|cell| cell.trim()) {
                _ if cells.len() != headers.len() => Err(NoCell::Ragged { cells: cells.len(), columns: headers.len() }),
                None | Some("") => Err(NoCell::Empty),
                Some(text) => Ok(text.to_owned()),
            };
            (line, cell)
        };
        Ok(CsvColumn { unit: headers[place].unit.clone(), cells: rows.map(cell).collect() })
    }
}

impl From<NoCell> for QuantityError {
    fn from(cell: NoCell) -> QuantityError {
        let message = match cell {
            NoCell::Empty => "the cell is empty; expected a number".to_owned(),
            NoCell::Ragged { cells, columns } => ragged(cells, columns),
        };
        QuantityError { message, help: None }
    }
}

/// The rows of a CSV text that are not empty, each with its line.
pub(crate) struct Rows<'a> {
    reader: Reader,
    rest: &'a [u8],
    line: usize,
}

impl<'a> Rows<'a> {
    pub(crate) fn of(text: &'a str) -> Rows<'a> {
        Rows { reader: Reader::new(), rest: text.as_bytes(), line: 1 }
    }

    /// Skips a part of the text and counts its lines.
    fn skip(&mut self, bytes: usize) {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.line += skipped.iter().filter(|byte| **byte == b'\n').count();
        self.rest = rest;
    }
}

impl Iterator for Rows<'_> {
    type Item = (usize, Vec<String>);

    fn next(&mut self) -> Option<Self::Item> {
        let blank = self.rest.iter().take_while(|byte| matches!(byte, b'\n' | b'\r')).count();
        self.skip(blank);
        let line = self.line;
        let (mut text, mut ends) = (vec![0; 256], vec![0; 16]);
        let (mut written, mut count) = (0, 0);
        loop {
            let (result, used, more, ended) = self.reader.read_record(self.rest, &mut text[written..], &mut ends[count..]);
            self.skip(used);
            (written, count) = (written + more, count + ended);
            match result {
                // Without input left, the reader ends the record.
                ReadRecordResult::InputEmpty => (),
                ReadRecordResult::OutputFull => text.resize(2 * text.len(), 0),
                ReadRecordResult::OutputEndsFull => ends.resize(2 * ends.len(), 0),
                ReadRecordResult::Record => break,
                ReadRecordResult::End => return None,
            }
        }
        let mut start = 0;
        let cells = ends[..count].iter().map(|&end| {
            // The text is split only at ASCII characters, so each piece is valid UTF-8.
            let cell = String::from_utf8_lossy(&text[start..end]).into_owned();
            start = end;
            cell
        });
        Some((line, cells.collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(text: &str, name: &str) -> Vec<(usize, Result<String, NoCell>)> {
        CsvColumn::of(text, name).expect("the column").cells
    }

    fn numbers(of: &[(usize, &str)]) -> Vec<(usize, Result<String, NoCell>)> {
        of.iter().map(|(line, text)| (*line, Ok((*text).to_owned()))).collect()
    }

    #[test]
    fn a_column_has_its_unit_and_its_lines() {
        let column = CsvColumn::of("site,speed [mph]\na,40\n\n\"b, c\", 41 \r\n\r\nd,\"42\"", "speed").expect("the column");
        assert_eq!((column.unit.as_deref(), column.cells), (Some("mph"), numbers(&[(2, "40"), (4, "41"), (6, "42")])));
        // A quotation may have lines of its own.
        assert_eq!(cells("note,x\n\"two\nlines\",1\n,2\n", "x"), numbers(&[(2, "1"), (4, "2")]));
        assert_eq!(cells("x\r\n1\r\n2\r\n", "x"), numbers(&[(2, "1"), (3, "2")]));
        // Longer than the first buffers.
        let wide = format!("{}x\n{}7\n", "a,".repeat(100), "1.000000,".repeat(100));
        assert_eq!(cells(&wide, "x"), numbers(&[(2, "7")]));
    }

    #[test]
    fn rows_without_a_cell() {
        let found = cells("a,b\n1\n1,\n1,2\n1,2,3\n", "b");
        let ragged = |cells| Err(NoCell::Ragged { cells, columns: 2 });
        assert_eq!(found, [(2, ragged(1)), (3, Err(NoCell::Empty)), (4, Ok("2".to_owned())), (5, ragged(3))]);
        // The first cell of such a row may be half of a number.
        assert_eq!(cells("a,b\n30,5,1\n30\n", "a"), [(2, ragged(3)), (3, ragged(1))]);
        let told = QuantityError::from(NoCell::Ragged { cells: 3, columns: 2 }).message;
        assert_eq!(told, "the row has 3 cells, and the table has 2 columns; a decimal comma?");
        assert_eq!(cells("a,b\n", "b"), []);
    }

    #[test]
    fn a_name_that_no_column_or_more_than_one_has() {
        let refused = |text: &str| CsvColumn::of(text, "x").expect_err("no column");
        assert_eq!(refused("a [m],b\n1,2\n").names, ["a", "b"]);
        assert_eq!((refused("x,x [m]\n").count, refused("").count, refused("").names.len()), (2, 0, 0));
        assert_eq!(refused(&"a,".repeat(1000)).names.len(), MOST_NAMES);
        // A quotation that never ends is one cell.
        assert_eq!(refused("\"x\n1\n2\n").names, ["x\n1\n2"]);
    }
}
