//! The schemas of quantities: each kind on its own, as a measurement, as an unknown, and as an input that may be uncertain.

use serde_json::{Map, Value, json};

use crate::case::MOST_VALUES;
use crate::quantity::{Kind, Reach};

/// A number followed by anything that may be a unit.
const WITH_UNIT: &str = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*([^\s\d.,_']|1\s*/)";
/// The same for a length, which may be in feet and inches: 5' 2".
const LENGTH: &str = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*[^\s\d.,_]";
/// A number, perhaps in percent.
const PURE: &str = r"^\s*[+-]?(\d+\.?\d*|\.\d+)";

/// The definition of a kind of quantity, from the kind and its name.
type Define = fn(&Kind, &str) -> Value;

/// Creates the definitions that a schema refers to, by name: `mass`, `measured_mass`, `unknown_mass`, `input_mass` and so on.
pub(super) fn definitions(schema: &str) -> Map<String, Value> {
    // Quantities come last, because the others refer to them.
    let families: [(&str, Define); 4] = [("measured_", measured), ("unknown_", unknown), ("input_", input), ("", quantity)];
    let mut text = schema.to_owned();
    let mut definitions = Map::new();
    for (family, define) in families {
        for kind in &Kind::ALL {
            let name = name(kind);
            let key = format!("{family}{name}");
            if text.contains(&format!("\"#/$defs/{key}\"")) {
                let definition = define(kind, &name);
                text += &definition.to_string();
                definitions.insert(key, definition);
            }
        }
    }
    definitions
}

/// Returns `yaw_inertia` for "a yaw inertia".
fn name(kind: &Kind) -> String {
    let name = kind.name.split(" (").next().unwrap_or_default();
    name.split_once(' ').map_or(name, |(_, noun)| noun).replace(' ', "_")
}

fn pattern(kind: &Kind) -> &'static str {
    match kind.si {
        "" => PURE,
        "m" => LENGTH,
        _ => WITH_UNIT,
    }
}

fn quantity(kind: &Kind, _: &str) -> Value {
    let unit = if kind.si.is_empty() { "may be in %".to_owned() } else { format!("needs its unit; a bare number is in {}", kind.si) };
    let (Reach::Magnitude(most) | Reach::Positive(_, most)) = kind.bare;
    json!({
        "description": format!("{}, such as \"{}\". A string {unit}.", capitalized(kind.name), kind.example),
        "type": ["number", "string"],
        "pattern": pattern(kind),
        "minimum": -most,
        "maximum": most,
        "examples": [kind.example],
    })
}

fn measured(kind: &Kind, name: &str) -> Value {
    let mut schema = input(kind, name);
    schema["description"] = json!(format!(
        "{} as it was measured: a value, \"value ± standard deviation\", or a table that describes its distribution, of which mean and standard deviation count.",
        capitalized(kind.name)
    ));
    if kind.name == Kind::ENERGY.name {
        schema["properties"]["value"] = json!({ "anyOf": [{ "const": "from crush" }, schema["properties"]["value"].take()] });
    }
    if let Some(forms) = schema["then"]["oneOf"].as_array_mut() {
        forms.insert(0, json!({ "required": ["value"], "propertyNames": { "const": "value" } }));
    }
    if let Some(keys) = schema.as_object_mut() {
        // What is measured is checked where it is used.
        keys.remove("minimum");
        keys.remove("maximum");
    }
    schema
}

fn unknown(kind: &Kind, name: &str) -> Value {
    let of_kind = |text: &str| json!({ "$ref": format!("#/$defs/{name}"), "description": text });
    json!({
        "description": format!("{} to solve for: its start, \"start ± standard deviation\", or a table.", capitalized(kind.name)),
        "type": ["number", "string", "object"],
        "pattern": pattern(kind),
        "properties": {
            "start": of_kind("Where the search starts. Default: the value that the case or the evidence gives."),
            "min": of_kind("Lower bound."),
            "max": of_kind("Upper bound."),
            "sd": { "$ref": format!("#/$defs/{name}"), "description": "Standard deviation of the start, if it is known beforehand.", "minimum": 0 },
        },
        "additionalProperties": false,
        "examples": [{ "start": kind.example }],
    })
}

fn input(kind: &Kind, name: &str) -> Value {
    let of_kind = |text: &str| json!({ "$ref": format!("#/$defs/{name}"), "description": text });
    let size = |text: &str| json!({ "$ref": format!("#/$defs/{name}"), "description": text, "minimum": 0 });
    let pure = |text: &str| json!({ "$ref": "#/$defs/pure_number", "description": text, "minimum": 0 });
    let (Reach::Magnitude(most) | Reach::Positive(_, most)) = kind.bare;
    let form = |required: &[&str], keys: &[&str]| json!({ "required": required, "propertyNames": { "enum": keys } });
    json!({
        "description": format!(
            "{}: a value, \"value ± standard deviation\", \"value ± 5 %\", or a table that describes its distribution.",
            capitalized(kind.name)
        ),
        "type": ["number", "string", "object"],
        "pattern": pattern(kind),
        "minimum": -most,
        "maximum": most,
        "properties": {
            "value": of_kind("The value, or the mean."),
            "sd": size("Its standard deviation; with `min` and `max` that before truncation, with `n` that of the measurements."),
            "relative": {
                "$ref": "#/$defs/pure_number",
                "description": "Its standard deviation as a share of the value; instead of `sd`.",
                "minimum": 0,
                "maximum": 1,
            },
            "resolution": size("The step of the record that it was read from: anything within half a step is equally likely."),
            "min": of_kind("Lower limit; anything up to `max` is equally likely, unless there is a `mode` or a `value`."),
            "mode": of_kind("Most likely value between `min` and `max`, of a triangular distribution."),
            "max": of_kind("Upper limit."),
            "median": of_kind("Median of a log-normal distribution."),
            "factor": pure("Factor, above 1, whose natural logarithm is the standard deviation of the logarithm of the number; with `median`."),
            "mean": of_kind("Mean of `n` measurements with the standard deviation `sd`: Student's t distribution with n \u{2212} 1 degrees of freedom."),
            "n": { "type": "integer", "minimum": 2, "maximum": u32::MAX, "description": "Number of measurements; with `mean` and `sd`." },
            "values": {
                "type": "array",
                "items": { "$ref": format!("#/$defs/{name}") },
                "minItems": 2,
                "maxItems": MOST_VALUES,
                "description": "Measured values, each equally likely.",
            },
            "file": { "type": "string", "description": "CSV file beside the case whose `column` has measured values, each equally likely." },
            "column": { "type": "string", "description": "Name of a column of `file`, without its unit, which stands in brackets: `speed [mph]`." },
        },
        "additionalProperties": false,
        "if": { "type": "object" },
        "then": { "oneOf": [
            form(&["value", "sd"], &["value", "sd"]),
            form(&["value", "relative"], &["value", "relative"]),
            form(&["value", "resolution"], &["value", "resolution"]),
            form(&["value", "sd", "min", "max"], &["value", "sd", "min", "max"]),
            form(&["value", "relative", "min", "max"], &["value", "relative", "min", "max"]),
            form(&["min", "max"], &["min", "mode", "max"]),
            form(&["median", "factor"], &["median", "factor"]),
            form(&["mean", "sd", "n"], &["mean", "sd", "n"]),
            form(&["values"], &["values"]),
            form(&["file", "column"], &["file", "column"]),
        ] },
        "examples": [kind.example],
    })
}

fn capitalized(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
