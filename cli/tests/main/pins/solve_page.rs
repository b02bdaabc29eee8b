//! The page of `solve`: each number equals that of the document in the unit shown, in both systems of units.

use serde_json::{Value, json};

use super::planar::Contact;
use super::units::{Table, hold, hold_value, printed, tables, unit};
use super::{case, document, number};
use crate::process::{examples, run_with_input};

/// The rows of the first table after the motions before impact, as paths within a vehicle of the document; the last
/// three only if there is a crush.
const AFTER: [&str; 9] = [
    "/velocity/0",
    "/velocity/1",
    "/yaw_rate",
    "/delta_v_magnitude",
    "/delta_v_magnitude",
    "/pdof",
    "/mean_depth",
    "/crush_energy",
    "/equivalent_energy_speed",
];
/// The rows of the second table, normal and tangential.
const CONTACT: [[&str; 2]; 4] = [
    ["/contact/approach/normal", "/contact/approach/tangential"],
    ["/contact/separation/normal", "/contact/separation/tangential"],
    ["/contact/impulse/normal", "/contact/impulse/tangential"],
    ["/energy/normal_work", "/energy/tangential_work"],
];
/// The two additional rows of a moment impulse.
const MOMENT: [&str; 2] = ["/contact/impulse/moment", "/energy/moment_work"];
const ENERGY: [&str; 3] = ["/energy/before", "/energy/after", "/energy/loss"];
/// The rows of the bracket table after the crush plane, as outputs.
const BRACKET: [&str; 9] = [
    "energy.normal_work",
    "energy.tangential_work",
    "energy.loss",
    "contact.impulse_ratio",
    "contact.critical_impulse_ratio",
    "vehicle.1.delta_v_magnitude",
    "vehicle.2.delta_v_magnitude",
    "vehicle.1.yaw_rate",
    "vehicle.2.yaw_rate",
];

/// Returns the examples, and position A with every other way to give the ratio, the law and the moment impulse.
pub(super) fn cases() -> Vec<Value> {
    let names = examples().into_iter().map(|path| path.file_name().expect("a name").to_str().expect("a plain name").to_owned());
    let mut cases: Vec<Value> = names.map(|name| case(&name)).collect();
    for (key, value) in [
        ("impulse_ratio", json!(0.4)),
        ("impulse_ratio", json!({ "of_critical": 0.975 })),
        ("tangential_law", json!("kudlich-slibar")),
        ("moment", json!({ "of_critical": 0.5 })),
    ] {
        let mut changed = case("position-a.toml");
        changed["contact"][key] = value;
        changed["contact"]["restitution"] = json!(0.15);
        changed["vehicle"][1]["yaw_rate"] = json!("20 deg/s");
        cases.push(changed);
    }
    cases
}

struct Page {
    case: Value,
    document: Value,
    inputs: Value,
    text: String,
    tables: Vec<Table>,
}

fn pages() -> Vec<Page> {
    let mut pages = Vec::new();
    for case in cases() {
        for units in ["us", "si"] {
            let run = run_with_input(&["solve", "-", "--units", units], &case.to_string());
            assert_eq!((run.status, run.err.as_str()), (0, ""));
            let inputs = document("gradient", &case, &["--of", "T_L"])["wrt"].clone();
            pages.push(Page {
                document: document("solve", &case, &[]),
                inputs,
                tables: tables(&run.out),
                text: run.out,
                case: case.clone(),
            });
        }
    }
    pages
}

/// Returns the scale of a kind of number in a collision, below which rounding prints as zero.
fn scale(document: &Value, name: &str) -> f64 {
    match name {
        "ft lb" | "J" => number(&document["energy"]["before"]),
        "lbf s" | "N s" => 1e4,
        _ => 1.0,
    }
}

