//! The verb `uncertainty`: every case of an independent computation, the same bytes for any number of threads, and the exit status.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Value, json};

use crate::process::{Folder, Run, planar_impact, run, run_with_input, workspace};

/// Relative tolerance of what derivatives say: that of difference quotients and of a quadrature.
const TOLERANCE: f64 = 1e-6;

/// Standard errors by which two estimates may differ.
const ERRORS: f64 = 4.0;

const EXAMPLE: &str = "cli/examples/uncertain.toml";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn object(value: &Value) -> &serde_json::Map<String, Value> {
    value.as_object().unwrap_or_else(|| panic!("{value} is no object"))
}

fn answered(run: &Run) -> Value {
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    serde_json::from_str(&run.out).expect("JSON")
}

fn of_example(arguments: &[&str]) -> Value {
    answered(&run(&workspace(), &[&["uncertainty", EXAMPLE, "--format", "json"], arguments].concat()))
}

/// The codes of the messages of an answer.
fn codes(answer: &Value) -> Vec<&str> {
    answer["messages"].as_array().into_iter().flatten().filter_map(|message| message["code"].as_str()).collect()
}

/// Compares numbers of an answer with those of a reference, and collects the differences.
#[derive(Default)]
struct Comparison {
    faults: Vec<String>,
    /// The squares of all differences of estimates, in their standard errors.
    squares: Vec<f64>,
}

impl Comparison {
    fn same(&mut self, found: &Value, wanted: &Value, what: &str) {
        let (found, wanted) = (found.as_f64().unwrap_or(f64::NAN), number(wanted));
        // A share near 0 is the difference of others.
        let is_same = (found - wanted).abs() <= TOLERANCE * wanted.abs().max(1e-3);
        if !is_same {
            self.faults.push(format!("{what}: {found}, not {wanted}"));
        }
    }

    /// Compares two estimates, each with its standard error.
    fn alike(&mut self, found: f64, error: f64, wanted: &Value, what: &str) {
        let (wanted, of_wanted) = (number(&wanted[0]), number(&wanted[1]));
        // What is certain has no error.
        let errors = if found == wanted { 0.0 } else { (found - wanted).abs() / error.hypot(of_wanted) };
        if errors.is_nan() || errors > ERRORS {
            self.faults.push(format!("{what}: {found} ± {error}, not {wanted} ± {of_wanted}: {errors:.1} standard errors"));
        }
        self.squares.push(errors * errors);
    }

    fn proportion(&mut self, count: &Value, samples: f64, wanted: &Value, what: &str) {
        let share = count.as_f64().unwrap_or(0.0) / samples;
        let variance = (share * (1.0 - share)).max(1.0 / samples) / samples;
        self.alike(share, variance.sqrt(), wanted, what);
    }

    fn output(&mut self, found: &Value, wanted: &Value, what: &str) {
        for key in ["mean", "sd"] {
            self.same(&found["linear"][key], &wanted["linear"][key], &format!("{what}: linear {key}"));
        }
        for key in ["shares", "sd_if_halved"] {
            assert_eq!(object(&found["linear"][key]).len(), object(&wanted["linear"][key]).len(), "{what} {key}");
            for (input, wanted) in object(&wanted["linear"][key]) {
                self.same(&found["linear"][key][input], wanted, &format!("{what}: linear {key} {input}"));
            }
        }
        for (key, wanted) in object(&wanted["second_order"]) {
            self.same(&found["second_order"][key], wanted, &format!("{what}: second order {key}"));
        }
        let samples = &found["monte_carlo"];
        for key in ["mean", "sd"] {
            let wanted = &wanted["monte_carlo"][key];
            self.alike(number(&samples[key]), number(&samples[format!("{key}_se")]), wanted, &format!("{what}: {key} of samples"));
        }
        // The skewness has no standard error of its own; that of the reference is of twenty times as many samples.
        let skewness = &wanted["monte_carlo"]["skewness"];
        let error = 5.0 * number(&skewness[1]);
        self.alike(number(&samples["skewness"]), error, skewness, &format!("{what}: skewness of samples"));
        for (p, wanted) in object(&wanted["monte_carlo"]["quantiles"]) {
            let error = number(&samples["quantiles_se"][p]);
            self.alike(number(&samples["quantiles"][p]), error, wanted, &format!("{what}: quantile {p}"));
        }
        let shares = wanted.get("sobol").map(object);
        assert_eq!(found.get("sobol").map(|found| object(found).len()), shares.map(serde_json::Map::len), "{what}: shares of Sobol'");
        for (input, wanted) in shares.into_iter().flatten() {
            for key in ["first", "total"] {
                let share = &found["sobol"][input];
                self.alike(number(&share[key]), number(&share[format!("{key}_se")]), &wanted[key], &format!("{what}: {key} {input}"));
            }
        }
        let effects = wanted.get("shapley").map(object);
        assert_eq!(found.get("shapley").map(|found| object(found).len()), effects.map(serde_json::Map::len), "{what}: Shapley effects");
        for (input, wanted) in effects.into_iter().flatten() {
            let effect = &found["shapley"][input];
            self.alike(number(&effect["effect"]), number(&effect["se"]), wanted, &format!("{what}: Shapley effect of {input}"));
        }
    }
}

#[test]
fn every_case_of_the_independent_computation() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/uncertainty.jsonl");
    let text = std::fs::read_to_string(path).expect("the cases can be read");
    let mut all = Comparison::default();
    let mut refused = BTreeSet::new();
    for line in text.lines() {
        let reference: Value = serde_json::from_str(line).expect("each line is JSON");
        let title = reference["case"]["title"].as_str().expect("a title").to_owned();
        let names: Vec<&str> = object(&reference["of"]).keys().map(String::as_str).collect();
        let names = names.join(",");
        let has_effects = object(&reference["of"]).values().any(|output| output.get("shapley").is_some());
        let methods = ["linear,second-order,monte-carlo,sobol", "linear,second-order,monte-carlo,sobol,shapley"][usize::from(has_effects)];
        let mut call = vec!["uncertainty", "-", "--format", "json", "--of", &names, "--method", methods];
        object(&reference["probabilities"]).keys().for_each(|statement| call.extend(["--probability", statement]));
        let found = answered(&run_with_input(&call, &reference["case"].to_string()));
        assert_eq!((&found["samples"], &found["title"]), (&json!(100_000), &reference["case"]["title"]));
        let samples = number(&found["samples"]);
        let reasons = object(&reference["refused"]["reasons"]);
        // A reason that a reference of two million samples has a few times may be missing.
        let common = reasons.iter().filter(|(_, share)| number(&share[0]) > 1e-4).map(|(code, _)| code);
        refused.extend(common.cloned());
        let known = |code: &String| reasons.contains_key(code);
        assert!(object(&found["refused"]["reasons"]).keys().all(known), "{title}: {}", found["refused"]);
        for (code, share) in reasons {
            all.proportion(&found["refused"]["reasons"][code], samples, share, &format!("{title}: refused {code}"));
        }
        all.proportion(&found["refused"]["count"], samples, &reference["refused"]["share"], &format!("{title}: refused"));
        for (statement, wanted) in object(&reference["probabilities"]) {
            let probability = &found["probabilities"][statement];
            all.alike(number(&probability["value"]), number(&probability["se"]), wanted, &format!("{title}: {statement}"));
        }
        assert_eq!(object(&found["of"]).len(), object(&reference["of"]).len());
        for (output, wanted) in object(&reference["of"]) {
            // Where an output stands alone, its plain name is enough.
            let plain = output.strip_prefix("result.").unwrap_or(output);
            all.output(&found["of"][plain], wanted, &format!("{title}: {output}"));
        }
    }
    assert!(all.faults.is_empty(), "{} faults\n{}", all.faults.len(), all.faults.join("\n"));
    // Standard errors that are too wide would hide a fault: the differences of estimates are about one of them.
    let mean = all.squares.iter().sum::<f64>() / all.squares.len() as f64;
    assert!((0.5..1.5).contains(&mean), "{mean} of {} differences", all.squares.len());
    assert_eq!(text.lines().count(), 8, "the file is cut off");
    assert_eq!(refused, BTreeSet::from(["out-of-range".to_owned(), "separating".to_owned()]));
}

