//! Recordings: pulses with a closed form, clipped and truncated copies, recorders by hand, evidence from them, and bad inputs.

use std::f64::consts::PI;
use std::fmt::Write;

use serde_json::{Value, json};

use crate::process::{Folder, Run, run, run_with_input, workspace};

/// The times of a test, 0.1 ms apart: 20 ms before a pulse of 100 ms, and 20 ms after it.
fn times() -> impl Iterator<Item = f64> {
    (-200..=1200).map(|i| f64::from(i) * 0.1)
}

/// A half-sine from 0 to 100 ms, of height 1.
fn pulse(ms: f64) -> f64 {
    if (0.0..=100.0).contains(&ms) { (PI * ms / 100.0).sin() } else { 0.0 }
}

/// A CSV of times in ms and of columns over them.
fn csv(header: &str, columns: &[&dyn Fn(f64) -> f64]) -> String {
    let mut text = format!("time [ms],{header}\n");
    for ms in times() {
        let cells: Vec<String> = columns.iter().map(|column| column(ms).to_string()).collect();
        writeln!(text, "{ms},{}", cells.join(",")).expect("a string takes everything");
    }
    text
}

fn close(found: &Value, wanted: f64, relative: f64) {
    let found = found.as_f64().unwrap_or(f64::NAN);
    assert!((found - wanted).abs() <= relative * wanted.abs().max(1e-12), "{found}, not {wanted}");
}

/// Runs `record` on a file beside `test.csv`, and returns its first record and the whole run.
fn record_of(samples: &str, settings: Option<&str>) -> (Value, Run) {
    let folder = Folder::new();
    folder.write("test.csv", samples.as_bytes());
    let file = settings.map_or("test.csv", |settings| {
        folder.write("test.toml", format!("schema = 1\nfile = \"test.csv\"\n{settings}").as_bytes());
        "test.toml"
    });
    let run = run(folder.path(), &["record", file, "--format", "json"]);
    let json: Value = serde_json::from_str(&run.out).unwrap_or(Value::Null);
    (json["records"][0].clone(), run)
}

/// A test of 1500 kg at 10 m/s: forces of 100 and 150 kN, a tangential one of 60 kN, half-sines all.
fn barrier() -> String {
    csv(
        "normal_force.a [kN],normal_force.b [kN],tangential_force [kN]",
        &[&|ms| 100.0 * pulse(ms) + 2.0, &|ms| 150.0 * pulse(ms) - 1.0, &|ms| 60.0 * pulse(ms) + 0.5],
    )
}

const CAR: &str = "mass = \"1500 kg ± 15 kg\"\nspeed = \"10 m/s ± 0.1 m/s\"\n";
/// The integral of a half-sine of 100 ms: 2 T/π.
const AREA: f64 = 0.2 / PI;

#[test]
fn a_half_sine_has_its_closed_form() {
    let (record, run) = record_of(&barrier(), Some(CAR));
    assert_eq!(run.status, 0, "{}", run.err);
    let barrier = &record["barrier"];
    let normal = 250e3 * AREA;
    close(&barrier["normal_impulse"]["value"], normal, 1e-6);
    close(&barrier["tangential_impulse"]["value"], 60e3 * AREA, 1e-6);
    close(&barrier["impulse_ratio"]["value"], 0.24, 1e-6);
    // ΔV = P/m to 1 %, and e = ΔV/v − 1 with 1 % of both.
    close(&barrier["delta_v"]["value"], normal / 1500.0, 1e-6);
    close(&barrier["delta_v"]["sd"], 0.01 * normal / 1500.0, 1e-6);
    close(&barrier["restitution"]["value"], normal / 15e3 - 1.0, 2e-5);
    close(&barrier["restitution"]["sd"], 2_f64.sqrt() * 0.01 * normal / 15e3, 1e-6);
    // The offsets are exact, so the noise of the unloaded channels is rounding.
    for key in ["normal_impulse", "tangential_impulse", "impulse_ratio"] {
        assert!(barrier[key]["sd"].as_f64().is_some_and(|sd| sd < 1e-6), "{key}");
    }
    // CFC 60 passes a pulse of 5 Hz whole.
    close(&barrier["peak_force"]["value"], 250e3, 2e-3);
    close(&barrier["peak_force"]["time"], 0.05, 1e-2);
    let trace = &record["traces"][0];
    assert_eq!((&trace["name"], &trace["quantity"], &trace["filter"]), (&json!("normal force"), &json!("normal_force"), &json!(60)));
    assert_eq!((trace["times"].as_array().map(Vec::len), trace["values"].as_array().map(Vec::len)), (Some(1401), Some(1401)));
    close(&trace["times"][700], 0.05, 1e-9);
    close(&trace["values"][700], 250e3, 2e-3);
    // Before the filter, less the offset: the sine itself.
    close(&trace["unfiltered"][700], 250e3, 1e-9);
    close(&trace["unfiltered"][300], 250e3 * (std::f64::consts::PI * 0.1).sin(), 1e-9);
    let channel = &record["channels"][1];
    assert_eq!(
        (&channel["name"], &channel["quantity"], &channel["samples"]),
        (&json!("normal_force.b"), &json!("normal_force"), &json!(1401))
    );
    for (key, value) in [("from", -0.02), ("to", 0.12), ("period", 1e-4)] {
        close(&channel[key], value, 1e-9);
    }
    assert_eq!((&channel["clipped"], &channel["is_truncated"]), (&Value::Null, &json!(false)));
    assert_eq!((&record["file"], &record["recorder"]), (&json!("test.toml"), &Value::Null));
    let json: Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!((&json["schema"], &json["title"]), (&json!(1), &json!("")));
    let svg = crate::process::run(&workspace(), &["record", "cli/examples/record/barrier.toml", "--format", "svg"]);
    assert!(svg.status == 0 && svg.out.starts_with("<svg ") && svg.out.contains("tangential") && svg.out.contains("CFC"), "{}", svg.err);
}

#[test]
fn noise_is_in_the_impulse() {
    // ±1 kN in turn, 0.1 ms apart: σ² of 200 samples is 200/199 kN², each with the weight 0.1 ms, and the baseline with that of 1200 of them.
    let noise = |ms: f64| if (ms * 10.0).round() as i64 % 2 == 0 { 1.0 } else { -1.0 };
    let (record, _) = record_of(&csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms) + noise(ms)]), None);
    let sd = (200.0_f64 / 199.0 * (1199.5 + 1200.0 * 1200.0 / 200.0)).sqrt() * 0.1;
    close(&record["barrier"]["normal_impulse"]["sd"], sd, 1e-3);
    // Without samples before the contact it is not known, and that is said.
    let late: Vec<String> = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]).lines().map(str::to_owned).collect();
    let late: Vec<&str> = late.iter().map(String::as_str).filter(|line| !line.starts_with('-')).collect();
    let (record, run) = record_of(&late.join("\n"), None);
    assert_eq!(record["barrier"]["normal_impulse"]["sd"], Value::Null);
    assert!(run.out.contains("no-baseline"), "{}", run.out);
    // Of an acceleration the same noise in m/s², times the mass, which is exact.
    let (record, _) = record_of(&csv("acceleration [m/s^2]", &[&|ms| 100.0 * pulse(ms) + noise(ms)]), Some("mass = 1500\n"));
    let one = &record["accelerations"][0];
    close(&one["delta_v"]["sd"], sd * 1e-3, 1e-3);
    close(&one["impulse"]["sd"], 1500.0 * one["delta_v"]["sd"].as_f64().expect("a number"), 1e-9);
}

/// Of a few samples the noise is hardly known: Student's distribution of four degrees of freedom has twice the variance.
#[test]
fn a_baseline_of_few_samples_is_told() {
    let samples = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]);
    let (few, many) = ("may be 1.4 times too small", "short-baseline");
    for (end, is_told, words) in
        [("-19.6 ms", true, few), ("-19.8 ms", true, "many times too small"), ("-18.9 ms", true, "12 samples"), ("-18.8 ms", false, many)]
    {
        let (_, run) = record_of(&samples, Some(&format!("baseline = [\"-20 ms\", \"{end}\"]\n")));
        assert_eq!((run.status, run.out.contains(many), run.out.contains(words)), (0, is_told, is_told), "{end}: {}{}", run.out, run.err);
    }
}

/// The unloaded samples are those before the time zero, whatever the window: the offset is 2 kN, and the half-sine from 20 ms on has F T (1 + cos 36°)/π.
#[test]
fn a_late_window_takes_its_offset_from_before_the_contact() {
    let samples = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms) + 2.0]);
    let (record, run) = record_of(&samples, Some("window = [\"20 ms\", \"100 ms\"]\n"));
    assert_eq!(run.status, 0, "{}", run.err);
    close(&record["barrier"]["normal_impulse"]["value"], 1e5 * 0.1 / PI * (1.0 + (0.2 * PI).cos()), 1e-6);
}

