//! Event data recorders: by hand, incomplete, in steps, and as evidence.

use super::*;

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
    // Of two readings nothing tells that the change is over, unless there is none.
    for (end, is_truncated) in [("-30", true), ("0", false)] {
        let (record, _) = record_of(&format!("time [s],delta_v_forward [km/h]\n0,0\n0.1,{end}\n"), None);
        assert_eq!(record["channels"][0]["is_truncated"], is_truncated, "{end}");
    }
}

/// A car that brakes after the impact goes on losing speed: 3 km/h from 0.1 s to 0.23 s, which is no more than full braking takes.
#[test]
fn a_change_that_braking_goes_on_with_is_uncertain_by_it() {
    let pulse = [0, 1, 4, 8, 14, 20, 26, 32, 36, 39, 40, 40, 40];
    let braking = [41, 41, 41, 41, 41, 42, 42, 42, 42, 42, 43, 43, 43];
    let of = |values: &[i32], left: &str| {
        let comma = if left.is_empty() { "" } else { "," };
        let mut text = format!("time [ms],delta_v_forward [km/h]{comma}{}\n", if left.is_empty() { "" } else { "delta_v_left [km/h]" });
        for (i, value) in values.iter().enumerate() {
            writeln!(text, "{},-{value}{comma}{left}", 10 * i).expect("a string takes everything");
        }
        record_of(&text, None)
    };
    let all = [&pulse[..], &braking].concat();
    for left in ["", "0"] {
        let (record, run) = of(&all, left);
        let found = &record["recorder"]["delta_v_forward"];
        close(&found["value"], -43.0 / 3.6, 1e-12);
        let half = 1.96 * 3.6 * found["sd"].as_f64().expect("a number");
        // From −39 km/h on, as readings are rounded; half a step more, and the scatter of the readings.
        assert!(half > 4.5 && half < 5.0, "{half} km/h: {}", run.out);
        assert!(run.out.contains("\"change-goes-on\"") && run.out.contains("from 0.090 s to 0.230 s"), "{}", run.out);
        let maximum = &record["recorder"]["maximum"];
        assert_eq!(maximum.is_null(), left.is_empty());
        if !left.is_empty() {
            close(&maximum["magnitude"]["sd"], half / 3.6 / 1.96, 1e-9);
            close(&maximum["forward"]["sd"], half / 3.6 / 1.96, 1e-9);
        }
    }
    // Without what is later than the impact, and of one that goes on faster than by braking.
    let (record, run) = of(&pulse, "");
    close(&record["recorder"]["delta_v_forward"]["sd"], 1.0 / 3.6 / 12_f64.sqrt(), 1e-9);
    assert!(!run.out.contains("\"change-goes-on\""), "{}", run.out);
    let faster: Vec<i32> = pulse.into_iter().chain((0..6).map(|i| 43 + 3 * i)).collect();
    assert!(!of(&faster, "").1.out.contains("\"change-goes-on\""));
}

