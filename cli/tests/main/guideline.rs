//! The crush plane from the two surfaces in contact: the paper's guideline, its bracket, and refused cases.

use serde_json::Value;

use crate::process::{run_with_input, workspace};

fn oblique() -> String {
    std::fs::read_to_string(workspace().join("cli/examples/oblique-surfaces.toml")).expect("the example is there")
}

/// Returns the example with other surfaces.
fn with(surfaces: &str) -> String {
    let case = oblique();
    assert!(case.contains("surfaces = [\"0 deg\", \"225 deg\"]"));
    case.replace("surfaces = [\"0 deg\", \"225 deg\"]", surfaces)
}

fn solved(case: &str) -> Value {
    let run = run_with_input(&["solve", "-", "--format", "json"], case);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

fn close(got: &Value, want: &Value) -> bool {
    let (got, want) = (got.as_f64().expect("a number"), want.as_f64().expect("a number"));
    (got - want).abs() <= 1e-10 * want.abs().max(1.0)
}

#[test]
fn figure_5_has_22_5_deg_between_0_and_45() {
    let solution = solved(&oblique());
    let bracket = &solution["crush_plane_bracket"];
    assert_eq!(bracket["lower"]["crush_plane"], 0.0);
    assert!((bracket["upper"]["crush_plane"].as_f64().expect("an angle").to_degrees() - 45.0).abs() < 1e-12); // 225 deg is the same plane
    let text = run_with_input(&["solve", "-"], &oblique()).out;
    assert!(text.contains("Crush plane Gamma = 22.5 deg"), "{text}");
    // The three columns of the table equal three runs of `solve`.
    for (crush_plane, at) in [("0 deg", &bracket["lower"]["outputs"]), ("45 deg", &bracket["upper"]["outputs"])] {
        let end = solved(&with(&format!("crush_plane = \"{crush_plane}\"")));
        assert!(end.get("crush_plane_bracket").is_none(), "a crush plane that is given has no bracket");
        for (name, pointer) in [
            ("energy.normal_work", "/energy/normal_work"),
            ("energy.tangential_work", "/energy/tangential_work"),
            ("energy.loss", "/energy/loss"),
            ("contact.critical_impulse_ratio", "/contact/critical_impulse_ratio"),
            ("contact.impulse.x", "/contact/impulse/x"),
            ("vehicle.1.delta_v_magnitude", "/vehicles/0/delta_v_magnitude"),
            ("vehicle.2.yaw_rate", "/vehicles/1/yaw_rate"),
            ("vehicle.2.velocity.y", "/vehicles/1/velocity/1"),
            ("vehicle.1.crush_energy", "/vehicles/0/crush_energy"),
        ] {
            assert!(close(&at[name], end.pointer(pointer).expect("documented")), "{crush_plane} {name}: {}", at[name]);
        }
        let nominal = solved(&with(&format!("crush_plane = {}", 22.5_f64.to_radians())));
        assert!(close(&nominal["energy"]["normal_work"], &solution["energy"]["normal_work"]));
    }
}

#[test]
fn the_derivative_between_the_ends_is_that_of_gradient() {
    let solution = solved(&oblique());
    let run = run_with_input(&["gradient", "-", "--wrt", "Gamma", "--format", "json"], &oblique());
    let gradient: Value = serde_json::from_str(&run.out).expect("JSON");
    let slopes = solution["crush_plane_bracket"]["d"].as_object().expect("derivatives");
    assert_eq!(slopes.len(), gradient["of"].as_object().expect("outputs").len());
    for (name, slope) in slopes {
        assert_eq!(*slope, gradient["of"][name]["d"]["contact.crush_plane"], "{name}");
    }
}

#[test]
fn the_table_has_both_ends_and_the_slope_per_degree() {
    let (solution, text) = (solved(&oblique()), run_with_input(&["solve", "-"], &oblique()).out);
    let bracket = &solution["crush_plane_bracket"];
    let foot_pounds = |value: &Value| value.as_f64().expect("a number") / 1.355_817_948_331_400_4; // ft lbf in J
    let name = "energy.normal_work";
    let expected = [
        foot_pounds(&bracket["lower"]["outputs"][name]),
        foot_pounds(&solution["energy"]["normal_work"]),
        foot_pounds(&bracket["upper"]["outputs"][name]),
        foot_pounds(&bracket["d"][name]).to_radians(),
    ];
    let row = text.lines().find(|line| line.trim_start().starts_with("normal work W_n")).expect("a row");
    let shown: Vec<f64> = row.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    assert_eq!(shown, expected.map(f64::round), "{text}");
}

#[test]
fn either_normal_of_a_surface_will_do() {
    let reference = solved(&oblique());
    for surfaces in ["surfaces = [\"0 deg\", \"45 deg\"]", "surfaces = [\"0 deg\", \"-135 deg\"]", "surfaces = [\"180 deg\", \"225 deg\"]"]
    {
        let other = solved(&with(surfaces));
        for pointer in ["/energy/normal_work", "/energy/tangential_work", "/vehicles/0/delta_v_magnitude", "/vehicles/1/yaw_rate"] {
            assert!(
                close(other.pointer(pointer).expect("documented"), reference.pointer(pointer).expect("documented")),
                "{surfaces} {pointer}"
            );
        }
    }
}

#[test]
fn an_end_that_is_refused_says_why() {
    let case = with("surfaces = [\"-60 deg\", \"10 deg\"]");
    let solution = solved(&case);
    let bracket = &solution["crush_plane_bracket"];
    assert!(bracket["lower"].get("outputs").is_none() && bracket["upper"].get("refused").is_none());
    assert!(bracket["lower"]["refused"].as_str().is_some_and(|why| why.contains("vehicles are separating")), "{bracket}");
    let text = run_with_input(&["solve", "-"], &case);
    assert_eq!(text.status, 0);
    assert!(text.out.contains("refused") && text.out.contains("Refused at -60.0 deg: vehicles are separating"), "{}", text.out);
    assert!(text.out.lines().all(|line| line.chars().count() <= 80), "{}", text.out);
    // If the nominal plane between the ends is refused, the case is refused.
    assert_eq!(run_with_input(&["solve", "-"], &with("surfaces = [\"-65 deg\", \"-55 deg\"]")).status, 3);
}

#[test]
fn what_is_no_pair_of_surfaces_is_refused() {
    for (surfaces, says) in [
        ("surfaces = [\"0 deg\", \"90 deg\"]", &["right angle", "\"-45 deg\"", "\"45 deg\""][..]),
        ("surfaces = [\"10.01 deg\", \"280.01 deg\"]", &["right angle", "\"-34.99 deg\"", "\"55.01 deg\""]),
        ("surfaces = [\"0 deg\"]", &["contact.surfaces: expected an array of two values"]),
        ("surfaces = [\"0 deg\", \"45 ft\"]", &["contact.surfaces.2", "an angle is expected"]),
        ("surfaces = \"0 deg\"", &["contact.surfaces: expected an array"]),
        ("surfaces = [0, 45]", &["contact.surfaces.2", "\"45 deg\""]),
        ("surface = [0, 1]", &["missing `crush_plane` or `surfaces`", "did you mean `surfaces`?"]),
        ("", &["missing `crush_plane` or `surfaces`"]),
        ("crush_plane = 0\nsurfaces = [0, 1]", &["`crush_plane` and `surfaces` exclude each other"]),
    ] {
        let run = run_with_input(&["solve", "-"], &with(surfaces));
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{surfaces}");
        for words in says {
            assert!(run.err.contains(words), "{surfaces}: {words}\n{}", run.err);
        }
    }
}
