//! Least squares within bounds and along margins: sequential quadratic programs with the Gauss–Newton curvature, and the full one where that converges slowly.
//!
//! A margin is a smooth function that must not be negative, such as the velocity at which two vehicles approach. The residuals are defined beyond it, so that a
//! search may cross it on its way, and its end lies on it to rounding. One quantity can be fixed, which is how a profile likelihood is drawn.

use alloc::vec::Vec;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::quadratic_program::{self, Condition};
use super::{Bound, CONVERGED, Minimum, ParameterBounds, scaled};
use crate::scalar::Field as _;

/// Residuals, margins and the fixed quantity at a point, with their derivatives by the unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Local {
    pub(crate) residuals: DVector<f64>,
    pub(crate) jacobian: DMatrix<f64>,
    /// Functions that must not be negative.
    pub(crate) margins: DVector<f64>,
    pub(crate) margin_slopes: DMatrix<f64>,
    /// The quantity that must be zero, in a row each; at most one.
    pub(crate) fixed: DVector<f64>,
    pub(crate) fixed_slopes: DMatrix<f64>,
}

/// A least-squares problem with margins.
pub(crate) trait Limited {
    /// Returns the problem at a point, or `None` if it is undefined there.
    fn at(&self, unknowns: &[f64]) -> Option<Local>;

    /// Returns the second derivatives of ½χ² beyond those of Gauss and Newton, less those of the margins and the fixed quantity, each times its multiplier.
    fn bend(&self, unknowns: &[f64], margins: &[f64], fixed: &[f64]) -> DMatrix<f64>;
}

/// A minimum within bounds and margins.
#[derive(Clone, Debug)]
pub(crate) struct Reached {
    pub(crate) unknowns: Vec<f64>,
    pub(crate) sum_of_squares: f64,
    /// The bound that each unknown is on, if it presses against it.
    pub(crate) held: Vec<Option<Bound>>,
    /// The derivative of ½χ² by each bound that is pressed against, in scales; positive at a lower one.
    pub(crate) bound_multipliers: Vec<f64>,
    pub(crate) margin_multipliers: Vec<f64>,
    /// The derivative of ½χ² by the value of the fixed quantity; zero without one.
    pub(crate) fixed_multiplier: f64,
    pub(crate) iterations: usize,
}

/// When a search has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Until {
    /// The unknowns are known to rounding.
    Unknowns,
    /// The sum of squares is known to a hundred millionth, which in a flat valley says little about the unknowns.
    Sum,
}

/// Finds the minimum near a start. Otherwise returns the unknowns at which it stopped: where the conditions that contradict each other are missed least, or where
/// the steps do not converge. They are empty if the problem is undefined at the start.
pub(crate) fn minimum(
    of: &impl Limited,
    start: &[f64],
    spans: &[ParameterBounds],
    first_step: f64,
    iterations: usize,
    until: Until,
) -> Result<Reached, Vec<f64>> {
    let Some(mut walk) = Walk::from(of, start, spans, first_step) else { return Err(Vec::new()) };
    for taken in 0..iterations {
        let Some(step) = walk.program(of, taken).and_then(|program| walk.step(&program)) else { break };
        // Where no step improves the fit any more, rounding is all that is left: also of a decrease below zero where the conditions are met.
        let is_stuck = walk.radius < CONVERGED;
        let is_over = step.length <= CONVERGED || until == Until::Sum && (is_stuck || step.decrease <= FLAT);
        let is_met = walk.here.violation() <= if is_stuck { NEARLY_MET } else { MET };
        if is_over && is_met && (until == Until::Sum || walk.is_settled(&step)) {
            return Ok(walk.reached(&step, taken));
        }
        if is_stuck {
            break;
        }
        walk.advance(of, &step);
    }
    Err(walk.unknowns)
}

/// Largest violation of a margin, or of the fixed quantity in its scale, that is rounding. Margins are of order 1.
const MET: f64 = 1e-8;

/// The same where no step comes closer.
const NEARLY_MET: f64 = 1e-6;

/// Largest decrease of ½χ² that is none.
const FLAT: f64 = 1e-8;

/// Number of steps after which the full curvature is used.
const SLOW: usize = 8;

/// First length of a step, in scales, from a start near the minimum.
pub(crate) const SHORT: f64 = 0.5;

/// First length of a step, in scales, from any start.
pub(crate) const LONG: f64 = 5.0;

