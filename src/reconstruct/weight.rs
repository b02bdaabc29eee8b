//! Weights of residuals: division by the standard deviation, and decorrelation.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SymmetricEigen};

use super::given::{Evidence, ReconstructionProblem};
use super::variable::Variable;

/// Smallest accepted eigenvalue of a matrix of correlations.
pub(super) const SINGULAR: f64 = 1e-9;

/// Weights from the covariance of the evidence.
pub(super) struct Weights {
    /// The divisor of each residual: its standard deviation, or the tolerance of exact evidence.
    pub(super) scales: Vec<f64>,
    /// The Cholesky factor of the correlations, if there are any.
    factor: Option<Cholesky<f64, Dyn>>,
}

impl Weights {
    /// Creates the weights of evidence in order, whose correlations have passed the check.
    pub(super) fn of(question: &ReconstructionProblem, evidence: &[Evidence]) -> Self {
        let scales = evidence.iter().map(Evidence::weight_scale).collect();
        let has_any = !question.correlations.is_empty() || !question.prior_correlations.is_empty();
        Weights { scales, factor: has_any.then(|| correlations(question, evidence)).and_then(Cholesky::new) }
    }

    /// Scales and decorrelates residuals, or rows of their derivatives, so that their errors have standard deviations of 1 and no correlation.
    pub(super) fn whiten(&self, mut rows: DMatrix<f64>) -> DMatrix<f64> {
        for (mut row, scale) in rows.row_iter_mut().zip(&self.scales) {
            row /= *scale;
        }
        if let Some(factor) = &self.factor {
            factor.l_dirty().solve_lower_triangular_mut(&mut rows);
        }
        rows
    }

    /// Returns the inverse of the covariance times residuals.
    pub(super) fn inverse_times(&self, residuals: &DVector<f64>) -> DVector<f64> {
        let mut result = residuals.clone();
        self.divide(&mut result);
        if let Some(factor) = &self.factor {
            factor.solve_mut(&mut result);
        }
        self.divide(&mut result);
        result
    }

    /// Returns the covariance that the residuals are scaled and decorrelated by.
    pub(super) fn scaled_covariance(&self) -> DMatrix<f64> {
        let scales = DMatrix::from_diagonal(&DVector::from_column_slice(&self.scales));
        let correlations = self
            .factor
            .as_ref()
            .map_or_else(|| DMatrix::identity(self.scales.len(), self.scales.len()), |factor| factor.l() * factor.l().transpose());
        &scales * correlations * &scales
    }

    fn divide(&self, residuals: &mut DVector<f64>) {
        for (residual, scale) in residuals.iter_mut().zip(&self.scales) {
            *residual /= scale;
        }
    }

    /// Returns the covariance of the evidence, zero for exact evidence.
    pub(super) fn covariance(&self, question: &ReconstructionProblem, evidence: &[Evidence]) -> DMatrix<f64> {
        let sd: Vec<f64> = evidence.iter().map(|evidence| evidence.uncertainty.standard_deviation().unwrap_or(0.0)).collect();
        let correlations = correlations(question, evidence);
        DMatrix::from_fn(sd.len(), sd.len(), |i, k| sd[i] * correlations[(i, k)] * sd[k])
    }
}

/// Returns the matrix of correlations of the evidence, which the priors follow.
fn correlations(question: &ReconstructionProblem, evidence: &[Evidence]) -> DMatrix<f64> {
    let mut matrix = DMatrix::identity(evidence.len(), evidence.len());
    let mut set = |i: Option<usize>, k: Option<usize>, coefficient: f64| {
        if let (Some(i), Some(k)) = (i, k) {
            matrix[(i, k)] = coefficient;
            matrix[(k, i)] = coefficient;
        }
    };
    let place = |of| evidence.iter().position(|evidence| evidence.of == of);
    for correlation in &question.correlations {
        set(place(correlation.one), place(correlation.other), correlation.coefficient);
    }
    let priors: Vec<Variable> = question.unknowns.iter().filter(|unknown| unknown.prior.is_some()).map(|unknown| unknown.of).collect();
    let prior = |of| priors.iter().position(|prior| *prior == of).map(|place| question.evidence.len() + place);
    for correlation in &question.prior_correlations {
        set(prior(correlation.one), prior(correlation.other), correlation.coefficient);
    }
    matrix
}

/// Returns the least eigenvalue of the correlations of evidence and priors, or NaN if they have none.
pub(super) fn least_eigenvalue(question: &ReconstructionProblem) -> f64 {
    let matrix = correlations(question, &question.all_evidence());
    if matrix.iter().any(|x| !x.is_finite()) {
        return f64::NAN;
    }
    SymmetricEigen::new(matrix).eigenvalues.min()
}
