//! The units of a file of records.

use planar_impact::check::Measure;

use super::complaint::Complaints;
use crate::document::{Node, Value};
use crate::quantity::{self, Kind, excerpt, nearest};

/// The size of each measure's unit in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Units([Size; Measure::COUNT]);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Size {
    Known(f64),
    /// The unit that must be named first, since its derived one would be read in two ways.
    Unnamed(&'static str),
}

/// Keys of the units that must be there, with a unit as an example.
const BASE: [(&str, Kind); 4] = [("length", Kind::LENGTH), ("mass", Kind::MASS), ("time", Kind::DURATION), ("angle", Kind::ANGLE)];
/// Keys of the units that follow from these unless they are there.
const DERIVED: [(&str, Kind, Measure); 5] = [
    ("speed", Kind::SPEED, Measure::Velocity),
    ("yaw_rate", Kind::YAW_RATE, Measure::YawRate),
    ("yaw_inertia", Kind::YAW_INERTIA, Measure::YawInertia),
    ("energy", Kind::ENERGY, Measure::Energy),
    ("impulse", Kind::IMPULSE, Measure::Impulse),
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
        let derived = [length / time, angle / time, mass * length * length, mass * (length / time) * (length / time), mass * length / time];
        let mut all = [Size::Known(1.0); Measure::COUNT];
        all[Measure::Mass as usize] = Size::Known(mass);
        all[Measure::Length as usize] = Size::Known(length);
        all[Measure::Angle as usize] = Size::Known(angle);
        for (((key, _, measure), derived), given) in DERIVED.into_iter().zip(derived).zip(given) {
            let of_mass = !matches!(measure, Measure::Velocity | Measure::YawRate);
            all[measure as usize] = match given {
                Some(size) => Size::Known(size),
                None if of_mass && is_pound => Size::Unnamed(key),
                None => Size::Known(derived),
            };
        }
        Some(Units(all))
    }

    /// A number of the file in SI.
    ///
    /// # Errors
    ///
    /// When its unit is not named and could be one of pound-mass or of pound-force.
    pub fn to_si(&self, measure: Measure, value: f64) -> Result<f64, String> {
        match self.0[measure as usize] {
            Size::Known(size) => Ok(value * size),
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
        _ => "lbf s^2 ft",
    }
}

/// What numbers of a measure are.
pub fn kind_of(measure: Measure) -> Kind {
    match measure {
        Measure::Mass => Kind::MASS,
        Measure::YawInertia => Kind::YAW_INERTIA,
        Measure::Length => Kind::LENGTH,
        Measure::Velocity => Kind::SPEED,
        Measure::YawRate => Kind::YAW_RATE,
        Measure::Angle => Kind::ANGLE,
        Measure::Restitution | Measure::ImpulseRatio => Kind::PURE,
        Measure::Energy => Kind::ENERGY,
        Measure::Impulse => Kind::IMPULSE,
    }
}

/// One of a unit in SI.
///
/// # Errors
///
/// When the text is no unit, or one of something else.
pub fn size_of(unit: &str, kind: Kind) -> Result<f64, String> {
    let unit = unit.trim();
    let is_pure = kind.si.is_empty();
    if unit.is_empty() && !is_pure {
        return Err(format!("the unit of {} is missing, such as \"{}\"", kind.name, kind.si));
    }
    if is_pure && matches!(unit, "" | "1" | "-") {
        return Ok(1.0);
    }
    quantity::parse(&format!("1 {unit}"), kind).map(|one| one.si).map_err(|error| error.to_string())
}
