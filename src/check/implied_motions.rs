//! Motions that a record implies: an impulse, or the model with the motions before, leads from the motions on one side of the impact to those on the other. What is
//! reported is held against them as against motions that are given.

use super::format::Digits;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::{Known, change_by_impulse, contact, values};
use super::model::RatioKind;
use super::momentum::{length, number_of};
use super::rule::Rule;
use super::subject::Subject;
use super::uncertain::Uncertain;
use super::{claim_consistency, claimed_impulse, claims, momentum, normal, tangent, work};
use crate::frame::{Nt, Xy};
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
        let moves = bodies.iter().zip([&known.one, &known.two]).any(|(implied, body)| has_more(implied, body));
        if moves || source == Source::Claims {
            let mut alone = judge.of_implied();
            hold(source, &Known::of_bodies(known.record, bodies, Some(impulse)), impulse, &mut alone);
            judge.take_failures_of_implied(alone, source.words());
        }
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
    let known = |body: &Subject<N>| [body.before.is_some(), body.after.is_some(), body.yaw_before.is_some(), body.yaw_after.is_some()];
    known(implied) != known(body)
}

/// Returns a body with the motions that an impulse on body 1 leads to, or comes from.
fn moved<const N: usize>(known: &Known<'_, N>, side: Side, on_one: Xy<Uncertain<N>>) -> Subject<N> {
    let body = *known.subject(side);
    if body.fixed {
        return body;
    }
    let impulse = if side == Side::One { on_one } else { -on_one };
    let gained = body.mass.map(|mass| impulse.map(|p| p / mass));
    let spun = spin(known, side, on_one).zip(body.yaw_inertia).map(|(spin, inertia)| spin / inertia);
    Subject {
        before: body.before.or_else(|| Some(body.after? - gained?)),
        after: body.after.or_else(|| Some(body.before? + gained?)),
        yaw_before: body.yaw_before.or_else(|| Some(body.yaw_after? - spun?)),
        yaw_after: body.yaw_after.or_else(|| Some(body.yaw_before? + spun?)),
        ..body
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
