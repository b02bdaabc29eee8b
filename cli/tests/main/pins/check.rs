//! `check`: the report formats agree, sizes match hand calculations, and lines match the file.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use serde_json::{Value, json};

use super::{array, close, number};
use crate::process::{Run, run, run_with_input, workspace};

const EXAMPLES: [&str; 5] = ["collision.json", "engine.jsonl", "paper-table-2.csv", "paper-table-b1.csv", "template.csv"];
/// Severities in SARIF.
const LEVELS: [(&str, &str); 3] = [("fail", "error"), ("warn", "warning"), ("undecidable", "note")];

/// Returns one record of each verdict: momentum not conserved, an implausible inertia, momentum undecidable at the
/// given resolution, an unreadable record, and a valid one.
fn mixed() -> String {
    let record = |id: &str, more: &str, after: &str| {
        format!(
            "{{\"id\": \"{id}\", {more}\"bodies\": [{{\"mass\": 1000, \"before\": {{\"v\": [3, 0]}}, \"after\": {{\"v\": [{after}, 0]}}}}, \
             {{\"mass\": 2000, \"before\": {{\"v\": [-1, 0]}}, \"after\": {{\"v\": [1, 0]}}}}]}}"
        )
    };
    let head =
        "{\"schema\": \"planar-impact-record/1\", \"units\": {\"length\": \"m\", \"mass\": \"kg\", \"time\": \"s\", \"angle\": \"deg\"}}";
    let small = record("small", "", "-1").replace("\"mass\": 2000", "\"mass\": 2000, \"yaw_inertia\": 1");
    let open = record("open", "\"resolution\": {\"v\": 9}, ", "-1");
    let both = record("both", "", "0").replace("\"mass\": 2000", "\"mass\": 2000, \"yaw_inertia\": 1");
    [head.to_owned(), record("off", "", "0"), small, open, "{\"id\": \"bad\", \"bodie\": 1}".to_owned(), both, record("sound", "", "-1")]
        .join("\n")
        + "\n"
}

/// Returns each set of records, by its name in reports and its text.
fn inputs() -> Vec<(String, String)> {
    let folder = workspace().join("cli/examples/check");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("the example can be read");
    let mut all: Vec<_> = EXAMPLES.map(|name| (format!("cli/examples/check/{name}"), read(name))).into();
    all.push(("<stdin>".to_owned(), mixed()));
    all
}

fn check(name: &str, text: &str, arguments: &[&str]) -> Run {
    match name {
        "<stdin>" => run_with_input(&[&["check", "-"], arguments].concat(), text),
        _ => run(&workspace(), &[&["check", name], arguments].concat()),
    }
}

fn json_of(name: &str, text: &str) -> Value {
    let run = check(name, text, &["--format", "json"]);
    assert_eq!(run.err, "");
    serde_json::from_str(&run.out).expect("JSON")
}

fn text_of<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("{key} of {value}"))
}

#[test]
fn verdicts_lines_and_counts() {
    for (name, text) in inputs() {
        let found = json_of(&name, &text);
        let mut counts = [("pass", 0), ("warn", 0), ("fail", 0), ("undecidable", 0)];
        for record in array(&found["records"]) {
            let severities: Vec<&str> = array(&record["findings"]).iter().map(|finding| text_of(finding, "severity")).collect();
            // The most severe of them.
            let worst = ["fail", "undecidable", "warn"].into_iter().find(|severity| severities.contains(severity)).unwrap_or("pass");
            assert_eq!(record["verdict"], worst, "{record}");
            counts.iter_mut().filter(|(verdict, _)| *verdict == worst).for_each(|(_, count)| *count += 1);
            assert_eq!(record["file"], name.as_str());
            let line = text.lines().nth(number(&record["line"]) as usize - 1).expect("a line of the file");
            // In a document, records begin where their brace opens.
            assert!(line.contains(text_of(record, "id")) || line.trim_start().starts_with('{'), "{record}: {line}");
        }
        let mut want = json!({ "records": array(&found["records"]).len() });
        counts.iter().for_each(|(verdict, count)| want[*verdict] = json!(count));
        assert_eq!(found["summary"], want, "{name}");
        let told = check(&name, &text, &[]).out;
        let numbers: Vec<u64> = told
            .lines()
            .rev()
            .find(|line| line.contains(" pass,"))
            .map_or(Vec::new(), |line| line.split_whitespace().filter_map(|word| word.parse().ok()).collect());
        assert_eq!(numbers, [array(&found["records"]).len() as u64, counts[0].1, counts[1].1, counts[2].1, counts[3].1], "{told}");
    }
}

