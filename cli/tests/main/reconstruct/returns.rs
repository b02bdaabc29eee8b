//! Reconstructing a collision that was computed forward recovers it.

use serde_json::Value;

use super::{answer, example, number, replaced, text};
use crate::process::{run, workspace};

#[test]
fn position_a_returns_from_its_own_results() {
    let (found, status) = answer(&example("position-a.toml"));
    assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")));
    for name in ["vehicle.1.speed", "vehicle.2.speed"] {
        // 40 ft/s, the speed of the forward example.
        assert!((number(&found["unknown"][name]["value"]) - 12.192).abs() < 1e-9, "{found}");
    }
    assert!(number(&found["chi_square"]) < 1e-15 && found["degrees_of_freedom"] == 3);
    let forward = run(&workspace(), &["solve", "cli/examples/position-a.toml", "--format", "json"]);
    let forward: Value = serde_json::from_str(&forward.out).expect("JSON");
    for (key, scale) in [("normal_work", 4e4), ("tangential_work", 4e4), ("loss", 4e4)] {
        let off = number(&found["solution"]["energy"][key]) - number(&forward["energy"][key]);
        assert!(off.abs() < 1e-9 * scale, "{key}: {off}");
    }
}

#[test]
fn rest_tells_how_the_vehicles_separated_and_how_sure_that_is() {
    let (found, status) = answer(&example("two-cars.toml"));
    assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")));
    // The values that the example was computed from, and the separation velocities that lead to its rest positions.
    for (name, truth) in [
        ("vehicle.1.speed", 52.0 / 3.6),
        ("vehicle.2.speed", 41.0 / 3.6),
        ("contact.restitution", 0.08),
        ("contact.crush_plane", -8_f64.to_radians()),
    ] {
        let (value, sd) = (number(&found["unknown"][name]["value"]), number(&found["unknown"][name]["sd"]));
        assert!((value - truth).abs() < 2.0 * sd, "{name}: {value} ± {sd} for {truth}");
    }
    let evidence = &found["evidence"];
    for (name, truth) in [
        ("vehicle.1.separation_velocity.x", 6.43),
        ("vehicle.1.separation_velocity.y", 5.58),
        ("vehicle.1.separation_yaw_rate", 167.3_f64.to_radians()),
        ("vehicle.2.separation_velocity.x", 3.89),
        ("vehicle.2.separation_velocity.y", 6.09),
        ("vehicle.2.separation_yaw_rate", -221.8_f64.to_radians()),
    ] {
        let (given, sd) = (number(&evidence[name]["given"]), number(&evidence[name]["sd"]));
        assert!((given - truth).abs() < 2.0 * sd, "{name}: {given} ± {sd} for {truth}");
    }
    // Their errors are correlated, mainly by the friction, so their squares do not simply add up.
    let squares: f64 = evidence.as_object().expect("a table").values().map(|piece| number(&piece["standardised_residual"]).powi(2)).sum();
    assert!((squares - number(&found["chi_square"])).abs() > 1e-3, "{squares}");
    // As stated in the README of the project.
    let said = text(&example("two-cars.toml"), &[]).out;
    for words in ["52.4     1.4", "41.00    0.28", "vehicle.1: its separation velocity and yaw rate are"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let twice = replaced(&example("two-cars.toml"), &[("[rest]", "vehicle.2.separation_yaw_rate = \"-214 deg/s ± 15 deg/s\"\n[rest]")]);
    let refused = text(&twice, &[]);
    assert!(refused.status == 2 && refused.out.is_empty() && refused.err.contains("separation_yaw_rate twice"), "{}", refused.err);
}

/// Six velocities from six, so that no weight matters: the variance of each is that with an exact friction plus the
/// square of the change caused by one standard deviation of the friction, which acts on both vehicles at once.
#[test]
fn the_friction_moves_both_vehicles_at_once() {
    let case = example("two-cars.toml");
    let (head, rest) = case.split_once("[contact]").expect("it has one");
    let (_, rest) = rest.split_once("[rest]").expect("it has one");
    let (rest, _) = rest.split_once("[unknown]").expect("it has one");
    let names = ["velocity.x", "velocity.y", "yaw_rate"];
    let starts = [["14 m/s", "2.5 m/s", "0 deg/s"], ["-5.5 m/s", "10 m/s", "0 deg/s"]];
    let unknowns: String =
        (0..6).map(|i| format!("vehicle.{}.{} = {{ start = \"{}\" }}\n", i / 3 + 1, names[i % 3], starts[i / 3][i % 3])).collect();
    let contact = "[contact]\ncrush_plane = \"-8 deg\"\nrestitution = 0.3\nimpulse_ratio = { of_critical = 0.8 }\n";
    let case = format!("{head}{contact}\n[rest]{rest}[unknown]\n{unknowns}");
    let with = |friction: &str| answer(&replaced(&case, &[("\"0.7 ± 0.05\"", friction)])).0;
    let (given, certain) = (with("\"0.7 ± 0.05\""), with("0.7"));
    let (more, less) = (with("0.701"), with("0.699"));
    for i in 0..6 {
        let name = format!("vehicle.{}.{}", i / 3 + 1, names[i % 3]);
        let of = |found: &Value, key: &str| number(&found["unknown"][&name][key]);
        let by_friction = (of(&more, "value") - of(&less, "value")) / 0.002 * 0.05;
        let by_hand = of(&certain, "sd").hypot(by_friction);
        assert!((of(&given, "sd") / by_hand - 1.0).abs() < 1e-3, "{name}: {} and {by_hand}, {by_friction}", of(&given, "sd"));
        assert!(by_hand > 1.001 * of(&certain, "sd"), "{name}: the friction counts");
    }
}
