//! What a record implies beside what it has: an impulse, or the model with the motions before, leads from the motions on one side of the impact to those on the other, and
//! a body that gains a velocity or a yaw rate by an impulse has the mass or the yaw inertia for it. What is reported is held against these as against numbers that are given.

use super::claims::{self, norm};
use super::format::Digits;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::{Known, change_by_impulse, contact, values};
use super::model::RatioKind;
use super::momentum::{length, number_of};
use super::rule::Rule;
use super::subject::Subject;
use super::uncertain::Uncertain;
use super::{claim_consistency, claimed_impulse, momentum, normal, tangent, work};
use crate::frame::{CrushPlane, Nt, Xy};
use crate::input::Side;
use crate::law::{impulse_at_fraction, impulse_at_ratio};
use alloc::format;

/// What the impulse on body 1 is taken from.
#[derive(Clone, Copy, PartialEq)]
enum Source {
    OneBody,
    Claims,
    Model,
}

impl Source {
    const ALL: [Source; 3] = [Source::OneBody, Source::Model, Source::Claims];

    fn words(self) -> &'static str {
        match self {
            Source::OneBody => "the impulse that one body receives",
            Source::Claims => "the impulse that is reported",
            Source::Model => "the model",
        }
    }

    fn impulse<const N: usize>(self, known: &Known<'_, N>, judge: &Judge) -> Option<Xy<Uncertain<N>>> {
        match self {
            Source::OneBody => known.impulse,
            Source::Claims if known.impulse.is_none() => claimed_impulse::determined(known, judge),
            Source::Claims => None,
            Source::Model => of_model(known, judge),
        }
    }
}

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    // Of a contact that lasts the impulse has no one place.
    if !known.travel.is_none() {
        return;
    }
    for source in Source::ALL {
        if judge.has_failed() {
            return;
        }
        let Some(impulse) = source.impulse(known, judge) else { continue };
        let bodies = Side::ALL.map(|side| moved(known, side, impulse));
        let plane = known.plane.or_else(|| plane_for(known, impulse));
        let has_more = bodies.iter().zip([&known.one, &known.two]).any(|(implied, body)| has_more(implied, body))
            || plane.is_some() != known.plane.is_some();
        let mut alone = judge.of_implied();
        Side::ALL.into_iter().for_each(|side| along_impulse(known, side, impulse, &mut alone));
        if has_more || source == Source::Claims {
            hold(source, &Known::of_bodies(known.record, bodies, plane, Some(impulse)), impulse, &mut alone);
        }
        judge.take_failures_of_implied(alone, source.words());
    }
}

/// Holds what is reported against the motions that an impulse leads to, and these against the laws.
fn hold<const N: usize>(source: Source, implied: &Known<'_, N>, impulse: Xy<Uncertain<N>>, judge: &mut Judge) {
    if let Some(share) = implied.touch.and_then(|touch| touch.wedging_share()) {
        judge.allow_for_wedging(share);
    }
    claims::check(implied, judge);
    claim_consistency::check(implied, judge);
    // Those of the model agree with the spins that are given, or do not; and a model may be one that no impact has.
    momentum::check(implied, judge);
    normal::check(implied, judge);
    tangent::check(implied, judge);
    work::check(implied, judge);
    if source != Source::Model {
        Side::ALL.into_iter().for_each(|side| spin_alone(implied, side, impulse, judge));
    }
}

fn has_more<const N: usize>(implied: &Subject<N>, body: &Subject<N>) -> bool {
    let motions = |body: &Subject<N>| [body.before.is_some(), body.after.is_some(), body.yaw_before.is_some(), body.yaw_after.is_some()];
    let inertia = |body: &Subject<N>| [body.mass.is_some(), body.yaw_inertia.is_some()];
    (motions(implied), inertia(implied)) != (motions(body), inertia(body))
}

