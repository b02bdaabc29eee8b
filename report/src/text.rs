//! Renders blocks as text for a terminal of 80 columns.

use comfy_table::{Cell, CellAlignment, LineStyle, Table as Grid, TableStyle};
use planar_impact_app::notice::Severity;
use planar_impact_app::plain_text::clean;
use unicode_width::UnicodeWidthStr;

use crate::block::{Align, Block, Table};

/// Width of a terminal, in columns.
pub const WIDTH: usize = 80;

/// Renders a page as text, with lines of at most 80 columns if words allow it.
pub fn render(blocks: &[Block]) -> String {
    let mut text = String::new();
    let mut before: Option<&Block> = None;
    for block in blocks {
        if before.is_some_and(|before| is_apart(before, block)) {
            text.push('\n');
        }
        text.push_str(&one(block));
        before = Some(block);
    }
    text
}

/// Returns `true` if an empty line separates two blocks. There is none between list items, between notices, or
/// between a table or paragraph and the items below it.
fn is_apart(before: &Block, block: &Block) -> bool {
    let are_notices = matches!((before, block), (Block::Notice { .. }, Block::Notice { .. }));
    let is_below = matches!((before, block), (Block::Item { .. } | Block::Table(_) | Block::Paragraph(_), Block::Item { .. }));
    !are_notices && !is_below
}

fn one(block: &Block) -> String {
    match block {
        Block::Heading { level: 3, text } if text.width() <= WIDTH => format!("{}\n{}\n", clean(text), "=".repeat(text.width())),
        Block::Heading { text, .. } | Block::Paragraph(text) => wrap(text, ""),
        Block::Item { label, text } => wrap(text, label),
        Block::Table(of) => table(of) + "\n",
        Block::Notice { severity, text } => {
            let label = match severity {
                Severity::Note => "Note: ",
                Severity::Warning => "Warning: ",
            };
            wrap(&format!("{text}."), label)
        }
        Block::Verbatim(text) | Block::Formula { text, .. } => text.lines().map(|line| clean(line).trim_end().to_owned() + "\n").collect(),
        Block::Figure { title, .. } => wrap(&format!("[figure: {title}]"), ""),
    }
}

/// Wraps text to lines of at most 80 columns, each with a newline; the first line follows the label, the others are indented by four.
pub fn wrap(text: &str, label: &str) -> String {
    let label = clean(label);
    let options = textwrap::Options::new(WIDTH).initial_indent(&label).subsequent_indent("    ");
    // Non-breaking spaces have served their purpose after wrapping.
    textwrap::fill(&clean(text), options).replace('\u{a0}', " ") + "\n"
}

/// Renders a table without frames, with the header underlined. If it would be wider than the terminal even so, as many of its columns as fit stand beside the
/// names in its first ones, and the others below, beside the same names.
fn table(of: &Table) -> String {
    let text = whole(of);
    let names = of.columns.iter().take_while(|align| **align == Align::Left).count();
    let others = of.columns.len() - names;
    if width(&text) <= WIDTH || others < 2 {
        return text;
    }
    let part = |from: usize, to: usize| of.with_columns(|column| column < names || (from..to).contains(&(column - names)));
    let count = (2..others).rev().find(|count| width(&whole(&part(0, *count))) <= WIDTH).unwrap_or(1);
    format!("{}\n\n{}", table(&part(0, count)), table(&part(count, others)))
}

/// Renders a table in one piece. If it would be wider than the terminal, it leaves out its optional column, or names in its columns break after a dot.
fn whole(of: &Table) -> String {
    let padding = if of.is_narrow { (0, 1) } else { (1, 1) };
    let mut rows = of.rows.clone();
    let mut text = lay_out(of, &rows, padding);
    if of.optional.is_some() && width(&text) > WIDTH {
        return whole(&of.without_optional());
    }
    for place in (0..of.columns.len()).filter(|&place| of.columns[place] == Align::Left) {
        let over = width(&text).saturating_sub(WIDTH);
        if over == 0 {
            break;
        }
        let longest = rows.iter().map(|row| row[place].width()).max().unwrap_or(0);
        let most = longest.saturating_sub(over).max(16);
        rows.iter_mut().for_each(|row| row[place] = broken(&row[place], most));
        text = lay_out(of, &rows, padding);
    }
    text
}

/// Returns the width of the widest line, in columns.
fn width(text: &str) -> usize {
    text.lines().map(UnicodeWidthStr::width).max().unwrap_or(0)
}

