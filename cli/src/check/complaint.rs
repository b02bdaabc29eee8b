//! What is wrong with a record or a header that cannot be read.

/// The most complaints about one record: one with more is no record with mistakes.
const MOST: usize = 20;

/// Everything wrong with one record or header.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Complaints(Vec<String>);

impl Complaints {
    /// Adds one about a key.
    pub fn push(&mut self, key: &str, message: impl AsRef<str>) {
        if self.0.len() < MOST {
            let separator = if key.is_empty() { "" } else { ": " };
            self.0.push(format!("{key}{separator}{}", message.as_ref()));
        }
    }

    /// The value, or a complaint.
    pub fn accept<T>(&mut self, key: &str, read: Result<T, impl AsRef<str>>) -> Option<T> {
        read.map_err(|message| self.push(key, message)).ok()
    }

    /// Adds those of another.
    pub fn append(&mut self, other: Complaints) {
        self.0.extend(other.0);
        self.0.truncate(MOST);
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

impl std::fmt::Display for Complaints {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.join("; "))
    }
}