#[test]
fn sizes_by_hand() {
    /// One foot-pound in J (NIST SP 811).
    const FOOT_POUND: f64 = 1.355_817_948_331_4;
    let findings = |name: &str| {
        let found = json_of(&format!("cli/examples/check/{name}"), "");
        let all: Vec<Value> = array(&found["records"]).iter().flat_map(|record| array(&record["findings"]).to_vec()).collect();
        all
    };
    let [misprint] = &findings("paper-table-b1.csv")[..] else { panic!("one finding") };
    // 49197.30 + 6955.70 − 50153.00 ft lb, three numbers rounded to half a hundredth each.
    close(number(&misprint["size"]), 6000.0 * FOOT_POUND, 1e-9, "size");
    close(number(&misprint["bound"]), 0.015 * FOOT_POUND, 1e-8, "bound");
    let [misprint] = &findings("paper-table-2.csv")[..] else { panic!("one finding") };
    assert_eq!((&misprint["rule"], &misprint["severity"]), (&json!("group"), &json!("fail")));
    // −21631.2 printed for −21639.2; the other records of the group agree to their digits.
    close(number(&misprint["size"]), 8.0 * FOOT_POUND, 0.1 * FOOT_POUND, "size");
    let found = json_of("<stdin>", &mixed());
    let off = &found["records"][0]["findings"][0];
    // 1000 kg × (0 − 3 m/s) + 2000 kg × (1 + 1 m/s) = 1000 N s.
    assert_eq!((&off["rule"], off["size"].as_f64()), (&json!("linear-momentum"), Some(1000.0)));
    assert!(number(&off["bound"]) < 1000.0);
    let open = &found["records"][2]["findings"][0];
    // The margin of four velocities with a resolution of 9 m/s: (2 × 1000 + 2 × 2000) × 9 N s.
    assert_eq!((&open["severity"], open["bound"].as_f64()), (&json!("undecidable"), Some(54_000.0)));
}

/// The attributes of an element, in order.
type Attributes = Vec<(String, String)>;

/// A case of JUnit: its attributes, and its child elements with their attributes and text.
struct Case {
    attributes: Attributes,
    inner: Vec<(String, Attributes, String)>,
}

fn attributes(tag: &BytesStart<'_>) -> Attributes {
    let read = tag.attributes().map(|attribute| attribute.expect("well formed"));
    read.map(|at| (at.key.as_ref().to_owned(), quick_xml::escape::unescape(&at.value).expect("well formed").into_owned())).collect()
}

fn junit(xml: &str) -> Vec<Case> {
    let (mut reader, mut cases) = (Reader::from_str(xml), Vec::<Case>::new());
    loop {
        let event = reader.read_event().unwrap_or_else(|error| panic!("{error}: {xml}"));
        match event {
            Event::Start(tag) | Event::Empty(tag) => match tag.name().as_ref() {
                "testcase" => cases.push(Case { attributes: attributes(&tag), inner: Vec::new() }),
                "testsuites" | "testsuite" => (),
                name => cases.last_mut().expect("a case").inner.push((name.to_owned(), attributes(&tag), String::new())),
            },
            Event::Text(text) => {
                if let Some((_, _, told)) = cases.last_mut().and_then(|case| case.inner.last_mut()) {
                    told.push_str(text.as_ref());
                }
            }
            Event::GeneralRef(entity) => {
                let known = match entity.as_ref() {
                    "lt" => "<",
                    "gt" => ">",
                    "amp" => "&",
                    "quot" => "\"",
                    "apos" => "'",
                    other => panic!("&{other};"),
                };
                cases.last_mut().and_then(|case| case.inner.last_mut()).expect("an element").2.push_str(known);
            }
            Event::Eof => return cases,
            _ => (),
        }
    }
}

