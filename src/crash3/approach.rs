//! The last step: back to the velocities before the impact.

use super::VehicleEstimate;
use crate::frame::{Heading, Xy};
use crate::scalar::Real;

/// CRASH3's approach velocity: the separation velocity less ΔV along the principal force, in ground axes, in m/s.
///
/// The yaw rate plays no part in it: the vehicle is a point that is pushed.
pub fn approach_velocity<T: Real>(estimate: &VehicleEstimate<T>, heading: &Heading<T>, separation: Xy<T>) -> Xy<T> {
    separation - heading.to_ground(estimate.delta_v.clone())
}
