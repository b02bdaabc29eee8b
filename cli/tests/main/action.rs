//! The action for GitHub and the hook for pre-commit: their commands, as they are, with this program.

use std::path::Path;
use std::process::Command;

use crate::process::{Folder, Run, workspace};

/// Runs the script of the action with its inputs.
fn action(folder: &Path, files: &str, fail_on: &str, tolerance: &str) -> Run {
    let inputs = [("FILES", files), ("FAIL_ON", fail_on), ("TOLERANCE", tolerance), ("SARIF", "found.sarif")];
    let mut script = Command::new(workspace().join("action/check"));
    script.current_dir(folder).envs(inputs).env("PLANAR_IMPACT", env!("CARGO_BIN_EXE_planar-impact"));
    Run::of(script.output().expect("bash"))
}

fn copy(folder: &Folder, example: &str, name: &str) {
    let bytes = std::fs::read(workspace().join("cli/examples/check").join(example)).expect("an example");
    folder.write(name, &bytes);
}

/// The number of findings in the SARIF that a run leaves, which it takes away.
fn findings(folder: &Folder) -> Option<usize> {
    let path = folder.path().join("found.sarif");
    let text = std::fs::read_to_string(&path).ok()?;
    std::fs::remove_file(path).expect("the file is there");
    let found: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    Some(found["runs"][0]["results"].as_array().expect("results").len())
}

#[test]
fn the_action_checks_files_and_leaves_their_findings() {
    let folder = Folder::new();
    copy(&folder, "engine.jsonl", "sound one.jsonl");
    copy(&folder, "engine.jsonl", "sound.jsonl");
    copy(&folder, "paper-table-2.csv", "wrong.csv");
    let sound = action(folder.path(), "s?und.jsonl", "fail", "");
    assert_eq!((sound.status, sound.err.as_str(), findings(&folder)), (0, "", Some(0)), "{}", sound.out);
    assert!(sound.out.contains("3 records: 3 pass"), "{}", sound.out);
    let both = action(folder.path(), "sound.jsonl wrong.csv", "fail", "");
    assert_eq!(both.status, 1, "{}{}", both.out, both.err);
    assert!(findings(&folder) >= Some(1) && both.out.contains("fail"), "{}", both.out);
    // What is no severity, no tolerance and no file leaves no findings behind.
    for (files, fail_on, tolerance, told) in [
        ("sound.jsonl", "never", "", "never"),
        ("sound.jsonl", "fail", "2", "0.5"),
        ("none.jsonl", "fail", "", "none.jsonl"),
        ("", "fail", "", "<FILES>"),
        ("--rules", "fail", "", "--rules"),
    ] {
        let refused = action(folder.path(), files, fail_on, tolerance);
        assert_eq!((refused.status, refused.out.as_str(), findings(&folder)), (2, "", None), "{files} {fail_on}: {}", refused.err);
        assert!(refused.err.contains(told), "{}", refused.err);
    }
}

/// Every input of the action reaches the script by the environment, and no other text of it.
#[test]
fn the_action_passes_every_input() {
    let text = std::fs::read_to_string(workspace().join("action/action.yml")).expect("the action");
    let script = std::fs::read_to_string(workspace().join("action/check")).expect("its script");
    for (variable, input) in [("FILES", "files"), ("FAIL_ON", "fail-on"), ("TOLERANCE", "tolerance"), ("SARIF", "sarif")] {
        assert_eq!(text.matches(&format!("\n        {variable}: ${{{{ inputs.{input} }}}}\n")).count(), 1, "{input}");
        assert!(text.contains(&format!("\n  {input}:\n")) && script.contains(&format!("${variable}")), "{input}");
    }
    assert_eq!(text.matches("inputs.").count(), 4);
}

#[test]
fn the_hook_checks_the_files_that_it_is_given() {
    let text = std::fs::read_to_string(workspace().join(".pre-commit-hooks.yaml")).expect("the hook");
    let entry = text.lines().find_map(|line| line.strip_prefix("  entry: planar-impact ")).expect("a command");
    let example = |name: &str| workspace().join("cli/examples/check").join(name).display().to_string();
    let hook = |names: &[&str]| {
        let paths = names.iter().map(|name| example(name));
        let mut command = Command::new(env!("CARGO_BIN_EXE_planar-impact"));
        Run::of(command.args(entry.split(' ')).args(paths).output().expect("the program"))
    };
    assert_eq!(hook(&["engine.jsonl", "collision.json"]).status, 0);
    assert_eq!(hook(&["engine.jsonl", "paper-table-2.csv"]).status, 1);
}
