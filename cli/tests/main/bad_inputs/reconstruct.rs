//! Evidence and unknowns that must be refused, by `reconstruct` and by the verbs that only read them.

use super::{Bad, CRUSHED, check, check_with, wrong};

/// A valid question: two vehicles, two unknown speeds.
const QUESTION: &str = r#"schema = 1

[[vehicle]]
name = "sedan"
mass = "1163 kg"
yaw_inertia = "1945 kg m^2"
heading = "180 deg"
impact_center = ["1.9 m", "0 m"]

[[vehicle]]
name = "pickup"
mass = "2878 kg"
yaw_inertia = "7040 kg m^2"
heading = "90 deg"
impact_center = ["2.4 m", "-1 m"]

[contact]
crush_plane = "0 deg"
restitution = 0.1

[evidence]
crush_energy = "40 kJ ± 2 kJ"
vehicle.1.separation_velocity = ["-6.4 m/s ± 0.5 m/s", "3.8 m/s ± 0.5 m/s"]

[unknown]
vehicle.1.speed = { start = "12 m/s", min = "0 m/s" }
vehicle.2.speed = { start = "12 m/s", min = "0 m/s" }
"#;

const ENERGY: &str = "crush_energy = \"40 kJ ± 2 kJ\"\n";
const FIRST: &str = "{ start = \"12 m/s\", min = \"0 m/s\" }";

const fn question(name: &'static str, edits: &'static [(&'static str, &'static str)], line: usize, says: &'static [&'static str]) -> Bad {
    wrong(name, edits, line, says).of(QUESTION)
}

