//! The verb `gradient`: compared with an independent solver and with `solve`, and invalid calls.

use std::path::Path;

use serde_json::Value;

use crate::process::{Folder, Run, examples, run, run_with_input, workspace};

/// A case with a speed, a velocity, a radius of gyration and crush.
const MIXED: &str = r#"schema = 1

[[vehicle]]
mass = "1200 kg"
radius_of_gyration = "1.3 m"
heading = "30 deg"
speed = "12 m/s"
impact_center = ["2 m", "-0.3 m"]

[[vehicle]]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
heading = "200 deg"
velocity = ["-8 m/s", "-3 m/s"]
impact_center = ["1.9 m", "0.4 m"]

[vehicle.crush]
width = "1.5 m"
depths = ["0.3 m", "0.2 m", "0.1 m"]
stiffness = { d0 = "150 N^0.5", d1 = "700 N^0.5/m" }

[contact]
crush_plane = "20 deg"
restitution = 0.2
"#;

fn json(arguments: &[&str], case: &str) -> Value {
    let run = run_with_input(&[&["gradient", "-", "--format", "json"], arguments].concat(), case);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{arguments:?}");
    serde_json::from_str(&run.out).expect("JSON")
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn derivative(document: &Value, of: &str, by: &str) -> f64 {
    document["of"][of]["d"][by].as_f64().unwrap_or_else(|| panic!("{of} by {by}"))
}

/// Returns the kind of quantity, which determines the scale of its numbers.
fn sort(name: &str) -> &'static str {
    let last = name.rsplit('.').next().expect("a name has a last part");
    match last {
        "pdof" | "heading" | "crush_plane" | "restitution" | "impulse_ratio" | "critical_impulse_ratio" | "friction" | "of_critical" => {
            "one"
        }
        "forward" | "left" => "one",
        "yaw_rate" => "yaw rate",
        "moment" | "normal" | "tangential" | "x" | "y" if name.starts_with("contact.impulse.") || last == "moment" => "impulse",
        "normal" | "tangential" | "x" | "y" | "speed" | "delta_v_magnitude" => "speed",
        _ if name.starts_with("energy.") => "energy",
        // Masses, inertias and crush have their own scales.
        _ => "own",
    }
}

/// The scale of each kind of quantity in this collision.
struct Sizes<'a>(&'a Value);

impl Sizes<'_> {
    fn largest(&self, wanted: &str) -> f64 {
        let of = self.0["of"].as_object().expect("outputs");
        let sizes = of.iter().filter(|(name, _)| sort(name) == wanted).map(|(_, entry)| entry["value"].as_f64().expect("a value").abs());
        sizes.fold(0.0, f64::max)
    }

    fn of(&self, name: &str, value: &Value) -> f64 {
        let value = value.as_f64().unwrap_or(0.0).abs();
        match sort(name) {
            "one" => value.max(1.0),
            // At one meter from the center of mass.
            "yaw rate" => self.largest("yaw rate").max(self.largest("speed")),
            "own" if value == 0.0 => 1.0,
            "own" => value,
            other => self.largest(other),
        }
    }

    fn input(&self, name: &str) -> f64 {
        self.of(name, &self.0["wrt"][name])
    }

    fn output(&self, name: &str) -> f64 {
        self.of(name, &self.0["of"][name]["value"])
    }
}

/// Returns `true` if two derivatives agree to 10⁻¹⁰, or to 10⁻¹² of the scale of such a derivative if it is small.
fn agree(got: f64, want: f64, size: f64) -> bool {
    (got - want).abs() <= 1e-10 * want.abs() + 1e-12 * size
}

