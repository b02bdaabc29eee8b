//! The units in which results are printed.

use planar_impact::{Message, Part};

use crate::quantity::{Conversion, Kind, symbol};

pub use planar_impact::Measure;

/// A system of units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// Feet, pounds, seconds; ΔV also in miles per hour.
    Us,
    /// Meters, kilograms, seconds; ΔV also in kilometers per hour.
    Si,
    /// As SI, but speeds in miles per hour.
    Uk,
}

/// Returns the kind of quantity in which values of a measure are written.
impl From<Measure> for Kind {
    fn from(measure: Measure) -> Kind {
        match measure {
            Measure::Mass => Kind::MASS,
            Measure::YawInertia => Kind::YAW_INERTIA,
            Measure::Angle => Kind::ANGLE,
            Measure::Length => Kind::LENGTH,
            Measure::Speed | Measure::RoadSpeed => Kind::SPEED,
            Measure::YawRate => Kind::YAW_RATE,
            Measure::RootForce => Kind::ROOT_FORCE,
            Measure::RootForcePerLength => Kind::ROOT_FORCE_PER_LENGTH,
            Measure::SpeedPerLength => Kind::SPEED_PER_LENGTH,
            Measure::MomentImpulse => Kind::MOMENT_IMPULSE,
            Measure::Impulse => Kind::IMPULSE,
            Measure::Energy => Kind::ENERGY,
            Measure::ForcePerWidth => Kind::STIFFNESS,
            Measure::ForcePerArea => Kind::STIFFNESS_PER_WIDTH,
            Measure::Force => Kind::FORCE,
            Measure::Time => Kind::DURATION,
            Measure::Acceleration => Kind::ACCELERATION,
            // No key of a file has one of these measures.
            Measure::Ratio | Measure::Area | Measure::InverseMass => Kind::PURE,
        }
    }
}

/// Returns a number, or 0 if it is rounding beside the scale of what it is computed from.
pub fn beyond_rounding(value: f64, scale: f64) -> f64 {
    if value.abs() <= 1e-12 * scale { 0.0 } else { value }
}

impl Units {
    /// Returns the system that a unit belongs to, if only one uses it.
    pub fn of(unit: &str) -> Option<Units> {
        const US: [&str; 11] = ["ft", "in", "yd", "mi", "lb", "lbf", "slug", "mph", "fps", "psi", "kip"];
        const SI: [&str; 17] = ["m", "mm", "cm", "km", "kg", "g", "t", "N", "kN", "MN", "J", "kJ", "MJ", "Pa", "kPa", "MPa", "kph"];
        let names = unit.split(|c: char| !c.is_alphabetic()).filter(|name| !name.is_empty());
        names.filter_map(symbol).find_map(|symbol| match symbol {
            us if US.contains(&us) => Some(Units::Us),
            si if SI.contains(&si) => Some(Units::Si),
            _ => None,
        })
    }

