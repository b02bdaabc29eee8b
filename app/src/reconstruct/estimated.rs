//! What a reconstruction says of a quantity, whether it is an unknown or follows from them.

use super::answer::{Interval, ProfileLevel, Reconstruction};
use super::guaranteed::Guaranteed;
use super::posterior::Posterior;
use crate::units::Measure;

/// What is known of a quantity, in SI.
#[derive(Clone, Copy, Debug)]
pub struct Estimated<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its measure.
    pub measure: Measure,
    /// Its value; `None` where the evidence leaves it open.
    pub value: Option<f64>,
    /// Its standard deviation, if it has one.
    pub sd: Option<f64>,
    /// Its interval.
    pub interval: &'a Interval,
    /// Its bounds in the file, which only an unknown has.
    pub bounds: [Option<f64>; 2],
    /// The profile of its likelihood, on request.
    pub profile: Option<&'a [ProfileLevel]>,
    /// Its guaranteed range, which only an unknown has, on request.
    pub guaranteed: Option<&'a Guaranteed>,
    /// Its posterior, on request.
    pub posterior: Option<&'a Posterior>,
}

impl Reconstruction {
    /// Returns the unknowns, and then what follows from them.
    pub fn estimates(&self) -> impl Iterator<Item = Estimated<'_>> {
        let unknown = self.unknown.iter().map(|(name, of)| Estimated {
            name,
            measure: of.measure,
            value: of.value,
            sd: of.sd,
            interval: &of.interval,
            bounds: [of.min, of.max],
            profile: of.profile.as_deref(),
            guaranteed: of.guaranteed.as_ref(),
            posterior: of.posterior.as_ref(),
        });
        let derived = self.derived.iter().map(|(name, of)| Estimated {
            name,
            measure: of.measure,
            value: of.value,
            sd: of.sd,
            interval: &of.interval,
            bounds: [None, None],
            profile: of.profile.as_deref(),
            guaranteed: None,
            posterior: of.posterior.as_ref(),
        });
        unknown.chain(derived)
    }
}
