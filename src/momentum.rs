//! Momentum alone: the impact of a given impulse, without restitution, impulse ratio or contact.
//!
//! Whatever happens between two vehicles, each gets the opposite of the other's impulse:
//!
//! ```text
//! m₁ V₁ = m₁ v₁ + P      m₂ V₂ = m₂ v₂ − P
//! ```
//!
//! Speeds before an impact follow from velocities after it and the directions of approach, unless these are parallel. With yaw inertias and impact centers
//! the same impulse also changes the yaw rates.
//!
//! | property | test in `proptests/momentum.rs` |
//! |---|---|
//! | the impact of the impulse of an impact is that impact | `the_impulse_of_an_impact_makes_it_again` |
//! | with the normal along its impulse an impact has no tangential part, the same motions and the same loss | `along_its_impulse_an_impact_has_no_tangential_part` |
//! | the speeds found have the momentum of the velocities after | `approach_speeds_have_the_momentum_after` |

use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Xy};
use crate::impact::Impact;
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::refusal::{Refusal, Refusals};
use crate::scalar::{Field, Ordered, Real};
use crate::vehicle::Vehicle;

impl<T: Field> Collision<T> {
    /// Returns the impact of an impulse on vehicle 1, in ground axes and N s, whatever restitution and impulse ratio the collision gives.
    pub fn impact_by(&self, impulse: Xy<T>) -> Impact<T> {
        self.impact_by_at(&self.contact(), impulse)
    }

    /// The same with the contact of this collision.
    pub(crate) fn impact_by_at(&self, contact: &Contact<T>, impulse: Xy<T>) -> Impact<T> {
        self.impact_of(contact, self.crush_plane.to_contact(impulse), None)
    }
}

impl<T: Ordered<Mask = bool>> Collision<T> {
    /// Returns the impact of an impulse on vehicle 1, as [`Collision::impact_by`], and checks that it is possible by momentum alone.
    ///
    /// # Errors
    ///
    /// Inputs that are no numbers or out of range, a result that overflows, and a gain of energy.
    pub fn solve_by(&self, impulse: Xy<T>) -> Result<Impact<T>, Refusals<T>> {
        self.check_inputs()?;
        let impact = self.impact_by(impulse);
        if !impact.is_finite() {
            return Err(Refusal::OutOfFloatRange.into());
        }
        if impact.gains_energy() {
            return Err(Refusal::EnergyGain { gain: -impact.loss(), before: impact.kinetic_energy.before }.into());
        }
        Ok(impact)
    }
}

impl<T: Real> Collision<T> {
    /// Returns the collision with the normal of its crush plane along an impulse on vehicle 1, and the restitution and the impulse ratio that go with it. Its
    /// impact is that of the impulse; the restitution is −V_n/v_n of the impact centers, and need not lie between 0 and 1: vehicles that slide past each other
    /// still approach along the impulse after it.
    #[must_use]
    pub fn along_impulse(&self, impulse: Xy<T>) -> Self {
        let size = impulse.clone().length();
        let crush_plane = CrushPlane { cos: impulse.x.clone() / size.clone(), sin: impulse.y.clone() / size };
        let turned = Collision { crush_plane, law: Law::Brach, moment: Moment::None, ..self.clone() };
        let impact = turned.impact_by(impulse);
        let restitution = T::int(0) - impact.separation.n / impact.approach.n;
        Collision { restitution, impulse_ratio: ImpulseRatio::Given(T::int(0)), ..turned }
    }
}

/// Returns the speeds of two vehicles along their headings, in m/s, that have the momentum of the velocities after the impact:
/// m₁ v₁ h₁ + m₂ v₂ h₂ = m₁ V₁ + m₂ V₂ with the unit vectors h of the headings. Parallel headings divide by zero: they leave one speed open.
///
/// Daily, Shigemura and Daily (Fundamentals of Traffic Crash Reconstruction, 2006) call it the momentum method; its vector form is the parallelogram of
/// momenta.
///
/// ```
/// use planar_impact::momentum::approach_speeds;
/// use planar_impact::{Heading, Vehicle, Xy};
///
/// // 4220 lb eastbound and 3875 lb northbound, speeds in mph.
/// let one = Vehicle::new(4220.0, 1.0).with_heading(Heading::from_angle(0.0));
/// let two = Vehicle::new(3875.0, 1.0).with_heading(Heading::from_angle(std::f64::consts::FRAC_PI_2));
/// let [v1, v2] = approach_speeds([&one, &two], [Xy { x: 14.0, y: 16.0 }, Xy { x: 12.0, y: 19.0 }]);
/// assert!((v1 - 25.0).abs() < 0.05 && (v2 - 36.4).abs() < 0.05);
/// ```
pub fn approach_speeds<T: Field>(vehicles: [&Vehicle<T>; 2], after: [Xy<T>; 2]) -> [T; 2] {
    let [one, two] = vehicles;
    let [after_1, after_2] = after;
    let momentum = after_1 * one.mass.clone() + after_2 * two.mass.clone();
    let (along_1, along_2) = (one.heading.ahead(), two.heading.ahead());
    let across = along_1.clone().cross(along_2.clone());
    [momentum.clone().cross(along_2) / (across.clone() * one.mass.clone()), along_1.cross(momentum) / (across * two.mass.clone())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Vehicle;

    /// An impulse alone has no moment, whatever the contact had before.
    #[test]
    fn along_an_impulse_there_is_no_moment() {
        let car = |speed| Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(speed);
        let collision = Collision::new(car(10.0), car(2.0)).with_moment(Moment::Given(500.0));
        assert_eq!(collision.along_impulse(Xy { x: -3000.0, y: 400.0 }).moment, Moment::None);
    }
}
