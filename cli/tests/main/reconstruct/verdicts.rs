//! Every verdict except agreement, each with its numbers and its exit status.

use serde_json::Value;

use super::{WALL, answer, number, replaced, text};
use crate::process::run_with_input;

/// An independent search came to χ² = 0.117862 at (0.0878, 0.05524, 22.016), where the ratio is the critical one and the friction, and to 1.7743.
#[test]
fn a_best_fit_where_friction_begins_to_hold_is_one() {
    for (name, chi_square) in [("stick_slide_corner", 0.117_862), ("stick_slide_corner_5", 1.7743)] {
        let path = crate::process::workspace().join(format!("cli/tests/reproducers/{name}.json"));
        let case = std::fs::read_to_string(path).expect("a reproducer");
        let (found, _) = answer(&case);
        assert_eq!(found["verdict"], "agrees", "{name}");
        assert!(found["notes"].to_string().contains("where friction begins to hold, a corner without a slope"), "{name}");
        let above = number(&found["chi_square"]) - chi_square;
        assert!((-1e-4..=0.0).contains(&above), "{name}: {above}");
        if name == "stick_slide_corner" {
            let value = |of: &str| number(&found["unknown"][of]["value"]);
            let wanted = [("contact.restitution", 0.0878), ("contact.friction", 0.05524), ("vehicle.2.speed", 22.016)];
            assert!(wanted.iter().all(|(of, wanted)| (value(of) / wanted - 1.0).abs() < 1e-3), "{}", found["unknown"]);
            for of in ["contact.friction", "vehicle.2.speed"] {
                assert_eq!(found["unknown"][of]["at_bound"], Value::Null, "{of}");
            }
        }
    }
}

/// Along the critical ratio the evidence hardly constrains anything, and searches end a few millionths of a radian apart: at one solution, as in its mirror image.
#[test]
fn ends_of_searches_in_a_flat_valley_are_one_solution() {
    let path = crate::process::workspace().join("cli/tests/reproducers/flat_valley.toml");
    let (found, _) = answer(&std::fs::read_to_string(path).expect("a reproducer"));
    assert_eq!((&found["verdict"], found["solutions"].as_array().map(Vec::len)), (&Value::from("agrees"), Some(1)));
}

/// More energy than any plane absorbs. Over the planes W_n has its extremum of −127.21 kJ at 4.234°, by an independent search, and from −5.15° to 13.61° it is
/// −123.60 kJ or less: (−130.2 + 123.60)²/3² is 3.84 above 0.992.
#[test]
fn a_best_fit_at_an_extremum_of_the_evidence_is_the_answer_without_a_standard_deviation() {
    let path = crate::process::workspace().join("cli/tests/reproducers/fold.toml");
    let (found, status) = answer(&std::fs::read_to_string(path).expect("a reproducer"));
    assert_eq!((status, &found["verdict"], &found["not_determined"]), (0, &Value::from("agrees"), &Value::Array(Vec::new())));
    let plane = &found["unknown"]["contact.crush_plane"];
    let interval = &plane["interval"];
    for (of, degrees) in [(&plane["value"], 4.234), (&interval["low"], -5.15), (&interval["high"], 13.61)] {
        assert!((number(of).to_degrees() - degrees).abs() < 0.01, "{plane}");
    }
    assert_eq!((&plane["sd"], &found["derived"]["contact.impulse_ratio"]["sd"]), (&Value::Null, &Value::Null));
    assert!((number(&found["chi_square"]) - 0.992).abs() < 1e-3);
    assert!(found["notes"].to_string().contains("where the evidence has an extremum along contact.crush_plane"), "{}", found["notes"]);
}

