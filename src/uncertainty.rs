//! Uncertainty: what an answer is worth, from one definition of the mechanics.
//!
//! ```
//! use planar_impact::uncertainty::MonteCarlo;
//! use planar_impact::*;
//! let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
//! let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
//! let uncertain = collision.uncertain(&[
//!     (Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 1.0 }),
//!     (Input::Restitution, Distribution::Uniform { min: 0.0, max: 0.2 }),
//! ])?;
//! let delta_v = Output::DeltaVMagnitude(Side::One);
//! // From exact derivatives: the speed matters more than the restitution.
//! let linear = uncertain.linear(delta_v)?;
//! assert!(linear.shares[0] > 0.5 && (linear.shares[0] + linear.shares[1] - 1.0).abs() < 1e-12);
//! // From samples, with the standard error of each figure.
//! let sampled = uncertain.monte_carlo(&[delta_v], &MonteCarlo::of(100_000));
//! let sd = sampled.output(delta_v).sd;
//! assert!((sd.value - linear.sd).abs() < 4.0 * sd.standard_error + 0.01 * linear.sd);
//! // For certain, with the speed within three standard deviations.
//! let range = uncertain.bounds(delta_v, 3.0, &uncertainty::Search::default(), &|_| true)?;
//! assert!(range.is_tight && range.low < linear.mean && linear.mean < range.high);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | question | method |
//! |---|---|
//! | mean, standard deviation, the share of each input in the variance | [`Uncertain::linear`] |
//! | how far does the curvature move them, and how skewed is the output | [`Uncertain::second_order`] |
//! | quantiles, probabilities, densities | [`Uncertain::monte_carlo`] |
//! | the share of each input in the variance, alone and with others, however curved the output | [`Uncertain::shares`] |
//! | the part of each number in the variance, correlated or not | [`Uncertain::shapley`] |
//! | a range that no value leaves, within the limits of the numbers | [`bounds`], [`Uncertain::bounds`] |
//!
//! An uncertain number is an input of the collision, or one that inputs follow from ([`Mapping`]); any other function of numbers is a [`Model`]. Correlated numbers have correlated normal scores (a Gaussian
//! copula). Samples that physics refuses are counted by reason, and never moved to where it would accept them.

mod bounds;
mod correlation;
mod linear;
mod mapping;
mod model;
mod monte_carlo;
mod number;
mod points;
mod shapley;
mod shares;
mod tally;

pub use bounds::{Bounded, Bounds, Enclosure, NoBounds, RefusedPart, Search, bounds, bounds_of};
pub use correlation::NotACorrelation;
pub use linear::{Linear, SecondOrder, SlopesAndValues};
pub use mapping::{Direct, Mapping};
pub use model::{Bend, Mapped, Model, Slope};
pub use monte_carlo::{Estimated, MonteCarlo, QUANTILES, Sampled, SampledOutput, Threshold};
pub use number::{UncertainNumber, Values};
pub use points::Points;
pub use shapley::ShapleyEffects;
pub use shares::{Correlated, Share, Shares};

use alloc::vec::Vec;

use crate::collision::Collision;
use crate::distribution::Distribution;
use crate::input::{Input, NoSuchInput};
use crate::output::Output;
use crate::simulation::NotDrawn;
use correlation::Correlation;

/// A collision with uncertain numbers.
#[derive(Clone, Debug)]
pub struct Uncertain<M = Mapped<Direct>> {
    model: M,
    numbers: Vec<UncertainNumber>,
    correlation: Correlation,
    /// The covariances of the numbers themselves, which take a series for each that is correlated.
    covariance: Vec<Vec<f64>>,
}

impl Collision {
    /// Returns this collision with uncertain inputs, independent of each other, in SI units and radians.
    ///
    /// # Errors
    ///
    /// [`NotDrawn`] if the collision has no such input, if an input is named twice, or if a distribution has wrong parameters.
    pub fn uncertain(&self, inputs: &[(Input, Distribution)]) -> Result<Uncertain, NotDrawn> {
        for (i, (input, distribution)) in inputs.iter().enumerate() {
            self.input(*input).ok_or(NotDrawn::NoSuchInput(NoSuchInput(*input)))?;
            if inputs[..i].iter().any(|(before, _)| before == input) {
                return Err(NotDrawn::Twice(*input));
            }
            distribution.check().map_err(|issues| NotDrawn::Distribution(*input, issues))?;
        }
        let (inputs, distributions): (Vec<Input>, Vec<Distribution>) = inputs.iter().copied().unzip();
        Ok(Uncertain::new(Mapped::new(*self, Direct(inputs)), distributions.into_iter().map(UncertainNumber::from).collect()))
    }
}

impl<M: Model> Uncertain<M> {
    /// Creates a model of uncertain numbers, independent of each other.
    ///
    /// # Panics
    ///
    /// Unless there is one distribution for each number of the model.
    #[must_use]
    pub fn new(model: M, numbers: Vec<UncertainNumber>) -> Self {
        assert!(numbers.len() == model.numbers(), "{} distributions for {} numbers", numbers.len(), model.numbers());
        let correlation = Correlation::none(numbers.len());
        let covariance = correlation.covariance(&numbers);
        Uncertain { model, numbers, correlation, covariance }
    }

    /// Returns the same with correlations of pairs, each named by the places of its numbers: the coefficients of their normal scores.
    ///
    /// # Errors
    ///
    /// [`NotACorrelation`] if a coefficient is out of range, or if no numbers have these correlations.
    pub fn with_correlations(self, pairs: &[(usize, usize, f64)]) -> Result<Self, NotACorrelation> {
        let correlation = Correlation::of(self.numbers.len(), pairs)?;
        let covariance = correlation.covariance(&self.numbers);
        Ok(Uncertain { correlation, covariance, ..self })
    }

    /// Returns `true` if any two numbers are correlated.
    pub fn is_correlated(&self) -> bool {
        self.correlation.has_any()
    }

    /// Returns the distribution of each number.
    pub fn numbers(&self) -> &[UncertainNumber] {
        &self.numbers
    }

    /// Returns the model.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Returns the range of each number, infinite ends replaced by quantiles at so many standard deviations of a normal number.
    pub fn ranges(&self, deviations: f64) -> Vec<(f64, f64)> {
        self.numbers.iter().map(|number| number.range(deviations)).collect()
    }

    /// Returns the mean of each number.
    pub fn means(&self) -> Vec<f64> {
        self.numbers.iter().map(UncertainNumber::mean).collect()
    }
}

impl<M: Mapping> Uncertain<Mapped<M>> {
    /// Returns the guaranteed range of an output with each number within its [`range`](Self::ranges), whatever the correlations: see [`bounds`].
    ///
    /// # Errors
    ///
    /// [`NoBounds`], as of [`bounds`].
    pub fn bounds(&self, of: Output, deviations: f64, search: &Search, goes_on: &(dyn Fn(u64) -> bool + Sync)) -> Result<Bounds, NoBounds> {
        bounds(self.model.collision(), self.model.mapping(), &self.ranges(deviations), of, search, goes_on)
    }
}

#[cfg(test)]
mod tests;
