//! A restitution over the closing speed, of a vehicle that meets a barrier head on: the closing speed is v, and ΔV = (1 + e(v)) v.

use serde_json::{Value, json};

use super::{array, close, document, number, object};
use crate::process::{Folder, run, run_with_input};

/// Lines from 0.4 at 4 m/s over 0.2 at 8 m/s to 0.1 at 16 m/s.
fn head_on(speed: &Value, sd: &Value) -> Value {
    let car =
        json!({ "mass": "1500 kg", "yaw_inertia": "2500 kg m^2", "heading": "0 deg", "speed": speed, "impact_center": ["2 m", "0 m"] });
    let curve = json!({ "closing_speed": ["4 m/s", "8 m/s", "16 m/s"], "restitution": [0.4, 0.2, 0.1], "sd": sd });
    json!({ "schema": 1, "vehicle": [car, { "barrier": true }], "contact": { "crush_plane": "0 deg", "restitution": curve } })
}

fn first(of: &Value) -> &Value {
    object(of).values().next().expect("an output")
}

/// The codes of the messages of an answer, with their texts.
fn messages(answer: &Value) -> Vec<(&str, &str)> {
    array(&answer["messages"])
        .iter()
        .map(|message| (message["code"].as_str().expect("a code"), message["text"].as_str().expect("words")))
        .collect()
}

#[test]
fn verbs_with_one_number_use_the_mean_and_say_so_once() {
    for (speed, e) in [(6.0, 0.3), (8.0, 0.2), (12.0, 0.15), (16.0, 0.1)] {
        let answer = document("solve", &head_on(&json!(format!("{speed} m/s")), &json!(0)), &[]);
        close(number(&answer["vehicles"][0]["delta_v_magnitude"]), (1.0 + e) * speed, 1e-12, "ΔV");
        let [("restitution-of-curve", words)] = messages(&answer)[..] else { panic!("{}", answer["messages"]) };
        assert!(
            words.starts_with(&format!("contact.restitution is {e}, that of its curve at the closing speed of {speed:.2} m/s;")),
            "{words}"
        );
    }
    for (speed, e) in [(3.0, 0.4), (20.0, 0.1)] {
        let answer = document("solve", &head_on(&json!(format!("{speed} m/s ± 1 m/s")), &json!(0.05)), &[]);
        close(number(&answer["vehicles"][0]["delta_v_magnitude"]), (1.0 + e) * speed, 1e-12, "ΔV");
        let [("nominal-values", names), ("restitution-beyond-curve", words)] = messages(&answer)[..] else {
            panic!("{}", answer["messages"])
        };
        assert!(names.ends_with("vehicle.1.speed, contact.restitution.scatter"), "{names}");
        assert!(words.contains("beyond its points from 4.00 m/s to 16.00 m/s, where it is constant"), "{words}");
    }
}

#[test]
fn a_sweep_follows_the_curve() {
    let case = head_on(&json!("12 m/s"), &json!([0.08, 0.04, 0.02]));
    let sweep = |vary: &str| {
        let answer = document("sweep", &case, &["--vary", vary, "--of", "dV1"]);
        array(first(&answer["of"])).iter().map(number).collect::<Vec<f64>>()
    };
    for (vary, wanted) in [
        ("v1=2 m/s:14 m/s:4 m/s", [2.0 * 1.4, 6.0 * 1.3, 10.0 * 1.175, 14.0 * 1.125]),
        // The normal component of 12 m/s at an angle.
        (
            "Gamma=0 deg:60 deg:20 deg",
            [0.0, 20.0, 40.0, 60.0_f64].map(|degrees| {
                let speed = 12.0 * degrees.to_radians().cos();
                let e = if speed < 8.0 { 0.4 - 0.05 * (speed - 4.0) } else { 0.2 - 0.0125 * (speed - 8.0) };
                e * speed
            }),
        ),
        ("contact.restitution.scatter=-1:2:1", [-1.0, 0.0, 1.0, 2.0].map(|z| 12.0 * (1.15 + 0.03 * z))),
        ("contact.restitution=0:0.3:0.1", [12.0, 13.2, 14.4, 15.6]),
    ] {
        if vary.starts_with("Gamma") {
            let answer = document("sweep", &case, &["--vary", vary, "--of", "contact.separation.normal"]);
            for (found, wanted) in array(first(&answer["of"])).iter().zip(wanted) {
                close(number(found).abs(), wanted, 1e-12, vary);
            }
            continue;
        }
        for (found, wanted) in sweep(vary).into_iter().zip(wanted) {
            close(found, wanted, 1e-12, vary);
        }
    }
}

