//! `compare`: columns are the answers of `solve` and `reconstruct`, and rows the inputs that differ.

use serde_json::{Value, json};

use crate::process::{Folder, Run, run, workspace};

const A: &str = "cli/examples/position-a.toml";
const B: &str = "cli/examples/position-b.toml";
const FOUND: &str = "cli/examples/reconstruct/position-a.toml";

fn parsed(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error}: {} {}", run.out, run.err))
}

fn document(arguments: &[&str]) -> Value {
    parsed(&run(&workspace(), &[arguments, &["--format", "json"]].concat()))
}

/// Returns the values of a row by its name.
fn values<'a>(found: &'a Value, table: &str, name: &str) -> &'a [Value] {
    let row = found[table].as_array().expect("rows").iter().find(|row| row["name"] == name);
    row.unwrap_or_else(|| panic!("{name}"))["values"].as_array().expect("values")
}

#[test]
fn each_column_is_the_answer_of_its_case() {
    let found = document(&["compare", A, B, FOUND]);
    let [a, b] = [A, B].map(|case| document(&["solve", case]));
    let other = document(&["reconstruct", FOUND]);
    let outputs = [
        ("energy.loss", "/energy/loss"),
        ("energy.normal_work", "/energy/normal_work"),
        ("energy.tangential_work", "/energy/tangential_work"),
        ("vehicle.1.delta_v_magnitude", "/vehicles/0/delta_v_magnitude"),
        ("vehicle.2.delta_v_magnitude", "/vehicles/1/delta_v_magnitude"),
        ("vehicle.1.pdof", "/vehicles/0/pdof"),
        ("vehicle.2.pdof", "/vehicles/1/pdof"),
        ("result.vehicle.1.yaw_rate", "/vehicles/0/yaw_rate"),
        ("result.vehicle.2.yaw_rate", "/vehicles/1/yaw_rate"),
        ("contact.impulse.normal", "/contact/impulse/normal"),
        ("contact.impulse.tangential", "/contact/impulse/tangential"),
        ("result.contact.impulse_ratio", "/contact/impulse_ratio"),
        ("contact.critical_impulse_ratio", "/contact/critical_impulse_ratio"),
    ];
    for (name, place) in outputs {
        let want = [&a, &b, &other["solution"]].map(|of| of.pointer(place).expect(place).clone());
        assert_eq!(values(&found, "outputs", name), want, "{name}");
    }
    for (name, unknown) in other["unknown"].as_object().expect("unknowns") {
        let row = found["outputs"].as_array().expect("rows").iter().find(|row| row["name"] == *name).expect("an unknown");
        assert_eq!(
            (&row["values"][2], &row["intervals"][2], &row["intervals"][0]),
            (&unknown["value"], &unknown["interval"], &Value::Null)
        );
        assert_eq!(values(&found, "inputs", name)[2], "unknown");
        assert!(row["values"][0].is_number(), "given in the first case");
    }
    let cases = found["cases"].as_array().expect("cases");
    for (case, of) in cases.iter().zip([&a, &b, &other]) {
        assert_eq!((&case["title"], &case["refusals"]), (&of["title"], &json!([])));
    }
    assert_eq!((&found["title"], &cases[2]["verdict"]), (&a["title"], &other["verdict"]));
    assert!(cases.iter().all(|case| case["is_answer"] == true));
    assert_eq!(cases.iter().map(|case| &case["verb"]).collect::<Vec<_>>(), ["solve", "solve", "reconstruct"]);
    assert_eq!(cases.iter().map(|case| &case["name"]).collect::<Vec<_>>(), [A, B, FOUND]);
}

