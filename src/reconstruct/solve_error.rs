//! Reasons why a valid reconstruction problem has no answer.

use std::borrow::Cow;
use std::fmt;

use super::issue::ReconstructionIssues;
use super::variable::Variable;
use crate::issue::Issue;
use crate::measure::Measure;
use crate::message::Message;
use crate::refusal::Refusals;

/// State of the best search that did not converge.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Values of the unknowns.
    pub unknowns: Vec<(Variable, f64)>,
    /// Sum of the squares of the standardised residuals.
    pub chi_square: f64,
    /// The remaining step of the search, in m/s, rad/s and tenths of other quantities.
    pub step: f64,
    /// Number of steps.
    pub iterations: usize,
    /// Reason why it cannot continue: the refusals of the collision after the next step.
    pub beyond: Option<Refusals>,
}

/// Reason for the absence of an answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolveError {
    /// The problem is not well posed.
    Problems(ReconstructionIssues),
    /// The collision is refused at every start.
    NoStart {
        /// Number of starts.
        starts: usize,
        /// Refusals at the first start.
        refusals: Refusals,
    },
    /// No search converged; or none converged to a sum of squares as low as that of an unconverged search, and the evidence agrees with none.
    NotConverged {
        /// Number of searches.
        searches: usize,
        /// Number of searches that converged, to a larger sum of squares than that of the nearest.
        converged: usize,
        /// State of the best unconverged search.
        nearest: Stop,
    },
    /// The caller stopped the search.
    Stopped,
}

impl Issue for SolveError {
    type Number = f64;

    /// Returns the code of the first issue if the problem itself is not well posed.
    fn code(&self) -> &'static str {
        match self {
            SolveError::Problems(issues) => issues.first().code(),
            SolveError::NoStart { .. } => "no-start",
            SolveError::NotConverged { .. } => "not-converged",
            SolveError::Stopped => "stopped",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            SolveError::Problems(issues) => issues.first().path(),
            _ => Some("unknown".into()),
        }
    }

    fn message(&self) -> Message {
        match self {
            SolveError::Problems(issues) => Message::new().text(issues.to_string()),
            SolveError::NoStart { starts, refusals } => {
                Message::new().text(format!("the collision is refused at each of {starts} starts; at the first: {refusals}"))
            }
            SolveError::Stopped => Message::new().text("stopped before every search was made"),
            SolveError::NotConverged { searches, converged, nearest } => {
                let count = match converged {
                    0 => format!("none of {searches} searches converged"),
                    _ => format!("{converged} of {searches} searches converged, none as low as where another had to stop"),
                };
                let mut message = Message::new().text(format!("{count}; the nearest stopped after {} steps at ", nearest.iterations));
                for (of, value) in &nearest.unknowns {
                    message = message.text(format!("{} = ", of.name())).figure(of.measure(), *value).text(", ");
                }
                message = message.text("with chi-square ").figure(Measure::Ratio, nearest.chi_square);
                match &nearest.beyond {
                    Some(refusals) => message.text(format!(", because the collision that the evidence leads to is refused: {refusals}")),
                    None => message,
                }
            }
        }
    }
}

impl fmt::Display for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(f)
    }
}

impl std::error::Error for SolveError {}

impl From<ReconstructionIssues> for SolveError {
    fn from(issues: ReconstructionIssues) -> Self {
        SolveError::Problems(issues)
    }
}
