//! The loss of kinetic energy.

use super::subject::{Subject, When};
use super::uncertain::{Uncertain, sharper};
use crate::frame::Xy;
use crate::scalar::Field;

/// Kinetic energies of the bodies that can move, in J.
#[derive(Clone, Copy)]
pub(super) struct EnergyLoss<const N: usize> {
    /// Before, in ground axes.
    pub(super) before: Uncertain<N>,
    /// After, in ground axes.
    pub(super) after: Uncertain<N>,
    /// Loss for an observer at rest with the fixed body or else on the ground.
    pub(super) on_ground: Uncertain<N>,
    /// Loss for an observer who moves with the center of mass of the pair; the same as `on_ground` with a fixed body.
    pub(super) of_pair: Uncertain<N>,
    /// Kinetic energy before for that observer: the loss cannot exceed it.
    pub(super) available: f64,
    /// `true` if spin is unknown and left out.
    pub(super) translation_only: bool,
}

impl<const N: usize> EnergyLoss<N> {
    pub(super) fn of(one: &Subject<N>, two: &Subject<N>) -> Option<Self> {
        let spin = one.spin_is_known() && two.spin_is_known();
        let energy = |when, observer| Some(one.kinetic_energy(when, observer, spin)? + two.kinetic_energy(when, observer, spin)?);
        let (before, after) = (energy(When::Before, Xy::zero())?, energy(When::After, Xy::zero())?);
        let made = |on_ground: Uncertain<N>, of_pair, available| EnergyLoss {
            before,
            after,
            on_ground,
            of_pair,
            available,
            translation_only: !spin,
        };
        let fixed = [one, two].into_iter().find(|subject| subject.fixed);
        if let Some(wall) = fixed {
            let seen = energy(When::Before, wall.before?)?;
            let falls = seen - energy(When::After, wall.before?)?;
            return Some(made(falls, falls, seen.value));
        }
        let (m1, m2) = (one.mass?, two.mass?);
        let reduced = m1 * m2 / (m1 + m2);
        // König's theorem: the relative motion, and the spins.
        let internal = |when| {
            let past = two.velocity(when)? - one.velocity(when)?;
            let spins = if spin { one.spin_energy(when)? + two.spin_energy(when)? } else { Uncertain::exact(0.0) };
            Some(reduced * past.length_squared().half() + spins)
        };
        let internal_before: Uncertain<N> = internal(When::Before)?;
        Some(made(before - after, internal_before - internal(When::After)?, internal_before.value))
    }

    /// Returns the more precise of the two losses.
    pub(super) fn sharpest(&self) -> Uncertain<N> {
        sharper(self.of_pair, self.on_ground, Uncertain::radius)
    }
}
