//! The application layer of `planar-impact`: case files, questions and typed answers.
//!
//! Every interface (command line, report, Python, browser) uses the same pipeline: source text → [`Case`] → a verb →
//! an answer. An answer is plain data in SI and radians; it contains every fact that any interface shows. Nothing
//! here reads files, prints, reads the clock or starts a thread.
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod answer;
pub mod batch;
pub mod case;
pub mod check;
pub mod compare;
pub mod control;
pub mod crash3;
pub mod crush;
pub mod crush_plane_bracket;
pub mod decode;
pub mod derivative;
pub mod document;
mod doubtful;
pub mod formula;
pub mod gradient;
pub mod issue;
pub mod json;
pub mod message;
pub mod named;
pub mod names;
pub mod notice;
pub mod plain_text;
pub mod prove;
pub mod quantity;
pub mod quotes;
pub mod reconstruct;
pub mod record;
pub mod report;
pub mod scene;
pub mod schema;
pub mod slide;
pub mod solve;
pub mod source;
pub mod statement;
pub mod stiffness;
pub mod sweep;
pub mod template;
pub mod uncertainty;
pub mod units;
mod unusual;
pub mod validate;
pub mod wording;

pub use answer::Answer;
pub use case::Case;
pub use control::{Control, Uncontrolled};
pub use issue::{Cause, Issue, Issues};
pub use message::Message;
pub use notice::{Notice, Notices, Severity};
pub use source::{Open, Source};
pub use units::{Measure, Units};
