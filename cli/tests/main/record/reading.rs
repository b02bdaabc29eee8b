//! Samples, settings and measured kinematics: as they are read, and as they are refused.

use super::*;

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
        ("1,5", "ms,5", "write the unit in the header, as `time [ms]`, and remove the line of units"),
        ("1,5", "1,[kN]", "write the unit in the header, as `normal_force [kN]`, and remove the line of units"),
        ("1,5", "-1,5", "time: the time is not later than the one before"),
        ("1,5", ",5", "time: "),
        ("kN]", "kg]", "[kg]: `kg` is a mass; a force is expected"),
        ("kN]", "stone]", "[stone]: "),
        ("[ms]", "[m]", "time: [m]: `m` is a length; a duration is expected"),
        ("time", "t", "time: no column has this name"),
        ("time [ms],normal", "time [ms];normal", "the columns are separated by semicolons or tabs"),
        ("time [ms],normal", "sep=,\ntime [ms],normal", "the first line must name the columns, and is `sep=`"),
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

/// A file that names its samples, or has them in itself, says of their columns what a CSV file says.
#[test]
fn columns_of_a_document_are_read_as_those_of_a_table() {
    let folder = Folder::new();
    let of = |header: &str| {
        let table = format!("{header}\n-2,0,0\n-1,0,0\n0,0,0\n1,5,2\n2,0,0\n");
        folder.write("samples.csv", table.as_bytes());
        folder.write("by_name.toml", b"schema = 1\nfile = \"samples.csv\"\n");
        folder.write("inside.toml", format!("schema = 1\nsamples = \"\"\"\n{table}\"\"\"\n").as_bytes());
        ["samples.csv", "by_name.toml", "inside.toml"].map(|name| run(folder.path(), &["record", name, "--format", "json"]))
    };
    for refused in of("time [ms],normal_force.a [kN],normal_force.a [kN]") {
        assert!(refused.status == 2 && refused.err.contains("normal_force.a: 2 columns have this name"), "{}", refused.err);
    }
    for refused in of("time [ms],normal_froce [kN],note") {
        assert!(refused.status == 2 && refused.err.contains("did you mean `normal_force` in place of `normal_froce`?"), "{}", refused.err);
    }
    for [second, code, says] in [
        [
            "normal_froce.b [kN]",
            "unread-column",
            "the column `normal_froce.b` is no channel, and is not used; did you mean `normal_force`?",
        ],
        ["temperature", "unused-columns", "these columns are no channels, and are not used: `temperature`"],
    ] {
        for read in of(&format!("time [ms],normal_force.a [kN],{second}")) {
            let answer: serde_json::Value = serde_json::from_str(&read.out).expect("JSON");
            let messages = answer["messages"].as_array().expect("messages");
            let said: Vec<&str> = messages.iter().filter(|one| one["code"] == code).filter_map(|one| one["text"].as_str()).collect();
            assert!(read.status == 0 && said.len() == 1 && said[0].contains(says), "{code}: {said:?} {}", read.err);
        }
    }
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
    let (_, misnamed) = record_of("time [s],speed,Delta V-forward [m/s]\n-1,10,\n0,9,0\n1,,-2\n", None);
    let said = "the column `Delta V-forward` is no channel, and is not used; did you mean `delta_v_forward`?";
    assert!(misnamed.status == 0 && misnamed.out.contains(said) && !misnamed.out.contains("unused-columns"), "{}", misnamed.out);
    let (_, none) = record_of("time [s],Tangential_Force [N]\n-1,10\n0,9\n", None);
    assert!(none.status == 2 && none.err.contains("did you mean `tangential_force` in place of `Tangential_Force`?"), "{}", none.err);
    let with_unit =
        record_of("time [s],dv (km/h)\n0,0\n0.1,-30\n", Some("[[channel]]\ncolumn = \"dv (km/h)\"\nquantity = \"delta_v_forward\"\n")).1;
    assert!(with_unit.status == 2 && with_unit.err.contains("write `dv [km/h]`"), "{}", with_unit.err);
    let missing = run(Folder::new().path(), &["record", "none.csv"]);
    assert!(missing.status == 2 && missing.err.contains("`none.csv` cannot be read"), "{}", missing.err);
}

