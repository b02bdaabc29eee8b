//! The units that results are printed in.

use crate::quantity::{Conversion, Kind};

/// A system of units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Units {
    /// Feet, pounds, seconds; ΔV also in miles per hour.
    Us,
    /// Meters, kilograms, seconds; ΔV also in kilometers per hour.
    Si,
}

/// What is measured, as far as printing it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// A velocity component.
    Speed,
    /// A speed as a driver reads it.
    RoadSpeed,
    /// A yaw rate.
    YawRate,
    /// An angle.
    Angle,
    /// A length.
    Length,
    /// An impulse.
    Impulse,
    /// A moment impulse.
    MomentImpulse,
    /// An energy.
    Energy,
    /// A mass.
    Mass,
    /// A yaw inertia.
    YawInertia,
    /// A root of a force, as the crush stiffness d0.
    RootForce,
    /// A root of a force per length, as d1.
    RootForcePerLength,
    /// A force per width, as the crush stiffness A.
    ForcePerWidth,
    /// The same per depth, as B.
    ForcePerArea,
    /// A force, which an energy per width is too, as G.
    Force,
    /// A pure number.
    Ratio,
}

impl Measure {
    /// What its values are written as.
    pub fn kind(self) -> Kind {
        match self {
            Measure::Mass => Kind::MASS,
            Measure::YawInertia => Kind::YAW_INERTIA,
            Measure::Angle => Kind::ANGLE,
            Measure::Length => Kind::LENGTH,
            Measure::Speed | Measure::RoadSpeed => Kind::SPEED,
            Measure::YawRate => Kind::YAW_RATE,
            Measure::RootForce => Kind::ROOT_FORCE,
            Measure::RootForcePerLength => Kind::ROOT_FORCE_PER_LENGTH,
            Measure::MomentImpulse => Kind::MOMENT_IMPULSE,
            Measure::Impulse => Kind::IMPULSE,
            Measure::Energy => Kind::ENERGY,
            Measure::ForcePerWidth => Kind::STIFFNESS,
            Measure::ForcePerArea => Kind::STIFFNESS_PER_WIDTH,
            Measure::Force => Kind::FORCE,
            Measure::Ratio => Kind::PURE,
        }
    }
}

impl Units {
    /// The system that a unit belongs to, if it tells one.
    pub fn of(unit: &str) -> Option<Units> {
        const US: [&str; 14] = ["ft", "in", "yd", "mi", "lb", "lbs", "lbm", "lbf", "slug", "slugs", "mph", "fps", "psi", "kip"];
        const SI: [&str; 17] = ["m", "mm", "cm", "km", "kg", "g", "t", "N", "kN", "J", "kJ", "MJ", "Pa", "kPa", "MPa", "kph", "kmh"];
        let mut symbols = unit.split(|c: char| !c.is_alphabetic()).filter(|symbol| !symbol.is_empty());
        symbols.find_map(|symbol| match symbol {
            us if US.contains(&us) => Some(Units::Us),
            si if SI.contains(&si) => Some(Units::Si),
            _ => None,
        })
    }

