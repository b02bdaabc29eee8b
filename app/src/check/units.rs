//! The units of a file of records.

use planar_impact::check::ResolutionGroup;

use super::complaint::Complaints;
use crate::document::{Node, Value};
use crate::quantity::{Conversion, Kind, excerpt, nearest};

/// The size in SI of the unit of each measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Units([Size; ResolutionGroup::COUNT]);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Size {
    Known(f64),
    /// The unit that must be named explicitly, because the derived one is ambiguous.
    Unnamed(&'static str),
}

/// Keys of the required units, each with an example.
const BASE: [(&str, Kind); 4] = [("length", Kind::LENGTH), ("mass", Kind::MASS), ("time", Kind::DURATION), ("angle", Kind::ANGLE)];
/// Keys of the units that are derived from the required ones unless given.
const DERIVED: [(&str, Kind, ResolutionGroup); 6] = [
    ("speed", Kind::SPEED, ResolutionGroup::Velocity),
    ("yaw_rate", Kind::YAW_RATE, ResolutionGroup::YawRate),
    ("yaw_inertia", Kind::YAW_INERTIA, ResolutionGroup::YawInertia),
    ("energy", Kind::ENERGY, ResolutionGroup::Energy),
    ("impulse", Kind::IMPULSE, ResolutionGroup::Impulse),
    ("moment", Kind::MOMENT_IMPULSE, ResolutionGroup::MomentImpulse),
];

impl Units {
    /// Reads the object `units` of a header.
    pub fn read(node: &Node, complaints: &mut Complaints) -> Option<Units> {
        let Value::Table(entries) = &node.value else {
            complaints.push("units", format!("expected an object; found {}", node.value.describe()));
            return None;
        };
        let known = || BASE.iter().map(|(key, _)| *key).chain(DERIVED.iter().map(|(key, ..)| *key));
        for entry in entries.iter().filter(|entry| !known().any(|key| key == entry.key)) {
            let meant = nearest(&entry.key, known()).map_or(String::new(), |key| format!("; did you mean `{key}`?"));
            complaints.push("units", format!("unknown key {}{meant}", excerpt(&entry.key)));
        }
        let text = |key: &str| entries.iter().find(|entry| entry.key == key).map(|entry| &entry.node.value);
        let mut size = |key: &str, kind: Kind, required: bool| match text(key) {
            Some(Value::String(unit)) => complaints.accept(&format!("units.{key}"), size_of(unit, kind)),
            Some(other) => {
                complaints.push(&format!("units.{key}"), format!("expected the name of a unit; found {}", other.describe()));
                None
            }
            None if required => {
                complaints.push("units", format!("`{key}` is missing: the unit of {}, such as \"{}\"", kind.name, kind.si));
                None
            }
            None => None,
        };
        let [length, mass, time, angle] = BASE.map(|(key, kind)| size(key, kind, true));
        let given = DERIVED.map(|(key, kind, _)| size(key, kind, false));
        let (length, mass, time, angle) = (length?, mass?, time?, angle?);
        let is_pound = matches!(text("mass"), Some(Value::String(unit)) if unit.starts_with("lb"));
        let (speed, inertia) = (length / time, mass * length * length);
        let derived = [speed, angle / time, inertia, mass * speed * speed, mass * speed, inertia / time];
        let mut all = [Size::Known(1.0); ResolutionGroup::COUNT];
        all[ResolutionGroup::Mass as usize] = Size::Known(mass);
        all[ResolutionGroup::Length as usize] = Size::Known(length);
        all[ResolutionGroup::Angle as usize] = Size::Known(angle);
        all[ResolutionGroup::Time as usize] = Size::Known(time);
        for (((key, _, measure), derived), given) in DERIVED.into_iter().zip(derived).zip(given) {
            let of_mass = !matches!(measure, ResolutionGroup::Velocity | ResolutionGroup::YawRate);
            all[measure as usize] = match given {
                Some(size) => Size::Known(size),
                None if of_mass && is_pound => Size::Unnamed(key),
                None => Size::Known(derived),
            };
        }
        Some(Units(all))
    }

