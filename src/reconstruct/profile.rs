//! The likelihood around the solutions, whose profile is the best fit of everything else while one quantity is held.

use nalgebra::DMatrix;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::given::Unknown;
use super::measurand::Measurand;
use super::piece::Piece;
use super::residuals::Model;
use super::solution::Solution;
use super::verdict::Answer;
use super::within_limits::{Fixed, WithinLimits};
use crate::least_squares::limited::{self, Until};
use crate::least_squares::{ParameterBounds, Residuals};

/// Largest distance in scales of an unknown without a bound: farther out rounding changes the evidence.
const FARTHEST: f64 = 1e8;

/// Largest number of solutions from which ends are followed, the best first.
const SOLUTIONS: usize = 8;

/// How the centers of mass lie along the normal of the contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lying {
    /// As at the start of a search.
    AsItIs,
    /// The other way round: the vehicles close with the opposite velocity along n.
    TheOtherWay,
}

/// The likelihood around the solutions.
pub(super) struct Profile<'a> {
    pub(super) model: &'a Model<'a>,
    pub(super) spans: Vec<ParameterBounds>,
    /// The unknowns of each solution whose χ² is within the limit, the best first.
    pub(super) solutions: Vec<Vec<f64>>,
    /// The covariance of the unknowns at the best solution; `None` if one of them has no standard deviation.
    covariance: Option<DMatrix<f64>>,
    /// The largest χ² within the interval.
    pub(super) greatest: f64,
    /// Its excess over the least.
    pub(super) quantile: f64,
}

impl<'a> Profile<'a> {
    /// Creates the profile around the solutions of an answer, at a level of confidence.
    pub(super) fn of(model: &'a Model<'a>, spans: Vec<ParameterBounds>, answer: &Answer, level: f64) -> Option<Self> {
        let quantile = ChiSquared::new(1.0).ok()?.inverse_cdf(level);
        let greatest = answer.best().chi_square + quantile;
        let all = answer.solutions.iter().chain(&answer.worse).filter(|solution| solution.chi_square <= greatest);
        // Where a measurand has no slope, such as the direction of a velocity near zero, searches end in many places close to each other.
        let solutions = all.take(SOLUTIONS).map(Solution::values).collect();
        Some(Profile { model, spans, solutions, covariance: covariance(answer.best()), greatest, quantile })
    }

    /// Returns a point near a start that is within the limit, in a piece of the mechanics, with a quantity near a value: the best fit, or where a search for it
    /// stopped. The vehicles lie as they do at the start, or the other way round along the normal.
    pub(super) fn fit_within(&self, piece: Piece, side: Lying, fixed: Option<Fixed>, start: &[f64]) -> Option<Vec<f64>> {
        const ITERATIONS: usize = 40;
        let mut about = [Some(start), self.solutions.first().map(Vec::as_slice)].into_iter().flatten();
        let (about, (placed, impact)) = about.find_map(|point| Some((point, self.model.solve(point).ok()?)))?;
        let mut problem = WithinLimits::around(self.model, about, &placed, &impact);
        problem.keep_to(piece);
        if side == Lying::TheOtherWay {
            problem.turn_round();
        }
        problem.hold(fixed);
        let spans = self.released(fixed.map(|fixed| fixed.of));
        let unknowns = match limited::minimum(&problem, start, &spans, limited::LONG, ITERATIONS, Until::Sum) {
            Ok(reached) => self.bounded(reached.unknowns),
            Err(stopped) if !stopped.is_empty() => self.bounded(stopped),
            Err(_) => return None,
        };
        self.allows(&unknowns).then_some(unknowns)
    }

    /// Returns the piece of the mechanics that a point lies in.
    pub(super) fn piece(&self, unknowns: &[f64]) -> Piece {
        Piece::of(&self.model.place(unknowns))
    }

    /// Returns `true` if χ² at a point that the mechanics accepts is within its limit.
    pub(super) fn allows(&self, unknowns: &[f64]) -> bool {
        let residuals = self.model.at(unknowns);
        residuals.is_some_and(|residuals| residuals.iter().map(|residual| residual * residual).sum::<f64>() <= self.greatest)
    }

    /// Returns the spans without the bounds of a quantity whose value is held, and with an end where the others have none.
    pub(super) fn released(&self, of: Option<Measurand>) -> Vec<ParameterBounds> {
        let unknowns = &self.model.question.unknowns;
        let span = |(span, unknown): (&ParameterBounds, &Unknown)| {
            if Some(Measurand::Variable(unknown.of)) == of {
                return ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, ..*span };
            }
            let reach = FARTHEST * span.scale;
            let end = |bound: f64, reach: f64| if bound.is_finite() { bound } else { unknown.start + reach };
            ParameterBounds { min: end(span.min, -reach), max: end(span.max, reach), ..*span }
        };
        self.spans.iter().zip(unknowns).map(span).collect()
    }

    /// Returns a point whose quantity, held at a bound, has not left it by rounding.
    pub(super) fn bounded(&self, mut unknowns: Vec<f64>) -> Vec<f64> {
        unknowns.iter_mut().zip(&self.spans).for_each(|(x, span)| *x = x.clamp(span.min, span.max));
        unknowns
    }

    /// Returns the standard deviation of a quantity at the best solution, to first order.
    pub(super) fn sd(&self, of: Measurand) -> Option<f64> {
        /// Largest relative error of a variance, in roundings: the slopes and the covariance have some of their own.
        const ROUNDINGS: f64 = 64.0;
        let point = self.solutions.first()?;
        let (placed, impact) = self.model.solve(point).ok()?;
        let (_, slope) = WithinLimits::around(self.model, point, &placed, &impact).slopes_of(of, point)?;
        let covariance = self.covariance.as_ref()?;
        let variance = (&slope * covariance * slope.transpose())[(0, 0)];
        // Of a quantity that the evidence fixes only rounding remains, of either sign.
        let rounding = ROUNDINGS * f64::EPSILON * (slope.abs() * covariance.abs() * slope.abs().transpose())[(0, 0)];
        Some(if variance > rounding { variance.sqrt() } else { 0.0 })
    }

    /// Returns the value of a quantity at a point that the mechanics accepts.
    pub(super) fn value(&self, of: Measurand, unknowns: &[f64]) -> Option<f64> {
        let (placed, impact) = self.model.solve(unknowns).ok()?;
        self.model.value(of, unknowns, &placed, &impact)
    }
}

fn covariance(solution: &Solution) -> Option<DMatrix<f64>> {
    let n = solution.unknowns.len();
    let has_all = solution.unknowns.iter().all(|estimate| estimate.sd.is_some());
    has_all.then(|| DMatrix::from_fn(n, n, |i, k| solution.covariance.get(i, k)))
}
