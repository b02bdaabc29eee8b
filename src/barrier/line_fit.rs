//! Weighted least-squares line through the mean depths, in closed form.

use super::fitted::{Residual, StiffnessCovariance};
use super::issue::{TestIssue, TestIssues};
use super::observation::{Observations, Point};
use super::weight::{Weight, dot};
use crate::crush::{CrushStiffness, ProfileMoments};
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, slack};
use alloc::vec::Vec;

/// Checks that a line can be fitted to the observations, and returns their weight.
pub(super) fn ready<T: Ordered<Mask = bool>>(observations: &Observations<T>) -> Result<Weight<T>, TestIssues<T>> {
    let count = observations.len();
    let depths: Vec<T> = observations.points.iter().map(|point| point.crush.mean_depth()).collect();
    let [first, others @ ..] = depths.as_slice() else {
        return Err(InputIssue::too_few(Place::plain("tests"), count, 2).into());
    };
    if others.is_empty() {
        return Err(InputIssue::too_few(Place::plain("tests"), count, 2).into());
    }
    let differs = |depth: &T| {
        let size = first.clone().magnitude() + depth.clone().magnitude();
        (size * slack()).less(&(depth.clone() - first.clone()).magnitude())
    };
    if !others.iter().any(differs) {
        return Err(TestIssue::OneDepth { depth: first.clone() }.into());
    }
    Weight::of(&observations.covariance, |i| observations.points[i].place)
}

/// Checks that a slope can be fitted to the observations, and returns their weight.
pub(super) fn ready_for_slope<T: Ordered<Mask = bool>>(observations: &Observations<T>) -> Result<Weight<T>, TestIssues<T>> {
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    issues.at_least(Place::plain("tests"), observations.len(), 1);
    for point in &observations.points {
        issues.positive(point.place.named("mean depth", Measure::Length), &point.crush.mean_depth());
    }
    issues.finish()?;
    Weight::of(&observations.covariance, |i| observations.points[i].place)
}

/// Fits the weighted line through the mean depths, and computes its covariance.
pub(super) fn line<T: Field>(observations: &Observations<T>, weight: &Weight<T>) -> (CrushStiffness<T>, StiffnessCovariance<T>) {
    let points = &observations.points;
    let ones = alloc::vec![T::int(1); points.len()];
    let depths: Vec<T> = points.iter().map(|point| point.crush.mean_depth()).collect();
    let intensities: Vec<T> = points.iter().map(|point| point.intensity.clone()).collect();
    let weighed = weight.times(&ones);
    let sum = dot(&weighed, &ones);
    let (depth, intensity) = (dot(&weighed, &depths) / sum.clone(), dot(&weighed, &intensities) / sum.clone());
    // About the mean of the depths the two coefficients are uncorrelated, and no digits are lost.
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

/// Fits the slope of the weighted line through the mean depths whose onset is held, and computes its variance.
pub(super) fn slope<T: Field>(observations: &Observations<T>, weight: &Weight<T>, onset: &T) -> (T, T) {
    let points = &observations.points;
    let depths: Vec<T> = points.iter().map(|point| point.crush.mean_depth()).collect();
    let above: Vec<T> = points.iter().map(|point| point.intensity.clone() - onset.clone()).collect();
    let weighed = weight.times(&depths);
    let information = dot(&weighed, &depths);
    (dot(&weighed, &above) / information.clone(), information.inv())
}

/// Computes the residual of each test, and χ².
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