#[test]
fn any_number_of_threads_prints_the_same() {
    // What neither draws samples nor is the work of several threads, such as bounds, is computed once, and of one output.
    let drawn = ["--of", "dV1,T_L", "--method", "linear,monte-carlo"];
    for arguments in [
        &["--of", "dV1", "--format", "json"][..],
        &[&drawn[..], &["--format", "json", "--points", "sobol"]].concat(),
        &[&drawn[..], &["--precision", "0.5%"]].concat(),
        &[&drawn[..], &["--format", "csv"]].concat(),
    ] {
        let printed = ["1", "2", "3"].map(|threads| {
            let call = ["uncertainty", EXAMPLE, "--samples", "20011"];
            let output = planar_impact(&workspace()).args(call).args(arguments).env("RAYON_NUM_THREADS", threads).output();
            Run::of(output.expect("the program starts")).out
        });
        assert!(printed[0] == printed[1] && printed[0] == printed[2] && printed[0].len() > 1000, "{arguments:?}");
    }
}

#[test]
fn a_seed_is_of_the_samples() {
    let call = |seed| of_example(&["--of", "dV1", "--samples", "5000", "--seed", seed]);
    let [one, other, again] = ["1", "2", "1"].map(call);
    let mean = |answer: &Value| number(&answer["of"]["vehicle.1.delta_v_magnitude"]["monte_carlo"]["mean"]);
    let error = number(&one["of"]["vehicle.1.delta_v_magnitude"]["monte_carlo"]["mean_se"]);
    assert_eq!((&one, &other["seed"]), (&again, &json!(2)));
    assert!(mean(&one) != mean(&other) && (mean(&one) - mean(&other)).abs() < 6.0 * error);
    assert_eq!(one["of"]["vehicle.1.delta_v_magnitude"]["linear"], other["of"]["vehicle.1.delta_v_magnitude"]["linear"]);
}

#[test]
fn a_standard_error_is_the_deviation_of_many_seeds() {
    let found: Vec<Value> = (0..40)
        .map(|seed: u32| {
            let call = ["--of", "dV1", "--samples", "1000", "--method", "monte-carlo", "--probability", "dV1 > 18 mph"];
            of_example(&[&call[..], &["--seed", &seed.to_string()]].concat())
        })
        .collect();
    let samples = |answer: &Value| answer["of"]["vehicle.1.delta_v_magnitude"]["monte_carlo"].clone();
    let of = |value: &dyn Fn(&Value) -> f64| found.iter().map(value).collect::<Vec<f64>>();
    for (what, values, errors) in [
        ("mean", of(&|answer| number(&samples(answer)["mean"])), of(&|answer| number(&samples(answer)["mean_se"]))),
        ("sd", of(&|answer| number(&samples(answer)["sd"])), of(&|answer| number(&samples(answer)["sd_se"]))),
        ("median", of(&|answer| number(&samples(answer)["quantiles"]["0.5"])), of(&|a| number(&samples(a)["quantiles_se"]["0.5"]))),
        (
            "probability",
            of(&|answer| number(&answer["probabilities"]["dV1 > 18 mph"]["value"])),
            of(&|answer| number(&answer["probabilities"]["dV1 > 18 mph"]["se"])),
        ),
    ] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let sd = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        let claimed = errors.iter().sum::<f64>() / n;
        // Forty seeds have their deviation to a ninth: three of those.
        assert!((0.66..1.5).contains(&(sd / claimed)), "{what}: {sd} of seeds, {claimed} claimed");
    }
}

#[test]
fn a_precision_sets_the_number_of_samples() {
    let call =
        |precision: &str, most: &str| of_example(&["--of", "dV1", "--precision", precision, "--samples", most, "--method", "monte-carlo"]);
    let fine = call("0.02%", "2000000");
    let found = &fine["of"]["vehicle.1.delta_v_magnitude"]["monte_carlo"];
    assert!(number(&found["mean_se"]) <= 0.0002 * number(&found["mean"]), "{found}");
    assert!((number(&fine["samples"]) - 116_000.0).abs() < 30_000.0, "(0.53/7.77/0.0002)²: {}", fine["samples"]);
    assert_eq!(codes(&fine), [""; 0]);
    let coarse = call("0.01%", "50000");
    assert_eq!((&coarse["samples"], codes(&coarse)), (&json!(50_000), vec!["precision-not-reached"]));
    let said = coarse["messages"][0]["text"].as_str().expect("a text");
    assert!(said.starts_with("50000 samples do not reach the precision of 0.01 %"), "{said}");
}

#[test]
fn the_ends_of_a_range_have_samples_beyond_them() {
    let call = |samples: &str, level: &str| {
        let answer = of_example(&["--of", "dV1", "--samples", samples, "--level", level, "--method", "monte-carlo"]);
        answer["messages"]
            .as_array()
            .map_or_else(Vec::new, |messages| messages.iter().map(|message| message["text"].to_string()).collect::<Vec<_>>())
    };
    // Ten beyond each end of the middle 95 %: a fortieth of 400.
    assert_eq!(call("400", "0.95"), [""; 0]);
    let few = call("399", "0.95");
    assert!(few.len() == 1 && few[0].contains("399 solved samples have 9.975 beyond either end of the 95 % range"), "{few:?}");
    assert!(few[0].contains("give --samples 400 or more"), "{few:?}");
    assert_eq!((call("400", "0.96").len(), call("500", "0.96").len()), (1, 0));
}

