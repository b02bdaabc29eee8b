//! `reconstruct`: unknowns, covariance and influence compared with an independent least-squares fit, and identities
//! that hold in every answer.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use serde_json::{Value, json};

use super::units::{self, Table, printed, rounded, tables};
use super::{array, case, close, differences, document, hold, number, object, references};
use crate::process::run_with_input;

/// Relative tolerance of a number: a search ends when its steps are within rounding, which changes derivatives by the square root of that.
const TOLERANCE: f64 = 1e-6;
const EXAMPLES: [&str; 5] = ["crabbed-1", "crabbed-2", "crabbed-3", "position-a", "two-cars"];
/// Number of columns of the first three tables of the page: unknowns, evidence and influence.
const COLUMNS: [usize; 3] = [6, 6, 4];

#[test]
fn every_number_of_the_independent_least_squares() {
    hold("reconstruct", "reconstruct.jsonl", TOLERANCE, 8);
}

/// The documents of the examples and of the references, each with its case.
static ANSWERS: LazyLock<Vec<(Value, Value)>> = LazyLock::new(|| {
    let cases = EXAMPLES.map(|name| case(&format!("reconstruct/{name}.toml"))).into_iter();
    let more = references("reconstruct.jsonl").into_iter().map(|reference| reference["case"].clone());
    cases.chain(more).map(|case| (document("reconstruct", &case, &[]), case)).collect()
});

/// Returns the case with the solution in place of the unknowns, and with the separation reconstructed from rest among the evidence.
fn solved(case: &Value, found: &Value) -> Value {
    let mut solved = case.clone();
    let tables = solved.as_object_mut().expect("a table");
    ["unknown", "rest"].iter().for_each(|key| drop(tables.remove(*key)));
    let certain = object(&found["evidence"]).iter().filter(|(_, piece)| piece["sd"].is_null()).map(|(name, piece)| (name, &piece["given"]));
    let values: Vec<_> = object(&found["unknown"]).iter().map(|(name, of)| (name, &of["value"])).chain(certain).collect();
    for (name, value) in values {
        match name.split('.').collect::<Vec<_>>()[..] {
            ["contact", key] => solved["contact"][key] = value.clone(),
            ["vehicle", number, "speed"] => solved["vehicle"][index(number)]["speed"] = value.clone(),
            ["vehicle", number, "velocity", axis] => {
                let velocity = &mut solved["vehicle"][index(number)]["velocity"];
                if velocity.is_null() {
                    *velocity = json!([0.0, 0.0]);
                }
                velocity[usize::from(axis == "y")] = value.clone();
            }
            _ => (),
        }
    }
    for number in ["1", "2"] {
        let given = |axis: &str| found["evidence"][format!("vehicle.{number}.separation_velocity.{axis}")]["given"].clone();
        if given("x").is_number() && case.get("rest").is_some() {
            solved["evidence"]["vehicle"][number]["separation_velocity"] = json!([given("x"), given("y")]);
        }
    }
    solved
}

fn index(number: &str) -> usize {
    number.parse::<usize>().expect("a number") - 1
}

#[test]
fn the_solution_is_that_of_solve() {
    for (found, case) in ANSWERS.iter() {
        let solved = solved(case, found);
        let mut faults = Vec::new();
        let mut want = document("solve", &solved, &[]);
        // The notes of `reconstruct` also refer to its evidence.
        ["notes", "messages"].iter().for_each(|key| drop(want.as_object_mut().expect("a document").remove(*key)));
        differences(&found["solution"], &want, 1e-9, "solution", &mut faults);
        let crushed = array(&case["vehicle"]).iter().all(|vehicle| vehicle.get("crush").is_some());
        if crushed {
            let want = document("crash3", &solved, &[]);
            let want: Value =
                ["vehicles", "corrected_energy", "impulse", "planar"].map(|key| (key, want[key].clone())).into_iter().collect();
            differences(&found["crash3"], &want, 1e-9, "crash3", &mut faults);
        }
        assert!(faults.is_empty(), "{}: {}", case["title"], faults.join("\n"));
        assert_eq!((&found["title"], &found["schema"], &found["converged"]), (&case["title"], &json!(1), &json!(true)));
    }
}

/// Computes the value of a piece of evidence from the solution alone.
fn computed(name: &str, solution: &Value, case: &Value) -> f64 {
    let Some((side, key)) = name.strip_prefix("vehicle.").and_then(|name| name.split_once('.')) else {
        assert_eq!(name, "crush_energy");
        return -number(&solution["energy"]["normal_work"]);
    };
    let vehicle = &solution["vehicles"][index(side)];
    let pair = |key: &str| [0, 1].map(|i| number(&vehicle[key][i]));
    let (after, change) = (pair("velocity"), pair("delta_v"));
    let before = [after[0] - change[0], after[1] - change[1]];
    let heading = case["vehicle"][index(side)]["heading"].as_str().expect("a heading");
    let heading: f64 = heading.trim_end_matches(" deg").parse::<f64>().expect("in degrees") * PI / 180.0;
    let along = |[x, y]: [f64; 2]| x * heading.cos() + y * heading.sin();
    let across = |[x, y]: [f64; 2]| y * heading.cos() - x * heading.sin();
    match key {
        "speed" => along(before),
        "approach_direction" => before[1].atan2(before[0]),
        "separation_velocity.x" => after[0],
        "separation_velocity.y" => after[1],
        "separation_speed" => after[0].hypot(after[1]),
        "separation_direction" => after[1].atan2(after[0]),
        "separation_yaw_rate" => number(&vehicle["yaw_rate"]),
        "delta_v_magnitude" => change[0].hypot(change[1]),
        "delta_v_forward" => along(change),
        "delta_v_left" => across(change),
        "pdof" => across(change).atan2(-along(change)),
        _ => panic!("{name}"),
    }
}

