//! A million samples of six uncertain inputs: 16 outputs of a batch alone; with moments and quantiles of all; and the loop that one would write, with
//! `rand_distr`.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput};
use planar_impact::batch::Batch;
use planar_impact::uncertainty::{Direct, MonteCarlo, Search};
use planar_impact::*;
use rand::SeedableRng;
use rand_distr::{Distribution as _, Normal};

use super::batch::SIXTEEN;
use super::inputs;

const SAMPLES: usize = 1_000_000;
/// Rows of a batch that stay in cache.
const ROWS: usize = 1920;

pub fn uncertainty(c: &mut Criterion) {
    let collision = inputs::collision_from_angles(&inputs::cases(1)[0]);
    let spread = |input: Input, share: f64| {
        let mean = collision.input(input).expect("an input");
        (input, Distribution::Normal { mean, sd: share * mean.abs().max(0.1) })
    };
    let [one, two] = Side::ALL;
    let inputs = [
        spread(Input::VelocityX(one), 0.02),
        spread(Input::VelocityY(two), 0.02),
        spread(Input::Mass(one), 0.02),
        spread(Input::Mass(two), 0.02),
        spread(Input::CrushPlane, 0.02),
        spread(Input::Restitution, 0.02),
    ];
    let uncertain = collision.uncertain(&inputs).expect("uncertain");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = c.benchmark_group("uncertainty");
    group.sample_size(10).throughput(Throughput::Elements(SAMPLES as u64));
    let columns: Vec<Vec<f64>> =
        inputs.iter().map(|(_, of)| (0..ROWS).map(|i| of.quantile((i as f64 + 0.5) / ROWS as f64)).collect()).collect();
    let batch = inputs
        .iter()
        .zip(&columns)
        .fold(Batch::of(collision), |batch, ((input, _), column)| batch.with(*input, column).expect("as many rows"));
    group.bench_function("batch alone, in cache", |b| {
        b.iter(|| {
            for _ in 0..SAMPLES / ROWS {
                black_box(black_box(&batch).solve(&SIXTEEN));
            }
        });
    });
    group.bench_function("moments and quantiles", |b| {
        b.iter(|| pool.install(|| black_box(&uncertain).monte_carlo(&SIXTEEN, &MonteCarlo::of(SAMPLES as u64))));
    });
    group.bench_function("plain loop with rand_distr", |b| {
        let normals = inputs.map(|(input, of)| (input, Normal::new(of.mean(), of.sd()).expect("a normal distribution")));
        b.iter(|| {
            let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
            let (mut values, mut sums) = (vec![Vec::with_capacity(SAMPLES); SIXTEEN.len()], [[0.0; 2]; SIXTEEN.len()]);
            for _ in 0..SAMPLES {
                let mut sample = collision;
                for (input, normal) in &normals {
                    sample.set(*input, normal.sample(&mut random)).expect("an input");
                }
                let Ok(impact) = sample.solve() else { continue };
                for ((of, values), sums) in SIXTEEN.iter().zip(&mut values).zip(&mut sums) {
                    let x = of.of(&sample, &impact);
                    values.push(x);
                    *sums = [sums[0] + x, sums[1] + x * x];
                }
            }
            for column in &mut values {
                for share in [0.025, 0.5, 0.975] {
                    let place = (share * column.len() as f64) as usize;
                    black_box(column.select_nth_unstable_by(place, f64::total_cmp));
                }
            }
            black_box(sums)
        });
    });
    group.finish();
    bounds(c, collision);
}

/// Guaranteed ranges over the paper's two doubtful numbers to 10⁻¹², and over six inputs to 10⁻⁶.
fn bounds(c: &mut Criterion, collision: Collision) {
    let around = |input: Input, by: f64| {
        let middle = collision.input(input).expect("an input");
        (input, (middle - by, middle + by))
    };
    let [one, two] = Side::ALL;
    let paper = [around(Input::CrushPlane, 0.14), (Input::Restitution, (0.0, 0.3))];
    let others = [
        around(Input::VelocityX(one), 0.5),
        around(Input::VelocityY(two), 0.5),
        around(Input::Mass(one), 30.0),
        around(Input::Mass(two), 30.0),
    ];
    let six = [&paper[..], &others].concat();
    let mut group = c.benchmark_group("bounds");
    group.sample_size(10);
    for (name, box_, gap) in [("two", &paper[..], 1e-12), ("six", &six[..], 1e-6)] {
        let (inputs, ranges): (Vec<Input>, Vec<(f64, f64)>) = box_.iter().copied().unzip();
        let mapping = Direct(inputs);
        for of in [Output::NormalWork, Output::Loss, Output::DeltaVMagnitude(one), Output::PrincipalDirectionOfForce(one)] {
            // Enough for a tight range, and no more: an output whose range is not tight would take minutes.
            let search = Search { gap, cells: 20_000 };
            let range = || uncertainty::bounds(&collision, &mapping, &ranges, of, &search, &|_| true);
            let found = range().expect("a box that physics accepts");
            eprintln!("bounds over {name} inputs, {of}: tight: {}, after {} cells", found.is_tight, found.cells);
            group.bench_function(BenchmarkId::new(of.to_string(), name), |b| b.iter(|| black_box(range())));
        }
    }
    group.finish();
    all_inputs(&collision);
}

/// Says what is proven in ten seconds of all inputs together, each within 2 % of itself, or of 1 in SI where it is less.
fn all_inputs(collision: &Collision) {
    let inputs: Vec<Input> = Input::ALL.into_iter().filter(|input| collision.input(*input).is_some()).collect();
    let range = |input: &Input| {
        let middle = collision.input(*input).expect("it has it");
        let by = 0.02 * middle.abs().max(1.0);
        // A restitution is not below zero.
        if *input == Input::Restitution { (middle, middle + by) } else { (middle - by, middle + by) }
    };
    let ranges: Vec<(f64, f64)> = inputs.iter().map(range).collect();
    let mapping = Direct(inputs);
    for of in [Output::NormalWork, Output::Loss, Output::DeltaVMagnitude(Side::One), Output::PrincipalDirectionOfForce(Side::One)] {
        let start = Instant::now();
        let goes_on = |_| start.elapsed() < Duration::from_secs(10);
        let search = Search { gap: 1e-6, cells: usize::MAX };
        let found = uncertainty::bounds(collision, &mapping, &ranges, of, &search, &goes_on).expect("a box that physics accepts");
        let share = (found.high - found.low) / (found.high_attained - found.low_attained);
        eprintln!(
            "bounds over {} inputs, {of}: tight: {}; the range proven is {share:.4} times that attained, after {:.2} s and {} cells",
            ranges.len(),
            found.is_tight,
            start.elapsed().as_secs_f64(),
            found.cells
        );
    }
}
