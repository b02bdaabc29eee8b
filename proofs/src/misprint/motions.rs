//! Two bodies before and after an impact, and quantities computed from their motions alone.

use num_rational::BigRational;
use planar_impact::paper::PaperNotation;
use planar_impact::{Body, Field, Nt};

use super::Input;

pub(super) type Q = BigRational;

pub(super) fn int(n: i32) -> Q {
    Q::int(n)
}

pub(super) fn ratio(n: i32, d: i32) -> Q {
    int(n) / int(d)
}

/// The changes of motion given by the paper's A1–A6.
pub(super) struct Changes {
    one: Nt<Q>,
    two: Nt<Q>,
    yaw_rate_of_one: Q,
    yaw_rate_of_two: Q,
}

impl Changes {
    /// Computes them from the equations used.
    pub(super) fn of(letters: &PaperNotation<Q>) -> Self {
        Changes {
            one: Nt { n: letters.a1(), t: letters.a2() },
            two: Nt { n: letters.a3(), t: letters.a4() },
            yaw_rate_of_one: letters.a5(),
            yaw_rate_of_two: letters.a6(),
        }
    }

    /// Computes them from the same equations with another v_m, to which all of them are proportional.
    pub(super) fn with_v_m(letters: &PaperNotation<Q>, v_m: &Q) -> Self {
        let scale = v_m / letters.a11();
        let Changes { one, two, yaw_rate_of_one, yaw_rate_of_two } = Changes::of(letters);
        Changes {
            one: one * scale.clone(),
            two: two * scale.clone(),
            yaw_rate_of_one: yaw_rate_of_one * &scale,
            yaw_rate_of_two: yaw_rate_of_two * &scale,
        }
    }
}

/// Two bodies, before and after the impact.
pub(super) struct Motions {
    before: [Body<Q>; 2],
    after: [Body<Q>; 2],
}

impl Motions {
    /// Applies the changes given by an equation to the bodies of these symbols.
    pub(super) fn after(letters: &PaperNotation<Q>, changes: Changes) -> Self {
        let before = bodies(letters);
        let [one, two] = before.clone();
        let moved = |body: Body<Q>, velocity: Nt<Q>, yaw_rate: Q| Body {
            velocity: body.velocity.clone() + velocity,
            yaw_rate: &body.yaw_rate + yaw_rate,
            ..body
        };
        let after = [moved(one, changes.one, changes.yaw_rate_of_one), moved(two, changes.two, changes.yaw_rate_of_two)];
        Motions { before, after }
    }

    /// Returns the kinetic energy before minus the kinetic energy after.
    pub(super) fn energy_lost(&self) -> Q {
        let energy = |[one, two]: &[Body<Q>; 2]| kinetic_energy(one) + kinetic_energy(two);
        energy(&self.before) - energy(&self.after)
    }

    /// Returns the relative velocity at C before the impact, body 2 minus body 1.
    pub(super) fn approach(&self) -> Nt<Q> {
        relative(&self.before)
    }

    /// Returns the relative velocity at C after the impact.
    pub(super) fn separation(&self) -> Nt<Q> {
        relative(&self.after)
    }

    /// Returns e by its definition.
    pub(super) fn restitution(&self) -> Q {
        -(self.separation().n / self.approach().n)
    }

    /// Returns the change of body 1's angular momentum about C, which must be zero.
    pub(super) fn angular_momentum_gained_by_one(&self) -> Q {
        angular_momentum(&self.after[0]) - angular_momentum(&self.before[0])
    }

    /// Returns the change of body 2's angular momentum about C, which must be zero.
    pub(super) fn angular_momentum_gained_by_two(&self) -> Q {
        angular_momentum(&self.after[1]) - angular_momentum(&self.before[1])
    }
}

fn kinetic_energy(body: &Body<Q>) -> Q {
    (body.velocity.clone().length_squared() / &body.inverse_mass + body.yaw_rate.clone().squared() / &body.inverse_yaw_inertia).half()
}

fn relative([one, two]: &[Body<Q>; 2]) -> Nt<Q> {
    two.velocity_at_center() - one.velocity_at_center()
}

fn angular_momentum(body: &Body<Q>) -> Q {
    &body.yaw_rate / &body.inverse_yaw_inertia - body.arm.clone().cross(body.velocity.clone()) / &body.inverse_mass
}

/// Returns the bodies of some symbols: (d_d, d_c) = −r₁, (d_b, d_a) = r₂.
fn bodies(letters: &PaperNotation<Q>) -> [Body<Q>; 2] {
    let l = letters.clone();
    [
        Body {
            inverse_mass: l.m_1.recip(),
            inverse_yaw_inertia: l.i_1.recip(),
            arm: Nt { n: -l.d_d, t: -l.d_c },
            velocity: Nt { n: l.v_1n, t: l.v_1t },
            yaw_rate: l.omega_1,
        },
        Body {
            inverse_mass: l.m_2.recip(),
            inverse_yaw_inertia: l.i_2.recip(),
            arm: Nt { n: l.d_b, t: l.d_a },
            velocity: Nt { n: l.v_2n, t: l.v_2t },
            yaw_rate: l.omega_2,
        },
    ]
}

/// Returns two approaching vehicles with yaw rates, in n-t axes, with e = 1/4 and μ = 1/2.
///
/// d₁ = 5 with (cos, sin) of θ₁ + φ₁ − Γ = (4/5, −3/5), and d₂ = 13 with (cos, sin) of θ₂ + φ₂ − Γ = (5/13, 12/13).
pub(super) fn letters() -> PaperNotation<Q> {
    PaperNotation {
        m_1: int(2),
        m_2: int(4),
        i_1: int(3),
        i_2: int(5),
        v_1n: int(-10),
        v_1t: int(1),
        v_2n: int(1),
        v_2t: int(6),
        omega_1: ratio(1, 2),
        omega_2: int(-1),
        d_a: int(12),
        d_b: int(5),
        d_c: int(-3),
        d_d: int(4),
        e: ratio(1, 4),
        mu: ratio(1, 2),
    }
}

/// Returns the numbers of a `PaperNotation` with their names.
pub(super) fn inputs(l: &PaperNotation<Q>) -> Vec<Input> {
    [
        ("m_1", &l.m_1),
        ("I_1", &l.i_1),
        ("v_1n", &l.v_1n),
        ("v_1t", &l.v_1t),
        ("ω_1", &l.omega_1),
        ("d_c", &l.d_c),
        ("d_d", &l.d_d),
        ("m_2", &l.m_2),
        ("I_2", &l.i_2),
        ("v_2n", &l.v_2n),
        ("v_2t", &l.v_2t),
        ("ω_2", &l.omega_2),
        ("d_a", &l.d_a),
        ("d_b", &l.d_b),
        ("e", &l.e),
        ("μ", &l.mu),
    ]
    .map(|(name, value)| Input { name, value: value.clone() })
    .into()
}
