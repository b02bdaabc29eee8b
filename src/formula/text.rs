//! Formulas as text for a terminal.

use super::expression::Expression;
use super::listing::Label;
use super::notation::{Bond, Notation, Written};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cmp::Reverse;
use num_rational::BigRational;

/// A place for a line break only if there is no better one.
const WEAK: char = '\u{a0}';
/// A space at which no line is broken.
const TIGHT: char = '\u{202f}';

/// Unicode text.
pub(super) struct Text;

/// Greek letters in names, and their form in text and LaTeX.
const GREEK: [(&str, &str); 10] = [
    ("alpha", "α"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("theta", "θ"),
    ("mu", "μ"),
    ("phi", "φ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Omega", "Ω"),
];

/// A name as its first letters and its subscript.
pub(super) struct Parts<'a> {
    pub(super) head: &'a str,
    pub(super) index: &'a str,
    /// `true` if it is a change of the quantity that the rest names.
    pub(super) change: bool,
}

impl<'a> Parts<'a> {
    pub(super) fn of(name: &'a str) -> Parts<'a> {
        let (change, rest) = match name.strip_prefix('d') {
            Some(rest) if rest.starts_with('V') => (true, rest),
            _ => (false, name),
        };
        let end = rest.find(|c: char| c == '_' || c.is_ascii_digit()).unwrap_or(rest.len());
        let (head, index) = rest.split_at(end);
        Parts { head, index, change }
    }

    /// Returns the Greek letter that it begins with.
    pub(super) fn greek(&self) -> Option<(&'static str, &'static str)> {
        GREEK.into_iter().find(|(name, _)| *name == self.head)
    }
}

pub(super) fn symbol(name: &str) -> String {
    if let Some(of) = name.strip_prefix("det_") {
        return format!("det{TIGHT}{}", symbol(of));
    }
    let parts = Parts::of(name);
    let head = parts.greek().map_or(parts.head, |(_, letter)| letter);
    format!("{}{head}{}", if parts.change { "Δ" } else { "" }, parts.index)
}

pub(super) fn label(label: &Label) -> String {
    let symbol = symbol(&label.name.symbol) + &"′".repeat(label.primes);
    let by: Vec<String> = label.name.by.iter().map(|by| format!("∂{}", self::symbol(by))).collect();
    match by.len() {
        0 => symbol,
        1 => format!("∂{symbol}/{}", by[0]),
        n => format!("∂{}{symbol}/{}", superscript(n.to_string()), by.concat()),
    }
}

fn superscript(digits: String) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digits.chars().map(|digit| digit.to_digit(10).map_or(digit, |digit| RAISED[digit as usize])).collect()
}

impl Notation for Text {
    const BAR: bool = false;
    const SIGNS: [&'static str; 2] = [" ", "\u{202f}"];

    fn variable(&self, name: &str) -> Written {
        Written::new(symbol(name), Bond::Symbol)
    }

    fn quantity(&self, of: &Label) -> Written {
        let bond = match of.name.by.is_empty() {
            true if of.name.symbol.starts_with("det_") => Bond::Divisor,
            true => Bond::Symbol,
            false => Bond::Factor,
        };
        Written::new(label(of), bond)
    }

    fn integer(&self, digits: String) -> String {
        digits
    }

    fn fraction(&self, number: &BigRational) -> Option<String> {
        const FRACTIONS: [(i32, i32, &str); 5] = [(1, 2, "½"), (1, 3, "⅓"), (2, 3, "⅔"), (1, 4, "¼"), (3, 4, "¾")];
        let is_it = |&&(numerator, denominator, _): &&(i32, i32, &str)| *number == BigRational::new(numerator.into(), denominator.into());
        FRACTIONS.iter().find(is_it).map(|(_, _, sign)| (*sign).to_string())
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(&WEAK.to_string())
    }

    fn quotient(&self, above: String, below: String) -> String {
        format!("{above}/{below}")
    }

    fn brackets(&self, text: String) -> String {
        format!("({text})")
    }

    fn power(&self, base: String, exponent: i64) -> String {
        base + &superscript(exponent.to_string())
    }

    fn minus(&self) -> &'static str {
        "−"
    }

    fn root(&self, of: String, bond: Bond) -> Written {
        Written::new(if bond == Bond::Symbol { format!("√{of}") } else { format!("√({of})") }, Bond::Divisor)
    }

    fn circular(&self, name: &'static str, _: &Expression, of: Written, exponent: i64) -> Written {
        let raised = if exponent == 1 { String::new() } else { superscript(exponent.to_string()) };
        let of = if of.bond == Bond::Symbol { format!("{TIGHT}{}", of.text) } else { format!("({})", of.text) };
        Written::new(format!("{name}{raised}{of}"), Bond::Divisor)
    }

