//! The tree of a JSON file, strictly RFC 8259 and without duplicate keys.

use std::collections::HashSet;
use std::ops::Range;

use jsonc_parser::ast::{self, ObjectPropName};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::tree::{Entry, Node, Number, Value};
use crate::issue::{Issue, MOST_KEPT};
use crate::quantity::excerpt;

const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// The same, but accepts `NaN` and `Infinity` as numbers, because some programs write them.
const WITH_NON_FINITE: ParseOptions = ParseOptions { allow_non_finite_numbers: true, ..STRICT };

/// Parses JSON. The parser stops at its first error and limits the depth of nesting itself.
///
/// # Errors
///
/// Returns the first syntax error, or every duplicate key and every character that JSON does not allow.
pub fn parse(text: &str) -> Result<Node, Vec<Issue>> {
    parse_as(text, &STRICT)
}

/// Parses JSON in which a number may be `NaN` or `Infinity`, which JSON does not allow.
///
/// # Errors
///
/// As [`parse`].
pub fn parse_with_non_finite(text: &str) -> Result<Node, Vec<Issue>> {
    parse_as(text, &WITH_NON_FINITE)
}

fn parse_as(text: &str, options: &ParseOptions) -> Result<Node, Vec<Issue>> {
    let parsed = parse_to_ast(text, &CollectOptions::default(), options).map_err(|error| {
        let kind = error.kind().to_string();
        vec![issue(span(error.range()), format!("this is not JSON: {}", lower(&kind)))]
    })?;
    let mut issues = stray_characters(text);
    let root = parsed.value.map(|value| node(value, &mut issues));
    match root {
        Some(root) if issues.is_empty() => Ok(root),
        None => Err(vec![Issue::of_file("syntax", "this is not JSON: there is no value")]),
        Some(_) => Err(issues),
    }
}

fn issue(span: Range<usize>, message: String) -> Issue {
    Issue { span: Some(span), ..Issue::of_file("syntax", message) }
}

fn span(range: jsonc_parser::common::Range) -> Range<usize> {
    range.start..range.end
}

