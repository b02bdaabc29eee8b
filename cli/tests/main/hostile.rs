//! Hostile text: characters that a terminal or a document would interpret are removed or escaped everywhere, and long text is shortened.

use serde_json::Value;

use crate::process::{Folder, Run, run, workspace};

/// Returns the output formats of a verb.
fn formats(verb: &str) -> &'static [&'static str] {
    match verb {
        "check" => &["text", "json", "junit", "sarif"],
        "sweep" => &["text", "csv", "json", "svg"],
        "uncertainty" => &["text", "csv", "json", "svg"],
        "compare" => &["text", "json", "svg"],
        "formula" => &["text", "latex", "rust", "json"],
        _ => &["text", "json"],
    }
}

/// Characters of each class that must not be printed: C0, delete, C1, and those that break lines or change direction.
const ACTIVE: &str = "\u{7}\u{1b}[31m\u{7f}\u{85}\u{9b}31m\u{61c}\u{200e}\u{200f}\u{2028}\u{2029}\u{202a}\u{202e}\u{2066}\u{2069}";

fn is_active(c: char) -> bool {
    let breaks_or_turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    breaks_or_turns || (c.is_control() && c != '\n')
}

/// Runs a verb on a file in each output format and checks that none prints an active character.
#[track_caller]
fn clean_runs(folder: &Folder, verb: &str, words: &[&str]) -> Vec<Run> {
    let in_format = |format: &&str| {
        let run = run(folder.path(), &[&[verb, "--format", format], words].concat());
        for text in [&run.out, &run.err] {
            assert!(!text.contains(is_active), "{verb} {format} {words:?}: {text:?}");
        }
        assert!(!run.out.is_empty() || !run.err.is_empty(), "{verb} {format}");
        run
    };
    formats(verb).iter().map(in_format).collect()
}

fn reproducer(name: &str) -> String {
    let path = workspace().join("cli/tests/reproducers").join(name);
    std::fs::read_to_string(path).expect("a reproducer")
}

fn example(name: &str) -> String {
    std::fs::read_to_string(workspace().join("cli/examples").join(name)).expect("an example")
}

const OF_CASES: [&str; 7] = ["solve", "gradient", "crush", "crash3", "reconstruct", "uncertainty", "stiffness"];

#[test]
fn reproducers_print_nothing_active() {
    let folder = Folder::new();
    for name in ["c1_key.toml", "bidi_id.json", "bidi_profile.json", "crash3_nan.toml", "tiny_inertia.toml"] {
        folder.write(name, reproducer(name).as_bytes());
        for verb in OF_CASES.into_iter().chain(["check"]) {
            clean_runs(&folder, verb, &[name]);
        }
        clean_runs(&folder, "sweep", &["--vary", "e=0:0.1:0.1", name]);
        clean_runs(&folder, "formula", &["W_n", "--case", name]);
    }
    let checked = clean_runs(&folder, "check", &["bidi_id.json"]);
    let report: Value = serde_json::from_str(&checked[1].out).expect("JSON");
    assert_eq!(report["records"][0]["id"], "a\u{202e}b", "escaped, and the original when it is read");
}

