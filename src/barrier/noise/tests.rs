use super::*;
use crate::barrier::{Record, Window};
use approx::assert_relative_eq;
use num_rational::BigRational;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use statrs::distribution::{ContinuousCDF as _, StudentsT};

fn exact(samples: &[i64]) -> Noise<BigRational> {
    let samples: Vec<BigRational> = samples.iter().map(|value| BigRational::from_integer((*value).into())).collect();
    let mean = samples.iter().fold(BigRational::int(0), |sum, each| sum + each) / whole::<BigRational>(samples.len());
    Noise::of(&samples, &mean)
}

fn fraction(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

#[test]
fn covariances_are_those_of_deviations_and_of_their_mean() {
    // Deviations 3, 1, −1, −3 twice: S_0 = 40, S_1 = 2 (3 − 1 + 3) − 9 = 1, S_2 = −18, so K = 1 and v = (40 + 2)/(8 · 5).
    let steps = exact(&[3, 1, -1, -3, 3, 1, -1, -3]);
    assert_eq!(steps.covariances, [fraction(5, 1) + fraction(42, 40), fraction(1, 8) + fraction(42, 40)]);
    assert_eq!(steps.independent_samples(), fraction(8, 1) * fraction(242, 40) / (fraction(242, 40) + fraction(2 * 47, 40)));
    // In turn: not correlated, so the variance is the usual one.
    let turns = exact(&[1, -1, 1, -1, 1, -1, 1, -1]);
    assert_eq!((turns.covariances.as_slice(), turns.independent_samples()), ([fraction(8, 7)].as_slice(), fraction(8, 1)));
    // A variance of a weighted sum: γ_0 Σ w² + 2 γ_1 Σ w w, and at least the first.
    let weights = |of: [i64; 3]| of.map(|weight| fraction(weight, 1));
    assert_eq!(steps.variance_of_sum(&weights([1, 2, 1])), fraction(242, 40) * fraction(6, 1) + fraction(2 * 4 * 47, 40));
    assert_eq!(steps.variance_of_sum(&weights([1, -1, 1])), fraction(242, 40) * fraction(3, 1));
    // A constant has no noise.
    let constant = exact(&[7; 5]);
    assert_eq!((constant.covariances.as_slice(), constant.independent_samples()), ([fraction(0, 1)].as_slice(), fraction(5, 1)));
}

#[test]
fn of_two_samples_to_a_drift_there_is_a_variance() {
    for count in 2..40 {
        let drift = exact(&(0..count).collect::<Vec<_>>());
        let zero = BigRational::int(0);
        assert!(drift.covariances.iter().all(|covariance| zero < *covariance), "{count}");
        assert!(drift.covariances.len() <= 1 + count as usize / 4);
        assert!(drift.independent_samples() <= fraction(count, 1));
    }
}

/// Noise that keeps a part of itself from sample to sample, with a variance of 1.
fn correlated(part: f64, count: usize, random: &mut ChaCha8Rng) -> Vec<f64> {
    let fresh = (1.0 - part * part).sqrt();
    let mut last: f64 = StandardNormal.sample(random);
    let mut next = || {
        let normal: f64 = StandardNormal.sample(random);
        last = part * last + fresh * normal;
        last
    };
    (0..count).map(|_| next()).collect()
}

/// Impulses of nothing but noise, over a window as long as the baseline and over three: their standard deviations hold them as often as they say.
#[test]
fn impulses_of_correlated_noise_are_as_uncertain_as_they_say() {
    const TRIALS: usize = 1000;
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let strata = [
        (0.0, 2, 0.93),
        (0.0, 3, 0.93),
        (0.0, 5, 0.93),
        (0.0, 12, 0.93),
        (0.0, 100, 0.935),
        (0.3, 20, 0.93),
        (0.3, 50, 0.93),
        (0.6, 30, 0.92),
        (0.6, 100, 0.935),
        (0.9, 100, 0.915),
        (0.9, 400, 0.93),
    ];
    for (part, count, least) in strata {
        for windows in [1, 3] {
            let (mut held, mut independent) = (0, 0.0);
            for _ in 0..TRIALS {
                let record = Record::uniform(0.0, 1.0, correlated(part, (1 + windows) * count, &mut random)).expect("a record");
                let before = Window { from: 0.0, to: (count - 1) as f64 };
                let over = Window { from: count as f64, to: ((1 + windows) * count - 1) as f64 };
                let impulse = record.impulse(&over, &before).expect("an impulse");
                held += usize::from(impulse.value.abs() <= 1.96 * impulse.variance.sqrt());
                independent += record.independent_samples(&before).expect("samples") / TRIALS as f64;
            }
            let share = held as f64 / TRIALS as f64;
            assert!(share >= least && share < 0.985, "{part} {count} {windows}: {share}");
            let expected = count as f64 * (1.0 - part) / (1.0 + part);
            assert!(
                expected < 10.0 || part == 0.0 && count < 20 || (independent / expected - 1.0).abs() < 0.3,
                "{part} {count}: {independent} {expected}"
            );
        }
    }
    assert_relative_eq!(Noise::of(&[1.0, -1.0], &0.0).variance_of_sum(&[3.0]), 18.0);
}

/// Samples that are not correlated: of turns of ±1 the products of neighbors are negative.
#[test]
fn the_wide_variance_is_that_of_students_quantile() {
    let normal = 1.959_963_984_540_054_f64;
    for count in (2..60).chain([100, 1000]) {
        let turns: Vec<f64> = (0..count).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let noise = Noise::of(&turns, &(turns.iter().sum::<f64>() / count as f64));
        assert_relative_eq!(noise.independent_samples(), count as f64, max_relative = 1e-12);
        let student = StudentsT::new(0.0, 1.0, count as f64 - 1.0).expect("a distribution").inverse_cdf(0.975);
        let factor = noise.wide_variance_of_sum(&[2.0]) / noise.variance_of_sum(&[2.0]);
        assert_relative_eq!(factor, (student / normal).powi(2), max_relative = 5e-3);
    }
    // A drift of eight samples is correlated over two steps: 8/5 − 1 degrees of freedom, for which those of 1 are taken.
    let drift = Noise::of(&[-3.0, -2.0, -1.0, 0.0, 0.0, 1.0, 2.0, 3.0_f64], &0.0);
    assert_eq!(drift.covariances.len(), 3);
    assert!(drift.independent_samples() < 2.5, "{}", drift.independent_samples());
    let factor = |noise: &Noise<f64>| (noise.wide_variance_of_sum(&[1.0; 8]) / noise.variance_of_sum(&[1.0; 8])).sqrt() * normal;
    assert_relative_eq!(factor(&drift), 12.706, max_relative = 5e-3);
    // Over one step: 24/3 − 1 of 24 samples.
    let slow = Noise { covariances: vec![1.0, 0.5], samples: 24 };
    assert_relative_eq!(factor(&slow), 2.364_6, max_relative = 5e-3);
}
