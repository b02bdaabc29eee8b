//! Numbers with what is known of them, and directions, in words.

use planar_impact::reconstruct::{Direction, Variable};

use super::question::measure_in;
use crate::case::Case;
use crate::quantity::Kind;
use crate::units::{Measure, Units};
use crate::wording::trim;

/// A value as text, with as many decimals as its standard deviation has to two digits; without one as many as its measure deserves.
pub fn rounded(measure: Measure, value: f64, sd: Option<f64>, units: Units) -> String {
    match sd.filter(|sd| *sd > 0.0 && sd.is_finite()) {
        None => units.number(measure, value, 1e-6),
        Some(sd) => {
            let decimals = decimals(units.convert(measure, sd));
            let value = units.convert(measure, value);
            if value.abs() >= 1e12 {
                return format!("{value:.3e}");
            }
            // Digits before the point that the standard deviation leaves open are 0.
            let text = match usize::try_from(decimals) {
                Ok(decimals) => format!("{value:.decimals$}"),
                Err(_) => {
                    let step = 10_f64.powi(-decimals);
                    format!("{:.0}", (value / step).round() * step)
                }
            };
            without_sign_of_zero(text)
        }
    }
}

/// How many decimals show two digits of a number; below zero where these end before the point.
fn decimals(of: f64) -> i32 {
    (1.0 - of.abs().log10().floor()).clamp(-12.0, 9.0) as i32
}

/// Zero without a sign, however many decimals it has.
pub fn without_sign_of_zero(text: String) -> String {
    let is_zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// A value with its unit and, where it has one, its standard deviation.
pub fn with_spread(measure: Measure, value: f64, sd: Option<f64>, units: Units) -> String {
    let number = rounded(measure, value, sd, units);
    let spread = sd.map_or_else(String::new, |sd| format!(" ± {}", rounded(measure, sd, Some(sd), units)));
    format!("{number}{spread} {}", units.unit(measure)).trim_end().to_owned()
}

/// A share in per cent.
pub fn share(value: f64) -> String {
    format!("{} %", trim((value * 1e3).round() / 10.0))
}

/// How unknowns can move together without the evidence noticing: `vehicle.1.speed by 1 m/s with vehicle.2.speed by -1 m/s`.
pub fn direction(direction: &Direction, case: &Case, units: Units) -> String {
    say(direction, |of, amount| {
        let measure = measure_in(of, case);
        format!("{} {}", trim(units.convert(measure, amount)), units.unit(measure)).trim_end().to_owned()
    })
}

/// The same in SI units and radians.
pub fn direction_in_si(direction: &Direction, case: &Case) -> String {
    say(direction, |of, amount| {
        let Kind { si, .. } = measure_in(of, case).kind();
        format!("{} {si}", trim(amount)).trim_end().to_owned()
    })
}

fn say(direction: &Direction, amount: impl Fn(Variable, f64) -> String) -> String {
    let parts: Vec<String> = direction.parts.iter().map(|(of, by)| format!("{} by {}", of.name(), amount(*of, *by))).collect();
    parts.join(" with ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_has_the_decimals_of_its_deviation() {
        let speed = |value, sd| with_spread(Measure::Speed, value, Some(sd), Units::Si);
        assert_eq!(speed(12.345_67, 0.123), "12.35 ± 0.12 m/s");
        assert_eq!(speed(12.345_67, 3.2), "12.3 ± 3.2 m/s");
        assert_eq!(speed(-0.001, 0.5), "0.00 ± 0.50 m/s");
        assert_eq!(with_spread(Measure::Energy, 123_456.7, Some(5400.0), Units::Si), "123500 ± 5400 J");
        assert_eq!(with_spread(Measure::Energy, 121_531.0, Some(12_153.1), Units::Si), "122000 ± 12000 J");
        assert_eq!(with_spread(Measure::Ratio, 0.123_45, None, Units::Us), "0.123");
        assert_eq!(with_spread(Measure::Ratio, 0.123_45, Some(0.0), Units::Us), "0.123 ± 0");
    }
}
