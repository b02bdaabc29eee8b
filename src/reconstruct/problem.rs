//! What is wrong with a question, and why one that is in order has no answer.

use std::fmt;

use super::given::{Reconstruction, Uncertainty, Unknown};
use super::measurable::Measurable;
use super::variable::Variable;
use super::weight;
use crate::input::{Input, Side};
use crate::refusal::Refusals;

/// One thing wrong with a question.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// Nothing is unknown.
    NothingUnknown,
    /// More is unknown than there is evidence of, the priors counted.
    TooLittleEvidence {
        /// What is unknown.
        unknowns: Vec<Variable>,
        /// How many pieces of evidence there are.
        evidence: usize,
    },
    /// The collision does not have what is unknown, as the speed of a barrier, or an impulse ratio where the ratio is the critical one.
    NotInCase(Variable),
    /// The collision does not have what there is evidence of.
    NothingToMeasure(Measurable),
    /// The same thing is unknown twice.
    UnknownTwice(Variable),
    /// There are two pieces of evidence of the same thing.
    EvidenceTwice(Measurable),
    /// A speed is unknown and a component of the same velocity too.
    SpeedAndVelocity(Side),
    /// A number of an unknown is infinite or not a number.
    UnknownNotFinite {
        /// Of what.
        of: Variable,
        /// Which number.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A number of a piece of evidence is infinite or not a number.
    EvidenceNotFinite {
        /// Of what.
        of: Measurable,
        /// Which number.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A standard deviation or a resolution that is not above zero.
    NotPositive {
        /// Of what.
        of: Measurable,
        /// What.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Evidence below zero of what cannot be, as a speed or a crush energy.
    BelowZero {
        /// Of what.
        of: Measurable,
        /// Its value.
        value: f64,
    },
    /// The lower bound is not below the upper one.
    BoundsCrossed {
        /// Of what.
        of: Variable,
        /// The lower bound.
        min: f64,
        /// The upper bound.
        max: f64,
    },
    /// The start is not between the bounds.
    StartOutside {
        /// Of what.
        of: Variable,
        /// The start.
        start: f64,
        /// The lower bound, its own or that of the mechanics.
        min: f64,
        /// The upper bound.
        max: f64,
    },
    /// A bound that the mechanics does not know, as a restitution above 1.
    BoundOutside {
        /// Of what.
        of: Variable,
        /// The bound.
        bound: f64,
        /// The least that the mechanics knows.
        least: f64,
        /// The most that it knows.
        most: f64,
    },
    /// Evidence of one vehicle's crush energy, without a word on how the two share it.
    ShareUnknown(Measurable),
    /// The known share of the crush energy is not between 0 and 1.
    NotAShare(f64),
    /// A correlation of what there is no evidence of, or of a thing with itself.
    CorrelationOfNothing(Measurable, Measurable),
    /// Correlations that no errors can have.
    CorrelationsImpossible {
        /// The least eigenvalue of their matrix, which must be above zero.
        eigenvalue: f64,
    },
}

/// Everything wrong with a question; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems(pub(super) Vec<Problem>);

/// Where the nearest search stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// The values of the unknowns there.
    pub unknowns: Vec<(Variable, f64)>,
    /// The sum of the squares of the standardised residuals there.
    pub chi_square: f64,
    /// What the search still wanted to change, in m/s, rad/s and tenths of the rest.
    pub step: f64,
    /// The steps it took.
    pub iterations: usize,
    /// Why it cannot go on: what the mechanics says of where it wants to go.
    pub beyond: Option<Refusals>,
}

/// Why a question has no answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unsolved {
    /// It cannot be asked.
    Problems(Problems),
    /// The collision is refused at every start.
    NoStart {
        /// How many starts there were.
        starts: usize,
        /// Why it is refused at the first.
        refusals: Refusals,
    },
    /// No search reached a least sum of squares; or none reached one as low as where another had to stop, and none that the evidence agrees with.
    NotConverged {
        /// How many searches there were.
        searches: usize,
        /// How many of them reached a least sum of squares, higher than where the nearest stopped.
        converged: usize,
        /// Where the best of them stopped.
        nearest: Stop,
    },
}

impl Problems {
    /// The problems, in the order of the question.
    pub fn list(&self) -> &[Problem] {
        &self.0
    }
}