#[test]
fn every_derivative_of_the_independent_solver() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/gradients.jsonl");
    let text = std::fs::read_to_string(path).expect("the derivatives can be read");
    let (mut first, mut second, mut faults) = (0, 0, Vec::new());
    for (i, line) in text.lines().enumerate() {
        let reference: Value = serde_json::from_str(line).expect("each line is JSON");
        let got = json(&["--second"], &reference["case"].to_string());
        let (sizes, of) = (Sizes(&got), reference["of"].as_array().expect("names"));
        let mut names: Vec<&str> = of.iter().filter_map(Value::as_str).collect();
        names.sort_unstable();
        // The CRASH3 results have their own references.
        let of_planar = |name: &&str| !name.contains(".crash3.");
        assert_eq!(keys(&got["of"]).into_iter().filter(of_planar).collect::<Vec<_>>(), names, "line {}", i + 1);
        assert_eq!(keys(&got["wrt"]), keys(&reference["d"]), "line {}", i + 1);
        let mut check = |by: &[&str], want: &Value, find: &dyn Fn(&Value) -> Value| {
            for (output, want) in of.iter().filter_map(Value::as_str).zip(want.as_array().expect("a row")) {
                let (got, want) = (find(&got["of"][output]).as_f64().expect("a number"), want.as_f64().expect("a number"));
                let size = sizes.output(output) / by.iter().map(|name| sizes.input(name)).product::<f64>();
                if !agree(got, want, size) {
                    faults.push(format!("line {}: {output} by {by:?} is {got}, not {want}", i + 1));
                }
            }
        };
        for (by, want) in reference["d"].as_object().expect("rows") {
            check(&[by], want, &|entry| entry["d"][by].clone());
            first += of.len();
        }
        for row in reference["d2"].as_array().expect("rows") {
            let by: Vec<&str> = row["by"].as_array().expect("two names").iter().filter_map(Value::as_str).collect();
            check(&by, &row["d2"], &|entry| entry["d2"][by[0]][by[1]].clone());
            second += of.len();
        }
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
    assert!(first > 20_000 && second > 4_000, "{first} and {second}: the file is cut off");
}

#[test]
fn the_comparison_notices() {
    assert!(agree(1.0, 1.0 + 1e-11, 1.0) && !agree(1.0, 1.0 + 2e-10, 1.0));
    assert!(agree(1e-13, 0.0, 1.0) && !agree(1e-11, 0.0, 1.0));
    assert!(!agree(1.0, -1.0, 1.0) && !agree(f64::NAN, 1.0, 1.0));
}

#[test]
fn values_are_those_of_solve() {
    for path in examples() {
        let case = std::fs::read_to_string(&path).expect("the example can be read");
        let solved: Value = serde_json::from_str(&run_with_input(&["solve", "-", "--format", "json"], &case).out).expect("JSON");
        let gradient = json(&[], &case);
        assert_eq!(gradient["schema"], 1);
        for name in keys(&gradient["of"]) {
            let mut pointer = format!("/{}", name.replace('.', "/"));
            for (name, place) in [("/vehicle/1", "/vehicles/0"), ("/vehicle/2", "/vehicles/1"), ("velocity/x", "velocity/0")] {
                pointer = pointer.replace(name, place);
            }
            for (name, place) in [("velocity/y", "velocity/1"), ("delta_v/x", "delta_v/0"), ("delta_v/y", "delta_v/1")] {
                pointer = pointer.replace(name, place);
            }
            assert_eq!(solved.pointer(&pointer), Some(&gradient["of"][name]["value"]), "{path:?} {name}");
            assert_eq!(keys(&gradient["of"][name]["d"]), keys(&gradient["wrt"]), "every input is there");
            assert!(gradient["of"][name].get("d2").is_none(), "second derivatives only when asked for");
        }
    }
}

