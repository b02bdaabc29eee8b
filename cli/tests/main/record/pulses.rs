//! Forces and accelerations: closed forms, noise, offsets, incomplete and disturbed channels, and tests of a case.

use super::*;

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
    // The offsets are exact, so the noise of the unloaded channels is rounding: what is left is what lies between the samples.
    close(&barrier["normal_impulse"]["sd"], of_sampling(250e3, 0.1, 1000.0), 1e-6);
    close(&barrier["tangential_impulse"]["sd"], of_sampling(60e3, 0.1, 1000.0), 1e-6);
    close(&barrier["impulse_ratio"]["sd"], 0.24 * 2_f64.sqrt() * of_sampling(1.0, 0.1, 1000.0) / AREA, 1e-6);
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
    // ±1 kN in turn, 0.1 ms apart: σ² of 200 samples is 200/199 kN², each with the weight 0.1 ms, and the baseline with that of 1200 of them. Student's quantile of
    // 199 degrees of freedom is 1.971957, the normal one 1.959964.
    let noise = |ms: f64| if (ms * 10.0).round() as i64 % 2 == 0 { 1.0 } else { -1.0 };
    let (record, _) = record_of(&csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms) + noise(ms)]), None);
    // Between samples it bends by 4 kN at each.
    let of_noise = 200.0_f64 / 199.0 * (1199.5 + 1200.0 * 1200.0 / 200.0) * (1.971_957_f64 / 1.959_964).powi(2);
    let sd = (of_noise + 1200.0 * 16.0 / 144.0).sqrt() * 0.1;
    close(&record["barrier"]["normal_impulse"]["sd"], sd, 2e-4);
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

/// Of a few samples the noise is hardly known.
#[test]
fn a_baseline_of_few_samples_is_told() {
    let samples = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]);
    let many = "short-baseline";
    for (end, is_told, words) in [("-19.6 ms", true, "5 samples"), ("-18.9 ms", true, "12 samples"), ("-18.8 ms", false, many)] {
        let (_, run) = record_of(&samples, Some(&format!("baseline = [\"-20 ms\", \"{end}\"]\n")));
        assert_eq!((run.status, run.out.contains(many), run.out.contains(words)), (0, is_told, is_told), "{end}: {}{}", run.out, run.err);
    }
}

/// Samples of a filtered sensor count as fewer, and those that go on from nothing as they are.
#[test]
fn a_baseline_of_correlated_samples_is_told_with_their_number() {
    let told = |noise: &dyn Fn(f64) -> f64| {
        let samples = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms) + noise(ms)]);
        record_of(&samples, Some("baseline = [\"-20 ms\", \"-19 ms\"]\n")).1.out
    };
    assert!(told(&|_| 0.0).contains("a baseline of 11 samples hardly tells the noise"));
    assert!(told(&|ms| (0.6 * ms).sin()).contains("a baseline of 11 samples, correlated as "));
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

/// Forces of 100 kN and, a thousand times too large, of 30 MN; of 250 kN, which is 2.5 times as much, they may be meant.
#[test]
fn an_impossible_impulse_ratio_is_a_warning() {
    let warned = |tangential: f64| {
        let samples = csv("normal_force [kN],tangential_force [kN]", &[&|ms| 100.0 * pulse(ms), &|ms| tangential * pulse(ms)]);
        let (record, run) = record_of(&samples, None);
        close(&record["barrier"]["impulse_ratio"]["value"], tangential / 100.0, 1e-6);
        run.out.contains("no friction makes an impulse ratio of")
    };
    assert_eq!([30.0, 250.0, -310.0, 3e4].map(warned), [false, false, true, true]);
}

