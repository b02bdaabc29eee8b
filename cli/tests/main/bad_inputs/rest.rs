//! Invalid `[rest]` tables, and the place that each message names.

use super::{Bad, RESTED, check, faults_of, wrong};
use crate::process::{Folder, run};

/// Inputs and expected messages. In the base file `[rest]` is at line 22, its vehicle at line 26.
pub const BAD: &[Bad] = &[
    wrong(
        "a friction of [rest] beside a mass",
        &[
            ("schema = 1\n\n", "schema = 1\ncorrelation = [[\"m1\", \"rest.friction\", 0.3]]\n"),
            ("mass = 1200", "mass = \"1200 kg ± 10 kg\""),
        ],
        2,
        &["correlation.1", "vehicle.1.mass and rest.friction", "with the friction of a skid alone"],
    )
    .of(RESTED),
    wrong("a rest without friction", &[("friction = \"0.7 ± 0.05\"\n", "")], 22, &["rest.friction", "missing"]).of(RESTED),
    wrong("a rest on no friction", &[("0.7 ± 0.05", "0")], 23, &["rest.friction", "above 0"]).of(RESTED),
    wrong("a friction with a percentage", &[("0.7 ± 0.05", "0.7 ± 5 %")], 23, &["rest.friction", "may mean a hundredth or a share"])
        .of(RESTED),
    wrong("a friction in meters", &[("0.7 ± 0.05", "0.7 m ± 0.05")], 23, &["rest.friction", "a pure number is expected"]).of(RESTED),
    wrong("a friction below its deviation", &[("0.7 ± 0.05", "0.7 ± 0.9")], 23, &["rest.friction", "larger than itself"]).of(RESTED),
    wrong("gravity upwards", &[("[rest]\n", "[rest]\ngravity = -9.8\n")], 23, &["rest.gravity", "above zero"]).of(RESTED),
    wrong("a region of two corners", &[(", [\"9 m\", \"5 m\"]]", "]")], 24, &["rest.regions.1.polygon", "3 to 256 corners"]).of(RESTED),
    wrong("a region on a line", &[("[\"9 m\", \"5 m\"]", "[\"19 m\", \"-5 m\"]")], 24, &["rest.regions.1.polygon", "on a line"]).of(RESTED),
    wrong(
        "a region whose sides cross",
        &[("[\"9 m\", \"5 m\"]]", "[\"9 m\", \"5 m\"], [\"6 m\", \"-8 m\"]]")],
        24,
        &["rest.regions.1.polygon", "cross each other"],
    )
    .of(RESTED),
    wrong("a rolling resistance above 1", &[("track =", "rolling_resistance = 1.5\ntrack =")], 31, &["rolling_resistance", "from 0 to 1"])
        .of(RESTED),
    wrong(
        "a slip angle beyond a right angle",
        &[("track =", "slip_angle = \"91 deg\"\ntrack =")],
        31,
        &["slip_angle", "it is 91 deg; it must be below 90 deg"],
    )
    .of(RESTED),
    wrong("a region without a place", &[(", polygon", ", polyp")], 24, &["rest.regions.1", "`polygon` or `half_plane`"]).of(RESTED),
    wrong("a region below zero", &[("friction = 0.4", "friction = -0.4")], 24, &["rest.regions.1.friction", "from 0 to 10"]).of(RESTED),
    wrong("a grade in degrees", &[("[rest]\n", "[rest]\ngrade = [\"2 deg\", 0]\n")], 23, &["rest.grade.1", "a pure number is expected"])
        .of(RESTED),
    wrong("a grade in percent without its sign", &[("[rest]\n", "[rest]\ngrade = [2, 0]\n")], 23, &["rest.grade.1", "from -1 to 1", "2 %"])
        .of(RESTED),
    wrong("a grade of one share", &[("[rest]\n", "[rest]\ngrade = \"2 %\"\n")], 23, &["rest.grade", "along x and y"]).of(RESTED),
    wrong("a grade without a direction", &[("[rest]\n", "[rest]\ngrade = { rise = 0.02 }\n")], 23, &["rest.grade.toward", "missing"])
        .of(RESTED),
    wrong(
        "a rise below zero",
        &[("[rest]\n", "[rest]\ngrade = { rise = -0.02, toward = 0 }\n")],
        23,
        &["rest.grade.rise", "from 0 to 1", "uphill"],
    )
    .of(RESTED),
    wrong(
        "a grade of a region that is a wall",
        &[("friction = 0.4,", "friction = 0.4, grade = [0, 3],")],
        24,
        &["rest.regions.1.grade.2", "from -1 to 1"],
    )
    .of(RESTED),
    wrong(
        "points without deviations",
        &[("track =", "points = [{ position = [\"3 m\", \"1 m\"] }]\ntrack =")],
        31,
        &["rest.vehicle.1.points.1.position.1", "no standard deviation"],
    )
    .of(RESTED),
    wrong(
        "a point in degrees",
        &[("track =", "points = [{ position = [\"3 deg ± 1 deg\", \"1 m ± 1 m\"] }]\ntrack =")],
        31,
        &["rest.vehicle.1.points.1.position.1", "a length is expected"],
    )
    .of(RESTED),
    wrong(
        "a point of a fifth wheel",
        &[("track =", "points = [{ wheel = \"spare\", position = [\"3 m ± 1 m\", \"1 m ± 1 m\"] }]\ntrack =")],
        31,
        &["rest.vehicle.1.points.1.wheel", "\"front_left\""],
    )
    .of(RESTED),
    wrong(
        "a point nowhere",
        &[("track =", "points = [{ wheel = \"front_left\" }]\ntrack =")],
        31,
        &["rest.vehicle.1.points.1.position", "missing"],
    )
    .of(RESTED),
    wrong("no points", &[("track =", "points = []\ntrack =")], 31, &["rest.vehicle.1.points", "1 to 64"]).of(RESTED),
    wrong(
        "points and no rest",
        &[
            ("position = [\"12 m ± 0.3 m\", \"-4 m ± 0.3 m\"]\nheading = \"135 deg ± 5 deg\"\n", ""),
            ("track =", "points = [{ position = [\"3 m ± 1 m\", \"1 m ± 1 m\"] }]\ntrack ="),
        ],
        29,
        &["rest.vehicle.1.points", "do not say where the vehicle came to rest"],
    )
    .of(RESTED),
    wrong(
        "points of the closed form",
        &[("track =", "method = \"closed-form\"\npoints = [{ position = [\"3 m ± 1 m\", \"1 m ± 1 m\"] }]\ntrack =")],
        31,
        &["rest.vehicle.1.method", "follows no path"],
    )
    .of(RESTED),
    wrong("a friction by nothing", &[("\"0.7 ± 0.05\"", "{ min = 0.8, max = 0.6 }")], 23, &["rest.friction.max", "above `min`"]).of(RESTED),
    wrong(
        "a friction of two measurements",
        &[("\"0.7 ± 0.05\"", "{ mean = 0.7, sd = 0.05, n = 2 }")],
        23,
        &["rest.friction", "no standard deviation"],
    )
    .of(RESTED),
    wrong(
        "a friction of two forms",
        &[("\"0.7 ± 0.05\"", "{ median = 0.7, factor = 1.1, sd = 0.1 }")],
        23,
        &["rest.friction.sd", "exclude each other"],
    )
    .of(RESTED),
    wrong("a rest of nobody", &[("[rest.vehicle.1]", "[rest.vehicle.3]")], 26, &["rest.vehicle.3: unknown key"]).of(RESTED),
    wrong("a rest of the wall", &[("[rest.vehicle.1]", "[rest.vehicle.2]")], 26, &["rest.vehicle.2", "a fixed barrier"]).of(RESTED),
    wrong(
        "a rest nowhere",
        &[("position = [\"12", "portion = [\"12")],
        27,
        &["rest.vehicle.1.portion: unknown key", "did you mean `position`"],
    )
    .of(RESTED),
    wrong(
        "a share of braking by itself",
        &[("front_left = \"locked\"", "front_left = 0.3")],
        32,
        &["rest.vehicle.1.wheels.front_left", "did you mean { braking = 0.3 }?"],
    )
    .of(RESTED),
    wrong("a rest without deviation", &[("12 m ± 0.3 m", "12 m")], 27, &["rest.vehicle.1.position.1", "no standard deviation"]).of(RESTED),
    wrong("a rest with no deviation", &[("± 5 deg", "± 0 deg")], 28, &["rest.vehicle.1.heading", "no standard deviation"]).of(RESTED),
    wrong("a rest with a deviation below zero", &[("± 5 deg", "± -5 deg")], 28, &["rest.vehicle.1.heading", "below zero"]).of(RESTED),
    wrong(
        "axles on the wrong side",
        &[("rear_axle = \"1.5 m\"", "rear_axle = \"-1.5 m\"")],
        30,
        &["rest.vehicle.1.rear_axle", "above zero"],
    )
    .of(RESTED),
    wrong("three wheels", &[(", rear_right = { braking = 1 }", "")], 32, &["rest.vehicle.1.wheels.rear_right", "missing"]).of(RESTED),
    wrong("a wheel in flames", &[("\"rolling\"", "\"burning\"")], 32, &["rest.vehicle.1.wheels.rear_left", "\"locked\", \"rolling\""])
        .of(RESTED),
    wrong("a wheel braked twice over", &[("braking = 1 ", "braking = 2 ")], 32, &["wheels.rear_right.braking", "from 0 to 1"]).of(RESTED),
    wrong("a wheel of two minds", &[("braking = 1 ", "braking = 1, state = \"locked\" ")], 32, &["exclude each other"]).of(RESTED),
    wrong("an unheard-of method", &[("track =", "method = \"magic\"\ntrack =")], 31, &["rest.vehicle.1.method", "\"slide\""]).of(RESTED),
];

