//! The paper's equations in the paper's notation, and the errors of the printed text.
//!
//! The rest of the crate computes with the compliance K. Here every numbered equation has the form of the paper, corrected where the print is wrong, so that
//! a reader finds it by its number and a test can compare the two (`proptests/paper.rs`, equality in rationals).
//!
//! The paper divides by masses and by the approach speed, so it cannot represent a fixed barrier or an impact without normal approach velocity; the matrix
//! form can.
//!
//! | equation | quantity | function | as printed |
//! |---|---|---|---|
//! | 1 | energy loss T_L | [`PaperNotation::eq1`], [`Work::loss`](crate::Work::loss) | right, given A11 and A21 corrected |
//! | 2 | m_i ΔV_i | [`PaperNotation::eq2_squared`], [`Response::delta_v_magnitude`](crate::Response::delta_v_magnitude) | right; singular where its bracket is 0 |
//! | 3 | E* = √(2E_C/w) = d₀ + d₁C | [`crush_intensity`](crate::crush::crush_intensity), [`CrushStiffness::crush_intensity`](crate::crush::CrushStiffness::crush_intensity) | right |
//! | 4 | crush energy | [`CrushStiffness::crush_energy`](crate::crush::CrushStiffness::crush_energy) | right; the K_i are not printed |
//! | 5 | work of an impulse | [`eq5`], [`work`](crate::energy::work) | right |
//! | 6 | work of both components | [`eq6`] | right; the text before it has body 2 less body 1, the equation body 1 less body 2 |
//! | 7, 8 | E_C and E_T | [`PaperNotation::eq7`], [`PaperNotation::eq8`], [`Work`](crate::Work) | wrong sign: the printed expression is the work, E = −W |
//! | 9 | EES of a series of tests | [`equivalent_energy_speed`](crate::crush::equivalent_energy_speed) | holds only for e = 0; the tables have (1 − e²) |
//! | A1–A4 | velocity changes | [`PaperNotation::a1`] … [`PaperNotation::a4`] | right |
//! | A5, A6 | yaw rate changes | [`PaperNotation::a5`], [`PaperNotation::a6`] | right |
//! | A7 | e | [`a7`] | right |
//! | A8 | μ | [`a8`] | right |
//! | A9, A10 | I = m k² | [`a9_a10`] | right |
//! | A11 | v_m | [`PaperNotation::a11`] | **wrong**: − (v_1n − d_c ω_1) for − (v_1n + d_c ω_1), which A13 has |
//! | A12, A13 | V_Cm, v_Cm | [`PaperNotation::a12`], [`PaperNotation::a13`] | right |
//! | A14 | 1/q | [`PaperNotation::a14`] | right |
//! | A15, A18 | d_a, d_d | [`a15`], [`a18`] | right, if φ_1 points from C to the center of mass and φ_2 from the center of mass to C |
//! | A16 | d_b | [`a16`] | **wrong**: d_1 sin(θ_1 + φ_1 − Γ) for d_2 cos(θ_2 + φ_2 − Γ) |
//! | A17 | d_c | [`a17`] | **wrong**: cosine for sine |
//! | A19, A20 | d_e, d_f | [`PaperNotation::a19`], [`PaperNotation::a20`] | right; the list of notation has d_e twice |
//! | A21 | r | [`PaperNotation::a21`] | **wrong**: the signs of d_b ω_2 and d_d ω_1 |
//! | A22–A25 | P_x, P_y, P_n, P_t | [`a22_a23`], [`a24_a25`], [`CrushPlane::to_contact`](crate::CrushPlane::to_contact) | right |
//! | A26 | m̄ | [`a26`] | right |
//! | A27 | μ₀ | [`PaperNotation::a27`], [`Impact::critical_impulse_ratio`](crate::Impact::critical_impulse_ratio) | right, given A21 corrected |
//! | A28–A30 | A, B, C | [`PaperNotation::a28`] … [`PaperNotation::a30`], [`Compliance`](crate::Compliance) | right |
//!
//! A11 and A21 do not affect the paper's Tables 1 and 2, where no vehicle rotates before the impact. The test `proptests/errata.rs` shows for each wrong form
//! that it violates a conservation law in a concrete collision, in exact arithmetic.
//!
//! Of the statements in words, "the total amount of energy lost … is independent of Γ" (after Table 2) omits its condition: e = 0 and μ = μ₀.

use crate::body::Body;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::scalar::{Field, Real};

