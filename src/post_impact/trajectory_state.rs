//! State of a vehicle during its slide.

use super::vehicle::Pose;
use crate::vehicle::Motion;

/// Time limit for a vehicle to come to rest, in s.
pub const TIME_LIMIT: f64 = 600.0;

/// Pose and motion of a vehicle at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TrajectoryState {
    /// The time since the start, in s.
    pub time: f64,
    /// Its pose.
    pub pose: Pose,
    /// Its motion.
    pub motion: Motion,
}
