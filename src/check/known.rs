//! What a record lets one compute: each quantity whose parts are known, by the crate's own mechanics on numbers with a resolution.

use super::fall::Fall;
use super::key::Key;
use super::record::Record;
use super::subject::{Subject, When, number, pair};
use super::uncertain::Uncertain;
use crate::body::Body;
use crate::compliance::Compliance;
use crate::contact::{Contact, relative_velocity};
use crate::energy::Work;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::input::Side;

/// What is known of a record.
pub(super) struct Known<'a, const N: usize> {
    pub(super) record: &'a Record,
    pub(super) one: Subject<N>,
    pub(super) two: Subject<N>,
    pub(super) plane: Option<CrushPlane<Uncertain<N>>>,
    /// The impulse on body 1 in ground axes, from the body that tells it more exactly.
    pub(super) impulse: Option<Xy<Uncertain<N>>>,
    /// What takes the contact and the motions around it.
    pub(super) touch: Option<Touch<N>>,
    /// What takes masses and motions.
    pub(super) fall: Option<Fall<N>>,
}

/// The impact at the contact point.
#[derive(Clone, Copy)]
pub(super) struct Touch<const N: usize> {
    /// Relative velocity before, of body 2 less body 1.
    pub(super) approach: Nt<Uncertain<N>>,
    /// Relative velocity after.
    pub(super) separation: Nt<Uncertain<N>>,
    /// From center of mass 1 to center of mass 2; a fixed body's reference point is the contact point.
    pub(super) offset: Nt<Uncertain<N>>,
    /// On body 1.
    pub(super) impulse: Option<Nt<Uncertain<N>>>,
    pub(super) work: Option<Work<Uncertain<N>>>,
    /// The bodies before, without their inertia.
    bodies: [Body<Uncertain<N>>; 2],
    subjects: [Subject<N>; 2],
}

/// The one of two that is known more exactly.
pub(super) fn sharper<T>(a: T, b: T, radius: impl Fn(&T) -> f64) -> T {
    if radius(&b) < radius(&a) { b } else { a }
}

/// The same, where one or both may be missing.
pub(super) fn sharper_known<T>(a: Option<T>, b: Option<T>, radius: impl Fn(&T) -> f64) -> Option<T> {
    match (a, b) {
        (Some(a), Some(b)) => Some(sharper(a, b, radius)),
        (a, b) => a.or(b),
    }
}

impl<'a, const N: usize> Known<'a, N> {
    pub(super) fn of(record: &'a Record) -> Self {
        let point = pair(record, Key::PointX, Key::PointY);
        let (one, two) = (Subject::of(record, Side::One, point), Subject::of(record, Side::Two, point));
        let plane = number(record, Key::NormalAngle).map(turned);
        let on_two = two.momentum_gained().map(|gained| -gained);
        let impulse = sharper_known(one.momentum_gained(), on_two, |p: &Xy<Uncertain<N>>| p.x.radius() + p.y.radius());
        let touch = plane.as_ref().and_then(|plane| Touch::of(plane, &one, &two, impulse));
        let fall = Fall::of(&one, &two);
        Known { record, one, two, plane, impulse, touch, fall }
    }

    /// A number of the record with its resolution.
    pub(super) fn number(&self, key: Key) -> Option<Uncertain<N>> {
        number(self.record, key)
    }

    pub(super) fn subject(&self, side: Side) -> &Subject<N> {
        match side {
            Side::One => &self.one,
            Side::Two => &self.two,
        }
    }

    /// The loss of energy as it is known best: the fall of the kinetic energy, or the works.
    pub(super) fn loss(&self) -> Option<Uncertain<N>> {
        let falls = self.fall.filter(|fall| !fall.translation_only).map(|fall| fall.sharpest());
        let works = self.touch.and_then(|touch| touch.work).map(|work| work.loss());
        sharper_known(falls, works, Uncertain::radius)
    }
}

impl<const N: usize> Touch<N> {
    fn of(plane: &CrushPlane<Uncertain<N>>, one: &Subject<N>, two: &Subject<N>, impulse: Option<Xy<Uncertain<N>>>) -> Option<Self> {
        let before = [one.body(plane, When::Before)?, two.body(plane, When::Before)?];
        let approach = relative_velocity(&before[0], &before[1]);
        let separation = relative_velocity(&one.body(plane, When::After)?, &two.body(plane, When::After)?);
        let impulse = impulse.map(|impulse| plane.to_contact(impulse));
        Some(Touch {
            approach,
            separation,
            offset: before[0].arm - before[1].arm,
            impulse,
            work: impulse.map(|impulse| Work::of(impulse, approach, separation)),
            bodies: before,
            subjects: [*one, *two],
        })
    }

    /// The compliance, if the inertia of the bodies is known.
    pub(super) fn compliance(&self) -> Option<Compliance<Uncertain<N>>> {
        let [one, two] = &self.subjects;
        Some(Compliance::between(&one.with_inertia(self.bodies[0])?, &two.with_inertia(self.bodies[1])?))
    }

    /// The contact without resolutions, if the inertia of the bodies is known.
    pub(super) fn values(&self) -> Option<Contact> {
        let values = |i: usize| {
            let body = self.bodies[i].map(|x| x.value);
            let (inverse_mass, inverse_yaw_inertia) = self.subjects[i].yields()?;
            Some(Body { inverse_mass, inverse_yaw_inertia, ..body })
        };
        Some(Contact::between(values(0)?, values(1)?))
    }
}

/// Cosine and sine of an angle with a resolution. The second derivative of either is within 1.
fn turned<const N: usize>(angle: Uncertain<N>) -> CrushPlane<Uncertain<N>> {
    let exact = CrushPlane::from_angle(angle.value);
    CrushPlane { cos: angle.through(exact.cos, -exact.sin, 1.0), sin: angle.through(exact.sin, exact.cos, 1.0) }
}
