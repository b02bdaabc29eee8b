//! A stiffness fitted to the barrier tests of another file.

use serde_json::Value;

use super::{example, number, replaced};
use crate::process::{Folder, Run, run, run_with_input, workspace};

const TESTS: &str = "stiffness = { tests = \"../tests/struble-welsh.toml\" }";

/// Runs a verb on a case that stands beside files of barrier tests.
fn beside(case: &str, files: &[(&str, &str)], arguments: &[&str]) -> Run {
    let folder = Folder::new();
    folder.write("case.toml", case.as_bytes());
    for (name, text) in files {
        folder.write(name, text.as_bytes());
    }
    run(folder.path(), &[arguments, &["case.toml"]].concat())
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err))
}

fn struble_welsh() -> String {
    std::fs::read_to_string(workspace().join("cli/examples/tests/struble-welsh.toml")).expect("the example can be read")
}

fn case(stiffness: &str) -> String {
    replaced(&example("from-tests.toml"), &[(TESTS, stiffness)])
}

/// What `stiffness` prints, as the file gives it: d0, d1, their standard deviations and the correlation.
fn fit(tests: &str, model: usize) -> [f64; 5] {
    let folder = Folder::new();
    folder.write("tests.toml", tests.as_bytes());
    let document = json(&run(folder.path(), &["stiffness", "tests.toml", "--format", "json"]));
    let fit = &document["fits"][model];
    let covariance = &fit["covariance"];
    [&fit["d0"], &fit["d1"], &covariance["d0_sd"], &covariance["d1_sd"], &covariance["correlation"]].map(number)
}

/// The tests of the example differ by more than their standard deviations allow, which count by the root of χ² over its one degree of freedom.
const BY_RESIDUALS: f64 = 2.075964823931869;

const RECONSTRUCT: [&str; 3] = ["reconstruct", "--format", "json"];

/// The same file with the fitted numbers in place of the name of the tests has the same answer.
#[test]
fn the_fit_is_an_uncertain_stiffness_with_its_correlation() {
    let bare: String = struble_welsh()
        .lines()
        .filter(|line| !line.contains("_sd") && !line.contains("scatter"))
        .map(|line| format!("{}\n", line.replace("[\"0.5203 ft\", \"0.5203 ft\"]", "[\"0.2 ft\", \"0.8 ft\"]")))
        .collect();
    // Of residuals alone, with one degree of freedom, by the 97.5 % quantile of Student's distribution, tan(0.475 π), in that of the normal one.
    let by_student = (0.475 * std::f64::consts::PI).tan() / 1.959_963_984_540_054;
    for (tests, enlarged) in [(struble_welsh(), BY_RESIDUALS), (bare, by_student)] {
        for (number_of_model, model) in [(1, ""), (1, ", model = \"profile\""), (0, ", model = \"mean depth\"")] {
            let [d0, d1, d0_sd, d1_sd, correlation] = fit(&tests, number_of_model);
            let [d0_sd, d1_sd] = [d0_sd, d1_sd].map(|sd| sd * enlarged);
            let named = case(&format!("stiffness = {{ tests = \"tests.toml\"{model} }}"));
            let named = beside(&named, &[("tests.toml", &tests)], &RECONSTRUCT);
            let plain = case(&format!("stiffness = {{ d0 = {{ value = {d0}, sd = {d0_sd} }}, d1 = {{ value = {d1}, sd = {d1_sd} }} }}"));
            let pair = format!("correlation = [[\"vehicle.1.crush.d0\", \"vehicle.1.crush.d1\", {correlation}]]\n\n[[vehicle]]");
            let plain = beside(&plain.replacen("[[vehicle]]", &pair, 1), &[], &RECONSTRUCT);
            assert_eq!((named.status, named.err.as_str(), plain.status, plain.err.as_str()), (0, "", 0, ""));
            let [named, plain] = [json(&named), json(&plain)];
            // Intervals as wide as those of Student's distribution reach standstill, where a loss that vanishes has no digits.
            let keys: &[&str] = if enlarged == BY_RESIDUALS {
                &["unknown", "derived", "evidence", "covariance"]
            } else {
                &["unknown", "evidence", "covariance"]
            };
            for key in keys {
                assert_alike(&named[*key], &plain[*key], key);
            }
            let text = |document: &Value| document["notes"].to_string();
            assert!(text(&named).contains("fitted to 3 tests") && !text(&plain).contains("fitted"), "{}", text(&named));
        }
    }
}

