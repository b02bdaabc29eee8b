//! CRASH3 beside planar mechanics.

use crate::strategies::{Draw, RatioDraw, computable, config, draw};
use num_dual::Dual64;
use num_rational::BigRational;
use planar_impact::crash3::*;
use planar_impact::*;
use proptest::prelude::*;

type Exact = BigRational;

fn int(n: i32) -> Exact {
    Exact::int(n)
}

/// The force of an impact as each vehicle has it, with given surfaces and energies.
fn damaged<T: Ordered<Mask = bool>>(collision: &Collision<T>, energy: [T; 2]) -> DamagedPair<T> {
    let impact = collision.evaluate();
    let [one, two] = energy;
    let of = |party: &Party<T>, response: &Response<T>, energy| {
        let (vehicle, origin) = (party.vehicle()?, response.force_origin());
        Some(Damaged::of(vehicle, Surface::along(&collision.crush_plane, &vehicle.heading, &origin), origin, energy))
    };
    DamagedPair { one: of(&collision.one, &impact.one, one), two: of(&collision.two, &impact.two, two) }
}

/// Whether any impulse acts.
fn pushes(collision: &Collision<Exact>) -> bool {
    collision.evaluate().impulse.length_squared() != int(0)
}

/// The vehicles face along the normal, so that α is the angle of the impulse from it.
fn square_on(draw: &Draw) -> Draw {
    let mut draw = *draw;
    (draw.one.heading, draw.two.heading) = (draw.crush_plane, draw.crush_plane);
    draw
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_equivalent_mass_is_what_yields_along_the_force(draw in computable()) {
        // Σ 1/(γ m) = u·K u for the unit vector u of the force: rotation is in the equivalent mass, exactly.
        let collision = draw.exact();
        prop_assume!(pushes(&collision));
        let impulse = collision.evaluate().impulse;
        let yielding = collision.contact().compliance.yield_to(impulse.clone()).dot(impulse.clone()) / impulse.length_squared();
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
    fn without_restitution_through_both_centers_the_methods_agree(draw in draw(), one in -3..=3_i32, two in -3..=3_i32) {
        // Arms along the approach velocity: the impulse at common velocity is along it too, and turns neither vehicle.
        let draw = square_on(&draw);
        let mut collision = draw.exact().at_common_velocity();
        let velocity = |party: &Party<Exact>| party.vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity.clone());
        let approach = collision.crush_plane.to_contact(velocity(&collision.two) - velocity(&collision.one));
        for (party, share) in [(&mut collision.one, one), (&mut collision.two, two)] {
            if let Party::Vehicle(vehicle) = party {
                vehicle.motion.yaw_rate = int(0);
                vehicle.impact_center = ForwardLeft { forward: approach.n.clone() * int(share), left: approach.t.clone() * int(share) };
            }
        }
        // Beyond 45° the correction is limited, and at exactly 45° the limit is reached.
        prop_assume!(approach.t.clone().magnitude() <= approach.n.clone().magnitude() && approach.n != int(0));
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
        // Where they slide along the crush plane neither is pushed one way or the other along its normal.
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
            force_origin: ForceOrigin { ahead: damaged.force_origin.ahead * int(length), right: damaged.force_origin.right * int(length) },
            ..damaged
        });
        prop_assert_eq!(DamagedPair { one: longer(&pair.one), two: longer(&pair.two) }.impulse_squared(), pair.impulse_squared());
    }

    #[test]
    fn no_assumption_is_planar_mechanics_and_all_are_crash3(draw in draw()) {
        let draw = square_on(&draw);
        let collision = draw.of::<f64>();
        let Ok(impact) = collision.solve() else { return Ok(()) };
        prop_assume!(impact.work.n < -1e-3 && impact.loss() > 1e-3 * impact.kinetic_energy.before);
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let near = |one: f64, two: f64| (one - two).abs() <= 1e-9 * two.abs().max(1e-3);
        prop_assert!(near(assumptions.planar.loss, impact.loss()), "{:?}", assumptions);
        prop_assert!(near(assumptions.planar.delta_v_1, impact.one.delta_v_magnitude()), "{:?}", assumptions);
        prop_assert!(near(assumptions.planar.delta_v_2, impact.two.delta_v_magnitude()), "{:?}", assumptions);
        let common = collision.at_common_velocity();
        prop_assume!(common.solve().is_ok() && common.evaluate().impulse_ratio().abs() < 1.0);
        let estimate = DamagedPair::of_collision(&collision, [assumptions.crush_energy, 0.0]).evaluate();
        prop_assert!(near(assumptions.together.loss, estimate.energy));
        for (delta_v, estimate) in [(assumptions.together.delta_v_1, estimate.one), (assumptions.together.delta_v_2, estimate.two)] {
            prop_assert!(near(delta_v, estimate.map_or(0.0, |vehicle| vehicle.delta_v_magnitude)), "{:?}", assumptions);
        }
    }

    #[test]
    fn each_assumption_alone_is_what_it_says(draw in draw()) {
        let collision = draw.of::<f64>();
        let Ok(impact) = collision.solve() else { return Ok(()) };
        prop_assume!(impact.work.n < -1e-3 && impact.loss() > 1e-3 * impact.kinetic_energy.before);
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let near = |one: f64, two: f64| (one - two).abs() <= 1e-9 * two.abs().max(1e-3);
        let holds = |with: &Consequence, loss: f64, impulse: f64| {
            let delta_v = |party: &Party| party.vehicle().map_or(0.0, |vehicle| impulse / vehicle.mass);
            near(with.loss, loss) && near(with.delta_v_1, delta_v(&collision.one)) && near(with.delta_v_2, delta_v(&collision.two))
        };
        let (compliance, energy, ratio) = (collision.contact().compliance, assumptions.crush_energy, impact.impulse_ratio());
        // The collision without restitution and sliding, at the speed at which it leaves the same crush.
        let common = collision.at_common_velocity().evaluate();
        // Where its impulse would pull, nothing like it exists.
        prop_assume!(common.work.n < -1e-3);
        let (scale, with) = (energy / -common.work.n, &assumptions.common_velocity);
        prop_assert!(holds(with, scale * common.loss(), scale.sqrt() * common.impulse.length()), "{:?}", with);
        let unit = Nt { n: 1.0, t: ratio };
        // One point of the equivalent mass against a barrier, with the restitution, the ratio and the sliding of the case.
        let yielding = compliance.yield_to(unit).dot(unit) / unit.length_squared();
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
        // By Eq 2 ΔV is that of the loss, which alone is another.
        let loss = energy * unit.length_squared();
        let push = impact.impulse.length() * (loss / impact.loss()).sqrt();
        prop_assert!(holds(&assumptions.tangential_factor, loss, push), "{:?}", assumptions.tangential_factor);
        // What each costs is the difference from planar mechanics.
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
    fn an_assumption_that_holds_costs_nothing(draw in draw()) {
        let draw = square_on(&draw);
        let collision = draw.of::<f64>().at_common_velocity();
        let Ok(impact) = collision.solve() else { return Ok(()) };
        prop_assume!(impact.work.n < -1e-3 && impact.loss() > 1e-3 * impact.kinetic_energy.before);
        let assumptions = Assumptions::of(&collision).expect("no moment impulse");
        let cost = assumptions.cost(Assumption::CommonVelocity);
        prop_assert!(cost.loss.abs() <= 1e-9 * impact.kinetic_energy.before, "{:?}", cost);
        prop_assert!(cost.delta_v_1.abs() <= 1e-9 * assumptions.planar.delta_v_1.max(1e-3), "{:?}", cost);
        let (one, two) = (draw.one.impact_center, draw.two.impact_center);
        if one == (0, 0) && (two == (0, 0) || draw.barrier) {
            prop_assert!(assumptions.cost_together().loss.abs() <= 1e-9 * impact.kinetic_energy.before);
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
                    force_origin: ForceOrigin { ahead: vehicle.force_origin.ahead.into(), right: vehicle.force_origin.right.into() },
                    crush_energy: number(vehicle.crush_energy, 4),
                }
            };
            let pair = DamagedPair { one: pair.one.as_ref().map(dual), two: pair.two.as_ref().map(dual) };
            pair.evaluate().one.map(|one| one.delta_v_magnitude).expect("vehicle 1 is none")
        };
        // A share of the number itself, so that masses of 1 and energies of 3000 are moved alike.
        let step = if which == 4 { 1.0 } else { 1e-4 };
        let (above, below) = (moved(Dual64::from(step)).re, moved(Dual64::from(-step)).re);
        let derivative = moved(Dual64::new(0.0, 1.0));
        let difference = (above - below) / (2.0 * step);
        prop_assert!((derivative.eps - difference).abs() <= 1e-5 * derivative.re.max(1.0), "{} {}", derivative.eps, difference);
    }
}
