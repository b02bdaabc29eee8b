//! The page, the table and the chart of `uncertainty`: every number is that of the document, in its units.

use serde_json::Value;

use super::sweep::{attribute, axis};
use super::units::{printed, tables, unit};
use super::{array, case, close, document, number, object, references};
use crate::process::run_with_input;

/// The cases with their outputs and options: correlated inputs, crush, refused samples, angles, each input of one, and each of the examples.
fn cases() -> Vec<(Value, Vec<&'static str>)> {
    let mut all: Vec<(Value, Vec<&str>)> =
        vec![(case("uncertain.toml"), vec!["--of", "dV1,T_L,mu0,pdof1", "--probability", "dV1 > 18 mph"])];
    let outputs = ["dV1,W_n,Omega2", "dV1,T_L", "dV1,T_L", "vehicle.1.crush_energy,dV1,mu", "mu,W_t", "pdof1,dV1", "dV1,W_n", "dV2"];
    for (reference, of) in references("uncertainty.jsonl").into_iter().zip(outputs) {
        all.push((reference["case"].clone(), vec!["--of", of, "--level", "0.9"]));
    }
    for name in ["differences", "sampled", "independent", "correlated", "closing-speed"] {
        all.push((
            case(&format!("uncertainty/{name}.toml")),
            vec!["--of", "dV2", "--probability", "dV2 <= 4 m/s", "--probability", "T_L > 40 kJ"],
        ));
    }
    all
}

/// The methods but `bounds`, which takes longest and has pins of its own.
const METHODS: [&str; 2] = ["--method", "linear,second-order,monte-carlo,sobol"];

fn in_units(case: &Value, arguments: &[&str], format: &str, units: &str) -> String {
    // A chart has no probabilities.
    let of_probability = |at: usize| arguments[at] == "--probability" || at > 0 && arguments[at - 1] == "--probability";
    let arguments: Vec<&str> = (0..arguments.len()).filter(|at| format != "svg" || !of_probability(*at)).map(|at| arguments[at]).collect();
    let call = [&["uncertainty", "-", "--samples", "20000", "--format", format, "--units", units], &METHODS[..], &arguments].concat();
    let run = run_with_input(&call, &case.to_string());
    run.succeeds(&call);
    run.out
}

fn found(case: &Value, arguments: &[&str]) -> Value {
    document("uncertainty", case, &[&["--samples", "20000"], &METHODS[..], arguments].concat())
}

/// Returns the outputs of an answer in the order of the page.
fn ordered<'a>(answer: &'a Value, page: &str) -> Vec<(&'a String, &'a Value)> {
    let place = |name: &str| page.lines().position(|line| line.starts_with(name) && line.contains(" = ")).expect("a heading");
    let mut outputs: Vec<_> = object(&answer["of"]).iter().collect();
    outputs.sort_by_key(|(name, _)| place(name));
    outputs
}

/// Checks a printed number to its digits; those of a deviation `sd`, of which two must be there.
fn hold(cell: &str, si: &Value, of: &str, sd: f64, what: &str) {
    let (value, half) = printed(cell).unwrap_or_else(|| panic!("{what}: {cell:?} is no number, where {si} is expected"));
    let want = number(si) / unit(of);
    assert!((value - want).abs() <= half * (1.0 + 1e-6), "{what}: {cell} {of} for {want}");
    assert!(half <= 0.5001 * sd / unit(of), "{what}: {cell} has too few digits for a deviation of {sd}");
    assert!(value != 0.0 || !cell.starts_with('-'), "{what}: a zero has no sign");
}

/// Checks a share in percent with one decimal.
fn hold_percent(cell: &str, share: f64, what: &str) {
    let percent: f64 = cell.trim_end_matches([' ', '%']).parse().unwrap_or_else(|_| panic!("{what}: {cell}"));
    close(percent, 100.0 * share, 0.0501, what);
    assert!(!cell.starts_with("-0.0 "), "{what}: {cell}");
}

/// Returns the words after a phrase.
fn after<'a>(text: &'a str, phrase: &str) -> &'a str {
    text.split_once(phrase).unwrap_or_else(|| panic!("{phrase:?} is missing in {text}")).1
}

/// Checks the table of inputs.
fn inputs(rows: &[Vec<String>], answer: &Value) {
    assert_eq!(rows.len(), object(&answer["inputs"]).len());
    for row in rows {
        let name = row[0].as_str();
        let input = answer["inputs"].get(name).unwrap_or_else(|| panic!("no input {name}"));
        // An input without a dimension has no unit, and a wide table no ranges.
        let has_unit = row.len() > 3 && !row[3].contains(" to ");
        let (of, sd) = (if has_unit { row[3].as_str() } else { "" }, number(&input["sd"]));
        hold(&row[1], &input["mean"], of, sd, name);
        hold(&row[2], &input["sd"], of, sd, name);
        if let Some(range) = row.last().and_then(|cell| cell.split_once(" to ")) {
            hold(range.0, &input["range"][0], of, sd, name);
            hold(range.1, &input["range"][1], of, sd, name);
        }
    }
}

