//! The verb `prove`: every identity with the way it was established, and what is wrong in print.

use planar_impact_proofs::scalar::PRIMES;
use planar_impact_proofs::{Conclusion, FRACTIONS, Misprint, Proof, Proofs, Report};
use serde::Serialize;

use crate::Done;
use crate::arguments::{Format, Prove};
use crate::exit::{Failure, Status};
use crate::table::{self, Align, wrap};

/// Runs the proofs and prints every identity.
///
/// # Errors
///
/// When the result cannot be written as JSON.
pub fn run(call: &Prove) -> Result<Done, Failure> {
    let report = planar_impact_proofs::run();
    let text = match call.format {
        Format::Text => render(&report),
        Format::Json => serde_json::to_string_pretty(&Document::of(&report)).map_err(|error| Failure::Data(error.to_string()))? + "\n",
    };
    let status = if report.holds() { Status::Done } else { Status::DoesNotHold };
    Ok(Done { text, status })
}

/// What the numbers of the tables mean.
fn method(seed: u64) -> String {
    let said = format!(
        "The code that solves collisions computes both sides of each identity modulo {} primes of 61 bits, at random points; angles enter by the \
         tangent of half of them. A false identity of degree d passes a point with a probability of at most d/p, p the prime (Schwartz and Zippel). \
         The degree, and the bits of the coefficients, are bounded by running the same code on bounds; no coefficient reaches the product of the \
         primes, so what holds modulo all of them holds for the rational numbers. The error bounds the probability that a false identity passed \
         all its points. Each passed {FRACTIONS} points in exact fractions besides. Points are drawn by ChaCha20 from the seed {seed}.",
        PRIMES.len(),
    );
    textwrap::fill(&said, 80) + "\n"
}

fn render(report: &Report) -> String {
    let mut text = format!("Proofs of the identities of planar impact\n\n{}\n", method(report.seed));
    for subject in &report.subjects {
        text.push_str(&identities(subject));
        text.push('\n');
    }
    text.push_str("What follows, by the order of the numbers\n\n");
    for conclusion in &report.conclusions {
        text.push_str(&concluded(conclusion));
    }
    text.push_str("\nWhat compares, and is tried at fractions instead of proven\n\n");
    for choice in &report.choices {
        text.push_str(&wrap(choice.name, &format!("  {} at {} points: ", yes(choice.holds()), choice.points)));
        text.push_str(&wrap(choice.statement, "    "));
    }
    text.push_str("\nWhat must fail, and does\n\n");
    for control in &report.controls {
        text.push_str(&wrap(&control.proof.verdict.to_string(), &format!("  {}: ", control.proof.identity.name)));
    }
    text.push_str("\nWhat is wrong in print, each shown by a collision in exact fractions\n\n");
    let letters = "Letters are the paper's. r_1x and r_1y lead from the center of mass of vehicle 1 to the impact center; a barrier has 1/m_2 = 1/I_2 = 0.";
    text.push_str(&(textwrap::fill(letters, 80) + "\n\n"));
    for misprint in &report.misprints {
        text.push_str(&wrong(misprint));
        text.push('\n');
    }
    for problem in report.problems() {
        text.push_str(&wrap(&problem.to_string(), "PROBLEM: "));
    }
    text.push_str(&wrap(&report.summary(), ""));
    text
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "NO" }
}

/// How wide the names are, so that the numbers of all subjects stand below each other.
const NAME_COLUMNS: usize = 48;

fn identities(subject: &Proofs) -> String {
    let line = |name: &str, [degree, bits, points, error, holds]: [&str; 5]| {
        format!("{name:NAME_COLUMNS$}{degree:>6}{bits:>6}{points:>5}{error:>8}  {holds}\n")
    };
    let mut text = line(subject.name, ["degree", "bits", "pts", "error", "holds"]);
    text.push_str(&("-".repeat(text.chars().count() - 1) + "\n"));
    for proof in &subject.proofs {
        let numbers = [proof.degree, proof.coefficient_bits, proof.points].map(|number| number.to_string());
        let [degree, bits, points] = numbers.each_ref().map(String::as_str);
        text.push_str(&line(proof.identity.name, [degree, bits, points, &format!("2^-{}", proof.error_bits), yes(proof.holds())]));
        text.push_str(&wrap(&stated(proof), "    "));
    }
    text
}

/// An identity in letters, with the paper's numbers where the name does not say them.
fn stated(proof: &Proof) -> String {
    let (statement, equations) = (proof.identity.statement, proof.identity.equations);
    if equations.is_empty() || proof.identity.name.starts_with(equations) {
        statement.to_owned()
    } else {
        format!("{statement}  ({equations})")
    }
}

fn concluded(conclusion: &Conclusion) -> String {
    let premises = conclusion.premises.join("; ");
    wrap(conclusion.name, &format!("  {}: ", yes(conclusion.holds)))
        + &wrap(conclusion.statement, "    ")
        + &wrap(conclusion.reason, "    because ")
        + &wrap(&premises, "    from: ")
}