/// Inputs that every verb refuses.
pub(super) const UNREADABLE: &[Bad] = &[
    question("evidence of nothing", &[("crush_energy", "crash_energy")], 22, &["evidence.crash_energy", "did you mean `crush_energy`?"]),
    question(
        "evidence of a vehicle misspelt",
        &[("separation_velocity", "seperation_velocity")],
        23,
        &["evidence.vehicle.1.seperation_velocity", "did you mean `vehicle.1.separation_velocity`?"],
    ),
    question(
        "the abbreviation of an equivalent energy speed",
        &[("separation_velocity = [\"-6.4 m/s ± 0.5 m/s\", \"3.8 m/s ± 0.5 m/s\"]", "EES = \"10 m/s ± 1 m/s\"")],
        23,
        &["evidence.vehicle.1.EES", "did you mean `vehicle.1.equivalent_energy_speed`?"],
    ),
    question(
        "an exact speed of a vehicle that has a velocity",
        &[
            ("impact_center = [\"1.9 m\", \"0 m\"]\n", "impact_center = [\"1.9 m\", \"0 m\"]\nvelocity = [\"-15 m/s\", \"4 m/s\"]\n"),
            ("crush_energy = \"40 kJ ± 2 kJ\"", "vehicle.1.speed = \"20 m/s\""),
            ("vehicle.1.speed = { start = \"12 m/s\", min = \"0 m/s\" }\nvehicle.2", "vehicle.2"),
        ],
        23,
        &["evidence.vehicle.1.speed: the vehicle or the contact gives another value", "of which the components may be evidence"],
    ),
    question(
        "an exact speed of a vehicle that has another",
        &[
            ("impact_center = [\"1.9 m\", \"0 m\"]\n", "impact_center = [\"1.9 m\", \"0 m\"]\nspeed = \"15 m/s\"\n"),
            ("crush_energy = \"40 kJ ± 2 kJ\"", "vehicle.1.speed = \"20 m/s\""),
            ("vehicle.1.speed = { start = \"12 m/s\", min = \"0 m/s\" }\nvehicle.2", "vehicle.2"),
        ],
        23,
        &["evidence.vehicle.1.speed: the vehicle or the contact gives another value", "it is then solved for"],
    ),
    question("evidence of a third vehicle", &[("vehicle.1.sep", "vehicle.3.sep")], 23, &["evidence.vehicle.3.separation_velocity"]),
    question("one component", &[("[\"-6.4 m/s ± 0.5 m/s\", \"3.8 m/s ± 0.5 m/s\"]", "\"6 m/s\"")], 23, &["an array of two values"]),
    question("an energy in N", &[("40 kJ ± 2 kJ", "40 kN ± 2 kN")], 22, &["evidence.crush_energy", "an energy is expected"]),
    question(
        "a percentage of a number without a unit",
        &[("crush_energy = \"40 kJ ± 2 kJ\"", "contact.impulse_ratio = \"0.1 ± 20 %\"")],
        22,
        &["evidence.contact.impulse_ratio", "may mean a hundredth or a share of the value"],
    ),
    question("a deviation of another dimension", &[("± 2 kJ", "± 2 m")], 22, &["evidence.crush_energy", "`2 m`"]),
    question("a negative deviation", &[("± 2 kJ", "± -2 kJ")], 22, &["evidence.crush_energy", "below zero"]),
    question(
        "min above max",
        &[("min = \"0 m/s\"", "min = \"20 m/s\", max = \"10 m/s\"")],
        26,
        &["unknown.vehicle.1.speed.max: it is 10.00 m/s; it must be above min, 20.00 m/s"],
    ),
    question(
        "a start below min",
        &[("min = \"0 m/s\"", "min = \"13 m/s\"")],
        26,
        &["unknown.vehicle.1.speed.start: it is 12.00 m/s; it must be at least min, 13.00 m/s"],
    ),
    question("a start above max", &[("min = \"0 m/s\"", "max = \"11 m/s\"")], 26, &["it is 12.00 m/s; it must be at most max, 11.00 m/s"]),
    question(
        "min equal to max",
        &[(FIRST, "{ min = \"40 km/h\", max = \"40 km/h\" }")],
        26,
        &["it is 11.11 m/s; it must be above min, 11.11 m/s", "give its value, and leave it out of [unknown]"],
    ),
    question(
        "a start a turn away",
        &[(FIRST, "{ start = \"40 km/h\" }\nvehicle.1.heading = { start = \"350 deg\", min = \"-20 deg\", max = \"20 deg\" }")],
        27,
        &["unknown.vehicle.1.heading.start: it is 350.0 deg; it must be at most max, 20.0 deg", "the same direction is -10 deg"],
    ),
    question(
        "limits on both sides of zero degrees",
        &[(FIRST, "{ start = \"40 km/h\" }\nvehicle.1.heading = { min = \"350 deg\", max = \"10 deg\" }")],
        27,
        &["it is 10.0 deg; it must be above min, 350.0 deg", "for limits on both sides of 0 deg write `min` as -10 deg"],
    ),
    question(
        "a negative sd",
        &[("\"40 kJ ± 2 kJ\"", "{ value = \"40 kJ\", sd = \"-2 kJ\" }")],
        22,
        &["evidence.crush_energy.sd", "below zero"],
    ),
    question(
        "sd and resolution",
        &[("\"40 kJ ± 2 kJ\"", "{ value = 4e4, sd = 1, resolution = 1 }")],
        22,
        &["more than one of `sd`, `resolution`", "root of 12"],
    ),
    question("a deviation without a value", &[("\"40 kJ ± 2 kJ\"", "{ sd = 1 }")], 22, &["evidence.crush_energy.value: missing"]),
    question(
        "another key beside the value",
        &[("\"40 kJ ± 2 kJ\"", "{ value = 1, std = 1 }")],
        22,
        &["evidence.crush_energy.std: unknown key"],
    ),
    question("not a number", &[("\"40 kJ ± 2 kJ\"", "nan")], 22, &["evidence.crush_energy", "not a finite number"]),
    question(
        "a restitution by a share of nothing",
        &[(ENERGY, "contact.restitution = { value = 0, relative = 0.1 }\n")],
        22,
        &["evidence.contact.restitution.relative", "any share of it"],
    ),
    question(
        "no crush to take it from",
        &[("\"40 kJ ± 2 kJ\"", "\"from crush\"")],
        22,
        &["vehicle 1 has no [vehicle.crush]", "vehicle 2 has no"],
    ),
    question("a speed from crush", &[("\"-6.4 m/s ± 0.5 m/s\"", "\"from crush\"")], 23, &["does not begin with a number"]),
    question(
        "evidence is no table",
        &[("[evidence]\n", "[other]\n"), ("schema = 1\n", "schema = 1\nevidence = 3\n")],
        2,
        &["evidence", "a table"],
    ),
    question(
        "an unknown of nothing",
        &[("vehicle.1.speed", "vehicle.1.sped")],
        26,
        &["unknown.vehicle.1.sped", "did you mean `vehicle.1.speed`?"],
    ),
    question("an unknown output", &[("vehicle.1.speed", "energy.loss")], 26, &["unknown.energy.loss", "[evidence]"]),
    question(
        "an unknown radius",
        &[("vehicle.1.speed", "vehicle.1.radius_of_gyration")],
        26,
        &["radius of gyration cannot", "yaw_inertia"],
    ),
    question("an unknown of no name", &[("vehicle.1.speed", "vehicle.1.sped = {}\nvehicle.1.speed")], 26, &["unknown.vehicle.1.sped"]),
    question("an unknown depth", &[("vehicle.1.speed", "vehicle.1.crush.depths.1")], 26, &["cannot be solved for"]),
    question(
        "an unknown yaw inertia beside a radius of gyration",
        &[("yaw_inertia = \"1945 kg m^2\"", "radius_of_gyration = 1.3"), (FIRST, "12\nvehicle.1.yaw_inertia = { start = 2000 }")],
        27,
        &["unknown.vehicle.1.yaw_inertia", "radius of gyration", "yaw_inertia"],
    ),
    question(
        "a start in kg",
        &[("start = \"12 m/s\"", "start = \"12 kg\"")],
        26,
        &["unknown.vehicle.1.speed.start", "a speed is expected"],
    ),
    question("a bound that is no number", &[("min = \"0 m/s\"", "min = true")], 26, &["unknown.vehicle.1.speed.min"]),
    question("a negative prior", &[("min = \"0 m/s\"", "sd = \"-1 m/s\"")], 26, &["unknown.vehicle.1.speed.sd", "below zero"]),
    question("a key that no unknown has", &[("min = \"0 m/s\"", "minimum = 0")], 26, &["unknown.vehicle.1.speed.minimum: unknown key"]),
    question("no start", &[("start = \"12 m/s\", ", "")], 26, &["unknown.vehicle.1.speed", "no start"]),
    question(
        "neither given nor unknown",
        &[("vehicle.2.speed = { start = \"12 m/s\", min = \"0 m/s\" }", "")],
        10,
        &["vehicle.2: missing `speed`"],
    ),
    question(
        "exact evidence against the case",
        &[("heading = \"180 deg\"\n", "heading = \"180 deg\"\nyaw_rate = 0\n"), (ENERGY, "vehicle.1.yaw_rate = 1\n")],
        23,
        &["evidence.vehicle.1.yaw_rate", "another value"],
    ),
    wrong(
        "a share of the crush energy beside the crush",
        &[("[contact]", "[evidence]\nvehicle.2.crush_energy = \"50 kJ\"\n[contact]")],
        21,
        &["evidence.vehicle.2.crush_energy", "of its own"],
    )
    .of(CRUSHED),
];

