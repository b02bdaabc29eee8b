//! Ordinary casework: momentum alone, skids before the impact, slides to rest on the scene, slips of input.
//!
//! The reference is the closed form of each question, written out here.

use serde_json::Value;

use crate::process::{Folder, run, run_with_input, workspace};

const GRAVITY: f64 = 9.80665;
const MPH: f64 = 0.44704;
const FOOT: f64 = 0.3048;

fn json_of(call: &[&str], case: &str) -> Value {
    let run = run_with_input(&[call, &["-", "--format", "json"]].concat(), case);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{case}");
    serde_json::from_str(&run.out).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn close(got: &Value, want: f64, tolerance: f64) {
    let got = number(got);
    assert!((got - want).abs() <= tolerance * want.abs().max(1e-3), "{got}, not {want}");
}

fn example(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/examples").join(name)).expect("an example")
}

fn reproducer(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/tests/reproducers").join(name)).expect("a reproducer")
}

/// Words of a page without its line breaks.
fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// v₁ = V₁x + (m₂/m₁) V₂x and v₂ = (m₁/m₂) V₁y + V₂y, with the errors of each velocity of 1 mph.
#[test]
fn momentum_is_the_parallelogram_of_momenta() {
    let answer = json_of(&["reconstruct"], &example("reconstruct/momentum.toml"));
    let ratio = 3875.0 / 4220.0;
    let (v1, v2) = (14.0 + ratio * 12.0, 16.0 / ratio + 19.0);
    let (sd_1, sd_2) = (1_f64.hypot(ratio), 1_f64.hypot(1.0 / ratio));
    for (name, value, sd) in [("vehicle.1.speed", v1, sd_1), ("vehicle.2.speed", v2, sd_2)] {
        let unknown = &answer["unknown"][name];
        close(&unknown["value"], value * MPH, 1e-9);
        close(&unknown["sd"], sd * MPH, 1e-9);
        // The 0.975 quantile of the normal distribution.
        close(&unknown["interval"]["low"], (value - 1.959_963_984_540_054 * sd) * MPH, 1e-6);
        close(&unknown["interval"]["high"], (value + 1.959_963_984_540_054 * sd) * MPH, 1e-6);
    }
    assert!((v1 - 25.0).abs() < 0.05 && (v2 - 36.4).abs() < 0.05, "the published answer");
    // The impulse is the change of vehicle 1's momentum; the loss is that of translation.
    let pound = 0.453_592_37;
    let (m1, m2) = (4220.0 * pound, 3875.0 * pound);
    let impulse = [m1 * (14.0 - v1) * MPH, m1 * 16.0 * MPH];
    close(&answer["unknown"]["contact.impulse.x"]["value"], impulse[0], 1e-9);
    close(&answer["unknown"]["contact.impulse.y"]["value"], impulse[1], 1e-9);
    let squares = |a: f64, b: f64| (a * a + b * b) * MPH * MPH;
    let loss = 0.5 * (m1 * (squares(v1, 0.0) - squares(14.0, 16.0)) + m2 * (squares(v2, 0.0) - squares(12.0, 19.0)));
    close(&answer["solution"]["energy"]["loss"], loss, 1e-9);
    close(&answer["derived"]["vehicle.1.delta_v_magnitude"]["value"], impulse[0].hypot(impulse[1]) / m1, 1e-9);
    // Clockwise from ahead: the push on vehicle 1 comes from its front right, that on vehicle 2 is the opposite.
    let pdof = (impulse[1]).atan2(-impulse[0]);
    close(&answer["derived"]["vehicle.1.pdof"]["value"], pdof, 1e-9);
    assert_eq!(answer["derived"].get("energy.normal_work"), None, "no normal, no work of it");
    let solution = &answer["solution"];
    assert_eq!(solution["contact"]["model"], "momentum");
    close(&solution["contact"]["crush_plane"], impulse[1].atan2(impulse[0]), 1e-9);
    close(&solution["contact"]["impulse"]["normal"], impulse[0].hypot(impulse[1]), 1e-9);
    assert!(solution["vehicles"][0]["yaw_rate"].is_null(), "point masses do not say how they turn");
    // Skids on a grade: v² + 2 g (0.7 + 0.02) 60 ft.
    let skid = (2.0 * GRAVITY * 0.72 * 60.0 * FOOT).sqrt();
    close(&answer["derived"]["before.vehicle.1.braking_speed"]["value"], (v1 * MPH).hypot(skid), 1e-9);
    let sd_skid = 2.0 * GRAVITY * 60.0 * FOOT * 0.05 / (2.0 * skid);
    close(&answer["unknown"]["before.vehicle.1.skid_speed"]["sd"], sd_skid, 1e-9);
    let sd = (v1 * MPH * sd_1 * MPH).hypot(skid * sd_skid) / (v1 * MPH).hypot(skid);
    close(&answer["derived"]["before.vehicle.1.braking_speed"]["sd"], sd, 1e-9);
}

/// With yaw inertia and impact center of both, the impulse changes the yaw rates: I ω = r × P.
#[test]
fn angular_momentum_takes_part_where_both_vehicles_give_it() {
    let case = reproducer("momentum_alone.toml").replace("crush_plane = \"0 deg\"", "model = \"momentum\"");
    let answer = json_of(&["reconstruct"], &case);
    let solution = &answer["solution"];
    let impulse = [number(&solution["contact"]["impulse"]["x"]), number(&solution["contact"]["impulse"]["y"])];
    let inertia = 1.355_817_948_331_400_4; // slug ft², in kg m²
    // Vehicle 1 heads along x, with its impact center 6 ft ahead; vehicle 2 along y, with it 2 ft ahead and 3 ft to the left.
    close(&solution["vehicles"][0]["yaw_rate"], 6.0 * FOOT * impulse[1] / (2600.0 * inertia), 1e-9);
    close(&solution["vehicles"][1]["yaw_rate"], (2.0 * impulse[0] + 3.0 * impulse[1]) * FOOT / (2300.0 * inertia), 1e-9);
    let notes = answer["notes"].to_string();
    assert!(
        notes.contains("contact.restitution is not solved for") && notes.contains("contact.impulse_ratio is not solved for"),
        "{notes}"
    );
    // A yaw rate is evidence then, and only then; and so are energies, of which rotation is a part.
    assert!(answer["derived"]["energy.loss"]["interval"]["low"].is_f64(), "{answer}");
    let with_yaw = |case: &str| case.replace("[evidence]\n", "[evidence]\nvehicle.1.separation_yaw_rate = \"400 deg/s ± 5 deg/s\"\n");
    assert_eq!(json_of(&["reconstruct"], &with_yaw(&case))["degrees_of_freedom"], 1);
    let refused = run_with_input(&["reconstruct", "-"], &with_yaw(&case.replace("impact_center = [\"2 ft\", \"3 ft\"]\n", "")));
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    assert!(flat(&refused.err).contains("vehicle.1.separation_yaw_rate needs angular momentum"), "{}", refused.err);
    let points = example("reconstruct/momentum.toml");
    let answer = json_of(&["reconstruct"], &points);
    assert!(answer["derived"].get("energy.loss").is_none() && answer["notes"].to_string().contains("translation alone"), "{answer}");
    for energy in ["energy.loss", "energy.after"] {
        let with_energy = points.replace("[evidence]\n", &format!("[evidence]\n{energy} = \"100 kJ ± 10 kJ\"\n"));
        let refused = run_with_input(&["reconstruct", "-"], &with_energy);
        let says = format!("{energy} includes the energy of rotation, of which point masses have none");
        assert!(refused.status == 2 && flat(&refused.err).contains(&says), "{}", refused.err);
        let asked = run_with_input(&["reconstruct", "-", "--probability", &format!("{energy} > 100 kJ")], &points);
        assert!(asked.status == 2 && flat(&asked.err).contains("includes the energy of rotation"), "{}", asked.err);
    }
    let page = flat(&run_with_input(&["reconstruct", "-"], &points).out);
    assert!(page.contains("approach velocity of the centers of mass") && page.contains("between the centers of mass"), "{page}");
}

#[test]
fn a_contact_that_contradicts_the_evidence_leaves_what_momentum_says() {
    let path = "cli/tests/reproducers/momentum_alone.toml";
    let run = run(&workspace(), &["reconstruct", path]);
    assert_eq!(run.status, 1);
    let text = flat(&run.out);
    assert!(text.contains("momentum alone gives vehicle.1.speed 25.0 mph and vehicle.2.speed 36.4 mph"), "{}", run.out);
    assert!(text.contains("`model = \"momentum\"` in [contact] has their intervals"), "{}", run.out);
    // By angular momentum too it would be another answer.
    let case = std::fs::read_to_string(workspace().join(path)).expect("the case");
    let yaw = case.replacen("[evidence]\n", "[evidence]\nvehicle.1.separation_yaw_rate = \"10 deg/s ± 5 deg/s\"\n", 1);
    let text = flat(&run_with_input(&["reconstruct", "-"], &yaw).out);
    assert!(text.contains("from the velocities after the impact; `model = \"momentum\"` in [contact] uses the yaw rates too"), "{text}");
}

/// In truth the impact center of vehicle 2 lies to the left.
#[test]
fn an_impact_center_on_the_wrong_side_is_named() {
    let run = run(&workspace(), &["reconstruct", "cli/tests/reproducers/wrong_side.toml"]);
    assert_eq!(run.status, 1);
    let text = flat(&run.out);
    assert!(
        text.contains("check vehicle.2.impact_center: with the impact center of vehicle 2 at left = 0.80 m, the mirror image,"),
        "{text}"
    );
    assert!(text.contains("with a chi-square of 0.0 in place of 142.6"), "{text}");
    assert_eq!(text.matches("check vehicle").count(), 1, "no other slip explains it: {text}");
}

/// Each slip in a case whose truth is known is named at its key, and first.
#[test]
fn slips_are_named() {
    let truth = "schema = 1\n\
        [[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"10 deg\"\nimpact_center = [2, 0.3]\n\
        [[vehicle]]\nmass = 1300\nyaw_inertia = 2000\nheading = \"100 deg\"\nimpact_center = [0.6, 0.8]\n\
        [contact]\ncrush_plane = \"20 deg\"\nrestitution = 0.4\n";
    let moving = truth.replacen("impact_center", "speed = 15\nimpact_center", 1).replacen("mass = 1300", "speed = 9\nmass = 1300", 1);
    let solved = json_of(&["solve"], &moving);
    let after = |i: usize, key: &str| solved["vehicles"][i][key].clone();
    let measured = |yaw: f64, speeds: [f64; 2]| {
        let velocity = |i: usize| {
            let [x, y] = [0, 1].map(|k| number(&after(i, "velocity")[k]) * speeds[i]);
            format!("[\"{x} m/s ± 0.1 m/s\", \"{y} m/s ± 0.1 m/s\"]")
        };
        let yaw_rate = |i: usize| number(&after(i, "yaw_rate")) * if i == 0 { yaw } else { 1.0 };
        format!(
            "[evidence]\nvehicle.1.separation_velocity = {}\nvehicle.2.separation_velocity = {}\n\
             vehicle.1.separation_yaw_rate = \"{} rad/s ± 0.05 rad/s\"\nvehicle.2.separation_yaw_rate = \"{} rad/s ± 0.05 rad/s\"\n\
             vehicle.2.speed = \"{} m/s ± 0.1 m/s\"\n[unknown]\nvehicle.1.speed = 12\n",
            velocity(0),
            velocity(1),
            yaw_rate(0),
            yaw_rate(1),
            9.0 * speeds[1],
        )
    };
    let evidence = |yaw: f64, speed: f64| measured(yaw, [1.0, speed]);
    let sound = evidence(1.0, 1.0);
    assert_eq!(json_of(&["reconstruct"], &format!("{truth}{sound}"))["verdict"], "agrees");
    let slips = [
        (
            truth.replace("[2, 0.3]", "[2, -0.3]"),
            sound.clone(),
            "vehicle.1.impact_center",
            "with the impact center of vehicle 1 at left = 0.30 m, the mirror",
        ),
        (
            truth.replace("[2, 0.3]", "[2, -0.3]").replace("[0.6, 0.8]", "[0.6, -0.8]"),
            sound.clone(),
            "vehicle.1.impact_center",
            "with the impact center of vehicle 1 at left = 0.30 m and the impact center of vehicle 2 at left = 0.80 m, the mirror",
        ),
        (
            truth.replace("10 deg", "0 d").replace("\"100 deg", "\"10 deg").replace("\"0 d\"", "\"100 deg\""),
            sound.clone(),
            "vehicle.1.heading",
            "exchanged",
        ),
        (truth.replace("mass = 1300", "mass = 2866.009"), sound.clone(), "vehicle.2.mass", "pounds taken for kilograms"),
        // 9 m/s are 32.4 km/h and 20.1 mph.
        (truth.to_owned(), sound.replace("\"9 m/s", "\"20.132 km/h"), "vehicle.2.speed", "with 32.4 km/h, mph taken for km/h"),
        (truth.to_owned(), sound.replace("\"9 m/s", "\"32.4 mph"), "vehicle.2.speed", "with 32.4 km/h, km/h taken for mph"),
        (
            truth.to_owned(),
            evidence(1.0, 1.0 / 1.609_344),
            "vehicle.2.separation_velocity.x",
            "every given speed of vehicle 2 times 1.6093, mph taken",
        ),
        (
            truth.to_owned(),
            evidence(1.0, 1.609_344),
            "vehicle.2.separation_velocity.x",
            "every given speed of vehicle 2 times 0.6214, km/h taken",
        ),
        (truth.to_owned(), measured(1.0, [1.609_344; 2]), "vehicle.1.separation_velocity.x", "every given speed times 0.6214, km/h taken"),
        (truth.replace("\"100 deg", "\"1.745329 deg"), sound.clone(), "vehicle.2.heading", "radians taken for degrees"),
        (truth.replace("\"20 deg", "\"0.349066 deg"), sound.clone(), "contact.crush_plane", "radians taken for degrees"),
        (truth.to_owned(), evidence(-1.0, 1.0), "vehicle.1.separation_yaw_rate", "the other way round"),
        (truth.to_owned(), evidence(57.295_779_513, 1.0), "vehicle.1.separation_yaw_rate", "degrees taken for radians"),
    ];
    // The speed of vehicle 2 may be given as known, without a standard deviation.
    let known = |speed: &str| truth.replacen("mass = 1300", &format!("speed = \"{speed}\"\nmass = 1300"), 1);
    let without_speed = || sound.lines().filter(|line| !line.starts_with("vehicle.2.speed")).collect::<Vec<_>>().join("\n");
    let of_known = [("20.132 km/h", "mph taken for km/h"), ("32.4 mph", "km/h taken for mph")];
    let of_known = of_known.map(|(speed, words)| (known(speed), without_speed(), "vehicle.2.speed", words));
    for (case, evidence, path, words) in slips.into_iter().chain(of_known) {
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &format!("{case}{evidence}"));
        assert_eq!(run.status, 1, "{words}: {}", run.err);
        let answer: Value = serde_json::from_str(&run.out).expect("JSON");
        let found = answer["messages"].as_array().expect("messages").iter().find(|message| message["code"] == "possible-slip");
        let found = found.unwrap_or_else(|| panic!("{words}: {}", answer["messages"]));
        assert_eq!((found["path"].as_str(), found["severity"].as_str()), (Some(path), Some("warning")));
        assert!(found["text"].as_str().expect("a sentence").contains(words), "{found}");
    }
}

