//! Evidence and unknowns of a case file.

use planar_impact::reconstruct::{Correlation, Measurand, Uncertainty, Variable};
use planar_impact::{Input, Output, Side, Xy};

use super::parameter::Parameter;

/// Evidence and unknowns of a case file, in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Knowledge {
    /// The evidence, in the order of the file.
    pub evidence: Vec<Known>,
    /// Correlations of pieces that come from one recording.
    pub correlations: Vec<Correlation>,
    /// The unknowns, in the order of the file.
    pub unknowns: Vec<RequestedUnknown>,
    /// Keys left out of the vehicles and the contact because they are unknown, or because the evidence measures them.
    pub left_out: Vec<LeftOut>,
}

/// A piece of evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// The measured quantity.
    pub of: Measurand,
    /// Its path in the file, such as `evidence.vehicle.1.separation_velocity.1`.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// Its uncertainty.
    pub uncertainty: Uncertainty,
    /// `true` if it is a crush energy that the file takes from the crush.
    pub is_from_crush: bool,
}

/// An unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedUnknown {
    /// The quantity.
    pub of: Variable,
    /// Its path in the file.
    pub key: String,
    /// Starting value of the search, if the file gives one.
    pub start: Option<f64>,
    /// Lower bound.
    pub min: Option<f64>,
    /// Upper bound.
    pub max: Option<f64>,
    /// Prior standard deviation of the start.
    pub prior: Option<f64>,
    /// The parameter that names it in the file; the impulse ratio has several.
    pub called: Option<Parameter>,
}

/// A key left out of the vehicles and the contact because it is unknown, or because the evidence measures it.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// The quantity left out.
    pub of: Variable,
    /// Path of the entry that declares it unknown, or of the evidence that measures it.
    pub key: String,
}

/// Returns the correlation of two pieces of evidence with their covariance and standard deviations; `None` if there is none. Where all of their errors are the same,
/// rounding would make their matrix singular: they differ by a ten-thousandth of their standard deviation.
pub(crate) fn correlation_of([one, other]: [Measurand; 2], covariance: f64, sds: [f64; 2]) -> Option<Correlation> {
    const GREATEST: f64 = 1.0 - 1e-8;
    let coefficient = || (covariance / (sds[0] * sds[1])).clamp(-GREATEST, GREATEST);
    let is_correlated = covariance != 0.0 && sds.iter().all(|sd| *sd > 0.0);
    is_correlated.then(|| Correlation { one, other, coefficient: coefficient() })
}

impl LeftOut {
    /// Returns `true` if it is left out because the evidence measures it, and not because it is listed as unknown.
    pub fn is_evidence(&self) -> bool {
        self.key.starts_with("evidence.")
    }
}

impl Known {
    /// Returns the input variable that this evidence measures, if it measures one.
    pub fn variable(&self) -> Option<Variable> {
        match self.of {
            Measurand::Variable(variable) => Some(variable),
            _ => None,
        }
    }
}

impl Knowledge {
    /// Returns the evidence of a measurand.
    pub fn of(&self, of: Measurand) -> Option<&Known> {
        self.evidence.iter().find(|known| known.of == of)
    }

    /// Returns `true` if the file requests this variable as an unknown.
    pub fn seeks(&self, variable: Variable) -> bool {
        self.unknowns.iter().any(|requested| requested.of == variable)
    }

    /// Returns the separation velocity of each vehicle, or `None` if the evidence lacks a component.
    pub fn separation(&self) -> [Option<Xy>; 2] {
        [Side::One, Side::Two].map(|side| {
            let component = |output| self.of(Measurand::Output(output)).map(|known| known.value);
            Some(Xy { x: component(Output::VelocityX(side))?, y: component(Output::VelocityY(side))? })
        })
    }
}

/// Returns the case-file parameter of an unknown, or `None` if only `reconstruct` has it.
pub fn parameter_of(variable: Variable) -> Option<Parameter> {
    match variable {
        Variable::Input(input) => Some(Parameter::Input(input)),
        Variable::Speed(side) => Some(Parameter::Speed(side)),
        Variable::RadiusOfGyration(side) => Some(Parameter::RadiusOfGyration(side)),
        Variable::CrushShare | Variable::Impulse(_) | Variable::SkidSpeed(_) => None,
    }
}

