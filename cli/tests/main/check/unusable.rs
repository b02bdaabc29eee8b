//! Files that cannot be used, and records that cannot be read.

use std::fs;

use super::{HEADER, check, check_file, document, lines, records, rules, sound};
use crate::process::{Folder, run, run_with_input, workspace};

/// Checks that a run is refused: status 2, nothing on standard output, and the words on standard error.
#[track_caller]
fn refused(name: &str, text: &[u8], words: &[&str]) {
    let run = check_file(name, text, &[]);
    assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
    let flat = run.err.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.iter().all(|word| flat.contains(word)) && flat.contains(&format!("`{name}`")), "{words:?}: {flat}");
    for format in ["json", "junit", "sarif"] {
        let other = check_file(name, text, &["--format", format]);
        assert_eq!((other.status, other.out.as_str(), &other.err), (2, "", &run.err), "{format}");
    }
    // The same from a pipe.
    if let Ok(text) = str::from_utf8(text) {
        let piped = run_with_input(&["check", "-"], text);
        assert_eq!((piped.status, piped.out.as_str()), (2, ""), "{}", piped.err);
    }
}

#[test]
fn files() {
    refused("a.jsonl", b"", &["it is empty"]);
    refused("a.csv", b" \r\n\t\n", &["it is empty"]);
    refused("a.json", b"\xef\xbb\xbf\n", &["it is empty"]);
    refused("a.json", b"\xff\xfe{\0", &["UTF-16"]);
    let unit = "b1.before.vx [m/s]`; units stand in a line of their own, below the names";
    refused("a.csv", b"id,b1.before.vx [m/s]\n,m/s\na,1\n", &[unit]);
    refused("a.csv", b"id,b1.before.vx\n,[m/s]\na,1\n", &["write it without brackets: `m/s`"]);
    refused("a.csv", b"i\0d\0", &["it is UTF-16; save it as UTF-8"]);
    refused("a.csv", b"sep=,\nid,e\n,\n1,0.1\n", &["line 1: the first line must name the columns, and is `sep=`; remove it"]);
    refused("a.json", b"{\"schema\": \"\xff\"}", &["not"]);
    refused("a.jsonl", b"{\"schema\": \"\xff\"}\n", &["not UTF-8"]);
    refused("a.csv", b"id,b1.m\xffss\n", &["not UTF-8"]);
    let run = run(&workspace(), &["check", "no such file.json", "/", "cli/examples/check/collision.json"]);
    assert_eq!((run.status, run.out.as_str()), (2, ""));
    assert!(run.err.contains("`no such file.json`: it cannot be read: there is no such file"), "{}", run.err);
    assert!(run.err.contains("`/`: it is a directory"), "{}", run.err);
}

#[test]
fn one_file_that_cannot_be_used_spoils_the_run() {
    let folder = Folder::new();
    folder.write("good.jsonl", lines(&[sound("a", ("", ""))]).as_bytes());
    folder.write("bad.jsonl", b"{}\n{}\n");
    for files in [["good.jsonl", "bad.jsonl"], ["bad.jsonl", "good.jsonl"]] {
        let run = run(folder.path(), &["check", files[0], files[1]]);
        assert_eq!((run.status, run.out.as_str()), (2, ""));
        assert!(run.err.contains("`bad.jsonl`, line 1: `schema` is missing"), "{}", run.err);
    }
}