/// Each line of the page has the number of the document, and behind ± its standard deviation, to two digits.
#[test]
fn the_page_has_the_standard_deviation_of_each_number() {
    let file = workspace().join("cli/examples/record/barrier.toml").display().to_string();
    let [page, document] = ["text", "json"].map(|format| run(&workspace(), &["record", &file, "--format", format]).out);
    let document: Value = serde_json::from_str::<Value>(&document).expect("JSON")["records"][0].take();
    let (barrier, sensor, film) = (&document["barrier"], &document["accelerations"][0], &document["films"][0]);
    for (line, of) in [
        (" normal impulse ", &barrier["normal_impulse"]),
        (" tangential impulse ", &barrier["tangential_impulse"]),
        (" impulse ratio ", &barrier["impulse_ratio"]),
        (" restitution ", &barrier["restitution"]),
        (" sensor: impulse ", &sensor["impulse"]),
        (" target: restitution ", &film["restitution"]),
    ] {
        let written = page.lines().find_map(|text| text.strip_prefix(line)).unwrap_or_else(|| panic!("{line} in {page}"));
        let numbers: Vec<f64> = written.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        assert!(written.contains("± "), "{written}");
        close(&of["value"], numbers[0], 5e-3);
        close(&of["sd"], numbers[1], 6e-2);
    }
}

/// By hand: a test of 1500 kg at 5 m/s with an impulse of 250 kN · 2 T/π leaves faster than it came.
#[test]
fn an_impossible_restitution_is_a_warning() {
    let (record, run) = record_of(&barrier(), Some("mass = 1500\nspeed = \"5 m/s\"\n"));
    close(&record["barrier"]["restitution"]["value"], 250e3 * AREA / 7500.0 - 1.0, 2e-5);
    assert!(run.out.contains("implausible-restitution") && run.out.contains("the restitution by the load cells is 1.12"), "{}", run.out);
    assert!(!record_of(&barrier(), Some(CAR)).1.out.contains("implausible-restitution"));
    // Just below zero by less than it is known to; far enough it is not.
    for (percent, is_told) in [(1.0, false), (5.0, true)] {
        let speed = 250e3 * AREA / 1500.0 * (1.0 + percent / 100.0);
        let (_, run) = record_of(&barrier(), Some(&format!("mass = \"1500 kg ± 15 kg\"\nspeed = \"{speed} m/s ± 0.1 m/s\"\n")));
        assert_eq!(run.out.contains("implausible-restitution"), is_told, "{percent}: {}", run.out);
    }
}

#[test]
fn a_named_column_needs_no_quantity_and_one_that_is_not_listed_is_told() {
    let reversed = csv("normal_force [kN],tangential_force [kN]", &[&|ms| -250.0 * pulse(ms), &|ms| 60.0 * pulse(ms)]);
    let channel = "[[channel]]\ncolumn = \"normal_force\"\npolarity = -1\n";
    let (record, run) = record_of(&reversed, Some(&format!("{CAR}{channel}")));
    close(&record["barrier"]["normal_impulse"]["value"], 250e3 * AREA, 1e-5);
    assert!(record["barrier"]["tangential_impulse"].is_null());
    assert!(run.out.contains("these columns are not under [[channel]], and are not used: `tangential_force`"), "{}", run.out);
    let (record, run) = record_of(&reversed, Some(&format!("{CAR}{channel}[[channel]]\ncolumn = \"tangential_force\"\n")));
    close(&record["barrier"]["tangential_impulse"]["value"], 60e3 * AREA, 1e-5);
    assert!(!run.out.contains("unused-columns"), "{}", run.out);
    let unnamed = record_of(&csv("F [kN]", &[&pulse]), Some("[[channel]]\ncolumn = \"F\"\n")).1;
    assert!(unnamed.status == 2 && unnamed.err.contains("channel.1.quantity: missing"), "{}", unnamed.err);
}

/// The advice gives the limits with every digit, and is printed once.
#[test]
fn a_window_outside_of_the_times_is_told_with_their_digits() {
    let samples: Vec<String> = (0..100).map(|i| format!("{:.1},{},0", -19.6 + 0.8 * f64::from(i), pulse(f64::from(i)))).collect();
    let samples = format!("time [ms],normal_force [kN],tangential_force [kN]\n{}\n", samples.join("\n"));
    let wrong = record_of(&samples, Some("window = [\"-20 ms\", \"59 ms\"]\n")).1;
    let help = "within the times of the channel, -0.0196 s to 0.0596 s";
    assert!(wrong.status == 2 && wrong.err.matches(help).count() == 1, "{}", wrong.err);
    let right = record_of(&samples, Some("window = [\"-0.0196 s\", \"0.0596 s\"]\n")).1;
    assert!(!right.err.contains("window"), "{}", right.err);
}

#[test]
fn banks_add_up_and_polarity_mirrors() {
    let (sum, _) = record_of(&csv("normal_force [kN]", &[&|ms| 250.0 * pulse(ms)]), Some(CAR));
    let (banks, _) = record_of(&barrier(), Some(CAR));
    for key in ["normal_impulse", "delta_v", "restitution"] {
        close(&banks["barrier"][key]["value"], sum["barrier"][key]["value"].as_f64().expect("a number"), 1e-9);
    }
    // In counts of 500 N with the sign reversed.
    let counts = csv("F", &[&|ms| -500.0 * pulse(ms)]);
    let channel = "[[channel]]\ncolumn = \"F\"\nquantity = \"normal_force\"\ncalibration = \"500 N\"\n";
    let (mirrored, _) = record_of(&counts, Some(&format!("{CAR}{channel}polarity = -1\n")));
    close(&mirrored["barrier"]["restitution"]["value"], sum["barrier"]["restitution"]["value"].as_f64().expect("a number"), 1e-9);
    let (_, run) = record_of(&counts, Some(&format!("{CAR}{channel}")));
    assert!(run.status == 3 && run.out.is_empty(), "{}", run.out);
    assert!(run.err.contains("channel.1: the normal impulse is -15915 N s") && run.err.contains("polarity = -1"), "{}", run.err);
}

#[test]
fn an_acceleration_and_a_film_agree_with_the_forces() {
    // 160 m/s² at the peak; the point recedes with ΔV − v after the pulse.
    let change = 160.0 * AREA;
    let place = move |ms: f64| {
        let t = ms / 1e3;
        let pushed = if ms < 0.0 {
            0.0
        } else {
            change / 2.0 * (t.min(0.1) - 0.1 / PI * (PI * t.min(0.1) / 0.1).sin()) + change * (t - 0.1).max(0.0)
        };
        1000.0 * (1.0 - 10.0 * t + pushed)
    };
    let samples = csv("acceleration [g],distance [mm]", &[&|ms| 160.0 / 9.80665 * pulse(ms), &place]);
    let (record, run) = record_of(&samples, Some(CAR));
    assert_eq!(run.status, 0, "{}", run.err);
    let (one, film) = (&record["accelerations"][0], &record["films"][0]);
    close(&one["delta_v"]["value"], change, 1e-6);
    close(&one["impulse"]["value"], 1500.0 * change, 1e-6);
    close(&one["impulse"]["sd"], 15.0 * change, 1e-6);
    close(&one["restitution"]["value"], change / 10.0 - 1.0, 1e-4);
    close(&one["peak"]["value"], 160.0, 2e-3);
    close(&one["peak"]["time"], 0.05, 1e-2);
    // The samples are exact; the speed is known to 1 %.
    close(&one["restitution"]["sd"], 0.01 * change / 10.0, 1e-6);
    assert!(one["delta_v"]["sd"].as_f64().is_some_and(|sd| sd < 1e-9));
    // Of a sensor with the other sign everything has the other sign, its extreme too.
    let mirrored = record_of(&csv("acceleration [g]", &[&|ms| -160.0 / 9.80665 * pulse(ms)]), None).0;
    close(&mirrored["accelerations"][0]["peak"]["value"], -160.0, 2e-3);
    close(&mirrored["accelerations"][0]["delta_v"]["value"], -change, 1e-6);
    // That of the closing speed, and what the curved distances of the contact add.
    assert!(film["restitution"]["sd"].as_f64().is_some_and(|sd| (0.01 * (change / 10.0 - 1.0)..5e-4).contains(&sd)));
    close(&film["closing_speed"]["sd"], 0.1, 1e-9);
    assert_eq!((&one["channel"], &film["channel"]), (&json!("acceleration"), &json!("distance")));
    close(&film["restitution"]["value"], change / 10.0 - 1.0, 1e-4);
    close(&film["closing_speed"]["value"], 10.0, 1e-9);
    close(&film["separation"], 0.12, 1e-9);
    let of_film = record["traces"].as_array().into_iter().flatten().find(|trace| trace["quantity"] == "distance").expect("its trace");
    assert_eq!((&of_film["filter"], &of_film["unfiltered"]), (&Value::Null, &Value::Null), "a film is not filtered");
    // Without a speed the film gives it, from the frames before the contact.
    let (record, _) = record_of(&samples, Some("mass = \"1500 kg\"\nseparation = \"115 ms\"\n"));
    close(&record["films"][0]["closing_speed"]["value"], 10.0, 1e-6);
    assert_eq!(record["accelerations"][0]["restitution"], Value::Null);
    // Nine samples are in a line unless the file says otherwise, and it separates where the window ends.
    let film = |settings: &str| record_of(&samples, Some(&format!("{CAR}{settings}"))).0["films"][0].clone();
    assert_eq!(film("neighbors = 9\n"), film(""));
    assert_ne!(film("neighbors = 7\n"), film(""));
    let windowed = film("window = [\"0 ms\", \"110 ms\"]\n");
    close(&windowed["separation"], 0.11, 1e-9);
    assert_eq!(film("window = [\"0 ms\", \"110 ms\"]\nseparation = \"115 ms\"\n")["separation"], 0.115);
    // To first order: the restitution of the film with an exact speed, and what 1 % of the speed is of it.
    let [exact, measured] = ["\"10 m/s\"", "\"10 m/s ± 1 m/s\""]
        .map(|speed| record_of(&samples, Some(&format!("speed = {speed}\n"))).0["films"][0]["restitution"].clone());
    let (restitution, sd) = (measured["value"].as_f64().expect("a number"), exact["sd"].as_f64().expect("a number"));
    close(&measured["sd"], sd.hypot(0.1 * restitution), 1e-3);
}

