//! Notes and warnings of an answer, typed so that each interface prints them in its reader's units.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

use crate::message::{Message, Part};
use crate::quantity::Quantity;
use crate::units::Units;

/// Severity of a notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// An assumption or an explanation.
    Note,
    /// A result that is possible but unusual.
    Warning,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
        })
    }
}

/// A note or a warning.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// A stable code in kebab case, such as `unit-assumed`.
    pub code: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The path in the case file that it refers to; empty if it refers to the whole case.
    pub path: String,
    /// The sentence, without its full stop.
    pub message: Message,
}

impl Notice {
    /// Creates the note that a number was read in SI because it has no unit; `None` if it has one, or needs none.
    pub(crate) fn unit_assumed(path: &str, of: &Quantity) -> Option<Notice> {
        let Quantity { si, unit, bare, .. } = of;
        (*bare && !unit.is_empty()).then(|| Notice::note("unit-assumed", path, format!("{path} has no unit: {si} {unit} assumed")))
    }

    /// Creates the note that a pound was read as a force.
    pub(crate) fn pound_force_assumed(path: &str) -> Notice {
        Notice::note("pound-force-assumed", path, format!("{path}: `lb` is taken as the pound-force, lbf, because a force is meant"))
    }

    /// Creates the warning of a number without a unit, which counts in that of SI, beside one that has another; of a ratio the unit is empty.
    pub(crate) fn mixed_units(path: impl Into<String>, bare: &str, si: &str, [other, unit]: [&str; 2]) -> Notice {
        let counts = if si.is_empty() { "as a plain number".to_owned() } else { format!("in {si}") };
        let message = format!("{bare} has no unit and counts {counts}, beside {other}, which is in {unit}: write its unit");
        Notice::warning("mixed-units", path, message)
    }

    /// Returns `true` if both say the same of one thing, of which once is enough.
    pub(crate) fn is_alike(&self, other: &Notice) -> bool {
        (self.code, &self.path) == (other.code, &other.path)
    }

    /// Creates a note: an assumption or an explanation.
    pub fn note(code: &'static str, path: impl Into<String>, message: impl Into<Message>) -> Notice {
        Notice { code, severity: Severity::Note, path: path.into(), message: message.into() }
    }

    /// Adds words before its sentence.
    pub fn prefixed(self, prefix: impl Into<Message>) -> Notice {
        Notice { message: prefix.into().join(self.message), ..self }
    }

    /// Creates a warning: a result that is possible but unusual.
    pub fn warning(code: &'static str, path: impl Into<String>, message: impl Into<Message>) -> Notice {
        Notice { severity: Severity::Warning, ..Notice::note(code, path, message) }
    }
}

/// The notices of an answer, in order. In JSON they are `notes`, sentences in SI, and `messages`, the same with code,
/// severity, path and figures; both are omitted if there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notices(pub Vec<Notice>);

/// A notice in JSON.
#[derive(Serialize, JsonSchema)]
struct NoticeEntry<'a> {
    /// A stable code, such as `unit-assumed`.
    code: &'a str,
    severity: Severity,
    /// The path in the case file that it refers to; empty if it refers to the whole case.
    path: &'a str,
    /// The sentence in SI.
    text: String,
    /// The numbers in the sentence, in order.
    figures: Vec<FigureEntry<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct FigureEntry<'a> {
    /// The quantity that the number measures, such as `speed`.
    measure: &'a str,
    /// Its value in SI; angles in radians.
    value: f64,
}

/// The keys that [`Notices`] writes; used only to generate the schema.
#[derive(JsonSchema)]
#[allow(dead_code)]
struct NoticesSchema<'a> {
    /// Notes and warnings as sentences in SI; omitted if there are none.
    #[schemars(default)]
    notes: Vec<String>,
    /// The same with code, severity, path and figures.
    #[schemars(default)]
    messages: Vec<NoticeEntry<'a>>,
}

impl Serialize for Notices {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if !self.0.is_empty() {
            let texts: Vec<String> = self.0.iter().map(|notice| Units::Si.sentence(&notice.message)).collect();
            let entry = |(notice, text): (&Notice, &String)| {
                serde_json::to_value(NoticeEntry {
                    code: notice.code,
                    severity: notice.severity,
                    path: &notice.path,
                    text: text.clone(),
                    figures: notice.message.parts().iter().filter_map(figure).collect(),
                })
            };
            let entries: Result<Vec<_>, _> = self.0.iter().zip(&texts).map(entry).collect();
            map.serialize_entry("notes", &texts)?;
            map.serialize_entry("messages", &entries.map_err(serde::ser::Error::custom)?)?;
        }
        map.end()
    }
}

fn figure(part: &Part) -> Option<FigureEntry<'_>> {
    match part {
        Part::Figure { measure, value } => Some(FigureEntry { measure: measure.name(), value: *value }),
        _ => None,
    }
}

impl JsonSchema for Notices {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Notices".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        NoticesSchema::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Measure;

    #[test]
    fn the_sentence_and_its_figures_are_in_si() {
        let message = Message::from("it starts at ").figure(Measure::Speed, 4.4704);
        let json = serde_json::to_string(&Notices(vec![Notice::warning("start", "unknown", message)])).expect("plain data");
        assert_eq!(
            json,
            r#"{"notes":["it starts at 4.47 m/s"],"messages":[{"code":"start","figures":[{"measure":"speed","value":4.4704}],"path":"unknown","severity":"warning","text":"it starts at 4.47 m/s"}]}"#
        );
        assert_eq!(serde_json::to_string(&Notices::default()).expect("plain data"), "{}");
    }
}