/// By hand: a test of 1500 kg at 5 m/s with an impulse of 250 kN · 2 T/π leaves faster than it came.
#[test]
fn an_impossible_restitution_is_a_warning() {
    let (record, run) = record_of(&barrier(), Some("mass = 1500\nspeed = \"5 m/s\"\n"));
    close(&record["barrier"]["restitution"]["value"], 250e3 * AREA / 7500.0 - 1.0, 2e-5);
    assert_eq!((run.status, record_of(&barrier(), Some(CAR)).1.status), (1, 0), "it does not hold");
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

/// A force that was not connected would be a ratio of zero that is known almost exactly. One silent cell of several is none.
#[test]
fn a_force_that_never_changes_is_named() {
    type Force = fn(f64) -> f64;
    let normal = |ms: f64| 250.0 * pulse(ms);
    let cases: [(&str, Force, bool); 5] = [
        ("normal_force [kN],tangential_force [kN]", |_| 0.0, true),
        ("normal_force [kN],tangential_force [kN]", |_| -1.5, true),
        ("normal_force [kN],tangential_force [kN]", |ms| 60.0 * pulse(ms), false),
        ("normal_force.a [kN],normal_force.b [kN]", |_| 0.0, false),
        ("normal_force [kN],acceleration [m/s^2]", |_| 0.0, true),
    ];
    for (columns, other, is_named) in cases {
        let (_, run) = record_of(&csv(columns, &[&normal, &other]), Some(CAR));
        let json: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{columns}: {}", run.err));
        let all = json["messages"].as_array().map_or(&[][..], Vec::as_slice);
        let named: Vec<&str> =
            all.iter().filter(|message| message["code"] == "no-event").filter_map(|message| message["text"].as_str()).collect();
        assert_eq!(named.len(), usize::from(is_named), "{columns}: {named:?}");
        assert!(named.iter().all(|text| text.contains("at every sample, so that nothing was measured: leave it out")), "{named:?}");
    }
}

/// A time zero that is set late leaves the begin of the pulse in the baseline: it is warned of, and the remedy brings it back.
#[test]
fn a_load_before_time_zero_is_warned_of() {
    let noise = |ms: f64| 0.2 * ((ms * 37.0).sin() + (ms * 91.0).cos());
    let of = |late: f64, settings: &str| {
        let force = |ms: f64| 250.0 * pulse(ms + late) + noise(ms);
        let (record, run) = record_of(&csv("normal_force [kN]", &[&force]), Some(&format!("{settings}{CAR}")));
        assert!(run.status <= 1, "{}", run.err);
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        let all = json["messages"].as_array().cloned().unwrap_or_default();
        let found: Vec<Value> = all.into_iter().filter(|message| message["code"] == "loaded-baseline").collect();
        (record, found)
    };
    assert_eq!(of(0.0, "").1, [] as [Value; 0]);
    let (record, found) = of(4.0, "");
    assert_eq!(found.len(), 1);
    // Of the last sample before time zero, 3.9 ms into the pulse.
    close(&found[0]["figures"][0]["value"], 250e3 * (PI * 0.039).sin(), 0.03);
    close(&found[0]["figures"][1]["value"], -1e-4, 1e-6);
    let impulse = |record: &Value| record["barrier"]["normal_impulse"]["value"].as_f64().expect("an impulse");
    let (mended, found) = of(4.0, "baseline = [\"-20 ms\", \"-5 ms\"]\nwindow = [\"-5 ms\", \"120 ms\"]\n");
    assert_eq!(found, [] as [Value; 0]);
    assert!((impulse(&mended) / (250e3 * AREA) - 1.0).abs() < 1e-3, "{}", impulse(&mended));
    assert!(impulse(&record) < 0.99 * 250e3 * AREA);
}

/// A last line of spaces is an empty line.
#[test]
fn lines_of_spaces_are_no_samples() {
    let text = csv("normal_force [kN]", &[&|ms| 250.0 * pulse(ms)]);
    let [bare, spaced] = [text.clone(), text + " \t \n"].map(|text| record_of(&text, Some(CAR)));
    assert_eq!((bare.1.status, bare.0["barrier"].clone()), (spaced.1.status, spaced.0["barrier"].clone()));
    assert!(bare.0["barrier"].is_object());
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
    let of = |mass: f64, speed: &str, center: &str, other: &str| {
        let more = if speed.is_empty() { "vehicle.1.speed = { start = 12, sd = 3 }\n" } else { "" };
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = {mass}\nyaw_inertia = 2500\nheading = 0\n{speed}\nyaw_rate = 12\nimpact_center = {center}\n[[vehicle]]\n{other}\n\
             [contact]\ncrush_plane = 0\n[evidence]\ncontact.record = {{ file = \"data/test.toml\" }}\n[unknown]\ncontact.restitution = {{ start = 0.1, min = 0, max = 0.5 }}\n\
             contact.impulse_ratio = {{ start = 0.1 }}\n{more}"
        );
        folder.write("case.toml", case.as_bytes());
        run(folder.path(), &["reconstruct", "case.toml", "--starts", "4", "--format", "json"])
    };
    let json = of(1500.0, "speed = 10", "[2, 0]", "barrier = true");
    let answer: Value = serde_json::from_str(&json.out).unwrap_or_else(|_| panic!("{}", json.err));
    let of_center = 250e3 * AREA / 15e3 - 1.0;
    close(&answer["unknown"]["contact.restitution"]["value"], of_center, 1e-3);
    close(&answer["unknown"]["contact.impulse_ratio"]["value"], 0.24, 1e-3);
    assert!(!json.out.contains("another-test") && !json.out.contains("test-of-barrier"), "{}", json.out);
    // Beside the normal through the center of mass, 1 + e is 1 + (t² − μ n t)/k² times that of the center of mass.
    let off = of(1500.0, "speed = 10", "[2, 0.9]", "barrier = true");
    let there = (1.0 + of_center) * (1.0 + (0.81 - 0.24 * 1.8) / (2500.0 / 1500.0)) - 1.0;
    let remedy = format!("give contact.restitution = \"{:.3}", there - 5e-4);
    let words = off.err.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(off.status == 2 && words.contains(&remedy) && words.contains("contact.impulse_ratio = \"0.24"), "{} {remedy}", off.err);
    assert!(off.err.contains("0.90 m beside the normal through it"), "{}", off.err);
    for (mass, speed, other, code) in [
        (1700.0, "speed = 10", "barrier = true", "another-test"),
        (1500.0, "speed = 12", "barrier = true", "another-test"),
        (
            1500.0,
            "speed = 10",
            "mass = 1000\nyaw_inertia = 1500\nheading = \"180 deg\"\nspeed = 0\nimpact_center = [2, 0]",
            "test-of-barrier",
        ),
    ] {
        let warned = of(mass, speed, "[2, 0]", other);
        assert!(warned.out.matches(&format!("\"{code}\"")).count() == 1, "{code}: {} {}", warned.out, warned.err);
    }
    // Of a speed that is sought the start is no other test.
    let sought = of(1500.0, "", "[2, 0]", "barrier = true");
    assert!(sought.status <= 1 && !sought.out.is_empty() && !sought.out.contains("another-test"), "{} {}", sought.out, sought.err);
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
            let _ = std::fs::remove_file(folder.path().join("link.html"));
            std::os::unix::fs::symlink(named, folder.path().join("link.html")).expect("a link");
            let refused = run(folder.path(), &[&["report"], of, &["-o", "link.html"]].concat());
            assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{of:?} {named}: {}", refused.err);
            assert!(refused.err.contains("would be replaced; name another file to write"), "{of:?} {named}: {}", refused.err);
            assert_eq!(std::fs::read(folder.path().join(named)).expect("it is there"), before, "{of:?} {named}");
        }
    }
    std::os::unix::fs::symlink("data/barrier.csv", folder.path().join("link.svg")).expect("a link");
    let drawn = run(folder.path(), &["draw", "case.toml", "-o", "link.svg"]);
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

/// The warnings of a code for a normal force of 100 kN that these samples disturb.
fn warned(code: &str, settings: &str, disturbance: &dyn Fn(f64) -> f64) -> Vec<String> {
    let samples = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms) + disturbance(ms)]);
    let (_, run) = record_of(&samples, Some(&format!("{CAR}{settings}")));
    assert!(run.status <= 1, "{}", run.err);
    let json: Value = serde_json::from_str(&run.out).expect("JSON");
    let notices = json["messages"].as_array().into_iter().flatten().filter(|notice| notice["code"] == code);
    notices.map(|notice| notice["text"].as_str().expect("a sentence").to_owned()).collect()
}