/// The point moves uniformly before and after a contact of 100 ms, so that lines which do not reach into it are exact, however few frames there are; where the
/// separation is between two frames, the earlier one belongs to them.
#[test]
fn the_line_of_a_film_at_the_separation_does_not_reach_into_the_contact() {
    for (step, separation, within) in [(4, "100 ms", 1e-9), (10, "100 ms", 1e-9), (8, "100 ms", 2e-4)] {
        let mut text = "time [ms],distance [m]\n".to_owned();
        for i in -12..45 {
            let (ms, t) = (step * i, f64::from(step * i) * 1e-3);
            let contact = t.clamp(0.0, 0.1);
            // The velocity goes from −10 to 1.2 m/s by a half-sine of force.
            let pushed = 11.2 / 2.0 * (contact - 0.1 / PI * (PI * contact / 0.1).sin()) + 11.2 * (t - 0.1).max(0.0);
            writeln!(text, "{ms},{}", 2.0 - 10.0 * t + pushed).expect("a string takes everything");
        }
        let (record, run) = record_of(&text, Some(&format!("separation = \"{separation}\"\n")));
        assert_eq!(run.status, 0, "{}", run.err);
        let film = &record["films"][0];
        close(&film["closing_speed"]["value"], 10.0, 1e-9);
        let restitution = film["restitution"]["value"].as_f64().expect("a number");
        assert!((restitution - 0.12).abs() < within, "{step}: {restitution}");
    }
}

#[test]
fn clipped_and_truncated_copies_are_recognised() {
    let (record, run) = record_of(&csv("normal_force [kN]", &[&|ms| (100.0 * pulse(ms)).min(90.0)]), None);
    assert_eq!(run.status, 1);
    let clipped = &record["channels"][0]["clipped"];
    // sin⁻¹ 0.9 is reached at 35.64 ms, and left at 64.36 ms.
    close(&clipped["value"], 90e3, 1e-9);
    close(&clipped["from"], 0.0357, 1e-6);
    close(&clipped["to"], 0.0643, 1e-6);
    assert!(clipped["samples"] == 287 && run.out.contains("normal_force is clipped: 287 samples at 90000 N"), "{clipped}");
    let channel = "[[channel]]\ncolumn = \"normal_force\"\nquantity = \"normal_force\"\nrange = \"100 kN\"\n";
    let whole = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]);
    assert_eq!(record_of(&whole, Some(channel)).0["channels"][0]["clipped"]["samples"], 1);
    let (_, run) = record_of(&whole, Some(&channel.replace("100 kN", "80 kN")));
    assert!(run.status == 1 && run.out.contains("normal_force reaches 100000 N, beyond its range of 80000 N"), "{}", run.out);
    // A range in g is one of standard gravity.
    let at_range = csv("acceleration [m/s^2]", &[&|ms| 16.0 * 9.80665 * pulse(ms)]);
    let channel = "[[channel]]\ncolumn = \"acceleration\"\nquantity = \"acceleration\"\nrange = \"16 g\"\n";
    assert_eq!(record_of(&at_range, Some(channel)).0["channels"][0]["clipped"]["samples"], 1);
    let cut: Vec<&str> = whole.lines().take(1000).collect();
    let (record, run) = record_of(&cut.join("\n"), None);
    assert!(run.status == 1 && record["channels"][0]["is_truncated"] == true && run.out.contains("it ends at 0.080 s"), "{}", run.out);
}

/// Wherever a recording begins and ends, and whatever its first sample reads by chance, it is called incomplete where the pulse goes on before it or after it,
/// and nowhere else.
#[test]
fn a_recording_is_incomplete_where_the_pulse_goes_on() {
    let of = |header: &str, from: i32, to: i32, first: f64, height: f64| {
        let mut text = format!("time [ms],{header}\n");
        for ms in from..=to {
            let value = height * pulse(f64::from(ms)) + if ms == from { first } else { 0.0 };
            writeln!(text, "{ms},{value}").expect("a string takes everything");
        }
        let (record, run) = record_of(&text, None);
        let channel = &record["channels"][0];
        assert_eq!(channel["clipped"], Value::Null, "{from} to {to} ms, {first}: {}", run.out);
        let is_truncated = channel["is_truncated"] == true;
        assert_eq!(run.status, i32::from(is_truncated), "{}", run.out);
        assert_eq!(run.out.contains("truncated: it "), is_truncated, "{}", run.out);
        is_truncated
    };
    for (header, height) in [("normal_force [kN]", 300.0), ("acceleration [m/s^2]", -200.0)] {
        for (from, to) in [(-20, 80), (20, 80), (10, 90), (1, 60), (50, 52), (10, 130), (40, 150)] {
            assert!(of(header, from, to, 0.0, height), "{from} to {to} ms");
        }
        for (from, to) in [(-20, 130), (-20, 100), (0, 130), (1, 130), (3, 150)] {
            for first in [0.0, 1.0, -1.0] {
                assert!(!of(header, from, to, first, height), "{from} to {to} ms, {first}");
            }
        }
    }
}

/// A velocity change that stands still is whole, however long the record is before it.
#[test]
fn a_recorder_is_whole_with_zeros_before_the_impact() {
    let of = |before: &str, to: i32| {
        let mut text = "time [s],speed [km/h],delta_v_forward [km/h]\n".to_owned();
        for i in 0..10 {
            writeln!(text, "{},{},{before}", -5.0 + 0.5 * f64::from(i), 60 - i).expect("a string takes everything");
        }
        for i in 0..=to {
            let change = (-15.0 * (1.0 - (PI * f64::from(i.min(15)) / 15.0).cos())).round();
            writeln!(text, "{},{},{change}", 0.01 * f64::from(i), if i == 0 { "50" } else { "" }).expect("a string takes everything");
        }
        record_of(&text, None)
    };
    for before in ["", "0"] {
        let (record, run) = of(before, 30);
        assert_eq!(run.status, 0, "{}", run.out);
        assert!(record["channels"].as_array().is_some_and(|all| all.iter().all(|one| one["is_truncated"] == false)), "{}", run.out);
        assert_eq!(of(before, 8).1.status, 1, "it ends while the velocity changes");
    }
}

/// A gap in a pulse is bridged by a line, which no standard deviation knows of.
#[test]
fn a_gap_in_a_pulse_is_named() {
    let whole = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]);
    let without = |from: f64, to: f64| {
        let is_left = |line: &&str| line.split(',').next().and_then(|ms| ms.parse::<f64>().ok()).is_none_or(|ms| ms <= from || ms >= to);
        whole.lines().filter(is_left).map(|line| format!("{line}\n")).collect::<String>()
    };
    let gaps = |text: &str| -> Vec<(f64, f64)> {
        let (_, run) = record_of(text, None);
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        let all = json["messages"].as_array().map_or(&[][..], Vec::as_slice);
        let figure = |message: &Value, k: usize| message["figures"][k]["value"].as_f64().expect("a time");
        all.iter().filter(|message| message["code"] == "gap").map(|message| (figure(message, 0), figure(message, 1))).collect()
    };
    assert_eq!(gaps(&whole), []);
    assert_eq!(gaps(&without(40.0, 40.4)), []);
    let found = gaps(&without(40.0, 70.0));
    assert!(matches!(found[..], [(from, to)] if (from - 0.04).abs() < 1e-9 && (to - 0.07).abs() < 1e-9), "{found:?}");
}

/// Of a constant channel rounding is left, of either sign, which is no impact.
#[test]
fn a_constant_channel_is_no_impact() {
    for constant in ["0", "0.1", "0.3", "5", "-7"] {
        let text = csv("normal_force [kN]", &[&|_| constant.parse().expect("a number")]);
        let (_, run) = record_of(&text, None);
        assert!(run.status == 3 && run.err.contains("the normal impulse is 0 N s: there is no impact"), "{constant}: {}", run.err);
    }
}

/// A recorder in whole km/h: forward −40, to the left 30 at last, and speeds to half a second before the impact.
fn recorder(last_speed: &str) -> String {
    let rise = [0.0, 0.05, 0.1, 0.3, 0.6, 0.8, 0.95, 1.0, 1.0, 1.0, 1.0];
    let mut text = format!("time [s],speed [km/h],delta_v_forward [km/h],delta_v_right [km/h]\n-1,60,,\n-0.5,54,,\n{last_speed}");
    for (i, share) in rise.iter().enumerate() {
        writeln!(text, "{},,{},{}", i as f64 * 0.01, (-40.0_f64 * share).round(), (-30.0_f64 * share).round())
            .expect("a string takes everything");
    }
    text
}

