//! Coverage of the intervals: simulated crashes whose truth lies inside of the bounds, near them, on them, and where the evidence bends.
//!
//! A sample runs with the other tests. The whole campaign, whose table is `docs/coverage.md`, is
//! `cargo test --release --test proptests -- --ignored --nocapture the_whole_campaign`.

use std::f64::consts::{PI, TAU};
use std::thread;
use std::time::Instant;

use planar_impact::reconstruct::{Interval, Limit, Measurand, ReconstructionProblem, Search, Uncertainty, Variable};
use planar_impact::*;
use rand_distr::StandardNormal;

use rand::RngExt;

use super::scene::{Source, Truth, with};

const LEVEL: f64 = 0.95;

/// Where the truth lies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stratum {
    Inside,
    RestitutionNearBound,
    RestitutionOnBound,
    ShareNearBound,
    ShareOnBound,
    /// The impulse ratio is given to 0.02, and off by that much.
    RatioOff,
    /// It is taken as certain, and off by 0.02: no interval can know that.
    RatioWronglyCertain,
    /// The crush plane is unknown, over more than a quarter turn, and the evidence is vague.
    Curved,
}

impl Stratum {
    /// Those whose intervals must hold.
    const ALL: [Stratum; 7] = {
        use Stratum::*;
        [Inside, RestitutionNearBound, RestitutionOnBound, ShareNearBound, ShareOnBound, RatioOff, Curved]
    };

    fn name(self) -> &'static str {
        match self {
            Stratum::Inside => "inside of the bounds",
            Stratum::RestitutionNearBound => "restitution near its bound",
            Stratum::RestitutionOnBound => "restitution on its bound",
            Stratum::ShareNearBound => "share of the critical ratio near 1",
            Stratum::ShareOnBound => "share of the critical ratio 1",
            Stratum::RatioOff => "impulse ratio given to 0.02, and off by 0.02",
            Stratum::RatioWronglyCertain => "impulse ratio given as certain, and off by 0.02",
            Stratum::Curved => "crush plane unknown, evidence vague",
        }
    }

    fn truth(self, source: &mut Source) -> Truth {
        loop {
            let mut collision = source.collision();
            match self {
                Stratum::RestitutionNearBound => collision.restitution = source.between(0.0, 0.04),
                Stratum::RestitutionOnBound => collision.restitution = 0.0,
                Stratum::ShareNearBound => collision.impulse_ratio = ImpulseRatio::OfCritical(source.between(0.95, 1.0)),
                Stratum::ShareOnBound => collision.impulse_ratio = ImpulseRatio::OfCritical(1.0),
                // Far enough from zero that it is not on the other side.
                Stratum::RatioOff | Stratum::RatioWronglyCertain => {
                    let ratio = collision.solve().expect("it is drawn among those that have an answer").impulse_ratio();
                    if ratio.abs() < 0.05 {
                        continue;
                    }
                    collision.impulse_ratio = ImpulseRatio::Given(ratio);
                }
                Stratum::Inside | Stratum::Curved => (),
            }
            if collision.solve().is_ok() {
                return Truth::of(collision, 0.5);
            }
        }
    }
}

/// A simulated crash.
struct Crash {
    truth: Truth,
    problem: ReconstructionProblem,
    /// χ² of the truth.
    chi_square: f64,
}

