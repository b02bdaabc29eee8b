//! Consistency of reported results with each other: the second half of `reported`. It needs no motions, and even with motions it may detect more, because a
//! sum of printed numbers is often more precise than the numbers it was computed from.

use super::claims::{direction_of_force, norm};
use super::format::Digits;
use super::judge::{ENERGY, Judge, Residual, SPEED};
use super::key::Key;
use super::known::{Known, turned};
use super::momentum::number_of;
use super::rule::Rule;
use super::subject::When;
use super::uncertain::{Uncertain, sharper_known};
use crate::frame::{Nt, Xy};
use crate::input::Side;
use crate::scalar::Field;
use alloc::format;
use alloc::string::String;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    signs(known, judge);
    normal_work(known, judge);
    energies(known, judge);
    impulses(known, judge);
    directions_of_force(known, judge);
    equivalent_energy_speeds(known, judge);
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

/// Returns the reported loss, or the loss that follows from the reported works.
pub(super) fn claimed_loss<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    known.number(Key::EnergyLoss).or_else(|| claimed_works(known))
}

/// Returns −(W_n + W_t + W_m).
pub(super) fn claimed_works<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    Some(-(known.number(Key::NormalWork)? + known.number(Key::TangentialWork)? + claimed_moment_work(known)?))
}

/// Returns the reported work of the moment impulse, or the work that follows from the motions; zero without a moment.
pub(super) fn claimed_moment_work<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    let implied = || match known.moment {
        None => Some(Uncertain::exact(0.0)),
        Some(_) => Some(known.touch?.work?.m),
    };
    known.number(Key::MomentWork).or_else(implied)
}

/// Checks that the normal impulse does no work on the bodies, which takes a restitution above 1, and that its work is that of the reported speeds:
/// W_n = −½ |P_n| (closing − separation speed). If the motions determine it, the claim is compared with them.
fn normal_work<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let is_determined = known.touch.is_some_and(|touch| touch.work.is_some());
    let Some(work) = known.number(Key::NormalWork).filter(|_| !is_determined) else { return };
    let beside_all = |work| Residual::new(work, available(known)).beside(ENERGY);
    judge.not_above(Rule::Reported, beside_all(work), |size, _| {
        format!("the work of the normal impulse is said to be {} J, and it is at most zero for a restitution up to 1", Digits(size))
    });
    if known.number(Key::Restitution).is_some_and(|e| (Uncertain::exact(1.0) - e).is_zero()) {
        judge.not_above(Rule::Reported, beside_all(-work), |size, bound| {
            let (work, bound) = (Digits(-size), Digits(bound));
            format!("the work of the normal impulse is said to be {work} J, and at a restitution of 1 it is zero; {bound} may be")
        });
    }
    let (impulse, closing) = (known.number(Key::NormalImpulse), known.closing_speed());
    let parting = known.separation_speed().or_else(|| Some(known.number(Key::Restitution)? * closing?));
    let (Some(impulse), Some(closing), Some(parting)) = (impulse, closing, parting) else { return };
    let of_speeds = -(impulse.magnitude() * (closing - parting)).half();
    let scale = work.value.abs().max(of_speeds.size);
    judge.zero(Rule::Reported, Residual::new(work - of_speeds, scale), |size, bound| {
        let (work, of_speeds, size, bound) = (Digits(work.value), Digits(of_speeds.value), Digits(size), Digits(bound));
        format!(
            "the work of the normal impulse is said to be {work} J, and the impulse and both speeds make it {of_speeds} J: {size} off, {bound} may be"
        )
    });
}

/// Returns the greatest energy that is claimed, that motions have, or that claimed impulse and speeds make: of a restitution of 1, works and losses are the
/// rounding of these.
pub(super) fn available<const N: usize>(known: &Known<'_, N>) -> f64 {
    use Key::{EnergyAfter, EnergyBefore, EnergyLoss, MomentWork, NormalWork, TangentialWork};
    let size = |key| known.number(key).map_or(0.0, |number: Uncertain<N>| number.value.abs());
    let energies = [NormalWork, TangentialWork, MomentWork, EnergyLoss, EnergyBefore, EnergyAfter].map(size);
    let of_speeds = size(Key::NormalImpulse) * size(Key::ClosingSpeed).max(size(Key::SeparationSpeed));
    let of_motions = [When::Before, When::After].map(|when| known.least_energy(when).value);
    energies.into_iter().chain(of_motions).fold(of_speeds, f64::max)
}

