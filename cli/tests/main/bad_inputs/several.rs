//! Several issues in one file: all are reported, in file order.

use super::{COLLISION, CRUSHED, JSON, WALL, solve, wrong};
use crate::process::{Folder, run, workspace};

/// Returns the errors of an invalid input, each by its first line.
fn errors(file: &str, text: &str) -> Vec<String> {
    errors_at(2, file, text)
}

/// Returns the errors of a file that ends with a given status.
fn errors_at(status: i32, file: &str, text: &str) -> Vec<String> {
    let folder = Folder::new();
    folder.write(file, text.as_bytes());
    let run = solve(&folder, file);
    assert_eq!((run.status, run.out.as_str()), (status, ""), "{}", run.err);
    run.err.lines().filter(|line| line.starts_with("error: ")).map(str::to_owned).collect()
}

/// Returns the keys that errors are about.
fn errors_of(found: &[String]) -> Vec<String> {
    found.iter().filter_map(|error| error.strip_prefix("error: ")?.split_once(": ").map(|(key, _)| key.to_owned())).collect()
}

/// Asserts that exactly these errors are found, in this order.
fn are(found: &[String], keys: &[&str]) {
    assert_eq!(found.len(), keys.len(), "{found:#?}");
    for (error, key) in found.iter().zip(keys) {
        assert!(error.starts_with(&format!("error: {key}: ")), "{error} is not about {key}");
    }
}

/// A key that is unknown is named beside the one that is missing for it.
#[test]
fn unknown_keys_of_a_distribution_are_named_beside_those_that_are_missing() {
    let of =
        |table: &str| errors("case.toml", &wrong("", &[], 1, &[]).text().replace("restitution = 0.1", &format!("restitution = {table}")));
    are(&of("{ val = 0.08 }"), &["contact.restitution.value", "contact.restitution.val"]);
    are(&of("{ value = 0.08, stddev = 0.01 }"), &["contact.restitution", "contact.restitution.stddev"]);
    are(&of("{ min = 0, maximum = 0.3 }"), &["contact.restitution.max", "contact.restitution.maximum"]);
    are(&of("{ median = 0.1, faktor = 2 }"), &["contact.restitution.factor", "contact.restitution.faktor"]);
}

#[test]
fn all_at_once_in_file_order() {
    let edits = &[
        ("schema = 1", "schema = 3"),
        ("2564 lb", "2564 ft"),
        ("180 deg", "180 dge"),
        ("yaw_rate", "yaw_ratte"),
        ("41 ft/s", "nan ft/s"),
        ("= 0.1\n", "= 7\ncolor = 1\ntangential_law = \"x\"\n"),
    ];
    let keys = [
        "schema",
        "vehicle.1.mass",
        "vehicle.1.heading",
        "vehicle.1.yaw_ratte",
        "vehicle.2.speed",
        "contact.restitution",
        "contact.color",
        "contact.tangential_law",
    ];
    are(&errors("case.toml", &wrong("", edits, 0, &[]).text()), &keys);
}

/// What has a mass is judged as a vehicle, whatever its `barrier` is.
#[test]
fn of_a_vehicle_whose_barrier_is_no_truth() {
    let of = |barrier: &str| {
        let wall = wrong("", &[], 0, &[]).of(WALL).text().replace("barrier = true", barrier);
        errors("case.toml", &wall)
    };
    are(&of("barrier = 1\nlength = \"4 kg\""), &["vehicle.2.barrier"]);
    are(
        &of("barrier = 1\nmass = \"3 m\"\nyaw_inertia = -1\nheading = 0\nspeed = 0\nimpact_center = [1, 0]\ncolor = 2"),
        &["vehicle.2.barrier", "vehicle.2.mass", "vehicle.2.yaw_inertia", "vehicle.2.color"],
    );
}

#[test]
fn of_both_vehicles_and_of_crush() {
    let missing = &[("mass = \"2564 lb\"\n", ""), ("41 ft/s", "41 kg")];
    are(&errors("case.toml", &wrong("", missing, 0, &[]).text()), &["vehicle.1.mass", "vehicle.2.speed"]);
    let crush = &[("1200", "0"), ("5 ft", "5 s"), ("\"4.1 in\", \"5 in\"", "\"4.1 s\", \"nan in\""), ("lbf^0.5/ft", "lbf/ft")];
    let keys =
        ["vehicle.2.mass", "vehicle.2.crush.width", "vehicle.2.crush.depths.2", "vehicle.2.crush.depths.3", "vehicle.2.crush.stiffness.d1"];
    are(&errors("case.toml", &wrong("", crush, 0, &[]).of(CRUSHED).text()), &keys);
}

