//! Coefficients out of their range.

use super::{Bad, check, wrong};

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    wrong("restitution above one", &[("= 0.1\n", "= 1.01\n")], 23, &["contact.restitution", "from 0 to 1"]),
    wrong("restitution a hair above one", &[("= 0.1\n", "= 1.0000000000000002\n")], 23, &["contact.restitution", "from 0 to 1"]),
    wrong("restitution below zero", &[("= 0.1\n", "= -0.1\n")], 23, &["contact.restitution", "from 0 to 1"]),
    wrong("restitution meant in percent", &[("= 0.1\n", "= 15\n")], 23, &["contact.restitution", "\"15 %\""]),
    wrong("restitution of 115 percent", &[("= 0.1\n", "= \"115 %\"\n")], 23, &["contact.restitution", "from 0 to 1"]),
    wrong("friction below zero", &[("= 0.1\n", "= 0.1\nfriction = -0.4\n")], 24, &["contact.friction", "at least 0"]),
    wrong("friction out of all proportion", &[("= 0.1\n", "= 0.1\nfriction = 1e7\n")], 24, &["contact.friction", "too large"]),
    // Accepted: the ends of each range.
    wrong("restitution of zero", &[("= 0.1\n", "= 0\n")], 0, &[]).ends(0),
    wrong("restitution of minus zero", &[("= 0.1\n", "= -0.0\n")], 0, &[]).ends(0),
    wrong("elastic and frictionless", &[("= 0.1\n", "= 1\nimpulse_ratio = 0\n")], 0, &[]).ends(0),
    wrong("elastic both ways", &[("= 0.1\n", "= 1\ntangential_law = \"kudlich-slibar\"\n")], 0, &[]).ends(0),
    wrong("friction of zero", &[("= 0.1\n", "= 0.1\nfriction = 0\n")], 0, &[]).ends(0),
    wrong("friction without limit", &[("= 0.1\n", "= 0.1\nfriction = 1000\n")], 0, &[]).ends(0),
    wrong("none of critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = 0 }\n")], 0, &[]).ends(0),
    wrong("all of critical", &[("= 0.1\n", "= 0.1\nimpulse_ratio = { of_critical = 1 }\n")], 0, &[]).ends(0),
    wrong("restitution of 30 digits", &[("= 0.1\n", "= 0.100000000000000000000000000001\n")], 0, &[]).ends(0),
];

#[test]
fn contact() {
    check(BAD);
}
