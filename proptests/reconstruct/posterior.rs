//! The posterior: beside integrals over a grid, in closed form where there is one, and calibrated on simulated crashes.

use std::cell::Cell;
use std::f64::consts::PI;
use std::thread;
use std::time::Instant;

use planar_impact::reconstruct::{
    Marginal, Measurand, NoPosterior, Posterior, PriorCorrelation, ReconstructionProblem, Sampling, Search, Uncertainty, Unknown, Variable,
};
use planar_impact::*;
use rand::RngExt;
use rand_distr::StandardNormal;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::scene::{Source, Truth, with};

const E: Variable = Variable::Input(Input::Restitution);
const SHARE: Variable = Variable::Input(Input::ImpulseRatio);
const GAMMA: Variable = Variable::Input(Input::CrushPlane);
const ONE: Variable = Variable::Speed(Side::One);
const TWO: Variable = Variable::Speed(Side::Two);

/// A kind of question. The truth is drawn from its priors, which are uniform within bounds, or normal.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Speeds,
    RestitutionNearBound,
    Share,
    ShareNearBound,
    Curved,
    Priors,
}

/// An unknown: its bounds, and its prior's mean and standard deviation.
type Asked = (Variable, [f64; 2], Option<[f64; 2]>);

impl Kind {
    const ALL: [Kind; 6] = [Kind::Speeds, Kind::RestitutionNearBound, Kind::Share, Kind::ShareNearBound, Kind::Curved, Kind::Priors];

    fn name(self) -> &'static str {
        match self {
            Kind::Speeds => "two speeds, restitution 0 to 0.3",
            Kind::RestitutionNearBound => "two speeds, restitution 0 to 0.05",
            Kind::Share => "a speed, restitution 0 to 0.3, share of the critical ratio 0 to 1",
            Kind::ShareNearBound => "a speed, restitution 0 to 0.3, share of the critical ratio 0.95 to 1",
            Kind::Curved => "two speeds, crush plane -1.2 to 1.2, evidence vague",
            Kind::Priors => "normal priors, restitution at its bound",
        }
    }

    fn unknowns(self) -> Vec<Asked> {
        let (speed, e) = ([5.0, 35.0], [0.0, 0.3]);
        match self {
            Kind::Speeds => vec![(ONE, speed, None), (TWO, speed, None), (E, e, None)],
            Kind::RestitutionNearBound => vec![(ONE, speed, None), (TWO, speed, None), (E, [0.0, 0.05], None)],
            Kind::Share => vec![(ONE, speed, None), (E, e, None), (SHARE, [0.0, 1.0], None)],
            Kind::ShareNearBound => vec![(ONE, speed, None), (E, e, None), (SHARE, [0.95, 1.0], None)],
            Kind::Curved => vec![(ONE, speed, None), (TWO, speed, None), (GAMMA, [-1.2, 1.2], None)],
            Kind::Priors => vec![(ONE, speed, Some([20.0, 4.0])), (TWO, speed, None), (E, [0.0, 0.3], Some([0.03, 0.05]))],
        }
    }
}

