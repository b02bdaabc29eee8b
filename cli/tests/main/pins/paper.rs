//! `validate`: cells compared with the tables as printed, and the errors of measured tests.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde_json::{Value, json};

use super::units::{hold, tables};
use super::{array, case, close, document, number};
use crate::process::{run, workspace};

/// The tables of the paper in order, with their files.
const TABLES: [(&str, &str); 8] = [
    ("Table 1", "table1"),
    ("Table 2", "table2"),
    ("Table 3", "table3"),
    ("Table 4", "table4"),
    ("Table 5", "table5"),
    ("Table 6", "table6"),
    ("Table B1", "tableB1"),
    ("Table B2", "tableB2"),
];

/// The documents of both verbs, computed once because each takes a while.
static DOCUMENTS: LazyLock<[Value; 2]> = LazyLock::new(|| {
    ["validate", "prove"].map(|verb| {
        let run = run(&workspace(), &[verb, "--format", "json"]);
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        serde_json::from_str(&run.out).expect("JSON")
    })
});

pub(super) fn printed_by(verb: &str) -> Value {
    DOCUMENTS[usize::from(verb == "prove")].clone()
}

/// Reads the records of a data file, by column name.
fn data(name: &str) -> Vec<HashMap<String, String>> {
    let path = workspace().join("validation/data").join(format!("{name}.csv"));
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).expect("the data can be read");
    let heads: Vec<String> = reader.headers().expect("a head").iter().map(str::to_owned).collect();
    reader.records().map(|row| heads.iter().cloned().zip(row.expect("a row").iter().map(str::to_owned)).collect()).collect()
}

pub(super) fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("{key} of {value}"))
}

/// Returns half a unit of the last digit of a printed number.
fn half_digit(printed: &str) -> f64 {
    let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    0.5 * 10_f64.powi(-decimals)
}

