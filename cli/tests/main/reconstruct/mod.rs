//! The verb `reconstruct`: the paper's barrier tests in both directions, and every verdict with its numbers.

mod forms;
mod from_rest;
mod from_tests;
mod guaranteed;
mod intervals;
mod posterior;
mod report;
mod returns;
mod table_b2;
mod uncertain;
mod verdicts;

use serde_json::Value;

use crate::process::{Run, run_with_input, workspace};

/// A car against a wall; the evidence does not determine the side from which it approaches.
const WALL: &str = r#"schema = 1
title = "a wall"

[[vehicle]]
name = "car"
mass = "1200 kg"
yaw_inertia = "2000 kg m^2"
heading = "0 deg"
impact_center = ["2 m", "0 m"]

[[vehicle]]
name = "wall"
barrier = true

[contact]
crush_plane = "0 deg"
restitution = 0.1

[evidence]
crush_energy = "50 kJ ± 2 kJ"
vehicle.1.separation_speed = "4 m/s ± 0.2 m/s"

[unknown]
vehicle.1.velocity.x = { start = "10 m/s" }
vehicle.1.velocity.y = { start = "1 m/s" }
"#;

fn example(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/examples/reconstruct").join(name)).expect("the example can be read")
}

/// Returns the case of the two cars with separation velocities in place of rest positions.
fn two_cars() -> String {
    let case = example("two-cars.toml");
    let (before, rest) = case.split_once("[rest]").expect("it has one");
    let (_, unknown) = rest.split_once("[unknown]").expect("it has one");
    let separation = "vehicle.1.separation_velocity = [\"6.1 m/s ± 0.5 m/s\", \"5.9 m/s ± 0.5 m/s\"]\n\
                      vehicle.1.separation_yaw_rate = \"176 deg/s ± 15 deg/s\"\n\
                      vehicle.2.separation_velocity = [\"4.2 m/s ± 0.5 m/s\", \"5.8 m/s ± 0.5 m/s\"]\n\
                      vehicle.2.separation_yaw_rate = \"-214 deg/s ± 15 deg/s\"\n\n[unknown]";
    format!("{before}{separation}{unknown}")
}

fn text(case: &str, arguments: &[&str]) -> Run {
    run_with_input(&[&["reconstruct", "-"], arguments].concat(), case)
}

/// Returns the document and the exit status, which must be that of an answer.
fn answer(case: &str) -> (Value, i32) {
    let run = text(case, &["--format", "json"]);
    assert!(run.err.is_empty() && (0..=1).contains(&run.status), "{}", run.err);
    (serde_json::from_str(&run.out).expect("JSON"), run.status)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn replaced(case: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(case.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "there is no {old}");
        text.replacen(old, new, 1)
    })
}
