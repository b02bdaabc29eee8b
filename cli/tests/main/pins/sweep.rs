//! `sweep`: its points, the values at each point, and the same values in every format.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::units::{hold, printed, tables, unit};
use super::{array, case, close, document, object};
use crate::process::{Run, run_with_input};

fn sweep(case: &Value, arguments: &[&str]) -> Run {
    run_with_input(&[&["sweep", "-"], arguments].concat(), &case.to_string())
}

fn numbers(value: &Value) -> Vec<f64> {
    array(value).iter().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect()
}

fn points(range: &str) -> Vec<f64> {
    let name = if range.starts_with("Gamma") { "contact.crush_plane" } else { "contact.restitution" };
    numbers(&document("sweep", &case("position-a.toml"), &["--vary", range, "--of", "W_n"])["vary"][name])
}

#[test]
fn a_range_has_its_ends_and_as_many_steps_as_fit() {
    let degrees = |all: &[f64]| all.iter().map(|degrees| degrees * PI / 180.0).collect::<Vec<_>>();
    for (range, want) in [
        ("e=0:0.3:0.1", vec![0.0, 0.1, 0.2, 0.3]),
        ("e=0:0.25:0.1", vec![0.0, 0.1, 0.2]),
        ("e=0.3:0:-0.1", vec![0.3, 0.2, 0.1, 0.0]),
        ("e=0.2:0.2:0.1", vec![0.2]),
        ("Gamma=-3 deg:3 deg:2 deg", degrees(&[-3.0, -1.0, 1.0, 3.0])),
        ("Gamma=3 deg:-2 deg:-2.5 deg", degrees(&[3.0, 0.5, -2.0])),
        ("Gamma=0 deg:0.05 rad:1 deg", degrees(&[0.0, 1.0, 2.0])),
    ] {
        let got = points(range);
        assert_eq!(got.len(), want.len(), "{range}: {got:?}");
        got.iter().zip(&want).for_each(|(got, want)| close(*got, *want, 1e-15, range));
    }
    let fine = points("Gamma=-10 deg:10 deg:0.1 deg");
    assert_eq!((fine.len(), fine[0], fine[200]), (201, -10.0 * PI / 180.0, 10.0 * PI / 180.0));
}

#[test]
fn the_most_points_rows_and_numbers_are_the_last_that_are_taken() {
    let case = case("position-a.toml");
    // A table with as many rows is refused because of its rows, which shows that the points were accepted without computing them.
    let refused = |arguments: &[&str]| {
        let run = sweep(&case, arguments);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}");
        run.err
    };
    const ROWS: &str = "20000";
    for (taken, too_many) in [
        (&["--vary", "e=0:0.999999:0.000001"][..], &["--vary", "e=0:1:0.000001"][..]),
        (
            &["--vary", "e=0:0.999:0.001", "--vary", "v1=0.1 m/s:100 m/s:0.1 m/s"],
            &["--vary", "e=0:0.999:0.001", "--vary", "v1=0 m/s:100 m/s:0.1 m/s"],
        ),
    ] {
        let (taken, too_many) = (refused(taken), refused(too_many));
        assert!(taken.contains("1000000") && taken.contains(ROWS) && taken.matches("error").count() == 1, "{taken}");
        assert!(too_many.contains("1000000"), "{too_many}");
        assert!(!too_many.contains(ROWS) || too_many.contains("1001"), "{too_many}");
    }
    let outputs = "V1x,V1y,V2x,V2y,W_n,W_t,T_L,mu0,dV1,dV2";
    let (taken, too_many) = (
        refused(&["--vary", "e=0:0.999999:0.000001", "--of", outputs]),
        refused(&["--vary", "e=0:0.999999:0.000001", "--of", &format!("{outputs},v_n")]),
    );
    assert!(!taken.contains("10000000") && too_many.contains("10000000"), "{taken}\n{too_many}");
    let rows = sweep(&case, &["--vary", "e=0:0.99995:0.00005", "--of", "W_n"]);
    assert_eq!((rows.status, tables(&rows.out)[0].rows.len()), (0, 20_000));
    assert!(refused(&["--vary", "e=0:1:0.00005", "--of", "W_n"]).contains(ROWS));
}

