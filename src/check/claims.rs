//! Consistency of reported results with what the motions imply: the first half of `reported`.

use super::claimed_energies::{available, rounding_of_energy};
use super::format::Digits;
use super::judge::{Judge, Residual, SPEED};
use super::key::Key;
use super::known::{Known, Touch};
use super::momentum::number_of;
use super::normal;
use super::rule::Rule;
use super::subject::When;
use super::uncertain::Uncertain;
use super::work::scale_of;
use crate::frame::{Heading, Nt, Xy};
use crate::impact::Response;
use crate::input::Side;
use crate::law::Law;
use crate::vehicle::Motion;
use alloc::format;
use alloc::string::String;
use core::f64::consts::TAU;

/// A reported number and the one that the motions imply.
struct Claim<const N: usize> {
    key: Key,
    implied: Uncertain<N>,
    /// The magnitude of the number, which an arbitrary error would have.
    scale: f64,
}

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let claim = |key, implied, scale| Claim { key, implied, scale };
    let energies =
        [(Key::EnergyBefore, When::Before), (Key::EnergyAfter, When::After)].map(|(key, when)| (key, known.kinetic_energy(when)));
    let (most, rounded) = (available(known), rounding_of_energy(known));
    for (key, energy) in energies {
        if let Some(energy) = energy {
            hold_beside(known, judge, claim(key, energy, most), rounded);
        }
    }
    energy_loss(known, judge);
    for side in [Side::One, Side::Two] {
        of_body(known, side, judge);
    }
    if let Some(p) = known.impulse {
        let magnitude = norm(p);
        for (key, implied) in [(Key::ImpulseX, p.x), (Key::ImpulseY, p.y), (Key::ImpulseMagnitude, magnitude)] {
            hold(known, judge, claim(key, implied, magnitude.value));
        }
    }
    let speed = known.before.or(known.after).map_or(0.0, |meeting| normal::length(&meeting.velocity));
    // Without the motions before, speeds after the impact may be the rounding of those.
    let rounded = if known.before.is_none() { SPEED } else { 0.0 };
    for (key, meeting, leeway) in
        [(Key::ClosingSpeed, known.before, 0.0), (Key::SeparationSpeed, known.after, known.travel.velocity_leeway())]
    {
        if let Some(meeting) = meeting {
            let claim = claim(key, meeting.velocity.n.magnitude(), speed);
            hold_as(known, judge, claim, |residual| residual.beside(rounded).open(0.0, leeway));
        }
    }
    if let Some(p) = known.contact_impulse {
        let scale = normal::length(&p);
        hold(known, judge, claim(Key::NormalImpulse, p.n, scale));
        hold(known, judge, claim(Key::TangentialImpulse, p.t, scale));
        // Multiplied out to avoid a division; the message has the ratios again.
        if let Some(said) = known.number(Key::ReportedRatio) {
            ratio(judge, Key::ReportedRatio, said, [p.n, p.t]);
        }
    }
    if let Some(touch) = &known.touch {
        at_contact(known, touch, judge);
    }
}

fn energy_loss<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let Some(implied) = known.loss() else { return };
    let scale = known.touch.as_ref().and_then(scale_of).or(known.energy_loss.map(|fall| fall.available)).unwrap_or(0.0);
    // The works alone are those of an instant.
    let is_of_works = known.energy_loss.is_none_or(|fall| fall.translation_only);
    let impulse = known.impulse_value();
    let (slack, leeway) = if is_of_works { (known.travel.work_slack(impulse), known.travel.work_leeway(impulse)) } else { (0.0, 0.0) };
    hold_as(known, judge, Claim { key: Key::EnergyLoss, implied, scale }, |residual| residual.open(slack, leeway));
}

fn of_body<const N: usize>(known: &Known<'_, N>, side: Side, judge: &mut Judge) {
    let subject = known.subject(side);
    let Some(delta_v) = subject.delta_v() else {
        // By the impulse that the other body tells.
        let claimed = known.number(Key::DeltaV(side)).zip(subject.mass);
        if let (Some((said, mass)), Some(impulse)) = (claimed, known.impulse.map(norm)) {
            let passed = said * mass;
            let residual = Residual::new(passed - impulse, impulse.value.max(passed.value.abs())).per(mass.value);
            judge
                .zero(Rule::Reported, residual, |size, bound| told(Key::DeltaV(side), said.value, impulse.value / mass.value, size, bound));
        }
        return;
    };
    // Of the order of the larger one: that of a heavy body may be almost zero, and that of a fixed body is zero.
    let both = [known.one.delta_v(), known.two.delta_v()].into_iter().flatten();
    let scale = both.fold(0.0, |scale: f64, delta_v| scale.max(norm(delta_v).value));
    hold_beside(known, judge, Claim { key: Key::DeltaV(side), implied: norm(delta_v), scale }, if scale == 0.0 { SPEED } else { 0.0 });
    if let Some(claimed) = known.number(Key::ForceDirection(side)) {
        direction_of_force(known, side, ("its change of velocity", delta_v), claimed, judge);
    }
}

