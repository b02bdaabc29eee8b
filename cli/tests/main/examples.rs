//! The case files shipped with the program, solved in each output format.

use std::fs;

use serde_json::Value;

use crate::process::{Folder, Run, examples, planar_impact, run, run_with_input, workspace};

fn solve(path: &std::path::Path, arguments: &[&str]) -> Run {
    Run::of(planar_impact(&workspace()).arg("solve").arg(path).args(arguments).output().expect("the program starts"))
}

/// Collects the dotted path of every value, with array items by number.
fn paths(value: &Value, path: &str, found: &mut Vec<String>) {
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, inner)| paths(inner, &below(key), found)),
        Value::Array(items) => items.iter().enumerate().for_each(|(i, inner)| paths(inner, &below(&i.to_string()), found)),
        _ => found.push(path.to_owned()),
    }
}

/// Returns the paths that other tools rely on.
fn documented(has_crush: [bool; 2]) -> Vec<String> {
    let [vehicle_1, vehicle_2] = has_crush.map(|has_crush| {
        let mut vehicle = vec!["name", "velocity.0", "velocity.1", "yaw_rate", "delta_v.0", "delta_v.1", "delta_v_magnitude", "pdof"];
        if has_crush {
            vehicle.extend(["crush_energy", "equivalent_energy_speed", "mean_depth"]);
            vehicle.extend(["crash3.pdof", "crash3.correction", "crash3.corrected_energy"]);
            vehicle.extend(["crash3.effective_mass_factor", "crash3.delta_v_magnitude"]);
        }
        vehicle
    });
    let contact = [
        "restitution",
        "impulse_ratio",
        "critical_impulse_ratio",
        "impulse.normal",
        "impulse.tangential",
        "impulse.x",
        "impulse.y",
        "approach.normal",
        "approach.tangential",
        "separation.normal",
        "separation.tangential",
    ];
    let energy = ["before", "after", "loss", "normal_work", "tangential_work"];
    let mut all = vec!["schema".to_owned(), "title".to_owned()];
    for (table, keys) in [("vehicles.0", &vehicle_1[..]), ("vehicles.1", &vehicle_2), ("contact", &contact), ("energy", &energy)] {
        all.extend(keys.iter().map(|key| format!("{table}.{key}")));
    }
    all.sort();
    all
}

#[test]
fn each_is_solved_in_either_units() {
    for path in examples() {
        let mut texts = Vec::new();
        for arguments in [&[][..], &["--units", "si"], &["--units", "us"], &["--format", "text"]] {
            let run = solve(&path, arguments);
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{path:?} {arguments:?}");
            for line in run.out.lines() {
                assert!(line.chars().count() <= 80, "{path:?} {arguments:?}: {line}");
                assert_eq!(line.trim_end(), line, "no spaces at the end of a line");
            }
            texts.push(run.out);
        }
        let [usual, si, us, text] = &texts[..] else { unreachable!("four runs") };
        assert_eq!(usual, text, "text is the default");
        assert!(usual == si || usual == us, "the default units are those of the file");
        assert!(si.contains(" m/s ") && si.contains(" km/h ") && !si.contains(" ft"), "{si}");
        assert!(us.contains(" ft/s ") && us.contains(" mph ") && !us.contains("km/h"), "{us}");
    }
}

#[test]
fn position_a_prints_the_paper_s_row() {
    let run = solve(&workspace().join("cli/examples/position-a.toml"), &[]);
    for cell in ["0.661", "-30097", "-19884"] {
        assert!(run.out.contains(cell), "{cell}: {}", run.out);
    }
}

#[test]
fn the_json_has_the_documented_keys() {
    for path in examples() {
        let run = solve(&path, &["--format", "json"]);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{path:?}");
        let mut solution: Value = serde_json::from_str(&run.out).expect("JSON");
        assert_eq!(solution["schema"], 1);
        // The crush plane of this example is derived from two surfaces.
        let oblique = path.ends_with("oblique-surfaces.toml");
        let both = oblique || path.ends_with("stiff-corner.toml") || path.ends_with("to-rest.toml");
        let has_crush = [both || path.ends_with("cavalier-crush.toml"), both];
        let bracket = solution.as_object_mut().expect("an object").remove("crush_plane_bracket");
        assert_eq!(bracket.is_some(), oblique, "{path:?}");
        let mut found = Vec::new();
        paths(&solution, "", &mut found);
        found.sort();
        let documented = documented(has_crush);
        assert!(documented.iter().all(|path| found.contains(path)), "{path:?}");
        let texts = ["title", "vehicles.0.name", "vehicles.1.name"];
        for path in documented.iter().filter(|path| !texts.contains(&path.as_str())) {
            let value = solution.pointer(&format!("/{}", path.replace('.', "/"))).expect("just found");
            assert!(value.as_f64().is_some_and(f64::is_finite), "{path} is {value}");
        }
        assert!(!run.out.contains("-0.0,") && !run.out.contains("-0.0\n"), "a zero has no sign: {}", run.out);
    }
}

