//! Equations that are wrong as printed, with the printed form of each.

use planar_impact::Field;
use planar_impact::crush::equivalent_energy_speed_squared;
use planar_impact::paper::PaperNotation;

use super::motions::{Changes, Motions, Q, inputs, int, letters, ratio};
use super::{Finding, Input, Misprint};

pub(super) fn all() -> Vec<Misprint> {
    vec![eqs_7_8(), eq_9(), a11(), a16(), a17(), a15_to_a18(), a21()]
}

/// The printed forms, in the paper's symbols.
mod printed {
    use super::{Field, PaperNotation, Q, int};

    /// v_m = (v_2n − d_a ω_2) − (v_1n − d_c ω_1)
    pub(super) fn a11(l: &PaperNotation<Q>) -> Q {
        (&l.v_2n - &l.d_a * &l.omega_2) - (&l.v_1n - &l.d_c * &l.omega_1)
    }

    /// r = [(v_2t − d_b ω_2) − (v_1t + d_d ω_1)]/[(v_2n − d_a ω_2) − (v_1n + d_c ω_1)]
    pub(super) fn a21(l: &PaperNotation<Q>) -> Q {
        let above = (&l.v_2t - &l.d_b * &l.omega_2) - (&l.v_1t + &l.d_d * &l.omega_1);
        let below = (&l.v_2n - &l.d_a * &l.omega_2) - (&l.v_1n + &l.d_c * &l.omega_1);
        above / below
    }

    /// EES² = Σ v_in²
    pub(super) fn eq_9(speeds: &[Q]) -> Q {
        speeds.iter().fold(int(0), |sum, speed| sum + speed.clone().squared())
    }
}

/// Computes T_L by Eq 1, with v_m and r in either form.
fn eq_1(l: &PaperNotation<Q>, v_m: &Q, r: &Q) -> Q {
    let (one, q) = (int(1), l.a14());
    let over_inertias = l.a19().squared() / &l.i_1 + l.a20().squared() / &l.i_2;
    let sum = &one + l.mu.clone().squared() + l.m_bar() * over_inertias;
    let bracket = int(2) + int(2) * &l.mu * r - (&one + &l.e) * &q * sum;
    (l.m_bar() * q * v_m * v_m * (one + &l.e) * bracket).half()
}

/// Computes μ0 by A27, with r in either form.
fn a27(l: &PaperNotation<Q>, r: &Q) -> Q {
    let both = int(1) + &l.e;
    (r * l.a28() + &both * l.a29()) / (&both * (int(1) + l.a30()) + r * l.a29())
}

fn a11() -> Misprint {
    let l = letters();
    let (printed, right) = (printed::a11(&l), l.a11());
    let by_printed = Motions::after(&l, Changes::with_v_m(&l, &printed));
    let by_right = Motions::after(&l, Changes::of(&l));
    // The difference of Eq 1 from the energy loss of the motions of A1–A6, with the same v_m in both.
    let surplus = |v_m: &Q, motions: &Motions| eq_1(&l, v_m, &l.a21()) - motions.energy_lost();
    Misprint {
        place: "A11",
        stated: "v_m = (v_2n − d_a ω_2) − (v_1n − d_c ω_1)",
        holds: "v_m = (v_2n − d_a ω_2) − (v_1n + d_c ω_1), which is −v_Cm of A13",
        breaks: "e = −V_Cm/v_Cm, and T_L is the kinetic energy before less that after",
        inputs: inputs(&l),
        findings: vec![
            Finding::values("v_m", printed.clone(), &right, &by_right.approach().n),
            Finding::values("e = −V_Cm/v_Cm after A1–A6", by_printed.restitution(), &by_right.restitution(), &l.e),
            Finding::values("T_L of Eq 1 − energy lost", surplus(&printed, &by_printed), &surplus(&right, &by_right), &int(0)),
        ],
    }
}

