//! The header of a file of records: its format, units and program.

use super::complaint::Complaints;
use super::units::Units;
use crate::document::{Entry, Value};
use crate::quantity::{excerpt, nearest};

/// The format that this program reads.
pub const SCHEMA: &str = "planar-impact-record/1";
const FAMILY: &str = "planar-impact-record/";

/// Reads the units from the entries of the header object; `also` is another key that is allowed in it.
///
/// # Errors
///
/// Returns everything wrong with the header.
pub fn read(entries: &[Entry], also: Option<&str>) -> Result<Units, Complaints> {
    let mut complaints = Complaints::default();
    let find = |key: &str| entries.iter().find(|entry| entry.key == key).map(|entry| &entry.node);
    if let (Some(Value::Number(_)), None) = (find("schema").map(|node| &node.value), find("units")) {
        complaints.push("schema", format!("expected \"{SCHEMA}\", found a number, as an answer of this program has: it has no records"));
        return Err(complaints);
    }
    let known = || ["schema", "units", "tool"].into_iter().chain(also);
    for entry in entries.iter().filter(|entry| !known().any(|key| key == entry.key)) {
        let meant = nearest(&entry.key, known()).map_or_else(
            || format!("; the keys known here are {}", known().collect::<Vec<_>>().join(", ")),
            |key| format!("; did you mean `{key}`?"),
        );
        complaints.push("", format!("unknown key {}{meant}", excerpt(&entry.key)));
    }
    match find("schema").map(|node| &node.value) {
        Some(Value::String(schema)) => drop(complaints.accept("schema", check_schema(schema))),
        Some(other) => complaints.push("schema", format!("expected \"{SCHEMA}\", found {}", other.describe())),
        None => complaints.push("", format!("`schema` is missing; expected \"schema\": \"{SCHEMA}\"")),
    }
    if let Some(tool) = find("tool") {
        check_tool(&tool.value, &mut complaints);
    }
    let units = match find("units") {
        Some(node) => Units::read(node, &mut complaints),
        None => {
            let example = r#"{"length": "m", "mass": "kg", "time": "s", "angle": "rad"}"#;
            complaints.push("", format!("`units` is missing, such as \"units\": {example}"));
            None
        }
    };
    match units {
        Some(units) if complaints.is_empty() => Ok(units),
        _ => Err(complaints),
    }
}

/// Checks that this program reads the format.
///
/// # Errors
///
/// Returns a message if it does not.
pub fn check_schema(schema: &str) -> Result<(), String> {
    if schema == SCHEMA {
        return Ok(());
    }
    match schema.strip_prefix(FAMILY).map(str::parse::<u32>) {
        Some(Ok(version)) => Err(format!("version {version} of the format is not known; this program reads version 1, \"{SCHEMA}\"")),
        _ => Err(format!("expected \"{SCHEMA}\", found {}", excerpt(schema))),
    }
}

fn check_tool(tool: &Value, complaints: &mut Complaints) {
    let Value::Table(entries) = tool else {
        return complaints.push("tool", format!("expected an object of `name` and `version`, found {}", tool.describe()));
    };
    for Entry { key, node, .. } in entries {
        match (key.as_str(), &node.value) {
            ("name" | "version", Value::String(_)) => (),
            ("name" | "version", other) => {
                complaints.push(&format!("tool.{key}"), format!("expected a string, found {}", other.describe()))
            }
            _ => complaints.push("tool", format!("unknown key {}; the keys known here are name, version", excerpt(key))),
        }
    }
}
