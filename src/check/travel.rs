//! Motion of the bodies during a contact that lasts.
//!
//! The laws of an impact hold for an instant. During a contact of duration τ the lever arm of the impulse on each body changes. If the record has the
//! centers of mass and the contact point after the contact too, the impulse acts between the two arms, r and r + d, and the angular momentum it can transfer is
//! known up to ½ |d × P|. Otherwise the change of the arms is bounded by τ times the speed of the bodies relative to each other, and a residual that this
//! may explain is a warning.

use super::record::Record;
use super::subject::{Subject, When};
use super::uncertain::Uncertain;
use crate::frame::Xy;
use crate::input::Side;

/// Change of the lever arms during a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travel {
    /// Change of each arm from the contact point before to that after, in m.
    paths: [Xy; 2],
    /// Bound on further change of the arms, in m.
    unknown: f64,
    /// `true` if the two contact points are of one instant: the relative velocity of either may be the one that the laws hold for.
    is_of_two_points: bool,
    /// The larger yaw rate of each body, before or after, in rad/s.
    yaw_rates: [f64; 2],
    lasts: bool,
}

fn values<const N: usize>(v: Xy<Uncertain<N>>) -> Xy {
    v.map(|x| x.value)
}

impl Travel {
    pub(super) fn of<const N: usize>(record: &Record, one: &Subject<N>, two: &Subject<N>) -> Self {
        let bodies = [one, two];
        let is_placed = bodies.iter().all(|body| body.fixed || body.center_after.is_some());
        let path = |body: &Subject<N>| body.arm.zip(body.arm_after).map_or(Xy::zero(), |(arm, after)| values(after) - values(arm));
        let yaw_rate = |body: &Subject<N>, when| body.yaw_rate(when).map_or(0.0, |rate| rate.value.abs());
        let speed = |when| {
            let past = (values(two.velocity(when)?) - values(one.velocity(when)?)).length();
            let turning = bodies.map(|body| yaw_rate(body, when) * body.arm.or(body.arm_after).map_or(0.0, |arm| values(arm).length()));
            Some(past + turning[0] + turning[1])
        };
        // Without one of the relative velocities nothing bounds the change of the arms.
        let fastest = speed(When::Before).zip(speed(When::After)).map_or(f64::INFINITY, |(before, after)| before.max(after));
        // A center of mass that moved says that the contact lasts, and not how long.
        let is_moved =
            bodies.iter().any(|body| body.center.zip(body.center_after).is_some_and(|(before, after)| values(before) != values(after)));
        let without_duration = if is_moved { f64::INFINITY } else { 0.0 };
        let by_duration = record.duration.map_or(without_duration, |duration| product(duration, fastest));
        let is_open = bodies.iter().any(|body| !body.fixed && body.arm.is_none());
        let unknown = match (record.point_after, is_placed) {
            (Some(_), true) if !is_open => 0.0,
            (None, true) => record.duration.map_or(0.0, |_| by_duration).max(displacement(one, two, record.duration)),
            _ => by_duration,
        };
        Travel {
            paths: bodies.map(path),
            unknown,
            is_of_two_points: record.point_after.is_some() && !is_placed,
            yaw_rates: bodies.map(|body| yaw_rate(body, When::Before).max(yaw_rate(body, When::After))),
            lasts: is_moved || record.duration.is_some_and(|duration| duration > 0.0),
        }
    }

    /// Returns `true` if no arm changes.
    pub(super) fn is_none(&self) -> bool {
        self.unknown == 0.0 && !self.is_of_two_points && self.paths.iter().all(|path| *path == Xy::zero())
    }

    /// Returns the angular momentum that remains open between the two arms of a body, ½ |d × P|.
    pub(super) fn moment_slack(&self, side: Side, impulse: Xy) -> f64 {
        0.5 * self.paths[side as usize].cross(impulse).abs()
    }

    /// Returns the angular momentum that motion unknown to the record may explain.
    pub(super) fn moment_leeway(&self, impulse: Xy) -> f64 {
        product(self.unknown, impulse.length())
    }

    /// Returns the work that remains open between the arms, ½ Σ max(|ω|, |Ω|) |d × P|.
    pub(super) fn work_slack(&self, impulse: Xy) -> f64 {
        [Side::One, Side::Two].map(|side| self.yaw_rates[side as usize] * self.moment_slack(side, impulse)).iter().sum()
    }

    /// Returns what the difference between a work and the impulse times the mean of speeds may be by itself: of a contact that lasts it is any, as the
    /// point at which the impulse acts moves while the bodies turn.
    pub(super) fn leeway_of_mean_speed(&self) -> f64 {
        if self.lasts { f64::INFINITY } else { 0.0 }
    }

    /// Returns the work that motion unknown to the record may explain.
    pub(super) fn work_leeway(&self, impulse: Xy) -> f64 {
        product(self.yaw_rates[0] + self.yaw_rates[1], self.moment_leeway(impulse))
    }

    /// Returns the relative velocity at the contact that motion unknown to the record may explain.
    pub(super) fn velocity_leeway(&self) -> f64 {
        let reach = |path: Xy| self.unknown + if self.is_of_two_points { path.length() } else { 0.0 };
        product(self.yaw_rates[0], reach(self.paths[0])) + product(self.yaw_rates[1], reach(self.paths[1]))
    }
}

/// Returns the product of two numbers of at least zero, of which one may be infinite: zero if either is zero.
fn product(one: f64, other: f64) -> f64 {
    if one == 0.0 || other == 0.0 { 0.0 } else { one * other }
}

/// Returns the distance by which the centers of mass move relative to each other, or one relative to a fixed body.
fn displacement<const N: usize>(one: &Subject<N>, two: &Subject<N>, duration: Option<f64>) -> f64 {
    let moved = |body: &Subject<N>| {
        if body.fixed {
            return Some(values(body.before?) * duration.unwrap_or(0.0));
        }
        Some(values(body.center_after?) - values(body.center?))
    };
    moved(one).zip(moved(two)).map_or(0.0, |(one, two)| (two - one).length())
}
