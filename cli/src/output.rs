//! Output: all that the program writes passes through here, to standard output or to a file that appears when it is whole.

use std::fmt::Display;
#[cfg(unix)]
use std::fs::Permissions;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use planar_impact_app::Units;
use planar_impact_app::json::{self, Layout};
use planar_impact_app::notice::{Notice, Notices};
use planar_impact_app::plain_text::shown;
use planar_impact_report::{Block, text};
use serde::Serialize;
use tempfile::NamedTempFile;

use crate::exit::{Failure, Status};
use crate::interrupt;

/// The text that a verb prints or writes to a file, what it says beside it, and its status.
pub struct CommandOutput {
    text: String,
    notes: Vec<String>,
    file: Option<PathBuf>,
    status: Status,
}

impl CommandOutput {
    /// Creates the output of a text.
    pub fn text(text: String) -> CommandOutput {
        CommandOutput { text, notes: Vec::new(), file: None, status: Status::Done }
    }

    /// Creates the output of a page for people.
    pub fn page(blocks: &[Block]) -> CommandOutput {
        CommandOutput::text(text::render(blocks))
    }

    /// Creates the output of an answer for programs.
    ///
    /// # Errors
    ///
    /// Fails only because of a defect, because an answer is plain data.
    pub fn json(answer: &impl Serialize, layout: Layout) -> Result<CommandOutput, Failure> {
        Ok(CommandOutput::text(json::text(answer, layout)?))
    }

    /// Adds the notices of an answer, for standard error: the text is in a format that has no place for them.
    pub fn noting(self, notices: &Notices, units: Units) -> CommandOutput {
        let note = |notice: &Notice| format!("{}: {}", notice.severity, shown(&units.sentence(&notice.message)));
        CommandOutput { notes: notices.0.iter().map(note).collect(), ..self }
    }

    /// Sets the status according to whether everything checked holds.
    pub fn holds(self, holds: bool) -> CommandOutput {
        self.with(if holds { Status::Done } else { Status::DoesNotHold })
    }

    /// Sets the status.
    pub fn with(self, status: Status) -> CommandOutput {
        CommandOutput { status, ..self }
    }

    /// Writes the text to a file instead of standard output; `-` is standard output.
    pub fn to(self, file: Option<&Path>) -> CommandOutput {
        CommandOutput { file: file.filter(|file| file.as_os_str() != "-").map(Path::to_owned), ..self }
    }

    /// Prints the whole text, which is complete at this point.
    ///
    /// # Errors
    ///
    /// Fails if standard output or the file cannot be written.
    pub fn print(self) -> Result<Status, Failure> {
        if let Some(path) = &self.file {
            let mut file = OutputFile::create(path).map_err(Failure::Output)?;
            file.write_all(self.text.as_bytes()).map_err(Failure::Output)?;
            file.keep().map_err(Failure::Output)?;
        } else if !self.text.is_empty() {
            interrupt::note();
            write(self.text.as_bytes()).map_err(Failure::Output)?;
        }
        for note in &self.notes {
            say(note);
        }
        Ok(self.status)
    }
}

