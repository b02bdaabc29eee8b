//! Verdicts of questions without a unique answer.

use planar_impact::reconstruct::*;
use planar_impact::*;

use super::scene::{Source, Truth};

const SPEED_1: Variable = Variable::Speed(Side::One);
const SPEED_2: Variable = Variable::Speed(Side::Two);

fn crash(seed: u64) -> Truth {
    Truth::of(Source::of(seed).collision(), 0.4)
}

/// Returns the question for both speeds, from given evidence.
fn speeds(truth: &Truth, evidence: &[(Measurand, f64)]) -> ReconstructionProblem {
    let question = ReconstructionProblem::of(truth.collision).between(SPEED_1, 15.0, 0.0, 60.0).between(SPEED_2, 15.0, 0.0, 60.0);
    evidence.iter().fold(question, |question, &(of, sd)| question.evidence(of, truth.measured(of), Uncertainty::StandardDeviation(sd)))
}

const AFTER_1: [(Measurand, f64); 2] =
    [(Measurand::Output(Output::VelocityX(Side::One)), 0.5), (Measurand::Output(Output::VelocityY(Side::One)), 0.5)];

#[test]
fn evidence_that_contradicts_itself_is_called_so() {
    let truth = crash(1);
    let delta_v = truth.impact.two.delta_v_magnitude();
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
    let question = speeds(&truth, &[AFTER_1[0], AFTER_1[1], (Measurand::CrushEnergy, 5e3)]);
    let question = question.evidence(of, delta_v + 8.0, Uncertainty::StandardDeviation(0.5));
    let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
    assert_eq!(answer.verdict, Verdict::Contradicted);
    let best = answer.best();
    assert!(best.degrees_of_freedom == 2 && best.probability < Answer::CONTRADICTION && best.chi_square > 10.83);
    let by_hand: f64 = best.evidence.iter().filter_map(Fitted::standardised_residual).map(|z| z * z).sum();
    assert!((best.chi_square / by_hand - 1.0).abs() < 1e-12);
}

#[test]
fn as_much_as_chance_explains_is_no_contradiction() {
    let truth = crash(1);
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
    let near = truth.impact.two.delta_v_magnitude() + 0.5;
    let question = speeds(&truth, &AFTER_1).evidence(of, near, Uncertainty::StandardDeviation(0.5));
    assert_eq!(question.solve(&Search::default()).expect("it has an answer").verdict, Verdict::Agrees);
}

#[test]
fn bounds_that_leave_the_solution_out_are_named() {
    let truth = crash(2);
    let speed = truth.variable(SPEED_1);
    let mut question = speeds(&truth, &[AFTER_1[0], AFTER_1[1], (Measurand::CrushEnergy, 3e3)]);
    question.unknowns[0] = Unknown { max: Some(speed - 6.0), start: speed - 7.0, ..question.unknowns[0] };
    let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
    assert_eq!(answer.verdict, Verdict::BoundsExclude);
    assert_eq!((answer.best().unknowns[0].at, answer.best().unknowns[0].value), (Some(Bound::Max), speed - 6.0));
    assert_eq!(answer.best().unknowns[0].sd, None);
    let beyond = answer.without_bounds.expect("it is what the evidence asks for");
    assert!((beyond.unknowns[0].value - speed).abs() < 1e-9 && beyond.is_explained());
}