#[test]
fn the_other_keys_of_the_file_are_held() {
    let document = json(&[], MIXED);
    let at = |name: &str| document["of"][name]["value"].as_f64().expect("a value");
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-9 * want.abs().max(1.0), "{got} {want}");
    // 12 m/s at 30 deg: the speed turns with the heading, so the kinetic energy is unchanged and the approach velocity changes.
    close(derivative(&document, "energy.before", "vehicle.1.heading"), 0.0);
    close(derivative(&document, "energy.before", "vehicle.1.speed"), 1200.0 * 12.0);
    close(derivative(&document, "energy.before", "vehicle.1.velocity.y"), 1200.0 * 6.0);
    // A velocity given by components does not turn with the vehicle: only the impact center moves.
    assert!(derivative(&document, "contact.approach.normal", "vehicle.1.heading").abs() > 1.0);
    close(derivative(&document, "contact.approach.normal", "vehicle.2.heading"), 0.0);
    close(derivative(&document, "energy.before", "vehicle.2.velocity.x"), 1500.0 * -8.0);
    // Heading 200 deg; the value is the velocity component along the heading.
    let (sin, cos) = 200_f64.to_radians().sin_cos();
    close(document["wrt"]["vehicle.2.speed"].as_f64().expect("a value"), -8.0 * cos - 3.0 * sin);
    close(derivative(&document, "energy.before", "vehicle.2.speed"), 1500.0 * (-8.0 * cos - 3.0 * sin));
    // I = m k²: the inertia of vehicle 1 follows its mass, that of vehicle 2 is fixed.
    close(document["wrt"]["vehicle.1.yaw_inertia"].as_f64().expect("a value"), 1200.0 * 1.69);
    let by_mass = derivative(&document, "vehicle.1.yaw_rate", "vehicle.1.mass");
    let with_inertia = derivative(&document, "vehicle.1.yaw_rate", "vehicle.1.yaw_inertia");
    let radius = derivative(&document, "vehicle.1.yaw_rate", "vehicle.1.radius_of_gyration");
    close(radius, with_inertia * 2.0 * 1200.0 * 1.3);
    let fixed = json(&["--of", "Omega1", "--wrt", "m1"], &MIXED.replace("radius_of_gyration = \"1.3 m\"", "yaw_inertia = 2028"));
    close(by_mass, derivative(&fixed, "vehicle.1.yaw_rate", "vehicle.1.mass") + with_inertia * 1.69);
    // EES = √(2 E/m), and the crush does not affect the impact.
    close(derivative(&document, "vehicle.2.equivalent_energy_speed", "vehicle.2.mass"), -at("vehicle.2.equivalent_energy_speed") / 3000.0);
    close(derivative(&document, "vehicle.2.mean_depth", "vehicle.2.crush.depths.2"), 0.5);
    close(derivative(&document, "energy.loss", "vehicle.2.crush.width"), 0.0);
    let notes = document["notes"].to_string();
    assert!(notes.contains("holds the other keys of the file"), "{notes}");
}

/// Just before it the derivatives are those of a constant ratio, just after it those of sticking.
#[test]
fn derivatives_of_one_side_are_told() {
    let case = |friction: f64| format!("{MIXED}friction = {friction:e}\n");
    let at = |friction: f64| json(&[], &case(friction));
    let critical = at(0.05)["of"]["contact.critical_impulse_ratio"]["value"].as_f64().expect("a ratio").abs();
    let warns = |friction: f64| at(friction)["notes"].to_string().contains("at which sliding just ends");
    assert_eq!([critical, 1.0001 * critical, 0.9999 * critical].map(warns), [true, false, false]);
    let work = |friction: f64| derivative(&at(friction), "energy.tangential_work", "contact.friction");
    assert!(work(critical) == 0.0 && work(1.0001 * critical) == 0.0 && work(0.9999 * critical).abs() > 1.0);
    let ratio = at(0.05)["of"]["contact.impulse_ratio"]["value"].as_f64().expect("a ratio");
    let given = json(&[], &format!("{MIXED}impulse_ratio = {:e}\n", critical.copysign(ratio)));
    let (of_given, before) =
        (derivative(&given, "energy.tangential_work", "contact.impulse_ratio").abs(), work((1.0 - 1e-9) * critical).abs());
    assert!((of_given - before).abs() <= 1e-6 * before, "{of_given} and {before}");
}

