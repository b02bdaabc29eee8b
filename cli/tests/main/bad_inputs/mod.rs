//! Inputs that must be refused, and a few that look invalid but must be accepted.
//!
//! Each is a case file with a few words replaced. The run must end with the exact status, print nothing on standard
//! output, and name the file, the line and the key on standard error.

mod calls;
mod contact;
mod crush;
mod files;
mod keys;
mod numbers;
mod physics;
mod reconstruct;
mod rest;
mod several;
mod types;
mod uncertain;
mod units;
mod vehicles;

use crate::process::{Folder, Run, planar_impact};

/// A valid case: two vehicles.
const COLLISION: &str = r#"schema = 1
title = "a case"

[[vehicle]]
name = "sedan"
mass = "2564 lb"
yaw_inertia = "1434.9 lbf s^2 ft"
heading = "180 deg"
speed = "40 ft/s"
yaw_rate = "0 deg/s"
impact_center = ["6.3499 ft", "0 ft"]

[[vehicle]]
name = "pickup"
mass = "6345 lb"
yaw_inertia = "5192.4 lbf s^2 ft"
heading = "90 deg"
speed = "41 ft/s"
impact_center = ["7.96804 ft", "-3.2356 ft"]

[contact]
crush_plane = "0 deg"
restitution = 0.1
"#;

/// A valid case: a vehicle and a wall.
const WALL: &str = r#"schema = 1
title = "a wall"

[[vehicle]]
name = "car"
mass = 1200
yaw_inertia = 2000
heading = "0 deg"
velocity = [10, 2]
impact_center = [2, 0.5]

[[vehicle]]
name = "wall"
barrier = true

[contact]
crush_plane = "0 deg"
restitution = 0
"#;

/// A valid case: a vehicle with crush, and a wall.
const CRUSHED: &str = r#"schema = 1

[[vehicle]]
name = "wall"
barrier = true

[[vehicle]]
name = "car"
mass = 1200
yaw_inertia = 2000
heading = "180 deg"
speed = "10 m/s"
impact_center = [2, 0.5]

[vehicle.crush]
width = "5 ft"
depths = ["3 in", "4.1 in", "5 in", "2 in"]
stiffness = { d0 = "48.27 lbf^0.5", d1 = "162.8 lbf^0.5/ft" }

[contact]
crush_plane = "0 deg"
restitution = 0.2
"#;

/// A valid case: a vehicle that hits a wall and comes to rest.
const RESTED: &str = r#"schema = 1

[[vehicle]]
name = "car"
mass = 1200
yaw_inertia = 2000
heading = "0 deg"
velocity = [10, 2]
impact_center = [2, 0.5]

[[vehicle]]
name = "wall"
barrier = true

[contact]
crush_plane = "0 deg"
restitution = 0

# How it came to rest.


[rest]
friction = "0.7 ± 0.05"
regions = [{ friction = 0.4, polygon = [["4 m", "-5 m"], ["9 m", "-5 m"], ["9 m", "5 m"]] }]

[rest.vehicle.1]
position = ["12 m ± 0.3 m", "-4 m ± 0.3 m"]
heading = "135 deg ± 5 deg"
front_axle = "1.2 m"
rear_axle = "1.5 m"
track = "1.5 m"
wheels = { front_left = "locked", front_right = { braking = 0.3, steer = "5 deg" }, rear_left = "rolling", rear_right = { braking = 1 } }
"#;

/// A valid case: two vehicles, as JSON.
const JSON: &str = r#"{
  "schema": 1,
  "title": "a case",
  "vehicle": [
    {"name": "sedan", "mass": "2564 lb", "yaw_inertia": "1434.9 lbf s^2 ft", "heading": "180 deg", "speed": "40 ft/s",
     "yaw_rate": "0 deg/s", "impact_center": ["6.3499 ft", "0 ft"]},
    {"name": "pickup", "mass": "6345 lb", "yaw_inertia": "5192.4 lbf s^2 ft", "heading": "90 deg", "speed": "41 ft/s",
     "impact_center": ["7.96804 ft", "-3.2356 ft"]}
  ],
  "contact": {"crush_plane": "0 deg", "restitution": 0.1}
}
"#;

/// One input and its expected result.
struct Bad {
    name: &'static str,
    base: &'static str,
    /// Replacements in the base file; each text occurs exactly once, or its first occurrence is replaced.
    edits: &'static [(&'static str, &'static str)],
    status: i32,
    /// The line that the message must name; 0 for none.
    line: usize,
    /// Other texts that standard error must contain.
    says: &'static [&'static str],
}

/// Creates a mistake in the file of two vehicles.
const fn wrong(name: &'static str, edits: &'static [(&'static str, &'static str)], line: usize, says: &'static [&'static str]) -> Bad {
    Bad { name, base: COLLISION, edits, status: 2, line, says }
}

impl Bad {
    /// Applies the mistake to another file.
    const fn of(mut self, base: &'static str) -> Bad {
        self.base = base;
        self
    }

    /// Expects another status.
    const fn ends(mut self, status: i32) -> Bad {
        self.status = status;
        self
    }

    fn text(&self) -> String {
        let mut text = self.base.to_owned();
        for (old, new) in self.edits {
            assert!(text.contains(old), "{}: the base has no {old}", self.name);
            text = text.replacen(old, new, 1);
        }
        text
    }