/// Everything wrong with a question.
pub(super) fn check(question: &Reconstruction) -> Result<(), Problems> {
    let mut found = Vec::new();
    unknowns(question, &mut found);
    evidence(question, &mut found);
    correlations(question, &mut found);
    if question.unknowns.is_empty() {
        found.push(Problem::NothingUnknown);
    }
    let evidence = question.all_evidence().len();
    if question.unknowns.len() > evidence {
        found.push(Problem::TooLittleEvidence { unknowns: question.unknowns.iter().map(|unknown| unknown.of).collect(), evidence });
    }
    if found.is_empty() { Ok(()) } else { Err(Problems(found)) }
}

fn unknowns(question: &Reconstruction, found: &mut Vec<Problem>) {
    for (i, unknown) in question.unknowns.iter().enumerate() {
        let of = unknown.of;
        if question.unknowns[..i].iter().any(|other| other.of == of) {
            found.push(Problem::UnknownTwice(of));
        }
        if !of.is_in(&question.collision) {
            found.push(Problem::NotInCase(of));
        }
        if let Variable::Speed(side) = of
            && question.unknowns.iter().any(|other| is_component(other.of, side))
        {
            found.push(Problem::SpeedAndVelocity(side));
        }
        numbers(question, unknown, found);
    }
    if let Some(share) = question.crush_share
        && !(0.0..=1.0).contains(&share)
    {
        found.push(Problem::NotAShare(share));
    }
}

fn is_component(variable: Variable, of: Side) -> bool {
    matches!(variable, Variable::Input(Input::VelocityX(side) | Input::VelocityY(side)) if side == of)
}

fn numbers(question: &Reconstruction, unknown: &Unknown, found: &mut Vec<Problem>) {
    let of = unknown.of;
    let before = found.len();
    for (what, value) in [("start", Some(unknown.start)), ("min", unknown.min), ("max", unknown.max), ("sd", unknown.prior)] {
        if let Some(value) = value.filter(|value| !value.is_finite()) {
            found.push(Problem::UnknownNotFinite { of, what, value });
        }
    }
    if let Some(value) = unknown.prior.filter(|sd| sd.is_finite() && *sd <= 0.0) {
        found.push(Problem::NotPositive { of: Measurable::Variable(of), what: "standard deviation", value });
    }
    if found.len() > before {
        return;
    }
    let (least, most) = of.domain(&question.collision);
    for bound in [unknown.min, unknown.max].into_iter().flatten() {
        if !(least..=most).contains(&bound) {
            found.push(Problem::BoundOutside { of, bound, least, most });
        }
    }
    if let (Some(min), Some(max)) = (unknown.min, unknown.max)
        && min >= max
    {
        found.push(Problem::BoundsCrossed { of, min, max });
        return;
    }
    let (min, max) = (unknown.min.unwrap_or(least), unknown.max.unwrap_or(most));
    if !(min..=max).contains(&unknown.start) {
        found.push(Problem::StartOutside { of, start: unknown.start, min, max });
    }
}

fn evidence(question: &Reconstruction, found: &mut Vec<Problem>) {
    for (i, evidence) in question.evidence.iter().enumerate() {
        let of = evidence.of;
        if question.evidence[..i].iter().any(|other| other.of == of) {
            found.push(Problem::EvidenceTwice(of));
        }
        if !of.is_in(&question.collision) {
            found.push(Problem::NothingToMeasure(of));
        }
        let share_is_unknown = question.unknowns.iter().any(|unknown| unknown.of == Variable::CrushShare);
        if of.needs_share(&question.collision) && question.crush_share.is_none() && !share_is_unknown {
            found.push(Problem::ShareUnknown(of));
        }
        let (what, size) = match evidence.uncertainty {
            Uncertainty::StandardDeviation(sd) => ("standard deviation", Some(sd)),
            Uncertainty::Resolution(step) => ("resolution", Some(step)),
            Uncertainty::Exact => ("", None),
        };
        for (what, value) in [("value", Some(evidence.value)), (what, size)] {
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                found.push(Problem::EvidenceNotFinite { of, what, value });
            }
        }
        if of.is_magnitude() && evidence.value < 0.0 && evidence.value.is_finite() {
            found.push(Problem::BelowZero { of, value: evidence.value });
        }
        if let Some(value) = size.filter(|size| size.is_finite() && *size <= 0.0) {
            found.push(Problem::NotPositive { of, what, value });
        }
    }
}

