//! Where the planar impact becomes a simpler one: point masses, a barrier, an absent tangential impulse.

use crate::strategies::{Draw, Fraction, RatioDraw, computable, config, draw};
use num_rational::BigRational;
use planar_impact::*;
use proptest::prelude::*;

fn int(n: i32) -> BigRational {
    BigRational::int(n)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn without_arms_they_are_point_masses(draw in draw()) {
        // Newton: P_n = m̄ (1 + e) v_n, at the critical ratio P_t = m̄ v_t, and no yaw rate changes.
        let mut draw = Draw { ratio: RatioDraw::Critical, law: Law::Brach, ..draw };
        draw.one.impact_center = (0, 0);
        draw.two.impact_center = (0, 0);
        let collision = draw.exact();
        let contact = collision.contact();
        let m_bar = (&contact.one.inverse_mass + &contact.two.inverse_mass).recip();
        let impact = collision.evaluate();
        let v = &impact.approach;
        prop_assert_eq!(&impact.impulse.n, &(m_bar.clone() * (int(1) + &collision.restitution) * &v.n));
        prop_assert_eq!(&impact.impulse.t, &(m_bar.clone() * &v.t));
        prop_assert_eq!(impact.one.after.yaw_rate.clone(), int(draw.one.yaw_rate));
        let kept = int(1) - collision.restitution.clone() * &collision.restitution;
        prop_assert_eq!(impact.loss(), m_bar * (kept * &v.n * &v.n + &v.t * &v.t).half());
    }

    #[test]
    fn no_tangential_impulse_and_full_restitution_lose_nothing(draw in draw()) {
        let draw = Draw { restitution: Fraction(1, 1), ratio: RatioDraw::Given(Fraction(0, 1)), ..draw };
        let impact = draw.exact().evaluate();
        prop_assert_eq!(impact.loss(), int(0));
        prop_assert_eq!(impact.impulse.t, int(0));
    }

    #[test]
    fn a_barrier_is_the_limit_of_ever_heavier_vehicles(draw in draw()) {
        // Each thousandfold mass and inertia of vehicle 2 at rest brings every result nearly a thousand times closer to the barrier's.
        let draw = Draw { ratio: RatioDraw::Critical, barrier: false, ..draw };
        let heavy = |factor: i32| {
            let mut collision = draw.exact();
            if let Party::Vehicle(two) = &mut collision.two {
                two.mass = int(factor);
                two.yaw_inertia = int(factor);
                two.motion = Motion::rest();
            }
            collision.evaluate()
        };
        let wall = Collision { two: Party::Barrier, ..draw.exact() }.evaluate();
        let distance = |impact: &Impact<BigRational>| {
            let dp = impact.impulse.clone() - wall.impulse.clone();
            (dp.length_squared(), (impact.loss() - wall.loss()).magnitude())
        };
        let ((far, far_loss), (near, near_loss)) = (distance(&heavy(1_000_000)), distance(&heavy(1_000_000_000)));
        prop_assert!(near.clone() * int(900_000) <= far, "the impulse converges: {} after {}", near, far);
        prop_assert!(near_loss.clone() * int(900) <= far_loss, "the loss converges: {} after {}", near_loss, far_loss);
    }

    #[test]
    fn a_barrier_is_exact(draw in computable()) {
        let draw = Draw { barrier: true, ..draw };
        prop_assume!(draw.is_computable());
        let impact = draw.exact().evaluate();
        prop_assert_eq!(&impact.two, &Response { after: Motion::rest(), delta_v: Xy::zero(), delta_v_in_vehicle: ForwardLeft::zero() });
        // All of the loss is that of vehicle 1.
        prop_assert_eq!(impact.kinetic_energy.before.clone() - &impact.kinetic_energy.after, impact.loss());
    }
}
