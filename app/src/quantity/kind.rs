//! The kinds of quantity in a case file: dimension, wording and limits.

use super::unit::Dimension;
use crate::units::Measure;

/// A kind of quantity.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name with the article, such as "a mass".
    pub name: &'static str,
    /// The dimension of its units.
    pub dimension: Dimension,
    /// The unit of a number given without one.
    pub si: &'static str,
    /// A value of this kind as a file writes it.
    pub example: &'static str,
    /// The units of which one was probably meant if a bare number is implausible in SI.
    pub likely: &'static [&'static str],
    /// Limits of a number without a unit, in SI.
    pub bare: Reach,
    /// Limits of any value, in SI, so that products of a few values stay finite.
    pub domain: Reach,
}

/// The range of values of a kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// Up to this magnitude.
    Magnitude(f64),
    /// From the first to the second if positive. Zero and negative values pass here, because the library refuses them with its own message.
    Positive(f64, f64),
}

impl Reach {
    /// Returns `true` if `value` is within the range; always `false` for NaN.
    pub fn holds(self, value: f64) -> bool {
        match self {
            Reach::Magnitude(most) => value.abs() <= most,
            Reach::Positive(least, most) => value <= 0.0 || (least..=most).contains(&value),
        }
    }
}

impl Kind {
    /// Creates a kind whose values, with or without a unit, may have a magnitude up to `most`.
    const fn new(name: &'static str, dimension: Dimension, si: &'static str, example: &'static str, most: f64) -> Kind {
        let reach = Reach::Magnitude(most);
        Kind { name, dimension, si, example, likely: &[], bare: reach, domain: reach }
    }

