//! The help, the manual page, the completions, and the verbs `validate` and `prove`.

use std::fs;

use serde_json::Value;

use crate::process::{Folder, Run, examples, run, workspace};

fn help(arguments: &[&str]) -> String {
    let run = run(&workspace(), arguments);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{arguments:?}");
    assert!(run.out.is_ascii() || !run.out.contains('\u{1b}'), "no colors in a pipe");
    run.out
}

/// Returns the verbs that `--help` lists, except `help`.
fn verbs() -> Vec<String> {
    let listed = help(&["--help"]);
    let lines = listed.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let verbs: Vec<String> =
        lines.filter_map(|line| line.split_whitespace().next()).filter(|verb| *verb != "help").map(str::to_owned).collect();
    let known = ["solve", "gradient", "sweep", "batch", "uncertainty", "check", "validate", "prove", "formula", "completions", "man"];
    assert!(known.iter().all(|verb| verbs.iter().any(|found| found == verb)), "{verbs:?}");
    verbs
}

/// Splits a line into words as a shell does, without redirections and pipes.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for letter in line.chars() {
        match letter {
            '"' | '\'' => quoted = !quoted,
            '>' | '|' if !quoted => break,
            ' ' if !quoted => words.push(std::mem::take(&mut word)),
            other => word.push(other),
        }
    }
    words.push(word);
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn every_example_of_the_help_runs_as_printed() {
    // A copy of the workspace's root as the examples see it, with a `case.toml` as a reader would have.
    let folder = Folder::new();
    for path in examples() {
        let name = format!("cli/examples/{}", path.file_name().and_then(|name| name.to_str()).expect("a plain name"));
        folder.write(&name, &fs::read(&path).expect("the example can be read"));
    }
    for kind in ["batch", "check", "tests", "reconstruct", "record", "uncertainty"] {
        for file in fs::read_dir(workspace().join("cli/examples").join(kind)).expect("a folder") {
            let path = file.expect("an entry").path();
            let name = format!("cli/examples/{kind}/{}", path.file_name().and_then(|name| name.to_str()).expect("a plain name"));
            folder.write(&name, &fs::read(&path).expect("the example can be read"));
        }
    }
    fs::copy(folder.path().join("cli/examples/position-a.toml"), folder.path().join("case.toml")).expect("a copy");
    for verb in verbs() {
        let text = help(&[&verb, "--help"]);
        let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| line.starts_with("planar-impact ")).collect();
        assert!(!lines.is_empty(), "`{verb} --help` has no example");
        for line in lines {
            let words = words(line);
            assert_eq!(words[1], verb, "{line}");
            let arguments: Vec<&str> = words[1..].iter().map(String::as_str).collect();
            let run: Run = run(folder.path(), &arguments);
            run.succeeds(&line);
            let file = arguments.iter().skip_while(|word| **word != "-o").nth(1).filter(|file| **file != "-");
            match file {
                Some(file) => assert!(folder.path().join(file).exists(), "{line}"),
                None => assert!(!run.out.is_empty(), "{line}"),
            }
        }
    }
}

