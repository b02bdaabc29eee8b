//! Physical quantities of the numbers of this crate.

use core::fmt;

/// The physical quantity of a number. Every value of this crate is in the SI unit of its measure, [`Measure::si_unit`].
///
/// ```
/// use planar_impact::Measure;
/// assert_eq!((Measure::Impulse.name(), Measure::Impulse.si_unit()), ("impulse", "N s"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Measure {
    /// A mass.
    Mass,
    /// A yaw inertia.
    YawInertia,
    /// A length.
    Length,
    /// An area, such as a mean square of depths.
    Area,
    /// A time.
    Time,
    /// A speed or a velocity component.
    Speed,
    /// A speed that a driver would read in km/h or mph.
    RoadSpeed,
    /// An acceleration.
    Acceleration,
    /// A yaw rate.
    YawRate,
    /// An angle.
    Angle,
    /// An impulse.
    Impulse,
    /// A moment impulse.
    MomentImpulse,
    /// An energy or a work.
    Energy,
    /// A force, or an energy per width such as G.
    Force,
    /// A force per width, such as the crush stiffness A.
    ForcePerWidth,
    /// A force per area, such as the crush stiffness B.
    ForcePerArea,
    /// A root of a force, such as the crush stiffness d₀.
    RootForce,
    /// A root of a force per length, such as the crush stiffness d₁.
    RootForcePerLength,
    /// A speed per length, such as the crush coefficient b₁.
    SpeedPerLength,
    /// A change of velocity per impulse, such as K_nn.
    InverseMass,
    /// A pure number, or one in an unspecified unit.
    Ratio,
}

/// Standard acceleration of gravity in m/s², exact by definition (third General Conference on Weights and Measures, 1901).
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The name and the SI unit of each measure, in the order of [`Measure::ALL`].
const NAMES: [(Measure, &str, &str); 21] = [
    (Measure::Mass, "mass", "kg"),
    (Measure::YawInertia, "yaw inertia", "kg m^2"),
    (Measure::Length, "length", "m"),
    (Measure::Area, "area", "m^2"),
    (Measure::Time, "time", "s"),
    (Measure::Speed, "speed", "m/s"),
    (Measure::RoadSpeed, "road speed", "m/s"),
    (Measure::Acceleration, "acceleration", "m/s^2"),
    (Measure::YawRate, "yaw rate", "rad/s"),
    (Measure::Angle, "angle", "rad"),
    (Measure::Impulse, "impulse", "N s"),
    (Measure::MomentImpulse, "moment impulse", "N m s"),
    (Measure::Energy, "energy", "J"),
    (Measure::Force, "force", "N"),
    (Measure::ForcePerWidth, "force per width", "N/m"),
    (Measure::ForcePerArea, "force per area", "N/m^2"),
    (Measure::RootForce, "root of force", "N^0.5"),
    (Measure::RootForcePerLength, "root of force per length", "N^0.5/m"),
    (Measure::SpeedPerLength, "speed per length", "1/s"),
    (Measure::InverseMass, "inverse mass", "1/kg"),
    (Measure::Ratio, "ratio", ""),
];

impl Measure {
    /// Every measure.
    pub const ALL: [Measure; NAMES.len()] = {
        let mut all = [Measure::Ratio; NAMES.len()];
        let mut i = 0;
        while i < NAMES.len() {
            all[i] = NAMES[i].0;
            i += 1;
        }
        all
    };

    /// Returns its name, such as `yaw inertia`.
    pub const fn name(self) -> &'static str {
        NAMES[self as usize].1
    }

    /// Returns the SI unit of its values, empty for a pure number.
    pub const fn si_unit(self) -> &'static str {
        NAMES[self as usize].2
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measure_has_its_own_row() {
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            assert_eq!(measure as usize, i, "{measure}");
            assert_eq!(Measure::ALL.iter().filter(|other| other.name() == measure.name()).count(), 1, "{measure}");
        }
    }
}
