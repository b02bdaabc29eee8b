//! `formula`: parses what is printed in each notation, evaluates it with every digit of the inputs, and compares it
//! with an independent solver.

mod notation;

use std::collections::HashMap;
use std::process::Command;

use serde_json::Value;

use self::notation::Formula;
use super::{array, document, number, object, references};
use crate::process::{Folder, run, workspace};

/// The inputs: their names, and their symbols in text, LaTeX and Rust. The impulse ratio and the moment impulse have
/// the names by which a case may give them.
const INPUTS: [(&[&str], [&str; 3]); 20] = [
    (&["vehicle.1.mass"], ["m1", "m_1", "m1"]),
    (&["vehicle.1.yaw_inertia"], ["I1", "I_1", "I1"]),
    (&["vehicle.1.heading"], ["θ1", "\\theta_1", "theta1"]),
    (&["vehicle.1.impact_center.forward"], ["f1", "f_1", "f1"]),
    (&["vehicle.1.impact_center.left"], ["l1", "l_1", "l1"]),
    (&["vehicle.1.velocity.x"], ["v1x", "v_{1x}", "v1x"]),
    (&["vehicle.1.velocity.y"], ["v1y", "v_{1y}", "v1y"]),
    (&["vehicle.1.yaw_rate"], ["ω1", "\\omega_1", "omega1"]),
    (&["vehicle.2.mass"], ["m2", "m_2", "m2"]),
    (&["vehicle.2.yaw_inertia"], ["I2", "I_2", "I2"]),
    (&["vehicle.2.heading"], ["θ2", "\\theta_2", "theta2"]),
    (&["vehicle.2.impact_center.forward"], ["f2", "f_2", "f2"]),
    (&["vehicle.2.impact_center.left"], ["l2", "l_2", "l2"]),
    (&["vehicle.2.velocity.x"], ["v2x", "v_{2x}", "v2x"]),
    (&["vehicle.2.velocity.y"], ["v2y", "v_{2y}", "v2y"]),
    (&["vehicle.2.yaw_rate"], ["ω2", "\\omega_2", "omega2"]),
    (&["contact.crush_plane"], ["Γ", "\\Gamma", "Gamma"]),
    (&["contact.restitution"], ["e", "e", "e"]),
    (&["contact.impulse_ratio.of_critical", "contact.friction", "contact.impulse_ratio"], ["μ", "\\mu", "mu"]),
    (&["contact.moment.of_critical", "contact.moment"], ["M", "M", "M"]),
];
/// Inputs whose derivatives do not depend on whether a file gives speeds and radii.
const BY: [&str; 6] = [
    "contact.crush_plane",
    "contact.restitution",
    "vehicle.1.yaw_inertia",
    "vehicle.2.velocity.x",
    "vehicle.2.impact_center.forward",
    "vehicle.1.yaw_rate",
];
/// The collisions whose derivatives are checked, by line: a barrier and a given moment; fractions of both; Kudlich
/// and Slibar's law with friction; a given ratio.
const COLLISIONS: [usize; 4] = [5, 7, 9, 10];
/// Relative tolerance of a number.
const TOLERANCE: f64 = 1e-9;

/// A formula to check: its arguments, the inputs of the collision and its value.
struct Question {
    arguments: Vec<String>,
    inputs: Value,
    want: f64,
    size: f64,
}

/// Returns the options that describe the kind of collision of a case.
fn kind(case: &Value) -> Vec<String> {
    let contact = &case["contact"];
    let mut flags = Vec::new();
    let mut flag = |name: &str, value: &str| flags.extend([name.to_owned(), value.to_owned()]);
    flag("--law", contact["tangential_law"].as_str().unwrap_or("brach"));
    let of_critical = |value: &Value| value.get("of_critical").is_some();
    let ratio = &contact["impulse_ratio"];
    flag(
        "--ratio",
        match () {
            () if contact.get("friction").is_some() => "friction",
            () if of_critical(ratio) => "of-critical",
            () if ratio.is_null() || ratio == "critical" => "critical",
            () => "given",
        },
    );
    flag(
        "--moment",
        match () {
            () if of_critical(&contact["moment"]) => "of-critical",
            () if contact.get("moment").is_some() => "given",
            () => "none",
        },
    );
    if let Some(barrier) = array(&case["vehicle"]).iter().position(|vehicle| vehicle["barrier"] == true) {
        flag("--barrier", &(barrier + 1).to_string());
    }
    flags
}