/// A collision in the notation of Appendix A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the letters are the paper's, and its notation list is their documentation")]
pub struct PaperNotation<T = f64> {
    pub m_1: T,
    pub m_2: T,
    pub i_1: T,
    pub i_2: T,
    pub v_1n: T,
    pub v_1t: T,
    pub v_2n: T,
    pub v_2t: T,
    pub omega_1: T,
    pub omega_2: T,
    pub d_a: T,
    pub d_b: T,
    pub d_c: T,
    pub d_d: T,
    pub e: T,
    pub mu: T,
}

/// Returns the work of an impulse on a point that moves at v before and V after: ½ P (V + v)   (Eq 5)
pub fn eq5<T: Field>(impulse: T, after: T, before: T) -> T {
    (impulse * (after + before)).half()
}

/// Returns the work of both components of the impulse on vehicle 1, and of the opposite on vehicle 2, from the velocities of each at the impact center   (Eq
/// 6)
pub fn eq6<T: Field>(impulse: Nt<T>, before: [Nt<T>; 2], after: [Nt<T>; 2]) -> T {
    let [v_1, v_2] = before;
    let [vv_1, vv_2] = after;
    let sum = (v_1 - v_2) + (vv_1 - vv_2);
    impulse.dot(sum).half()
}

/// Returns e = −V_Cm/v_Cm   (A7)
pub fn a7<T: Field>(separation: T, approach: T) -> T {
    -(separation / approach)
}

/// Returns μ = P_t/P_n   (A8)
pub fn a8<T: Field>(impulse: Nt<T>) -> T {
    impulse.t / impulse.n
}

/// Returns I = m k²   (A9, A10)
pub fn a9_a10<T: Field>(mass: T, radius_of_gyration: T) -> T {
    mass * radius_of_gyration.squared()
}

/// Returns d_a = d_2 sin(θ_2 + φ_2 − Γ)   (A15), with φ_2 the bearing from the center of mass of vehicle 2 to C.
pub fn a15<T: Real>(d_2: T, theta_2: T, phi_2: T, gamma: T) -> T {
    d_2 * (theta_2 + phi_2 - gamma).sin_and_cos().0
}

/// Returns d_b = d_2 cos(θ_2 + φ_2 − Γ)   (A16, corrected)
pub fn a16<T: Real>(d_2: T, theta_2: T, phi_2: T, gamma: T) -> T {
    d_2 * (theta_2 + phi_2 - gamma).sin_and_cos().1
}

/// Returns d_c = d_1 sin(θ_1 + φ_1 − Γ)   (A17, corrected), with φ_1 the bearing from C to the center of mass of vehicle 1.
pub fn a17<T: Real>(d_1: T, theta_1: T, phi_1: T, gamma: T) -> T {
    d_1 * (theta_1 + phi_1 - gamma).sin_and_cos().0
}

/// Returns d_d = d_1 cos(θ_1 + φ_1 − Γ)   (A18)
pub fn a18<T: Real>(d_1: T, theta_1: T, phi_1: T, gamma: T) -> T {
    d_1 * (theta_1 + phi_1 - gamma).sin_and_cos().1
}

/// Returns P_x = m_1 (V_1x − v_1x), P_y = m_1 (V_1y − v_1y)   (A22, A23)
pub fn a22_a23<T: Field>(m_1: T, before: Xy<T>, after: Xy<T>) -> Xy<T> {
    (after - before) * m_1
}

/// Returns P_n = P_x cos Γ + P_y sin Γ, P_t = −P_x sin Γ + P_y cos Γ   (A24, A25)
pub fn a24_a25<T: Field>(impulse: Xy<T>, gamma: &CrushPlane<T>) -> Nt<T> {
    Nt {
        n: impulse.x.clone() * gamma.cos.clone() + impulse.y.clone() * gamma.sin.clone(),
        t: -(impulse.x * gamma.sin.clone()) + impulse.y * gamma.cos.clone(),
    }
}

/// Returns m̄ = m_1 m_2/(m_1 + m_2)   (A26)
pub fn a26<T: Field>(m_1: T, m_2: T) -> T {
    m_1.clone() * m_2.clone() / (m_1 + m_2)
}

