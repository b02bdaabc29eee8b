//! Force records and films: known pulses, the filter, and LOWESS.

use crate::noise::{Count, Noise};
use crate::rational::Rational;
use crate::strategies::{Fraction, OrReject, config, fewer};
use num_dual::Dual64;
use planar_impact::barrier::*;
use planar_impact::{Field, Ordered, Real};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::fmt::Debug;

#[derive(Clone, Copy, Debug)]
enum Pulse {
    Haversine,
    HalfSine,
    Triangle,
}

impl Pulse {
    /// Returns the force at a fraction of the duration, as a fraction of the peak.
    fn at(self, share: f64) -> f64 {
        match self {
            _ if !(0.0..=1.0).contains(&share) => 0.0,
            Pulse::Haversine => (PI * share).sin().powi(2),
            Pulse::HalfSine => (PI * share).sin(),
            Pulse::Triangle => 1.0 - (2.0 * share - 1.0).abs(),
        }
    }

    /// Returns the integral over the duration, as a fraction of peak times duration.
    fn integral(self) -> f64 {
        match self {
            Pulse::Haversine | Pulse::Triangle => 0.5,
            Pulse::HalfSine => 2.0 / PI,
        }
    }
}

const STEP: f64 = 1e-4;

/// Returns a record with 0.1 s of zero force, then 0.3 s that contain a pulse.
fn record(pulse: Pulse, peak: f64, start: f64, duration: f64, mut disturbance: impl FnMut() -> f64) -> Record {
    let time = |i: i32| STEP * f64::from(i - 1000);
    let values = (0..=4000).map(|i| peak * pulse.at((time(i) - start) / duration) + disturbance()).collect();
    Record::uniform(time(0), STEP, values).expect("a good record")
}

const BEFORE: Window = Window { from: -0.1, to: -STEP };
const OVER: Window = Window { from: 0.0, to: 0.3 };

fn small() -> impl Strategy<Value = Vec<i32>> {
    proptest::collection::vec(-9..=9_i32, 5)
}

fn exact(values: &[i32]) -> Vec<Rational> {
    values.iter().map(|&value| Rational::int(value)).collect()
}

fn pulse() -> impl Strategy<Value = (Pulse, f64, f64)> {
    let shape = prop_oneof![Just(Pulse::Haversine), Just(Pulse::HalfSine), Just(Pulse::Triangle)];
    (shape, 0.01..0.08_f64, 0.04..0.12_f64)
}

