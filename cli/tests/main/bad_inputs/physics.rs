//! Impossible collisions, which end with status 3.

use super::{Bad, COLLISION, WALL, check, wrong};

const CLOSE: &[&str] = &["contact: vehicles are not approaching each other"];
const SEPARATE: &[&str] = &["contact: vehicles are separating"];
const BEYOND: &[&str] = &["contact.impulse_ratio", "beyond the critical one", "must be from 0 to"];
const OF_CRITICAL: &[&str] =
    &["contact.impulse_ratio.of_critical", "of the critical ratio; it must be from 0 to 1", "1 is the critical ratio itself"];
const GAIN: &[&str] = &["would gain energy"];

/// Creates a mistake that the mechanics refuses in the file of two vehicles; the line is that of `[contact]` or of the ratio.
const fn refused(name: &'static str, edits: &'static [(&'static str, &'static str)], line: usize, says: &'static [&'static str]) -> Bad {
    wrong(name, edits, line, says).ends(3)
}

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    // Not closing. The cosine of a right angle in degrees is not exactly zero in floats; the remainder does not count as an approach.
    refused("driving apart", &[("speed = \"40 ft/s\"", "velocity = [\"80 ft/s\", 0]")], 21, SEPARATE),
    refused("reversing out of it", &[("40 ft/s", "-40 ft/s")], 21, SEPARATE),
    refused("crush plane that turns it into driving apart", &[("crush_plane = \"0 deg\"", "crush_plane = \"-48 deg\"")], 21, SEPARATE),
    refused("both at rest", &[("40 ft/s", "0 ft/s"), ("41 ft/s", "0 ft/s")], 21, CLOSE),
    refused("side by side at the same speed", &[("speed = \"40 ft/s\"", "velocity = [0, \"41 ft/s\"]")], 21, CLOSE),
    refused("backing away from a wall", &[("[10, 2]", "[-10, 2]")], 16, SEPARATE).of(WALL),
    refused(
        "along a wall, heading 90 deg",
        &[("\"0 deg\"\nvelocity = [10, 2]", "\"90 deg\"\nspeed = 20"), ("[2, 0.5]", "[2, -1]")],
        16,
        CLOSE,
    )
    .of(WALL),
    refused(
        "along a wall, heading 270 deg",
        &[("\"0 deg\"\nvelocity = [10, 2]", "\"270 deg\"\nspeed = 20"), ("[2, 0.5]", "[2, 1]")],
        16,
        CLOSE,
    )
    .of(WALL),
    refused(
        "along a wall turned by 90 deg",
        &[("velocity = [10, 2]", "speed = 20"), ("[2, 0.5]", "[2, 1]"), ("crush_plane = \"0 deg\"", "crush_plane = \"90 deg\"")],
        16,
        CLOSE,
    )
    .of(WALL),
    refused(
        "along a wall turned by 450 deg",
        &[("velocity = [10, 2]", "speed = 20"), ("[2, 0.5]", "[2, 1]"), ("crush_plane = \"0 deg\"", "crush_plane = \"450 deg\"")],
        16,
        CLOSE,
    )
    .of(WALL),
    refused("a wall in the center of mass", &[("[2, 0.5]", "[0, 0]")], 16, CLOSE).of(WALL),
    refused("a wall at rest", &[("[10, 2]", "[0, 0]")], 16, CLOSE).of(WALL),
    // The normal impulse is tensile.
    refused(
        "sliding that does not end by pushing",
        &[("[10, 2]", "[5, -25]"), ("0.5]", "0.8]")],
        16,
        &["contact", "normal impulse is tensile"],
    )
    .of(WALL),
    // More energy after the impact than before: unit mass and inertia at an arm of (-1, 1).
    refused(
        "elastic at an oblique arm",
        &[("1200", "1"), ("2000", "1"), ("[10, 2]", "[-3, -2]"), ("[2, 0.5]", "[-1, 1]"), ("restitution = 0", "restitution = 1")],
        18,
        &["contact.restitution", "would gain energy"],
    )
    .of(WALL),
    refused(
        "elastic, with spin in the contact",
        &[("[10, 2]", "[10, 12]"), ("0.5]", "-0.8]"), ("restitution = 0", "restitution = 1")],
        18,
        GAIN,
    )
    .of(WALL),
    // A moment impulse that adds more than the impact takes, which no restitution is at fault for.
    refused(
        "a moment that gains",
        &[("= 0.1\n", "= 0.1\nmoment = \"-20 kN m s\"\n")],
        24,
        &["contact.moment", "would gain energy", "the moment impulse adds the energy"],
    ),
    // Ratios.
    refused("beyond critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = 0.9\n")], 24, BEYOND),
    refused("a hair beyond critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = 0.626\n")], 24, BEYOND),
    refused("of the wrong sign", &[("= 0.1\n", "= 0.1\nimpulse_ratio = -0.3\n")], 24, BEYOND),
    refused("tiny, of the wrong sign", &[("= 0.1\n", "= 0.1\nimpulse_ratio = -1e-6\n")], 24, BEYOND),
    refused("beyond the sticking ratio", &[("= 0.1\n", "= 0.1\nimpulse_ratio = 0.9\ntangential_law = \"kudlich-slibar\"\n")], 24, BEYOND),
    refused("more than all of critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = 1.2 }\n")], 24, OF_CRITICAL),
    refused("less than none of critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = -0.2 }\n")], 24, OF_CRITICAL),
    // Accepted: just within the limits, and a remedy for a tensile impulse.
    wrong("a hair within critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = 0.6259\n")], 0, &[]).ends(0),
    wrong("sliding limited by friction", &[("[10, 2]", "[5, -25]"), ("0.5]", "0.8]"), ("= 0\n", "= 0\nfriction = 0.4\n")], 0, &[])
        .of(WALL)
        .ends(0),
    wrong("a tiny closing speed", &[("speed = \"40 ft/s\"", "velocity = [\"-1e-6 m/s\", 0]"), ("41 ft/s", "0 ft/s")], 0, &[])
        .of(COLLISION)
        .ends(0),
];

#[test]
fn physics() {
    check(BAD);
}
