//! Files that cannot be written, a program that is killed, and inputs that are too large: a file is whole or not there, and memory stays flat.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::process::{Folder, Run, planar_impact, run, workspace};

fn position_a() -> String {
    workspace().join("cli/examples/position-a.toml").display().to_string()
}

/// The names in a folder, but for files that the program leaves when it is killed: they begin with its name and a dot.
fn files(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| !name.starts_with(".planar-impact-")).collect();
    names.sort();
    names
}

/// The calls that write a file of a name.
fn calls(output: &str) -> [Vec<String>; 3] {
    let speeds = workspace().join("cli/examples/batch/speeds.csv").display().to_string();
    let case = position_a();
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    [
        words(&["report", &case, "-o", &format!("{output}.html")]),
        words(&["draw", &case, "-o", &format!("{output}.svg")]),
        words(&["batch", &speeds, "--case", &case, "-o", &format!("{output}.parquet")]),
    ]
}

fn all_fail(folder: &Path, output: &str, why: &str) {
    for call in calls(output) {
        let arguments: Vec<&str> = call.iter().map(String::as_str).collect();
        let run = run(folder, &arguments);
        assert_eq!((run.status, run.out.as_str()), (74, ""), "{call:?}: {}", run.err);
        assert!(run.err.contains("cannot be written"), "{why}: {}", run.err);
    }
}

/// /proc is a folder in which not even root can make a file.
#[test]
fn a_folder_that_cannot_be_written() {
    let folder = Folder::new();
    all_fail(folder.path(), "/proc/x", "a read-only folder");
    all_fail(folder.path(), "no/such/folder/x", "a folder that is not there");
    assert_eq!(files(folder.path()), Vec::<String>::new());
}

/// What is read is never replaced by what is computed from it, by whatever path the call names it.
#[test]
fn an_input_is_not_written_over() {
    let folder = Folder::new();
    let case = fs::read_to_string(position_a()).expect("an example");
    folder.write("case.toml", case.as_bytes());
    folder.write("speeds.csv", b"vehicle.1.speed\n17\n");
    fs::create_dir(folder.path().join("inner")).expect("a folder");
    std::os::unix::fs::symlink("case.toml", folder.path().join("link.csv")).expect("a link");
    for call in [
        &["report", "case.toml", "-o", "case.toml"][..],
        &["draw", "case.toml", "-o", "inner/../case.toml"],
        &["batch", "speeds.csv", "--case", "case.toml", "-o", "speeds.csv"],
        &["batch", "speeds.csv", "--case", "case.toml", "-o", "link.csv"],
    ] {
        let run = run(folder.path(), call);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{call:?}: {}", run.err);
        assert!(run.err.contains("is read by this call, and would be replaced; name another file to write"), "{call:?}: {}", run.err);
    }
    assert_eq!(fs::read_to_string(folder.path().join("case.toml")).expect("it is there"), case);
    let written = run(folder.path(), &["batch", "speeds.csv", "--case", "case.toml", "-o", "other.csv"]);
    assert_eq!(written.status, 0, "{}", written.err);
    assert_eq!(files(folder.path()), ["case.toml", "inner", "link.csv", "other.csv", "speeds.csv"]);
}

/// A drawing is no picture of pixels, and a report no PDF, whatever their names say.
#[test]
fn a_name_of_another_format_is_refused() {
    let folder = Folder::new();
    let case = workspace().join("cli/examples/position-a.toml");
    let case = case.to_str().expect("a plain path");
    for (call, ending) in [
        (["draw", case, "-o", "a.png"], ".svg"),
        (["draw", case, "-o", "a.JSON"], ".svg"),
        (["report", case, "-o", "a.pdf"], ".html"),
        // Most likely another case or recording, in a slip.
        (["draw", case, "-o", "a.toml"], ".svg"),
        (["report", case, "-o", "a.csv"], ".html"),
    ] {
        let run = run(folder.path(), &call);
        assert_eq!(run.status, 2, "{}", run.err);
        assert!(run.err.contains(&format!("`{}` has the name of another format; let it end in {ending}", call[3])), "{}", run.err);
        assert!(!folder.path().join(call[3]).exists());
    }
    for call in [&["draw", case, "-o", "a.svg"][..], &["draw", case, "-o", "a"], &["draw", case, "-o", "a.json", "--format", "json"]] {
        assert_eq!(run(folder.path(), call).status, 0, "{call:?}");
        assert!(folder.path().join(call[3]).exists(), "{call:?}");
    }
}

