//! Lines of a file, one at a time, in bounded memory.

use std::io::{self, BufRead, Read};

/// The longest line that is read, in bytes. A record has a thousand or two.
pub const LONGEST: usize = 1 << 20;

/// A line without its end.
#[derive(Debug, PartialEq, Eq)]
pub enum Line<'a> {
    /// A text.
    Text(&'a str),
    /// More than the longest that is read; passed over.
    TooLong,
    /// Not UTF-8 from this byte on.
    NotUtf8(usize),
}

/// A reader of lines.
pub struct Lines<R> {
    reader: R,
    line: Vec<u8>,
    number: u64,
    /// Whether the line at hand has not been taken yet.
    ahead: bool,
    is_cut: bool,
}

impl<R: BufRead> Lines<R> {
    /// From the first line on.
    pub fn new(reader: R) -> Self {
        Lines { reader, line: Vec::new(), number: 0, ahead: false, is_cut: false }
    }

    /// The number of the line at hand, from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Whether there is another line that is not blank; it is the next one then.
    ///
    /// # Errors
    ///
    /// When the reader fails.
    pub fn has_more(&mut self) -> io::Result<bool> {
        while !self.ahead {
            if !self.fetch()? {
                return Ok(false);
            }
            self.ahead = self.is_cut || !self.line.iter().all(u8::is_ascii_whitespace);
        }
        Ok(true)
    }

    /// The next line that is not blank.
    ///
    /// # Errors
    ///
    /// When the reader fails.
    pub fn next(&mut self) -> io::Result<Option<Line<'_>>> {
        if !self.has_more()? {
            return Ok(None);
        }
        self.ahead = false;
        if self.is_cut {
            return Ok(Some(Line::TooLong));
        }
        Ok(Some(match str::from_utf8(&self.line) {
            Ok(text) => Line::Text(text),
            Err(error) => Line::NotUtf8(error.valid_up_to() + 1),
        }))
    }

    /// Reads the next line, and the rest of one that is too long to nowhere.
    fn fetch(&mut self) -> io::Result<bool> {
        self.line.clear();
        let read = (&mut self.reader).take(LONGEST as u64 + 1).read_until(b'\n', &mut self.line)?;
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        let ended = self.line.last() == Some(&b'\n');
        self.is_cut = !ended && read > LONGEST;
        if ended {
            self.line.pop();
        } else if self.is_cut {
            self.reader.skip_until(b'\n')?;
        }
        if self.line.last() == Some(&b'\r') {
            self.line.pop();
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(bytes: &[u8]) -> Vec<(u64, String)> {
        let mut lines = Lines::new(bytes);
        let mut found = Vec::new();
        while lines.has_more().unwrap() {
            let text = match lines.next().unwrap().unwrap() {
                Line::Text(text) => text.to_owned(),
                other => format!("{other:?}"),
            };
            found.push((lines.number(), text));
        }
        assert_eq!(lines.next().unwrap(), None);
        found
    }

    #[test]
    fn lines_have_their_numbers() {
        let expected = [(1, "a"), (4, "b"), (5, "c")].map(|(number, text)| (number, text.to_owned()));
        assert_eq!(all(b"a\n\n \t\r\nb\r\nc"), expected);
        assert_eq!(all(b"a\r\n\r\n\nb\nc\n"), expected);
        assert_eq!(all(b""), []);
        assert_eq!(all(b"\n \n"), []);
    }

    #[test]
    fn a_line_that_is_too_long_is_passed_over() {
        let mut bytes = b"a\n".to_vec();
        bytes.extend(std::iter::repeat_n(b'x', 3 * LONGEST));
        bytes.extend(b"\nb\n");
        assert_eq!(all(&bytes), [(1, "a".to_owned()), (2, "TooLong".to_owned()), (3, "b".to_owned())]);
        let just = [vec![b'x'; LONGEST], b"\nb".to_vec()].concat();
        assert_eq!(all(&just).iter().map(|(_, text)| text.len()).collect::<Vec<_>>(), [LONGEST, 1]);
    }

    #[test]
    fn what_is_not_text_is_told() {
        assert_eq!(all(b"a\nb\xff\nc")[1], (2, "NotUtf8(2)".to_owned()));
    }
}
