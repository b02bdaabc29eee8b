//! Slides on a grade, points along the path, and several separations that lead to one rest position.

use serde_json::{Value, json};

use crate::process::{Run, run_with_input, workspace};

const GRAVITY: f64 = 9.80665;

/// A block of four locked wheels on the ground that `rest` describes, which separates along x at 6 m/s.
fn block(rest: &str, of_vehicle: &str) -> String {
    format!(
        "schema = 1\n\
         [[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n\
         [[vehicle]]\nmass = 1200\nyaw_inertia = 2000\nheading = 0\nspeed = 5\nimpact_center = [-2, 0]\n\
         [contact]\ncrush_plane = 0\nrestitution = 0.2\n\
         [evidence]\nvehicle.1.separation_velocity = [\"6 m/s\", \"0 m/s\"]\nvehicle.1.separation_yaw_rate = 0\n\
         [unknown]\nvehicle.1.speed = 10\n\
         [rest]\n{rest}\n\
         [rest.vehicle.1]\nfront_axle = 1.2\nrear_axle = 1.4\ntrack = 1.5\n{of_vehicle}\n\
         wheels = {{ front_left = \"locked\", front_right = \"locked\", rear_left = \"locked\", rear_right = \"locked\" }}\n"
    )
}

/// Reconstructs the block from where it came to rest, without other evidence.
fn from_rest_alone(friction: &str, of_vehicle: &str, status: i32) -> Value {
    let case = block(&format!("friction = {friction}"), of_vehicle);
    let (before, after) = case.split_once("[evidence]\n").expect("evidence");
    let (_, rest) = after.split_once("[unknown]").expect("an unknown");
    printed(&run_with_input(&["reconstruct", "-", "--format", "json"], &format!("{before}[unknown]{rest}")), status)
}

