//! `[rest]` in a case file, and the separation that CRASH3 uses.

use serde_json::Value;

use crate::process::{run, run_with_input, workspace};

fn example() -> String {
    std::fs::read_to_string(workspace().join("cli/examples/to-rest.toml")).expect("the example can be read")
}

fn json(arguments: &[&str], case: &str) -> Value {
    let run = run_with_input(arguments, case);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

/// The rest positions of the example are computed slides from its own impact, rounded to a centimeter and a tenth of a degree.
#[test]
fn the_rest_of_the_example_leads_back_to_its_separation() {
    let case = example();
    let solved = json(&["solve", "-", "--format", "json"], &case);
    let (rested, without) = (json(&["crash3", "-", "--format", "json"], &case), case.split("[rest]").next().expect("a case").to_owned());
    let without = json(&["crash3", "-", "--format", "json"], &without);
    for i in 0..2 {
        for axis in 0..2 {
            let velocity = solved["vehicles"][i]["velocity"][axis].as_f64().expect("a velocity");
            let from_rest = rested["vehicles"][i]["reconstruction"]["separation_velocity"][axis].as_f64().expect("a velocity");
            assert!((from_rest - velocity).abs() < 0.05, "vehicle {i}, axis {axis}: {from_rest}, not {velocity}");
            assert!(from_rest != velocity, "it comes from the rest");
            assert_eq!(without["vehicles"][i]["reconstruction"]["separation_velocity"][axis].as_f64(), Some(velocity));
        }
    }
}

#[test]
fn evidence_of_the_separation_goes_before_the_rest() {
    let case = example() + "\n[evidence.vehicle.1]\nseparation_velocity = [\"1 m/s\", \"2 m/s\"]\n";
    let crash3 = json(&["crash3", "-", "--format", "json"], &case);
    assert_eq!(crash3["vehicles"][0]["reconstruction"]["separation_velocity"], serde_json::json!([1.0, 2.0]));
}

/// Returns the notes of `crash3` about where its numbers come from, for the example without its rest positions and with further entries.
fn notes_of_crash3(further: &str) -> Vec<String> {
    let case = example().split("[rest]").next().expect("a case").to_owned() + further;
    let notes = json(&["crash3", "-", "--format", "json"], &case)["notes"].clone();
    let notes = notes.as_array().expect("notes").iter().map(|note| note.as_str().expect("words").to_owned());
    notes.filter(|note| !note.contains("PDOF is that of the common-velocity impulse")).collect()
}

#[test]
fn velocities_that_are_assumed_are_said_of_each_vehicle() {
    let planar = "the separation velocity is the one that planar mechanics has for the case";
    for (evidence, notes) in [
        ("", vec!["the separation velocities are those that planar mechanics has for the case: the evidence has none".to_owned()]),
        (
            "separation_velocity.x = \"1 m/s\"",
            vec![
                format!("vehicle.1: {planar}: the evidence has only vehicle.1.separation_velocity.x; give both components"),
                format!("vehicle.2: {planar}: the evidence has none"),
            ],
        ),
        ("separation_velocity = [\"1 m/s\", \"2 m/s\"]", vec![format!("vehicle.2: {planar}: the evidence has none")]),
    ] {
        let evidence = if evidence.is_empty() { String::new() } else { format!("\n[evidence.vehicle.1]\n{evidence}\n") };
        assert_eq!(notes_of_crash3(&evidence), notes, "{evidence}");
    }
}

#[test]
fn evidence_that_crash3_does_not_use_is_named() {
    let note = |evidence: &str| notes_of_crash3(&format!("\n[evidence.vehicle.1]\n{evidence}\n")).pop().expect("a note");
    let unused = "CRASH3 takes no part of the evidence but separation velocities; not used: vehicle.1.";
    let help = "; give the direction of the force as `pdof` under [vehicle.crush]";
    assert_eq!(note("pdof = \"20 deg ± 5 deg\""), format!("{unused}pdof{help}"));
    assert_eq!(note("delta_v_magnitude = \"5 m/s ± 1 m/s\""), format!("{unused}delta_v_magnitude"));
}

#[test]
fn crash3_needs_no_rest_pose() {
    let rest = example().split_once("[rest]").expect("rest positions").1.to_owned();
    let without_pose: Vec<&str> =
        rest.split_inclusive('\n').filter(|line| !line.starts_with("position = ") && !line.starts_with("heading = ")).collect();
    let notes = notes_of_crash3(&format!("[rest]{}", without_pose.concat()));
    for number in [1, 2] {
        let reason = format!("[rest.vehicle.{number}] does not say where it came to rest; give `position` and `heading` there");
        assert!(notes.iter().any(|note| note.starts_with(&format!("vehicle.{number}: ")) && note.ends_with(&reason)), "{notes:?}");
    }
}

#[test]
fn the_text_says_where_the_velocity_is_from() {
    let run = run(&workspace(), &["crash3", "cli/examples/to-rest.toml"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let flat = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("the separation velocity is reconstructed from its rest position"), "{}", run.out);
    assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
}

#[test]
fn the_closed_form_is_another_answer() {
    let slide = json(&["crash3", "-", "--format", "json"], &example());
    let closed = example().replace("[rest.vehicle.2]\n", "[rest.vehicle.2]\nmethod = \"closed-form\"\n");
    let closed = json(&["crash3", "-", "--format", "json"], &closed);
    let velocity = |of: &Value, i: usize| {
        [0, 1].map(|axis| of["vehicles"][i]["reconstruction"]["separation_velocity"][axis].as_f64().expect("a velocity"))
    };
    assert_eq!(velocity(&slide, 0), velocity(&closed, 0));
    let ([vx, vy], [wx, wy]) = (velocity(&slide, 1), velocity(&closed, 1));
    let apart = (vx - wx).hypot(vy - wy);
    assert!(apart > 1e-3 && apart < vx.hypot(vy), "{apart}");
}

/// Nothing is printed on standard output, and the message names the place in the file.
#[test]
fn a_vehicle_that_never_stops_is_refused_at_its_place() {
    let case = example().replace(
        "friction = \"0.7 ± 0.05\"",
        // No friction anywhere: beyond a single half plane a motion would come to rest.
        "friction = \"0.7 ± 0.05\"\nregions = [{ friction = 0, half_plane = { from = [\"-99 m\", \"0 m\"], toward = \"0 deg\" } }, \
         { friction = 0, half_plane = { from = [\"-98 m\", \"0 m\"], toward = \"180 deg\" } }]",
    );
    let run = run_with_input(&["crash3", "-"], &case);
    assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
    assert!(
        run.err.contains("rest.vehicle.1") && run.err.contains("rest.vehicle.2") && run.err.contains("does not come to rest"),
        "{}",
        run.err
    );
}

/// The search for the separation of such a vehicle took up to 14 s before it failed.
#[test]
fn what_has_not_the_proportions_of_a_vehicle_is_refused_at_once() {
    for (name, what) in [
        ("rest_slow.toml", "track is 152 m; it must be from 0 m to 8.4 m"),
        ("rest_slow_track_30_m.json", "track is 30 m; it must be from 0 m to 8.4 m"),
        ("rest_slow_I_1e9.json", "yaw_inertia is 1000000000 kg m^2; it must be from 13 kg m^2 to 130000 kg m^2"),
    ] {
        let refused = run(&workspace(), &["crash3", &format!("cli/tests/reproducers/{name}")]);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{name}");
        assert!(refused.err.contains("rest.vehicle.2") && refused.err.contains(what), "{name}: {}", refused.err);
    }
}
