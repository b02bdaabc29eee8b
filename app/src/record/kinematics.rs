//! `[kinematics]` of a recording: the restitution of a point of the vehicle from its measured motion at contact and at separation.

use num_dual::Dual64;
use planar_impact::barrier::{Estimate, MeasuredContact, TestIssues};
use planar_impact::scalar::Real;
use planar_impact::{CrushPlane, ForwardLeft, Heading, Motion, Nt, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use super::Uncertain;
use crate::case::CaseReader;
use crate::document::Table;
use crate::named::positive_zero;
use crate::quantity::Kind;
use crate::units::Measure;
use crate::unusual;

/// The restitution of a point from measured kinematics, in SI.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Kinematics {
    /// Restitution of the point along the normal of the barrier.
    pub restitution: Uncertain,
    /// Velocity of the point at separation: along the normal, and along the barrier, in m/s.
    pub separation: [f64; 2],
    /// Heading at separation, in rad.
    pub heading_at_separation: f64,
}

/// The measured numbers, in this order: velocity and yaw rate before and after, the duration, the point before, and after if it is another one; with the angles of
/// the heading and the barrier, which count as exact.
pub(super) struct MeasuredKinematics {
    numbers: Vec<Estimate>,
    heading: f64,
    barrier: f64,
}

/// The point of a vehicle that a test followed to its barrier.
pub(crate) struct FollowedPoint {
    /// Where it is on the vehicle, ahead of the center of mass and to its left.
    pub(crate) place: [Estimate; 2],
    /// Speed of the vehicle before the impact.
    pub(crate) speed: Estimate,
    /// Angle of the barrier from the heading of the vehicle, in rad.
    pub(crate) barrier: f64,
}

impl CaseReader {
    pub(super) fn kinematics(&self, table: &Table<'_>) -> Option<MeasuredKinematics> {
        let angle = |key| match table.has(key) {
            true => self.quantity(table.optional(key), Kind::ANGLE),
            false => Some(0.0),
        };
        let (heading, barrier) = (angle("heading"), angle("barrier"));
        let motion = |key| {
            let table = table.required(key).table()?;
            let velocity = self.pair_of_estimates(&table, "velocity", Measure::Speed);
            let yaw_rate = match table.has("yaw_rate") {
                true => self.measured_estimate(table.optional("yaw_rate"), Measure::YawRate),
                false => Some(EXACT_ZERO),
            };
            table.finish();
            Some((velocity?, yaw_rate?))
        };
        let (before, after) = (motion("before"), motion("after"));
        let point = self.pair_of_estimates(table, "point", Measure::Length);
        let deformed = match table.has("point_after") {
            true => self.pair_of_estimates(table, "point_after", Measure::Length).map(Some),
            false => Some(None),
        };
        let duration = self.measured_estimate(table.required("duration"), Measure::Time);
        let path = format!("{}.duration", table.path());
        let unusual = duration.and_then(|duration| unusual::duration(&path, "the contact lasts".to_owned(), duration.value));
        self.notices.borrow_mut().extend(unusual);
        table.finish();
        let (([vx, vy], w), ([wx, wy], after_w), [forward, left]) = (before?, after?, point?);
        let mut numbers = vec![vx, vy, w, wx, wy, after_w, duration?, forward, left];
        numbers.extend(deformed?.into_iter().flatten());
        Some(MeasuredKinematics { numbers, heading: heading?, barrier: barrier? })
    }

    fn pair_of_estimates(&self, table: &Table<'_>, key: &'static str, measure: Measure) -> Option<[Estimate; 2]> {
        let expected = format!("an array of two values, each {}", Kind::from(measure).wanted());
        let items = table.required(key).items(&expected, 2..=2)?;
        let read: Vec<_> = items.into_iter().map(|item| self.measured_estimate(item, measure)).collect();
        read.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
    }
}

const EXACT_ZERO: Estimate = Estimate { value: 0.0, variance: 0.0 };

impl MeasuredKinematics {
    /// Returns the point that it follows.
    pub(super) fn followed(&self) -> FollowedPoint {
        let [x, y] = [0, 1].map(|at| self.numbers[at]);
        let speed = libm::hypot(x.value, y.value);
        // Of a vehicle at rest either component is the speed.
        let share = |component: f64| if speed > 0.0 { component / speed } else { 1.0 };
        let variance = [x, y].map(|of| share(of.value) * share(of.value) * of.variance).iter().sum();
        let place = [7, 8].map(|at| self.numbers[at]);
        FollowedPoint { place, speed: Estimate { value: speed, variance }, barrier: self.barrier - self.heading }
    }

    /// Returns the restitution, with its variance to first order: the numbers are independent.
    pub(super) fn answer(&self) -> Result<Kinematics, TestIssues> {
        let values: Vec<f64> = self.numbers.iter().map(|number| number.value).collect();
        let contact = contact(&values, [self.heading, self.barrier]);
        let restitution = contact.restitution()?;
        let by = |i: usize| {
            let seeded: Vec<Dual64> =
                values.iter().enumerate().map(|(k, value)| Dual64::new(*value, f64::from(u8::from(k == i)))).collect();
            self::contact(&seeded, [self.heading, self.barrier].map(Dual64::from))
                .restitution()
                .map_or(f64::NAN, |restitution| restitution.eps)
        };
        let variance: f64 = self.numbers.iter().enumerate().map(|(i, number)| by(i) * by(i) * number.variance).sum();
        let is_known = self.numbers.iter().any(|number| number.variance > 0.0);
        let Nt { n, t } = contact.separation();
        Ok(Kinematics {
            restitution: Uncertain::of(Estimate { value: restitution, variance }, is_known),
            separation: [n, t].map(positive_zero),
            heading_at_separation: positive_zero(contact.at_separation().heading.angle()),
        })
    }
}

/// Returns the contact of measured numbers. A point that is measured once is the same number before and after.
fn contact<T: Real + Copy>(numbers: &[T], [heading, barrier]: [T; 2]) -> MeasuredContact<T> {
    let motion = |at: usize| Motion { velocity: Xy { x: numbers[at], y: numbers[at + 1] }, yaw_rate: numbers[at + 2] };
    let point = |at: usize| ForwardLeft { forward: numbers[at], left: numbers[at + 1] };
    MeasuredContact {
        heading: Heading::from_angle(heading),
        before: motion(0),
        after: motion(3),
        duration: numbers[6],
        point_before: point(7),
        point_after: point(numbers.len() - 2),
        barrier: CrushPlane::from_angle(barrier),
    }
}