fn printed(run: &Run, status: i32) -> Value {
    assert_eq!((run.status, run.err.as_str()), (status, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn close(found: &Value, wanted: f64, within: f64) {
    assert!((number(found) - wanted).abs() <= within, "{found}, not {wanted}");
}

fn slid(case: &str) -> Value {
    printed(&run_with_input(&["slide", "-", "--format", "json"], case), 0)["vehicles"][0].clone()
}

/// By hand: v²/(2 g (μ + G)) with the grade G along the path, and half of it on a region that begins halfway.
#[test]
fn a_grade_shortens_the_slide_uphill_and_lengthens_it_downhill() {
    for (grade, uphill) in [
        ("grade = [\"5 %\", 0]", 0.05),
        ("grade = [-0.05, 0]", -0.05),
        ("grade = { rise = \"5 %\", toward = \"180 deg\" }", -0.05),
        ("grade = { rise = \"5 %\", toward = \"0 deg\" }", 0.05),
        ("regions = [{ friction = 0.6, grade = [0.05, 0], half_plane = { from = [\"-99 m\", 0], toward = 0 } }]", 0.05),
        // A region without a grade has that of the ground.
        ("grade = [0.05, 0]\nregions = [{ friction = 0.6, half_plane = { from = [\"-99 m\", 0], toward = 0 } }]", 0.05),
    ] {
        let vehicle = slid(&block(&format!("friction = 0.6\n{grade}"), ""));
        close(&vehicle["distance"], 36.0 / (2.0 * GRAVITY * (0.6 + uphill)), 1e-4);
        close(&vehicle["rest"]["position"][1], 0.0, 1e-9);
    }
    // Across, it drifts downhill.
    assert!(number(&slid(&block("friction = 0.6\ngrade = [0, 0.05]", ""))["rest"]["position"][1]) < -0.05);
}

#[test]
fn a_vehicle_that_the_grade_takes_away_is_refused() {
    let rolling = block("friction = 0.6\ngrade = [\"3 %\", 0]", "").replace("\"locked\"", "\"rolling\"");
    let refused = run_with_input(&["slide", "-"], &rolling);
    assert_eq!((refused.status, refused.out.as_str()), (3, ""));
    assert!(refused.err.contains("rolls back") && refused.err.contains("rest.vehicle.1"), "{}", refused.err);
    let steep = block(
        "friction = \"0.6 ± 0.05\"\ngrade = { rise = 0.7, toward = 0 }",
        "position = [\"3 m ± 0.3 m\", \"0 m ± 0.3 m\"]\nheading = \"0 deg ± 3 deg\"",
    );
    let refused = run_with_input(&["reconstruct", "-"], &steep);
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    assert!(refused.err.contains("the grade there is steeper than its tires hold"), "{}", refused.err);
}

/// By hand: the block slides straight along x, from the origin to 36/(2 · 0.6 g) = 3.06 m.
#[test]
fn points_beside_the_path_are_off_by_their_distance() {
    let points = "position = [\"3.06 m ± 0.3 m\", \"0 m ± 0.3 m\"]\nheading = \"0 deg ± 3 deg\"\n\
        points = [{ position = [\"1 m ± 0.2 m\", \"0.1 m ± 0.05 m\"] }, { wheel = \"rear_right\", position = [\"0.6 m ± 0.1 m\", \"-0.85 m ± 0.1 m\"] }]";
    let vehicle = slid(&block("friction = 0.6", points));
    let [of_center, of_wheel] = &vehicle["points"].as_array().expect("points")[..] else { panic!("two points") };
    assert_eq!((&of_center["wheel"], &of_wheel["wheel"], &of_center["is_end"]), (&Value::Null, &json!("rear_right"), &json!(false)));
    assert_eq!((&of_center["given"], &of_center["sd"]), (&json!([1.0, 0.1]), &json!([0.2, 0.05])));
    close(&of_center["standardised_residual"], 2.0, 1e-6);
    close(&of_wheel["standardised_residual"], -1.0, 1e-6);
    close(&of_wheel["computed"][0], 0.6, 1e-6);
    close(&of_wheel["computed"][1], -0.75, 1e-6);
    // 1 m = 6 t − ½ 0.6 g t².
    let drag = 0.6 * GRAVITY;
    close(&of_center["time"], (6.0 - (36.0 - 2.0 * drag).sqrt()) / drag, 1e-5);
    let text = run_with_input(&["slide", "-"], &block("friction = 0.6", points)).out;
    assert!(text.contains("2 rear right") && text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let solved = block("friction = 0.6", points)
        .replace("[unknown]\nvehicle.1.speed = 10\n", "")
        .replace("heading = 0\nimpact_center = [2, 0]", "heading = 0\nspeed = 10\nimpact_center = [2, 0]");
    let drawing = run_with_input(&["draw", "-"], &solved);
    assert_eq!(drawing.out.matches("class=\"given-point given-point-1\"").count(), 2, "{}", drawing.err);
    // Places are counted from the separation, and the scene from the impact, 2 m ahead of it.
    let scene = printed(&run_with_input(&["draw", "-", "--format", "json"], &solved), 0);
    let of_scene = &scene["vehicles"][0]["slide"]["points"];
    assert_eq!(of_scene.as_array().map(Vec::len), Some(2));
    close(&of_scene[0]["given"][0], -1.0, 1e-12);
    close(&of_scene[0]["given"][1], 0.1, 1e-12);
    close(&of_scene[1]["computed"][0], 0.6 - 2.0, 1e-6);
}

fn example() -> String {
    std::fs::read_to_string(workspace().join("cli/examples/reconstruct/several-separations.toml")).expect("the example can be read")
}

/// The truth of the example: 75.3 km/h and 60.8 km/h.
#[test]
fn each_separation_is_reconstructed_and_points_decide() {
    let case = example();
    let several = printed(&run_with_input(&["reconstruct", "-", "--format", "json"], &case), 1);
    assert_eq!((&several["verdict"], &several["other_separations"]), (&json!("several solutions"), &json!(true)));
    let others = several["by_other_separations"].as_array().expect("others");
    let speeds = || std::iter::once(&several).chain(others).map(|answer| number(&answer["unknown"]["vehicle.1.speed"]["value"]) * 3.6);
    let codes = |answer: &Value| -> Vec<Value> {
        let messages = answer["messages"].as_array().into_iter().flatten();
        messages
            .map(|message| message["code"].clone())
            .filter(|code| code.as_str().is_some_and(|code| code.contains("separation")))
            .collect()
    };
    assert_eq!(codes(&several), ["separation-from-rest", "first-separation-alone", "other-separations"]);
    assert!(others.len() >= 2 && speeds().any(|speed| (speed - 75.3).abs() < 0.5), "{:?}", speeds().collect::<Vec<_>>());
    for other in others {
        assert_eq!(other["verdict"], "agrees");
        // By hand, from momentum along x: the van alone drove that way.
        let after = number(&other["separations"][0]["velocity"][0]);
        close(&other["unknown"]["vehicle.1.speed"]["value"], after + 9.6 * 1300.0 / 1400.0, 1e-6);
        let interval = &other["unknown"]["vehicle.1.speed"]["interval"];
        assert!(number(&interval["low"]) < number(&interval["high"]), "{interval}");
    }
    let decided = case.replace("#points", "points").replace("#    {", "    {").replace("#]", "]");
    let answer = printed(&run_with_input(&["reconstruct", "-", "--format", "json"], &decided), 0);
    assert_eq!((&answer["verdict"], &answer["other_separations"]), (&json!("agrees"), &json!(false)));
    close(&answer["unknown"]["vehicle.1.speed"]["value"], 75.3 / 3.6, 0.2);
    close(&answer["unknown"]["vehicle.2.speed"]["value"], 60.8 / 3.6, 0.2);
    assert_eq!(codes(&answer), ["separation-from-rest"]);
    let fit = &answer["separations"][0]["fit"];
    assert_eq!((fit["points"].as_array().map(Vec::len), &fit["degrees_of_freedom"]), (Some(4), &json!(4)));
    let residuals = fit["points"].as_array().expect("points").iter().map(|point| number(&point["standardised_residual"]).powi(2));
    let [x, y] = [0, 1].map(|k| number(&fit["position"][k]) / 0.3);
    let heading = number(&fit["heading"]) / 5.0_f64.to_radians();
    close(&fit["chi_square"], residuals.sum::<f64>() + x * x + y * y + heading * heading, 1e-9);
    assert!(number(&fit["chi_square"]) < 4.0 && number(&fit["probability"]) > 0.1, "{fit}");
}

/// A straight slide to x cannot come past a point a meter beside it.
#[test]
fn points_that_no_slide_passes_contradict_the_rest_position() {
    let points = "position = [\"3.06 m ± 0.1 m\", \"0 m ± 0.1 m\"]\nheading = \"0 deg ± 3 deg\"\npoints = [{ position = [\"1 m ± 0.05 m\", \"1 m ± 0.05 m\"] }]";
    let answer = from_rest_alone("\"0.6 ± 0.05\"", points, 1);
    assert_eq!(answer["verdict"], "contradicted");
    let found = answer["messages"].as_array().into_iter().flatten().find(|message| message["code"] == "points-contradict-rest");
    let found = found.unwrap_or_else(|| panic!("{}", answer["messages"]));
    assert!(found["text"].as_str().is_some_and(|text| text.ends_with(" with 1 degree of freedom")), "{found}");
}

/// By hand: v² = 2 μ g d, so the standard deviation of v has half those of μ and of d, as shares.
#[test]
fn the_deviation_of_a_separation_is_that_of_distance_and_friction() {
    let at_rest = "position = [\"3.06 m ± 0.153 m\", \"0 m ± 0.3 m\"]\nheading = \"0 deg ± 3 deg\"";
    let answer = from_rest_alone("\"0.6 ± 0.06\"", at_rest, 0);
    let separation = &answer["separations"][0];
    let speed = (2.0 * 0.6 * GRAVITY * 3.06_f64).sqrt();
    close(&separation["velocity"][0], speed, 1e-4);
    close(&separation["sd"][0], speed * 0.1_f64.hypot(0.05) / 2.0, 1e-4);
}

/// Evidence is normal: any distribution counts by its mean and standard deviation, and says so.
#[test]
fn friction_and_evidence_take_every_form_of_an_uncertain_value() {
    let answer = |friction: &str, speed: &str| {
        let case =
            block(&format!("friction = {friction}"), "position = [\"3.06 m ± 0.3 m\", \"0 m ± 0.3 m\"]\nheading = \"0 deg ± 3 deg\"");
        let (before, after) = case.split_once("[evidence]\n").expect("evidence");
        let (_, rest) = after.split_once("[rest]").expect("a rest");
        let asked = format!("[evidence]\nvehicle.2.speed = {speed}\n[unknown]\nvehicle.1.speed = {{ start = 10, min = 0 }}\n[rest]{rest}");
        let case = format!("{before}{asked}").replace("heading = 0\nspeed = 5\n", "heading = 0\n");
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &case);
        assert!(run.err.is_empty() && run.status < 2, "{}", run.err);
        serde_json::from_str::<Value>(&run.out).expect("JSON")
    };
    let sd = |answer: &Value, name: &str| number(&answer["evidence"][name]["sd"]);
    let plain = answer("\"0.6 ± 0.03\"", "\"5 m/s ± 0.2 m/s\"");
    // By hand: the deviation of what is equally likely is its width over the root of 12, of a triangle over that of 24.
    let (root_12, root_24) = (12_f64.sqrt(), 24_f64.sqrt());
    for (friction, speed, of_speed) in [
        (
            format!("{{ min = {}, max = {} }}", 0.6 - 0.015 * root_12, 0.6 + 0.015 * root_12),
            "{ value = 5, relative = 0.04 }".to_owned(),
            0.2,
        ),
        (format!("{{ min = {}, mode = 0.6, max = {} }}", 0.6 - 0.015 * root_24, 0.6 + 0.015 * root_24), "\"5 m/s ± 4 %\"".to_owned(), 0.2),
        ("{ value = 0.6, relative = 0.05 }".to_owned(), "{ min = \"4 m/s\", max = \"6 m/s\" }".to_owned(), 2.0 / root_12),
        (
            "{ values = [0.5632576538582524, 0.6, 0.6367423461417476] }".to_owned(),
            "{ mean = 5, sd = 0.3, n = 9 }".to_owned(),
            0.1 * (8_f64 / 6.0).sqrt(),
        ),
    ] {
        let found = answer(&friction, &speed);
        close(&found["evidence"]["vehicle.2.speed"]["given"], 5.0, 1e-9);
        assert!((sd(&found, "vehicle.2.speed") - of_speed).abs() < 1e-9, "{speed}: {}", found["evidence"]["vehicle.2.speed"]);
        let of_rest = [&plain, &found].map(|answer| sd(answer, "vehicle.1.separation_velocity.x"));
        assert!((of_rest[0] - of_rest[1]).abs() < 1e-4, "{friction}: {of_rest:?}");
        let says = found["notes"].to_string().contains("it counts as normal");
        assert_eq!(
            says,
            friction.contains("min") || friction.contains("values") || speed.contains("min") || speed.contains("mean"),
            "{friction} {speed}"
        );
    }
}
