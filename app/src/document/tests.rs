//! Reads whole files from text to values, and checks the issues shown.

use super::*;
use crate::quantity::{Kind, Quantity};

#[derive(Debug, PartialEq)]
struct Case {
    title: Option<String>,
    masses: Vec<f64>,
    point: [f64; 2],
    restitution: f64,
    runs: i64,
}

fn walk(root: &Table<'_>) -> Option<Case> {
    let title = root.optional("title").string().map(str::to_owned);
    let vehicles = root.required("vehicle").array_of_tables();
    let masses: Option<Vec<f64>> = vehicles.map(|vehicles| {
        let mass = |vehicle: &Table<'_>| {
            let mass = vehicle.required("mass").quantity(Kind::MASS);
            vehicle.optional("yaw").quantity(Kind::ANGLE);
            vehicle.finish();
            mass.map_or(0.0, |mass| mass.si)
        };
        vehicles.iter().map(mass).collect()
    });
    let impact = root.required("impact").table();
    let (point, restitution, runs) = impact.map_or((None, None, None), |impact| {
        let point = impact.required("point").pair(Kind::LENGTH);
        let restitution = impact.required("restitution").quantity(Kind::PURE).map(|quantity| quantity.si);
        let runs = impact.required("runs").integer(1..=100);
        impact.finish();
        (point, restitution, runs)
    });
    let si = |pair: [Quantity; 2]| pair.map(|quantity| quantity.si);
    Some(Case { title, masses: masses?, point: si(point?), restitution: restitution?, runs: runs? })
}

/// Formats each issue on its own line: the line in the file, the path, the message and the help.
fn shown(issues: &Issues) -> String {
    let one = |issue: &Issue| {
        let line = issues.line(issue).map_or(String::new(), |line| format!("{line} "));
        let help = issue.help.as_ref().map_or(String::new(), |help| format!(" ({help})"));
        format!("{line}{}: {}{help}", issue.path, issue.message)
    };
    issues.list().iter().map(one).collect::<Vec<_>>().join("\n")
}

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text)
}

fn read(name: &str, text: &str) -> Result<Case, String> {
    Document::parse(source(name, text)).and_then(|document| document.read(walk)).map_err(|issues| shown(&issues))
}

const GOOD: &str = r#"
title = "Case 1"
[[vehicle]]
mass = "1 lb"
[[vehicle]]
mass = 1_500
yaw = "-10 deg"
[impact]
point = ["1 ft", 2.0]
restitution = 0.3
runs = 7
"#;

fn good() -> Case {
    Case {
        title: Some("Case 1".to_owned()),
        masses: vec![0.453_592_37, 1500.0], // the international pound
        point: [0.3048, 2.0],               // the international foot
        restitution: 0.3,
        runs: 7,
    }
}

#[test]
fn a_good_file_in_both_formats() {
    assert_eq!(read("case.toml", GOOD), Ok(good()));
    assert_eq!(read("case.toml", &GOOD.replace('\n', "\r\n")), Ok(good()));
    let json = r#" {"title": "Case 1",
        "vehicle": [{"mass": "1 lb"}, {"mass": 1500, "yaw": "-10 deg"}],
        "impact": {"point": ["1 ft", 2.0], "restitution": 0.3, "runs": 7}}"#;
    for name in ["case.json", "CASE.JSON", "<stdin>", "case.txt"] {
        assert_eq!(read(name, json), Ok(good()));
    }
    let [in_toml, in_json] = [("case.toml", json), ("case.json", GOOD)].map(|(name, text)| read(name, text).unwrap_err());
    assert!(in_toml.contains("this is not TOML, as its name says, but JSON") && in_toml.contains("end in .json"), "{in_toml}");
    assert!(in_json.contains("this is not JSON, as its name says, but TOML") && in_json.contains("end in .toml"), "{in_json}");
    assert!(read("case.json", "a = \"1").unwrap_err().contains("this is not JSON: "));
}

#[test]
fn a_table_is_one_issue_and_not_one_of_each_line() {
    let said = read("speeds.CSV", "a,b\n1,2\n3,4\n").unwrap_err();
    assert!(said.contains("`speeds.CSV` is a table, where a TOML or JSON file is expected") && said.lines().count() == 1, "{said}");
    assert!(said.contains("`batch` solves tables, `check` reads records, and `record` recordings"), "{said}");
    assert!(read("speeds.txt", "a,b\n1,2\n3,4\n").unwrap_err().contains("this is not TOML"));
}

