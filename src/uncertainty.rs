//! Uncertainty: what an answer is worth.

mod mapping;

pub use mapping::{Direct, Mapping};
