//! Each equation that is wrong as printed, on one exact collision: the printed form violates a law of mechanics, the form used satisfies it.

use crate::rational::Rational;
use planar_impact::paper::{self, PaperNotation};
use planar_impact::*;

type Q = Rational;

fn int(n: i32) -> Q {
    Q::int(n)
}

fn fraction(n: i32, d: i32) -> Q {
    int(n) / int(d)
}

/// Returns two vehicles with yaw rates in n–t axes, with arms of the 3–4–5 kind, e = 1/4 and μ = 1/2.
fn collision() -> (Body<Q>, Body<Q>, PaperNotation<Q>) {
    let one = Body {
        inverse_mass: fraction(1, 2),
        inverse_yaw_inertia: fraction(1, 3),
        arm: Nt { n: int(-4), t: int(3) },
        velocity: Nt { n: int(-10), t: int(1) },
        yaw_rate: fraction(1, 2),
    };
    let two = Body {
        inverse_mass: fraction(1, 4),
        inverse_yaw_inertia: fraction(1, 5),
        arm: Nt { n: int(5), t: int(12) },
        velocity: Nt { n: int(1), t: int(6) },
        yaw_rate: int(-1),
    };
    let letters = PaperNotation::of(&one, &two, fraction(1, 4), fraction(1, 2));
    (one, two, letters)
}

/// Returns the motions after the impact according to the printed symbols.
fn after(one: &Body<Q>, two: &Body<Q>, said: [Q; 6]) -> (Body<Q>, Body<Q>) {
    let [v_1n, v_1t, v_2n, v_2t, omega_1, omega_2] = said;
    let moved = |body: &Body<Q>, n: Q, t: Q, yaw: Q| Body {
        velocity: body.velocity.clone() + Nt { n, t },
        yaw_rate: body.yaw_rate.clone() + yaw,
        ..body.clone()
    };
    (moved(one, v_1n, v_1t, omega_1), moved(two, v_2n, v_2t, omega_2))
}

fn changes(letters: &PaperNotation<Q>) -> [Q; 6] {
    [letters.a1(), letters.a2(), letters.a3(), letters.a4(), letters.a5(), letters.a6()]
}

fn kinetic_energy(body: &Body<Q>) -> Q {
    (body.velocity.clone().length_squared() / &body.inverse_mass + body.yaw_rate.clone().squared() / &body.inverse_yaw_inertia).half()
}

/// Computes the angular momentum of one body about the impact center, which an impulse through that point cannot change.
fn angular_momentum(body: &Body<Q>) -> Q {
    body.yaw_rate.clone() / &body.inverse_yaw_inertia - body.arm.clone().cross(body.velocity.clone()) / &body.inverse_mass
}

/// Computes −V_n/v_n at the impact center, from the motions alone.
fn restitution(before: (&Body<Q>, &Body<Q>), after: (&Body<Q>, &Body<Q>)) -> Q {
    let relative = |one: &Body<Q>, two: &Body<Q>| two.velocity_at_center().n - one.velocity_at_center().n;
    -(relative(after.0, after.1) / relative(before.0, before.1))
}

/// Computes the energy lost, from the motions alone.
fn drop_of_energy(before: (&Body<Q>, &Body<Q>), after: (&Body<Q>, &Body<Q>)) -> Q {
    kinetic_energy(before.0) + kinetic_energy(before.1) - kinetic_energy(after.0) - kinetic_energy(after.1)
}

#[test]
fn the_forms_used_keep_every_law() {
    let (one, two, letters) = collision();
    let (one_after, two_after) = after(&one, &two, changes(&letters));
    assert_eq!(angular_momentum(&one), angular_momentum(&one_after));
    assert_eq!(angular_momentum(&two), angular_momentum(&two_after));
    assert_eq!(restitution((&one, &two), (&one_after, &two_after)), letters.e);
    assert_eq!(drop_of_energy((&one, &two), (&one_after, &two_after)), letters.eq1());
    assert_eq!(-(letters.eq7() + letters.eq8()), letters.eq1());
}

#[test]
fn a11_as_printed_breaks_restitution() {
    let (one, two, letters) = collision();
    let printed = (&letters.v_2n - &letters.d_a * &letters.omega_2) - (&letters.v_1n - &letters.d_c * &letters.omega_1);
    assert_ne!(printed, letters.a11());
    // Every change of motion is proportional to v_m.
    let scale = printed / letters.a11();
    let (one_after, two_after) = after(&one, &two, changes(&letters).map(|change| change * &scale));
    assert_ne!(restitution((&one, &two), (&one_after, &two_after)), letters.e);
}

