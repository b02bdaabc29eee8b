//! Statements whose probability is asked for, such as `vehicle.1.speed > 50 km/h`, as they are written.

use crate::issue::Issue;
use crate::names;

/// A name compared with a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written<'a> {
    /// The name.
    pub name: &'a str,
    /// `true` for `>` and `>=`.
    pub is_above: bool,
    /// `true` for `>=` and `<=`.
    pub or_equal: bool,
    /// The value with its unit.
    pub value: &'a str,
}

impl<'a> Written<'a> {
    /// Splits `NAME > VALUE`, or the same with `<`, `>=` or `<=`.
    ///
    /// # Errors
    ///
    /// A text without a comparison.
    pub fn read(text: &'a str) -> Result<Self, Issue> {
        let Some(place) = text.find(['<', '>']) else {
            let example = "as in --probability \"vehicle.1.speed > 50 km/h\"".to_owned();
            return Err(names::issue("--probability", text, "expected NAME > VALUE or NAME < VALUE", Some(example)));
        };
        let (name, rest) = (text[..place].trim(), &text[place..]);
        let (is_above, rest) = (rest.starts_with('>'), &rest[1..]);
        let value = rest.strip_prefix('=');
        Ok(Written { name, is_above, or_equal: value.is_some(), value: value.unwrap_or(rest) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_has_a_name_a_comparison_and_a_value() {
        let read = |text| Written::read(text).map(|found| (found.name, found.is_above, found.or_equal, found.value));
        assert_eq!(read("dV1 > 25 mph"), Ok(("dV1", true, false, " 25 mph")));
        assert_eq!(read("dV1<=25 mph"), Ok(("dV1", false, true, "25 mph")));
        assert_eq!(read(">= 1"), Ok(("", true, true, " 1")));
        assert!(read("dV1 = 25 mph").is_err());
    }
}
