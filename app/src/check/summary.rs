//! Number of records with each verdict.

use std::collections::BTreeMap;

use planar_impact::check::Verdict;
use schemars::JsonSchema;
use serde::Serialize;

use super::entry::Entry;

/// Number of records with each verdict.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Summary {
    /// Number of records.
    pub records: u64,
    /// Number of records that pass.
    pub pass: u64,
    /// Number of records that pass with warnings.
    pub warn: u64,
    /// Number of records that break a rule.
    pub fail: u64,
    /// Number of records that could not be decided.
    pub undecidable: u64,
    /// Number of records that pass because they give too little for any law, with warnings or without.
    #[serde(skip)]
    pub unchecked: u64,
    /// Number of findings of each rule and severity.
    #[serde(skip)]
    pub findings: BTreeMap<(&'static str, &'static str), u64>,
}

impl Summary {
    /// Adds a record to the counts.
    pub fn add(&mut self, entry: &Entry) {
        self.records += 1;
        *match entry.verdict {
            Verdict::Pass => &mut self.pass,
            Verdict::Warn => &mut self.warn,
            Verdict::Fail => &mut self.fail,
            Verdict::Undecidable => &mut self.undecidable,
        } += 1;
        self.unchecked += u64::from(entry.is_unchecked());
        for found in &entry.findings {
            *self.findings.entry((found.severity.name(), found.rule)).or_default() += 1;
        }
    }
}