#[test]
fn everything_wrong_is_reported_at_once_in_file_order() {
    let text = r#"colour = 1
[[vehicle]]
mas = "1500 kg"
[[vehicle]]
mass = "40 ft"
yaw = 180
[impact]
point = ["1 ft", nan, 3]
restitution = 0x10
runs = 1e3
"#;
    let expected = r#"1 colour: unknown key (the keys known here are title, vehicle, impact, $schema)
2 vehicle.1.mass: missing (expected a mass, such as "1500 kg")
3 vehicle.1.mas: unknown key (did you mean `mass`?)
5 vehicle.2.mass: `40 ft` is a length; a mass is expected, such as "1500 kg"
6 vehicle.2.yaw: a number without a unit is taken in rad, and 180 rad is 28.6 turns (did you mean "180 deg"? If not, write "180 rad")
8 impact.point: expected an array of two values, each a length, such as "1.5 m"; found 3 values
9 impact.restitution: expected a pure number, such as "0.3"; found a hexadecimal number, `0x10`
10 impact.runs: expected a whole number from 1 to 100, found `1e3`"#;
    assert_eq!(read("case.toml", text).unwrap_err(), expected);
}

#[test]
fn a_key_beside_the_one_that_is_meant() {
    let wrong = read("case.toml", "title = \"x\"\n[[vehicle]]\nmass = \"1500 kg\"\n[[vehicles]]\nmass = \"1500 kg\"\n").unwrap_err();
    assert!(wrong.contains("4 vehicles: unknown key (did you mean `vehicle`, which is here too?)"), "{wrong}");
}

#[test]
fn missing_tables_and_wrong_sorts() {
    assert_eq!(
        read("case.toml", "[vehicle]\nmass = 1\n").unwrap_err(),
        "impact: missing (expected a table)\n\
         1 vehicle: expected an array of tables; found a table (begin each table with [[vehicle]] in TOML, or list them in [ ] in JSON)"
    );
    assert_eq!(read("case.json", "{\"vehicle\": [],\n \"impact\": null}").unwrap_err(), "2 impact: expected a table; found null");
    assert!(read("case.json", "[1]").unwrap_err().starts_with("1 : expected an object, found an array"));
}

#[test]
fn numbers_that_floats_cannot_hold() {
    for (text, message) in [
        ("nan", "`nan` is not a finite number"),
        ("-inf", "`-inf` is not a finite number"),
        ("1e999", "`1e999` is too large for a 64-bit floating-point number"),
        ("1e-400", "`1e-400` is too small: a 64-bit floating-point number would make it zero"),
    ] {
        let shown = read("case.toml", &GOOD.replace("0.3\n", &format!("{text}\n"))).unwrap_err();
        assert_eq!(shown, format!("10 impact.restitution: {message}"));
    }
}

#[test]
fn each_item_of_a_list_reports_its_own_issue() {
    let document = Document::parse(source("a.toml", "a = [\"1 m\", \"2\", 1e999]\nb = \"no\"")).unwrap();
    let issues = document
        .read(|root| {
            for item in root.required("a").items("an array of lengths", 2..=usize::MAX).into_iter().flatten() {
                item.quantity(Kind::LENGTH);
            }
            root.required("b").choice(&["none", "linear"]);
            Some(())
        })
        .unwrap_err();
    let keys: Vec<&str> = issues.list().iter().map(|issue| issue.path.as_str()).collect();
    assert_eq!(keys, ["a.2", "a.3", "b"]);
    assert_eq!(issues.list()[2].message.to_string(), "expected one of \"none\", \"linear\", found `no`");
}

#[test]
fn later_issues_find_their_place() {
    let document = Document::parse(source("case.toml", GOOD)).unwrap();
    let text = |key: &str| document.place(Issue::at("invalid", key, "")).span.map(|span| &GOOD[span]);
    assert_eq!(text("vehicle.2.mass"), Some("1_500"));
    assert_eq!(text("impact.point.2"), Some("2.0"));
    assert_eq!(text("impact.friction"), Some("[impact]")); // the table it is missing from
    assert_eq!(text("vehicle.3.mass"), Some("[[vehicle]]"));
    assert_eq!(text("crush"), None);
}

#[test]
fn a_walk_without_a_reason_still_fails() {
    let document = Document::parse(source("a.toml", "a = 1")).unwrap();
    let given_up = document.read(|root| root.has("a").then_some(()).and(None::<()>)).unwrap_err();
    assert_eq!(given_up.to_string(), "`a.toml` is incomplete");
}
