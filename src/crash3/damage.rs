//! The damage algorithm: from crush energies to ΔV.

use super::correction::energy_correction;
use super::surface::Surface;
use crate::collision::Collision;
use crate::frame::ForwardLeft;
use crate::impact::{ForceOrigin, Response};
use crate::scalar::{Field, Ordered, Real};
use crate::vehicle::{Party, Vehicle};

/// What CRASH3 knows of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damaged<T = f64> {
    /// Mass m, in kg.
    pub mass: T,
    /// Yaw inertia I = m k², in kg m².
    pub yaw_inertia: T,
    /// From the center of mass to where the principal force acts, in m.
    pub impact_center: ForwardLeft<T>,
    /// The surface that is crushed.
    pub surface: Surface,
    /// Where the principal force comes from.
    pub force_origin: ForceOrigin<T>,
    /// The energy that the crush stands for, in J.
    pub crush_energy: T,
}

/// The two parties; none is a fixed barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamagedPair<T = f64> {
    /// Vehicle 1.
    pub one: Option<Damaged<T>>,
    /// Vehicle 2.
    pub two: Option<Damaged<T>>,
}

/// What the damage of one vehicle says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VehicleEstimate<T = f64> {
    /// 1 + tan² α, at most 2.
    pub correction: T,
    /// The crush energy times the correction, in J.
    pub corrected_energy: T,
    /// h in m: the moment about the center of mass of a unit of the force, positive where it turns the vehicle counter-clockwise.
    pub moment_arm: T,
    /// γ = k²/(k² + h²): the share of the mass that the force moves.
    pub effective_mass_factor: T,
    /// ΔV in m/s.
    pub delta_v_magnitude: T,
    /// The same as a vector along the force, in the vehicle's axes.
    pub delta_v: ForwardLeft<T>,
}

/// What the damage of both says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairEstimate<T = f64> {
    /// The corrected energies of both, in J.
    pub energy: T,
    /// The magnitude of the impulse between them, in N s.
    pub impulse: T,
    /// Of vehicle 1; none of a barrier.
    pub one: Option<VehicleEstimate<T>>,
    /// Of vehicle 2.
    pub two: Option<VehicleEstimate<T>>,
}

impl<T: Field> Damaged<T> {
    /// Of a vehicle.
    pub fn of(vehicle: &Vehicle<T>, surface: Surface, force_origin: ForceOrigin<T>, crush_energy: T) -> Self {
        let (mass, yaw_inertia) = (vehicle.mass.clone(), vehicle.yaw_inertia.clone());
        Damaged { mass, yaw_inertia, impact_center: vehicle.impact_center.clone(), surface, force_origin, crush_energy }
    }

    /// The moment of the force origin as a push, unscaled: r × u |o|.
    fn moment(&self) -> T {
        let (r, from) = (self.impact_center.clone(), self.force_origin.clone());
        r.forward * from.right + r.left * from.ahead
    }

    pub(super) fn origin_squared(&self) -> T {
        self.force_origin.ahead.clone().squared() + self.force_origin.right.clone().squared()
    }

    /// 1/(γ m) = 1/m + h²/I, in 1/kg: how readily the point where the force acts yields along it.
    pub fn inverse_effective_mass(&self) -> T {
        let arm_squared = self.moment().squared() / self.origin_squared();
        self.mass.clone().inv() + arm_squared / self.yaw_inertia.clone()
    }

    /// γ = k²/(k² + h²).
    pub fn effective_mass_factor(&self) -> T {
        let inertia = self.yaw_inertia.clone() * self.origin_squared();
        inertia.clone() / (inertia + self.mass.clone() * self.moment().squared())
    }
}

impl<T: Ordered> Damaged<T> {
    /// The crush energy times 1 + tan² α, in J.
    pub fn corrected_energy(&self) -> T {
        self.crush_energy.clone() * energy_correction(self.surface, &self.force_origin)
    }
}

impl<T: Real<Mask = bool>> DamagedPair<T> {
    /// The pair of a collision, each with its crush energy: the surfaces those along the crush plane, the force that of the
    /// [common-velocity](Collision::at_common_velocity) impulse. What a barrier is given is not used.
    pub fn of_collision(collision: &Collision<T>, crush_energy: [T; 2]) -> Self {
        let impact = collision.at_common_velocity().evaluate();
        let [energy_1, energy_2] = crush_energy;
        let damaged = |party: &Party<T>, response: &Response<T>, energy| {
            let (vehicle, origin) = (party.vehicle()?, response.force_origin());
            Some(Damaged::of(vehicle, Surface::along(&collision.crush_plane, &vehicle.heading, &origin), origin, energy))
        };
        DamagedPair { one: damaged(&collision.one, &impact.one, energy_1), two: damaged(&collision.two, &impact.two, energy_2) }
    }
}

impl<T: Field> DamagedPair<T> {
    fn sum(&self, of: impl Fn(&Damaged<T>) -> T) -> T {
        [&self.one, &self.two].into_iter().flatten().fold(T::int(0), |sum, damaged| sum + of(damaged))
    }

    /// Σ 1/(γ m), in 1/kg: a barrier adds nothing.
    pub fn inverse_effective_mass(&self) -> T {
        self.sum(Damaged::inverse_effective_mass)
    }
}

impl<T: Ordered> DamagedPair<T> {
    /// The corrected energies of both, in J.
    pub fn corrected_energy(&self) -> T {
        self.sum(Damaged::corrected_energy)
    }

    /// The square of the impulse between them, 2 (E'₁ + E'₂)/Σ 1/(γ m).
    pub fn impulse_squared(&self) -> T {
        T::int(2) * self.corrected_energy() / self.inverse_effective_mass()
    }
}

impl<T: Real> DamagedPair<T> {
    /// What the damage says, without asking whether it can.
    pub fn evaluate(&self) -> PairEstimate<T> {
        let impulse = self.impulse_squared().sqrt();
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
        let length = damaged.origin_squared().sqrt();
        let delta_v = impulse / damaged.mass.clone();
        let along = delta_v.clone() / length.clone();
        let ForceOrigin { ahead, right } = damaged.force_origin.clone();
        VehicleEstimate {
            correction: energy_correction(damaged.surface, &damaged.force_origin),
            corrected_energy: damaged.corrected_energy(),
            moment_arm: damaged.moment() / length,
            effective_mass_factor: damaged.effective_mass_factor(),
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
            force_origin: ForceOrigin { ahead: 4.0, right: 3.0 },
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
