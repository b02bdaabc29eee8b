//! The last digits: Gauss–Newton steps of the unknowns that no bound holds, and Newton steps where those are slow.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector, SVD};

use super::{Bound, CONVERGED, Minimum, Residuals, Span, Stopped};

/// The most steps that are taken. Where the residuals are large the steps shrink by a factor only.
const STEPS: usize = 60;

/// After how many of them the second derivatives are worth their price.
const SLOW: usize = 6;

/// Shares of the largest singular value below which a direction moves no residual.
const NOTHING: f64 = 1e-11;

/// How near to a bound, in scales, counts as on it.
const ON_BOUND: f64 = 1e-9;

/// How many full steps are taken on trust.
const TRUSTED: usize = 12;

/// Goes from near a minimum to it.
pub(super) fn polish(of: &impl Residuals, start: Vec<f64>, spans: &[Span], before: usize, at_most: usize) -> Result<Minimum, Stopped> {
    let mut point = Point::at(of, start, spans);
    if point.residuals.is_empty() {
        let Point { unknowns, toward, .. } = point;
        return Err(Stopped { unknowns, sum_of_squares: f64::INFINITY, step: f64::INFINITY, iterations: before, toward });
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
    let Some(jacobian) = jacobian else { return Err(Stopped { unknowns, sum_of_squares, step: asked, iterations, toward }) };
    let at: Vec<Option<Bound>> = unknowns.iter_mut().zip(spans).map(|(x, span)| settle(x, span)).collect();
    let is_held = (0..at.len()).map(|i| at[i].is_some_and(|at| presses(&jacobian, &residuals, i, at))).collect();
    Ok(Minimum { unknowns, sum_of_squares, at, is_held, iterations })
}

/// A point on the way.
#[derive(Clone)]
struct Point {
    unknowns: Vec<f64>,
    residuals: DVector<f64>,
    /// The last step that the residuals asked for, in scales.
    asked: f64,
    /// Where that step leads, if nothing on the way there is better.
    toward: Vec<f64>,
}

impl Point {
    fn at(of: &impl Residuals, mut unknowns: Vec<f64>, spans: &[Span]) -> Self {
        for (x, span) in unknowns.iter_mut().zip(spans) {
            settle(x, span);
        }
        let residuals = DVector::from_vec(of.at(&unknowns).unwrap_or_default());
        Point { toward: unknowns.clone(), unknowns, residuals, asked: f64::INFINITY }
    }

    /// Full steps, even where the sum of squares grows on the way: along a narrow valley that bends it must. None where they lead nowhere, or not below.
    fn sprint(&self, of: &impl Residuals, spans: &[Span], at_most: usize) -> Option<(Point, usize)> {
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

    /// Steps that never make the sum of squares larger. How many there were.
    fn walk(&mut self, of: &impl Residuals, spans: &[Span], at_most: usize) -> usize {
        let mut step = f64::INFINITY;
        for taken in 0..at_most {
            let last = step;
            let Some(jacobian) = slopes(of, &self.unknowns, spans) else { return taken };
            let curved = || of.bend(&self.unknowns).map(|bend| scaled(scaled(bend, spans).transpose(), spans));
            let sum = self.residuals.norm_squared();
            let (mut asked, mut toward) = (0.0, Vec::new());
            let mut try_with = |bend: Option<DMatrix<f64>>| {
                let wanted = wanted_step(&jacobian, bend.as_ref(), &self.residuals, &self.unknowns, spans);
                (asked, toward) = (wanted.amax(), moved(&self.unknowns, &wanted, spans));
                shortened(of, &self.unknowns, &wanted, spans, sum)
            };
            let straight = if taken < SLOW { try_with(None) } else { None };
            // Where straight lines lead nowhere better parabolas may. Where these do not either: the end, if hardly anything was asked for.
            let tried = straight.or_else(|| try_with(curved()));
            (self.asked, self.toward) = (asked, toward);
            let Some(tried) = tried else { return taken };
            step = distance(&self.unknowns, &tried.unknowns, spans);
            (self.unknowns, self.residuals) = (tried.unknowns, tried.residuals);
            if self.asked <= CONVERGED && step >= last / 2.0 || step == 0.0 {
                return taken + 1;
            }
        }
        at_most
    }
}

/// A sum of squares that is no larger but for rounding.
fn limit(sum: f64) -> f64 {
    sum * (1.0 + 1e-12) + f64::MIN_POSITIVE
}

/// The derivatives of the residuals by the unknowns in their scales; none where one of them has none.
fn slopes(of: &impl Residuals, unknowns: &[f64], spans: &[Span]) -> Option<DMatrix<f64>> {
    let jacobian = scaled(of.jacobian(unknowns), spans);
    jacobian.iter().all(|entry| entry.is_finite()).then_some(jacobian)
}

fn scaled(mut jacobian: DMatrix<f64>, spans: &[Span]) -> DMatrix<f64> {
    for (mut column, span) in jacobian.column_iter_mut().zip(spans) {
        column *= span.scale;
    }
    jacobian
}

/// The step to where the slope is zero, in scales, of the unknowns that are not pressed against a bound. One that would cross its bound goes to it, and the others take the
/// step that is best with it there.
fn wanted_step(
    jacobian: &DMatrix<f64>,
    bend: Option<&DMatrix<f64>>,
    residuals: &DVector<f64>,
    unknowns: &[f64],
    spans: &[Span],
) -> DVector<f64> {
    let slope = jacobian.tr_mul(residuals);
    let mut free: Vec<usize> = (0..unknowns.len()).filter(|&i| !is_pressed(unknowns[i], slope[i], &spans[i])).collect();
    let mut step = DVector::zeros(unknowns.len());
    while !free.is_empty() {
        let by_curvature = bend.and_then(|bend| newton(jacobian, bend, residuals, &step, &free));
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

/// The step of some unknowns to where straight lines have the least sum of squares; the others move by `step`.
fn gauss_newton(jacobian: &DMatrix<f64>, residuals: &DVector<f64>, step: &DVector<f64>, free: &[usize]) -> Option<DVector<f64>> {
    /// More rotations than any matrix of this size takes.
    const ROTATIONS: usize = 10_000;
    let svd = SVD::try_new(jacobian.select_columns(free), true, true, f64::EPSILON, ROTATIONS)?;
    let cutoff = svd.singular_values.max() * NOTHING;
    svd.solve(&(residuals + jacobian * step), cutoff).ok()
}

/// The same of parabolas; none where these open downward, or hardly upward.
fn newton(
    jacobian: &DMatrix<f64>,
    bend: &DMatrix<f64>,
    residuals: &DVector<f64>,
    step: &DVector<f64>,
    free: &[usize],
) -> Option<DVector<f64>> {
    /// The share of the greatest curvature below which one is rounding.
    const FLAT: f64 = 1e-12;
    let slope = jacobian.tr_mul(&(residuals + jacobian * step)) + bend * step;
    let curvature = (jacobian.tr_mul(jacobian) + bend).select_columns(free).select_rows(free);
    if curvature.iter().any(|entry| !entry.is_finite()) {
        return None;
    }
    let size = curvature.diagonal().amax();
    let factor = curvature.cholesky()?;
    let is_flat = factor.l_dirty().diagonal().iter().any(|root| root * root < FLAT * size);
    (!is_flat).then(|| factor.solve(&slope.select_rows(free)))
}

/// Whether an unknown is on a bound and the sum of squares falls beyond it.
fn is_pressed(x: f64, slope: f64, span: &Span) -> bool {
    (x <= span.min && slope > 0.0) || (x >= span.max && slope < 0.0)
}

/// Whether the sum of squares would be less beyond the bound that an unknown is on, by more than rounding.
fn presses(jacobian: &DMatrix<f64>, residuals: &DVector<f64>, unknown: usize, at: Bound) -> bool {
    /// What rounding makes of a sum of squares.
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

/// The step, or the largest half, quarter … of it that does not make the sum larger.
fn shortened(of: &impl Residuals, from: &[f64], step: &DVector<f64>, spans: &[Span], sum: f64) -> Option<Tried> {
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

fn moved(from: &[f64], step: &DVector<f64>, spans: &[Span]) -> Vec<f64> {
    (0..from.len()).map(|i| (from[i] + step[i] * spans[i].scale).clamp(spans[i].min, spans[i].max)).collect()
}

fn distance(from: &[f64], to: &[f64], spans: &[Span]) -> f64 {
    (0..from.len()).map(|i| (to[i] - from[i]).abs() / spans[i].scale).fold(0.0, f64::max)
}

/// Puts an unknown that is as good as on a bound on it.
fn settle(x: &mut f64, span: &Span) -> Option<Bound> {
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
