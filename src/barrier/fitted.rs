//! The parts of a fit: the covariance of its coefficients, and its residuals.

use crate::crush::ProfileMoments;
use crate::scalar::{Field, Real};

/// Covariance of d₀ and d₁.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StiffnessCovariance<T = f64> {
    /// Variance of d₀, in N.
    pub onset: T,
    /// Covariance of d₀ and d₁, in N/m.
    pub between: T,
    /// Variance of d₁, in N/m².
    pub slope: T,
}

/// One test in the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Residual<T = f64> {
    /// Moments of its crush.
    pub crush: ProfileMoments<T>,
    /// E* as measured, in √N.
    pub observed: T,
    /// E* as fitted, in √N.
    pub fitted: T,
    /// Variance of the measured E*, in N, as given.
    pub variance: T,
}

impl<T: Field> StiffnessCovariance<T> {
    /// Returns the variance of a number whose derivatives by d₀ and d₁ are given.
    pub fn along(&self, by_onset: T, by_slope: T) -> T {
        let cross = T::int(2) * by_onset.clone() * by_slope.clone() * self.between.clone();
        by_onset.squared() * self.onset.clone() + cross + by_slope.squared() * self.slope.clone()
    }
}

impl<T: Real> StiffnessCovariance<T> {
    /// Returns the correlation of d₀ and d₁, from −1 to 1.
    pub fn correlation(&self) -> T {
        let correlation = self.between.clone() / (self.onset.clone().square_root() * self.slope.clone().square_root());
        // With A held they are one number, and rounding may lead beyond.
        correlation.smaller(T::int(1)).larger(T::int(-1))
    }
}

impl<T: Field> Residual<T> {
    /// Returns the measured E* less the fitted one, in √N.
    pub fn difference(&self) -> T {
        self.observed.clone() - self.fitted.clone()
    }
}

impl<T: Real> Residual<T> {
    /// Returns the difference in standard deviations of the measured E*.
    pub fn standardized(&self) -> T {
        self.difference() / self.variance.clone().square_root()
    }
}
