//! Renders issues at their place in the text, for a terminal.

use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Element, Level, Origin, Padding, Renderer, Snippet};
use planar_impact_app::plain_text::{clean, shorten};
use planar_impact_app::{Issue, Issues, Units};

/// Maximum number of issues rendered; one more message says that there are others.
const MOST_SHOWN: usize = 100;
/// Width to which a source line is cut, and maximum length of its marked part, in characters.
const WIDTH: usize = 80;
const MOST_MARKED: usize = 60;
/// Maximum width of a path, and of a message and its help, in columns.
const LONGEST_PATH: usize = 120;
const LONGEST_TEXT: usize = 2000;
/// Beyond this many bytes of a line only the position is shown, because finding a column takes time.
const FARTHEST: usize = 1 << 16;

/// Renders all issues as text, separated by blank lines, without a newline at the end.
pub fn render(issues: &Issues, units: Units, color: bool) -> String {
    let renderer = if color { Renderer::styled().hyperlink(false) } else { Renderer::plain() };
    let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(WIDTH);
    let mut shown: Vec<String> = Vec::new();
    let first = &issues.list()[..issues.list().len().min(MOST_SHOWN)];
    for of_file in first.chunk_by(|one, other| std::ptr::eq(issues.source_of(one), issues.source_of(other))) {
        let source = issues.source_of(&of_file[0]);
        let (lines, name) = (Lines::new(&source.text), shorten(&source.name, LONGEST_PATH));
        shown.extend(of_file.iter().map(|issue| render_one(issue, &name, &lines, units, &renderer)));
    }
    if issues.list().len() > MOST_SHOWN {
        shown.push("error: there are more issues".to_owned());
    }
    shown.join("\n\n")
}

fn render_one(issue: &Issue, name: &str, lines: &Lines<'_>, units: Units, renderer: &Renderer) -> String {
    let separator = if issue.path.is_empty() { "" } else { ": " };
    let message = shorten(&units.sentence(&issue.message), LONGEST_TEXT);
    let title = format!("{}{separator}{message}", shorten(&issue.path, LONGEST_PATH));
    let place = issue.span.as_ref().map(|span| lines.place(span));
    let mut elements: Vec<Element<'_>> = Vec::new();
    match &place {
        Some(place) => elements.push(place.element(name)),
        None if !lines.text.is_empty() => elements.push(Origin::path(name).into()),
        None => (),
    }
    if let Some(help) = &issue.help {
        if place.is_none() {
            elements.push(Padding.into());
        }
        elements.push(Level::HELP.message(shorten(&units.sentence(help), LONGEST_TEXT)).into());
    }
    renderer.render(&[Level::ERROR.primary_title(title).elements(elements)])
}

/// Offsets at which the lines of a text begin.
struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

/// A cleaned line, cut shortly after its marked range.
struct Place {
    number: usize,
    line: String,
    marked: Range<usize>,
    column: usize,
    is_far: bool,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Lines<'a> {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Lines { text, starts }
    }

    /// Returns the place of `span`; only its first line is shown.
    fn place(&self, span: &Range<usize>) -> Place {
        let start = self.boundary(span.start);
        // The first line begins at 0, so at least one line begins at or before any offset.
        let index = self.starts.partition_point(|begin| *begin <= start).max(1) - 1;
        let begin = self.starts[index];
        let line = self.text[begin..].split('\n').next().unwrap_or("");
        let line = line.strip_suffix('\r').unwrap_or(line);
        let from = (start - begin).min(line.len());
        let to = self.boundary(span.end).saturating_sub(begin).clamp(from, line.len());
        let to = to.min(ahead(line, from, MOST_MARKED));
        let end = ahead(line, to, WIDTH);
        // Cleaning may shorten a character.
        let parts = [&line[..from], &line[from..to], &line[to..end]].map(clean);
        let marked = parts[0].len()..parts[0].len() + parts[1].len();
        Place { number: index + 1, column: parts[0].chars().count() + 1, line: parts.concat(), marked, is_far: from > FARTHEST }
    }

    /// Returns the nearest character boundary at or before `offset`.
    fn boundary(&self, offset: usize) -> usize {
        let offset = offset.min(self.text.len());
        (0..=offset).rev().find(|at| self.text.is_char_boundary(*at)).unwrap_or(0)
    }
}

