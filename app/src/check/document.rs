//! Records in one JSON document, in bounded memory: each record is read from the stream separately.

use std::cell::Cell;
use std::fmt;
use std::io::{self, BufRead, Read};
use std::rc::Rc;

use serde::Deserializer as _;
use serde::de::{DeserializeSeed, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::complaint::{Complaints, Numbered, refused};
use super::header;
use super::json;
use super::lines::LONGEST;
use super::units::Units;
use crate::document::Value;
use crate::quantity::excerpt;

/// A document that cannot be used.
#[derive(Debug)]
pub enum Unusable {
    /// The content is invalid, with the line if it is known.
    Wrong(Option<u64>, Complaints),
    /// The reader failed.
    Reader(io::Error),
}

/// Position of the reader, shared with the parser's visitors.
#[derive(Clone, Default)]
struct Position {
    /// Total bytes read.
    total: Rc<Cell<u64>>,
    /// Bytes read since the last record.
    bytes: Rc<Cell<usize>>,
}

/// Counts bytes, and fails if a single value is too long to be a record. Buffers its input because the parser reads one byte at a time.
struct Counted<R> {
    reader: R,
    ready: Box<[u8]>,
    at: usize,
    end: usize,
    position: Position,
}

impl<R: Read> Read for Counted<R> {
    #[inline]
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        if self.at == self.end {
            (self.at, self.end) = (0, self.reader.read(&mut self.ready)?);
        }
        let (Some(to), Some(&byte)) = (to.first_mut(), self.ready[..self.end].get(self.at)) else { return Ok(0) };
        *to = byte;
        self.at += 1;
        self.position.total.set(self.position.total.get() + 1);
        let bytes = self.position.bytes.get() + 1;
        self.position.bytes.set(bytes);
        if bytes > LONGEST {
            return Err(io::Error::new(io::ErrorKind::InvalidData, TOO_LONG));
        }
        Ok(1)
    }
}

const TOO_LONG: &str = "a record, or what stands between records, is longer than 1024 KiB";

/// An overview of the whole document.
#[derive(Default)]
struct Overview {
    members: Vec<(String, Box<RawValue>)>,
    records: Option<Array>,
}

/// The array of records.
#[derive(Clone, Copy)]
struct Array {
    /// Number of bytes before its first record.
    begins: u64,
    count: u64,
}

/// Layout of a valid document: its units, and where its records begin.
#[derive(Debug)]
pub struct Layout {
    units: Units,
    begins: u64,
}

/// Reads a whole document and checks that it can be used, without keeping its records.
///
/// # Errors
///
/// Returns a syntax error anywhere in the document, or everything wrong with its header.
pub fn validate(reader: impl Read) -> Result<Layout, Unusable> {
    let Overview { members, records } = look_over(reader)?;
    let mut complaints = Complaints::default();
    // Each member is valid JSON at this point; the stricter parser also finds duplicate keys.
    let text =
        members.iter().map(|(key, value)| format!("{}: {value}", serde_json::Value::from(key.as_str()))).collect::<Vec<_>>().join(", ");
    let units = match crate::document::json::parse(&format!("{{{text}}}")).map(|node| node.value) {
        Ok(Value::Table(entries)) => header::read(&entries, Some("records")),
        Ok(_) => unreachable!("it was put between braces"),
        Err(issues) => {
            issues.iter().for_each(|issue| complaints.push("", issue.message.to_string()));
            Err(Complaints::default())
        }
    };
    match records {
        None => complaints.push("", "`records` is missing: the array of records"),
        Some(Array { count: 0, .. }) => complaints.push("records", "there are no records"),
        Some(_) => (),
    }
    match (units, records) {
        (Ok(units), Some(array)) if complaints.is_empty() => Ok(Layout { units, begins: array.begins }),
        (Ok(_), _) => Err(Unusable::Wrong(None, complaints)),
        (Err(of_header), _) => {
            complaints.append(of_header);
            Err(Unusable::Wrong(None, complaints))
        }
    }
}

/// The records of a valid document, each read separately.
pub struct Records<R> {
    bytes: io::Bytes<R>,
    units: Units,
    line: u64,
    /// A byte already read that belongs to the next value.
    ahead: Option<u8>,
}

