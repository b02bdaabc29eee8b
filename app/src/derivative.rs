//! Exact derivatives of the outputs with respect to the parameters, by evaluating the solution with dual numbers.

use num_dual::{Dual64, HyperDual64};

use crate::case::{CaseOutputs, Inputs, Parameter};

/// Computes the outputs and, as their infinitesimal parts, their derivatives with respect to a parameter.
pub fn by(inputs: &Inputs, parameter: Parameter) -> CaseOutputs<Dual64> {
    inputs.setup(|other| Dual64::new(0.0, if other == parameter { 1.0 } else { 0.0 })).evaluate()
}

/// Computes the outputs with their derivatives with respect to each of two parameters, which may be the same, and their second derivatives.
pub fn by_both(inputs: &Inputs, one: Parameter, two: Parameter) -> CaseOutputs<HyperDual64> {
    let unit = |is: bool| if is { 1.0 } else { 0.0 };
    inputs.setup(|other| HyperDual64::new(0.0, unit(other == one), unit(other == two), 0.0)).evaluate()
}
