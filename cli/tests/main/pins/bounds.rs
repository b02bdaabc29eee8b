//! Guaranteed bounds, and limits of shares, of a vehicle that meets a barrier head on: ΔV = (1 + e) v and T_L = ½ m (1 − e²) v².

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::{close, document, number};
use crate::process::run_with_input;

fn head_on(speed: &Value, restitution: &Value) -> Value {
    let car = json!({ "mass": 1500, "yaw_inertia": 2500, "heading": 0, "speed": speed, "impact_center": [2, 0] });
    json!({ "schema": 1, "vehicle": [car, { "barrier": true }], "contact": { "crush_plane": 0, "restitution": restitution } })
}

fn bounds(case: &Value, of: &str, arguments: &[&str]) -> Value {
    let found = document("uncertainty", case, &[&["--of", of, "--method", "bounds"], arguments].concat());
    found["of"].as_object().expect("outputs").values().next().expect("an output")["bounds"].clone()
}

#[test]
fn bounds_are_the_extremes_and_say_where_they_are() {
    let case = head_on(&json!({ "min": 10, "max": 20 }), &json!({ "min": 0, "max": 0.3 }));
    for (of, low, high, e_high) in [("dV1", 10.0, 26.0, 0.3), ("T_L", 750.0 * 0.91 * 100.0, 750.0 * 400.0, 0.0)] {
        let found = bounds(&case, of, &[]);
        let [lowest, low_attained, high_attained, highest] =
            ["low", "low_attained", "high_attained", "high"].map(|key| number(&found[key]));
        assert!(
            lowest <= low && low <= low_attained * (1.0 + 1e-15) && high_attained * (1.0 - 1e-15) <= high && high <= highest,
            "{found}"
        );
        close(lowest, low, 1e-9 * high, of);
        close(highest, high, 1e-9 * high, of);
        assert_eq!((&found["is_tight"], &found["is_whole"]), (&json!(true), &json!(true)));
        let e_low = if of == "dV1" { 0.0 } else { 0.3 };
        assert_eq!(found["at_low"], json!({ "vehicle.1.speed": 10.0, "contact.restitution": e_low }), "{of}");
        assert_eq!(found["at_high"], json!({ "vehicle.1.speed": 20.0, "contact.restitution": e_high }), "{of}");
    }
}

#[test]
fn inputs_without_limits_end_at_deviations_and_refused_values_are_said() {
    let normal = head_on(&json!("15 m/s ± 1 m/s"), &json!(0.1));
    for (arguments, low, high) in [(&[][..], 12.0, 18.0), (&["--bounds-sd", "2"], 13.0, 17.0)] {
        let found = bounds(&normal, "dV1", arguments);
        close(number(&found["low"]), 1.1 * low, 1e-8, "low");
        close(number(&found["high"]), 1.1 * high, 1e-8, "high");
    }
    // Backwards it leaves the barrier.
    let found = bounds(&head_on(&json!({ "min": -5, "max": 10 }), &json!(0.1)), "dV1", &[]);
    close(number(&found["high"]), 11.0, 1e-8, "high");
    assert!(number(&found["low"]) <= number(&found["low_attained"]) && found["is_whole"] == false, "{found}");
}

#[test]
fn the_page_and_the_table_have_the_range() {
    let case = head_on(&json!({ "min": 10, "max": 20 }), &json!({ "min": 0, "max": 0.3 })).to_string();
    let print = |format: &str| {
        let run = run_with_input(&["uncertainty", "-", "--of", "dV1", "--method", "bounds", "--format", format, "--units", "si"], &case);
        run.succeeds(&format);
        run.out
    };
    let page = print("text").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("it is from 10.000 m/s to 26.000 m/s, guaranteed; both ends are attained."), "{page}");
    let table = print("csv");
    for (figure, value) in [("low", 10.0), ("high", 26.0), ("low attained", 10.0), ("high attained", 26.0)] {
        let line =
            table.lines().find(|line| line.contains(&format!(",m/s,bounds,{figure},"))).unwrap_or_else(|| panic!("{figure}: {table}"));
        close(line.split(',').nth(4).expect("a value").parse().expect("a number"), value, 1e-7, figure);
    }
    // What physics refuses is not part of the range.
    let part = head_on(&json!({ "min": -5, "max": 10 }), &json!(0.1)).to_string();
    let run = run_with_input(&["uncertainty", "-", "--of", "dV1", "--method", "bounds"], &part);
    assert!(run.out.split_whitespace().collect::<Vec<_>>().join(" ").contains("where physics accepts the collision"), "{}", run.out);
}

#[test]
fn a_total_share_is_at_most_that_of_its_slope() {
    let case = head_on(&json!("15 m/s ± 1 m/s"), &json!({ "min": 0, "max": 0.2 }));
    let found = document("uncertainty", &case, &["--of", "dV1", "--method", "sobol"]);
    let shares = &found["of"]["vehicle.1.delta_v_magnitude"]["sobol"];
    let of_e = 0.04 / 12.0;
    let variance = 1.21 + of_e * (225.0 + 1.0);
    let wanted = [("vehicle.1.speed", 1.21 + of_e), ("contact.restitution", 226.0 * 0.04 / (PI * PI))];
    for (name, part) in wanted {
        close(number(&shares[name]["total_at_most"]), part / variance, 0.03, name);
        assert!(number(&shares[name]["total"]) <= number(&shares[name]["total_at_most"]) + 4.0 * number(&shares[name]["total_se"]));
    }
    // A log-normal number has no such limit.
    let case = head_on(&json!({ "median": 15, "factor": 1.1 }), &json!({ "min": 0, "max": 0.2 }));
    let found = document("uncertainty", &case, &["--of", "dV1", "--method", "sobol"]);
    assert_eq!(found["of"]["vehicle.1.delta_v_magnitude"]["sobol"]["vehicle.1.speed"]["total_at_most"], Value::Null);
}
