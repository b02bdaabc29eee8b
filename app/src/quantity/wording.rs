//! Helpers for messages: excerpts of limited length, and the nearest known word.

use crate::plain_text::clean;

/// Maximum length of an excerpt of a file in a message, in characters.
const EXCERPT: usize = 48;

/// Returns `text` in backquotes, on one line and shortened, so that no file can flood a message.
pub fn excerpt(text: &str) -> String {
    let end = text.char_indices().nth(EXCERPT).map(|(end, _)| end);
    let ellipsis = if end.is_some() { "…" } else { "" };
    format!("`{}{ellipsis}`", clean(&text[..end.unwrap_or(text.len())]))
}

/// Returns the candidate that `word` most likely misspells: equal except for case, or at most one edit per three
/// letters away. Among equally near candidates, prefers the longest common prefix, then the first.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // Nobody misspells a word this long, and the comparison takes quadratic time.
    if word.len() > 64 {
        return None;
    }
    let allowed = word.chars().count().div_ceil(3).min(3);
    let lower = word.to_lowercase();
    let mut best: Option<(usize, f64, &str)> = None;
    for candidate in candidates {
        let edits = if lower == candidate.to_lowercase() { 0 } else { strsim::damerau_levenshtein(word, candidate) };
        // A word with every letter replaced is not a misspelling.
        if edits > allowed || edits >= word.chars().count().max(candidate.chars().count()) {
            continue;
        }
        let alike = strsim::jaro_winkler(word, candidate);
        if best.is_none_or(|(e, a, _)| edits < e || (edits == e && alike > a)) {
            best = Some((edits, alike, candidate));
        }
    }
    best.map(|(_, _, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn excerpts_are_short_and_on_one_line() {
        assert_eq!(excerpt("40 ft"), "`40 ft`");
        assert_eq!(excerpt("a\u{1b}b\nc\u{202e}"), "`a b c `");
        assert_eq!(excerpt(&"é".repeat(1000)), format!("`{}…`", "é".repeat(48)));
    }

    #[test]
    fn nearest_word() {
        let near = |word| nearest(word, ["mass", "yaw_inertia", "mph", "kph", "kg"].into_iter());
        assert_eq!(near("mas"), Some("mass"));
        assert_eq!(near("yaw_inerta"), Some("yaw_inertia"));
        assert_eq!(near("mhp"), Some("mph")); // two letters exchanged are one edit
        assert_eq!(near("KG"), Some("kg"));
        // As near and as alike: the first.
        assert_eq!(nearest("speeb", ["speed", "spees"].into_iter()), Some("speed"));
        assert_eq!(nearest("speeb", ["xpeeb", "speed"].into_iter()), Some("speed"));
        assert_eq!(near("color"), None);
        assert_eq!(near("xy"), None);
        assert_eq!(near(&"m".repeat(1000)), None);
    }
}