#[test]
fn a_recorder_by_hand() {
    let (record, run) = record_of(&recorder(""), None);
    assert_eq!(run.status, 0, "{}", run.err);
    let (found, kmh) = (&record["recorder"], 1.0 / 3.6);
    let sd = kmh / 12_f64.sqrt();
    let maximum = &found["maximum"];
    close(&maximum["magnitude"]["value"], 50.0 * kmh, 1e-12);
    close(&maximum["magnitude"]["sd"], sd, 1e-9);
    close(&maximum["forward"]["value"], -40.0 * kmh, 1e-12);
    close(&maximum["left"]["value"], 30.0 * kmh, 1e-12);
    close(&maximum["forward"]["sd"], sd, 1e-9);
    close(&maximum["left"]["sd"], sd, 1e-9);
    // Pushed back and to the left: the force comes from ahead on the right.
    close(&maximum["pdof"]["value"], (30.0_f64).atan2(40.0), 1e-12);
    close(&maximum["pdof"]["sd"], sd / (50.0 * kmh), 1e-9);
    for key in ["delta_v_forward", "delta_v_left"] {
        close(&found[key]["time"], 0.07, 1e-9);
        close(&found[key]["sd"], sd, 1e-9);
    }
    close(&maximum["time"], 0.07, 1e-9);
    close(&found["delta_v_forward"]["value"], -40.0 * kmh, 1e-12);
    close(&found["delta_v_left"]["value"], 30.0 * kmh, 1e-12);
    // The components are stored in the same steps; the lateral one has the least.
    close(&record["channels"][1]["resolution"], 2.0 * kmh, 1e-9);
    close(&record["channels"][2]["resolution"], kmh, 1e-9);
    assert_eq!(found["is_lower_bound"], false);
    close(&found["pre_crash"][1]["speed"], 54.0 * kmh, 1e-12);
    close(&found["pre_crash"][0]["time"], -1.0, 1e-12);
    // The last speed is half a second old, and fell by 6 km/h in the half second before.
    let at_impact = &found["speed_at_impact"];
    close(&at_impact["value"], 54.0 * kmh, 1e-12);
    close(&at_impact["time"], -0.5, 1e-12);
    let step = 6.0 * kmh; // the least step of its speeds
    close(&at_impact["sd"], step.hypot(step / 12_f64.sqrt()), 1e-9);
    assert!(run.out.contains("speed-before-impact"));
    // It stands still, and 0 has no sign.
    let (still, _) = record_of(&recorder("0,-0,,\n").replace("\n0,,0,0", ""), None);
    assert_eq!(still["recorder"]["speed_at_impact"]["value"].to_string(), "0.0");
    // What it fell by earlier does not matter.
    let (earlier, _) = record_of(&recorder("").replace("\n-1,60", "\n-2,80,,\n-1,60"), None);
    close(&earlier["recorder"]["speed_at_impact"]["sd"], step.hypot(step / 12_f64.sqrt()), 1e-9);
    // At the time zero nothing is added, and a given resolution and a relative error are.
    let (record, run) = record_of(&recorder("0,50,,\n").replace("\n0,,0,0", ""), Some("resolution = \"2 km/h\"\nrelative = 0.1\n"));
    let with = |value: f64| (2.0 * kmh / 12_f64.sqrt()).hypot(0.1 * value * kmh);
    close(&record["recorder"]["speed_at_impact"]["sd"], with(50.0), 1e-9);
    let maximum = &record["recorder"]["maximum"];
    close(&maximum["forward"]["sd"], with(40.0), 1e-9);
    close(&maximum["left"]["sd"], with(30.0), 1e-9);
    close(&maximum["magnitude"]["sd"], (0.8 * with(40.0)).hypot(0.6 * with(30.0)), 1e-9);
    // The lateral component turns the direction more than the longitudinal one.
    close(&maximum["pdof"]["sd"], (30.0 * with(40.0)).hypot(40.0 * with(30.0)) / (2500.0 * kmh), 1e-9);
    assert!(!run.out.contains("speed-before-impact") && !run.out.contains("resolution-assumed"), "{}", run.out);
    // To the right as to the left with the other sign.
    let (left, _) = record_of(&recorder("").replace("right", "left"), None);
    close(&left["recorder"]["maximum"]["pdof"]["value"], -(30.0_f64).atan2(40.0), 1e-12);
}

/// A vehicle that nothing moves has no direction of force, and the standard deviation of the steps in which its channels were read.
#[test]
fn no_velocity_change_has_a_standard_deviation_and_no_direction() {
    let still = "time [ms],delta_v_forward [km/h],delta_v_left [km/h]\n0,0,0\n10,0,0\n20,0,0\n30,0,0\n";
    let (record, run) = record_of(still, Some("resolution = \"2 km/h\"\n"));
    let maximum = &record["recorder"]["maximum"];
    let sd = 2.0 / 3.6 / 12_f64.sqrt();
    assert_eq!((&maximum["magnitude"]["value"], &maximum["pdof"]), (&Value::from(0.0), &Value::Null), "{}", run.err);
    close(&maximum["magnitude"]["sd"], sd * 2_f64.sqrt(), 1e-9);
    close(&maximum["left"]["sd"], sd, 1e-9);
}

/// Readings that scatter have a greatest one that is too great, by about twice the scatter, which their standard deviation includes.
#[test]
fn readings_that_scatter_are_less_certain() {
    let of = |scatter: f64| {
        let mut text = "time [ms],delta_v_forward [km/h]\n".to_owned();
        for i in 0..40 {
            let zigzag = if i % 2 == 0 { scatter } else { -scatter };
            let value = if i < 10 { -3.0 * f64::from(i) } else { -30.0 + zigzag };
            writeln!(text, "{},{value}", 10 * i).expect("a string takes everything");
        }
        record_of(&text, Some("resolution = \"1 km/h\"\n"))
    };
    let (still, run) = of(0.0);
    let step = 1.0 / 3.6 / 12_f64.sqrt();
    close(&still["recorder"]["delta_v_forward"]["sd"], step, 1e-9);
    assert!(!run.out.contains("readings-scatter"), "{}", run.out);
    // In turn ± 2 km/h: second differences of 8 km/h, of which the variance of a reading is 64/6.
    let (noisy, run) = of(2.0);
    let scatter = (64.0 / 6.0 / 3.6 / 3.6 - step * step).sqrt();
    close(&noisy["recorder"]["delta_v_forward"]["value"], -32.0 / 3.6, 1e-9);
    close(&noisy["recorder"]["delta_v_forward"]["sd"], step.hypot(2.0 * scatter), 1e-9);
    assert!(run.out.contains("readings-scatter"), "{}", run.out);
}

/// A film that shows another speed than the file gives, one that goes the other way, and a separation before the contact.
#[test]
fn a_film_that_contradicts_its_file_is_told() {
    let film = csv(
        "distance [m]",
        &[&|ms| {
            if ms < 0.0 {
                -0.01 * ms
            } else if ms < 100.0 {
                0.0
            } else {
                0.001 * (ms - 100.0)
            }
        }],
    );
    let of = |settings: &str| record_of(&film, Some(settings)).1;
    for (speed, is_told) in [("10 m/s ± 0.1 m/s", false), ("12 m/s ± 0.1 m/s", true)] {
        let run = of(&format!("speed = \"{speed}\"\n"));
        assert_eq!(run.out.contains("speed-contradicts-film"), is_told, "{}{}", run.out, run.err);
    }
    let run = of("separation = \"-5 ms\"\n");
    assert!(run.status == 2 && run.err.contains("separation") && run.err.contains("leaves the barrier"), "{}", run.err);
    let run = of("[[channel]]\ncolumn = \"distance\"\nquantity = \"distance\"\npolarity = -1\n");
    assert!(run.status != 0 && run.err.contains("grows by") && run.err.contains("add or remove `polarity = -1`"), "{}", run.err);
}

/// Of several files each note says of which it is; of one alone none does. What stands on standard input is a table or a document by its first line that is no
/// comment.
#[test]
fn notes_of_several_files_have_their_names() {
    let folder = Folder::new();
    for name in ["one.csv", "two.csv"] {
        folder.write(name, recorder("").as_bytes());
    }
    let notes = |files: &[&str]| -> Vec<String> {
        let run = run(folder.path(), &[&["record"], files, &["--format", "json"]].concat());
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        json["notes"].as_array().expect("notes").iter().map(|note| note.as_str().expect("a text").to_owned()).collect()
    };
    let (alone, both) = (notes(&["one.csv"]), notes(&["one.csv", "two.csv"]));
    assert!(!alone.is_empty() && alone.iter().all(|note| !note.contains(".csv")), "{alone:?}");
    let named = ["one.csv", "two.csv"].iter().flat_map(|name| alone.iter().map(move |note| format!("{name}: {note}")));
    assert_eq!(both, named.collect::<Vec<_>>());
    let with_a_comment = run_with_input(&["record", "-"], &format!("# of = unit 7\n\n{}", recorder("")));
    assert!(with_a_comment.status == 2 && with_a_comment.err.contains("CSV has no comments"), "{}", with_a_comment.err);
}

