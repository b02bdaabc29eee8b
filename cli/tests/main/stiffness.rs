//! The verb `stiffness`.

use serde_json::Value;

use crate::process::{Folder, Run, run, run_with_input, workspace};

fn example(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/examples/tests").join(name)).expect("the example can be read")
}

fn json(text: &str) -> Value {
    let run = run_with_input(&["stiffness", "-", "--format", "json"], text);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// 1 lbf^0.5 in N^0.5, and 1 ft lbf in J.
const ROOT_POUND: f64 = 2.109_080_751_242_2;
const FOOT_POUND: f64 = 1.355_817_948_331_4;

#[test]
fn the_published_coefficients_of_one_test() {
    let document = json(&example("malibu.toml"));
    let test = &document["tests"][0];
    // NHTSA test 6268 as published: b1 = 29.8375 1/s, A = 79010.7 N/m, B = 1071581 N/m².
    for (key, published, digit) in [("b1", 29.8375, 0.000_05), ("A", 79_010.7, 0.05), ("B", 1_071_581.0, 0.5)] {
        assert!((number(&test["on_mean_depth"][key]) - published).abs() <= digit, "{key}");
    }
    // The energy of the test is ½ 1779 kg (15.6 m/s)²; the measured profile gives a lower slope than the mean depth.
    assert!((number(&test["crush_energy"]) - 0.5 * 1779.0 * 15.6 * 15.6).abs() < 1e-6);
    assert!(number(&test["on_profile"]["d1"]) < number(&test["on_mean_depth"]["d1"]));
    assert_eq!(document["fits"], serde_json::json!([]));
}

#[test]
fn three_tests_of_one_car() {
    let document = json(&example("struble-welsh.toml"));
    let energies: Vec<f64> =
        document["tests"].as_array().expect("tests").iter().map(|test| (number(&test["crush_energy"]) / FOOT_POUND).round()).collect();
    // The crush energies of Table B2 for tests with restitution.
    assert_eq!(energies, [13_674.0, 56_876.0, 125_102.0]);
    let fit = &document["fits"][0];
    assert_eq!((fit["model"].as_str(), fit["degrees_of_freedom"].as_u64()), (Some("mean depth"), Some(1)));
    assert!((number(&fit["d0"]) / ROOT_POUND - 62.65).abs() < 0.005, "{fit}");
    // Both fits are the same for flat profiles.
    let other = &document["fits"][1];
    for key in ["d0", "d1", "chi_square"] {
        assert!((number(&fit[key]) / number(&other[key]) - 1.0).abs() < 1e-9, "{key}");
    }
    assert!((number(&fit["prediction"]["crush_energy"]) / FOOT_POUND - 116_062.0).abs() < 1.0);
    assert!((number(&fit["prediction"]["sd"]) / FOOT_POUND - 4_903.0).abs() < 1.0);
}

#[test]
fn without_deviations_the_residuals_tell_the_scatter() {
    let bare: String = example("struble-welsh.toml")
        .lines()
        .filter(|line| !line.contains("_sd") && !line.contains("scatter"))
        .map(|line| format!("{line}\n"))
        .collect();
    let document = json(&bare);
    let fit = &document["fits"][0];
    assert_eq!(fit["covariance"]["basis"], "residuals");
    assert_eq!(fit["residuals"][0]["standardised"], Value::Null);
    // The regression line through the three points, with the scatter of one degree of freedom computed by hand.
    let (x, y): (Vec<f64>, Vec<f64>) = [(0.1062, 73.9587), (0.5203, 150.8325), (1.0768, 223.6984)].into_iter().unzip();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / 3.0;
    let sxx: f64 = x.iter().map(|x_i| (x_i - mean(&x)).powi(2)).sum();
    let slope = x.iter().zip(&y).map(|(x_i, y_i)| (x_i - mean(&x)) * y_i).sum::<f64>() / sxx;
    let onset = mean(&y) - slope * mean(&x);
    let scatter: f64 = x.iter().zip(&y).map(|(x_i, y_i)| (y_i - onset - slope * x_i).powi(2)).sum();
    assert!((number(&fit["d0"]) / ROOT_POUND - onset).abs() < 0.01);
    assert!((number(&fit["covariance"]["d1_sd"]) / ROOT_POUND * 0.3048 - (scatter / sxx).sqrt()).abs() < 0.01);
    // Two tests leave no residual from which to compute it.
    let two = bare.split("[[vehicle.test]]").enumerate().filter(|(i, _)| *i != 2).map(|(_, part)| part).collect::<Vec<_>>();
    let document = json(&two.join("[[vehicle.test]]"));
    assert_eq!((&document["fits"][0]["covariance"], &document["fits"][0]["prediction"]["sd"]), (&Value::Null, &Value::Null));
}

/// By the table of Student's distribution: 12.71 for one degree of freedom, 4.30 for two, 2.160 for thirteen, a tenth more than 1.96, and 2.145 for fourteen.
#[test]
fn a_scatter_that_few_tests_tell_is_noted() {
    let tests = |count: usize, sd: &str| {
        let test = |i: usize| {
            let (speed, depth) = (5.0 + 0.5 * i as f64 + 0.1 * (i % 2) as f64, 0.1 + 0.03 * i as f64);
            format!(
                "[[vehicle.test]]\nmass = 1500\nspeed = \"{speed} m/s\"\n{sd}restitution = 0.1\nwidth = 1.5\ndepths = [{depth}, {depth}]\n"
            )
        };
        format!("schema = 1\n[[vehicle]]\nnew_cars = true\n{}", (0..count).map(test).collect::<String>())
    };
    let noted = |count, sd| {
        let answer = json(&tests(count, sd));
        let messages = answer["messages"].as_array().expect("messages").clone();
        messages
            .iter()
            .filter(|one| one["code"] == "few-tests")
            .map(|one| one["text"].as_str().expect("a text").to_owned())
            .collect::<Vec<_>>()
    };
    for (count, says) in
        [(3, "with 1 degree of freedom: a range of 95 % is ± 12.7 "), (4, "with 2 degrees of freedom: a range of 95 % is ± 4.3 ")]
    {
        assert!(noted(count, "")[..].iter().all(|text| text.contains(says)) && noted(count, "").len() == 1, "{:?}", noted(count, ""));
    }
    assert_eq!([2, 15, 16].map(|count| noted(count, "").len()), [0, 1, 0]);
    assert!(noted(3, "speed_sd = \"0.1 m/s\"\n").is_empty());
}

#[test]
fn the_text_fits_a_terminal() {
    for name in ["struble-welsh.toml", "malibu.toml"] {
        for units in ["si", "us"] {
            let long = example(name).replace("name = \"", "name = \"a car with a very long name, a ");
            let run = run_with_input(&["stiffness", "-", "--units", units], &long);
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{name}");
            for line in run.out.lines() {
                assert!(line.chars().count() <= 80 && line.trim_end() == line, "{name} {units}: {line}");
            }
        }
    }
}

#[test]
fn each_mistake_is_named_where_it_is() {
    let refused = |from: &str, to: &str, says: &[&str]| {
        let text = example("struble-welsh.toml");
        assert!(text.contains(from), "{from}");
        let run: Run = run_with_input(&["stiffness", "-"], &text.replacen(from, to, 1));
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{to}: {}", run.err);
        for words in says {
            assert!(run.err.contains(words), "{to}: {words}: {}", run.err);
        }
        assert!(!run.err.contains("panicked") && !run.err.contains("defect"), "{}", run.err);
    };
    refused("mass = \"101.91 slug\"", "mass = 0", &["vehicle.1.test.1.mass", "above zero"]);
    refused("\"16.6537 ft/s\"", "\"-16.6537 ft/s\"", &["vehicle.1.test.1.speed", "above zero"]);
    refused("0.18", "1.18", &["vehicle.1.test.1.restitution", "from 0 to 1"]);
    refused("restitution = 0.18", "restitution = 1", &["vehicle.1.test.1", "crush energy"]);
    refused("width = \"5 ft\"\n", "", &["vehicle.1.test.1.width: missing"]);
    refused("[\"0.1062 ft\", \"0.1062 ft\"]", "[\"0.1062 ft\"]", &["vehicle.1.test.1.depths", "at least 2"]);
    refused("[\"0.1062 ft\", \"0.1062 ft\"]", "[\"2 ft\", \"2 ft\"]", &["vehicle.1.test.2.depths", "out of order", "in their order"]);
    refused(
        "\"16.6537 ft/s\"",
        "\"16.6537 ± 0.3 ft/s\"",
        &["vehicle.1.test.1.speed: its standard deviation", "give the value alone, and speed_sd"],
    );
    refused("= 0.18", "= \"0.18 ± 0.02\"", &["vehicle.1.test.1.restitution: its standard deviation", "and restitution_sd"]);
    refused("speed_sd = \"0.3 ft/s\"", "speed_sd = \"-0.3 ft/s\"", &["vehicle.1.test.1.speed_sd", "below zero"]);
    refused("speed_sd = \"0.3 ft/s\"", "speed_sd = \"1e200 ft/s\"", &["vehicle.1.test.1.speed_sd"]);
    refused("scatter = \"5 lbf^0.5\"", "scatter = \"5 lbf\"", &["vehicle.1.test.1.scatter"]);
    refused("scatter", "skatter", &["vehicle.1.test.1.skatter: unknown key", "`scatter`"]);
    refused("depth = \"1 ft\"\n", "", &["fit.depth: missing"]);
    refused("[fit]", "[fit]\nonset = \"60 ft/s\"", &["fit.onset", "60"]);
    refused("[fit]", "[fit]\nb0 = \"60 ft/s\"", &["fit.b0", "60"]);
    refused("name = \"Cavalier\"", "name = 3", &["vehicle.1.name"]);
    // For a test of another vehicle, the path names that test.
    let second =
        "\n[[vehicle]]\n[[vehicle.test]]\nmass = 1500\nspeed = 15\nrestitution = 0.1\nwidth = 1.5\ndepths = [0.4, 0.4]\nscatter = 10\n";
    let at_second = |from: &str, to: &str, says: &[&str]| {
        assert!(second.contains(from), "{from}");
        refused("\n[fit]", &format!("{}\n[fit]\nonset = \"2 m/s\"", second.replacen(from, to, 1)), says);
    };
    at_second("mass = 1500", "mass = 0", &["vehicle.2.test.1.mass", "above zero"]);
    at_second("scatter = 10", "scatter = 0", &["vehicle.2.test.1: variance is 0", "above zero", "scatter above zero"]);
    at_second("[0.4, 0.4]", "[0, 0]", &["vehicle.2.test.1.depths: mean depth is 0", "above zero"]);
    at_second("speed = 15\n", "speed = 1\n", &["fit.onset", "assumed to be 6.56 ft/s"]);
    at_second("scatter = 10\n", "", &["vehicle.2.test.1: no standard deviation here, though other tests have one", "scatter"]);
    let of_many = |count: usize| {
        let test = |mass: usize| format!("[[vehicle.test]]\nmass = {mass}\nspeed = 1\nrestitution = 0\nwidth = 1\ndepths = [0.1, 0.1]\n");
        let tests: String = (1..=count).map(test).collect();
        run_with_input(&["stiffness", "-"], &format!("schema = 1\n[[vehicle]]\n{tests}"))
    };
    let (most, many) = (of_many(500), of_many(501));
    assert!(most.err.contains("all tests have the mean depth") && !most.err.contains("limit"), "{}", most.err);
    assert!(many.status == 2 && many.err.contains("501 tests"), "{}", many.err);
    let none = run_with_input(&["stiffness", "-"], "schema = 1\n[[vehicle]]\nname = \"new\"\n");
    assert!(none.status == 2 && none.err.contains("vehicle.1.test: missing"), "{}", none.err);
    let one = example("malibu.toml").replace("onset = \"2.2 m/s\"", "");
    let alone = run_with_input(&["stiffness", "-"], &one);
    assert_eq!(alone.status, 2, "one test without an onset tells no stiffness: {}", alone.out);
    assert!(alone.err.contains("onset"), "{}", alone.err);
}

/// Returns two vehicles with equal mean depths, and an onset if given.
fn one_depth(onset: &str) -> String {
    let test = |speed: i32| {
        format!("[[vehicle]]\n[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0.1\nwidth = 1.5\ndepths = [0.4, 0.4]\n")
    };
    format!("schema = 1\n{}{}[fit]\n{onset}\n", test(15), test(16))
}

#[test]
fn one_depth_has_no_line_but_a_stiffness_with_an_onset() {
    let refused = run_with_input(&["stiffness", "-"], &one_depth(""));
    assert!(refused.status == 2 && refused.out.is_empty(), "{}", refused.out);
    assert!(
        refused.err.contains("vehicle: all tests have the mean depth 0.4") && refused.err.contains("b0 = \"2 m/s\" under [fit]"),
        "{}",
        refused.err
    );
    let document = json(&one_depth("onset = 2"));
    assert_eq!(document["fits"], serde_json::json!([]));
    let note = "all tests have the same mean depth: no line can be fitted through them";
    assert!(document["notes"].as_array().is_some_and(|notes| notes.iter().any(|each| each == note)), "{document}");
    for (i, speed) in [15.0, 16.0].into_iter().enumerate() {
        // b1 = (v √(1 − e²) − b0)/C, by hand.
        let b1 = (speed * 0.99_f64.sqrt() - 2.0) / 0.4;
        assert!((number(&document["tests"][i]["on_mean_depth"]["b1"]) - b1).abs() < 1e-12, "{document}");
    }
    let run = run_with_input(&["stiffness", "-"], &one_depth("onset = 2"));
    assert!(run.status == 0 && run.out.contains("same mean depth") && run.out.contains("2: profile"), "{}{}", run.out, run.err);
}

#[test]
fn findings_are_said_in_the_units_of_the_report() {
    let falling = one_depth("").replacen("[0.4, 0.4]", "[0.5, 0.5]", 1).replace("speed = 16", "speed = 20");
    let finding =
        |units: &str| run_with_input(&["stiffness", "-", "--units", units], &falling).out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(finding("si").contains("d1 is -") && finding("si").contains("N^0.5/m, below zero"), "{}", finding("si"));
    assert!(finding("us").contains("lbf^0.5/ft, below zero") && !finding("us").contains("N^0.5"), "{}", finding("us"));
    let document = doubted(&falling);
    let said = document["fits"][0]["findings"][0].as_str().expect("a finding").to_owned();
    assert!(said.contains("N^0.5/m, below zero: the structure would take less energy the deeper it is crushed"), "{said}");
}

fn reproducer(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/tests/reproducers").join(name)).expect("a reproducer")
}

/// Runs the verb on tests that make no stiffness, or may not.
fn doubted(text: &str) -> Value {
    let run = run_with_input(&["stiffness", "-", "--format", "json"], text);
    assert_eq!((run.status, run.err.as_str()), (1, ""), "{}", run.out);
    serde_json::from_str(&run.out).expect("JSON")
}

/// The line of least squares through E* = v √(m (1 − e²)/w) of the new cars, at 0.3, 0.4 and 0.5 m.
fn line_of_new_cars() -> (f64, f64) {
    let intensities =
        [(40.0, 0.15), (48.0, 0.13), (56.0, 0.12)].map(|(speed, e): (f64, f64)| speed / 3.6 * (1200.0 * (1.0 - e * e) / 1.4).sqrt());
    let slope = (intensities[2] - intensities[0]) / 0.2;
    (intensities.iter().sum::<f64>() / 3.0 - 0.4 * slope, slope)
}

#[test]
fn new_cars_taken_as_one_are_recognized() {
    let text = reproducer("new_cars_as_one.toml");
    let document = doubted(&text);
    let headline = document["headlines"][0].as_str().expect("a headline");
    for says in ["car: as repeated tests of one car", "d0 is -20", "as tests of new cars d0 is 12", "new_cars = true"] {
        assert!(headline.contains(says), "{says}: {headline}");
    }
    let (onset, slope) = line_of_new_cars();
    assert!(number(&document["fits"][0]["d0"]) < 0.0 && (100.0..150.0).contains(&onset));
    let as_new = &document["fits_as_new_cars"][0];
    assert!((number(&as_new["d0"]) / onset - 1.0).abs() < 1e-9 && (number(&as_new["d1"]) / slope - 1.0).abs() < 1e-9, "{as_new}");
    // The page says it before any table.
    let page = run_with_input(&["stiffness", "-"], &text);
    assert!(
        page.status == 1 && page.out.find("new_cars = true") < page.out.find("v_n") && page.out.contains("as new cars, on"),
        "{}",
        page.out
    );
    // As the file may say.
    let said = |new_cars: &str| text.replace("name = \"car\"\n", &format!("name = \"car\"\nnew_cars = {new_cars}\n"));
    let new = json(&said("true"));
    assert_eq!((&new["headlines"], &new["fits"]), (&serde_json::json!([]), &document["fits_as_new_cars"]));
    assert!(
        (number(&new["tests"][1]["crush_energy"]) - 600.0 * (1.0 - 0.13 * 0.13) * (48.0_f64 / 3.6).powi(2)).abs() < 1e-6,
        "of this test alone"
    );
    let one = doubted(&said("false"));
    assert_eq!((&one["fits"], one.get("fits_as_new_cars")), (&document["fits"], None));
    assert!(one["headlines"][0].as_str().is_some_and(|headline| headline.starts_with("no stiffness fitted on mean depth: d0 is -")));
    // New cars come in any order, and an issue with one has its place.
    let mut parts: Vec<String> = said("true").split("[[vehicle.test]]").map(str::to_owned).collect();
    parts.swap(1, 3);
    assert!((number(&json(&parts.join("[[vehicle.test]]"))["fits"][0]["d0"]) / onset - 1.0).abs() < 1e-9);
    let elastic = run_with_input(&["stiffness", "-"], &said("true").replace("restitution = 0.13", "restitution = 1"));
    assert!(elastic.status == 2 && elastic.err.contains("vehicle.1.test.2: crush energy"), "{}", elastic.err);
    // Repeated tests of one car stay repeated tests of one car.
    assert_eq!(json(&example("struble-welsh.toml"))["headlines"], serde_json::json!([]));
}

#[test]
fn a_negative_coefficient_is_a_headline() {
    let document = doubted(&reproducer("negative_A.toml"));
    for (i, model) in ["mean depth", "profile"].into_iter().enumerate() {
        let headline = document["headlines"][i].as_str().expect("a headline");
        assert!(
            headline.starts_with(&format!("no stiffness fitted on {model}: d1 is -")) && headline.contains("A = d0 d1 is -"),
            "{headline}"
        );
    }
    assert!(
        (number(&document["fits"][0]["A"]) + 597_421.0).abs() < 1.0 || (number(&document["fits"][1]["A"]) + 597_421.0).abs() < 1.0,
        "{document}"
    );
    // A case that takes its stiffness from such tests is refused.
    let falling = one_depth("").replacen("[0.4, 0.4]", "[0.5, 0.5]", 1).replace("speed = 16", "speed = 20");
    assert!(doubted(&falling)["headlines"][0].as_str().is_some_and(|headline| headline.contains("d1 is -")));
}

/// Three vehicles of a class with one test each, and a scatter of E*; `pooled.py` has the same.
fn class(scatter: &str) -> String {
    let test = |(mass, width, speed, e, depth): (f64, f64, f64, f64, f64)| {
        format!(
            "[[vehicle]]\n[[vehicle.test]]\nmass = {mass}\nspeed = {speed}\nrestitution = {e}\nwidth = {width}\ndepths = [{depth}, {depth}]\n{scatter}\n"
        )
    };
    let tests = [(1500.0, 1.5, 15.0, 0.1, 0.40), (1600.0, 1.6, 14.0, 0.15, 0.45), (1300.0, 1.4, 16.0, 0.12, 0.38)].map(test);
    format!("schema = 1\n{}[fit]\nb0 = \"2 m/s\"\n", tests.concat())
}

#[test]
fn vehicles_of_a_class_are_pooled() {
    // Mean, its standard deviation, the standard deviation between vehicles, and that of a further one: cli/tests/reference/pooled.py.
    for (scatter, d1) in [
        ("scatter = 10", [988.643_086_996_892_2, 182.332_423_506_207_5, 141.441_195_234_104_5, 363.836_139_288_075_9]),
        ("scatter = 60", [972.231_501_046_525_4, 242.591_333_172_729_04, 11.233_862_339_256_445, 462.294_602_666_537_6]),
    ] {
        let document = json(&class(scatter));
        for pooled in document["pooled"].as_array().expect("two models") {
            for (key, wanted) in ["mean", "mean_sd", "between_sd", "further_sd"].into_iter().zip(d1) {
                assert!((number(&pooled["d1"][key]) - wanted).abs() <= 1e-9 * wanted, "{scatter}: {key}: {pooled}");
            }
            // d0 = b0 √(m/w) is held, and differs by the vehicle alone.
            let onsets = [1500.0 / 1.5, 1600.0 / 1.6, 1300.0 / 1.4].map(|share: f64| 2.0 * share.sqrt());
            let mean = onsets.iter().sum::<f64>() / 3.0;
            let sd = (onsets.iter().map(|onset| (onset - mean).powi(2)).sum::<f64>() / 2.0).sqrt();
            assert!(
                (number(&pooled["d0"]["mean"]) / mean - 1.0).abs() < 1e-12 && (number(&pooled["d0"]["between_sd"]) / sd - 1.0).abs() < 1e-9
            );
            // Student's quantile of two degrees of freedom, and a mean of three.
            let student = 4.302_652_729_749_464 / 1.959_963_984_540_054 * sd;
            for (key, share) in [("mean_sd", 1.0_f64 / 3.0), ("further_sd", 4.0 / 3.0)] {
                assert!((number(&pooled["d0"][key]) / (student * share.sqrt()) - 1.0).abs() < 1e-9, "{key}: {pooled}");
            }
            assert_eq!((pooled["vehicles"][2]["name"].as_str(), number(&pooled["vehicles"][2]["d0_sd"])), (Some("vehicle 3"), 0.0));
            let own_sd: f64 = scatter.trim_start_matches("scatter = ").parse().expect("a number");
            assert!((number(&pooled["vehicles"][2]["d1_sd"]) / (own_sd / 0.38) - 1.0).abs() < 1e-12, "{pooled}");
        }
    }
    let page = run_with_input(&["stiffness", "-", "--units", "si"], &class("scatter = 10"));
    assert!(page.status == 0 && page.out.contains("sd between vehicles") && page.out.contains("Paule and Mandel"), "{}", page.out);
    assert!(page.out.lines().all(|line| line.chars().count() <= 80), "{}", page.out);
    // With an assumed onset each single test has a stiffness as well; without any, none has.
    let assumed = doubted(&class("").replace("b0 =", "onset ="));
    assert_eq!(assumed["pooled"].as_array().map(Vec::len), Some(2));
    let free = class("").replace("b0 = \"2 m/s\"\n", "");
    let run = run_with_input(&["stiffness", "-", "--format", "json"], &free);
    assert!(run.status < 2 && !run.out.contains("\"pooled\""), "{}", run.out);
}

/// Two uneven profiles that no stiffness has: the best lies where d0 and d1 do the same to each, and the tests do not tell them apart. The fit on mean depth stays.
#[test]
fn profiles_that_do_not_tell_the_coefficients_apart_are_told() {
    let test = |speed: f64, depths: &str| {
        format!("[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0\nscatter = 10\nwidth = 1.5\ndepths = {depths}\n")
    };
    let second = test(15.4, "[0.39, 0.28, 0.33, 0.56, 0.53, 0.6]");
    for deepest in [0.60, 0.62, 0.64, 0.65, 0.66, 0.67] {
        let first = test(8.4, &format!("[{deepest}, 0.52, 0, 0, 0.02, 0.02]"));
        let tests = format!("schema = 1\n[[vehicle]]\nname = \"a\"\nnew_cars = true\n{first}{second}");
        let document = json(&tests);
        assert_eq!(document["fits"].as_array().map(Vec::len), Some(1), "{deepest}: {document}");
        let text = document["messages"].to_string();
        assert!(text.contains("no stiffness fitted on profile: d0 and d1 change E* of all tests alike"), "{text}");
        let page = run_with_input(&["stiffness", "-"], &tests);
        assert!(page.status == 0 && !page.out.contains("NaN"), "{}", page.out);
        // A class of such a vehicle and two others has the spread between those.
        let other = |name: &str, depth: f64| {
            let flat = |depth: f64| format!("[{depth}, {depth}]");
            format!("[[vehicle]]\nname = \"{name}\"\nnew_cars = true\n{}{}", test(8.0, &flat(depth - 0.3)), test(15.0, &flat(depth)))
        };
        let class = json(&format!("{tests}{}{}", other("b", 0.47), other("c", 0.5)));
        let vehicles: Vec<_> =
            class["pooled"].as_array().into_iter().flatten().map(|pooled| pooled["vehicles"].as_array().map(Vec::len)).collect();
        assert_eq!(vehicles, [Some(3), Some(2)], "{class}");
        // A case that fits them on profiles is refused, with the remedy.
        let folder = Folder::new();
        folder.write("tests.toml", tests.as_bytes());
        let case = |model: &str| {
            let example = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/from-tests.toml")).expect("the example");
            let case = example.replace("{ tests = \"../tests/struble-welsh.toml\" }", &format!("{{ tests = \"tests.toml\"{model} }}"));
            folder.write("case.toml", case.as_bytes());
            run(folder.path(), &["crush", "case.toml"])
        };
        let refused = case("");
        assert_eq!(refused.status, 2, "{}", refused.out);
        assert!(
            refused.err.contains("the profiles do not tell the two apart") && refused.err.contains("model = \"mean depth\""),
            "{}",
            refused.err
        );
        let sound = case(", model = \"mean depth\"");
        assert!(sound.status <= 1, "{}", sound.err);
    }
}

#[test]
fn a_held_b0_fits_d1_alone() {
    let held = example("malibu.toml").replace("onset =", "b0 =");
    let document = json(&held);
    let fits = document["fits"].as_array().expect("fits");
    assert_eq!(fits.len(), 2);
    for (fit, alone) in fits.iter().zip(["on_mean_depth", "on_profile"]) {
        for key in ["d0", "d1", "A", "B", "G"] {
            assert!((number(&fit[key]) / number(&document["tests"][0][alone][key]) - 1.0).abs() < 1e-9, "{alone} {key}: {fit}");
        }
        assert_eq!((fit["degrees_of_freedom"].as_u64(), &fit["covariance"]), (Some(0), &Value::Null));
    }
    // Three tests of one car by hand: d1 = Σ C (E* − d0)/Σ C² where the tests weigh alike.
    let bare: String = example("struble-welsh.toml")
        .lines()
        .filter(|line| !line.contains("_sd") && !line.contains("scatter"))
        .map(|line| format!("{line}\n"))
        .collect();
    let series = json(&bare.replace("[fit]", "[fit]\nb0 = \"10 ft/s\""));
    let onset = 10.0 * (101.91_f64 / 5.0).sqrt();
    let (depths, intensities) = ([0.1062, 0.5203, 1.0768], [73.9587, 150.8325, 223.6984]);
    let squares: f64 = depths.iter().map(|depth| depth * depth).sum();
    let slope = depths.iter().zip(intensities).map(|(depth, intensity)| depth * (intensity - onset)).sum::<f64>() / squares;
    let fit = &series["fits"][0];
    assert!(
        (number(&fit["d0"]) / ROOT_POUND / onset - 1.0).abs() < 1e-6 && (number(&fit["d1"]) / ROOT_POUND * 0.3048 - slope).abs() < 0.01,
        "{fit}"
    );
    let covariance = &fit["covariance"];
    assert_eq!((fit["degrees_of_freedom"].as_u64(), number(&covariance["d0_sd"]), number(&covariance["correlation"])), (Some(2), 0.0, 0.0));
    // Vehicles of other masses per width have no common fit.
    let document = json(&class("scatter = 10"));
    assert_eq!(document["fits"], serde_json::json!([]));
    assert!(document["messages"].as_array().expect("messages").iter().any(|message| message["code"] == "onset-of-each"));
    let both = run_with_input(&["stiffness", "-"], &held.replace("\nb0 =", "\nonset = 2\nb0 ="));
    assert!(both.status == 2 && both.err.contains("fit.b0: `onset` and `b0` exclude each other"), "{}", both.err);
}

#[test]
fn a_rebound_speed_gives_the_restitution() {
    let by_speed = example("malibu.toml").replace("restitution = 0\n", "rebound_speed = \"1.95 m/s\"\n");
    assert!(by_speed.contains("rebound_speed"));
    let document = json(&by_speed);
    let (speed, rebound) = (15.6_f64, 1.95_f64);
    assert!((number(&document["tests"][0]["restitution"]) - rebound / speed).abs() < 1e-15);
    let energy = 0.5 * 1779.0 * (speed * speed - rebound * rebound);
    assert!((number(&document["tests"][0]["crush_energy"]) / energy - 1.0).abs() < 1e-12);
    let refused = |from: &str, to: &str| run_with_input(&["stiffness", "-"], &by_speed.replace(from, to)).err;
    assert!(
        refused("1.95 m/s", "15.7 m/s")
            .contains("vehicle.1.test.1.rebound_speed: it is 15.7 m/s; it must not be above the speed of the test")
    );
    assert!(refused("1.95 m/s", "-1 m/s").contains("below zero"));
    assert!(refused("rebound_speed", "restitution = 0.1\nrebound_speed").contains("`restitution` and `rebound_speed` exclude each other"));
}

/// With the rebound speed u measured beside it, the energy ½m(v² − u²) grows with the speed by m v, and with a given restitution by m v (1 − e²).
#[test]
fn a_speed_of_a_test_with_a_rebound_speed_tells_more_of_the_energy() {
    let of = |rebound: &str, sd: f64| {
        let test = |speed: f64, depth: f64| {
            let rebound = rebound.replace("@", &(speed / 2.0).to_string());
            format!(
                "[[vehicle.test]]\nmass = 1500\nspeed = {speed}\n{rebound}\nspeed_sd = {sd}\nwidth = 1.5\ndepths = [{depth}, {depth}]\n"
            )
        };
        let tests = [(4.0, 0.1), (6.0, 0.22), (8.0, 0.3)].map(|(speed, depth)| test(speed, depth)).concat();
        json(&format!("schema = 1\n[[vehicle]]\nnew_cars = true\n{tests}"))["fits"].clone()
    };
    let close = |one: &Value, other: &Value| {
        for key in ["d0_sd", "d1_sd", "correlation"] {
            let [one, other] = [one, other].map(|fits| number(&fits[0]["covariance"][key]));
            assert!((one / other - 1.0).abs() < 1e-9, "{key}: {one} and {other}");
        }
    };
    close(&of("rebound_speed = @", 0.3), &of("restitution = 0.5", 0.4));
    // A deviation of the restitution is that of all of it.
    close(&of("rebound_speed = @\nrestitution_sd = 0.02", 0.3), &of("restitution = 0.5\nrestitution_sd = 0.02", 0.3));
}

/// A held: by hand, of one test d1 solves C d1² − E* d1 + A = 0, and A = d0 d1 stays as given for any number of tests.
#[test]
fn a_held_force_leaves_one_coefficient() {
    let folder = Folder::new();
    let test = |speed: f64, depth: f64| {
        format!("[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0.1\nwidth = 1.5\ndepths = [{depth}, {depth}]\n")
    };
    let answer = |tests: &[String], fit: &str| {
        folder.write("tests.toml", format!("schema = 1\n[[vehicle]]\nnew_cars = true\n{}[fit]\n{fit}\n", tests.concat()).as_bytes());
        run(folder.path(), &["stiffness", "tests.toml", "--format", "json"])
    };
    let fits = |run: &Run| serde_json::from_str::<Value>(&run.out).unwrap_or_else(|_| panic!("{}", run.err))["fits"].clone();
    let one = fits(&answer(&[test(13.0, 0.4)], "A = \"50 kN/m\""));
    // E* = v √((1 − e²) m/w).
    let intensity = 13.0 * (0.99 * 1500.0 / 1.5_f64).sqrt();
    let slope = (intensity + (intensity * intensity - 4.0 * 50e3 * 0.4).sqrt()) / 0.8;
    for fit in one.as_array().expect("two fits") {
        let number = |key: &str| fit[key].as_f64().expect("a number");
        assert!(
            (number("d1") / slope - 1.0).abs() < 1e-9 && (number("A") / 50e3 - 1.0).abs() < 1e-9 && fit["degrees_of_freedom"] == 0,
            "{fit}"
        );
    }
    let three = fits(&answer(&[test(6.0, 0.1), test(10.0, 0.3), test(14.0, 0.45)], "A = \"50 kN/m\""));
    for fit in three.as_array().expect("two fits") {
        assert!((fit["A"].as_f64().expect("a number") / 50e3 - 1.0).abs() < 1e-9 && fit["degrees_of_freedom"] == 2, "{fit}");
        // No other d1 with this A is nearer: the residuals are balanced.
        let (d0, d1) = (fit["d0"].as_f64().expect("a number"), fit["d1"].as_f64().expect("a number"));
        let pulls = fit["residuals"].as_array().expect("residuals").iter().zip([0.1, 0.3, 0.45]);
        let pull: f64 = pulls.map(|(residual, depth)| residual["difference"].as_f64().expect("a number") * (depth - d0 / d1)).sum();
        assert!(pull.abs() < 1e-6, "{pull}: {fit}");
    }
    for (fit, wanted) in [
        ("A = \"50 kN/m\"\nb0 = \"2 m/s\"", "`A` and `b0` exclude each other"),
        ("A = \"50 kN/m\"\nonset = \"2 m/s\"", "`A` and `onset` exclude each other"),
        ("A = \"-50 kN/m\"", "fit.A"),
        ("A = \"50 kN\"", "fit.A"),
    ] {
        let refused = answer(&[test(13.0, 0.4)], fit);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{fit}");
        assert!(refused.err.contains(wanted), "{fit}: {}", refused.err);
    }
}

/// Tests of one car whose residuals are many standard deviations.
#[test]
fn tests_that_contradict_each_other_have_status_1() {
    let of = |second: f64| {
        let test = |speed: u8, depth: f64| {
            format!(
                "[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0.1\nwidth = 1.5\ndepths = [{depth}, {depth}]\nscatter = \"2 N^0.5\"\n"
            )
        };
        let text =
            format!("schema = 1\n[[vehicle]]\nname = \"A\"\nnew_cars = true\n{}{}{}", test(7, 0.16), test(11, second), test(15, 0.42));
        let folder = crate::process::Folder::new();
        folder.write("tests.toml", text.as_bytes());
        let run = crate::process::run(folder.path(), &["stiffness", "tests.toml"]);
        (run.status, run.out.contains("the tests contradict each other, fitted on"))
    };
    assert_eq!([of(0.40), of(0.29)], [(1, true), (0, false)]);
}

/// The error of a recording counts once: two tests that take their restitution from it would have it twice.
#[test]
fn two_tests_of_one_recording_are_refused() {
    let folder = Folder::new();
    let recording = "schema = 1\n[kinematics]\nbefore = { velocity = [10, 0] }\nafter = { velocity = [\"-3 m/s ± 1 m/s\", 0] }\nbarrier = 0\n\
                     duration = 0.1\npoint = [2, 0]\n";
    folder.write("one.toml", recording.as_bytes());
    folder.write("two.toml", recording.as_bytes());
    let run_of = |other: &str| {
        let test = |name: &str, depth: f64| {
            format!(
                "[[vehicle.test]]\nmass = 1500\nspeed = 10\nrestitution = {{ record = \"{name}\" }}\nwidth = 1.5\ndepths = [{depth}, {depth}]\n"
            )
        };
        let text = format!("schema = 1\n[[vehicle]]\nname = \"a\"\nnew_cars = true\n{}{}", test("one.toml", 0.3), test(other, 0.4));
        folder.write("tests.toml", text.as_bytes());
        run(folder.path(), &["stiffness", "tests.toml"])
    };
    // Another test may have measured the same.
    let sound = run_of("two.toml");
    assert!(sound.status <= 1 && sound.err.is_empty(), "{}", sound.err);
    for same in ["one.toml", "./one.toml"] {
        let refused = run_of(same);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{same}");
        let says = "vehicle.1.test.2.restitution.record: vehicle.1.test.1.restitution.record has the same recording";
        assert!(refused.err.contains(says) && refused.err.contains("a recording is of one test"), "{}", refused.err);
    }
}

/// No two cars are crushed to the same millimeters: a vehicle that is listed twice would count as two of a class.
#[test]
fn one_test_with_two_names_is_refused() {
    let text = example("malibu.toml");
    let (begin, end) = (text.find("[[vehicle]]").expect("a vehicle"), text.find("[fit]").expect("a fit"));
    let with_other = |other: &str| format!("{}{other}{}", &text[..end], &text[end..]);
    let vehicle = &text[begin..end];
    let refused = run_with_input(&["stiffness", "-"], &with_other(&vehicle.replace("Malibu", "Other")));
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    assert!(refused.err.contains("vehicle.2.test.1: it has the numbers of vehicle.1.test.1, which would count twice"), "{}", refused.err);
    assert!(refused.err.contains("leave one of them out: a test is of one vehicle, and counts once"), "{}", refused.err);
    // One that differs is another, and so are two that leave no crush.
    let differs = with_other(&vehicle.replace("0.265", "0.266"));
    assert_eq!(run_with_input(&["stiffness", "-"], &differs).status, 0);
    let uncrushed = "[[vehicle.test]]\nmass = 1779\nspeed = 2\nrestitution = 0.3\nwidth = 1.478\ndepths = [0, 0]\n";
    let both = text.replace("[fit]", &format!("{uncrushed}{uncrushed}[fit]"));
    assert!(!run_with_input(&["stiffness", "-"], &both).err.contains("count twice"));
}

/// The test left crush at its speed, so this speed is none that leaves none.
#[test]
fn an_onset_is_below_the_speed_of_the_test() {
    let with = |onset: &str| run_with_input(&["stiffness", "-"], &example("malibu.toml").replace("\"2.2 m/s\"", onset));
    let refused = with("15.6");
    let says = "fit.onset: the onset speed is assumed to be 15.60 m/s, but the test left crush at 15.60 m/s";
    assert!(refused.status == 2 && refused.out.is_empty() && refused.err.contains(says), "{}", refused.err);
    assert_eq!(with("15.59").status, 0);
}

#[test]
fn a_prediction_without_a_fit_is_noted() {
    let text = example("malibu.toml").replace("[fit]\n", "[fit]\ndepth = 0.3\nwidth = 1.5\n");
    let notes = |text: &str| {
        let messages = json(text)["messages"].clone();
        let says = "`depth` and `width` have no effect: there is no fit to predict their crush energy; b0 in place of onset makes one of a single test";
        let is_noted = |message: &&Value| message["code"] == "prediction-not-used" && message["text"] == says;
        messages.as_array().into_iter().flatten().filter(is_noted).count()
    };
    // A speed that is held makes a fit of one test.
    assert_eq!([notes(&text), notes(&example("malibu.toml")), notes(&text.replace("onset", "b0"))], [1, 0, 0]);
}

/// Three tests have one degree of freedom: the 95 % quantile of Student's distribution is 12.706 (Abramowitz and Stegun, table 26.10), that of the normal one 1.960.
#[test]
fn few_residuals_have_the_intervals_of_student() {
    let folder = Folder::new();
    let test = |speed: f64, depth: f64, scatter: &str| {
        format!("[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0\nwidth = 1.5\ndepths = [{depth}, {depth}]\n{scatter}")
    };
    let tests = |scatter: &str| {
        let all = [(6.0, 0.10), (11.0, 0.31), (15.0, 0.45)].map(|(speed, depth)| test(speed, depth, scatter)).concat();
        format!("schema = 1\n[[vehicle]]\nname = \"a\"\nnew_cars = true\n{all}")
    };
    let example = std::fs::read_to_string(workspace().join("cli/examples/reconstruct/from-tests.toml")).expect("the example");
    for (scatter, factor) in [("", 12.706 / 1.960), ("scatter = 10\n", 1.0)] {
        folder.write("tests.toml", tests(scatter).as_bytes());
        let fits = json(&tests(scatter))["fits"].clone();
        let fit = fits.as_array().into_iter().flatten().find(|fit| fit["model"] == "profile").expect("a fit").clone();
        folder.write("case.toml", example.replace("../tests/struble-welsh.toml", "tests.toml").as_bytes());
        let run = run(folder.path(), &["reconstruct", "case.toml", "--format", "json"]);
        let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error} {}", run.err));
        let message = answer["messages"]
            .as_array()
            .into_iter()
            .flatten()
            .find(|message| message["code"] == "stiffness-from-tests")
            .expect("a note")
            .clone();
        let figures: Vec<f64> = message["figures"].as_array().into_iter().flatten().map(|figure| number(&figure["value"])).collect();
        for (printed, of_fit) in [(figures[1], "d0_sd"), (figures[3], "d1_sd")] {
            assert!((printed / number(&fit["covariance"][of_fit]) / factor - 1.0).abs() < 1e-3, "{scatter}: {printed} {fit}");
        }
        assert_eq!(message["text"].to_string().contains("6.5 times those of the fit"), factor > 1.0, "{message}");
        let at_99 = crate::process::run(folder.path(), &["reconstruct", "case.toml", "--format", "json", "--level", "0.99"]).out;
        assert_eq!(at_99.contains("\"level-beyond-tests\""), factor > 1.0, "{at_99}");
    }
}

