//! Uncertain inputs and correlations that must be refused, and forms that must be accepted.

use super::{Bad, CRUSHED, RESTED, WALL, check, check_with, wrong};

/// Two vehicles whose masses are uncertain, with room for correlations in line 3.
const LOADED: &str = r#"schema = 1
title = "two masses"
correlation = []

[[vehicle]]
mass = "2564 lb ± 50 lb"
yaw_inertia = "1434.9 lbf s^2 ft"
heading = "180 deg"
speed = "40 ft/s"
impact_center = ["6.3499 ft", "0 ft"]

[[vehicle]]
mass = "6345 lb ± 2 %"
yaw_inertia = { value = "5192.4 lbf s^2 ft", relative = 0.05 }
heading = "90 deg"
speed = "41 ft/s"
impact_center = ["7.96804 ft", "-3.2356 ft"]

[contact]
crush_plane = "0 deg"
restitution = 0.1
"#;

const MASS: &str = "mass = \"2564 lb\"";
const E: &str = "restitution = 0.1";

const fn loaded(name: &'static str, correlation: &'static [(&'static str, &'static str)], says: &'static [&'static str]) -> Bad {
    wrong(name, correlation, 3, says).of(LOADED)
}

const fn mass(name: &'static str, edit: &'static [(&'static str, &'static str)], says: &'static [&'static str]) -> Bad {
    wrong(name, edit, 6, says)
}

const fn restitution(name: &'static str, edit: &'static [(&'static str, &'static str)], says: &'static [&'static str]) -> Bad {
    wrong(name, edit, 23, says)
}

