//! Uncertainty: what an answer is worth.

mod bounds;
mod mapping;

pub use bounds::{Bounds, NoBounds, RefusedPart, Search, bounds};
pub use mapping::{Direct, Mapping};
