//! What is known beforehand: linear and bilinear outputs, and shares of refused samples.

use super::*;
use crate::input::Side::{One, Two};
use crate::output::Output;
use crate::vehicle::{Party, Vehicle};
use Distribution::{LogNormal, Normal, Uniform};

const V: Input = Input::VelocityX(One);
const E: Input = Input::Restitution;
const DELTA_V: Output = Output::DeltaVMagnitude(One);

/// A vehicle that meets a barrier head on: ΔV = (1 + e) v.
fn head_on() -> Collision {
    Collision::new(Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0), Party::Barrier).with_restitution(0.1)
}

/// Two vehicles that meet obliquely.
fn oblique() -> Collision {
    let one = Vehicle::new(1500.0, 2500.0).with_impact_center(1.9, 0.4).with_speed(15.0);
    let two =
        Vehicle::new(1900.0, 3300.0).with_heading(crate::frame::Heading::from_angle(2.1)).with_impact_center(2.1, -0.5).with_speed(9.0);
    Collision::new(one, two).with_restitution(0.1)
}

fn is_near(found: Estimated, wanted: f64) -> bool {
    (found.value - wanted).abs() <= 4.0 * found.standard_error
}

#[test]
fn a_linear_output_has_the_variance_of_its_derivatives() {
    let inputs = [
        (V, Normal { mean: 15.0, sd: 1.0 }),
        (Input::VelocityY(Two), Uniform { min: 7.0, max: 9.0 }),
        (Input::YawRate(One), Normal { mean: 0.0, sd: 0.2 }),
    ];
    let uncertain = oblique().uncertain(&inputs).expect("uncertain");
    let of = Output::YawRate(Two);
    let linear = uncertain.linear(of).expect("a solution");
    let [a, b, c] = [linear.derivatives[0], linear.derivatives[1] / 3.0_f64.sqrt(), 0.2 * linear.derivatives[2]];
    assert!((linear.sd - (a * a + b * b + c * c).sqrt()).abs() < 1e-14 * linear.sd);
    for (share, part) in linear.shares.iter().zip([a, b, c]) {
        assert!((share - part * part / linear.sd.powi(2)).abs() < 1e-14);
    }
    assert!((linear.with_half[0] - (0.25 * a * a + b * b + c * c).sqrt()).abs() < 1e-14 * linear.sd);
    let others = [of, Output::VelocityX(One), of];
    let covariances = uncertain.covariances(&others).expect("a solution");
    let slopes = others.map(|of| uncertain.linear(of).expect("a solution").derivatives);
    for (row, one) in covariances.iter().zip(&slopes) {
        for (found, other) in row.iter().zip(&slopes) {
            let wanted = one[0] * other[0] + one[1] * other[1] / 3.0 + 0.04 * one[2] * other[2];
            assert!((found - wanted).abs() < 1e-14 * linear.sd, "{covariances:?}");
        }
    }
    assert_eq!((covariances.len(), covariances[1].len()), (3, 3));
    let second = uncertain.second_order(of).expect("a solution");
    assert!((second.mean - linear.mean).abs() < 1e-12 && (second.sd / linear.sd - 1.0).abs() < 1e-9, "{second:?} {linear:?}");
    assert!(second.skewness.abs() < 1e-9);
    let sampled = uncertain.monte_carlo(&[of], &MonteCarlo::of(200_000));
    let found = sampled.output(of);
    assert!(is_near(found.mean, linear.mean) && is_near(found.sd, linear.sd), "{found:?} {linear:?}");
    let shares = uncertain.shares(&[of], 400_000, 7).expect("independent");
    for (share, wanted) in shares.outputs[0].iter().zip(&linear.shares) {
        assert!(is_near(share.first, *wanted) && is_near(share.total, *wanted), "{share:?} {wanted}");
        assert!(share.first.standard_error < 0.01 && share.total.standard_error < 0.01);
    }
}

