//! Stated facts that accompany the computed values: inputs as in the case, fractions, intervals, counts and messages.

use serde_json::{Value, json};

use super::keys::DOCUMENTS;
use super::planar::Contact;
use super::units::unit;
use super::{array, case, close, document, number, object, solve_page};

/// Converts a quantity of a case file to SI.
fn si(value: &Value) -> f64 {
    match value.as_str().map(|text| text.split_once(' ').unwrap_or((text, ""))) {
        Some((value, name)) => value.parse::<f64>().expect("a number") * unit(name),
        None => number(value),
    }
}

fn of_verb(verb: &str) -> impl Iterator<Item = &'static Value> {
    let all = DOCUMENTS.iter().filter(move |(of, _)| *of == verb).map(|(_, document)| document);
    let found: Vec<&Value> = all.collect();
    assert!(!found.is_empty(), "{verb}");
    found.into_iter()
}

/// Returns the collisions of `solve` and the best ones of `reconstruct`.
fn solutions() -> Vec<&'static Value> {
    let found: Vec<&Value> =
        of_verb("solve").chain(of_verb("reconstruct").map(|found| &found["solution"]).filter(|solution| !solution.is_null())).collect();
    assert!(found.len() > 20);
    found
}

#[test]
fn what_a_case_gives_is_what_solve_states() {
    for case in solve_page::cases() {
        let (found, inputs) = (document("solve", &case, &[]), document("gradient", &case, &["--of", "T_L", "--wrt", "all"])["wrt"].clone());
        for (i, vehicle) in array(&found["vehicles"]).iter().enumerate() {
            let of = |name: &str| inputs.get(format!("vehicle.{}.{name}", i + 1)).map_or(0.0, number);
            assert_eq!(vehicle["barrier"], case["vehicle"][i]["barrier"] == true, "{case}");
            let before = &vehicle["before"];
            close(number(&before["velocity"][0]), of("velocity.x"), 1e-12, "x");
            close(number(&before["velocity"][1]), of("velocity.y"), 1e-12, "y");
            close(number(&before["yaw_rate"]), of("yaw_rate"), 1e-12, "yaw rate");
        }
        let (contact, given) = (&found["contact"], &case["contact"]);
        close(number(&contact["crush_plane"]), number(&inputs["contact.crush_plane"]), 1e-14, "crush plane");
        let (how, parameter) = match (&given["impulse_ratio"], &given["friction"]) {
            (Value::Number(ratio), _) => ("number", json!(ratio)),
            (Value::Object(of), _) => ("of-critical", of["of_critical"].clone()),
            (_, Value::Null) => ("critical", Value::Null),
            (_, friction) => ("friction", friction.clone()),
        };
        assert_eq!((&contact["impulse_ratio_given"], &contact["impulse_ratio_parameter"]), (&json!(how), &parameter));
        let law = given.get("tangential_law").cloned().unwrap_or(json!("brach"));
        assert_eq!(contact["tangential_law"], law);
    }
}

#[test]
fn shares_and_bounds_of_energy() {
    for found in solutions() {
        let energy = &found["energy"];
        close(number(&energy["loss_share"]), number(&energy["loss"]) / number(&energy["before"]), 1e-15, "share");
    }
    for case in solve_page::cases() {
        let found = document("solve", &case, &[]);
        let bounds = &found["contact"]["no_energy_gain"];
        if case["contact"].get("moment").is_some() {
            assert!(bounds.is_null(), "nothing is known with a moment impulse");
            continue;
        }
        let contact = Contact::of(&document("gradient", &case, &["--of", "T_L", "--wrt", "all"])["wrt"]);
        let (e, energy) = (number(&found["contact"]["restitution"]), number(&found["energy"]["before"]));
        if found["contact"]["tangential_law"] == "brach" {
            close(number(&bounds["restitution_for_any_approach"]), contact.restitution_for_any_approach(), 1e-12, "any approach");
            if found["contact"]["impulse_ratio_given"] == "critical" {
                let bound = number(&bounds["restitution"]);
                close(contact.critical_loss(bound), 0.0, 1e-9 * energy, "no loss at the bound");
                assert!(contact.critical_loss(0.999 * bound) > 0.0 && contact.critical_loss(1.001 * bound) < 0.0, "{bound}");
            }
        }
        for (key, inward) in [("least_impulse_ratio", 1e-3), ("greatest_impulse_ratio", -1e-3)] {
            if let Some(bound) = bounds[key].as_f64() {
                close(contact.loss_at_ratio(e, bound), 0.0, 1e-9 * energy, key);
                assert!(contact.loss_at_ratio(e, bound + inward * bound.abs().max(1.0)) > 0.0, "{key} {bound}");
            }
        }
    }
}