/// Asserts that two documents have the same keys, and numbers that differ by rounding.
fn assert_alike(one: &Value, other: &Value, at: &str) {
    match (one, other) {
        (Value::Object(one), Value::Object(other)) => {
            assert!(one.keys().eq(other.keys()), "{at}");
            one.iter().for_each(|(key, value)| assert_alike(value, &other[key], &format!("{at}.{key}")));
        }
        (Value::Number(_), Value::Number(_)) => {
            let [one, other] = [one, other].map(number);
            assert!((one - other).abs() <= 1e-9 * (1.0 + other.abs()), "{at}: {one} {other}");
        }
        _ => assert_eq!(one, other, "{at}"),
    }
}

/// Two crushes that are alike have one error, which contradicts nothing: the share of each is a half, however uncertain the energies are.
#[test]
fn equal_crushes_of_one_vehicle_have_equal_energies() {
    let second = "depths = [\"0 ft\", \"0 ft\"]\nstiffness = { d0 = \"0 lbf^0.5\", d1 = \"1e6 lbf^0.5/ft\" }";
    let both = replaced(
        &case("stiffness = { tests = \"tests.toml\" }"),
        &[
            (second, "depths = [\"0.520335 ft\", \"0.520335 ft\"]\nstiffness = { tests = \"tests.toml\" }"),
            ("\ncrush_energy = \"from crush\"", "\nvehicle.1.crush_energy = \"from crush\"\nvehicle.2.crush_energy = \"from crush\""),
        ],
    );
    let run = beside(&both, &[("tests.toml", &struble_welsh())], &RECONSTRUCT);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let found = json(&run);
    let energy = &found["evidence"]["vehicle.1.crush_energy"];
    let share = &found["unknown"]["contact.crush_share"];
    assert!(number(&energy["sd"]) > 0.02 * number(&energy["given"]), "{energy}");
    let [low, high] = ["low", "high"].map(|end| number(&share["interval"][end]));
    assert!((low..=high).contains(&0.5) && high - low < 1e-4, "{share}");
}

/// Beside the crush energies of both vehicles their total is no evidence of its own, unless it has an uncertainty of its own.
#[test]
fn the_total_of_both_crush_energies_adds_nothing() {
    let second = "depths = [\"0 ft\", \"0 ft\"]\nstiffness = { d0 = \"0 lbf^0.5\", d1 = \"1e6 lbf^0.5/ft\" }";
    let of = |total: &str| {
        let each = "\nvehicle.1.crush_energy = \"from crush\"\nvehicle.2.crush_energy = \"from crush\"";
        let both = replaced(
            &case("stiffness = { tests = \"tests.toml\" }"),
            &[
                (second, "depths = [0.3, 0.3]\nstiffness = { tests = \"tests.toml\" }"),
                ("\ncrush_energy = \"from crush\"", &format!("{each}{total}")),
            ],
        );
        let run = beside(&both, &[("tests.toml", &struble_welsh())], &RECONSTRUCT);
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        json(&run)
    };
    let (each, all) = (of(""), of("\ncrush_energy = \"from crush\""));
    let is_noted = |of: &Value| of["messages"].to_string().contains("total-left-out");
    assert!(is_noted(&all) && !is_noted(&each), "{}", all["notes"]);
    for key in ["unknown", "evidence", "degrees_of_freedom"] {
        assert_eq!(all[key], each[key], "{key}");
    }
    let own = of("\ncrush_energy = { value = \"from crush\", relative = 0.1 }");
    assert!(!is_noted(&own) && number(&own["degrees_of_freedom"]) == number(&each["degrees_of_freedom"]) + 1.0);
}

