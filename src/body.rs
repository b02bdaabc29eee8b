//! A body in contact axes: n–t components, with inverse mass and inverse yaw inertia.
//!
//! With inverses a fixed barrier is exactly zero, and nothing divides by a mass or an inertia.

use crate::frame::{CrushPlane, Nt};
use crate::scalar::Field;
use crate::vehicle::Party;

/// A body in contact axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<T = f64> {
    /// 1/m in 1/kg. Zero for a body that cannot be moved.
    pub inverse_mass: T,
    /// 1/I in 1/(kg m²). Zero for a body that cannot be turned.
    pub inverse_yaw_inertia: T,
    /// r, from the center of mass to the impact center, in m.
    pub arm: Nt<T>,
    /// Velocity of the center of mass, in m/s.
    pub velocity: Nt<T>,
    /// Yaw rate in rad/s.
    pub yaw_rate: T,
}

impl<T> Body<T> {
    /// Converts the body to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Body<U> {
        Body {
            inverse_mass: f(self.inverse_mass),
            inverse_yaw_inertia: f(self.inverse_yaw_inertia),
            arm: self.arm.map(&mut f),
            velocity: self.velocity.map(&mut f),
            yaw_rate: f(self.yaw_rate),
        }
    }
}

impl<T: Field> Body<T> {
    /// Returns a vehicle or a barrier in contact axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn seen_from(plane: &CrushPlane<T>, party: &Party<T>) -> Self {
        match party {
            Party::Barrier => Body::fixed(),
            Party::Vehicle(vehicle) => Body {
                inverse_mass: vehicle.mass.clone().inv(),
                inverse_yaw_inertia: vehicle.yaw_inertia.clone().inv(),
                arm: plane.to_contact(vehicle.heading.to_ground(vehicle.impact_center.clone())),
                velocity: plane.to_contact(vehicle.motion.velocity.clone()),
                yaw_rate: vehicle.motion.yaw_rate.clone(),
            },
        }
    }

    /// Returns a fixed barrier. It has no center of mass: its reference point is the impact center.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn fixed() -> Self {
        Body { inverse_mass: T::int(0), inverse_yaw_inertia: T::int(0), arm: Nt::zero(), velocity: Nt::zero(), yaw_rate: T::int(0) }
    }

    /// Returns the velocity of its point at the impact center, v + ω × r.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn velocity_at_center(&self) -> Nt<T> {
        self.velocity.clone() + self.arm.clone().quarter_turn() * self.yaw_rate.clone()
    }

    /// Returns the change of velocity from an impulse: P/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn delta_v(&self, impulse: Nt<T>) -> Nt<T> {
        impulse * self.inverse_mass.clone()
    }

    /// Returns the change of yaw rate from an impulse at the impact center, (r × P)/I.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn delta_yaw_rate(&self, impulse: Nt<T>) -> T {
        self.arm.clone().cross(impulse) * self.inverse_yaw_inertia.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spinning_body_carries_its_contact_point_along() {
        let body = Body {
            inverse_mass: 0.5,
            inverse_yaw_inertia: 0.25,
            arm: Nt { n: 2.0, t: -1.0 },
            velocity: Nt { n: 10.0, t: 20.0 },
            yaw_rate: 3.0,
        };
        assert_eq!(body.velocity_at_center(), Nt { n: 13.0, t: 26.0 });
        assert_eq!(body.delta_v(Nt { n: -4.0, t: 1.0 }), Nt { n: -2.0, t: 0.5 });
        assert_eq!(body.delta_yaw_rate(Nt { n: -4.0, t: 1.0 }), (2.0 * 1.0 - 4.0) / 4.0);
    }

    #[test]
    fn no_impulse_moves_a_barrier() {
        let wall = Body::<f64>::fixed();
        assert_eq!(wall.delta_v(Nt { n: 1e9, t: 1e9 }), Nt::zero());
        assert_eq!(wall.delta_yaw_rate(Nt { n: 1e9, t: 1e9 }), 0.0);
        assert_eq!(wall.velocity_at_center(), Nt::zero());
    }
}
