//! Issues of a slide.

use alloc::borrow::Cow;
use core::fmt;

use super::trajectory_state::{TIME_LIMIT, TrajectoryState};
use crate::issue::{InputIssue, Issue, Issues, Place};
use crate::measure::Measure;
use crate::message::Message;

/// Reason for refusing the input of a slide.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SlideIssue {
    /// A number is invalid.
    Input(InputIssue),
    /// A region of the ground has no inside: fewer than three corners, all on a line, or a half-plane without a direction.
    NoArea {
        /// The region, counted from zero.
        region: usize,
    },
}

/// All issues of the input of a slide; never empty.
pub type SlideIssues = Issues<SlideIssue>;

/// Reason for the absence of a rest position.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum NoRest {
    /// The input is refused.
    Refused(SlideIssues),
    /// The vehicle does not come to rest within [`TIME_LIMIT`]: this is its state then.
    Moves(TrajectoryState),
    /// It stops in this state on a grade that is steeper than its tires hold.
    RollsBack(TrajectoryState),
    /// The integration failed at this state.
    NotFollowed(TrajectoryState),
}

impl From<InputIssue> for SlideIssue {
    fn from(issue: InputIssue) -> Self {
        SlideIssue::Input(issue)
    }
}

impl Issue for SlideIssue {
    type Number = f64;

    fn code(&self) -> &'static str {
        match self {
            SlideIssue::Input(issue) => issue.code(),
            SlideIssue::NoArea { .. } => "no-area",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            SlideIssue::Input(issue) => issue.path(),
            SlideIssue::NoArea { region } => Some(Place::plain("region").at(*region).path()),
        }
    }

    fn message(&self) -> Message {
        match self {
            SlideIssue::Input(issue) => issue.message(),
            SlideIssue::NoArea { .. } => "the region has no inside".into(),
        }
    }

    fn help(&self) -> Option<Message> {
        match self {
            SlideIssue::Input(issue) => issue.help(),
            SlideIssue::NoArea { .. } => Some("give three or more corners that are not all on a line".into()),
        }
    }
}

impl Issue for NoRest {
    type Number = f64;

    /// Returns the code of the first issue if the input is refused.
    fn code(&self) -> &'static str {
        match self {
            NoRest::Refused(issues) => issues.first().code(),
            NoRest::Moves(_) => "does-not-rest",
            NoRest::RollsBack(_) => "rolls-back",
            NoRest::NotFollowed(_) => "integration-failed",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            NoRest::Refused(issues) => issues.first().path(),
            _ => None,
        }
    }

    fn message(&self) -> Message {
        match self {
            NoRest::Refused(issues) => Message::new().text(alloc::format!("{issues}")),
            NoRest::Moves(TrajectoryState { time, motion, .. }) => Message::new()
                .text("the vehicle does not come to rest within ")
                .figure(Measure::Time, TIME_LIMIT)
                .text(": after ")
                .figure(Measure::Time, *time)
                .text(" it moves at ")
                .figure(Measure::Speed, motion.velocity.length())
                .text(" and turns at ")
                .figure(Measure::YawRate, motion.yaw_rate),
            NoRest::RollsBack(TrajectoryState { time, pose, .. }) => Message::new()
                .text("the vehicle stops after ")
                .figure(Measure::Time, *time)
                .text(" at (")
                .figure(Measure::Length, pose.position.x)
                .text(", ")
                .figure(Measure::Length, pose.position.y)
                .text(") and rolls back: the grade there is steeper than its tires hold"),
            NoRest::NotFollowed(TrajectoryState { time, .. }) => {
                Message::new().text("the integration of the motion fails at ").figure(Measure::Time, *time)
            }
        }
    }
}

impl fmt::Display for SlideIssue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SlideIssue::Input(issue) => issue.fmt(f),
            SlideIssue::NoArea { region } => write!(f, "region[{region}] has no inside"),
        }
    }
}

impl fmt::Display for NoRest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3}", self.message())
    }
}

impl core::error::Error for SlideIssue {}
impl core::error::Error for NoRest {}