/// Returns the variable of a reconstruction that a parameter of the case is, or `None` for a number of the crush and the scatter of a restitution.
pub fn variable_of(parameter: Parameter) -> Option<Variable> {
    match parameter {
        Parameter::Input(input) => Some(Variable::Input(input)),
        Parameter::Speed(side) => Some(Variable::Speed(side)),
        Parameter::RadiusOfGyration(side) => Some(Variable::RadiusOfGyration(side)),
        Parameter::Friction | Parameter::RatioOfCritical => Some(Variable::Input(Input::ImpulseRatio)),
        Parameter::MomentOfCritical => Some(Variable::Input(Input::Moment)),
        Parameter::RestitutionScatter | Parameter::Crush(..) | Parameter::Skid(..) | Parameter::RestFriction => None,
    }
}

/// Returns every name that evidence may have, to suggest the nearest one for a misspelled name.
pub fn names_of_evidence() -> impl Iterator<Item = String> {
    Measurand::all().map(|of| of.name().to_owned()).chain(PAIRS.into_iter().flat_map(|pair| [1, 2].map(|i| format!("vehicle.{i}.{pair}"))))
}

/// Quantities given as an array of two, in ground axes or in vehicle axes.
const PAIRS: [&str; 4] = ["separation_velocity", "delta_v", "velocity", "impact_center"];

/// Returns every name that an unknown may have.
pub fn names_of_unknowns() -> impl Iterator<Item = &'static str> {
    let inputs = Input::ALL.into_iter().map(Variable::Input);
    inputs.chain([Variable::Speed(Side::One), Variable::Speed(Side::Two), Variable::CrushShare]).map(Variable::name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_of_evidence_can_be_written_in_its_unit() {
        for of in Measurand::all() {
            assert_eq!(Measurand::named(of.name()), Some(of), "{}", of.name());
            let measure = of.measure();
            for units in [crate::units::Units::Us, crate::units::Units::Si] {
                let text = format!("1 {}", units.unit(measure));
                assert!(crate::quantity::parse(&text, measure.into()).is_ok(), "{}: {text}", of.name());
            }
        }
    }

    #[test]
    fn evidence_alone_is_no_value() {
        let text = include_str!("../../../cli/examples/reconstruct/two-cars.toml").to_owned();
        let case = crate::case::Case::parse(crate::source::Source::new("case.toml", text.clone())).expect("a case");
        let issues = case.needs_everything().expect_err("numbers are unknown");
        let line = |name: &str| {
            let issue = issues.list().iter().find(|issue| issue.path == name).expect("an issue");
            (text[issue.span.clone().expect("a place")].to_owned(), issue.message.to_string())
        };
        let (place, message) = line("vehicle.2.speed");
        assert!(place.starts_with("[[vehicle]]") && message.contains("`[evidence]` measures it"), "{place}: {message}");
        let (place, message) = line("vehicle.1.speed");
        assert!(place.contains("start") && message.contains("listed under `[unknown]`"), "{place}: {message}");
    }

    #[test]
    fn every_unknown_is_called_by_its_name() {
        for name in names_of_unknowns() {
            assert_eq!(Variable::named(name).map(Variable::name), Some(name));
        }
        for pair in names_of_evidence().filter(|name| Measurand::named(name).is_none()) {
            let is_half = |end: &str| Measurand::named(&format!("{pair}.{end}")).is_some();
            assert!(is_half("x") && is_half("y") || is_half("forward") && is_half("left"), "{pair}");
        }
    }

    #[test]
    fn errors_that_are_the_same_have_almost_the_same_sign_and_size() {
        let pair = [Side::One, Side::Two].map(Measurand::CrushEnergyOf);
        let coefficient = |covariance| correlation_of(pair, covariance, [2.0, 3.0]).map(|of| of.coefficient);
        assert_eq!((coefficient(3.0), coefficient(0.0), correlation_of(pair, 3.0, [0.0, 3.0])), (Some(0.5), None, None));
        for sign in [1.0, -1.0] {
            let all = coefficient(sign * 6.0).expect("a correlation");
            assert!(all * sign < 1.0 && all * sign > 1.0 - 1e-7, "{all}");
        }
    }
}
