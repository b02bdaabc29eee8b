//! Files of records in any form: opened and looked at first, read through afterwards.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use planar_impact::check::Record;

use super::complaint::Complaints;
use super::csv::Table;
use super::document::{self, Unusable};
use super::json::Unreadable;
use super::jsonl::JsonLines;
use super::lines::{LONGEST, Lines};
use super::units::Units;
use crate::document::{Value, json};

/// The largest JSON document that is read from a pipe, which cannot be read twice.
const LARGEST_PIPED: u64 = 64 << 20;
const BUFFER: usize = 1 << 16;

/// What is read through.
pub type Source = Box<dyn BufRead>;

/// A file of records that can be used, as far as its beginning shows; of a document all of it was looked at.
pub struct Input {
    /// The path as given, or `<stdin>`.
    pub name: String,
    content: Content,
    form: Form,
}

enum Content {
    /// A regular file, opened again to be read through, and its size in bytes.
    File(PathBuf, u64),
    /// What is left of a pipe.
    Lines(JsonLines<Source>),
    Table(Box<Table<Source>>),
    /// A document that came from a pipe.
    Memory(Vec<u8>),
}

enum Form {
    Lines,
    Table,
    Document(Units),
}

/// A problem with a file, the line if it is known, and what it is.
pub type Problem = (Option<u64>, Complaints);

/// Counts the bytes that have been read.
struct Counted<R> {
    reader: R,
    bytes: Arc<AtomicU64>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(to)?;
        self.bytes.fetch_add(read as u64, Ordering::Relaxed);
        Ok(read)
    }
}

impl Input {
    /// Opens a file, or standard input for `-`, and looks at its beginning; at all of it if it is a JSON document.
    ///
    /// # Errors
    ///
    /// Everything for which it cannot be used.
    pub fn open(path: &Path) -> Result<Input, Vec<Problem>> {
        if path.as_os_str() == "-" {
            return Input::of_pipe("<stdin>".to_owned(), None, Box::new(BufReader::with_capacity(BUFFER, io::stdin())));
        }
        let name = path.display().to_string();
        let unreadable = |error: &io::Error| vec![of_file(&format!("it cannot be read: {}", reason(error)))];
        let file = File::open(path).map_err(|error| unreadable(&error))?;
        let metadata = file.metadata().map_err(|error| unreadable(&error))?;
        if metadata.is_dir() {
            return Err(vec![of_file("it is a directory, not a file of records")]);
        }
        let extension = path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
        let source = Box::new(BufReader::with_capacity(BUFFER, file));
        if !metadata.is_file() {
            return Input::of_pipe(name, extension.as_deref(), source);
        }
        let (kind, source) = sniff(source, extension.as_deref())?;
        let form = match kind {
            Kind::Document => Form::Document(document::validate(source).map_err(of_document)?),
            Kind::Lines => open_lines(source).map(|_| Form::Lines)?,
            Kind::Table => open_table(source).map(|_| Form::Table)?,
        };
        Ok(Input { name, content: Content::File(path.to_owned(), metadata.len()), form })
    }

    fn of_pipe(name: String, extension: Option<&str>, source: Source) -> Result<Input, Vec<Problem>> {
        let (kind, source) = sniff(source, extension)?;
        let (content, form) = match kind {
            Kind::Lines => (Content::Lines(open_lines(source)?), Form::Lines),
            Kind::Table => (Content::Table(Box::new(open_table(source)?)), Form::Table),
            Kind::Document => {
                let mut bytes = Vec::new();
                let read = source.take(LARGEST_PIPED + 1).read_to_end(&mut bytes);
                read.map_err(|error| vec![of_file(&format!("it cannot be read: {}", reason(&error)))])?;
                if bytes.len() as u64 > LARGEST_PIPED {
                    let message = format!("a JSON document from a pipe may have {} MiB; give a file, or JSON Lines", LARGEST_PIPED >> 20);
                    return Err(vec![of_file(&message)]);
                }
                let units = document::validate(bytes.as_slice()).map_err(of_document)?;
                (Content::Memory(bytes), Form::Document(units))
            }
        };
        Ok(Input { name, content, form })
    }

    /// How many bytes there are to be read, if that is known.
    pub fn size(&self) -> Option<u64> {
        match &self.content {
            Content::File(_, size) => Some(*size),
            Content::Memory(bytes) => Some(bytes.len() as u64),
            _ => None,
        }
    }