pub(super) const BAD: &[Bad] = &[
    restitution(
        "a curve whose closing speeds fall",
        &[(E, "restitution = { closing_speed = [\"9 m/s\", \"5 m/s\"], restitution = [0.1, 0.3] }")],
        &["contact.restitution.closing_speed.2: the closing speed is not above the one before it", "in the order of their closing speeds"],
    ),
    restitution(
        "a percentage with a deviation that is none",
        &[(E, "restitution = \"10 % ± 2\"")],
        &["contact.restitution: the value is in percent, and its standard deviation is not", "write both as numbers, or \"10 % ± 2 %\""],
    ),
    restitution(
        "a curve of one point",
        &[(E, "restitution = { closing_speed = [\"9 m/s\"], restitution = [0.1] }")],
        &["contact.restitution.closing_speed: a curve needs at least two points; it has 1", "restitution = 0.2"],
    ),
    restitution(
        "a curve in two units",
        &[(E, "restitution = { closing_speed = [\"5 mph\", 15, \"30 mph\"], restitution = [0.3, 0.2, 0.1] }")],
        &["closing_speed.3: the closing speed is not above the one before it", "a closing speed without one is in m/s"],
    ),
    restitution(
        "a curve from the fastest to the slowest",
        &[(E, "restitution = { closing_speed = [0, \"30 mph\", \"5 mph\"], restitution = [0.1, 0.2, 0.3] }")],
        &["closing_speed.3: the closing speed is not above the one before it", "in the order of their closing speeds"],
    ),
    restitution(
        "a curve with a restitution above 1",
        &[(E, "restitution = { closing_speed = [\"5 m/s\", \"9 m/s\"], restitution = [1.3, 0.1] }")],
        &["contact.restitution.restitution.1: it is 1.3; it must be from 0 to 1"],
    ),
    restitution(
        "a curve with a negative deviation",
        &[(E, "restitution = { closing_speed = [\"5 m/s\", \"9 m/s\"], restitution = [0.3, 0.1], sd = -0.1 }")],
        &["contact.restitution.sd: it is -0.1; it must be from 0 to 1"],
    ),
    restitution(
        "a curve of other lengths",
        &[(E, "restitution = { closing_speed = [\"5 m/s\", \"9 m/s\"], restitution = [0.3, 0.2, 0.1], sd = [0.1, 0.1, 0.1] }")],
        &[
            "contact.restitution.restitution: it has 3 values for 2 closing speeds",
            "contact.restitution.sd: it has 3 values",
            "give one for each",
        ],
    ),
    restitution(
        "a curve with one deviation in a list",
        &[(E, "restitution = { closing_speed = [\"5 m/s\", \"9 m/s\"], restitution = [0.3, 0.2], sd = [0.1] }")],
        &["contact.restitution.sd: it has 1 value for 2 closing speeds", "give one for each"],
    ),
    mass("an input with a deviation in m", &[(MASS, "mass = \"2564 lb ± 5 m\"")], &["vehicle.1.mass", "`5 m` is a length; a mass"]),
    mass("an input with a negative deviation", &[(MASS, "mass = \"2564 lb ± -5 lb\"")], &["the standard deviation is below zero"]),
    mass(
        "an input with more than itself",
        &[(MASS, "mass = \"2564 lb ± 500 %\"")],
        &["vehicle.1.mass", "500 % of the value", "at most 100 %"],
    ),
    mass("an input with a negative share", &[(MASS, "mass = \"2564 lb ± -5 %\"")], &["the standard deviation is below zero"]),
    mass("two deviations in a string", &[(MASS, "mass = \"2564 lb ± 5 lb ± 3 lb\"")], &["vehicle.1.mass", "± 3 lb"]),
    mass("an uncertain mass of zero", &[(MASS, "mass = \"0 lb ± 5 lb\"")], &["must be above zero"]),
    mass("an uncertain mass without a unit", &[(MASS, "mass = \"2564 ± 50\"")], &["has no unit"]),
    mass(
        "an input with an sd in m",
        &[(MASS, "mass = { value = \"2564 lb\", sd = \"5 m\" }")],
        &["vehicle.1.mass.sd", "a mass is expected"],
    ),
    mass("an input with a negative sd", &[(MASS, "mass = { value = \"2564 lb\", sd = \"-5 lb\" }")], &["vehicle.1.mass.sd", "below zero"]),
    mass(
        "an input with a negative relative",
        &[(MASS, "mass = { value = \"2564 lb\", relative = -0.1 }")],
        &["vehicle.1.mass.relative", "it is -0.1; it must be from 0 to 1"],
    ),
    wrong(
        "an input that is too large in any unit",
        &[("speed = \"40 ft/s\"", "speed = 1000000")],
        9,
        &["vehicle.1.speed", "`1000000` is too large for a speed"],
    ),
    mass(
        "an input with a percentage as a share",
        &[(MASS, "mass = { value = \"2564 lb\", relative = 5 }")],
        &["vehicle.1.mass.relative", "it is 5; it must be from 0 to 1", "did you mean \"5 %\"?"],
    ),
    mass(
        "an input with sd and relative",
        &[(MASS, "mass = { value = \"2564 lb\", sd = \"5 lb\", relative = 0.1 }")],
        &["more than one of `sd`, `resolution` and `relative`"],
    ),
    mass(
        "an input with resolution and limits",
        &[(MASS, "mass = { value = 1000, resolution = 1, min = 900, max = 1100 }")],
        &["vehicle.1.mass.resolution", "half a step from the value"],
    ),
    mass("an input with min alone", &[(MASS, "mass = { min = \"2500 lb\" }")], &["vehicle.1.mass.max: missing"]),
    mass("an input with max alone", &[(MASS, "mass = { max = \"2500 lb\" }")], &["vehicle.1.mass.min: missing"]),
    mass("an input with a mode alone", &[(MASS, "mass = { mode = \"2500 lb\" }")], &["mass.min: missing", "mass.max: missing"]),
    mass("an input with a median alone", &[(MASS, "mass = { median = \"2500 lb\" }")], &["vehicle.1.mass.factor: missing"]),
    mass("an input with a factor alone", &[(MASS, "mass = { factor = 1.1 }")], &["vehicle.1.mass.median: missing"]),
    mass("an input with an sd alone", &[(MASS, "mass = { sd = \"50 lb\" }")], &["vehicle.1.mass.value: missing"]),
    mass("an input of an empty table", &[(MASS, "mass = {}")], &["vehicle.1.mass.value: missing"]),
    mass("limits of a normal without its sd", &[(MASS, "mass = { value = 1000, min = 900, max = 1100 }")], &["vehicle.1.mass.sd: missing"]),
    mass("one limit of a normal", &[(MASS, "mass = { value = 1000, sd = 50, min = 900 }")], &["vehicle.1.mass.max: missing"]),
    mass(
        "limits of an exact value",
        &[(MASS, "mass = { value = 1000, sd = 0, min = 900, max = 1100 }")],
        &["vehicle.1.mass.sd", "above zero"],
    ),
    mass("an input with min above max", &[(MASS, "mass = { min = 1100, max = 900 }")], &["mass.max", "above `min`, 1100 kg"]),
    mass("an input with min at max", &[(MASS, "mass = { min = 900, max = 900 }")], &["mass.max", "above `min`, 900 kg"]),
    mass(
        "a mode outside",
        &[(MASS, "mass = { min = 900, mode = 1200, max = 1100 }")],
        &["vehicle.1.mass.mode", "it is 1200 kg; it must be from `min`, 900 kg, to `max`, 1100 kg"],
    ),
    mass(
        "a value outside its limits",
        &[(MASS, "mass = { value = 800, sd = 50, min = 900, max = 1100 }")],
        &["vehicle.1.mass.value", "it must be from `min`"],
    ),
    mass(
        "limits in the unit of the file",
        &[(MASS, "mass = { min = \"2000 lb\", mode = \"2500 lb\", max = \"2400 lb\" }")],
        &["vehicle.1.mass.mode: it is 2500 lb; it must be from `min`, 2000 lb, to `max`, 2400 lb"],
    ),
    mass("a factor of one", &[(MASS, "mass = { median = 1000, factor = 1 }")], &["vehicle.1.mass.factor", "it must be above 1"]),
    mass("a factor below one", &[(MASS, "mass = { median = 1000, factor = 0.9 }")], &["vehicle.1.mass.factor", "it must be above 1"]),
    mass("a median of zero", &[(MASS, "mass = { median = 0, factor = 1.1 }")], &["vehicle.1.mass.median", "above zero"]),
    mass(
        "a median and a value",
        &[(MASS, "mass = { median = 1000, factor = 1.1, value = 1000 }")],
        &["vehicle.1.mass.value", "`value` and `median` exclude each other"],
    ),
    mass(
        "a median and an sd",
        &[(MASS, "mass = { median = 1000, sd = 10 }")],
        &["`sd` and `median` exclude each other", "mass.factor: missing"],
    ),
    mass(
        "a mode and a value",
        &[(MASS, "mass = { value = 1000, mode = 1000, sd = 1 }")],
        &["vehicle.1.mass.mode", "`mode` and `value` exclude each other"],
    ),
    mass(
        "limits with an sd and no value",
        &[(MASS, "mass = { min = 900, max = 1100, sd = 1 }")],
        &["vehicle.1.mass.sd", "`sd` and `min` exclude each other", "with `min` go `mode` and `max`"],
    ),
    // Measurements.
    mass("a mean alone", &[(MASS, "mass = { mean = 1000 }")], &["mass.sd: missing", "mass.n: missing", "write `value` instead of `mean`"]),
    mass("a number of measurements alone", &[(MASS, "mass = { n = 3 }")], &["mass.mean: missing", "mass.sd: missing"]),
    mass(
        "a mean that is called a value",
        &[(MASS, "mass = { value = 1000, sd = 10, n = 3 }")],
        &["mass.value: `value` and `n` exclude each other", "with `n` go `mean` and `sd`", "mass.mean: missing"],
    ),
    mass(
        "one measurement",
        &[(MASS, "mass = { mean = 1000, sd = 10, n = 1 }")],
        &["mass.n: expected a whole number from 2 to", "found `1`"],
    ),
    mass("half a measurement", &[(MASS, "mass = { mean = 1000, sd = 10, n = 2.5 }")], &["mass.n: expected a whole number from 2 to"]),
    mass("too many measurements", &[(MASS, "mass = { mean = 1000, sd = 10, n = 4294967296 }")], &["mass.n", "to 4294967295"]),
    mass(
        "measurements without a deviation",
        &[(MASS, "mass = { mean = 1000, sd = 0, n = 3 }")],
        &["mass.sd: it is 0 kg; the standard deviation of measurements must be above zero", "give it alone"],
    ),
    mass(
        "everything wrong with measurements",
        &[(MASS, "mass = { mean = -1000, sd = \"-1 kg\", n = 0 }")],
        &["mass.mean: it is -1000 kg; it must be above zero", "mass.sd: it is -1 kg", "mass.n: expected"],
    ),
    mass("no values", &[(MASS, "mass = { values = [] }")], &["mass.values: it has no value; at least two are needed"]),
    mass("one value", &[(MASS, "mass = { values = [1000] }")], &["mass.values: it has one value", "`value` and `sd`"]),
    mass("equal values", &[(MASS, "mass = { values = [\"1 t\", 1000] }")], &["mass.values: all 2 values are 1000 kg", "give it alone"]),
    mass(
        "bad values",
        &[(MASS, "mass = { values = [1000, \"x\", -5, \"3 m\", true, inf] }")],
        &[
            "mass.values.2: `x` does not begin with a number",
            "mass.values.3: it is -5 kg; it must be above zero",
            "mass.values.4: `3 m` is a length",
            "mass.values.5: expected",
            "mass.values.6",
        ],
    ),
    mass("values that are no array", &[(MASS, "mass = { values = 1000 }")], &["mass.values: expected an array of values"]),
    mass(
        "values and a deviation",
        &[(MASS, "mass = { values = [1000, 1100], sd = 10 }")],
        &["mass.sd: `sd` and `values` exclude each other", "give `values` alone"],
    ),
    mass("a file without a column", &[(MASS, "mass = { file = \"case.toml\" }")], &["mass.column: missing"]),
    mass("a column without a file", &[(MASS, "mass = { column = \"m\" }")], &["mass.file: missing"]),
    mass(
        "a file that is not there",
        &[(MASS, "mass = { file = \"skids.csv\", column = \"m\" }")],
        &["mass.file: ", "skids.csv", "cannot be read"],
    ),
    mass(
        "a file without that column",
        &[(MASS, "mass = { file = \"case.toml\", column = \"m\" }")],
        &["mass.column: case.toml has no column `m`", "its columns are `schema = 1`"],
    ),
    mass("an input with another key", &[(MASS, "mass = { value = 1000, std = 1 }")], &["vehicle.1.mass.std: unknown key"]),
    mass("an input as an array", &[(MASS, "mass = [1000, 50]")], &["vehicle.1.mass", "an array"]),
    mass("an input from crush", &[(MASS, "mass = \"from crush\"")], &["does not begin with a number"]),
    mass("a limit below zero", &[(MASS, "mass = { min = -900, max = 1100 }")], &["vehicle.1.mass.min", "above zero"]),
    mass("a value that is no number", &[(MASS, "mass = { value = true, sd = 1 }")], &["vehicle.1.mass.value"]),
    restitution("a share or a hundredth", &[(E, "restitution = \"0.1 ± 5 %\"")], &["a hundredth or a share", "relative"]),
    restitution(
        "a limit of restitution above one",
        &[(E, "restitution = { min = 0, max = 1.2 }")],
        &["contact.restitution.max", "from 0 to 1"],
    ),
    restitution("an uncertain restitution above one", &[(E, "restitution = \"1.1 ± 0.1\"")], &["contact.restitution", "from 0 to 1"]),
    restitution(
        "a step beyond restitution",
        &[(E, "restitution = { value = 0, resolution = 0.1 }")],
        &["contact.restitution.resolution", "from -0.05  to 0.05 ", "from 0 to 1", "{ min, max }"],
    ),
    restitution(
        "a share of nothing",
        &[(E, "restitution = { value = 0, relative = 0.1 }")],
        &["contact.restitution.relative", "any share of it", "`sd`"],
    ),
    wrong(
        "an uncertain part of a critical ratio beside another key",
        &[(E, "restitution = 0.1\nimpulse_ratio = { of_critical = 1, sd = 0.1 }")],
        24,
        &["contact.impulse_ratio.sd: unknown key"],
    ),
    wrong(
        "a bad share of the critical ratio",
        &[(E, "restitution = 0.1\nimpulse_ratio = { of_critical = { value = 1, sd = -0.1 } }")],
        24,
        &["contact.impulse_ratio.of_critical.sd", "below zero"],
    ),
    wrong(
        "uncertain surfaces",
        &[("crush_plane = \"0 deg\"", "surfaces = [\"0 deg ± 5 deg\", \"45 deg\"]")],
        22,
        &["contact.surfaces.1", "has a standard deviation, and this number takes none"],
    ),
    wrong("half a velocity in kg", &[("[10, 2]", "[\"10 m/s ± 1 kg\", 2]")], 9, &["vehicle.1.velocity.1", "a speed is expected"]).of(WALL),
    wrong("a depth with an sd in kg", &[("\"4.1 in\"", "\"4.1 in ± 1 kg\"")], 17, &["vehicle.2.crush.depths.2", "a length is expected"])
        .of(CRUSHED),
    wrong(
        "an uncertain stiffness below zero",
        &[("d0 = \"48.27 lbf^0.5\"", "d0 = \"-48.27 lbf^0.5 ± 2 lbf^0.5\"")],
        18,
        &["vehicle.2.crush.stiffness.d0", "below zero"],
    )
    .of(CRUSHED),
    wrong("an uncertain axle", &[("front_axle = \"1.2 m\"", "front_axle = \"1.2 m ± 1 cm\"")], 29, &["takes none"]).of(RESTED),
    // Correlations.
    loaded("correlations as a table", &[("[]", "{ a = 1 }")], &["correlation", "an array of correlations"]),
    loaded("a correlation of two", &[("[]", "[[\"m1\", \"m2\"]]")], &["correlation.1", "two names and their coefficient"]),
    loaded(
        "a friction of [rest] that is not there",
        &[("[]", "[[\"rest.friction\", \"m1\", 0.3]]")],
        &["correlation.1.1", "the case gives no uncertainty of rest.friction"],
    ),
    loaded("a correlation without names", &[("[]", "[[1, 2, 0.3]]")], &["correlation.1.1", "correlation.1.2", "a string"]),
    loaded(
        "a correlation of nothing",
        &[("[]", "[[\"vehicle.1.mas\", \"m2\", 0.3]]")],
        &["correlation.1.1", "no input has this name", "did you mean `vehicle.1.mass`?"],
    ),
    loaded(
        "a correlation of a certain input",
        &[("[]", "[[\"m2\", \"vehicle.1.speed\", 0.3]]")],
        &["correlation.1.2", "gives no uncertainty of vehicle.1.speed", "vehicle.1.mass, vehicle.2.mass, vehicle.2.yaw_inertia"],
    ),
    loaded("a correlation of an output", &[("[]", "[[\"m1\", \"energy.loss\", 0.3]]")], &["correlation.1.2", "no input has this name"]),
    loaded(
        "a correlation twice",
        &[("[]", "[[\"m1\", \"m2\", 0.3], [\"vehicle.2.mass\", \"vehicle.1.mass\", 0.3]]")],
        &["correlation.2", "have a coefficient already", "see correlation.1"],
    ),
    loaded("a correlation with itself", &[("[]", "[[\"m1\", \"vehicle.1.mass\", 0.3]]")], &["correlation.1", "with itself"]),
    loaded("a correlation of one", &[("[]", "[[\"m1\", \"m2\", 1]]")], &["correlation.1.3", "between -1 and 1"]),
    loaded("a correlation below minus one", &[("[]", "[[\"m1\", \"m2\", -1.2]]")], &["correlation.1.3", "between -1 and 1"]),
    loaded("a correlation in per cent", &[("[]", "[[\"m1\", \"m2\", 30]]")], &["correlation.1.3", "did you mean \"30 %\"?"]),
    wrong(
        "two strong correlations",
        &[("[]", "[\n[\"m1\", \"m2\", 0.7],\n[\"m1\", \"I2\", -0.8]]")],
        5,
        &["correlation.2", "vehicle.1.mass and vehicle.2.yaw_inertia -0.8, vehicle.1.mass and vehicle.2.mass 0.7"],
    )
    .of(LOADED),
    loaded(
        "impossible correlations",
        &[("[]", "[[\"m1\", \"m2\", 0.9], [\"m1\", \"I2\", 0.9], [\"m2\", \"I2\", -0.9]]")],
        &[
            "correlation.1",
            "not positive definite: vehicle.1.mass and vehicle.2.mass 0.9, vehicle.1.mass and vehicle.2.yaw_inertia 0.9, vehicle.2.mass and vehicle.2.yaw_inertia -0.9",
            "reduce the correlation of vehicle.1.mass and vehicle.2.mass",
        ],
    ),
    wrong(
        "a correlation without uncertain inputs",
        &[("title", "correlation = [[\"m1\", \"m2\", 0.3]]\ntitle")],
        2,
        &["no input of this case"],
    ),
    // Evidence and unknowns of the same number.
    wrong(
        "an uncertain input unknown",
        &[("[contact]", "[unknown]\nvehicle.1.mass = { start = 1000 }\n[contact]")],
        20,
        &["unknown.vehicle.1.mass", "with an uncertainty"],
    )
    .of(LOADED),
    wrong(
        "an uncertain input known exactly",
        &[("[contact]", "[evidence]\nvehicle.1.mass = 1163\n[contact]")],
        20,
        &["evidence.vehicle.1.mass", "exact here"],
    )
    .of(LOADED),
];

