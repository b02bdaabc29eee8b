//! Intervals in cases whose ends are known by hand, and the limits that make them.

use std::f64::consts::PI;

use planar_impact::reconstruct::*;
use planar_impact::*;

use super::scene::{Source, Truth, preferred, straight_into_barrier, with};

const SPEED: Variable = Variable::Speed(Side::One);
const RESTITUTION: Variable = Variable::Input(Input::Restitution);
const PLANE: Variable = Variable::Input(Input::CrushPlane);

const ONE_START: Search = Search { starts: 1, seed: 1, iterations: 200 };

fn intervals(problem: &ReconstructionProblem, level: f64, of: &[Measurand]) -> Vec<Interval> {
    let answer = problem.solve(&ONE_START).expect("it has an answer");
    problem.intervals(&answer, level, of)
}

fn interval(problem: &ReconstructionProblem, of: Measurand) -> Interval {
    let [interval] = intervals(problem, 0.95, &[of])[..] else { panic!("one for {}", of.name()) };
    interval
}

/// Returns the problem of one unknown without bounds, known directly to a standard deviation.
fn direct(collision: Collision, of: Variable, value: f64, sd: f64) -> ReconstructionProblem {
    ReconstructionProblem::of(collision).unknown(of, value).evidence(Measurand::Variable(of), value, Uncertainty::StandardDeviation(sd))
}

fn bounded(mut problem: ReconstructionProblem, min: f64, max: f64) -> ReconstructionProblem {
    (problem.unknowns[0].min, problem.unknowns[0].max) = (Some(min), Some(max));
    problem
}

#[test]
fn intervals_of_linear_evidence_are_those_of_the_normal_distribution() {
    // ΔV straight into a barrier is (1 + e) times the speed.
    let problem = direct(straight_into_barrier(0.0), SPEED, 15.0, 0.5);
    let delta_v = Measurand::Output(Output::DeltaVMagnitude(Side::One));
    // Quantiles of the normal distribution (Abramowitz and Stegun, table 26.5).
    for (level, quantile) in [(0.5, 0.674_490), (0.9, 1.644_854), (0.95, 1.959_964), (0.99, 2.575_829)] {
        let found = intervals(&problem, level, &[Measurand::Variable(SPEED), delta_v]);
        for (interval, factor) in found.iter().zip([1.0, 1.1]) {
            let sd = factor * 0.5;
            assert!((interval.value - factor * 15.0).abs() < 1e-9 && (interval.sd.expect("it has one") / sd - 1.0).abs() < 1e-9);
            for (end, expected) in [(interval.low, -quantile * sd), (interval.high, quantile * sd)] {
                assert!((end - interval.value - expected).abs() < 1e-3 * sd, "{level}: {interval:?}");
            }
            assert_eq!((interval.level, interval.low_limited_by, interval.high_limited_by), (level, None, None));
            assert!(interval.narrows);
        }
        assert_eq!(found.len(), 2);
    }
}

/// A search that is stopped returns no interval, and one that is watched to its end returns the same ones.
#[test]
fn a_search_for_intervals_stops_when_it_is_told_to() {
    let problem = direct(straight_into_barrier(0.0), SPEED, 15.0, 0.5);
    let of = [Measurand::Variable(SPEED), Measurand::Output(Output::DeltaVMagnitude(Side::One))];
    let answer = problem.solve(&ONE_START).expect("it has an answer");
    let seen = std::cell::RefCell::new(Vec::new());
    let found = problem.intervals_while(&answer, 0.95, &of, &|done, steps| {
        seen.borrow_mut().push((done, steps));
        true
    });
    assert_eq!(found, Some(problem.intervals(&answer, 0.95, &of)));
    assert_eq!(seen.into_inner(), [(0, 4), (1, 4), (2, 4), (3, 4)]);
    for last in 0..4 {
        assert_eq!(problem.intervals_while(&answer, 0.95, &of, &|done, _| done < last), None, "{last}");
    }
}

