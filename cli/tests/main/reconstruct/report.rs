//! The output of `reconstruct`: the document by key, the text by line.

use serde_json::Value;

use super::{WALL, answer, example, number, text, two_cars};

/// The keys that other tools rely on.
const KEYS: [&str; 9] =
    ["converged", "iterations", "unknown", "covariance", "evidence", "chi_square", "degrees_of_freedom", "not_determined", "solution"];

#[test]
fn the_document_has_every_key_and_they_fit_together() {
    let (found, status) = answer(&two_cars());
    assert_eq!(status, 0);
    assert!(KEYS.iter().all(|key| found.get(key).is_some()), "{found}");
    assert_eq!((&found["converged"], &found["not_determined"]), (&Value::from(true), &Value::Array(Vec::new())));
    let unknown = found["unknown"].as_object().expect("a table");
    let names: Vec<&String> = unknown.keys().collect();
    assert_eq!(
        names,
        ["contact.crush_plane", "contact.restitution", "vehicle.1.speed", "vehicle.2.speed"],
        "of the file, and what evidence adds"
    );
    for (one, estimate) in unknown {
        let sd = number(&estimate["sd"]);
        assert!((number(&found["covariance"][one][one]) / sd.powi(2) - 1.0).abs() < 1e-12);
        assert_eq!(estimate["at_bound"], Value::Null);
        for other in &names {
            let product = sd * number(&unknown[*other]["sd"]) * number(&found["correlation"][one][*other]);
            let covariance = number(&found["covariance"][one][*other]);
            assert!((product - covariance).abs() <= 1e-9 * covariance.abs(), "{one} {other}");
        }
    }
    let mut chi_square = 0.0;
    for (name, piece) in found["evidence"].as_object().expect("a table") {
        let z = number(&piece["standardised_residual"]);
        assert!((z * number(&piece["sd"]) - number(&piece["given"]) + number(&piece["computed"])).abs() < 1e-6, "{name}");
        chi_square += z * z;
        // The variance of an unknown combines those of the evidence.
        assert!(found["influence"]["vehicle.1.speed"][name].is_number());
    }
    assert!((chi_square - number(&found["chi_square"])).abs() < 1e-9);
    // A recorder with steps of 1 km/h: a step divided by √12.
    let step = number(&found["evidence"]["vehicle.2.speed"]["sd"]);
    assert!((step - 1.0 / 3.6 / 12_f64.sqrt()).abs() < 1e-15);
    // The sum of both crush energies, and a tenth of it.
    let energies: f64 = (0..2).map(|i| number(&found["solution"]["vehicles"][i]["crush_energy"])).sum();
    assert!((number(&found["evidence"]["crush_energy"]["given"]) / energies - 1.0).abs() < 1e-12);
    assert!((number(&found["evidence"]["crush_energy"]["sd"]) / energies - 0.1).abs() < 1e-12);
    assert_eq!(found["diagnostics"].as_array().map(Vec::len), Some(9), "eight questions, one of them of each vehicle");
    assert!(found["crash3"]["planar"]["together"].is_object() && found["crash3"]["vehicles"][1]["delta_v_magnitude"].is_number());
    assert!(found["notes"].to_string().contains("vehicle.2.speed is solved for too"), "{}", found["notes"]);
}

#[test]
fn the_variance_of_an_unknown_is_made_of_those_of_the_evidence() {
    let (found, _) = answer(&example("position-a.toml"));
    let rows = found["influence"].as_object().expect("a table");
    assert_eq!(rows.len(), 2);
    for (unknown, row) in rows {
        let parts = row.as_object().expect("a table").iter();
        let variance: f64 = parts.map(|(name, by)| (number(by) * number(&found["evidence"][name]["sd"])).powi(2)).sum();
        assert!((variance / number(&found["covariance"][unknown][unknown]) - 1.0).abs() < 1e-9, "{unknown}");
    }
}

#[test]
fn the_text_fits_a_terminal_in_either_units() {
    for case in ["position-a.toml", "crabbed-1.toml"].map(example).into_iter().chain([two_cars(), WALL.to_owned()]) {
        let usual = text(&case, &[]).out;
        let [us, si] = ["us", "si"].map(|units| text(&case, &["--units", units]).out);
        assert!(usual == us || usual == si, "the default units are those of the file");
        assert!(us.contains(" ft/s") && us.contains(" mph") && !us.contains(" km/h"), "{us}");
        assert!(si.contains(" m/s") && si.contains(" km/h") && !si.contains(" mph"), "{si}");
        for line in us.lines().chain(si.lines()) {
            assert!(line.chars().count() <= 80 && line.trim_end() == line, "{line:?}");
        }
    }
    let said = text(&two_cars(), &[]).out;
    for words in
        ["The evidence agrees with one solution", "95 % from", "Residual: ", "Correlated: vehicle.1.speed", "seed 1", "CRASH3", "PDOF"]
    {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn the_same_seed_gives_the_same_answer() {
    let with = |arguments: &[&str]| text(WALL, &[&["--format", "json"], arguments].concat()).out;
    assert_eq!(with(&[]), with(&["--starts", "64", "--seed", "1"]));
    let found: Value = serde_json::from_str(&with(&["--starts", "9", "--seed", "7"])).expect("JSON");
    // Nine searches from the starts, and four near each of the two solutions.
    assert_eq!((&found["searches"], &found["seed"]), (&Value::from(9 + 2 * 4), &Value::from(7)));
    let said = text(WALL, &["--starts", "9", "--seed", "7"]).out;
    assert!(said.contains("17 searches from 9 starts (--starts), drawn with seed 7 (--seed)"), "{said}");
}
