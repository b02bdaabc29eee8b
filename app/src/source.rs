//! The text of a file.

use std::borrow::Cow;
use std::rc::Rc;

use crate::issue::Issues;

/// The text of a file and the name that messages give it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The path as given, or `<stdin>`.
    pub name: String,
    /// The whole text, without a byte order mark.
    pub text: String,
    /// Whether a byte order mark stands before the text.
    pub has_mark: bool,
}

/// Opens a file that another one names, as that one writes its name.
pub type Open = Box<dyn Fn(&str) -> Result<Source, Issues>>;

/// The same for several readers: a file that another one names may name further ones.
pub(crate) type SharedOpen = Rc<dyn Fn(&str) -> Result<Source, Issues>>;

impl Source {
    /// Maximum size of a file of a case or of tests, in bytes. A typical one has a few thousand.
    pub const LARGEST: u64 = 4 << 20;

    /// A byte order mark in UTF-8.
    pub(crate) const MARK: &str = "\u{feff}";

    /// Creates the source of a text without a byte order mark.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Source { name: name.into(), text: text.into(), has_mark: false }
    }

    /// Returns the content of the file to the byte: the text with its byte order mark, if it has one.
    pub fn content(&self) -> Cow<'_, str> {
        if self.has_mark { format!("{}{}", Self::MARK, self.text).into() } else { self.text.as_str().into() }
    }
}
