//! Reconstruction: unknown inputs of a collision from evidence, with their uncertainty.
//!
//! A [`ReconstructionProblem`] is a collision with some of its numbers unknown, and the available evidence. [`ReconstructionProblem::solve`] finds every set
//! of unknowns with maximum likelihood: within the bounds, the least sum of the squares of the evidence's residuals, each in standard deviations.
//!
//! | topic | item |
//! |---|---|
//! | quantities that can be unknown, and quantities that can be evidence | [`Variable`], [`Measurand`] |
//! | the problem | [`ReconstructionProblem`] of [`Unknown`]s and [`Evidence`] |
//! | the answer | [`Answer`]: a [`Verdict`] and every [`Solution`] |
//! | answers in closed form | [`closed_form`] |
//! | ranges that hold everything that meets exact evidence | [`GuaranteedRange`] |
//! | intervals by profile likelihood | [`Interval`], and the [`Limit`] that makes an end |
//! | the posterior, as draws | [`Posterior`], and the [`Marginal`] of a quantity |
//! | diagnostics of an answer | [`diagnosis`] |
//! | no answer | [`SolveError`], with every [`ReconstructionIssue`] of the problem |
//!
//! # Properties
//!
//! | property | test in `proptests/reconstruct/` |
//! |---|---|
//! | solving the forward problem and reconstructing gives the true values, for each line of the table in `guide::reconstruction`, or the undetermined quantities are named | `table.rs` |
//! | intervals of 95 % contain the true value in 95 % of the cases, and its ranks are uniform | `calibration.rs` |
//! | intervals by profile likelihood contain the true value as often as they say, on bounds too, and end where the best fit of the rest leaves the limit; no answer fits worse than the truth | `coverage.rs` |
//! | whatever meets exact evidence is within the guaranteed ranges, whose ends are those of closed forms and of dense searches | `guaranteed.rs` |
//! | intervals of linear evidence are those of the normal distribution, and what makes an end is named: a bound, the physics, a whole turn | `intervals.rs` |
//! | draws are as frequent as integrals over a grid say, modes and bounds included; priors come back where evidence says nothing; ranks of the truth are uniform | `posterior.rs` |
//! | the influence is the change that a change of the evidence causes, and the covariance is that caused by its errors | `answers.rs`, `the_influence_is_the_difference_that_the_evidence_makes`, `the_covariance_is_what_the_errors_of_the_evidence_make` |
//! | at a fold the covariance is that of the slopes | `answers.rs`, `at_a_fold_the_slopes_alone_make_the_covariance` |
//! | correlated evidence and correlated priors are weighted by the inverse of their covariance; exact evidence is met and adds no uncertainty; a prior is evidence | `answers.rs` |
//! | inconsistent evidence, active bounds, several solutions, undetermined directions, impossible collisions, too few steps: each is reported as such, with its numbers | `verdicts.rs` |
//! | the closed forms invert the forward problem, and the search finds their solutions | `closed_form.rs` |
//! | each diagnosis has its figure, and its limit separates as stated | `diagnosis.rs` |
//!
//! # Method
//!
//! The search runs in f64 with derivatives from dual numbers through the one kernel. The solution, a point of zero gradient, is then differentiated
//! implicitly, which gives its uncertainty and its dependence on each piece of evidence. Intervals do without that: they follow the best fit outwards.
//! So does the posterior, whose walkers need the density alone.

mod as_measured;
mod branches;
mod check;
pub mod closed_form;
mod convergence;
mod crush_depth;
mod crush_share;
mod density;
mod determined;
pub mod diagnosis;
mod ensemble;
mod fold;
mod given;
mod growing;
mod guaranteed;
mod interval;
mod issue;
mod limit;
mod marginal;
mod measurand;
mod outwards;
mod piece;
mod placed;
mod posterior;
mod profile;
mod proposal;
mod residuals;
mod scene;
mod search;
mod solution;
mod solve_error;
mod standstill;
mod variable;
mod verdict;
mod way_to_rest;
mod weight;
mod within_limits;

pub use crate::least_squares::by_chi_square;
pub use crush_share::crush_share;
pub use determined::Direction;
pub use given::{Correlation, Dependence, Evidence, GrowingError, PriorCorrelation, ReconstructionProblem, Search, Uncertainty, Unknown};
pub use guaranteed::{GuaranteedRange, GuaranteedSearch, NoRange};
pub use interval::{Interval, Method};
pub use issue::{ReconstructionIssue, ReconstructionIssues};
pub use limit::Limit;
pub use marginal::Marginal;
pub use measurand::Measurand;
pub use posterior::{NoPosterior, Posterior, Sampling};
pub use solution::{Estimate, Fitted, Solution, Symmetric};
pub use solve_error::{SolveError, Stop};
pub use variable::{Axis, Variable};
pub use verdict::{Answer, Verdict};

pub use crate::least_squares::Bound;