#[test]
fn finite_differences_are_near_the_linear_deviation() {
    let file = "cli/examples/uncertainty/differences.toml";
    let linear = answered(&run(&workspace(), &["uncertainty", file, "--of", "dV1", "--method", "linear", "--format", "json"]));
    let found = &linear["of"]["vehicle.1.delta_v_magnitude"]["linear"];
    let mut variance = 0.0;
    for (name, input) in object(&linear["inputs"]) {
        let [value, sd] = ["value", "sd"].map(|key| number(&input[key]));
        let vary = format!("{name}={}:{}:{}", value - sd, value + sd, 2.0 * sd);
        let swept = answered(&run(&workspace(), &["sweep", file, "--vary", &vary, "--of", "dV1", "--format", "json"]));
        let values = swept["of"]["vehicle.1.delta_v_magnitude"].as_array().expect("values");
        assert_eq!(values.len(), 2, "{vary}");
        let part = 0.5 * (number(&values[1]) - number(&values[0]));
        variance += part * part;
        assert!((part * part / number(&found["sd"]).powi(2) - number(&found["shares"][name])).abs() < 0.03, "{name}: {part}");
    }
    assert!((variance.sqrt() / number(&found["sd"]) - 1.0).abs() < 0.02, "{} {}", variance.sqrt(), found["sd"]);
}

#[test]
fn the_guide_shows_what_is_printed() {
    let guide = std::fs::read_to_string(workspace().join("cli/README.md")).expect("the guide");
    let section = guide.split("### From the literature").nth(1).and_then(|rest| rest.split("\n## ").next()).expect("the section");
    let mut blocks = 0;
    for block in section.split("```sh\n").skip(1) {
        let (line, rest) = block.split_once("\n```").expect("a command");
        let shown = rest.split("```text\n").nth(1).and_then(|rest| rest.split("\n```").next()).expect("what it prints");
        // Quoted is the statement alone, the last word.
        let (plain, quoted) = line.split_once(" \"").map_or((line, None), |(plain, quoted)| (plain, Some(quoted.trim_end_matches('"'))));
        let words: Vec<&str> = plain.split(' ').skip(1).chain(quoted).collect();
        let run = run(&workspace(), &words);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{line}");
        let mut printed = run.out.lines();
        for line in shown.lines().filter(|line| !line.is_empty()) {
            assert!(printed.any(|found| found == line), "not printed, or not in this order: {line}\n{}", run.out);
        }
        blocks += 1;
    }
    assert_eq!(blocks, 5);
}

#[test]
fn correlations_change_what_they_should() {
    let sd = |name: &str| {
        let file = format!("cli/examples/uncertainty/{name}.toml");
        let call = ["uncertainty", &file, "--of", "vehicle.1.crush_energy,dV1,T_L", "--format", "json", "--method", "linear"];
        let answer = answered(&run(&workspace(), &call));
        ["vehicle.1.crush_energy", "vehicle.1.delta_v_magnitude", "energy.loss"].map(|of| number(&answer["of"][of]["linear"]["sd"]))
    };
    let (independent, correlated) = (sd("independent"), sd("correlated"));
    // E = w (A²/(2 B) + A C + B C²/2), each over the width: its derivatives by hand at depths near 0.37 m have the same sign, which a negative
    // correlation offsets. ΔV depends on m2/(m1 + m2), and the loss on m1 m2/(m1 + m2).
    assert!(independent[0] > 2.0 * correlated[0] && independent[1] > 2.0 * correlated[1] && independent[2] < 0.8 * correlated[2]);
    let read = |name: &str| {
        let text = std::fs::read_to_string(workspace().join(format!("cli/examples/uncertainty/{name}.toml"))).expect("the example");
        let mut case: toml::Table = toml::from_str(&text).expect("TOML");
        (case.remove("title"), case.remove("correlation").is_some(), case)
    };
    let (one, other) = (read("independent"), read("correlated"));
    assert_eq!((one.1, other.1, &one.2), (false, true, &other.2), "all else is the same");
}

/// A fit that holds A leaves d0 = A/d1, so that the two are one uncertain number: E_C = w (A C + d1² C²/2 + A²/(2 d1²)).
#[test]
fn a_stiffness_with_its_force_held_has_one_uncertain_number() {
    let (force, width, depth) = (40_000.0, 1.5, 0.2);
    let folder = Folder::new();
    let test = |speed: f64, depth: f64| {
        format!(
            "[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nspeed_sd = 0.1\nscatter = 60\nrestitution = 0.1\nwidth = {width}\ndepths = [{depth}, {depth}]\n"
        )
    };
    let tests = [test(6.0, 0.1), test(10.0, 0.25), test(14.0, 0.4)].concat();
    folder.write("tests.toml", format!("schema = 1\n[[vehicle]]\n{tests}[fit]\nA = {force}\n").as_bytes());
    let case = wall("1500", "10", "0.1").replacen(
        "[[vehicle]]",
        &format!(
            "[[vehicle]]\ncrush = {{ width = {width}, depths = [{depth}, {depth}], stiffness = {{ tests = \"tests.toml\" }}, pdof = 0 }}"
        ),
        1,
    );
    folder.write("case.toml", case.as_bytes());
    let json = |arguments: &[&str]| -> Value {
        let run = run(folder.path(), arguments);
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        serde_json::from_str(&run.out).expect("JSON")
    };
    let fitted = json(&["stiffness", "tests.toml", "--format", "json"]);
    let fit = fitted["fits"].as_array().into_iter().flatten().find(|fit| fit["model"] == "profile").expect("a fit");
    let (d1, sd) = (number(&fit["d1"]), number(&fit["covariance"]["d1_sd"]));
    let energy = |d1: f64| width * (force * depth + 0.5 * (d1 * depth).powi(2) + 0.5 * (force / d1).powi(2));
    let slope = width * (d1 * depth * depth - force * force / d1.powi(3));
    let found = &json(&["uncertainty", "case.toml", "--of", "vehicle.1.crush_energy", "--method", "linear", "--format", "json"])["of"]["vehicle.1.crush_energy"];
    let close = |found: &Value, wanted: f64| assert!((number(found) - wanted).abs() < 1e-9 * wanted, "{found}, not {wanted}");
    close(&found["value"], energy(d1));
    close(&found["linear"]["sd"], slope.abs() * sd);
    // A d0 that is held is no uncertain input, not even one without a deviation.
    folder.write("tests.toml", format!("schema = 1\n[[vehicle]]\n{tests}[fit]\nb0 = 2\n").as_bytes());
    let held = json(&["uncertainty", "case.toml", "--of", "vehicle.1.crush_energy", "--method", "linear", "--format", "json"]);
    let inputs: Vec<&String> = held["inputs"].as_object().expect("inputs").keys().collect();
    assert_eq!(inputs, ["vehicle.1.crush.d1"]);
}