/// A channel that is reversed and records nothing, from the time zero on.
#[test]
fn a_peak_of_zero_has_no_sign() {
    let samples: Vec<String> = (0..40).map(|i| format!("{i},0")).collect();
    let samples = format!("time [ms],acceleration [g]\n{}\n", samples.join("\n"));
    let (record, _) = record_of(&samples, Some(&format!("{CAR}[[channel]]\ncolumn = \"acceleration\"\npolarity = -1\n")));
    let peak = record["accelerations"][0]["peak"]["value"].as_f64().unwrap_or_else(|| panic!("{record}"));
    assert!(peak == 0.0 && peak.is_sign_positive(), "{peak}");
}

/// Of an acceleration, for which g is no gram in any spelling.
#[test]
fn the_gravity_of_a_header_is_the_standard_one() {
    let of = |unit: &str| record_of(&csv(&format!("acceleration [{unit}]"), &[&|ms| -20.0 * pulse(ms)]), Some(CAR)).0;
    let wanted = of("g");
    close(
        &wanted["accelerations"][0]["delta_v"]["value"],
        of("g0")["accelerations"][0]["delta_v"]["value"].as_f64().expect("a number"),
        1e-12,
    );
    for unit in ["G", "g's", "G's", "g’s", "G’s"] {
        assert!(of(unit) == wanted, "{unit}");
    }
}

/// A restitution is of the point, the angle and the speed of its test.
#[test]
fn kinematics_of_another_test_are_warned_of() {
    let folder = Folder::new();
    let kinematics = "schema = 1\n[kinematics]\nduration = 0.1\npoint = [1.9, \"0.1 m ± 0.02 m\"]\nbefore = { velocity = [8, 6] }\n\
                      heading = \"10 deg\"\nbarrier = \"10 deg\"\nafter = { velocity = [\"-1 m/s ± 0.1 m/s\", 0] }\n";
    folder.write("kinematics.toml", kinematics.as_bytes());
    let wall = "barrier = true";
    let car = "mass = 1000\nyaw_inertia = 1500\nheading = \"180 deg\"\nspeed = 0\nimpact_center = [2, 0]";
    let told = |center: &str, plane: &str, speed: &str, other: &str| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = {speed}\nimpact_center = {center}\n[[vehicle]]\n{other}\n\
             [contact]\ncrush_plane = {plane}\nimpulse_ratio = 0\n[evidence]\ncontact.record = {{ file = \"kinematics.toml\" }}\n\
             [unknown]\ncontact.restitution = {{ start = 0.1 }}\n"
        );
        folder.write("case.toml", case.as_bytes());
        let run = run(folder.path(), &["reconstruct", "case.toml", "--units", "si", "--format", "json"]);
        assert!(run.status <= 1, "{}", run.err);
        let answer: Value = serde_json::from_str(&run.out).expect("JSON");
        let all = answer["messages"].as_array().map_or(&[][..], Vec::as_slice);
        let texts = all.iter().filter_map(|message| message["text"].as_str()).filter(|text| text.contains("kinematics.toml "));
        texts.map(str::to_owned).collect::<Vec<_>>()
    };
    for (center, plane, speed, other, words) in [
        ("[1.9, 0.1]", "0", "10", wall, ""),
        ("[1.9, 0.2]", "\"180 deg\"", "10", wall, ""),
        (
            "[1.9, 0.3]",
            "0",
            "10",
            wall,
            "a point 1.90 m ahead of the center of mass and 0.10 m to its left, and the impact center of the case is 1.90 m ahead of the center of mass and 0.30 m to its left",
        ),
        ("[1.7, 0.1]", "0", "10", wall, "the impact center of the case is 1.70 m ahead"),
        (
            "[1.9, 0.1]",
            "\"7 deg\"",
            "10",
            wall,
            "has its barrier at 0 deg from the heading of the vehicle, and the case its crush plane at 7.0 deg",
        ),
        ("[1.9, 0.1]", "0", "14", wall, "has a speed of 10.00 m/s and the case one of 14.00 m/s"),
        ("[1.9, 0.1]", "0", "10", car, "here two vehicles collide"),
    ] {
        let found = told(center, plane, speed, other);
        assert_eq!(found.len(), usize::from(!words.is_empty()), "{words}: {found:?}");
        assert!(found.iter().all(|text| text.contains(words)), "{words}: {found:?}");
    }
    // A vehicle that turns about its center of mass has no speed.
    let turning = kinematics.replace("velocity = [8, 6]", "velocity = [0, 0], yaw_rate = -20");
    folder.write("kinematics.toml", turning.as_bytes());
    let found = told("[1.9, 0.1]", "0", "10", wall);
    assert!(found.len() == 1 && found[0].contains("has a speed of 0 m/s and the case one of 10.00 m/s"), "{found:?}");
}

