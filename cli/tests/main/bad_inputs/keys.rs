//! Keys that are missing, unknown, or given twice.

use super::{Bad, CRUSHED, JSON, WALL, check, wrong};

const D0_D1: &str = "{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }";

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    // Missing.
    wrong("no schema", &[("schema = 1\n", "")], 0, &["schema: missing"]),
    wrong("no mass", &[("mass = \"2564 lb\"\n", "")], 4, &["vehicle.1.mass: missing"]),
    wrong("no inertia", &[("yaw_inertia = \"1434.9 lbf s^2 ft\"\n", "")], 4, &["vehicle.1", "`yaw_inertia` or `radius_of_gyration`"]),
    wrong("no heading", &[("heading = \"180 deg\"\n", "")], 4, &["vehicle.1.heading: missing"]),
    wrong("no speed", &[("speed = \"40 ft/s\"\n", "")], 4, &["vehicle.1", "`speed` or `velocity`"]),
    wrong("no impact center", &[("impact_center = [\"6.3499 ft\", \"0 ft\"]\n", "")], 4, &["vehicle.1.impact_center: missing"]),
    wrong("no mass of vehicle 2", &[("mass = \"6345 lb\"\n", "")], 13, &["vehicle.2.mass: missing"]),
    wrong("no contact", &[("[contact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\n", "")], 0, &["contact: missing"]),
    wrong("no crush plane", &[("crush_plane = \"0 deg\"\n", "")], 21, &["contact: missing `crush_plane` or `surfaces`"]),
    wrong("no restitution", &[("restitution = 0.1\n", "")], 21, &["contact.restitution: missing"]),
    wrong("no vehicles", &[("[[vehicle]]", "[[evidence]]"), ("[[vehicle]]", "[[evidence]]")], 0, &["vehicle: missing"]),
    wrong("no crush width", &[("width = \"5 ft\"\n", "")], 15, &["vehicle.2.crush.width: missing"]).of(CRUSHED),
    wrong("no crush depths", &[("depths = [\"3 in\", \"4.1 in\", \"5 in\", \"2 in\"]\n", "")], 15, &["vehicle.2.crush.depths: missing"])
        .of(CRUSHED),
    wrong("no crush stiffness", &[("stiffness = {", "# {")], 15, &["vehicle.2.crush.stiffness: missing"]).of(CRUSHED),
    wrong("no d1", &[(", d1 = \"162.8 lbf^0.5/ft\"", "")], 18, &["vehicle.2.crush.stiffness.d1: missing"]).of(CRUSHED),
    wrong("no d0", &[("d0 = \"48.27 lbf^0.5\", ", "")], 18, &["vehicle.2.crush.stiffness.d0: missing"]).of(CRUSHED),
    wrong("no A", &[(D0_D1, "{ B = 3e5 }")], 18, &["vehicle.2.crush.stiffness.A: missing"]).of(CRUSHED),
    wrong("no B", &[(D0_D1, "{ A = 3e4 }")], 18, &["vehicle.2.crush.stiffness.B: missing"]).of(CRUSHED),
    wrong(
        "no b1 and no mass of the test",
        &[(D0_D1, "{ b0 = 2, test_width = 1.5 }")],
        18,
        &["stiffness.b1: missing", "stiffness.test_mass: missing"],
    )
    .of(CRUSHED),
    wrong(
        "no b0 and no width of the test",
        &[(D0_D1, "{ b1 = 20, test_mass = 1500 }")],
        18,
        &["stiffness.b0: missing", "stiffness.test_width: missing"],
    )
    .of(CRUSHED),
    wrong("an empty stiffness", &[(D0_D1, "{}")], 18, &["stiffness.d0: missing", "stiffness.d1: missing"]).of(CRUSHED),
    wrong("JSON without a mass", &[("\"mass\": \"2564 lb\", ", "")], 5, &["vehicle.1.mass: missing"]).of(JSON),
    // Unknown, in every table.
    wrong("unknown at the top", &[("schema = 1\n", "schema = 1\ncolor = 3\n")], 2, &["color: unknown key"]),
    wrong("unknown table", &[("[contact]\n", "[contact]\ncrush_plane = 0\n[contacts]\n")], 23, &["contacts: unknown key"]),
    wrong("unknown in a vehicle", &[("mass = ", "mas = 3\nmass = ")], 6, &["vehicle.1.mas: unknown key"]),
    wrong("misspelled in a vehicle", &[("mass = ", "mas = ")], 6, &["vehicle.1.mas: unknown key", "did you mean `mass`"]),
    wrong("in the wrong case", &[("mass = ", "Mass = ")], 6, &["vehicle.1.Mass: unknown key", "did you mean `mass`"]),
    wrong("British spelling", &[("impact_center", "impact_centre")], 11, &["vehicle.1.impact_centre: unknown key", "`impact_center`"]),
    wrong("unknown in vehicle 2", &[("speed = \"41 ft/s\"", "speed = \"41 ft/s\"\nsped = 1")], 19, &["vehicle.2.sped: unknown key"]),
    wrong("unknown in the contact", &[("= 0.1\n", "= 0.1\nimpulse_ration = 0.3\n")], 24, &["contact.impulse_ration: unknown key"]),
    wrong(
        "unknown beside of_critical",
        &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = 0.5, at = 2 }\n")],
        24,
        &["contact.impulse_ratio.at: unknown key"],
    ),
    wrong("unknown in the crush", &[("width", "with = 1\nwidth")], 16, &["vehicle.2.crush.with: unknown key"]).of(CRUSHED),
    wrong("unknown in the stiffness", &[("{ d0", "{ d2 = 1, d0")], 18, &["vehicle.2.crush.stiffness.d2: unknown key"]).of(CRUSHED),
    wrong(
        "stiffness in small letters",
        &[("{ d0", "{ a"), ("d1 = \"162.8 lbf^0.5/ft\"", "b = 3e5")],
        18,
        &["stiffness.a: unknown key", "did you mean `A`?"],
    )
    .of(CRUSHED),
    wrong(
        "mixed stiffness forms",
        &[("d1 = \"162.8 lbf^0.5/ft\"", "B = 3e5")],
        18,
        &["vehicle.2.crush.stiffness: it has keys of two forms"],
    )
    .of(CRUSHED),
    wrong("three stiffness values", &[("{ d0", "{ A = 3e4, d0")], 18, &["vehicle.2.crush.stiffness: it has keys of two forms"]).of(CRUSHED),
    wrong("a wall with a mass", &[("barrier = true", "barrier = true\nmass = \"1 t\"")], 15, &["vehicle.2.mass: unknown key"]).of(WALL),
    wrong("a wall with a speed", &[("barrier = true", "barrier = true\nspeed = 0")], 15, &["vehicle.2.speed: unknown key"]).of(WALL),
    wrong("a wall with a center", &[("barrier = true", "barrier = true\nimpact_center = [0, 0]")], 15, &["vehicle.2.impact_center"])
        .of(WALL),
    wrong("a wall with crush", &[("barrier = true", "barrier = true\ncrush = {}")], 15, &["vehicle.2.crush: unknown key"]).of(WALL),
    wrong("unknown in JSON", &[("\"mass\": \"2564", "\"color\": 3, \"mass\": \"2564")], 5, &["vehicle.1.color: unknown key"]).of(JSON),
    // Two keys that exclude each other.
    wrong("speed and velocity", &[("yaw_rate", "velocity = [1, 2]\nyaw_rate")], 10, &["vehicle.1.velocity", "exclude each other"]),
    wrong("inertia and radius", &[("heading", "radius_of_gyration = 1\nheading")], 8, &["radius_of_gyration", "exclude each other"]),
    wrong(
        "friction and a wrong impulse ratio",
        &[("= 0.1\n", "= 0.1\nimpulse_ratio = \"crit\"\nfriction = -1\n")],
        25,
        &["exclude each other", "contact.friction: it is -1", "contact.impulse_ratio: expected \"critical\""],
    ),
    wrong("friction and impulse ratio", &[("= 0.1\n", "= 0.1\nimpulse_ratio = 0.1\nfriction = 0.4\n")], 25, &["exclude each other"]),
    wrong(
        "friction and critical impulse ratio",
        &[("= 0.1\n", "= 0.1\nimpulse_ratio = \"critical\"\nfriction = 0.4\n")],
        25,
        &["contact.friction", "exclude each other"],
    ),
    // Twice.
    wrong("twice in TOML", &[("mass = \"2564 lb\"", "mass = \"2564 lb\"\nmass = \"2565 lb\"")], 7, &["duplicate key"]),
    wrong("table twice in TOML", &[("= 0.1\n", "= 0.1\n\n[contact]\nrestitution = 0.2\n")], 25, &["duplicate key"]),
    wrong("twice at the top of JSON", &[("\"schema\": 1,", "\"schema\": 1, \"schema\": 1,")], 2, &["`schema` stands twice"]).of(JSON),
    wrong("twice in a JSON vehicle", &[("\"mass\"", "\"mass\": \"1 t\", \"mass\"")], 5, &["`mass` stands twice"]).of(JSON),
    wrong("twice in the JSON contact", &[("0.1}", "0.1, \"restitution\": 0.1}")], 10, &["`restitution` stands twice"]).of(JSON),
    wrong("twice by an escape in JSON", &[("0.1}", "0.1, \"\\u0072estitution\": 0}")], 10, &["`restitution` stands twice"]).of(JSON),
];

#[test]
fn keys() {
    check(BAD);
}