/// Returns a car that drives straight into a barrier, with a crush plane that may be oblique to its path.
fn straight_into_barrier(crush_plane: f64) -> Collision {
    let car = Vehicle {
        mass: 1500.0,
        yaw_inertia: 2500.0,
        heading: Heading::from_angle(0.0),
        impact_center: ForwardLeft { forward: 2.0, left: 0.0 },
        motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
    };
    Collision {
        one: car.into(),
        two: Party::Barrier,
        crush_plane: CrushPlane::from_angle(crush_plane),
        restitution: 0.1,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

#[test]
fn both_of_two_solutions_are_returned() {
    // Straight into a barrier, a crush plane turned to the left absorbs the same energy as one turned to the right.
    let collision = straight_into_barrier(0.3);
    let plane = Variable::Input(Input::CrushPlane);
    let truth = Truth::of(collision, 1.0);
    let question = ReconstructionProblem::of(collision).between(plane, 0.1, -0.6, 0.6).evidence(
        Measurand::CrushEnergy,
        truth.measured(Measurand::CrushEnergy),
        Uncertainty::StandardDeviation(2e3),
    );
    let answer = question.solve(&Search::default()).expect("it has answers");
    assert_eq!(answer.verdict, Verdict::SeveralSolutions);
    let mut planes: Vec<f64> = answer.solutions.iter().map(|solution| solution.unknowns[0].value).collect();
    planes.sort_by(f64::total_cmp);
    let [right, left] = planes[..] else { panic!("{planes:?}") };
    assert!((right + 0.3).abs() < 1e-9 && (left - 0.3).abs() < 1e-9, "{planes:?}");
}

#[test]
fn what_is_open_is_named_with_how_it_moves() {
    let truth = crash(3);
    let magnitude = |side| (Measurand::Output(Output::DeltaVMagnitude(side)), 0.3);
    let answer = speeds(&truth, &[magnitude(Side::One), magnitude(Side::Two)]).solve(&Search::default()).expect("it has one of many");
    assert_eq!(answer.verdict, Verdict::Undetermined);
    let [direction] = &answer.not_determined[..] else { panic!("{:?}", answer.not_determined) };
    assert_eq!(direction.variables().collect::<Vec<_>>(), [SPEED_1, SPEED_2]);
    assert!(answer.best().unknowns.iter().all(|unknown| !unknown.is_determined && unknown.sd.is_none()));
    assert!(!answer.determines(SPEED_1));
    // A step along it does not change any evidence.
    let mut stepped = truth.collision;
    for (variable, by) in &direction.parts {
        let party = if *variable == SPEED_1 { &mut stepped.one } else { &mut stepped.two };
        if let Party::Vehicle(car) = party {
            let along = car.heading.to_ground(ForwardLeft { forward: 1e-4 * by, left: 0.0 });
            car.motion.velocity += along;
        }
    }
    let delta_v = stepped.solve().expect("near a possible one").two.delta_v_magnitude();
    let at_truth = truth.impact.two.delta_v_magnitude();
    assert!((delta_v - at_truth).abs() < 1e-6 && delta_v != at_truth);
}

#[test]
fn evidence_that_no_unknown_moves_is_none() {
    // If plane and ratio are given, the force has one direction at any speeds.
    let mut truth = crash(13);
    truth.collision.impulse_ratio = ImpulseRatio::Given(truth.impact.impulse_ratio());
    let truth = Truth::of(truth.collision, 0.5);
    let pdof = Measurand::Output(Output::PrincipalDirectionOfForce(Side::One));
    let answer = speeds(&truth, &[(Measurand::Output(Output::YawRate(Side::One)), 0.1), (pdof, 0.05)]).solve(&Search::default());
    assert_eq!(answer.expect("it has one of many").verdict, Verdict::Undetermined);
}

#[test]
fn an_angle_comes_back_as_the_turn_that_is_nearest_to_its_start() {
    let truth = crash(14);
    let plane = Variable::Input(Input::CrushPlane);
    for turns in [-3.0, 0.0, 5.0] {
        let start = truth.variable(plane) + 0.1 + turns * std::f64::consts::PI;
        let of = Measurand::DeltaVLeft(Side::One);
        let question = ReconstructionProblem::of(truth.collision).unknown(plane, start).evidence(
            of,
            truth.measured(of),
            Uncertainty::StandardDeviation(0.1),
        );
        let answer = question.solve(&Search::default()).expect("it has an answer");
        for solution in &answer.solutions {
            assert!(
                (solution.unknowns[0].value - start).abs() <= std::f64::consts::FRAC_PI_2,
                "{} from {start}",
                solution.unknowns[0].value
            );
        }
    }
}

#[test]
fn where_the_slope_has_nothing_to_say_curvature_does_not_make_it_sure() {
    // The fraction of the normal work is smallest if the plane is perpendicular to the approach: there it does not
    // determine the plane to first order.
    let collision = straight_into_barrier(1e-4);
    let (plane, truth) = (Variable::Input(Input::CrushPlane), Truth::of(collision, 1.0));
    // More energy than any plane absorbs: the best plane is perpendicular, where the residual has curvature but no slope.
    let question = ReconstructionProblem::of(collision).between(plane, 1e-3, -0.6, 0.6).evidence(
        Measurand::CrushEnergy,
        1.05 * truth.measured(Measurand::CrushEnergy),
        Uncertainty::StandardDeviation(0.05 * truth.measured(Measurand::CrushEnergy)),
    );
    let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
    let vague = answer.best().hardly_determined(&question);
    assert!(answer.verdict == Verdict::Undetermined || vague == [plane], "{answer:?}");
}

#[test]
fn part_of_the_unknowns_can_be_determined() {
    // ΔV of one vehicle determines its speed against a standing one; nothing determines the crush share.
    let truth = crash(4);
    let mut question =
        ReconstructionProblem::of(truth.collision).between(SPEED_1, 15.0, 0.0, 60.0).between(Variable::CrushShare, 0.5, 0.0, 1.0);
    for of in [Measurand::DeltaVForward(Side::One), Measurand::DeltaVLeft(Side::One)] {
        question = question.evidence(of, truth.measured(of), Uncertainty::StandardDeviation(0.3));
    }
    let answer = question.solve(&Search::default()).expect("it has one of many");
    assert_eq!(answer.verdict, Verdict::Undetermined);
    assert!(answer.determines(SPEED_1) && !answer.determines(Variable::CrushShare));
    let [speed, share] = &answer.best().unknowns[..] else { panic!() };
    assert!((speed.value - truth.variable(SPEED_1)).abs() < 1e-9 && speed.sd.is_some());
    assert!(share.sd.is_none() && !share.is_determined);
}

#[test]
fn unknowns_that_the_evidence_barely_constrains_are_named() {
    let truth = crash(4);
    let plane = Variable::Input(Input::CrushPlane);
    let of = |sd| {
        let question = ReconstructionProblem::of(truth.collision)
            .between(SPEED_1, 15.0, 0.0, 60.0)
            .between(plane, 0.0, -0.8, 0.8)
            .evidence(Measurand::CrushEnergy, truth.measured(Measurand::CrushEnergy), Uncertainty::StandardDeviation(2e3))
            .evidence(AFTER_1[0].0, truth.measured(AFTER_1[0].0), Uncertainty::StandardDeviation(sd));
        let answer = question.solve(&Search::default()).expect("it has an answer");
        answer.best().hardly_determined(&question)
    };
    assert_eq!(of(1e-3), []);
    assert!(of(1e4).contains(&plane));
}

#[test]
fn evidence_that_leads_to_the_impossible_ends_at_its_edge() {
    // More tangential impulse than ends the sliding.
    let mut truth = crash(5);
    let critical = truth.impact.critical_impulse_ratio();
    truth.collision.impulse_ratio = ImpulseRatio::Given(0.5 * critical);
    let sliding = Truth::of(truth.collision, 0.5);
    let beyond = Collision { impulse_ratio: ImpulseRatio::Given(1.6 * critical), ..truth.collision }.evaluate();
    let question = ReconstructionProblem::of(sliding.collision)
        .unknown(Variable::Input(Input::ImpulseRatio), 0.5 * critical)
        .evidence(Measurand::Output(Output::YawRate(Side::One)), beyond.one.after.yaw_rate, Uncertainty::StandardDeviation(0.01))
        .evidence(Measurand::Output(Output::YawRate(Side::Two)), beyond.two.after.yaw_rate, Uncertainty::StandardDeviation(0.01));
    let answer = question.solve(&Search::default()).expect("the edge has the best fit");
    let best = answer.best();
    assert_eq!((answer.verdict, &best.limits[..]), (Verdict::Contradicted, &[Limit::Sliding][..]));
    assert!(best.chi_square > 10.0 && best.unknowns[0].sd.is_none());
    // On the edge friction ends the sliding, as closely as the margin of rounding allows.
    assert!((best.unknowns[0].value / best.impact.critical_impulse_ratio() - 1.0).abs() < 1e-6, "{:?}", best.unknowns);
}

#[test]
fn too_few_steps_are_no_answer() {
    let truth = crash(6);
    let search = Search { starts: 3, iterations: 1, ..Search::default() };
    let unsolved = speeds(&truth, &[AFTER_1[0], (Measurand::CrushEnergy, 1e3)]).solve(&search);
    let Err(SolveError::NotConverged { nearest, searches: 3, converged: 0 }) = &unsolved else { panic!("{unsolved:?}") };
    assert!(nearest.beyond.is_none() && nearest.step > 1e-9);
    let text = unsolved.expect_err("as matched").to_string();
    assert!(text.starts_with("none of 3 searches converged; the nearest stopped after ") && text.contains("chi-square"), "{text}");
}

#[test]
fn a_moment_is_found_from_none() {
    let truth = crash(12);
    for (moment, none) in [(Moment::Given(800.0), Moment::Given(0.0)), (Moment::OfCritical(0.4), Moment::OfCritical(0.0))] {
        let turned = Truth::of(Collision { moment, ..truth.collision }, 0.5);
        let of = Measurand::Output(Output::YawRate(Side::Two));
        let asked = Variable::Input(Input::Moment);
        let question = ReconstructionProblem::of(Collision { moment: none, ..truth.collision }).unknown(asked, 0.0).evidence(
            of,
            turned.measured(of),
            Uncertainty::StandardDeviation(0.05),
        );
        let answer = question.solve(&Search::default()).expect("it has an answer");
        assert_eq!(answer.verdict, Verdict::Agrees);
        assert!((answer.best().unknowns[0].value - turned.variable(asked)).abs() < 1e-6, "{:?}", answer.best().unknowns);
    }
}

#[test]
fn a_pair_that_never_closes_has_no_start() {
    let truth = crash(7);
    let Party::Vehicle(mut car) = truth.collision.one else { panic!() };
    car.motion.velocity = Xy { x: -80.0, y: 0.0 };
    let leaving = Collision { one: car.into(), ..truth.collision };
    let question =
        ReconstructionProblem::of(leaving).between(SPEED_2, 1.0, 0.0, 2.0).evidence(Measurand::CrushEnergy, 1e4, Uncertainty::Exact);
    let unsolved = question.solve(&Search::default());
    let Err(SolveError::NoStart { refusals, .. }) = &unsolved else { panic!("{unsolved:?}") };
    assert!(matches!(refusals.as_slice(), [Refusal::NotClosing { .. }]));
}

#[test]
fn every_problem_of_a_question_is_reported_at_once() {
    let truth = crash(8);
    let barrier = Collision { two: Party::Barrier, impulse_ratio: ImpulseRatio::Critical, ..truth.collision };
    let sd = Uncertainty::StandardDeviation;
    let question = ReconstructionProblem::of(barrier)
        .unknown(SPEED_1, f64::NAN)
        .unknown(SPEED_1, 3.0)
        .unknown(SPEED_2, 3.0)
        .unknown(Variable::Input(Input::VelocityX(Side::One)), 3.0)
        .unknown(Variable::Input(Input::ImpulseRatio), 0.3)
        .between(Variable::Input(Input::Restitution), 0.5, 0.3, 0.2)
        .between(Variable::Input(Input::CrushPlane), 0.5, 0.1, 0.2)
        .between(Variable::Input(Input::Mass(Side::One)), 1e3, -5.0, 2e3)
        .prior(Variable::Input(Input::YawRate(Side::One)), 0.0, 0.0)
        .evidence(Measurand::CrushEnergy, f64::INFINITY, sd(1.0))
        .evidence(Measurand::CrushEnergy, 1e4, sd(-1.0))
        .evidence(Measurand::SeparationSpeed(Side::Two), -1e4, Uncertainty::Resolution(0.0));
    let question = ReconstructionProblem {
        correlations: vec![Correlation { one: SAME, other: SAME, coefficient: 0.5 }],
        crush_share: Some(1.5),
        ..question
    };
    let problems = question.check().expect_err("everything is wrong with it");
    let codes = |codes: &[&str]| problems.iter().filter(|problem| codes.contains(&problem.code())).count();
    let has = |wanted: fn(&ReconstructionIssue) -> bool| problems.iter().filter(|problem| wanted(problem)).count();
    assert_eq!(
        has(
            |p| matches!(p, ReconstructionIssue::Unknown { of: SPEED_1, issue } if issue.code() == "not-finite" && issue.at.part == Some("start"))
        ),
        1
    );
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::UnknownTwice(SPEED_1))), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::NotInCase(_))), 2);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::SpeedAndVelocity(Side::One))), 2);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::BoundsCrossed { .. })), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::StartOutside { .. })), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::BoundOutside { bound: -5.0, .. })), 1);
    assert_eq!(codes(&["not-positive"]), 3);
    assert_eq!(
        has(|p| matches!(p, ReconstructionIssue::Evidence { issue, .. } if issue.code() == "not-finite" && issue.at.part.is_none())),
        1
    );
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::EvidenceTwice(_))), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::NothingToMeasure(_))), 1);
    assert_eq!(
        has(|p| matches!(
            p,
            ReconstructionIssue::Evidence { issue: InputIssue { kind: InputIssueKind::OutOfRange { value: -1e4, .. }, .. }, .. }
        )),
        1
    );
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::CorrelationOfNothing(..))), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::Unknown { of: Variable::CrushShare, issue } if issue.code() == "out-of-range")), 1);
    assert_eq!(has(|p| matches!(p, ReconstructionIssue::TooLittleEvidence { evidence: 4, .. })), 1);
    // NaN does not equal itself.
    let Err(SolveError::Problems(again)) = question.solve(&Search::default()) else { panic!("it cannot be asked") };
    assert_eq!(format!("{again:?}"), format!("{problems:?}"));
    let text = problems.to_string();
    assert!(problems.iter().all(|problem| text.contains(&problem.to_string())));
}

