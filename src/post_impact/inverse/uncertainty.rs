//! The uncertainty of the motion that an inverse problem found.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{SCALES, motion};
use crate::least_squares;
use crate::post_impact::evidence::{MotionCovariance, NoSeparation, RestEvidence};
use crate::post_impact::variation::{Slopes, VARIED};
use crate::vehicle::Motion;

/// Share of the largest singular value below which a direction does not change the pose at rest.
const NOTHING: f64 = 1e-8;

/// Uncertainty of a motion: its covariance, and the part from the friction alone.
pub(super) struct Uncertain {
    pub(super) covariance: MotionCovariance,
    pub(super) by_friction: Motion,
}

/// Returns the covariance of the motion from that of pose and points, which is 1 in standard deviations, and from the friction: with J the derivatives by
/// the motion and j those by the friction, A = (JᵀJ)⁻¹ Jᵀ and C = A (1 + j σ² jᵀ) Aᵀ. With more friction, the motion that ends in the same pose changes by −A
/// j.
pub(super) fn uncertainty(slopes: &[Slopes], evidence: &RestEvidence) -> Result<Uncertain, NoSeparation> {
    let scales = Matrix3::from_diagonal(&Vector3::from(SCALES));
    let jacobian = DMatrix::from_fn(slopes.len(), 3, |i, k| slopes[i][k] * SCALES[k]);
    let by_friction_is_finite = slopes.iter().all(|slopes| slopes[VARIED - 1].is_finite());
    let Some(found) = least_squares::SingularValues::of(jacobian).filter(|_| by_friction_is_finite) else {
        return Err(NoSeparation::NotDetermined { along: Motion::rest() });
    };
    let weakest = found.least();
    let is_determined = found.values[weakest] > NOTHING * found.greatest();
    if !is_determined {
        let along = (scales * Vector3::from_vec(found.direction(weakest))).normalize();
        return Err(NoSeparation::NotDetermined { along: motion(along.as_slice()) });
    }
    let back = scales * found.inverse();
    let by_friction = -&back * DVector::from_fn(slopes.len(), |i, _| slopes[i][VARIED - 1]) * evidence.friction_deviation;
    let covariance = &back * back.transpose() + by_friction * by_friction.transpose();
    let covariance = MotionCovariance(core::array::from_fn(|i| core::array::from_fn(|k| covariance[(i, k)])));
    Ok(Uncertain { covariance, by_friction: motion(by_friction.as_slice()) })
}
