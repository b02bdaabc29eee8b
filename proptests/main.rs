//! The laws of the mechanics.
//!
//! Random collisions are made of small integers (`strategies.rs`), so every scalar gets the same one. In rationals a law is an equality; the f64 result then
//! has to lie in the interval, which encloses the rational one (`scalars.rs`). No tolerance stands where an equality is available.
//!
//! Each law is tried on 10⁴ collisions; `PROPTEST_CASES` sets another number. What takes long, as fits, records and some derivatives
//! do, is tried a fifth to a hundredth as often, and at least 32 times.

mod angles;
mod barrier;
mod check;
mod crash3;
mod crush;
mod derivatives;
mod energy;
mod errata;
#[cfg(feature = "symbols")]
mod exact_dual;
#[cfg(feature = "symbols")]
mod formulas;
mod laws;
mod limits;
mod noise;
mod paper;
#[cfg(feature = "symbols")]
mod reading;
#[cfg(feature = "reconstruct")]
mod reconstruct;
mod records;
mod refusals;
#[cfg(feature = "rest")]
mod rest;
mod scalars;
#[cfg(feature = "symbols")]
mod source;
mod strategies;
#[cfg(feature = "symbols")]
mod symbols;
mod symmetry;