/// The slide to rest has the mass too, and begins at the heading.
#[test]
fn slips_are_named_beside_rest_positions() {
    let case = example("reconstruct/two-cars.toml");
    let (ten, other) = ("heading = \"10 deg\"", "heading = \"120 deg\"");
    let exchanged = case.replacen(ten, "HEADING", 1).replacen(other, ten, 1).replacen("HEADING", other, 1);
    let slips = [
        (case.replace("mass = \"1180 kg\"", "mass = \"2601 kg\""), "vehicle.2.mass", "pounds taken for kilograms"),
        (case.replace(other, "heading = \"2.0944 deg\""), "vehicle.2.heading", "120.0 deg, radians taken for degrees"),
        (exchanged, "vehicle.1.heading", "the headings of both vehicles exchanged"),
    ];
    for (case, path, words) in slips {
        let run = run_with_input(&["reconstruct", "-", "--starts", "8", "--format", "json"], &case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{words}: {error} {}", run.err));
        let messages = answer["messages"].as_array().expect("messages");
        let slips: Vec<&Value> = messages.iter().filter(|message| message["code"] == "possible-slip").collect();
        let named = slips.iter().any(|slip| slip["path"] == path && slip["text"].as_str().is_some_and(|text| text.contains(words)));
        assert!(run.status == 1 && named, "{words}: {slips:?} {messages:?}");
        // Nobody wrote a separation that is computed.
        assert!(slips.iter().all(|slip| !slip["path"].as_str().is_some_and(|path| path.contains("separation"))), "{slips:?}");
    }
}

/// A photograph of the rest position does not show how often the vehicle turned.
#[test]
fn a_whole_turn_at_rest_is_named() {
    let case = example("reconstruct/two-cars.toml");
    for (given, meant) in [("347 deg", "-13.0 deg"), ("-373 deg", "-13.0 deg")] {
        let run = run_with_input(&["reconstruct", "-", "--starts", "8"], &case.replace("\"-13 deg", &format!("\"{given}")));
        let text = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
        let wanted = format!("check rest.vehicle.2.heading: with {meant}, a whole turn from it, the evidence would agree");
        assert!(run.status == 1 && text.contains(&wanted), "{given}: {text} {}", run.err);
        assert_eq!(text.matches("check rest").count(), 1, "{text}");
    }
}

/// 3000 lb at 45 mph to the north-west and 2000 lb at 30 mph to the east lock together: published as 20.4 mph.
#[test]
fn point_masses_lock_together() {
    let answer = json_of(&["solve"], &reproducer("coincident_centers.toml"));
    let along = 45.0 * 0.5_f64.sqrt();
    let common = [(-3.0 * along + 2.0 * 30.0) / 5.0 * MPH, 3.0 * along / 5.0 * MPH];
    for i in 0..2 {
        for (k, common) in common.into_iter().enumerate() {
            close(&answer["vehicles"][i]["velocity"][k], common, 1e-12);
        }
    }
    assert!((common[0].hypot(common[1]) / MPH - 20.4).abs() < 0.05);
    let apart =
        run_with_input(&["solve", "-"], &reproducer("coincident_centers.toml").replacen("[\"0 m\", \"0 m\"]", "[\"0 m\", \"-1 m\"]", 1));
    assert_eq!(apart.status, 3, "a body has sides: {}", apart.out);
}

/// The skids of both vehicles are on one road: the speeds that they tell are correlated as the frictions are.
#[test]
fn skids_of_two_vehicles_are_correlated_as_their_frictions() {
    let case = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/momentum.toml")).expect("an example");
    let second = "[before.vehicle.2]\nskid = [{ length = \"30 ft\", friction = \"0.7 ± 0.05\" }]\n\n[evidence]";
    let case = case.replacen("[evidence]", second, 1);
    let found = |correlation: &str| {
        let run = run_with_input(
            &["reconstruct", "-", "--format", "json"],
            &case.replacen("schema = 1\n", &format!("schema = 1\n{correlation}"), 1),
        );
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let pair = &answer["correlation"]["before.vehicle.1.skid_speed"]["before.vehicle.2.skid_speed"];
        pair.as_f64().unwrap_or_else(|| panic!("{answer}"))
    };
    let of = |coefficient: &str| {
        found(&format!("correlation = [[\"before.vehicle.1.skid.1.friction\", \"before.vehicle.2.skid.1.friction\", {coefficient}]]\n"))
    };
    assert!(found("").abs() < 1e-9 && (of("0.6") - 0.6).abs() < 1e-6 && (of("-0.9") + 0.9).abs() < 1e-6);
}

/// 14 m at 0.7, then 6 m of grass at 0.45 on a grade of 2 % with brakes on 80 %.
const SKIDS: &str = "\n[before.vehicle.1]\nskid = [{ length = \"14 m\", friction = \"0.7 ± 0.05\" }, \
    { length = \"6 m\", friction = 0.45, grade = \"2 %\", braking = 0.8 }]\nreaction_time = \"1.5 s\"\n";

#[test]
fn skids_give_the_speed_before_them() {
    let case = example("slide.toml") + SKIDS;
    let answer = json_of(&["solve"], &case);
    let braking = &answer["vehicles"][0]["braking"];
    let (end, grass) = (55.0 / 3.6, 0.45 * 0.8 + 0.02);
    let middle = f64::hypot(end, (2.0 * GRAVITY * grass * 6.0).sqrt());
    let start = f64::hypot(middle, (2.0 * GRAVITY * 0.7 * 14.0).sqrt());
    close(&braking["speed"], start, 1e-12);
    close(&braking["impact_speed"], end, 1e-12);
    for (i, (from, to)) in [(start, middle), (middle, end)].into_iter().enumerate() {
        close(&braking["skids"][i]["start"], from, 1e-12);
        close(&braking["skids"][i]["end"], to, 1e-12);
    }
    let slope = 0.02_f64.hypot(1.0);
    close(&braking["skids"][0]["deceleration"], 0.7 * GRAVITY, 1e-12);
    close(&braking["skids"][1]["deceleration"], grass * GRAVITY / slope, 1e-12);
    let times = [(start - middle) / (0.7 * GRAVITY), (middle - end) / (grass * GRAVITY / slope)];
    close(&braking["skids"][0]["time"], times[0], 1e-9);
    close(&braking["skids"][1]["time"], times[1], 1e-9);
    close(&braking["time"], times[0] + times[1] + 1.5, 1e-9);
    close(&braking["reaction_distance"], 1.5 * start, 1e-12);
    close(&braking["distance"], 20.0 + 1.5 * start, 1e-12);
    assert!(answer["vehicles"][1].get("braking").is_none());
    let text = run_with_input(&["solve", "-"], &case).out;
    for (what, unit, value) in
        [("speed at its start", "m/s", "21.69"), ("distance to the impact", "m", "52.53"), ("time to the impact", "s", "2.605")]
    {
        assert!(text.lines().any(|line| line.contains(what) && line.contains(unit) && line.contains(value)), "{what} {value}: {text}");
    }
    // The derivative by the friction of the first skid is g L / v.
    let gradient = json_of(&["gradient", "--of", "before.vehicle.1.braking_speed", "--wrt", "before.vehicle.1.skid.1.friction"], &case);
    let slope = &gradient["of"]["before.vehicle.1.braking_speed"]["d"]["before.vehicle.1.skid.1.friction"];
    close(slope, GRAVITY * 14.0 / start, 1e-12);
    let uncertain = json_of(&["uncertainty", "--of", "before.vehicle.1.braking_speed", "--method", "linear"], &case);
    close(&uncertain["of"]["before.vehicle.1.braking_speed"]["linear"]["sd"], 0.05 * GRAVITY * 14.0 / start, 1e-12);
}

/// Percentages without their sign.
#[test]
fn no_road_has_the_friction_or_the_grade_of_a_skid() {
    let with = |old: &str, new: &str| run_with_input(&["solve", "-"], &(example("slide.toml") + &SKIDS.replacen(old, new, 1)));
    for (old, new, words) in [
        ("friction = 0.45", "friction = 45", "skid.2.friction: it is 45; it must be from 0 to 10"),
        ("grade = \"2 %\"", "grade = 2", "skid.2.grade: it is 2; it must be from -1 to 1"),
        ("grade = \"2 %\"", "grade = -1.1", "skid.2.grade: it is -1.1; it must be from -1 to 1"),
        ("reaction_time = \"1.5 s\"", "reaction_time = 1500", "reaction_time: it is 1500 s; it must be at most 60 s"),
        ("skid = [", "skid = {} #", "list them in [ ]: skid = [{ ... }]"),
    ] {
        let run = with(old, new);
        assert!(run.status == 2 && run.err.contains(words), "{new}: {}", run.err);
    }
    for (old, new) in [("friction = 0.45", "friction = 10"), ("grade = \"2 %\"", "grade = 1"), ("grade = \"2 %\"", "grade = -0.3")] {
        assert_eq!(with(old, new).status, 0, "{new}");
    }
}

/// v = √(2 μ g L) is from that of the least friction to that of the greatest, and its distribution is not normal.
#[test]
fn a_uniform_friction_of_skids_has_limits() {
    let case = |friction: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = \"1500 kg\"\nheading = \"0 deg\"\n[[vehicle]]\nmass = \"1200 kg\"\nheading = \"90 deg\"\n[contact]\nmodel = \"momentum\"\n\
             [before.vehicle.1]\nskid = [{{ length = \"20 m\", friction = {friction} }}]\n[evidence]\n\
             vehicle.1.separation_velocity = [\"6 m/s ± 0.5 m/s\", \"7 m/s ± 0.5 m/s\"]\nvehicle.2.separation_velocity = [\"5 m/s ± 0.5 m/s\", \"8 m/s ± 0.5 m/s\"]\n\
             [unknown]\nvehicle.1.speed = {{ start = \"30 mph\", min = \"0 mph\" }}\nvehicle.2.speed = {{ start = \"30 mph\", min = \"0 mph\" }}\n"
        )
    };
    let [low, high] = [0.3, 0.9].map(|friction: f64| (2.0 * friction * GRAVITY * 20.0).sqrt());
    let skid = |answer: &Value| answer["unknown"]["before.vehicle.1.skid_speed"]["interval"].clone();
    let notes = |answer: &Value| answer["messages"].to_string().matches("shape-approximated").count();
    // A normal prior is taken within the limits, and a note says so.
    let uniform = json_of(&["reconstruct", "--level", "0.9999"], &case("{ min = 0.3, max = 0.9 }"));
    close(&skid(&uniform)["low"], low, 1e-6);
    close(&skid(&uniform)["high"], high, 1e-6);
    let triangular = json_of(&["reconstruct", "--level", "0.9999"], &case("{ min = 0.3, mode = 0.6, max = 0.9 }"));
    assert!(number(&skid(&triangular)["low"]) > low - 1e-6 && number(&skid(&triangular)["high"]) < high + 1e-6, "{triangular}");
    let normal = json_of(&["reconstruct", "--level", "0.9999"], &case("\"0.6 ± 0.17\""));
    assert!(number(&skid(&normal)["low"]) < low && number(&skid(&normal)["high"]) > high, "{normal}");
    assert_eq!([notes(&uniform), notes(&triangular), notes(&normal)], [1, 1, 0]);
    // Of ± 31 % of a friction the speed has half.
    let bends = |friction: &str| json_of(&["reconstruct"], &case(friction))["messages"].to_string().matches("skid-bends").count();
    assert_eq!(["\"0.6 ± 0.17\"", "\"0.6 ± 0.186\"", "0.6"].map(bends), [0, 1, 0]);
}

