//! The damage algorithm: from crush energies to ΔV.

use super::correction::energy_correction;
use super::surface::Surface;
use crate::collision::Collision;
use crate::frame::ForwardLeft;
use crate::impact::{ForceDirection, Response};
use crate::input::Side;
use crate::scalar::{Field, Ordered, Real};
use crate::vehicle::{Party, Vehicle};

/// The input of CRASH3 for one vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Damaged<T = f64> {
    /// Mass m, in kg.
    pub mass: T,
    /// Yaw inertia I = m k², in kg m².
    pub yaw_inertia: T,
    /// Point of action of the principal force, from the center of mass, in m.
    pub impact_center: ForwardLeft<T>,
    /// The surface that is crushed.
    pub surface: Surface,
    /// Direction the principal force comes from.
    pub force_direction: ForceDirection<T>,
    /// Crush energy, in J.
    pub crush_energy: T,
}

/// The two parties; `None` is a fixed barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DamagedPair<T = f64> {
    /// Vehicle 1.
    pub one: Option<Damaged<T>>,
    /// Vehicle 2.
    pub two: Option<Damaged<T>>,
}

/// The estimate from the damage of one vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct VehicleEstimate<T = f64> {
    /// 1 + tan² α, at most 2.
    pub correction: T,
    /// The crush energy times the correction, in J.
    pub corrected_energy: T,
    /// h in m: the moment of a unit force about the center of mass, positive if it turns the vehicle counter-clockwise.
    pub moment_arm: T,
    /// γ = k²/(k² + h²): the effective share of the mass.
    pub effective_mass_factor: T,
    /// ΔV in m/s.
    pub delta_v_magnitude: T,
    /// ΔV as a vector along the force, in vehicle axes.
    pub delta_v: ForwardLeft<T>,
}

/// The estimate from the damage of both vehicles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PairEstimate<T = f64> {
    /// Sum of the corrected energies, in J.
    pub energy: T,
    /// The magnitude of the impulse between them, in N s.
    pub impulse: T,
    /// Estimate of vehicle 1; `None` for a barrier.
    pub one: Option<VehicleEstimate<T>>,
    /// Estimate of vehicle 2; `None` for a barrier.
    pub two: Option<VehicleEstimate<T>>,
}

impl<T: Field> Damaged<T> {
    /// Creates the input for a vehicle.
    pub fn of(vehicle: &Vehicle<T>, surface: Surface, force_direction: ForceDirection<T>, crush_energy: T) -> Self {
        let (mass, yaw_inertia) = (vehicle.mass.clone(), vehicle.yaw_inertia.clone());
        Damaged { mass, yaw_inertia, impact_center: vehicle.impact_center.clone(), surface, force_direction, crush_energy }
    }

    /// Returns the moment of the force, unscaled: r × u |o|, with o the direction it comes from.
    fn moment(&self) -> T {
        let (r, from) = (self.impact_center.clone(), self.force_direction.clone());
        r.forward * from.right + r.left * from.ahead
    }

    pub(super) fn origin_squared(&self) -> T {
        self.force_direction.ahead.clone().squared() + self.force_direction.right.clone().squared()
    }

    /// Returns 1/(γ m) = 1/m + h²/I, in 1/kg: the compliance of the point of action along the force.
    pub fn inverse_effective_mass(&self) -> T {
        let arm_squared = self.moment().squared() / self.origin_squared();
        self.mass.clone().inv() + arm_squared / self.yaw_inertia.clone()
    }

    /// Returns γ = k²/(k² + h²).
    pub fn effective_mass_factor(&self) -> T {
        let inertia = self.yaw_inertia.clone() * self.origin_squared();
        inertia.clone() / (inertia + self.mass.clone() * self.moment().squared())
    }
}

impl<T: Ordered> Damaged<T> {
    /// Returns the crush energy times 1 + tan² α, in J.
    pub fn corrected_energy(&self) -> T {
        self.crush_energy.clone() * energy_correction(self.surface, &self.force_direction)
    }
}

