//! Panics: a defect of this program is reported in one line, with its own status; a reader that gives up on a damaged file is an error of the file.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};

thread_local! {
    static IS_READING: Cell<bool> = const { Cell::new(false) };
}

/// Reports every panic in one line, instead of a long message.
pub fn install() {
    set_hook(Box::new(|defect| {
        if !IS_READING.get() {
            eprintln!("error: a defect of planar-impact, please report it: {defect}");
        }
    }));
}

/// Reads with a library that panics on some damaged files, and returns what it says then as an error. What it read with must not be used again.
pub fn reading<T>(read: impl FnOnce() -> T) -> Result<T, String> {
    IS_READING.set(true);
    let read = catch_unwind(AssertUnwindSafe(read));
    IS_READING.set(false);
    read.map_err(|panic| format!("it is damaged: {}", said(&*panic)))
}

fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("its reader gave up")
}
