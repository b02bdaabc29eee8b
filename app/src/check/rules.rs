//! The list of rules.

use planar_impact::check::{Rule, Severity};
use schemars::JsonSchema;
use serde::Serialize;

use super::entry::{MALFORMED, MALFORMED_HELP};
use crate::answer::SCHEMA;

/// The answer of `check --rules`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Rules {
    /// The version of this document.
    pub schema: u32,
    /// Every rule.
    pub rules: Vec<Described>,
}

/// A rule.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Described {
    /// Its name.
    pub name: &'static str,
    /// Severity of breaking it.
    pub severity: &'static str,
    /// The meaning of breaking it.
    pub help: &'static str,
    /// The law that must hold.
    pub law: &'static str,
    /// `true` if it is a law of mechanics.
    pub is_law: bool,
}

/// Returns every rule with its description.
pub fn rules() -> Rules {
    let of_library = Rule::ALL.map(|rule| Described {
        name: rule.name(),
        severity: rule.severity().name(),
        help: rule.help(),
        law: rule.law(),
        is_law: !matches!(rule, Rule::Finite | Rule::PlausibleUnits),
    });
    let malformed =
        Described { name: MALFORMED, severity: Severity::Fail.name(), help: MALFORMED_HELP, law: "no law of mechanics", is_law: false };
    Rules { schema: SCHEMA, rules: of_library.into_iter().chain([malformed]).collect() }
}
