//! Momentum, restitution and the impulse ratio.

use crate::rational::Rational;
use crate::strategies::{RatioDraw, computable, config, draw};
use planar_impact::*;
use proptest::prelude::*;

fn int(n: i32) -> Rational {
    Rational::int(n)
}

/// Returns the change of a vehicle's momentum.
fn momentum_gained(vehicle: &Vehicle<Rational>, after: &Motion<Rational>) -> Xy<Rational> {
    (after.velocity.clone() - vehicle.motion.velocity.clone()) * vehicle.mass.clone()
}

/// Returns the change of a vehicle's angular momentum about the impact center: that of its spin, and that of its
/// center of mass, which is at −r.
fn angular_momentum_gained(vehicle: &Vehicle<Rational>, after: &Motion<Rational>) -> Rational {
    let arm = vehicle.heading.to_ground(vehicle.impact_center.clone());
    let spin = vehicle.yaw_inertia.clone() * (after.yaw_rate.clone() - vehicle.motion.yaw_rate.clone());
    spin - arm.cross(momentum_gained(vehicle, after))
}

/// Returns the velocity of the impact center on a vehicle, in ground axes.
fn at_center(vehicle: &Vehicle<Rational>, motion: &Motion<Rational>) -> Xy<Rational> {
    let arm = vehicle.heading.to_ground(vehicle.impact_center.clone());
    motion.velocity.clone() + arm.quarter_turn() * motion.yaw_rate.clone()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn linear_momentum_is_exchanged(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        for (party, response, sign) in [(&collision.one, &impact.one, 1), (&collision.two, &impact.two, -1)] {
            if let Some(vehicle) = party.vehicle() {
                let gained = momentum_gained(vehicle, &response.after);
                prop_assert_eq!(&gained, &(impact.impulse_on_ground.clone() * int(sign)));
                prop_assert_eq!(gained, response.delta_v.clone() * vehicle.mass.clone());
                prop_assert_eq!(&vehicle.heading.to_ground(response.delta_v_in_vehicle.clone()), &response.delta_v);
            }
        }
    }

    #[test]
    fn angular_momentum_of_each_body_about_the_impact_center_is_conserved(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        for (party, response) in [(&collision.one, &impact.one), (&collision.two, &impact.two)] {
            if let Some(vehicle) = party.vehicle() {
                prop_assert_eq!(angular_momentum_gained(vehicle, &response.after), int(0));
            }
        }
    }

    #[test]
    fn a_moment_impulse_is_the_change_of_angular_momentum(draw in computable(), moment in -9..=9_i32) {
        let collision = Collision { moment: Moment::Given(int(moment)), ..draw.exact() };
        let contact = collision.contact();
        let (impulse, given) = (collision.contact().common_velocity_impulse(), Some(int(moment)));
        let impact = collision.impact_of(&contact, impulse, given);
        for (party, response, sign) in [(&collision.one, &impact.one, 1), (&collision.two, &impact.two, -1)] {
            if let Some(vehicle) = party.vehicle() {
                prop_assert_eq!(angular_momentum_gained(vehicle, &response.after), int(sign * moment));
            }
        }
    }

    #[test]
    fn normal_separation_is_restitution_of_the_approach(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        prop_assert_eq!(impact.separation.n, -(collision.restitution * impact.approach.n));
    }

    #[test]
    fn the_impulse_has_the_ratio_asked_for(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() }.evaluate().impulse;
        match &collision.impulse_ratio {
            ImpulseRatio::Critical => prop_assert_eq!(impact.impulse, sticking),
            ImpulseRatio::Given(ratio) => prop_assert_eq!(impact.impulse.t, ratio * impact.impulse.n),
            ImpulseRatio::OfCritical(fraction) => prop_assert_eq!(impact.impulse.t * sticking.n, fraction * sticking.t * impact.impulse.n),
            ImpulseRatio::LimitedByFriction(friction) => {
                prop_assume!(impact.approach.n != int(0));
                let (n, t) = (impact.impulse.n.clone(), impact.impulse.t.clone());
                let inside = t.clone() * t.clone() <= friction * friction * &n * &n;
                prop_assert!(inside, "the impulse lies in the friction cone");
                let pushes = n.clone() * &impact.approach.n > int(0);
                prop_assert!(pushes, "a limited impulse never pulls");
                let slides = impact.impulse != sticking;
                prop_assert!(!slides || t.clone() * t == friction * friction * &n * &n, "and on its edge when it slides");
            }
        }
    }

    #[test]
    fn sliding_ends_at_the_critical_ratio(draw in draw()) {
        let collision = Collision { impulse_ratio: ImpulseRatio::Critical, ..draw.exact() };
        let impact = collision.evaluate();
        match collision.law {
            Law::Brach => prop_assert_eq!(&impact.separation.t, &int(0)),
            Law::KudlichSlibar => {
                prop_assert_eq!(&impact.separation.t, &-(collision.restitution.clone() * &impact.approach.t));
            }
        }
        // The critical ratio is reported whatever the law and the ratio, and has the same effect if given as a number.
        if impact.critical_impulse.n != int(0) && impact.approach.n != int(0) && draw.law == Law::Brach {
            let given = Collision { impulse_ratio: ImpulseRatio::Given(impact.critical_impulse_ratio()), ..collision };
            prop_assert_eq!(given.evaluate().impulse, impact.impulse);
        }
    }

    #[test]
    fn friction_alone_chooses_between_sliding_and_sticking(draw in draw()) {
        // With any amount of friction, the limited impulse equals the sticking one if that is compressive and inside the friction cone.
        let collision = draw.exact();
        let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() }.evaluate();
        if sticking.impulse.n.clone() * &sticking.approach.n > int(0) {
            let enough = (&sticking.impulse.t / &sticking.impulse.n).magnitude();
            let limited = Collision { impulse_ratio: ImpulseRatio::LimitedByFriction(enough.clone()), ..collision.clone() };
            prop_assert_eq!(limited.evaluate().impulse, sticking.impulse.clone());
            let less = Collision { impulse_ratio: ImpulseRatio::LimitedByFriction(enough.clone().half()), ..collision };
            prop_assert_eq!(less.evaluate().impulse == sticking.impulse, enough == int(0));
        }
    }

    #[test]
    fn relative_velocities_are_those_of_the_motions(draw in computable()) {
        let collision = draw.exact();
        let impact = collision.evaluate();
        let at = |party: &Party<Rational>, motion: Option<&Motion<Rational>>| {
            party.vehicle().map_or_else(Xy::zero, |vehicle| at_center(vehicle, motion.unwrap_or(&vehicle.motion)))
        };
        let approach = at(&collision.two, None) - at(&collision.one, None);
        let separation = at(&collision.two, Some(&impact.two.after)) - at(&collision.one, Some(&impact.one.after));
        prop_assert_eq!(collision.crush_plane.to_contact(approach), impact.approach);
        prop_assert_eq!(collision.crush_plane.to_contact(separation), impact.separation);
    }

    #[test]
    fn determinant_is_that_of_the_matrix(draw in draw()) {
        let k = draw.exact().contact().compliance;
        prop_assert_eq!(k.determinant().clone(), k.nn() * k.tt() - k.nt() * k.nt());
        prop_assert!(k.determinant() > &int(0));
    }

    #[test]
    fn impulse_for_undoes_yield_to(draw in draw(), n in -9..=9_i32, t in -9..=9_i32) {
        let k = draw.exact().contact().compliance;
        let impulse = Nt { n: int(n), t: int(t) };
        prop_assert_eq!(k.impulse_for(k.velocity_change(impulse.clone())), impulse);
    }

    #[test]
    fn with_a_given_moment_sliding_still_ends_at_the_critical_ratio(draw in draw(), moment in -9..=9_i32) {
        let draw = crate::strategies::Draw { ratio: RatioDraw::Critical, law: Law::Brach, ..draw };
        let collision = Collision { moment: Moment::Given(int(moment)), ..draw.exact() };
        let impact = collision.evaluate();
        prop_assert_eq!(&impact.critical_impulse, &impact.impulse);
        prop_assert_eq!(impact.separation, Nt { n: -(collision.restitution * impact.approach.n), t: int(0) });
        prop_assert_eq!(impact.moment, int(moment));
    }

    #[test]
    fn with_the_critical_moment_relative_rotation_ends(draw in draw()) {
        let draw = crate::strategies::Draw { ratio: RatioDraw::Critical, ..draw };
        let collision = Collision { moment: Moment::OfCritical(int(1)), ..draw.exact() };
        let impact = collision.evaluate();
        let relative = impact.two.after.yaw_rate.clone() - impact.one.after.yaw_rate.clone();
        let before = collision.contact().relative_yaw_rate();
        match collision.law {
            Law::Brach => prop_assert_eq!(relative, int(0)),
            Law::KudlichSlibar => prop_assert_eq!(relative, -(collision.restitution.clone() * before)),
        }
        prop_assert_eq!(impact.separation.n, -(collision.restitution * impact.approach.n));
        if draw.law == Law::Brach {
            prop_assert_eq!(impact.separation.t, int(0));
        }
    }
}
