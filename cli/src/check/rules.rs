//! The list of rules.

use planar_impact::check::{Rule, Severity};
use serde::Serialize;

use super::entry::{MALFORMED, MALFORMED_HELP};
use crate::table::wrap;

/// Every rule with what it means, for people.
pub fn text() -> String {
    let mut text = String::from("The rules, each with what breaking it means, what must hold, and the law.\n");
    let mut add = |name: &str, severity: Severity, help: &str, law: Option<&str>| {
        text.push('\n');
        text.push_str(&wrap(help, &format!("{name} ({severity}): ")));
        if let Some(law) = law {
            text.push_str(&wrap(law, "    "));
        }
    };
    for rule in Rule::ALL {
        let is_law = !matches!(rule, Rule::Finite | Rule::PlausibleUnits);
        add(rule.name(), rule.severity(), rule.help(), is_law.then_some(rule.law()));
    }
    add(MALFORMED, Severity::Fail, MALFORMED_HELP, None);
    text
}

#[derive(Serialize)]
struct Document {
    schema: u32,
    rules: Vec<Described>,
}

#[derive(Serialize)]
struct Described {
    name: &'static str,
    severity: &'static str,
    help: &'static str,
    law: &'static str,
}

/// The same for programs.
///
/// # Errors
///
/// None that is known.
pub fn json() -> serde_json::Result<String> {
    let of_library =
        Rule::ALL.map(|rule| Described { name: rule.name(), severity: rule.severity().name(), help: rule.help(), law: rule.law() });
    let malformed = Described { name: MALFORMED, severity: Severity::Fail.name(), help: MALFORMED_HELP, law: "no law of mechanics" };
    let rules = of_library.into_iter().chain([malformed]).collect();
    serde_json::to_string_pretty(&Document { schema: 1, rules }).map(|text| text + "\n")
}
