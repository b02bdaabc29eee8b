//! The verb `formula`: its formulas evaluate to the results of `solve`.

use std::collections::HashMap;
use std::fs;
use std::process::Command;

use serde_json::Value;

use crate::process::{Folder, Run, examples, run, workspace};

/// Returns the outputs or the inputs of the list, each by symbol and name.
fn listed(title: &str) -> Vec<[String; 2]> {
    let list = formula(&["--list"]).out;
    let lines = list.lines().skip_while(|line| !line.trim_start().starts_with(title)).skip(2).take_while(|line| !line.is_empty());
    let names: Vec<[String; 2]> =
        lines.map(|line| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>().try_into().expect("a symbol and a name")).collect();
    assert!(names.len() >= 20, "{list}");
    names
}

fn formula(arguments: &[&str]) -> Run {
    let mut all = vec!["formula"];
    all.extend(arguments);
    let run = run(&workspace(), &all);
    run.succeeds(&arguments);
    run
}

/// Returns the JSON answer of `solve`.
fn solved(path: &str) -> Value {
    let run = run(&workspace(), &["solve", path, "--format", "json"]);
    serde_json::from_str(&run.out).expect("JSON")
}

/// Returns the value of an output by its name, or `None` if `solve` does not print it.
fn value(solution: &Value, name: &str) -> Option<f64> {
    let path = match name.split('.').collect::<Vec<_>>()[..] {
        ["vehicle", number, ref rest @ ..] => {
            let at = number.parse::<usize>().expect("1 or 2") - 1;
            let rest: Vec<&str> = rest
                .iter()
                .map(|key| {
                    if *key == "x" {
                        "0"
                    } else if *key == "y" {
                        "1"
                    } else {
                        key
                    }
                })
                .collect();
            format!("/vehicles/{at}/{}", rest.join("/"))
        }
        ref keys => format!("/{}", keys.join("/")),
    };
    solution.pointer(&path).and_then(Value::as_f64)
}

/// Returns the inputs that the text lists, by symbol.
fn inputs(text: &str) -> HashMap<String, f64> {
    let lines = text.lines().skip_while(|line| *line != "inputs").skip(1);
    let words = lines.map(|line| line.split_whitespace().collect::<Vec<_>>());
    words.map(|words| (words[0].to_owned(), words[words.len() - 1].replace('−', "-").parse().expect("a number"))).collect()
}

/// Converts a name in the source to its symbol.
fn letters(name: &str) -> String {
    [("theta", "θ"), ("omega", "ω"), ("Gamma", "Γ"), ("mu", "μ")]
        .iter()
        .fold(name.to_owned(), |name, (word, letter)| name.replace(word, letter))
}

#[test]
fn every_output_is_printed_in_every_notation() {
    for [symbol, name] in listed("output") {
        for ratio in ["critical", "given", "of-critical", "friction"] {
            let text = formula(&[&name, "--ratio", ratio]).out;
            assert_eq!(text, formula(&[&symbol, "--ratio", ratio, "--format", "text"]).out);
            assert!(text.starts_with(&format!("{name}: two vehicles, ")), "{text}");
            for line in text.lines() {
                assert!(line.chars().count() <= 80 && line.trim_end() == line, "{line}");
            }
        }
        let latex = formula(&[&name, "--wrt", "Gamma", "--ratio", "friction", "--format", "latex"]).out;
        for (open, close) in [("{", "}"), (r"\left", r"\right"), (r"\begin{", r"\end{"), (r"\[", r"\]")] {
            assert_eq!(latex.matches(open).count(), latex.matches(close).count(), "{open} in {latex}");
        }
        assert!(latex.is_ascii(), "{latex}");
        assert!(formula(&[&name, "--wrt", "e", "--law", "kudlich-slibar", "--format", "rust"]).out.contains("-> f64 {"));
    }
}

#[test]
fn the_value_of_the_formula_is_that_of_solve() {
    for path in examples() {
        let path = path.to_str().expect("a plain name");
        let solution = solved(path);
        let mut compared = 0;
        for [_, name] in listed("output") {
            let text = formula(&[&name, "--case", path]).out;
            let definition = text.split("\n\n").nth(1).expect("the formula follows its subject");
            let printed: f64 = definition.rsplit("= ").next().expect("a value").trim().replace('−', "-").parse().expect("a number");
            let Some(expected) = value(&solution, &name) else { continue };
            assert!((printed - expected).abs() <= 1e-5 * expected.abs() + 1e-9, "{path} {name}: {printed} for {expected}");
            compared += 1;
        }
        assert!(compared >= 30, "solve prints all but the moment and its work");
    }
}