/// An investigator's findings on the damage of a vehicle, which replace those computed from the collision.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Investigated<T = f64> {
    /// The surface that is crushed.
    pub surface: Option<Surface>,
    /// Direction the principal force comes from.
    pub force_direction: Option<ForceDirection<T>>,
}

impl<T: Real<Mask = bool>> DamagedPair<T> {
    /// Creates the input from a collision and the crush energy of each vehicle. The surfaces are those along the crush plane, and the force is that of the
    /// [common-velocity](Collision::at_common_velocity) impulse. The energy of a barrier is not used.
    pub fn of_collision(collision: &Collision<T>, crush_energy: [T; 2]) -> Self {
        let found = [(); 2].map(|()| Investigated { surface: None, force_direction: None });
        DamagedPair::investigated(collision, crush_energy, found, |_, vehicle, origin| {
            Surface::along(&collision.crush_plane, &vehicle.heading, origin)
        })
    }
}

impl<T: Real> DamagedPair<T> {
    /// Creates the input from a collision, the crush energy of each vehicle and what an investigator found. `surface` tells the crushed surface where that was
    /// not found, from the vehicle and the direction of force: nothing else compares numbers, so that all else is written for intervals too.
    pub fn investigated(
        collision: &Collision<T>,
        crush_energy: [T; 2],
        found: [Investigated<T>; 2],
        surface: impl Fn(Side, &Vehicle<T>, &ForceDirection<T>) -> Surface,
    ) -> Self {
        let impact = collision.at_common_velocity().evaluate();
        let ([energy_1, energy_2], [found_1, found_2]) = (crush_energy, found);
        let damaged = |side, party: &Party<T>, response: &Response<T>, energy, found: Investigated<T>| {
            let vehicle = party.vehicle()?;
            let origin = found.force_direction.unwrap_or_else(|| response.force_direction());
            let surface = found.surface.unwrap_or_else(|| surface(side, vehicle, &origin));
            Some(Damaged::of(vehicle, surface, origin, energy))
        };
        DamagedPair {
            one: damaged(Side::One, &collision.one, &impact.one, energy_1, found_1),
            two: damaged(Side::Two, &collision.two, &impact.two, energy_2, found_2),
        }
    }
}

impl DamagedPair {
    /// Returns the angle in rad by which the forces on the two vehicles deviate from being opposite, in ground axes, or `None` with a barrier.
    pub fn force_misalignment(&self, collision: &Collision) -> Option<f64> {
        let push = |damaged: &Option<Damaged>, party: &Party| {
            let push = damaged.as_ref()?.force_direction.push();
            Some(party.vehicle()?.heading.to_ground(push))
        };
        let (one, two) = (push(&self.one, &collision.one)?, push(&self.two, &collision.two)?);
        Some(Real::arctangent(one.cross(two), -one.dot(two)).abs())
    }
}

impl<T: Field> DamagedPair<T> {
    fn sum(&self, of: impl Fn(&Damaged<T>) -> T) -> T {
        [&self.one, &self.two].into_iter().flatten().fold(T::int(0), |sum, damaged| sum + of(damaged))
    }

    /// Returns Σ 1/(γ m), in 1/kg: a barrier adds nothing.
    pub fn inverse_effective_mass(&self) -> T {
        self.sum(Damaged::inverse_effective_mass)
    }
}

impl<T: Ordered> DamagedPair<T> {
    /// Returns the sum of the corrected energies, in J.
    pub fn corrected_energy(&self) -> T {
        self.sum(Damaged::corrected_energy)
    }

    /// Returns the square of the impulse between them, 2 (E'₁ + E'₂)/Σ 1/(γ m).
    pub fn impulse_squared(&self) -> T {
        T::int(2) * self.corrected_energy() / self.inverse_effective_mass()
    }
}