/// A channel that is lost for a while has no part of the pulse; one that returns to its offset does so from sample to sample.
#[test]
fn a_lost_stretch_of_a_pulse_is_told() {
    let lost = |from: f64, to: f64, value: f64| move |ms: f64| if (from..=to).contains(&ms) { value - 100.0 * pulse(ms) } else { 0.0 };
    let told = warned("dropout", "", &lost(39.95, 60.05, 0.0));
    assert_eq!(told.len(), 1);
    assert!(told[0].contains("normal_force goes to 0 N, holds it from 0.040 s to 0.060 s, and returns"), "{told:?}");
    // Whatever it is held at, above the pulse or below, and for three samples; the last reading, an end, and less than a fifth of the pulse are none.
    assert_eq!(warned("dropout", "", &lost(20.0, 25.0, 150.0)).len(), 1);
    assert_eq!(warned("dropout", "", &lost(29.95, 30.25, -20.0)).len(), 1);
    for (from, to, value) in [(29.95, 30.15, 0.0), (80.0, 120.0, 0.0), (-20.0, 30.0, 0.0), (48.0, 52.0, 85.0)] {
        assert!(warned("dropout", "", &lost(from, to, value)).is_empty(), "{from} to {to}");
    }
    // Two pulses with nothing between them, and steps of a coarse recorder.
    assert!(warned("dropout", "", &|ms| -100.0 * pulse(ms) + 80.0 * (pulse(2.5 * ms) + pulse(2.5 * (ms - 60.0)))).is_empty());
    assert!(warned("dropout", "", &|ms| (5.0 * pulse(ms)).round() * 20.0 - 100.0 * pulse(ms)).is_empty());
}

