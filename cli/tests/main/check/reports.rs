//! The report formats.

use quick_xml::Reader;
use quick_xml::events::Event;
use serde_json::Value;

use super::{check, check_file, lines, sound};
use crate::process::{run, run_with_input, workspace};

/// Returns records that fail, warn, are undecidable, unreadable and pass; the names are hostile.
fn mixed() -> String {
    lines(&[
        sound("f <&>\\\"'", ("{\"v\": [1, 0]}", "{\"v\": [2, 0]}")),
        sound("w", ("\"mass\": 2000", "\"yaw_inertia\": 1, \"mass\": 2000")),
        sound("u", ("\"bodies\"", "\"resolution\": {\"v\": 9}, \"bodies\"")),
        "{\"id\": \"m\\u001b[31m\", \"bodie\": 1}".to_owned(),
        sound("p", ("", "")),
    ])
}

#[test]
fn json_has_the_documented_keys() {
    let (status, report) = check(&mixed(), &[]);
    assert_eq!((status, &report["schema"]), (1, &Value::from(1)));
    assert_eq!(report["summary"], serde_json::json!({"records": 5, "pass": 1, "warn": 1, "fail": 2, "undecidable": 1}));
    let verdicts: Vec<&str> = report["records"].as_array().expect("records").iter().map(|r| r["verdict"].as_str().expect("one")).collect();
    assert_eq!(verdicts, ["fail", "warn", "undecidable", "fail", "pass"]);
    for record in report["records"].as_array().expect("records") {
        assert!(record["id"].is_string() && record["not_checked"].is_array(), "{record}");
        for finding in record["findings"].as_array().expect("findings") {
            assert!(finding["rule"].is_string() && finding["what"].is_string(), "{finding}");
            assert!(["fail", "warn", "undecidable"].contains(&finding["severity"].as_str().expect("one")));
            let has_numbers = finding["size"].is_f64() && finding["bound"].is_f64();
            assert!(has_numbers || finding["rule"] == "malformed", "{finding}");
        }
    }
    let first = &report["records"][0]["findings"][0];
    // Excess momentum relative to the velocities in the record: 2000 × 3 − 1000 × 4.
    assert_eq!((&first["rule"], first["size"].as_f64()), (&Value::from("linear-momentum"), Some(2000.0)));
}

#[test]
fn text_fits_a_terminal_and_tells_what_does_not_pass() {
    let run = run_with_input(&["check", "-"], &mixed());
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    assert!(run.out.lines().all(|line| line.chars().count() <= 80 && line.trim_end() == line), "{}", run.out);
    assert!(!run.out.contains('\u{1b}'), "{}", run.out);
    for line in ["FAIL: f <&>\"', <stdin> line 2", "WARN: w, <stdin> line 3", "UNDECIDABLE: u, <stdin> line 4"] {
        assert!(run.out.lines().any(|other| other == line), "{line}: {}", run.out);
    }
    assert!(run.out.contains("\n5 records: 1 pass, 1 warn, 2 fail, 1 undecidable\n"), "{}", run.out);
    let flat = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in
        ["2000 N s appear", "malformed: unknown key `bodie`; did you mean `bodies`?", "radius of gyration", "the resolutions leave room"]
    {
        assert!(flat.contains(words), "{words}: {flat}");
    }
    assert!(!flat.contains("p, <stdin>"));
}

#[test]
fn many_records_that_pass_are_one_line() {
    let many: Vec<String> = (0..20_000).map(|id| sound(&id.to_string(), ("", ""))).collect();
    let run = check_file("many.jsonl", lines(&many).as_bytes(), &[]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    assert_eq!(run.out, "20000 records: 20000 pass, 0 warn, 0 fail, 0 undecidable\n");
}

/// The attributes of an element, by name.
type Attributes = Vec<(String, String)>;

/// Returns the depth, the name and the attributes of each element, in order.
fn elements(xml: &str) -> Vec<(usize, String, Attributes)> {
    let mut reader = Reader::from_str(xml);
    let (mut depth, mut found) = (0, Vec::new());
    loop {
        match reader.read_event().unwrap_or_else(|error| panic!("{error}: {xml}")) {
            Event::Start(tag) => {
                found.push((depth, tag.name().as_ref().to_owned(), attributes(&tag)));
                depth += 1;
            }
            Event::Empty(tag) => found.push((depth, tag.name().as_ref().to_owned(), attributes(&tag))),
            Event::End(_) => depth -= 1,
            Event::Eof => return found,
            _ => (),
        }
    }
}

fn attributes(tag: &quick_xml::events::BytesStart<'_>) -> Attributes {
    let read = tag.attributes().map(|attribute| attribute.expect("well formed"));
    read.map(|attribute| {
        let value = quick_xml::escape::unescape(&attribute.value).expect("well formed").into_owned();
        (attribute.key.as_ref().to_owned(), value)
    })
    .collect()
}

fn attribute<'a>(attributes: &'a [(String, String)], name: &str) -> &'a str {
    attributes.iter().find(|(known, _)| known == name).map_or("", |(_, value)| value)
}

