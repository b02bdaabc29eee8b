//! What a case file gives as a number, each by one name.

use std::fmt;

use planar_impact::{Input, Side};

use super::crush::CrushKey;
use crate::quantity::Kind;
use crate::units::Measure;

/// A number of a case file that can be varied.
///
/// Most are the library's inputs; the rest are what a file may give instead of one, and the crush.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// An input of the collision. The impulse ratio and the moment are those that the file gives as numbers.
    Input(Input),
    /// The radius of gyration, where the file gives it in place of the yaw inertia.
    RadiusOfGyration(Side),
    /// The speed along the heading.
    Speed(Side),
    /// A number of the crush.
    Crush(Side, CrushKey),
    /// The coefficient of friction that limits the impulse ratio.
    Friction,
    /// The fraction of the critical impulse ratio.
    RatioOfCritical,
    /// The fraction of the critical moment impulse.
    MomentOfCritical,
}

/// The values that a parameter may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Any number.
    Any,
    /// Numbers above zero.
    Positive,
    /// Zero and above.
    NotNegative,
    /// From 0 to 1.
    Fraction,
}

impl Domain {
    /// What a value outside must be; none for one inside.
    pub fn wanted(self, value: f64) -> Option<&'static str> {
        match self {
            Domain::Positive if value <= 0.0 => Some("above zero"),
            Domain::NotNegative if value < 0.0 => Some("at least 0"),
            Domain::Fraction if !(0.0..=1.0).contains(&value) => Some("from 0 to 1"),
            _ => None,
        }
    }
}

impl Parameter {
    /// The parameter of a name or a symbol, whether or not a case has it.
    pub fn named(name: &str) -> Option<Parameter> {
        if let Some(input) = Input::named(name) {
            return Some(Parameter::Input(input));
        }
        match name {
            "contact.friction" => return Some(Parameter::Friction),
            "contact.impulse_ratio.of_critical" => return Some(Parameter::RatioOfCritical),
            "contact.moment.of_critical" => return Some(Parameter::MomentOfCritical),
            _ => (),
        }
        let mut of_vehicles =
            [Side::One, Side::Two].into_iter().flat_map(|side| [Parameter::Speed(side), Parameter::RadiusOfGyration(side)]);
        if let Some(parameter) = of_vehicles.find(|parameter| parameter.symbol() == Some(name)) {
            return Some(parameter);
        }
        let (side, key) = of_vehicle(name)?;
        match key {
            "speed" => Some(Parameter::Speed(side)),
            "radius_of_gyration" => Some(Parameter::RadiusOfGyration(side)),
            _ => CrushKey::named(key.strip_prefix("crush.")?).map(|key| Parameter::Crush(side, key)),
        }
    }

    /// Its symbol, the paper's where it has one.
    pub fn symbol(self) -> Option<&'static str> {
        match self {
            Parameter::Input(input) => Some(input.symbol()),
            Parameter::Speed(Side::One) => Some("v1"),
            Parameter::Speed(Side::Two) => Some("v2"),
            Parameter::RadiusOfGyration(Side::One) => Some("k1"),
            Parameter::RadiusOfGyration(Side::Two) => Some("k2"),
            _ => None,
        }
    }

    /// The vehicle it belongs to; none of the contact.
    pub fn side(self) -> Option<Side> {
        match self {
            Parameter::Input(
                Input::Mass(side)
                | Input::YawInertia(side)
                | Input::Heading(side)
                | Input::ImpactCenterForward(side)
                | Input::ImpactCenterLeft(side)
                | Input::VelocityX(side)
                | Input::VelocityY(side)
                | Input::YawRate(side),
            )
            | Parameter::RadiusOfGyration(side)
            | Parameter::Speed(side)
            | Parameter::Crush(side, _) => Some(side),
            _ => None,
        }
    }

    /// What its values are written as.
    pub fn kind(self) -> Kind {
        self.measure().kind()
    }

    /// What it measures.
    pub fn measure(self) -> Measure {
        match self {
            Parameter::Input(input) => match input {
                Input::Mass(_) => Measure::Mass,
                Input::YawInertia(_) => Measure::YawInertia,
                Input::Heading(_) | Input::CrushPlane => Measure::Angle,
                Input::ImpactCenterForward(_) | Input::ImpactCenterLeft(_) => Measure::Length,
                Input::VelocityX(_) | Input::VelocityY(_) => Measure::Speed,
                Input::YawRate(_) => Measure::YawRate,
                Input::Restitution | Input::ImpulseRatio => Measure::Ratio,
                Input::Moment => Measure::MomentImpulse,
            },
            Parameter::Speed(_) => Measure::Speed,
            Parameter::RadiusOfGyration(_) => Measure::Length,
            Parameter::Crush(_, key) => key.measure(),
            Parameter::Friction | Parameter::RatioOfCritical | Parameter::MomentOfCritical => Measure::Ratio,
        }
    }

    /// The values that a case file may give it.
    pub fn domain(self) -> Domain {
        match self {
            Parameter::Input(Input::Mass(_) | Input::YawInertia(_)) | Parameter::RadiusOfGyration(_) => Domain::Positive,
            Parameter::Crush(_, key) => key.domain(),
            Parameter::Friction => Domain::NotNegative,
            Parameter::Input(Input::Restitution) | Parameter::MomentOfCritical => Domain::Fraction,
            _ => Domain::Any,
        }
    }
}

