//! The moment impulse: a third component of the contact, about the vertical through the impact center.
//!
//! Vehicles that are locked together over a wide contact transmit a couple as well as a force. It is off by default. With it the compliance has a third row:
//! with ω_r the relative yaw rate,
//!
//! ```text
//! K_nm = −Σ r_t/I      K_tm = Σ r_n/I      K_mm = Σ 1/I
//! change of (v_n, v_t, ω_r) = K₃ (P_n, P_t, M)
//! ```
//!
//! The **critical moment** is that of the impact in which sliding and relative rotation both end. The paper leaves the moment out, and suggests it as the
//! cause of the yaw rates of Table B1 (its reference 20).

use crate::contact::Contact;
use crate::frame::Nt;
use crate::scalar::Field;

/// The moment impulse M on body one; body two gets −M.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Moment<T = f64> {
    /// The contact transmits no couple.
    #[default]
    None,
    /// A given moment impulse in N m s, counter-clockwise positive.
    Given(T),
    /// A fraction, from 0 to 1, of the critical moment.
    OfCritical(T),
}

/// The third row of the compliance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MomentCompliance<T = f64> {
    /// Change of relative velocity by a moment, and of relative yaw rate by an impulse, in 1/(kg m).
    pub force: Nt<T>,
    /// Change of relative yaw rate by a moment, in 1/(kg m²).
    pub moment: T,
}

impl<T> Moment<T> {
    /// Converts the moment to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Moment<U> {
        match self {
            Moment::None => Moment::None,
            Moment::Given(moment) => Moment::Given(f(moment)),
            Moment::OfCritical(fraction) => Moment::OfCritical(f(fraction)),
        }
    }
}

impl<T: Field> Contact<T> {
    /// Returns the third row of the compliance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn moment_compliance(&self) -> MomentCompliance<T> {
        let (one, two) = (&self.one, &self.two);
        let (j1, j2) = (one.inverse_yaw_inertia.clone(), two.inverse_yaw_inertia.clone());
        MomentCompliance { force: (one.arm.clone() * j1.clone() + two.arm.clone() * j2.clone()).quarter_turn(), moment: j1 + j2 }
    }

    /// Returns the relative yaw rate before the impact, ω_2 − ω_1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn relative_yaw_rate(&self) -> T {
        self.two.yaw_rate.clone() - self.one.yaw_rate.clone()
    }

    /// Returns the moment of the impact whose impulse and moment together cause the change `change` of relative velocity and the change `yaw` of relative yaw
    /// rate: M = (yaw − k·K⁻¹change)/(K_mm − k·K⁻¹k), with k the force part of the third row.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn moment_for(&self, change: Nt<T>, yaw: T) -> T {
        let row = self.moment_compliance();
        let by_force = row.force.clone().dot(self.compliance.impulse_for(change));
        let stiffened = row.force.clone().dot(self.compliance.impulse_for(row.force));
        (yaw - by_force) / (row.moment - stiffened)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;

    #[test]
    fn the_critical_moment_solves_all_three_rows() {
        let one = Body {
            inverse_mass: 0.5_f64,
            inverse_yaw_inertia: 0.25,
            arm: Nt { n: 2.0, t: -1.0 },
            velocity: Nt { n: 6.0, t: 1.0 },
            yaw_rate: 3.0,
        };
        let two = Body { arm: Nt { n: -1.0, t: 0.5 }, yaw_rate: -1.0, inverse_mass: 0.125, ..one };
        let contact = Contact::between(one, two);
        let change = contact.approach;
        let yaw = contact.relative_yaw_rate();
        let moment = contact.moment_for(change, yaw);
        let row = contact.moment_compliance();
        let impulse = contact.compliance.impulse_for(change - row.force * moment);
        let after_n = contact.separation(impulse) - row.force * moment;
        let after_yaw = yaw - row.force.dot(impulse) - row.moment * moment;
        assert!(after_n.length() < 1e-14 && after_yaw.abs() < 1e-14);
        // Without the moment they would still rotate relative to each other.
        let without = yaw - row.force.dot(contact.common_velocity_impulse());
        assert!(without.abs() > 0.1);
    }
}
