//! Serializes answers as JSON.

use std::borrow::Cow;
use std::fmt::Write;

use serde::Serialize;

use crate::issue::Issues;
use crate::plain_text::is_active;

/// Layout of JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A line for each value.
    Pretty,
    /// Everything on one line, for large arrays.
    Compact,
}

/// Serializes an answer as JSON, followed by a newline. An infinite number or NaN becomes `null`.
///
/// # Errors
///
/// Fails only because of a defect, because an answer is plain data.
pub fn text(answer: &impl Serialize, layout: Layout) -> Result<String, Issues> {
    let text = match layout {
        Layout::Pretty => serde_json::to_string_pretty(answer),
        Layout::Compact => serde_json::to_string(answer),
    };
    text.map(|text| escaped(&text).into_owned() + "\n").map_err(Issues::defect)
}

/// Escapes the characters that a terminal or a document would interpret. JSON itself escapes those below U+0020.
pub fn escaped(json: &str) -> Cow<'_, str> {
    let is_unsafe = |c: char| c >= '\u{7f}' && is_active(c);
    if !json.contains(is_unsafe) {
        return Cow::Borrowed(json);
    }
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        if is_unsafe(c) {
            // Writing to a string cannot fail, and none of these characters needs a surrogate pair.
            let _ = write!(text, "\\u{:04x}", u32::from(c));
        } else {
            text.push(c);
        }
    }
    Cow::Owned(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_acts_on_is_escaped() {
        let name = "a\u{1b}\u{7f}\u{85}\u{9b}\u{61c}\u{2028}\u{202e}é";
        let json = text(&name, Layout::Compact).expect("plain data");
        assert_eq!(json, "\"a\\u001b\\u007f\\u0085\\u009b\\u061c\\u2028\\u202eé\"\n");
        assert_eq!(serde_json::from_str::<String>(&json).ok().as_deref(), Some(name));
    }
}
