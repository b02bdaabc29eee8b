//! Issues of tests, records and fits.

use alloc::borrow::Cow;
use core::fmt;

use super::estimate::Estimate;
use crate::issue::{InputIssue, Issue, IssueCollector, Issues, Place};
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::Ordered;

/// Reason for refusing a test, a record or a fit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum TestIssue<T = f64> {
    /// A number or a list is invalid.
    Input(InputIssue<T>),
    /// Two lists that belong together differ in length.
    UnequalLengths {
        /// The list that differs.
        at: Place,
        /// The list that its length must match.
        like: &'static str,
    },
    /// Two channels are not sampled at the same instants.
    InstantsDiffer {
        /// The channel that differs from the first.
        at: Place,
    },
    /// No profile has these moments: the mean of the squares of its depths would be below the square of their mean.
    ImpossibleProfile {
        /// The profile.
        at: Place,
        /// The mean depth, in m.
        mean: T,
        /// The mean of the squares of the depths, in m².
        mean_square: T,
    },
    /// All tests have the same mean depth, so no line can be fitted through them.
    OneDepth {
        /// The mean depth of all, in m.
        depth: T,
    },
    /// Where the fit is best, d₀ and d₁ change E* of all tests alike: the profiles do not tell the two apart.
    Undetermined,
    /// The speed that is assumed to leave no crush is not below the speed that remains of the test after restitution.
    OnsetTooFast {
        /// The assumed onset speed b₀, in m/s.
        onset: T,
        /// The speed of the test, v √(1 − e²), in m/s.
        speed: T,
    },
    /// A record is sampled too slowly for its filter.
    SampledTooSlowly {
        /// The time between two samples, in s.
        step: T,
        /// The longest time that is accepted, in s.
        longest: T,
    },
    /// A record that must be sampled at equal intervals is not.
    NotUniform,
    /// Too few samples have a weight in a local line.
    SpanTooNarrow {
        /// Number of neighbors.
        neighbors: usize,
        /// The time of the local line, in s.
        time: T,
    },
    /// The force per width that is held leaves more crush energy than the tests have: (d₀ + d₁ C)² is at least 4 A C.
    ForceTooLarge {
        /// The force per width A, in N/m.
        force: T,
        /// The greatest one that the tests allow, in N/m.
        most: T,
    },
    /// The fit did not converge.
    NotConverged {
        /// Number of steps taken.
        steps: usize,
    },
}

/// Everything wrong with a test, a record or a fit; never empty.
pub type TestIssues<T = f64> = Issues<TestIssue<T>>;

/// The issues that are about one number, whose place is `at`.
macro_rules! placed {
    ($at:ident) => {
        TestIssue::Input(InputIssue { $at, .. })
            | TestIssue::UnequalLengths { $at, .. }
            | TestIssue::InstantsDiffer { $at }
            | TestIssue::ImpossibleProfile { $at, .. }
    };
}

impl<T> TestIssue<T> {
    /// Returns the number that the issue is about, if it is about one.
    pub fn place(&self) -> Option<&Place> {
        match self {
            placed!(at) => Some(at),
            _ => None,
        }
    }

    fn place_mut(&mut self) -> Option<&mut Place> {
        match self {
            placed!(at) => Some(at),
            _ => None,
        }
    }
}

impl<T> TestIssues<T> {
    /// Returns the same issues with the place of the test in a list: its series and its index in it, both counted from zero. A place that has an index
    /// already keeps it.
    ///
    /// ```
    /// use planar_impact::barrier::BarrierTest;
    /// use planar_impact::crush::ProfileMoments;
    /// let crush = ProfileMoments::of(1.5, &[0.3, 0.5]).unwrap();
    /// let issues = BarrierTest { mass: -1.0, speed: 15.6, restitution: 0.0, crush }.stiffness(2.0).unwrap_err();
    /// assert_eq!(issues.of_test(2, 0).to_string(), "mass[2][0] is -1 kg; it must be above zero");
    /// ```
    #[must_use]
    pub fn of_test(mut self, series: usize, index: usize) -> Self {
        for at in self.iter_mut().filter_map(TestIssue::place_mut) {
            at.series.get_or_insert(series);
            at.index.get_or_insert(index);
        }
        self
    }
}

impl<T> From<InputIssue<T>> for TestIssue<T> {
    fn from(issue: InputIssue<T>) -> Self {
        TestIssue::Input(issue)
    }
}

impl<T> From<InputIssue<T>> for TestIssues<T> {
    fn from(issue: InputIssue<T>) -> Self {
        TestIssue::Input(issue).into()
    }
}

/// Returns the result, or an error if its numbers were so large or so small that it is infinite or not a number.
pub(super) fn finite<T: Ordered<Mask = bool>>(at: Place, result: T) -> Result<T, TestIssues<T>> {
    let mut issues = IssueCollector::new();
    issues.finite(at, &result);
    issues.finish().map(|()| result)
}

/// Returns an estimate if its value and its variance are finite.
pub(super) fn finite_estimate<T: Ordered<Mask = bool>>(name: &'static str, estimate: Estimate<T>) -> Result<Estimate<T>, TestIssues<T>> {
    let mut issues = IssueCollector::new();
    issues.finite(Place::plain(name), &estimate.value);
    issues.finite(Place::plain(name).part("variance"), &estimate.variance);
    issues.finish().map(|()| estimate)
}