/// As in the documentation of `MeasuredContact::restitution`: e = (0.5 + Ω (0.2 cos 0.05 + 1.5 sin 0.05))/10, with a standard deviation from that of the
/// velocity after, 0.2 m/s, and of the point.
#[test]
fn kinematics_give_the_restitution_of_the_contact_point() {
    let folder = Folder::new();
    let kinematics = "schema = 1\n[kinematics]\nduration = \"100 ms\"\npoint = [\"1.9 m\", \"0 m\"]\npoint_after = [\"1.5 m\", \"0.2 m ± 0.03 m\"]\n\
        before = { velocity = [\"10 m/s\", \"0 m/s\"] }\nafter = { velocity = [\"-0.5 m/s ± 0.2 m/s\", \"0.3 m/s\"], yaw_rate = \"1 rad/s\" }\n";
    folder.write("kinematics.toml", kinematics.as_bytes());
    folder.write("slow.toml", kinematics.replace("100 ms", "100 s").as_bytes());
    let slow = run(folder.path(), &["record", "slow.toml", "--format", "json"]).out;
    assert!(slow.contains("the contact lasts 100.000 s, which no impact lasts"), "{slow}");
    let run = run(folder.path(), &["record", "kinematics.toml", "--format", "json"]);
    assert!(!run.out.contains("which no impact lasts"), "{}", run.out);
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
    // Without its file, the keys and the channels of a recording are judged all the same.
    folder.write(
        "d.toml",
        b"schema = 1\nfile = \"none.csv\"\nfilter = 61\ncolor = 1\n[[channel]]\ncolumn = \"F\"\nquantity = \"force\"\n[[channel]]\npolarity = 2\n",
    );
    let refused = run(folder.path(), &["record", "d.toml"]);
    let faults: Vec<&str> = refused.err.lines().filter_map(|line| line.strip_prefix("error: ")).collect();
    let keys =
        ["file: ", "filter: ", "color: ", "channel.1.quantity: ", "channel.2.column: ", "channel.2.quantity: ", "channel.2.polarity: "];
    assert!(refused.status == 2 && faults.len() == keys.len(), "{}", refused.err);
    assert!(keys.iter().all(|key| faults.iter().any(|fault| fault.starts_with(key))), "{}", refused.err);
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

/// A cell that cannot be read hides no time that is out of order, and what stands behind a closing quote is no part of a number.
#[test]
fn faults_of_times_and_quotes_stand_beside_those_of_cells() {
    let both = record_of("time [ms],normal_force [N]\n0,nan\n1,5\n3,x\n3,1\n2,4\n", None).1;
    assert_eq!((both.status, both.out.as_str()), (2, ""));
    for says in ["`nan`", "`x` is not a number", "test.csv:5:1", "test.csv:6:1", "the time is not later than the one before"] {
        assert!(both.err.contains(says), "{says}: {}", both.err);
    }
    for (cells, says) in [
        ("0,\"1\"5\n1,20\n2,3\n", "the cell that begins in line 2 goes on after its closing quote"),
        ("0,15\n1,\"20\n2,3\n", "the quote that begins a cell in line 3 is never closed"),
    ] {
        let refused = record_of(&format!("time [ms],normal_force [N]\n{cells}"), None).1;
        assert!(refused.status == 2 && refused.err.contains(says), "{}", refused.err);
    }
}

/// What a header has that a terminal would obey is shown, and not sent.
#[test]
fn notices_beside_a_chart_are_clean() {
    let folder = Folder::new();
    folder.write("test.csv", csv("acceleration.\u{1b}[31mred\u{202e} [g]", &[&|_| 1.0]).as_bytes());
    let run = run(folder.path(), &["record", "test.csv", "--format", "svg"]);
    assert!(run.err.contains("U+001B[31mred") && !run.err.contains(['\u{1b}', '\u{202e}']), "{}", run.err);
}