fn wrong(misprint: &Misprint) -> String {
    let inputs: Vec<String> =
        misprint.inputs.iter().map(|input| format!("{}\u{a0}=\u{a0}{}", input.name.replace(' ', "\u{a0}"), input.value)).collect();
    let rows: Vec<Vec<String>> =
        misprint.findings.iter().map(|finding| vec![finding.quantity.to_owned(), finding.stated.clone(), finding.holds.clone()]).collect();
    let columns = [Align::Left, Align::Right, Align::Right];
    let table = table::render(&["quantity", "as stated", "what holds"], &columns, &rows);
    let indented: String = table.lines().flat_map(|line| ["    ", line, "\n"]).collect();
    format!("  {}\n", misprint.place)
        + &wrap(misprint.stated, "    stated: ")
        + &wrap(misprint.holds, "    holds:  ")
        + &wrap(misprint.breaks, "    breaks: ")
        + &wrap(&inputs.join(", "), "    at:     ").replace('\u{a0}', " ")
        + &indented
}

/// The JSON document of `prove`.
#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    holds: bool,
    seed: u64,
    /// As text: a program that reads numbers as doubles would round them.
    primes: [String; PRIMES.len()],
    fractions: u64,
    identities: Vec<IdentityEntry<'a>>,
    conclusions: Vec<ConclusionEntry<'a>>,
    choices: Vec<ChoiceEntry<'a>>,
    controls: Vec<ControlEntry<'a>>,
    misprints: Vec<MisprintEntry<'a>>,
    problems: Vec<String>,
    summary: String,
}

#[derive(Serialize)]
struct IdentityEntry<'a> {
    subject: &'a str,
    name: &'a str,
    statement: &'a str,
    equations: &'a str,
    degree: u64,
    coefficient_bits: u64,
    points: u64,
    points_redrawn: u64,
    error_log2: i64,
    holds: bool,
    verdict: String,
}

#[derive(Serialize)]
struct ConclusionEntry<'a> {
    name: &'a str,
    statement: &'a str,
    reason: &'a str,
    premises: &'a [&'a str],
    holds: bool,
}

#[derive(Serialize)]
struct ChoiceEntry<'a> {
    name: &'a str,
    statement: &'a str,
    points: u64,
    holds: bool,
}

#[derive(Serialize)]
struct ControlEntry<'a> {
    name: &'a str,
    statement: &'a str,
    told: bool,
    verdict: String,
}

#[derive(Serialize)]
struct MisprintEntry<'a> {
    place: &'a str,
    stated: &'a str,
    holds: &'a str,
    breaks: &'a str,
    inputs: Vec<InputEntry<'a>>,
    findings: Vec<FindingEntry<'a>>,
    shown: bool,
}

#[derive(Serialize)]
struct InputEntry<'a> {
    name: &'a str,
    value: String,
}

#[derive(Serialize)]
struct FindingEntry<'a> {
    quantity: &'a str,
    stated: &'a str,
    holds: &'a str,
}

impl<'a> Document<'a> {
    fn of(report: &'a Report) -> Self {
        let of_subject = |subject: &'a Proofs| subject.proofs.iter().map(|proof| IdentityEntry::of(subject.name, proof));
        Document {
            schema: 1,
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
                    told: control.is_told(),
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

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use unicode_width::UnicodeWidthStr;

    use super::*;

    static REPORT: LazyLock<Report> = LazyLock::new(planar_impact_proofs::run);

    #[test]
    fn every_identity_and_every_misprint_is_shown() {
        let text = render(&REPORT);
        assert!(REPORT.holds(), "{text}");
        for proof in REPORT.proofs() {
            assert!(proof.identity.name.width() <= NAME_COLUMNS, "{}", proof.identity.name);
            assert!(text.lines().any(|line| line.starts_with(proof.identity.name) && line.ends_with("yes")), "{}", proof.identity.name);
        }
        for misprint in &REPORT.misprints {
            assert!(text.contains(&format!("\n  {}\n    stated: ", misprint.place)), "{}", misprint.place);
        }
        // A misprint and its collision, in full.
        assert!(text.contains("T_L(Γ) − T_L(0) at e           0    1803/1300"));
        assert!(text.lines().all(|line| line.width() <= 80), "80 columns");
        assert!(!text.contains("PROBLEM") && !text.contains("NO"));
    }

    #[test]
    fn what_does_not_hold_is_said() {
        let mut report = REPORT.clone();
        report.misprints[0].findings[0].shows = false;
        let text = render(&report);
        assert!(text.contains("PROBLEM: Eqs 7, 8 is listed as wrong") && text.contains("NOT all of it holds"));
        assert_eq!(serde_json::to_value(Document::of(&report)).expect("plain data")["holds"], false);
    }
}