/// Of two vehicles with the stiffness of the same tests, the crush energies go up and down together.
#[test]
fn one_fit_for_two_vehicles_is_one_number() {
    let [d0, d1, d0_sd, d1_sd, correlation] = fit(&struble_welsh(), 1);
    let second = "depths = [\"0 ft\", \"0 ft\"]\nstiffness = { d0 = \"0 lbf^0.5\", d1 = \"1e6 lbf^0.5/ft\" }";
    let both = replaced(
        &case("stiffness = { tests = \"tests.toml\" }"),
        &[(second, "depths = [0.3, 0.3]\nstiffness = { tests = \"./tests.toml\" }")],
    );
    let run = beside(&both, &[("tests.toml", &struble_welsh())], &RECONSTRUCT);
    let document = json(&run);
    // E = w (d0 + d1 C)²/2 of each, so that dE/dd0 = w (d0 + d1 C) and dE/dd1 is C times that.
    let width = 5.0 * 0.3048;
    let slopes = [0.520335 * 0.3048, 0.3].map(|depth| (width * (d0 + d1 * depth), width * (d0 + d1 * depth) * depth));
    let (by_d0, by_d1) = (slopes[0].0 + slopes[1].0, slopes[0].1 + slopes[1].1);
    let variance = (by_d0 * d0_sd).powi(2) + (by_d1 * d1_sd).powi(2) + 2.0 * correlation * by_d0 * d0_sd * by_d1 * d1_sd;
    let sd = number(&document["evidence"]["crush_energy"]["sd"]);
    let wanted = BY_RESIDUALS * variance.sqrt();
    assert!((sd / wanted - 1.0).abs() < 1e-9, "{sd} {wanted}");
}

#[test]
fn tests_that_disagree_are_said_to() {
    let named = case("stiffness = { tests = \"tests.toml\" }");
    // Chi-square is 4.31 with one degree of freedom, of which 5 % is 3.84; with 1.1 times the standard deviations it is 3.56.
    let wider = struble_welsh().replace("0.3 ft/s", "0.33 ft/s").replace("_sd = 0.05", "_sd = 0.055").replace("\"5 lbf", "\"5.5 lbf");
    for (tests, disagree) in [(struble_welsh(), true), (wider, false)] {
        let document = json(&beside(&named, &[("tests.toml", &tests)], &RECONSTRUCT));
        assert_eq!(document["notes"].to_string().contains("differ by more than"), disagree, "{}", document["notes"]);
    }
}

#[test]
fn two_bare_tests_say_that_they_leave_the_doubt_open() {
    let text = struble_welsh();
    let parts: Vec<&str> = text.split("[[vehicle.test]]").collect();
    let bare: String = [parts[0], parts[1], parts[3]]
        .join("[[vehicle.test]]")
        .lines()
        .filter(|line| !line.contains("_sd") && !line.contains("scatter"))
        .map(|line| format!("{line}\n"))
        .collect();
    let document = json(&beside(&case("stiffness = { tests = \"tests.toml\" }"), &[("tests.toml", &bare)], &RECONSTRUCT));
    assert!(document["messages"].to_string().contains("it counts as certain"), "{}", document["messages"]);
    assert_eq!(document["evidence"]["crush_energy"]["sd"], Value::Null);
}

/// The other verbs use the fitted numbers.
#[test]
fn a_verb_that_needs_one_number_takes_the_fit() {
    let [d0, d1, ..] = fit(&struble_welsh(), 1);
    let named = case("stiffness = { tests = \"tests.toml\" }");
    let document = json(&beside(&named, &[("tests.toml", &struble_welsh())], &["crush", "--format", "json"]));
    let crush = &document["vehicles"][0];
    assert!((number(&crush["d0"]) / d0 - 1.0).abs() < 1e-12 && (number(&crush["d1"]) / d1 - 1.0).abs() < 1e-12, "{crush}");
    assert!(document["notes"].to_string().contains("nominal value"), "{}", document["notes"]);
}

