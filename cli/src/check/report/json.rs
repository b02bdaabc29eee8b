//! JSON: a line for each record.

use std::io::{self, Write};

use serde::Serialize;

use super::{Report, Summary};
use crate::check::entry::Entry;

/// The report.
#[derive(Default)]
pub struct Json {
    is_behind: bool,
}

#[derive(Serialize)]
struct Record<'a> {
    id: String,
    file: &'a str,
    line: u64,
    verdict: &'static str,
    findings: Vec<Finding<'a>>,
    not_checked: &'a [&'static str],
}

#[derive(Serialize)]
struct Finding<'a> {
    rule: &'static str,
    severity: &'static str,
    /// `null` where there is none, or none that is finite.
    size: Option<f64>,
    bound: Option<f64>,
    what: &'a str,
}

impl Report for Json {
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()> {
        write!(to, "{{ \"schema\": 1, \"records\": [")
    }

    fn begin_file(&mut self, _: &mut Vec<u8>, _: &str) -> io::Result<()> {
        Ok(())
    }

    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()> {
        writeln!(to, "{}", if self.is_behind { "," } else { "" })?;
        self.is_behind = true;
        let findings = entry.findings.iter().map(|found| Finding {
            rule: found.rule,
            severity: found.severity.name(),
            size: found.size,
            bound: found.bound,
            what: &found.what,
        });
        let record = Record {
            id: entry.title(),
            file,
            line: entry.line,
            verdict: entry.verdict.name(),
            findings: findings.collect(),
            not_checked: &entry.not_checked,
        };
        serde_json::to_writer(to, &record).map_err(Into::into)
    }

    fn end_file(&mut self, _: &mut Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary) -> io::Result<()> {
        write!(to, "\n],\n\"summary\": ")?;
        serde_json::to_writer(&mut *to, summary)?;
        writeln!(to, " }}")
    }
}
