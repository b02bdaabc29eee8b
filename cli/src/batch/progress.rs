//! Shows the progress of a batch on a terminal, and keeps what is said at its end.

use std::collections::BTreeMap;
use std::time::Instant;

use indicatif::ProgressBar;
use planar_impact_app::Units;
use planar_impact_app::batch::{Refused, RowWarning};

use crate::output;
use crate::progress::{SILENCE, styled};

const OF_FILES: &str = "{wide_bar} {percent:>3} %, {msg}, {eta} left";
const OF_A_PIPE: &str = "{spinner} {msg}, {elapsed}";

/// Refused rows that are described; the others are counted.
const MOST_DESCRIBED: u64 = 10;

/// Rows that are done, with a bar on standard error after one second; not shown if standard error is not a terminal.
pub struct Progress {
    started: Instant,
    /// Total number of bytes to read, 0 if it is not known.
    bytes: u64,
    bar: Option<ProgressBar>,
    rows: u64,
    refused: u64,
    codes: BTreeMap<String, u64>,
    /// Each warning once, with the name of its first row.
    warnings: Vec<(String, RowWarning)>,
}

impl Progress {
    /// Starts for `bytes` bytes.
    pub fn new(bytes: u64) -> Progress {
        Progress { started: Instant::now(), bytes, bar: None, rows: 0, refused: 0, codes: BTreeMap::new(), warnings: Vec::new() }
    }

    /// Keeps warnings, with the names of their first rows.
    pub fn warn(&mut self, warnings: Vec<RowWarning>, name: impl Fn(usize) -> String) {
        for warning in warnings {
            match self.warnings.iter_mut().find(|(_, known)| known.is_alike(&warning)) {
                Some((_, known)) => known.rows += warning.rows,
                None => self.warnings.push((name(warning.first), warning)),
            }
        }
    }

    /// Adds rows that are done, and describes those that are refused by their names.
    pub fn add(&mut self, rows: usize, refused: &[Refused], position: u64, name: impl Fn(usize) -> String) {
        for row in refused {
            self.refused += 1;
            if self.refused <= MOST_DESCRIBED {
                self.say(&format!("{}: {}: {}", name(row.row), row.codes, Units::Si.sentence(&row.reason)));
            }
            *self.codes.entry(row.codes.clone()).or_default() += 1;
        }
        self.rows += rows as u64;
        if self.bar.is_none() && self.started.elapsed() > SILENCE {
            let (bar, template) = match self.bytes {
                0 => (ProgressBar::new_spinner(), OF_A_PIPE),
                bytes => (ProgressBar::new(bytes), OF_FILES),
            };
            self.bar = Some(styled(bar, template).with_elapsed(self.started.elapsed()));
        }
        if let Some(bar) = &self.bar {
            let rate = self.rows as f64 / self.started.elapsed().as_secs_f64();
            bar.set_position(position);
            bar.set_message(format!("{} rows, {rate:.0} rows/s, {} refused", self.rows, self.refused));
        }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Removes the bar, and says how many rows are refused and why. Returns `true` if there are any.
    pub fn finish(mut self) -> bool {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        for (first, warning) in &self.warnings {
            self.say(&format!("{}: {}", warning.notice.severity, warning.sentence(first)));
        }
        if self.refused > 0 {
            let counts: Vec<String> = self.codes.iter().map(|(codes, count)| format!("{count} {codes}")).collect();
            self.say(&format!("{} of {} rows refused: {}", self.refused, self.rows, counts.join(", ")));
        }
        self.refused > 0
    }

    fn say(&self, line: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| output::say(line)),
            None => output::say(line),
        }
    }
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
