//! A case file as a tree of values that remember where they stand, from TOML or JSON.

use std::ops::Range;

/// A value and the range of bytes it stands in.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The bytes of the value; for a table of TOML its header.
    pub span: Range<usize>,
    /// The value.
    pub value: Value,
}

/// A value of either format.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A table or object, in file order.
    Table(Vec<Entry>),
    /// An array.
    Array(Vec<Node>),
    /// A string, its escapes resolved.
    String(String),
    /// A decimal number.
    Number(Number),
    /// True or false.
    Bool(bool),
    /// JSON's null.
    Null,
    /// What no key wants, by its name with an article.
    Other(&'static str),
}

/// A key of a table and its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key, its quotes and escapes resolved.
    pub key: String,
    /// Where the key stands.
    pub key_span: Range<usize>,
    /// The value.
    pub node: Node,
}

/// A number as the file wrote it. It may be not finite; `quantity::finite` says so.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number {
    /// Its text without underscores.
    pub text: String,
    /// Whether it is written without point and exponent.
    pub integer: bool,
}

impl Value {
    /// The name of this sort of value with its article.
    pub fn describe(&self) -> &'static str {
        match self {
            Value::Table(_) => "a table",
            Value::Array(_) => "an array",
            Value::String(_) => "a string",
            Value::Number(_) => "a number",
            Value::Bool(_) => "a boolean",
            Value::Null => "null",
            Value::Other(name) => name,
        }
    }
}