impl<T: Real> DamagedPair<T> {
    /// Computes the estimate from the damage, without checking its input.
    pub fn evaluate(&self) -> PairEstimate<T> {
        let impulse = self.impulse_squared().square_root();
        let estimate = |damaged: &Damaged<T>| VehicleEstimate::of(damaged, impulse.clone());
        PairEstimate {
            energy: self.corrected_energy(),
            one: self.one.as_ref().map(estimate),
            two: self.two.as_ref().map(estimate),
            impulse,
        }
    }
}

impl<T: Real> VehicleEstimate<T> {
    fn of(damaged: &Damaged<T>, impulse: T) -> Self {
        let length = damaged.origin_squared().square_root();
        let delta_v = impulse / damaged.mass.clone();
        let along = delta_v.clone() / length.clone();
        let ForceDirection { ahead, right } = damaged.force_direction.clone();
        VehicleEstimate {
            correction: energy_correction(damaged.surface, &damaged.force_direction),
            corrected_energy: damaged.corrected_energy(),
            moment_arm: damaged.moment() / length,
            // An interval of it may exceed 1, as the arm stands in it twice.
            effective_mass_factor: damaged.effective_mass_factor().smaller(T::int(1)),
            delta_v: ForwardLeft { forward: -(ahead * along.clone()), left: right * along },
            delta_v_magnitude: delta_v,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use approx::assert_relative_eq;

    pub(in crate::crash3) fn damaged() -> Damaged {
        Damaged {
            mass: 1000.0,
            yaw_inertia: 1690.0,
            impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
            surface: Surface::Front,
            force_direction: ForceDirection { ahead: 4.0, right: 3.0 },
            crush_energy: 8000.0,
        }
    }

    #[test]
    fn the_arm_is_that_of_the_force_through_the_impact_center() {
        // Push (−0.8, 0.6) at (2, 0.5): 2 × 0.6 + 0.5 × 0.8 = 1.6; k = 1.3.
        let estimate = DamagedPair { one: Some(damaged()), two: None }.evaluate();
        let car = estimate.one.expect("a vehicle");
        assert_relative_eq!(car.moment_arm, 1.6, max_relative = 1e-15);
        assert_relative_eq!(car.effective_mass_factor, 1.69 / (1.69 + 2.56), max_relative = 1e-15);
        assert_eq!(car.correction, 1.5625);
        let delta_v = (2.0 * 12_500.0 / 1000.0 * 1.69 / 4.25_f64).sqrt();
        assert_relative_eq!(car.delta_v_magnitude, delta_v, max_relative = 1e-15);
        assert_relative_eq!(car.delta_v.forward, -0.8 * delta_v, max_relative = 1e-15);
        assert_relative_eq!(car.delta_v.left, 0.6 * delta_v, max_relative = 1e-15);
        assert_eq!((estimate.energy, estimate.two), (12_500.0, None));
    }

    #[test]
    fn each_gets_the_impulse_over_its_mass() {
        let heavy = Damaged { mass: 4000.0, yaw_inertia: 6760.0, impact_center: ForwardLeft { forward: 2.0, left: 0.0 }, ..damaged() };
        let estimate = DamagedPair { one: Some(damaged()), two: Some(heavy) }.evaluate();
        let (one, two) = (estimate.one.expect("a vehicle"), estimate.two.expect("a vehicle"));
        assert_relative_eq!(one.delta_v_magnitude * 1000.0, estimate.impulse, max_relative = 1e-15);
        assert_relative_eq!(two.delta_v_magnitude * 4000.0, estimate.impulse, max_relative = 1e-15);
        let effective = [1000.0 * one.effective_mass_factor, 4000.0 * two.effective_mass_factor];
        let reduced = effective[0] * effective[1] / (effective[0] + effective[1]);
        assert_relative_eq!(estimate.impulse, (2.0 * estimate.energy * reduced).sqrt(), max_relative = 1e-15);
    }
}
