//! `crush` and `crash3`: hand calculations from stations, effects of the assumptions, and the pages of both verbs.

use serde_json::{Value, json};

use super::units::{hold, hold_value, tables, unit};
use super::{array, case, close, document, number, references};
use crate::process::run_with_input;

/// The examples in which every vehicle has a crush.
const CRUSHED: [&str; 4] = ["cavalier-crush.toml", "oblique-surfaces.toml", "stiff-corner.toml", "to-rest.toml"];
/// The rows of the page of `crush` after width and number of depths; zones have their own stiffness.
const CRUSH: [&str; 11] = ["/mean_depth", "/K/0", "/K/1", "/K/2", "/form_factor", "/d0", "/d1", "/A", "/B", "/G", "/saturation"];
const FORCE_AND_ENERGY: [&str; 7] =
    ["/crush_force", "/crush_force_at_pdof", "/pdof", "/surface", "/crush_energy", "/equivalent_energy_speed", "/equivalent_energy_speed"];
/// The rows of the page of `crash3` after the surface.
const CRASH3: [&str; 12] = [
    "/crush_energy",
    "/pdof",
    "/correction",
    "/corrected_energy",
    "/moment_arm",
    "/effective_mass_factor",
    "/delta_v_magnitude",
    "/delta_v_magnitude",
    "/reconstruction/separation_velocity/0",
    "/reconstruction/separation_velocity/1",
    "/reconstruction/approach_velocity/0",
    "/reconstruction/approach_velocity/1",
];
/// The sources of the results from the crush energy, row by row.
const ASSUMPTIONS: [&str; 5] = ["planar", "common_velocity", "point_mass", "tangential_factor", "together"];

fn page(verb: &str, case: &Value, units: &str) -> String {
    let run = run_with_input(&[verb, "-", "--units", units], &case.to_string());
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    run.out
}

/// Returns a case with three stations 0.4 and 0.8 m apart and two zones, the first ending at 0.8 m; and a crush with saturation.
pub(super) fn by_hand() -> Value {
    let mut case = case("stiff-corner.toml");
    case["vehicle"][0]["mass"] = json!("1000 kg");
    case["vehicle"][0]["crush"] = json!({
        "stations": ["0 m", "0.4 m", "1.2 m"],
        "depths": ["0.1 m", "0.3 m", "0.5 m"],
        "stiffness": [{ "to": "0.8 m", "d0": "100 N^0.5", "d1": "1000 N^0.5/m" }, { "d0": "80 N^0.5", "d1": "1200 N^0.5/m" }],
    });
    case["vehicle"][1]["mass"] = json!("2000 kg");
    case["vehicle"][1]["crush"] = json!({
        "width": "2 m",
        "depths": ["0.2 m", "0.4 m"],
        "stiffness": { "A": "60000 N/m", "B": "360000 N/m^2", "saturation": "0.3 m" },
    });
    case
}

#[test]
fn crush_by_hand() {
    let case = by_hand();
    let found = document("crush", &case, &[]);
    let [zoned, saturated] = array(&found["vehicles"]) else { panic!("two vehicles") };
    let all = |got: &Value, wanted: &[(&str, f64)]| {
        for (place, want) in wanted {
            close(number(got.pointer(place).unwrap_or_else(|| panic!("{place}"))), *want, 1e-12 * want.abs(), place);
        }
    };
    // K1 = w/2, K2 = Σ Δ (a + b)/2, K3 = Σ Δ (a² + ab + b²)/6; the depth at 0.8 m is 0.4 m.
    // Zone 1: Δ 0.4 from 0.1 to 0.3 and Δ 0.4 from 0.3 to 0.4; zone 2: Δ 0.4 from 0.4 to 0.5.
    let (third_1, third_2) = (0.4 * (0.13 + 0.37) / 6.0, 0.4 * 0.61 / 6.0);
    // E = d0² K1 + d0 d1 K2 + d1² K3.
    let (energy_1, energy_2) = (1e4 * 0.4 + 1e5 * 0.22 + 1e6 * third_1, 6400.0 * 0.2 + 96_000.0 * 0.18 + 1.44e6 * third_2);
    all(
        zoned,
        &[
            ("/width", 1.2),
            ("/mean_depth", 0.4 / 1.2),
            ("/K/0", 0.6),
            ("/K/1", 0.4),
            ("/K/2", third_1 + third_2),
            ("/crush_energy", energy_1 + energy_2),
            ("/equivalent_energy_speed", (2.0 * (energy_1 + energy_2) / 1000.0).sqrt()),
            ("/zones/0/to", 0.8),
            ("/zones/0/K/0", 0.4),
            ("/zones/0/K/1", 0.22),
            ("/zones/0/K/2", third_1),
            ("/zones/0/d0", 100.0),
            ("/zones/0/d1", 1000.0),
            ("/zones/0/A", 1e5),
            ("/zones/0/B", 1e6),
            ("/zones/0/G", 5000.0),
            ("/zones/0/crush_energy", energy_1),
            ("/zones/1/K/1", 0.18),
            ("/zones/1/d0", 80.0),
            ("/zones/1/A", 96_000.0),
            ("/zones/1/G", 3200.0),
            ("/zones/1/crush_energy", energy_2),
        ],
    );
    assert_eq!(
        (&zoned["zones"][1]["to"], &zoned["d0"], &zoned["A"], &zoned["G"]),
        (&Value::Null, &Value::Null, &Value::Null, &Value::Null)
    );
    // G = A²/(2 B) = 5 kN; up to 0.3 m ½ B C² + A C + G per width, beyond it 168 kN/m: C from 0.2 to 0.4 over 2 m, half of it beyond 0.3 m.
    let below = 1.0 * (5000.0 + 60_000.0 * 0.25 + 360_000.0 * (0.04 + 0.06 + 0.09) / 6.0);
    let beyond = 1.0 * (5000.0 + 60_000.0 * 0.3 + 180_000.0 * 0.09 + 168_000.0 * 0.05);
    all(
        saturated,
        &[
            ("/width", 2.0),
            ("/mean_depth", 0.3),
            ("/K/0", 1.0),
            ("/K/1", 0.6),
            ("/K/2", 2.0 * 0.28 / 6.0),
            ("/A", 60_000.0),
            ("/B", 360_000.0),
            ("/d0", 100.0),
            ("/d1", 600.0),
            ("/G", 5000.0),
            ("/saturation", 0.3),
            ("/crush_energy", below + beyond),
            ("/equivalent_energy_speed", ((below + beyond) / 1000.0).sqrt()),
        ],
    );
    assert_eq!((&zoned["name"], &saturated["name"]), (&json!("hatchback"), &json!("wagon")));
}

