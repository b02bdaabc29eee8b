//! Correlations of uncertain numbers: the Gaussian copula.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::number::{UncertainNumber, covariance};

/// Coefficients of correlation of normal scores, with the factor L of their matrix L Lᵀ.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Correlation {
    coefficients: Vec<Vec<f64>>,
    factor: Vec<Vec<f64>>,
}

/// Reason why coefficients are not the correlation of uncertain numbers, which are named by their places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotACorrelation {
    /// A pair names a number that there is not, or the same number twice.
    NoSuchPair(usize, usize),
    /// A coefficient is not between −1 and 1.
    OutOfRange(usize, usize, f64),
    /// A pair has two coefficients.
    Twice(usize, usize),
    /// No numbers have these correlations: given the numbers before it, the first would have a negative variance. The other is the one with which its
    /// correlation is the greatest.
    Indefinite(usize, usize),
}

impl fmt::Display for NotACorrelation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotACorrelation::NoSuchPair(one, other) => {
                write!(f, "a correlation is of two different uncertain numbers, not of {one} and {other}")
            }
            NotACorrelation::OutOfRange(one, other, found) => {
                write!(f, "the correlation of the numbers {one} and {other} must lie between −1 and 1, not {found}")
            }
            NotACorrelation::Twice(one, other) => write!(f, "the numbers {one} and {other} have two correlations; give one"),
            NotACorrelation::Indefinite(one, other) => {
                write!(f, "no numbers have these correlations; reduce that of the numbers {one} and {other}")
            }
        }
    }
}

impl core::error::Error for NotACorrelation {}

impl Correlation {
    /// Creates the correlations of independent numbers.
    pub(super) fn none(numbers: usize) -> Self {
        let unit = |i: usize| (0..numbers).map(|j| f64::from(u8::from(i == j))).collect();
        let rows: Vec<Vec<f64>> = (0..numbers).map(unit).collect();
        Correlation { coefficients: rows.clone(), factor: rows }
    }

    /// Creates the correlations of some pairs; others are independent.
    pub(super) fn of(numbers: usize, pairs: &[(usize, usize, f64)]) -> Result<Self, NotACorrelation> {
        let Correlation { mut coefficients, .. } = Correlation::none(numbers);
        for &(one, other, r) in pairs {
            if one == other || one >= numbers || other >= numbers {
                return Err(NotACorrelation::NoSuchPair(one, other));
            }
            if !(-1.0..=1.0).contains(&r) {
                return Err(NotACorrelation::OutOfRange(one, other, r));
            }
            if coefficients[one][other] != 0.0 {
                return Err(NotACorrelation::Twice(one, other));
            }
            (coefficients[one][other], coefficients[other][one]) = (r, r);
        }
        let (factor, sound) = factor(numbers, |i, k| coefficients[i][k]);
        sound?;
        Ok(Correlation { coefficients, factor })
    }

    pub(super) fn has_any(&self) -> bool {
        (0..self.coefficients.len()).any(|number| self.is_correlated(number))
    }

    /// Returns `true` if a number is correlated with another.
    pub(super) fn is_correlated(&self, number: usize) -> bool {
        self.coefficients[number].iter().enumerate().any(|(other, r)| other != number && *r != 0.0)
    }

    /// Returns the score of a number, given independent scores of all.
    #[inline]
    pub(super) fn score(&self, number: usize, independent: impl Fn(usize) -> f64) -> f64 {
        self.factor[number][..=number].iter().enumerate().map(|(k, entry)| entry * independent(k)).sum()
    }

    /// Returns the factor for the numbers in another order, in which each has a place.
    pub(super) fn factor_in(&self, order: &[usize]) -> Vec<Vec<f64>> {
        // A matrix that has a factor in one order has one in any.
        factor(order.len(), |i, k| self.coefficients[order[i]][order[k]]).0
    }

    /// Returns the coefficient of a pair.
    pub(super) fn coefficient(&self, one: usize, other: usize) -> f64 {
        self.coefficients[one][other]
    }

    /// Returns the covariances of the numbers themselves, which the copula determines: exact for normal numbers, to about six digits for others. Those of measured
    /// values that are correlated beyond ±0.95 have fewer, because their steps take many terms.
    pub(super) fn covariance(&self, of: &[UncertainNumber]) -> Vec<Vec<f64>> {
        let series: Vec<Option<_>> = (0..of.len()).map(|i| self.is_correlated(i).then(|| of[i].hermite())).collect();
        let entry = |i: usize, j: usize| match (&series[i], &series[j]) {
            _ if i == j => of[i].sd() * of[i].sd(),
            (Some(one), Some(other)) => covariance(one, other, self.coefficients[i][j]),
            _ => 0.0,
        };
        (0..of.len()).map(|i| (0..of.len()).map(|j| entry(i, j)).collect()).collect()
    }
}

