//! The assumptions of CRASH3, and their effect in a given collision.
//!
//! Both methods start from the crush energy E_C, which is −W_n, and end with the loss T_L and ΔV. With k = K (1, μ), the normal and the tangential velocity
//! change by a unit of normal impulse together with its tangential part, and V_t = σ v_n the remaining sliding velocity, planar mechanics gives
//!
//! ```text
//! P_n² = 2 E_C (1 + e) / ((1 − e) k_n)
//! T_L  = E_C (1 + μ (2 σ k_n + (1 + e) k_t) / ((1 − e) k_n))
//! ΔV_i = P_n √(1 + μ²) / m_i
//! ```
//!
//! Each assumption changes one thing in these formulas:
//!
//! | assumption | in the formula |
//! |---|---|
//! | common velocity | e = 0, μ = μ₀ and σ = 0, with the same direction of approach |
//! | a point mass with the equivalent mass along the force | K is κ times the identity, κ = (k_n + μ k_t)/(1 + μ²) = Σ 1/(γ m) |
//! | tangential factor | T_L = (1 + tan² α) E_C with tan α = μ, and ΔV from T_L as before (Eq 2) |
//!
//! All three together are CRASH3. The first two imply the third: for a point mass at common velocity k_t = μ k_n. With e = 0, an impact through both centers
//! of mass and the true direction of force, none has any effect, and the methods agree exactly (`proptests/crash3.rs`).

use crate::collision::Collision;
use crate::moment::Moment;
use crate::scalar::Real;

/// One of the assumptions of CRASH3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Assumption {
    /// The vehicles reach a common velocity at the contact: no restitution, and no remaining sliding.
    CommonVelocity,
    /// Each vehicle is a point mass, its equivalent mass γ m.
    PointMass,
    /// Tangential work is tan² α times the crush energy.
    TangentialFactor,
}

impl Assumption {
    /// All three, in the order of the paper.
    pub const ALL: [Assumption; 3] = [Assumption::CommonVelocity, Assumption::PointMass, Assumption::TangentialFactor];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Assumption::CommonVelocity => "common velocity",
            Assumption::PointMass => "point mass",
            Assumption::TangentialFactor => "tangential factor",
        }
    }

    /// Returns the assumption in words.
    pub fn statement(self) -> &'static str {
        match self {
            Assumption::CommonVelocity => "the vehicles reach a common velocity where they touch: no restitution, no sliding left",
            Assumption::PointMass => "each vehicle is a point mass, of the equivalent mass along the force",
            Assumption::TangentialFactor => "the tangential factor: tangential work is tan^2 alpha of the crush energy",
        }
    }
}

/// Loss and ΔV that follow from a crush energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Consequence<T = f64> {
    /// Total energy lost, T_L, in J.
    pub loss: T,
    /// ΔV of vehicle 1, in m/s; zero for a barrier.
    pub delta_v_1: T,
    /// ΔV of vehicle 2, in m/s; zero for a barrier.
    pub delta_v_2: T,
}

/// Results of the crush energy of one collision, with and without the assumptions of CRASH3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Assumptions<T = f64> {
    /// The crush energy from which all of them start, E_C = −W_n, in J.
    pub crush_energy: T,
    /// From planar mechanics, without assumptions.
    pub planar: Consequence<T>,
    /// With common velocity alone.
    pub common_velocity: Consequence<T>,
    /// With the point mass alone.
    pub point_mass: Consequence<T>,
    /// With the tangential factor alone.
    pub tangential_factor: Consequence<T>,
    /// With all three: CRASH3 with the force of the common-velocity impulse, α from the normal of the crush plane and the correction without a limit.
    pub together: Consequence<T>,
}

impl Consequence {
    /// Returns `true` if each number is finite.
    pub fn is_finite(&self) -> bool {
        [self.loss, self.delta_v_1, self.delta_v_2].iter().all(|value| value.is_finite())
    }
}

impl Assumptions {
    /// Returns `true` if every consequence is finite: not at e = 1, nor if no compressive impulse brings the vehicles to a common velocity.
    pub fn is_finite(&self) -> bool {
        let all = [&self.planar, &self.common_velocity, &self.point_mass, &self.tangential_factor, &self.together];
        all.into_iter().all(Consequence::is_finite)
    }
}

impl<T: Real> Assumptions<T> {
    /// Computes the consequences for a collision. Returns `None` with a moment impulse, which CRASH3 does not model.
    ///
    /// At e = 1 there is no normal loss to start from, and the results are not finite. Nor are those with common velocity if the impulse that ends sliding is
    /// tensile.
    ///
    /// ```
    /// # use planar_impact::*;
    /// use planar_impact::crash3::Assumptions;
    /// # let vehicle = |heading: f64, left: f64, speed: f64| Vehicle {
    /// #     mass: 1000.0,
    /// #     yaw_inertia: 2000.0,
    /// #     heading: Heading::from_angle(heading),
    /// #     impact_center: ForwardLeft { forward: 1.5, left },
    /// #     motion: Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 },
    /// # };
    /// # let collision = Collision {
    /// #   one: vehicle(0.0, 0.0, 20.0).into(),
    /// #   two: vehicle(std::f64::consts::PI, 0.0, -20.0).into(),
    /// #   crush_plane: CrushPlane::from_angle(0.0),
    /// #   restitution: 0.2,
    /// #   impulse_ratio: ImpulseRatio::Critical,
    /// #   law: Law::Brach,
    /// #   moment: Moment::None,
    /// # };
    /// // Head on, with e = 0.2: only the common velocity costs, and it costs √(0.8/1.2) of ΔV.
    /// let assumptions = Assumptions::of(&collision).expect("no moment impulse");
    /// let shares = [assumptions.together, assumptions.common_velocity].map(|with| with.delta_v_1 / assumptions.planar.delta_v_1);
    /// assert!(shares.iter().all(|share| (share - (0.8_f64 / 1.2).sqrt()).abs() < 1e-12));
    /// ```
    pub fn of(collision: &Collision<T>) -> Option<Self> {
        Self::from_crush_energy(collision, -collision.evaluate().work.n)
    }