fn correlations(question: &Reconstruction, found: &mut Vec<Problem>) {
    let before = found.len();
    let known = |of: Measurable| question.evidence.iter().any(|evidence| evidence.of == of);
    for correlation in &question.correlations {
        let (one, other) = (correlation.one, correlation.other);
        if one == other || !known(one) || !known(other) {
            found.push(Problem::CorrelationOfNothing(one, other));
        }
    }
    if found.len() == before && !question.correlations.is_empty() {
        let eigenvalue = weight::least_eigenvalue(question);
        if eigenvalue.is_nan() || eigenvalue <= weight::SINGULAR {
            found.push(Problem::CorrelationsImpossible { eigenvalue });
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use Problem::*;
        match self {
            NothingUnknown => f.write_str("nothing is unknown"),
            TooLittleEvidence { unknowns, evidence } => {
                let names: Vec<&str> = unknowns.iter().map(|of| of.name()).collect();
                let pieces = if *evidence == 1 { "piece" } else { "pieces" };
                write!(f, "{} numbers are unknown ({}), and there are {evidence} {pieces} of evidence", names.len(), names.join(", "))
            }
            NotInCase(of) => write!(f, "the collision has no {}", of.name()),
            NothingToMeasure(of) => write!(f, "the collision has no {}", of.name()),
            UnknownTwice(of) => write!(f, "{} is unknown twice", of.name()),
            EvidenceTwice(of) => write!(f, "there is evidence of {} twice", of.name()),
            SpeedAndVelocity(side) => {
                write!(f, "the speed of vehicle {} is unknown, and a component of its velocity too", *side as usize + 1)
            }
            UnknownNotFinite { of, what, value } => write!(f, "the {what} of {} is {value}; a finite number is expected", of.name()),
            EvidenceNotFinite { of, what, value } => write!(f, "the {what} of {} is {value}; a finite number is expected", of.name()),
            NotPositive { of, what, value } => write!(f, "the {what} of {} is {value}; it must be above zero", of.name()),
            BelowZero { of, value } => write!(f, "{} is {value}; it cannot be below zero", of.name()),
            BoundsCrossed { of, min, max } => write!(f, "{}: min {min} is not below max {max}", of.name()),
            StartOutside { of, start, min, max } => write!(f, "{}: the start {start} is not between {min} and {max}", of.name()),
            BoundOutside { of, bound, least, most } => write!(f, "{}: a bound of {bound} is not between {least} and {most}", of.name()),
            ShareUnknown(of) => {
                write!(f, "{} is a share of the crush energy, and nothing says how the vehicles share it: contact.crush_share", of.name())
            }
            NotAShare(share) => write!(f, "contact.crush_share is {share}; it must lie between 0 and 1"),
            CorrelationOfNothing(one, other) => {
                write!(f, "a correlation of {} with {} needs evidence of two different things", one.name(), other.name())
            }
            CorrelationsImpossible { eigenvalue } => {
                write!(
                    f,
                    "the correlations of the evidence contradict each other: the least eigenvalue of their matrix is {eigenvalue:.3e}"
                )
            }
        }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Unsolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unsolved::Problems(problems) => problems.fmt(f),
            Unsolved::NoStart { starts, refusals } => {
                write!(f, "the collision is refused at each of {starts} starts; at the first, {refusals}")
            }
            Unsolved::NotConverged { searches, converged, nearest } => {
                match converged {
                    0 => write!(f, "none of {searches} searches converged; ")?,
                    _ => write!(f, "{converged} of {searches} searches converged, none as low as where another had to stop; ")?,
                }
                write!(f, "the nearest stopped after {} steps at ", nearest.iterations)?;
                for (of, value) in &nearest.unknowns {
                    write!(f, "{} = {value}, ", of.name())?;
                }
                write!(f, "with chi-square {}", nearest.chi_square)?;
                match &nearest.beyond {
                    Some(refusals) => write!(f, ", because where the evidence leads is impossible: {refusals}"),
                    None => Ok(()),
                }
            }
        }
    }
}

impl std::error::Error for Problem {}
impl std::error::Error for Problems {}
impl std::error::Error for Unsolved {}

impl From<Problems> for Unsolved {
    fn from(problems: Problems) -> Self {
        Unsolved::Problems(problems)
    }
}
