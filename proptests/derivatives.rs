//! The derivatives: the fast algorithm compared with dual numbers, and these with the complex step and central differences.
//!
//! `==` on dual numbers compares only values; these tests compare derivatives.

use crate::strategies::{OrReject, computable, config, fewer, solved};
use num_complex::Complex64;
use num_dual::Dual64;
use planar_impact::sensitivity::{by_definition, curvature_by_definition};
use planar_impact::*;
use proptest::prelude::*;

/// Returns the scale of an input: its own size, or one unit.
fn size(collision: &Collision, input: Input) -> f64 {
    match input {
        Input::Mass(_) | Input::YawInertia(_) => collision.input(input).unwrap_or(1.0),
        _ => 1.0,
    }
}

/// Groups outputs with comparable scales, so that rounding errors in one may be as large as in another.
fn kind(output: Output) -> u8 {
    match output {
        Output::Restitution | Output::ImpulseRatio | Output::CriticalImpulseRatio | Output::PrincipalDirectionOfForce(_) => 0,
        Output::NormalImpulse | Output::TangentialImpulse | Output::ImpulseX | Output::ImpulseY | Output::Moment => 1,
        Output::EnergyBefore | Output::EnergyAfter | Output::Loss => 2,
        Output::NormalWork | Output::TangentialWork | Output::MomentWork => 2,
        Output::YawRate(_) => 3,
        _ => 4,
    }
}

/// Returns `true` if no division in this collision is close to a division by zero, which would make rounding errors arbitrarily large.
fn is_tame(collision: &Collision, impact: &Impact) -> bool {
    let apart = |p: Nt| p.n.abs() > 1e-3 * p.length();
    let contact = collision.contact();
    let passing = contact.compliance.nn() * impact.impulse.length() < 1e-2 * impact.approach.n.abs();
    impact.approach.n.abs() > 1e-3
        && !passing
        && apart(impact.impulse)
        && apart(impact.critical_impulse)
        && impact.impulse.length() < 1e5
        && {
            let sticking = collision.law.change(contact.approach, collision.restitution);
            let sticking = contact.compliance.impulse_for(sticking);
            sticking.n.abs() > 1e-3 * sticking.length()
        }
}

/// Returns the largest effect of any input on any output of its kind.
fn scale(collision: &Collision, defined: &Outputs<Sensitive>, of: Output) -> f64 {
    let alike = Output::ALL.into_iter().filter(|&output| kind(output) == kind(of)).map(|output| &defined[output]);
    let effects = |s: &Sensitive| s.by.iter().map(|(input, by)| (by * size(collision, input)).abs()).fold(s.value.abs(), f64::max);
    alike.map(effects).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_fast_gradient_is_the_definition(draw in computable()) {
        let collision: Collision = draw.of();
        let impact = collision.evaluate();
        prop_assume!(is_tame(&collision, &impact));
        let (fast, defined) = (collision.sensitivities_of(&impact), by_definition(&collision));
        for output in Output::ALL {
            let alone = collision.sensitivity_of(&impact, output);
            let (all, definition) = (&fast[output], &defined[output]);
            prop_assert_eq!(all.value, definition.value);
            prop_assert_eq!(alone.value, definition.value);
            let scale = scale(&collision, &defined, output);
            for input in Input::ALL {
                let allowed = 1e-9 * scale / size(&collision, input);
                let exact = definition.by[input];
                prop_assert!((all.by[input] - exact).abs() <= allowed, "{} by {}: {} of all, {} by definition", output, input, all.by[input], exact);
                prop_assert!((alone.by[input] - exact).abs() <= allowed, "{} by {}: {} alone, {} by definition", output, input, alone.by[input], exact);
            }
        }
    }
}

/// Returns weights or directions between −2 and 2, one in four of them zero.
fn weights(count: usize) -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec((-8..=8_i32).prop_map(|quarters| if quarters % 4 == 1 { 0.0 } else { f64::from(quarters) / 4.0 }), count)
}

