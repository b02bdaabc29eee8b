//! Named numbers of a case file.

use std::fmt;

use planar_impact::{Input, Side};

use super::braking::{SkidKey, SkidNumber};
use super::crush::CrushKey;
use super::domain::Domain;
use crate::quantity::Kind;
use crate::units::Measure;

/// A number of a case file that can be varied.
///
/// Most are inputs of the library; the others are alternatives that a file may give instead, and numbers of the crush.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// An input of the collision. The impulse ratio and the moment impulse are inputs only where the file gives them as numbers.
    Input(Input),
    /// The radius of gyration, given instead of the yaw inertia.
    RadiusOfGyration(Side),
    /// The speed along the heading.
    Speed(Side),
    /// A number of the crush.
    Crush(Side, CrushKey),
    /// A number of a skid before the impact.
    Skid(Side, SkidKey),
    /// The friction of `[rest]`, of which a case has correlations alone: it is no input that can be set.
    RestFriction,
    /// How many standard deviations a restitution over the closing speed is above its mean.
    RestitutionScatter,
    /// The coefficient of friction that limits the impulse ratio.
    Friction,
    /// The fraction of the critical impulse ratio.
    RatioOfCritical,
    /// The fraction of the critical moment impulse.
    MomentOfCritical,
}

impl Parameter {
    /// Returns which quantity it gives where several parameters can, and that of which vehicle; `None` for any other.
    fn form(self) -> Option<(u8, Option<Side>)> {
        match self {
            Parameter::Speed(side) | Parameter::Input(Input::VelocityX(side) | Input::VelocityY(side)) => Some((0, Some(side))),
            Parameter::RadiusOfGyration(side) | Parameter::Input(Input::YawInertia(side)) => Some((1, Some(side))),
            Parameter::Friction | Parameter::RatioOfCritical | Parameter::Input(Input::ImpulseRatio) => Some((2, None)),
            Parameter::MomentOfCritical | Parameter::Input(Input::Moment) => Some((3, None)),
            Parameter::RestitutionScatter | Parameter::Input(Input::Restitution) => Some((4, None)),
            _ => None,
        }
    }

    /// Returns `true` if it gives what another one gives, be it in another form or in part.
    pub fn replaces(self, other: Parameter) -> bool {
        self == other || self.form().is_some_and(|form| other.form() == Some(form))
    }

    /// Returns `true` if both give one quantity in different forms, so that one alone can be set, such as a speed and a component of the velocity.
    pub fn excludes(self, other: Parameter) -> bool {
        let is_component = |parameter| matches!(parameter, Parameter::Input(Input::VelocityX(_) | Input::VelocityY(_)));
        match (self, other) {
            (Parameter::Crush(one, key), Parameter::Crush(two, other)) => one == two && key.excludes(other),
            _ => self != other && self.replaces(other) && !(is_component(self) && is_component(other)),
        }
    }

