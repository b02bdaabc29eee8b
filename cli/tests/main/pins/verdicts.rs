//! Derived statements of `reconstruct`: verdicts by definition, and diagnostics by hand.

use serde_json::{Value, json};

use super::units::{printed, tables, unit};
use super::{array, case, close, differences, document, number, object, references};
use crate::process::run_with_input;

/// Below this probability, chance does not explain the residuals.
const CONTRADICTION: f64 = 1e-3;

#[test]
fn each_verdict_by_its_definition() {
    for reference in references("reconstruct.jsonl") {
        let found = document("reconstruct", &reference["case"], &[]);
        let want = if number(&found["probability"]) < CONTRADICTION { "contradicted" } else { "agrees" };
        assert_eq!((&found["verdict"], array(&found["solutions"]).len()), (&json!(want), usize::from(want == "agrees")));
        assert_eq!((&found["without_bounds"], &found["not_determined"]), (&Value::Null, &json!([])));
    }
}

#[test]
fn the_headline_has_chi_square_and_its_probability() {
    for reference in references("reconstruct.jsonl") {
        let found = document("reconstruct", &reference["case"], &[]);
        let page = run_with_input(&["reconstruct", "-"], &reference["case"].to_string()).out;
        let head = page.split("\n\n").nth(1).expect("a headline");
        let numbers: Vec<(f64, f64)> = head.split_whitespace().filter_map(|word| printed(word.trim_end_matches(['.', ',', ';']))).collect();
        // In this order. A tiny number is printed as less than a limit; there is no probability if chi-square is 0.
        let mut rest = numbers.iter();
        for key in ["chi_square", "degrees_of_freedom", "probability"] {
            let want = number(&found[key]);
            let is_told =
                |(told, half): &&(f64, f64)| (told - want).abs() <= half * (1.0 + 1e-6) && (*half <= 0.06 * want.abs() || *told == want);
            if want > 1e-9 && (key != "probability" || number(&found["chi_square"]) > 1e-9) {
                assert!(rest.any(|number| is_told(&number)), "{key} {want}: {head}");
            }
        }
    }
}

#[test]
fn several_solutions_stand_side_by_side() {
    let case = json!({ "schema": 1, "vehicle": [
        { "mass": "1200 kg", "yaw_inertia": "2000 kg m^2", "heading": "0 deg", "impact_center": ["2 m", "0 m"] }, { "barrier": true }],
        "contact": { "crush_plane": "0 deg", "restitution": 0.1 },
        "evidence": { "crush_energy": "50000 J ± 2000 J", "vehicle": { "1": { "separation_speed": "4 m/s ± 0.2 m/s" } } },
        "unknown": { "vehicle": { "1": { "velocity": { "x": { "start": "10 m/s" }, "y": { "start": "1 m/s" } } } } } });
    let solutions = document("reconstruct", &case, &[])["solutions"].clone();
    for units in ["us", "si"] {
        let tables = tables(&run_with_input(&["reconstruct", "-", "--units", units], &case.to_string()).out);
        let beside = tables.iter().find(|table| table.head.len() == 4 && table.rows.len() == 4).expect("a table of solutions");
        for row in &beside.rows[..2] {
            for (cell, solution) in row[1..3].iter().zip(array(&solutions)) {
                let (want, (told, half)) = (number(&solution["unknown"][&row[0]]) / unit(&row[3]), printed(cell).expect("a number"));
                close(told, want, half * (1.0 + 1e-6), &row[0]);
            }
        }
        for (row, key) in beside.rows[2..].iter().zip(["chi_square", "probability"]) {
            for (cell, solution) in row[1..3].iter().zip(array(&solutions)) {
                let (told, half) = printed(cell).expect("a number");
                close(told, number(&solution[key]), half, key);
            }
        }
    }
}

/// Returns position A with a speed bound of 11 m/s, which the evidence exceeds.
pub(super) fn out_of_bounds() -> Value {
    let mut case = references("reconstruct.jsonl")[0]["case"].clone();
    case["evidence"]["crush_energy"]["sd"] = json!("500 J");
    case["unknown"]["vehicle"]["1"]["speed"] = json!({ "start": "10 m/s", "min": "0 m/s", "max": "11 m/s" });
    case
}

