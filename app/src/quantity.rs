//! A number with its unit, checked for its dimension and for a plausible size.
//!
//! A string includes its unit: `"2564 lb"`, `"-10deg"`, `"1434.9 lbf s^2 ft"`, `"5 ft 2 in"`. A bare number is in SI. The
//! grammar of units is in `quantity/unit.rs`.

mod compound;
mod kind;
mod meant;
mod number;
mod unit;
mod wide;
mod wording;

pub use kind::{Kind, Reach};
pub use number::finite;
pub(crate) use unit::symbol;
pub use wording::{did_you_mean, excerpt, nearest};

use compound::FeetAndInches;
use unit::Unit;
use wide::Wide;

/// A value in SI, and as the file wrote it.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The value in SI units, angles in radians.
    pub si: f64,
    /// The number as the file wrote it.
    pub value: f64,
    /// The unit as the file wrote it, or the SI unit of a bare number.
    pub unit: String,
    /// `true` if the file gave no unit.
    pub bare: bool,
    /// `true` if `lb` was read as the pound-force, which alone measures this quantity, and the unit is not one in which a pound is customarily a force.
    pub pound_force: bool,
}

/// The error of a text that is not a quantity of the required kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QuantityError {
    /// The mistake, with the text that has it.
    pub message: String,
    /// A correct form, if one is known.
    pub help: Option<String>,
}

impl QuantityError {
    /// Adds what is expected, unless a correct form is known or the message has an example.
    pub(crate) fn expected(self, kind: &Kind) -> QuantityError {
        let wanted = kind.wanted();
        let is_told = wanted.rsplit(", ").next().is_some_and(|example| self.message.contains(example));
        QuantityError { help: self.help.or_else(|| (!is_told).then(|| format!("expected {wanted}"))), ..self }
    }

    fn new(message: String) -> QuantityError {
        QuantityError { message, help: None }
    }

    fn with_help(message: String, help: String) -> QuantityError {
        QuantityError { message, help: Some(help) }
    }
}

impl std::fmt::Display for QuantityError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)?;
        self.help.iter().try_for_each(|help| write!(f, " ({help})"))
    }
}

/// Reads a number with its unit. A pure number needs none, and may be in `%`.
///
/// # Errors
///
/// Returns an error if the number or the unit cannot be read, the unit measures something else, or the value is outside the kind's domain.
pub fn parse(text: &str, kind: Kind) -> Result<Quantity, QuantityError> {
    read(text.trim(), kind).map_err(|error| of_range(text.trim(), kind).unwrap_or(error))
}

fn read(text: &str, kind: Kind) -> Result<Quantity, QuantityError> {
    if text.is_empty() {
        return Err(QuantityError::new(format!("the string is empty; expected {}", kind.wanted())));
    }
    if text.contains('±') {
        let help = "give the value alone".to_owned();
        return Err(QuantityError::with_help(format!("{} has a standard deviation, and this number takes none", excerpt(text)), help));
    }
    let (value, written, conversion) = if let Some(length) = FeetAndInches::read(text)? {
        let inches = FeetAndInches::UNIT;
        (length.inches(), inches, Conversion::in_text(text, inches, kind)?)
    } else {
        let (value, written) = number::split(text)?;
        if written.is_empty() && kind.dimension != Kind::PURE.dimension {
            return Err(without_unit(text, kind));
        }
        (value, written, Conversion::in_text(text, written, kind)?)
    };
    let si = conversion.to_si(value);
    if (si == 0.0 && value != 0.0) || !kind.domain.holds(si) {
        return Err(beyond(text, si, kind));
    }
    Ok(Quantity { si, value, unit: written.to_owned(), bare: false, pound_force: conversion.pound_force })
}

/// Reads a value and its uncertainty, each with its unit; a unit that follows only one of them applies to both, as in `12 ± 1 ft/s`.
///
/// # Errors
///
/// As [`parse`], for either of them.
pub fn parse_pair(value: &str, deviation: &str, kind: Kind) -> Result<[Quantity; 2], QuantityError> {
    let unit = |text: &str| match FeetAndInches::read(text.trim())? {
        Some(_) => Ok(FeetAndInches::UNIT.to_owned()),
        None => number::split(text.trim()).map(|(_, unit)| unit.to_owned()),
    };
    let (of_value, of_deviation) = (unit(value)?, unit(deviation)?);
    if let Some(lone) = [(value, deviation, &of_value), (deviation, value, &of_deviation)]
        .into_iter()
        .find_map(|(lone, other, unit)| (unit.is_empty() && FeetAndInches::read(other.trim()) != Ok(None)).then_some(lone))
    {
        let message = format!("{} has no unit beside a length in feet and inches", excerpt(lone.trim()));
        return Err(QuantityError::with_help(message, "write the unit of both numbers, as in `5 ft 2 in ± 1 in`".to_owned()));
    }
    let has_unit = kind.dimension != Kind::PURE.dimension;
    let with = |text: &str, own: &str, other: &str| match own {
        // A percent sign after one of two pure numbers applies to that number only.
        "" if has_unit => format!("{} {other}", text.trim()),
        _ => text.to_owned(),
    };
    let value = parse(&with(value, &of_value, &of_deviation), kind)?;
    let deviation = parse(&with(deviation, &of_deviation, &of_value), kind.difference())?;
    Ok([value, deviation])
}

