//! The forms in which evidence and unknowns are given.

use serde_json::Value;

use super::{WALL, answer, number, replaced, text, two_cars};

#[test]
fn the_crush_of_each_vehicle_tells_how_they_share_it() {
    let case = replaced(
        &two_cars(),
        &[(
            "crush_energy = { value = \"from crush\", relative = 0.1 }",
            "vehicle.1.crush_energy = \"from crush ± 10 %\"\nvehicle.2.crush_energy = { value = \"from crush\", sd = \"5 kJ\" }",
        )],
    );
    let (found, _) = answer(&case);
    let [one, two] = [0, 1].map(|i| number(&found["solution"]["vehicles"][i]["crush_energy"]));
    assert!((number(&found["evidence"]["vehicle.1.crush_energy"]["sd"]) / one - 0.1).abs() < 1e-12);
    assert_eq!(found["evidence"]["vehicle.2.crush_energy"]["sd"], 5000.0);
    let share = &found["unknown"]["contact.crush_share"];
    assert!((number(&share["value"]) - one / (one + two)).abs() < 0.05, "{share}");
    assert!(found["notes"].to_string().contains("contact.crush_share is solved for too"));
    // A known quantity is not an unknown.
    let known = replaced(&case, &[("[evidence]\n", "[evidence]\ncontact.crush_share = 0.5\n")]);
    let (found, _) = answer(&known);
    assert_eq!(
        (found["unknown"].get("contact.crush_share"), &found["evidence"]["contact.crush_share"]["computed"]),
        (None, &Value::from(0.5))
    );
    let sought = replaced(&case, &[("[unknown]\n", "[unknown]\ncontact.crush_share = { min = 0, max = 1 }\n")]);
    let notes = answer(&sought).0["notes"].to_string();
    assert!(notes.contains("the search for contact.crush_share starts at 0.") && notes.contains(", that of the crush"), "{notes}");
}

#[test]
fn names_and_forms_are_those_of_the_case_file() {
    let (plain, _) = answer(&two_cars());
    let edits = [
        ("vehicle.1.speed = { start = \"50 km/h\", min = \"0 km/h\" }", "v1 = { start = \"50 km/h\", min = \"0 km/h\" }"),
        ("contact.restitution = { start", "e = { start"),
        ("contact.crush_plane = { start", "Gamma = { start"),
        ("\"176 deg/s ± 15 deg/s\"", "{ value = \"176 deg/s\", sd = \"15 deg/s\" }"),
        ("\"6.1 m/s ± 0.5 m/s\"", "\"6.1 +/- 0.5 m/s\""),
        ("vehicle.2.delta_v_forward = ", "vehicle.2.delta_v.forward = "),
    ];
    let (other, _) = answer(&replaced(&two_cars(), &edits));
    assert_eq!(plain, other);
    let json = r#"{ "schema": 1, "title": "a wall",
        "vehicle": [ { "name": "car", "mass": "1200 kg", "yaw_inertia": "2000 kg m^2", "heading": "0 deg", "impact_center": ["2 m", "0 m"] },
                     { "name": "wall", "barrier": true } ],
        "contact": { "crush_plane": "0 deg", "restitution": 0.1 },
        "evidence": { "crush_energy": "50 kJ ± 2 kJ", "vehicle": { "1": { "separation_speed": "4 m/s ± 0.2 m/s" } } },
        "unknown": { "vehicle": { "1": { "velocity": { "x": { "start": "10 m/s" }, "y": { "start": "1 m/s" } } } } } }"#;
    assert_eq!(answer(json).0, answer(WALL).0);
}

#[test]
fn the_number_of_the_ratio_is_that_which_the_case_has() {
    let with = |contact: &str, unknown: &str| {
        let edits = [
            ("restitution = 0.1\n", &*format!("restitution = 0.1\n{contact}\n")),
            ("vehicle.1.velocity.y = { start = \"1 m/s\" }", unknown),
            ("impact_center", "velocity = [\"10 m/s\", \"5 m/s\"]\nimpact_center"),
        ];
        replaced(WALL, &edits)
    };
    let [ratio, share] = ["contact.impulse_ratio", "contact.impulse_ratio.of_critical"];
    let (of_critical, _) = answer(&with("impulse_ratio = { of_critical = 0.5 }", "contact.impulse_ratio.of_critical = { start = 0.5 }"));
    let (given, _) = answer(&with("impulse_ratio = { of_critical = 0.5 }", "contact.impulse_ratio = 0.5"));
    assert_eq!(of_critical, given);
    let fraction = number(&given["unknown"][share]["value"]);
    let contact = &given["solution"]["contact"];
    let computed = number(&contact["impulse_ratio"]) / number(&contact["critical_impulse_ratio"]);
    assert!((computed - fraction).abs() < 1e-9 && fraction < 1.0, "{fraction}");
    // If the contact does not give it, it is a plain ratio.
    let (plain, _) = answer(&with("", "contact.impulse_ratio = { start = 0.1, min = 0, max = 0.2 }"));
    let difference = number(&plain["unknown"][ratio]["value"]) - number(&contact["impulse_ratio"]);
    assert!(difference.abs() < 1e-9, "{plain}");
    let said = text(&with("impulse_ratio = { of_critical = 0.5 }", "contact.impulse_ratio = 0.5"), &[]).out;
    assert!(said.contains(share), "{said}");
}
