//! Issues of a reconstruction problem.

use std::borrow::Cow;
use std::fmt;

use super::measurand::Measurand;
use super::variable::Variable;
use crate::input::Side;
use crate::issue::{InputIssue, Issue, Issues};
use crate::measure::Measure;
use crate::message::Message;

/// One issue of a reconstruction problem.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReconstructionIssue {
    /// A number of an unknown is invalid: its start, a bound, its standard deviation, or the share of the crush energy.
    Unknown {
        /// The unknown.
        of: Variable,
        /// The issue of the number.
        issue: InputIssue,
    },
    /// A number of a piece of evidence is invalid: its value, its standard deviation or its resolution.
    Evidence {
        /// The measurand.
        of: Measurand,
        /// The issue of the number.
        issue: InputIssue,
    },
    /// Nothing is unknown.
    NothingUnknown,
    /// There are more unknowns without two bounds than pieces of evidence, priors included; or unknowns alone.
    TooLittleEvidence {
        /// Those unknowns.
        unknowns: Vec<Variable>,
        /// Number of pieces of evidence.
        evidence: usize,
    },
    /// The collision does not have the unknown, such as the speed of a barrier, or an impulse ratio if the ratio is the critical one.
    NotInCase(Variable),
    /// The collision does not have the measurand of a piece of evidence.
    NothingToMeasure(Measurand),
    /// The same unknown is given twice.
    UnknownTwice(Variable),
    /// There are two pieces of evidence of the same quantity.
    EvidenceTwice(Measurand),
    /// A speed and a component of the same velocity are both unknown.
    SpeedAndVelocity(Side),
    /// The lower bound is not below the upper one.
    BoundsCrossed {
        /// The unknown.
        of: Variable,
        /// The lower bound.
        min: f64,
        /// The upper bound.
        max: f64,
    },
    /// The start is not between the bounds.
    StartOutside {
        /// The unknown.
        of: Variable,
        /// The start.
        start: f64,
        /// The lower bound, its own or that of the mechanics.
        min: f64,
        /// The upper bound.
        max: f64,
    },
    /// A bound outside the range of the mechanics, such as a restitution above 1.
    BoundOutside {
        /// The unknown.
        of: Variable,
        /// The bound.
        bound: f64,
        /// The least value that the mechanics accepts.
        least: f64,
        /// The greatest value that the mechanics accepts.
        most: f64,
    },
    /// A shape of prior knowledge whose standard deviation is not given.
    ShapeWithoutPrior(Variable),
    /// Evidence of one vehicle's crush energy, without the share of each vehicle.
    ShareUnknown(Measurand),
    /// A correlation without evidence or priors of both quantities, or of a quantity with itself.
    CorrelationOfNothing(Measurand, Measurand),
    /// The correlation matrix is not positive definite.
    CorrelationsImpossible {
        /// The least eigenvalue of their matrix, which must be above zero.
        eigenvalue: f64,
    },
}

/// All issues of a reconstruction problem; never empty.
pub type ReconstructionIssues = Issues<ReconstructionIssue>;

impl Issue for ReconstructionIssue {
    type Number = f64;

    fn code(&self) -> &'static str {
        use ReconstructionIssue::*;
        match self {
            Unknown { issue, .. } | Evidence { issue, .. } => issue.code(),
            NothingUnknown => "nothing-unknown",
            TooLittleEvidence { .. } => "too-little-evidence",
            NotInCase(_) | NothingToMeasure(_) => "not-in-case",
            UnknownTwice(_) | EvidenceTwice(_) => "repeated",
            SpeedAndVelocity(_) => "speed-and-velocity",
            BoundsCrossed { .. } => "bounds-crossed",
            StartOutside { .. } | BoundOutside { .. } => "out-of-range",
            ShareUnknown(_) => "share-unknown",
            ShapeWithoutPrior(_) => "shape-without-prior",
            CorrelationOfNothing(..) => "correlation-without-evidence",
            CorrelationsImpossible { .. } => "impossible-correlations",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        use ReconstructionIssue::*;
        match self {
            Unknown { issue, .. } | Evidence { issue, .. } => issue.path(),
            NotInCase(of)
            | UnknownTwice(of)
            | ShapeWithoutPrior(of)
            | BoundsCrossed { of, .. }
            | StartOutside { of, .. }
            | BoundOutside { of, .. } => Some(of.name().into()),
            SpeedAndVelocity(side) => Some(Variable::Speed(*side).name().into()),
            NothingToMeasure(of) | EvidenceTwice(of) | ShareUnknown(of) | CorrelationOfNothing(of, _) => Some(of.name().into()),
            NothingUnknown | TooLittleEvidence { .. } | CorrelationsImpossible { .. } => None,
        }
    }

