//! Units: their dimensions, sizes and notation.
//!
//! A unit is a product of named factors, then any number of quotients:
//!
//! ```text
//! unit    = [ "1" "/" ] factor { (space | "*" | "·" | "-") factor } { "/" factor }
//! factor  = name [ "^" exponent | superscript ]
//! ```
//!
//! `/` divides by the one factor after it. A product after a `/` is refused, because some people read `J/kg m` as
//! J/(kg m) and others as (J/kg) m. Exponents are whole or half.

use super::meant::{self, Place};
use super::wide::Wide;
use super::{QuantityError, excerpt};

/// Exponents of mass, length, time and angle, counted in halves so that N^0.5 has a dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dimension([i16; 4]);

impl Dimension {
    /// Creates a dimension from whole exponents of mass, length, time and angle.
    pub const fn new(mass: i16, length: i16, time: i16, angle: i16) -> Dimension {
        Dimension([2 * mass, 2 * length, 2 * time, 2 * angle])
    }

    /// Creates a dimension from exponents of mass, length, time and angle counted in halves.
    pub const fn halves(mass: i16, length: i16, time: i16, angle: i16) -> Dimension {
        Dimension([mass, length, time, angle])
    }

    /// Multiplies this dimension by a power of `other`, whose exponents are whole.
    fn times_power(self, other: Dimension, halves: i16) -> Dimension {
        let mut product = self.0;
        for (exponent, factor) in product.iter_mut().zip(other.0) {
            *exponent += factor * halves / 2;
        }
        Dimension(product)
    }
}

/// Writes the dimension in SI base units, such as `kg m^2 s^-1`.
impl std::fmt::Display for Dimension {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut space = "";
        for (name, halves) in ["kg", "m", "s", "rad"].into_iter().zip(self.0) {
            match halves {
                0 => continue,
                2 => write!(f, "{space}{name}")?,
                _ => write!(f, "{space}{name}^{}", f64::from(halves) / 2.0)?,
            }
            space = " ";
        }
        Ok(())
    }
}

/// A unit of `numerator / denominator` SI units, both exact, times π if `pi` is set.
#[derive(Debug)]
pub(super) struct Named {
    /// Its symbol, then the other names that people write.
    names: &'static [&'static str],
    dimension: Dimension,
    numerator: f64,
    denominator: f64,
    pi: bool,
}

impl Named {
    /// Returns its symbol.
    pub(super) fn symbol(&self) -> &'static str {
        self.names[0]
    }
}

const fn named(dimension: Dimension, names: &'static [&'static str], numerator: f64, denominator: f64) -> Named {
    Named { names, dimension, numerator, denominator, pi: false }
}

/// Creates a unit of `numerator / denominator` times π.
const fn of_pi(dimension: Dimension, names: &'static [&'static str], numerator: f64, denominator: f64) -> Named {
    Named { names, dimension, numerator, denominator, pi: true }
}

const PURE: Dimension = Dimension::new(0, 0, 0, 0);
const MASS: Dimension = Dimension::new(1, 0, 0, 0);
const LENGTH: Dimension = Dimension::new(0, 1, 0, 0);
const TIME: Dimension = Dimension::new(0, 0, 1, 0);
const ANGLE: Dimension = Dimension::new(0, 0, 0, 1);
const SPEED: Dimension = Dimension::new(0, 1, -1, 0);
const YAW_RATE: Dimension = Dimension::new(0, 0, -1, 1);
const ACCELERATION: Dimension = Dimension::new(0, 1, -2, 0);
const FORCE: Dimension = Dimension::new(1, 1, -2, 0);
const ENERGY: Dimension = Dimension::new(1, 2, -2, 0);
const PRESSURE: Dimension = Dimension::new(1, -1, -2, 0);

/// The pound-force in units of 1e-13 N: 0.453 592 37 kg × 9.806 65 m/s², exactly.
const POUND_FORCE: f64 = 45_359_237.0 * 980_665.0;

