//! Uncertain inputs: what the search takes them for, and what the other verbs do.

use planar_impact::{Input, Side};
use serde_json::{Value, json};

use super::{WALL, answer, example, number, replaced, two_cars};
use crate::process::run_with_input;

const MASS: &str = "mass = \"1450 kg\"";
const FREE: &str = "contact.crush_plane = { start = \"-10 deg\", min = \"-45 deg\", max = \"25 deg\" }";

/// Returns an answer without its notices and without the flags of the inputs, which it returns by name.
fn bare(case: &str) -> (Value, Vec<String>) {
    let (mut found, _) = answer(case);
    let all = found.as_object_mut().expect("an object");
    all.remove("notes");
    all.remove("messages");
    let mut inputs = Vec::new();
    for (name, unknown) in all["unknown"].as_object_mut().expect("unknowns") {
        let flag = unknown.as_object_mut().and_then(|unknown| unknown.remove("is_input"));
        if flag.expect("each says it") == true {
            inputs.push(name.clone());
        }
    }
    (found, inputs)
}

fn codes(found: &Value) -> Vec<String> {
    let messages = found["messages"].as_array().cloned().unwrap_or_default();
    messages.iter().filter_map(|message| message["code"].as_str().map(str::to_owned)).collect()
}

/// What a level above 95 % asks of few measurements, and one below 90 % of readings in steps.
#[test]
fn levels_that_standard_deviations_do_not_have_are_named() {
    let case = |mass: &str, evidence: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = {mass}\nyaw_inertia = 2500\nheading = 0\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n[contact]\n\
             crush_plane = 0\nrestitution = 0.1\n[evidence]\nvehicle.1.delta_v_magnitude = {evidence}\n[unknown]\nvehicle.1.speed = {{ start = 10, min = 0 }}\n"
        )
    };
    let told = |mass: &str, evidence: &str, level: &str| {
        let run = run_with_input(&["reconstruct", "-", "--format", "json", "--level", level], &case(mass, evidence));
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        codes(&answer).into_iter().filter(|code| code.starts_with("level-")).collect::<Vec<_>>()
    };
    let (few, normal) = ("{ mean = \"1500 kg\", sd = \"100 kg\", n = 4 }", "\"1500 kg ± 50 kg\"");
    let (step, sd) = ("{ value = \"11 m/s\", resolution = \"1 m/s\" }", "\"11 m/s ± 0.5 m/s\"");
    for (mass, evidence, level, expected) in [
        (few, sd, "0.95", None),
        (few, sd, "0.8", None),
        (few, sd, "0.99", Some("level-beyond-tests")),
        (normal, sd, "0.99", None),
        (normal, step, "0.9", None),
        (normal, step, "0.8", Some("level-below-resolution")),
        (normal, sd, "0.8", None),
        ("{ min = 1400, max = 1600 }", sd, "0.8", Some("level-below-resolution")),
    ] {
        assert_eq!(told(mass, evidence, level), expected.into_iter().collect::<Vec<_>>(), "{mass} {evidence} {level}");
    }
}

/// The friction is just above the critical ratio: at the best fit nothing depends on it, and within its uncertainty it gives way.
#[test]
fn intervals_far_beyond_standard_deviations_are_named() {
    let case = |friction: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1450\nyaw_inertia = 2600\nheading = \"10 deg\"\nimpact_center = [1.85, -0.4]\n[[vehicle]]\n\
             mass = 1180\nyaw_inertia = 1900\nheading = \"120 deg\"\nspeed = 11.4\nimpact_center = [1.6, 0.5]\n[contact]\n\
             crush_plane = \"-8 deg\"\nrestitution = 0.08\nfriction = \"{friction}\"\n[evidence]\nvehicle.1.delta_v_forward = \"-7 m/s ± 0.3 m/s\"\n\
             [unknown]\nvehicle.1.speed = {{ start = 14, min = 0 }}\n"
        )
    };
    let told = |friction: &str| {
        let run = run_with_input(&["reconstruct", "-", "--format", "json"], &case(friction));
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let all = answer["messages"].as_array().cloned().unwrap_or_default();
        all.iter()
            .find(|message| message["code"] == "interval-beyond-sd")
            .map(|message| message["text"].as_str().expect("a sentence").to_owned())
    };
    let message = told("0.26 ± 0.05").expect("a warning");
    assert!(message.contains("vehicle.1.pdof") && message.contains("the intervals hold"), "{message}");
    assert_eq!(told("0.8 ± 0.05"), None);
}

