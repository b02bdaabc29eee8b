//! Separations from rest positions that follow what is uncertain of the vehicles.

use serde_json::Value;

use crate::process::{Folder, run, run_with_input};

/// Two cars that slid to rest, of which the second may be known by its separation velocity alone.
struct Scene {
    mass: &'static str,
    impact_center: &'static str,
    heading: &'static str,
    unknown_heading: &'static str,
    is_whole: bool,
}

const SCENE: Scene = Scene { mass: "1450", impact_center: "[\"1.85 m\", \"-0.4 m\"]", heading: "10", unknown_heading: "", is_whole: false };

impl Scene {
    fn text(&self) -> String {
        let Scene { mass, impact_center, heading, unknown_heading, is_whole } = self;
        let whole = if *is_whole { "yaw_inertia = 1900\nimpact_center = [1.6, 0.5]\n" } else { "" };
        let yaw_rate = if *is_whole { "vehicle.2.separation_yaw_rate = \"-3.7 rad/s ± 0.1 rad/s\"\n" } else { "" };
        format!(
            "schema = 1\n[[vehicle]]\nmass = {mass}\nyaw_inertia = 2600\nheading = \"{heading} deg\"\nimpact_center = {impact_center}\n\
             [[vehicle]]\nmass = 1180\nheading = \"120 deg\"\n{whole}[contact]\nmodel = \"momentum\"\n[scene]\nimpact_point = [10, 20]\n\
             [rest]\nfriction = 0.7\n[rest.vehicle.1]\nposition = [\"11.5 m ± 0.2 m\", \"22.5 m ± 0.2 m\"]\nheading = \"118 deg ± 3 deg\"\n\
             front_axle = 1.15\nrear_axle = 1.5\ntrack = 1.5\n\
             wheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = {{ braking = 0.4 }}, rear_right = {{ braking = 0.4 }} }}\n\
             [evidence]\nvehicle.2.separation_velocity = [\"2.3 m/s ± 0.1 m/s\", \"7.3 m/s ± 0.1 m/s\"]\n{yaw_rate}\
             [unknown]\nvehicle.1.speed = {{ start = 14, min = 0 }}\nvehicle.2.speed = {{ start = 14, min = 0 }}\n{unknown_heading}"
        )
    }

    /// Returns the first speed and its standard deviation.
    fn speed(&self) -> [f64; 2] {
        let answer = answer(&self.text());
        ["value", "sd"]
            .map(|key| answer["unknown"]["vehicle.1.speed"][key].as_f64().unwrap_or_else(|| panic!("{key}: {}", answer["unknown"])))
    }
}

fn answer(case: &str) -> Value {
    let run = run_with_input(&["reconstruct", "-", "--format", "json"], case);
    serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err))
}

/// Returns a case with other texts, each of which it must have.
fn edited(case: String, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(case, |case, (from, to)| {
        assert!(case.contains(from), "{from}");
        case.replacen(from, to, 1)
    })
}

/// Where the collision takes both as point masses, the slide has the inertia and the impact center of the file: what a kilogram of doubt does is a change of a kilogram.
#[test]
fn a_point_mass_slides_as_what_it_is() {
    let [certain, sd] = SCENE.speed();
    let [doubtful, its_sd] = Scene { mass: "\"1450 kg ± 1 kg\"", ..SCENE }.speed();
    assert!((certain - doubtful).abs() < 1e-9 && (its_sd / sd - 1.0).abs() < 1e-4, "{certain} ± {sd}, {doubtful} ± {its_sd}");
    // The impact center moves the speed through the slide alone.
    let [more, less] = ["[2.0, -0.4]", "[1.7, -0.4]"].map(|impact_center| Scene { impact_center, ..SCENE }.speed()[0]);
    let [value, wide] = Scene { impact_center: "[\"1.85 m ± 0.15 m\", \"-0.4 m\"]", ..SCENE }.speed();
    let by_hand = sd.hypot(0.5 * (more - less));
    assert!((value - certain).abs() < 1e-9 && (wide / by_hand - 1.0).abs() < 1e-3, "{wide}, and {by_hand} by hand");
    assert!(wide > 1.1 * sd, "the impact center matters: {wide} {sd}");
}

