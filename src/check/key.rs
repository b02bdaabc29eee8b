//! The numbers of a record, each by one name.

use super::measure::Measure;
use crate::input::Side;
use core::fmt;

/// A number of a record.
///
/// Its name is the heading of its column in a table of records, and what a resolution of that number alone is given under.
///
/// ```
/// use planar_impact::Side;
/// use planar_impact::check::{Key, Measure};
/// assert_eq!(Key::AfterX(Side::One).name(), "b1.after.vx");
/// assert_eq!(Key::named("reported.ees.2"), Some(Key::EquivalentEnergySpeed(Side::Two)));
/// assert_eq!(Key::AfterX(Side::One).measure(), Measure::Velocity);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// Mass in kg.
    Mass(Side),
    /// Yaw inertia about the center of mass in kg m².
    YawInertia(Side),
    /// Where the body points, from x, in rad. Needed for a direction of force only.
    Heading(Side),
    /// Center of mass along x, in m.
    CenterX(Side),
    /// Center of mass along y, in m.
    CenterY(Side),
    /// Velocity of the center of mass along x before the impact, in m/s.
    BeforeX(Side),
    /// The same along y.
    BeforeY(Side),
    /// Yaw rate before the impact in rad/s.
    BeforeYawRate(Side),
    /// Velocity of the center of mass along x after the impact, in m/s.
    AfterX(Side),
    /// The same along y.
    AfterY(Side),
    /// Yaw rate after the impact in rad/s.
    AfterYawRate(Side),
    /// Contact point along x, in m.
    PointX,
    /// Contact point along y, in m.
    PointY,
    /// Angle from x to the normal of the contact, in rad; either of its two directions.
    NormalAngle,
    /// Coefficient of restitution of the model.
    Restitution,
    /// Impulse ratio of the model, as its kind says.
    ImpulseRatio,
    /// Energy lost, T_L, in J.
    EnergyLoss,
    /// Work of the normal impulse in J, negative where energy is lost.
    NormalWork,
    /// Work of the tangential impulse in J, negative where energy is lost.
    TangentialWork,
    /// Kinetic energy of both bodies before the impact, in J.
    EnergyBefore,
    /// Kinetic energy of both bodies after it, in J.
    EnergyAfter,
    /// Magnitude of a body's change of velocity, in m/s.
    DeltaV(Side),
    /// Direction that the force on a body comes from, clockwise from its heading, in rad.
    ForceDirection(Side),
    /// Equivalent energy speed of a body in m/s.
    EquivalentEnergySpeed(Side),
    /// Impulse on body 1 along the normal, in N s.
    NormalImpulse,
    /// Impulse on body 1 along the tangent, in N s.
    TangentialImpulse,
    /// Impulse on body 1 along x, in N s.
    ImpulseX,
    /// Impulse on body 1 along y, in N s.
    ImpulseY,
    /// Magnitude of the impulse in N s.
    ImpulseMagnitude,
    /// Speed at which the bodies approach each other along the normal at the contact point, in m/s.
    ClosingSpeed,
    /// Speed at which they part there, in m/s.
    SeparationSpeed,
    /// P_t/P_n.
    ReportedRatio,
    /// The ratio at which sliding just ends, μ₀.
    CriticalRatio,
}

/// Name and measure of each key, in the order of [`Key::ALL`].
const NAMES: [(&str, Measure); Key::COUNT] = {
    use Measure::*;
    [
        ("b1.mass", Mass),
        ("b1.yaw_inertia", YawInertia),
        ("b1.heading", Angle),
        ("b1.cgx", Length),
        ("b1.cgy", Length),
        ("b1.before.vx", Velocity),
        ("b1.before.vy", Velocity),
        ("b1.before.yaw_rate", YawRate),
        ("b1.after.vx", Velocity),
        ("b1.after.vy", Velocity),
        ("b1.after.yaw_rate", YawRate),
        ("reported.delta_v.1", Velocity),
        ("reported.pdof.1", Angle),
        ("reported.ees.1", Velocity),
        ("b2.mass", Mass),
        ("b2.yaw_inertia", YawInertia),
        ("b2.heading", Angle),
        ("b2.cgx", Length),
        ("b2.cgy", Length),
        ("b2.before.vx", Velocity),
        ("b2.before.vy", Velocity),
        ("b2.before.yaw_rate", YawRate),
        ("b2.after.vx", Velocity),
        ("b2.after.vy", Velocity),
        ("b2.after.yaw_rate", YawRate),
        ("reported.delta_v.2", Velocity),
        ("reported.pdof.2", Angle),
        ("reported.ees.2", Velocity),
        ("contact.px", Length),
        ("contact.py", Length),
        ("contact.normal_angle", Angle),
        ("model.restitution", Restitution),
        ("model.impulse_ratio", ImpulseRatio),
        ("reported.energy_loss", Energy),
        ("reported.work_normal", Energy),
        ("reported.work_tangential", Energy),
        ("reported.kinetic_energy_before", Energy),
        ("reported.kinetic_energy_after", Energy),
        ("reported.impulse.normal", Impulse),
        ("reported.impulse.tangential", Impulse),
        ("reported.impulse.x", Impulse),
        ("reported.impulse.y", Impulse),
        ("reported.impulse.magnitude", Impulse),
        ("reported.closing_speed", Velocity),
        ("reported.separation_speed", Velocity),
        ("reported.impulse_ratio", ImpulseRatio),
        ("reported.critical_impulse_ratio", ImpulseRatio),
    ]
};