pub(super) fn parsed(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

#[test]
fn every_cell_is_printed_and_judged_by_its_digits() {
    let found = printed_by("validate");
    let bounds = data("bounds");
    let misprints = data("misprints");
    let mut counts = HashMap::from([("agrees", 0), ("within bound", 0), ("misprint", 0)]);
    for cell in array(&found["cells"]) {
        let (printed, computed) = (parsed(text(cell, "printed")), number(&cell["computed"]));
        let (half, off) = (half_digit(text(cell, "printed")) * (1.0 + 1e-9), (number(&cell["computed"]) - printed).abs());
        *counts.get_mut(text(cell, "verdict")).expect("a verdict") += 1;
        match text(cell, "verdict") {
            "agrees" => assert!(off <= half, "{cell}"),
            "within bound" => {
                let is_of = |bound: &&HashMap<String, String>| {
                    let row = text(cell, "row");
                    let rows = &bound["rows"];
                    bound["table"] == cell["table"]
                        && bound["column"] == cell["column"]
                        && (rows == "*" || rows == row || row.split(' ').next() == Some(rows))
                };
                let bound = bounds.iter().find(|bound| is_of(bound) && bound["reason"] == cell["why"]).unwrap_or_else(|| panic!("{cell}"));
                let share = if bound["kind"] == "percent" { 0.01 * computed.abs() } else { 1.0 };
                close(number(&cell["bound"]), parsed(&bound["bound"]) * share, 1e-9 * printed.abs(), "bound");
                assert!(off > half && off <= number(&cell["bound"]) * (1.0 + 1e-9), "{cell}");
            }
            _ => {
                let listed = misprints
                    .iter()
                    .find(|listed| listed["table"] == cell["table"] && listed["printed"] == cell["printed"])
                    .expect("listed");
                assert_eq!(
                    (&json!(listed["row"]), &json!(listed["holds"]), &json!(listed["why"])),
                    (&cell["row"], &cell["holds"], &cell["why"])
                );
                // The correct value agrees to its digits, or as closely as the other cells of its column.
                close(computed, parsed(text(cell, "holds")), 2.5e-3 * printed.abs(), "what holds");
                assert!(off > half, "{cell}");
            }
        }
    }
    let of =
        |name: &str| array(&found["cells"]).iter().chain(array(&found["given"])).filter(|cell| cell["table"] == name).collect::<Vec<_>>();
    let mut all = 0;
    for (name, file) in TABLES {
        let mut fields: HashMap<String, i32> = HashMap::new();
        data(file)
            .iter()
            .flat_map(HashMap::values)
            .filter(|field| !field.is_empty())
            .for_each(|field| *fields.entry(field.clone()).or_default() += 1);
        for cell in of(name) {
            let left = fields.get_mut(text(cell, "printed")).unwrap_or_else(|| panic!("{cell} is not in the table"));
            *left -= 1;
            assert!(*left >= 0, "{cell} is in the table less often");
            assert!(!text(cell, "unit").is_empty() && !text(cell, "column").is_empty() && !text(cell, "row").is_empty());
        }
        all += of(name).len();
    }
    let given = array(&found["given"]);
    assert!(given.iter().all(|cell| ["given", "measured"].contains(&text(cell, "nature"))), "{given:?}");
    assert_eq!((all, array(&found["problems"]).len(), &found["holds"]), (array(&found["cells"]).len() + given.len(), 0, &json!(true)));
    assert_eq!(counts["misprint"], misprints.len());
    let numbers: Vec<usize> = text(&found, "summary").split([' ', ';', ',']).filter_map(|word| word.parse().ok()).collect();
    let statements = array(&found["statements"]).len();
    assert_eq!(numbers, [all, counts["agrees"], counts["within bound"], counts["misprint"], given.len(), 0, 167, 168, statements]); // validation/README.md
    for statement in array(&found["statements"]) {
        assert_eq!(statement["as_expected"], true, "{statement}");
        for key in ["name", "place", "says", "found", "standing"] {
            assert!(!text(statement, key).is_empty(), "{statement}");
        }
    }
    // Printed and correct values: Tables B2, 5 and 6, test 2.
    let chain: Vec<(&str, &str)> = array(&found["chain"]).iter().map(|link| (text(link, "printed"), text(link, "holds"))).collect();
    assert_eq!(chain, [("51334", "51334"), ("61334", "51334"), ("83.3", "69.6")]);
    assert!(
        array(&found["chain"])
            .iter()
            .all(|link| link["follows"] == true && text(link, "place").contains("test 2") && link["how"].is_string())
    );
}

#[test]
fn cells_stand_in_their_row_and_column() {
    let found = printed_by("validate");
    let columns = [
        ("Table 1", "mu_0", "mu0"),
        ("Table 1", "W_n", "Wn_ftlb"),
        ("Table 1", "W_t", "Wt_ftlb"),
        ("Table 2", "mu_0", "mu0"),
        ("Table 2", "W_n", "Wn_ftlb"),
        ("Table 2", "W_t", "Wt_ftlb"),
        ("Table 5", "test_energy", "test_crush_energy_ftlb"),
        ("Table 5", "crash3_dv", "crash3_dv_mph"),
        ("Table 5", "planar_energy", "pim_energy_ftlb"),
        ("Table B1", "T_Ln", "TLn"),
        ("Table B1", "T_Lt", "TLt"),
        ("Table B1", "omega", "omega"),
        ("Table B2", "test_E_C", "Ec_cumulative"),
        ("Table B2", "test_EES", "EES_ftps"),
        ("Table B2", "planar_dv_ftps", "pim_dv_ftps"),
    ];
    for (table, column, head) in columns {
        let file = TABLES.iter().find(|(name, _)| *name == table).expect("a table").1;
        let want: Vec<String> = data(file).into_iter().map(|row| row[head].clone()).filter(|field| !field.is_empty()).collect();
        let cells = array(&found["cells"]).iter().filter(|cell| cell["table"] == table && cell["column"] == column);
        assert_eq!(cells.map(|cell| text(cell, "printed").to_owned()).collect::<Vec<_>>(), want, "{table} {column}");
    }
    let page = run(&workspace(), &["validate"]).out;
    let shown: Vec<Vec<String>> = tables(&page).into_iter().flat_map(|table| table.rows).filter(|row| row.len() == 5).collect();
    let cells = array(&found["cells"]);
    assert!(shown.len() >= cells.len(), "{}", shown.len());
    for (row, cell) in shown.iter().zip(cells) {
        assert_eq!((row[0].as_str(), row[1].as_str(), row[2].as_str()), (text(cell, "row"), text(cell, "column"), text(cell, "printed")));
        close(parsed(&row[3]), number(&cell["computed"]), 0.1001 * half_digit(&row[2]), "computed");
        assert!(row[4].starts_with(text(cell, "verdict")), "{row:?}");
    }
}

/// Recomputes and checks the error and percentage of a reading.
fn hold_error(of: &Value, measured: f64, what: &str) {
    let error = number(&of["computed"]) - measured;
    close(number(&of["error"]), error, 1e-9 * measured.abs(), what);
    close(number(&of["percent"]), 100.0 * error / measured, 1e-9, what);
}

/// Momentum of one axis each, a common velocity, two that slide together, and ΔV = (1 + e) v m'/(m + m').
#[test]
fn worked_examples_are_those_by_hand() {
    let gravity = 9.80665;
    let along = 45.0 * 0.5_f64.sqrt();
    let together = 1.2 * 5.5 / (950.0 + 770.0);
    let by_hand = [
        ("intersection", "speed 1", 14.0 + 3875.0 / 4220.0 * 12.0),
        ("intersection", "speed 2", 4220.0 / 3875.0 * 16.0 + 19.0),
        ("locked", "speed after", f64::hypot(-3.0 * along + 60.0, 3.0 * along) / 5.0),
        ("pushed", "speed 1", 3300.0 / 900.0 * f64::sqrt(2.0 * gravity * 0.40 * 4.6)),
        ("GBB", "delta-V 1", together * 770.0),
        ("GBB", "delta-V 2", together * 950.0),
    ];
    let found = printed_by("validate")["measured"]["worked"].clone();
    assert_eq!(array(&found).len(), by_hand.len());
    for ((worked, row), (example, quantity, want)) in array(&found).iter().zip(data("worked")).zip(by_hand) {
        assert_eq!((&worked["example"], &worked["quantity"]), (&json!(example), &json!(quantity)));
        assert_eq!(
            (&worked["unit"], &worked["measured"], &worked["source"]),
            (&json!(row["unit"]), &json!(row["published"]), &json!(row["source"]))
        );
        close(number(&worked["computed"]), want, 1e-8 * want, example);
        hold_error(worked, parsed(&row["published"]), example);
        let is_staged = !row["recorded"].is_empty();
        assert_eq!(worked["recorded_percent"], if is_staged { json!(parsed(&row["recorded"])) } else { Value::Null });
        let percent = number(&worked["percent"]);
        close(percent, 100.0 * (want / parsed(&row["published"]) - 1.0), 1e-6, example);
        assert_eq!((&worked["holds"], &worked["within_digits"]), (&json!(true), &json!(!is_staged)));
    }
}

#[test]
fn measured_tests_are_those_of_solve_and_stiffness() {
    let found = printed_by("validate")["measured"].clone();
    let mut squares: HashMap<String, Vec<f64>> = HashMap::new();
    for (test, row) in array(&found["small_overlap"]).iter().zip(data("iihs")) {
        assert_eq!((&json!(row["test"]), &json!(row["reason"])), (&test["test"], &test["reason"]));
        let phi = parsed(&row["phi_deg"]).to_radians();
        let ahead = |along: f64| format!("{} ft", parsed(&row["d_ft"]) * along);
        let mut solved = json!({ "schema": 1, "vehicle": [
            { "mass": format!("{} lb", row["car_lb"]), "yaw_inertia": format!("{} slug ft^2", row["yaw_inertia_slugft2"]), "heading": "0 deg",
              "speed": format!("{} ft/s", row["v_ftps"]), "impact_center": [ahead(phi.cos()), ahead(-phi.sin())] },
            { "barrier": true }],
            "contact": { "crush_plane": format!("-{} deg", row["gamma_deg"]), "restitution": parsed(&row["e"]), "impulse_ratio": { "of_critical": parsed(&row["share"]) } } });
        for (law, place) in [("brach", ""), ("kudlich-slibar", "/kudlich_slibar")] {
            solved["contact"]["tangential_law"] = json!(law);
            let car = document("solve", &solved, &[])["vehicles"][0].clone();
            // Clockwise is positive in the data.
            let want = [
                ("delta_v", "dv", number(&car["delta_v_magnitude"]) / 0.3048),
                ("yaw_rate", "yaw", -number(&car["yaw_rate"]).to_degrees()),
            ];
            for (key, column, want) in want {
                let of = test.pointer(&format!("/{key}{place}")).expect("a reading");
                let head = if key == "delta_v" { "dv_ftps" } else { "yaw_degps" };
                close(number(&of["computed"]), want, 1e-4 * want.abs(), key);
                hold_error(of, parsed(&row[head]), key);
                for part in ["error", "percent"] {
                    squares.entry(format!("/{}/{key}/{part}", law.replace('-', "_"))).or_default().push(number(&of[part]).powi(2));
                }
                let reading = &test[key];
                assert_eq!(
                    (&json!(row[head]), reading["recorded_percent"].as_f64()),
                    (&reading["measured"], row[&format!("{column}_recorded")].parse().ok())
                );
                assert_eq!(reading["unit"], if key == "delta_v" { "ft/s" } else { "deg/s" });
                let within = (number(&reading["computed"]) - parsed(&row[head])).abs() <= half_digit(&row[head]);
                assert_eq!(reading["within_digits"], within);
            }
        }
        assert_eq!(test["turns_as_measured"], number(&test["yaw_rate"]["computed"]) * parsed(&row["yaw_degps"]) > 0.0);
    }
    for (place, all) in squares {
        let got = number(found["small_overlap_root_mean_square"].pointer(&place).unwrap_or_else(|| panic!("{place}")));
        close(got, (all.iter().sum::<f64>() / all.len() as f64).sqrt(), 1e-9, &place);
    }
    let (frontal, row) = (&found["full_frontal"][0], &data("nhtsa")[0]);
    let alone = &document("stiffness", &case("tests/malibu.toml"), &[])["tests"][0];
    let line = &alone["on_mean_depth"];
    for coefficient in array(&frontal["coefficients"]) {
        let name = text(coefficient, "name");
        close(number(&coefficient["computed"]), number(&line[name]), 1e-9 * number(&line[name]), name);
        let published = [("b1", "b1_1ps"), ("A", "A_Npm"), ("B", "B_Npm2")]
            .into_iter()
            .find(|(known, _)| *known == name)
            .map(|(_, head)| row[head].as_str());
        assert_eq!(coefficient["published"].as_str(), published);
        let unit =
            [("b1", "1/s"), ("A", "N/m"), ("B", "N/m^2"), ("d0", "N^0.5"), ("d1", "N^0.5/m")].into_iter().find(|(known, _)| *known == name);
        assert_eq!(unit.map(|(_, unit)| unit), coefficient["unit"].as_str());
    }
    let [mass, speed, width] = ["mass_kg", "speed_mps", "width_m"].map(|head| parsed(&row[head]));
    let depths: Vec<f64> = row["depths_m"].split(' ').map(parsed).collect();
    let pieces = || depths.windows(2).map(|pair| (pair[0], pair[1]));
    let count = (depths.len() - 1) as f64;
    // Means of the depth and of its square, linear between stations.
    let mean = pieces().map(|(a, b)| (a + b) / 2.0).sum::<f64>() / count;
    let square = pieces().map(|(a, b)| (a * a + a * b + b * b) / 3.0).sum::<f64>() / count;
    let (d0, d1) = (number(&line["d0"]), number(&line["d1"]));
    let energy = width / 2.0 * (d0 * d0 + 2.0 * d0 * d1 * mean + d1 * d1 * square);
    let reading = &frontal["crush_energy"];
    for (got, want, what) in [
        (&frontal["mean_depth"], mean, "mean depth"),
        (&reading["computed"], energy, "energy of the profile"),
        (&frontal["unevenness"], width / 2.0 * d1 * d1 * (square - mean * mean), "unevenness"),
        (&frontal["speed_of_crush"], (2.0 * energy / mass).sqrt(), "speed of the crush"),
        (&reading["by_profile"]["computed"], mass * speed * speed / 2.0, "energy by the profile's own stiffness"),
    ] {
        close(number(got), want, 1e-9 * want, what);
    }
    assert_eq!(text(reading, "measured"), format!("{:.1}", mass * speed * speed / 2.0));
    hold_error(reading, parsed(text(reading, "measured")), "crush energy");
    hold_error(&reading["by_profile"], parsed(text(reading, "measured")), "by profile");
    assert_eq!(
        (reading["recorded_percent"].as_f64(), &reading["unit"], &reading["within_digits"]),
        (row["energy_recorded"].parse().ok(), &json!("J"), &json!(false))
    );
    for (key, head) in [("test", "test"), ("vehicle", "vehicle"), ("speed", "speed_mps"), ("reason", "reason")] {
        assert_eq!(frontal[key], json!(row[head]), "{key}");
    }
    hold(
        &format!("{:.4}", number(&frontal["mean_depth"])),
        0.4491,
        "m",
        0.0,
        "by hand: half of 0.265 and 0.310, and four between, over five gaps",
    );
}
