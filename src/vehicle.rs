//! What is known of a vehicle on the ground: its inertia, where it points, where it is hit, and how it moves.

use crate::frame::{ForwardLeft, Heading, Xy};
use crate::scalar::Field;

/// How a rigid body moves in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<T = f64> {
    /// Velocity of the center of mass, in m/s.
    pub velocity: Xy<T>,
    /// Yaw rate in rad/s, counter-clockwise.
    pub yaw_rate: T,
}

/// A vehicle as it is when the vehicles touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vehicle<T = f64> {
    /// Mass m in kg.
    pub mass: T,
    /// Yaw inertia I = m k² about the vertical through the center of mass, in kg m².
    pub yaw_inertia: T,
    /// Where it points, θ.
    pub heading: Heading<T>,
    /// The impact center C, from the center of mass, in m.
    pub impact_center: ForwardLeft<T>,
    /// Its motion before the impact.
    pub motion: Motion<T>,
}

/// One of the two that collide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Party<T = f64> {
    /// A vehicle, free to move.
    Vehicle(Vehicle<T>),
    /// A barrier fixed to the ground: it takes any impulse and does not move.
    Barrier,
}

impl<T> From<Vehicle<T>> for Party<T> {
    fn from(vehicle: Vehicle<T>) -> Self {
        Party::Vehicle(vehicle)
    }
}

impl<T> Motion<T> {
    /// The same motion on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Motion<U> {
        Motion { velocity: self.velocity.map(&mut f), yaw_rate: f(self.yaw_rate) }
    }
}

impl<T: Field> Motion<T> {
    /// At rest.
    #[inline(always)]
    pub fn rest() -> Self {
        Motion { velocity: Xy::zero(), yaw_rate: T::int(0) }
    }
}

impl<T> Vehicle<T> {
    /// The same vehicle on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Vehicle<U> {
        Vehicle {
            mass: f(self.mass),
            yaw_inertia: f(self.yaw_inertia),
            heading: self.heading.map(&mut f),
            impact_center: self.impact_center.map(&mut f),
            motion: self.motion.map(f),
        }
    }
}

impl<T: Field> Vehicle<T> {
    /// Kinetic energy in a given motion, ½ m v² + ½ I ω², in J.
    #[inline(always)]
    pub fn kinetic_energy(&self, motion: Motion<T>) -> T {
        (self.mass.clone() * motion.velocity.length_squared() + self.yaw_inertia.clone() * motion.yaw_rate.squared()).half()
    }
}

impl<T> Party<T> {
    /// The same party on another scalar.
    #[inline(always)]
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Party<U> {
        match self {
            Party::Vehicle(vehicle) => Party::Vehicle(vehicle.map(f)),
            Party::Barrier => Party::Barrier,
        }
    }

    /// The vehicle, if it is one.
    #[inline(always)]
    pub fn vehicle(&self) -> Option<&Vehicle<T>> {
        match self {
            Party::Vehicle(vehicle) => Some(vehicle),
            Party::Barrier => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinetic_energy_of_a_spinning_vehicle() {
        let vehicle = Vehicle {
            mass: 2.0,
            yaw_inertia: 3.0,
            heading: Heading { cos: 1.0, sin: 0.0 },
            impact_center: ForwardLeft { forward: 1.0, left: 0.0 },
            motion: Motion::rest(),
        };
        let motion = Motion { velocity: Xy { x: 3.0, y: 4.0 }, yaw_rate: 2.0 };
        assert_eq!(vehicle.kinetic_energy(motion), 25.0 + 6.0);
        assert_eq!(vehicle.kinetic_energy(vehicle.motion), 0.0);
        assert_eq!(Party::from(vehicle).vehicle(), Some(&vehicle));
        assert_eq!(Party::<f64>::Barrier.vehicle(), None);
    }
}
