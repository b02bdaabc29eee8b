//! The verb `formula`: the formula that the code computes for an output, or for its derivative.

use planar_impact::formula::{self, Formulas};
use planar_impact::{
    Collision, CrushPlane, ForwardLeft, Heading, ImpulseRatio, Input, Law, Moment, Motion, Output, Party, Side, Vehicle, Xy,
};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::SCHEMA;
use crate::case::{Case, Inertia, Parameter, Restitution, Velocity, moment_parameter, ratio_parameter, vehicle_number};
use crate::control::Control;
use crate::gradient::ratio_note;
use crate::issue::{Issue, Issues};
use crate::notice::Notices;
use crate::quantity::{did_you_mean, excerpt};
use crate::solve::{ImpulseRatioGiven, TangentialLaw};

/// Width of source lines, in columns.
const SOURCE: usize = 100;

/// Options of the verb `formula`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The output.
    pub output: Output,
    /// The input to differentiate with respect to.
    pub wrt: Option<Wrt>,
    /// The kind of collision, used when no case is given.
    pub kind: Kind,
}

/// An input to differentiate with respect to: in any form in which a collision gives it, or in one that has a name of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrt {
    input: Input,
    asked: Parameter,
}

impl From<Input> for Wrt {
    fn from(input: Input) -> Self {
        Wrt { input, asked: Parameter::Input(input) }
    }
}

/// The forms of inputs that have a name of their own.
const FORMS: [Wrt; 3] = [
    Wrt { input: Input::ImpulseRatio, asked: Parameter::RatioOfCritical },
    Wrt { input: Input::ImpulseRatio, asked: Parameter::Friction },
    Wrt { input: Input::Moment, asked: Parameter::MomentOfCritical },
];

impl Wrt {
    /// Returns its name in a kind of collision, as `gradient` has it, unless the collision gives it in another form than is asked for.
    fn of(self, kind: &Collision<()>) -> Result<String, Issues> {
        let given = match self.input {
            Input::ImpulseRatio => ratio_parameter(&kind.impulse_ratio),
            Input::Moment => moment_parameter(&kind.moment),
            input => Parameter::Input(input),
        };
        if self.asked == given || self.asked == Parameter::Input(self.input) {
            return Ok(given.to_string());
        }
        // A critical ratio is no input, nor is a moment that there is not.
        let is_input = match self.input {
            Input::ImpulseRatio => kind.impulse_ratio != ImpulseRatio::Critical,
            Input::Moment => kind.moment != Moment::None,
            _ => true,
        };
        let instead = if is_input { format!("differentiate by {given}, or ") } else { String::new() };
        let help = format!("{instead}give a collision that has {}", self.asked);
        Err(Issues::of_call(vec![Issue::of_call("--wrt", format!("this collision has no {}", self.asked), Some(help))]))
    }
}

/// A kind of collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// Form in which the impulse ratio is given.
    pub ratio: ImpulseRatioGiven,
    /// The law of the tangential impulse.
    pub law: TangentialLaw,
    /// The fixed barrier, if one of the two is.
    pub barrier: Option<Side>,
    /// Form in which the moment impulse is given.
    pub moment: MomentGiven,
}

impl Default for Kind {
    fn default() -> Self {
        Kind { ratio: ImpulseRatioGiven::Critical, law: TangentialLaw::Brach, barrier: None, moment: MomentGiven::None }
    }
}

/// Form in which a moment impulse is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentGiven {
    /// There is none.
    None,
    /// As a number.
    Number,
    /// As a fraction of the moment impulse that ends relative rotation.
    OfCritical,
}

/// The answer of `formula`.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Formula {
    /// The version of this document.
    pub schema: u32,
    /// The name of the output.
    pub output: &'static str,
    /// The name of the input of the derivative.
    pub wrt: Option<String>,
    /// The subject of the formula, as a sentence.
    pub subject: String,
    /// The quantity, then the intermediate quantities that it is expressed in.
    pub definitions: Vec<Definition>,
    /// The inputs in it.
    pub inputs: Vec<FormulaInput>,
    /// The formula for a document, as LaTeX.
    pub latex: String,
    /// The formula for a program, as a Rust function of `f64`.
    pub rust: String,
    /// Notes and warnings about the numbers of a case.
    #[serde(flatten)]
    pub notices: Notices,
    /// `true` if a case gives the numbers.
    #[serde(skip)]
    pub has_case: bool,
    /// The formula itself.
    #[serde(skip)]
    pub formula: formula::Formula,
}

