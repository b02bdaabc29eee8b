//! The case file as a tree that records the position of each value, so that all issues are reported at once, each at its place.
//!
//! [`Document::parse`] builds the tree of a [`Source`], and [`Document::read_as`] walks it. [`Document::place`] locates
//! issues that the library finds later.

mod edit;
pub mod json;
mod kind;
mod read;
mod toml;
mod tree;

pub use edit::{Edit, Written};
pub use kind::FileKind;
pub use read::{Field, Table};
pub use tree::{Entry, Node, Value};

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::issue::{Cause, Issue, Issues};
use crate::quantity::excerpt;
use crate::source::Source;

/// A parsed case file.
#[derive(Debug, Clone)]
pub struct Document {
    source: Arc<Source>,
    entries: Vec<Entry>,
    span: Option<Range<usize>>,
}

impl Document {
    /// Parses a case file: as JSON if the name ends in `.json`, or if it does not end in `.toml` either and the text
    /// begins with `{`; otherwise as TOML.
    ///
    /// # Errors
    ///
    /// Returns the syntax errors; for TOML, as many as can be told apart.
    pub fn parse(source: Source) -> Result<Document, Issues> {
        let json = is_json(&source);
        let parsed = if json { json::parse(&source.text) } else { toml::parse(&source.text) };
        let source = Arc::new(source);
        let as_a_whole = || is_table(&source).or_else(|| other_format(&source));
        let said = |list| as_a_whole().map_or(list, |issue| vec![issue]);
        let root = parsed.map_err(|list| Issues::new(Cause::Input, source.clone(), said(list)))?;
        match root.value {
            Value::Table(entries) => {
                let span = Some(root.span).filter(|_| json);
                Ok(Document { source, entries, span })
            }
            other => {
                let message = format!("expected an object, found {}", other.describe());
                let issue = Issue { span: Some(root.span), ..Issue::of_file("wrong-type", message) };
                Err(Issues::new(Cause::Input, source, vec![issue]))
            }
        }
    }

    /// Returns the file.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Returns the keys of the root and their values, in file order.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Walks the file from its root. Collects the issues that tables and fields report on the way; reports unknown
    /// keys of the root, except `$schema`, after `walk` returns.
    ///
    /// # Errors
    ///
    /// Returns every issue found, in file order.
    pub fn read<T>(&self, walk: impl FnOnce(&Table<'_>) -> Option<T>) -> Result<T, Issues> {
        let context = read::Context::new(&self.source.text);
        let root = Table::root(&context, &self.entries, self.span.clone());
        let value = walk(&root);
        // The address of the schema is for editors.
        root.optional("$schema").string();
        root.finish();
        let mut list = context.into_issues();
        match value {
            Some(value) if list.is_empty() => Ok(value),
            value => {
                // A walk that returns `None` has reported the reason; this issue exposes one that has not.
                if value.is_none() && list.is_empty() {
                    list.push(Issue::of_file("incomplete", format!("`{}` is incomplete", self.source.name)));
                }
                Err(self.refuse(Cause::Input, list))
            }
        }
    }

    /// Walks a file of one kind, as [`read`](Document::read) does.
    ///
    /// # Errors
    ///
    /// That the file is of another kind, as its keys tell; otherwise every issue found, in file order.
    pub fn read_as<T>(&self, kind: FileKind, walk: impl FnOnce(&Table<'_>) -> Option<T>) -> Result<T, Issues> {
        match FileKind::told_by(&self.entries).filter(|found| *found != kind) {
            Some(found) => {
                let message = format!("this is {}, and {} is needed", found.name(), kind.name());
                let issue = Issue::of_file("other-kind-of-file", message).with_help(found.verbs());
                Err(self.refuse(Cause::Input, vec![issue]))
            }
            None => self.read(walk),
        }
    }

    /// Returns the issue located at the value of its path, or at the innermost existing table or array on that path.
    pub fn place(&self, issue: Issue) -> Issue {
        Issue { span: self.locate(&issue.path), ..issue }
    }

    /// Combines issues with the text that their spans refer to.
    pub fn refuse(&self, cause: Cause, list: Vec<Issue>) -> Issues {
        Issues::new(cause, self.source.clone(), list)
    }

    /// Locates each issue by its path and combines them with the text.
    pub fn refuse_at(&self, cause: Cause, list: impl IntoIterator<Item = Issue>) -> Issues {
        self.refuse(cause, list.into_iter().map(|issue| self.place(issue)).collect())
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

/// Returns the value of a table's key, or of an array's item counted from 1.
fn child<'a>(node: &'a Node, part: &str) -> Option<&'a Node> {
    match &node.value {
        Value::Table(entries) => entries.iter().find(|entry| entry.key == part).map(|entry| &entry.node),
        Value::Array(items) => items.get(part.parse::<usize>().ok()?.checked_sub(1)?),
        _ => None,
    }
}

/// Returns the issue of a table in the place of a document, in which every line would be one.
fn is_table(source: &Source) -> Option<Issue> {
    let message = || format!("{} is a table, where a TOML or JSON file is expected", excerpt(&source.name));
    let issue =
        || Issue::of_file("unreadable-file", message()).with_help("`batch` solves tables, `check` reads records, and `record` recordings");
    (extension(source)? == "csv").then(issue)
}

/// Returns the issue of a file in one format whose name is that of the other.
fn other_format(source: &Source) -> Option<Issue> {
    let (is_other, [found, expected]) = match extension(source)?.as_str() {
        "json" => (toml::parse(&source.text).is_ok(), ["TOML", "JSON"]),
        "toml" => (json::parse(&source.text).is_ok(), ["JSON", "TOML"]),
        _ => return None,
    };
    let help = || format!("let the name of the file end in .{}", found.to_ascii_lowercase());
    is_other.then(|| Issue::of_file("syntax", format!("this is not {expected}, as its name says, but {found}")).with_help(help()))
}

fn is_json(source: &Source) -> bool {
    match extension(source).as_deref() {
        Some("json") => true,
        Some("toml") => false,
        _ => source.text.trim_start().starts_with('{'),
    }
}

/// Returns how the name of a file ends, in lower case.
fn extension(source: &Source) -> Option<String> {
    Some(Path::new(&source.name).extension()?.to_str()?.to_ascii_lowercase())
}

#[cfg(test)]
mod tests;
