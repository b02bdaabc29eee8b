//! Lets Python handle signals during a long computation.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use planar_impact_app::{Cause, Control, Issues};
use pyo3::prelude::*;

use crate::error::Failure;

/// Time between two looks at the signals.
const PATIENCE: Duration = Duration::from_millis(50);

/// Looks at the signals from time to time, and stops the verb if a handler raises, as that of Ctrl+C does.
pub struct Signals {
    started: Instant,
    looked: AtomicU64,
    raised: Mutex<Option<PyErr>>,
}

impl Signals {
    /// Begins to look.
    pub fn new() -> Signals {
        Signals { started: Instant::now(), looked: AtomicU64::new(0), raised: Mutex::new(None) }
    }

    /// Looks at the signals, if the last look is long ago. Returns `false` if a handler raises.
    pub fn look(&self) -> bool {
        let now = self.started.elapsed().as_millis() as u64;
        if now < self.looked.load(Ordering::Relaxed) + PATIENCE.as_millis() as u64 {
            return true;
        }
        self.looked.store(now, Ordering::Relaxed);
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => true,
            Err(error) => {
                *self.raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = Some(error);
                false
            }
        }
    }

    /// Returns the exception of a failed verb: that of the handler, if one has stopped it.
    pub fn error(&self, failure: Failure) -> PyErr {
        let raised = self.raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).take();
        match raised {
            Some(error) if failure.issues.cause() == Cause::Interrupted => error,
            _ => failure.into(),
        }
    }

    /// Returns the answer of a verb, or the exception of the handler that has stopped it: some verbs then answer with what they have.
    pub fn finish<A>(&self, answer: Result<A, Failure>) -> PyResult<A> {
        let answer = answer.map_err(|failure| self.error(failure))?;
        let raised = self.raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).take();
        raised.map_or(Ok(answer), Err)
    }

    /// Returns the exception of a loop that a handler has stopped.
    pub fn stopped(&self) -> PyErr {
        self.error(Issues::interrupted().into())
    }
}

impl Control for Signals {
    fn goes_on(&self, _: usize, _: usize) -> bool {
        self.look()
    }
}
