//! Guaranteed ranges, on a car that hits a wall straight on: ½ m v² (1 − e²) = E.

use serde_json::Value;

use super::{number, text};

/// Returns the case of a crush energy, with a restitution from 0 to 0.3 and an unknown speed.
fn case(energy: &str, speed: &str) -> String {
    format!(
        "schema = 1\n[[vehicle]]\nmass = \"1500 kg\"\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n\
         [contact]\ncrush_plane = 0\nrestitution = {{ min = 0, max = 0.3 }}\n[evidence]\ncrush_energy = {energy}\n[unknown]\nvehicle.1.speed = {speed}\n"
    )
}

fn speed(energy: f64, e: f64) -> f64 {
    (2.0 * energy / 1500.0 / (1.0 - e * e)).sqrt()
}

#[track_caller]
fn assert_range(found: &Value, low: f64, high: f64) {
    for (key, end, side) in [("low", low, 1.0), ("high", high, -1.0)] {
        let (bound, attained) = (number(&found[key]), number(&found[format!("{key}_attained")]));
        assert!(side * (end - bound) > -1e-9 && side * (end - bound) < 2e-5, "{key} {end}: {found}");
        assert!(side * (attained - end) > -1e-9 && side * (attained - end) < 2e-5, "{key} {end}: {found}");
    }
    assert_eq!(found["is_tight"], Value::Bool(true), "{found}");
}

#[test]
fn a_bracket_of_the_restitution_makes_a_range_of_the_speed() {
    for (energy, error, option, deviations) in [
        ("\"60 kJ\"", 0.0, None, 3.0),
        ("{ value = \"60 kJ\", sd = \"1 kJ\" }", 3e3, None, 3.0),
        ("{ value = \"60 kJ\", sd = \"1 kJ\" }", 2e3, Some("2"), 2.0),
        ("{ value = \"60 kJ\", resolution = \"4 kJ\" }", 2e3, Some("7"), 7.0),
    ] {
        let options: Vec<&str> =
            ["--guaranteed", "--format", "json"].into_iter().chain(option.iter().flat_map(|sd| ["--bounds-sd", sd])).collect();
        let run = text(&case(energy, "{ start = \"12 m/s\" }"), &options);
        assert_eq!(run.status, 0, "{}", run.err);
        let found: Value = serde_json::from_str(&run.out).expect("JSON");
        assert_eq!(found["verdict"], "agrees");
        let range = &found["unknown"]["vehicle.1.speed"]["guaranteed"];
        assert_range(range, speed(60e3 - error, 0.0), speed(60e3 + error, 0.3));
        assert_eq!(number(&range["bounds_sd"]), deviations);
        assert_eq!(range["at_low"]["vehicle.1.speed"], range["low_attained"]);
        assert!(number(&range["at_low"]["contact.restitution"]) < 1e-3 && number(&range["at_high"]["contact.restitution"]) > 0.299);
        assert_range(&found["unknown"]["contact.restitution"]["guaranteed"], 0.0, 0.3);
        // Its interval ends there too, if the evidence is exact.
        if error == 0.0 {
            let interval = &found["unknown"]["vehicle.1.speed"]["interval"];
            assert!(
                (number(&interval["low"]) - speed(60e3, 0.0)).abs() < 1e-3 && (number(&interval["high"]) - speed(60e3, 0.3)).abs() < 1e-3
            );
        }
    }
}

#[test]
fn the_table_rounds_outward_in_the_units_of_the_reader() {
    let said = text(&case("\"60 kJ\"", "{ start = \"12 m/s\" }"), &["--guaranteed"]).out;
    let rows: Vec<Vec<&str>> =
        said.lines().skip_while(|line| !line.starts_with("guaranteed ")).map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[0], ["guaranteed", "from", "to", "found", "from", "to", "unit"]);
    // √80 = 8.944272 and √(80/0.91) = 9.376145 m/s; 32.19938 and 33.75412 km/h.
    assert_eq!(rows[2], ["vehicle.1.speed", "8.94426", "9.37615", "8.94427", "9.37614", "m/s"]);
    assert_eq!(rows[3], ["32.1993", "33.7542", "32.1994", "33.7541", "km/h"]);
    assert!(said.contains("within 3 of them"), "{said}");
    assert!(!said.contains("no narrower range is proven"), "{said}");
    assert!(!text(&case("\"60 kJ\"", "{ start = \"12 m/s\" }"), &[]).out.contains("guaranteed"));
}

#[test]
fn what_cannot_be_guaranteed_is_said() {
    let excluded = text(&case("\"60 kJ\"", "{ start = \"5 m/s\", max = \"7 m/s\" }"), &["--guaranteed"]);
    assert!(excluded.out.contains("no guaranteed range: proven: nothing within the limits"), "{}{}", excluded.out, excluded.err);
    let with = |unknown: &str| {
        let case = case("\"60 kJ\"", "{ start = \"12 m/s\" }")
            .replace("crush_plane = 0\n", if unknown.contains("plane") { "" } else { "crush_plane = 0\n" });
        text(&(case.replace("[evidence]\n", "[evidence]\nvehicle.1.delta_v_forward = \"-9 m/s\"\n") + unknown), &["--guaranteed"])
    };
    let open = with("contact.impulse_ratio = { start = 0 }\n");
    assert_eq!(open.status, 2, "{}", open.out);
    assert!(
        open.err.contains("contact.impulse_ratio has no limits, which a guaranteed range takes") && open.err.contains("give min and max"),
        "{}",
        open.err
    );
    // A plane without limits is looked at all around.
    let all_around = with("contact.crush_plane = { start = 0 }\n");
    let rows = all_around.out.split("\nguaranteed ").nth(1).unwrap_or_default();
    assert!(
        rows.contains("contact.crush_plane") && !all_around.out.contains("contact.crush_plane has no"),
        "{}{}",
        all_around.out,
        all_around.err
    );
    for wrong in ["0", "-1", "nan", "41", "inf"] {
        let run = text(&case("\"60 kJ\"", "{ start = \"12 m/s\" }"), &["--guaranteed", &format!("--bounds-sd={wrong}")]);
        assert_eq!(run.status, 2, "{wrong}");
        assert!(run.err.contains("is not above 0 and at most 40"), "{}", run.err);
    }
}

/// A range that ends where the search ends excludes nothing beyond, and says so.
#[test]
fn where_the_search_ends_is_said() {
    let run = text(&case("\"60 kJ\"", "{ start = \"12 m/s\" }"), &["--guaranteed"]);
    let said = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    let wanted = "guaranteed ranges: vehicle.1.speed has no min and max, and is searched down to -200.00 m/s and up to 200.00 m/s; \
                  what lies beyond is not excluded";
    assert!(said.contains(wanted), "{said}");
    let bounded = text(&case("\"60 kJ\"", "{ start = \"12 m/s\", min = \"0 m/s\" }"), &["--guaranteed"]).out;
    let bounded = bounded.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(bounded.contains("vehicle.1.speed has no max, and is searched up to 200.00 m/s;"), "{bounded}");
    let both = text(&case("\"60 kJ\"", "{ start = \"12 m/s\", min = \"0 m/s\", max = \"50 m/s\" }"), &["--guaranteed"]).out;
    assert!(!both.contains("is searched"), "{both}");
}
