//! Simulations: collisions that are drawn, solved and summarized in cache, and never stored.
//!
//! A [`Simulation`] has a collision and the [`Distribution`] of each input that is uncertain. [`Simulation::reduce`] draws samples, solves them in
//! [batches](crate::batch) and gives their outputs to summaries: [`Moments`], [`Quantiles`], [`Extremes`], [`Histogram`], [`Exceedance`], several of them as a
//! tuple, or one of your own ([`Reduce`]). A sample that physics refuses is counted by reason.
//!
//! ```
//! use planar_impact::simulation::{Exceedance, Moments, Quantiles, Simulation};
//! use planar_impact::*;
//! let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
//! let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
//! let simulation = Simulation::of(collision.clone())
//!     .with(Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 1.0 })?
//!     .with(Input::Restitution, Distribution::Uniform { min: 0.0, max: 0.2 })?;
//! let delta_v = Output::DeltaVMagnitude(Side::One);
//! let nominal = collision.solve()?.one.delta_v_magnitude();
//! let empty = (Moments::of(&[delta_v]), Quantiles::of(&[delta_v]), Exceedance::of(delta_v, nominal));
//! let answer = simulation.reduce(100_000, empty, &|_| true);
//! let (moments, quantiles, above) = answer.summary;
//! assert_eq!(answer.refused.samples, 0);
//! assert!((moments.mean(delta_v) - nominal).abs() < 5.0 * moments.standard_error(delta_v));
//! assert!((quantiles.quantile(delta_v, 0.5) / nominal - 1.0).abs() < 0.01);
//! assert!((above.share() - 0.5).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The same bits
//!
//! The numbers of a sample depend on the seed, its own number and the input alone: another uncertain input, a longer run or another number of threads leave
//! them as they are. Summaries are merged in the order of the samples. So the answer has the same bits for any number of threads (feature `rayon`: those of the
//! pool in which `reduce` is called) and any vector instructions.

mod exceedance;
mod extremes;
pub(crate) mod fill;
mod histogram;
mod moments;
pub(crate) mod quantiles;
mod reduce;
mod summary;

pub use exceedance::Exceedance;
pub use extremes::{Extreme, Extremes};
pub use fill::{Draws, Fill};
pub use histogram::Histogram;
pub use moments::Moments;
pub use quantiles::Quantiles;
pub use reduce::{Reduced, RefusedSamples, SolvedSamples};
pub(crate) use reduce::{Source, reduce};
pub use summary::{Reduce, Samples};

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use crate::batch::{Batch, Instructions};
use crate::collision::Collision;
use crate::distribution::Distribution;
use crate::input::{Input, NoSuchInput};
use crate::issue::{InputIssue, Issues};
use crate::output::Output;

/// Collisions whose inputs are drawn.
#[derive(Clone, Debug)]
pub struct Simulation<F = Draws> {
    collision: Collision,
    fill: F,
    instructions: Instructions,
}

/// Reason why an input cannot be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum NotDrawn {
    /// The collision has no such input.
    NoSuchInput(NoSuchInput),
    /// The input has a distribution already.
    Twice(Input),
    /// The distribution has wrong parameters.
    Distribution(Input, Issues<InputIssue>),
}

impl fmt::Display for NotDrawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotDrawn::NoSuchInput(reason) => write!(f, "{reason}"),
            NotDrawn::Twice(input) => write!(f, "{input} has a distribution already; give each input one"),
            NotDrawn::Distribution(input, issues) => write!(f, "the distribution of {input}: {issues}"),
        }
    }
}

impl core::error::Error for NotDrawn {}

impl Simulation {
    /// Creates a simulation of a collision of which every input is certain.
    #[must_use]
    pub fn of(collision: Collision) -> Self {
        Simulation::filled(collision, Draws::default())
    }

    /// Returns the same simulation with an uncertain input, in SI units and radians.
    ///
    /// # Errors
    ///
    /// [`NotDrawn`] if the collision has no such input, if it is uncertain already, or if the distribution has wrong parameters.
    pub fn with(mut self, input: Input, distribution: Distribution) -> Result<Self, NotDrawn> {
        self.collision.input(input).ok_or(NotDrawn::NoSuchInput(NoSuchInput(input)))?;
        distribution.check().map_err(|issues| NotDrawn::Distribution(input, issues))?;
        if self.fill.inputs().contains(&input) {
            return Err(NotDrawn::Twice(input));
        }
        self.fill.push(input, distribution);
        Ok(self)
    }

    /// Returns the same simulation with another seed than 0.
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.fill.set_seed(seed);
        self
    }
}

impl<F: Fill> Simulation<F> {
    /// Creates a simulation of a collision whose uncertain inputs are filled in by code of yours.
    #[must_use]
    pub fn filled(collision: Collision, fill: F) -> Self {
        Simulation { collision, fill, instructions: Instructions::best() }
    }

    /// Returns the same simulation, to be computed with some vector instructions in place of the best: for comparing them. The bits are the same.
    #[must_use]
    pub fn on(self, instructions: Instructions) -> Self {
        Simulation { instructions, ..self }
    }

    /// Returns a sample by its number, such as that of an [`Extreme`].
    ///
    /// # Panics
    ///
    /// If a [`Fill`] of yours has not written one number for each input.
    pub fn sample(&self, number: u64) -> Collision {
        let mut columns = self.columns();
        self.fill.fill(number..number + 1, &mut columns);
        self.batch(&columns, 1).row(0)
    }

    /// Draws samples and summarizes those that physics accepts, in memory that does not grow with their number.
    ///
    /// `goes_on` is called with the number of samples that are done, from any thread; when it returns `false` the simulation stops, and the answer is that of
    /// the samples before.
    ///
    /// # Panics
    ///
    /// If a [`Fill`] of yours has not written a number for each sample and input.
    #[must_use]
    pub fn reduce<R: Reduce>(&self, samples: u64, empty: R, goes_on: &(dyn Fn(u64) -> bool + Sync)) -> Reduced<R> {
        reduce(self, samples, empty, goes_on)
    }

    fn columns(&self) -> Vec<Vec<f64>> {
        self.fill.inputs().iter().map(|_| Vec::new()).collect()
    }

    /// Returns some samples as a batch.
    ///
    /// # Panics
    ///
    /// If a fill has written another number of rows.
    fn batch<'a>(&self, columns: &'a [Vec<f64>], samples: usize) -> Batch<'a> {
        filled(Batch::of(self.collision).on(self.instructions).with_rows(samples), self.fill.inputs(), columns)
    }
}

/// Returns a batch with columns of inputs.
///
/// # Panics
///
/// If one has not as many rows as the batch.
pub(crate) fn filled<'a>(batch: Batch<'a>, inputs: &[Input], columns: &'a [Vec<f64>]) -> Batch<'a> {
    inputs.iter().zip(columns).fold(batch, |batch, (input, column)| match batch.with(*input, column) {
        Ok(batch) => batch,
        Err(unequal) => panic!("not every sample was written: {unequal}"),
    })
}

impl<F: Fill> Source for Simulation<F> {
    type Output = Output;

    fn solve(&self, samples: Range<u64>, of: &[Output]) -> SolvedSamples {
        let mut columns = self.columns();
        let rows = (samples.end - samples.start) as usize;
        self.fill.fill(samples, &mut columns);
        SolvedSamples::of(&self.batch(&columns, rows), of)
    }
}
