//! Derived quantities of a record: those whose inputs are known, computed by the crate's own mechanics on numbers with a resolution.

use super::energy_loss::EnergyLoss;
use super::key::Key;
use super::record::Record;
use super::subject::{Subject, When, number, pair};
use super::travel::Travel;
use super::uncertain::{Uncertain, best_known, sharper_known};
use crate::body::Body;
use crate::contact::{Contact, relative_velocity};
use crate::energy::{Work, work};
use crate::frame::{CrushPlane, Nt, Xy};
use crate::input::Side;
use crate::law::Law;

/// The known quantities of a record.
pub(super) struct Known<'a, const N: usize> {
    pub(super) record: &'a Record,
    pub(super) one: Subject<N>,
    pub(super) two: Subject<N>,
    pub(super) plane: Option<CrushPlane<Uncertain<N>>>,
    /// The moment impulse on body 1; `None` if the contact transmits no couple.
    pub(super) moment: Option<Uncertain<N>>,
    /// The impulse on body 1 in ground axes, from the body that determines it more precisely.
    pub(super) impulse: Option<Xy<Uncertain<N>>>,
    /// The same in contact axes.
    pub(super) contact_impulse: Option<Nt<Uncertain<N>>>,
    /// From center of mass 1 to center of mass 2; a fixed body's reference point is the contact point.
    pub(super) offset: Option<Nt<Uncertain<N>>>,
    /// Change of the lever arms during the contact.
    pub(super) travel: Travel,
    /// The bodies at the contact point before the impact.
    pub(super) before: Option<Meeting<N>>,
    /// The same after it.
    pub(super) after: Option<Meeting<N>>,
    /// Quantities that need the contact and the motions around it.
    pub(super) touch: Option<Touch<N>>,
    /// Quantities that need masses and motions.
    pub(super) energy_loss: Option<EnergyLoss<N>>,
    /// Sizes of motions that are left out.
    pub(super) beside: Sizes,
}

/// Sizes beside which numbers may be rounding: a speed in m/s, an impulse in N s and an energy in J.
#[derive(Clone, Copy, Default)]
pub(super) struct Sizes {
    pub(super) speed: f64,
    pub(super) impulse: f64,
    pub(super) energy: f64,
}

/// Two bodies at the contact point, before the impact or after it.
#[derive(Clone, Copy)]
pub(super) struct Meeting<const N: usize> {
    /// Relative velocity, of body 2 less body 1.
    pub(super) velocity: Nt<Uncertain<N>>,
    /// `true` for two point masses, which touch at both centers of mass and have no sides.
    pub(super) is_of_points: bool,
    /// The bodies, without their inertia.
    pub(super) bodies: [Body<Uncertain<N>>; 2],
}

impl<const N: usize> Meeting<N> {
    fn of(plane: &CrushPlane<Uncertain<N>>, subjects: [&Subject<N>; 2], when: When) -> Option<Self> {
        let bodies = [subjects[0].body(plane, when)?, subjects[1].body(plane, when)?];
        Some(Meeting {
            velocity: relative_velocity(&bodies[0], &bodies[1]),
            is_of_points: subjects.iter().all(|subject| subject.has_no_arm() && !subject.fixed),
            bodies,
        })
    }
}

/// The impact at the contact point.
#[derive(Clone, Copy)]
pub(super) struct Touch<const N: usize> {
    /// Relative velocity before, of body 2 less body 1.
    pub(super) approach: Nt<Uncertain<N>>,
    /// Relative velocity after.
    pub(super) separation: Nt<Uncertain<N>>,
    /// Impulse on body 1.
    pub(super) impulse: Option<Nt<Uncertain<N>>>,
    pub(super) work: Option<Work<Uncertain<N>>>,
    /// Moment impulse on body 1; `None` if the contact transmits no couple.
    pub(super) moment: Option<Uncertain<N>>,
    /// The bodies before the impact, without their inertia.
    bodies: [Body<Uncertain<N>>; 2],
    subjects: [Subject<N>; 2],
}

impl<'a, const N: usize> Known<'a, N> {
    pub(super) fn of(record: &'a Record) -> Self {
        let point = pair(record, Key::PointX, Key::PointY);
        let plane = number(record, Key::NormalAngle).map(turned);
        Known::of_bodies(record, Side::ALL.map(|side| Subject::of(record, side, point)), plane, None)
    }

