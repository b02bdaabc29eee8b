//! The density of the posterior: that of the priors times the likelihood of the evidence, zero where the mechanics refuses the collision.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal};

use super::given::{ReconstructionProblem, Uncertainty};
use super::growing::Growing;
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
    growing: Option<Growing>,
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
        let growing = Growing::of(&model);
        Density { model, spans, shaped, growing }
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
        let deviance = match &self.growing {
            Some(growing) => growing.deviance(&DVector::from_vec(residuals)),
            None => self.model.weights.whiten(DMatrix::from_vec(residuals.len(), 1, residuals)).norm_squared(),
        };
        Some(log - 0.5 * deviance)
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
    use crate::input::Side;
    use crate::reconstruct::search::spans;
    use crate::reconstruct::{Correlation, GrowingError, Variable};
    use crate::{Collision, Party, Vehicle};

    /// By hand, of two numbers. Of a cause that is nearly exact: the covariance less the growing error that it has, and with that of the computed values. Of another one: the integral
    /// over it.
    #[test]
    fn an_error_that_grows_is_that_of_the_computed_values() {
        let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(13.0);
        let of = [Measurand::DeltaVForward(Side::One), Measurand::SeparationSpeed(Side::One)];
        let (given, sds, correlation) = ([-12.0, 1.5], [1.0, 0.4], 0.6);
        let mut question =
            ReconstructionProblem::of(Collision::new(car, Party::Barrier).with_restitution(0.1)).unknown(Variable::Speed(Side::One), 13.0);
        for i in 0..2 {
            question = question.evidence(of[i], given[i], Uncertainty::StandardDeviation(sds[i]));
        }
        question.correlations.push(Correlation { one: of[0], other: of[1], coefficient: correlation });
        let parts = [(-0.7, -0.6, 0.05), (-0.1, -0.15, 0.1)];
        let growing = |relative_sd: f64| -> Vec<GrowingError> {
            let part = |i: usize| {
                let (at_fit, at_given, slope) = parts[i];
                GrowingError { of: of[i], at_fit, at_given, slope, relative_sd, power: [-0.5, -1.0][i] }
            };
            (0..2).map(part).collect()
        };
        question.growing_error = growing(1e-8);
        let by_hand = |speed: f64| {
            let model = Model::of(&question);
            let (placed, impact) = model.solve(&[speed]).expect("possible");
            let computed = model.compared(&[speed], &placed, &impact);
            let off = [given[0] - computed[0], given[1] - computed[1]];
            let error = [0, 1].map(|i| parts[i].1 + parts[i].2 * (computed[i] - given[i]));
            let entry = |i: usize, k: usize| {
                let whole = sds[i] * sds[k] * if i == k { 1.0 } else { correlation };
                whole - parts[i].0 * parts[k].0 + error[i] * error[k]
            };
            let determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(0, 1);
            let chi_square =
                (entry(1, 1) * off[0] * off[0] - 2.0 * entry(0, 1) * off[0] * off[1] + entry(0, 0) * off[1] * off[1]) / determinant;
            -0.5 * (chi_square + libm::log(determinant))
        };
        let density = Density::of(&question, spans(&question));
        for speed in [9.0, 12.0, 16.0] {
            let [found, wanted] = [density.log(&[speed]) - density.log(&[13.0]), by_hand(speed) - by_hand(13.0)];
            assert!((found - wanted).abs() < 1e-5, "{speed}: {found}, not {wanted}");
        }
        let wide = ReconstructionProblem { growing_error: growing(0.2), ..question.clone() };
        let integral = |speed: f64| {
            let model = Model::of(&wide);
            let (placed, impact) = model.solve(&[speed]).expect("possible");
            let computed = model.compared(&[speed], &placed, &impact);
            let at = |cause: f64| {
                // The friction has this share of the given one, and a speed of slides its root.
                let off = [0, 1].map(|i| {
                    let size = parts[i].1 + parts[i].2 * (computed[i] - given[i]);
                    let (power, share) = ([-0.5, -1.0][i], 1.0 + 0.2 * cause);
                    given[i] - computed[i] + size / (0.2 * power) * (libm::pow(share, power) - 1.0)
                });
                let entry = |i: usize, k: usize| sds[i] * sds[k] * if i == k { 1.0 } else { correlation } - parts[i].0 * parts[k].0;
                let determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(0, 1);
                let chi_square =
                    (entry(1, 1) * off[0] * off[0] - 2.0 * entry(0, 1) * off[0] * off[1] + entry(0, 0) * off[1] * off[1]) / determinant;
                libm::exp(-0.5 * (chi_square + cause * cause))
            };
            libm::log((-4700..=8000).map(|k| at(f64::from(k) * 1e-3)).sum())
        };
        let density = Density::of(&wide, spans(&wide));
        for speed in [9.0, 12.0, 16.0] {
            let [found, wanted] = [density.log(&[speed]) - density.log(&[13.0]), integral(speed) - integral(13.0)];
            assert!((found - wanted).abs() < 0.1 * wanted.abs().max(0.2), "{speed}: {found}, not {wanted}");
        }
        // Of none the weights are those of the evidence.
        let plain = ReconstructionProblem { growing_error: Vec::new(), ..question.clone() };
        assert!(Density::of(&plain, spans(&plain)).growing.is_none() && density.growing.is_some());
    }

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
