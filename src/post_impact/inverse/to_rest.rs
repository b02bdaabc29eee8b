//! One search of the inverse problem: the residuals of a motion, and the end of the search from one start.

use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector};

use super::uncertainty::{Uncertain, uncertainty};
use super::{CLOSE, REACHED, SAME, SCALES, motion};
use crate::least_squares::{self, FitError, Minimum, NotConverged, ParameterBounds, Residuals};
use crate::post_impact::evidence::{Miss, NoSeparation, RestEvidence, Separation, SlideFit};
use crate::post_impact::issue::NoRest;
use crate::post_impact::path_point::{NearestPlace, Passage};
use crate::post_impact::slide::Slide;
use crate::post_impact::trajectory::Effort;
use crate::post_impact::variation::{COARSE, FINE, Slopes, VARIED};
use crate::vehicle::Motion;

/// Maximum number of integration steps in all searches together, about a second: starts beyond it are not tried.
const WORK: usize = 380_000;
/// Distances, in the scales, at which a twin of a solution is looked for, and the number of solutions for which it is.
const BESIDE: [f64; 4] = [1.0, -1.0, 3.0, -3.0];
const MOST_WITH_TWINS: usize = 3;
/// Maximum number of steps of one search.
const ITERATIONS: usize = 60;
/// Maximum number of steps of one slide, ten times those of an ordinary one: a vehicle that rolls for minutes takes more.
const MOST_STEPS: usize = 5_000;
/// Cost of a step with its derivatives, in steps without.
const COST_OF_DERIVATIVES: usize = 4;
/// Maximum number of the last steps to a minimum, and the length of a step that is none.
const LAST_STEPS: usize = 12;
const NO_STEP: f64 = 1e-9;

/// The pose at rest and the path, computed less given, in standard deviations.
pub(super) struct ToRest<'a> {
    slide: &'a Slide,
    evidence: &'a RestEvidence,
    /// The motion that comes to rest nearest to the pose. A motion that stands still from the beginning is not counted.
    nearest: RefCell<Option<Nearest>>,
    /// The reason why the first motion that does not come to rest does not.
    never: RefCell<Option<NoRest>>,
    /// The remaining number of integration steps, and that at which the present search stops.
    work: Cell<usize>,
    stop: Cell<usize>,
    /// The best end of a search that did not reach the pose.
    unfinished: RefCell<Option<Found>>,
    /// Whether to go on, by the work that is done and the most there may be; without going on no work is left.
    goes_on: &'a dyn Fn(usize, usize) -> bool,
    is_stopped: Cell<bool>,
}

/// A motion, the miss of its slide, and that miss in squares of standard deviations.
#[derive(Clone, Copy)]
struct Nearest {
    motion: Motion,
    miss: Miss,
    sum_of_squares: f64,
}

impl<'a> ToRest<'a> {
    pub(super) fn of(slide: &'a Slide, evidence: &'a RestEvidence, goes_on: &'a dyn Fn(usize, usize) -> bool) -> Self {
        ToRest {
            slide,
            evidence,
            nearest: RefCell::new(None),
            never: RefCell::new(None),
            work: Cell::new(WORK),
            stop: Cell::new(0),
            unfinished: RefCell::new(None),
            goes_on,
            is_stopped: Cell::new(false),
        }
    }

    /// Returns the share of the work that is left.
    pub(super) fn work_left(&self) -> f64 {
        self.work.get() as f64 / WORK as f64
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.is_stopped.get()
    }

    /// Takes the best end of a search that did not reach the pose.
    pub(super) fn take_unfinished(&self) -> Option<Found> {
        self.unfinished.take()
    }

    fn deviations(&self) -> [f64; 3] {
        [self.evidence.position_deviation.x, self.evidence.position_deviation.y, self.evidence.heading_deviation]
    }

    /// Returns what a motion misses: the pose at rest, and each point.
    fn missed(&self, unknowns: &[f64]) -> Result<(Miss, Vec<Passage>), NoRest> {
        let mut effort = Effort::of(MOST_STEPS);
        let rest = self.slide.to_rest_within(&self.evidence.separation, &motion(unknowns), &mut effort);
        self.spend(effort.taken);
        let rest = rest?;
        let passages = self.evidence.points.iter().filter_map(|point| point.passage(self.slide, &rest.path)).collect();
        Ok((Miss::of(&rest.pose, &self.evidence.rest), passages))
    }

    pub(super) fn miss(&self, unknowns: &[f64]) -> Result<Miss, NoRest> {
        Ok(self.missed(unknowns)?.0)
    }

