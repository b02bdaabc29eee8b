//! The verb `formula`.

use planar_impact::formula::{self, Formula, Formulas};
use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, ImpulseRatio, Input, Law, Moment, Motion, Output, Party, Vehicle, Xy};

use crate::Done;
use crate::arguments::{self, MomentImpulse, Notation, Ratio, TangentialLaw};
use crate::case::Case;
use crate::exit::Failure;
use crate::quantity::nearest;
use crate::table::{self, Align};

/// How wide text and source may be.
const TEXT: usize = 80;
const SOURCE: usize = 100;

/// Prints the formula.
///
/// # Errors
///
/// Everything wrong with the case file, or every reason why the physics refuses it.
pub fn run(call: &arguments::Formula) -> Result<Done, Failure> {
    let Some(output) = call.output else { return Ok(Done::with(list())) };
    let case = call.case.as_deref().map(Case::read).transpose().map_err(Failure::Input)?;
    if let Some(case) = &case {
        case.collision.solve().map_err(|refusals| case.refuse(&refusals, case.units))?;
    }
    let kind = case.as_ref().map_or_else(|| kind(call), |case| case.collision.map(|_| ()));
    let formulas = Formulas::of(&kind);
    let formula = formulas.output(output);
    let formula = call.wrt.map_or_else(|| formula.clone(), |input| formula.derivative(input.symbol()));
    let subject = subject(output, call.wrt, &kind);
    let text = match call.format {
        Notation::Text => text(&subject, &formula, &kind, case.as_ref().map(|case| &case.collision)),
        Notation::Latex => format!("{}\\[\n{}\n\\]\n", comment(&subject, "% "), formula.latex()),
        Notation::Rust => {
            let subject = format!("{subject} Any coherent units do, SI for one; angles are in radians.");
            format!("{}{}\n", comment(&subject, "/// "), formula.rust())
        }
    };
    Ok(Done::with(text))
}

/// The output of a name or a symbol, for clap.
///
/// # Errors
///
/// What the name may have been meant to be.
pub fn output(name: &str) -> Result<Output, String> {
    let written = |output: &Output| formula::written(output.symbol()) == name;
    Output::named(name).or_else(|| Output::ALL.into_iter().find(written)).ok_or_else(|| {
        if Input::named(name).is_some() {
            return format!("it is an input; give it as --wrt {name}");
        }
        unknown(name, "output", Output::ALL.iter().flat_map(|output| [output.name(), output.symbol()]))
    })
}

/// The input of a name or a symbol, for clap.
///
/// # Errors
///
/// What the name may have been meant to be.
pub fn input(name: &str) -> Result<Input, String> {
    let written = |input: &Input| formula::written(input.symbol()) == name;
    Input::named(name).or_else(|| Input::ALL.into_iter().find(written)).ok_or_else(|| {
        if Output::named(name).is_some() {
            return "it is an output; only inputs can be differentiated by".to_owned();
        }
        unknown(name, "input", Input::ALL.iter().flat_map(|input| [input.name(), input.symbol()]))
    })
}

fn unknown(name: &str, what: &str, known: impl Iterator<Item = &'static str>) -> String {
    let meant = nearest(name, known).map_or_else(String::new, |nearest| format!(" did you mean `{nearest}`?"));
    format!("no {what} has this name;{meant} see `planar-impact formula --list`")
}

/// The kind of collision that the flags say.
fn kind(call: &arguments::Formula) -> Collision<()> {
    let vehicle = Party::Vehicle(Vehicle {
        mass: (),
        yaw_inertia: (),
        heading: Heading { cos: (), sin: () },
        impact_center: ForwardLeft { forward: (), left: () },
        motion: Motion { velocity: Xy { x: (), y: () }, yaw_rate: () },
    });
    let party = |number| if call.barrier == Some(number) { Party::Barrier } else { vehicle };
    Collision {
        one: party(1),
        two: party(2),
        crush_plane: CrushPlane { cos: (), sin: () },
        restitution: (),
        impulse_ratio: match call.ratio {
            Ratio::Critical => ImpulseRatio::Critical,
            Ratio::Given => ImpulseRatio::Given(()),
            Ratio::OfCritical => ImpulseRatio::OfCritical(()),
            Ratio::Friction => ImpulseRatio::LimitedByFriction(()),
        },
        law: match call.law {
            TangentialLaw::Brach => Law::Brach,
            TangentialLaw::KudlichSlibar => Law::KudlichSlibar,
        },
        moment: match call.moment {
            MomentImpulse::None => Moment::None,
            MomentImpulse::Given => Moment::Given(()),
            MomentImpulse::OfCritical => Moment::OfCritical(()),
        },
    }
}

