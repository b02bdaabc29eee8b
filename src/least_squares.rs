//! The least sum of squares within bounds, from one start: the tool of both ways back, from evidence to speeds and from rest to separation.
//!
//! The steps are Levenberg's and Marquardt's, scaled by the distance to the bounds (Branch, Coleman and Li 1999), of the crate `basin`. They stay inside the bounds,
//! so what they end with is brought to its end here: unknowns that press against a bound are put on it, and the others take Gauss–Newton steps until these are
//! nothing beside the unknowns' scale. Only that is called converged.

mod polish;

use alloc::vec::Vec;
use core::convert::Infallible;

use basin::{BoundedLevenbergMarquardt, BoxBounds, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian, Residual};
use nalgebra::DMatrix;

/// What is to be made small: residuals and how they move.
pub trait Residuals {
    /// The residuals at the unknowns; none where there are none, as beyond what is possible.
    fn at(&self, unknowns: &[f64]) -> Option<Vec<f64>>;

    /// The derivatives of the residuals, a row for each residual and a column for each unknown, where [`Residuals::at`] has them.
    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64>;

    /// The sum of the second derivatives of the residuals, each times its residual, by each two unknowns; none where they are not known. Where residuals are
    /// large and an unknown moves them little, the last digits need it.
    fn bend(&self, _unknowns: &[f64]) -> Option<DMatrix<f64>> {
        None
    }
}

/// The range of one unknown, and what counts as a change of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The least it may be; −∞ without a bound.
    pub min: f64,
    /// The most it may be; ∞ without a bound.
    pub max: f64,
    /// A change that matters: the unknowns are measured in it.
    pub scale: f64,
}

/// A bound of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The least it may be.
    Min,
    /// The most it may be.
    Max,
}

/// Where the sum of squares is least, as far as one can see from there.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// The sum of the squares of the residuals.
    pub sum_of_squares: f64,
    /// The bound that each unknown is on.
    pub at: Vec<Option<Bound>>,
    /// Whether that bound holds it: beyond it the sum would be less.
    pub is_held: Vec<bool>,
    /// Steps taken.
    pub iterations: usize,
}

/// Where the search stopped without having found a least sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// The sum of the squares of the residuals.
    pub sum_of_squares: f64,
    /// The step that the residuals still ask for, in scales of the unknowns.
    pub step: f64,
    /// Steps taken.
    pub iterations: usize,
    /// Where that step would lead.
    pub toward: Vec<f64>,
}

/// Why there is no minimum.
#[derive(Clone, Debug, PartialEq)]
pub enum NoMinimum {
    /// There are no residuals at the start.
    NoStart,
    /// It does not converge.
    Stopped(Stopped),
}

/// How far a step may be, in scales, for its end to be the minimum.
pub(crate) const CONVERGED: f64 = 1e-9;

/// The least sum of squares that lies downhill from a start.
///
/// # Errors
///
/// [`NoMinimum`]: the residuals are not defined at the start, or no minimum is reached in so many iterations.
pub fn minimum(of: &impl Residuals, start: &[f64], spans: &[Span], iterations: usize) -> Result<Minimum, NoMinimum> {
    let residuals = of.at(start).ok_or(NoMinimum::NoStart)?.len();
    let scaled = Scaled::of(of, residuals, spans);
    let from = start.iter().zip(spans).map(|(x, span)| x / span.scale).collect();
    let solver = BoundedLevenbergMarquardt::new().with_absolute_scaled_gradient_tolerance(1e-6).with_relative_cost_change_tolerance(1e-6);
    let run = Executor::from_start(scaled, solver, from).max_iter(iterations as u64).run().map_err(|_| NoMinimum::NoStart)?;
    let unknowns: Vec<f64> = run.param().iter().zip(spans).map(|(z, span)| (z * span.scale).clamp(span.min, span.max)).collect();
    polish::polish(of, unknowns, spans, run.iter() as usize, iterations).map_err(NoMinimum::Stopped)
}

