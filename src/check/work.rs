//! The energy balance: `energy-gain`, `work-identity`.

use super::claimed_energies::{available, claimed_moment_work, claimed_works};
use super::energy_loss::EnergyLoss;
use super::format::Digits;
use super::judge::{ENERGY, Judge, Residual};
use super::key::Key;
use super::known::{Known, Touch};
use super::normal::length;
use super::rule::Rule;
use super::uncertain::{Uncertain, sharper};
use crate::energy::Work;
use alloc::format;
use alloc::string::String;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    match &known.energy_loss {
        Some(fall) => energy_gain(fall, judge),
        None => gain_of_claims(known, judge),
    }
    work_identity(known, judge);
}

/// Checks that neither the observer on the ground nor the one moving with the pair sees a gain. Rounding and resolutions have more effect on the ground;
/// momentum that is not conserved is visible there only.
fn energy_gain<const N: usize>(fall: &EnergyLoss<N>, judge: &mut Judge) {
    let residuals = [fall.on_ground, fall.of_pair].map(|falls| Residual::new(-falls, fall.available));
    let excess = |residual: &Residual<N>| residual.value.value - judge.bound(Rule::EnergyGain, residual).total;
    let worst = if excess(&residuals[1]) > excess(&residuals[0]) { residuals[1] } else { residuals[0] };
    let told = |size: f64, bound: f64| {
        let of = if fall.translation_only { "of translation, yaw not being known, " } else { "" };
        format!(
            "the kinetic energy {of}rises by {} J from {} J before to {} J after, {} may be",
            Digits(size),
            Digits(fall.before.value),
            Digits(fall.after.value),
            Digits(bound)
        )
    };
    if fall.translation_only {
        // Spin may have become translation.
        judge.checks(Rule::EnergyGain);
        let (size, bound) = (worst.value.value, judge.bound(Rule::EnergyGain, &worst).total);
        if size > bound {
            judge.warn(Rule::EnergyGain, size, bound, told(size, bound));
        }
        return;
    }
    // Undecidable only by the more precise of the two.
    let (size, bound) = (worst.value.value, judge.bound(Rule::EnergyGain, &worst).total);
    if size > bound {
        judge.not_above(Rule::EnergyGain, worst, told);
    } else {
        judge.not_above(Rule::EnergyGain, Residual::new(-fall.sharpest(), fall.available), told);
    }
}

/// Checks that what is reported without motions states no gain. A wall that moves may give energy to what it hits, as seen from the ground; works are the same
/// for every observer.
fn gain_of_claims<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let on_ground = !known.wall_moves();
    let of_observer = |key| known.number(key).filter(|_| on_ground);
    let energies = of_observer(Key::EnergyAfter).zip(of_observer(Key::EnergyBefore));
    let (gain, words) = if let Some(works) = claimed_works(known) {
        (-works, "the works that are reported add up to a gain of")
    } else if let Some(loss) = of_observer(Key::EnergyLoss) {
        (-loss, "the loss of energy that is reported is a gain of")
    } else if let Some((after, before)) = energies {
        (after - before, "the kinetic energies that are reported rise by")
    } else {
        return;
    };
    judge.not_above(Rule::EnergyGain, Residual::new(gain, available(known).max(gain.size)).beside(ENERGY), |size, bound| {
        format!("{words} {} J, {} may be", Digits(size), Digits(bound))
    });
}

/// Checks W_n + W_t = T' − T, with the works that the motions imply, or else those that are reported.
fn work_identity<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let Some(fall) = known.energy_loss.filter(|fall| !fall.translation_only) else { return };
    let implied = known.touch.and_then(|touch| Some((touch.work?, scale_of(&touch)?, "the impulse at the contact point does")));
    let claimed = || {
        let (n, t) = (known.number(Key::NormalWork)?, known.number(Key::TangentialWork)?);
        let work = Work { n, t, m: claimed_moment_work(known)? };
        // Of works that cancel, the energies of the motions are what the errors are a share of.
        let scale = (n.value.abs() + t.value.abs() + work.m.value.abs()).max(fall.available);
        Some((work, scale, "the impulse is said to do"))
    };
    let Some((work, scale, words)) = implied.or_else(claimed) else { return };
    let impulse = known.impulse_value();
    let (slack, leeway) = (known.travel.work_slack(impulse), known.travel.work_leeway(impulse));
    let off = |falls: Uncertain<N>| Residual::new(falls - work.loss(), scale).open(slack, leeway);
    // The difference is more precise than its parts.
    let residual = sharper(off(fall.of_pair), off(fall.on_ground), |residual| residual.value.radius());
    judge.zero(Rule::WorkIdentity, residual, |size, bound| {
        format!(
            "{words} {} J of work along n and {} J along t{}, and the kinetic energy changes by {} J: {} J off, {} may be",
            Digits(work.n.value),
            Digits(work.t.value),
            if known.moment.is_some() { format!(", the moment {} J", Digits(work.m.value)) } else { String::new() },
            Digits(-work.loss().value - residual.value.value),
            Digits(size),
            Digits(bound)
        )
    });
    let tangential = Residual::new(work.t, scale);
    if judge.sign(Rule::WorkIdentity, &tangential) == Some(1.0) {
        let bound = judge.bound(Rule::WorkIdentity, &tangential).total;
        let what = format!("the tangential impulse gives back {} J: possible, and rare", Digits(work.t.value));
        judge.warn(Rule::WorkIdentity, work.t.value, bound, what);
    }
}

/// Returns ½ |P| (|v| + |V|) + |W_m|, the magnitude of the works even if those of the impulse cancel.
pub(super) fn scale_of<const N: usize>(touch: &Touch<N>) -> Option<f64> {
    let of_impulse = 0.5 * length(touch.impulse.as_ref()?) * (length(&touch.approach) + length(&touch.separation));
    Some(of_impulse + touch.work.as_ref()?.m.size)
}