/// What the formula is of, in a sentence.
fn subject(output: Output, by: Option<Input>, kind: &Collision<()>) -> String {
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

fn text(subject: &str, formula: &Formula, kind: &Collision<()>, case: Option<&Collision>) -> String {
    let given = |name: &str| Input::named(name).zip(case).and_then(|(input, case)| case.input(input)).unwrap_or(f64::NAN);
    let mut text = table::wrap(subject, "");
    for (at, definition) in formula.definitions().into_iter().enumerate() {
        let indent = if at == 0 { "" } else { "  " };
        let mut lines = definition.text(TEXT - indent.len());
        if lines == format!("{0} = {0}", definition.name()) {
            lines.push_str(", which is an input");
        }
        if case.is_some() {
            append(&mut lines, &number(definition.evaluate(given)), TEXT - indent.len(), definition.name().chars().count() + 1);
        }
        text.push_str(match at {
            0 => "\n",
            1 => "\nwhere\n",
            _ => "",
        });
        for line in lines.lines() {
            text.push_str(&format!("{indent}{line}\n"));
        }
    }
    let inputs: Vec<Input> = formula.variables().iter().filter_map(|name| Input::named(name)).collect();
    if !inputs.is_empty() {
        text.push_str("\ninputs\n");
        text.push_str(&legend(&inputs, kind, case));
    }
    text
}

/// A value behind a definition, if its last line has room, or else below it.
fn append(lines: &mut String, value: &str, width: usize, indent: usize) {
    let used = lines.lines().last().map_or(0, |line| line.chars().count());
    if lines.lines().count() > 1 && lines.ends_with("otherwise") || used + value.chars().count() + 3 > width {
        lines.push_str(&format!("\n{:indent$}", ""));
    } else {
        lines.push(' ');
    }
    lines.push_str(&format!("= {value}"));
}

/// The inputs with their names; two beside each other, or each with its value.
fn legend(inputs: &[Input], kind: &Collision<()>, case: Option<&Collision>) -> String {
    let name = |input: Input| format!("{input}{}", meaning(input, kind));
    let symbol = |input: Input| formula::written(input.symbol());
    let mut text = String::new();
    match case {
        Some(case) => {
            for &input in inputs {
                let value = case.input(input).map_or_else(String::new, number);
                text.push_str(&format!("  {:<3} {:<36} {value}\n", symbol(input), name(input)));
            }
        }
        None => {
            for pair in inputs.chunks(2) {
                let line: String = pair.iter().map(|&input| format!("  {:<3} {:<32}", symbol(input), name(input))).collect();
                text.push_str(line.trim_end());
                text.push('\n');
            }
        }
    }
    text
}

/// What the number of a ratio or a moment means, where that is not its name.
fn meaning(input: Input, kind: &Collision<()>) -> &'static str {
    match (input, kind.impulse_ratio, kind.moment) {
        (Input::ImpulseRatio, ImpulseRatio::OfCritical(()), _) | (Input::Moment, _, Moment::OfCritical(())) => ".of_critical",
        (Input::ImpulseRatio, ImpulseRatio::LimitedByFriction(()), _) => " (friction)",
        _ => "",
    }
}

/// At most six digits, with an exponent if it is large or small.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "no number".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    let text = format!("{value:.5e}");
    let (digits, exponent) = match text.split_once('e') {
        Some((digits, exponent)) if !(-4.0..6.0).contains(&magnitude) => (digits.to_owned(), format!("e{exponent}")),
        _ => (format!("{value:.*}", (5.0 - magnitude) as usize), String::new()),
    };
    let digits = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{digits}{exponent}").replace('-', "−")
}

/// Lines of comment.
fn comment(text: &str, mark: &str) -> String {
    let options = textwrap::Options::new(SOURCE).initial_indent(mark).subsequent_indent(mark);
    textwrap::fill(text, options) + "\n"
}

/// The outputs and the inputs.
fn list() -> String {
    let table = |title: &str, rows: Vec<Vec<String>>| table::render(&[title, "name"], &[Align::Left, Align::Left], &rows);
    let row = |symbol: &str, name: &str| vec![symbol.to_owned(), name.to_owned()];
    let outputs = Output::ALL.map(|output| row(output.symbol(), output.name())).into();
    let inputs = Input::ALL.map(|input| row(input.symbol(), input.name())).into();
    format!("{}\n\n{}\n", table("output", outputs), table("input", inputs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_at_most_six_digits() {
        let texts = [0.0, -0.5, 123_456.7, 1234.5, 1.0e-4, 9.999_999, -1.5e9, f64::NAN].map(number);
        assert_eq!(texts, ["0", "−0.5", "123457", "1234.5", "0.0001", "10", "−1.5e9", "no number"]);
    }
}