/// Checks the table of methods of an output.
fn methods(head: &[String], rows: &[Vec<String>], output: &Value, of: &str, level: f64) {
    let sd = number(&output["monte_carlo"]["sd"]);
    let ends = [0.5 - 0.5 * level, 0.5, 0.5 + 0.5 * level];
    let percent = |p: f64| format!("{} %", (1e6 * p).round() / 1e4);
    assert_eq!(head[1..], ["mean".to_owned(), "sd".to_owned(), percent(ends[0]), "median".to_owned(), percent(ends[2])]);
    assert_eq!(rows.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), ["linear", "second order", "samples", "standard error"]);
    let quantile = |key: &str, p: f64| {
        let of_p = |(name, _): &(&String, &Value)| (name.parse::<f64>().expect("a probability") - p).abs() < 1e-9;
        object(&output["monte_carlo"][key]).iter().find(of_p).unwrap_or_else(|| panic!("{p}")).1.clone()
    };
    for (row, keys) in rows.iter().zip([["linear", "mean", "sd"], ["second_order", "mean", "sd"], ["monte_carlo", "mean", "sd"]]) {
        hold(&row[1], &output[keys[0]][keys[1]], of, sd, "a mean");
        hold(&row[2], &output[keys[0]][keys[2]], of, sd, "a deviation");
    }
    for (at, p) in ends.into_iter().enumerate() {
        hold(&rows[2][3 + at], &quantile("quantiles", p), of, sd, "a quantile");
        let error = quantile("quantiles_se", p);
        hold(&rows[3][3 + at], &error, of, number(&error), "the error of a quantile");
    }
    for (at, key) in [(1, "mean_se"), (2, "sd_se")] {
        let error = &output["monte_carlo"][key];
        hold(&rows[3][at], error, of, number(error), key);
    }
}

/// Checks the table of shares of an output, the greatest first.
fn shares(head: &[String], rows: &[Vec<String>], output: &Value, of: &str) {
    let sobol = output.get("sobol");
    let size = |name: &str| number(sobol.map_or(&output["linear"]["shares"][name], |shares| &shares[name]["total"])).abs();
    assert!(rows.windows(2).all(|pair| size(&pair[0][0]) >= size(&pair[1][0])), "the greatest first");
    assert_eq!(rows.len(), object(&output["linear"]["shares"]).len().min(10));
    let with_others = ["share of the variance", "linear", "sd if halved", "alone", "with others"];
    assert_eq!(head, &with_others[..if sobol.is_some() { 5 } else { 3 }]);
    for row in rows {
        let name = row[0].as_str();
        hold_percent(&row[1], number(&output["linear"]["shares"][name]), name);
        hold(&row[2], &output["linear"]["sd_if_halved"][name], of, number(&output["monte_carlo"]["sd"]), name);
        if let Some(shares) = sobol {
            hold_percent(&row[3], number(&shares[name]["first"]), name);
            hold_percent(&row[4], number(&shares[name]["total"]), name);
        }
    }
}

