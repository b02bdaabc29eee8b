//! A vehicle on the ground: its inertia, heading, impact center and motion.

use crate::frame::{ForwardLeft, Heading, Xy};
use crate::scalar::{Field, Real};

/// Planar motion of a rigid body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion<T = f64> {
    /// Velocity of the center of mass, in m/s.
    pub velocity: Xy<T>,
    /// Yaw rate in rad/s, counter-clockwise.
    pub yaw_rate: T,
}

impl<T> Motion<T> {
    /// Returns V_x, V_y and the yaw rate.
    pub fn components(self) -> [T; 3] {
        [self.velocity.x, self.velocity.y, self.yaw_rate]
    }
}

/// A vehicle at the moment of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vehicle<T = f64> {
    /// Mass m in kg.
    pub mass: T,
    /// Yaw inertia I = m k² about the vertical through the center of mass, in kg m².
    pub yaw_inertia: T,
    /// Heading θ.
    pub heading: Heading<T>,
    /// The impact center C, relative to the center of mass, in m.
    pub impact_center: ForwardLeft<T>,
    /// Its motion before the impact.
    pub motion: Motion<T>,
}

/// One of the two parties of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// Converts the motion to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Motion<U> {
        Motion { velocity: self.velocity.map(&mut f), yaw_rate: f(self.yaw_rate) }
    }
}

impl<T: Field> Motion<T> {
    /// Returns the motion of a body at rest.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn rest() -> Self {
        Motion { velocity: Xy::zero(), yaw_rate: T::int(0) }
    }
}

impl<T> Vehicle<T> {
    /// Converts the vehicle to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
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

impl<T: Field> Default for Vehicle<T> {
    /// A vehicle at rest, headed along x, with its impact center at its center of mass. It has no mass and no yaw inertia: a collision with it is refused
    /// until it has both.
    fn default() -> Self {
        Vehicle::new(T::int(0), T::int(0))
    }
}

impl<T: Field> Vehicle<T> {
    /// Creates a vehicle with a mass in kg and a yaw inertia in kg m², headed along x, at rest, with its impact center at its center of mass.
    ///
    /// ```
    /// use planar_impact::{Collision, Heading, Vehicle};
    /// let car = Vehicle::new(1200.0, 1900.0).with_impact_center(1.8, 0.3).with_speed(15.0);
    /// let other = Vehicle::new(1500.0, 2600.0).with_heading(Heading::from_degrees(170.0)).with_impact_center(1.9, 0.4).with_speed(12.0);
    /// let impact = Collision::new(car, other).with_restitution(0.1).solve()?;
    /// assert!(impact.one.delta_v_magnitude() > impact.two.delta_v_magnitude());
    /// # Ok::<(), planar_impact::Refusals>(())
    /// ```
    #[must_use]
    pub fn new(mass: T, yaw_inertia: T) -> Self {
        Vehicle { mass, yaw_inertia, heading: Heading::along_x(), impact_center: ForwardLeft::zero(), motion: Motion::rest() }
    }

    /// Returns the same vehicle with another heading. Its velocity on the ground stays.
    #[must_use]
    pub fn with_heading(self, heading: Heading<T>) -> Self {
        Vehicle { heading, ..self }
    }

    /// Returns the same vehicle with its impact center ahead and to the left of the center of mass, in m.
    #[must_use]
    pub fn with_impact_center(self, forward: T, left: T) -> Self {
        Vehicle { impact_center: ForwardLeft { forward, left }, ..self }
    }

    /// Returns the same vehicle with a velocity along x and y, in m/s.
    #[must_use]
    pub fn with_velocity(self, velocity: Xy<T>) -> Self {
        Vehicle { motion: Motion { velocity, ..self.motion }, ..self }
    }

    /// Returns the same vehicle with a speed along its heading, in m/s. Give the heading first.
    #[must_use]
    pub fn with_speed(self, speed: T) -> Self {
        let velocity = self.heading.to_ground(ForwardLeft { forward: speed, left: T::int(0) });
        self.with_velocity(velocity)
    }

    /// Returns the same vehicle with a yaw rate, in rad/s.
    #[must_use]
    pub fn with_yaw_rate(self, yaw_rate: T) -> Self {
        Vehicle { motion: Motion { yaw_rate, ..self.motion }, ..self }
    }

    /// Returns the kinetic energy in a given motion, ½ m v² + ½ I ω², in J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn kinetic_energy(&self, motion: Motion<T>) -> T {
        (self.mass.clone() * motion.velocity.length_squared() + self.yaw_inertia.clone() * motion.yaw_rate.squared()).half()
    }
}

impl<T: Real> Vehicle<T> {
    /// Returns the radius of gyration about the center of mass, √(I/m), in m.
    ///
    /// ```
    /// use planar_impact::*;
    /// let vehicle: Vehicle = Vehicle {
    ///     mass: 1200.0,
    ///     yaw_inertia: 2700.0,
    ///     heading: Heading::from_angle(0.0),
    ///     impact_center: ForwardLeft { forward: 2.0, left: 0.0 },
    ///     motion: Motion::rest(),
    /// };
    /// assert_eq!(vehicle.radius_of_gyration(), 1.5);
    /// ```
    pub fn radius_of_gyration(&self) -> T {
        (self.yaw_inertia.clone() / self.mass.clone()).square_root()
    }
}

impl Vehicle {
    /// Returns `true` if its velocity is along its heading, up to a lateral share of its speed.
    pub fn drives_along_heading(&self, share: f64) -> bool {
        self.heading.to_vehicle(self.motion.velocity).left.abs() <= share * self.motion.velocity.length()
    }
}

impl<T> Party<T> {
    /// Converts the party to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Party<U> {
        match self {
            Party::Vehicle(vehicle) => Party::Vehicle(vehicle.map(f)),
            Party::Barrier => Party::Barrier,
        }
    }

    /// Returns the vehicle, or `None` for a barrier.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn vehicle(&self) -> Option<&Vehicle<T>> {
        match self {
            Party::Vehicle(vehicle) => Some(vehicle),
            Party::Barrier => None,
        }
    }
}

impl<T: Field> Party<T> {
    /// Returns its motion before the impact; at rest for a barrier.
    pub fn motion(&self) -> Motion<T> {
        self.vehicle().map_or_else(Motion::rest, |vehicle| vehicle.motion.clone())
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
        let turned = vehicle.with_speed(5.0).with_yaw_rate(2.0);
        assert_eq!(turned.motion, Motion { velocity: Xy { x: 5.0, y: 0.0 }, yaw_rate: 2.0 });
        assert_eq!(Vehicle { motion: vehicle.motion, ..turned }, vehicle);
    }

    #[test]
    fn a_vehicle_drives_along_its_heading_up_to_a_share() {
        let drives = |x, y| {
            let vehicle = Vehicle::new(2.0, 3.0).with_heading(Heading { cos: 0.0, sin: 1.0 });
            vehicle.with_velocity(Xy { x, y }).drives_along_heading(0.6)
        };
        // Of speed 5, forward and to either side.
        assert!(drives(0.0, 5.0) && drives(3.0, 4.0) && drives(-3.0, 4.0) && drives(-3.0, -4.0) && drives(0.0, 0.0));
        assert!(!drives(4.0, 3.0) && !drives(-4.0, 3.0));
    }
}
