//! What an impact does: the motions after it, the impulse, the works.

use crate::energy::{KineticEnergy, Work};
use crate::frame::{ForwardLeft, Nt, Xy};
use crate::scalar::{Field, Real};
use crate::vehicle::Motion;

/// What an impact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<T = f64> {
    /// The impulse on vehicle 1 in the axes of the contact, in N s; vehicle 2 gets the opposite.
    pub impulse: Nt<T>,
    /// The same in ground axes.
    pub impulse_on_ground: Xy<T>,
    /// The moment impulse on vehicle 1 in N m s; zero when there is none.
    pub moment: T,
    /// The impulse after which sliding has ended, K P = ((1 + e) v_n, v_t): its ratio is the critical one.
    pub critical_impulse: Nt<T>,
    /// Relative velocity at the impact center before, v_2C − v_1C, in m/s.
    pub approach: Nt<T>,
    /// Relative velocity at the impact center after, V_2C − V_1C, in m/s.
    pub separation: Nt<T>,
    /// What vehicle 1 does.
    pub one: Response<T>,
    /// What vehicle 2 does.
    pub two: Response<T>,
    /// The work of each component of the impulse, in J.
    pub work: Work<T>,
    /// Kinetic energy of both, in J. A barrier has none.
    pub kinetic_energy: KineticEnergy<T>,
}

/// What an impact does to one vehicle. A barrier's entries are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<T = f64> {
    /// Its motion after the impact.
    pub after: Motion<T>,
    /// Its change of velocity P/m, in m/s.
    pub delta_v: Xy<T>,
    /// The same in the vehicle's own axes.
    pub delta_v_in_vehicle: ForwardLeft<T>,
}

impl<T: Field> Impact<T> {
    /// The impulse ratio, μ = P_t/P_n (A8).
    #[inline(always)]
    pub fn impulse_ratio(&self) -> T {
        self.impulse.t.clone() / self.impulse.n.clone()
    }

    /// The critical impulse ratio μ₀, at which sliding just ends (A27). A property of the collision, whichever law and ratio are in force.
    #[inline(always)]
    pub fn critical_impulse_ratio(&self) -> T {
        self.critical_impulse.t.clone() / self.critical_impulse.n.clone()
    }

    /// The energy lost, T_L (Eq 1).
    #[inline(always)]
    pub fn loss(&self) -> T {
        self.work.loss()
    }
}

impl<T> Impact<T> {
    /// The same impact on another scalar.
    #[inline(always)]
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
    /// The same response on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Response<U> {
        Response { after: self.after.map(&mut f), delta_v: self.delta_v.map(&mut f), delta_v_in_vehicle: self.delta_v_in_vehicle.map(f) }
    }
}

/// Where a force comes from, in the axes of the vehicle that it acts on. Its length is no matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceOrigin<T = f64> {
    /// Ahead of the vehicle.
    pub ahead: T,
    /// To its right.
    pub right: T,
}

impl<T: Field> ForceOrigin<T> {
    /// Whence a push in the vehicle's axes comes.
    #[inline(always)]
    pub fn of_push(push: ForwardLeft<T>) -> Self {
        // Adding zero makes a negative zero positive, so that a push from straight behind comes from +π and not −π, and no push from 0.
        ForceOrigin { ahead: T::int(0) - push.forward, right: push.left + T::int(0) }
    }
}

impl<T: Real> ForceOrigin<T> {
    /// Its direction in radians clockwise from straight ahead, in (−π, π]; zero where no force comes.
    #[inline(always)]
    pub fn direction(self) -> T {
        self.right.atan2(self.ahead)
    }
}

impl<T: Field> Response<T> {
    /// Where the principal force comes from: whence the vehicle is pushed.
    #[inline(always)]
    pub fn force_origin(&self) -> ForceOrigin<T> {
        ForceOrigin::of_push(self.delta_v_in_vehicle.clone())
    }
}

impl<T: Real> Response<T> {
    /// Magnitude of the change of velocity, ΔV, in m/s.
    #[inline(always)]
    pub fn delta_v_magnitude(&self) -> T {
        self.delta_v.clone().length()
    }

    /// The principal direction of force: where the force comes from, in the vehicle's axes, in radians clockwise from straight ahead, in (−π, π].
    /// 0 is a frontal impact, π/2 one from the right. Zero where no force acts.
    #[inline(always)]
    pub fn principal_direction_of_force(&self) -> T {
        self.force_origin().direction()
    }
}
