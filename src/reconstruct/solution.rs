//! What is known of a least sum of squares: the unknowns, how sure they are, what the evidence is off by.

use nalgebra::{Cholesky, DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::determined::{blind, is_moved};
use super::given::Reconstruction;
use super::measurable::Measurable;
use super::residuals::Model;
use super::variable::Variable;
use crate::collision::Collision;
use crate::impact::Impact;
use crate::least_squares::{Bound, Minimum, Span};

/// One unknown, found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// What it is.
    pub of: Variable,
    /// Its value, in SI. Where the evidence does not determine it, one of the values that it may have.
    pub value: f64,
    /// Its standard deviation. None where the evidence does not determine it, where a bound holds it short of what the evidence asks for, and where no piece of evidence has an uncertainty.
    pub sd: Option<f64>,
    /// The bound that it sits on.
    pub at: Option<Bound>,
    /// Whether the evidence, or a bound, determines it.
    pub is_determined: bool,
}

/// One piece of evidence beside what the solution makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// What it is of.
    pub of: Measurable,
    /// What was given, in SI.
    pub given: f64,
    /// What follows from the solution.
    pub computed: f64,
    /// Given less computed; an angle by the shorter way.
    pub residual: f64,
    /// The standard deviation of what was given; none where it was given as exact.
    pub sd: Option<f64>,
}

/// A symmetric matrix over the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Symmetric {
    size: usize,
    entries: Vec<f64>,
}

/// A set of unknowns that the evidence is likeliest with, of all those near it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The unknowns, in the order of the question.
    pub unknowns: Vec<Estimate>,
    /// The evidence, in the order of the question.
    pub evidence: Vec<Fitted>,
    /// The priors, in the order of the unknowns that have one.
    pub priors: Vec<Fitted>,
    /// The covariance of the unknowns that follows from that of the evidence by the influence, in SI; at a fold, where that makes an unknown too sure, by the slopes
    /// alone. Zero for what a bound holds.
    pub covariance: Symmetric,
    /// How the unknowns move per unit of each piece of evidence and then of each prior, in SI: a row for each unknown.
    pub influence: Vec<Vec<f64>>,
    /// The sum of the squares of the residuals, each in standard deviations and freed of correlation: χ².
    pub chi_square: f64,
    /// Pieces of evidence and priors, less what is solved for and held by no bound.
    pub degrees_of_freedom: usize,
    /// The probability that chance makes χ² this large or larger.
    pub probability: f64,
    /// The collision.
    pub collision: Collision,
    /// What the impact does.
    pub impact: Impact,
    /// The share of the crush energy that vehicle 1 has.
    pub crush_share: f64,
    /// Steps that the search took.
    pub iterations: usize,
    /// How many searches ended here.
    pub searches: usize,
}

impl Symmetric {
    fn of(matrix: &DMatrix<f64>) -> Self {
        Symmetric { size: matrix.nrows(), entries: matrix.iter().copied().collect() }
    }

    /// Its number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The entry of two unknowns, by their places in the question.
    ///
    /// # Panics
    ///
    /// When there is no such place.
    pub fn get(&self, one: usize, other: usize) -> f64 {
        assert!(one < self.size && other < self.size, "a matrix of {} unknowns has no entry ({one}, {other})", self.size);
        self.entries[one * self.size + other]
    }

    /// The coefficient of correlation of two unknowns; none where one of them has no variance.
    ///
    /// # Panics
    ///
    /// When there is no such place.
    pub fn correlation(&self, one: usize, other: usize) -> Option<f64> {
        let variances = self.get(one, one) * self.get(other, other);
        (variances > 0.0).then(|| self.get(one, other) / variances.sqrt())
    }
}

impl Fitted {
    /// The residual in standard deviations; none of what was given as exact.
    pub fn standardised_residual(&self) -> Option<f64> {
        Some(self.residual / self.sd?)
    }
}

impl Solution {
    /// The estimate of an unknown.
    pub fn estimate(&self, of: Variable) -> Option<&Estimate> {
        self.unknowns.iter().find(|estimate| estimate.of == of)
    }

    /// Whether chance explains what the evidence is off by.
    pub fn is_explained(&self) -> bool {
        self.probability >= super::Answer::CONTRADICTION
    }

