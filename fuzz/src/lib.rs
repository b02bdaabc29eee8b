//! Fuzz targets: from bytes to an input of every form that a person or a program gives, through the same functions as every interface, to oracles that do not know
//! the code. An accepted answer is recomputed in exact rational arithmetic; forms of the same input give the same answer; what is written is what is read.
//!
//! `.ci/fuzz SECONDS` runs each target with libFuzzer; the tests run each on its corpus and on what becomes of it by chance, and plant errors that each oracle must
//! notice.

// Oracles share no function with what they judge, and inputs need not be the same on every platform.
#![allow(clippy::disallowed_methods)]

pub mod bytes;
pub mod cases;
pub mod edits;
pub mod formulas;
pub mod oracle;
pub mod quantities;
pub mod recordings;
pub mod records;
pub mod tables;

#[path = "../../cli/src/defect.rs"]
mod defect;
#[path = "../../cli/src/files.rs"]
#[allow(dead_code)]
mod files;
#[allow(dead_code)]
mod table_files;

/// A target: a function of bytes that panics if a law does not hold.
pub type Target = fn(&[u8]);

/// Every target by name.
pub const TARGETS: [(&str, Target); 10] = [
    ("case", cases::structured),
    ("case_text", cases::text),
    ("edit", edits::run),
    ("formula", formulas::run),
    ("quantity", quantities::run),
    ("record", records::structured),
    ("record_text", records::text),
    ("recording", recordings::run),
    ("table", tables::structured),
    ("table_bytes", tables::bytes),
];

/// Returns the target with a name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.iter().find(|(known, _)| *known == name).map(|(_, target)| *target)
}