impl Local {
    fn scaled(self, spans: &[ParameterBounds]) -> Self {
        Local {
            jacobian: scaled(self.jacobian, spans),
            margin_slopes: scaled(self.margin_slopes, spans),
            fixed_slopes: scaled(self.fixed_slopes, spans),
            ..self
        }
    }

    fn is_finite(&self) -> bool {
        let vectors = [&self.residuals, &self.margins, &self.fixed];
        let matrices = [&self.jacobian, &self.margin_slopes, &self.fixed_slopes];
        vectors.iter().all(|vector| vector.iter().all(|x| x.is_finite()))
            && matrices.iter().all(|matrix| matrix.iter().all(|x| x.is_finite()))
    }

    /// Returns by how much the conditions are missed.
    fn violation(&self) -> f64 {
        let missed = |margin: &f64| if *margin < 0.0 { -margin } else { 0.0 };
        self.margins.iter().map(missed).sum::<f64>() + self.fixed.iter().map(|x| x.abs()).sum::<f64>()
    }

    /// Returns ½χ² and the violation times a weight, which has a minimum where the constrained problem has one.
    fn merit(&self, weight: f64) -> f64 {
        0.5 * self.residuals.norm_squared() + weight * self.violation()
    }
}

struct Walk<'a> {
    spans: &'a [ParameterBounds],
    unknowns: Vec<f64>,
    here: Local,
    radius: f64,
    weight: f64,
    /// The multipliers of the last program.
    margins: Vec<f64>,
    fixed: Vec<f64>,
    held: Vec<bool>,
}

/// The curvature of the quadratic program.
struct Program {
    curvature: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
}

/// A step and its multipliers.
struct Step {
    by: DVector<f64>,
    length: f64,
    /// The decrease of ½χ² that the program predicts.
    decrease: f64,
    /// Share of the fixed quantity's distance that it covers.
    share: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    margins: Vec<f64>,
    fixed: Vec<f64>,
}

impl<'a> Walk<'a> {
    fn from(of: &impl Limited, start: &[f64], spans: &'a [ParameterBounds], radius: f64) -> Option<Self> {
        let unknowns: Vec<f64> = start.iter().zip(spans).map(|(x, span)| x.clamp(span.min, span.max)).collect();
        let here = evaluated(of, &unknowns, spans)?;
        let (margins, fixed) = (zeros(here.margins.len()), zeros(here.fixed.len()));
        Some(Walk { spans, unknowns, here, radius, weight: 0.0, margins, fixed, held: vec![false; spans.len()] })
    }

    /// Returns the curvature, of Gauss and Newton at first, with a little added to every direction: an open one stays where it is.
    fn program(&self, of: &impl Limited, taken: usize) -> Option<Program> {
        /// Square root of the curvature that is added: that of an unknown known to 10⁴ scales, or beside evidence that is almost exact a share of its own.
        const STIFFNESS: (f64, f64) = (1e-4, 1e-9);
        let n = self.unknowns.len();
        let jacobian = &self.here.jacobian;
        let stiffness: Vec<f64> = jacobian.column_iter().map(|column| (column.norm() * STIFFNESS.1).max(STIFFNESS.0)).collect();
        let straight = jacobian.tr_mul(jacobian);
        let with = |factor: f64| &straight + DMatrix::from_fn(n, n, |i, k| if i == k { (factor * stiffness[i]).squared() } else { 0.0 });
        if taken >= SLOW {
            let bend = of.bend(&self.unknowns, &self.margins, &self.fixed);
            let bend = scaled(scaled(bend, self.spans).transpose(), self.spans);
            if bend.iter().all(|entry| entry.is_finite()) {
                let bend = bend + self.across_limits(&straight);
                return [1.0, 1e2, 1e3, 1e4, 1e5, 1e6].into_iter().find_map(|factor| {
                    let curvature = with(factor) + &bend;
                    curvature.clone().cholesky().map(|factor| Program { curvature, factor })
                });
            }
        }
        // Orthogonal factors keep what a product of the derivatives loses beside evidence that is almost exact.
        let rows = jacobian.nrows();
        let stacked = DMatrix::from_fn(rows + n, n, |i, k| match i {
            i if i < rows => jacobian[(i, k)],
            i if i - rows == k => stiffness[k],
            _ => 0.0,
        });
        Some(Program { curvature: with(1.0), factor: Cholesky::pack_dirty(stacked.qr().r().transpose()) })
    }