/// Standard deviation of the place at rest, in m.
const SIGMA: f64 = 0.3;

/// Returns the case of a vehicle that ran into one that stood, and slid straight to rest on locked wheels.
fn slid_to_rest(end: f64, across: f64) -> String {
    format!(
        "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 0\nimpact_center = [1.9, 0]\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\n\
             heading = 0\nimpact_center = [-1.9, 0]\nspeed = 0\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n[scene]\nimpact_point = [1.9, 0]\n[rest]\n\
             friction = 0.7\n[rest.vehicle.1]\nposition = [\"{end} m ± {SIGMA} m\", \"{across} m ± {SIGMA} m\"]\nheading = \"0 deg ± 3 deg\"\n\
             front_axle = 1.2\nrear_axle = 1.5\ntrack = 1.5\nwheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", \
             rear_right = \"locked\" }}\n[unknown]\nvehicle.1.speed = {{ start = 10, min = 0, max = 60 }}\n"
    )
}

/// Returns the case of a vehicle against a barrier, whose crush of 20 cm has some depths, each with the same deviation in cm.
fn crushed(depths: usize, sd: f64, correlations: &str) -> String {
    let depths = vec![format!("\"20 cm ± {sd} cm\""); depths].join(", ");
    format!(
        "schema = 1\ncorrelation = [{correlations}]\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n[vehicle.crush]\nwidth = 1.5\n\
         depths = [{depths}]\nstiffness = {{ A = 1, B = 9e5 }}\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n[evidence]\n\
         crush_energy = \"from crush\"\n[unknown]\nvehicle.1.speed = 10\n"
    )
}