#[test]
fn a_bound_of_its_own_ends_an_interval_and_is_named() {
    let of = |value: f64, sd: f64| {
        interval(&bounded(direct(straight_into_barrier(0.0), SPEED, value, sd), 5.0, 60.0), Measurand::Variable(SPEED))
    };
    let [min, max] = [Bound::Min, Bound::Max].map(|bound| Some(Limit::Bound(SPEED, bound)));
    let (low, high, both) = (of(6.0, 1.0), of(59.0, 1.0), of(30.0, 100.0));
    assert_eq!((low.low, low.low_limited_by, low.high_limited_by, low.narrows), (5.0, min, None, true));
    assert_eq!((high.high, high.high_limited_by, high.low_limited_by, high.narrows), (60.0, max, None, true));
    assert_eq!((both.low, both.high, both.low_limited_by, both.high_limited_by, both.narrows), (5.0, 60.0, min, max, false));
}

#[test]
fn a_bound_of_another_unknown_ends_an_interval_and_is_named() {
    // ΔV is (1 + e) times the speed, and of e only the bounds are known.
    let collision = straight_into_barrier(0.0);
    let problem = ReconstructionProblem::of(collision).unknown(SPEED, 15.0).between(RESTITUTION, 0.1, 0.0, 0.3).evidence(
        Measurand::DeltaVForward(Side::One),
        -16.5,
        Uncertainty::StandardDeviation(0.5),
    );
    // Both leave it zero.
    let problem = problem.evidence(Measurand::DeltaVLeft(Side::One), 0.0, Uncertainty::StandardDeviation(0.5));
    let speed = interval(&problem, Measurand::Variable(SPEED));
    let error = 1.959_964 * 0.5;
    assert!((speed.low - (16.5 - error) / 1.3).abs() < 2e-3 && (speed.high - (16.5 + error)).abs() < 2e-3, "{speed:?}");
    let [min, max] = [Bound::Min, Bound::Max].map(|bound| Some(Limit::Bound(RESTITUTION, bound)));
    assert_eq!((speed.low_limited_by, speed.high_limited_by, speed.sd), (max, min, None));
    let restitution = interval(&problem, Measurand::Variable(RESTITUTION));
    assert_eq!((restitution.low, restitution.high, restitution.narrows), (0.0, 0.3, false));
    // What the evidence determines has no need of the bounds.
    let delta_v = interval(&problem, Measurand::Output(Output::DeltaVMagnitude(Side::One)));
    assert!((delta_v.low - (16.5 - error)).abs() < 1e-3 && (delta_v.high - (16.5 + error)).abs() < 1e-3, "{delta_v:?}");
    assert_eq!((delta_v.low_limited_by, delta_v.high_limited_by, delta_v.sd), (None, None, None));
}

#[test]
fn an_angle_of_which_nothing_is_known_has_a_whole_turn() {
    // A standing car that is hit at its center of mass may point anywhere.
    let standing = Vehicle::new(1500.0, 2500.0);
    let collision = Collision { two: standing.into(), ..straight_into_barrier(0.0) };
    let heading = Variable::Input(Input::Heading(Side::Two));
    let found = interval(&direct(collision, heading, 0.0, 1e3), Measurand::Variable(heading));
    assert!((found.low + PI).abs() < 1e-9 && (found.high - PI).abs() < 1e-9, "{found:?}");
    let limits = (found.low_limited_by, found.high_limited_by, found.narrows);
    assert_eq!(limits, (Some(Limit::Period), Some(Limit::Period), false));
}

