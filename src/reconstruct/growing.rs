//! Errors of the evidence with one cause that grow with it, such as those of two slides to rest by the friction of their road.

use nalgebra::{Cholesky, DVector, Dyn};

use super::given::GrowingError;
use super::residuals::Model;

/// An error with one cause that grows with the evidence.
pub(super) struct Growing {
    /// Each part with the index of its residual.
    parts: Vec<(usize, GrowingError)>,
    /// The Cholesky factor of the covariance of everything else.
    others: Cholesky<f64, Dyn>,
}

impl Growing {
    /// Takes the error out of the covariance of the evidence. `None` if there is none, or it is not in the covariance.
    pub(super) fn of(model: &Model<'_>) -> Option<Self> {
        let place = |part: &GrowingError| model.evidence.iter().position(|evidence| evidence.of == part.of);
        let parts: Vec<(usize, GrowingError)> =
            model.question.growing_error.iter().filter_map(|part| Some((place(part)?, *part))).collect();
        let at_fit = vector(model.evidence.len(), parts.iter().map(|(row, part)| (*row, part.at_fit)));
        let others = model.weights.scaled_covariance() - &at_fit * at_fit.transpose();
        let others = (!parts.is_empty()).then(|| Cholesky::new(others))??;
        Some(Growing { parts, others })
    }

    /// Returns minus two logarithms of the density of residuals, up to a constant, over all values of the cause (Laplace's approximation, exact where the computed values are
    /// linear in it): at the most probable one χ², that of the cause, and the logarithm of the curvature there.
    pub(super) fn deviance(&self, residuals: &DVector<f64>) -> f64 {
        /// Steps to the most probable cause; each is a Gauss–Newton step of a problem that is nearly linear.
        const STEPS: usize = 4;
        let mut cause = 0.0;
        for _ in 0..STEPS {
            let (left, error) = self.with_cause(residuals, cause);
            let next = (error.norm_squared() * cause - error.dot(&left)) / (1.0 + error.norm_squared());
            cause = next.max(self.least_cause());
        }
        let (left, error) = self.with_cause(residuals, cause);
        left.norm_squared() + cause * cause + libm::log(1.0 + error.norm_squared())
    }

    /// Returns the least value of the cause, in standard deviations from what is given: it is above zero.
    fn least_cause(&self) -> f64 {
        /// Least share of what is given.
        const LEAST: f64 = 0.05;
        self.parts.iter().map(|(_, part)| (LEAST - 1.0) / part.relative_sd).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the residuals with a value of the cause and their derivatives by it, as what else is uncertain weighs them.
    fn with_cause(&self, residuals: &DVector<f64>, cause: f64) -> (DVector<f64>, DVector<f64>) {
        let (mut left, mut error) = (residuals.clone(), DVector::zeros(residuals.len()));
        for (row, part) in &self.parts {
            let size = part.at_given - part.slope * residuals[*row];
            let share = 1.0 + part.relative_sd * cause;
            let grown = if part.power == 0.0 { libm::log(share) } else { (libm::pow(share, part.power) - 1.0) / part.power };
            left[*row] += size / part.relative_sd * grown;
            error[*row] = size * libm::pow(share, part.power - 1.0);
        }
        for rows in [&mut left, &mut error] {
            self.others.l_dirty().solve_lower_triangular_mut(rows);
        }
        (left, error)
    }
}

/// Returns a vector of zeros but for some entries.
fn vector(length: usize, entries: impl Iterator<Item = (usize, f64)>) -> DVector<f64> {
    let mut vector = DVector::zeros(length);
    entries.for_each(|(row, entry)| vector[row] = entry);
    vector
}