/// Only those keys are not missing that an unknown or a piece of evidence may replace which cannot be read, or whose name is near to one.
#[test]
fn of_unknowns_and_of_what_is_missing_beside_them() {
    let of = |given: &str| {
        let left = &[("speed = \"40 ft/s\"\n", ""), ("restitution = 0.1\n", ""), ("mass = \"6345 lb\"\n", "")];
        errors("case.toml", &format!("{}{given}", wrong("", left, 0, &[]).text()))
    };
    let (mass, restitution, speed) = ("vehicle.2.mass", "contact.restitution", "vehicle.1");
    for (given, keys) in [
        ("", &[speed, mass, restitution][..]),
        ("[unknown]\nvehicle1.speed = \"1 m/s\"\n", &[mass, restitution, "unknown.vehicle1.speed"]),
        ("[unknown]\nvehicle.2.mass = { min = 4, max = 3 }\n", &[speed, restitution, "unknown.vehicle.2.mass.max"]),
        ("[unknown]\nvehicle.1.frobnication = 3\n", &["unknown.vehicle.1.frobnication"]),
        ("unknown = 3\n", &["contact.unknown", speed, mass, restitution]),
        ("[evidence]\ncontact.restitution = \"3 m\"\n", &[speed, mass, "evidence.contact.restitution"]),
        ("[evidence]\nvehicle.1.velcity = [1, 2]\n", &[mass, restitution, "evidence.vehicle.1.velcity"]),
        ("[evidence]\ncrush_enrgy = \"3 kJ\"\n", &[speed, mass, restitution, "evidence.crush_enrgy"]),
        ("[evidence]\nvehicle.1.recorder = { file = \"none.csv\" }\n", &[mass, restitution, "evidence.vehicle.1.recorder.file"]),
        ("[evidence]\ncontact.record = { file = \"none.csv\" }\n", &[speed, mass, "evidence.contact.record.file"]),
        ("[evidence]\nvehicle.1.velocity = \"3 m\"\n", &[mass, restitution, "evidence.vehicle.1.velocity"]),
    ] {
        let mut found = errors_of(&of(given));
        let mut wanted: Vec<&str> = keys.to_vec();
        found.sort();
        wanted.sort();
        assert_eq!(found, wanted, "{given}");
    }
}

#[test]
fn in_json_as_in_toml() {
    let edits = &[("2564 lb", "0 lb"), ("41 ft/s", "41 ft"), ("0.1}", "2, \"friction\": -1}")];
    let keys = ["vehicle.1.mass", "vehicle.2.speed", "contact.restitution", "contact.friction"];
    are(&errors("case.json", &wrong("", edits, 0, &[]).of(JSON).text()), &keys);
}

#[test]
fn syntax_errors_of_several_lines() {
    let text = COLLISION.replace("\"2564 lb\"", "2564 lb").replace("\"41 ft/s\"", "41 ft/s");
    assert_eq!(errors("case.toml", &text).len(), 2);
}

#[test]
fn a_hundred_thousand_do_not_flood_the_terminal() {
    let unknown: String = (0..100_000).map(|i| format!("k{i} = 1\n")).collect();
    let found = errors("case.toml", &format!("{COLLISION}{unknown}"));
    assert_eq!(found.len(), 101);
    assert_eq!(found[100], "error: there are more issues");
}

#[test]
fn of_the_physics_too() {
    let edits = &[
        ("1200", "1"),
        ("2000", "1"),
        ("[10, 2]", "[-3, -2]"),
        ("[2, 0.5]", "[-1, 1]"),
        ("restitution = 0", "restitution = 1\nimpulse_ratio = 30"),
    ];
    let found = errors_at(3, "case.toml", &wrong("", edits, 0, &[]).of(WALL).text());
    // The ratio is why they would.
    are(&found, &["contact.impulse_ratio", "contact.impulse_ratio"]);
    assert!(found.iter().any(|error| error.contains("would gain energy")), "{found:#?}");
    assert!(found.iter().any(|error| error.contains("beyond the critical one")), "{found:#?}");
}

#[test]
fn the_input_before_the_physics() {
    // The physics is checked only if the input is valid, so only the input issue is reported if a file has both.
    let edits = &[("40 ft/s", "-40 ft/s"), ("= 0.1\n", "= 7\n")];
    are(&errors("case.toml", &wrong("", edits, 0, &[]).text()), &["contact.restitution"]);
}

/// What was done before the impact is read whatever else is wrong, and a misspelled model is not taken for another, whose keys would be missing.
#[test]
fn one_error_brings_no_others_with_it() {
    let momentum = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/momentum.toml")).expect("an example");
    let edited = |edits: &[(&str, &str)]| -> Vec<String> {
        let folder = Folder::new();
        let text = edits.iter().fold(momentum.clone(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        });
        folder.write("case.toml", text.as_bytes());
        let run = run(folder.path(), &["reconstruct", "case.toml"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
        run.err.lines().filter(|line| line.starts_with("error: ")).map(str::to_owned).collect()
    };
    are(&edited(&[("mass = \"4220 lb\"", "mass = \"4220 foo\"")]), &["vehicle.1.mass"]);
    are(&edited(&[("schema = 1", "schema = 2")]), &["schema"]);
    are(&edited(&[("14 mph ± 1 mph", "14 mph ± 1 kg")]), &["evidence.vehicle.1.separation_velocity.1"]);
    are(&edited(&[("\"momentum\"", "\"momentun\"")]), &["contact.model"]);
    are(
        &edited(&[("mass = \"4220 lb\"", "mass = \"4220 foo\""), ("60 ft", "60 foo")]),
        &["vehicle.1.mass", "before.vehicle.1.skid.1.length"],
    );
    assert!(edited(&[("[before.", "[befor.")]).iter().any(|error| error.starts_with("error: befor: unknown key")));
}
