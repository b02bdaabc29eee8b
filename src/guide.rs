//! Guides to the uses of the library besides the forward problem.

#[doc = include_str!("guide/sensitivities.md")]
pub mod sensitivities {}

#[cfg(feature = "batch")]
#[doc = include_str!("guide/batches.md")]
pub mod batches {}

#[cfg(feature = "uncertainty")]
#[doc = include_str!("guide/uncertainty.md")]
pub mod uncertainty {}

#[doc = include_str!("guide/crush.md")]
pub mod crush {}

#[cfg(feature = "reconstruct")]
#[doc = include_str!("guide/reconstruction.md")]
pub mod reconstruction {}

#[cfg(feature = "post-impact")]
#[doc = include_str!("guide/post_impact.md")]
pub mod post_impact {}

#[doc = include_str!("guide/proofs.md")]
pub mod proofs {}

#[doc = include_str!("guide/checking.md")]
pub mod checking {}

#[doc = include_str!("guide/formulas.md")]
pub mod formulas {}

#[doc = concat!(include_str!("guide/scalars.md"), "```\n", include_str!("../examples/own_scalar.rs"), "```\n")]
pub mod scalars {}