/// Two directions after the impact tell the ratio of the speeds at most, and contradict each other: the best fit is one of many, at any speed.
#[test]
fn a_contradiction_that_leaves_speeds_open_has_no_value_of_what_follows_from_them() {
    let speeds = "vehicle.1.speed = { start = \"15 m/s\", min = \"0 m/s\", max = \"40 m/s\" }\nvehicle.2.speed = { start = \"15 m/s\", min = \"0 m/s\", max = \"40 m/s\" }\n";
    let car = |mass: u32, heading: u32| {
        format!("[[vehicle]]\nmass = {mass}\nyaw_inertia = 2500\nheading = \"{heading} deg\"\nimpact_center = [1.9, 0.5]\n")
    };
    let case = format!(
        "schema = 1\n{}{}[contact]\ncrush_plane = \"10 deg\"\nrestitution = 0.1\n[unknown]\n{speeds}[evidence]\n\
         vehicle.1.separation_direction = \"50 deg \u{b1} 5 deg\"\nvehicle.2.separation_direction = \"-60 deg \u{b1} 5 deg\"\n",
        car(1500, 0),
        car(1800, 120),
    );
    let (found, status) = answer(&case);
    assert_eq!((status, &found["verdict"]), (1, &Value::from("contradicted")));
    assert_eq!(found["not_determined"].as_array().map(Vec::len), Some(1));
    for of in ["contact.closing_speed", "energy.loss"] {
        assert_eq!((&found["derived"][of]["value"], &found["derived"][of]["sd"]), (&Value::Null, &Value::Null), "{of}");
    }
    assert_eq!((&found["solution"], found["diagnostics"].as_array().map(Vec::len)), (&Value::Null, Some(0)));
    let page = text(&case, &[]).out;
    let said = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("one of many that fit as badly") && said.contains("- vehicle.1.speed by"), "{page}");
}

#[test]
fn several_solutions_are_all_reported_and_none_is_the_answer() {
    let (found, status) = answer(WALL);
    assert_eq!((status, &found["verdict"]), (1, &Value::from("several solutions")));
    let solutions = found["solutions"].as_array().expect("a list");
    let mut across: Vec<f64> = solutions.iter().map(|solution| number(&solution["unknown"]["vehicle.1.velocity.y"])).collect();
    across.sort_by(f64::total_cmp);
    assert!(across.len() == 2 && (across[0] + across[1]).abs() < 1e-9 && across[1] > 5.0, "{across:?}");
    // E_C = ½ m (1 − e²) v².
    let along = (2.0 * 50e3 / 1200.0 / 0.99_f64).sqrt();
    assert!(solutions.iter().all(|solution| (number(&solution["unknown"]["vehicle.1.velocity.x"]) - along).abs() < 1e-9));
    let said = text(WALL, &[]).out;
    assert!(said.contains("agrees with 2 solutions") && said.contains("-5.52"), "{said}");
    // A bound that excludes one of the two solutions leaves the other.
    let (one, status) = answer(&replaced(WALL, &[("start = \"1 m/s\"", "start = \"1 m/s\", min = 0")]));
    assert_eq!((status, &one["verdict"], one["solutions"].as_array().map(Vec::len)), (0, &Value::from("agrees"), Some(1)));
}

#[test]
fn what_is_open_has_no_value() {
    let case = replaced(WALL, &[("vehicle.1.separation_speed = \"4 m/s ± 0.2 m/s\"", "energy.normal_work = \"-50 kJ ± 2 kJ\"")]);
    let (found, status) = answer(&case);
    assert_eq!((status, &found["verdict"]), (1, &Value::from("undetermined")));
    assert_eq!(found["unknown"]["vehicle.1.velocity.y"]["value"], Value::Null);
    assert_eq!(found["unknown"]["vehicle.1.velocity.y"]["sd"], Value::Null);
    assert!(found["unknown"]["vehicle.1.velocity.x"]["value"].is_number(), "that is known");
    assert_eq!(found["not_determined"], serde_json::json!(["vehicle.1.velocity.y by 1 m/s"]));
    for key in ["solution", "crash3"] {
        assert_eq!(found[key], Value::Null, "{key}");
    }
    assert_eq!(found["covariance"]["vehicle.1.velocity.y"]["vehicle.1.velocity.x"], Value::Null);
    let said = text(&case, &["--units", "us"]).out;
    assert!(
        said.contains("Underdetermined: these combinations")
            && said.contains("vehicle.1.velocity.y by 3.28084 ft/s")
            && said.contains("open"),
        "{said}"
    );
    assert!(!said.contains("The collision"), "{said}");
}

