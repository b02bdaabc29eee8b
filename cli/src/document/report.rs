//! What is wrong with a case file, shown at its place in the text.

use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Element, Level, Origin, Padding, Renderer, Snippet, normalize_untrusted_str};

use super::source::Source;

/// The most problems rendered: a file with more is not a case file with mistakes.
const MOST_SHOWN: usize = 100;
/// The most problems collected, so that a hostile file cannot fill the memory with them.
pub(super) const MOST_KEPT: usize = 1000;
/// The width a source line is cut to, and how much of it is marked at most, in characters.
const WIDTH: usize = 100;
const MOST_MARKED: usize = 60;
/// Behind this many bytes of one line only the position is told: finding a column takes time.
const FARTHEST: usize = 1 << 16;

/// One thing wrong with a case file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The text it is about; none when the file as a whole is meant.
    pub span: Option<Range<usize>>,
    /// Its dotted key path, vehicles counted from 1, such as `vehicle.1.mass`; may be empty.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl Problem {
    /// A problem with the file as a whole.
    pub fn of_file(message: String) -> Problem {
        Problem { span: None, key: String::new(), message, help: None }
    }

    /// A problem with an option of the call.
    pub fn of_call(option: &str, message: String, help: Option<String>) -> Problem {
        Problem { span: None, key: option.trim_end().to_owned(), message, help }
    }
}

/// Everything wrong with a case file, in file order, or with a call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problems {
    source: Arc<Source>,
    list: Vec<Problem>,
}

impl Problems {
    /// Sorts `list` into file order; problems with the file as a whole come first.
    pub fn new(source: Arc<Source>, mut list: Vec<Problem>) -> Problems {
        list.sort_by_key(|problem| problem.span.as_ref().map(|span| (span.start, span.end)));
        Problems { source, list }
    }

    /// Problems with the call, which no file has.
    pub fn of_call(list: Vec<Problem>) -> Problems {
        Problems { source: Source { name: String::new(), text: String::new() }.into(), list }
    }

    #[cfg(test)]
    pub(super) fn list(&self) -> &[Problem] {
        &self.list
    }

    /// All problems as text for a terminal, a blank line between two, no newline at the end.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled().hyperlink(false) } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(WIDTH);
        let lines = Lines::new(&self.source.text);
        let mut shown: Vec<String> = self.list.iter().take(MOST_SHOWN).map(|problem| self.render_one(problem, &lines, &renderer)).collect();
        if self.list.len() > MOST_SHOWN {
            shown.push("error: there are more problems in this file".to_owned());
        }
        shown.join("\n\n")
    }

    fn render_one(&self, problem: &Problem, lines: &Lines<'_>, renderer: &Renderer) -> String {
        let separator = if problem.key.is_empty() { "" } else { ": " };
        let title = format!("{}{separator}{}", cut(&problem.key, 120), problem.message);
        let mut elements: Vec<Element<'_>> = Vec::new();
        let name = normalize_untrusted_str(&self.source.name);
        if let Some(span) = &problem.span {
            elements.push(lines.place(span).element(name));
        } else if !self.source.text.is_empty() {
            elements.push(Origin::path(name).into());
        }
        if let Some(help) = &problem.help {
            if problem.span.is_none() {
                elements.push(Padding.into());
            }
            // Unlike a title, a message is not cleaned of control characters.
            elements.push(Level::HELP.message(normalize_untrusted_str(help)).into());
        }
        renderer.render(&[Level::ERROR.primary_title(title).elements(elements)])
    }
}

/// At most `most` characters of `text`.
fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// Where the lines of a text begin.
struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

/// A line up to a little behind the marked range in it.
struct Place<'a> {
    number: usize,
    line: &'a str,
    marked: Range<usize>,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Lines<'a> {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Lines { text, starts }
    }

    /// The place of `span`, of which only the first line is shown.
    fn place(&self, span: &Range<usize>) -> Place<'a> {
        let start = self.boundary(span.start);
        // The first line begins at 0, so at least one begins at or before any offset.
        let index = self.starts.partition_point(|begin| *begin <= start).max(1) - 1;
        let begin = self.starts[index];
        let line = self.text[begin..].split('\n').next().unwrap_or("");
        let line = line.strip_suffix('\r').unwrap_or(line);
        let from = (start - begin).min(line.len());
        let to = self.boundary(span.end).saturating_sub(begin).clamp(from, line.len());
        let to = to.min(ahead(line, from, MOST_MARKED));
        Place { number: index + 1, line: &line[..ahead(line, to, WIDTH)], marked: from..to }
    }

    /// The nearest boundary of characters at or before `offset`.
    fn boundary(&self, offset: usize) -> usize {
        let offset = offset.min(self.text.len());
        (0..=offset).rev().find(|at| self.text.is_char_boundary(*at)).unwrap_or(0)
    }
}

/// The end of `count` characters of `line` behind the byte `from`.
fn ahead(line: &str, from: usize, count: usize) -> usize {
    line[from..].char_indices().nth(count).map_or(line.len(), |(at, _)| from + at)
}

impl<'a> Place<'a> {
    fn element(self, name: String) -> Element<'a> {
        if self.marked.start > FARTHEST {
            let column = self.line[..self.marked.start].chars().count() + 1;
            return Origin::path(name).line(self.number).char_column(column).into();
        }
        Snippet::source(self.line).path(name).line_start(self.number).annotation(AnnotationKind::Primary.span(self.marked)).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn render(text: &str, spans: impl IntoIterator<Item = Range<usize>>) -> String {
        let source = Source { name: "case.toml".to_owned(), text: text.to_owned() };
        let problem = |span: Range<usize>| Problem {
            span: Some(span),
            key: "a.b".to_owned(),
            message: "is wrong".to_owned(),
            help: Some("try this".to_owned()),
        };
        Problems::new(source.into(), spans.into_iter().map(problem).collect()).render(false)
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
        assert!(shown.ends_with("\n\nerror: there are more problems in this file"), "{shown}");
    }

    #[test]
    fn escape_sequences_do_not_reach_the_terminal() {
        let source = Source { name: "a\u{1b}[31m".to_owned(), text: "x = \u{1b}[2J".to_owned() };
        let problem =
            Problem { span: Some(0..1), key: "\u{1b}k".to_owned(), message: "\u{1b}m".to_owned(), help: Some("\u{1b}h".to_owned()) };
        let shown = Problems::new(source.into(), vec![problem]).render(false);
        assert!(!shown.contains('\u{1b}'), "{shown:?}");
    }
}
