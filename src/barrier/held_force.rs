//! A fit with the force A at the onset of crush held: d₀ = A/d₁, so that d₁ alone is fitted.

use alloc::vec::Vec;

use super::fit::{CrushModel, StiffnessFit};
use super::fitted::StiffnessCovariance;
use super::issue::{TestIssue, TestIssues};
use super::line_fit;
use super::observation::Observations;
use super::profile_fit;
use super::test::mean_square_depth;
use super::weight::dot;
use crate::crush::{CrushStiffness, ProfileMoments};
use crate::scalar::{Ordered, Real, is_positive, slack};

/// Maximum number of steps, and steps after the value has converged to rounding, for the derivatives.
const STEPS: usize = 200;
const STEPS_OF_DERIVATIVES: usize = 2;

impl<T: Real + Ordered<Mask = bool>> StiffnessFit<T> {
    /// Fits d₁ to one or more tests with A = d₀ d₁ held, in N/m.
    ///
    /// A test whose energy is between two solutions has the one with the larger d₁, in which most of the energy comes from the depth. Where A is more than the
    /// energy of a test allows, the fit misses it.
    ///
    /// ```
    /// use planar_impact::barrier::{CrushModel, Observation, Observations, StiffnessFit};
    /// use planar_impact::crush::ProfileMoments;
    /// let flat = |depth, intensity| Observation { crush: ProfileMoments::of(1.5, &[depth, depth]).unwrap(), intensity, deviation: 10.0 };
    /// // d₀ = 60 √N and d₁ = 1000 √N/m.
    /// let tests = Observations::independent(&[flat(0.1, 160.0), flat(0.5, 560.0)])?;
    /// let fit = StiffnessFit::<f64>::with_force(&tests, 60e3, CrushModel::MeanDepth)?;
    /// assert!((fit.stiffness.slope - 1000.0).abs() < 1e-9 && (fit.stiffness.onset - 60.0).abs() < 1e-9);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If there is no test, a test has no depth, the covariance is not positive definite, or the fit does not converge.
    pub fn with_force(observations: &Observations<T>, force: T, model: CrushModel) -> Result<Self, TestIssues<T>> {
        let weight = line_fit::ready_for_slope(observations)?;
        let with = |slope: &T| CrushStiffness { onset: force.clone() / slope.clone(), slope: slope.clone() };
        let fitted = |stiffness: &CrushStiffness<T>, crush: &ProfileMoments<T>| match model {
            CrushModel::MeanDepth => stiffness.crush_intensity(crush.mean_depth()),
            CrushModel::Profile => profile_fit::intensity(stiffness, crush),
        };
        // The derivative by d₁, with that of d₀ = A/d₁.
        let by_slope = |stiffness: &CrushStiffness<T>, crush: &ProfileMoments<T>| {
            let CrushStiffness { onset, slope } = stiffness.clone();
            let mean = crush.mean_depth();
            let falls = onset.clone() / slope.clone();
            match model {
                CrushModel::MeanDepth => mean - falls,
                CrushModel::Profile => {
                    let by_onset = onset.clone() + slope.clone() * mean.clone();
                    let by_slope = onset * mean + slope * mean_square_depth(crush);
                    (by_slope - falls * by_onset) / fitted(stiffness, crush)
                }
            }
        };
        let mut slope = start(observations, &force)?;
        let mut settled_for = 0;
        let mut information = T::int(0);
        for _ in 0..STEPS {
            let stiffness = with(&slope);
            let by: Vec<T> = observations.points.iter().map(|point| by_slope(&stiffness, &point.crush)).collect();
            let off: Vec<T> = observations.points.iter().map(|point| point.intensity.clone() - fitted(&stiffness, &point.crush)).collect();
            let weighed = weight.times(&by);
            information = dot(&weighed, &by);
            if settled_for > STEPS_OF_DERIVATIVES {
                break;
            }
            let step = dot(&weighed, &off) / information.clone();
            settled_for = if (slope.clone() * slack()).less(&step.clone().magnitude()) { 0 } else { settled_for + 1 };
            let next = slope.clone() + step;
            // Half of the way to zero is the farthest, so that d₁ stays above it.
            slope = if slope.clone().half().less(&next) { next } else { slope.half() };
        }
        if settled_for <= STEPS_OF_DERIVATIVES || !is_positive(&information) {
            let most = greatest_force(observations)?;
            let issue = if most.less(&force) { TestIssue::ForceTooLarge { force, most } } else { TestIssue::NotConverged { steps: STEPS } };
            return Err(issue.into());
        }
        let stiffness = with(&slope);
        let variance = information.inv();
        let falls = stiffness.onset.clone() / slope;
        let covariance = StiffnessCovariance {
            onset: falls.clone().squared() * variance.clone(),
            between: -(falls * variance.clone()),
            slope: variance,
        };
        let (residuals, chi_square) = line_fit::residuals(observations, &weight, |crush| fitted(&stiffness, crush));
        let degrees_of_freedom = residuals.len() - 1;
        let fit = Self::of(stiffness, covariance, model, residuals, chi_square);
        StiffnessFit { degrees_of_freedom, ..fit }.within_range()
    }
}

