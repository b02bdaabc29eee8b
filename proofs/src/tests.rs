//! Tests of the run, and of runs that must not hold.

mod laws;

use std::sync::OnceLock;

use super::*;

fn report() -> Report {
    static REPORT: OnceLock<Report> = OnceLock::new();
    REPORT.get_or_init(run).clone()
}

fn problems(alter: impl FnOnce(&mut Report)) -> Vec<String> {
    let mut report = report();
    alter(&mut report);
    assert!(!report.holds());
    assert!(report.summary().ends_with("NOT all of it holds"));
    report.problems().iter().map(ToString::to_string).collect()
}

#[test]
fn everything_is_proven() {
    let report = report();
    assert!(report.holds(), "{:#?}", report.problems().iter().map(ToString::to_string).collect::<Vec<_>>());
    assert!(report.summary().ends_with("; all of it holds"), "{}", report.summary());
    assert!(report.error_bits() > TOTAL_ERROR_BITS);
    for proof in report.proofs() {
        assert!(proof.error_bits >= ERROR_BITS && proof.points >= 2, "{}", proof.identity.name);
        assert!(!proof.identity.statement.is_empty(), "{}", proof.identity.name);
    }
}

#[test]
fn every_equation_of_the_paper_that_a_collision_has_is_proven() {
    let report = report();
    let named = report.subjects.iter().find(|subject| subject.name == "The paper's equations").expect("a subject");
    let of_name = |name: &str| named.proofs.iter().any(|proof| proof.identity.equations.split(", ").any(|equation| equation == name));
    for number in 1..=30 {
        assert!(of_name(&format!("A{number}")), "A{number}");
    }
    let anywhere = |name: &str| {
        let numbers = |proof: &Proof| proof.identity.equations.replace("Eqs ", "").replace("Eq ", "");
        report
            .proofs()
            .any(|proof| proof.identity.equations.starts_with("Eq") && numbers(proof).split(", ").any(|equation| equation == name))
    };
    for number in 1..=9 {
        assert!(anywhere(&number.to_string()), "Eq {number}");
    }
}

#[test]
fn other_points_prove_the_same() {
    let outcome = |seed: u64| {
        let subject = identity::subjects().into_iter().find(|subject| subject.name == "Compliance").expect("a subject");
        let streams: Vec<u64> = (0..).take(subject.identities.len()).collect();
        let Proofs { proofs, .. } = Proofs::of(subject, seed, &streams);
        proofs.into_iter().map(|proof| (proof.identity.name, proof.degree, proof.verdict)).collect::<Vec<_>>()
    };
    let first = outcome(SEED);
    assert!(first.iter().all(|(_, _, verdict)| *verdict == Verdict::Holds));
    assert!((2..6).all(|seed| outcome(seed) == first));
}

#[test]
fn an_identity_that_fails_is_a_problem_and_takes_its_conclusions_along() {
    let problems = problems(|report| {
        let proofs = report.subjects.iter_mut().flat_map(|subject| &mut subject.proofs);
        let determinant = proofs.into_iter().find(|proof| proof.identity.name == "det K").expect("an identity");
        determinant.verdict = Verdict::False { by: Arithmetic::Residues, equation: 2 };
        let proofs: Vec<&Proof> = report.subjects.iter().flat_map(|subject| &subject.proofs).collect();
        report.conclusions = conclusion::from(&proofs);
    });
    assert_eq!(problems[0], "\"det K\" is not proven: equation 2 of it fails at a point, in residues");
    assert_eq!(problems[1], "\"K is positive definite\" does not follow: a premise is not proven");
    assert_eq!(problems.len(), 5, "{problems:#?}");
}

#[test]
fn a_control_that_passes_is_a_problem() {
    let problems = problems(|report| report.controls[0].proof.verdict = Verdict::Holds);
    assert_eq!(problems, ["the false identity \"a wrong sign\" was not told: it holds"]);
}

#[test]
fn a_misprint_that_is_not_shown_is_a_problem() {
    let problems = problems(|report| report.misprints[0].findings[0].shows = false);
    assert_eq!(problems, ["Eqs 7, 8 is listed as wrong, and its collision does not show it"]);
}

#[test]
fn a_choice_that_is_not_taken_is_a_problem() {
    let problems = problems(|report| report.choices[0].verdict = Verdict::Undefined(Arithmetic::Fractions));
    assert_eq!(problems, ["\"the critical ratio takes the sticking impulse\" is not so: it divides by zero too often, in fractions"]);
}

#[test]
fn a_proof_by_too_few_points_is_none() {
    let problems = problems(|report| report.subjects[0].proofs[0].error_bits = 60);
    assert_eq!(problems[0], "\"a half-tangent gives a direction\" is not proven: it holds, with an error of up to 2^-60");
    assert_eq!(problems[1], "the probability that one of the identities is false may be as high as 2^-59");
}

#[test]
fn a_part_that_is_missing_is_a_problem() {
    assert_eq!(problems(|report| report.conclusions.clear()), ["a part of the run is empty"]);
    assert_eq!(problems(|report| report.misprints.clear()), ["a part of the run is empty"]);
    assert_eq!(problems(|report| report.controls.clear()), ["a part of the run is empty"]);
    let twice = problems(|report| report.subjects.push(report.subjects[0].clone()));
    assert_eq!(twice[0], "\"a half-tangent gives a direction\" is the name of two identities");
}
