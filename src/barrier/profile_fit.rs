//! Fit to each measured profile itself. E* = √q with q = 2 E_C/w = d₀² + 2 d₀ d₁ C̄ + d₁² C̄², where C̄ and C̄² are the means over the width: not linear in
//! d₀ and d₁, but convex in them and nearly linear.

use super::fitted::StiffnessCovariance;
use super::issue::{TestIssue, TestIssues};
use super::observation::Observations;
use super::test::mean_square_depth;
use super::weight::{Weight, dot};
use crate::crush::{CrushStiffness, ProfileMoments};
use crate::scalar::{Field, Ordered, Real, is_positive, slack};
use alloc::vec::Vec;

/// Maximum number of Newton steps. A handful is enough, or the iteration never converges.
const STEPS: usize = 60;
/// Steps after the value has converged to rounding: each step doubles the order up to which derivatives are correct, and the start may have the value by
/// chance.
const STEPS_OF_DERIVATIVES: usize = 1;

/// Returns E* of a profile.
pub(super) fn intensity<T: Real>(stiffness: &CrushStiffness<T>, crush: &ProfileMoments<T>) -> T {
    (stiffness.crush_energy(crush.clone()) / crush.first.clone()).square_root()
}

/// A symmetric 2×2 matrix.
struct Symmetric<T> {
    first: T,
    between: T,
    second: T,
}

impl<T: Field> Symmetric<T> {
    fn determinant(&self) -> T {
        self.first.clone() * self.second.clone() - self.between.clone().squared()
    }

    /// Returns `true` if the determinant is more than the rounding of its two products.
    fn is_definite(&self) -> bool
    where
        T: Ordered<Mask = bool>,
    {
        (self.first.clone() * self.second.clone() * slack()).less(&self.determinant())
    }

    /// Returns the covariance of the coefficients whose information this is.
    fn covariance(&self, free: Free) -> StiffnessCovariance<T> {
        if free == Free::Slope {
            return StiffnessCovariance { onset: T::int(0), between: T::int(0), slope: self.second.clone().inv() };
        }
        let determinant = self.determinant();
        let share = |entry: &T| entry.clone() / determinant.clone();
        StiffnessCovariance { onset: share(&self.second), between: -share(&self.between), slope: share(&self.first) }
    }

    fn solve(&self, first: T, second: T) -> CrushStiffness<T> {
        let determinant = self.determinant();
        CrushStiffness {
            onset: (self.second.clone() * first.clone() - self.between.clone() * second.clone()) / determinant.clone(),
            slope: (self.first.clone() * second - self.between.clone() * first) / determinant,
        }
    }
}

/// The coefficients that a fit may change.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Free {
    Both,
    Slope,
}

/// Computes the best fit near a start, and its covariance.
pub(super) fn settle<T: Real + Ordered<Mask = bool>>(
    observations: &Observations<T>,
    weight: &Weight<T>,
    start: CrushStiffness<T>,
    free: Free,
) -> Result<(CrushStiffness<T>, StiffnessCovariance<T>), TestIssues<T>> {
    let mut stiffness = start;
    let mut settled_for = 0;
    let depth = observations.points.iter().fold(T::int(0), |sum, point| sum + point.crush.mean_depth().magnitude());
    for steps in 0..STEPS {
        let local = Local::at(observations, weight, &stiffness).ok_or(TestIssue::NotConverged { steps })?;
        if settled_for > STEPS_OF_DERIVATIVES {
            if free == Free::Both && !local.information.is_definite() {
                return Err(TestIssue::Undetermined.into());
            }
            return Ok((stiffness, local.information.covariance(free)));
        }
        let step = local.step(free);
        let size = |s: &CrushStiffness<T>| s.onset.clone().magnitude() + (s.slope.clone() * depth.clone()).magnitude();
        let small = !(size(&stiffness) * slack()).less(&size(&step));
        settled_for = if small { settled_for + 1 } else { 0 };
        stiffness = CrushStiffness { onset: stiffness.onset + step.onset, slope: stiffness.slope + step.slope };
    }
    Err(TestIssue::NotConverged { steps: STEPS }.into())
}

/// Sum of squares near a stiffness: its slope, its curvature, and the curvature without the residuals, which is the Fisher information of the tests.
struct Local<T> {
    downhill: (T, T),
    information: Symmetric<T>,
    curvature: Symmetric<T>,
}

