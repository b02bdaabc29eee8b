//! Cases side by side: a panel for each output, in which each case has a mark and, where it is reconstructed, an interval.

use planar_impact_app::compare::{CaseComparison, ComparedCase, ComparedOutput};
use planar_impact_app::issue::Issues;
use planar_impact_app::plain_text::shorten;
use planar_impact_app::{Answer, Units};
use plotters::prelude::{Circle, Color, ShapeStyle};
use plotters::style::text_anchor::VPos;

use super::canvas::{Area, BLUE, DARK, Drawn, GRAY, GRID, Writing, page, px, rectangle, segment, span, with_unit, write};
use crate::page::compare::{end, printed, value};

/// Height of a row, and of the name of an output above its rows, in pixels.
const ROW: i32 = 22;
const HEAD: i32 = 38;
/// Right edge of the names, ends of the scale, and left edge of the numbers.
const NAMES: i32 = 300;
const LEFT: i32 = 320;
const RIGHT: i32 = 600;
const NUMBERS: i32 = 616;
/// Most characters of the numbers.
const LONGEST: usize = 42;
/// Widest name of a case, in columns.
const NAME_WIDTH: usize = 34;

/// Draws the outputs of the cases, each output on a scale of its own.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn compare(answer: &Answer<CaseComparison>, units: Units) -> Result<String, Issues> {
    let count = answer.cases.len() as i32;
    let panel = HEAD + ROW * count;
    let names: Vec<&str> = answer.outputs.iter().map(|output| output.name.as_str()).collect();
    let description = format!("{} of {count} cases side by side.", names.join(", "));
    let title = if answer.title.is_empty() { "Comparison".to_owned() } else { format!("Comparison: {}", answer.title) };
    // Without an output there are the reasons alone.
    let height = panel * (answer.outputs.len().max(1)) as i32 + 16;
    page(&title, &description, px(height as u32), |area| {
        if answer.outputs.is_empty() {
            return write(area, "Every case is refused.", 17, (16, 12));
        }
        for (place, output) in answer.outputs.iter().enumerate() {
            Panel { answer, output, units }.draw(area, panel * place as i32)?;
        }
        Ok(())
    })
}

struct Panel<'a> {
    answer: &'a CaseComparison,
    output: &'a ComparedOutput,
    units: Units,
}

/// What a row of a panel shows: zero, its value and the ends of its interval, as shares of the width of the scale; `None` for an end that nothing limits.
#[derive(Debug, PartialEq)]
struct Row {
    zero: f64,
    value: Option<f64>,
    ends: Option<[Option<f64>; 2]>,
}

impl Panel<'_> {
    fn rows(&self) -> Vec<Row> {
        let output = self.output;
        let ends = output.intervals.iter().flatten().flat_map(|interval| [interval.low, interval.high]);
        let all: Vec<f64> = output.values.iter().copied().chain(ends).flatten().collect();
        // From zero, so that lengths compare.
        let range = span(all.iter().copied().chain([0.0]), 0.05);
        let share = |si: f64| (si - range.start) / (range.end - range.start);
        let row = |place: usize| Row {
            zero: share(0.0),
            value: output.values[place].map(share),
            ends: output.intervals[place].as_ref().map(|interval| [interval.low, interval.high].map(|end| end.map(share))),
        };
        (0..output.values.len()).map(row).collect()
    }

    /// Returns the value of a case in words, with its interval.
    fn numbers(&self, place: usize) -> String {
        let output = self.output;
        if self.answer.cases[place].is_refused() {
            let refusals = &self.answer.cases[place].refusals;
            let others = if refusals.len() > 1 { format!(" and {} more", refusals.len() - 1) } else { String::new() };
            return format!("refused: {}{others}", refusals[0].code);
        }
        let value = value(output, place, self.units);
        let Some(interval) = &output.intervals[place] else { return value };
        let ends = [(interval.low, "−∞"), (interval.high, "∞")];
        let [low, high] =
            ends.map(|(si, none)| si.map_or_else(|| none.to_owned(), |si| end(interval, printed(output.measure), si, self.units)));
        let text = format!("{value} ({low} to {high})");
        // Of a narrow interval its digits do not fit.
        if text.chars().count() <= LONGEST {
            text
        } else {
            self.units.number(printed(output.measure), output.values[place].unwrap_or(f64::NAN), 0.0)
        }
    }

    fn draw(&self, area: &Area<'_>, top: i32) -> Drawn {
        let fine = px(1) as i32;
        let name = with_unit(&self.output.name, self.units.unit(printed(self.output.measure)));
        write(area, &name, 16, (16, top + 14))?;
        let first = top + HEAD;
        let style = |width: u32| ShapeStyle::from(&BLUE).stroke_width(px(width));
        for (place, row) in self.rows().into_iter().enumerate() {
            let middle = first + ROW * place as i32 + ROW / 2;
            let across = |share: f64| LEFT + (f64::from(RIGHT - LEFT) * share).round() as i32;
            let case = &self.answer.cases[place];
            let label = format!("[{}] {}", place + 1, shorten(own_end(&case.name, &self.answer.cases), NAME_WIDTH));
            Writing { down: VPos::Center, ..Writing::ending() }.write(area, &label, (NAMES, middle))?;
            Writing { down: VPos::Center, color: if case.is_refused() { GRAY } else { DARK }, ..Writing::default() }.write(
                area,
                &self.numbers(place),
                (NUMBERS, middle),
            )?;
            rectangle(area, (LEFT, middle - 1), (RIGHT, middle + 1), GRID.filled())?;
            let zero = across(row.zero);
            segment(area, (zero, middle - ROW / 2), (zero, middle + ROW / 2), GRAY.stroke_width(px(1)))?;
            if let Some(share) = row.value {
                segment(area, (zero, middle), (across(share), middle), style(1))?;
            }
            if let Some(ends) = row.ends {
                let at = [ends[0].map_or(LEFT, across), ends[1].map_or(RIGHT, across)];
                segment(area, (at[0], middle), (at[1], middle), style(3))?;
                for (_, x) in ends.into_iter().zip(at).filter(|(end, _)| end.is_some()) {
                    segment(area, (x, middle - 6), (x, middle + 6), style(2))?;
                }
            }
            if let Some(share) = row.value {
                area.draw(&Circle::new((fine * across(share), fine * middle), px(5), BLUE.filled()))?;
            }
        }
        Ok(())
    }
}