#[test]
fn inputs_are_those_that_differ() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(workspace().join(B)).expect("the example");
    let variant = |name: &str, contact: &str| folder.write(name, text.replace("restitution = 0.15", contact).as_bytes());
    variant("a.toml", "restitution = 0.15");
    variant("b.toml", "restitution = 0.25\ntangential_law = \"kudlich-slibar\"\nimpulse_ratio = 0.1");
    let run_in = |arguments: &[&str]| run(folder.path(), arguments);
    let found = parsed(&run_in(&["compare", "a.toml", "b.toml", "--format", "json"]));
    let names: Vec<&Value> = found["inputs"].as_array().expect("inputs").iter().map(|input| &input["name"]).collect();
    assert_eq!(names, ["contact.restitution", "contact.impulse_ratio", "contact.tangential_law"]);
    assert_eq!(values(&found, "inputs", "contact.restitution"), [json!(0.15), json!(0.25)]);
    assert_eq!(values(&found, "inputs", "contact.impulse_ratio"), [json!("critical"), json!(0.1)]);
    assert_eq!(values(&found, "inputs", "contact.tangential_law"), [json!("brach"), json!("kudlich-slibar")]);
    let same = run_in(&["compare", "a.toml", "a.toml"]);
    assert!(same.status == 0 && same.out.contains("do not differ"), "{}", same.out);
}

/// A case that gives something of everything.
const EVERYTHING: &str = r#"
schema = 1
correlation = [["vehicle.1.mass", "vehicle.2.mass", 0.3]]
[[vehicle]]
mass = "1500 kg ± 50 kg"
yaw_inertia = 2500
heading = "180 deg"
speed = "40 km/h ± 10 km/h"
impact_center = [2, 0]
length = "4.5 m"
[vehicle.crush]
width = 1.5
depths = [0.2, 0.3]
stiffness = { d0 = 90, d1 = 700 }
surface = "front"
[[vehicle]]
mass = "1600 kg ± 50 kg"
yaw_inertia = 2600
heading = "90 deg"
velocity = [0, 9]
impact_center = [2, 0]
[contact]
crush_plane = "10 deg"
restitution = { closing_speed = ["5 m/s", "20 m/s"], restitution = [0.3, 0.1], sd = 0.05 }
[scene]
impact_point = ["1 m", "2 m"]
[rest]
friction = "0.7 ± 0.05"
[rest.vehicle.1]
position = ["-15 m ± 0.3 m", "5 m ± 0.3 m"]
heading = "-114 deg ± 3 deg"
front_axle = 1.1
rear_axle = 1.5
track = 1.5
wheels = { front_left = "locked", front_right = { braking = 0.3 }, rear_left = "rolling", rear_right = "rolling" }
"#;

/// Returns the names and the values of the inputs in which a case differs from itself with replacements.
fn differences(replacements: &[(&str, &str)]) -> Vec<(String, [Value; 2])> {
    let folder = Folder::new();
    let other = replacements.iter().fold(EVERYTHING.to_owned(), |text, (one, other)| {
        assert!(text.contains(one), "{one}");
        text.replace(one, other)
    });
    folder.write("a.toml", EVERYTHING.as_bytes());
    folder.write("b.toml", other.as_bytes());
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "b.toml", "--format", "json"]));
    let inputs = found["inputs"].as_array().expect("inputs").iter();
    inputs.map(|row| (row["name"].as_str().expect("a name").to_owned(), [row["values"][0].clone(), row["values"][1].clone()])).collect()
}

