//! Files of records in any format: validated first, then read.

use std::io::{self, BufRead, Cursor, Read};

use super::complaint::{Complaints, Numbered};
use super::csv::Table;
use super::document::{self, Layout, Records, Unusable};
use super::jsonl::JsonLines;
use super::lines::{LONGEST, Lines};
use crate::decode::not_a_text;
use crate::document::{Value, json};
use crate::source::Source;

/// Maximum size of a JSON document read from a pipe, which cannot be read twice.
const LARGEST_PIPED: u64 = 64 << 20;

/// A reader of records.
pub type Reader = Box<dyn BufRead>;

/// Opens a file from its beginning.
pub type Open = Box<dyn Fn() -> io::Result<Reader>>;

/// An issue with a file as a whole, or with one of its lines.
pub type FileIssue = (Option<u64>, Complaints);

/// The source of the records of a file.
pub enum Origin {
    /// A file that can be opened again, so that it is validated before it is read.
    File(Open),
    /// A pipe, which is read once.
    Pipe(Reader),
}

/// A usable file of records, as far as its beginning shows. A JSON document has been validated completely.
pub struct Input {
    content: Content,
}

enum Content {
    Lines(JsonLines<Reader>),
    Table(Box<Table<Reader>>),
    Document(Records<Reader>),
    /// A file that is opened again to be read, and its format.
    Later(Open, Form),
}

/// The format of a validated file.
enum Form {
    Lines,
    Table,
    Document(Layout),
}

impl Input {
    /// Validates the beginning of a file, or all of it if it is a JSON document. A lower-case extension, such as `csv`, selects its format.
    ///
    /// # Errors
    ///
    /// Returns every issue that makes the file unusable.
    pub fn open(origin: Origin, extension: Option<&str>) -> Result<Input, Vec<FileIssue>> {
        let content = match origin {
            Origin::File(open) => {
                let (kind, reader) = sniff(open().map_err(unread)?, extension)?;
                let form = match kind {
                    Kind::Document => Form::Document(document::validate(reader).map_err(of_document)?),
                    Kind::Lines => open_lines(reader).map(|_| Form::Lines)?,
                    Kind::Table => open_table(reader).map(|_| Form::Table)?,
                };
                Content::Later(open, form)
            }
            Origin::Pipe(reader) => {
                let (kind, reader) = sniff(reader, extension)?;
                match kind {
                    Kind::Lines => Content::Lines(open_lines(reader)?),
                    Kind::Table => Content::Table(Box::new(open_table(reader)?)),
                    Kind::Document => {
                        let bytes = all_of(reader)?;
                        let layout = document::validate(bytes.as_slice()).map_err(of_document)?;
                        let reader: Reader = Box::new(Cursor::new(bytes));
                        Content::Document(Records::open(reader, layout).map_err(unread)?)
                    }
                }
            }
        };
        Ok(Input { content })
    }

    /// Returns the next record and its line number.
    ///
    /// # Errors
    ///
    /// Fails if the file cannot be read further, or has changed since it was validated.
    pub fn next(&mut self) -> Result<Option<Numbered>, Vec<FileIssue>> {
        loop {
            let next = match &mut self.content {
                Content::Lines(lines) => lines.next(),
                Content::Table(table) => table.next(),
                Content::Document(records) => records.next(),
                Content::Later(open, form) => {
                    self.content = again(open, form)?;
                    continue;
                }
            };
            return next.map_err(|error| vec![of_file(&format!("it cannot be read on: {}", reason(&error)))]);
        }
    }
}

/// Opens a validated file again to read it.
fn again(open: &Open, form: &mut Form) -> Result<Content, Vec<FileIssue>> {
    let changed = |mut issues: Vec<FileIssue>| {
        issues.insert(0, of_file("it has changed while it was read"));
        issues
    };
    let (_, reader) = sniff(open().map_err(unread)?, None).map_err(changed)?;
    Ok(match std::mem::replace(form, Form::Lines) {
        Form::Lines => Content::Lines(open_lines(reader).map_err(changed)?),
        Form::Table => Content::Table(Box::new(open_table(reader).map_err(changed)?)),
        Form::Document(layout) => Content::Document(Records::open(reader, layout).map_err(unread)?),
    })
}

fn all_of(reader: Reader) -> Result<Vec<u8>, Vec<FileIssue>> {
    let mut bytes = Vec::new();
    reader.take(LARGEST_PIPED + 1).read_to_end(&mut bytes).map_err(unread)?;
    if bytes.len() as u64 > LARGEST_PIPED {
        let message = format!("a JSON document from a pipe may have {} MiB; give a file, or JSON Lines", LARGEST_PIPED >> 20);
        return Err(vec![of_file(&message)]);
    }
    Ok(bytes)
}

/// Returns an issue with a file as a whole.
pub fn of_file(message: &str) -> FileIssue {
    let mut complaints = Complaints::default();
    complaints.push("", message);
    (None, complaints)
}

fn of_document(unusable: Unusable) -> Vec<FileIssue> {
    vec![match unusable {
        Unusable::Wrong(line, complaints) => (line, complaints),
        Unusable::Reader(error) => of_file(&format!("it cannot be read: {}", reason(&error))),
    }]
}

fn open_lines(reader: Reader) -> Result<JsonLines<Reader>, Vec<FileIssue>> {
    let mut lines = JsonLines::open(Lines::new(reader)).map_err(unread)?.map_err(|(line, complaints)| vec![(Some(line), complaints)])?;
    if lines.has_more().map_err(unread)? { Ok(lines) } else { Err(vec![of_file("it has no records behind its header")]) }
}

