//! Panics: a defect of this program is reported in one line, with its own status; a library that gives up on a damaged file or on a column is an error of those.

use std::any::Any;
use std::cell::Cell;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};

thread_local! {
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Reports every panic in one line, instead of a long message.
pub fn install() {
    set_hook(Box::new(|defect| {
        if !IS_GUARDED.get() {
            // Where nobody listens, the status tells it.
            let _ = writeln!(io::stderr(), "error: a defect of planar-impact, please report it: {defect}");
        }
    }));
}

/// Reads with a library that panics on some damaged files, and returns what it says then as an error. What it read with must not be used again.
pub fn reading<T>(read: impl FnOnce() -> T) -> Result<T, String> {
    caught(read).map_err(|said| format!("it is damaged: {said}"))
}

/// Calls a library that panics on some data, and returns what it says then as an error. What it worked on must not be used again.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    IS_GUARDED.set(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    IS_GUARDED.set(false);
    done.map_err(|panic| said(&*panic).to_owned())
}

fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("its library gave up")
}