/// Returns d₁ of the mean test: the larger solution of C d₁² − E* d₁ + A = 0, or that of the least E* where there is none.
fn start<T: Real + Ordered<Mask = bool>>(observations: &Observations<T>, force: &T) -> Result<T, TestIssues<T>> {
    let [depth, intensity] = means(observations)?;
    let square = intensity.clone().squared() - T::int(4) * force.clone() * depth.clone();
    let root = if is_positive(&square) { square.square_root() } else { T::int(0) };
    Ok((intensity + root) / (T::int(2) * depth))
}

/// Returns the greatest A for which C d₁² − E* d₁ + A = 0 of the mean test has a solution.
fn greatest_force<T: Real + Ordered<Mask = bool>>(observations: &Observations<T>) -> Result<T, TestIssues<T>> {
    let [depth, intensity] = means(observations)?;
    Ok(intensity.squared() / (T::int(4) * depth))
}

/// Returns the mean of the mean depths and that of the crush intensities.
fn means<T: Real + Ordered<Mask = bool>>(observations: &Observations<T>) -> Result<[T; 2], TestIssues<T>> {
    let count = T::from_usize(observations.len()).ok_or(TestIssue::NotConverged { steps: 0 })?;
    let mean = |of: &dyn Fn(usize) -> T| (0..observations.len()).fold(T::int(0), |sum, i| sum + of(i)) / count.clone();
    Ok([mean(&|i| observations.points[i].crush.mean_depth()), mean(&|i| observations.points[i].intensity.clone())])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::{CovarianceBasis, Observation};

    /// A test with d₀ = 60 √N and d₁ = 1000 √N/m, at even depths, where the mean and the profile are one.
    fn flat(depth: f64) -> Observation {
        let crush = ProfileMoments::of(1.5, &[depth, depth]).expect("two depths");
        Observation { crush, intensity: 60.0 + 1000.0 * depth, deviation: 10.0 }
    }

    #[test]
    fn a_fit_is_poor_where_tests_differ_by_more_than_they_are_known_to() {
        let fit = |off: f64| {
            let tests = [flat(0.1), flat(0.2), Observation { intensity: 560.0 + off, ..flat(0.5) }];
            let tests = Observations::independent(&tests).expect("tests");
            StiffnessFit::<f64>::with_force(&tests, 60e3, CrushModel::MeanDepth).expect("a fit")
        };
        // Ten standard deviations, and half of one.
        assert!(fit(100.0).is_poor() && !fit(5.0).is_poor());
        // A table of χ² has 3.841 and 5.991 for one and two degrees of freedom; without one nothing can be poor.
        for (degrees_of_freedom, greatest) in [(1, 3.841), (2, 5.991), (10, 18.307)] {
            let of = |chi_square| StiffnessFit { degrees_of_freedom, chi_square, ..fit(0.0) }.is_poor();
            assert!(of(1.03 * greatest) && !of(0.96 * greatest), "{degrees_of_freedom}");
        }
        // One in a thousand exceeds 10.828 and 29.588; the approximation is 3 % off with one degree of freedom.
        for (degrees_of_freedom, greatest) in [(1, 10.828), (10, 29.588)] {
            let of = |chi_square| StiffnessFit { degrees_of_freedom, chi_square, ..fit(0.0) }.is_contradicted();
            assert!(of(1.05 * greatest) && !of(0.96 * greatest), "{degrees_of_freedom}");
        }
        assert!(!StiffnessFit { degrees_of_freedom: 0, ..fit(100.0) }.is_poor());
        // Residuals that set the scale themselves say nothing about it.
        assert!(!StiffnessFit { basis: CovarianceBasis::Residuals, ..fit(100.0) }.is_poor());
    }

    #[test]
    fn a_force_beyond_the_crush_energies_is_told_with_the_greatest() {
        // E* = 360 √N at 0.3 m: at most 360²/(4 · 0.3) = 108 kN/m.
        let tests = Observations::independent(&[flat(0.3)]).expect("tests");
        let fit = |force| StiffnessFit::<f64>::with_force(&tests, force, CrushModel::MeanDepth);
        assert!(fit(107e3).is_ok());
        for force in [109e3, 5e6] {
            let issues = fit(force).expect_err("too large");
            let [TestIssue::ForceTooLarge { force: of, most }] = issues.as_slice() else { panic!("{issues}") };
            assert!(*of == force && (most - 108e3).abs() < 1e-6, "{issues}");
        }
    }

    #[test]
    fn one_number_is_fitted_so_one_test_leaves_no_degree_of_freedom() {
        for (depths, free) in [(&[0.3][..], 0), (&[0.1, 0.5], 1), (&[0.1, 0.2, 0.5], 2)] {
            let tests = Observations::independent(&depths.iter().map(|depth| flat(*depth)).collect::<Vec<_>>()).expect("tests");
            for model in [CrushModel::MeanDepth, CrushModel::Profile] {
                let fit = StiffnessFit::<f64>::with_force(&tests, 60e3, model).expect("a fit");
                assert_eq!(fit.degrees_of_freedom, free);
                approx::assert_relative_eq!(fit.stiffness.slope, 1000.0, max_relative = 1e-9);
                approx::assert_relative_eq!(fit.stiffness.onset, 60.0, max_relative = 1e-9);
                assert!(!fit.is_poor());
            }
            // At even depths both models are one, with the same derivatives.
            let variance = |model| StiffnessFit::<f64>::with_force(&tests, 60e3, model).expect("a fit").covariance.slope;
            approx::assert_relative_eq!(variance(CrushModel::MeanDepth), variance(CrushModel::Profile), max_relative = 1e-9);
        }
    }
}