#[test]
fn headers() {
    let record = sound("a", ("", ""));
    let both = |header: &str, words: &[&str]| {
        refused("a.jsonl", format!("{{{header}}}\n{record}\n").as_bytes(), words);
        refused("a.json", format!("{{{header}, \"records\": [{record}]}}").as_bytes(), words);
    };
    both(&HEADER.replace("record/1", "record/2"), &["version 2", "reads version 1"]);
    both(&HEADER.replace("planar-impact-record/1", "something"), &["expected \"planar-impact-record/1\", found `something`"]);
    both(&HEADER.replace("schema", "Schema"), &["unknown key `Schema`; did you mean `schema`?", "`schema` is missing"]);
    both(&HEADER.replace("\"planar-impact-record/1\"", "1"), &["found a number"]);
    both("\"schema\": \"planar-impact-record/1\"", &["`units` is missing"]);
    both(&HEADER.replace("\"angle\": \"deg\"", "\"angel\": \"deg\""), &["did you mean `angle`?", "`angle` is missing"]);
    both(&HEADER.replace("\"deg\"", "\"gradians\""), &["units.angle: unknown unit `gradians`"]);
    both(&HEADER.replace("\"kg\"", "\"m\""), &["units.mass: `m` is a length"]);
    both(&HEADER.replace("\"kg\"", "1"), &["expected the name of a unit; found a number"]);
    both(&format!("{HEADER}, \"tools\": 1"), &["did you mean `tool`?"]);
    both(&format!("{HEADER}, \"tool\": {{\"nam\": 1}}"), &["unknown key `nam`"]);
    both(&format!("{HEADER}, {HEADER}"), &["stands twice"]);
    refused("a.jsonl", format!("{record}\n{record}\n").as_bytes(), &["this one looks like a record"]);
    refused("a.jsonl", format!("[{{{HEADER}}}]\n{record}\n").as_bytes(), &["the first line is the header", "found an array"]);
    refused("a.jsonl", format!("{{{HEADER}}}\n\n").as_bytes(), &["no records"]);
    refused("a.jsonl", format!("{{{HEADER},}}\n{record}\n").as_bytes(), &["trailing commas"]);
}

#[test]
fn documents() {
    let record = sound("a", ("", ""));
    let whole = document(std::slice::from_ref(&record));
    refused("a.json", whole.trim_end().trim_end_matches('}').as_bytes(), &["not a JSON document"]);
    // An error after many valid records.
    let many: Vec<String> = (0..500).map(|id| sound(&id.to_string(), ("[3, 0]", "[4, 0]"))).collect();
    refused("a.json", document(&many).replace("]\n}\n", ",]\n}\n").as_bytes(), &["line 50", "no comma behind the last"]);
    refused("a.json", format!("{whole}x").as_bytes(), &["trailing characters"]);
    refused("a.json", format!("{{{HEADER}, \"records\": []}}").as_bytes(), &["there are no records"]);
    refused("a.json", format!("{{{HEADER}, \"records\": {record}}}").as_bytes(), &["an array of records"]);
    refused("a.json", format!("[{record}]").as_bytes(), &["an object of `schema`, `units` and `records`"]);
    refused("a.json", whole.replace("[3, 0]", "[NaN, 0]").as_bytes(), &["no NaN"]);
    refused("a.json", whole.replace("[3, 0]", "[3, /* x */ 0]").as_bytes(), &["no comments"]);
    refused("a.json", whole.replace("[3, 0]", "[3 0]").as_bytes(), &["not a JSON document"]);
    refused("a.json", b"schema = 1\n", &["not a JSON document"]);
    let deep = whole.replace("[3, 0]", &("[".repeat(100_000) + &"]".repeat(100_000)));
    let (status, report) = check(&deep, &[]);
    assert_eq!((status, rules(&records(&report)[0], "fail")), (1, vec!["malformed"]));
}

#[test]
fn tables() {
    refused("a.csv", b"id,b1.mass\n", &["the line of units and the records are missing"]);
    refused("a.csv", b"id,b1.mass\n,kg\n", &["no records"]);
    refused("a.csv", b"id,b1.mass\na,1000\n", &["the line of units is missing"]);
    refused("a.csv", b"id,b1.mass\na,1000\nb,1000\n", &["the line of units is missing"]);
    refused("a.csv", b"b1.mass\nkg\n1\n", &["the column `id` is missing"]);
    refused("a.csv", b"id,b1.mas\n,kg\na,1\n", &["unknown column `b1.mas`; did you mean `b1.mass`?"]);
    let many = format!("id,{}\n{}\na\n", (0..40).map(|i| format!("x{i}")).collect::<Vec<_>>().join(","), ",".repeat(40));
    refused("a.csv", many.as_bytes(), &["unknown column `x0`", "unknown column `x19`", "there are 20 more problems"]);
    refused("a.csv", b"id,B1.Mass\n,kg\na,1\n", &["unknown column `B1.Mass`; did you mean `b1.mass`?"]);
    refused("a.csv", b"id,b1.mass,b1.mass\n,kg,kg\na,1,1\n", &["stands twice"]);
    refused("a.csv", b"id,b1.mass\n,m\na,1\n", &["b1.mass: `m` is a length"]);
    refused("a.csv", b"id,b1.mass,b2.mass\n,kg,\na,1,1\n", &["b2.mass: the unit of a mass is missing"]);
    refused("a.csv", b"id,b1.mass\n,kg,kg\na,1\n", &["3 fields and that of columns 2"]);
    refused("a.csv", b"id,b1.mass\nkg,kg\na,1\n", &["id: it is a text and has no unit"]);
    refused("a.csv", b"id;b1.mass\n;kg\na;1,5\n", &["semicolons"]);
    refused("a.csv", b"id\tb1.mass\n\tkg\na\t1\n", &["tabs"]);
    refused("a.csv", b"# planar-impact-record/7\nid,b1.mass\n,kg\na,1\n", &["version 7"]);
    refused("a.csv", b"id,\"b1.mass\n,kg\na,1\n", &["quotation mark has no partner"]);
    refused("a.txt", b"schema = 1\n[[vehicle]]\nmass = 1\n", &["unknown column `schema = 1`"]);
}