/// Returns the last parts of a path that tell it from the others, mostly one.
fn own_end<'a>(path: &'a str, cases: &[ComparedCase]) -> &'a str {
    let others = || cases.iter().map(|case| case.name.as_str()).filter(|other| *other != path);
    let mut ends = path.rmatch_indices(['/', '\\']).map(|(at, _)| &path[at + 1..]);
    ends.find(|end| !others().any(|other| other.ends_with(end))).unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, case, hostile};
    use super::*;
    use planar_impact_app::Uncontrolled;
    use planar_impact_app::compare::{Variant, compare as line_up};

    fn variants() -> Vec<Variant> {
        let text = include_str!("../../../cli/examples/position-b.toml");
        let all = ["0.15", "0.3", "0.15\nimpulse_ratio = 3"].map(|e| text.replace("restitution = 0.15", &format!("restitution = {e}")));
        all.into_iter().enumerate().map(|(i, text)| Variant { name: format!("{i}/{}", hostile()), case: case(&text) }).collect()
    }

    #[test]
    fn marks_are_in_the_order_of_the_values() {
        let answer = line_up(&variants(), &(), &Uncontrolled).expect("an answer");
        for output in &answer.outputs {
            let rows = Panel { answer: &answer, output, units: Units::Us }.rows();
            let [Some(one), Some(two)] = [output.values[0], output.values[1]] else { panic!("solved") };
            let share = |row: &Row| row.value.expect("a mark");
            assert_eq!(one.total_cmp(&two), share(&rows[0]).total_cmp(&share(&rows[1])), "{}", output.name);
            // Lengths from zero are as the values.
            let lengths = [0, 1].map(|place: usize| share(&rows[place]) - rows[place].zero);
            assert!((lengths[0] * two - lengths[1] * one).abs() <= 1e-9 * one.abs().max(two.abs()), "{}", output.name);
            assert_eq!(rows[2], Row { zero: rows[2].zero, value: None, ends: None });
        }
    }

    #[test]
    fn files_of_one_name_have_the_folder_that_tells_them() {
        let all = ["a/b/x.toml", "a/c/x.toml", "a\\y.toml", "x.toml", "a/b/x.toml"];
        let variants = all.map(|name| Variant { name: name.to_owned(), case: variants().remove(0).case });
        let answer = line_up(&variants, &(), &Uncontrolled).expect("an answer");
        let ends: Vec<&str> = all.iter().map(|path| own_end(path, &answer.cases)).collect();
        assert_eq!(ends, ["b/x.toml", "c/x.toml", "y.toml", "x.toml", "b/x.toml"]);
    }

    #[test]
    fn comparisons_are_legible() {
        let mut all = variants();
        assert_legible(&compare(&line_up(&all, &(), &Uncontrolled).expect("an answer"), Units::Us).expect("in memory"));
        let last = || Variant { name: "last.toml".to_owned(), case: variants().remove(2).case };
        all = (0..20).map(|_| last()).collect();
        let refused = line_up(&all, &(), &Uncontrolled).expect("an answer");
        assert!(!refused.is_complete() && refused.outputs.is_empty());
        assert_legible(&compare(&refused, Units::Si).expect("in memory"));
    }
}