#[test]
fn the_page_of_crush() {
    for case in CRUSHED.map(case).into_iter().chain([by_hand()]) {
        let found = document("crush", &case, &[]);
        for (units, length) in [("us", "ft"), ("si", "m")] {
            let tables = tables(&page("crush", &case, units));
            for i in [0, 1] {
                let vehicle = &found["vehicles"][i];
                // The second row holds the number of depths.
                let (width, rest) = (&tables[0].rows[0], &tables[0].rows[2..]);
                let show = |row: &[String], place: &str| {
                    let (name, cell) = (row[row.len() - 3].as_str(), row[row.len() - 2 + i].as_str());
                    // Moments have units of powers of a length.
                    let si = |of: f64| match name.split_once('^') {
                        Some((base, power)) if base == length => of / unit(base).powi(power.parse().expect("a power")),
                        _ => of / unit(name),
                    };
                    match vehicle.pointer(place) {
                        found if cell == "-" => {
                            assert!(case["vehicle"][i]["barrier"] == true || found.is_none_or(Value::is_null), "{place}")
                        }
                        Some(Value::Null) => assert_eq!(cell, "zones"),
                        Some(Value::String(text)) => assert_eq!(cell, text),
                        Some(value) if place == "/form_factor" => hold(cell, number(value), "", 0.0, place),
                        Some(value) => hold(cell, si(number(value)), "", 0.0, place),
                        None => panic!("{place} is shown and not in the document"),
                    }
                };
                show(width, "/width");
                let count = &tables[0].rows[1];
                let depths = case["vehicle"][i]["crush"]["depths"].as_array().map_or("-".to_owned(), |depths| depths.len().to_string());
                assert_eq!(count[count.len() - 2 + i], depths);
                let places = CRUSH[..rest.len() - FORCE_AND_ENERGY.len()].iter().chain(&FORCE_AND_ENERGY);
                rest.iter().zip(places).for_each(|(row, place)| show(row, place));
            }
            let zoned: Vec<&Value> = array(&found["vehicles"]).iter().filter(|vehicle| vehicle.get("zones").is_some()).collect();
            assert_eq!(tables.len(), 1 + zoned.len());
            for (table, vehicle) in tables[1..].iter().zip(zoned) {
                for (row, zone) in table.rows.iter().zip(array(&vehicle["zones"])) {
                    let names = table.head[1..].iter().map(|head| head.split_once(' ').expect("a unit").1);
                    let values = [2.0 * number(&zone["K"][0]), number(&zone["d0"]), number(&zone["d1"]), number(&zone["crush_energy"])];
                    row[1..].iter().zip(values).zip(names).for_each(|((cell, value), name)| hold(cell, value, name, 0.0, "zone"));
                    if let Some(end) = zone["to"].as_f64() {
                        let words: Vec<&str> = row[0].split_whitespace().collect();
                        hold(words[words.len() - 2], end, length, 0.0, "end of a zone");
                    }
                }
            }
        }
    }
}

