//! The types of everyday use, for a glob import beside those of other crates.
//!
//! Traits are imported without their names. None of their methods has the name of a method of `num_traits`, `num_dual`, `nalgebra` or `approx`, so that glob
//! imports of those crates stay as they are.
//!
//! ```
//! use planar_impact::prelude::*;
//! let car: Vehicle = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.5).with_speed(15.0);
//! let impact = Collision::new(car, Party::Barrier).with_restitution(0.1).solve()?;
//! assert!((impact.separation.n - 1.5).abs() < 1e-12);
//! # Ok::<(), Refusals>(())
//! ```

pub use crate::collision::Collision;
pub use crate::frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
pub use crate::impact::Impact;
pub use crate::input::{Input, Side};
#[cfg(feature = "alloc")]
pub use crate::issue::Issue as _;
pub use crate::law::{ImpulseRatio, Law};
pub use crate::moment::Moment;
pub use crate::output::{Output, Outputs};
pub use crate::refusal::{Refusal, Refusals};
pub use crate::scalar::{Field as _, Ordered as _, Real as _};
pub use crate::vehicle::{Motion, Party, Vehicle};