proptest! {
    #![proptest_config(fewer(5))]

    /// Both products are those of the Jacobian, whose rows come from the definition.
    #[test]
    fn products_with_the_jacobian(draw in solved(), w in weights(Output::COUNT), d in weights(Input::COUNT)) {
        let mut collision: Collision = draw.of();
        if draw.one.mass % 5 == 0 {
            collision.moment = Moment::OfCritical(0.5);
        }
        let impact = collision.solve().or_reject("with the moment it is refused")?;
        prop_assume!(is_tame(&collision, &impact));
        let defined = by_definition(&collision);
        let mut weights = Outputs::default();
        for output in Output::ALL {
            weights[output] = w[output.index()];
        }
        let pulled = collision.pullback(&weights).expect("it is solved");
        for input in Input::ALL {
            let terms = || Output::ALL.into_iter().map(|output| (weights[output] * defined[output].by[input], weights[output] * scale(&collision, &defined, output) / size(&collision, input)));
            let (sum, allowed): (f64, f64) = terms().fold((0.0, 1e-300), |(sum, allowed), (term, scale)| (sum + term, allowed + 1e-9 * scale.abs()));
            prop_assert!((pulled[input] - sum).abs() <= allowed, "by {}: {} pulled back, {} by definition", input, pulled[input], sum);
        }
        let pushed = collision.pushforward(&std::array::from_fn(|i| d[i])).expect("it is solved");
        for output in Output::ALL {
            let sum: f64 = Input::ALL.into_iter().map(|input| defined[output].by[input] * d[input.index()]).sum();
            let scale = scale(&collision, &defined, output);
            let allowed = 1e-9 * Input::ALL.into_iter().map(|input| (scale / size(&collision, input) * d[input.index()]).abs()).sum::<f64>();
            prop_assert!((pushed[output] - sum).abs() <= allowed, "{}: {} pushed forward, {} by definition", output, pushed[output], sum);
        }
    }
}

/// Weights may be of any size, and the derivatives of a weighted sum beyond the floats.
#[test]
fn a_weighted_derivative_beyond_the_floats_is_refused() {
    let collision = Collision::new(Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(12.0), Party::Barrier);
    for (weight, is_refused) in [(1e290, false), (1e308, true), (f64::NAN, true)] {
        let found = collision.pullback(&Outputs { loss: weight, ..Outputs::default() });
        assert_eq!(found.err(), is_refused.then(|| Refusal::OutOfFloatRange.into()), "{weight}");
    }
}

proptest! {
    #![proptest_config(fewer(20))]

    #[test]
    fn the_fast_curvature_is_the_definition(draw in computable(), at in 0..Output::COUNT) {
        let output = Output::ALL[at];
        let collision: Collision = draw.of();
        let impact = collision.evaluate();
        prop_assume!(is_tame(&collision, &impact));
        let (fast, defined) = (collision.curvature_of(&impact, output), curvature_by_definition(&collision, output));
        prop_assert_eq!(fast.value, defined.value);
        prop_assert_eq!(fast.by, collision.sensitivity_of(&impact, output).by);
        let sized = |i: Input, j: Input| size(&collision, i) * size(&collision, j);
        let pairs = || Input::ALL.into_iter().flat_map(|i| Input::ALL.into_iter().map(move |j| (i, j)));
        let first = scale(&collision, &by_definition(&collision), output);
        let scale = pairs().map(|(i, j)| (defined.twice[(i, j)] * sized(i, j)).abs()).fold(first, f64::max);
        for (i, j) in pairs() {
            let allowed = 1e-9 * scale / sized(i, j);
            let (one, other) = (fast.twice[(i, j)], defined.twice[(i, j)]);
            prop_assert!((one - other).abs() <= allowed, "{} by {} and {}: {} fast, {} by definition", output, i, j, one, other);
        }
    }
}

fn sticking(collision: &Collision) -> Impact {
    Collision { impulse_ratio: ImpulseRatio::Critical, ..*collision }.evaluate()
}

/// Returns `true` if friction limits the impulse.
fn slides(collision: &Collision) -> bool {
    matches!(collision.impulse_ratio, ImpulseRatio::LimitedByFriction(_)) && collision.evaluate().impulse != sticking(collision).impulse
}

/// Computes the impact on a scalar without an order: the friction limit, which needs a comparison, is decided in f64.
fn impact_without_order<T: Field>(collision: &Collision<T>, decided: &Collision) -> Impact<T> {
    let contact = collision.contact();
    let moment = collision.moment_impulse(&contact);
    let change = collision.sticking_change(&contact, moment.as_ref());
    let k = &contact.compliance;
    let impulse = match &collision.impulse_ratio {
        ImpulseRatio::Critical => k.impulse_for(change),
        ImpulseRatio::Given(ratio) => law::impulse_at_ratio(k, change.n, ratio.clone()),
        ImpulseRatio::OfCritical(fraction) => law::impulse_at_fraction(k, change, fraction.clone()),
        ImpulseRatio::LimitedByFriction(friction) => {
            if slides(decided) {
                let contact = decided.contact();
                let driven = decided.sticking_change(&contact, decided.moment_impulse(&contact).as_ref());
                let side = if sticking(decided).impulse.t * driven.n < 0.0 { T::int(-1) } else { T::int(1) };
                law::impulse_at_ratio(k, change.n, side * friction.clone())
            } else {
                k.impulse_for(change)
            }
        }
    };
    collision.impact_of(&contact, impulse, moment)
}

