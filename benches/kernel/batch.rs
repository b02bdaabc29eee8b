//! Batches beside one collision after the other, from the same columns, and lanes filled from collisions and emptied into impacts.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use planar_impact::batch::{Batch, Instructions, Numbers};
use planar_impact::scalar::lanes::Lanes;
use planar_impact::simulation::{Moments, Quantiles, Simulation};
use planar_impact::*;

use crate::inputs::{self, Angles, collision_from_angles};

/// Few enough that the columns stay in the second cache.
const COLLISIONS: usize = 1024;

/// Enough that both threads have work.
const SAMPLES: u64 = 1 << 20;

/// The outputs of the group `angles`: velocities, impulse, μ₀ and works, with ΔV and PDOF of both vehicles.
pub const SIXTEEN: [Output; 16] = [
    Output::VelocityX(Side::One),
    Output::VelocityY(Side::One),
    Output::YawRate(Side::One),
    Output::VelocityX(Side::Two),
    Output::VelocityY(Side::Two),
    Output::YawRate(Side::Two),
    Output::NormalImpulse,
    Output::TangentialImpulse,
    Output::CriticalImpulseRatio,
    Output::NormalWork,
    Output::TangentialWork,
    Output::Loss,
    Output::DeltaVMagnitude(Side::One),
    Output::DeltaVMagnitude(Side::Two),
    Output::PrincipalDirectionOfForce(Side::One),
    Output::PrincipalDirectionOfForce(Side::Two),
];