/// Checks that an unreadable record fails with its line and its reason, and that the other records are checked.
#[track_caller]
fn malformed(text: &str, line: u64, words: &[&str]) {
    let (status, report) = check(text, &[]);
    let all = records(&report);
    let bad: Vec<_> = all.iter().filter(|record| record["verdict"] == "fail").collect();
    assert_eq!((status, bad.len()), (1, 1), "{report}");
    assert!(all.len() >= 2 && all.iter().filter(|record| record["verdict"] != "fail").count() == all.len() - 1);
    assert_eq!(bad[0]["line"], line, "{report}");
    assert!(rules(bad[0], "fail").iter().all(|rule| *rule == "malformed"), "{report}");
    let told: String = bad[0]["findings"].as_array().expect("findings").iter().filter_map(|finding| finding["what"].as_str()).collect();
    assert!(words.iter().all(|word| told.contains(word)), "{words:?}: {told}");
}

#[test]
fn records_of_json() {
    let bad = |from: &str, to: &str, words: &[&str]| {
        let all = [sound("a", ("", "")), sound("b", (from, to)), sound("c", ("", ""))];
        malformed(&lines(&all), 3, words);
        malformed(&document(&all), 5, words);
    };
    bad("\"id\": \"ID\"", "\"Id\": \"ID\"", &["unknown key `Id`; did you mean `id`?", "`id` is missing"]);
    bad("\"id\": \"ID\"", "\"id\": \"\"", &["id: it is empty"]);
    bad("\"id\": \"ID\"", "\"id\": 7", &["id: expected a string, found a number"]);
    bad("\"mass\": 1000", "\"Mass\": 1000", &["b1: unknown key `Mass`; did you mean `mass`?"]);
    bad("\"mass\": 1000", "\"mass\": \"1000\"", &["b1.mass", "write it without quotes"]);
    bad("\"mass\": 1000", "\"mass\": \"1000 kg\"", &["b1.mass", "units are those of the header"]);
    bad("\"bodies\"", "\"resolution\": {\"v\": \"1%\"}, \"bodies\"", &["resolution.v", "an amount, not a percentage"]);
    bad("\"mass\": 1000", "\"mass\": \"1,5\"", &["b1.mass: expected a number, found the string `1,5`"]);
    bad("\"mass\": 1000", "\"mass\": true", &["b1.mass: expected a number, found a boolean"]);
    bad("\"mass\": 1000", "\"mass\": 1e-400", &["b1.mass", "would make it zero"]);
    bad("\"mass\": 1000", "\"mass\": 1000, \"mass\": 1000", &["the key `mass` stands twice"]);
    bad("\"mass\": 1000", "\"fixed\": true, \"mass\": 1000", &["b1: it is fixed and has a mass"]);
    bad("\"mass\": 1000", "\"fixed\": 1", &["b1.fixed: expected true or false"]);
    bad("{\"v\": [3, 0]}", "{\"v\": [3]}", &["`v` has two components"]);
    bad("{\"v\": [3, 0]}", "{\"v\": [3, null]}", &["b1.before.vy: missing, and the other component is there"]);
    bad("{\"v\": [3, 0]}", "{\"v\": 3}", &["`v` has two components", "found a number"]);
    bad("{\"v\": [3, 0]}", "[3, 0]", &["b1.before: expected an object, found an array"]);
    bad("{\"v\": [3, 0]}", "{\"vx\": 3}", &["b1.before: unknown key `vx`; did you mean `v`?"]);
    bad("\"bodies\"", "\"profile\": \"imulse\", \"bodies\"", &["did you mean \"impulse\"?"]);
    bad("\"bodies\"", "\"model\": {\"law\": \"newton\"}, \"bodies\"", &["expected one of \"brach\", \"kudlich-slibar\""]);
    bad("\"bodies\"", "\"model\": {\"ratio_kind\": \"crit\"}, \"bodies\"", &["model.ratio_kind"]);
    bad("\"bodies\"", "\"model\": [0.1, 0.2], \"bodies\"", &["model: expected an object, found an array"]);
    bad("\"bodies\"", "\"contact\": {\"normal\": 0}, \"bodies\"", &["contact: unknown key `normal`"]);
    bad("\"bodies\"", "\"reported\": {\"energy\": 0}, \"bodies\"", &["reported: unknown key `energy`"]);
    bad("\"bodies\"", "\"reported\": {\"delta_v\": 3}, \"bodies\"", &["one number or null for each of the two bodies"]);
    bad("\"bodies\"", "\"resolution\": {\"speed\": 3}, \"bodies\"", &["resolution: unknown key `speed`"]);
    bad("\"bodies\"", "\"resolution\": {\"b1.after.vz\": 3}, \"bodies\"", &["did you mean `b1.after.v"]);
    bad("\"bodies\"", "\"group\": {\"agreement\": \"loss\"}, \"bodies\"", &["there is no group"]);
    bad("\"bodies\"", "\"group\": {}, \"bodies\"", &["group: `name` is missing"]);
    bad("\"bodies\"", "\"group\": {\"name\": \"g\", \"agreement\": \"all\"}, \"bodies\"", &["group.agreement: expected one of"]);
    // One body, and three.
    bad("{\"mass\": 2000, \"before\": {\"v\": [-1, 0]}, \"after\": {\"v\": [1, 0]}}]", "{}, {}]", &["a collision has two bodies; found 3"]);
    let one = lines(&[sound("a", ("", "")), "{\"id\": \"b\", \"bodies\": [{\"mass\": 1}]}".to_owned()]);
    malformed(&one, 3, &["found 1 body"]);
    malformed(
        &lines(&[sound("a", ("", "")), "{\"id\": \"b\", \"bodies\": [{\"fixed\": true}, {\"fixed\": true}]}".to_owned()]),
        3,
        &["nothing can move"],
    );
    let twins = "{\"id\": \"b\", \"bodies\": [{\"id\": \"x\"}, {\"id\": \"x\"}]}".to_owned();
    malformed(&lines(&[sound("a", ("", "")), twins]), 3, &["both bodies have the same id"]);
}