#[test]
fn the_impulse_plane_is_that_of_the_matrix_form() {
    for case in solve_page::cases() {
        let found = document("solve", &case, &[]);
        let (contact, plane) = (&found["contact"], &found["contact"]["impulse_plane"]);
        let hand = Contact::of(&document("gradient", &case, &["--of", "T_L", "--wrt", "all"])["wrt"]);
        let k = &plane["compliance"];
        for (key, want) in [("normal", hand.nn), ("coupling", hand.nt), ("tangential", hand.tt)] {
            close(number(&k[key]), want, 1e-12 * (hand.nn + hand.tt), key);
        }
        let e = number(&contact["restitution"]);
        let impulse = ["normal", "tangential"].map(|key| number(&contact["impulse"][key]));
        let changed = |[n, t]: [f64; 2]| [hand.nn * n + hand.nt * t, hand.nt * n + hand.tt * t];
        // What the impulse does not change, a moment impulse does.
        let by_impulse = changed(impulse);
        let by_moment = [0, 1].map(|i| {
            let key = ["normal", "tangential"][i];
            hand.v[i] - by_impulse[i] - number(&contact["separation"][key])
        });
        let size = hand.v[0].abs() + hand.v[1].abs();
        if case["contact"].get("moment").is_none() {
            by_moment.iter().for_each(|by| close(*by, 0.0, 1e-11 * size, "no moment"));
        }
        let [n, t] = [hand.v[0] - by_moment[0], hand.v[1] - by_moment[1]];
        close(number(&plane["maximum_compression"]), n, 1e-11 * size, "compression");
        close(number(&plane["termination"]), n + e * hand.v[0], 1e-11 * size, "termination");
        close(number(&plane["sliding_end"]), t, 1e-11 * size, "sliding end");
        let ends =
            [("common_velocity", [n, t]), ("brach", [n + e * hand.v[0], t]), ("kudlich_slibar", [n + e * hand.v[0], t + e * hand.v[1]])];
        for (point, want) in ends {
            let point = ["normal", "tangential"].map(|key| number(&plane[point][key]));
            changed(point).into_iter().zip(want).for_each(|(change, want)| close(change, want, 1e-11 * size, "change of velocity"));
        }
    }
}

#[test]
fn the_share_of_a_cost_is_that_of_planar_mechanics() {
    let of_reconstruct = of_verb("reconstruct").map(|found| &found["crash3"]).filter(|crash3| !crash3.is_null());
    let mut count = 0;
    for found in of_verb("crash3").chain(of_reconstruct) {
        let planar = &found["planar"];
        if planar.is_null() {
            continue;
        }
        count += 1;
        for with in ["planar", "common_velocity", "point_mass", "tangential_factor", "together"] {
            let (of, cost) = (&planar[with], &planar[with]["cost"]);
            let share = |value: &Value, of_planar: &Value| number(value) / number(of_planar) - 1.0;
            close(number(&cost["loss_share"]), share(&of["loss"], &planar["planar"]["loss"]), 1e-12, with);
            for i in 0..2 {
                let delta_v = &planar["planar"]["delta_v_magnitude"][i];
                assert_eq!(planar["barriers"][i], number(delta_v) == 0.0, "only a barrier has none");
                if planar["barriers"][i] == true {
                    assert!(cost["delta_v_share"][i].is_null());
                } else {
                    close(number(&cost["delta_v_share"][i]), share(&of["delta_v_magnitude"][i], delta_v), 1e-12, with);
                }
            }
        }
    }
    assert!(count > 5);
}

