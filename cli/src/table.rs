//! Text laid out for a terminal of 80 columns.

use comfy_table::{Cell, CellAlignment, LineStyle, Table, TableStyle};

/// Which side of its column a cell stands at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// A table without frames, its header underlined, no line longer than its cells need.
pub fn render(header: &[&str], columns: &[Align], rows: &[Vec<String>]) -> String {
    lay_out(header, columns, rows, (1, 1))
}

/// The same with two spaces between columns and none before the first.
pub fn narrow(header: &[&str], columns: &[Align], rows: &[Vec<String>]) -> String {
    lay_out(header, columns, rows, (0, 1))
}

fn lay_out(header: &[&str], columns: &[Align], rows: &[Vec<String>], padding: (u16, u16)) -> String {
    let alignment = |align: &Align| match align {
        Align::Left => CellAlignment::Left,
        Align::Right => CellAlignment::Right,
    };
    let cells = |row: &mut dyn Iterator<Item = String>| -> Vec<Cell> {
        row.zip(columns).map(|(text, align)| Cell::new(text).set_alignment(alignment(align))).collect()
    };
    let mut table = Table::new();
    table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('-').junction('-')));
    table.set_header(cells(&mut header.iter().map(|text| (*text).to_owned())));
    for row in rows {
        table.add_row(cells(&mut row.iter().cloned()));
    }
    for column in table.column_iter_mut() {
        column.set_padding(padding);
    }
    table.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

/// Lines of at most 80 columns with a newline behind each, the first behind its label and the others indented by four.
pub fn wrap(text: &str, label: &str) -> String {
    let options = textwrap::Options::new(80).initial_indent(label).subsequent_indent("    ");
    textwrap::fill(text, options) + "\n"
}