proptest! {
    #![proptest_config(fewer(50))]

    #[test]
    fn impulses_of_known_pulses((pulse, start, duration) in pulse(), offset in -2e3..2e3_f64, level in 0.0..1e3_f64, seed in any::<u8>()) {
        let peak = 1e5;
        let mut noise = Noise::of_seed(seed);
        let raw = record(pulse, peak, start, duration, || offset + level * noise.normal());
        let exact = peak * duration * pulse.integral();
        // Trapezoids between samples that do not resolve the kinks: each kink causes an error of h²/8 times its
        // change of slope, and curvature one of h²/12 times its integral. Relative to F/T, the slopes of all three
        // pulses sum to less than 2.
        let of_sampling = 2.0 * STEP * STEP * peak / duration;
        // The 3000 intervals of the window, and its length times the mean of 1000 samples: all with the same noise.
        let of_noise = 6.0 * level * STEP * (3000.0_f64 + 3000.0 * 3000.0 / 1000.0).sqrt();
        let impulse = raw.impulse(&OVER, &BEFORE).expect("good windows");
        let allowed = of_sampling + of_noise + 1e-9 * exact;
        prop_assert!((impulse.value - exact).abs() <= allowed, "{} where {} is exact, {} allowed", impulse.value, exact, allowed);
        // The noise of 1000 samples determines its own level to 1/√2000; what is correlated in it by chance adds a half at most in 20 000 simulations.
        prop_assert!(6.0 * impulse.deviation() >= of_noise * (1.0 - 6.0 / 2000_f64.sqrt()) - 1e-9 * exact);
        prop_assert!(6.0 * impulse.deviation() <= 1.6 * of_noise + 1e-9 * exact);
        // Step by step, the result is the same.
        let step_by_step = raw.corrected(&BEFORE).expect("a good window").impulse_over(&OVER).expect("a good window");
        prop_assert!((impulse.value - step_by_step).abs() <= 1e-9 * (exact + 3e3 * offset.abs()));
    }

    #[test]
    fn the_filter_keeps_the_impulse((pulse, start, duration) in pulse(), class in 0..4_usize) {
        let raw = record(pulse, 1e5, start, duration, || 0.0);
        let filtered = raw.filtered(ChannelClass::ALL[class]).expect("sampled at 10 kHz");
        prop_assert!((filtered.integral() - raw.integral()).abs() <= 1e-9 * raw.integral());
    }

    /// The filtered record is reversed if the record is reversed in time, and shifted if it is shifted by some
    /// samples, so nothing is delayed.
    #[test]
    fn the_filter_is_symmetric((pulse, start, duration) in pulse(), moved in 1..500_usize, class in 0..4_usize) {
        let raw = record(pulse, 1.0, start, duration, || 0.0);
        let filter = ChannelFilter::new(ChannelClass::ALL[class], STEP).expect("sampled at 10 kHz");
        let mut skewed: Vec<f64> = raw.values().iter().enumerate().map(|(i, value)| value * i as f64 / 4000.0).collect();
        let filtered = filter.filter(&skewed);
        skewed.rotate_right(moved);
        for (i, value) in filter.filter(&skewed).into_iter().enumerate().skip(moved) {
            prop_assert!((value - filtered[i - moved]).abs() < 1e-9, "moved by {}: {} and {} at {}", moved, value, filtered[i - moved], i);
        }
        skewed.rotate_left(moved);
        skewed.reverse();
        let turned = filter.filter(&skewed);
        for (one, other) in filtered.iter().zip(turned.iter().rev()) {
            prop_assert!((one - other).abs() < 1e-9, "turned around: {} and {}", one, other);
        }
    }
}

/// Noise that a filter in the recorder has smoothed: each sample keeps a share of the one before it.
#[test]
fn correlated_noise_is_in_the_deviation() {
    const SETS: u32 = 300;
    for (kept, mean_square) in [(0.0, 0.85..1.2), (0.5, 0.8..1.3), (0.9, 0.8..1.7)] {
        let mut noise = Noise::of_seed(7);
        let mut last = 0.0;
        let squares = (0..SETS).map(|_| {
            let mut next = || {
                last = kept * last + 100.0 * noise.normal();
                last
            };
            let record = record(Pulse::Haversine, 0.0, 0.0, 0.1, &mut next);
            let impulse = record.impulse(&OVER, &BEFORE).expect("good windows");
            impulse.value * impulse.value / impulse.variance
        });
        let found = squares.sum::<f64>() / f64::from(SETS);
        assert!(mean_square.contains(&found), "{kept}: {found}");
    }
}

/// A half-sine on which everything up to twice the rate of the samples rides, so that each sample is almost by itself.
#[test]
fn a_pulse_that_its_samples_do_not_resolve_has_a_deviation_of_its_samples() {
    const SETS: u32 = 300;
    let mut noise = Noise::of_seed(3);
    for (steps, baseline) in [(100, 0.0), (100, 0.03), (27, 0.03)] {
        let squares = (0..SETS).map(|_| {
            let parts: Vec<_> = (1..=2 * steps).map(|k| (2.0 * f64::from(k), 0.14 * noise.normal(), 0.14 * noise.normal())).collect();
            // ∫ sin x cos 2kx = 2/(1 − 4k²) over half a turn, and ∫ sin x sin 2kx = 0.
            let exact = f64::from(steps) / PI * parts.iter().fold(2.0, |sum, (k, cos, _)| sum + 2.0 * cos / (1.0 - k * k));
            let from = noise.normal();
            let mut value = |i: i32| {
                let x = (f64::from(i) - from) * PI / f64::from(steps);
                let rough = parts.iter().fold(1.0, |sum, (k, cos, sin)| sum + cos * (k * x).cos() + sin * (k * x).sin());
                let pulse = if (0.0..=PI).contains(&x) { x.sin() * rough } else { 0.0 };
                pulse + baseline * noise.normal()
            };
            let record = Record::uniform(-60.0, 1.0, (-60..steps + 10).map(&mut value).collect()).expect("a good record");
            let over = Window { from: -5.0, to: f64::from(steps) + 5.0 };
            let impulse = record.impulse(&over, &Window { from: -60.0, to: -10.0 }).expect("good windows");
            (impulse.value - exact).powi(2) / impulse.variance
        });
        let found = squares.sum::<f64>() / f64::from(SETS);
        assert!((0.8..1.5).contains(&found), "{steps}, {baseline}: {found}");
    }
}