#[test]
fn crush_and_crash3_state_the_case() {
    for name in ["cavalier-crush", "stiff-corner", "to-rest"] {
        let case = case(&format!("{name}.toml"));
        let solved = document("solve", &case, &[]);
        let (crush, crash3) = (document("crush", &case, &[]), document("crash3", &case, &[]));
        for i in 0..2 {
            let given = &case["vehicle"][i];
            assert_eq!(crush["names"][i], solved["vehicles"][i]["name"], "{name}");
            let is_barrier = given["barrier"] == true;
            assert_eq!(crash3["vehicles"][i]["barrier"], is_barrier, "{name}");
            assert_eq!(crash3["vehicles"][i]["approach_velocity"], solved["vehicles"][i]["before"]["velocity"], "{name}");
            let of = &crush["vehicles"][i];
            assert_eq!(of["barrier"], is_barrier, "{name}");
            if !is_barrier {
                assert_eq!(of["depths"], array(&given["crush"]["depths"]).len(), "{name}");
                let zones = of.get("zones").map_or(&[][..], array);
                let width: f64 = zones.iter().map(|zone| number(&zone["width"])).sum();
                assert!(zones.is_empty() || (width - number(&of["width"])).abs() < 1e-12, "{name}: the zones cover the width");
                zones.iter().for_each(|zone| close(number(&zone["width"]), 2.0 * number(&zone["K"][0]), 1e-12, "K1 = w/2"));
            }
        }
    }
}

#[test]
fn intervals_lie_around_their_values_within_the_bounds() {
    // The 97.5 % quantile of the standard normal distribution (Abramowitz and Stegun, table 26.5).
    let quantile = 1.959_963_984_540_054;
    let (mut count, mut regular, mut near) = (0, 0, 0);
    for found in of_verb("reconstruct") {
        for (name, of) in object(&found["unknown"]).iter().chain(object(&found["derived"])) {
            let interval = &of["interval"];
            assert_eq!((&interval["level"], &interval["method"]), (&json!(0.95), &json!("profile")), "{name}");
            let end = |key: &str, none: f64| interval[key].as_f64().unwrap_or(none);
            let (low, high) = (end("low", f64::NEG_INFINITY), end("high", f64::INFINITY));
            let bound = |key: &str, none: f64| of[key].as_f64().unwrap_or(none);
            assert!(low <= high && bound("min", f64::NEG_INFINITY) <= low && high <= bound("max", f64::INFINITY), "{name}: {interval}");
            let limits = [&interval["low_limited_by"], &interval["high_limited_by"]];
            for limit in limits.into_iter().filter_map(Value::as_str) {
                let is_bound =
                    limit.rsplit_once(' ').is_some_and(|(of, end)| found["unknown"].get(of).is_some() && ["min", "max"].contains(&end));
                assert!(is_bound || ["not-closing", "tensile", "beyond-critical", "energy-gain", "period"].contains(&limit), "{limit}");
            }
            let given = bound("max", f64::INFINITY) - bound("min", f64::NEG_INFINITY);
            let is_whole_turn = limits.iter().any(|limit| *limit == "period");
            let narrows = if given.is_finite() { high - low < given * (1.0 - 1e-6) } else { (high - low).is_finite() && !is_whole_turn };
            assert_eq!(interval["narrows"], narrows, "{name}: {of}");
            let Some(value) = of["value"].as_f64() else { continue };
            assert!(low <= value && value <= high, "{name}: {value} {interval}");
            count += 1;
            let is_alone = found["solutions"].as_array().is_some_and(|all| all.len() == 1) && limits.into_iter().all(Value::is_null);
            if let Some(sd) = of["sd"].as_f64().filter(|_| is_alone) {
                regular += 1;
                let is_near = |end: f64| ((end - value).abs() / (quantile * sd) - 1.0).abs() < 0.1;
                near += usize::from(is_near(low) && is_near(high));
            }
        }
    }
    // Most are as long to both sides as the standard deviation says.
    assert!(count > 50 && regular > 30 && near * 2 > regular, "{near} of {regular} of {count}");
}