fn energies<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let equal = |judge: &mut Judge, (words, a): (&str, Uncertain<N>), (other, b): (&str, Uncertain<N>), scale: f64| {
        judge.zero(Rule::Reported, Residual::new(a - b, scale), |size, bound| {
            let (a, b, size, bound) = (Digits(a.value), Digits(b.value), Digits(size), Digits(bound));
            format!("the {words} is said to be {a} J, and the {other} {b} J: {size} off, {bound} may be")
        });
    };
    let (loss, works) = (known.number(Key::EnergyLoss), claimed_works(known));
    if let (Some(loss), Some(works)) = (loss, works) {
        equal(judge, ("energy loss", loss), ("sum of the works makes it", works), available(known).max(works.size));
    }
    if let (Some(work), true) = (known.number(Key::MomentWork), known.moment.is_some_and(|moment| moment.is_zero())) {
        judge.zero(Rule::Reported, Residual::new(work, available(known)).beside(ENERGY), |size, bound| {
            format!("the moment is said to be 0, and its work {} J, {} may be", Digits(size), Digits(bound))
        });
    }
    for (key, when) in [(Key::EnergyBefore, When::Before), (Key::EnergyAfter, When::After)] {
        // Where all of it is known, the claim is compared with it.
        let Some(claimed) = known.number(key).filter(|claimed| claimed.value >= 0.0 && known.kinetic_energy(when).is_none()) else {
            continue;
        };
        let least = known.least_energy(when);
        judge.not_above(Rule::Reported, Residual::new(least - claimed, least.value.max(claimed.value.abs())), |size, bound| {
            let (claimed, least, size, bound) = (Digits(claimed.value), Digits(least.value), Digits(size), Digits(bound));
            format!("{key} is said to be {claimed} J, and the motions that are known have {least} J: {size} more, {bound} may be")
        });
    }
    // All motions tell the loss itself.
    let of_motions = || known.kinetic_energy(When::Before).filter(|_| known.energy_loss.is_none());
    let claimed = known.number(Key::EnergyBefore);
    // A wall that moves does work on the other body, which is no part of the loss.
    let (Some(before), false) = (claimed.or_else(of_motions), known.wall_moves()) else { return };
    let scale = available(known);
    match (known.number(Key::EnergyAfter), loss.or(works)) {
        (Some(after), Some(loss)) => equal(judge, ("energy loss", loss), ("fall of the kinetic energy", before - after), scale),
        (None, Some(loss)) => {
            let left = known.least_energy(When::After);
            judge.not_above(Rule::Reported, Residual::new(loss + left - before, scale), |size, bound| {
                let (loss, left, before, size, bound) = (Digits(loss.value), Digits(left.value), Digits(before.value), Digits(size), Digits(bound));
                format!(
                    "the energy loss is said to be {loss} J, the motions after the impact have at least {left} J, and the kinetic energy before \
                     {before} J: {size} more than there was, {bound} may be"
                )
            });
        }
        (None, None) if claimed.is_some_and(|claimed| claimed.value >= 0.0) => {
            let left = known.least_energy(When::After);
            judge.not_above(Rule::Reported, Residual::new(left - before, scale), |size, bound| {
                let (left, before, size, bound) = (Digits(left.value), Digits(before.value), Digits(size), Digits(bound));
                format!("the motions after the impact have at least {left} J, and the kinetic energy before is said to be {before} J: {size} more, {bound} may be")
            });
        }
        _ => (),
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
    let passed = sharper_known(on_one, on_two, Uncertain::radius);
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

/// Checks that Σ ½ m EES² is the crush energy, which is the work of the normal impulse with its sign reversed. Some programs use the total loss. Where only one
/// of the two is known, the speeds may be of the other, which is the larger one unless the tangential impulse does work on the bodies: possible, and rare.
fn equivalent_energy_speeds<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    for side in Side::ALL.into_iter().filter(|side| known.subject(*side).fixed) {
        let Some(speed) = known.number(Key::EquivalentEnergySpeed(side)) else { continue };
        judge.zero(Rule::Reported, Residual::new(speed, speed.value.abs()).beside(SPEED), |size, _| {
            format!("body {} is fixed, and its equivalent energy speed is said to be {} m/s", number_of(side), Digits(size))
        });
    }
    let energy = |side| {
        let speed = known.number(Key::EquivalentEnergySpeed(side))?;
        Some(known.subject(side).mass? * speed.squared().half())
    };
    let loss = sharper_known(claimed_loss(known), known.loss(), Uncertain::radius);
    let of_motion = known.touch.and_then(|touch| touch.work).map(|work| -work.n);
    let of_works = || Some(known.number(Key::EnergyLoss)? + known.number(Key::TangentialWork)? + claimed_moment_work(known)?);
    let claimed = known.number(Key::NormalWork).map(|work| -work).or_else(of_works);
    let normal = sharper_known(claimed, of_motion, Uncertain::radius);
    let all = |side: Side| energy(side).or_else(|| known.subject(side).fixed.then(|| Uncertain::exact(0.0)));
    let is_claimed = known.record.reported.ees != [None, None];
    let (kept, is_whole) = match (all(Side::One), all(Side::Two)) {
        (Some(a), Some(b)) if is_claimed => (a + b, true),
        _ => match energy(Side::One).or_else(|| energy(Side::Two)) {
            Some(kept) => (kept, false),
            None => return,
        },
    };
    let residual = |lost: Uncertain<N>| Residual::new(kept - lost, kept.value.abs().max(lost.value.abs()));
    let told = |lost: f64, how: &str, size: f64, bound: f64| {
        let (kept, lost, size, bound) = (Digits(kept.value), Digits(lost), Digits(size), Digits(bound));
        format!("the equivalent energy speeds give {kept} J, {how} {lost} J: {size} off, {bound} may be")
    };
    let of_one = "for one body alone, and of both no more is lost than";
    match (normal, loss) {
        (Some(normal), Some(loss)) if is_whole => {
            let [of_normal, of_loss] = [normal, loss].map(|lost| judge.excess(Rule::Reported, &residual(lost)));
            let lost = if of_normal <= of_loss { normal } else { loss };
            let how = "and neither the work of the normal impulse nor the loss is that, but";
            judge.zero(Rule::Reported, residual(lost), |size, bound| told(lost.value, how, size, bound));
        }
        (Some(normal), Some(loss)) => {
            let most = if normal.value > loss.value { normal } else { loss };
            judge.not_above(Rule::Reported, residual(most), |size, bound| told(most.value, of_one, size, bound));
        }
        (None, Some(loss)) => {
            let how = if is_whole { "and the loss is" } else { of_one };
            warn_above(residual(loss), judge, |size, bound| told(loss.value, how, size, bound));
        }
        (None, None) => {
            let before = known.number(Key::EnergyBefore).or_else(|| known.kinetic_energy(When::Before));
            let Some(before) = before.filter(|_| !known.wall_moves()) else { return };
            warn_above(residual(before), judge, |size, bound| told(before.value, "and the kinetic energy before is", size, bound));
        }
        (Some(normal), None) if is_whole => {
            let short = Residual::new(normal - kept, residual(normal).scale);
            warn_above(short, judge, |size, bound| told(normal.value, "and the work of the normal impulse is", size, bound));
        }
        _ => (),
    }
}

/// Warns of a quantity above zero.
fn warn_above<const N: usize>(residual: Residual<N>, judge: &mut Judge, what: impl FnOnce(f64, f64) -> String) {
    judge.checks(Rule::Reported);
    if judge.sign(Rule::Reported, &residual) == Some(1.0) {
        let (size, bound) = (residual.value.value, judge.bound(Rule::Reported, &residual).total);
        judge.warn(Rule::Reported, size, bound, what(size, bound));
    }
}