proptest! {
    #![proptest_config(fewer(100))]

    /// With any coefficients of its kind, in rationals.
    #[test]
    fn the_filter_is_linear(one in small(), other in small(), factor in -5..=5_i32, constant in -9..=9_i32, corner in 1..=4_i32) {
        let filter = ChannelFilter::of_warped_corner(Rational::int(1), Fraction(corner, 5).of(), Fraction(7, 5).of::<Rational>());
        let factor = Rational::int(factor);
        let sum: Vec<_> = exact(&one).into_iter().zip(exact(&other)).map(|(a, b)| a + factor.clone() * b).collect();
        let expected: Vec<_> = filter.filter(&exact(&one)).into_iter().zip(filter.filter(&exact(&other))).map(|(a, b)| a + factor.clone() * b).collect();
        prop_assert_eq!(filter.filter(&sum), expected);
        prop_assert_eq!(filter.filter(&exact(&[constant; 5])), exact(&[constant; 5]));
    }

    #[test]
    fn lowess_keeps_straight_lines(gaps in proptest::collection::vec(1..=3_i32, 4..10), (a, b) in (-9..=9_i32, -9..=9_i32), neighbors in 4..=11_usize, even in any::<bool>(), share in 0..=12_i32) {
        let int = Rational::int;
        let mut times = vec![int(0)];
        for gap in gaps {
            let last = times[times.len() - 1].clone();
            times.push(last + int(if even { 1 } else { gap }));
        }
        let at = times[times.len() - 1].clone() * Fraction(share, 12).of::<Rational>();
        let values = times.iter().map(|t| int(a) + int(b) * t.clone()).collect();
        let record = Record::at_times(times, values).expect("a good record");
        let neighbors = neighbors.min(record.len());
        let line = Lowess { neighbors, robust_passes: 2 }.smooth(&record).and_then(|smoothed| smoothed.at(at.clone()));
        // At equal intervals four neighbors are always enough; with unequal ones a sample may be alone within its span.
        prop_assert!(line.is_ok() || !even);
        let line = line.or_reject("a sample is alone")?;
        prop_assert_eq!(line.value.value, int(a) + int(b) * at);
        prop_assert_eq!(line.slope.value, int(b));
        prop_assert_eq!(line.slope.variance, int(0));
    }
}

/// Generates numbers of any kind: NaN, infinite, huge, tiny.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![proptest::num::f64::ANY, Just(0.0), Just(f64::MAX), Just(f64::MIN), Just(f64::MIN_POSITIVE), -10.0..10.0_f64]
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn no_record_panics(values in proptest::collection::vec(any_number(), 0..12), times in proptest::collection::vec(any_number(), 0..12), a in any_number(), b in any_number(), c in any_number(), neighbors in 0..14_usize) {
        let mut sorted = times.clone();
        sorted.sort_by(f64::total_cmp);
        let records = [Record::uniform(a, b, values.clone()), Record::at_times(times, values.clone()), Record::at_times(sorted, values)];
        for record in records.into_iter().flatten() {
            let (over, before) = (Window { from: a, to: b }, Window { from: a, to: c });
            if let Ok(impulse) = record.impulse(&over, &before) {
                prop_assert!(impulse.value.is_finite() && impulse.variance.is_finite());
            }
            let _ = (record.impulse_over(&over), record.corrected(&before), record.filtered(ChannelClass::Cfc60), bank(&[record.clone(), record.clone()]));
            for robust_passes in [0, 2] {
                let closing = Estimate { value: a, variance: c };
                if let Ok(e) = restitution_from_film(&record, Lowess { neighbors, robust_passes }, b, closing) {
                    prop_assert!(e.value.is_finite() || a < 1e-100, "{:?} of {:?}", e, record);
                }
            }
        }
    }
}