#[test]
fn contradictions_are_no_answers() {
    let case = replaced(WALL, &[("\"4 m/s ± 0.2 m/s\"", "\"0.5 m/s ± 0.2 m/s\""), ("{ start = \"1 m/s\" }", "\"5 m/s ± 0.1 m/s\"")]);
    let (found, status) = answer(&case);
    assert_eq!((status, &found["verdict"]), (1, &Value::from("contradicted")));
    assert!(number(&found["chi_square"]) > 100.0 && number(&found["probability"]) < 1e-3);
    assert_eq!(found["solutions"], Value::Array(Vec::new()));
    assert!(found["solution"].is_object() && found["priors"]["vehicle.1.velocity.y"]["given"] == 5.0);
    let said = text(&case, &[]).out;
    let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in [
        "Inconsistent evidence",
        "Furthest off is vehicle.1.separation_speed: given 0.50 m/s",
        "not an answer",
        "impact center and crush plane",
    ] {
        assert!(flat.contains(words), "{words}: {said}");
    }
}

#[test]
fn bounds_that_exclude_say_what_they_exclude() {
    let case = replaced(WALL, &[("{ start = \"10 m/s\" }", "{ start = \"7 m/s\", max = \"8 m/s\" }")]);
    let (found, status) = answer(&case);
    assert_eq!((status, &found["verdict"]), (1, &Value::from("bounds exclude")));
    assert_eq!(found["unknown"]["vehicle.1.velocity.x"]["at_bound"], "max");
    assert_eq!(found["unknown"]["vehicle.1.velocity.x"]["value"], 8.0);
    let free = number(&found["without_bounds"]["unknown"]["vehicle.1.velocity.x"]);
    assert!((free - (2.0 * 50e3 / 1200.0 / 0.99_f64).sqrt()).abs() < 1e-6);
    let said = text(&case, &[]).out;
    assert!(
        said.contains("Best fit lies outside the bounds") && said.contains("is held at its max, 8.00 m/s") && said.contains("upper bound"),
        "{said}"
    );
}

#[test]
fn what_is_hardly_determined_stands_in_the_headline() {
    let case = replaced(
        WALL,
        &[
            ("vehicle.1.separation_speed = \"4 m/s ± 0.2 m/s\"", "vehicle.1.separation_yaw_rate = \"-20 deg/s ± 900 deg/s\""),
            ("{ start = \"1 m/s\" }", "{ start = \"1 m/s\", min = \"0.5 m/s\", max = \"3 m/s\" }"),
        ],
    );
    let (found, status) = answer(&case);
    // One solution, but an interval as wide as the bounds is none.
    assert_eq!((status, &found["verdict"]), (1, &Value::from("agrees")), "{found}");
    assert_eq!(found["hardly_determined"], serde_json::json!(["vehicle.1.velocity.y"]));
    assert!(number(&found["unknown"]["vehicle.1.velocity.y"]["sd"]) > 2.5, "more than the way between its bounds");
    let said = text(&case, &[]).out;
    let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("0.5 3.0 m/s"), "the bounds, with digits of their own: {said}");
    assert!(flat.contains("agrees with one solution, but evidence barely constrains vehicle.1.velocity.y: chi-square"), "{said}");
    // If it is determined, nothing is reported.
    let (found, _) = answer(&replaced(&case, &[("± 900 deg/s", "± 1 deg/s")]));
    assert_eq!(found["hardly_determined"], serde_json::json!([]));
}