#[test]
fn help_comes_in_every_way() {
    assert_eq!(help(&["--help"]), help(&["help"]));
    let whole = help(&["--help"]);
    for status in ["0  done", "2  the input", "3  the physics", "70  a defect", "74  the output"] {
        assert!(whole.contains(status), "{status}");
    }
    for verb in verbs() {
        assert_eq!(help(&["help", &verb]), help(&[&verb, "--help"]));
        assert!(help(&[&verb, "-h"]).contains("Usage: planar-impact "), "{verb}");
    }
    assert_eq!(help(&["--version"]), format!("planar-impact {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn every_shell_has_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = help(&["completions", shell]);
        assert!(script.contains("planar-impact"), "{shell}");
        for verb in verbs() {
            assert!(script.contains(&verb), "{shell}: {verb}");
        }
    }
}

/// The script for bash goes by the words before the cursor to a label, which it must have.
#[test]
fn bash_completes_the_options_of_each_verb() {
    let script = help(&["completions", "bash"]);
    let labels: Vec<&str> = script.lines().filter_map(|line| line.trim().strip_suffix(')')).collect();
    let wanted: Vec<&str> = script.lines().filter_map(|line| line.trim().strip_prefix("cmd=\"")?.strip_suffix('"')).collect();
    assert!(wanted.len() > 20, "{wanted:?}");
    for label in wanted.iter().filter(|label| !label.is_empty()) {
        assert!(labels.contains(label), "{label}");
    }
}

#[test]
fn the_manual_page_has_every_verb_and_flag() {
    let page = help(&["man"]);
    assert!(page.contains(".TH planar-impact"), "a page begins with its title");
    for verb in verbs() {
        assert!(page.contains(&format!("planar\\-impact\\-{verb}")), "{verb}");
    }
    for flag in ["\\-\\-format", "\\-\\-units", "\\-\\-help"] {
        assert!(page.contains(flag), "{flag}");
    }
}

/// The cells misprinted in the paper: the printed value and the correct one.
const MISPRINTS: [(&str, &str); 5] =
    [("-21631.2", "-21639.2"), ("15.6", "15.7"), ("49197.30", "43197.30"), ("61334", "51334"), ("83.3", "69.6")];

#[test]
fn validate_names_the_misprints() {
    let run = run(&workspace(), &["validate"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    for (printed, holds) in MISPRINTS {
        let told = format!("printed {printed}; {holds} holds: ");
        // The reason may span several lines.
        let flat = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
        let at = flat.find(&told).unwrap_or_else(|| panic!("{told}\n{}", run.out));
        assert!(flat[at + told.len()..].split_whitespace().take(4).count() == 4, "a reason follows");
    }
    assert!(run.out.contains("5 misprinted"), "{}", run.out);
    assert!(!run.out.contains("Problem: "), "{}", run.out);
    assert!(run.out.lines().all(|line| line.chars().count() <= 80));
}

#[test]
fn validate_counts_every_cell_in_json() {
    let run = run(&workspace(), &["validate", "--format", "json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let report: Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!((&report["schema"], &report["holds"]), (&Value::from(1), &Value::from(true)));
    let cells = report["cells"].as_array().expect("cells");
    // Every number printed in the tables, except the test numbers.
    assert_eq!((cells.len(), report["given"].as_array().map(Vec::len)), (335, Some(130)));
    let tables = ["Table 1", "Table 2", "Table 3", "Table 4", "Table 5", "Table 6", "Table B1", "Table B2"];
    assert!(tables.iter().all(|table| cells.iter().any(|cell| cell["table"] == *table)));
    for cell in cells {
        assert!(cell["computed"].as_f64().is_some_and(f64::is_finite), "{cell}");
        assert!(["table", "row", "column", "unit", "printed", "verdict"].iter().all(|key| cell[key].is_string()), "{cell}");
    }
    let misprints: Vec<&Value> = cells.iter().filter(|cell| cell.get("holds").is_some()).collect();
    let mut told: Vec<(&str, &str)> =
        misprints.iter().map(|cell| (cell["printed"].as_str().expect("text"), cell["holds"].as_str().expect("text"))).collect();
    told.sort_unstable();
    assert_eq!(told, MISPRINTS);
    assert!(misprints.iter().all(|cell| cell["why"].as_str().is_some_and(|why| why.len() > 20)), "{misprints:?}");
    assert_eq!(report["problems"], Value::Array(Vec::new()));
}

#[test]
fn validate_reports_the_error_of_measured_tests() {
    let run = run(&workspace(), &["validate", "--format", "json"]);
    let report: Value = serde_json::from_str(&run.out).expect("JSON");
    let tests = report["measured"]["small_overlap"].as_array().expect("tests");
    // Measured ΔV in ft/s and clockwise yaw rate in deg/s, from the workbook of pycrash.
    for (name, delta_v, yaw_rate) in [("CF10023", 48.7, 196.3), ("CF10020", 49.9, 192.5), ("CEN1212", 53.0, 206.0)] {
        let test = tests.iter().find(|test| test["test"] == name).expect(name);
        for (reading, measured) in [(&test["delta_v"], delta_v), (&test["yaw_rate"], yaw_rate)] {
            let computed = reading["computed"].as_f64().expect("a number");
            assert_eq!(reading["percent"].as_f64(), Some(100.0 * (computed - measured) / measured), "{name}");
        }
    }
    let frontal = &report["measured"]["full_frontal"][0];
    assert_eq!(frontal["test"], "6268");
    assert!(frontal["crush_energy"]["percent"].as_f64().is_some_and(|percent| (percent - 1.6).abs() < 0.01));
    assert!(frontal["crush_energy"]["by_profile"]["percent"].as_f64().is_some_and(|percent| percent.abs() < 1e-4));
}

#[test]
fn validate_draws_figures() {
    for number in ["6", "7"] {
        let run = run(&workspace(), &["validate", "--figure", number]);
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        assert!(run.out.starts_with("<svg ") && run.out.trim_end().ends_with("</svg>") && run.out.contains(&format!("Figure {number}:")));
    }
    for call in [&["validate", "--figure", "5"][..], &["validate", "--figure", "6", "--format", "json"]] {
        let run = run(&workspace(), call);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{call:?}");
    }
}

#[test]
fn prove_has_every_identity_and_misprint_in_json() {
    let run = run(&workspace(), &["prove", "--format", "json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let report: Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!((&report["schema"], &report["holds"]), (&Value::from(1), &Value::from(true)));
    let list = |key: &str| report[key].as_array().unwrap_or_else(|| panic!("{key}"));
    let names: Vec<&str> = list("identities").iter().map(|identity| identity["name"].as_str().expect("text")).collect();
    for name in ["Eq 1", "Eq 2, squared", "A1", "A11, corrected", "A30", "works are the change of kinetic energy", "det K"] {
        assert!(names.contains(&name), "{name}");
    }
    assert!(names.len() > 100, "{}", names.len());
    for identity in list("identities") {
        assert!(identity["error_log2"].as_i64().is_some_and(|error| error < -100) && identity["holds"] == true, "{identity}");
        assert!(identity["degree"].as_u64().is_some_and(|degree| degree > 0) && identity["points"].as_u64() >= Some(2), "{identity}");
    }
    let places: Vec<&str> = list("misprints").iter().map(|misprint| misprint["place"].as_str().expect("text")).collect();
    for place in ["Eqs 7, 8", "Eq 9", "A11", "A16", "A17", "A15–A18", "A21", "after Table 2"] {
        assert!(places.contains(&place), "{place}");
    }
    for misprint in list("misprints") {
        let findings = misprint["findings"].as_array().expect("findings");
        assert!(misprint["shown"] == true && !findings.is_empty() && misprint["inputs"].as_array().is_some_and(|inputs| inputs.len() >= 5));
    }
    assert!(list("controls").iter().all(|control| control["told"] == true));
    assert_eq!(report["problems"], Value::Array(Vec::new()));
}