/// Centimeters, tonnes and speeds that are taken in SI.
#[test]
fn sizes_of_no_test_are_named() {
    let codes = |old: &str, new: &str| {
        let text = class("").replace("b0 =", "onset =") + "depth = \"0.4 m\"\nwidth = \"1.5 m\"\n";
        assert!(text.contains(old), "{old}");
        let answer: Value =
            serde_json::from_str(&run_with_input(&["stiffness", "-", "--format", "json"], &text.replacen(old, new, 1)).out).expect("JSON");
        let codes = answer["messages"].as_array().expect("messages").iter().filter(|message| message["severity"] == "warning").cloned();
        codes.map(|one| one["code"].as_str().expect("a code").to_owned()).filter(|code| code.starts_with("unusual")).collect::<Vec<_>>()
    };
    assert_eq!(codes("", ""), [""; 0]);
    let free =
        class("").split("[fit]").next().expect("tests").replacen("speed = 15\n", "speed = 1\n", 1).replacen("[0.4, 0.4]", "[0, 0]", 1);
    assert!(run_with_input(&["stiffness", "-", "--format", "json"], &free).out.contains("\"no-crush\""));
    let stiff = |depth: &str| {
        let test = format!("mass = 1500\nspeed = 15\nrestitution = 0.1\nwidth = 1.5\ndepths = [{depth}, {depth}]\n");
        let text = format!("schema = 1\n[[vehicle]]\n[[vehicle.test]]\n{test}[fit]\nb0 = \"2 m/s\"\n");
        json(&text)["messages"].to_string().contains("\"unusual-stiffness\"")
    };
    // B = (13 m/s)² 1000 kg/m over the square of the depth is some 1 MPa, 0.1 GPa and 4 kPa.
    assert_eq!(["0.4", "0.04", "6.2"].map(stiff), [false, true, true]);
    // Of a test by itself too: tonnes for kilograms.
    let malibu =
        |mass: &str| json(&example("malibu.toml").replacen("1779 kg", mass, 1))["messages"].to_string().contains("\"unusual-stiffness\"");
    assert_eq!(["1779 kg", "1779 t"].map(malibu), [false, true]);
    assert_eq!(codes("depths = [0.4, 0.4]", "depths = [2.4, 2.1]")[..1], ["unusual-depth"]);
    assert_eq!(codes("mass = 1500", "mass = 15")[..1], ["unusual-mass"]);
    assert_eq!(codes("depth = \"0.4 m\"", "depth = 40"), ["unusual-depth"]);
    assert_eq!(codes("width = \"1.5 m\"", "width = \"1.5 mm\""), ["unusual-width"]);
}

