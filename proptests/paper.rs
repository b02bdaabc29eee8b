//! The paper's own equations compared with the matrix form: equality in rationals, for every numbered equation of a collision.

use crate::rational::Rational;
use crate::strategies::{Draw, OrReject, computable, config};
use num_traits::Inv;
use planar_impact::paper::{self, PaperNotation};
use planar_impact::*;
use proptest::prelude::*;

fn int(n: i32) -> Rational {
    Rational::int(n)
}

/// A collision of two vehicles that the paper's equations can express: they approach each other along the normal.
struct Both {
    collision: Collision<Rational>,
    contact: Contact<Rational>,
    impact: Impact<Rational>,
    letters: PaperNotation<Rational>,
}

fn both(draw: Draw) -> Option<Both> {
    let draw = Draw { barrier: false, law: Law::Brach, ..draw };
    if !draw.is_computable() {
        return None;
    }
    let collision = draw.exact();
    let contact = collision.contact();
    let impact = collision.evaluate();
    if contact.approach.n == int(0) || impact.impulse.n == int(0) {
        return None;
    }
    let letters = PaperNotation::of(&contact.one, &contact.two, collision.restitution.clone(), impact.impulse_ratio());
    Some(Both { collision, contact, impact, letters })
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a1_to_a6_are_the_changes_of_motion(draw in computable()) {
        let Both { collision, contact, impact, letters } = both(draw).or_reject("the paper has no equations")?;
        let change = |response: &Response<Rational>| collision.crush_plane.to_contact(response.delta_v.clone());
        prop_assert_eq!(change(&impact.one), Nt { n: letters.a1(), t: letters.a2() });
        prop_assert_eq!(change(&impact.two), Nt { n: letters.a3(), t: letters.a4() });
        prop_assert_eq!(&impact.one.after.yaw_rate, &(contact.one.yaw_rate + letters.a5()));
        prop_assert_eq!(&impact.two.after.yaw_rate, &(contact.two.yaw_rate + letters.a6()));
    }

    #[test]
    fn a7_a8_a11_to_a13_are_the_relative_velocities(draw in computable()) {
        let Both { collision, contact, impact, letters } = both(draw).or_reject("the paper has no equations")?;
        prop_assert_eq!(&letters.a11(), &contact.approach.n);
        prop_assert_eq!(&letters.a13(), &-contact.approach.n.clone());
        prop_assert_eq!(&letters.a12(), &-impact.separation.n.clone());
        prop_assert_eq!(paper::a7(letters.a12(), letters.a13()), collision.restitution.clone());
        prop_assert_eq!(paper::a8(impact.impulse.clone()), letters.mu);
    }

    #[test]
    fn a14_a19_to_a21_and_a26_to_a30_are_the_compliance(draw in computable()) {
        let Both { contact, impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        let k = &contact.compliance;
        let m_bar = letters.m_bar();
        prop_assert_eq!(m_bar.clone() * (&contact.one.inverse_mass + &contact.two.inverse_mass), int(1));
        prop_assert_eq!(&letters.a28(), &(m_bar.clone() * k.nn()));
        prop_assert_eq!(&letters.a29(), &-(m_bar.clone() * k.nt()));
        prop_assert_eq!(&(int(1) + letters.a30()), &(m_bar.clone() * k.tt()));
        prop_assert_eq!(letters.a14() * m_bar * k.along_ratio(letters.mu.clone()), int(1));
        prop_assert_eq!(letters.a21(), contact.approach.t.clone() / &contact.approach.n);
        prop_assert_eq!(letters.a19() * &contact.one.inverse_yaw_inertia * &impact.impulse.n, letters.a5());
        prop_assert_eq!(letters.a20() * &contact.two.inverse_yaw_inertia * &impact.impulse.n, letters.a6());
    }

    #[test]
    fn a27_is_the_critical_ratio(draw in computable()) {
        let Both { impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        prop_assume!(impact.critical_impulse.n != int(0));
        prop_assert_eq!(letters.a27(), impact.critical_impulse_ratio());
    }

    #[test]
    fn a22_to_a25_are_the_impulse(draw in computable()) {
        let Both { collision, impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        let before = collision.one.vehicle().expect("a vehicle").motion.velocity.clone();
        let on_ground = paper::a22_a23(letters.m_1, before, impact.one.after.velocity.clone());
        prop_assert_eq!(&on_ground, &impact.impulse_on_ground);
        prop_assert_eq!(paper::a24_a25(on_ground, &collision.crush_plane), impact.impulse);
    }

    #[test]
    fn equation_1_is_the_loss(draw in computable()) {
        let Both { impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        prop_assert_eq!(letters.eq1(), impact.loss());
    }

    #[test]
    fn equation_2_is_the_change_of_velocity(draw in computable()) {
        // Independent of the crate's ΔV = P/m: Eq 2 computes it from the energy.
        let Both { impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        prop_assume!(impact.loss() != int(0));
        let squared = letters.eq2_squared(impact.loss());
        for (response, mass) in [(&impact.one, &letters.m_1), (&impact.two, &letters.m_2)] {
            prop_assert_eq!(&squared, &(response.delta_v.clone().length_squared() * mass * mass));
        }
    }

    #[test]
    fn equations_5_to_8_are_the_works(draw in computable()) {
        let Both { contact, impact, letters, .. } = both(draw).or_reject("the paper has no equations")?;
        prop_assert_eq!(&letters.eq7(), &impact.work.n);
        prop_assert_eq!(&letters.eq8(), &impact.work.t);
        let after = [&contact.one, &contact.two].map(|body| {
            let sign = if std::ptr::eq(body, &raw const contact.one) { int(1) } else { int(-1) };
            let impulse = impact.impulse.clone() * sign;
            Body { velocity: body.velocity.clone() + body.delta_v(impulse.clone()), yaw_rate: body.yaw_rate.clone() + body.delta_yaw_rate(impulse), ..body.clone() }
        });
        let before = [contact.one.velocity_at_center(), contact.two.velocity_at_center()];
        let after = after.map(|body| body.velocity_at_center());
        prop_assert_eq!(paper::eq6(impact.impulse.clone(), before, after), -impact.loss());
    }

    #[test]
    fn a15_to_a18_are_the_arms(draw in computable(), theta in -3.0..3.0_f64, gamma in -3.0..3.0_f64) {
        // With angles, therefore in floats: φ_1 points from C to the center of mass of vehicle 1, φ_2 from that of vehicle 2 to C.
        let mut collision = Draw { barrier: false, ..draw }.of::<f64>();
        for party in [&mut collision.one, &mut collision.two] {
            if let Party::Vehicle(vehicle) = party {
                vehicle.heading = Heading::from_angle(theta);
            }
        }
        collision.crush_plane = CrushPlane::from_angle(gamma);
        let contact = collision.contact();
        let letters = PaperNotation::of(&contact.one, &contact.two, 0.0, 0.0);
        let [c_1, c_2] = [&collision.one, &collision.two].map(|party| party.vehicle().expect("a vehicle").impact_center);
        let (d_1, phi_1) = (c_1.length(), (-c_1.left).atan2(-c_1.forward));
        let (d_2, phi_2) = (c_2.length(), c_2.left.atan2(c_2.forward));
        let close = |a: f64, b: f64| (a - b).abs() < 1e-13;
        prop_assert!(close(paper::a15(d_2, theta, phi_2, gamma), letters.d_a));
        prop_assert!(close(paper::a16(d_2, theta, phi_2, gamma), letters.d_b));
        prop_assert!(close(paper::a17(d_1, theta, phi_1, gamma), letters.d_c));
        prop_assert!(close(paper::a18(d_1, theta, phi_1, gamma), letters.d_d));
    }

    #[test]
    fn a9_a10_are_the_inertias(mass in 1..=40_i32, radius in 1..=9_i32) {
        let inertia = paper::a9_a10(int(mass), int(radius));
        let spinning = Vehicle {
            mass: int(mass),
            yaw_inertia: inertia,
            heading: Heading { cos: int(1), sin: int(0) },
            impact_center: ForwardLeft::zero(),
            motion: Motion::rest(),
        };
        // The entire mass at the radius of gyration has the same energy.
        let energy = spinning.kinetic_energy(Motion { velocity: Xy::zero(), yaw_rate: int(1) });
        prop_assert_eq!(energy, (int(mass) * int(radius) * int(radius)).half());
    }
}

/// An exact collision with every symbol known: the loss from momentum alone is 18819/7442.
#[test]
fn one_collision_by_its_fractions() {
    let fraction = |n: i32, d: i32| int(n) / int(d);
    let body = |mass, inertia, velocity: (i32, i32), yaw_rate, arm: (Rational, Rational)| {
        let plane = CrushPlane { cos: fraction(4, 5), sin: fraction(3, 5) };
        Body {
            inverse_mass: int(mass).inv(),
            inverse_yaw_inertia: int(inertia).inv(),
            arm: plane.to_contact(Xy { x: arm.0, y: arm.1 }),
            velocity: plane.to_contact(Xy { x: int(velocity.0), y: int(velocity.1) }),
            yaw_rate,
        }
    };
    let one = body(2, 3, (-10, 1), fraction(1, 2), (int(-2), int(1)));
    let two = body(4, 5, (1, 6), int(-1), (fraction(3, 2), fraction(1, 2)));
    let letters = PaperNotation::of(&one, &two, fraction(1, 4), fraction(1, 2));
    let contact = Contact::between(one, two);
    let impulse = law::impulse_at_ratio(&contact.compliance, fraction(5, 4) * &contact.approach.n, fraction(1, 2));
    assert_eq!(contact.loss(impulse.clone()), letters.eq1());
    assert_eq!(letters.eq2_squared(letters.eq1()), impulse.length_squared());
}