#[test]
fn correlations_count_twice() {
    let inputs = [(V, Normal { mean: 15.0, sd: 1.0 }), (Input::VelocityX(Two), Normal { mean: -4.0, sd: 2.0 })];
    let of = Output::YawRate(Two);
    for r in [-0.9, 0.6] {
        let alone = oblique().uncertain(&inputs).expect("uncertain");
        let together = alone.clone().with_correlations(&[(1, 0, r)]).expect("a correlation");
        let linear = together.linear(of).expect("a solution");
        let [a, b] = [linear.derivatives[0], 2.0 * linear.derivatives[1]];
        let variance = a * a + b * b + 2.0 * r * a * b;
        assert!((linear.sd - variance.sqrt()).abs() < 1e-12 * linear.sd);
        assert!((linear.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((linear.shares[0] - (a * a + r * a * b) / variance).abs() < 1e-12);
        assert!((linear.with_half[1] - (a * a + 0.25 * b * b + r * a * b).sqrt()).abs() < 1e-12 * linear.sd);
        let found = together.monte_carlo(&[of], &MonteCarlo::of(100_000));
        assert!(is_near(found.output(of).sd, linear.sd));
        assert_eq!(together.shares(&[of], 1000, 1), Err(Correlated(0, 1)));
        let group = together.shares_of_groups(&[of], &[vec![0, 1]], 30_000, 1, &|_| true).expect("one group");
        assert!((group.outputs[0][0].first.value - 1.0).abs() < 1e-9 && (group.outputs[0][0].total.value - 1.0).abs() < 0.05);
    }
}

#[test]
fn numbers_of_other_shapes_are_correlated_as_their_scores() {
    let inputs = [(V, LogNormal { median: 15.0, log_sd: 0.2 }), (Input::VelocityX(Two), Uniform { min: -6.0, max: -2.0 })];
    let uncertain = oblique().uncertain(&inputs).expect("uncertain").with_correlations(&[(0, 1, 0.7)]).expect("a correlation");
    let of = Output::YawRate(Two);
    let (linear, second) = (uncertain.linear(of).expect("a solution"), uncertain.second_order(of).expect("a solution"));
    let sampled = uncertain.monte_carlo(&[of], &MonteCarlo::of(400_000));
    let found = sampled.output(of);
    // The output is linear in the two, and so only the covariance matters.
    assert!(is_near(found.mean, linear.mean) && is_near(found.sd, linear.sd), "{found:?} {linear:?}");
    assert!((second.sd / linear.sd - 1.0).abs() < 1e-6, "{second:?} {linear:?}");
}

#[test]
fn a_product_has_the_moments_of_a_product() {
    // Y = (1 + e) v with v ~ N(15, 2), 1 + e ~ N(1.3, 0.05).
    let inputs = [(V, Normal { mean: 15.0, sd: 2.0 }), (E, Normal { mean: 0.3, sd: 0.05 })];
    let uncertain = head_on().uncertain(&inputs).expect("uncertain");
    let [m, s, c, d] = [15.0_f64, 2.0_f64, 1.3_f64, 0.05_f64];
    let (of_speed, of_restitution, of_both) = ((c * s).powi(2), (m * d).powi(2), (s * d).powi(2));
    let variance = of_speed + of_restitution + of_both;
    let second = uncertain.second_order(DELTA_V).expect("a solution");
    assert!((second.mean - c * m).abs() < 1e-12 && (second.sd - variance.sqrt()).abs() < 1e-12);
    // E[(Y − E Y)³] = 6 m c s² d².
    assert!((second.skewness - 6.0 * m * c * (s * d).powi(2) / variance.powf(1.5)).abs() < 1e-12);
    let linear = uncertain.linear(DELTA_V).expect("a solution");
    assert!((linear.sd - (of_speed + of_restitution).sqrt()).abs() < 1e-12);
    for points in [Points::Random, Points::Sobol] {
        let question = MonteCarlo { points, ..MonteCarlo::of(400_000) };
        let sampled = uncertain.monte_carlo(&[DELTA_V], &question);
        let found = sampled.output(DELTA_V);
        assert_eq!(sampled.refused.samples, 0);
        assert!(is_near(found.mean, c * m) && is_near(found.sd, variance.sqrt()), "{points:?} {found:?}");
        assert!((found.skewness - second.skewness).abs() < 0.03);
    }
    let shares = uncertain.shares(&[DELTA_V], 800_000, 3).expect("independent");
    for (share, own) in shares.outputs[0].iter().zip([of_speed, of_restitution]) {
        assert!((share.first.value - own / variance).abs() < 4.0 * share.first.standard_error, "{share:?}");
        assert!((share.total.value - (own + of_both) / variance).abs() < 4.0 * share.total.standard_error, "{share:?}");
    }
}

#[test]
fn a_share_is_at_most_what_the_slope_says() {
    // Of a linear output the limit of a normal number is its share, that of a uniform one 12/π² of it.
    let inputs = [
        (V, Normal { mean: 15.0, sd: 1.0 }),
        (Input::VelocityX(Two), Uniform { min: -8.0, max: 0.0 }),
        (E, LogNormal { median: 0.1, log_sd: 0.1 }),
    ];
    let uncertain = oblique().uncertain(&inputs[..2]).expect("uncertain");
    let of = Output::YawRate(Two);
    let (linear, limits) = (uncertain.linear(of).expect("a solution"), uncertain.shares_at_most(of, 5).expect("independent"));
    for (limit, (share, factor)) in limits.iter().zip(linear.shares.iter().zip([1.0, 12.0 / std::f64::consts::PI.powi(2)])) {
        let found = limit.expect("a limit");
        assert!((found.value - share * factor).abs() < 0.03 * share, "{found:?} {share}");
        // One slope everywhere.
        assert!(found.standard_error < 1e-9 * found.value, "{found:?}");
    }
    let curved = oblique().uncertain(&inputs).expect("uncertain");
    let (limits, shares) = (curved.shares_at_most(Output::Loss, 5).expect("independent"), curved.shares(&[Output::Loss], 200_000, 5));
    let shares = shares.expect("independent");
    assert!(limits[2].is_none());
    for (limit, share) in limits[..2].iter().zip(&shares.outputs[0]) {
        let limit = limit.expect("a limit");
        assert!(share.total.value < limit.value + 4.0 * limit.standard_error.hypot(share.total.standard_error), "{share:?} {limit:?}");
    }
    let tied = uncertain.with_correlations(&[(0, 1, 0.1)]).expect("a correlation");
    assert_eq!(tied.shares_at_most(of, 5), Err(Correlated(0, 1)));
}

#[test]
fn a_quadratic_of_one_number_has_its_own_moments() {
    // Loss ½ m (1 − e²) v² = c v².
    let c = 0.5 * 1500.0 * (1.0 - 0.01);
    let of_uniform = |k: i32| (18.0_f64.powi(k + 1) - 14.0_f64.powi(k + 1)) / (4.0 * f64::from(k + 1));
    let of_log_normal = |k: i32| 15.0_f64.powi(k) * (f64::from(k * k) / 200.0).exp();
    let shapes =
        [(Uniform { min: 14.0, max: 18.0 }, [2, 4].map(of_uniform)), (LogNormal { median: 15.0, log_sd: 0.1 }, [2, 4].map(of_log_normal))];
    for (shape, [square, fourth]) in shapes {
        let second = head_on().uncertain(&[(V, shape)]).expect("uncertain").second_order(Output::Loss).expect("a solution");
        let (mean, variance) = (c * square, c * c * (fourth - square * square));
        assert!((second.mean / mean - 1.0).abs() < 1e-12, "{second:?} {mean}");
        assert!((second.sd / variance.sqrt() - 1.0).abs() < 1e-9, "{second:?} {}", variance.sqrt());
    }
}

#[test]
fn shapes_that_are_not_normal_count_to_second_order() {
    // Loss ½ m (1 − e²) v²: curved in both.
    let inputs = [(V, LogNormal { median: 15.0, log_sd: 0.1 }), (E, Uniform { min: 0.0, max: 0.2 })];
    let uncertain = head_on().uncertain(&inputs).expect("uncertain");
    let (linear, second) = (uncertain.linear(Output::Loss).expect("a solution"), uncertain.second_order(Output::Loss).expect("a solution"));
    // E v^k = 15^k exp(k²/200).
    let power = |k: f64| 15.0_f64.powf(k) * (k * k / 200.0).exp();
    let one_less = |k: i32| (0..100_000).map(|i| (1.0 - ((f64::from(i) + 0.5) / 5e5).powi(2)).powi(k)).sum::<f64>() / 1e5;
    let mean = 750.0 * power(2.0) * one_less(1);
    let sd = (750.0_f64.powi(2) * power(4.0) * one_less(2) - mean * mean).sqrt();
    assert!((second.mean / mean - 1.0).abs() < 1e-4 && (linear.mean / mean - 1.0).abs() > 1e-3);
    assert!((second.sd / sd - 1.0).abs() < 0.3 * (linear.sd / sd - 1.0).abs(), "{} {} {sd}", second.sd, linear.sd);
    let found = uncertain.monte_carlo(&[Output::Loss], &MonteCarlo::of(200_000));
    let found = found.output(Output::Loss);
    assert!(is_near(found.mean, mean) && is_near(found.sd, sd), "{found:?}");
    assert!((second.skewness - found.skewness).abs() < 0.15, "{} {}", second.skewness, found.skewness);
}

#[test]
fn quantiles_probabilities_and_refusals_are_those_of_the_normal_distribution() {
    // Below zero the vehicle leaves the barrier: Φ(−2) = 2.275 %.
    let uncertain = head_on().uncertain(&[(V, Normal { mean: 2.0, sd: 1.0 })]).expect("uncertain");
    let above = |value: f64| Threshold { of: DELTA_V, is_above: true, or_equal: false, value };
    let below = Threshold { is_above: false, ..above(2.2) };
    let question = MonteCarlo { quantiles: vec![0.999], statements: vec![above(2.2), below, above(5.0)], ..MonteCarlo::of(300_000) };
    let sampled = uncertain.monte_carlo(&[DELTA_V], &question);
    let refused = sampled.refused.samples as f64 / 300_000.0;
    assert!((refused - 0.022_750_1).abs() < 4.0 * (0.022_75_f64 / 300_000.0).sqrt());
    assert_eq!(sampled.refused.by_code["separating"], sampled.refused.samples);
    // Of the others, p of those above zero.
    let found = sampled.output(DELTA_V);
    let truncated = Distribution::TruncatedNormal { mode: 2.0, scale: 1.0, min: 0.0, max: 60.0 };
    for (p, quantile) in &found.quantiles {
        assert!(is_near(*quantile, 1.1 * truncated.quantile(*p)), "{p}: {quantile:?}");
        let density = (truncated.log_density(truncated.quantile(*p))).exp() / 1.1;
        let wanted = (p * (1.0 - p) / 293_000.0).sqrt() / density;
        assert!((quantile.standard_error / wanted - 1.0).abs() < 0.2, "{p}: {quantile:?} {wanted}");
    }
    assert_eq!(found.quantiles.len(), QUANTILES.len() + 1);
    let probability = |speed: f64| {
        let normal = |x: f64| crate::distribution::quantile::cumulative(x);
        normal(2.0 - speed) / normal(2.0)
    };
    for (found, wanted) in sampled.probabilities.iter().zip([probability(2.0), 1.0 - probability(2.0), probability(5.0 / 1.1)]) {
        assert!(is_near(*found, wanted) && found.standard_error > 0.0 && found.standard_error < 1e-3, "{found:?} {wanted}");
    }
    let shown: f64 = found.shares.iter().sum();
    assert!((shown - 0.998).abs() < 2e-3 && found.edges.len() == found.shares.len() + 1);
}

/// The outermost of the samples is only known to be nearer than such a quantile.
#[test]
fn a_quantile_beyond_all_samples_has_no_standard_error() {
    let uncertain = head_on().uncertain(&[(V, Normal { mean: 20.0, sd: 1.0 })]).expect("uncertain");
    for points in [Points::Random, Points::Sobol] {
        let question = MonteCarlo { quantiles: vec![0.0009, 0.0011, 0.9989, 0.9991], points, ..MonteCarlo::of(1000) };
        let sampled = uncertain.monte_carlo(&[DELTA_V], &question);
        for (p, quantile) in &sampled.output(DELTA_V).quantiles {
            assert_eq!(quantile.standard_error.is_nan(), p.min(1.0 - p) < 0.001, "{p}: {quantile:?}");
        }
    }
}

/// Where friction limits the ratio, the ratio is the friction: neither above nor below it, whatever its last bits are.
#[test]
fn what_is_the_value_itself_is_neither_above_nor_below() {
    let collision = Collision { impulse_ratio: crate::law::ImpulseRatio::LimitedByFriction(0.05), ..oblique() };
    let value = 0.05_f64.copysign(collision.solve().expect("possible").impulse_ratio());
    let uncertain = collision.uncertain(&[(V, Normal { mean: 15.0, sd: 0.5 }), (E, Uniform { min: 0.0, max: 0.3 })]).expect("uncertain");
    let said = |is_above, or_equal, value| Threshold { of: Output::ImpulseRatio, is_above, or_equal, value };
    let beside = value.abs() * 1e-9;
    let statements = vec![
        said(true, false, value),
        said(false, false, value),
        said(true, true, value),
        said(false, true, value),
        said(true, false, value - beside),
        said(false, true, value - beside),
        said(false, false, value + beside),
        said(true, true, value + beside),
        said(true, true, f64::INFINITY),
        said(false, false, f64::INFINITY),
    ];
    let sampled = uncertain.monte_carlo(&[Output::ImpulseRatio], &MonteCarlo { statements, ..MonteCarlo::of(10_000) });
    let found: Vec<f64> = sampled.probabilities.iter().map(|found| found.value).collect();
    assert_eq!(found, [0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn points_of_sobol_are_closer_than_chance_and_say_so() {
    let inputs = [(V, Normal { mean: 15.0, sd: 1.0 }), (E, Uniform { min: 0.0, max: 0.3 })];
    let uncertain = oblique().uncertain(&inputs).expect("uncertain");
    let of = |points, seed| {
        let sampled = uncertain.monte_carlo(&[DELTA_V], &MonteCarlo { points, seed, ..MonteCarlo::of(16 * 1024) });
        sampled.output(DELTA_V).mean
    };
    let best = uncertain.monte_carlo(&[DELTA_V], &MonteCarlo { points: Points::Sobol, seed: 77, ..MonteCarlo::of(1 << 20) });
    let best = best.output(DELTA_V).mean;
    let mut misses = 0.0;
    for seed in 0..40 {
        let (even, random) = (of(Points::Sobol, seed), of(Points::Random, seed));
        assert!(even.standard_error < 0.1 * random.standard_error, "{even:?} {random:?}");
        misses += ((even.value - best.value) / even.standard_error).powi(2);
        assert!(is_near(random, best.value));
    }
    // The square of Student's t with 15 degrees of freedom has the mean 15/13.
    assert!((0.6..2.0).contains(&(misses / 40.0)), "{misses}");
}

#[test]
fn standard_errors_are_those_of_many_seeds() {
    let inputs = [(V, LogNormal { median: 15.0, log_sd: 0.3 }), (E, Uniform { min: 0.0, max: 0.3 })];
    let uncertain = oblique().uncertain(&inputs).expect("uncertain");
    let statement = Threshold { of: Output::Loss, is_above: true, or_equal: true, value: 60_000.0 };
    let seeds = 300;
    let mut figures: Vec<Vec<Estimated>> = Vec::new();
    for seed in 0..seeds {
        let sampled = uncertain.monte_carlo(&[Output::Loss], &MonteCarlo { seed, statements: vec![statement], ..MonteCarlo::of(4000) });
        let found = sampled.output(Output::Loss);
        let shares = uncertain.shares(&[Output::Loss], 4000, seed).expect("independent");
        let of_shares = shares.outputs[0].iter().flat_map(|share| [share.first, share.total]);
        let quantiles = found.quantiles.iter().map(|(_, quantile)| *quantile);
        figures.push([found.mean, found.sd, sampled.probabilities[0]].into_iter().chain(quantiles).chain(of_shares).collect());
    }
    for i in 0..figures[0].len() {
        let n = seeds as f64;
        let of = |f: &dyn Fn(&Estimated) -> f64| figures.iter().map(|row| f(&row[i])).sum::<f64>() / n;
        let mean = of(&|figure| figure.value);
        let spread = of(&|figure| (figure.value - mean).powi(2)).sqrt();
        let stated = of(&|figure| figure.standard_error);
        // 300 seeds know the deviation to 4 %.
        assert!((0.8..1.25).contains(&(stated / spread)), "figure {i}: {stated} stated, {spread} found");
    }
}

#[test]
fn a_precision_is_reached_or_said_not_to_be() {
    let uncertain = oblique().uncertain(&[(V, Normal { mean: 15.0, sd: 1.0 })]).expect("uncertain");
    let asked = |samples, precision| {
        let question = MonteCarlo { precision: Some(precision), ..MonteCarlo::of(samples) };
        uncertain.monte_carlo(&[DELTA_V], &question)
    };
    let enough = asked(1_000_000, 2e-4);
    let mean = enough.output(DELTA_V).mean;
    assert!(enough.is_precise && enough.samples < 500_000 && mean.standard_error <= 2e-4 * mean.value, "{enough:?}");
    let few = asked(20_000, 1e-5);
    assert!(!few.is_precise && few.samples == 20_000);
    assert!(uncertain.monte_carlo(&[DELTA_V], &MonteCarlo::of(5000)).is_precise);
}

#[test]
fn samples_are_the_same_for_any_number_of_threads_and_can_be_stopped() {
    let inputs = [(V, Normal { mean: 15.0, sd: 1.0 }), (E, Uniform { min: 0.0, max: 0.3 })];
    let uncertain = oblique().uncertain(&inputs).expect("uncertain");
    let ask = || {
        let question = |points| uncertain.monte_carlo(&[DELTA_V, Output::Loss], &MonteCarlo { points, ..MonteCarlo::of(150_000) });
        (question(Points::Random), question(Points::Sobol), uncertain.shares(&[DELTA_V], 200_000, 0))
    };
    let wanted = ask();
    #[cfg(feature = "rayon")]
    for threads in [1, 2, 3, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(pool.install(ask), wanted, "{threads} threads");
    }
    assert_eq!(ask(), wanted);
    for points in [Points::Random, Points::Sobol] {
        let question = MonteCarlo { points, ..MonteCarlo::of(u64::MAX / 4) };
        let stopped = uncertain.monte_carlo_while(&[DELTA_V], &question, &|done| done < 100_000);
        assert!(stopped.samples >= 1024 && stopped.samples < 10_000_000);
        assert!(is_near(stopped.output(DELTA_V).mean, wanted.0.output(DELTA_V).mean.value));
    }
}

#[test]
fn an_angle_does_not_jump_by_a_turn() {
    // The force comes from behind: half of the samples have the angle near π, half near −π.
    let one = Vehicle::new(1500.0, 2500.0).with_impact_center(-2.0, 0.0).with_speed(3.0);
    let two = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(12.0);
    let collision = Collision::new(one, two).with_restitution(0.1);
    let of = Output::PrincipalDirectionOfForce(One);
    let uncertain = collision.uncertain(&[(Input::VelocityY(Two), Normal { mean: 0.0, sd: 0.5 })]).expect("uncertain");
    let sampled = uncertain.monte_carlo(&[of], &MonteCarlo::of(20_000));
    let found = sampled.output(of);
    assert!((found.mean.value.abs() - std::f64::consts::PI).abs() < 0.01 && found.sd.value < 0.2, "{found:?}");
}

#[test]
fn what_is_certain_has_no_deviation() {
    let uncertain = oblique().uncertain(&[(V, Normal { mean: 15.0, sd: 1.0 })]).expect("uncertain");
    // e does not depend on the speed.
    let of = Output::Restitution;
    let sampled = uncertain.monte_carlo(&[of], &MonteCarlo::of(5000));
    let found = sampled.output(of);
    assert_eq!((found.mean, found.sd.value), (Estimated { value: 0.1, standard_error: 0.0 }, 0.0));
    assert!(found.quantiles.iter().all(|(_, quantile)| *quantile == Estimated { value: 0.1, standard_error: 0.0 }));
    let linear = uncertain.linear(of).expect("a solution");
    assert!(linear.sd == 0.0 && linear.shares[0].is_nan());
    // What has always been so may not be the next time, however the points lie.
    for points in [Points::Random, Points::Sobol] {
        let always = Threshold { of, is_above: true, or_equal: false, value: 0.05 };
        let question = MonteCarlo { points, statements: vec![always], ..MonteCarlo::of(16 * 1024) };
        let [found] = uncertain.monte_carlo(&[], &question).probabilities[..] else { panic!("one statement") };
        let least = 1.0 / (16.0 * 1024.0);
        assert!(found.value == 1.0 && (found.standard_error / least - 1.0).abs() < 1e-3, "{points:?} {found:?}");
    }
    let none = oblique().uncertain(&[]).expect("nothing uncertain");
    assert_eq!(none.monte_carlo(&[DELTA_V], &MonteCarlo::of(10)).output(DELTA_V).sd.value, 0.0);
}

#[test]
fn inputs_that_cannot_be_uncertain_are_refused() {
    let speed = (V, Normal { mean: 15.0, sd: 1.0 });
    assert!(matches!(head_on().uncertain(&[speed, speed]), Err(NotDrawn::Twice(V))));
    assert!(matches!(head_on().uncertain(&[(Input::Mass(Two), speed.1)]), Err(NotDrawn::NoSuchInput(_))));
    assert!(matches!(head_on().uncertain(&[(V, Normal { mean: 15.0, sd: -1.0 })]), Err(NotDrawn::Distribution(V, _))));
    // At the mean nothing collides.
    let away = head_on().uncertain(&[(V, Normal { mean: -15.0, sd: 1.0 })]).expect("uncertain");
    assert!(away.linear(DELTA_V).is_err() && away.second_order(DELTA_V).is_err());
    let none = away.monte_carlo(&[DELTA_V], &MonteCarlo::of(2000));
    assert_eq!((none.samples, none.refused.samples), (2000, 2000));
    assert!(none.output(DELTA_V).mean.value.is_nan());
}

/// The speed along an uncertain heading, as another number than an input.
struct Polar;

impl Mapping for Polar {
    fn numbers(&self) -> usize {
        2
    }

    fn inputs(&self) -> &[Input] {
        &[Input::VelocityX(One), Input::VelocityY(One), Input::Heading(One)]
    }

    fn write<T: crate::scalar::Real + Copy + From<f64>>(&self, numbers: &[T], inputs: &mut [T]) {
        let (sin, cos) = numbers[1].sin_and_cos();
        inputs.copy_from_slice(&[numbers[0] * cos, numbers[0] * sin, numbers[1]]);
    }
}

#[test]
fn numbers_that_inputs_follow_from_have_derivatives_of_their_own() {
    let numbers = vec![Normal { mean: 15.0, sd: 0.5 }.into(), Normal { mean: 0.1, sd: 0.02 }.into()];
    let uncertain = Uncertain::new(Mapped::new(oblique(), Polar), numbers);
    let (linear, second) = (uncertain.linear(DELTA_V).expect("a solution"), uncertain.second_order(DELTA_V).expect("a solution"));
    let value = |speed: f64, heading: f64| uncertain.model().at(&[speed, heading]).solve().expect("a solution").one.delta_v_magnitude();
    let h = 1e-4;
    for (i, [dv, da]) in [[h, 0.0], [0.0, h]].into_iter().enumerate() {
        let difference = (value(15.0 + dv, 0.1 + da) - value(15.0 - dv, 0.1 - da)) / (2.0 * h);
        assert!((linear.derivatives[i] - difference).abs() < 1e-6 * difference.abs(), "{i}: {} {difference}", linear.derivatives[i]);
    }
    let twice = (value(15.0, 0.1 + h) - 2.0 * value(15.0, 0.1) + value(15.0, 0.1 - h)) / (h * h);
    let along = (value(15.0 + h, 0.1) - 2.0 * value(15.0, 0.1) + value(15.0 - h, 0.1)) / (h * h);
    let wanted = value(15.0, 0.1) + 0.5 * (twice * 0.0004 + along * 0.25);
    assert!((second.mean - wanted).abs() < 1e-6, "{} {wanted}", second.mean);
    let found = uncertain.monte_carlo(&[DELTA_V], &MonteCarlo::of(100_000));
    assert!(is_near(found.output(DELTA_V).mean, second.mean) && is_near(found.output(DELTA_V).sd, second.sd));
}
