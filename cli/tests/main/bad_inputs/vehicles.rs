//! The number of vehicles, and of walls among them.

use super::{Bad, WALL, check, wrong};

const SECOND: &str = "[[vehicle]]\nname = \"wall\"\nbarrier = true\n";

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    wrong("one vehicle", &[(SECOND, "")], 4, &["exactly two vehicles; found 1 table", "barrier = true"]).of(WALL),
    wrong("three vehicles", &[("[contact]", "[[vehicle]]\nbarrier = true\n[contact]")], 4, &["exactly two vehicles; found 3 tables"]),
    wrong("no vehicle in the list", &[], 1, &["exactly two vehicles; found 0 tables"])
        .of("{\"schema\": 1, \"vehicle\": [], \"contact\": {\"crush_plane\": 0, \"restitution\": 0}}"),
    wrong(
        "two walls",
        &[("mass = 1200\nyaw_inertia = 2000\nheading = \"0 deg\"\nvelocity = [10, 2]\nimpact_center = [2, 0.5]\n", "barrier = true\n")],
        4,
        &["vehicle", "both parties are fixed barriers"],
    )
    .of(WALL),
    wrong("a wall that is none", &[("barrier = true", "barrier = false")], 12, &["vehicle.2.mass: missing"]).of(WALL),
    wrong("a wall that is none and has a mass", &[("barrier = true", "barrier = false\nmass = 3")], 12, &["vehicle.2.heading: missing"])
        .of(WALL),
    // Accepted.
    wrong("a vehicle that says it is no wall", &[("mass = 1200", "mass = 1200\nbarrier = false")], 0, &[]).of(WALL).ends(0),
    wrong("a wall without a name", &[("name = \"wall\"\n", "")], 0, &[]).of(WALL).ends(0),
    wrong("a name of every character", &[("\"sedan\"", "\"a \\\"b\\\" \\\\ \\u0007 \\u001b[31m\\n é 車\"")], 0, &[]).ends(0),
];

#[test]
fn vehicles() {
    check(BAD);
}
