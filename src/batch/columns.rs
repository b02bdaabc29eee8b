//! Columns of numbers by what they are of.

use core::fmt::Debug;
use core::ops::Index;

use alloc::vec::Vec;

use crate::output::Output;

/// Numbers of every row, a column for each output, or for whatever else was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns<K = Output> {
    of: Vec<K>,
    values: Vec<Vec<f64>>,
}

impl<K: Copy + PartialEq> Columns<K> {
    /// Creates columns, each of one thing.
    pub(super) fn new(of: &[K], values: Vec<Vec<f64>>) -> Self {
        debug_assert_eq!(of.len(), values.len());
        Columns { of: of.to_vec(), values }
    }

    /// Returns each column with what it is of, in the order in which they were asked for.
    pub fn iter(&self) -> impl Iterator<Item = (K, &[f64])> {
        self.of.iter().copied().zip(self.values.iter().map(Vec::as_slice))
    }

    /// Returns a column, or `None` if it was not asked for.
    pub fn get(&self, of: K) -> Option<&[f64]> {
        self.iter().find(|(found, _)| *found == of).map(|(_, column)| column)
    }

    /// Returns the columns themselves, in the order in which they were asked for.
    pub fn into_columns(self) -> Vec<Vec<f64>> {
        self.values
    }
}

impl<K: Copy + PartialEq + Debug> Index<K> for Columns<K> {
    type Output = [f64];

    /// # Panics
    ///
    /// If the column was not asked for.
    fn index(&self, of: K) -> &[f64] {
        self.get(of).unwrap_or_else(|| panic!("{of:?} was not asked for"))
    }
}