/// A car into a wall, with one uncertain input each.
fn wall(mass: &str, speed: &str, restitution: &str) -> String {
    format!(
        "schema = 1\n[[vehicle]]\nmass = {mass}\nyaw_inertia = \"2000 kg m^2\"\nheading = \"0 deg\"\nspeed = {speed}\n\
         impact_center = [\"2 m\", \"0.5 m\"]\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = \"0 deg\"\nrestitution = {restitution}\n"
    )
}

#[test]
fn what_is_left_out_or_refused_is_noted() {
    let printed = |case: &str, arguments: &[&str]| {
        let json = answered(&run_with_input(&[&["uncertainty", "-", "--format", "json", "--of", "dV1"], arguments].concat(), case));
        let text = run_with_input(&[&["uncertainty", "-", "--of", "dV1"], arguments].concat(), case).out;
        let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for message in json["messages"].as_array().into_iter().flatten() {
            let said = message["text"].as_str().expect("words");
            assert!(flat.contains(said), "the text does not say: {said}\n{text}");
        }
        json
    };
    let (mass, speed, e) = ("\"1200 kg\"", "\"10 m/s\"", "0.1");
    // Sound.
    let plain = printed(&wall("\"1200 kg ± 50 kg\"", "\"10 m/s ± 1 m/s\"", e), &[]);
    assert_eq!(codes(&plain), [""; 0]);
    assert!(plain["of"]["vehicle.1.delta_v_magnitude"]["sobol"].is_object());
    // One input has the whole variance, which needs no samples.
    let one = printed(&wall(mass, "\"10 m/s ± 1 m/s\"", e), &[]);
    assert!(one["of"]["vehicle.1.delta_v_magnitude"].get("sobol").is_none());
    assert!(
        printed(&wall(mass, "\"10 m/s ± 1 m/s\"", e), &["--method", "sobol"])["of"]["vehicle.1.delta_v_magnitude"]["sobol"].is_object()
    );
    // Correlated inputs, and more than a hundredth refused.
    let correlated =
        wall("\"1200 kg ± 50 kg\"", "\"10 m/s ± 1 m/s\"", e).replace("schema = 1", "schema = 1\ncorrelation = [[\"m1\", \"v1\", 0.5]]");
    let divided = printed(&correlated, &[]);
    assert_eq!(codes(&divided), ["sobol-left-out"]);
    assert!(divided["messages"][0]["text"].as_str().is_some_and(|text| text.contains("Shapley effects divide what they share")));
    // ΔV does not depend on the mass alone, but the mass is correlated with the speed: (1 − ρ²/2) and ρ²/2 of the variance.
    let effects = &divided["of"]["vehicle.1.delta_v_magnitude"]["shapley"];
    for (input, wanted) in [("vehicle.1.speed", 0.875), ("vehicle.1.mass", 0.125)] {
        let [effect, error] = ["effect", "se"].map(|key| number(&effects[input][key]));
        assert!((effect - wanted).abs() < 4.0 * error && error < 0.01, "{input}: {effect} ± {error}");
    }
    assert!(plain["of"]["vehicle.1.delta_v_magnitude"].get("shapley").is_none(), "shares of Sobol' are enough");
    let refused = wall("\"1200 kg ± 50 kg\"", speed, "\"0.1 ± 0.05\"");
    assert_eq!(codes(&printed(&refused, &[])), ["sobol-left-out"]);
    assert_eq!(codes(&printed(&refused, &["--method", "shapley"])), ["shapley-left-out"]);
    assert!(printed(&refused, &[])["refused"]["reasons"]["out-of-range"].as_u64() > Some(1000));
    // Three measurements have no finite deviation, two not even a mean.
    let measured = |n: u32| wall(mass, &format!("{{ mean = \"10 m/s\", sd = \"1 m/s\", n = {n} }}"), e);
    let of_three = printed(&measured(3), &[]);
    assert_eq!(codes(&of_three), ["infinite-deviation"]);
    assert_eq!(codes(&printed(&measured(3), &["--method", "linear,shapley"])), ["infinite-deviation", "shapley-left-out"]);
    let found = &of_three["of"]["vehicle.1.delta_v_magnitude"];
    assert_eq!((&found["linear"]["sd"], &of_three["inputs"]["vehicle.1.speed"]["sd"]), (&Value::Null, &Value::Null));
    assert_eq!(found["linear"]["sd_if_halved"]["vehicle.1.speed"], Value::Null, "half of it is infinite too");
    assert!(found["monte_carlo"]["quantiles"]["0.975"].is_f64(), "{found}");
    // Of five or fewer the square of a speed has no finite variance.
    for (n, wanted) in [(4, vec!["infinite-deviation"]), (5, vec!["infinite-deviation"]), (6, vec![])] {
        assert_eq!(codes(&printed(&measured(n), &["--of", "T_L"])), wanted, "{n}");
    }
    assert_eq!(codes(&printed(&measured(4), &[])), [""; 0]);
    let of_two = printed(&measured(2), &[]);
    assert_eq!((codes(&of_two), &of_two["inputs"]["vehicle.1.speed"]["mean"]), (vec!["infinite-deviation"], &Value::Null));
    assert!(of_two["of"]["vehicle.1.delta_v_magnitude"].get("linear").is_none());
    let with_mass = measured(3).replace(mass, "\"1200 kg ± 50 kg\"");
    assert_eq!(codes(&printed(&with_mass, &[])), ["infinite-deviation", "sobol-left-out"]);
    // The nominal value of a triangular input is refused, its mean is not; and the other way round.
    let moving =
        |min: &str, mode: &str, max: &str| wall(mass, &format!("{{ min = \"{min} m/s\", mode = \"{mode} m/s\", max = \"{max} m/s\" }}"), e);
    let nominal = printed(&moving("-1", "-0.5", "9"), &[]);
    assert_eq!(codes(&nominal), ["nominal-refused"]);
    assert_eq!(nominal["of"]["vehicle.1.delta_v_magnitude"]["value"], Value::Null);
    let means = printed(&moving("-9", "0.5", "1"), &[]);
    assert_eq!(codes(&means), ["means-refused", "most-refused"]);
    assert!(means["of"]["vehicle.1.delta_v_magnitude"].get("linear").is_none());
    assert!(means["of"]["vehicle.1.delta_v_magnitude"]["monte_carlo"].is_object());
}

