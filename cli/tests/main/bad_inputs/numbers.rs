//! Invalid numbers, numbers beyond the range of a float, and impossible values.

use super::{Bad, CRUSHED, JSON, check, wrong};

const MASS: &str = "mass = \"2564 lb\"";
const INERTIA: &str = "yaw_inertia = \"1434.9 lbf s^2 ft\"";
const HEADING: &str = "heading = \"180 deg\"";
const SPEED: &str = "speed = \"40 ft/s\"";
const YAW_RATE: &str = "yaw_rate = \"0 deg/s\"";
const CENTER: &str = "impact_center = [\"6.3499 ft\", \"0 ft\"]";
const PLANE: &str = "crush_plane = \"0 deg\"";
const RESTITUTION: &str = "restitution = 0.1";
const LAST: &str = "restitution = 0.1\n";

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    // Impossible crush.
    wrong("no width of crush", &[("\"5 ft\"", "\"0 ft\"")], 16, &["vehicle.2.crush.width", "above zero"]).of(CRUSHED),
    wrong("crush outwards", &[("4.1 in", "-4.1 in")], 17, &["vehicle.2.crush.depths.2", "below zero"]).of(CRUSHED),
    wrong("negative d0", &[("48.27", "-48.27")], 18, &["vehicle.2.crush.stiffness.d0", "below zero"]).of(CRUSHED),
    // Not finite, or outside the range of a float.
    wrong("mass nan", &[(MASS, "mass = nan")], 6, &["vehicle.1.mass", "`nan` is not a finite number"]),
    wrong("mass -inf", &[(MASS, "mass = -inf")], 6, &["vehicle.1.mass", "not a finite number"]),
    wrong("mass nan kg", &[(MASS, "mass = \"nan kg\"")], 6, &["vehicle.1.mass", "`nan kg`"]),
    wrong("mass inf kg", &[(MASS, "mass = \"inf kg\"")], 6, &["vehicle.1.mass", "`inf kg`"]),
    wrong("mass 1e999", &[(MASS, "mass = 1e999")], 6, &["vehicle.1.mass", "too large"]),
    wrong("mass 1e999 kg", &[(MASS, "mass = \"1e999 kg\"")], 6, &["vehicle.1.mass", "too large"]),
    wrong("mass 1e-400", &[(MASS, "mass = 1e-400")], 6, &["vehicle.1.mass", "too small", "zero"]),
    wrong("mass 1e-400 kg", &[(MASS, "mass = \"1e-400 kg\"")], 6, &["vehicle.1.mass", "too small"]),
    wrong("inertia inf", &[(INERTIA, "yaw_inertia = inf")], 7, &["vehicle.1.yaw_inertia"]),
    wrong("heading nan", &[(HEADING, "heading = nan")], 8, &["vehicle.1.heading"]),
    wrong("speed nan", &[(SPEED, "speed = nan")], 9, &["vehicle.1.speed"]),
    wrong("speed 1e999", &[(SPEED, "speed = 1e999")], 9, &["vehicle.1.speed"]),
    wrong("velocity nan", &[(SPEED, "velocity = [\"-40 ft/s\", nan]")], 9, &["vehicle.1.velocity.2"]),
    wrong("yaw rate 1e-400", &[(YAW_RATE, "yaw_rate = \"1e-400 rad/s\"")], 10, &["vehicle.1.yaw_rate", "too small"]),
    wrong("center inf", &[(CENTER, "impact_center = [\"inf ft\", 0]")], 11, &["vehicle.1.impact_center.1"]),
    wrong("crush plane inf", &[(PLANE, "crush_plane = inf")], 22, &["contact.crush_plane"]),
    wrong("restitution nan", &[(RESTITUTION, "restitution = nan")], 23, &["contact.restitution"]),
    wrong("restitution 1e-400", &[(RESTITUTION, "restitution = 1e-400")], 23, &["contact.restitution", "too small"]),
    wrong("impulse ratio inf", &[(LAST, "restitution = 0.1\nimpulse_ratio = inf\n")], 24, &["contact.impulse_ratio"]),
    wrong(
        "fraction nan",
        &[(LAST, "restitution = 0.1\nimpulse_ratio = { of_critical = nan }\n")],
        24,
        &["contact.impulse_ratio.of_critical"],
    ),
    wrong("friction 1e999", &[(LAST, "restitution = 0.1\nfriction = 1e999\n")], 24, &["contact.friction"]),
    wrong("JSON NaN", &[("0.1}", "NaN}")], 10, &["not JSON"]).of(JSON),
    wrong("JSON Infinity", &[("0.1}", "-Infinity}")], 10, &["not JSON"]).of(JSON),
    wrong("JSON 1e999", &[("\"2564 lb\"", "1e999")], 5, &["vehicle.1.mass", "too large"]).of(JSON),
    wrong("JSON 1e-400", &[("\"2564 lb\"", "1e-400")], 5, &["vehicle.1.mass", "too small"]).of(JSON),
    // Quantities that must be above zero.
    wrong("mass zero", &[(MASS, "mass = 0")], 6, &["vehicle.1.mass", "above zero", "barrier = true"]),
    wrong("mass minus zero", &[(MASS, "mass = -0.0")], 6, &["vehicle.1.mass", "above zero"]),
    wrong("mass negative", &[(MASS, "mass = \"-2564 lb\"")], 6, &["vehicle.1.mass", "above zero"]),
    wrong("inertia zero", &[(INERTIA, "yaw_inertia = 0.0")], 7, &["vehicle.1.yaw_inertia", "above zero"]),
    wrong("inertia negative", &[(INERTIA, "yaw_inertia = \"-1 kg m^2\"")], 7, &["vehicle.1.yaw_inertia", "above zero"]),
    wrong("radius zero", &[(INERTIA, "radius_of_gyration = \"0 m\"")], 7, &["vehicle.1.radius_of_gyration", "above zero"]),
    // Its square is zero.
    wrong(
        "radius tiny",
        &[(INERTIA, "radius_of_gyration = \"1e-170 m\"")],
        7,
        &["vehicle.1.radius_of_gyration", "the yaw inertia that follows from it", "1 m to 2 m"],
    ),
    wrong("radius negative", &[(INERTIA, "radius_of_gyration = \"-1.3 m\"")], 7, &["vehicle.1.radius_of_gyration", "above zero"]),
    // Plausible only in another unit.
    wrong("heading in degrees, bare", &[(HEADING, "heading = 180")], 8, &["vehicle.1.heading", "180 rad", "\"180 deg\""]),
    wrong("crush plane in degrees, bare", &[(PLANE, "crush_plane = 45")], 22, &["contact.crush_plane", "\"45 deg\""]),
    wrong("yaw rate in degrees, bare", &[(YAW_RATE, "yaw_rate = 90")], 10, &["vehicle.1.yaw_rate", "\"90 deg/s\""]),
    wrong("speed of 200, bare", &[(SPEED, "speed = 200")], 9, &["vehicle.1.speed", "\"200 km/h\""]),
    wrong("length of 2500, bare", &[(CENTER, "impact_center = [2500, 0]")], 11, &["vehicle.1.impact_center.1", "\"2500 mm\""]),
    wrong("mass of 1e7, bare", &[(MASS, "mass = 1e7")], 6, &["vehicle.1.mass", "not a plausible mass"]),
    wrong("mass of 26 digits, bare", &[(MASS, "mass = 25640000000000000000000000")], 6, &["vehicle.1.mass", "not a plausible mass"]),
    wrong("inertia of 1e10, bare", &[(INERTIA, "yaw_inertia = 1e10")], 7, &["vehicle.1.yaw_inertia", "not a plausible yaw inertia"]),
    wrong("mass of 1e300 kg", &[(MASS, "mass = \"1e300 kg\"")], 6, &["vehicle.1.mass", "too large"]),
    wrong("angle of a million turns", &[(PLANE, "crush_plane = \"3.6e8 deg\"")], 22, &["contact.crush_plane", "too large"]),
    // Texts that are not numbers.
    wrong("decimal comma", &[(MASS, "mass = \"1163,1 kg\"")], 6, &["vehicle.1.mass", "write 1163.1"]),
    wrong("thousands comma", &[(MASS, "mass = \"2,564 lb\"")], 6, &["vehicle.1.mass", "write 2564 or 2.564"]),
    wrong("underscore", &[(MASS, "mass = \"1_163 kg\"")], 6, &["vehicle.1.mass", "write 1163"]),
    wrong("two signs", &[(SPEED, "speed = \"--40 ft/s\"")], 9, &["vehicle.1.speed", "does not begin with a number"]),
    wrong("minus of typography", &[(SPEED, "speed = \"−40 ft/s\"")], 9, &["vehicle.1.speed", "ordinary minus"]),
    wrong("digits of another script", &[(MASS, "mass = \"١١٦٣ kg\"")], 6, &["vehicle.1.mass"]),
    wrong("hexadecimal text", &[(MASS, "mass = \"0x10 kg\"")], 6, &["vehicle.1.mass"]),
    wrong("hexadecimal number", &[(MASS, "mass = 0x10")], 6, &["vehicle.1.mass", "hexadecimal"]),
    wrong("empty text", &[(MASS, "mass = \"\"")], 6, &["vehicle.1.mass", "empty"]),
    wrong("blank text", &[(MASS, "mass = \"  \"")], 6, &["vehicle.1.mass", "empty"]),
    wrong(
        "an overhang beyond the length",
        &[("mass = \"2564 lb\"", "mass = \"2564 lb\"\nlength = 4\nfront_overhang = 4")],
        8,
        &["vehicle.1.front_overhang", "it is 4 m; it must be below the length, 4 m"],
    ),
];

#[test]
fn numbers() {
    check(BAD);
}