#[test]
fn junit_says_what_the_document_says() {
    for (name, text) in inputs() {
        let found = json_of(&name, &text);
        for (arguments, failing) in [
            (&[][..], &["fail"][..]),
            (&["--fail-on", "undecidable"], &["fail", "undecidable"]),
            (&["--fail-on", "warn"], &["fail", "undecidable", "warn"]),
        ] {
            let run = check(&name, &text, &[&["--format", "junit"], arguments].concat());
            let cases = junit(&run.out);
            assert_eq!(cases.len(), array(&found["records"]).len(), "{name}");
            for (case, record) in cases.iter().zip(array(&found["records"])) {
                let want = [
                    ("classname", &name),
                    ("name", &text_of(record, "id").to_owned()),
                    ("file", &name),
                    ("line", &record["line"].to_string()),
                ];
                let got: Vec<(&str, &String)> = case.attributes.iter().map(|(key, value)| (key.as_str(), value)).collect();
                assert_eq!(got, want);
                let (failed, rest): (Vec<&Value>, Vec<&Value>) =
                    array(&record["findings"]).iter().partition(|finding| failing.contains(&text_of(finding, "severity")));
                let mut inner = case.inner.iter();
                for finding in &failed {
                    let (element, attributes, told) = inner.next().expect("a failure");
                    assert_eq!(element, "failure");
                    let message = format!("{}: {}", text_of(finding, "rule"), text_of(finding, "what"));
                    assert_eq!(attributes[..], [("message".to_owned(), message), ("type".to_owned(), text_of(finding, "rule").to_owned())]);
                    assert_eq!(told.trim(), text_of(finding, "what"));
                }
                let open = rest.iter().find(|finding| finding["severity"] == "undecidable" && failed.is_empty());
                if let Some(finding) = open {
                    let (element, attributes, _) = inner.next().expect("a reason to skip");
                    let message = format!("{}: {}", text_of(finding, "rule"), text_of(finding, "what"));
                    assert_eq!((element.as_str(), &attributes[0].1), ("skipped", &message));
                }
                if !rest.is_empty() {
                    let (element, _, told) = inner.next().expect("what is no failure");
                    let line = |finding: &&Value| {
                        format!("{} ({}): {}", text_of(finding, "rule"), text_of(finding, "severity"), text_of(finding, "what"))
                    };
                    assert_eq!(
                        (element.as_str(), told.trim()),
                        ("system-out", rest.iter().map(line).collect::<Vec<_>>().join("\n").as_str())
                    );
                }
                assert!(inner.next().is_none(), "every element is held");
            }
            let worst = array(&found["records"]).iter().flat_map(|record| array(&record["findings"]));
            let fails = worst.into_iter().any(|finding| failing.contains(&text_of(finding, "severity")));
            assert_eq!(run.status, i32::from(fails), "{name} {arguments:?}");
        }
    }
}

#[test]
fn sarif_says_what_the_document_says() {
    let rules: Value = serde_json::from_str(&run(&workspace(), &["check", "--rules", "--format", "json"]).out).expect("JSON");
    let level = |severity: &str| LEVELS.iter().find(|(known, _)| *known == severity).expect("a severity").1;
    for (name, text) in inputs() {
        let found = json_of(&name, &text);
        let log: Value = serde_json::from_str(&check(&name, &text, &["--format", "sarif"]).out).expect("JSON");
        let run = &log["runs"][0];
        assert_eq!((&log["version"], array(&log["runs"]).len(), &run["columnKind"]), (&json!("2.1.0"), 1, &json!("unicodeCodePoints")));
        let mut results = array(&run["results"]).iter();
        for record in array(&found["records"]) {
            for (place, finding) in array(&record["findings"]).iter().enumerate() {
                let (id, rule) = (text_of(record, "id"), text_of(finding, "rule"));
                let uri = if name == "<stdin>" { "%3Cstdin%3E" } else { &name };
                let want = json!({
                    "ruleId": rule,
                    "level": level(text_of(finding, "severity")),
                    "message": { "text": format!("{id}: {}", text_of(finding, "what")) },
                    "locations": [{
                        "physicalLocation": { "artifactLocation": { "uri": uri }, "region": { "startLine": record["line"] } },
                        "logicalLocations": [{ "name": id, "kind": "record" }],
                    }],
                    "partialFingerprints": { "record/v1": format!("{id}/{place}/{rule}") },
                    "properties": { "size": finding["size"], "bound": finding["bound"] },
                });
                assert_eq!(results.next(), Some(&want));
            }
        }
        assert_eq!(results.next(), None, "every result is held");
        assert_eq!(run["properties"]["summary"], found["summary"]);
        let driver = &run["tool"]["driver"];
        assert_eq!(
            (&driver["version"], &driver["semanticVersion"]),
            (&json!(env!("CARGO_PKG_VERSION")), &json!(env!("CARGO_PKG_VERSION")))
        );
        for (told, rule) in array(&driver["rules"]).iter().zip(array(&rules["rules"])) {
            assert_eq!((&told["id"], &told["name"]), (&rule["name"], &rule["name"]));
            assert_eq!(told["defaultConfiguration"]["level"], level(text_of(rule, "severity")));
            let (help, law) = (text_of(rule, "help"), text_of(rule, "law"));
            assert_eq!(told["fullDescription"]["text"], help);
            assert_eq!(told["help"], json!({ "text": format!("{help} Law: {law}."), "markdown": format!("{help}\n\n`{law}`") }));
            let first = text_of(&told["shortDescription"], "text");
            assert!(help.starts_with(first) && first.ends_with('.'), "{first}");
        }
        assert_eq!(array(&driver["rules"]).len(), array(&rules["rules"]).len());
    }
}
