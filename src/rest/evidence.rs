//! What is known of a vehicle at rest, and what it says of its separation.

use alloc::vec::Vec;
use core::fmt;

use super::course::Passing;
use super::problem::{NoRest, Problems};
use super::slide::Slide;
use super::vehicle::Pose;
use crate::frame::Xy;
use crate::vehicle::Motion;

/// Where a vehicle separated and where it came to rest, and how well that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestEvidence {
    /// Where it separated, taken for known.
    pub separation: Pose,
    /// Where it came to rest; the whole turns between the two headings count.
    pub rest: Pose,
    /// The standard deviations of the position at rest, in m.
    pub position_deviation: Xy,
    /// The standard deviation of the heading at rest, in rad.
    pub heading_deviation: f64,
    /// The standard deviation of a factor that all frictions have in common, 1: a friction of 0.7 ± 0.07 has 0.1.
    pub friction_deviation: f64,
}

/// How the separation is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the slide that ends in the pose at rest.
    Slide,
    /// By the work of the tires along a straight way.
    ClosedForm,
}

/// How a vehicle separated.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// Its velocity on the ground and its yaw rate.
    pub motion: Motion,
    /// How well they are known.
    pub covariance: MotionCovariance,
    /// The part of their error that the friction makes: how they change if every friction is larger by its standard deviation, in m/s and rad/s. The covariance
    /// has it in. Of two vehicles on the same ground these errors go together: their covariance is the product of the two parts.
    pub by_friction: Motion,
    /// How the slide was fitted to the pose at rest; none of the closed form.
    pub fit: Option<SlideFit>,
}

/// The covariance of V_x, V_y and Ω, in this order, in m/s and rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionCovariance(pub [[f64; 3]; 3]);

/// How a slide was fitted to a pose at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct SlideFit {
    /// Steps of the search that found it.
    pub iterations: usize,
    /// Starts that were tried.
    pub starts: usize,
    /// Starts that led to a solution.
    pub converged: usize,
    /// How far its slide misses the pose at rest.
    pub miss: Miss,
    /// Other separations that the pose at rest does not tell from this one.
    pub others: Vec<OtherSeparation>,
}

/// A pose at rest as computed less the one that was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Of the position, in m.
    pub position: Xy,
    /// Of the heading, in rad.
    pub heading: f64,
}

/// Another separation with a slide to the same pose at rest, or as near to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherSeparation {
    /// Its velocity on the ground and its yaw rate.
    pub motion: Motion,
    /// How far its slide misses the pose at rest.
    pub miss: Miss,
}

/// Why nothing can be said of a separation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoSeparation {
    /// The input is refused.
    Refused(Problems),
    /// No motion that was tried comes to rest: why the first does not, that of the closed form.
    NoRest(NoRest),
    /// No search ends in a solution; the best of all that was tried.
    NotConverged {
        /// The motion whose slide ends nearest to the pose, in standard deviations.
        motion: Motion,
        /// How far its slide misses the pose at rest.
        miss: Miss,
    },
    /// The pose at rest does not determine the motion: a change of it along this one moves the rest by nothing that counts.
    NotDetermined {
        /// The direction, of length 1 in m/s and rad/s; nothing where the derivatives are no numbers.
        along: Motion,
    },
    /// The closed form has no solution: on a straight way the tires would drive the vehicle.
    Driven,
    /// The closed form cannot say how it turned: the tires alone would turn the vehicle, as where one side drags more, and it turned no further than a few
    /// deviations from none, or from where they would drive it.
    Turned {
        /// The change of its heading, in rad.
        turn: f64,
        /// The deviation of its heading, in rad.
        deviation: f64,
    },
    /// The closed form cannot say how uncertain it is: the vehicle moved no further than the position at rest is uncertain.
    TooShort {
        /// How far it moved, in m.
        distance: f64,
        /// The larger of the deviations of its position, in m.
        deviation: f64,
    },
}

impl Separation {
    /// The correlation of V_x, V_y or Ω of one vehicle with one of them of another, which slid on the same ground: the friction makes it.
    pub fn correlation_by_friction(&self, i: usize, other: &Separation, k: usize) -> f64 {
        let part = |of: &Separation| [of.by_friction.velocity.x, of.by_friction.velocity.y, of.by_friction.yaw_rate];
        let scale = self.covariance.deviations()[i] * other.covariance.deviations()[k];
        if scale > 0.0 { part(self)[i] * part(other)[k] / scale } else { 0.0 }
    }
}