    /// Returns what is known of bodies and the crush plane, with the impulse on body 1 if the motions do not determine it.
    pub(super) fn of_bodies(
        record: &'a Record,
        [one, two]: [Subject<N>; 2],
        plane: Option<CrushPlane<Uncertain<N>>>,
        impulse: Option<Xy<Uncertain<N>>>,
    ) -> Self {
        let on_two = two.momentum_gained().map(|gained| -gained);
        let radius = |p: &Xy<Uncertain<N>>| p.x.radius() + p.y.radius();
        let mean = |one: Xy<Uncertain<N>>, two: Xy<Uncertain<N>>| Xy { x: one.x.mean(two.x), y: one.y.mean(two.y) };
        let impulse = best_known(one.momentum_gained(), on_two, radius, mean).or(impulse);
        let moment = number(record, Key::Moment);
        let meeting = |when| Meeting::of(plane.as_ref()?, [&one, &two], when);
        let (before, after) = (meeting(When::Before), meeting(When::After));
        let contact_impulse = plane.as_ref().zip(impulse).map(|(plane, impulse)| plane.to_contact(impulse));
        let offset = plane.as_ref().zip(one.center.zip(two.center)).map(|(plane, (one, two))| plane.to_contact(two - one));
        let touch = before.zip(after).map(|around| Touch::of(around, [one, two], contact_impulse, moment));
        let energy_loss = EnergyLoss::of(&one, &two);
        let travel = Travel::of(record, &one, &two);
        let beside = Sizes::default();
        Known { record, one, two, plane, moment, impulse, contact_impulse, offset, travel, before, after, touch, energy_loss, beside }
    }

    /// Returns what is known without the motions, or `None` without motions, without claims, or of a contact that lasts: there claims need not agree as those of an instant do.
    pub(super) fn without_motions(&self) -> Option<Self> {
        let has_claims = Key::ALL.into_iter().any(|key| key.is_claim() && self.record.get(key).is_some());
        let bodies = [&self.one, &self.two];
        let has_motions = bodies.iter().any(|body| !body.fixed && (body.before.is_some() || body.after.is_some()));
        if !has_claims || !has_motions || !self.travel.is_none() {
            return None;
        }
        let meetings = [self.before, self.after].into_iter().flatten();
        let speed = meetings.map(|meeting| super::normal::length(&meeting.velocity)).fold(0.0, f64::max);
        let beside = Sizes {
            speed,
            impulse: self.impulse_value().length(),
            energy: [When::Before, When::After].map(|when| self.least_energy(when).value).into_iter().fold(0.0, f64::max),
        };
        Some(Known {
            one: self.one.without_motions(),
            two: self.two.without_motions(),
            impulse: None,
            contact_impulse: None,
            before: None,
            after: None,
            touch: None,
            energy_loss: None,
            beside,
            ..*self
        })
    }

    /// Returns a number of the record with its resolution.
    pub(super) fn number(&self, key: Key) -> Option<Uncertain<N>> {
        number(self.record, key)
    }

    pub(super) fn subject(&self, side: Side) -> &Subject<N> {
        match side {
            Side::One => &self.one,
            Side::Two => &self.two,
        }
    }

    /// Returns the kinetic energy that both bodies have at least: that of the translations and spins that are known.
    pub(super) fn least_energy(&self, when: When) -> Uncertain<N> {
        let parts = [&self.one, &self.two].map(|subject| [subject.kinetic_energy(when, Xy::zero(), false), subject.spin_energy(when)]);
        parts.into_iter().flatten().flatten().fold(Uncertain::exact(0.0), |sum, part| sum + part)
    }

    /// Returns `true` if a wall moves: it does work on the other body, as seen from the ground.
    pub(super) fn wall_moves(&self) -> bool {
        let moves = |wall: &Subject<N>| wall.fixed && wall.before.is_some_and(|v| !v.x.is_zero() || !v.y.is_zero());
        moves(&self.one) || moves(&self.two)
    }

    /// Returns the impulse on body 1 without its resolution, zero if it is unknown.
    pub(super) fn impulse_value(&self) -> Xy {
        self.impulse.map_or(Xy::zero(), |impulse| impulse.map(|p| p.value))
    }

    /// Returns the closing speed that is reported, or that of the motions before.
    pub(super) fn closing_speed(&self) -> Option<Uncertain<N>> {
        self.number(Key::ClosingSpeed).or(self.before.map(|meeting| meeting.velocity.n.magnitude()))
    }

    /// Returns the separation speed that is reported, or that of the motions after.
    pub(super) fn separation_speed(&self) -> Option<Uncertain<N>> {
        self.number(Key::SeparationSpeed).or(self.after.map(|meeting| meeting.velocity.n.magnitude()))
    }