/// A quantity of a formula.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Definition {
    /// Its symbol.
    pub symbol: String,
    /// Its definition on one line.
    pub text: String,
    /// Its value in SI in the case; `null` without a case, or if it is not a number.
    pub value: Option<f64>,
}

/// An input in a formula.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FormulaInput {
    /// Its symbol.
    pub symbol: String,
    /// Its dotted name.
    pub name: &'static str,
    /// Form in which its number is given, if not plainly: `.of_critical` or ` (friction)`.
    pub meaning: &'static str,
    /// Its value in SI in the case.
    pub value: Option<f64>,
}

/// Derives the formula of an output, or of its derivative, for a kind of collision or for a case.
///
/// # Errors
///
/// Returns an error if the case lists required numbers as unknown, if the physics refuses it, or if the collision gives the input in another form.
pub fn formula(case: Option<&Case>, options: &Options, _: &dyn Control) -> Result<Formula, Issues> {
    if let Some(case) = case {
        case.impact()?;
    }
    let collision = case.map(|case| &case.collision);
    let kind = collision.map_or_else(|| options.kind.collision(), |collision| collision.map(|_| ()));
    let formulas = Formulas::of(&kind);
    let of_output = formulas.output(options.output);
    let wrt = options.wrt.map(|wrt| wrt.of(&kind)).transpose()?;
    let formula = options.wrt.map_or_else(|| of_output.clone(), |wrt| of_output.derivative(wrt.input.symbol()));
    let held = case.zip(options.wrt).and_then(|(case, wrt)| held(case, wrt.input));
    // Of a friction or a share of the critical ratio the derivative is by that.
    let follows = case.filter(|case| {
        options.wrt.is_some_and(|wrt| wrt.input == Input::ImpulseRatio) && case.inputs.contact.impulse_ratio == ImpulseRatio::Critical
    });
    let subject = subject(options.output, wrt.as_deref(), &kind) + held.unwrap_or_default();
    let value = |name: &str| Input::named(name).zip(collision).and_then(|(input, collision)| collision.input(input));
    let definition = |definition: formula::Definition| Definition {
        symbol: definition.name(),
        text: definition.text(usize::MAX),
        value: collision.map(|_| definition.evaluate(|name: &str| value(name).unwrap_or(f64::NAN))).filter(|value| value.is_finite()),
    };
    let input = |name: &str| {
        let input = Input::named(name)?;
        Some(FormulaInput {
            symbol: formula::written(input.symbol()),
            name: input.name(),
            meaning: meaning(input, &kind),
            value: value(name),
        })
    };
    Ok(Formula {
        schema: SCHEMA,
        output: options.output.name(),
        wrt,
        definitions: formula.definitions().into_iter().map(definition).collect(),
        inputs: formula.variables().iter().filter_map(|name| input(name)).collect(),
        latex: format!("{}\\[\n{}\n\\]\n", comment(&subject, "% "), formula.latex()),
        rust: format!(
            "{}{}\n",
            comment(&format!("{subject} Any coherent units do, SI for one; angles are in radians."), "/// "),
            formula.rust()
        ),
        subject,
        notices: case.map(|case| case.answer((), follows.and_then(ratio_note)).notices).unwrap_or_default(),
        has_case: case.is_some(),
        formula,
    })
}

/// Returns the output with this name or symbol.
///
/// # Errors
///
/// Returns a message for an unknown name, with the nearest known one.
pub fn output(name: &str) -> Result<Output, String> {
    let written = |output: &Output| formula::written(output.symbol()) == name;
    Output::named(name).or_else(|| Output::ALL.into_iter().find(written)).ok_or_else(|| {
        if Input::named(name).is_some() {
            return format!("it is an input; give it as --wrt {name}");
        }
        unknown(name, "output", Output::ALL.iter().flat_map(|output| [output.name(), output.symbol()]))
    })
}

