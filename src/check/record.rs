//! One collision as a program reports it.

use super::key::Key;
use super::model::{Membership, Model, RatioKind};
use super::profile::Profile;
use super::reported::{Reported, ReportedImpulse};
use super::resolution::Resolution;
use crate::collision::Collision;
use crate::frame::Xy;
use crate::impact::Impact;
use crate::input::Side;
use crate::law::ImpulseRatio;
use crate::vehicle::{Motion, Party};
use alloc::string::String;

/// One collision as a program reports it, in SI and radians. What is not known is left out; what is checked follows from what is there.
///
/// ```
/// use planar_impact::check::{Record, State, Subject, check, Options};
/// use planar_impact::Xy;
///
/// // Two pucks in line: the lighter one comes back.
/// let puck = |mass, before, after| Subject {
///     mass: Some(mass),
///     before: State { velocity: Some(Xy { x: before, y: 0.0 }), yaw_rate: None },
///     after: State { velocity: Some(Xy { x: after, y: 0.0 }), yaw_rate: None },
///     ..Subject::default()
/// };
/// let record = Record { one: puck(1.0, 3.0, -1.0), two: puck(3.0, -1.0, 1.0 / 3.0), ..Record::default() };
/// check(&record, &Options::default()).assert();
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What the record is called in what is found about it.
    pub id: String,
    /// How exact its numbers are where no resolution is given.
    pub profile: Profile,
    /// Body 1; the impulse is the one on it.
    pub one: Subject,
    /// Body 2.
    pub two: Subject,
    /// Where the bodies touch, in ground axes, in m.
    pub point: Option<Xy>,
    /// The angle from x to the normal of the contact, in rad; either of its two directions.
    pub normal_angle: Option<f64>,
    /// The coefficients that the program says it used.
    pub model: Model,
    /// Other results of the program.
    pub reported: Reported,
    /// How exact the numbers are.
    pub resolution: Resolution,
    /// The group of records that must agree, if it is in one.
    pub group: Option<Membership>,
}

/// A body of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Subject {
    /// Whether no impulse moves it: a barrier. It has no mass then, and keeps its velocity; without one it is at rest.
    pub fixed: bool,
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Yaw inertia about the center of mass in kg m².
    pub yaw_inertia: Option<f64>,
    /// Where it points, from x, counter-clockwise, in rad. Needed for a direction of force only.
    pub heading: Option<f64>,
    /// Center of mass in ground axes, in m.
    pub center: Option<Xy>,
    /// How it moves before the impact.
    pub before: State,
    /// How it moves after the impact.
    pub after: State,
}

/// How a body moves, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Velocity of the center of mass, in m/s.
    pub velocity: Option<Xy>,
    /// Yaw rate in rad/s, counter-clockwise.
    pub yaw_rate: Option<f64>,
}

impl From<Motion> for State {
    fn from(motion: Motion) -> Self {
        State { velocity: Some(motion.velocity), yaw_rate: Some(motion.yaw_rate) }
    }
}

impl Subject {
    /// A barrier at rest.
    pub const FIXED: Subject = Subject {
        fixed: true,
        mass: None,
        yaw_inertia: None,
        heading: None,
        center: None,
        before: State { velocity: None, yaw_rate: None },
        after: State { velocity: None, yaw_rate: None },
    };
}

