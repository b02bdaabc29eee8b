//! Handles interrupts, and requests to terminate: either ends the program, unless a verb checks for it or output is being written.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::exit::Status;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static NOTED: AtomicBool = AtomicBool::new(false);

/// Installs the handler: from now on an interrupt ends the program with its own status.
pub fn install() {
    static ONCE: Once = Once::new();
    // Without a handler an interrupt ends the program at once, and may leave the temporary file of an output.
    ONCE.call_once(|| drop(handle(interrupt)));
}

fn interrupt() {
    INTERRUPTED.store(true, Ordering::SeqCst);
    if !NOTED.load(Ordering::SeqCst) {
        std::process::exit(Status::Interrupted.code().into());
    }
}

/// Calls a function at each Ctrl-C and at each SIGTERM, which a supervisor sends; a hangup stays what it is, so that `nohup` keeps its meaning.
#[cfg(unix)]
fn handle(interrupt: fn()) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new().spawn(move || signals.forever().for_each(|_| interrupt())).map(drop)
}

#[cfg(not(unix))]
fn handle(interrupt: fn()) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(interrupt)
}

/// Makes interrupts only set a flag from now on, so that the output is not cut off.
pub fn note() {
    NOTED.store(true, Ordering::SeqCst);
}

/// Returns `true` if the user has requested a stop.
pub fn is_interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}
