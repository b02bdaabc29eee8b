//! Removes characters that a terminal or a document would interpret from text of a file or a call, and limits its length.

use std::borrow::Cow;

use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// Replaces control characters (C0, C1), line and paragraph separators, and directional formatting characters with spaces.
pub fn clean(text: &str) -> String {
    text.chars().map(|c| if is_active(c) { ' ' } else { c }).collect()
}

/// Replaces each character that a document would interpret, or that XML does not allow, with its code point: U+202E. A tab and a line break become spaces.
pub fn shown(text: &str) -> Cow<'_, str> {
    let is_hidden = |c: char| is_active(c) || matches!(c, '\u{fffe}' | '\u{ffff}');
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::new();
    for c in text.chars() {
        match c {
            '\t' | '\n' | '\r' => shown.push(' '),
            c if is_hidden(c) => shown.push_str(&format!("U+{:04X}", u32::from(c))),
            c => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

/// Returns `true` if a terminal or a document interprets a character instead of showing it.
pub fn is_active(c: char) -> bool {
    c.is_control() || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Shows a name as [`shown`] does, shortened to at most `most` columns.
pub fn shorten(name: &str, most: usize) -> String {
    // A sequence of combining characters has no width, so limit its length as well.
    let begin: String = name.chars().take(8 * most).collect();
    let shown = shown(&begin);
    if shown.width() <= most && name.chars().nth(8 * most).is_none() {
        return shown.into_owned();
    }
    let mut short = String::new();
    for c in shown.chars() {
        if short.width() + c.width().unwrap_or(0) >= most {
            break;
        }
        short.push(c);
    }
    short + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_their_column() {
        assert_eq!(shorten("sedan", 18), "sedan");
        assert_eq!(shorten("a sedan of a very long name", 18), "a sedan of a very…");
        assert_eq!(shorten("\u{1b}[31mred", 18), "U+001B[31mred");
        assert_eq!(shorten("a\u{202e}b\u{2028}c\n", 18), "aU+202EbU+2028c ");
        assert!(shorten(&"漢".repeat(20), 18).width() <= 18);
        assert!(shorten(&format!("a{}", "\u{301}".repeat(1000)), 18).chars().count() < 200);
    }

    #[test]
    fn what_a_terminal_acts_on_becomes_a_space() {
        for c in ['\u{0}', '\u{1b}', '\u{7f}', '\u{85}', '\u{9b}', '\u{61c}', '\u{200f}', '\u{2028}', '\u{202e}', '\u{2067}'] {
            assert_eq!(clean(&format!("a{c}b")), "a b", "{c:?}");
        }
        assert_eq!(clean("é 漢 −"), "é 漢 −");
    }
}