/// Draws a truth from the priors, and evidence of it.
fn crash(kind: Kind, unknowns: &[Asked], source: &mut Source) -> (Truth, ReconstructionProblem) {
    let normal = |source: &mut Source| source.0.sample::<f64, _>(StandardNormal);
    let truth = loop {
        let mut collision = source.collision();
        for &(of, [min, max], prior) in unknowns {
            let mut value = source.between(min, max);
            if let Some([mean, sd]) = prior {
                value = f64::NAN;
                while !(min..=max).contains(&value) {
                    value = mean + sd * normal(source);
                }
            }
            collision = with(&collision, of, value);
        }
        if collision.solve().is_ok() {
            break Truth::of(collision, 0.5);
        }
    };
    let mut problem = ReconstructionProblem::of(truth.collision);
    for &(of, [min, max], prior) in unknowns {
        let start = prior.map_or(0.5 * (min + max), |[mean, _]| mean);
        problem = problem.with(Unknown { min: Some(min), max: Some(max), prior: prior.map(|[_, sd]| sd), ..Unknown::free(of, start) });
    }
    let vague = if kind == Kind::Curved { 3.0 } else { 1.0 };
    let mut all = vec![
        (Measurand::Output(Output::VelocityX(Side::One)), 0.8),
        (Measurand::Output(Output::VelocityY(Side::One)), 0.8),
        (Measurand::Output(Output::YawRate(Side::One)), 0.4),
        (Measurand::SeparationDirection(Side::Two), 0.1),
        // Not as a magnitude, which as evidence cannot be negative.
        (Measurand::Output(Output::NormalWork), 30e3),
        (Measurand::DeltaVForward(Side::Two), 0.8),
    ];
    for _ in 0..1 + source.0.random_range(0..3) {
        all.remove(source.0.random_range(0..all.len()));
    }
    for (of, sd) in all {
        let sd = vague * sd;
        problem = problem.evidence(of, truth.measured(of) + sd * normal(source), Uncertainty::StandardDeviation(sd));
    }
    (truth, problem)
}

/// Returns the posterior, whatever the verdict.
fn drawn(problem: &ReconstructionProblem, sampling: &Sampling) -> Posterior {
    let answer = problem.solve(&Search { starts: 16, ..Search::default() }).expect("an answer");
    problem.posterior(&answer, sampling).expect("a posterior")
}

fn marginal(posterior: &Posterior, of: Variable) -> Marginal {
    posterior.marginals(&[Measurand::Variable(of)], 0.95).pop().expect("the collision has it")
}

/// Fails unless the draws below a value are as many as a probability says, to five standard errors.
fn assert_share_below(marginal: &Marginal, value: f64, probability: f64, what: &str) {
    let error = (probability * (1.0 - probability) / marginal.effective).sqrt();
    let share = 1.0 - marginal.probability_above(value);
    assert!(
        (share - probability).abs() < 5.0 * error + 0.003,
        "{what}: {share} of the draws of {} below {value}, not {probability}",
        marginal.of.name()
    );
}

/// The logarithm of the density by its definition, from the truth's own measurands.
fn log_density(problem: &ReconstructionProblem, values: &[f64]) -> f64 {
    let mut collision = problem.collision;
    let mut chi_square = 0.0;
    for (unknown, value) in problem.unknowns.iter().zip(values) {
        collision = with(&collision, unknown.of, *value);
        chi_square += unknown.prior.map_or(0.0, |sd| ((value - unknown.start) / sd).powi(2));
    }
    if collision.solve().is_err() {
        return f64::NEG_INFINITY;
    }
    let at = Truth::of(collision, 0.5);
    for evidence in &problem.evidence {
        let sd = evidence.uncertainty.standard_deviation().expect("no evidence is exact");
        chi_square += ((evidence.value - at.measured(evidence.of)) / sd).powi(2);
    }
    -0.5 * chi_square
}

