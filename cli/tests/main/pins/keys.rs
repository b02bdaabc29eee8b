//! Every key of every document has a line in `../../reference/keys.csv` that names the test that checks it.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use serde_json::{Value, json};

use super::units::unit;
use super::{array, case, close, damage, document, number, object, paper, references, scene, solve_page, verdicts};
use crate::process::{run, workspace};

const CASES: [&str; 9] = [
    "cavalier-crush",
    "crabbed-barrier",
    "oblique-surfaces",
    "position-a",
    "position-b",
    "position-c",
    "sideswipe",
    "stiff-corner",
    "to-rest",
];
const RECONSTRUCTIONS: [&str; 7] = ["crabbed-1", "crabbed-2", "crabbed-3", "momentum", "position-a", "two-cars", "uncertain-masses"];
const RECORDS: [&str; 5] = ["collision.json", "engine.jsonl", "paper-table-2.csv", "paper-table-b1.csv", "template.csv"];

fn has_crush(case: &Value) -> bool {
    array(&case["vehicle"]).iter().all(|vehicle| vehicle.get("crush").is_some() || vehicle["barrier"] == true)
        && case.to_string().contains("crush\"")
}

/// Every document, by verb, of every example and of the cases of these tests that have additional keys.
pub(super) static DOCUMENTS: LazyLock<Vec<(&'static str, Value)>> = LazyLock::new(|| {
    let mut all = Vec::new();
    let examples = CASES.map(|name| case(&format!("{name}.toml"))).into_iter();
    for case in examples.chain(solve_page::cases().into_iter().skip(CASES.len())).chain([damage::by_hand()]) {
        all.push(("solve", document("solve", &case, &[])));
        all.push(("gradient", document("gradient", &case, &["--second", "--of", "T_L,dV1", "--wrt", "e,m1"])));
        all.push(("sweep", document("sweep", &case, &["--vary", "e=0:0.2:0.1"])));
        if has_crush(&case) {
            all.push(("crush", document("crush", &case, &[])));
            all.push(("crash3", document("crash3", &case, &[])));
        }
    }
    let reconstructions = RECONSTRUCTIONS.map(|name| case(&format!("reconstruct/{name}.toml"))).into_iter();
    let more = references("reconstruct.jsonl").into_iter().map(|reference| reference["case"].clone());
    all.extend(
        reconstructions.chain(more).chain([verdicts::out_of_bounds()]).map(|case| ("reconstruct", document("reconstruct", &case, &[]))),
    );
    all.push(("slide", document("slide", &case("slide.toml"), &[])));
    all.push(("draw", document("draw", &scene::by_hand(), &[])));
    let uncertain = references("uncertainty.jsonl").into_iter().map(|reference| reference["case"].clone()).chain([case("uncertain.toml")]);
    let options = ["--of", "dV1", "--samples", "1000", "--probability", "dV1 > 5 m/s"];
    all.extend(uncertain.map(|case| ("uncertainty", document("uncertainty", &case, &options))));
    all.extend(["malibu", "struble-welsh"].map(|name| ("stiffness", document("stiffness", &case(&format!("tests/{name}.toml")), &[]))));
    let printed = |arguments: &[&str]| serde_json::from_str::<Value>(&run(&workspace(), arguments).out).expect("JSON");
    all.extend(
        ["new_cars_as_one", "negative_A"]
            .map(|name| ("stiffness", printed(&["stiffness", &format!("cli/tests/reproducers/{name}.toml"), "--format", "json"]))),
    );
    all.extend(
        ["barrier.toml", "edr.csv"]
            .map(|name| ("record", printed(&["record", &format!("cli/examples/record/{name}"), "--format", "json"]))),
    );
    let compared = ["cli/examples/position-a.toml", "cli/examples/crabbed-barrier.toml", "cli/examples/reconstruct/position-a.toml"];
    all.push(("compare", printed(&[&["compare"], &compared[..], &["--format", "json"]].concat())));
    for (verb, format) in [("check", "json"), ("sarif", "sarif")] {
        all.extend(RECORDS.map(|name| (verb, printed(&["check", &format!("cli/examples/check/{name}"), "--format", format]))));
    }
    all.extend(["validate", "prove"].map(|verb| (verb, paper::printed_by(verb))));
    all
});

