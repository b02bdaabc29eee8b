//! Forces of the ground on a moving vehicle: its equations of motion.

use super::ground::{Ground, Surface};
use super::vehicle::{Pose, SlidingVehicle, Standing};
use crate::frame::{Heading, Xy};
use crate::scalar::Real;
use crate::vehicle::Motion;

/// A vehicle and the ground it slides on.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide<T = f64> {
    /// The vehicle.
    pub vehicle: SlidingVehicle<T>,
    /// The ground.
    pub ground: Ground<T>,
}

/// Forces of the ground on a vehicle in one pose and motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag<T = f64> {
    /// The force on it, in N: that of the tires, and the push of the ground downhill.
    pub force: Xy<T>,
    /// The moment about its center of mass, in N m.
    pub moment: T,
    /// The power that the tires dissipate, in W: their forces against the velocities of their contacts.
    pub dissipation: T,
    /// The power that goes into height, in W; below zero downhill.
    pub climb: T,
}

impl<T> Slide<T> {
    /// Converts the slide to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Slide<U> {
        Slide { vehicle: self.vehicle.map(&mut f), ground: self.ground.map(f) }
    }
}

impl<T: Real<Mask = bool>> Slide<T> {
    /// Computes the forces of the ground on the vehicle: at each wheel the force of [`Tires::force`](super::Tires::force) with the velocity v + ω × r of its
    /// contact, and its load times the grade, downhill.
    pub fn drag(&self, pose: &Pose<T>, motion: &Motion<T>) -> Drag<T> {
        self.drag_of(&self.standing(), pose, motion)
    }

    /// Returns its wheels, which are the same along all of its way.
    pub(super) fn standing(&self) -> [Standing<T>; 4] {
        self.vehicle.standing(self.ground.gravity.clone())
    }

    pub(super) fn drag_of(&self, wheels: &[Standing<T>; 4], pose: &Pose<T>, motion: &Motion<T>) -> Drag<T> {
        let heading = Heading::from_angle(pose.heading.clone());
        let mut drag = Drag { force: Xy::zero(), moment: T::int(0), dissipation: T::int(0), climb: T::int(0) };
        for Standing { restraint, rolls_along, place, load } in wheels {
            let arm = heading.to_ground(place.clone());
            let velocity = motion.velocity.clone() + arm.clone().quarter_turn() * motion.yaw_rate.clone();
            let rolls_along = heading.clone().turned_like(rolls_along);
            let Surface { friction, grade } = self.ground.surface_at(&(pose.position.clone() + arm.clone()));
            let uphill = grade * load.clone();
            let slip = rolls_along.to_vehicle(velocity.clone());
            let force = rolls_along.to_ground(self.vehicle.tires.force(restraint, friction, load.clone(), slip));
            drag.dissipation = drag.dissipation - force.clone().dot(velocity.clone());
            drag.climb = drag.climb + uphill.clone().dot(velocity);
            let force = force - uphill;
            drag.moment = drag.moment + arm.cross(force.clone());
            drag.force += force;
        }
        drag
    }

    /// Returns the rate of change of its motion: velocity and yaw rate per second.
    pub fn acceleration(&self, pose: &Pose<T>, motion: &Motion<T>) -> Motion<T> {
        self.acceleration_by(&self.drag(pose, motion))
    }

    pub(super) fn acceleration_by(&self, drag: &Drag<T>) -> Motion<T> {
        Motion {
            velocity: drag.force.clone() * self.vehicle.mass.clone().inv(),
            yaw_rate: drag.moment.clone() / self.vehicle.yaw_inertia.clone(),
        }
    }

    /// Returns the kinetic energy, in J.
    pub fn kinetic_energy(&self, motion: &Motion<T>) -> T {
        let vehicle = &self.vehicle;
        (vehicle.mass.clone() * motion.velocity.clone().length_squared() + vehicle.yaw_inertia.clone() * motion.yaw_rate.clone().squared())
            .half()
    }
}
