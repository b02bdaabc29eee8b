//! What is refused: the same at every scalar, and nothing that is let through gains energy, pulls or interpenetrates.

use crate::strategies::{config, draw};
use num_dual::{Dual64, DualSVec64, HyperDual64};
use num_rational::BigRational;
use planar_impact::*;
use proptest::prelude::*;
use std::mem::{Discriminant, discriminant};

/// The kinds of refusal, without their numbers.
fn kinds<T>(result: Result<Impact<T>, Refusals<T>>) -> Vec<Discriminant<Refusal<()>>> {
    let kind = |refusal: &Refusal<T>| match refusal {
        Refusal::NotFinite { input, .. } => Refusal::NotFinite { input, value: () },
        Refusal::NotPositive { input, .. } => Refusal::NotPositive { input, value: () },
        Refusal::OutOfRange { input, least, greatest, .. } => Refusal::OutOfRange { input, value: (), least: *least, greatest: *greatest },
        Refusal::NotADirection { input, .. } => Refusal::NotADirection { input, length_squared: () },
        Refusal::NothingMoves => Refusal::NothingMoves,
        Refusal::OutOfFloatRange => Refusal::OutOfFloatRange,
        Refusal::NotClosing { .. } => Refusal::NotClosing { approach: (), offset: () },
        Refusal::Tensile { reason, .. } => Refusal::Tensile { normal: (), reason: *reason },
        Refusal::BeyondCritical { .. } => Refusal::BeyondCritical { ratio: (), critical: None },
        Refusal::EnergyGain { .. } => Refusal::EnergyGain { gain: (), before: () },
        other => panic!("a kind of refusal that this test does not know: {}", other.is_physical()),
    };
    result.err().map_or_else(Vec::new, |refusals| refusals.reasons().iter().map(|refusal| discriminant(&kind(refusal))).collect())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_scalar_refuses_the_same(draw in draw()) {
        let exact = kinds(draw.of::<BigRational>().solve());
        prop_assert_eq!(&exact, &kinds(draw.of::<f64>().solve()), "f64");
        prop_assert_eq!(&exact, &kinds(draw.of::<Dual64>().solve()), "Dual64");
        prop_assert_eq!(&exact, &kinds(draw.of::<DualSVec64<2>>().solve()), "DualSVec64");
        prop_assert_eq!(&exact, &kinds(draw.of::<HyperDual64>().solve()), "HyperDual64");
    }

    #[test]
    fn an_f32_refuses_the_same_where_the_answer_is_clear(draw in draw()) {
        let exact = draw.exact();
        let close = |x: BigRational, scale: BigRational| x.magnitude() <= scale * BigRational::int(1) / BigRational::int(1000);
        let contact = exact.contact();
        let speeds = contact.one.velocity_at_center().length_squared() + contact.two.velocity_at_center().length_squared();
        prop_assume!(!close(contact.approach.n.clone().squared(), speeds) && contact.offset().n.magnitude() > BigRational::int(1) / BigRational::int(100));
        let clear = match exact.solve() {
            // Within a thousandth of a bound either answer may be an f32's.
            Ok(impact) => !close(impact.loss(), impact.kinetic_energy.before.clone()) && matches!(exact.impulse_ratio, ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_)),
            Err(refusals) => refusals.reasons().iter().all(|refusal| matches!(refusal, Refusal::NotClosing { .. })),
        };
        prop_assume!(clear);
        prop_assert_eq!(kinds(exact.solve()), kinds(draw.of::<f32>().solve()));
    }

    #[test]
    fn what_is_solved_is_possible(draw in draw()) {
        let collision = draw.exact();
        let zero = BigRational::int(0);
        if let Ok(impact) = collision.solve() {
            prop_assert!(impact.loss() >= zero, "no energy is gained");
            prop_assert!(impact.impulse.n.clone() * &impact.approach.n > zero, "the impulse pushes");
            prop_assert!(impact.separation.n.clone() * &impact.approach.n <= zero, "they do not interpenetrate");
            prop_assert!(collision.contact().offset().n * &impact.approach.n < zero, "they closed before");
            prop_assert_eq!(impact, collision.evaluate());
        }
    }

    #[test]
    fn what_is_refused_is_impossible(draw in draw()) {
        let collision = draw.exact();
        let zero = BigRational::int(0);
        for refusal in collision.solve().err().iter().flat_map(|refusals| refusals.reasons()) {
            match refusal {
                Refusal::NotClosing { approach, offset } => prop_assert!(approach * offset >= zero),
                Refusal::EnergyGain { gain, .. } => {
                    prop_assert!(gain > &zero);
                    prop_assert_eq!(gain.clone(), -collision.evaluate().loss());
                }
                Refusal::BeyondCritical { ratio, .. } => {
                    let ImpulseRatio::Given(given) = &collision.impulse_ratio else { panic!("only a given ratio can be beyond") };
                    prop_assert_eq!(given, ratio);
                    // With the sticking impulse beyond, sliding has reversed or began the other way.
                    let impact = collision.evaluate();
                    let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() }.evaluate();
                    let share = impact.impulse.t.clone() * &sticking.impulse.t;
                    prop_assert!(share < zero || impact.impulse.t.magnitude() > sticking.impulse.t.magnitude());
                }
                Refusal::Tensile { normal, reason: Tension::Pulls } => {
                    prop_assert!(normal * collision.contact().approach.n <= zero);
                }
                Refusal::Tensile { normal, reason: Tension::Wedges } => prop_assert!(normal <= &zero),
                other => panic!("{other}"),
            }
        }
    }
}

