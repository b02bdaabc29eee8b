//! Points of the ground that a vehicle passed, such as tire marks: evidence of its path.
//!
//! When it passed is not known. A point is compared with the place of the path that is nearest to it, in standard deviations along x and y. There the distance
//! is perpendicular to the path in these units, so that a point weighs as one residual; where the nearest place is an end of the path, its distance along the
//! path counts too.

use alloc::vec::Vec;

use super::slide::Slide;
use super::trajectory_state::TrajectoryState;
use super::vehicle::{Pose, WheelPosition};
use crate::frame::{ForwardLeft, Heading, Xy};
use crate::vehicle::Motion;

/// A point of the ground that a vehicle passed after separation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// The wheel that passed it; `None` for the center of mass.
    pub wheel: Option<WheelPosition>,
    /// Its position in ground axes, in m.
    pub position: Xy,
    /// The standard deviations of its position, in m.
    pub deviation: Xy,
}

/// The place of a path that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearestPlace {
    /// Time since separation, in s.
    pub time: f64,
    /// The place in ground axes, in m.
    pub position: Xy,
    /// Its distance from the point, in standard deviations; positive to the left of the path, except at an end of it.
    pub standardized_residual: f64,
    /// `true` if it is an end of the path: the vehicle did not come past the point, or was past it already.
    pub is_end: bool,
}

/// The part of a path on which the nearest place lies.
#[derive(Clone, Copy)]
pub(super) enum On {
    Start,
    /// Between two states of the path, at a share of the time between them. The normal is perpendicular to the path, in standard deviations.
    Step {
        first: usize,
        share: f64,
        normal: Xy,
    },
    End,
}

/// The nearest place of a path.
#[derive(Clone, Copy)]
pub(super) struct Passage {
    pub on: On,
    pub time: f64,
    pub pose: Pose,
    /// Computed less given place, in standard deviations.
    pub miss: Xy,
    place: Xy,
}

impl Passage {
    /// Returns its residuals: across the path, or both components at an end of it.
    pub(super) fn residuals(&self) -> [f64; 2] {
        match self.on {
            On::Step { normal, .. } => [normal.dot(self.miss), 0.0],
            On::Start | On::End => [self.miss.x, self.miss.y],
        }
    }

    pub(super) fn nearest_place(&self) -> NearestPlace {
        let (standardized_residual, is_end) = match self.on {
            // The point is to the left of the path where the path is to its right.
            On::Step { normal, .. } => (-normal.dot(self.miss), false),
            On::Start | On::End => (self.miss.length(), true),
        };
        NearestPlace { time: self.time, position: self.place, standardized_residual, is_end }
    }
}

/// Number of parts of a step in which a nearest place is looked for.
const PARTS: i32 = 6;

impl PathPoint {
    /// Returns the place of a trajectory that is nearest to the point, in standard deviations; `None` without a trajectory.
    pub fn nearest(&self, slide: &Slide, path: &[TrajectoryState]) -> Option<NearestPlace> {
        Some(self.passage(slide, path)?.nearest_place())
    }

    /// Returns the place of what passes the point, relative to the center of mass.
    pub(super) fn arm(&self, slide: &Slide) -> ForwardLeft {
        self.wheel.map_or_else(ForwardLeft::zero, |wheel| *slide.vehicle.places().of(wheel))
    }

    /// Returns the place of the path that is nearest to the point; `None` without a path.
    pub(super) fn passage(&self, slide: &Slide, path: &[TrajectoryState]) -> Option<Passage> {
        let (first, last) = (path.first()?, path.last()?);
        let arm = self.arm(slide);
        let at = |on: On, time: f64, pose: Pose| {
            let place = pose.position + Heading::from_angle(pose.heading).to_ground(arm);
            Passage { on, time, pose, miss: self.scaled(place - self.position), place }
        };
        let mut nearest = at(On::Start, first.time, first.pose);
        let mut take = |other: Passage| {
            if other.miss.length_squared() < nearest.miss.length_squared() {
                nearest = other;
            }
        };
        take(at(On::End, last.time, last.pose));
        let misses: Vec<f64> = path.iter().map(|state| at(On::End, state.time, state.pose).miss.length()).collect();
        let least = misses.iter().copied().fold(f64::INFINITY, f64::min);
        let length = arm.length();
        let speed = |state: &TrajectoryState| state.motion.velocity.length() + length * state.motion.yaw_rate.abs();
        for (i, pair) in path.windows(2).enumerate() {
            // A step that is too far away to come as near as a state does is not looked into. It goes less than twice as far as its ends are fast.
            let way = 2.0 * f64::max(speed(&pair[0]), speed(&pair[1])) * (pair[1].time - pair[0].time);
            if misses[i].min(misses[i + 1]) - way / self.deviation.x.min(self.deviation.y) > least {
                continue;
            }
            let step = Step::of(slide, &pair[0], &pair[1]);
            // The rate of change of half the square of the distance, which rises through zero at the nearest place.
            let rate = |share: f64| {
                let (pose, motion) = step.at(share);
                let arm = Heading::from_angle(pose.heading).to_ground(arm);
                let velocity = self.scaled(motion.velocity + arm.quarter_turn() * motion.yaw_rate);
                self.scaled(pose.position + arm - self.position).dot(velocity)
            };
            let mut before = rate(0.0);
            for part in 0..PARTS {
                let [mut from, mut to] = [part, part + 1].map(|part| f64::from(part) / f64::from(PARTS));
                let after = rate(to);
                if before < 0.0 && after >= 0.0 {
                    for _ in 0..50 {
                        let middle = f64::midpoint(from, to);
                        *(if rate(middle) < 0.0 { &mut from } else { &mut to }) = middle;
                    }
                    let (pose, motion) = step.at(to);
                    let arm = Heading::from_angle(pose.heading).to_ground(arm);
                    let along = self.scaled(motion.velocity + arm.quarter_turn() * motion.yaw_rate);
                    let normal = along.quarter_turn() * (1.0 / along.length());
                    take(at(On::Step { first: i, share: to, normal }, pair[0].time + to * step.duration, pose));
                }
                before = after;
            }
        }
        Some(nearest)
    }