#[test]
fn each_value_is_that_of_the_case_at_that_point() {
    for name in ["position-a.toml", "sideswipe.toml", "stiff-corner.toml"] {
        let case = case(name);
        let swept = document("sweep", &case, &["--vary", "e=0:0.2:0.1", "--vary", "v1=35 mph:45 mph:5 mph", "--of", "all"]);
        for point in 0..9 {
            let mut edited = case.clone();
            // The last input varies fastest.
            edited["contact"]["restitution"] = json!(["0", "0.1", "0.2"][point / 3].parse::<f64>().expect("a number"));
            edited["vehicle"][0]["speed"] = json!(["35 mph", "40 mph", "45 mph"][point % 3]);
            let alone = document("gradient", &edited, &["--of", "all", "--wrt", "e,v1"]);
            assert_eq!(object(&swept["of"]).len(), object(&alone["of"]).len());
            for (output, values) in object(&swept["of"]) {
                assert_eq!(values[point], alone["of"][output]["value"], "{name} {output} at {point}");
            }
            for (input, values) in object(&swept["vary"]) {
                assert_eq!(values[point], alone["wrt"][input], "{name} {input} at {point}");
            }
            assert_eq!(swept["refused"][point], Value::Null);
        }
        assert_eq!((&swept["title"], &swept["schema"]), (&case["title"], &json!(1)));
    }
}

#[test]
fn a_refused_point_is_one_that_solve_refuses() {
    let mut case = case("oblique-surfaces.toml");
    let arguments = ["--vary", "Gamma=-70 deg:-50 deg:5 deg", "--of", "dV1,mu0"];
    let swept = document("sweep", &case, &arguments);
    let table = sweep(&case, &[&arguments[..], &["--format", "csv"]].concat()).out;
    let rows: Vec<csv::StringRecord> = csv::Reader::from_reader(table.as_bytes()).records().map(|row| row.expect("a row")).collect();
    case["contact"].as_object_mut().expect("a table").remove("surfaces");
    for (point, degrees) in [-70, -65, -60, -55, -50].into_iter().enumerate() {
        case["contact"]["crush_plane"] = json!(format!("{degrees} deg"));
        let is_refused = run_with_input(&["solve", "-"], &case.to_string()).status == 3;
        assert_eq!(swept["refused"][point].is_string(), is_refused, "{degrees}");
        for values in object(&swept["of"]).values() {
            assert_eq!(values[point].is_null(), is_refused, "{degrees}");
        }
        assert_eq!(
            (rows[point][1].is_empty(), rows[point][2].is_empty(), rows[point][3].is_empty()),
            (is_refused, is_refused, !is_refused)
        );
    }
    assert_eq!(array(&swept["refused"]).iter().filter(|reason| reason.is_string()).count(), 2);
}

/// Splits the header of a column into a name and a unit.
fn headed(head: &str) -> (&str, &str) {
    head.split_once(" [").map_or((head, ""), |(name, unit)| (name, unit.trim_end_matches(']')))
}

#[test]
fn csv_and_page_are_the_document_in_their_units() {
    for (name, range) in [("position-a.toml", "Gamma=-10 deg:10 deg:5 deg"), ("stiff-corner.toml", "vehicle.2.mass=3000 lb:4000 lb:500 lb")]
    {
        let case = case(name);
        let swept = document("sweep", &case, &["--vary", range, "--of", "all"]);
        for units in ["us", "si"] {
            let table = sweep(&case, &["--vary", range, "--of", "all", "--format", "csv", "--units", units]).out;
            let mut reader = csv::Reader::from_reader(table.as_bytes());
            let heads: Vec<String> = reader.headers().expect("a head").iter().map(str::to_owned).collect();
            let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.expect("a row")).collect();
            assert_eq!((heads.len(), rows.len()), (object(&swept["of"]).len() + 2, array(&swept["refused"]).len()));
            for (column, head) in heads[..heads.len() - 1].iter().enumerate() {
                let (name, of) = headed(head);
                // In a table the output of an input's name has `result.` before it.
                let output = name.strip_prefix("result.").unwrap_or(name);
                let values = numbers(if column == 0 { &swept["vary"][name] } else { &swept["of"][output] });
                for (row, value) in rows.iter().zip(values) {
                    let got: f64 = row[column].parse().expect("a number");
                    close(got * unit(of), value, 1e-14 * value.abs(), head);
                }
            }
            // The page shows the outputs of Table 2 in the same units.
            let shown = ["energy.normal_work", "energy.tangential_work", "energy.loss", "contact.critical_impulse_ratio"];
            let page = tables(&sweep(&case, &["--vary", range, "--units", units]).out);
            for (point, row) in page[0].rows.iter().enumerate() {
                let (input, of) = headed(&heads[0]);
                close(printed(&row[0]).expect("a number").0, numbers(&swept["vary"][input])[point] / unit(of), 1e-9, input);
                for (cell, output) in row[1..].iter().zip(shown) {
                    let of = heads.iter().map(|head| headed(head)).find(|(name, _)| *name == output).expect("a column").1;
                    hold(cell, numbers(&swept["of"][output])[point], of, 0.0, output);
                }
            }
            assert_eq!(page[0].rows.len(), rows.len());
        }
    }
}