/// Returns every output of the first collisions, and its derivative with respect to one input after another, from the independent solver.
fn questions() -> Vec<Question> {
    let mut all = Vec::new();
    let references = references("gradients.jsonl");
    for reference in COLLISIONS.map(|line| &references[line]) {
        let found = document("gradient", &reference["case"], &[]);
        // With a cosine and no sine, and vice versa.
        let lone = ["contact.approach.normal", "contact.approach.tangential"];
        let outputs = array(&reference["of"]).iter().enumerate();
        let of_impact =
            outputs.filter(|(_, output)| !["crush", "mean_depth", "equivalent"].iter().any(|word| output.to_string().contains(word)));
        for (at, output) in of_impact {
            let output = output.as_str().expect("a name");
            let value = number(&found["of"][output]["value"]);
            let question = |more: &[&str], want: f64| Question {
                arguments: [vec![output.to_owned()], kind(&reference["case"]), more.iter().map(|&word| word.to_owned()).collect()].concat(),
                inputs: found["wrt"].clone(),
                want,
                size: value.abs().max(1.0),
            };
            all.push(question(&[], value));
            let by: Vec<&&str> = BY.iter().filter(|by| reference["d"].get(**by).is_some()).collect();
            let by = if lone.contains(&output) && reference["d"].get(BY[3]).is_some() { &BY[3] } else { by[at % by.len()] };
            all.push(question(&["--wrt", by], number(&reference["d"][*by][at])));
        }
    }
    assert!(all.len() > 40 * COLLISIONS.len(), "{}", all.len());
    all
}

impl Question {
    fn printed(&self, notation: &str) -> String {
        let arguments: Vec<&str> = ["formula", "--format", notation].into_iter().chain(self.arguments.iter().map(String::as_str)).collect();
        let run = run(&workspace(), &arguments);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{arguments:?}");
        run.out
    }

    /// Returns the inputs by their symbols in a notation.
    fn inputs(&self, notation: usize) -> HashMap<String, f64> {
        let value = |names: &[&str]| names.iter().find_map(|name| object(&self.inputs).get(*name)).and_then(Value::as_f64);
        INPUTS.iter().filter_map(|(names, symbols)| Some((symbols[notation].to_owned(), value(names)?))).collect()
    }

    fn hold(&self, got: f64, notation: &str) -> Option<String> {
        let off = (got - self.want).abs() <= TOLERANCE * self.want.abs().max(self.size);
        (!off).then(|| format!("{:?} in {notation}: {got}, not {}", self.arguments, self.want))
    }
}

#[test]
fn what_is_printed_for_people_and_in_latex_has_the_value() {
    let mut faults = Vec::new();
    for question in questions() {
        faults.extend(question.hold(Formula::of_text(&question.printed("text"), question.inputs(0)).value(), "text"));
        faults.extend(question.hold(Formula::of_latex(&question.printed("latex"), question.inputs(1)).value(), "LaTeX"));
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn what_is_printed_in_rust_has_the_value() {
    let folder = Folder::new();
    let (mut modules, mut calls, questions) = (String::new(), String::new(), questions());
    for (at, question) in questions.iter().enumerate() {
        let (source, inputs) = (question.printed("rust"), question.inputs(2));
        let head = source.split_once("pub fn ").expect("a function").1.split_once(") -> f64").expect("of f64").0;
        let (function, parameters) = head.split_once('(').expect("parameters");
        let parameters = parameters.split(',').filter_map(|parameter| parameter.trim().strip_suffix(": f64"));
        let arguments: Vec<String> = parameters.map(|parameter| format!("{:?}", inputs[parameter])).collect();
        modules += &format!("mod f{at} {{\n{source}}}\n");
        calls += &format!("    println!(\"{{:?}}\", f{at}::{function}({}));\n", arguments.join(", "));
    }
    let program = folder.write("formulas.rs", format!("{modules}\nfn main() {{\n{calls}}}\n").as_bytes());
    let binary = folder.path().join("formulas");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(compiler).args(["--edition", "2024", "-o"]).arg(&binary).arg(program).output();
    let compiled = compiled.expect("the compiler runs where tests are run");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let printed = String::from_utf8(Command::new(binary).output().expect("it runs").stdout).expect("numbers are ASCII");
    let values: Vec<f64> = printed.lines().map(|line| line.parse().expect("a number")).collect();
    assert_eq!(values.len(), questions.len());
    let faults: Vec<String> = questions.iter().zip(values).filter_map(|(question, got)| question.hold(got, "Rust")).collect();
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
}
