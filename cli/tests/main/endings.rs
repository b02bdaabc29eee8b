//! Exit of the program if its output is closed, its input is endless, or the user interrupts it.

#![cfg(target_os = "linux")]

use std::fs::File;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::process::{Folder, planar_impact, run, workspace};

const SOLVE: &str = "solve cli/examples/position-a.toml";

/// Returns the exit status of a call in a shell, with its redirections.
fn in_shell(call: &str) -> Option<i32> {
    let line = format!("\"$0\" {call}");
    let mut shell = Command::new("sh");
    shell.current_dir(workspace()).args(["-c", &line, env!("CARGO_BIN_EXE_planar-impact")]).stdin(Stdio::null()).stderr(Stdio::null());
    shell.status().expect("there is a shell").code()
}

#[test]
fn a_closed_output_is_an_error_and_a_discarded_one_is_not() {
    let check = "check cli/examples/check/collision.json";
    for call in [SOLVE, &format!("{SOLVE} --format json"), check, "schema case", "--help"] {
        assert_eq!(in_shell(&format!("{call} >&-")), Some(74), "{call}");
        for redirected in [">/dev/null", "1<>/dev/null", ">/dev/null 2>&-", ">/dev/null <&-"] {
            assert_eq!(in_shell(&format!("{call} {redirected}")), Some(0), "{call} {redirected}");
        }
    }
    assert_eq!(in_shell("solve no-such-file.toml >&-"), Some(2), "there is nothing to write");
}

#[test]
fn an_output_that_is_open_for_reading_alone_is_an_error() {
    for call in [
        SOLVE,
        "check cli/examples/check/collision.json --format json",
        "batch cli/examples/batch/speeds.csv --case cli/examples/position-a.toml -o -",
    ] {
        assert_eq!(in_shell(&format!("{call} 1</dev/null")), Some(74), "{call}");
    }
}

/// A file that exceeds the size limit is an error, as a full disk is, and leaves no temporary file.
#[test]
fn a_file_beyond_the_limit_of_sizes_is_an_error() {
    let folder = Folder::new();
    let program = env!("CARGO_BIN_EXE_planar-impact");
    let case = workspace().join("cli/examples/position-a.toml");
    for call in ["draw \"$1\" -o x.svg", "report \"$1\" -o x.html", "report \"$1\" > out"] {
        let line = format!("ulimit -f 1; \"$0\" {call}");
        let run = Command::new("sh").current_dir(folder.path()).args(["-c", &line, program]).arg(&case).output().expect("there is a shell");
        let err = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(74), "{call}: {err}");
        assert!(err.contains("File too large") && !err.contains(".planar-impact-"), "{call}: {err}");
    }
    let left: Vec<_> = std::fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("an entry").file_name()).collect();
    assert_eq!(left, ["out"]);
}

/// A program that is started with hangups ignored, as by `nohup`, goes on at one.
#[test]
fn an_ignored_hangup_stays_ignored() {
    let line = "trap '' HUP; \"$0\" slide cli/examples/slide.toml > /dev/null & sleep 0.02; kill -HUP $!; wait $!";
    let mut shell = Command::new("sh");
    shell.current_dir(workspace()).args(["-c", line, env!("CARGO_BIN_EXE_planar-impact")]).stderr(Stdio::null());
    assert_eq!(shell.status().expect("there is a shell").code(), Some(0));
}