/// Inputs that only `reconstruct` refuses.
pub(super) const UNANSWERABLE: &[Bad] = &[
    question(
        "nothing unknown",
        &[
            ("[unknown]\n", "[unknown]\n#"),
            ("\nvehicle.2.speed = {", "\n#vehicle.2.speed = {"),
            ("\"180 deg\"", "\"180 deg\"\nspeed = 1"),
            ("\"90 deg\"", "\"90 deg\"\nspeed = 1"),
        ],
        0,
        &["unknown: nothing is unknown"],
    ),
    question(
        "more unknowns than evidence",
        &[("[unknown]\n", "[unknown]\nvehicle.1.yaw_rate = 0\ncontact.impulse_ratio = 0.3\n")],
        25,
        &["4 numbers are unknown", "vehicle.1.yaw_rate", "contact.impulse_ratio", "3 pieces of evidence", "crush_energy"],
    ),
    question(
        "more unknowns than evidence, between limits",
        &[(
            "[unknown]\n",
            "[unknown]\nvehicle.1.yaw_rate = { start = 0, min = -1, max = 1 }\ncontact.restitution = { start = 0.3, min = 0, max = 1 }\n",
        )],
        25,
        &["4 numbers are unknown", "vehicle.1.yaw_rate", "contact.restitution", "3 pieces of evidence"],
    ),
    question("a start above one", &[(FIRST, "12\ncontact.restitution = { start = 1.5 }")], 27, &["must be from 0 to 1"]),
    question("a mass below nothing", &[(FIRST, "12\nvehicle.1.mass = { start = -5 }")], 27, &["must be above zero"]),
    question(
        "a bound beyond the mechanics",
        &[(FIRST, "12\ncontact.restitution = { start = 0.5, max = 2 }")],
        27,
        &["a bound is 2; it must be from 0 to 1"],
    ),
    question("unknown twice", &[(FIRST, "12\nv1 = 12")], 27, &["unknown.v1", "unknown twice"]),
    question("evidence twice", &[(ENERGY, "contact.restitution = \"0.1 ± 0.1\"\ne = \"0.2 ± 0.1\"\n")], 23, &["contact.restitution twice"]),
    question(
        "a speed and a component",
        &[(FIRST, "12\nvehicle.1.velocity.x = -12")],
        26,
        &["a component of the same velocity is unknown too"],
    ),
    question(
        "a ratio at the critical one",
        &[("restitution = 0.1\n", "restitution = 0.1\nimpulse_ratio = \"critical\"\n"), (FIRST, "12\ncontact.impulse_ratio = 0.3")],
        28,
        &["critical impulse ratio", "of_critical"],
    ),
    question(
        "a ratio given in another way",
        &[("restitution = 0.1\n", "restitution = 0.1\nimpulse_ratio = 0.3\n"), (FIRST, "12\ncontact.friction = 0.3")],
        28,
        &["gives the impulse ratio in another way"],
    ),
    question(
        "one share and no word on the other",
        &[("crush_energy = ", "vehicle.1.crush_energy = ")],
        22,
        &["a share of the crush energy", "contact.crush_share"],
    ),
    question(
        "a speed across the heading",
        &[("\"180 deg\"", "\"180 deg\"\nvelocity = [\"-10 m/s\", \"5 m/s\"]")],
        27,
        &["not along its heading", "vehicle.1.approach_direction"],
    ),
    wrong(
        "the speed of a barrier",
        &[("[contact]", "[evidence]\ncrush_energy = \"from crush\"\n[unknown]\nvehicle.1.speed = 3\n[contact]")],
        23,
        &["vehicle 1 is a fixed barrier"],
    )
    .of(CRUSHED),
    wrong(
        "evidence of a barrier",
        &[("[contact]", "[evidence]\nvehicle.1.delta_v_magnitude = 3\n[unknown]\nvehicle.2.speed = 3\n[contact]")],
        21,
        &["evidence.vehicle.1.delta_v_magnitude", "vehicle 1 is a fixed barrier"],
    )
    .of(CRUSHED),
    question(
        "a crush energy below zero",
        &[("40 kJ ± 2 kJ", "-40 kJ ± 2 kJ")],
        22,
        &["evidence.crush_energy", "-40000 J; it must be at least 0 J"],
    ),
    // Failures of the search.
    question(
        "starts that do not close",
        &[(FIRST, "{ start = \"-90 m/s\", max = \"-80 m/s\" }")],
        25,
        &["refuses the collision at each of 201 starts", "vehicles are separating"],
    )
    .ends(3),
];