/// The separation and its covariance are those of the solution, wherever the case has a heading that is unknown.
#[test]
fn a_heading_that_is_unknown_has_no_effect() {
    let of = |heading: &'static str| {
        let unknown_heading =
            "vehicle.1.heading = { start = \"8 deg\", min = \"-20 deg\", max = \"40 deg\" }\nvehicle.2.impact_center.left = 0.5\n";
        let rest = ("[\"11.5 m ± 0.2 m\", \"22.5 m ± 0.2 m\"]", "[\"14.7 m ± 0.1 m\", \"24.5 m ± 0.1 m\"]");
        let separation = ("[\"2.3 m/s ± 0.1 m/s\", \"7.3 m/s ± 0.1 m/s\"]", "[\"2.41 m/s ± 0.1 m/s\", \"7.36 m/s ± 0.1 m/s\"]");
        let text = Scene { heading, unknown_heading, is_whole: true, ..SCENE }.text();
        answer(&edited(text, &[rest, separation, ("\"-3.7 rad/s ± 0.1 rad/s\"", "\"-3.71 rad/s ± 0.05 rad/s\"")]))
    };
    let [one, other] = ["30", "2"].map(of);
    assert_eq!((one["verdict"].as_str(), other["verdict"].as_str()), (Some("agrees"), Some("agrees")), "{}", one["messages"]);
    for name in ["vehicle.1.speed", "vehicle.1.heading", "vehicle.2.speed"] {
        let [one, other] = [&one, &other].map(|answer| &answer["unknown"][name]);
        let number = |of: &Value, key: &str| of[key].as_f64().unwrap_or_else(|| panic!("{key} {of}"));
        let [sd, its] = [one, other].map(|of| number(of, "sd"));
        assert!((sd / its - 1.0).abs() < 0.02, "{name}: {sd} {its}");
        assert!((number(one, "value") - number(other, "value")).abs() < 0.02 * sd, "{name}: {one} {other}");
    }
}

/// Evidence that may count one measurement twice gives a warning.
#[test]
fn what_counts_twice_is_told() {
    let case = |evidence: &str, mass: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = {mass}\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n\
             [contact]\ncrush_plane = 0\nrestitution = 0.1\n[evidence]\n{evidence}\n[unknown]\nvehicle.1.speed = {{ start = 10, min = 0 }}\n"
        )
    };
    let told = |evidence: &str, mass: &str| {
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &case(evidence, mass));
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let all = answer["messages"].as_array().expect("messages");
        all.iter().filter(|message| message["code"] == "counts-twice").map(|message| message["path"].to_string()).collect::<Vec<_>>()
    };
    let [forward, magnitude] = ["vehicle.1.delta_v_forward = \"-11 m/s ± 0.5 m/s\"", "vehicle.1.delta_v_magnitude = \"11 m/s ± 0.5 m/s\""];
    let both = "vehicle.1.delta_v = [\"-11 m/s ± 0.5 m/s\", \"0 m/s ± 0.5 m/s\"]";
    assert!(
        told(forward, "1500").is_empty() && told(&format!("{forward}\n{magnitude}"), "1500").is_empty() && told(both, "1500").is_empty()
    );
    assert_eq!(told(&format!("{both}\n{magnitude}"), "1500").len(), 1);
    let separation = "vehicle.1.separation_velocity = [\"-1 m/s ± 0.5 m/s\", \"0 m/s ± 0.5 m/s\"]";
    assert_eq!(told(&format!("{separation}\nvehicle.1.separation_speed = \"1 m/s ± 0.5 m/s\""), "1500").len(), 1);
    let mass = "vehicle.1.mass = \"1510 kg ± 20 kg\"";
    assert!(told(&format!("{forward}\n{mass}"), "1500").is_empty());
    assert_eq!(told(&format!("{forward}\n{mass}"), "\"1500 kg ± 20 kg\""), ["\"evidence.vehicle.1.mass\""]);
    let energies = "crush_energy = \"80 kJ ± 8 kJ\"";
    assert!(told(energies, "1500").is_empty());
    let also = [
        "vehicle.1.crush_energy = \"80 kJ ± 8 kJ\"",
        "W_n = \"-80 kJ ± 8 kJ\"",
        "vehicle.1.equivalent_energy_speed = \"10.3 m/s ± 0.5 m/s\"",
    ];
    for also in also {
        assert_eq!(told(&format!("{energies}\n{also}"), "1500").len(), 1, "{also}");
    }
    let speed = "contact.closing_speed = \"10 m/s ± 0.5 m/s\"";
    assert!(told(speed, "1500").is_empty());
    assert_eq!(told(&format!("{speed}\nv_n = \"-10 m/s ± 0.5 m/s\""), "1500").len(), 1);
}

