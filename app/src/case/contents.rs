//! What a case file gives besides its inputs and its evidence, by path.

use std::collections::HashSet;

use super::Case;
use crate::document::{Document, Node, Value};
use crate::units::Measure;

/// What a case file gives, recorded while it is read.
#[derive(Clone, Debug, Default)]
pub(super) struct Contents {
    /// The numbers that are no inputs, in the order in which they are read.
    numbers: Vec<Number>,
    /// The paths of the inputs.
    inputs: Vec<String>,
}

/// A number of a case file.
#[derive(Clone, Debug)]
struct Number {
    /// The path that it is read from, with everything below it.
    key: String,
    name: String,
    si: f64,
    measure: Measure,
}

/// An entry of a case file that is neither an input nor a piece of evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its path; a standard deviation has ` sd` after it.
    pub name: String,
    /// Its value.
    pub value: EntryValue,
}

/// The value of an entry.
#[derive(Clone, Debug, PartialEq)]
pub enum EntryValue {
    /// A number in SI.
    Number(f64, Measure),
    /// A word.
    Word(String),
}

impl Contents {
    /// Records what the file gives at a path. This replaces the numbers of its parts, which are the last ones that were read.
    pub(super) fn numbers(&mut self, key: &str, numbers: impl IntoIterator<Item = (String, f64, Measure)>) {
        self.forget(key);
        self.numbers.extend(numbers.into_iter().map(|(name, si, measure)| Number { key: key.to_owned(), name, si, measure }));
    }

    /// Records that an input is read from a path.
    pub(super) fn input(&mut self, key: &str) {
        self.forget(key);
        self.inputs.push(key.to_owned());
    }

    fn forget(&mut self, key: &str) {
        while self.numbers.last().is_some_and(|last| is_within(&last.key, key)) {
            self.numbers.pop();
        }
    }
}

fn is_within(path: &str, key: &str) -> bool {
    path.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The keys of the root that no answer depends on or that are shown by themselves: evidence is part of the [`Knowledge`](super::Knowledge).
const SHOWN: [&str; 4] = ["$schema", "schema", "title", "evidence"];

impl Case {
    /// Returns the entries of the file that are neither inputs nor evidence: first numbers, then words.
    pub fn further_entries(&self) -> Vec<Entry> {
        let is_shown = |key: &str| SHOWN.iter().any(|shown| is_within(key, shown));
        let numbers = self.contents.numbers.iter().filter(|number| !is_shown(&number.key));
        let mut all: Vec<Entry> =
            numbers.map(|number| Entry { name: number.name.clone(), value: EntryValue::Number(number.si, number.measure) }).collect();
        let read = self.contents.numbers.iter().map(|number| number.key.as_str());
        let known: HashSet<&str> = read.chain(self.contents.inputs.iter().map(String::as_str)).chain(SHOWN).collect();
        all.extend(words(&self.document, &known));
        all
    }
}

/// Returns every value of a document as a word, without those at or below the `known` paths.
fn words(document: &Document, known: &HashSet<&str>) -> Vec<Entry> {
    let mut all = Vec::new();
    let mut open: Vec<(String, &Node)> = document.entries().iter().rev().map(|entry| (entry.key.clone(), &entry.node)).collect();
    while let Some((name, node)) = open.pop() {
        if known.contains(name.as_str()) {
            continue;
        }
        let word = match &node.value {
            Value::Table(entries) => {
                open.extend(entries.iter().rev().map(|entry| (format!("{name}.{}", entry.key), &entry.node)));
                continue;
            }
            Value::Array(items) => {
                open.extend(items.iter().enumerate().rev().map(|(place, item)| (format!("{name}.{}", place + 1), item)));
                continue;
            }
            Value::String(text) => text.clone(),
            Value::Number(number) => number.text.clone(),
            Value::Bool(is_true) => is_true.to_string(),
            Value::Null => "null".to_owned(),
            Value::Other(what) => (*what).to_owned(),
        };
        all.push(Entry { name, value: EntryValue::Word(word) });
    }
    all
}
