//! What was found about a record.

use super::common::Common;
use super::rule::{Rule, Rules, Severity};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// What was found about a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// What the record is called.
    pub id: String,
    /// Every rule that does not hold, and every one of which that cannot be told.
    pub findings: Vec<Finding>,
    pub(super) checked: Rules,
    /// What the records of a group have in common; empty without one.
    pub(super) common: Vec<Common>,
}

/// A rule that does not hold, or of which that cannot be told.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: Rule,
    /// How bad it is.
    pub severity: Severity,
    /// How far the rule is from holding, in the SI unit that the sentence has.
    pub size: f64,
    /// How far it may be, as the resolutions or the profile have it.
    pub bound: f64,
    /// What is wrong, in a sentence with the numbers.
    pub what: String,
}

/// What is to be thought of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// Every rule that could be checked holds.
    Pass,
    /// So it is, with a warning.
    Warn,
    /// A rule is broken.
    Fail,
    /// No rule is broken; of one that has not been told, as the numbers are too coarse.
    Undecidable,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Verdict; 4] = [Verdict::Pass, Verdict::Warn, Verdict::Fail, Verdict::Undecidable];

    /// That of the worst that was found.
    pub const fn of(worst: Option<Severity>) -> Verdict {
        match worst {
            None => Verdict::Pass,
            Some(Severity::Warn) => Verdict::Warn,
            Some(Severity::Undecidable) => Verdict::Undecidable,
            Some(Severity::Fail) => Verdict::Fail,
        }
    }

    /// Its name in a report.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Warn => "warn",
            Verdict::Fail => "fail",
            Verdict::Undecidable => "undecidable",
        }
    }
}

impl Outcome {
    /// The verdict: that of the worst finding.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self.findings.iter().map(|finding| finding.severity).max())
    }

    /// Whether the record was held against a rule.
    pub fn has_checked(&self, rule: Rule) -> bool {
        self.checked.contains(rule)
    }

    /// The rules that it was not held against, because something they need is missing.
    pub fn not_checked(&self) -> impl Iterator<Item = Rule> {
        let checked = self.checked;
        Rule::ALL.into_iter().filter(move |rule| !checked.contains(*rule))
    }

    /// The findings of a rule.
    pub fn of(&self, rule: Rule) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.rule == rule)
    }

    /// For a test: nothing, if no rule is broken.
    ///
    /// # Panics
    ///
    /// If the verdict is [`Verdict::Fail`], with all that was found.
    #[track_caller]
    pub fn assert(&self) {
        assert!(self.verdict() != Verdict::Fail, "{self}");
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}): {}", self.rule, self.severity, self.what)
    }
}

/// The verdict and a line for each finding.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = if self.id.is_empty() { "the record" } else { &self.id };
        write!(f, "{name}: {}", self.verdict())?;
        self.findings.iter().try_for_each(|finding| write!(f, "\n  {finding}"))
    }
}
