//! Decodes the bytes of a file into text.

use crate::issue::{Cause, Issue, Issues};
use crate::source::Source;

/// Decodes the bytes of a file.
///
/// # Errors
///
/// Returns one issue, which names the file, if it is too large, not UTF-8, or empty.
pub fn source(name: &str, mut bytes: Vec<u8>) -> Result<Source, Issues> {
    if bytes.len() as u64 > Source::LARGEST {
        return Err(too_large(name));
    }
    if is_utf_16(&bytes) {
        return Err(unreadable(name, "is UTF-16; save it as UTF-8"));
    }
    let mark = if bytes.starts_with(&[0xef, 0xbb, 0xbf]) { 3 } else { 0 };
    bytes.drain(..mark);
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to() + mark;
        unreadable(name, &format!("is not UTF-8 text: the byte at offset {at} is not valid"))
    })?;
    if text.trim().is_empty() {
        return Err(unreadable(name, "is empty"));
    }
    Ok(Source { name: name.to_owned(), text })
}

/// Returns `true` if a text begins in UTF-16: with its mark, or with a plain character of two bytes, of which one is zero.
pub fn is_utf_16(bytes: &[u8]) -> bool {
    matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, 1..=0x7f, ..] | [1..=0x7f, 0, ..])
}

/// Returns the issue for a file that is too large.
pub fn too_large(name: &str) -> Issues {
    unreadable(name, &format!("is larger than {} MiB, the most that is read of a file", Source::LARGEST >> 20))
}

/// Returns an issue with a file as a whole.
pub fn unreadable(name: &str, what: &str) -> Issues {
    let source = Source { name: name.to_owned(), text: String::new() };
    Issues::new(Cause::Input, source.into(), vec![Issue::of_file("unreadable-file", format!("`{name}` {what}"))])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts() {
        let text = |bytes: &[u8]| source("a", bytes.to_vec()).map(|source| source.text);
        assert_eq!(text(b"\xef\xbb\xbfa = 1\r\n").unwrap(), "a = 1\r\n"); // mark skipped, CRLF kept
        let refused = |bytes: &[u8]| source("a.toml", bytes.to_vec()).unwrap_err().to_string();
        for utf_16 in [b"\xff\xfea\0", b"\xfe\xff\0a", b"a\0b\0", b"\0a\0b"] {
            assert_eq!(refused(utf_16), "`a.toml` is UTF-16; save it as UTF-8");
        }
        assert_eq!(refused(b"\xef\xbb\xbfab\xff"), "`a.toml` is not UTF-8 text: the byte at offset 5 is not valid");
        assert_eq!(refused(&vec![b'a'; Source::LARGEST as usize + 1]), "`a.toml` is larger than 4 MiB, the most that is read of a file");
        for empty in [&b""[..], b" \r\n\t", b"\xef\xbb\xbf\n"] {
            assert_eq!(refused(empty), "`a.toml` is empty");
        }
    }
}