    /// The unknowns whose standard deviation is larger than all that they may be: than the way between their bounds or, where one is missing, than what such
    /// numbers differ by at all. The evidence says as good as nothing of them.
    pub fn hardly_determined(&self, question: &Reconstruction) -> Vec<Variable> {
        let is_vague = |estimate: &&Estimate| {
            let unknown = question.unknowns.iter().find(|unknown| unknown.of == estimate.of);
            let width = unknown.map_or(f64::INFINITY, |unknown| match (unknown.min, unknown.max) {
                (Some(min), Some(max)) => max - min,
                _ => 2.0 * unknown.of.spread(&question.collision, unknown.start),
            });
            estimate.sd.is_some_and(|sd| sd > width)
        };
        self.unknowns.iter().filter(is_vague).map(|estimate| estimate.of).collect()
    }

    /// What is known of a minimum.
    pub(super) fn of(model: &Model<'_>, minimum: &Minimum, spans: &[Span], searches: usize) -> Result<Self, NoUncertainty> {
        let values = &minimum.unknowns;
        let (placed, impact) = model.solve(values).map_err(|_| NoUncertainty)?;
        let computed = model.computed(values).map_err(|_| NoUncertainty)?;
        let residuals = DVector::from_vec(model.residuals(&computed));
        let slopes = Slopes::of(model, minimum, spans);
        let Influences { curved: influence, straight } = slopes.influences(model, minimum, spans, &residuals).ok_or(NoUncertainty)?;
        let errors = model.weights.covariance(model.question, &model.evidence);
        let covariance = larger(&influence * &errors * influence.transpose(), &straight * &errors * straight.transpose());
        let has_errors = errors.iter().any(|entry| *entry != 0.0);
        let moves = |i: usize| slopes.blind.iter().any(|direction| is_moved(direction[i], direction));
        let estimate = |i: usize| {
            let is_determined = !moves(i);
            let has_sd = has_errors && is_determined && !minimum.is_held[i];
            Estimate {
                of: model.question.unknowns[i].of,
                value: values[i],
                sd: has_sd.then(|| covariance[(i, i)].max(0.0).sqrt()),
                at: minimum.at[i],
                is_determined,
            }
        };
        let fitted = |i: usize| Fitted {
            of: model.evidence[i].of,
            given: model.evidence[i].value,
            computed: computed[i],
            residual: residuals[i],
            sd: model.evidence[i].uncertainty.standard_deviation(),
        };
        let pieces = model.question.evidence.len();
        let degrees_of_freedom = model.evidence.len().saturating_sub(slopes.determined.ncols());
        Ok(Solution {
            unknowns: (0..values.len()).map(estimate).collect(),
            evidence: (0..pieces).map(fitted).collect(),
            priors: (pieces..model.evidence.len()).map(fitted).collect(),
            covariance: Symmetric::of(&covariance),
            influence: influence.row_iter().map(|row| row.iter().copied().collect()).collect(),
            chi_square: minimum.sum_of_squares,
            degrees_of_freedom,
            probability: probability(minimum.sum_of_squares, degrees_of_freedom),
            collision: placed.collision,
            impact,
            crush_share: placed.crush_share,
            iterations: minimum.iterations,
            searches,
        })
    }

    /// The directions in which this minimum is no minimum but a valley floor, in the scales of the unknowns.
    pub(super) fn blind(model: &Model<'_>, minimum: &Minimum, spans: &[Span]) -> Vec<Vec<f64>> {
        Slopes::of(model, minimum, spans).blind
    }
}

/// A minimum of which nothing can be said: its curvature is lost in rounding.
#[derive(Debug)]
pub(super) struct NoUncertainty;

/// The probability of a χ² this large or larger. With nothing left over, any that is not nothing is asked as if there were one.
fn probability(chi_square: f64, degrees_of_freedom: usize) -> f64 {
    /// What χ² rounding leaves.
    const ROUNDING: f64 = 1e-9;
    if chi_square <= ROUNDING {
        return 1.0;
    }
    let distribution = ChiSquared::new(degrees_of_freedom.max(1) as f64);
    distribution.map_or(f64::NAN, |distribution| distribution.sf(chi_square))
}

/// The slopes of the evidence at a minimum.
struct Slopes {
    /// The derivatives of the evidence by the unknowns in their scales; zero for those that a bound holds.
    derivatives: DMatrix<f64>,
    /// Directions that no evidence notices, in scales.
    blind: Vec<Vec<f64>>,
    /// An orthonormal basis, column by column, of those that it notices.
    determined: DMatrix<f64>,
}

