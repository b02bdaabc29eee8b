//! Numbers with units: a value in SI is that of the unit's definition in exact arithmetic, and a text that is no quantity is refused.

use dashu_ratio::RBig;
use planar_impact_app::quantity::{self, Conversion, Kind};

use crate::bytes::Bytes;

/// Factors by their definitions: mass, length, time in SI as numerator and denominator, and the kind of a simple unit.
const EXACT: [(&str, i64, i64, Kind); 27] = [
    ("kg", 1, 1, Kind::MASS),
    ("g", 1, 1000, Kind::MASS),
    ("t", 1000, 1, Kind::MASS),
    ("lb", 45_359_237, 100_000_000, Kind::MASS),
    ("m", 1, 1, Kind::LENGTH),
    ("cm", 1, 100, Kind::LENGTH),
    ("dm", 1, 10, Kind::LENGTH),
    ("mm", 1, 1000, Kind::LENGTH),
    ("um", 1, 1_000_000, Kind::LENGTH),
    ("in", 254, 10_000, Kind::LENGTH),
    ("ft", 3048, 10_000, Kind::LENGTH),
    ("yd", 9144, 10_000, Kind::LENGTH),
    ("m/s", 1, 1, Kind::SPEED),
    ("km/h", 1000, 3600, Kind::SPEED),
    ("mph", 1_609_344, 3_600_000, Kind::SPEED),
    ("ft/s", 3048, 10_000, Kind::SPEED),
    ("s", 1, 1, Kind::DURATION),
    ("ms", 1, 1000, Kind::DURATION),
    ("N", 1, 1, Kind::FORCE),
    ("kN", 1000, 1, Kind::FORCE),
    ("MN", 1_000_000, 1, Kind::FORCE),
    ("lbf", 44_482_216_152_605, 10_000_000_000_000, Kind::FORCE),
    ("J", 1, 1, Kind::ENERGY),
    ("kJ", 1000, 1, Kind::ENERGY),
    ("kg m^2", 1, 1, Kind::YAW_INERTIA),
    ("", 1, 1, Kind::PURE),
    ("%", 1, 100, Kind::PURE),
];

const KINDS: [Kind; 12] = [
    Kind::MASS,
    Kind::LENGTH,
    Kind::SPEED,
    Kind::ANGLE,
    Kind::YAW_RATE,
    Kind::YAW_INERTIA,
    Kind::PURE,
    Kind::FORCE,
    Kind::ENERGY,
    Kind::STIFFNESS,
    Kind::ROOT_FORCE,
    Kind::ROOT_FORCE_PER_LENGTH,
];

/// The target.
pub fn run(data: &[u8]) {
    let mut from = Bytes::new(data);
    let value = match from.byte() % 4 {
        0 => from.between(-2000.0, 2000.0),
        1 => from.float(),
        _ => from.magnitude(1e-12, 1e12),
    };
    let (unit, numerator, denominator, kind) = EXACT[from.below(EXACT.len())];
    if value.is_finite() {
        let text = if from.chance(128) { format!("{value} {unit}") } else { format!("  {value:e}{unit} ") };
        by_definition(&text, value, RBig::from_parts(numerator.into(), (denominator as u64).into()), kind);
    }
    let kind = KINDS[from.below(KINDS.len())];
    let rest: Vec<u8> = (0..from.below(40)).map(|_| from.byte()).collect();
    for text in [String::from_utf8_lossy(&rest).into_owned(), from.word(), format!("{value} {}", String::from_utf8_lossy(&rest))] {
        anything(&text, kind);
    }
    // The bytes themselves, so that a dictionary and a corpus of texts help.
    anything(&String::from_utf8_lossy(data), kind);
}

/// What is read is the value times the factor, to the last bit but one.
fn by_definition(text: &str, value: f64, factor: RBig, kind: Kind) {
    let Ok(read) = quantity::parse(text, kind) else { return };
    // The smallest floats have few digits.
    if value != 0.0 && value.abs().min(read.si.abs()) < 1e-290 {
        return;
    }
    let expected = (RBig::try_from(value).expect("finite") * factor).to_f64().value();
    assert!(read.si == expected || (read.si - expected).abs() <= f64::EPSILON * expected.abs(), "{text}: {:e}, not {expected:e}", read.si);
    assert!(kind.domain.holds(read.si), "{text} is beyond its domain");
    let conversion = Conversion::of(&read.unit, kind).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(conversion.to_si(value).to_bits(), read.si.to_bits(), "{text}");
    let back = conversion.of_si(read.si);
    assert!((back - value).abs() <= 4.0 * f64::EPSILON * value.abs(), "{text}: {value:e} came back as {back:e}");
}

/// Any text is a finite quantity of the domain, or is refused with a reason; so is a pair of them.
fn anything(text: &str, kind: Kind) {
    match quantity::parse(text, kind) {
        Ok(read) => {
            assert!(read.si.is_finite() && kind.domain.holds(read.si), "{text:?}: {read:?}");
            let written = format!("{:e} {}", read.value, read.unit);
            let again = quantity::parse(&written, kind).unwrap_or_else(|error| panic!("{text:?} is written as {written:?}: {error}"));
            assert_eq!(again.si.to_bits(), read.si.to_bits(), "{text:?} and {written:?}");
        }
        Err(error) => assert!(!error.message.trim().is_empty(), "{text:?}"),
    }
    if let Some((value, deviation)) = text.split_once('±')
        && let Ok([value, deviation]) = quantity::parse_pair(value, deviation, kind)
    {
        assert!(value.si.is_finite() && deviation.si.is_finite(), "{text:?}");
    }
    let _ = quantity::parse_word(text, kind);
    let _ = quantity::finite(text);
}