    fn message(&self) -> Message {
        use ReconstructionIssue::*;
        let message = Message::new();
        match self {
            Unknown { issue, .. } | Evidence { issue, .. } => issue.message(),
            NothingUnknown => "nothing is unknown".into(),
            TooLittleEvidence { unknowns, evidence } => {
                let names: Vec<&str> = unknowns.iter().map(|of| of.name()).collect();
                let pieces = if *evidence == 1 { "is 1 piece".to_owned() } else { format!("are {evidence} pieces") };
                let numbers = if names.len() == 1 { "1 number is".to_owned() } else { format!("{} numbers are", names.len()) };
                message.text(format!("{numbers} unknown ({}), and there {pieces} of evidence", names.join(", ")))
            }
            NotInCase(_) | NothingToMeasure(_) => "the collision does not have it".into(),
            UnknownTwice(_) => "it is unknown twice".into(),
            EvidenceTwice(_) => "there is evidence of it twice".into(),
            SpeedAndVelocity(_) => "a component of the same velocity is unknown too".into(),
            BoundsCrossed { of, min, max } => {
                message.text("min ").figure(of.measure(), *min).text(" is not below max ").figure(of.measure(), *max)
            }
            StartOutside { of, start, min, max } => {
                within(message.text("its start is ").figure(of.measure(), *start), of.measure(), *min, *max)
            }
            BoundOutside { of, bound, least, most } => {
                within(message.text("a bound is ").figure(of.measure(), *bound), of.measure(), *least, *most)
            }
            ShareUnknown(_) => "it is a share of the crush energy, and the share of each vehicle is not given".into(),
            ShapeWithoutPrior(_) => "its prior has a shape and no standard deviation".into(),
            CorrelationOfNothing(_, other) => {
                message.text(format!("its correlation with {} needs evidence or priors of two different quantities", other.name()))
            }
            CorrelationsImpossible { eigenvalue } => message
                .text("the correlations of the evidence contradict each other: the least eigenvalue of their matrix is ")
                .figure(Measure::Ratio, *eigenvalue),
        }
    }

    fn help(&self) -> Option<Message> {
        use ReconstructionIssue::*;
        Some(match self {
            Unknown { issue, .. } | Evidence { issue, .. } => return issue.help(),
            TooLittleEvidence { .. } => {
                "add evidence, take an unknown as known, or give it min and max, or a standard deviation, which counts as evidence".into()
            }
            ShapeWithoutPrior(_) => "give that of the shape, with which the search takes a normal prior".into(),
            EvidenceTwice(_) => "combine them to one value with one standard deviation".into(),
            ShareUnknown(_) => "give the crush energy of both vehicles, or contact.crush_share, the share of vehicle 1".into(),
            _ => return None,
        })
    }
}

/// Completes a sentence about a number with its range, whose ends may be infinite.
fn within(sentence: Message, measure: Measure, least: f64, most: f64) -> Message {
    match (least.is_finite(), most.is_finite()) {
        // The smallest positive mass is not a number to print.
        (true, false) if least == f64::MIN_POSITIVE => sentence.text("; it must be above zero"),
        (true, false) => sentence.text("; it must be at least ").figure(measure, least),
        (false, _) => sentence.text("; it must be at most ").figure(measure, most),
        (true, true) => sentence.text("; it must be from ").figure(measure, least).text(" to ").figure(measure, most),
    }
}

impl fmt::Display for ReconstructionIssue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.path()) {
            (ReconstructionIssue::Unknown { issue, .. } | ReconstructionIssue::Evidence { issue, .. }, _) => issue.fmt(f),
            (_, Some(path)) => write!(f, "{path}: {}", self.message()),
            _ => self.message().fmt(f),
        }
    }
}

impl std::error::Error for ReconstructionIssue {}