impl<T: Field> PaperNotation<T> {
    /// Converts two free bodies to the paper's notation: (d_d, d_c) = −r_1, (d_b, d_a) = r_2.
    pub fn of(one: &Body<T>, two: &Body<T>, restitution: T, impulse_ratio: T) -> Self {
        let (one, two) = (one.clone(), two.clone());
        PaperNotation {
            m_1: one.inverse_mass.inv(),
            m_2: two.inverse_mass.inv(),
            i_1: one.inverse_yaw_inertia.inv(),
            i_2: two.inverse_yaw_inertia.inv(),
            v_1n: one.velocity.n,
            v_1t: one.velocity.t,
            v_2n: two.velocity.n,
            v_2t: two.velocity.t,
            omega_1: one.yaw_rate,
            omega_2: two.yaw_rate,
            d_a: two.arm.t,
            d_b: two.arm.n,
            d_c: -one.arm.t,
            d_d: -one.arm.n,
            e: restitution,
            mu: impulse_ratio,
        }
    }

    /// Returns m̄ = m_1 m_2/(m_1 + m_2)   (A26)
    pub fn m_bar(&self) -> T {
        a26(self.m_1.clone(), self.m_2.clone())
    }

    /// Returns m̄ (1 + e) v_m q, the normal impulse, which A1 to A6 have in common.
    fn p_n(&self) -> T {
        self.m_bar() * (T::int(1) + self.e.clone()) * self.a11() * self.a14()
    }

    /// Returns V_1n − v_1n = m̄ (1 + e) v_m q/m_1   (A1)
    pub fn a1(&self) -> T {
        self.p_n() / self.m_1.clone()
    }

    /// Returns V_1t − v_1t = μ m̄ (1 + e) v_m q/m_1   (A2)
    pub fn a2(&self) -> T {
        self.mu.clone() * self.p_n() / self.m_1.clone()
    }

    /// Returns V_2n − v_2n = −m̄ (1 + e) v_m q/m_2   (A3)
    pub fn a3(&self) -> T {
        -(self.p_n() / self.m_2.clone())
    }

    /// Returns V_2t − v_2t = −μ m̄ (1 + e) v_m q/m_2   (A4)
    pub fn a4(&self) -> T {
        -(self.mu.clone() * self.p_n() / self.m_2.clone())
    }

    /// Returns Ω_1 − ω_1 = m̄ (1 + e) v_m (d_c − μ d_d) q/(m_1 k_1²)   (A5)
    pub fn a5(&self) -> T {
        self.p_n() * self.a19() / self.i_1.clone()
    }

    /// Returns Ω_2 − ω_2 = m̄ (1 + e) v_m (d_a − μ d_b) q/(m_2 k_2²)   (A6)
    pub fn a6(&self) -> T {
        self.p_n() * self.a20() / self.i_2.clone()
    }

    /// Returns v_m = (v_2n − d_a ω_2) − (v_1n + d_c ω_1)   (A11, corrected)
    pub fn a11(&self) -> T {
        (self.v_2n.clone() - self.d_a.clone() * self.omega_2.clone()) - (self.v_1n.clone() + self.d_c.clone() * self.omega_1.clone())
    }

    /// Returns V_Cm = V_1n + d_c Ω_1 − V_2n + d_a Ω_2   (A12)
    pub fn a12(&self) -> T {
        let (v_1n, v_2n) = (self.v_1n.clone() + self.a1(), self.v_2n.clone() + self.a3());
        let (omega_1, omega_2) = (self.omega_1.clone() + self.a5(), self.omega_2.clone() + self.a6());
        v_1n + self.d_c.clone() * omega_1 - v_2n + self.d_a.clone() * omega_2
    }

    /// Returns v_Cm = v_1n + d_c ω_1 − v_2n + d_a ω_2   (A13)
    pub fn a13(&self) -> T {
        self.v_1n.clone() + self.d_c.clone() * self.omega_1.clone() - self.v_2n.clone() + self.d_a.clone() * self.omega_2.clone()
    }

    /// Returns q, from 1/q = 1 + m̄ d_a²/I_2 + m̄ d_c²/I_1 − μ (m̄ d_c d_d/I_1 + m̄ d_a d_b/I_2)   (A14)
    pub fn a14(&self) -> T {
        (self.a28() - self.mu.clone() * self.a29()).inv()
    }

    /// Returns d_e = d_c − μ d_d   (A19)
    pub fn a19(&self) -> T {
        self.d_c.clone() - self.mu.clone() * self.d_d.clone()
    }

