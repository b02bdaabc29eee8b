//! The line of weighted least squares through the mean depths, in closed form.

use super::fit::{Residual, StiffnessCovariance};
use super::observation::{Observations, Point};
use super::problem::{Problem, Problems};
use super::weight::{Weight, dot};
use crate::crush::{CrushStiffness, ProfileMoments};
use crate::scalar::{Field, Ordered};
use crate::solve::slack;
use alloc::vec::Vec;

/// Whether a line can be laid through the observations, and what to weigh them with.
pub(super) fn ready<T: Ordered<Mask = bool>>(observations: &Observations<T>) -> Result<Weight<T>, Problems<T>> {
    let count = observations.len();
    let depths: Vec<T> = observations.points.iter().map(|point| point.crush.mean_depth()).collect();
    let [first, others @ ..] = depths.as_slice() else {
        return Err(Problem::TooFew { name: "tests", count, least: 2 }.into());
    };
    if others.is_empty() {
        return Err(Problem::TooFew { name: "tests", count, least: 2 }.into());
    }
    let differs = |depth: &T| {
        let size = first.clone().magnitude() + depth.clone().magnitude();
        (size * slack()).less(&(depth.clone() - first.clone()).magnitude())
    };
    if !others.iter().any(differs) {
        return Err(Problem::OneDepth { depth: first.clone() }.into());
    }
    Weight::of(&observations.covariance, |i| observations.points[i].place)
}

/// The weighted line through the mean depths, and its covariance.
pub(super) fn line<T: Field>(observations: &Observations<T>, weight: &Weight<T>) -> (CrushStiffness<T>, StiffnessCovariance<T>) {
    let points = &observations.points;
    let ones = alloc::vec![T::int(1); points.len()];
    let depths: Vec<T> = points.iter().map(|point| point.crush.mean_depth()).collect();
    let intensities: Vec<T> = points.iter().map(|point| point.intensity.clone()).collect();
    let weighed = weight.times(&ones);
    let sum = dot(&weighed, &ones);
    let (depth, intensity) = (dot(&weighed, &depths) / sum.clone(), dot(&weighed, &intensities) / sum.clone());
    // About the middle of the depths the two coefficients are not correlated, and no digits are lost.
    let about: Vec<T> = depths.iter().map(|each| each.clone() - depth.clone()).collect();
    let weighed = weight.times(&about);
    let spread = dot(&weighed, &about);
    let slope = dot(&weighed, &intensities) / spread.clone();
    let covariance = StiffnessCovariance {
        onset: sum.inv() + depth.clone().squared() / spread.clone(),
        between: -(depth.clone() / spread.clone()),
        slope: spread.inv(),
    };
    (CrushStiffness { onset: intensity - slope.clone() * depth, slope }, covariance)
}

/// What the fit leaves of each test, and χ².
pub(super) fn residuals<T: Field>(
    observations: &Observations<T>,
    weight: &Weight<T>,
    fitted: impl Fn(&ProfileMoments<T>) -> T,
) -> (Vec<Residual<T>>, T) {
    let residual = |(point, row): (&Point<T>, &Vec<T>)| Residual {
        crush: point.crush.clone(),
        observed: point.intensity.clone(),
        fitted: fitted(&point.crush),
        variance: row.last().cloned().unwrap_or_else(|| T::int(0)),
    };
    let residuals: Vec<Residual<T>> = observations.points.iter().zip(&observations.covariance).map(residual).collect();
    let differences: Vec<T> = residuals.iter().map(Residual::difference).collect();
    let chi_square = dot(&weight.times(&differences), &differences);
    (residuals, chi_square)
}