#[test]
fn nothing_depends_on_a_ratio_that_the_file_does_not_give() {
    for (words, by) in [
        ("", "contact.impulse_ratio"),
        ("friction = 0.05", "contact.friction"),
        ("impulse_ratio = { of_critical = 0.5 }", "contact.impulse_ratio.of_critical"),
        ("impulse_ratio = 0.05", "contact.impulse_ratio"),
    ] {
        let document = json(&[], &format!("{MIXED}{words}\n"));
        let inputs = keys(&document["wrt"]);
        assert!(inputs.contains(&"contact.impulse_ratio") && inputs.contains(&by), "{words}: {inputs:?}");
        let given = words.starts_with("impulse_ratio = 0.05");
        let zero = derivative(&document, "energy.tangential_work", "contact.impulse_ratio") == 0.0;
        assert_eq!(zero, !given, "{words}");
        assert_eq!(document["notes"].to_string().contains("does not give contact.impulse_ratio"), !given, "{words}");
        if !words.is_empty() {
            assert!(derivative(&document, "energy.tangential_work", by).abs() > 1.0, "{words}");
        }
        let text = run_with_input(&["gradient", "-"], &format!("{MIXED}{words}\n")).out;
        assert_eq!(text.contains("\ncontact.impulse_ratio "), given, "{text}");
    }
}

#[test]
fn names_choose_and_order() {
    let all = json(&[], MIXED);
    let some = json(&["--of", "T_L,dV2", "--of", "energy.normal_work, T_L", "--wrt", "e,Gamma", "--wrt", "vehicle.1.heading"], MIXED);
    assert_eq!(keys(&some["of"]), ["energy.loss", "energy.normal_work", "vehicle.2.delta_v_magnitude"]);
    for name in keys(&some["of"]) {
        let d = &some["of"][name]["d"];
        assert_eq!(keys(d), ["contact.crush_plane", "contact.restitution", "vehicle.1.heading"]);
        keys(d).iter().for_each(|by| assert_eq!(d[by], all["of"][name]["d"][by], "{name} {by}"));
    }
    assert_eq!(json(&["--of", "all", "--wrt", "all"], MIXED), all);
    let run = run_with_input(&["gradient", "-", "--format", "json", "--of", "dV2,T_L", "--wrt", "e,Gamma"], MIXED);
    let place = |name: &str| run.out.find(&format!("\"{name}\"")).expect("a key");
    assert!(place("vehicle.2.delta_v_magnitude") < place("energy.loss"), "in the order named");
    assert!(place("contact.restitution") < place("contact.crush_plane"), "in the order named");
}

#[test]
fn second_derivatives_are_symmetric() {
    let document = json(&["--second"], MIXED);
    let inputs = keys(&document["wrt"]);
    for (name, entry) in document["of"].as_object().expect("outputs") {
        assert_eq!(keys(&entry["d2"]), inputs);
        for (one, row) in entry["d2"].as_object().expect("rows") {
            row.as_object().expect("a row").iter().for_each(|(two, value)| assert_eq!(*value, entry["d2"][two][one], "{name} {one} {two}"));
        }
    }
    // E_before = ½ m v²: the second derivative by the speed is m, the mixed one by mass and speed is v.
    let before = &document["of"]["energy.before"]["d2"];
    let close = |value: &Value, want: f64| assert!((value.as_f64().expect("a number") - want).abs() < 1e-12 * want, "{value} {want}");
    close(&before["vehicle.1.speed"]["vehicle.1.speed"], 1200.0);
    close(&before["vehicle.1.mass"]["vehicle.1.speed"], 12.0);
    // The second derivative of the crush energy with respect to its own d0: 2 K₁ = w.
    close(&document["of"]["vehicle.2.crush_energy"]["d2"]["vehicle.2.crush.d0"]["vehicle.2.crush.d0"], 1.5);
}

