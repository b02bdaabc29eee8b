//! Quotes of a table in text. A cell that begins with a quote and never ends takes every row after it, and the reader of the format does not tell.

use std::io::{self, Read};

use memchr::memchr;

/// Follows the quotes of what is read.
pub struct Quotes<R> {
    from: R,
    state: State,
    /// Bytes read.
    read: usize,
    /// Ends of lines read.
    lines: u64,
    /// The byte read last.
    last: u8,
}

#[derive(Clone, Copy)]
enum State {
    /// In no quotes.
    Outside,
    /// In quotes that begin in this line.
    Inside(u64),
    /// After a quote at this place. It closes the quotes that began in this line, unless the next byte is a quote too.
    Ended(usize, u64),
}

impl<R> Quotes<R> {
    /// Follows a table from its beginning.
    pub fn new(from: R) -> Quotes<R> {
        Quotes { from, state: State::Outside, read: 0, lines: 0, last: b'\n' }
    }

    /// Returns the line, counted from 1, of the quote that begins a cell which has not ended.
    pub fn open_since(&self) -> Option<u64> {
        if let State::Inside(line) = self.state { Some(line) } else { None }
    }

    fn note(&mut self, bytes: &[u8]) {
        let mut at = 0;
        while let Some(found) = memchr(b'"', &bytes[at..]) {
            let quote = at + found;
            self.lines += memchr::memchr_iter(b'\n', &bytes[at..quote]).count() as u64;
            let before = if quote == 0 { self.last } else { bytes[quote - 1] };
            let place = self.read + quote;
            // The byte order mark has three bytes, of which this is the last.
            let begins_cell = matches!(before, b',' | b'\n' | b'\r') || (place == 3 && before == 0xbf);
            self.state = match self.state {
                State::Inside(line) => State::Ended(place, line),
                State::Ended(last, line) if place == last + 1 => State::Inside(line),
                State::Outside | State::Ended(..) if begins_cell => State::Inside(self.lines + 1),
                State::Outside | State::Ended(..) => State::Outside,
            };
            at = quote + 1;
        }
        self.lines += memchr::memchr_iter(b'\n', &bytes[at..]).count() as u64;
        self.read += bytes.len();
        self.last = bytes.last().copied().unwrap_or(self.last);
    }
}

impl<R: Read> Read for Quotes<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let read = self.from.read(to)?;
        self.note(&to[..read]);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The open quotes after a text that is read some bytes at a time.
    fn open(text: &str, bytes: usize) -> Option<u64> {
        let mut quotes = Quotes::new(text.as_bytes());
        let mut part = vec![0; bytes];
        while quotes.read(&mut part).expect("a text") > 0 {}
        quotes.open_since()
    }

    #[test]
    fn a_cell_that_never_ends_is_found_in_parts_of_any_size() {
        for (text, line) in [
            ("a,b\n1,\"x\n2,y\n", Some(2)),
            ("a,b\n1,\"x\"\n2,\"y\ny\"\n3,\"\n4,5", Some(5)),
            ("\"a\nb", Some(1)),
            ("\u{feff}\"a", Some(1)),
            ("a\r\"b", Some(1)),
            ("a,\"\"\"\n", Some(1)),
            ("a,\"b\"\"", Some(1)),
            ("a,\"b\"\"\"", None),
            ("a,\"\"\n", None),
            ("a,b\n5\" dent,\"x\"\n", None),
            ("a,\"x\"y\"z,b\n", None),
            ("\u{feff}\"a\",\"b\"\n", None),
            ("", None),
        ] {
            for bytes in [1, 2, 3, 100] {
                assert_eq!(open(text, bytes), line, "{text:?} in parts of {bytes}");
            }
        }
    }

    /// Where the quotes end, the reader of the format has the rows that the lines are.
    #[test]
    fn the_reader_of_the_format_agrees() {
        let alphabet = ["\"", ",", "\n", "a", "\r"];
        for number in 0..alphabet.len().pow(6) {
            let text: String = (0..6).map(|place| alphabet[number / alphabet.len().pow(place) % alphabet.len()]).collect();
            let cells = |text: &str| {
                let reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
                reader.into_records().map(|record| record.expect("text").iter().map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
            };
            // A mark that is added is a cell of its own, unless it is inside of quotes.
            let is_inside = !cells(&format!("{text}\nmark")).last().is_some_and(|row| row.len() == 1 && row[0] == "mark");
            assert_eq!(open(&text, 2).is_some(), is_inside, "{text:?}");
        }
    }
}