    /// Returns the size in SI of the unit of a measure.
    ///
    /// # Errors
    ///
    /// Returns a message if the unit is not named and could be based on the pound-mass or the pound-force.
    pub fn size(&self, measure: ResolutionGroup) -> Result<f64, String> {
        match self.0[measure as usize] {
            Size::Known(size) => Ok(size),
            Size::Unnamed(key) => {
                Err(format!("with masses in pounds its unit must be named: add `{key}` to `units`, as \"{}\"", named(key)))
            }
        }
    }
}

fn named(key: &str) -> &'static str {
    match key {
        "energy" => "ft lbf",
        "impulse" => "lbf s",
        "moment" => "lbf s ft",
        _ => "lbf s^2 ft",
    }
}

/// Returns the kind of quantity of a measure.
pub fn kind_of(measure: ResolutionGroup) -> Kind {
    match measure {
        ResolutionGroup::Mass => Kind::MASS,
        ResolutionGroup::YawInertia => Kind::YAW_INERTIA,
        ResolutionGroup::Length => Kind::LENGTH,
        ResolutionGroup::Velocity => Kind::SPEED,
        ResolutionGroup::YawRate => Kind::YAW_RATE,
        ResolutionGroup::Angle => Kind::ANGLE,
        ResolutionGroup::Restitution | ResolutionGroup::ImpulseRatio => Kind::PURE,
        ResolutionGroup::Energy => Kind::ENERGY,
        ResolutionGroup::Impulse => Kind::IMPULSE,
        ResolutionGroup::MomentImpulse => Kind::MOMENT_IMPULSE,
        ResolutionGroup::Time => Kind::DURATION,
    }
}

/// Returns the size of a unit in SI.
///
/// # Errors
///
/// Returns a message if the text is not a unit, or is a unit of another quantity.
pub fn size_of(unit: &str, kind: Kind) -> Result<f64, String> {
    let unit = unit.trim();
    let is_pure = kind.si.is_empty();
    if unit.is_empty() && !is_pure {
        return Err(format!("the unit of {} is missing, such as \"{}\"", kind.name, kind.si));
    }
    if is_pure && matches!(unit, "" | "1" | "-") {
        return Ok(1.0);
    }
    let of_unit = Kind { example: if is_pure { kind.example } else { kind.si }, ..kind };
    Conversion::of(unit, of_unit).map(|conversion| conversion.to_si(1.0)).map_err(|error| match Conversion::of(unit, Kind::FORCE) {
        Ok(_) if kind.dimension == Kind::MASS.dimension => format!("{} (divide weights by the gravity)", error.message),
        _ => error.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_needs_no_unit_and_may_have_one() {
        for (unit, size) in [("", 1.0), ("-", 1.0), (" 1 ", 1.0), ("%", 0.01)] {
            assert_eq!(size_of(unit, Kind::PURE), Ok(size), "{unit}");
        }
        assert_eq!(size_of("ft", Kind::LENGTH), Ok(0.3048));
        let refused = |unit: &str, kind: Kind| size_of(unit, kind).expect_err(unit);
        assert_eq!(refused(" ", Kind::LENGTH), "the unit of a length is missing, such as \"m\"");
        assert_eq!(refused("lbf", Kind::MASS), "`lbf` is a force; a mass is expected, such as \"kg\" (divide weights by the gravity)");
        assert_eq!(refused("m/s", Kind::YAW_RATE), "`m/s` is a speed; a yaw rate is expected, such as \"rad/s\"");
        for (unit, kind) in [("-", Kind::LENGTH), ("kg", Kind::LENGTH), ("kg", Kind::PURE)] {
            assert!(size_of(unit, kind).is_err(), "{unit}");
        }
    }
}
