//! The effects of the inputs on each output, the greatest first.

use planar_impact_app::case::CaseOutput;
use planar_impact_app::gradient::{Derivatives, Effect, Gradient};
use planar_impact_app::issue::Issues;
use planar_impact_app::uncertainty::{OutputUncertainty, Uncertainty};
use planar_impact_app::units::Measure;
use planar_impact_app::{Answer, Units};
use plotters::prelude::Color;
use plotters::style::text_anchor::VPos;

use super::canvas::{Area, BLUE, DARK, Drawn, GRAY, VERMILION, Writing, hatch, outline, page, px, rectangle, segment, write};
use crate::page::uncertainty::with_digits;

/// Number of inputs with a bar.
const MOST_BARS: usize = 12;
/// Height of a row, of the name of an output above its rows, and of the legend, in pixels.
const ROW: i32 = 26;
const HEAD: i32 = 44;
const FOOT: i32 = 44;
const BAR: i32 = 16;
/// Middle and half the width of the bars.
const MIDDLE: i32 = 560;
const HALF: i32 = 190;
/// Right edge of the names, and left edge of the numbers.
const NAMES: i32 = 350;
const NUMBERS: i32 = 764;

/// Draws the effect of the standard deviation of each uncertain input on each output, to first order.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn tornado_of_uncertainty(answer: &Answer<Uncertainty>, units: Units) -> Result<String, Issues> {
    let panel = |(of, (_, found)): (&CaseOutput, (&str, &OutputUncertainty))| {
        let linear = found.linear.as_ref()?;
        let inputs = answer.parameters.iter().zip(answer.inputs.iter());
        let bars = inputs.zip(linear.effects.iter()).map(|((parameter, (name, number)), (_, effect))| Bar {
            input: format!("{name} ± {}", step(units, parameter.measure(), number.sd)),
            effect: *effect,
        });
        Some(Panel::of(*of, linear.mean, bars.collect()))
    };
    let panels: Vec<Panel> = answer.outputs.iter().zip(answer.of.iter()).filter_map(panel).collect();
    chart(&answer.title, "one standard deviation", &panels, units)
}

/// Draws the effect of a typical uncertainty of each input on each output, to first order.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn tornado_of_gradient(answer: &Answer<Gradient>, units: Units) -> Result<String, Issues> {
    let panel = |(name, derivatives): (&str, &Derivatives)| {
        let of = CaseOutput::named(name)?;
        let bar = |effect: Effect| Bar {
            input: format!("{} ± {}", effect.parameter, effect.uncertainty.text),
            // A change that is rounding has no derivative.
            effect: if effect.derivative == 0.0 { 0.0 } else { effect.change },
        };
        Some(Panel::of(of, derivatives.value, answer.effects(of, derivatives, units).into_iter().map(bar).collect()))
    };
    let panels: Vec<Panel> = answer.of.iter().filter_map(panel).collect();
    chart(&answer.title, "the step beside its name", &panels, units)
}

/// Formats the standard deviation of an input.
fn step(units: Units, measure: Measure, sd: f64) -> String {
    if !sd.is_finite() {
        return "∞".to_owned();
    }
    format!("{} {}", with_digits(units, measure, sd, sd), units.unit(measure)).trim_end().to_owned()
}

/// The effect of an input.
#[derive(Debug, PartialEq)]
struct Bar {
    /// Its name, with the step.
    input: String,
    /// The change of the output where the input increases by the step, in SI.
    effect: f64,
}

/// The effects on one output.
#[derive(Debug, PartialEq)]
struct Panel {
    of: CaseOutput,
    /// Its value, in SI.
    value: f64,
    /// The greatest first.
    bars: Vec<Bar>,
    /// Number of inputs with smaller effects, or none.
    others: usize,
}

