//! Exact derivatives of the outputs with respect to the parameters, by evaluating the solution with dual numbers.

use num_dual::{Dual64, HyperDual64};

use crate::case::{CaseOutput, CaseOutputs, Crash3Key, Inputs, Parameter};
use crate::named::positive_zero;

/// Computes the outputs and, as their infinitesimal parts, their derivatives with respect to a parameter.
pub fn by(inputs: &Inputs, parameter: Parameter) -> CaseOutputs<Dual64> {
    inputs.setup(|other| Dual64::new(0.0, if other == parameter { 1.0 } else { 0.0 })).evaluate()
}

/// Computes the outputs with their derivatives with respect to each of two parameters, which may be the same, and their second derivatives.
pub fn by_both(inputs: &Inputs, one: Parameter, two: Parameter) -> CaseOutputs<HyperDual64> {
    let unit = |is: bool| if is { 1.0 } else { 0.0 };
    inputs.setup(|other| HyperDual64::new(0.0, unit(other == one), unit(other == two), 0.0)).evaluate()
}

/// Replaces a derivative that does not exist with NaN. A square root has no derivative at zero: a speed computed from zero crush energy has none with respect
/// to the crush, and does not depend on the other inputs.
pub fn defined(output: CaseOutput, value: f64, by: &[Parameter], derivative: Option<f64>) -> f64 {
    let is_root = matches!(output, CaseOutput::EquivalentEnergySpeed(_) | CaseOutput::Crash3(_, Crash3Key::DeltaVMagnitude));
    let at_corner = is_root && value == 0.0 && by.iter().any(|parameter| matches!(parameter, Parameter::Crush(..)));
    derivative.filter(|_| !at_corner).map_or(f64::NAN, positive_zero)
}