    /// Returns the parameter with this name or symbol, whether or not a case has it.
    pub fn named(name: &str) -> Option<Parameter> {
        if let Some(input) = Input::named(name) {
            return Some(Parameter::Input(input));
        }
        match name {
            "contact.restitution.scatter" => return Some(Parameter::RestitutionScatter),
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
        if let Some((side, key)) = name.strip_prefix("before.").and_then(of_vehicle) {
            return SkidKey::named(key.strip_prefix("skid.")?).map(|key| Parameter::Skid(side, key));
        }
        let (side, key) = of_vehicle(name)?;
        match key {
            "speed" => Some(Parameter::Speed(side)),
            "radius_of_gyration" => Some(Parameter::RadiusOfGyration(side)),
            _ => CrushKey::named(key.strip_prefix("crush.")?).map(|key| Parameter::Crush(side, key)),
        }
    }

    /// Returns its symbol, the paper's if the paper has one.
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

    /// Returns the vehicle it belongs to, or `None` if it belongs to the contact.
    pub fn side(self) -> Option<Side> {
        match self {
            Parameter::Input(input) => input.side(),
            Parameter::RadiusOfGyration(side) | Parameter::Speed(side) | Parameter::Crush(side, _) | Parameter::Skid(side, _) => Some(side),
            _ => None,
        }
    }

    /// Returns `true` for what a point mass has not: a yaw inertia and an impact center.
    pub(crate) fn is_of_extended_body(self) -> bool {
        use Input::{ImpactCenterForward, ImpactCenterLeft, YawInertia};
        matches!(self, Parameter::RadiusOfGyration(_) | Parameter::Input(ImpactCenterForward(_) | ImpactCenterLeft(_) | YawInertia(_)))
    }

    /// Returns `true` for the friction of a skid.
    pub(crate) fn is_friction_of_skid(self) -> bool {
        matches!(self, Parameter::Skid(_, SkidKey { of: SkidNumber::Friction, .. }))
    }

    /// Returns the kind of quantity that its values are written as.
    pub fn kind(self) -> Kind {
        self.measure().into()
    }

    /// Returns its measure.
    pub fn measure(self) -> Measure {
        match self {
            Parameter::Input(input) => input.measure(),
            Parameter::Speed(_) => Measure::Speed,
            Parameter::RadiusOfGyration(_) => Measure::Length,
            Parameter::Crush(_, key) => key.measure(),
            Parameter::Skid(_, key) => key.measure(),
            Parameter::RestitutionScatter
            | Parameter::RestFriction
            | Parameter::Friction
            | Parameter::RatioOfCritical
            | Parameter::MomentOfCritical => Measure::Ratio,
        }
    }

    /// Returns the values that a case file may give it.
    pub fn domain(self) -> Domain {
        match self {
            Parameter::Input(Input::Mass(_) | Input::YawInertia(_)) | Parameter::RadiusOfGyration(_) => Domain::Positive,
            Parameter::Crush(_, key) => key.domain(),
            Parameter::Skid(_, key) => key.domain(),
            Parameter::Friction => Domain::NotNegative,
            Parameter::Input(Input::Restitution) | Parameter::MomentOfCritical => Domain::Fraction,
            _ => Domain::Any,
        }
    }
}

/// Splits `vehicle.1.key` into the side and the key.
pub fn of_vehicle(name: &str) -> Option<(Side, &str)> {
    let one = name.strip_prefix("vehicle.1.").map(|key| (Side::One, key));
    one.or_else(|| name.strip_prefix("vehicle.2.").map(|key| (Side::Two, key)))
}

/// Returns 1 or 2.
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
            Parameter::Skid(side, key) => write!(f, "before.vehicle.{}.skid.{key}", number(*side)),
            Parameter::RestFriction => f.write_str("rest.friction"),
            Parameter::RestitutionScatter => f.write_str("contact.restitution.scatter"),
            Parameter::Friction => f.write_str("contact.friction"),
            Parameter::RatioOfCritical => f.write_str("contact.impulse_ratio.of_critical"),
            Parameter::MomentOfCritical => f.write_str("contact.moment.of_critical"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::crush::FormKey;

    #[test]
    fn every_parameter_is_named_and_read_back() {
        let mut all: Vec<Parameter> = Input::ALL.into_iter().map(Parameter::Input).collect();
        for side in [Side::One, Side::Two] {
            all.extend([Parameter::RadiusOfGyration(side), Parameter::Speed(side)]);
            use CrushKey::*;
            let keys = [Width, Station(2), Depth(1), Depth(12), Offset, Angle, Onset, Slope, Saturation, Pdof];
            let of_zones = [ZoneOnset(1), ZoneSlope(2), ZoneEnd(10)];
            let of_forms = FormKey::ALL.into_iter().flat_map(|key| [Form(key), ZoneForm(2, key)]);
            all.extend(keys.into_iter().chain(of_zones).chain(of_forms).map(|key| Parameter::Crush(side, key)));
        }
        all.extend([Parameter::RestitutionScatter, Parameter::Friction, Parameter::RatioOfCritical, Parameter::MomentOfCritical]);
        all.extend(SkidNumber::ALL.map(|of| Parameter::Skid(Side::Two, SkidKey { skid: 3, of })));
        for parameter in all {
            assert_eq!(Parameter::named(&parameter.to_string()), Some(parameter));
            assert_eq!(parameter.side().is_some(), parameter.to_string().contains("vehicle."), "{parameter}");
            // A value in the unit of its measure can be parsed as its kind.
            let unit = crate::units::Units::Us.unit(parameter.measure());
            assert!(crate::quantity::parse(&format!("1 {unit}"), parameter.kind()).is_ok(), "{parameter}");
        }
        assert_eq!(Parameter::named("k2"), Some(Parameter::RadiusOfGyration(Side::Two)));
        assert_eq!(Parameter::named("Gamma"), Some(Parameter::Input(Input::CrushPlane)));
        for unknown in
            ["before.vehicle.1.skid.0.length", "before.vehicle.1.skid.+1.length", "before.vehicle.1.mass", "before.vehicle.1.skid.1"]
        {
            assert_eq!(Parameter::named(unknown), None, "{unknown}");
        }
        for unknown in ["vehicle.1.crush.zones.d0", "vehicle.1.crush.zones.0.d0", "vehicle.1.crush.zones.1.C", "vehicle.1.crush."] {
            assert_eq!(Parameter::named(unknown), None, "{unknown}");
        }
        for unknown in ["", "vehicle.3.mass", "vehicle.1.crush.depths.0", "vehicle.1.crush.depths.+1", "vehicle.1.crush.depths.", "energy"]
        {
            assert_eq!(Parameter::named(unknown), None, "{unknown}");
        }
    }
}
