//! The account of energy: `energy-gain`, `work-identity`.

use super::fall::Fall;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::{Known, Touch, sharper};
use super::normal::length;
use super::rule::Rule;
use super::say::Digits;
use super::uncertain::Uncertain;
use alloc::format;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    if let Some(fall) = &known.fall {
        energy_gain(fall, judge);
    }
    work_identity(known, judge);
}

/// Neither the observer on the ground nor the one who moves along sees a gain. Rounding and resolutions show more on the ground; momentum that is not conserved
/// shows there alone.
fn energy_gain<const N: usize>(fall: &Fall<N>, judge: &mut Judge) {
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
    // Told to be undecidable by the sharper of the two alone.
    let (size, bound) = (worst.value.value, judge.bound(Rule::EnergyGain, &worst).total);
    if size > bound {
        judge.not_above(Rule::EnergyGain, worst, told);
    } else {
        judge.not_above(Rule::EnergyGain, Residual::new(-fall.sharpest(), fall.available), told);
    }
}

/// W_n + W_t = T' − T: of the works that the motions imply, or else of those that are reported.
fn work_identity<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let Some(fall) = known.fall.filter(|fall| !fall.translation_only) else { return };
    let implied = known.touch.and_then(|touch| Some((touch.work?, scale_of(&touch)?, "the impulse at the contact point does")));
    let claimed = || {
        let (n, t) = (known.number(Key::NormalWork)?, known.number(Key::TangentialWork)?);
        let work = crate::energy::Work { n, t, m: Uncertain::exact(0.0) };
        Some((work, n.value.abs() + t.value.abs(), "the impulse is said to do"))
    };
    let Some((work, scale, words)) = implied.or_else(claimed) else { return };
    let off = |falls: Uncertain<N>| Residual::new(falls - work.loss(), scale);
    // The difference is known better than its parts.
    let residual = sharper(off(fall.of_pair), off(fall.on_ground), |residual| residual.value.radius());
    judge.zero(Rule::WorkIdentity, residual, |size, bound| {
        format!(
            "{words} {} J of work along n and {} J along t, and the kinetic energy changes by {} J: {} J off, {} may be",
            Digits(work.n.value),
            Digits(work.t.value),
            Digits(work.n.value + work.t.value - residual.value.value),
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

/// ½ |P| (|v| + |V|): what the works are made of, even where they come out as nothing.
pub(super) fn scale_of<const N: usize>(touch: &Touch<N>) -> Option<f64> {
    Some(0.5 * length(touch.impulse.as_ref()?) * (length(&touch.approach) + length(&touch.separation)))
}
