//! The verb `prove`: every identity with the way it was established, and what is wrong in print.

use planar_impact_proofs::scalar::PRIMES;
use planar_impact_proofs::{Conclusion, FRACTIONS, Misprint, Proof, Proofs, Report};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::answer::SCHEMA;
use crate::control::Control;
use crate::issue::Issues;

/// The answer of `prove`. Its JSON has a line for each identity, conclusion, choice, control and misprint.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct ProofReport {
    /// The report of the proofs.
    #[serde(serialize_with = "serialize")]
    #[schemars(with = "Document<'static>")]
    pub report: Report,
}

/// Proves the identities of the mechanics.
///
/// # Errors
///
/// An issue if the caller stops it.
pub fn prove(_: &(), control: &dyn Control) -> Result<ProofReport, Issues> {
    control.proceed(0, 1)?;
    Ok(ProofReport { report: planar_impact_proofs::run() })
}

fn serialize<S: Serializer>(report: &Report, serializer: S) -> Result<S::Ok, S::Error> {
    Document::of(report).serialize(serializer)
}

/// The JSON document of `prove`.
#[derive(Serialize, JsonSchema)]
#[schemars(inline)]
struct Document<'a> {
    /// The version of this document.
    schema: u32,
    /// `true` if every identity, conclusion, choice, control and misprint comes out as expected.
    holds: bool,
    /// The seed that all points are drawn from.
    seed: u64,
    /// As text: a program that reads numbers as doubles would round them.
    primes: [String; PRIMES.len()],
    /// Number of points in exact fractions at which each identity is evaluated.
    fractions: u64,
    /// The identities, each with its proof.
    identities: Vec<IdentityEntry<'a>>,
    /// Conclusions from the identities.
    conclusions: Vec<ConclusionEntry<'a>>,
    /// Statements that compare numbers; they are tried at points, not proven.
    choices: Vec<ChoiceEntry<'a>>,
    /// False identities, which the method must reject.
    controls: Vec<ControlEntry<'a>>,
    /// Misprinted equations of the paper, each with a counterexample.
    misprints: Vec<MisprintEntry<'a>>,
    /// Problems of the report; empty if it holds.
    problems: Vec<String>,
    /// The result in a sentence.
    summary: String,
}

/// An identity and its proof over the rational numbers.
#[derive(Serialize, JsonSchema)]
struct IdentityEntry<'a> {
    /// The subject.
    subject: &'a str,
    /// Its name.
    name: &'a str,
    /// The identity in letters.
    statement: &'a str,
    /// The equations of the paper that it covers; empty if none.
    equations: &'a str,
    /// An upper bound of the degree of its equations, cleared of fractions.
    degree: u64,
    /// Number of bits that suffice for each coefficient.
    coefficient_bits: u64,
    /// Number of points at which it was evaluated modulo each prime.
    points: u64,
    /// Number of these that were drawn again because of a division by zero.
    points_redrawn: u64,
    /// The binary logarithm of the bound of the probability that a false identity passes.
    error_log2: i64,
    /// `true` if it is proven.
    holds: bool,
    /// The outcome in words.
    verdict: String,
}

/// A conclusion from identities.
#[derive(Serialize, JsonSchema)]
struct ConclusionEntry<'a> {
    /// Its name.
    name: &'a str,
    /// The conclusion in letters.
    statement: &'a str,
    /// Reason for it.
    reason: &'a str,
    /// The names of the identities that it follows from.
    premises: &'a [&'a str],
    /// `true` if all of them hold.
    holds: bool,
}

/// A choice of the code, tried at points.
#[derive(Serialize, JsonSchema)]
struct ChoiceEntry<'a> {
    /// Its name.
    name: &'a str,
    /// The choice in letters.
    statement: &'a str,
    /// Number of points at which it was tried.
    points: u64,
    /// `true` if the code chose so at every point.
    holds: bool,
}

