//! Singular values by rotations of the columns (one-sided Jacobi).
//!
//! The decomposition of nalgebra is wrong for some matrices whose rank is nearly deficient, which is where it is needed here: of random ones of two to four columns, every sixth (its issue 1172).

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

/// A matrix as U diag(values) Vᵀ.
pub(crate) struct SingularValues {
    /// The columns U diag(values).
    scaled_left: DMatrix<f64>,
    /// The columns V.
    right: DMatrix<f64>,
    /// Not in order.
    pub(crate) values: Vec<f64>,
}

impl SingularValues {
    /// Decomposes a matrix, or returns `None` if an entry is not finite.
    pub(crate) fn of(mut matrix: DMatrix<f64>) -> Option<Self> {
        /// More sweeps than any matrix of this size needs.
        const SWEEPS: usize = 60;
        /// Cosine of the angle between columns that are perpendicular.
        const PERPENDICULAR: f64 = 1e-15;
        if matrix.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        // Squares of the entries neither overflow nor vanish.
        let size = if matrix.is_empty() { 0.0 } else { matrix.amax() };
        let size = if size > 0.0 { size } else { 1.0 };
        matrix /= size;
        let mut right = DMatrix::identity(matrix.ncols(), matrix.ncols());
        for _ in 0..SWEEPS {
            let mut is_done = true;
            for (p, q) in (0..matrix.ncols()).flat_map(|q| (0..q).map(move |p| (p, q))) {
                let [one, other] = [p, q].map(|k| matrix.column(k).norm_squared());
                let product = matrix.column(p).dot(&matrix.column(q));
                if product.abs() <= PERPENDICULAR * (one.sqrt() * other.sqrt()) {
                    continue;
                }
                is_done = false;
                let slope = (other - one) / (2.0 * product);
                let tangent = 1.0_f64.copysign(slope) / (slope.abs() + libm::sqrt(1.0 + slope * slope));
                let cosine = 1.0 / libm::sqrt(1.0 + tangent * tangent);
                for of in [&mut matrix, &mut right] {
                    for row in 0..of.nrows() {
                        let (x, y) = (of[(row, p)], of[(row, q)]);
                        (of[(row, p)], of[(row, q)]) = (cosine * (x - tangent * y), cosine * (tangent * x + y));
                    }
                }
            }
            if is_done {
                break;
            }
        }
        matrix *= size;
        let values = matrix.column_iter().map(|column| column.norm()).collect();
        Some(SingularValues { scaled_left: matrix, right, values })
    }

    /// Returns the greatest singular value, 0 of an empty matrix.
    pub(crate) fn greatest(&self) -> f64 {
        self.values.iter().fold(0.0, |greatest: f64, value| greatest.max(*value))
    }

    /// Returns the place of the least singular value.
    pub(crate) fn least(&self) -> usize {
        (0..self.values.len()).min_by(|one, other| self.values[*one].total_cmp(&self.values[*other])).unwrap_or(0)
    }

    /// Returns the direction of the unknowns that belongs to a singular value, of length 1.
    pub(crate) fn direction(&self, k: usize) -> Vec<f64> {
        self.right.column(k).iter().copied().collect()
    }

    /// Returns the shortest vector that solves the equations best, as if singular values up to `cutoff` were zero.
    pub(crate) fn solve(&self, of: &DVector<f64>, cutoff: f64) -> DVector<f64> {
        let kept = (0..self.values.len()).filter(|k| self.values[*k] > cutoff);
        kept.fold(DVector::zeros(self.right.nrows()), |sum, k| {
            // Divided twice, since the square may vanish.
            let along = self.scaled_left.column(k).unscale(self.values[k]).dot(of) / self.values[k];
            sum + self.right.column(k) * along
        })
    }
}

impl SingularValues {
    /// Returns the inverse of a matrix of full rank, or of one with more rows its pseudo-inverse.
    #[cfg(feature = "post-impact")]
    pub(crate) fn inverse(&self) -> DMatrix<f64> {
        let part = |k: usize| self.right.column(k) * self.scaled_left.column(k).unscale(self.values[k]).transpose() / self.values[k];
        (0..self.values.len()).map(part).fold(DMatrix::zeros(self.right.nrows(), self.scaled_left.nrows()), |sum, part| sum + part)
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// The product of the factors is the matrix, and the columns of either are perpendicular, for matrices of a rank and of nearly a lower one, of any size.
    #[test]
    fn the_factors_are_those_of_the_matrix() {
        let mut random = ChaCha8Rng::seed_from_u64(1846);
        let mut number = || random.random_range(-1.0..1.0_f64);
        for k in 0..4000 {
            let (rows, columns) = (1 + k % 5, 1 + (k / 5) % 4);
            let (left, right): (Vec<f64>, Vec<f64>) = ((0..rows).map(|_| number()).collect(), (0..columns).map(|_| number()).collect());
            let noise = if k % 7 == 0 { 1.0 } else { libm::pow(10.0, -8.0 - 10.0 * number().abs()) };
            let size = libm::pow(10.0, 150.0 * f64::from(k as u32 % 3) - 150.0);
            let matrix =
                DMatrix::from_fn(rows, columns, |i, j| size * left[i] * if k % 3 == 0 { 1.0 } else { right[j] } * (1.0 + noise * number()));
            let found = SingularValues::of(matrix.clone()).expect("finite");
            let back = &found.scaled_left * found.right.transpose();
            assert!((back - &matrix).amax() <= 1e-14 * matrix.amax(), "{matrix}");
            assert!((found.right.transpose() * &found.right - DMatrix::identity(columns, columns)).amax() < 1e-14, "{matrix}");
            for (i, j) in (0..columns).flat_map(|j| (0..j).map(move |i| (i, j))) {
                let product = found.scaled_left.column(i).unscale(size).dot(&found.scaled_left.column(j).unscale(size));
                let greatest = found.greatest() / size;
                assert!(product.abs() <= 1e-14 * greatest * greatest, "{matrix}");
            }
        }
    }

    /// Nearly the same columns: the decomposition of nalgebra 0.35 is off by a third of the entries.
    #[test]
    fn the_shortest_solution_of_what_has_many() {
        let rows = [-0.287_873_708_464_925_05, -0.108_535_528_941_522_4, -1.033_108_745_480_623_6, 0.010_483_743_086_572_26];
        let matrix = DMatrix::from_fn(4, 2, |i, j| rows[i] * (1.0 + if i == 1 && j == 1 { -1e-15 } else { 0.0 }));
        let found = SingularValues::of(matrix.clone()).expect("finite");
        let solution = found.solve(&DVector::from_column_slice(&rows), 1e-11 * found.greatest());
        assert!((solution - DVector::from_element(2, 0.5)).amax() < 1e-14);
        let least = if found.values[0] < found.values[1] { 0 } else { 1 };
        let [x, y] = found.direction(least)[..] else { panic!("two") };
        assert!((x + y).abs() < 1e-14 && found.values[least] < 1e-15);
        assert!(SingularValues::of(DMatrix::from_element(2, 2, f64::NAN)).is_none());
        assert_eq!(SingularValues::of(DMatrix::zeros(2, 2)).expect("finite").solve(&DVector::from_element(2, 1.0), 0.0), DVector::zeros(2));
    }
}
