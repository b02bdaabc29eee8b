//! The page of `formula`, and the list of names that it accepts.

use planar_impact::{Input, Output};
use planar_impact_app::Units;
use planar_impact_app::formula::{Formula, FormulaInput};

use crate::block::{Block, Table};
use crate::text::WIDTH;

/// Renders the formula with its definitions and inputs.
pub fn page(answer: &Formula, units: Units) -> Vec<Block> {
    let mut blocks = vec![Block::paragraph(answer.subject.as_str())];
    let definitions: Vec<String> = (0..answer.definitions.len()).map(|at| definition(answer, at)).collect();
    if let Some((first, others)) = definitions.split_first() {
        blocks.push(Block::Verbatim(first.clone()));
        if !others.is_empty() {
            blocks.push(Block::Verbatim(format!("where\n{}", others.join("\n"))));
        }
    }
    blocks.extend(Block::notices(&answer.notices, units));
    if !answer.inputs.is_empty() {
        blocks.push(Block::Verbatim(format!("inputs\n{}", legend(answer))));
    }
    blocks
}

/// Renders the definition of a quantity, and its value in the case. All but the first are indented.
fn definition(answer: &Formula, at: usize) -> String {
    let indent = if at == 0 { "" } else { "  " };
    let (width, symbol) = (WIDTH - indent.len(), &answer.definitions[at].symbol);
    let mut lines = answer.formula.definitions().get(at).map(|definition| definition.text(width)).unwrap_or_default();
    if lines == format!("{symbol} = {symbol}") {
        lines.push_str(", which is an input");
    }
    if answer.has_case {
        append(&mut lines, &number(answer.definitions[at].value.unwrap_or(f64::NAN)), width, symbol.chars().count() + 1);
    }
    lines.lines().map(|line| format!("{indent}{line}")).collect::<Vec<_>>().join("\n")
}

/// Appends a value to a definition, on its last line if there is room, otherwise below it.
fn append(lines: &mut String, value: &str, width: usize, indent: usize) {
    let used = lines.lines().last().map_or(0, |line| line.chars().count());
    if lines.lines().count() > 1 && lines.ends_with("otherwise") || used + value.chars().count() + 3 > width {
        lines.push_str(&format!("\n{:indent$}", ""));
    } else {
        lines.push(' ');
    }
    lines.push_str(&format!("= {value}"));
}

/// Renders the inputs with their names, in two columns, or one per line with its value.
fn legend(answer: &Formula) -> String {
    let name = |input: &FormulaInput| format!("{}{}", input.name, input.meaning);
    let line = |inputs: &[FormulaInput]| -> String {
        let cells = inputs.iter().map(|input| match answer.has_case {
            true => format!("  {:<3} {:<36} {}", input.symbol, name(input), input.value.map_or_else(String::new, number)),
            false => format!("  {:<3} {:<32}", input.symbol, name(input)),
        });
        cells.collect::<String>().trim_end().to_owned()
    };
    answer.inputs.chunks(if answer.has_case { 1 } else { 2 }).map(line).collect::<Vec<_>>().join("\n")
}

/// Formats a number with at most six significant digits, and with an exponent if it is large or small.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "no number".to_owned();
    }
    let magnitude = libm::log10(value.abs()).floor();
    let text = format!("{value:.5e}");
    let (digits, exponent) = match text.split_once('e') {
        Some((digits, exponent)) if !(-4.0..6.0).contains(&magnitude) => (digits.to_owned(), format!("e{exponent}")),
        _ => (format!("{value:.*}", (5.0 - magnitude) as usize), String::new()),
    };
    let digits = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{digits}{exponent}").replace('-', "−")
}

/// Renders the names of outputs and inputs.
pub fn names() -> Vec<Block> {
    let row = |symbol: &str, name: &str| vec![symbol.to_owned(), name.to_owned()];
    let outputs = Output::ALL.iter().map(|output| row(output.symbol(), output.name())).collect();
    let inputs = Input::ALL.iter().map(|input| row(input.symbol(), input.name())).collect();
    vec![Table::new(["output", "name"], "ll", outputs).into(), Table::new(["input", "name"], "ll", inputs).into()]
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