#[test]
fn every_number_of_the_page() {
    let mut with_shares = 0;
    for (case, arguments) in cases() {
        let answer = found(&case, &arguments);
        let level = if arguments.contains(&"--level") { 0.9 } else { 0.95 };
        for units in ["si", "us"] {
            let page = in_units(&case, &arguments, "text", units);
            assert!(page.lines().all(|line| line.chars().count() <= 80 && line.trim_end() == line), "{page}");
            let flat = page.split_whitespace().collect::<Vec<_>>().join(" ");
            let mut found_tables = tables(&page).into_iter();
            let refused = number(&answer["refused"]["count"]);
            assert!(flat.contains(&format!("{} samples (seed 1);", answer["samples"])));
            if refused == 0.0 {
                assert!(flat.contains("physics refuses none"), "{page}");
            } else {
                let reasons: Vec<String> =
                    object(&answer["refused"]["reasons"]).iter().map(|(code, count)| format!("{code} {count}")).collect();
                let said = format!("physics refuses {refused} (");
                let share: f64 = after(&flat, &said).split(' ').next().and_then(|word| word.parse().ok()).expect("a share");
                close(share, 100.0 * refused / 20_000.0, 0.00501, "the refused share");
                assert!(share > 0.0);
                let said = format!("%: {}), and the figures are of the others", reasons.join(", "));
                assert!(flat.contains(&said), "{said}\n{page}");
            }
            inputs(&found_tables.next().expect("the inputs").rows, &answer);
            for (name, output) in ordered(&answer, &page) {
                let heading = page.lines().find(|line| line.starts_with(name.as_str()) && line.contains(" = ")).expect(name);
                let (value, of) = heading.split_once(" = ").expect("a value").1.split_once(' ').unwrap_or((after(heading, " = "), ""));
                hold(value, &output["value"], of, number(&output["monte_carlo"]["sd"]) * 10.0, name);
                let table = found_tables.next().expect("the methods");
                methods(&table.head, &table.rows, output, of, level);
                let table = found_tables.next().expect("the shares");
                let rows: Vec<Vec<String>> = table.rows.into_iter().filter(|row| !row[0].starts_with("- ")).collect();
                shares(&table.head, &rows, output, of);
                let below = after(&flat, heading);
                let mut words = after(below, "Curvature moves the mean by ").split(' ');
                let [linear, second] =
                    ["linear", "second_order"].map(|method| [&output[method]["mean"], &output[method]["sd"]].map(number));
                let moved: f64 = words.next().and_then(|word| word.parse().ok()).expect("a number");
                close(moved * unit(of), second[0] - linear[0], 0.051 * (second[0] - linear[0]).abs() + 1e-9 * linear[1], "the mean");
                hold_percent(
                    after(below, "Curvature").split_once('(').expect("a share").1.split(' ').next().expect("a word"),
                    (second[0] - linear[0]) / linear[1],
                    "moved",
                );
                hold_percent(after(below, "the sd by ").split(' ').next().expect("a word"), second[1] / linear[1] - 1.0, "wider");
                let skewness: f64 = after(below, "skewness ")
                    .split_once(". ")
                    .map_or("", |(word, _)| word)
                    .trim_end_matches('.')
                    .parse()
                    .expect("a skewness");
                close(skewness, number(&output["second_order"]["skewness"]), 0.00501, "skewness");
                let halved = object(&output["linear"]["sd_if_halved"]);
                let least = halved.iter().min_by(|one, other| number(one.1).total_cmp(&number(other.1))).expect("an input");
                let narrows = format!("measure {} twice as precisely: the sd falls by ", least.0);
                // With correlations, a smaller deviation of any input may leave the output as it is or wider.
                if number(least.1) < linear[1] {
                    let falls: f64 = after(below, &narrows).split(' ').next().and_then(|word| word.parse().ok()).expect("a share");
                    close(falls, 100.0 * (1.0 - number(least.1) / linear[1]), 0.501, "the sd falls");
                } else {
                    assert!(!below.split(" = ").next().expect("a part").contains("twice as precisely"), "{name}: {page}");
                }
                if let Some(shares) = output.get("sobol") {
                    with_shares += 1;
                    let errors = object(shares).values().flat_map(|share| [number(&share["first_se"]), number(&share["total_se"])]);
                    let word = after(below, "standard errors of at most ").split(' ').next().expect("a word");
                    hold_percent(word, errors.fold(0.0, f64::max), "the standard errors");
                }
            }
            let statements = object(&answer["probabilities"]);
            assert_eq!(found_tables.len(), usize::from(!statements.is_empty()));
            if let Some(table) = found_tables.next() {
                assert_eq!((table.head.join("|"), table.rows.len()), ("statement|probability|standard error".to_owned(), statements.len()));
                for row in &table.rows {
                    let (statement, probability) = (row[0].as_str(), &statements[&row[0]]);
                    close(row[1].parse().expect("a number"), number(&probability["value"]), 0.5001e-4, statement);
                    assert!(row[2].parse::<f64>().expect("a number") > 0.0, "{statement}: samples leave no certainty");
                    close(row[2].parse().expect("a number"), number(&probability["se"]), 0.5001e-4, statement);
                }
            }
        }
    }
    assert!(with_shares >= 12, "{with_shares}");
}

/// Returns the figure of a row of the table, and its standard error.
fn figure<'a>(output: &'a Value, method: &str, name: &str) -> (&'a Value, &'a Value) {
    const NONE: &Value = &Value::Null;
    let samples = &output["monte_carlo"];
    match (method, name.split_once(' ')) {
        ("nominal", None) => (&output["value"], NONE),
        ("linear", None) => (&output["linear"][name], NONE),
        ("linear", Some(("share", input))) => (&output["linear"]["shares"][input.trim_start_matches("of ")], NONE),
        ("linear", Some(("sd", input))) => (&output["linear"]["sd_if_halved"][input.trim_start_matches("with half of ")], NONE),
        ("second-order", None) => (&output["second_order"][name], NONE),
        ("monte-carlo", None) => (&samples[name], samples.get(format!("{name}_se")).unwrap_or(NONE)),
        ("monte-carlo", Some(("quantile", p))) => (&samples["quantiles"][p], &samples["quantiles_se"][p]),
        ("sobol", Some((kind, input))) => {
            let share = &output["sobol"][input.trim_start_matches("of ")];
            (&share[kind], &share[format!("{kind}_se")])
        }
        ("shapley", Some(("effect", input))) => {
            let found = &output["shapley"][input.trim_start_matches("of ")];
            (&found["effect"], &found["se"])
        }
        ("bounds", _) => (&output["bounds"][name.replace(' ', "_")], NONE),
        _ => panic!("{method} has no figure {name}"),
    }
}

/// Counts the numbers of an output, without the bins of its density.
fn count(output: &Value) -> usize {
    let shares = output.get("sobol").map_or(0, |shares| 2 * object(shares).len());
    let bounds = output.get("bounds").map_or(0, |_| 4);
    1 + 2 + 2 * object(&output["linear"]["shares"]).len() + 3 + 3 + object(&output["monte_carlo"]["quantiles"]).len() + shares + bounds
}