impl Key {
    /// How many there are.
    pub const COUNT: usize = 47;

    /// Every key: those of body 1, those of body 2, those of the contact and of the pair.
    pub const ALL: [Key; Key::COUNT] = {
        use Key::*;
        use Side::{One, Two};
        [
            Mass(One),
            YawInertia(One),
            Heading(One),
            CenterX(One),
            CenterY(One),
            BeforeX(One),
            BeforeY(One),
            BeforeYawRate(One),
            AfterX(One),
            AfterY(One),
            AfterYawRate(One),
            DeltaV(One),
            ForceDirection(One),
            EquivalentEnergySpeed(One),
            Mass(Two),
            YawInertia(Two),
            Heading(Two),
            CenterX(Two),
            CenterY(Two),
            BeforeX(Two),
            BeforeY(Two),
            BeforeYawRate(Two),
            AfterX(Two),
            AfterY(Two),
            AfterYawRate(Two),
            DeltaV(Two),
            ForceDirection(Two),
            EquivalentEnergySpeed(Two),
            PointX,
            PointY,
            NormalAngle,
            Restitution,
            ImpulseRatio,
            EnergyLoss,
            NormalWork,
            TangentialWork,
            EnergyBefore,
            EnergyAfter,
            NormalImpulse,
            TangentialImpulse,
            ImpulseX,
            ImpulseY,
            ImpulseMagnitude,
            ClosingSpeed,
            SeparationSpeed,
            ReportedRatio,
            CriticalRatio,
        ]
    };

    /// Its place in [`Key::ALL`].
    #[inline(always)]
    pub const fn index(self) -> usize {
        let (at, side) = match self {
            Key::Mass(side) => (0, side),
            Key::YawInertia(side) => (1, side),
            Key::Heading(side) => (2, side),
            Key::CenterX(side) => (3, side),
            Key::CenterY(side) => (4, side),
            Key::BeforeX(side) => (5, side),
            Key::BeforeY(side) => (6, side),
            Key::BeforeYawRate(side) => (7, side),
            Key::AfterX(side) => (8, side),
            Key::AfterY(side) => (9, side),
            Key::AfterYawRate(side) => (10, side),
            Key::DeltaV(side) => (11, side),
            Key::ForceDirection(side) => (12, side),
            Key::EquivalentEnergySpeed(side) => (13, side),
            Key::PointX => return 28,
            Key::PointY => return 29,
            Key::NormalAngle => return 30,
            Key::Restitution => return 31,
            Key::ImpulseRatio => return 32,
            Key::EnergyLoss => return 33,
            Key::NormalWork => return 34,
            Key::TangentialWork => return 35,
            Key::EnergyBefore => return 36,
            Key::EnergyAfter => return 37,
            Key::NormalImpulse => return 38,
            Key::TangentialImpulse => return 39,
            Key::ImpulseX => return 40,
            Key::ImpulseY => return 41,
            Key::ImpulseMagnitude => return 42,
            Key::ClosingSpeed => return 43,
            Key::SeparationSpeed => return 44,
            Key::ReportedRatio => return 45,
            Key::CriticalRatio => return 46,
        };
        at + 14 * (side as usize)
    }

    /// Its name, such as `b1.after.vx`.
    pub const fn name(self) -> &'static str {
        NAMES[self.index()].0
    }

    /// What it measures.
    pub const fn measure(self) -> Measure {
        NAMES[self.index()].1
    }

    /// The key of a name.
    pub fn named(name: &str) -> Option<Key> {
        NAMES.iter().position(|&(known, _)| known == name).map(|at| Key::ALL[at])
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
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