#[test]
fn a_recorder_that_stops_or_ends_early_is_a_lower_bound() {
    let cut: Vec<String> = recorder("").lines().take(7).map(str::to_owned).collect();
    let (record, run) = record_of(&cut.join("\n"), None);
    assert!(
        run.status == 1 && record["recorder"]["is_lower_bound"] == true && run.out.contains("delta_v_forward is truncated"),
        "{}",
        run.out
    );
    // It stops at once at 24 km/h.
    let stopped = recorder("")
        .lines()
        .map(|line| line.replace(",-32,", ",-24,").replace(",-38,", ",-24,").replace(",-40,", ",-24,"))
        .collect::<Vec<_>>();
    let (record, _) = record_of(&stopped.join("\n"), None);
    close(&record["channels"][1]["clipped"]["value"], -24.0 / 3.6, 1e-9);
    let begun = recorder("")
        .lines()
        .filter(|line| !["0,", "0.01,", "0.02,"].iter().any(|at| line.starts_with(at)))
        .map(str::to_owned)
        .collect::<Vec<_>>();
    assert!(record_of(&begun.join("\n"), None).1.out.contains("the impact had begun before it"));
}

/// Reconstructs the case of two cars with other evidence of its recorder, beside `edr.csv`.
fn two_cars(samples: &str, evidence: &str) -> Run {
    let text = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/recorder.toml")).expect("the example is there");
    let line = text.lines().find(|line| line.starts_with("vehicle.2.recorder")).expect("a recorder");
    let folder = Folder::new();
    folder.write("edr.csv", samples.as_bytes());
    folder.write("case.toml", text.replace(line, evidence).as_bytes());
    run(folder.path(), &["reconstruct", "case.toml", "--starts", "4", "--format", "json"])
}

#[test]
fn a_recorder_is_evidence_as_if_written_by_hand() {
    let samples = std::fs::read_to_string(workspace().join("cli/examples/record/edr.csv")).expect("the example is there");
    let unknowns = |run: Run| {
        assert!(run.err.is_empty(), "{}", run.err);
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        let value = |name: &str| json["unknown"][name]["value"].as_f64().expect("a number");
        ["vehicle.1.speed", "vehicle.2.speed", "contact.restitution"].map(value)
    };
    let sd = "± 0.28867513459481287 km/h"; // 1/√12
    let by_hand = format!(
        "vehicle.2.speed = \"41 km/h {sd}\"\nvehicle.2.delta_v.forward = \"-29 km/h {sd}\"\nvehicle.2.delta_v.left = \"-23 km/h {sd}\""
    );
    let by_file = unknowns(two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\" }"));
    for (one, other) in unknowns(two_cars(&samples, &by_hand)).into_iter().zip(by_file) {
        assert!((one - other).abs() < 1e-6 * one.abs(), "{one} and {other}");
    }
    // What is not wanted is left out; magnitude and direction in place of the components.
    let polar = unknowns(two_cars(
        &samples,
        "vehicle.2.recorder = { file = \"edr.csv\", resolution = \"1 km/h\", use = [\"speed\", \"delta_v_magnitude\", \"pdof\"] }",
    ));
    assert!((polar[0] - by_file[0]).abs() < 0.05, "{polar:?}");
    let clipped = samples.replace("0.25,,-29", "0.25,,-34").replace("0.24,,-29", "0.24,,-32");
    let refused = two_cars(&clipped, "vehicle.2.recorder = { file = \"edr.csv\" }");
    assert!(refused.status == 2 && refused.err.contains("delta_v_forward is a lower bound") && refused.err.contains("use = [\"speed\"]"));
    assert!(two_cars(&clipped, "vehicle.2.recorder = { file = \"edr.csv\", use = [\"speed\"] }").err.is_empty());
    let twice = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\", use = [\"pdof\", \"delta_v_left\"] }");
    assert!(twice.err.contains("the record would count twice"), "{}", twice.err);
    let both = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\" }\nvehicle.2.speed = \"40 km/h ± 1 km/h\"");
    assert!(both.status == 2 && both.err.contains("vehicle.2.speed twice"), "{}", both.err);
    let ranged = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\", range = \"20 km/h\" }");
    assert!(ranged.status == 2 && ranged.err.contains("clipped"), "{}", ranged.err);
}

#[test]
fn a_barrier_record_is_evidence_and_a_test() {
    let folder = Folder::new();
    // Sampled noise of ±50 N makes it uncertain.
    let noise = |ms: f64| if (ms * 10.0).round() as i64 % 2 == 0 { 0.05 } else { -0.05 };
    let samples =
        csv("normal_force [kN],tangential_force [kN]", &[&|ms| 250.0 * pulse(ms) + noise(ms), &|ms| 60.0 * pulse(ms) + noise(ms)]);
    folder.write("data/test.csv", samples.as_bytes());
    folder.write("data/test.toml", format!("schema = 1\nfile = \"test.csv\"\n{CAR}").as_bytes());
    let test = "schema = 1\n[[vehicle]]\n[[vehicle.test]]\nmass = 1500\nspeed = \"10 m/s\"\nwidth = 1.5\ndepths = [0.3, 0.3]\nrestitution = { record = \"data/test.toml\" }\n";
    folder.write("tests.toml", format!("{test}[fit]\nb0 = \"2 m/s\"\n").as_bytes());
    let json = run(folder.path(), &["stiffness", "tests.toml", "--format", "json"]);
    let answer: Value = serde_json::from_str(&json.out).unwrap_or_else(|_| panic!("{}", json.err));
    close(&answer["tests"][0]["restitution"], 250e3 * AREA / 15e3 - 1.0, 1e-4);
    assert_eq!(answer["has_deviations"], true);
    let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = \"10 m/s\"\nimpact_center = [2, 0.9]\n[[vehicle]]\nbarrier = true\n\
                [contact]\ncrush_plane = 0\n[evidence]\ncontact.record = { file = \"data/test.toml\" }\n[unknown]\ncontact.restitution = { start = 0.1, min = 0, max = 0.5 }\n\
                contact.impulse_ratio = { start = 0.1 }\n";
    folder.write("case.toml", case.as_bytes());
    let json = run(folder.path(), &["reconstruct", "case.toml", "--starts", "4", "--format", "json"]);
    let answer: Value = serde_json::from_str(&json.out).unwrap_or_else(|_| panic!("{}", json.err));
    close(&answer["unknown"]["contact.restitution"]["value"], 250e3 * AREA / 15e3 - 1.0, 1e-3);
    close(&answer["unknown"]["contact.impulse_ratio"]["value"], 0.24, 1e-3);
}

#[test]
fn bad_samples_are_refused_at_their_lines() {
    let good = "time [ms],normal_force [kN]\n-2,0\n-1,0\n0,0\n1,5\n2,0\n";
    assert_eq!(record_of(good, None).1.status, 0);
    for (from, to, says) in [
        ("1,5", "1,high", "test.csv:5:1\n|"),
        ("1,5", "1,high", "normal_force: `high` is not a number"),
        ("1,5", "1,nan", "`nan` is not a finite number"),
        ("1,5", "1", "the row has 1 of 2 cells"),
        ("1,5", "1", "the file may be cut off here"),
        ("1,5", "1,5,6", "the row has 3 of 2 cells"),
        ("1,5", "1,5,6", "remove what is too much"),
        ("1,5", ",5", "correct the time of this row"),
        ("1,5", "-1,5", "time: the time is not later than the one before"),
        ("1,5", ",5", "time: "),
        ("kN]", "kg]", "[kg]: `kg` is a mass; a force is expected"),
        ("kN]", "stone]", "[stone]: "),
        ("[ms]", "[m]", "time: [m]: `m` is a length; a duration is expected"),
        ("time", "t", "time: no column has this name"),
        ("time [ms],normal", "time [ms];normal", "the columns are separated by semicolons or tabs"),
        ("normal_force", "force", "no column has the name of a channel"),
        ("time [ms],normal_force [kN]", "time [ms],time [ms]", "time: 2 columns have this name"),
        ("-1,0\n0,0\n1,5\n2,0\n", "", "the column has 1 of at least two samples"),
        ("1,5", "1,-5", "the barrier would pull"),
    ] {
        let says = says.replace('|', "");
        let (_, run) = record_of(&good.replace(from, to), None);
        assert!([2, 3].contains(&run.status) && run.out.is_empty(), "{to}");
        assert!(run.err.contains(says.trim_end()), "{to}: {}", run.err);
    }
    // All of them at once.
    let (_, run) = record_of("time [ms],normal_force [kN],acceleration [g]\n-2,a,0\n-1,0,b\n0,0\n", None);
    assert_eq!(run.err.matches("error:").count(), 3, "{}", run.err);
}

