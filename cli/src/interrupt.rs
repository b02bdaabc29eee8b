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

/// Calls a function at each Ctrl-C, at each SIGTERM, which a supervisor sends, and at a hangup, unless it is ignored. A file that reaches the limit of sizes does not end the
/// program: writing it is an error.
#[cfg(unix)]
fn handle(interrupt: fn()) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    let hangup = (!ignores(SIGHUP)).then_some(SIGHUP);
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM, SIGXFSZ].into_iter().chain(hangup))?;
    std::thread::Builder::new().spawn(move || signals.forever().filter(|signal| *signal != SIGXFSZ).for_each(|_| interrupt())).map(drop)
}

/// Returns `true` if a signal is ignored, as `nohup` has a hangup, or if the system does not tell: a handler would undo that.
#[cfg(unix)]
fn ignores(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask & (1 << (signal - 1)) != 0)
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