/// Tests to nearly one depth have a line that begins at 12 m/s, and not at the 2 m/s that are assumed.
#[test]
fn a_line_that_each_vehicle_contradicts_is_told() {
    let test = |mass: u32, speed: f64, depth: f64| {
        format!(
            "[[vehicle]]\n[[vehicle.test]]\nmass = {mass}\nspeed = {speed}\nrestitution = 0\nwidth = 1.5\ndepths = [{depth}, {depth}]\n"
        )
    };
    let tests = |second: f64| {
        let all = test(1500, 15.0, 0.45) + &test(1600, second, 0.40) + &test(1400, 15.5, 0.50);
        format!("schema = 1\n{all}[fit]\nonset = \"2 m/s\"\n")
    };
    let told = |text: &str| json(text)["messages"].to_string().contains("line-off-class");
    assert!(told(&tests(14.0)) && !told(&tests(13.0)));
    let folder = Folder::new();
    folder.write("tests.toml", tests(14.0).as_bytes());
    let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n[vehicle.crush]\nwidth = 1.5\n\
                depths = [0.22, 0.22]\nstiffness = { tests = \"tests.toml\" }\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0\n";
    folder.write("case.toml", case.as_bytes());
    let used = run(folder.path(), &["crush", "case.toml"]).out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(used.contains("Warning: vehicle.1.crush.stiffness.tests") && used.contains("far from the mean of the vehicles"), "{used}");
}
