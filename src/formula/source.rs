//! Formulas as Rust source.

use super::expression::{Expression, Form};
use super::listing::{Label, Listing};
use super::notation::{Bond, Notation, Writer, Written};
use super::text::{broken, spaced};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

/// Words that cannot be the name of a quantity.
const RESERVED: &str = "as async await abstract become box break const continue crate do dyn else enum extern f64 false final fn for gen if impl in let loop \
    macro match mod move mut override priv pub ref return self static struct super trait true try type typeof unsafe unsized use virtual where while yield";

/// A function of f64 that needs only the standard library.
struct Source {
    quantities: Vec<(Label, String)>,
    variables: Vec<(String, Variable)>,
}

/// The names under which a variable appears.
struct Variable {
    itself: String,
    sine: Option<String>,
    cosine: Option<String>,
}

/// Names that are in use.
struct Names(Vec<String>);

impl Names {
    fn unique(&mut self, mut name: String) -> String {
        while self.0.contains(&name) {
            name.push('_');
        }
        self.0.push(name.clone());
        name
    }
}

impl Source {
    fn of(listing: &Listing) -> Source {
        let mut names = Names(RESERVED.split_whitespace().map(str::to_owned).collect());
        // The variables come first: callers of the function use their names.
        let itself: Vec<String> = listing.variables.iter().map(|name| names.unique(name.to_string())).collect();
        let variables = listing.variables.iter().zip(itself).map(|(name, itself)| {
            let mut turned = |prefix: &str, sine: bool| {
                listing.entries.iter().any(|entry| turns(&entry.value, name, sine)).then(|| names.unique(format!("{prefix}_{name}")))
            };
            (name.to_string(), Variable { itself, sine: turned("sin", true), cosine: turned("cos", false) })
        });
        let variables = variables.collect();
        let quantities = listing.entries.iter().map(|entry| (entry.label.clone(), names.unique(label(&entry.label)))).collect();
        Source { quantities, variables }
    }

    fn variable(&self, name: &str) -> &Variable {
        let (_, variable) = self.variables.iter().find(|(known, _)| known == name).expect("every variable is listed");
        variable
    }
}

fn label(label: &Label) -> String {
    let by: Vec<String> = label.name.by.iter().map(|by| format!("_d{by}")).collect();
    format!("{}{}{}", "d".repeat(usize::from(!by.is_empty())), label.name.symbol, by.concat()) + &"_".repeat(label.primes)
}

/// Returns `true` if the sine, or else the cosine, of a variable occurs in an expression.
fn turns(expression: &Expression, variable: &str, sine: bool) -> bool {
    let is_it = |of: &Expression| matches!(of.form(), Form::Variable(name) if **name == *variable);
    match expression.form() {
        Form::Sine(of) if sine && is_it(of) => true,
        Form::Cosine(of) if !sine && is_it(of) => true,
        Form::Named(..) => false,
        _ => expression.parts().into_iter().any(|part| turns(part, variable, sine)),
    }
}

impl Notation for Source {
    const BAR: bool = false;
    const SIGNS: [&'static str; 2] = [" ", "\u{202f}"];

    fn variable(&self, name: &str) -> Written {
        Written::new(self.variable(name).itself.clone(), Bond::Symbol)
    }

    fn quantity(&self, of: &Label) -> Written {
        let (_, name) = self.quantities.iter().find(|(label, _)| label == of).expect("every quantity is listed");
        Written::new(name.clone(), Bond::Symbol)
    }

    fn integer(&self, digits: String) -> String {
        digits + ".0"
    }

    /// Formats the number as a decimal if that is exact.
    fn fraction(&self, number: &BigRational) -> Option<String> {
        let float = number.to_f64().filter(|float| BigRational::from_float(*float).as_ref() == Some(number))?;
        (!number.denom().is_one()).then(|| format!("{float:?}"))
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join("\u{a0}*\u{202f}")
    }

    fn quotient(&self, above: String, below: String) -> String {
        format!("{above}\u{a0}/\u{202f}{below}")
    }

    fn brackets(&self, text: String) -> String {
        format!("({text})")
    }

    fn power(&self, base: String, exponent: i64) -> String {
        let typed =
            if base.ends_with(|last: char| last.is_ascii_digit()) && base.starts_with(|c: char| c.is_ascii_digit()) { "_f64" } else { "" };
        format!("{base}{typed}.powi({exponent})")
    }

    fn minus(&self) -> &'static str {
        "-"
    }

