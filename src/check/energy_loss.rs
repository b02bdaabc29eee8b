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
        let energy = |when| energy_for(one, two, when, Xy::zero(), spin);
        let (before, after) = (energy(When::Before)?, energy(When::After)?);
        let available = internal(one, two, When::Before, spin)?;
        let of_pair = available - internal(one, two, When::After, spin)?;
        let on_ground = if one.fixed || two.fixed { of_pair } else { before - after };
        Some(EnergyLoss { before, after, on_ground, of_pair, available: available.value, translation_only: !spin })
    }

    /// Returns the most that can be lost: the kinetic energy before, with the spins, for an observer who moves with the center of mass of the pair or with the fixed body.
    pub(super) fn most(one: &Subject<N>, two: &Subject<N>) -> Option<Uncertain<N>> {
        internal(one, two, When::Before, true)
    }

    /// Returns the more precise of the two losses.
    pub(super) fn sharpest(&self) -> Uncertain<N> {
        sharper(self.of_pair, self.on_ground, Uncertain::radius)
    }
}

/// Returns the kinetic energy of both bodies for an observer.
fn energy_for<const N: usize>(
    one: &Subject<N>,
    two: &Subject<N>,
    when: When,
    observer: Xy<Uncertain<N>>,
    spin: bool,
) -> Option<Uncertain<N>> {
    Some(one.kinetic_energy(when, observer, spin)? + two.kinetic_energy(when, observer, spin)?)
}

/// Motion of one body past the other.
pub(super) struct RelativeMotion<const N: usize> {
    /// The reduced mass m₁ m₂ / (m₁ + m₂), the mass of the other body beside a fixed one.
    pub(super) mass: Uncertain<N>,
    /// Velocity of body 2 for an observer on body 1.
    pub(super) velocity: Xy<Uncertain<N>>,
}

impl<const N: usize> RelativeMotion<N> {
    pub(super) fn of(one: &Subject<N>, two: &Subject<N>, when: When) -> Option<Self> {
        let velocity = |subject: &Subject<N>| if subject.fixed { subject.before } else { subject.velocity(when) };
        let mass = match [one, two].map(|subject| subject.fixed) {
            [true, _] => two.mass?,
            [_, true] => one.mass?,
            _ => one.mass? * two.mass? / (one.mass? + two.mass?),
        };
        Some(RelativeMotion { mass, velocity: velocity(two)? - velocity(one)? })
    }

    /// Returns its kinetic energy.
    pub(super) fn energy(&self) -> Uncertain<N> {
        self.mass * self.velocity.length_squared().half()
    }
}

/// Returns the kinetic energy of both spins.
pub(super) fn spins<const N: usize>(one: &Subject<N>, two: &Subject<N>, when: When) -> Option<Uncertain<N>> {
    Some(one.spin_energy(when)? + two.spin_energy(when)?)
}

/// Returns the kinetic energy for an observer who moves with the center of mass of the pair or with the fixed body: by König's theorem that of the relative motion, and the spins.
fn internal<const N: usize>(one: &Subject<N>, two: &Subject<N>, when: When, spin: bool) -> Option<Uncertain<N>> {
    let spins = if spin { spins(one, two, when)? } else { Uncertain::exact(0.0) };
    Some(RelativeMotion::of(one, two, when)?.energy() + spins)
}