#[test]
fn the_evidence_is_compared_with_the_solution() {
    for (found, case) in ANSWERS.iter() {
        let evidence = object(&found["evidence"]);
        let mut chi_square = 0.0;
        for (name, piece) in evidence {
            let (given, got) = (number(&piece["given"]), number(&piece["computed"]));
            close(got, computed(name, &found["solution"], case), 1e-9 * got.abs().max(1.0), name);
            let Some(sd) = piece["sd"].as_f64() else {
                assert_eq!(piece["standardised_residual"], Value::Null);
                continue;
            };
            let off = given - got;
            let off = if name.ends_with("direction") || name.ends_with("pdof") { off - TAU * (off / TAU).round() } else { off };
            close(number(&piece["standardised_residual"]), off / sd, 1e-9, name);
            chi_square += (off / sd).powi(2);
        }
        let priors = found["priors"].as_object().map_or(0, |priors| {
            for (name, piece) in priors {
                let off = (number(&piece["given"]) - number(&found["unknown"][name]["value"])) / number(&piece["sd"]);
                close(number(&piece["standardised_residual"]), off, 1e-9, name);
                chi_square += off * off;
            }
            priors.len()
        });
        // Errors of one rest position are correlated, so their squares do not simply add up.
        if case.get("rest").is_none() {
            close(number(&found["chi_square"]), chi_square, 1e-6, "chi-square");
        }
        let held = |of: &Value| of["at_bound"].is_string() && of["sd"].is_null();
        let free = object(&found["unknown"]).values().filter(|of| !held(of)).count();
        let stands = evidence.values().filter(|piece| piece["sd"].is_null()).count();
        let is_exact = stands == evidence.len();
        let pieces = evidence.len() + priors - if is_exact { 0 } else { stands };
        assert_eq!(found["degrees_of_freedom"], pieces - free, "{}", case["title"]);
        // Every search that ends at a minimum ends at one of these.
        let ended = array(&found["solutions"]).iter().chain(array(&found["worse"])).map(|at| number(&at["searches"])).sum::<f64>();
        if found["verdict"] == "agrees" {
            assert_eq!(json!(ended), json!(number(&found["searches_converged"])), "{}", case["title"]);
            for (name, of) in object(&found["unknown"]) {
                assert_eq!(found["solutions"][0]["unknown"][name], of["value"], "{name}");
            }
        }
        assert!(number(&found["iterations"]) >= 1.0 && number(&found["searches"]) >= number(&found["searches_converged"]));
    }
}

/// Returns the tables of the page: first unknowns, evidence and, if there are standard deviations, influence.
fn page(case: &Value, units: &str) -> Vec<Table> {
    let run = run_with_input(&["reconstruct", "-", "--units", units], &case.to_string());
    assert!((0..=1).contains(&run.status) && run.err.is_empty(), "{}", run.err);
    tables(&run.out)
}

/// Checks a cell that is rounded to the digits that its standard deviation justifies.
fn hold_rounded(cell: &str, si: f64, unit: &str, what: &str) {
    let ((value, half), want) = (rounded(cell).unwrap_or_else(|| panic!("{what}: {cell} for {si}")), si / units::unit(unit));
    assert!((value - want).abs() <= half * (1.0 + 1e-6), "{what}: {cell} {unit} for {want}");
}

/// Returns the unit of a row; a pure number has none.
fn unit_of(row: &[String], columns: usize) -> &str {
    if row.len() == columns { &row[columns - 1] } else { "" }
}

/// Checks a quantity written in one cell.
fn hold_quantity(cell: &str, si: f64, what: &str) {
    let (value, unit) = cell.split_once(' ').unwrap_or((cell, ""));
    hold_rounded(value, si, unit, what);
    assert!(printed(value).is_some_and(|(value, half)| half <= 0.06 * value.abs()), "{what}: {cell}");
}

/// Returns the tables whose first column has one of these heads.
fn headed<'a>(tables: &'a [Table], heads: &'a [&str]) -> impl Iterator<Item = &'a Table> {
    tables.iter().filter(|table| heads.contains(&table.head[0].as_str()))
}