#[test]
fn what_cannot_be_read_no_verb_reads() {
    check(UNREADABLE);
    check_with(UNREADABLE, &["reconstruct"]);
}

#[test]
fn what_cannot_be_answered_is_refused() {
    check_with(UNANSWERABLE, &["reconstruct"]);
    check_with(UNANSWERABLE, &["reconstruct", "--format", "json"]);
}

#[test]
fn the_question_is_sound() {
    let accepted = [
        question("the question", &[], 0, &[]),
        question("no deviation", &[("± 2 kJ", "± 0 kJ")], 0, &[]),
        question("a prior of nothing", &[("min = \"0 m/s\"", "sd = 0")], 0, &[]),
        question("one unit for both", &[("40 kJ ± 2 kJ", "40 +/- 2 kJ")], 0, &[]),
        question("in per cent", &[("40 kJ ± 2 kJ", "40 kJ +- 5 %")], 0, &[]),
        question(
            "an unknown mass under a radius of gyration",
            &[("yaw_inertia = \"1945 kg m^2\"", "radius_of_gyration = 1.3"), (FIRST, "12\nvehicle.1.mass = { start = 1200, sd = 50 }")],
            0,
            &[],
        ),
    ];
    let accepted = accepted.map(|accepted| accepted.ends(0));
    check_with(&accepted, &["reconstruct"]);
}

