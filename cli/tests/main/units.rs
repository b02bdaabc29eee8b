//! Units as people write them: weights, the gravity of a case, pounds that are forces, and `--units`.

use serde_json::Value;

use crate::process::{run, run_with_input, workspace};

/// Position A of Table 1 of the paper, row 1, with its weights as they are printed; the impact center was recovered from Table 1.
const POSITION_A: &str = r#"schema = 1
gravity = "32.2 ft/s^2"
[[vehicle]]
weight = "2564 lbf"
yaw_inertia = "1434.9 lb ft s^2"
heading = "180 degrees"
speed = "40 ft/s"
impact_center = ["6.3499 feet", "0 ft"]
[[vehicle]]
weight = "6345 lb"
yaw_inertia = "5192.4 lbf s^2 ft"
heading = "90 deg"
speed = "40 fps"
impact_center = ["7.96804 ft", "-3.2356 ft"]
[contact]
crush_plane = 0
restitution = 0
"#;

/// A foot-pound in J: 0.3048 m × 4.4482216152605 N.
const FOOT_POUND: f64 = 1.355_817_948_331_400_4;

fn solved(case: &str) -> Value {
    let run = run_with_input(&["solve", "-", "--format", "json"], case);
    assert_eq!(run.status, 0, "{}", run.err);
    serde_json::from_str(&run.out).expect("JSON")
}

fn work(answer: &Value) -> f64 {
    answer["energy"]["normal_work"].as_f64().expect("a number") / FOOT_POUND
}

fn notes(answer: &Value, code: &str) -> Vec<String> {
    let messages = answer["messages"].as_array().expect("messages");
    messages
        .iter()
        .filter(|message| message["code"] == code)
        .map(|message| message["path"].as_str().unwrap_or_default().to_owned())
        .collect()
}

#[test]
fn a_published_case_needs_its_own_gravity() {
    // W_n = -30097.2 ft lb as printed in Table 1.
    let answer = solved(POSITION_A);
    assert!((work(&answer) + 30_097.2).abs() < 0.06, "{}", work(&answer));
    assert_eq!(notes(&answer, "pound-force-assumed"), ["vehicle.1.yaw_inertia", "vehicle.2.weight"]);
    // As pounds of mass, or with the standard gravity, energies are 32.2/32.174 − 1 = 0.08 % too large in their masses, here 0.04 % because the inertias stay.
    for text in [POSITION_A.replace("gravity = \"32.2 ft/s^2\"\n", ""), POSITION_A.replace("weight", "mass").replace("lbf\"", "lb\"")] {
        let off = work(&solved(&text)) / -30_097.2 - 1.0;
        assert!((0.000_4..0.000_85).contains(&off), "{off}");
    }
}

#[test]
fn an_uncertain_weight_is_an_uncertain_mass() {
    let mass = 2564.0 * 4.448_221_615_260_5 / (32.2 * 0.3048); // Newton's second law
    for (weight, sd) in [
        ("\"2564 lbf ± 10 lbf\"", 10.0 / 2564.0),
        ("\"2564 lb ± 1 %\"", 0.01),
        ("{ value = \"2564 lbf\", sd = \"10 lbf\" }", 10.0 / 2564.0),
        ("{ min = \"2464 lbf\", max = \"2664 lbf\" }", 200.0 / 12_f64.sqrt() / 2564.0),
        ("{ min = \"2464 lbf\", mode = \"2564 lbf\", max = \"2664 lbf\" }", 100.0 / 6_f64.sqrt() / 2564.0),
        ("{ values = [\"2464 lbf\", \"2664 lbf\"] }", 100.0 / 2564.0),
    ] {
        let run = run_with_input(
            &["uncertainty", "-", "--of", "vehicle.1.delta_v_magnitude", "--method", "linear", "--format", "json"],
            &POSITION_A.replace("\"2564 lbf\"", weight),
        );
        assert_eq!(run.status, 0, "{}", run.err);
        let answer: Value = serde_json::from_str(&run.out).expect("JSON");
        let input = &answer["inputs"]["vehicle.1.mass"];
        let close = |found: &Value, wanted: f64| (found.as_f64().expect("a number") / wanted - 1.0).abs() < 1e-12;
        assert!(close(&input["mean"], mass) && close(&input["sd"], sd * mass), "{weight}: {input}");
    }
}

