//! The posterior: what the evidence and the priors together say of the unknowns, as draws.
//!
//! Ensembles of walkers (Goodman and Weare 2010; ter Braak and Vrugt 2008) start around the solutions. They need no slopes, so the limits of the physics, where
//! the density ends at once, are no obstacle to them.

use std::borrow::Cow;
use std::fmt;

use nalgebra::DMatrix;

use super::density::Density;
use super::ensemble::Ensembles;
use super::given::{ReconstructionProblem, Unknown};
use super::interval::Interval;
use super::marginal::Marginal;
use super::measurand::Measurand;
use super::proposal::Proposal;
use super::residuals::Model;
use super::search::spans;
use super::solution::Solution;
use super::variable::{Variable, turns};
use super::verdict::Answer;
use crate::issue::Issue;
use crate::least_squares::ParameterBounds;
use crate::message::Message;

/// Settings of the draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Number of chains: ensembles that know nothing of each other.
    pub chains: usize,
    /// Least number of draws of each chain.
    pub draws: usize,
    /// The seed of the draws.
    pub seed: u64,
}

impl Default for Sampling {
    /// Returns four chains of a thousand draws.
    fn default() -> Self {
        Sampling { chains: 4, draws: 1000, seed: 1 }
    }
}

impl Sampling {
    /// Returns settings for shortest ranges of a probability: as many draws as leave a hundred outside of the range, at least those of the default and at most
    /// a hundred thousand in all. The shortest of few draws is too short: by 3 % where twenty lie outside of it, by 1 % where a hundred do.
    ///
    /// ```
    /// use planar_impact::reconstruct::Sampling;
    ///
    /// assert_eq!(Sampling::for_level(0.95), Sampling::default());
    /// assert_eq!(Sampling::for_level(0.999).draws, 25_000);
    /// ```
    pub fn for_level(level: f64) -> Self {
        /// Number of draws outside of the range.
        const OUTSIDE: f64 = 100.0;
        let default = Sampling::default();
        let of_chain = (OUTSIDE / (1.0 - level) / default.chains as f64).round();
        Sampling { draws: (of_chain as usize).clamp(default.draws, 25 * default.draws), ..default }
    }
}

/// Reason why there is no posterior.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoPosterior {
    /// Nothing limits these unknowns, so that no density has the integral 1.
    Improper(Vec<Variable>),
    /// The mechanics refuses the collision all around the solutions.
    NoRoom,
    /// The caller stopped it.
    Stopped,
}

impl Issue for NoPosterior {
    type Number = f64;

    fn code(&self) -> &'static str {
        match self {
            NoPosterior::Improper(_) => "posterior-improper",
            NoPosterior::NoRoom => "no-posterior",
            NoPosterior::Stopped => "stopped",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        Some("unknown".into())
    }

    fn message(&self) -> Message {
        match self {
            NoPosterior::Improper(unknowns) => {
                let names: Vec<&str> = unknowns.iter().map(|of| of.name()).collect();
                Message::new().text(format!("nothing limits {}: give bounds or a standard deviation", names.join(", ")))
            }
            NoPosterior::NoRoom => {
                "the mechanics refuses the collision all around the solutions: give the evidence a standard deviation".into()
            }
            NoPosterior::Stopped => "stopped before the draws were complete".into(),
        }
    }
}

impl fmt::Display for NoPosterior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(f)
    }
}

impl std::error::Error for NoPosterior {}

/// Draws of the unknowns from their posterior.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    question: ReconstructionProblem,
    /// The unknowns of the best solution.
    best: Vec<f64>,
    /// For each chain, the draws of its walkers in turn.
    chains: Vec<Vec<Vec<f64>>>,
    walkers: usize,
    /// Exact evidence, which the draws meet to a thousandth of its size.
    pub softened: Vec<Measurand>,
}

