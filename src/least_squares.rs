//! Bounded nonlinear least squares from one start, for reconstruction and for separation velocities from rest positions.
//!
//! The Levenberg–Marquardt steps, scaled by the distance to the bounds (Branch, Coleman and Li 1999), are those of the crate `basin`. They stay inside the
//! bounds, so their result is refined here: unknowns that press against a bound are moved onto it, and the others take Gauss–Newton steps until the steps are
//! negligible compared with the scales of the unknowns. Only then has the search converged.

pub(crate) mod limited;
mod polish;
mod quadratic_program;
mod singular_values;

pub(crate) use polish::{scaled, weakest};
pub(crate) use singular_values::SingularValues;

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::convert::Infallible;

use basin::{BoundedLevenbergMarquardt, BoxBounds, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian, Residual};
use nalgebra::DMatrix;

/// Residuals and their derivatives.
pub trait Residuals {
    /// Returns the residuals at the unknowns, or `None` if they are undefined, such as for an impossible collision.
    fn at(&self, unknowns: &[f64]) -> Option<Vec<f64>>;

    /// Returns the derivatives of the residuals, a row for each residual and a column for each unknown, where [`Residuals::at`] is defined.
    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64>;

    /// Returns the sum of the second derivatives of the residuals, each times its residual, for each pair of unknowns, or `None` if unknown. The last digits
    /// need it if residuals are large and an unknown has little effect on them.
    fn residual_hessian(&self, _unknowns: &[f64]) -> Option<DMatrix<f64>> {
        None
    }
}

/// The range and the scale of one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterBounds {
    /// Lower bound; −∞ without a bound.
    pub min: f64,
    /// Upper bound; ∞ without a bound.
    pub max: f64,
    /// A significant change, the unit in which the unknown is measured.
    pub scale: f64,
}

/// A bound of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bound {
    /// The lower bound.
    Min,
    /// The upper bound.
    Max,
}

/// A local minimum of the sum of squares.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// The sum of the squares of the residuals.
    pub sum_of_squares: f64,
    /// The bound that each unknown is on.
    pub at: Vec<Option<Bound>>,
    /// `true` if that bound is active: the sum would be smaller beyond it.
    pub is_held: Vec<bool>,
    /// The margins that it lies on, by their index: beyond them, the sum would be smaller but the problem has no meaning.
    pub margins: Vec<usize>,
    /// Number of steps taken.
    pub iterations: usize,
}

/// State of a search that stopped without convergence.
#[derive(Clone, Debug, PartialEq)]
pub struct NotConverged {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// The sum of the squares of the residuals.
    pub sum_of_squares: f64,
    /// The remaining step, in scales of the unknowns.
    pub step: f64,
    /// Number of steps taken.
    pub iterations: usize,
    /// The unknowns after that step.
    pub toward: Vec<f64>,
}

/// Reason for the absence of a minimum.
#[derive(Clone, Debug, PartialEq)]
pub enum FitError {
    /// The residuals are undefined at the start.
    NoStart,
    /// The search does not converge.
    NotConverged(NotConverged),
}

/// Largest step, in scales, at which the search has converged.
const CONVERGED: f64 = 1e-9;

/// Difference of χ² that is of the rounding of a search: between fits that are closer, the last bits of a platform would choose.
const ROUNDING: f64 = 1e-6;

/// Compares fits by their χ², the better one first. Fits that differ by rounding alone, such as two that are exact, are equal: a stable sort leaves first the
/// one that was found first.
///
/// ```
/// use std::cmp::Ordering;
/// use planar_impact::reconstruct::by_chi_square;
///
/// assert_eq!(by_chi_square(6e-20, 2e-22), Ordering::Equal);
/// assert_eq!(by_chi_square(3.84, 0.0), Ordering::Greater);
/// ```
pub fn by_chi_square(one: f64, other: f64) -> Ordering {
    let rounded = |chi_square: f64| libm::round(chi_square / ROUNDING);
    rounded(one).total_cmp(&rounded(other))
}