    /// Returns a large curvature across what holds the fit. It changes no step along it, and makes the whole positive where only the curvature along it is.
    fn across_limits(&self, straight: &DMatrix<f64>) -> DMatrix<f64> {
        let mut across = self.here.fixed_slopes.tr_mul(&self.here.fixed_slopes);
        for (row, multiplier) in self.here.margin_slopes.row_iter().zip(&self.margins) {
            if *multiplier > 0.0 {
                across += row.transpose() * row;
            }
        }
        for (i, is_held) in self.held.iter().enumerate() {
            across[(i, i)] += f64::from(*is_held);
        }
        across * (10.0 * straight.diagonal().amax())
    }

    /// Solves the program within the radius. If the fixed quantity cannot be reached within it, the step covers a share of the way; `None` if it cannot come
    /// closer.
    fn step(&self, program: &Program) -> Option<Step> {
        /// Number of times that the share is halved.
        const HALVINGS: i32 = 8;
        (0..=HALVINGS).find_map(|k| self.step_for(program, libm::scalbn(1.0, -k)))
    }

    fn step_for(&self, program: &Program, share: f64) -> Option<Step> {
        if share < 1.0 && self.here.fixed.is_empty() && self.here.margins.iter().all(|margin| *margin >= 0.0) {
            return None;
        }
        let n = self.unknowns.len();
        let mut conditions = Vec::new();
        let unit = |i: usize, sign: f64| DVector::from_fn(n, |k, _| if k == i { sign } else { 0.0 });
        let mut at_least = |normal: DVector<f64>, least: f64| conditions.push(Condition { normal, least, is_equality: false });
        for (i, (x, span)) in self.unknowns.iter().zip(self.spans).enumerate() {
            at_least(unit(i, 1.0), ((span.min - x) / span.scale).max(-self.radius));
            at_least(unit(i, -1.0), ((x - span.max) / span.scale).max(-self.radius));
        }
        for (row, margin) in self.here.margin_slopes.row_iter().zip(self.here.margins.iter()) {
            at_least(row.transpose(), if *margin < 0.0 { -margin * share } else { -margin });
        }
        for (row, fixed) in self.here.fixed_slopes.row_iter().zip(self.here.fixed.iter()) {
            conditions.push(Condition { normal: row.transpose(), least: -fixed * share, is_equality: true });
        }
        let slope = self.here.jacobian.tr_mul(&self.here.residuals);
        let optimum = quadratic_program::minimum(&program.factor, &slope, &conditions)?;
        let by = optimum.x;
        let decrease = -(slope.dot(&by) + 0.5 * by.dot(&(&program.curvature * &by)));
        let (bounds, rest) = optimum.multipliers.split_at(2 * n);
        let (margins, fixed) = rest.split_at(self.here.margins.len());
        Some(Step {
            length: by.amax(),
            by,
            decrease,
            share,
            lower: bounds.iter().step_by(2).copied().collect(),
            upper: bounds.iter().skip(1).step_by(2).copied().collect(),
            margins: margins.to_vec(),
            fixed: fixed.to_vec(),
        })
    }

    /// Takes the step if it improves the fit or meets the conditions better; otherwise shortens the radius.
    fn advance(&mut self, of: &impl Limited, step: &Step) {
        /// Least share of the predicted improvement.
        const ENOUGH: f64 = 1e-4;
        /// Rounding of the merit, as a share.
        const ROUNDING: f64 = 1e-12;
        let largest = step.margins.iter().chain(&step.fixed).fold(0.0_f64, |largest, multiplier| largest.max(multiplier.abs()));
        // An exact penalty exceeds the multipliers; along a valley that is flat only to first order these say nothing.
        self.weight = self.weight.max(2.0 * largest).max(1.0 + self.here.residuals.norm_squared());
        let before = self.here.merit(self.weight);
        let predicted = step.decrease + self.weight * self.here.violation() * step.share;
        let mut there: Vec<f64> = (0..self.unknowns.len())
            .map(|i| (self.unknowns[i] + step.by[i] * self.spans[i].scale).clamp(self.spans[i].min, self.spans[i].max))
            .collect();
        let Some(mut local) = evaluated(of, &there, self.spans) else {
            self.radius = step.length.min(self.radius) / 4.0;
            return;
        };
        if before - local.merit(self.weight) < ENOUGH * predicted
            && let Some((corrected, at)) = self.corrected(of, &there, &local, step)
            && at.merit(self.weight) < local.merit(self.weight)
        {
            (there, local) = (corrected, at);
        }
        let improvement = before - local.merit(self.weight);
        let is_rounding = predicted.abs() <= ROUNDING * before + f64::MIN_POSITIVE && step.length < 1e-3;
        if improvement >= ENOUGH * predicted && predicted >= 0.0 || is_rounding {
            if improvement > 0.75 * predicted && step.length > 0.99 * self.radius {
                self.radius *= 3.0;
            }
            if improvement < 0.25 * predicted && !is_rounding {
                self.radius = (step.length / 2.0).min(self.radius);
            }
            (self.unknowns, self.here) = (there, local);
            (self.margins, self.fixed) = (step.margins.clone(), step.fixed.clone());
            self.held = step.lower.iter().zip(&step.upper).map(|(lower, upper)| lower + upper > 0.0).collect();
        } else {
            self.radius = step.length.min(self.radius) / 4.0;
        }
    }

