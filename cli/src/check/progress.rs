//! How far a long run is, on a terminal.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::report::Summary;

/// How long a run may last without a word.
const SILENCE: Duration = Duration::from_secs(1);
/// Records between two looks at the clock.
const STRIDE: u64 = 1024;

const OF_FILES: &str = "{wide_bar} {percent:>3} %, {msg}, {elapsed}";
const OF_A_PIPE: &str = "{spinner} {msg}, {elapsed}";

/// A bar on standard error once a run has lasted a second; nothing where that is no terminal.
pub struct Progress {
    /// How many bytes there are to be read, if that is known, and how many have been.
    size: Option<u64>,
    bytes: Arc<AtomicU64>,
    started: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Of as many bytes as there are to be read, if that is known.
    pub fn new(size: Option<u64>, bytes: Arc<AtomicU64>) -> Progress {
        Progress { size, bytes, started: Instant::now(), bar: None }
    }

    /// After each record.
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

    /// Does something that may write to the same terminal.
    pub fn aside<T>(&self, write: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Takes the bar away.
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
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    // On standard error, and only if that is a terminal.
    let bar = size.map_or_else(ProgressBar::new_spinner, ProgressBar::new);
    bar.with_style(style)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_templates_are_sound() {
        assert!([OF_FILES, OF_A_PIPE].into_iter().all(|template| ProgressStyle::with_template(template).is_ok()));
    }
}
