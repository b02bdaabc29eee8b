//! A given impulse ratio beside the limit at which the tangential impulse would speed the sliding up, or more than end it.

use planar_impact::reconstruct::*;
use planar_impact::*;

use super::scene::{Source, with};

const SPEED_1: Variable = Variable::Speed(Side::One);
const SPEED_2: Variable = Variable::Speed(Side::Two);
const RESTITUTION: Variable = Variable::Input(Input::Restitution);
const PLANE: Variable = Variable::Input(Input::CrushPlane);
const RATIO: Variable = Variable::Input(Input::ImpulseRatio);

/// The quantile of 95 % of χ² with one degree of freedom (Abramowitz and Stegun, table 26.8).
const QUANTILE: f64 = 3.841_459;

/// An unknown with its start and its bounds.
type Between = (Variable, f64, f64, f64);

/// Evidence of outputs with standard deviations.
type Measured = Vec<(Output, f64, f64)>;

fn asking(collision: Collision, unknowns: &[Between], measured: &[(Output, f64, f64)]) -> ReconstructionProblem {
    let problem = ReconstructionProblem::of(collision);
    measuring(unknowns.iter().fold(problem, |problem, (of, start, min, max)| problem.between(*of, *start, *min, *max)), measured)
}

fn measuring(problem: ReconstructionProblem, measured: &[(Output, f64, f64)]) -> ReconstructionProblem {
    let add = |problem: ReconstructionProblem, (of, value, sd): &(Output, f64, f64)| {
        problem.evidence(Measurand::Output(*of), *value, Uncertainty::StandardDeviation(*sd))
    };
    measured.iter().fold(problem, add)
}

/// Draws points between the bounds of the unknowns; returns those that the mechanics accepts, with their impacts and χ².
fn lawful(collision: Collision, unknowns: &[Between], measured: &Measured, draws: usize) -> Vec<(Collision, Impact, f64)> {
    let mut source = Source::of(7);
    let draw = |_| {
        let at = unknowns.iter().fold(collision, |collision, (of, _, min, max)| with(&collision, *of, source.between(*min, *max)));
        let impact = at.solve().ok()?;
        let chi_square = measured.iter().map(|(of, given, sd)| ((of.of(&at, &impact) - given) / sd).powi(2)).sum();
        Some((at, impact, chi_square))
    };
    (0..draws).filter_map(draw).collect()
}

/// Two cars of which the ratio has the sign that their motion hardly favors: the best fit lies where they do not slide at all.
fn turning_cars(ratio: f64) -> (Collision, [Between; 3], Measured) {
    let car = |mass: f64, yaw_inertia: f64, heading: f64, yaw_rate: f64, [forward, left]: [f64; 2], speed: f64| {
        Vehicle::new(mass, yaw_inertia)
            .with_heading(Heading::from_angle(heading))
            .with_impact_center(forward, left)
            .with_speed(speed)
            .with_yaw_rate(yaw_rate)
    };
    let one = car(3306.0, 3654.0, -0.792, -4.2, [0.815, 0.0356], 5.8);
    let two = car(1466.0, 2667.0, 2.444, -3.367, [1.286, -1.282], 4.0);
    let collision = Collision::new(one, two)
        .with_crush_plane(CrushPlane::from_angle(std::f64::consts::FRAC_PI_2))
        .with_restitution(0.1)
        .with_impulse_ratio(ImpulseRatio::Given(ratio));
    let velocity = [(Output::VelocityX(Side::One), 3.98, 0.5), (Output::VelocityY(Side::One), -1.28, 0.5)];
    let measured = velocity.into_iter().chain([(Output::NormalWork, -45_940.0, 4620.0)]).collect();
    (collision, [(SPEED_1, 5.8, 0.0, 6.8), (SPEED_2, 4.0, 0.0, 60.0), (RESTITUTION, 0.1, 0.0, 0.5)], measured)
}

#[test]
fn a_small_ratio_of_the_other_sign_is_fitted_along_its_limit() {
    let mut before = f64::INFINITY;
    for ratio in [-1e-2, -1e-3, -1e-4, -1e-5, -1e-6, -1e-7, -1e-9, -1e-12] {
        let (collision, unknowns, measured) = turning_cars(ratio);
        let answer = asking(collision, &unknowns, &measured).solve(&Search::default()).expect("it has an answer");
        let best = answer.best();
        assert_eq!((answer.verdict, answer.solutions.len(), &best.limits[..]), (Verdict::Agrees, 1, &[Limit::Sliding][..]), "{ratio}");
        // The less tangential impulse it needs, the closer it comes to the evidence.
        assert!(best.chi_square <= before, "{ratio}: {} after {before}", best.chi_square);
        before = best.chi_square;
        let about = best.unknowns.iter().zip(&unknowns).map(|(estimate, (of, start, min, max))| {
            let value = estimate.value;
            (*of, *start, (value - 0.3).max(*min), (value + 0.3).min(*max))
        });
        let near = lawful(collision, &about.collect::<Vec<_>>(), &measured, 20_000);
        let least = near.iter().map(|(.., chi_square)| *chi_square).fold(f64::INFINITY, f64::min);
        assert!(near.len() > 2000, "{ratio}: {}", near.len());
        assert!((best.chi_square..best.chi_square + 0.5).contains(&least), "{ratio}: {least} is less than {}", best.chi_square);
    }
    assert!(before < 1.6465, "{before}");
}