/// A channel that holds one value within the pulse and leaves it at once was frozen; at an extreme it is clipped, and what is lost returns.
#[test]
fn a_frozen_stretch_of_a_pulse_is_told() {
    let frozen = |channel: &dyn Fn(f64) -> f64| -> Vec<String> {
        let (_, run) = record_of(&csv("normal_force [kN]", &[channel]), Some(CAR));
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        let notices = json["messages"].as_array().into_iter().flatten().filter(|notice| notice["code"] == "frozen");
        notices.map(|notice| notice["text"].as_str().expect("a sentence").to_owned()).collect()
    };
    let held = |from: f64, to: f64| frozen(&|ms| 100.0 * pulse(if (from..=to).contains(&ms) { from } else { ms }));
    let told = held(20.0, 40.0);
    assert_eq!(told.len(), 1);
    assert!(told[0].contains("normal_force holds ") && told[0].contains(" from 0.020 s to 0.040 s and leaves it at once"), "{told:?}");
    assert_eq!(held(79.95, 90.0).len(), 1);
    // Near the unloaded value, at the top, for three samples, and until the end.
    for (from, to) in [(1.0, 4.0), (50.0, 52.0), (20.0, 20.25), (80.0, 500.0)] {
        assert!(held(from, to).is_empty(), "{from} to {to}");
    }
    assert!(frozen(&|ms| (5.0 * pulse(ms)).round() * 20.0).is_empty());
}