/// No vehicle loses or gains 20 m/s in half a second before the impact: 255 marks a reading that is missing, and −41 has lost its sign.
#[test]
fn speeds_before_the_impact_that_jump_are_told() {
    let told = |last: &str, before: &str| {
        let text = format!(
            "time [s],speed [km/h],delta_v_forward [km/h]\n-1,50,\n-0.5,{before},\n0,{last},0\n0.05,,-10\n0.1,,-20\n0.15,,-20\n0.2,,-20\n"
        );
        let (_, run) = record_of(&text, None);
        assert!(run.status <= 1, "{}", run.err);
        run.out.contains("\"speed-jumps\"")
    };
    // 0.8 g takes 14 km/h in half a second; twice as much, and two steps of 7 km/h beyond it, is none.
    assert_eq!(
        ["43", "20", "70", "2", "86", "255", "-41", "0"].map(|last| told(last, "43")),
        [false, false, false, false, true, true, true, true]
    );
    assert!(told("43", "255"));
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
    // The last speed is half a second old, and fell by 6 km/h in the half second before: by less than 0.8 g takes.
    let at_impact = &found["speed_at_impact"];
    close(&at_impact["value"], 54.0 * kmh, 1e-12);
    close(&at_impact["time"], -0.5, 1e-12);
    let step = 6.0 * kmh; // the least step of its speeds
    let braking = 0.8 * 9.80665 / 1.959_963_984_540_054;
    let sd = |change: f64| change.hypot(step / 12_f64.sqrt());
    close(&at_impact["sd"], sd(0.5 * braking), 1e-9);
    assert!(run.out.contains("speed-before-impact"));
    // Nor does braking take more than the speed, and what it fell by at last counts if it is more.
    let at =
        |speeds: &str| record_of(&recorder("").replace("\n-1,60,,\n-0.5,54", speeds), None).0["recorder"]["speed_at_impact"]["sd"].clone();
    close(&at("\n-1.5,12,,\n-0.5,6"), sd(6.0 * kmh / 1.959_963_984_540_054), 1e-9);
    close(&at("\n-1.0,66,,\n-0.5,54"), (12.0 * kmh).hypot(12.0 * kmh / 12_f64.sqrt()), 1e-9);
    // It stands still, and 0 has no sign.
    let (still, _) = record_of(&recorder("0,-0,,\n").replace("\n0,,0,0", ""), None);
    assert_eq!(still["recorder"]["speed_at_impact"]["value"].to_string(), "0.0");
    // What it fell by earlier does not matter.
    let (earlier, _) = record_of(&recorder("").replace("\n-1,60", "\n-2,80,,\n-1,60"), None);
    close(&earlier["recorder"]["speed_at_impact"]["sd"], sd(0.5 * braking), 1e-9);
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
/// A driver who holds the speed makes it flat at its least.
#[test]
fn a_speed_that_is_held_is_not_clipped() {
    let speeds = [62, 62, 62, 60, 58, 56, 54, 54, 54, 54];
    let rows: String = speeds.iter().enumerate().map(|(i, speed)| format!("{},{speed}\n", -5.0 + 0.5 * i as f64)).collect();
    let (record, run) = record_of(&format!("time [s],speed [km/h]\n{rows}"), None);
    assert_eq!((run.status, &record["channels"][0]["clipped"]), (0, &Value::Null), "{}", run.out);
}

/// Readings that are all multiples of 5 km/h are no finer than that, whatever the file says; and a velocity change that is constant is none.
#[test]
fn readings_tell_more_of_a_recorder_than_its_settings() {
    let of = |changes: &[i32], resolution: &str| {
        let rows: String = changes.iter().enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
        record_of(&format!("time [ms],delta_v_forward [km/h]\n{rows}"), Some(&format!("resolution = \"{resolution}\"\n")))
    };
    let coarse = [0, 0, -5, -5, -10, -15, -20, -25, -25, -30, -30, -35, -35, -35, -35, -35, -35, -35];
    let (found, run) = of(&coarse, "1 km/h");
    assert!(
        run.out.contains(
            "delta_v_forward lie whole steps of 1.39 m/s apart: that is taken as its resolution, and not the 0.28 m/s of `resolution`"
        ),
        "{}",
        run.out
    );
    close(&found["recorder"]["delta_v_forward"]["sd"], 5.0 / 3.6 / 12_f64.sqrt(), 1e-9);
    // One reading between them, and a resolution that is no finer.
    let mut fine = coarse;
    fine[5] = -14;
    for (changes, resolution) in [(fine, "1 km/h"), (coarse, "5 km/h"), (coarse, "4 km/h")] {
        let (found, run) = of(&changes, resolution);
        assert!(!run.out.contains("lie whole steps"), "{}", run.out);
        let given: f64 = resolution.trim_end_matches(" km/h").parse().expect("a number");
        close(&found["recorder"]["delta_v_forward"]["sd"], given / 3.6 / 12_f64.sqrt(), 1e-9);
    }
    let (_, dead) = of(&[0; 18], "1 km/h");
    assert_eq!(dead.status, 0, "{}", dead.err);
    assert!(dead.out.contains("is constant: it has no velocity change of an impact in it"), "{}", dead.out);
    assert!(!of(&coarse, "5 km/h").1.out.contains("is constant"));
    // At the time zero an impact has changed nothing yet.
    let (_, late) = of(&[-12, -12, -15, -20, -25, -30, -31, -31, -31, -31, -31, -31, -31, -31, -31, -31, -31, -31], "1 km/h");
    assert!(late.out.contains("begins at 0 s with -3.33 m/s: the impact had begun before it"), "{}", late.out);
}

/// The velocity change begins at 0.03 s of its own times, by 0.3 of the greatest.
#[test]
fn a_pulse_far_from_time_zero_is_told() {
    let shifted = |by: f64| {
        let of_pulse = |line: &str| -> Option<String> {
            let (time, rest) = line.split_once(",,")?;
            Some(format!("{},,{rest}", time.parse::<f64>().ok()? + by))
        };
        let lines: Vec<String> = recorder("").lines().map(|line| of_pulse(line).unwrap_or_else(|| line.to_owned())).collect();
        record_of(&lines.join("\n"), None).1.out
    };
    let is_told = |by: f64| shifted(by).contains("impact-not-at-zero");
    assert_eq!([0.0, 0.46, 0.48, 2.0].map(is_told), [false, false, true, true]);
    assert!(shifted(2.0).contains("delta_v_forward begins to change at 2.030 s: times must count from the impact"), "{}", shifted(2.0));
}

/// Times count from the impact: what was stored later is no speed before it.
#[test]
fn speeds_after_the_impact_are_not_used() {
    let (found, run) = record_of("time [s],speed [mph]\n-1,60\n0,50\n1,40\n2,30\n3,20\n", None);
    assert!(run.out.contains("3 of 5 speeds are later than the impact, and not used"), "{}", run.out);
    assert_eq!(found["recorder"]["pre_crash"].as_array().map(Vec::len), Some(2));
    close(&found["recorder"]["speed_at_impact"]["value"], 50.0 * 0.44704, 1e-12);
    assert!(!record_of("time [s],speed [mph]\n-1,60\n0,50\n", None).1.out.contains("not used"));
}

/// A velocity change that ends as fast as it began looks like one at its range, in coarse steps; where the range is given, that decides.
#[test]
fn a_given_range_decides_what_is_clipped() {
    let changes = [0, -2, -5, -9, -14, -18, -18, -18, -18, -18];
    let rows: String = changes.iter().enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
    let samples = format!("time [ms],delta_v_forward [km/h]\n{rows}");
    let (record, run) = record_of(&samples, None);
    assert_eq!((run.status, &record["channels"][0]["clipped"]["samples"]), (1, &json!(5)), "{}", run.out);
    assert!(run.out.contains("give its `range` if it is whole"), "{}", run.out);
    let of_range = |range: &str| record_of(&samples, Some(&format!("[[channel]]\ncolumn = \"delta_v_forward\"\nrange = \"{range}\"\n"))).0;
    assert_eq!(of_range("100 km/h")["channels"][0]["clipped"], Value::Null);
    assert_eq!(of_range("18 km/h")["channels"][0]["clipped"]["samples"], 5);
}

/// Readings that scatter by a step differ by more than a tenth of a small change from one to the next, long after it is over. One that still changes is truncated.
#[test]
fn readings_that_scatter_do_not_seem_truncated() {
    let mut random = Random(20);
    let folder = Folder::new();
    let mut write = |name: &str, change: &dyn Fn(f64) -> f64| {
        let mut text = "time [ms],delta_v_forward [km/h]\n".to_owned();
        for i in 0..=30 {
            writeln!(text, "{},{}", 10 * i, (change(f64::from(i)) + random.normal()).round()).expect("a string takes everything");
        }
        folder.write(name, text.as_bytes());
    };
    let names: [Vec<String>; 2] = ["whole", "cut"].map(|kind| (0..40).map(|i| format!("{kind}{i}.csv")).collect());
    names[0].iter().for_each(|name| write(name, &|i| -15.0 * (i / 8.0).min(1.0)));
    names[1].iter().for_each(|name| write(name, &|i| -40.0 * (i / 30.0).powi(2)));
    let truncated = |names: &[String]| {
        let json = records_of(&folder, names);
        let records = json["records"].as_array().expect("records").iter();
        records.filter(|record| record["channels"][0]["is_truncated"] == true).count()
    };
    let [of_whole, of_cut] = [truncated(&names[0]), truncated(&names[1])];
    assert!(of_whole <= 2 && of_cut >= 36, "{of_whole} of 40 whole ones, {of_cut} of 40 that end early");
}

/// Records that end while the velocity still changes, in whole km/h: each reading but the first is another.
#[test]
fn a_record_that_ends_in_the_pulse_is_truncated_whatever_its_steps() {
    let is_truncated = |changes: &[f64]| {
        let rows: String = changes.iter().enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
        let (record, run) = record_of(&format!("time [ms],delta_v_forward [km/h]\n{rows}"), None);
        let (is_truncated, is_lower) = (&record["channels"][0]["is_truncated"], &record["recorder"]["is_lower_bound"]);
        assert_eq!((is_truncated, run.status), (is_lower, i32::from(is_truncated == true)), "{changes:?}: {}", run.out);
        is_truncated == true
    };
    for each in [1.0, 2.0, 3.0, 4.0, 5.0, 8.0] {
        for readings in if each == 1.0 { 9 } else { 4 }..=21 {
            let ramp: Vec<f64> = (0..readings).map(|i| each * f64::from(i)).collect();
            assert!(is_truncated(&ramp), "{each} km/h in each of {readings} readings");
        }
    }
    // A half-sine of 150 ms and 40 km/h, from 40 to 80 % of it; from its end on it is whole, and so is one that is still for a tenth of a second.
    let pulse = |duration: f64, readings: i32| -> Vec<f64> {
        (0..readings).map(|i| (-20.0 * (1.0 - (PI * (f64::from(i) * 10.0 / duration).min(1.0)).cos())).round()).collect()
    };
    (7..=13).for_each(|readings| assert!(is_truncated(&pulse(150.0, readings)), "{readings} readings of 150 ms"));
    for (duration, readings) in [(150.0, 16), (150.0, 17), (150.0, 26), (80.0, 9), (80.0, 10), (80.0, 19), (100.0, 11)] {
        assert!(!is_truncated(&pulse(duration, readings)), "{readings} readings of {duration} ms");
    }
}

/// A smooth velocity change that ends in whole km/h is over, and not clipped, however its last reading is rounded.
#[test]
fn a_last_reading_that_is_rounded_up_is_no_clipped_one() {
    let left = [0, 0, 1, 2, 3, 5, 6, 7, 9];
    let of = |last: &[i32]| {
        let changes = left.iter().chain(last).chain(std::iter::repeat_n(last.last().unwrap_or(&9), 10));
        let rows: String = changes.enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
        record_of(&format!("time [ms],delta_v_left [km/h]\n{rows}"), None)
    };
    let (whole, run) = of(&[]);
    assert!(run.status == 0 && whole["channels"][0]["clipped"].is_null() && whole["recorder"]["is_lower_bound"] == false, "{}", run.out);
    // One that goes on as fast and stops at once is.
    let (clipped, run) = of(&[12, 15]);
    assert!(run.status == 1 && clipped["recorder"]["is_lower_bound"] == true, "{}", run.out);
}

/// Evidence are the components at the instant of the greatest magnitude: the text has them where a component is greater at another time.
#[test]
fn the_components_of_the_greatest_change_are_shown() {
    let part = |ms: f64, duration: f64, change: f64| 0.5 * change * (1.0 - (PI * (ms / duration).clamp(0.0, 1.0)).cos());
    let rows: String = (0..=30)
        .map(|i| 10.0 * f64::from(i))
        .map(|ms| format!("{ms},{:.1},{:.1}\n", part(ms, 60.0, -25.0) + part(ms - 55.0, 100.0, 6.0), part(ms, 160.0, 30.0)))
        .collect();
    let folder = Folder::new();
    folder.write("test.csv", format!("time [ms],delta_v_forward [km/h],delta_v_left [km/h]\n{rows}").as_bytes());
    let page = run(folder.path(), &["record", "test.csv", "--units", "si"]).out;
    let row = |what: &str| {
        page.lines().find(|line| line.trim_start().starts_with(what)).map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    assert!(row("delta-V forward").is_some_and(|row| row.contains("-6.9") || row.contains("-25.0")), "{page}");
    assert!(row("at that time forward").is_some_and(|row| row.contains("-5.28") || row.contains("-19.0")), "{page}");
    assert_eq!(row("at that time left"), None, "the left one is greatest then: {page}");
}

/// However few readings follow the pulse, two standard deviations about the greatest of them hold the velocity change in nine of ten records, or a warning says that they
/// are too few.
#[test]
fn the_greatest_of_few_readings_that_scatter_is_less_certain() {
    let mut random = Random(21);
    for (scatter, step, duration, end) in [
        (0.5, 0.1, 100.0, 150),
        (0.5, 0.1, 100.0, 160),
        (0.5, 0.1, 100.0, 180),
        (0.5, 0.1, 80.0, 150),
        (1.0, 1.0, 100.0, 150),
        (0.5, 1.0, 100.0, 250),
        (2.0, 1.0, 100.0, 150),
        (0.3, 1.0, 100.0, 250),
        (0.0, 1.0, 100.0, 150),
        (0.0, 0.1, 100.0, 300),
    ] {
        const RECORDS: usize = 120;
        let folder = Folder::new();
        let truths: Vec<f64> = (0..RECORDS).map(|i| -(if i % 2 == 0 { 35.0 } else { 20.0 }) - 10.0 * random.uniform()).collect();
        let names: Vec<String> = (0..RECORDS).map(|i| format!("{i}.csv")).collect();
        for (name, truth) in names.iter().zip(&truths) {
            let mut text = "time [ms],delta_v_forward [km/h]\n0,0\n".to_owned();
            for time in (10..=end).step_by(10) {
                let noise = random.normal();
                let change = 0.5 * truth * (1.0 - (PI * (f64::from(time) / duration).min(1.0)).cos());
                writeln!(text, "{time},{:.1}", ((change + scatter * noise) / step).round() * step).expect("a string takes everything");
            }
            folder.write(name, text.as_bytes());
        }
        let json = records_of(&folder, &names);
        let records = json["records"].as_array().expect("records");
        let messages =
            json["messages"].as_array().map_or_else(String::new, |all| all.iter().map(|message| format!("{message}\n")).collect());
        let holds = |(i, record): (usize, &Value)| {
            let found = &record["recorder"]["delta_v_forward"];
            let (value, sd) = (found["value"].as_f64().expect("a value"), found["sd"].as_f64().expect("a standard deviation"));
            (3.6 * value - truths[i]).abs() <= 1.96 * 3.6 * sd
                || messages.lines().any(|line| line.contains(&format!("\"{i}.csv")) && line.contains("plateau-short"))
        };
        let held = records.iter().enumerate().filter(|record| holds(*record)).count();
        let whole = records.iter().filter(|record| record["recorder"]["is_lower_bound"] == false).count();
        assert!(10 * held >= 9 * RECORDS, "scatter {scatter}, step {step}, {duration} of {end} ms: {held} of {RECORDS}");
        assert!(10 * whole >= 9 * RECORDS, "scatter {scatter}, step {step}, {duration} of {end} ms: {whole} of {RECORDS} seem whole");
    }
}

/// The greatest of readings that scatter may be one of the last: they scatter as much before it. A velocity change that falls again is no scatter.
#[test]
fn readings_before_the_greatest_tell_the_scatter() {
    let of = |changes: &[f64]| {
        let rows: String = changes.iter().enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
        record_of(&format!("time [ms],delta_v_forward [km/h]\n{rows}"), None)
    };
    let late = [
        -0.0, -0.7, -3.8, -8.4, -13.9, -20.3, -26.4, -32.8, -36.8, -40.5, -40.8, -41.1, -41.2, -41.0, -40.8, -40.7, -42.2, -41.3, -41.2,
        -41.6, -41.2,
    ];
    let (found, run) = of(&late);
    assert!(run.out.contains("\"readings-scatter\""), "{}", run.out);
    let sd = |after: &[f64]| {
        let squares: f64 = after.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).powi(2)).sum();
        let (scatter, step) = (squares / (6.0 * (after.len() - 2) as f64), 0.1_f64.powi(2) / 12.0);
        // Half of seven or eight bends: 2.7764 of Student's t with four degrees of freedom is 1.96 of a normal distribution.
        (step + 4.0 * scatter * (2.776_445_105_2_f64 / 1.959_963_984_5).powi(2)).sqrt() / 3.6
    };
    // Full braking takes 0.28 km/h in 10 ms: 1.7 km/h from −40.5 to −42.2 in 70 ms may be that, and half a step.
    let with_braking = |sd: f64, change: f64| sd.hypot((change + 0.05) / 3.6 / 1.959_963_984_5);
    // From the first reading that reaches 41.2 on, which all but one of the last five do.
    close(&found["recorder"]["delta_v_forward"]["sd"], with_braking(sd(&late[12..]), 1.7), 1e-6);
    // From the top on, as the late readings are much less.
    let falls: Vec<f64> = (0..30).map(|i| (f64::from(i) * PI / 40.0).sin()).map(|x| (400.0 * x).round() / 10.0).collect();
    close(&of(&falls).0["recorder"]["delta_v_forward"]["sd"], with_braking(sd(&falls[20..]), 0.5), 1e-6);
}