    /// Returns the kinetic energy of both bodies, with their spins.
    pub(super) fn kinetic_energy(&self, when: When) -> Option<Uncertain<N>> {
        if let Some(fall) = self.energy_loss.filter(|fall| !fall.translation_only) {
            return Some(match when {
                When::Before => fall.before,
                When::After => fall.after,
            });
        }
        let of = |subject: &Subject<N>| subject.kinetic_energy(when, Xy::zero(), true);
        Some(of(&self.one)? + of(&self.two)?)
    }

    /// Returns the most precise energy loss: from the kinetic energies, or from the works.
    pub(super) fn loss(&self) -> Option<Uncertain<N>> {
        let falls = self.energy_loss.filter(|fall| !fall.translation_only).map(|fall| fall.sharpest());
        // Those of an instant say less of a contact that lasts.
        let works = self.touch.filter(|_| falls.is_none() || self.travel.is_none()).and_then(|touch| touch.work).map(|work| work.loss());
        sharper_known(falls, works, Uncertain::radius)
    }
}

impl<const N: usize> Touch<N> {
    fn of(
        (before, after): (Meeting<N>, Meeting<N>),
        subjects: [Subject<N>; 2],
        impulse: Option<Nt<Uncertain<N>>>,
        moment: Option<Uncertain<N>>,
    ) -> Self {
        let (approach, separation) = (before.velocity, after.velocity);
        let relative_yaw_rate = |meeting: &Meeting<N>| meeting.bodies[1].yaw_rate - meeting.bodies[0].yaw_rate;
        let of_moment = moment.map_or(Uncertain::exact(0.0), |m| work(m, relative_yaw_rate(&before), relative_yaw_rate(&after)));
        Touch {
            approach,
            separation,
            impulse,
            work: impulse.map(|impulse| Work { m: of_moment, ..Work::of(impulse, approach, separation) }),
            moment,
            bodies: before.bodies,
            subjects,
        }
    }

    /// Returns the impulse that ends sliding under a law, with restitution e and the moment impulse, if the inertia of the bodies is known.
    pub(super) fn sticking(&self, law: Law, e: Uncertain<N>) -> Option<Nt<Uncertain<N>>> {
        let contact = contact(&self.bodies, &self.subjects)?;
        Some(contact.compliance.impulse_for(change_by_impulse(&contact, law.change(self.approach, e), self.moment)))
    }

    /// Returns K_nn + μ K_nt at the ratio of the impulse, as a share of its parts: where it is small the pair nearly wedges.
    pub(super) fn wedging_share(&self) -> Option<f64> {
        let (impulse, contact) = (self.impulse?, self.values()?);
        Some(contact.compliance.wedging_share(impulse.t.value / impulse.n.value))
    }

    /// Returns the contact without resolutions, if the inertia of the bodies is known.
    pub(super) fn values(&self) -> Option<Contact> {
        values(&self.bodies, &self.subjects)
    }
}

/// Returns the contact of bodies before the impact without resolutions, if their inertia is known.
pub(super) fn values<const N: usize>(bodies: &[Body<Uncertain<N>>; 2], subjects: &[Subject<N>; 2]) -> Option<Contact> {
    let values = |i: usize| {
        let body = bodies[i].map(|x| x.value);
        let (inverse_mass, inverse_yaw_inertia) = subjects[i].yields()?;
        Some(Body { inverse_mass, inverse_yaw_inertia, ..body })
    };
    Some(Contact::between(values(0)?, values(1)?))
}

/// Returns the contact of bodies before the impact, if their inertia is known.
pub(super) fn contact<const N: usize>(bodies: &[Body<Uncertain<N>>; 2], [one, two]: &[Subject<N>; 2]) -> Option<Contact<Uncertain<N>>> {
    Some(Contact::between(one.with_inertia(bodies[0])?, two.with_inertia(bodies[1])?))
}

/// Returns the part of a change of relative velocity that is left to the impulse beside a moment.
pub(super) fn change_by_impulse<const N: usize>(
    contact: &Contact<Uncertain<N>>,
    change: Nt<Uncertain<N>>,
    moment: Option<Uncertain<N>>,
) -> Nt<Uncertain<N>> {
    moment.map_or(change, |moment| change - contact.moment_compliance().force * moment)
}

/// Returns the cosine and sine of an angle with a resolution. The magnitude of either second derivative is at most 1.
pub(super) fn turned<const N: usize>(angle: Uncertain<N>) -> CrushPlane<Uncertain<N>> {
    let exact = CrushPlane::from_angle(angle.value);
    CrushPlane { cos: angle.through(exact.cos, -exact.sin, 1.0), sin: angle.through(exact.sin, exact.cos, 1.0) }
}