#[test]
fn each_is_refused() {
    check(BAD);
}

/// All issues are reported together, even if the vehicle itself is invalid.
#[test]
fn everything_is_said_at_once() {
    let folder = Folder::new();
    let text =
        RESTED.replace("mass = 1200", "mass = 0").replace("± 5 deg", "").replace("\"locked\"", "\"licked\"").replace("= 0.4", "= -0.4");
    folder.write("case.toml", text.as_bytes());
    let run = run(folder.path(), &["solve", "case.toml", "--format", "json"]);
    let wanted = ["vehicle.1.mass", "rest.vehicle.1.heading", "rest.vehicle.1.wheels.front_left", "rest.regions.1.friction"];
    let faults = faults_of(&run, 2, "case.toml", &wanted.map(str::to_owned));
    assert!(faults.is_empty(), "{faults:?}\n{}", run.err);
    assert_eq!(run.err.matches("error: ").count(), 4, "{}", run.err);
}

#[test]
fn regions_are_limited() {
    let folder = Folder::new();
    let region = "{ friction = 0.4, half_plane = { from = [\"40 m\", \"0 m\"], toward = \"0 deg\" } }";
    for (count, status) in [(32, 0), (33, 2), (34, 2)] {
        let regions = format!("regions = [{}]", vec![region; count].join(", "));
        let lines: Vec<&str> = RESTED.lines().map(|line| if line.starts_with("regions = ") { &regions } else { line }).collect();
        folder.write("case.toml", lines.join("\n").as_bytes());
        let run = run(folder.path(), &["solve", "case.toml"]);
        assert_eq!(run.status, status, "{count}: {}", run.err);
        assert_eq!(
            run.err.contains(&format!("rest.regions: {count} regions are more than the 32 that are taken")),
            status == 2,
            "{}",
            run.err
        );
    }
}
