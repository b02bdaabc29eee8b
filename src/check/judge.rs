//! Comparison of residuals with their bounds.

use super::coverage::Coverage;
use super::format::Digits;
use super::options::Options;
use super::outcome::{Common, Finding, Outcome};
use super::profile::Profile;
use super::record::Record;
use super::rule::{Rule, Rules, Severity};
use super::uncertain::Uncertain;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Sizes of which a record may tell nothing, and beside which its numbers may be rounding: speeds in m/s, impulses in N s and energies in J of vehicles.
pub(super) const SPEED: f64 = 1e2;
pub(super) const IMPULSE: f64 = 1e6;
pub(super) const ENERGY: f64 = 1e7;

/// Collects the findings of one record.
pub(super) struct Judge {
    profile: Profile,
    tolerance: Option<f64>,
    /// By how much more than a sum an impulse is rounded: a solver divides by K_nn + μ K_nt, which is rounded as its parts are.
    amplification: f64,
    /// Factor on the tolerance: of what follows from numbers with their errors.
    leniency: f64,
    checked: Rules,
    findings: Vec<Finding>,
    pub(super) common: Vec<Common>,
}

/// A quantity that must be zero, or must not be above it, with its size for arbitrary errors.
#[derive(Clone, Copy)]
pub(super) struct Residual<const N: usize> {
    pub(super) value: Uncertain<N>,
    /// Size for arbitrary errors, in the same unit. The tolerance is a share of it, and a larger bound makes the rule undecidable.
    pub(super) scale: f64,
    /// Part of it that the record leaves open, and that is accepted.
    slack: f64,
    /// Further part that motion during the contact may explain: a warning.
    leeway: f64,
}

/// Largest accepted distance of a residual from zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    /// The total bound.
    pub(super) total: f64,
    /// The part from resolutions or tolerance, without rounding.
    implied: f64,
}

impl<const N: usize> Residual<N> {
    pub(super) fn new(value: Uncertain<N>, scale: f64) -> Self {
        Residual { value, scale, slack: 0.0, leeway: 0.0 }
    }

    /// Allows for the rounding of a size that the record does not tell: what a number is computed from may be larger than all that is known.
    pub(super) fn beside(mut self, size: f64) -> Self {
        self.value.size = self.value.size.max(size);
        self
    }

    /// Accepts a part that the record leaves open, and only warns of a further part that motion during the contact may explain.
    pub(super) fn open(self, slack: f64, leeway: f64) -> Self {
        Residual { slack, leeway, ..self }
    }

    /// Converts the residual to another unit.
    pub(super) fn per(self, divisor: f64) -> Self {
        let unit = divisor.abs();
        Residual { value: self.value.scaled(1.0 / divisor), scale: self.scale / unit, slack: self.slack / unit, leeway: self.leeway / unit }
    }
}

impl Judge {
    pub(super) fn new(profile: Profile, options: &Options) -> Self {
        Judge {
            profile,
            tolerance: options.tolerance,
            amplification: 0.0,
            leniency: 1.0,
            checked: Rules::default(),
            findings: Vec::new(),
            common: Vec::new(),
        }
    }

    /// Allows for the rounding of the impulse of a pair that nearly wedges, with K_nn + μ K_nt a positive share of its parts.
    pub(super) fn allow_for_wedging(&mut self, share: f64) {
        if share > 0.0 {
            self.amplification = 1.0 / share;
        }
    }

    /// Returns a judge of the same record without findings.
    pub(super) fn afresh(&self) -> Self {
        Judge { checked: Rules::default(), findings: Vec::new(), common: Vec::new(), ..*self }
    }

    /// Takes the failures of a judge of a part of the record. Numbers that are too large or too small for the part are not for all of it.
    pub(super) fn take_failures(&mut self, of_part: Judge) {
        let is_failure = |found: &Finding| found.severity == Severity::Fail && found.rule != Rule::Finite;
        of_part.findings.into_iter().filter(is_failure).for_each(|found| {
            self.checks(found.rule);
            self.findings.push(found);
        });
    }