/// Finds a local minimum of the sum of squares from a start.
///
/// # Errors
///
/// [`FitError`] if the residuals are undefined at the start, or no minimum is reached within the given number of iterations.
pub fn minimum(of: &impl Residuals, start: &[f64], spans: &[ParameterBounds], iterations: usize) -> Result<Minimum, FitError> {
    let residuals = of.at(start).ok_or(FitError::NoStart)?.len();
    let scaled = Scaled::of(of, residuals, spans);
    let from = start.iter().zip(spans).map(|(x, span)| x / span.scale).collect();
    let solver = BoundedLevenbergMarquardt::new().with_absolute_scaled_gradient_tolerance(1e-6).with_relative_cost_change_tolerance(1e-6);
    let run = Executor::from_start(scaled, solver, from).max_iter(iterations as u64).run().map_err(|_| FitError::NoStart)?;
    let unknowns: Vec<f64> = run.param().iter().zip(spans).map(|(z, span)| (z * span.scale).clamp(span.min, span.max)).collect();
    polish::polish(of, unknowns, spans, run.iter() as usize, iterations).map_err(FitError::NotConverged)
}

/// Returns the distance between two points, the largest difference of an unknown in its scale. It is NaN if any of them is: such a step has not ended.
pub(crate) fn distance(one: &[f64], other: &[f64], scales: impl IntoIterator<Item = f64>) -> f64 {
    let differences = one.iter().zip(other).zip(scales).map(|((one, other), scale)| (one - other).abs() / scale);
    differences.fold(0.0, |largest, next| if next > largest || next.is_nan() { next } else { largest })
}

/// The residuals as functions of the scaled unknowns.
struct Scaled<'a, R> {
    of: &'a R,
    /// Number of residuals.
    residuals: usize,
    spans: &'a [ParameterBounds],
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl<'a, R: Residuals> Scaled<'a, R> {
    fn of(of: &'a R, residuals: usize, spans: &'a [ParameterBounds]) -> Self {
        let each = |bound: fn(&ParameterBounds) -> f64| spans.iter().map(|span| bound(span) / span.scale).collect();
        Scaled { of, residuals, spans, lower: each(|span| span.min), upper: each(|span| span.max) }
    }

    fn unscaled(&self, point: &[f64]) -> Vec<f64> {
        point.iter().zip(self.spans).map(|(z, span)| z * span.scale).collect()
    }
}

impl<R: Residuals> Constraints for Scaled<'_, R> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as basin::ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl<R: Residuals> Residual for Scaled<'_, R> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Infallible;

    fn residual(&self, point: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        // NaN is no improvement, so the damping grows.
        Ok(self.of.at(&self.unscaled(point)).unwrap_or_else(|| alloc::vec![f64::NAN; self.residuals]))
    }
}

