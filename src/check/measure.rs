//! What the numbers of a record measure.

/// What a number of a record measures. A resolution may be given for all numbers of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// Masses.
    Mass,
    /// Yaw inertias.
    YawInertia,
    /// Positions.
    Length,
    /// Velocities and speeds.
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
}

impl Measure {
    /// How many there are.
    pub const COUNT: usize = 10;

    /// Every measure.
    pub const ALL: [Measure; Measure::COUNT] = {
        use Measure::*;
        [Mass, YawInertia, Length, Velocity, YawRate, Angle, Restitution, ImpulseRatio, Energy, Impulse]
    };

    /// The name that a resolution for all numbers of this kind is given under.
    pub const fn name(self) -> &'static str {
        match self {
            Measure::Mass => "mass",
            Measure::YawInertia => "yaw_inertia",
            Measure::Length => "length",
            Measure::Velocity => "v",
            Measure::YawRate => "yaw_rate",
            Measure::Angle => "angle",
            Measure::Restitution => "restitution",
            Measure::ImpulseRatio => "impulse_ratio",
            Measure::Energy => "energy",
            Measure::Impulse => "impulse",
        }
    }

    /// The measure of a name.
    pub fn named(name: &str) -> Option<Measure> {
        Measure::ALL.into_iter().find(|measure| measure.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Key;
    use super::*;

    #[test]
    fn every_measure_has_its_name() {
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            assert_eq!(measure as usize, i);
            assert_eq!(Measure::named(measure.name()), Some(measure));
            assert!(Key::ALL.iter().any(|key| key.measure() == measure));
        }
        assert_eq!(Measure::named("b1.mass"), None);
    }
}
