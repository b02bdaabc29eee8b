//! From where a vehicle came to rest back to how it separated.

mod closed_form;
mod course;
mod evidence;
mod ground;
mod inverse;
mod problem;
mod slide;
mod tire;
mod variation;
mod vehicle;

pub use course::{Passing, REST_SPEED, Rest, TIME_LIMIT};
pub use evidence::{Method, Miss, MotionCovariance, NoSeparation, OtherSeparation, RestEvidence, Separation, SlideFit};
pub use ground::{Area, Ground, Region};
pub use problem::{NoRest, Problem, Problems};
pub use slide::{Drag, Slide};
pub use tire::{Restraint, Tires};
pub use vehicle::{Pose, SlidingVehicle, Wheel, Wheels};
