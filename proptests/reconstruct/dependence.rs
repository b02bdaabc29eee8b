//! Evidence that was computed with an unknown follows it: its errors and those of the unknown are the same, in part.

use planar_impact::reconstruct::*;
use planar_impact::*;

const SPEED: Variable = Variable::Speed(Side::One);
const MASS: Variable = Variable::Input(Input::Mass(Side::One));
const AFTER: Measurand = Measurand::Output(Output::VelocityX(Side::One));
const SLOPE: f64 = 0.004;

/// A car of 1500 kg ± 150 kg runs into one of 1500 kg that stands, and both go on at 10 m/s ± 0.05 m/s: V = m v/(m + 1500). The velocity was computed with a mass.
fn problem(slope: f64, at: f64) -> ReconstructionProblem {
    let car = |speed: f64| Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(speed);
    let other = Vehicle { heading: Heading::from_angle(std::f64::consts::PI), ..car(0.0) };
    let known = 10.0 + slope * (at - 1500.0);
    let mut problem = ReconstructionProblem::of(Collision::new(car(20.0), other)).unknown(SPEED, 15.0).evidence(
        AFTER,
        known,
        Uncertainty::StandardDeviation(0.05),
    );
    problem.unknowns.push(Unknown { prior: Some(150.0), ..Unknown::free(MASS, 1500.0) });
    problem.dependences.push(Dependence { of: AFTER, on: MASS, at, slope });
    problem
}

/// v = (m + 1500)/m V: dv/dV = 2, and dv/dm = (slope − 1500 v/3000²) · 2 with V following m.
#[test]
fn the_errors_of_both_are_the_same() {
    for slope in [SLOPE, 0.0, -SLOPE, 1500.0 * 20.0 / 9e6] {
        let answer = problem(slope, 1500.0).solve(&Search::default()).expect("an answer");
        let [speed, mass] = [0, 1].map(|i| answer.best().unknowns[i]);
        let by_mass = 2.0 * (slope - 1500.0 * 20.0 / 9e6) * 150.0;
        assert!((speed.value - 20.0).abs() < 1e-9 && (mass.value - 1500.0).abs() < 1e-6, "{speed:?} {mass:?}");
        let sd = by_mass.hypot(2.0 * 0.05);
        assert!((speed.sd.expect("a deviation") - sd).abs() < 1e-6 * sd, "{slope}: {speed:?}, not {sd}");
        assert!((mass.sd.expect("a deviation") - 150.0).abs() < 1e-6, "the evidence says nothing of the mass: {mass:?}");
    }
}

/// The value with which the evidence was computed is no part of what it says.
#[test]
fn another_value_with_the_same_line_is_the_same_evidence() {
    let ends = |problem: &ReconstructionProblem| {
        let answer = problem.solve(&Search::default()).expect("an answer");
        let intervals = problem.intervals(&answer, 0.95, &[Measurand::Variable(SPEED)]);
        let guaranteed =
            problem.guaranteed(&GuaranteedSearch { deviations: 2.0, ..GuaranteedSearch::default() }, &|_| true).expect("it has ranges");
        [intervals[0].low, intervals[0].high, guaranteed[0].low, guaranteed[0].high]
    };
    let (one, other) = (ends(&problem(SLOPE, 1500.0)), ends(&problem(SLOPE, 1300.0)));
    for (one, other) in one.into_iter().zip(other) {
        assert!((one - other).abs() < 1e-6, "{one} {other}");
    }
    // Over 2 standard deviations, (1 + 1500/m)(4 + 0.004 m ± 0.1) is least at √(5850/0.004) kg, and greatest at 1800 kg.
    let at = |mass: f64, error: f64| (1.0 + 1500.0 / mass) * (4.0 + SLOPE * mass + error);
    let wanted = [at((5850.0_f64 / SLOPE).sqrt(), -0.1), at(1800.0, 0.1)];
    for (got, wanted) in one[2..].iter().zip(wanted) {
        assert!((got - wanted).abs() < 1e-3, "{got} {wanted}");
    }
}

/// What is no evidence, or no unknown, changes nothing.
#[test]
fn a_dependence_of_nothing_has_no_effect() {
    let solved = |problem: &ReconstructionProblem| problem.solve(&Search::default()).expect("an answer").best().unknowns[0].sd;
    let plain = ReconstructionProblem { dependences: Vec::new(), ..problem(SLOPE, 1500.0) };
    let mut other = plain.clone();
    other.dependences.push(Dependence { of: AFTER, on: Variable::Input(Input::Mass(Side::Two)), at: 1500.0, slope: SLOPE });
    other.dependences.push(Dependence { of: Measurand::CrushEnergy, on: MASS, at: 1500.0, slope: SLOPE });
    assert_eq!(solved(&plain), solved(&other));
}