fn crash(stratum: Stratum, source: &mut Source) -> Crash {
    let truth = stratum.truth(source);
    let mut collision = truth.collision;
    let ratio = if let ImpulseRatio::Given(ratio) = collision.impulse_ratio { ratio - 0.02_f64.copysign(ratio) } else { f64::NAN };
    if stratum == Stratum::RatioWronglyCertain {
        collision.impulse_ratio = ImpulseRatio::Given(ratio);
    }
    let mut problem = ReconstructionProblem::of(collision).between(Variable::Speed(Side::One), 15.0, 0.0, 60.0);
    let share = Variable::Input(Input::ImpulseRatio);
    problem = match stratum {
        Stratum::Curved => problem.between(Variable::Input(Input::CrushPlane), 0.0, -1.2, 1.2),
        _ => problem.between(Variable::Input(Input::Restitution), 0.1, 0.0, 0.3),
    };
    problem = match stratum {
        Stratum::ShareNearBound | Stratum::ShareOnBound => problem.between(share, 0.9, 0.0, 1.0),
        Stratum::RatioOff => problem.between(Variable::Speed(Side::Two), 15.0, 0.0, 60.0).prior(share, ratio, 0.02),
        _ => problem.between(Variable::Speed(Side::Two), 15.0, 0.0, 60.0),
    };
    let vague = if stratum == Stratum::Curved { 2.0 } else { 1.0 };
    let mut all = vec![
        (Measurand::Output(Output::VelocityX(Side::One)), 0.5),
        (Measurand::Output(Output::VelocityY(Side::One)), 0.5),
        (Measurand::Output(Output::YawRate(Side::One)), 0.2),
        (Measurand::Output(Output::DeltaVMagnitude(Side::Two)), 0.5),
        (Measurand::SeparationDirection(Side::Two), 0.05),
        (Measurand::CrushEnergy, 0.08 * truth.measured(Measurand::CrushEnergy)),
        (Measurand::DeltaVForward(Side::One), 0.5),
    ];
    // Four to six pieces.
    for _ in 0..1 + source.0.random_range(0..3) {
        all.remove(source.0.random_range(0..all.len()));
    }
    let mut chi_square = if stratum == Stratum::RatioOff { 1.0 } else { 0.0 };
    for (of, sd) in all {
        let sd = vague * sd;
        let error: f64 = source.0.sample(StandardNormal);
        chi_square += error * error;
        problem = problem.evidence(of, truth.measured(of) + sd * error, Uncertainty::StandardDeviation(sd));
    }
    Crash { truth, problem, chi_square }
}

/// What became of the crashes of a stratum.
#[derive(Default)]
struct Tally {
    count: usize,
    /// Crashes without an answer.
    lost: Vec<u64>,
    /// Crashes whose best fit is worse than the truth.
    worse: Vec<u64>,
    /// By quantity: its intervals, and those that contain the truth.
    covered: Vec<(Measurand, usize, usize)>,
}

fn contains(interval: &Interval, truth: f64) -> bool {
    let turn = match interval.of {
        Measurand::Variable(Variable::Input(Input::CrushPlane)) => PI,
        Measurand::Output(Output::PrincipalDirectionOfForce(_)) => TAU,
        _ => f64::INFINITY,
    };
    let rounding = 1e-6 * (1.0 + truth.abs());
    let near = if turn.is_finite() { truth + turn * ((interval.value - truth) / turn).round() } else { truth };
    interval.low - rounding <= near && near <= interval.high + rounding
}

impl Tally {
    fn add(&mut self, stratum: Stratum, seed: u64) {
        let Crash { truth, problem, chi_square } = crash(stratum, &mut Source::of(seed));
        self.count += 1;
        let search = Search { starts: 16, ..Search::default() };
        let Ok(answer) = problem.solve(&search) else { return self.lost.push(seed) };
        // With another ratio, the truth is none of the answers.
        if stratum != Stratum::RatioWronglyCertain && answer.best().chi_square > chi_square + 1e-6 {
            self.worse.push(seed);
        }
        let unknowns = problem.unknowns.iter().map(|unknown| Measurand::Variable(unknown.of));
        let of: Vec<Measurand> = unknowns.chain(problem.derived()).collect();
        let intervals = problem.intervals(&answer, LEVEL, &of);
        assert_eq!(intervals.len(), of.len(), "{stratum:?} {seed}: an interval for each quantity");
        for interval in &intervals {
            let truth = truth.measured(interval.of);
            let place = self.covered.iter().position(|(of, ..)| *of == interval.of).unwrap_or_else(|| {
                self.covered.push((interval.of, 0, 0));
                self.covered.len() - 1
            });
            self.covered[place].1 += 1;
            self.covered[place].2 += usize::from(contains(interval, truth));
        }
    }

    fn with(mut self, other: Tally) -> Tally {
        self.count += other.count;
        self.lost.extend(other.lost);
        self.worse.extend(other.worse);
        for (of, count, covered) in other.covered {
            match self.covered.iter_mut().find(|(known, ..)| *known == of) {
                Some(known) => (known.1, known.2) = (known.1 + count, known.2 + covered),
                None => self.covered.push((of, count, covered)),
            }
        }
        self
    }