impl Record {
    /// The record of a collision and its impact, with everything that this crate computes of it as reported. The contact point is the origin.
    pub fn of(collision: &Collision, impact: &Impact) -> Record {
        let subject = |party: &Party, after: &Motion| match party {
            Party::Barrier => Subject::FIXED,
            Party::Vehicle(vehicle) => Subject {
                fixed: false,
                mass: Some(vehicle.mass),
                yaw_inertia: Some(vehicle.yaw_inertia),
                heading: Some(vehicle.heading.angle()),
                center: Some(-vehicle.heading.to_ground(vehicle.impact_center)),
                before: vehicle.motion.into(),
                after: (*after).into(),
            },
        };
        let (ratio_kind, impulse_ratio) = match collision.impulse_ratio {
            ImpulseRatio::Critical => (RatioKind::Critical, Some(impact.impulse_ratio())),
            ImpulseRatio::Given(ratio) => (RatioKind::Given, Some(ratio)),
            ImpulseRatio::OfCritical(fraction) => (RatioKind::OfCritical, Some(fraction)),
            ImpulseRatio::LimitedByFriction(friction) => (RatioKind::Friction, Some(friction)),
        };
        Record {
            one: subject(&collision.one, &impact.one.after),
            two: subject(&collision.two, &impact.two.after),
            point: Some(Xy::zero()),
            normal_angle: Some(collision.crush_plane.angle()),
            model: Model { restitution: Some(collision.restitution), impulse_ratio, ratio_kind, law: collision.law },
            reported: Reported {
                energy_loss: Some(impact.loss()),
                work_normal: Some(impact.work.n),
                work_tangential: Some(impact.work.t),
                kinetic_energy_before: Some(impact.kinetic_energy.before),
                kinetic_energy_after: Some(impact.kinetic_energy.after),
                delta_v: [Some(impact.one.delta_v_magnitude()), Some(impact.two.delta_v_magnitude())],
                pdof: [Some(impact.one.principal_direction_of_force()), Some(impact.two.principal_direction_of_force())],
                ees: [None, None],
                impulse: ReportedImpulse {
                    normal: Some(impact.impulse.n),
                    tangential: Some(impact.impulse.t),
                    x: Some(impact.impulse_on_ground.x),
                    y: Some(impact.impulse_on_ground.y),
                    magnitude: Some(impact.impulse.length()),
                },
                closing_speed: Some(impact.approach.n.abs()),
                separation_speed: Some(impact.separation.n.abs()),
                impulse_ratio: Some(impact.impulse_ratio()),
                // Infinite where the impulse that ends sliding has no normal part.
                critical_impulse_ratio: Some(impact.critical_impulse_ratio()).filter(|ratio| ratio.is_finite()),
            },
            ..Record::default()
        }
    }

    /// A body.
    pub fn subject(&self, side: Side) -> &Subject {
        match side {
            Side::One => &self.one,
            Side::Two => &self.two,
        }
    }

    /// A number, if it is known.
    pub fn get(&self, key: Key) -> Option<f64> {
        let reported = &self.reported;
        match key {
            Key::Mass(side) => self.subject(side).mass,
            Key::YawInertia(side) => self.subject(side).yaw_inertia,
            Key::Heading(side) => self.subject(side).heading,
            Key::CenterX(side) => self.subject(side).center.map(|c| c.x),
            Key::CenterY(side) => self.subject(side).center.map(|c| c.y),
            Key::BeforeX(side) => self.subject(side).before.velocity.map(|v| v.x),
            Key::BeforeY(side) => self.subject(side).before.velocity.map(|v| v.y),
            Key::BeforeYawRate(side) => self.subject(side).before.yaw_rate,
            Key::AfterX(side) => self.subject(side).after.velocity.map(|v| v.x),
            Key::AfterY(side) => self.subject(side).after.velocity.map(|v| v.y),
            Key::AfterYawRate(side) => self.subject(side).after.yaw_rate,
            Key::DeltaV(side) => reported.delta_v[side as usize],
            Key::ForceDirection(side) => reported.pdof[side as usize],
            Key::EquivalentEnergySpeed(side) => reported.ees[side as usize],
            Key::PointX => self.point.map(|p| p.x),
            Key::PointY => self.point.map(|p| p.y),
            Key::NormalAngle => self.normal_angle,
            Key::Restitution => self.model.restitution,
            Key::ImpulseRatio => self.model.impulse_ratio,
            Key::EnergyLoss => reported.energy_loss,
            Key::NormalWork => reported.work_normal,
            Key::TangentialWork => reported.work_tangential,
            Key::EnergyBefore => reported.kinetic_energy_before,
            Key::EnergyAfter => reported.kinetic_energy_after,
            Key::NormalImpulse => reported.impulse.normal,
            Key::TangentialImpulse => reported.impulse.tangential,
            Key::ImpulseX => reported.impulse.x,
            Key::ImpulseY => reported.impulse.y,
            Key::ImpulseMagnitude => reported.impulse.magnitude,
            Key::ClosingSpeed => reported.closing_speed,
            Key::SeparationSpeed => reported.separation_speed,
            Key::ReportedRatio => reported.impulse_ratio,
            Key::CriticalRatio => reported.critical_impulse_ratio,
        }
    }

