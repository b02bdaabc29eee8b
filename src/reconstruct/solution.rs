//! A least-squares solution: the unknowns, their uncertainty, the residuals of the evidence.

use nalgebra::{Cholesky, DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::determined::{blind, is_moved};
use super::fold::{contradicts, is_open};
use super::given::{Evidence, ReconstructionProblem, Uncertainty};
use super::limit::Limit;
use super::measurand::Measurand;
use super::residuals::Model;
use super::variable::Variable;
use super::within_limits::WithinLimits;
use crate::collision::Collision;
use crate::impact::Impact;
use crate::least_squares::{self, Bound, Minimum, ParameterBounds};

/// The probability below which the evidence is inconsistent.
pub(super) const CONTRADICTION: f64 = 1e-3;

/// The estimate of one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The variable.
    pub of: Variable,
    /// Its value, in SI. If the evidence does not determine it, this is one of its possible values.
    pub value: f64,
    /// Its standard deviation. `None` if the evidence does not determine it, or only by its curvature, at a fold; if an active bound or a limit of the physics
    /// holds it, or another unknown without which it is much less certain; or if no piece of evidence has an uncertainty.
    pub sd: Option<f64>,
    /// The bound that it sits on.
    pub at: Option<Bound>,
    /// `true` if the evidence, or a bound, determines it.
    pub is_determined: bool,
}

/// One piece of evidence and its computed value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The measurand.
    pub of: Measurand,
    /// The given value, in SI.
    pub given: f64,
    /// The value computed from the solution.
    pub computed: f64,
    /// Given less computed; for an angle the shorter way. Of a separation from rest (`separation_from_rest` of the problem) what the ways differ by, and of a crush energy
    /// from depths (`crush_energy_from_depths`) what these differ by, as a change of the given value to first order.
    pub residual: f64,
    /// The given standard deviation; `None` if it was given as exact.
    pub sd: Option<f64>,
}

/// A symmetric matrix over the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Symmetric {
    size: usize,
    entries: Vec<f64>,
}

/// A set of unknowns that maximizes the likelihood locally.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The unknowns, in the order of the problem.
    pub unknowns: Vec<Estimate>,
    /// The evidence, in the order of the problem.
    pub evidence: Vec<Fitted>,
    /// The priors, in the order of the unknowns that have one.
    pub priors: Vec<Fitted>,
    /// The covariance of the unknowns, from that of the evidence by the influence, in SI. At a fold, where the influence underestimates an uncertainty, it
    /// follows from the slopes alone. Zero for an unknown on an active bound.
    pub covariance: Symmetric,
    /// Derivatives of the unknowns by each piece of evidence and then by each prior, in SI: a row for each unknown.
    pub influence: Vec<Vec<f64>>,
    /// The sum of the squares of the residuals, in standard deviations and decorrelated: χ².
    pub chi_square: f64,
    /// Number of pieces of evidence and priors, less the number of directions of the unknowns that they determine.
    pub degrees_of_freedom: usize,
    /// The probability of a χ² this large or larger by chance.
    pub probability: f64,
    /// The collision.
    pub collision: Collision,
    /// The impact.
    pub impact: Impact,
    /// The share of vehicle 1 in the crush energy.
    pub crush_share: f64,
    /// The limits of the physics that it lies on: beyond them the evidence would agree better, but the mechanics refuses the collision.
    pub limits: Vec<Limit>,
    /// The unknowns at a fold: the evidence has an extremum along them and no slope. Its curvature determines them, which gives them an interval and no standard
    /// deviation.
    pub at_fold: Vec<Variable>,
    /// Number of steps of the search.
    pub iterations: usize,
    /// Number of searches that ended here.
    pub searches: usize,
}

impl Symmetric {
    fn of(matrix: &DMatrix<f64>) -> Self {
        Symmetric { size: matrix.nrows(), entries: matrix.iter().copied().collect() }
    }

    /// Returns the number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Returns the entry of two unknowns, by their indices in the problem.
    ///
    /// # Panics
    ///
    /// If an index is out of range.
    pub fn get(&self, one: usize, other: usize) -> f64 {
        assert!(one < self.size && other < self.size, "a matrix of {} unknowns has no entry ({one}, {other})", self.size);
        self.entries[one * self.size + other]
    }

    /// Returns the coefficient of correlation of two unknowns, or `None` if one of them has no variance.
    ///
    /// # Panics
    ///
    /// If an index is out of range.
    pub fn correlation(&self, one: usize, other: usize) -> Option<f64> {
        let variances = self.get(one, one) * self.get(other, other);
        (variances > 0.0).then(|| self.get(one, other) / variances.sqrt())
    }
}

impl Fitted {
    /// Returns the residual in standard deviations, or `None` for exact evidence.
    pub fn standardised_residual(&self) -> Option<f64> {
        Some(self.residual / self.sd?)
    }

    /// Returns the residual as the fit weighs it: in standard deviations, or of an exact value in a millionth of its size.
    pub fn weighed_residual(&self) -> f64 {
        let uncertainty = self.sd.map_or(Uncertainty::Exact, Uncertainty::StandardDeviation);
        self.residual / Evidence { of: self.of, value: self.given, uncertainty }.weight_scale()
    }
}