#[test]
fn methods_are_those_asked_for() {
    let keys = |arguments: &[&str]| -> Vec<String> {
        let case = wall("\"1200 kg ± 50 kg\"", "\"10 m/s ± 1 m/s\"", "0.1");
        let answer = answered(&run_with_input(&[&["uncertainty", "-", "--format", "json", "--of", "dV1"], arguments].concat(), &case));
        let has_samples = answer["samples"].as_u64() > Some(0);
        object(&answer["of"]["vehicle.1.delta_v_magnitude"]).keys().cloned().chain(has_samples.then(|| "samples".to_owned())).collect()
    };
    for (method, key, is_sampled) in [
        ("linear", "linear", false),
        ("second-order", "second_order", false),
        ("monte-carlo", "monte_carlo", true),
        ("sobol", "sobol", true),
        ("shapley", "shapley", true),
    ] {
        let mut wanted: BTreeSet<&str> = BTreeSet::from(["value", key]);
        wanted.extend(is_sampled.then_some("samples"));
        let count: &[&str] = if is_sampled { &["--samples", "1000"] } else { &[] };
        let found = keys(&[&["--method", method], count].concat());
        assert_eq!(found.iter().map(String::as_str).collect::<BTreeSet<_>>(), wanted, "{method}");
    }
    let both = keys(&["--method", "linear,sobol", "--samples", "1000"]);
    assert!(both.contains(&"linear".to_owned()) && both.contains(&"sobol".to_owned()) && both.len() == 4, "{both:?}");
    // A fifth of the samples, each with two mixtures and one step for each of two inputs.
    let drawn = |method: &str| {
        let case = wall("\"1200 kg ± 50 kg\"", "\"10 m/s ± 1 m/s\"", "0.1");
        let call = ["uncertainty", "-", "--of", "dV1", "--samples", "1000", "--method", method];
        let answer = answered(&run_with_input(&[&call[..], &["--format", "json"]].concat(), &case));
        let text = run_with_input(&call, &case).out;
        assert!(text.contains(&format!("{} samples (seed 1)", answer["samples"])), "{text}");
        answer["samples"].as_u64()
    };
    assert_eq!(["sobol", "shapley", "sobol,shapley", "monte-carlo,sobol"].map(drawn), [800, 600, 1400, 1000].map(Some));
    // A probability needs samples.
    assert!(keys(&["--method", "linear", "--probability", "dV1 > 10 m/s"]).contains(&"samples".to_owned()));
}

#[test]
fn wrong_calls_are_refused() {
    let folder = Folder::new();
    folder.write("uncertain.toml", &std::fs::read(workspace().join(EXAMPLE)).expect("the example"));
    folder.write("certain.toml", wall("\"1200 kg\"", "\"10 m/s\"", "0.1").as_bytes());
    folder.write("backward.toml", wall("\"1200 kg\"", "\"-10 m/s ± 1 m/s\"", "0.1").as_bytes());
    folder.write("beyond.toml", wall("\"1200 kg\"", "\"10 m/s\"", "0.1\nimpulse_ratio = \"0.5 ± 0.01\"").as_bytes());
    folder.write("outside.toml", wall("\"1200 kg\"", "\"10 m/s\"", "\"-0.5 ± 0.05\"").as_bytes());
    let depths = vec!["\"0.3 m ± 0.01 m\""; 1001].join(", ");
    let crushed =
        format!("impact_center = [2, 0.5]\n[vehicle.crush]\nwidth = 1.5\ndepths = [{depths}]\nstiffness = {{ A = 5000, B = 200000 }}\n");
    let many = wall("\"1200 kg\"", "\"10 m/s\"", "0.1").replacen("impact_center = [\"2 m\", \"0.5 m\"]\n", &crushed, 1);
    folder.write("many.toml", many.as_bytes());
    let calls: [(&[&str], i32, &[&str]); 33] = [
        (&["many.toml"], 2, &["1001 inputs of the case are uncertain; at most 1000 can be", "without an uncertainty"]),
        (&["certain.toml"], 2, &["no input of the case is uncertain", "± 2 mph"]),
        (&["uncertain.toml", "--of", "dV3"], 2, &["dV3"]),
        (&["uncertain.toml", "--of", "e1"], 2, &["--of"]),
        (&["uncertain.toml", "--precision", "0"], 2, &["must be above 0 and below 1", "0.1%"]),
        (&["uncertain.toml", "--precision", "100%"], 2, &["must be above 0 and below 1"]),
        (&["uncertain.toml", "--precision", "nan"], 2, &["--precision"]),
        (&["uncertain.toml", "--level", "0"], 2, &["from 0.5 to 0.9999"]),
        (&["uncertain.toml", "--level", "1"], 2, &["from 0.5 to 0.9999"]),
        (&["uncertain.toml", "--bounds-sd", "0"], 2, &["--bounds-sd"]),
        (&["uncertain.toml", "--bounds-sd=-1"], 2, &["--bounds-sd"]),
        (&["uncertain.toml", "--bounds-sd", "nan"], 2, &["--bounds-sd"]),
        (
            &["uncertain.toml", "--method", "linear", "--samples", "1000"],
            2,
            &["--samples: it has no effect", "add monte-carlo, sobol or shapley"],
        ),
        (&["uncertain.toml", "--method", "sobol", "--points", "sobol"], 2, &["--points: it has no effect", "add monte-carlo to --method"]),
        (&["uncertain.toml", "--method", "linear", "--level", "0.9"], 2, &["--level: it has no effect", "add monte-carlo to --method"]),
        (&["uncertain.toml", "--samples", "1"], 2, &["--samples", "a whole number from 2 to 1e15"]),
        (&["uncertain.toml", "--samples", "2.5"], 2, &["--samples", "a whole number from 2 to 1e15"]),
        (&["uncertain.toml", "--samples", "1e16"], 2, &["--samples", "a whole number from 2 to 1e15"]),
        (&["uncertain.toml", "--samples", "-1"], 2, &["--samples", "a whole number from 2 to 1e15"]),
        (&["uncertain.toml", "--samples", "many"], 2, &["--samples", "`many` is not a number"]),
        (&["uncertain.toml", "--method", "guess"], 2, &["invalid value 'guess'"]),
        (&["uncertain.toml", "--points", "grid"], 2, &["invalid value 'grid'"]),
        (&["uncertain.toml", "--probability", "dV1"], 2, &["expected NAME > VALUE"]),
        (&["uncertain.toml", "--probability", "dV1 = 3 m/s"], 2, &["expected NAME > VALUE"]),
        (&["uncertain.toml", "--probability", "dV3 > 3 m/s"], 2, &["dV3"]),
        (&["uncertain.toml", "--probability", "all > 3 m/s"], 2, &["a statement is about one output"]),
        (&["uncertain.toml", "--probability", "dV1 > 3 kg"], 2, &["a mass"]),
        (&["uncertain.toml", "--probability", "dV1 > fast"], 2, &["fast"]),
        (&["uncertain.toml", "--probability", "dV1 > "], 2, &["--probability"]),
        (&["uncertain.toml", "--probability", "> 3 m/s"], 2, &["--probability"]),
        (&["backward.toml"], 3, &["physics refuses each of 100000 samples", "separating (100000)"]),
        (&["beyond.toml"], 3, &["physics refuses each of 100000 samples", "beyond-critical (100000)"]),
        (&["outside.toml"], 2, &["contact.restitution", "must be from 0 to 1"]),
    ];
    let mut faults = String::new();
    for (arguments, status, says) in calls {
        let run = run(folder.path(), &[&["uncertainty"], arguments].concat());
        let is_said =
            says.iter().all(|words| run.err.contains(words)) && ["panicked", "defect"].iter().all(|words| !run.err.contains(words));
        if run.status != status || !run.out.is_empty() || !is_said {
            faults += &format!("{arguments:?}: {}\n{}\n{}\n", run.status, run.out, run.err);
        }
    }
    assert!(faults.is_empty(), "{faults}");
    // Everything wrong at once.
    let run = run(folder.path(), &["uncertainty", "uncertain.toml", "--of", "dV3", "--bounds-sd", "0", "--probability", "dV4 > 1 m/s"]);
    assert!(["dV3", "dV4", "--bounds-sd"].iter().all(|words| run.err.contains(words)), "{}", run.err);
}

