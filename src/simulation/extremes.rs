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

#[cfg(test)]
mod tests {
    use super::*;

    const OF: [Output; 1] = [Output::Loss];

    fn of(parts: &[&[f64]]) -> [(f64, u64); 2] {
        let mut first = 0;
        let mut all = Extremes::of(&OF);
        for part in parts {
            let mut found = Extremes::of(&OF);
            found.take(&Samples { of: &OF, columns: &[part.to_vec()], first, places: None });
            first += part.len() as u64;
            all.merge(found);
        }
        all.get(OF[0]).expect("a sample").map(|extreme| (extreme.value, extreme.sample))
    }

    #[test]
    fn the_first_of_equal_extremes_stays_in_any_parts() {
        for parts in [&[&[2.0, 1.0, 3.0, 1.0, 3.0][..]][..], &[&[2.0, 1.0], &[3.0, 1.0, 3.0]], &[&[], &[2.0], &[1.0, 3.0], &[1.0, 3.0]]] {
            assert_eq!(of(parts), [(1.0, 1), (3.0, 2)]);
        }
    }

    #[test]
    fn what_is_not_a_number_replaces_what_is_and_stays() {
        for parts in [&[&[2.0, f64::NAN, 1.0, f64::NAN, 3.0][..]][..], &[&[2.0, f64::NAN], &[1.0], &[f64::NAN, 3.0]]] {
            let [least, greatest] = of(parts);
            assert!(least.0.is_nan() && greatest.0.is_nan());
            assert_eq!([least.1, greatest.1], [1, 1]);
        }
    }
}