    fn root(&self, of: String, _: Bond) -> Written {
        Written::new(format!("f64::sqrt({of})"), Bond::Symbol)
    }

    fn circular(&self, name: &'static str, of: &Expression, written: Written, exponent: i64) -> Written {
        let known = match of.form() {
            Form::Variable(of) if name == "sin" => self.variable(of).sine.clone(),
            Form::Variable(of) => self.variable(of).cosine.clone(),
            _ => None,
        };
        let turned = known.unwrap_or_else(|| format!("f64::{name}({})", written.text));
        Written::new(if exponent == 1 { turned } else { self.power(turned, exponent) }, Bond::Symbol)
    }

    /// Adds zero to make a zero positive.
    fn angle(&self, y: String, x: String) -> String {
        format!("f64::atan2({y}\u{a0}+\u{202f}0.0,\u{a0}{x}\u{a0}+\u{202f}0.0)")
    }

    fn magnitude(&self, of: String) -> String {
        format!("f64::abs({of})")
    }

    fn cases(&self, cases: &[[String; 2]], otherwise: String) -> String {
        let mut text = String::new();
        for [value, condition] in cases {
            text += &format!("if {condition} {{\n{value}\n}} else ");
        }
        text + "{\n" + &otherwise + "\n}"
    }
}

/// Returns the function.
pub(super) fn function(listing: &Listing) -> String {
    let source = Source::of(listing);
    let mut lines = Vec::new();
    let arguments: Vec<String> = source.variables.iter().map(|(_, variable)| format!("{}: f64", variable.itself)).collect();
    for (_, Variable { itself, sine, cosine }) in &source.variables {
        match (sine, cosine) {
            (Some(sine), Some(cosine)) => lines.push(format!("    let ({sine}, {cosine}) = {itself}.sin_cos();")),
            (Some(sine), None) => lines.push(format!("    let {sine} = {itself}.sin();")),
            (None, Some(cosine)) => lines.push(format!("    let {cosine} = {itself}.cos();")),
            (None, None) => (),
        }
    }
    let writer = Writer { notation: source, listing };
    let names = writer.notation.quantities.iter().map(|(_, name)| name);
    let (formula, definitions) = listing.entries.split_first().expect("a formula has a value");
    for (entry, name) in definitions.iter().zip(names.skip(1)).rev() {
        lines.push(statement(format!("    let {name} = "), writer.definition(&entry.value) + ";"));
    }
    lines.push(statement("    ".into(), writer.definition(&formula.value)));
    let name = &writer.notation.quantities[0].1;
    let attribute = "#[allow(non_snake_case, clippy::too_many_arguments)]";
    let mut head = format!("pub fn {name}({}) -> f64 {{", arguments.join(", "));
    if head.len() > 100 {
        head = format!("pub fn {name}(\n    {},\n) -> f64 {{", arguments.join(",\n    "));
    }
    format!("{attribute}\n{head}\n{}\n}}", lines.join("\n"))
}

/// Returns a statement in lines of at most a hundred columns, if possible, with each block indented.
fn statement(start: String, text: String) -> String {
    let mut lines = Vec::new();
    let mut depth = 1;
    for (at, line) in text.split('\n').enumerate() {
        depth -= usize::from(line.starts_with('}'));
        let indent = "    ".repeat(depth);
        lines.extend(broken(if at == 0 { start.clone() } else { indent }, line, 100, 4 * depth + 4));
        depth += usize::from(line.ends_with('{'));
    }
    spaced(&lines.join("\n"))
}