#[test]
fn what_keeps_tests_from_use_is_said_at_their_key() {
    let text = struble_welsh();
    let one = text.split("[[vehicle.test]]").take(2).collect::<Vec<_>>().join("[[vehicle.test]]");
    let negative = text.replace("\"16.6537 ft/s\"", "\"1 ft/s\"");
    let wrong_unit = text.replace("\"101.91 slug\"", "\"101.91 ft\"");
    for (name, stiffness, tests, wanted) in [
        ("no file", "{ tests = \"none.toml\" }", "", &["vehicle.1.crush.stiffness.tests", "none.toml", "no such file"][..]),
        ("a folder", "{ tests = \".\" }", "", &["stiffness.tests", "is a directory"]),
        ("an empty name", "{ tests = \"\" }", "", &["stiffness.tests"]),
        ("a number", "{ tests = 3 }", "", &["stiffness.tests", "string"]),
        ("an empty file", "{ tests = \"tests.toml\" }", " ", &["stiffness.tests", "is empty"]),
        ("a case", "{ tests = \"case.toml\" }", "", &["stiffness.tests", "case.toml:"]),
        ("one test", "{ tests = \"tests.toml\" }", &one, &["stiffness.tests"]),
        (
            "a wrong unit",
            "{ tests = \"tests.toml\" }",
            &wrong_unit,
            &["stiffness.tests", "tests.toml:11: vehicle.1.test.1.mass", "101.91 ft"],
        ),
        ("a negative d0", "{ tests = \"tests.toml\" }", &negative, &["stiffness.tests", "d0 is", "below zero"]),
        ("no model", "{ tests = \"tests.toml\", model = \"mean\" }", &text, &["stiffness.model", "mean depth"]),
        ("d0 too", "{ tests = \"tests.toml\", d0 = 90 }", &text, &["stiffness.d0: unknown key"]),
        ("a model without tests", "{ d0 = 90, d1 = 900, model = \"profile\" }", "", &["stiffness.model: unknown key"]),
    ] {
        let run = beside(&case(&format!("stiffness = {stiffness}")), &[("tests.toml", tests)], &["reconstruct"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{name}: {}", run.err);
        assert!(wanted.iter().all(|part| run.err.contains(part)), "{name}: {}", run.err);
    }
}

#[test]
fn the_correlations_of_a_fit_are_its_own() {
    let named = case("stiffness = { tests = \"tests.toml\" }");
    let pair = "correlation = [[\"vehicle.1.crush.d0\", \"vehicle.1.crush.d1\", 0.5]]\n\n[[vehicle]]";
    let run = beside(&named.replacen("[[vehicle]]", pair, 1), &[("tests.toml", &struble_welsh())], &["reconstruct"]);
    assert!(run.status == 2 && run.err.contains("the tests that it is fitted to give its correlations"), "{}", run.err);
    let second = "stiffness = { d0 = \"0 lbf^0.5\", d1 = \"1e6 lbf^0.5/ft\" }";
    let other = replaced(&named, &[(second, "stiffness = { tests = \"tests.toml\", model = \"mean depth\" }")]);
    let run = beside(&other, &[("tests.toml", &struble_welsh())], &["reconstruct"]);
    assert!(run.status == 2 && run.err.contains("fitted to another model") && run.err.contains("vehicle.1.crush"), "{}", run.err);
}

/// The zones of a width may have tests of their own.
#[test]
fn a_zone_may_be_fitted_too() {
    let [d0, d1, d0_sd, ..] = fit(&struble_welsh(), 1);
    let zones = "stiffness = [{ tests = \"tests.toml\", to = \"2 ft\" }, { d0 = 90, d1 = 900 }]";
    let run = beside(&case(zones), &[("tests.toml", &struble_welsh())], &RECONSTRUCT);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let same = format!("stiffness = [{{ d0 = {d0}, d1 = {d1}, to = \"2 ft\" }}, {{ d0 = 90, d1 = 900 }}]");
    let plain = beside(&case(&same), &[], &RECONSTRUCT);
    let value = |run: &Run| number(&json(run)["unknown"]["vehicle.1.velocity.x"]["value"]);
    assert!((value(&run) / value(&plain) - 1.0).abs() < 1e-9 && d0_sd > 0.0);
    assert!(number(&json(&run)["evidence"]["crush_energy"]["sd"]) > 0.0);
}

/// Two tests each of vehicles whose stiffness differs by much more than their tests are uncertain.
fn of_a_class() -> String {
    of_vehicles(&[("A", [Some(0.16), Some(0.42)]), ("B", [Some(0.22), Some(0.60)])])
}

/// The same of these vehicles, by the depths after 7 m/s and after 15 m/s.
fn of_vehicles(vehicles: &[(&str, [Option<f64>; 2])]) -> String {
    let test = |speed: u8, depth: f64| {
        format!(
            "[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0.1\nwidth = 1.5\ndepths = [{depth}, {depth}]\nscatter = \"4 N^0.5\"\n"
        )
    };
    let vehicle = |(name, depths): &(&str, [Option<f64>; 2])| {
        let tests: String = [7, 15].into_iter().zip(depths).filter_map(|(speed, depth)| Some(test(speed, (*depth)?))).collect();
        format!("[[vehicle]]\nname = \"{name}\"\nnew_cars = true\n{tests}")
    };
    let further = "[fit]\ndepth = \"0.3 m\"\nwidth = \"1.5 m\"";
    format!("schema = 1\n{}{further}", vehicles.iter().map(vehicle).collect::<String>())
}

/// The vehicle of the case is another one of the class: the spread between those that were tested adds to the covariance of the line through all tests.
#[test]
fn the_spread_of_a_class_is_in_the_deviation() {
    // cli/tests/reference/class.py: the line through all tests, and the covariance of a further vehicle. Of the second class neither the spread of d0 nor that of d1 is
    // all that E* spreads at the depth where the line is known best.
    let first = [111.954_246_816_302_2, 669.007_637_370_993_9, 305.934_184_700_786_7, 1_997.561_715_215_766, -299_796.480_194_970_1];
    let second = [278.414_874_715_447, 200.569_022_757_638, 5_113.259_580_121_774, 14_591.896_384_085_76, -44_695_171.282_115_94];
    spread_is_in_the_deviation(&of_a_class(), first);
    spread_is_in_the_deviation(&of_vehicles(&[("A", [Some(0.10), Some(0.20)]), ("B", [Some(0.45), Some(0.60)])]), second);
}

fn spread_is_in_the_deviation(tests: &str, [d0, d1, d0_sd, d1_sd, covariance]: [f64; 5]) {
    let folder = Folder::new();
    folder.write("tests.toml", tests.as_bytes());
    let class = json(&run(folder.path(), &["stiffness", "tests.toml", "--format", "json"]));
    let [d0_of_line, d1_of_line, ..] = fit(tests, 1);
    assert!((d0_of_line / d0 - 1.0).abs() < 1e-12 && (d1_of_line / d1 - 1.0).abs() < 1e-12, "{d0_of_line} {d1_of_line}");
    let of_energy =
        |width: f64, depth: f64| width * (d0 + d1 * depth) * (d0_sd * d0_sd + 2.0 * depth * covariance + (depth * d1_sd).powi(2)).sqrt();
    let document = json(&beside(&case("stiffness = { tests = \"tests.toml\" }"), &[("tests.toml", tests)], &RECONSTRUCT));
    // `stiffness` prints the deviations of the line, and notes those of a further vehicle.
    let notes: Vec<&Value> =
        class["messages"].as_array().expect("notes").iter().filter(|note| note["code"] == "spread-between-vehicles").collect();
    assert_eq!(notes.len(), 2, "{}", class["messages"]);
    let prediction = &class["fits"][1]["prediction"];
    let [width, depth] = ["width", "depth"].map(|key| number(&prediction[key]));
    let figures = notes[1]["figures"].as_array().expect("figures");
    assert_eq!(figures.len(), 3);
    for (figure, sd) in figures.iter().zip([d0_sd, d1_sd, of_energy(width, depth)]) {
        assert!((number(&figure["value"]) / sd - 1.0).abs() < 1e-9, "{figure} {sd}");
    }
    let sd = number(&document["evidence"]["crush_energy"]["sd"]);
    let wanted = of_energy(5.0 * 0.3048, 0.520335 * 0.3048);
    assert!((sd / wanted - 1.0).abs() < 1e-6, "{sd} {wanted}");
    assert!(document["messages"].to_string().contains("4 tests of 2 vehicles, with the spread between them"), "{}", document["messages"]);
}

/// The spread between vehicles is in the deviation whatever the line of one of them alone is, and where few or none of them has one, that is said.
#[test]
fn a_vehicle_without_a_stiffness_of_its_own_does_not_hide_the_spread() {
    let of = |vehicles: &[(&str, [Option<f64>; 2])]| {
        let document =
            json(&beside(&case("stiffness = { tests = \"tests.toml\" }"), &[("tests.toml", &of_vehicles(vehicles))], &RECONSTRUCT));
        (number(&document["evidence"]["crush_energy"]["sd"]), document["messages"].to_string())
    };
    let both = |shallow, deep| [Some(shallow), Some(deep)];
    let (sound, few) = of(&[("A", both(0.16, 0.42)), ("B", both(0.22, 0.60)), ("C", both(0.19, 0.50))]);
    assert!(few.contains("of 3 vehicles, with the spread between them as far as they tell"), "{few}");
    // The line of C alone begins below zero: 7 m/s leave more than 7/15 of the depth that 15 m/s leave.
    let (negative, told) = of(&[("A", both(0.16, 0.42)), ("B", both(0.22, 0.60)), ("C", both(0.28, 0.50))]);
    assert!(negative > 0.5 * sound && told.contains("of 3 vehicles, with the spread between them"), "{negative} {sound} {told}");
    let (alone, told) = of(&[("A", both(0.16, 0.42)), ("B", both(0.22, 0.60)), ("C", [None, Some(0.50)])]);
    assert!(alone > 0.5 * sound && told.contains("with the spread between the 2 with a line of their own"), "{alone} {sound} {told}");
    let none_has_one = [("A", [None, Some(0.42)]), ("B", [None, Some(0.60)]), ("C", [Some(0.20), None])];
    let (_, none) = of(&none_has_one);
    assert!(none.contains("without the spread between them") && none.contains("\"warning\""), "{none}");
    let fitted = run_with_input(&["stiffness", "-"], &of_vehicles(&none_has_one));
    assert!(fitted.status <= 1 && fitted.out.contains("the tests of 3 vehicles are"), "{}{}", fitted.out, fitted.err);
}

/// Three tests leave one degree of freedom, of which a scatter has no standard deviation.
#[test]
fn few_residuals_are_told() {
    let bare: String =
        struble_welsh().lines().filter(|line| !line.contains("_sd") && !line.contains("scatter")).map(|line| format!("{line}\n")).collect();
    let told = |tests: &str| {
        beside(&case("stiffness = { tests = \"tests.toml\" }"), &[("tests.toml", tests)], &RECONSTRUCT)
            .out
            .contains("the standard deviations are 6.5 times those of the fit")
    };
    assert!(told(&bare) && !told(&struble_welsh()));
}
