//! The laws of the mechanics.
//!
//! Random collisions consist of small integers (`strategies.rs`), so every scalar gets the same ones. In rationals a
//! law is an equality; the f64 result must then lie in the interval, which encloses the rational one (`scalars.rs`).
//! No tolerance is used where an equality is available.
//!
//! Each property is tested on 10⁴ random cases; `PROPTEST_CASES` sets another number. Slow ones run a fraction of it,
//! from 1/5 (second derivatives, CRASH3) to 1/300 (slides with extreme inputs), and at least 32; formulas run 1/100, and
//! inverted slides 8 cases. All are the same in every run unless `PROPTEST_RNG_SEED` is set. The loops of `reconstruct/`
//! have their own counts, except that each row of its table runs half of `PROPTEST_CASES`.
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![allow(clippy::disallowed_methods)]

mod angles;
mod barrier;
mod batch;
mod bounds;
mod check;
mod crash3;
mod crush;
mod derivatives;
mod energy;
mod errata;
#[cfg(feature = "symbols")]
mod exact_dual;
mod extremes;
#[cfg(feature = "symbols")]
mod formulas;
mod interval_boxes;
mod interval_circular;
mod intervals;
mod laws;
mod limits;
mod momentum;
mod noise;
mod paper;
mod rational;
#[cfg(feature = "symbols")]
mod reading;
#[cfg(feature = "reconstruct")]
mod reconstruct;
mod records;
mod refusals;
#[cfg(feature = "post-impact")]
mod rest;
mod scalars;
mod simulation;
mod skid;
#[cfg(feature = "symbols")]
mod source;
mod strategies;
#[cfg(feature = "symbols")]
mod symbols;
mod symmetry;