const SAME: Measurand = Measurand::CrushEnergy;

#[test]
fn nothing_unknown_and_a_share_unsaid_are_problems() {
    let truth = crash(9);
    let nothing = ReconstructionProblem::of(truth.collision).check().expect_err("nothing is asked");
    assert_eq!(nothing.as_slice(), [ReconstructionIssue::NothingUnknown]);
    let of = Measurand::CrushEnergyOf(Side::One);
    let question = ReconstructionProblem::of(truth.collision).unknown(SPEED_1, 10.0).evidence(of, 5e4, Uncertainty::Exact);
    assert_eq!(question.check().expect_err("whose share?").as_slice(), [ReconstructionIssue::ShareUnknown(of)]);
    let known = ReconstructionProblem { crush_share: Some(0.4), ..question };
    assert!(known.check().is_ok());
}

#[test]
fn correlations_that_cannot_be_are_refused_with_their_eigenvalue() {
    let truth = crash(10);
    let mut question = speeds(&truth, &[AFTER_1[0], AFTER_1[1], (Measurand::CrushEnergy, 3e3)]);
    let [x, y, energy] = [AFTER_1[0].0, AFTER_1[1].0, Measurand::CrushEnergy];
    let pair = |one, other, coefficient| Correlation { one, other, coefficient };
    question.correlations = vec![pair(x, y, 0.9), pair(y, energy, 0.9), pair(x, energy, -0.9)];
    let problems = question.check().expect_err("they contradict each other");
    // The matrix with ±0.9 off the diagonal, one of three negative, has the eigenvalue 1 − 2 × 0.9.
    let [ReconstructionIssue::CorrelationsImpossible { eigenvalue }] = problems.as_slice() else { panic!("{problems}") };
    assert!((eigenvalue + 0.8).abs() < 1e-12);
    question.correlations = vec![pair(x, y, f64::NAN)];
    assert!(matches!(question.check().expect_err("no number").as_slice(), [ReconstructionIssue::CorrelationsImpossible { .. }]));
}

