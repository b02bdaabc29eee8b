//! Units of the wrong dimension, unknown units, and missing units.

use super::{Bad, CRUSHED, check, wrong};

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    // One wrong dimension for each kind of quantity.
    wrong("mass in ft", &[("2564 lb", "2564 ft")], 6, &["vehicle.1.mass", "`2564 ft` is a length; a mass is expected"]),
    wrong("mass in no unit", &[("2564 lb", "2564 furlong")], 6, &["vehicle.1.mass", "unknown unit `furlong`", "expected a mass, such as"]),
    wrong("mass in lbf", &[("2564 lb", "2564 lbf")], 6, &["vehicle.1.mass", "is a force", "give it as `weight`"]),
    wrong("inertia in lb ft", &[("1434.9 lbf s^2 ft", "1434.9 lb ft")], 7, &["vehicle.1.yaw_inertia", "yaw inertia is expected"]),
    wrong(
        "radius in kg",
        &[("yaw_inertia = \"1434.9 lbf s^2 ft\"", "radius_of_gyration = \"1.3 kg\"")],
        7,
        &["vehicle.1.radius_of_gyration", "a length is expected"],
    ),
    wrong("heading in m", &[("180 deg", "180 m")], 8, &["vehicle.1.heading", "an angle is expected"]),
    wrong("heading in deg/s", &[("180 deg", "180 deg/s")], 8, &["vehicle.1.heading", "is a yaw rate; an angle is expected"]),
    wrong("speed in ft", &[("40 ft/s", "40 ft")], 9, &["vehicle.1.speed", "a speed is expected"]),
    wrong(
        "velocity in s",
        &[("speed = \"40 ft/s\"", "velocity = [\"-40 ft/s\", \"0 s\"]")],
        9,
        &["vehicle.1.velocity.2", "is a duration; a speed is expected"],
    ),
    wrong("yaw rate in deg", &[("0 deg/s", "10 deg")], 10, &["vehicle.1.yaw_rate", "is an angle; a yaw rate is expected"]),
    wrong("yaw rate in 1/s", &[("0 deg/s", "1 m/s/m")], 10, &["vehicle.1.yaw_rate", "a yaw rate is expected"]),
    wrong("center in s", &[("6.3499 ft", "6.3 s")], 11, &["vehicle.1.impact_center.1", "a length is expected"]),
    wrong("crush plane in ft", &[("\"0 deg\"\nrest", "\"1 ft\"\nrest")], 22, &["contact.crush_plane", "an angle is expected"]),
    wrong("restitution in m", &[("= 0.1\n", "= \"0.1 m\"\n")], 23, &["contact.restitution", "a pure number is expected"]),
    wrong("friction in N", &[("= 0.1\n", "= 0.1\nfriction = \"0.4 N\"\n")], 24, &["contact.friction", "is a force"]),
    wrong(
        "fraction in deg",
        &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = \"0.9 deg\" }\n")],
        24,
        &["contact.impulse_ratio.of_critical", "is an angle"],
    ),
    // Crush.
    wrong("width in kg", &[("5 ft", "5 kg")], 16, &["vehicle.2.crush.width", "a length is expected"]).of(CRUSHED),
    wrong("depth in s", &[("4.1 in", "4.1 s")], 17, &["vehicle.2.crush.depths.2", "a length is expected"]).of(CRUSHED),
    wrong("d0 in lbf", &[("48.27 lbf^0.5", "48.27 lbf")], 18, &["vehicle.2.crush.stiffness.d0", "is a force"]).of(CRUSHED),
    wrong("d1 in lbf^0.5", &[("lbf^0.5/ft", "lbf^0.5")], 18, &["vehicle.2.crush.stiffness.d1", "root of a force per length"]).of(CRUSHED),
    wrong(
        "A in N/m^2",
        &[("{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }", "{ A = \"300 N/m^2\", B = \"50 lbf/in^2\" }")],
        18,
        &["vehicle.2.crush.stiffness.A", "force per length"],
    )
    .of(CRUSHED),
    wrong(
        "B in lbf/in",
        &[("{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }", "{ A = \"300 lbf/in\", B = \"50 lbf/in\" }")],
        18,
        &["vehicle.2.crush.stiffness.B", "force per area"],
    )
    .of(CRUSHED),
    wrong(
        "b0, b1, mass and width of the test in each other's units",
        &[(
            "{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }",
            "{ b0 = \"5 ft\", b1 = \"25 mph\", test_mass = \"60 in\", test_width = \"3000 lb\" }",
        )],
        18,
        &["stiffness.b0", "stiffness.b1", "stiffness.test_mass", "stiffness.test_width"],
    )
    .of(CRUSHED),
    // Unknown and unfinished units.
    wrong("unknown unit", &[("2564 lb", "2564 stone")], 6, &["vehicle.1.mass", "unknown unit `stone`"]),
    wrong("unit misspelled", &[("40 ft/s", "40 mhp")], 9, &["vehicle.1.speed", "did you mean `mph`"]),
    wrong("unit with the prefix of another", &[("2564 lb", "1163 Mg")], 6, &["vehicle.1.mass", "unknown unit `Mg`", "`tonne`"]),
    wrong("a ton", &[("2564 lb", "1.2 ton")], 6, &["vehicle.1.mass", "unknown unit `ton`", "write `lb`, `kg` or `tonne`"]),
    wrong("words behind the unit", &[("2564 lb", "2564 lb or so")], 6, &["vehicle.1.mass", "unknown unit `or`"]),
    wrong("unit that ends in a slash", &[("40 ft/s", "40 ft/")], 9, &["vehicle.1.speed", "missing in `ft/`"]),
    wrong("two slashes", &[("40 ft/s", "40 ft//s")], 9, &["vehicle.1.speed", "missing in `ft//s`"]),
    wrong("huge power", &[("40 ft/s", "40 ft^99999999999999999999")], 9, &["vehicle.1.speed", "exponent"]),
    wrong("product behind a slash", &[("40 ft/s", "40 J/kg m")], 9, &["vehicle.1.speed", "two ways"]),
    // No unit, or no number.
    wrong("number in quotes without a unit", &[("2564 lb", "1163")], 6, &["vehicle.1.mass", "has no unit"]),
    wrong("unit without a number", &[("2564 lb", "lb")], 6, &["vehicle.1.mass", "does not begin with a number"]),
    wrong("quantity without quotes", &[("\"2564 lb\"", "2564 lb")], 6, &["not TOML", "quotes"]),
    // Accepted.
    wrong("restitution in percent", &[("= 0.1\n", "= \"15 %\"\n")], 0, &[]).ends(0),
    wrong("no space before the unit", &[("2564 lb", "2564lb")], 0, &[]).ends(0),
    wrong("unit in capitals", &[("2564 lb", "1163 KG")], 0, &[]).ends(0),
    wrong("feet and inches", &[("6.3499 ft", "6 ft 4.2 in")], 0, &[]).ends(0),
    wrong("plus sign", &[("40 ft/s", "+40 ft/s")], 0, &[]).ends(0),
];

#[test]
fn units() {
    check(BAD);
}
