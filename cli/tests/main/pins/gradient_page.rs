//! The page of `gradient`: derivatives of the document in the units shown, and the effect of a typical uncertainty of each input.

use std::collections::HashMap;

use serde_json::Value;

use super::units::{hold, unit};
use super::{case, document, number};
use crate::process::run_with_input;

/// Typical uncertainties of inputs, by the last part of the name, in US units and in SI; for all others 1 % of the value.
const UNCERTAIN: [(&[&str], [&str; 2]); 5] = [
    (&["heading", "crush_plane", "angle"], ["1 deg", "1 deg"]),
    (&["restitution", "impulse_ratio", "friction"], ["0.05", "0.05"]),
    (&["forward", "left", "offset", "to", "width", "depths", "stations"], ["1 in", "2.5 cm"]),
    (&["speed", "x", "y"], ["1 mph", "1 km/h"]),
    (&["yaw_rate"], ["1 deg/s", "1 deg/s"]),
];

fn uncertainty(input: &str, system: usize) -> &'static str {
    let last = input.rsplit('.').find(|part| part.parse::<usize>().is_err()).expect("a name");
    UNCERTAIN.iter().find(|(names, _)| names.contains(&last)).map_or("1 %", |(_, sizes)| sizes[system])
}

/// Converts a size to SI; a percentage is relative to the value.
fn si(size: &str, value: &Value) -> f64 {
    let (number, name) = size.split_once(' ').unwrap_or((size, ""));
    number.parse::<f64>().expect("a number") * if name == "%" { 0.01 * value.as_f64().unwrap_or(0.0).abs() } else { unit(name) }
}

/// Checks a number with four significant digits.
fn hold_significant(cell: &str, want: f64, what: &str) {
    let got: f64 = cell.parse().unwrap_or_else(|_| panic!("{what}: {cell}"));
    assert!((got - want).abs() <= 0.5001e-3 * want.abs(), "{what}: {cell} for {want}");
}

fn cells(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

#[test]
fn every_number_of_first_and_second_order() {
    let (mut first, mut second) = (0, 0);
    for (name, of) in [
        ("position-a.toml", "all"),
        ("stiff-corner.toml", "W_n,dV2,Omega1,vehicle.1.crush_energy,vehicle.2.crash3.delta_v_magnitude,pdof1,mu0"),
        ("sideswipe.toml", "T_L,dV1,mu"),
    ] {
        let case = case(name);
        for (system, units) in ["us", "si"].into_iter().enumerate() {
            let arguments = ["--of", of, "--wrt", "all", "--second"];
            let run = run_with_input(&[&["gradient", "-", "--units", units], &arguments[..]].concat(), &case.to_string());
            let found = document("gradient", &case, &arguments);
            let energy = number(&document("solve", &case, &[])["energy"]["before"]);
            let scale = |name: &str| match name {
                "J" | "ft lb" => energy,
                "N s" | "lbf s" => 1e4,
                _ => 10.0,
            };
            let (mut output, mut out, mut sizes) = ("", "", HashMap::new());
            for line in run.out.lines() {
                if let Some((head, value)) = line.split_once(" = ") {
                    output = head.split(' ').next().expect("a name");
                    let (value, name) = value.split_once(' ').unwrap_or((value, ""));
                    (out, sizes) = (name, HashMap::new());
                    hold(value, number(&found["of"][output]["value"]), out, scale(out), output);
                }
                let (row, of) = (cells(line), &found["of"][output]);
                let Some(input) = row.first().filter(|name| found["wrt"].get(**name).is_some()) else { continue };
                let value = &found["wrt"][*input];
                if row.len() == 3 {
                    let other = if row[1] == "itself" { input } else { row[1] };
                    let weight = if row[1] == "itself" { 0.5 } else { 1.0 };
                    let change = weight * number(&of["d2"][*input][other]) * sizes[*input] * sizes[other];
                    hold(row[2], change, out, 0.0, &format!("{output} by {input} and {other}"));
                    second += 1;
                    continue;
                }
                let [per_unit, change, size] = row[row.len() - 3..] else { panic!("{line}") };
                assert_eq!(
                    size,
                    uncertainty(input, system).replace("1 in", if input.ends_with("radius_of_gyration") { "1 %" } else { "1 in" }),
                    "{input}"
                );
                sizes.insert((*input).to_owned(), si(size, value));
                let d = of["d"][*input].as_f64();
                let Some(d) = d else {
                    assert_eq!((per_unit, change), ("none", "none"));
                    continue;
                };
                // The value precedes its unit if there is room; a pure number has no unit.
                let has_unit = row.iter().filter(|cell| cell.parse::<f64>().is_err() && **cell != "-").count() == 3;
                let of_input = if has_unit { row[row.len() - 4] } else { "" };
                if row.len() == if has_unit { 6 } else { 5 } && row[1] != "-" {
                    hold(row[1], number(value), of_input, 1.0, input);
                }
                let moved = d * si(size, value);
                // An effect within rounding is shown as zero.
                if moved.abs() > 1e-11 * scale(out) {
                    hold_significant(per_unit, d * unit(of_input) / unit(out), &format!("{output} by {input}"));
                }
                hold(change, moved, out, scale(out), &format!("{output} by {input}"));
                first += 1;
            }
        }
    }
    assert!(first > 1000 && second > 300, "{first} and {second}");
}
