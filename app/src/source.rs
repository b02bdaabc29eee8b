//! The text of a file.

/// The text of a file and the name that messages give it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The path as given, or `<stdin>`.
    pub name: String,
    /// The whole text, without a byte order mark.
    pub text: String,
}

impl Source {
    /// Maximum size of a file of a case or of tests, in bytes. A typical one has a few thousand.
    pub const LARGEST: u64 = 4 << 20;
}