    /// Returns a difference of places in standard deviations.
    pub(super) fn scaled(&self, difference: Xy) -> Xy {
        Xy { x: difference.x / self.deviation.x, y: difference.y / self.deviation.y }
    }
}

/// A step of the integration: the fifth-order polynomials that have pose, motion and acceleration at both ends.
struct Step {
    duration: f64,
    coefficients: [[f64; 6]; 3],
}

impl Step {
    fn of(slide: &Slide, from: &TrajectoryState, to: &TrajectoryState) -> Self {
        let duration = to.time - from.time;
        let parts = |state: &TrajectoryState| {
            let (motion, acceleration) = (state.motion, slide.acceleration(&state.pose, &state.motion));
            let of = |position: f64, rate: f64, change: f64| [position, rate * duration, change * duration * duration];
            [
                of(state.pose.position.x, motion.velocity.x, acceleration.velocity.x),
                of(state.pose.position.y, motion.velocity.y, acceleration.velocity.y),
                of(state.pose.heading, motion.yaw_rate, acceleration.yaw_rate),
            ]
        };
        let (start, end) = (parts(from), parts(to));
        let coefficients = core::array::from_fn(|i| {
            let ([p0, v0, a0], [p1, v1, a1]) = (start[i], end[i]);
            let way = p1 - p0;
            [
                p0,
                v0,
                0.5 * a0,
                10.0 * way - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
                -15.0 * way + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
                6.0 * way - 3.0 * v0 - 3.0 * v1 - 0.5 * a0 + 0.5 * a1,
            ]
        });
        Step { duration, coefficients }
    }

    fn at(&self, share: f64) -> (Pose, Motion) {
        let [(x, vx), (y, vy), (heading, yaw_rate)] = self.coefficients.map(|of| {
            // Horner's scheme, for the value and the derivative.
            of.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * share + c, slope * share + value))
        });
        let motion = Motion { velocity: Xy { x: vx, y: vy }, yaw_rate };
        (Pose { position: Xy { x, y }, heading }, motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Ground, SlidingVehicle, Wheel, Wheels};

    const LOCKED: Slide = Slide {
        vehicle: SlidingVehicle::sedan(Wheels {
            front_left: Wheel::LOCKED,
            front_right: Wheel::LOCKED,
            rear_left: Wheel::LOCKED,
            rear_right: Wheel::LOCKED,
        }),
        ground: Ground::uniform(0.7),
    };

    fn nearest(wheel: Option<WheelPosition>, x: f64, y: f64) -> NearestPlace {
        let motion = Motion { velocity: Xy { x: 12.0, y: 0.0 }, yaw_rate: 0.0 };
        let rest = LOCKED.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        let point = PathPoint { wheel, position: Xy { x, y }, deviation: Xy { x: 0.2, y: 0.1 } };
        point.nearest(&LOCKED, &rest.path).expect("a path")
    }

    /// Straight along x: by hand, a point 0.3 m to the left is 3 deviations of y away, and it is passed after v t − ½ μ g t².
    #[test]
    fn a_point_beside_a_straight_path_is_off_by_its_distance() {
        let place = nearest(None, 5.0, 0.3);
        assert!((place.standardized_residual - 3.0).abs() < 1e-9 && !place.is_end, "{place:?}");
        assert!((place.position - Xy { x: 5.0, y: 0.0 }).length() < 1e-6);
        let distance = 12.0 * place.time - 0.5 * 0.7 * 9.80665 * place.time * place.time;
        assert!((distance - 5.0).abs() < 1e-4, "{place:?}");
        // The right rear wheel of the sedan is 1.5 m behind and 0.75 m to the right.
        let of_wheel = nearest(Some(WheelPosition::RearRight), 3.5, -0.85);
        assert!((of_wheel.standardized_residual + 1.0).abs() < 1e-9 && (of_wheel.time - place.time).abs() < 1e-6, "{of_wheel:?}");
    }

    #[test]
    fn beyond_an_end_the_distance_along_the_path_counts_too() {
        let before = nearest(None, -0.4, 0.1);
        assert!(before.is_end && before.time == 0.0 && (before.standardized_residual - 5.0_f64.sqrt()).abs() < 1e-9, "{before:?}");
        let beyond = nearest(None, 100.0, 0.0);
        assert!(beyond.is_end && beyond.time > 1.0 && beyond.standardized_residual > 100.0, "{beyond:?}");
    }
}
