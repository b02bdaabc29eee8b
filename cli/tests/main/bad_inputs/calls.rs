//! Invalid calls, and output that cannot be written.

use super::COLLISION;
use crate::process::{Folder, run};

#[test]
fn wrong_calls() {
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.as_bytes());
    let calls: [(&[&str], &str); 17] = [
        (&[], "Usage: planar-impact <COMMAND>"),
        (&["solv", "case.toml"], "a similar subcommand exists: 'solve'"),
        (&["frobnicate"], "unrecognized subcommand 'frobnicate'"),
        (&["--frobnicate"], "unexpected argument '--frobnicate'"),
        (&["solve"], "<CASE>"),
        (&["solve", "case.toml", "case.toml"], "unexpected argument"),
        (&["solve", "case.toml", "--fromat", "json"], "a similar argument exists: '--format'"),
        (&["solve", "case.toml", "--format", "yaml"], "invalid value 'yaml'"),
        (&["solve", "case.toml", "--format"], "a value is required for '--format"),
        (&["solve", "case.toml", "--format", "json", "--format", "json"], "cannot be used multiple times"),
        (&["solve", "case.toml", "--units", "imperial"], "invalid value 'imperial'"),
        (&["solve", "case.toml", "--units", "SI"], "invalid value 'SI'"),
        (&["validate", "case.toml"], "unexpected argument 'case.toml'"),
        (&["completions", "tcsh"], "invalid value 'tcsh'"),
        (
            &["uncertainty", "case.toml", "--seed", "-1"],
            "'-1' for '--seed <SEED>': it must be a whole number from 0 to 18446744073709551615",
        ),
        (&["batch", "a.csv", "-o", "-", "--threads", "1025"], "it must be a whole number from 1 to 1024"),
        (&["reconstruct", "case.toml", "--starts", "x"], "it must be a whole number from 1 to 10000"),
    ];
    for (arguments, says) in calls {
        let run = run(folder.path(), arguments);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}: {}", run.err);
        assert!(run.err.contains(says), "{arguments:?}: {}", run.err);
        // Without a verb the whole help is shown, and it mentions status 70.
        let never: &[&str] = if arguments.is_empty() { &["panicked", "\u{1b}"] } else { &["panicked", "\u{1b}", "defect"] };
        assert!(never.iter().all(|words| !run.err.contains(words)), "{arguments:?}: {}", run.err);
    }
}

#[test]
fn the_text_form_refuses_the_same() {
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.replace("2564 lb", "2564 ft").as_bytes());
    let (text, json) = (run(folder.path(), &["solve", "case.toml"]), run(folder.path(), &["solve", "case.toml", "--format=json"]));
    assert_eq!((text.status, text.out.as_str(), &text.err), (2, "", &json.err));
    folder.write("case.toml", COLLISION.replace("40 ft/s", "-40 ft/s").as_bytes());
    let (text, si) = (run(folder.path(), &["solve", "case.toml"]), run(folder.path(), &["solve", "case.toml", "--units", "si"]));
    assert_eq!((text.status, text.out.as_str(), si.status, si.out.as_str()), (3, "", 3, ""));
    assert!(text.err.contains("-40.00 ft/s") && si.err.contains("-12.19 m/s"), "in the units asked for: {} {}", text.err, si.err);
}

#[test]
fn a_name_that_begins_with_a_dash() {
    let folder = Folder::new();
    folder.write("-dash.toml", COLLISION.as_bytes());
    assert_eq!(run(folder.path(), &["solve", "--", "-dash.toml"]).status, 0);
    let refused = run(folder.path(), &["solve", "-dash.toml"]);
    assert!(refused.status == 2 && refused.err.contains("a file as ./-name"), "{}", refused.err);
    assert_eq!(run(folder.path(), &["solve", "./-dash.toml"]).status, 0);
    // The same of a value, which `--` would not reach.
    let refused = run(folder.path(), &["report", "./-dash.toml", "--date", "-x"]);
    assert!(refused.status == 2 && refused.err.contains("as in --option=-1"), "{}", refused.err);
    assert!(run(folder.path(), &["report", "./-dash.toml", "--date=-x"]).out.contains("<td>-x</td>"));
}

#[test]
fn nothing_is_left_behind() {
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.as_bytes());
    for format in ["text", "json"] {
        run(folder.path(), &["solve", "case.toml", "--format", format]);
    }
    let files = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(files, 1);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk() {
    use crate::process::planar_impact;
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.as_bytes());
    let calls: [&[&str]; 8] = [
        &["formula", "W_n"],
        &["solve", "case.toml"],
        &["solve", "case.toml", "--format", "json"],
        &["validate"],
        &["validate", "--figure", "7"],
        &["man"],
        &["completions", "bash"],
        &["--help"],
    ];
    for arguments in calls {
        let full = std::fs::File::create("/dev/full").expect("Linux has it");
        let child = planar_impact(folder.path()).args(arguments).stdout(full).stderr(std::process::Stdio::piped()).spawn();
        let run = crate::process::Run::of(child.expect("the program starts").wait_with_output().expect("the program ends"));
        assert_eq!(run.status, 74, "{arguments:?}: {}", run.err);
        assert!(run.err.starts_with("error: the output cannot be written: "), "{arguments:?}: {}", run.err);
        assert!(!run.err.contains("panicked") && !run.err.contains("defect"), "{}", run.err);
    }
}

/// What is said of rows beside the table is lost, and nothing of the table.
#[cfg(target_os = "linux")]
#[test]
fn a_standard_error_that_is_full() {
    use crate::process::planar_impact;
    let folder = Folder::new();
    folder.write("case.toml", COLLISION.as_bytes());
    folder.write("rows.csv", b"vehicle.1.speed,e\n12,0.1\n-90,0.2\nfast,0.3\n");
    let solve = |output: &str, stderr: std::process::Stdio| {
        let call = ["batch", "rows.csv", "--case", "case.toml", "-o", output];
        planar_impact(folder.path()).args(call).stderr(stderr).spawn().expect("it starts").wait().expect("it ends").code()
    };
    let full = std::fs::File::create("/dev/full").expect("Linux has it");
    assert_eq!((solve("heard.csv", std::process::Stdio::null()), solve("unheard.csv", full.into())), (Some(1), Some(1)));
    let table = |name: &str| std::fs::read(folder.path().join(name)).expect("a table");
    assert_eq!(table("heard.csv"), table("unheard.csv"));
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 4);
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_seen_enough() {
    use crate::process::planar_impact;
    let mut child = planar_impact(&crate::process::workspace())
        .args(["validate", "--format", "json"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    // As `head` does, but earlier.
    drop(child.stdout.take());
    let run = crate::process::Run::of(child.wait_with_output().expect("the program ends"));
    assert_eq!((run.status, run.err.as_str()), (0, ""));
}