#[test]
fn a16_as_printed_breaks_angular_momentum() {
    // d_1 sin(θ_1 + φ_1 − Γ) is d_c.
    let (one, two, letters) = collision();
    let printed = PaperNotation { d_b: letters.d_c.clone(), ..letters };
    let (_, two_after) = after(&one, &two, changes(&printed));
    assert_ne!(angular_momentum(&two), angular_momentum(&two_after));
}

#[test]
fn a17_as_printed_breaks_angular_momentum() {
    // d_1 cos(θ_1 + φ_1 − Γ) is d_d.
    let (one, two, letters) = collision();
    let printed = PaperNotation { d_c: letters.d_d.clone(), ..letters };
    let (one_after, _) = after(&one, &two, changes(&printed));
    assert_ne!(angular_momentum(&one), angular_momentum(&one_after));
}

#[test]
fn a15_to_a18_with_one_reading_of_phi_turn_vehicle_1_the_wrong_way() {
    // With both bearings from the center of mass to C, the arm of vehicle 1 changes sign, and so does the change of its yaw rate.
    let (one, two, letters) = collision();
    let printed = PaperNotation { d_c: -letters.d_c.clone(), d_d: -letters.d_d.clone(), v_1n: letters.v_1n.clone(), ..letters.clone() };
    let (one_after, _) = after(&one, &two, changes(&printed));
    assert_ne!(angular_momentum(&one), angular_momentum(&one_after));
    let turned_the_other_way = (printed.a5() / printed.a1()) / (letters.a5() / letters.a1());
    assert_eq!(turned_the_other_way, int(-1));
}

#[test]
fn a21_as_printed_breaks_work_energy_and_the_critical_ratio() {
    let (one, two, letters) = collision();
    let printed_r = ((&letters.v_2t - &letters.d_b * &letters.omega_2) - (&letters.v_1t + &letters.d_d * &letters.omega_1)) / letters.a11();
    assert_ne!(printed_r, letters.a21());
    // r enters Eq 1 only through its bracket: T_L changes by m̄ q v_m² (1 + e) μ Δr, and no longer equals the energy lost.
    let share = letters.m_bar() * letters.a14() * letters.a11().squared() * (int(1) + &letters.e) * &letters.mu;
    let printed_loss = letters.eq1() + share * (&printed_r - letters.a21());
    let (one_after, two_after) = after(&one, &two, changes(&letters));
    assert_ne!(printed_loss, drop_of_energy((&one, &two), (&one_after, &two_after)));
    // With it, μ₀ from A27 leaves the bodies sliding.
    let critical = |r: Q| {
        let both = int(1) + &letters.e;
        (&r * letters.a28() + &both * letters.a29()) / (both * (int(1) + letters.a30()) + r * letters.a29())
    };
    let sliding = |mu: Q| {
        let at = PaperNotation { mu, ..letters.clone() };
        let (one_after, two_after) = after(&one, &two, changes(&at));
        two_after.velocity_at_center().t - one_after.velocity_at_center().t
    };
    assert_eq!(sliding(critical(letters.a21())), int(0));
    assert_ne!(sliding(critical(printed_r)), int(0));
}

#[test]
fn equations_7_and_8_as_printed_have_the_sign_of_works() {
    // E_C and E_T are energy losses, so their sum is T_L > 0; the printed quantities are the works, whose sum is −T_L.
    let (_, _, letters) = collision();
    assert!(letters.eq1() > int(0));
    assert_eq!(letters.eq7() + letters.eq8(), -letters.eq1());
}

#[test]
fn equation_9_as_printed_counts_the_energy_of_the_rebound() {
    // One test with restitution e loses ½ m (1 − e²) v²: the printed form has the full ½ m v².
    let (speed, e, mass) = (int(10), fraction(1, 2), int(2));
    let lost = (&mass * &speed * &speed - &mass * (&e * &speed) * (&e * &speed)).half();
    let used = crush::equivalent_energy_speed_squared([(speed.clone(), e)]);
    assert_eq!((&mass * used).half(), lost);
    assert_ne!((&mass * &speed * &speed).half(), lost);
}

#[test]
fn equation_2_as_printed_is_right() {
    let (_, _, letters) = collision();
    let impulse = Nt { n: letters.a1() * &letters.m_1, t: letters.a2() * &letters.m_1 };
    assert_eq!(letters.eq2_squared(letters.eq1()), impulse.length_squared());
    assert_eq!(paper::a26(int(2), int(4)), fraction(4, 3));
}
