//! Exact derivatives of the answers by the parameters: dual numbers through the one solution.

use num_dual::{Dual64, HyperDual64};

use crate::case::{Answers, Inputs, Parameter};

/// The answers and, as their infinitesimal parts, their derivatives by a parameter.
pub fn by(inputs: &Inputs, parameter: Parameter) -> Answers<Dual64> {
    inputs.setup(|other| Dual64::new(0.0, if other == parameter { 1.0 } else { 0.0 })).evaluate()
}

/// The answers with their derivatives by each of two parameters, which may be one, and by both.
pub fn by_both(inputs: &Inputs, one: Parameter, two: Parameter) -> Answers<HyperDual64> {
    let unit = |is: bool| if is { 1.0 } else { 0.0 };
    inputs.setup(|other| HyperDual64::new(0.0, unit(other == one), unit(other == two), 0.0)).evaluate()
}