impl Solution {
    /// Returns the values of the unknowns, in the order of the problem.
    pub(super) fn values(&self) -> Vec<f64> {
        self.unknowns.iter().map(|estimate| estimate.value).collect()
    }

    /// Returns the estimate of an unknown.
    pub fn estimate(&self, of: Variable) -> Option<&Estimate> {
        self.unknowns.iter().find(|estimate| estimate.of == of)
    }

    /// Returns `true` if chance explains the residuals.
    pub fn is_explained(&self) -> bool {
        self.probability >= CONTRADICTION
    }

    /// Returns `true` if chance would explain residuals of this chi-square.
    pub fn would_be_explained(&self, chi_square: f64) -> bool {
        probability(chi_square, self.degrees_of_freedom) >= CONTRADICTION
    }

    /// Returns the unknowns whose standard deviation exceeds their plausible range: the distance between their bounds or, if one is missing, twice the
    /// typical spread of such quantities. The evidence barely constrains them.
    pub fn hardly_determined(&self, question: &ReconstructionProblem) -> Vec<Variable> {
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
}

/// A minimum and its analysis.
pub(super) struct Seen {
    /// The solution.
    pub(super) solution: Solution,
    /// The directions that lead to fits as good, in the scales of the unknowns.
    pub(super) open: Vec<Vec<f64>>,
}

impl Seen {
    /// Analyzes a minimum. Returns `None` if its curvature is lost in rounding, or its covariance exceeds the floats.
    pub(super) fn of(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], searches: usize) -> Option<Self> {
        let values = &minimum.unknowns;
        let (placed, impact) = model.solve(values).ok()?;
        let computed = model.measured(values, &placed, &impact);
        let residuals = DVector::from_vec(model.residuals(&model.compared(values, &placed, &impact)));
        let problem = WithinLimits::around(model, values, &placed, &impact);
        let edges = problem.margin_slopes(values, &minimum.margins);
        let slopes = Slopes::of(model, minimum, spans, edges);
        let Influences { curved: influence, straight } = slopes.influences(model, minimum, spans, &residuals)?;
        let errors = model.weights.covariance(model.question, &model.evidence);
        let covariance = larger(&influence * &errors * influence.transpose(), &straight * &errors * straight.transpose());
        if !covariance.iter().chain(influence.iter()).all(|entry| entry.is_finite()) {
            return None;
        }
        let has_errors = errors.iter().any(|entry| *entry != 0.0);
        let open: Vec<Vec<f64>> = slopes.blind.iter().filter(|direction| is_open(model, minimum, spans, direction)).cloned().collect();
        let moves = |directions: &[Vec<f64>], i: usize| directions.iter().any(|direction| is_moved(direction[i], direction));
        let sd = |i: usize| covariance[(i, i)].max(0.0).sqrt();
        let is_folded = |i: &usize| {
            if moves(&slopes.blind, *i) { !moves(&open, *i) } else { contradicts(model, minimum, spans, *i, sd(*i)) }
        };
        let at_fold: Vec<usize> = (0..values.len()).filter(is_folded).collect();
        let narrowed = narrowed_by_bounds(model, minimum, spans);
        let estimate = |i: usize| {
            let has_slope = !moves(&open, i) && !at_fold.contains(&i);
            let has_sd = has_errors && has_slope && !minimum.is_held[i] && minimum.margins.is_empty() && !narrowed[i];
            Estimate {
                of: model.question.unknowns[i].of,
                value: values[i],
                sd: has_sd.then(|| sd(i)),
                at: minimum.at[i],
                is_determined: !moves(&open, i),
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
        let solution = Solution {
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
            limits: minimum.margins.iter().filter_map(|margin| problem.limit(*margin)).collect(),
            at_fold: at_fold.iter().map(|&i| model.question.unknowns[i].of).collect(),
            iterations: minimum.iterations,
            searches,
        };
        Some(Seen { solution, open })
    }
}

/// Returns the probability of a χ² this large or larger. Without degrees of freedom, a χ² above rounding is tested as if there were one.
fn probability(chi_square: f64, degrees_of_freedom: usize) -> f64 {
    /// Largest χ² from rounding.
    const ROUNDING: f64 = 1e-9;
    if chi_square <= ROUNDING {
        return 1.0;
    }
    let distribution = ChiSquared::new(degrees_of_freedom.max(1) as f64);
    distribution.map_or(f64::NAN, |distribution| distribution.sf(chi_square))
}

/// The derivatives of the evidence at a minimum.
struct Slopes {
    /// The derivatives of the evidence by the scaled unknowns; zero for unknowns on an active bound.
    derivatives: DMatrix<f64>,
    /// Those of the margins that the minimum lies on.
    edges: DMatrix<f64>,
    /// Directions along which no evidence has a slope, in scales.
    blind: Vec<Vec<f64>>,
    /// An orthonormal basis, column by column, of the others.
    determined: DMatrix<f64>,
}

impl Slopes {
    fn of(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], mut edges: DMatrix<f64>) -> Self {
        let mut derivatives = model.derivatives(&minimum.unknowns);
        let free: Vec<usize> = (0..spans.len()).filter(|&i| !minimum.is_held[i]).collect();
        for matrix in [&mut derivatives, &mut edges] {
            for (i, mut column) in matrix.column_iter_mut().enumerate() {
                column *= if minimum.is_held[i] { 0.0 } else { spans[i].scale };
            }
        }
        // An edge ties the unknowns to each other like evidence.
        let sizes: Vec<f64> = model.evidence.iter().map(Evidence::size).chain(edges.row_iter().map(|_| 1.0)).collect();
        let tied = DMatrix::from_rows(&derivatives.row_iter().chain(edges.row_iter()).collect::<Vec<_>>());
        let of_free = blind(&tied.select_columns(&free), &sizes);
        let spread = |direction: &Vec<f64>| {
            let mut all = vec![0.0; spans.len()];
            free.iter().zip(direction).for_each(|(&i, part)| all[i] = *part);
            all
        };
        let determined = complement(&of_free, &free, spans.len());
        Slopes { blind: of_free.iter().map(spread).collect(), determined, derivatives, edges }
    }

    /// Computes the derivatives of the unknowns by the evidence, by implicit differentiation of the zero gradient of ½χ². Returns `None` if the curvature is
    /// not positive definite.
    fn influences(&self, model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds], residuals: &DVector<f64>) -> Option<Influences> {
        /// Curvature across an edge, on which the minimum stays, as a share of the largest.
        const TIGHT: f64 = 1e6;
        if self.determined.ncols() == 0 {
            let none = DMatrix::zeros(spans.len(), model.evidence.len());
            return Some(Influences { curved: none.clone(), straight: none });
        }
        let weighted = self.weighted(model);
        let straight = weighted.transpose() * &self.derivatives;
        let straight = &straight + self.edges.tr_mul(&self.edges) * (TIGHT * straight.diagonal().amax());
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

    /// Returns the inverse covariance of the evidence times its derivatives.
    fn weighted(&self, model: &Model<'_>) -> DMatrix<f64> {
        let columns: Vec<DVector<f64>> =
            self.derivatives.column_iter().map(|column| model.weights.inverse_times(&column.into_owned())).collect();
        DMatrix::from_columns(&columns)
    }
}

/// Returns for each unknown whether it is much less certain with the unknowns that a bound holds: these may lie away from their bound as far as the evidence, or their other bound,
/// allows, and move it.
fn narrowed_by_bounds(model: &Model<'_>, minimum: &Minimum, spans: &[ParameterBounds]) -> Vec<bool> {
    /// Ratio of variances from which the difference is large.
    const MUCH: f64 = 1.5 * 1.5;
    let (held, free): (Vec<usize>, Vec<usize>) = (0..spans.len()).partition(|&i| minimum.is_held[i]);
    let mut narrowed = vec![false; spans.len()];
    if held.is_empty() || free.is_empty() {
        return narrowed;
    }
    let slopes = model.weights.whiten(least_squares::scaled(model.derivatives(&minimum.unknowns), spans));
    let [of_free, of_held] = [&free, &held].map(|columns| slopes.select_columns(columns));
    // Without a factor some are not determined, and have no deviation.
    let Some(factor) = Cholesky::new(of_free.tr_mul(&of_free)) else { return narrowed };
    let variances = factor.inverse();
    let moves = factor.solve(&of_free.tr_mul(&of_held));
    let left = of_held.clone() - of_free * &moves;
    for (k, &h) in held.iter().enumerate() {
        let width = (spans[h].max - spans[h].min) / spans[h].scale;
        let distance = left.column(k).norm().recip().min(width);
        for (row, &i) in free.iter().enumerate() {
            let moved = if moves[(row, k)] == 0.0 { 0.0 } else { moves[(row, k)] * distance };
            narrowed[i] |= moved * moved > (MUCH - 1.0) * variances[(row, row)];
        }
    }
    narrowed
}

/// Derivatives of the unknowns by the evidence.
struct Influences {
    /// From the slope and the curvature of the evidence: the derivative of the solution.
    curved: DMatrix<f64>,
    /// From the slope alone.
    straight: DMatrix<f64>,
}

/// Returns the covariance from slope and curvature or, if it is much larger for an unknown, that from the slope alone: at a fold the curvature ties an
/// unknown to the value where noise has put it, and only the slope shows that it could be elsewhere.
fn larger(curved: DMatrix<f64>, straight: DMatrix<f64>) -> DMatrix<f64> {
    /// Ratio of standard deviations from which the difference is large.
    const MUCH: f64 = 1.5;
    let is_much_less_sure = |i: usize| straight[(i, i)] > MUCH * MUCH * curved[(i, i)];
    if (0..curved.nrows()).any(is_much_less_sure) { straight } else { curved }
}

/// Returns an orthonormal basis of the free unknowns, orthogonal to the unconstrained directions.
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
