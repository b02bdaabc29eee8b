//! The case file as a tree that remembers where each value stands, so that everything wrong in it
//! is reported at once and at its place.
//!
//! [`Source::read`] reads the text, [`Document::parse`] makes the tree, and [`Document::read`]
//! walks it. A mistake found later, by the library, is placed with [`Document::problem`].

pub mod json;
mod read;
mod report;
mod source;
mod toml;
mod tree;

pub use read::{Field, Table};
pub use report::{Problem, Problems};
pub use source::Source;
pub use tree::{Entry, Node, Value};

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// A parsed case file.
#[derive(Debug, Clone)]
pub struct Document {
    source: Arc<Source>,
    entries: Vec<Entry>,
    span: Option<Range<usize>>,
}

impl Document {
    /// Parses JSON if the name ends in `.json`, or ends in neither that nor `.toml` and the text
    /// begins with `{`; otherwise TOML.
    ///
    /// # Errors
    ///
    /// The syntax errors, of TOML as many as can be told apart.
    pub fn parse(source: Source) -> Result<Document, Problems> {
        let json = is_json(&source);
        let parsed = if json { json::parse(&source.text) } else { toml::parse(&source.text) };
        let source = Arc::new(source);
        let root = parsed.map_err(|list| Problems::new(source.clone(), list))?;
        match root.value {
            Value::Table(entries) => {
                let span = Some(root.span).filter(|_| json);
                Ok(Document { source, entries, span })
            }
            other => {
                let problem = Problem {
                    span: Some(root.span),
                    key: String::new(),
                    message: format!("expected an object, found {}", other.describe()),
                    help: None,
                };
                Err(Problems::new(source, vec![problem]))
            }
        }
    }

    /// Walks the file from its root. Problems pushed by the tables and fields on the way are
    /// collected; unknown keys of the root are reported after `walk` returns.
    ///
    /// # Errors
    ///
    /// Every problem found, in file order.
    pub fn read<T>(&self, walk: impl FnOnce(&Table<'_>) -> Option<T>) -> Result<T, Problems> {
        let context = read::Context::new(&self.source.text);
        let root = Table::root(&context, &self.entries, self.span.clone());
        let value = walk(&root);
        root.finish();
        let mut list = context.into_problems();
        match value {
            Some(value) if list.is_empty() => Ok(value),
            value => {
                // A walk that gives up has pushed the reason; this keeps a forgotten one visible.
                if value.is_none() && list.is_empty() {
                    list.push(Problem::of_file(format!("`{}` is incomplete", self.source.name)));
                }
                Err(self.refuse(list))
            }
        }
    }

    /// A problem at the value of the dotted `key`, or at the innermost table or array on the way
    /// to it that the file has.
    pub fn problem(&self, key: &str, message: impl Into<String>, help: Option<String>) -> Problem {
        Problem { span: self.locate(key), key: key.to_owned(), message: message.into(), help }
    }

    /// These problems with the text they point into.
    pub fn refuse(&self, list: Vec<Problem>) -> Problems {
        Problems::new(self.source.clone(), list)
    }

    fn locate(&self, key: &str) -> Option<Range<usize>> {
        let mut parts = key.split('.');
        let first = parts.next().unwrap_or("");
        let Some(entry) = self.entries.iter().find(|entry| entry.key == first) else {
            return self.span.clone();
        };
        let mut node = &entry.node;
        for part in parts {
            let Some(inner) = child(node, part) else {
                break;
            };
            node = inner;
        }
        Some(node.span.clone())
    }
}

/// The value of a table's key, or of an array's item counted from 1.
fn child<'a>(node: &'a Node, part: &str) -> Option<&'a Node> {
    match &node.value {
        Value::Table(entries) => entries.iter().find(|entry| entry.key == part).map(|entry| &entry.node),
        Value::Array(items) => items.get(part.parse::<usize>().ok()?.checked_sub(1)?),
        _ => None,
    }
}

fn is_json(source: &Source) -> bool {
    let extension = Path::new(&source.name).extension().map(|end| end.to_ascii_lowercase());
    match extension.as_ref().and_then(|end| end.to_str()) {
        Some("json") => true,
        Some("toml") => false,
        _ => source.text.trim_start().starts_with('{'),
    }
}

#[cfg(test)]
mod tests;