    fn angle(&self, y: String, x: String) -> String {
        format!("atan2({y},{TIGHT}{x})")
    }

    fn magnitude(&self, of: String) -> String {
        format!("|{of}|")
    }

    fn cases(&self, cases: &[[String; 2]], otherwise: String) -> String {
        let mut text = String::new();
        for [value, condition] in cases {
            text += &format!("{value}\n  if{TIGHT}{condition}\n");
        }
        text + &otherwise + "\n  otherwise"
    }
}

/// Formats a definition in lines of at most the width, if possible. Its continuation lines are aligned after the equals sign.
pub(super) fn definition(label: &str, value: &str, width: usize) -> String {
    let indent = label.chars().count() + 3;
    let lines = value.split('\n').enumerate().flat_map(|(at, line)| {
        // A condition is indented further than its value, and its continuation further still.
        let condition = line.trim_start();
        let inward = line.len() - condition.len();
        let start = if at == 0 { format!("{label} = ") } else { " ".repeat(indent + inward) };
        broken(start, condition, width, indent + 2 * inward)
    });
    spaced(&lines.collect::<Vec<_>>().join("\n"))
}

/// Breaks text into lines of at most the width, if possible, before a sign or else between factors.
pub(super) fn broken(start: String, text: &str, width: usize, indent: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = start;
    let mut rest: Vec<char> = text.chars().collect();
    loop {
        let room = width.saturating_sub(line.chars().count());
        let end = if rest.len() <= room { None } else { best_break(&rest[..rest.len().min(room + 1)]) };
        line.extend(&rest[..end.unwrap_or(rest.len())]);
        lines.push(line);
        match end {
            Some(end) => rest = rest.split_off(end + 1),
            None => return lines,
        }
        line = " ".repeat(indent);
    }
}

/// Returns the last break in the fewest brackets within the right two thirds of a line, or else the last break of all.
fn best_break(line: &[char]) -> Option<usize> {
    let mut depth = 0;
    let mut places = Vec::new();
    for (at, letter) in line.iter().enumerate().skip(1) {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' => places.push((depth, at)),
            _ => (),
        }
    }
    let late = places.iter().filter(|(_, at)| at * 3 >= line.len()).min_by_key(|&&(depth, at)| (depth, Reverse(at)));
    let weak = || line.iter().enumerate().skip(1).rev().find(|(_, letter)| **letter == WEAK).map(|(at, _)| at);
    late.or_else(|| places.last()).map(|(_, at)| *at).or_else(weak)
}

/// Replaces special spaces by ordinary spaces.
pub(super) fn spaced(text: &str) -> String {
    text.replace([WEAK, TIGHT], " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::expression::Name;

    #[test]
    fn names_have_their_greek_letters_and_indices() {
        let names = ["Gamma", "theta1", "omega_r", "mu0", "dV1x", "d1", "det_K", "K_nn", "pdof1", "T_before", "gammas"];
        let texts = ["Γ", "θ1", "ω_r", "μ0", "ΔV1x", "d1", "det\u{202f}K", "K_nn", "pdof1", "T_before", "gammas"];
        assert_eq!(names.map(symbol), texts);
    }

    #[test]
    fn lines_break_before_signs_outside_of_brackets_if_they_can() {
        let text = definition("x", "aaaa\u{a0}(bbbb +\u{202f}cccc) −\u{202f}(dddd +\u{202f}eeee)", 24);
        assert_eq!(text, "x = aaaa (bbbb + cccc)\n    − (dddd + eeee)");
        let factors = definition("x", "aaaaaaaaaa\u{a0}bbbbbbbbbb\u{a0}cccccccccc", 20);
        assert_eq!(factors, "x = aaaaaaaaaa\n    bbbbbbbbbb\n    cccccccccc");
        assert_eq!(definition("x", "aaaaaaaaaaaaaaaaaaaaaaaa", 10), "x = aaaaaaaaaaaaaaaaaaaaaaaa");
        // In the fewest brackets, if that is not far to the left.
        let nested = definition("x", "aaaaaaaa\u{a0}+\u{202f}bbbb (cccc (dddd dddd))", 32);
        assert_eq!(nested, "x = aaaaaaaa + bbbb\n    (cccc (dddd dddd))");
    }

    #[test]
    fn a_determinant_divides_without_brackets() {
        let bond = |symbol: &str| Text.quantity(&Label { name: Name::of(symbol), primes: 0 }).bond;
        assert_eq!((bond("det_K"), bond("K_nn")), (Bond::Divisor, Bond::Symbol));
    }
}