#[test]
fn junit_has_a_case_for_each_record() {
    for (arguments, failures) in [(&[][..], 2), (&["--fail-on", "undecidable"], 3), (&["--fail-on", "warn"], 4)] {
        let run = run_with_input(&[&["check", "-", "--format", "junit"], arguments].concat(), &mixed());
        assert_eq!((run.status, run.err.as_str()), (1, ""));
        let all = elements(&run.out);
        assert_eq!((all[0].1.as_str(), all[1].1.as_str(), all[1].0), ("testsuites", "testsuite", 1));
        let cases: Vec<_> = all.iter().filter(|element| element.1 == "testcase").collect();
        assert_eq!(cases.len(), 5);
        assert_eq!(attribute(&cases[0].2, "name"), "f <&>\"'");
        assert_eq!((attribute(&cases[0].2, "classname"), attribute(&cases[0].2, "line")), ("<stdin>", "2"));
        let failed: Vec<_> = all.iter().filter(|element| element.1 == "failure").map(|element| attribute(&element.2, "type")).collect();
        assert_eq!(failed.len(), failures, "{failed:?}");
        assert!(failed.contains(&"linear-momentum") && failed.contains(&"malformed"));
        let skipped = all.iter().filter(|element| element.1 == "skipped").count();
        assert_eq!(skipped, usize::from(arguments.is_empty()));
        assert!(!run.out.contains('\u{1b}'));
    }
}

#[test]
fn sarif_has_a_result_for_each_finding_at_its_line() {
    let run = check_file("my records.jsonl", mixed().as_bytes(), &["--format", "sarif"]);
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    let log: Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    let rules: Vec<&str> =
        run["tool"]["driver"]["rules"].as_array().expect("rules").iter().map(|rule| rule["id"].as_str().expect("one")).collect();
    assert_eq!(rules.len(), 15);
    for rule in run["tool"]["driver"]["rules"].as_array().expect("rules") {
        assert!(rule["help"]["text"].as_str().is_some_and(|help| help.len() > 40), "{rule}");
    }
    let results = run["results"].as_array().expect("results");
    let levels: Vec<(&str, &str)> =
        results.iter().map(|result| (result["ruleId"].as_str().expect("one"), result["level"].as_str().expect("one"))).collect();
    assert_eq!(levels, [("linear-momentum", "error"), ("plausible-units", "warning"), ("linear-momentum", "note"), ("malformed", "error")]);
    for (result, line) in results.iter().zip(2..) {
        assert!(rules.contains(&result["ruleId"].as_str().expect("one")));
        let place = &result["locations"][0]["physicalLocation"];
        assert_eq!(
            (&place["artifactLocation"]["uri"], &place["region"]["startLine"]),
            (&Value::from("my%20records.jsonl"), &Value::from(line))
        );
    }
    let fingerprints: std::collections::HashSet<String> = results.iter().map(|result| result["partialFingerprints"].to_string()).collect();
    assert_eq!(fingerprints.len(), results.len());
}

#[test]
fn nothing_found_is_a_whole_report_too() {
    let good = lines(&[sound("p", ("", ""))]);
    let xml = run_with_input(&["check", "-", "--format", "junit"], &good);
    assert_eq!((xml.status, elements(&xml.out).len()), (0, 3));
    let sarif = run_with_input(&["check", "-", "--format", "sarif"], &good);
    let log: Value = serde_json::from_str(&sarif.out).expect("JSON");
    assert_eq!((sarif.status, &log["runs"][0]["results"]), (0, &Value::Array(Vec::new())));
}

#[test]
fn the_rules_are_told() {
    for idle in [&["--tolerance", "0.1"], &["--fail-on", "warn"]] {
        let refused = run(&workspace(), &["check", "--rules", idle[0], idle[1]]);
        assert!(refused.status == 2 && refused.err.contains(idle[0]), "{}", refused.err);
    }
    let text = run(&workspace(), &["check", "--rules"]);
    assert_eq!((text.status, text.err.as_str()), (0, ""));
    assert!(text.out.lines().all(|line| line.chars().count() <= 80));
    let json = run(&workspace(), &["check", "--rules", "--format", "json"]);
    let list: Value = serde_json::from_str(&json.out).expect("JSON");
    // The names are fixed, because other programs rely on them.
    let names = [
        "finite",
        "plausible-units",
        "linear-momentum",
        "angular-momentum",
        "line-of-action",
        "energy-gain",
        "compressive",
        "interpenetration",
        "restitution",
        "impulse-ratio",
        "beyond-critical",
        "work-identity",
        "reported",
        "group",
        "malformed",
    ];
    let told: Vec<&str> = list["rules"].as_array().expect("rules").iter().map(|rule| rule["name"].as_str().expect("one")).collect();
    assert_eq!(told, names);
    for rule in list["rules"].as_array().expect("rules") {
        assert!(text.out.contains(&format!("\n{} ({}): ", rule["name"].as_str().expect("one"), rule["severity"].as_str().expect("one"))));
        assert!(rule["help"].is_string() && rule["law"].is_string());
    }
    for format in ["junit", "sarif"] {
        let refused = run(&workspace(), &["check", "--rules", "--format", format]);
        assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    }
}
