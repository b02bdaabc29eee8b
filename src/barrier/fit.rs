//! d₀ and d₁ from several tests: weighted least squares of E* against the crush, with their uncertainty.

use super::estimate::Estimate;
use super::fitted::{Residual, StiffnessCovariance};
use super::issue::{TestIssue, TestIssues};
use super::observation::Observations;
use super::profile_fit::Free;
use super::{line_fit, profile_fit};
use crate::crush::{CrushStiffness, ProfileMoments};
use crate::issue::{IssueCollector, Place};
use crate::scalar::{Field, Ordered, Real};
use alloc::vec::Vec;
use core::fmt;

/// The model of a test's crush in the fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CrushModel {
    /// Mean depth: E* = d₀ + d₁ C, as in the paper (Eq 3). Exact for flat profiles.
    MeanDepth,
    /// The profile itself: E*² = d₀² + 2 d₀ d₁ C + d₁² C², with the means of C and of C² over the width. This is Eq 4.
    Profile,
}

/// The basis of the covariance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CovarianceBasis {
    /// The standard deviations as given.
    Deviations,
    /// The standard deviations up to a common factor that the residuals determine: the covariance is scaled by χ² over the degrees of freedom.
    Residuals,
}

/// A property of a fit that is implausible for a stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum FitFinding<T = f64> {
    /// d₀ is below zero: crush would remain without any energy.
    NegativeOnset(T),
    /// d₁ is below zero: the structure would absorb less energy the deeper it is crushed.
    NegativeSlope(T),
    /// There are only as many tests as coefficients, so the residuals do not measure the scatter.
    NoFreedom,
}

impl<T: fmt::Display> fmt::Display for FitFinding<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FitFinding::NegativeOnset(onset) => write!(f, "d0 is {onset}, below zero: the tests would leave crush at no energy"),
            FitFinding::NegativeSlope(slope) => {
                write!(f, "d1 is {slope}, below zero: the structure would take less energy the deeper it is crushed")
            }
            FitFinding::NoFreedom => write!(f, "there are as many tests as coefficients: the residuals say nothing of the scatter"),
        }
    }
}

/// A stiffness that was fitted to tests.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct StiffnessFit<T = f64> {
    /// d₀ and d₁ as fitted, even if negative.
    pub stiffness: CrushStiffness<T>,
    /// Their covariance.
    pub covariance: StiffnessCovariance<T>,
    /// The basis of the covariance.
    pub basis: CovarianceBasis,
    /// The model of the crush.
    pub model: CrushModel,
    /// Residuals of the tests, in their order.
    pub residuals: Vec<Residual<T>>,
    /// χ²: the sum of the squares of the residuals, weighted by the inverse of their covariance as given.
    pub chi_square: T,
    /// Number of tests less number of coefficients.
    pub degrees_of_freedom: usize,
}

impl<T: Ordered<Mask = bool>> StiffnessFit<T> {
    /// Fits the line E* = d₀ + d₁ C through the mean depths, in closed form.
    ///
    /// ```
    /// use planar_impact::barrier::{Observation, Observations, StiffnessFit};
    /// use planar_impact::crush::ProfileMoments;
    /// let flat = |depth, intensity| Observation { crush: ProfileMoments::of(1.5, &[depth, depth]).unwrap(), intensity, deviation: 10.0 };
    /// let tests = Observations::independent(&[flat(0.1, 160.0), flat(0.3, 350.0), flat(0.5, 560.0)])?;
    /// let fit = StiffnessFit::<f64>::on_mean_depth(&tests)?;
    /// assert!((fit.stiffness.slope - 1000.0).abs() < 1e-9);
    /// // The line is known best in the middle: 10 √N/√3.
    /// assert!((fit.intensity_at(0.3).deviation() - 10.0 / 3_f64.sqrt()).abs() < 1e-9);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If there are fewer than two tests or fewer than two different mean depths, or the covariance is not positive definite.
    pub fn on_mean_depth(observations: &Observations<T>) -> Result<Self, TestIssues<T>> {
        let weight = line_fit::ready(observations)?;
        let (stiffness, covariance) = line_fit::line(observations, &weight);
        let fitted = |crush: &ProfileMoments<T>| stiffness.crush_intensity(crush.mean_depth());
        let (residuals, chi_square) = line_fit::residuals(observations, &weight, fitted);
        Self::of(stiffness, covariance, CrushModel::MeanDepth, residuals, chi_square).within_range()
    }