#[test]
fn a_wall_gets_zeros() {
    let run = solve(&workspace().join("cli/examples/crabbed-barrier.toml"), &["--format", "json"]);
    let solution: Value = serde_json::from_str(&run.out).expect("JSON");
    let wall = &solution["vehicles"][1];
    assert_eq!(wall["name"], "winged barrier");
    for value in ["velocity", "delta_v"].iter().flat_map(|key| [&wall[key][0], &wall[key][1]]) {
        assert_eq!(value, 0.0);
    }
    for key in ["yaw_rate", "delta_v_magnitude", "pdof"] {
        assert_eq!(wall[key], 0.0, "{key}");
    }
}

#[test]
fn json_in_place_of_toml_and_standard_input_in_place_of_a_file() {
    let folder = Folder::new();
    for path in examples() {
        let toml = fs::read_to_string(&path).expect("the example can be read");
        let case: Value = toml::from_str(&toml).expect("the example is TOML");
        let json = serde_json::to_string_pretty(&case).expect("a case has no maps with other keys");
        for format in ["json", "text"] {
            let expected = solve(&path, &["--format", format]);
            assert_eq!(expected.status, 0, "{path:?}");
            folder.write("case.json", json.as_bytes());
            let runs = [
                run(folder.path(), &["solve", "case.json", "--format", format]),
                run_with_input(&["solve", "-", "--format", format], &json),
                run_with_input(&["solve", "-", "--format", format], &toml),
                run_with_input(&["solve", "--format", format, "-"], &toml.replace('\n', "\r\n")),
            ];
            for other in runs {
                assert_eq!((other.status, other.err.as_str()), (0, ""), "{path:?}");
                assert_eq!(other.out, expected.out, "{path:?}");
            }
        }
    }
}

#[test]
fn what_was_taken_for_granted_is_noted() {
    let case = r#"{"schema": 1, "vehicle": [{"mass": 1200, "yaw_inertia": "2000 kg m^2", "heading": 0, "speed": "10 m/s",
        "impact_center": ["2 m", "0.5 m"]}, {"barrier": true}], "contact": {"crush_plane": "0 deg", "restitution": 0.1}}"#;
    let run = run_with_input(&["solve", "-", "--format", "json"], case);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let solution: Value = serde_json::from_str(&run.out).expect("JSON");
    let notes: Vec<&str> = solution["notes"].as_array().expect("notes").iter().filter_map(Value::as_str).collect();
    assert_eq!(notes.len(), 2, "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("vehicle.1.mass") && note.contains("kg")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("vehicle.1.heading") && note.contains("rad")), "{notes:?}");
    let text = run_with_input(&["solve", "-"], case);
    assert!(notes.iter().all(|note| text.out.contains(note)), "{}", text.out);
}

#[test]
fn solving_twice_prints_the_same() {
    let path = workspace().join("cli/examples/position-b.toml");
    for format in ["json", "text"] {
        assert_eq!(solve(&path, &["--format", format]).out, solve(&path, &["--format", format]).out);
    }
}

#[test]
fn a_title_cannot_reach_into_the_terminal() {
    let text = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example is there");
    let loud = text
        .replace("Sedan into", "\\u001b[31mSedan\\u0007 into a very long title that does not fit into eighty columns of a terminal, into");
    let run = run_with_input(&["solve", "-"], &loud);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(!run.out.contains(['\u{1b}', '\u{7}']), "{}", run.out);
    assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
}

#[test]
fn a_moment_impulse_is_in_the_account() {
    let text = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example is there");
    let run = run_with_input(&["solve", "-", "--format", "json"], &(text + "moment = { of_critical = 1 }\n"));
    assert_eq!(run.status, 0, "{}", run.err);
    let json: Value = serde_json::from_str(&run.out).expect("JSON");
    let number = |pointer: &str| json.pointer(pointer).and_then(Value::as_f64).expect("a number");
    // The full critical moment: the vehicles separate with the same yaw rate, and the moment accounts for part of the loss.
    assert!((number("/vehicles/0/yaw_rate") - number("/vehicles/1/yaw_rate")).abs() < 1e-12);
    let works = number("/energy/normal_work") + number("/energy/tangential_work") + number("/energy/moment_work");
    assert!((number("/energy/loss") + works).abs() < 1e-9 * number("/energy/loss"));
    assert!(number("/energy/moment_work") < 0.0 && number("/contact/impulse/moment").abs() > 1.0);
}
