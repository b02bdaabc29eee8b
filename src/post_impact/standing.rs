//! Whether the ground holds a vehicle that stands on a grade.
//!
//! The tires hold it if they have forces, each within its limits, that balance the push of the ground downhill in force and moment. All sums of such forces and
//! that push are a convex set, and it stands if zero is in it. E. G. Gilbert's method (SIAM J. Control 4, 1966) approaches the point of the set that is nearest
//! to zero, from the farthest point of each wheel's set in a direction alone.

use nalgebra::Vector3;

use super::slide::Slide;
use super::vehicle::Pose;
use crate::frame::{Heading, Xy};

/// Maximum number of steps; with a margin of a hundredth of the friction a few hundred suffice.
const STEPS: usize = 5_000;
/// Distance from balance, as a share of the push, that counts as balance.
const BALANCED: f64 = 1e-6;

impl Slide {
    /// Returns `true` if the ground holds the vehicle at rest in a pose: always on level ground, and on a grade if the tires can balance its push.
    pub fn stands(&self, pose: &Pose) -> bool {
        if self.ground.is_level() {
            return true;
        }
        let heading = Heading::from_angle(pose.heading);
        // A moment counts as a force at the radius of gyration.
        let radius = (self.vehicle.yaw_inertia / self.vehicle.mass).sqrt();
        let wheels = self.vehicle.standing(self.ground.gravity).map(|wheel| {
            let arm = heading.to_ground(wheel.place);
            (wheel, arm, self.ground.surface_at(&(pose.position + arm)))
        });
        let generalized = |arm: Xy, force: Xy| Vector3::new(force.x, force.y, arm.cross(force) / radius);
        let push: Vector3<f64> = wheels.iter().map(|(wheel, arm, surface)| generalized(*arm, surface.grade * -wheel.load)).sum();
        let farthest = |along: &Vector3<f64>| -> Vector3<f64> {
            let of_wheel = |(wheel, arm, surface): &(super::vehicle::Standing<f64>, Xy, super::Surface)| {
                let slip = Xy { x: along.x, y: along.y } + arm.quarter_turn() * (along.z / radius);
                let rolls_along = heading.turned_like(&wheel.rolls_along);
                let limits = self.vehicle.tires.limits(&wheel.restraint, surface.friction, wheel.load);
                generalized(*arm, rolls_along.to_ground(limits.farthest(rolls_along.to_vehicle(slip))))
            };
            push + wheels.iter().map(of_wheel).sum::<Vector3<f64>>()
        };
        let mut nearest = push;
        for _ in 0..STEPS {
            if nearest.norm() <= BALANCED * push.norm() {
                return true;
            }
            let other = farthest(&-nearest);
            // Every sum is on the same side of zero: nothing balances.
            if nearest.dot(&other) > 0.0 {
                return false;
            }
            let toward = other - nearest;
            nearest += toward * (-nearest.dot(&toward) / toward.norm_squared()).clamp(0.0, 1.0);
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Ground, SlidingVehicle, Wheel, Wheels};

    fn stands(wheels: Wheels<Wheel>, friction: f64, grade: Xy, heading: f64) -> bool {
        let slide = Slide { vehicle: SlidingVehicle::sedan(wheels), ground: Ground { grade, ..Ground::uniform(friction) } };
        slide.stands(&Pose { heading, ..Pose::default() })
    }

    const fn uphill(x: f64, y: f64) -> Xy {
        Xy { x, y }
    }

    #[test]
    fn locked_wheels_hold_up_to_their_friction_in_every_direction() {
        let locked = Wheels::all(Wheel::LOCKED);
        for heading in [0.0, 0.4, 2.0] {
            assert!(stands(locked, 0.3, uphill(0.2, 0.21), heading) && !stands(locked, 0.3, uphill(0.2, 0.23), heading));
        }
        assert!(stands(locked, 0.0, uphill(0.0, 0.0), 0.0) && !stands(locked, 0.0, uphill(1e-9, 0.0), 0.0));
    }

    #[test]
    fn rolling_wheels_hold_by_their_resistance_along_and_by_friction_across() {
        let rolling = Wheels::all(Wheel::ROLLING);
        assert!(stands(rolling, 0.7, uphill(0.0149, 0.0), 0.0) && !stands(rolling, 0.7, uphill(0.0151, 0.0), 0.0));
        assert!(stands(rolling, 0.7, uphill(0.0, 0.69), 0.0) && !stands(rolling, 0.7, uphill(0.0, 0.71), 0.0));
    }

    /// By hand: the rear axle of the sedan carries 1.2/2.7 of the weight, and the front wheels resist by 0.015 of 1.5/2.7.
    #[test]
    fn a_locked_axle_holds_by_the_load_on_it() {
        let parked = Wheels { rear_left: Wheel::LOCKED, rear_right: Wheel::LOCKED, ..Wheels::all(Wheel::ROLLING) };
        let most = 0.6 * 1.2 / 2.7 + 0.015 * 1.5 / 2.7;
        assert!(stands(parked, 0.6, uphill(most - 1e-3, 0.0), 0.0) && !stands(parked, 0.6, uphill(most + 1e-3, 0.0), 0.0));
        // One locked wheel at a corner: the front wheels balance its moment across.
        let one = Wheels { rear_left: Wheel::LOCKED, ..Wheels::all(Wheel::ROLLING) };
        assert!(stands(one, 0.6, uphill(0.1, 0.0), 0.0) && !stands(one, 0.6, uphill(0.3, 0.0), 0.0));
    }
}
