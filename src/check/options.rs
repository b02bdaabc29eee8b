//! Options of a check.

use crate::issue::{InputIssue, IssueCollector, Issues, Place};

/// Options of a check.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options {
    /// Tolerance that replaces that of the profile, as a share of a residual with arbitrary errors: above zero, at most [`Options::LARGEST_TOLERANCE`].
    pub tolerance: Option<f64>,
}

impl Options {
    /// Largest accepted tolerance. A larger one accepts errors of the size of the quantity itself.
    pub const LARGEST_TOLERANCE: f64 = 0.5;

    /// Validates the options. [`check`](super::check) reports the same issue under the rule `finite`, and checks nothing else.
    ///
    /// ```
    /// use planar_impact::check::Options;
    /// assert!(Options { tolerance: Some(1e-6) }.validate().is_ok());
    /// let issues = Options { tolerance: Some(1e3) }.validate().unwrap_err();
    /// assert_eq!(issues.to_string(), "tolerance is 1000; it must be from 0 to 0.5");
    /// ```
    ///
    /// # Errors
    ///
    /// If the tolerance is not finite, not above zero, or above [`Options::LARGEST_TOLERANCE`].
    pub fn validate(&self) -> Result<(), Issues<InputIssue>> {
        let mut issues = IssueCollector::<InputIssue>::new();
        if let Some(tolerance) = &self.tolerance {
            let at = Place::plain("tolerance");
            if issues.positive(at, tolerance) {
                issues.within(at, tolerance, 0.0, Some(Self::LARGEST_TOLERANCE));
            }
        }
        issues.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Record, Rule, State, Subject, Verdict, check};
    use super::*;
    use crate::frame::Xy;
    use crate::issue::Issue;

    /// 85 000 N s appear: 1000 kg gain 85 m/s, and the other body nothing.
    fn creates_momentum() -> Record {
        let body = |after: f64| Subject {
            mass: Some(1000.0),
            before: State { velocity: Some(Xy { x: 0.0, y: 0.0 }), yaw_rate: None },
            after: State { velocity: Some(Xy { x: after, y: 0.0 }), yaw_rate: None },
            ..Subject::default()
        };
        Record { one: body(85.0), two: body(0.0), ..Record::default() }
    }

    #[test]
    fn no_tolerance_hides_created_momentum() {
        for (tolerance, code) in [
            (f64::NAN, "not-finite"),
            (f64::INFINITY, "not-finite"),
            (0.0, "not-positive"),
            (-1.0, "not-positive"),
            (1e3, "out-of-range"),
            (0.500_001, "out-of-range"),
        ] {
            let options = Options { tolerance: Some(tolerance) };
            let issues = options.validate().expect_err("it is refused");
            assert_eq!((issues.first().code(), issues.first().path().as_deref()), (code, Some("tolerance")));
            let outcome = check(&creates_momentum(), &options);
            assert_eq!(
                (outcome.verdict(), outcome.findings.len(), outcome.findings[0].rule),
                (Verdict::Fail, 1, Rule::Finite),
                "{outcome}"
            );
            assert_eq!(outcome.findings[0].what, issues.to_string());
        }
        for tolerance in [1e-300, 1e-9, 0.5] {
            let outcome = check(&creates_momentum(), &Options { tolerance: Some(tolerance) });
            assert!(outcome.of(Rule::LinearMomentum).next().is_some(), "{outcome}");
        }
    }
}
