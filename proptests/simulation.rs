//! A simulation is the summary of its samples: the same bits for any number of threads and any vector instructions, and the numbers that the samples themselves
//! have.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use planar_impact::batch::Instructions;
use planar_impact::simulation::{Exceedance, Extremes, Fill, Histogram, Moments, NotDrawn, Quantiles, Reduce, Samples, Simulation};
use planar_impact::*;
use statrs::distribution::{ContinuousCDF, Normal};

const OF: [Output; 3] = [Output::DeltaVMagnitude(Side::One), Output::Loss, Output::YawRate(Side::Two)];

/// Two cars side to front; one in ten samples does not close.
fn simulation() -> Simulation {
    let one = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    let two = Vehicle::new(1200.0, 1800.0).with_heading(Heading::from_angle(2.0)).with_impact_center(1.5, -0.4).with_speed(5.0);
    Simulation::of(Collision::new(one, two).with_restitution(0.1))
        .with(Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 14.0 })
        .and_then(|simulation| simulation.with(Input::CrushPlane, Distribution::Uniform { min: -0.3, max: 0.3 }))
        .and_then(|simulation| simulation.with(Input::Restitution, Distribution::Triangular { min: 0.0, mode: 0.1, max: 0.4 }))
        .and_then(|simulation| simulation.with(Input::Mass(Side::Two), Distribution::LogNormal { median: 1200.0, log_sd: 0.1 }))
        .expect("distributions of its inputs")
}

type Summary = (Moments, Quantiles, Extremes, Histogram, Vec<Exceedance>);

fn summary() -> Summary {
    let exceed = vec![Exceedance::of(OF[0], 5.0), Exceedance::of(OF[0], 9.0)];
    (Moments::of(&OF).with_covariances(), Quantiles::of(&OF), Extremes::of(&OF), Histogram::of(OF[0], 2.0, 12.0, 20), exceed)
}

fn on_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(run)
}

#[test]
fn any_threads_and_instructions_give_the_same_bits() {
    const SAMPLES: u64 = 1_300_000;
    let simulation = simulation();
    let text = |threads: usize, set: Instructions| {
        let answer = on_threads(threads, || simulation.clone().on(set).reduce(SAMPLES, summary(), &|_| true));
        assert_eq!(answer.samples, SAMPLES);
        // Every digit of every number is in it.
        format!("{answer:?}")
    };
    let wanted = text(1, Instructions::Compiled);
    for threads in [2, 3, 7] {
        assert!(text(threads, Instructions::Compiled) == wanted, "{threads} threads");
    }
    for set in Instructions::available() {
        assert!(text(2, set) == wanted, "{set:?}");
    }
    let other = on_threads(2, || simulation.clone().with_seed(1).reduce(SAMPLES, summary(), &|_| true));
    assert!(format!("{other:?}") != wanted, "another seed");
}

