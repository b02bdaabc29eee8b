//! The last digits: Gauss–Newton steps of the unknowns that are not on an active bound, and Newton steps if those converge slowly.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::singular_values::SingularValues;
use super::{Bound, CONVERGED, Minimum, NotConverged, ParameterBounds, Residuals, distance};

/// Maximum number of steps. If the residuals are large, the steps only shrink by a factor.
const STEPS: usize = 60;

/// Number of steps after which second derivatives are used.
const SLOW: usize = 6;

/// Share of the largest singular value below which a direction changes no residual.
const NOTHING: f64 = 1e-11;

/// Distance from a bound, in scales, within which an unknown is on it.
const ON_BOUND: f64 = 1e-9;

/// Number of full steps that are taken without comparing sums of squares.
const TRUSTED: usize = 12;

/// Refines a point near a minimum.
pub(super) fn polish(
    of: &impl Residuals,
    start: Vec<f64>,
    spans: &[ParameterBounds],
    before: usize,
    at_most: usize,
) -> Result<Minimum, NotConverged> {
    let mut point = Point::at(of, start, spans);
    if point.residuals.is_empty() {
        let Point { unknowns, toward, .. } = point;
        return Err(NotConverged { unknowns, sum_of_squares: f64::INFINITY, step: f64::INFINITY, iterations: before, toward });
    }
    let taken = match point.sprint(of, spans, TRUSTED.min(at_most)) {
        Some((end, taken)) => {
            point = end;
            taken
        }
        None => point.walk(of, spans, STEPS.min(at_most)),
    };
    let (sum_of_squares, iterations) = (point.residuals.norm_squared(), before + taken);
    let Point { mut unknowns, residuals, asked, toward } = point;
    let jacobian = if asked <= CONVERGED { slopes(of, &unknowns, spans) } else { None };
    let Some(jacobian) = jacobian else { return Err(NotConverged { unknowns, sum_of_squares, step: asked, iterations, toward }) };
    let at: Vec<Option<Bound>> = unknowns.iter_mut().zip(spans).map(|(x, span)| settle(x, span)).collect();
    let is_held = (0..at.len()).map(|i| at[i].is_some_and(|at| presses(&jacobian, &residuals, i, at))).collect();
    Ok(Minimum { unknowns, sum_of_squares, at, is_held, margins: Vec::new(), iterations })
}

/// A point of the iteration.
#[derive(Clone)]
struct Point {
    unknowns: Vec<f64>,
    residuals: DVector<f64>,
    /// The last step that was wanted, in scales.
    asked: f64,
    /// The unknowns after the full wanted step.
    toward: Vec<f64>,
}

impl Point {
    fn at(of: &impl Residuals, mut unknowns: Vec<f64>, spans: &[ParameterBounds]) -> Self {
        for (x, span) in unknowns.iter_mut().zip(spans) {
            settle(x, span);
        }
        let residuals = DVector::from_vec(of.at(&unknowns).unwrap_or_default());
        Point { toward: unknowns.clone(), unknowns, residuals, asked: f64::INFINITY }
    }

    /// Takes full steps, even if the sum of squares grows in between, as it must along a narrow curved valley. Returns `None` if they do not converge or do
    /// not decrease the sum.
    fn sprint(&self, of: &impl Residuals, spans: &[ParameterBounds], at_most: usize) -> Option<(Point, usize)> {
        let mut point = self.clone();
        for taken in 1..=at_most {
            let last = point.asked;
            let wanted = wanted_step(&slopes(of, &point.unknowns, spans)?, None, &point.residuals, &point.unknowns, spans);
            point.unknowns = moved(&point.unknowns, &wanted, spans);
            point.residuals = DVector::from_vec(of.at(&point.unknowns)?);
            point.asked = wanted.amax();
            let is_over = point.asked <= CONVERGED && point.asked >= last / 2.0 || point.asked == 0.0;
            if is_over {
                return (point.residuals.norm_squared() <= limit(self.residuals.norm_squared())).then_some((point, taken));
            }
        }
        None
    }