#[test]
fn bounds_and_starts_are_those_of_the_file() {
    for name in ["crabbed-1", "two-cars", "position-a"] {
        let case = case(&format!("reconstruct/{name}.toml"));
        let found = document("reconstruct", &case, &["--starts", "17"]);
        assert_eq!((&found["starts"], &found["other_separations"]), (&json!(17), &json!(false)), "{name}");
        assert_eq!(found["impulse_ratio_is_fraction"], case["contact"]["impulse_ratio"].get("of_critical").is_some(), "{name}");
        for (unknown, value) in object(&found["unknown"]) {
            let given = unknown.split('.').fold(&case["unknown"], |table, key| &table[key]);
            for bound in ["min", "max"] {
                match given.get(bound) {
                    Some(given) => close(number(&value[bound]), si(given), 1e-12 * si(given).abs(), unknown),
                    None => assert!(value[bound].is_null(), "{name} {unknown}"),
                }
            }
        }
    }
}

#[test]
fn what_is_furthest_off_and_where_searches_ended() {
    for found in of_verb("reconstruct") {
        let mut all: Vec<(&String, &Value)> = object(&found["evidence"]).iter().collect();
        all.extend(found.get("priors").map(object).into_iter().flatten());
        let off = |(_, evidence): &(&String, &Value)| evidence["standardised_residual"].as_f64().map(f64::abs);
        let most = all.iter().filter_map(off).fold(0.0, f64::max);
        match &found["furthest_off"] {
            Value::Null => assert!(all.iter().all(|evidence| off(evidence).is_none())),
            furthest => {
                close(number(&furthest["standardised_residual"]).abs(), most, 0.0, "the largest residual");
                let piece = all.iter().find(|piece| furthest["name"] == *piece.0.as_str() && off(piece) == Some(most));
                let (_, piece) = piece.expect("a piece of that name");
                assert!(["given", "computed", "sd"].iter().all(|key| furthest[key] == piece[key]));
            }
        }
        let ended: f64 = array(&found["searches_at_solutions"]).iter().map(number).sum();
        assert!(1.0 <= ended && ended <= number(&found["searches_converged"]));
        for (solution, searches) in array(&found["solutions"]).iter().zip(array(&found["searches_at_solutions"])) {
            assert_eq!(&solution["searches"], searches);
        }
        // Two names of one list; the older is deprecated.
        assert_eq!((&found["weakly_determined"], &found["other_minima"]), (&found["hardly_determined"], &found["worse"]));
        assert_eq!(array(&found["open_directions"]).len(), array(&found["not_determined"]).len());
        for (name, unknown) in found["solutions"].get(0).map_or(&Value::Null, |best| &best["sd"]).as_object().into_iter().flatten() {
            assert_eq!(unknown, &found["unknown"][name]["sd"], "the best solution is the first");
        }
        if let Some(free) = found["without_bounds"].as_object() {
            assert!(free["sd"].as_object().is_some_and(|all| all.values().any(|sd| sd.as_f64().is_some_and(|sd| sd > 0.0))));
        }
    }
}