/// Returns the probability of each of many narrow ranges of the first of two unknowns, and their middles, by sums over a grid that is refined where the density
/// is not negligible.
fn by_grid(problem: &ReconstructionProblem) -> Vec<(f64, f64)> {
    const CELLS: usize = 100;
    let mut limits: Vec<[f64; 2]> =
        problem.unknowns.iter().map(|unknown| [unknown.min.expect("a bound"), unknown.max.expect("a bound")]).collect();
    for round in 0.. {
        let middle = |i: usize, k: usize| limits[i][0] + (limits[i][1] - limits[i][0]) * (k as f64 + 0.5) / CELLS as f64;
        let logs: Vec<Vec<f64>> =
            (0..CELLS).map(|i| (0..CELLS).map(|k| log_density(problem, &[middle(0, i), middle(1, k)])).collect()).collect();
        let greatest = logs.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
        if round == 2 {
            let all: f64 = logs.iter().flatten().map(|log| (log - greatest).exp()).sum();
            let share = |row: &Vec<f64>| row.iter().map(|log| (log - greatest).exp()).sum::<f64>() / all;
            return logs.iter().enumerate().map(|(i, row)| (middle(0, i), share(row))).collect();
        }
        /// The logarithm of a negligible density relative to the greatest.
        const NOTHING: f64 = -20.0;
        let matters = |i: usize, k: usize| logs[i][k] > greatest + NOTHING;
        let rows: Vec<usize> = (0..CELLS).filter(|i| (0..CELLS).any(|k| matters(*i, k))).collect();
        let columns: Vec<usize> = (0..CELLS).filter(|k| (0..CELLS).any(|i| matters(i, *k))).collect();
        for (limits, kept) in limits.iter_mut().zip([rows, columns]) {
            let cell = (limits[1] - limits[0]) / CELLS as f64;
            let edge = |k: usize| limits[0] + cell * k as f64;
            *limits = [edge(kept[0].saturating_sub(1)), edge((kept[kept.len() - 1] + 2).min(CELLS))];
        }
    }
    unreachable!("the third round returns")
}

#[test]
fn draws_are_as_frequent_as_integrals_over_a_grid_say() {
    for (kind, seed) in Kind::ALL.into_iter().flat_map(|kind| (0..4).map(move |seed| (kind, seed))) {
        // The last unknown, on its bounds in many kinds, and a speed.
        let all = kind.unknowns();
        let (_, problem) = crash(kind, &[all[2], all[0]], &mut Source::of(100 + seed));
        let posterior = drawn(&problem, &Sampling { seed, ..Sampling::default() });
        let of_draws = marginal(&posterior, problem.unknowns[0].of);
        assert!(of_draws.r_hat < 1.02 && of_draws.effective > 800.0, "{kind:?} {seed}: {of_draws:?}");
        let cells = by_grid(&problem);
        let mean: f64 = cells.iter().map(|(x, share)| x * share).sum();
        let sd = cells.iter().map(|(x, share)| share * (x - mean).powi(2)).sum::<f64>().sqrt();
        let error = sd / of_draws.effective.sqrt();
        assert!(
            (of_draws.mean - mean).abs() < 5.0 * error,
            "{kind:?} {seed}: mean {} by draws, {mean} by the grid, error {error}",
            of_draws.mean
        );
        assert!((of_draws.sd / sd - 1.0).abs() < 0.1, "{kind:?} {seed}: sd {} by draws, {sd} by the grid", of_draws.sd);
        let half_cell = 0.5 * (cells[1].0 - cells[0].0);
        let mut below = 0.0;
        for (i, (x, share)) in cells.iter().enumerate() {
            below += share;
            if i % 10 == 4 {
                assert_share_below(&of_draws, x + half_cell, below, &format!("{kind:?} {seed}"));
            }
        }
    }
}

fn car(heading: f64) -> Vehicle {
    Vehicle::new(1500.0, 2500.0).with_heading(Heading::from_angle(heading)).with_impact_center(2.0, 0.0)
}

/// Cars of the same kind that meet head-on.
fn head_on() -> Collision {
    Collision::new(car(0.0).with_speed(15.0), car(PI).with_speed(12.0)).with_restitution(0.1)
}

/// Mirror images fit equally well, and the prior makes one of them more probable.
#[test]
fn modes_have_their_weights() {
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::One));
    let mut turned = head_on();
    turned.crush_plane = CrushPlane::from_angle(0.5);
    turned.impulse_ratio = ImpulseRatio::OfCritical(0.0);
    let truth = Truth::of(turned, 0.5);
    let problem = ReconstructionProblem::of(turned)
        .with(Unknown { min: Some(-1.2), max: Some(1.2), prior: Some(0.6), ..Unknown::free(GAMMA, 0.2) })
        .evidence(of, truth.measured(of), Uncertainty::StandardDeviation(0.2));
    let posterior = drawn(&problem, &Sampling::default());
    let gamma = marginal(&posterior, GAMMA);
    assert!(gamma.r_hat < 1.01 && gamma.effective > 1000.0, "{gamma:?}");
    let density = |x: f64| log_density(&problem, &[x]).exp();
    let sum =
        |from: f64, to: f64| (0..20_000).map(|i| density(from + (to - from) * (f64::from(i) + 0.5) / 20_000.0)).sum::<f64>() * (to - from);
    let (left, right) = (sum(-1.2, 0.0), sum(0.0, 1.2));
    let share = left / (left + right);
    assert!((0.1..0.4).contains(&share), "{share}");
    assert_share_below(&gamma, 0.0, share, "the less probable mode");
}