/// Returns the inputs, with those of A15–A18 instead of the quantities computed from them.
fn inputs_by_bearings(l: &PaperNotation<Q>) -> Vec<Input> {
    let bearings = [
        ("d_1", int(5)),
        ("cos(θ_1 + φ_1 − Γ)", ratio(4, 5)),
        ("sin(θ_1 + φ_1 − Γ)", ratio(-3, 5)),
        ("d_2", int(13)),
        ("cos(θ_2 + φ_2 − Γ)", ratio(5, 13)),
        ("sin(θ_2 + φ_2 − Γ)", ratio(12, 13)),
    ];
    let mut all = inputs(l);
    all.retain(|input| !["d_a", "d_b", "d_c", "d_d"].contains(&input.name));
    all.extend(bearings.map(|(name, value)| Input { name, value }));
    all
}

fn a16() -> Misprint {
    let l = letters();
    let (printed, right) = (int(5) * ratio(-3, 5), int(13) * ratio(5, 13));
    let at = |d_b: &Q| Motions::after(&l, Changes::of(&PaperNotation { d_b: d_b.clone(), ..l.clone() }));
    Misprint {
        place: "A16",
        stated: "d_b = d_1 sin(θ_1 + φ_1 − Γ)",
        holds: "d_b = d_2 cos(θ_2 + φ_2 − Γ)",
        breaks: "the angular momentum of vehicle 2 about the impact center",
        inputs: inputs_by_bearings(&l),
        findings: vec![
            Finding::values("d_b", printed.clone(), &right, &l.d_b),
            Finding::values(
                "angular momentum gained by 2",
                at(&printed).angular_momentum_gained_by_two(),
                &at(&right).angular_momentum_gained_by_two(),
                &int(0),
            ),
        ],
    }
}

fn a17() -> Misprint {
    let l = letters();
    let (printed, right) = (int(5) * ratio(4, 5), int(5) * ratio(-3, 5));
    let at = |d_c: &Q| Motions::after(&l, Changes::of(&PaperNotation { d_c: d_c.clone(), ..l.clone() }));
    Misprint {
        place: "A17",
        stated: "d_c = d_1 cos(θ_1 + φ_1 − Γ), the same as A18",
        holds: "d_c = d_1 sin(θ_1 + φ_1 − Γ)",
        breaks: "the angular momentum of vehicle 1 about the impact center",
        inputs: inputs_by_bearings(&l),
        findings: vec![
            Finding::values("d_c", printed.clone(), &right, &l.d_c),
            Finding::values(
                "angular momentum gained by 1",
                at(&printed).angular_momentum_gained_by_one(),
                &at(&right).angular_momentum_gained_by_one(),
                &int(0),
            ),
        ],
    }
}

fn a15_to_a18() -> Misprint {
    let l = letters();
    // If both are read the same way, φ_1 turns by 180° and the arm of vehicle 1 changes sign.
    let read_alike = PaperNotation { d_c: -&l.d_c, d_d: -&l.d_d, ..l.clone() };
    let turn = |l: &PaperNotation<Q>| l.a5() / l.a1();
    let at = |by: &PaperNotation<Q>| Motions::after(&l, Changes::of(by));
    // (r × P)/I over P_n/m, from the arm r_1 = −(d_d, d_c).
    let demanded = (-&l.d_d * &l.mu + &l.d_c) / &l.i_1 * &l.m_1;
    Misprint {
        place: "A15–A18",
        stated: "one meaning of φ for both vehicles, that of φ_2",
        holds: "φ_1 points from C to the center of mass, φ_2 from the center of mass to C",
        breaks: "the angular momentum of vehicle 1 about the impact center: it turns the wrong way",
        inputs: inputs_by_bearings(&l),
        findings: vec![
            Finding::values("(Ω_1 − ω_1)/(V_1n − v_1n)", turn(&read_alike), &turn(&l), &demanded),
            Finding::values(
                "angular momentum gained by 1",
                at(&read_alike).angular_momentum_gained_by_one(),
                &at(&l).angular_momentum_gained_by_one(),
                &int(0),
            ),
        ],
    }
}

