//! Consistency of reported results with each other: the second half of `reported`. It needs no motions, and even with motions it may detect more, because a
//! sum of printed numbers is often more precise than the numbers it was computed from.

use super::format::Digits;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::Known;
use super::rule::Rule;
use super::{claimed_energies, claimed_impulse};
use crate::input::Side;
use alloc::format;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    signs(known, judge);
    claimed_energies::check(known, judge);
    claimed_impulse::check(known, judge);
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