/// The same file with the number listed under `[unknown]`, after the other unknowns, has the same answer bit for bit.
#[test]
fn an_uncertain_input_is_an_unknown_with_a_prior() {
    let radius = ("yaw_inertia = \"2600 kg m^2\"", "radius_of_gyration = \"1.339 m\"");
    for (in_place, unknown) in [
        ("mass = \"1450 kg ± 50 kg\"", "m1 = { start = \"1450 kg\", sd = \"50 kg\" }"),
        ("mass = \"1450 kg ± 4 %\"", "m1 = { start = \"1450 kg\", sd = \"58 kg\" }"),
        ("mass = { value = 1450, relative = 0.04 }", "m1 = { start = \"1450 kg\", sd = \"58 kg\" }"),
        // The width over the root of twelve.
        ("mass = { min = 1400, max = 1500 }", "m1 = { start = 1450, sd = 28.86751345948129, min = 1400, max = 1500 }"),
        ("mass = { value = 1450, resolution = 100 }", "m1 = { start = 1450, sd = 28.86751345948129, min = 1400, max = 1500 }"),
        ("mass = { value = 1450, sd = 50, min = 1400, max = 1600 }", "m1 = { start = 1450, sd = 50, min = 1400, max = 1600 }"),
        // The mean of a triangle is that of its corners, its variance (1² + 1·2 + 2²)/18 of its unit.
        ("mass = { min = 1390, mode = 1420, max = 1480 }", "m1 = { start = 1430, sd = 18.708286933869708, min = 1390, max = 1480 }"),
    ] {
        for inertia in [("", ""), radius] {
            let case = replaced(&two_cars(), &[inertia]);
            let (uncertain, inputs) = bare(&replaced(&case, &[(MASS, in_place)]));
            let (asked, none) = bare(&replaced(&case, &[(FREE, &format!("{FREE}\n{unknown}"))]));
            assert_eq!((inputs, none), (vec!["vehicle.1.mass".to_owned()], vec![]), "{in_place}");
            assert_eq!(uncertain, asked, "{in_place}");
        }
    }
}

#[test]
fn numbers_of_the_contact_and_of_velocities_are_inputs_too() {
    // Symbols, which stand after the other unknowns whatever these are.
    let symbols = [Input::ImpactCenterLeft(Side::Two), Input::YawRate(Side::Two), Input::ImpulseRatio].map(Input::symbol);
    let [left, rate, ratio] = symbols;
    let three = format!(
        "{left} = {{ start = \"0.5 m\", sd = \"5 cm\" }}\n{rate} = {{ start = 0, sd = 0.1 }}\n{ratio} = {{ start = 0.95, sd = 0.02 }}"
    );
    let contact = "[contact]\nimpulse_ratio = { of_critical = 0.95 }\n";
    let asked = replaced(&two_cars(), &[("[contact]\n", contact), (FREE, &format!("{FREE}\n{three}"))]);
    let edits = [
        ("[contact]\n", "[contact]\nimpulse_ratio = { of_critical = \"0.95 ± 0.02\" }\n"),
        ("impact_center = [\"1.60 m\", \"0.50 m\"]", "impact_center = [\"1.60 m\", \"0.50 m ± 5 cm\"]\nyaw_rate = \"0 rad/s ± 0.1 rad/s\""),
    ];
    let (found, inputs) = bare(&replaced(&two_cars(), &edits));
    assert_eq!(inputs, ["contact.impulse_ratio.of_critical", "vehicle.2.impact_center.left", "vehicle.2.yaw_rate"]);
    assert_eq!(found, bare(&asked).0);
}

