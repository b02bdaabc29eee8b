//! A case file as a tree of values with their positions, from TOML or JSON.

use std::ops::Range;

/// A value and the range of bytes that it occupies.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The bytes of the value, or of the header for a TOML table.
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
    /// A string, with escapes resolved.
    String(String),
    /// A decimal number.
    Number(Number),
    /// True or false.
    Bool(bool),
    /// JSON's null.
    Null,
    /// A value that no key accepts, described with an article.
    Other(&'static str),
}

/// A key of a table and its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key, with quotes and escapes resolved.
    pub key: String,
    /// Position of the key.
    pub key_span: Range<usize>,
    /// The value.
    pub node: Node,
}

/// A number as written in the file. It may not be finite; `quantity::finite` checks that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number {
    /// Its text without underscores.
    pub text: String,
    /// `true` if it is written without point and exponent.
    pub integer: bool,
}

impl Value {
    /// Returns the name of this type of value with its article.
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
