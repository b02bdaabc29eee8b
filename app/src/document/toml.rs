//! The tree of a TOML file.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::tree::{Entry, Node, Number, Value};
use crate::issue::Issue;

/// Parses TOML. The root's span is empty at the start of the text, because the root has no header.
///
/// # Errors
///
/// Returns the syntax errors, one for each line, because a second error on a line usually follows from the first.
pub(super) fn parse(text: &str) -> Result<Node, Vec<Issue>> {
    let (root, errors) = parse_recoverable(text)?;
    if errors.is_empty() {
        return Ok(Node { span: 0..0, value: table(root.into_inner()) });
    }
    let mut issues: Vec<Issue> = errors.iter().map(|error| syntax_error(text, error)).collect();
    issues.sort_by_key(start);
    // No newline separates two errors of one line.
    issues.dedup_by(|next, kept| !text.get(start(kept)..start(next)).unwrap_or("").contains('\n'));
    Err(issues)
}

/// Parses a text of more than one mebibyte only up to its first error, because the parser would collect one error for
/// each byte of a hostile file.
fn parse_recoverable(text: &str) -> Result<(Spanned<DeTable<'_>>, Vec<::toml::de::Error>), Vec<Issue>> {
    if text.len() <= 1 << 20 {
        return Ok(DeTable::parse_recoverable(text));
    }
    let root = DeTable::parse(text).map_err(|error| vec![syntax_error(text, &error)])?;
    Ok((root, Vec::new()))
}

fn start(issue: &Issue) -> usize {
    issue.span.as_ref().map_or(0, |span| span.start)
}

fn syntax_error(text: &str, error: &toml::de::Error) -> Issue {
    let is_header = || error.span().and_then(|span| text.get(..span.start)).is_some_and(|before| before.ends_with('['));
    // The most common mistakes get a clearer message: a quantity without quotes, and tables of a list in one bracket.
    let (what, help) = match error.message() {
        message if message.starts_with("string values must be quoted") => {
            ("only a number, true or false may stand without quotes", Some("as in mass = \"1500 kg\""))
        }
        message @ "duplicate key" if is_header() => {
            (message, Some("write each vehicle below a line [[vehicle]], in two brackets; any other table stands once"))
        }
        message @ "duplicate key" => (message, Some("leave one of them")),
        message => (message, None),
    };
    Issue { span: error.span(), help: help.map(Into::into), ..Issue::of_file("syntax", format!("this is not TOML: {what}")) }
}

fn node(spanned: Spanned<DeValue<'_>>) -> Node {
    let span: Range<usize> = spanned.span();
    let value = match spanned.into_inner() {
        DeValue::String(string) => Value::String(string.into_owned()),
        DeValue::Integer(integer) => match integer.radix() {
            10 => number(integer.as_str(), true),
            16 => Value::Other("a hexadecimal number"),
            8 => Value::Other("an octal number"),
            _ => Value::Other("a binary number"),
        },
        DeValue::Float(float) => number(float.as_str(), false),
        DeValue::Boolean(value) => Value::Bool(value),
        DeValue::Datetime(_) => Value::Other("a date or time"),
        DeValue::Array(items) => array(items),
        DeValue::Table(entries) => table(entries),
    };
    Node { span, value }
}

fn number(text: &str, integer: bool) -> Value {
    Value::Number(Number { text: text.to_owned(), integer })
}

fn array(items: DeArray<'_>) -> Value {
    Value::Array(items.into_iter().map(node).collect())
}

/// Restores the file order of a table's keys, which the parser sorts.
fn table(entries: DeTable<'_>) -> Value {
    let entry = |(key, value): (Spanned<_>, _)| Entry {
        key_span: key.span(),
        key: std::borrow::Cow::into_owned(key.into_inner()),
        node: node(value),
    };
    let mut entries: Vec<Entry> = entries.into_iter().map(entry).collect();
    entries.sort_by_key(|entry| entry.key_span.start);
    Value::Table(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(text: &str) -> Vec<Entry> {
        match parse(text).unwrap().value {
            Value::Table(entries) => entries,
            _ => Vec::new(),
        }
    }

    fn messages(text: &str) -> Vec<(usize, String)> {
        parse(text).unwrap_err().into_iter().map(|issue| (start(&issue), issue.message.to_string())).collect()
    }

    #[test]
    fn values_in_file_order_with_their_places() {
        let text = "z = 1_000\na = \"é\"\nm = [0x10, -1.5e3, inf, 1979-05-27, true]\n";
        let read = entries(text);
        let keys: Vec<&str> = read.iter().map(|entry| entry.key.as_str()).collect();
        assert_eq!(keys, ["z", "a", "m"]);
        assert_eq!(read[0].node.value, number("1000", true));
        assert_eq!(&text[read[0].node.span.clone()], "1_000");
        assert_eq!(&text[read[1].node.span.clone()], "\"é\"");
        let Value::Array(items) = &read[2].node.value else { panic!("an array") };
        let values: Vec<&Value> = items.iter().map(|item| &item.value).collect();
        let expected = [
            &Value::Other("a hexadecimal number"),
            &number("-1.5e3", false),
            &number("inf", false),
            &Value::Other("a date or time"),
            &Value::Bool(true),
        ];
        assert_eq!(values, expected);
    }

    #[test]
    fn a_table_stands_at_its_header() {
        let text = "[[vehicle]]\nmass = 1\n[[vehicle]]\n[impact]\n";
        let read = entries(text);
        let Value::Array(vehicles) = &read[0].node.value else { panic!("an array") };
        assert_eq!((vehicles[0].span.clone(), vehicles[1].span.clone()), (0..11, 21..32));
        assert_eq!(&text[read[1].node.span.clone()], "[impact]");
    }

    #[test]
    fn several_syntax_errors_one_for_each_line() {
        let found = messages("a = 15 kg\nb = 2\nc = [1,,2]\nb = 3\n");
        assert_eq!(found.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [4, 23, 27], "{found:?}");
        assert_eq!(found[0].1, "this is not TOML: only a number, true or false may stand without quotes");
        assert_eq!(found[2].1, "this is not TOML: duplicate key");
    }

    #[test]
    fn deep_nesting_is_refused_quickly() {
        let deep = 100_000;
        for text in [
            format!("a = {}", "[".repeat(deep)),
            format!("a = {}{}", "[".repeat(deep), "]".repeat(deep)),
            format!("a = {}", "[\n".repeat(deep)),
            format!("a = {}", "{a=".repeat(deep)),
            format!("{}a = 1", "a.".repeat(deep)),
            format!("[{}a]", "a.".repeat(deep)),
            "[".repeat(deep),
        ] {
            assert!(parse(&text).is_err());
        }
    }
}