#[test]
fn bad_settings_are_refused_at_their_keys() {
    let channel = "[[channel]]\ncolumn = \"normal_force.a\"\nquantity = \"normal_force\"\n";
    for (settings, says) in [
        ("mass = \"1500 m\"", "mass: `1500 m` is a length"),
        ("mass = -5", "it must be above zero"),
        ("mass = 1500\nspeed = \"1e-300 m/s\"", "speed: the restitution by the load cells overflows"),
        ("filter = 100", "filter: 100 is no channel frequency class"),
        ("filter = 60\nwindow = [\"50 ms\", \"20 ms\"]", "window: "),
        ("window = [\"0 ms\", \"500 ms\"]", "window: "),
        // Between two samples.
        ("window = [\"10.02 ms\", \"10.08 ms\"]", "window: no sample of"),
        ("baseline = [\"-20 ms\", \"10 ms\"]", "baseline: the channels are loaded from 0 s, and the baseline lasts to 0.010 s"),
        ("resolution = \"1 km/h\"", "resolution: no channel of this recording uses it"),
        ("separation = \"100 ms\"", "separation: no channel of this recording uses it"),
        ("neighbors = 3", "a whole number from 4 to 1000"),
        ("colour = 1", "unknown key"),
        ("[[channel]]\ncolumn = \"x\"\nquantity = \"normal_force\"", "no column has this name"),
        ("[[channel]]\ncolumn = \"normal_force.a\"\nquantity = \"normal_forces\"", "did you mean"),
        (&format!("{channel}calibration = \"5 kN\""), "the column is in kN, and has a calibration too"),
        (&format!("{channel}polarity = 0"), "polarity: it is 0"),
        (&format!("{channel}range = \"-5 kN\""), "range: it is -5000 N; it must be above zero"),
        (&format!("{channel}calibration = \"5 m\""), "`5 m` is a length; a force is expected"),
    ] {
        let (_, run) = record_of(&barrier(), Some(settings));
        assert!(run.status == 2 && run.out.is_empty(), "{settings}: {}", run.err);
        assert!(run.err.contains(says) && run.err.contains("test.toml:"), "{settings}: {}", run.err);
    }
    // The speed is that of every restitution: of the load cells, of the sensor and of the film.
    let folder = Folder::new();
    let example = |name: &str| std::fs::read_to_string(workspace().join("cli/examples/record").join(name)).expect("an example");
    folder.write("barrier.csv", example("barrier.csv").as_bytes());
    folder.write("barrier.toml", example("barrier.toml").replace("\"10 m/s ± 0.03 m/s\"", "\"1e-300 m/s\"").as_bytes());
    let tiny = run(folder.path(), &["record", "barrier.toml"]);
    assert!(tiny.status == 2 && tiny.out.is_empty(), "{}", tiny.err);
    for said in ["overflows: the speed is next to zero", "help: give the closing speed of the test"] {
        assert_eq!(tiny.err.matches(said).count(), 3, "{}", tiny.err);
    }
    let (_, slow) = record_of("time [ms],normal_force [kN]\n-4,0\n-2,0\n0,0\n2,5\n4,0\n", Some("filter = 60\n"));
    assert!(slow.status == 2 && slow.err.contains("filter: normal force: the samples are 0.0020 s apart"), "{}", slow.err);
    let (_, uneven) = record_of("time [ms],normal_force [kN]\n-4,0\n-2,0\n0,0\n1,5\n4,0\n", None);
    assert!(uneven.status == 0 && uneven.out.contains("not-filtered"), "{}", uneven.err);
    let (_, late) = record_of("time [ms],normal_force.a [kN],normal_force.b [kN]\n-1,0,0\n0,0,\n1,5,5\n2,0,0\n", None);
    assert!(late.status == 2 && late.err.contains("normal_force.b: it must be sampled at the same instants"), "{}", late.err);
    let (_, unused) = record_of("time [s],speed,site\n-1,10,a\n0,9,b\n", None);
    assert!(unused.status == 0 && unused.out.contains("unused-columns") && unused.out.contains("unit-assumed"), "{}", unused.out);
    let missing = run(Folder::new().path(), &["record", "none.csv"]);
    assert!(missing.status == 2 && missing.err.contains("`none.csv` cannot be read"), "{}", missing.err);
}

/// A recorder whose sensor holds 50 g, sampled every 10 ms: by hand 4.9 m/s a step at most.
#[test]
fn a_clipped_sensor_inside_a_recorder_is_recognized() {
    let samples = "time [ms],delta_v_forward [m/s]\n0,0\n10,-2\n20,-6.9\n30,-11.8\n40,-14\n50,-14.5\n60,-14.5\n70,-14.5\n80,-14.5\n90,-14.5\n100,-14.5\n";
    let (record, run) = record_of(samples, Some("accelerometer_range = \"50 g\"\nresolution = \"0.1 m/s\""));
    assert_eq!(run.status, 1);
    let [sensor] = &record["recorder"]["clipped_sensors"].as_array().expect("sensors")[..] else { panic!("one sensor") };
    assert_eq!((&sensor["channel"], &sensor["from"], &sensor["to"]), (&json!("delta_v_forward"), &json!(0.01), &json!(0.03)));
    close(&sensor["acceleration"], 490.0, 1e-9);
    let said = run.out.contains("the sensor of delta_v_forward is clipped: from 0.010 s to 0.030 s the velocity changes by up to 490");
    assert!(said, "{}", run.out);
    assert_eq!(record["recorder"]["is_lower_bound"], true);
    let (record, run) = record_of(samples, Some("accelerometer_range = \"60 g\"\nresolution = \"0.1 m/s\""));
    assert_eq!((run.status, &record["recorder"]["is_lower_bound"]), (0, &json!(false)));
    assert!(record["recorder"].get("clipped_sensors").is_none());
    // In steps of 3 m/s no change tells 4.9 m/s from less.
    let (record, run) = record_of(samples, Some("accelerometer_range = \"50 g\"\nresolution = \"3 m/s\""));
    assert_eq!((run.status, &record["recorder"]["is_lower_bound"]), (0, &json!(false)), "{}", run.out);
}