impl Panel {
    fn of(of: CaseOutput, value: f64, mut bars: Vec<Bar>) -> Panel {
        let count = bars.len();
        let greatest = bars.iter().map(|bar| bar.effect.abs()).filter(|effect| effect.is_finite()).fold(value.abs(), f64::max);
        bars.retain(|bar| bar.effect.is_finite() && bar.effect.abs() > 1e-12 * greatest);
        bars.sort_by(|one, other| other.effect.abs().total_cmp(&one.effect.abs()));
        bars.truncate(MOST_BARS);
        Panel { of, value, others: count - bars.len(), bars }
    }

    fn height(&self) -> i32 {
        HEAD + ROW * (self.bars.len() as i32 + i32::from(self.others > 0))
    }

    /// Returns where each bar ends at which the input is greater, as a share of the longest; negative to the left.
    fn ends(&self) -> Vec<f64> {
        let greatest = self.bars.first().map_or(1.0, |bar| bar.effect.abs());
        self.bars.iter().map(|bar| bar.effect / greatest).collect()
    }

    fn draw(&self, area: &Area<'_>, units: Units, top: i32) -> Drawn {
        let (measure, greatest) = (self.of.measure(), self.bars.first().map_or(0.0, |bar| bar.effect.abs()));
        let value = format!("{} {}", with_digits(units, measure, self.value, greatest), units.unit(measure));
        write(area, &format!("{} = {}", self.of.short_name(), value.trim_end()), 17, (16, top + 12))?;
        let first = top + HEAD;
        for (row, (bar, end)) in self.bars.iter().zip(self.ends()).enumerate() {
            let (top, side) = (first + ROW * row as i32, (f64::from(HALF) * end).round() as i32);
            let middle = top + BAR / 2;
            let (greater, less) = ((MIDDLE + side, top + BAR), (MIDDLE - side, top + BAR));
            rectangle(area, (MIDDLE, top), greater, BLUE.mix(0.75).filled())?;
            rectangle(area, (MIDDLE, top), less, VERMILION.mix(0.15).filled())?;
            hatch(area, (MIDDLE, top), less, VERMILION.stroke_width(px(1)))?;
            outline(area, (MIDDLE - side, top), (MIDDLE + side, top + BAR), DARK)?;
            Writing { down: VPos::Center, ..Writing::ending() }.write(area, &bar.input, (NAMES, middle))?;
            let sign = if bar.effect > 0.0 { '±' } else { '∓' };
            let number = format!("{sign}{}", with_digits(units, measure, bar.effect.abs(), bar.effect));
            Writing { down: VPos::Center, ..Writing::default() }.write(area, &number, (NUMBERS, middle))?;
        }
        let last = first + ROW * self.bars.len() as i32;
        if !self.bars.is_empty() {
            segment(area, (MIDDLE, first - 6), (MIDDLE, last - ROW + BAR + 6), GRAY.stroke_width(px(1)))?;
        }
        if self.others > 0 {
            let text = match (self.bars.is_empty(), self.others) {
                (true, _) => "no input has an effect".to_owned(),
                (false, 1) => "and 1 input with a smaller effect or none".to_owned(),
                (false, others) => format!("and {others} inputs with smaller effects or none"),
            };
            Writing::ending().write(area, &text, (NAMES, last))?;
        }
        Ok(())
    }
}

fn chart(title: &str, step: &str, panels: &[Panel], units: Units) -> Result<String, Issues> {
    let names: Vec<String> = panels.iter().map(|panel| panel.of.to_string()).collect();
    let description = format!("Change of {} where one input changes by {step}, the greatest first.", names.join(", "));
    let title = if title.is_empty() { "Effects of the inputs".to_owned() } else { format!("Effects of the inputs: {title}") };
    let height = panels.iter().map(Panel::height).sum::<i32>() + FOOT;
    page(&title, &description, px(height as u32), |area| {
        let mut top = 0;
        for panel in panels {
            panel.draw(area, units, top)?;
            top += panel.height();
        }
        legend(area, step, top + 14)
    })
}