#[test]
fn counts_of_stiffness_sweep_gradient_and_validate() {
    for name in ["malibu", "struble-welsh"] {
        let file = case(&format!("tests/{name}.toml"));
        let found = document("stiffness", &file, &[]);
        let given: Vec<&Value> = array(&file["vehicle"]).iter().flat_map(|vehicle| array(&vehicle["test"])).collect();
        let has = |test: &&Value| ["speed_sd", "restitution_sd", "scatter"].iter().any(|key| test.get(key).is_some());
        assert_eq!(found["has_deviations"], given.iter().any(has), "{name}");
        for (test, given) in array(&found["tests"]).iter().zip(given) {
            close(number(&test["speed"]), si(&given["speed"]), 1e-12, name);
            close(number(&test["restitution"]), si(&given["restitution"]), 0.0, name);
        }
        for residual in array(&found["fits"]).iter().flat_map(|fit| array(&fit["residuals"])) {
            let want = number(&residual["observed"]) - number(&residual["fitted"]);
            close(number(&residual["difference"]), want, 1e-9 * number(&residual["observed"]), name);
        }
    }
    let all = document("gradient", &case("position-a.toml"), &["--of", "all", "--wrt", "e"]);
    assert_eq!(all["outputs_of_case"], object(&all["of"]).len());
    let sweep = document("sweep", &case("sideswipe.toml"), &["--vary", "contact.crush_plane=-10 deg:10 deg:5 deg"]);
    let codes = array(&sweep["refusal"]);
    assert_eq!(codes.len(), 5);
    for (code, reason) in codes.iter().zip(array(&sweep["refused"])) {
        assert_eq!(code.is_null(), reason.is_null());
        assert!(code.is_null() || code == "separating" && reason.as_str().is_some_and(|reason| reason.contains("separating")), "{code}");
    }
    assert!(codes.iter().any(Value::is_null) && !codes.iter().all(Value::is_null));
    for found in of_verb("validate") {
        for table in array(&found["tables"]) {
            let cells = array(&found["cells"]).iter().filter(|cell| cell["table"] == table["name"]);
            let count =
                |verdict: &str| cells.clone().filter(|cell| cell["verdict"].as_str().is_some_and(|of| of.contains(verdict))).count();
            let given = array(&found["given"]).iter().filter(|cell| cell["table"] == table["name"]).count();
            assert_eq!((&table["agree"], &table["given"]), (&json!(count("agree")), &json!(given)), "{table}");
            assert_eq!((&table["within_bound"], &table["misprints"]), (&json!(count("bound")), &json!(count("misprint"))), "{table}");
            assert_eq!(table["cells"], cells.clone().count() + given, "{table}");
            assert!(table["remark"].as_str().is_some_and(|remark| remark.len() > 3));
        }
    }
}

#[test]
fn messages_are_the_notes_with_their_figures() {
    let mut figures = 0;
    // A light vehicle with an unusual radius of gyration, and a search that starts at the values of the case.
    let unusual = ["20 lbf s^2 ft", "3 slug ft^2", "200000 kg m^2", "90 kg m^2", "7 kg m^2"].map(|inertia| {
        let mut unusual = case("position-b.toml");
        unusual["vehicle"][0]["yaw_inertia"] = json!(inertia);
        ("solve", document("solve", &unusual, &[]))
    });
    for (verb, found) in DOCUMENTS.iter().chain(&unusual).filter(|(_, found)| found.get("messages").is_some()) {
        let texts: Vec<&Value> = array(&found["messages"]).iter().map(|message| &message["text"]).collect();
        assert_eq!(texts, array(&found["notes"]).iter().collect::<Vec<_>>(), "{verb}");
        for message in array(&found["messages"]) {
            let code = message["code"].as_str().expect("a code");
            assert!(!code.is_empty() && code.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'), "{code}");
            assert!(message["severity"] == "note" || message["severity"] == "warning", "{message}");
            assert!(message["path"].is_string(), "{message}");
            let words = message["text"].as_str().expect("a text").split([' ', ',', ';']);
            let shown: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
            for figure in array(&message["figures"]) {
                figures += 1;
                let name = if figure["measure"] == "angle" || figure["measure"] == "yaw rate" { "deg" } else { "" };
                let want = number(&figure["value"]) / unit(name);
                assert!(shown.iter().any(|shown| (shown - want).abs() <= 0.006 * want.abs().max(1.0)), "{message}");
            }
        }
    }
    // One of them is a mass that may be in pounds, of a reference whose evidence contradicts itself; two are resolutions of a recorder; six
    // are standard deviations of a further vehicle by two lines.
    assert_eq!(figures, 16);
}
