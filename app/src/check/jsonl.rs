//! Records as JSON Lines: the header on the first line, one record on each following line.

use std::io::{self, BufRead};

use super::complaint::{Complaints, Numbered, refused};
use super::header;
use super::json;
use super::lines::{Line, Lines, unreadable};
use super::units::Units;
use crate::document::Value;
use crate::document::json::parse;

/// A reader of records as JSON Lines.
pub struct JsonLines<R> {
    lines: Lines<R>,
    units: Units,
}

impl<R: BufRead> JsonLines<R> {
    /// Reads the header.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails. The inner result holds everything wrong with the header, with its line number.
    pub fn open(mut lines: Lines<R>) -> io::Result<Result<Self, (u64, Complaints)>> {
        let wrong = |at: u64, messages: &[String]| {
            let mut complaints = Complaints::default();
            messages.iter().for_each(|message| complaints.push("", message));
            Ok(Err((at, complaints)))
        };
        let line = lines.next()?;
        let parsed = match &line {
            Some(Line::Text(text)) => parse(text).map_err(|issues| issues.into_iter().map(|issue| issue.message.to_string()).collect()),
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

    /// Returns `true` if there is another record.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn has_more(&mut self) -> io::Result<bool> {
        self.lines.has_more()
    }

    /// Returns the next record and its line number.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn next(&mut self) -> io::Result<Option<Numbered>> {
        let Some(line) = self.lines.next()? else { return Ok(None) };
        let read = match line {
            Line::Text(text) => json::read(text, &self.units),
            other => Err(refused(&unreadable(&other))),
        };
        Ok(Some((self.lines.number(), read)))
    }
}
