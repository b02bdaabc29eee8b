//! Issues as Python exceptions.

use planar_impact_app::{Cause, Issue, Issues, Units};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// A failed verb, with the units of its reader.
pub struct Failure {
    /// What is wrong.
    pub issues: Issues,
    /// Units of the figures in messages.
    pub units: Units,
    /// Whether lines of the source mean something to the caller.
    pub has_lines: bool,
}

impl From<Issues> for Failure {
    fn from(issues: Issues) -> Self {
        Failure { issues, units: Units::Si, has_lines: true }
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> PyErr {
        match failure.issues.cause() {
            Cause::Interrupted => PyKeyboardInterrupt::new_err(()),
            Cause::Defect => PyRuntimeError::new_err(format!("a defect of planar-impact, please report it: {}", failure.issues)),
            Cause::Input => raise("CaseError", &failure),
            Cause::Physics => raise("PhysicsError", &failure),
        }
    }
}

/// Returns issues as an exception.
pub fn of(issues: Issues) -> PyErr {
    Failure::from(issues).into()
}

/// Returns issues of what has no lines as an exception.
pub fn without_lines(issues: Issues) -> PyErr {
    Failure { has_lines: false, ..issues.into() }.into()
}

/// The entries of an `Issue` in Python.
type Entry = (&'static str, String, String, Option<String>, Option<usize>);

fn raise(class: &'static str, failure: &Failure) -> PyErr {
    static CLASSES: [PyOnceLock<Py<PyType>>; 2] = [const { PyOnceLock::new() }; 2];
    let Failure { issues, units, has_lines } = failure;
    let entry = |issue: &Issue| -> Entry {
        let line = issues.line(issue).filter(|_| *has_lines);
        let source = issues.source_of(issue);
        // The exception has the name of the first file.
        let (file, line) = match line {
            Some(line) if !std::ptr::eq(source, issues.source()) => (format!("{}:{line}: ", source.name), None),
            line => (String::new(), line),
        };
        let help = issue.help.as_ref().map(|help| arguments(&units.sentence(help), "`"));
        (issue.code, arguments(&issue.path, ""), file + &arguments(&units.sentence(&issue.message), "`"), help, line)
    };
    let entries: Vec<Entry> = issues.list().iter().map(entry).collect();
    let name = if *has_lines { issues.source().name.as_str() } else { "" };
    Python::attach(|py| {
        let cell = &CLASSES[usize::from(class == "PhysicsError")];
        let made = cell.import(py, "planar_impact._errors", class).and_then(|class| class.call_method1("_of", (name, entries)));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

/// Names options of the command line as arguments in Python: `--bounds-sd` is `bounds_sd`. A whole command in quotes stays as it is.
fn arguments(sentence: &str, quote: &str) -> String {
    let mut parts = sentence.split("--");
    let mut named = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|letter: char| !letter.is_ascii_lowercase() && letter != '-').unwrap_or(part.len());
        let (option, rest) = part.split_at(end);
        let is_quoted = quote == "`" && named.matches('`').count() % 2 == 1;
        let is_option = !is_quoted
            && option.starts_with(|letter: char| letter.is_ascii_lowercase())
            && !named.ends_with(|letter: char| letter.is_alphanumeric());
        let option = if is_option { format!("{quote}{}{quote}", option.replace('-', "_")) } else { format!("--{option}") };
        named += &option;
        named += rest;
    }
    named
}