/// Returns a body with the motions that an impulse on body 1 leads to, or comes from, and with the mass and the yaw inertia that give it those which are known.
fn moved<const N: usize>(known: &Known<'_, N>, side: Side, on_one: Xy<Uncertain<N>>) -> Subject<N> {
    let body = *known.subject(side);
    if body.fixed {
        return body;
    }
    let impulse = on_body(side, on_one);
    let spin = spin(known, side, on_one);
    let mass = body.mass.or_else(|| mass_for(impulse, body.delta_v()?));
    let yaw_inertia = body.yaw_inertia.or_else(|| inertia_for(spin?, body.yaw_after? - body.yaw_before?));
    let gained = mass.map(|mass| impulse.map(|p| p / mass));
    let spun = spin.zip(yaw_inertia).map(|(spin, inertia)| spin / inertia);
    Subject {
        mass,
        yaw_inertia,
        before: body.before.or_else(|| Some(body.after? - gained?)),
        after: body.after.or_else(|| Some(body.before? + gained?)),
        yaw_before: body.yaw_before.or_else(|| Some(body.yaw_after? - spun?)),
        yaw_after: body.yaw_after.or_else(|| Some(body.yaw_before? + spun?)),
        ..body
    }
}

fn on_body<const N: usize>(side: Side, on_one: Xy<Uncertain<N>>) -> Xy<Uncertain<N>> {
    if side == Side::One { on_one } else { -on_one }
}

/// Returns `true` if a number is not what is left of terms that almost cancel, which dividing by it would enlarge with their errors.
fn is_clear<const N: usize>(number: &Uncertain<N>) -> bool {
    /// Share of the sum of the magnitudes of its terms.
    const SHARE: f64 = 0.1;
    number.value.abs() > SHARE * number.size && number.value.abs() > number.radius()
}

/// Returns the crush plane in which an impulse has its reported components.
fn plane_for<const N: usize>(known: &Known<'_, N>, impulse: Xy<Uncertain<N>>) -> Option<CrushPlane<Uncertain<N>>> {
    let (n, t) = (known.number(Key::NormalImpulse)?, known.number(Key::TangentialImpulse)?);
    let lengths = norm(impulse) * norm(Xy { x: n, y: t });
    let is_known = [impulse.x, impulse.y, n, t].iter().all(|part| part.value == 0.0 || is_clear(part)) && is_clear(&lengths);
    is_known.then(|| CrushPlane { cos: (n * impulse.x + t * impulse.y) / lengths, sin: (n * impulse.y - t * impulse.x) / lengths })
}

/// Returns the mass that gains a velocity by an impulse, P · ΔV / ΔV², if it gains one toward it.
fn mass_for<const N: usize>(impulse: Xy<Uncertain<N>>, delta_v: Xy<Uncertain<N>>) -> Option<Uncertain<N>> {
    let (passed, squared) = (impulse.x * delta_v.x + impulse.y * delta_v.y, delta_v.length_squared());
    (is_clear(&passed) && is_clear(&squared) && passed.value > 0.0).then(|| passed / squared)
}

/// Returns the yaw inertia that gains a yaw rate by a spin, if it gains one of the same sign.
fn inertia_for<const N: usize>(spin: Uncertain<N>, gained: Uncertain<N>) -> Option<Uncertain<N>> {
    (is_clear(&spin) && is_clear(&gained) && spin.value * gained.value > 0.0).then(|| spin / gained)
}

/// Checks that a body whose mass is unknown gains a velocity along its impulse, and one whose yaw inertia is unknown a yaw rate of the sign of its spin.
fn along_impulse<const N: usize>(known: &Known<'_, N>, side: Side, on_one: Xy<Uncertain<N>>, judge: &mut Judge) {
    let (body, impulse, number) = (known.subject(side), on_body(side, on_one), number_of(side));
    if body.fixed {
        return;
    }
    if let (None, Some(delta_v)) = (body.mass, body.delta_v()) {
        let (speed, scale) = (norm(delta_v), length(&impulse));
        let unit = speed.value;
        if unit > 0.0 && judge.sign(Rule::LinearMomentum, &Residual::new(speed, speed.size)).is_some() {
            let across = delta_v.map(|v| v.scaled(1.0 / unit)).cross(impulse);
            judge.zero(Rule::LinearMomentum, Residual::new(across, scale), |size, bound| {
                let (size, bound) = (Digits(size), Digits(bound));
                format!("the change of velocity of body {number} is not along its impulse: {size} N s are across it, {bound} may be")
            });
            let along = (impulse.x * delta_v.x + impulse.y * delta_v.y).scaled(1.0 / unit);
            judge.not_above(Rule::LinearMomentum, Residual::new(-along, scale), |size, bound| {
                let (size, bound) = (Digits(size), Digits(bound));
                format!("the velocity of body {number} changes against its impulse, of which {size} N s point the other way, {bound} may")
            });
        }
    }
    if let (None, Some(spin), Some((before, after))) = (body.yaw_inertia, spin(known, side, on_one), body.yaw_before.zip(body.yaw_after)) {
        let Some(sign) = judge.sign(Rule::LineOfAction, &Residual::new(after - before, (after - before).size)) else { return };
        let scale = spin.size.max(body.arm.map_or(0.0, |arm| length(&arm) * length(&on_one)));
        judge.not_above(Rule::LineOfAction, Residual::new(spin.scaled(-sign), scale), |size, bound| {
            let (size, bound) = (Digits(size), Digits(bound));
            format!("the yaw rate of body {number} changes against the spin that its impulse gives, {size} N m s, {bound} may be")
        });
    }
}