    /// Returns the unit in which a measure is printed; empty for a pure number.
    pub fn unit(self, measure: Measure) -> &'static str {
        match (self, measure) {
            (Units::Us, _) => Units::customary(measure),
            (_, Measure::YawRate) => "deg/s",
            (_, Measure::Angle) => "deg",
            (Units::Uk, Measure::Speed | Measure::RoadSpeed) => "mph",
            (_, Measure::RoadSpeed) => "km/h",
            _ => measure.si_unit(),
        }
    }

    fn customary(measure: Measure) -> &'static str {
        match measure {
            Measure::Speed => "ft/s",
            Measure::RoadSpeed => "mph",
            Measure::YawRate => "deg/s",
            Measure::Angle => "deg",
            Measure::Length => "ft",
            Measure::Impulse => "lbf s",
            Measure::MomentImpulse => "lbf s ft",
            Measure::Energy => "ft lb",
            Measure::Mass => "lb",
            Measure::YawInertia => "lbf s^2 ft",
            Measure::RootForce => "lbf^0.5",
            Measure::RootForcePerLength => "lbf^0.5/ft",
            Measure::SpeedPerLength => "mph/in",
            Measure::ForcePerWidth => "lbf/in",
            Measure::ForcePerArea => "lbf/in^2",
            Measure::Force => "lbf",
            Measure::Area => "ft^2",
            Measure::Acceleration => "ft/s^2",
            Measure::InverseMass => "1/lb",
            Measure::Time | Measure::Ratio => measure.si_unit(),
        }
    }

    /// Returns the measure in which a page repeats a value: a speed, if speeds on the road have another unit.
    pub fn on_the_road(self, measure: Measure) -> Option<Measure> {
        (measure == Measure::Speed && self.unit(measure) != self.unit(Measure::RoadSpeed)).then_some(Measure::RoadSpeed)
    }

    /// Converts a value in SI to a number in this system.
    pub fn convert(self, measure: Measure, si: f64) -> f64 {
        self.conversion(measure).of_si(si)
    }

    /// Returns the conversion from SI to the unit in which a measure is printed.
    pub fn conversion(self, measure: Measure) -> Conversion {
        match self.unit(measure) {
            "" => Conversion::none(),
            // A foot-pound of energy, which would otherwise be read as a length times a mass.
            "ft lb" => Conversion::to("ft lbf"),
            unit => Conversion::to(unit),
        }
    }

    /// Formats a value in SI without its unit, with as many decimals as suit the measure: more for a value that would
    /// round to zero, and `0` for one that is within rounding of `scale`.
    pub fn number(self, measure: Measure, si: f64, scale: f64) -> String {
        if beyond_rounding(si, scale) == 0.0 {
            return "0".to_owned();
        }
        let value = self.convert(measure, si);
        let usual: usize = match measure {
            Measure::Ratio | Measure::Time | Measure::InverseMass => 3,
            Measure::Speed
            | Measure::Length
            | Measure::Area
            | Measure::Acceleration
            | Measure::RootForce
            | Measure::RootForcePerLength
            | Measure::SpeedPerLength => 2,
            Measure::RoadSpeed | Measure::YawRate | Measure::Angle | Measure::YawInertia => 1,
            Measure::ForcePerWidth | Measure::ForcePerArea | Measure::Force if self == Units::Us => 1,
            Measure::ForcePerWidth | Measure::ForcePerArea | Measure::Force => 0,
            Measure::Mass | Measure::Impulse | Measure::MomentImpulse | Measure::Energy => 0,
        };
        if !(1e-9..1e12).contains(&value.abs()) {
            return format!("{value:.3e}");
        }
        // At least two significant digits.
        let leading = libm::log10(value.abs()).floor();
        let needed = if leading < 1.0 { (1.0 - leading) as usize } else { 0 };
        format!("{value:.0$}", usual.max(needed))
    }

    /// Formats a message in this system. A pure number has up to six significant digits; figures that differ have as many decimals as tell them apart.
    pub fn sentence(self, message: &Message) -> String {
        let figures = || {
            message
                .parts()
                .iter()
                .filter_map(|part| if let Part::Figure { measure, value } = part { Some((*measure, *value)) } else { None })
        };
        let print = |measure, value| if measure == Measure::Ratio { trim(value) } else { self.quantity(measure, value) };
        let figure = |measure: Measure, value: f64| {
            let usual = print(measure, value);
            let alike = figures().find(|(of, other)| *of == measure && *other != value && print(measure, *other) == usual);
            alike.and_then(|(_, other)| self.apart(measure, value, other)).unwrap_or(usual)
        };
        let part = |part: &Part| match part {
            Part::Text(text) => text.to_string(),
            Part::Figure { measure, value } => figure(*measure, *value),
            _ => String::new(),
        };
        message.parts().iter().map(part).collect()
    }

    /// Formats a value in SI with its unit and the fewest decimals that tell it from another one; `None` if it takes more than nine, which are rounding.
    fn apart(self, measure: Measure, value: f64, other: f64) -> Option<String> {
        let [value, other] = [value, other].map(|si| self.convert(measure, si));
        let mut printed = (1..=9).map(|decimals| [value, other].map(|number| format!("{number:.decimals$}")));
        let [number, _] = printed.find(|[one, other]| one != other)?;
        Some(self.with_unit(measure, number))
    }

    /// Formats a value in SI with its unit.
    pub fn quantity(self, measure: Measure, si: f64) -> String {
        self.with_unit(measure, self.number(measure, si, 0.0))
    }

    fn with_unit(self, measure: Measure, number: String) -> String {
        let unit = self.unit(measure);
        if unit.is_empty() { number } else { format!("{number} {unit}") }
    }
}

