//! Common structure of all errors of this crate: [`Issue`], collections of them, and the issue of a single number.
//!
//! Nothing is repaired: signs, coefficients and the order of vehicles stay as given. All issues of an input are reported at once.

mod collection;
#[cfg(feature = "alloc")]
mod contract;
mod input;
mod place;
#[cfg(test)]
mod tests;

pub use collection::{IssueCollector, Issues};
#[cfg(feature = "alloc")]
pub use contract::Issue;
pub use input::{InputIssue, InputIssueKind};
pub use place::Place;