/// Returns the Cholesky factor of a matrix with a unit diagonal, and whether its square is the matrix. A number that those before it determine has no entry on the
/// diagonal.
fn factor(numbers: usize, coefficient: impl Fn(usize, usize) -> f64) -> (Vec<Vec<f64>>, Result<(), NotACorrelation>) {
    /// Squares that count as nothing.
    const SINGULAR: f64 = 1e-9;
    let mut sound = Ok(());
    let mut factor = vec![vec![0.0; numbers]; numbers];
    for i in 0..numbers {
        let magnitude = |k: &usize| coefficient(i, *k).abs();
        let indefinite = || {
            let worst = (0..i).max_by(|one, other| magnitude(one).total_cmp(&magnitude(other)));
            Err(NotACorrelation::Indefinite(i, worst.unwrap_or(i)))
        };
        for k in 0..i {
            let known: f64 = (0..k).map(|l| factor[i][l] * factor[k][l]).sum();
            let left = coefficient(i, k) - known;
            if factor[k][k] > 0.0 {
                factor[i][k] = left / factor[k][k];
            } else if left * left > SINGULAR {
                sound = sound.and_then(|()| indefinite());
            }
        }
        let square = 1.0 - factor[i][..i].iter().map(|entry| entry * entry).sum::<f64>();
        if square < -SINGULAR {
            sound = sound.and_then(|()| indefinite());
        }
        factor[i][i] = if square > SINGULAR { libm::sqrt(square) } else { 0.0 };
    }
    (factor, sound)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Distribution;

    #[test]
    fn the_factor_has_the_correlations() {
        let pairs = [(0, 1, 0.5), (2, 0, -0.3), (1, 2, 0.4)];
        let correlation = Correlation::of(4, &pairs).expect("a correlation");
        for (i, j, r) in pairs.into_iter().chain([(3, 3, 1.0), (3, 0, 0.0)]) {
            let product: f64 = (0..4).map(|k| correlation.factor[i][k] * correlation.factor[j][k]).sum();
            assert!((product - r).abs() < 1e-15, "{i} {j}");
            assert_eq!(correlation.coefficient(i, j), r);
        }
        assert_eq!([0, 1, 2, 3].map(|i| correlation.is_correlated(i)), [true, true, true, false]);
        assert_eq!(correlation.score(3, |k| [9.0, 9.0, 9.0, 2.0][k]), 2.0);
        assert!(!Correlation::none(3).has_any() && correlation.has_any());
        let twice = Correlation::of(3, &[(0, 1, 1.0), (0, 2, 0.5), (1, 2, 0.5)]).expect("the same number twice");
        let scores = |i: usize| twice.score(i, |k| [0.3, 7.0, 1.1][k]);
        assert_eq!((scores(0), scores(1)), (0.3, 0.3));
        assert!((scores(2) - (0.15 + 0.75_f64.sqrt() * 1.1)).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_correlation_is_refused() {
        let refused = |pairs: &[(usize, usize, f64)]| Correlation::of(3, pairs).expect_err("no correlation");
        assert_eq!(refused(&[(0, 3, 0.1)]), NotACorrelation::NoSuchPair(0, 3));
        assert_eq!(refused(&[(1, 1, 0.1)]), NotACorrelation::NoSuchPair(1, 1));
        assert_eq!(refused(&[(0, 1, 1.5)]), NotACorrelation::OutOfRange(0, 1, 1.5));
        assert!(matches!(refused(&[(0, 1, f64::NAN)]), NotACorrelation::OutOfRange(..)));
        assert_eq!(refused(&[(0, 1, 0.5), (1, 0, 0.2)]), NotACorrelation::Twice(1, 0));
        // The same number twice has one correlation with a third.
        assert_eq!(refused(&[(0, 1, 1.0), (0, 2, 0.5), (1, 2, 0.4)]), NotACorrelation::Indefinite(2, 0));
        // Two correlations of 0.8 need a third of at least 0.28.
        assert_eq!(refused(&[(0, 1, 0.8), (0, 2, 0.8), (1, 2, 0.27)]), NotACorrelation::Indefinite(2, 0));
        assert!(Correlation::of(3, &[(0, 1, 0.8), (0, 2, 0.8), (1, 2, 0.29)]).is_ok());
    }

    #[test]
    fn normal_numbers_have_the_covariance_of_their_scores() {
        let of = [Distribution::Normal { mean: 1.0, sd: 2.0 }, Distribution::Normal { mean: 5.0, sd: 3.0 }].map(UncertainNumber::from);
        let found = Correlation::of(2, &[(0, 1, -0.5)]).expect("a correlation").covariance(&of);
        assert_eq!(found, [[4.0, -3.0], [-3.0, 9.0]]);
        assert_eq!(Correlation::none(2).covariance(&of), [[4.0, 0.0], [0.0, 9.0]]);
    }
}