/// Solves every sample by itself, and summarizes it without a shortcut.
#[test]
fn a_summary_is_that_of_its_samples() {
    const SAMPLES: u64 = 70_000; // More than one stretch.
    let simulation = simulation();
    let answer = simulation.reduce(SAMPLES, summary(), &|_| true);
    let solved: Vec<(u64, Outputs)> = (0..SAMPLES)
        .filter_map(|number| {
            let collision = simulation.sample(number);
            Some((number, Outputs::of(&collision, &collision.solve().ok()?)))
        })
        .collect();
    let refused = SAMPLES - solved.len() as u64;
    assert!((SAMPLES / 20..SAMPLES / 2).contains(&refused), "{refused}");
    assert_eq!(answer.refused.samples, refused);
    assert!(answer.refused.by_code.values().all(|count| *count <= refused), "{:?}", answer.refused);
    assert!(answer.refused.by_code["separating"] > refused / 2, "{:?}", answer.refused);
    let (moments, quantiles, extremes, histogram, exceed) = answer.summary;
    assert_eq!(moments.samples(), SAMPLES - refused);
    let column = |of: Output| solved.iter().map(|(_, outputs)| outputs[of]).collect::<Vec<f64>>();
    let n = solved.len() as f64;
    let mean = |x: &[f64]| x.iter().sum::<f64>() / n;
    for one in OF {
        let x = column(one);
        let deviations = |x: &[f64]| {
            let mean = mean(x);
            x.iter().map(|value| value - mean).collect::<Vec<f64>>()
        };
        for other in OF {
            let y = column(other);
            let product: f64 = deviations(&x).iter().zip(deviations(&y)).map(|(x, y)| x * y).sum();
            let scale = (moments.variance(one) * moments.variance(other)).sqrt();
            assert!((moments.covariance(one, other) - product / (n - 1.0)).abs() < 1e-11 * scale, "{one}, {other}");
        }
        assert!((moments.mean(one) - mean(&x)).abs() < 1e-12 * moments.variance(one).sqrt());
        assert!((moments.standard_error(one) - (moments.variance(one) / n).sqrt()).abs() < 1e-15 * moments.variance(one).sqrt());
        let mut sorted = x.clone();
        sorted.sort_by(f64::total_cmp);
        for share in [0.0, 0.001, 0.025, 0.5, 0.9, 0.999, 1.0] {
            let wanted = sorted[(share * (n - 1.0)).round() as usize];
            let found = quantiles.quantile(one, share);
            assert!((found - wanted).abs() <= 0.004 * wanted.abs(), "{one}, {share}: {found}, {wanted}");
        }
        assert_eq!((quantiles.quantile(one, 0.0), quantiles.quantile(one, 1.0)), (sorted[0], sorted[sorted.len() - 1]));
        let [least, greatest] = extremes.get(one).expect("samples");
        assert_eq!([least.value, greatest.value], [sorted[0], sorted[sorted.len() - 1]]);
        for extreme in [least, greatest] {
            let first = solved.iter().find(|(_, outputs)| outputs[one] == extreme.value).map(|(number, _)| *number);
            assert_eq!(Some(extreme.sample), first);
        }
    }
    let x = column(OF[0]);
    let within = |low: f64, high: f64| x.iter().filter(|value| (low..high).contains(*value)).count() as u64;
    for (bin, count) in histogram.counts().iter().enumerate() {
        assert_eq!(*count, within(histogram.edge(bin), histogram.edge(bin + 1)), "bin {bin}");
    }
    assert_eq!([histogram.below, histogram.above, histogram.not_a_number], [within(0.0, 2.0), within(12.0, f64::INFINITY), 0]);
    for (exceed, threshold) in exceed.iter().zip([5.0, 9.0]) {
        assert_eq!((exceed.above, exceed.samples), (within(threshold, f64::INFINITY), solved.len() as u64));
        let share = exceed.above as f64 / n;
        assert_eq!((exceed.share(), exceed.standard_error()), (share, (share * (1.0 - share) / n).sqrt()));
    }
}

/// ΔV of a central impact on a barrier is (1 + e) v: its distribution is known.
#[test]
fn a_known_distribution_is_found() {
    const SAMPLES: u64 = 1_000_000;
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0);
    let simulation = Simulation::of(Collision::new(car, Party::Barrier).with_restitution(0.25))
        .with(Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 2.0 })
        .expect("a distribution");
    let delta_v = OF[0];
    let answer = simulation.reduce(SAMPLES, (Moments::of(&[delta_v]), Quantiles::of(&[delta_v])), &|_| true);
    let (moments, quantiles) = answer.summary;
    assert_eq!(answer.refused.samples, 0);
    // Four standard errors.
    let error = 2.5 / (SAMPLES as f64).sqrt();
    assert!((moments.mean(delta_v) - 18.75).abs() < 4.0 * error, "{}", moments.mean(delta_v));
    assert!((moments.variance(delta_v).sqrt() - 2.5).abs() < 4.0 * error / 2.0_f64.sqrt());
    let normal = Normal::new(18.75, 2.5).expect("a deviation");
    for share in [0.01, 0.1, 0.5, 0.9, 0.99] {
        let wanted = normal.inverse_cdf(share);
        assert!((quantiles.quantile(delta_v, share) / wanted - 1.0).abs() < 2e-3, "{share}");
    }
}

