//! The findings of `check`, and cases without findings.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::{HEADER, check, document, lines, records, rules, sound};
use crate::process::{run, run_with_input, workspace};

fn example(name: &str) -> PathBuf {
    workspace().join("cli/examples/check").join(name)
}

#[test]
fn the_paper_s_tables_as_printed_have_their_misprints_and_no_others() {
    for (file, count, misprint, rule) in
        [("paper-table-2.csv", 13, "gamma -2", "group"), ("paper-table-b1.csv", 6, "test 2 e 0.13", "reported")]
    {
        let run = run(&workspace(), &["check", &format!("cli/examples/check/{file}"), "--format", "json"]);
        assert_eq!((run.status, run.err.as_str()), (1, ""), "{file}");
        let report: Value = serde_json::from_str(&run.out).expect("JSON");
        assert_eq!(records(&report).len(), count);
        for record in records(&report) {
            let found = record["findings"].as_array().expect("findings");
            if record["id"] == misprint {
                assert_eq!((rules(record, "fail"), found.len()), (vec![rule], 1), "{record}");
            } else {
                assert_eq!((&record["verdict"], found.len()), (&Value::from("pass"), 0), "{record}");
            }
        }
    }
}

/// Returns the rows of a CSV file without comments, by column name.
fn table(path: PathBuf) -> Vec<Vec<(String, String)>> {
    let text = fs::read_to_string(path).expect("the table is there");
    let mut lines = text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().expect("a header");
    lines.map(|row| names.iter().cloned().zip(row).collect()).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    &row.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no column {name}")).1
}

#[test]
fn the_paper_s_tables_are_the_printed_digits() {
    let data = workspace().join("validation/data");
    let same = |file: &str, records: &str, columns: &[(&str, &str, &str)]| {
        let (printed, told) = (table(data.join(file)), table(example(records)));
        // The first row of the records holds the units.
        assert_eq!(printed.len() + 1, told.len(), "{file}");
        for (printed, told) in printed.iter().zip(&told[1..]) {
            for (column, sign, name) in columns {
                assert_eq!(format!("{sign}{}", cell(printed, column)), cell(told, name), "{file}, {column}");
            }
        }
    };
    let of_table_2 = [
        ("gamma_deg", "", "contact.normal_angle"),
        ("mu0", "", "model.impulse_ratio"),
        ("Wn_ftlb", "", "reported.work_normal"),
        ("Wt_ftlb", "", "reported.work_tangential"),
    ];
    same("table2.csv", "paper-table-2.csv", &of_table_2);
    let of_table_b1 = [
        ("vn", "", "reported.closing_speed"),
        ("Ti", "", "reported.kinetic_energy_before"),
        ("e", "", "model.restitution"),
        ("TLn", "-", "reported.work_normal"),
        ("TLt", "-", "reported.work_tangential"),
        ("TL", "", "reported.energy_loss"),
        ("dv_ftps", "", "reported.delta_v.1"),
    ];
    same("tableB1.csv", "paper-table-b1.csv", &of_table_b1);
}

#[test]
fn the_other_examples_pass() {
    for name in ["collision.json", "engine.jsonl", "template.csv"] {
        let run = run(&workspace(), &["check", example(name).to_str().expect("a plain name"), "--format", "json", "--fail-on", "warn"]);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{name}: {}", run.out);
    }
}

#[test]
fn the_records_of_the_guide_and_of_the_help_pass() {
    let guide = fs::read_to_string(workspace().join("src/guide/checking.md")).expect("the guide is there");
    let fenced = guide.split("```json\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a record");
    let help = run(&workspace(), &["check", "--help"]).out;
    let shown: String = help.lines().skip_while(|line| *line != "{").take_while(|line| *line != "}").chain(["}"]).collect();
    for text in [fenced, &shown] {
        let (status, report) = check(text, &["--fail-on", "warn"]);
        assert_eq!((status, &report["summary"]["pass"]), (0, &Value::from(1)), "{text}");
    }
}

/// One changed digit in an example must be found.
#[test]
fn the_examples_are_not_passed_unread() {
    for (name, from, to) in
        [("collision.json", "-20.95", "-20.59"), ("engine.jsonl", "[3.0, 0.0]", "[3.1, 0.0]"), ("template.csv", ",-21.101,", ",-21.011,")]
    {
        let text = fs::read_to_string(example(name)).expect("the example is there");
        assert!(text.contains(from), "{name}");
        let (status, report) = check(&text.replace(from, to), &[]);
        assert_eq!((status, report["summary"]["fail"].as_u64() > Some(0)), (1, true), "{name}: {report}");
    }
}