    /// Returns an error if the numbers were so large or so small that a result is not finite.
    pub(super) fn within_range(self) -> Result<Self, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (name, number) in [
            ("fitted d0", &self.stiffness.onset),
            ("fitted d1", &self.stiffness.slope),
            ("variance of d0", &self.covariance.onset),
            ("variance of d1", &self.covariance.slope),
            ("chi square", &self.chi_square),
        ] {
            issues.finite(Place::plain(name), number);
        }
        issues.finish().map(|()| self)
    }

    /// Returns the properties of the fit that are implausible for a stiffness.
    pub fn findings(&self) -> Vec<FitFinding<T>> {
        let negative = |value: &T| value.less(&T::int(0)).then(|| value.clone());
        let onset = negative(&self.stiffness.onset).map(FitFinding::NegativeOnset);
        let slope = negative(&self.stiffness.slope).map(FitFinding::NegativeSlope);
        onset.into_iter().chain(slope).chain((self.degrees_of_freedom == 0).then_some(FitFinding::NoFreedom)).collect()
    }
}

impl StiffnessFit {
    /// Returns `true` if the tests differ by more than their standard deviations allow: a χ² as large has a probability below 5 %.
    pub fn is_poor(&self) -> bool {
        /// The standard normal number that 5 % exceed.
        const ONE_IN_TWENTY: f64 = 1.644_853_626_951_472_2;
        self.is_beyond(ONE_IN_TWENTY)
    }

    /// Returns `true` if the tests contradict each other: a χ² as large has a probability below one in a thousand.
    pub fn is_contradicted(&self) -> bool {
        /// The standard normal number that one in a thousand exceeds.
        const ONE_IN_A_THOUSAND: f64 = 3.090_232_306_167_813;
        self.is_beyond(ONE_IN_A_THOUSAND)
    }

    /// Returns `true` if χ² is greater than its quantile at a standard normal score: the cube root of χ² over the degrees of freedom is nearly normal (Wilson and
    /// Hilferty 1931).
    fn is_beyond(&self, score: f64) -> bool {
        if self.degrees_of_freedom == 0 || self.basis == CovarianceBasis::Residuals {
            return false;
        }
        let freedom = self.degrees_of_freedom as f64;
        let variance = 2.0 / (9.0 * freedom);
        // Cubes instead of cube roots, which the core library has not.
        let greatest = 1.0 - variance + score * variance.square_root();
        self.chi_square > freedom * greatest * greatest * greatest
    }
}

impl<T: Real + Ordered<Mask = bool>> StiffnessFit<T> {
    /// Fits the stiffness whose crush energy of each measured profile (Eq 4) is nearest to that of its test, in terms of E*.
    ///
    /// Takes Newton steps from the line through the mean depths until they are at rounding level, and one more, so that derivatives of first and second order
    /// have converged as well. The result is the solution near that line: two very uneven profiles can have a second one that is just as exact, which a third
    /// test would distinguish.
    ///
    /// # Errors
    ///
    /// As [`Self::on_mean_depth`], and if the fit does not converge, or d₀ and d₁ change E* of all profiles alike where it is best.
    pub fn on_profiles(observations: &Observations<T>) -> Result<Self, TestIssues<T>> {
        let weight = line_fit::ready(observations)?;
        let (start, _) = line_fit::line(observations, &weight);
        let (stiffness, covariance) = profile_fit::settle(observations, &weight, start, Free::Both)?;
        let fitted = |crush: &ProfileMoments<T>| profile_fit::intensity(&stiffness, crush);
        let (residuals, chi_square) = line_fit::residuals(observations, &weight, fitted);
        Self::of(stiffness, covariance, CrushModel::Profile, residuals, chi_square).within_range()
    }