/// Says a line on standard error. One that is closed or full takes nothing from the answer.
pub fn say(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// A file that is written, and appears when it is whole. A device or a pipe stays what it is, and takes what is written at once.
pub enum OutputFile {
    /// A file beside its place.
    Beside(NamedTempFile, PathBuf),
    /// A device or a pipe.
    Straight(File),
}

impl OutputFile {
    /// Begins a file beside the one that it will replace, with its permissions, or those of any new file. Behind a link it replaces what the link leads to. From here on
    /// interrupts are noted, so that they leave no part of a file: but not while a pipe waits for its reader.
    ///
    /// # Errors
    ///
    /// Fails if the folder cannot be written, or if a folder is at the place.
    pub fn create(path: &Path) -> io::Result<OutputFile> {
        let name = |path: &Path| shown(&path.display().to_string()).into_owned();
        // The error of a temporary file names that file, which nobody has asked for.
        let of_path = |error: io::Error| io::Error::new(error.kind(), format!("{}: {}", name(path), io::Error::from(error.kind())));
        let known = path.metadata().ok();
        if known.as_ref().is_some_and(|known| !known.is_file()) {
            let file = OpenOptions::new().write(true).open(path).map_err(of_path);
            interrupt::note();
            return file.map(OutputFile::Straight);
        }
        interrupt::note();
        let Some(place) = behind_links(path) else {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, format!("{}: its links lead to each other", name(path))));
        };
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".planar-impact-");
        #[cfg(unix)]
        builder.permissions(<Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
        let file = builder.tempfile_in(folder).map_err(|error| match error.kind() {
            kind @ io::ErrorKind::NotFound => io::Error::new(kind, format!("{}: there is no folder {}", name(path), name(folder))),
            _ => of_path(error),
        })?;
        if let Some(known) = known {
            file.as_file().set_permissions(known.permissions()).map_err(of_path)?;
        }
        Ok(OutputFile::Beside(file, place))
    }

    /// Puts the complete file at its place.
    ///
    /// # Errors
    ///
    /// Fails if the file cannot be written.
    pub fn keep(self) -> io::Result<()> {
        if let OutputFile::Beside(file, place) = self {
            file.as_file().sync_all()?;
            file.persist(place)?;
        }
        Ok(())
    }
}

/// Returns the place that a path leads to through links, whether or not something is there; `None` if they lead to each other.
fn behind_links(path: &Path) -> Option<PathBuf> {
    /// Most links in a row, as many as the system follows.
    const MOST: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MOST {
        let Ok(target) = place.read_link() else { return Some(place) };
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    None
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            // Errors of the temporary file itself do not name it.
            OutputFile::Beside(file, _) => file.as_file_mut().write(bytes),
            OutputFile::Straight(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            OutputFile::Beside(file, _) => file.as_file_mut().flush(),
            OutputFile::Straight(file) => file.flush(),
        }
    }
}

/// Writes to standard output. A reader that stops early, such as `head`, is not a failure.
///
/// # Errors
///
/// Fails if standard output cannot be written.
pub fn write(text: &[u8]) -> io::Result<()> {
    if closed::at_start() {
        return Err(io::Error::other("standard output is closed"));
    }
    let mut output = standard_output()?;
    match output.write_all(text).and_then(|()| output.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

/// Returns standard output itself: that of the library takes what is written to a file that is open for reading alone, and tells nothing.
#[cfg(unix)]
fn standard_output() -> io::Result<File> {
    use std::os::fd::AsFd;
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

#[cfg(not(unix))]
fn standard_output() -> io::Result<io::StdoutLock<'static>> {
    Ok(io::stdout().lock())
}

/// Writes a whole file to standard output.
///
/// # Errors
///
/// Fails if the file cannot be read, or standard output cannot be written.
pub fn copy(mut file: File) -> io::Result<()> {
    file.rewind()?;
    let mut part = vec![0; 1 << 18];
    loop {
        match file.read(&mut part)? {
            0 => return Ok(()),
            read => write(&part[..read])?,
        }
    }
}

/// Detects whether standard output was closed when the program started. Rust's runtime opens /dev/null in its place
/// before `main`, and writing there succeeds, so the check runs before the runtime starts.
mod closed {
    use std::sync::atomic::{AtomicBool, Ordering};

    static CLOSED: AtomicBool = AtomicBool::new(false);

    #[cfg(target_os = "linux")]
    #[ctor::ctor(unsafe)]
    fn look() {
        // The link exists if and only if the descriptor is open; without /proc the state is unknown.
        let is_closed = std::fs::symlink_metadata("/proc/self/fd").is_ok() && std::fs::symlink_metadata("/proc/self/fd/1").is_err();
        CLOSED.store(is_closed, Ordering::Relaxed);
    }

    pub fn at_start() -> bool {
        CLOSED.load(Ordering::Relaxed)
    }
}
