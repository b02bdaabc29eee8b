//! The verb `gradient`: exact derivatives of the outputs with respect to the inputs.

use planar_impact::num_dual::Dual64;
use planar_impact::{Collision, Impact, ImpulseRatio, Output, Side};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, CaseOutput, CaseOutputs, Parameter};
use crate::control::Control;
use crate::derivative;
use crate::issue::{Issue, Issues};
use crate::named::{Named, positive_zero};
use crate::names;
use crate::notice::Notice;
use crate::units::{Measure, Units, beyond_rounding};

/// Maximum number of derivatives computed at once, so that a file with a million depths cannot exhaust the memory.
const MOST: usize = 250_000;

/// Outputs to differentiate, and inputs to differentiate with respect to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The outputs.
    pub of: Selection,
    /// The inputs.
    pub wrt: Selection,
    /// `true` to add second derivatives.
    pub second: bool,
}

/// A selection of outputs or inputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Selection {
    /// All of the case.
    #[default]
    All,
    /// The outputs of most interest; the inputs that are keys of the file.
    Principal,
    /// These names or symbols.
    Named(Vec<String>),
}

impl Selection {
    fn names(&self) -> &[String] {
        match self {
            Selection::Named(names) => names,
            Selection::All | Selection::Principal => &[],
        }
    }
}

/// Outputs with their derivatives, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Gradient {
    /// The value of each input; `null` for the impulse ratio where the file does not give it.
    pub wrt: Named<Option<f64>>,
    /// Each output with its derivatives.
    pub of: Named<Derivatives>,
    /// Number of outputs of the case.
    pub outputs_of_case: usize,
    /// The options.
    #[serde(skip)]
    pub options: Options,
    /// The outputs of the case, which set the scale of rounding.
    #[serde(skip)]
    pub outputs: CaseOutputs,
}

/// An output with its derivatives; one that does not exist, as that of a magnitude at zero, is `null`. A warning tells where friction begins to hold, and they
/// are those of one side.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Derivatives {
    /// Its value.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// Its derivative with respect to each input.
    #[schemars(with = "Named<Option<f64>>")]
    pub d: Named<f64>,
    /// Its second derivatives with respect to each pair of inputs, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Named<Named<Option<f64>>>>")]
    pub d2: Option<Named<Named<f64>>>,
}

/// Differentiates the outputs of a case with respect to its inputs.
///
/// # Errors
///
/// Every unknown name, too many derivatives, or why the physics refuses the case.
pub fn gradient(case: &Case, options: &Options, control: &dyn Control) -> Result<Answer<Gradient>, Issues> {
    case.needs_everything()?;
    let mut issues = Vec::new();
    let of = names::outputs("--of", options.of.names(), &case.setup, &mut issues);
    let wrt = names::parameters("--wrt", options.wrt.names(), &case.inputs, &mut issues);
    let choice = Choice {
        outputs: of.unwrap_or_else(|| if options.of == Selection::Principal { principal(case) } else { case.setup.outputs() }),
        parameters: wrt.unwrap_or_else(|| match options.wrt {
            Selection::Principal => case.inputs.keys(),
            _ => case.inputs.parameters(),
        }),
        second: options.second,
    };
    issues.extend(choice.too_many());
    if !issues.is_empty() {
        return Err(Issues::of_call(issues));
    }
    let impact = case.collision.solve().map_err(|refusals| case.refuse(&refusals))?;
    let outputs = case.setup.outputs_of(&impact);
    let rows = choice.differentiate(case, &outputs, control)?;
    let held = Notice::note("held-inputs", "", HELD);
    let notices = case.warnings(&impact).into_iter().chain([held]).chain(ratio_note(case)).chain(corner(case, &impact));
    let named = |values: &[f64]| choice.parameters.iter().zip(values.iter().copied()).collect::<Named<f64>>();
    let derivatives = |row: &Row| {
        let second = || choice.parameters.iter().zip(row.second.iter().map(|values| named(values))).collect();
        (row.output, Derivatives { value: row.value, d: named(&row.first), d2: options.second.then(second) })
    };
    let value = |&parameter: &Parameter| (parameter, case.inputs.value(parameter).ok().map(positive_zero));
    let gradient = Gradient {
        wrt: choice.parameters.iter().map(value).collect(),
        of: rows.iter().map(derivatives).collect(),
        outputs_of_case: case.setup.outputs().len(),
        options: options.clone(),
        outputs,
    };
    Ok(case.answer(gradient, notices))
}