    /// Returns a judge of motions that follow from the record.
    pub(super) fn of_implied(&self) -> Self {
        /// Errors within the tolerance add up, and a division by the smaller of two masses may enlarge them.
        const LENIENCY: f64 = 10.0;
        Judge { leniency: LENIENCY, ..self.afresh() }
    }

    /// Takes the failures of a judge of motions that follow from a part of the record, and that what is reported was held against.
    pub(super) fn take_failures_of_implied(&mut self, mut of_implied: Judge, source: &str) {
        for found in &mut of_implied.findings {
            found.what = format!("with what follows from {source}, {}", found.what);
        }
        if of_implied.checked.contains(Rule::Reported) {
            self.checks(Rule::Reported);
        }
        self.take_failures(of_implied);
    }

    pub(super) fn done(self, record: &Record) -> Outcome {
        let coverage = Coverage::of(record);
        Outcome { id: record.id.clone(), findings: self.findings, checked: self.checked, coverage, common: self.common }
    }

    pub(super) fn has_failed(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Fail)
    }

    /// Marks a rule as checked, whatever the result.
    pub(super) fn checks(&mut self, rule: Rule) {
        self.checked.insert(rule);
    }

    pub(super) fn push(&mut self, rule: Rule, severity: Severity, size: f64, bound: f64, what: String) {
        self.checks(rule);
        self.findings.push(Finding { rule, severity, size, bound, what });
    }

    pub(super) fn fail(&mut self, rule: Rule, size: f64, bound: f64, what: String) {
        self.push(rule, Severity::Fail, size, bound, what);
    }

    pub(super) fn warn(&mut self, rule: Rule, size: f64, bound: f64, what: String) {
        self.push(rule, Severity::Warn, size, bound, what);
    }

    /// Returns the bound from the resolutions, or from the tolerance if there are none, plus rounding.
    pub(super) fn bound<const N: usize>(&self, rule: Rule, residual: &Residual<N>) -> Bound {
        let of_profile = if rule == Rule::LinearMomentum { self.profile.linear_tolerance() } else { self.profile.tolerance() };
        let spread = if self.profile == Profile::Measured { residual.value.three_sigma() } else { residual.value.radius() };
        // NaN if an unknown quantity was multiplied by zero.
        let implied = match spread {
            0.0 => self.leniency * self.tolerance.unwrap_or(of_profile) * residual.scale,
            spread if spread.is_finite() => spread,
            _ => f64::INFINITY,
        };
        Bound { total: implied + self.profile.rounding() * residual.value.size, implied }
    }

    /// Returns the rounding of an impulse, of a size, that was solved for. Momentum holds for any impulse.
    fn rounding_of_impulse(&self, rule: Rule, size: f64) -> f64 {
        let holds_for_any = matches!(rule, Rule::LinearMomentum | Rule::AngularMomentum | Rule::LineOfAction);
        if holds_for_any || self.amplification == 0.0 { 0.0 } else { self.profile.rounding() * self.amplification * size }
    }

    /// Checks a residual that must be zero.
    pub(super) fn zero<const N: usize>(&mut self, rule: Rule, residual: Residual<N>, what: impl FnOnce(f64, f64) -> String) {
        self.hold(rule, residual, residual.value.value.abs(), what);
    }

    /// Checks a quantity that must not be above zero.
    pub(super) fn not_above<const N: usize>(&mut self, rule: Rule, residual: Residual<N>, what: impl FnOnce(f64, f64) -> String) {
        self.hold(rule, residual, residual.value.value, what);
    }

    /// Checks residuals that must all be zero and belong together, such as the components of a vector: only the one farthest beyond its bound is reported.
    pub(super) fn all_zero<const N: usize, const M: usize>(
        &mut self,
        rule: Rule,
        residuals: [Residual<N>; M],
        what: impl FnOnce(usize, f64, f64) -> String,
    ) {
        let worst = (0..M).max_by(|&a, &b| self.excess(rule, &residuals[a]).total_cmp(&self.excess(rule, &residuals[b])));
        if let Some(worst) = worst {
            self.zero(rule, residuals[worst], |size, bound| what(worst, size, bound));
        }
    }

    /// Returns the distance of a residual from zero as a share of its bound. 0/0 counts as zero; any other NaN must be reported.
    pub(super) fn excess<const N: usize>(&self, rule: Rule, residual: &Residual<N>) -> f64 {
        let size = residual.value.value.abs();
        if size == 0.0 { 0.0 } else { size / self.bound(rule, residual).total }
    }

    fn hold<const N: usize>(&mut self, rule: Rule, residual: Residual<N>, size: f64, what: impl FnOnce(f64, f64) -> String) {
        self.checks(rule);
        let mut bound = self.bound(rule, &residual);
        bound.total += residual.slack + self.rounding_of_impulse(rule, residual.scale);
        // An infinite bound would hold for anything; one of the resolutions says that nothing is known.
        let overflows = !residual.scale.is_finite() || (bound.implied.is_finite() && !bound.total.is_finite());
        if !size.is_finite() || overflows {
            self.push(
                Rule::Finite,
                Severity::Fail,
                size,
                bound.total,
                format!("the numbers are so large or so small that {rule} cannot be computed"),
            );
        } else if size > bound.total && size <= bound.total + residual.leeway {
            let explained = if residual.leeway.is_finite() { format!("{} of it", Digits(residual.leeway)) } else { String::from("it") };
            let reason = format!(
                "the bodies move during the contact, which may explain {explained}: add the centers of mass and the contact point after it"
            );
            self.warn(rule, size, bound.total, format!("{}; {reason}", what(size, bound.total)));
        } else if size > bound.total {
            self.push(rule, Severity::Fail, size, bound.total, what(size, bound.total));
        } else if size >= -bound.total && bound.implied > residual.scale {
            // Below −bound the upper limit holds with certainty.
            self.undecidable(rule, size.max(0.0), bound.total, residual.scale);
        }
    }

    /// Returns the sign of a quantity if it is beyond its bound to either side, otherwise `None`.
    pub(super) fn sign<const N: usize>(&self, rule: Rule, residual: &Residual<N>) -> Option<f64> {
        let value = residual.value.value;
        (value.abs() > self.bound(rule, residual).total).then(|| value.signum())
    }

    /// Reports once that the numbers are too coarse for a rule.
    pub(super) fn undecidable(&mut self, rule: Rule, size: f64, bound: f64, scale: f64) {
        if self.findings.iter().any(|finding| finding.rule == rule && finding.severity == Severity::Undecidable) {
            return;
        }
        let (bound_in_words, scale) = (Digits(bound), Digits(scale));
        let what = format!("the resolutions leave room for {bound_in_words}, and the quantity itself is no larger than {scale}");
        self.push(rule, Severity::Undecidable, size, bound, what);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(profile: Profile, tolerance: Option<f64>, rule: Rule, resolution: f64) -> f64 {
        // 1000 − 999, either with the resolution.
        let value = Uncertain::<2>::input(1000.0, 0, resolution) - Uncertain::input(999.0, 1, resolution);
        Judge::new(profile, &Options { tolerance }).bound(rule, &Residual::new(value, 100.0)).total
    }

    #[test]
    fn a_residual_in_another_unit_is_the_same_residual() {
        let value = Uncertain::<1>::input(8.0, 0, 2.0);
        let turned = Residual::new(value, 16.0).open(4.0, 12.0).per(-4.0);
        assert_eq!((turned.value.value, turned.value.size, turned.value.radius()), (-2.0, 2.0, 0.5));
        assert_eq!((turned.scale, turned.slack, turned.leeway), (4.0, 1.0, 3.0));
    }

    #[test]
    fn rounding_grows_as_the_share_that_wedging_leaves_shrinks() {
        let amplified = |share| {
            let mut judge = Judge::new(Profile::Impulse, &Options { tolerance: None });
            judge.allow_for_wedging(share);
            judge.amplification
        };
        assert_eq!([1.0, 0.25, 0.75, 0.0, -0.5, f64::NAN].map(amplified), [1.0, 4.0, 1.0 / 0.75, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn resolutions_decide_or_else_the_profile() {
        let rule = Rule::Restitution;
        let rounding = 64.0 * f64::EPSILON * 1999.0;
        for (profile, tolerance, rule, resolution, implied) in [
            (Profile::Impulse, None, rule, 0.0, 1e-7),
            (Profile::Impulse, None, rule, 0.25, 0.5),
            (Profile::Printed, None, rule, 0.25, 0.5),
            (Profile::Stepper, None, rule, 0.0, 2.0),
            (Profile::Stepper, None, Rule::LinearMomentum, 0.0, 1e-4),
            (Profile::Stepper, Some(0.01), Rule::LinearMomentum, 0.0, 1.0),
            (Profile::Stepper, Some(0.01), rule, 0.25, 0.5),
            (Profile::Measured, None, rule, 0.0, 5.0),
            (Profile::Measured, None, rule, 0.25, 0.75 * core::f64::consts::SQRT_2),
        ] {
            let found = bound(profile, tolerance, rule, resolution);
            assert!((found - implied - rounding).abs() < 1e-15, "{profile:?}, {rule}, {resolution}: {found}");
        }
        assert_eq!(bound(Profile::StepperF32, None, rule, 0.0), 2.0 + 1999.0 / 1_048_576.0);
    }

    #[test]
    fn what_is_coarser_than_itself_is_undecidable() {
        let verdict = |value: f64, resolution: f64, scale: f64| {
            let mut judge = Judge::new(Profile::Printed, &Options::default());
            let value = Uncertain::<1>::input(value, 0, resolution);
            judge.zero(Rule::Restitution, Residual::new(value, scale), |_, _| String::new());
            judge.done(&Record::default()).verdict()
        };
        use super::super::Verdict;
        assert_eq!(verdict(1.0, 2.0, 3.0), Verdict::Pass);
        assert_eq!(verdict(2.5, 2.0, 3.0), Verdict::Fail);
        assert_eq!(verdict(1.0, 4.0, 3.0), Verdict::Undecidable);
        assert_eq!(verdict(5.0, 4.0, 3.0), Verdict::Fail);
        assert_eq!(verdict(1.0, f64::INFINITY, 3.0), Verdict::Undecidable);
    }

    #[test]
    fn an_upper_limit_may_hold_for_certain() {
        let mut judge = Judge::new(Profile::Printed, &Options::default());
        let value = |value| Residual::new(Uncertain::<1>::input(value, 0, 4.0), 3.0);
        judge.not_above(Rule::EnergyGain, value(-5.0), |_, _| String::new());
        assert!(judge.findings.is_empty());
        judge.not_above(Rule::EnergyGain, value(-3.0), |_, _| String::new());
        assert_eq!(judge.findings[0].severity, Severity::Undecidable);
    }

    #[test]
    fn of_a_vector_the_worst_component_is_told() {
        let mut judge = Judge::new(Profile::Printed, &Options::default());
        let residuals = [(0.0, 0.0), (3.0, 2.0), (-2.0, 1.0)];
        let residuals = residuals.map(|(value, resolution)| Residual::new(Uncertain::<1>::input(value, 0, resolution), 9.0));
        judge.all_zero(Rule::LinearMomentum, residuals, |worst, _, _| format!("{worst}"));
        assert_eq!((judge.findings.len(), judge.findings[0].what.as_str(), judge.findings[0].size), (1, "2", 2.0));
    }
}
