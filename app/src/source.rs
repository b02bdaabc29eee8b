//! The text of a file.

use std::rc::Rc;

use crate::issue::Issues;

/// The text of a file and the name that messages give it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The path as given, or `<stdin>`.
    pub name: String,
    /// The whole text, without a byte order mark.
    pub text: String,
}

/// Opens a file that another one names, as that one writes its name.
pub type Open = Box<dyn Fn(&str) -> Result<Source, Issues>>;

/// The same for several readers: a file that another one names may name further ones.
pub(crate) type SharedOpen = Rc<dyn Fn(&str) -> Result<Source, Issues>>;

impl Source {
    /// Maximum size of a file of a case or of tests, in bytes. A typical one has a few thousand.
    pub const LARGEST: u64 = 4 << 20;
}
