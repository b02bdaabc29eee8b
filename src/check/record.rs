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
use crate::moment::Moment;
use crate::vehicle::{Motion, Party};
use alloc::string::String;

/// One collision as a program reports it, in SI and radians. Unknown values are left out; the rules that are checked follow from those that are present.
///
/// ```
/// use planar_impact::check::{Options, Record, Rule, State, Subject, check};
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
/// // Nothing is known of their rotation and contact.
/// check(&record, &Options::default()).assert_checked(&[Rule::LinearMomentum, Rule::EnergyGain]);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Record {
    /// The name of the record in its findings.
    pub id: String,
    /// Assumed precision of numbers without a resolution.
    pub profile: Profile,
    /// Body 1; impulses are those on body 1.
    pub one: Subject,
    /// Body 2.
    pub two: Subject,
    /// Contact point in ground axes, in m.
    pub point: Option<Xy>,
    /// Contact point at the end of a contact that lasts, with the bodies at [`Subject::center_after`]. Without those, it is a second point of the same
    /// instant. The impulse acts anywhere between the two.
    pub point_after: Option<Xy>,
    /// Duration of the contact in s. What the motion of the bodies meanwhile may explain is then a warning, unless the record has the places after it.
    pub duration: Option<f64>,
    /// The angle from x to the normal of the contact, in rad; either of its two directions.
    pub normal_angle: Option<f64>,
    /// Moment impulse on body 1 in N m s, counter-clockwise; body 2 gets the opposite. Without it the contact transmits no couple.
    pub moment: Option<f64>,
    /// The coefficients that the program states.
    pub model: Model,
    /// Other results of the program.
    pub reported: Reported,
    /// Resolutions of the numbers.
    pub resolution: Resolution,
    /// The group of records that must agree, if it is in one.
    pub group: Option<Membership>,
}

/// A body of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Subject {
    /// `true` if no impulse moves it, as a barrier. It then has no mass and keeps its velocity; without a velocity it is at rest.
    pub fixed: bool,
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Yaw inertia about the center of mass in kg m².
    pub yaw_inertia: Option<f64>,
    /// Heading from x, counter-clockwise, in rad. Needed only for a direction of force.
    pub heading: Option<f64>,
    /// Center of mass in ground axes, in m; at the beginning of a contact that lasts.
    pub center: Option<Xy>,
    /// Center of mass at the end of a contact that lasts, in m.
    pub center_after: Option<Xy>,
    /// Motion before the impact.
    pub before: State,
    /// Motion after the impact.
    pub after: State,
}

/// Motion of a body, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
        center_after: None,
        before: State { velocity: None, yaw_rate: None },
        after: State { velocity: None, yaw_rate: None },
    };
}

impl Record {
    /// Creates the record of a collision and its impact, with everything that this crate computes of it as reported. The contact point is the origin.
    pub fn of(collision: &Collision, impact: &Impact) -> Record {
        let subject = |party: &Party, after: &Motion| match party {
            Party::Barrier => Subject::FIXED,
            Party::Vehicle(vehicle) => Subject {
                fixed: false,
                mass: Some(vehicle.mass),
                yaw_inertia: Some(vehicle.yaw_inertia),
                heading: Some(vehicle.heading.angle()),
                center: Some(-vehicle.heading.to_ground(vehicle.impact_center)),
                center_after: None,
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
        let of_moment = |value: f64| Some(value).filter(|_| !matches!(collision.moment, Moment::None));
        Record {
            one: subject(&collision.one, &impact.one.after),
            two: subject(&collision.two, &impact.two.after),
            point: Some(Xy::zero()),
            normal_angle: Some(collision.crush_plane.angle()),
            moment: of_moment(impact.moment),
            model: Model { restitution: Some(collision.restitution), impulse_ratio, ratio_kind, law: collision.law },
            reported: Reported {
                energy_loss: Some(impact.loss()),
                work_normal: Some(impact.work.n),
                work_tangential: Some(impact.work.t),
                work_moment: of_moment(impact.work.m),
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
                // Infinite if the impulse that ends sliding has no normal component.
                critical_impulse_ratio: Some(impact.critical_impulse_ratio()).filter(|ratio| ratio.is_finite()),
            },
            ..Record::default()
        }
    }

    /// Returns a body.
    pub fn subject(&self, side: Side) -> &Subject {
        match side {
            Side::One => &self.one,
            Side::Two => &self.two,
        }
    }

    /// Returns a number, if it is known.
    pub fn get(&self, key: Key) -> Option<f64> {
        let reported = &self.reported;
        match key {
            Key::Mass(side) => self.subject(side).mass,
            Key::YawInertia(side) => self.subject(side).yaw_inertia,
            Key::Heading(side) => self.subject(side).heading,
            Key::CenterX(side) => self.subject(side).center.map(|c| c.x),
            Key::CenterY(side) => self.subject(side).center.map(|c| c.y),
            Key::CenterAfterX(side) => self.subject(side).center_after.map(|c| c.x),
            Key::CenterAfterY(side) => self.subject(side).center_after.map(|c| c.y),
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
            Key::PointAfterX => self.point_after.map(|p| p.x),
            Key::PointAfterY => self.point_after.map(|p| p.y),
            Key::Duration => self.duration,
            Key::NormalAngle => self.normal_angle,
            Key::Moment => self.moment,
            Key::Restitution => self.model.restitution,
            Key::ImpulseRatio => self.model.impulse_ratio,
            Key::EnergyLoss => reported.energy_loss,
            Key::NormalWork => reported.work_normal,
            Key::TangentialWork => reported.work_tangential,
            Key::MomentWork => reported.work_moment,
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

    /// Sets a number. If the other component of a position or a velocity is not known yet, it becomes NaN, which the check reports until it is set.
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
            Key::CenterAfterX(side) => x(&mut subject(side).center_after, value),
            Key::CenterAfterY(side) => y(&mut subject(side).center_after, value),
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
            Key::PointAfterX => x(&mut self.point_after, value),
            Key::PointAfterY => y(&mut self.point_after, value),
            Key::Duration => self.duration = Some(value),
            Key::NormalAngle => self.normal_angle = Some(value),
            Key::Moment => self.moment = Some(value),
            Key::Restitution => self.model.restitution = Some(value),
            Key::ImpulseRatio => self.model.impulse_ratio = Some(value),
            Key::EnergyLoss => reported.energy_loss = Some(value),
            Key::NormalWork => reported.work_normal = Some(value),
            Key::TangentialWork => reported.work_tangential = Some(value),
            Key::MomentWork => reported.work_moment = Some(value),
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