#[test]
fn an_endless_file_is_refused_soon() {
    let begin = Instant::now();
    for verb in ["check", "solve", "stiffness"] {
        let run = run(&workspace(), &[verb, "/dev/zero"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{verb}");
        assert!(run.err.contains("/dev/zero"), "{verb}: {}", run.err);
    }
    assert!(begin.elapsed() < Duration::from_secs(10), "{:?}", begin.elapsed());
}

/// Interrupts a run after each of several times, including times too early and too late, until one run ends with some
/// output or with none, as required; returns the output.
fn interrupted(words: &[&str], has_output: bool) -> String {
    stopped_by("-INT", words, has_output)
}

/// The same with a signal.
fn stopped_by(signal: &str, words: &[&str], has_output: bool) -> String {
    let folder = Folder::new();
    for after in [300, 100, 1000, 50, 3000] {
        let printed = folder.path().join("printed");
        let output = File::create(&printed).expect("a file");
        let mut child = planar_impact(&workspace()).args(words).stdout(output).stderr(Stdio::null()).spawn().expect("the program starts");
        std::thread::sleep(Duration::from_millis(after));
        Command::new("kill").args([signal, &child.id().to_string()]).status().expect("there is a kill");
        let status = child.wait().expect("the program ends").code();
        let out = std::fs::read_to_string(&printed).expect("the program writes UTF-8");
        if status == Some(130) && out.is_empty() != has_output {
            return out;
        }
    }
    panic!("{words:?}: no interrupt hit");
}

/// Writes a long file of records, some of which break a law.
fn records(folder: &Folder) -> String {
    let header = r#"{"schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "deg"}}"#;
    let mut text = format!("{header}\n");
    for i in 0..600_000 {
        let after = if i % 7 == 0 { 2 } else { 1 };
        text += &format!(
            "{{\"id\": \"{i}\", \"bodies\": [{{\"mass\": 1000, \"before\": {{\"v\": [3, 0]}}, \"after\": {{\"v\": [-1, 0]}}}}, \
             {{\"mass\": 2000, \"before\": {{\"v\": [-1, 0]}}, \"after\": {{\"v\": [{after}, 0]}}}}]}}\n"
        );
    }
    folder.write("records.jsonl", text.as_bytes()).to_str().expect("a plain path").to_owned()
}

#[test]
fn an_interrupted_batch_leaves_no_file() {
    let folder = Folder::new();
    let mut table = "vehicle.1.speed,contact.crush_plane\n".to_owned();
    for i in 0..600_000 {
        table += &format!("{}.5,0.0{}\n", i % 29, i % 7);
    }
    let input = folder.write("in.csv", table.as_bytes());
    let output = folder.path().join("out.csv");
    let path = |path: &std::path::Path| path.to_str().expect("a plain path").to_owned();
    let (input, output) = (path(&input), path(&output));
    // A supervisor asks for the end in its own way, and so does a terminal that is closed.
    for signal in ["-INT", "-TERM", "-HUP"] {
        stopped_by(signal, &["batch", &input, "-o", &output, "--case", "cli/examples/position-a.toml"], false);
    }
    let left = std::fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let others: Vec<_> = left.filter(|name| name != "in.csv").collect();
    // An attempt that came too late has ended, and written its table.
    assert!(others.iter().all(|name| name == "out.csv" || name == "printed"), "{others:?}");
}

#[test]
fn an_interrupted_check_leaves_a_whole_document() {
    let folder = Folder::new();
    let path = records(&folder);
    let printed = |format: &str| interrupted(&["check", &path, "--format", format], true);
    let json: Value = serde_json::from_str(&printed("json")).expect("a whole document");
    assert_eq!(json["interrupted"], true);
    let sarif: Value = serde_json::from_str(&printed("sarif")).expect("a whole document");
    assert_eq!(sarif["runs"][0]["invocations"][0]["executionSuccessful"], false);
    let junit = printed("junit");
    let mut events = quick_xml::Reader::from_str(&junit);
    while events.read_event().expect("sound XML") != quick_xml::events::Event::Eof {}
    assert!(junit.trim_end().ends_with("</testsuites>"));
    let text = printed("text");
    assert!(text.contains("Interrupted before the last record.") && text.ends_with('\n'));
}

#[test]
fn an_interrupted_search_prints_nothing() {
    interrupted(&["reconstruct", "cli/examples/reconstruct/two-cars.toml", "--starts", "10000"], false);
}

/// Each film takes seconds.
#[test]
fn an_interrupted_analysis_of_films_prints_nothing() {
    let folder = Folder::new();
    let names: String = (0..60).map(|k| format!(",distance.{k} [mm]")).collect();
    let frame = |i: i32| format!("{}{}\n", f64::from(i) / 20.0, format!(",{}", 1000 - i % 2000).repeat(60));
    folder.write("films.csv", format!("time [ms]{names}\n{}", (0..4000).map(frame).collect::<String>()).as_bytes());
    folder.write("films.toml", b"schema = 1\nfile = \"films.csv\"\nspeed = \"10 m/s\"\nseparation = \"100 ms\"\n");
    interrupted(&["record", folder.path().join("films.toml").to_str().expect("a path")], false);
}

#[test]
fn interrupted_samples_print_nothing() {
    let call = ["uncertainty", "cli/examples/uncertain.toml", "--samples", "1000000000000"];
    for more in [&[][..], &["--points", "sobol"], &["--format", "json", "--precision", "0.00001%"]] {
        interrupted(&[&call[..], more].concat(), false);
    }
    // The example has correlated inputs, and no shares of its own.
    let shares = ["uncertainty", "cli/examples/uncertainty/differences.toml", "--method", "sobol", "--samples", "1000000000000"];
    interrupted(&shares, false);
}
