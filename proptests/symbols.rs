//! Formulas evaluate to what the code computes, and their derivatives to those of dual numbers.

use crate::exact_dual::ExactDual;
use crate::rational::Rational;
use crate::strategies::{Draw, Fraction, RatioDraw, computable, draw, fewer};
use num_dual::Dual64;
use planar_impact::formula::Formulas;
use planar_impact::*;
use proptest::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex};

/// Returns the formulas for collisions like this one, computed once for each kind.
fn formulas(collision: &Collision<f64>) -> Arc<Formulas> {
    static MADE: LazyLock<Mutex<HashMap<String, Arc<Formulas>>>> = LazyLock::new(Mutex::default);
    let kind = format!("{:?}", collision.map(|_| ()));
    let mut made = MADE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    made.entry(kind).or_insert_with(|| Arc::new(Formulas::of(collision))).clone()
}

/// A collision with its moment impulse.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    draw: Draw,
    moment: Moment<Fraction>,
}

impl Case {
    pub fn of<T: Field>(&self) -> Collision<T> {
        Collision { moment: self.moment.map(Fraction::of), ..self.draw.of() }
    }

    /// Returns an input in floats, with angles as angles.
    pub fn float(&self, name: &str) -> f64 {
        Input::named(name).and_then(|input| self.of::<f64>().input(input)).expect("a formula has the inputs of its collision")
    }

    /// Returns the collision with directions computed from those angles, and its derivative with respect to an input.
    fn with_angles(&self, by: Option<Input>) -> Collision<Dual64> {
        let dual = |input: Input, value: f64| Dual64::new(value, f64::from(u8::from(Some(input) == by)));
        let mut collision = self.of::<f64>().map(Dual64::from).shifted(|input| match input {
            Input::CrushPlane | Input::Heading(_) => 0.0.into(),
            _ => dual(input, 0.0),
        });
        let angle = |input: Input| dual(input, self.float(input.symbol()));
        collision.crush_plane = CrushPlane::from_angle(angle(Input::CrushPlane));
        for (party, side) in [(&mut collision.one, Side::One), (&mut collision.two, Side::Two)] {
            if let Party::Vehicle(vehicle) = party {
                vehicle.heading = Heading::from_angle(angle(Input::Heading(side)));
            }
        }
        collision
    }

    fn outputs(&self, by: Option<Input>) -> Outputs<Dual64> {
        let collision = self.with_angles(by);
        Outputs::of(&collision, &collision.evaluate())
    }

    /// Returns `false` near points where an output has no derivative, or an ill-conditioned one: poles of the impulse
    /// or the moment impulse, zero change of velocity, and the onset of the friction limit.
    pub fn is_smooth(&self) -> bool {
        let collision = self.with_angles(None);
        let contact = collision.contact();
        let impact = collision.evaluate();
        let (impulse, sticking) = (impact.impulse.map(|x| x.re), impact.critical_impulse.map(|x| x.re));
        let stiffness = contact.compliance.along_ratio(impact.impulse_ratio()).re / contact.compliance.nn().re;
        let on_the_edge = match self.draw.ratio {
            RatioDraw::LimitedByFriction(friction) => {
                (friction.of::<f64>() * sticking.n.abs() - sticking.t.abs()).abs() < 1e-3 * sticking.length()
            }
            _ => false,
        };
        // The moment compliance that remains after the impulse that accompanies a moment.
        let row = contact.moment_compliance();
        let turning = match self.moment {
            Moment::None => 1.0,
            _ => 1.0 - (row.force.dot(contact.compliance.impulse_for(row.force)) / row.moment).re,
        };
        let normal = |impulse: Nt| impulse.n.abs() / impulse.length();
        let all = [normal(impulse), normal(sticking), impulse.length(), contact.approach.n.re.abs(), stiffness.abs(), turning];
        // NaN, which occurs without any impulse, is not above the limit either.
        all.into_iter().all(|size| size > 1e-2) && impulse.length() < 1e4 && sticking.length() < 1e4 && !on_the_edge
    }

    /// Returns the collision in exact numbers, each with its derivative with respect to an input.
    fn differentiated(&self, by: Input) -> Collision<ExactDual> {
        let number = |value: Rational| ExactDual::number(value, 0);
        let one = || Rational::int(1);
        self.of::<Rational>().map(number).shifted(|input| match input {
            Input::CrushPlane | Input::Heading(_) => ExactDual::angle(one(), one() - one(), (input == by).into()),
            _ => ExactDual::number(one() - one(), (input == by).into()),
        })
    }

