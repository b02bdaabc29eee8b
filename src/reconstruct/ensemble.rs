//! Ensembles of walkers that draw from a density.

use std::ops::ControlFlow;
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use hammer_and_sample::{DifferentialEvolution, Mixture, Model, Schedule, Serial, Stretch, sample};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::Gumbel;

use super::convergence::Convergence;
use super::density::Density;
use super::posterior::{NoPosterior, Sampling};
use super::proposal::Proposal;

/// Number of steps before the first draws.
const PILOT: usize = 100;

/// Number of steps from a draw of a walker to its next, in the first round; twice as many in each further one.
const STEPS: usize = 10;

/// Maximum number of rounds until the draws have converged.
const ROUNDS: usize = 5;

/// Most draws of a chain in a round: a round holds all of its steps in memory.
const OF_ROUND: usize = 1000;

/// A draw: the values of the unknowns.
type Draw = Vec<f64>;

/// Ensembles that know nothing of each other, one for each chain.
pub(super) struct Ensembles<'a> {
    density: &'a Density<'a>,
    sampling: &'a Sampling,
    /// Number of walkers of each.
    walkers: usize,
    stopped: AtomicBool,
}

impl Model for Density<'_> {
    type Params = Draw;

    fn log_prob(&self, draw: &Draw) -> f64 {
        self.log(draw)
    }
}

/// The number of steps of an ensemble, with a report of each.
struct Steps<'a> {
    done: usize,
    total: usize,
    stopped: &'a AtomicBool,
    goes_on: Option<&'a dyn Fn(usize, usize) -> bool>,
}

impl Schedule<Draw> for Steps<'_> {
    fn next_step(&mut self, _: &[Draw]) -> ControlFlow<()> {
        if self.goes_on.is_some_and(|goes_on| !goes_on(self.done, self.total)) {
            self.stopped.store(true, Ordering::Relaxed);
        }
        if self.done == self.total || self.stopped.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        self.done += 1;
        ControlFlow::Continue(())
    }

    fn iterations(&self, _: usize) -> Option<usize> {
        Some(self.total)
    }
}

/// A round of one ensemble.
struct Round {
    chain: usize,
    number: usize,
    starts: Vec<Draw>,
    proposal: Proposal,
    steps: usize,
    /// Number of steps from a draw to the next.
    apart: usize,
}

impl<'a> Ensembles<'a> {
    pub(super) fn of(density: &'a Density<'a>, sampling: &'a Sampling) -> Self {
        /// Number of walkers for up to eight unknowns: the sampler needs two for each.
        const WALKERS: usize = 20;
        let walkers = WALKERS.max(2 * density.spans.len() + density.spans.len() / 2);
        Ensembles { density, sampling, walkers: walkers + walkers % 2, stopped: AtomicBool::new(false) }
    }