#[test]
fn the_slope_covers_at_its_rate() {
    let mut noise = Noise::of_seed(4);
    let (samples, data_sets, deviation) = (40, 5000, 0.004);
    let (mut slopes, mut values, mut variance) = (Count::default(), Count::default(), 0.0);
    for i in 0..data_sets {
        let distances = (0..samples).map(|i| 0.3 + 0.02 * f64::from(i) + deviation * noise.normal()).collect();
        let film = Record::uniform(0.0, 0.01, distances).expect("a good record");
        let smoothed = Lowess { neighbors: 13, robust_passes: 0 }.smooth(&film).expect("wide enough");
        variance += smoothed.noise() / f64::from(data_sets);
        let time = f64::from(i % 37) * 0.01;
        let line = smoothed.at(time).expect("inside");
        slopes.add((line.slope.value - 2.0).abs() < line.slope.deviation());
        values.add((line.value.value - 0.3 - 2.0 * time).abs() < line.value.deviation());
    }
    // The noise has about 33 degrees of freedom, for which Student's t has a probability of 0.6754 within one standard deviation.
    slopes.assert_rate("slope", 0.6754);
    values.assert_rate("value", 0.6754);
    // Its variance is unbiased.
    let allowed = 5.0 * (2.0 / 33.0 / f64::from(data_sets)).sqrt();
    assert!((variance / (deviation * deviation) - 1.0).abs() < allowed, "{variance}, within {allowed}");
}

/// A film of a contact of 0.1 s, in at 10 m/s and out at 1 m/s: the bend of the contact is far beyond the noise, and the speeds before and after it are those of the
/// straight parts. However small the noise and whatever the digits, there is an answer, and its deviation is not too small.
#[test]
fn a_sharp_bend_leaves_the_speeds_of_the_straight_parts() {
    const FILMS: u32 = 400;
    let motion = |time: f64| match time {
        _ if time <= 0.0 => 1.2 - 10.0 * time,
        _ if time >= 0.1 => 1.2 - 0.45 + (time - 0.1),
        // A half-sine of deceleration takes 11 m/s.
        _ => 1.2 - 10.0 * time + 5.5 * (time - 0.1 / PI * (PI * time / 0.1).sin()),
    };
    for (level, digit) in [(2e-5, 1e-5), (2e-5, 1e-4), (2e-5, 1e-3), (1e-4, 1e-5), (1e-4, 1e-4), (3e-4, 1e-5)] {
        let mut noise = Noise::of_seed(9);
        let (mut closing, mut leaving) = (Count::default(), Count::default());
        for _ in 0..FILMS {
            // The speeds differ from film to film: a speed of whole digits for each frame is an exception.
            let slope = 0.2 * noise.normal();
            let value = |time: f64, noise: &mut Noise| ((motion(time) + slope * time + level * noise.normal()) / digit).round() * digit;
            let values: Vec<f64> = (-20..=150).map(|i| value(1e-3 * f64::from(i), &mut noise)).collect();
            let lowess = Lowess { neighbors: 9, robust_passes: 3 };
            for (count, range, at, wanted) in [(&mut closing, 0..21, 0.0, slope - 10.0), (&mut leaving, 0..171, 0.12, slope + 1.0)] {
                let film = Record::uniform(-0.02, 1e-3, values[range].to_vec()).expect("a good record");
                let smoothed = lowess.smooth(&film).unwrap_or_else(|issues| panic!("{level} and {digit}: {issues}"));
                let line = smoothed.with_noise_of_at_least(digit * digit / 12.0).at(at).expect("inside");
                count.add((line.slope.value - wanted).abs() < 2.0 * line.slope.deviation());
            }
        }
        // Of 21 frames the noise has few degrees of freedom, fewer with robustness weights; 400 films tell a rate to 0.015.
        assert!(closing.rate() > 0.85, "closing: {}, {level} and {digit}", closing.rate());
        assert!(leaving.rate() > 0.9, "leaving: {}, {level} and {digit}", leaving.rate());
    }
}

