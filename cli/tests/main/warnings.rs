//! Warnings of `solve` about the physics, over a grid of collisions with a barrier: each is given where it holds, and nowhere else.

use serde_json::Value;

use crate::process::{Folder, run, run_with_input, workspace};

const MASS: f64 = 1000.0;
const YAW_INERTIA: f64 = 900.0;
const IMPACT_CENTER: [f64; 2] = [1.9, 0.9];

fn solved(plane: f64, restitution: f64, across: f64) -> Option<Value> {
    let [x, y] = IMPACT_CENTER;
    let case = format!(
        "schema = 1\n[[vehicle]]\nmass = \"{MASS} kg\"\nyaw_inertia = \"{YAW_INERTIA} kg m^2\"\nheading = \"0 deg\"\n\
         impact_center = [\"{x} m\", \"{y} m\"]\nvelocity = [\"12 m/s\", \"{across} m/s\"]\n[[vehicle]]\nbarrier = true\n\
         [contact]\ncrush_plane = \"{plane} rad\"\nrestitution = {restitution}\n"
    );
    let run = run_with_input(&["solve", "-", "--format", "json"], &case);
    // Some of the grid separates, or would gain energy.
    (run.status == 0).then(|| serde_json::from_str(&run.out).expect("JSON"))
}

/// The message of a code, with its path and its figure.
fn warning<'a>(solution: &'a Value, code: &str) -> Option<&'a Value> {
    let found = solution["messages"].as_array()?.iter().find(|message| message["code"] == code)?;
    assert_eq!(found["severity"], "warning");
    Some(found)
}

/// The greatest restitution that gains no energy for any approach velocity, e² = 1 − K_nt²/(K_nn K_tt), from the numbers of the file.
fn restitution_for_any_approach(plane: f64) -> f64 {
    let ([x, y], (sin, cos)) = (IMPACT_CENTER, plane.sin_cos());
    let (along, across) = (x * cos + y * sin, y * cos - x * sin);
    let compliance = |arm: f64, other: f64| 1.0 / MASS + arm * other / YAW_INERTIA;
    let coupling = along * across / YAW_INERTIA;
    (1.0 - coupling * coupling / (compliance(along, along) * compliance(across, across))).sqrt()
}

#[test]
fn each_is_given_where_it_holds_and_nowhere_else() {
    let mut counts = [[0; 2]; 2];
    for plane in [-0.5, -0.3, 0.0, 0.4, 0.8] {
        for restitution in [0.0, 0.3, 0.6, 0.8, 0.9, 0.99] {
            for across in [-9.0, -3.0, 0.5, 4.0, 10.0] {
                let Some(solution) = solved(plane, restitution, across) else { continue };
                let (work, loss) = (&solution["energy"]["tangential_work"], &solution["energy"]["loss"]);
                let returns_energy = work.as_f64() > Some(0.0) && loss.as_f64() > Some(0.0);
                let found = warning(&solution, "tangential-work-positive");
                assert_eq!(found.is_some(), returns_energy, "W_t = {work} at {plane}, {restitution}, {across}");
                assert!(found.is_none_or(|message| message["path"] == "contact"));
                let bound = restitution_for_any_approach(plane);
                let gains = restitution > bound;
                let found = warning(&solution, "restitution-can-gain-energy");
                assert_eq!(found.is_some(), gains, "e = {restitution}, beyond {bound}, at {plane}, {across}");
                if let Some(message) = found {
                    assert_eq!(message["path"], "contact.restitution");
                    let figure = message["figures"][0]["value"].as_f64().expect("the bound");
                    assert!((figure - bound).abs() < 1e-12, "{figure} in the message, {bound} by hand");
                }
                counts[0][usize::from(returns_energy)] += 1;
                counts[1][usize::from(gains)] += 1;
            }
        }
    }
    assert!(counts.iter().flatten().all(|&count| count >= 15), "both sides of each are tried: {counts:?}");
}