#[test]
fn without_its_bounds_it_is_the_case_without_them() {
    let mut case = out_of_bounds();
    let found = document("reconstruct", &case, &[]);
    assert_eq!((&found["verdict"], &found["solutions"]), (&json!("bounds exclude"), &json!([])));
    assert_eq!(
        (&found["unknown"]["vehicle.1.speed"]["at_bound"], &found["unknown"]["vehicle.1.speed"]["value"]),
        (&json!("max"), &json!(11.0))
    );
    case["unknown"]["vehicle"]["1"]["speed"] = json!({ "start": "10 m/s" });
    case["unknown"]["vehicle"]["2"]["speed"] = json!({ "start": "13 m/s" });
    let free = document("reconstruct", &case, &[]);
    let mut faults = Vec::new();
    let of = &found["without_bounds"];
    for (name, unknown) in object(&free["unknown"]) {
        differences(&of["unknown"][name], &unknown["value"], 1e-7, name, &mut faults);
    }
    for key in ["chi_square", "degrees_of_freedom", "probability"] {
        differences(&of[key], &free[key], 1e-6, key, &mut faults);
    }
    assert!(faults.is_empty() && number(&of["searches"]) >= 1.0, "{}", faults.join("\n"));
}

#[test]
fn the_figures_of_the_questions_by_hand() {
    let found = document("reconstruct", &case("reconstruct/two-cars.toml"), &[]);
    let contact = &found["solution"]["contact"];
    let at = |place: &str| number(contact.pointer(place).unwrap_or_else(|| panic!("{place}")));
    // The force at the end of a crush, A w + B ∫ C dx over its equally spaced depths, and the component along the surface.
    let slant = at("/impulse/normal").hypot(at("/impulse/tangential")) / at("/impulse/normal").abs();
    let area = |width: f64, depths: [f64; 6]| width / 5.0 * (depths.iter().sum::<f64>() - (depths[0] + depths[5]) / 2.0);
    let areas = [area(1.4, [0.09, 0.17, 0.26, 0.36, 0.44, 0.48]), area(1.3, [0.47, 0.42, 0.32, 0.20, 0.10, 0.05])];
    let (laws, widths) = ([(60e3, 500e3), (55e3, 560e3)], [1.4, 1.3]);
    let forces = [0, 1].map(|i| slant * (laws[i].0 * widths[i] + laws[i].1 * areas[i]));
    // The ratio of the energies to those in proportion to the slopes B w.
    let energies = [0, 1].map(|i| number(&found["solution"]["vehicles"][i]["crush_energy"]));
    let odds = energies[0] * laws[0].1 * widths[0] / (energies[1] * laws[1].1 * widths[1]);
    let left = at("/separation/normal").hypot(at("/separation/tangential")) / at("/approach/normal").hypot(at("/approach/tangential"));
    let e = at("/restitution");
    let most = |value: f64| json!({ "at_most": value });
    let between = |least: f64, most: f64| json!({ "between": [least, most] });
    // Two standard deviations, each of 12.6 deg, of the difference of two angles.
    let opposite = (2.0 * 12.6 * 2_f64.sqrt()).to_radians();
    let want = [
        (Some((forces[0] - forces[1]) / forces[1]), most(1.0), "within"),
        (None, most(opposite), "not checked"),
        (Some(1.0), json!("same_sign"), "within"),
        (Some(1.0), json!("same_sign"), "within"),
        (Some(left), most(0.1), "within"),
        (Some(odds), between(0.25, 4.0), "within"),
        (Some(e), between(0.0, 0.3), "within"),
        (Some(e), most(0.3), "within"),
        (Some(1.0), between(0.9, 1.0), "within"),
    ];
    let questions = array(&found["diagnostics"]);
    assert_eq!(questions.len(), want.len());
    for (question, (figure, limit, reading)) in questions.iter().zip(want) {
        match figure {
            Some(figure) => close(number(&question["figure"]), figure, 1e-9 * figure.abs(), &question.to_string()),
            None => assert_eq!(question["figure"], Value::Null),
        }
        let mut faults = Vec::new();
        differences(&question["limit"], &limit, 1e-12, "limit", &mut faults);
        assert!(faults.is_empty() && question["reading"] == reading, "{question}: {faults:?}");
    }
    // Forces are printed in whole kilonewtons.
    let told = questions[0]["meaning"].as_str().expect("words");
    assert!(forces.iter().all(|force| told.contains(&format!("{:.0} kN", force / 1e3))), "{told}: {forces:?}");
    // In every answer, the reading follows from the figure and the limit.
    let cases = references("reconstruct.jsonl").into_iter().map(|reference| reference["case"].clone());
    for case in cases.chain([out_of_bounds()]) {
        for question in array(&document("reconstruct", &case, &[])["diagnostics"]) {
            let (figure, limit) = (question["figure"].as_f64(), &question["limit"]);
            let is_within = figure.map(|figure| match (limit["at_most"].as_f64(), limit["between"].as_array()) {
                (Some(most), _) => figure <= most,
                (_, Some(ends)) => (number(&ends[0]) - 1e-9..=number(&ends[1]) + 1e-9).contains(&figure),
                _ => figure >= 0.0,
            });
            assert_eq!(
                question["reading"],
                is_within.map_or("not checked", |is_within| if is_within { "within" } else { "outside" }),
                "{question}"
            );
        }
    }
}
