//! What was run forward comes back.

use serde_json::Value;

use super::{answer, example, number, replaced, text};
use crate::process::{run, workspace};

#[test]
fn position_a_returns_from_its_own_results() {
    let (found, status) = answer(&example("position-a.toml"));
    assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")));
    for name in ["vehicle.1.speed", "vehicle.2.speed"] {
        // 40 ft/s, as the example goes forward.
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
    // What the example was made from, and the motions that lead from there to rest.
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
    // Their errors go together, by the friction above all, so their squares do not simply add up.
    let squares: f64 = evidence.as_object().expect("a table").values().map(|piece| number(&piece["standardised_residual"]).powi(2)).sum();
    assert!((squares - number(&found["chi_square"])).abs() > 1e-3, "{squares}");
    // As the README of the project has it.
    let said = text(&example("two-cars.toml"), &[]).out;
    for words in ["52.5     1.3", "41.01    0.28", "vehicle.1: its separation velocity and yaw rate are those from which it"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let twice = replaced(&example("two-cars.toml"), &[("[rest]", "vehicle.2.separation_yaw_rate = \"-214 deg/s ± 15 deg/s\"\n[rest]")]);
    let refused = text(&twice, &[]);
    assert!(refused.status == 2 && refused.out.is_empty() && refused.err.contains("separation_yaw_rate twice"), "{}", refused.err);
}
