//! Statements whose probability is asked for, such as `vehicle.1.speed > 50 km/h`, as they are written.

use std::f64::consts::PI;

use crate::issue::Issue;
use crate::message::Message;
use crate::names;
use crate::notice::Notice;
use crate::units::Measure;

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
    /// Splits `NAME > VALUE`, or the same with `<`, `>=` or `<=`; the value, which begins with a digit or a sign, may come first.
    ///
    /// # Errors
    ///
    /// A text without a comparison, or with two.
    pub fn read(text: &'a str) -> Result<Self, Issue> {
        let Some(place) = text.find(['<', '>']) else {
            let example = "as in --probability \"dV1 > 25 km/h\"".to_owned();
            return Err(names::issue("--probability", text, "expected NAME > VALUE or NAME < VALUE", Some(example)));
        };
        let (name, rest) = (text[..place].trim(), &text[place..]);
        let (is_above, rest) = (rest.starts_with('>'), &rest[1..]);
        if rest.contains(['<', '>']) {
            let help = "ask for each end by a --probability of its own: that of what lies between is the difference".to_owned();
            return Err(names::issue("--probability", text, "it compares twice", Some(help)));
        }
        let (or_equal, value) = rest.strip_prefix('=').map_or((false, rest), |value| (true, value));
        let is_value_first = name.starts_with(|c: char| c.is_ascii_digit() || "+-−.".contains(c));
        let (name, is_above, value) = if is_value_first { (value.trim(), !is_above, name) } else { (name, is_above, value) };
        Ok(Written { name, is_above, or_equal, value })
    }
}

/// Warns of a statement on an angle within half a turn, if many of its values lie beyond: a statement counts angles as they are printed, and quantiles go on.
pub(crate) fn of_half_turn(text: &str, measure: Measure, value: f64, [least, greatest]: [f64; 2]) -> Option<Notice> {
    let is_beyond = measure == Measure::Angle && value.abs() <= PI && (greatest > PI || least < -PI);
    let message = || {
        Message::from("the angle lies on both sides of ").figure(Measure::Angle, PI).text(format!(
            ": `{text}` counts it as it is printed, within half a turn of zero, where quantiles go on beyond; add the probability of the other side"
        ))
    };
    is_beyond.then(|| Notice::warning("half-turn", text, message()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_has_a_name_a_comparison_and_a_value() {
        let read = |text| Written::read(text).map(|found| (found.name, found.is_above, found.or_equal, found.value));
        assert_eq!(read("dV1 > 25 mph"), Ok(("dV1", true, false, " 25 mph")));
        assert_eq!(read("dV1<=25 mph"), Ok(("dV1", false, true, "25 mph")));
        assert_eq!(read("13 mph < dV1"), Ok(("dV1", true, false, "13 mph")));
        assert_eq!(read("-3 deg >= PDOF1"), Ok(("PDOF1", false, true, "-3 deg")));
        assert_eq!(read(">= 1"), Ok(("", true, true, " 1")));
        let refusal = |text| Written::read(text).unwrap_err().message;
        assert!(refusal("dV1 = 25 mph").to_string().contains("expected NAME > VALUE"));
        assert!(["1 < W_n < 2", "W_n > 1 > 0", "W_n << 1"].map(refusal).iter().all(|said| said.to_string().contains("compares twice")));
    }
}
