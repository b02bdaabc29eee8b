//! CRASH3 compared with planar mechanics.

use crate::rational::Rational;
use crate::strategies::{Draw, Fraction, OrReject, RatioDraw, VehicleDraw, computable, draw, fewer, solved};
use num_dual::Dual64;
use planar_impact::crash3::*;
use planar_impact::*;
use proptest::prelude::*;

type Exact = Rational;

fn int(n: i32) -> Exact {
    Exact::int(n)
}

/// Returns the damaged pair of an impact, with the surface and the direction of force of each vehicle, and given energies.
fn damaged<T: Ordered<Mask = bool>>(collision: &Collision<T>, energy: [T; 2]) -> DamagedPair<T> {
    let impact = collision.evaluate();
    let [one, two] = energy;
    let of = |party: &Party<T>, response: &Response<T>, energy| {
        let (vehicle, origin) = (party.vehicle()?, response.force_direction());
        Some(Damaged::of(vehicle, Surface::along(&collision.crush_plane, &vehicle.heading, &origin), origin, energy))
    };
    DamagedPair { one: of(&collision.one, &impact.one, one), two: of(&collision.two, &impact.two, two) }
}

/// Returns `true` if the impulse is not zero.
fn pushes(collision: &Collision<Exact>) -> bool {
    collision.evaluate().impulse.length_squared() != int(0)
}

/// Turns the vehicles to face along the normal, so that α is the angle of the impulse to it, and the normal to within 45° of the approach velocity.
fn square_on(draw: &Draw) -> Draw {
    let collision = draw.of::<f64>();
    let velocity = |party: &Party| party.vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity);
    let approach = collision.crush_plane.to_contact(velocity(&collision.two) - velocity(&collision.one));
    let crush_plane = match draw.crush_plane {
        along if approach.t.abs() <= approach.n.abs() => along,
        // By a quarter turn, to the side where the tangent of the half is finite.
        Fraction(n, d) if n > 0 => Fraction(n - d, d + n),
        Fraction(n, d) => Fraction(d + n, d - n),
    };
    let facing = |vehicle: VehicleDraw| VehicleDraw { heading: crush_plane, ..vehicle };
    Draw { crush_plane, one: facing(draw.one), two: facing(draw.two), ..*draw }
}

fn at_common_velocity(draw: &Draw) -> Draw {
    Draw { restitution: Fraction(0, 1), ratio: RatioDraw::Critical, law: Law::Brach, ..square_on(draw) }
}

/// Returns a collision at common velocity of vehicles with arms along the approach velocity: the impulse is also along it, and turns neither vehicle.
fn through_both_centers<T: Field>(draw: &Draw, shares: [i32; 2]) -> Collision<T> {
    let mut collision = at_common_velocity(draw).of::<T>();
    let velocity = |party: &Party<T>| party.vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity.clone());
    let Nt { n, t } = collision.crush_plane.to_contact(velocity(&collision.two) - velocity(&collision.one));
    for (party, share) in [&mut collision.one, &mut collision.two].into_iter().zip(shares) {
        if let Party::Vehicle(vehicle) = party {
            vehicle.motion.yaw_rate = T::int(0);
            vehicle.impact_center = ForwardLeft { forward: n.clone() * T::int(share), left: t.clone() * T::int(share) };
        }
    }
    collision
}

/// Generates collisions that can be solved after a change.
fn solved_as(change: fn(&Draw) -> Draw) -> impl Strategy<Value = Draw> {
    draw().prop_map(move |draw| change(&draw).closing()).prop_filter("refused", Draw::is_solved)
}

/// Returns the impact, or rejects one with almost no crush or loss.
fn crushed(collision: &Collision) -> Result<Impact, TestCaseError> {
    let impact = collision.solve().or_reject("refused")?;
    prop_assume!(impact.work.n < -1e-3 && impact.loss() > 1e-3 * impact.kinetic_energy.before);
    Ok(impact)
}

fn near(one: f64, two: f64) -> bool {
    (one - two).abs() <= 1e-9 * two.abs().max(1e-3)
}