/// A vehicle that hits a barrier straight ahead of its center of mass does not turn: of K_nn + μ K_nt = 1/m the parts are 1/m + 2 (r sin Γ)²/I.
#[test]
fn digits_that_the_solution_loses_are_told() {
    let warned = |gyration: f64| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = \"1000 kg\"\nradius_of_gyration = \"{gyration} m\"\nheading = \"0 deg\"\nspeed = \"10 m/s\"\n\
             impact_center = [\"2 m\", \"0 m\"]\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = \"30 deg\"\nrestitution = 0\n"
        );
        let run = run_with_input(&["solve", "-", "--format", "json"], &case);
        assert_eq!(run.status, 0, "{}", run.err);
        let solution = serde_json::from_str(&run.out).expect("JSON");
        warning(&solution, "nearly-wedged").map(|message| (message["path"].clone(), message["text"].clone()))
    };
    let share = |gyration: f64| 1.0 / (1.0 + 2.0 * (2.0 * 0.5 / gyration).powi(2));
    assert!(share(0.003) < 1e-5 && share(0.006) > 1e-5 && warned(0.006).is_none() && warned(1.3).is_none());
    let (path, message) = warned(0.003).expect("a warning");
    assert_eq!(path, "contact");
    assert_eq!(message, "the pair nearly wedges: K_nn + mu K_nt is 4.5e-6 of its parts, so the impulse has about 9 digits");
}

#[test]
fn digits_that_a_check_of_the_answer_needs_are_missed() {
    // A radius of gyration of a hundredth of a millimetre: sliding is left over at the critical ratio, by rounding.
    let case = |yaw_inertia: f64| {
        format!(
            r#"{{"schema": 1, "vehicle": [
                {{"mass": "2123.6301985799887 kg", "yaw_inertia": "3663.67274522302 kg m^2", "heading": "-1.4524040577196542 rad",
                  "velocity": ["1559.9567246489962 m/s", "-8.266180693529837 m/s"], "yaw_rate": "0.6357614434093192 rad/s",
                  "impact_center": ["-3.6859524026034056 m", "0.6968256144259819 m"]}},
                {{"mass": "6794.651308800243 kg", "yaw_inertia": "{yaw_inertia} kg m^2", "heading": "-2.4339952518176293 rad",
                  "velocity": ["-6857.836974923591 m/s", "4.023791525513669e-05 m/s"],
                  "impact_center": ["1.847646874549461 m", "-0.6011543413506671 m"]}}],
                "contact": {{"crush_plane": "0.39814686621186635 rad", "restitution": 1.0}}}}"#
        )
    };
    let solved = |yaw_inertia: f64| -> Value {
        let run = run_with_input(&["solve", "-", "--format", "json"], &case(yaw_inertia));
        serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err))
    };
    let few = solved(9.864_599_523_009_58e-7);
    let said = warning(&few, "few-digits").and_then(|message| message["text"].as_str());
    assert!(said.is_some_and(|said| said.starts_with("rounding takes digits that a check of this answer needs: ")), "{few}");
    // As unusual, and with all its digits.
    let enough = solved(1.0);
    assert!(warning(&enough, "unusual-radius-of-gyration").is_some() && warning(&enough, "few-digits").is_none(), "{enough}");
}

/// No road vehicle is faster than 100 m/s or turns more than three times a second, as one that is read in a wrong unit.
#[test]
fn motions_of_no_road_vehicle_are_named() {
    let case = |speed: &str, yaw_rate: &str, rest: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = \"1500 kg\"\nyaw_inertia = \"2500 kg m^2\"\nheading = \"0 deg\"\nimpact_center = [\"1 m\", \"0 m\"]\n\
             yaw_rate = \"{yaw_rate} rad/s\"\n{speed}[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\n{rest}"
        )
    };
    let named = |verb: &str, case: &str| -> Vec<(String, f64)> {
        let run = run_with_input(&[verb, "-", "--format", "json"], case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        ["unusual-speed", "unusual-yaw-rate"]
            .into_iter()
            .filter_map(|code| {
                let found = warning(&answer, code)?;
                assert_eq!(found["path"], "vehicle.1");
                Some((code.to_owned(), found["figures"][0]["value"].as_f64().expect("a figure")))
            })
            .collect()
    };
    let of = |code: &str, value: f64| vec![(code.to_owned(), value)];
    assert_eq!(named("solve", &case("velocity = [\"80 m/s\", \"59 m/s\"]\n", "-20", "")), []);
    assert_eq!(named("solve", &case("velocity = [\"80 m/s\", \"60.5 m/s\"]\n", "-20", "")), of("unusual-speed", 80_f64.hypot(60.5)));
    assert_eq!(named("solve", &case("speed = \"20 m/s\"\n", "-20.5", "")), of("unusual-yaw-rate", 20.5));
    // One that is reconstructed, of a car into a barrier that lost ½ m v² (1 − e²).
    let asked = |loss: f64| {
        case("", "0", &format!("[evidence]\nenergy.loss = \"{loss} J ± 1 kJ\"\n[unknown]\nvehicle.1.speed = {{ start = \"20 m/s\" }}\n"))
    };
    let loss = |speed: f64| 750.0 * speed * speed * 0.99;
    assert_eq!(named("reconstruct", &asked(loss(99.0))), []);
    let found = named("reconstruct", &asked(loss(110.0)));
    assert!(matches!(&found[..], [(code, speed)] if code == "unusual-speed" && (speed - 110.0).abs() < 1e-6), "{found:?}");
}

