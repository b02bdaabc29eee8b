//! Inputs that are not text, not TOML, not JSON, or not files.

use std::fs::{self, File};
use std::time::{Duration, Instant};

use super::{Bad, COLLISION, JSON, check, faults_of, solve, wrong};
use crate::process::{Folder, run, run_with_input, workspace};

/// Inputs and expected messages.
pub const BAD: &[Bad] = &[
    wrong("nothing", &[], 0, &["is empty"]).of(""),
    wrong("only spaces", &[], 0, &["is empty"]).of("  \n\n \t\r\n"),
    wrong("only a comment", &[], 0, &["schema: missing", "vehicle: missing", "contact: missing"]).of("# nothing\n"),
    wrong("an empty object", &[], 1, &["schema: missing", "vehicle: missing", "contact: missing"]).of("{}"),
    wrong("TOML cut off in a text", &[], 2, &["not TOML"]).of("schema = 1\ntitle = \"a ca"),
    wrong("TOML cut off behind a key", &[], 2, &["not TOML"]).of("schema = 1\ntitle ="),
    wrong("JSON cut off", &[], 0, &["not JSON"]).of("{\"schema\": 1, \"vehicle\": [{\"name\""),
    wrong("JSON with a trailing comma", &[("0.1}", "0.1,}")], 10, &["not JSON", "trailing comma"]).of(JSON),
    wrong("JSON with text behind it", &[("}\n}\n", "}\n}\nx\n")], 12, &["not JSON"]).of(JSON),
    wrong("JSON with a comment", &[("\"schema\": 1,", "\"schema\": 1, // note")], 2, &["not JSON"]).of(JSON),
    wrong("JSON in single quotes", &[("\"title\"", "'title'")], 3, &["not JSON"]).of(JSON),
    wrong("JSON with a line break in a text", &[("a case", "a\ncase")], 3, &["not JSON"]).of(JSON),
    wrong("a zero byte in a text", &[("sedan", "se\0dan")], 5, &["not TOML"]),
    wrong("JSON in place of TOML", &[("schema = 1", "{\"schema\": 1}")], 1, &["not TOML"]),
    // Accepted.
    wrong("no line break at the end", &[("= 0.1\n", "= 0.1")], 0, &[]).ends(0),
    wrong("comments", &[("= 0.1\n", "= 0.1 # guessed\n# end")], 0, &[]).ends(0),
];

#[test]
fn texts() {
    check(BAD);
}

/// Of each kind of file, given to a verb that reads another.
#[test]
fn files_of_another_kind_are_named() {
    let files = [
        ("position-a.toml", "a case file", "`solve`, `reconstruct` and others read it"),
        ("tests/malibu.toml", "a file of barrier tests", "`stiffness` reads it"),
        ("record/barrier.toml", "a recording", "`record` reads it"),
        ("check/collision.json", "a file of records", "`check` reads it"),
    ];
    for (verb, wanted) in [("solve", 0), ("stiffness", 1), ("record", 2)] {
        for (at, (file, kind, reads)) in files.into_iter().enumerate() {
            let run = run(&workspace(), &[verb, &format!("cli/examples/{file}")]);
            if at == wanted {
                assert_eq!(run.status, 0, "{}", run.err);
                continue;
            }
            let said = format!("error: this is {kind}, and {} is needed\n", files[wanted].1);
            assert!(run.status == 2 && run.err.starts_with(&said) && run.err.contains(reads), "{verb} {file}: {}", run.err);
            assert_eq!(run.err.matches("error:").count(), 1, "{}", run.err);
        }
    }
}

/// Writes bytes to a file, solves it, and checks the status and the message.
fn bytes(file: &str, bytes: &[u8], status: i32, says: &[&str]) {
    let folder = Folder::new();
    folder.write(file, bytes);
    holds(&folder, file, status, says);
}

fn holds(folder: &Folder, file: &str, status: i32, says: &[&str]) {
    let run = solve(folder, file);
    let wanted: Vec<String> = says.iter().map(|&words| words.to_owned()).collect();
    let faults = faults_of(&run, status, file, &wanted);
    assert!(faults.is_empty(), "{faults:?}\n{}", run.err);
}