#[test]
fn every_number_of_the_table() {
    for (case, arguments) in cases() {
        let answer = found(&case, &arguments);
        for units in ["si", "us"] {
            let text = in_units(&case, &arguments, "csv", units);
            let mut reader = csv::Reader::from_reader(text.as_bytes());
            let head: Vec<String> = reader.headers().expect("a head").iter().map(str::to_owned).collect();
            assert_eq!(head, ["name", "unit", "method", "figure", "value", "standard error"]);
            let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.expect("a row")).collect();
            let wanted: usize = object(&answer["of"]).values().map(count).sum::<usize>() + object(&answer["probabilities"]).len();
            assert_eq!(rows.len(), wanted, "a row for each number");
            for row in &rows {
                let what = row.iter().collect::<Vec<_>>().join(",");
                let is_share = row[3].contains("share of ") || ["sobol", "shapley"].contains(&&row[2]) || &row[3] == "skewness";
                assert!(!is_share || row[1].is_empty(), "{what}");
                let (value, error) = if &row[3] == "probability" {
                    let probability = &answer["probabilities"][&row[0]];
                    (&probability["value"], &probability["se"])
                } else {
                    figure(&answer["of"][&row[0]], &row[2], &row[3])
                };
                for (cell, want) in [(&row[4], value), (&row[5], error)] {
                    if want.is_null() {
                        assert!(cell.is_empty(), "{what}");
                        continue;
                    }
                    let got: f64 = cell.parse().unwrap_or_else(|_| panic!("{what}"));
                    close(got * unit(&row[1]), number(want), 1e-13 * number(want).abs(), &what);
                }
            }
        }
    }
}

#[test]
fn every_shapley_effect() {
    let reference = &references("uncertainty.jsonl")[1];
    assert_eq!(reference["case"]["title"], "correlated");
    let call = |format: &str| {
        let methods = "linear,monte-carlo,shapley";
        let all = ["uncertainty", "-", "--of", "dV1", "--samples", "20000", "--method", methods, "--units", "si", "--format", format];
        let run = run_with_input(&all, &reference["case"].to_string());
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        run.out
    };
    let answer: Value = serde_json::from_str(&call("json")).expect("JSON");
    let (name, output) = object(&answer["of"]).iter().next().expect("an output");
    let effects = object(&output["shapley"]);
    close(effects.values().map(|found| number(&found["effect"])).sum(), 1.0, 1e-12, "all of the variance");
    let page = call("text");
    let found = tables(&page);
    let table = found.iter().find(|table| table.head[0] == "share of the variance").expect("a table");
    assert_eq!(table.head, ["share of the variance", "linear", "sd if halved", "Shapley"]);
    let rows: Vec<&Vec<String>> = table.rows.iter().filter(|row| effects.contains_key(&row[0])).collect();
    let size = |row: &[String]| number(&effects[&row[0]]["effect"]).abs();
    assert!(rows.len() == effects.len() && rows.windows(2).all(|pair| size(pair[0]) >= size(pair[1])), "the greatest first");
    rows.iter().for_each(|row| hold_percent(&row[3], number(&effects[&row[0]]["effect"]), &row[0]));
    let flat = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let worst = after(&flat, "Shapley effects have standard errors of at most ").split(' ').next().expect("a word");
    hold_percent(worst, effects.values().map(|found| number(&found["se"])).fold(0.0, f64::max), "the standard errors");
    let text = call("csv");
    let rows = csv::Reader::from_reader(text.as_bytes()).records().map(|row| row.expect("a row")).collect::<Vec<_>>();
    let rows: Vec<&csv::StringRecord> = rows.iter().filter(|row| &row[2] == "shapley").collect();
    assert_eq!(rows.len(), effects.len());
    for row in rows {
        let (effect, error) = figure(&answer["of"][name], &row[2], &row[3]);
        assert!(row[1].is_empty(), "an effect has no unit");
        for (cell, want) in [(&row[4], effect), (&row[5], error)] {
            close(cell.parse().expect("a number"), number(want), 1e-13 * number(want).abs(), &row[3]);
        }
    }
    // Of the chart: a name, and on its line the number.
    let chart = call("svg");
    let lines: Vec<&str> = chart.lines().collect();
    let texts: Vec<(&str, &str)> = lines.windows(2).filter(|pair| pair[0].starts_with("<text")).map(|pair| (pair[0], pair[1])).collect();
    assert!(texts.iter().any(|(_, words)| *words == "share of the variance: Shapley effects"));
    for (input, found) in effects {
        let row = texts.iter().find(|(_, words)| words == input).unwrap_or_else(|| panic!("no bar of {input}"));
        let cell = texts.iter().find(|(line, words)| {
            words.ends_with(" %") && attribute(line, "y") == attribute(row.0, "y") && attribute(line, "x") != attribute(row.0, "x")
        });
        hold_percent(cell.expect("a number").1, number(&found["effect"]), input);
    }
}