#[test]
fn a_sum_beside_its_parts_is_refused() {
    let parts = |sum: f64| {
        csv(
            "normal_force.a [kN],normal_force [kN],normal_force.b [kN]",
            &[&|ms| 100.0 * pulse(ms), &|ms| 250.0 * pulse(ms) + sum, &|ms| 150.0 * pulse(ms)],
        )
    };
    let (_, run) = record_of(&parts(0.0), None);
    assert!(
        run.status == 2 && run.err.contains("it is the sum of normal_force.a and normal_force.b: every force would count twice"),
        "{}",
        run.err
    );
    assert!(run.err.contains("leave its column out, or those that it sums"), "{}", run.err);
    assert_ne!(record_of(&parts(1.0), None).1.status, 2);
    // In whole kN a cell that carries half of a force is as much the sum of the others, if all have one shape.
    let halves = |other: fn(f64) -> f64| {
        let round = |kilonewtons: f64| 1000.0 * (kilonewtons / 1000.0).round();
        let cells: [&dyn Fn(f64) -> f64; 3] =
            [&|ms| round(40e3 * pulse(ms)), &|ms| round(40e3 * pulse(ms) + 60e3 * other(ms)), &|ms| round(60e3 * other(ms))];
        record_of(&csv("normal_force.a [N],normal_force.b [N],normal_force.c [N]", &cells), None).1
    };
    let [alike, unlike] = [halves(pulse), halves(|ms| pulse(ms).powi(3))];
    assert!(alike.status != 2 && alike.out.contains("\"sum-of-others\""), "{}{}", alike.out, alike.err);
    assert!(unlike.status == 2 && unlike.err.contains("every force would count twice"), "{}", unlike.err);
    // Two cells that read alike, beside one that reads nothing.
    let twins =
        csv("normal_force.a [kN],normal_force.b [kN],normal_force.c [kN]", &[&|ms| 100.0 * pulse(ms), &|ms| 100.0 * pulse(ms), &|_| 0.0]);
    assert_ne!(record_of(&twins, None).1.status, 2);
}

#[test]
fn sensors_that_disagree_are_told() {
    let told = |cells: f64, other: f64| {
        let all = csv(
            "normal_force [kN],acceleration.a [m/s^2],acceleration.b [m/s^2]",
            &[&|ms| cells * 150.0 * pulse(ms), &|ms| -100.0 * pulse(ms), &|ms| other * 100.0 * pulse(ms)],
        );
        let listed = |column: &str, quantity: &str| format!("[[channel]]\ncolumn = \"{column}\"\nquantity = \"{quantity}\"\n");
        let [force, one, other] =
            [("normal_force", "normal_force"), ("acceleration.a", "acceleration"), ("acceleration.b", "acceleration")]
                .map(|(column, quantity)| listed(column, quantity));
        let (_, run) = record_of(&all, Some(&format!("{CAR}{force}{one}polarity = -1\n{other}")));
        assert!(run.status <= 1, "{}", run.err);
        let json: Value = serde_json::from_str(&run.out).expect("JSON");
        let told = json["messages"].as_array().into_iter().flatten().find(|notice| notice["code"] == "sensors-disagree");
        told.map(|notice| notice["text"].as_str().expect("a sentence").to_owned())
    };
    assert_eq!((told(1.0, 1.0), told(1.04, 1.04)), (None, None));
    let of_sensors = told(1.0, 1.2).expect("20 % apart");
    assert!(of_sensors.starts_with("the load cells and acceleration.b give velocity changes of "), "{of_sensors}");
    assert!(told(1.2, 1.0).expect("20 % apart").starts_with("the load cells and acceleration.a give"));
}

/// What a file says of its channels may lack the unit of their columns as well as they do.
#[test]
fn a_unit_that_is_assumed_is_told_of_a_listed_channel_too() {
    let rows: String = (-20..=120).map(|i| format!("{i},{}\n", 100.0 * pulse(i.into()))).collect();
    let told = |header: &str, settings: &str| {
        let run = record_of(&format!("{header}\n{rows}"), Some(settings)).1;
        let json: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let notes = json["messages"].as_array().into_iter().flatten().filter(|note| note["code"] == "unit-assumed").cloned();
        notes.map(|note| note["text"].as_str().expect("a text").to_owned()).collect::<Vec<_>>()
    };
    let listed = "[[channel]]\ncolumn = \"F\"\nquantity = \"normal_force\"\n";
    assert_eq!(told("time [ms],F", listed), ["the column F has no unit: N assumed"]);
    assert_eq!(told("time,F [kN]", listed), ["the column time has no unit: s assumed"]);
    assert_eq!(told("time [ms],F", &format!("{listed}calibration = \"1 kN\"\n")), [""; 0]);
    assert_eq!(told("time [ms],normal_force", ""), ["the column normal_force has no unit: N assumed"]);
    assert_eq!(told("time [ms],normal_force [kN]", ""), [""; 0]);
}