/// Lowers the initial capital of the parser's messages, which follow a colon here.
fn lower(message: &str) -> String {
    let mut letters = message.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// Finds characters that the parser accepts and JSON does not allow: control characters in strings, and white space
/// other than space, tab and line ends between values.
fn stray_characters(text: &str) -> Vec<Issue> {
    // Fast path: most texts contain no such character.
    if text.bytes().all(|byte| (b' '..=b'~').contains(&byte)) {
        return Vec::new();
    }
    let mut issues = Vec::new();
    let (mut quoted, mut escaped) = (false, false);
    for (at, c) in text.char_indices() {
        let stray = if quoted { c < ' ' } else { !c.is_ascii_graphic() && !" \t\r\n".contains(c) };
        if stray && issues.len() < MOST_KEPT {
            let place = if quoted { "inside a string" } else { "between values" };
            let message = format!("this is not JSON: the character {} {place}", c.escape_unicode());
            issues.push(issue(at..at + c.len_utf8(), message));
        }
        if c == '"' && !escaped {
            quoted = !quoted;
        }
        escaped = quoted && c == '\\' && !escaped;
    }
    issues
}

fn node(value: ast::Value<'_>, issues: &mut Vec<Issue>) -> Node {
    let span = span(value.range());
    let value = match value {
        ast::Value::StringLit(string) => Value::String(string.value.into_owned()),
        ast::Value::NumberLit(number) => {
            Value::Number(Number { text: number.value.to_owned(), integer: !number.value.contains(['.', 'e', 'E']) })
        }
        ast::Value::BooleanLit(boolean) => Value::Bool(boolean.value),
        ast::Value::NullKeyword(_) => Value::Null,
        ast::Value::Array(array) => Value::Array(array.elements.into_iter().map(|item| node(item, issues)).collect()),
        ast::Value::Object(object) => Value::Table(entries(object, issues)),
    };
    Node { span, value }
}

fn entries(object: ast::Object<'_>, issues: &mut Vec<Issue>) -> Vec<Entry> {
    let mut seen = HashSet::new();
    let mut entries: Vec<Entry> = Vec::with_capacity(object.properties.len());
    // For a few keys a pairwise comparison is fast; a hostile object may have a million.
    let are_many = object.properties.len() > 16;
    for property in object.properties {
        let key_span = span(property.name.range());
        let key = match property.name {
            ObjectPropName::String(string) => string.value.into_owned(),
            ObjectPropName::Word(word) => word.value.to_owned(),
        };
        let is_twice = if are_many { !seen.insert(key.clone()) } else { entries.iter().any(|entry| entry.key == key) };
        if is_twice && issues.len() < MOST_KEPT {
            let message = format!("the key {} stands twice in one object", excerpt(&key));
            issues.push(issue(key_span.clone(), message));
        }
        entries.push(Entry { key, key_span, node: node(property.value, issues) });
    }
    entries
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(text: &str) -> Vec<String> {
        parse(text).unwrap_err().into_iter().map(|issue| issue.message.to_string()).collect()
    }

    #[test]
    fn values_with_their_places() {
        let text = r#"{"z": [1, -2.5e1, null, true], "a": "\u00e9 \"{,\t"}"#;
        let root = parse(text).unwrap();
        assert_eq!(root.span, 0..text.len());
        let Value::Table(entries) = root.value else { panic!("an object") };
        assert_eq!((entries[0].key.as_str(), entries[1].key.as_str()), ("z", "a"));
        assert_eq!(entries[1].node.value, Value::String("é \"{,\t".to_owned()));
        let Value::Array(items) = &entries[0].node.value else { panic!("an array") };
        assert_eq!(items[0].value, Value::Number(Number { text: "1".to_owned(), integer: true }));
        assert_eq!(items[1].value, Value::Number(Number { text: "-2.5e1".to_owned(), integer: false }));
        assert_eq!(&text[items[1].span.clone()], "-2.5e1");
        assert_eq!((&items[2].value, &items[3].value), (&Value::Null, &Value::Bool(true)));
    }

    #[test]
    fn only_strict_json_passes() {
        for text in [
            "// c\n{}",
            "{} /* c */",
            "{\"a\": 1,}",
            "[1,]",
            "[1 2]",
            "{\"a\": 1 \"b\": 2}",
            "{a: 1}",
            "{'a': 1}",
            "['a']",
            "[0x10]",
            "[+1]",
            "[.5]",
            "[5.]",
            "[01]",
            "[NaN]",
            "[Infinity]",
            "[-Infinity]",
            "[\"\\x41\"]",
            "[\"\\v\"]",
            "[1]]",
            "{} {}",
            "[1",
            "{",
            "[\"a]",
            "[,]",
            "[1,,2]",
            "{\"a\"}",
            "{\"a\":}",
            "[1}",
            "[1:2]",
            "[tru]",
            "[1e]",
            "[-]",
            "[\"\\ud800\"]",
            "[\"a\nb\"]",
            "[\u{a0}1]",
            "[1\u{c}]",
            "{\"a\": 1 [2]}",
            "{\"a\": 1 : 2}",
            "{,}",
            "[true_]",
            "[\"\\'\"]",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
        for text in ["[0, -0.0, 1e5, 1E+5]", "[\"\\\\\", \"\\\"\"]", " \t\r\n{}\n", "[\"\u{a0}é\"]", "1"] {
            assert!(parse(text).is_ok(), "{text}");
        }
    }

    #[test]
    fn problems_are_told() {
        assert_eq!(messages("{\"a\": 1,}"), ["this is not JSON: trailing commas are not allowed"]);
        assert_eq!(messages("{\"a\": 1, \"b\": {\"a\": 1}, \"a\": 2, \"\\u0061\": 3}"), ["the key `a` stands twice in one object"; 2]);
        assert_eq!(messages("[\"a\tb\"]"), ["this is not JSON: the character \\u{9} inside a string"]);
    }

    #[test]
    fn deep_nesting_is_refused_quickly() {
        let deep = 100_000;
        for text in [
            "[".repeat(deep),
            format!("{}{}", "[".repeat(deep), "]".repeat(deep)),
            "{\"a\":".repeat(deep),
            format!("{}1{}", "{\"a\":".repeat(deep), "}".repeat(deep)),
        ] {
            assert_eq!(messages(&text), ["this is not JSON: maximum nesting depth exceeded"]);
        }
    }
}