    /// Takes steps that never increase the sum of squares. Returns the number of steps.
    fn walk(&mut self, of: &impl Residuals, spans: &[ParameterBounds], at_most: usize) -> usize {
        let mut step = f64::INFINITY;
        for taken in 0..at_most {
            let last = step;
            let Some(jacobian) = slopes(of, &self.unknowns, spans) else { return taken };
            let curved =
                || of.residual_hessian(&self.unknowns).map(|residual_hessian| scaled(scaled(residual_hessian, spans).transpose(), spans));
            let sum = self.residuals.norm_squared();
            let (mut asked, mut toward) = (0.0, Vec::new());
            let mut try_with = |residual_hessian: Option<DMatrix<f64>>| {
                let wanted = wanted_step(&jacobian, residual_hessian.as_ref(), &self.residuals, &self.unknowns, spans);
                (asked, toward) = (wanted.amax(), moved(&self.unknowns, &wanted, spans));
                shortened(of, &self.unknowns, &wanted, spans, sum)
            };
            let straight = if taken < SLOW { try_with(None) } else { None };
            // If Gauss–Newton steps lead nowhere, Newton steps may. If these do not either, the walk ends; it has converged if the wanted step is negligible.
            let tried = straight.or_else(|| try_with(curved()));
            (self.asked, self.toward) = (asked, toward);
            let Some(tried) = tried else { return taken };
            step = distance(&self.unknowns, &tried.unknowns, spans.iter().map(|span| span.scale));
            (self.unknowns, self.residuals) = (tried.unknowns, tried.residuals);
            if self.asked <= CONVERGED && step >= last / 2.0 || step == 0.0 {
                return taken + 1;
            }
        }
        at_most
    }
}

/// Returns the largest sum of squares that equals `sum` to rounding.
fn limit(sum: f64) -> f64 {
    sum * (1.0 + 1e-12) + f64::MIN_POSITIVE
}

/// Returns the derivatives of the residuals by the scaled unknowns, or `None` if one of them is undefined.
fn slopes(of: &impl Residuals, unknowns: &[f64], spans: &[ParameterBounds]) -> Option<DMatrix<f64>> {
    let jacobian = scaled(of.jacobian(unknowns), spans);
    jacobian.iter().all(|entry| entry.is_finite()).then_some(jacobian)
}

/// Converts derivatives to those by the scaled unknowns.
pub(crate) fn scaled(mut jacobian: DMatrix<f64>, spans: &[ParameterBounds]) -> DMatrix<f64> {
    for (mut column, span) in jacobian.column_iter_mut().zip(spans) {
        column *= span.scale;
    }
    jacobian
}

/// Returns the step, in scales, to the point of zero gradient, for the unknowns that are not pressed against a bound. An unknown that would cross its bound
/// moves to the bound, and the others take the step that is best given that.
fn wanted_step(
    jacobian: &DMatrix<f64>,
    residual_hessian: Option<&DMatrix<f64>>,
    residuals: &DVector<f64>,
    unknowns: &[f64],
    spans: &[ParameterBounds],
) -> DVector<f64> {
    let slope = jacobian.tr_mul(residuals);
    let mut free: Vec<usize> = (0..unknowns.len()).filter(|&i| !is_pressed(unknowns[i], slope[i], &spans[i])).collect();
    let mut step = DVector::zeros(unknowns.len());
    while !free.is_empty() {
        let by_curvature = residual_hessian.and_then(|residual_hessian| newton(jacobian, residual_hessian, residuals, &step, &free));
        let Some(of_free) = by_curvature.or_else(|| gauss_newton(jacobian, residuals, &step, &free)) else { break };
        let end = |i: usize, value: f64| unknowns[i] - value * spans[i].scale;
        let crosses = |i: usize, value: f64| !(spans[i].min..=spans[i].max).contains(&end(i, value));
        let values: Vec<(usize, f64)> = free.iter().copied().zip(of_free.iter().copied()).collect();
        let any_crosses = values.iter().any(|&(i, value)| crosses(i, value));
        for &(i, value) in values.iter().filter(|&&(i, value)| !any_crosses || crosses(i, value)) {
            step[i] = (end(i, value).clamp(spans[i].min, spans[i].max) - unknowns[i]) / spans[i].scale;
        }
        if !any_crosses {
            break;
        }
        free = values.into_iter().filter(|&(i, value)| !crosses(i, value)).map(|(i, _)| i).collect();
    }
    step
}

/// Returns the Gauss–Newton step of the free unknowns; the others move by `step`.
fn gauss_newton(jacobian: &DMatrix<f64>, residuals: &DVector<f64>, step: &DVector<f64>, free: &[usize]) -> Option<DVector<f64>> {
    let found = SingularValues::of(jacobian.select_columns(free))?;
    Some(found.solve(&(residuals + jacobian * step), found.greatest() * NOTHING))
}

/// Returns the direction that the residuals depend on least, of length 1, or `None` without unknowns.
pub(crate) fn weakest(derivatives: DMatrix<f64>) -> Option<Vec<f64>> {
    if derivatives.is_empty() {
        return None;
    }
    let found = SingularValues::of(derivatives)?;
    Some(found.direction(found.least()))
}