#[test]
fn whatever_differs_in_the_files_is_listed() {
    let number = |name: &str, one: f64, other: f64| (name.to_owned(), [json!(one), json!(other)]);
    for (one, other, want) in [
        ("friction = \"0.7 ± 0.05\"", "friction = \"0.6 ± 0.05\"", number("rest.friction", 0.7, 0.6)),
        ("friction = \"0.7 ± 0.05\"", "friction = { value = 0.7, sd = 0.1 }", number("rest.friction sd", 0.05, 0.1)),
        ("-15 m ± 0.3 m", "-1600 cm ± 0.3 m", number("rest.vehicle.1.position.1", -15.0, -16.0)),
        ("[\"1 m\", \"2 m\"]", "[\"1 m\", 3]", number("scene.impact_point.2", 2.0, 3.0)),
        ("braking = 0.3", "braking = 0.5", number("rest.vehicle.1.wheels.front_right.braking", 0.3, 0.5)),
        ("4.5 m", "4.7 m", number("vehicle.1.length", 4.5, 4.7)),
        ("sd = 0.05 }", "sd = 0.02 }", number("contact.restitution.sd", 0.05, 0.02)),
        (", 0.3]]", ", 0.4]]", number("correlation of vehicle.1.mass and vehicle.2.mass", 0.3, 0.4)),
        ("surface = \"front\"", "surface = \"left\"", ("vehicle.1.crush.surface".to_owned(), [json!("front"), json!("left")])),
        (
            "front_left = \"locked\"",
            "front_left = \"rolling\"",
            ("rest.vehicle.1.wheels.front_left".to_owned(), [json!("locked"), json!("rolling")]),
        ),
    ] {
        assert_eq!(differences(&[(one, other)]), [want], "{other}");
    }
}

#[test]
fn other_words_for_the_same_are_no_difference() {
    for (one, other) in [
        ("\"40 km/h ± 10 km/h\"", "{ value = \"40 km/h\", sd = \"10 km/h\" }"),
        ("\"0.7 ± 0.05\"", "{ value = \"70 %\", sd = 0.05 }"),
        ("\"4.5 m\"", "4.5"),
        ("[\"vehicle.1.mass\", \"vehicle.2.mass\", 0.3]", "[\"m2\", \"m1\", 0.3]"),
        // cos(90 deg) is 6e-17.
        ("velocity = [0, 9]", "speed = 9"),
    ] {
        let found = differences(&[(one, other)]);
        let is_form = |(name, values): &(String, [Value; 2])| name == "vehicle.2.speed" && values[0] == values[1];
        assert!(found.iter().all(is_form), "{other}: {found:?}");
    }
}

#[test]
fn distributions_of_one_mean_and_deviation_differ_in_shape() {
    let found = differences(&[("\"40 km/h ± 10 km/h\"", "{ min = \"22.679491924311227 km/h\", max = \"57.32050807568877 km/h\" }")]);
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["vehicle.1.speed distribution", "vehicle.1.speed min", "vehicle.1.speed max"]); // 10 √3 on each side
    assert_eq!(found[0].1, [json!("normal"), json!("uniform")]);
}

/// Of lists every number is one, with or without units.
#[test]
fn numbers_of_a_list_are_numbers() {
    let found = differences(&[("restitution = [0.3, 0.1], sd = 0.05", "restitution = [0.3, 0.2], sd = [0.05, 0.06]")]);
    for (name, values) in [
        ("contact.restitution.restitution.2", [json!(0.1), json!(0.2)]),
        ("contact.restitution.sd.1", [Value::Null, json!(0.05)]),
        ("contact.restitution.sd.2", [Value::Null, json!(0.06)]),
    ] {
        assert!(found.contains(&(name.to_owned(), values)), "{found:?}");
    }
}

/// By momentum alone vehicles are points, and what the files give of their inertia differs all the same.
#[test]
fn what_takes_no_part_in_momentum_differs_too() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/momentum.toml")).expect("the example");
    assert_eq!(text.matches("heading = \"0 deg\"").count(), 1);
    folder.write("a.toml", text.as_bytes());
    let with =
        text.replace("heading = \"0 deg\"", "heading = \"0 deg\"\nyaw_inertia = \"1500 kg m^2\"\nimpact_center = [\"2 m\", \"0.5 m\"]");
    folder.write("b.toml", with.as_bytes());
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "b.toml", "--format", "json"]));
    assert_eq!(values(&found, "inputs", "vehicle.1.yaw_inertia"), [Value::Null, json!(1500.0)]);
    assert_eq!(values(&found, "inputs", "vehicle.1.impact_center.2"), [Value::Null, json!(0.5)]);
    folder.write("c.toml", text.replace("heading = \"0 deg\"", "heading = \"0 deg\"\nradius_of_gyration = \"1.3 m\"").as_bytes());
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "c.toml", "--format", "json"]));
    assert_eq!(values(&found, "inputs", "vehicle.1.radius_of_gyration"), [Value::Null, json!(1.3)]);
}