/// Of two columns of one quantity one in km/h and one without a unit are hardly in different units.
#[test]
fn a_column_without_a_unit_beside_one_that_has_one_is_told() {
    let rows: String = (0..=20).map(|i| format!("{},{},{}\n", 10 * i, -2 * i.min(10), i.min(10))).collect();
    let told = |header: &str| {
        let run = record_of(&format!("{header}\n{rows}"), None).1;
        let json: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let all = json["messages"].as_array().cloned().unwrap_or_default();
        let mixed = all.into_iter().filter(|message| message["code"] == "mixed-units");
        mixed.map(|message| message["text"].as_str().expect("a text").to_owned()).collect::<Vec<_>>()
    };
    let mixed = "the column delta_v_left has no unit and counts in m/s, beside delta_v_forward, which is in km/h: write its unit";
    assert_eq!(told("time [ms],delta_v_forward [km/h],delta_v_left"), [mixed]);
    assert_eq!(told("time [ms],delta_v_forward [m/s],delta_v_left"), [""; 0]);
    assert_eq!(told("time [ms],delta_v_forward [km/h],delta_v_left [mph]"), [""; 0]);
}

/// Milliseconds that pass for seconds, and readings of no vehicle.
#[test]
fn a_pulse_beyond_any_impact_is_told() {
    let texts = |header: &str, height: f64, step: f64| {
        let rows: String = (-20..=120).map(|i| format!("{},{}\n", f64::from(i) * step, height * pulse(i.into()))).collect();
        record_of(&format!("{header}\n{rows}"), None).1.out
    };
    let told = texts("time,normal_force [kN]", 100.0, 1.0);
    assert!(told.contains("normal force is integrated over 120.000 s, which no impact lasts: check the unit of the times"), "{told}");
    let told = texts("time [ms],normal_force [kN]", 100.0, 1e-3);
    assert!(told.contains("which no impact lasts"), "{told}");
    let told = texts("time [ms],acceleration.a [g]", -22.0, 1.0);
    assert!(told.contains("toward the barrier, which pushes the vehicle away from it"), "{told}");
    assert!(!texts("time [ms],acceleration.a [g]", 22.0, 1.0).contains("toward the barrier"));
    let told = texts("time [ms],acceleration.a [g]", 11_000.0, 1.0);
    assert!(told.contains("acceleration.a reaches 10787") && told.contains("which no impact does"), "{told}");
    assert!(texts("time [ms],normal_force [kN]", 1.1e6, 1.0).contains("which no impact does"));
    for (header, height, step) in
        [("time,normal_force [kN]", 100.0, 0.04), ("time [ms],acceleration.a [g]", 1000.0, 1.0), ("time [ms],normal_force [kN]", 9e5, 1.0)]
    {
        let told = texts(header, height, step);
        assert!(told.contains("records") && !told.contains("which no impact does"), "{told}");
    }
}

/// A speed that nothing uses is noted, and a gap is a warning where the channel is integrated.
#[test]
fn a_speed_without_a_mass_and_a_gap_outside_of_the_window_are_told_as_that() {
    let texts = |samples: &str, settings: &str| {
        let run = record_of(samples, Some(settings)).1;
        assert!(run.status <= 1, "{}", run.err);
        run.out
    };
    let force = csv("normal_force [kN]", &[&|ms| 100.0 * pulse(ms)]);
    let speed = "speed = \"10 m/s\"\n";
    assert!(texts(&force, speed).contains("with a mass, load cells give the velocity change"));
    assert!(!texts(&force, &format!("{speed}mass = \"1500 kg\"\n")).contains("it is not used here"));
    let with_gap: String = force
        .lines()
        .filter(|line| !["111", "112", "113", "114"].iter().any(|ms| line.starts_with(ms)))
        .fold(String::new(), |text, line| text + line + "\n");
    assert!(texts(&with_gap, "").contains("has no samples from 0.111 s to 0.115 s"));
    assert!(!texts(&with_gap, "window = [\"0 ms\", \"105 ms\"]\n").contains("has no samples"));
    assert!(texts(&with_gap, "window = [\"0 ms\", \"112 ms\"]\n").contains("has no samples from 0.111 s to 0.115 s"));
}