#[test]
fn one_of_mass_and_weight_and_one_gravity() {
    let error = |edits: &[(&str, &str)]| {
        let case = edits.iter().fold(POSITION_A.to_owned(), |case, (from, to)| case.replacen(from, to, 1));
        let run = run_with_input(&["solve", "-"], &case);
        assert_eq!(run.status, 2, "{}", run.out);
        run.err
    };
    for (edits, says) in [
        (
            &[("weight = \"2564 lbf\"", "weight = \"2564 lbf\"\nmass = \"1163 kg\"")][..],
            "vehicle.1.weight: `mass` and `weight` exclude each other",
        ),
        (&[("2564 lbf", "1163 kg")], "`1163 kg` is a mass; a weight is expected"),
        (&[("2564 lbf", "-2564 lbf")], "it must be above zero"),
        (&[("2564 lbf", "2,564 lb")], "write 2564 or 2.564"),
        (&[("2564 lbf", "2 564 lb")], "write 2564"),
        (&[("2564 lbf", "2_564 lb")], "write 2564"),
        (&[("32.2 ft/s^2", "-32.2 ft/s^2")], "gravity: it is -9.81456 m/s^2; it must be above zero"),
        (&[("\"32.2 ft/s^2\"", "32.2")], "did you mean \"32.2 ft/s^2\"?"),
        (&[("32.2 ft/s^2", "0.1 m/s^2"), ("2564 lbf", "1e9 lbf")], "which is no mass of a vehicle"),
        (&[("32.2 ft/s^2", "32.2 ft/s")], "is a speed; an acceleration is expected"),
    ] {
        let found = error(edits);
        assert!(found.contains(says) && found.matches("error: ").count() == 1, "{says}\n{found}");
    }
}

#[test]
fn the_gravity_of_a_case_is_that_of_its_slides() {
    // The closed form takes no time; both methods have their gravity from one ground.
    let text = std::fs::read_to_string(workspace().join("cli/examples/to-rest.toml")).expect("an example");
    let text = text.replace("\nposition = ", "\nmethod = \"closed-form\"\nposition = ");
    let speed = |text: &str| {
        let run = run_with_input(&["crash3", "-", "--format", "json"], text);
        assert_eq!(run.status, 0, "{}", run.err);
        let answer: Value = serde_json::from_str(&run.out).expect("JSON");
        answer["vehicles"][0]["reconstruction"]["separation_velocity"][0].as_f64().expect("a number")
    };
    let of_case = text.replacen("schema = 1\n", "schema = 1\ngravity = 9.0\n", 1);
    let of_rest = text.replacen("[rest]\n", "[rest]\ngravity = 9.0\n", 1);
    assert_eq!(speed(&of_case), speed(&of_rest));
    assert!((speed(&of_case) - speed(&text)).abs() > 0.01);
    let told = |text: &str| run_with_input(&["solve", "-"], text).out.contains("gravity has no effect");
    let in_mass = std::fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("an example");
    assert!(
        told(&in_mass.replacen("schema = 1\n", "schema = 1\ngravity = 9.0\n", 1)) && !told(&in_mass) && !told(&of_case) && !told(&of_rest)
    );
    let both = of_case.replacen("[rest]\n", "[rest]\ngravity = 9.0\n", 1);
    assert_eq!(speed(&both), speed(&of_rest));
    let other = run_with_input(&["solve", "-"], &both.replacen("gravity = 9.0", "gravity = 9.81", 1));
    assert!(
        other.status == 2 && other.err.contains("rest.gravity: it is 9 m/s^2, and the `gravity` of the case is 9.81 m/s^2"),
        "{}",
        other.err
    );
}

#[test]
fn uk_is_for_every_verb_and_never_for_json() {
    let root = workspace();
    for (verb, case) in [
        ("solve", "cli/examples/stiff-corner.toml"),
        ("gradient", "cli/examples/position-a.toml"),
        ("crush", "cli/examples/stiff-corner.toml"),
        ("crash3", "cli/examples/stiff-corner.toml"),
        ("reconstruct", "cli/examples/reconstruct/two-cars.toml"),
        ("stiffness", "cli/examples/tests/malibu.toml"),
    ] {
        let page = run(&root, &[verb, case, "--units", "uk"]);
        assert!(page.status < 2, "{verb}: {}", page.err);
        assert!(page.out.contains("mph"), "{verb}: {}", page.out);
        for unit in ["km/h", "m/s", "ft", "lb"] {
            let is_unit = |word: &str| word.trim_end_matches(',') == unit;
            assert!(!page.out.split_whitespace().any(is_unit), "{verb} prints {unit}: {}", page.out);
        }
        let json = |units: &str| run(&root, &[verb, case, "--units", units, "--format", "json"]).out;
        assert!(json("uk") == json("si") && !json("uk").is_empty(), "{verb}");
    }
    // 10 m/s is 22.37 mph: 3600/1609.344.
    let page = run(&root, &["solve", "cli/examples/stiff-corner.toml", "--units", "uk"]).out;
    // A row of a table, not a line of a wrapped sentence.
    let is_row_of = |line: &str| {
        line.trim_start().strip_prefix("mph ").is_some_and(|rest| rest.split_whitespace().all(|word| word.parse::<f64>().is_ok()))
    };
    assert!(!page.lines().any(is_row_of), "no second row of speeds: {page}");
}

/// The longest sentence of a solution, of a law whose critical ratio is another one, fits a terminal.
#[test]
fn a_ratio_and_its_critical_one_fit_a_line_each() {
    let case = std::fs::read_to_string(workspace().join("cli/examples/sideswipe.toml")).expect("an example");
    let case = case.replace("[contact]", "[contact]\ntangential_law = \"kudlich-slibar\"");
    let run = run_with_input(&["solve", "-"], &case);
    assert!(run.status == 0 && run.out.contains("critical mu0 by Brach's law"), "{}", run.err);
    assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
}