/// Accepts a number without a unit in SI; `text` is how the file wrote it.
///
/// # Errors
///
/// Returns an error if the value is so implausible that it was probably meant in another unit.
pub fn bare(text: &str, value: f64, kind: Kind) -> Result<Quantity, QuantityError> {
    if kind.bare.holds(value) {
        return Ok(Quantity { si: value, value, unit: kind.si.to_owned(), bare: true, pound_force: false });
    }
    let digits: String = text.chars().filter(|c| *c != '_').take(40).collect();
    if kind.si.is_empty() {
        return Err(beyond(&digits, value, kind));
    }
    let taken = format!("a number without a unit is taken in {0}, and {digits} {0}", kind.si);
    let message = if kind.dimension == Kind::ANGLE.dimension {
        format!("{taken} is {} turns", significant(value.abs() / std::f64::consts::TAU))
    } else {
        format!("{taken} is not a plausible {}", noun(kind.name))
    };
    let is_accepted = |meant: &String| parse(meant, kind).is_ok();
    let as_it_is = format!("{digits} {}", kind.si);
    let meant: Vec<String> = kind.likely.iter().map(|unit| format!("{digits} {unit}")).filter(is_accepted).collect();
    let help = match &meant[..] {
        [] if kind.likely.is_empty() => format!("write the unit, as in \"{}\"", kind.example),
        [] => return Err(beyond(&digits, value, kind)),
        [meant] if !is_accepted(&as_it_is) => format!("did you mean \"{meant}\"?"),
        [meant] => format!("did you mean \"{meant}\"? If not, write \"{as_it_is}\""),
        // Another unit than that which is meant would pass.
        several => format!("write its unit, as in \"{}\"", several.join("\", \"")),
    };
    Err(QuantityError::with_help(message, help))
}

/// Reads a number with its unit, or a number without one in SI, as given on the command line.
///
/// # Errors
///
/// As [`parse`], or as [`bare`] if there is no unit.
pub fn parse_word(text: &str, kind: Kind) -> Result<Quantity, QuantityError> {
    match number::split(text.trim()) {
        Ok((value, "")) if kind.dimension != Kind::PURE.dimension => bare(text.trim(), value, kind),
        _ => parse(text, kind),
    }
}

/// Splits a quantity into its number and its unit, without judging either; inches for feet and inches. `None` if it does not begin with a number.
pub(crate) fn unit_of(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    match FeetAndInches::read(text).ok()? {
        Some(length) => Some((length.inches(), FeetAndInches::UNIT)),
        None => number::split(text).ok().map(|(value, unit)| (value, unit.trim_end())),
    }
}

/// A unit parsed once to convert many values.
#[derive(Debug, Clone, Copy)]
pub struct Conversion {
    /// `None` if the unit is invalid.
    size: Option<Wide>,
    /// `true` if `lb` is read as the pound-force, and that deserves a note.
    pub pound_force: bool,
}

const SECONDS_PER_HOUR: f64 = 3600.0;

impl Conversion {
    /// Creates the conversion of a unit. `ft lb` means a mass times a length here; the energy is `ft lbf`.
    pub fn to(unit: &str) -> Conversion {
        Conversion { size: Unit::parse(unit).ok().map(|unit| unit.size()), pound_force: false }
    }

    /// Creates the conversion of a unit that a quantity of this kind was read with; that of a number without a dimension may be written as 1.
    ///
    /// # Errors
    ///
    /// Returns an error if the unit measures something else.
    pub fn of(unit: &str, kind: Kind) -> Result<Conversion, QuantityError> {
        let is_one = unit == "1" && kind.dimension == Kind::PURE.dimension;
        Conversion::in_text(unit, if is_one { "" } else { unit }, kind)
    }

    /// Reads the unit that stands in the header of a column; brackets without a unit say nothing of numbers that have one.
    ///
    /// # Errors
    ///
    /// As [`Conversion::of`], and if a unit is wanted and there is none.
    pub fn in_header(unit: &str, kind: Kind) -> Result<Conversion, QuantityError> {
        if unit.is_empty() && kind.dimension != Kind::PURE.dimension {
            let message = format!("the unit is empty; {} is expected, such as \"{}\"", kind.name, kind.example);
            return Err(QuantityError::with_help(message, format!("write the unit, or leave it out if the numbers are in {}", kind.si)));
        }
        Conversion::of(unit, kind)
    }