#[test]
fn the_cost_of_an_assumption_is_what_it_adds() {
    let mut cases: Vec<Value> = CRUSHED.map(case).into();
    cases.extend(references("crush.jsonl").iter().map(|reference| reference["case"].clone()));
    for case in cases {
        let planar = &document("crash3", &case, &[])["planar"];
        let of = |name: &str, place: &str| number(planar[name].pointer(place).unwrap_or_else(|| panic!("{name}{place}")));
        for name in ASSUMPTIONS {
            for place in ["/loss", "/delta_v_magnitude/0", "/delta_v_magnitude/1"] {
                let want = of(name, place) - of("planar", place);
                close(of(name, &format!("/cost{place}")), want, 1e-9 * of("planar", place).abs(), &format!("{name}{place}"));
            }
        }
    }
    // A common velocity excludes the rebound: ΔV is smaller by √((1 − e)/(1 + e)) in a central impact, and nearly so here.
    let found = document("crash3", &case("stiff-corner.toml"), &[]);
    let of = |name: &str| number(&found["planar"][name]["delta_v_magnitude"][0]);
    close(of("common_velocity") / of("planar"), (0.92_f64 / 1.08).sqrt(), 1e-2, "common velocity");
    assert!(number(&found["planar"]["common_velocity"]["cost"]["delta_v_magnitude"][0]) < -1.0);
}

#[test]
fn the_page_of_crash3() {
    for case in CRUSHED.map(case) {
        let found = document("crash3", &case, &[]);
        for units in ["us", "si"] {
            let tables = tables(&page("crash3", &case, units));
            for i in [0, 1] {
                let is_barrier = case["vehicle"][i]["barrier"] == true;
                let surface = &tables[0].rows[0];
                assert_eq!(surface[1 + i], found["vehicles"][i]["surface"].as_str().unwrap_or("fixed"));
                let rows = &tables[0].rows[1..];
                assert_eq!(rows.len(), CRASH3.len() + 2);
                for (row, place) in rows.iter().zip(CRASH3) {
                    let cell = &row[row.len() - 2 + i];
                    // A pure number has no unit, so its label is in the column of the unit.
                    let name = match place {
                        "/correction" | "/effective_mass_factor" => "",
                        _ => row[row.len() - 3].as_str(),
                    };
                    match is_barrier {
                        true => assert_eq!(cell, "fixed"),
                        false => hold_value(cell, found["vehicles"][i].pointer(place).expect(place), name, 1.0, place),
                    }
                }
                for (row, name) in rows[CRASH3.len()..].iter().zip(["velocity.x", "velocity.y"]) {
                    let inputs = &document("gradient", &case, &["--of", "T_L"])["wrt"];
                    match inputs[format!("vehicle.{}.{name}", i + 1)].as_f64() {
                        Some(value) => hold(&row[row.len() - 2 + i], value, &row[row.len() - 3], 1.0, name),
                        None => assert_eq!(row[row.len() - 2 + i], "fixed"),
                    }
                }
            }
            let (head, rows) = (&tables[1].head, &tables[1].rows);
            let name = |at: usize| head[at].split_once(' ').expect("a unit").1;
            let planar = &found["planar"]["planar"];
            for (row, with) in rows.iter().zip(ASSUMPTIONS.map(|name| &found["planar"][name])) {
                let share = |cell: &str, got: &Value, of: &Value| {
                    let told: f64 = cell.trim_end_matches(" %").parse().expect("a share");
                    close(told, 100.0 * (number(got) / number(of) - 1.0), 0.0500001, "share");
                };
                hold_value(&row[1], &with["loss"], name(1), 0.0, "loss");
                share(&row[2], &with["loss"], &planar["loss"]);
                for i in [0, 1] {
                    match case["vehicle"][i]["barrier"] == true {
                        true => assert_eq!(row[3 + i], "fixed"),
                        false => hold_value(&row[3 + i], &with["delta_v_magnitude"][i], name(2 + i), 0.0, "delta-V"),
                    }
                }
                let moves = usize::from(case["vehicle"][0]["barrier"] == true);
                share(&row[5], &with["delta_v_magnitude"][moves], &planar["delta_v_magnitude"][moves]);
            }
            assert_eq!(rows.len(), ASSUMPTIONS.len());
        }
    }
}

#[test]
fn the_answers_of_solve_are_those_of_the_verbs() {
    for case in CRUSHED.map(case) {
        let [solved, crush, crash3] = ["solve", "crush", "crash3"].map(|verb| document(verb, &case, &[]));
        for i in [0, 1].into_iter().filter(|i| case["vehicle"][*i]["barrier"] != true) {
            let vehicle = &solved["vehicles"][i];
            for key in ["crush_energy", "equivalent_energy_speed", "mean_depth"] {
                assert_eq!(vehicle[key], crush["vehicles"][i][key], "{key}");
            }
            for (key, value) in vehicle["crash3"].as_object().expect("an object") {
                let want = number(&crash3["vehicles"][i][key]);
                close(number(value), want, 1e-12 * want.abs(), key);
            }
        }
    }
}
