//! Crush energy and equivalent speed from residual crush.
//!
//! The CRASH3 relation is linear: √(2 E_C/w) = d₀ + d₁ C (Eq 3). Over a profile of depths it integrates to E_C = d₀² K₁ + d₀ d₁ K₂ + d₁² K₃ (Eq 4).
//!
//! | file | contents |
//! |---|---|
//! | `profile` | depths at stations across the crush, linear in between |
//! | `measuring_line` | depths measured from a line outside the surface |
//! | `moments` | K₁, K₂, K₃ of a profile |
//! | `stiffness` | the linear law: as d₀, d₁, as A, B, G and as b₀, b₁ |
//! | `zones` | a stiffness that changes along the width |
//! | `force` | the force at the end of the crush |
//! | `law` | force and energy of a law of crush |
//! | `quadrature` | energy of a law without a formula for a profile |
//! | `nonlinear` | other laws: constant force, saturation, power |
//! | `speed` | equivalent speed of an energy |

mod force;
mod law;
mod measuring_line;
mod moments;
mod nonlinear;
mod profile;
mod quadrature;
mod speed;
mod stiffness;
mod zones;

pub use force::{MOST_FORCE_IMBALANCE, force_imbalance};
pub use law::CrushLaw;
pub use measuring_line::MeasuringLine;
pub use moments::ProfileMoments;
pub use nonlinear::{ConstantForce, PowerLaw, Saturating};
pub use profile::{Profile, ProfileError, Segment};
pub use quadrature::energy_by_quadrature;
pub use speed::{crush_intensity, equivalent_energy_speed, equivalent_energy_speed_squared, speed_of_energy};
pub use stiffness::{BarrierSpeedLine, CrushStiffness, ForceLine};
pub use zones::{StiffnessZones, ZoneError};