const HELD: &str = "a derivative by one input holds the other keys of the file as they are given: with its heading a vehicle turns its speed, \
                    but not a velocity given by components, and with its mass it changes the yaw inertia of a given radius of gyration";

/// Returns the outputs of most interest.
pub(crate) fn principal(case: &Case) -> Vec<CaseOutput> {
    use Output::{CriticalImpulseRatio, DeltaVMagnitude, Loss, NormalWork, TangentialWork};
    let mut all: Vec<CaseOutput> = [NormalWork, TangentialWork, Loss, CriticalImpulseRatio].map(CaseOutput::Impact).into();
    for (side, vehicle) in [Side::One, Side::Two].into_iter().zip(&case.inputs.vehicles) {
        if vehicle.is_some() {
            all.push(CaseOutput::Impact(DeltaVMagnitude(side)));
        }
    }
    all.extend([Side::One, Side::Two].map(CaseOutput::CrushEnergy).into_iter().filter(|&output| case.setup.lacks(output).is_none()));
    all
}

/// Returns a note that nothing depends on the impulse ratio, if the file does not give it.
pub(crate) fn ratio_note(case: &Case) -> Option<Notice> {
    let message = "the file does not give contact.impulse_ratio; the ratio follows from the inputs, and moves with them";
    match case.inputs.contact.impulse_ratio {
        ImpulseRatio::Given(_) => None,
        _ => Some(Notice::note("impulse-ratio-follows", "contact.impulse_ratio", message)),
    }
}

/// Returns a warning where the friction is that at which sliding just ends: on either side of it the derivatives are others. Rounding decides which side it is on.
fn corner(case: &Case, impact: &Impact) -> Option<Notice> {
    /// Difference, as a share of the friction, that is rounding.
    const ROUNDING: f64 = 1e-12;
    let ImpulseRatio::LimitedByFriction(friction) = case.inputs.contact.impulse_ratio else { return None };
    let critical = impact.critical_impulse_ratio().abs();
    // Without friction nothing sticks: the ratio is zero on both sides.
    let is_corner = friction > 0.0 && (friction - critical).abs() <= ROUNDING * friction;
    is_corner.then(|| {
        let impulse_ratio = ImpulseRatio::LimitedByFriction(Dual64::new(friction, 1.0));
        let slides = Collision { impulse_ratio, ..case.collision.map(Dual64::from) }.evaluate().impulse.t.eps != 0.0;
        let (these, others) = if slides { ("less", "more") } else { ("more", "less") };
        let message = format!(
            "the friction is the critical impulse ratio, at which sliding just ends: these are the derivatives for {these} friction, and those for {others} \
             differ; give a friction a little off for those"
        );
        Notice::warning("corner", "contact.friction", message)
    })
}

/// Outputs and inputs selected by name.
struct Choice {
    outputs: Vec<CaseOutput>,
    parameters: Vec<Parameter>,
    second: bool,
}

/// One output with its derivatives, in the order of the parameters; NaN where a derivative does not exist.
struct Row {
    output: CaseOutput,
    value: f64,
    first: Vec<f64>,
    /// The full symmetric matrix; empty unless requested.
    second: Vec<Vec<f64>>,
}

impl Choice {
    fn too_many(&self) -> Option<Issue> {
        let by = self.parameters.len().saturating_pow(if self.second { 2 } else { 1 });
        let count = self.outputs.len().saturating_mul(by);
        let message = format!("{count} derivatives are more than the {MOST} that are computed at once");
        (count > MOST).then(|| Issue::of_call("--wrt", message, Some("name the inputs that matter".to_owned())))
    }