    fn of(stratum: Stratum, crashes: u64) -> Tally {
        let half = |from: u64| {
            let mut tally = Tally::default();
            (from..crashes).step_by(2).for_each(|seed| tally.add(stratum, seed));
            tally
        };
        thread::scope(|scope| {
            let other = scope.spawn(|| half(1));
            half(0).with(other.join().expect("it does not panic"))
        })
    }
}

#[test]
fn intervals_contain_the_truth_as_often_as_they_say() {
    const CRASHES: u64 = 150;
    for stratum in Stratum::ALL {
        let tally = Tally::of(stratum, CRASHES);
        assert!(tally.lost.is_empty() && tally.worse.is_empty(), "{}: lost {:?}, worse {:?}", stratum.name(), tally.lost, tally.worse);
        for (of, count, covered) in tally.covered {
            // Four standard deviations of a coverage of 94 %.
            let least = 0.94 - 4.0 * (0.94 * 0.06 / count as f64).sqrt();
            let coverage = covered as f64 / count as f64;
            assert!(coverage >= least, "{}, {}: {coverage:.3}", stratum.name(), of.name());
        }
    }
}

/// Returns the problem with an unknown known.
fn known(problem: &ReconstructionProblem, of: Variable, value: f64) -> ReconstructionProblem {
    let mut known = problem.clone();
    known.unknowns.retain(|unknown| unknown.of != of);
    known.collision = with(&problem.collision, of, value);
    known
}

/// The definition, by searches that know nothing of profiles: with an unknown held at an end, the least χ² of the others has risen by the quantile, or by less at
/// a bound or a limit; held a little further out, by more.
#[test]
fn ends_are_where_the_best_fit_of_the_rest_leaves_the_limit() {
    /// The 95 % quantile of χ² with one degree of freedom (Abramowitz and Stegun, table 26.8).
    const QUANTILE: f64 = 3.841_459;
    let search = Search { starts: 16, ..Search::default() };
    let (mut by_evidence, mut by_limits) = (0, 0);
    for (stratum, seed) in Stratum::ALL.into_iter().flat_map(|stratum| (1000..1008).map(move |seed| (stratum, seed))) {
        let Crash { problem, .. } = crash(stratum, &mut Source::of(seed));
        let answer = problem.solve(&search).expect("it has an answer");
        let least = answer.best().chi_square;
        for unknown in &problem.unknowns {
            let Some(interval) = problem.intervals(&answer, LEVEL, &[Measurand::Variable(unknown.of)]).pop() else {
                panic!("{stratum:?} {seed}")
            };
            let width = interval.high - interval.low;
            // A known value has no prior, but is as far from it.
            let of_prior = |value: f64| unknown.prior.map_or(0.0, |sd| ((value - unknown.start) / sd).powi(2));
            let rise = |value: f64| {
                known(&problem, unknown.of, value).solve(&search).map(|answer| answer.best().chi_square + of_prior(value) - least)
            };
            for (end, outwards, limit) in
                [(interval.low, -width, interval.low_limited_by), (interval.high, width, interval.high_limited_by)]
            {
                let what = format!("{stratum:?} {seed}: {} at {end}, {limit:?}", unknown.of.name());
                let is_own = matches!(limit, Some(Limit::Bound(of, _)) if of == unknown.of);
                if is_own {
                    by_limits += 1;
                    assert!(Some(end) == if outwards < 0.0 { unknown.min } else { unknown.max }, "{what}");
                    continue;
                }
                // A fit at the edge of the physics is defined to a ten thousandth.
                let risen = rise(end).unwrap_or_else(|error| panic!("{what}: {error}"));
                assert!(risen < QUANTILE + 0.02, "{what}: {risen}");
                assert!(limit.is_some() || risen > QUANTILE - 0.005, "{what}: the interval is too narrow, {risen}");
                match rise(end + 0.01 * outwards) {
                    Ok(beyond) => {
                        by_evidence += 1;
                        assert!(beyond > QUANTILE, "{what}: the interval is too narrow, {beyond}");
                    }
                    Err(_) => by_limits += 1,
                }
            }
        }
    }
    assert!(by_evidence > 100 && by_limits > 10, "{by_evidence} {by_limits}");
}