/// Two vehicles have two crush energies, of which the total is the sum.
#[test]
fn the_crush_energies_of_two_vehicles_count_twice() {
    let told_of = |evidence: &[&str], unknown: &str| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\nvelocity = [10, 0]\n[[vehicle]]\n\
             mass = 1500\nyaw_inertia = 2500\nheading = \"180 deg\"\nimpact_center = [2, 0]\nspeed = 10\n[contact]\ncrush_plane = 0\n\
             restitution = 0.1\n[evidence]\n{}\n[unknown]\n{unknown}\n",
            evidence.join("\n")
        );
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let all = answer["messages"].as_array().expect("messages");
        all.iter().filter(|message| message["code"] == "counts-twice").map(|message| message["text"].to_string()).collect::<Vec<_>>()
    };
    let told = |evidence: &[&str]| told_of(evidence, "vehicle.1.speed = { start = 10, min = 0 }");
    let total = "crush_energy = \"150 kJ ± 10 kJ\"";
    let [one, two] = ["vehicle.1.crush_energy = \"75 kJ ± 8 kJ\"", "vehicle.2.crush_energy = \"75 kJ ± 8 kJ\""];
    let [speed, work] = ["vehicle.1.equivalent_energy_speed = \"10 m/s ± 0.5 m/s\"", "energy.normal_work = \"-150 kJ ± 10 kJ\""];
    let impulses = ["P_n", "P_t", "P_x"].map(|name| format!("{name} = \"15000 N s ± 500 N s\""));
    let [normal, tangential, along] = impulses.each_ref().map(String::as_str);
    let [before, component] = ["vehicle.1.speed = \"10 m/s ± 0.5 m/s\"", "vehicle.1.velocity.x = \"10 m/s ± 0.5 m/s\""];
    let [friction, loss] = ["energy.tangential_work = \"0 kJ ± 1 kJ\"", "energy.loss = \"148.5 kJ ± 5 kJ\""];
    let [energy, left] = ["energy.before = \"150 kJ ± 5 kJ\"", "energy.after = \"1.5 kJ ± 0.5 kJ\""];
    let [approach, rebound, ratio] = ["v_n = \"-20 m/s ± 1 m/s\"", "V_n = \"2 m/s ± 0.3 m/s\"", "contact.impulse_ratio = \"0 ± 0.1\""];
    let restitution = "contact.restitution = \"0.1 ± 0.02\"";
    for once in
        [&[total][..], &[one, two], &[work], &[normal, tangential], &[component], &[friction, loss], &[energy, loss], &[approach, rebound]]
    {
        assert!(told(once).is_empty(), "{once:?}");
    }
    for twice in [
        &[total, work][..],
        &[one, two, speed],
        &[total, one, two],
        &[normal, tangential, along],
        &[normal, tangential, ratio],
        &[before, component],
        &[work, friction, loss],
        &[energy, left, loss],
        &[approach, rebound, restitution],
    ] {
        let told = told(twice);
        assert!(told.len() == 1 && told[0].contains("count as independent"), "{twice:?}: {told:?}");
    }
    // Of two components that are sought the speed is the one along the heading.
    let both = "vehicle.1.velocity.x = { start = 10, min = 0 }\nvehicle.1.velocity.y = { start = 0 }";
    let across = "vehicle.1.velocity.y = \"0 m/s ± 0.5 m/s\"";
    assert!(told_of(&[before, across], both).is_empty() && told_of(&[component, across], both).is_empty());
    assert!(told_of(&[before, component], both)[0].contains("the velocity along the heading"));
}

