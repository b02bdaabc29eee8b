//! Runs the program, and creates temporary folders.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The result of a run of the program.
pub struct Run {
    /// The exit status.
    pub status: i32,
    /// All of standard output.
    pub out: String,
    /// All of standard error.
    pub err: String,
}

impl Run {
    /// Collects the output of a finished process.
    pub fn of(output: Output) -> Run {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
        let status = output.status.code().expect("the program ends by itself");
        let run = Run { status, out: text(output.stdout), err: text(output.stderr) };
        crate::words::compare(&run.out, &run.err);
        run
    }
}

impl Run {
    /// Fails unless the run succeeds, with nothing but notes on standard error.
    pub fn succeeds(&self, call: &dyn std::fmt::Debug) {
        let has_notes_alone = self.err.lines().all(|line| line.starts_with("note: "));
        assert!(self.status == 0 && has_notes_alone, "{call:?}: {} {}", self.status, self.err);
    }
}

/// Returns the command of the program in a folder, without the environment variables that change its output.
pub fn planar_impact(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_planar-impact"));
    command.current_dir(folder).stdin(Stdio::null()).env_remove("RUST_BACKTRACE").env_remove("CLICOLOR_FORCE");
    command
}

/// Runs the program in a folder.
pub fn run(folder: &Path, arguments: &[&str]) -> Run {
    Run::of(planar_impact(folder).args(arguments).output().expect("the program starts"))
}

/// Runs the program with a text on standard input.
pub fn run_with_input(arguments: &[&str], input: &str) -> Run {
    let mut command = planar_impact(&std::env::temp_dir());
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    // Dropping the pipe closes it, so that the program reads to the end.
    let sent = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    let run = Run::of(child.wait_with_output().expect("the program ends"));
    // A call that is refused by its arguments may end before it reads.
    let is_refused = run.status == 2 && sent.as_ref().is_err_and(|error| error.kind() == ErrorKind::BrokenPipe);
    assert!(sent.is_ok() || is_refused, "{arguments:?} leaves input unread: {sent:?}, {} {}", run.status, run.err);
    run
}

/// Returns the root of the workspace, where the manual's examples are run.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate is a folder of the workspace").to_owned()
}

/// Returns the case files shipped with the program.
pub fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    paths.sort();
    assert!(paths.len() >= 5, "{paths:?}");
    paths
}

/// A temporary folder, removed when dropped.
pub struct Folder(PathBuf);

impl Folder {
    /// Creates an empty folder.
    pub fn new() -> Folder {
        static MADE: AtomicUsize = AtomicUsize::new(0);
        let name = format!("planar-impact-test-{}-{}", std::process::id(), MADE.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir(&path).expect("the folder is new");
        Folder(path)
    }

    /// Returns its path.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file in it.
    pub fn write(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("a file is in a folder")).expect("a folder");
        fs::write(&path, bytes).expect("the file can be written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Failure to remove a temporary folder does not fail the test.
        let _ = fs::remove_dir_all(&self.0);
    }
}