/// If a speed is left out because it is unknown, the other verbs report that.
#[test]
fn what_is_unknown_is_not_solved_with() {
    let unknown = [question(
        "unknown speeds",
        &[],
        26,
        &["vehicle.1.speed: missing: listed under `[unknown]`", "vehicle.2.speed: missing", "reconstruct` solves for it"],
    )];
    check(&unknown);
    for verb in ["gradient", "crash3"] {
        check_with(&unknown, &[verb]);
    }
    // The depth of a crush does not depend on it.
    let crush = "[vehicle.crush]\nwidth = 1\ndepths = [0.1, 0.2]\nstiffness = { d0 = 90, d1 = 900 }\n";
    let folder = crate::process::Folder::new();
    let text = QUESTION.replace("[contact]", &format!("{crush}[contact]")).replace("\"40 kJ ± 2 kJ\"", "\"from crush\"");
    folder.write("case.toml", text.as_bytes());
    let run = crate::process::run(folder.path(), &["crush", "case.toml"]);
    assert!(run.status == 2 && run.err.contains("vehicle 1 has no [vehicle.crush]"), "{}", run.err);
    folder.write("case.toml", text.replace("crush_energy = \"from crush\"\n", "").as_bytes());
    let run = crate::process::run(folder.path(), &["crush", "case.toml"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    // A value known exactly can be used by every verb.
    let known = [question(
        "exact speeds",
        &[
            ("[unknown]\n", "#"),
            ("vehicle.1.speed = {", "#"),
            ("vehicle.2.speed = {", "#"),
            (ENERGY, "vehicle.1.speed = 12\nvehicle.2.speed = 12\n"),
        ],
        0,
        &[],
    )
    .ends(0)];
    check(&known);
}

#[test]
fn calls_are_bounded() {
    let folder = crate::process::Folder::new();
    folder.write("case.toml", QUESTION.as_bytes());
    for (flag, value, status) in [
        ("--starts", "0", 2),
        ("--starts", "10001", 2),
        ("--starts", "1e3", 2),
        ("--starts", "1", 0),
        ("--seed", "18446744073709551616", 2),
        ("--seed", "-1", 2),
        ("--seed", "18446744073709551615", 0),
        ("--level", "0.49", 2),
        ("--level", "1", 2),
        ("--level", "95 %", 2),
        ("--level", "NaN", 2),
        ("--level", "0.9999", 0),
        ("--probability", "", 2),
        ("--probability", "vehicle.1.speed > 1e400 m/s", 2),
        ("--probability", "vehicle.1.speed > 10 m/s > 9 m/s", 2),
        ("--probability", "vehicle.1.speed > 10 m/s", 0),
    ] {
        let run = crate::process::run(folder.path(), &["reconstruct", "case.toml", flag, value]);
        assert_eq!((run.status, run.out.is_empty()), (status, status != 0), "{flag} {value}: {}", run.err);
        assert!(status == 0 || run.err.contains(flag), "{}", run.err);
    }
}