fn sound() -> Collision {
    let car = |x: f64, y: f64, forward: f64| Vehicle {
        mass: 1000.0,
        yaw_inertia: 1500.0,
        heading: Heading { cos: 1.0, sin: 0.0 },
        impact_center: ForwardLeft { forward, left: 0.5 },
        motion: Motion { velocity: Xy { x, y }, yaw_rate: 0.0 },
    };
    Collision {
        one: car(10.0, 3.0, 2.0).into(),
        two: car(0.0, 0.0, -2.0).into(),
        crush_plane: CrushPlane { cos: 1.0, sin: 0.0 },
        restitution: 0.1,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

fn one(collision: &mut Collision) -> &mut Vehicle {
    match &mut collision.one {
        Party::Vehicle(vehicle) => vehicle,
        Party::Barrier => panic!("vehicle 1 is one"),
    }
}

fn refused(change: impl FnOnce(&mut Collision)) -> Vec<Refusal> {
    let mut collision = sound();
    change(&mut collision);
    collision.solve().expect_err("it must be refused").reasons().to_vec()
}

#[test]
fn a_sound_collision_is_solved() {
    assert!(sound().solve().is_ok());
}

#[test]
fn directions_of_every_float_are_directions() {
    for degrees in 0..360_u16 {
        let single = Collision { crush_plane: CrushPlane::from_angle(f32::from(degrees).to_radians()), ..sound().map(|x| x as f32) };
        let double = Collision { crush_plane: CrushPlane::from_angle(f64::from(degrees).to_radians()), ..sound() };
        for refusals in [kinds(single.solve()), kinds(double.solve())] {
            assert!(
                refusals.iter().all(|&kind| kind != discriminant(&Refusal::NotADirection { input: "", length_squared: () })),
                "{degrees}"
            );
        }
    }
}

#[test]
fn every_input_is_checked_by_name() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let name = |reasons: Vec<Refusal>| reasons.iter().map(|refusal| refusal.input().expect("an input")).collect::<Vec<_>>();
        assert_eq!(name(refused(|c| one(c).mass = bad)), ["vehicle.1.mass"]);
        assert_eq!(name(refused(|c| one(c).yaw_inertia = bad)), ["vehicle.1.yaw_inertia"]);
        assert_eq!(name(refused(|c| one(c).heading.sin = bad)), ["vehicle.1.heading"]);
        assert_eq!(name(refused(|c| one(c).impact_center.forward = bad)), ["vehicle.1.impact_center.forward"]);
        assert_eq!(name(refused(|c| one(c).impact_center.left = bad)), ["vehicle.1.impact_center.left"]);
        assert_eq!(name(refused(|c| one(c).motion.velocity.x = bad)), ["vehicle.1.velocity.x"]);
        assert_eq!(name(refused(|c| one(c).motion.velocity.y = bad)), ["vehicle.1.velocity.y"]);
        assert_eq!(name(refused(|c| one(c).motion.yaw_rate = bad)), ["vehicle.1.yaw_rate"]);
        assert_eq!(name(refused(|c| c.crush_plane.cos = bad)), ["contact.crush_plane"]);
        assert_eq!(name(refused(|c| c.restitution = bad)), ["contact.restitution"]);
        assert_eq!(name(refused(|c| c.impulse_ratio = ImpulseRatio::Given(bad))), ["contact.impulse_ratio"]);
        assert_eq!(name(refused(|c| c.impulse_ratio = ImpulseRatio::OfCritical(bad))), ["contact.impulse_ratio.of_critical"]);
        assert_eq!(name(refused(|c| c.impulse_ratio = ImpulseRatio::LimitedByFriction(bad))), ["contact.friction"]);
        assert_eq!(name(refused(|c| c.moment = Moment::Given(bad))), ["contact.moment"]);
        assert_eq!(name(refused(|c| c.moment = Moment::OfCritical(bad))), ["contact.moment.of_critical"]);
    }
}