/// As in the documentation of `MeasuredContact::restitution`: e = (0.5 + Ω (0.2 cos 0.05 + 1.5 sin 0.05))/10, with a standard deviation from that of the
/// velocity after, 0.2 m/s, and of the point.
#[test]
fn kinematics_give_the_restitution_of_the_contact_point() {
    let folder = Folder::new();
    let kinematics = "schema = 1\n[kinematics]\nduration = \"100 ms\"\npoint = [\"1.9 m\", \"0 m\"]\npoint_after = [\"1.5 m\", \"0.2 m ± 0.03 m\"]\n\
        before = { velocity = [\"10 m/s\", \"0 m/s\"] }\nafter = { velocity = [\"-0.5 m/s ± 0.2 m/s\", \"0.3 m/s\"], yaw_rate = \"1 rad/s\" }\n";
    folder.write("kinematics.toml", kinematics.as_bytes());
    let run = run(folder.path(), &["record", "kinematics.toml", "--format", "json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let record: Value = serde_json::from_str(&run.out).expect("JSON");
    let found = &record["records"][0]["kinematics"];
    close(&found["restitution"]["value"], 0.0774719, 1e-6);
    close(&found["restitution"]["sd"], 0.02_f64.hypot(0.003 * 0.05_f64.cos()), 1e-9);
    close(&found["separation"][0], -0.774719, 1e-6);
    close(&found["heading_at_separation"], 0.05, 1e-12);
    // Without an uncertainty of its numbers its own is not known.
    folder.write("exact.toml", kinematics.replace(" ± 0.03 m", "").replace(" ± 0.2 m/s", "").as_bytes());
    let exact = crate::process::run(folder.path(), &["record", "exact.toml", "--format", "json"]);
    let exact: Value = serde_json::from_str(&exact.out).expect("JSON");
    let restitution = &exact["records"][0]["kinematics"]["restitution"];
    assert_eq!((&restitution["value"], &restitution["sd"]), (&found["restitution"]["value"], &Value::Null));
    // It is evidence of a barrier test.
    let tests = "schema = 1\n[[vehicle]]\n[[vehicle.test]]\nmass = 1500\nspeed = \"10 m/s\"\nspeed_sd = \"0.1 m/s\"\nrestitution = { record = \"kinematics.toml\" }\nwidth = 1.5\ndepths = [0.3, 0.3]\n\
        [fit]\nb0 = \"2 m/s\"\n";
    folder.write("tests.toml", tests.as_bytes());
    let fit = crate::process::run(folder.path(), &["stiffness", "tests.toml", "--format", "json"]);
    assert_eq!((fit.status, fit.err.as_str()), (0, ""));
    close(&serde_json::from_str::<Value>(&fit.out).expect("JSON")["tests"][0]["restitution"], 0.0774719, 1e-6);
    // A page without channels.
    assert!(crate::process::run(folder.path(), &["record", "kinematics.toml"]).out.contains("0.077"));
}

/// A point that is measured once is one number before and after: with the point at l to the left, e = (1 − Ω l)/(10 − ω l) at once.
#[test]
fn the_error_of_a_point_that_is_measured_once_is_one_error() {
    let folder = Folder::new();
    let sd = |after: &str, point_after: &str| {
        let text = format!(
            "schema = 1\n[kinematics]\nduration = \"0.1 ms\"\npoint = [\"1.9 m\", \"0 m ± 0.1 m\"]\n{point_after}\
             before = {{ velocity = [\"10 m/s\", 0], yaw_rate = \"2 rad/s\" }}\nafter = {{ velocity = [\"-1 m/s\", 0], yaw_rate = \"{after} rad/s\" }}\n"
        );
        folder.write("kinematics.toml", text.as_bytes());
        let found: Value = serde_json::from_str(&run(folder.path(), &["record", "kinematics.toml", "--format", "json"]).out).expect("JSON");
        let restitution = &found["records"][0]["kinematics"]["restitution"];
        close(&restitution["value"], 0.1, 1e-3);
        restitution["sd"].as_f64().expect("a standard deviation")
    };
    // In ratio with the velocities the errors cancel; the other way they add up. The body turns by 2e-4 rad or less in between.
    assert!(sd("-0.2", "") < 1e-5 && (sd("0.2", "") - 0.004).abs() < 1e-5, "{} {}", sd("-0.2", ""), sd("0.2", ""));
    let twice = sd("0.2", "point_after = [\"1.9 m\", \"0 m ± 0.1 m\"]\n");
    assert!((twice - 0.002_f64.hypot(0.002)).abs() < 1e-5, "{twice}");
}

/// Faults of the baseline, of the window and of the filter, each at its own key.
#[test]
fn times_and_filters_are_refused_where_they_stand() {
    let folder = Folder::new();
    let samples = "samples = \"time [ms],normal_force.a [kN]\\n-10,0\\n-5,1\\n0,0\\n10,10\\n20,0\\n30,0\\n\"\n";
    let refused = |settings: &str| {
        folder.write("bad.toml", format!("schema = 1\n{samples}{settings}").as_bytes());
        let run = run(folder.path(), &["record", "bad.toml"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{settings}: {}", run.err);
        run.err
    };
    let found = refused("baseline = [\"-20 ms\", \"0 ms\"]\n");
    assert!(found.contains("error: baseline: the baseline: it is -0.020 s") && !found.contains("window"), "{found}");
    let found = refused("baseline = [\"-20 ms\", \"0 ms\"]\nwindow = [\"0 ms\", \"35 ms\"]\nfilter = 60\n");
    assert!(found.contains("error: baseline: ") && found.contains("error: window: the window: it is 0.035 s"), "{found}");
    assert!(found.contains("error: filter: normal force: ") && found.contains("filter = false"), "{found}");
    let found = refused("window = [\"0 ms\", \"-10 ms\"]\n");
    assert!(found.contains("error: window: the window: ") && !found.contains("baseline"), "{found}");
    let found = refused("baseline = [\"0 ms\", \"-10 ms\"]\n");
    assert!(found.contains("error: baseline: the baseline: ") && !found.contains("window"), "{found}");
    let found = refused("baseline = [\"-6 ms\", \"-4 ms\"]\n");
    assert!(found.contains("error: baseline: the baseline: ") && found.contains(" 1 "), "{found}");
    folder.write("none.csv", b"time [s],normal_force [N]\n-2,0\n-1,0\n0,0\n1,0\n");
    let none = run(folder.path(), &["record", "none.csv"]);
    assert!(none.status == 3 && none.err.contains("there is no impact") && !none.err.contains("polarity"), "{}", none.err);
}

/// The samples of a file in the file itself, of a recording and of a case.
#[test]
fn samples_stand_in_the_file_itself() {
    let samples = "time [s],speed [km/h],delta_v_forward [km/h]\n-1,50,\n0,50,0\n0.05,,-8\n0.1,,-14\n0.15,,-15\n0.2,,-15\n0.25,,-15\n";
    let (beside, _) = record_of(samples, Some(""));
    let folder = Folder::new();
    folder.write("inline.toml", format!("schema = 1\nsamples = \"\"\"\n{samples}\"\"\"\n").as_bytes());
    let inline = run(folder.path(), &["record", "inline.toml", "--format", "json"]);
    assert_eq!((inline.status, inline.err.as_str()), (0, ""));
    let inline: Value = serde_json::from_str(&inline.out).expect("JSON");
    assert_eq!(inline["records"][0]["recorder"], beside["recorder"]);
    let case = |recorder: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n\
         [contact]\ncrush_plane = 0\nrestitution = 0.1\n[evidence.vehicle.1]\nrecorder = {recorder}\n[unknown]\nvehicle.1.speed = {{ start = 10, min = 0 }}\n"
        )
    };
    folder.write("edr.csv", samples.as_bytes());
    folder.write("file.toml", case("{ file = \"edr.csv\", resolution = \"1 km/h\", use = [\"speed\"] }").as_bytes());
    folder.write(
        "samples.toml",
        case(&format!("{{ samples = \"{}\", resolution = \"1 km/h\", use = [\"speed\"] }}", samples.replace('\n', "\\n"))).as_bytes(),
    );
    let [file, text] = ["file.toml", "samples.toml"].map(|name| run(folder.path(), &["reconstruct", name, "--format", "json"]));
    let evidence = |run: &Run| serde_json::from_str::<Value>(&run.out).expect("JSON")["evidence"].clone();
    assert_eq!(evidence(&file), evidence(&text), "{}{}", file.err, text.err);
}

/// Every fault of every file, and what is wrong with keys that belong together.
#[test]
fn bad_recordings_are_refused_all_at_once() {
    let folder = Folder::new();
    folder.write("a.csv", b"time [s],speed [m/s]\n0,1\n1,x\n");
    folder.write("b.toml", b"schema = 1\nfile = \"none.csv\"\n");
    folder.write("c.csv", b"time [s],speed [m/s]\n0,1\n1");
    let refused = run(folder.path(), &["record", "a.csv", "b.toml", "c.csv"]);
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    for wanted in ["--> a.csv:3", "--> b.toml:2", "none.csv", "--> c.csv:3"] {
        assert!(refused.err.contains(wanted), "{wanted}: {}", refused.err);
    }
    let missing = run(folder.path(), &["record", "a.csv", "none.csv"]);
    assert_eq!((missing.err.matches("-->").count(), missing.err.matches("none.csv").count()), (1, 1), "{}", missing.err);
    for (text, wanted) in [
        ("file = \"x.csv\"\nsamples = \"time\"", "exclude each other"),
        ("", "missing `file` or `samples`"),
        ("samples = \"\"\"\ntime [s],speed [m/s]\n0,1\n1,y\n\"\"\"", ":3: speed"),
        ("samples = \"time [s],speed [m/s]\\n0,1\\n1,2\"\naccelerometer_range = \"50 g\"", "no channel of this recording uses it"),
        ("samples = \"time [s],delta_v_forward [m/s]\\n0,0\\n1,2\"\naccelerometer_range = \"-50 g\"", "accelerometer_range"),
        ("samples = \"time [s],delta_v_forward [m/s]\\n0,0\\n1,2\"\naccelerometer_range = \"50 km/h\"", "an acceleration is expected"),
        ("[kinematics]\nduration = 0.1\npoint = [1, 0]\nbefore = { velocity = [10, 0] }", "kinematics.after: missing"),
        ("[kinematics]\nduration = -0.1\npoint = [1, 0]\nbefore = { velocity = [10, 0] }\nafter = { velocity = [-1, 0] }", "duration"),
        ("[kinematics]\nduration = 0.1\npoint = [1, 0]\nbefore = { velocity = [0, 5] }\nafter = { velocity = [-1, 0] }", "error: "),
        (
            "[kinematics]\nduration = \"0.1 m\"\npoint = [1, 0]\nbefore = { velocity = [10, 0] }\nafter = { velocity = [-1, 0] }",
            "a duration is expected",
        ),
        (
            "mass = 1500\n[kinematics]\nduration = 0.1\npoint = [1, 0]\nbefore = { velocity = [10, 0] }\nafter = { velocity = [-1, 0] }",
            "no channel of this recording uses it",
        ),
    ] {
        folder.write("bad.toml", format!("schema = 1\n{text}\n").as_bytes());
        let refused = run(folder.path(), &["record", "bad.toml"]);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{text}: {}", refused.err);
        assert!(refused.err.contains(wanted), "{text}: {}", refused.err);
    }
}

/// A case names tests, these name a recording, and that names its samples; each lies beside the file that names it.
#[test]
fn the_tests_of_a_case_may_be_recorded() {
    let folder = Folder::new();
    for (name, from) in [("barrier.csv", "barrier.csv"), ("barrier.toml", "barrier.toml")] {
        let text = std::fs::read(workspace().join("cli/examples/record").join(from)).expect("an example");
        folder.write(&format!("data/{name}"), &text);
    }
    let tests = |speed: &str| {
        format!(
            "schema = 1\n[[vehicle]]\n[[vehicle.test]]\nmass = 1500\nspeed = \"{speed}\"\nspeed_sd = \"0.03 m/s\"\nrestitution = {{ record = \"barrier.toml\" }}\nwidth = 1.5\ndepths = [0.3, 0.3]\n\
         [fit]\nb0 = \"2 m/s\"\n"
        )
    };
    let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n\
        [vehicle.crush]\nwidth = 1.5\ndepths = [0.3, 0.3]\nstiffness = { tests = \"data/tests.toml\" }\n\
        [[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n";
    folder.write("case.toml", case.as_bytes());
    // The recording was made at 10 m/s ± 0.03 m/s.
    for (speed, differs) in [("10.05 m/s", false), ("11 m/s", true)] {
        folder.write("data/tests.toml", tests(speed).as_bytes());
        for call in [["stiffness", "data/tests.toml"], ["crush", "case.toml"]] {
            let answer = run(folder.path(), &call);
            assert!(answer.err.is_empty() && answer.status == 0, "{}", answer.err);
            let words = answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(words.contains("its restitution is for that speed"), differs, "{speed} {call:?}: {}", answer.out);
        }
    }
    // No file that is named along the way is written over.
    for of in [&["case.toml", "--verb", "crush"][..], &["data/tests.toml", "--verb", "stiffness"], &["case.toml"]] {
        for named in ["data/tests.toml", "data/barrier.toml", "data/barrier.csv"] {
            let before = std::fs::read(folder.path().join(named)).expect("it is there");
            let refused = run(folder.path(), &[&["report"], of, &["-o", named]].concat());
            assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{of:?} {named}: {}", refused.err);
            assert!(refused.err.contains("would be replaced; name another file to write"), "{of:?} {named}: {}", refused.err);
            assert_eq!(std::fs::read(folder.path().join(named)).expect("it is there"), before, "{of:?} {named}");
        }
    }
    let drawn = run(folder.path(), &["draw", "case.toml", "-o", "data/barrier.csv"]);
    assert!(drawn.status == 2 && drawn.err.contains("would be replaced"), "{}", drawn.err);
}

/// A pulse that is cut at its beginning lacks as much as one that is cut at its end.
#[test]
fn a_record_that_begins_within_the_pulse_is_truncated() {
    let from = |first: f64, column: &str| {
        let rows = times().filter(|ms| *ms >= first).map(|ms| format!("{ms},{}\n", pulse(ms)));
        record_of(&format!("time [ms],{column}\n{}", rows.collect::<String>()), None)
    };
    for column in ["normal_force.a [kN]", "acceleration.a [g]"] {
        let (whole, run) = from(-20.0, column);
        assert!(run.status == 0 && whole["channels"][0]["is_truncated"] == false, "{column}");
        let (cut, run) = from(30.0, column);
        assert!(run.status == 1 && cut["channels"][0]["is_truncated"] == true, "{column}");
        assert!(run.out.contains("it begins at 0.030 s after the event has begun"), "{}", run.out);
        // At its very beginning nothing is missing.
        assert_eq!(from(0.0, column).1.status, 0, "{column}");
    }
}

#[test]
fn a_window_that_ends_within_the_pulse_is_named() {
    let samples = csv("normal_force.a [kN]", &[&pulse]);
    let of = |window: &str| record_of(&samples, Some(&format!("window = {window}\n"))).1.out;
    let half = of("[\"0 ms\", \"50 ms\"]");
    assert!(half.contains("cut-by-window") && half.contains("the window ends at 0.050 s within the pulse: normal force is "), "{half}");
    assert!(of("[\"50 ms\", \"110 ms\"]").contains("the window begins at 0.050 s within the pulse"));
    assert!(!of("[\"0 ms\", \"110 ms\"]").contains("cut-by-window"));
}

/// Readings in whole steps that a uniform motion crosses have no scatter, and an unloaded channel that stays on one step has no noise: what is uncertain is the
/// step itself.
#[test]
fn the_step_of_a_reading_is_in_its_standard_deviation() {
    // 10.04 m/s on a film that is read to a centimeter, in frames of a millisecond.
    let read = |ms: f64| (-1.004 * ms).round() * 10.0 + 300.0;
    let film: String =
        (-29..=60).map(|ms| format!("{ms},{}\n", if ms <= 0 { read(ms.into()) } else { read(0.0) + f64::from(ms) })).collect();
    let (found, _) = record_of(&format!("time [ms],distance.a [mm]\n{film}"), None);
    let closing = &found["films"][0]["closing_speed"];
    let number = |key: &str| closing[key].as_f64().unwrap_or(f64::NAN);
    assert!((number("value") - 10.04).abs() < 3.0 * number("sd") && number("sd") < 1.0, "{closing}");
    // Forces in steps of 5 kN: the offset is anywhere within a step, for the whole of the contact.
    let coarse = |ms: f64| (40.0 * pulse(ms)).round() * 5.0;
    let (found, _) = record_of(&csv("normal_force.a [kN]", &[&coarse]), Some("window = [\"0 ms\", \"110 ms\"]\n"));
    let impulse = &found["barrier"]["normal_impulse"];
    close(&impulse["sd"], 5e3 / 12_f64.sqrt() * 0.11, 1e-9);
    // Steps that are no whole number of the last printed digit.
    for step in [200.0 / 256.0, 2.0 / 3.0, 100.0 / 256.0] {
        let read = |ms: f64| format!("{:.3}", (20.0 * pulse(ms) / step).round() * step).parse().expect("a number");
        let (found, _) = record_of(&csv("acceleration.a [g]", &[&read]), Some("window = [\"0 ms\", \"110 ms\"]\n"));
        close(&found["accelerations"][0]["delta_v"]["sd"], 9.80665 * step / 12_f64.sqrt() * 0.11, 1e-3);
    }
    // What only seems to have steps does not.
    let noisy = |ms: f64| 20.0 * pulse(ms) + 0.01 * (7.3 * ms * ms).sin();
    let (found, _) = record_of(&csv("acceleration.a [g]", &[&noisy]), Some("window = [\"0 ms\", \"110 ms\"]\n"));
    let sd = found["accelerations"][0]["delta_v"]["sd"].as_f64().expect("a number");
    assert!(sd > 1e-5 && sd < 1e-2, "{sd}");
}

/// A smooth pulse has no two neighboring readings by chance: what is known is the last printed digit. Two columns of the same digits are equally uncertain.
#[test]
fn the_last_digit_of_a_reading_is_its_least_step() {
    let samples = |decimals: usize, unit: &str| {
        let mut text = format!("time [ms],normal_force.a [{unit}],tangential_force.a [{unit}]\n");
        for ms in (-20..=120).map(f64::from) {
            let [normal, tangential] = [300.0, 90.0].map(|height| height * pulse(ms));
            writeln!(text, "{ms},{normal:.decimals$},{tangential:.decimals$}").expect("a string takes everything");
        }
        text
    };
    for (decimals, unit, digit) in [(1, "kN", 100.0), (2, "kN", 10.0), (0, "kN", 1000.0), (1, "N", 0.1)] {
        let (found, run) = record_of(&samples(decimals, unit), Some("window = [\"0 ms\", \"110 ms\"]\n"));
        for impulse in ["normal_impulse", "tangential_impulse"] {
            let sd = &found["barrier"][impulse]["sd"];
            assert!(sd.as_f64().is_some_and(|sd| sd > 0.99 * digit / 12_f64.sqrt() * 0.11), "{impulse}: {sd}, {decimals} {}", run.err);
            close(sd, digit / 12_f64.sqrt() * 0.11, 1e-6);
        }
    }
    // Steps of whole digits, of which no two samples are one step apart.
    let counts = [0.0, 0.0, 0.0, 0.0, 6.0, 16.0, 30.0, 40.0, 46.0, 50.0, 46.0, 36.0, 30.0, 16.0, 6.0, 0.0, 0.0];
    let rows: String = counts.iter().enumerate().map(|(i, count)| format!("{},{count}\n", i as f64 - 3.0)).collect();
    let (found, _) = record_of(&format!("time [ms],normal_force [kN]\n{rows}"), None);
    close(&found["barrier"]["normal_impulse"]["sd"], 2e3 / 12_f64.sqrt() * 0.013, 1e-6);
    // As evidence it is uncertain enough to be used; without unloaded samples it is not, and then those help.
    let case = |samples: &str| {
        let folder = Folder::new();
        folder.write("test.csv", samples.as_bytes());
        let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = \"10 m/s\"\nimpact_center = [2, 0.9]\n[[vehicle]]\nbarrier = true\n\
                    [contact]\ncrush_plane = 0\nrestitution = 0.1\n[evidence]\ncontact.record = { file = \"test.csv\" }\n[unknown]\ncontact.impulse_ratio = { start = 0.1 }\n";
        folder.write("case.toml", case.as_bytes());
        run(folder.path(), &["reconstruct", "case.toml", "--starts", "4"])
    };
    let whole = samples(2, "kN");
    assert_eq!(case(&whole).status, 0, "{}", case(&whole).err);
    let late: Vec<&str> = whole.lines().filter(|line| !line.starts_with('-')).collect();
    let refused = case(&late.join("\n"));
    assert!(refused.status == 2 && refused.err.contains("begin the samples before the contact"), "{}", refused.err);
}

/// An offset between two readings, with noise of a fifth of their step, toggles between them: how often tells the offset no better than the step, whatever the number of
/// samples. Noise of a whole step averages it out.
#[test]
fn a_toggling_baseline_does_not_tell_its_offset() {
    // Quantiles of the logistic distribution, which is nearly normal, in an order that looks random.
    let noise = |ms: f64| {
        let share = ((ms + 20.05) * 10.0 * 0.618_033_988_75).fract();
        0.6 * (share / (1.0 - share)).ln()
    };
    let sd = |level: f64| {
        let samples = csv("normal_force [kN]", &[&|ms| (300.0 * pulse(ms) + 1.65 + level * noise(ms)).round()]);
        let (found, run) = record_of(&samples, Some("window = [\"0 ms\", \"100 ms\"]\n"));
        found["barrier"]["normal_impulse"]["sd"].as_f64().unwrap_or_else(|| panic!("{}", run.err))
    };
    let of_step = 1e3 / 12_f64.sqrt() * 0.1;
    for level in [0.0, 0.1, 0.2] {
        assert!((of_step..1.05 * of_step).contains(&sd(level)), "{level}: {}", sd(level));
    }
    assert!(sd(1.0) < 0.5 * of_step, "{}", sd(1.0));
}