/// Crashes, those without an answer, those that fit worse than the truth, and those whose answer another seed does not give.
fn searched(stratum: Stratum, seeds: impl Iterator<Item = u64>) -> [Vec<u64>; 3] {
    let mut faults = [const { Vec::new() }; 3];
    for seed in seeds {
        let Crash { problem, chi_square, .. } = crash(stratum, &mut Source::of(seed));
        let best = |search: &Search| problem.solve(search).ok().map(|answer| answer.best().chi_square);
        let [Some(first), Some(second)] =
            [Search::default(), Search { seed: 1_000 + seed, ..Search::default() }].map(|search| best(&search))
        else {
            faults[0].push(seed);
            continue;
        };
        if first.max(second) > chi_square + 1e-6 {
            faults[1].push(seed);
        }
        // Along a valley that an edge of the physics cuts off, searches end a little apart.
        if (first - second).abs() > 1e-3 {
            faults[2].push(seed);
        }
    }
    faults
}

/// Where the vehicle whose direction is evidence stops, any direction fits, and searches would end anywhere.
#[test]
fn a_vehicle_that_stops_has_one_best_fit() {
    for (stratum, crashed) in [(Stratum::Inside, 1094), (Stratum::Curved, 99), (Stratum::RatioOff, 1557)] {
        let Crash { problem, .. } = crash(stratum, &mut Source::of(crashed));
        let best = |seed| problem.solve(&Search { seed, ..Search::default() }).expect("it has an answer").best().clone();
        let first = best(0);
        assert!(first.impact.two.after.velocity.length() < 1e-6, "{:?}", first.impact.two);
        for seed in 1..6 {
            let other = best(seed);
            assert!((other.chi_square - first.chi_square).abs() < 1e-7, "{crashed} {seed}: {} {}", other.chi_square, first.chi_square);
            for (one, other) in first.unknowns.iter().zip(&other.unknowns) {
                assert!((one.value - other.value).abs() < 1e-5, "{crashed} {seed}: {one:?} {other:?}");
            }
        }
    }
}

#[ignore = "minutes in release: twenty thousand crashes, each searched from two seeds"]
#[test]
fn no_seed_finds_less_than_the_truth_or_than_another() {
    let mut faults = Vec::new();
    for stratum in Stratum::ALL {
        let start = Instant::now();
        let half = |from: u64| searched(stratum, (from..2_860).step_by(2));
        let [even, odd] = thread::scope(|scope| {
            let other = scope.spawn(|| half(1));
            [half(0), other.join().expect("it does not panic")]
        });
        let [lost, worse, other] = std::array::from_fn(|kind| [&even[kind][..], &odd[kind][..]].concat());
        eprintln!("{}: {:.0} s, lost {lost:?}, worse {worse:?}, another answer {other:?}", stratum.name(), start.elapsed().as_secs_f64());
        faults.extend([lost, worse, other].concat());
    }
    assert!(faults.is_empty(), "{} of 20020 crashes", faults.len());
}

#[ignore = "minutes in release: the campaign behind docs/coverage.md"]
#[test]
fn the_whole_campaign() {
    let crashes = std::env::var("CRASHES").ok().and_then(|text| text.parse().ok()).unwrap_or(10_000);
    println!("| truth | crashes | without an answer | worse than the truth | least and greatest coverage |");
    println!("|---|---|---|---|---|");
    for stratum in Stratum::ALL.into_iter().chain([Stratum::RatioWronglyCertain]) {
        let start = Instant::now();
        let tally = Tally::of(stratum, crashes);
        eprintln!("{}: {:.0} s", stratum.name(), start.elapsed().as_secs_f64());
        let coverage = |(of, count, covered): &(Measurand, usize, usize)| (*covered as f64 / *count as f64, of.name());
        let mut all: Vec<(f64, &str)> = tally.covered.iter().map(coverage).collect();
        all.sort_by(|one, other| one.0.total_cmp(&other.0));
        let cell = |(share, name): (f64, &str)| format!("{:.2} % {name}", 100.0 * share);
        let (least, greatest) = (all.first().copied().map_or_else(String::new, cell), all.last().copied().map_or_else(String::new, cell));
        println!("| {} | {} | {} | {} | {least}, {greatest} |", stratum.name(), tally.count, tally.lost.len(), tally.worse.len());
        if !tally.lost.is_empty() || !tally.worse.is_empty() {
            eprintln!("lost {:?}, worse {:?}", &tally.lost[..tally.lost.len().min(10)], &tally.worse[..tally.worse.len().min(10)]);
        }
        for line in all {
            eprintln!("    {}", cell(line));
        }
    }
}
