//! The derivatives as a person reads them: what a typical uncertainty of each input does, the largest first.

use planar_impact::{ImpulseRatio, Output, Side};

use super::{Gradient, Row};
use crate::case::{Answer, Case, Parameter};
use crate::report::{heading, notes_below};
use crate::table::{self, Align, wrap};
use crate::units::{Measure, Units};

/// How many inputs of an output are shown unless the inputs are named.
const SHOWN: usize = 10;

/// The text and what it is about.
pub struct Page<'a> {
    pub case: &'a Case,
    pub gradient: &'a Gradient,
    pub units: Units,
    /// Whether the outputs were named.
    pub every_answer: bool,
    /// Whether the inputs were named.
    pub every_parameter: bool,
}

/// The outputs that the text shows unless they are named.
pub fn principal(case: &Case) -> Vec<Answer> {
    use Output::{CriticalImpulseRatio, DeltaVMagnitude, Loss, NormalWork, TangentialWork};
    let mut all: Vec<Answer> = [NormalWork, TangentialWork, Loss, CriticalImpulseRatio].map(Answer::Impact).into();
    for (side, vehicle) in [Side::One, Side::Two].into_iter().zip(&case.inputs.vehicles) {
        if vehicle.is_some() {
            all.push(Answer::Impact(DeltaVMagnitude(side)));
        }
    }
    all.extend([Side::One, Side::Two].map(Answer::CrushEnergy).into_iter().filter(|&answer| case.setup.lacks(answer).is_none()));
    all
}

/// Why nothing depends on the impulse ratio, where the file does not give it.
pub fn ratio_note(case: &Case) -> Option<String> {
    match case.inputs.contact.impulse_ratio {
        ImpulseRatio::Given(_) => None,
        _ => Some("the file does not give contact.impulse_ratio; the ratio follows from the inputs, and moves with them".to_owned()),
    }
}

/// What an input is typically uncertain by, in SI, and how that is written.
struct Uncertainty {
    size: f64,
    text: &'static str,
}

impl Uncertainty {
    fn of(parameter: Parameter, value: f64, units: Units) -> Uncertainty {
        let share = Uncertainty { size: 0.01 * value.abs(), text: "1 %" };
        let text = match (parameter.measure(), units) {
            (Measure::Angle, _) => "1 deg",
            (Measure::Ratio, _) => "0.05",
            (Measure::Length, Units::Us) if !matches!(parameter, Parameter::RadiusOfGyration(_)) => "1 in",
            (Measure::Length, Units::Si) if !matches!(parameter, Parameter::RadiusOfGyration(_)) => "2.5 cm",
            (Measure::Speed, Units::Us) => "1 mph",
            (Measure::Speed, Units::Si) => "1 km/h",
            (Measure::YawRate, _) => "1 deg/s",
            _ => return share,
        };
        crate::quantity::parse(text, parameter.kind()).map_or(share, |quantity| Uncertainty { size: quantity.si, text })
    }
}

/// One input of one output.
struct Line<'a> {
    parameter: Parameter,
    value: f64,
    derivative: f64,
    change: f64,
    uncertainty: &'a Uncertainty,
}

