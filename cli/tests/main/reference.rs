//! The numbers of an independent solver; `../reference/README.md` describes how they were computed.

use std::collections::{BTreeMap, HashMap};
use std::f64::consts::TAU;
use std::path::Path;

use serde_json::Value;

use crate::process::run_with_input;

/// Tolerance of a number, relative to the largest of its kind.
const TOLERANCE: f64 = 1e-12;

/// The kind of quantity: numbers of one kind have rounding errors of the same size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Text,
    Velocity,
    YawRate,
    Angle,
    Impulse,
    Energy,
    Ratio,
    /// A quantity of the crush, with a tolerance relative to itself.
    Crush,
}

impl Kind {
    /// Returns the kind of the value at a path of the answer.
    fn of(path: &str) -> Kind {
        let last = path.rsplit('/').next().unwrap_or_default();
        match last {
            "title" | "name" => Kind::Text,
            "pdof" => Kind::Angle,
            "yaw_rate" => Kind::YawRate,
            "crush_energy" | "equivalent_energy_speed" | "mean_depth" => Kind::Crush,
            "schema" | "restitution" | "impulse_ratio" | "critical_impulse_ratio" => Kind::Ratio,
            _ if path.starts_with("/energy/") => Kind::Energy,
            _ if path.contains("/impulse/") => Kind::Impulse,
            _ => Kind::Velocity,
        }
    }

    /// Returns the difference of `got` from `want`, relative to the scale of the kind.
    fn difference(self, got: f64, want: f64, largest: f64) -> f64 {
        let difference = (got - want).abs();
        match self {
            Kind::Angle => difference.min((difference - TAU).abs()) / want.abs().max(1.0),
            Kind::Ratio => difference / want.abs().max(1.0),
            _ if difference == 0.0 => 0.0,
            Kind::Crush => difference / want.abs(),
            _ => difference / largest,
        }
    }
}

/// Collects every value by its path.
fn leaves<'a>(value: &'a Value, path: String, found: &mut BTreeMap<String, &'a Value>) {
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, inner)| leaves(inner, format!("{path}/{key}"), found)),
        Value::Array(items) => items.iter().enumerate().for_each(|(i, inner)| leaves(inner, format!("{path}/{i}"), found)),
        _ => drop(found.insert(path, value)),
    }
}

fn all_leaves(value: &Value) -> BTreeMap<String, &Value> {
    let mut found = BTreeMap::new();
    leaves(value, String::new(), &mut found);
    found
}

/// Parses a number of the answer: a decimal text of 25 digits.
fn number(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64(), |digits| digits.parse().ok()).expect("a number")
}

/// Returns the differences in a solution, by path.
fn compare(got: &Value, want: &Value) -> Vec<String> {
    let (got, want) = (all_leaves(got), all_leaves(want));
    let mut largest: HashMap<Kind, f64> = HashMap::new();
    for (path, value) in want.iter().filter(|(path, _)| Kind::of(path) != Kind::Text) {
        let most = largest.entry(Kind::of(path)).or_default();
        *most = most.max(number(value).abs());
    }
    // Keys not in the reference have their own references: see keys.csv.
    let mut faults: Vec<String> = Vec::new();
    for (path, want) in want {
        let kind = Kind::of(&path);
        let Some(got) = got.get(&path) else {
            faults.push(format!("{path} is missing"));
            continue;
        };
        if kind == Kind::Text {
            if *got != want {
                faults.push(format!("{path} is {got}, not {want}"));
            }
            continue;
        }
        let off = got.as_f64().map_or(f64::INFINITY, |got| kind.difference(got, number(want), largest[&kind]));
        if off.is_nan() || off > TOLERANCE {
            faults.push(format!("{path} is {got}, not {want}: off by {off:.1e}"));
        }
    }
    faults
}

#[test]
fn every_case_of_the_independent_solver() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/cases.jsonl");
    let text = std::fs::read_to_string(path).expect("the cases can be read");
    let (mut solved, mut refused, mut faults) = (0, 0, String::new());
    for (i, line) in text.lines().enumerate() {
        let reference: Value = serde_json::from_str(line).expect("each line is JSON");
        let run = run_with_input(&["solve", "-", "--format", "json"], &reference["case"].to_string());
        let fault = if reference["status"] != run.status {
            format!("status {}, not {}: {}", run.status, reference["status"], run.err)
        } else if run.status == 0 {
            solved += 1;
            let got = serde_json::from_str(&run.out).expect("JSON");
            compare(&got, &reference["answer"]).join("\n  ")
        } else {
            refused += 1;
            if run.out.is_empty() && run.err.starts_with("error: ") { String::new() } else { "refused without a word".to_owned() }
        };
        if !fault.is_empty() {
            faults.push_str(&format!("line {}: {fault}\n", i + 1));
        }
    }
    assert!(faults.is_empty(), "{faults}");
    assert!(solved >= 180 && refused >= 24, "{solved} solved and {refused} refused: the file is cut off");
    assert_eq!(text.matches("\"crush_energy\"").count(), 36, "vehicles with crush");
}

#[test]
fn the_comparison_notices() {
    let json = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    let want = json(r#"{"title": "a", "vehicles": [{"yaw_rate": "2", "pdof": "3.141592653589793", "velocity": ["100", "1e-9"]}]}"#);
    let near = json(r#"{"title": "a", "vehicles": [{"yaw_rate": 2.000000000001, "pdof": -3.141592653589793, "velocity": [100.0, 0.0]}]}"#);
    assert_eq!(compare(&near, &want).len(), 1, "1e-9 of 100 is more than rounding; a whole turn is none");
    for (off, faults) in [
        (r#"{"title": "b", "vehicles": [{"yaw_rate": 2, "pdof": 3.141592653589793, "velocity": [100, 1e-9]}]}"#, 1),
        (r#"{"title": "a", "vehicles": [{"yaw_rate": 2.00000000001, "pdof": 3.14159265359, "velocity": [100, 1e-9]}]}"#, 1),
        (r#"{"title": "a", "vehicles": [{"yaw_rate": null, "velocity": [100, 1e-9]}]}"#, 2),
        (r#"{"title": "a", "more": 1, "vehicles": [{"yaw_rate": 2, "pdof": 3.14, "velocity": [1e-9, 100]}]}"#, 3),
    ] {
        assert_eq!(compare(&json(off), &want).len(), faults, "{off}");
    }
}