    pub(super) fn residuals(&self, unknowns: &[f64]) -> Result<Vec<f64>, NoRest> {
        let (miss, passages) = self.missed(unknowns)?;
        let Miss { position, heading } = miss;
        let of_rest = [position.x, position.y, heading].into_iter().zip(self.deviations()).map(|(miss, sd)| miss / sd);
        let residuals: Vec<f64> = of_rest.chain(passages.iter().flat_map(Passage::residuals)).collect();
        let sum_of_squares = sum_of_squares(&residuals);
        let mut nearest = self.nearest.borrow_mut();
        let moves = !self.slide.is_at_rest(&motion(unknowns));
        if moves && nearest.is_none_or(|nearest| sum_of_squares < nearest.sum_of_squares) {
            *nearest = Some(Nearest { motion: motion(unknowns), miss, sum_of_squares });
        }
        Ok(residuals)
    }

    fn sum_of_squares(&self, unknowns: &[f64]) -> Result<f64, NoRest> {
        Ok(sum_of_squares(&self.residuals(unknowns)?))
    }

    /// Returns the reason for finding nothing: the miss of the best motion, or, if no motion came to rest, the reason of the first.
    pub(super) fn nothing_found(&self, first: &[f64; 3]) -> NoSeparation {
        if let Some(Nearest { motion, miss, .. }) = *self.nearest.borrow() {
            return NoSeparation::NotConverged { motion, miss };
        }
        // If nothing moved, use the first motion.
        match self.never.take().map_or_else(|| self.miss(first), Err) {
            Ok(miss) => NoSeparation::NotConverged { motion: motion(first), miss },
            Err(why) => NoSeparation::NoRest(why),
        }
    }

    fn spend(&self, steps: usize) {
        let left = self.work.get().saturating_sub(steps);
        let is_stopped = self.is_stopped.get() || !(self.goes_on)(WORK - left, WORK);
        self.is_stopped.set(is_stopped);
        self.work.set(if is_stopped { 0 } else { left });
    }

    /// Returns the derivatives of the residuals by the motion and by the factor of the frictions.
    pub(super) fn slopes(&self, unknowns: &[f64], tolerance: f64) -> Vec<Slopes> {
        let evidence = self.evidence;
        let mut effort = Effort::of(MOST_STEPS);
        let varied = self.slide.varied_rest(&evidence.separation, &motion(unknowns), &evidence.points, tolerance, &mut effort);
        self.spend(COST_OF_DERIVATIVES * effort.taken);
        match varied {
            Ok(varied) => {
                let of_rest = varied.by.into_iter().zip(self.deviations()).map(|(by, sd)| by.map(|slope| slope / sd));
                of_rest.chain(varied.points.into_iter().flatten()).collect()
            }
            Err(_) => alloc::vec![[0.0; VARIED]; 3 + 2 * evidence.points.len()],
        }
    }

