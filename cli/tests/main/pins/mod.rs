//! Compares every number of the output with a source independent of the code that prints it.
//!
//! `../../reference/keys.csv` has a line for each key of each verb's JSON, with the test in this or another module that checks it.

mod bounds;
mod bounds_of_crush;
mod check;
mod closing_speed;
mod damage;
mod formula;
mod gradient_page;
mod keys;
mod paper;
mod planar;
mod proofs;
mod reconstruct;
mod scene;
mod solve_page;
mod stated;
mod stiffness;
mod sweep;
mod uncertainty;
mod units;
mod verdicts;

use std::path::Path;

use serde_json::Value;

use crate::process::{run_with_input, workspace};

/// Reads a case file as JSON, which is also a valid case file.
fn case(path: &str) -> Value {
    let text = std::fs::read_to_string(workspace().join("cli/examples").join(path)).expect("the example can be read");
    toml::from_str(&text).expect("the example is TOML")
}

/// Returns the document that a verb prints for a case, whatever its exit status.
fn document(verb: &str, case: &Value, arguments: &[&str]) -> Value {
    let run = run_with_input(&[&[verb, "-", "--format", "json"], arguments].concat(), &case.to_string());
    assert!((0..=1).contains(&run.status) && run.err.is_empty(), "{verb} {arguments:?}: {}", run.err);
    serde_json::from_str(&run.out).expect("JSON")
}

/// Reads the lines of a file in `../../reference`.
fn references(name: &str) -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(path).expect("the references can be read");
    text.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn object(value: &Value) -> &serde_json::Map<String, Value> {
    value.as_object().unwrap_or_else(|| panic!("{value} is no object"))
}

fn array(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is no array"))
}

/// Asserts that two numbers differ by at most `size`.
fn close(got: f64, want: f64, size: f64, what: &str) {
    assert!((got - want).abs() <= size, "{what}: {got}, not {want}");
}

/// Collects the expected values that are missing or different. Texts that are numbers are numbers of a reference.
fn differences(got: &Value, want: &Value, tolerance: f64, path: &str, faults: &mut Vec<String>) {
    match want {
        Value::Object(entries) => {
            for (key, want) in entries {
                match got.get(key) {
                    Some(got) => differences(got, want, tolerance, &format!("{path}.{key}"), faults),
                    None => faults.push(format!("{path}.{key} is missing")),
                }
            }
        }
        Value::Array(items) => {
            let count = got.as_array().map_or(0, Vec::len);
            if count != items.len() {
                faults.push(format!("{path} has {count} items, not {}", items.len()));
            }
            items.iter().enumerate().for_each(|(i, want)| differences(&got[i], want, tolerance, &format!("{path}.{i}"), faults));
        }
        Value::String(text) => match text.parse::<f64>() {
            // Values far below everything measured here count as zero.
            Ok(want) if got.as_f64().is_some_and(|got| (got - want).abs() <= tolerance * want.abs().max(1e-9)) => (),
            Err(_) if got == want => (),
            _ => faults.push(format!("{path} is {got}, not {want}")),
        },
        Value::Number(_) => {
            let want = number(want);
            if !got.as_f64().is_some_and(|got| (got - want).abs() <= tolerance * want.abs().max(1e-3)) {
                faults.push(format!("{path} is {got}, not {want}"));
            }
        }
        _ if got == want => (),
        _ => faults.push(format!("{path} is {got}, not {want}")),
    }
}

/// Checks a verb against each line of a reference file.
fn hold(verb: &str, name: &str, tolerance: f64, count: usize) {
    let mut faults = Vec::new();
    let references = references(name);
    for reference in &references {
        let title = reference["case"]["title"].as_str().expect("a title");
        differences(&document(verb, &reference["case"], &[]), &reference["answer"], tolerance, title, &mut faults);
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
    assert_eq!(references.len(), count, "{name} is cut off");
}

#[test]
fn the_comparison_notices() {
    let json = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    let want = json(r#"{"a": "1.5", "b": ["x", null], "c": {"d": "-2e-7"}, "e": 3}"#);
    let faults = |got: &str| {
        let mut faults = Vec::new();
        differences(&json(got), &want, 1e-9, "", &mut faults);
        faults.len()
    };
    assert_eq!(faults(r#"{"a": 1.500000000001, "b": ["x", null], "c": {"d": -2e-7, "more": 1}, "e": 3}"#), 0);
    assert_eq!(faults(r#"{"a": -1.5, "b": ["y", 0], "c": {"d": 2e-7}, "e": 4}"#), 5);
    assert_eq!(faults(r#"{"a": null, "b": ["x", null, 1], "c": {}}"#), 4);
}