#[test]
fn uncertain_inputs_that_are_refused() {
    check_with(BAD, &["uncertainty", "--samples", "1000"]);
    check(BAD);
    check_with(BAD, &["reconstruct"]);
}

#[test]
fn uncertain_inputs_that_cannot_be_solved_for() {
    const EVIDENCE: &str = "[evidence]\ncrush_energy = \"40 kJ ± 2 kJ\"\n[contact]";
    check_with(
        &[
            wrong("uncertain inputs and no question", &[], 0, &["unknown: nothing is unknown"]).of(LOADED),
            wrong(
                "a mean beyond the mechanics",
                &[("[contact]", EVIDENCE), (E, "restitution = { median = 0.9, factor = 2 }")],
                23,
                &["contact.restitution", "must be from 0 to 1"],
            )
            .of(LOADED),
        ],
        &["reconstruct"],
    );
}

#[test]
fn uncertain_inputs_that_are_accepted() {
    let sound = |name, edits, base| wrong(name, edits, 0, &[]).of(base).ends(0);
    check(&[
        sound("correlations", &[("[]", "[[\"m1\", \"m2\", 0.3], [\"m2\", \"I2\", \"90 %\"]]")], LOADED),
        sound("plus and minus in letters", &[("lb ± 50 lb", "+/- 50 lb")], LOADED),
        sound("an exact sd", &[("\"2564 lb ± 50 lb\"", "{ value = 1000, sd = 0 }")], LOADED),
        sound("limits", &[("\"2564 lb ± 50 lb\"", "{ min = 1000, max = 1200 }")], LOADED),
        sound("a triangle", &[("\"2564 lb ± 50 lb\"", "{ min = 1000, mode = 1000, max = \"3000 lb\" }")], LOADED),
        sound("a truncated normal", &[("\"2564 lb ± 50 lb\"", "{ value = 1000, relative = 0.1, min = 900, max = 1100 }")], LOADED),
        sound("a logarithm", &[("\"2564 lb ± 50 lb\"", "{ median = 1000, factor = 1.1 }")], LOADED),
        sound("a mean", &[("\"2564 lb ± 50 lb\"", "{ mean = \"2564 lb\", sd = \"50 lb\", n = 2 }")], LOADED),
        sound("values", &[("\"2564 lb ± 50 lb\"", "{ values = [\"2564 lb\", 1200] }")], LOADED),
        sound("values of a ratio", &[(E, "restitution = 0.1\nimpulse_ratio = { values = [0.3, \"40 %\"] }")], LOADED),
        sound("a step", &[("\"2564 lb ± 50 lb\"", "{ value = 1000, resolution = 10 }")], LOADED),
        sound("a ratio", &[(E, "restitution = \"10 % ± 2 %\"\nimpulse_ratio = \"0.3 ± 0.05\"")], LOADED),
        sound("a ratio between limits", &[(E, "restitution = 0.1\nimpulse_ratio = { min = 0.2, max = 0.3 }")], LOADED),
        sound("a share of the ratio", &[(E, "restitution = 0.1\nimpulse_ratio = { of_critical = \"0.9 ± 0.05\" }")], LOADED),
        sound("a friction", &[(E, "restitution = 0.1\nfriction = \"0.5 ± 0.1\"")], LOADED),
        sound("a share of all of it", &[(E, "restitution = 0.1\nmoment = \"100 N m s ± 100 %\"")], LOADED),
        sound("a moment", &[(E, "restitution = 0.1\nmoment = \"100 N m s ± 5 %\"")], LOADED),
        sound("a share of the moment", &[(E, "restitution = 0.1\nmoment = { of_critical = { min = 0, max = 0.2 } }")], LOADED),
        sound(
            "uncertain depths",
            &[("\"5 ft\"", "\"5 ft ± 1 in\""), ("\"4.1 in\"", "{ value = \"4.1 in\", resolution = \"0.1 in\" }")],
            CRUSHED,
        ),
        sound(
            "an uncertain line",
            &[(
                "width = \"5 ft\"",
                "width = \"5 ft\"\nmeasured = { offset = \"0 in ± 0.2 in\", angle = { min = \"0 deg\", max = \"5 deg\" } }",
            )],
            CRUSHED,
        ),
    ]);
}
