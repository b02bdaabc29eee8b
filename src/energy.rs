//! The energy balance: work of each component of the impulse, and kinetic energy before and after.

use crate::frame::Nt;
use crate::scalar::Field;

/// The work of each component of the impulse, in J; negative where energy is lost.
///
/// `n` is the work of the normal impulse, whose loss is the crush energy; `t` is that of the tangential impulse, from sliding, shearing and entanglement; `m`
/// is that of the moment impulse, zero without one. A single component may be positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Work<T = f64> {
    /// W_n = −½ P_n (v_n + V_n)   (Eqs 5–7)
    pub n: T,
    /// W_t = −½ P_t (v_t + V_t)   (Eqs 5, 6, 8)
    pub t: T,
    /// W_m = −½ M (ω_r + Ω_r)
    pub m: T,
}

/// Kinetic energy of both bodies together, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KineticEnergy<T = f64> {
    /// Before the impact.
    pub before: T,
    /// After it.
    pub after: T,
}

/// Returns the work of one component of the impulse on body one, against the relative velocity (of body two less that of body one) along it: −½ P (v + V),
/// the impulse times the mean velocity of its point of application (Eq 5).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn work<T: Field>(impulse: T, before: T, after: T) -> T {
    -(impulse * (before + after)).half()
}

impl<T: Field> Work<T> {
    /// Returns the work of an impulse that changes the approach velocity to the separation velocity, without a moment.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of(impulse: Nt<T>, approach: Nt<T>, separation: Nt<T>) -> Self {
        Work { n: work(impulse.n, approach.n, separation.n), t: work(impulse.t, approach.t, separation.t), m: T::int(0) }
    }

    /// Returns the energy lost, T_L = −(W_n + W_t + W_m).
    ///
    /// # Properties
    ///
    /// Exactly the kinetic energy before less that after (`proptests/energy.rs`, `work_is_the_change_of_kinetic_energy`), and more accurate than that
    /// difference, which suffers from cancellation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn loss(&self) -> T {
        // Subtracting zero is free for a float without a moment; adding zero is not, because of negative zero.
        -(self.n.clone() + self.t.clone()) - self.m.clone()
    }
}

impl<T> Work<T> {
    /// Converts the work to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Work<U> {
        Work { n: f(self.n), t: f(self.t), m: f(self.m) }
    }
}

impl<T> KineticEnergy<T> {
    /// Converts the energies to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> KineticEnergy<U> {
        KineticEnergy { before: f(self.before), after: f(self.after) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stopping_impulse_takes_all_of_the_energy() {
        // A unit mass at 4 m/s towards −n, stopped: half its momentum times its speed.
        let work = Work::of(Nt { n: 4.0, t: 0.0 }, Nt { n: 4.0, t: 1.0 }, Nt { n: 0.0, t: 1.0 });
        assert_eq!(work, Work { n: -8.0, t: 0.0, m: 0.0 });
        assert_eq!(work.loss(), 8.0);
    }

    #[test]
    fn a_component_may_give_energy_back() {
        let work = Work { n: -8.0, t: 3.0, m: -1.0 };
        assert_eq!(work.loss(), 6.0);
        assert_eq!(work.map(|w| w as f32).n, -8.0_f32);
    }
}
