//! The page of `gradient`: the effect of a typical uncertainty of each input, the largest first.

use planar_impact_app::case::CaseOutput;
use planar_impact_app::gradient::{Derivatives, Effect, Gradient, Selection};
use planar_impact_app::units::{Units, size};

use super::Facts;
use crate::block::{Block, Table};

/// Number of inputs shown for an output unless the inputs are named.
const SHOWN: usize = 10;

impl Facts for Gradient {
    /// A table of effects for each output.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = Vec::new();
        for (name, derivatives) in self.of.iter() {
            let Some(output) = CaseOutput::named(name) else { continue };
            let of = Row { gradient: self, output, derivatives, units };
            blocks.extend(of.first_order());
            blocks.extend(of.second_order());
        }
        if self.options.of == Selection::Principal {
            let more = self.outputs_of_case.saturating_sub(self.of.len());
            blocks.push(Block::paragraph(format!("{more} more outputs: --of all, or --of with their names.")));
        }
        if self.options.wrt == Selection::Principal {
            let other = "Other inputs give the same in another way, as velocity.x for a speed: --wrt all.";
            blocks.push(Block::paragraph(other));
        }
        blocks
    }
}

/// The table of one output.
struct Row<'a> {
    gradient: &'a Gradient,
    output: CaseOutput,
    derivatives: &'a Derivatives,
    units: Units,
}

impl Row<'_> {
    /// Formats a change of the output; 0 if it is only rounding.
    fn change(&self, change: f64) -> String {
        if change.is_nan() {
            return "none".to_owned();
        }
        self.units.number(self.output.measure(), change, self.gradient.scale(self.output))
    }

    fn heading(&self) -> Block {
        let symbol = self.output.symbol().map(|symbol| format!(" ({symbol})")).unwrap_or_default();
        let unit = self.units.unit(self.output.measure());
        let text = format!("{}{symbol} = {} {unit}", self.output, self.change(self.derivatives.value)).trim_end().to_owned();
        Block::Heading { level: 2, text }
    }

    fn first_order(&self) -> Vec<Block> {
        let every_input = self.gradient.options.wrt != Selection::Principal;
        let mut effects = self.gradient.effects(self.output, self.derivatives, self.units);
        let total = effects.len();
        if !every_input {
            effects.retain(|effect| effect.derivative != 0.0);
        }
        let (idle, active) = (total - effects.len(), effects.len());
        if !every_input {
            effects.truncate(SHOWN);
        }
        let mut more = Vec::new();
        if active > effects.len() {
            more.push(format!("{} more inputs have smaller changes (--wrt all)", active - effects.len()));
        }
        if idle > 0 {
            more.push(format!("{idle}{} have no effect", if effects.is_empty() { " inputs" } else { "" }));
        }
        let mut blocks = vec![self.heading()];
        if !effects.is_empty() {
            blocks.push(self.table(&effects).into());
        }
        if !more.is_empty() {
            blocks.push(Block::item("", format!("{}.", more.join(", "))));
        }
        blocks
    }

    fn table(&self, effects: &[Effect]) -> Table {
        let rows = effects.iter().map(|effect| self.row(effect)).collect();
        Table::new(["input", "value", "unit", "per unit", "change", "for"], "lrlrrl", rows).narrow().with_optional(1)
    }

    fn row(&self, effect: &Effect) -> Vec<String> {
        let (measure, units) = (effect.parameter.measure(), self.units);
        let per_unit = units.convert(self.output.measure(), effect.derivative) / units.convert(measure, 1.0);
        vec![
            effect.parameter.to_string(),
            effect.value.map_or("-".to_owned(), |value| units.number(measure, value, size(measure))),
            units.unit(measure).to_owned(),
            if per_unit.is_nan() { "none".to_owned() } else { significant(per_unit) },
            self.change(effect.change),
            effect.uncertainty.text.to_owned(),
        ]
    }

    fn second_order(&self) -> Vec<Block> {
        if self.derivatives.d2.is_none() {
            return Vec::new();
        }
        let mut effects = self.gradient.second_effects(self.output, self.derivatives, self.units);
        let count = effects.len();
        effects.truncate(SHOWN);
        let rows = effects.iter().map(|effect| {
            let with = if effect.one == effect.two { "itself".to_owned() } else { effect.two.to_string() };
            vec![effect.one.to_string(), with, self.change(effect.change)]
        });
        let table = Table::new(["second order: input", "with", "change"], "llr", rows.collect()).narrow();
        let more = (count > SHOWN).then(|| Block::item("", format!("{} more are smaller (--format json).", count - SHOWN)));
        std::iter::once(table.into()).chain(more).collect()
    }
}

/// Formats a number with four significant digits, or with a power of ten instead of a row of zeros.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e7).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let decimals = (3.0 - libm::log10(value.abs()).floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use planar_impact_app::units::Measure;

    use super::*;

    #[test]
    fn four_digits() {
        assert_eq!(significant(-872.345), "-872.3");
        assert_eq!(significant(0.012_346), "0.01235");
        assert_eq!(significant(123_456.0), "123456");
        assert_eq!(significant(1.5e9), "1.500e9");
        assert_eq!(significant(-0.0), "0");
    }

    /// The cosine of a quarter turn is no angle, length, rate, speed or energy.
    #[test]
    fn what_is_zero_within_rounding_prints_as_zero() {
        for measure in [Measure::Angle, Measure::Length, Measure::YawRate, Measure::Speed, Measure::Energy] {
            assert_eq!(Units::Si.number(measure, 6e-17, size(measure)), "0", "{measure:?}");
            assert_ne!(Units::Si.number(measure, 6e-11, size(measure)), "0", "{measure:?}");
        }
    }
}