#[test]
fn texts_of_a_case_file_are_cleaned() {
    let folder = Folder::new();
    // A TOML string that escapes every character.
    let escaped: String = ACTIVE.chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect();
    let to_rest = example("to-rest.toml");
    // Slides take seconds, and have no texts.
    let (impact, _) = to_rest.split_once("[rest]").expect("rest positions");
    let case = impact.replace("sedan", &escaped).replace("Oblique", &escaped);
    folder.write("case.toml", case.as_bytes());
    for verb in ["solve", "gradient", "crush", "crash3"] {
        for (run, format) in clean_runs(&folder, verb, &["case.toml"]).iter().zip(formats(verb)) {
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{verb} {format}");
        }
    }
    let runs = clean_runs(&folder, "sweep", &["--vary", "e=0:0.1:0.1", "case.toml"]);
    assert!(runs.iter().all(|run| run.status == 0));
    folder.write("uncertain.toml", example("uncertain.toml").replace("sedan", &escaped).replace("Oblique", &escaped).as_bytes());
    let uncertain = clean_runs(&folder, "uncertainty", &["--samples", "1000", "uncertain.toml"]);
    assert!(uncertain.iter().all(|run| run.status == 0));
    clean_runs(&folder, "formula", &["W_n", "--case", "case.toml"]);
    clean_runs(&folder, "compare", &["case.toml", "case.toml"]);
    let solved = run(folder.path(), &["solve", "--format", "json", "case.toml"]);
    let solution: Value = serde_json::from_str(&solved.out).expect("JSON");
    assert_eq!(solution["vehicles"][0]["name"], ACTIVE);

    // At places that refuse it: a key, a quantity, a unit, a word, and names of evidence and of an unknown.
    let sound = example("reconstruct/two-cars.toml");
    for (from, to) in [
        ("title = ", format!("\"{escaped}\" = 1\ntitle = ")),
        ("\"1450 kg\"", format!("\"{escaped}\"")),
        ("\"1450 kg\"", format!("\"1450 {escaped}\"")),
        ("\"locked\"", format!("\"{escaped}\"")),
        ("[rest]", format!("\"{escaped}\" = 1\n[rest]")),
        ("[unknown]", format!("[unknown]\n\"{escaped}\" = 1")),
    ] {
        let case = sound.replacen(from, &to, 1);
        assert_ne!(case, sound, "{from}");
        folder.write("wrong.toml", case.as_bytes());
        for verb in OF_CASES {
            assert!(clean_runs(&folder, verb, &["wrong.toml"]).iter().all(|run| run.status == 2), "{verb} {from}");
        }
    }
    // Unescaped, both where the format allows the characters and where it does not.
    let raw: String = ACTIVE.chars().filter(|c| !c.is_ascii_control()).collect();
    for text in [
        sound.replace("sedan", &raw),
        sound.replace("sedan", ACTIVE),
        format!("{ACTIVE} = 1\n{sound}"),
        format!("{{\"{ACTIVE}\": {ACTIVE}}}"),
    ] {
        folder.write("raw.toml", text.as_bytes());
        folder.write("raw.json", text.as_bytes());
        ["raw.toml", "raw.json"].iter().for_each(|name| drop(clean_runs(&folder, "crush", &[name])));
    }
}

#[test]
fn names_of_files_and_words_of_calls_are_cleaned() {
    let folder = Folder::new();
    let name = format!("{ACTIVE}.toml");
    folder.write(&name, example("position-a.toml").as_bytes());
    let bad = format!("bad{ACTIVE}.toml");
    folder.write(&bad, b"x = 1\n");
    let records = format!("{ACTIVE}.json");
    folder.write(&records, example("check/collision.json").as_bytes());
    for words in [&[name.as_str()][..], &[&bad], &[&format!("none{ACTIVE}")]] {
        OF_CASES.iter().for_each(|verb| drop(clean_runs(&folder, verb, words)));
        clean_runs(&folder, "check", words);
    }
    clean_runs(&folder, "check", &[&records]);
    for words in [["--of", ACTIVE], ["--wrt", ACTIVE], ["--units", ACTIVE], [ACTIVE, "--second"], ["--second", ACTIVE]] {
        clean_runs(&folder, "gradient", &[&[name.as_str()], &words[..]].concat());
    }
    for vary in
        [ACTIVE.to_owned(), format!("{ACTIVE}=0:1:1"), format!("e=0:1:{ACTIVE}"), format!("e={ACTIVE}:1:1"), format!("m1=1 {ACTIVE}:2:1")]
    {
        clean_runs(&folder, "sweep", &[&name, "--vary", &vary]);
    }
    folder.write("uncertain.toml", example("uncertain.toml").as_bytes());
    for words in [["--of", ACTIVE], ["--probability", ACTIVE], ["--precision", ACTIVE], ["--method", ACTIVE], ["--points", ACTIVE]] {
        clean_runs(&folder, "uncertainty", &[&["uncertain.toml", "--method", "linear,monte-carlo"], &words[..]].concat());
    }
    for statement in [format!("{ACTIVE} > 1"), format!("dV1 > {ACTIVE}"), format!("dV1 > 1 {ACTIVE}"), format!("dV1{ACTIVE} > 1 mph")] {
        clean_runs(&folder, "uncertainty", &["uncertain.toml", "--method", "linear", "--probability", &statement]);
    }
    clean_runs(&folder, "formula", &[ACTIVE]);
    clean_runs(&folder, "check", &[&records, "--tolerance", ACTIVE]);
    let option = format!("--{ACTIVE}");
    for words in [[ACTIVE, ""], ["solve", &option], ["schema", ACTIVE], ["completions", ACTIVE], ["help", ACTIVE]] {
        let run = run(folder.path(), &words);
        assert!(!run.out.contains(is_active) && !run.err.contains(is_active), "{words:?}: {:?}", run.err);
        assert_eq!(run.status, 2, "{words:?}");
    }
}