/// Returns the Newton step of the free unknowns, or `None` if the curvature is not positive or almost zero.
fn newton(
    jacobian: &DMatrix<f64>,
    residual_hessian: &DMatrix<f64>,
    residuals: &DVector<f64>,
    step: &DVector<f64>,
    free: &[usize],
) -> Option<DVector<f64>> {
    /// Share of the greatest curvature below which a curvature is rounding.
    const FLAT: f64 = 1e-12;
    let slope = jacobian.tr_mul(&(residuals + jacobian * step)) + residual_hessian * step;
    let curvature = (jacobian.tr_mul(jacobian) + residual_hessian).select_columns(free).select_rows(free);
    if curvature.iter().any(|entry| !entry.is_finite()) {
        return None;
    }
    let size = curvature.diagonal().amax();
    let factor = curvature.cholesky()?;
    let is_flat = factor.l_dirty().diagonal().iter().any(|root| root * root < FLAT * size);
    (!is_flat).then(|| factor.solve(&slope.select_rows(free)))
}

/// Returns `true` if an unknown is on a bound and the sum of squares decreases beyond it.
fn is_pressed(x: f64, slope: f64, span: &ParameterBounds) -> bool {
    (x <= span.min && slope > 0.0) || (x >= span.max && slope < 0.0)
}

/// Returns `true` if the sum of squares would be smaller beyond the bound that an unknown is on, by more than rounding.
fn presses(jacobian: &DMatrix<f64>, residuals: &DVector<f64>, unknown: usize, at: Bound) -> bool {
    /// Rounding of a sum of squares.
    const ROUNDING: f64 = 1e-10;
    let column = jacobian.column(unknown);
    let slope = column.dot(residuals);
    let outward = if at == Bound::Min { slope > 0.0 } else { slope < 0.0 };
    outward && slope * slope > ROUNDING * column.norm_squared()
}

struct Tried {
    unknowns: Vec<f64>,
    residuals: DVector<f64>,
}

/// Returns the step, or the largest half, quarter … of it that does not increase the sum.
fn shortened(of: &impl Residuals, from: &[f64], step: &DVector<f64>, spans: &[ParameterBounds], sum: f64) -> Option<Tried> {
    let mut share = 1.0;
    for _ in 0..12 {
        let unknowns = moved(from, &(step * share), spans);
        if let Some(residuals) = of.at(&unknowns).map(DVector::from_vec)
            && residuals.norm_squared() <= limit(sum)
        {
            return Some(Tried { unknowns, residuals });
        }
        share *= 0.5;
    }
    None
}

fn moved(from: &[f64], step: &DVector<f64>, spans: &[ParameterBounds]) -> Vec<f64> {
    (0..from.len()).map(|i| (from[i] + step[i] * spans[i].scale).clamp(spans[i].min, spans[i].max)).collect()
}

/// Moves an unknown that is almost on a bound onto it.
fn settle(x: &mut f64, span: &ParameterBounds) -> Option<Bound> {
    let near = |bound: f64| (*x - bound).abs() <= ON_BOUND * span.scale;
    let (bound, at) = if near(span.min) {
        (span.min, Bound::Min)
    } else if near(span.max) {
        (span.max, Bound::Max)
    } else {
        return None;
    };
    *x = bound;
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x, whose root full steps from 1.4 leave; halved ones lead to it.
    struct Arctangent {
        bends: core::cell::Cell<usize>,
    }

    impl Residuals for Arctangent {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            Some(alloc::vec![libm::atan(x[0])])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_element(1, 1, 1.0 / (1.0 + x[0] * x[0]))
        }

        fn residual_hessian(&self, _: &[f64]) -> Option<DMatrix<f64>> {
            self.bends.set(self.bends.get() + 1);
            None
        }
    }

    #[test]
    fn second_derivatives_wait_until_steps_are_slow() {
        let of = Arctangent { bends: Default::default() };
        let spans = [ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, scale: 1.0 }];
        let mut point = Point::at(&of, alloc::vec![1.4], &spans);
        assert!(point.sprint(&of, &spans, TRUSTED).is_none());
        let taken = point.walk(&of, &spans, STEPS);
        assert!(taken <= SLOW && point.unknowns[0].abs() < 1e-15 && of.bends.get() == 0, "{taken} {:?} {:?}", point.unknowns, of.bends);
    }

    /// What an unknown that stays on its bound moves is in the residuals of the others: (1, 2) + ½ (1, 0) is (1.5, 2), and the nearest (x, x) is 1.75.
    #[test]
    fn the_free_unknowns_step_from_where_the_others_went() {
        let jacobian = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]);
        let (residuals, step) = (DVector::from_vec(vec![1.0, 2.0]), DVector::from_vec(vec![0.5, 0.0]));
        let found = gauss_newton(&jacobian, &residuals, &step, &[1]).expect("a step");
        assert!((found[0] - 1.75).abs() < 1e-14, "{found}");
    }
}