/// The functions printed as Rust, called with the inputs listed in the text, compute what `solve` prints.
#[test]
fn the_source_computes_what_solve_computes() {
    let folder = Folder::new();
    let (mut modules, mut calls, mut expected) = (String::new(), String::new(), Vec::new());
    for path in examples() {
        let path = path.to_str().expect("a plain name");
        let solution = solved(path);
        for name in ["energy.normal_work", "energy.loss", "vehicle.1.pdof", "vehicle.2.delta_v_magnitude", "vehicle.1.velocity.x"] {
            let source = formula(&[name, "--case", path, "--format", "rust"]).out;
            let inputs = inputs(&formula(&[name, "--case", path]).out);
            let head = source.split_once("pub fn ").expect("a function").1.split_once(") -> f64").expect("of f64").0;
            let (function, parameters) = head.split_once('(').expect("parameters");
            let parameters = parameters.split(',').filter_map(|parameter| parameter.trim().strip_suffix(": f64"));
            let arguments: Vec<String> = parameters.map(|parameter| format!("{:?}", inputs[&letters(parameter)])).collect();
            let at = expected.len();
            modules += &format!("mod f{at} {{\n{source}}}\n");
            calls += &format!("    println!(\"{{:?}}\", f{at}::{function}({}));\n", arguments.join(", "));
            expected.push((format!("{name} of {path}"), value(&solution, name).expect("solve prints it")));
        }
    }
    let program = folder.write("formulas.rs", format!("{modules}\nfn main() {{\n{calls}}}\n").as_bytes());
    let binary = folder.path().join("formulas");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(compiler).args(["--edition", "2024", "-D", "warnings", "-o"]).arg(&binary).arg(program).output();
    let compiled = compiled.expect("the compiler runs where tests are run");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let printed = String::from_utf8(Command::new(binary).output().expect("it runs").stdout).expect("numbers are ASCII");
    assert_eq!(printed.lines().count(), expected.len());
    for (line, (what, expected)) in printed.lines().zip(expected) {
        let computed: f64 = line.parse().expect("a number");
        // The inputs are printed with six digits.
        assert!((computed - expected).abs() <= 1e-3 * expected.abs() + 1e-9, "{what}: {computed} for {expected}");
    }
}

#[test]
fn a_derivative_by_what_it_does_not_depend_on_is_zero() {
    for (output, input) in [("mu0", "contact.moment"), ("v_n", "e"), ("W_m", "m1"), ("T_before", "Γ")] {
        let text = formula(&[output, "--wrt", input]).out;
        assert!(text.ends_with(" = 0\n"), "{text}");
    }
}

#[test]
fn an_input_is_its_own_formula() {
    let text = formula(&["e"]).out;
    assert!(text.contains("e = e, which is an input\n"), "{text}");
    assert!(formula(&["mu", "--ratio", "given"]).out.contains("μ = μ, which is an input\n"));
    assert!(formula(&["e", "--wrt", "e"]).out.ends_with("∂e/∂e = 1\n"));
}

#[test]
fn the_paper_s_equations_are_recognized() {
    let has = |arguments: &[&str], lines: &[&str]| {
        let text = formula(arguments).out;
        for line in lines {
            assert!(text.lines().any(|printed| printed.trim() == *line), "{line}\n{text}");
        }
    };
    // Eqs 1, 7, 8, A5, A27, A28 to A30, A11 and A21 in terms of r, A24 and A25.
    has(&["T_L"], &["T_L = −(W_n + W_t)", "W_n = −½ P_n (v_n + V_n)", "W_t = −½ P_t (v_t + V_t)"]);
    has(&["Omega1"], &["Ω1 = ω1 + (r1n P_t − r1t P_n)/I1"]);
    has(&["mu0"], &["μ0 = (K_nn v_t − (1 + e) K_nt v_n)/((1 + e) K_tt v_n − K_nt v_t)", "K_nt = −(r1n r1t/I1 + r2n r2t/I2)"]);
    has(&["v_n"], &["v_n = v2n − r2t ω2 − v1n + r1t ω1", "v1n = v1x cos Γ + v1y sin Γ"]);
    has(&["W_n", "--ratio", "given"], &["P_t = μ P_n", "P_n = (1 + e) v_n/(K_nn + μ K_nt)"]);
    has(&["v_n", "--wrt", "Gamma"], &["∂v_n/∂Γ = v_t"]);
    has(&["mu0", "--wrt", "e"], &["∂μ0/∂e = −v_n (K_nt + μ0 K_tt)/((1 + e) K_tt v_n − K_nt v_t)"]);
}

