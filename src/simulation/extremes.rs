//! Least and greatest values.

use alloc::vec;
use alloc::vec::Vec;

use super::{Reduce, Samples};
use crate::output::Output;

/// A value and the number of its sample, from which [`Simulation::sample`](super::Simulation::sample) returns the collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// The first sample that has it.
    pub sample: u64,
}

/// The least and the greatest value of outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    of: Vec<Output>,
    found: Vec<Option<[Extreme; 2]>>,
}

impl Extremes {
    /// Creates the summary of no samples.
    #[must_use]
    pub fn of(of: &[Output]) -> Self {
        Extremes { of: of.to_vec(), found: vec![None; of.len()] }
    }

    /// Returns the least and the greatest value of an output, or `None` without a sample. A value that is not a number is both.
    ///
    /// # Panics
    ///
    /// If the summary does not have the output.
    pub fn get(&self, of: Output) -> Option<[Extreme; 2]> {
        let place = self.of.iter().position(|output| *output == of);
        self.found[place.unwrap_or_else(|| panic!("{of} is not among the outputs of the summary"))]
    }
}

fn add(to: &mut Option<[Extreme; 2]>, [least, greatest]: [Extreme; 2]) {
    let Some([low, high]) = to else {
        *to = Some([least, greatest]);
        return;
    };
    // What is not a number stays, and replaces what is.
    if least.value < low.value || (least.value.is_nan() && !low.value.is_nan()) {
        *low = least;
    }
    if greatest.value > high.value || (greatest.value.is_nan() && !high.value.is_nan()) {
        *high = greatest;
    }
}

impl Reduce for Extremes {
    fn outputs(&self) -> Vec<Output> {
        self.of.clone()
    }

    fn take(&mut self, samples: &Samples<'_>) {
        for (of, to) in self.of.iter().zip(&mut self.found) {
            for (place, value) in samples.column(*of).iter().enumerate() {
                let is_within = to.is_some_and(|[low, high]| low.value <= *value && *value <= high.value);
                if !is_within {
                    add(to, [Extreme { value: *value, sample: samples.number(place) }; 2]);
                }
            }
        }
    }

    fn merge(&mut self, later: Self) {
        for (to, later) in self.found.iter_mut().zip(later.found) {
            if let Some(later) = later {
                add(to, later);
            }
        }
    }
}
