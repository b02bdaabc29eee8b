//! Named numbers of a crush.

use std::fmt;

use crate::case::domain::Domain;
use crate::units::Measure;

/// A number of a crush; stations, depths and zones are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CrushKey {
    /// The width.
    Width,
    /// A station.
    Station(usize),
    /// A depth.
    Depth(usize),
    /// Distance of the measuring line outside the undeformed surface.
    Offset,
    /// Angle of the readings to the normal of the surface.
    Angle,
    /// The stiffness d0, in whichever form the file gives it.
    Onset,
    /// The stiffness d1.
    Slope,
    /// The stiffness d0 of a zone.
    ZoneOnset(usize),
    /// The stiffness d1 of a zone.
    ZoneSlope(usize),
    /// The end of a zone.
    ZoneEnd(usize),
    /// The saturation depth.
    Saturation,
    /// The principal direction of force.
    Pdof,
}

impl CrushKey {
    /// Returns the key with this name (the part after `crush.`), whether or not a crush has it.
    pub fn named(name: &str) -> Option<CrushKey> {
        match name {
            "width" => return Some(CrushKey::Width),
            "measured.offset" => return Some(CrushKey::Offset),
            "measured.angle" => return Some(CrushKey::Angle),
            "d0" => return Some(CrushKey::Onset),
            "d1" => return Some(CrushKey::Slope),
            "saturation" => return Some(CrushKey::Saturation),
            "pdof" => return Some(CrushKey::Pdof),
            _ => (),
        }
        if let Some(place) = name.strip_prefix("stations.") {
            return counted(place).map(CrushKey::Station);
        }
        if let Some(place) = name.strip_prefix("depths.") {
            return counted(place).map(CrushKey::Depth);
        }
        let (zone, key) = name.strip_prefix("zones.")?.split_once('.')?;
        let zone = counted(zone)?;
        match key {
            "d0" => Some(CrushKey::ZoneOnset(zone)),
            "d1" => Some(CrushKey::ZoneSlope(zone)),
            "to" => Some(CrushKey::ZoneEnd(zone)),
            _ => None,
        }
    }

    /// Returns the measure of this number.
    pub fn measure(self) -> Measure {
        match self {
            CrushKey::Width | CrushKey::Station(_) | CrushKey::Depth(_) | CrushKey::Offset => Measure::Length,
            CrushKey::ZoneEnd(_) | CrushKey::Saturation => Measure::Length,
            CrushKey::Angle | CrushKey::Pdof => Measure::Angle,
            CrushKey::Onset | CrushKey::ZoneOnset(_) => Measure::RootForce,
            CrushKey::Slope | CrushKey::ZoneSlope(_) => Measure::RootForcePerLength,
        }
    }

    /// Returns the values that a case file may give this number.
    pub fn domain(self) -> Domain {
        match self {
            CrushKey::Width => Domain::Positive,
            CrushKey::Station(_) | CrushKey::ZoneEnd(_) | CrushKey::Offset | CrushKey::Angle | CrushKey::Pdof => Domain::Any,
            _ => Domain::NotNegative,
        }
    }
}

/// Parses a number from 1 without sign and leading zeros, so that each key has only one name.
fn counted(text: &str) -> Option<usize> {
    let plain = text.bytes().all(|byte| byte.is_ascii_digit()) && !text.starts_with('0');
    plain.then(|| text.parse().ok()).flatten()
}

impl fmt::Display for CrushKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CrushKey::Width => f.write_str("width"),
            CrushKey::Station(place) => write!(f, "stations.{place}"),
            CrushKey::Depth(place) => write!(f, "depths.{place}"),
            CrushKey::Offset => f.write_str("measured.offset"),
            CrushKey::Angle => f.write_str("measured.angle"),
            CrushKey::Onset => f.write_str("d0"),
            CrushKey::Slope => f.write_str("d1"),
            CrushKey::ZoneOnset(zone) => write!(f, "zones.{zone}.d0"),
            CrushKey::ZoneSlope(zone) => write!(f, "zones.{zone}.d1"),
            CrushKey::ZoneEnd(zone) => write!(f, "zones.{zone}.to"),
            CrushKey::Saturation => f.write_str("saturation"),
            CrushKey::Pdof => f.write_str("pdof"),
        }
    }
}