/// Just inside of an end that a limit of the physics makes, the mechanics accepts the collision, and just outside it refuses it for that reason.
#[test]
fn a_limit_of_the_physics_ends_an_interval_where_the_mechanics_refuses_the_collision() {
    let mut source = Source::of(41);
    let mut seen = Vec::new();
    for case in 0..40 {
        let collision = source.collision();
        let impact = collision.solve().expect("possible");
        let sliding = Collision { impulse_ratio: ImpulseRatio::Given(impact.impulse_ratio()), ..collision };
        let friction = Variable::Input(Input::ImpulseRatio);
        let left = Variable::Input(Input::ImpactCenterLeft(Side::One));
        for (collision, of, sd) in [
            (sliding, friction, 1e3),
            (collision, SPEED, 1e3),
            (collision, RESTITUTION, 1e3),
            (collision, PLANE, 0.5),
            (sliding, PLANE, 0.5),
            (sliding, left, 10.0),
            (collision, left, 10.0),
        ] {
            let value = Truth::of(collision, 0.5).variable(of);
            let found = interval(&direct(collision, of, value, sd), Measurand::Variable(of));
            let width = found.high - found.low;
            for (end, limit, outwards) in [(found.low, found.low_limited_by, -1.0), (found.high, found.high_limited_by, 1.0)] {
                let what = format!("case {case}, {} at {end}: {limit:?}", of.name());
                let Some(limit @ (Limit::Closing | Limit::Tension | Limit::Sliding | Limit::Energy)) = limit else {
                    continue;
                };
                assert!(with(&collision, of, end).solve().is_ok(), "{what}");
                let beyond = end + outwards * (0.02 * width).max(5e-3);
                let beyond = if of == RESTITUTION { beyond.min(1.0) } else { beyond };
                // The first refusal further out.
                let refused = |value: f64| with(&collision, of, value).solve().err();
                let further = |i: u32| end + (beyond - end) * f64::from(i) / 100.0;
                // Still further out, the mechanics may accept it again.
                let first = (1..=100).find_map(|i| Some((further(i), refused(further(i))?)));
                let (mut outside, mut refusals) = first.unwrap_or_else(|| panic!("{what}: {beyond} is possible"));
                let mut inside = end;
                for _ in 0..50 {
                    let middle = (inside + outside) / 2.0;
                    match refused(middle) {
                        Some(other) => (outside, refusals) = (middle, other),
                        None => inside = middle,
                    }
                }
                // Neither does an impulse that vanishes.
                let is_none = |refusal: &Refusal| matches!(refusal, Refusal::Tensile { normal, .. } if normal.abs() < 1e-6);
                let is_it = |refusal: &Refusal| match limit {
                    Limit::Closing => matches!(refusal, Refusal::NotClosing { .. }),
                    // Without closing there is neither impulse nor energy.
                    Limit::Tension => matches!(refusal, Refusal::Tensile { .. } | Refusal::NotClosing { .. }),
                    Limit::Sliding => matches!(refusal, Refusal::BeyondCritical { .. } | Refusal::NotClosing { .. }),
                    _ => matches!(refusal, Refusal::EnergyGain { .. } | Refusal::NotClosing { .. }) || is_none(refusal),
                };
                assert!(refusals.iter().any(is_it), "{what}: {refusals}");
                seen.push((limit, refusals.iter().any(|refusal| matches!(refusal, Refusal::NotClosing { .. }))));
            }
        }
    }
    let count = |limit| seen.iter().filter(|other| other.0 == limit && other.1 == (limit == Limit::Closing)).count();
    let counts = [Limit::Closing, Limit::Tension, Limit::Sliding, Limit::Energy].map(count);
    assert!(counts.iter().zip([95, 35, 150, 4]).all(|(count, least)| *count >= least), "{counts:?}");
}

#[test]
fn the_interval_covers_each_solution_within_the_limit() {
    // A second plane, −0.3, whose χ² is larger by 11: that is the quantile of 99.91 %.
    let (problem, answer) = preferred(11.0, 0.0);
    assert_eq!((answer.solutions.len(), answer.worse.len()), (1, 1));
    let of = |level| problem.intervals(&answer, level, &[Measurand::Variable(PLANE)])[0];
    let (one, both) = (of(0.99), of(0.999_5));
    assert!(one.low > 0.299 && (both.low + 0.3).abs() < 1e-3, "{one:?} {both:?}");
}

