//! The definition of a derivative: dual numbers through the one solution.

use super::dual::Dual;
use super::{Curved, Gradient, Hessian, Sensitive};
use crate::collision::Collision;
use crate::input::Input;
use crate::output::{Output, Outputs};
use crate::scalar::{Logic, Real};

/// Computes every output with its derivatives by every input, one evaluation on dual numbers for each input. The collision is not checked, as with
/// [`Collision::evaluate`].
pub fn by_definition<T: Real<Mask: Logic> + Copy>(collision: &Collision<T>) -> Outputs<Sensitive<T>> {
    let mut outputs = Outputs::of(collision, &collision.evaluate()).map(|value| Sensitive { value, by: Gradient::zero() });
    for input in Input::ALL {
        let duals = along(collision, |other| unit(other, input));
        for output in Output::ALL {
            outputs[output].by[input] = duals[output].derivative;
        }
    }
    outputs
}

/// Computes every output with its derivative along a direction of the inputs.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along<T: Real<Mask: Logic> + Copy>(collision: &Collision<T>, direction: impl Fn(Input) -> T) -> Outputs<Dual<T>> {
    let seeded = collision.map(Dual::constant).shifted(|input| Dual { value: T::int(0), derivative: direction(input) });
    Outputs::of(&seeded, &seeded.evaluate())
}

/// Computes one output with its first and second derivatives, one evaluation on nested dual numbers for each pair of inputs. The collision is not checked, as
/// with [`Collision::evaluate`].
pub fn curvature_by_definition<T: Real<Mask = bool> + Copy>(collision: &Collision<T>, of: Output) -> Curved<T> {
    let mut curved = Curved { value: of.of(collision, &collision.evaluate()), by: Gradient::zero(), twice: Hessian::zero() };
    for (i, one) in Input::ALL.into_iter().enumerate() {
        let seeded = collision.map(Dual::constant).shifted(|input| Dual { value: T::int(0), derivative: unit(input, one) });
        for (j, other) in Input::ALL.into_iter().enumerate().skip(i) {
            let output = along(&seeded, |input| Dual::constant(unit(input, other)))[of];
            curved.by.0[i] = output.value.derivative;
            curved.twice.0[i][j] = output.derivative.derivative;
            curved.twice.0[j][i] = output.derivative.derivative;
        }
    }
    curved
}

fn unit<T: Real>(input: Input, seeded: Input) -> T {
    T::int(i32::from(input == seeded))
}
