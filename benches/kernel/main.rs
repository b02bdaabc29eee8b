//! Benchmarks one impact on each scalar type against a kernel written by hand for f64.
//!
//! | group | question |
//! |---|---|
//! | `directions` | from directions (cosine and sine given) to velocities, impulse, μ₀ and works: + − × ÷ only |
//! | `angles` | from angles to the same, with ΔV and PDOF of both vehicles: in addition three sines, two roots, two arctangents |
//! | `jacobian`, `gradient`, `hessian` | derivatives with respect to all inputs, and the solution that they belong to |
//! | `batch` | the same collisions in columns, on each set of vector instructions of the machine, beside one after the other; lanes filled and emptied |
//! | `crush` | a crush energy, the textbook's formula, its derivative, and CRASH3 |
//! | `reconstruct` | reconstruction with six unknowns, from one start and from 64, and least squares assembled by hand (feature `reconstruct`) |
//! | `uncertainty` | a million samples of six uncertain inputs: a batch alone, with moments and quantiles, and a plain loop |
//! | `bounds` | guaranteed ranges over two inputs to 10⁻¹², and over six to 10⁻⁶ |
//! | `scalars` | the same definition on duals, intervals and rationals |
//!
//! Every figure is for 256 distinct collisions; criterion prints the throughput in collisions per second.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

mod batch;
mod crush;
mod derivatives;
mod hand;
mod inputs;
#[cfg(feature = "reconstruct")]
mod reconstruct;
mod uncertainty;

use batch::batch;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use hand::{Directions, Libm, Outputs, Std};
use inputs::{Angles, collision, collision_from_angles, outputs, outputs_with_directions};
use num_dual::{Dual64, DualSVec64};
use num_rational::BigRational;
use planar_impact::scalar::interval::Interval;
use planar_impact::scalar::lanes::Lanes;
#[cfg(feature = "reconstruct")]
use reconstruct::reconstruct;
use std::hint::black_box;
use uncertainty::uncertainty;

const COLLISIONS: usize = 256;

/// Packs four collisions into each element.
fn in_lanes<I, const N: usize>(cases: &[[f64; N]], make: impl Fn([Lanes; N]) -> I) -> Vec<I> {
    cases
        .chunks_exact(Lanes::<4>::WIDTH)
        .map(|four| make(std::array::from_fn(|i| Lanes::new(std::array::from_fn(|lane| four[lane][i])))))
        .collect()
}

fn directions(c: &mut Criterion) {
    let cases: Vec<Angles<f64>> = inputs::cases(COLLISIONS);
    let plain: Vec<[f64; Directions::COUNT]> = cases.iter().map(|case| case.directions()).collect();
    let by_hand: Vec<Directions> = plain.iter().map(|&row| Directions::from_row(row)).collect();
    let lanes = in_lanes(&plain, |row| row);
    let mut group = c.benchmark_group("directions");
    group.throughput(Throughput::Elements(COLLISIONS as u64));

    let mut out = vec![Outputs::default(); COLLISIONS];
    group.bench_function("hand-written f64", |b| {
        b.iter(|| {
            for (case, out) in black_box(&by_hand).iter().zip(&mut out) {
                *out = hand::solve(case);
            }
            black_box(&mut out);
        });
    });
    let mut out = vec![[0.0; 12]; COLLISIONS];
    group.bench_function("generic f64", |b| {
        b.iter(|| {
            for (case, out) in black_box(&plain).iter().zip(&mut out) {
                *out = outputs(&collision(*case).evaluate());
            }
            black_box(&mut out);
        });
    });
    let mut out = vec![[Lanes::splat(0.0); 12]; COLLISIONS / Lanes::<4>::WIDTH];
    group.bench_function("lanes", |b| {
        b.iter(|| {
            for (case, out) in black_box(&lanes).iter().zip(&mut out) {
                *out = outputs(&collision(*case).evaluate());
            }
            black_box(&mut out);
        });
    });
    group.finish();
}