#[test]
fn the_ground_may_be_turned_under_an_interval() {
    // The direction of separation passes from −π to π.
    let mut source = Source::of(42);
    for case in 0..10 {
        let truth = Truth::of(source.collision(), 0.5);
        let of = Measurand::SeparationDirection(Side::One);
        let turned = |by: f64| {
            let turn = |party: &Party| {
                let Party::Vehicle(vehicle) = party else { panic!("a car") };
                let heading = Heading::from_angle(vehicle.heading.sin.atan2(vehicle.heading.cos) + by);
                let velocity = heading.to_ground(vehicle.heading.to_vehicle(vehicle.motion.velocity));
                Party::from(Vehicle { heading, motion: Motion { velocity, ..vehicle.motion }, ..*vehicle })
            };
            let plane = truth.collision.crush_plane;
            let collision = Collision {
                one: turn(&truth.collision.one),
                two: turn(&truth.collision.two),
                crush_plane: CrushPlane::from_angle(plane.sin.atan2(plane.cos) + by),
                ..truth.collision
            };
            let mut problem = ReconstructionProblem::of(collision);
            for side in [Side::One, Side::Two] {
                problem = problem.between(Variable::Speed(side), truth.variable(Variable::Speed(side)), 0.0, 60.0);
            }
            for measurand in [Measurand::DeltaVForward(Side::One), Measurand::DeltaVLeft(Side::One)] {
                problem = problem.evidence(measurand, truth.measured(measurand), Uncertainty::StandardDeviation(1.0));
            }
            let found = interval(&problem, of);
            [found.low - found.value, found.high - found.value]
        };
        let (here, there) = (turned(0.0), turned(PI - truth.measured(of)));
        for (here, there) in here.iter().zip(there) {
            assert!((here - there).abs() < 1e-3 * here.abs(), "case {case}: {here} and {there}");
        }
    }
}

#[test]
fn a_heading_goes_on_beyond_half_a_turn() {
    const HEADING: Variable = Variable::Input(Input::Heading(Side::Two));
    let car = |heading: f64| Vehicle::new(1500.0, 2500.0).with_heading(Heading::from_angle(heading)).with_impact_center(2.0, 0.3);
    let collision = Collision::new(car(0.0).with_speed(15.0), car(3.1)).with_restitution(0.1);
    for turned in [3.1, -3.1] {
        let problem = direct(collision, HEADING, turned, 0.05);
        let found = interval(&problem, Measurand::Variable(HEADING));
        let half = 1.959_964 * 0.05;
        assert!((found.low - turned + half).abs() < 1e-4 && (found.high - turned - half).abs() < 1e-4, "{found:?}");
        assert_eq!((found.low_limited_by, found.high_limited_by), (None, None));
        let answer = problem.solve(&ONE_START).expect("it has an answer");
        let posterior = problem.posterior(&answer, &Sampling::default()).expect("a posterior");
        let of_draws = &posterior.marginals(&[Measurand::Variable(HEADING)], 0.95)[0];
        assert!((of_draws.mean - turned).abs() < 0.005 && (of_draws.sd / 0.05 - 1.0).abs() < 0.1, "{of_draws:?}");
    }
}

#[test]
fn what_the_unknowns_do_not_move_has_one_value() {
    // Without sliding before the impact the critical ratio is a property of the contact, and so is the direction of the force.
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    for collision in [collision, collision.with_impulse_ratio(ImpulseRatio::Given(0.05))] {
        let problem = direct(collision, SPEED, 15.0, 0.5);
        let impact = collision.solve().expect("possible");
        for of in [Output::ImpulseRatio, Output::PrincipalDirectionOfForce(Side::One)] {
            let found = interval(&problem, Measurand::Output(of));
            let value = of.of(&collision, &impact);
            assert!((found.low - value).abs() < 1e-12 && (found.high - value).abs() < 1e-12, "{found:?}");
            assert_eq!((found.low_limited_by, found.high_limited_by, found.narrows), (None, None, true));
        }
        let loss = interval(&problem, Measurand::Output(Output::Loss));
        assert!(loss.low < 0.9 * loss.value && loss.high > 1.1 * loss.value, "{loss:?}");
    }
}

/// A ratio that friction limits is the friction wherever the vehicles slide on, and less where they stick.
#[test]
fn what_moves_only_far_from_the_best_fit_has_its_whole_interval() {
    const LEFT: Variable = Variable::Input(Input::ImpactCenterLeft(Side::One));
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.6).with_speed(15.0);
    let collision = Collision::new(car, Party::Barrier).with_restitution(0.1).with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.1));
    let problem = ReconstructionProblem::of(collision).unknown(SPEED, 15.0).between(LEFT, 0.6, -0.05, 0.9).evidence(
        Measurand::DeltaVForward(Side::One),
        -14.0,
        Uncertainty::StandardDeviation(2.0),
    );
    let problem = problem.evidence(Measurand::Variable(LEFT), 0.6, Uncertainty::StandardDeviation(0.3));
    let found = interval(&problem, Measurand::Output(Output::ImpulseRatio));
    // At an offset of 0.6 ± 0.59 m: the critical ratio −K_nt/K_tt is in proportion to the offset and below the friction up to about 0.28 m.
    let ratio = |left: f64| with(&collision, LEFT, left).solve().expect("possible").impulse_ratio().abs();
    assert!((ratio(0.6) - 0.1).abs() < 1e-12 && ratio(0.02) < 0.02);
    let least = found.low.abs().min(found.high.abs());
    assert!(least < 0.01 && (found.low.abs().max(found.high.abs()) - 0.1).abs() < 1e-9, "{found:?}");
}