#[test]
fn all_problems_are_reported_at_once() {
    let reasons = refused(|c| {
        one(c).mass = 0.0;
        one(c).yaw_inertia = -1.0;
        c.restitution = 1.5;
        c.crush_plane.cos = 0.5;
    });
    assert_eq!(
        reasons,
        [
            Refusal::NotPositive { input: "vehicle.1.mass", value: 0.0 },
            Refusal::NotPositive { input: "vehicle.1.yaw_inertia", value: -1.0 },
            Refusal::NotADirection { input: "contact.crush_plane", length_squared: 0.25 },
            Refusal::OutOfRange { input: "contact.restitution", value: 1.5, least: 0, greatest: Some(1) },
        ]
    );
    assert!(reasons.iter().all(|refusal| !refusal.is_physical()));
}

#[test]
fn bounds_themselves_are_allowed() {
    for e in [0.0, 1.0] {
        let collision = Collision { restitution: e, impulse_ratio: ImpulseRatio::Given(0.0), ..sound() };
        assert!(collision.solve().is_ok(), "e = {e}");
    }
    for e in [-f64::MIN_POSITIVE, 1.0_f64.next_up()] {
        assert!(matches!(refused(|c| c.restitution = e)[..], [Refusal::OutOfRange { .. }]), "e = {e}");
    }
    for fraction in [0.0, 1.0] {
        assert!(Collision { impulse_ratio: ImpulseRatio::OfCritical(fraction), ..sound() }.solve().is_ok());
        assert!(Collision { moment: Moment::OfCritical(fraction), ..sound() }.solve().is_ok());
    }
    assert!(Collision { impulse_ratio: ImpulseRatio::LimitedByFriction(0.0), ..sound() }.solve().is_ok());
    assert!(matches!(
        refused(|c| c.impulse_ratio = ImpulseRatio::LimitedByFriction(-0.1))[..],
        [Refusal::OutOfRange { greatest: None, .. }]
    ));
    assert!(matches!(refused(|c| c.moment = Moment::OfCritical(1.1))[..], [Refusal::OutOfRange { .. }]));
}

#[test]
fn the_critical_ratio_itself_is_not_beyond_it() {
    let critical = sound().evaluate().critical_impulse_ratio();
    assert!(critical.abs() > 1e-3);
    assert!(Collision { impulse_ratio: ImpulseRatio::Given(critical), ..sound() }.solve().is_ok());
    for fraction in [1.25, -0.25] {
        let ratio = fraction * critical;
        assert_eq!(
            refused(|c| c.impulse_ratio = ImpulseRatio::OfCritical(fraction)),
            [Refusal::BeyondCritical { ratio, critical: Some(critical) }]
        );
    }
    for ratio in [critical * 1.000_001, -critical * 0.1] {
        let reasons = refused(|c| c.impulse_ratio = ImpulseRatio::Given(ratio));
        assert_eq!(reasons, [Refusal::BeyondCritical { ratio, critical: Some(critical) }]);
        assert!(reasons[0].is_physical());
    }
}