pub fn batch(c: &mut Criterion) {
    let cases: Vec<Angles<f64>> = inputs::cases(COLLISIONS);
    let collisions: Vec<Collision> = cases.iter().map(collision_from_angles).collect();
    let rows: Vec<[f64; Input::COUNT]> = collisions.iter().map(Collision::to_inputs).collect();
    let columns: Vec<Vec<f64>> = (0..Input::COUNT).map(|i| rows.iter().map(|row| row[i]).collect()).collect();
    let common = collisions[0];
    let with = |batch: Batch<'static>, input: Input| batch.with(input, columns[input.index()].clone().leak()).expect("as many rows");
    let all = Input::ALL.into_iter().fold(Batch::of(common), with);
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(COLLISIONS as u64));

    for (name, of) in [("16 outputs", &SIXTEEN[..]), ("32 outputs", &Output::ALL), ("W_n", &[Output::NormalWork])] {
        let mut out = vec![vec![0.0; COLLISIONS]; of.len()];
        group.bench_function(BenchmarkId::new("one by one", name), |b| {
            b.iter(|| {
                for (i, row) in black_box(&rows).iter().enumerate() {
                    let collision = common.with_inputs(*row);
                    let impact = collision.evaluate();
                    out.iter_mut().zip(of).for_each(|(column, output)| column[i] = output.of(&collision, &impact));
                }
                black_box(&mut out);
            });
        });
        for set in Instructions::available() {
            let batch = all.clone().on(set);
            group.bench_function(BenchmarkId::new(format!("evaluate, {set:?}"), name), |b| b.iter(|| black_box(&batch).evaluate(of)));
            let fast = batch.fast();
            group.bench_function(BenchmarkId::new(format!("fast, {set:?}"), name), |b| b.iter(|| black_box(&fast).evaluate(of)));
        }
    }
    let mut out = vec![common.evaluate(); COLLISIONS];
    group.bench_function("one by one, checked", |b| {
        b.iter(|| {
            for (row, out) in black_box(&rows).iter().zip(&mut out) {
                *out = common.with_inputs(*row).solve().expect("a collision");
            }
            black_box(&mut out);
        });
    });
    for set in Instructions::available() {
        let batch = all.clone().on(set);
        group.bench_function(BenchmarkId::new(format!("solve, {set:?}"), "32 outputs"), |b| {
            b.iter(|| black_box(&batch).solve(&Output::ALL))
        });
    }
    let six: Vec<(Input, f64)> = Side::ALL
        .into_iter()
        .flat_map(|side| [(Input::VelocityX(side), 0.5), (Input::VelocityY(side), 0.5)])
        .chain([(Input::CrushPlane, 0.05), (Input::Restitution, 0.05)])
        .collect();
    let six = Covariance::independent(&six).expect("deviations");
    let direction: Vec<(Input, Numbers)> = Input::ALL.into_iter().map(|input| (input, Numbers::Same(1.0))).collect();
    let weights: Vec<(Output, Numbers)> = SIXTEEN.into_iter().map(|output| (output, Numbers::Same(1.0))).collect();
    for set in Instructions::available() {
        let batch = all.clone().on(set);
        let mut bench = |of: &str, run: &dyn Fn(&Batch)| {
            group.bench_function(BenchmarkId::new(format!("{of}, {set:?}"), "derivatives"), |b| b.iter(|| run(black_box(&batch))));
        };
        bench("16 x 19", &|batch| drop(black_box(batch.sensitivities(&SIXTEEN, &Input::ALL[..19]))));
        bench("32 x 20", &|batch| drop(black_box(batch.sensitivities(&Output::ALL, &Input::ALL))));
        bench("variance of 16 by 6", &|batch| drop(black_box(batch.variances(&SIXTEEN, &six))));
        bench("W_n x 20", &|batch| drop(black_box(batch.sensitivity(Output::NormalWork, &Input::ALL))));
        bench("16 weights x 20", &|batch| drop(black_box(batch.pullback(&weights, &Input::ALL))));
        bench("16 along one direction", &|batch| drop(black_box(batch.pushforward(&SIXTEEN, &direction))));
    }
    // Six uncertain inputs: the inputs are drawn, solved and summarized in cache.
    let delta_v = [Output::DeltaVMagnitude(Side::One), Output::DeltaVMagnitude(Side::Two)];
    let uncertain = |simulation: Simulation, input: Input| {
        let mean = common.input(input).expect("an input of two vehicles");
        simulation.with(input, Distribution::Normal { mean, sd: 0.01 }).expect("a normal distribution")
    };
    let drawn = [Side::One, Side::Two].into_iter().flat_map(|side| [Input::VelocityX(side), Input::VelocityY(side)]);
    let simulation = drawn.chain([Input::CrushPlane, Input::Restitution]).fold(Simulation::of(common), uncertain);
    for (name, of) in [("2 outputs", &delta_v[..]), ("16 outputs", &SIXTEEN)] {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let empty = (Moments::of(of), Quantiles::of(of));
            group.throughput(Throughput::Elements(SAMPLES));
            group.bench_function(BenchmarkId::new(format!("reduce, {threads} threads"), name), |b| {
                b.iter(|| pool.install(|| black_box(&simulation).reduce(SAMPLES, empty.clone(), &|_| true)))
            });
        }
    }
    group.throughput(Throughput::Elements(COLLISIONS as u64));
    let mut table = Outputs::default();
    group.bench_function("32 x 20 one by one", |b| {
        b.iter(|| {
            for row in black_box(&rows) {
                common.with_inputs(*row).sensitivities_to(&mut table).expect("a collision");
                black_box(&mut table);
            }
        });
    });
    let eights: Vec<[Collision; 8]> = collisions.chunks_exact(8).map(|eight| eight.try_into().expect("eight")).collect();
    group.bench_function("gather 8 lanes", |b| {
        b.iter(|| {
            for eight in black_box(&eights) {
                black_box(Collision::<Lanes<8>>::gather(eight));
            }
        });
    });
    let impacts: Vec<Impact<Lanes<8>>> = eights.iter().filter_map(Collision::<Lanes<8>>::gather).map(|lanes| lanes.evaluate()).collect();
    group.bench_function("scatter 8 lanes", |b| {
        b.iter(|| {
            for impact in black_box(&impacts) {
                black_box(impact.scatter());
            }
        });
    });
    group.finish();
}