    /// Returns d_f = d_a − μ d_b   (A20)
    pub fn a20(&self) -> T {
        self.d_a.clone() - self.mu.clone() * self.d_b.clone()
    }

    /// Returns the tangential approach velocity, the numerator of r.
    fn v_t(&self) -> T {
        (self.v_2t.clone() + self.d_b.clone() * self.omega_2.clone()) - (self.v_1t.clone() - self.d_d.clone() * self.omega_1.clone())
    }

    /// Returns r = [(v_2t + d_b ω_2) − (v_1t − d_d ω_1)]/[(v_2n − d_a ω_2) − (v_1n + d_c ω_1)]   (A21, corrected)
    pub fn a21(&self) -> T {
        self.v_t() / self.a11()
    }

    /// Returns μ₀ = [r A + (1 + e) B]/[(1 + e)(1 + C) + r B]   (A27)
    pub fn a27(&self) -> T {
        let (r, both) = (self.a21(), T::int(1) + self.e.clone());
        (r.clone() * self.a28() + both.clone() * self.a29()) / (both * (T::int(1) + self.a30()) + r * self.a29())
    }

    /// Returns A = 1 + m̄ (d_c²/I_1 + d_a²/I_2)   (A28)
    pub fn a28(&self) -> T {
        T::int(1) + self.over_inertia(self.d_c.clone().squared(), self.d_a.clone().squared())
    }

    /// Returns B = m̄ (d_c d_d/I_1 + d_a d_b/I_2)   (A29)
    pub fn a29(&self) -> T {
        self.over_inertia(self.d_c.clone() * self.d_d.clone(), self.d_a.clone() * self.d_b.clone())
    }

    /// Returns C = m̄ (d_d²/I_1 + d_b²/I_2)   (A30)
    pub fn a30(&self) -> T {
        self.over_inertia(self.d_d.clone().squared(), self.d_b.clone().squared())
    }

    fn over_inertia(&self, one: T, two: T) -> T {
        self.m_bar() * (one / self.i_1.clone() + two / self.i_2.clone())
    }

    /// Returns 2 + 2μr − (1 + e) q (1 + μ² + m̄ d_e²/I_1 + m̄ d_f²/I_2), the bracket of Eqs 1 and 2.
    fn bracket(&self) -> T {
        let sum = T::int(1) + self.mu.clone().squared() + self.over_inertia(self.a19().squared(), self.a20().squared());
        T::int(2) + T::int(2) * self.mu.clone() * self.a21() - (T::int(1) + self.e.clone()) * self.a14() * sum
    }

    /// Returns T_L = ½ m̄ q v_m² (1 + e) [2 + 2μr − (1 + e) q (1 + μ² + m̄ d_e²/I_1 + m̄ d_f²/I_2)]   (Eq 1)
    pub fn eq1(&self) -> T {
        (self.m_bar() * self.a14() * self.a11().squared() * (T::int(1) + self.e.clone()) * self.bracket()).half()
    }

    /// Returns (m_i ΔV_i)² = 2 m̄ (1 + e) q (1 + μ²) T_L/[bracket of Eq 1], given T_L; the same for both vehicles   (Eq 2, squared)
    pub fn eq2_squared(&self, energy_loss: T) -> T {
        T::int(2) * self.m_bar() * (T::int(1) + self.e.clone()) * self.a14() * (T::int(1) + self.mu.clone().squared()) * energy_loss
            / self.bracket()
    }

    /// Returns ½ P_n [(v_1Cn − v_2Cn) + (V_1Cn − V_2Cn)], the work of the normal impulse. The paper prints it as E_C, which is its negative   (Eq 7)
    pub fn eq7(&self) -> T {
        eq5(self.p_n(), self.a12(), self.a13())
    }

    /// Returns ½ P_t [(v_1Ct − v_2Ct) + (V_1Ct − V_2Ct)], the work of the tangential impulse. The paper prints it as E_T, which is its negative   (Eq 8)
    pub fn eq8(&self) -> T {
        let p_t = self.mu.clone() * self.p_n();
        let (v_1t, v_2t) = (self.v_1t.clone() + self.a2(), self.v_2t.clone() + self.a4());
        let (omega_1, omega_2) = (self.omega_1.clone() + self.a5(), self.omega_2.clone() + self.a6());
        let after = (v_1t - self.d_d.clone() * omega_1) - (v_2t + self.d_b.clone() * omega_2);
        eq5(p_t, after, -self.v_t())
    }
}
