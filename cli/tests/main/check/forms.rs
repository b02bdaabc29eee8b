//! Every record in each file format: JSON document, JSON Lines and CSV.

use std::fs;

use serde_json::Value;

use super::{HEADER, check, check_file, document, lines, records, rules, sound};
use crate::process::{planar_impact, run_with_input, workspace};

/// Returns the records of an independent solver, each with the rule that must be found broken, if any.
fn reference() -> Vec<(Option<String>, Value)> {
    let text = fs::read_to_string(workspace().join("cli/tests/reference/records.jsonl")).expect("the records are there");
    let read = |line: &str| {
        let mut line: Value = serde_json::from_str(line).expect("JSON");
        (line["expected"].as_str().map(str::to_owned), line["record"].take())
    };
    text.lines().map(read).collect()
}

/// Returns the cells of a record, with the names of their columns and their units.
fn cells(record: &Value) -> Vec<(String, &'static str, String)> {
    let mut found = Vec::new();
    let mut add = |name: String, unit: &'static str, value: &Value| match value {
        Value::String(text) => found.push((name, unit, text.clone())),
        Value::Null => (),
        other => found.push((name, unit, other.to_string())),
    };
    for (key, unit) in [("id", ""), ("profile", ""), ("note", "")] {
        add(key.to_owned(), unit, &record[key]);
    }
    if record["group"].is_object() {
        add("group".to_owned(), "", &record["group"]["name"]);
        add("group.agreement".to_owned(), "", &record["group"]["agreement"]);
    } else {
        add("group".to_owned(), "", &record["group"]);
    }
    for (body, i) in record["bodies"].as_array().into_iter().flatten().zip(1..) {
        for (key, unit) in [("fixed", ""), ("mass", "kg"), ("yaw_inertia", "kg m^2"), ("heading", "deg")] {
            add(format!("b{i}.{key}"), unit, &body[key]);
        }
        for (k, axis) in ["x", "y"].iter().enumerate() {
            add(format!("b{i}.cg{axis}"), "m", &body["cg"][k]);
            for when in ["before", "after"] {
                add(format!("b{i}.{when}.v{axis}"), "m/s", &body[when]["v"][k]);
            }
        }
        for when in ["before", "after"] {
            add(format!("b{i}.{when}.yaw_rate"), "deg/s", &body[when]["yaw_rate"]);
        }
    }
    let contact = &record["contact"];
    for (name, value, unit) in
        [("px", &contact["point"][0], "m"), ("py", &contact["point"][1], "m"), ("normal_angle", &contact["normal_angle"], "deg")]
    {
        add(format!("contact.{name}"), unit, value);
    }
    for key in ["restitution", "impulse_ratio", "ratio_kind", "law"] {
        add(format!("model.{key}"), "", &record["model"][key]);
    }
    let reported = &record["reported"];
    for key in ["energy_loss", "work_normal", "work_tangential"] {
        add(format!("reported.{key}"), "J", &reported[key]);
    }
    for i in [0, 1] {
        add(format!("reported.delta_v.{}", i + 1), "m/s", &reported["delta_v"][i]);
    }
    for key in ["normal", "tangential", "x", "y", "magnitude"] {
        add(format!("reported.impulse.{key}"), "N s", &reported["impulse"][key]);
    }
    for (key, unit) in [("closing_speed", "m/s"), ("separation_speed", "m/s"), ("impulse_ratio", "")] {
        add(format!("reported.{key}"), unit, &reported[key]);
    }
    for (key, unit) in [("v", "m/s"), ("yaw_rate", "deg/s"), ("energy", "J"), ("impulse", "N s"), ("impulse_ratio", ""), ("length", "m")] {
        add(format!("resolution.{key}"), unit, &record["resolution"][key]);
    }
    found
}

