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
        assert!(run.out.contains("energy-gain") || run.out.contains("beyond the critical"), "{format}: {}", run.out);
    }
    let found = parsed(&run(folder.path(), &["compare", "a.toml", "refused.toml", "--format", "json"]));
    assert_eq!(values(&found, "outputs", "energy.loss")[1], Value::Null);
    assert!(values(&found, "outputs", "energy.loss")[0].is_number());
    let codes: Vec<&Value> = found["cases"][1]["refusals"].as_array().expect("refusals").iter().map(|refusal| &refusal["code"]).collect();
    assert_eq!(codes, ["energy-gain", "beyond-critical"]);
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