fn angles(c: &mut Criterion) {
    let cases: Vec<Angles<f64>> = inputs::cases(COLLISIONS);
    let rows: Vec<_> = cases.iter().map(|case| case.row()).collect();
    let lanes = in_lanes(&rows, Angles::from_row);
    let mut group = c.benchmark_group("angles");
    group.throughput(Throughput::Elements(COLLISIONS as u64));

    let mut out = vec![[0.0; 16]; COLLISIONS];
    group.bench_function("hand-written f64, std", |b| {
        b.iter(|| {
            for (case, out) in black_box(&cases).iter().zip(&mut out) {
                *out = hand::solve_from_angles::<Std>(case);
            }
            black_box(&mut out);
        });
    });
    group.bench_function("hand-written f64, libm", |b| {
        b.iter(|| {
            for (case, out) in black_box(&cases).iter().zip(&mut out) {
                *out = hand::solve_from_angles::<Libm>(case);
            }
            black_box(&mut out);
        });
    });
    group.bench_function("generic f64", |b| {
        b.iter(|| {
            for (case, out) in black_box(&cases).iter().zip(&mut out) {
                *out = outputs_with_directions(&collision_from_angles(case).evaluate());
            }
            black_box(&mut out);
        });
    });
    group.bench_function("generic f64, checked", |b| {
        b.iter(|| {
            for (case, out) in black_box(&cases).iter().zip(&mut out) {
                *out = collision_from_angles(case).solve().map_or([0.0; 16], |impact| outputs_with_directions(&impact));
            }
            black_box(&mut out);
        });
    });
    let mut out = vec![[Lanes::splat(0.0); 16]; COLLISIONS / Lanes::<4>::WIDTH];
    group.bench_function("lanes", |b| {
        b.iter(|| {
            for (case, out) in black_box(&lanes).iter().zip(&mut out) {
                *out = outputs_with_directions(&collision_from_angles(case).evaluate());
            }
            black_box(&mut out);
        });
    });
    group.finish();
}

fn scalars(c: &mut Criterion) {
    let cases: Vec<Angles<f64>> = inputs::cases(COLLISIONS);
    let mut group = c.benchmark_group("scalars");
    group.throughput(Throughput::Elements(COLLISIONS as u64));

    let dual: Vec<Angles<Dual64>> = cases.iter().map(|case| case.map(Dual64::from)).collect();
    group.bench_function(BenchmarkId::new("angles", "Dual64"), |b| {
        b.iter(|| {
            for case in black_box(&dual) {
                black_box(outputs_with_directions(&collision_from_angles(case).evaluate()));
            }
        });
    });
    let vector: Vec<Angles<DualSVec64<19>>> = cases.iter().map(|case| case.map(DualSVec64::from)).collect();
    let vector: Vec<Angles<DualSVec64<19>>> = vector
        .into_iter()
        .map(|case| {
            let mut row = case.row();
            for (i, x) in row.iter_mut().enumerate() {
                x.eps = num_dual::Derivative::derivative_generic(nalgebra::Const::<19>, nalgebra::U1, i);
            }
            Angles::from_row(row)
        })
        .collect();
    group.bench_function(BenchmarkId::new("angles", "DualSVec64<19>"), |b| {
        b.iter(|| {
            for case in black_box(&vector) {
                black_box(outputs_with_directions(&collision_from_angles(case).evaluate()));
            }
        });
    });
    let interval: Vec<[Interval; Directions::COUNT]> = cases.iter().map(|case| case.directions().map(Interval::from)).collect();
    group.bench_function(BenchmarkId::new("directions", "Interval"), |b| {
        b.iter(|| {
            for case in black_box(&interval) {
                black_box(outputs(&collision(*case).evaluate()));
            }
        });
    });
    let rational: Vec<[BigRational; Directions::COUNT]> = cases.iter().map(inputs::in_rationals).collect();
    group.sample_size(10);
    group.bench_function(BenchmarkId::new("directions", "BigRational"), |b| {
        b.iter(|| {
            for case in black_box(&rational) {
                black_box(outputs(&collision(case.clone()).evaluate()));
            }
        });
    });
    group.finish();
}

/// Does nothing without the feature.
#[cfg(not(feature = "reconstruct"))]
fn reconstruct(_: &mut Criterion) {}

criterion_group!(benches, directions, angles, scalars, derivatives::derivatives, crush::crush, batch, reconstruct, uncertainty);
criterion_main!(benches);