    /// Returns the point where a step ends, moved back onto the conditions that it meets to first order alone: along a curved one no step of any length would
    /// improve the merit (Maratos 1978).
    fn corrected(&self, of: &impl Limited, there: &[f64], local: &Local, step: &Step) -> Option<(Vec<f64>, Local)> {
        /// Number of corrections, each with the slopes where the step begins.
        const CORRECTIONS: usize = 3;
        let held: Vec<usize> = (0..step.margins.len()).filter(|&k| step.margins[k] > 0.0).collect();
        let (margins, fixed) = (self.here.margin_slopes.select_rows(&held), &self.here.fixed_slopes);
        let rows = held.len() + fixed.nrows();
        let slopes = DMatrix::from_fn(rows, there.len(), |i, k| if i < held.len() { margins[(i, k)] } else { fixed[(i - held.len(), k)] });
        let factor = (&slopes * slopes.transpose()).cholesky()?;
        let mut found: Option<(Vec<f64>, Local)> = None;
        for _ in 0..CORRECTIONS {
            let (from, of_there) = found.as_ref().map_or((there, local), |(unknowns, at)| (&unknowns[..], at));
            let missed =
                DVector::from_fn(rows, |i, _| if i < held.len() { of_there.margins[held[i]] } else { of_there.fixed[i - held.len()] });
            let by = slopes.tr_mul(&factor.solve(&missed));
            let moved = from.iter().zip(by.iter()).zip(self.spans).map(|((x, by), span)| (x - by * span.scale).clamp(span.min, span.max));
            let moved: Vec<f64> = moved.collect();
            let at = evaluated(of, &moved, self.spans)?;
            found = Some((moved, at));
        }
        found
    }

    /// Returns the bound that a step presses against, if it is one of the unknown and not the length of steps.
    fn held(&self, step: &Step, i: usize) -> Option<Bound> {
        /// Distance in scales that is none.
        const AT: f64 = 1e-8;
        let is_at = |bound: f64| (self.unknowns[i] - bound).abs() <= AT * self.spans[i].scale;
        match (step.lower[i] > 0.0, step.upper[i] > 0.0) {
            (true, _) => Some(Bound::Min).filter(|_| is_at(self.spans[i].min)),
            (_, true) => Some(Bound::Max).filter(|_| is_at(self.spans[i].max)),
            _ => None,
        }
    }

    /// Returns `true` unless a step would go on if it were longer: where the fit has a corner, steps get short and lead nowhere.
    fn is_settled(&self, step: &Step) -> bool {
        /// Longest step by the slope of one unknown, in scales, that is rounding.
        const SETTLED: f64 = 1e-6;
        (0..self.unknowns.len()).all(|i| {
            let slope = step.lower[i].max(step.upper[i]);
            let curvature = self.here.jacobian.column(i).norm_squared();
            slope <= SETTLED * curvature || self.held(step, i).is_some()
        })
    }

    fn reached(self, step: &Step, iterations: usize) -> Reached {
        let n = self.unknowns.len();
        let held = |i: usize| self.held(step, i);
        Reached {
            sum_of_squares: self.here.residuals.norm_squared(),
            held: (0..n).map(held).collect(),
            bound_multipliers: (0..n).map(|i| step.lower[i] - step.upper[i]).collect(),
            margin_multipliers: step.margins.clone(),
            fixed_multiplier: step.fixed.first().copied().unwrap_or(0.0),
            iterations,
            unknowns: self.unknowns,
        }
    }
}

