//! The posterior, beside six cases of an independent computation (`cli/tests/reference/posterior`), and the forms in which it is asked for.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{answer, example, number, replaced, text, two_cars};
use crate::process::workspace;

/// Statistics of the reference by quantity, of each case.
fn reference() -> BTreeMap<String, BTreeMap<String, Vec<(String, f64)>>> {
    let path = workspace().join("cli/tests/reference/posterior/posterior.csv");
    let mut cases: BTreeMap<String, BTreeMap<String, Vec<(String, f64)>>> = BTreeMap::new();
    for record in csv::Reader::from_path(path).expect("the reference").into_records() {
        let record = record.expect("a line");
        let value = record[3].parse().expect("a number");
        cases.entry(record[0].to_owned()).or_default().entry(record[1].to_owned()).or_default().push((record[2].to_owned(), value));
    }
    cases
}

fn case(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/tests/reference/posterior").join(format!("{name}.toml"))).expect("a case")
}

fn document(case: &str, arguments: &[&str]) -> Value {
    let run = text(case, &[&["--format", "json"], arguments].concat());
    assert!((0..=1).contains(&run.status), "{}", run.err);
    serde_json::from_str(&run.out).expect("JSON")
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().expect("an array").iter().map(number).collect()
}

/// Fails unless a share of draws is a probability to five standard errors.
#[track_caller]
fn hold_share(share: f64, probability: f64, independent: f64, what: &str) {
    let error = (probability * (1.0 - probability) / independent).sqrt();
    assert!((share - probability).abs() < 5.0 * error, "{what}: {share} for {probability}, standard error {error}");
}

#[test]
fn draws_are_distributed_as_an_independent_computation_says() {
    let cases = reference();
    assert_eq!(cases.keys().collect::<Vec<_>>(), ["bound", "fold", "open", "regular", "shapes", "two-modes"]);
    for (name, quantities) in &cases {
        let statements: Vec<&str> = quantities.keys().filter(|quantity| quantity.contains(' ')).map(String::as_str).collect();
        assert_eq!(statements.len(), 1, "{name}");
        let found = document(&case(name), &["--posterior", "--draws", "--probability", statements[0]]);
        let summary = &found["posterior"];
        assert!(number(&summary["r_hat"]) < 1.01 && number(&summary["ess"]) > 1000.0, "{name}: {summary}");
        assert_eq!((&summary["chains"], &summary["draws"], &summary["seed"]), (&4.into(), &1000.into(), &1.into()));
        for (of, statistics) in quantities {
            let what = |statistic: &str| format!("{name}, {of}, {statistic}");
            if of == statements[0] {
                hold_share(number(&found["probabilities"][of]), statistics[0].1, number(&summary["ess"]), of);
                continue;
            }
            let whole = if found["unknown"].get(of).is_some() { &found["unknown"][of] } else { &found["derived"][of] };
            let posterior = &whole["posterior"];
            let mut draws = numbers(&summary["values"][of]);
            draws.sort_by(f64::total_cmp);
            assert_eq!(draws.len(), 4000, "{}", what("draws"));
            let independent = number(&posterior["ess"]);
            let below = |x: f64| draws.partition_point(|draw| *draw <= x) as f64 / draws.len() as f64;
            let of_reference = |wanted: &str| statistics.iter().find(|(statistic, _)| statistic == wanted).map(|(_, value)| *value);
            let sd = of_reference("sd").expect("every quantity has one");
            let error = sd / independent.sqrt();
            for (statistic, value) in statistics {
                let what = what(statistic);
                if let Some(share) = statistic.strip_prefix('q') {
                    hold_share(below(*value), share.parse().expect("a share"), independent, &what);
                    // Between the draws beside it.
                    let place = share.parse::<f64>().expect("a share") * 3999.0;
                    let [low, high] = [place.floor(), place.ceil()].map(|place| draws[place as usize]);
                    let quantile = low + (place - place.floor()) * (high - low);
                    assert!((number(&posterior["quantiles"][share]) - quantile).abs() <= 1e-12 * quantile.abs(), "{what}");
                    continue;
                }
                let interval = || number(&whole["interval"]["high"]) - number(&whole["interval"]["low"]);
                let (found, within) = match statistic.as_str() {
                    "mean" => (number(&posterior["mean"]), 5.0 * error),
                    // The fourth moment of a skew posterior is up to eight times that of a normal one.
                    "sd" => (number(&posterior["sd"]), 10.0 * error),
                    "hdi_low" => (number(&posterior["hdi"][0]), 0.3 * sd),
                    "hdi_high" => (number(&posterior["hdi"][1]), 0.3 * sd),
                    "profile_low" => (number(&whole["interval"]["low"]), 3e-4 * interval()),
                    "profile_high" => (number(&whole["interval"]["high"]), 3e-4 * interval()),
                    other => panic!("{other}"),
                };
                assert!((found - value).abs() < within, "{what}: {found} for {value}, within {within}");
            }
            // Its ends are known less well than its width and what it contains.
            let [low, high] = ["hdi_low", "hdi_high"].map(|end| of_reference(end).expect("every quantity has one"));
            hold_share(below(high) - below(low), 0.95, independent, &what("hdi"));
            let hdi = numbers(&posterior["hdi"]);
            assert!(((hdi[1] - hdi[0]) / (high - low) - 1.0).abs() < 0.06, "{}: {hdi:?} for {low} to {high}", what("hdi"));
            assert_eq!(draws.iter().filter(|draw| (hdi[0]..=hdi[1]).contains(*draw)).count(), 3800, "{}", what("hdi"));
            assert!((number(&posterior["median"]) - number(&posterior["quantiles"]["0.5"])).abs() == 0.0);
        }
    }
}

