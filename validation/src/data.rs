//! The texts that a run reads, and their numbers as printed.

use std::fmt;

/// The texts of a run, in CSV; lines that begin with `#` are comments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texts<'a> {
    /// Table 1 as printed.
    pub table_1: &'a str,
    /// Table 2 as printed.
    pub table_2: &'a str,
    /// Table 3 as printed.
    pub table_3: &'a str,
    /// Table 4 as printed.
    pub table_4: &'a str,
    /// Table 5 as printed.
    pub table_5: &'a str,
    /// Table 6 as printed.
    pub table_6: &'a str,
    /// Table B1 as printed.
    pub table_b1: &'a str,
    /// Table B2 as printed.
    pub table_b2: &'a str,
    /// Masses, inertias and arms.
    pub geometry: &'a str,
    /// Cells known to be misprinted.
    pub misprints: &'a str,
    /// Bounds on the differences of cells, with reasons.
    pub bounds: &'a str,
    /// Measured small-overlap barrier tests.
    pub iihs: &'a str,
    /// Measured full-frontal barrier tests.
    pub nhtsa: &'a str,
    /// Worked examples and staged collisions.
    pub worked: &'a str,
}

impl Texts<'static> {
    /// Returns the texts embedded in the crate.
    pub fn embedded() -> Self {
        Texts {
            table_1: include_str!("../data/table1.csv"),
            table_2: include_str!("../data/table2.csv"),
            table_3: include_str!("../data/table3.csv"),
            table_4: include_str!("../data/table4.csv"),
            table_5: include_str!("../data/table5.csv"),
            table_6: include_str!("../data/table6.csv"),
            table_b1: include_str!("../data/tableB1.csv"),
            table_b2: include_str!("../data/tableB2.csv"),
            geometry: include_str!("../data/geometry.csv"),
            misprints: include_str!("../data/misprints.csv"),
            bounds: include_str!("../data/bounds.csv"),
            iihs: include_str!("../data/iihs.csv"),
            nhtsa: include_str!("../data/nhtsa.csv"),
            worked: include_str!("../data/worked.csv"),
        }
    }
}

/// Error that prevents computing anything from the texts.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DataError {
    /// A text is not CSV with a header and rows of equal length.
    Malformed {
        /// The text.
        file: &'static str,
        /// The reader's message.
        message: String,
    },
    /// A text has no rows.
    Empty {
        /// The text.
        file: &'static str,
    },
    /// A text has no such column.
    NoColumn {
        /// The text.
        file: &'static str,
        /// The column.
        column: &'static str,
    },
    /// A field is not a decimal number, or not within its range.
    NotANumber {
        /// The text.
        file: &'static str,
        /// The column.
        column: &'static str,
        /// The field.
        field: String,
    },
    /// A field is not one of the allowed words.
    UnknownWord {
        /// The text.
        file: &'static str,
        /// The column.
        column: &'static str,
        /// The field.
        field: String,
    },
    /// An entry is missing from a text, or occurs twice.
    NotOnce {
        /// The text.
        file: &'static str,
        /// The entry.
        entry: String,
    },
    /// The library refuses a collision.
    Refused {
        /// The collision.
        collision: String,
        /// Its reasons.
        reasons: String,
    },
}

impl fmt::Display for DataError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DataError::Malformed { file, message } => write!(f, "{file}: {message}"),
            DataError::Empty { file } => write!(f, "{file}: no rows"),
            DataError::NoColumn { file, column } => write!(f, "{file}: no column {column}"),
            DataError::NotANumber { file, column, field } => write!(f, "{file}: {column}: {field:?} is not a number that may stand there"),
            DataError::UnknownWord { file, column, field } => write!(f, "{file}: {column}: unknown {field:?}"),
            DataError::NotOnce { file, entry } => write!(f, "{file}: {entry} must stand there once"),
            DataError::Refused { collision, reasons } => write!(f, "{collision}: {reasons}"),
        }
    }
}

impl std::error::Error for DataError {}
