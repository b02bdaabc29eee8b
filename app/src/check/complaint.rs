//! Complaints about a record or a header that cannot be read.

use std::borrow::Cow;

use super::draft::Drafted;
use crate::plain_text::shorten;

/// Maximum number of complaints about one record; the rest are counted.
const MOST: usize = 20;
/// Maximum width of a key and of a message, in columns, because a file may contain a name of a megabyte.
const LONGEST_KEY: usize = 120;
const LONGEST_MESSAGE: usize = 600;

/// Everything wrong with one record or header.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Complaints {
    first: Vec<String>,
    others: usize,
}

impl Complaints {
    /// Adds a complaint about a key.
    pub fn push(&mut self, key: &str, message: impl AsRef<str>) {
        if self.first.len() == MOST {
            self.others += 1;
            return;
        }
        let separator = if key.is_empty() { "" } else { ": " };
        self.first.push(format!("{}{separator}{}", shorten(key, LONGEST_KEY), shorten(message.as_ref(), LONGEST_MESSAGE)));
    }

    /// Returns `true` if there is a complaint about a key.
    pub fn are_about(&self, key: &str) -> bool {
        self.first.iter().any(|complaint| complaint.strip_prefix(key).is_some_and(|rest| rest.starts_with(": ")))
    }

    /// Returns the value, or adds a complaint and returns `None`.
    pub fn accept<T>(&mut self, key: &str, read: Result<T, impl AsRef<str>>) -> Option<T> {
        read.map_err(|message| self.push(key, message)).ok()
    }

    /// Appends the complaints of another list.
    pub fn append(&mut self, other: Complaints) {
        self.first.extend(other.first);
        self.others += other.others + self.first.len().saturating_sub(MOST);
        self.first.truncate(MOST);
    }

    /// Returns `true` if there are none.
    pub fn is_empty(&self) -> bool {
        self.first.is_empty()
    }

    /// Returns an iterator over the complaints, and the number of those that are not kept.
    pub fn iter(&self) -> impl Iterator<Item = Cow<'_, str>> {
        let others = (self.others > 0).then(|| Cow::Owned(format!("there are {} more problems", self.others)));
        self.first.iter().map(|complaint| Cow::Borrowed(complaint.as_str())).chain(others)
    }
}

/// A record and the number of its line, or why it cannot be read.
pub type Numbered = (u64, Result<Drafted, Unreadable>);

/// An unreadable record: its identifier, if it was read, and its complaints.
pub type Unreadable = (String, Complaints);

/// Returns the complaint for a record that is refused without being read.
pub fn refused(message: &str) -> Unreadable {
    let mut complaints = Complaints::default();
    complaints.push("", message);
    (String::new(), complaints)
}

impl std::fmt::Display for Complaints {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.iter().collect::<Vec<_>>().join("; "))
    }
}
