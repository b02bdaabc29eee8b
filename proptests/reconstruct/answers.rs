//! The contents of an answer: uncertainty, influence, weights.

use planar_impact::reconstruct::*;
use planar_impact::*;
use rand::RngExt;

use super::scene::{Source, Truth, asking, deviation};

const CASES: usize = 200;

/// Four unknowns without prior; a fifth one has a prior.
const UNKNOWNS: [Variable; 4] =
    [Variable::Speed(Side::One), Variable::Speed(Side::Two), Variable::Input(Input::Restitution), Variable::Input(Input::CrushPlane)];

const EVIDENCE: [Measurand; 7] = [
    Measurand::CrushEnergy,
    Measurand::Output(Output::VelocityX(Side::One)),
    Measurand::Output(Output::VelocityY(Side::One)),
    Measurand::Output(Output::YawRate(Side::One)),
    Measurand::SeparationDirection(Side::Two),
    Measurand::DeltaVForward(Side::Two),
    Measurand::Output(Output::PrincipalDirectionOfForce(Side::One)),
];

/// Returns a question with noisy evidence.
fn noisy(source: &mut Source) -> (Truth, ReconstructionProblem) {
    let truth = Truth::of(source.collision(), 0.5);
    let mut question = ReconstructionProblem::of(truth.collision);
    for variable in UNKNOWNS {
        question = asking(question, variable, truth.variable(variable), source);
    }
    question = question.prior(Variable::Input(Input::YawRate(Side::Two)), source.between(-0.2, 0.2), 0.2);
    for measurable in EVIDENCE {
        let exact = truth.measured(measurable);
        let sd = deviation(measurable, exact);
        question = question.evidence(measurable, exact + sd * source.between(-1.0, 1.0), Uncertainty::StandardDeviation(sd));
    }
    (truth, question)
}

const ONE_START: Search = Search { starts: 1, seed: 1, iterations: 200 };

#[test]
fn the_influence_is_the_difference_that_the_evidence_makes() {
    let mut source = Source::of(21);
    let mut compared = 0;
    for _ in 0..CASES {
        let (_, question) = noisy(&mut source);
        let Ok(answer) = question.solve(&ONE_START) else { continue };
        if answer.best().unknowns.iter().any(|unknown| unknown.at.is_some()) || !answer.not_determined.is_empty() {
            continue;
        }
        for piece in 0..=question.evidence.len() {
            let moved = |share: f64| {
                let mut question = question.clone();
                match question.evidence.get_mut(piece) {
                    Some(evidence) => evidence.value += share * evidence.uncertainty.standard_deviation().expect("it has one"),
                    // The prior, after the evidence.
                    None => question.unknowns[4].start += share * 0.2,
                }
                question.solve(&ONE_START).ok().map(|answer| answer.solutions[0].clone())
            };
            let sd = question.evidence.get(piece).map_or(0.2, |evidence| evidence.uncertainty.standard_deviation().expect("it has one"));
            let (Some(more), Some(less)) = (moved(1e-3), moved(-1e-3)) else { continue };
            for (i, row) in answer.best().influence.iter().enumerate() {
                let difference = (more.unknowns[i].value - less.unknowns[i].value) / 2e-3;
                let scale = answer.best().unknowns[i].sd.expect("it is determined");
                assert!((row[piece] * sd - difference).abs() < 1e-4 * scale, "{} by {piece}: {} and {difference}", i, row[piece] * sd);
                compared += 1;
            }
        }
    }
    assert!(compared > CASES * 20, "{compared}");
}

#[test]
fn the_covariance_is_what_the_errors_of_the_evidence_make() {
    let mut source = Source::of(22);
    let mut answered = 0;
    for _ in 0..CASES {
        let (_, question) = noisy(&mut source);
        let Ok(answer) = question.solve(&ONE_START) else { continue };
        let best = answer.best();
        let errors: Vec<f64> = best.evidence.iter().chain(&best.priors).map(|fitted| fitted.sd.expect("each has one")).collect();
        // At a fold the covariance is larger than this.
        let variance = |i: usize| (0..errors.len()).map(|piece| (best.influence[i][piece] * errors[piece]).powi(2)).sum::<f64>();
        if (0..best.unknowns.len()).any(|i| best.covariance.get(i, i) > 2.0 * variance(i)) {
            continue;
        }
        answered += 1;
        for (i, one) in best.influence.iter().enumerate() {
            for (k, other) in best.influence.iter().enumerate() {
                let by_hand: f64 = (0..errors.len()).map(|piece| one[piece] * other[piece] * errors[piece].powi(2)).sum();
                assert!((best.covariance.get(i, k) - by_hand).abs() <= 1e-9 * by_hand.abs().max(1e-12));
            }
            if let Some(sd) = best.unknowns[i].sd {
                assert!((sd * sd / best.covariance.get(i, i) - 1.0).abs() < 1e-12);
                assert!(best.covariance.correlation(i, i).is_some_and(|one| (one - 1.0).abs() < 1e-12));
            }
        }
    }
    // A few searches from one start do not converge.
    assert!(10 * answered >= 9 * (CASES), "{answered}");
}

