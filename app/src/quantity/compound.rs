//! A length in feet and inches: `5 ft 2 in`, `5' 2"`.

use super::unit::symbol;
use super::{QuantityError, excerpt, number};

/// A length of whole feet, and inches up to a foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FeetAndInches {
    /// The feet, with the sign of the whole length.
    feet: f64,
    /// The inches, at least 0.
    inches: f64,
}

impl FeetAndInches {
    /// The unit in which the length is one number.
    pub(super) const UNIT: &str = "in";

    /// Reads feet, inches, or both; `None` if the text is not such a length, or is one with an ordinary unit alone.
    ///
    /// # Errors
    ///
    /// Returns an error for feet that are not whole before inches, and for inches that are not less than a foot.
    pub(super) fn read(text: &str) -> Result<Option<FeetAndInches>, QuantityError> {
        let Ok((first, rest)) = number::split(text) else { return Ok(None) };
        let (name, rest) = first_unit(rest);
        if is_inch_mark(name) && rest.is_empty() {
            return Ok(Some(FeetAndInches { feet: 0.0_f64.copysign(first), inches: first.abs() }));
        }
        if symbol(name) != Some("ft") && !is_foot_mark(name) {
            return Ok(None);
        }
        if rest.is_empty() && is_foot_mark(name) {
            return Ok(Some(FeetAndInches { feet: first, inches: 0.0 }));
        }
        if !rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return Ok(None);
        }
        let (inches, rest) = number::split(rest)?;
        let (name, rest) = first_unit(rest);
        if !rest.is_empty() || !(symbol(name) == Some("in") || is_inch_mark(name)) {
            let help = "write both units, as in `5 ft 2 in`".to_owned();
            return Err(QuantityError::with_help(format!("{} is not a length in feet and inches", excerpt(text)), help));
        }
        let length = FeetAndInches { feet: first, inches };
        if first.fract() != 0.0 || !(0.0..12.0).contains(&inches) {
            let help = format!("write {} in", length.inches());
            let message = format!("{}: feet before inches are whole, and inches less than 12", excerpt(text));
            return Err(QuantityError::with_help(message, help));
        }
        Ok(Some(length))
    }

    /// Returns the length in inches, rounded once.
    pub(super) fn inches(self) -> f64 {
        self.feet.mul_add(12.0, self.inches.copysign(self.feet))
    }
}

/// Splits the name or the mark of a unit from the text after it.
fn first_unit(text: &str) -> (&str, &str) {
    let end = match text.chars().next() {
        Some('\'') if text.starts_with("''") => 2,
        Some(mark) if is_foot_mark(mark.encode_utf8(&mut [0; 4])) || is_inch_mark(mark.encode_utf8(&mut [0; 4])) => mark.len_utf8(),
        _ => text.find(|c: char| !c.is_alphabetic()).unwrap_or(text.len()),
    };
    let (name, rest) = text.split_at(end);
    (name, rest.trim_start())
}

fn is_foot_mark(name: &str) -> bool {
    ["'", "′", "’"].contains(&name)
}

fn is_inch_mark(name: &str) -> bool {
    ["\"", "″", "”", "''"].contains(&name)
}

#[cfg(test)]
mod tests {
    use super::super::{Kind, parse, parse_pair};

    fn length(text: &str) -> Result<f64, String> {
        parse(text, Kind::LENGTH).map(|read| read.si).map_err(|error| error.to_string())
    }

    #[test]
    fn feet_and_inches_are_one_length() {
        // 62 in and 62.5 in by Python's fractions: 62 × 0.0254 and 62.5 × 0.0254.
        for text in ["5 ft 2 in", "5ft2in", "5 feet 2 inches", "5' 2\"", "5'2\"", "5′ 2″", "5' 2''", "62\"", "5 Ft 2 IN"] {
            assert_eq!(length(text), Ok(1.5748), "{text}");
        }
        assert_eq!([length("5 ft 2.5 in"), length("5 ft .5 in"), length("5'")], [Ok(1.5875), Ok(1.5367), Ok(1.524)]);
        assert_eq!(
            [length("-5 ft 2 in"), length("0 ft 2 in"), length("-0 ft 2 in"), length("-62\"")],
            [Ok(-1.5748), Ok(0.0508), Ok(-0.0508), Ok(-1.5748)]
        );
        assert_eq!(parse("5 ft 2 in", Kind::LENGTH).map(|read| (read.value, read.unit)), Ok((62.0, "in".to_owned())));
        let [value, deviation] = parse_pair("5 ft 2 in", "0.5 in", Kind::LENGTH).expect("a length");
        assert_eq!((value.si, deviation.si), (1.5748, 0.0127));
        let [value, deviation] = parse_pair("5 ft", "0 ft 2 in", Kind::LENGTH).expect("a length");
        assert_eq!((value.si, deviation.si), (1.524, 0.0508));
    }

    #[test]
    fn what_may_mean_another_length_is_refused() {
        for (text, help) in [
            ("5.5 ft 2 in", "write 68 in"),
            ("5 ft 14 in", "write 74 in"),
            ("5 ft 2", "write both units"),
            ("5 ft 2 cm", "write both units"),
            ("5 ft 2 in 3 mm", "write both units"),
        ] {
            let error = length(text).expect_err(text);
            assert!(error.contains(help), "{error}");
        }
        assert!(length("5 ft -2 in").is_err() && length("5 in 2 ft").is_err() && length("5'50").is_err());
        assert!(length("1'500 m").expect_err("a separator").contains("write 1500"));
        let speed = parse("5 ft 2 in", Kind::SPEED).expect_err("a length").to_string();
        assert_eq!(speed, "`5 ft 2 in` is a length; a speed is expected, such as \"40 ft/s\"");
        for (value, deviation) in [("5 ft 2 in", "1"), ("5", "1 ft 2 in")] {
            let error = parse_pair(value, deviation, Kind::LENGTH).expect_err("no unit").to_string();
            assert!(error.contains("has no unit beside a length in feet and inches"), "{error}");
        }
    }
}
