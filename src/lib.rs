#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

pub mod admissible;
pub mod body;
pub mod collision;
pub mod compliance;
pub mod contact;
pub mod crush;
pub mod energy;
pub mod frame;
pub mod law;
pub mod moment;
pub mod paper;
pub mod refusal;
pub mod scalar;
pub mod vehicle;

pub use admissible::Admissible;
pub use body::Body;
pub use collision::{Collision, Impact, Response};
pub use compliance::Compliance;
pub use contact::Contact;
pub use energy::{KineticEnergy, Work};
pub use frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
pub use law::{ImpulseRatio, Law};
pub use moment::{Moment, MomentCompliance};
pub use refusal::{Refusal, Refusals, Tension};
pub use scalar::{Field, Ordered, Real};
pub use vehicle::{Motion, Party, Vehicle};