/// Returns the collision with an input changed by i h, where h² is negligible.
fn complex_step(collision: &Collision, input: Input, h: f64) -> Collision<Complex64> {
    let step = |other| Complex64::new(0.0, if input == other { h } else { 0.0 });
    // cos(θ + i h) = cos θ − i h sin θ and sin(θ + i h) = sin θ + i h cos θ, to h².
    let turned = |cos: f64, sin: f64, by: Complex64| (cos - by * sin, sin + by * cos);
    let party = |party: &Party, side| {
        party.vehicle().map_or(Party::Barrier, |vehicle| {
            let mut moved = vehicle.map(Complex64::from);
            (moved.heading.cos, moved.heading.sin) = turned(vehicle.heading.cos, vehicle.heading.sin, step(Input::Heading(side)));
            moved.mass += step(Input::Mass(side));
            moved.yaw_inertia += step(Input::YawInertia(side));
            moved.impact_center.forward += step(Input::ImpactCenterForward(side));
            moved.impact_center.left += step(Input::ImpactCenterLeft(side));
            moved.motion.velocity.x += step(Input::VelocityX(side));
            moved.motion.velocity.y += step(Input::VelocityY(side));
            moved.motion.yaw_rate += step(Input::YawRate(side));
            Party::Vehicle(moved)
        })
    };
    let (cos, sin) = turned(collision.crush_plane.cos, collision.crush_plane.sin, step(Input::CrushPlane));
    Collision {
        one: party(&collision.one, Side::One),
        two: party(&collision.two, Side::Two),
        crush_plane: CrushPlane { cos, sin },
        restitution: collision.restitution + step(Input::Restitution),
        impulse_ratio: collision.impulse_ratio.map(|x| x + step(Input::ImpulseRatio)),
        law: collision.law,
        moment: collision.moment.map(|x| x + step(Input::Moment)),
    }
}

/// Returns an output that is defined in any field, ΔV as an analytic function of its components; `None` for an angle.
fn analytic(output: Output, impact: &Impact<Complex64>, restitution: Complex64) -> Option<Complex64> {
    let of = |side| if side == Side::One { &impact.one } else { &impact.two };
    Some(match output {
        Output::VelocityX(side) => of(side).after.velocity.x,
        Output::VelocityY(side) => of(side).after.velocity.y,
        Output::YawRate(side) => of(side).after.yaw_rate,
        Output::DeltaVX(side) => of(side).delta_v.x,
        Output::DeltaVY(side) => of(side).delta_v.y,
        Output::DeltaVMagnitude(side) => of(side).delta_v.length_squared().sqrt(),
        Output::PrincipalDirectionOfForce(_) => return None,
        Output::Restitution => restitution,
        Output::ImpulseRatio => impact.impulse_ratio(),
        Output::CriticalImpulseRatio => impact.critical_impulse_ratio(),
        Output::NormalImpulse => impact.impulse.n,
        Output::TangentialImpulse => impact.impulse.t,
        Output::ImpulseX => impact.impulse_on_ground.x,
        Output::ImpulseY => impact.impulse_on_ground.y,
        Output::Moment => impact.moment,
        Output::NormalApproach => impact.approach.n,
        Output::TangentialApproach => impact.approach.t,
        Output::NormalSeparation => impact.separation.n,
        Output::TangentialSeparation => impact.separation.t,
        Output::EnergyBefore => impact.kinetic_energy.before,
        Output::EnergyAfter => impact.kinetic_energy.after,
        Output::Loss => impact.loss(),
        Output::NormalWork => impact.work.n,
        Output::TangentialWork => impact.work.t,
        Output::MomentWork => impact.work.m,
    })
}

/// Generates collisions with a moment impulse in a third of the cases.
fn with_moment() -> impl Strategy<Value = Collision> {
    (computable(), 0..6, -8..=8_i32).prop_map(|(draw, kind, amount)| {
        let moment = match kind {
            0 => Moment::Given(f64::from(amount)),
            1 => Moment::OfCritical(f64::from(amount.abs()) / 8.0),
            _ => Moment::None,
        };
        Collision { moment, ..draw.of() }
    })
}