#[test]
fn the_order_of_the_question_does_not_matter_and_its_answer_is_the_same_to_the_bit() {
    let mut source = Source::of(23);
    let mut answered = 0;
    for _ in 0..CASES / 4 {
        let (_, question) = noisy(&mut source);
        let Ok(answer) = question.solve(&ONE_START) else { continue };
        answered += 1;
        assert_eq!(question.solve(&ONE_START).as_ref(), Ok(&answer));
        let mut turned = question.clone();
        turned.evidence.reverse();
        turned.unknowns.reverse();
        let again = turned.solve(&ONE_START).expect("it is the same question");
        for unknown in &answer.best().unknowns {
            let other = again.best().estimate(unknown.of).expect("it is asked for too");
            assert!((unknown.value - other.value).abs() < 1e-7, "{} {}", unknown.value, other.value);
        }
    }
    // A few searches from one start do not converge.
    assert!(10 * answered >= 9 * (CASES / 4), "{answered}");
}

#[test]
fn correlated_evidence_counts_by_the_inverse_of_its_covariance() {
    let mut source = Source::of(24);
    let mut answered = 0;
    for _ in 0..CASES / 4 {
        let (_, mut question) = noisy(&mut source);
        let coefficient = source.between(-0.9, 0.9);
        let (one, other) = (EVIDENCE[1], EVIDENCE[2]);
        question.correlations = vec![Correlation { one, other, coefficient }];
        let Ok(answer) = question.solve(&ONE_START) else { continue };
        answered += 1;
        let best = answer.best();
        let z: Vec<f64> = best.evidence.iter().chain(&best.priors).filter_map(Fitted::standardised_residual).collect();
        let pair = (z[1] * z[1] - 2.0 * coefficient * z[1] * z[2] + z[2] * z[2]) / (1.0 - coefficient * coefficient);
        let rest: f64 = (0..z.len()).filter(|i| ![1, 2].contains(i)).map(|i| z[i] * z[i]).sum();
        assert!((best.chi_square - pair - rest).abs() < 1e-9 * (1.0 + best.chi_square), "{} {}", best.chi_square, pair + rest);
    }
    // A few searches from one start do not converge.
    assert!(10 * answered >= 9 * (CASES / 4), "{answered}");
}

#[test]
fn what_is_exact_is_met_and_adds_no_uncertainty() {
    let mut source = Source::of(25);
    let mut answered = 0;
    for _ in 0..CASES / 4 {
        let (_, mut question) = noisy(&mut source);
        question.evidence[0].uncertainty = Uncertainty::Exact;
        let Ok(answer) = question.solve(&ONE_START) else { continue };
        answered += 1;
        let best = answer.best();
        assert!(best.evidence[0].residual.abs() < 1e-4 * best.evidence[0].given && best.evidence[0].standardised_residual().is_none());
        let exact = best.unknowns[0].sd;
        // The limit of a decreasing standard deviation.
        question.evidence[0].uncertainty = Uncertainty::StandardDeviation(1e-6 * question.evidence[0].value);
        let near = question.solve(&ONE_START).expect("it is nearly the same question");
        assert!((near.best().unknowns[0].value - best.unknowns[0].value).abs() < 1e-5);
        if let (Some(exact), Some(near)) = (exact, near.best().unknowns[0].sd) {
            assert!((exact - near).abs() < 1e-4, "{exact} {near}");
        }
    }
    // A few searches from one start do not converge.
    assert!(10 * answered >= 9 * (CASES / 4), "{answered}");
}

#[test]
fn evidence_that_has_no_deviation_at_all_gives_none_to_the_answer() {
    let truth = Truth::of(Source::of(26).collision(), 0.5);
    let of = Measurand::CrushEnergy;
    let question = ReconstructionProblem::of(truth.collision).unknown(Variable::Speed(Side::One), 12.0).evidence(
        of,
        truth.measured(of),
        Uncertainty::Exact,
    );
    let answer = question.solve(&Search::default()).expect("it has an answer");
    assert_eq!(answer.best().unknowns[0].sd, None);
}