#[test]
fn every_number_of_the_vehicles() {
    for Page { case, document, inputs, tables, .. } in pages() {
        let rows = &tables[0].rows;
        for i in [0, 1] {
            let mut rows = rows.iter().map(|row| (row[row.len() - 3].as_str(), row[row.len() - 2 + i].as_str()));
            let mut show = |value: Option<&Value>, absent: &str| {
                let (name, cell) = rows.next().expect("a row");
                match value {
                    Some(value) => hold_value(cell, value, name, scale(&document, name), name),
                    None => assert_eq!(cell, absent),
                }
            };
            let vehicle = (case["vehicle"][i]["barrier"] != true).then(|| &document["vehicles"][i]);
            for name in ["velocity.x", "velocity.y", "yaw_rate"] {
                show(vehicle.map(|_| &inputs[format!("vehicle.{}.{name}", i + 1)]), "fixed");
            }
            AFTER[..6].iter().for_each(|place| show(vehicle.and_then(|vehicle| vehicle.pointer(place)), "fixed"));
            if document["vehicles"].to_string().contains("crush_energy") {
                AFTER[6..].iter().for_each(|place| show(document["vehicles"][i].pointer(place), "-"));
            }
            assert_eq!(rows.next(), None, "every row is held");
        }
        // ΔV appears twice: as a velocity, and in road units.
        let speeds: Vec<&str> = [6, 7].map(|row: usize| rows[row][rows[row].len() - 3].as_str()).into();
        assert!(speeds == ["ft/s", "mph"] || speeds == ["m/s", "km/h"], "{speeds:?}");
    }
}

#[test]
fn every_number_of_contact_and_energy() {
    for Page { document, tables, .. } in pages() {
        let at = |place: &str| document.pointer(place).unwrap_or_else(|| panic!("{place}"));
        let has_moment = document["energy"].get("moment_work").is_some();
        let [contact, energy] = &tables[1..3] else { panic!("two tables") };
        assert_eq!(contact.rows.len(), CONTACT.len() + if has_moment { MOMENT.len() } else { 0 });
        for (row, places) in contact.rows.iter().zip(CONTACT) {
            for (cell, place) in row[2..].iter().zip(places) {
                hold_value(cell, at(place), &row[1], scale(&document, &row[1]), place);
            }
        }
        for (row, place) in contact.rows[CONTACT.len()..].iter().zip(MOMENT) {
            hold_value(&row[2], at(place), &row[1], 0.0, place);
        }
        for (row, place) in energy.rows.iter().zip(ENERGY) {
            hold_value(&row[2], at(place), &row[1], scale(&document, &row[1]), place);
        }
        assert_eq!(energy.rows.len(), ENERGY.len());
        let share = energy.rows[2][0].split(['(', ')']).nth(1).expect("a share").trim_end_matches(" %");
        hold(share, number(at("/energy/loss")) / number(at("/energy/before")), "%", 1.0, "share of the loss");
    }
}

/// Returns the numbers in the sentences below the tables.
fn numbers_below(text: &str) -> Vec<String> {
    // Notes come last, some in a paragraph of their own.
    let before_notes = text.split("\nNote:").next().unwrap_or(text).trim_end();
    let words = before_notes.rsplit_once("\n\n").expect("words below the tables").1;
    let tokens = words.split_whitespace().map(|token| token.trim_matches(['(', ')', ',', ';', '.']));
    tokens.filter(|token| printed(token).is_some()).map(str::to_owned).collect()
}

