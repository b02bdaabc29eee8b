//! Formulas for LaTeX.

use super::expression::Expression;
use super::listing::Label;
use super::notation::{Bond, Notation, Written};
use super::text::Parts;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::One;

/// LaTeX mathematics, limited to what KaTeX and MathJax support.
pub(super) struct Latex;

fn symbol(name: &str) -> String {
    if let Some(of) = name.strip_prefix("det_") {
        return format!(r"\det {}", symbol(of));
    }
    let parts = Parts::of(name);
    let head = match parts.greek() {
        Some((name, _)) => format!(r"\{name}"),
        None if parts.head.len() == 1 => parts.head.to_string(),
        None => format!(r"\mathrm{{{}}}", parts.head),
    };
    let change = if parts.change { r"\Delta " } else { "" };
    let index = parts.index.trim_start_matches('_').replace('_', ",");
    let letters = index.trim_start_matches(|c: char| c.is_ascii_digit());
    match (index.len(), letters.len()) {
        (0, _) => format!("{change}{head}"),
        (1, _) => format!("{change}{head}_{index}"),
        (_, 0..=2) => format!("{change}{head}_{{{index}}}"),
        _ => format!(r"{change}{head}_{{\mathrm{{{index}}}}}"),
    }
}

pub(super) fn label(label: &Label) -> String {
    let symbol = symbol(&label.name.symbol) + &"'".repeat(label.primes);
    let by: Vec<String> = label.name.by.iter().map(|by| format!(r"\partial {}", self::symbol(by))).collect();
    match by.len() {
        0 => symbol,
        1 => format!(r"\frac{{\partial {symbol}}}{{{}}}", by[0]),
        n => format!(r"\frac{{\partial^{n} {symbol}}}{{{}}}", by.join(r" \, ")),
    }
}

impl Notation for Latex {
    const BAR: bool = true;
    const SIGNS: [&'static str; 2] = [" ", " "];

    fn variable(&self, name: &str) -> Written {
        Written::new(symbol(name), Bond::Symbol)
    }

    fn quantity(&self, of: &Label) -> Written {
        let alone = of.name.by.is_empty() && of.primes == 0 && !of.name.symbol.starts_with("det_");
        Written::new(label(of), if alone { Bond::Symbol } else { Bond::Factor })
    }

    fn integer(&self, digits: String) -> String {
        digits
    }

    fn fraction(&self, number: &BigRational) -> Option<String> {
        (!number.denom().is_one()).then(|| format!(r"\tfrac{{{}}}{{{}}}", number.numer(), number.denom()))
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" ")
    }

    fn quotient(&self, above: String, below: String) -> String {
        format!(r"\frac{{{above}}}{{{below}}}")
    }

    fn brackets(&self, text: String) -> String {
        format!(r"\left( {text} \right)")
    }

    fn power(&self, base: String, exponent: i64) -> String {
        format!("{base}^{{{exponent}}}")
    }

    fn minus(&self) -> &'static str {
        "-"
    }

    fn root(&self, of: String, _: Bond) -> Written {
        Written::new(format!(r"\sqrt{{{of}}}"), Bond::Symbol)
    }

    fn circular(&self, name: &'static str, _: &Expression, of: Written, exponent: i64) -> Written {
        let raised = if exponent == 1 { String::new() } else { format!("^{{{exponent}}}") };
        let of = if of.bond == Bond::Symbol { of.text } else { self.brackets(of.text) };
        Written::new(format!(r"\{name}{raised} {of}"), Bond::Factor)
    }

    fn angle(&self, y: String, x: String) -> String {
        format!(r"\operatorname{{atan2}}\left( {y}, {x} \right)")
    }

    fn magnitude(&self, of: String) -> String {
        format!(r"\left| {of} \right|")
    }

    fn cases(&self, cases: &[[String; 2]], otherwise: String) -> String {
        let mut text = String::from(r"\begin{cases} ");
        for [value, condition] in cases {
            text += &format!(r"{value} & \text{{if }} {condition} \\ ");
        }
        text + &otherwise + r" & \text{otherwise} \end{cases}"
    }
}

/// Length in characters of source from which a line is broken; most of them are not visible.
const LONG: usize = 160;

/// Writes a definition as a line of an aligned environment, broken before signs outside of brackets.
pub(super) fn definition(label: &str, value: &str) -> String {
    let mut line = format!("{label} &= ");
    let (mut depth, mut length) = (0, line.len());
    for word in value.split_inclusive(' ') {
        let word_is_sign = matches!(word, "+ " | "- ");
        if word_is_sign && depth == 0 && length > LONG {
            line += "\\\\\n&\\quad {} ";
            length = 0;
        }
        line += word;
        length += word.len();
        depth += word.matches(['{', '(']).count() + word.matches(r"\left|").count();
        depth -= word.matches(['}', ')']).count() + word.matches(r"\right|").count();
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::expression::Name;

    #[test]
    fn names_have_their_greek_letters_and_indices() {
        let names = ["Gamma", "theta1", "omega_r", "mu0", "dV1x", "det_K", "K_nn", "pdof1", "T_before", "m1", "e"];
        let symbols = [
            r"\Gamma",
            r"\theta_1",
            r"\omega_r",
            r"\mu_0",
            r"\Delta V_{1x}",
            r"\det K",
            "K_{nn}",
            r"\mathrm{pdof}_1",
            r"T_{\mathrm{before}}",
            "m_1",
            "e",
        ];
        assert_eq!(names.map(symbol), symbols);
    }

    #[test]
    fn what_is_written_of_several_parts_is_no_symbol() {
        let bond = |symbol: &str, by: &[&str], primes| {
            let name = by.iter().fold(Name::of(symbol), |name, by| name.derivative(&(*by).into()));
            Latex.quantity(&Label { name, primes }).bond
        };
        assert_eq!(bond("K_nn", &[], 0), Bond::Symbol);
        for (symbol, by, primes) in [("det_K", &[][..], 0), ("K_nn", &["e"], 0), ("K_nn", &[], 1)] {
            assert_eq!(bond(symbol, by, primes), Bond::Factor, "{symbol} {by:?} {primes}");
        }
        assert_eq!(Latex.minus(), "-");
    }

    #[test]
    fn long_lines_break_outside_of_brackets() {
        let term = r"\left( a + b \right)";
        let long = [term; 12].join(" + ");
        let lines = definition("x", &long);
        let parts: Vec<&str> = lines.split("\\\\\n&\\quad {} ").collect();
        assert_eq!(parts.len(), 2);
        assert!(parts.iter().all(|part| part.matches(r"\left").count() == part.matches(r"\right").count()));
        assert!(parts[1].starts_with("+ "));
    }
}
