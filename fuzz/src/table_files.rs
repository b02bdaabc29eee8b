//! What the command line reads tables with, as it is.

#[path = "../../cli/src/batch/format.rs"]
pub mod format;
#[path = "../../cli/src/batch/lengths.rs"]
mod lengths;
#[path = "../../cli/src/batch/quotes.rs"]
mod quotes;
#[path = "../../cli/src/batch/source.rs"]
pub mod source;