#[test]
fn the_law_in_force_and_the_bounds_of_energy_gain() {
    for Page { case, document, inputs, text, .. } in pages() {
        let law = case["contact"]["tangential_law"].as_str().unwrap_or("brach");
        assert!(text.to_lowercase().contains(&format!("law of {law}")), "{text}");
        let found = numbers_below(&text);
        let mut found = found.iter().map(String::as_str);
        let contact = Contact::of(&inputs);
        let (e, mu) = (number(&document["contact"]["restitution"]), number(&document["contact"]["impulse_ratio"]));
        hold_value(found.next().expect("the crush plane"), &inputs["contact.crush_plane"], "deg", 0.0, "crush plane");
        hold(found.next().expect("e"), e, "", 0.0, "e");
        hold(found.next().expect("mu"), mu, "", 1.0, "mu");
        let given = [&case["contact"]["friction"], &case["contact"]["impulse_ratio"]["of_critical"]].into_iter().find_map(Value::as_f64);
        if let Some(given) = given {
            hold(found.next().expect("friction or fraction"), given, "", 1.0, "what the ratio is of");
        }
        hold_value(found.next().expect("mu0"), &document["contact"]["critical_impulse_ratio"], "", 1.0, "mu0");
        if case["contact"].get("moment").is_some() {
            assert_eq!(found.next(), None, "a moment impulse moves the bounds");
            continue;
        }
        let is_critical = given.is_none() && !case["contact"]["impulse_ratio"].is_number();
        let loss = |e: f64| if is_critical { contact.critical_loss(e) } else { contact.loss_at_ratio(e, mu) };
        let energy = number(&document["energy"]["before"]);
        let (bound, half) = printed(found.next().expect("a bound of e")).expect("a number");
        if bound == 1.0 || law != "brach" {
            assert!(bound == 1.0 && (loss(1.0) > -1e-9 * energy || law != "brach"), "{text}");
        } else {
            assert!(loss(bound - half) > 0.0 && loss(bound + half) < 0.0, "{text}");
        }
        let any = if law == "brach" { contact.restitution_for_any_approach() } else { 1.0 };
        let (bound, half) = printed(found.next().expect("a bound of e for any approach")).expect("a number");
        assert!((bound - any).abs() <= half.min(5e-4), "{bound} for {any}");
        for outward in [-1.0, 1.0] {
            let (ratio, half) = printed(found.next().expect("a bound of mu")).expect("a number");
            let loss = |ratio: f64| contact.loss_at_ratio(e, ratio);
            assert!(loss(ratio - outward * half) > 0.0 && loss(ratio + outward * half) < 0.0, "{ratio}: {text}");
        }
        assert_eq!(found.next(), None, "every number is held: {text}");
    }
}

#[test]
fn the_bracket_of_the_crush_plane() {
    let mut case = case("oblique-surfaces.toml");
    let found = document("solve", &case, &[])["crush_plane_bracket"].clone();
    let slopes = document("gradient", &case, &["--of", "all", "--wrt", "Gamma"]);
    // The fronts face 0 and 225 deg; 225 deg is the same plane as 45 deg.
    let ends = [("lower", 0.0), ("upper", 45_f64)];
    for (name, degrees) in ends {
        assert!((number(&found[name]["crush_plane"]) - degrees.to_radians()).abs() < 1e-15);
        case["contact"].as_object_mut().expect("a table").remove("surfaces");
        case["contact"]["crush_plane"] = json!(degrees.to_radians());
        let alone = document("gradient", &case, &["--of", "all", "--wrt", "e"]);
        let outputs = found[name]["outputs"].as_object().expect("outputs");
        assert_eq!(outputs.len(), alone["of"].as_object().expect("outputs").len());
        for (output, value) in outputs {
            let want = number(&alone["of"][output]["value"]);
            assert!((number(value) - want).abs() <= 1e-12 * want.abs().max(1.0), "{name} {output}: {value} for {want}");
        }
    }
    for (output, entry) in slopes["of"].as_object().expect("outputs") {
        assert_eq!(found["d"][output], entry["d"]["contact.crush_plane"], "{output}");
    }
    for Page { document, tables, .. } in pages().into_iter().filter(|page| page.document.get("crush_plane_bracket").is_some()) {
        let (rows, bracket) = (&tables[3].rows, &document["crush_plane_bracket"]);
        for (cell, degrees) in rows[0][2..].iter().zip([0.0, 22.5, 45_f64]) {
            hold(cell, degrees.to_radians(), "deg", 0.0, "crush plane");
        }
        for (row, output) in rows[1..].iter().zip(BRACKET) {
            // A pure number has no unit.
            let (name, cells) = if row.len() == 6 { (row[1].as_str(), &row[2..]) } else { ("", &row[1..]) };
            let values = [&bracket["lower"]["outputs"][output], &slopes["of"][output]["value"], &bracket["upper"]["outputs"][output]];
            cells.iter().zip(values).for_each(|(cell, value)| hold_value(cell, value, name, scale(&document, name), output));
            hold(&cells[3], number(&bracket["d"][output]) * unit("deg"), name, 1e-3, output);
        }
        assert_eq!(rows.len(), 1 + BRACKET.len());
    }
}
