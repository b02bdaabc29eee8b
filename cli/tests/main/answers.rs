//! JSON answers of every verb and example: the schema describes every value, and values are in SI regardless of the units requested.

use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use serde_json::Value;

use crate::process::{run, workspace};
use crate::schema::{branches, cases, errors, files_in, schema, validator};

/// The verbs that take a case and units, each with the options that extend its answer.
const OF_CASES: [(&str, &[&str]); 12] = [
    ("solve", &[]),
    ("gradient", &[]),
    ("gradient", &["--of", "T_L,dV1", "--wrt", "Gamma,e,m1", "--second"]),
    ("sweep", &["--vary", "e=0:1:0.25"]),
    ("sweep", &["--vary", "Gamma=-80 deg:80 deg:40 deg", "--vary", "e=0:0.2:0.1", "--of", "all"]),
    ("crush", &[]),
    ("crash3", &[]),
    ("reconstruct", &["--starts", "4", "--profile"]),
    ("uncertainty", &["--samples", "2e3", "--of", "dV1"]),
    ("uncertainty", &["--samples", "500", "--of", "T_L,dV1", "--probability", "dV1 > 18 mph", "--method", "linear,monte-carlo"]),
    ("formula", &["W_n", "--case"]),
    ("formula", &["dV1", "--wrt", "Gamma", "--case"]),
];

/// Returns the JSON answer of a call, if it has one. It is kept: both tests below need most of them, and some take seconds.
fn answer(call: &[&str]) -> Option<String> {
    static KNOWN: LazyLock<Mutex<HashMap<String, Option<String>>>> = LazyLock::new(Mutex::default);
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let key = call.join("\n");
    let found = known().get(&key).cloned();
    found.unwrap_or_else(|| {
        let answer = answer_of_program(call);
        known().insert(key, answer.clone());
        answer
    })
}

fn answer_of_program(call: &[&str]) -> Option<String> {
    let run = run(&workspace(), call);
    let has_answer = run.status < 2;
    assert_eq!((has_answer, run.out.is_empty()), (run.err.is_empty(), !has_answer), "{call:?}: {}", run.err);
    has_answer.then_some(run.out)
}

/// Returns every call in JSON of a verb with an example that has an answer; options come last, so that a file may follow `--case`.
fn calls_with_cases() -> Vec<(&'static str, Vec<String>)> {
    let mut calls = Vec::new();
    for (verb, options) in OF_CASES {
        let path = |path: std::path::PathBuf| path.to_str().expect("a plain path").to_owned();
        let call = |path: String| {
            let words = [verb, "--format", "json"].into_iter().chain(options.iter().copied()).map(str::to_owned);
            (verb, words.chain([path]).collect())
        };
        calls.extend(cases().into_iter().map(path).map(call));
    }
    calls
}

fn words(call: &[String]) -> Vec<&str> {
    call.iter().map(String::as_str).collect()
}

#[test]
fn the_schema_of_a_verb_describes_its_answers() {
    let mut calls = calls_with_cases();
    let plain = |verb, words: &str| (verb, format!("{words} --format json").split(' ').map(str::to_owned).collect());
    calls.extend([plain("rules", "check --rules"), plain("prove", "prove"), plain("validate", "validate")]);
    calls.extend(["mu0", "V1x", "pdof2", "T_L"].map(|name| plain("formula", &format!("formula {name}"))));
    for (verb, folder) in [("stiffness", "cli/examples/tests"), ("check", "cli/examples/check")] {
        calls.extend(files_in(folder).iter().map(|path| plain(verb, &format!("{verb} {}", path.display()))));
    }
    let mut answered = std::collections::BTreeMap::new();
    for (verb, call) in calls {
        let Some(text) = answer(&words(&call)) else { continue };
        *answered.entry(verb).or_insert(0) += 1;
        let answer: Value = serde_json::from_str(&text).expect("JSON");
        let schema = schema(verb);
        assert_eq!(errors(&validator(&schema), &answer), [""; 0], "{call:?}");
        let mut missing = Vec::new();
        undescribed(&[&schema], &schema, &answer, "", &mut missing);
        assert!(missing.is_empty(), "{call:?}: {missing:?}");
    }
    let least = [
        ("check", 5),
        ("crash3", 4),
        ("crush", 7),
        ("formula", 4),
        ("gradient", 18),
        ("prove", 1),
        ("reconstruct", 5),
        ("rules", 1),
        ("solve", 9),
        ("stiffness", 2),
        ("sweep", 10),
        ("uncertainty", 10),
        ("validate", 1),
    ];
    for (verb, least) in least {
        assert!(answered.get(verb) >= Some(&least), "{verb}: {answered:?}");
    }
}

#[test]
fn answers_are_in_si_whatever_the_units() {
    let mut calls = calls_with_cases();
    // Slides take seconds, and have no units: each verb answers one case with them.
    let mut with_slides = std::collections::BTreeSet::new();
    let has_slides =
        |call: &[String]| call.last().and_then(|path| std::fs::read_to_string(path).ok()).is_some_and(|text| text.contains("\n[rest]"));
    calls.retain(|(verb, call)| *verb != "formula" && (!has_slides(call) || with_slides.insert(*verb)));
    let stiffness = |path: &std::path::PathBuf| ["stiffness", "--format", "json", path.to_str().expect("a plain path")].map(str::to_owned);
    calls.extend(files_in("cli/examples/tests").iter().map(|path| ("stiffness", stiffness(path).to_vec())));
    // From the last, so that the test above, which runs beside this one, has computed the others.
    for (i, (_, call)) in calls.into_iter().enumerate().rev() {
        let plain = answer(&words(&call));
        let in_units = [words(&call), vec!["--units", ["us", "uk", "si"][i % 3]]].concat();
        assert!(answer(&in_units) == plain, "{in_units:?}");
    }
}

/// Collects the paths of a value that none of the schemas describes.
pub fn undescribed(schemas: &[&Value], root: &Value, value: &Value, path: &str, found: &mut Vec<String>) {
    let branches: Vec<&Value> = schemas.iter().flat_map(|schema| branches(schema, root)).collect();
    let parts: Vec<(String, &Value, Vec<&Value>)> = match value {
        Value::Object(entries) => entries.iter().map(|(key, inner)| (key.clone(), inner, of_key(&branches, key))).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(i, item)| (i.to_string(), item, of_place(&branches, i))).collect(),
        _ => Vec::new(),
    };
    for (key, part, schemas) in parts {
        let path = format!("{path}/{key}");
        if schemas.is_empty() {
            found.push(path);
        } else {
            undescribed(&schemas, root, part, &path, found);
        }
    }
}

fn of_key<'a>(branches: &[&'a Value], key: &str) -> Vec<&'a Value> {
    let named = |branch: &&'a Value| match branch.get("properties").and_then(|properties| properties.get(key)) {
        Some(property) => Some(property),
        None => branch.get("additionalProperties").filter(|schema| schema.is_object()),
    };
    branches.iter().filter_map(named).collect()
}

fn of_place<'a>(branches: &[&'a Value], place: usize) -> Vec<&'a Value> {
    let placed = |branch: &&'a Value| match branch.get("prefixItems").and_then(|items| items.get(place)) {
        Some(item) => Some(item),
        None => branch.get("items"),
    };
    branches.iter().filter_map(placed).collect()
}