/// A car beside a wall: on the way to the ends of its intervals the sliding turns round.
fn into_a_wall(ratio: ImpulseRatio) -> ReconstructionProblem {
    let car = Vehicle::new(801.0, 3670.0).with_heading(Heading::from_angle(1.82)).with_impact_center(0.323, 2.6).with_speed(20.1);
    let deviation = Uncertainty::StandardDeviation;
    ReconstructionProblem::of(Collision::new(Party::Barrier, car).with_restitution(0.31).with_impulse_ratio(ratio))
        .unknown(SPEED_2, 20.1)
        .between(PLANE, 0.0151, -0.5, 0.4)
        .prior(Variable::Input(Input::Mass(Side::Two)), 801.0, 24.0)
        .prior(RESTITUTION, 0.31, 0.05)
        .evidence(Measurand::DeltaVForward(Side::Two), -1.66, deviation(0.5))
        .evidence(Measurand::DeltaVLeft(Side::Two), -4.58, deviation(0.5))
        .evidence(Measurand::Output(Output::NormalWork), -7330.0, deviation(715.0))
}

/// Two cars that would stick only if the impulse could pull.
fn without_sticking(ratio: ImpulseRatio) -> ReconstructionProblem {
    let one = Vehicle::new(2084.7, 3176.8).with_heading(Heading::from_angle(-2.9914)).with_impact_center(-1.5887, -2.01);
    let two = Vehicle::new(2451.7, 12_276.6).with_heading(Heading::from_angle(-1.073)).with_impact_center(1.4468, 0.0466);
    let collision = Collision::new(one.with_speed(39.7).with_yaw_rate(2.2403), two.with_speed(26.4)).with_impulse_ratio(ratio);
    let problem = ReconstructionProblem::of(collision)
        .prior(Variable::Input(Input::YawInertia(Side::One)), 3176.8, 158.8)
        .prior(SPEED_1, 39.731, 1.0)
        .between(SPEED_2, 26.4, 0.0, 43.66)
        .between(RESTITUTION, 0.1, 0.0, 1.0)
        .between(PLANE, 1.5385, 1.0708, 1.9708);
    let measured = [
        (Output::YawRate(Side::One), -2.6927, 0.2),
        (Output::YawRate(Side::Two), 0.7388, 0.2),
        (Output::DeltaVMagnitude(Side::One), 5.4649, 0.5),
        (Output::VelocityX(Side::Two), 11.8222, 0.8),
        (Output::VelocityY(Side::Two), -15.9824, 0.8),
        (Output::NormalWork, -126_424.7, 10_961.9),
    ];
    measuring(problem, &measured)
}

/// Neither has a limit: without a tangential impulse, nothing ends the sliding or speeds it up, and what sticking would need does not matter.
#[test]
fn a_ratio_of_zero_is_none_of_the_critical_one_and_no_friction() {
    for (problem, side, low) in [(into_a_wall as fn(ImpulseRatio) -> _, Side::Two, 4.6816), (without_sticking, Side::One, 5.6735)] {
        let of = [Measurand::Variable(SPEED_2), Measurand::Variable(PLANE), Measurand::Output(Output::DeltaVMagnitude(side))];
        let intervals = |ratio| {
            let problem = problem(ratio);
            problem.intervals(&problem.solve(&Search::default()).expect("it has an answer"), 0.95, &of)
        };
        let [given, none, smooth] =
            [ImpulseRatio::Given(0.0), ImpulseRatio::OfCritical(0.0), ImpulseRatio::LimitedByFriction(0.0)].map(intervals);
        for other in [none, smooth] {
            for (one, other) in given.iter().zip(other) {
                let near = |x: f64, y: f64| (x - y).abs() < 1e-3 * (one.high - one.low);
                assert!(near(one.low, other.low) && near(one.high, other.high), "{one:?} {other:?}");
            }
        }
        let [.., delta_v] = &given[..] else { panic!("three intervals") };
        let is_physics = matches!(delta_v.low_limited_by, Some(Limit::Sliding | Limit::Tension));
        assert!((delta_v.low - low).abs() < 1e-3 && !is_physics, "{delta_v:?}");
    }
}