/// By hand: the energy is k C² of a depth C, so that the speed grows with C and its interval has the depths within 1.96 standard deviations, to the fraction of the
/// stiffness A, and to that of the correlation.
#[test]
fn an_interval_by_the_crush_has_the_errors_of_the_depths() {
    for sd in [1.0, 5.0, 8.0] {
        let answer = json_of(&["reconstruct"], &crushed(2, sd, "[\"vehicle.1.crush.depths.1\", \"vehicle.1.crush.depths.2\", 0.999]"));
        let speed = &answer["unknown"]["vehicle.1.speed"];
        let share = |key: &str| speed["interval"][key].as_f64().expect("a bound") / speed["value"].as_f64().expect("a speed");
        let wanted = [-1.0, 1.0].map(|sign| 1.0 + sign * 1.96 * sd / 20.0);
        let found = ["low", "high"].map(share);
        assert!(wanted.iter().zip(found).all(|(wanted, found)| (wanted - found).abs() < 2e-3), "{sd}: {found:?}, not {wanted:?}");
    }
}

/// On locked wheels every speed grows with the root of the friction, so that rest positions that disagree say nothing of it: an uncertain friction widens the intervals of the
/// speeds, and moves none of them.
#[test]
fn an_uncertain_friction_of_ways_to_rest_moves_no_speed() {
    let locked = "front_axle = 1.15\nrear_axle = 1.5\ntrack = 1.5\nwheels = { front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }\n";
    let case = |friction: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1450\nyaw_inertia = 2600\nheading = \"2 deg\"\nimpact_center = [1.85, -0.1]\n[[vehicle]]\nmass = 1180\nyaw_inertia = 1900\n\
             heading = \"125 deg\"\nimpact_center = [1.6, 0]\n[contact]\ncrush_plane = \"-5 deg\"\n[rest]\nfriction = {friction}\n[rest.vehicle.1]\n\
             position = [\"2.8 m ± 0.3 m\", \"0.8 m ± 0.3 m\"]\nheading = \"69 deg ± 5 deg\"\n{locked}[rest.vehicle.2]\n\
             position = [\"1.7 m ± 0.3 m\", \"1.3 m ± 0.3 m\"]\nheading = \"33 deg ± 5 deg\"\n{locked}[unknown]\n\
             vehicle.1.speed = {{ start = 12, min = 0 }}\nvehicle.2.speed = {{ start = 10, min = 0 }}\ncontact.restitution = {{ start = 0.1, min = 0, max = 0.3 }}\n"
        )
    };
    let of = |friction: &str| {
        let answer = json_of(&["reconstruct"], &case(friction));
        let number = |value: &Value| value.as_f64().expect("a number");
        let speeds = [1, 2].map(|i| answer["unknown"][format!("vehicle.{i}.speed")].clone());
        let interval = |speed: &Value| ["low", "high"].map(|end| number(&speed["interval"][end]));
        (speeds.each_ref().map(|speed| number(&speed["value"])), speeds.each_ref().map(interval), number(&answer["chi_square"]))
    };
    // The middle of the draws is that of the friction, and not that of the motions which have the smallest errors; a density that is uniform in the speed moves it by a fiftieth.
    let medians = |friction: &str| {
        let answer = json_of(&["reconstruct", "--posterior"], &case(friction));
        assert!(!answer["messages"].to_string().contains("posterior-friction"));
        [1, 2].map(|i| answer["unknown"][format!("vehicle.{i}.speed")]["posterior"]["median"].as_f64().expect("a median"))
    };
    let [exact, wide] = ["0.65", "\"0.65 ± 0.13\""].map(medians);
    assert!(exact.iter().zip(wide).all(|(exact, wide)| (wide / exact - 1.0).abs() < 0.025), "{exact:?} and {wide:?}");
    let (speeds, intervals, chi_square) = of("0.65");
    let (same, wider, same_chi_square) = of("\"0.65 ± 0.13\"");
    assert!((chi_square - same_chi_square).abs() < 0.02 * chi_square && chi_square > 1.0, "{chi_square} and {same_chi_square}");
    for i in 0..2 {
        assert!((speeds[i] - same[i]).abs() < 0.005 * speeds[i], "{speeds:?} and {same:?}");
        // By hand: the root of a friction within 1.96 standard deviations of a fifth, and what the rest positions leave open.
        for (end, friction) in [(0, 1.0 - 1.96 * 0.2), (1, 1.0 + 1.96 * 0.2)] {
            let open = intervals[i][end] / speeds[i] - 1.0;
            let wanted = f64::sqrt(friction) - 1.0;
            let found = wider[i][end] / speeds[i] - 1.0;
            assert!((found.abs() - open.hypot(wanted)).abs() < 0.03, "{i} {end}: {found}, not {wanted} and {open}");
        }
    }
}

