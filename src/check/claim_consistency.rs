//! Consistency of reported results with each other: the second half of `reported`. It needs no motions, and even with motions it may detect more, because a
//! sum of printed numbers is often more precise than the numbers it was computed from.

use super::format::Digits;
use super::judge::{ENERGY, IMPULSE, Judge, Residual, SPEED};
use super::key::Key;
use super::known::Known;
use super::rule::Rule;
use super::uncertain::Uncertain;
use super::{claimed_energies, claimed_impulse};
use crate::input::Side;
use alloc::format;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    signs(known, judge);
    claimed_energies::check(known, judge);
    claimed_impulse::check(known, judge);
}

/// Checks that speeds, lengths of vectors and energies of motion are not negative, but for the rounding of those that they are the difference of.
fn signs<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    use Key::{ClosingSpeed, DeltaV, EnergyAfter, EnergyBefore, EquivalentEnergySpeed, ImpulseMagnitude, SeparationSpeed};
    use Side::{One, Two};
    let alike: [(&[Key], f64); 3] = [
        (&[ClosingSpeed, SeparationSpeed, DeltaV(One), DeltaV(Two), EquivalentEnergySpeed(One), EquivalentEnergySpeed(Two)], SPEED),
        (&[ImpulseMagnitude], IMPULSE),
        (&[EnergyBefore, EnergyAfter], ENERGY),
    ];
    for (keys, rounded) in alike {
        let claims = || keys.iter().filter_map(|&key| Some((key, known.number(key)?)));
        let scale = claims().fold(0.0, |scale: f64, (_, claimed): (Key, Uncertain<N>)| scale.max(claimed.value.abs()));
        for (key, claimed) in claims().filter(|(_, claimed)| claimed.value < 0.0) {
            judge.not_above(Rule::Reported, Residual::new(-claimed, scale).beside(rounded), |size, _| {
                format!("{key} is said to be {}, and is at least zero", Digits(-size))
            });
        }
    }
}