#[test]
fn the_page_of_unknowns_has_every_number_of_the_document() {
    let mut intervals = 0;
    for (found, case) in ANSWERS.iter() {
        let is_uncertain =
            |of: &Value| of.as_object().is_some_and(|of| of.values().any(|piece| piece["sd"].as_f64().is_some_and(|sd| sd > 0.0)));
        let has_uncertainty = is_uncertain(&found["evidence"]) || is_uncertain(&found["priors"]);
        for units in ["us", "si"] {
            let tables = page(case, units);
            for (key, heads) in [("unknown", &["unknown", "uncertain input"][..]), ("derived", &["what follows"])] {
                let mut named = 0;
                for table in headed(&tables, heads).filter(|table| table.head.len() == COLUMNS[0]) {
                    let mut name = "";
                    for row in &table.rows {
                        // The second row of a speed, in road units, has no name.
                        let is_named = row[0].contains('.') && rounded(&row[0]).is_none();
                        name = if is_named { row[0].trim_end_matches(" *") } else { name };
                        named += usize::from(is_named);
                        let cells = &row[usize::from(is_named)..];
                        let (of, unit) = (&found[key][name], unit_of(cells, COLUMNS[0] - 1));
                        assert_eq!(is_named && row[0].ends_with('*'), is_named && of["at_bound"].is_string(), "{name}");
                        let numbers = [&of["value"], &of["sd"], &of["interval"]["low"], &of["interval"]["high"]];
                        // The interval of exact evidence is its tolerance, and is not printed.
                        let ends = ["low", "high"].map(|key| of["interval"][key].as_f64());
                        let is_narrow = matches!((ends, of["value"].as_f64()), ([Some(low), Some(high)], Some(value)) if high - low <= 1e-5 * value.abs());
                        let is_exact = is_narrow || !has_uncertainty;
                        for (i, (cell, want)) in cells.iter().zip(numbers).enumerate() {
                            match want.as_f64().filter(|_| i < 2 || !is_exact) {
                                // A zero does not say how many of its digits are certain.
                                Some(want) if cell == "0" => {
                                    let [Some(low), Some(high)] = ends else { panic!("{name}: no width") };
                                    assert!(want.abs() <= 0.05 * (high - low), "{name}: 0 for {want}");
                                }
                                Some(want) => hold_rounded(cell, want, unit, name),
                                None => assert!(["-", "open"].contains(&cell.as_str()), "{name}: {cell}"),
                            }
                        }
                        intervals += usize::from(of["interval"]["low"].is_number());
                    }
                }
                assert_eq!(named, object(&found[key]).len(), "{key}");
            }
        }
    }
    assert!(intervals > 50, "{intervals}");
}

#[test]
fn the_page_of_evidence_and_influence() {
    let mut moved = 0;
    for (found, case) in ANSWERS.iter() {
        for units in ["us", "si"] {
            let tables = page(case, units);
            let start = tables.iter().position(|table| table.head[0] == "evidence").expect("a table of evidence");
            let tables = &tables[start - 1..];
            assert_eq!(tables[1].head.len(), COLUMNS[1]);
            let pieces = object(&found["evidence"]).len() + found["priors"].as_object().map_or(0, serde_json::Map::len);
            assert_eq!(tables[1].rows.len(), pieces);
            let piece = |name: &str| match name.strip_suffix(" (prior)") {
                Some(name) => (found["priors"][name].clone(), format!("prior of {name}")),
                None => (found["evidence"][name].clone(), name.to_owned()),
            };
            for row in &tables[1].rows {
                let ((of, _), unit) = (piece(&row[0]), unit_of(row, COLUMNS[1]));
                hold_rounded(&row[1], number(&of["given"]), unit, &row[0]);
                hold_rounded(&row[2], number(&of["computed"]), unit, &row[0]);
                match of["sd"].as_f64() {
                    Some(sd) => {
                        hold_rounded(&row[3], sd, unit, &row[0]);
                        close(row[4].parse().expect("a number"), number(&of["standardised_residual"]), 0.005_001, &row[0]);
                    }
                    None => assert_eq!((row[3].as_str(), row[4].as_str()), ("exact", "-")),
                }
            }
            if object(&found["unknown"]).values().all(|of| of["sd"].is_null()) {
                continue;
            }
            assert_eq!(tables[2].head.len(), COLUMNS[2]);
            let mut name = "";
            for row in &tables[2].rows {
                name = if row.len() == COLUMNS[2] { &row[0] } else { name };
                let [by, label, sd] = &row[row.len() - 3..] else { panic!("{row:?}") };
                let (of, key) = piece(label);
                let deviation = number(&of["sd"]);
                hold_quantity(sd, deviation, label);
                hold_quantity(
                    by.trim_start_matches('+'),
                    number(&found["influence"][name][&key]) * deviation,
                    &format!("{name} by {label}"),
                );
                moved += 1;
            }
        }
    }
    assert!(moved > 100, "{moved}");
}

#[test]
fn the_collision_below_is_that_of_solve() {
    for (found, case) in ANSWERS.iter() {
        let solved = solved(case, found);
        for units in ["us", "si"] {
            let page = page(case, units);
            let alone = tables(&run_with_input(&["solve", "-", "--units", units], &solved.to_string()).out);
            for table in &alone {
                assert!(page.iter().any(|other| other.rows == table.rows), "{}: {:?}", case["title"], table.rows);
            }
        }
    }
}
