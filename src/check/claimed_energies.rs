//! Consistency of reported works, losses and energies with each other.

use super::claimed_impulse;
use super::claims::norm;
use super::energy_loss::{EnergyLoss, RelativeMotion, spins};
use super::format::Digits;
use super::judge::{ENERGY, Judge, Residual, SPEED};
use super::key::Key;
use super::known::Known;
use super::model::RatioKind;
use super::momentum::number_of;
use super::rule::Rule;
use super::subject::When;
use super::uncertain::{Uncertain, sharper_known};
use crate::input::Side;
use crate::scalar::Field;
use alloc::format;
use alloc::string::String;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    normal_work(known, judge);
    energies(known, judge);
    equivalent_energy_speeds(known, judge);
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

/// Returns the work of the normal or of the tangential impulse that a loss, the work of the other and that of the moment leave.
pub(super) fn rest_of_loss<const N: usize>(known: &Known<'_, N>, loss: Uncertain<N>, other: Uncertain<N>) -> Option<Uncertain<N>> {
    Some(-(loss + other + claimed_moment_work(known)?))
}

/// Returns the reported work of the tangential impulse; zero at an impulse ratio of zero.
fn claimed_tangential_work<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    let of_model = Some(Key::ImpulseRatio).filter(|_| matches!(known.record.model.ratio_kind, RatioKind::Given | RatioKind::Friction));
    let is_zero = |key: Key| known.number(key).is_some_and(|number| number.is_zero());
    let has_none = || is_zero(Key::ReportedRatio) || is_zero(Key::TangentialImpulse) || of_model.is_some_and(is_zero);
    known.number(Key::TangentialWork).or_else(|| has_none().then(|| Uncertain::exact(0.0)))
}

/// The work of the normal impulse: the reported one, or that which the loss and the other works leave.
struct NormalWork<const N: usize> {
    work: Uncertain<N>,
    words: &'static str,
    /// The energies that it is the rest of.
    scale: f64,
}

impl<const N: usize> NormalWork<N> {
    fn claimed(known: &Known<'_, N>) -> Option<Self> {
        let reported = known.number(Key::NormalWork).map(|work| NormalWork { work, words: "is said to be", scale: work.value.abs() });
        let rest = || {
            let work = rest_of_loss(known, known.number(Key::EnergyLoss)?, claimed_tangential_work(known)?)?;
            Some(NormalWork { work, words: "is by the loss and the other works", scale: available(known) })
        };
        reported.or_else(rest)
    }
}

