//! Progress and cancellation of long computations, controlled by the caller.

use crate::issue::Issues;

/// Receives the progress of a verb and can stop it.
pub trait Control: Sync {
    /// Called before each step, from any thread, when `done` of `total` steps are complete. Returning `false` stops the verb.
    fn goes_on(&self, done: usize, total: usize) -> bool;
}

impl dyn Control + '_ {
    /// Reports progress before a step.
    pub(crate) fn proceed(&self, done: usize, total: usize) -> Result<(), Issues> {
        if self.goes_on(done, total) { Ok(()) } else { Err(Issues::interrupted()) }
    }
}

/// Notes the steps that a verb reports, for tests.
#[cfg(test)]
#[derive(Default)]
pub(crate) struct Noted(std::sync::Mutex<Vec<(usize, usize)>>);

#[cfg(test)]
impl Noted {
    pub fn steps(self) -> Vec<(usize, usize)> {
        self.0.into_inner().expect("no step panics")
    }
}

#[cfg(test)]
impl Control for Noted {
    fn goes_on(&self, done: usize, total: usize) -> bool {
        self.0.lock().is_ok_and(|mut steps| {
            steps.push((done, total));
            true
        })
    }
}

/// Reports no progress and never stops the verb.
#[derive(Clone, Copy, Debug, Default)]
pub struct Uncontrolled;

impl Control for Uncontrolled {
    fn goes_on(&self, _: usize, _: usize) -> bool {
        true
    }
}