fn open_table(reader: Reader) -> Result<Table<Reader>, Vec<FileIssue>> {
    let opened = Table::open(Lines::new(reader)).map_err(unread)?;
    let of_lines =
        |issues: Vec<(u64, Complaints)>| issues.into_iter().map(|(line, complaints)| (Some(line), complaints)).collect::<Vec<_>>();
    let mut table = opened.map_err(of_lines)?;
    if table.has_more().map_err(unread)? { Ok(table) } else { Err(vec![of_file("it has no records behind its units")]) }
}

fn unread(error: io::Error) -> Vec<FileIssue> {
    vec![of_file(&format!("it cannot be read: {}", reason(&error)))]
}

/// Describes common I/O errors without the operating system's error numbers.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Document,
    Lines,
    Table,
}

/// Detects the format from the extension if it is known, otherwise from the first line. Returns the whole input except a byte order mark.
fn sniff(mut source: Reader, extension: Option<&str>) -> Result<(Kind, Reader), Vec<FileIssue>> {
    match extension {
        Some("toml") => return Err(vec![of_file("it is a case, and has no records of results; `solve` computes its answer")]),
        Some("parquet" | "arrow") => return Err(vec![of_file("it is no text; write the records as CSV, JSON or JSON Lines")]),
        _ => (),
    }
    let mut head = Vec::new();
    let mut is_first = true;
    // Leading blank lines are allowed, and are counted.
    while head.iter().all(u8::is_ascii_whitespace) && head.len() <= LONGEST {
        let read = (&mut source).take((LONGEST + 1 - head.len()) as u64).read_until(b'\n', &mut head).map_err(unread)?;
        if read == 0 {
            return Err(vec![of_file("it is empty")]);
        }
        if std::mem::take(&mut is_first) {
            if let Some(is) = not_a_text(&head) {
                return Err(vec![of_file(&format!("it {is}"))]);
            }
            head.drain(..if head.starts_with(Source::MARK.as_bytes()) { Source::MARK.len() } else { 0 });
        }
    }
    let first = head.iter().copied().find(|byte| !byte.is_ascii_whitespace());
    let kind = match (extension, first) {
        (Some("csv"), _) => Kind::Table,
        (Some("jsonl" | "ndjson"), _) => Kind::Lines,
        (_, Some(b'{')) => {
            if is_header(&head) {
                Kind::Lines
            } else {
                Kind::Document
            }
        }
        (_, Some(b'[')) => Kind::Document,
        (Some("json"), _) => Kind::Document,
        _ => Kind::Table,
    };
    Ok((kind, Box::new(Cursor::new(head).chain(source))))
}

/// Returns `true` if a line is a complete object without records, perhaps with a fault: the header of JSON Lines.
fn is_header(line: &[u8]) -> bool {
    match str::from_utf8(line).map(json::parse) {
        Ok(Ok(node)) => matches!(&node.value, Value::Table(entries) if !entries.iter().any(|entry| entry.key == "records")),
        _ => closes(line) && !line.windows(9).any(|key| key == b"\"records\""),
    }
}

/// Returns `true` if a line closes as many braces as it opens, outside of its strings.
fn closes(line: &[u8]) -> bool {
    let (mut open, mut is_quoted, mut is_escaped) = (0_i64, false, false);
    for byte in line {
        match byte {
            b'"' if !is_escaped => is_quoted = !is_quoted,
            b'{' if !is_quoted => open += 1,
            b'}' if !is_quoted => open -= 1,
            _ => (),
        }
        is_escaped = is_quoted && *byte == b'\\' && !is_escaped;
    }
    open == 0 && !is_quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_tells_the_format_before_the_content_does() {
        let kind = |text: &'static str, extension: Option<&str>| {
            let (kind, mut rest) = sniff(Box::new(Cursor::new(text)), extension).unwrap_or_else(|_| panic!("{text}"));
            let mut read = String::new();
            rest.read_to_string(&mut read).expect("a text");
            assert_eq!(read, text.trim_start_matches('\u{feff}'));
            kind
        };
        let header = "{\"schema\": \"planar-impact-record/1\"}\n{}\n";
        for (text, extension, expected) in [
            ("{id},[e]\n", Some("csv"), Kind::Table),
            ("[e],id\n", Some("csv"), Kind::Table),
            ("{\"records\": []}", Some("jsonl"), Kind::Lines),
            ("[]", Some("ndjson"), Kind::Lines),
            (header, None, Kind::Lines),
            (header, Some("json"), Kind::Lines),
            ("{\"units\": {\"length\": \"m\" \"mass\": \"}\\\"\"}}\n{}\n", None, Kind::Lines),
            ("{\"units\": {\"length\": \"m\"}\n, \"records\": []}\n", None, Kind::Document),
            ("{\"units\": {\"length\": \"}\n", None, Kind::Document),
            ("{\"units\": {\"length\" 1}, \"records\": []}\n", None, Kind::Document),
            ("\u{feff}\n {\"records\": []}\n", None, Kind::Document),
            ("[\n]", Some("txt"), Kind::Document),
            ("id,e\n", Some("json"), Kind::Document),
            ("id,e\n", None, Kind::Table),
        ] {
            assert_eq!(kind(text, extension), expected, "{text}");
        }
    }

    #[test]
    fn files_that_have_no_records_are_named_as_what_they_are() {
        for (extension, words) in [("toml", "it is a case"), ("parquet", "it is no text"), ("arrow", "it is no text")] {
            let Err(issues) = sniff(Box::new(Cursor::new("schema = 1\n")), Some(extension)) else { panic!("{extension}") };
            let [(None, complaints)] = &issues[..] else { panic!("{extension}") };
            assert!(complaints.to_string().starts_with(words), "{complaints}");
        }
    }
}