/// Formats records as CSV.
fn table(all: &[Value]) -> String {
    let rows: Vec<_> = all.iter().map(cells).collect();
    let mut columns: Vec<(String, &'static str)> = Vec::new();
    for (name, unit, _) in rows.iter().flatten() {
        if !columns.iter().any(|(known, _)| known == name) {
            columns.push((name.clone(), unit));
        }
    }
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let quoted = |text: &str| if text.contains(',') { format!("\"{text}\"") } else { text.to_owned() };
    let mut text = line(columns.iter().map(|(name, _)| name.clone()).collect());
    text += &line(columns.iter().map(|(_, unit)| (*unit).to_owned()).collect());
    for row in rows {
        let cell = |name: &String| row.iter().find(|(known, ..)| known == name).map_or(String::new(), |(.., value)| quoted(value));
        text += &line(columns.iter().map(|(name, _)| cell(name)).collect());
    }
    text
}

#[test]
fn an_independent_solver_s_results_pass_and_each_corruption_is_found_by_name() {
    let reference = reference();
    assert!(reference.iter().filter(|(expected, _)| expected.is_none()).count() >= 20 && reference.len() >= 70);
    let all: Vec<Value> = reference.iter().map(|(_, record)| record.clone()).collect();
    let texts: Vec<String> = all.iter().map(Value::to_string).collect();
    let forms = [("lines", lines(&texts)), ("document", document(&texts)), ("table", table(&all))];
    let mut reports = Vec::new();
    for (form, text) in forms {
        let (status, report) = check(&text, &[]);
        assert_eq!((status, records(&report).len()), (1, all.len()), "{form}");
        for ((expected, given), record) in reference.iter().zip(records(&report)) {
            assert_eq!(record["id"], given["id"], "{form}");
            let (failed, warned) = (rules(record, "fail"), rules(record, "warn"));
            match expected.as_deref() {
                None => assert!(failed.is_empty() && record["verdict"] != "fail", "{form}: {record}"),
                Some("plausible-units") => assert!(warned.contains(&"plausible-units"), "{form}: {record}"),
                Some(rule) => assert!(failed.contains(&rule), "{form}: {rule} is not in {record}"),
            }
        }
        // Apart from the positions of records, every format has the same findings.
        let mut told = records(&report).clone();
        told.iter_mut().for_each(|record| record["line"] = Value::Null);
        reports.push(told);
    }
    assert_eq!(reports[0], reports[1]);
    assert_eq!(reports[0], reports[2]);
}

#[test]
fn the_form_is_told_by_the_text_where_the_name_does_not() {
    let record = sound("a", ("", ""));
    let table = "id,b1.mass\n,kg\na,1000\n".to_owned();
    let minified = document(std::slice::from_ref(&record)).replace('\n', " ");
    for text in [lines(std::slice::from_ref(&record)), document(&[record]), minified, table] {
        for name in ["records", "records.txt", "records.json5", "a b.data"] {
            let run = check_file(name, text.as_bytes(), &[]);
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{name}: {text}");
        }
        // A byte order mark, leading blank lines, and Windows line ends.
        let windows = format!("\u{feff}\r\n\r\n{}", text.replace('\n', "\r\n"));
        assert_eq!(run_with_input(&["check", "-"], &windows).status, 0, "{windows:?}");
    }
}

/// As a spreadsheet exports a table: each line with the commas of the widest one, and empty rows below.
#[test]
fn a_table_that_a_spreadsheet_pads_is_read() {
    let padded = "# planar-impact-record/1,,,\nid,b1.mass,,\n,kg,,\na,1000,,\n,,,\nb,1100,,\n,,,\n,,,\n";
    let run = check_file("padded.csv", padded.as_bytes(), &[]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    assert!(run.out.starts_with("2 records:"), "{}", run.out);
    let stray = check_file("stray.csv", padded.replace("b,1100,,", "b,1100,,x").as_bytes(), &[]);
    assert!(stray.status != 0 && (stray.out + &stray.err).contains("`x` stands in a column without a name"));
    let nameless = check_file("nameless.csv", padded.replace(",kg,,", ",kg,m,").as_bytes(), &[]);
    assert!(nameless.status == 2 && nameless.err.contains("the column of the unit `m` has no name"), "{}", nameless.err);
}

#[test]
fn a_document_may_have_its_header_behind_its_records() {
    let text = format!("{{\"records\": [{}], \"tool\": {{\"name\": \"x\"}}, {HEADER}}}", sound("a", ("", "")));
    assert_eq!(check(&text, &[]).0, 0);
    assert_eq!(check_file("late.json", text.as_bytes(), &[]).status, 0);
}

#[test]
fn lines_are_told_in_every_form() {
    let wrong = |id: &str| sound(id, ("{\"v\": [1, 0]}", "{\"v\": [2, 0]}"));
    let good = || sound("g", ("", ""));
    let at = |text: &str, name: &str| -> Vec<u64> {
        let run = check_file(name, text.as_bytes(), &["--format", "json"]);
        let report: Value = serde_json::from_str(&run.out).expect("JSON");
        records(&report).iter().map(|record| record["line"].as_u64().expect("a number")).collect()
    };
    assert_eq!(at(&lines(&[good(), String::new(), wrong("b")]), "a.jsonl"), [2, 4]);
    assert_eq!(at(&document(&[good(), super::SOUND.replace("ID", "x"), wrong("c")]), "a.json"), [4, 5, 8]);
    assert_eq!(at("# planar-impact-record/1\nid,b1.mass\n,kg\n\na,1\n# not a comment here\nb,2\n", "a.csv"), [5, 6, 7]);
}

#[test]
fn a_pipe_that_is_no_file_can_be_read() {
    // A document from a pipe cannot be read twice.
    let many: Vec<String> = (0..2000).map(|id| sound(&id.to_string(), ("", ""))).collect();
    for text in [lines(&many), document(&many)] {
        let run = run_with_input(&["check", "-"], &text);
        assert_eq!(run.out, "2000 records: 2000 pass, 0 warn, 0 fail, 0 undecidable\n");
    }
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    // Larger than the buffer of any pipe.
    let many: Vec<String> = (0..3000).map(|id| sound(&id.to_string(), ("{\"v\": [1, 0]}", "{\"v\": [2, 0]}"))).collect();
    let folder = crate::process::Folder::new();
    folder.write("many.jsonl", lines(&many).as_bytes());
    let mut child = planar_impact(folder.path())
        .args(["check", "many.jsonl"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!((output.stderr.as_slice(), output.status.code()), (&b""[..], Some(1)));
}

/// Ratios have no unit, and so a line of units without any.
#[test]
fn a_table_of_ratios_needs_no_units() {
    let text = "id,model.restitution,reported.impulse_ratio,reported.critical_impulse_ratio\n,,,\na,0.1,0.2,0.3\nb,0.1,0.4,0.3\n";
    let run = check_file("a.csv", text.as_bytes(), &["--format", "json"]);
    let report: Value = serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err));
    let verdicts: Vec<&str> = records(&report).iter().map(|record| record["verdict"].as_str().expect("a verdict")).collect();
    assert_eq!((run.status, verdicts), (1, vec!["pass", "fail"]));
}