/// All units. The factors of the international yard and pound (1959), the standard gravity (1901) and the international
/// knot are exact by definition. `ton` and `grad` are absent because they are several units.
#[rustfmt::skip]
const NAMED: &[Named] = &[
    named(MASS, &["kg", "kgs", "kilogram", "kilograms"], 1.0, 1.0),
    named(MASS, &["g", "gram", "grams"], 1.0, 1e3),
    named(MASS, &["mg"], 1.0, 1e6),
    named(MASS, &["t", "tonne", "tonnes"], 1e3, 1.0),
    named(MASS, &["lb", "lbs", "lbm", "pound", "pounds"], 45_359_237.0, 1e8),
    named(MASS, &["slug", "slugs"], POUND_FORCE, 3048e9), // lbf s²/ft
    named(LENGTH, &["m", "meter", "meters", "metre", "metres"], 1.0, 1.0),
    named(LENGTH, &["cm", "centimeter", "centimeters", "centimetre", "centimetres"], 1.0, 1e2),
    named(LENGTH, &["dm", "decimeter", "decimeters", "decimetre", "decimetres"], 1.0, 1e1),
    named(LENGTH, &["mm", "millimeter", "millimeters", "millimetre", "millimetres"], 1.0, 1e3),
    named(LENGTH, &["um", "\u{b5}m", "\u{3bc}m", "micrometer", "micrometers", "micrometre", "micrometres"], 1.0, 1e6),
    named(LENGTH, &["km", "kilometer", "kilometers", "kilometre", "kilometres"], 1e3, 1.0),
    named(LENGTH, &["in", "inch", "inches"], 254.0, 1e4),
    named(LENGTH, &["ft", "foot", "feet"], 3048.0, 1e4),
    named(LENGTH, &["yd", "yard", "yards"], 9144.0, 1e4),
    named(LENGTH, &["mi", "mile", "miles"], 1_609_344.0, 1e3),
    named(TIME, &["s", "sec", "secs", "second", "seconds"], 1.0, 1.0),
    named(TIME, &["ms", "msec", "millisecond", "milliseconds"], 1.0, 1e3),
    named(TIME, &["us", "\u{b5}s", "\u{3bc}s", "usec", "microsecond", "microseconds"], 1.0, 1e6),
    named(TIME, &["min", "mins", "minute", "minutes"], 60.0, 1.0),
    named(TIME, &["h", "hr", "hrs", "hour", "hours"], 3600.0, 1.0),
    named(SPEED, &["kph", "kmh", "kmph"], 1e3, 3600.0),
    named(SPEED, &["mph"], 1_609_344.0, 36e5),
    named(SPEED, &["fps"], 3048.0, 1e4),
    named(SPEED, &["kn", "knot", "knots"], 1852.0, 3600.0),
    named(ANGLE, &["rad", "radian", "radians"], 1.0, 1.0),
    of_pi(ANGLE, &["deg", "degs", "degree", "degrees", "°"], 1.0, 180.0),
    of_pi(ANGLE, &["gon", "gons"], 1.0, 200.0),
    of_pi(ANGLE, &["rev", "revs", "revolution", "revolutions"], 2.0, 1.0),
    of_pi(YAW_RATE, &["rpm"], 2.0, 60.0),
    named(ACCELERATION, &["g0"], 980_665.0, 1e5),
    named(FORCE, &["N", "newton", "newtons"], 1.0, 1.0),
    named(FORCE, &["kN", "kilonewton", "kilonewtons"], 1e3, 1.0),
    named(FORCE, &["MN", "meganewton", "meganewtons"], 1e6, 1.0),
    named(FORCE, &["lbf"], POUND_FORCE, 1e13),
    named(FORCE, &["kip", "kips"], POUND_FORCE, 1e10),
    named(ENERGY, &["J", "joule", "joules"], 1.0, 1.0),
    named(ENERGY, &["kJ", "kilojoule", "kilojoules"], 1e3, 1.0),
    named(ENERGY, &["MJ", "megajoule", "megajoules"], 1e6, 1.0),
    named(PRESSURE, &["Pa", "pascal", "pascals"], 1.0, 1.0),
    named(PRESSURE, &["kPa", "kilopascal", "kilopascals"], 1e3, 1.0),
    named(PRESSURE, &["MPa", "megapascal", "megapascals"], 1e6, 1.0),
    named(PRESSURE, &["psi"], POUND_FORCE, 1e5 * 254.0 * 254.0), // lbf/in²
    named(PURE, &["%"], 1.0, 1e2),
];

/// Symbols whose capitals count: m is a thousandth and M a million, kn a knot and kN a force.
const CAPITALS_COUNT: [&str; 8] = ["mg", "mm", "ms", "MJ", "MN", "MPa", "kn", "kN"];

/// Returns every name of every unit.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    NAMED.iter().flat_map(|named| named.names).copied()
}

/// Finds a unit by one of its names. Capitals count only in names of one letter and in [`CAPITALS_COUNT`].
pub(super) fn find(name: &str) -> Option<&'static Named> {
    let is_name = |known: &&str| *known == name;
    let is_in_capitals = |known: &&str| name.len() > 1 && known.eq_ignore_ascii_case(name) && !CAPITALS_COUNT.contains(known);
    let with = |is: &dyn Fn(&&str) -> bool| NAMED.iter().find(|named| named.names.iter().any(is));
    with(&is_name).or_else(|| with(&is_in_capitals))
}

/// Returns the symbol of a unit with this name.
pub(crate) fn symbol(name: &str) -> Option<&'static str> {
    find(name).map(Named::symbol)
}

