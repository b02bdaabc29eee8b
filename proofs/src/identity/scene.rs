//! Collisions and their impacts, for use in identities.

use planar_impact::law::impulse_at_ratio;
use planar_impact::{Body, Collision, Contact, Field, Impact, Law, Moment, Motion, Nt, Party, Response, Vehicle, Xy};

use crate::free::Free;

/// A collision, its contact, and the result of an impact.
pub(crate) struct Scene<T> {
    pub(crate) collision: Collision<T>,
    pub(crate) contact: Contact<T>,
    pub(crate) impact: Impact<T>,
}

/// A vehicle of a scene, before and after the impact.
pub(crate) struct Side<'a, T> {
    pub(crate) vehicle: &'a Vehicle<T>,
    pub(crate) response: &'a Response<T>,
    /// 1 for vehicle 1, −1 for vehicle 2: the sign of impulse and moment impulse.
    pub(crate) sign: T,
}

impl<T: Field> Scene<T> {
    /// Creates the scene of a given impulse and moment impulse.
    pub(crate) fn by(collision: Collision<T>, impulse: Nt<T>, moment: Option<T>) -> Self {
        let contact = collision.contact();
        let impact = collision.impact_of(&contact, impulse, moment);
        Scene { collision, contact, impact }
    }

    /// Creates a scene with any impulse, regardless of the law.
    pub(crate) fn by_any_impulse(free: &mut Free<'_, T>, collision: Collision<T>) -> Self {
        let impulse = free.nt();
        Scene::by(collision, impulse, None)
    }

    /// Creates a scene with any impulse and any moment impulse.
    pub(crate) fn by_any_moment(free: &mut Free<'_, T>, collision: Collision<T>) -> Self {
        let (impulse, moment) = (free.nt(), free.variable());
        Scene::by(collision, impulse, Some(moment))
    }

    /// Creates scenes of two vehicles and of one against a barrier, with any impulse, without a moment impulse and with any.
    pub(crate) fn by_anything(free: &mut Free<'_, T>) -> [Self; 4] {
        let [pair, barrier] = free.collisions();
        [
            Scene::by_any_impulse(free, pair.clone()),
            Scene::by_any_moment(free, pair),
            Scene::by_any_impulse(free, barrier.clone()),
            Scene::by_any_moment(free, barrier),
        ]
    }

    /// Creates the scene of the sticking impulse under the collision's law, with the collision's moment impulse.
    pub(crate) fn sticking(collision: Collision<T>) -> Self {
        let contact = collision.contact();
        let moment = collision.moment_impulse(&contact);
        let change = collision.sticking_change(&contact, moment.as_ref());
        let impulse = contact.compliance.impulse_for(change);
        Scene::by(collision, impulse, moment)
    }

    /// Creates the scene of the impulse at a given ratio, with the collision's moment impulse.
    pub(crate) fn at_ratio(collision: Collision<T>, ratio: T) -> Self {
        let contact = collision.contact();
        let moment = collision.moment_impulse(&contact);
        let change = collision.sticking_change(&contact, moment.as_ref());
        let impulse = impulse_at_ratio(&contact.compliance, change.n, ratio);
        Scene::by(collision, impulse, moment)
    }

    /// Returns its vehicles; a barrier is not one.
    pub(crate) fn sides(&self) -> Vec<Side<'_, T>> {
        let sides = [(&self.collision.one, &self.impact.one, T::int(1)), (&self.collision.two, &self.impact.two, T::int(-1))];
        let vehicles = sides.into_iter().filter_map(|(party, response, sign)| Some(Side { vehicle: party.vehicle()?, response, sign }));
        vehicles.collect()
    }

    /// Returns the collision that starts with the motions at the end of this one, each transformed by a function.
    pub(crate) fn continued(&self, motion: impl Fn(Motion<T>) -> Motion<T>) -> Collision<T> {
        let party = |party: &Party<T>, response: &Response<T>| match party {
            Party::Vehicle(vehicle) => Vehicle { motion: motion(response.after.clone()), ..vehicle.clone() }.into(),
            Party::Barrier => Party::Barrier,
        };
        let (one, two) = (party(&self.collision.one, &self.impact.one), party(&self.collision.two, &self.impact.two));
        Collision { one, two, ..self.collision.clone() }
    }

    /// Returns the bodies after the impact, in n-t axes.
    pub(crate) fn bodies_after(&self) -> [Body<T>; 2] {
        let moved = |body: &Body<T>, response: &Response<T>| Body {
            velocity: self.collision.crush_plane.to_contact(response.after.velocity.clone()),
            yaw_rate: response.after.yaw_rate.clone(),
            ..body.clone()
        };
        [moved(&self.contact.one, &self.impact.one), moved(&self.contact.two, &self.impact.two)]
    }
}

impl<T: Field> Side<'_, T> {
    /// Returns the vector from the center of mass to the impact center, in ground axes.
    pub(crate) fn arm(&self) -> Xy<T> {
        self.vehicle.heading.to_ground(self.vehicle.impact_center.clone())
    }

    /// Returns the change of its linear momentum.
    pub(crate) fn momentum_gained(&self) -> Xy<T> {
        (self.response.after.velocity.clone() - self.vehicle.motion.velocity.clone()) * self.vehicle.mass.clone()
    }

    /// Returns the change of its spin, I (Ω − ω).
    pub(crate) fn spin_gained(&self) -> T {
        self.vehicle.yaw_inertia.clone() * (self.response.after.yaw_rate.clone() - self.vehicle.motion.yaw_rate.clone())
    }

    /// Returns the change of its angular momentum about the impact center, relative to which its center of mass is at −r.
    pub(crate) fn angular_momentum_gained(&self) -> T {
        self.spin_gained() - self.arm().cross(self.momentum_gained())
    }
}

/// Sets e = 0, which is the common velocity if the impulse is a sticking one.
pub(crate) fn inelastic<T: Field>(collision: Collision<T>) -> Collision<T> {
    Collision { restitution: T::int(0), ..collision }
}

/// Selects the law of Kudlich and Slibar.
pub(crate) fn kudlich_slibar<T>(collision: Collision<T>) -> Collision<T> {
    Collision { law: Law::KudlichSlibar, ..collision }
}

/// Sets a moment impulse.
pub(crate) fn with_moment<T>(collision: Collision<T>, moment: Moment<T>) -> Collision<T> {
    Collision { moment, ..collision }
}

/// Transforms each vehicle of a collision by a function.
pub(crate) fn each_vehicle<T: Field>(collision: Collision<T>, f: impl Fn(Vehicle<T>) -> Vehicle<T>) -> Collision<T> {
    let party = |party| match party {
        Party::Vehicle(vehicle) => Party::Vehicle(f(vehicle)),
        Party::Barrier => Party::Barrier,
    };
    Collision { one: party(collision.one), two: party(collision.two), ..collision }
}