    /// Fits d₁ to one or more tests with d₀ held, in √N: that of a speed b₀ in m/s that leaves no crush is b₀ √(m/w).
    ///
    /// ```
    /// use planar_impact::barrier::{BarrierTest, CrushModel, MeasuredTest, Observations, StiffnessFit};
    /// use planar_impact::crush::ProfileMoments;
    /// // Malibu 2008, NHTSA test 6268; b₀ is assumed to be 2.2 m/s.
    /// let crush = ProfileMoments::of(1.478, &[0.265, 0.474, 0.504, 0.505, 0.475, 0.310]).unwrap();
    /// let test = BarrierTest { mass: 1779.0, speed: 15.6, restitution: 0.0, crush };
    /// let measured = MeasuredTest { test, speed_deviation: 0.0, restitution_deviation: 0.0, scatter: 10.0 };
    /// let onset = 2.2 * (1779.0 / 1.478_f64).sqrt();
    /// let fit = StiffnessFit::with_onset(&Observations::of_tests(&[[measured]])?, onset, CrushModel::Profile)?;
    /// assert!((fit.stiffness.slope - test.stiffness(2.2)?.slope).abs() < 1e-9);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If there is no test, a test has no depth, the covariance is not positive definite, or the fit does not converge.
    pub fn with_onset(observations: &Observations<T>, onset: T, model: CrushModel) -> Result<Self, TestIssues<T>> {
        let weight = line_fit::ready_for_slope(observations)?;
        let (slope, variance) = line_fit::slope(observations, &weight, &onset);
        let line = CrushStiffness { onset, slope };
        let (stiffness, covariance) = match model {
            CrushModel::MeanDepth => (line, StiffnessCovariance { onset: T::int(0), between: T::int(0), slope: variance }),
            CrushModel::Profile => profile_fit::settle(observations, &weight, line, Free::Slope)?,
        };
        let fitted = |crush: &ProfileMoments<T>| match model {
            CrushModel::MeanDepth => stiffness.crush_intensity(crush.mean_depth()),
            CrushModel::Profile => profile_fit::intensity(&stiffness, crush),
        };
        let (residuals, chi_square) = line_fit::residuals(observations, &weight, fitted);
        let degrees_of_freedom = residuals.len() - 1;
        let fit = Self::of(stiffness, covariance, model, residuals, chi_square);
        StiffnessFit { degrees_of_freedom, ..fit }.within_range()
    }
}

impl<T: Field> StiffnessFit<T> {
    pub(super) fn of(
        stiffness: CrushStiffness<T>,
        covariance: StiffnessCovariance<T>,
        model: CrushModel,
        residuals: Vec<Residual<T>>,
        chi_square: T,
    ) -> Self {
        let degrees_of_freedom = residuals.len().saturating_sub(2);
        StiffnessFit { stiffness, covariance, basis: CovarianceBasis::Deviations, model, residuals, chi_square, degrees_of_freedom }
    }

    /// Returns the same fit with the covariance from the residuals, for standard deviations that are only known relative to each other: the covariance times
    /// χ²/ν. Returns `None` without degrees of freedom ν.
    pub fn rescaled(&self) -> Option<Self> {
        let freedom = T::from_usize(self.degrees_of_freedom).filter(|_| self.degrees_of_freedom > 0)?;
        let factor = self.chi_square.clone() / freedom;
        let times = |variance: &T| variance.clone() * factor.clone();
        let StiffnessCovariance { onset, between, slope } = &self.covariance;
        let covariance = match self.basis {
            CovarianceBasis::Deviations => StiffnessCovariance { onset: times(onset), between: times(between), slope: times(slope) },
            CovarianceBasis::Residuals => self.covariance.clone(),
        };
        Some(StiffnessFit { covariance, basis: CovarianceBasis::Residuals, ..self.clone() })
    }

    /// Returns d₀ with its variance, in √N.
    pub fn onset(&self) -> Estimate<T> {
        Estimate { value: self.stiffness.onset.clone(), variance: self.covariance.onset.clone() }
    }

    /// Returns d₁ with its variance, in √N/m.
    pub fn slope(&self) -> Estimate<T> {
        Estimate { value: self.stiffness.slope.clone(), variance: self.covariance.slope.clone() }
    }

    /// Returns E* = d₀ + d₁ C at a depth in m, in √N, with the variance that follows from the covariance.
    pub fn intensity_at(&self, depth: T) -> Estimate<T> {
        Estimate { value: self.stiffness.crush_intensity(depth.clone()), variance: self.covariance.along(T::int(1), depth) }
    }

    /// Returns the crush energy of a profile (Eq 4), in J, with the variance that follows from the covariance to first order, from the exact derivatives
    /// ∂E_C/∂d₀ = 2 d₀ K₁ + d₁ K₂ and ∂E_C/∂d₁ = d₀ K₂ + 2 d₁ K₃. The profile is taken as exact.
    pub fn energy_of(&self, crush: ProfileMoments<T>) -> Estimate<T> {
        let CrushStiffness { onset, slope } = self.stiffness.clone();
        let by_onset = T::int(2) * onset.clone() * crush.first.clone() + slope.clone() * crush.second.clone();
        let by_slope = onset * crush.second.clone() + T::int(2) * slope * crush.third.clone();
        Estimate { value: self.stiffness.crush_energy(crush), variance: self.covariance.along(by_onset, by_slope) }
    }

    /// Returns the crush energy of a flat profile of a depth and a width in m, in J, with the variance that follows from the covariance.
    pub fn energy_at(&self, depth: T, width: T) -> Estimate<T> {
        let (second, third) = (width.clone() * depth.clone(), width.clone() * depth.squared().half());
        self.energy_of(ProfileMoments { first: width.half(), second, third })
    }
}

#[cfg(test)]
mod tests;