impl ReconstructionProblem {
    /// Draws the unknowns from their posterior: the density of the priors, uniform where nothing else is known, times the likelihood of the evidence, and zero
    /// where the mechanics refuses the collision. An angle without bounds stays within half a period of the best solution.
    ///
    /// The same problem and the same seed give the same draws, bit for bit, whatever the number of processors. They become further apart until they have
    /// converged, up to a limit: see [`Marginal::r_hat`].
    ///
    /// ```
    /// use planar_impact::reconstruct::*;
    /// use planar_impact::*;
    ///
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(13.0);
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// let after = collision.solve()?.one;
    /// let problem = ReconstructionProblem::of(collision)
    ///     .unknown(Variable::Speed(Side::One), 15.0)
    ///     .between(Variable::Input(Input::Restitution), 0.1, 0.0, 0.3)
    ///     .evidence(Measurand::DeltaVForward(Side::One), after.delta_v_in_vehicle.forward, Uncertainty::StandardDeviation(0.5))
    ///     .evidence(Measurand::Output(Output::YawRate(Side::One)), after.after.yaw_rate, Uncertainty::StandardDeviation(0.2));
    /// let answer = problem.solve(&Search::default())?;
    /// let posterior = problem.posterior(&answer, &Sampling::default())?;
    /// let [speed] = &posterior.marginals(&[Measurand::Variable(Variable::Speed(Side::One))], 0.95)[..] else { panic!() };
    /// assert!(speed.r_hat < 1.01);
    /// // Every restitution up to 0.3 is as likely as 0.1, so the speed was probably less than 13 m/s.
    /// assert!((0.15..0.4).contains(&speed.probability_above(13.0)), "{}", speed.probability_above(13.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`NoPosterior`].
    pub fn posterior(&self, answer: &Answer, sampling: &Sampling) -> Result<Posterior, NoPosterior> {
        self.posterior_while(answer, sampling, &|_, _| true)
    }

