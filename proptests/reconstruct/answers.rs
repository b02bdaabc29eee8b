//! The contents of an answer: uncertainty, influence, weights.

use nalgebra::{DMatrix, DVector};
use planar_impact::reconstruct::*;
use planar_impact::*;
use rand::RngExt;

use super::scene::{Source, Truth, asking, deviation, straight_into_barrier, with};

const CASES: usize = 200;

/// Four unknowns without prior; the fifth one has a prior.
const UNKNOWNS: [Variable; 4] =
    [Variable::Speed(Side::One), Variable::Speed(Side::Two), Variable::Input(Input::Restitution), Variable::Input(Input::CrushPlane)];

const UNKNOWN_WITH_PRIOR: Variable = Variable::Input(Input::YawRate(Side::Two));

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
    question = question.prior(UNKNOWN_WITH_PRIOR, source.between(-0.2, 0.2), 0.2);
    for measurable in EVIDENCE {
        let exact = truth.measured(measurable);
        let sd = deviation(measurable, exact);
        question = question.evidence(measurable, exact + sd * source.between(-1.0, 1.0), Uncertainty::StandardDeviation(sd));
    }
    (truth, question)
}

const ONE_START: Search = Search { starts: 1, seed: 1, iterations: 200 };

/// Returns the changes of the unknowns per standard deviation of each piece of evidence and each prior, from answers to changed questions. `None` if a search
/// fails, or a bound holds an unknown.
fn differences(question: &ReconstructionProblem) -> Option<Vec<Vec<f64>>> {
    /// The change, in standard deviations.
    const STEP: f64 = 1e-3;
    let with = |piece: usize, share: f64| {
        let mut question = question.clone();
        match question.evidence.get_mut(piece) {
            Some(evidence) => evidence.value += share * evidence.uncertainty.standard_deviation().expect("it has one"),
            // The prior, after the evidence.
            None => question.unknowns[4].start += share * question.unknowns[4].prior.expect("it has one"),
        }
        let answer = question.solve(&ONE_START).ok()?;
        let best = answer.best();
        best.unknowns.iter().map(|unknown| unknown.at.is_none().then_some(unknown.value)).collect::<Option<Vec<f64>>>()
    };
    let by = |piece: usize| {
        let (more, less) = (with(piece, STEP)?, with(piece, -STEP)?);
        Some(more.iter().zip(less).map(|(more, less)| (more - less) / (2.0 * STEP)).collect())
    };
    (0..=question.evidence.len()).map(by).collect()
}

#[test]
fn the_influence_is_the_difference_that_the_evidence_makes() {
    let mut source = Source::of(21);
    let mut compared = 0;
    for _ in 0..CASES / 2 {
        let (_, question) = noisy(&mut source);
        let (Ok(answer), Some(differences)) = (question.solve(&ONE_START), differences(&question)) else { continue };
        let best = answer.best();
        compared += 1;
        for (piece, differences) in differences.iter().enumerate() {
            let sd = question.evidence.get(piece).map_or(0.2, |evidence| evidence.uncertainty.standard_deviation().expect("it has one"));
            for (i, difference) in differences.iter().enumerate() {
                let scale = best.unknowns[i].sd.expect("it is determined");
                let influence = best.influence[i][piece] * sd;
                assert!((influence - difference).abs() < 1e-4 * scale, "{i} by {piece}: {influence} and {difference}");
            }
        }
    }
    // A few searches do not converge, or end on a bound.
    assert!(10 * compared >= 9 * (CASES / 2), "{compared}");
}

/// Returns the covariance that evidence linear in the unknowns would give, from differences of solved collisions around a solution.
fn by_slopes(question: &ReconstructionProblem, best: &Solution) -> DMatrix<f64> {
    let of_prior = [Measurand::Variable(UNKNOWN_WITH_PRIOR)];
    let pieces = || EVIDENCE.iter().chain(&of_prior).zip(best.evidence.iter().chain(&best.priors));
    let measured = |unknown: &Estimate, by: f64| {
        let there = Truth::of(with(&best.collision, unknown.of, unknown.value + by), 0.5);
        pieces().map(|(&of, fitted)| there.measured(of) / fitted.sd.expect("each has one")).collect::<Vec<_>>()
    };
    const STEP: f64 = 1e-5;
    let column = |unknown: &Estimate| {
        let (more, less) = (measured(unknown, STEP), measured(unknown, -STEP));
        DVector::from_iterator(more.len(), more.iter().zip(less).map(|(more, less)| (more - less) / (2.0 * STEP)))
    };
    let slopes = DMatrix::from_columns(&best.unknowns.iter().map(column).collect::<Vec<_>>());
    assert_eq!((slopes.nrows(), slopes.ncols()), (question.evidence.len() + 1, question.unknowns.len()));
    (slopes.transpose() * slopes).try_inverse().expect("each is determined")
}