fn a21() -> Misprint {
    let l = letters();
    let (printed, right) = (printed::a21(&l), l.a21());
    let motions = Motions::after(&l, Changes::of(&l));
    let demanded = motions.approach().t / motions.approach().n;
    let loss = |r: &Q| eq_1(&l, &l.a11(), r);
    let sliding = |r: &Q| {
        let critical = PaperNotation { mu: a27(&l, r), ..l.clone() };
        Motions::after(&critical, Changes::of(&critical)).separation().t
    };
    Misprint {
        place: "A21",
        stated: "r = [(v_2t − d_b ω_2) − (v_1t + d_d ω_1)]/v_m",
        holds: "r = [(v_2t + d_b ω_2) − (v_1t − d_d ω_1)]/v_m",
        breaks: "T_L is the kinetic energy before less that after, and at μ0 sliding ends",
        inputs: inputs(&l),
        findings: vec![
            Finding::values("r", printed.clone(), &right, &demanded),
            Finding::values("T_L of Eq 1, at μ", loss(&printed), &loss(&right), &motions.energy_lost()),
            Finding::values("V_2Ct − V_1Ct at μ0 of A27", sliding(&printed), &sliding(&right), &int(0)),
        ],
    }
}

fn eqs_7_8() -> Misprint {
    let l = letters();
    let motions = Motions::after(&l, Changes::of(&l));
    // The impulse on vehicle 1 absorbs energy at the rate of the approach: its part is ½ P (v + V), with v of vehicle
    // 2 minus v of vehicle 1.
    let taken = |impulse: Q, before: Q, after: Q| (impulse * (before + after)).half();
    let p_n = l.a1() * &l.m_1;
    let p_t = l.a2() * &l.m_1;
    let (v, vv) = (motions.approach(), motions.separation());
    let (normal, tangential) = (taken(p_n, v.n, vv.n), taken(p_t, v.t, vv.t));
    Misprint {
        place: "Eqs 7, 8",
        stated: "E_C = ½ P_n [(v_1Cn − v_2Cn) + (V_1Cn − V_2Cn)], E_T alike with t",
        holds: "E_C = −½ P_n [(v_1Cn − v_2Cn) + (V_1Cn − V_2Cn)], E_T alike with t: what is printed is W_n and W_t",
        breaks: "E_C + E_T = T_L, the kinetic energy before less that after",
        inputs: inputs(&l),
        findings: vec![
            Finding::values("E_C", l.eq7(), &-l.eq7(), &normal),
            Finding::values("E_T", l.eq8(), &-l.eq8(), &tangential),
            Finding::values("E_C + E_T", l.eq7() + l.eq8(), &-(l.eq7() + l.eq8()), &motions.energy_lost()),
        ],
    }
}

fn eq_9() -> Misprint {
    let (mass, speeds, restitutions) = (int(2), [int(10), int(12)], [ratio(1, 2), ratio(1, 3)]);
    let tests = || speeds.iter().cloned().zip(restitutions.iter().cloned());
    let right = equivalent_energy_speed_squared(tests());
    let lost = tests().fold(int(0), |sum, (v, e)| {
        let rebound = &e * &v;
        sum + (&mass * (v.squared() - rebound.squared())).half()
    });
    let energy = |squared: &Q| (&mass * squared).half();
    let printed = printed::eq_9(&speeds);
    let [v_1, v_2] = speeds.clone();
    let [e_1, e_2] = restitutions.clone();
    let given = [("m", mass.clone()), ("v_1n", v_1), ("e_1", e_1), ("v_2n", v_2), ("e_2", e_2)];
    Misprint {
        place: "Eq 9",
        stated: "EES² = Σ v_in²",
        holds: "EES² = Σ (1 − e_i²) v_in², as the paper's own tables have it",
        breaks: "½ m EES² is the energy that a series of central barrier tests has lost",
        inputs: given.map(|(name, value)| Input { name, value }).into(),
        findings: vec![
            Finding::values("EES²", printed.clone(), &right, &(int(2) * &lost / &mass)),
            Finding::values("½ m EES²", energy(&printed), &energy(&right), &lost),
        ],
    }
}