#[test]
fn lines_that_are_no_records() {
    let good = sound("a", ("", ""));
    for (line, words) in [
        ("not JSON", "this is not JSON"),
        ("{\"id\": \"b\"", "this is not JSON"),
        ("{\"id\": \"b\"}}", "this is not JSON"),
        ("{\"id\": \"b\",}", "trailing commas"),
        ("{'id': 'b'}", "this is not JSON"),
        ("[\"b\", 1]", "a record is an object; found an array"),
        ("\"b\"", "a record is an object; found a string"),
        ("null", "a record is an object; found null"),
    ] {
        malformed(&lines(&[good.clone(), line.to_owned(), sound("c", ("", ""))]), 3, &[words]);
    }
    // Not UTF-8, and too long.
    let mut bytes = lines(std::slice::from_ref(&good)).into_bytes();
    bytes.extend(b"{\"id\": \"\xff\"}\n{\"id\": \"");
    bytes.extend(std::iter::repeat_n(b'x', 2 << 20));
    bytes.extend(format!("\"}}\n{}\n", sound("c", ("", ""))).as_bytes());
    let run = check_file("a.jsonl", &bytes, &["--format", "json"]);
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    let report: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    let what = |i: usize| report["records"][i]["findings"][0]["what"].as_str().unwrap_or_default().to_owned();
    assert_eq!(report["summary"], serde_json::json!({"records": 4, "pass": 2, "warn": 0, "fail": 2, "undecidable": 0}));
    assert!(what(1).contains("not UTF-8") && what(2).contains("longer than 1024 KiB"), "{report}");
}