/// Heights of the title, of a density, of a row of intervals and of their axis, in chart coordinates of an eighth of a pixel.
const TITLE: f64 = 8.0 * 40.0;
const HEIGHT: f64 = 8.0 * 300.0;
const ROW: f64 = 8.0 * 24.0;
const AXIS: f64 = 8.0 * 68.0;

/// A chart of intervals: its lines between two heights.
struct Intervals<'a> {
    lines: &'a [&'a str],
    from: f64,
    to: f64,
}

impl Intervals<'_> {
    fn coordinate(line: &str, name: &str) -> f64 {
        attribute(line, name).parse().expect("a coordinate")
    }

    fn inside(&self, y: f64) -> bool {
        (self.from..self.to).contains(&y)
    }

    /// Returns the texts that begin left of a place, with what is between it and their heights.
    fn texts(&self) -> Vec<(f64, f64, &str)> {
        let pairs = self.lines.windows(2).filter(|pair| pair[0].starts_with("<text"));
        let at = pairs.map(|pair| (Self::coordinate(pair[0], "x"), Self::coordinate(pair[0], "y"), pair[1]));
        at.filter(|(_, y, _)| self.inside(*y)).collect()
    }

    /// Returns the horizontal lines of a color, from left to right, and the bars of an opacity, each as start, end and height.
    fn spans(&self, color: &str, opacity: &str) -> Vec<[f64; 3]> {
        let ends = |line: &&str| {
            let points = attribute(line, "points").split_whitespace().map(|pair| pair.split_once(',').expect("a pair"));
            let points: Vec<[f64; 2]> = points.map(|(x, y)| [x, y].map(|word| word.parse().expect("a number"))).collect();
            let [[x, y], [to, end]] = points[..] else { return None };
            (y == end && self.inside(y) && x != to).then_some([x, to, y])
        };
        let is_line = |line: &&&str| line.starts_with("<polyline") && attribute(line, "stroke") == color;
        let lines = self.lines.iter().filter(is_line).filter_map(ends);
        let is_bar = |line: &&&str| line.starts_with("<rect") && attribute(line, "fill") == color && attribute(line, "opacity") == opacity;
        let bars = self.lines.iter().filter(is_bar).map(|line| {
            let [x, width, y, height] = ["x", "width", "y", "height"].map(|name| Self::coordinate(line, name));
            [x, x + width, y + 0.5 * height]
        });
        lines.chain(bars).filter(|[_, _, y]| self.inside(*y)).collect()
    }

    fn circles(&self) -> Vec<[f64; 2]> {
        let all = self.lines.iter().filter(|line| line.starts_with("<circle"));
        all.map(|line| ["cx", "cy"].map(|name| Self::coordinate(line, name))).filter(|[_, y]| self.inside(*y)).collect()
    }
}

/// Checks the words behind an interval: each number to its digits, in its unit.
fn hold_all(words: &str, wanted: &[f64], of: &str, sd: f64) {
    let numbers: Vec<&str> = words.split(' ').filter(|word| printed(word).is_some()).collect();
    assert_eq!(numbers.len(), wanted.len(), "{words}");
    numbers.iter().zip(wanted).for_each(|(cell, si)| hold(cell, &Value::from(*si), of, sd, words));
    assert_eq!(words.matches(of).count(), wanted.len(), "{words}: {of}");
}