/// Independent errors of several depths add to the mean of their squares, and a way to rest of some tens of centimeters tells little if it is known to as many.
#[test]
fn what_is_too_uncertain_for_its_first_order_is_told() {
    let count = |case: &str, code: &str| json_of(&["reconstruct"], case)["messages"].to_string().matches(&format!("\"{code}\"")).count();
    // By hand: between depths a and b the energy is k (a² + ab + b²)/3. Of two its derivatives are k C each, and its second ones by each 2 k/3: with s = σ/C the excess of
    // the energy is 2/3 k C² s², that of its root 1/2 less, and the standard deviation √2 k C² s: a quarter of it at s = 2.1.
    assert_eq!([1.0, 5.0, 9.9].map(|sd| count(&crushed(2, sd, ""), "crush-bends")), [0, 0, 0]);
    // Of six the derivatives are 0.2 k C, at the ends, and 0.4 k C: the excess is (2/3 - 0.18) k C² s², the standard deviation √0.72 k C² s, and the quarter at s = 0.436.
    assert_eq!([8.6, 8.8, 9.9].map(|sd| count(&crushed(6, sd, ""), "crush-bends")), [0, 1, 1]);
    let warned = json_of(&["reconstruct"], &crushed(6, 9.9, ""))["messages"].to_string();
    assert!(warned.contains("more than that of the crush without its errors: intervals may lie too high"), "{warned}");
    let rest = |way: f64| slid_to_rest(way, 0.0);
    // Of locked wheels by the way, of others to first order.
    assert_eq!([6.0, 0.6, 0.3].map(|way| count(&rest(way), "slide-short")), [0, 0, 1]);
    assert_eq!([6.0, 0.6].map(|way| count(&rest(way).replacen("\"locked\"", "{ braking = 0.9 }", 1), "slide-short")), [0, 1]);
}

/// Evidence that a slide to rest contradicts: by the program's own chi-square, which takes a short way, or one on wheels that roll and no fit is reached about, to first order.
#[test]
fn a_contradiction_by_a_slide_is_told_and_no_slip_is_named() {
    let codes = |way: f64, wheels: &str, delta_v: f64| {
        let evidence = format!("[evidence]\nvehicle.1.delta_v_magnitude = \"{delta_v} m/s ± 0.3 m/s\"\n[unknown]");
        let case = slid_to_rest(way, 0.0).replace("\"locked\"", wheels).replace("[unknown]", &evidence);
        let run = run_with_input(&["reconstruct", "-", "--starts", "4", "--format", "json"], &case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error}: {}", run.err));
        let count = |code: &str| answer["messages"].to_string().matches(&format!("\"{code}\"")).count();
        let is_contradicted = answer["verdict"] == "contradicted";
        (is_contradicted, count("contradiction-by-slide"), count("possible-slip") > 0, count("slide-bends"))
    };
    let (locked, braked) = ("\"locked\"", "{ braking = 0.5 }");
    assert_eq!(codes(1.0, locked, 6.0), (false, 0, false, 0));
    // Within twice of what chance explains, and beyond.
    assert_eq!(codes(1.0, locked, 7.5), (true, 1, false, 0));
    assert_eq!(codes(1.0, locked, 8.0), (true, 0, true, 0));
    // A long way on locked wheels is its own.
    assert_eq!(codes(6.0, locked, 14.0), (true, 0, false, 0));
    // One on wheels that roll is taken about the fit, where a fit is reached.
    assert_eq!(codes(6.0, braked, 9.0), (false, 0, false, 0));
    assert_eq!(codes(6.0, braked, 11.0), (true, 1, false, 1));
}

