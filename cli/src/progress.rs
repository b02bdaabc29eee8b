//! Shows the progress of a long computation on a terminal.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use planar_impact_app::Control;

use crate::interrupt;

/// Time after which a computation shows its progress.
pub const SILENCE: Duration = Duration::from_secs(1);
/// Steps after which the clock is not read at each one, and those between two readings then: a step may take no longer than a reading.
const FIRST: usize = 256;
const STEPS_A_LOOK: usize = 16;

const TEMPLATE: &str = "{wide_bar} {pos} of {len}, {eta} left";

/// A progress bar on standard error, shown after one second; not shown if standard error is not a terminal. An
/// interrupt stops the computation.
pub struct Progress {
    started: Instant,
    steps: AtomicUsize,
    bar: OnceLock<ProgressBar>,
}

impl Progress {
    /// Starts a bar for a computation that begins now.
    pub fn new() -> Progress {
        Progress { started: Instant::now(), steps: AtomicUsize::new(0), bar: OnceLock::new() }
    }
}

impl Control for Progress {
    fn goes_on(&self, done: usize, total: usize) -> bool {
        interrupt::note();
        let steps = self.steps.fetch_add(1, Ordering::Relaxed) + 1;
        if (steps < FIRST || steps.is_multiple_of(STEPS_A_LOOK)) && self.started.elapsed() > SILENCE {
            let bar = self.bar.get_or_init(|| styled(ProgressBar::new(total as u64), TEMPLATE).with_elapsed(self.started.elapsed()));
            bar.set_length(total as u64);
            bar.set_position(done as u64);
        }
        !interrupt::is_interrupted()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

/// Creates a bar in a style. It draws on standard error, and only if that is a terminal.
pub fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    bar.with_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_s_template_is_sound() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }

    #[test]
    fn steps_go_on_until_interrupted() {
        let progress = Progress::new();
        assert!((0..1000).all(|done| progress.goes_on(done, 1000)));
        assert!(progress.bar.get().is_none(), "nothing is shown in the first second");
    }
}
