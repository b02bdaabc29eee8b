//! Films of a point: their agreement with forces, their separation, and what contradicts them.

use super::*;

/// A point that leaves the barrier at once has a kink there: the frame of the separation belongs to the line after it, and no frame before it does.
#[test]
fn the_frame_of_the_separation_belongs_to_the_motion_after_it() {
    let place = |ms: i32| if ms <= 100 { 1000 - 10 * ms } else { 3 * (ms - 100) / 2 };
    let rows: String = (-15..=25).map(|i| format!("{},{}\n", 10 * i, place(10 * i))).collect();
    let (record, run) = record_of(&format!("time [ms],distance [mm]\n{rows}"), Some("separation = \"100 ms\"\n"));
    let film = &record["films"][0];
    close(&film["closing_speed"]["value"], 10.0, 1e-9);
    assert!((film["restitution"]["value"].as_f64().unwrap_or(f64::NAN) - 0.15).abs() < 1e-9, "{film} {}", run.err);
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
    close(&one["delta_v"]["sd"], of_sampling(160.0, 0.1, 1000.0), 1e-6);
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

/// Returns nearly normal numbers of variance 1: sums of twelve uniform ones.
fn normals(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        let uniform = |_: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(uniform).sum::<f64>() - 6.0
    }
}

/// The point of the motion below, in mm: in at 10 m/s, a half-sine of force over 100 ms, out at 1.5 m/s.
fn place_of_point(ms: i32) -> f64 {
    let t = f64::from(ms) * 1e-3;
    let contact = t.clamp(0.0, 0.1);
    let pushed = 11.5 / 2.0 * (contact - 0.1 / PI * (PI * contact / 0.1).sin()) + 11.5 * (t - 0.1).max(0.0);
    1e3 * (2.0 - 10.0 * t + pushed)
}

/// Writes a film with these rows, of a contact of 100 ms.
fn write_film(folder: &Folder, file: &str, rows: &str) {
    let text = format!("schema = 1\nwindow = [\"0 ms\", \"100 ms\"]\nsamples = \"time [ms],distance [mm]\\n{rows}\"\n");
    folder.write(file, text.as_bytes());
}

/// Returns how many films have a truth within 1.96 standard deviations of what they say.
fn held(json: &Value, of: &str, truth: f64) -> usize {
    let holds = |record: &&Value| {
        let found = |key: &str| record["films"][0][of][key].as_f64().expect("a number");
        (found("value") - truth).abs() <= 1.96 * found("sd")
    };
    json["records"].as_array().expect("records").iter().filter(holds).count()
}

/// Of nine frames before the contact, with errors of 4 mm: as the scatter is estimated from them, 1.96 of its standard deviations alone hold the closing speed in 86 %.
#[test]
fn few_frames_hardly_tell_their_scatter() {
    let (folder, mut normal) = (Folder::new(), normals(11));
    let names: Vec<String> = (0..80).map(|i| format!("{i}.toml")).collect();
    for file in &names {
        let mut rows = String::new();
        for ms in (-16..160).step_by(2) {
            write!(rows, "{ms},{:.3}\\n", place_of_point(ms) + 4.0 * normal()).expect("a string takes everything");
        }
        write_film(&folder, file, &rows);
    }
    let held = held(&records_of(&folder, &names), "closing_speed", 10.0);
    assert!((74..80).contains(&held), "{held} of 80");
}

/// Errors of 3 mm that go on from frame to frame, by an own recursion with a coefficient of 0.8, and such that do not: intervals of 95 % hold the restitution.
#[test]
fn errors_that_go_on_from_frame_to_frame_are_counted() {
    let mut normal = normals(7);
    let folder = Folder::new();
    let mut covered = |name: &str, coefficient: f64| {
        let names: Vec<String> = (0..60).map(|i| format!("{name}{i}.toml")).collect();
        for file in &names {
            let mut rows = String::new();
            let mut error = normal();
            for ms in -100..300 {
                error = coefficient * error + (1.0 - coefficient * coefficient).sqrt() * normal();
                write!(rows, "{ms},{:.3}\\n", place_of_point(ms) + 3.0 * error).expect("a string takes everything");
            }
            write_film(&folder, file, &rows);
        }
        let json = records_of(&folder, &names);
        let told = json.to_string().matches("\"correlated-frames\"").count();
        (held(&json, "restitution", 0.15), told)
    };
    let ([white, told_of_white], [correlated, told]) = (covered("w", 0.0).into(), covered("c", 0.8).into());
    assert!(white >= 53 && correlated >= 53, "{white} and {correlated} of 60");
    assert!(told_of_white <= 12 && told >= 45, "{told_of_white} and {told} of 60");
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
    assert!(!of("").out.contains("no impact lasts"));
    let seconds = record_of(&film.replacen("time [ms]", "time [s]", 1), None).1;
    assert!(film.starts_with("time [ms]") && seconds.out.contains("by distance the contact lasts"), "{}{}", seconds.out, seconds.err);
    let run = of("separation = \"-5 ms\"\n");
    assert!(run.status == 2 && run.err.contains("separation") && run.err.contains("leaves the barrier"), "{}", run.err);
    let run = of("[[channel]]\ncolumn = \"distance\"\nquantity = \"distance\"\npolarity = -1\n");
    assert!(run.status != 0 && run.err.contains("grows by") && run.err.contains("add or remove `polarity = -1`"), "{}", run.err);
}

/// A car that brakes into a barrier, at exactly 10 m/s: the local line before the contact is the mean of 9 frames, in which it was faster.
#[test]
fn the_curvature_of_a_film_is_in_its_deviations() {
    let of = |braking: f64, slowing: f64| {
        // Errors of up to 1 mm in no order.
        let error = |i: i32| {
            let digits = (12.9898 * f64::from(i) + 1.0).sin() * 43_758.545_3;
            2.0 * (digits - digits.floor()) - 1.0
        };
        let place = |i: i32| {
            let t = f64::from(i) / 120.0;
            let left = t - 0.1;
            let way = if t <= 0.0 { -10.0 * t + 0.5 * braking * t * t } else { -t * (0.1 - t).max(0.0) };
            way + if left > 0.0 { 1.0 * left - 0.5 * slowing * left * left } else { 0.0 }
        };
        let rows: String =
            (-24..=36).map(|i| format!("{:.4},{:.4}\n", f64::from(i) / 0.12, 5000.0 + 1000.0 * place(i) + error(i))).collect();
        record_of(&format!("time [ms],distance [mm]\n{rows}"), Some("window = [\"0 ms\", \"100 ms\"]\nseparation = \"100 ms\"\n"))
    };
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    for (braking, slowing) in [(0.0, 0.0), (3.0, 0.0), (7.0, 0.0), (0.0, 7.0)] {
        let (record, run) = of(braking, slowing);
        let film = &record["films"][0];
        let off = (number(&film["closing_speed"]["value"]) - 10.0) / number(&film["closing_speed"]["sd"]);
        assert!(off.abs() < 2.0, "{braking}: {film}");
        let off = (number(&film["restitution"]["value"]) - 0.1) / number(&film["restitution"]["sd"]);
        assert!(off.abs() < 2.0, "{slowing}: {film}");
        assert_eq!(run.out.contains("film-bends"), braking > 0.0 || slowing > 0.0, "{braking} {slowing}: {}", run.out);
    }
}