#[test]
fn every_interval_of_the_chart() {
    let call = |name: &str, arguments: &[&str], format: &str| {
        let draws = arguments.iter().all(|methods| !methods.contains("bounds"));
        let count: &[&str] = if draws { &["--samples", "5000"] } else { &[] };
        let all = [&["uncertainty", "-", "--format", format, "--units", "us", "--of", "dV1,T_L"], count, arguments].concat();
        let run = run_with_input(&all, &case(name).to_string());
        run.succeeds(&all);
        run.out
    };
    for (name, arguments, methods) in [
        ("uncertainty/differences.toml", &[][..], &["linear", "second_order", "monte_carlo"][..]),
        ("uncertainty/independent.toml", &["--method", "second-order,bounds"], &["second_order"]),
        ("uncertainty/sampled.toml", &["--method", "linear,sobol"], &["linear"]),
        ("uncertainty/independent.toml", &["--method", "bounds"], &[]),
    ] {
        let asked = arguments.last().copied().unwrap_or("linear,bounds");
        let has_bounds = asked.contains("bounds");
        let answer: Value = serde_json::from_str(&call(name, arguments, "json")).expect("JSON");
        let chart = call(name, arguments, "svg");
        let lines: Vec<&str> = chart.lines().collect();
        let of = |name: &str| if name == "energy.loss" { "ft lb" } else { "ft/s" };
        let mut top = TITLE;
        for name in ["vehicle.1.delta_v_magnitude", "energy.loss"] {
            let output = &answer["of"][name];
            let (of, sd) = (of(name), ["monte_carlo", "linear"].iter().find_map(|key| output.get(key)?["sd"].as_f64()));
            let sd = 10.0 * sd.unwrap_or(number(&output["value"]).abs());
            if ["linear", "monte-carlo", "sobol"].iter().any(|method| asked.contains(method)) {
                top += HEIGHT;
            }
            if !methods.is_empty() {
                let to = top + methods.len() as f64 * ROW + AXIS;
                let chart = Intervals { lines: &lines, from: top, to };
                let across = axis(&lines, "middle", "x", |y| chart.inside(y));
                let dx = (across(12.0) - across(0.0)).abs();
                let names: Vec<&str> = chart.texts().iter().filter(|(x, ..)| *x == 128.0).map(|(.., text)| *text).collect();
                let wanted = methods.iter().map(|method| match *method {
                    "second_order" => "second order",
                    "monte_carlo" => "samples",
                    method => method,
                });
                assert_eq!(names, wanted.collect::<Vec<_>>(), "{name}");
                assert!(chart.texts().iter().any(|(.., text)| text.starts_with("mean ± sd of ") && text.ends_with(&format!(" [{of}]"))));
                for (row, method) in methods.iter().enumerate() {
                    let [mean, sd_of] = ["mean", "sd"].map(|key| number(&output[method][key]));
                    let color = ["#D55E00", "#5A5A5A", "#0072B2"]
                        [["linear", "second_order", "monte_carlo"].iter().position(|one| one == method).expect("a method")];
                    let [[start, end, y]] = chart.spans(color, "1")[..] else { panic!("{name}: one line of {method}") };
                    close(across(start), (mean - sd_of) / unit(of), dx, name);
                    close(across(end), (mean + sd_of) / unit(of), dx, name);
                    let [x, cy] = chart.circles()[row];
                    close(across(x), mean / unit(of), dx, name);
                    assert!((y - cy).abs() <= 1.0 && y > top + row as f64 * ROW && y < top + (row + 1) as f64 * ROW + 96.0, "{name}");
                    let words = chart.texts().iter().filter(|(x, ..)| *x == 8.0 * 600.0).map(|(.., text)| *text).nth(row).expect("numbers");
                    let (words, skewed) = words.split_once("; skewness ").map_or((words, None), |(words, skewed)| (words, Some(skewed)));
                    hold_all(words, &[mean, sd_of], of, sd);
                    assert_eq!(skewed.is_some(), *method != "linear");
                    if let Some(skewed) = skewed {
                        close(skewed.parse().expect("a number"), number(&output[method]["skewness"]), 0.00501, name);
                    }
                }
                top = to;
            }
            if has_bounds {
                let to = top + 3.0 * ROW + AXIS;
                let chart = Intervals { lines: &lines, from: top, to };
                let across = axis(&lines, "middle", "x", |y| chart.inside(y));
                let dx = (across(12.0) - across(0.0)).abs();
                let names: Vec<&str> = chart.texts().iter().filter(|(x, ..)| *x == 128.0).map(|(.., text)| *text).collect();
                assert_eq!(names, ["guaranteed", "attained", "nominal"]);
                assert!(chart.texts().iter().any(|(.., text)| text.starts_with("range of ") && text.ends_with(&format!(" [{of}]"))));
                let bounds = &output["bounds"];
                let words: Vec<&str> = chart.texts().iter().filter(|(x, ..)| *x == 8.0 * 600.0).map(|(.., text)| *text).collect();
                for (row, (keys, opacity)) in [(["low", "high"], "0.35"), (["low_attained", "high_attained"], "1")].into_iter().enumerate()
                {
                    let wanted = keys.map(|key| number(&bounds[key]));
                    let [[start, end, _]] = chart.spans("#0072B2", opacity)[..] else { panic!("{name}: one bar of {keys:?}") };
                    close(across(start), wanted[0] / unit(of), dx, name);
                    close(across(end), wanted[1] / unit(of), dx, name);
                    // Outward to the last digit, or found near the ends.
                    let ends: Vec<_> =
                        words[row].split(" to ").map(|end| printed(end.trim_end_matches(of).trim()).expect("a number")).collect();
                    let over: Vec<f64> = ends
                        .iter()
                        .zip(wanted)
                        .zip([-1.0, 1.0])
                        .map(|((end, want), side)| side * (end.0 - want / unit(of)) / end.1)
                        .collect();
                    let wanted = if row == 0 { -1e-5..2.0 } else { -1.001..1.001 };
                    assert!(
                        over.len() == 2 && over.iter().all(|over| wanted.contains(over)),
                        "{name}: {} is {over:?} half digits outward",
                        words[row]
                    );
                }
                let [[x, _]] = chart.circles()[..] else { panic!("{name}: one mark") };
                close(across(x), number(&output["value"]) / unit(of), dx, name);
                hold_all(words[2], &[number(&output["value"])], of, sd);
                top = to;
            }
        }
        // Nothing lies below the last panel.
        let height: f64 = attribute(lines[0], "viewBox").split(' ').next_back().and_then(|word| word.parse().ok()).expect("a height");
        close(height, top, 0.5, "the height of the page");
    }
}