    fn differentiate(&self, case: &Case, outputs: &CaseOutputs, control: &dyn Control) -> Result<Vec<Row>, Issues> {
        let row = |&output: &CaseOutput| {
            let value = positive_zero(outputs.get(output).unwrap_or(f64::NAN));
            Row { output, value, first: Vec::new(), second: Vec::new() }
        };
        let mut rows: Vec<Row> = self.outputs.iter().map(row).collect();
        let size = self.parameters.len();
        let total = if self.second { size + size * (size + 1) / 2 } else { size };
        let mut done = 0..;
        let mut goes_on = || control.goes_on(done.next().unwrap_or(total), total).then_some(()).ok_or_else(Issues::interrupted);
        for &parameter in &self.parameters {
            goes_on()?;
            let by = derivative::by(&case.inputs, parameter);
            for row in &mut rows {
                row.first.push(derivative::defined(row.output, row.value, &[parameter], by.get(row.output).map(|dual| dual.eps)));
            }
        }
        if self.second {
            rows.iter_mut().for_each(|row| row.second = vec![vec![0.0; size]; size]);
            for (i, &one) in self.parameters.iter().enumerate() {
                for (j, &two) in self.parameters.iter().enumerate().skip(i) {
                    goes_on()?;
                    let by = derivative::by_both(&case.inputs, one, two);
                    for row in &mut rows {
                        let second = by.get(row.output).map(|dual| dual.eps1eps2);
                        let value = derivative::defined(row.output, row.value, &[one, two], second);
                        (row.second[i][j], row.second[j][i]) = (value, value);
                    }
                }
            }
        }
        Ok(rows)
    }
}

/// The typical uncertainty of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TypicalUncertainty {
    /// In SI.
    pub size: f64,
    /// As people write it, such as `1 mph` or `1 %`.
    pub text: &'static str,
}

impl TypicalUncertainty {
    /// Returns the typical uncertainty of an input, as users of a system of units round it.
    pub fn of(parameter: Parameter, value: f64, units: Units) -> TypicalUncertainty {
        let share = TypicalUncertainty { size: 0.01 * value.abs(), text: "1 %" };
        if parameter == Parameter::RestitutionScatter {
            return TypicalUncertainty { size: 1.0, text: "1" };
        }
        let is_radius = matches!(parameter, Parameter::RadiusOfGyration(_));
        let text = match (parameter.measure(), units) {
            (Measure::Angle, _) => "1 deg",
            (Measure::Ratio, _) => "0.05",
            (Measure::Length, Units::Us) if !is_radius => "1 in",
            (Measure::Length, Units::Si | Units::Uk) if !is_radius => "2.5 cm",
            (Measure::Speed, Units::Us | Units::Uk) => "1 mph",
            (Measure::Speed, Units::Si) => "1 km/h",
            (Measure::YawRate, _) => "1 deg/s",
            _ => return share,
        };
        crate::quantity::parse(text, parameter.kind()).map_or(share, |quantity| TypicalUncertainty { size: quantity.si, text })
    }
}

/// The effect of a typical uncertainty of an input on an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The input.
    pub parameter: Parameter,
    /// Its value; `None` if the file does not give it.
    pub value: Option<f64>,
    /// Its typical uncertainty.
    pub uncertainty: TypicalUncertainty,
    /// The derivative in SI; zero where the effect is only rounding.
    pub derivative: f64,
    /// The change of the output in SI.
    pub change: f64,
}

/// The second-order effect of typical uncertainties of two inputs on an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondEffect {
    /// The first input.
    pub one: Parameter,
    /// The second, which may be the same.
    pub two: Parameter,
    /// The change of the output in SI.
    pub change: f64,
}

impl Gradient {
    fn parameters(&self, units: Units) -> Vec<(Parameter, Option<f64>, TypicalUncertainty)> {
        let parameter = |(name, value): (&str, &Option<f64>)| {
            let parameter = Parameter::named(name)?;
            Some((parameter, *value, TypicalUncertainty::of(parameter, value.unwrap_or(0.0), units)))
        };
        self.wrt.iter().filter_map(parameter).collect()
    }

    /// Returns the scale of an output; values below 10⁻¹² of it are rounding.
    pub fn scale(&self, output: CaseOutput) -> f64 {
        self.outputs.scale(output.measure())
    }

    /// Returns the effects of typical uncertainties of the inputs on an output, the largest first.
    pub fn effects(&self, output: CaseOutput, derivatives: &Derivatives, units: Units) -> Vec<Effect> {
        let scale = self.scale(output);
        let effect = |((parameter, value, uncertainty), derivative): ((Parameter, Option<f64>, TypicalUncertainty), f64)| {
            let change = derivative * uncertainty.size;
            let is_rounding = beyond_rounding(change, scale) == 0.0 && uncertainty.size > 0.0;
            Effect { parameter, value, uncertainty, derivative: if is_rounding { 0.0 } else { derivative }, change }
        };
        let mut effects: Vec<Effect> =
            self.parameters(units).into_iter().zip(derivatives.d.iter().map(|(_, derivative)| *derivative)).map(effect).collect();
        effects.sort_by(|one, other| other.change.abs().total_cmp(&one.change.abs()));
        effects
    }