/// A pipe stays a pipe, and its reader gets the whole document; a link stays a link, and what it leads to is replaced.
#[test]
fn what_is_no_file_is_written_and_not_replaced() {
    use std::os::unix::fs::FileTypeExt;
    let folder = Folder::new();
    let case = position_a();
    let plain = run(folder.path(), &["draw", &case]).out;
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().is_ok_and(|made| made.success()));
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read_to_string(pipe)
    });
    let drawn = run(folder.path(), &["draw", &case, "-o", "pipe"]);
    assert_eq!(drawn.status, 0, "{}", drawn.err);
    assert_eq!(reader.join().expect("no panic").expect("it can be read"), plain);
    assert!(fs::symlink_metadata(&pipe).expect("it is there").file_type().is_fifo());
    fs::create_dir(folder.path().join("inner")).expect("a folder");
    folder.write("inner/old.svg", b"old");
    std::os::unix::fs::symlink("inner/old.svg", folder.path().join("link.svg")).expect("a link");
    assert_eq!(run(folder.path(), &["draw", &case, "-o", "link.svg"]).status, 0);
    assert!(fs::symlink_metadata(folder.path().join("link.svg")).expect("it is there").is_symlink());
    assert_eq!(fs::read_to_string(folder.path().join("inner/old.svg")).expect("it is there"), plain);
    // What the system makes of a pipe in its place.
    let printed = run(folder.path(), &["draw", &case, "-o", "/dev/stdout"]);
    assert_eq!((printed.status, printed.out == plain), (0, true), "{}", printed.err);
    // What is replaced keeps who may read it.
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(folder.path().join("inner/old.svg"), fs::Permissions::from_mode(0o600)).expect("its owner may");
    assert_eq!(run(folder.path(), &["draw", &case, "-o", "link.svg"]).status, 0);
    assert_eq!(fs::metadata(folder.path().join("inner/old.svg")).expect("it is there").permissions().mode() & 0o777, 0o600);
    // A link that leads to nothing yet, and two that lead to each other.
    std::os::unix::fs::symlink("inner/new.svg", folder.path().join("to-new.svg")).expect("a link");
    assert_eq!(run(folder.path(), &["draw", &case, "-o", "to-new.svg"]).status, 0);
    assert!(fs::symlink_metadata(folder.path().join("to-new.svg")).expect("it is there").is_symlink());
    assert_eq!(fs::read_to_string(folder.path().join("inner/new.svg")).expect("it is there"), plain);
    for (link, target) in [("one.svg", "other.svg"), ("other.svg", "one.svg")] {
        std::os::unix::fs::symlink(target, folder.path().join(link)).expect("a link");
    }
    let circle = run(folder.path(), &["draw", &case, "-o", "one.svg"]);
    assert!(circle.status == 74 && circle.err.contains("its links lead to each other"), "{}", circle.err);
    let nowhere = run(folder.path(), &["draw", &case, "-o", "nowhere/x.svg"]);
    assert!(nowhere.status == 74 && nowhere.err.contains("there is no folder nowhere"), "{}", nowhere.err);
    let into_folder = run(folder.path(), &["draw", &case, "-o", "inner"]);
    assert_eq!((into_folder.status, into_folder.out.as_str()), (74, ""), "{}", into_folder.err);
}

/// A pipe without a reader is waited for, and an interrupt ends that.
#[test]
fn an_interrupt_ends_the_wait_for_the_reader_of_a_pipe() {
    let folder = Folder::new();
    assert!(Command::new("mkfifo").arg(folder.path().join("pipe")).status().is_ok_and(|made| made.success()));
    let mut child =
        planar_impact(folder.path()).args(["draw", &position_a(), "-o", "pipe"]).stderr(Stdio::null()).spawn().expect("it starts");
    std::thread::sleep(Duration::from_secs(1));
    assert!(child.try_wait().expect("its status").is_none());
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().is_ok_and(|sent| sent.success()));
    let ended = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(50));
        child.try_wait().expect("its status")
    });
    child.kill().ok();
    assert_eq!(ended.and_then(|status| status.code()), Some(130));
}

