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

/// The entries of an `Issue` in Python.
type Entry = (&'static str, String, String, Option<String>, Option<usize>);

fn raise(class: &'static str, failure: &Failure) -> PyErr {
    static CLASSES: [PyOnceLock<Py<PyType>>; 2] = [const { PyOnceLock::new() }; 2];
    let Failure { issues, units, has_lines } = failure;
    let entry = |issue: &Issue| -> Entry {
        let line = issues.line(issue).filter(|_| *has_lines);
        let help = issue.help.as_ref().map(|help| units.sentence(help));
        // Arguments are named as on the command line, where they begin with dashes.
        (issue.code, issue.path.trim_start_matches("--").to_owned(), units.sentence(&issue.message), help, line)
    };
    let entries: Vec<Entry> = issues.list().iter().map(entry).collect();
    let name = if *has_lines { issues.source().name.as_str() } else { "" };
    Python::attach(|py| {
        let cell = &CLASSES[usize::from(class == "PhysicsError")];
        let made = cell.import(py, "planar_impact._errors", class).and_then(|class| class.call_method1("_of", (name, entries)));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}
