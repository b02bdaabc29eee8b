//! The forms in which what was found is told.
//!
//! Each writes record by record and keeps nothing but counts.

mod json;
mod junit;
mod sarif;
mod text;

use std::collections::BTreeMap;
use std::io;

use planar_impact::check::Verdict;
use serde::Serialize;

use super::entry::Entry;
use crate::arguments::{CheckFormat, FailOn};

/// How many records there are of each verdict.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Summary {
    pub records: u64,
    pub pass: u64,
    pub warn: u64,
    pub fail: u64,
    pub undecidable: u64,
    /// How many findings there are of each rule and severity.
    #[serde(skip)]
    pub findings: BTreeMap<(&'static str, &'static str), u64>,
}

impl Summary {
    /// Counts a record in.
    pub fn add(&mut self, entry: &Entry) {
        self.records += 1;
        *match entry.verdict {
            Verdict::Pass => &mut self.pass,
            Verdict::Warn => &mut self.warn,
            Verdict::Fail => &mut self.fail,
            Verdict::Undecidable => &mut self.undecidable,
        } += 1;
        for found in &entry.findings {
            *self.findings.entry((found.severity.name(), found.rule)).or_default() += 1;
        }
    }
}

/// A form of report. What is written is one document if all of its functions are called in order.
pub trait Report {
    /// In front of the first file.
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()>;
    /// In front of a file's first record.
    fn begin_file(&mut self, to: &mut Vec<u8>, file: &str) -> io::Result<()>;
    /// A record.
    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()>;
    /// Behind a file's last record.
    fn end_file(&mut self, to: &mut Vec<u8>) -> io::Result<()>;
    /// Behind the last file.
    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary) -> io::Result<()>;
}

/// A report in a format; what fails is for JUnit to know.
pub fn of(format: CheckFormat, fail_on: FailOn) -> Box<dyn Report> {
    match format {
        CheckFormat::Text => Box::new(text::Text::default()),
        CheckFormat::Json => Box::new(json::Json::default()),
        CheckFormat::Junit => Box::new(junit::JUnit { fail_on }),
        CheckFormat::Sarif => Box::new(sarif::Sarif::default()),
    }
}

/// Text without control characters, which could reach into a terminal and have no place in XML.
fn clean(text: &str) -> String {
    text.chars().map(|c| if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') { '\u{fffd}' } else { c }).collect()
}