/// Numbers in another unit: tonnes, millimeters, percentages.
#[test]
fn sizes_of_no_road_vehicle_are_named() {
    let case = |mass: &str, arm: &str, friction: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = {mass}\nradius_of_gyration = 1.3\nheading = 0\nspeed = 10\nimpact_center = [{arm}, 0.1]\n[[vehicle]]\n\
             barrier = true\n[contact]\ncrush_plane = 0.3\nrestitution = 0.1\nfriction = {friction}\n"
        )
    };
    let named = |mass: &str, arm: &str, friction: &str| -> Vec<(String, String, f64)> {
        let run = run_with_input(&["solve", "-", "--format", "json"], &case(mass, arm, friction));
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let warnings = answer["messages"].as_array().into_iter().flatten().filter(|message| message["severity"] == "warning").cloned();
        let text = |value: &Value| value.as_str().expect("a text").to_owned();
        warnings.map(|one| (text(&one["code"]), text(&one["path"]), one["figures"][0]["value"].as_f64().expect("a figure"))).collect()
    };
    let of = |code: &str, path: &str, value: f64| vec![(code.to_owned(), path.to_owned(), value)];
    assert_eq!(named("100", "1.9", "3"), []);
    assert_eq!(named("99.9", "1.9", "0.4"), of("unusual-mass", "vehicle.1", 99.9));
    assert_eq!(named("\"1450 t\"", "1.9", "0.4"), of("unusual-mass", "vehicle.1", 1.45e6));
    assert_eq!([named("250e3", "1.9", "0.4"), named("\"1e7 kg\"", "1.9", "0.4")], [[], []], "one represents a barrier");
    assert_eq!(named("1500", "15.1", "0.4"), of("unusual-impact-center", "vehicle.1", 15.1_f64.hypot(0.1)));
    assert_eq!(named("1500", "1.9", "3.1"), of("unusual-friction", "contact.friction", 3.1));
    // The lengths of its plan, in millimeters, and gravity in another unit.
    let with = |more: &str| named(&format!("1500\n{more}"), "1.9", "0.4");
    assert_eq!(with("length = 30\nwidth = 5\nfront_overhang = 5"), []);
    for (key, value) in [("length", 30.1), ("length", 0.4), ("width", 5.1), ("width", 0.2), ("front_overhang", 5.1)] {
        assert_eq!(with(&format!("{key} = {value}")), of("unusual-length", &format!("vehicle.1.{key}"), value));
    }
    // A crush that is wider than the side that it lies on.
    let crushed = |surface: &str, width: f64| {
        let crush = format!(
            "[vehicle.crush]\nsurface = \"{surface}\"\nwidth = {width}\ndepths = [0.1, 0.2]\nstiffness = {{ A = 60000, B = 500000 }}"
        );
        let text = case("1500\nlength = 4.5\nwidth = 1.8", "1.9", "0.4").replacen(
            "[[vehicle]]\nbarrier",
            &format!("{crush}\n[[vehicle]]\nbarrier"),
            1,
        );
        let run = run_with_input(&["solve", "-", "--format", "json"], &text);
        assert_eq!(run.status, 0, "{}", run.err);
        run.out.contains("\"wider-than-vehicle\"")
    };
    let of_surfaces = [("front", 1.9), ("front", 2.0), ("rear", 2.5), ("left", 4.9), ("left", 5.0), ("right", 6.0)];
    assert_eq!(of_surfaces.map(|(surface, width)| crushed(surface, width)), [false, true, true, false, true, true]);
    // The onset of a stiffness in another unit, beside a sound growth of the force.
    let stiff = |onset: &str| {
        let crush = format!("[vehicle.crush]\nwidth = 1.5\ndepths = [0.1, 0.2]\nstiffness = {{ A = \"{onset}\", B = \"500 kPa\" }}");
        let text = case("1500", "1.9", "0.4").replacen("[[vehicle]]\nbarrier", &format!("{crush}\n[[vehicle]]\nbarrier"), 1);
        let run = run_with_input(&["solve", "-", "--format", "json"], &text);
        assert_eq!(run.status, 0, "{}", run.err);
        run.out.contains("\"unusual-stiffness\"")
    };
    assert_eq!(["0 N/m", "0.9 kN/m", "1.1 kN/m", "390 kN/m", "410 kN/m", "50 MN/m"].map(stiff), [false, true, false, false, true, true]);
    let under = |gravity: f64| {
        let text = format!("schema = 1\ngravity = \"{gravity} m/s^2\"\n{}", case("1500", "1.9", "0.4").trim_start_matches("schema = 1\n"));
        let run = run_with_input(&["solve", "-", "--format", "json"], &text.replace("mass = 1500", "weight = \"15 kN\""));
        assert_eq!(run.status, 0, "{}", run.err);
        run.out.contains("\"unusual-gravity\"")
    };
    assert_eq!([2.98704, 9.69, 9.7, 9.80665, 9.9, 9.91, 32.2].map(under), [true, true, false, false, false, true, true]);
}