/// Computes numbers of a record as functions of one of its samples, its step and one end of the window.
fn numbers<T: Real + Ordered<Mask = bool> + Debug>(sample: T, step: T, to: T) -> [T; 5] {
    let of = |x: f64| T::from_f64(x).expect("a finite number");
    let mut values: Vec<T> = (0..60).map(|i| of((0.17 * f64::from(i)).sin() + 0.1 * f64::from(i % 3))).collect();
    values[20] = sample;
    let record = Record::uniform(of(0.0), step.clone(), values).expect("a good record");
    let window = Window { from: of(0.0035), to: to.clone() };
    let impulse = record.impulse(&window, &Window { from: of(0.0), to: of(0.0021) }).expect("good windows");
    let filtered = record.filtered(ChannelClass::Cfc180).expect("fast enough").values()[22].clone();
    let closing = Estimate::with_deviation(of(100.0), of(2.0));
    let e = restitution_from_film(&record, Lowess { neighbors: 9, robust_passes: 1 }, to, closing).expect("a good film");
    [impulse.value.clone(), impulse.deviation(), filtered, e.value.clone(), e.deviation()]
}

/// For a window that ends on samples: the integral is smooth there, although another interval begins.
#[test]
fn an_end_on_a_sample_has_its_derivative() {
    fn impulse<T: Real + Ordered<Mask = bool> + Debug>(step: T, from: T, to: T) -> T {
        let values = [3, 1, 4, 1, 5, 9, 2, 6].map(T::int).to_vec();
        let record = Record::uniform(T::int(0), step, values).expect("a good record");
        record.impulse_over(&Window { from, to }).expect("inside")
    }
    let h = 1e-6;
    for i in 0..3 {
        let at = |size: f64| {
            let by: [f64; 3] = std::array::from_fn(|j| if i == j { size } else { 0.0 });
            impulse(0.5 + by[0], 1.0 + by[1], 2.5 + by[2])
        };
        let unit: [f64; 3] = std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        let dual = impulse(Dual64::new(0.5, unit[0]), Dual64::new(1.0, unit[1]), Dual64::new(2.5, unit[2])).eps;
        let quotient = (at(h) - at(-h)) / (2.0 * h);
        // The curvature changes there by less than 300.
        assert!((dual - quotient).abs() < 300.0 * h, "by {i}: {dual} and {quotient}");
    }
}

#[test]
fn derivatives_are_difference_quotients() {
    let (sample, step, to, h) = (0.4, 2.5e-4, 0.00512, 1e-6);
    let at = |by: [f64; 3]| numbers(sample + by[0], step + by[1], to + by[2]);
    for i in 0..3 {
        // The step is small relative to the quantity.
        let h = if i == 0 { h } else { h * 1e-3 };
        let by = |size: f64| std::array::from_fn(|j| if i == j { size } else { 0.0 });
        let (ahead, behind) = (at(by(h)), at(by(-h)));
        let unit = by(1.0);
        let dual = numbers(Dual64::new(sample, unit[0]), Dual64::new(step, unit[1]), Dual64::new(to, unit[2]));
        for (j, number) in dual.into_iter().enumerate() {
            let quotient = (ahead[j] - behind[j]) / (2.0 * h);
            assert!((number.eps - quotient).abs() <= 1e-5 * quotient.abs() + 1e-6, "{j} by {i}: {} and {quotient}", number.eps);
        }
    }
}