impl<R: BufRead> Records<R> {
    /// Starts at the beginning of the document.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn open(mut reader: R, layout: Layout) -> io::Result<Self> {
        let mut line = 1;
        let mut left = layout.begins;
        while left > 0 {
            let part = reader.fill_buf()?;
            let used = part.len().min(usize::try_from(left).unwrap_or(usize::MAX));
            if used == 0 {
                break;
            }
            line += part[..used].iter().filter(|byte| **byte == b'\n').count() as u64;
            reader.consume(used);
            left -= used as u64;
        }
        Ok(Records { bytes: reader.bytes(), units: layout.units, line, ahead: None })
    }

    /// Returns the next record and the number of its first line.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn next(&mut self) -> io::Result<Option<Numbered>> {
        let first = loop {
            match self.byte()? {
                Some(byte) if byte.is_ascii_whitespace() || byte == b',' => (),
                Some(b']') | None => return Ok(None),
                Some(byte) => break byte,
            }
        };
        let line = self.line;
        let text = self.value(first)?;
        let record = match String::from_utf8(text) {
            Ok(text) => json::read(&text, &self.units),
            Err(_) => Err(refused("the record is not UTF-8 text")),
        };
        Ok(Some((line, record)))
    }

    fn byte(&mut self) -> io::Result<Option<u8>> {
        let byte = match self.ahead.take() {
            Some(byte) => Some(byte),
            None => self.bytes.next().transpose()?,
        };
        self.line += u64::from(byte == Some(b'\n'));
        Ok(byte)
    }

    /// Returns the text of a value up to its end. Counting brackets and quotation marks is enough, because the
    /// document was found to be valid JSON.
    fn value(&mut self, first: u8) -> io::Result<Vec<u8>> {
        let (mut text, mut depth, mut quoted, mut escaped) = (Vec::new(), 0_usize, false, false);
        let mut next = Some(first);
        while let Some(byte) = next {
            let ends = !quoted && depth == 0 && matches!(byte, b',' | b']' | b'}');
            if ends || text.len() > LONGEST {
                self.line -= u64::from(byte == b'\n');
                self.ahead = Some(byte);
                break;
            }
            match byte {
                _ if escaped => escaped = false,
                b'\\' if quoted => escaped = true,
                b'"' => quoted = !quoted,
                b'{' | b'[' if !quoted => depth += 1,
                b'}' | b']' if !quoted => depth -= 1,
                _ => (),
            }
            text.push(byte);
            let is_whole = !quoted && depth == 0 && matches!(byte, b'}' | b']' | b'"');
            next = if is_whole { None } else { self.byte()? };
        }
        Ok(text)
    }
}

fn look_over(reader: impl Read) -> Result<Overview, Unusable> {
    let (position, mut overview) = (Position::default(), Overview::default());
    let counted = Counted { reader, ready: vec![0; 1 << 16].into(), at: 0, end: 0, position: position.clone() };
    let mut deserializer = serde_json::Deserializer::from_reader(counted);
    let read = deserializer.deserialize_map(Root { overview: &mut overview, position }).and_then(|()| deserializer.end());
    let Err(error) = read else { return Ok(overview) };
    let is_too_long = error.to_string().contains(TOO_LONG);
    if error.is_io() && !is_too_long {
        return Err(Unusable::Reader(error.into()));
    }
    let mut complaints = Complaints::default();
    let text = error.to_string();
    let message = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    let hint = match (message.starts_with("trailing characters"), &overview.records) {
        (true, None) => "; is it JSON Lines? Name it *.jsonl",
        (true, Some(_)) => "; a file has one document: give what follows a file of its own",
        (false, _) => hint(message),
    };
    let column = if is_too_long { String::new() } else { format!("column {}", error.column()) };
    complaints.push(&column, format!("this is not a JSON document of records: {message}{hint}"));
    Err(Unusable::Wrong((error.line() > 0).then_some(error.line() as u64), complaints))
}

fn hint(message: &str) -> &'static str {
    match message {
        "trailing comma" => "; JSON has no comma behind the last item",
        "expected value" => "; JSON has no comments, no NaN and no Infinity",
        "number out of range" => "; it is beyond a 64-bit floating-point number",
        _ => "",
    }
}

/// The root object of the document.
struct Root<'p> {
    overview: &'p mut Overview,
    position: Position,
}

impl<'de> Visitor<'de> for Root<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of `schema`, `units` and `records`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Root { overview, position } = self;
        let mut seen: Vec<String> = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            if seen.contains(&key) {
                return Err(A::Error::custom(format!("the key {} stands twice", excerpt(&key))));
            }
            // Only a few keys are known, so a limited list is enough to find duplicates.
            if seen.len() < 20 {
                seen.push(key.clone());
            }
            if key == "records" {
                overview.records = Some(map.next_value_seed(Counting { position: position.clone() })?);
                continue;
            }
            let value = map.next_value::<Box<RawValue>>()?;
            position.bytes.set(0);
            if overview.members.len() < 20 {
                overview.members.push((key, value));
            }
        }
        Ok(())
    }
}