/// The side and the key of `vehicle.1.key`.
pub fn of_vehicle(name: &str) -> Option<(Side, &str)> {
    let one = name.strip_prefix("vehicle.1.").map(|key| (Side::One, key));
    one.or_else(|| name.strip_prefix("vehicle.2.").map(|key| (Side::Two, key)))
}

/// 1 or 2.
pub fn number(side: Side) -> usize {
    match side {
        Side::One => 1,
        Side::Two => 2,
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let vehicle = |f: &mut fmt::Formatter<'_>, side: &Side, key: &str| write!(f, "vehicle.{}.{key}", number(*side));
        match self {
            Parameter::Input(input) => f.write_str(input.name()),
            Parameter::RadiusOfGyration(side) => vehicle(f, side, "radius_of_gyration"),
            Parameter::Speed(side) => vehicle(f, side, "speed"),
            Parameter::Crush(side, key) => vehicle(f, side, &format!("crush.{key}")),
            Parameter::Friction => f.write_str("contact.friction"),
            Parameter::RatioOfCritical => f.write_str("contact.impulse_ratio.of_critical"),
            Parameter::MomentOfCritical => f.write_str("contact.moment.of_critical"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_named_and_read_back() {
        let mut all: Vec<Parameter> = Input::ALL.into_iter().map(Parameter::Input).collect();
        for side in [Side::One, Side::Two] {
            all.extend([Parameter::RadiusOfGyration(side), Parameter::Speed(side)]);
            use CrushKey::*;
            let keys = [Width, Station(2), Depth(1), Depth(12), Offset, Angle, Onset, Slope, Saturation, Pdof];
            let of_zones = [ZoneOnset(1), ZoneSlope(2), ZoneEnd(10)];
            all.extend(keys.into_iter().chain(of_zones).map(|key| Parameter::Crush(side, key)));
        }
        all.extend([Parameter::Friction, Parameter::RatioOfCritical, Parameter::MomentOfCritical]);
        for parameter in all {
            assert_eq!(Parameter::named(&parameter.to_string()), Some(parameter));
            assert_eq!(parameter.side().is_some(), parameter.to_string().starts_with("vehicle."), "{parameter}");
            // A unit of what it measures can be read as a value of its kind.
            let unit = crate::units::Units::Us.unit(parameter.measure());
            assert!(crate::quantity::parse(&format!("1 {unit}"), parameter.kind()).is_ok(), "{parameter}");
        }
        assert_eq!(Parameter::named("k2"), Some(Parameter::RadiusOfGyration(Side::Two)));
        assert_eq!(Parameter::named("Gamma"), Some(Parameter::Input(Input::CrushPlane)));
        for unknown in ["vehicle.1.crush.zones.d0", "vehicle.1.crush.zones.0.d0", "vehicle.1.crush.zones.1.A", "vehicle.1.crush."] {
            assert_eq!(Parameter::named(unknown), None, "{unknown}");
        }
        for unknown in ["", "vehicle.3.mass", "vehicle.1.crush.depths.0", "vehicle.1.crush.depths.+1", "vehicle.1.crush.depths.", "energy"]
        {
            assert_eq!(Parameter::named(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn domains() {
        assert_eq!(Domain::Positive.wanted(0.0), Some("above zero"));
        assert_eq!(Domain::Fraction.wanted(1.0), None);
        assert_eq!(Domain::Fraction.wanted(1.1), Some("from 0 to 1"));
        assert_eq!(Domain::NotNegative.wanted(-0.1), Some("at least 0"));
        assert_eq!(Domain::Any.wanted(-1e9), None);
    }
}