/// By hand: on locked wheels a straight way is v²/(2 μ g), so that the interval of the speed has the ways within 1.96 standard deviations of the place at rest, and
/// about a standstill those that a vehicle which only goes forward fits as well. Errors across it say nothing.
#[test]
fn the_interval_of_a_short_slide_is_that_of_its_way() {
    // Where it separated it has no way.
    let refused = run_with_input(&["reconstruct", "-"], &slid_to_rest(0.0, 0.0));
    assert!(
        refused.status == 2
            && flat(&refused.err).contains("the vehicle moved 0.000 m, no further than the position at rest is uncertain, 0.300 m"),
        "{}",
        refused.err
    );
    // From the crash: half of 1 − e is left of the speed.
    let speed = |way: f64| (2.0 * 0.7 * GRAVITY * way).sqrt() / 0.45;
    for end in [-0.5_f64, -0.2, 0.05, 0.2, 0.45, 0.9] {
        for across in [0.0, 0.4] {
            let found = json_of(&["reconstruct", "--guaranteed"], &slid_to_rest(end, across))["unknown"]["vehicle.1.speed"].clone();
            let interval = &found["interval"];
            let best = end.max(0.0);
            let reach = (1.959964_f64.powi(2) + ((end - best) / SIGMA).powi(2)).sqrt() * SIGMA;
            let wanted = [end - reach, end + reach].map(|way| speed(way.max(0.0)));
            for (end, wanted) in ["low", "high"].into_iter().zip(wanted) {
                assert!((number(&interval[end]) - wanted).abs() < 0.02 * speed(SIGMA), "{interval} for {wanted} at {across}");
            }
            // Outside of three standard deviations nothing is looked for.
            if across == 0.0 {
                let way = |end: &str| (0.45 * number(&found["guaranteed"][end])).powi(2) / (2.0 * 0.7 * GRAVITY);
                for (side, wanted) in [("low", end - 3.0 * SIGMA), ("high", end + 3.0 * SIGMA)] {
                    assert!((way(side) - wanted.max(0.0)).abs() < 0.02 * SIGMA, "{} for {wanted}", way(side));
                }
            }
        }
    }
}

/// A known speed at the start of the skids is evidence of that at the impact.
#[test]
fn a_speed_before_the_skids_gives_that_at_the_impact() {
    let unknown = example("slide.toml").replace("speed = \"55 km/h\"\n", "") + SKIDS;
    let case = unknown.replace(" ± 0.05", "")
        + "[evidence]\nbefore.vehicle.1.braking_speed = \"80 km/h ± 2 km/h\"\n[unknown]\nvehicle.1.speed = \"50 km/h\"\n";
    let case = case.split("[rest]").next().expect("a case").to_owned() + &case[case.find("[before").expect("skids")..];
    let answer = json_of(&["reconstruct"], &case);
    let lost = 2.0 * GRAVITY * (0.7 * 14.0 + 0.38 * 6.0);
    let speed = ((80.0 / 3.6_f64).powi(2) - lost).sqrt();
    close(&answer["unknown"]["vehicle.1.speed"]["value"], speed, 1e-9);
    close(&answer["unknown"]["vehicle.1.speed"]["sd"], 2.0 / 3.6 * (80.0 / 3.6) / speed, 1e-9);
}

/// One road has one friction: with its correlation the variance of the speed before the braking is that of the changes which the friction makes by the skid and by the
/// slide, together. The three numbers of an impact on a barrier are determined by the three of its separation.
#[test]
fn the_friction_of_the_skids_may_be_that_of_the_rest_position() {
    let of = |rest: &str, skid: &str, top: &str| {
        let case = format!(
            "schema = 1\n{top}\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0.5]\n[[vehicle]]\nbarrier = true\n\
             [contact]\ncrush_plane = \"60 deg\"\nimpulse_ratio = {{ of_critical = 0.8 }}\n\
             [rest]\nfriction = {rest}\n[rest.vehicle.1]\nposition = [\"2.581 m ± 0.02 m\", \"-1.648 m ± 0.02 m\"]\nheading = \"-25.5 deg ± 0.2 deg\"\n\
             front_axle = 1.2\nrear_axle = 1.4\ntrack = 1.5\n\
             wheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }}\n\
             [before.vehicle.1]\nskid = [{{ length = \"17 m\", friction = {skid} }}]\n\
             [unknown]\nvehicle.1.speed = 15\ncontact.restitution = 0.2\ncontact.impulse_ratio.of_critical = 0.8\n"
        );
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &case);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let speed = &answer["derived"]["before.vehicle.1.braking_speed"];
        let codes = answer["messages"].to_string();
        (number(&speed["value"]), number(&speed["sd"]).powi(2), codes.contains("independent-frictions"))
    };
    let half = |more: (f64, f64, bool), less: (f64, f64, bool)| (more.0 - less.0) / 2.0;
    let by_rest = half(of("0.61", "0.7", ""), of("0.59", "0.7", ""));
    let by_skid = half(of("0.6", "0.71", ""), of("0.6", "0.69", ""));
    let certain = of("0.6", "0.7", "").1;
    for coefficient in [-0.9, 0.5, 0.999] {
        let pair = format!("correlation = [[\"before.vehicle.1.skid.1.friction\", \"rest.friction\", {coefficient}]]");
        let (_, variance, is_noted) = of("\"0.6 ± 0.01\"", "\"0.7 ± 0.01\"", &pair);
        let by_hand = certain + by_rest * by_rest + by_skid * by_skid + 2.0 * coefficient * by_rest * by_skid;
        assert!(!is_noted && (variance / by_hand - 1.0).abs() < 2e-3, "{coefficient}: {variance} {by_hand}");
    }
    let (_, variance, is_noted) = of("\"0.6 ± 0.01\"", "\"0.7 ± 0.01\"", "");
    assert!(is_noted && (variance / (certain + by_rest * by_rest + by_skid * by_skid) - 1.0).abs() < 2e-3);
    assert!(by_rest * by_skid > 0.1 * certain, "what is shared matters: {by_rest} {by_skid} {certain}");
}