fn legend(area: &Area<'_>, step: &str, top: i32) -> Drawn {
    let sample = |left: i32| ((left, top), (left + 28, top + 14));
    let (from, to) = sample(16);
    rectangle(area, from, to, BLUE.mix(0.75).filled())?;
    outline(area, from, to, DARK)?;
    write(area, &format!("input greater by {step}"), 14, (52, top))?;
    let (from, to) = sample(450);
    rectangle(area, from, to, VERMILION.mix(0.15).filled())?;
    hatch(area, from, to, VERMILION.stroke_width(px(1)))?;
    outline(area, from, to, DARK)?;
    write(area, "input less by as much", 14, (486, top))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, case};
    use super::*;
    use planar_impact_app::{Case, Uncontrolled, gradient, solve, uncertainty};

    fn uncertain() -> Case {
        case(include_str!("../../../cli/examples/uncertain.toml"))
    }

    fn linear(case: &Case) -> Answer<Uncertainty> {
        let options = uncertainty::Options { methods: vec![uncertainty::Method::Linear], ..uncertainty::Options::default() };
        uncertainty::uncertainty(case, &options, &Uncontrolled).expect("an answer")
    }

    #[test]
    fn the_greatest_effect_comes_first_and_squares_add_up_without_correlation() {
        let mut case = uncertain();
        case.uncertain.correlations.clear();
        let answer = linear(&case);
        for (_, found) in answer.of.iter() {
            let linear = found.linear.as_ref().expect("linear");
            let sum: f64 = linear.effects.iter().map(|(_, effect)| effect * effect).sum();
            assert!((sum.sqrt() - linear.sd).abs() <= 1e-9 * linear.sd, "{} {}", sum.sqrt(), linear.sd);
        }
        let bars = [3.0, -7.0, 0.0, 5.0, f64::NAN].map(|effect| Bar { input: effect.to_string(), effect });
        let panel = Panel::of(answer.outputs[0], 1.0, bars.into());
        assert_eq!(panel.bars.iter().map(|bar| bar.effect).collect::<Vec<_>>(), [-7.0, 5.0, 3.0]);
        assert_eq!((panel.ends(), panel.others), (vec![-1.0, 5.0 / 7.0, 3.0 / 7.0], 2));
    }

    #[test]
    fn an_effect_is_that_of_the_input_moved_by_a_step() {
        /// Share of the standard deviation that is moved.
        const STEP: f64 = 1e-4;
        let case = uncertain();
        let answer = linear(&case);
        let means: Vec<_> =
            answer.parameters.iter().zip(answer.inputs.iter()).map(|(parameter, (_, number))| (*parameter, number.mean)).collect();
        let loss = |moved: usize, by: f64| {
            let mut values = means.clone();
            values[moved].1 += by;
            solve::solve(&case.with(&values), &(), &Uncontrolled).expect("a solution").energy.loss
        };
        let found = answer.of.get("energy.loss").expect("a principal output").linear.as_ref().expect("linear");
        for (place, ((_, effect), (_, number))) in found.effects.iter().zip(answer.inputs.iter()).enumerate() {
            let step = STEP * number.sd;
            let moved = (loss(place, step) - loss(place, -step)) / (2.0 * STEP);
            assert!((effect - moved).abs() <= 1e-5 * found.sd, "{effect}, not {moved}");
        }
    }

    #[test]
    fn tornadoes_are_legible() {
        assert_legible(&tornado_of_uncertainty(&linear(&uncertain()), Units::Si).expect("in memory"));
        for text in [include_str!("../../../cli/examples/position-a.toml"), include_str!("../../../cli/examples/crabbed-barrier.toml")] {
            let options = gradient::Options { of: gradient::Selection::Principal, wrt: gradient::Selection::Principal, second: false };
            let answer = gradient::gradient(&case(text), &options, &Uncontrolled).expect("an answer");
            for units in [Units::Us, Units::Si] {
                assert_legible(&tornado_of_gradient(&answer, units).expect("in memory"));
            }
        }
    }
}