/// An unknown mass under a radius of gyration takes the yaw inertia with it.
#[test]
fn a_radius_of_gyration_stays() {
    let case = replaced(
        &two_cars(),
        &[("yaw_inertia = \"2600 kg m^2\"", "radius_of_gyration = \"1.3 m ± 5 cm\""), (MASS, "mass = \"1450 kg ± 50 kg\"")],
    );
    let (found, inputs) = bare(&case);
    assert_eq!(inputs, ["vehicle.1.mass", "vehicle.1.radius_of_gyration"]);
    let [mass, radius] = [0, 1].map(|i| number(&found["unknown"][&inputs[i]]["value"]));
    let sd = number(&found["unknown"]["vehicle.1.radius_of_gyration"]["sd"]);
    assert!(mass != 1450.0 && radius != 1.3 && sd > 0.0 && sd <= 0.05, "{found}");
    // The solution is that of the case with these numbers.
    let unknown = &found["unknown"];
    let value = |name: &str| number(&unknown[name]["value"]);
    let edits = [
        ("[evidence]", "[ignored]"),
        ("mass = \"1450 kg ± 50 kg\"", &format!("mass = {mass}\nspeed = {}", value("vehicle.1.speed"))),
        ("\"1.3 m ± 5 cm\"", &radius.to_string()),
        ("heading = \"120 deg\"", &format!("heading = \"120 deg\"\nspeed = {}", value("vehicle.2.speed"))),
        (
            "[contact]\n",
            &format!("[contact]\nrestitution = {}\ncrush_plane = {}\n", value("contact.restitution"), value("contact.crush_plane")),
        ),
    ];
    let forward = replaced(&case, &edits);
    let forward = forward.split("[ignored]").next().expect("a part");
    let solved: Value = serde_json::from_str(&run_with_input(&["solve", "-", "--format", "json"], forward).out).expect("JSON");
    let [got, want] = [&found["solution"], &solved].map(|solution| number(&solution["energy"]["loss"]));
    assert!((got - want).abs() < 1e-6 * want, "{got} {want}");
}

/// The derivatives of the energy of a crush of constant depth, w (A²/2B + A C + B C²/2), by hand.
#[test]
fn the_uncertainty_of_the_crush_becomes_that_of_its_energy() {
    let (w, c, a, b) = (1.5, 0.3, 50e3, 400e3);
    let energy = w * (a * a / (2.0 * b) + a * c + b * c * c / 2.0);
    let slopes = [energy / w, w * (a / b + c), w * (c * c / 2.0 - a * a / (2.0 * b * b)), w * (a + b * c)];
    let case = |correlation: &str, crush: &str, spread: &str| {
        let evidence = format!("crush_energy = {spread}");
        replaced(
            WALL,
            &[
                ("schema = 1\n", &format!("schema = 1\n{correlation}\n")),
                ("[[vehicle]]\nname = \"wall\"", &format!("{crush}\n[[vehicle]]\nname = \"wall\"")),
                ("crush_energy = \"50 kJ ± 2 kJ\"", &evidence),
            ],
        )
    };
    let of = |width: &str, onset: &str, slope: &str, depth: &str| {
        format!("[vehicle.crush]\nwidth = {width}\ndepths = [{depth}, 0.3]\nstiffness = {{ A = {onset}, B = {slope} }}\n")
    };
    let sd = |case: &str| number(&answer(case).0["evidence"]["crush_energy"]["sd"]);
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-9 * want, "{got} {want}");
    let plain = "\"from crush\"";
    let none = of("1.5", "50e3", "400e3", "0.3");
    close(sd(&case("", &none, "\"from crush ± 5 %\"")), 0.05 * energy);
    close(sd(&case("", &of("\"1.5 m ± 0.02 m\"", "50e3", "400e3", "0.3"), plain)), 0.02 * slopes[0]);
    let stiffness = of("1.5", "\"50 kN/m ± 3 kN/m\"", "\"400 kPa ± 10 %\"", "0.3");
    let (by_onset, by_slope): (f64, f64) = (3e3 * slopes[1], 40e3 * slopes[2]);
    close(sd(&case("", &stiffness, plain)), by_onset.hypot(by_slope));
    let correlation = "correlation = [[\"vehicle.1.crush.A\", \"vehicle.1.crush.B\", 0.5]]";
    close(sd(&case(correlation, &stiffness, plain)), (by_onset * by_onset + by_slope * by_slope + by_onset * by_slope).sqrt());
    close(sd(&case("", &stiffness, "{ value = \"from crush\", sd = \"1 kJ\" }")), by_onset.hypot(by_slope).hypot(1e3));
    // A depth at the end of a straight profile has half of the effect of both.
    let step = of("1.5", "50e3", "400e3", "{ value = 0.3, resolution = 0.02 }");
    close(sd(&case("", &step, plain)), 0.02 / 12_f64.sqrt() * slopes[3] / 2.0);
    // Without a deviation of its own a crush energy would be exact.
    let (found, _) = answer(&case("", &step, plain));
    assert!(
        codes(&found).contains(&"uncertainty-from-crush".to_owned()) && !codes(&found).contains(&"nominal-values".to_owned()),
        "{found}"
    );
    // What the evidence does not take from the crush stays at its nominal value.
    let (found, _) = answer(
        &case("", &step, "\"50 kJ ± 2 kJ\"")
            .replace("crush_energy = \"50 kJ ± 2 kJ\"", "vehicle.1.delta_v_forward = \"-12 m/s ± 0.5 m/s\""),
    );
    assert!(codes(&found).contains(&"nominal-values".to_owned()), "{found}");
}