#[test]
fn a_simulation_stops_when_it_is_told_to() {
    let simulation = simulation();
    let calls = AtomicU64::new(0);
    let goes_on = |done: u64| {
        assert!(done <= 10_000_000);
        calls.fetch_add(1, Ordering::Relaxed) < 5
    };
    let stopped = on_threads(2, || simulation.reduce(10_000_000, Moments::of(&OF), &goes_on));
    assert!((1..=400_000).contains(&stopped.samples), "{}", stopped.samples);
    // It is the answer of the samples before.
    assert_eq!(stopped, simulation.reduce(stopped.samples, Moments::of(&OF), &|_| true));
    let none = simulation.reduce(0, summary(), &|_| true);
    assert_eq!((none.samples, none.summary.0.samples()), (0, 0));
    let nothing = none.summary;
    assert!(nothing.0.mean(OF[0]).is_nan() && nothing.1.quantile(OF[0], 0.5).is_nan() && nothing.2.get(OF[0]).is_none());
    assert!(nothing.4[0].share().is_nan());
}

#[test]
fn without_an_uncertain_input_every_sample_is_the_collision() {
    let collision = simulation().sample(0);
    let answer = Simulation::of(collision).reduce(5000, (Moments::of(&OF), Extremes::of(&OF)), &|_| true);
    let outputs = Outputs::of(&collision, &collision.solve().expect("a collision"));
    for of in OF {
        assert_eq!(answer.summary.1.get(of).map(|extremes| extremes.map(|extreme| extreme.value)), Some([outputs[of]; 2]));
        assert!(answer.summary.0.variance(of) < 1e-20 * outputs[of] * outputs[of]);
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let normal = Distribution::Normal { mean: 0.5, sd: 0.1 };
    let barrier =
        || Simulation::of(Collision::new(Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0), Party::Barrier));
    let missing = barrier().with(Input::Mass(Side::Two), normal);
    assert_eq!(missing.err(), Some(NotDrawn::NoSuchInput(NoSuchInput(Input::Mass(Side::Two)))));
    assert!(matches!(barrier().with(Input::ImpulseRatio, normal).err(), Some(NotDrawn::NoSuchInput(_))));
    let twice = barrier().with(Input::Restitution, normal).and_then(|simulation| simulation.with(Input::Restitution, normal));
    assert_eq!(twice.err(), Some(NotDrawn::Twice(Input::Restitution)));
    let wrong = barrier().with(Input::Restitution, Distribution::Normal { mean: 0.5, sd: -0.1 }).err();
    assert!(wrong.is_some_and(|wrong| wrong.to_string().contains("contact.restitution")));
}

/// A source of numbers that are not random, some of them not numbers, and a summary of one's own.
#[derive(Clone, Debug)]
struct Grid;

impl Fill for Grid {
    fn inputs(&self) -> &[Input] {
        &[Input::Restitution]
    }

    fn fill(&self, samples: Range<u64>, columns: &mut [Vec<f64>]) {
        columns[0] = samples.map(|i| if i % 10 == 3 { f64::NAN } else { (i % 10) as f64 / 10.0 }).collect();
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Numbers(Vec<(u64, f64)>);

impl Reduce for Numbers {
    fn outputs(&self) -> Vec<Output> {
        vec![Output::Restitution]
    }

    fn take(&mut self, samples: &Samples<'_>) {
        self.0.extend(samples.column(Output::Restitution).iter().enumerate().map(|(place, e)| (samples.number(place), *e)));
    }

    fn merge(&mut self, later: Self) {
        self.0.extend(later.0);
    }
}

#[test]
fn samples_keep_their_numbers_beside_those_refused() {
    const SAMPLES: u64 = 130_000;
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0);
    let simulation = Simulation::filled(Collision::new(car, Party::Barrier), Grid);
    let answer = on_threads(3, || simulation.reduce(SAMPLES, Numbers::default(), &|_| true));
    assert_eq!((answer.refused.samples, answer.refused.by_code["not-finite"]), (SAMPLES / 10, SAMPLES / 10));
    assert!(answer.summary.0.iter().copied().eq((0..SAMPLES).filter(|i| i % 10 != 3).map(|i| (i, (i % 10) as f64 / 10.0))));
}
