//! Reads a file line by line, in bounded memory.

use std::io::{self, BufRead, Read};

/// The longest line that is read, in bytes. A typical record has one or two thousand.
pub const LONGEST: usize = 1 << 20;
/// The longest line that is skipped, in bytes: a device such as /dev/zero never ends a line.
const ENDLESS: usize = 64 << 20;

/// A line without its newline.
#[derive(Debug, PartialEq, Eq)]
pub enum Line<'a> {
    /// A text.
    Text(&'a str),
    /// Longer than [`LONGEST`]; skipped.
    TooLong,
    /// Invalid UTF-8 from this byte on.
    NotUtf8(usize),
}

/// Describes why a line cannot be read.
pub fn unreadable(line: &Line<'_>) -> String {
    match line {
        Line::TooLong => format!("the line is longer than {} KiB", LONGEST >> 10),
        Line::NotUtf8(at) => format!("the line is not UTF-8 text from byte {at} on"),
        Line::Text(_) => String::new(),
    }
}

/// A reader of lines.
pub struct Lines<R> {
    reader: R,
    line: Vec<u8>,
    number: u64,
    /// `true` if the current line has not been returned yet.
    ahead: bool,
    is_cut: bool,
    skips_commas: bool,
}

impl<R: BufRead> Lines<R> {
    /// Starts at the first line.
    pub fn new(reader: R) -> Self {
        Lines { reader, line: Vec::new(), number: 0, ahead: false, is_cut: false, skips_commas: false }
    }

    /// From now on takes lines of commas alone for blank ones: a spreadsheet pads empty rows with them.
    pub fn skip_commas(&mut self) {
        self.skips_commas = true;
    }

    /// Returns the number of the current line, counted from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Returns `true` if there is another line that is not blank, and makes it the current line.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn has_more(&mut self) -> io::Result<bool> {
        while !self.ahead {
            if !self.fetch()? {
                return Ok(false);
            }
            let is_blank = |byte: &u8| byte.is_ascii_whitespace() || (self.skips_commas && *byte == b',');
            self.ahead = self.is_cut || !self.line.iter().all(is_blank);
        }
        Ok(true)
    }

    /// Returns the next line that is not blank.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
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

    /// Reads the next line; discards the rest of a line that is too long.
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
            self.skip()?;
        }
        if self.line.last() == Some(&b'\r') {
            self.line.pop();
        }
        Ok(true)
    }
}

impl<R: BufRead> Lines<R> {
    /// Skips the rest of a line that is too long, up to [`ENDLESS`] bytes.
    fn skip(&mut self) -> io::Result<()> {
        let mut skipped = 0;
        loop {
            let part = self.reader.fill_buf()?;
            let end = part.iter().position(|byte| *byte == b'\n').map(|at| at + 1);
            let used = end.unwrap_or(part.len());
            skipped += used;
            self.reader.consume(used);
            if end.is_some() || used == 0 {
                return Ok(());
            }
            if skipped > ENDLESS {
                let message = format!("line {} does not end within {} MiB", self.number, ENDLESS >> 20);
                return Err(io::Error::new(io::ErrorKind::InvalidData, message));
            }
        }
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
    fn a_line_without_end_is_an_error() {
        let mut lines = Lines::new(io::BufReader::new(io::repeat(b'x')));
        assert!(lines.has_more().unwrap_err().to_string().contains("line 1 does not end within 64 MiB"));
    }

    #[test]
    fn what_is_not_text_is_told() {
        assert_eq!(all(b"a\nb\xff\nc")[1], (2, "NotUtf8(2)".to_owned()));
    }
}
