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
    all_nearest(word, candidates).first().copied()
}

/// Returns every candidate that is as near and as alike as the nearest.
fn all_nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    // Nobody misspells a word this long, and the comparison takes quadratic time.
    if word.len() > 64 {
        return Vec::new();
    }
    let allowed = word.chars().count().div_ceil(3).min(3);
    let lower = word.to_lowercase();
    let mut best = (usize::MAX, 0.0);
    let mut named = Vec::new();
    for candidate in candidates {
        let edits = if lower == candidate.to_lowercase() { 0 } else { strsim::damerau_levenshtein(word, candidate) };
        // A word with every letter replaced is not a misspelling.
        if edits > allowed || edits >= word.chars().count().max(candidate.chars().count()) {
            continue;
        }
        let alike = strsim::jaro_winkler(word, candidate);
        if edits < best.0 || (edits == best.0 && alike > best.1) {
            (best, named) = ((edits, alike), vec![candidate]);
        } else if (edits, alike) == best {
            named.push(candidate);
        }
    }
    named
}

/// Asks whether a known name was meant by an unknown one: names of which it is a part, as a quantity without its vehicle is, or else the one that it misspells.
pub fn did_you_mean(name: &str, known: impl IntoIterator<Item = impl AsRef<str>>) -> Option<String> {
    /// Maximum number of names.
    const MOST: usize = 4;
    let known: Vec<_> = known.into_iter().collect();
    let known: Vec<&str> = known.iter().map(AsRef::as_ref).collect();
    let begins = |part: &str| part.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'));
    let ends = |known: &&&str| known.strip_suffix(name).is_some_and(|before| before.ends_with('.'));
    let holds = |known: &&&str| known.split('.').any(begins);
    let whole: Vec<&str> = known.iter().filter(ends).copied().collect();
    let parts = if whole.is_empty() { known.iter().filter(holds).copied().collect() } else { whole };
    let asked = if name.is_empty() || parts.is_empty() { all_nearest(name, known.into_iter()) } else { parts };
    let quoted: Vec<String> = asked.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let list = match &quoted[..] {
        [] => return None,
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    };
    Some(format!("did you mean {list}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_names_stands_for_them_and_else_the_nearest_is_meant() {
        let known = [
            "vehicle.1.speed",
            "vehicle.2.speed",
            "energy.loss",
            "energy.normal_work",
            "vehicle.1.delta_v.x",
            "vehicle.1.delta_v_magnitude",
        ];
        let meant = |name| did_you_mean(name, known);
        assert_eq!(meant("speed").as_deref(), Some("did you mean `vehicle.1.speed` or `vehicle.2.speed`?"));
        assert_eq!(meant("energy").as_deref(), Some("did you mean `energy.loss` or `energy.normal_work`?"));
        assert_eq!(meant("delta_v").as_deref(), Some("did you mean `vehicle.1.delta_v.x` or `vehicle.1.delta_v_magnitude`?"));
        assert_eq!(meant("energy.los").as_deref(), Some("did you mean `energy.loss`?"));
        assert_eq!(
            meant("vehicle").as_deref(),
            Some("did you mean `vehicle.1.speed`, `vehicle.2.speed`, `vehicle.1.delta_v.x` or `vehicle.1.delta_v_magnitude`?")
        );
        assert_eq!(meant("vehicle.3.speed").as_deref(), Some("did you mean `vehicle.1.speed` or `vehicle.2.speed`?"));
        assert_eq!([meant(""), meant("delt"), meant("loses_of_nothing")], [None, None, None]);
    }

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