    /// Reads all records, each with the number of its line. The bytes that have been read are counted.
    ///
    /// # Errors
    ///
    /// When the file cannot be read on, or is not what it was when it was opened; or when the taker fails.
    pub fn read(
        self,
        bytes: &Arc<AtomicU64>,
        take: &mut dyn FnMut(u64, Result<Record, Unreadable>) -> io::Result<()>,
    ) -> Result<(), Trouble> {
        let source: Source = match self.content {
            Content::File(path, _) => {
                let reader = File::open(path).map_err(|error| Trouble::of_reader(&error))?;
                let counted = Counted { reader, bytes: bytes.clone() };
                let (_, source) = sniff(Box::new(BufReader::with_capacity(BUFFER, counted)), None).map_err(Trouble::changed)?;
                source
            }
            Content::Memory(bytes) => Box::new(Cursor::new(bytes)),
            Content::Lines(mut lines) => return drain(|| lines.next(), take),
            Content::Table(mut table) => return drain(|| table.next(), take),
        };
        match self.form {
            Form::Lines => {
                let mut lines = open_lines(source).map_err(Trouble::changed)?;
                drain(|| lines.next(), take)
            }
            Form::Table => {
                let mut table = open_table(source).map_err(Trouble::changed)?;
                drain(|| table.next(), take)
            }
            Form::Document(units) => document::records(source, &units, take).map_err(|unusable| match unusable {
                Unusable::Reader(error) => Trouble::of_taker_or_reader(error),
                Unusable::Wrong(line, complaints) => Trouble::changed(vec![(line, complaints)]),
            }),
        }
    }
}

/// Why records cannot be read on.
#[derive(Debug)]
pub enum Trouble {
    /// What is read.
    Input(Vec<Problem>),
    /// What is done with it.
    Taker(io::Error),
}

impl Trouble {
    fn of_reader(error: &io::Error) -> Trouble {
        Trouble::Input(vec![of_file(&format!("it cannot be read on: {}", reason(error)))])
    }

    fn of_taker_or_reader(error: io::Error) -> Trouble {
        Trouble::Taker(error)
    }

    fn changed(mut problems: Vec<Problem>) -> Trouble {
        problems.insert(0, of_file("it has changed while it was read"));
        Trouble::Input(problems)
    }
}

type Next = io::Result<Option<(u64, Result<Record, Unreadable>)>>;

fn drain(mut next: impl FnMut() -> Next, take: &mut dyn FnMut(u64, Result<Record, Unreadable>) -> io::Result<()>) -> Result<(), Trouble> {
    while let Some((line, record)) = next().map_err(|error| Trouble::of_reader(&error))? {
        take(line, record).map_err(Trouble::Taker)?;
    }
    Ok(())
}

fn of_file(message: &str) -> Problem {
    let mut complaints = Complaints::default();
    complaints.push("", message);
    (None, complaints)
}

fn of_document(unusable: Unusable) -> Vec<Problem> {
    vec![match unusable {
        Unusable::Wrong(line, complaints) => (line, complaints),
        Unusable::Reader(error) => of_file(&format!("it cannot be read: {}", reason(&error))),
    }]
}

fn open_lines(source: Source) -> Result<JsonLines<Source>, Vec<Problem>> {
    let mut lines = JsonLines::open(Lines::new(source)).map_err(unread)?.map_err(|(line, complaints)| vec![(Some(line), complaints)])?;
    if lines.has_more().map_err(unread)? { Ok(lines) } else { Err(vec![of_file("it has no records behind its header")]) }
}

fn open_table(source: Source) -> Result<Table<Source>, Vec<Problem>> {
    let opened = Table::open(Lines::new(source)).map_err(unread)?;
    let mut table =
        opened.map_err(|problems| problems.into_iter().map(|(line, complaints)| (Some(line), complaints)).collect::<Vec<_>>())?;
    if table.has_more().map_err(unread)? { Ok(table) } else { Err(vec![of_file("it has no records behind its units")]) }
}

fn unread(error: io::Error) -> Vec<Problem> {
    vec![of_file(&format!("it cannot be read: {}", reason(&error)))]
}

/// The usual reasons without the operating system's numbers.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

/// A form of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Document,
    Lines,
    Table,
}

/// Which form a file has, by its name where that tells, else by its first line. Gives back all of it but a byte order mark.
fn sniff(mut source: Source, extension: Option<&str>) -> Result<(Kind, Source), Vec<Problem>> {
    let mut head = Vec::new();
    let mut is_first = true;
    // Blank lines in front may be there, and count.
    while head.iter().all(u8::is_ascii_whitespace) && head.len() <= LONGEST {
        let read = (&mut source).take((LONGEST + 1 - head.len()) as u64).read_until(b'\n', &mut head).map_err(unread)?;
        if read == 0 {
            return Err(vec![of_file("it is empty")]);
        }
        if std::mem::take(&mut is_first) {
            if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) {
                return Err(vec![of_file("it is UTF-16; save it as UTF-8")]);
            }
            head.drain(..if head.starts_with(&[0xef, 0xbb, 0xbf]) { 3 } else { 0 });
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

/// Whether a line is a whole object without records: the header of JSON Lines.
fn is_header(line: &[u8]) -> bool {
    let node = str::from_utf8(line).ok().and_then(|text| json::parse(text).ok());
    node.is_some_and(|node| matches!(&node.value, Value::Table(entries) if !entries.iter().any(|entry| entry.key == "records")))
}