/// Returns the offset `count` characters after the byte `from` of `line`.
fn ahead(line: &str, from: usize, count: usize) -> usize {
    line[from..].char_indices().nth(count).map_or(line.len(), |(at, _)| from + at)
}

impl Place {
    fn element<'a>(&'a self, name: &'a str) -> Element<'a> {
        if self.is_far {
            return Origin::path(name).line(self.number).char_column(self.column).into();
        }
        let annotation = AnnotationKind::Primary.span(self.marked.clone());
        Snippet::source(self.line.as_str()).path(name).line_start(self.number).annotation(annotation).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact_app::{Cause, Source};

    fn render(text: &str, spans: impl IntoIterator<Item = Range<usize>>) -> String {
        let source = Source::new("case.toml", text);
        let issue = |span: Range<usize>| Issue { span: Some(span), ..Issue::at("invalid", "a.b", "is wrong").with_help("try this") };
        super::render(&Issues::new(Cause::Input, source.into(), spans.into_iter().map(issue).collect()), Units::Si, false)
    }

    #[test]
    fn in_file_order_with_columns_in_characters() {
        assert_eq!(
            render("a = 1\r\né = \"x\"\r\n", [12..15, 4..5]),
            "\
error: a.b: is wrong
 --> case.toml:1:5
  |
1 | a = 1
  |     ^
  |
  = help: try this

error: a.b: is wrong
 --> case.toml:2:5
  |
2 | é = \"x\"
  |     ^^^
  |
  = help: try this"
        );
    }

    #[test]
    fn only_the_first_line_of_a_span_is_shown() {
        let shown = render("a = [\n 1,\n 2]\n", Some(4..13));
        assert!(shown.contains("1 | a = [\n  |     ^\n"), "{shown}");
    }

    #[test]
    fn long_lines_are_cut() {
        let text = format!("a = \"{}\"", "é".repeat(1 << 20));
        let shown = render(&text, Some(4..text.len()));
        assert!(shown.len() < 600, "{shown}");
        assert!(shown.contains(":1:5\n"), "{shown}");
        let marked = 1001; // within the 499th é
        let near = render(&text, Some(marked..marked + 2));
        assert!(near.len() < 600 && near.contains("case.toml:1:504\n"), "{near}");
        assert!(near.contains("1 | ...é"), "{near}");
        let far = render(&text, Some(text.len() - 1..text.len()));
        assert!(far.len() < 400 && far.contains("case.toml:1:1048582\n"), "{far}");
    }

    #[test]
    fn no_span_can_panic() {
        let text = "a\r\né\n\n";
        for start in 0..9 {
            for end in 0..9 {
                assert!(render(text, Some(start..end)).contains("case.toml:"));
            }
        }
    }

    #[test]
    fn no_more_than_a_hundred_are_shown() {
        let shown = render("a = 1", vec![4..5; 1000]);
        assert_eq!(shown.matches("is wrong").count(), 100);
        assert!(shown.ends_with("\n\nerror: there are more issues"), "{shown}");
    }

    #[test]
    fn nothing_that_a_terminal_acts_on_is_printed() {
        let bad = "\u{1b}[31m\u{9b}\u{85}\u{2028}\u{61c}\u{202e}";
        let source = Source::new(format!("a{bad}"), format!("x{bad} = {bad}"));
        let issue = Issue { span: Some(0..3), ..Issue::at("invalid", format!("k{bad}"), format!("m{bad}")).with_help(format!("h{bad}")) };
        let shown = super::render(&Issues::new(Cause::Input, source.into(), vec![issue]), Units::Si, false);
        assert!(shown.chars().all(|c| c == '\n' || !planar_impact_app::plain_text::is_active(c)), "{shown:?}");
    }

    #[test]
    fn long_names_are_cut() {
        let long = "n".repeat(100_000);
        let issues = Issues::of_call(vec![Issue::at("invalid", long.clone(), long.clone()).with_help(long)]);
        assert!(super::render(&issues, Units::Si, false).len() < 10_000);
    }

    #[test]
    fn figures_are_in_the_units_asked_for_and_colors_only_on_request() {
        let message = planar_impact_app::Message::from("it is ").figure(planar_impact_app::Measure::Length, 0.3048);
        let issues = Issues::of_call(vec![Issue::at("invalid", "a", message)]);
        assert_eq!(super::render(&issues, Units::Us, false), "error: a: it is 1.00 ft");
        assert!(super::render(&issues, Units::Us, true).contains('\u{1b}'));
    }
}
