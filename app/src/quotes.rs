//! Quotes of a table in text. Readers of the format take any: a cell that never ends has the rows after it, and what follows the closing quote of a cell is added to it.

use std::fmt;

/// Follows the quotes of a text that is read part by part.
#[derive(Debug)]
pub struct Quotes {
    state: State,
    /// Ends of lines.
    lines: u64,
    /// The byte read last.
    last: u8,
    /// Bytes read, up to the length of a byte order mark.
    read: usize,
    /// The line of the first cell that goes on after its closing quote.
    goes_on: Option<u64>,
}

#[derive(Clone, Copy, Debug)]
enum State {
    /// In no quotes.
    Outside,
    /// In quotes that begin in this line.
    Inside(u64),
    /// After a quote within those that began in this line. Directly after it, another one makes both of them one of the cell.
    Closed { line: u64, directly: bool },
}

/// What is wrong with the quotes of a table, and the line, counted from 1, in which the cell begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuoteFault {
    /// The cell has no end.
    NeverClosed(u64),
    /// The cell goes on after its end.
    GoesOn(u64),
}

impl Default for Quotes {
    fn default() -> Quotes {
        Quotes { state: State::Outside, lines: 0, last: b'\n', read: 0, goes_on: None }
    }
}

impl Quotes {
    /// Returns what is wrong with the quotes of a whole text.
    pub fn fault_of(text: &str) -> Option<QuoteFault> {
        let mut quotes = Quotes::default();
        quotes.follow(text.as_bytes());
        quotes.fault(true)
    }

    /// Returns what is wrong with the quotes so far, at the end of the text or within.
    pub fn fault(&self, is_end: bool) -> Option<QuoteFault> {
        match (self.goes_on, self.state) {
            (Some(line), _) => Some(QuoteFault::GoesOn(line)),
            (None, State::Inside(line)) if is_end => Some(QuoteFault::NeverClosed(line)),
            _ => None,
        }
    }

    /// Follows the next bytes.
    pub fn follow(&mut self, bytes: &[u8]) {
        let mut at = 0;
        while at < bytes.len() {
            match self.state {
                State::Closed { line, directly } => {
                    match bytes[at] {
                        b'"' if directly => self.state = State::Inside(line),
                        b' ' | b'\t' => self.state = State::Closed { line, directly: false },
                        b',' | b'\n' | b'\r' => {
                            self.state = State::Outside;
                            continue;
                        }
                        _ => {
                            self.goes_on.get_or_insert(line);
                            self.state = State::Outside;
                            continue;
                        }
                    }
                    at += 1;
                }
                state => {
                    let quote = memchr::memchr(b'"', &bytes[at..]).map(|found| at + found);
                    self.lines += memchr::memchr_iter(b'\n', &bytes[at..quote.unwrap_or(bytes.len())]).count() as u64;
                    let Some(quote) = quote else { break };
                    let before = if quote == 0 { self.last } else { bytes[quote - 1] };
                    // The byte order mark has three bytes, of which this is the last.
                    let begins_cell = matches!(before, b',' | b'\n' | b'\r') || (self.read + quote == 3 && before == 0xbf);
                    self.state = match state {
                        State::Inside(line) => State::Closed { line, directly: true },
                        _ if begins_cell => State::Inside(self.lines + 1),
                        _ => State::Outside,
                    };
                    at = quote + 1;
                }
            }
        }
        self.read += bytes.len();
        self.last = bytes.last().copied().unwrap_or(self.last);
    }
}

impl QuoteFault {
    /// Returns the line, counted from 1, in which the cell begins.
    pub fn line(self) -> u64 {
        match self {
            QuoteFault::NeverClosed(line) | QuoteFault::GoesOn(line) => line,
        }
    }
}

impl fmt::Display for QuoteFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            QuoteFault::NeverClosed(line) => write!(f, "the quote that begins a cell in line {line} is never closed"),
            QuoteFault::GoesOn(line) => {
                write!(f, "the cell that begins in line {line} goes on after its closing quote; write a quote within a cell twice")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use QuoteFault::{GoesOn, NeverClosed};

    /// What is wrong with a text that is read some bytes at a time.
    fn fault(text: &str, bytes: usize) -> Option<QuoteFault> {
        let mut quotes = Quotes::default();
        text.as_bytes().chunks(bytes).for_each(|part| quotes.follow(part));
        quotes.fault(true)
    }

    #[test]
    fn faults_are_found_in_parts_of_any_size() {
        for (text, wanted) in [
            ("a,b\n1,\"x\n2,y\n", Some(NeverClosed(2))),
            ("a,b\n1,\"x\"\n2,\"y\ny\"\n3,\"\n4,5", Some(NeverClosed(5))),
            ("\"a\nb", Some(NeverClosed(1))),
            ("\u{feff}\"a", Some(NeverClosed(1))),
            ("a\r\"b", Some(NeverClosed(1))),
            ("a,\"\"\"\n", Some(NeverClosed(1))),
            ("a,\"b\"\"", Some(NeverClosed(1))),
            ("a,\"b\"\"\"", None),
            ("a,\"\"\n", None),
            ("a,b\n5\" dent,\"x\"\n", None),
            ("\u{feff}\"a\",\"b\"\n", None),
            ("a,\"b\" ,\"c\"\t\r\n", None),
            ("a,\"x\"y\"z,b\n", Some(GoesOn(1))),
            ("a\n\"x\ny\"z\n", Some(GoesOn(2))),
            ("a,b\n\n\"1\" \"2\",3\n", Some(GoesOn(3))),
            ("\"1\"5\n\"", Some(GoesOn(1))),
            ("", None),
        ] {
            for bytes in [1, 2, 3, 100] {
                assert_eq!(fault(text, bytes), wanted, "{text:?} in parts of {bytes}");
            }
        }
    }

    #[test]
    fn a_cell_that_is_open_is_no_fault_within_the_text() {
        let mut quotes = Quotes::default();
        quotes.follow(b"a,\"b");
        assert_eq!((quotes.fault(false), quotes.fault(true)), (None, Some(NeverClosed(1))));
        quotes.follow(b"\"c");
        assert_eq!(quotes.fault(false), Some(GoesOn(1)));
        assert_eq!(
            GoesOn(7).to_string(),
            "the cell that begins in line 7 goes on after its closing quote; write a quote within a cell twice"
        );
        assert_eq!((GoesOn(7).line(), NeverClosed(8).line()), (7, 8));
    }

    /// Where the quotes end, the reader of the format has the rows that the lines are.
    #[test]
    fn the_reader_of_the_format_agrees() {
        let alphabet = ["\"", ",", "\n", "a", "\r"];
        for number in 0..alphabet.len().pow(6) {
            let text: String = (0..6).map(|place| alphabet[number / alphabet.len().pow(place) % alphabet.len()]).collect();
            let cells = |text: &str| crate::case::Rows::of(text).map(|(_, cells)| cells).collect::<Vec<_>>();
            // A mark that is added is a cell of its own, unless it is inside of quotes.
            let is_inside = !cells(&format!("{text}\nmark")).last().is_some_and(|row| row.len() == 1 && row[0] == "mark");
            match fault(&text, 2) {
                Some(GoesOn(_)) => (),
                found => assert_eq!(found.is_some(), is_inside, "{text:?}"),
            }
        }
    }
}