proptest! {
    #![proptest_config(fewer(5))]

    #[test]
    fn the_definition_is_the_complex_step(collision in with_moment()) {
        const H: f64 = 1e-40;
        let impact = collision.evaluate();
        prop_assume!(is_tame(&collision, &impact) && impact.moment.abs() < 1e5);
        let defined = by_definition(&collision);
        for input in Input::ALL {
            let moved = complex_step(&collision, input, H);
            let after = impact_without_order(&moved, &collision);
            for output in Output::ALL {
                let Some(value) = analytic(output, &after, moved.restitution) else { continue };
                let (step, dual) = (value.im / H, defined[output].by[input]);
                let allowed = 1e-9 * scale(&collision, &defined, output) / size(&collision, input);
                prop_assert!((step - dual).abs() <= allowed, "{} by {}: {} by complex step, {} by dual numbers", output, input, step, dual);
            }
        }
    }

    #[test]
    fn central_differences_converge_to_the_definition(collision in with_moment(), at in 0..Input::COUNT) {
        let input = Input::ALL[at];
        let impact = collision.evaluate();
        // The critical moment may be a difference of nearly equal numbers, while the complex step contains no differences.
        prop_assume!(is_tame(&collision, &impact) && !matches!(collision.moment, Moment::OfCritical(_)));
        let defined = by_definition(&collision);
        let difference = |h: f64, output: Output| {
            let moved = |by: f64| {
                let moved = collision.shifted(|other| if other == input { by } else { 0.0 });
                Outputs::of(&moved, &moved.evaluate())[output]
            };
            let change = moved(h) - moved(-h);
            // A direction may pass through half a turn.
            let turn = if matches!(output, Output::PrincipalDirectionOfForce(_)) { std::f64::consts::TAU } else { f64::INFINITY };
            let change = if change.abs() > turn / 2.0 { change - turn.copysign(change) } else { change };
            change / (2.0 * h)
        };
        // There is a kink where friction begins to limit the impulse.
        let step = size(&collision, input) / 512.0;
        let at = |by: f64| slides(&collision.shifted(|other| if other == input { by } else { 0.0 }));
        prop_assume!(at(step) == at(-step));
        // The impulse changes direction where the approach ends or the pair wedges.
        let turns = |x: &Sensitive| (x.by[input] * step).abs() > 0.1 * x.value.abs();
        prop_assume!(!turns(&defined.approach.n) && !turns(&defined.impulse.n));
        for output in Output::ALL {
            let exact = defined[output].by[input];
            let scale = scale(&collision, &defined, output) / size(&collision, input);
            let error = |h: f64| (difference(h, output) - exact).abs();
            let (coarse, middle, fine) = (error(step), error(step / 2.0), error(step / 4.0));
            // The draws are integers, so quantities that cancel were of order one.
            let floor = 1e-9 * (scale + 1.0 / size(&collision, input));
            // A step that changes the output by a large fraction crosses a pole.
            let alike = Output::ALL.into_iter().filter(|&other| kind(other) == kind(output));
            let value = alike.map(|other| defined[other].value.abs()).fold(0.0, f64::max);
            if exact.abs() * step > 0.02 * value {
                continue;
            }
            // Second order: each halving leaves a quarter of the error, down to rounding.
            prop_assert!(middle <= coarse / 3.0 + floor, "{} by {}: {} then {}", output, input, coarse, middle);
            prop_assert!(fine <= middle / 3.0 + floor, "{} by {}: {} then {}", output, input, middle, fine);
        }
    }

    #[test]
    fn second_derivatives_are_symmetric(draw in computable(), at in 0..Output::COUNT) {
        let collision: Collision = draw.of();
        let impact = collision.evaluate();
        prop_assume!(is_tame(&collision, &impact));
        let curved = collision.curvature_of(&impact, Output::ALL[at]);
        for one in Input::ALL {
            for other in Input::ALL {
                prop_assert_eq!(curved.twice[(one, other)], curved.twice[(other, one)]);
            }
        }
    }

    #[test]
    fn derivatives_are_refused_where_the_solution_is(collision in with_moment()) {
        let dual = collision.map(Dual64::from).shifted(|_| Dual64::new(0.0, 1.0));
        match collision.solve() {
            Ok(impact) => {
                prop_assert!(dual.solve().is_ok());
                let outputs = Outputs::of(&collision, &impact);
                let all = collision.sensitivities().expect("as the solution");
                for output in Output::ALL {
                    prop_assert_eq!(all[output].value.to_bits(), outputs[output].to_bits());
                }
            }
            Err(refusals) => {
                let of_dual = dual.solve().expect_err("as the solution");
                let codes: Vec<_> = refusals.iter().map(Issue::code).collect();
                prop_assert_eq!(of_dual.iter().map(Issue::code).collect::<Vec<_>>(), codes);
                prop_assert_eq!(collision.sensitivities().expect_err("as the solution"), refusals.clone());
                prop_assert_eq!(collision.sensitivity(Output::Loss).expect_err("as the solution"), refusals.clone());
                prop_assert_eq!(collision.curvature(Output::Loss).expect_err("as the solution"), refusals);
            }
        }
    }
}