/// Returns the spin that a body gains by an impulse on body 1 at the contact point and by the moment.
fn spin<const N: usize>(known: &Known<'_, N>, side: Side, on_one: Xy<Uncertain<N>>) -> Option<Uncertain<N>> {
    let of_impulse = known.subject(side).arm?.cross(on_one);
    let on_one = known.moment.map_or(of_impulse, |moment| of_impulse + moment);
    Some(if side == Side::One { on_one } else { -on_one })
}

/// Checks the spin that a body gains of which no velocity is known.
fn spin_alone<const N: usize>(implied: &Known<'_, N>, side: Side, on_one: Xy<Uncertain<N>>, judge: &mut Judge) {
    let body = implied.subject(side);
    let known = body.spin_gained().zip(spin(implied, side, on_one)).zip(body.arm);
    let Some(((gained, given), arm)) = known.filter(|_| !body.fixed && body.momentum_gained().is_none()) else { return };
    let scale = gained.value.abs().max(length(&arm) * length(&on_one));
    judge.zero(Rule::LineOfAction, Residual::new(gained - given, scale), |size, bound| {
        let (gained, given, size, bound) = (Digits(gained.value), Digits(given.value), Digits(size), Digits(bound));
        format!(
            "body {} gains a spin of {gained} N m s, and its impulse gives {given} N m s: {size} N m s off, {bound} may be",
            number_of(side)
        )
    });
}

/// Returns the impulse on body 1 of the model, with the motions before, if they determine it.
fn of_model<const N: usize>(known: &Known<'_, N>, judge: &Judge) -> Option<Xy<Uncertain<N>>> {
    /// Share of K_nn + μ K_nt in its parts below which a pair nearly wedges, and rounding decides.
    const WEDGES: f64 = 0.05;
    const PULLS: f64 = 0.01;
    let (meeting, plane, model) = (known.before?, known.plane.as_ref()?, &known.record.model);
    if known.after.is_some() {
        return None;
    }
    let subjects = [known.one, known.two];
    let contact = contact(&meeting.bodies, &subjects)?;
    let change = change_by_impulse(&contact, model.law.change(meeting.velocity, known.number(Key::Restitution)?), known.moment);
    let number = || known.number(Key::ImpulseRatio);
    let impulse = match model.ratio_kind {
        RatioKind::Critical => contact.compliance.impulse_for(change),
        RatioKind::Given => impulse_at_ratio(&contact.compliance, change.n, number()?),
        RatioKind::OfCritical => impulse_at_fraction(&contact.compliance, change, number()?),
        RatioKind::Friction => {
            let (friction, sticking) = (number()?, contact.compliance.impulse_for(change));
            let unit = if change.n.value < 0.0 { -1.0 } else { 1.0 };
            let Nt { n, t } = sticking.map(|p| p.scaled(unit));
            let beyond = Residual::new(t.magnitude() - friction * n, n.value.abs().max(t.value.abs()));
            // Near the edge of the cone either may be.
            if judge.sign(Rule::ImpulseRatio, &beyond)? > 0.0 {
                impulse_at_ratio(&contact.compliance, change.n, if t.value < 0.0 { -friction } else { friction })
            } else {
                sticking
            }
        }
    };
    let ratio = impulse.t.value / impulse.n.value;
    let share = values(&meeting.bodies, &subjects)?.compliance.wedging_share(ratio);
    // Of an impulse that pulls the sum is negative, and the law that it breaks is clear.
    (share.is_finite() && !(-PULLS..=WEDGES).contains(&share)).then(|| plane.to_ground(impulse))
}
