//! CRASH3: ΔV from crush energy with a point mass, an equivalent mass and a tangential factor.
//!
//! This is the method that planar impact mechanics is compared with, as its users know it. It starts from the crush energy E of each vehicle and the
//! principal direction of force:
//!
//! | step | formula | file |
//! |---|---|---|
//! | energy, corrected for oblique force | E' = E (1 + tan² α), the factor at most 2; α from the perpendicular of the crushed surface to the force | `correction` |
//! | equivalent mass | γ = k²/(k² + h²), h the moment arm of the force about the center of mass | `damage` |
//! | common velocity at the contact | ΔV_i = √(2 (E'₁ + E'₂) μ_γ)/m_i with 1/μ_γ = 1/(γ₁ m₁) + 1/(γ₂ m₂) | `damage` |
//! | reconstruction | approach velocity = separation velocity − ΔV along the force | `approach` |
//!
//! A fixed barrier adds neither energy nor 1/(γ m). The force acts at the impact center of the vehicle. The limit of 2 on the factor is a convention: α
//! itself may be larger, and is measured from the perpendicular of the crushed surface, end or side. (CRASH3 User's Guide and Technical Manual, NHTSA, DOT HS
//! 805 732, 1981.)
//!
//! The method assumes common velocity, which is e = 0 and μ = μ₀. Its principal direction of force is therefore that of the
//! [common-velocity](crate::Collision::at_common_velocity) impulse, unless an investigator's estimate is given. [`Assumptions`] computes the effect of each
//! of its assumptions in a given collision.
//!
//! ```
//! use planar_impact::crash3::{Damaged, DamagedPair, Surface};
//! use planar_impact::{ForceDirection, ForwardLeft};
//!
//! // 100 kJ of crush, a force from straight ahead 0.5 m to the left of the center of mass, against a fixed barrier.
//! let car: Damaged = Damaged {
//!     mass: 1500.0,
//!     yaw_inertia: 1500.0 * 1.5 * 1.5,
//!     impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
//!     surface: Surface::Front,
//!     force_direction: ForceDirection { ahead: 1.0, right: 0.0 },
//!     crush_energy: 100e3,
//! };
//! let estimate = DamagedPair { one: Some(car), two: None }.solve()?;
//! let car = estimate.one.expect("a vehicle");
//! assert_eq!(car.correction, 1.0);
//! assert!((car.effective_mass_factor - 0.9).abs() < 1e-12); // 1.5² / (1.5² + 0.5²)
//! assert!((car.delta_v_magnitude - (2.0 * 100e3 * 0.9 / 1500.0_f64).sqrt()).abs() < 1e-12);
//! # Ok::<(), planar_impact::Refusals>(())
//! ```

mod approach;
mod assumptions;
mod correction;
mod damage;
mod refuse;
mod surface;

pub use approach::approach_velocity;
pub use assumptions::{Assumption, Assumptions, Consequence};
pub use correction::{energy_correction, force_correction, force_factor};
pub use damage::{Damaged, DamagedPair, Investigated, PairEstimate, VehicleEstimate};
pub use surface::Surface;
