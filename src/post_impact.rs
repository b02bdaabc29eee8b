//! Separation velocities from rest positions.
//!
//! # Steps, file by file
//!
//! | known | result | item |
//! |---|---|---|
//! | a wheel, its load, friction and slip | the force of the road on the wheel | [`Tires::force`] |
//! | a point of the ground | its friction and grade | [`Ground::surface_at`] |
//! | a pose on a grade | whether the tires hold the vehicle there | [`Slide::stands`] |
//! | a vehicle, its pose and motion | force, moment and dissipation | [`Slide::drag`] |
//! | its pose and motion at separation | its rest position and trajectory | [`Slide::to_rest`] |
//! | its poses at separation and at rest | its motion at separation, from the work of the tires along a straight path | [`Slide::closed_form`] |
//! | the same with standard deviations | its motion at separation with its covariance, by that formula or by the slide that ends at the rest position | [`Slide::separation`] |
//! | the same about another motion | what the poses say of the separation there, to first order | [`Slide::separation_about`] |
//!
//! The equations of motion are written once, generic over the scalar. The integration is in f64; the derivatives of the rest position by the motion at
//! separation and by the friction are integrated with it, from the same equations on dual numbers.
//!
//! # Properties
//!
//! | property | test in `proptests/rest.rs` |
//! |---|---|
//! | locked wheels without rotation stop in v²/(2μg), except for a known regularization term that vanishes with ε | `locked_wheels_stop_in_half_the_square_over_friction` |
//! | free wheels straight ahead stop in v²/(2fg) | `free_wheels_roll_to_a_stop` |
//! | two frictions along the path contribute their shares, v² = 2g(μ₁d₁ + μ₂d₂) | `two_frictions_take_their_shares` |
//! | locked wheels without rotation stop on a grade in v²/(2g(μ ± G)) | `locked_wheels_stop_on_a_grade` |
//! | the tires dissipate the kinetic energy and the height lost, and the vehicle stands where they hold it | `on_a_grade_the_tires_dissipate_the_height_too` |
//! | the tires dissipate the kinetic energy | `the_tires_dissipate_what_there_was` |
//! | the rest position rotates, translates and mirrors with the scene | `the_end_turns_with_the_scene` |
//! | mass has no effect, and lengths scale with the square of speeds | `the_end_scales` |
//! | half the step has a sixteenth of the error, as for a fourth-order method | `the_error_of_a_step_is_of_its_order` |
//! | forward and inverse give the same separation | `forward_and_back` |
//! | the closed form is exact for locked wheels without rotation | `the_closed_form_is_exact_for_locked_wheels_without_rotation` |
//! | no input makes it hang or panic | `nothing_hangs_and_nothing_panics` |
//!
//! Derivatives and covariance are compared with difference quotients in the unit tests.

mod check;
mod closed_form;
mod evidence;
mod ground;
mod inverse;
mod issue;
mod path_point;
mod slide;
mod standing;
mod tire;
mod trajectory;
mod trajectory_state;
mod variation;
mod vehicle;

pub use check::{MOST_FRICTION, MOST_GRADE};
pub use evidence::{Method, Miss, MotionCovariance, NoSeparation, RestEvidence, Separation, SeparationEvidence, SlideFit};
pub use ground::{Area, Ground, Region, Surface};
pub use issue::{NoRest, SlideIssue, SlideIssues};
pub use path_point::{NearestPlace, PathPoint};
pub use slide::{Drag, Slide};
pub use tire::{Restraint, Tires};
pub use trajectory::{REST_SPEED, Rest};
pub use trajectory_state::{TIME_LIMIT, TrajectoryState};
pub use vehicle::{Pose, SlidingVehicle, Wheel, WheelPosition, Wheels};
