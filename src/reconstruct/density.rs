//! The density of the posterior: that of the priors times the likelihood of the evidence, zero where the mechanics refuses the collision.

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, Normal};

use super::given::{ReconstructionProblem, Uncertainty};
use super::measurand::Measurand;
use super::residuals::Model;
use crate::distribution::{Distribution, degrees_of_freedom, standard_error, student};
use crate::least_squares::ParameterBounds;

/// The density of the posterior over the unknowns, up to a factor.
pub(super) struct Density<'a> {
    pub(super) model: Model<'a>,
    /// The limits of each unknown.
    pub(super) spans: Vec<ParameterBounds>,
    /// Priors of another shape than normal.
    shaped: Vec<Shaped>,
}

/// A prior whose shape is not normal.
struct Shaped {
    /// The index of its unknown.
    unknown: usize,
    /// The index of its residual.
    residual: usize,
    sd: f64,
    shape: Distribution,
}

impl<'a> Density<'a> {
    /// Creates the density within limits. Exact evidence has a standard deviation of a thousandth of its size: with less, draws could not follow it.
    pub(super) fn of(question: &'a ReconstructionProblem, spans: Vec<ParameterBounds>) -> Self {
        let mut model = Model::of(question);
        model.soften(|evidence| evidence.uncertainty == Uncertainty::Exact);
        let with_prior = question.unknowns.iter().enumerate().filter_map(|(i, unknown)| Some((i, unknown, unknown.prior?)));
        let shaped = with_prior.enumerate().filter_map(|(k, (unknown, given, sd))| {
            let shape = given.shape?;
            Some(Shaped { unknown, residual: question.evidence.len() + k, sd, shape })
        });
        let shaped = shaped.collect();
        Density { model, spans, shaped }
    }

    /// Returns the exact evidence, which is softened.
    pub(super) fn softened(&self) -> Vec<Measurand> {
        let exact = self.model.evidence.iter().filter(|evidence| evidence.uncertainty == Uncertainty::Exact);
        exact.map(|evidence| evidence.of).collect()
    }

    /// Returns the logarithm of the density, up to a constant; −∞ where it is zero.
    pub(super) fn log(&self, unknowns: &[f64]) -> f64 {
        self.log_within(unknowns).filter(|log| !log.is_nan()).unwrap_or(f64::NEG_INFINITY)
    }

    fn log_within(&self, unknowns: &[f64]) -> Option<f64> {
        if !unknowns.iter().zip(&self.spans).all(|(x, span)| (span.min..=span.max).contains(x)) {
            return None;
        }
        let (placed, impact) = self.model.solve(unknowns).ok()?;
        let mut residuals = self.model.residuals(&self.model.compared(unknowns, &placed, &impact));
        let mut log = 0.0;
        for Shaped { unknown, residual, sd, shape } in &self.shaped {
            // A Gaussian copula: the score has the normal distribution and the correlations, the value has its own density.
            let (x, score) = (unknowns[*unknown], score(shape, unknowns[*unknown]));
            residuals[*residual] = -sd * score;
            log += shape.log_density(x) + 0.5 * score * score;
        }
        let chi_square = self.model.weights.whiten(DMatrix::from_vec(residuals.len(), 1, residuals)).norm_squared();
        Some(log - 0.5 * chi_square)
    }
}

/// Returns the standard normal number that is as probable to be exceeded as a value of a distribution.
fn score(shape: &Distribution, x: f64) -> f64 {
    /// Least probability, so that no score is infinite.
    const LEAST: f64 = 1e-300;
    let of = |below: f64| Normal::standard().inverse_cdf(below.max(LEAST));
    match *shape {
        Distribution::Normal { mean, sd } => (x - mean) / sd,
        Distribution::LogNormal { median, log_sd } => libm::log(x / median) / log_sd,
        Distribution::Uniform { min, max } => symmetric(of, (x - min) / (max - min), (max - x) / (max - min)),
        Distribution::Triangular { min, mode, max } => {
            let width = max - min;
            let part = |from: f64, of: f64| if of > 0.0 { from * from / (of * width) } else { 0.0 };
            if x <= mode {
                let below = part(x - min, mode - min);
                symmetric(of, below, 1.0 - below)
            } else {
                let above = part(max - x, max - mode);
                symmetric(of, 1.0 - above, above)
            }
        }
        Distribution::TruncatedNormal { mode, scale, .. } => (x - mode) / scale,
        Distribution::StudentT { mean, sd, n } => {
            let (t, freedom) = ((x - mean) / standard_error(sd, n), degrees_of_freedom(n));
            symmetric(of, student::above(-t, freedom), student::above(t, freedom))
        }
    }
}

/// Returns the score of the smaller of two probabilities that add up to 1.
fn symmetric(of: impl Fn(f64) -> f64, below: f64, above: f64) -> f64 {
    if below <= above { of(below) } else { -of(above) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::quantile::standard;

    #[test]
    fn the_score_of_a_quantile_is_that_of_its_probability() {
        let shapes = [
            Distribution::Normal { mean: 3.0, sd: 0.5 },
            Distribution::Uniform { min: -2.0, max: 1.0 },
            Distribution::Triangular { min: 1.0, mode: 2.0, max: 5.0 },
            Distribution::LogNormal { median: 2.0, log_sd: 0.25 },
            Distribution::StudentT { mean: 0.7, sd: 0.03, n: 3 },
            Distribution::StudentT { mean: -7.0, sd: 0.5, n: 12 },
        ];
        for shape in shapes {
            for p in [1e-9, 1e-3, 0.02, 0.3, 0.5, 0.7, 0.98, 0.999] {
                let found = score(&shape, shape.quantile(p));
                assert!((found - standard(p)).abs() < 1e-6, "{shape:?} {p}: {found}");
            }
        }
    }
}
