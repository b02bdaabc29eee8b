//! The numbers of a crush, each by one name.

use std::fmt;

use crate::case::parameter::Domain;
use crate::units::Measure;

/// A number of a crush, places and zones counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CrushKey {
    /// The width.
    Width,
    /// A station.
    Station(usize),
    /// A depth.
    Depth(usize),
    /// How far outside the surface the measuring line lies.
    Offset,
    /// How far the readings lean.
    Angle,
    /// The stiffness d0, whichever form the file gives it in.
    Onset,
    /// The stiffness d1.
    Slope,
    /// The stiffness d0 of a zone.
    ZoneOnset(usize),
    /// The stiffness d1 of a zone.
    ZoneSlope(usize),
    /// Where a zone ends.
    ZoneEnd(usize),
    /// The depth of saturation.
    Saturation,
    /// The principal direction of force.
    Pdof,
}

impl CrushKey {
    /// The key of a name behind `crush.`, whether or not a crush has it.
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

    /// What it measures.
    pub fn measure(self) -> Measure {
        match self {
            CrushKey::Width | CrushKey::Station(_) | CrushKey::Depth(_) | CrushKey::Offset => Measure::Length,
            CrushKey::ZoneEnd(_) | CrushKey::Saturation => Measure::Length,
            CrushKey::Angle | CrushKey::Pdof => Measure::Angle,
            CrushKey::Onset | CrushKey::ZoneOnset(_) => Measure::RootForce,
            CrushKey::Slope | CrushKey::ZoneSlope(_) => Measure::RootForcePerLength,
        }
    }

    /// The values that a case file may give it.
    pub fn domain(self) -> Domain {
        match self {
            CrushKey::Width => Domain::Positive,
            CrushKey::Station(_) | CrushKey::ZoneEnd(_) | CrushKey::Offset | CrushKey::Angle | CrushKey::Pdof => Domain::Any,
            _ => Domain::NotNegative,
        }
    }
}

/// A number from 1, without sign and leading zeros, so that each place has one name.
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
