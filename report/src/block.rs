//! The blocks of a page. A page is made from an answer once; each interface renders its blocks in its own way.

use planar_impact_app::notice::{Notice, Notices, Severity};
use planar_impact_app::units::Units;

/// A part of a page. Its texts are unescaped: a renderer removes characters that a terminal or a document would interpret.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading; level 1 is the title of the page.
    Heading {
        /// 1 for the title, 2 for a section.
        level: u8,
        /// The text.
        text: String,
    },
    /// A paragraph.
    Paragraph(String),
    /// A list item or a footnote: a label and a text.
    Item {
        /// Its label including the separator, such as `- ` or `[1] `.
        label: String,
        /// The text.
        text: String,
    },
    /// A table.
    Table(Table),
    /// A note or a warning.
    Notice {
        /// Its severity.
        severity: Severity,
        /// The sentence.
        text: String,
    },
    /// Text whose line breaks are kept.
    Verbatim(String),
    /// A formula.
    Formula {
        /// As LaTeX mathematics.
        latex: String,
        /// As text.
        text: String,
    },
    /// A drawing.
    Figure {
        /// Its subject.
        title: String,
        /// The drawing as SVG.
        svg: String,
    },
}

/// Alignment of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// A table with a header.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The headers of the columns.
    pub header: Vec<String>,
    /// The alignment of each column.
    pub columns: Vec<Align>,
    /// The rows, a cell for each column.
    pub rows: Vec<Vec<String>>,
    /// `true` to set columns close together, for a table of many columns.
    pub is_narrow: bool,
    /// A column that may be omitted if the table is too wide.
    pub optional: Option<usize>,
}

impl Table {
    /// Creates a table. Columns are `l` for words and `r` for numbers.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>, columns: &str, rows: Vec<Vec<String>>) -> Table {
        let align = |letter| if letter == 'l' { Align::Left } else { Align::Right };
        let header = header.into_iter().map(Into::into).collect();
        Table { header, columns: columns.chars().map(align).collect(), rows, is_narrow: false, optional: None }
    }

    /// Sets the columns close together.
    pub fn narrow(self) -> Table {
        Table { is_narrow: true, ..self }
    }

    /// Sets the column that may be omitted if the table is too wide.
    pub fn with_optional(self, column: usize) -> Table {
        Table { optional: Some(column), ..self }
    }

    /// Returns the table without its optional column.
    pub(crate) fn without_optional(&self) -> Table {
        self.with_columns(|column| self.optional != Some(column))
    }

    /// Returns the table with some of its columns, none of which is optional.
    pub(crate) fn with_columns(&self, is_kept: impl Fn(usize) -> bool) -> Table {
        fn kept<T: Clone>(cells: &[T], is_kept: impl Fn(usize) -> bool) -> Vec<T> {
            cells.iter().enumerate().filter(|(column, _)| is_kept(*column)).map(|(_, cell)| cell.clone()).collect()
        }
        Table {
            header: kept(&self.header, &is_kept),
            columns: kept(&self.columns, &is_kept),
            rows: self.rows.iter().map(|row| kept(row, &is_kept)).collect(),
            is_narrow: self.is_narrow,
            optional: None,
        }
    }
}

impl From<Table> for Block {
    fn from(table: Table) -> Block {
        Block::Table(table)
    }
}

impl Block {
    /// Creates the title of a page; `None` if it is empty.
    pub fn title(text: &str) -> Option<Block> {
        (!text.is_empty()).then(|| Block::Heading { level: 1, text: text.to_owned() })
    }

    /// Creates a paragraph.
    pub fn paragraph(text: impl Into<String>) -> Block {
        Block::Paragraph(text.into())
    }

    /// Creates a list item.
    pub fn item(label: impl Into<String>, text: impl Into<String>) -> Block {
        Block::Item { label: label.into(), text: text.into() }
    }

    /// Creates the notices of an answer in a system of units.
    pub fn notices(notices: &Notices, units: Units) -> impl Iterator<Item = Block> + '_ {
        let block = move |notice: &Notice| Block::Notice { severity: notice.severity, text: units.sentence(&notice.message) };
        notices.0.iter().map(block)
    }
}
