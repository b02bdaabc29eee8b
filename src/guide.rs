//! Pages to read, one for each thing that the library is for beyond solving.

#[doc = include_str!("guide/sensitivities.md")]
pub mod sensitivities {}

#[doc = include_str!("guide/crush.md")]
pub mod crush {}

#[cfg(feature = "reconstruct")]
#[doc = include_str!("guide/reconstruction.md")]
pub mod reconstruction {}

#[cfg(feature = "rest")]
#[doc = include_str!("guide/rest.md")]
pub mod rest {}

#[doc = include_str!("guide/proofs.md")]
pub mod proofs {}

#[doc = include_str!("guide/checking.md")]
pub mod checking {}

#[doc = include_str!("guide/formulas.md")]
pub mod formulas {}
