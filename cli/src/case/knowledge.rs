//! What a case file says is known of a crash, and what of it is unknown.

use planar_impact::reconstruct::{Measurable, Uncertainty, Variable};
use planar_impact::{Input, Output, Side, Xy};

use super::answers::Answer;
use super::parameter::Parameter;
use crate::units::Measure;

/// What the file says of what is known after the crash and of what is asked, in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Knowledge {
    /// The evidence, in the order of the file.
    pub evidence: Vec<Known>,
    /// What is unknown, in the order of the file.
    pub unknowns: Vec<Sought>,
    /// The keys that the vehicles and the contact leave out because they are unknown, each with its place in the file.
    pub left_out: Vec<LeftOut>,
}

/// A piece of evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// What it is of.
    pub of: Measurable,
    /// Its place in the file, such as `evidence.vehicle.1.separation_velocity.1`.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// How well it is known.
    pub uncertainty: Uncertainty,
}

/// An unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Sought {
    /// What it is.
    pub of: Variable,
    /// Its place in the file.
    pub key: String,
    /// Where the search starts, if the file says so.
    pub start: Option<f64>,
    /// The least it may be.
    pub min: Option<f64>,
    /// The most it may be.
    pub max: Option<f64>,
    /// How well the start is known beforehand.
    pub prior: Option<f64>,
    /// The parameter that it is called by: of the ratio there are several.
    pub called: Option<Parameter>,
}

/// A key that the file leaves out because it is unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// What is left out.
    pub of: Variable,
    /// Where the file says that it is unknown.
    pub key: String,
}

impl Known {
    /// The input of the collision that it is of, if it is of one.
    pub fn variable(&self) -> Option<Variable> {
        match self.of {
            Measurable::Variable(variable) => Some(variable),
            _ => None,
        }
    }
}

impl Knowledge {
    /// The evidence of something.
    pub fn of(&self, of: Measurable) -> Option<&Known> {
        self.evidence.iter().find(|known| known.of == of)
    }

    /// Whether something is to be solved for by the word of the file.
    pub fn seeks(&self, variable: Variable) -> bool {
        self.unknowns.iter().any(|sought| sought.of == variable)
    }

    /// The separation velocity of each vehicle, where the evidence has both components.
    pub fn separation(&self) -> [Option<Xy>; 2] {
        [Side::One, Side::Two].map(|side| {
            let component = |output| self.of(Measurable::Output(output)).map(|known| known.value);
            Some(Xy { x: component(Output::VelocityX(side))?, y: component(Output::VelocityY(side))? })
        })
    }
}

/// What a piece of evidence measures.
pub fn measure_of(of: Measurable) -> Measure {
    match of {
        Measurable::Variable(variable) => measure_of_variable(variable),
        Measurable::Output(output) => Answer::Impact(output).measure(),
        Measurable::CrushEnergy | Measurable::CrushEnergyOf(_) => Measure::Energy,
        Measurable::SeparationDirection(_) | Measurable::ApproachDirection(_) => Measure::Angle,
        Measurable::SeparationSpeed(_) | Measurable::DeltaVForward(_) | Measurable::DeltaVLeft(_) => Measure::Speed,
    }
}

/// What an unknown measures. That of the moment is an impulse even where the case gives a fraction of the critical one.
pub fn measure_of_variable(variable: Variable) -> Measure {
    parameter_of(variable).map_or(Measure::Ratio, Parameter::measure)
}

/// The key of a case file that an unknown is; none of what no other verb knows.
pub fn parameter_of(variable: Variable) -> Option<Parameter> {
    match variable {
        Variable::Input(input) => Some(Parameter::Input(input)),
        Variable::Speed(side) => Some(Parameter::Speed(side)),
        Variable::CrushShare => None,
    }
}

/// Every name that evidence has, for what is nearest to one that it has not.
pub fn names_of_evidence() -> impl Iterator<Item = String> {
    Measurable::all().map(|of| of.name().to_owned()).chain(PAIRS.into_iter().flat_map(|pair| [1, 2].map(|i| format!("vehicle.{i}.{pair}"))))
}

/// What is given as an array of two: ground axes or those of the vehicle.
const PAIRS: [&str; 4] = ["separation_velocity", "delta_v", "velocity", "impact_center"];

/// Every name that an unknown has.
pub fn names_of_unknowns() -> impl Iterator<Item = &'static str> {
    let inputs = Input::ALL.into_iter().map(Variable::Input);
    inputs.chain([Variable::Speed(Side::One), Variable::Speed(Side::Two), Variable::CrushShare]).map(Variable::name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_of_evidence_can_be_written_in_its_unit() {
        for of in Measurable::all() {
            assert_eq!(Measurable::named(of.name()), Some(of), "{}", of.name());
            let measure = measure_of(of);
            for units in [crate::units::Units::Us, crate::units::Units::Si] {
                let text = format!("1 {}", units.unit(measure));
                assert!(crate::quantity::parse(&text, measure.kind()).is_ok(), "{}: {text}", of.name());
            }
        }
    }

    #[test]
    fn every_unknown_is_called_by_its_name() {
        for name in names_of_unknowns() {
            assert_eq!(Variable::named(name).map(Variable::name), Some(name));
        }
        for pair in names_of_evidence().filter(|name| Measurable::named(name).is_none()) {
            let is_half = |end: &str| Measurable::named(&format!("{pair}.{end}")).is_some();
            assert!(is_half("x") && is_half("y") || is_half("forward") && is_half("left"), "{pair}");
        }
    }
}