/// Counts the records of the array.
struct Counting {
    position: Position,
}

impl<'de> DeserializeSeed<'de> for Counting {
    type Value = Array;

    fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<Array, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Counting {
    type Value = Array;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of records")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Array, A::Error> {
        // The parser has consumed the bracket and nothing after it.
        let begins = self.position.total.get();
        self.position.bytes.set(0);
        let mut count = 0;
        while sequence.next_element::<Box<RawValue>>()?.is_some() {
            self.position.bytes.set(0);
            count += 1;
        }
        Ok(Array { begins, count })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = r#""schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"}"#;

    fn wrong(text: &str) -> (Option<u64>, String) {
        match validate(text.as_bytes()) {
            Err(Unusable::Wrong(line, complaints)) => (line, complaints.to_string()),
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn records_come_one_by_one_with_their_lines() {
        let text = format!("{{\n \"records\": [\n  {{\n   \"id\": \"a\"\n  }}, {{\"id\": \"b\"}},\n\n{{\"id\": 3}}], {HEADER}}}");
        let layout = validate(text.as_bytes()).unwrap();
        let mut records = Records::open(text.as_bytes(), layout).unwrap();
        let mut found = Vec::new();
        while let Some((line, read)) = records.next().unwrap() {
            found.push((line, read.map(|drafted| drafted.record.id).map_err(|(_, complaints)| complaints.to_string())));
        }
        assert_eq!(found[..2], [(3, Ok("a".to_owned())), (5, Ok("b".to_owned()))]);
        assert_eq!(found[2].0, 7);
        assert_eq!(found[2].1.as_ref().unwrap_err(), "id: expected a string, found a number");
    }

    #[test]
    fn brackets_and_marks_inside_strings_do_not_end_a_record() {
        let text = format!("{{{HEADER}, \"records\": [ {{\"id\": \"a]}}\\\"{{\"}},3 , [1, [2]],\n\"x\\\\\" ]}}");
        let layout = validate(text.as_bytes()).unwrap();
        let mut records = Records::open(text.as_bytes(), layout).unwrap();
        let mut count = 0;
        while let Some((line, record)) = records.next().unwrap() {
            count += 1;
            assert_eq!((line, record.is_ok()), (if count == 4 { 2 } else { 1 }, count == 1), "{count}");
        }
        assert_eq!(count, 4);
    }

    #[test]
    fn what_is_no_document_is_told_with_its_line() {
        assert_eq!(wrong("{\n\"records\": [{}\n").0, Some(3));
        assert!(wrong(&format!("{{{HEADER},\n \"records\": [{{\"id\": NaN}}]}}")).1.contains("no NaN"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": [{{}},]}}")).1.contains("no comma behind the last"));
        assert!(wrong(&format!("{{{HEADER}}}\n{{}}")).1.contains("JSON Lines"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": [{{}}]}}\n{{}}")).1.contains("a file of its own"));
        assert!(wrong(r#"{"schema": 1, "title": "solved", "vehicles": []}"#).1.contains("an answer of this program"));
        assert!(!wrong(r#"{"schema": 1, "units": {}, "records": []}"#).1.contains("an answer of this program"));
        assert!(wrong(&format!("{{{HEADER}}}")).1.contains("`records` is missing"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": []}}")).1.contains("no records"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": {{}}}}")).1.contains("an array of records"));
        assert!(wrong(&format!("{{{HEADER}, {HEADER}, \"records\": [{{}}]}}")).1.contains("stands twice"));
        assert!(wrong("[]").1.contains("an object of"));
        assert!(wrong(r#"{"schema": "planar-impact-record/2", "unit": 1, "records": [1]}"#).1.contains("version 2"));
    }

    #[test]
    fn one_endless_record_is_refused() {
        let endless = io::Cursor::new(format!("{{{HEADER}, \"records\": [\"")).chain(io::BufReader::new(io::repeat(b'a')));
        let Err(Unusable::Wrong(_, complaints)) = validate(endless) else { panic!("it cannot be used") };
        assert!(complaints.to_string().contains("longer than 1024 KiB"), "{complaints}");
    }
}
