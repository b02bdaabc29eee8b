//! The outcome of checking a record.

use super::coverage::Coverage;
use super::key::Key;
use super::rule::{Rule, Rules, Severity};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// The outcome of checking a record.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Outcome {
    /// The name of the record.
    pub id: String,
    /// Every rule that does not hold or could not be evaluated.
    pub findings: Vec<Finding>,
    pub(super) checked: Rules,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) coverage: Coverage,
    /// Quantities for comparison within a group; empty without one.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) common: Vec<Common>,
}

/// One quantity that must be the same in every record of a group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Common {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) value: f64,
    pub(super) bound: f64,
}

/// A rule that does not hold, or could not be evaluated.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Finding {
    /// The rule.
    pub rule: Rule,
    /// Severity of the finding.
    pub severity: Severity,
    /// Distance of the residual from satisfying the rule, in the SI unit of the message.
    pub size: f64,
    /// Accepted distance, from the resolutions or the profile.
    pub bound: f64,
    /// A sentence with the numbers.
    pub what: String,
}

/// Overall verdict of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Verdict {
    /// Every rule that could be checked holds.
    Pass,
    /// Passed with warnings.
    Warn,
    /// A rule is broken.
    Fail,
    /// No rule is broken, but one could not be evaluated: the numbers are too coarse.
    Undecidable,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Verdict; 4] = [Verdict::Pass, Verdict::Warn, Verdict::Fail, Verdict::Undecidable];

    /// Returns the verdict of the worst finding.
    pub const fn of(worst: Option<Severity>) -> Verdict {
        match worst {
            None => Verdict::Pass,
            Some(Severity::Warn) => Verdict::Warn,
            Some(Severity::Undecidable) => Verdict::Undecidable,
            Some(Severity::Fail) => Verdict::Fail,
        }
    }

    /// Returns its name in a report.
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
    /// Returns the verdict of the worst finding.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self.findings.iter().map(|finding| finding.severity).max())
    }

    /// Returns `true` if the record was checked against a rule.
    pub fn has_checked(&self, rule: Rule) -> bool {
        self.checked.contains(rule)
    }

    /// Returns the rules that could not be checked because a number they need is missing.
    pub fn not_checked(&self) -> impl Iterator<Item = Rule> {
        let checked = self.checked;
        Rule::ALL.into_iter().filter(move |rule| !checked.contains(*rule))
    }

    /// Returns the findings of a rule.
    pub fn of(&self, rule: Rule) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.rule == rule)
    }

    /// Returns the rules that the record calls for and that were not checked, each with the numbers it lacks.
    ///
    /// A record calls for every law of two bodies in the plane: both momenta unless a body is fixed, line of action, energy, and the rules at the contact. It
    /// also calls for the impulse ratio if its model states one, for its reported results, and for the comparison with its group.
    ///
    /// ```
    /// use planar_impact::check::{Options, Record, Rule, check};
    /// let outcome = check(&Record::default(), &Options::default());
    /// let momentum = outcome.unchecked().find(|unchecked| unchecked.rule == Rule::LinearMomentum).expect("it has no masses");
    /// assert!(momentum.to_string().starts_with("linear-momentum was not checked: b1.mass, b1.before.vx,"));
    /// ```
    pub fn unchecked(&self) -> impl Iterator<Item = Unchecked> {
        self.coverage.called_for().filter_map(|rule| self.gap(rule))
    }

    fn gap(&self, rule: Rule) -> Option<Unchecked> {
        (!self.has_checked(rule)).then(|| Unchecked { rule, missing: self.coverage.missing(rule) })
    }

    /// Asserts in a test that the record is complete and correct: no rule is broken, and every rule that the record calls for ([`Outcome::unchecked`]) was
    /// evaluated. Use [`Outcome::assert_checked`] for a record that cannot be complete.
    ///
    /// # Panics
    ///
    /// If a rule is broken, not checked although the record calls for it, or undecidable; with all findings, and the numbers that each unchecked rule lacks.
    #[track_caller]
    pub fn assert(&self) {
        let rules: Vec<Rule> = self.coverage.called_for().collect();
        self.assert_checked(&rules);
    }

    /// Asserts in a test that no rule is broken and that these rules were evaluated. Without any rules it asserts only that none is broken.
    ///
    /// ```
    /// # use planar_impact::check::{Options, Record, Rule, check};
    /// # let mut record = Record::default();
    /// # record.reported.energy_loss = Some(1.0);
    /// # record.reported.work_normal = Some(-1.0);
    /// # record.reported.work_tangential = Some(0.0);
    /// // Claims without motions.
    /// check(&record, &Options::default()).assert_checked(&[Rule::Reported]);
    /// ```
    ///
    /// # Panics
    ///
    /// If a rule is broken, or one of these was not checked or is undecidable; with all findings, and the numbers that each unchecked rule lacks.
    #[track_caller]
    pub fn assert_checked(&self, rules: &[Rule]) {
        let gaps: Vec<Unchecked> = rules.iter().filter_map(|rule| self.gap(*rule)).collect();
        let is_open = |finding: &Finding| finding.severity == Severity::Undecidable && rules.contains(&finding.rule);
        if self.verdict() == Verdict::Fail || !gaps.is_empty() || self.findings.iter().any(is_open) {
            let gaps: String = gaps.iter().map(|gap| alloc::format!("\n  {gap}")).collect();
            panic!("{self}{gaps}");
        }
    }
}

/// A rule that a record calls for and that was not checked.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Unchecked {
    /// The rule.
    pub rule: Rule,
    /// The numbers it needs and the record lacks; empty for a rule that needs other records or claims, or that a number decides, such as an impulse of zero.
    pub missing: Vec<Key>,
}

impl fmt::Display for Unchecked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} was not checked: ", self.rule)?;
        match (self.rule, &self.missing[..]) {
            (Rule::Group, _) => f.write_str("compare the record with its group, by Consensus::apply"),
            (Rule::Reported, _) => f.write_str("the record lacks the numbers to compare its claims with"),
            (_, []) => f.write_str("its numbers are present, but one is zero or not valid"),
            (_, [first, others @ ..]) => {
                write!(f, "{first}")?;
                others.iter().try_for_each(|key| write!(f, ", {key}"))?;
                write!(f, " {} missing", if others.is_empty() { "is" } else { "are" })
            }
        }
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

/// Writes the verdict and a line for each finding.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = if self.id.is_empty() { "the record" } else { &self.id };
        write!(f, "{name}: {}", self.verdict())?;
        self.findings.iter().try_for_each(|finding| write!(f, "\n  {finding}"))
    }
}
