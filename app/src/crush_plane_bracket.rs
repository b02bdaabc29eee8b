//! Outputs at both ends of the crush-plane bracket, and at the nominal plane.

use planar_impact::{CrushPlaneBracket, Input};
use schemars::JsonSchema;
use serde::Serialize;

use crate::case::{Case, Parameter};
use crate::derivative;
use crate::message::Sentence;
use crate::named::{Named, positive_zero};
use crate::wording;

const CRUSH_PLANE: Parameter = Parameter::Input(Input::CrushPlane);

/// The bracket of the crush plane between the two surfaces in contact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Bracket {
    /// At its lower end.
    pub lower: End,
    /// At its upper end.
    pub upper: End,
    /// Derivatives with respect to the crush plane at its nominal angle, in SI per rad.
    #[schemars(with = "Named<Option<f64>>")]
    pub d: Named<f64>,
}

/// One end of the bracket.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct End {
    /// Angle of the crush plane in rad.
    pub crush_plane: f64,
    /// The outputs there; `null` if the collision is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Named<Option<f64>>>")]
    pub outputs: Option<Named<f64>>,
    /// Reason why the collision is refused there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<Sentence>,
}

impl Bracket {
    /// Computes the bracket of a case that gives the surfaces in contact.
    pub fn of(case: &Case, bracket: &CrushPlaneBracket) -> Self {
        let outputs = case.setup.outputs();
        let end = |crush_plane| {
            let solved = case.inputs.set_all(&[(CRUSH_PLANE, crush_plane)]).as_given().solve();
            End {
                crush_plane,
                outputs: solved.as_ref().ok().map(|at| {
                    let value = |&output| at.get(output).map(|value| (output, positive_zero(value)));
                    outputs.iter().filter_map(value).collect()
                }),
                refused: solved.err().map(|refusals| Sentence(wording::reasons(&refusals))),
            }
        };
        let derivatives = derivative::by(&case.inputs, CRUSH_PLANE);
        let derivative = |output| derivatives.get(output).map_or(f64::NAN, |dual| positive_zero(dual.eps));
        Bracket {
            lower: end(bracket.lower()),
            upper: end(bracket.upper()),
            d: outputs.iter().map(|&output| (output, derivative(output))).collect(),
        }
    }
}