/// The number of refused samples and each assumed unit are printed.
#[test]
fn what_was_assumed_and_refused_is_told_beside_data() {
    let case = std::fs::read_to_string(crate::process::workspace().join("cli/examples/uncertain.toml")).expect("the example");
    let slow = case.replacen("speed = \"52 km/h ± 3 km/h\"", "speed = \"10 km/h ± 10 km/h\"", 1);
    for format in ["csv", "svg"] {
        let run = run_with_input(&["uncertainty", "-", "--samples", "2000", "--of", "dV1", "--format", format], &slow);
        assert!(run.status == 0 && run.err.contains("note: 2000 samples (seed 1); physics refuses "), "{format}: {}", run.err);
    }
    let bare = ["uncertainty", "-", "--samples", "2000", "--of", "dV1", "--probability", "dV1 > 5"];
    let run = run_with_input(&bare, &case);
    assert!(run.out.contains("dV1 > 5 has no unit: 5 m/s assumed"), "{}", run.out);
    let run = run_with_input(&[&bare[..], &["--format", "svg"]].concat(), &case);
    assert!(run.status == 2 && run.err.contains("--probability has no effect"), "{}", run.err);
}

/// Formats without a place for notes have them on standard error, and the data alone on standard output.
#[test]
fn a_note_that_the_format_has_no_place_for_is_on_standard_error() {
    let case = "schema = 1\n[[vehicle]]\nmass = \"1400 kg ± 20 kg\"\nyaw_inertia = \"2400 kg m^2\"\nheading = \"0 deg\"\nspeed = \"15 m/s\"\n\
                impact_center = [\"1.9 m\", \"0.2 m\"]\n[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\n";
    let nominal = "note: vehicle.1.mass is uncertain, and used at its nominal value\n";
    for call in [
        &["sweep", "-", "--vary", "e=0:0.2:0.1", "--format", "csv"][..],
        &["sweep", "-", "--vary", "e=0:0.2:0.1", "--format", "svg"],
        &["formula", "W_n", "--case", "-", "--format", "latex"],
    ] {
        let run = run_with_input(call, case);
        assert!(run.status == 0 && run.err == nominal && !run.out.contains("nominal"), "{call:?}: {} {}", run.err, run.out);
    }
    for call in [&["sweep", "-", "--vary", "e=0:0.2:0.1"][..], &["formula", "W_n", "--case", "-"]] {
        let run = run_with_input(call, case);
        assert!(run.err.is_empty() && run.out.contains(nominal["note: ".len()..].trim_end()), "{call:?}: {} {}", run.err, run.out);
    }
}

/// An output of the motion has the name of an input, which `reconstruct` takes for the motion before the impact.
#[test]
fn a_probability_of_a_motion_says_that_it_is_after_the_impact() {
    for (statement, is_told) in [
        ("vehicle.1.velocity.x > 12 m/s", true),
        ("vehicle.2.yaw_rate > 1 rad/s", true),
        ("result.vehicle.1.velocity.x > 12 m/s", false),
        ("dV1 > 1 m/s", false),
    ] {
        let call = [
            "uncertainty",
            "cli/examples/uncertain.toml",
            "--samples",
            "1000",
            "--of",
            "dV1",
            "--format",
            "json",
            "--probability",
            statement,
        ];
        let answer = answered(&crate::process::run(&workspace(), &call));
        let all = answer["messages"].as_array().map_or(&[][..], Vec::as_slice);
        let told: Vec<&Value> = all.iter().filter(|message| message["code"] == "after-impact").collect();
        assert_eq!(told.len(), usize::from(is_told), "{statement}: {}", answer["messages"]);
        assert!(told.iter().all(|message| message["path"] == statement));
    }
}

/// A car that is struck straight from behind: half of the directions are to either side of 180°, as they are printed, on whichever side the nominal one is.
#[test]
fn a_probability_of_a_direction_is_that_of_the_printed_angle() {
    let vehicle = |heading: &str, speed: &str, center: f64| {
        format!(
            "[[vehicle]]\nmass = 1400\nyaw_inertia = 2300\nheading = \"{heading}\"\nspeed = \"{speed}\"\nimpact_center = [{center}, 0]\n"
        )
    };
    let of_direction = |heading: &str, statements: &[&str]| {
        let case = format!(
            "schema = 1\n{}{}[contact]\ncrush_plane = 0\nrestitution = 0.1\n",
            vehicle("0 deg", "15 m/s", 2.0),
            vehicle(heading, "5 m/s", -2.0)
        );
        let folder = crate::process::Folder::new();
        folder.write("case.toml", case.as_bytes());
        let mut call = vec!["uncertainty", "case.toml", "--of", "vehicle.2.pdof", "--format", "json"];
        statements.iter().for_each(|statement| call.extend(["--probability", statement]));
        answered(&crate::process::run(folder.path(), &call))
    };
    let is_told = |answer: &Value| answer["messages"].to_string().contains("\"half-turn\"");
    // Beyond half a turn the value is on the side of the quantiles, and a direction away from it has one side alone.
    assert!(!is_told(&of_direction("0.1 deg ± 5 deg", &["vehicle.2.pdof > 185 deg", "vehicle.2.delta_v.x > 1 m/s"])));
    assert!(!is_told(&of_direction("30 deg ± 5 deg", &["vehicle.2.pdof > 175 deg"])));
    for heading in ["0.1 deg ± 5 deg", "-0.1 deg ± 5 deg"] {
        let statements = ["vehicle.2.pdof > 175 deg", "vehicle.2.pdof < 0 deg", "vehicle.2.pdof < -175 deg"];
        let answer = of_direction(heading, &statements);
        let of = |statement: &str| number(&answer["probabilities"][statement]["value"]);
        assert!((of(statements[1]) - 0.5).abs() < 0.02, "{heading}: {answer}");
        assert_eq!(answer["messages"].to_string().matches("\"half-turn\"").count(), 3, "{heading}: {}", answer["messages"]);
        // Between 175° and 180° on either side lie 0.40 of a normal distribution of 3.9°.
        assert!((of(statements[0]) - 0.4).abs() < 0.02 && (of(statements[2]) - 0.4).abs() < 0.02, "{heading}: {answer}");
    }
}

