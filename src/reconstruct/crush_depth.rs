//! Crush energies that were computed from measured depths, and the errors of such depths.
//!
//! By CRASH3 a crush energy is w (d0 + d1 C)²/2: its root grows with the depth, with d0 and with d1. What is measured are depths, and their error is normal, where
//! that of the energy is not: a depth of 20 cm ± 10 cm lets the energy be a quarter as well as two and a quarter times as large.

use alloc::vec::Vec;

use super::given::{Evidence, ReconstructionProblem};
use crate::scalar::{Field, Real};

/// A crush energy that was computed from depths.
pub(super) struct CrushDepth {
    /// Its place among the evidence.
    evidence: usize,
    /// The given energy, in J.
    given: f64,
    /// An energy that hardly differs from none, in J.
    nothing: f64,
}

impl CrushDepth {
    /// Returns those of a problem.
    pub(super) fn all(question: &ReconstructionProblem, evidence: &[Evidence]) -> Vec<CrushDepth> {
        /// Of the given energy: where the computed one is zero, its depth is then 7 % of the given one. A search does not end there, as it would where the root has no slope.
        const NOTHING: f64 = 0.01;
        let of = |(place, evidence): (usize, &Evidence)| {
            let is_one = question.crush_energy_from_depths.contains(&evidence.of) && evidence.value > 0.0;
            is_one.then_some(CrushDepth { evidence: place, given: evidence.value, nothing: NOTHING * evidence.value })
        };
        evidence.iter().enumerate().filter_map(of).collect()
    }

    /// Replaces the computed energy E by that whose distance from the given one G is, to first order, what the roots differ by: G + 2 n(G) (√(p(E)/p(G)) − 1), with
    /// n(E)² = E² + s² and p(E) = (E + n(E))/2, which is hardly E where E > 0, and still positive where a search leads to E < 0.
    pub(super) fn straighten<T: Real + Copy + From<f64>>(&self, computed: &mut [T]) {
        let size = (self.given.squared() + self.nothing.squared()).square_root();
        let energy = computed[self.evidence];
        let energy_size = (energy.magnitude().squared() + T::from(self.nothing.squared())).square_root();
        let root = ((energy + energy_size) / T::from(self.given + size)).square_root();
        computed[self.evidence] = T::from(self.given) + T::from(2.0 * size) * (root - T::int(1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Collision;
    use crate::input::Side;
    use crate::reconstruct::{Measurand, Uncertainty};
    use crate::vehicle::Vehicle;
    use num_dual::Dual64;

    const OF: Measurand = Measurand::CrushEnergyOf(Side::Two);

    fn all(from_depths: &[Measurand], value: f64) -> Vec<CrushDepth> {
        let vehicle = Vehicle::new(1500.0, 2400.0);
        let crush_energy_from_depths = from_depths.to_vec();
        let question = ReconstructionProblem { crush_energy_from_depths, ..ReconstructionProblem::of(Collision::new(vehicle, vehicle)) };
        let evidence = |of, value| Evidence { of, value, uncertainty: Uncertainty::StandardDeviation(1e4) };
        CrushDepth::all(&question, &[evidence(Measurand::ClosingSpeed, 10.0), evidence(OF, value)])
    }

    fn straightened(energy: f64) -> Dual64 {
        let mut computed = [Dual64::from(10.0), Dual64::from(energy).derivative()];
        all(&[OF], 4e4)[0].straighten(&mut computed);
        assert_eq!(computed[0], Dual64::from(10.0));
        computed[1]
    }

    #[test]
    fn to_first_order_nothing_changes() {
        let same = straightened(4e4);
        assert!((same.re - 4e4).abs() < 1e-10 && (same.eps - 1.0).abs() < 1e-14, "{same}");
    }

    /// By hand: E = k C² for a depth C of 20 cm, so that one of C + ΔC differs by 2 k C ΔC to first order.
    #[test]
    fn differences_are_those_of_the_depths() {
        for share in [0.2, 0.5, 0.8, 1.3, 2.0, 4.0] {
            let energy = 4e4 * share * share;
            let wanted = 4e4 + 8e4 * (share - 1.0);
            assert!((straightened(energy).re - wanted).abs() < 3e-3 * 8e4, "{share}: {}", straightened(energy));
        }
    }

    #[test]
    fn it_rises_everywhere() {
        let energies = [-4e5, -4e4, -4e2, 0.0, 4e2, 4e4, 4e6].map(straightened);
        assert!(energies.iter().all(|energy| energy.eps > 0.0) && energies.is_sorted_by(|a, b| a.re < b.re), "{energies:?}");
        // No energy is that of no depth, but for a tenth of it.
        assert!((energies[3].re + 4e4).abs() < 0.15 * 4e4, "{}", energies[3]);
    }

    #[test]
    fn other_energies_have_errors_of_their_own() {
        assert!(all(&[], 4e4).is_empty() && all(&[Measurand::CrushEnergy], 4e4).is_empty() && all(&[OF], 0.0).is_empty());
        assert_eq!(all(&[OF], 4e4).len(), 1);
    }
}
