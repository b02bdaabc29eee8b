//! Invalid crush, and the place that each message names.

use super::{Bad, CRUSHED, check, faults_of, wrong};
use crate::process::{Folder, Run, planar_impact};

const DEPTHS: &str = "depths = [\"3 in\", \"4.1 in\", \"5 in\", \"2 in\"]";
const D0_D1: &str = "{ d0 = \"48.27 lbf^0.5\", d1 = \"162.8 lbf^0.5/ft\" }";
const WIDTH: &str = "width = \"5 ft\"\n";
const STATIONS: &str = "stations = [\"0 ft\", \"1 ft\", \"3 ft\", \"5 ft\"]\n";

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    // Depths.
    wrong("crush without depths", &[(DEPTHS, "depths = []")], 17, &["vehicle.2.crush.depths", "at least 2", "found 0 values"]).of(CRUSHED),
    wrong("crush of one depth", &[(DEPTHS, "depths = [\"3 in\"]")], 17, &["vehicle.2.crush.depths", "found 1 value"]).of(CRUSHED),
    wrong("crush deeper than the moon", &[("\"5 in\"", "\"5e9 in\"")], 17, &["vehicle.2.crush.depths.3", "too large"]).of(CRUSHED),
    wrong("a depth in pounds", &[("\"5 in\"", "\"5 lb\"")], 17, &["vehicle.2.crush.depths.3", "a length is expected"]).of(CRUSHED),
    wrong("a depth not a number", &[("\"5 in\"", "nan")], 17, &["vehicle.2.crush.depths.3"]).of(CRUSHED),
    wrong("a width below zero", &[("\"5 ft\"", "\"-5 ft\"")], 16, &["vehicle.2.crush.width", "above zero"]).of(CRUSHED),
    // Stations.
    wrong("width and stations", &[(WIDTH, "width = 1\nstations = [0, 1, 2, 3]\n")], 17, &["crush.stations", "exclude each other"])
        .of(CRUSHED),
    wrong("a station too many", &[(WIDTH, "stations = [0, 1, 2, 3, 4]\n")], 16, &["vehicle.2.crush.stations", "5 stations for 4 depths"])
        .of(CRUSHED),
    wrong("a station too few", &[(WIDTH, "stations = [0, 1, 2]\n")], 16, &["vehicle.2.crush.stations", "3 stations for 4 depths"])
        .of(CRUSHED),
    wrong("stations back and forth", &[(WIDTH, "stations = [0, 2, 1, 3]\n")], 16, &["vehicle.2.crush.stations.3", "not beyond"])
        .of(CRUSHED),
    wrong("a station twice", &[(WIDTH, "stations = [0, 1, 1, 3]\n")], 16, &["vehicle.2.crush.stations.3", "not beyond"]).of(CRUSHED),
    wrong("a station in degrees", &[(WIDTH, "stations = [0, \"1 deg\", 2, 3]\n")], 16, &["vehicle.2.crush.stations.2"]).of(CRUSHED),
    // The measuring line.
    wrong("measured from nowhere", &[(DEPTHS, "depths = [1, 2]\nmeasured = {}")], 18, &["crush.measured", "`offset` or `angle`"])
        .of(CRUSHED),
    wrong(
        "measured along the surface",
        &[(DEPTHS, "depths = [1, 2]\nmeasured = { angle = \"90 deg\" }")],
        18,
        &["vehicle.2.crush.measured.angle", "no depth"],
    )
    .of(CRUSHED),
    wrong(
        "measured from inside the crush",
        &[(DEPTHS, "depths = [\"3 in\", \"4.1 in\"]\nmeasured = { offset = \"4 in\" }")],
        17,
        &["vehicle.2.crush.depths.1", "at least 0 m"],
    )
    .of(CRUSHED),
    wrong(
        "measured from behind the crush",
        &[(DEPTHS, "depths = [\"3 in\", \"4.1 in\"]\nmeasured = { offset = \"5 in\" }")],
        18,
        &["vehicle.2.crush.measured: every reading less its offset is below zero"],
    )
    .of(CRUSHED),
    wrong("measured at 344 deg", &[(DEPTHS, "depths = [\"3 in\", \"4.1 in\"]\nmeasured = { angle = \"344 deg\" }")], 0, &[])
        .of(CRUSHED)
        .ends(0),
    wrong(
        "measured at crossed stations",
        &[(WIDTH, "stations = [0, 0.1]\n"), (DEPTHS, "depths = [1, 0.1]\nmeasured = { angle = \"45 deg\" }")],
        18,
        &["vehicle.2.crush.measured", "station 2"],
    )
    .of(CRUSHED),
    wrong("measured with a color", &[(DEPTHS, "depths = [1, 2]\nmeasured = { offset = 0, hue = 1 }")], 18, &["measured.hue: unknown key"])
        .of(CRUSHED),
    // Stiffness.
    wrong("negative d1", &[("162.8", "-162.8")], 18, &["vehicle.2.crush.stiffness.d1", "below zero"]).of(CRUSHED),
    wrong("A in the unit of B", &[(D0_D1, "{ A = \"50 lbf/in^2\", B = \"50 lbf/in^2\" }")], 18, &["vehicle.2.crush.stiffness.A"])
        .of(CRUSHED),
    wrong("d0 without a root", &[("48.27 lbf^0.5", "48.27 lbf")], 18, &["vehicle.2.crush.stiffness.d0", "a root of a force"]).of(CRUSHED),
    wrong("tests that are a number", &[(D0_D1, "{ tests = 5 }")], 18, &["vehicle.2.crush.stiffness.tests", "expected a string"])
        .of(CRUSHED),
    wrong("no zone", &[(D0_D1, "[]")], 18, &["vehicle.2.crush.stiffness", "no zone"]).of(CRUSHED),
    wrong("a zone without an end", &[(D0_D1, "[{ d0 = 1, d1 = 2 }, { d0 = 1, d1 = 2 }]")], 18, &["stiffness.1.to: missing"]).of(CRUSHED),
    wrong("a last zone with an end", &[(D0_D1, "[{ d0 = 1, d1 = 2, to = 3 }]")], 18, &["stiffness.1.to", "leave `to` out"]).of(CRUSHED),
    wrong(
        "zones back and forth",
        &[(D0_D1, "[{ to = 2, d0 = 1, d1 = 2 }, { to = 1, d0 = 1, d1 = 2 }, { d0 = 1, d1 = 2 }]")],
        18,
        &["vehicle.2.crush.stiffness.2.to", "not beyond"],
    )
    .of(CRUSHED),
    wrong(
        "saturation in a zone",
        &[(D0_D1, "[{ to = 2, d0 = 1, d1 = 2, saturation = 1 }, { d0 = 1, d1 = 2 }]")],
        18,
        &["stiffness.1.saturation: unknown key"],
    )
    .of(CRUSHED),
    wrong("saturation above the surface", &[("{ d0", "{ saturation = -1, d0")], 18, &["stiffness.saturation", "below zero"]).of(CRUSHED),
    wrong("an energy beside the depths", &[(WIDTH, "width = 1\nenergy = \"50 kJ\"\n")], 17, &["vehicle.2.crush.energy: unknown key"])
        .of(CRUSHED),
    wrong(
        "a crush energy and the crush",
        &[("[contact]", "[evidence]\ncrush_energy = \"50 kJ\"\n[contact]")],
        21,
        &["evidence.crush_energy", "of its own", "\"from crush\""],
    )
    .of(CRUSHED),
    // CRASH3.
    wrong("a surface of no car", &[(WIDTH, "width = 1\nsurface = \"roof\"\n")], 17, &["vehicle.2.crush.surface", "\"front\""]).of(CRUSHED),
    wrong("a PDOF of length", &[(WIDTH, "width = 1\npdof = \"1 m\"\n")], 17, &["vehicle.2.crush.pdof", "an angle is expected"]).of(CRUSHED),
    // Accepted.
    wrong("the energy of the crush", &[("[contact]", "[evidence]\ncrush_energy = \"from crush\"\n[contact]")], 0, &[]).of(CRUSHED).ends(0),
    wrong("no crush to speak of", &[(DEPTHS, "depths = [0, 0]")], 0, &[]).of(CRUSHED).ends(0),
    wrong("nine depths", &[(DEPTHS, "depths = [0, 0.1, 0.2, 0.3, 0.4, 0.3, 0.2, 0.1, 0]")], 0, &[]).of(CRUSHED).ends(0),
    wrong("a structure that does not stiffen", &[("162.8", "0")], 0, &[]).of(CRUSHED).ends(0),
    wrong("uneven stations", &[(WIDTH, STATIONS)], 0, &[]).of(CRUSHED).ends(0),
    wrong("crush in centimeters without a unit", &[(DEPTHS, "depths = [12.5, 10]")], 0, &[]).of(CRUSHED).ends(0),
];

