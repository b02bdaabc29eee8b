#![doc = include_str!("../README.md")]
//!
//! # Pages
//!
//! [Sensitivities](guide::sensitivities), [crush and CRASH3](guide::crush), reconstruction (`guide::reconstruction`, feature `reconstruct`), from rest to separation (`guide::rest`, feature `rest`), [proofs](guide::proofs), [checking another simulator](guide::checking), [formulas](guide::formulas)
//!
//! # The argument, module by module
//!
//! Each module uses those before it and none after it.
//!
//! | module | what goes in | what comes out |
//! |---|---|---|
//! | [`scalar`] | | what a number must be able to do |
//! | [`frame`] | an angle, or the tangent of half of it | components in ground, contact and vehicle axes, which cannot be mixed |
//! | [`vehicle`] | mass, inertia, heading, impact center, motion | one of the two parties |
//! | [`body`] | a party, the crush plane | what the contact sees of it: inverse mass and inertia, arm, motion |
//! | [`compliance`] | two bodies | K: the change of relative velocity by an impulse |
//! | [`contact`] | two bodies | approach velocity, and separation velocity and loss for any impulse |
//! | [`law`] | approach, restitution, impulse ratio | the impulse |
//! | [`moment`] | approach, a moment or a fraction of the critical one | the moment impulse |
//! | [`energy`] | impulse, approach, separation | the work of each component |
//! | [`impact`] | | what an impact does: motions, impulse, ΔV and its direction, works |
//! | [`collision`] | two parties and how they collide | the impact, whether possible or not |
//! | [`admissible`] | a collision | how far e and μ may go without a gain of energy |
//! | [`input`], [`output`] | a name | what goes into a collision and what comes out, each by one name |
//! | `formula` | a collision, its numbers left aside | the formula of every output, and its derivatives (feature `symbols`) |
//! | [`refusal`] | | why a collision can be refused |
//! | [`solve`] | a collision | the impact, or every reason why there is none |
//! | [`sensitivity`] | a collision | every output with its derivatives by every input |
//! | [`guideline`] | the directions of two undeformed surfaces | the nominal crush plane and its bracket |
//! | [`check`] | a collision as another program reports it | which law does not hold, and by how much |
//! | [`crush`] | a crush profile and stiffness, or another law | crush energy, equivalent energy speed |
//! | [`crash3`] | crush energies and the direction of force | CRASH3's ΔV, and what its assumptions cost |
//! | [`barrier`] | instrumented barrier tests: speeds and crush, force records, films | stiffness with its covariance, impulses, restitution |
//! | `reconstruct` | a collision with unknowns, and evidence | every solution with its uncertainty, what it hangs on, what to look at first (feature `reconstruct`) |
//! | `rest` | where a vehicle came to rest | how it separated (feature `rest`) |
//! | [`paper`] | two bodies | every numbered equation in the paper's letters, **with what the print gets wrong** |
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

pub mod admissible;
pub mod barrier;
pub mod body;
pub mod check;
pub mod collision;
pub mod compliance;
pub mod contact;
pub mod crash3;
pub mod crush;
pub mod energy;
#[cfg(feature = "symbols")]
pub mod formula;
pub mod frame;
#[cfg(feature = "dual")]
pub mod guide;
pub mod guideline;
pub mod impact;
pub mod input;
pub mod law;
#[cfg(feature = "reconstruct")]
pub(crate) mod least_squares;
pub mod moment;
pub mod output;
pub mod paper;
#[cfg(feature = "reconstruct")]
pub mod reconstruct;
pub mod refusal;
#[cfg(feature = "rest")]
pub mod rest;
pub mod scalar;
#[cfg(feature = "dual")]
pub mod sensitivity;
pub mod solve;
pub mod vehicle;

pub use admissible::Admissible;
pub use body::Body;
pub use collision::Collision;
pub use compliance::Compliance;
pub use contact::Contact;
pub use energy::{KineticEnergy, Work};
pub use frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
pub use guideline::{CrushPlaneBracket, PerpendicularSurfaces};
pub use impact::{ForceOrigin, Impact, Response};
pub use input::{Input, Side};
pub use law::{ImpulseRatio, Law};
pub use moment::{Moment, MomentCompliance};
pub use output::{Output, Outputs, VehicleOutputs};
pub use refusal::{Refusal, Refusals, Tension};
pub use scalar::{Field, Ordered, Real};
#[cfg(feature = "dual")]
pub use sensitivity::{Curved, Gradient, Hessian, Sensitive};
pub use vehicle::{Motion, Party, Vehicle};