#[test]
fn a_bound_says_whether_it_holds_what_sits_on_it() {
    // Head-on into the wall at 10 m/s, separating at e times that speed.
    let at = |after: &str, least: &str| {
        let unknown = format!("contact.restitution = {{ start = 0.2, min = {least}, max = 0.3 }}\n#");
        let case = replaced(
            WALL,
            &[
                ("crush_energy = ", "#"),
                ("vehicle.1.separation_speed = \"4 m/s", &*format!("vehicle.1.separation_velocity.x = \"{after} m/s")),
                ("vehicle.1.velocity.x", &unknown),
                ("vehicle.1.velocity.y", "#"),
                ("impact_center", "velocity = [\"10 m/s\", \"0 m/s\"]\nimpact_center"),
            ],
        );
        text(&case, &[]).out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    for (after, least, meaning) in [
        ("0.1", "0", "a common velocity along the normal"),
        ("-1.2", "0.12", "the best fit without the bound lies there too"),
        ("-0.9", "0.12", "the best fit without the bound lies beyond it"),
    ] {
        let said = at(after, least);
        assert!(said.contains(&format!("contact.restitution lies on its lower bound: {meaning}")), "{said}");
        assert!(!said.contains("No piece of evidence has an uncertainty"), "{said}");
    }
}

/// If the evidence requires an impulse that sliding cannot produce, more starts do not help.
#[test]
fn more_tangential_impulse_than_sliding_gives_is_named() {
    let with = |yaw_rate: &str| {
        replaced(
            WALL,
            &[
                ("vehicle.1.separation_speed = \"4 m/s ± 0.2 m/s\"", &*format!("vehicle.1.separation_yaw_rate = \"{yaw_rate}\"")),
                ("vehicle.1.velocity.y = { start = \"1 m/s\" }", "contact.impulse_ratio = { start = 0.1 }"),
                ("impact_center", "velocity = [\"10 m/s\", \"5 m/s\"]\nimpact_center"),
            ],
        )
    };
    // Heading for a wall on its left: friction retards its front, and it turns clockwise.
    for yaw_rate in ["-400 deg/s ± 5 deg/s", "40 deg/s ± 0.1 deg/s"] {
        let (found, status) = answer(&with(yaw_rate));
        assert_eq!((status, &found["verdict"]), (1, &Value::from("contradicted")), "{yaw_rate}");
        assert_eq!(found["limits"], serde_json::json!(["beyond-critical"]), "{yaw_rate}");
        let said = text(&with(yaw_rate), &[]).out;
        let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains("more tangential impulse than ends the sliding, or one that speeds it up: something snagged"), "{said}");
    }
    let (slid, status) = answer(&with("-50 deg/s ± 5 deg/s"));
    assert_eq!((status, &slid["verdict"]), (0, &Value::from("agrees")));
}

/// By the law of Kudlich and Slibar sliding ends at a ratio of its own, e apart from Brach's: a solution that has it neither snags nor slides.
#[test]
fn the_critical_ratio_is_that_of_the_law() {
    let case = |law: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1450\nyaw_inertia = 2600\nheading = \"10 deg\"\nimpact_center = [1.85, -0.4]\n\
             [[vehicle]]\nmass = 1180\nyaw_inertia = 1900\nheading = \"120 deg\"\nspeed = \"41 km/h ± 0.5 km/h\"\nimpact_center = [1.6, 0.5]\n\
             [contact]\ncrush_plane = \"-8 deg\"\ntangential_law = \"{law}\"\n\
             [evidence]\nvehicle.2.delta_v_magnitude = \"50 km/h ± 1 km/h\"\nvehicle.1.separation_yaw_rate = \"3.3 rad/s ± 0.5 rad/s\"\n\
             [unknown]\nvehicle.1.speed = {{ start = \"50 km/h\", min = 0 }}\ncontact.restitution = {{ start = 0.4, min = 0.35, max = 0.6 }}\n"
        )
    };
    for law in ["brach", "kudlich-slibar"] {
        let (found, _) = answer(&case(law));
        let all = found["diagnostics"].as_array().expect("a list");
        let ratio = all.iter().find(|one| one["name"] == "impulse ratio").expect("it is asked");
        assert!((number(&ratio["figure"]) - 1.0).abs() < 1e-9 && ratio["reading"] == "within", "{law}: {ratio}");
    }
}