/// Checks that the normal impulse does no work on the bodies, which takes a restitution above 1, and that its work is that of the reported speeds:
/// W_n = −½ |P_n| (closing − separation speed). If the motions determine it, the claim is compared with them.
fn normal_work<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let is_determined = known.touch.is_some_and(|touch| touch.work.is_some());
    let Some(NormalWork { work, words, scale }) = NormalWork::claimed(known).filter(|_| !is_determined) else { return };
    let beside_all = |work| Residual::new(work, available(known)).beside(ENERGY);
    judge.not_above(Rule::Reported, beside_all(work), |size, _| {
        format!("the work of the normal impulse {words} {} J, and it is at most zero for a restitution up to 1", Digits(size))
    });
    if known.number(Key::Restitution).is_some_and(|e| (Uncertain::exact(1.0) - e).is_zero()) {
        judge.not_above(Rule::Reported, beside_all(-work), |size, bound| {
            let (work, bound) = (Digits(-size), Digits(bound));
            format!("the work of the normal impulse {words} {work} J, and at a restitution of 1 it is zero; {bound} may be")
        });
    }
    let impulse =
        known.number(Key::NormalImpulse).or_else(|| Some(known.contact_impulse?.n)).or_else(|| claimed_impulse::normal(known, judge));
    let restitution = known.number(Key::Restitution);
    let of_parting = || {
        judge.sign(Rule::Restitution, &Residual::new(restitution?, 1.0))?;
        Some(known.separation_speed()? / restitution?)
    };
    let closing = known.closing_speed().or_else(of_parting);
    let parting = known.separation_speed().or_else(|| Some(restitution? * closing?));
    let (Some(closing), Some(parting)) = (closing, parting) else { return };
    let Some(impulse) = impulse else {
        let Some(whole) = claimed_impulse::magnitude(known) else { return };
        let most = (whole * (closing - parting)).half();
        let residual = Residual::new(-work - most, scale.max(most.size)).open(0.0, known.travel.leeway_of_mean_speed());
        return judge.not_above(Rule::Reported, residual, |size, bound| {
            let (work, most, size, bound) = (Digits(work.value), Digits(most.value), Digits(size), Digits(bound));
            format!(
                "the work of the normal impulse {words} {work} J, and the whole impulse and both speeds make it {most} J at most: {size} more, {bound} \
                 may be"
            )
        });
    };
    let of_speeds = -(impulse.magnitude() * (closing - parting)).half();
    let residual = Residual::new(work - of_speeds, scale.max(of_speeds.size)).open(0.0, known.travel.leeway_of_mean_speed());
    judge.zero(Rule::Reported, residual, |size, bound| {
        let (work, of_speeds, size, bound) = (Digits(work.value), Digits(of_speeds.value), Digits(size), Digits(bound));
        format!(
            "the work of the normal impulse {words} {work} J, and the impulse and both speeds make it {of_speeds} J: {size} off, {bound} may be"
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
    energies.into_iter().chain(of_motions).fold(of_speeds.max(known.beside.energy), f64::max)
}

/// Returns a size beside which energies may be rounding: that of vehicles, if nothing is known of the energy before.
pub(super) fn rounding_of_energy<const N: usize>(known: &Known<'_, N>) -> f64 {
    let is_known = known.number(Key::EnergyBefore).is_some() || known.least_energy(When::Before).value > 0.0;
    if is_known { 0.0 } else { ENERGY }
}

/// Checks the reported energies: the loss is that of the works, and what there was less what there is.
fn energies<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    if let (Some(loss), Some(works)) = (known.number(Key::EnergyLoss), claimed_works(known)) {
        equal(judge, ("energy loss", loss), ("sum of the works makes it", works), available(known).max(works.size));
    }
    work_of_no_moment(known, judge);
    least_energies(known, judge);
    fall_of_the_energy(known, judge);
    most_loss(known, judge);
    most_impulse(known, judge);
}

/// Checks that two energies that are claimed are the same.
fn equal<const N: usize>(judge: &mut Judge, (words, a): (&str, Uncertain<N>), (other, b): (&str, Uncertain<N>), scale: f64) {
    judge.zero(Rule::Reported, Residual::new(a - b, scale), |size, bound| {
        let (a, b, size, bound) = (Digits(a.value), Digits(b.value), Digits(size), Digits(bound));
        format!("the {words} is said to be {a} J, and the {other} {b} J: {size} off, {bound} may be")
    });
}

fn work_of_no_moment<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    if let (Some(work), true) = (known.number(Key::MomentWork), known.moment.is_some_and(|moment| moment.is_zero())) {
        judge.zero(Rule::Reported, Residual::new(work, available(known)).beside(ENERGY), |size, bound| {
            format!("the moment is said to be 0, and its work {} J, {} may be", Digits(size), Digits(bound))
        });
    }
}

/// Checks that no kinetic energy is below that of the motions which are known.
fn least_energies<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    for (key, when) in [(Key::EnergyBefore, When::Before), (Key::EnergyAfter, When::After)] {
        // Where all of it is known, the claim is compared with it.
        let Some(claimed) = known.number(key).filter(|claimed| claimed.value >= 0.0 && known.kinetic_energy(when).is_none()) else {
            continue;
        };
        let least = known.least_energy(when);
        let residual = Residual::new(least - claimed, available(known)).beside(rounding_of_energy(known));
        judge.not_above(Rule::Reported, residual, |size, bound| {
            let (claimed, least, size, bound) = (Digits(claimed.value), Digits(least.value), Digits(size), Digits(bound));
            format!("{key} is said to be {claimed} J, and the motions that are known have {least} J: {size} more, {bound} may be")
        });
    }
}