impl Reached {
    /// Converts the point to a minimum.
    pub(crate) fn into_minimum(self) -> Minimum {
        /// Least derivative of ½χ² by a margin that it lies on.
        const PRESSES: f64 = 1e-8;
        let margins = (0..self.margin_multipliers.len()).filter(|&k| self.margin_multipliers[k] > PRESSES).collect();
        let is_held = self.held.iter().map(Option::is_some).collect();
        let Reached { unknowns, sum_of_squares, held, iterations, .. } = self;
        Minimum { unknowns, sum_of_squares, at: held, is_held, margins, iterations }
    }
}

fn zeros(count: usize) -> Vec<f64> {
    core::iter::repeat_n(0.0, count).collect()
}

fn evaluated(of: &impl Limited, unknowns: &[f64], spans: &[ParameterBounds]) -> Option<Local> {
    of.at(unknowns).map(|local| local.scaled(spans)).filter(Local::is_finite)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: ParameterBounds = ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, scale: 1.0 };

    /// |x| + 1, which has a corner at its minimum.
    struct Corner;

    impl Limited for Corner {
        fn at(&self, x: &[f64]) -> Option<Local> {
            let none = || DMatrix::zeros(0, 1);
            Some(Local {
                residuals: DVector::from_element(1, x[0].abs() + 1.0),
                jacobian: DMatrix::from_element(1, 1, if x[0] < 0.0 { -1.0 } else { 1.0 }),
                margins: DVector::zeros(0),
                margin_slopes: none(),
                fixed: DVector::zeros(0),
                fixed_slopes: none(),
            })
        }

        fn bend(&self, _: &[f64], _: &[f64], _: &[f64]) -> DMatrix<f64> {
            DMatrix::zeros(1, 1)
        }
    }

    /// Steps get short there, and that they end at no bound.
    #[test]
    fn a_corner_is_no_minimum_and_no_bound() {
        assert!(minimum(&Corner, &[0.7], &[FREE], LONG, 200, Until::Unknowns).is_err());
        let bounded = ParameterBounds { min: 0.5, ..FREE };
        let reached = minimum(&Corner, &[0.7], &[bounded], LONG, 200, Until::Unknowns).expect("a minimum at the bound");
        assert_eq!((reached.unknowns, reached.held), (vec![0.5], vec![Some(Bound::Min)]));
    }

    /// The distance of (x, y) from (3, 2), inside of the unit circle, with x + y fixed if asked for.
    struct Disk(Option<f64>);

    impl Limited for Disk {
        fn at(&self, x: &[f64]) -> Option<Local> {
            let fixed: Vec<f64> = self.0.iter().map(|sum| x[0] + x[1] - sum).collect();
            Some(Local {
                residuals: DVector::from_row_slice(&[x[0] - 3.0, x[1] - 2.0]),
                jacobian: DMatrix::identity(2, 2),
                margins: DVector::from_element(1, 1.0 - x[0] * x[0] - x[1] * x[1]),
                margin_slopes: DMatrix::from_row_slice(1, 2, &[-2.0 * x[0], -2.0 * x[1]]),
                fixed_slopes: DMatrix::from_element(fixed.len(), 2, 1.0),
                fixed: DVector::from_vec(fixed),
            })
        }

        fn bend(&self, _: &[f64], margins: &[f64], _: &[f64]) -> DMatrix<f64> {
            DMatrix::identity(2, 2) * (2.0 * margins[0])
        }
    }

    fn found(disk: &Disk, start: [f64; 2], spans: &[ParameterBounds; 2]) -> Result<Reached, Vec<f64>> {
        minimum(disk, &start, spans, LONG, 60, Until::Unknowns)
    }

    #[test]
    fn the_minimum_lies_on_the_margin_with_its_multiplier() {
        let reached = found(&Disk(None), [0.1, -0.2], &[FREE, FREE]).expect("it converges");
        let length = 13_f64.sqrt();
        assert!((reached.unknowns[0] - 3.0 / length).abs() < 1e-7 && (reached.unknowns[1] - 2.0 / length).abs() < 1e-7, "{reached:?}");
        // Twice the multiplier times the radius is the distance that is left.
        assert!((2.0 * reached.margin_multipliers[0] - (length - 1.0)).abs() < 1e-6, "{reached:?}");
        assert_eq!(reached.into_minimum().margins, [0]);
    }

    #[test]
    fn a_bound_holds_one_unknown_and_the_margin_the_other() {
        for scale in [1.0, 0.2] {
            let spans = [ParameterBounds { max: 0.6, scale, ..FREE }, FREE];
            let reached = found(&Disk(None), [0.0, 0.0], &spans).expect("it converges");
            assert!((reached.unknowns[0] - 0.6).abs() < 1e-12 && (reached.unknowns[1] - 0.8).abs() < 1e-7, "{reached:?}");
            assert_eq!(reached.held, [Some(Bound::Max), None]);
            assert!(reached.bound_multipliers[0] < 0.0 && reached.bound_multipliers[1] == 0.0);
            let minimum = reached.into_minimum();
            assert_eq!((&minimum.is_held[..], &minimum.margins[..]), (&[true, false][..], &[0][..]));
        }
    }

    #[test]
    fn a_fixed_quantity_has_its_value_and_its_slope() {
        let at = |sum: f64| found(&Disk(Some(sum)), [0.0, 0.0], &[FREE, FREE]).expect("it converges");
        let reached = at(0.2);
        // The point of the line next to (3, 2).
        assert!((reached.unknowns[0] - 0.6).abs() < 1e-8 && (reached.unknowns[1] + 0.4).abs() < 1e-8, "{reached:?}");
        let slope = (at(0.2 + 1e-4).sum_of_squares - at(0.2 - 1e-4).sum_of_squares) / 4e-4;
        assert!((reached.fixed_multiplier - slope).abs() < 1e-5, "{reached:?} {slope}");
    }

    /// The distance of x from 1, with y = x² fixed: a step along the parabola leaves it by the square of its length.
    struct Parabola;

    impl Limited for Parabola {
        fn at(&self, x: &[f64]) -> Option<Local> {
            Some(Local {
                residuals: DVector::from_element(1, 0.1 * (x[0] - 1.0)),
                jacobian: DMatrix::from_row_slice(1, 2, &[0.1, 0.0]),
                margins: DVector::zeros(0),
                margin_slopes: DMatrix::zeros(0, 2),
                fixed: DVector::from_element(1, x[1] - x[0] * x[0]),
                fixed_slopes: DMatrix::from_row_slice(1, 2, &[-2.0 * x[0], 1.0]),
            })
        }

        fn bend(&self, _: &[f64], _: &[f64], fixed: &[f64]) -> DMatrix<f64> {
            DMatrix::from_row_slice(2, 2, &[2.0 * fixed[0], 0.0, 0.0, 0.0])
        }
    }

    #[test]
    fn a_curved_condition_is_followed() {
        let reached = minimum(&Parabola, &[-0.5, 0.25], &[FREE, FREE], SHORT, 60, Until::Unknowns).expect("it converges");
        assert!((reached.unknowns[0] - 1.0).abs() < 1e-6 && (reached.unknowns[1] - 1.0).abs() < 1e-6, "{reached:?}");
        assert!(reached.iterations < 30, "{reached:?}");
    }

    #[test]
    fn what_cannot_be_had_is_no_minimum() {
        // In the disk the sum is at most √2.
        let stopped = found(&Disk(Some(2.0)), [0.0, 0.0], &[FREE, FREE]).expect_err("it cannot");
        assert!(stopped.iter().all(|x| (0.6..1.1).contains(x)), "where the conditions are missed least: {stopped:?}");
        assert_eq!(found(&Disk(Some(f64::NAN)), [0.0, 0.0], &[FREE, FREE]).expect_err("undefined"), Vec::<f64>::new());
    }

    /// Defined below 1 alone, with its least value at 3/4.
    struct Root;

    impl Limited for Root {
        fn at(&self, x: &[f64]) -> Option<Local> {
            let root = (1.0 - x[0]).sqrt();
            (x[0] < 1.0).then(|| Local {
                residuals: DVector::from_element(1, root - 0.5),
                jacobian: DMatrix::from_element(1, 1, -0.5 / root),
                margins: DVector::zeros(0),
                margin_slopes: DMatrix::zeros(0, 1),
                fixed: DVector::zeros(0),
                fixed_slopes: DMatrix::zeros(0, 1),
            })
        }

        fn bend(&self, _: &[f64], _: &[f64], _: &[f64]) -> DMatrix<f64> {
            DMatrix::zeros(1, 1)
        }
    }

    #[test]
    fn steps_beyond_what_is_defined_are_shortened() {
        for start in [-8.0, -3.0, 0.0, 0.99] {
            let reached = minimum(&Root, &[start], &[FREE], LONG, 60, Until::Unknowns).expect("it converges");
            assert!((reached.unknowns[0] - 0.75).abs() < 1e-6, "{start}: {reached:?}");
        }
    }
}