#[test]
fn samples_that_stand_out_are_told() {
    let at =
        |times: &'static [f64], height: f64| move |ms: f64| if times.iter().any(|time| (ms - time).abs() < 0.01) { height } else { 0.0 };
    let told = warned("spike", "", &at(&[40.0], -50.0));
    assert_eq!(told.len(), 1);
    assert!(
        told[0].contains("normal_force has a sample that stands out at 0.040 s: 45106 N, where its neighbors give 95105 N"),
        "{told:?}"
    );
    let told = warned("spike", "", &at(&[70.0, 20.0, -10.0], 60.0));
    assert!(told[0].contains("3 samples that stand out, the first at -0.010 s: 60000 N, where its neighbors give 0 N"), "{told:?}");
    // The kinks of the pulse itself, noise, a step and a short pulse of three samples are none.
    assert!(warned("spike", "", &|_| 0.0).is_empty());
    assert!(warned("spike", "", &|ms| (ms * 1e4).sin()).is_empty());
    assert!(warned("spike", "", &|ms| if ms > 30.0 { 20.0 } else { 0.0 }).is_empty());
    assert!(warned("spike", "", &|ms| 50.0 * (1.0 - (ms - 110.0).abs() / 0.2).max(0.0)).is_empty());
}

#[test]
fn an_offset_that_drifts_is_told() {
    let window = "baseline = [\"-20 ms\", \"-1 ms\"]\nwindow = [\"0 s\", \"100 ms\"]\n";
    let noise = |ms: f64| 0.2 * ((ms * 12_345.6).sin() + (ms * 7_654.3).sin());
    // From 0 at the contact to 1.1 kN in the middle of the samples after the window, of which evenly 55 N s.
    let told = warned("drift", window, &|ms| noise(ms) + 0.01 * ms.max(0.0));
    assert_eq!(told.len(), 1);
    assert!(
        told[0].contains("after the window normal force is 1099 N from its baseline") && told[0].contains("has some 55 N s of it"),
        "{told:?}"
    );
    assert!(warned("drift", window, &noise).is_empty());
    // Without a window the last tenth should be unloaded: after a drift and a shift it is not; a load that falls there is that of a record that ends early.
    for disturbance in
        [&|ms: f64| noise(ms) + 0.01 * ms.max(0.0), &|ms: f64| noise(ms) + if ms > 50.0 { 3.0 } else { 0.0 }] as [&dyn Fn(f64) -> f64; 2]
    {
        let told = warned("drift", "", disturbance);
        assert!(told.len() == 1 && told[0].contains("at its end normal force is"), "{told:?}");
    }
    assert!(warned("drift", "", &noise).is_empty());
    assert!(warned("drift", "", &|ms| noise(ms) + 20.0 * pulse((ms - 20.0).max(0.0))).is_empty());
}

/// A force that is limited before its noise is added, and pulses that are round, triangular or short of samples at the top.
#[test]
fn a_flat_top_with_noise_is_told() {
    let noise = |ms: f64| 0.15 * ((ms * 12_345.6).sin() + (ms * 7_654.3).sin());
    let told = |shape: &dyn Fn(f64) -> f64| warned("flat-top", "", &|ms| shape(ms) - 100.0 * pulse(ms) + noise(ms));
    for limit in [50.0, 70.0, 90.0] {
        let told = told(&|ms| (100.0 * pulse(ms)).min(limit));
        assert!(told.len() == 1 && told[0].contains("normal force stays near"), "{limit}: {told:?}");
    }
    assert!(told(&|ms| 100.0 * pulse(ms)).is_empty());
    assert!(told(&|ms| 100.0 * pulse(ms) * pulse(ms)).is_empty());
    assert!(told(&|ms| (100.0 - 2.0 * (ms - 50.0).abs()).max(0.0)).is_empty());
    // A load that rises slowly and stops at once, and the other way round.
    assert!(told(&|ms| if (0.0..80.0).contains(&ms) { 50.0 + 0.5 * ms } else { 0.0 }).is_empty());
    assert!(told(&|ms| if (0.0..80.0).contains(&ms) { 90.0 - 0.5 * ms } else { 0.0 }).is_empty());
    // A load that is held, and is rough.
    assert!(told(&|ms| (100.0 * pulse(ms)).min(70.0) + 4.0 * (ms * 0.8).sin() * pulse(ms)).is_empty());
}