#[test]
fn readings_that_scatter_are_less_certain() {
    let of = |scatter: f64| {
        let mut text = "time [ms],delta_v_forward [km/h]\n".to_owned();
        for i in 0..40 {
            let zigzag = if i % 2 == 0 { scatter } else { -scatter };
            let value = if i < 10 { -3.1 * f64::from(i) } else { -30.0 + zigzag };
            writeln!(text, "{},{value}", 10 * i).expect("a string takes everything");
        }
        record_of(&text, Some("resolution = \"1 km/h\"\n"))
    };
    let (still, run) = of(0.0);
    let step = 1.0 / 3.6 / 12_f64.sqrt();
    close(&still["recorder"]["delta_v_forward"]["sd"], step, 1e-9);
    assert!(!run.out.contains("readings-scatter"), "{}", run.out);
    // In turn ± 2 km/h: second differences of 8 km/h, of which the variance of a reading is 64/6; 28 of them have 14 degrees of freedom.
    let (noisy, run) = of(2.0);
    let scatter = (64.0_f64 / 6.0).sqrt() / 3.6 * 2.144_786_687_9 / 1.959_963_984_5;
    close(&noisy["recorder"]["delta_v_forward"]["value"], -32.0 / 3.6, 1e-9);
    close(&noisy["recorder"]["delta_v_forward"]["sd"], step.hypot(2.0 * scatter), 1e-9);
    assert!(run.out.contains("readings-scatter"), "{}", run.out);
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
    let sensors = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\", accelerometer_range = \"7 g\" }");
    assert!(sensors.err.contains("delta_v_forward, delta_v_right of edr.csv is clipped or truncated"), "{}", sensors.err);
    let alone =
        two_cars("time [s],delta_v_forward [km/h]\n0,0\n0.02,-5\n0.04,-15\n0.06,-30\n", "vehicle.2.recorder = { file = \"edr.csv\" }");
    assert!(
        alone.err.contains("is a lower bound") && alone.err.contains("leave the recorder out, whose velocity change is all"),
        "{}",
        alone.err
    );
    let twice = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\", use = [\"pdof\", \"delta_v_left\"] }");
    assert!(twice.err.contains("the record would count twice"), "{}", twice.err);
    // One recorder of two vehicles, by the name of its file in two ways, or in the case itself.
    for (one, other) in [
        ("file = \"edr.csv\"", "file = \"./edr.csv\""),
        ("samples = \"time [s],speed\\n-2,9\\n-1,8\\n\"", "samples = \"time [s],speed\\n-2,9\\n-1,8\\n\""),
    ] {
        let of_both = two_cars(&samples, &format!("vehicle.2.recorder = {{ {one} }}\nvehicle.1.recorder = {{ {other} }}"));
        assert!(of_both.status == 2 && of_both.err.contains("has the same recording, which would count twice"), "{}", of_both.err);
    }
    let no_name = two_cars(&samples, "vehicle.2.recorder = { file = 5 }").err;
    assert_eq!(no_name.matches("recorder.file: expected a string; found a number").count(), 1, "{no_name}");
    let both = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\" }\nvehicle.2.speed = \"40 km/h ± 1 km/h\"");
    assert!(both.status == 2 && both.err.contains("vehicle.2.speed twice"), "{}", both.err);
    let ranged = two_cars(&samples, "vehicle.2.recorder = { file = \"edr.csv\", range = \"20 km/h\" }");
    assert!(ranged.status == 2 && ranged.err.contains("clipped"), "{}", ranged.err);
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
    // By the steps as they are: 7.35 m/s in 15 ms are 490 m/s², and 9.8 m/s in 20 ms the first change of all.
    for (uneven, [from, to]) in
        [("0,0\n5,-1\n20,-8.35\n30,-10\n40,-10.5\n", [0.005, 0.02]), ("0,0\n20,-9.8\n30,-12\n40,-13\n", [0.0, 0.02])]
    {
        let (record, _) = record_of(
            &format!("time [ms],delta_v_forward [m/s]\n{uneven}"),
            Some("accelerometer_range = \"50 g\"\nresolution = \"0.1 m/s\""),
        );
        let sensor = &record["recorder"]["clipped_sensors"][0];
        assert_eq!((&sensor["from"], &sensor["to"]), (&json!(from), &json!(to)), "{sensor}");
        close(&sensor["acceleration"], 490.0, 1e-9);
    }
    // In steps of 3 m/s no change tells 4.9 m/s from less.
    let (record, run) = record_of(samples, Some("accelerometer_range = \"50 g\"\nresolution = \"3 m/s\""));
    assert_eq!((run.status, &record["recorder"]["is_lower_bound"]), (0, &json!(false)), "{}", run.out);
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
    // And 80 steps within a tenth of a millisecond, with a bend before and after each, to and fro.
    close(&impulse["sd"], 5e3 * (0.11_f64.powi(2) / 12.0 + 160.0 * 1e-8 / 144.0 + 80.0 * 1e-8 / 4.0).sqrt(), 1e-9);
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
            let sd = found["barrier"][impulse]["sd"].as_f64().unwrap_or(f64::NAN);
            let height = if impulse == "normal_impulse" { 300.0 } else { 90.0 } * if unit == "kN" { 1e3 } else { 1.0 };
            // Rounding bends the samples to and fro where the pulse does not, as noise of a digit does: some √100 of its deviation.
            let least = (digit / 12_f64.sqrt() * 0.11).hypot(of_sampling(height, 0.1, 100.0));
            let most = least.hypot(digit / 12_f64.sqrt() * 1e-3 * 15.0);
            assert!((0.999 * least..most).contains(&sd), "{impulse}: {sd} {least}, {decimals} {}", run.err);
        }
    }
    // Steps of whole digits, of which no two samples are one step apart.
    let counts = [0.0, 0.0, 0.0, 0.0, 6.0, 16.0, 30.0, 40.0, 46.0, 50.0, 46.0, 36.0, 30.0, 16.0, 6.0, 0.0, 0.0];
    let rows: String = counts.iter().enumerate().map(|(i, count)| format!("{},{count}\n", i as f64 - 3.0)).collect();
    let (found, _) = record_of(&format!("time [ms],normal_force [kN]\n{rows}"), None);
    let bends: f64 = counts.windows(3).map(|three: &[f64]| (three[0] - 2.0 * three[1] + three[2]).powi(2)).sum();
    close(&found["barrier"]["normal_impulse"]["sd"], (2e3 / 12_f64.sqrt() * 0.013).hypot(bends.sqrt() / 12.0), 1e-6);
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