#[test]
fn everything_wrong_with_several_cases_is_told() {
    let folder = Folder::new();
    folder.write("a.toml", EVERYTHING.as_bytes());
    folder.write("b.toml", EVERYTHING.replace("[\"1 m\", \"2 m\"]", "[\"1 kg\", \"2 m\"]").as_bytes());
    folder.write("c.toml", EVERYTHING.replace("\"4.5 m\"", "\"4.5 s\"").as_bytes());
    let refused = run(folder.path(), &["compare", "a.toml", "b.toml", "c.toml"]);
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    for wanted in ["scene.impact_point.1: ", "--> b.toml:", "vehicle.1.length: ", "--> c.toml:"] {
        assert_eq!(refused.err.matches(wanted).count(), 1, "{wanted}: {}", refused.err);
    }
}

#[test]
fn unknowns_differ_in_their_bounds() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(workspace().join(FOUND)).expect("the example");
    let unknown = "vehicle.1.speed = { start = \"30 mph\", min = \"0 mph\" }";
    assert!(text.contains(unknown), "{text}");
    folder.write("a.toml", text.as_bytes());
    folder.write("b.toml", text.replace(unknown, "v1 = { start = \"30 mph\", max = \"100 mph\", sd = \"40 mph\" }").as_bytes());
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "b.toml", "--format", "json"]));
    let names: Vec<&Value> = found["inputs"].as_array().expect("inputs").iter().map(|input| &input["name"]).collect();
    assert_eq!(names, ["unknown.vehicle.1.speed.max", "unknown.vehicle.1.speed.sd", "unknown.vehicle.1.speed.min"]);
    assert_eq!(values(&found, "inputs", "unknown.vehicle.1.speed.max"), [Value::Null, json!(44.704)]);
}

/// What stands where an unknown would be given is the start of its search.
#[test]
fn unknowns_differ_in_their_starts() {
    let folder = Folder::new();
    let text = run(folder.path(), &["new"]).out;
    folder.write("a.toml", text.as_bytes());
    folder.write("b.toml", text.replacen("speed = \"50 km/h\"", "speed = \"60 km/h\"", 1).as_bytes());
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "b.toml", "--format", "json"]));
    assert_eq!(found["inputs"].as_array().expect("inputs").len(), 1, "{}", found["inputs"]);
    let starts: Vec<f64> = values(&found, "inputs", "unknown.vehicle.1.speed.start").iter().filter_map(Value::as_f64).collect();
    assert_eq!(starts, [50.0 / 3.6, 60.0 / 3.6]);
}

#[test]
fn a_notice_names_its_cases() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(workspace().join(B)).expect("the example");
    folder.write("a.toml", text.as_bytes());
    folder.write("b.toml", text.replace("restitution = 0.15", "restitution = \"0.15 ± 0.05\"").as_bytes());
    let notes = |cases: &[&str]| parsed(&run(folder.path(), &[&["compare"], cases, &["--format", "json"]].concat()))["notes"].clone();
    let note = "contact.restitution is uncertain, and used at its nominal value";
    assert_eq!(notes(&["a.toml", "b.toml"]), json!([format!("[2] {note}")]));
    assert_eq!(notes(&["b.toml", "a.toml", "b.toml"]), json!([format!("[1, 3] {note}")]));
}

