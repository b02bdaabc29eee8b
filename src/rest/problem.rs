//! What can be wrong with what is known of a slide, and why there is no rest or no separation to be told.

use alloc::vec::Vec;
use core::fmt;

use super::course::{Passing, TIME_LIMIT};
use super::ground::{Area, Region};
use super::slide::Slide;
use super::tire::Restraint;
use super::vehicle::Pose;

/// Why an input is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// A number is infinite or not a number.
    NotFinite {
        /// Its name.
        name: &'static str,
        /// Its place, where it is one of a list, counted from zero.
        index: Option<usize>,
        /// Its value.
        value: f64,
    },
    /// A number that must be above zero is not.
    NotPositive {
        /// Its name.
        name: &'static str,
        /// Its place, where it is one of a list, counted from zero.
        index: Option<usize>,
        /// Its value.
        value: f64,
    },
    /// A number lies outside of its range.
    OutOfRange {
        /// Its name.
        name: &'static str,
        /// Its place, where it is one of a list, counted from zero.
        index: Option<usize>,
        /// Its value.
        value: f64,
        /// The least that is accepted.
        least: f64,
        /// The greatest that is accepted.
        greatest: f64,
    },
    /// A region has no inside: fewer than three corners, all on a line, or a half-plane without a direction.
    NoArea {
        /// Which region, counted from zero.
        region: usize,
    },
}

/// All the problems of an input; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems(Vec<Problem>);

/// Why there is no rest.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoRest {
    /// The input is refused.
    Refused(Problems),
    /// The vehicle does not come to rest in [`TIME_LIMIT`]: this is how it moves then.
    Moves(Passing),
    /// The integration gave up here.
    NotFollowed(Passing),
}

impl Problems {
    /// The problems, in the order in which they were found.
    pub fn all(&self) -> &[Problem] {
        &self.0
    }
}

/// The problems found so far.
pub(super) struct Findings(Vec<Problem>);

impl Findings {
    pub fn finite(&mut self, name: &'static str, value: f64) -> bool {
        self.finite_at(name, None, value)
    }

    fn finite_at(&mut self, name: &'static str, index: Option<usize>, value: f64) -> bool {
        if !value.is_finite() {
            self.0.push(Problem::NotFinite { name, index, value });
        }
        value.is_finite()
    }

    pub fn positive(&mut self, name: &'static str, value: f64) {
        if self.finite(name, value) && value <= 0.0 {
            self.0.push(Problem::NotPositive { name, index: None, value });
        }
    }

    pub fn within(&mut self, name: &'static str, index: Option<usize>, value: f64, least: f64, greatest: f64) {
        if self.finite_at(name, index, value) && !(least..=greatest).contains(&value) {
            self.0.push(Problem::OutOfRange { name, index, value, least, greatest });
        }
    }

    pub fn pose(&mut self, names: [&'static str; 3], pose: &Pose) {
        let values = [pose.position.x, pose.position.y, pose.heading];
        for (name, value) in names.into_iter().zip(values) {
            self.finite(name, value);
        }
    }

    fn region(&mut self, index: usize, region: &Region) {
        self.within("region.friction", Some(index), region.friction, 0.0, MOST_FRICTION);
        let corners: Vec<_> = match &region.area {
            Area::HalfPlane { from, toward } => alloc::vec![*from, *toward],
            Area::Polygon(corners) => corners.clone(),
        };
        // One word for all its corners.
        if let Some(value) = corners.iter().flat_map(|corner| [corner.x, corner.y]).find(|value| !value.is_finite()) {
            self.0.push(Problem::NotFinite { name: "region.corner", index: Some(index), value });
            return;
        }
        let is_empty = match &region.area {
            Area::HalfPlane { toward, .. } => toward.length() == 0.0,
            Area::Polygon(corners) => {
                let from = |corner: &crate::Xy| *corner - corners[0];
                corners.len() < 3 || !corners.windows(2).any(|pair| from(&pair[0]).cross(from(&pair[1])) != 0.0)
            }
        };
        if is_empty {
            self.0.push(Problem::NoArea { region: index });
        }
    }

    pub fn done(self) -> Result<(), Problems> {
        if self.0.is_empty() { Ok(()) } else { Err(Problems(self.0)) }
    }
}

/// No tire holds more than this many times its load.
const MOST_FRICTION: f64 = 10.0;

impl Slide {
    /// What is wrong with the vehicle and with the ground.
    pub(super) fn findings(&self) -> Findings {
        let mut findings = Findings(Vec::new());
        let (vehicle, ground) = (&self.vehicle, &self.ground);
        findings.positive("mass", vehicle.mass);
        findings.positive("yaw_inertia", vehicle.yaw_inertia);
        findings.positive("front_axle", vehicle.front_axle);
        findings.positive("rear_axle", vehicle.rear_axle);
        findings.positive("track", vehicle.track);
        let wheels = &vehicle.wheels;
        for (index, wheel) in [&wheels.front_left, &wheels.front_right, &wheels.rear_left, &wheels.rear_right].into_iter().enumerate() {
            findings.finite_at("wheel.steer", Some(index), wheel.steer);
            if let Restraint::Braked(fraction) = wheel.restraint {
                findings.within("wheel.braking", Some(index), fraction, 0.0, 1.0);
            }
        }
        findings.within("rolling_resistance", None, vehicle.tires.rolling_resistance, 0.0, MOST_FRICTION);
        findings.positive("slip_angle", vehicle.tires.slip_angle);
        findings.positive("regularization", vehicle.tires.regularization);
        findings.within("friction", None, ground.friction, 0.0, MOST_FRICTION);
        findings.positive("gravity", ground.gravity);
        findings.positive("contact_length", ground.contact_length);
        for (index, region) in ground.regions.iter().enumerate() {
            findings.region(index, region);
        }
        findings
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = |f: &mut fmt::Formatter<'_>, name: &str, index: &Option<usize>| {
            f.write_str(name)?;
            index.iter().try_for_each(|index| write!(f, "[{index}]"))
        };
        match self {
            Problem::NotFinite { name, index, value } => {
                named(f, name, index)?;
                write!(f, " is {value}; a finite number is expected")
            }
            Problem::NotPositive { name, index, value } => {
                named(f, name, index)?;
                write!(f, " is {value}; it must be above zero")
            }
            Problem::OutOfRange { name, index, value, least, greatest } => {
                named(f, name, index)?;
                write!(f, " is {value}; it must lie between {least} and {greatest}")
            }
            Problem::NoArea { region } => write!(f, "region[{region}] has no inside"),
        }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl fmt::Display for NoRest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoRest::Refused(problems) => write!(f, "{problems}"),
            NoRest::Moves(passing) => {
                let Passing { motion, .. } = passing;
                write!(
                    f,
                    "the vehicle does not come to rest in {TIME_LIMIT} s: after {:.1} s it moves at {:.3} m/s and turns at {:.3} rad/s",
                    passing.time,
                    motion.velocity.length(),
                    motion.yaw_rate
                )
            }
            NoRest::NotFollowed(passing) => write!(f, "the way of the vehicle cannot be followed beyond {:.3} s", passing.time),
        }
    }
}

impl core::error::Error for Problem {}
impl core::error::Error for Problems {}
impl core::error::Error for NoRest {}