#[test]
fn the_text_fits_and_is_sorted() {
    for path in examples() {
        for arguments in [&[][..], &["--units", "si"], &["--units", "us", "--second"], &["--of", "all", "--wrt", "all", "--second"]] {
            let file = path.to_str().expect("a plain path");
            let run = run(&workspace(), &[&["gradient", file], arguments].concat());
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{file} {arguments:?}");
            for line in run.out.lines() {
                assert!(line.chars().count() <= 80 && line.trim_end() == line, "{file} {arguments:?}: {line}");
            }
        }
    }
    let case = workspace().join("cli/examples/position-a.toml");
    let run = run(&workspace(), &["gradient", case.to_str().expect("a plain path"), "--of", "W_n"]);
    // From central differences of `solve`: 1 deg, 1 mph, 0.05, 1 in, 1 %; the largest comes first.
    let cells: Vec<Vec<&str>> = run.out.lines().map(|line| line.split_whitespace().collect()).collect();
    let row = |name: &str| cells.iter().position(|row| row.first() == Some(&name)).unwrap_or_else(|| panic!("{name}\n{}", run.out));
    assert_eq!(cells[row("contact.crush_plane")], ["contact.crush_plane", "0", "deg", "-872.3", "-872", "1", "deg"]);
    assert_eq!(cells[row("vehicle.1.speed")][..3], ["vehicle.1.speed", "40.00", "ft/s"]);
    assert!(row("vehicle.1.speed") < row("contact.crush_plane") && row("contact.crush_plane") < row("contact.restitution"), "{}", run.out);
    assert!(run.out.contains("6 more inputs have smaller changes"), "{}", run.out);
    assert!(!run.out.contains("velocity.x  "), "another way to say a speed is not shown by itself");
}

#[test]
fn second_order_changes_are_those_of_both_inputs_together() {
    let run = run_with_input(&["gradient", "-", "--of", "T_before", "--wrt", "v1,m1", "--second"], MIXED);
    let rows: Vec<Vec<&str>> = run.out.lines().map(|line| line.split_whitespace().collect()).collect();
    // 1 km/h is 0.2778 m/s, and 1 % is 12 kg: ½ m δv² = 46.3 J, v δm δv = 40 J.
    assert!(rows.contains(&vec!["vehicle.1.speed", "itself", "46"]), "{}", run.out);
    assert!(rows.contains(&vec!["vehicle.1.speed", "vehicle.1.mass", "40"]), "{}", run.out);
    assert!(rows.contains(&vec!["vehicle.1.speed", "12.00", "m/s", "14400", "4000", "1", "km/h"]), "{}", run.out);
}

#[test]
fn wide_numbers_still_fit() {
    let heavy = MIXED
        .replace("\"1200 kg\"", "\"123456789 kg\"")
        .replace("yaw_inertia = \"2500 kg m^2\"", "yaw_inertia = \"9.87654321e14 kg m^2\"")
        .replace("\"12 m/s\"", "\"98765 m/s\"");
    for arguments in [&["--wrt", "all"][..], &["--of", "all", "--wrt", "all", "--units", "us", "--second"], &[]] {
        let run = run_with_input(&[&["gradient", "-"], arguments].concat(), &heavy);
        assert_eq!(run.status, 0, "{}", run.err);
        let long: Vec<&str> = run.out.lines().filter(|line| line.chars().count() > 80).collect();
        assert!(long.is_empty(), "{}", long.join("\n"));
    }
}