#[test]
fn crush() {
    check(BAD);
}

/// Both crush verbs end as `solve` does, and so does their text output.
#[test]
fn its_own_verbs_refuse_the_same() {
    let folder = Folder::new();
    let mut faults = String::new();
    for bad in BAD {
        folder.write(bad.file(), bad.text().as_bytes());
        for verb in [&["crush", bad.file()][..], &["crash3", "--format", "json", bad.file()]] {
            let run = Run::of(planar_impact(folder.path()).args(verb).output().expect("the program starts"));
            let wanted: Vec<String> = bad.says.iter().map(|&words| words.to_owned()).collect();
            for fault in faults_of(&run, bad.status, bad.file(), &wanted) {
                faults.push_str(&format!("{} {verb:?}: {fault}\n{}\n\n", bad.name, run.err));
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn what_is_missing_is_named_with_the_verb_that_needs_it() {
    let folder = Folder::new();
    let run = |verb: &str, text: &str| {
        folder.write("case.toml", text.as_bytes());
        Run::of(planar_impact(folder.path()).args([verb, "case.toml"]).output().expect("the program starts"))
    };
    let without = super::COLLISION;
    let one = without.replace("[contact]", "[vehicle.crush]\nwidth = 1\ndepths = [0.1, 0.2]\nstiffness = { d0 = 90, d1 = 900 }\n[contact]");
    for (verb, text, words) in [
        ("crush", without, "no vehicle has a crush"),
        ("crash3", without, "vehicle.1.crush: missing"),
        ("crash3", without, "vehicle.2.crush: missing"),
        ("crash3", &one, "vehicle.1.crush: missing"),
    ] {
        let run = run(verb, text);
        assert!(faults_of(&run, 2, "case.toml", &[words.to_owned()]).is_empty(), "{verb}: {}", run.err);
    }
    let half = run("crush", &one);
    assert_eq!((half.status, half.err.as_str()), (0, ""), "the crush of one vehicle is worth a report");
}

#[test]
fn more_zones_than_anybody_measures_are_refused() {
    let folder = Folder::new();
    for (count, status) in [(32, 0), (33, 2)] {
        let zones: Vec<String> = (1..count).map(|i| format!("{{ to = {i}, d0 = 1, d1 = 2 }}")).collect();
        let zones = format!("[{}, {{ d0 = 1, d1 = 2 }}]", zones.join(", "));
        folder.write("case.toml", CRUSHED.replacen(D0_D1, &zones, 1).as_bytes());
        let run = Run::of(planar_impact(folder.path()).args(["crush", "case.toml"]).output().expect("the program starts"));
        assert_eq!(run.status, status, "{count}: {}", run.err);
        assert!(status == 0 || run.err.contains("vehicle.2.crush.stiffness") && run.err.contains("33 zones"), "{}", run.err);
    }
}

#[test]
fn what_is_unusual_is_noted() {
    let folder = Folder::new();
    for (edits, words) in [
        ((DEPTHS, "depths = [12.5, 10]"), "12.50 m is deeper than the structure of a car"),
        ((DEPTHS, "depths = [0, 0]"), "no depth, and an energy of"),
        (("width = \"5 ft\"", "width = \"5 mm\""), "is not that of a crush"),
        (("width = \"5 ft\"", "width = \"60 ft\""), "is not that of a crush"),
        ((D0_D1, "[{ to = 9, d0 = 1, d1 = 2 }, { d0 = 1, d1 = 2 }]"), "lies outside the crush"),
        ((DEPTHS, "depths = [0.5, 0.25]"), "has no unit"),
        // Of kN/m and kN/m², without a unit.
        ((D0_D1, "{ A = 60, B = 500 }"), "B = 500 N/m^2 is not the stiffness of a vehicle"),
        ((D0_D1, "{ A = \"60000 kN/m\", B = \"500000 kPa\" }"), "B = 500000000 N/m^2 is not the stiffness of a vehicle"),
    ] {
        folder.write("case.toml", CRUSHED.replacen(edits.0, edits.1, 1).as_bytes());
        for verb in ["crush", "crash3", "solve"] {
            let run = Run::of(planar_impact(folder.path()).args([verb, "case.toml"]).output().expect("the program starts"));
            let text = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(run.status == 0 && text.contains(words), "{verb} {words}: {}{}", run.out, run.err);
        }
    }
}
