//! Systems of units by name.

use planar_impact_app::{Issue, Issues, Units};

/// Returns the system with this name; `None` without a name.
///
/// # Errors
///
/// An unknown name.
pub fn named(name: Option<&str>) -> Result<Option<Units>, Issues> {
    match name {
        None => Ok(None),
        Some("us") => Ok(Some(Units::Us)),
        Some("si") => Ok(Some(Units::Si)),
        Some("uk") => Ok(Some(Units::Uk)),
        Some(other) => Err(unknown("units", other, "\"us\", \"si\" and \"uk\"")),
    }
}

/// Returns the issue with a word that an argument does not accept.
pub fn unknown(argument: &str, word: &str, accepted: &str) -> Issues {
    let word: String = word.chars().take(60).collect();
    Issues::of_call(vec![Issue::of_call(argument, format!("unknown value {word:?}"), Some(format!("accepted: {accepted}")))])
}
