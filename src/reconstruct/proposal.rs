//! Proposals for draws of the posterior: around each solution and around earlier draws, whatever the present draw is.
//!
//! They lead from one mode to another with the right frequency, and where the posterior is nearly normal each accepted one is a fresh draw.

use hammer_and_sample::Move;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rand::{Rng, RngExt};
use rand_distr::{ChiSquared, Distribution, StandardNormal};

/// Degrees of freedom of the proposals: few, so that their tails are longer than those of the posterior.
const FREEDOM: f64 = 5.0;

/// Student's t distributions of equal weight.
#[derive(Clone)]
pub(super) struct Proposal(Vec<Student>);

/// A multivariate Student's t distribution.
#[derive(Clone)]
struct Student {
    center: DVector<f64>,
    /// The Cholesky factor of its covariance, but for a factor.
    spread: DMatrix<f64>,
    /// The logarithm of the determinant of `spread`.
    log_volume: f64,
}

impl Student {
    fn of(center: &[f64], factor: Option<Cholesky<f64, Dyn>>) -> Option<Self> {
        let spread = factor?.unpack();
        let log_volume = spread.diagonal().iter().map(|x| libm::log(*x)).sum::<f64>();
        log_volume.is_finite().then(|| Student { center: DVector::from_column_slice(center), spread, log_volume })
    }

    fn draw<R: Rng>(&self, random: &mut R) -> DVector<f64> {
        let normal = DVector::from_fn(self.center.len(), |_, _| random.sample::<f64, _>(StandardNormal));
        let chi_square: f64 = ChiSquared::new(FREEDOM).map_or(FREEDOM, |of| of.sample(random));
        &self.center + &self.spread * normal * (FREEDOM / chi_square).sqrt()
    }

    /// Returns the logarithm of its density, up to a constant that all of the same dimension share.
    fn log_density(&self, at: &DVector<f64>) -> f64 {
        let away = self.spread.solve_lower_triangular(&(at - &self.center)).map_or(f64::INFINITY, |away| away.norm_squared());
        -self.log_volume - 0.5 * (FREEDOM + self.center.len() as f64) * libm::log1p(away / FREEDOM)
    }
}

impl Proposal {
    /// Creates distributions around points, each with the inverse of its covariance; `None` if no matrix is one.
    pub(super) fn around(points: impl Iterator<Item = (Vec<f64>, DMatrix<f64>)>) -> Option<Self> {
        let covariance = |precision: DMatrix<f64>| Some(precision.cholesky()?.inverse());
        let all: Vec<_> = points.filter_map(|(center, precision)| Student::of(&center, covariance(precision)?.cholesky())).collect();
        (!all.is_empty()).then_some(Proposal(all))
    }

    /// Returns this with a distribution that has the mean and the covariance of draws.
    pub(super) fn with_draws(&self, draws: &[Vec<f64>]) -> Self {
        let count = draws.len() as f64;
        let mean = draws.iter().fold(DVector::zeros(draws[0].len()), |sum, draw| sum + DVector::from_column_slice(draw)) / count;
        let squares = draws.iter().map(|draw| DVector::from_column_slice(draw) - &mean);
        let covariance = squares.fold(DMatrix::zeros(mean.len(), mean.len()), |sum, away| sum + &away * away.transpose()) / count;
        let mut with = self.clone();
        with.0.extend(Student::of(mean.as_slice(), covariance.cholesky()));
        with
    }

    pub(super) fn draw<R: Rng>(&self, random: &mut R) -> Vec<f64> {
        let chosen = random.random_range(0..self.0.len());
        self.0[chosen].draw(random).data.into()
    }

    /// Returns the logarithm of the density of a draw, up to a constant.
    pub(super) fn log_density(&self, at: &[f64]) -> f64 {
        let at = DVector::from_column_slice(at);
        let logs: Vec<f64> = self.0.iter().map(|student| student.log_density(&at)).collect();
        let greatest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        greatest + libm::log(logs.iter().map(|log| libm::exp(log - greatest)).sum())
    }
}

impl Move<Vec<f64>> for Proposal {
    fn propose<'a, O, R>(&self, this: &'a Vec<f64>, _: O, random: &mut R) -> (Vec<f64>, f64)
    where
        O: FnMut(&mut R) -> &'a Vec<f64>,
        R: Rng,
    {
        let proposed = self.draw(random);
        let correction = self.log_density(this) - self.log_density(&proposed);
        (proposed, correction)
    }
}
