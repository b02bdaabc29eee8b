//! From where a vehicle came to rest back to how it separated.
//!
//! # The argument, file by file
//!
//! | what is known | what follows | here |
//! |---|---|---|
//! | a wheel, its load, friction and slip | the force of the road on it | [`Tires::force`] |
//! | a point of the ground | the friction there | [`Ground::friction_at`] |
//! | a vehicle, its pose and motion | force, moment and dissipation | [`Slide::drag`] |
//! | how it separated | where it comes to rest, and the way there | [`Slide::to_rest`] |
//! | where it separated and where it rests | its motion at separation, by the work of the tires along a straight way | [`Slide::closed_form`] |
//! | the same with standard deviations | its motion at separation with its covariance, by that or by the slide that ends there | [`Slide::separation`] |
//!
//! The equations of motion stand in one place, generic over the scalar. The integration is in f64; the derivatives of its end by the motion at separation and by
//! the friction are integrated beside it, from the same equations on dual numbers.
//!
//! # Properties
//!
//! | what holds | test in `proptests/rest.rs` |
//! |---|---|
//! | locked wheels without rotation stop in v²/(2μg), but for a regularization in closed form that vanishes with ε | `locked_wheels_stop_in_half_the_square_over_friction` |
//! | free wheels straight ahead stop in v²/(2fg) | `free_wheels_roll_to_a_stop` |
//! | two frictions on the way take their shares, v² = 2g(μ₁d₁ + μ₂d₂) | `two_frictions_take_their_shares` |
//! | the tires dissipate the kinetic energy | `the_tires_dissipate_what_there_was` |
//! | the end turns, moves and mirrors with the scene | `the_end_turns_with_the_scene` |
//! | mass does not matter, and lengths scale with the square of speeds | `the_end_scales` |
//! | half the step, a sixteenth of the error of a fourth-order method | `the_error_of_a_step_is_of_its_order` |
//! | forward and back is the same separation | `forward_and_back` |
//! | the closed form is exact for locked wheels without rotation | `the_closed_form_is_exact_for_locked_wheels_without_rotation` |
//! | no input makes it hang or panic | `nothing_hangs_and_nothing_panics` |
//!
//! Derivatives and covariance are held against difference quotients beside the code.

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
