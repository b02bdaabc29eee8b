//! planar-impact for browsers: a case in, the answer of a verb out, as the JSON of the command line, as a page and as drawings.
//!
//! No mechanics, units or formats of numbers are here: `app` answers, `report` writes. Everything crosses the border as text.
//!
//! It is built twice: `frame` is what the page opens with, `verbs` what its workers fetch at the first answer that takes more.

#[cfg(feature = "verbs")]
mod check;
#[cfg(feature = "verbs")]
mod control;
#[cfg(feature = "frame")]
mod edit;
mod input;
#[cfg(feature = "frame")]
mod live;
mod reply;
#[cfg(feature = "verbs")]
mod report;
#[cfg(feature = "verbs")]
mod verbs;