/// Evidence that says nothing leaves what was known before.
#[test]
fn priors_come_back() {
    const MASS: Variable = Variable::Input(Input::Mass(Side::One));
    const INERTIA: Variable = Variable::Input(Input::YawInertia(Side::One));
    const OTHER: Variable = Variable::Input(Input::Mass(Side::Two));
    let triangular = Distribution::Triangular { min: 1400.0, mode: 1500.0, max: 1800.0 };
    let log_normal = Distribution::LogNormal { median: 2500.0, log_sd: 0.2 };
    let shaped =
        |of: Variable, shape: Distribution| Unknown { prior: Some(shape.sd()), shape: Some(shape), ..Unknown::free(of, shape.mean()) };
    let mut problem = ReconstructionProblem::of(head_on())
        .with(Unknown { min: Some(1400.0), max: Some(1800.0), ..shaped(MASS, triangular) })
        .with(shaped(INERTIA, log_normal))
        .prior(OTHER, 1500.0, 100.0)
        .between(E, 0.1, 0.05, 0.25)
        .evidence(Measurand::CrushEnergy, 100e3, Uncertainty::StandardDeviation(1e9));
    let correlation = 0.6;
    problem.prior_correlations = vec![PriorCorrelation { one: MASS, other: INERTIA, coefficient: correlation }];
    let posterior = drawn(&problem, &Sampling::default());
    let shares = [0.05, 0.25, 0.5, 0.75, 0.95];
    let normal = statrs::distribution::Normal::standard();
    for share in shares {
        // The mode of the triangle is its 25 % quantile.
        let by_side =
            if share <= 0.25 { 1400.0 + (share * 400.0_f64 * 100.0).sqrt() } else { 1800.0 - ((1.0 - share) * 400.0_f64 * 300.0).sqrt() };
        assert_share_below(&marginal(&posterior, MASS), by_side, share, "triangular");
        assert_share_below(&marginal(&posterior, INERTIA), 2500.0 * (0.2 * normal.inverse_cdf(share)).exp(), share, "log-normal");
        assert_share_below(&marginal(&posterior, OTHER), 1500.0 + 100.0 * normal.inverse_cdf(share), share, "normal");
        assert_share_below(&marginal(&posterior, E), 0.05 + 0.2 * share, share, "uniform");
    }
    // A Gaussian copula: the correlation is that of the normal scores.
    let [masses, inertias] = [MASS, INERTIA].map(|of| posterior.values(&[Measurand::Variable(of)]).remove(0).1);
    let below = |x: f64| if x <= 1500.0 { (x - 1400.0).powi(2) / 40_000.0 } else { 1.0 - (1800.0 - x).powi(2) / 120_000.0 };
    let scores = masses.iter().zip(&inertias).map(|(mass, inertia)| normal.inverse_cdf(below(*mass)) * (inertia / 2500.0).ln() / 0.2);
    let found = scores.sum::<f64>() / masses.len() as f64;
    assert!((found - correlation).abs() < 0.1, "{found}");
}