/// A disk of a page: the file before stays as it was, and nothing else is left.
#[test]
fn a_full_disk_leaves_the_file_before() {
    let folder = Folder::new();
    let disk = folder.path().join("disk");
    fs::create_dir(&disk).expect("a folder");
    let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=4k", "tmpfs"]).arg(&disk).stderr(Stdio::null()).status();
    if !mounted.is_ok_and(|status| status.success()) {
        eprintln!("not tested: a small disk cannot be mounted without privileges");
        return;
    }
    fs::write(disk.join("x.html"), "before").expect("it has room");
    let runs = calls("disk/x").map(|call| {
        let arguments: Vec<&str> = call.iter().map(String::as_str).collect();
        run(folder.path(), &arguments)
    });
    let (left, before) = (fs::read_dir(&disk).map(Iterator::count), fs::read_to_string(disk.join("x.html")));
    let unmounted = Command::new("umount").arg(&disk).status();
    assert!(unmounted.is_ok_and(|status| status.success()), "the disk is busy");
    for Run { status, out, err } in &runs {
        assert_eq!((*status, out.as_str()), (74, ""), "{err}");
        assert!(err.contains("No space left"), "{err}");
    }
    assert_eq!((left.ok(), before.ok().as_deref()), (Some(1), Some("before")));
}

/// Killed at some moment, a call leaves under the name the whole file, the file before, or none.
#[test]
fn a_killed_program_leaves_no_half_written_file() {
    let folder = Folder::new();
    let rows: String = (0..40_000).map(|i| format!("{},0.1\n", 20.0 + f64::from(i) / 1000.0)).collect();
    folder.write("speeds.csv", format!("vehicle.1.speed [mph],contact.restitution\n{rows}").as_bytes());
    let case = position_a();
    for call in [["batch", "speeds.csv", "--case", &case, "-o", "out.csv"], ["report", &case, "--units", "si", "-o", "out.html"]] {
        let output = folder.path().join(call[call.len() - 1]);
        let whole = run(folder.path(), &call);
        assert!(whole.status == 0 || whole.status == 1, "{}", whole.err);
        let whole = fs::read(&output).expect("the file");
        let mut killed = 0;
        for delay in [1, 4, 9, 20, 45, 90] {
            fs::remove_file(&output).ok();
            let mut child = planar_impact(folder.path()).args(call).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
            std::thread::sleep(Duration::from_millis(delay));
            killed += u32::from(child.try_wait().expect("its status").is_none());
            child.kill().ok();
            child.wait().expect("it has ended");
            match fs::read(&output) {
                Ok(found) => assert!(found == whole, "{call:?}: half a file after {delay} ms"),
                Err(error) => assert_eq!(error.kind(), std::io::ErrorKind::NotFound),
            }
        }
        assert!(killed > 0, "{call:?} was never killed");
        fs::remove_file(&output).ok();
    }
    assert_eq!(files(folder.path()), ["speeds.csv"]);
}

/// What is too large is refused in seconds, within a gigabyte of addresses.
#[test]
fn hostile_sizes_are_refused() {
    let folder = Folder::new();
    let case = fs::read_to_string(position_a()).expect("an example");
    let (first, second) = case.split_at(case.rfind("[[vehicle]]").expect("two vehicles"));
    let crush =
        format!("[vehicle.crush]\nwidth = 1\ndepths = [{}]\nstiffness = {{ A = \"60 kN/m\", B = \"500 kPa\" }}\n", "0,".repeat(1_000_000));
    folder.write("depths.toml", format!("{first}{crush}{second}").as_bytes());
    folder.write(
        "unknowns.toml",
        (case.clone() + "[unknown]\n" + &(0..10_000).map(|i| format!("x{i} = 1\n")).collect::<String>()).as_bytes(),
    );
    folder.write("deep.json", "[".repeat(1_000_000).as_bytes());
    folder.write("deep.toml", format!("a = {}", "[".repeat(1_000_000)).as_bytes());
    let case = position_a();
    for (words, message) in [
        (vec!["crush", "depths.toml"], "at most 20000 values"),
        (vec!["reconstruct", "unknowns.toml"], "nothing has this name"),
        (vec!["solve", "deep.json"], "deep"),
        (vec!["solve", "deep.toml"], ""),
        (vec!["sweep", &case, "--vary", "e=0:1:1e-9"], "the most is"),
        (vec!["sweep", &case, "--vary", "e=0:0.3:1e-5", "--vary", "Gamma=-1 deg:1 deg:0.0001 deg"], "the most is"),
    ] {
        let mut shell = Command::new("sh");
        shell.current_dir(folder.path()).args([
            "-c",
            "ulimit -v 1048576; ulimit -t 5; exec \"$@\"",
            "sh",
            env!("CARGO_BIN_EXE_planar-impact"),
        ]);
        let run = Run::of(shell.args(&words).output().expect("a shell"));
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{words:?}: {}", run.err);
        assert!(run.err.contains(message), "{words:?}: {}", run.err);
    }
}