#[test]
fn encodings() {
    let marked = |text: &str| [b"\xef\xbb\xbf", text.as_bytes()].concat();
    bytes("case.toml", &marked(COLLISION), 0, &[]);
    bytes("case.json", &marked(JSON), 0, &[]);
    bytes("case.toml", COLLISION.replace('\n', "\r\n").as_bytes(), 0, &[]);
    bytes("case.json", JSON.replace('\n', "\r\n").as_bytes(), 0, &[]);
    // The byte order mark is not part of the first line, and carriage returns are not part of any line.
    let wrong = marked(&COLLISION.replace("2564 lb", "2564 ft").replace('\n', "\r\n"));
    bytes("case.toml", &wrong, 2, &["case.toml:6:8\n", "vehicle.1.mass"]);
    let little: Vec<u8> = COLLISION.encode_utf16().flat_map(u16::to_le_bytes).collect();
    bytes("case.toml", &[b"\xff\xfe", &little[..]].concat(), 2, &["UTF-16", "save it as UTF-8"]);
    let big: Vec<u8> = JSON.encode_utf16().flat_map(u16::to_be_bytes).collect();
    bytes("case.json", &[b"\xfe\xff", &big[..]].concat(), 2, &["UTF-16"]);
    let at = COLLISION.find("sedan").expect("the base has it");
    let mut latin = COLLISION.as_bytes().to_vec();
    latin[at] = 0xe9;
    bytes("case.toml", &latin, 2, &["not UTF-8", &format!("offset {at} ")]);
}

#[test]
fn names_of_files() {
    bytes("a b é 車.toml", COLLISION.as_bytes(), 0, &[]);
    bytes("a b é 車.toml", b"x = 1\n", 2, &["x: unknown key"]);
    bytes("CASE.JSON", JSON.as_bytes(), 0, &[]);
    // For any other extension, the text determines the format.
    bytes("case.txt", JSON.as_bytes(), 0, &[]);
    bytes("case", COLLISION.as_bytes(), 0, &[]);
    bytes("case.json", COLLISION.as_bytes(), 2, &["this is not JSON, as its name says, but TOML", "case.json", "end in .toml"]);
}

#[test]
fn files_that_are_none() {
    let folder = Folder::new();
    holds(&folder, "nowhere.toml", 2, &["`nowhere.toml` cannot be read: there is no such file"]);
    holds(&folder, "no/where.toml", 2, &["no/where.toml"]);
    fs::create_dir(folder.path().join("folder.toml")).expect("a folder");
    holds(&folder, "folder.toml", 2, &["`folder.toml` is a directory"]);
}

#[cfg(unix)]
#[test]
fn files_that_may_not_be_read() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("loop.toml", folder.path().join("loop.toml")).expect("a link");
    holds(&folder, "loop.toml", 2, &["`loop.toml` cannot be read"]);
}

#[cfg(target_os = "linux")]
#[test]
fn devices() {
    let folder = Folder::new();
    holds(&folder, "/dev/null", 2, &["`/dev/null` is empty"]);
    holds(&folder, "/dev/zero", 2, &["`/dev/zero` is larger than"]);
}

#[test]
fn a_huge_file_is_refused_unread() {
    let folder = Folder::new();
    for name in ["huge.toml", "huge.json"] {
        // A sparse file of one gibibyte, which takes no space on the disk.
        File::create(folder.path().join(name)).and_then(|file| file.set_len(1 << 30)).expect("a sparse file");
        let begin = Instant::now();
        holds(&folder, name, 2, &["is larger than"]);
        assert!(begin.elapsed() < Duration::from_secs(2), "{:?}", begin.elapsed());
    }
}

#[test]
fn deep_nesting_neither_overflows_nor_lasts() {
    let deep = 100_000;
    let begin = Instant::now();
    for (file, text) in [
        ("case.toml", format!("x = {}{}\n", "[".repeat(deep), "]".repeat(deep))),
        ("case.toml", format!("{}a = 1\n", "a.".repeat(deep))),
        ("case.toml", format!("[{}a]\n", "a.".repeat(deep))),
        ("case.toml", format!("x = {}1{}\n", "{ a = ".repeat(deep), "}".repeat(deep))),
        ("case.json", format!("{{\"x\": {}{}}}", "[".repeat(deep), "]".repeat(deep))),
        ("case.json", format!("{}1{}", "{\"a\": ".repeat(deep), "}".repeat(deep))),
        ("case.json", "[".repeat(deep)),
    ] {
        bytes(file, text.as_bytes(), 2, &[]);
    }
    assert!(begin.elapsed() < Duration::from_secs(10), "{:?}", begin.elapsed());
}

#[test]
fn a_megabyte_in_a_key_is_not_repeated() {
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.replace("title", &"y".repeat(1_000_000)).as_bytes());
    let run = solve(&folder, "case.toml");
    assert_eq!(run.status, 2);
    assert!(run.err.len() < 5000 && run.err.contains("unknown key"), "{} bytes", run.err.len());
}

#[test]
fn standard_input_is_called_by_name() {
    for (text, says) in [("", "`<stdin>` is empty"), ("schema = 2\n", "<stdin>:1:10"), ("{\"schema\": 2}", "<stdin>:1:12")] {
        let run = run_with_input(&["solve", "-"], text);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
        assert!(run.err.contains(says), "{}", run.err);
    }
}
