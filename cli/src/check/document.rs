//! Records in one JSON document, in bounded memory: each is cut out of the stream by itself.

use std::cell::Cell;
use std::fmt;
use std::io::{self, Read};
use std::rc::Rc;

use planar_impact::check::Record;
use serde::Deserializer as _;
use serde::de::{DeserializeSeed, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::complaint::Complaints;
use super::header;
use super::json::{self, Unreadable};
use super::lines::LONGEST;
use super::units::Units;
use crate::document::Value;
use crate::quantity::excerpt;

/// Why a document cannot be used.
#[derive(Debug)]
pub enum Unusable {
    /// It is not what it should be, at a line if that is known.
    Wrong(Option<u64>, Complaints),
    /// It cannot be read.
    Reader(io::Error),
}

/// Where the reader is, seen from the parser's side.
#[derive(Clone, Default)]
struct Position {
    line: Rc<Cell<u64>>,
    /// Bytes since the last record.
    bytes: Rc<Cell<usize>>,
}

/// Counts lines, and refuses to go on when a single value is too long to be a record. The parser takes one byte at a time, so they lie ready.
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
        if byte == b'\n' {
            self.position.line.set(self.position.line.get() + 1);
        }
        let bytes = self.position.bytes.get() + 1;
        self.position.bytes.set(bytes);
        if bytes > LONGEST {
            return Err(io::Error::new(io::ErrorKind::InvalidData, TOO_LONG));
        }
        Ok(1)
    }
}

const TOO_LONG: &str = "a record, or what stands between records, is longer than 1024 KiB";

/// What a pass over the document is for.
enum Pass<'a> {
    /// To see whether it can be used at all, and in which units it is.
    Header { members: Vec<(String, Box<RawValue>)>, records: Option<u64> },
    /// To take each record, with the number of its first line.
    Records { units: &'a Units, take: Take<'a> },
}

type Take<'a> = &'a mut dyn FnMut(u64, Result<Record, Unreadable>) -> io::Result<()>;

/// Reads a whole document to see whether it can be used. Nothing of it is kept but the units.
///
/// # Errors
///
/// A syntax error anywhere in it, and everything wrong with its header.
pub fn validate(reader: impl Read) -> Result<Units, Unusable> {
    let mut pass = Pass::Header { members: Vec::new(), records: None };
    run(reader, &mut pass, &mut None)?;
    let Pass::Header { members, records } = pass else { unreachable!("a pass does not change its kind") };
    let mut complaints = Complaints::default();
    // Each member is JSON by now; what the stricter parser adds are duplicate keys in it.
    let text =
        members.iter().map(|(key, value)| format!("{}: {value}", serde_json::Value::from(key.as_str()))).collect::<Vec<_>>().join(", ");
    let units = match crate::document::json::parse(&format!("{{{text}}}")).map(|node| node.value) {
        Ok(Value::Table(entries)) => header::read(&entries, Some("records")),
        Ok(_) => unreachable!("it was put between braces"),
        Err(problems) => {
            problems.iter().for_each(|problem| complaints.push("", &problem.message));
            Err(Complaints::default())
        }
    };
    match records {
        None => complaints.push("", "`records` is missing: the array of records"),
        Some(0) => complaints.push("records", "there are no records"),
        Some(_) => (),
    }
    match units {
        Ok(units) if complaints.is_empty() => Ok(units),
        Ok(_) => Err(Unusable::Wrong(None, complaints)),
        Err(of_header) => {
            complaints.append(of_header);
            Err(Unusable::Wrong(None, complaints))
        }
    }
}

/// Reads a document that can be used, and hands over each record.
///
/// # Errors
///
/// When the reader or the taker fails, or the document has changed since it was looked at.
pub fn records(reader: impl Read, units: &Units, take: Take<'_>) -> Result<(), Unusable> {
    let mut failure = None;
    run(reader, &mut Pass::Records { units, take }, &mut failure)
}

