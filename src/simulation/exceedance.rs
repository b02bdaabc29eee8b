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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    #[test]
    fn what_is_the_threshold_is_not_above_it() {
        let of = Output::DeltaVMagnitude(Side::One);
        let count = |threshold: f64| {
            let mut count = Exceedance::of(of, threshold);
            count.take(&Samples { of: &[of], columns: &[vec![1.0, 2.0, 2.0, 3.0]], first: 0, places: None });
            count
        };
        assert_eq!(count(2.0), Exceedance { of, threshold: 2.0, above: 1, samples: 4, undecided: 0 });
        assert_eq!((count(2.0).share(), count(1.5).share()), (0.25, 0.75));
        // Nothing is above or below what is no number.
        assert!(count(f64::NAN).undecided == 4 && count(f64::NAN).share().is_nan());
    }
}
