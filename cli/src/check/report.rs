//! Formats of the findings. Each one writes record by record and keeps only counts.

mod json;
mod junit;
mod sarif;
mod text;

use std::io;

use planar_impact_app::check::{Entry, Summary};
use planar_impact_app::plain_text::is_active;

use crate::arguments::{CheckFormat, FailOn};

/// A report format. Calling all functions in order writes one document.
pub trait Report {
    /// Writes the text before the first file.
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()>;
    /// Writes the text before a file's first record.
    fn begin_file(&mut self, to: &mut Vec<u8>, file: &str) -> io::Result<()>;
    /// Writes a record.
    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()>;
    /// Writes the text after a file's last record.
    fn end_file(&mut self, to: &mut Vec<u8>) -> io::Result<()>;
    /// Writes the text after the last file, or after an interruption by the user.
    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary, interrupted: bool) -> io::Result<()>;
}

/// Creates a report; only JUnit needs `fail_on`.
pub fn of(format: CheckFormat, fail_on: FailOn) -> Box<dyn Report> {
    match format {
        CheckFormat::Text => Box::new(text::Text::default()),
        CheckFormat::Json => Box::new(json::Json::default()),
        CheckFormat::Junit => Box::new(junit::JUnit { fail_on }),
        CheckFormat::Sarif => Box::new(sarif::Sarif::default()),
    }
}

/// Removes characters that a terminal or a document would interpret, or that XML does not allow.
fn clean(text: &str) -> String {
    let is_bad = |c: char| is_active(c) || matches!(c, '\u{fffe}' | '\u{ffff}');
    text.chars().map(|c| if is_bad(c) { '\u{fffd}' } else { c }).collect()
}
