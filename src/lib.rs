#![doc = include_str!("../README.md")]
//!
//! # Guides
//!
//! [Sensitivities](guide::sensitivities), [crush and CRASH3](guide::crush), reconstruction (`guide::reconstruction`, feature `reconstruct`), separation from
//! rest positions (`guide::post_impact`, feature `post-impact`), [proofs](guide::proofs), [checking another simulator](guide::checking),
//! [formulas](guide::formulas), [a scalar of your own](guide::scalars)
//!
//! # Modules
//!
//! Each module uses only those before it.
//!
//! | module | input | result |
//! |---|---|---|
//! | [`scalar`] | | the operations that a number must support |
//! | [`frame`] | an angle, or the tangent of half of it | components in ground, contact and vehicle axes, which cannot be mixed |
//! | [`vehicle`] | mass, inertia, heading, impact center, motion | one of the two parties |
//! | [`body`] | a party, the crush plane | its properties in contact axes: inverse mass and inertia, arm, motion |
//! | [`compliance`] | two bodies | K: the change of relative velocity by an impulse |
//! | [`contact`] | two bodies | approach velocity, and separation velocity and loss for any impulse |
//! | [`law`] | approach, restitution, impulse ratio | the impulse |
//! | [`moment`] | approach, a moment or a fraction of the critical one | the moment impulse |
//! | [`energy`] | impulse, approach, separation | the work of each component |
//! | [`impact`] | | the result of an impact: motions, impulse, ΔV and its direction, works |
//! | [`collision`] | two parties and the parameters of the impact | the impact, whether possible or not |
//! | [`admissible`] | a collision | limits on e and μ without a gain of energy |
//! | [`input`], [`output`] | a name | inputs and outputs of a collision, each identified by name |
//! | `formula` | a collision, without its numbers | the formula of every output, and its derivatives (feature `symbols`) |
//! | [`measure`], [`message`] | a number | its physical quantity, and messages that preserve it |
//! | [`issue`] | a number, a list | its issue; the common structure of all errors |
//! | [`refusal`] | | the reasons for refusing a collision |
//! | [`solve`] | a collision | the impact, or every reason why there is none |
//! | [`sensitivity`] | a collision | every output with its derivatives by every input |
//! | [`guideline`] | the directions of two undeformed surfaces | the nominal crush plane and its bracket |
//! | [`check`] | a collision as another program reports it | the laws that it violates, and by how much |
//! | [`crush`] | a crush profile and stiffness, or another law | crush energy, equivalent energy speed |
//! | [`crash3`] | crush energies and the direction of force | CRASH3's ΔV, and the effect of its assumptions |
//! | [`barrier`] | instrumented barrier tests: speeds and crush, force records, films | stiffness with its covariance, impulses, restitution |
//! | [`distribution`] | limits, mean, mode or median of an uncertain number | its mean, standard deviation, density and support |
//! | `reconstruct` | a collision with unknowns, and evidence | every solution with its uncertainty, the influence of the evidence, and diagnostics (feature `reconstruct`) |
//! | `post_impact` | rest positions of a vehicle | its separation velocity (feature `post-impact`) |
//! | [`paper`] | two bodies | every numbered equation in the paper's notation, **with the errors of the printed text** |
//!
//! Without the feature `alloc` the crate needs no allocator, and has the modules that a controller needs: collisions, impacts, refusals by their codes and
//! values, and derivatives. The others, messages among them, are `barrier`, `check`, `crush`, `formula`, `guideline` and `message`.
#![cfg_attr(not(feature = "std"), no_std)]
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![cfg_attr(test, allow(clippy::disallowed_methods))]
// Without an allocator the refusals are where the result is.
#![cfg_attr(not(feature = "alloc"), allow(clippy::result_large_err))]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod admissible;
#[cfg(feature = "alloc")]
pub mod barrier;
#[cfg(feature = "batch")]
pub mod batch;
pub mod body;
mod catalogue;
#[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
mod cells;
#[cfg(feature = "alloc")]
pub mod check;
pub mod collision;
pub mod compliance;
pub mod contact;
pub mod crash3;
#[cfg(feature = "alloc")]
pub mod crush;
mod display;
pub mod distribution;
pub mod energy;
#[cfg(feature = "symbols")]
pub mod formula;
pub mod frame;
#[cfg(feature = "dual")]
pub mod guide;
#[cfg(feature = "alloc")]
pub mod guideline;
pub mod impact;
pub mod input;
pub mod issue;
pub mod law;
#[cfg(feature = "reconstruct")]
pub(crate) mod least_squares;
pub mod measure;
#[cfg(feature = "alloc")]
pub mod message;
pub mod moment;
pub mod momentum;
#[cfg(feature = "approx")]
pub mod nearness;
pub mod output;
pub mod paper;
#[cfg(feature = "post-impact")]
pub mod post_impact;
pub mod prelude;
#[cfg(feature = "uom")]
mod quantities;
#[cfg(feature = "reconstruct")]
pub mod reconstruct;
pub mod refusal;
pub mod scalar;
pub mod sensitivity;
#[cfg(feature = "simulation")]
pub mod simulation;
#[cfg(feature = "alloc")]
pub mod skid;
pub mod solve;
#[cfg(feature = "uncertainty")]
pub mod uncertainty;
pub mod vehicle;

#[cfg(feature = "nalgebra")]
pub use nalgebra;
#[cfg(feature = "dual")]
pub use num_dual;
#[cfg(feature = "uom")]
pub use uom;

pub use admissible::Admissible;
pub use body::Body;
#[cfg(feature = "alloc")]
pub use catalogue::UnknownName;
pub use collision::Collision;
pub use compliance::Compliance;
pub use contact::Contact;
pub use distribution::Distribution;
pub use energy::{KineticEnergy, Work};
pub use frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
#[cfg(feature = "alloc")]
pub use guideline::{CrushPlaneBracket, SurfaceIssue};
pub use impact::{ForceDirection, Impact, Response};
pub use input::{Input, NoSuchInput, Side};
#[cfg(feature = "alloc")]
pub use issue::Issue;
pub use issue::{InputIssue, InputIssueKind, Issues};
pub use law::{ImpulseRatio, Law};
pub use measure::{Measure, STANDARD_GRAVITY};
#[cfg(feature = "alloc")]
pub use message::{Message, Part};
pub use moment::{Moment, MomentCompliance};
pub use output::{Output, Outputs, VehicleOutputs};
pub use refusal::{Refusal, Refusals, Tension};
pub use scalar::{Field, Ordered, Real};
#[cfg(feature = "alloc")]
pub use sensitivity::{Covariance, NotACovariance};
pub use sensitivity::{Curved, Gradient, Hessian, Sensitive};
pub use vehicle::{Motion, Party, Vehicle};
