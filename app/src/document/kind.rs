//! The kinds of files of keys, each told from the others by keys of its own.

use super::tree::{Entry, Value};

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A collision.
    Case,
    /// Barrier tests.
    Tests,
    /// What sensors recorded.
    Recording,
    /// Records of collisions.
    Records,
}

impl FileKind {
    /// Returns the kind that keys of the root tell, or `None` if none does, or those of two kinds stand beside each other.
    pub(super) fn told_by(entries: &[Entry]) -> Option<FileKind> {
        let has = |keys: &[&str]| entries.iter().any(|entry| keys.contains(&entry.key.as_str()));
        let is_tested = |vehicle: &Value| matches!(vehicle, Value::Table(keys) if keys.iter().any(|entry| entry.key == "test"));
        let has_tests = entries.iter().filter(|entry| entry.key == "vehicle").any(|entry| match &entry.node.value {
            Value::Array(vehicles) => vehicles.iter().any(|vehicle| is_tested(&vehicle.value)),
            other => is_tested(other),
        });
        let told = [
            (FileKind::Case, has(&["contact", "evidence", "unknown", "scene", "rest", "before"])),
            (FileKind::Tests, has_tests || has(&["fit"])),
            (FileKind::Recording, has(&["channel", "file", "samples", "kinematics"])),
            (FileKind::Records, has(&["records"])),
        ];
        let mut kinds = told.into_iter().filter_map(|(kind, is_told)| is_told.then_some(kind));
        kinds.next().filter(|_| kinds.next().is_none())
    }

    /// Returns its name with an article.
    pub(super) fn name(self) -> &'static str {
        match self {
            FileKind::Case => "a case file",
            FileKind::Tests => "a file of barrier tests",
            FileKind::Recording => "a recording",
            FileKind::Records => "a file of records",
        }
    }

    /// Returns the verbs that read it.
    pub(super) fn verbs(self) -> &'static str {
        match self {
            FileKind::Case => "`solve`, `reconstruct` and others read it",
            FileKind::Tests => "`stiffness` reads it",
            FileKind::Recording => "`record` reads it",
            FileKind::Records => "`check` reads it",
        }
    }
}
