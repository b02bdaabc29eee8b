//! A cursor over the tree: each getter returns the value, or reports why it is not acceptable.
//!
//! Read every key first, call `finish` on each table, and only then use `?`, so that one walk finds all issues.

use std::cell::RefCell;
use std::ops::{Range, RangeInclusive};

use super::tree::{Entry, Node, Value};
use crate::issue::{Issue, MOST_KEPT};
use crate::message::Message;
use crate::quantity::{self, Kind, Quantity, excerpt, nearest};
use crate::wording::count_of;

/// The text being walked and the issues found in it.
pub(super) struct Context<'a> {
    text: &'a str,
    issues: RefCell<Vec<Issue>>,
}

impl<'a> Context<'a> {
    pub(super) fn new(text: &'a str) -> Context<'a> {
        Context { text, issues: RefCell::default() }
    }

    pub(super) fn into_issues(self) -> Vec<Issue> {
        self.issues.into_inner()
    }

    fn push(&self, code: &'static str, span: Option<Range<usize>>, path: &str, message: impl Into<Message>, help: Option<String>) {
        let mut issues = self.issues.borrow_mut();
        if issues.len() < MOST_KEPT {
            issues.push(Issue { span, help: help.map(Into::into), ..Issue::at(code, path, message) });
        }
    }
}

/// A table, its place in the file, and the keys read from it so far.
pub struct Table<'a> {
    context: &'a Context<'a>,
    path: String,
    span: Option<Range<usize>>,
    entries: &'a [Entry],
    known: RefCell<Vec<&'static str>>,
}

impl<'a> Table<'a> {
    pub(super) fn root(context: &'a Context<'a>, entries: &'a [Entry], span: Option<Range<usize>>) -> Table<'a> {
        Table { context, path: String::new(), span, entries, known: RefCell::default() }
    }

    /// Returns the dotted path of this table, such as `vehicle.1.crush`; empty for the root.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Returns `true` if the file has `key`, and marks the key as known.
    pub fn has(&self, key: &'static str) -> bool {
        self.field(key, false).node.is_some()
    }

    /// Returns the field of a required key; its getter reports it if it is missing.
    pub fn required(&self, key: &'static str) -> Field<'a> {
        self.field(key, true)
    }

    /// Returns the field of an optional key; its getter returns `None` without a report if it is missing.
    pub fn optional(&self, key: &'static str) -> Field<'a> {
        self.field(key, false)
    }

    /// Returns every value of the table by its key, in file order, for tables whose keys are names. It ends where no further issue would be kept.
    pub fn fields(&self) -> impl Iterator<Item = (&'a str, Field<'a>)> {
        let field = |entry: &'a Entry| {
            let path = join(&self.path, &entry.key);
            (entry.key.as_str(), Field { context: self.context, path, node: Some(&entry.node), table: self.span.clone(), required: true })
        };
        self.entries.iter().take_while(|_| self.context.issues.borrow().len() < MOST_KEPT).map(field)
    }

    /// Reports an issue with this table as a whole, at its header.
    pub fn issue(&self, message: impl Into<Message>, help: Option<String>) {
        self.context.push("invalid", self.span.clone(), &self.path, message, help);
    }

    /// Reports every key that was not read, and suggests the nearest known one.
    pub fn finish(&self) {
        self.finish_with(None);
    }

    /// Reports every key that was not read, with the reason why such keys are unknown here.
    pub fn finish_because(&self, why: &str) {
        self.finish_with(Some(why));
    }

    fn finish_with(&self, why: Option<&str>) {
        let known = self.known.borrow();
        let absent: Vec<&str> = known.iter().copied().filter(|key| self.find(key).is_none()).collect();
        let unknown = |entry: &&Entry| !known.contains(&entry.key.as_str());
        for entry in self.entries.iter().filter(unknown).take(MOST_KEPT) {
            let [absent, known_here] = [&absent, &*known].map(|keys| nearest(&entry.key, keys.iter().copied()));
            let help = match (why, absent, known_here) {
                (Some(why), ..) => why.to_owned(),
                (None, Some(key), _) => format!("did you mean `{key}`?"),
                (None, None, Some(key)) => format!("did you mean `{key}`, which is here too?"),
                (None, None, None) => format!("the keys known here are {}", known.join(", ")),
            };
            let path = join(&self.path, &entry.key);
            self.context.push("unknown-key", Some(entry.key_span.clone()), &path, "unknown key".to_owned(), Some(help));
        }
    }

    fn find(&self, key: &str) -> Option<&'a Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    fn field(&self, key: &'static str, required: bool) -> Field<'a> {
        let mut known = self.known.borrow_mut();
        if !known.contains(&key) {
            known.push(key);
        }
        Field {
            context: self.context,
            path: join(&self.path, key),
            node: self.find(key).map(|entry| &entry.node),
            table: self.span.clone(),
            required,
        }
    }
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// A key's value, or an array's item, that has not been read yet. Every getter returns `None` and reports why, unless
/// the value has the requested type; see [`Table::optional`] for a missing one.
#[derive(Clone)]
pub struct Field<'a> {
    context: &'a Context<'a>,
    path: String,
    node: Option<&'a Node>,
    table: Option<Range<usize>>,
    required: bool,
}