/// Collects the path of every value, with a star in place of names.
fn walk(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    let is_name = |key: &str| {
        key.contains(['.', ' '])
            || path == "refused.reasons"
            || key == "crush_energy" && (path.starts_with("evidence") || path.starts_with("influence"))
    };
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, inner)| {
            let key = if is_name(key) { "*" } else { key };
            walk(inner, &if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }, found);
        }),
        Value::Array(items) => {
            found.insert(format!("{path}[]"));
            items.iter().for_each(|inner| walk(inner, &format!("{path}[]"), found));
        }
        _ => drop(found.insert(path.to_owned())),
    }
}

/// Reads the source of every test of this program.
fn sources(folder: &Path, all: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, all);
        } else {
            let module = path.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/main")).expect("within").with_extension("");
            let parts: Vec<&str> = module.iter().filter_map(|part| part.to_str()).filter(|part| *part != "mod").collect();
            all.push((parts.join("::"), std::fs::read_to_string(&path).expect("a source")));
        }
    }
}

#[test]
fn every_key_has_a_reference_and_every_reference_a_key() {
    let mut emitted = BTreeSet::new();
    for (verb, document) in DOCUMENTS.iter() {
        let mut found = BTreeSet::new();
        walk(document, "", &mut found);
        emitted.extend(found.into_iter().map(|path| format!("{verb},{path}")));
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/keys.csv");
    let mut sources_of_tests = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/main"), &mut sources_of_tests);
    let (mut listed, mut faults) = (BTreeSet::new(), Vec::new());
    for line in csv::Reader::from_path(path).expect("the table of keys").records().map(|line| line.expect("a line")) {
        let (module, test) = line[2].rsplit_once("::").expect("a test in a module");
        if !sources_of_tests.iter().any(|(known, source)| known == module && source.contains(&format!("#[test]\nfn {test}()"))) {
            faults.push(format!("{} is no test", &line[2]));
        }
        assert!(!line[3].is_empty(), "{line:?}");
        listed.insert(format!("{},{}", &line[0], &line[1]));
    }
    faults.extend(emitted.difference(&listed).map(|key| format!("{key} has no reference")));
    faults.extend(listed.difference(&emitted).map(|key| format!("{key} is emitted by nothing")));
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn schemas_titles_and_notes() {
    for name in CASES {
        let case = case(&format!("{name}.toml"));
        let verbs = if has_crush(&case) { &["solve", "gradient", "crush", "crash3"][..] } else { &["solve", "gradient"] };
        let names: Vec<&Value> = array(&case["vehicle"]).iter().map(|vehicle| &vehicle["name"]).collect();
        let of_file = |found: &Value| found.get("notes").map_or(Vec::new(), |notes| array(notes).to_vec());
        let notes = of_file(&document("solve", &case, &[]));
        for verb in verbs {
            let found = document(verb, &case, &[]);
            assert_eq!((&found["schema"], &found["title"]), (&json!(1), &case["title"]), "{verb} {name}");
            if let Some(vehicles) = found["vehicles"].as_array() {
                assert_eq!(vehicles.iter().map(|vehicle| &vehicle["name"]).collect::<Vec<_>>(), names, "{verb} {name}");
            }
            assert!(notes.iter().all(|note| of_file(&found).contains(note)), "{verb} {name}");
        }
    }
    // Every verb reports a number without a unit.
    let mut bare = case("stiff-corner.toml");
    bare["vehicle"][0]["mass"] = json!(1180);
    for verb in ["solve", "gradient", "crush", "crash3"] {
        let notes = document(verb, &bare, &[])["notes"].to_string();
        assert!(notes.contains("mass") && notes.contains("1180"), "{verb}: {notes}");
    }
    // And that it takes uncertain inputs at their nominal values.
    let uncertain = case("uncertain.toml");
    for (verb, arguments) in [("solve", &[][..]), ("sweep", &["--vary", "e=0:0.2:0.1"])] {
        let found = document(verb, &uncertain, arguments);
        let [message] = array(&found["messages"]) else { panic!("{verb}: one message") };
        assert_eq!((&message["code"], &message["severity"], &message["path"]), (&json!("nominal-values"), &json!("note"), &json!("")));
        assert_eq!((array(&message["figures"]).len(), &found["notes"]), (0, &json!([message["text"]])), "{verb}");
        assert!(["vehicle.1.mass", "contact.crush_plane"].iter().all(|name| message["text"].to_string().contains(name)), "{message}");
    }
    for (verb, found) in DOCUMENTS.iter().filter(|(verb, _)| !["sarif"].contains(verb)) {
        assert_eq!(found["schema"], 1, "{verb}");
    }
}

#[test]
fn inputs_are_those_of_the_file() {
    let si = |text: &Value| match text.as_str().map(|text| text.split_once(' ').expect("a unit")) {
        Some((value, name)) => value.parse::<f64>().expect("a number") * unit(name),
        None => number(text),
    };
    for name in CASES {
        let case = case(&format!("{name}.toml"));
        let inputs = document("gradient", &case, &["--of", "T_L"])["wrt"].clone();
        let hold = |name: &str, want: f64| close(number(&inputs[name]), want, 1e-14 * want.abs(), name);
        for (i, vehicle) in array(&case["vehicle"]).iter().enumerate().filter(|(_, vehicle)| vehicle["barrier"] != true) {
            for key in ["mass", "yaw_inertia", "radius_of_gyration", "heading", "speed", "yaw_rate"] {
                if let Some(value) = vehicle.get(key) {
                    hold(&format!("vehicle.{}.{key}", i + 1), si(value));
                }
            }
            for (at, key) in ["forward", "left"].into_iter().enumerate() {
                hold(&format!("vehicle.{}.impact_center.{key}", i + 1), si(&vehicle["impact_center"][at]));
            }
            for (at, key) in ["x", "y"].into_iter().enumerate() {
                if let Some(velocity) = vehicle.get("velocity") {
                    hold(&format!("vehicle.{}.velocity.{key}", i + 1), si(&velocity[at]));
                }
            }
            if let Some(depths) = vehicle.pointer("/crush/depths") {
                array(depths)
                    .iter()
                    .enumerate()
                    .for_each(|(at, depth)| hold(&format!("vehicle.{}.crush.depths.{}", i + 1, at + 1), si(depth)));
            }
        }
        for key in ["crush_plane", "restitution", "friction"] {
            if let Some(value) = case["contact"].get(key) {
                hold(&format!("contact.{key}"), si(value));
            }
        }
    }
}

#[test]
fn words_are_words() {
    let is_said = |value: &Value| value.as_str().is_some_and(|words| words.len() > 3);
    let rules: Value = serde_json::from_str(&run(&workspace(), &["check", "--rules", "--format", "json"]).out).expect("JSON");
    let names: Vec<&Value> = array(&rules["rules"]).iter().map(|rule| &rule["name"]).collect();
    for (verb, found) in DOCUMENTS.iter() {
        match *verb {
            "crash3" => {
                let said =
                    ["common_velocity", "point_mass", "tangential_factor"].map(|name| found["planar"][name]["assumption"].to_string());
                assert!(said.iter().all(|words| words.len() > 30) && said[0] != said[1] && said[1] != said[2], "{said:?}");
                assert!(said[0].contains("common velocity") && said[1].contains("point mass") && said[2].contains("tan"), "{said:?}");
            }
            "reconstruct" => {
                let asked: BTreeSet<&str> = array(&found["diagnostics"]).iter().filter_map(|question| question["name"].as_str()).collect();
                let wanted = if found["solution"]["contact"]["model"] == "momentum" { 0 } else { 8 };
                assert_eq!(asked.len(), wanted, "eight questions of a contact, of which one may be of each vehicle");
                assert!(array(&found["diagnostics"]).iter().all(|question| is_said(&question["source"]) && is_said(&question["meaning"])));
            }
            "check" => {
                for record in array(&found["records"]) {
                    assert!(array(&record["not_checked"]).iter().all(|rule| names.contains(&rule)), "{record}");
                    for finding in array(&record["findings"]) {
                        let words = finding["what"].as_str().expect("words").split([' ', ',', ':']);
                        let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
                        for key in ["size", "bound"] {
                            let want = number(&finding[key]);
                            assert!(numbers.iter().any(|told| (told - want).abs() <= 1e-5 * want), "{key} of {finding}");
                        }
                    }
                }
            }
            "sarif" => {
                assert_eq!(found["$schema"], "https://json.schemastore.org/sarif-2.1.0.json");
                assert_eq!(found["runs"][0]["tool"]["driver"]["name"], "planar-impact check");
            }
            _ => assert!(!object(found).is_empty()),
        }
    }
}