/// Columns of one file whose rows are correlated give a warning if the case gives no correlation.
#[test]
fn columns_of_one_file_that_go_together_are_told() {
    let folder = Folder::new();
    let case = |column: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = {{ file = \"pair.csv\", column = \"m1\" }}\nyaw_inertia = 2500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n\
             [[vehicle]]\nmass = {{ file = \"pair.csv\", column = \"{column}\" }}\nyaw_inertia = 2200\nheading = 3.1\nspeed = 5\nimpact_center = [2, 0]\n\
             [contact]\ncrush_plane = 0\nrestitution = 0.1\n"
        )
    };
    folder.write(
        "pair.csv",
        b"m1 [kg],m2 [kg],m3 [kg],m4\n1260,1600,1500,1500 kg\n1320,1550,1450,1550\n1380,1500,1600,1600 kg\n1440,1450,1550,1450 kg\n",
    );
    let messages = |case: String| {
        folder.write("case.toml", case.as_bytes());
        let run = run(folder.path(), &["uncertainty", "case.toml", "--of", "dV1", "--method", "linear", "--format", "json"]);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        answer["messages"].to_string()
    };
    let told = messages(case("m2"));
    assert!(told.contains("independent-columns") && told.contains("a correlation of -1.00"), "{told}");
    assert!(!messages(case("m3")).contains("independent-columns"));
    // Lines of another file are other measurements.
    folder.write("other.csv", &std::fs::read(folder.path().join("pair.csv")).expect("the file"));
    let apart = case("m2").replacen("file = \"pair.csv\", column = \"m2\"", "file = \"other.csv\", column = \"m2\"", 1);
    assert!(apart.contains("other.csv") && !messages(apart).contains("independent-columns"));
    let correlated = case("m2").replace("schema = 1\n", "schema = 1\ncorrelation = [[\"m1\", \"m2\", -0.9]]\n");
    assert!(!messages(correlated).contains("independent-columns"));
    // A cell without a unit among others that have one.
    let bare = messages(case("m4"));
    assert!(bare.contains("line 3 in the column m4 of pair.csv has no unit: kg assumed"), "{bare}");
}

/// Points that a slide from an impact center of −0.4 m comes past: beside one of 0.2 m with a standard deviation of 0.3 m they contradict nothing, with one of 0.02 m they
/// do. They are judged with what is uncertain.
#[test]
fn points_are_judged_with_what_is_uncertain() {
    let of = |left: &str| {
        let case = Scene { heading: "10", is_whole: true, ..SCENE }.text();
        let center = format!("[1.85, {left}]");
        let points = "heading = \"114.891 deg ± 3 deg\"\npoints = [{ position = [\"8.6663 m ± 0.1 m\", \"20.4052 m ± 0.1 m\"] }, \
                      { position = [\"11.1592 m ± 0.1 m\", \"22.0102 m ± 0.1 m\"] }, { position = [\"14.1123 m ± 0.1 m\", \"24.1629 m ± 0.1 m\"] }]\n";
        let edits = [
            ("[\"1.85 m\", \"-0.4 m\"]", center.as_str()),
            ("friction = 0.7\n", "friction = \"0.7 ± 0.05\"\n"),
            ("[\"11.5 m ± 0.2 m\", \"22.5 m ± 0.2 m\"]", "[\"14.6436 m ± 0.1 m\", \"24.5527 m ± 0.1 m\"]"),
            ("heading = \"118 deg ± 3 deg\"\n", points),
            ("vehicle.1.speed = { start = 14, min = 0 }", "vehicle.1.velocity.x = { start = 15 }\nvehicle.1.velocity.y = { start = 2 }"),
            ("vehicle.2.speed = { start = 14, min = 0 }", "vehicle.2.velocity.x = { start = -5 }\nvehicle.2.velocity.y = { start = 10 }"),
        ];
        let answer = answer(&edited(case, &edits));
        let codes = answer["messages"].to_string();
        (
            answer["verdict"].as_str().expect("a verdict").to_owned(),
            codes.contains("points-move-inputs"),
            codes.contains("points-contradict-rest"),
        )
    };
    assert_eq!(of("\"-0.4 m ± 0.3 m\""), ("agrees".to_owned(), false, false));
    assert_eq!(of("\"0.2 m ± 0.3 m\""), ("agrees".to_owned(), true, false));
    assert_eq!(of("\"0.2 m ± 0.02 m\""), ("contradicted".to_owned(), false, true));
}

