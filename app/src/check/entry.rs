//! The findings of one record.

use planar_impact::check::{Outcome, Rule, Severity, Verdict};
use schemars::JsonSchema;
use serde::Serialize;

use super::complaint::Complaints;

/// The rule name of a record that cannot be read. It is not a rule of the library, which never receives such a record.
pub const MALFORMED: &str = "malformed";
/// Its help text.
pub const MALFORMED_HELP: &str = "The record can be read: its keys are known, its numbers are numbers, nothing contradicts itself, and no record shortly before it has its id.";

/// The findings of one record.
#[derive(Debug)]
pub struct Entry {
    /// The record's name; empty if it could not be read.
    pub id: String,
    /// The number of its line.
    pub line: u64,
    /// The overall verdict.
    pub verdict: Verdict,
    /// The findings, rule by rule.
    pub findings: Vec<Found>,
    /// The rules that could not be evaluated.
    pub not_checked: Vec<&'static str>,
}

/// One finding of a record.
#[derive(Debug)]
pub struct Found {
    /// The rule.
    pub rule: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// Amount by which the rule is violated; `None` if there is no finite size.
    pub size: Option<f64>,
    /// The bound that the resolutions or the tolerance imply.
    pub bound: Option<f64>,
    /// One sentence with the numbers.
    pub what: String,
}

/// A checked record in JSON.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CheckedRecord<'a> {
    /// The name of the record, or its line.
    pub id: String,
    /// The name of its file.
    pub file: &'a str,
    /// The number of its line.
    pub line: u64,
    /// `pass`, `warn`, `fail` or `undecidable`.
    pub verdict: &'static str,
    /// The findings.
    pub findings: Vec<CheckFinding<'a>>,
    /// The rules that could not be evaluated.
    pub not_checked: &'a [&'static str],
}

/// A finding of a checked record in JSON.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CheckFinding<'a> {
    /// The rule.
    pub rule: &'static str,
    /// `warn`, `fail` or `undecidable`.
    pub severity: &'static str,
    /// Amount by which the rule is violated; `null` if there is no finite size.
    pub size: Option<f64>,
    /// The bound that the resolutions or the tolerance imply.
    pub bound: Option<f64>,
    /// One sentence with the numbers.
    pub what: &'a str,
}

impl Entry {
    /// Converts it to JSON, as a record of `file`.
    pub fn in_json<'a>(&'a self, file: &'a str) -> CheckedRecord<'a> {
        let finding = |found: &'a Found| CheckFinding {
            rule: found.rule,
            severity: found.severity.name(),
            size: found.size,
            bound: found.bound,
            what: &found.what,
        };
        CheckedRecord {
            id: self.title(),
            file,
            line: self.line,
            verdict: self.verdict.name(),
            findings: self.findings.iter().map(finding).collect(),
            not_checked: &self.not_checked,
        }
    }
}

impl Found {
    /// Creates the finding of a record that cannot be read or distinguished from another.
    pub fn malformed(what: String) -> Found {
        Found { rule: MALFORMED, severity: Severity::Fail, size: None, bound: None, what }
    }
}

impl Entry {
    /// Creates the entry of a checked record; `notes` are further findings.
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

    /// Creates the entry of a record that cannot be read.
    pub fn unreadable(id: String, complaints: &Complaints, line: u64) -> Entry {
        let findings = complaints.iter().map(|what| Found::malformed(what.into_owned())).collect();
        Entry::with(id, line, findings, Rule::ALL.map(Rule::name).to_vec())
    }

    fn with(id: String, line: u64, findings: Vec<Found>, not_checked: Vec<&'static str>) -> Entry {
        let verdict = Verdict::of(findings.iter().map(|found| found.severity).max());
        Entry { id, line, verdict, findings, not_checked }
    }

    /// Returns `true` if it passes because it gives too little for any law: only its form and its sizes were looked at.
    pub fn is_unchecked(&self) -> bool {
        let is_law = |rule: &Rule| ![Rule::Finite, Rule::PlausibleUnits].contains(rule);
        let passes = matches!(self.verdict, Verdict::Pass | Verdict::Warn);
        passes && Rule::ALL.iter().filter(|rule| is_law(rule)).all(|rule| self.not_checked.contains(&rule.name()))
    }

    /// Returns the finding that it gives too little for any law; none of the rules has it.
    pub fn unchecked(&self) -> Option<Found> {
        let what = || "it gives too little for any law; see --rules".to_owned();
        self.is_unchecked().then(|| Found { rule: "unchecked", severity: Severity::Undecidable, size: None, bound: None, what: what() })
    }

    /// Returns the severity of its most severe finding; a record that gives too little for any law is not decided.
    pub fn worst(&self) -> Option<Severity> {
        let unchecked = self.is_unchecked().then_some(Severity::Undecidable);
        self.findings.iter().map(|found| found.severity).chain(unchecked).max()
    }

    /// Returns the name, or the line if there is no name.
    pub fn title(&self) -> String {
        if self.id.is_empty() { format!("line {}", self.line) } else { self.id.clone() }
    }
}