#[test]
fn a_prior_is_evidence_of_the_unknown_itself_and_a_resolution_a_deviation() {
    let truth = Truth::of(Source::of(27).collision(), 0.5);
    let (of, speed) = (Measurand::CrushEnergy, Variable::Speed(Side::One));
    let base = ReconstructionProblem::of(truth.collision).evidence(of, 1.1 * truth.measured(of), Uncertainty::StandardDeviation(4e3));
    let with_prior = base.clone().prior(speed, 14.0, 2.0).solve(&ONE_START).expect("it has an answer");
    let as_evidence = base.clone().unknown(speed, 14.0).evidence(Measurand::Variable(speed), 14.0, Uncertainty::StandardDeviation(2.0));
    let as_evidence = as_evidence.solve(&ONE_START).expect("it has an answer");
    assert!((with_prior.best().unknowns[0].value - as_evidence.best().unknowns[0].value).abs() < 1e-9);
    assert!((with_prior.best().chi_square - as_evidence.best().chi_square).abs() < 1e-9);
    assert_eq!(with_prior.best().degrees_of_freedom, 1);
    let resolution =
        base.clone().unknown(speed, 14.0).evidence(Measurand::Variable(speed), 14.0, Uncertainty::Resolution(2.0 * 12_f64.sqrt()));
    let resolution = resolution.solve(&ONE_START).expect("it has an answer");
    assert!((resolution.best().unknowns[0].value - as_evidence.best().unknowns[0].value).abs() < 1e-9);
}

#[test]
fn every_measurable_is_measured_as_by_hand() {
    let mut source = Source::of(28);
    for _ in 0..CASES / 4 {
        let share = source.between(0.1, 0.9);
        let truth = Truth::of(source.collision(), share);
        let is_missing = |of: &Measurand| matches!(of, Measurand::Variable(Variable::Input(Input::Moment)));
        for of in Measurand::all().filter(|of| !is_missing(of)) {
            assert_eq!(Measurand::named(of.name()), Some(of), "{}", of.name());
            let mut question = ReconstructionProblem::of(truth.collision)
                .prior(Variable::Speed(Side::One), truth.variable(Variable::Speed(Side::One)), 1e-3)
                .evidence(of, truth.measured(of), Uncertainty::StandardDeviation(1.0));
            question.crush_share = Some(share);
            let answer = question.solve(&ONE_START).expect("it starts at the truth");
            let fitted = answer.best().evidence[0];
            assert!((fitted.computed - truth.measured(of)).abs() <= 1e-9 * fitted.given.abs().max(1.0), "{}: {fitted:?}", of.name());
        }
    }
}

#[test]
fn angles_are_compared_the_shorter_way() {
    let mut source = Source::of(29);
    for _ in 0..CASES / 4 {
        let truth = Truth::of(source.collision(), 0.5);
        let turns = if source.0.random::<bool>() { 1.0 } else { -1.0 } * std::f64::consts::TAU;
        let of = Measurand::SeparationDirection(Side::One);
        let question = ReconstructionProblem::of(truth.collision)
            .between(Variable::Speed(Side::One), truth.variable(Variable::Speed(Side::One)), 0.0, 60.0)
            .evidence(of, truth.measured(of) + turns, Uncertainty::StandardDeviation(0.02));
        let answer = question.solve(&ONE_START).expect("it starts at the truth");
        assert!(answer.best().chi_square < 1e-12 && answer.best().evidence[0].residual.abs() < 1e-6);
    }
}

#[test]
fn a_vehicle_that_drives_along_its_heading_turns_with_it() {
    let truth = Truth::of(Source::of(30).collision(), 0.5);
    let heading = Variable::Input(Input::Heading(Side::One));
    let mut question = ReconstructionProblem::of(truth.collision);
    question.drives_along_heading[0] = true;
    question = question.between(heading, 0.2, -0.5, 0.5);
    for of in [Measurand::Output(Output::VelocityX(Side::One)), Measurand::Output(Output::VelocityY(Side::One))] {
        question = question.evidence(of, truth.measured(of), Uncertainty::StandardDeviation(0.3));
    }
    let answer = question.solve(&Search::default()).expect("it has an answer");
    assert!(answer.best().unknowns[0].value.abs() < 1e-9);
    let car = answer.best().collision.one.vehicle().copied().expect("a car");
    assert!((car.motion.velocity.y / car.motion.velocity.x - car.heading.sin / car.heading.cos).abs() < 1e-12);
}