#[test]
fn every_line_of_the_chart() {
    /// Height of a density with the methods below it, and the width of a density.
    const PANEL: f64 = HEIGHT + 3.0 * ROW + AXIS;
    const DENSITY: f64 = 8.0 * 550.0;
    for (case, arguments) in cases() {
        let answer = found(&case, &arguments);
        let level = if arguments.contains(&"--level") { 0.9 } else { 0.95 };
        let chart = in_units(&case, &arguments, "svg", "us");
        let lines: Vec<&str> = chart.lines().collect();
        let coordinate = |line: &str, name: &str| attribute(line, name).parse::<f64>().expect("a coordinate");
        let page = in_units(&case, &arguments, "text", "us");
        for (panel, (name, output)) in ordered(&answer, &page).into_iter().enumerate() {
            let inside = |y: f64| (TITLE + panel as f64 * PANEL..TITLE + panel as f64 * PANEL + HEIGHT).contains(&y);
            let texts = || lines.windows(2).filter(|pair| pair[0].starts_with("<text") && inside(coordinate(pair[0], "y")));
            let of_axis = texts().filter(|pair| attribute(pair[0], "text-anchor") == "middle").map(|pair| pair[1]);
            let of = of_axis.clone().find_map(|text| text.split_once(" [")).map_or("", |(_, unit)| unit.trim_end_matches(']'));
            let (across, up) = (axis(&lines, "middle", "x", inside), axis(&lines, "end", "y", inside));
            // Coordinates are whole numbers; labels are where they are to a pixel.
            let (dx, dy) = ((across(12.0) - across(0.0)).abs(), (up(12.0) - up(0.0)).abs());
            let si = |value: f64| value / unit(of);
            let density = &output["monte_carlo"]["density"];
            let (edges, shares) = (array(&density["edges"]), array(&density["shares"]));
            let bars: Vec<&&str> = lines
                .iter()
                .filter(|line| line.starts_with("<rect") && attribute(line, "opacity") == "0.35")
                .filter(|line| coordinate(line, "x") < DENSITY && inside(coordinate(line, "y")))
                .collect();
            assert_eq!(bars.len(), shares.len(), "{name}: a bar for each bin");
            for (at, bar) in bars.into_iter().enumerate() {
                let (start, end) = (si(number(&edges[at])), si(number(&edges[at + 1])));
                close(across(coordinate(bar, "x")), start, dx, name);
                close(up(coordinate(bar, "y")), number(&shares[at]) / (end - start), dy, name);
            }
            let curves = |color: &'static str| {
                let points = lines.iter().filter(move |line| line.starts_with("<polyline") && attribute(line, "stroke") == color);
                let points = points.map(|line| {
                    let pairs = attribute(line, "points").split_whitespace().map(|pair| pair.split_once(',').expect("a pair"));
                    pairs.map(|(x, y)| [x, y].map(|word| word.parse::<f64>().expect("a number"))).collect::<Vec<_>>()
                });
                points.filter(|points| points[0][0] < DENSITY && inside(points[0][1])).collect::<Vec<_>>()
            };
            let quantiles = &object(&output["monte_carlo"]["quantiles"]);
            let ends = [0.5 - 0.5 * level, 0.5, 0.5 + 0.5 * level]
                .map(|p| quantiles.iter().find(|(key, _)| (key.parse::<f64>().expect("a number") - p).abs() < 1e-9).expect("a quantile").1);
            let marks = curves("#5A5A5A");
            assert_eq!(marks.len(), 3, "{name}");
            for (mark, want) in marks.iter().zip(ends) {
                close(across(mark[0][0]), si(number(want)), dx, name);
            }
            let [mean, sd] = ["mean", "sd"].map(|key| si(number(&output["linear"][key])));
            let [normal] = &curves("#D55E00")[..] else { panic!("{name}: one normal density") };
            for point in normal {
                let z = (across(point[0]) - mean) / sd;
                let want = (-0.5 * z * z).exp() / (sd * (2.0 * std::f64::consts::PI).sqrt());
                // Where it is steep, a pixel across is several up.
                close(up(point[1]), want, dy + dx * want * z.abs() / sd, name);
            }
            // Shares: a name, and on its line the numbers; the greatest first.
            let rows: Vec<&[&str]> = texts().filter(|pair| output["linear"]["shares"].get(pair[1]).is_some()).collect();
            assert_eq!(rows.len(), object(&output["linear"]["shares"]).len().min(8), "{name}");
            for row in rows {
                let numbers = texts().find(|pair| {
                    pair[1].ends_with('%') && attribute(pair[0], "y") == attribute(row[0], "y") && coordinate(pair[0], "x") > DENSITY
                });
                let cells: Vec<&str> = numbers.expect("numbers")[1].split(", ").collect();
                let wanted: Vec<f64> = match output.get("sobol") {
                    Some(shares) => ["first", "total"].map(|key| number(&shares[row[1]][key])).to_vec(),
                    None => vec![number(&output["linear"]["shares"][row[1]])],
                };
                assert_eq!(cells.len(), wanted.len(), "{name}");
                cells.iter().zip(wanted).for_each(|(cell, want)| hold_percent(cell, want, row[1]));
            }
            for words in ["samples", "normal, of the linear mean and sd"] {
                assert!(texts().any(|pair| pair[1] == words), "{name}: the legend has no {words}");
            }
        }
    }
}