fn at_contact<const N: usize>(known: &Known<'_, N>, touch: &Touch<N>, judge: &mut Judge) {
    let Some((work, scale)) = touch.work.zip(scale_of(touch)) else { return };
    // Each component of the impulse does its work between the arms.
    let mut of_component = |key, implied, component: Nt<Uncertain<N>>| {
        let impulse = known.plane.map_or(Xy::zero(), |plane| plane.to_ground(component).map(|p| p.value));
        let (slack, leeway) = (known.travel.work_slack(impulse), known.travel.work_leeway(impulse));
        hold_as(known, judge, Claim { key, implied, scale }, |residual| residual.open(slack, leeway));
    };
    let (nothing, p) = (Uncertain::exact(0.0), known.contact_impulse);
    let component = |of: fn(Nt<Uncertain<N>>) -> Uncertain<N>| p.map_or(nothing, of);
    of_component(Key::NormalWork, work.n, Nt { n: component(|p| p.n), t: nothing });
    of_component(Key::TangentialWork, work.t, Nt { n: nothing, t: component(|p| p.t) });
    hold(known, judge, Claim { key: Key::MomentWork, implied: work.m, scale });
    // μ₀ is a property of the contact, whichever law is in force.
    let e = || known.number(Key::Restitution).unwrap_or(-touch.separation.n / touch.approach.n);
    if let Some(said) = known.number(Key::CriticalRatio)
        && let Some(sticking) = touch.sticking(Law::Brach, e())
    {
        ratio(judge, Key::CriticalRatio, said, [sticking.n, sticking.t]);
    }
}

fn ratio<const N: usize>(judge: &mut Judge, key: Key, said: Uncertain<N>, [n, t]: [Uncertain<N>; 2]) {
    let scale = n.value.abs().max(t.value.abs()).max((said.value * n.value).abs());
    let residual = Residual::new(t - said * n, scale);
    if judge.sign(Rule::Reported, &Residual::new(n, n.value.abs().max(t.value.abs()))).is_none() {
        return;
    }
    judge.zero(Rule::Reported, residual.per(n.value.abs()), |size, bound| told(key, said.value, t.value / n.value, size, bound));
}

fn told(key: Key, said: f64, implied: f64, size: f64, bound: f64) -> String {
    let (said, implied, size, bound) = (Digits(said), Digits(implied), Digits(size), Digits(bound));
    let unit = key.measure().si_unit();
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{key} is said to be {said}{unit}, and the motions give {implied}{unit}: {size} off, {bound} may be")
}

fn hold<const N: usize>(known: &Known<'_, N>, judge: &mut Judge, claim: Claim<N>) {
    hold_as(known, judge, claim, |residual| residual);
}

/// Compares a claim with what the motions imply, beside a size whose rounding it may be.
fn hold_beside<const N: usize>(known: &Known<'_, N>, judge: &mut Judge, claim: Claim<N>, rounded: f64) {
    hold_as(known, judge, claim, |residual| residual.beside(rounded));
}

/// Compares a claim with what the motions imply, with what else their difference is allowed.
fn hold_as<const N: usize>(known: &Known<'_, N>, judge: &mut Judge, claim: Claim<N>, allow: impl FnOnce(Residual<N>) -> Residual<N>) {
    let Some(said) = known.number(claim.key) else { return };
    judge.zero(Rule::Reported, allow(Residual::new(said - claim.implied, claim.scale)), |size, bound| {
        told(claim.key, said.value, claim.implied.value, size, bound)
    });
}

/// Returns the length of a vector: its component along itself, and the second-order contribution of the perpendicular component.
pub(super) fn norm<const N: usize>(v: Xy<Uncertain<N>>) -> Uncertain<N> {
    let length = Xy { x: v.x.value, y: v.y.value }.length();
    if length == 0.0 {
        let rest = v.x.radius() + v.y.radius();
        return Uncertain { value: 0.0, size: v.x.size + v.y.size, spread: [0.0; N], rest };
    }
    let (mut along, across) = along_and_across(v, length);
    let (a, b) = (along.radius(), across.radius());
    along.rest += if a < length { 0.5 * b * b / (length - a) } else { 2.0 * a + b };
    // Of a difference that cancels, the rounding across may be more than the length itself.
    along.size = along.size.max(across.size);
    along
}