    /// Parses the unit `written` at the end of `text`, and checks that it measures what `kind` requires. A pound is a force where only that does.
    fn in_text(text: &str, written: &str, kind: Kind) -> Result<Conversion, QuantityError> {
        if written.is_empty() {
            return Ok(Conversion::none());
        }
        let unit = Unit::parse_as(written, Some(kind.dimension))?;
        if unit.dimension() == kind.dimension {
            let conversion = Conversion { size: Some(unit.size()), pound_force: false };
            if kind.dimension == Kind::SPEED.dimension && conversion.to_si(SECONDS_PER_HOUR) == 1.0 {
                let message = format!("{} is in meters per hour, as no vehicle is", excerpt(text));
                return Err(QuantityError::with_help(message, "write `mph` or `km/h`".to_owned()));
            }
            return Ok(conversion);
        }
        let forced = unit.with_pound_force();
        if forced.dimension() == kind.dimension {
            // A foot-pound or inch-pound is a unit of energy by custom.
            return Ok(Conversion { size: Some(forced.size()), pound_force: kind.dimension != Kind::ENERGY.dimension });
        }
        let found = Kind::ALL.iter().find(|other| other.dimension == unit.dimension());
        let found = found.map_or_else(|| format!("in {}", unit.dimension()), |found| found.name.to_owned());
        let message = format!("{} is {found}; {} is expected, such as \"{}\"", excerpt(text), kind.name, kind.example);
        let is_gravity = kind.dimension == Kind::ACCELERATION.dimension && unit::symbol(written) == Some("g");
        let is_per_second = kind.dimension == Kind::YAW_RATE.dimension && unit.dimension() == Kind::SPEED_PER_LENGTH.dimension;
        let of_gravity = is_gravity.then_some("`g` is the gram; write `g0` for the standard acceleration of gravity");
        let is_weight = kind.dimension == Kind::MASS.dimension && unit.dimension() == Kind::FORCE.dimension;
        let of_weight =
            is_weight.then_some("a weight is a mass times the gravity: give it as `weight` in a case file, or divide it by the gravity");
        let help = of_gravity.or(of_weight).or_else(|| is_per_second.then_some("write rad/s, deg/s or rpm"));
        Err(QuantityError { message, help: help.map(str::to_owned) })
    }

    /// Creates the conversion of a number without a unit.
    pub fn none() -> Conversion {
        Conversion { size: Some(Wide::new(1.0)), pound_force: false }
    }

    /// Converts a value in this unit to SI, with exactly the result of reading the same text in a file; NaN if the unit was invalid.
    pub fn to_si(self, value: f64) -> f64 {
        self.size.map_or(f64::NAN, |size| Wide::new(value).times(size).value())
    }

    /// Converts a value in SI to this unit; NaN if the unit was invalid.
    pub fn of_si(self, si: f64) -> f64 {
        self.size.map_or(f64::NAN, |size| Wide::new(si).over(size).value())
    }
}

/// Returns the error of two numbers that are the ends of a range, such as `40-45 mph`.
fn of_range(text: &str, kind: Kind) -> Option<QuantityError> {
    /// Bytes of a text that a person writes: each sign in it may stand between the ends.
    const LONGEST: usize = 100;
    if text.len() > LONGEST {
        return None;
    }
    let ends = ["-", "–", "—", "...", "..", " to "].iter().flat_map(|between| text.match_indices(between)).find_map(|(at, between)| {
        let (least, greatest) = (text[..at].trim(), text[at + between.len()..].trim());
        let is_without_unit = number::split(least).is_ok_and(|(_, unit)| unit.is_empty());
        let (_, unit) = unit_of(greatest)?;
        let least = if is_without_unit { format!("{least} {unit}") } else { least.to_owned() };
        let [from, to] = [least.trim(), greatest].map(|end| read(end, kind).ok().map(|end| end.si));
        (from? < to?).then(|| [least.trim().to_owned(), greatest.to_owned()])
    });
    let [least, greatest] = ends?;
    let help = format!("where an input may be uncertain, write {{ min = \"{least}\", max = \"{greatest}\" }}");
    Some(QuantityError::with_help(format!("{} is a range, and not one number", excerpt(text)), help))
}

fn without_unit(text: &str, kind: Kind) -> QuantityError {
    QuantityError::with_help(
        format!("\"{}\" has no unit; expected {}", excerpt(text).trim_matches('`'), kind.wanted()),
        format!("a string needs a unit; a number without quotes is in {}", kind.si),
    )
}

fn beyond(text: &str, si: f64, kind: Kind) -> QuantityError {
    let size = if si.abs() < 1.0 { "too small" } else { "too large" };
    let message = format!("{} is {size} for {}", excerpt(text), kind.name);
    let is_of_map = kind.dimension == Kind::LENGTH.dimension && si.abs() > 1.0;
    let help = "if it is a coordinate of a map, count from a point near the collision: subtract the same from all of them";
    if is_of_map { QuantityError::with_help(message, help.to_owned()) } else { QuantityError::new(message) }
}

/// Removes the article of a name.
fn noun(name: &str) -> &str {
    name.split_once(' ').map_or(name, |(_, noun)| noun)
}

/// Formats a number with three significant digits, or as a power of ten instead of a row of zeros.
fn significant(value: f64) -> String {
    match value {
        v if v < 10.0 => format!("{v:.2}"),
        v if v < 100.0 => format!("{v:.1}"),
        v if v < 1e6 => format!("{v:.0}"),
        v => format!("{v:.0e}"),
    }
}

#[cfg(test)]
mod tests;
