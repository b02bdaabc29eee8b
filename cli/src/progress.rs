//! How far a long computation has come, and whether it shall stop.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// How long a computation may last without a word.
const SILENCE: Duration = Duration::from_secs(1);
/// Looking at the clock takes as long as a step.
const STEPS_A_LOOK: usize = 256;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether the user has asked to stop.
pub fn is_interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// From now on an interrupt is noted, and does not end the program in the middle of its output.
pub fn note_interrupts() {
    static ONCE: Once = Once::new();
    // Without a handler an interrupt ends the program at once, which leaves nothing half done either.
    ONCE.call_once(|| drop(ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed))));
}

/// A bar on the terminal once a computation has lasted a second; nothing where standard error is no terminal.
pub struct Progress {
    total: usize,
    done: usize,
    started: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Over a number of steps. It stops early only where interrupts are noted.
    pub fn over(total: usize) -> Progress {
        Progress { total, done: 0, started: Instant::now(), bar: None }
    }

    /// Begins the next step; false if it shall not be begun.
    pub fn step(&mut self) -> bool {
        self.done += 1;
        if self.done.is_multiple_of(STEPS_A_LOOK) {
            if self.bar.is_none() && self.started.elapsed() > SILENCE {
                self.bar = Some(bar(self.total).with_elapsed(self.started.elapsed()));
            }
            if let Some(bar) = &self.bar {
                bar.set_position(self.done as u64);
            }
        }
        !is_interrupted()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar(total: usize) -> ProgressBar {
    let style =
        ProgressStyle::with_template("{wide_bar} {pos} of {len} points, {eta} left").unwrap_or_else(|_| ProgressStyle::default_bar());
    // On standard error, and only if that is a terminal.
    ProgressBar::new(total as u64).with_style(style)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_s_template_is_sound() {
        assert!(ProgressStyle::with_template("{wide_bar} {pos} of {len} points, {eta} left").is_ok());
    }

    #[test]
    fn steps_go_on_until_interrupted() {
        let mut progress = Progress::over(3);
        assert!((0..3).all(|_| progress.step()));
        assert!(progress.bar.is_none(), "nothing is shown in the first second");
    }
}