#[test]
fn numbers_that_are_none_are_found_by_name() {
    for (number, line) in [("NaN", true), ("-Infinity", true), ("1e999", false), ("-1e400", false)] {
        let record = sound("a", ("[-1, 0]}", &format!("[{number}, 0]}}")));
        let (status, report) = check(&lines(&[record.clone(), sound("b", ("", ""))]), &[]);
        assert_eq!(status, 1);
        assert!(rules(&records(&report)[0], "fail").iter().all(|rule| *rule == "finite"), "{report}");
        assert_eq!(records(&report)[1]["verdict"], "pass");
        if !line {
            let (status, report) = check(&document(&[record]), &[]);
            assert_eq!((status, rules(&records(&report)[0], "fail").contains(&"finite")), (1, true), "{number}: {report}");
        }
    }
    for number in ["nan", "inf", "-inf", "1e999"] {
        let table = format!("id,b1.mass\n,kg\na,{number}\nb,1000\n");
        let (status, report) = check(&table, &[]);
        assert_eq!((status, rules(&records(&report)[0], "fail")), (1, vec!["finite"]), "{number}");
    }
}

#[test]
fn masses_in_pounds_need_the_units_of_what_hangs_on_them() {
    let units = r#""length": "ft", "mass": "lb", "time": "s", "angle": "deg""#;
    let with = |more: &str| {
        let header = HEADER.split("\"units\"").next().expect("the schema").to_owned() + &format!("\"units\": {{{units}{more}}}");
        check(
            &format!(
                "{{{header}}}\n{{\"id\": \"a\", \"reported\": {{\"energy_loss\": 5, \"work_normal\": -4, \"work_tangential\": -1}}}}\n"
            ),
            &[],
        )
    };
    let (status, report) = with("");
    assert_eq!((status, rules(&records(&report)[0], "fail")), (1, vec!["malformed"; 3]));
    assert!(records(&report)[0]["findings"][0]["what"].as_str().expect("a text").contains("ft lbf"));
    assert_eq!(with(r#", "energy": "ft lb""#).0, 0);
}

#[test]
fn the_tolerance_can_be_set() {
    // An error of 1 kg m/s in 4000.
    let off = lines(&[sound("a", ("{\"v\": [1, 0]}", "{\"v\": [1.0005, 0]}"))]);
    for (arguments, status) in [(&[][..], 1), (&["--tolerance", "1e-3"], 0), (&["--tolerance", "1e-4"], 1)] {
        assert_eq!(check(&off, arguments).0, status, "{arguments:?}");
    }
}

#[test]
fn warnings_and_what_cannot_be_decided_fail_a_run_only_if_asked() {
    let warned = lines(&[sound("a", ("\"mass\": 2000", "\"yaw_inertia\": 1, \"mass\": 2000"))]);
    let coarse = lines(&[sound("a", ("\"bodies\"", "\"resolution\": {\"v\": 9}, \"bodies\""))]);
    for (text, verdict, statuses) in [(&warned, "warn", [0, 0, 0, 1]), (&coarse, "undecidable", [0, 0, 1, 1])] {
        for (arguments, status) in
            [&[][..], &["--fail-on", "fail"], &["--fail-on", "undecidable"], &["--fail-on", "warn"]].into_iter().zip(statuses)
        {
            let (found, report) = check(text, arguments);
            assert_eq!((found, &report["records"][0]["verdict"]), (status, &Value::from(verdict)), "{arguments:?}: {report}");
        }
    }
}

#[test]
fn an_id_that_stands_twice_is_found_in_one_file_and_not_in_two() {
    let twice = lines(&[sound("a", ("", "")), sound("b", ("", "")), sound("a", ("", ""))]);
    let (status, report) = check(&twice, &[]);
    assert_eq!((status, rules(&records(&report)[2], "fail")), (1, vec!["malformed"]));
    let folder = crate::process::Folder::new();
    for name in ["one.jsonl", "two.jsonl"] {
        folder.write(name, lines(&[sound("a", ("", ""))]).as_bytes());
    }
    let run = run(folder.path(), &["check", "one.jsonl", "two.jsonl"]);
    assert_eq!((run.status, run.out.as_str()), (0, "2 records in 2 files: 2 pass, 0 warn, 0 fail, 0 undecidable\n"));
}

#[test]
fn a_group_is_held_together() {
    let member =
        |id: &str, group: &str, loss: f64| format!("{{\"id\": \"{id}\", \"group\": {group}, \"reported\": {{\"energy_loss\": {loss}}}}}");
    let group = r#"{"name": "g", "agreement": "loss"}"#;
    let (status, report) = check(&lines(&[member("a", group, 5.0), member("b", group, 6.0), member("c", group, 5.0)]), &[]);
    let verdicts: Vec<_> = records(&report).iter().map(|record| record["verdict"].as_str().expect("a verdict")).collect();
    assert_eq!((status, verdicts), (1, vec!["pass", "fail", "pass"]));
    let (_, report) = check(&lines(&[member("a", "\"g\"", 5.0), member("b", "\"g\"", 6.0)]), &[]);
    for record in records(&report) {
        assert_eq!(rules(record, "fail"), ["group"]);
        assert!(record["findings"][0]["what"].as_str().expect("a text").contains("cannot be determined"));
    }
    let (status, report) = check(&lines(&[member("a", "\"g\"", 5.0), member("b", "\"h\"", 6.0), member("c", "\"g\"", 5.0)]), &[]);
    assert_eq!((status, rules(&records(&report)[2], "warn")), (0, vec!["group"]));
}

/// A record that gives too little for any law passes, and is counted.
#[test]
fn a_record_without_a_law_is_said_to_be_unchecked() {
    let call = |bodies: &str, arguments: &[&str]| {
        let header = r#""schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"}"#;
        let records = format!("{{{header}, \"records\": [{{\"id\": \"a\", \"profile\": \"impulse\", \"bodies\": {bodies}}}]}}");
        run_with_input(&[&["check", "-"], arguments].concat(), &records)
    };
    let record = |bodies: &str| {
        let run = call(bodies, &[]);
        assert_eq!(run.status, 0, "{}", run.err);
        run.out
    };
    let wanted = "unchecked: 1 of them give too little for any law; see --rules\n";
    let masses = "[{\"mass\": 1000}, {\"mass\": 1200}]";
    assert!(record(masses).contains(wanted));
    // Who asks for decisions has none here.
    for (severity, status, element) in [("fail", 0, "<skipped"), ("undecidable", 1, "<failure"), ("warn", 1, "<failure")] {
        assert_eq!(call(masses, &["--fail-on", severity]).status, status, "{severity}");
        let run = call(masses, &["--fail-on", severity, "--format", "junit"]);
        assert_eq!(run.status, status, "{severity}");
        assert!(run.out.contains(&format!("{element} message=\"unchecked: it gives too little for any law; see --rules\"")), "{}", run.out);
    }
    let body = |mass: u32, before: i32, after: i32| {
        format!("{{\"mass\": {mass}, \"before\": {{\"v\": [{before}, 0]}}, \"after\": {{\"v\": [{after}, 0]}}}}")
    };
    assert!(!record(&format!("[{}, {}]", body(1000, 10, 5), body(1000, 0, 5))).contains("unchecked"));
}

/// Returns the verdict on a record without resolutions, within the tolerance of measurements.
fn measured(record: &str) -> Value {
    let text = format!(
        r#"{{"schema":"planar-impact-record/1","units":{{"length":"m","mass":"kg","time":"s","angle":"rad"}},"records":[{{"id":"a","profile":"measured",{record}}}]}}"#
    );
    let run = run_with_input(&["check", "-", "--format", "json"], &text);
    let answer: Value = serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error} {}", run.err));
    answer["records"][0].clone()
}

/// A number that is left out has no rule fail: what cancels in a velocity is what its error is a share of, and works that cancel have the energies.
#[test]
fn what_is_left_out_fails_nothing() {
    let verdict = |record: &str| measured(record)["verdict"].as_str().map(str::to_owned);
    let at_wall = |before: &str, after: &str, rest: &str| {
        format!(
            r#""bodies":[{{"mass":1500,"yaw_inertia":2400,"cg":[0,0],"before":{{{before}}},"after":{{{after}}}}},{{"fixed":true}}],
            "contact":{{"point":[-2,0.3],"normal_angle":0}}{rest}"#
        )
    };
    let plastic = r#","model":{"restitution":0}"#;
    for (before, fails) in [(r#""v":[-10,0]"#, "fail"), (r#""v":[-10,0],"yaw_rate":0"#, "pass")] {
        // 1 µm/s of 0.6 m/s of translation and of rotation each; without the spin half a meter a second fails, of a tolerance of 5 %.
        assert_eq!(verdict(&at_wall(before, r#""v":[-0.599999,0],"yaw_rate":-2"#, plastic)).as_deref(), Some("pass"));
        assert_eq!(verdict(&at_wall(before, r#""v":[-0.1,0],"yaw_rate":-2"#, plastic)).as_deref(), Some(fails));
    }
    for speed in ["-0.600001", "-0.599999"] {
        let after = format!(r#""v":[{speed},-4],"yaw_rate":-2"#);
        assert_eq!(verdict(&at_wall(r#""v":[-10,-8]"#, &after, "")).as_deref(), Some("pass"), "{speed}");
    }
    assert_eq!(verdict(&at_wall(r#""v":[-10,-8]"#, r#""v":[-2,-4],"yaw_rate":-2"#, "")).as_deref(), Some("fail"));
    let elastic = |work: f64| {
        format!(
            r#""bodies":[{{"mass":1500,"yaw_inertia":2400,"cg":[-2,0],"before":{{"v":[15,5],"yaw_rate":0}},"after":{{"v":[-15.015,4.862],"yaw_rate":-0.1788}}}},{{"fixed":true}}],
            "contact":{{"normal_angle":0}},"reported":{{"work_normal":0,"work_tangential":{work}}}"#
        )
    };
    assert_eq!([-1017.9, -30_000.0].map(|work| verdict(&elastic(work))), ["pass", "fail"].map(|verdict| Some(verdict.to_owned())));
}

/// Of two bodies that pass almost the same impulse, within a tolerance, neither comes first.
#[test]
fn a_verdict_knows_no_first_body() {
    let one = r#"{"mass":1891,"yaw_inertia":4933,"cg":[1.2231,-1.7599],"before":{"v":[2.8313,-11.0514],"yaw_rate":-2.5095},"after":{"v":[5.1484,-17.2236],"yaw_rate":-1.2785}}"#;
    let two = r#"{"mass":1968,"yaw_inertia":3303,"cg":[-0.1295,1.8699],"before":{"v":[15.8704,-15.6908],"yaw_rate":-2.7255},"after":{"v":[13.6343,-9.8794],"yaw_rate":-4.7542}}"#;
    let record = |bodies: [&str; 2], [one, two]: [f64; 2], sign: f64| {
        format!(
            r#""bodies":[{},{}],"contact":{{"point":[0,0],"normal_angle":2.0641}},"model":{{"restitution":0.6137,"impulse_ratio":-0.1245}},
            "reported":{{"energy_loss":20840,"work_normal":-20430,"work_tangential":-513.1404,"delta_v":[{one},{two}],"impulse":{{"normal":{},"tangential":{}}}}}"#,
            bodies[0],
            bodies[1],
            sign * -11730.0,
            sign * 1486.0
        )
    };
    let [given, exchanged] =
        [record([one, two], [6.3885, 6.1033], 1.0), record([two, one], [6.1033, 6.3885], -1.0)].map(|record| measured(&record));
    let rules =
        |found: &Value| found["findings"].as_array().map(|all| all.iter().map(|finding| finding["rule"].clone()).collect::<Vec<_>>());
    assert!(rules(&given).is_some_and(|rules| rules.iter().all(|rule| rule != "malformed")), "{given}");
    assert_eq!((&given["verdict"], rules(&given)), (&exchanged["verdict"], rules(&exchanged)), "{given} {exchanged}");
}

/// A car against a wall that pushes along the normal alone, while the lever goes from 0.7 to 1.1 m: its work is the change of the kinetic energy. By the mean of the speeds
/// at its ends, and at the one lever of a record without the other, it would be another.
#[test]
fn works_and_speeds_of_a_contact_that_lasts_are_those_between_its_ends() {
    let record = |point_after: &str, before: &str, reported: &str| {
        format!(
            "{{\"id\": \"a\", \"bodies\": [{{\"mass\": 1500, \"yaw_inertia\": 3000, \"cg\": [-1.8, -0.7], \"before\": {{\"v\": [14, 0]{before}}}, \
             \"after\": {{\"v\": [2, 0], \"yaw_rate\": 309.3972093706457, \"cg\": [-1, -0.7]}}}}, {{\"fixed\": true}}], \"contact\": {{\"point\": [0, 0], \
             \"normal_angle\": 0, \"duration\": 0.1{point_after}}}, {reported}}}"
        )
    };
    let (placed, still) = (", \"point_after\": [0, 0.4]", ", \"yaw_rate\": 0");
    for (record, verdict) in [
        (record(placed, still, "\"reported\": {\"energy_loss\": 100260, \"work_normal\": -100260, \"work_tangential\": 0}"), "pass"),
        (record(placed, still, "\"reported\": {\"work_normal\": -150000}"), "fail"),
        (record("", still, "\"reported\": {\"separation_speed\": 3.94}"), "warn"),
        (record("", "", "\"model\": {\"restitution\": 0.2814}, \"reported\": {\"closing_speed\": 14}"), "warn"),
        (record("", still, "\"reported\": {\"separation_speed\": 394}"), "fail"),
    ] {
        let (_, report) = check(&lines(std::slice::from_ref(&record)), &[]);
        assert_eq!(records(&report)[0]["verdict"], verdict, "{record} {report}");
    }
}