#[test]
fn correlations_reach_the_answer() {
    let masses = [(MASS, "mass = \"1450 kg ± 50 kg\""), ("mass = \"1180 kg\"", "mass = \"1180 kg ± 40 kg\"")];
    let of = |coefficient: f64| {
        let line = format!("schema = 1\ncorrelation = [[\"m2\", \"m1\", {coefficient}]]\n");
        let (found, _) = answer(&replaced(&replaced(&two_cars(), &masses), &[("schema = 1\n", &line)]));
        (number(&found["correlation"]["vehicle.1.mass"]["vehicle.2.mass"]), found)
    };
    let [(negative, _), (zero, none), (positive, found)] = [-0.9, 0.0, 0.9].map(of);
    assert!(negative < zero - 0.3 && zero + 0.3 < positive, "{negative} {zero} {positive}");
    // A coefficient of zero changes rounding at most.
    let (without, _) = answer(&replaced(&two_cars(), &masses));
    let [one, other] = [&none, &without].map(|found| ["value", "sd"].map(|key| number(&found["unknown"]["vehicle.1.speed"][key])));
    assert!(one.into_iter().zip(other).all(|(one, other)| (one - other).abs() < 1e-6 * other), "{one:?} {other:?}");
    assert_ne!(found["unknown"], none["unknown"]);
    assert!(!codes(&found).contains(&"correlation-not-used".to_owned()));
    // A number between limits has them too, a heading of any direction has no mean.
    let of = |number: (&'static str, &'static str), pair: &str| {
        let line = format!("schema = 1\ncorrelation = [[{pair}, \"m2\", 0.9]]\n");
        answer(&replaced(&replaced(&two_cars(), &[number, masses[1]]), &[("schema = 1\n", &line)])).0
    };
    let limits = of((MASS, "mass = { min = 1400, max = 1500 }"), "\"m1\"");
    assert!(number(&limits["correlation"]["vehicle.1.mass"]["vehicle.2.mass"]) > zero + 0.3, "{limits}");
    let any = of(("heading = \"10 deg\"", "heading = { min = \"-180 deg\", max = \"180 deg\" }"), "\"vehicle.1.heading\"");
    assert!(codes(&any).contains(&"correlation-not-used".to_owned()), "{any}");
}

#[test]
fn the_example_says_what_it_does_with_each_shape() {
    let (found, status) = answer(&example("uncertain-masses.toml"));
    assert_eq!((status, &found["verdict"]), (0, &json!("agrees")));
    let codes = codes(&found);
    assert_eq!(codes.iter().filter(|code| *code == "shape-approximated").count(), 1, "{codes:?}");
    assert!(!codes.contains(&"nominal-values".to_owned()), "{codes:?}");
    let flags: Vec<(&String, &Value)> =
        found["unknown"].as_object().expect("unknowns").iter().map(|(name, one)| (name, &one["is_input"])).collect();
    assert!(flags.iter().all(|(name, is_input)| **is_input == json!(!name.ends_with("speed"))) && flags.len() == 7, "{flags:?}");
    let said = super::text(&example("uncertain-masses.toml"), &[]).out;
    let (of_unknowns, of_inputs) = said.split_once("uncertain input ").expect("a table of inputs");
    assert!(of_unknowns.contains("vehicle.1.speed") && !of_unknowns.contains("vehicle.1.mass"), "{said}");
    assert!(of_inputs.contains("vehicle.1.mass"), "{said}");
}