    /// Sets a number. Of a position or a velocity whose other component is not known yet, that one becomes NaN, and is found to be until it is set.
    pub fn set(&mut self, key: Key, value: f64) {
        fn x(pair: &mut Option<Xy>, value: f64) {
            pair.get_or_insert(Xy { x: value, y: f64::NAN }).x = value;
        }
        fn y(pair: &mut Option<Xy>, value: f64) {
            pair.get_or_insert(Xy { x: f64::NAN, y: value }).y = value;
        }
        let (one, two) = (&mut self.one, &mut self.two);
        let subject = |side| match side {
            Side::One => one,
            Side::Two => two,
        };
        let reported = &mut self.reported;
        match key {
            Key::Mass(side) => subject(side).mass = Some(value),
            Key::YawInertia(side) => subject(side).yaw_inertia = Some(value),
            Key::Heading(side) => subject(side).heading = Some(value),
            Key::CenterX(side) => x(&mut subject(side).center, value),
            Key::CenterY(side) => y(&mut subject(side).center, value),
            Key::BeforeX(side) => x(&mut subject(side).before.velocity, value),
            Key::BeforeY(side) => y(&mut subject(side).before.velocity, value),
            Key::BeforeYawRate(side) => subject(side).before.yaw_rate = Some(value),
            Key::AfterX(side) => x(&mut subject(side).after.velocity, value),
            Key::AfterY(side) => y(&mut subject(side).after.velocity, value),
            Key::AfterYawRate(side) => subject(side).after.yaw_rate = Some(value),
            Key::DeltaV(side) => reported.delta_v[side as usize] = Some(value),
            Key::ForceDirection(side) => reported.pdof[side as usize] = Some(value),
            Key::EquivalentEnergySpeed(side) => reported.ees[side as usize] = Some(value),
            Key::PointX => x(&mut self.point, value),
            Key::PointY => y(&mut self.point, value),
            Key::NormalAngle => self.normal_angle = Some(value),
            Key::Restitution => self.model.restitution = Some(value),
            Key::ImpulseRatio => self.model.impulse_ratio = Some(value),
            Key::EnergyLoss => reported.energy_loss = Some(value),
            Key::NormalWork => reported.work_normal = Some(value),
            Key::TangentialWork => reported.work_tangential = Some(value),
            Key::EnergyBefore => reported.kinetic_energy_before = Some(value),
            Key::EnergyAfter => reported.kinetic_energy_after = Some(value),
            Key::NormalImpulse => reported.impulse.normal = Some(value),
            Key::TangentialImpulse => reported.impulse.tangential = Some(value),
            Key::ImpulseX => reported.impulse.x = Some(value),
            Key::ImpulseY => reported.impulse.y = Some(value),
            Key::ImpulseMagnitude => reported.impulse.magnitude = Some(value),
            Key::ClosingSpeed => reported.closing_speed = Some(value),
            Key::SeparationSpeed => reported.separation_speed = Some(value),
            Key::ReportedRatio => reported.impulse_ratio = Some(value),
            Key::CriticalRatio => reported.critical_impulse_ratio = Some(value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_set_is_what_is_got_and_nothing_else_moves() {
        let mut record = Record::default();
        assert!(Key::ALL.into_iter().all(|key| record.get(key).is_none()));
        for (value, key) in (1_i32..).map(f64::from).zip(Key::ALL) {
            record.set(key, value);
        }
        for (value, key) in (1_i32..).map(f64::from).zip(Key::ALL) {
            assert_eq!(record.get(key), Some(value), "{key}");
        }
    }

    #[test]
    fn half_a_pair_shows() {
        let mut record = Record::default();
        record.set(Key::AfterY(Side::Two), 1.0);
        assert!(record.get(Key::AfterX(Side::Two)).is_some_and(f64::is_nan));
        record.set(Key::AfterX(Side::Two), 2.0);
        assert_eq!(record.two.after.velocity, Some(Xy { x: 2.0, y: 1.0 }));
    }
}
