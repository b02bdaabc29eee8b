//! Rows of intervals over one axis, each with its name before it and its numbers behind it.

use plotters::prelude::{Circle, Color, PathElement, RGBColor, Rectangle, ShapeStyle};

use planar_impact_app::case::CaseOutput;
use planar_impact_app::uncertainty::OutputUncertainty;
use planar_impact_app::units::Units;

use super::super::canvas::{Area, Axes, BLUE, Drawn, GRAY, VERMILION, WIDTH, px, span, write};
use crate::page::uncertainty::{quantity, range_ends, skewness};

/// Height of a row, in pixels.
const ROW: u32 = 24;
/// Height of the axis with its name and the margins, in pixels.
const AXIS: u32 = 68;
/// Width of the names of the rows, in pixels.
const NAMES: u32 = 128;
/// Width of their numbers.
const NUMBERS: u32 = px(300);
/// Half the height of a bar, in rows.
const HALF: f64 = 0.18;

/// An interval of an output, in the reader's units.
pub(super) struct Interval {
    name: &'static str,
    /// Infinite where it has no end.
    ends: [f64; 2],
    /// A value within it.
    mark: Option<f64>,
    numbers: String,
    style: Style,
}

/// What an interval is drawn as.
enum Style {
    /// A line between the values that a deviation reaches.
    Line(RGBColor),
    /// A bar.
    Bar(f64),
    /// A value alone, with a line through the other rows.
    Through,
}

/// The rows of an output.
pub(super) struct Rows<'a> {
    pub(super) of: CaseOutput,
    pub(super) found: &'a OutputUncertainty,
    pub(super) units: Units,
}

impl Rows<'_> {
    fn quantity(&self, si: f64) -> String {
        quantity(self.found, self.units, self.of.measure(), si)
    }

    fn row(&self, name: &'static str, ends: [f64; 2], mark: Option<f64>, numbers: String, style: Style) -> Interval {
        let convert = |si: f64| self.units.convert(self.of.measure(), si);
        Interval { name, ends: ends.map(convert), mark: mark.map(convert), numbers, style }
    }

    /// Returns the mean with a deviation on both sides by each method that has them.
    pub(super) fn methods(&self) -> Vec<Interval> {
        let OutputUncertainty { linear, second_order, monte_carlo, .. } = self.found;
        let found = [
            linear.as_ref().map(|found| ("linear", found.mean, found.sd, None, VERMILION)),
            second_order.as_ref().map(|found| ("second order", found.mean, found.sd, Some(found.skewness), GRAY)),
            monte_carlo.as_ref().map(|found| ("samples", found.mean, found.sd, Some(found.skewness), BLUE)),
        ];
        let row = |(name, mean, sd, skewed, color): (_, f64, f64, Option<f64>, _)| {
            let skewed = skewed.map_or_else(String::new, |value| format!("; skewness {}", skewness(value)));
            let numbers = format!("{} ± {}{skewed}", self.quantity(mean), self.quantity(sd));
            self.row(name, [mean - sd, mean + sd], Some(mean), numbers, Style::Line(color))
        };
        found.into_iter().flatten().filter(|(_, mean, sd, ..)| (mean + sd).is_finite()).map(row).collect()
    }

    /// Returns the guaranteed range with the values found in it and the nominal value.
    pub(super) fn range(&self) -> Vec<Interval> {
        let Some(bounds) = &self.found.bounds else { return Vec::new() };
        let [of_proven, of_found] = range_ends(bounds, self.of.measure(), self.units).map(|[low, high]| format!("{low} to {high}"));
        let (proven, found) = ([bounds.low, bounds.high], [bounds.low_attained, bounds.high_attained]);
        let value = self.found.value;
        let mut rows = vec![
            self.row("guaranteed", proven, None, of_proven, Style::Bar(0.35)),
            self.row("attained", found, None, of_found, Style::Bar(1.0)),
        ];
        if value.is_finite() {
            rows.push(self.row("nominal", [value; 2], Some(value), self.quantity(value), Style::Through));
        }
        rows
    }
}

/// Returns the height of a chart of so many rows.
pub(super) fn height(rows: &[Interval]) -> u32 {
    px(ROW * rows.len() as u32 + AXIS)
}

/// Draws rows over an axis with a name.
pub(super) fn draw(area: &Area<'_>, rows: &[Interval], name: &str) -> Drawn {
    let (left, right) = area.split_horizontally(WIDTH - NUMBERS);
    let x = span(rows.iter().flat_map(|row| row.ends.into_iter().chain(row.mark)), 0.06);
    let count = rows.len() as f64;
    let axes = Axes { x: x.clone(), y: 0.0..count, x_name: name, y_name: "", left: NAMES };
    let mut chart = axes.draw(&left)?;
    for (place, row) in rows.iter().enumerate() {
        let y = count - place as f64 - 0.5;
        // What has no end goes on to the edge.
        let [low, high] = row.ends.map(|end| end.clamp(x.start, x.end));
        match row.style {
            Style::Line(color) => {
                let line = |from: (f64, f64), to: (f64, f64)| PathElement::new([from, to], ShapeStyle::from(&color).stroke_width(px(2)));
                chart.draw_series([line((low, y), (high, y))])?;
                chart.draw_series([low, high].map(|end| line((end, y - HALF), (end, y + HALF))))?;
            }
            Style::Bar(opacity) => {
                let ends = if low < high { [low, high] } else { [high, low] };
                chart.draw_series([Rectangle::new([(ends[0], y - HALF), (ends[1], y + HALF)], BLUE.mix(opacity).filled())])?;
            }
            Style::Through => {
                chart.draw_series([PathElement::new([(low, y), (low, count)], ShapeStyle::from(&VERMILION).stroke_width(px(1)))])?;
            }
        }
        let color = if let Style::Line(color) = row.style { color } else { VERMILION };
        chart.draw_series(row.mark.map(|mark| Circle::new((mark, y), px(4), color.filled())))?;
        let top = 12 + ROW as i32 * place as i32 + 5;
        write(area, row.name, 14, (16, top))?;
        write(&right, &row.numbers, 14, (0, top))?;
    }
    Ok(())
}