impl<T: Real + Ordered<Mask = bool>> Local<T> {
    /// Returns `None` if E* is zero for a test, where it has no derivative.
    fn at(observations: &Observations<T>, weight: &Weight<T>, stiffness: &CrushStiffness<T>) -> Option<Self> {
        let CrushStiffness { onset, slope } = stiffness;
        let (mut by_onset, mut by_slope, mut residuals) = (Vec::new(), Vec::new(), Vec::new());
        for point in &observations.points {
            let (mean, mean_square) = (point.crush.mean_depth(), mean_square_depth(&point.crush));
            let fitted = intensity(stiffness, &point.crush);
            if !is_positive(&fitted) {
                return None;
            }
            by_onset.push((onset.clone() + slope.clone() * mean.clone()) / fitted.clone());
            by_slope.push((onset.clone() * mean + slope.clone() * mean_square) / fitted.clone());
            residuals.push(point.intensity.clone() - fitted);
        }
        let (weighed_onset, weighed_slope) = (weight.times(&by_onset), weight.times(&by_slope));
        let information = Symmetric {
            first: dot(&weighed_onset, &by_onset),
            between: dot(&weighed_onset, &by_slope),
            second: dot(&weighed_slope, &by_slope),
        };
        let (mut first, mut between, mut second) = (information.first.clone(), information.between.clone(), information.second.clone());
        let weighed = weight.times(&residuals);
        for (i, point) in observations.points.iter().enumerate() {
            let (mean, mean_square) = (point.crush.mean_depth(), mean_square_depth(&point.crush));
            // Second derivatives of √q: those of q/2 less the product of the first derivatives, over √q.
            let pull = weighed[i].clone() / (point.intensity.clone() - residuals[i].clone());
            let (a, b) = (by_onset[i].clone(), by_slope[i].clone());
            first = first - pull.clone() * (T::int(1) - a.clone().squared());
            between = between - pull.clone() * (mean - a * b.clone());
            second = second - pull * (mean_square - b.squared());
        }
        let downhill = (dot(&weighed, &by_onset), dot(&weighed, &by_slope));
        Some(Local { downhill, information, curvature: Symmetric { first, between, second } })
    }

    /// Returns the Newton step, or the Gauss–Newton step if the sum of squares is not convex there.
    fn step(&self, free: Free) -> CrushStiffness<T> {
        if free == Free::Slope {
            let second = if is_positive(&self.curvature.second) { &self.curvature.second } else { &self.information.second };
            return CrushStiffness { onset: T::int(0), slope: self.downhill.1.clone() / second.clone() };
        }
        let upwards = is_positive(&self.curvature.first) && is_positive(&self.curvature.determinant());
        let matrix = if upwards { &self.curvature } else { &self.information };
        matrix.solve(self.downhill.0.clone(), self.downhill.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Observation;
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn slope_and_curvature_are_those_of_the_sum_of_squares() {
        let observe = |depths: [f64; 3], intensity| {
            let crush = ProfileMoments::of(1.5, &depths).expect("three depths");
            Observation { crush, intensity, deviation: 0.5 }
        };
        let observations = [observe([0.1, 0.3, 0.0], 4.0), observe([0.5, 0.2, 0.4], 3.0), observe([0.9, 0.1, 0.8], 9.0)];
        let observations = Observations::independent(&observations).expect("good numbers");
        let weight = Weight::of(&observations.covariance, |i| observations.points[i].place).expect("positive");
        let at = |onset, slope| Local::at(&observations, &weight, &CrushStiffness { onset, slope }).expect("some energy");
        let half_chi_square = |onset: f64, slope: f64| {
            let stiffness = CrushStiffness { onset, slope };
            observations.points.iter().map(|p| 2.0 * (p.intensity - intensity(&stiffness, &p.crush)).powi(2)).sum::<f64>()
        };
        let (onset, slope, h) = (2.0, 7.0, 1e-5);
        let local = at(onset, slope);
        let quotient = |ahead: f64, behind: f64| (ahead - behind) / (2.0 * h);
        let by_onset = quotient(half_chi_square(onset + h, slope), half_chi_square(onset - h, slope));
        let by_slope = quotient(half_chi_square(onset, slope + h), half_chi_square(onset, slope - h));
        assert_relative_eq!(local.downhill.0, -by_onset, max_relative = 1e-7);
        assert_relative_eq!(local.downhill.1, -by_slope, max_relative = 1e-7);
        let (more, less) = (at(onset + h, slope).downhill, at(onset - h, slope).downhill);
        assert_relative_eq!(local.curvature.first, -quotient(more.0, less.0), max_relative = 1e-7);
        assert_relative_eq!(local.curvature.between, -quotient(more.1, less.1), max_relative = 1e-7);
        let (more, less) = (at(onset, slope + h).downhill, at(onset, slope - h).downhill);
        assert_relative_eq!(local.curvature.second, -quotient(more.1, less.1), max_relative = 1e-7);
    }

    #[test]
    fn where_a_test_has_no_energy_no_step_is_taken() {
        let observe = |depth| Observation {
            crush: ProfileMoments::of(1.5, &[depth, depth]).expect("two depths"),
            intensity: 1.0 + depth,
            deviation: 0.5,
        };
        let observations = Observations::independent(&[observe(0.0), observe(1.0)]).expect("good numbers");
        let weight = Weight::of(&observations.covariance, |i| observations.points[i].place).expect("positive");
        let end = settle(&observations, &weight, CrushStiffness { onset: 0.0, slope: 1.0 }, Free::Both);
        assert_eq!(end.map(|_| ()), Err(TestIssue::NotConverged { steps: 0 }.into()));
    }
}