/// Where physics refuses the nominal inputs the headline has no value of an output, and the range of the samples that it accepts.
#[test]
fn a_refused_nominal_has_no_value_in_the_headline() {
    let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 0\nspeed = 10\nimpact_center = [1.9, 0.2]\n[[vehicle]]\nmass = 1200\n\
                yaw_inertia = 1900\nheading = \"90 deg\"\nspeed = 10\nimpact_center = [0, 0.9]\n[contact]\ncrush_plane = \"10 deg\"\nrestitution = 0.1\n\
                impulse_ratio = \"0.01 ± 0.1\"\n";
    let run = run_with_input(&["uncertainty", "-", "--samples", "2000", "--of", "dV1"], case);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("delta_v_magnitude: none at the nominal inputs, 95 % from") && !run.out.contains("NaN"), "{}", run.out);
}

/// A standard deviation of 3 leaves few restitutions from 0 to 1, and those are not normal.
#[test]
fn inputs_that_physics_mostly_refuses_have_a_warning() {
    let warned = |restitution: &str| {
        let run =
            run_with_input(&["uncertainty", "-", "--samples", "4000", "--of", "dV1", "--format", "json"], &wall("1500", "10", restitution));
        let answer = answered(&run);
        codes(&answer).contains(&"most-refused")
    };
    assert_eq!(["0.1 ± 0.05", "0.1 ± 0.5", "0.1 ± 0.9", "0.1 ± 3"].map(|of| warned(&format!("\"{of}\""))), [false, false, true, true]);
}

/// Where friction holds at the mean, and gives way in a part of the samples, derivatives are those of one side.
#[test]
fn a_friction_that_may_give_way_has_a_warning() {
    let case = |friction: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1450\nyaw_inertia = 2600\nheading = \"10 deg\"\nspeed = 14.5\nimpact_center = [1.85, -0.4]\n[[vehicle]]\n\
             mass = 1180\nyaw_inertia = 1900\nheading = \"120 deg\"\nspeed = 11.4\nimpact_center = [1.6, 0.5]\n[contact]\n\
             crush_plane = \"-8 deg\"\nrestitution = 0.08\nfriction = {friction}\n"
        )
    };
    let warned = |friction: &str, method: &str| {
        let run = run_with_input(&["uncertainty", "-", "--of", "T_L", "--method", method, "--format", "json"], &case(friction));
        codes(&answered(&run)).contains(&"friction-switch")
    };
    // The critical ratio is 0.2392.
    for method in ["linear", "second-order", "linear,monte-carlo"] {
        assert!(warned("\"0.245 ± 0.05\"", method) && warned("\"0.15 ± 0.05\"", method), "{method}");
    }
    assert!(!warned("\"0.245 ± 0.05\"", "monte-carlo"), "samples have both sides");
    assert_eq!(["\"0.4 ± 0.05\"", "\"0.1 ± 0.05\"", "\"0.245 ± 0.002\""].map(|friction| warned(friction, "linear")), [false; 3]);
    // A certain friction, and a critical ratio that is not.
    let certain = |friction: &str| case(friction).replacen("speed = 14.5", "speed = \"14.5 m/s ± 1 m/s\"", 1);
    let warned = |friction: &str| {
        run_with_input(&["uncertainty", "-", "--of", "T_L", "--method", "linear", "--format", "json"], &certain(friction))
            .out
            .contains("friction-switch")
    };
    assert_eq!(["0.24", "0.6"].map(warned), [true, false]);
}

/// A ratio of impulses of which the lower one may be near zero has no standard deviation.
#[test]
fn an_output_with_heavy_tails_has_a_warning() {
    let case = "schema = 1\n[[vehicle]]\nmass = 1450\nyaw_inertia = 2450\nheading = \"10 deg ± 4 deg\"\nspeed = { min = 3, mode = 12, max = 14 }\n\
                impact_center = [1.85, -0.4]\n[[vehicle]]\nmass = 1180\nyaw_inertia = 1900\nheading = \"3 deg\"\nspeed = { values = [2, 4, 5, 9] }\n\
                impact_center = [-1.6, { value = 0.5, sd = 0.3, min = 0.2, max = 0.6 }]\n[contact]\ncrush_plane = { min = \"-8 deg\", max = \"8 deg\" }\n\
                restitution = 0.08\n";
    let warned = |of: &str| {
        codes(&answered(&run_with_input(&["uncertainty", "-", "--of", of, "--method", "monte-carlo", "--format", "json"], case)))
            .contains(&"heavy-tails")
    };
    assert_eq!(["mu0", "dV1"].map(warned), [true, false]);
}

/// A mean of three measurements has no standard deviation, nor has what follows from it.
#[test]
fn an_infinite_deviation_is_none_in_the_headline() {
    let case = wall("1500", "10", "{ mean = 0.1, sd = 0.02, n = 3 }");
    let run = run_with_input(&["uncertainty", "-", "--of", "dV1", "--method", "linear"], &case);
    assert!(
        run.status == 0 && run.out.contains("km/h, no finite standard deviation.") && !run.out.contains("NaN"),
        "{}{}",
        run.out,
        run.err
    );
}

/// A skid in two pieces has the friction of its road once, if the case says so; if not, a note says that the frictions count as independent.
#[test]
fn frictions_of_one_road_may_be_correlated() {
    let sd = |skids: &str, top: &str| {
        let case = format!(
            "schema = 1\n{top}[[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n\
             [[vehicle]]\nmass = 1500\nyaw_inertia = 2400\nheading = 3.1\nspeed = 0\nimpact_center = [2, 0]\n\
             [contact]\ncrush_plane = 0\nrestitution = 0.1\n[before.vehicle.1]\nskid = [{skids}]\n"
        );
        let run = run_with_input(
            &["uncertainty", "-", "--of", "before.vehicle.1.braking_speed", "--method", "linear", "--format", "json"],
            &case,
        );
        let found: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
        let sd = found["of"]["before.vehicle.1.braking_speed"]["linear"]["sd"].as_f64().expect("a deviation");
        (sd, run.out.contains("the frictions of the skids count as independent"))
    };
    let piece = "{ length = \"8.5 m\", friction = \"0.7 ± 0.06\" }";
    let (whole, is_noted) = sd("{ length = \"17 m\", friction = \"0.7 ± 0.06\" }", "");
    assert!(!is_noted);
    let (apart, is_noted) = sd(&format!("{piece}, {piece}"), "");
    assert!(is_noted && (apart * 2.0_f64.sqrt() / whole - 1.0).abs() < 1e-9, "{apart} {whole}");
    let pair = "correlation = [[\"before.vehicle.1.skid.1.friction\", \"before.vehicle.1.skid.2.friction\", 0.99]]\n";
    let (together, is_noted) = sd(&format!("{piece}, {piece}"), pair);
    assert!(!is_noted && (together / whole / 0.995_f64.sqrt() - 1.0).abs() < 1e-9, "{together} {whole}");
}

