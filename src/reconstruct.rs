//! The way back: from what is left after the crash to how it happened, and how sure that is.
//!
//! A [`Reconstruction`] is a collision with some of its numbers unknown, and the evidence there is. Its [`Reconstruction::solve`] finds every set of unknowns that the
//! evidence is likeliest with: the least sum of the squares of the evidence's residuals, each in standard deviations, within the bounds.
//!
//! | what | where |
//! |---|---|
//! | what can be unknown, and what can be evidence | [`Variable`], [`Measurable`] |
//! | the question | [`Reconstruction`] of [`Unknown`]s and [`Evidence`] |
//! | the answer | [`Answer`]: a [`Verdict`] and every [`Solution`] |
//! | where it is a formula | [`closed_form`] |
//! | what to look at first | [`diagnosis`] |
//! | no answer | [`Unsolved`], with every [`Problem`] of the question |
//!
//! The search runs on f64 with derivatives by dual numbers through the one kernel; the solution is then differentiated as what it is, a point where the
//! slope is zero, and its uncertainty and its answer to each piece of evidence follow from that.

pub mod closed_form;
mod determined;
pub mod diagnosis;
mod given;
mod measurable;
mod problem;
mod residuals;
mod scene;
mod search;
mod solution;
mod variable;
mod verdict;
mod weight;

pub use determined::Direction;
pub use given::{Correlation, Evidence, Reconstruction, Search, Uncertainty, Unknown};
pub use measurable::Measurable;
pub use problem::{Problem, Problems, Stop, Unsolved};
pub use solution::{Estimate, Fitted, Solution, Symmetric};
pub use variable::Variable;
pub use verdict::{Answer, Verdict};

pub use crate::least_squares::Bound;
