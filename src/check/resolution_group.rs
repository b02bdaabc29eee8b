//! The groups of numbers of a record that share a resolution.

use crate::measure::Measure;

/// A group of numbers of a record that can share one resolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ResolutionGroup {
    /// Masses.
    Mass,
    /// Yaw inertias.
    YawInertia,
    /// Positions.
    Length,
    /// Velocities and speeds.
    #[cfg_attr(feature = "serde", serde(rename = "v"))]
    Velocity,
    /// Yaw rates.
    YawRate,
    /// Angles.
    Angle,
    /// The coefficient of restitution.
    Restitution,
    /// Impulse ratios.
    ImpulseRatio,
    /// Energies and works.
    Energy,
    /// Impulses.
    Impulse,
    /// Moment impulses.
    #[cfg_attr(feature = "serde", serde(rename = "moment"))]
    MomentImpulse,
    /// Times.
    Time,
}

impl ResolutionGroup {
    /// Number of groups.
    pub const COUNT: usize = 12;

    /// Every group.
    pub const ALL: [ResolutionGroup; ResolutionGroup::COUNT] = {
        use ResolutionGroup::*;
        [Mass, YawInertia, Length, Velocity, YawRate, Angle, Restitution, ImpulseRatio, Energy, Impulse, MomentImpulse, Time]
    };

    /// Returns the name of the group in a resolution.
    pub const fn name(self) -> &'static str {
        match self {
            ResolutionGroup::Mass => "mass",
            ResolutionGroup::YawInertia => "yaw_inertia",
            ResolutionGroup::Length => "length",
            ResolutionGroup::Velocity => "v",
            ResolutionGroup::YawRate => "yaw_rate",
            ResolutionGroup::Angle => "angle",
            ResolutionGroup::Restitution => "restitution",
            ResolutionGroup::ImpulseRatio => "impulse_ratio",
            ResolutionGroup::Energy => "energy",
            ResolutionGroup::Impulse => "impulse",
            ResolutionGroup::MomentImpulse => "moment",
            ResolutionGroup::Time => "time",
        }
    }

    /// Returns the measure of its numbers.
    pub const fn measure(self) -> Measure {
        match self {
            ResolutionGroup::Mass => Measure::Mass,
            ResolutionGroup::YawInertia => Measure::YawInertia,
            ResolutionGroup::Length => Measure::Length,
            ResolutionGroup::Velocity => Measure::Speed,
            ResolutionGroup::YawRate => Measure::YawRate,
            ResolutionGroup::Angle => Measure::Angle,
            ResolutionGroup::Restitution | ResolutionGroup::ImpulseRatio => Measure::Ratio,
            ResolutionGroup::Energy => Measure::Energy,
            ResolutionGroup::Impulse => Measure::Impulse,
            ResolutionGroup::MomentImpulse => Measure::MomentImpulse,
            ResolutionGroup::Time => Measure::Time,
        }
    }

    /// Returns the group with a name.
    pub fn named(name: &str) -> Option<ResolutionGroup> {
        ResolutionGroup::ALL.into_iter().find(|group| group.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Key;
    use super::*;

    #[test]
    fn every_group_has_its_name() {
        for (i, group) in ResolutionGroup::ALL.into_iter().enumerate() {
            assert_eq!(group as usize, i);
            assert_eq!(ResolutionGroup::named(group.name()), Some(group));
            assert!(Key::ALL.iter().any(|key| key.group() == group));
        }
        assert_eq!(ResolutionGroup::named("b1.mass"), None);
    }
}
