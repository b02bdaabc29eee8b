//! The verb `check`: collision results of any program against the laws of mechanics.
//!
//! Every file is opened and looked at before anything is printed; then the records are read, checked and told one by one, in memory that does not grow with their
//! number.

mod complaint;
mod csv;
mod document;
mod draft;
mod entry;
mod header;
mod input;
mod json;
mod jsonl;
mod lines;
mod progress;
mod report;
mod rules;
mod stream;
mod units;

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

use clap::CommandFactory;
use clap::error::ErrorKind;
use planar_impact::check::Options;

use crate::Done;
use crate::arguments::{Arguments, Check, CheckFormat};
use crate::document::{Problem, Problems, Source};
use crate::exit::{Failure, Status};
use entry::Entry;
use input::{Input, Trouble};
use progress::Progress;
use report::{Report, Summary};
use stream::Stream;

/// How much of a report is gathered before it is written.
const CHUNK: usize = 1 << 16;

/// Checks every record of every file and tells what was found.
///
/// # Errors
///
/// Everything for which a file cannot be used; or when the output cannot be written.
pub fn run(call: &Check) -> Result<Done, Failure> {
    if call.rules {
        return match call.format {
            CheckFormat::Text => Ok(Done::with(rules::text())),
            CheckFormat::Json => rules::json().map(Done::with).map_err(|error| Failure::Data(error.to_string())),
            CheckFormat::Junit | CheckFormat::Sarif => {
                let message = "the rules are printed as text or json; a SARIF report has them too";
                Err(Failure::Call(Arguments::command().error(ErrorKind::ArgumentConflict, message)))
            }
        };
    }
    let inputs = open(&call.files)?;
    let bytes = Arc::new(AtomicU64::new(0));
    let size = inputs.iter().map(Input::size).sum();
    let mut told = Told {
        report: report::of(call.format, call.fail_on),
        summary: Summary::default(),
        text: Vec::with_capacity(2 * CHUNK),
        progress: Progress::new(size, bytes.clone()),
        worst: None,
    };
    let read = told.all(inputs, &bytes, &Options { tolerance: call.tolerance });
    let status = if told.worst.is_some_and(|worst| call.fail_on.includes(worst)) { Status::DoesNotHold } else { Status::Done };
    match read {
        Ok(()) => Ok(Done { text: String::new(), status }),
        // The reader has seen enough, as `head` does.
        Err(Stopped::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Done { text: String::new(), status }),
        Err(Stopped::Output(error)) => Err(Failure::Output(error)),
        Err(Stopped::Input(problems)) => Err(Failure::Input(problems)),
    }
}

/// Opens every file, or says what is wrong with each that cannot be used.
fn open(files: &[PathBuf]) -> Result<Vec<Input>, Failure> {
    let (mut inputs, mut problems) = (Vec::new(), Vec::new());
    let mut stdin_is_taken = false;
    for path in files {
        if path.as_os_str() == "-" && std::mem::replace(&mut stdin_is_taken, true) {
            problems.push(Problem::of_file("standard input can be read only once; `-` stands twice".to_owned()));
            continue;
        }
        match Input::open(path) {
            Ok(input) => inputs.push(input),
            Err(found) => {
                let name = if path.as_os_str() == "-" { "<stdin>".to_owned() } else { path.display().to_string() };
                problems.extend(placed(&name, found));
            }
        }
    }
    if problems.is_empty() { Ok(inputs) } else { Err(Failure::Input(bare(problems))) }
}

/// Each problem with its file and line.
fn placed(file: &str, found: Vec<input::Problem>) -> Vec<Problem> {
    let place = |line: Option<u64>| line.map_or(format!("`{file}`"), |line| format!("`{file}`, line {line}"));
    let mut problems = Vec::new();
    for (line, complaints) in found {
        problems.extend(complaints.iter().map(|complaint| Problem::of_file(format!("{}: {complaint}", place(line)))));
    }
    problems
}

/// Problems of several files, whose texts are not at hand.
fn bare(problems: Vec<Problem>) -> Problems {
    Problems::new(Source { name: String::new(), text: String::new() }.into(), problems)
}

/// Why reading or telling stopped.
enum Stopped {
    Input(Problems),
    Output(io::Error),
}

/// What has been told so far.
struct Told {
    report: Box<dyn Report>,
    summary: Summary,
    text: Vec<u8>,
    progress: Progress,
    worst: Option<planar_impact::check::Severity>,
}

impl Told {
    fn all(&mut self, inputs: Vec<Input>, bytes: &Arc<AtomicU64>, options: &Options) -> Result<(), Stopped> {
        self.report.begin(&mut self.text).map_err(Stopped::Output)?;
        for input in inputs {
            let file = input.name.clone();
            self.report.begin_file(&mut self.text, &file).map_err(Stopped::Output)?;
            // Ids and groups are those of a file.
            let mut stream = Stream::new(*options);
            let read = input.read(bytes, &mut |line, record| stream.take(line, record, &mut |entry| self.entry(&file, &entry)));
            read.map_err(|trouble| match trouble {
                Trouble::Input(problems) => Stopped::Input(bare(placed(&file, problems))),
                Trouble::Taker(error) => Stopped::Output(error),
            })?;
            stream.finish(&mut |entry| self.entry(&file, &entry)).map_err(Stopped::Output)?;
            self.report.end_file(&mut self.text).map_err(Stopped::Output)?;
        }
        self.report.end(&mut self.text, &self.summary).map_err(Stopped::Output)?;
        self.progress.clear();
        self.write().map_err(Stopped::Output)
    }

    fn entry(&mut self, file: &str, entry: &Entry) -> io::Result<()> {
        self.worst = self.worst.max(entry.worst());
        self.summary.add(entry);
        self.progress.update(&self.summary);
        self.report.record(&mut self.text, file, entry)?;
        if self.text.len() < CHUNK { Ok(()) } else { self.write() }
    }

    fn write(&mut self) -> io::Result<()> {
        let text = std::mem::take(&mut self.text);
        let written = self.progress.aside(|| {
            let mut output = io::stdout().lock();
            output.write_all(&text).and_then(|()| output.flush())
        });
        self.text = text;
        self.text.clear();
        written
    }
}