#[test]
fn crush_without_energy_has_no_derivative_of_its_speed() {
    let flat = MIXED.replace("d0 = \"150 N^0.5\"", "d0 = 0").replace("\"0.3 m\", \"0.2 m\", \"0.1 m\"", "0, 0, 0");
    let document = json(&["--of", "vehicle.2.equivalent_energy_speed,vehicle.2.crush_energy", "--wrt", "vehicle.2.crush.depths.1"], &flat);
    assert_eq!(document["of"]["vehicle.2.equivalent_energy_speed"]["d"]["vehicle.2.crush.depths.1"], Value::Null);
    assert_eq!(document["of"]["vehicle.2.crush_energy"]["d"]["vehicle.2.crush.depths.1"], 0.0);
    let text = run_with_input(&["gradient", "-", "--of", "vehicle.2.equivalent_energy_speed", "--wrt", "vehicle.2.crush.depths.1"], &flat);
    assert!(text.out.contains("none"), "{}", text.out);
}

#[test]
fn every_wrong_name_is_reported() {
    let folder = Folder::new();
    folder.write("case.toml", MIXED.as_bytes());
    folder
        .write("wall.toml", std::fs::read(workspace().join("cli/examples/crabbed-barrier.toml")).expect("the example is there").as_slice());
    let refused = |arguments: &[&str], says: &[&str]| {
        let run: Run = run(folder.path(), &[&["gradient"], arguments].concat());
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}: {}", run.err);
        for words in says {
            assert!(run.err.contains(words), "{arguments:?}: {words}\n{}", run.err);
        }
        assert!(!run.err.contains("panicked") && !run.err.contains("defect"), "{}", run.err);
    };
    refused(
        &["case.toml", "--of", "energy.normal_wrok,W_m,Gamma", "--wrt", "vehicle.1.mas,,contact.friction", "--wrt", "T_L"],
        &[
            "--of energy.normal_wrok: unknown output",
            "did you mean `energy.normal_work`?",
            "--of W_m: the case has no moment impulse",
            "--of Gamma: this is an input, not an output",
            "--wrt vehicle.1.mas: unknown input",
            "did you mean `vehicle.1.mass`?",
            "--wrt: the name of an input is missing",
            "--wrt contact.friction: the case is at the critical impulse ratio",
            "--wrt T_L: this is an output, not an input",
        ],
    );
    // The symbols of the paper.
    refused(&["case.toml", "--of", "μ₀,ΔV1", "--wrt", "Γ"], &["did you mean `mu0`?", "did you mean `dV1`?", "did you mean `Gamma`?"]);
    refused(&["case.toml", "--wrt", "vehicle.1.crush.d0"], &["--wrt vehicle.1.crush.d0: the vehicle has no crush"]);
    refused(&["case.toml", "--of", "vehicle.1.crush_energy"], &["vehicle 1 has no crush"]);
    refused(&["case.toml", "--wrt", "vehicle.2.crush.depths.4"], &["the crush has 3 depths"]);
    refused(&["case.toml", "--wrt", "k2"], &["gives `yaw_inertia`"]);
    refused(&["case.toml", "--wrt", "M"], &["no moment impulse"]);
    refused(&["wall.toml", "--wrt", "m2,vehicle.2.speed"], &["--wrt m2: vehicle 2 is a fixed barrier", "--wrt vehicle.2.speed: vehicle 2"]);
    refused(&["case.toml", "--of", "\u{1b}[31m"], &["unknown output"]);
    refused(&["case.toml", "--of"], &["a value is required for '--of"]);
    refused(&["case.toml", "--format", "csv"], &["invalid value 'csv'"]);
    refused(&["none.toml"], &["no such file"]);
    refused(&[], &["<CASE>"]);
}

#[test]
fn what_solve_refuses_is_refused_in_the_same_words() {
    let folder = Folder::new();
    for (old, new, status) in [
        ("speed = \"12 m/s\"", "speed = \"-30 m/s\"", 3),
        ("mass = \"1200 kg\"", "mass = \"1200 ft\"", 2),
        ("restitution = 0.2", "restitution = 0.2\nimpulse_ratio = 5", 3),
    ] {
        folder.write("case.toml", MIXED.replacen(old, new, 1).as_bytes());
        let (gradient, solved) = (run(folder.path(), &["gradient", "case.toml"]), run(folder.path(), &["solve", "case.toml"]));
        assert_eq!((gradient.status, gradient.out.as_str(), &gradient.err), (status, "", &solved.err), "{new}");
    }
}