#[test]
fn the_covariance_is_what_the_errors_of_the_evidence_make() {
    let mut source = Source::of(22);
    let (mut compared, mut folds) = (0, 0);
    for _ in 0..CASES / 2 {
        let (_, question) = noisy(&mut source);
        let (Ok(answer), Some(differences)) = (question.solve(&ONE_START), differences(&question)) else { continue };
        let best = answer.best();
        compared += 1;
        let unknowns = best.unknowns.len();
        let by_errors =
            DMatrix::from_fn(unknowns, unknowns, |i, k| differences.iter().map(|difference| difference[i] * difference[k]).sum::<f64>());
        let by_slopes = by_slopes(&question, best);
        // At a fold the errors move the solution less than the slopes say, which count there.
        let is_fold = (0..unknowns).any(|i| by_slopes[(i, i)] > 1.5_f64.powi(2) * by_errors[(i, i)]);
        folds += usize::from(is_fold);
        let expected = if is_fold { by_slopes } else { by_errors };
        for i in 0..unknowns {
            let sd = |i: usize| expected[(i, i)].sqrt();
            for k in 0..unknowns {
                assert_eq!(best.covariance.size(), best.unknowns.len());
                let (found, expected) = (best.covariance.get(i, k), expected[(i, k)]);
                assert!((found - expected).abs() < 1e-3 * sd(i) * sd(k), "{i} {k}: {found} for {expected}");
            }
            assert_eq!(best.unknowns[i].sd, Some(best.covariance.get(i, i).sqrt()));
            assert!(best.covariance.correlation(i, i).is_some_and(|one| (one - 1.0).abs() < 1e-12));
        }
    }
    // A few searches do not converge, or end on a bound.
    assert!(10 * compared >= 9 * (CASES / 2), "{compared}, {folds} at folds");
}

/// The crush energy of a car that drives straight into a barrier is greatest for a perpendicular plane. More than that has no slope there, but curvature, which
/// adds to the certainty of a prior.
#[test]
fn at_a_fold_the_slopes_alone_make_the_covariance() {
    const SD: f64 = 0.1;
    let plane = Variable::Input(Input::CrushPlane);
    let crush_energy = |angle| Truth::of(straight_into_barrier(angle), 1.0).measured(Measurand::CrushEnergy);
    let bend = (2.0 * crush_energy(0.0) - crush_energy(1e-3) - crush_energy(-1e-3)) / 1e-6;
    for (certainty, is_fold) in [(1.4, false), (1.6, true), (2.9, true), (3.1, true)] {
        // The certainty is 1 + more × bend × SD²/sd².
        let sd = 0.05 * crush_energy(0.0);
        let more = (certainty - 1.0) * (sd / SD).powi(2) / bend;
        let question = ReconstructionProblem::of(straight_into_barrier(0.0)).prior(plane, 0.0, SD).evidence(
            Measurand::CrushEnergy,
            crush_energy(0.0) + more,
            Uncertainty::StandardDeviation(sd),
        );
        let answer = question.solve(&ONE_START).expect("it starts at the solution");
        let best = answer.best();
        assert!(best.unknowns[0].value.abs() < 1e-9 && (best.influence[0][1] * certainty - 1.0).abs() < 1e-4, "{best:?}");
        let expected = if is_fold { SD } else { SD / certainty };
        assert!((best.unknowns[0].sd.expect("it is determined") / expected - 1.0).abs() < 1e-4, "{certainty}: {:?}", best.unknowns);
    }
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
        assert!(best.evidence[0].residual.abs() < 1e-6 * best.evidence[0].given && best.evidence[0].standardised_residual().is_none());
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

/// Exact evidence is met to a millionth of its size, or of 1 m/s if it is smaller: halfway to a prior that is as sure as that.
#[test]
fn what_is_exact_is_as_sure_as_a_millionth_of_its_size() {
    let truth = Truth::of(Source::of(25).collision(), 0.5);
    let rate = Variable::Input(Input::YawRate(Side::Two));
    for (value, tolerance) in [(4.0, 4e-6), (-4.0, 4e-6), (0.0, 1e-6)] {
        let question = ReconstructionProblem::of(truth.collision).prior(rate, value + 2.0 * tolerance, tolerance).evidence(
            Measurand::Variable(rate),
            value,
            Uncertainty::Exact,
        );
        let answer = question.solve(&ONE_START).expect("it has an answer");
        let best = answer.best();
        assert!((best.unknowns[0].value - value - tolerance).abs() < 1e-3 * tolerance, "{value}: {:?}", best.unknowns);
        assert!((best.chi_square - 2.0).abs() < 1e-3, "{value}: {}", best.chi_square);
    }
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
            question.skid_speeds = [Some(0.0); 2];
            let answer = question.solve(&ONE_START).expect("it starts at the truth");
            let fitted = answer.best().evidence[0];
            assert!((fitted.computed - truth.measured(of)).abs() <= 1e-9 * fitted.given.abs().max(1.0), "{}: {fitted:?}", of.name());
        }
    }
    // Against a barrier the vehicle has all of the crush energy, whatever the share.
    let truth = Truth::of(straight_into_barrier(0.1), 1.0);
    let speed = Variable::Speed(Side::One);
    let mut question = ReconstructionProblem::of(truth.collision).prior(speed, truth.variable(speed), 1e-3);
    question.crush_share = Some(0.3);
    let question = question.evidence(Measurand::CrushEnergyOf(Side::One), 1e5, Uncertainty::StandardDeviation(1e9));
    let fitted = question.solve(&ONE_START).expect("it starts at the truth").best().evidence[0];
    assert!((fitted.computed / truth.measured(Measurand::CrushEnergy) - 1.0).abs() < 1e-9, "{fitted:?}");
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