impl MotionCovariance {
    /// The standard deviations of V_x and V_y, in m/s, and of Ω, in rad/s.
    pub fn deviations(&self) -> [f64; 3] {
        core::array::from_fn(|i| self.0[i][i].sqrt())
    }

    /// The correlation of two of them, from −1 to 1; of what has no variance, 0.
    pub fn correlation(&self, i: usize, k: usize) -> f64 {
        let scale = (self.0[i][i] * self.0[k][k]).sqrt();
        if scale > 0.0 { self.0[i][k] / scale } else { 0.0 }
    }
}

impl Miss {
    pub(super) fn of(computed: &Pose, given: &Pose) -> Miss {
        Miss { position: computed.position - given.position, heading: computed.heading - given.heading }
    }

    /// Whether the pose is reached: to a tenth of a millimeter and a hundredth of a degree.
    pub fn is_nothing(&self) -> bool {
        self.position.length() <= 1e-4 && self.heading.abs() <= 1.75e-4
    }
}

impl Slide {
    /// How a vehicle separated that came to rest in a pose.
    ///
    /// # Errors
    ///
    /// [`NoSeparation`]: everything wrong with the input, or why the pose at rest does not say it.
    pub fn separation(&self, evidence: &RestEvidence, method: Method) -> Result<Separation, NoSeparation> {
        self.check_evidence(evidence).map_err(NoSeparation::Refused)?;
        match method {
            Method::ClosedForm => self.separation_in_closed_form(evidence),
            Method::Slide => self.separation_by_slide(evidence),
        }
    }

    fn check_evidence(&self, evidence: &RestEvidence) -> Result<(), Problems> {
        let mut findings = self.findings();
        findings.pose(["separation.position.x", "separation.position.y", "separation.heading"], &evidence.separation);
        findings.pose(["rest.position.x", "rest.position.y", "rest.heading"], &evidence.rest);
        findings.positive("rest.position.x.sd", evidence.position_deviation.x);
        findings.positive("rest.position.y.sd", evidence.position_deviation.y);
        findings.positive("rest.heading.sd", evidence.heading_deviation);
        findings.within("friction.sd", None, evidence.friction_deviation, 0.0, 1.0);
        findings.done()
    }
}

impl fmt::Display for NoSeparation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoSeparation::Refused(problems) => write!(f, "{problems}"),
            NoSeparation::NoRest(NoRest::Moves(Passing { time, .. })) => {
                write!(f, "the vehicle does not come to rest: it still moves after {time:.0} s, from every motion that was tried")
            }
            NoSeparation::NoRest(why) => write!(f, "{why}"),
            NoSeparation::NotConverged { miss, .. } => write!(
                f,
                "no slide was found that ends in the pose at rest: the best misses it by {:.3} m and {:.2} deg",
                miss.position.length(),
                miss.heading.to_degrees()
            ),
            NoSeparation::NotDetermined { along } if *along == Motion::rest() => {
                write!(f, "how the pose at rest moves with the separation has no numbers")
            }
            NoSeparation::NotDetermined { along } => write!(
                f,
                "the pose at rest does not determine the separation: motions that differ along ({:.3} m/s, {:.3} m/s, {:.3} rad/s) end in the same",
                along.velocity.x, along.velocity.y, along.yaw_rate
            ),
            NoSeparation::Driven => write!(f, "on a straight way to the pose at rest the tires would drive the vehicle"),
            NoSeparation::Turned { turn, deviation } => write!(
                f,
                "the drag of the tires is not alike on both sides and would turn the vehicle, which turned {:.1} deg ± {:.1} deg: the closed form cannot say how",
                turn.to_degrees(),
                deviation.to_degrees()
            ),
            NoSeparation::TooShort { distance, deviation } => {
                write!(f, "the vehicle moved {distance:.3} m, no further than the position at rest is uncertain, {deviation:.3} m")
            }
        }
    }
}

impl core::error::Error for NoSeparation {}