/// A crash whose rest headings, 2.14 and less of their standard deviations off, are those of slides that turn the other way: only motions elsewhere fit, which lead there within the
/// uncertainty. The motions before and the slides are those of a simulation of its own, of four wheels under static loads.
#[test]
fn a_motion_that_leads_near_the_rest_position_is_found_where_none_that_leads_there_fits() {
    let case = "schema = 1\n\
        [[vehicle]]\n\
        mass = \"1073.8 kg\"\n\
        yaw_inertia = \"1988.4 kg m^2\"\n\
        heading = \"-0.12934 rad\"\n\
        impact_center = [\"1.9 m\", \"0.3553 m\"]\n\
        [[vehicle]]\n\
        mass = \"2148.4 kg\"\n\
        yaw_inertia = \"3947.6 kg m^2\"\n\
        heading = \"1.48298 rad\"\n\
        impact_center = [\"0.5914 m\", \"0.8 m\"]\n\
        [contact]\n\
        crush_plane = \"0.01758 rad\"\n\
        [rest]\n\
        friction = \"0.619 ± 0.05\"\n\
        [rest.vehicle.1]\n\
        position = [\"7.377 m ± 0.3 m\", \"2.732 m ± 0.3 m\"]\n\
        heading = \"4.463 rad ± 0.07 rad\"\n\
        front_axle = \"1.2487 m\"\n\
        rear_axle = \"1.5842 m\"\n\
        track = \"1.5 m\"\n\
        wheels = { front_left = \"locked\", front_right = \"locked\", rear_left = \"rolling\", rear_right = \"rolling\" }\n\
        [rest.vehicle.2]\n\
        position = [\"14.383 m ± 0.3 m\", \"23.124 m ± 0.3 m\"]\n\
        heading = \"1.132 rad ± 0.07 rad\"\n\
        front_axle = \"1.2515 m\"\n\
        rear_axle = \"1.3541 m\"\n\
        track = \"1.5 m\"\n\
        wheels = { front_left = \"locked\", front_right = \"locked\", rear_left = \"rolling\", rear_right = \"rolling\" }\n\
        [unknown]\n\
        vehicle.1.speed = { start = \"12 m/s\", min = \"0 m/s\", max = \"60 m/s\" }\n\
        vehicle.2.speed = { start = \"12 m/s\", min = \"0 m/s\", max = \"60 m/s\" }\n\
        contact.restitution = { start = 0.1, min = 0, max = 0.3 }\n";
    let answer = answer(case);
    assert!(answer["verdict"] == "agrees" && answer["messages"].to_string().contains("separation-about-fit"), "{}", answer["messages"]);
    for (unknown, truth) in [("vehicle.1.speed", 16.94), ("vehicle.2.speed", 13.95), ("contact.restitution", 0.0465)] {
        let interval = &answer["unknown"][unknown]["interval"];
        let [low, high] = ["low", "high"].map(|end| interval[end].as_f64().expect("a number"));
        assert!(low <= truth && truth <= high && high - low < 0.25 * truth.max(0.2), "{unknown}: {low} to {high}");
    }
}

