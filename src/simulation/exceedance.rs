//! How often an output exceeds a value.

use alloc::vec;
use alloc::vec::Vec;

use super::{Reduce, Samples};
use crate::output::Output;

/// The share of samples in which an output is greater than a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Exceedance {
    of: Output,
    threshold: f64,
    /// Samples in which it is greater.
    pub above: u64,
    /// All samples.
    pub samples: u64,
    /// Samples in which the output is not a number, and so neither.
    pub undecided: u64,
}

impl Exceedance {
    /// Creates the summary of no samples.
    #[must_use]
    pub fn of(of: Output, threshold: f64) -> Self {
        Exceedance { of, threshold, above: 0, samples: 0, undecided: 0 }
    }

    /// Returns the share of samples in which the output is greater; NaN without a sample, and if one is undecided.
    pub fn share(&self) -> f64 {
        if self.undecided > 0 { f64::NAN } else { self.above as f64 / self.samples as f64 }
    }

    /// Returns the standard error of the share.
    pub fn standard_error(&self) -> f64 {
        libm::sqrt(self.share() * (1.0 - self.share()) / self.samples as f64)
    }
}

impl Reduce for Exceedance {
    fn outputs(&self) -> Vec<Output> {
        vec![self.of]
    }

    fn take(&mut self, samples: &Samples<'_>) {
        let column = samples.column(self.of);
        self.samples += column.len() as u64;
        self.above += column.iter().map(|x| u64::from(*x > self.threshold)).sum::<u64>();
        self.undecided += column.iter().map(|x| u64::from(x.is_nan() || self.threshold.is_nan())).sum::<u64>();
    }

    fn merge(&mut self, later: Self) {
        self.above += later.above;
        self.samples += later.samples;
        self.undecided += later.undecided;
    }
}
