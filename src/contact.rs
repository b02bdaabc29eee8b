//! Two bodies at the impact center: their approach velocity there, and their separation velocity after an impulse.

use crate::body::Body;
use crate::compliance::Compliance;
use crate::frame::Nt;
use crate::scalar::Field;

/// The contact between two bodies, before the impact.
///
/// The impulse P acts on body one, −P on body two. Relative quantities are those of body two less those of body one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<T = f64> {
    /// Body one.
    pub one: Body<T>,
    /// Body two.
    pub two: Body<T>,
    /// Compliance at the impact center.
    pub compliance: Compliance<T>,
    /// Relative velocity at the impact center before the impact, v_2C − v_1C.
    pub approach: Nt<T>,
}

/// Returns the relative velocity of two bodies at the impact center, v_2C − v_1C.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn relative_velocity<T: Field>(one: &Body<T>, two: &Body<T>) -> Nt<T> {
    two.velocity_at_center() - one.velocity_at_center()
}

impl<T: Field> Contact<T> {
    /// Creates the contact between two bodies.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn between(one: Body<T>, two: Body<T>) -> Self {
        let compliance = Compliance::between(&one, &two);
        let approach = relative_velocity(&one, &two);
        Contact { one, two, compliance, approach }
    }

    /// Returns the relative velocity at the impact center after an impulse, V = v − K P.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn separation(&self, impulse: Nt<T>) -> Nt<T> {
        self.approach.clone() - self.compliance.velocity_change(impulse)
    }

    /// Returns the vector from the center of mass of body one to that of body two. A barrier's reference point is the impact center.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn offset(&self) -> Nt<T> {
        self.one.arm.clone() - self.two.arm.clone()
    }

    /// Returns the energy lost to an impulse, T_L = P·v − ½ P·K P. It is a concave function of the impulse, and its maximum is the [loss at common
    /// velocity](Contact::greatest_loss).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn loss(&self, impulse: Nt<T>) -> T {
        impulse.clone().dot(self.approach.clone() + self.separation(impulse)).half()
    }

    /// Returns the impulse after which the bodies have a common velocity at the impact center, K⁻¹ v, which is that of e = 0 and μ = μ₀.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn common_velocity_impulse(&self) -> Nt<T> {
        self.compliance.impulse_for(self.approach.clone())
    }

    /// Returns the greatest loss of any impulse, ½ v·K⁻¹v, at common velocity. It does not depend on Γ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn greatest_loss(&self) -> T {
        self.approach.clone().dot(self.common_velocity_impulse()).half()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mass(inverse_mass: f64, velocity: Nt) -> Body {
        Body { inverse_mass, inverse_yaw_inertia: 1.0, arm: Nt::zero(), velocity, yaw_rate: 0.0 }
    }

    #[test]
    fn two_equal_point_masses_meet() {
        let contact = Contact::between(mass(1.0, Nt { n: 3.0, t: 0.0 }), mass(1.0, Nt { n: -1.0, t: 0.0 }));
        assert_eq!(contact.approach, Nt { n: -4.0, t: 0.0 });
        let impulse = contact.common_velocity_impulse();
        assert_eq!(impulse, Nt { n: -2.0, t: 0.0 });
        assert_eq!(contact.separation(impulse), Nt::zero());
        assert_eq!(contact.greatest_loss(), 4.0);
        assert_eq!(contact.loss(impulse), 4.0);
        assert_eq!(contact.loss(impulse * 2.0), 0.0);
        assert_eq!(contact.loss(impulse * 3.0), -12.0);
    }
}