#[test]
fn what_is_wrong_is_said() {
    let calls: [(&[&str], &str); 12] = [
        (&["W_m2"], "no output has the name `W_m2`; did you mean `W_m`? see `planar-impact formula --list`"),
        (&["nothing like it"], "no output has the name `nothing like it`; see `planar-impact formula --list`"),
        (&[""], "no output has the name ``"),
        (&["m1"], "it is an input; give it as --wrt m1"),
        (&["W_n", "--wrt", "W_t"], "it is an output; only inputs can be differentiated by"),
        (&["T_L", "--wrt", "v1"], "a formula has vehicle.1.velocity.x and vehicle.1.velocity.y in place of the speed"),
        (&["T_L", "--wrt", "vehicle.2.radius_of_gyration"], "a formula has vehicle.2.yaw_inertia in place of the radius of gyration"),
        (&["T_L", "--wrt", "vehicle.1.crush.width"], "are in no formula of a collision"),
        (&["W_n", "--wrt", "gamma"], "no input has the name `gamma`; did you mean `Gamma`?"),
        (&["W_n", "--ratio", "given", "--case", "cli/examples/position-a.toml"], "cannot be used with"),
        (&["W_n", "--barrier", "3"], "it must be a whole number from 1 to 2"),
        (&["W_n", "--case", "nowhere.toml"], "cannot be read"),
    ];
    for (arguments, says) in calls {
        let run = run(&workspace(), &[&["formula"], arguments].concat());
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}");
        assert!(run.err.contains(says), "{arguments:?}: {}", run.err);
    }
}

#[test]
fn a_case_that_the_physics_refuses_has_no_values() {
    let folder = Folder::new();
    let text = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example is there");
    folder.write("case.toml", text.replace("speed = \"40 ft/s\"", "speed = \"-40 ft/s\"").as_bytes());
    let run = run(folder.path(), &["formula", "W_n", "--case", "case.toml"]);
    assert_eq!((run.status, run.out.as_str()), (3, ""), "{}", run.err);
}

#[test]
fn the_guide_shows_what_is_printed() {
    let guide = fs::read_to_string(workspace().join("src/guide/formulas.md")).expect("the guide is there");
    let mut shown = 0;
    for block in guide.split("```sh\nplanar-impact ").skip(1) {
        let (call, rest) = block.split_once("\n```").expect("a call ends");
        let text = rest.split_once("```text\n").and_then(|(_, text)| text.split_once("```")).expect("its output follows").0;
        assert_eq!(run(&workspace(), &call.split(' ').collect::<Vec<_>>()).out, text, "{call}");
        shown += 1;
    }
    assert_eq!(shown, 2);
}

/// The critical impulse ratio follows from the inputs, so that nothing depends on the ratio itself: 0, with the note of `gradient`, in `batch` too. A ratio that is
/// given has none.
#[test]
fn a_ratio_that_follows_from_the_inputs_is_noted() {
    let note = "the file does not give contact.impulse_ratio";
    let folder = Folder::new();
    let critical = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("an example");
    let given = critical.replace("[contact]", "[contact]\nimpulse_ratio = 0.1");
    fs::write(folder.path().join("rows.csv"), "vehicle.1.speed\n12\n").expect("a table");
    for (name, text, is_noted) in [("critical.toml", critical, true), ("given.toml", given, false)] {
        fs::write(folder.path().join(name), text).expect("a case");
        let found = run(folder.path(), &["formula", "T_L", "--case", name, "--wrt", "mu"]);
        assert_eq!(
            (found.status, found.out.contains(note) || found.err.contains(note)),
            (0, is_noted),
            "{name}: {}{}",
            found.out,
            found.err
        );
        let rows = run(folder.path(), &["batch", "rows.csv", "-o", "-", "--case", name, "--of", "T_L", "--wrt", "mu"]);
        assert_eq!((rows.status, rows.err.contains(note)), (0, is_noted), "{name}: {}{}", rows.out, rows.err);
    }
}