    /// As [`ReconstructionProblem::posterior`], and calls a function on this thread as it proceeds, with the number of steps that are done and of all, of the
    /// intervals where the draws begin and then of each round of draws. It stops by returning `false`.
    ///
    /// # Errors
    ///
    /// [`NoPosterior`].
    pub fn posterior_while(
        &self,
        answer: &Answer,
        sampling: &Sampling,
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Posterior, NoPosterior> {
        let best = answer.best().values();
        let density = Density::of(self, self.proper_spans(answer, &best, goes_on)?);
        let proposal = self.proposal(&density, answer, goes_on)?;
        let (chains, walkers) = Ensembles::of(&density, sampling).draw(&proposal, &best, goes_on)?;
        Ok(Posterior { question: self.clone(), best, chains, walkers, softened: density.softened() })
    }

    /// Returns the limits of each unknown, between which the posterior has a finite integral.
    fn proper_spans(
        &self,
        answer: &Answer,
        best: &[f64],
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Vec<ParameterBounds>, NoPosterior> {
        /// Level at which an interval without an end shows that nothing limits an unknown.
        const FAR: f64 = 0.999_999;
        let mut spans = spans(self);
        for ((unknown, span), best) in self.unknowns.iter().zip(&mut spans).zip(best) {
            let half = unknown.of.period().map_or(f64::INFINITY, |period| 0.5 * period);
            if span.min.is_infinite() || span.max.is_infinite() {
                (span.min, span.max) = (span.min.max(best - half), span.max.min(best + half));
            }
        }
        let needs_end =
            |(unknown, span): &(&Unknown, &ParameterBounds)| unknown.prior.is_none() && (span.min.is_infinite() || span.max.is_infinite());
        let to_follow = self.unknowns.iter().zip(&spans).filter(needs_end).map(|(unknown, _)| Measurand::Variable(unknown.of));
        let to_follow: Vec<Measurand> = to_follow.collect();
        let intervals = self.intervals_while(answer, FAR, &to_follow, goes_on).ok_or(NoPosterior::Stopped)?;
        let has_end = |interval: &Interval| interval.low.is_finite() && interval.high.is_finite();
        let endless = intervals.iter().filter(|interval| !has_end(interval)).filter_map(|interval| match interval.of {
            Measurand::Variable(of) => Some(of),
            _ => None,
        });
        let endless: Vec<Variable> = endless.collect();
        if endless.is_empty() { Ok(spans) } else { Err(NoPosterior::Improper(endless)) }
    }

    /// Returns normal approximations of the posterior at each solution.
    fn proposal(&self, density: &Density<'_>, answer: &Answer, goes_on: &dyn Fn(usize, usize) -> bool) -> Result<Proposal, NoPosterior> {
        let of: Vec<Measurand> = self.unknowns.iter().map(|unknown| Measurand::Variable(unknown.of)).collect();
        let intervals = self.intervals_while(answer, 0.95, &of, goes_on).ok_or(NoPosterior::Stopped)?;
        let width = |i: usize| {
            let width = intervals.iter().find(|interval| interval.of == of[i]).map(|interval| interval.high - interval.low);
            width.filter(|width| width.is_finite() && *width > 0.0).unwrap_or(density.spans[i].scale)
        };
        // Where the evidence leaves an unknown open, it goes as far as its interval.
        let widest = DMatrix::from_fn(of.len(), of.len(), |i, k| if i == k { 1.0 / (width(i) * width(i)) } else { 0.0 });
        let around = |solution: &Solution| {
            let center = solution.values();
            let slopes = density.model.weights.whiten(density.model.derivatives(&center));
            (center, slopes.tr_mul(&slopes) + &widest)
        };
        Proposal::around(answer.solutions.iter().chain(&answer.worse).map(around))
            .or_else(|| Proposal::around(std::iter::once((answer.best().values(), widest.clone()))))
            .ok_or(NoPosterior::NoRoom)
    }
}

impl Posterior {
    /// Returns the unknowns, in the order of their values in a draw.
    pub fn unknowns(&self) -> impl Iterator<Item = Variable> {
        self.question.unknowns.iter().map(|unknown| unknown.of)
    }

    /// Returns the draws of each chain: the values of the unknowns, in SI.
    pub fn chains(&self) -> &[Vec<Vec<f64>>] {
        &self.chains
    }

    /// Returns the values of quantities in each draw, chain after chain. A quantity that the unknowns do not determine is left out.
    pub fn values(&self, of: &[Measurand]) -> Vec<(Measurand, Vec<f64>)> {
        let model = Model::of(&self.question);
        let of: Vec<Measurand> = of.iter().copied().filter(|of| self.question.determines(*of)).collect();
        let values = |unknowns: &[f64]| -> Vec<f64> {
            let placed = model.place(unknowns);
            let impact = placed.evaluate();
            of.iter().map(|of| model.value(*of, unknowns, &placed, &impact).unwrap_or(f64::NAN)).collect()
        };
        // An unknown angle is not wrapped.
        let period = |of: Measurand| of.period().filter(|_| self.question.place_of(of).is_none());
        let turned: Vec<(f64, Option<f64>)> = values(&self.best).into_iter().zip(of.iter().copied().map(period)).collect();
        let mut columns: Vec<(Measurand, Vec<f64>)> = of.iter().map(|of| (*of, Vec::new())).collect();
        for draw in self.chains.iter().flatten() {
            for (((_, column), value), (best, period)) in columns.iter_mut().zip(values(draw)).zip(&turned) {
                column.push(value - turns(value - best, *period));
            }
        }
        columns
    }

    /// Returns the posterior of quantities, with their shortest ranges of a probability such as 0.95. A quantity that the unknowns do not determine, or that is
    /// undefined in a draw, is left out.
    ///
    /// # Panics
    ///
    /// If the probability is not between 0 and 1.
    pub fn marginals(&self, of: &[Measurand], level: f64) -> Vec<Marginal> {
        assert!(level > 0.0 && level < 1.0, "the probability of a range is between 0 and 1, and not {level}");
        let marginal = |(of, column): (Measurand, Vec<f64>)| Marginal::of(of, &column, self.chains.len(), self.walkers, level);
        self.values(of).into_iter().filter_map(marginal).collect()
    }
}
