//! Lets Python handle signals and show progress during a long computation.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use planar_impact_app::{Cause, Control, Issues};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::Failure;

/// Time between two looks at the signals.
const PATIENCE: Duration = Duration::from_millis(50);

/// Looks at the signals from time to time, reports progress, and stops the verb if a handler raises, as that of Ctrl+C does.
pub struct Signals {
    started: Instant,
    looked: AtomicU64,
    raised: Mutex<Option<PyErr>>,
    /// Whether a handler has raised: a verb that goes on with its next stage then ends that at once, too.
    is_stopped: AtomicBool,
    progress: Option<Py<PyAny>>,
    /// The number of steps in the last report.
    total: AtomicUsize,
}

impl Signals {
    /// Begins to look. `progress` is called with the number of steps that are done and of all steps.
    pub fn new(progress: Option<Py<PyAny>>) -> Signals {
        let (raised, total) = (Mutex::new(None), AtomicUsize::new(0));
        Signals { started: Instant::now(), looked: AtomicU64::new(0), raised, is_stopped: AtomicBool::new(false), progress, total }
    }

    /// Looks at the signals, if the last look is long ago. Returns `false` if a handler raises, or has raised.
    pub fn look(&self, done: usize, total: usize) -> bool {
        if self.is_stopped.load(Ordering::Relaxed) {
            return false;
        }
        self.total.store(total, Ordering::Relaxed);
        let now = self.started.elapsed().as_millis() as u64;
        let looked = self.looked.load(Ordering::Relaxed);
        let is_due = now >= looked + PATIENCE.as_millis() as u64;
        // Of several threads, one looks.
        if !is_due || self.looked.compare_exchange(looked, now, Ordering::Relaxed, Ordering::Relaxed).is_err() {
            return true;
        }
        self.attend(done, total)
    }

    /// Reports that all steps are done, and returns the exception of a handler.
    pub fn done(&self) -> PyResult<()> {
        let total = self.total.load(Ordering::Relaxed);
        if self.progress.is_some() && total > 0 {
            self.attend(total, total);
        }
        self.raised().map_or(Ok(()), Err)
    }

    fn raised(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).take()
    }

    fn attend(&self, done: usize, total: usize) -> bool {
        let attended = Python::attach(|py| {
            py.check_signals()?;
            self.progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, (done.min(total), total)).map(drop))
        });
        match attended {
            Ok(()) => true,
            Err(error) => {
                *self.raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = Some(error);
                self.is_stopped.store(true, Ordering::Relaxed);
                false
            }
        }
    }

    /// Returns the exception of a failed verb: that of the handler, if one has stopped it.
    pub fn error(&self, failure: Failure) -> PyErr {
        match self.raised() {
            Some(error) if failure.issues.cause() == Cause::Interrupted => error,
            _ => failure.into(),
        }
    }

    /// Returns the answer of a verb, or the exception of the handler that has stopped it: some verbs then answer with what they have.
    pub fn finish<A>(&self, answer: Result<A, Failure>) -> PyResult<A> {
        let answer = answer.map_err(|failure| self.error(failure))?;
        if let Some(error) = self.raised() {
            return Err(error);
        }
        self.done()?;
        Ok(answer)
    }

    /// Returns what a handler has raised as text, for a caller that takes no exception; Ctrl+C is raised again once Python runs on.
    pub fn handed_on(&self) -> String {
        let Some(error) = self.raised() else { return "stopped".to_owned() };
        Python::attach(|py| {
            let said = format!("stopped: {error}");
            if error.is_instance_of::<PyKeyboardInterrupt>(py) {
                interrupt_again(py);
            }
            said
        })
    }

    /// Returns the exception of a loop that a handler has stopped.
    pub fn stopped(&self) -> PyErr {
        self.error(Issues::interrupted().into())
    }
}

/// Raises Ctrl+C once Python runs on, where an error of Arrow has its text alone. Nothing of Python may run after it here: that would raise it too early.
pub fn interrupt_again(py: Python<'_>) {
    let _ = py.import("_thread").and_then(|thread| thread.call_method0("interrupt_main"));
}

impl Control for Signals {
    fn goes_on(&self, done: usize, total: usize) -> bool {
        self.look(done, total)
    }
}