#[test]
fn evidence_that_does_not_narrow_an_unknown_is_a_reason() {
    let folder = Folder::new();
    let text = r#"
schema = 1
[[vehicle]]
mass = "1500 kg"
yaw_inertia = "2400 kg m^2"
heading = "0 deg"
impact_center = ["1.9 m", "0 m"]
[[vehicle]]
barrier = true
[contact]
crush_plane = "0 deg"
[evidence]
vehicle.1.speed = "10 m/s ± 1 m/s"
[unknown]
vehicle.1.speed = { start = "9 m/s", min = "0 m/s", max = "20 m/s" }
contact.restitution = { start = 0.1, min = 0.0999, max = 0.1001, sd = 0.1 }
"#;
    folder.write("a.toml", text.as_bytes());
    let found = run(folder.path(), &["compare", "a.toml", "a.toml"]);
    assert_eq!(found.status, 1, "{}", found.out);
    let chart = run(folder.path(), &["compare", "a.toml", "a.toml", "--format", "svg"]);
    assert!(!chart.out.contains("refused"), "it has values: {}", chart.out);
    assert!(
        found.out.contains("(reconstruct, agrees)") && found.out.contains("[2] no unique answer: contact.restitution: "),
        "{}",
        found.out
    );
}

#[test]
fn a_refused_case_is_a_column_with_its_reason() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(workspace().join(B)).expect("the example");
    folder.write("a.toml", text.as_bytes());
    folder.write("refused.toml", text.replace("restitution = 0.15", "restitution = 0.15\nimpulse_ratio = 3").as_bytes());
    folder.write("wrong.toml", text.replace("restitution = 0.15", "restitution = \"much\"").as_bytes());
    for format in ["text", "json", "svg"] {
        let run = run(folder.path(), &["compare", "a.toml", "refused.toml", "--format", format]);
        assert_eq!((run.status, run.err.as_str()), (1, ""), "{format}");
        assert!(run.out.contains("beyond-critical") || run.out.contains("beyond the critical"), "{format}: {}", run.out);
    }
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "refused.toml", "--format", "json"]));
    assert_eq!(values(&found, "outputs", "energy.loss")[1], Value::Null);
    assert!(values(&found, "outputs", "energy.loss")[0].is_number());
    let codes: Vec<&Value> = found["cases"][1]["refusals"].as_array().expect("refusals").iter().map(|refusal| &refusal["code"]).collect();
    assert_eq!(codes.len(), 2);
    assert!(["energy-gain", "beyond-critical"].iter().all(|code| codes.iter().any(|found| *found == code)), "{codes:?}");
    for call in [&["compare", "a.toml", "wrong.toml"][..], &["compare", "a.toml", "none.toml"], &["compare", "a.toml"]] {
        let run = run(folder.path(), call);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{call:?}");
    }
    let many = [&["compare"][..], &["a.toml"; 21]].concat();
    assert_eq!(run(folder.path(), &many).status, 2);
}

#[test]
fn units_are_those_of_the_first_case() {
    let of = |arguments: &[&str]| run(&workspace(), &[&["compare"], arguments].concat()).out;
    let (us, si) = (of(&[A, "cli/examples/sideswipe.toml"]), of(&["cli/examples/sideswipe.toml", A]));
    assert!(us.contains(" mph ") && !us.contains(" km/h ") && si.contains(" km/h ") && !si.contains(" mph "), "{us}{si}");
    assert_eq!(of(&[A, B, "--units", "si", "--format", "json"]), of(&[A, B, "--units", "us", "--format", "json"]));
    let chart = of(&[A, B, "--format", "svg", "--units", "si"]);
    assert!(chart.contains("energy.loss [J]") && chart.contains("role=\"img\"") && chart.trim_end().ends_with("</svg>"));
}

/// Momentum alone has no contact: no plane is given along which an impulse could be split.
#[test]
fn momentum_has_no_outputs_of_a_contact() {
    let case = "cli/examples/reconstruct/momentum.toml";
    let found = document(&["compare", case, case]);
    let names: Vec<&str> = found["outputs"].as_array().expect("rows").iter().filter_map(|row| row["name"].as_str()).collect();
    assert!(names.contains(&"vehicle.1.delta_v_magnitude") && names.contains(&"energy.loss"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("contact.impulse.n") || name.contains("impulse_ratio")), "{names:?}");
}
