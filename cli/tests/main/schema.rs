//! JSON Schemas: the files under `schemas/`, and the validation of case files and answers against their schemas.

use std::fs;
use std::path::PathBuf;

use jsonschema::Validator;
use planar_impact::reconstruct::Measurand;
use planar_impact::{Input, Output};
use planar_impact_app::Units;
use planar_impact_app::schema::names;
use serde_json::{Value, json};

use crate::process::{examples, run, workspace};

/// Returns a schema that the program prints.
pub fn schema(name: &str) -> Value {
    planar_impact_app::schema::of(name).unwrap_or_else(|| panic!("no schema {name}")).to_value()
}

/// Creates a validator of a schema, which must be valid itself.
pub fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::meta::validate(schema).expect("a JSON Schema");
    jsonschema::draft202012::new(schema).expect("a JSON Schema")
}

/// Returns the errors that a schema finds.
pub fn errors(validator: &Validator, value: &Value) -> Vec<String> {
    validator.iter_errors(value).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

pub fn files_in(folder: &str) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(workspace().join(folder)).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

/// Returns the case files shipped with the program, including those with evidence.
pub fn cases() -> Vec<PathBuf> {
    let mut paths = examples();
    paths.extend(files_in("cli/examples/reconstruct"));
    paths.extend(files_in("cli/examples/uncertainty"));
    paths
}

#[test]
fn the_files_are_up_to_date() {
    let expected: Vec<PathBuf> = names().into_iter().map(|name| workspace().join(format!("schemas/{name}.schema.json"))).collect();
    for (name, path) in names().into_iter().zip(&expected) {
        let printed = run(&workspace(), &["schema", name]).out;
        let kept = fs::read_to_string(path).unwrap_or_default();
        assert!(printed == kept, "stale: run `planar-impact schema {name} > schemas/{name}.schema.json`");
    }
    let mut expected = expected;
    expected.sort();
    assert_eq!(files_in("schemas"), expected);
}

#[test]
fn the_examples_name_their_schema_and_validate() {
    let tests = files_in("cli/examples/tests");
    let recordings = files_in("cli/examples/record").into_iter().filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    for (name, paths) in [("case", cases()), ("tests", tests), ("recording", recordings)] {
        let validator = validator(&schema(name));
        for path in paths {
            let text = fs::read_to_string(&path).expect("the example can be read");
            let directive = text.lines().next().and_then(|line| line.strip_prefix("#:schema ")).expect("the first line names the schema");
            let named = path.parent().expect("a folder").join(directive);
            let kept = workspace().join(format!("schemas/{name}.schema.json"));
            assert_eq!(named.canonicalize().expect("the schema is there"), kept.canonicalize().expect("a file"), "{path:?}");
            let value = toml::from_str(&text).expect("the example is TOML");
            assert_eq!(errors(&validator, &value), [""; 0], "{path:?}");
        }
    }
}

/// Returns a case that solves, as JSON.
fn sound() -> Value {
    let read = |name: &str| fs::read_to_string(workspace().join("cli/examples").join(name)).expect("the example can be read");
    let mut case: Value = toml::from_str(&read("to-rest.toml")).expect("TOML");
    let other: Value = toml::from_str(&read("reconstruct/two-cars.toml")).expect("TOML");
    case["evidence"] = other["evidence"].clone();
    case["$schema"] = "../../schemas/case.schema.json".into();
    case
}

#[test]
fn wrong_cases_do_not_validate() {
    let validator = validator(&schema("case"));
    let sound = sound();
    assert_eq!(errors(&validator, &sound), [""; 0]);
    // A JSON pointer and its new value; null removes the key.
    let wrong: [(&str, Value); 47] = [
        ("/schema", json!(2)),
        ("/schema", json!(null)),
        ("/$schema", json!(1)),
        ("/title", json!(1)),
        ("/colour", json!("red")),
        ("/contact", json!(null)),
        ("/vehicle", json!(null)),
        ("/vehicle/2", json!({"name": "third", "barrier": true})),
        ("/vehicle/0/mas", json!("1500 kg")),
        ("/vehicle/0/mass", json!("1500")),
        ("/vehicle/0/mass", json!(-1500)),
        ("/vehicle/0/mass", json!(true)),
        ("/vehicle/0/mass", json!({"value": "1500 kg", "min": "1400 kg"})),
        ("/vehicle/0/mass", json!({"median": "1500 kg"})),
        ("/vehicle/0/mass", json!({"value": "1500 kg", "std": "1400 kg"})),
        ("/correlation", json!([["m1", "m2"]])),
        ("/correlation", json!([["m1", "m2", 1]])),
        ("/correlation", json!([["m1", 2, 0.5]])),
        ("/vehicle/0/heading", json!(90)),
        ("/vehicle/0/radius_of_gyration", json!("1.3 m")),
        ("/vehicle/0/velocity", json!(["1 m/s", "2 m/s"])),
        ("/vehicle/0/impact_center", json!(["1 m"])),
        ("/vehicle/0/barrier", json!(true)),
        ("/vehicle/0/barrier", json!("yes")),
        ("/vehicle/0/crush/width", json!(null)),
        ("/vehicle/0/crush/stations", json!(["0 m", "0.5 m", "1 m", "1.5 m"])),
        ("/vehicle/0/crush/depths", json!(["0.1 m"])),
        ("/vehicle/0/crush/stiffness/B", json!(null)),
        ("/vehicle/0/crush/stiffness/d0", json!("1 N^0.5")),
        ("/vehicle/0/crush/stiffness/to", json!("1 m")),
        ("/vehicle/0/crush/stiffness", json!([])),
        ("/vehicle/0/crush/measured", json!({})),
        ("/vehicle/0/crush/surface", json!("top")),
        ("/contact/restitution", json!(1.5)),
        ("/contact/surfaces", json!(["0 deg", "90 deg"])),
        ("/contact/impulse_ratio", json!("0.5")),
        ("/contact/impulse_ratio", json!({"of": 1})),
        ("/contact/tangential_law", json!("Brach")),
        ("/evidence/vehicle/2/colour", json!("1 m")),
        ("/evidence/vehicle/3", json!({"speed": "1 m/s"})),
        ("/evidence/crush_energy/sd", json!("1 kJ")),
        ("/evidence/vehicle/1", json!({"speed": {"value": "1 m/s", "relative": 0.1, "sd": "1 m/s"}})),
        ("/evidence/vehicle/1", json!({"separation_velocity": ["1 m/s"]})),
        ("/unknown", json!({"vehicle": {"1": {"speed": {"begin": "1 m/s"}}}})),
        ("/unknown", json!({"vehicle": {"1": {"delta_v_magnitude": {}}}})),
        ("/rest/vehicle/1/heading", json!("135 deg")),
        ("/rest/vehicle/1/wheels/front_left", json!("blocked")),
    ];
    for (pointer, value) in wrong {
        let mut case = sound.clone();
        change(&mut case, pointer, value.clone());
        assert!(!validator.is_valid(&case), "{pointer} = {value}");
    }
    for (pointer, value) in [("/gravity", json!("32.2 ft/s^2")), ("/vehicle/0/impact_center", json!(["6' 4.2\"", "0 m"]))] {
        let mut case = sound.clone();
        change(&mut case, pointer, value.clone());
        assert!(validator.is_valid(&case), "{pointer} = {value}: {:?}", errors(&validator, &case));
    }
    let mut weighed = sound.clone();
    change(&mut weighed, "/vehicle/0/weight", json!({"value": "2564 lbf", "sd": "10 lbf"}));
    assert!(!validator.is_valid(&weighed), "mass and weight");
    change(&mut weighed, "/vehicle/0/mass", json!(null));
    assert_eq!(errors(&validator, &weighed), [""; 0]);
    // Without evidence, nothing replaces a missing key.
    for pointer in ["mass", "yaw_inertia", "heading", "speed", "impact_center"].map(|key| format!("/vehicle/1/{key}")) {
        let mut case = sound.clone();
        change(&mut case, &pointer, json!(null));
        assert!(validator.is_valid(&case), "{pointer}");
        change(&mut case, "/evidence", json!(null));
        assert!(!validator.is_valid(&case), "{pointer}");
    }
}

/// Sets, adds or removes the value at a pointer.
fn change(case: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match case.pointer_mut(parent).expect("it has a parent") {
        Value::Object(entries) if value.is_null() => drop(entries.remove(key)),
        Value::Object(entries) => drop(entries.insert(key.to_owned(), value)),
        Value::Array(items) => items.push(value),
        other => panic!("{pointer} leads into {other}"),
    }
}

#[test]
fn every_name_of_evidence_and_of_an_unknown_is_known_to_the_schema() {
    let validator = validator(&schema("case"));
    let mut case = sound();
    change(&mut case, "/evidence", json!(null));
    let holds = |table: &str, name: &str, value: Value, expected: bool| {
        let mut case = case.clone();
        case[table] = name.rsplit('.').fold(value, |inner, key| json!({ key: inner }));
        assert_eq!(validator.is_valid(&case), expected, "{table}.{name}: {:?}", errors(&validator, &case));
    };
    for of in Measurand::all() {
        let unit = Units::Us.unit(of.measure());
        for value in
            [json!(0.5), json!(format!("1 ± 0.1 {unit}")), json!({"value": format!("1 {unit}"), "resolution": format!("1 {unit}")})]
        {
            holds("evidence", of.name(), value, true);
        }
        holds("evidence", &format!("{}s", of.name()), json!(0.5), false);
    }
    let qualified = Output::ALL.into_iter().flat_map(|output| [output.qualified_name(), output.symbol()]);
    qualified.chain(Input::ALL.into_iter().map(Input::symbol)).for_each(|name| holds("evidence", name, json!(0.5), true));
    let variables = Input::ALL.into_iter().flat_map(|input| [input.name(), input.symbol()]);
    let others = ["vehicle.1.speed", "v2", "contact.crush_share", "contact.friction", "contact.impulse_ratio.of_critical"];
    for name in variables.chain(others).chain(["contact.moment.of_critical"]) {
        for value in [json!(0.5), json!({}), json!({"start": 0.5, "min": 0, "max": 1, "sd": 0.1})] {
            holds("unknown", name, value, true);
        }
        holds("unknown", name, json!([0.5]), false);
    }
}

#[test]
fn every_key_is_described() {
    for name in names() {
        let root = schema(name);
        let mut bare = Vec::new();
        bare_keys(&root, &root, "", &mut bare);
        assert!(bare.is_empty(), "{name}: {bare:?}");
        assert!(root.get("title").is_some() && root.get("description").is_some(), "{name}");
    }
}

/// Collects the properties that have no description, neither directly nor through a reference.
fn bare_keys(schema: &Value, root: &Value, path: &str, found: &mut Vec<String>) {
    // An alternative is described by its key.
    let is_alternative = schema.get("description").is_some() && path.ends_with("/oneOf/");
    for (key, property) in schema.get("properties").filter(|_| !is_alternative).and_then(Value::as_object).into_iter().flatten() {
        let is_described = property.get("const").is_some() || *property == json!(false);
        // A condition mentions a property again.
        let is_condition = path.contains("/if/") || path.starts_with("/then");
        if !is_described && !is_condition && branches(property, root).iter().all(|branch| branch.get("description").is_none()) {
            found.push(format!("{path}/{key}"));
        }
    }
    let inner: Vec<(String, &Value)> = match schema {
        Value::Object(entries) => entries.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(items) => items.iter().map(|item| (String::new(), item)).collect(),
        _ => Vec::new(),
    };
    inner.into_iter().for_each(|(key, value)| bare_keys(value, root, &format!("{path}/{key}"), found));
}

/// Returns a schema with everything it refers to and its alternatives.
pub fn branches<'a>(schema: &'a Value, root: &'a Value) -> Vec<&'a Value> {
    let mut all = vec![schema];
    if let Some(reference) = schema.get("$ref").and_then(Value::as_str) {
        let target = root.pointer(reference.trim_start_matches('#')).unwrap_or_else(|| panic!("{reference} leads nowhere"));
        all.extend(branches(target, root));
    }
    for key in ["anyOf", "oneOf", "allOf"] {
        schema.get(key).and_then(Value::as_array).into_iter().flatten().for_each(|one| all.extend(branches(one, root)));
    }
    all
}