impl<R: Residuals> Jacobian for Scaled<'_, R> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, point: &Vec<f64>) -> Result<DenseMatrix, Infallible> {
        let jacobian = self.of.jacobian(&self.unscaled(point));
        Ok(DenseMatrix::from_fn(jacobian.nrows(), jacobian.ncols(), |i, k| jacobian[(i, k)] * self.spans[k].scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    /// Rosenbrock's valley as two residuals.
    struct Valley;

    impl Residuals for Valley {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_row_slice(2, 2, &[-20.0 * x[0], 10.0, -1.0, 0.0])
        }
    }

    const FREE: ParameterBounds = ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, scale: 1.0 };

    #[test]
    fn the_end_of_the_valley_is_found_to_the_last_digits() {
        let minimum = minimum(&Valley, &[-1.2, 1.0], &[FREE, FREE], 200).expect("it converges");
        assert!(minimum.unknowns.iter().all(|x| (x - 1.0).abs() < 1e-12), "{minimum:?}");
        assert_eq!(minimum.at, [None, None]);
    }

    #[test]
    fn a_bound_in_the_way_is_reached_exactly_and_named() {
        let until = ParameterBounds { max: 0.5, ..FREE };
        let minimum = minimum(&Valley, &[-1.2, 1.0], &[until, FREE], 200).expect("it converges");
        assert_eq!(minimum.unknowns[0], 0.5);
        assert!((minimum.unknowns[1] - 0.25).abs() < 1e-12, "{minimum:?}");
        assert_eq!(minimum.at, [Some(Bound::Max), None]);
        assert!((minimum.sum_of_squares - 0.25).abs() < 1e-12);
    }

    #[test]
    fn scales_do_not_matter() {
        let spans = [ParameterBounds { scale: 1e-4, ..FREE }, ParameterBounds { scale: 1e3, ..FREE }];
        let minimum = minimum(&Valley, &[-1.2, 1.0], &spans, 500).expect("it converges");
        assert!(minimum.unknowns.iter().all(|x| (x - 1.0).abs() < 1e-9), "{minimum:?}");
    }

    /// A residual of 3 whose curvature matches the slope of the other: a Gauss–Newton step covers a twentieth of the remaining distance.
    struct Bent;

    impl Residuals for Bent {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            Some(vec![x[0] - 0.01, 3.0 - 0.95 / 6.0 * x[0] * x[0]])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_row_slice(2, 1, &[1.0, -0.95 / 3.0 * x[0]])
        }

        fn residual_hessian(&self, x: &[f64]) -> Option<DMatrix<f64>> {
            Some(DMatrix::from_element(1, 1, -0.95 / 3.0 * (3.0 - 0.95 / 6.0 * x[0] * x[0])))
        }
    }

    #[test]
    fn large_residuals_that_bend_are_no_obstacle() {
        let minimum = minimum(&Bent, &[0.5], &[FREE], 200).expect("it converges");
        let slope = Bent.jacobian(&minimum.unknowns).tr_mul(&nalgebra::DVector::from_vec(Bent.at(&minimum.unknowns).expect("defined")));
        assert!(slope[0].abs() < 1e-12, "{minimum:?}");
    }

    /// √x + 1, which is defined only above zero and decreases toward zero.
    struct Edge;

    impl Residuals for Edge {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            (x[0] > 0.0).then(|| vec![x[0].sqrt() + 1.0])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_element(1, 1, 0.5 / x[0].sqrt())
        }
    }

    #[test]
    fn the_edge_of_what_is_defined_is_no_minimum() {
        let end = minimum(&Edge, &[4.0], &[FREE], 200);
        assert!(matches!(end, Err(FitError::NotConverged(_))), "{end:?}");
        assert_eq!(minimum(&Edge, &[-4.0], &[FREE], 200), Err(FitError::NoStart));
    }

    /// |x| + 1, which has no derivative at its minimum.
    struct Kink;

    impl Residuals for Kink {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            Some(vec![x[0].abs() + 1.0])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_element(1, 1, x[0] / x[0].abs())
        }
    }

    #[test]
    fn where_there_is_no_slope_there_is_no_minimum_and_no_panic() {
        for start in [0.0, 1.0, -3.0] {
            let end = minimum(&Kink, &[start], &[FREE], 200);
            assert!(matches!(end, Err(FitError::NotConverged(_))), "{end:?}");
        }
    }

    #[test]
    fn a_distance_is_the_largest_difference_and_keeps_nan() {
        let to = |other: [f64; 3]| distance(&[1.0, 2.0, 3.0], &other, [1.0, 0.5, 2.0]);
        assert_eq!((to([1.0, 2.0, 3.0]), to([2.0, 1.0, 5.0])), (0.0, 2.0));
        for i in 0..3 {
            let mut other = [2.0, 1.0, 5.0];
            other[i] = f64::NAN;
            assert!(to(other).is_nan(), "whatever follows the unknown {i}");
        }
    }

    #[test]
    fn too_few_iterations_are_no_minimum() {
        let end = minimum(&Valley, &[-1.2, 1.0], &[FREE, FREE], 1);
        let Err(FitError::NotConverged(stopped)) = end else { panic!("{end:?}") };
        assert!(stopped.step > CONVERGED, "{stopped:?}");
    }
}