/// What is left of a pulse counts from the unloaded reading, as its height does, and beside three standard deviations of the noise.
#[test]
fn the_end_of_a_pulse_counts_from_its_offset_and_beside_the_noise() {
    let tail = |height: f64| move |ms: f64| if ms > 100.0 { height } else { 0.0 };
    assert_eq!(warned("truncated", "", &|ms| 50.0 + tail(15.0)(ms)).len(), 1);
    assert!(warned("truncated", "", &|ms| 50.0 + tail(8.0)(ms)).is_empty());
    let noise = |ms: f64| if (ms * 10.0).round() as i64 % 2 == 0 { 6.0 } else { -6.0 };
    let last = |height: f64| move |ms: f64| if ms > 119.95 { height } else { noise(ms) };
    assert!(warned("truncated", "", &last(14.0)).is_empty());
    assert_eq!(warned("truncated", "", &last(20.0)).len(), 1);
}

#[test]
fn noise_does_not_cut_a_pulse() {
    // ±12 % of the peak from sample to sample: the last one is no part of a pulse, nor is that at the end of a window.
    let noise = |ms: f64| if (ms * 10.0).round() as i64 % 2 == 0 { 12.0 } else { -12.0 };
    assert!(warned("truncated", "", &noise).is_empty());
    assert!(warned("cut-by-window", "window = [\"0 ms\", \"100.1 ms\"]\n", &noise).is_empty());
    // Without noise it is.
    assert_eq!(warned("truncated", "", &|ms| if ms > 100.0 { 12.0 } else { 0.0 }).len(), 1);
    assert_eq!(warned("cut-by-window", "window = [\"0 ms\", \"96 ms\"]\n", &|_| 0.0).len(), 1);
}

#[test]
fn a_pulse_of_few_samples_is_noted() {
    let of = |step: f64| {
        let rows = (-20..=(120.0 / step) as i32).map(|i| (f64::from(i) * step, 100.0 * pulse(f64::from(i) * step)));
        let samples: String = rows.map(|(ms, force)| format!("{ms},{force}\n")).collect();
        record_of(&format!("time [ms],normal_force [kN]\n{samples}"), None).1.out
    };
    assert!(of(10.0).contains("normal force has 9 samples above a tenth of its peak"), "{}", of(10.0));
    assert!(!of(1.0).contains("coarse-sampling"), "{}", of(1.0));
    // A quiet channel has no pulse.
    let quiet = record_of(&csv("normal_force [kN],tangential_force [kN]", &[&|ms| 100.0 * pulse(ms), &|_| 0.0]), None).1.out;
    assert!(!quiet.contains("coarse-sampling"), "{quiet}");
}

/// An accelerometer that says that the vehicle goes into the barrier, whose load cells push it away, has the other polarity.
#[test]
fn a_reversed_accelerometer_is_told() {
    let samples = "time [ms],F [kN],a [g]\n-20,0,0\n-10,0,0\n0,0,0\n10,100,-6.8\n20,250,-17\n30,300,-20.4\n40,250,-17\n50,150,-10.2\n60,80,-5.4\n70,30,-2\n80,0,0\n90,0,0\n100,0,0\n";
    let settings = |polarity: &str| {
        format!(
            "speed = \"11 m/s\"\nmass = \"1500 kg\"\n[[channel]]\ncolumn = \"F\"\nquantity = \"normal_force\"\n\
             [[channel]]\ncolumn = \"a\"\nquantity = \"acceleration\"\n{polarity}"
        )
    };
    let told = |polarity: &str| record_of(samples, Some(&settings(polarity))).1.out.contains("reversed-polarity");
    assert_eq!(["", "polarity = -1\n"].map(told), [true, false]);
}