    /// Returns the inputs in exact numbers, each with its derivative with respect to an input.
    fn exact(&self, by: Option<Input>) -> HashMap<&'static str, ExactDual> {
        let collision = self.of::<Rational>();
        let heading = |side| match side {
            Side::One => collision.one.vehicle().map(|vehicle| vehicle.heading.clone()),
            Side::Two => collision.two.vehicle().map(|vehicle| vehicle.heading.clone()),
        };
        let numbers = collision.clone().map(|value| ExactDual::number(value, 0));
        let inputs = Input::ALL.into_iter().filter_map(|input| {
            let slope = i32::from(by == Some(input));
            let value = match input {
                Input::CrushPlane => ExactDual::angle(collision.crush_plane.cos.clone(), collision.crush_plane.sin.clone(), slope),
                Input::Heading(side) => heading(side).map(|heading| ExactDual::angle(heading.cos, heading.sin, slope))?,
                _ => numbers.input(input)? + ExactDual::number(Rational::int(0), slope),
            };
            Some((input.symbol(), value))
        });
        inputs.collect()
    }
}

pub fn case(draws: impl Strategy<Value = Draw>) -> impl Strategy<Value = Case> {
    let moment = prop_oneof![
        3 => Just(Moment::None),
        1 => (-9..=9_i32).prop_map(|moment| Moment::Given(Fraction(moment, 1))),
        1 => (0..=4_i32).prop_map(|quarters| Moment::OfCritical(Fraction(quarters, 4))),
    ];
    (draws, moment).prop_map(|(draw, moment)| Case { draw, moment })
}

fn any_input() -> impl Strategy<Value = Input> {
    prop::sample::select(Input::ALL.to_vec())
}

/// Returns the greatest magnitude of all outputs, and at least 1.
fn scale(outputs: Outputs<f64>) -> f64 {
    let mut greatest = 1.0_f64;
    outputs.map(|x| greatest = greatest.max(x.abs()));
    greatest
}

/// Returns the distance of two values of an output; of two directions, the distance within one turn.
fn apart(output: Output, a: f64, b: f64) -> f64 {
    let difference = (a - b).abs();
    match output {
        Output::PrincipalDirectionOfForce(_) => difference.min(core::f64::consts::TAU - difference),
        _ => difference,
    }
}

fn same(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

proptest! {
    // Each case compares all outputs, and a formula takes a million times as long as a float.
    #![proptest_config(fewer(100))]

    #[test]
    fn the_record_is_the_kernel_to_the_bit(case in case(draw())) {
        let collision = case.with_angles(None).map(|x| x.re);
        let outputs = Outputs::of(&collision, &collision.evaluate());
        for output in Output::ALL {
            let recorded = formulas(&case.of()).record(output).evaluate(|name| case.float(name));
            prop_assert!(same(recorded, outputs[output]), "{}: {} for {}", output, recorded, outputs[output]);
        }
    }

    #[test]
    fn the_formula_is_the_kernel_to_rounding(case in case(computable()).prop_filter("no float knows much", Case::is_smooth)) {
        let outputs = case.outputs(None);
        let scale = scale(outputs.map(|x| x.re));
        for output in Output::ALL {
            let formula = formulas(&case.of()).output(output).clone();
            let (computed, exact) = (formula.evaluate(|name| case.float(name)), outputs[output].re);
            prop_assert!(apart(output, computed, exact) <= 1e-11 * scale, "{} for {} of {}", computed, exact, formula);
        }
    }

    #[test]
    fn the_derivative_is_that_of_dual_numbers(case in case(computable()).prop_filter("not smooth", Case::is_smooth), by in any_input()) {
        let outputs = case.outputs(Some(by));
        let scale = scale(outputs.map(|x| x.re)) + scale(outputs.map(|x| x.eps));
        for output in Output::ALL {
            let derivative = formulas(&case.of()).output(output).derivative(by.symbol());
            let (computed, exact) = (derivative.evaluate(|name| case.float(name)), outputs[output].eps);
            prop_assert!((computed - exact).abs() <= 1e-10 * scale, "{} for {} of {}", computed, exact, derivative);
        }
    }

    #[test]
    fn the_formula_and_its_derivative_are_those_of_the_kernel_in_rationals(case in case(computable()), by in any_input()) {
        let collision = case.differentiated(by);
        let outputs = Outputs::of(&collision, &collision.evaluate());
        let (constant, varied) = (case.exact(None), case.exact(Some(by)));
        for output in Output::ALL {
            let Some((value, slope)) = outputs[output].clone().parts() else { continue };
            let formula = formulas(&case.of()).output(output).clone();
            let computed = formula.evaluate(|name| varied[name].clone()).parts();
            prop_assert_eq!(computed, Some((value, slope.clone())), "{}", formula);
            let derivative = formula.derivative(by.symbol());
            let computed = derivative.evaluate(|name| constant[name].clone()).parts();
            prop_assert_eq!(computed.map(|(value, _)| value), Some(slope), "{}", derivative);
        }
    }
}
