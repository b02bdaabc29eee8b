//! The inverse of a covariance, the weight of a least-squares fit.

use super::issue::TestIssues;
use crate::issue::{InputIssue, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, is_positive};
use alloc::vec::Vec;

/// A covariance, factored into L D Lᵀ, where the diagonal of L is 1. Without a square root, rationals stay exact.
pub(super) struct Weight<T> {
    /// Rows of L, each up to but excluding its diagonal.
    lower: Vec<Vec<T>>,
    pivots: Vec<T>,
}

impl<T: Ordered<Mask = bool>> Weight<T> {
    /// Factors a covariance given by its rows, each up to its diagonal; `place` is the place of each row in the input.
    pub fn of(covariance: &[Vec<T>], place: impl Fn(usize) -> Place) -> Result<Self, TestIssues<T>> {
        let mut weight = Weight { lower: Vec::new(), pivots: Vec::<T>::new() };
        for (i, row) in covariance.iter().enumerate() {
            // L D of this row, then L.
            let mut scaled: Vec<T> = Vec::with_capacity(i);
            for (j, entry) in row[..i].iter().enumerate() {
                let known = dot(&scaled, &weight.lower[j]);
                scaled.push(entry.clone() - known);
            }
            let lower: Vec<T> = scaled.iter().zip(&weight.pivots).map(|(s, d)| s.clone() / d.clone()).collect();
            let pivot = row[i].clone() - dot(&scaled, &lower);
            if !is_positive(&pivot) {
                return Err(InputIssue::not_positive(place(i).named("pivot of the covariance", Measure::Force), pivot).into());
            }
            weight.lower.push(lower);
            weight.pivots.push(pivot);
        }
        Ok(weight)
    }
}

impl<T: Field> Weight<T> {
    /// Returns the inverse of the covariance times a column.
    pub fn times(&self, column: &[T]) -> Vec<T> {
        let mut solved: Vec<T> = Vec::with_capacity(column.len());
        for (row, entry) in self.lower.iter().zip(column) {
            let known = dot(row, &solved);
            solved.push(entry.clone() - known);
        }
        for (entry, pivot) in solved.iter_mut().zip(&self.pivots) {
            *entry = entry.clone() / pivot.clone();
        }
        for i in (0..solved.len()).rev() {
            let value = solved[i].clone();
            for (entry, factor) in solved.iter_mut().zip(&self.lower[i]) {
                *entry = entry.clone() - factor.clone() * value.clone();
            }
        }
        solved
    }
}

/// Returns the sum of products over the shorter of two columns.
pub(super) fn dot<T: Field>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::int(0), |sum, (a, b)| sum + a.clone() * b.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn row(i: usize) -> Place {
        Place::plain("row").at(i)
    }

    #[test]
    fn the_inverse_undoes_the_covariance() {
        // By hand: [[4, 2, −2], [2, 10, 2], [−2, 2, 6]] (1, −2, 3)ᵀ = (−6, −12, 12).
        let weight = Weight::of(&[vec![4.0], vec![2.0, 10.0], vec![-2.0, 2.0, 6.0]], row).expect("positive definite");
        for (got, expected) in weight.times(&[-6.0, -12.0, 12.0]).into_iter().zip([1.0, -2.0, 3.0]) {
            approx::assert_relative_eq!(got, expected, max_relative = 1e-14);
        }
    }

    #[test]
    fn what_is_no_covariance_is_refused() {
        assert!(Weight::of(&[vec![1.0], vec![2.0, 1.0]], row).is_err());
        assert!(Weight::of(&[vec![f64::NAN]], row).is_err());
    }
}