/// Every size of a deviation: the answer has a finite deviation above zero for each determined unknown, or the deviation is refused by name.
#[test]
fn deviations_of_every_size_are_refused_or_lawful() {
    let truth = crash(1);
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
    let mut answers = 0;
    for power in [-300, -200, -60, -49, -8, 0, 8, 49, 60, 200, 300] {
        let sd = 10_f64.powi(power);
        let with_evidence =
            speeds(&truth, &[(AFTER_1[0].0, sd), (AFTER_1[1].0, sd)]).evidence(of, truth.measured(of), Uncertainty::StandardDeviation(sd));
        let mut with_prior = speeds(&truth, &AFTER_1);
        with_prior.unknowns[0].prior = Some(sd);
        for question in [with_evidence, with_prior] {
            let answer = match question.solve(&Search { starts: 4, ..Search::default() }) {
                Err(SolveError::Problems(issues)) => {
                    assert!(power.abs() > 50 && issues.iter().all(|issue| issue.code() == "out-of-range"), "1e{power}: {issues}");
                    continue;
                }
                Err(other) => panic!("1e{power}: {other}"),
                Ok(answer) => answer,
            };
            assert!(power.abs() <= 50, "1e{power} is answered");
            answers += 1;
            for unknown in &answer.best().unknowns {
                assert!(unknown.sd.is_none_or(|sd| sd.is_finite() && sd > 0.0), "1e{power}: {unknown:?}");
                assert!(unknown.sd.is_some() || answer.verdict != Verdict::Agrees, "1e{power}: {:?} {unknown:?}", answer.verdict);
            }
        }
    }
    assert_eq!(answers, 2 * 5);
}
