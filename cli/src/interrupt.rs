//! Handles interrupts: an interrupt ends the program, unless a verb checks for it or output is being written.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::exit::Status;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static NOTED: AtomicBool = AtomicBool::new(false);

/// Installs the handler: from now on an interrupt ends the program with its own status.
pub fn install() {
    static ONCE: Once = Once::new();
    let handler = || {
        INTERRUPTED.store(true, Ordering::SeqCst);
        if !NOTED.load(Ordering::SeqCst) {
            std::process::exit(Status::Interrupted.code().into());
        }
    };
    // Without a handler an interrupt ends the program at once, which also leaves no partial results.
    ONCE.call_once(|| drop(ctrlc::set_handler(handler)));
}

/// Makes interrupts only set a flag from now on, so that the output is not cut off.
pub fn note() {
    NOTED.store(true, Ordering::SeqCst);
}

/// Returns `true` if the user has requested a stop.
pub fn is_interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}
