//! Counts the collisions that satisfy each law.

use planar_impact::check::{Outcome, Rule, Severity, Verdict};

/// The counted rules, and their columns.
const RULES: [(Rule, &str); 6] = [
    (Rule::LinearMomentum, "linear"),
    (Rule::AngularMomentum, "angular"),
    (Rule::LineOfAction, "line"),
    (Rule::EnergyGain, "energy"),
    (Rule::Interpenetration, "parting"),
    (Rule::Restitution, "restit."),
];

/// The counts of one setting.
#[derive(Default)]
pub struct Tally {
    /// Pairs that did not touch.
    pub missed: usize,
    collisions: usize,
    passed: usize,
    broken: [usize; RULES.len()],
    other: usize,
}

impl Tally {
    /// The header above the counts.
    pub const HEADER: &str = "  e   mu  pairs  pass   linear angular    line  energy parting restit.   other";
    /// Legend of the columns.
    pub const LEGEND: &str = "\
pairs    that touched; pass: without a broken law; then how many broke which law
linear   linear momentum, to 1e-6       angular  angular momentum, to 2e-2
line     each body's angular momentum about the contact point, to 2e-2
energy   gained                         parting  still approaching afterwards
restit.  the separation is not e times the approach at this one point
other    another rule is broken, such as a tangential impulse beyond the critical one";

    /// Counts one more collision.
    pub fn add(&mut self, outcome: &Outcome) {
        self.collisions += 1;
        self.passed += usize::from(outcome.verdict() != Verdict::Fail);
        for (broken, (rule, _)) in self.broken.iter_mut().zip(RULES) {
            *broken += usize::from(outcome.of(rule).any(|finding| finding.severity == Severity::Fail));
        }
        let counted = |rule| RULES.iter().any(|&(known, _)| known == rule);
        self.other += usize::from(outcome.findings.iter().any(|found| found.severity == Severity::Fail && !counted(found.rule)));
    }

    /// Formats the counts as a line.
    pub fn line(&self, restitution: f64, friction: f64) -> String {
        let mut line = format!("{restitution:3.1}  {friction:3.1}  {:5} {:5}  ", self.collisions, self.passed);
        for (broken, (_, name)) in self.broken.iter().zip(RULES) {
            let width = name.len().max(7);
            line.push_str(&format!(" {broken:>width$}"));
        }
        line + &format!(" {:7}", self.other)
    }
}