/// Returns the input with this name or symbol.
///
/// # Errors
///
/// Returns a message for an unknown name, with the nearest known one.
pub fn input(name: &str) -> Result<Wrt, String> {
    if let Some(form) = Parameter::named(name).and_then(|named| FORMS.into_iter().find(|form| form.asked == named)) {
        return Ok(form);
    }
    let written = |input: &Input| formula::written(input.symbol()) == name;
    Input::named(name).or_else(|| Input::ALL.into_iter().find(written)).map(Wrt::from).ok_or_else(|| {
        if Output::named(name).is_some() {
            return "it is an output; only inputs can be differentiated by".to_owned();
        }
        if let Some(instead) = instead(name) {
            return instead;
        }
        let forms = FORMS.map(|form| form.asked.to_string());
        unknown(name, "input", Input::ALL.iter().flat_map(|input| [input.name(), input.symbol()]).chain(forms.iter().map(String::as_str)))
    })
}

fn unknown<'a>(name: &str, what: &str, known: impl Iterator<Item = &'a str>) -> String {
    let meant = did_you_mean(name, known).map_or_else(String::new, |meant| format!(" {meant}"));
    format!("no {what} has the name {};{meant} see `planar-impact formula --list`", excerpt(name))
}

/// Says what a formula has in place of an input that a case file may give instead.
fn instead(name: &str) -> Option<String> {
    let of = |side: Side| format!("vehicle.{}", vehicle_number(side));
    match Parameter::named(name)? {
        Parameter::Speed(side) => Some(format!("a formula has {0}.velocity.x and {0}.velocity.y in place of the speed", of(side))),
        Parameter::RadiusOfGyration(side) => Some(format!("a formula has {}.yaw_inertia in place of the radius of gyration", of(side))),
        Parameter::Crush(..) | Parameter::Skid(..) => Some("the crush and the skids are in no formula of a collision".to_owned()),
        _ => None,
    }
}

impl Kind {
    /// Returns the kind of a collision.
    pub fn of(collision: &Collision) -> Self {
        Kind {
            ratio: match collision.impulse_ratio {
                ImpulseRatio::Critical => ImpulseRatioGiven::Critical,
                ImpulseRatio::Given(_) => ImpulseRatioGiven::Number,
                ImpulseRatio::OfCritical(_) => ImpulseRatioGiven::OfCritical,
                ImpulseRatio::LimitedByFriction(_) => ImpulseRatioGiven::Friction,
            },
            law: collision.law.into(),
            barrier: Side::ALL.into_iter().find(|side| collision.parties()[*side as usize].vehicle().is_none()),
            moment: match collision.moment {
                Moment::None => MomentGiven::None,
                Moment::Given(_) => MomentGiven::Number,
                Moment::OfCritical(_) => MomentGiven::OfCritical,
            },
        }
    }

    fn collision(&self) -> Collision<()> {
        let vehicle = Party::Vehicle(Vehicle {
            mass: (),
            yaw_inertia: (),
            heading: Heading { cos: (), sin: () },
            impact_center: ForwardLeft { forward: (), left: () },
            motion: Motion { velocity: Xy { x: (), y: () }, yaw_rate: () },
        });
        let party = |side| if self.barrier == Some(side) { Party::Barrier } else { vehicle };
        Collision {
            one: party(Side::One),
            two: party(Side::Two),
            crush_plane: CrushPlane { cos: (), sin: () },
            restitution: (),
            impulse_ratio: match self.ratio {
                ImpulseRatioGiven::Critical => ImpulseRatio::Critical,
                ImpulseRatioGiven::Number => ImpulseRatio::Given(()),
                ImpulseRatioGiven::OfCritical => ImpulseRatio::OfCritical(()),
                ImpulseRatioGiven::Friction => ImpulseRatio::LimitedByFriction(()),
            },
            law: match self.law {
                TangentialLaw::Brach => Law::Brach,
                TangentialLaw::KudlichSlibar => Law::KudlichSlibar,
            },
            moment: match self.moment {
                MomentGiven::None => Moment::None,
                MomentGiven::Number => Moment::Given(()),
                MomentGiven::OfCritical => Moment::OfCritical(()),
            },
        }
    }
}