/// The slide of a braked vehicle without yaw is that of a block: v²/(2 μ g) in v/(μ g).
#[test]
fn a_straight_slide_is_that_of_a_block() {
    let case = "schema = 1\n\
        [[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 15\nimpact_center = [2, 0]\n\
        [[vehicle]]\nmass = 1200\nyaw_inertia = 2000\nheading = 0\nspeed = 5\nimpact_center = [-2, 0]\n\
        [contact]\ncrush_plane = 0\nrestitution = 0.2\n\
        [scene]\nimpact_point = [10, -3]\n\
        [rest]\nfriction = 0.6\n\
        [rest.vehicle.1]\nfront_axle = 1.2\nrear_axle = 1.4\ntrack = 1.5\n\
        wheels = { front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }\n";
    let (solved, slid) = (json_of(&["solve"], case), json_of(&["slide"], case));
    let says_where = |slid: &Value| slid.to_string().contains("places are counted from where each vehicle separated");
    assert!(!says_where(&slid) && says_where(&json_of(&["slide"], &case.replace("[scene]\nimpact_point = [10, -3]\n", ""))));
    let speed = number(&solved["vehicles"][0]["velocity"][0]);
    let (distance, time) = (speed * speed / (2.0 * 0.6 * GRAVITY), speed / (0.6 * GRAVITY));
    let [vehicle] = &slid["vehicles"].as_array().expect("a list")[..] else { panic!("one vehicle has wheels") };
    assert_eq!((&vehicle["vehicle"], &vehicle["separation_from"]), (&Value::from(1), &Value::from("solve")));
    close(&vehicle["rest"]["position"][0], 10.0 - 2.0 + distance, 1e-5);
    close(&vehicle["rest"]["position"][1], -3.0, 1e-9);
    close(&vehicle["distance"], distance, 1e-5);
    // Tires that hardly slip any more brake less: the last centimeters take a little longer.
    close(&vehicle["time"], time, 1e-3);
    let path = vehicle["path"].as_array().expect("states");
    let (first, last) = (&path[0], &path[path.len() - 1]);
    close(&first["vx"], speed, 1e-12);
    close(&first["x"], 8.0, 1e-12);
    assert_eq!(first["wheels"], serde_json::json!([[9.2, -2.25], [9.2, -3.75], [6.6, -2.25], [6.6, -3.75]]));
    assert_eq!((&last["vx"], &last["vy"], &last["yaw_rate"]), (&Value::from(0.0), &Value::from(0.0), &Value::from(0.0)));
    assert_eq!((&last["x"], &last["t"]), (&vehicle["rest"]["position"][0], &vehicle["time"]));
    // Halfway through, by energy.
    let state = &path[path.len() / 2];
    let left = speed * speed - 2.0 * 0.6 * GRAVITY * (number(&state["x"]) - 8.0);
    close(&state["vx"], left.sqrt(), 1e-3);
    // A vehicle that separates as the evidence says needs no impact.
    let given = case.replace("speed = 15\n", "").replace("[scene]", "[evidence]\nvehicle.1.separation_velocity = [\"6 m/s\", \"0 m/s\"]\nvehicle.1.separation_yaw_rate = 0\n[unknown]\nvehicle.1.speed = 10\n[scene]");
    let given = json_of(&["slide"], &given);
    assert_eq!(given["vehicles"][0]["separation_from"], "given");
    close(&given["vehicles"][0]["distance"], 36.0 / (1.2 * GRAVITY), 1e-4);
}

/// The forward slide ends where the inverse began, and the scene moves every place alike.
#[test]
fn the_slide_forward_is_the_inverse_of_the_slide_back() {
    let case = example("slide.toml");
    let slid = json_of(&["slide"], &case);
    let solved = json_of(&["solve"], &case);
    let text = run_with_input(&["slide", "-"], &case).out;
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let mut back = case.replace("speed = \"55 km/h\"\n", "").replace("speed = \"30 km/h\"\n", "");
    for (i, table) in ["[rest.vehicle.1]\n", "[rest.vehicle.2]\n"].into_iter().enumerate() {
        let rest = &slid["vehicles"][i]["rest"];
        let [x, y] = [0, 1].map(|k| number(&rest["position"][k]));
        let heading = number(&rest["heading"]);
        let pose = format!("position = [\"{x} m ± 0.3 m\", \"{y} m ± 0.3 m\"]\nheading = \"{heading} rad ± 0.05 rad\"\n");
        back = back.replace(table, &format!("{table}{pose}"));
    }
    let back = back + "[unknown]\nvehicle.1.speed = \"40 km/h\"\nvehicle.2.speed = \"40 km/h\"\n";
    let found = run_with_input(&["reconstruct", "-", "--format", "json"], &back);
    let found: Value = serde_json::from_str(&found.out).expect("JSON");
    close(&found["unknown"]["vehicle.1.speed"]["value"], 55.0 / 3.6, 1e-6);
    close(&found["unknown"]["vehicle.2.speed"]["value"], 30.0 / 3.6, 1e-6);
    for (i, axis) in [(0, "x"), (0, "y"), (1, "x"), (1, "y")] {
        let given = &found["evidence"][format!("vehicle.{}.separation_velocity.{axis}", i + 1)]["given"];
        close(given, number(&solved["vehicles"][i]["velocity"][usize::from(axis == "y")]), 1e-6);
    }
    // With the rest poses in the file, `slide` says how far it misses them; another scene misses them by its shift.
    let known =
        case.replace("[rest.vehicle.1]\n", "[rest.vehicle.1]\nposition = [\"1 m ± 1 m\", \"2 m ± 1 m\"]\nheading = \"3 rad ± 1 rad\"\n");
    let shifted = known.replace("[\"12.3 m\", \"4.1 m\"]", "[\"13.3 m\", \"2.1 m\"]").replace("[\"0 m\", \"6 m\"]", "[\"0 m\", \"4 m\"]");
    let shifted = &json_of(&["slide"], &shifted)["vehicles"][0];
    let rest = &slid["vehicles"][0]["rest"];
    close(&shifted["miss"]["position"][0], number(&rest["position"][0]) + 1.0 - 1.0, 1e-6);
    close(&shifted["miss"]["position"][1], number(&rest["position"][1]) - 2.0 - 2.0, 1e-6);
    close(&shifted["miss"]["heading"], number(&rest["heading"]) - 3.0, 1e-6);
}

/// `slide` begins with a motion that the evidence gives whole; `draw` shows the solved impact. Each says what it does not use.
#[test]
fn a_motion_at_separation_that_is_not_used_is_told() {
    let case = example("slide.toml");
    let velocity = "vehicle.1.separation_velocity = [\"5 m/s ± 0.2 m/s\", \"4 m/s ± 0.2 m/s\"]\n";
    let of = |verb: &[&str], evidence: &str| json_of(verb, &case.replace("[scene]", &format!("[evidence]\n{evidence}\n[scene]")));
    let yaw_rate = "vehicle.1.separation_yaw_rate = \"60 deg/s ± 5 deg/s\"";
    let draw = ["draw"];
    for (evidence, from, of_slide, of_draw) in [
        (velocity.to_owned() + yaw_rate, "given", false, true),
        (velocity.to_owned(), "solve", true, false),
        (String::new(), "solve", false, false),
    ] {
        let (slid, drawn) = (of(&["slide"], &evidence), of(&draw, &evidence));
        assert_eq!(slid["vehicles"][0]["separation_from"], from);
        assert_eq!(slid["messages"].to_string().contains("incomplete-motion"), of_slide, "{}", slid["messages"]);
        assert_eq!(drawn["messages"].to_string().contains("evidence-not-drawn"), of_draw, "{}", drawn["messages"]);
    }
    let method = |name: &str| case.replace("[rest.vehicle.2]\n", &format!("[rest.vehicle.2]\nmethod = \"{name}\"\n"));
    for (name, is_told) in [("closed-form", true), ("slide", false)] {
        let messages = json_of(&["slide"], &method(name))["messages"].to_string();
        assert_eq!(messages.contains("method-not-used") && messages.contains("rest.vehicle.2.method"), is_told, "{messages}");
    }
}