/// Every other verb uses one number, and says so once; its numbers are those of the file without uncertainty.
#[test]
fn other_verbs_use_nominal_values_and_say_so() {
    let plain = std::fs::read_to_string(crate::process::workspace().join("cli/examples/cavalier-crush.toml")).expect("the example");
    let mass = plain.lines().find(|line| line.starts_with("mass = ")).expect("a mass");
    let uncertain = replaced(
        &plain,
        &[(mass, &format!("{} ± 2 %\"", mass.trim_end_matches('"'))), ("restitution = ", "tangential_law = \"brach\"\nrestitution = ")],
    );
    let restitution = uncertain.lines().find(|line| line.starts_with("restitution = ")).expect("one").to_owned();
    let value = restitution.trim_start_matches("restitution = ").to_owned();
    let uncertain = replaced(&uncertain, &[(&restitution, &format!("restitution = {{ value = {value}, sd = 0.01 }}"))]);
    for verb in [&["solve"][..], &["gradient", "--of", "T_L", "--wrt", "m1"], &["sweep", "--vary", "e=0:0.1:0.1"], &["crush"], &["crash3"]]
    {
        let document = |case: &str| -> Value {
            let run = run_with_input(&[&[verb[0], "-"], &verb[1..], &["--format", "json"]].concat(), case);
            assert!(run.err.is_empty(), "{verb:?}: {}", run.err);
            serde_json::from_str(&run.out).expect("JSON")
        };
        let (mut one, mut other) = (document(&uncertain), document(&plain));
        let said: Vec<Value> =
            one["messages"].as_array().expect("messages").iter().filter(|message| message["code"] == "nominal-values").cloned().collect();
        assert_eq!(said.len(), 1, "{verb:?}");
        let text = said[0]["text"].as_str().expect("a sentence");
        assert!(text.contains("vehicle.1.mass") && text.contains("contact.restitution"), "{text}");
        for document in [&mut one, &mut other] {
            document["notes"] = Value::Null;
            document["messages"] = Value::Null;
        }
        assert_eq!(one, other, "{verb:?}");
    }
}

/// Magnitude and direction of a velocity change have the errors of its components: either pair is the same evidence.
#[test]
fn magnitude_and_direction_are_as_certain_as_the_components() {
    let rows: String = (0..40)
        .map(|i: i32| {
            let u = (f64::from(i) / 12.0).min(1.0);
            let s = u * u * (3.0 - 2.0 * u);
            format!("{},{:.1},{:.2}\n", f64::from(i) / 100.0, -0.807 * s, -4.827 * s)
        })
        .collect();
    let folder = crate::process::Folder::new();
    folder.write("edr.csv", format!("time [s],delta_v_forward [m/s],delta_v_right [m/s]\n{rows}").as_bytes());
    let sds = |uses: &str| {
        let case = format!(
            "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = \"180 deg\"\nimpact_center = [1.9, -0.3]\n\
             [[vehicle]]\nmass = 1900\nyaw_inertia = 3300\nheading = \"105 deg\"\nspeed = 11\nimpact_center = [1.4, -0.8]\n\
             [contact]\nrestitution = 0.1\n[evidence]\nvehicle.2.recorder = {{ file = \"edr.csv\", relative = 0.1, use = [{uses}] }}\n\
             [unknown]\nvehicle.1.speed = {{ start = 18, min = 0 }}\ncontact.crush_plane = {{ start = \"10 deg\", min = \"-17 deg\", max = \"69 deg\" }}\n"
        );
        folder.write("case.toml", case.as_bytes());
        let run = crate::process::run(folder.path(), &["reconstruct", "case.toml", "--format", "json"]);
        let found: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        ["vehicle.1.speed", "contact.crush_plane"].map(|name| number(&found["unknown"][name]["sd"]))
    };
    let (polar, components) = (sds("\"delta_v_magnitude\", \"pdof\""), sds("\"delta_v_forward\", \"delta_v_left\""));
    for (one, other) in polar.into_iter().zip(components) {
        assert!((one / other - 1.0).abs() < 1e-6, "{polar:?} {components:?}");
    }
}