#[test]
fn derivatives_are_along_the_curve() {
    let case = head_on(&json!("12 m/s ± 0.5 m/s"), &json!([0.08, 0.04, 0.02]));
    let gradient = document("gradient", &case, &["--of", "dV1", "--wrt", "v1,e,contact.restitution.scatter", "--second"]);
    let (d, d2) = (&first(&gradient["of"])["d"], &first(&gradient["of"])["d2"]);
    // 1 + e + v e′, and v times the standard deviation.
    close(number(&d["vehicle.1.speed"]), 1.15 - 12.0 * 0.0125, 1e-12, "by the speed");
    close(number(&d["contact.restitution"]), 12.0, 1e-12, "by a shift of the curve");
    close(number(&d["contact.restitution.scatter"]), 0.36, 1e-12, "by the scatter");
    close(number(&d2["vehicle.1.speed"]["vehicle.1.speed"]), -0.025, 1e-12, "twice by the speed");
    close(number(&d2["vehicle.1.speed"]["contact.restitution.scatter"]), 0.03 - 12.0 * 0.0025, 1e-12, "by both");
    let found = document("uncertainty", &case, &["--of", "dV1", "--method", "linear,second-order"]);
    let (linear, second) = (&first(&found["of"])["linear"], &first(&found["of"])["second_order"]);
    let variance: f64 = 0.25 + 0.36 * 0.36;
    close(number(&linear["mean"]), 13.8, 1e-12, "the mean");
    close(number(&linear["sd"]), variance.sqrt(), 1e-12, "the sd");
    close(number(&linear["shares"]["contact.restitution.scatter"]), 0.36 * 0.36 / variance, 1e-12, "the share");
    close(number(&second["mean"]), 13.8 - 0.5 * 0.025 * 0.25, 1e-12, "the mean of second order");
}

#[test]
fn bounds_hold_along_the_curve() {
    let case = head_on(&json!({ "min": "6 m/s", "max": "12 m/s" }), &json!([0.08, 0.04, 0.02]));
    // (1 + e) v grows with v within both lines, at the mean ± three standard deviations.
    for (of, low, high) in [("dV1", 6.0 * 1.12, 12.0 * 1.24), ("result.contact.restitution", 0.06, 0.48)] {
        let found = document("uncertainty", &case, &["--of", of, "--method", "bounds"]);
        let bounds = &first(&found["of"])["bounds"];
        close(number(&bounds["low"]), low, 1e-8, of);
        close(number(&bounds["high"]), high, 1e-8, of);
        assert!(number(&bounds["low"]) <= low + 1e-15 && high - 1e-15 <= number(&bounds["high"]), "{bounds}");
        assert_eq!((&bounds["is_tight"], &bounds["is_whole"]), (&json!(true), &json!(true)), "{of}");
        let speeds = if of == "dV1" { ["at_low", "at_high"] } else { ["at_high", "at_low"] };
        assert_eq!(speeds.map(|key| number(&bounds[key]["vehicle.1.speed"])), [6.0, 12.0], "{of}");
    }
}

#[test]
fn samples_beyond_the_limits_are_refused_and_counted() {
    // At 12 m/s or more e is 0.15 ± 0.1 or less.
    let found = document(
        "uncertainty",
        &head_on(&json!("12 m/s"), &json!(0.1)),
        &["--of", "result.contact.restitution,dV1", "--method", "monte-carlo"],
    );
    let share = number(&found["refused"]["reasons"]["out-of-range"]) / 1e5;
    // Φ(−1.5) is 0.066807.
    close(share, 0.066_807, 4.0 * (0.066_807 * 0.933_193_f64 / 1e5).sqrt(), "refused");
    let least = &array(&first(&found["of"])["monte_carlo"]["density"]["edges"])[0];
    assert!(number(least) >= 0.0, "{least}");
}

#[test]
fn verbs_that_cannot_follow_a_curve_refuse_it() {
    let case = head_on(&json!("12 m/s"), &json!(0.05));
    let mut asked = case.clone();
    asked["unknown"] = json!({ "vehicle.1.speed": { "start": "10 m/s" } });
    asked["evidence"] = json!({ "vehicle.1.delta_v_magnitude": "12 m/s ± 1 m/s" });
    let run_of = run_with_input(&["reconstruct", "-"], &asked.to_string());
    assert_eq!((run_of.status, run_of.out.as_str()), (2, ""));
    for words in ["contact.restitution: it is given over the closing speed", "give a number", "<stdin>:1:"] {
        assert!(run_of.err.contains(words), "{words}: {}", run_of.err);
    }
    let folder = Folder::new();
    folder.write("case.json", case.to_string().as_bytes());
    let batch = |header: &str, row: &str| {
        folder.write("rows.csv", format!("{header}\n{row}\n").as_bytes());
        run(folder.path(), &["batch", "rows.csv", "--case", "case.json", "--of", "dV1", "-o", "-"])
    };
    let refused = batch("vehicle.1.speed", "10");
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    assert!(refused.err.contains("contact.restitution: the case gives it over the closing speed"), "{}", refused.err);
    let scattered = batch("contact.restitution,contact.restitution.scatter", "0.1,1");
    assert!(scattered.status == 2 && scattered.err.contains("contact.restitution.scatter"), "{}", scattered.err);
    let solved = batch("vehicle.1.speed,contact.restitution", "10,0.5");
    assert_eq!((solved.status, solved.err.as_str()), (0, ""));
    assert!(solved.out.contains(",15,") || solved.out.contains(",15.0,"), "{}", solved.out);
}