    /// Computes the same from another crush energy, such as that of a measured crush: the loss and the ΔV of a collision that differs from the given one only
    /// in its speeds. The loss grows with the energy, ΔV with its square root. Returns `None` with a moment impulse.
    pub fn from_crush_energy(collision: &Collision<T>, crush_energy: T) -> Option<Self> {
        if !matches!(collision.moment, Moment::None) {
            return None;
        }
        let planar = Chain::of(collision);
        let common = Chain::of(&collision.at_common_velocity());
        let contact = collision.contact();
        let inverse_mass = [contact.one.inverse_mass, contact.two.inverse_mass];
        let follows = |chain: Chain<T>| chain.consequence(&crush_energy, &inverse_mass);
        Some(Assumptions {
            planar: follows(planar.clone()),
            common_velocity: follows(common.clone()),
            point_mass: follows(planar.clone().with_point_mass()),
            tangential_factor: planar.with_tangential_factor(&crush_energy, &inverse_mass),
            together: follows(common.with_point_mass()),
            crush_energy,
        })
    }

    /// Returns the results with one assumption alone.
    pub fn with(&self, assumption: Assumption) -> &Consequence<T> {
        match assumption {
            Assumption::CommonVelocity => &self.common_velocity,
            Assumption::PointMass => &self.point_mass,
            Assumption::TangentialFactor => &self.tangential_factor,
        }
    }

    /// Returns the effect of one assumption alone: the result with it, less the result without.
    pub fn cost(&self, assumption: Assumption) -> Consequence<T> {
        self.with(assumption).less(&self.planar)
    }

    /// Returns the effect of all assumptions together.
    pub fn cost_together(&self) -> Consequence<T> {
        self.together.less(&self.planar)
    }
}

impl<T: Real> Consequence<T> {
    fn less(&self, other: &Self) -> Self {
        Consequence {
            loss: self.loss.clone() - other.loss.clone(),
            delta_v_1: self.delta_v_1.clone() - other.delta_v_1.clone(),
            delta_v_2: self.delta_v_2.clone() - other.delta_v_2.clone(),
        }
    }
}

/// Factors from the crush energy to the loss and ΔV.
#[derive(Clone)]
struct Chain<T> {
    /// k_n: change of normal velocity by a unit of normal impulse with its tangential part.
    normal: T,
    /// k_t: change of tangential velocity by the same impulse.
    tangential: T,
    restitution: T,
    /// σ = V_t/v_n.
    sliding: T,
    ratio: T,
}

impl<T: Real> Chain<T> {
    fn of(collision: &Collision<T>) -> Self {
        let (impact, k) = (collision.evaluate(), collision.contact().compliance);
        let ratio = impact.impulse_ratio();
        Chain {
            normal: k.nn + k.nt.clone() * ratio.clone(),
            tangential: k.nt + k.tt * ratio.clone(),
            restitution: collision.restitution.clone(),
            sliding: impact.separation.t / impact.approach.n,
            ratio,
        }
    }

    fn with_point_mass(self) -> Self {
        let mean = (self.normal.clone() + self.ratio.clone() * self.tangential.clone()) / self.length_squared();
        Chain { tangential: self.ratio.clone() * mean.clone(), normal: mean, ..self }
    }

    /// Returns 1 + μ², which is also 1 + tan² α.
    fn length_squared(&self) -> T {
        T::int(1) + self.ratio.clone().squared()
    }

    /// Returns T_L/E_C.
    fn loss_of_energy(&self) -> T {
        let (plus, minus) = (T::int(1) + self.restitution.clone(), T::int(1) - self.restitution.clone());
        let slid = T::int(2) * self.sliding.clone() * self.normal.clone() + plus * self.tangential.clone();
        T::int(1) + self.ratio.clone() * slid / (minus * self.normal.clone())
    }

    /// Returns P²/E_C.
    fn impulse_squared_of_energy(&self) -> T {
        let (plus, minus) = (T::int(1) + self.restitution.clone(), T::int(1) - self.restitution.clone());
        T::int(2) * plus * self.length_squared() / (minus * self.normal.clone())
    }

    fn consequence(&self, crush_energy: &T, inverse_mass: &[T; 2]) -> Consequence<T> {
        self.with_loss_of_energy(self.loss_of_energy(), crush_energy, inverse_mass)
    }

    fn with_tangential_factor(&self, crush_energy: &T, inverse_mass: &[T; 2]) -> Consequence<T> {
        self.with_loss_of_energy(self.length_squared(), crush_energy, inverse_mass)
    }

    /// Returns the results with a given T_L/E_C: P² grows with the loss (Eq 2).
    fn with_loss_of_energy(&self, loss_of_energy: T, crush_energy: &T, inverse_mass: &[T; 2]) -> Consequence<T> {
        let share = loss_of_energy.clone() / self.loss_of_energy();
        let impulse = (crush_energy.clone() * self.impulse_squared_of_energy() * share).square_root();
        Consequence {
            loss: crush_energy.clone() * loss_of_energy,
            delta_v_1: impulse.clone() * inverse_mass[0].clone(),
            delta_v_2: impulse * inverse_mass[1].clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_assumption_is_stated_by_its_name() {
        for assumption in Assumption::ALL {
            assert!(assumption.statement().contains(assumption.name()), "{assumption:?}");
            assert!(Assumption::ALL.iter().filter(|other| other.name() == assumption.name()).count() == 1);
        }
    }
}