/// A decimal point that has slipped: of the ground, and of skids before the impact.
#[test]
fn frictions_of_no_tire_are_named() {
    let slide = slide();
    let line = slide.lines().find(|line| line.starts_with("friction = ")).expect("a friction");
    let skid = |friction: f64| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [1.9, 0.1]\nspeed = 10\n[[vehicle]]\n\
             barrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n[before.vehicle.1]\nskid = [{{ length = \"12 m\", friction = {friction} }}]\n"
        )
    };
    for (friction, is_named) in [(0.7, false), (1.5, false), (1.6, true), (7.0, true)] {
        let of_slide = slide.replacen(line, &format!("friction = {friction}"), 1);
        let of_region = slide.replacen("friction = 0.45", &format!("friction = {friction}"), 1);
        for (verb, case) in [("slide", of_slide), ("slide", of_region), ("solve", skid(friction))] {
            let run = run_with_input(&[verb, "-", "--format", "json"], &case);
            assert_eq!(run.status, 0, "{verb} {friction}: {}", run.err);
            assert_eq!(run.out.contains("\"unusual-friction\""), is_named, "{verb} {friction}");
        }
    }
}

fn slide() -> String {
    std::fs::read_to_string(workspace().join("cli/examples/slide.toml")).expect("an example")
}

/// Returns `true` if the example of a slide has a warning after a change.
fn warns_in_slide(code: &str, from: &str, to: &str) -> bool {
    let slide = slide();
    assert!(slide.contains(from), "{from}");
    let run = run_with_input(&["slide", "-", "--format", "json"], &slide.replacen(from, to, 1));
    assert_eq!(run.status, 0, "{}", run.err);
    run.out.contains(&format!("\"{code}\""))
}

/// The axles and the track, of which the way to rest depends.
#[test]
fn lengths_of_a_slide_are_named() {
    let slide = slide();
    let of = |from: &str, to: &str| warns_in_slide("unusual-length", from, to);
    let numbers = |key: &str| slide.lines().find(|line| line.starts_with(&format!("{key} = "))).expect("a key").to_owned();
    for (key, usual, unusual) in [("front_axle", "1.2 m", "1.15 ft"), ("rear_axle", "1.4 m", "9 m"), ("track", "1.5 m", "1.5 ft")] {
        let given = numbers(key);
        assert!(!of(&given, &format!("{key} = \"{usual}\"")) && of(&given, &format!("{key} = \"{unusual}\"")), "{key}");
    }
}

/// What the size of a vehicle contradicts: a width, an impact center, the axles.
#[test]
fn what_lies_outside_of_a_vehicle_is_named() {
    let of = warns_in_slide;
    assert!(of("unusual-length", "length = \"4.6 m\"", "length = \"1.7 m\""));
    assert!(!of("unusual-length", "length = \"4.6 m\"", "length = \"2.7 m\""));
    let center = "impact_center = [\"2.0 m\", \"0.3 m\"]";
    let at = |forward: &str, left: &str| of("unusual-impact-center", center, &format!("impact_center = [\"{forward} m\", \"{left} m\"]"));
    assert_eq!([at("2.0", "1.3"), at("2.0", "-1.3"), at("4.5", "0.3")], [false; 3]);
    assert_eq!([at("2.0", "1.4"), at("2.0", "-1.4"), at("4.7", "0.3")], [true; 3]);
    let axle = |rear: &str| of("unusual-length", "rear_axle = \"1.5 m\"", &format!("rear_axle = \"{rear} m\""));
    assert_eq!([axle("3.4"), axle("3.5")], [false, true]);
}

/// A share of an angle, however it is written, and one of radians that were degrees; a share of a mass says what it means.
#[test]
fn standard_deviations_that_no_angle_has_are_named() {
    let of = |from: &str, to: &str| warns_in_slide("share-of-angle", from, to);
    let heading = "heading = \"90 deg\"";
    assert!(of(heading, "heading = \"90 deg ± 5 %\"") && of(heading, "heading = { value = \"90 deg\", relative = \"5 %\" }"));
    assert!(!of(heading, "heading = \"90 ± 5 deg\"") && !of("\"1300 kg\"", "\"1300 kg ± 5 %\""));
    let wide = |sd: &str| warns_in_slide("unusual-sd", heading, &format!("heading = {{ value = \"90 deg\", sd = {sd} }}"));
    assert_eq!(["0.1", "\"57 deg\"", "1.1", "5"].map(wide), [false, false, true, true]);
    assert!(warns_in_slide("unusual-sd", heading, "heading = \"1.6 ± 5 rad\""));
    assert!(!warns_in_slide("unusual-sd", "\"1300 kg\"", "\"1300 kg ± 5 kg\""));
}

/// Degrees of a steered wheel that are taken in radians, in every place of the angle.
#[test]
fn wheels_that_no_vehicle_turns_so_are_named() {
    let of = |from: &str, to: &str| warns_in_slide("unusual-steer", from, to);
    let track = "track = \"1.48 m\"\n";
    assert_eq!(["0.5", "\"60 deg\"", "-5", "5"].map(|angle| of(track, &format!("{track}steer = {angle}\n"))), [false, false, true, true]);
    let wheel = "front_left = \"rolling\"";
    assert!(of(wheel, "front_left = { state = \"rolling\", steer = 5 }"));
    assert!(!of(wheel, "front_left = { state = \"rolling\", steer = \"5 deg\" }"));
}

/// A stiffness in N/mm² for N/cm²: the crush has twelve times the kinetic energy that there is.
#[test]
fn a_crush_beyond_the_kinetic_energy_is_named() {
    let case = std::fs::read_to_string(workspace().join("cli/examples/cavalier-crush.toml")).expect("an example");
    let given = "stiffness = { d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }";
    let of = |slope: &str| {
        assert!(case.contains(given));
        let case = case.replacen(given, &format!("stiffness = {{ A = \"175 N/cm\", B = \"{slope}\" }}"), 1);
        let run = run_with_input(&["solve", "-", "--format", "json"], &case);
        assert_eq!(run.status, 0, "{}", run.err);
        ["crush-beyond-energy", "unusual-stiffness"].map(|code| run.out.contains(&format!("\"{code}\"")))
    };
    assert_eq!(["50 N/cm^2", "5 N/mm^2", "50 N/mm^2"].map(of), [[false, false], [true, false], [true, true]]);
}

/// A direction of force with the wrong sign, or from behind, beside the impact of the case.
#[test]
fn a_direction_of_force_that_the_impact_contradicts_is_named() {
    let case = std::fs::read_to_string(workspace().join("cli/examples/cavalier-crush.toml")).expect("an example");
    let of = |pdof: &str| {
        let run = run_with_input(
            &["crash3", "-", "--format", "json"],
            &case.replacen("width = \"5 ft\"", &format!("width = \"5 ft\"\npdof = \"{pdof}\""), 1),
        );
        assert_eq!(run.status, 0, "{}", run.err);
        run.out.contains("\"pdof-contradicts-motion\"")
    };
    let without = run_with_input(&["crash3", "-", "--format", "json"], &case);
    assert!(!without.out.contains("\"pdof-contradicts-motion\""));
    let answer: Value = serde_json::from_str(&without.out).expect("JSON");
    let found = answer["vehicles"][0]["pdof"].as_f64().expect("a direction").to_degrees();
    assert!((5.0..30.0).contains(&found), "{found}");
    let near = format!("{:.1} deg", found - 15.0);
    let [turned, behind] = [format!("{:.1} deg", -found), "165 deg".to_owned()];
    assert_eq!([near, turned, behind].map(|pdof| of(&pdof)), [false, true, true]);
}

/// The unit of a column stands in brackets. One in its name would be read as meters per second, and so would a cell without a unit beside others.
#[test]
fn the_unit_of_a_column_is_never_lost() {
    let of = |header: &str, cells: [&str; 2]| {
        let folder = Folder::new();
        folder.write("tests.csv", format!("{header}\n{}\n{}\n", cells[0], cells[1]).as_bytes());
        let name = header.split(" [").next().expect("a name");
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1000\nyaw_inertia = 1500\nheading = 0\nspeed = {{ file = \"tests.csv\", column = \"{name}\" }}\n\
             impact_center = [2, 0.3]\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n"
        );
        folder.write("case.toml", case.as_bytes());
        run(folder.path(), &["solve", "case.toml", "--format", "json"])
    };
    for header in ["speed (mph)", "speed_mph", "speed / mph", "speed in mph"] {
        let run = of(header, ["30", "40"]);
        assert!(run.status == 2 && run.err.contains("write `speed [mph]`"), "{header}: {}", run.err);
    }
    for (header, cells, is_mixed) in [
        ("speed", ["30 mph", "40"], true),
        ("speed", ["30 mph", "40 mph"], false),
        ("speed [mph]", ["30", "40"], false),
        ("speed_m", ["30", "40"], false),
    ] {
        let run = of(header, cells);
        assert!(run.status == 0 && run.out.contains("\"mixed-units\"") == is_mixed, "{header} {cells:?}: {}{}", run.out, run.err);
    }
}

/// A number without a unit beside one of the same table that has one is in SI, which is hardly meant.
#[test]
fn a_number_without_a_unit_beside_one_that_has_one_is_told() {
    let told = |speed: &str, center: &str, restitution: &str| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1000\nyaw_inertia = 1500\nheading = \"0 deg\"\n{speed}\nimpact_center = {center}\n\
             [[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = {restitution}\nimpulse_ratio = 0.1\n"
        );
        let run = run_with_input(&["solve", "-", "--format", "json"], &case);
        assert_eq!(run.status, 0, "{case}: {}", run.err);
        let solution: Value = serde_json::from_str(&run.out).expect("JSON");
        let all = solution["messages"].as_array().cloned().unwrap_or_default();
        let mixed = all.into_iter().filter(|message| message["code"] == "mixed-units");
        mixed
            .map(|message| (message["path"].as_str().expect("a path").to_owned(), message["text"].as_str().expect("words").to_owned()))
            .collect::<Vec<_>>()
    };
    for (speed, center, restitution, path) in [
        ("speed = { min = \"50 km/h\", max = 60 }", "[2, 0.3]", "0.1", "vehicle.1.speed.max"),
        ("speed = { value = \"54 km/h\", sd = 3 }", "[2, 0.3]", "0.1", "vehicle.1.speed.sd"),
        ("velocity = [9, \"5 km/h\"]", "[2, 0.3]", "0.1", "vehicle.1.velocity.1"),
        ("speed = 10", "[\"75 in\", 0.3]", "0.1", "vehicle.1.impact_center.2"),
        ("speed = 10", "[2, 0.3]", "{ value = \"10 %\", sd = 0.02 }", "contact.restitution.sd"),
    ] {
        let found = told(speed, center, restitution);
        assert!(found.len() == 1 && found[0].0 == path && found[0].1.starts_with(path), "{path}: {found:?}");
    }
    for (speed, center, restitution) in [
        ("speed = { value = \"15 m/s\", sd = 0.5 }", "[\"2 m\", 0.3]", "\"10 %\""),
        ("velocity = [\"54 km/h\", 0]", "[2, 0.3]", "{ value = 0.1, sd = 0.02 }"),
        ("speed = { value = \"54 km/h\", relative = 0.1 }", "[\"75 in\", \"0.3 m\"]", "\"10 % ± 2 %\""),
        ("speed = \"54 km/h ± 3\"", "[2, 0.3]", "0.1"),
    ] {
        assert_eq!(told(speed, center, restitution), [], "{speed} {center} {restitution}");
    }
}
