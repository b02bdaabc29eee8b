//! planar-impact for browsers: a case in, the answer of a verb out, as the JSON of the command line, as a page and as drawings.
//!
//! No mechanics, units or formats of numbers are here: `app` answers, `report` writes. Everything crosses the border as text.

mod check;
mod control;
mod edit;
mod input;
mod live;
mod reply;
mod report;
mod verbs;
