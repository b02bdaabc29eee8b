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

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    const PRECISION: [f64; 4] = [2.0, 0.6, 0.6, 1.0];

    fn around(center: [f64; 2]) -> Proposal {
        Proposal::around(std::iter::once((center.to_vec(), DMatrix::from_row_slice(2, 2, &PRECISION)))).expect("a covariance")
    }

    /// The logarithm of a density of Student's t in two dimensions, up to a constant.
    fn log_density(away: [f64; 2]) -> f64 {
        let [x, y] = away;
        -3.5 * libm::log1p((2.0 * x * x + 1.2 * x * y + y * y) / 5.0)
    }

    #[test]
    fn draws_have_the_covariance_of_students_t() {
        let (proposal, mut random) = (around([3.0, -1.0]), ChaCha8Rng::seed_from_u64(5));
        let draws: Vec<_> = (0..100_000).map(|_| proposal.draw(&mut random)).collect();
        let mean = |of: &dyn Fn(&[f64]) -> f64| draws.iter().map(|draw| of(draw)).sum::<f64>() / draws.len() as f64;
        assert!((mean(&|at| at[0]) - 3.0).abs() < 0.02 && (mean(&|at| at[1]) + 1.0).abs() < 0.02);
        // ν/(ν − 2) times the inverse of the precision, whose determinant is 1.64.
        let covariance = [[1.0, -0.6], [-0.6, 2.0]].map(|row| row.map(|entry| entry / 1.64 * 5.0 / 3.0));
        for i in 0..2 {
            for k in 0..2 {
                let found = mean(&|at| (at[i] - [3.0, -1.0][i]) * (at[k] - [3.0, -1.0][k]));
                assert!((found - covariance[i][k]).abs() < 0.05, "{i} {k}: {found} {}", covariance[i][k]);
            }
        }
    }

    #[test]
    fn a_move_is_corrected_by_the_densities() {
        let (proposal, mut random) = (around([3.0, -1.0]), ChaCha8Rng::seed_from_u64(6));
        let here = vec![4.0, 0.5];
        for _ in 0..20 {
            let (there, correction) = proposal.propose(&here, |_: &mut ChaCha8Rng| &here, &mut random);
            let wanted = log_density([1.0, 1.5]) - log_density([there[0] - 3.0, there[1] + 1.0]);
            assert!((correction - wanted).abs() < 1e-12, "{there:?}: {correction} {wanted}");
        }
    }

    #[test]
    fn earlier_draws_have_a_share_of_their_own() {
        // Draws with the mean (1, 2) and the covariance of the identity.
        let draws: Vec<Vec<f64>> = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[x, y]| vec![1.0 + x, 2.0 + y]).to_vec();
        let with = around([3.0, -1.0]).with_draws(&draws);
        let density = |at: [f64; 2]| {
            let [x, y] = [at[0] - 1.0, at[1] - 2.0];
            // Of equal weight; the first one has the root of the determinant of its precision as a factor.
            1.64_f64.sqrt() * log_density([at[0] - 3.0, at[1] + 1.0]).exp() + (-3.5 * ((x * x + y * y) / 5.0).ln_1p()).exp()
        };
        let [one, other] = [[1.2, 1.7], [2.8, -0.5]];
        let (found, wanted) = (with.log_density(&one) - with.log_density(&other), (density(one) / density(other)).ln());
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
}