proptest! {
    #![proptest_config(fewer(5))]

    #[test]
    fn the_equivalent_mass_is_what_yields_along_the_force(draw in computable()) {
        // Σ 1/(γ m) = u·K u for the unit vector u of the force: the equivalent mass includes rotation exactly.
        let collision = draw.exact();
        prop_assume!(pushes(&collision));
        let impulse = collision.evaluate().impulse;
        let yielding = collision.contact().compliance.velocity_change(impulse.clone()).dot(impulse.clone()) / impulse.length_squared();
        prop_assert_eq!(damaged(&collision, [int(1), int(1)]).inverse_effective_mass(), yielding);
    }

    #[test]
    fn at_common_velocity_the_whole_loss_gives_the_whole_impulse(draw in draw()) {
        // Then T_L = ½ P·K P, whatever K is.
        let collision = draw.exact().at_common_velocity();
        prop_assume!(pushes(&collision));
        let impact = collision.evaluate();
        let yielding = damaged(&collision, [int(1), int(1)]).inverse_effective_mass();
        prop_assert_eq!(impact.impulse.clone().length_squared(), int(2) * impact.loss() / yielding);
    }

    #[test]
    fn without_restitution_through_both_centers_the_methods_agree(draw in draw(), shares in [-3..=3_i32, -3..=3_i32]) {
        let collision = through_both_centers::<Exact>(&draw, shares);
        prop_assume!(collision.contact().approach.n != int(0));
        let impact = collision.evaluate();
        let share = -impact.work.n.clone() / int(3);
        let pair = damaged(&collision, [share.clone(), -impact.work.n.clone() - share]);
        let pair = if draw.barrier { damaged(&collision, [-impact.work.n.clone(), int(0)]) } else { pair };
        prop_assert_eq!(pair.corrected_energy(), impact.loss());
        prop_assert_eq!(pair.impulse_squared(), impact.impulse.length_squared());
    }

    #[test]
    fn the_vehicles_may_be_exchanged(draw in computable(), e_1 in 0..=99_i32, e_2 in 0..=99_i32) {
        let collision = draw.exact();
        // If they slide along the crush plane, neither is pushed along its normal.
        prop_assume!(pushes(&collision) && collision.contact().approach.n != int(0));
        let here = damaged(&collision, [int(e_1), int(e_2)]);
        let exchanged = Collision { one: collision.two.clone(), two: collision.one.clone(), ..collision };
        let there = damaged(&exchanged, [int(e_2), int(e_1)]);
        prop_assert_eq!((&here.one, &here.two), (&there.two, &there.one));
        prop_assert_eq!(here.impulse_squared(), there.impulse_squared());
    }

    #[test]
    fn a_barrier_is_the_limit_of_ever_heavier_vehicles(draw in draw(), energy in 1..=99_i32) {
        let draw = Draw { ratio: RatioDraw::Critical, barrier: false, ..draw };
        let collision = draw.exact();
        prop_assume!(pushes(&collision));
        let pair = damaged(&collision, [int(energy), int(0)]);
        let heavy = |factor: i32| {
            let two = pair.two.clone().map(|two| Damaged { mass: int(factor), yaw_inertia: int(factor), ..two });
            DamagedPair { two, ..pair.clone() }.impulse_squared()
        };
        let wall = DamagedPair { two: None, ..pair.clone() }.impulse_squared();
        let away = |factor| (heavy(factor) - &wall).magnitude();
        prop_assert!(away(1_000_000_000) * int(900) <= away(1_000_000));
    }

    #[test]
    fn nothing_but_the_direction_of_the_force_counts(draw in computable(), length in 1..=9_i32) {
        let collision = draw.exact();
        prop_assume!(pushes(&collision));
        let pair = damaged(&collision, [int(2), int(3)]);
        let longer = |damaged: &Option<Damaged<Exact>>| damaged.clone().map(|damaged| Damaged {
            force_direction: ForceDirection { ahead: damaged.force_direction.ahead * int(length), right: damaged.force_direction.right * int(length) },
            ..damaged
        });
        prop_assert_eq!(DamagedPair { one: longer(&pair.one), two: longer(&pair.two) }.impulse_squared(), pair.impulse_squared());
    }

    #[test]
    fn no_assumption_is_planar_mechanics(draw in solved()) {
        let collision = draw.of::<f64>();
        let impact = crushed(&collision)?;
        let planar = Assumptions::of(&collision).expect("no moment impulse").planar;
        prop_assert!(near(planar.loss, impact.loss()), "{:?}", planar);
        prop_assert!(near(planar.delta_v_1, impact.one.delta_v_magnitude()), "{:?}", planar);
        prop_assert!(near(planar.delta_v_2, impact.two.delta_v_magnitude()), "{:?}", planar);
    }

    #[test]
    fn all_assumptions_together_are_crash3(draw in solved_as(square_on)) {
        let collision = draw.of::<f64>();
        crushed(&collision)?;
        let common = collision.at_common_velocity();
        prop_assume!(common.solve().is_ok() && common.evaluate().impulse_ratio().abs() < 1.0);
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let estimate = DamagedPair::of_collision(&collision, [assumptions.crush_energy, 0.0]).evaluate();
        prop_assert!(near(assumptions.together.loss, estimate.energy));
        for (delta_v, estimate) in [(assumptions.together.delta_v_1, estimate.one), (assumptions.together.delta_v_2, estimate.two)] {
            prop_assert!(near(delta_v, estimate.map_or(0.0, |vehicle| vehicle.delta_v_magnitude)), "{:?}", assumptions);
        }
    }

    #[test]
    fn each_assumption_alone_is_what_it_says(draw in solved()) {
        let collision = draw.of::<f64>();
        let impact = crushed(&collision)?;
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let holds = |with: &Consequence, loss: f64, impulse: f64| {
            let delta_v = |party: &Party| party.vehicle().map_or(0.0, |vehicle| impulse / vehicle.mass);
            near(with.loss, loss) && near(with.delta_v_1, delta_v(&collision.one)) && near(with.delta_v_2, delta_v(&collision.two))
        };
        let (compliance, energy, ratio) = (collision.contact().compliance, assumptions.crush_energy, impact.impulse_ratio());
        // The collision without restitution and sliding, at the speed at which it causes the same crush.
        let common = collision.at_common_velocity().evaluate();
        // If its impulse is tensile, there is no such collision.
        prop_assume!(common.work.n < -1e-3);
        let (scale, with) = (energy / -common.work.n, &assumptions.common_velocity);
        prop_assert!(holds(with, scale * common.loss(), scale.sqrt() * common.impulse.length()), "{:?}", with);
        let unit = Nt { n: 1.0, t: ratio };
        // A point with the equivalent mass against a barrier, with the restitution, the ratio and the sliding of the case.
        let yielding = compliance.velocity_change(unit).dot(unit) / unit.length_squared();
        let point = |normal: f64, tangential: f64| Collision {
            one: Party::Vehicle(Vehicle {
                mass: yielding.recip(),
                yaw_inertia: 1.0,
                heading: Heading { cos: 1.0, sin: 0.0 },
                impact_center: ForwardLeft::zero(),
                motion: Motion { velocity: Xy { x: -normal, y: -tangential }, yaw_rate: 0.0 },
            }),
            two: Party::Barrier,
            crush_plane: CrushPlane { cos: 1.0, sin: 0.0 },
            impulse_ratio: ImpulseRatio::Given(ratio),
            ..collision
        }
        .evaluate();
        let slid = impact.separation.t / impact.approach.n;
        let one = point(1.0, slid + ratio * (1.0 + collision.restitution));
        prop_assert!((one.separation.t - slid).abs() <= 1e-9 * (1.0 + ratio.abs()), "{} {}", one.separation.t, slid);
        let scale = energy / -one.work.n;
        prop_assert!(holds(&assumptions.point_mass, scale * one.loss(), scale.sqrt() * one.impulse.length()), "{:?}", assumptions.point_mass);
        // By Eq 2, ΔV follows from the loss, which alone differs.
        let loss = energy * unit.length_squared();
        let push = impact.impulse.length() * (loss / impact.loss()).sqrt();
        prop_assert!(holds(&assumptions.tangential_factor, loss, push), "{:?}", assumptions.tangential_factor);
        // The cost of each assumption is the difference from planar mechanics.
        for assumption in Assumption::ALL {
            let (with, cost) = (assumptions.with(assumption), assumptions.cost(assumption));
            prop_assert_eq!(cost.loss, with.loss - assumptions.planar.loss);
            prop_assert_eq!(cost.delta_v_1, with.delta_v_1 - assumptions.planar.delta_v_1);
            prop_assert_eq!(cost.delta_v_2, with.delta_v_2 - assumptions.planar.delta_v_2);
        }
        let together = assumptions.cost_together();
        prop_assert_eq!(together.loss, assumptions.together.loss - assumptions.planar.loss);
        prop_assert_eq!(together.delta_v_1, assumptions.together.delta_v_1 - assumptions.planar.delta_v_1);
    }

    #[test]
    fn an_assumption_that_holds_costs_nothing(draw in solved_as(at_common_velocity)) {
        let collision = draw.of::<f64>();
        let impact = crushed(&collision)?;
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let cost = assumptions.cost(Assumption::CommonVelocity);
        prop_assert!(cost.loss.abs() <= 1e-9 * impact.kinetic_energy.before, "{:?}", cost);
        prop_assert!(cost.delta_v_1.abs() <= 1e-9 * assumptions.planar.delta_v_1.max(1e-3), "{:?}", cost);
    }

    #[test]
    fn without_restitution_through_both_centers_no_assumption_costs_anything(draw in draw(), one in -3..=-1_i32, two in 0..=3_i32) {
        // Center of mass 2 lies behind the contact as body 1 approaches it, so the vehicles close.
        let collision = through_both_centers::<f64>(&draw, [one, two]);
        prop_assume!(collision.contact().approach.n.abs() > 1e-3);
        let impact = collision.solve().or_reject("refused")?;
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        for cost in Assumption::ALL.map(|assumption| assumptions.cost(assumption)).into_iter().chain([assumptions.cost_together()]) {
            prop_assert!(cost.loss.abs() <= 1e-9 * impact.kinetic_energy.before, "{:?}", cost);
            prop_assert!(cost.delta_v_1.abs() <= 1e-9 * assumptions.planar.delta_v_1, "{:?}", cost);
            prop_assert!(cost.delta_v_2.abs() <= 1e-9 * assumptions.planar.delta_v_1, "{:?}", cost);
        }
    }

    #[test]
    fn the_estimate_follows_what_it_is_made_of(draw in computable(), which in 0..5_usize) {
        prop_assume!(pushes(&draw.exact()));
        let pair = damaged(&draw.of::<f64>(), [3000.0, 2000.0]);
        let moved = |by: Dual64| {
            let dual = |vehicle: &Damaged| {
                let number = |value: f64, i: usize| if i == which { by + value } else { Dual64::from(value) };
                Damaged {
                    mass: number(vehicle.mass, 0),
                    yaw_inertia: number(vehicle.yaw_inertia, 1),
                    impact_center: ForwardLeft { forward: number(vehicle.impact_center.forward, 2), left: number(vehicle.impact_center.left, 3) },
                    surface: vehicle.surface,
                    force_direction: ForceDirection { ahead: vehicle.force_direction.ahead.into(), right: vehicle.force_direction.right.into() },
                    crush_energy: number(vehicle.crush_energy, 4),
                }
            };
            let pair = DamagedPair { one: pair.one.as_ref().map(dual), two: pair.two.as_ref().map(dual) };
            pair.evaluate().one.map(|one| one.delta_v_magnitude).expect("vehicle 1 is none")
        };
        // A fraction of the number itself, so that masses of 1 and energies of 3000 are changed alike.
        let step = if which == 4 { 1.0 } else { 1e-4 };
        let (above, below) = (moved(Dual64::from(step)).re, moved(Dual64::from(-step)).re);
        let derivative = moved(Dual64::new(0.0, 1.0));
        let difference = (above - below) / (2.0 * step);
        prop_assert!((derivative.eps - difference).abs() <= 1e-5 * derivative.re.max(1.0), "{} {}", derivative.eps, difference);
    }
}
