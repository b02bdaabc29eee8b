//! Reproduces Table B2 of the paper from the case files of its barrier tests, cell by cell.

use serde_json::Value;

use super::{answer, example, number, replaced};

const FOOT_POUND: f64 = 1.355_817_948_331_4;
const FOOT: f64 = 0.3048;
const MPH: f64 = 0.447_04;

/// A row of Table B2: T_Ln, T_Lt, T_L in ft lb, μ, ΔV in ft/s and in mph of planar mechanics, as printed.
struct Planar {
    test: usize,
    restitution: &'static str,
    cells: [&'static str; 6],
}

/// The planar columns of Table B2. For test 2 at e = 0, only ΔV is printed.
const PLANAR: [Planar; 6] = [
    Planar { test: 1, restitution: "0", cells: ["10746", "1701", "12447", "0.274", "15.1", "10.3"] },
    Planar { test: 1, restitution: "0.18", cells: ["10746", "1758", "12504", "0.232", "17.9", "12.2"] },
    Planar { test: 2, restitution: "0", cells: ["", "", "", "", "30.5", "20.8"] },
    Planar { test: 2, restitution: "0.13", cells: ["44215", "7120", "51334", "0.243", "34.5", "23.6"] },
    Planar { test: 3, restitution: "0", cells: ["124976", "19784", "144759", "0.274", "51.3", "35.0"] },
    Planar { test: 3, restitution: "0.12", cells: ["124976", "20073", "145048", "0.245", "57.5", "39.2"] },
];

/// The CRASH3 columns of Table B2: T_Ln, T_Lt, T_L in ft lb, ΔV in ft/s and mph.
const CRASH3: [[&str; 5]; 3] =
    [["10746", "804", "11550", "14.5", "9.9"], ["44215", "3309", "47524", "29.5", "20.1"], ["124976", "9353", "134329", "49.5", "33.8"]];

/// Returns `true` if a number prints as a cell.
fn prints(cell: &str, value: f64) -> bool {
    let decimals = cell.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    cell.is_empty() || format!("{value:.decimals$}") == cell
}

#[test]
fn the_files_have_the_measured_restitution_and_the_printed_depth() {
    // Table B2, e and C_avg in ft.
    for (test, restitution, depth) in [(1, "0.18", "0.1062"), (2, "0.13", "0.5203"), (3, "0.12", "1.0768")] {
        let case = example(&format!("crabbed-{test}.toml"));
        assert!(case.contains(&format!("\nrestitution = {restitution}\n")), "{case}");
        let depths = case.split("depths = [\"").nth(1).and_then(|rest| rest.split(" ft").next()).expect("a depth");
        assert!(prints(depth, depths.parse().expect("a number")), "{depths}");
    }
}

fn crabbed(test: usize, restitution: &str) -> String {
    let case = example(&format!("crabbed-{test}.toml"));
    let line = case.lines().find(|line| line.starts_with("restitution")).expect("it has one").to_owned();
    replaced(&case, &[(&line, &format!("restitution = {restitution}"))])
}

/// Replaces the paper's heavy body with a fixed barrier.
fn before_a_fixed_barrier(case: &str) -> String {
    let (before, barrier) = case.split_once("mass = \"1e6 slug\"").expect("the barrier has a mass");
    let (_, after) = barrier.split_once("[contact]").expect("it has one");
    format!("{before}barrier = true\n\n[contact]{after}")
}

/// Returns the planar results of a crabbed test, in the order of the table's columns.
fn planar(case: &str) -> [f64; 6] {
    let (found, status) = answer(case);
    assert_eq!((status, &found["verdict"]), (0, &Value::from("agrees")));
    // The approach direction is known to be 30° off: Table B2 keeps the crab angle.
    let [x, y] = ["x", "y"].map(|axis| number(&found["unknown"][format!("vehicle.1.velocity.{axis}")]["value"]));
    assert!((y / x + 30_f64.to_radians().tan()).abs() < 1e-12);
    let (contact, energy) = (&found["solution"]["contact"], &found["solution"]["energy"]);
    let delta_v = number(&found["solution"]["vehicles"][0]["delta_v_magnitude"]);
    [
        -number(&energy["normal_work"]) / FOOT_POUND,
        -number(&energy["tangential_work"]) / FOOT_POUND,
        number(&energy["loss"]) / FOOT_POUND,
        number(&contact["impulse_ratio"]).abs(),
        delta_v / FOOT,
        delta_v / MPH,
    ]
}

#[test]
fn the_planar_columns_of_table_b2_come_out_of_the_crush() {
    let mut cells = 0;
    for row in &PLANAR {
        let case = crabbed(row.test, row.restitution);
        let (heavy, fixed) = (planar(&case), planar(&before_a_fixed_barrier(&case)));
        for (cell, (fixed, heavy)) in row.cells.into_iter().zip(fixed.into_iter().zip(heavy)) {
            let what = format!("test {} at e = {}: {heavy} for {cell}", row.test, row.restitution);
            assert!(prints(cell, heavy), "{what}");
            // A fixed barrier has infinite mass; the results differ by the ratio of the masses, 1.02e-4.
            assert!((fixed / heavy - 1.0).abs() < 1.03e-4, "{what}, and {fixed} of a fixed one");
            cells += usize::from(!cell.is_empty());
        }
    }
    assert_eq!(cells, 32, "every cell but the four that test 2 leaves out");
}

#[test]
fn the_crash3_columns_of_table_b2_come_out_of_the_crush() {
    for (test, row) in CRASH3.iter().enumerate() {
        // With the file unchanged: no CRASH3 result depends on the restitution.
        let (found, _) = answer(&example(&format!("crabbed-{}.toml", test + 1)));
        let car = &found["crash3"]["vehicles"][0];
        let diagnostics = found["diagnostics"].as_array().expect("a list");
        for name in ["balance of crush forces", "share of crush energy"] {
            let reading = diagnostics.iter().find(|finding| finding["name"] == name).map(|finding| &finding["reading"]);
            assert_eq!(reading, Some(&Value::from("not checked")), "{name}: what was not crushed speaks of no force");
        }
        let (normal, total) = (number(&car["crush_energy"]), number(&car["corrected_energy"]));
        // The paper's ΔV of CRASH3 uses the crush energy alone, uncorrected, and the whole mass: it is the equivalent energy speed.
        let delta_v = number(&found["solution"]["vehicles"][0]["equivalent_energy_speed"]);
        let values = [normal / FOOT_POUND, (total - normal) / FOOT_POUND, total / FOOT_POUND, delta_v / FOOT, delta_v / MPH];
        for (cell, value) in row.iter().zip(values) {
            assert!(prints(cell, value), "test {}: {value} for {cell}", test + 1);
        }
    }
}
