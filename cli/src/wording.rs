//! Why a collision is refused, in the user's units and with the key that can mend it.

use planar_impact::{Refusal, Tension};

use crate::units::{Measure, Units};

/// The key a refusal is about, what is wrong, and what may help.
pub fn refusal(refusal: &Refusal, units: Units) -> (&'static str, String, Option<String>) {
    let say = |measure, value: f64| units.quantity(measure, value);
    // Beside a meter and a meter a second: rounding reads as zero.
    let beside_one = |measure, value: f64| format!("{} {}", units.number(measure, value, 1.0), units.unit(measure));
    match refusal {
        Refusal::NotFinite { input, value } => (input, format!("it is {value}; a finite number is expected"), None),
        Refusal::NotPositive { input, value } => (input, format!("it is {value} in SI; it must be above zero"), barrier_instead(input)),
        Refusal::OutOfRange { input, value, least, greatest } => {
            let range = greatest.map_or_else(|| format!("at least {least}"), |greatest| format!("from {least} to {greatest}"));
            let percent =
                (*input == "contact.restitution" && *value > 1.0 && *value <= 100.0).then(|| format!("did you mean \"{value} %\"?"));
            (input, format!("it is {value}; it must be {range}"), percent)
        }
        Refusal::NothingMoves => {
            ("vehicle", "both are fixed barriers, and nothing moves".to_owned(), Some("one must be a vehicle".to_owned()))
        }
        Refusal::NotClosing { approach, offset } => {
            let parting = approach * offset > 0.0 && approach.abs() > 1e-9;
            let what = if parting { "the vehicles separate" } else { "the vehicles do not close" };
            let message = format!(
                "{what}: the normal approach velocity is {}, and center of mass 2 lies {} from center of mass 1 along the normal",
                beside_one(Measure::Speed, *approach),
                beside_one(Measure::Length, *offset),
            );
            let help = "they close when the two have opposite signs and neither is zero; check velocities, impact centers and crush plane";
            ("contact", message, Some(help.to_owned()))
        }
        Refusal::Tensile { normal, reason: Tension::Pulls } => {
            let message =
                format!("the normal impulse would have to pull: {} on vehicle 1, towards vehicle 2", say(Measure::Impulse, *normal));
            let help = "sliding does not end in this contact; give `impulse_ratio` as a number, or a `friction`";
            ("contact", message, Some(help.to_owned()))
        }
        Refusal::Tensile { normal, .. } => {
            let message =
                format!("the pair wedges at this impulse ratio: K_nn + mu K_nt is {normal:.3e} 1/kg, and no push would separate it");
            ("contact.impulse_ratio", message, None)
        }
        Refusal::BeyondCritical { ratio, critical: None } => {
            let message = format!("the impulse ratio {} has the wrong sign: it would speed the sliding up", trim(*ratio));
            ("contact.impulse_ratio", message, None)
        }
        Refusal::BeyondCritical { ratio, critical: Some(critical) } => {
            let message = format!("the impulse ratio {} is beyond the critical one", trim(*ratio));
            let help = format!("it must lie between {} and {}", trim(critical.min(0.0)), trim(critical.max(0.0)));
            ("contact.impulse_ratio", message, Some(help))
        }
        Refusal::EnergyGain { gain, before } => {
            let message = format!(
                "the vehicles would gain energy: {} more than the {} before the impact",
                say(Measure::Energy, *gain),
                say(Measure::Energy, *before),
            );
            (
                "contact.restitution",
                message,
                Some("the restitution is too high for this contact; see `energy` in the documentation".to_owned()),
            )
        }
        other => ("", other.to_string(), None),
    }
}

/// Why a collision is refused, in a word or two.
pub fn short(refusal: &Refusal) -> &'static str {
    match refusal {
        Refusal::NotClosing { .. } => "not closing",
        Refusal::Tensile { reason: Tension::Pulls, .. } => "pulls",
        Refusal::Tensile { .. } => "wedges",
        Refusal::BeyondCritical { .. } => "beyond critical",
        Refusal::EnergyGain { .. } => "energy gain",
        Refusal::OutOfFloatRange => "overflow",
        _ => "out of range",
    }
}

/// What someone who gives no mass may have wanted.
pub fn barrier_instead(key: &str) -> Option<String> {
    key.ends_with("mass").then(|| "a fixed barrier is a [[vehicle]] with `barrier = true`".to_owned())
}

/// What someone who gives a coefficient above 1 may have meant.
pub fn percent_meant(value: f64) -> Option<String> {
    (value > 1.0 && value <= 100.0).then(|| format!("did you mean \"{value} %\"?"))
}

/// A number with six significant digits and no trailing zeros.
pub fn trim(value: f64) -> String {
    let digits = (5.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits() {
        assert_eq!(trim(0.660_644_48), "0.660644");
        assert_eq!(trim(-0.5), "-0.5");
        assert_eq!(trim(1200.0), "1200");
        assert_eq!(trim(0.0), "0");
    }

    #[test]
    fn refusals_are_in_the_units_asked_for() {
        let gain = Refusal::EnergyGain { gain: 135.581_794_833_140_04, before: 1_355.817_948_331_400_4 };
        assert!(refusal(&gain, Units::Us).1.contains("100 ft lb more than the 1000 ft lb"));
        assert!(refusal(&gain, Units::Si).1.contains("136 J more than the 1356 J"));
        let percent = Refusal::OutOfRange { input: "contact.restitution", value: 15.0, least: 0, greatest: Some(1) };
        assert_eq!(
            refusal(&percent, Units::Si),
            ("contact.restitution", "it is 15; it must be from 0 to 1".to_owned(), Some("did you mean \"15 %\"?".to_owned()))
        );
    }
}
