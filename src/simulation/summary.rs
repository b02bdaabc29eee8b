//! What a simulation makes of its samples: summaries, alone or several at once.

use alloc::vec::Vec;
use core::fmt;

use crate::output::Output;

/// Accepted samples with consecutive numbers, but for those refused.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a, K = Output> {
    pub(crate) of: &'a [K],
    pub(crate) columns: &'a [Vec<f64>],
    pub(crate) first: u64,
    /// The place of each among those drawn, unless all are accepted.
    pub(crate) places: Option<&'a [u64]>,
}

impl<'a, K: Copy + PartialEq + fmt::Debug> Samples<'a, K> {
    /// Returns the values of an output.
    ///
    /// # Panics
    ///
    /// If the output is not one of [`Reduce::outputs`].
    pub fn column(&self, output: K) -> &'a [f64] {
        let place = self.of.iter().position(|of| *of == output);
        place.map(|place| self.columns[place].as_slice()).unwrap_or_else(|| panic!("{output:?} is not among the outputs of the summary"))
    }

    /// Returns the number of the sample at a place of the columns.
    pub fn number(&self, place: usize) -> u64 {
        self.first + self.places.map_or(place as u64, |places| places[place])
    }
}

/// A summary of samples, of whose outputs a key is the name.
pub trait Reduce<K = Output>: Clone + Send + Sync {
    /// Returns the outputs that it needs.
    fn outputs(&self) -> Vec<K>;

    /// Adds samples that follow those it has.
    fn take(&mut self, samples: &Samples<'_, K>);

    /// Adds the summary of samples that follow those it has.
    fn merge(&mut self, later: Self);
}

macro_rules! tuples {
    ($($($part:ident $i:tt),+;)+) => {
        $(impl<K, $($part: Reduce<K>),+> Reduce<K> for ($($part,)+) {
            fn outputs(&self) -> Vec<K> {
                let mut outputs = Vec::new();
                $(outputs.extend(self.$i.outputs());)+
                outputs
            }

            fn take(&mut self, samples: &Samples<'_, K>) {
                $(self.$i.take(samples);)+
            }

            fn merge(&mut self, later: Self) {
                $(self.$i.merge(later.$i);)+
            }
        })+
    };
}

tuples! {
    A 0, B 1;
    A 0, B 1, C 2;
    A 0, B 1, C 2, D 3;
    A 0, B 1, C 2, D 3, E 4;
}

impl<K, R: Reduce<K>> Reduce<K> for Vec<R> {
    fn outputs(&self) -> Vec<K> {
        self.iter().flat_map(R::outputs).collect()
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        self.iter_mut().for_each(|part| part.take(samples));
    }

    fn merge(&mut self, later: Self) {
        self.iter_mut().zip(later).for_each(|(part, later)| part.merge(later));
    }
}
