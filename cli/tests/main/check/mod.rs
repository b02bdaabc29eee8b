//! The verb `check`: three file formats, four report formats, and its findings.

mod forms;
mod found;
mod reports;
mod unusable;

use serde_json::Value;

use crate::process::{Folder, Run, run, run_with_input};

/// The header of a file of records in SI and degrees.
const HEADER: &str = r#""schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "deg"}"#;

/// A record without findings; ID is a placeholder for its name.
const SOUND: &str = r#"{"id": "ID", "bodies": [
    {"mass": 1000, "before": {"v": [3, 0]}, "after": {"v": [-1, 0]}},
    {"mass": 2000, "before": {"v": [-1, 0]}, "after": {"v": [1, 0]}}]}"#;

/// Returns the valid record on one line, with a name, and with a text replaced if one is given.
fn sound(id: &str, (from, to): (&str, &str)) -> String {
    let changed = SOUND.replace(from, to);
    assert!(from.is_empty() || changed != SOUND, "{from} is not in the record");
    changed.replace('\n', " ").replace("\"ID\"", &format!("\"{id}\""))
}

/// Formats records as JSON Lines.
fn lines(records: &[String]) -> String {
    format!("{{{HEADER}}}\n{}\n", records.join("\n"))
}

/// Formats records as a JSON document.
fn document(records: &[String]) -> String {
    format!("{{\n{HEADER},\n\"records\": [\n{}\n]\n}}\n", records.join(",\n"))
}

/// Runs `check` on standard input; returns the exit status and the JSON answer.
fn check(text: &str, arguments: &[&str]) -> (i32, Value) {
    let run = run_with_input(&[&["check", "-", "--format", "json"], arguments].concat(), text);
    assert_eq!(run.err, "", "{text}");
    (run.status, serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error}: {}", run.out)))
}

/// Returns the rules of the findings of a record with a given severity.
fn rules<'a>(record: &'a Value, severity: &str) -> Vec<&'a str> {
    let findings = record["findings"].as_array().expect("findings");
    let of_severity = findings.iter().filter(|finding| finding["severity"] == severity);
    of_severity.map(|finding| finding["rule"].as_str().expect("a name")).collect()
}

fn records(report: &Value) -> &Vec<Value> {
    report["records"].as_array().expect("records")
}

/// Runs `check` on a file with a given name in its own folder.
fn check_file(name: &str, bytes: &[u8], arguments: &[&str]) -> Run {
    let folder = Folder::new();
    folder.write(name, bytes);
    run(folder.path(), &[&["check", name], arguments].concat())
}
