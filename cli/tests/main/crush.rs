//! The verbs `crush` and `crash3`, and their results within `solve`, `gradient` and `sweep`.

use std::f64::consts::TAU;
use std::path::Path;

use serde_json::Value;

use crate::process::{Run, run, run_with_input, workspace};

/// Relative tolerance of a number; absolute for angles, lengths and velocities below 1.
const TOLERANCE: f64 = 1e-12;

fn json(run: &Run) -> Value {
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

fn example(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/examples").join(name)).expect("the example can be read")
}

/// Collects the differences from the expected values. Extra values in `got` are ignored.
fn compare(got: &Value, want: &Value, path: &str, faults: &mut Vec<String>) {
    match want {
        Value::Object(entries) => entries.iter().for_each(|(key, want)| compare(&got[key], want, &format!("{path}.{key}"), faults)),
        Value::Array(items) => {
            if got.as_array().map(Vec::len) != Some(items.len()) {
                faults.push(format!("{path} has not {} items: {got}", items.len()));
            }
            items.iter().enumerate().for_each(|(i, want)| compare(&got[i], want, &format!("{path}.{i}"), faults));
        }
        // A barrier, or a vehicle without crush, which other tests check.
        Value::Null => (),
        Value::String(text) => match text.parse::<f64>() {
            Err(_) if got == want => (),
            Err(_) => faults.push(format!("{path} is {got}, not {text}")),
            Ok(want) => {
                let off = got.as_f64().map_or(f64::INFINITY, |got| difference(path, got, want));
                if off.is_nan() || off > TOLERANCE {
                    faults.push(format!("{path} is {got}, not {want}: off by {off:.1e}"));
                }
            }
        },
        _ => faults.push(format!("{path} wants {want}")),
    }
}

fn difference(path: &str, got: f64, want: f64) -> f64 {
    let difference = (got - want).abs();
    if path.ends_with(".pdof") {
        difference.min((difference - TAU).abs())
    } else if path.contains("delta_v.") || path.contains("velocity") || path.ends_with("moment_arm") {
        // Components of velocities of some tens of meters per second, or of a moment arm of about a meter.
        difference / want.abs().max(if path.ends_with("moment_arm") { 1.0 } else { 30.0 })
    } else if difference == 0.0 {
        0.0
    } else {
        difference / want.abs()
    }
}

#[test]
fn every_case_of_the_independent_computation() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/crush.jsonl");
    let text = std::fs::read_to_string(path).expect("the cases can be read");
    let mut faults = Vec::new();
    for line in text.lines() {
        let reference: Value = serde_json::from_str(line).expect("each line is JSON");
        let case = reference["case"].to_string();
        let crush = json(&run_with_input(&["crush", "-", "--format", "json"], &case));
        let crash3 = json(&run_with_input(&["crash3", "-", "--format", "json"], &case));
        let title = reference["case"]["title"].as_str().expect("a title");
        compare(&crush["vehicles"], &reference["crush"], &format!("{title}: crush"), &mut faults);
        compare(&crash3, &reference["crash3"], &format!("{title}: crash3"), &mut faults);
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
    let count = |words: &str| text.matches(words).count();
    assert_eq!(text.lines().count(), 120);
    for (words, least) in
        [("\"zones\"", 30), ("saturation", 25), ("measured", 30), ("stations", 60), ("\"correction\": \"2.0\"", 20), ("barrier", 20)]
    {
        assert!(count(words) >= least, "{words}: {}", count(words));
    }
}

#[test]
fn the_comparison_notices() {
    let value = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    let want = value(r#"{"vehicles": [{"surface": "front", "K": ["1", "2"], "pdof": "3.141592653589793"}, null]}"#);
    let faults = |got: &str| {
        let mut faults = Vec::new();
        compare(&value(got), &want, "", &mut faults);
        faults.len()
    };
    assert_eq!(faults(r#"{"vehicles": [{"surface": "front", "K": [1, 2.0000000000001], "pdof": -3.141592653589793}, {}]}"#), 0);
    assert_eq!(faults(r#"{"vehicles": [{"surface": "rear", "K": [1, 2.00000000001], "pdof": 3.14}, {}]}"#), 3);
    assert_eq!(faults(r#"{"vehicles": [{"surface": "front", "K": [1], "pdof": null}, {}]}"#), 3);
    assert_eq!(faults(r#"{"vehicles": []}"#), 6);
}

#[test]
fn the_second_crabbed_test_of_table_b2() {
    const FOOT_POUND: f64 = 1.355_817_948_331_4;
    let crash3 = json(&run_with_input(&["crash3", "-", "--format", "json"], &example("cavalier-crush.toml")));
    let car = &crash3["vehicles"][0];
    let number = |value: &Value| value.as_f64().expect("a number");
    // Printed: T_Ln 44215 and T_L 47524 ft lb, and 51334 for planar mechanics, from a mean depth of four digits,
    // whose rounding causes 9 and 10 ft lb.
    assert!((number(&car["crush_energy"]) / FOOT_POUND - 44_215.0).abs() < 10.0);
    assert!((number(&car["corrected_energy"]) / FOOT_POUND - 47_524.0).abs() < 10.0);
    assert!((number(&crash3["planar"]["planar"]["loss"]) / FOOT_POUND - 51_334.0).abs() < 12.0);
    // Printed: 34.5 ft/s for planar mechanics.
    assert!((number(&crash3["planar"]["planar"]["delta_v_magnitude"][0]) / 0.3048 - 34.5).abs() < 0.05);
    let barrier = &crash3["vehicles"][1];
    for key in ["crush_energy", "pdof", "correction", "corrected_energy", "effective_mass_factor", "delta_v_magnitude"] {
        assert_eq!(barrier[key], 0.0, "{key}");
    }
    let crush = json(&run_with_input(&["crush", "-", "--format", "json"], &example("cavalier-crush.toml")));
    for key in ["mean_depth", "d0", "d1", "A", "B", "crush_energy", "equivalent_energy_speed"] {
        assert_eq!(crush["vehicles"][1][key], 0.0, "{key}");
    }
    assert_eq!(crush["vehicles"][1]["K"], serde_json::json!([0.0, 0.0, 0.0]));
}

/// CRASH3 knows no moment impulse, and planar mechanics with one is another collision: they are not compared.
#[test]
fn a_moment_impulse_is_not_compared() {
    let with_moment = example("cavalier-crush.toml") + "\nmoment = \"100 N m s\"\n";
    let run = run_with_input(&["crash3", "-"], &with_moment);
    assert!(run.status == 0 && run.out.contains("CRASH3 has no moment impulse"), "{} {}", run.out, run.err);
    assert!(!run_with_input(&["crash3", "-"], &example("cavalier-crush.toml")).out.contains("moment impulse"));
}

#[test]
fn the_texts_fit_a_terminal() {
    for name in ["cavalier-crush.toml", "stiff-corner.toml", "oblique-surfaces.toml"] {
        for verb in ["crush", "crash3"] {
            for units in ["si", "us"] {
                let run = run_with_input(&[verb, "-", "--units", units], &example(name));
                assert_eq!((run.status, run.err.as_str()), (0, ""), "{verb} {name}");
                for line in run.out.lines() {
                    assert!(line.chars().count() <= 80 && line.trim_end() == line, "{verb} {name}: {line}");
                }
            }
        }
    }
}

#[test]
fn what_crash3_says_has_derivatives_by_name() {
    let case = example("stiff-corner.toml");
    let of = "vehicle.1.crash3.delta_v_magnitude,vehicle.1.crush_energy";
    let by = [
        "vehicle.1.crush.zones.2.d1",
        "vehicle.1.crush.zones.1.to",
        "vehicle.1.crush.depths.3",
        "vehicle.1.crush.stations.2",
        "vehicle.1.crush.measured.offset",
        "vehicle.1.crush.measured.angle",
        "vehicle.2.crush.d1",
        "vehicle.2.crush.width",
        "vehicle.2.mass",
        "contact.crush_plane",
    ];
    let wrt = by.join(",");
    let gradient = json(&run_with_input(&["gradient", "-", "--format", "json", "--of", of, "--wrt", &wrt], &case));
    for name in by {
        // A difference quotient from a sweep of three points around the value.
        let value = gradient["wrt"][name].as_f64().expect("a value");
        let step = 1e-4 * value.abs().max(0.1);
        let unit = if name.ends_with("d1") { " N^0.5/m" } else { "" };
        let vary = format!("{name}={}{unit}:{}{unit}:{step}{unit}", value - step, value + step);
        let sweep = json(&run_with_input(&["sweep", "-", "--vary", &vary, "--of", of, "--format", "json"], &case));
        for output in of.split(',') {
            let values = sweep["of"][output].as_array().expect("values");
            assert_eq!(values.len(), 3, "{vary}");
            let at = |i: usize| values[i].as_f64().unwrap_or_else(|| panic!("{vary}: {sweep}"));
            let (quotient, exact) = ((at(2) - at(0)) / (2.0 * step), gradient["of"][output]["d"][name].as_f64().expect("a derivative"));
            let size = gradient["of"][output]["value"].as_f64().expect("a value") / value.abs().max(0.1);
            assert!((quotient - exact).abs() <= 1e-6 * (exact.abs() + size), "{output} by {name}: {quotient} {exact}");
        }
    }
    let nothing = run_with_input(&["gradient", "-", "--wrt", "vehicle.1.crush.d0"], &case);
    assert_eq!(nothing.status, 2);
    assert!(nothing.err.contains("the crush has 2 zones"), "{}", nothing.err);
}

#[test]
fn a_sweep_says_where_there_is_no_crush() {
    let case = example("stiff-corner.toml");
    let sweep =
        |vary: &str| json(&run_with_input(&["sweep", "-", "--vary", vary, "--of", "vehicle.1.crush_energy", "--format", "json"], &case));
    for (vary, words) in [
        ("vehicle.1.crush.stations.2=-0.5 m:0.7 m:0.4 m", "station 3 is 0.2 m after"),
        ("vehicle.1.crush.measured.offset=0 m:0.2 m:0.05 m", "it must be at least 0 m"),
    ] {
        let document = sweep(vary);
        let energies = document["of"]["vehicle.1.crush_energy"].as_array().expect("energies");
        let reasons = document["refused"].as_array().expect("reasons");
        assert!(energies[0].is_f64() && reasons[0].is_null(), "{document}");
        let last = energies.len() - 1;
        assert!(energies[last].is_null() && reasons[last].as_str().is_some_and(|reason| reason.contains(words)), "{document}");
    }
    let third = case.replace("{ to = \"40 cm\"", "{ to = \"10 cm\", d0 = 90, d1 = 900 },\n  { to = \"40 cm\"");
    let vary =
        ["sweep", "-", "--vary", "vehicle.1.crush.zones.1.to=0.1 m:0.5 m:0.2 m", "--of", "vehicle.1.crush_energy", "--format", "json"];
    let reasons = json(&run_with_input(&vary, &third))["refused"].clone();
    assert!(reasons[1].is_null() && reasons[2].as_str().is_some_and(|reason| reason.contains("a zone ends at 0.4 m")), "{reasons}");
}

#[test]
fn speeds_of_no_energy_have_no_derivatives_by_what_it_is_made_of() {
    let case = example("cavalier-crush.toml").replace("\"0.5203 ft\", \"0.5203 ft\"", "0, 0").replace("48.27", "0");
    let of = "vehicle.1.crash3.delta_v_magnitude,vehicle.1.equivalent_energy_speed,vehicle.1.crush_energy";
    let wrt = "vehicle.1.crush.d0,vehicle.1.crush.depths.1,vehicle.1.mass";
    let gradient = json(&run_with_input(&["gradient", "-", "--of", of, "--wrt", wrt, "--format", "json"], &case));
    for output in of.split(',').take(2) {
        let d = &gradient["of"][output]["d"];
        let expected = serde_json::json!({ "vehicle.1.crush.d0": null, "vehicle.1.crush.depths.1": null, "vehicle.1.mass": 0.0 });
        assert_eq!((&gradient["of"][output]["value"], d), (&serde_json::json!(0.0), &expected), "{output}");
    }
    assert_eq!(gradient["of"]["vehicle.1.crush_energy"]["d"]["vehicle.1.crush.d0"], 0.0);
    let crash3 = run_with_input(&["crash3", "-"], &case);
    assert!(crash3.status == 0 && !crash3.out.contains("NaN"), "{}", crash3.out);
    let document = json(&run_with_input(&["crash3", "-", "--format", "json"], &case));
    assert_eq!(document["planar"]["together"]["delta_v_magnitude"], serde_json::json!([0.0, 0.0]));
}

/// Half the square of d0 times the width: 60 kN/m over the root of 400 kN/m², and 1.8 m.
#[test]
fn an_energy_without_a_depth_has_a_warning() {
    let crushed = |stiffness: &str| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n[vehicle.crush]\nwidth = \"1.8 m\"\ndepths = [\"0 m\", \"0 m\"]\nstiffness = {{ {stiffness} }}\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n"
        );
        let text = run_with_input(&["crush", "-", "--units", "si"], &case).out;
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let warned = crushed("A = \"60 kN/m\", B = \"400 kN/m^2\"");
    assert!(warned.contains("no depth, and an energy of 8100 J") && warned.contains("stiffness with d0 = 0"), "{warned}");
    let uncrushed = crushed("d0 = \"0 N^0.5\", d1 = \"632 N^0.5/m\"");
    assert!(!uncrushed.contains("no depth"), "{uncrushed}");
}

#[test]
fn forces_that_are_not_opposite_are_noted() {
    let case = example("stiff-corner.toml");
    let notes = |case: &str| json(&run_with_input(&["crash3", "-", "--format", "json"], case))["notes"].to_string();
    assert!(!notes(&case).contains("opposite"));
    let crossed = case.replace("surface = \"front\"", "surface = \"front\"\npdof = \"40 deg\"");
    assert!(notes(&crossed).contains("from being opposite"), "{}", notes(&crossed));
    let elastic = case.replace("restitution = 0.08", "restitution = 1");
    assert!(notes(&elastic).contains("at e = 1"), "{}", notes(&elastic));
}

#[test]
fn what_the_file_gives_is_taken() {
    let case = example("cavalier-crush.toml");
    let with = |keys: &str| {
        let case = case.replace("width = \"5 ft\"", &format!("{keys}\nwidth = \"5 ft\""));
        json(&run_with_input(&["crash3", "-", "--format", "json"], &case))["vehicles"][0].clone()
    };
    let usual = with("");
    assert_eq!(usual["surface"], "front");
    let side = with("surface = \"right\"");
    assert_eq!((side["surface"].as_str(), side["correction"].as_f64()), (Some("right"), Some(2.0)));
    let ahead = with("pdof = \"0 deg\"");
    assert_eq!((ahead["pdof"].as_f64(), ahead["correction"].as_f64(), ahead["moment_arm"].as_f64()), (Some(0.0), Some(1.0), Some(0.0)));
    assert_eq!(ahead["effective_mass_factor"], 1.0);
}

#[test]
fn crash3_goes_back_from_the_separation_velocity_of_the_evidence() {
    let given = |velocity: &str| {
        let case = example("cavalier-crush.toml") + &format!("\n[evidence]\nvehicle.1.separation_velocity = {velocity}\n");
        run_with_input(&["crash3", "-", "--format", "json"], &case)
    };
    let plain = json(&run_with_input(&["crash3", "-", "--format", "json"], &example("cavalier-crush.toml")));
    let delta_v = &plain["vehicles"][0]["delta_v"];
    for velocity in [
        "[\"-2 m/s\", \"1 m/s\"]",
        "[-2, 1]",
        "[\"-2 m/s ± 0.5 m/s\", \"1 m/s +/- 1 m/s\"]",
        "[{ value = \"-2 m/s\", sd = \"0.5 m/s\" }, { value = 1 }]",
    ] {
        let car = json(&given(velocity))["vehicles"][0].clone();
        assert_eq!(&car["delta_v"], delta_v, "{velocity}");
        for (i, separation) in [-2.0, 1.0].into_iter().enumerate() {
            assert_eq!(car["reconstruction"]["separation_velocity"][i], separation, "{velocity}");
            let approach = car["reconstruction"]["approach_velocity"][i].as_f64().expect("a number");
            assert!((approach - (separation - delta_v[i].as_f64().expect("a number"))).abs() < 1e-12, "{velocity}");
        }
    }
    for (velocity, words) in [
        ("\"-2 m/s\"", "an array of two values"),
        ("[\"-2 m/s\"]", "an array of two values"),
        ("[\"-2 m/s ± 1 kg\", 0]", "evidence.vehicle.1.separation_velocity.1"),
        ("[\"-2 m/s ± -1 m/s\", 0]", "below zero"),
        ("[{ sd = 1 }, 0]", "evidence.vehicle.1.separation_velocity.1.value: missing"),
        ("[{ value = 1, sdd = 1 }, 0]", "unknown key"),
    ] {
        let run = given(velocity);
        assert!(run.status == 2 && run.out.is_empty() && run.err.contains(words), "{velocity}: {}", run.err);
    }
}

#[test]
fn a_case_that_does_not_collide_has_crush_and_no_direction_of_force() {
    let case = example("cavalier-crush.toml").replace("\"29.3669 ft/s\"", "\"-29.3669 ft/s\"");
    assert_eq!(run_with_input(&["crush", "-"], &case).status, 0);
    let refused = run_with_input(&["crash3", "-"], &case);
    assert_eq!((refused.status, refused.out.as_str()), (3, ""));
    // If the direction is given, the mechanics is needed only for the comparison.
    let given = case.replace("width = \"5 ft\"", "pdof = \"10 deg\"\nwidth = \"5 ft\"");
    let crash3 = json(&run_with_input(&["crash3", "-", "--format", "json"], &given));
    assert_eq!(crash3["planar"], Value::Null);
    assert_eq!(crash3["vehicles"][0]["reconstruction"], Value::Null);
    assert!(crash3["notes"][0].as_str().is_some_and(|note| note.contains("nothing to compare with")), "{}", crash3["notes"]);
}

#[test]
fn inertias_that_rounding_decides_are_refused() {
    for (verb, case) in [("solve", "tiny_inertia"), ("gradient", "tiny_inertia"), ("solve", "crash3_nan"), ("crash3", "crash3_nan")] {
        let refused = run(&workspace(), &[verb, &format!("cli/tests/reproducers/{case}.toml")]);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{verb} {case}");
        assert!(
            refused.err.contains("the inputs are ill-conditioned") && refused.err.contains("check each mass, yaw inertia"),
            "{}",
            refused.err
        );
    }
}

/// A head-on impact with a pdof of each vehicle.
const FORCES: &str = r#"schema = 1
[[vehicle]]
mass = "1500 kg"
yaw_inertia = "2000 kg m^2"
heading = "0 deg"
speed = "15 m/s"
impact_center = ["2 m", "0 m"]
[vehicle.crush]
width = "1.5 m"
depths = ["20 cm", "50 cm", "30 cm"]
stiffness = { A = "50 kN/m", B = "500 kN/m^2" }
pdof = "30 deg"
surface = "front"
[[vehicle]]
mass = "1200 kg"
yaw_inertia = "1600 kg m^2"
heading = "180 deg"
speed = "15 m/s"
impact_center = ["2 m", "0 m"]
[vehicle.crush]
width = "1.2 m"
depths = ["10 cm", "10 cm"]
stiffness = { A = "40 kN/m", B = "400 kN/m^2" }
pdof = "-20 deg"
[contact]
crush_plane = "0 deg"
restitution = 0.1
"#;

#[test]
fn the_crush_force_by_hand() {
    let document = json(&run_with_input(&["crush", "-", "--format", "json"], FORCES));
    let [one, two] = [&document["vehicles"][0], &document["vehicles"][1]];
    let is =
        |value: &Value, wanted: f64| assert!((value.as_f64().expect("a number") / wanted - 1.0).abs() < 1e-12, "{value}, not {wanted}");
    // The means of depth and of its square: (0.35 + 0.4)/2 m, and by Simpson's rule, exact for parabolas, (0.13 + 0.49/3)/2 m².
    let (mean, mean_square) = (0.375, (0.13 + 0.49 / 3.0) / 2.0);
    is(&one["form_factor"], mean_square / (mean * mean));
    is(&one["crush_force"], 1.5 * (50e3 + 500e3 * mean));
    is(&one["crush_force_at_pdof"], 1.5 * (50e3 + 500e3 * mean) / 30_f64.to_radians().cos());
    assert_eq!((&one["surface"], &two["surface"]), (&"front".into(), &"front".into()));
    is(&one["pdof"], 30_f64.to_radians());
    is(&two["form_factor"], 1.0);
    is(&two["crush_force"], 1.2 * 80e3);
    is(&two["crush_force_at_pdof"], 1.2 * 80e3 / 20_f64.to_radians().cos());
    let (larger, smaller) = (356_250.0 / 30_f64.to_radians().cos(), 96e3 / 20_f64.to_radians().cos());
    is(&document["force_imbalance"], larger / smaller - 1.0);
    let page = run_with_input(&["crush", "-"], FORCES).out.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = format!("the larger exceeds the smaller by {:.0} %;", 100.0 * (larger / smaller - 1.0));
    assert!(page.contains(&said), "{said} in {page}");
    assert!(document["messages"].as_array().expect("messages").iter().any(|message| message["code"] == "crush-forces-not-balanced"));
    // The same forces, but for the angle of the crush plane of 0, are those of reconstruct's diagnosis.
    let unknown = format!("{}\n[evidence]\ncrush_energy = \"from crush\"\n[unknown]\nvehicle.1.speed = {{ start = \"15 m/s\" }}\n", FORCES);
    let reconstruct: Value = serde_json::from_str(&run_with_input(&["reconstruct", "-", "--format", "json"], &unknown).out).expect("JSON");
    let diagnosis =
        reconstruct["diagnostics"].as_array().expect("diagnostics").iter().find(|finding| finding["name"] == "balance of crush forces");
    is(&diagnosis.expect("a balance")["figure"], larger / smaller - 1.0);
}

#[test]
fn a_force_that_is_not_known_is_null() {
    let vehicle = |case: &str, i: usize| json(&run_with_input(&["crush", "-", "--format", "json"], case))["vehicles"][i].clone();
    let uncrushed = vehicle(&FORCES.replace("\"20 cm\", \"50 cm\", \"30 cm\"", "0, 0"), 0);
    for key in ["form_factor", "crush_force", "crush_force_at_pdof"] {
        assert_eq!(uncrushed[key], Value::Null, "{key}");
    }
    let from_behind = vehicle(&FORCES.replace("pdof = \"30 deg\"", "pdof = \"170 deg\""), 0);
    assert!(from_behind["crush_force"].is_number() && from_behind["crush_force_at_pdof"] == Value::Null, "{from_behind}");
    // Without a pdof it is that of the common-velocity impulse, here central, unless that is not known.
    let without = FORCES.replace("pdof = \"30 deg\"\n", "").replace("surface = \"front\"\n", "");
    let central = vehicle(&without, 0);
    assert!(
        central["pdof"].as_f64().is_some_and(|pdof| pdof.abs() < 1e-12) && central["crush_force"] == central["crush_force_at_pdof"],
        "{central}"
    );
    let unknown = without.replacen("speed = \"15 m/s\"\n", "", 1) + "[unknown]\nvehicle.1.speed = { start = \"15 m/s\" }\n";
    let open = vehicle(&unknown, 0);
    assert!(open["pdof"] == Value::Null && open["crush_force"].is_number() && open["crush_force_at_pdof"] == Value::Null, "{open}");
    // The surface follows from the velocities too, and without it a given pdof says nothing of the force.
    let bare = FORCES.replace("surface = \"front\"\n", "").replacen("speed = \"15 m/s\"\n", "", 1)
        + "[unknown]\nvehicle.1.speed = { start = \"15 m/s\" }\n";
    let open = vehicle(&bare, 0);
    assert!(open["surface"] == Value::Null && open["crush_force_at_pdof"] == Value::Null, "{open}");
    // Beyond a saturation the force grows no more.
    let saturated = vehicle(&FORCES.replace("B = \"500 kN/m^2\" }", "B = \"500 kN/m^2\", saturation = \"0.1 m\" }"), 0);
    assert!((saturated["crush_force"].as_f64().expect("a force") - 1.5 * (50e3 + 500e3 * 0.1)).abs() < 1e-6, "{saturated}");
}

/// 13.2 in and 1.1 ft are one length, which their conversions round to two numbers: a reading that ends on the surface is no crush, and no negative one.
#[test]
fn a_reading_on_the_surface_is_no_crush() {
    let case = |reading: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 0\nspeed = 10\nimpact_center = [1.9, 0]\n[vehicle.crush]\nwidth = \"1.5 m\"\n\
             depths = [\"{reading}\", \"20 in\"]\nmeasured = {{ offset = \"1.1 ft\" }}\nstiffness = {{ A = \"90 kN/m\", B = \"1 MPa\" }}\n\
             [[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n"
        )
    };
    let crushed = |reading: &str| run_with_input(&["crush", "-", "--format", "json"], &case(reading));
    let found = json(&crushed("13.2 in"));
    let mean = found["vehicles"][0]["mean_depth"].as_f64().expect("a depth");
    assert!((mean - (20.0 - 13.2) * 0.0254 / 2.0).abs() < 1e-15, "{mean}");
    assert_eq!(found, json(&crushed("1.1 ft")));
    let outside = crushed("13.1999 in");
    assert!(outside.status == 2 && outside.err.contains("vehicle.1.crush.depths.1"), "{}", outside.err);
}

/// A, B and d0, d1 are two forms of one stiffness: whichever came last would have decided.
#[test]
fn two_forms_of_one_stiffness_exclude_each_other() {
    let case = workspace().join("cli/examples/stiff-corner.toml").display().to_string();
    let (d0, a) = ("vehicle.2.crush.d0=80 N^0.5:90 N^0.5:10 N^0.5", "vehicle.2.crush.A=75 kN/m:90 kN/m:15 kN/m");
    for [one, other] in [[d0, a], [a, d0]] {
        let run = run(&workspace(), &["sweep", &case, "--vary", one, "--vary", other, "--of", "vehicle.2.crush_energy"]);
        assert!(run.status == 2 && run.err.contains("are two names of one input"), "{} {}", run.status, run.err);
    }
    let rows = |headers: &str, cells: &str| {
        let call = ["batch", "-", "--case", &case, "-o", "-", "--of", "vehicle.2.crush_energy"];
        let run = run_with_input(&call, &format!("{headers}\n{cells}\n"));
        let last = run.out.lines().last().unwrap_or_default().to_owned();
        (run.status, last.split(',').skip(2).map(str::to_owned).collect::<Vec<_>>())
    };
    for (headers, cells) in
        [("vehicle.2.crush.d0,vehicle.2.crush.A [kN/m]", "80,90"), ("vehicle.2.crush.A [kN/m],vehicle.2.crush.d0", "90,80")]
    {
        assert_eq!(rows(headers, cells), (1, vec![String::new(), "conflict".to_owned()]), "{headers}");
    }
    // A row may give either.
    let (status, of_a) = rows("vehicle.2.crush.d0,vehicle.2.crush.A [kN/m]", ",90");
    assert!(status == 0 && of_a[0].parse::<f64>().is_ok_and(|energy| energy > 0.0) && of_a[1].is_empty(), "{of_a:?}");
    // Two numbers of one form belong together.
    assert_eq!(rows("vehicle.2.crush.A [kN/m],vehicle.2.crush.B [kPa]", "90,800").0, 0);
    assert_eq!(rows("vehicle.2.crush.d0,vehicle.2.crush.d1", "80,900").0, 0);
}

/// A stiffness that a case file refuses is refused in a row and at a point, and is no infinite energy.
#[test]
fn a_stiffness_beyond_that_of_a_case_file_has_no_energy() {
    let case = workspace().join("cli/examples/stiff-corner.toml").display().to_string();
    let call = ["batch", "-", "--case", &case, "-o", "-", "--of", "vehicle.2.crush_energy"];
    let of_row = run_with_input(&call, "vehicle.2.crush.B [Pa]\n1e-300\n8e5\n");
    let rows: Vec<&str> = of_row.out.lines().skip(1).collect();
    assert!(of_row.status == 1 && rows[0] == "1e-300,,no-crush" && rows[1].ends_with(','), "{rows:?}");
    let vary = "vehicle.2.crush.B=1e-300 Pa:1 Pa:1 Pa";
    let of_point = run(&workspace(), &["sweep", &case, "--vary", vary, "--of", "vehicle.2.crush_energy", "--format", "json"]);
    assert!(of_point.out.contains("it is too large: d0 would be"), "{} {}", of_point.out, of_point.err);
}

/// A force presses on the surface that it damages; one that runs along it or leaves it tells of a wrong surface or sign.
#[test]
fn a_force_that_leaves_its_surface_is_told() {
    let vehicle = |heading: &str, crush: &str| {
        format!(
            "[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"{heading} deg\"\nspeed = 12\nimpact_center = [2, 0.2]\n[vehicle.crush]\nwidth = 1.5\n\
             depths = [0.3, 0.3]\nstiffness = {{ d0 = 100, d1 = 400 }}\n{crush}\n"
        )
    };
    let told = |crush: &str| {
        let case = format!("schema = 1\n{}{}[contact]\ncrush_plane = 0\nrestitution = 0\n", vehicle("0", crush), vehicle("180", ""));
        let run = run_with_input(&["crash3", "-"], &case);
        assert!(run.status <= 1, "{crush}: {}", run.err);
        let said = |run: &Run| run.out.replace("\n    ", " ").contains("vehicle.1: the force does not press on the damaged surface");
        let crush = run_with_input(&["crush", "-"], &case);
        assert_eq!((crush.status, said(&crush)), (0, said(&run)), "{}{}", crush.out, crush.err);
        said(&run)
    };
    for (crush, leaves) in [
        ("pdof = \"40 deg\"\nsurface = \"front\"", false),
        ("pdof = \"89 deg\"\nsurface = \"front\"", false),
        ("pdof = \"90 deg\"\nsurface = \"front\"", true),
        ("pdof = \"120 deg\"\nsurface = \"front\"", true),
        ("pdof = \"46 deg\"\nsurface = \"left\"", true),
        ("pdof = \"46 deg\"\nsurface = \"right\"", false),
    ] {
        assert_eq!(told(crush), leaves, "{crush}");
    }
}
