//! Complaints about a record or a header that cannot be read.

use planar_impact::check::Record;

use crate::plain_text::shorten;

/// Maximum number of complaints about one record; the rest are dropped.
const MOST: usize = 20;
/// Maximum width of a key and of a message, in columns, because a file may contain a name of a megabyte.
const LONGEST_KEY: usize = 120;
const LONGEST_MESSAGE: usize = 600;

/// Everything wrong with one record or header.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Complaints(Vec<String>);

impl Complaints {
    /// Adds a complaint about a key.
    pub fn push(&mut self, key: &str, message: impl AsRef<str>) {
        if self.0.len() < MOST {
            let separator = if key.is_empty() { "" } else { ": " };
            self.0.push(format!("{}{separator}{}", shorten(key, LONGEST_KEY), shorten(message.as_ref(), LONGEST_MESSAGE)));
        }
    }

    /// Returns the value, or adds a complaint and returns `None`.
    pub fn accept<T>(&mut self, key: &str, read: Result<T, impl AsRef<str>>) -> Option<T> {
        read.map_err(|message| self.push(key, message)).ok()
    }

    /// Appends the complaints of another list.
    pub fn append(&mut self, other: Complaints) {
        self.0.extend(other.0);
        self.0.truncate(MOST);
    }

    /// Returns `true` if there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns an iterator over the complaints.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

/// A record and the number of its line, or why it cannot be read.
pub type Numbered = (u64, Result<Record, Unreadable>);

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
        f.write_str(&self.0.join("; "))
    }
}