impl Page<'_> {
    /// All of it, in at most 80 columns.
    pub fn render(&self, notes: &[String]) -> String {
        let mut text = heading(&self.case.title);
        let value = |parameter| self.case.inputs.value(parameter).unwrap_or(0.0);
        let values: Vec<f64> = self.gradient.parameters.iter().map(|&parameter| value(parameter)).collect();
        let pairs = self.gradient.parameters.iter().zip(&values);
        let uncertainties: Vec<Uncertainty> = pairs.map(|(&parameter, &value)| Uncertainty::of(parameter, value, self.units)).collect();
        for row in &self.gradient.rows {
            text.push_str(&self.first_order(row, &values, &uncertainties));
            if !row.second.is_empty() {
                text.push_str(&self.second_order(row, &uncertainties));
            }
            text.push('\n');
        }
        if !self.every_answer {
            let more = self.case.setup.answers().len().saturating_sub(self.gradient.rows.len());
            text.push_str(&wrap(&format!("{more} more outputs: --of all, or --of with their names."), ""));
        }
        if !self.every_parameter {
            text.push_str(&wrap("Other inputs say the same as these in another way, as velocity.x for a speed: --wrt all.", ""));
        }
        text.push_str(&notes_below(notes));
        text
    }

    fn heading(&self, row: &Row) -> String {
        let measure = row.answer.measure();
        let symbol = row.answer.symbol().map(|symbol| format!(" ({symbol})")).unwrap_or_default();
        let unit = self.units.unit(measure);
        let value = self.units.number(measure, row.value, self.gradient.answers.scale(measure));
        format!("{}{symbol} = {value} {unit}", row.answer).trim_end().to_owned()
    }

    /// A change of an answer, 0 where it is rounding.
    fn change(&self, answer: Answer, change: f64) -> String {
        if change.is_nan() {
            return "none".to_owned();
        }
        self.units.number(answer.measure(), change, self.gradient.answers.scale(answer.measure()))
    }

    fn first_order(&self, row: &Row, values: &[f64], uncertainties: &[Uncertainty]) -> String {
        let scale = self.gradient.answers.scale(row.answer.measure());
        let mut lines: Vec<Line<'_>> = Vec::new();
        for (i, &parameter) in self.gradient.parameters.iter().enumerate() {
            let (derivative, uncertainty) = (row.first[i], &uncertainties[i]);
            let change = derivative * uncertainty.size;
            // What an uncertainty does not move beyond rounding has no derivative worth printing.
            let derivative = if change.abs() <= 1e-12 * scale && uncertainty.size > 0.0 { 0.0 } else { derivative };
            lines.push(Line { parameter, value: values[i], derivative, change, uncertainty });
        }
        lines.sort_by(|a, b| b.change.abs().total_cmp(&a.change.abs()));
        let total = lines.len();
        if !self.every_parameter {
            lines.retain(|line| line.derivative != 0.0);
        }
        let (idle, active) = (total - lines.len(), lines.len());
        if !self.every_parameter {
            lines.truncate(SHOWN);
        }
        let mut text = self.heading(row) + "\n";
        if !lines.is_empty() {
            text.push_str(&self.table(row.answer, &lines));
            text.push('\n');
        }
        let mut more = Vec::new();
        if active > lines.len() {
            more.push(format!("{} more inputs have smaller changes (--wrt all)", active - lines.len()));
        }
        if idle > 0 {
            more.push(format!("{idle}{} have no effect", if lines.is_empty() { " inputs" } else { "" }));
        }
        if !more.is_empty() {
            text.push_str(&wrap(&format!("{}.", more.join(", ")), ""));
        }
        text
    }

    fn table(&self, answer: Answer, lines: &[Line<'_>]) -> String {
        let cells: Vec<Vec<String>> = lines.iter().map(|line| self.line(answer, line)).collect();
        let columns = [Align::Left, Align::Right, Align::Left, Align::Right, Align::Right, Align::Left];
        let table = table::narrow(&["input", "value", "unit", "per unit", "change", "for"], &columns, &cells);
        if table.lines().all(|line| line.chars().count() <= 80) {
            return table;
        }
        // The values stand in the file; the derivatives do not.
        let without: Vec<Vec<String>> = cells.iter().map(|row| [&row[..1], &row[2..]].concat()).collect();
        let columns = [Align::Left, Align::Left, Align::Right, Align::Right, Align::Left];
        table::narrow(&["input", "unit", "per unit", "change", "for"], &columns, &without)
    }

    fn line(&self, answer: Answer, line: &Line<'_>) -> Vec<String> {
        let (measure, units) = (line.parameter.measure(), self.units);
        let given = self.case.inputs.value(line.parameter).is_ok();
        let per_unit = units.convert(answer.measure(), line.derivative) / units.convert(measure, 1.0);
        vec![
            line.parameter.to_string(),
            if given { units.number(measure, line.value, value_scale(measure)) } else { "-".to_owned() },
            units.unit(measure).to_owned(),
            if per_unit.is_nan() { "none".to_owned() } else { significant(per_unit) },
            self.change(answer, line.change),
            line.uncertainty.text.to_owned(),
        ]
    }

    fn second_order(&self, row: &Row, uncertainties: &[Uncertainty]) -> String {
        let scale = self.gradient.answers.scale(row.answer.measure());
        let mut effects = Vec::new();
        for i in 0..uncertainties.len() {
            for j in i..uncertainties.len() {
                let weight = if i == j { 0.5 } else { 1.0 };
                let effect = weight * row.second[i][j] * uncertainties[i].size * uncertainties[j].size;
                if effect.abs() > 1e-12 * scale {
                    effects.push((i, j, effect));
                }
            }
        }
        effects.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        let count = effects.len();
        effects.truncate(SHOWN);
        let name = |i: usize| self.gradient.parameters[i].to_string();
        let cells: Vec<Vec<String>> = effects
            .iter()
            .map(|&(i, j, effect)| vec![name(i), if i == j { "itself".to_owned() } else { name(j) }, self.change(row.answer, effect)])
            .collect();
        let mut text = "\n".to_owned();
        text.push_str(&table::narrow(&["second order: input", "with", "change"], &[Align::Left, Align::Left, Align::Right], &cells));
        text.push('\n');
        if count > cells.len() {
            text.push_str(&wrap(&format!("{} more are smaller (--format json).", count - cells.len()), ""));
        }
        text
    }
}

/// Angles and lengths that are zero by rounding read as zero.
fn value_scale(measure: Measure) -> f64 {
    match measure {
        Measure::Angle | Measure::Length | Measure::YawRate | Measure::Speed => 1.0,
        _ => 0.0,
    }
}

/// Four significant digits, with a power of ten where they would be a row of zeros.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e7).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let decimals = (3.0 - value.abs().log10().floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::CrushKey;
    use planar_impact::Input;

    #[test]
    fn four_digits() {
        assert_eq!(significant(-872.345), "-872.3");
        assert_eq!(significant(0.012_346), "0.01235");
        assert_eq!(significant(123_456.0), "123456");
        assert_eq!(significant(1.5e9), "1.500e9");
        assert_eq!(significant(-0.0), "0");
    }

    #[test]
    fn uncertainties_are_in_the_units_of_the_text() {
        let of = |parameter, value, units| {
            let uncertainty = Uncertainty::of(parameter, value, units);
            (uncertainty.size, uncertainty.text)
        };
        assert_eq!(of(Parameter::Input(Input::Mass(Side::One)), 1500.0, Units::Us), (15.0, "1 %"));
        assert_eq!(of(Parameter::Speed(Side::One), 10.0, Units::Us), (0.44704, "1 mph"));
        assert_eq!(of(Parameter::Speed(Side::One), 10.0, Units::Si).1, "1 km/h");
        assert_eq!(of(Parameter::Crush(Side::One, CrushKey::Depth(2)), 0.1, Units::Si), (0.025, "2.5 cm"));
        assert_eq!(of(Parameter::Friction, 0.4, Units::Us), (0.05, "0.05"));
        assert_eq!(of(Parameter::RadiusOfGyration(Side::Two), 1.5, Units::Si), (0.015, "1 %"));
        assert_eq!(of(Parameter::Input(Input::CrushPlane), 0.0, Units::Si).0, 1_f64.to_radians());
    }
}