#[test]
fn a_slide_as_csv_has_every_state() {
    let path = "cli/examples/slide.toml";
    let (csv, json) =
        (run(&workspace(), &["slide", path, "--format", "csv", "--units", "us"]), json_of(&["slide"], &example("slide.toml")));
    assert_eq!((csv.status, csv.err.as_str()), (0, ""));
    let rows: Vec<Vec<&str>> = csv.out.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["vehicle", "t [s]", "x [ft]", "y [ft]", "heading [deg]"]);
    assert_eq!(rows[0][14..], ["rear_right.x [ft]", "rear_right.y [ft]"]);
    let mut rows = rows[1..].iter();
    for vehicle in json["vehicles"].as_array().expect("a list") {
        for state in vehicle["path"].as_array().expect("states") {
            let row: Vec<f64> = rows.next().expect("a row").iter().map(|cell| cell.parse().expect("a number")).collect();
            close(&Value::from(row[0]), number(&vehicle["vehicle"]), 0.0);
            close(&Value::from(row[2] * FOOT), number(&state["x"]), 1e-12);
            close(&Value::from(row[4].to_radians()), number(&state["heading"]), 1e-12);
            close(&Value::from(row[7].to_radians()), number(&state["yaw_rate"]), 1e-12);
            close(&Value::from(row[15] * FOOT), number(&state["wheels"][3][1]), 1e-12);
        }
    }
    assert!(rows.next().is_none());
}

#[test]
fn casework_that_cannot_be_used_is_refused_at_its_place() {
    let momentum = example("reconstruct/momentum.toml");
    let slide = example("slide.toml");
    let skids = |skid: &str| format!("{}\n[before.vehicle.1]\nskid = [{skid}]\n", slide.trim_end());
    let barrier = "[[vehicle]]\nname = \"wall\"\nbarrier = true\n\n[contact]";
    let bad: [(&str, String, i32, &[&str]); 17] = [
        ("solve", momentum.clone(), 2, &["contact.model", "momentum alone does not determine how the vehicles separate", "planar-impact reconstruct"]),
        ("gradient", momentum.clone(), 2, &["contact.model"]),
        ("uncertainty", momentum.clone(), 2, &["contact.model"]),
        ("slide", momentum.clone(), 2, &["missing: the ground and the wheels"]),
        ("reconstruct", momentum.replace("\"momentum\"", "\"magic\""), 2, &["contact.model", "\"momentum\""]),
        ("reconstruct", momentum.replace("model = \"momentum\"", "modle = \"momentum\""), 2, &["did you mean `model`"]),
        ("reconstruct", momentum.replace("[evidence]\n", "[evidence]\ncrush_energy = \"50 kJ\"\n"), 2, &["evidence.crush_energy", "momentum alone says nothing of crush_energy"]),
        ("reconstruct", momentum.replace("[[vehicle]]\nname = \"northbound\"\nmass = \"3875 lb\"\nheading = \"90 deg\"\n\n[contact]", barrier).replace("vehicle.2.separation", "vehicle.1.separation_yaw_rate = 1\n#").replace("vehicle.2.speed", "#"), 2, &["momentum alone needs two vehicles"]),
        ("reconstruct", momentum.replace("[before.vehicle.1]", "[rest]\nfriction = 0.7\n[rest.vehicle.1]\nposition = [\"1 m ± 1 m\", \"2 m ± 1 m\"]\nheading = \"3 rad ± 1 rad\"\nfront_axle = 1\nrear_axle = 1\ntrack = 1\nwheels = { front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }\n[before.vehicle.1]"), 2, &["rest.vehicle.1", "needs its yaw inertia"]),
        ("solve", skids("{ length = \"14 m\", friction = 0.01, grade = -0.02 }"), 2, &["before.vehicle.1.skid.1", "does not slow down", "-0.01"]),
        ("solve", skids("{ length = \"0 m\", friction = 0.7 }, { length = \"14 m\", friction = -1, braking = 1.5 }"), 2, &["skid.1.length", "above zero", "skid.2.friction", "skid.2.braking", "from 0 to 1"]),
        ("solve", skids("{ length = \"14 kg\", friction = 0.7, surface = \"wet\" }"), 2, &["skid.1.length", "a length is expected", "skid.1.surface: unknown key"]),
        ("solve", skids(""), 2, &["before.vehicle.1.skid", "expected 1 to 32"]),
        ("solve", slide.clone() + "\n[before.vehicle.3]\nskid = []\n", 2, &["before.vehicle.3: unknown key"]),
        ("solve", skids("{ length = 1, friction = 0.7 }") + "reaction_time = \"-1 s\"\n", 2, &["reaction_time", "below zero"]),
        ("slide", slide.replace("[\"12.3 m\", \"4.1 m\"]", "[\"12.3 m\"]"), 2, &["scene.impact_point"]),
        ("reconstruct", slide.replace("speed = \"55 km/h\"\n", "") + "[unknown]\nvehicle.1.speed = 10\n", 2, &["rest.vehicle.1", "missing: where it came to rest"]),
    ];
    for (verb, case, status, words) in bad {
        let folder = Folder::new();
        let path = folder.write("case.toml", case.as_bytes());
        let run = run(&workspace(), &[verb, path.to_str().expect("a plain path")]);
        assert_eq!((run.status, run.out.as_str()), (status, ""), "{verb} {words:?}: {}", run.err);
        let text = flat(&run.err);
        for word in words {
            assert!(text.contains(word), "{word}: {}", run.err);
        }
        assert!(text.contains("case.toml"), "it has a place: {}", run.err);
    }
}

/// A table cannot take its contact from a case without one.
#[test]
fn momentum_is_no_case_of_a_table() {
    let table = "cli/examples/batch/speeds.csv";
    let run = run(&workspace(), &["batch", table, "--case", "cli/examples/reconstruct/momentum.toml", "-o", "-"]);
    assert_eq!((run.status, run.out.as_str()), (2, ""));
    assert!(flat(&run.err).contains("contact.model: momentum alone does not determine how the vehicles separate"), "{}", run.err);
}

/// Momentum alone says nothing of a crush plane, and its picture shows none.
#[test]
fn a_picture_of_momentum_has_no_crush_plane() {
    let drawn = |case: &str| {
        let call = |format| run_with_input(&["draw", "-", "--format", format], &example(case));
        let (svg, json) = (call("svg"), call("json"));
        assert_eq!((svg.status, json.status), (0, 0), "{} {}", svg.err, json.err);
        let json: Value = serde_json::from_str(&json.out).expect("JSON");
        (svg.out.matches("rush plane").count(), svg.out.contains("Γ"), json["crush_plane"].is_null())
    };
    assert_eq!(drawn("reconstruct/momentum.toml"), (0, false, true));
    assert_eq!(drawn("reconstruct/t-bone.toml"), (3, true, false));
}
