//! The page of `prove`: every identity with the method of its proof, and the errors in print.

use planar_impact_app::prove::ProofReport;
use planar_impact_proofs::scalar::PRIMES;
use planar_impact_proofs::{Conclusion, Control, FRACTIONS, Finding, Misprint, Proof, Proofs};

use crate::block::{Block, Table};
use crate::text::wrap;

/// Renders identities, conclusions, choices, controls and misprints.
pub fn page(answer: &ProofReport) -> Vec<Block> {
    let report = &answer.report;
    let heading = |text: &str| Block::Heading { level: 2, text: text.to_owned() };
    let mut blocks = vec![
        Block::Heading { level: 1, text: "Proofs of the identities of planar impact".to_owned() },
        Block::paragraph(method(report.seed)),
    ];
    blocks.extend(report.subjects.iter().map(|subject| Block::Verbatim(identities(subject))));
    blocks.push(heading("What follows, by the order of the numbers"));
    blocks.extend(report.conclusions.iter().flat_map(concluded));
    blocks.push(heading("Choices, which compare, and are tried at fractions instead of proven"));
    for choice in &report.choices {
        let label = format!("  {} at {} points: ", yes(choice.holds()), choice.points);
        blocks.extend([Block::item(label, choice.name), Block::item("    ", choice.statement)]);
    }
    blocks.push(heading("Controls, which must fail, and do"));
    let control = |control: &Control| Block::item(format!("  {}: ", control.proof.identity.name), control.proof.verdict.to_string());
    blocks.extend(report.controls.iter().map(control));
    blocks.push(heading("What is wrong in print, each shown by a collision in exact fractions"));
    blocks.push(Block::paragraph(
        "Letters are the paper's. r_1x and r_1y lead from the center of mass of vehicle 1 to the impact center; a barrier has 1/m_2 = 1/I_2 = 0.",
    ));
    blocks.extend(report.misprints.iter().flat_map(wrong));
    blocks.extend(report.problems().iter().map(|problem| Block::item("Problem: ", problem.to_string())));
    blocks.push(Block::paragraph(report.summary()));
    blocks
}

/// Describes the method and the numbers in the tables.
fn method(seed: u64) -> String {
    format!(
        "The code that solves collisions computes both sides of each identity modulo {} primes of 61 bits, at random points; angles enter by the \
         tangent of half of them. A false identity of degree d passes a point with a probability of at most d/p, p the prime (Schwartz and Zippel). \
         The degree, and the bits of the coefficients, are bounded by running the same code on bounds; no coefficient reaches the product of the \
         primes, so what holds modulo all of them holds for the rational numbers. The error bounds the probability that a false identity passed \
         all its points. Each passed {FRACTIONS} points in exact fractions besides. Points are drawn by ChaCha20 from the seed {seed}.",
        PRIMES.len(),
    )
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "NO" }
}

/// Width of the names, so that the numbers of all subjects are aligned.
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

/// Renders an identity in symbols, with the paper's equation numbers unless the name mentions them.
fn stated(proof: &Proof) -> String {
    let (statement, equations) = (proof.identity.statement, proof.identity.equations);
    if equations.is_empty() || proof.identity.name.starts_with(equations) {
        statement.to_owned()
    } else {
        format!("{statement}  ({equations})")
    }
}

fn concluded(conclusion: &Conclusion) -> [Block; 4] {
    [
        Block::item(format!("  {}: ", yes(conclusion.holds)), conclusion.name),
        Block::item("    ", conclusion.statement),
        Block::item("    because ", conclusion.reason),
        Block::item("    from: ", conclusion.premises.join("; ")),
    ]
}

fn wrong(misprint: &Misprint) -> Vec<Block> {
    let inputs: Vec<String> =
        misprint.inputs.iter().map(|input| format!("{}\u{a0}=\u{a0}{}", input.name.replace(' ', "\u{a0}"), input.value)).collect();
    let row = |finding: &Finding| vec![finding.quantity.to_owned(), finding.stated.clone(), finding.holds.clone()];
    let rows = misprint.findings.iter().map(row).collect();
    vec![
        Block::Heading { level: 3, text: misprint.place.to_owned() },
        Block::item("    stated: ", misprint.stated),
        Block::item("    holds:  ", misprint.holds),
        Block::item("    breaks: ", misprint.breaks),
        Block::item("    at:     ", inputs.join(", ")),
        Table::new(["quantity", "as stated", "what holds"], "lrr", rows).into(),
    ]
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use planar_impact_app::control::Uncontrolled;
    use unicode_width::UnicodeWidthStr;

    use super::*;
    use crate::text::render;

    static ANSWER: LazyLock<ProofReport> =
        LazyLock::new(|| planar_impact_app::prove::prove(&(), &Uncontrolled).expect("nobody interrupts"));

    #[test]
    fn every_identity_and_every_misprint_is_shown() {
        let (report, text) = (&ANSWER.report, render(&page(&ANSWER)));
        assert!(report.holds(), "{text}");
        for proof in report.proofs() {
            assert!(proof.identity.name.width() <= NAME_COLUMNS, "{}", proof.identity.name);
            assert!(text.lines().any(|line| line.starts_with(proof.identity.name) && line.ends_with("yes")), "{}", proof.identity.name);
        }
        for misprint in &report.misprints {
            let line = "=".repeat(misprint.place.width());
            assert!(text.contains(&format!("\n{}\n{line}\n\n    stated: ", misprint.place)), "{}", misprint.place);
        }
        // A misprint and its collision, in full.
        assert!(text.contains("T_L(Γ) − T_L(0) at e           0    1803/1300"));
        assert!(text.lines().all(|line| line.width() <= 80), "80 columns");
        assert!(!text.contains("Problem") && !text.contains("NO"));
    }

    #[test]
    fn what_does_not_hold_is_said() {
        let mut answer = ANSWER.clone();
        answer.report.misprints[0].findings[0].shows = false;
        let text = render(&page(&answer));
        assert!(text.contains("Problem: Eqs 7, 8 is listed as wrong") && text.contains("NOT all of it holds"), "{text}");
    }
}