/// A unit as written: named units with their exponents in halves.
#[derive(Debug)]
pub(super) struct Unit(Vec<(&'static Named, i16)>);

impl Unit {
    /// Returns the dimension of the unit.
    pub(super) fn dimension(&self) -> Dimension {
        self.0.iter().fold(PURE, |product, (named, halves)| product.times_power(named.dimension, *halves))
    }

    /// Returns the size of this unit in SI.
    pub(super) fn size(&self) -> Wide {
        let one = Wide::new(1.0);
        self.0.iter().fold(one, |product, (named, halves)| {
            let ratio = Wide::new(named.numerator).over(Wide::new(named.denominator));
            let size = if named.pi { ratio.times(Wide::PI) } else { ratio };
            product.times(size.power(*halves))
        })
    }

    /// Returns this unit with each pound-mass replaced by a pound-force.
    pub(super) fn with_pound_force(&self) -> Unit {
        let forced = |named: &'static Named| if named.symbol() == "lb" { find("lbf").unwrap_or(named) } else { named };
        Unit(self.0.iter().map(|(named, halves)| (forced(named), *halves)).collect())
    }

    /// Parses a unit; the documentation of this module has the grammar.
    pub(super) fn parse(text: &str) -> Result<Unit, QuantityError> {
        Unit::parse_as(text, None)
    }

    /// The same where a dimension is wanted: then a proposal for a name that is unknown has it.
    pub(super) fn parse_as(text: &str, wanted: Option<Dimension>) -> Result<Unit, QuantityError> {
        let text = text.trim();
        Unit::read(text).map_err(|fault| match fault {
            Fault::Unknown { begin, end } => meant::unknown(Place { text, begin, end }, wanted),
            Fault::TooLong => QuantityError::new(format!("the unit {} is too long", excerpt(text))),
            Fault::Exponent(digits) => QuantityError::with_help(
                format!("{} is not the exponent of a unit", excerpt(&format!("^{digits}"))),
                "write a whole or half power, such as ^2, ^0.5 or ^-1".to_owned(),
            ),
            Fault::Ambiguous => QuantityError::with_help(
                format!("{} has a product behind `/`, which can be read in two ways", excerpt(text)),
                meant::PRODUCTS_FIRST.to_owned(),
            ),
        })
    }

    /// Returns `true` if it has a dimension, at least with its pounds as forces.
    pub(super) fn measures(&self, wanted: Dimension) -> bool {
        self.dimension() == wanted || self.with_pound_force().dimension() == wanted
    }

    /// Reads a unit without blanks around it, and judges nothing.
    pub(super) fn read(text: &str) -> Result<Unit, Fault> {
        let mut factors = Vec::new();
        let mut rest = text;
        // 1/s has an empty numerator.
        let below = rest.strip_prefix('1').and_then(|tail| tail.trim_start().strip_prefix('/'));
        let mut divided = below.is_some();
        rest = below.map_or(rest, str::trim_start);
        loop {
            let end = rest.find(ends_name).unwrap_or(rest.len());
            let (name, tail) = rest.split_at(end);
            let begin = text.len() - rest.len();
            let named = find(name).ok_or(Fault::Unknown { begin, end: begin + end })?;
            let (halves, tail) = exponent(tail)?;
            factors.push((named, if divided { -halves } else { halves }));
            if factors.len() > MOST_FACTORS {
                return Err(Fault::TooLong);
            }
            rest = tail.trim_start();
            if rest.is_empty() {
                return Ok(Unit(factors));
            }
            let quotient = rest.strip_prefix('/');
            if divided && quotient.is_none() {
                return Err(Fault::Ambiguous);
            }
            divided = quotient.is_some();
            rest = quotient.or_else(|| rest.strip_prefix(PRODUCT)).unwrap_or(rest).trim_start();
        }
    }
}

/// Why a text is no unit.
pub(super) enum Fault {
    /// A name from the one byte to the other is unknown, or missing.
    Unknown {
        begin: usize,
        end: usize,
    },
    TooLong,
    /// What is raised to these digits.
    Exponent(String),
    Ambiguous,
}

/// Maximum number of factors, which keeps the sums of exponents far within their type.
const MOST_FACTORS: usize = 8;
const PRODUCT: [char; 4] = ['*', '·', '⋅', '-'];
const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

fn ends_name(c: char) -> bool {
    c.is_whitespace() || c == '/' || c == '^' || PRODUCT.contains(&c) || superscript(c).is_some()
}

/// Returns the ordinary character of a superscript.
fn superscript(c: char) -> Option<char> {
    match c {
        '⁻' => Some('-'),
        _ => SUPERSCRIPTS.chars().zip('0'..='9').find(|(raised, _)| *raised == c).map(|(_, digit)| digit),
    }
}

/// Reads the exponent at the start of `text`, in halves (one if absent), and returns the text after it.
fn exponent(text: &str) -> Result<(i16, &str), Fault> {
    let (digits, rest) = if let Some(tail) = text.strip_prefix('^') {
        let sign = usize::from(tail.starts_with(['+', '-']));
        let end = tail[sign..].find(|c: char| !matches!(c, '.' | '0'..='9')).map_or(tail.len(), |end| sign + end);
        (tail[..end].to_owned(), &tail[end..])
    } else {
        let end = text.find(|c| superscript(c).is_none()).unwrap_or(text.len());
        (text[..end].chars().filter_map(superscript).collect(), &text[end..])
    };
    if digits.is_empty() && !text.starts_with('^') {
        return Ok((2, rest));
    }
    let halves = digits.parse::<f64>().unwrap_or(0.0) * 2.0;
    if halves == 0.0 || halves.fract() != 0.0 || halves.abs() > 12.0 {
        return Err(Fault::Exponent(digits));
    }
    // The check above ensures a whole number of at most 12.
    Ok((halves as i16, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dimension(text: &str) -> Dimension {
        Unit::parse(text).unwrap().dimension()
    }

    fn message(text: &str) -> String {
        Unit::parse(text).unwrap_err().to_string()
    }

    #[test]
    fn dimensions() {
        assert_eq!(dimension("lbf s^2 ft"), Dimension::new(1, 2, 0, 0));
        assert_eq!(dimension("slug·ft²"), Dimension::new(1, 2, 0, 0));
        assert_eq!(dimension("N / m^2"), PRESSURE);
        assert_eq!(dimension("lbf^0.5/ft"), Dimension::halves(1, -1, -2, 0));
        assert_eq!(dimension("rad s⁻¹"), YAW_RATE);
        assert_eq!(dimension("°/s"), YAW_RATE);
        assert_eq!(dimension("m/s/s"), ACCELERATION);
        assert_eq!(dimension("kg*m^-1*s^-2"), PRESSURE);
        assert_eq!(dimension("ft-lbf"), ENERGY);
        assert_eq!(dimension("lbf-s^2-ft"), Dimension::new(1, 2, 0, 0));
        assert_eq!(dimension("1/s"), Dimension::new(0, 0, -1, 0));
        assert_eq!(dimension("1 / s/m"), Dimension::new(0, -1, -1, 0));
        assert_eq!(Dimension::halves(1, -1, -2, 0).to_string(), "kg^0.5 m^-0.5 s^-1");
    }

    #[test]
    fn bad_units() {
        assert_eq!(message("ft//s"), "the name of a unit is missing in `ft//s`");
        assert_eq!(message("ft/"), "the name of a unit is missing in `ft/`");
        assert_eq!(message("1"), "unknown unit `1`");
        assert_eq!(message("1/"), "the name of a unit is missing in `1/`");
        assert_eq!(message("s 1/m"), "unknown unit `1`");
        assert_eq!(
            message("J/kg m"),
            "`J/kg m` has a product behind `/`, which can be read in two ways \
             (put the products first and a `/` before each divisor, as in `lbf s/ft/in`)"
        );
        for exponent in ["m^", "m^0", "m^0.3", "m^99", "m^--1", "m^1e2", "m⁻"] {
            assert!(Unit::parse(exponent).is_err(), "{exponent}");
        }
        assert_eq!(message(&"m ".repeat(9)), "the unit `m m m m m m m m m` is too long");
    }

    #[test]
    fn names_are_unique() {
        let names: Vec<&str> = NAMED.iter().flat_map(|named| named.names).copied().collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "{name}");
        }
    }

    #[test]
    fn capitals_never_select_another_unit() {
        let names = || NAMED.iter().flat_map(|named| named.names.iter().map(move |name| (named, *name)));
        for (named, name) in names() {
            for written in [name.to_uppercase(), name.to_lowercase()] {
                let others = names().filter(|(other, known)| other.names != named.names && known.eq_ignore_ascii_case(&written));
                if find(&written).is_some_and(|found| !found.names.contains(&written.as_str())) {
                    assert_eq!(others.count(), 0, "{written}");
                }
            }
        }
        for refused in ["M", "S", "T", "G", "n", "Mg", "MS", "MM", "mPa", "mpa", "mJ", "mN", "mn", "Mn", "Kn", "KN"] {
            assert!(find(refused).is_none(), "{refused}");
        }
        for (written, is) in [("MPH", "mph"), ("Lbs", "lb"), ("KG", "kg"), ("Km", "km"), ("IN", "in"), ("Feet", "ft"), ("LBF", "lbf")] {
            assert_eq!(symbol(written), Some(is));
        }
    }
}
