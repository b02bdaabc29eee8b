//! The force at the end of the crush: ∫ (A + B C) dw normal to the surface, and along the principal direction of force.

use super::{ForceLine, Profile, Saturating, StiffnessZones};
use crate::scalar::Ordered;

/// Largest imbalance of the crush forces on two vehicles that EDCRASH's run-time diagnostics accept, as a share of the smaller force.
pub const MOST_FORCE_IMBALANCE: f64 = 1.0;

/// Returns by how much the larger of two forces exceeds the smaller, as a share of the smaller. By Newton's third law it is 0.
pub fn force_imbalance(forces: [f64; 2]) -> f64 {
    let (less, more) = (forces[0].min(forces[1]), forces[0].max(forces[1]));
    (more - less) / less
}

impl<T: Ordered> StiffnessZones<T> {
    /// Returns the force normal to the surface at the end of the crush, ∫ (A + B C) dw over the profile, in N.
    ///
    /// ```
    /// use planar_impact::crush::{CrushStiffness, ForceLine, Profile, StiffnessZones};
    /// let stiffness = CrushStiffness::from(ForceLine { onset: 50e3, slope: 500e3 });
    /// let profile = Profile::equally_spaced(1.5, vec![0.2, 0.4])?;
    /// let force = StiffnessZones::from(stiffness).crush_force(&profile);
    /// assert!(f64::abs(force - 1.5 * (50e3 + 500e3 * 0.3)) < 1e-6);
    /// # Ok::<(), planar_impact::Issues<planar_impact::crush::ProfileError>>(())
    /// ```
    pub fn crush_force(&self, profile: &Profile<T>) -> T {
        let lines = self.moments(profile).zip(self.zones()).map(|(moments, zone)| (moments, ForceLine::from(zone.clone())));
        lines.fold(T::int(0), |force, (moments, line)| force + line.onset * moments.width() + line.slope * moments.second)
    }
}

impl<T: Ordered> Saturating<T> {
    /// Returns the force normal to the surface at the end of the crush, in N.
    pub fn crush_force(&self, profile: &Profile<T>) -> T {
        let linear = StiffnessZones::from(self.stiffness.clone()).crush_force(profile);
        let slope = ForceLine::from(self.stiffness.clone()).slope;
        linear - slope * profile.segments().fold(T::int(0), |sum, segment| sum + self.area_beyond(&segment))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crush::{CrushLaw, CrushStiffness};
    use alloc::vec;
    use approx::assert_relative_eq;

    const SOFT: CrushStiffness = CrushStiffness { onset: 3.0, slope: 4.0 };

    #[test]
    fn the_force_is_the_integral_of_that_of_the_law() {
        let profile = Profile::equally_spaced(2.0, vec![0.0, 0.9, 0.3, 0.3]).expect("four depths");
        for depth in [0.0, 0.2, 0.5, 2.0] {
            let law = Saturating { stiffness: SOFT, depth };
            // The midpoint rule.
            let steps = 30_000;
            let sum: f64 = (0..steps)
                .map(|i| {
                    let at = (f64::from(i) + 0.5) / f64::from(steps) * 3.0;
                    let (part, share) = (at as usize, at.fract());
                    let ends = &profile.depths()[part..part + 2];
                    CrushLaw::force(&law, ends[0] + (ends[1] - ends[0]) * share)
                })
                .sum();
            assert_relative_eq!(law.crush_force(&profile), 2.0 * sum / f64::from(steps), max_relative = 1e-7);
        }
        let unlimited = Saturating { stiffness: SOFT, depth: 1.0 }.crush_force(&profile);
        assert_relative_eq!(StiffnessZones::from(SOFT).crush_force(&profile), unlimited, max_relative = 1e-15);
    }

    #[test]
    fn each_zone_has_its_own_force() {
        let profile = Profile::equally_spaced(2.0, vec![0.5, 0.5]).expect("two depths");
        let stiff = CrushStiffness { onset: 2.0, slope: 9.0 };
        let zones = StiffnessZones::new(vec![SOFT, stiff], vec![0.5]).expect("two zones");
        // ½ m (12 + 16 · ½) + 1½ m (18 + 81 · ½).
        assert_relative_eq!(zones.crush_force(&profile), 0.5 * 20.0 + 1.5 * 58.5, max_relative = 1e-15);
    }

    #[test]
    fn equal_forces_balance() {
        assert_eq!([force_imbalance([3.0, 3.0]), force_imbalance([3.0, 6.0]), force_imbalance([6.0, 3.0])], [0.0, 1.0, 1.0]);
    }
}
