//! A table in text, with its quotes followed as it is read.

use std::io::{self, Read};

use planar_impact_app::quotes::{QuoteFault, Quotes};

/// Follows the quotes of what is read.
pub struct Followed<R> {
    from: R,
    quotes: Quotes,
}

impl<R> Followed<R> {
    /// Follows a table from its beginning.
    pub fn new(from: R) -> Followed<R> {
        Followed { from, quotes: Quotes::default() }
    }

    /// Returns what is wrong with the quotes so far, at the end of the table or within.
    pub fn fault(&self, is_end: bool) -> Option<QuoteFault> {
        self.quotes.fault(is_end)
    }
}

impl<R: Read> Read for Followed<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let read = self.from.read(to)?;
        self.quotes.follow(&to[..read]);
        Ok(read)
    }
}