fn lay_out(of: &Table, rows: &[Vec<String>], padding: (u16, u16)) -> String {
    let alignment = |align: &Align| match align {
        Align::Left => CellAlignment::Left,
        Align::Right => CellAlignment::Right,
    };
    let cells = |row: &[String]| -> Vec<Cell> {
        row.iter().zip(&of.columns).map(|(text, align)| Cell::new(lines(text)).set_alignment(alignment(align))).collect()
    };
    let mut grid = Grid::new();
    grid.load_style(TableStyle::new().header_separator(LineStyle::none().fill('-').junction('-')));
    grid.set_header(cells(&of.header));
    for row in rows {
        grid.add_row(cells(row));
    }
    for column in grid.column_iter_mut() {
        column.set_padding(padding);
    }
    grid.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

/// Cleans the lines of a cell.
fn lines(text: &str) -> String {
    text.split('\n').map(clean).collect::<Vec<_>>().join("\n")
}

/// Breaks a name into two lines if it is too long.
fn broken(name: &str, most: usize) -> String {
    if name.width() <= most {
        return name.to_owned();
    }
    let mut points = name.char_indices().filter(|(_, c)| matches!(c, '.' | '_' | ' ')).map(|(at, _)| at + 1);
    match points.rfind(|at| *at <= most) {
        Some(at) => format!("{}\n  {}", &name[..at], &name[at..]),
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_break_after_a_point() {
        assert_eq!(broken("vehicle.1.speed", 20), "vehicle.1.speed");
        assert_eq!(broken("vehicle.1.separation_velocity.x", 26), "vehicle.1.separation_\n  velocity.x");
        let row = vec!["vehicle.1.separation_velocity.x".to_owned(), "x".repeat(52)];
        let text = render(&[Table::new(["a", "b"], "ll", vec![row]).narrow().into()]);
        assert!(text.lines().all(|line| line.width() <= WIDTH), "{text}");
    }

    #[test]
    fn a_table_that_is_too_wide_is_divided() {
        let cells = |name: &str, count: usize| {
            std::iter::once(name.to_owned()).chain((0..count).map(|i| format!("{i}{}", "x".repeat(14)))).collect()
        };
        let of = |count: usize| Table::new(cells("name", count), &format!("l{}", "r".repeat(count)), vec![cells("row", count)]).narrow();
        assert_eq!(render(&[of(4).into()]).lines().count(), 3);
        let divided = render(&[of(9).into()]);
        assert!(divided.lines().all(|line| line.width() <= WIDTH), "{divided}");
        // Every column stands once in a header and once in a row, in their order.
        let rows: Vec<&str> = divided.lines().filter(|line| line.starts_with("row")).collect();
        let places = (0..9).map(|i| rows.iter().position(|row| row.contains(&format!("{i}x")))).collect::<Option<Vec<_>>>();
        assert_eq!(places, Some(vec![0, 0, 0, 0, 1, 1, 1, 1, 2]), "{divided}");
        assert_eq!(divided.matches("name").count(), 3);
        // One column that is too wide stays as it is.
        let wide = Table::new(["name", "value"], "lr", vec![vec!["row".to_owned(), "y".repeat(90)]]);
        assert_eq!(render(&[wide.into()]).matches("name").count(), 1);
    }

    #[test]
    fn a_column_is_left_out_only_where_the_table_is_too_wide() {
        let of = |name: String| Table::new(["a", "b", "c"], "lll", vec![vec![name, "b1".to_owned(), "c1".to_owned()]]).with_optional(1);
        let shown = |name: String| render(&[of(name).into()]);
        assert!(shown("x".repeat(60)).contains("b1"));
        let wide = shown("x".repeat(74));
        assert!(!wide.contains("b1") && wide.contains("c1"), "{wide}");
    }

    #[test]
    fn lists_and_notes_stand_together() {
        let note = |text: &str| Block::Notice { severity: Severity::Note, text: text.to_owned() };
        let blocks = [Block::paragraph("One."), Block::item("- ", "two"), Block::item("- ", "three"), note("four"), note("five")];
        assert_eq!(render(&blocks), "One.\n- two\n- three\n\nNote: four.\nNote: five.\n");
    }

    #[test]
    fn nothing_that_a_terminal_acts_on_is_printed() {
        let bad = "a\u{1b}[31m\u{85}\u{9b}\u{202e}\u{2028}\u{61c}b";
        let table = Table::new([bad], "l", vec![vec![bad.to_owned()]]);
        let text = render(&[Block::paragraph(bad), Block::item(bad, bad), table.into(), Block::Verbatim(bad.to_owned())]);
        assert!(text.chars().all(|c| c == '\n' || !c.is_control() && !"\u{202e}\u{2028}\u{61c}".contains(c)), "{text:?}");
    }
}