/// Three crashes whose separations turn round within the uncertainty of the rest positions. The speeds are those of a solver of its own, and the rest positions those of the slides, with
/// errors of their standard deviations: taken to first order about the rest positions, they contradict each other by a chi-square above 34, the last by 233. There the first fit lies too far
/// away to go there at once.
#[test]
fn separations_that_turn_round_are_taken_about_the_fitted_motion() {
    struct Crash {
        vehicles: [[f64; 5]; 2],
        wheels: [&'static str; 2],
        crush_plane: f64,
        rest: [[f64; 3]; 2],
        speeds: [f64; 2],
        restitution: f64,
    }
    let damaged = "front_left = \"locked\", front_right = { braking = 0.3 }, rear_left = \"rolling\", rear_right = \"rolling\"";
    let skidding = "front_left = \"rolling\", front_right = \"rolling\", rear_left = \"locked\", rear_right = { braking = 0.3 }";
    let braked = "front_left = \"rolling\", front_right = \"rolling\", rear_left = { braking = 0.2 }, rear_right = { braking = 0.3 }";
    let crashes = [
        Crash {
            vehicles: [[1769.3432, 3326.0253, 0.0, 1.6427, -0.5122], [1364.4156, 2108.5998, 1.3943, 0.655, 0.8585]],
            wheels: [damaged, skidding],
            crush_plane: -0.05956,
            rest: [[17.492, 6.493, 0.45368], [12.966, -0.264, -2.44143]],
            speeds: [17.760, 4.890],
            restitution: 0.186,
        },
        Crash {
            vehicles: [[1011.9515, 1743.3554, 0.0, 1.7348, -0.4345], [1556.3275, 2720.9003, 1.6822, -0.3707, 0.8747]],
            wheels: [damaged, skidding],
            crush_plane: -0.00785,
            rest: [[2.44, 3.536, 0.67955], [9.842, 12.542, 6.65626]],
            speeds: [17.845, 12.672],
            restitution: 0.249,
        },
        Crash {
            vehicles: [[2069.1856, 3554.0933, 0.0, 1.9757, 0.2627], [1151.0168, 1908.3371, 1.0488, -0.3184, 0.8171]],
            wheels: [braked, damaged],
            crush_plane: 0.15829,
            rest: [[24.449, 5.634, 0.14087], [6.109, 6.129, 1.41025]],
            speeds: [9.3065, 6.2042],
            restitution: 0.1359,
        },
    ];
    for Crash { vehicles, wheels, crush_plane, rest, speeds, restitution } in crashes {
        let mut case = "schema = 1\n".to_owned();
        for [mass, inertia, heading, forward, left] in vehicles {
            case +=
                &format!("[[vehicle]]\nmass = {mass}\nyaw_inertia = {inertia}\nheading = {heading}\nimpact_center = [{forward}, {left}]\n");
        }
        case += &format!("[contact]\ncrush_plane = {crush_plane}\n[scene]\nimpact_point = [0, 0]\n[rest]\nfriction = 0.7\n");
        for (i, ([x, y, heading], wheels)) in rest.into_iter().zip(wheels).enumerate() {
            case += &format!(
                "[rest.vehicle.{}]\nfront_axle = 1.15\nrear_axle = 1.5\ntrack = 1.5\nwheels = {{ {wheels} }}\nposition = [\"{x} m ± 0.3 m\", \"{y} m ± 0.3 m\"]\n\
                 heading = \"{heading} rad ± 3 deg\"\n",
                i + 1
            );
        }
        case += "[unknown]\nvehicle.1.speed = { start = 15, min = 0, max = 60 }\nvehicle.2.speed = { start = 10, min = 0, max = 60 }\n\
                 contact.restitution = { start = 0.1, min = 0, max = 0.3 }\n";
        // Of nine intervals of 95 % one need not hold.
        let run = run_with_input(&["reconstruct", "-", "--level", "0.99", "--format", "json"], &case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
        assert!(answer["verdict"] == "agrees" && number(&answer["chi_square"]) < 6.0, "{answer}");
        let told = answer["messages"].to_string();
        assert!(told.contains("separation-about-fit") && !told.contains("contradiction-by-slide"), "{told}");
        let wanted = [("vehicle.1.speed", speeds[0]), ("vehicle.2.speed", speeds[1]), ("contact.restitution", restitution)];
        for (name, truth) in wanted {
            let interval = &answer["unknown"][name]["interval"];
            assert!(number(&interval["low"]) <= truth && truth <= number(&interval["high"]), "{name} {truth}: {interval}");
        }
        // Those that lead to the rest positions are shown, and their slides end there.
        for separation in answer["separations"].as_array().expect("an array") {
            let off = separation["fit"]["position"].as_array().expect("two numbers").iter().map(|off| number(off).abs());
            assert!(off.fold(0.0, f64::max) < 1e-3, "{separation}");
        }
    }
}
