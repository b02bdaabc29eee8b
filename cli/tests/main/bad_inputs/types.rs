//! Values of the wrong type.

use super::{Bad, CRUSHED, JSON, WALL, check, wrong};

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    wrong("schema 2", &[("schema = 1", "schema = 2")], 1, &["schema: expected", "`2`"]),
    wrong("schema 0", &[("schema = 1", "schema = 0")], 1, &["schema: expected"]),
    wrong("schema in quotes", &[("schema = 1", "schema = \"1\"")], 1, &["schema: expected", "a string"]),
    wrong("schema 1.0", &[("schema = 1", "schema = 1.0")], 1, &["schema: expected", "`1.0`"]),
    wrong("schema true", &[("schema = 1", "schema = true")], 1, &["schema: expected", "a boolean"]),
    wrong("title a number", &[("\"a case\"", "5")], 2, &["title: expected a string"]),
    wrong("name a number", &[("\"sedan\"", "5")], 5, &["vehicle.1.name: expected a string"]),
    wrong("mass a boolean", &[("\"2564 lb\"", "true")], 6, &["vehicle.1.mass", "found a boolean"]),
    wrong("mass an array", &[("\"2564 lb\"", "[1]")], 6, &["vehicle.1.mass", "found an array"]),
    wrong("mass a table", &[("\"2564 lb\"", "{ value = 1 }")], 6, &["vehicle.1.mass", "missing `sd`, `relative` or `resolution`"]),
    wrong("mass a date", &[("\"2564 lb\"", "2020-01-01")], 6, &["vehicle.1.mass", "found a date"]),
    wrong("mass null", &[("\"2564 lb\"", "null")], 5, &["vehicle.1.mass", "found null"]).of(JSON),
    wrong("heading a word", &[("180 deg", "west")], 8, &["vehicle.1.heading", "does not begin with a number"]),
    wrong("speed an array", &[("\"40 ft/s\"", "[1, 2]")], 9, &["vehicle.1.speed", "found an array"]),
    wrong("velocity a number", &[("speed = \"40 ft/s\"", "velocity = 3")], 9, &["vehicle.1.velocity", "array of two"]),
    wrong("velocity of one", &[("speed = \"40 ft/s\"", "velocity = [3]")], 9, &["vehicle.1.velocity", "found 1 value"]),
    wrong("velocity of three", &[("speed = \"40 ft/s\"", "velocity = [3, 4, 5]")], 9, &["vehicle.1.velocity", "found 3 values"]),
    wrong("velocity of words", &[("speed = \"40 ft/s\"", "velocity = [\"x\", true]")], 9, &["velocity.1", "velocity.2"]),
    wrong("center of three", &[("\"0 ft\"]", "\"0 ft\", 0]")], 11, &["vehicle.1.impact_center", "found 3 values"]),
    wrong("center empty", &[("[\"6.3499 ft\", \"0 ft\"]", "[]")], 11, &["vehicle.1.impact_center", "found 0 values"]),
    wrong("center a table", &[("[\"6.3499 ft\", \"0 ft\"]", "{ forward = 1 }")], 11, &["vehicle.1.impact_center", "found a table"]),
    wrong("vehicles not an array", &[("[[vehicle]]\nname = \"sedan\"", "[vehicle]\nname = \"sedan\"")], 0, &["case.toml:13:"]),
    wrong("contact an array", &[("[contact]", "[[contact]]")], 21, &["contact: expected a table"]),
    wrong("restitution a word", &[("= 0.1", "= \"critical\"")], 23, &["contact.restitution"]),
    wrong("restitution a boolean", &[("= 0.1", "= true")], 23, &["contact.restitution", "found a boolean"]),
    wrong(
        "impulse ratio another word",
        &[("= 0.1", "= 0.1\nimpulse_ratio = \"Critical\"")],
        24,
        &["contact.impulse_ratio", "did you mean \"critical\"?"],
    ),
    wrong("impulse ratio an array", &[("= 0.1", "= 0.1\nimpulse_ratio = [0.3]")], 24, &["contact.impulse_ratio"]),
    wrong("impulse ratio an empty table", &[("= 0.1", "= 0.1\nimpulse_ratio = {}")], 24, &["impulse_ratio.of_critical: missing"]),
    wrong("fraction a boolean", &[("= 0.1", "= 0.1\nimpulse_ratio = { of_critical = true }")], 24, &["of_critical", "found a boolean"]),
    wrong("friction a word", &[("= 0.1", "= 0.1\nfriction = \"wet\"")], 24, &["contact.friction"]),
    wrong("law another word", &[("= 0.1", "= 0.1\ntangential_law = \"coulomb\"")], 24, &["contact.tangential_law", "`coulomb`"]),
    wrong("law misspelled", &[("= 0.1", "= 0.1\ntangential_law = \"Brach\"")], 24, &["tangential_law", "did you mean \"brach\""]),
    wrong("law a number", &[("= 0.1", "= 0.1\ntangential_law = 1")], 24, &["contact.tangential_law", "found a number"]),
    wrong("barrier a word", &[("barrier = true", "barrier = \"yes\"")], 14, &["vehicle.2.barrier: expected true or false"]).of(WALL),
    wrong("barrier a number", &[("barrier = true", "barrier = 1")], 14, &["vehicle.2.barrier: expected true or false"]).of(WALL),
    wrong("crush a number", &[("mass = 1200", "crush = 3\nmass = 1200")], 6, &["vehicle.1.crush: expected a table"]).of(WALL),
    wrong("one depth", &[("[\"3 in\", \"4.1 in\", \"5 in\", \"2 in\"]", "[\"3 in\"]")], 17, &["depths", "at least 2", "found 1 value"])
        .of(CRUSHED),
    wrong("depths a text", &[("[\"3 in\", \"4.1 in\", \"5 in\", \"2 in\"]", "\"3 in\"")], 17, &["vehicle.2.crush.depths"]).of(CRUSHED),
    wrong("stiffness a text", &[("{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }", "\"soft\"")], 18, &["crush.stiffness"])
        .of(CRUSHED),
    wrong("JSON contact an array", &[("{\"crush_plane\": \"0 deg\", \"restitution\": 0.1}", "[0, 0.1]")], 10, &["contact: expected"])
        .of(JSON),
    wrong("JSON vehicle a number", &[("\"vehicle\": [", "\"vehicle\": [3,")], 4, &["vehicle.1: expected a table"]).of(JSON),
    wrong("JSON root an array", &[], 1, &["expected an object, found an array"]).of("[1, 2]"),
    wrong("JSON root an array of a case", &[], 1, &["expected an object"]).of("[{\"schema\": 1}]\n"),
];

#[test]
fn types() {
    check(BAD);
}