#[test]
fn more_derivatives_than_a_file_deserves_are_refused() {
    let depths = vec!["0.1"; 20_000].join(", ");
    let case = MIXED.replace("\"0.3 m\", \"0.2 m\", \"0.1 m\"", &depths);
    let run = run_with_input(&["gradient", "-", "--format", "json"], &case);
    assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
    assert!(run.err.contains("name the inputs that matter"), "{}", run.err);
    assert_eq!(run_with_input(&["gradient", "-", "--of", "T_L", "--wrt", "e,vehicle.2.crush.depths.777", "--second"], &case).status, 0);
}

/// At the friction at which sliding just ends, rounding decides which side the derivatives are of: the warning says which.
#[test]
fn a_corner_says_whose_derivatives_it_has() {
    for (friction, these) in [("0.26154548292584767", "less"), ("0.2615454829258477", "more"), ("0.2615454829258476", "less")] {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 3.141592653589793\nspeed = 18\nimpact_center = [1.9, -0.3]\n\
             [[vehicle]]\nmass = 1900\nyaw_inertia = 3300\nheading = 1.8325957145940461\nspeed = 11\nimpact_center = [1.4, -0.8]\n\
             [contact]\ncrush_plane = 0.17\nrestitution = 0.1\nfriction = {friction}\n"
        );
        let run = run_with_input(&["gradient", "-", "--of", "T_L", "--wrt", "contact.friction", "--format", "json"], &case);
        let found: Value = serde_json::from_str(&run.out).expect("JSON");
        let by_friction = found.to_string();
        assert!(by_friction.contains(&format!("these are the derivatives for {these} friction")), "{friction}: {by_friction}");
        // With more friction the vehicles stick, and it has no effect.
        let text = run_with_input(&["gradient", "-", "--of", "T_L", "--wrt", "contact.friction"], &case).out;
        assert_eq!(text.contains("1256"), these == "less", "{text}");
    }
}

/// Without friction nothing sticks, on either side of a collision that is symmetric: the derivatives are those of the same collision half a turn away, where rounding
/// breaks the symmetry.
#[test]
fn a_symmetric_collision_without_friction_has_no_corner() {
    let of = |turn: f64, friction: f64| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"{turn} deg\"\nspeed = 15\nimpact_center = [2, 0]\n\
             [[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = \"{turn} deg\"\nrestitution = 0.1\nfriction = {friction}\n"
        );
        let answer = json(&["--of", "Omega1,P_t", "--wrt", "Gamma,theta1,vehicle.1.impact_center.left,omega1,contact.friction"], &case);
        let slopes = |of: &str| -> Vec<f64> {
            let d = answer["of"][of]["d"].as_object().expect("derivatives");
            d.values().map(|slope| slope.as_f64().expect("a number")).collect()
        };
        let warned = answer["messages"].as_array().into_iter().flatten().any(|message| message["code"] == "corner");
        (slopes("vehicle.1.yaw_rate"), slopes("contact.impulse.tangential"), warned)
    };
    let (yaw, tangential, warned) = of(0.0, 0.0);
    // By Γ, the friction, θ, l and the yaw rate: a normal impulse 1.1 m v at an arm of 2 sin(Γ − θ) and l: 2 · 1.1 m v/I = 19.8 per rad, and half of it per meter, less what the yaw rate takes with l.
    for (slope, wanted) in yaw.iter().zip([-19.8, 0.0, 19.8, 9.9, 1.0]) {
        assert!((slope - wanted).abs() < 1e-12, "{yaw:?}");
    }
    assert!(tangential.iter().all(|slope| *slope == 0.0) && !warned, "{tangential:?}");
    assert_ne!(of(0.0, 0.1).0, yaw, "with friction it sticks");
}
