//! The output of `reconstruct`: the document by key, the text by line.

use serde_json::Value;

use super::{WALL, answer, example, number, text, two_cars};
use crate::process::{run, run_with_input, workspace};

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

/// A number of the case that the evidence gives with ± does not count; a warning names it if it is another one.
#[test]
fn a_number_of_the_case_that_the_evidence_replaces_is_told() {
    let case = two_cars();
    let with = |speed: &str| answer(&case.replace("name = \"hatchback\"\n", &format!("name = \"hatchback\"\nspeed = \"{speed}\"\n")));
    for (speed, is_told) in [("41 km/h", false), ("40.5 km/h", false), ("60 mph", true), ("38 km/h", true)] {
        let (found, _) = with(speed);
        assert_eq!(found["messages"].to_string().contains("\"evidence-differs\""), is_told, "{speed}: {}", found["notes"]);
    }
    let (found, _) = with("60 mph");
    assert!(
        found["notes"].to_string().contains("vehicle.2.speed is 26.82 m/s in the case and 11.39 m/s by the evidence"),
        "{}",
        found["notes"]
    );
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

#[test]
fn a_piece_that_was_given_as_exact_is_found_to_be_furthest_off() {
    let case = |pdof: &str, delta_v: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0.3]\n[[vehicle]]\nbarrier = true\n\
             [contact]\ncrush_plane = 0\nrestitution = 0.1\n[evidence]\nvehicle.1.delta_v_magnitude = \"{delta_v}\"\nvehicle.1.pdof = \"{pdof}\"\n\
             [unknown]\nvehicle.1.speed = {{ start = 15, min = 0, max = 40 }}\n"
        )
    };
    // The direction is −6.04 deg whatever the speed.
    let page =
        |pdof: &str, delta_v: &str| run_with_input(&["reconstruct", "-", "--brief"], &case(pdof, delta_v)).out.replace("\n    ", " ");
    let exact = page("10 deg", "10 m/s ± 0.5 m/s");
    assert!(
        exact.contains("Furthest off is vehicle.1.pdof: given 10.0 deg, computed -6.0 deg, although it was given as exact."),
        "{exact}"
    );
    assert!(exact.contains("Next: re-examine that piece, and give its standard deviation first,"), "{exact}");
    let uncertain = page("10 deg ± 1 deg", "10 m/s");
    assert!(
        uncertain.contains("Furthest off is vehicle.1.pdof: given 10.0 deg, computed -6.0 deg, 16.0 standard deviations apart."),
        "{uncertain}"
    );
    assert!(uncertain.contains("Next: re-examine that piece and its standard deviation first,"), "{uncertain}");
    let document = answer(&case("10 deg", "10 m/s ± 0.5 m/s")).0;
    assert_eq!(document["furthest_off"]["name"], "vehicle.1.pdof");
}

#[test]
fn exact_evidence_has_values_and_no_intervals_on_the_page() {
    let path = "cli/examples/reconstruct/crabbed-1.toml";
    let page = run(&workspace(), &["reconstruct", path, "--brief"]).out;
    assert!(page.contains("No piece of evidence has an uncertainty"), "{page}");
    assert!(!page.contains("95 % from 1") && page.lines().any(|line| line == "- vehicle.1.velocity.x (Cavalier): 10.1 mph."), "{page}");
    let row = page.lines().find(|line| line.starts_with("energy.tangential_work")).expect("a row");
    assert_eq!(row.split_whitespace().collect::<Vec<_>>(), ["energy.tangential_work", "-1758", "-", "-", "-", "ft", "lb"]);
}

#[test]
fn what_is_of_the_first_separation_alone_is_said_to_be() {
    let path = "cli/examples/reconstruct/several-separations.toml";
    let page = |more: &[&str]| run(&workspace(), &[&["reconstruct", path, "--brief"], more].concat()).out.replace("\n    ", " ");
    let plain = page(&[]);
    assert!(plain.contains("Warning: the intervals are those of the first separation alone;"), "{plain}");
    assert!(plain.contains("answer from separation"), "the answers are listed");
    let drawn = page(&["--probability", "vehicle.1.speed > 70 km/h"]);
    assert!(drawn.contains("Warning: the intervals, posterior and probabilities are those of the first separation alone;"), "{drawn}");
    let one = run(&workspace(), &["reconstruct", "cli/examples/reconstruct/two-cars.toml", "--brief"]).out;
    assert!(!one.contains("first separation alone"), "{one}");
}

#[test]
fn an_angle_that_is_rounding_is_none() {
    let car = |heading: &str| {
        format!("[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"{heading}\"\nspeed = \"50 km/h\"\nimpact_center = [2, 0]\n")
    };
    let case = format!("schema = 1\n{}{}[contact]\ncrush_plane = 0\nrestitution = 0.1\n", car("0 deg"), car("180 deg"));
    let page = run_with_input(&["solve", "-"], &case).out.replace("\n    ", " ");
    assert_eq!(page.matches("principal direction of force 0 deg;").count(), 2, "{page}");
}