#[test]
fn summaries_are_those_of_the_draws() {
    let (_, problem) = crash(Kind::Speeds, &Kind::Speeds.unknowns(), &mut Source::of(7));
    let sampling = Sampling { chains: 3, draws: 500, seed: 9 };
    let posterior = drawn(&problem, &sampling);
    assert_eq!(posterior.chains().iter().map(Vec::len).collect::<Vec<_>>(), [500; 3]);
    assert_eq!(posterior.unknowns().collect::<Vec<_>>(), [ONE, TWO, E]);
    let of = [Measurand::Variable(ONE), Measurand::ClosingSpeed, Measurand::Output(Output::PrincipalDirectionOfForce(Side::One))];
    for (marginal, (_, mut values)) in posterior.marginals(&of, 0.8).iter().zip(posterior.values(&of)) {
        let mean = values.iter().sum::<f64>() / 1500.0;
        values.sort_by(f64::total_cmp);
        assert!((marginal.mean / mean - 1.0).abs() < 1e-12);
        assert_eq!((marginal.quantile(0.0), marginal.quantile(1.0)), (values[0], values[1499]));
        assert_eq!(marginal.median(), 0.5 * (values[749] + values[750]));
        assert_eq!(marginal.probability_above(values[299]), 0.8);
        let [low, high] = marginal.highest_density;
        assert_eq!(values.iter().filter(|x| (low..=high).contains(x)).count(), 1200);
        assert!(values.windows(1200).all(|range| high - low <= range[1199] - range[0]));
    }
    // The value of a quantity in a draw is that of the collision with the draw's unknowns.
    let closing = posterior.values(&[Measurand::ClosingSpeed]).remove(0).1;
    for (draw, closing) in posterior.chains().iter().flatten().zip(&closing).step_by(97) {
        let unknowns = problem.unknowns.iter().zip(draw);
        let collision = unknowns.fold(problem.collision, |collision, (unknown, value)| with(&collision, unknown.of, *value));
        assert!((Truth::of(collision, 0.5).measured(Measurand::ClosingSpeed) - closing).abs() < 1e-9);
    }
    // The same seed gives the same draws, another seed others.
    assert_eq!(drawn(&problem, &sampling), posterior);
    assert_ne!(drawn(&problem, &Sampling { seed: 10, ..sampling }).chains(), posterior.chains());
}

/// A speed measured directly is normal: in closed form, the shortest range of a probability is that of the normal distribution.
#[test]
fn a_high_level_has_the_draws_that_it_needs() {
    let problem = ReconstructionProblem::of(head_on()).unknown(ONE, 15.0).evidence(
        Measurand::Variable(ONE),
        14.0,
        Uncertainty::StandardDeviation(0.5),
    );
    let sampling = Sampling::for_level(0.99);
    assert_eq!(sampling, Sampling { draws: 2500, ..Sampling::default() });
    let posterior = drawn(&problem, &sampling);
    assert_eq!(posterior.chains().iter().map(Vec::len).collect::<Vec<_>>(), [2500; 4]);
    let marginal = posterior.marginals(&[Measurand::Variable(ONE)], 0.99).remove(0);
    assert!(marginal.effective > 8000.0 && marginal.r_hat < Marginal::CONVERGED, "{} {}", marginal.effective, marginal.r_hat);
    let [low, high] = marginal.highest_density;
    let half = 0.5 * statrs::distribution::Normal::standard().inverse_cdf(0.995);
    assert!(((high - low) / (2.0 * half) - 1.0).abs() < 0.04, "{low} to {high}");
    // The first thousand draws of each chain are those of a thousand; the further ones go on from there.
    let short = drawn(&problem, &Sampling::default());
    for (chain, first) in posterior.chains().iter().zip(short.chains()) {
        assert_eq!(chain[..1000], first[..]);
        assert!(chain[1000..].iter().all(|draw| !first.contains(draw)));
    }
    assert_eq!(Sampling::for_level(0.5), Sampling::default());
    assert_eq!([0.999, 0.9999, 1.0].map(|level| Sampling::for_level(level).draws), [25_000; 3]);
}