/// A car meets a wall nearly along its normal: on either side of that the ratio has another sign, and both meet where it has none.
#[test]
fn an_unknown_ratio_goes_on_with_the_other_sign() {
    let car = Vehicle::new(1400.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0);
    for plane in [-0.03, 0.02] {
        let collision = Collision::new(car, Party::Barrier)
            .with_restitution(0.1)
            .with_crush_plane(CrushPlane::from_angle(plane))
            .with_impulse_ratio(ImpulseRatio::Given(0.2 * plane));
        let unknowns = [(SPEED_1, 15.0, 5.0, 25.0), (PLANE, plane, -0.6, 0.6), (RATIO, 0.2 * plane, -0.4, 0.4)];
        let measured = vec![
            (Output::VelocityX(Side::One), -1.5, 0.3),
            (Output::VelocityY(Side::One), 0.2 * plane, 0.4),
            (Output::YawRate(Side::One), 0.0, 0.6),
            (Output::Loss, 157_000.0, 9e3),
        ];
        let problem = asking(collision, &unknowns, &measured);
        // A search from elsewhere would find the other sign by itself.
        let answer = problem.solve(&Search { starts: 1, ..Search::default() }).expect("it has an answer");
        assert!(answer.solutions.len() == 1 && answer.worse.is_empty());
        let outputs = [Output::DeltaVMagnitude(Side::One), Output::PrincipalDirectionOfForce(Side::One), Output::NormalWork];
        let of = unknowns.iter().map(|(of, ..)| Measurand::Variable(*of)).chain(outputs.map(Measurand::Output));
        let intervals = problem.intervals(&answer, 0.95, &of.collect::<Vec<_>>());
        let mut seen = [0; 2];
        for (at, impact, chi_square) in lawful(collision, &unknowns, &measured, 400_000) {
            if chi_square > answer.best().chi_square + QUANTILE {
                continue;
            }
            seen[usize::from(impact.impulse_ratio() > 0.0)] += 1;
            let Party::Vehicle(car) = at.one else { panic!("a car") };
            let ImpulseRatio::Given(ratio) = at.impulse_ratio else { panic!("a ratio") };
            let values = [car.motion.velocity.x, at.crush_plane.sin.atan2(at.crush_plane.cos), ratio];
            for (interval, value) in intervals.iter().zip(values.into_iter().chain(outputs.map(|of| of.of(&at, &impact)))) {
                let slack = 2e-3 * (interval.high - interval.low);
                assert!((interval.low - slack..=interval.high + slack).contains(&value), "{value} with {values:?}: {interval:?}");
            }
        }
        assert!(seen.iter().all(|count| *count > 200), "{seen:?}");
        let [_, plane, ratio, ..] = &intervals[..] else { panic!("six intervals") };
        assert!(plane.low < 0.0 && plane.high > 0.0 && ratio.low < 0.0 && ratio.high > 0.0, "{intervals:?}");
    }
}

/// The best fits of a ratio of zero and of one that is hardly more lie at other crush planes: it goes on from one to the other along zero.
#[test]
fn an_interval_of_a_ratio_goes_on_beyond_zero() {
    let one = Vehicle::new(2606.0, 3983.0).with_heading(Heading::from_angle(0.451)).with_impact_center(-2.02, -0.9).with_speed(11.75);
    let two = Vehicle::new(2461.0, 4938.0).with_heading(Heading::from_angle(1.131)).with_impact_center(0.94, 0.76).with_speed(9.89);
    let sd = Uncertainty::StandardDeviation;
    for mirror in [1.0, -1.0] {
        let image = |car: Vehicle| {
            let arm = car.impact_center;
            let heading = Heading { sin: mirror * car.heading.sin, ..car.heading };
            let speed = car.motion.velocity.length();
            car.with_heading(heading).with_impact_center(arm.forward, mirror * arm.left).with_speed(speed)
        };
        let collision =
            Collision::new(image(one), image(two)).with_restitution(0.259).with_impulse_ratio(ImpulseRatio::Given(-0.2 * mirror));
        let problem = ReconstructionProblem::of(collision.with_crush_plane(CrushPlane::from_angle(-0.364 * mirror)))
            .between(SPEED_1, 11.75, 0.0, 45.0)
            .between(SPEED_2, 9.89, 0.0, 45.0)
            .between(PLANE, -0.364 * mirror, if mirror > 0.0 { -0.702 } else { 0.102 }, if mirror > 0.0 { -0.102 } else { 0.702 })
            .between(RATIO, -0.2055 * mirror, -1.2, 1.2)
            .evidence(Measurand::CrushEnergy, 12_064.169, sd(1370.153))
            .evidence(Measurand::Output(Output::YawRate(Side::Two)), -0.429 * mirror, sd(0.25))
            .evidence(Measurand::Output(Output::VelocityX(Side::Two)), 6.395, sd(0.5))
            .evidence(Measurand::Output(Output::VelocityY(Side::Two)), 9.086 * mirror, sd(0.5))
            .evidence(Measurand::Output(Output::YawRate(Side::One)), -2.667 * mirror, sd(0.25))
            .evidence(Measurand::DeltaVForward(Side::Two), -0.887, sd(0.5))
            .evidence(Measurand::Output(Output::DeltaVMagnitude(Side::One)), 2.345, sd(0.5));
        let answer = problem.solve(&Search::default()).expect("it has an answer");
        let [ratio] = problem.intervals(&answer, 0.95, &[Measurand::Variable(RATIO)])[..] else { panic!("one") };
        // A fixed ratio of 0.0097 has χ² 5.0819, and one of 0.0099 has 5.0850: 3.8415 more than the least is 5.0825.
        let end = if mirror > 0.0 { ratio.high } else { -ratio.low };
        assert!((0.0097..0.0099).contains(&end), "{mirror}: {ratio:?}");
    }
}