/// The loss of a symmetric head-on collision has no slope by the crush plane: a deviation by slopes is none, and only curvature tells it, or samples.
#[test]
fn slopes_that_say_little_of_a_deviation_have_a_warning() {
    let head_on = |plane: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = \"1500 kg\"\nyaw_inertia = \"2500 kg m^2\"\nheading = \"0 deg\"\nspeed = \"15 m/s\"\nimpact_center = [\"2 m\", \"0 m\"]\n[[vehicle]]\n\
             mass = \"1500 kg\"\nyaw_inertia = \"2500 kg m^2\"\nheading = \"180 deg\"\nspeed = \"15 m/s\"\nimpact_center = [\"2 m\", \"0 m\"]\n[contact]\ncrush_plane = \"{plane}\"\nrestitution = 0.1\n"
        )
    };
    let found = |plane: &str, methods: &str| {
        let call = ["uncertainty", "-", "--of", "T_L", "--method", methods, "--format", "json"];
        let found: Value = serde_json::from_str(&run_with_input(&call, &head_on(plane)).out).expect("JSON");
        let messages = found["messages"].to_string();
        (found["of"]["energy.loss"].clone(), messages.contains("linear-bends"))
    };
    let (symmetric, is_warned) = found("0 deg ± 4 deg", "linear");
    assert!(is_warned && symmetric["linear"]["sd"].as_f64().is_some_and(|sd| sd < 1e-9), "{symmetric}");
    assert_eq!(symmetric["linear"]["sd_if_halved"]["contact.crush_plane"], Value::Null);
    let text = run_with_input(
        &["uncertainty", "-", "--of", "T_L", "--method", "linear,second-order,monte-carlo", "--samples", "20000"],
        &head_on("0 deg ± 4 deg"),
    )
    .out;
    let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(!flat.contains("To narrow it most") && flat.contains("is 0 J by slopes, and 40 J with curvature"), "{text}");
    let (oblique, is_warned) = found("20 deg ± 1 deg", "linear");
    assert!(!is_warned && oblique["linear"]["sd_if_halved"]["contact.crush_plane"].is_f64(), "{oblique}");
    assert!(!found("0 deg ± 4 deg", "second-order").1);
}

/// Two cars of which vehicle 1 has a crush of its own, and vehicle 2 an even one.
fn crushed(crush: &str) -> String {
    let vehicle = |heading: u32, speed: u32, crush: &str| {
        format!(
            "[[vehicle]]\nmass = \"1500 kg\"\nyaw_inertia = \"2500 kg m^2\"\nheading = \"{heading} deg\"\nspeed = \"{speed} m/s\"\nimpact_center = [\"2 m\", \"0.3 m\"]\n\
             [vehicle.crush]\nwidth = \"1.5 m\"\n{crush}\n"
        )
    };
    let even = "depths = [\"0.3 m\", \"0.3 m\"]\nstiffness = { A = \"50 kN/m\", B = \"500 kN/m^2\" }";
    let contact = "[contact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\n";
    format!("schema = 1\n{}{}{contact}", vehicle(0, 15, crush), vehicle(180, 10, even))
}

fn of_crushed(crush: &str, of: &str, method: &str) -> (Value, Vec<String>) {
    let call = ["uncertainty", "-", "--of", of, "--method", method, "--format", "json"];
    let run = run_with_input(&call, &crushed(crush));
    let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}{}", run.out, run.err));
    let codes = codes(&answer).into_iter().map(str::to_owned).collect();
    (answer["of"][of].clone(), codes)
}

/// The correction of CRASH3 has a limit at 45 degrees: slopes there are those of one side, and of its square, 1/cos², or nothing.
#[test]
fn slopes_at_a_corner_have_a_warning() {
    let of_direction = |pdof: &str| {
        let crush = format!(
            "depths = [\"0.3 m\", \"0.3 m\"]\nstiffness = {{ A = \"50 kN/m\", B = \"500 kN/m^2\" }}\nsurface = \"front\"\npdof = \"{pdof}\""
        );
        of_crushed(&crush, "vehicle.1.crash3.correction", "linear")
    };
    for (pdof, is_warned) in [("45 deg ± 5 deg", true), ("46 deg ± 5 deg", true), ("35 deg ± 3 deg", false), ("60 deg ± 5 deg", false)]
    {
        let (found, codes) = of_direction(pdof);
        assert_eq!(codes.iter().any(|code| code == "linear-at-corner"), is_warned, "{pdof}: {codes:?}");
        assert_eq!(found["linear"]["sd_if_halved"]["vehicle.1.crush.pdof"].is_null(), is_warned, "{pdof}: {found}");
    }
}

/// By hand: 0.3 m everywhere keep 1.5 (G + A C + ½ B C²) = 60 kJ, less 1.5 · ½ B (C − C_s)² from a saturation at 0.15 m.
#[test]
fn a_saturation_at_equal_depths_has_bounds() {
    let depths = "depths = [\"0.3 m\", \"0.3 m\"]\nstiffness = { A = \"50 kN/m\", B = \"500 kN/m^2\", saturation = \"0.3 m ± 0.05 m\" }";
    let (found, codes) = of_crushed(depths, "vehicle.1.crush_energy", "bounds");
    let end = |key: &str| found["bounds"][key].as_f64().unwrap_or_else(|| panic!("{key} of {found}"));
    assert!((end("low") - 51_562.5).abs() < 1e-3 && (end("high") - 60_000.0).abs() < 1e-3 && codes.is_empty(), "{found} {codes:?}");
}

/// The correction is at most 2, and the share of a mass that is effective at most 1, in intervals too.
#[test]
fn bounds_keep_to_what_a_factor_can_be() {
    let crush = "depths = [\"0.3 m\", \"0.3 m\"]\nstiffness = { A = \"50 kN/m\", B = \"500 kN/m^2\" }\nsurface = \"front\"\npdof = \"10 deg ± 20 deg\"";
    for (of, most) in [("vehicle.1.crash3.correction", 2.0), ("vehicle.1.crash3.effective_mass_factor", 1.0)] {
        let (found, _) = of_crushed(crush, of, "bounds");
        let high = found["bounds"]["high"].as_f64().unwrap_or_else(|| panic!("{found}"));
        assert!(high <= most && high > 0.999 * most, "{of}: {found}");
    }
}
