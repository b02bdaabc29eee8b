//! Guaranteed bounds of what follows from crush, from CRASH3 and from skids: closed forms at the corners of the box.

use serde_json::{Value, json};

use super::{close, document, number};
use crate::process::run_with_input;

/// A car of 1500 kg against a barrier head on, with a triangular crush over 1.5 m, whose force acts straight at its front.
fn crushed(depth: Value, slope: Value, mass: Value) -> Value {
    let crush = json!({ "width": 1.5, "depths": [0, depth, 0], "stiffness": { "d0": 0, "d1": slope } });
    let car = json!({ "mass": mass, "yaw_inertia": 2500, "heading": 0, "speed": 10, "impact_center": [2, 0], "crush": crush });
    json!({ "schema": 1, "vehicle": [car, { "barrier": true }], "contact": { "crush_plane": 0, "restitution": 0 } })
}

fn bounds(case: &Value, of: &[&str]) -> Vec<Value> {
    let found = document("uncertainty", case, &["--of", &of.join(","), "--method", "bounds"]);
    let outputs = found["of"].as_object().expect("outputs");
    of.iter().map(|of| outputs[*of]["bounds"].clone()).collect()
}

fn ends(bounds: &Value) -> [f64; 2] {
    assert_eq!((&bounds["is_tight"], &bounds["is_whole"]), (&json!(true), &json!(true)), "{bounds}");
    ["low", "high"].map(|key| number(&bounds[key]))
}

#[test]
fn they_are_the_closed_forms_at_the_corners() {
    let range = |min: f64, max: f64| json!({ "min": min, "max": max });
    let case = crushed(range(0.2, 0.4), range(600.0, 800.0), range(1400.0, 1600.0));
    let outputs = ["crush_energy", "equivalent_energy_speed", "mean_depth", "crash3.corrected_energy", "crash3.delta_v_magnitude"];
    let names = outputs.map(|name| format!("vehicle.1.{name}"));
    let found = bounds(&case, &names.each_ref().map(String::as_str));
    // Two linear ramps from 0 to C over w: ½ d1² ∫ C² = d1² w C²/6, ½ C on average.
    let energy = |d1: f64, depth: f64| d1 * d1 * 1.5 * depth * depth / 6.0;
    let (least, greatest) = (energy(600.0, 0.2), energy(800.0, 0.4));
    let speed = |energy: f64, mass: f64| (2.0 * energy / mass).sqrt();
    let expected = [
        [least, greatest],
        [speed(least, 1600.0), speed(greatest, 1400.0)],
        [0.1, 0.2],
        [least, greatest],
        [speed(least, 1600.0), speed(greatest, 1400.0)],
    ];
    for ((found, expected), name) in found.iter().zip(expected).zip(names) {
        let [low, high] = ends(found);
        assert!(low <= expected[0] * (1.0 + 1e-15) && expected[1] * (1.0 - 1e-15) <= high, "{name}: {found}");
        close(low, expected[0], 2e-9 * expected[1], &name);
        close(high, expected[1], 2e-9 * expected[1], &name);
    }
    assert_eq!(found[0]["at_high"]["vehicle.1.crush.depths.2"], json!(0.4));
    assert_eq!(found[1]["at_low"]["vehicle.1.mass"], json!(1600.0));
}

#[test]
fn a_depth_below_zero_is_refused_and_not_part_of_the_range() {
    let case = crushed(json!("0.2 m ± 0.1 m"), json!(600), json!(1500));
    let found = &bounds(&case, &["vehicle.1.mean_depth"])[0];
    assert_eq!(found["is_whole"], json!(false), "{found}");
    close(number(&found["low"]), 0.0, 1e-8, "no depth is below zero");
    close(number(&found["high"]), 0.25, 1e-8, "at three deviations");
    // Stations in any order within their limits: what is out of order is refused.
    let mut case = crushed(json!(0.3), json!(600), json!(1500));
    case["vehicle"][0]["crush"].as_object_mut().expect("a crush").remove("width");
    case["vehicle"][0]["crush"]["stations"] = json!([0, { "min": 0.5, "max": 1.75 }, 1.5]);
    let found = &bounds(&case, &["vehicle.1.crush_energy"])[0];
    assert_eq!(found["is_whole"], json!(false), "{found}");
    // Depths read from a line that may lie before the surface.
    let mut case = crushed(json!(0.3), json!(600), json!(1500));
    case["vehicle"][0]["crush"]["depths"] = json!([0.1, 0.3, 0.1]);
    for (greatest, is_whole) in [(0.15, false), (0.05, true)] {
        case["vehicle"][0]["crush"]["measured"] = json!({ "offset": { "min": -0.05, "max": greatest }, "angle": 0 });
        let found = &bounds(&case, &["vehicle.1.mean_depth"])[0];
        assert_eq!(found["is_whole"], json!(is_whole), "{found}");
    }
}

#[test]
fn the_direction_of_a_force_from_behind_is_not_cut() {
    let mut case = crushed(json!(0.3), json!(600), json!(1500));
    case["vehicle"][0]["crush"]["pdof"] = json!({ "min": 3.1, "max": 3.3 });
    case["vehicle"][0]["crush"]["surface"] = json!("rear");
    let [low, high] = ends(&bounds(&case, &["vehicle.1.crash3.pdof"])[0]);
    close(high - low, 0.2, 1e-8, "its range");
    // 1 + tan² 0.1 at the ends of it that is farther from straight behind.
    let [low, high] = ends(&bounds(&case, &["vehicle.1.crash3.correction"])[0]);
    close(low, 1.0, 1e-8, "straight from behind");
    close(high, 1.0 + (3.3 - std::f64::consts::PI).tan().powi(2), 1e-8, "at an angle");
}

#[test]
fn a_surface_that_is_left_open_is_asked_for() {
    let mut case = crushed(json!(0.3), json!(600), json!(1500));
    case["contact"]["crush_plane"] = json!({ "min": 0.6, "max": 0.9 });
    case["contact"]["impulse_ratio"] = json!(0);
    let run = run_with_input(&["uncertainty", "-", "--of", "vehicle.1.crash3.correction", "--method", "bounds"], &case.to_string());
    let page = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("which surface of vehicle 1 is crushed; give vehicle.1.crush.surface"), "{}{}", run.out, run.err);
    case["vehicle"][0]["crush"]["surface"] = json!("front");
    ends(&bounds(&case, &["vehicle.1.crash3.correction"])[0]);
}

#[test]
fn skids_that_may_not_slow_are_not_part_of_the_range() {
    let mut case = crushed(json!(0.3), json!(600), json!(1500));
    let mut skid = |friction: Value, grade: Value| {
        case["before"] = json!({ "vehicle": { "1": { "skid": [{ "length": 20, "friction": friction, "grade": grade }] } } });
        bounds(&case, &["before.vehicle.1.braking_speed"])[0].clone()
    };
    let speed = |drag: f64| (100.0 + 2.0 * 9.806_65 * drag * 20.0).sqrt();
    let [low, high] = ends(&skid(json!({ "min": 0.6, "max": 0.8 }), json!(0)));
    close(low, speed(0.6), 1e-7, "with less friction");
    close(high, speed(0.8), 1e-7, "with more friction");
    let found = skid(json!({ "min": 0.0, "max": 0.8 }), json!(-0.1));
    assert_eq!(found["is_whole"], json!(false), "{found}");
}
