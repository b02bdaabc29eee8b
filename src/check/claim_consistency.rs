//! Consistency of reported results with each other: the second half of `reported`. It needs no motions, and even with motions it may detect more, because a
//! sum of printed numbers is often more precise than the numbers it was computed from.

use super::claimed_energies;
use super::claims::{direction_of_force, norm};
use super::format::Digits;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::{Known, turned};
use super::rule::Rule;
use super::uncertain::{Uncertain, best_known, sharper_known};
use crate::frame::{Nt, Xy};
use crate::input::Side;
use alloc::format;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    signs(known, judge);
    claimed_energies::check(known, judge);
    impulses(known, judge);
    directions_of_force(known, judge);
}

/// Checks that speeds, lengths of vectors and energies of motion are not negative.
fn signs<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    use Key::{ClosingSpeed, DeltaV, EnergyAfter, EnergyBefore, EquivalentEnergySpeed, ImpulseMagnitude, SeparationSpeed};
    use Side::{One, Two};
    let of_bodies = [DeltaV(One), DeltaV(Two), EquivalentEnergySpeed(One), EquivalentEnergySpeed(Two)];
    for key in [ClosingSpeed, SeparationSpeed, ImpulseMagnitude, EnergyBefore, EnergyAfter].into_iter().chain(of_bodies) {
        let Some(claimed) = known.number(key).filter(|claimed| claimed.value < 0.0) else { continue };
        judge.not_above(Rule::Reported, Residual::new(-claimed, -claimed.value), |size, _| {
            format!("{key} is said to be {}, and is at least zero", Digits(-size))
        });
    }
}

fn impulses<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let number = |key| known.number(key);
    let nt = number(Key::NormalImpulse).zip(number(Key::TangentialImpulse)).map(|(n, t)| Nt { n, t });
    let xy = number(Key::ImpulseX).zip(number(Key::ImpulseY)).map(|(x, y)| Xy { x, y });
    let magnitude = number(Key::ImpulseMagnitude);
    let equal = |judge: &mut Judge, words: &str, a: Uncertain<N>, b: Uncertain<N>, scale: f64| {
        judge.zero(Rule::Reported, Residual::new(a - b, scale), |size, bound| {
            let (a, b, size, bound) = (Digits(a.value), Digits(b.value), Digits(size), Digits(bound));
            format!("{words} of what is reported are {a} N s and {b} N s: {size} off, {bound} may be")
        });
    };
    if let (Some(p), Some(ratio)) = (nt, number(Key::ReportedRatio)) {
        let scale = p.n.value.abs().max(p.t.value.abs());
        equal(judge, "the impulse along t and the impulse ratio times that along n", p.t, ratio * p.n, scale);
    }
    let of_nt = nt.map(|p| norm(Xy { x: p.n, y: p.t }));
    let of_xy = xy.map(norm);
    for (words, of) in [
        ("the impulse and the length of its components along n and t", of_nt),
        ("the impulse and the length of its components along x and y", of_xy),
    ] {
        if let (Some(magnitude), Some(of)) = (magnitude, of) {
            equal(judge, words, magnitude, of, magnitude.value.abs().max(of.value));
        }
    }
    if let (Some(nt), Some(xy), Some(plane)) = (nt, xy, &known.plane) {
        let turned = plane.to_contact(xy);
        let scale = norm(xy).value;
        equal(judge, "the impulse along n and its components along x and y", nt.n, turned.n, scale);
        equal(judge, "the impulse along t and its components along x and y", nt.t, turned.t, scale);
    }
    let impulse = sharper_known(sharper_known(magnitude, of_nt, Uncertain::radius), of_xy, Uncertain::radius);
    let passed = |side| Some(number(Key::DeltaV(side))? * known.subject(side).mass?);
    let (on_one, on_two) = (passed(Side::One), passed(Side::Two));
    if let (Some(a), Some(b)) = (on_one, on_two) {
        equal(judge, "mass times delta-V of body 1 and of body 2", a, b, a.value.abs().max(b.value.abs()));
    }
    let passed = best_known(on_one, on_two, Uncertain::radius, Uncertain::mean);
    if let (Some(impulse), Some(passed)) = (impulse, passed) {
        equal(judge, "the impulse and mass times delta-V", impulse, passed, impulse.value.abs().max(passed.value.abs()));
    }
    let Some(whole) = sharper_known(magnitude, passed, Uncertain::radius).or_else(|| known.impulse.map(norm)) else { return };
    // Those that the motions imply are held against them.
    let of_contact = [Key::NormalImpulse, Key::TangentialImpulse].into_iter().filter(|_| known.contact_impulse.is_none());
    for key in of_contact.chain([Key::ImpulseX, Key::ImpulseY].into_iter().filter(|_| known.impulse.is_none())) {
        let Some(part) = number(key) else { continue };
        judge.not_above(Rule::Reported, Residual::new(part.magnitude() - whole, whole.value.abs().max(part.value.abs())), |size, bound| {
            let (part, whole, size, bound) = (Digits(part.value), Digits(whole.value), Digits(size), Digits(bound));
            format!("{key} is said to be {part} N s, and the whole impulse is {whole} N s: {size} more than that, {bound} may be")
        });
    }
}

/// Checks the directions of force of bodies whose motions do not tell them: by the reported impulse, or by each other.
fn directions_of_force<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let pair = |x, y| Some((known.number(x)?, known.number(y)?));
    let of_plane = || known.plane.zip(pair(Key::NormalImpulse, Key::TangentialImpulse)).map(|(plane, (n, t))| plane.to_ground(Nt { n, t }));
    let impulse = pair(Key::ImpulseX, Key::ImpulseY).map(|(x, y)| Xy { x, y }).or_else(of_plane).or(known.impulse);
    let claimed = |side| known.number(Key::ForceDirection(side)).filter(|_| known.subject(side).delta_v().is_none());
    if let Some(impulse) = impulse {
        for (side, force) in [(Side::One, impulse), (Side::Two, -impulse)] {
            if let Some(claimed) = claimed(side) {
                direction_of_force(known, side, ("the impulse", force), claimed, judge);
            }
        }
    } else if let (Some((direction, heading)), Some(claimed)) =
        (pair(Key::ForceDirection(Side::One), Key::Heading(Side::One)), claimed(Side::Two))
    {
        let on_two = turned(heading - direction);
        direction_of_force(known, Side::Two, ("the force on body 1", Xy { x: on_two.cos, y: on_two.sin }), claimed, judge);
    }
}