#[test]
fn rows_that_are_no_records() {
    for (row, words) in [
        ("b,1000", "the row has 2 cells, and the table has 3 columns"),
        ("b,1000,0,1", "the row has 4 cells, and the table has 3 columns"),
        ("b,1,5,0", "a decimal comma?"),
        ("b,\"1,5\",0", "write 1.5"),
        ("b,\"1,500\",0", "write 1500 or 1.500"),
        ("b,1000 kg,0", "its unit belongs in the line of units"),
        ("b,ten,0", "`ten` is not a number"),
        ("b,1e-400,0", "would make it zero"),
        ("b,1_500,0", "write 1500"),
        ("b,0x10,0", "`0x10` is not a number"),
        (",1000,0", "`id` is missing"),
        ("b,\"1000,0", "quotation mark has no partner"),
        ("b,1000,0\rd,-1,0", "a carriage return stands within the line"),
        ("b,1000,zero", "`zero` is not a number"),
        ("b,N/A,0", "`N/A` is not a number (leave it out if it may be left out, and else give an estimate)"),
        ("b,\u{2212}5,0", "write an ordinary minus sign, `-`"),
    ] {
        malformed(&format!("id,b1.mass,b1.before.yaw_rate\n,kg,deg/s\na,1000,0\n{row}\nc, 1000 , 0\n"), 4, &[words]);
    }
    malformed("id,b1.cgx,b1.cgy\n,m,m\na,1,1\nb,1,\n", 4, &["b1.cgy: missing, and the other component is there"]);
    // One that cannot be read is not missing.
    let unread = check_file("a.csv", "id,b1.cgx,b1.cgy\n,m,m\nb,1,\u{2212}1\n".as_bytes(), &["--format", "json"]).out;
    assert!(unread.contains("b1.cgy: ") && !unread.contains("missing, and the other component"), "{unread}");
    malformed("id,b1.fixed,b1.mass\n,,kg\na,true,\nb,yes,\n", 4, &["b1.fixed: expected true or false, found `yes`"]);
    let run = check_file("a.csv", b"# planar-impact-record/1\rid,b1.mass\r,kg\ra,1000\r", &[]);
    assert!(run.status == 2 && run.err.contains("line 1: a carriage return stands within the line"), "{}", run.err);
    malformed("id,profile\n,-\na,printed\nb,print\n", 4, &["did you mean \"printed\"?"]);
}

/// A spreadsheet ends each line with a comma for each column, and writes truths in capitals.
#[test]
fn a_table_of_a_spreadsheet_is_read() {
    let text = "# planar-impact-record/1,,,\nid,b1.fixed,b1.mass,b2.mass\n,,kg,kg\na,TRUE,,1000\nb,FALSE,1000,1000\n";
    let (status, report) = check(text, &[]);
    assert_eq!((status, &report["summary"]["fail"], &report["summary"]["records"]), (0, &0.into(), &2.into()), "{report}");
}

#[test]
fn calls() {
    for (arguments, words) in [
        (&["check"][..], "<FILES>"),
        (&["check", "-", "-"], "twice"),
        (&["check", "-", "--tolerance", "0"], "tolerance is 0; it must be above zero"),
        (&["check", "-", "--tolerance", "nan"], "finite"),
        (&["check", "-", "--tolerance=-1"], "above zero"),
        (&["check", "-", "--tolerance", "1e-400"], "too small"),
        (&["check", "-", "--tolerance", "inf"], "finite"),
        (&["check", "-", "--tolerance", "1e3"], "from 0 to 0.5"),
        (&["check", "-", "--tolerance", "2"], "from 0 to 0.5"),
        (&["check", "-", "--format", "xml"], "junit"),
        (&["check", "-", "--fail-on", "error"], "possible values"),
        (&["check", "-", "--rules"], "cannot be used with"),
        (&["check", "-", "--rule"], "--rules"),
    ] {
        let run = run_with_input(arguments, "");
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}");
        assert!(run.err.contains(words), "{arguments:?}: {}", run.err);
    }
}

#[test]
fn a_name_with_spaces_and_a_name_that_is_no_text() {
    let text = lines(&[sound("a", ("", ""))]);
    assert_eq!(check_file("a b\u{e9}.jsonl", text.as_bytes(), &[]).status, 0);
    #[cfg(target_os = "linux")]
    {
        use std::os::unix::ffi::OsStrExt;
        let folder = Folder::new();
        let name = std::ffi::OsStr::from_bytes(b"a\xff\x1b[31m.jsonl");
        fs::write(folder.path().join(name), text).expect("the file can be written");
        let output = crate::process::planar_impact(folder.path()).arg("check").arg(name).args(["--format", "junit"]).output();
        let output = output.expect("the program starts");
        assert_eq!(output.status.code(), Some(0));
        assert!(!output.stdout.contains(&0x1b));
    }
}