/// Returns the value of an attribute of an element on one line.
pub(super) fn attribute<'a>(line: &'a str, name: &str) -> &'a str {
    line.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next()).unwrap_or("")
}

/// Returns the linear map through the first and the last label of an axis of a panel, after checking the labels between them.
pub(super) fn axis(lines: &[&str], anchor: &str, place: &str, inside: impl Fn(f64) -> bool) -> impl Fn(f64) -> f64 {
    let coordinate = |line: &str, name: &str| attribute(line, name).parse::<f64>().expect("a coordinate");
    let labels = lines.windows(2).filter(|pair| pair[0].starts_with("<text") && attribute(pair[0], "text-anchor") == anchor);
    let labels = labels.filter(|pair| inside(coordinate(pair[0], "y")) && !pair[0].contains("rotate"));
    let ticks: Vec<(f64, f64)> = labels.filter_map(|pair| Some((coordinate(pair[0], place), pair[1].trim().parse().ok()?))).collect();
    let ((p, x), (q, y)) = (ticks[0], ticks[ticks.len() - 1]);
    for (place, value) in &ticks {
        close(x + (place - p) / (q - p) * (y - x), *value, 2.0 / (q - p).abs() * (y - x).abs(), "a tick");
    }
    move |place| x + (place - p) / (q - p) * (y - x)
}

#[test]
fn the_lines_of_a_chart_are_the_values() {
    /// Heights of the title and of a panel, in chart coordinates of an eighth of a pixel.
    const TITLE: f64 = 8.0 * 40.0;
    const PANEL: f64 = 8.0 * 300.0;
    for (name, range) in [
        ("position-a.toml", "Gamma=-10 deg:10 deg:0.5 deg"),
        ("position-a.toml", "Gamma=10 deg:-10 deg:-2.5 deg"),
        ("sideswipe.toml", "v1=40 mph:60 mph:4 mph"),
    ] {
        let case = case(name);
        let outputs = ["energy.normal_work", "contact.critical_impulse_ratio", "vehicle.1.delta_v_magnitude"];
        let chart = sweep(&case, &["--vary", range, "--of", &outputs.join(","), "--format", "svg", "--units", "us"]).out;
        let swept = document("sweep", &case, &["--vary", range, "--of", &outputs.join(",")]);
        let lines: Vec<&str> = chart.lines().collect();
        let (input, varied) = object(&swept["vary"]).iter().next().expect("an input");
        let of = if input.ends_with("speed") { "mph" } else { "deg" };
        let data = |line: &&&str| line.starts_with("<polyline") && !attribute(line, "stroke").eq_ignore_ascii_case("#000000");
        for (panel, output) in outputs.into_iter().enumerate() {
            let inside = |y: f64| ((y - TITLE) / PANEL).floor() == panel as f64;
            let (across, up) = (axis(&lines, "middle", "x", inside), axis(&lines, "end", "y", inside));
            let points = |line: &&str| -> Vec<[f64; 2]> {
                let pairs = attribute(line, "points").split_whitespace().filter_map(|pair| pair.split_once(','));
                pairs.map(|(x, y)| [x, y].map(|at| at.parse().expect("a coordinate"))).collect()
            };
            let curve = lines.iter().filter(data).map(points).find(|points| points.len() > 2 && inside(points[0][1])).expect("a curve");
            let values = numbers(&swept["of"][output]);
            assert_eq!(curve.len(), values.len(), "{output}");
            let unit_of = ["ft lb", "", "ft/s"][panel];
            // Coordinates are whole numbers, also those of ticks.
            assert!(across(1.0) > across(0.0) && up(1.0) < up(0.0), "x grows to the right, y upwards");
            let (dx, dy) = ((across(1.0) - across(0.0)).abs(), (up(1.0) - up(0.0)).abs());
            for ((point, x), y) in curve.iter().zip(numbers(varied)).zip(values) {
                close(across(point[0]), x / unit(of), 3.0 * dx, input);
                close(up(point[1]), y / unit(unit_of), 3.0 * dy, output);
            }
        }
    }
}
