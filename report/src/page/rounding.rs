//! Formats numbers with as many digits as their uncertainty justifies.

use planar_impact_app::units::{Measure, Units, size, trim};

/// Formats a value with as many decimals as its standard deviation has when rounded to two digits; without one, with
/// the decimals of its measure.
pub fn rounded(measure: Measure, value: f64, sd: Option<f64>, units: Units) -> String {
    match sd.filter(|sd| *sd > 0.0 && sd.is_finite()) {
        None => units.number(measure, value, size(measure)),
        Some(sd) => {
            let decimals = decimals(units.convert(measure, sd));
            let value = units.convert(measure, value);
            if value.abs() >= 1e12 {
                return format!("{value:.3e}");
            }
            // Digits before the point that the standard deviation makes uncertain are 0.
            let text = match usize::try_from(decimals) {
                Ok(decimals) => format!("{value:.decimals$}"),
                Err(_) => {
                    let step = libm::exp10(-f64::from(decimals));
                    format!("{:.0}", (value / step).round() * step)
                }
            };
            without_sign_of_zero(text)
        }
    }
}

/// Returns the number of decimals that show two significant digits of a number; negative if these end before the point.
fn decimals(of: f64) -> i32 {
    (1.0 - libm::log10(of.abs()).floor()).clamp(-12.0, 9.0) as i32
}

/// The side to which the end of a range is rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    Below,
    Nearest,
    Above,
}

/// Formats the end of a range with the decimals of a thousandth of its width, or of a millionth of it, rounded to one side.
pub fn ended(measure: Measure, value: f64, width: f64, toward: Toward, units: Units) -> String {
    /// Of a step: an end that is computed beside a round number by rounding alone is that number.
    const ROUNDING: f64 = 1e-6;
    let decimals = decimals(units.convert(measure, (width * 1e-3).max(value.abs() * 1e-6).max(1e-9))).clamp(0, 9);
    let (value, step) = (units.convert(measure, value), libm::exp10(-f64::from(decimals)));
    let steps = match toward {
        Toward::Below => (value / step + ROUNDING).floor(),
        Toward::Nearest => (value / step).round(),
        Toward::Above => (value / step - ROUNDING).ceil(),
    };
    without_sign_of_zero(format!("{:.*}", decimals as usize, steps * step))
}

/// Removes the sign of a zero, whatever its number of decimals.
pub fn without_sign_of_zero(text: String) -> String {
    let is_zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// Formats a value with its unit and its standard deviation, if it has one.
pub fn with_spread(measure: Measure, value: f64, sd: Option<f64>, units: Units) -> String {
    let number = rounded(measure, value, sd, units);
    let spread = sd.map_or_else(String::new, |sd| format!(" ± {}", rounded(measure, sd, Some(sd), units)));
    format!("{number}{spread} {}", units.unit(measure)).trim_end().to_owned()
}

/// Formats a fraction as a percentage.
pub fn share(value: f64) -> String {
    format!("{} %", trim((value * 1e3).round() / 10.0))
}

/// Formats a probability, which is never printed as zero.
pub fn probability(value: f64) -> String {
    if value < 1e-12 { "below 1e-12".to_owned() } else { digits(value) }
}

/// Formats a number with three significant digits, or with a power of ten if it is small.
pub fn digits(value: f64) -> String {
    match value {
        v if v == 0.0 || v.abs() < 1e-15 => "0".to_owned(),
        v if v.abs() < 1e-3 => format!("{v:.1e}"),
        v if v.abs() < 10.0 => format!("{v:.3}"),
        v if v.abs() < 1e6 => format!("{v:.1}"),
        v => format!("{v:.2e}"),
    }
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