/// A false identity.
#[derive(Serialize, JsonSchema)]
struct ControlEntry<'a> {
    /// Its name.
    name: &'a str,
    /// The identity in letters.
    statement: &'a str,
    /// `true` if it was rejected for the right reason.
    told: bool,
    /// The outcome in words.
    verdict: String,
}

/// A misprinted equation and a counterexample.
#[derive(Serialize, JsonSchema)]
struct MisprintEntry<'a> {
    /// Its place in the paper.
    place: &'a str,
    /// The equation as printed.
    stated: &'a str,
    /// The equation that holds.
    holds: &'a str,
    /// The law that the printed equation breaks.
    breaks: &'a str,
    /// The inputs of the counterexample.
    inputs: Vec<InputEntry<'a>>,
    /// Its quantities by either equation.
    findings: Vec<FindingEntry<'a>>,
    /// `true` if every quantity shows the misprint.
    shown: bool,
}

/// An input of a counterexample.
#[derive(Serialize, JsonSchema)]
struct InputEntry<'a> {
    /// Its letter.
    name: &'a str,
    /// Its value as an exact fraction.
    value: String,
}

/// A quantity of a counterexample.
#[derive(Serialize, JsonSchema)]
struct FindingEntry<'a> {
    /// The quantity.
    quantity: &'a str,
    /// Its value by the printed equation, or what the paper says of it.
    stated: &'a str,
    /// Its value by the motions before and after the impact.
    holds: &'a str,
}

impl<'a> Document<'a> {
    fn of(report: &'a Report) -> Self {
        let of_subject = |subject: &'a Proofs| subject.proofs.iter().map(|proof| IdentityEntry::of(subject.name, proof));
        Document {
            schema: SCHEMA,
            holds: report.holds(),
            seed: report.seed,
            primes: PRIMES.map(|prime| prime.to_string()),
            fractions: FRACTIONS,
            identities: report.subjects.iter().flat_map(of_subject).collect(),
            conclusions: report.conclusions.iter().map(ConclusionEntry::of).collect(),
            choices: report
                .choices
                .iter()
                .map(|choice| ChoiceEntry { name: choice.name, statement: choice.statement, points: choice.points, holds: choice.holds() })
                .collect(),
            controls: report
                .controls
                .iter()
                .map(|control| ControlEntry {
                    name: control.proof.identity.name,
                    statement: control.proof.identity.statement,
                    told: control.is_detected(),
                    verdict: control.proof.verdict.to_string(),
                })
                .collect(),
            misprints: report.misprints.iter().map(MisprintEntry::of).collect(),
            problems: report.problems().iter().map(ToString::to_string).collect(),
            summary: report.summary(),
        }
    }
}

impl<'a> IdentityEntry<'a> {
    fn of(subject: &'a str, proof: &'a Proof) -> Self {
        IdentityEntry {
            subject,
            name: proof.identity.name,
            statement: proof.identity.statement,
            equations: proof.identity.equations,
            degree: proof.degree,
            coefficient_bits: proof.coefficient_bits,
            points: proof.points,
            points_redrawn: proof.redrawn,
            error_log2: -(proof.error_bits as i64),
            holds: proof.holds(),
            verdict: proof.verdict.to_string(),
        }
    }
}

impl<'a> ConclusionEntry<'a> {
    fn of(conclusion: &'a Conclusion) -> Self {
        let Conclusion { name, statement, reason, premises, holds } = conclusion;
        ConclusionEntry { name, statement, reason, premises, holds: *holds }
    }
}

impl<'a> MisprintEntry<'a> {
    fn of(misprint: &'a Misprint) -> Self {
        let inputs = misprint.inputs.iter().map(|input| InputEntry { name: input.name, value: input.value.to_string() });
        let findings = misprint.findings.iter();
        MisprintEntry {
            place: misprint.place,
            stated: misprint.stated,
            holds: misprint.holds,
            breaks: misprint.breaks,
            inputs: inputs.collect(),
            findings: findings
                .map(|finding| FindingEntry { quantity: finding.quantity, stated: &finding.stated, holds: &finding.holds })
                .collect(),
            shown: misprint.is_shown(),
        }
    }
}
