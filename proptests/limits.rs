//! Special cases in which the planar impact becomes simpler: point masses, a barrier, no tangential impulse.

use crate::rational::Rational;
use crate::strategies::{Draw, Fraction, RatioDraw, computable, config, draw};
use num_traits::Inv;
use planar_impact::*;
use proptest::prelude::*;

fn int(n: i32) -> Rational {
    Rational::int(n)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn without_arms_they_are_point_masses(draw in draw()) {
        // Newton: P_n = m̄ (1 + e) v_n; at the critical ratio P_t = m̄ v_t, and no yaw rate changes.
        let mut draw = Draw { ratio: RatioDraw::Critical, law: Law::Brach, ..draw };
        draw.one.impact_center = (0, 0);
        draw.two.impact_center = (0, 0);
        let collision = draw.exact();
        let contact = collision.contact();
        let m_bar = (&contact.one.inverse_mass + &contact.two.inverse_mass).inv();
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
        // The results differ from those of the barrier by terms of the order of the other inverse mass, whose factor
        // may be zero: at rest and 10¹⁵ times as heavy, they differ by less than a billionth.
        let draw = Draw { ratio: RatioDraw::Critical, barrier: false, ..draw };
        let mut collision = draw.exact();
        if let Party::Vehicle(two) = &mut collision.two {
            two.mass = int(100_000) * int(100_000) * int(100_000);
            two.yaw_inertia = two.mass.clone();
            two.motion = Motion::rest();
        }
        let (heavy, wall) = (collision.evaluate(), Collision { two: Party::Barrier, ..draw.exact() }.evaluate());
        let billion = int(1_000_000_000);
        let off = (heavy.impulse.clone() - wall.impulse.clone()).length_squared();
        prop_assert!(off.clone() * &billion * &billion <= wall.impulse.clone().length_squared(), "the impulse converges: {} from {:?}", off, wall.impulse);
        let off = (heavy.loss() - wall.loss()).magnitude();
        prop_assert!(off.clone() * &billion <= wall.kinetic_energy.before, "the loss converges: {} of {}", off, wall.kinetic_energy.before);
    }

    #[test]
    fn a_barrier_is_exact(draw in computable()) {
        let draw = Draw { barrier: true, ..draw };
        prop_assume!(draw.is_computable());
        let impact = draw.exact().evaluate();
        prop_assert_eq!(&impact.two, &Response { after: Motion::rest(), delta_v: Xy::zero(), delta_v_in_vehicle: ForwardLeft::zero() });
        // The entire loss is that of vehicle 1.
        prop_assert_eq!(impact.kinetic_energy.before.clone() - &impact.kinetic_energy.after, impact.loss());
    }
}
