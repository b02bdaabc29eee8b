//! The result of an impact: post-impact motions, impulse, works.

use crate::energy::{KineticEnergy, Work};
use crate::frame::{ForwardLeft, Nt, Xy};
use crate::scalar::{Field, Real};
use crate::vehicle::Motion;

/// The result of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact<T = f64> {
    /// The impulse on vehicle 1 in contact axes, in N s; vehicle 2 gets the opposite.
    pub impulse: Nt<T>,
    /// The impulse on vehicle 1 in ground axes, in N s.
    pub impulse_on_ground: Xy<T>,
    /// The moment impulse on vehicle 1 in N m s; zero without one.
    pub moment: T,
    /// The impulse after which sliding has ended, K P = ((1 + e) v_n, v_t), whose ratio is the critical ratio.
    pub critical_impulse: Nt<T>,
    /// Relative velocity at the impact center before, v_2C − v_1C, in m/s.
    pub approach: Nt<T>,
    /// Relative velocity at the impact center after, V_2C − V_1C, in m/s.
    pub separation: Nt<T>,
    /// The response of vehicle 1.
    pub one: Response<T>,
    /// The response of vehicle 2.
    pub two: Response<T>,
    /// The work of each component of the impulse, in J.
    pub work: Work<T>,
    /// Kinetic energy of both, in J. A barrier has none.
    pub kinetic_energy: KineticEnergy<T>,
}

/// The response of one vehicle to an impact. A barrier's entries are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Response<T = f64> {
    /// Its motion after the impact.
    pub after: Motion<T>,
    /// Its change of velocity P/m, in m/s.
    pub delta_v: Xy<T>,
    /// Its change of velocity in vehicle axes, in m/s.
    pub delta_v_in_vehicle: ForwardLeft<T>,
}

impl<T: Field> Impact<T> {
    /// Returns the impulse ratio, μ = P_t/P_n (A8).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn impulse_ratio(&self) -> T {
        self.impulse.t.clone() / self.impulse.n.clone()
    }

    /// Returns the critical impulse ratio μ₀, at which sliding just ends (A27). It is a property of the collision, whichever law and ratio are in force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn critical_impulse_ratio(&self) -> T {
        self.critical_impulse.t.clone() / self.critical_impulse.n.clone()
    }

    /// Returns the energy lost, T_L (Eq 1).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn loss(&self) -> T {
        self.work.loss()
    }
}

impl<T> Impact<T> {
    /// Converts the impact to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Impact<U> {
        Impact {
            impulse: self.impulse.map(&mut f),
            impulse_on_ground: self.impulse_on_ground.map(&mut f),
            moment: f(self.moment),
            critical_impulse: self.critical_impulse.map(&mut f),
            approach: self.approach.map(&mut f),
            separation: self.separation.map(&mut f),
            one: self.one.map(&mut f),
            two: self.two.map(&mut f),
            work: self.work.map(&mut f),
            kinetic_energy: self.kinetic_energy.map(f),
        }
    }
}

impl<T> Response<T> {
    /// Converts the response to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Response<U> {
        Response { after: self.after.map(&mut f), delta_v: self.delta_v.map(&mut f), delta_v_in_vehicle: self.delta_v_in_vehicle.map(f) }
    }
}

/// Direction a force comes from, in the axes of the vehicle that it acts on. Its length has no meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForceDirection<T = f64> {
    /// Component ahead of the vehicle.
    pub ahead: T,
    /// Component to its right.
    pub right: T,
}

impl<T: Field> ForceDirection<T> {
    /// Returns the direction that a push comes from, in vehicle axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of_push(push: ForwardLeft<T>) -> Self {
        // Adding zero makes a negative zero positive, so that a push from straight behind comes from +π and not −π, and a zero push from 0.
        ForceDirection { ahead: T::int(0) - push.forward, right: push.left + T::int(0) }
    }

    /// Returns the direction of the push, in vehicle axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn push(&self) -> ForwardLeft<T> {
        ForwardLeft { forward: -self.ahead.clone(), left: self.right.clone() }
    }
}

impl<T: Real> ForceDirection<T> {
    /// Returns its direction in radians clockwise from straight ahead, in (−π, π]; zero without a force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn direction(self) -> T {
        self.right.arctangent(self.ahead)
    }

    /// Returns its direction as the angle within a half turn of that of another force, so that an interval of directions near it is not cut at a half turn;
    /// zero if the other one is no force.
    pub fn direction_about(self, other: &ForceDirection) -> T
    where
        T: From<f64>,
    {
        if (other.ahead, other.right) == (0.0, 0.0) {
            return T::int(0);
        }
        let (cos, sin) = (T::from(other.ahead), T::from(other.right));
        let along = self.ahead.clone() * cos.clone() + self.right.clone() * sin.clone();
        let across = self.right * cos.clone() - self.ahead * sin.clone();
        across.arctangent(along) + sin.arctangent(cos)
    }
}

impl<T: Field> Response<T> {
    /// Returns the direction the principal force comes from, in vehicle axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn force_direction(&self) -> ForceDirection<T> {
        ForceDirection::of_push(self.delta_v_in_vehicle.clone())
    }
}

impl<T: Real> Response<T> {
    /// Returns the magnitude of the change of velocity, ΔV, in m/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn delta_v_magnitude(&self) -> T {
        self.delta_v.clone().length()
    }

    /// Returns the principal direction of force, from which the force comes, in vehicle axes, in radians clockwise from straight ahead, in (−π, π]. 0 is a
    /// frontal impact, π/2 one from the right. Zero if no force acts.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn principal_direction_of_force(&self) -> T {
        self.force_direction().direction()
    }
}