/// Where the impulse that ends sliding would pull, or is all tangential, every ratio of its side slides on, and the other side is refused without a bound.
#[test]
fn a_ratio_where_sliding_does_not_end() {
    let int = BigRational::int;
    let scraping = |vy: i32, ratio: i32| Collision {
        one: Party::Vehicle(Vehicle {
            mass: int(1),
            yaw_inertia: int(1),
            heading: Heading { cos: int(1), sin: int(0) },
            impact_center: ForwardLeft { forward: int(1), left: int(1) },
            motion: Motion { velocity: Xy { x: int(1), y: int(vy) }, yaw_rate: int(0) },
        }),
        two: Party::Barrier,
        crush_plane: CrushPlane { cos: int(1), sin: int(0) },
        restitution: int(0),
        impulse_ratio: ImpulseRatio::Given(int(ratio)),
        law: Law::Brach,
        moment: Moment::None,
    };
    // K = [[2, -1], [-1, 2]], so P_n is proportional to -(2 + vy): nothing at vy = -2, a pull beyond.
    for vy in [-2, -3] {
        let refusals = scraping(vy, 1).solve().expect_err("it would speed the sliding up");
        assert_eq!(refusals.reasons()[0], Refusal::BeyondCritical { ratio: int(1), critical: None });
        assert!(scraping(vy, -1).solve().is_ok());
        // The impulse that would end the sliding is refused, and so is any part of it but none.
        let whole = Collision { impulse_ratio: ImpulseRatio::Critical, ..scraping(vy, 0) };
        let half = Collision { impulse_ratio: ImpulseRatio::OfCritical(int(1) / int(2)), ..scraping(vy, 0) };
        for collision in [whole, half] {
            let refusals = collision.solve().expect_err("it would pull");
            assert!(matches!(refusals.reasons(), [Refusal::Tensile { reason: Tension::Pulls, .. }]), "{refusals:?}");
        }
    }
}

#[test]
fn two_barriers_do_not_collide() {
    assert_eq!(refused(|c| (c.one, c.two) = (Party::Barrier, Party::Barrier)), [Refusal::NothingMoves]);
}

#[test]
fn separating_and_sliding_pairs_are_refused() {
    for speed in [-10.0, 0.0, -0.0] {
        let reasons = refused(|c| one(c).motion.velocity.x = speed);
        assert!(matches!(reasons[..], [Refusal::NotClosing { offset: -4.0, .. } | Refusal::NotClosing { offset: 4.0, .. }]), "{reasons:?}");
    }
    // Along a barrier: the cosine of a right angle is 6e-17, and is no approach.
    let along = |c: &mut Collision| {
        c.two = Party::Barrier;
        let heading = Heading::from_angle(core::f64::consts::FRAC_PI_2);
        one(c).motion.velocity = heading.to_ground(ForwardLeft { forward: 30.0, left: 0.0 });
        one(c).impact_center = ForwardLeft { forward: 1.0, left: 0.0 };
    };
    assert!(matches!(refused(along)[..], [Refusal::NotClosing { .. }]));
}

#[test]
fn numbers_beyond_all_measure_overflow_into_an_error() {
    assert_eq!(refused(|c| one(c).mass = 7e-304), [Refusal::OutOfFloatRange]);
    assert_eq!(refused(|c| one(c).motion.velocity.x = 1e200), [Refusal::OutOfFloatRange]);
}

#[test]
fn messages_carry_the_name_and_the_number() {
    let text = |change: fn(&mut Collision)| {
        let mut collision = sound();
        change(&mut collision);
        collision.solve().expect_err("it must be refused").to_string()
    };
    assert_eq!(text(|c| one(c).mass = -2.0), "vehicle.1.mass is -2; it must be above zero");
    assert_eq!(text(|c| c.restitution = 15.0), "contact.restitution is 15; it must lie between 0 and 1");
    let both = text(|c| {
        one(c).mass = f64::NAN;
        c.restitution = -1.0;
    });
    assert_eq!(both, "vehicle.1.mass is NaN; a finite number is expected; contact.restitution is -1; it must lie between 0 and 1");
    assert!(text(|c| one(c).motion.velocity.x = -1.0).starts_with("the vehicles do not close: the normal approach velocity is 1 and"));
}
