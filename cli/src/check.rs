//! The verb `check`: reads, checks and prints records one by one, in memory that does not grow with their number.

mod progress;
mod report;

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

use planar_impact_app::check::{Entries, Entry, Options, Severity, Summary, rules};
use planar_impact_app::json::Layout;
use planar_impact_app::{Cause, Issues};
use planar_impact_report::document::CheckDigest;
use planar_impact_report::page;

use crate::arguments::{Check, CheckFormat, FailOn};
use crate::exit::{Failure, Status};
use crate::output::{self, CommandOutput};
use crate::{files, interrupt};
use progress::Progress;
use report::Report;

/// Number of bytes of a report that are buffered before they are written.
const CHUNK: usize = 1 << 16;

/// Checks every record of every file and prints the findings.
///
/// # Errors
///
/// Returns every issue that makes a file unusable, or fails if the output cannot be written.
pub fn run(call: &Check) -> Result<CommandOutput, Failure> {
    if call.rules {
        return match call.format {
            CheckFormat::Text => Ok(CommandOutput::page(&page::rules::page(&rules::rules()))),
            CheckFormat::Json => CommandOutput::json(&rules::rules(), Layout::Pretty),
            CheckFormat::Junit | CheckFormat::Sarif => {
                let message = "the rules are printed as text or json; a SARIF report has them too";
                Err(Failure::of_options(message))
            }
        };
    }
    let bytes = Arc::new(AtomicU64::new(0));
    let (files, size) = open(&call.files, Options { tolerance: call.tolerance }, &bytes)?;
    interrupt::note();
    let mut writer = ReportWriter {
        report: report::of(call.format, call.fail_on),
        summary: Summary::default(),
        text: Vec::with_capacity(2 * CHUNK),
        progress: Progress::new(size, bytes),
        worst: None,
    };
    writer.all(files)?;
    let output = CommandOutput::text(String::new());
    if interrupt::is_interrupted() {
        return Ok(output.with(Status::Interrupted));
    }
    Ok(output.holds(!writer.worst.is_some_and(|worst| call.fail_on.includes(worst))))
}

/// Checks every record of every file and keeps what a report shows. Returns `false` if a record breaks a law.
///
/// # Errors
///
/// Every issue that makes a file unusable.
pub fn digest(paths: &[PathBuf], digest: &mut CheckDigest) -> Result<bool, Failure> {
    let bytes = Arc::new(AtomicU64::new(0));
    let (files, size) = open(paths, Options::default(), &bytes)?;
    interrupt::note();
    let (mut progress, mut summary, mut holds) = (Progress::new(size, bytes), Summary::default(), true);
    for entries in files {
        let name = entries.name().to_owned();
        digest.file(&name);
        for entry in entries.take_while(|_| !interrupt::is_interrupted()) {
            let entry = entry?;
            holds &= !entry.worst().is_some_and(|worst| FailOn::Fail.includes(worst));
            summary.add(&entry);
            progress.update(&summary);
            digest.add(&name, &entry);
        }
    }
    progress.clear();
    Ok(holds)
}

/// Opens every file, or reports the issues of each unusable one. Also returns the total size of the files in bytes, if it is known.
fn open(paths: &[PathBuf], options: Options, bytes: &Arc<AtomicU64>) -> Result<(Vec<Entries>, Option<u64>), Issues> {
    let (mut files, mut issues) = (Vec::new(), Vec::new());
    let (mut size, mut stdin_is_taken) = (Some(0), false);
    for path in paths {
        if path.as_os_str() == "-" && std::mem::replace(&mut stdin_is_taken, true) {
            issues.push(files::read_twice());
            continue;
        }
        match files::records(path, options, bytes) {
            Ok((file, of_file)) => {
                size = size.zip(of_file).map(|(size, of_file)| size + of_file);
                files.push(file);
            }
            Err(found) => issues.extend_from_slice(found.list()),
        }
    }
    if issues.is_empty() { Ok((files, size)) } else { Err(Issues::without_source(Cause::Input, issues)) }
}

/// Writes a report incrementally.
struct ReportWriter {
    report: Box<dyn Report>,
    summary: Summary,
    text: Vec<u8>,
    progress: Progress,
    worst: Option<Severity>,
}

impl ReportWriter {
    /// Writes every record of every file. An interrupted report is still a complete document.
    fn all(&mut self, files: Vec<Entries>) -> Result<(), Failure> {
        self.report.begin(&mut self.text).map_err(Failure::Output)?;
        for entries in files {
            if interrupt::is_interrupted() {
                break;
            }
            let name = entries.name().to_owned();
            self.report.begin_file(&mut self.text, &name).map_err(Failure::Output)?;
            for entry in entries {
                self.entry(&name, &entry?).map_err(Failure::Output)?;
                if interrupt::is_interrupted() {
                    break;
                }
            }
            self.report.end_file(&mut self.text).map_err(Failure::Output)?;
        }
        self.report.end(&mut self.text, &self.summary, interrupt::is_interrupted()).map_err(Failure::Output)?;
        self.progress.clear();
        self.write().map_err(Failure::Output)
    }

    fn entry(&mut self, file: &str, entry: &Entry) -> io::Result<()> {
        self.worst = self.worst.max(entry.worst());
        self.summary.add(entry);
        self.progress.update(&self.summary);
        self.report.record(&mut self.text, file, entry)?;
        if self.text.len() < CHUNK { Ok(()) } else { self.write() }
    }

    fn write(&mut self) -> io::Result<()> {
        let written = self.progress.aside(|| output::write(&self.text));
        self.text.clear();
        written
    }
}
