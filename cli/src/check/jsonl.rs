//! Records as JSON Lines: the header on the first line, a record on each line behind it.

use std::io::{self, BufRead};

use planar_impact::check::Record;

use super::complaint::Complaints;
use super::csv::{refused, unreadable};
use super::header;
use super::json::{self, Unreadable};
use super::lines::{Line, Lines};
use super::units::Units;
use crate::document::Value;
use crate::document::json::parse;

/// Lines of records.
pub struct JsonLines<R> {
    lines: Lines<R>,
    units: Units,
}

impl<R: BufRead> JsonLines<R> {
    /// Reads the header.
    ///
    /// # Errors
    ///
    /// When the reader fails; and everything wrong with the header, with the number of its line.
    pub fn open(mut lines: Lines<R>) -> io::Result<Result<Self, (u64, Complaints)>> {
        let wrong = |at: u64, messages: &[String]| {
            let mut complaints = Complaints::default();
            messages.iter().for_each(|message| complaints.push("", message));
            Ok(Err((at, complaints)))
        };
        let line = lines.next()?;
        let parsed = match &line {
            Some(Line::Text(text)) => parse(text).map_err(|problems| problems.into_iter().map(|problem| problem.message).collect()),
            Some(other) => Err(vec![unreadable(other)]),
            None => Err(vec!["the header is missing".to_owned()]),
        };
        let at = lines.number().max(1);
        let node = match parsed {
            Ok(node) => node,
            Err(messages) => return wrong(at, &messages),
        };
        let Value::Table(entries) = &node.value else {
            return wrong(at, &[format!("the first line is the header, an object; found {}", node.value.describe())]);
        };
        if entries.iter().any(|entry| entry.key == "id") && !entries.iter().any(|entry| entry.key == "schema") {
            return wrong(at, &["the first line is the header, with `schema` and `units`; this one looks like a record".to_owned()]);
        }
        Ok(header::read(entries, None).map_err(|complaints| (at, complaints)).map(|units| JsonLines { lines, units }))
    }

    /// Whether there is another record.
    ///
    /// # Errors
    ///
    /// When the reader fails.
    pub fn has_more(&mut self) -> io::Result<bool> {
        self.lines.has_more()
    }

    /// The next record and the number of its line.
    ///
    /// # Errors
    ///
    /// When the reader fails.
    pub fn next(&mut self) -> io::Result<Option<(u64, Result<Record, Unreadable>)>> {
        let Some(line) = self.lines.next()? else { return Ok(None) };
        let read = match line {
            Line::Text(text) => json::read(text, &self.units),
            other => Err(refused(&unreadable(&other))),
        };
        Ok(Some((self.lines.number(), read)))
    }
}