/// The residuals over the unknowns in their scales.
struct Scaled<'a, R> {
    of: &'a R,
    /// How many residuals there are.
    residuals: usize,
    spans: &'a [Span],
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl<'a, R: Residuals> Scaled<'a, R> {
    fn of(of: &'a R, residuals: usize, spans: &'a [Span]) -> Self {
        let each = |bound: fn(&Span) -> f64| spans.iter().map(|span| bound(span) / span.scale).collect();
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
        // What is not a number is no better than before, and the damping grows.
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

    const FREE: Span = Span { min: f64::NEG_INFINITY, max: f64::INFINITY, scale: 1.0 };

    #[test]
    fn the_end_of_the_valley_is_found_to_the_last_digits() {
        let minimum = minimum(&Valley, &[-1.2, 1.0], &[FREE, FREE], 200).expect("it converges");
        assert!(minimum.unknowns.iter().all(|x| (x - 1.0).abs() < 1e-12), "{minimum:?}");
        assert_eq!(minimum.at, [None, None]);
    }

    #[test]
    fn a_bound_in_the_way_is_reached_exactly_and_named() {
        let until = Span { max: 0.5, ..FREE };
        let minimum = minimum(&Valley, &[-1.2, 1.0], &[until, FREE], 200).expect("it converges");
        assert_eq!(minimum.unknowns[0], 0.5);
        assert!((minimum.unknowns[1] - 0.25).abs() < 1e-12, "{minimum:?}");
        assert_eq!(minimum.at, [Some(Bound::Max), None]);
        assert!((minimum.sum_of_squares - 0.25).abs() < 1e-12);
    }

    #[test]
    fn scales_do_not_matter() {
        let spans = [Span { scale: 1e-4, ..FREE }, Span { scale: 1e3, ..FREE }];
        let minimum = minimum(&Valley, &[-1.2, 1.0], &spans, 500).expect("it converges");
        assert!(minimum.unknowns.iter().all(|x| (x - 1.0).abs() < 1e-9), "{minimum:?}");
    }

    /// A residual of 3 that bends as much as the other grows: straight lines take a twentieth of the way with each step.
    struct Bent;

    impl Residuals for Bent {
        fn at(&self, x: &[f64]) -> Option<Vec<f64>> {
            Some(vec![x[0] - 0.01, 3.0 - 0.95 / 6.0 * x[0] * x[0]])
        }

        fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
            DMatrix::from_row_slice(2, 1, &[1.0, -0.95 / 3.0 * x[0]])
        }

        fn bend(&self, x: &[f64]) -> Option<DMatrix<f64>> {
            Some(DMatrix::from_element(1, 1, -0.95 / 3.0 * (3.0 - 0.95 / 6.0 * x[0] * x[0])))
        }
    }

    #[test]
    fn large_residuals_that_bend_are_no_obstacle() {
        let minimum = minimum(&Bent, &[0.5], &[FREE], 200).expect("it converges");
        let slope = Bent.jacobian(&minimum.unknowns).tr_mul(&nalgebra::DVector::from_vec(Bent.at(&minimum.unknowns).expect("defined")));
        assert!(slope[0].abs() < 1e-12, "{minimum:?}");
    }

    /// √x + 1, which there is only above zero, and a slope that leads there.
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
        assert!(matches!(end, Err(NoMinimum::Stopped(_))), "{end:?}");
        assert_eq!(minimum(&Edge, &[-4.0], &[FREE], 200), Err(NoMinimum::NoStart));
    }

    /// |x|, which has no slope where it is least.
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
            assert!(matches!(end, Err(NoMinimum::Stopped(_))), "{end:?}");
        }
    }

    #[test]
    fn too_few_iterations_are_no_minimum() {
        let end = minimum(&Valley, &[-1.2, 1.0], &[FREE, FREE], 1);
        let Err(NoMinimum::Stopped(stopped)) = end else { panic!("{end:?}") };
        assert!(stopped.step > CONVERGED, "{stopped:?}");
    }
}
