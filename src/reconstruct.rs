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
//! # Properties
//!
//! | what holds | test in `proptests/reconstruct/` |
//! |---|---|
//! | forward and back is the truth, for each line of the table in `guide::reconstruction`, or what is open is named | `table.rs` |
//! | intervals of 95 % hold the truth in 95 % of the cases, and its ranks are uniform | `calibration.rs` |
//! | the influence is the difference that the evidence makes, and the covariance what its errors make of it | `answers.rs`, `the_influence_is_the_difference_that_the_evidence_makes`, `the_covariance_is_what_the_errors_of_the_evidence_make` |
//! | correlated evidence counts by the inverse of its covariance; what is exact is met and adds no uncertainty; a prior is evidence | `answers.rs` |
//! | contradiction, bounds in the way, several solutions, open directions, the impossible, too few steps: each is called so, with its numbers | `verdicts.rs` |
//! | the formulas go back to where they came from, and the search finds what they have | `closed_form.rs` |
//! | each diagnosis has its figure, and its limit divides as it says | `diagnosis.rs` |
//!
//! # How it is done
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