/// Describes the subject of a formula in a sentence.
fn subject(output: Output, by: Option<&str>, kind: &Collision<()>) -> String {
    let derivative = by.map_or_else(String::new, |input| format!("The derivative by {input} of "));
    let parties = match (kind.one.vehicle(), kind.two.vehicle()) {
        (Some(_), Some(_)) => "two vehicles",
        (None, Some(_)) => "a barrier and a vehicle",
        (Some(_), None) => "a vehicle and a barrier",
        (None, None) => "two barriers",
    };
    let ratio = match kind.impulse_ratio {
        ImpulseRatio::Critical => "critical impulse ratio",
        ImpulseRatio::Given(()) => "given impulse ratio",
        ImpulseRatio::OfCritical(()) => "a fraction of the critical impulse ratio",
        ImpulseRatio::LimitedByFriction(()) => "impulse ratio limited by friction",
    };
    let law = match kind.law {
        Law::Brach => "Brach",
        Law::KudlichSlibar => "Kudlich and Slibar",
    };
    let moment = match kind.moment {
        Moment::None => "",
        Moment::Given(()) => ", given moment impulse",
        Moment::OfCritical(()) => ", a fraction of the critical moment impulse",
    };
    format!("{derivative}{output}: {parties}, {ratio}{moment}, law of {law}.")
}

/// Says what the derivative of a formula holds that `gradient` moves: a case may give an input through another number.
fn held(case: &Case, by: Input) -> Option<&'static str> {
    let of = |side: Side| case.inputs.vehicles[side as usize].as_ref();
    match by {
        Input::Mass(side) if of(side).is_some_and(|of| matches!(of.inertia, Inertia::Radius(_))) => {
            Some(" It holds the yaw inertia; `gradient` holds the radius of gyration, which the case gives.")
        }
        Input::Heading(side) if of(side).is_some_and(|of| matches!(of.velocity, Velocity::Speed(_))) => {
            Some(" It holds the components of the velocity; `gradient` holds the speed along the heading, which the case gives.")
        }
        _ if matches!(case.inputs.contact.restitution, Restitution::OfClosingSpeed(_)) => {
            Some(" It holds the restitution; `gradient` follows its curve over the closing speed, which the case gives.")
        }
        _ => None,
    }
}

/// Describes the form in which the number of an impulse ratio or a moment impulse is given, if not plainly.
fn meaning(input: Input, kind: &Collision<()>) -> &'static str {
    match (input, kind.impulse_ratio, kind.moment) {
        (Input::ImpulseRatio, ImpulseRatio::OfCritical(()), _) | (Input::Moment, _, Moment::OfCritical(())) => ".of_critical",
        (Input::ImpulseRatio, ImpulseRatio::LimitedByFriction(()), _) => " (friction)",
        _ => "",
    }
}

