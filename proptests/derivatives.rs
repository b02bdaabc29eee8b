//! The derivatives: the fast way against its definition by dual numbers, and the definition against the complex step and central differences.
//!
//! `==` on dual numbers compares values alone; here derivatives are compared.

use crate::strategies::{computable, config};
use planar_impact::sensitivity::{by_definition, curvature_by_definition};
use planar_impact::*;
use proptest::prelude::*;
use proptest::test_runner::Config;

/// How far an input would have to move to matter: its own size, or one unit.
fn size(collision: &Collision, input: Input) -> f64 {
    match input {
        Input::Mass(_) | Input::YawInertia(_) => collision.input(input).unwrap_or(1.0),
        _ => 1.0,
    }
}

/// Outputs that are measured alike, so that the rounding of one may be as large as that of another.
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

/// Whether nothing in this collision is near to a division by zero, by which the rounding of both sides would grow beyond any bound.
fn is_tame(collision: &Collision, impact: &Impact) -> bool {
    let apart = |p: Nt| p.n.abs() > 1e-3 * p.length();
    impact.approach.n.abs() > 1e-3 && apart(impact.impulse) && apart(impact.critical_impulse) && impact.impulse.length() < 1e5 && {
        let contact = collision.contact();
        let sticking = collision.law.change(contact.approach, collision.restitution);
        let sticking = contact.compliance.impulse_for(sticking);
        sticking.n.abs() > 1e-3 * sticking.length()
    }
}

/// The largest effect of any input on any output of its kind.
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

proptest! {
    #![proptest_config(Config { cases: config().cases / 20, ..config() })]

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
