//! `stiffness`: the numbers of an independent least-squares fit, and the page that shows them.

use serde_json::Value;

use super::units::{Table, hold, hold_value, tables};
use super::{array, case, close, document, hold as hold_all, number, references};
use crate::process::run_with_input;

/// Relative tolerance of a number: the fit on profiles is iterated to rounding of its sums.
const TOLERANCE: f64 = 1e-9;

#[test]
fn every_number_of_the_independent_fit() {
    hold_all("stiffness", "stiffness.jsonl", TOLERANCE, 5);
}

#[test]
fn a_line_is_that_of_its_coefficients() {
    for reference in references("stiffness.jsonl") {
        let found = document("stiffness", &reference["case"], &[]);
        let deepest = array(&found["tests"]).iter().map(|test| number(&test["mean_depth"])).fold(0.0, f64::max);
        for fit in array(&found["fits"]) {
            let (d0, d1, line) = (number(&fit["d0"]), number(&fit["d1"]), array(&fit["line"]));
            assert_eq!(line.len(), 23);
            for (i, point) in line.iter().enumerate() {
                let depth = 1.1 * deepest * i as f64 / 22.0;
                close(number(&point["depth"]), depth, 1e-14, "depth");
                close(number(&point["crush_intensity"]), d0 + d1 * depth, 1e-12 * (d0 + d1 * depth).abs(), "E*");
                match fit["covariance"].as_object() {
                    None => assert!(point["sd"].is_null()),
                    Some(of) => {
                        let variance = number(&of["d0_d0"]) + 2.0 * depth * number(&of["d0_d1"]) + depth * depth * number(&of["d1_d1"]);
                        close(number(&point["sd"]), variance.sqrt(), 1e-9 * variance.sqrt(), "sd");
                    }
                }
            }
        }
    }
}

#[test]
fn the_references_are_of_the_examples() {
    for (reference, name) in references("stiffness.jsonl").iter().zip(["struble-welsh.toml", "malibu.toml"]) {
        let example = case(&format!("tests/{name}"));
        let values = |case: &Value| document("stiffness", case, &[])["tests"].clone();
        assert_eq!(values(&example), values(&reference["case"]), "{name}");
    }
}

/// Returns the page of a reference in the given units, with its tables in order.
fn page(reference: &Value, units: &str) -> (Value, Vec<Table>) {
    let run = run_with_input(&["stiffness", "-", "--units", units], &reference["case"].to_string());
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    (document("stiffness", &reference["case"], &[]), tables(&run.out))
}

#[test]
fn every_number_of_the_page() {
    let (root, per_length, length, energy, speed) =
        (["lbf^0.5", "N^0.5"], ["lbf^0.5/ft", "N^0.5/m"], ["ft", "m"], ["ft lb", "J"], ["ft/s", "m/s"]);
    let (width, area, force) = (["lbf/in", "N/m"], ["lbf/in^2", "N/m^2"], ["lbf", "N"]);
    for reference in references("stiffness.jsonl") {
        for (u, units) in ["us", "si"].into_iter().enumerate() {
            let (found, tables) = page(&reference, units);
            let has_deviations = reference["case"].to_string().contains("scatter");
            let mut rest = tables.into_iter();
            let tests = rest.next().expect("a table of tests");
            // Each column has its unit in its header, after the symbol.
            let heads = |table: &Table, units: &[&str]| {
                assert!(
                    units.iter().zip(&table.head[table.head.len() - units.len()..]).all(|(unit, head)| head.ends_with(unit)),
                    "{:?}",
                    table.head
                );
            };
            heads(&tests, &[speed[u], "e", length[u], energy[u], speed[u], root[u]]);
            for (row, test) in tests.rows.iter().zip(array(&found["tests"])) {
                // After the name come speed and restitution of the file, then these.
                let shown =
                    [("mean_depth", length), ("crush_energy", energy), ("equivalent_energy_speed", speed), ("crush_intensity", root)];
                for (cell, (key, unit)) in row[3..].iter().zip(shown) {
                    hold_value(cell, &test[key], unit[u], 0.0, key);
                }
            }
            let forms = |row: &[String], of: &Value| {
                let shown = [("d0", root), ("d1", per_length), ("A", width), ("B", area), ("G", force)];
                assert_eq!(row.len(), 6);
                row[1..].iter().zip(shown).for_each(|(cell, (key, unit))| hold_value(cell, &of[key], unit[u], 0.0, key));
            };
            let alone: Vec<&Value> = array(&found["tests"]).iter().filter(|test| test.get("on_profile").is_some()).collect();
            if !alone.is_empty() {
                let table = rest.next().expect("a table of single tests");
                heads(&table, &[root[u], per_length[u], width[u], area[u], force[u]]);
                assert_eq!(table.rows.len(), 2 * alone.len());
                for (rows, test) in table.rows.chunks(2).zip(alone) {
                    forms(&rows[0], &test["on_mean_depth"]);
                    forms(&rows[1], &test["on_profile"]);
                }
            }
            let fits = array(&found["fits"]);
            if fits.is_empty() {
                continue;
            }
            let table = rest.next().expect("a table of fits");
            heads(&table, &[root[u], per_length[u], width[u], area[u], force[u]]);
            table.rows.iter().zip(fits).for_each(|(row, fit)| forms(row, fit));
            let table = rest.next().expect("a table of what the fits say");
            for (row, unit) in table.rows.iter().zip([root[u], per_length[u], "", energy[u], root[u], root[u]]) {
                assert!(row[0].ends_with(unit), "{row:?}");
            }
            for (i, fit) in fits.iter().enumerate() {
                let mut rows = table.rows.iter().map(|row| row[row.len() - 2 + i].as_str());
                let mut cell = || rows.next().expect("a row");
                let mut pair = |value: &Value, sd: &Value, unit: &str| {
                    let text = cell();
                    let (shown, deviation) = text.split_once(" ± ").expect("both");
                    hold_value(shown, value, unit, 0.0, text);
                    hold_value(deviation, sd, unit, 0.0, text);
                };
                pair(&fit["d0"], &fit["covariance"]["d0_sd"], root[u]);
                pair(&fit["d1"], &fit["covariance"]["d1_sd"], per_length[u]);
                let correlation = cell();
                hold_value(correlation, &fit["covariance"]["correlation"], "", 0.0, "correlation");
                let text = cell();
                let (shown, deviation) = text.split_once(" ± ").expect("both");
                hold_value(shown, &fit["prediction"]["crush_energy"], energy[u], 0.0, text);
                hold_value(deviation, &fit["prediction"]["sd"], energy[u], 0.0, text);
                for residual in array(&fit["residuals"]) {
                    let text = cell();
                    let (shown, standardised) = text.split_once(" (").unwrap_or((text, ""));
                    hold(shown, number(&residual["observed"]) - number(&residual["fitted"]), root[u], 1.0, text);
                    assert_eq!(has_deviations, !standardised.is_empty(), "{text}");
                    if has_deviations {
                        let told: f64 = standardised.trim_end_matches(" sd)").parse().expect("a number");
                        assert!((told - number(&residual["standardised"])).abs() <= 0.0501, "{text}");
                    }
                }
                if has_deviations {
                    let shown: f64 = cell().parse().expect("chi square");
                    assert!((shown - number(&fit["chi_square"])).abs() <= 0.00501);
                }
                assert_eq!(rows.next(), None, "every row is held");
            }
        }
    }
}
