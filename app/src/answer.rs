//! The envelope of an answer: its facts, with what every answer has.

use std::ops::Deref;

use schemars::JsonSchema;
use serde::Serialize;

use crate::notice::Notices;

/// The version of the JSON of every answer.
pub const SCHEMA: u32 = 1;

/// An answer in SI and radians: the facts of a verb, with title and notices.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "{T}")]
pub struct Answer<T> {
    /// The version of this document.
    pub schema: u32,
    /// The title of the file; empty if it has none.
    pub title: String,
    /// The facts.
    #[serde(flatten)]
    pub facts: T,
    /// Notes and warnings.
    #[serde(flatten)]
    pub notices: Notices,
}

impl<T> Answer<T> {
    /// Wraps facts.
    pub fn new(title: &str, facts: T, notices: Notices) -> Answer<T> {
        Answer { schema: SCHEMA, title: title.to_owned(), facts, notices }
    }
}

/// The facts are read from the answer itself.
impl<T> Deref for Answer<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.facts
    }
}