/// A region that bounds cut is not convex: its farthest points may lie on another branch than the best fit.
#[test]
fn no_point_that_the_evidence_allows_lies_outside_of_an_interval() {
    const LEFT: Variable = Variable::Input(Input::ImpactCenterLeft(Side::One));
    const SHARE: Variable = Variable::Input(Input::ImpulseRatio);
    let vehicle = |mass: f64, radius: f64, heading: f64, [forward, left]: [f64; 2], speed: f64| {
        Vehicle::new(mass, mass * radius * radius)
            .with_impact_center(forward, left)
            .with_heading(Heading::from_angle(heading))
            .with_speed(speed)
    };
    let [x, y] = [Output::VelocityX, Output::VelocityY].map(|of| move |side| Measurand::Output(of(side)));
    let delta_v = |side| Measurand::Output(Output::DeltaVMagnitude(side));
    let oblique = Collision::new(vehicle(1054.0, 1.3, -0.177, [1.9, -0.06], 14.0), vehicle(1903.0, 1.35, 1.006, [-0.95, -0.141], 9.165))
        .with_restitution(0.278)
        .with_crush_plane(CrushPlane::from_angle(-0.123));
    let sideswipe = Collision::new(
        vehicle(1675.93, 1.3, 0.111_499, [1.9, -0.462_946], 18.809_547),
        vehicle(1186.61, 1.35, 0.637_479, [-1.061_737, -0.701_447], 11.954_962),
    )
    .with_restitution(0.259_866_782)
    .with_crush_plane(CrushPlane::from_angle(-0.203_252_507));
    let cases = [
        (
            oblique,
            [(SPEED, 14.0, 8.0, 22.0), (LEFT, -0.06, -0.566, 0.215), (SHARE, 0.9, 0.0, 1.0)],
            vec![
                (x(Side::One), 6.97, 0.15),
                (y(Side::One), 1.03, 0.15),
                (delta_v(Side::One), 7.66, 1.0),
                (x(Side::Two), 8.67, 1.0),
                (delta_v(Side::Two), 5.01, 1.0),
            ],
        ),
        (
            sideswipe,
            [(SPEED, 18.8, 10.0, 50.0), (LEFT, -0.46, -0.906, -0.296), (SHARE, 0.9, 0.0, 1.0)],
            vec![(Measurand::CrushEnergy, 20_854.8, 2085.48), (delta_v(Side::One), 3.4029, 0.5), (y(Side::One), 3.0411, 0.5)],
        ),
    ];
    for (collision, unknowns, evidence) in cases {
        let collision = collision.with_impulse_ratio(ImpulseRatio::OfCritical(0.9));
        let mut problem = ReconstructionProblem::of(collision);
        for (of, start, min, max) in unknowns {
            problem = problem.between(of, start, min, max);
        }
        for &(of, value, sd) in &evidence {
            problem = problem.evidence(of, value, Uncertainty::StandardDeviation(sd));
        }
        let answer = problem.solve(&Search::default()).expect("it has an answer");
        let of: Vec<Output> = [Output::Loss, Output::NormalWork, Output::TangentialWork, Output::ImpulseRatio]
            .into_iter()
            .chain(Side::ALL.into_iter().flat_map(|side| [Output::DeltaVMagnitude(side), Output::PrincipalDirectionOfForce(side)]))
            .collect();
        let measurands = unknowns.iter().map(|(of, ..)| Measurand::Variable(*of)).chain(of.iter().map(|of| Measurand::Output(*of)));
        let intervals = problem.intervals(&answer, 0.95, &measurands.collect::<Vec<_>>());
        // The quantile of χ² with one degree of freedom (Abramowitz and Stegun, table 26.8).
        let greatest = answer.best().chi_square + 3.841_459;
        let mut source = Source::of(7);
        let mut within = 0;
        for _ in 0..100_000 {
            let drawn = unknowns.map(|(of, _, min, max)| (of, source.between(min, max)));
            let at = drawn.iter().fold(collision, |collision, (of, value)| with(&collision, *of, *value));
            let Ok(impact) = at.solve() else { continue };
            let value = |of: Measurand| match of {
                Measurand::Output(of) => of.of(&at, &impact),
                _ => -impact.work.n,
            };
            let chi_square: f64 = evidence.iter().map(|&(of, given, sd)| ((value(of) - given) / sd).powi(2)).sum();
            if chi_square > greatest {
                continue;
            }
            within += 1;
            let values = drawn.iter().map(|(_, value)| *value).chain(of.iter().map(|of| of.of(&at, &impact)));
            for (interval, value) in intervals.iter().zip(values) {
                let slack = 2e-3 * (interval.high - interval.low);
                assert!((interval.low - slack..=interval.high + slack).contains(&value), "{value} at {drawn:?}: {interval:?}");
            }
        }
        assert!(within > 500, "{within}");
    }
}

