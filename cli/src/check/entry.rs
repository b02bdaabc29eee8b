//! What is to be told of one record.

use planar_impact::check::{Outcome, Rule, Severity, Verdict};

use super::complaint::Complaints;

/// The name under which a record that cannot be read is found. It is no rule of the library, which never sees such a record.
pub const MALFORMED: &str = "malformed";
/// What it means.
pub const MALFORMED_HELP: &str = "The record can be read: its keys are known, its numbers are numbers, nothing contradicts itself, and no record shortly before it has its id.";

/// What was found about one record.
#[derive(Debug)]
pub struct Entry {
    /// The record's name; empty if it could not be read.
    pub id: String,
    /// The number of its line.
    pub line: u64,
    pub verdict: Verdict,
    pub findings: Vec<Found>,
    pub not_checked: Vec<&'static str>,
}

/// One thing that was found.
#[derive(Debug)]
pub struct Found {
    pub rule: &'static str,
    pub severity: Severity,
    /// How far the rule is from holding; none of what has no size.
    pub size: Option<f64>,
    pub bound: Option<f64>,
    pub what: String,
}

impl Found {
    /// A record that cannot be read, or not be told from another.
    pub fn malformed(what: String) -> Found {
        Found { rule: MALFORMED, severity: Severity::Fail, size: None, bound: None, what }
    }
}

impl Entry {
    /// Of a record that was checked, and what was noticed beside that.
    pub fn of(outcome: Outcome, line: u64, notes: Vec<Found>) -> Entry {
        let not_checked = outcome.not_checked().map(Rule::name).collect();
        let of_rules = outcome.findings.into_iter().map(|finding| Found {
            rule: finding.rule.name(),
            severity: finding.severity,
            size: Some(finding.size).filter(|size| size.is_finite()),
            bound: Some(finding.bound).filter(|bound| bound.is_finite()),
            what: finding.what,
        });
        Entry::with(outcome.id, line, notes.into_iter().chain(of_rules).collect(), not_checked)
    }

    /// Of a record that cannot be read.
    pub fn unreadable(id: String, complaints: &Complaints, line: u64) -> Entry {
        let findings = complaints.iter().map(|what| Found::malformed(what.to_owned())).collect();
        Entry::with(id, line, findings, Rule::ALL.map(Rule::name).to_vec())
    }

    fn with(id: String, line: u64, findings: Vec<Found>, not_checked: Vec<&'static str>) -> Entry {
        let verdict = Verdict::of(findings.iter().map(|found| found.severity).max());
        Entry { id, line, verdict, findings, not_checked }
    }

    /// The worst that was found.
    pub fn worst(&self) -> Option<Severity> {
        self.findings.iter().map(|found| found.severity).max()
    }

    /// The name, or the line where there is none.
    pub fn title(&self) -> String {
        if self.id.is_empty() { format!("line {}", self.line) } else { self.id.clone() }
    }
}
