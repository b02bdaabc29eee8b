//! The findings of a run, and whether they all hold.

use std::collections::HashSet;
use std::fmt;

use num_bigint::BigUint;
use num_traits::{One, Zero};

use crate::choice::Choice;
use crate::conclusion::Conclusion;
use crate::control::Control;
use crate::identity::Subject;
use crate::misprint::Misprint;
use crate::proof::{Proof, Verdict};

/// The probability that any identity of a run is false must be below 2 to the power of minus this.
pub const TOTAL_ERROR_BITS: u64 = 100;

/// Everything that a run found.
#[derive(Clone, Debug)]
pub struct Report {
    /// The seed from which all points were drawn.
    pub seed: u64,
    /// The identities, by subject.
    pub subjects: Vec<Proofs>,
    /// The conclusions from them.
    pub conclusions: Vec<Conclusion>,
    /// Choices tested at points instead of proven, because they compare numbers.
    pub choices: Vec<Choice>,
    /// The errors in print.
    pub misprints: Vec<Misprint>,
    /// The false identities that must not be proven.
    pub controls: Vec<Control>,
}

/// The proofs of one subject.
#[derive(Clone, Debug)]
pub struct Proofs {
    /// The subject.
    pub name: &'static str,
    /// The proofs.
    pub proofs: Vec<Proof>,
}

/// Reason why a report does not hold.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Problem {
    /// An identity is not proven.
    Identity(Proof),
    /// Two identities have the same name.
    Name(&'static str),
    /// A conclusion lacks a premise.
    Conclusion(&'static str),
    /// The code does not make the required choice.
    Choice(Choice),
    /// A misprint is not demonstrated.
    Misprint(&'static str),
    /// A false identity was not detected.
    Control(Control),
    /// The probabilities of error add up to more than allowed: 2 to the power of minus this.
    Error(u64),
    /// A part of the report is empty.
    Nothing,
}

impl Proofs {
    /// Evaluates the identities of a subject, each at the points of its stream.
    pub(crate) fn of(subject: Subject, seed: u64, streams: &[u64]) -> Self {
        let identities = subject.identities.into_iter().zip(streams);
        Proofs { name: subject.name, proofs: identities.map(|(identity, &stream)| Proof::of(identity, seed, stream)).collect() }
    }
}

impl Report {
    /// Returns every proof of every subject.
    pub fn proofs(&self) -> impl Iterator<Item = &Proof> {
        self.subjects.iter().flat_map(|subject| &subject.proofs)
    }

    /// Returns `true` if everything holds.
    pub fn holds(&self) -> bool {
        self.problems().is_empty()
    }

    /// Returns the reasons why it does not hold; empty if it does.
    pub fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        let mut names = HashSet::new();
        for proof in self.proofs() {
            if !names.insert(proof.identity.name) {
                problems.push(Problem::Name(proof.identity.name));
            }
            if !proof.holds() {
                problems.push(Problem::Identity(proof.clone()));
            }
        }
        problems
            .extend(self.conclusions.iter().filter(|conclusion| !conclusion.holds).map(|conclusion| Problem::Conclusion(conclusion.name)));
        problems.extend(self.choices.iter().filter(|choice| !choice.holds()).cloned().map(Problem::Choice));
        problems.extend(self.misprints.iter().filter(|misprint| !misprint.is_shown()).map(|misprint| Problem::Misprint(misprint.place)));
        problems.extend(self.controls.iter().filter(|control| !control.is_detected()).cloned().map(Problem::Control));
        if self.error_bits() <= TOTAL_ERROR_BITS {
            problems.push(Problem::Error(self.error_bits()));
        }
        let parts = [names.len(), self.conclusions.len(), self.choices.len(), self.misprints.len(), self.controls.len()];
        if parts.contains(&0) {
            problems.push(Problem::Nothing);
        }
        problems
    }

    /// Returns the exponent of the total error: the probability that any identity is false and passed is at most 2 to
    /// the power of minus this, the sum of their probabilities of error.
    pub fn error_bits(&self) -> u64 {
        let largest = self.proofs().map(|proof| proof.error_bits).max().unwrap_or(0);
        let sum: BigUint = self.proofs().map(|proof| BigUint::one() << (largest - proof.error_bits)).sum();
        // The sum is at most 2ᵏ, rounded up to a power of two.
        let rounded_up = if sum.is_zero() { 0 } else { (sum - 1_u8).bits() };
        largest.saturating_sub(rounded_up)
    }

    /// Returns the outcome in one line.
    pub fn summary(&self) -> String {
        let proven = self.proofs().filter(|proof| proof.holds()).count();
        let concluded = self.conclusions.iter().filter(|conclusion| conclusion.holds).count();
        let shown = self.misprints.iter().filter(|misprint| misprint.is_shown()).count();
        let told = self.controls.iter().filter(|control| control.is_detected()).count();
        let outcome = if self.holds() { "all of it holds" } else { "NOT all of it holds" };
        format!(
            "{proven} of {} identities proven, with an error of at most 2^-{} for all of them together; {concluded} of {} conclusions; {} choices tried; {shown} of {} misprints \
             shown; {told} of {} false identities told; {outcome}",
            self.proofs().count(),
            self.error_bits(),
            self.conclusions.len(),
            self.choices.len(),
            self.misprints.len(),
            self.controls.len(),
        )
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Identity(Proof { identity, verdict: Verdict::Holds, error_bits, .. }) => {
                write!(f, "\"{}\" is not proven: it holds, with an error of up to 2^-{error_bits}", identity.name)
            }
            Problem::Identity(proof) => write!(f, "\"{}\" is not proven: {}", proof.identity.name, proof.verdict),
            Problem::Name(name) => write!(f, "\"{name}\" is the name of two identities"),
            Problem::Conclusion(name) => write!(f, "\"{name}\" does not follow: a premise is not proven"),
            Problem::Choice(choice) => write!(f, "\"{}\" is not so: {}", choice.name, choice.verdict),
            Problem::Misprint(place) => write!(f, "{place} is listed as wrong, and its collision does not show it"),
            Problem::Control(control) => {
                write!(f, "the false identity \"{}\" was not told: {}", control.proof.identity.name, control.proof.verdict)
            }
            Problem::Error(bits) => write!(f, "the probability that one of the identities is false may be as high as 2^-{bits}"),
            Problem::Nothing => write!(f, "a part of the run is empty"),
        }
    }
}