/// Returns the components of a vector along its value and a quarter turn from it.
fn along_and_across<const N: usize>(v: Xy<Uncertain<N>>, length: f64) -> (Uncertain<N>, Uncertain<N>) {
    let (cos, sin) = (v.x.value / length, v.y.value / length);
    (v.x.scaled(cos) + v.y.scaled(sin), v.y.scaled(cos) - v.x.scaled(sin))
}

/// Checks the direction of force of a body by a vector along the force, and what that is.
pub(super) fn direction_of_force<const N: usize>(
    known: &Known<'_, N>,
    side: Side,
    (what, delta_v): (&str, Xy<Uncertain<N>>),
    claimed: Uncertain<N>,
    judge: &mut Judge,
) {
    let subject = known.record.subject(side);
    let values = Xy { x: delta_v.x.value, y: delta_v.y.value };
    let length = values.length();
    // A fixed body has the direction zero and nothing to compare it with.
    let Some((angle, heading)) = subject.heading.zip(known.number(Key::Heading(side))).filter(|_| length > 0.0 && !subject.fixed) else {
        return;
    };
    let in_vehicle = Heading::from_angle(angle).to_vehicle(values);
    let response = Response { after: Motion::rest(), delta_v: values, delta_v_in_vehicle: in_vehicle };
    let implied = response.principal_direction_of_force();
    let turns = libm::rint((claimed.value - implied) / TAU);
    let (along, across) = along_and_across(delta_v, length);
    let (a, b) = (along.radius() / length, across.radius() / length);
    // The direction is `heading − angle of ΔV + π`; the angle of ΔV changes with the perpendicular component.
    let mut off = claimed - heading + across.scaled(1.0 / length);
    off.value = claimed.value - implied - turns * TAU;
    off.rest += if a < 1.0 { a * b / (1.0 - a) + b * b * b } else { f64::INFINITY };
    judge.zero(Rule::Reported, Residual::new(off, 1.0), |size, bound| {
        let (said, implied) = (Digits(claimed.value), Digits(implied));
        let body = number_of(side);
        format!(
            "the force on body {body} is said to come from {said} rad clockwise of its heading, and {what} gives {implied} rad: {} \
             off, {} may be",
            Digits(size),
            Digits(bound)
        )
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_of_a_length_holds_and_is_sharp() {
        for (x, y, dx, dy) in [(3.0, 4.0, 0.1, 0.2), (3.0, 0.0, 0.1, 0.2), (1.0, 1.0, 0.5, 0.9), (0.0, 0.0, 0.1, 0.1)] {
            let v = Xy { x: Uncertain::<2>::input(x, 0, dx), y: Uncertain::input(y, 1, dy) };
            let length = norm(v);
            let mut farthest = 0.0_f64;
            for (i, j) in (-10..=10).flat_map(|i| (-10..=10).map(move |j| (f64::from(i) / 10.0, f64::from(j) / 10.0))) {
                farthest = farthest.max((Xy { x: x + i * dx, y: y + j * dy }.length() - length.value).abs());
            }
            assert!(farthest <= length.radius() * (1.0 + 1e-12), "{x} {y}: {farthest} beyond {}", length.radius());
            assert!(dx > 0.3 || length.radius() < 1.5 * farthest, "{x} {y}: {farthest} far within {}", length.radius());
        }
    }

    /// Of a length that may vanish: along itself, twice that more, and across.
    #[test]
    fn the_bound_of_a_length_that_may_vanish() {
        let length = norm(Xy { x: Uncertain::<2>::input(0.1, 0, 0.4), y: Uncertain::input(0.0, 1, 0.3) });
        assert!((length.radius() - (0.4 + 2.0 * 0.4 + 0.3)).abs() < 1e-15, "{}", length.radius());
    }

    #[test]
    fn a_length_is_rounded_as_what_cancels_across_it() {
        // 1e-17 along x; along y two speeds of 3 km/s cancel, whose rounding hides as much.
        let speed = Uncertain::<2>::exact(3000.0);
        let v = Xy { x: Uncertain::exact(1e-17), y: speed - speed };
        assert_eq!((norm(v).value, norm(v).size), (1e-17, 6000.0));
    }
}