#[test]
fn what_has_no_end_has_no_posterior() {
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::One));
    // Only the sum of the speeds makes a difference.
    let open = ReconstructionProblem::of(head_on())
        .unknown(ONE, 15.0)
        .unknown(TWO, 12.0)
        .evidence(of, 14.0, Uncertainty::StandardDeviation(0.5))
        .evidence(Measurand::CrushEnergy, 270e3, Uncertainty::StandardDeviation(20e3));
    let answer = open.solve(&Search::default()).expect("a line of solutions");
    assert_eq!(open.posterior(&answer, &Sampling::default()), Err(NoPosterior::Improper(vec![ONE, TWO])));
    let mut bounded = open;
    bounded.unknowns[1] = Unknown { min: Some(5.0), max: Some(20.0), ..bounded.unknowns[1] };
    let posterior = drawn(&bounded, &Sampling::default());
    let two = marginal(&posterior, TWO);
    (1..10).for_each(|tenth| assert_share_below(&two, 5.0 + 1.5 * f64::from(tenth), 0.1 * f64::from(tenth), "every speed is as likely"));
    // The caller stops it.
    let answer = bounded.solve(&Search::default()).expect("a line of solutions");
    let steps = Cell::new(0);
    let stopped = bounded.posterior_while(&answer, &Sampling::default(), &|done, total| {
        assert!(done <= total);
        steps.set(steps.get() + 1);
        steps.get() < 50
    });
    assert_eq!((stopped, steps.get()), (Err(NoPosterior::Stopped), 50));
}

#[test]
fn exact_evidence_is_met_to_a_thousandth() {
    let of = Measurand::Output(Output::DeltaVMagnitude(Side::One));
    let problem = ReconstructionProblem::of(head_on())
        .unknown(ONE, 15.0)
        .between(E, 0.1, 0.0, 0.3)
        .evidence(of, 14.0, Uncertainty::Exact)
        .evidence(Measurand::CrushEnergy, 270e3, Uncertainty::StandardDeviation(30e3));
    let posterior = drawn(&problem, &Sampling::default());
    assert_eq!(posterior.softened, [of]);
    let delta_v = &posterior.marginals(&[of], 0.95)[0];
    assert!((delta_v.mean - 14.0).abs() < 0.002 && (0.012..0.016).contains(&delta_v.sd), "{delta_v:?}");
    assert!(delta_v.r_hat < 1.01);
}

#[test]
fn a_shape_needs_its_standard_deviation() {
    let empty = Distribution::Uniform { min: 1.0, max: 1.0 };
    let problem = ReconstructionProblem::of(head_on()).with(Unknown { shape: Some(empty), ..Unknown::free(E, 0.1) }).evidence(
        Measurand::CrushEnergy,
        100e3,
        Uncertainty::StandardDeviation(5e3),
    );
    let issues = problem.check().expect_err("it has an impossible shape, and nothing else");
    assert_eq!(issues.iter().map(|issue| issue.code()).collect::<Vec<_>>(), ["out-of-order", "shape-without-prior"]);
}

/// Ranks of the truth among independent draws of its posterior, by quantity.
struct Ranks {
    lost: Vec<u64>,
    of: Vec<(Measurand, Vec<usize>)>,
}

/// Number of draws among which the truth has its rank.
const AMONG: usize = 199;

impl Ranks {
    fn of(kind: Kind, seeds: impl Iterator<Item = u64>) -> Self {
        let mut ranks = Ranks { lost: Vec::new(), of: Vec::new() };
        for seed in seeds {
            let (truth, problem) = crash(kind, &kind.unknowns(), &mut Source::of(seed));
            let Ok(answer) = problem.solve(&Search { starts: 8, ..Search::default() }) else {
                ranks.lost.push(seed);
                continue;
            };
            // Every third draw of each walker, so that they are nearly independent.
            let sampling = Sampling { chains: 1, draws: 600, seed };
            let posterior = problem.posterior(&answer, &sampling).expect("all are bounded");
            let unknowns = problem.unknowns.iter().map(|unknown| Measurand::Variable(unknown.of));
            let of: Vec<Measurand> = unknowns.chain([Measurand::ClosingSpeed, Measurand::CrushEnergy]).collect();
            for (of, values) in posterior.values(&of) {
                let kept = values.chunks(20).step_by(3).flatten().take(AMONG);
                let rank = kept.filter(|value| **value < truth.measured(of)).count();
                match ranks.of.iter_mut().find(|(known, _)| *known == of) {
                    Some((_, ranks)) => ranks.push(rank),
                    None => ranks.of.push((of, vec![rank])),
                }
            }
        }
        ranks
    }