/// Of two channels that are stored in unequal steps each has its own; one that is constant has those of the other.
#[test]
fn a_finer_channel_does_not_refine_the_other() {
    let of = |right: &dyn Fn(i32) -> f64, settings: &str| {
        let forward = |i: i32| (-30.0 * (0.5 - 0.5 * (PI * f64::from(i.min(10)) / 10.0).cos())).round();
        let rows: String = (0..20).map(|i| format!("{},{},{}\n", 10 * i, forward(i), right(i))).collect();
        let (found, run) = record_of(&format!("time [ms],delta_v_forward [mph],delta_v_right [mph]\n{rows}"), Some(settings));
        let sd = |key: &str| found["recorder"][key]["sd"].as_f64().expect("a number") * 12_f64.sqrt() / 0.44704;
        ([sd("delta_v_forward"), sd("delta_v_left")], run.out.matches("\"resolution-coarser\"").count())
    };
    let fine = |i: i32| (30.0 * (PI * f64::from(i.min(10)) / 20.0).sin()).round() / 10.0;
    for (right, settings, steps, warnings) in [
        (&fine as &dyn Fn(i32) -> f64, "", [1.0, 0.1], 1),
        (&fine, "resolution = \"0.1 mph\"\n", [1.0, 0.1], 1),
        (&fine, "resolution = \"0.8 mph\"\n", [0.8, 0.8], 0),
        (&|_| 0.0, "", [1.0, 1.0], 0),
        (&|i| f64::from(i.min(5)), "", [1.0, 1.0], 0),
    ] {
        let (found, told) = of(right, settings);
        assert!(found.iter().zip(steps).all(|(found, step)| (found / step - 1.0).abs() < 1e-6), "{settings}: {found:?}");
        assert_eq!(told, warnings, "{settings}");
    }
}