    /// Returns the second-order effects on an output, the largest first, without those that are rounding.
    pub fn second_effects(&self, output: CaseOutput, derivatives: &Derivatives, units: Units) -> Vec<SecondEffect> {
        let (scale, parameters) = (self.scale(output), self.parameters(units));
        let mut effects = Vec::new();
        for (i, (_, row)) in derivatives.d2.iter().flat_map(Named::iter).enumerate() {
            for (j, (_, second)) in row.iter().enumerate().skip(i) {
                let weight = if i == j { 0.5 } else { 1.0 };
                let ((one, _, by), (two, _, with)) = (parameters[i], parameters[j]);
                let change = weight * second * by.size * with.size;
                if beyond_rounding(change, scale).abs() > 0.0 {
                    effects.push(SecondEffect { one, two, change });
                }
            }
        }
        effects.sort_by(|one, other| other.change.abs().total_cmp(&one.change.abs()));
        effects
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::case::CrushKey;
    use crate::control::Noted;
    use planar_impact::Input;

    /// What rounding leaves of a derivative has no effect.
    #[test]
    fn rounding_has_no_effect() {
        let text = crate::template::of("t-bone").expect("a kind").to_owned();
        let case = Case::parse(Source::new("case", text)).unwrap_or_else(|issues| panic!("{issues}"));
        let answer = gradient(&case, &Options::default(), &crate::Uncontrolled).unwrap_or_else(|issues| panic!("{issues}"));
        let output = CaseOutput::Impact(planar_impact::Output::Loss);
        let mut derivatives = answer.of.get(&output.to_string()).expect("an output").clone();
        let sound = answer.effects(output, &derivatives, Units::Si);
        assert!(sound.iter().any(|effect| effect.derivative != 0.0));
        let tiny = 1e-14 * answer.scale(output);
        derivatives.d = derivatives.d.iter().map(|(name, _)| (name, tiny)).collect();
        let left = answer.effects(output, &derivatives, Units::Si);
        let rounding: Vec<_> = left.iter().filter(|effect| effect.uncertainty.size > 0.0 && effect.uncertainty.size < 10.0).collect();
        assert!(!rounding.is_empty() && rounding.iter().all(|effect| effect.derivative == 0.0), "{rounding:?}");
    }

    /// Three inputs have three first derivatives and six second ones.
    #[test]
    fn progress_counts_every_derivative() {
        let text = crate::template::of("t-bone").expect("a kind").to_owned();
        let case = Case::parse(Source::new("case", text)).unwrap_or_else(|issues| panic!("{issues}"));
        for (second, total) in [(false, 3), (true, 9)] {
            let named = |names: &[&str]| Selection::Named(names.iter().map(|name| (*name).to_owned()).collect());
            let (options, steps) = (Options { of: named(&["T_L"]), wrt: named(&["e", "Gamma", "m1"]), second }, Noted::default());
            gradient(&case, &options, &steps).unwrap_or_else(|issues| panic!("{issues}"));
            assert_eq!(steps.steps(), (0..total).map(|done| (done, total)).collect::<Vec<_>>());
        }
    }

    #[test]
    fn uncertainties_are_those_that_users_of_the_units_round_to() {
        let of = |parameter, value, units| {
            let uncertainty = TypicalUncertainty::of(parameter, value, units);
            (uncertainty.size, uncertainty.text)
        };
        assert_eq!(of(Parameter::Input(Input::Mass(Side::One)), 1500.0, Units::Us), (15.0, "1 %"));
        assert_eq!(of(Parameter::Speed(Side::One), 10.0, Units::Us), (0.44704, "1 mph"));
        assert_eq!(of(Parameter::Speed(Side::One), 10.0, Units::Si).1, "1 km/h");
        assert_eq!(of(Parameter::Crush(Side::One, CrushKey::Depth(2)), 0.1, Units::Si), (0.025, "2.5 cm"));
        assert_eq!(of(Parameter::Friction, 0.4, Units::Us), (0.05, "0.05"));
        assert_eq!(of(Parameter::RestitutionScatter, 0.0, Units::Us), (1.0, "1"), "it counts standard deviations");
        assert_eq!(of(Parameter::RadiusOfGyration(Side::Two), 1.5, Units::Si), (0.015, "1 %"));
        assert_eq!(of(Parameter::Input(Input::CrushPlane), 0.0, Units::Si).0, 1_f64.to_radians());
    }
}