    /// Searches from one start with a maximum of work.
    pub(super) fn end_of_search(&self, start: &[f64; 3], work: usize) -> Option<Found> {
        let spans = SCALES.map(|scale| ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, scale });
        self.stop.set(self.work.get().saturating_sub(work));
        match least_squares::minimum(self, start, &spans, ITERATIONS) {
            Ok(Minimum { unknowns, sum_of_squares, iterations, .. }) => Some(Found { unknowns, sum_of_squares, iterations }),
            Err(FitError::NotConverged(NotConverged { unknowns, iterations, step, .. })) => {
                // If its work was used up, the search stopped evaluating the residuals: evaluate them here.
                let sum_of_squares = self.sum_of_squares(&unknowns).ok()?;
                // The pose is reached, if not to the last digits: if hardly anything depends on the motion, these are noise. Points along the path need finer
                // derivatives than a search affords.
                let end = Found { unknowns, sum_of_squares, iterations };
                if !self.evidence.points.is_empty() && step <= CLOSE {
                    Some(end)
                } else if sum_of_squares <= REACHED {
                    Some(self.refined(end))
                } else {
                    self.keep_unfinished(end);
                    None
                }
            }
            Err(FitError::NoStart) => None,
        }
    }

    fn keep_unfinished(&self, end: Found) {
        let mut best = self.unfinished.borrow_mut();
        if best.as_ref().is_none_or(|best| end.sum_of_squares < best.sum_of_squares) {
            *best = Some(end);
        }
    }

    /// Returns starts beside each solution, along the direction that the pose constrains least: there another one may be close, where a fold made two of one.
    pub(super) fn twins(&self, found: &[Found]) -> Vec<[f64; 3]> {
        let beside = |one: &Found| {
            let slopes = self.slopes(&one.unknowns, COARSE);
            let direction = least_squares::weakest(DMatrix::from_fn(slopes.len(), 3, |i, k| slopes[i][k] * SCALES[k])).unwrap_or_default();
            let at = |distance: f64| core::array::from_fn(|k| one.unknowns[k] + distance * direction[k] * SCALES[k]);
            if direction.is_empty() { Vec::new() } else { BESIDE.map(at).to_vec() }
        };
        found.iter().take(MOST_WITH_TWINS).flat_map(beside).collect()
    }

    /// Takes the last steps to a minimum, by Gauss and Newton with fine derivatives, as long as the sum of squares does not grow.
    pub(super) fn refined(&self, found: Found) -> Found {
        self.last_steps(found).0
    }

    /// Returns the minimum that the last steps from a motion lead to; `None` if they do not lead to one.
    pub(super) fn near(&self, known: &Motion) -> Option<Found> {
        let unknowns = known.components().to_vec();
        let sum_of_squares = self.sum_of_squares(&unknowns).ok()?;
        let (found, left) = self.last_steps(Found { unknowns, sum_of_squares, iterations: 0 });
        (left <= SAME).then_some(found)
    }

    /// Returns what the evidence says of the separation to first order about a motion: the next step from it, with the covariance there.
    pub(super) fn about(&self, known: &Motion) -> Option<Separation> {
        let unknowns = known.components();
        let (residuals, slopes) = (self.residuals(&unknowns).ok()?, self.slopes(&unknowns, FINE));
        let found = Found { unknowns: unknowns.to_vec(), sum_of_squares: sum_of_squares(&residuals), iterations: 0 };
        let there = self.separation_by(&found, &slopes).ok()?;
        let step = step(residuals, &slopes)?;
        let next: [f64; 3] = core::array::from_fn(|k| unknowns[k] + step[k]);
        next.iter().all(|number| number.is_finite()).then(|| Separation { motion: motion(&next), ..there })
    }

    /// Takes the last steps, and returns the length of the first that is not taken.
    fn last_steps(&self, mut found: Found) -> (Found, f64) {
        let mut left = f64::INFINITY;
        for _ in 0..LAST_STEPS {
            let Ok(residuals) = self.residuals(&found.unknowns) else { break };
            let Some(step) = step(residuals, &self.slopes(&found.unknowns, FINE)) else { break };
            left = step.iter().zip(SCALES).fold(0.0, |most: f64, (by, scale)| most.max((by / scale).abs()));
            if left <= NO_STEP {
                break;
            }
            let unknowns: Vec<f64> = found.unknowns.iter().zip(step).map(|(at, by)| at + by).collect();
            match self.sum_of_squares(&unknowns) {
                Ok(sum_of_squares) if sum_of_squares <= found.sum_of_squares => found = Found { unknowns, sum_of_squares, ..found },
                _ => break,
            }
        }
        (found, left)
    }

    /// Returns the separation that a search ended in.
    pub(super) fn separation(&self, found: &Found) -> Result<Separation, NoSeparation> {
        self.separation_by(found, &self.slopes(&found.unknowns, FINE))
    }

    /// The same by the slopes there.
    fn separation_by(&self, found: &Found, slopes: &[Slopes]) -> Result<Separation, NoSeparation> {
        let unknowns = &found.unknowns;
        let (miss, passages) = self.missed(unknowns).map_err(NoSeparation::NoRest)?;
        let Uncertain { covariance, by_friction } = uncertainty(slopes, self.evidence)?;
        let points: Vec<NearestPlace> = passages.iter().map(Passage::nearest_place).collect();
        let (degrees_of_freedom, others, iterations) = (points.len(), Vec::new(), found.iterations);
        let fit =
            SlideFit { iterations, starts: 0, converged: 0, miss, points, chi_square: 0.0, degrees_of_freedom, probability: 1.0, others };
        let fit = fit.with_chi_square(found.sum_of_squares);
        Ok(Separation { motion: motion(unknowns), covariance, by_friction, fit: Some(fit) })
    }
}

/// Returns the step of Gauss and Newton by the residuals of a motion and their slopes.
fn step(residuals: Vec<f64>, slopes: &[Slopes]) -> Option<[f64; 3]> {
    let jacobian = DMatrix::from_fn(slopes.len(), 3, |i, k| slopes[i][k] * SCALES[k]);
    let step = least_squares::SingularValues::of(jacobian)?.solve(&DVector::from_vec(residuals), 0.0);
    Some(core::array::from_fn(|k| -step[k] * SCALES[k]))
}

fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

impl Residuals for ToRest<'_> {
    fn at(&self, unknowns: &[f64]) -> Option<Vec<f64>> {
        if self.work.get() <= self.stop.get() {
            return None;
        }
        self.residuals(unknowns)
            .map_err(|why| {
                self.never.borrow_mut().get_or_insert(why);
            })
            .ok()
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        let slopes = self.slopes(unknowns, COARSE);
        DMatrix::from_fn(slopes.len(), 3, |i, k| slopes[i][k])
    }
}

/// The result of a search.
#[derive(Clone)]
pub(super) struct Found {
    pub(super) unknowns: Vec<f64>,
    pub(super) sum_of_squares: f64,
    pub(super) iterations: usize,
}