/// A crush plane is the same after half a turn: bounds that leave out none are none, and cut no interval.
#[test]
fn bounds_of_every_direction_cut_nothing() {
    let case = |bounds: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2.0, 0.3]\n[[vehicle]]\nmass = 1300\nyaw_inertia = 2000\n\
             heading = \"90 deg\"\nspeed = \"30 km/h\"\nimpact_center = [-0.6, 0.8]\n[contact]\nrestitution = 0.08\n[evidence]\n\
             vehicle.1.separation_velocity = [\"8.83 m/s \u{b1} 0.3 m/s\", \"0.73 m/s \u{b1} 0.3 m/s\"]\n\
             vehicle.1.separation_yaw_rate = \"116.9 deg/s \u{b1} 8 deg/s\"\nvehicle.2.separation_yaw_rate = \"191.4 deg/s \u{b1} 8 deg/s\"\n[unknown]\n\
             vehicle.1.speed = {{ start = \"50 km/h\", min = \"0 km/h\", max = \"150 km/h\" }}\ncontact.crush_plane = {{ start = \"0 deg\"{bounds} }}\n"
        )
    };
    let (free, _) = answer(&case(""));
    let interval = |found: &Value| ["low", "high"].map(|end| number(&found["unknown"]["contact.crush_plane"]["interval"][end]));
    assert!(interval(&free)[0] > -1.1 && interval(&free)[1] < 1.1, "{:?}", interval(&free));
    for [min, max] in [[-90, 90], [-90, 180], [-180, 180], [0, 360], [-400, 400], [0, 180]] {
        let (found, status) = answer(&case(&format!(", min = \"{min} deg\", max = \"{max} deg\"")));
        assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")), "{min} {max}");
        assert_eq!(interval(&found), interval(&free), "{min} {max}");
        assert!(found["notes"].to_string().contains("the bounds of contact.crush_plane leave out no direction"), "{}", found["notes"]);
        assert!((number(&found["unknown"]["contact.crush_plane"]["max"]).to_degrees() - f64::from(max)).abs() < 1e-9);
    }
    let guaranteed =
        run_with_input(&["reconstruct", "-", "--guaranteed", "--format", "json"], &case(", min = \"-90 deg\", max = \"180 deg\""));
    assert_eq!(guaranteed.status, 0, "{}", guaranteed.err);
    let found: Value = serde_json::from_str(&guaranteed.out).expect("JSON");
    let range = &found["unknown"]["contact.crush_plane"]["guaranteed"];
    assert!(number(&range["low"]) > -1.5 && number(&range["high"]) < 1.5, "{range}");
}

/// The best fit slides, and another minimum sticks, 0.05 standard deviations from it in either speed: the corner where friction begins to hold is in one valley.
#[test]
fn a_corner_of_friction_is_no_second_answer() {
    let case =
        std::fs::read_to_string(crate::process::workspace().join("cli/tests/reproducers/corner_of_friction.json")).expect("a reproducer");
    let (found, status) = answer(&case);
    assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")), "{found}");
    assert_eq!(found["other_minima"].as_array().map(Vec::len), Some(1), "{found}");
    let interval = &found["unknown"]["vehicle.1.speed"]["interval"];
    let beyond = number(&found["other_minima"][0]["unknown"]["vehicle.1.speed"]);
    assert!(number(&interval["low"]) < beyond && beyond < number(&interval["high"]), "{found}");
}