/// The vehicles stick for any friction but the least fiftieth of what it may be. In that sliver, which no start of a search lies in, speeds and changes of velocity
/// go farther than where they stick.
#[test]
fn intervals_hold_a_sliver_in_which_the_vehicles_slide() {
    const FRICTION: Variable = Variable::Input(Input::ImpulseRatio);
    let (one, two) = (
        Vehicle::new(1471.42, 2415.62).with_heading(Heading::from_angle(350.0 * DEGREE)).with_impact_center(2.15, 0.28),
        Vehicle::new(2219.39, 2852.43).with_heading(Heading::from_angle(PI)).with_impact_center(0.59, 0.31),
    );
    let collision = Collision::new(one.with_speed(14.6), two.with_speed(25.0))
        .with_law(Law::KudlichSlibar)
        .with_restitution(0.3)
        .with_impulse_ratio(ImpulseRatio::LimitedByFriction(1.1));
    let evidence = [("vehicle.2.pdof", 0.0334, 0.03), ("vehicle.2.separation_speed", 5.38, 0.1), ("energy.normal_work", -627e3, 169e3)];
    let unknowns = [(Variable::Speed(Side::Two), 25.0, 24.44, 25.24), (SPEED, 14.6, 13.02, 14.62), (FRICTION, 1.1, 0.0, 2.0)];
    let mut problem = unknowns
        .iter()
        .fold(ReconstructionProblem::of(collision), |problem, (of, start, min, max)| problem.between(*of, *start, *min, *max));
    for (name, value, tolerance) in evidence {
        problem = problem.evidence(of(name), value, sd(tolerance));
    }
    let answer = problem.solve(&Search::default()).expect("it has an answer");
    let asked = [Measurand::Variable(SPEED), of("contact.closing_speed"), of("vehicle.1.delta_v_magnitude"), of("energy.loss")];
    let intervals = problem.intervals(&answer, 0.95, &asked);
    let greatest = answer.best().chi_square + 3.841_459;
    let mut source = Source::of(7);
    let mut within = 0;
    for _ in 0..100_000 {
        // At the lower bound of the speed of the other vehicle, which all four lower ends lie on.
        let drawn = [(unknowns[0].0, unknowns[0].2), (SPEED, source.between(13.02, 13.6)), (FRICTION, source.between(0.0, 0.04))];
        let at = drawn.iter().fold(collision, |collision, (of, value)| with(&collision, *of, *value));
        let Ok(impact) = at.solve() else { continue };
        let pdof = Output::PrincipalDirectionOfForce(Side::Two).of(&at, &impact);
        let separation = impact.two.after.velocity;
        let computed = [pdof, separation.x.hypot(separation.y), impact.work.n];
        let chi_square: f64 =
            evidence.iter().zip(computed).map(|((_, given, tolerance), value)| ((value - given) / tolerance).powi(2)).sum();
        if chi_square > greatest {
            continue;
        }
        within += 1;
        let change = Output::DeltaVMagnitude(Side::One).of(&at, &impact);
        for (interval, value) in intervals.iter().zip([drawn[1].1, impact.approach.n.abs(), change, impact.loss()]) {
            let slack = 2e-3 * (interval.high - interval.low);
            assert!((interval.low - slack..=interval.high + slack).contains(&value), "{value} at {drawn:?}: {interval:?}");
        }
    }
    assert!(within > 500, "{within}");
}