#[test]
fn what_is_worth_a_word_is_said() {
    let modes = document(&case("two-modes"), &["--posterior"]);
    assert!(modes["warnings"].to_string().contains("2 solutions together") || modes["notes"].to_string().contains("2 solutions together"));
    let exact = replaced(&two_cars(), &[("crush_energy = { value = \"from crush\", relative = 0.1 }", "crush_energy = \"from crush\"")]);
    let exact = document(&exact, &["--posterior"]);
    assert!(
        exact["notes"].to_string().contains("to a thousandth of its size, and angles to 0.06 deg (crush_energy)"),
        "{}",
        exact["notes"]
    );
    let plain = document(&two_cars(), &["--posterior"]);
    for text in ["solutions together", "a thousandth", "converged"] {
        assert!(!plain["notes"].to_string().contains(text), "{text}");
    }
}

/// The bins of the draws and of each pair of unknowns hold the draws that lie in them.
#[test]
fn densities_are_those_of_the_draws() {
    let found = document(&case("regular"), &["--posterior", "--draws"]);
    let unknowns = ["vehicle.1.speed", "vehicle.2.speed"];
    let places = unknowns.map(|name| {
        let density = &found["unknown"][name]["posterior"]["density"];
        let (edges, shares) = (numbers(&density["edges"]), numbers(&density["shares"]));
        let draws = numbers(&found["posterior"]["values"][name]);
        let place = |draw: &f64| (edges.partition_point(|edge| edge <= draw) - 1).min(shares.len() - 1);
        let places: Vec<usize> = draws.iter().map(place).collect();
        for (bin, share) in shares.iter().enumerate() {
            let count = places.iter().filter(|place| **place == bin).count();
            assert!((share * 4000.0 - count as f64).abs() < 1e-9, "{name}, {bin}: {share} for {count}");
        }
        places
    });
    let pairs = found["posterior"]["pairs"].as_array().expect("a list");
    assert_eq!(pairs.len(), 1);
    assert_eq!([&pairs[0]["x"], &pairs[0]["y"]], unknowns);
    for (row, shares) in pairs[0]["shares"].as_array().expect("rows").iter().enumerate() {
        for (column, share) in numbers(shares).into_iter().enumerate() {
            let count = places[0].iter().zip(&places[1]).filter(|(x, y)| (**x, **y) == (column, row)).count();
            assert!((share * 4000.0 - count as f64).abs() < 1e-9, "{column}, {row}: {share} for {count}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_draws() {
    let of = |seed: &str| text(&two_cars(), &["--format", "json", "--draws", "--seed", seed]).out;
    let one = of("1");
    assert_eq!(one, of("1"));
    assert_ne!(one, of("2"));
    // Nothing is drawn unless it is asked for.
    let (plain, _) = answer(&two_cars());
    assert!(plain.get("posterior").is_none() && plain.get("probabilities").is_none());
    assert!(plain["unknown"]["vehicle.1.speed"].get("posterior").is_none());
    let drawn = document(&two_cars(), &["--posterior"]);
    assert!(drawn["posterior"].get("values").is_none() && drawn["unknown"]["vehicle.1.speed"]["posterior"]["mean"].is_f64());
}

#[test]
fn statements_are_read_with_their_units() {
    let statements =
        ["v1 > 50 km/h", "vehicle.1.speed >= 13.888888888888889", "vehicle.1.speed<50km/h", "vehicle.1.pdof > 25 deg", "dV1 <= 0 mph"];
    let arguments: Vec<&str> = statements.iter().flat_map(|statement| ["--probability", statement]).collect();
    let found = document(&two_cars(), &arguments);
    let of = |i: usize| number(&found["probabilities"][statements[i]]);
    assert_eq!((of(0), of(4)), (of(1), 0.0));
    assert!(0.0 < of(0) && of(0) < 1.0 && (of(0) + of(2) - 1.0).abs() < 1e-12 && of(3) > 0.5);
    assert_eq!(found["unknown"]["vehicle.1.speed"]["posterior"]["quantiles"].as_object().map(serde_json::Map::len), Some(7));
    for (statement, says) in [
        ("vehicle.1.speed = 50 km/h", "expected NAME > VALUE"),
        ("vehicle.1.sped > 50 km/h", "did you mean `vehicle.1.speed`"),
        ("vehicle.1.speed > 50 kg", "kg"),
        ("vehicle.1.speed > fast", "fast"),
        ("vehicle.1.speed >", "empty"),
        ("vehicle.1.equivalent_energy_speed > 1 m/s", "contact.crush_share"),
        ("> 3", "no quantity has this name"),
    ] {
        let run = text(&two_cars(), &["--probability", statement, "--probability", "nothing > 1"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{statement}: {}", run.err);
        assert!(run.err.contains(says) && run.err.contains("--probability") && run.err.contains("nothing"), "{statement}: {}", run.err);
    }
}

#[test]
fn what_nothing_limits_has_no_posterior() {
    // Only the sum of the speeds makes a difference.
    let open = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0.3]\n\
                [[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"180 deg\"\nimpact_center = [2, 0.3]\n\
                [contact]\ncrush_plane = 0\nrestitution = 0.1\n\
                [evidence]\nvehicle.1.delta_v_magnitude = \"10 m/s ± 0.5 m/s\"\nvehicle.2.delta_v_magnitude = \"10 m/s ± 0.5 m/s\"\n\
                [unknown]\nvehicle.1.speed = { start = 12 }\nvehicle.2.speed = { start = 9 }\n";
    let run = text(open, &["--posterior"]);
    assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
    for says in ["nothing limits vehicle.1.speed", "nothing limits vehicle.2.speed", "give it min and max", "19 |", "20 |"] {
        assert!(run.err.contains(says), "{says}: {}", run.err);
    }
    let bounded = replaced(open, &[("{ start = 9 }", "{ start = 9, min = 5, max = 15 }")]);
    assert_eq!(text(&bounded, &["--posterior"]).status, 1);
}

#[test]
fn the_page_has_the_numbers_of_the_document() {
    let statement = "vehicle.1.speed > 52 km/h";
    let words = ["--posterior", "--probability", statement, "--level", "0.8"];
    let found = document(&two_cars(), &words);
    let page = text(&two_cars(), &[&words[..], &["--brief", "--units", "si"]].concat()).out;
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    let (_, table) = page.split_once("posterior ").expect("a table");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[0], ["mean", "+/-", "sd", "median", "80", "%", "from", "to", "unit"]);
    for (name, factor) in [("vehicle.1.speed", 1.0), ("vehicle.1.pdof", 180.0 / std::f64::consts::PI), ("energy.loss", 1.0)] {
        let of = if name == "vehicle.1.speed" { &found["unknown"][name]["posterior"] } else { &found["derived"][name]["posterior"] };
        let row = rows.iter().find(|row| row.first() == Some(&name)).unwrap_or_else(|| panic!("{name}"));
        let wanted = [&of["mean"], &of["sd"], &of["median"], &of["hdi"][0], &of["hdi"][1]];
        for (cell, wanted) in row[1..6].iter().zip(wanted) {
            let cell: f64 = cell.parse().expect("a number");
            assert!((cell - factor * number(wanted)).abs() <= 0.06 * factor * number(&of["sd"]), "{name}: {cell} for {wanted}");
        }
    }
    let summary = &found["posterior"];
    let said = format!("R-hat at most {:.3}", number(&summary["r_hat"]));
    let words: String = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(&said) && words.contains(&format!("at least {:.0} independent draws", number(&summary["ess"]))), "{page}");
    let probability = number(&found["probabilities"][statement]);
    let error = (probability * (1.0 - probability) / number(&summary["ess"])).sqrt();
    assert!(words.contains(&format!("probability of {statement}: {probability:.3} ± {error:.3}")), "{page}");
    // A brief page has the verdict, and nothing of what comes after.
    assert!(
        words.contains("The evidence agrees with one solution") && !words.contains("through CRASH3") && !words.contains("searches from"),
        "{page}"
    );
    let whole = text(&two_cars(), &[]).out;
    assert!(whole.contains("searches from") && !whole.contains("posterior"));
    assert!(text(&example("uncertain-masses.toml"), &["--brief"]).out.contains("uncertain input"));
}