/// Formats a text as comment lines.
fn comment(text: &str, mark: &str) -> String {
    let mut lines = vec![mark.to_owned()];
    for word in text.split(' ') {
        let line = lines.last_mut().filter(|line| line.chars().count() + word.chars().count() <= SOURCE);
        match line {
            Some(line) => line.push_str(&format!("{word} ")),
            None => lines.push(format!("{mark}{word} ")),
        }
    }
    lines.iter().map(|line| line.trim_end().to_owned() + "\n").collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_is_no_wider_than_its_source() {
        let text = comment(&"four ".repeat(60), "// ");
        assert!(text.lines().all(|line| line.starts_with("// four") && line.len() <= SOURCE), "{text}");
        assert_eq!(text.matches("four").count(), 60);
        assert_eq!(comment("a b", "% "), "% a b\n");
    }

    #[test]
    fn a_derivative_says_what_it_holds_and_gradient_moves() {
        let case = |vehicle: &str, contact: &str| {
            let text = format!(
                "schema = 1\n[[vehicle]]\nmass = 1000\nheading = 0\nimpact_center = [2, 0.3]\n{vehicle}\n[[vehicle]]\nbarrier = true\n\
                 [contact]\ncrush_plane = 0\n{contact}\n"
            );
            Case::parse(crate::Source::new("case.toml", text)).expect("a case")
        };
        let through = case("radius_of_gyration = 1.4\nspeed = 15", "friction = 0.3\nrestitution = 0.1");
        let plain = case("yaw_inertia = 1900\nvelocity = [15, 0]", "impulse_ratio = 0.05\nrestitution = 0.1");
        for (input, word) in [(Input::Mass(Side::One), "radius of gyration"), (Input::Heading(Side::One), "speed along the heading")] {
            assert!(held(&through, input).is_some_and(|said| said.contains(word)), "{input}");
            assert_eq!(held(&plain, input), None);
        }
        assert_eq!(held(&through, Input::Restitution), None);
    }

    /// Inputs have the names that `gradient` has, and another form is refused.
    #[test]
    fn an_input_is_named_by_the_form_in_which_the_collision_gives_it() {
        let by = |ratio, moment, name: &str| {
            let kind = Kind { ratio, moment, ..Kind::default() };
            let options = Options { output: Output::Loss, wrt: Some(input(name).expect("a name")), kind };
            formula(None, &options, &crate::Uncontrolled).map(|formula| formula.wrt).map_err(|issues| issues.to_string())
        };
        let none = MomentGiven::None;
        let named = |name: &str| Ok(Some(name.to_owned()));
        for name in ["contact.impulse_ratio", "mu", "contact.impulse_ratio.of_critical"] {
            assert_eq!(by(ImpulseRatioGiven::OfCritical, none, name), named("contact.impulse_ratio.of_critical"));
        }
        assert_eq!(by(ImpulseRatioGiven::Friction, none, "mu"), named("contact.friction"));
        assert_eq!(by(ImpulseRatioGiven::Number, none, "mu"), named("contact.impulse_ratio"));
        assert_eq!(by(ImpulseRatioGiven::Critical, MomentGiven::OfCritical, "contact.moment"), named("contact.moment.of_critical"));
        for (ratio, name) in
            [(ImpulseRatioGiven::OfCritical, "contact.friction"), (ImpulseRatioGiven::Critical, "contact.moment.of_critical")]
        {
            assert!(by(ratio, none, name).is_err_and(|said| said.contains(name)), "{name}");
        }
        let refused = |ratio, name: &str| by(ratio, none, name).expect_err("it is refused");
        let instead = "this collision has no contact.friction (differentiate by contact.impulse_ratio.of_critical, or give a collision that has contact.friction)";
        assert!(refused(ImpulseRatioGiven::OfCritical, "contact.friction").ends_with(instead));
        let none_is_given = "this collision has no contact.moment.of_critical (give a collision that has contact.moment.of_critical)";
        assert!(refused(ImpulseRatioGiven::Critical, "contact.moment.of_critical").ends_with(none_is_given));
        assert!(input("contact.frictio").is_err_and(|said| said.contains("`contact.friction`")));
    }

    /// The word that a person adds to the name of an input, as in a case file.
    #[test]
    fn an_input_says_in_which_form_it_is_given() {
        let with = |impulse_ratio, moment| Collision { impulse_ratio, moment, ..Kind::default().collision() };
        let given = with(ImpulseRatio::Given(()), Moment::Given(()));
        let shares = with(ImpulseRatio::OfCritical(()), Moment::OfCritical(()));
        let limited = with(ImpulseRatio::LimitedByFriction(()), Moment::None);
        let of = |kind| [Input::ImpulseRatio, Input::Moment, Input::Restitution].map(|input| meaning(input, kind));
        assert_eq!(of(&given), ["", "", ""]);
        assert_eq!(of(&shares), [".of_critical", ".of_critical", ""]);
        assert_eq!(of(&limited), [" (friction)", "", ""]);
    }
}
