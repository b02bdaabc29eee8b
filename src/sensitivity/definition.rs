//! The definition of a derivative: dual numbers through the one solution.

use super::{Curved, Gradient, Hessian, Sensitive};
use crate::collision::Collision;
use crate::input::Input;
use crate::output::{Output, Outputs};
use num_dual::{Dual64, HyperDual64};

/// Computes every output with its derivatives by every input, one evaluation on [`Dual64`] for each input. The collision is not checked, as with
/// [`Collision::evaluate`].
pub fn by_definition(collision: &Collision) -> Outputs<Sensitive> {
    let nothing = Gradient([0.0; Input::COUNT]);
    let mut outputs = Outputs::of(collision, &collision.evaluate()).map(|value| Sensitive { value, by: nothing });
    for input in Input::ALL {
        let duals = along(collision, |other| if other == input { 1.0 } else { 0.0 });
        for output in Output::ALL {
            outputs[output].by[input] = duals[output].eps;
        }
    }
    outputs
}

/// Computes every output with its derivative along a direction of the inputs.
pub(super) fn along(collision: &Collision, direction: impl Fn(Input) -> f64) -> Outputs<Dual64> {
    let seeded = collision.map(Dual64::from).shifted(|input| Dual64::new(0.0, direction(input)));
    Outputs::of(&seeded, &seeded.evaluate())
}

/// Computes one output with its first and second derivatives, one evaluation on [`HyperDual64`] for each pair of inputs. The collision is not checked, as
/// with [`Collision::evaluate`].
pub fn curvature_by_definition(collision: &Collision, of: Output) -> Curved {
    let mut curved = Curved {
        value: of.of(collision, &collision.evaluate()),
        by: Gradient([0.0; Input::COUNT]),
        twice: Hessian([[0.0; Input::COUNT]; Input::COUNT]),
    };
    for (i, one) in Input::ALL.into_iter().enumerate() {
        for (j, other) in Input::ALL.into_iter().enumerate().skip(i) {
            let seeded = collision.map(HyperDual64::from).shifted(|input| {
                let unit = |seeded: Input| if input == seeded { 1.0 } else { 0.0 };
                HyperDual64::new(0.0, unit(one), unit(other), 0.0)
            });
            let output = Outputs::of(&seeded, &seeded.evaluate())[of];
            curved.by.0[i] = output.eps1;
            curved.twice.0[i][j] = output.eps1eps2;
            curved.twice.0[j][i] = output.eps1eps2;
        }
    }
    curved
}
