//! The last step: velocities before the impact.

use super::VehicleEstimate;
use crate::frame::{Heading, Xy};
use crate::scalar::Real;

/// Returns CRASH3's approach velocity: the separation velocity less ΔV along the principal force, in ground axes, in m/s.
///
/// The yaw rate has no effect: the vehicle is a point mass.
pub fn approach_velocity<T: Real>(estimate: &VehicleEstimate<T>, heading: &Heading<T>, separation: Xy<T>) -> Xy<T> {
    separation - heading.to_ground(estimate.delta_v.clone())
}

#[cfg(test)]
mod tests {
    use super::super::{Damaged, DamagedPair, Surface};
    use super::*;
    use crate::frame::ForwardLeft;
    use crate::impact::ForceDirection;

    #[test]
    fn the_push_is_taken_back() {
        // Heading along y, pushed back from ahead by 4 m/s: 16 kJ in 2 t.
        let damaged = Damaged {
            mass: 2000.0,
            yaw_inertia: 3000.0,
            impact_center: ForwardLeft { forward: 2.0, left: 0.0 },
            surface: Surface::Front,
            force_direction: ForceDirection { ahead: 0.5, right: 0.0 },
            crush_energy: 16_000.0,
        };
        let estimate = DamagedPair { one: Some(damaged), two: None }.evaluate().one.expect("a vehicle");
        let approach = approach_velocity(&estimate, &Heading { cos: 0.0, sin: 1.0 }, Xy { x: 1.0, y: -0.5 });
        assert_eq!(approach, Xy { x: 1.0, y: 3.5 });
    }
}
