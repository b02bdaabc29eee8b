//! Shows the progress of a long run on a terminal.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use indicatif::ProgressBar;
use planar_impact_app::check::Summary;

use crate::progress::{SILENCE, styled};

/// Number of records between two readings of the clock.
const STRIDE: u64 = 1024;

const OF_FILES: &str = "{wide_bar} {percent:>3} %, {msg}, {elapsed}";
const OF_A_PIPE: &str = "{spinner} {msg}, {elapsed}";

/// A progress bar on standard error, shown after one second; not shown if standard error is not a terminal.
pub struct Progress {
    /// Total number of bytes to read, if it is known, and number of bytes read so far.
    size: Option<u64>,
    bytes: Arc<AtomicU64>,
    started: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Starts a bar for `size` bytes, if the size is known.
    pub fn new(size: Option<u64>, bytes: Arc<AtomicU64>) -> Progress {
        Progress { size, bytes, started: Instant::now(), bar: None }
    }

    /// Updates the bar; called after each record.
    pub fn update(&mut self, summary: &Summary) {
        if !summary.records.is_multiple_of(STRIDE) {
            return;
        }
        if self.bar.is_none() && self.started.elapsed() > SILENCE {
            self.bar = Some(bar(self.size).with_elapsed(self.started.elapsed()));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(self.bytes.load(Ordering::Relaxed));
            bar.set_message(format!("{} records, {} fail", summary.records, summary.fail));
        }
    }

    /// Runs a function that may write to the same terminal.
    pub fn aside<T>(&self, write: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Removes the bar.
    pub fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}

fn bar(size: Option<u64>) -> ProgressBar {
    let template = if size.is_some() { OF_FILES } else { OF_A_PIPE };
    styled(size.map_or_else(ProgressBar::new_spinner, ProgressBar::new), template)
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::ProgressStyle;

    #[test]
    fn the_templates_are_sound() {
        assert!([OF_FILES, OF_A_PIPE].into_iter().all(|template| ProgressStyle::with_template(template).is_ok()));
    }
}
