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
    /// A number of a stiffness that the file gives in another form than d0 and d1.
    Form(FormKey),
    /// The same of a zone.
    ZoneForm(usize, FormKey),
    /// The saturation depth.
    Saturation,
    /// The principal direction of force.
    Pdof,
}

/// A number of a stiffness in another form than d0 and d1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormKey {
    /// A, the force per width at which crush begins.
    ForceOnset,
    /// B, the force per area.
    ForceSlope,
    /// b0, the speed of a barrier test that leaves no crush.
    SpeedOnset,
    /// b1, the increase of the speed with the depth.
    SpeedSlope,
    /// The mass of the vehicle in the test.
    TestMass,
    /// The width of the crush in the test.
    TestWidth,
}

impl CrushKey {
    /// Returns `true` if both give the stiffness of one zone, in different forms.
    pub fn excludes(self, other: CrushKey) -> bool {
        let form = |key: CrushKey| match key {
            CrushKey::Onset | CrushKey::Slope => Some((0, true)),
            CrushKey::ZoneOnset(zone) | CrushKey::ZoneSlope(zone) => Some((zone, true)),
            CrushKey::Form(_) => Some((0, false)),
            CrushKey::ZoneForm(zone, _) => Some((zone, false)),
            _ => None,
        };
        form(self).zip(form(other)).is_some_and(|((one, is_root), (two, is_other_root))| one == two && is_root != is_other_root)
    }
}

impl FormKey {
    /// Every key.
    pub const ALL: [FormKey; 6] =
        [FormKey::ForceOnset, FormKey::ForceSlope, FormKey::SpeedOnset, FormKey::SpeedSlope, FormKey::TestMass, FormKey::TestWidth];

    /// Returns its name in a case file.
    pub fn name(self) -> &'static str {
        match self {
            FormKey::ForceOnset => "A",
            FormKey::ForceSlope => "B",
            FormKey::SpeedOnset => "b0",
            FormKey::SpeedSlope => "b1",
            FormKey::TestMass => "test_mass",
            FormKey::TestWidth => "test_width",
        }
    }

    fn named(name: &str) -> Option<FormKey> {
        FormKey::ALL.into_iter().find(|key| key.name() == name)
    }

    fn measure(self) -> Measure {
        match self {
            FormKey::ForceOnset => Measure::ForcePerWidth,
            FormKey::ForceSlope => Measure::ForcePerArea,
            FormKey::SpeedOnset => Measure::Speed,
            FormKey::SpeedSlope => Measure::SpeedPerLength,
            FormKey::TestMass => Measure::Mass,
            FormKey::TestWidth => Measure::Length,
        }
    }

    fn domain(self) -> Domain {
        match self {
            FormKey::ForceOnset | FormKey::SpeedOnset | FormKey::SpeedSlope => Domain::NotNegative,
            FormKey::ForceSlope | FormKey::TestMass | FormKey::TestWidth => Domain::Positive,
        }
    }
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
        if let Some(key) = FormKey::named(name) {
            return Some(CrushKey::Form(key));
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
            _ => FormKey::named(key).map(|key| CrushKey::ZoneForm(zone, key)),
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
            CrushKey::Form(key) | CrushKey::ZoneForm(_, key) => key.measure(),
        }
    }

    /// Returns the values that a case file may give this number.
    pub fn domain(self) -> Domain {
        match self {
            CrushKey::Width => Domain::Positive,
            CrushKey::Form(key) | CrushKey::ZoneForm(_, key) => key.domain(),
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
            CrushKey::Form(key) => f.write_str(key.name()),
            CrushKey::ZoneForm(zone, key) => write!(f, "zones.{zone}.{}", key.name()),
            CrushKey::Saturation => f.write_str("saturation"),
            CrushKey::Pdof => f.write_str("pdof"),
        }
    }
}