/// Returns the size of a quantity in a collision of vehicles, in SI, of which a trillionth is rounding; 0 for those that may have any size.
pub fn size(measure: Measure) -> f64 {
    match measure {
        Measure::Ratio
        | Measure::Time
        | Measure::Speed
        | Measure::RoadSpeed
        | Measure::Length
        | Measure::Angle
        | Measure::YawRate
        | Measure::Impulse
        | Measure::MomentImpulse
        | Measure::Energy => 1.0,
        _ => 0.0,
    }
}

/// Formats a number with six significant digits and no trailing zeros.
pub fn trim(value: f64) -> String {
    if !(1e-9..1e12).contains(&value.abs()) && value != 0.0 {
        let text = format!("{value:.5e}");
        let Some((digits, exponent)) = text.split_once('e') else { return text };
        return format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'));
    }
    let digits = (5.0 - libm::log10(value.abs().max(1e-9)).floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_differ_are_told_apart() {
        for (measure, values, printed) in [
            (Measure::Length, [0.370_1, 0.370_4], "0.3701 m after 0.3704 m"),
            (Measure::Length, [0.370_4, 0.370_4], "0.37 m after 0.37 m"),
            (Measure::Length, [0.37, 0.38], "0.37 m after 0.38 m"),
            (Measure::Ratio, [0.123_456_71, 0.123_456_72], "0.12345671 after 0.12345672"),
            (Measure::Time, [1e-20, 2e-20], "1.000e-20 s after 2.000e-20 s"),
        ] {
            let message = Message::new().figure(measure, values[0]).text(" after ").figure(measure, values[1]);
            assert_eq!(Units::Si.sentence(&message), printed);
        }
    }

    #[test]
    fn six_digits() {
        assert_eq!(trim(0.660_644_48), "0.660644");
        assert_eq!(trim(-0.5), "-0.5");
        assert_eq!(trim(1200.0), "1200");
        assert_eq!(trim(0.0), "0");
        assert_eq!([f64::NAN, 1e300, -1.234_567_8e13, 1e-20].map(trim), ["NaN", "1e300", "-1.23457e13", "1e-20"]);
    }

    #[test]
    fn a_sentence_is_in_the_units_asked_for() {
        let message =
            Message::new().text("gain ").figure(Measure::Energy, 135.581_794_833_140_04).text(", e ").figure(Measure::Ratio, 0.15);
        assert_eq!(Units::Us.sentence(&message), "gain 100 ft lb, e 0.15");
        assert_eq!(Units::Si.sentence(&message), "gain 136 J, e 0.15");
    }

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
        for measure in Measure::ALL {
            for units in [Units::Us, Units::Si, Units::Uk] {
                assert!(units.convert(measure, 1.0).is_finite(), "{measure:?}");
            }
        }
        assert_eq!(Units::Us.convert(Measure::Speed, 0.3048), 1.0); // the international foot
    }

    #[test]
    fn uk_is_si_with_miles_per_hour() {
        for measure in Measure::ALL {
            let is_speed = [Measure::Speed, Measure::RoadSpeed].contains(&measure);
            let unit = if is_speed { "mph" } else { Units::Si.unit(measure) };
            assert_eq!(Units::Uk.unit(measure), unit, "{measure:?}");
        }
        assert_eq!(Units::Uk.quantity(Measure::RoadSpeed, 44.704), "100.0 mph"); // 1609.344 m/3600 s
        assert_eq!([Units::Us, Units::Si, Units::Uk].map(|units| units.on_the_road(Measure::Speed).is_some()), [true, true, false]);
    }
}