/// Checks the loss by the kinetic energies, and that no more is lost or left than there was.
fn fall_of_the_energy<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    // All motions tell the loss itself.
    let of_motions = || known.kinetic_energy(When::Before).filter(|_| known.energy_loss.is_none());
    let claimed = known.number(Key::EnergyBefore);
    // A wall that moves does work on the other body, which is no part of the loss.
    let (Some(before), false) = (claimed.or_else(of_motions), known.wall_moves()) else { return };
    let scale = available(known);
    match (known.number(Key::EnergyAfter), claimed_loss(known)) {
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

/// Checks that no more is lost than the motions before have beside that of the center of mass of the pair, which keeps its velocity. All motions tell the loss itself.
fn most_loss<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let fall = || Some(known.number(Key::EnergyBefore)? - known.number(Key::EnergyAfter)?);
    let most = EnergyLoss::most(&known.one, &known.two).filter(|_| !known.wall_moves() && known.loss().is_none());
    let (Some(loss), Some(most)) = (claimed_loss(known).or_else(fall), most) else { return };
    judge.not_above(Rule::Reported, Residual::new(loss - most, available(known).max(loss.size)), |size, bound| {
        let (loss, most, size, bound) = (Digits(loss.value), Digits(most.value), Digits(size), Digits(bound));
        format!("{loss} J are said to be lost, and the motions before the impact, beside that of the center of mass of the pair, have {most} J: {size} more, {bound} may be")
    });
}

/// Checks that no impulse of this magnitude P leaves more energy than there was: the relative speed after the impact is at least P / m̄ − v, so that
/// P² / 2 m̄ − P v is at most what the bodies have as spin, less the loss. All motions tell the impulse itself.
fn most_impulse<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let before = RelativeMotion::of(&known.one, &known.two, When::Before).zip(spins(&known.one, &known.two, When::Before));
    let (Some(impulse), Some((motion, spins)), None) = (claimed_impulse::magnitude(known), before, known.impulse) else { return };
    let loss = claimed_loss(known).filter(|_| !known.wall_moves()).unwrap_or(Uncertain::exact(0.0));
    let (parting, meeting) = (impulse.squared().half() / motion.mass, impulse * norm(motion.velocity));
    let residual = Residual::new(parting - meeting + loss - spins, parting.size.max(meeting.size).max(loss.size).max(spins.size));
    judge.not_above(Rule::Reported, residual.beside(ENERGY), |size, bound| {
        let (impulse, loss, size, bound) = (Digits(impulse.value), Digits(loss.value), Digits(size), Digits(bound));
        format!(
            "an impulse of {impulse} N s and a loss of {loss} J leave {size} J more than the motions before the impact have; {bound} may be"
        )
    });
}

/// Returns the mass of a body or, of a change of velocity that is no small part of the other's, the mass that has it by the impulse.
fn mass<const N: usize>(known: &Known<'_, N>, side: Side, judge: &Judge) -> Option<Uncertain<N>> {
    /// Least share of a change of velocity in the other: a smaller one may be the difference of coarse speeds.
    const CLEAR: f64 = 0.01;
    let by_impulse = || {
        let changes = Side::ALL.map(|side| known.number(Key::DeltaV(side)));
        let own = changes[side as usize]?;
        let greatest = changes.into_iter().flatten().fold(0.0, |most: f64, change: Uncertain<N>| most.max(change.value.abs()));
        judge.sign(Rule::Reported, &Residual::new(own, greatest))?;
        let whole = sharper_known(known.impulse.map(norm), claimed_impulse::magnitude(known), Uncertain::radius)?;
        (own.value > CLEAR * greatest).then(|| whole / own)
    };
    known.subject(side).mass.or_else(by_impulse)
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
    let masses = Side::ALL.map(|side| mass(known, side, judge));
    let energy = |side: Side| {
        let speed = known.number(Key::EquivalentEnergySpeed(side))?;
        Some(masses[side as usize]? * speed.squared().half())
    };
    let loss = sharper_known(claimed_loss(known), known.loss(), Uncertain::radius);
    let of_motion = known.touch.and_then(|touch| touch.work).map(|work| -work.n);
    let of_works = || rest_of_loss(known, loss?, claimed_tangential_work(known)?).map(|work| -work);
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
    let rounded = available(known);
    let residual = |lost: Uncertain<N>| Residual::new(kept - lost, kept.value.abs().max(lost.value.abs())).beside(rounded);
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
            // Coarse motions may leave more open of the one that is the smaller by its number.
            let [above_normal, above_loss] = [normal, loss].map(|lost| {
                let residual = residual(lost);
                residual.value.value - judge.bound(Rule::Reported, &residual).total
            });
            let most = if above_normal <= above_loss { normal } else { loss };
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
            let short = Residual::new(normal - kept, residual(normal).scale).beside(rounded);
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
