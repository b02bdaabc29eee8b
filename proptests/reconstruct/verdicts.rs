//! Verdicts of questions without a unique answer.

use planar_impact::reconstruct::*;
use planar_impact::*;

use super::scene::{Source, Truth, preferred, straight_into_barrier, with};

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
    // χ² with two degrees of freedom is exponentially distributed.
    assert!((best.probability / (-best.chi_square / 2.0).exp() - 1.0).abs() < 1e-9, "{}", best.probability);
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
    // The bound determines one of the two speeds, the evidence the other.
    assert_eq!(answer.best().degrees_of_freedom, 3 - 1);
    let beyond = answer.without_bounds.expect("it is what the evidence asks for");
    assert!((beyond.unknowns[0].value - speed).abs() < 1e-9 && beyond.is_explained());
}

#[test]
fn a_bound_excludes_nothing_if_the_evidence_does_not_agree_or_leaves_speeds_open_beyond_it() {
    let truth = crash(2);
    let slow = |mut question: ReconstructionProblem| {
        for unknown in &mut question.unknowns {
            let most = truth.variable(unknown.of) - 6.0;
            *unknown = Unknown { max: Some(most), start: most - 1.0, ..*unknown };
        }
        let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
        assert!(answer.best().unknowns.iter().any(|unknown| unknown.at == Some(Bound::Max)), "{:?}", answer.best().unknowns);
        (answer.verdict, answer.without_bounds)
    };
    let magnitude = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
    let contradiction = speeds(&truth, &[AFTER_1[0], AFTER_1[1], (Measurand::CrushEnergy, 3e3)]).evidence(
        magnitude,
        truth.measured(magnitude) + 8.0,
        Uncertainty::StandardDeviation(0.5),
    );
    assert_eq!(slow(contradiction), (Verdict::Contradicted, None));
    let open = speeds(&truth, &[(Measurand::Output(Output::DeltaVMagnitude(Side::One)), 0.3), (magnitude, 0.3)]);
    assert_eq!(slow(open), (Verdict::Contradicted, None));
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
fn a_solution_is_an_alternative_up_to_what_chance_exceeds_in_one_case_of_a_thousand() {
    let count = |answer: &Answer| (answer.verdict, answer.solutions.len(), answer.worse.len());
    assert_eq!(count(&preferred(10.7, 0.0).1), (Verdict::SeveralSolutions, 2, 0));
    assert_eq!(count(&preferred(11.0, 0.0).1), (Verdict::Agrees, 1, 1));
    // With three degrees of freedom chance explains a χ² of up to 16.27.
    assert_eq!(count(&preferred(8.0, 8.0).1), (Verdict::SeveralSolutions, 2, 0));
    assert_eq!(count(&preferred(8.5, 8.0).1), (Verdict::Agrees, 1, 1));
}

/// Two starts may both lead to one of them; a search next to it, along the direction that the evidence constrains least, leads to the other.
#[test]
fn two_solutions_close_to_each_other_are_both_found() {
    let plane = Variable::Input(Input::CrushPlane);
    for angle in [2e-4, 1e-3] {
        let truth = Truth::of(straight_into_barrier(angle), 1.0);
        let of = Measurand::CrushEnergy;
        let question = ReconstructionProblem::of(truth.collision).unknown(plane, 0.1).evidence(
            of,
            truth.measured(of),
            Uncertainty::StandardDeviation(1.0),
        );
        for seed in 0..20 {
            let answer = question.solve(&Search { starts: 2, seed, ..Search::default() }).expect("it has answers");
            let mut planes: Vec<f64> = answer.solutions.iter().map(|solution| solution.unknowns[0].value).collect();
            planes.sort_by(f64::total_cmp);
            let [right, left] = planes[..] else { panic!("{angle}, seed {seed}: {planes:?}") };
            assert!((right + angle).abs() < 1e-6 && (left - angle).abs() < 1e-6, "{planes:?}");
        }
    }
}

#[test]
fn a_minimum_on_a_bound_is_listed() {
    const LEAST: f64 = -20.0;
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
    let mut source = Source::of(17);
    let mut on_bound = 0;
    for case in 0..100 {
        let truth = Truth::of(source.collision(), 0.5);
        let question = speeds(&truth, &[(of, 0.3)]);
        let question = ReconstructionProblem { unknowns: vec![Unknown { min: Some(LEAST), ..question.unknowns[0] }], ..question };
        let residual = |speed: f64| Some(with(&truth.collision, SPEED_1, speed).solve().ok()?.two.delta_v_magnitude() - truth.measured(of));
        let (Some(here), Some(inside)) = (residual(LEAST), residual(LEAST + 1e-3)) else { continue };
        if here.abs() < inside.abs() {
            on_bound += 1;
            let answer = question.solve(&Search { starts: 8, ..Search::default() }).expect("it has an answer");
            let mut all = answer.solutions.iter().chain(&answer.worse);
            assert!(all.any(|solution| solution.unknowns[0].at == Some(Bound::Min)), "case {case}: {here}");
        }
    }
    assert!(on_bound > 0, "{on_bound}");
}

#[test]
fn no_answer_fits_worse_than_where_a_search_stopped() {
    // From the plane that fits worse a search ends at once. After one step those from elsewhere are closer to the other one, but not at their end.
    let (mut question, answer) = preferred(11.0, 0.0);
    question.unknowns[0].start = answer.worse[0].unknowns[0].value;
    let answer = question.solve(&Search { starts: 8, iterations: 1, ..Search::default() });
    let Err(SolveError::NotConverged { nearest, converged: 1.., .. }) = &answer else { panic!("{answer:?}") };
    assert!(nearest.chi_square < 11.0, "{nearest:?}");
}

#[test]
fn starts_are_drawn_up_to_three_standard_deviations_of_a_prior() {
    // The plane that the prior makes less likely, by 0.55 rad or almost two standard deviations, is found too.
    let truth = Truth::of(straight_into_barrier(0.3), 1.0);
    let of = Measurand::CrushEnergy;
    let question = ReconstructionProblem::of(truth.collision).prior(Variable::Input(Input::CrushPlane), 0.25, 0.3).evidence(
        of,
        truth.measured(of),
        Uncertainty::StandardDeviation(1e3),
    );
    let answer = question.solve(&Search::default()).expect("it has answers");
    assert_eq!((answer.verdict, answer.solutions.len()), (Verdict::SeveralSolutions, 2));
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
    // The last start is as far from one turn as from the next: they are one solution all the same.
    for (turns, aside) in [(-3.0, 0.1), (0.0, 0.1), (5.0, 0.1), (0.0, std::f64::consts::FRAC_PI_2)] {
        let start = truth.variable(plane) + aside + turns * std::f64::consts::PI;
        let of = Measurand::DeltaVLeft(Side::One);
        let question = ReconstructionProblem::of(truth.collision).unknown(plane, start).evidence(
            of,
            truth.measured(of),
            Uncertainty::StandardDeviation(0.1),
        );
        let answer = question.solve(&Search::default()).expect("it has an answer");
        let values: Vec<f64> = answer.solutions.iter().map(|solution| solution.unknowns[0].value).collect();
        assert!(values.iter().all(|value| (value - start).abs() <= std::f64::consts::FRAC_PI_2 + 1e-9), "{values:?} from {start}");
        let is_apart =
            |one: f64, other: f64| ((one - other) - std::f64::consts::PI * ((one - other) / std::f64::consts::PI).round()).abs() > 1e-3;
        assert!((1..values.len()).all(|i| values[..i].iter().all(|other| is_apart(values[i], *other))), "{values:?} from {start}");
    }
    // Half a turn of a heading is another collision.
    let heading = Variable::Input(Input::Heading(Side::One));
    let mut question = ReconstructionProblem::of(truth.collision).unknown(heading, 2.5);
    for of in [Measurand::DeltaVLeft(Side::One), Measurand::Output(Output::YawRate(Side::One)), Measurand::CrushEnergy] {
        question = question.evidence(of, truth.measured(of), Uncertainty::StandardDeviation(0.01));
    }
    let answer = question.solve(&Search::default()).expect("it has an answer");
    assert!(answer.best().unknowns[0].value.abs() < 1e-9, "{:?}", answer.best().unknowns);
    assert!(answer.best().evidence.iter().all(|fitted| fitted.residual.abs() < 1e-6), "{:?}", answer.best().evidence);
}

/// Returns the normal work over the plane in steps, on either side of a plane and as far as the mechanics accepts it.
fn works_over_the_plane(collision: &Collision, about: f64, step: f64) -> Vec<(f64, f64)> {
    let work = |k: i32| {
        let plane = about + step * f64::from(k);
        let impact = with(collision, Variable::Input(Input::CrushPlane), plane).solve().ok()?;
        Some((plane, impact.work.n))
    };
    let (below, above) = ((1..).map_while(|k| work(-k)), (0..).map_while(work));
    let limit = (0.6 / step) as usize;
    let mut all: Vec<(f64, f64)> = below.take(limit).collect();
    all.reverse();
    all.extend(above.take(limit));
    all
}

/// More energy than any plane absorbs: the best plane is that of the extremum, where the evidence has no slope. Its curvature determines the plane.
#[test]
fn at_a_fold_the_extremum_is_the_answer_and_its_interval_that_of_a_grid() {
    const STEP: f64 = 1e-4;
    let plane = Variable::Input(Input::CrushPlane);
    let mut source = Source::of(19);
    let mut compared = 0;
    for case in 0..20 {
        // The straight one has its extremum in its axis of symmetry, where the last evidence agrees with it exactly.
        let collision = if case == 0 { straight_into_barrier(0.0) } else { source.collision() };
        let about = collision.crush_plane.angle();
        let grid = works_over_the_plane(&collision, about, STEP);
        let least = grid.iter().copied().reduce(|one, other| if other.1 < one.1 { other } else { one }).expect("the collision itself");
        let [first, last] = [grid[0].0, grid[grid.len() - 1].0];
        let sd = 0.04 * least.1.abs();
        for beyond in [0.3 * sd, 1.5 * sd, 0.0] {
            // Without an extremum the best plane is on a bound, and at one that is not symmetrical an exact agreement is two planes by rounding.
            if !(first + 0.1..last - 0.1).contains(&least.0) || (beyond == 0.0 && case != 0) {
                continue;
            }
            let given = least.1 - beyond;
            let question = ReconstructionProblem::of(collision).between(plane, least.0 + 0.05, first, last).evidence(
                Measurand::Output(Output::NormalWork),
                given,
                Uncertainty::StandardDeviation(sd),
            );
            let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
            assert_eq!((answer.verdict, &answer.not_determined[..]), (Verdict::Agrees, &[][..]), "{case} {beyond}: {answer:?}");
            let [estimate] = answer.best().unknowns[..] else { panic!("{answer:?}") };
            assert!((estimate.value - least.0).abs() < 2.0 * STEP, "{case} {beyond}: {estimate:?}, {least:?}");
            assert_eq!((estimate.is_determined, estimate.sd, &answer.best().at_fold[..]), (true, None, &[plane][..]), "{case} {beyond}");
            let [interval] = question.intervals(&answer, 0.95, &[Measurand::Variable(plane)])[..] else { panic!("no interval") };
            let limit = (beyond / sd).powi(2) + 1.959_963_985_f64.powi(2);
            let within: Vec<f64> =
                grid.iter().filter(|(_, work)| ((given - work) / sd).powi(2) <= limit).map(|(plane, _)| *plane).collect();
            let expected = [within[0], within[within.len() - 1]];
            let off = (interval.low - expected[0]).abs().max((interval.high - expected[1]).abs());
            assert!(off < 2.0 * STEP + 1e-3 * (expected[1] - expected[0]), "{case} {beyond}: {interval:?} for {expected:?}");
            compared += 1;
        }
    }
    assert!(compared >= 20, "{compared} of at most 41");
}

/// A fold and an open direction in one problem: the direction stays open.
#[test]
fn what_is_open_beside_a_fold_stays_open() {
    let (plane, truth) = (Variable::Input(Input::CrushPlane), Truth::of(straight_into_barrier(0.0), 0.5));
    let energy = truth.measured(Measurand::CrushEnergy);
    let question = ReconstructionProblem::of(truth.collision)
        .between(plane, 0.05, -0.6, 0.6)
        .between(Variable::RadiusOfGyration(Side::One), 1.3, 1.0, 1.6)
        .evidence(Measurand::CrushEnergy, 1.02 * energy, Uncertainty::StandardDeviation(0.05 * energy));
    let answer = question.solve(&Search::default()).expect("it has one of many");
    assert_eq!(answer.verdict, Verdict::Undetermined);
    assert!(!answer.determines(Variable::RadiusOfGyration(Side::One)), "{:?}", answer.not_determined);
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
    // Two pieces of evidence determine one direction.
    assert_eq!(answer.best().degrees_of_freedom, 1);
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
    // Between bounds the limit is their distance, and without them twice the spread of speeds, 20 m/s.
    let speed = truth.variable(SPEED_1);
    for (max, limit) in [(Some(60.0), 60.0), (None, 40.0)] {
        for (sd, expected) in [(0.99 * limit, &[][..]), (1.01 * limit, &[SPEED_1][..])] {
            let question = ReconstructionProblem::of(truth.collision)
                .with(Unknown { min: Some(0.0), max, ..Unknown::free(SPEED_1, speed) })
                .evidence(Measurand::Variable(SPEED_1), speed, Uncertainty::StandardDeviation(sd));
            let answer = question.solve(&Search::default()).expect("it has an answer");
            assert_eq!(answer.best().hardly_determined(&question), expected, "{sd} with {max:?}");
        }
    }
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
    // The edge holds it whatever the evidence says.
    assert!(best.influence[0].iter().all(|by| (by * 0.01).abs() < 1e-6), "{:?}", best.influence);
}

#[test]
fn a_contradiction_without_degrees_of_freedom_counts_as_one_with_one() {
    // On the edge of the physics one piece of evidence cannot be met: erfc(√(χ²/2)) is the probability with one degree of freedom.
    let mut truth = crash(5);
    let critical = truth.impact.critical_impulse_ratio();
    truth.collision.impulse_ratio = ImpulseRatio::Given(0.5 * critical);
    let at_edge = Collision { impulse_ratio: ImpulseRatio::Critical, ..truth.collision }.solve().expect("possible").one.after.yaw_rate;
    let toward = (at_edge - truth.collision.solve().expect("possible").one.after.yaw_rate).signum();
    for deviations in [0.5, 1.96, 3.0] {
        let question = ReconstructionProblem::of(truth.collision).unknown(Variable::Input(Input::ImpulseRatio), 0.5 * critical).evidence(
            Measurand::Output(Output::YawRate(Side::One)),
            at_edge + toward * deviations * 0.1,
            Uncertainty::StandardDeviation(0.1),
        );
        let answer = question.solve(&Search::default()).expect("the edge has the best fit");
        let best = answer.best();
        assert!((best.chi_square.sqrt() - deviations).abs() < 1e-3 && !best.limits.is_empty(), "{best:?}");
        assert!((best.probability / libm::erfc((best.chi_square / 2.0).sqrt()) - 1.0).abs() < 1e-9, "{}", best.probability);
    }
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
