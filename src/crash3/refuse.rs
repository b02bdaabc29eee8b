//! Checks of the damage algorithm's input.

use super::damage::{DamagedPair, PairEstimate, VehicleEstimate};
use crate::input::{Input, Side};
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::refusal::{Refusal, Refusals};
use crate::scalar::{Real, is_finite};

impl<T: Real<Mask = bool>> DamagedPair<T> {
    /// Computes the CRASH3 estimate after checking its input.
    ///
    /// # Errors
    ///
    /// Every invalid input: a mass or a yaw inertia that is not above zero, a crush energy below zero, a force without a direction, a number that is not
    /// finite, or two barriers. Numbers so large or so small that a result is not finite.
    pub fn solve(&self) -> Result<PairEstimate<T>, Refusals<T>> {
        let mut issues = IssueCollector::<Refusal<T>>::new();
        for (side, damaged) in [(Side::One, &self.one), (Side::Two, &self.two)] {
            if let Some(damaged) = damaged {
                let [crush_energy, pdof] = places(side);
                issues.positive(Place::input(Input::Mass(side)), &damaged.mass);
                issues.positive(Place::input(Input::YawInertia(side)), &damaged.yaw_inertia);
                issues.finite(Place::input(Input::ImpactCenterForward(side)), &damaged.impact_center.forward);
                issues.finite(Place::input(Input::ImpactCenterLeft(side)), &damaged.impact_center.left);
                issues.not_negative(crush_energy, &damaged.crush_energy);
                let length_squared = damaged.origin_squared();
                if issues.finite(pdof, &length_squared) && !T::int(0).less(&length_squared) {
                    issues.push(Refusal::NotADirection { at: pdof, length_squared });
                }
            }
        }
        if self.one.is_none() && self.two.is_none() {
            issues.push(Refusal::NothingMoves);
        }
        issues.finish()?;
        let estimate = self.evaluate();
        if estimate.is_finite() { Ok(estimate) } else { Err(Refusal::OutOfFloatRange.into()) }
    }
}

impl<T: Real<Mask = bool>> PairEstimate<T> {
    fn is_finite(&self) -> bool {
        let vehicles = [&self.one, &self.two].into_iter().flatten().flat_map(|vehicle| {
            let VehicleEstimate { correction, corrected_energy, moment_arm, effective_mass_factor, delta_v_magnitude, delta_v } = vehicle;
            [correction, corrected_energy, moment_arm, effective_mass_factor, delta_v_magnitude, &delta_v.forward, &delta_v.left]
        });
        [&self.energy, &self.impulse].into_iter().chain(vehicles).all(is_finite)
    }
}

/// Returns the places of the crush energy and the direction of force, which are not inputs of a collision.
const fn places(side: Side) -> [Place; 2] {
    let (crush_energy, pdof) = match side {
        Side::One => ("vehicle.1.crush_energy", "vehicle.1.crush.pdof"),
        Side::Two => ("vehicle.2.crush_energy", "vehicle.2.crush.pdof"),
    };
    [Place::of(crush_energy, Measure::Energy), Place::of(pdof, Measure::Angle)]
}

#[cfg(test)]
mod tests {
    use super::super::Damaged;
    use super::super::damage::tests::damaged;
    use super::*;
    use crate::impact::ForceDirection;
    use alloc::vec::Vec;

    #[test]
    fn everything_wrong_is_refused_at_once() {
        let nowhere = ForceDirection { ahead: 0.0, right: 0.0 };
        let wrong = Damaged { mass: -1.0, yaw_inertia: f64::NAN, crush_energy: -8.0, force_direction: nowhere, ..damaged() };
        let refusals = DamagedPair { one: None, two: Some(wrong) }.solve().expect_err("four numbers are wrong");
        let inputs: Vec<_> = refusals.iter().map(|refusal| refusal.input().unwrap_or_default()).collect();
        assert_eq!(inputs, ["vehicle.2.mass", "vehicle.2.yaw_inertia", "vehicle.2.crush_energy", "vehicle.2.crush.pdof"]);
        let barriers = DamagedPair::<f64> { one: None, two: None }.solve().expect_err("nothing moves");
        assert_eq!(barriers.as_slice(), [Refusal::NothingMoves]);
        let fine = DamagedPair { one: Some(damaged()), two: None };
        assert_eq!(fine.solve(), Ok(fine.evaluate()));
        let vast = DamagedPair {
            one: Some(Damaged { crush_energy: 1e308, ..damaged() }),
            two: Some(Damaged { crush_energy: 1e308, ..damaged() }),
        };
        assert_eq!(vast.solve().expect_err("the sum overflows").as_slice(), [Refusal::OutOfFloatRange]);
    }
}
