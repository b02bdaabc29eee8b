//! Compliance of two bodies at their contact.

use crate::body::Body;
use crate::frame::Nt;
use crate::scalar::Field;

/// The compliance of the contact: K P is the change of relative velocity at the impact center caused by the impulse P.
///
/// ```text
/// K_nn = Σ 1/m + r_t²/I      K_nt = −Σ r_n r_t/I      K_tt = Σ 1/m + r_n²/I
/// ```
///
/// summed over the two bodies, with r from the center of mass to the impact center. In the paper's notation K = (1/m̄) [[A, −B], [−B, 1 + C]] (A28–A30).
///
/// # Properties
///
/// Symmetric, and positive definite if at least one body is free: its determinant is the sum w² + w Σ r²/I + (r₁ × r₂)²/(I₁ I₂) with w = Σ 1/m. It is
/// computed this way because K_nn K_tt − K_nt² can lose all its digits (`proptests/laws.rs`, `determinant_is_that_of_the_matrix`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance<T = f64> {
    pub(crate) nn: T,
    pub(crate) nt: T,
    pub(crate) tt: T,
    pub(crate) determinant: T,
}

impl<T> Compliance<T> {
    /// Returns K_nn in 1/kg: change of normal velocity by a normal impulse.
    pub fn nn(&self) -> &T {
        &self.nn
    }

    /// Returns K_nt in 1/kg: change of tangential velocity by a normal impulse, and the reverse.
    pub fn nt(&self) -> &T {
        &self.nt
    }

    /// Returns K_tt in 1/kg: change of tangential velocity by a tangential impulse.
    pub fn tt(&self) -> &T {
        &self.tt
    }

    /// Returns K_nn K_tt − K_nt², in 1/kg².
    pub fn determinant(&self) -> &T {
        &self.determinant
    }
}

impl<T: Field> Compliance<T> {
    /// Computes the compliance of the contact between two bodies.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn between(one: &Body<T>, two: &Body<T>) -> Self {
        let w = one.inverse_mass.clone() + two.inverse_mass.clone();
        let (j1, j2) = (one.inverse_yaw_inertia.clone(), two.inverse_yaw_inertia.clone());
        let (r1, r2) = (one.arm.clone(), two.arm.clone());
        let nn = j1.clone() * r1.t.clone().squared() + j2.clone() * r2.t.clone().squared();
        let tt = j1.clone() * r1.n.clone().squared() + j2.clone() * r2.n.clone().squared();
        let nt = -(j1.clone() * r1.n.clone() * r1.t.clone() + j2.clone() * r2.n.clone() * r2.t.clone());
        let determinant = w.clone() * (w.clone() + nn.clone() + tt.clone()) + j1 * j2 * r1.cross(r2).squared();
        Compliance { nn: w.clone() + nn, nt, tt: w + tt, determinant }
    }

    /// Returns K P, the change of relative velocity by an impulse.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn velocity_change(&self, impulse: Nt<T>) -> Nt<T> {
        Nt {
            n: self.nn.clone() * impulse.n.clone() + self.nt.clone() * impulse.t.clone(),
            t: self.nt.clone() * impulse.n + self.tt.clone() * impulse.t,
        }
    }

    /// Returns K⁻¹ c, the impulse that causes a change of relative velocity.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn impulse_for(&self, change: Nt<T>) -> Nt<T> {
        let scale = self.determinant.clone().inv();
        Nt {
            n: (self.tt.clone() * change.n.clone() - self.nt.clone() * change.t.clone()) * scale.clone(),
            t: (self.nn.clone() * change.t - self.nt.clone() * change.n) * scale,
        }
    }

    /// Returns K_nn + μ K_nt, the change of normal velocity by a unit of normal impulse that is accompanied by μ of tangential impulse. Positive unless the
    /// pair would wedge; 1/(m̄ q) in the paper's notation (A14).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn along_ratio(&self, impulse_ratio: T) -> T {
        self.nn.clone() + impulse_ratio * self.nt.clone()
    }
}

impl Compliance {
    /// Returns K_nn + μ K_nt as a share of its parts, at most 1. A pair that nearly wedges has a small one: the impulse is divided by the sum, which is rounded
    /// as its parts are, so that of sixteen digits of the impulse as many are lost as the share has zeros.
    pub fn wedging_share(&self, impulse_ratio: f64) -> f64 {
        self.along_ratio(impulse_ratio) / (self.nn + (impulse_ratio * self.nt).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// m = 2, I = 4, C one to the right and two ahead.
    fn body() -> Body {
        Body { inverse_mass: 0.5, inverse_yaw_inertia: 0.25, arm: Nt { n: 2.0, t: -1.0 }, velocity: Nt::zero(), yaw_rate: 0.0 }
    }

    #[test]
    fn one_body_against_a_wall() {
        let k = Compliance::between(&body(), &Body::fixed());
        assert_eq!((*k.nn(), *k.nt(), *k.tt()), (0.75, 0.5, 1.5));
        assert_eq!(*k.determinant(), 0.75 * 1.5 - 0.25);
        assert_eq!(k.velocity_change(Nt { n: 4.0, t: 2.0 }), Nt { n: 4.0, t: 5.0 });
        assert_eq!(k.impulse_for(Nt { n: 4.0, t: 5.0 }), Nt { n: 4.0, t: 2.0 });
        assert_eq!(k.along_ratio(2.0), 1.75);
    }

    #[test]
    fn the_determinant_of_two_bodies_counts_both_arms() {
        let mut other = body();
        other.arm = Nt { n: -1.0, t: 3.0 };
        let k = Compliance::between(&body(), &other);
        // K = [[1 + 0.25 + 2.25, 0.5 + 0.75], [.., 1 + 1 + 0.25]]
        assert_eq!((*k.nn(), *k.nt(), *k.tt()), (3.5, 1.25, 2.25));
        assert_eq!(*k.determinant(), 3.5 * 2.25 - 1.25 * 1.25);
    }
}