const DEGREE: f64 = PI / 180.0;

fn car(mass: f64, yaw_inertia: f64, heading: f64, speed: f64, forward: f64, left: f64) -> Vehicle {
    Vehicle::new(mass, yaw_inertia).with_heading(Heading::from_angle(heading * DEGREE)).with_impact_center(forward, left).with_speed(speed)
}

fn of(name: &str) -> Measurand {
    Measurand::named(name).expect("a measurand")
}

fn sd(sd: f64) -> Uncertainty {
    Uncertainty::StandardDeviation(sd)
}

/// The struck car slides along the plane: its speed has a normal component of cos 90°, which floats do not have as zero.
#[test]
fn a_speed_along_the_crush_plane_is_open() {
    for angle in [0.0, PI] {
        let (struck, striking) = (car(2035.0, 4435.0, 90.0, 18.0, -0.25, 0.77), car(2292.0, 3904.0, 0.0, 6.0, 1.02, 0.21));
        let collision = Collision::new(struck, striking)
            .with_crush_plane(CrushPlane::from_angle(angle))
            .with_restitution(0.1)
            .with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.3));
        let delta_v = Measurand::Output(Output::DeltaVMagnitude(Side::Two));
        let mut problem = ReconstructionProblem::of(collision).unknown(SPEED, 18.0).evidence(delta_v, 3.1, sd(0.1));
        problem.unknowns[0].min = Some(10.0);
        let answer = problem.solve(&Search::default()).expect("an answer");
        assert_eq!((answer.verdict, answer.not_determined.len()), (Verdict::Undetermined, 1), "{angle}");
        let [speed, closing] = problem.intervals(&answer, 0.95, &[Measurand::Variable(SPEED), Measurand::ClosingSpeed])[..] else {
            panic!("two")
        };
        assert_eq!((speed.low, speed.high, speed.low_limited_by), (10.0, f64::INFINITY, Some(Limit::Bound(SPEED, Bound::Min))), "{angle}");
        assert!((closing.low - 6.0).abs() < 1e-6 && (closing.high - 6.0).abs() < 1e-6, "{closing:?}");
    }
}

/// Up to some speed the vehicles stick; above it they slide, and the evidence is the same for every speed.
#[test]
fn a_flat_valley_is_one_solution_and_bounds_what_it_determines() {
    let [up, down] = [PI / 2.0, 3.0 * PI / 2.0].map(|angle| {
        let (one, two) = (car(1671.0, 2386.0, 90.0, 14.4, 1.74, 0.02), car(1787.0, 2882.0, 0.0, 3.8, -0.07, -0.82));
        let collision = Collision::new(one, two)
            .with_crush_plane(CrushPlane::from_angle(angle))
            .with_restitution(0.14)
            .with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.19));
        let speed = Variable::Speed(Side::Two);
        let mut problem =
            ReconstructionProblem::of(collision).unknown(speed, 3.8).evidence(of("vehicle.1.separation_velocity.x"), 1.126, sd(0.3));
        problem.unknowns[0].min = Some(1.4);
        let answer = problem.solve(&Search::default()).expect("an answer");
        assert_eq!((answer.verdict, answer.solutions.len()), (Verdict::SeveralSolutions, 2), "{angle}");
        let pdof = Measurand::Output(Output::PrincipalDirectionOfForce(Side::One));
        problem
            .intervals(&answer, 0.95, &[Measurand::Variable(speed), pdof])
            .iter()
            .map(|found| [found.low, found.high])
            .collect::<Vec<_>>()
    });
    // The ratio of the impulse is at most the friction, and at least that of the speed at the lower end.
    let least = -0.19_f64.atan();
    assert!((up[1][0] - least).abs() < 1e-3 && (-0.07..-0.06).contains(&up[1][1]) && up[0][1] == f64::INFINITY, "{up:?}");
    assert!(
        up.iter().flatten().zip(down.iter().flatten()).all(|(one, other)| one == other || (one - other).abs() < 1e-3),
        "{up:?} {down:?}"
    );
}