fn run(reader: impl Read, pass: &mut Pass<'_>, failure: &mut Option<io::Error>) -> Result<(), Unusable> {
    let position = Position::default();
    let counted = Counted { reader, ready: vec![0; 1 << 16].into(), at: 0, end: 0, position: position.clone() };
    let mut deserializer = serde_json::Deserializer::from_reader(counted);
    let read = deserializer.deserialize_map(Root { pass, position, failure }).and_then(|()| deserializer.end());
    let Err(error) = read else { return Ok(()) };
    if let Some(failure) = failure.take() {
        return Err(Unusable::Reader(failure));
    }
    let is_too_long = error.to_string().contains(TOO_LONG);
    if error.is_io() && !is_too_long {
        return Err(Unusable::Reader(error.into()));
    }
    let mut complaints = Complaints::default();
    let text = error.to_string();
    let message = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    let hint = if message.starts_with("trailing characters") { "; is it JSON Lines? Name it *.jsonl" } else { hint(message) };
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

/// The object that is the document.
struct Root<'p, 'a> {
    pass: &'p mut Pass<'a>,
    position: Position,
    failure: &'p mut Option<io::Error>,
}

impl<'de> Visitor<'de> for Root<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of `schema`, `units` and `records`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Root { pass, position, failure } = self;
        let mut seen: Vec<String> = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            if seen.contains(&key) {
                return Err(A::Error::custom(format!("the key {} stands twice", excerpt(&key))));
            }
            // Beyond the few keys that are known there is nothing to hold on to.
            if seen.len() < 20 {
                seen.push(key.clone());
            }
            if key == "records" {
                map.next_value_seed(Records { pass, position: position.clone(), failure })?;
                continue;
            }
            let value = map.next_value::<Box<RawValue>>()?;
            position.bytes.set(0);
            if let Pass::Header { members, .. } = pass
                && members.len() < 20
            {
                members.push((key, value));
            }
        }
        Ok(())
    }
}

/// The array of records.
struct Records<'p, 'a> {
    pass: &'p mut Pass<'a>,
    position: Position,
    failure: &'p mut Option<io::Error>,
}

impl<'de> DeserializeSeed<'de> for Records<'_, '_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Records<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of records")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<(), A::Error> {
        let Records { pass, position, failure } = self;
        if let Pass::Header { records, .. } = pass {
            *records = Some(0);
        }
        position.bytes.set(0);
        while let Some(text) = sequence.next_element::<Box<RawValue>>()? {
            position.bytes.set(0);
            match pass {
                Pass::Header { records, .. } => *records = records.map(|count| count + 1),
                Pass::Records { units, take } => {
                    let text = text.get();
                    let within = text.bytes().filter(|byte| *byte == b'\n').count() as u64;
                    let line = position.line.get() + 1 - within;
                    if let Err(error) = take(line, json::read(text, units)) {
                        *failure = Some(error);
                        return Err(A::Error::custom("the taker has enough"));
                    }
                }
            }
        }
        Ok(())
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
        let units = validate(text.as_bytes()).unwrap();
        let mut found = Vec::new();
        records(text.as_bytes(), &units, &mut |line, record| {
            found.push((line, record.map(|record| record.id).map_err(|(_, complaints)| complaints.to_string())));
            Ok(())
        })
        .unwrap();
        assert_eq!(found[..2], [(3, Ok("a".to_owned())), (5, Ok("b".to_owned()))]);
        assert_eq!(found[2].0, 7);
        assert!(found[2].1.as_ref().unwrap_err().starts_with("id: expected a string"), "{found:?}");
    }

    #[test]
    fn what_is_no_document_is_told_with_its_line() {
        assert_eq!(wrong("{\n\"records\": [{}\n").0, Some(3));
        assert!(wrong(&format!("{{{HEADER},\n \"records\": [{{\"id\": NaN}}]}}")).1.contains("no NaN"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": [{{}},]}}")).1.contains("no comma behind the last"));
        assert!(wrong(&format!("{{{HEADER}, \"records\": [{{}}]}}\n{{}}")).1.contains("JSON Lines"));
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