/// A change of velocity over more than seconds has its times in another unit.
#[test]
fn a_velocity_change_that_takes_minutes_is_told() {
    let told = |unit: &str| {
        let samples = format!("time{unit},delta_v_forward [km/h]\n0,0\n20,-5\n40,-10\n60,-20\n80,-30\n100,-32\n120,-32\n140,-32\n");
        record_of(&samples, None).1.out.contains("is recorded over")
    };
    assert_eq!(["", " [ms]"].map(told), [true, false]);
}

/// Seconds that are milliseconds, and kilometers an hour that are meters a second.
#[test]
fn velocity_changes_of_no_impact_are_told() {
    let told = |samples: &str| record_of(samples, None).1.out;
    let sound = "time [ms],delta_v_forward [m/s]\n0,0\n50,-5\n100,-11\n";
    let short = told("time [ms],delta_v_forward [m/s]\n0,0\n0.05,-5\n0.1,-11\n");
    assert!(short.contains("delta_v_forward is recorded over") && short.contains("which no impact lasts"), "{short}");
    assert!(told(&sound.replace("-11", "-101")).contains("no road vehicle has a speed of 101.00 m/s"));
    assert!(!told(&sound.replace("-11", "-99")).contains("no road vehicle") && !told(sound).contains("which no impact lasts"));
}