#[test]
fn records_of_other_programs_are_cleaned() {
    let folder = Folder::new();
    let escaped: String = ACTIVE.chars().map(|c| format!("\\u{:04x}", u32::from(c))).collect();
    let sound = reproducer("bidi_id.json").replace("a\\u202eb", "a");
    for from in [
        "\"a\"",
        "\"impulse\"",
        "\"example\"",
        "\"1.2\"",
        "\"critical\"",
        "\"note\"",
        "\"kg\"",
        "\"deg\"",
        "\"cg\"",
        "\"model\"",
        "\"1\"",
        "\"units\"",
    ] {
        let text = sound.replacen(from, &format!("\"{escaped}\""), 1);
        assert_ne!(text, sound, "{from}");
        folder.write("a.json", text.as_bytes());
        clean_runs(&folder, "check", &["a.json"]);
    }
    let table = example("check/paper-table-2.csv");
    let quoted = format!("\"{}\"", ACTIVE.replace('"', ""));
    for from in ["id,", "slug", "yaw_rate", "deg"] {
        let text = table.replacen(from, &if from == "id," { format!("{quoted},") } else { ACTIVE.to_owned() }, 1);
        folder.write("a.csv", text.as_bytes());
        clean_runs(&folder, "check", &["a.csv"]);
    }
    // The name and a number of the last record.
    let (above, last) = table.trim_end().rsplit_once('\n').expect("lines");
    let cells: Vec<&str> = last.split(',').collect();
    for place in 0..cells.len().min(8) {
        let mut cells = cells.clone();
        cells[place] = ACTIVE;
        folder.write("a.csv", format!("{above}\n{}\n", cells.join(",")).as_bytes());
        clean_runs(&folder, "check", &["a.csv"]);
    }
}

/// Returns a hundred thousand characters.
fn long() -> String {
    "n".repeat(100_000)
}

#[track_caller]
fn short_error(folder: &Folder, words: &[&str]) {
    let run = run(folder.path(), words);
    assert_eq!((run.status, run.out.as_str()), (2, ""), "{:.200}", run.err);
    assert!(run.err.len() < 10_000, "{} bytes: {:.200}", run.err.len(), run.err);
}

