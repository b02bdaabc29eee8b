//! Numbers of a record, identified by name.

use super::resolution_group::ResolutionGroup;
use crate::catalogue::catalogue;
use crate::input::Side;
use crate::measure::Measure;

catalogue! {
    /// A number of a record.
    ///
    /// Its name is the heading of its column in a table of records, and the key of its own resolution.
    ///
    /// ```
    /// use planar_impact::Side;
    /// use planar_impact::check::{Key, ResolutionGroup};
    /// assert_eq!(Key::AfterX(Side::One).name(), "b1.after.vx");
    /// assert_eq!(Key::named("reported.ees.2"), Some(Key::EquivalentEnergySpeed(Side::Two)));
    /// assert_eq!(Key::AfterX(Side::One).group(), ResolutionGroup::Velocity);
    /// ```
    pub enum Key after "",
    /// Returns the group that shares its resolution.
    group: ResolutionGroup {
        of each vehicle {
            /// Mass in kg.
            Mass = "b" _ ".mass", Mass;
            /// Yaw inertia about the center of mass in kg m².
            YawInertia = "b" _ ".yaw_inertia", YawInertia;
            /// Heading of the body from x, in rad. Needed only for a direction of force.
            Heading = "b" _ ".heading", Angle;
            /// Center of mass along x, in m.
            CenterX = "b" _ ".cgx", Length;
            /// Center of mass along y, in m.
            CenterY = "b" _ ".cgy", Length;
            /// Velocity of the center of mass along x before the impact, in m/s.
            BeforeX = "b" _ ".before.vx", Velocity;
            /// The same along y.
            BeforeY = "b" _ ".before.vy", Velocity;
            /// Yaw rate before the impact in rad/s.
            BeforeYawRate = "b" _ ".before.yaw_rate", YawRate;
            /// Velocity of the center of mass along x after the impact, in m/s.
            AfterX = "b" _ ".after.vx", Velocity;
            /// The same along y.
            AfterY = "b" _ ".after.vy", Velocity;
            /// Yaw rate after the impact in rad/s.
            AfterYawRate = "b" _ ".after.yaw_rate", YawRate;
            /// Center of mass along x after the contact, in m.
            CenterAfterX = "b" _ ".after.cgx", Length;
            /// The same along y.
            CenterAfterY = "b" _ ".after.cgy", Length;
            /// Magnitude of a body's change of velocity, in m/s.
            DeltaV = "reported.delta_v." _, Velocity;
            /// Direction that the force on a body comes from, clockwise from its heading, in rad.
            ForceDirection = "reported.pdof." _, Angle;
            /// Equivalent energy speed of a body in m/s.
            EquivalentEnergySpeed = "reported.ees." _, Velocity;
        }
        of the pair {
            /// Contact point along x, in m.
            PointX = "contact.px", Length;
            /// Contact point along y, in m.
            PointY = "contact.py", Length;
            /// Contact point after the contact along x, in m.
            PointAfterX = "contact.after.px", Length;
            /// The same along y.
            PointAfterY = "contact.after.py", Length;
            /// Duration of the contact in s.
            Duration = "contact.duration", Time;
            /// Angle from x to the normal of the contact, in rad; either of its two directions.
            NormalAngle = "contact.normal_angle", Angle;
            /// Moment impulse on body 1 in N m s, counter-clockwise.
            Moment = "contact.moment", MomentImpulse;
            /// Coefficient of restitution of the model.
            Restitution = "model.restitution", Restitution;
            /// Impulse ratio of the model, as described by its kind.
            ImpulseRatio = "model.impulse_ratio", ImpulseRatio;
            /// Energy lost, T_L, in J.
            EnergyLoss = "reported.energy_loss", Energy;
            /// Work of the normal impulse in J, negative where energy is lost.
            NormalWork = "reported.work_normal", Energy;
            /// Work of the tangential impulse in J, negative where energy is lost.
            TangentialWork = "reported.work_tangential", Energy;
            /// Work of the moment impulse in J, negative where energy is lost.
            MomentWork = "reported.work_moment", Energy;
            /// Kinetic energy of both bodies before the impact, in J.
            EnergyBefore = "reported.kinetic_energy_before", Energy;
            /// Kinetic energy of both bodies after it, in J.
            EnergyAfter = "reported.kinetic_energy_after", Energy;
            /// Impulse on body 1 along the normal, in N s.
            NormalImpulse = "reported.impulse.normal", Impulse;
            /// Impulse on body 1 along the tangent, in N s.
            TangentialImpulse = "reported.impulse.tangential", Impulse;
            /// Impulse on body 1 along x, in N s.
            ImpulseX = "reported.impulse.x", Impulse;
            /// Impulse on body 1 along y, in N s.
            ImpulseY = "reported.impulse.y", Impulse;
            /// Magnitude of the impulse in N s.
            ImpulseMagnitude = "reported.impulse.magnitude", Impulse;
            /// Speed at which the bodies approach each other along the normal at the contact point, in m/s.
            ClosingSpeed = "reported.closing_speed", Velocity;
            /// Speed at which they separate there, in m/s.
            SeparationSpeed = "reported.separation_speed", Velocity;
            /// P_t/P_n.
            ReportedRatio = "reported.impulse_ratio", ImpulseRatio;
            /// The ratio at which sliding just ends, μ₀.
            CriticalRatio = "reported.critical_impulse_ratio", ImpulseRatio;
        }
    }
}

impl Key {
    /// Returns the key with a name.
    pub fn named(name: &str) -> Option<Key> {
        Key::of_name(name)
    }

    /// Returns `true` if it is a result that a program reports besides the motions.
    pub(super) fn is_claim(self) -> bool {
        self.name().starts_with("reported.")
    }

    /// Returns its measure.
    pub const fn measure(self) -> Measure {
        self.group().measure()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_has_its_place_and_its_name() {
        for (i, key) in Key::ALL.into_iter().enumerate() {
            assert_eq!(key.index(), i);
            assert_eq!(Key::named(key.name()), Some(key));
        }
        assert_eq!(Key::named("b3.mass"), None);
    }
}