/// A change by one step from each reading to the next goes on, though the last tenth of its time changes by no more than rounding.
#[test]
fn few_steps_are_whole_only_if_they_stand_still() {
    let of = |changes: &[i32]| {
        let rows: String = changes.iter().enumerate().map(|(i, change)| format!("{},{change}\n", 10 * i)).collect();
        record_of(&format!("time [ms],delta_v_forward [mph]\n{rows}"), None).0["channels"][0]["is_truncated"].clone()
    };
    for (changes, is_truncated) in [
        (&[0, 0, -1, -2, -3, -4, -5, -6, -7][..], true),
        (&[0, 0, -1, -2, -4, -6, -8, -10, -11], true),
        (&[0, 0, -1, -2], true),
        (&[0, 0, 0, -1], true),
        (&[0, 0, -1, -1, -1], false),
        (&[0, 0, -1, -2, -3, -4, -5, -6, -7, -7, -7, -7, -7], false),
        (&[0, 0, -1, -3, -6, -9, -11, -12, -12, -12, -12], false),
        // Beside the brakes, of 0.5 g.
        (&[0, 0, -1, -3, -6, -9, -11, -12, -12, -12, -12, -12, -13, -13, -13, -13, -13], false),
    ] {
        assert_eq!(of(changes), is_truncated, "{changes:?}");
    }
}