#[test]
fn distributions_are_those_of_the_file() {
    let answer = found(&case("uncertain.toml"), &["--of", "dV1"]);
    let kmh = 1.0 / 3.6;
    let wanted: [(&str, f64, f64, f64, [f64; 2]); 6] = [
        ("vehicle.1.mass", 1450.0, 1450.0, 40.0, [1330.0, 1570.0]),
        ("vehicle.1.speed", 52.0 * kmh, 52.0 * kmh, 3.0 * kmh, [43.0 * kmh, 61.0 * kmh]),
        ("vehicle.2.mass", 2180.0, 2180.0, 60.0, [2000.0, 2360.0]),
        ("vehicle.2.speed", 41.0 * kmh, 41.0 * kmh, 10.0 * kmh / 12_f64.sqrt(), [36.0 * kmh, 46.0 * kmh]),
        ("contact.crush_plane", 0.0, 0.0, unit("deg") * 16.0 / 12_f64.sqrt(), [-8.0 * unit("deg"), 8.0 * unit("deg")]),
        // Triangular, (a² + b² + c² − ab − ac − bc)/18.
        ("contact.restitution", 0.1, 0.4 / 3.0, ((0.09 + 0.01 - 0.03) / 18.0_f64).sqrt(), [0.0, 0.3]),
    ];
    assert_eq!(object(&answer["inputs"]).len(), wanted.len());
    for (name, value, mean, sd, range) in wanted {
        let input = &answer["inputs"][name];
        for (key, want) in [("value", value), ("mean", mean), ("sd", sd)] {
            close(number(&input[key]), want, 1e-12 * sd, name);
        }
        range.iter().enumerate().for_each(|(at, want)| close(number(&input["range"][at]), *want, 1e-12 * sd, name));
    }
    let wide = found(&case("uncertain.toml"), &["--of", "dV1", "--bounds-sd", "2"]);
    close(number(&wide["inputs"]["vehicle.1.mass"]["range"][0]), 1370.0, 1e-9, "two deviations");
}

#[test]
fn effects_are_derivatives_times_deviations() {
    // Normal inputs, whose means are their nominal values.
    let mut case = case("position-a.toml");
    case["vehicle"][0]["speed"] = "40 ft/s ± 2 ft/s".into();
    case["vehicle"][1]["mass"] = "6345 lb ± 200 lb".into();
    case["contact"]["crush_plane"] = "3 deg ± 4 deg".into();
    let outputs = ["--of", "T_L,dV1,mu0"];
    let found = document("uncertainty", &case, &[&outputs[..], &["--method", "linear"]].concat());
    let slopes = document("gradient", &case, &outputs);
    for (name, output) in object(&found["of"]) {
        let (sd, mut variance) = (number(&output["linear"]["sd"]), 0.0);
        for (input, effect) in object(&output["linear"]["effects"]) {
            let want = number(&slopes["of"][name]["d"][input]) * number(&found["inputs"][input]["sd"]);
            close(number(effect), want, 1e-9 * sd, input);
            variance += number(effect) * number(effect);
        }
        close(variance, sd * sd, 1e-12 * sd * sd, name);
    }
}

#[test]
fn a_density_is_of_all_samples_but_the_ends() {
    for (case, arguments) in cases() {
        for (name, output) in object(&found(&case, &arguments)["of"]) {
            let density = &output["monte_carlo"]["density"];
            let (edges, shares) = (array(&density["edges"]), array(&density["shares"]));
            assert_eq!(edges.len(), shares.len() + 1, "{name}");
            let width = number(&edges[1]) - number(&edges[0]);
            assert!(edges.windows(2).all(|pair| ((number(&pair[1]) - number(&pair[0])) / width - 1.0).abs() < 1e-6), "{name}");
            let all: f64 = shares.iter().map(number).sum();
            close(all, 0.998, 0.0025, name);
            // The quartiles of the density are those of the samples, to a bin.
            let (mut below, mut at) = (0.0, 0);
            while below < 0.249 {
                below += number(&shares[at]);
                at += 1;
            }
            close(number(&edges[at]), number(&output["monte_carlo"]["quantiles"]["0.25"]), 1.5 * width, name);
            let sample = &output["value"];
            let solved = document("solve", &case, &[]);
            if let Some(vehicle) = name.strip_suffix(".delta_v_magnitude").and_then(|name| name.strip_prefix("vehicle.")) {
                let place = vehicle.parse::<usize>().expect("a vehicle") - 1;
                assert_eq!(sample, &solved["vehicles"][place]["delta_v_magnitude"], "{name}");
            }
        }
    }
}
