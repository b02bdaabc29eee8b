//! Benchmarks a reconstruction with six unknowns, from one start and from 64, against the same least squares
//! assembled by hand on a trust region.

use basin::{BoxBounds, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian, Residual, TrustRegionReflective};
use criterion::Criterion;
use planar_impact::reconstruct::{Measurand, ReconstructionProblem, Sampling, Search, Uncertainty, Variable};
use planar_impact::*;
use std::convert::Infallible;
use std::hint::black_box;

const UNKNOWNS: [(Input, f64, f64, f64); 6] = [
    (Input::VelocityX(Side::One), 14.0, 0.0, 40.0),
    (Input::VelocityX(Side::Two), -8.0, -40.0, 10.0),
    (Input::VelocityY(Side::Two), 5.0, -20.0, 20.0),
    (Input::CrushPlane, 0.0, -0.8, 0.8),
    (Input::Restitution, 0.1, 0.0, 0.4),
    (Input::ImpactCenterLeft(Side::One), 0.2, -1.0, 1.0),
];

/// The evidence and its standard deviations; the normal work equals the crush energy.
const EVIDENCE: [(Output, f64); 8] = [
    (Output::NormalWork, 6e3),
    (Output::VelocityX(Side::One), 0.5),
    (Output::VelocityY(Side::One), 0.5),
    (Output::YawRate(Side::One), 0.2),
    (Output::VelocityX(Side::Two), 0.5),
    (Output::VelocityY(Side::Two), 0.5),
    (Output::YawRate(Side::Two), 0.2),
    (Output::DeltaVMagnitude(Side::Two), 0.4),
];

fn crash() -> Collision {
    let car = |mass: f64, heading: f64, speed: f64, forward, left| {
        let heading = Heading::from_angle(heading);
        Vehicle {
            mass,
            yaw_inertia: 1.9 * mass,
            heading,
            impact_center: ForwardLeft { forward, left },
            motion: Motion { velocity: heading.to_ground(ForwardLeft { forward: speed, left: 0.0 }), yaw_rate: 0.0 },
        }
    };
    Collision {
        one: car(1300.0, 0.0, 17.0, 1.9, 0.4).into(),
        two: car(1700.0, 2.5, 12.0, 1.5, 0.5).into(),
        crush_plane: CrushPlane::from_angle(0.2),
        restitution: 0.12,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

/// Returns simulated measurements: true values, each with an error of up to half its standard deviation.
fn measured(collision: &Collision) -> [f64; EVIDENCE.len()] {
    let outputs = Outputs::of(collision, &collision.solve().expect("possible"));
    std::array::from_fn(|i| outputs[EVIDENCE[i].0] + EVIDENCE[i].1 * (0.5 - 0.3 * (i % 4) as f64))
}

fn question(collision: Collision, measured: &[f64]) -> ReconstructionProblem {
    let asked = UNKNOWNS.into_iter().fold(ReconstructionProblem::of(collision), |asked, (input, start, min, max)| {
        asked.between(Variable::Input(input), start, min, max)
    });
    EVIDENCE
        .into_iter()
        .zip(measured)
        .fold(asked, |asked, ((output, sd), &value)| asked.evidence(Measurand::Output(output), value, Uncertainty::StandardDeviation(sd)))
}

/// The same problem by hand: residuals and derivatives from the library's sensitivities, steps by a trust region.
struct ByHand {
    collision: Collision,
    measured: [f64; EVIDENCE.len()],
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl ByHand {
    fn at(&self, unknowns: &[f64]) -> Collision {
        self.collision.shifted(|input| {
            let place = UNKNOWNS.iter().position(|(of, ..)| *of == input);
            place.map_or(0.0, |i| unknowns[i] - self.collision.input(input).expect("both are vehicles"))
        })
    }

    fn solve(&self) -> Vec<f64> {
        let start = UNKNOWNS.iter().map(|(_, start, ..)| *start).collect();
        let by_hand = ByHand { lower: self.lower.clone(), upper: self.upper.clone(), ..*self };
        let solver = TrustRegionReflective::new().with_absolute_scaled_gradient_tolerance(1e-9);
        Executor::from_start(by_hand, solver, start).max_iter(200).run().expect("it cannot fail").param().clone()
    }
}

impl Constraints for ByHand {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as basin::ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl Residual for ByHand {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Infallible;

    fn residual(&self, unknowns: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let collision = self.at(unknowns);
        let Ok(impact) = collision.solve() else { return Ok(vec![f64::NAN; EVIDENCE.len()]) };
        let outputs = Outputs::of(&collision, &impact);
        Ok(EVIDENCE.iter().zip(&self.measured).map(|((output, sd), value)| (value - outputs[*output]) / sd).collect())
    }
}

impl Jacobian for ByHand {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, unknowns: &Vec<f64>) -> Result<DenseMatrix, Infallible> {
        let collision = self.at(unknowns);
        let outputs = collision.sensitivities_of(&collision.evaluate());
        let entry = |i: usize, k: usize| -outputs[EVIDENCE[i].0].by[UNKNOWNS[k].0] / EVIDENCE[i].1;
        Ok(DenseMatrix::from_fn(EVIDENCE.len(), UNKNOWNS.len(), entry))
    }
}

pub fn reconstruct(c: &mut Criterion) {
    let collision = crash();
    let measured = measured(&collision);
    let question = question(collision, &measured);
    let bound = |which: fn(&(Input, f64, f64, f64)) -> f64| UNKNOWNS.iter().map(which).collect();
    let by_hand = ByHand { collision, measured, lower: bound(|unknown| unknown.2), upper: bound(|unknown| unknown.3) };
    let one = Search { starts: 1, ..Search::default() };
    let all = Search { starts: 64, ..Search::default() };
    let found = question.solve(&one).expect("it has an answer");
    for (unknown, other) in found.best().unknowns.iter().zip(by_hand.solve()) {
        assert!((unknown.value - other).abs() < 1e-5, "{unknown:?} and {other}");
    }
    let mut group = c.benchmark_group("reconstruct");
    group.bench_function("six unknowns by hand, one start, no uncertainty", |b| b.iter(|| black_box(&by_hand).solve()));
    group.bench_function("six unknowns, one start", |b| b.iter(|| black_box(&question).solve(&one)));
    group.bench_function("six unknowns, 64 starts", |b| b.iter(|| black_box(&question).solve(&all)));
    let answer = question.solve(&one).expect("it has an answer");
    let unknowns: Vec<Measurand> = UNKNOWNS.iter().map(|(input, ..)| Measurand::Variable(Variable::Input(*input))).collect();
    group.bench_function("posterior of six unknowns, 4000 draws", |b| {
        b.iter(|| black_box(&question).posterior(&answer, &Sampling::default()))
    });
    group.bench_function("intervals of six unknowns", |b| b.iter(|| black_box(&question).intervals(&answer, 0.95, &unknowns)));
    group.finish();
}