impl<'a> Field<'a> {
    /// Returns the dotted path of this value, such as `vehicle.1.mass`.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Returns the value itself, for keys that accept more than one type.
    pub fn value(&self) -> Option<&'a Value> {
        self.node.map(|node| &node.value)
    }

    /// Reads a table.
    pub fn table(self) -> Option<Table<'a>> {
        let node = self.present("a table")?;
        match &node.value {
            Value::Table(entries) => Some(self.as_table(node, entries)),
            _ => self.mismatch(node, "a table", None),
        }
    }

    /// Reads an array of tables; item 1 of `vehicle` has the path `vehicle.1`.
    pub fn array_of_tables(self) -> Option<Vec<Table<'a>>> {
        // What stands before a key in TOML may be a table or one of an array, which its path does not tell.
        let help = Some(match self.path.rsplit_once('.') {
            None => format!("begin each table with [[{}]] in TOML, or list them in [ ] in JSON", self.path),
            Some((_, key)) => format!("list them in [ ]: {key} = [{{ ... }}]"),
        });
        let node = self.present("an array of tables")?;
        match &node.value {
            Value::Array(items) => all(self.fields(items).map(Field::table)),
            _ => self.mismatch(node, "an array of tables", help),
        }
    }

    /// Reads a string.
    pub fn string(self) -> Option<&'a str> {
        let node = self.present("a string")?;
        match &node.value {
            Value::String(text) => Some(text),
            _ => self.mismatch(node, "a string", None),
        }
    }

    /// Reads a name, which has a letter that can be seen.
    pub fn name(self) -> Option<&'a str> {
        let name = self.clone().string()?;
        if name.trim().is_empty() {
            self.report("the name is empty".to_owned(), Some("leave the key out for a name that counts".to_owned()));
            return None;
        }
        Some(name)
    }

    /// Reads one of the given words.
    pub fn choice(self, words: &[&'static str]) -> Option<&'static str> {
        let wanted = format!("one of \"{}\"", words.join("\", \""));
        let node = self.present(&wanted)?;
        let Value::String(text) = &node.value else {
            return self.mismatch(node, &wanted, None);
        };
        let chosen = words.iter().copied().find(|word| word == text);
        if chosen.is_none() {
            let help = nearest(text, words.iter().copied()).map(|word| format!("did you mean \"{word}\"?"));
            self.report(format!("expected {wanted}, found {}", excerpt(text)), help);
        }
        chosen
    }

    /// Reads a boolean.
    pub fn boolean(self) -> Option<bool> {
        let node = self.present("true or false")?;
        match node.value {
            Value::Bool(value) => Some(value),
            _ => self.mismatch(node, "true or false", None),
        }
    }

    /// Reads a whole number in the range, written without point and exponent.
    pub fn integer(self, range: RangeInclusive<i64>) -> Option<i64> {
        let wanted = if range.start() == range.end() {
            format!("the number {}", range.start())
        } else {
            format!("a whole number from {} to {}", range.start(), range.end())
        };
        let node = self.present(&wanted)?;
        let Value::Number(number) = &node.value else {
            return self.mismatch(node, &wanted, None);
        };
        let value = number.text.parse().ok().filter(|value| number.integer && range.contains(value));
        if value.is_none() {
            self.report(format!("expected {wanted}, found {}", excerpt(&number.text)), None);
        }
        value
    }

    /// Reads a string with a unit, or a bare number in SI.
    pub fn quantity(self, kind: Kind) -> Option<Quantity> {
        let node = self.present(&kind.wanted())?;
        match &node.value {
            Value::String(text) => self.accept(quantity::parse(text, kind).map_err(|error| error.expected(&kind))),
            Value::Number(number) => {
                self.accept(quantity::finite(&number.text).and_then(|value| quantity::bare(&number.text, value, kind)))
            }
            _ => self.mismatch(node, &kind.wanted(), None),
        }
    }

    /// Reads an array of exactly two quantities.
    pub fn pair(self, kind: Kind) -> Option<[Quantity; 2]> {
        let wanted = format!("an array of two values, each {}", kind.wanted());
        let items = self.items(&wanted, 2..=2)?;
        all(items.into_iter().map(|item| item.quantity(kind)))?.try_into().ok()
    }

    /// Reads an array with a number of items in the range; each item is a field to be read. `wanted` describes the
    /// expected array, with its article.
    pub fn items(self, wanted: &str, count: RangeInclusive<usize>) -> Option<Vec<Field<'a>>> {
        let node = self.present(wanted)?;
        let Value::Array(items) = &node.value else {
            return self.mismatch(node, wanted, None);
        };
        if !count.contains(&items.len()) {
            self.report_as("wrong-count", format!("expected {wanted}; found {}", count_of(items.len(), "value")), None);
            return None;
        }
        Some(self.fields(items).collect())
    }

    /// Reports an issue with this value, or with its table if it is missing.
    pub fn report(&self, message: impl Into<Message>, help: Option<String>) {
        self.report_as("invalid", message, help);
    }

    /// Reports an issue with a given code.
    pub fn report_as(&self, code: &'static str, message: impl Into<Message>, help: Option<String>) {
        let span = self.node.map(|node| node.span.clone()).or_else(|| self.table.clone());
        self.context.push(code, span, &self.path, message, help);
    }

    fn as_table(&self, node: &Node, entries: &'a [Entry]) -> Table<'a> {
        let (context, path) = (self.context, self.path.clone());
        Table { context, path, span: Some(node.span.clone()), entries, known: RefCell::default() }
    }

    fn fields(&self, items: &'a [Node]) -> impl Iterator<Item = Field<'a>> {
        items.iter().enumerate().map(|(index, item)| Field {
            context: self.context,
            path: format!("{}.{}", self.path, index + 1),
            node: Some(item),
            table: self.table.clone(),
            required: true,
        })
    }

    /// Returns the value, or reports a missing required one.
    fn present(&self, wanted: &str) -> Option<&'a Node> {
        if self.node.is_none() && self.required {
            self.report_as("missing-key", "missing", Some(format!("expected {wanted}")));
        }
        self.node
    }

    fn mismatch<T>(&self, node: &Node, wanted: &str, help: Option<String>) -> Option<T> {
        let mut found = node.value.describe().to_owned();
        if let Value::Number(_) | Value::Other(_) | Value::String(_) = node.value {
            let text = self.context.text.get(node.span.clone()).unwrap_or("");
            found = format!("{found}, {}", excerpt(text));
        }
        self.report_as("wrong-type", format!("expected {wanted}; found {found}"), help);
        None
    }

    fn accept<T>(&self, read: Result<T, quantity::QuantityError>) -> Option<T> {
        read.map_err(|error| self.report_as("quantity", error.message, error.help)).ok()
    }
}

/// Returns all values, or `None` if any is missing. Evaluates all of them first, so that each one reports its own issues.
fn all<T>(values: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let values: Vec<Option<T>> = values.collect();
    values.into_iter().collect()
}