/// Where the speeds are nearly equal the loss ends with the square of their difference, and no limit but that of closing is near.
#[test]
fn evidence_that_says_little_leaves_every_speed_at_which_the_vehicles_close() {
    for speed in [0.5, 11.0, 40.0] {
        let collision =
            Collision::new(car(1450.0, 2600.0, 0.0, 14.0, 1.85, 0.0), car(1180.0, 1900.0, 180.0, speed, 1.6, 0.0)).with_restitution(0.1);
        let delta_v = Measurand::Output(Output::DeltaVMagnitude(Side::One));
        let problem = ReconstructionProblem::of(collision).unknown(SPEED, 14.0).evidence(delta_v, 15.0, sd(60.0));
        let speeds = interval(&problem, Measurand::Variable(SPEED));
        let closing = interval(&problem, Measurand::ClosingSpeed);
        assert!((speeds.low + speed).abs() < 5e-4 * (14.0 + speed), "{speed}: {speeds:?}");
        assert!(closing.low < 5e-4 * (14.0 + speed), "{speed}: {closing:?}");
        assert_eq!([speeds.low_limited_by, closing.low_limited_by], [Some(Limit::Closing); 2], "{speed}");
    }
}

/// At e = 0 and μ = μ0 nothing depends on the crush plane: with one bound it has the whole turn from there.
#[test]
fn an_angle_with_one_bound_has_a_whole_turn() {
    let (one, two) = (car(1147.0, 1551.0, 180.0, 2.8, 1.13, -0.57), car(1524.0, 2078.0, 0.0, 18.0, 1.01, 0.31));
    let found_with = |bounds: [Option<f64>; 2]| {
        let mut problem = ReconstructionProblem::of(Collision::new(one, two))
            .between(SPEED, 2.8, -5.0, 20.0)
            .unknown(PLANE, -DEGREE)
            .evidence(Measurand::Output(Output::DeltaVMagnitude(Side::One)), 9.0, sd(0.5))
            .evidence(of("vehicle.2.separation_yaw_rate"), 1.3, sd(0.2));
        [problem.unknowns[1].min, problem.unknowns[1].max] = bounds.map(|bound| bound.map(|bound| bound * DEGREE));
        let found = interval(&problem, Measurand::Variable(PLANE));
        [found.low / DEGREE, found.high / DEGREE].map(f64::round)
    };
    assert_eq!(
        [found_with([Some(-12.0), None]), found_with([None, Some(20.0)]), found_with([Some(-12.0), Some(168.0)])],
        [[-12.0, 168.0], [-160.0, 20.0], [-12.0, 168.0]]
    );
}

/// Head on only the sum of the speeds counts: no seed may find that the search has no end.
#[test]
fn a_flat_valley_is_found_from_every_seed() {
    let one = car(1_941.495_156_863_766, 2_290.342_842_270_995_3, 180.0, 22.0, 0.387_666_187_719_634_8, -0.774_260_237_565_686);
    let two = car(1_045.140_821_350_184, 1_637.705_470_906_456, 0.0, 0.0, 2.032_668_615_862_418, 0.138_785_307_511_497_65)
        .with_yaw_rate(0.261_251_831_463_474_2);
    let mut problem = ReconstructionProblem::of(Collision::new(one, two).with_restitution(0.05))
        .unknown(SPEED, 22.192_126_891_916_487)
        .between(Variable::Speed(Side::Two), -0.170_274_130_461_670_4, -9.904_153_490_776_862, 7.942_631_921_815_868_5)
        .evidence(Measurand::Output(Output::DeltaVMagnitude(Side::Two)), 12.103_508_608_094_936, sd(2.0))
        .evidence(of("vehicle.2.separation_yaw_rate"), 1.251_203_923_208_486, sd(0.4))
        .evidence(of("vehicle.1.delta_v.x"), 7.212_278_696_572_949, sd(0.3))
        .evidence(Measurand::DeltaVLeft(Side::One), 0.081_917_297_907_297_35, sd(0.3));
    problem.unknowns[0].min = Some(19.763_421_236_771_705);
    for seed in 1..=5 {
        let answer = problem.solve(&Search { seed, ..Search::default() }).map(|answer| answer.verdict);
        assert_eq!(answer.ok(), Some(Verdict::Undetermined), "{seed}");
    }
}