#[test]
fn long_names_are_not_repeated() {
    let folder = Folder::new();
    let long = long();
    let sound = example("reconstruct/two-cars.toml");
    for (from, to) in [
        ("title = ", format!("{long} = 1\ntitle = ")),
        ("mass = ", format!("{long} = 1\nmass = ")),
        ("mass = ", format!("{long} = \"{long}\"\nmass = ")),
        ("\"1450 kg\"", format!("\"{long}\"")),
        ("\"1450 kg\"", format!("\"1450 {long}\"")),
        ("\"1450 kg\"", "1".repeat(100_000)),
        ("\"locked\"", format!("\"{long}\"")),
        ("[rest]", format!("vehicle.1.{long} = 1\n[rest]")),
        ("[rest]", format!("{} = 1\n[rest]", ["n"; 60].join(".").replace('n', &long[..1000]))),
        ("[unknown]", format!("[unknown]\n{long} = 1")),
        ("\"41 km/h\"", format!("\"41 km/h ± {long}\"")),
        ("schema = 1", format!("schema = {long}")),
    ] {
        let case = sound.replacen(from, &to, 1);
        assert_ne!(case, sound, "{from}");
        folder.write("case.toml", case.as_bytes());
        short_error(&folder, &["solve", "case.toml"]);
    }
    folder.write("case.json", format!("{{\"{long}\": \"{long}\", \"{long}\": 1}}").as_bytes());
    short_error(&folder, &["solve", "case.json"]);
    folder.write("case.toml", example("position-a.toml").as_bytes());
    for words in [
        &["gradient", "case.toml", "--of", &long][..],
        &["gradient", "case.toml", "--wrt", &long],
        &["gradient", "case.toml", "--format", &long],
        &["gradient", "case.toml", "--units", &long],
        &["gradient", "case.toml", &long],
        &["gradient", "case.toml", &format!("--{long}")],
        &["sweep", "case.toml", "--vary", &long],
        &["sweep", "case.toml", "--vary", &format!("{long}=0:1:1")],
        &["sweep", "case.toml", "--vary", &format!("e=0:1:{long}")],
        &["sweep", "case.toml", "--vary", "e=0:1:1", "--of", &long],
        &["reconstruct", "case.toml", "--seed", &long],
        &["uncertainty", "case.toml", "--of", &long],
        &["uncertainty", "case.toml", "--probability", &long],
        &["uncertainty", "case.toml", "--probability", &format!("{long} > 1")],
        &["uncertainty", "case.toml", "--probability", &format!("dV1 > {long}")],
        &["uncertainty", "case.toml", "--precision", &long],
        &["uncertainty", "case.toml", "--bounds-sd", &long],
        &["uncertainty", "case.toml", "--method", &long],
        &["formula", &long],
        &["formula", "W_n", "--wrt", &long],
        &["check", "--tolerance", &long, "case.toml"],
        &["schema", &long],
        &["completions", &long],
        &["solve", &long],
        &["check", &long],
        &[&long],
        &[&format!("--{long}")],
        &["help", &long],
    ] {
        short_error(&folder, words);
    }
}

#[test]
fn long_names_in_records_are_not_repeated() {
    let folder = Folder::new();
    let long = long();
    let document = example("check/collision.json");
    let header = r#"{"schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "deg"}"#;
    let table = example("check/paper-table-2.csv");
    for (name, text) in [
        ("a.json", document.replacen("\"schema\"", &format!("\"{long}\": \"{long}\", \"schema\""), 1)),
        ("a.json", document.replacen("\"kg\"", &format!("\"{long}\""), 1)),
        ("a.jsonl", format!("{header}, \"{long}\": 1}}\n{{}}\n")),
        ("a.jsonl", format!("{header}, \"tool\": {{\"{long}\": 1}}}}\n{{}}\n")),
        ("a.jsonl", format!("{{\"{long}\": 1}}\n{{\"{long}\": 1}}\n")),
        ("a.csv", table.replacen("contact.normal_angle", &long, 1)),
        ("a.csv", table.replacen(",deg,", &format!(",{long},"), 1)),
        ("a.csv", table.replacen(",ft lb,", &format!(",1 {long},"), 1)),
    ] {
        assert!(text.contains(&long[..1000]), "{name}");
        folder.write(name, text.as_bytes());
        for format in formats("check") {
            short_error(&folder, &["check", name, "--format", format]);
        }
    }
}
