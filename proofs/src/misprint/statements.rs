//! Statements in words that lack their condition, each demonstrated by a collision that the kernel computes.

use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, Impact, ImpulseRatio, Law, Moment, Motion, Party, Vehicle, Xy};

use super::motions::{Q, int, ratio};
use super::{Finding, Input, Misprint};

pub(super) fn all() -> Vec<Misprint> {
    vec![independent_of_plane(), loss_below_one()]
}

/// Returns a heading along x, and the crush plane across it, which has Γ = 0.
fn along_x() -> (Heading<Q>, CrushPlane<Q>) {
    (Heading { cos: int(1), sin: int(0) }, CrushPlane { cos: int(1), sin: int(0) })
}

/// Computes the impact at the critical ratio.
fn impact(one: &Vehicle<Q>, two: Party<Q>, crush_plane: CrushPlane<Q>, restitution: Q) -> Impact<Q> {
    let one = Party::from(one.clone());
    let (impulse_ratio, law, moment) = (ImpulseRatio::Critical, Law::Brach, Moment::None);
    Collision { one, two, crush_plane, restitution, impulse_ratio, law, moment }.evaluate()
}

fn inputs<const N: usize>(given: [(&'static str, Q); N]) -> Vec<Input> {
    given.map(|(name, value)| Input { name, value }).into()
}

fn independent_of_plane() -> Misprint {
    let (heading, straight) = along_x();
    let oblique = CrushPlane { cos: ratio(4, 5), sin: ratio(3, 5) };
    let car = Vehicle {
        mass: int(2),
        yaw_inertia: int(3),
        heading,
        impact_center: ForwardLeft { forward: int(2), left: int(1) },
        motion: Motion { velocity: Xy { x: int(10), y: int(0) }, yaw_rate: int(0) },
    };
    // The energy lost is that of vehicle 1, from its motions before and after; its energy before cancels.
    let after = |plane: &CrushPlane<Q>, e: Q| car.kinetic_energy(impact(&car, Party::Barrier, plane.clone(), e).one.after);
    let difference = |e: Q| after(&straight, e.clone()) - after(&oblique, e);
    let (with_rebound, without) = (difference(ratio(1, 4)), difference(int(0)));
    Misprint {
        place: "after Table 2",
        stated: "the total energy lost is independent of Γ",
        holds: "so it is at e = 0, μ = μ0, the condition that the paper states earlier and not here",
        breaks: "T_L is the kinetic energy before less that after",
        inputs: inputs([
            ("m_1", int(2)),
            ("I_1", int(3)),
            ("v_1x", int(10)),
            ("v_1y", int(0)),
            ("ω_1", int(0)),
            ("r_1x", int(2)),
            ("r_1y", int(1)),
            ("1/m_2", int(0)),
            ("1/I_2", int(0)),
            ("e", ratio(1, 4)),
            ("cos Γ", oblique.cos.clone()),
            ("sin Γ", oblique.sin.clone()),
        ]),
        findings: vec![
            Finding::says("T_L(Γ) − T_L(0) at e", "0", &with_rebound, with_rebound != int(0)),
            Finding::says("the same at e = 0", "0", &without, without == int(0)),
        ],
    }
}

fn loss_below_one() -> Misprint {
    let (heading, plane) = along_x();
    let car = Vehicle {
        mass: int(1),
        yaw_inertia: int(1),
        heading,
        impact_center: ForwardLeft { forward: int(-1), left: int(1) },
        motion: Motion { velocity: Xy { x: int(-3), y: int(-2) }, yaw_rate: int(0) },
    };
    let impact = impact(&car, Party::Barrier, plane, int(1));
    let (before, after) = (car.kinetic_energy(car.motion.clone()), car.kinetic_energy(impact.one.after.clone()));
    let loss = before.clone() - &after;
    Misprint {
        place: "often taken for granted",
        stated: "0 ≤ e ≤ 1 and μ = μ0 gain no energy",
        holds: "true of every approach velocity only if e² ≤ 1 − K_nt²/(K_nn K_tt), which is 3/4 here",
        breaks: "a collision is no source of energy",
        inputs: inputs([
            ("m_1", int(1)),
            ("I_1", int(1)),
            ("v_1x", int(-3)),
            ("v_1y", int(-2)),
            ("ω_1", int(0)),
            ("r_1x", int(-1)),
            ("r_1y", int(1)),
            ("1/m_2", int(0)),
            ("1/I_2", int(0)),
            ("e", int(1)),
            ("cos Γ", int(1)),
            ("sin Γ", int(0)),
        ]),
        findings: vec![
            Finding::says("T after", &format!("≤ {before}"), &after, after > before),
            Finding::says("T_L = T before − T after", "≥ 0", &loss, loss < int(0)),
        ],
    }
}