impl<T: Ordered<Mask = bool>> Issue for TestIssue<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        match self {
            TestIssue::Input(issue) => issue.code(),
            TestIssue::UnequalLengths { .. } => "unequal-lengths",
            TestIssue::InstantsDiffer { .. } => "instants-differ",
            TestIssue::ImpossibleProfile { .. } => "impossible-profile",
            TestIssue::OneDepth { .. } => "one-depth",
            TestIssue::Undetermined => "undetermined",
            TestIssue::OnsetTooFast { .. } => "onset-too-fast",
            TestIssue::SampledTooSlowly { .. } => "sampled-too-slowly",
            TestIssue::NotUniform => "not-uniform",
            TestIssue::SpanTooNarrow { .. } => "span-too-narrow",
            TestIssue::ForceTooLarge { .. } => "force-too-large",
            TestIssue::NotConverged { .. } => "not-converged",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        self.place().map(Place::path)
    }

    fn message(&self) -> Message<T> {
        let message = Message::new();
        match self {
            TestIssue::Input(issue) => issue.message(),
            TestIssue::UnequalLengths { like, .. } => message.text("it must be as long as ").text(*like),
            TestIssue::InstantsDiffer { .. } => "it must be sampled at the same instants as the first".into(),
            TestIssue::ImpossibleProfile { mean, mean_square, .. } => message
                .text("no profile has a mean depth of ")
                .figure(Measure::Length, mean.clone())
                .text(" and a mean square of ")
                .figure(Measure::Area, mean_square.clone())
                .text(", which is less than the square of the mean"),
            TestIssue::OneDepth { depth } => message
                .text("all tests have the mean depth ")
                .figure(Measure::Length, depth.clone())
                .text("; two different depths are needed"),
            TestIssue::Undetermined => {
                "d0 and d1 change E* of all tests alike where the fit is best, so that the profiles do not tell the two apart".into()
            }
            TestIssue::OnsetTooFast { onset, speed } => message
                .text("the onset speed is assumed to be ")
                .figure(Measure::Speed, onset.clone())
                .text(", but the test left crush at ")
                .figure(Measure::Speed, speed.clone()),
            TestIssue::SampledTooSlowly { step, longest } => message
                .text("the samples are ")
                .figure(Measure::Time, step.clone())
                .text(" apart; the filter needs them at most ")
                .figure(Measure::Time, longest.clone())
                .text(" apart"),
            TestIssue::NotUniform => "the record is not sampled at equal intervals, as the filter needs it".into(),
            TestIssue::SpanTooNarrow { neighbors, time } => message
                .text(alloc::format!("{neighbors} neighbors are too few for a line at "))
                .figure(Measure::Time, time.clone())
                .text(" and for its uncertainty"),
            TestIssue::ForceTooLarge { force, most } => message
                .text("the force per width A is held at ")
                .figure(Measure::ForcePerWidth, force.clone())
                .text("; the mean depth and crush energy of the tests allow at most ")
                .figure(Measure::ForcePerWidth, most.clone()),
            TestIssue::NotConverged { steps } => message.text(alloc::format!("the fit did not converge in {steps} steps")),
        }
    }

    fn help(&self) -> Option<Message<T>> {
        match self {
            TestIssue::Input(issue) => issue.help(),
            TestIssue::Undetermined => Some("add a test with another depth, or fit on mean depth".into()),
            TestIssue::NotConverged { .. } => Some("fit tests whose depths differ by more than they are known to".into()),
            _ => None,
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Display> fmt::Display for TestIssue<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.place()) {
            (TestIssue::Input(issue), _) => issue.fmt(f),
            (_, Some(at)) => write!(f, "{at}: {}", self.message()),
            _ => self.message().fmt(f),
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Debug + fmt::Display> core::error::Error for TestIssue<T> {}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn every_issue_has_its_name_place_and_number() {
        let mut issues = IssueCollector::<TestIssue>::new();
        issues.positive(Place::of("mass", Measure::Mass).in_series(1).at(2), &-3.0);
        issues.within(Place::plain("restitution"), &1.5, 0.0, Some(1.0));
        issues.finite(Place::of("time", Measure::Time).at(7), &f64::NAN);
        issues.all_finite(Place::plain("values"), &[0.0, f64::NAN, 1.0, f64::INFINITY]);
        let issues = issues.finish().expect_err("four issues");
        let texts: alloc::vec::Vec<_> = issues.iter().map(ToString::to_string).collect();
        assert_eq!(
            texts,
            [
                "mass[1][2] is -3 kg; it must be above zero",
                "restitution is 1.5; it must be from 0 to 1",
                "time[7] is not finite: NaN",
                "values[1] is not finite; it is the first of 2 such numbers"
            ]
        );
    }

    #[test]
    fn issues_that_other_tests_mend_say_which() {
        let help = |issue: TestIssue| issue.help().map(|help| help.to_string());
        assert_eq!(help(TestIssue::Undetermined).as_deref(), Some("add a test with another depth, or fit on mean depth"));
        let depths = "fit tests whose depths differ by more than they are known to";
        assert_eq!(help(TestIssue::NotConverged { steps: 9 }).as_deref(), Some(depths));
        assert_eq!(help(TestIssue::NotUniform), None);
    }
}
