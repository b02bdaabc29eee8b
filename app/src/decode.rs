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
    if let Some(is) = not_a_text(&bytes) {
        return Err(unreadable(name, is));
    }
    let has_mark = bytes.starts_with(Source::MARK.as_bytes());
    let mark = if has_mark { Source::MARK.len() } else { 0 };
    bytes.drain(..mark);
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to() + mark;
        unreadable(name, &format!("is not UTF-8 text: the byte at offset {at} is not valid"))
    })?;
    if text.trim().is_empty() {
        return Err(unreadable(name, "is empty"));
    }
    Ok(Source { has_mark, ..Source::new(name, text) })
}

/// Returns what a file is, with a remedy, if by its first bytes it is no text that can be read.
pub fn not_a_text(begin: &[u8]) -> Option<&'static str> {
    match begin {
        // Its mark, or a plain character of two bytes, of which one is zero.
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, 1..=0x7f, ..] | [1..=0x7f, 0, ..] => Some("is UTF-16; save it as UTF-8"),
        [0x1f, 0x8b, ..] => Some("is compressed by gzip; decompress it"),
        [b'P', b'K', 3, 4, ..] => Some("is a workbook or an archive; save what it holds as text, a table as CSV"),
        _ => None,
    }
}

/// Returns the issue for a file that is too large.
pub fn too_large(name: &str) -> Issues {
    unreadable(name, &format!("is larger than {} MiB, the most that is read of a file", Source::LARGEST >> 20))
}

/// Returns an issue with a file as a whole.
pub fn unreadable(name: &str, what: &str) -> Issues {
    let source = Source::new(name, "");
    Issues::new(Cause::Input, source.into(), vec![Issue::of_file("unreadable-file", format!("`{name}` {what}"))])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts() {
        let marked = source("a", b"\xef\xbb\xbfa = 1\r\n".to_vec()).unwrap();
        assert_eq!((marked.text.as_str(), marked.content().as_bytes()), ("a = 1\r\n", &b"\xef\xbb\xbfa = 1\r\n"[..]));
        assert_eq!(source("a", b"a = 1".to_vec()).unwrap().content(), "a = 1");
        let refused = |bytes: &[u8]| source("a.toml", bytes.to_vec()).unwrap_err().to_string();
        for utf_16 in [b"\xff\xfea\0", b"\xfe\xff\0a", b"a\0b\0", b"\0a\0b"] {
            assert_eq!(refused(utf_16), "`a.toml` is UTF-16; save it as UTF-8");
        }
        assert_eq!(refused(b"\xef\xbb\xbfab\xff"), "`a.toml` is not UTF-8 text: the byte at offset 5 is not valid");
        assert_eq!(refused(&vec![b'a'; Source::LARGEST as usize + 1]), "`a.toml` is larger than 4 MiB, the most that is read of a file");
        for (begin, is) in [(&b"\x1f\x8b\x08\0"[..], "compressed by gzip; decompress it"), (b"PK\x03\x04\x14", "a workbook or an archive")]
        {
            assert!(refused(begin).starts_with(&format!("`a.toml` is {is}")), "{}", refused(begin));
        }
        for empty in [&b""[..], b" \r\n\t", b"\xef\xbb\xbf\n"] {
            assert_eq!(refused(empty), "`a.toml` is empty");
        }
    }
}