    fn file(&self) -> &'static str {
        if self.base.trim_start().starts_with(['{', '[']) { "case.json" } else { "case.toml" }
    }
}

/// Runs every input of a table and reports all unexpected results.
fn check(table: &[Bad]) {
    check_with(table, &["solve", "--format", "json"]);
}

/// Runs a table with another verb and its options.
fn check_with(table: &[Bad], words: &[&str]) {
    let folder = Folder::new();
    let mut faults = String::new();
    for bad in table {
        folder.write(bad.file(), bad.text().as_bytes());
        let run = Run::of(planar_impact(folder.path()).args(words).arg(bad.file()).output().expect("the program starts"));
        let mut wanted: Vec<String> = bad.says.iter().map(|&words| words.to_owned()).collect();
        if bad.line > 0 {
            wanted.push(format!("{}:{}:", bad.file(), bad.line));
        }
        for fault in faults_of(&run, bad.status, bad.file(), &wanted) {
            faults.push_str(&format!("{}: {fault}\n{}\n\n", bad.name, run.err));
        }
        // An issue with its place is said once.
        let said: Vec<&str> = run.err.split("\n\n").collect();
        if said.iter().enumerate().any(|(i, one)| one.contains(" --> ") && said[..i].contains(one)) {
            faults.push_str(&format!("{}: said twice\n{}\n\n", bad.name, run.err));
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

/// Solves a file of the folder by its bare name, which messages then repeat.
fn solve(folder: &Folder, file: &str) -> Run {
    Run::of(planar_impact(folder.path()).args(["solve", "--format", "json", file]).output().expect("the program starts"))
}

/// Returns everything wrong with the result of a run.
fn faults_of(run: &Run, status: i32, file: &str, wanted: &[String]) -> Vec<String> {
    let mut faults = Vec::new();
    let mut hold = |holds: bool, fault: String| {
        if !holds {
            faults.push(fault);
        }
    };
    hold(run.status == status, format!("exit status {}, expected {status}", run.status));
    hold(run.out.is_empty() != (run.status == 0), format!("{} bytes on standard output at status {}", run.out.len(), run.status));
    hold(run.err.is_empty() == (status == 0), "standard error is empty when and only when all is well".to_owned());
    if status == 2 || status == 3 {
        hold(run.err.contains(file), format!("the file {file} is not named"));
        hold(run.err.starts_with("error: "), "the message does not begin as an error".to_owned());
    }
    for words in wanted {
        hold(run.err.contains(words), format!("nothing says {words:?}"));
    }
    for never in ["panicked", "defect", "\u{1b}", "Some(", "Err("] {
        hold(!run.err.contains(never), format!("standard error contains {never:?}"));
    }
    faults
}

#[test]
fn the_bases_are_sound() {
    let sound = |name, base| wrong(name, &[], 0, &[]).of(base).ends(0);
    check(&[
        sound("two vehicles", COLLISION),
        sound("a wall", WALL),
        sound("crush", CRUSHED),
        sound("a rest", RESTED),
        sound("JSON", JSON),
    ]);
}

#[test]
fn the_tables_are_large() {
    let tables =
        [numbers::BAD, units::BAD, keys::BAD, types::BAD, vehicles::BAD, contact::BAD, crush::BAD, rest::BAD, physics::BAD, files::BAD];
    let tables: Vec<_> = tables.into_iter().chain([reconstruct::UNREADABLE, reconstruct::UNANSWERABLE, uncertain::BAD]).collect();
    let names: Vec<&str> = tables.iter().flat_map(|table| table.iter().map(|bad| bad.name)).collect();
    assert!(names.len() >= 240, "{}", names.len());
    let unique: std::collections::HashSet<&str> = names.iter().copied().collect();
    assert_eq!(unique.len(), names.len(), "each name tells one input");
}

/// A schema checks keys and types, but no units, order or relations between keys.
#[test]
fn the_schema_of_case_files_accepts_what_the_reader_does_and_refuses_keys_and_types_that_it_does() {
    let validator = crate::schema::validator(&crate::schema::schema("case"));
    let of_keys_and_types = [keys::BAD, types::BAD, vehicles::BAD].map(|table| (table, true));
    let of_values = [numbers::BAD, units::BAD, contact::BAD, crush::BAD, rest::BAD, physics::BAD].map(|table| (table, false));
    let of_reconstruct = [reconstruct::UNREADABLE, reconstruct::UNANSWERABLE, uncertain::BAD].map(|table| (table, false));
    for (table, must_be_seen) in of_keys_and_types.into_iter().chain(of_values).chain(of_reconstruct) {
        for bad in table {
            let text = bad.text();
            let value: Option<serde_json::Value> =
                if bad.file().ends_with("json") { serde_json::from_str(&text).ok() } else { toml::from_str(&text).ok() };
            // A parsed file no longer shows JSON keys given twice, or 1.0 instead of 1.
            let Some(value) = value.filter(|_| !bad.name.starts_with("twice") && bad.name != "schema 1.0") else { continue };
            let errors = crate::schema::errors(&validator, &value);
            assert!(bad.status == 2 || errors.is_empty(), "{}: {errors:?}", bad.name);
            assert!(bad.status != 2 || !must_be_seen || !errors.is_empty(), "{}", bad.name);
        }
    }
}