impl Slopes {
    fn of(model: &Model<'_>, minimum: &Minimum, spans: &[Span]) -> Self {
        let mut derivatives = model.derivatives(&minimum.unknowns);
        let free: Vec<usize> = (0..spans.len()).filter(|&i| !minimum.is_held[i]).collect();
        for (i, mut column) in derivatives.column_iter_mut().enumerate() {
            column *= if minimum.is_held[i] { 0.0 } else { spans[i].scale };
        }
        let size = |evidence: &super::Evidence| evidence.value.abs().max(evidence.of.least_size());
        let sizes: Vec<f64> = model.evidence.iter().map(size).collect();
        let of_free = blind(&derivatives.select_columns(&free), &sizes);
        let spread = |direction: &Vec<f64>| {
            let mut all = vec![0.0; spans.len()];
            free.iter().zip(direction).for_each(|(&i, part)| all[i] = *part);
            all
        };
        let determined = complement(&of_free, &free, spans.len());
        Slopes { blind: of_free.iter().map(spread).collect(), determined, derivatives }
    }

    /// How the unknowns move with the evidence: the point where the slope of ½χ² is zero moves with what moves the slope.
    fn influences(&self, model: &Model<'_>, minimum: &Minimum, spans: &[Span], residuals: &DVector<f64>) -> Option<Influences> {
        if self.determined.ncols() == 0 {
            let none = DMatrix::zeros(spans.len(), model.evidence.len());
            return Some(Influences { curved: none.clone(), straight: none });
        }
        let weighted = self.weighted(model);
        let straight = weighted.transpose() * &self.derivatives;
        let factors = model.weights.inverse_times(residuals);
        let scales = DMatrix::from_diagonal(&DVector::from_iterator(spans.len(), spans.iter().map(|span| span.scale)));
        let bent = &scales * model.curvature(&minimum.unknowns, &factors) * &scales;
        let seen = &self.determined;
        let of = |matrix: DMatrix<f64>| {
            let within = seen.transpose() * matrix * seen;
            let inverse = Some(within).filter(|within| within.iter().all(|entry| entry.is_finite())).and_then(Cholesky::new)?;
            Some(&scales * seen * inverse.solve(&(seen.transpose() * weighted.transpose())))
        };
        match (of(&straight - bent), of(straight)) {
            (Some(curved), Some(straight)) => Some(Influences { curved, straight }),
            (Some(one), None) | (None, Some(one)) => Some(Influences { curved: one.clone(), straight: one }),
            (None, None) => None,
        }
    }

    /// The inverse covariance of the evidence times its derivatives.
    fn weighted(&self, model: &Model<'_>) -> DMatrix<f64> {
        let columns: Vec<DVector<f64>> =
            self.derivatives.column_iter().map(|column| model.weights.inverse_times(&column.into_owned())).collect();
        DMatrix::from_columns(&columns)
    }
}

/// How the unknowns move with the evidence.
struct Influences {
    /// By the slope and the curvature of the evidence: the derivative of the solution.
    curved: DMatrix<f64>,
    /// By the slope alone.
    straight: DMatrix<f64>,
}

/// The covariance by slope and curvature or, where that by the slope alone makes an unknown much less sure, the latter: at a fold the curvature holds an unknown
/// where noise has put it, and the slope knows that it could be elsewhere.
fn larger(curved: DMatrix<f64>, straight: DMatrix<f64>) -> DMatrix<f64> {
    /// How many times as large a standard deviation has to be.
    const MUCH: f64 = 1.5;
    let is_much_less_sure = |i: usize| straight[(i, i)] > MUCH * MUCH * curved[(i, i)];
    if (0..curved.nrows()).any(is_much_less_sure) { straight } else { curved }
}

/// An orthonormal basis of the free unknowns across the blind directions.
fn complement(blind: &[Vec<f64>], free: &[usize], unknowns: usize) -> DMatrix<f64> {
    let n = free.len();
    let columns: Vec<DVector<f64>> = blind.iter().map(|direction| DVector::from_column_slice(direction)).collect();
    let across = if columns.is_empty() {
        DMatrix::identity(n, n)
    } else {
        let along = DMatrix::from_columns(&columns);
        let eigen = (DMatrix::identity(n, n) - &along * along.transpose()).symmetric_eigen();
        let kept: Vec<usize> = (0..n).filter(|&k| eigen.eigenvalues[k] > 0.5).collect();
        eigen.eigenvectors.select_columns(&kept)
    };
    let mut all = DMatrix::zeros(unknowns, across.ncols());
    for (row, &i) in free.iter().enumerate() {
        all.row_mut(i).copy_from(&across.row(row));
    }
    all
}
