//! The energy that residual crush stands for.
//!
//! The CRASH3 relation is linear: √(2 E_C/w) = d₀ + d₁ C (Eq 3). Over a profile of depths it integrates to E_C = d₀² K₁ + d₀ d₁ K₂ + d₁² K₃ (Eq 4).
//!
//! | file | what |
//! |---|---|
//! | `profile` | depths at stations across the crush, linear in between |
//! | `measuring_line` | depths read off a line outside the surface |
//! | `moments` | K₁, K₂, K₃ of a profile |
//! | `stiffness` | the linear law: as d₀, d₁, as A, B, G and as b₀, b₁ |
//! | `zones` | a stiffness that changes along the width |
//! | `law` | other laws: constant force, saturation, power |
//! | `quadrature` | the energy of a law that has no formula for a profile |
//! | `speed` | the speed that an energy stands for |

mod law;
mod measuring_line;
mod moments;
mod profile;
mod quadrature;
mod speed;
mod stiffness;
mod zones;

pub use law::{ConstantForce, CrushLaw, PowerLaw, Saturating};
pub use measuring_line::MeasuringLine;
pub use moments::ProfileMoments;
pub use profile::{Profile, ProfileError, Segment};
pub use quadrature::energy_by_quadrature;
pub use speed::{crush_intensity, equivalent_energy_speed, equivalent_energy_speed_squared, speed_of_energy};
pub use stiffness::{BarrierSpeedLine, CrushStiffness, ForceLine};
pub use zones::{StiffnessZones, ZoneError};
