//! Refusals: the same for every scalar, and no accepted collision gains energy, has a tensile impulse or interpenetrates.

use crate::rational::Rational;
use crate::strategies::{OrReject, config, draw, solved};
use num_dual::{Dual64, DualSVec64, HyperDual64};
use planar_impact::issue::Place;
use planar_impact::*;
use proptest::prelude::*;

/// Returns the kinds of refusal, without their numbers: code and path.
fn kinds<T: Ordered<Mask = bool>>(result: Result<Impact<T>, Refusals<T>>) -> Vec<(&'static str, Option<String>)> {
    result.err().iter().flatten().map(|refusal| (refusal.code(), refusal.path().map(String::from))).collect()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_scalar_refuses_the_same(draw in draw()) {
        let exact = kinds(draw.of::<Rational>().solve());
        prop_assert_eq!(&exact, &kinds(draw.of::<f64>().solve()), "f64");
        prop_assert_eq!(&exact, &kinds(draw.of::<Dual64>().solve()), "Dual64");
        prop_assert_eq!(&exact, &kinds(draw.of::<DualSVec64<2>>().solve()), "DualSVec64");
        prop_assert_eq!(&exact, &kinds(draw.of::<HyperDual64>().solve()), "HyperDual64");
    }

    #[test]
    fn an_f32_refuses_the_same_where_the_answer_is_clear(draw in draw()) {
        let exact = draw.exact();
        let close = |x: Rational, scale: Rational| x.magnitude() <= scale * Rational::int(1) / Rational::int(1000);
        let contact = exact.contact();
        let speeds = contact.one.velocity_at_center().length_squared() + contact.two.velocity_at_center().length_squared();
        prop_assume!(!close(contact.approach.n.clone().squared(), speeds) && contact.offset().n.magnitude() > Rational::int(1) / Rational::int(100));
        let clear = match exact.solve() {
            // Within a thousandth of a bound, an f32 may give either answer.
            Ok(impact) => !close(impact.loss(), impact.kinetic_energy.before.clone()) && matches!(exact.impulse_ratio, ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_)),
            Err(refusals) => refusals.iter().all(|refusal| matches!(refusal, Refusal::NotClosing { .. })),
        };
        prop_assume!(clear);
        prop_assert_eq!(kinds(exact.solve()), kinds(draw.of::<f32>().solve()));
    }

    #[test]
    fn what_is_solved_is_possible(draw in solved()) {
        let collision = draw.exact();
        let zero = Rational::int(0);
        let impact = collision.solve().expect("as in f64");
        prop_assert!(impact.loss() >= zero, "no energy is gained");
        prop_assert!(impact.impulse.n.clone() * &impact.approach.n > zero, "the impulse pushes");
        prop_assert!(impact.separation.n.clone() * &impact.approach.n <= zero, "they do not interpenetrate");
        let contact = collision.contact();
        let are_points = contact.one.arm == Nt::zero() && contact.two.arm == Nt::zero();
        prop_assert!(are_points || contact.offset().n * &impact.approach.n < zero, "they closed before");
        prop_assert_eq!(impact, collision.evaluate());
    }

    #[test]
    fn rounding_decides_no_answer(draw in solved(), halvings in 0..90_i32) {
        let mut collision = draw.of::<f64>();
        one(&mut collision).yaw_inertia *= 0.5_f64.powi(halvings);
        let impact = collision.solve().or_reject("refused")?;
        let missed = impact.separation.n + collision.restitution * impact.approach.n;
        prop_assert!(missed.abs() <= 1e-6 * impact.approach.n.abs(), "restitution");
        let energy = impact.kinetic_energy;
        prop_assert!((energy.before - energy.after - impact.loss()).abs() <= 1e-6 * (energy.before + energy.after), "energy");
    }

    #[test]
    fn what_is_refused_is_impossible(draw in draw()) {
        let collision = draw.exact();
        let zero = Rational::int(0);
        for refusal in &collision.solve().err().or_reject("solved")? {
            match refusal {
                Refusal::NotClosing { approach, offset } => prop_assert!(approach * offset >= zero),
                Refusal::EnergyGain { gain, .. } => {
                    prop_assert!(gain > &zero);
                    prop_assert_eq!(gain.clone(), -collision.evaluate().loss());
                }
                Refusal::BeyondCritical { ratio, .. } => {
                    let ImpulseRatio::Given(given) = &collision.impulse_ratio else { panic!("only a given ratio can be beyond") };
                    prop_assert_eq!(given, ratio);
                    // Its tangential impulse opposes that of the sticking impulse, or exceeds it, so that sliding reverses.
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
    collision.solve().expect_err("it must be refused").as_slice().to_vec()
}

#[test]
fn a_sound_collision_is_solved() {
    assert!(sound().solve().is_ok());
}

#[test]
fn only_a_yaw_inertia_that_rounding_decides_is_ill_conditioned() {
    let solved = |yaw_inertia: f64| {
        let mut collision = sound();
        one(&mut collision).yaw_inertia = yaw_inertia;
        kinds(collision.solve())
    };
    for yaw_inertia in [1500.0, 1.0, 1e-3, 1e-6] {
        assert_eq!(solved(yaw_inertia), [], "{yaw_inertia}");
    }
    assert_eq!(solved(1e-12), [("ill-conditioned", None)]);
}

#[test]
fn directions_of_every_float_are_directions() {
    for degrees in 0..360_u16 {
        let single = Collision { crush_plane: CrushPlane::from_angle(f32::from(degrees).to_radians()), ..sound().map(|x| x as f32) };
        let double = Collision { crush_plane: CrushPlane::from_angle(f64::from(degrees).to_radians()), ..sound() };
        for refusals in [kinds(single.solve()), kinds(double.solve())] {
            assert!(refusals.iter().all(|(code, _)| *code != "not-a-direction"), "{degrees}");
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
            Refusal::Input(InputIssue::not_positive(Place::input(Input::Mass(Side::One)), 0.0)),
            Refusal::Input(InputIssue::not_positive(Place::input(Input::YawInertia(Side::One)), -1.0)),
            Refusal::NotADirection { at: Place::input(Input::CrushPlane), length_squared: 0.25 },
            Refusal::Input(InputIssue {
                at: Place::input(Input::Restitution),
                kind: InputIssueKind::OutOfRange { value: 1.5, least: 0.0, greatest: Some(1.0) },
            }),
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
        assert!(
            matches!(refused(|c| c.restitution = e)[..], [Refusal::Input(InputIssue { kind: InputIssueKind::OutOfRange { .. }, .. })]),
            "e = {e}"
        );
    }
    for fraction in [0.0, 1.0] {
        assert!(Collision { impulse_ratio: ImpulseRatio::OfCritical(fraction), ..sound() }.solve().is_ok());
        assert!(Collision { moment: Moment::OfCritical(fraction), ..sound() }.solve().is_ok());
    }
    assert!(Collision { impulse_ratio: ImpulseRatio::LimitedByFriction(0.0), ..sound() }.solve().is_ok());
    assert!(matches!(
        refused(|c| c.impulse_ratio = ImpulseRatio::LimitedByFriction(-0.1))[..],
        [Refusal::Input(InputIssue { kind: InputIssueKind::OutOfRange { greatest: None, .. }, .. })]
    ));
    assert!(matches!(
        refused(|c| c.moment = Moment::OfCritical(1.1))[..],
        [Refusal::Input(InputIssue { kind: InputIssueKind::OutOfRange { .. }, .. })]
    ));
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

/// If the impulse that ends sliding is tensile, or purely tangential, every ratio on its side continues the sliding,
/// and the other side is refused without a bound.
#[test]
fn a_ratio_where_sliding_does_not_end() {
    let int = Rational::int;
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
    // K = [[2, -1], [-1, 2]], so P_n is proportional to -(2 + vy): zero at vy = -2, tensile beyond.
    for vy in [-2, -3] {
        let refusals = scraping(vy, 1).solve().expect_err("it would speed the sliding up");
        assert_eq!(*refusals.first(), Refusal::BeyondCritical { ratio: int(1), critical: None });
        assert!(scraping(vy, -1).solve().is_ok());
        // The impulse that would end the sliding is refused, and so is any nonzero fraction of it.
        let whole = Collision { impulse_ratio: ImpulseRatio::Critical, ..scraping(vy, 0) };
        let half = Collision { impulse_ratio: ImpulseRatio::OfCritical(int(1) / int(2)), ..scraping(vy, 0) };
        for collision in [whole, half] {
            let refusals = collision.solve().expect_err("it would pull");
            assert!(matches!(refusals.as_slice(), [Refusal::Tensile { reason: Tension::Pulls, .. }]), "{refusals:?}");
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
    // Along a barrier: the cosine of a right angle is 6e-17, which is not an approach.
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
    assert_eq!(text(|c| one(c).mass = -2.0), "vehicle.1.mass is -2 kg; it must be above zero");
    assert_eq!(text(|c| c.restitution = 15.0), "contact.restitution is 15; it must be from 0 to 1");
    let both = text(|c| {
        one(c).mass = f64::NAN;
        c.restitution = -1.0;
    });
    assert_eq!(both, "vehicle.1.mass is not finite: NaN; contact.restitution is -1; it must be from 0 to 1");
    assert!(text(|c| one(c).motion.velocity.x = -1.0).starts_with("vehicles are separating: the normal approach velocity is 1 m/s, and"));
}