    /// The unit that a measure is printed in; none for a pure number.
    pub fn unit(self, measure: Measure) -> &'static str {
        match (measure, self) {
            (Measure::Speed, Units::Us) => "ft/s",
            (Measure::Speed, Units::Si) => "m/s",
            (Measure::RoadSpeed, Units::Us) => "mph",
            (Measure::RoadSpeed, Units::Si) => "km/h",
            (Measure::YawRate, _) => "deg/s",
            (Measure::Angle, _) => "deg",
            (Measure::Length, Units::Us) => "ft",
            (Measure::Length, Units::Si) => "m",
            (Measure::Impulse, Units::Us) => "lbf s",
            (Measure::Impulse, Units::Si) => "N s",
            (Measure::MomentImpulse, Units::Us) => "lbf s ft",
            (Measure::MomentImpulse, Units::Si) => "N m s",
            (Measure::Energy, Units::Us) => "ft lb",
            (Measure::Energy, Units::Si) => "J",
            (Measure::Mass, Units::Us) => "lb",
            (Measure::Mass, Units::Si) => "kg",
            (Measure::YawInertia, Units::Us) => "lbf s^2 ft",
            (Measure::YawInertia, Units::Si) => "kg m^2",
            (Measure::RootForce, Units::Us) => "lbf^0.5",
            (Measure::RootForce, Units::Si) => "N^0.5",
            (Measure::RootForcePerLength, Units::Us) => "lbf^0.5/ft",
            (Measure::RootForcePerLength, Units::Si) => "N^0.5/m",
            (Measure::ForcePerWidth, Units::Us) => "lbf/in",
            (Measure::ForcePerWidth, Units::Si) => "N/m",
            (Measure::ForcePerArea, Units::Us) => "lbf/in^2",
            (Measure::ForcePerArea, Units::Si) => "N/m^2",
            (Measure::Force, Units::Us) => "lbf",
            (Measure::Force, Units::Si) => "N",
            (Measure::Ratio, _) => "",
        }
    }

    /// A value in SI as a number in this system.
    pub fn convert(self, measure: Measure, si: f64) -> f64 {
        self.conversion(measure).of_si(si)
    }

    /// From SI into the unit that a measure is printed in.
    pub fn conversion(self, measure: Measure) -> Conversion {
        match self.unit(measure) {
            "" => Conversion::none(),
            // A foot pound of energy, which by its letters would be a length times a mass.
            "ft lb" => Conversion::to("ft lbf"),
            unit => Conversion::to(unit),
        }
    }

    /// A value in SI as text without its unit: as many decimals as the measure deserves, more for a value that would vanish, and 0 for one that is the
    /// rounding of the `scale` of its kind.
    pub fn number(self, measure: Measure, si: f64, scale: f64) -> String {
        if si.abs() <= 1e-12 * scale {
            return "0".to_owned();
        }
        let value = self.convert(measure, si);
        let usual: usize = match measure {
            Measure::Ratio => 3,
            Measure::Speed | Measure::Length | Measure::RootForce | Measure::RootForcePerLength => 2,
            Measure::RoadSpeed | Measure::YawRate | Measure::Angle | Measure::YawInertia => 1,
            Measure::ForcePerWidth | Measure::ForcePerArea | Measure::Force if self == Units::Us => 1,
            Measure::ForcePerWidth | Measure::ForcePerArea | Measure::Force => 0,
            Measure::Mass | Measure::Impulse | Measure::MomentImpulse | Measure::Energy => 0,
        };
        if !(1e-9..1e12).contains(&value.abs()) {
            return format!("{value:.3e}");
        }
        // Two significant digits at least.
        let leading = value.abs().log10().floor();
        let needed = if leading < 1.0 { (1.0 - leading) as usize } else { 0 };
        format!("{value:.0$}", usual.max(needed))
    }

    /// A value in SI as text with its unit.
    pub fn quantity(self, measure: Measure, si: f64) -> String {
        let number = self.number(measure, si, 0.0);
        let unit = self.unit(measure);
        if unit.is_empty() { number } else { format!("{number} {unit}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_tell_the_system() {
        assert_eq!(Units::of("lbf s^2 ft"), Some(Units::Us));
        assert_eq!(Units::of("km/h"), Some(Units::Si));
        assert_eq!(Units::of("kg m^2"), Some(Units::Si));
        assert_eq!(Units::of("deg/s"), None);
        assert_eq!(Units::of(""), None);
    }

    #[test]
    fn digits_are_those_a_person_reads() {
        assert_eq!(Units::Us.quantity(Measure::Energy, -40_806.33), "-30097 ft lb"); // 1 ft lbf = 1.3558179483314004 J
        assert_eq!(Units::Si.quantity(Measure::Energy, -40_806.33), "-40806 J");
        assert_eq!(Units::Us.quantity(Measure::Ratio, 0.660_6), "0.661");
        assert_eq!(Units::Us.quantity(Measure::Ratio, 0.000_123_4), "0.00012");
        assert_eq!(Units::Si.quantity(Measure::Energy, 0.25), "0.25 J");
        assert_eq!(Units::Si.quantity(Measure::Speed, 12.345_6), "12.35 m/s");
        assert_eq!(Units::Si.quantity(Measure::RoadSpeed, 10.0), "36.0 km/h");
        assert_eq!(Units::Si.number(Measure::Speed, -3e-15, 12.0), "0");
        assert_eq!(Units::Si.number(Measure::Speed, 0.0, 0.0), "0");
        assert_eq!(Units::Si.quantity(Measure::Energy, 1.5e15), "1.500e15 J");
        assert_eq!(Units::Si.quantity(Measure::Angle, std::f64::consts::PI), "180.0 deg");
    }

    #[test]
    fn every_unit_converts() {
        use Measure::*;
        let mechanical = [Speed, RoadSpeed, YawRate, Angle, Length, Impulse, MomentImpulse, Energy, Ratio];
        let structural = [Mass, YawInertia, RootForce, RootForcePerLength, ForcePerWidth, ForcePerArea, Force];
        for measure in mechanical.into_iter().chain(structural) {
            for units in [Units::Us, Units::Si] {
                assert!(units.convert(measure, 1.0).is_finite(), "{measure:?}");
            }
        }
        assert_eq!(Units::Us.convert(Measure::Speed, 0.3048), 1.0); // the international foot
    }
}