    /// Returns those of many crashes, on two threads.
    fn of_many(kind: Kind, crashes: u64) -> Self {
        let half = |from: u64| Ranks::of(kind, (from..crashes).step_by(2));
        let [mut ranks, other] = thread::scope(|scope| {
            let other = scope.spawn(|| half(1));
            [half(0), other.join().expect("it does not panic")]
        });
        ranks.lost.extend(other.lost);
        ranks.of.iter_mut().zip(other.of).for_each(|((_, all), (_, more))| all.extend(more));
        ranks
    }
}

/// Returns the share of ranks that the middle 95 % contains, and the probability that uniform ranks are distributed less evenly.
fn coverage_and_evenness(ranks: &[usize]) -> (f64, f64) {
    const BINS: usize = 20;
    let count = ranks.len() as f64;
    let mut bins = [0.0; BINS];
    ranks.iter().for_each(|rank| bins[rank * BINS / (AMONG + 1)] += 1.0);
    let expected = count / BINS as f64;
    let chi_square: f64 = bins.iter().map(|bin: &f64| (bin - expected).powi(2) / expected).sum();
    let evenness = ChiSquared::new(BINS as f64 - 1.0).expect("19").sf(chi_square);
    (ranks.iter().filter(|rank| (5..195).contains(*rank)).count() as f64 / count, evenness)
}

#[test]
fn ranks_of_the_truth_are_uniform() {
    const CRASHES: u64 = 120;
    for kind in Kind::ALL {
        let ranks = Ranks::of_many(kind, CRASHES);
        assert!(ranks.lost.is_empty(), "{kind:?}: {:?}", ranks.lost);
        for (of, ranks) in &ranks.of {
            let (coverage, evenness) = coverage_and_evenness(ranks);
            let what = format!("{kind:?}, {}: coverage {coverage}, evenness {evenness}", of.name());
            assert!(evenness > 1e-4 && (coverage - 0.95).abs() < 4.0 * (0.95 * 0.05 / ranks.len() as f64).sqrt(), "{what}");
        }
    }
}

#[ignore = "minutes in release: the campaign behind docs/coverage.md"]
#[test]
fn the_whole_campaign_of_posteriors() {
    let crashes = std::env::var("CRASHES").ok().and_then(|text| text.parse().ok()).unwrap_or(10_000);
    println!("| unknowns | crashes | without an answer | least and greatest coverage | least evenness of the ranks |");
    println!("|---|---|---|---|---|");
    for kind in Kind::ALL {
        let start = Instant::now();
        let ranks = Ranks::of_many(kind, crashes);
        eprintln!("{}: {:.0} s, lost {:?}", kind.name(), start.elapsed().as_secs_f64(), ranks.lost);
        let mut all: Vec<(f64, f64, &str)> = Vec::new();
        for (of, ranks) in &ranks.of {
            let (coverage, evenness) = coverage_and_evenness(ranks);
            all.push((coverage, evenness, of.name()));
        }
        all.sort_by(|one, other| one.0.total_cmp(&other.0));
        let cell = |(coverage, _, name): &(f64, f64, &str)| format!("{:.2} % {name}", 100.0 * coverage);
        let evenness = all.iter().map(|(_, evenness, _)| *evenness).fold(1.0, f64::min);
        println!(
            "| {} | {crashes} | {} | {}, {} | {evenness:.3} |",
            kind.name(),
            ranks.lost.len(),
            cell(&all[0]),
            cell(&all[all.len() - 1])
        );
    }
}