    /// Returns the draws of each chain, those of its walkers in turn, and the number of walkers.
    pub(super) fn draw(
        &self,
        proposal: &Proposal,
        best: &[f64],
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<(Vec<Vec<Draw>>, usize), NoPosterior> {
        let pilot = |chain: usize| {
            let starts = self.starts(proposal, best, chain)?;
            Some(Round { chain, number: 0, starts, proposal: proposal.clone(), steps: PILOT, apart: 2 })
        };
        let pilots: Option<Vec<Round>> = (0..self.sampling.chains.max(1)).map(pilot).collect();
        let mut draws = self.run(pilots.ok_or(NoPosterior::NoRoom)?, goes_on)?;
        let asked = self.sampling.draws.max(1).next_multiple_of(self.walkers);
        let of_round = asked.min(OF_ROUND.next_multiple_of(self.walkers));
        let round = |number: usize, apart: usize, draws: usize, from: &[Vec<Draw>], learnt: &[Vec<Draw>]| {
            let next = from.iter().zip(learnt).enumerate().map(|(chain, (from, learnt))| {
                let starts = from[from.len() - self.walkers..].to_vec();
                let proposal = proposal.with_draws(&learnt[learnt.len() / 2..]);
                Round { chain, number, starts, proposal, steps: draws / self.walkers * apart, apart }
            });
            self.run(next.collect(), goes_on)
        };
        let mut apart = STEPS;
        for number in 1..=ROUNDS {
            apart = STEPS << (number - 1);
            draws = round(number, apart, of_round, &draws, &draws)?;
            if self.has_converged(&draws) {
                break;
            }
        }
        let learnt = draws.clone();
        for number in ROUNDS + 1.. {
            let missing = asked - draws.first().map_or(asked, Vec::len);
            if missing == 0 {
                break;
            }
            let further = round(number, apart, missing.min(of_round), &draws, &learnt)?;
            draws.iter_mut().zip(further).for_each(|(draws, further)| draws.extend(further));
        }
        Ok((draws, self.walkers))
    }

    /// Returns distinct starts for the walkers of a chain, drawn from the proposal and chosen about as often as the density has it.
    fn starts(&self, proposal: &Proposal, best: &[f64], chain: usize) -> Option<Vec<Draw>> {
        /// Number of candidates for each start.
        const CANDIDATES: usize = 20;
        /// Number of times that candidates halve their distance from the best solution, if too few are possible.
        const HALVINGS: i32 = 40;
        let mut random = self.random(usize::MAX, chain, 0);
        let mut found: Vec<(f64, Draw)> = Vec::new();
        for halvings in 0..HALVINGS {
            for _ in 0..CANDIDATES * self.walkers {
                let mut draw = proposal.draw(&mut random);
                if halvings > 0 {
                    let shrink = libm::scalbn(1.0, -halvings);
                    draw.iter_mut().zip(best).for_each(|(x, best)| *x = best + shrink * (*x - best));
                }
                let weight = self.density.log(&draw) - proposal.log_density(&draw);
                // The greatest sums with Gumbel noise are a sample without repetition.
                let noise: f64 = Gumbel::new(0.0, 1.0).map_or(0.0, |gumbel| random.sample(gumbel));
                if weight.is_finite() {
                    found.push((weight + noise, draw));
                }
            }
            if found.len() >= self.walkers {
                found.sort_by(|one, other| other.0.total_cmp(&one.0));
                return Some(found.into_iter().take(self.walkers).map(|(_, draw)| draw).collect());
            }
        }
        None
    }

    /// Returns the random numbers of a walker in a round.
    fn random(&self, round: usize, chain: usize, walker: usize) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.sampling.seed);
        random.set_stream((round as u64) << 40 | (chain as u64) << 20 | walker as u64);
        random
    }

    /// Runs a round of every ensemble, the first on this thread.
    fn run(&self, rounds: Vec<Round>, goes_on: &dyn Fn(usize, usize) -> bool) -> Result<Vec<Vec<Draw>>, NoPosterior> {
        let mut rounds = rounds.into_iter();
        let first = rounds.next();
        let rest: Vec<Round> = rounds.collect();
        let draws = thread::scope(|scope| {
            let threads: Vec<_> =
                rest.iter().map(|round| thread::Builder::new().spawn_scoped(scope, || self.walk(round, None)).map_err(|_| round)).collect();
            let first = first.iter().map(|round| self.walk(round, Some(goes_on))).collect::<Vec<_>>();
            // Where there are no threads, one chain follows another.
            let rest = threads.into_iter().map(|thread| match thread {
                Ok(thread) => thread.join().unwrap_or_else(|payload| panic::resume_unwind(payload)),
                Err(round) => self.walk(round, None),
            });
            first.into_iter().chain(rest).collect()
        });
        if self.stopped.load(Ordering::Relaxed) { Err(NoPosterior::Stopped) } else { Ok(draws) }
    }

    fn walk(&self, round: &Round, goes_on: Option<&dyn Fn(usize, usize) -> bool>) -> Vec<Draw> {
        let dimension = self.density.spans.len() as f64;
        // A step of the whole difference of two walkers leads from one mode to another.
        let moves = Mixture::from((
            (Stretch::default(), 2_u32),
            (DifferentialEvolution::new(2.38 / (2.0 * dimension).sqrt(), 1e-2), 2),
            (DifferentialEvolution::new(1.0, 1e-2), 1),
            (round.proposal.clone(), 3),
        ));
        let walkers = round.starts.iter().cloned().enumerate().map(|(i, start)| (start, self.random(round.number, round.chain, i)));
        let steps = Steps { done: 0, total: round.steps, stopped: &self.stopped, goes_on };
        let (all, _) = sample(self.density, &moves, walkers, steps, Serial);
        let kept = all.chunks(self.walkers).skip(round.apart - 1).step_by(round.apart);
        kept.flat_map(<[Draw]>::to_vec).collect()
    }

    fn has_converged(&self, chains: &[Vec<Draw>]) -> bool {
        (0..self.density.spans.len()).all(|i| {
            let column: Vec<f64> = chains.iter().flatten().map(|draw| draw[i]).collect();
            Convergence::of(&column, chains.len(), self.walkers).is_reached(column.len())
        })
    }
}