    /// Returns this kind with a narrower limit for numbers without a unit.
    const fn bare(mut self, most: f64, likely: &'static [&'static str]) -> Kind {
        self.bare = Reach::Magnitude(most);
        self.likely = likely;
        self
    }

    /// Returns this kind with limits for a positive value, without a unit and with one.
    const fn positive(mut self, bare: (f64, f64), domain: (f64, f64)) -> Kind {
        self.bare = Reach::Positive(bare.0, bare.1);
        self.domain = Reach::Positive(domain.0, domain.1);
        self
    }

    /// A mass: 1e-3 to 1e9 kg, without a unit 0.1 to 1e6.
    pub const MASS: Kind = Kind::new("a mass", Dimension::new(1, 0, 0, 0), "kg", "1500 kg", 1e9).positive((0.1, 1e6), (1e-3, 1e9));
    /// A length: up to 1e3 m, without a unit 50.
    pub const LENGTH: Kind = Kind::new("a length", Dimension::new(0, 1, 0, 0), "m", "1.5 m", 1e3).bare(50.0, &["mm", "cm", "in", "ft"]);
    /// A speed: up to 1e5 m/s, without a unit 150.
    pub const SPEED: Kind = Kind::new("a speed", Dimension::new(0, 1, -1, 0), "m/s", "40 ft/s", 1e5).bare(150.0, &["km/h"]);
    /// An angle: up to 1e6 degrees, without a unit one turn.
    pub const ANGLE: Kind =
        Kind::new("an angle", Dimension::new(0, 0, 0, 1), "rad", "-10 deg", 17_453.292_519_943_3).bare(std::f64::consts::TAU, &["deg"]);
    /// A yaw rate: up to 1e4 rad/s, without a unit 30.
    pub const YAW_RATE: Kind = Kind::new("a yaw rate", Dimension::new(0, 0, -1, 1), "rad/s", "30 deg/s", 1e4).bare(30.0, &["deg/s"]);
    /// A yaw inertia: 1e-9 to 1e15 kg m², without a unit 1e-3 to 1e9.
    pub const YAW_INERTIA: Kind =
        Kind::new("a yaw inertia", Dimension::new(1, 2, 0, 0), "kg m^2", "2000 kg m^2", 1e15).positive((1e-3, 1e9), (1e-9, 1e15));
    /// A number without a dimension, up to 1e6; "15 %" is 0.15.
    pub const PURE: Kind = Kind::new("a pure number", Dimension::new(0, 0, 0, 0), "", "0.3", 1e6);
    /// A duration: up to 1e6 s.
    pub const DURATION: Kind = Kind::new("a duration", Dimension::new(0, 0, 1, 0), "s", "100 ms", 1e6);
    /// An acceleration: up to 1e9 m/s², without a unit 30.
    pub const ACCELERATION: Kind =
        Kind::new("an acceleration", Dimension::new(0, 1, -2, 0), "m/s^2", "9.8 m/s^2", 1e9).bare(30.0, &["ft/s^2"]);
    /// A force: up to 1e15 N.
    pub const FORCE: Kind = Kind::new("a force", Dimension::new(1, 1, -2, 0), "N", "20 kN", 1e15);
    /// A weight: 1e-2 to 1e10 N, without a unit 1 to 1e7.
    pub const WEIGHT: Kind = Kind::new("a weight", Dimension::new(1, 1, -2, 0), "N", "2564 lbf", 1e10).positive((1.0, 1e7), (1e-2, 1e10));
    /// An impulse: up to 1e15 N s.
    pub const IMPULSE: Kind = Kind::new("an impulse", Dimension::new(1, 1, -1, 0), "N s", "5000 N s", 1e15);
    /// A moment impulse: up to 1e15 N m s.
    pub const MOMENT_IMPULSE: Kind = Kind::new("a moment impulse", Dimension::new(1, 2, -1, 0), "N m s", "500 N m s", 1e15);
    /// An energy: up to 1e18 J.
    pub const ENERGY: Kind = Kind::new("an energy", Dimension::new(1, 2, -2, 0), "J", "50 kJ", 1e18);
    /// A force per length, such as the stiffness of a spring: up to 1e15 N/m.
    pub const STIFFNESS: Kind = Kind::new("a stiffness (force per length)", Dimension::new(1, 0, -2, 0), "N/m", "300 lbf/in", 1e15);
    /// A force per area, such as the crush stiffness B: up to 1e15 N/m².
    pub const STIFFNESS_PER_WIDTH: Kind =
        Kind::new("a stiffness per width (force per area)", Dimension::new(1, -1, -2, 0), "N/m^2", "50 lbf/in^2", 1e15);
    /// A root of a force, such as the crush intercept: up to 1e9 N^0.5.
    pub const ROOT_FORCE: Kind = Kind::new("a root of a force", Dimension::halves(1, 1, -2, 0), "N^0.5", "90 lbf^0.5", 1e9);
    /// A root of a force per length, such as the crush slope: up to 1e9 N^0.5/m.
    pub const ROOT_FORCE_PER_LENGTH: Kind =
        Kind::new("a root of a force per length", Dimension::halves(1, -1, -2, 0), "N^0.5/m", "160 lbf^0.5/ft", 1e9);

    /// A speed per length, such as the crush coefficient b1: up to 1e9 1/s.
    pub const SPEED_PER_LENGTH: Kind = Kind::new("a speed per length", Dimension::new(0, 0, -1, 0), "m/s/m", "1.4 mph/in", 1e9);

    /// Every kind.
    pub(crate) const ALL: [Kind; 19] = [
        Kind::MASS,
        Kind::LENGTH,
        Kind::SPEED,
        Kind::ANGLE,
        Kind::YAW_RATE,
        Kind::YAW_INERTIA,
        Kind::PURE,
        Kind::DURATION,
        Kind::ACCELERATION,
        Kind::FORCE,
        Kind::WEIGHT,
        Kind::IMPULSE,
        Kind::MOMENT_IMPULSE,
        Kind::ENERGY,
        Kind::STIFFNESS,
        Kind::STIFFNESS_PER_WIDTH,
        Kind::ROOT_FORCE,
        Kind::ROOT_FORCE_PER_LENGTH,
        Kind::SPEED_PER_LENGTH,
    ];

    /// Returns the kind of a difference of two such values, which may have either sign and be arbitrarily small.
    pub fn difference(mut self) -> Kind {
        let magnitude = |reach| match reach {
            Reach::Magnitude(most) | Reach::Positive(_, most) => Reach::Magnitude(most),
        };
        (self.bare, self.domain) = (magnitude(self.bare), magnitude(self.domain));
        self
    }

    /// Returns the measure of such values: [`Measure::Speed`] of every speed, and a ratio of every pure number.
    pub fn measure(&self) -> Measure {
        let is_of = |measure: &Measure| {
            !matches!(measure, Measure::RoadSpeed | Measure::Area | Measure::InverseMass)
                && Kind::from(*measure).dimension == self.dimension
        };
        Measure::ALL.into_iter().find(is_of).unwrap_or(Measure::Ratio)
    }

    /// Describes the quantity required, such as `a mass, such as "1500 kg"`.
    pub fn wanted(&self) -> String {
        format!("{}, such as \"{}\"", self.name, self.example)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches() {
        assert!(Reach::Magnitude(50.0).holds(-50.0) && !Reach::Magnitude(50.0).holds(50.1));
        assert!(!Reach::Magnitude(50.0).holds(f64::NAN) && !Reach::Magnitude(1e9).holds(f64::INFINITY));
        let positive = Reach::Positive(0.1, 1e6);
        assert!(positive.holds(0.1) && positive.holds(1e6) && positive.holds(0.0) && positive.holds(-1e9));
        assert!(!positive.holds(0.09) && !positive.holds(1.1e6) && !positive.holds(f64::NAN));
    }

    #[test]
    fn the_measure_of_a_kind_is_of_its_dimension() {
        for kind in Kind::ALL {
            assert_eq!(Kind::from(kind.measure()).dimension, kind.dimension, "{}", kind.name);
        }
        assert_eq!([Kind::PURE, Kind::SPEED, Kind::WEIGHT].map(|kind| kind.measure()), [Measure::Ratio, Measure::Speed, Measure::Force]);
    }

    #[test]
    fn each_example_is_of_its_kind() {
        for kind in Kind::ALL {
            let read = crate::quantity::parse(kind.example, kind);
            assert!(read.is_ok(), "{}: {read:?}", kind.name);
            if !kind.si.is_empty() {
                let one = crate::quantity::parse(&format!("1 {}", kind.si), kind);
                assert_eq!(one.map(|one| one.si), Ok(1.0), "{}", kind.name);
            }
        }
    }
}
