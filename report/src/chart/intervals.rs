//! The unknowns of a reconstruction and what follows from them: estimates, intervals, bounds, and where it is drawn the posterior.

use planar_impact_app::issue::Issues;
use planar_impact_app::reconstruct::{Estimated, Interval, Posterior, Reconstruction};
use planar_impact_app::units::{Measure, beyond_rounding};
use planar_impact_app::{Answer, Units};
use plotters::prelude::{Circle, Color, PathElement, Polygon, RGBColor, ShapeStyle, WHITE};
use plotters::style::text_anchor::VPos;

use super::canvas::{Area, BLUE, DARK, Drawn, GRID, VERMILION, Writing, page, px, rectangle, segment, write};
use crate::page::uncertainty::with_digits;

/// Height of a row and of the legend, in pixels.
const ROW: i32 = 40;
const FOOT: i32 = 66;
/// Right edge of the names, and the ends of the longest interval.
const NAMES: i32 = 300;
const LEFT: i32 = 320;
const RIGHT: i32 = 610;
/// Left edge of the numbers.
const NUMBERS: i32 = 626;
/// Most characters of the numbers.
const LONGEST: usize = 42;

/// Draws the estimate of each unknown, and of what follows from them, with its interval and its bounds; each on a scale of its own.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn intervals(answer: &Answer<Reconstruction>, units: Units) -> Result<String, Issues> {
    let rows = rows(answer);
    let level = rows.first().map_or(0.95, |row| row.interval.level);
    let words: Vec<String> = rows.iter().map(|row| format!("{} {}", row.name, row.numbers(units))).collect();
    let description = format!("Intervals at {} % by profile likelihood: {}.", percent(level), words.join("; "));
    let title = if answer.title.is_empty() { "Intervals".to_owned() } else { format!("Intervals: {}", answer.title) };
    page(&title, &description, px((ROW * rows.len() as i32 + FOOT) as u32), |area| {
        for (place, row) in rows.iter().enumerate() {
            row.draw(area, units, ROW * place as i32)?;
        }
        legend(area, level, rows.iter().any(|row| row.posterior.is_some()), ROW * rows.len() as i32)
    })
}

fn percent(level: f64) -> String {
    planar_impact_app::units::trim(100.0 * level)
}

/// A quantity with what is known of it, in SI.
struct Row<'a> {
    name: &'a str,
    measure: Measure,
    value: Option<f64>,
    interval: &'a Interval,
    /// Its bounds in the file.
    bounds: [Option<f64>; 2],
    posterior: Option<&'a Posterior>,
}

fn rows<'a>(answer: &'a Reconstruction) -> Vec<Row<'a>> {
    let row = |of: Estimated<'a>| {
        let Estimated { name, measure, value, interval, bounds, posterior, .. } = of;
        let scale = answer.solution.as_ref().map_or(0.0, |solution| solution.facts.scale(measure));
        Row { name, measure, value: value.map(|value| beyond_rounding(value, scale)), interval, bounds, posterior }
    };
    answer.estimates().map(row).collect()
}

impl Row<'_> {
    /// Returns the values that the row shows.
    fn values(&self) -> impl Iterator<Item = f64> + '_ {
        let of_posterior = self.posterior.iter().flat_map(|posterior| posterior.hdi.into_iter().chain([posterior.median]));
        [self.value, self.interval.low, self.interval.high].into_iter().flatten().chain(of_posterior)
    }

    /// Returns the ends of the scale: around what is known, without bounds that are far from it.
    fn scale(&self) -> [f64; 2] {
        let (low, high) = self.values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            let [min, max] = self.bounds;
            return [min.unwrap_or(-1.0), max.unwrap_or_else(|| min.unwrap_or(-1.0) + 2.0)];
        }
        let half = if high > low { 0.0 } else { 0.05 * high.abs() + f64::MIN_POSITIVE };
        let (low, high) = (low - half, high + half);
        // A bound nearer than the length of the interval is shown.
        let near = |bound: Option<f64>| bound.filter(|bound| (low - (high - low)..=high + (high - low)).contains(bound));
        let ends = self.bounds.map(near);
        [ends[0].map_or(low, |min| min.min(low)), ends[1].map_or(high, |max| max.max(high))]
    }

    /// Returns the place of a value between the ends of the scale, which are 0 and 1.
    fn share(&self, si: f64) -> f64 {
        let [low, high] = self.scale();
        if high > low { (si - low) / (high - low) } else { 0.5 }
    }

    /// Returns `true` if the width of the interval is but the tolerance of exact evidence.
    fn is_exact(&self) -> bool {
        /// Share of the value that is tolerance.
        const EXACT: f64 = 1e-5;
        let width = self.interval.low.zip(self.interval.high).map(|(low, high)| high - low);
        width.zip(self.value).is_some_and(|(width, value)| width <= EXACT * value.abs())
    }

    /// Returns the interval in words.
    fn numbers(&self, units: Units) -> String {
        if let Some(value) = self.value.filter(|_| self.is_exact()) {
            return format!("{} (exact)", units.quantity(self.measure, value));
        }
        let Interval { low, high, .. } = *self.interval;
        let width = low.zip(high).map_or_else(|| self.value.unwrap_or(0.0).abs(), |(low, high)| high - low);
        let text = self.numbers_as(units, &|si| with_digits(units, self.measure, si, 0.25 * width));
        // Of a narrow interval its digits do not fit.
        if text.chars().count() <= LONGEST { text } else { self.numbers_as(units, &|si| units.number(self.measure, si, 0.0)) }
    }

    fn numbers_as(&self, units: Units, number: &dyn Fn(f64) -> String) -> String {
        let Interval { low, high, .. } = *self.interval;
        let end = |end: Option<f64>, none: &str| end.map_or_else(|| none.to_owned(), number);
        let unit = units.unit(self.measure);
        let value = self.value.map_or_else(|| "open".to_owned(), number);
        format!("{value} ({} to {}) {unit}", end(low, "−∞"), end(high, "∞")).trim_end().to_owned()
    }

    fn draw(&self, area: &Area<'_>, units: Units, top: i32) -> Drawn {
        let middle = top + ROW / 2;
        let [low, high] = self.scale();
        let across = |si: f64| LEFT + (f64::from(RIGHT - LEFT) * self.share(si).clamp(0.0, 1.0)).round() as i32;
        Writing { down: VPos::Center, ..Writing::ending() }.write(area, self.name, (NAMES, middle))?;
        Writing { down: VPos::Center, ..Writing::default() }.write(area, &self.numbers(units), (NUMBERS, middle))?;
        rectangle(area, (LEFT, middle - 1), (RIGHT, middle + 1), GRID.filled())?;
        for bound in self.bounds.into_iter().flatten().filter(|bound| (low..=high).contains(bound)) {
            let x = across(bound);
            segment(area, (x, middle - 11), (x, middle + 11), DARK.stroke_width(px(3)))?;
        }
        let style = |color: RGBColor, width: u32| ShapeStyle::from(&color).stroke_width(px(width));
        if !self.is_exact() {
            let ends = [self.interval.low.map_or(LEFT, across), self.interval.high.map_or(RIGHT, across)];
            segment(area, (ends[0], middle), (ends[1], middle), style(BLUE, 4))?;
            let limits = [&self.interval.low_limited_by, &self.interval.high_limited_by];
            let is_open = [self.interval.low.is_none(), self.interval.high.is_none()];
            for (i, sign) in [(0, 1), (1, -1)] {
                if is_open[i] {
                    arrow(area, (ends[i], middle), sign)?;
                } else if limits[i].is_some() {
                    rectangle(area, (ends[i] - 4, middle - 4), (ends[i] + 4, middle + 4), BLUE.filled())?;
                } else {
                    segment(area, (ends[i], middle - 7), (ends[i], middle + 7), style(BLUE, 2))?;
                }
            }
        }
        if let Some(posterior) = self.posterior {
            let y = middle + 13;
            segment(area, (across(posterior.hdi[0]), y), (across(posterior.hdi[1]), y), style(VERMILION, 2))?;
            diamond(area, (across(posterior.median), y))?;
        }
        if let Some(value) = self.value {
            dot(area, (across(value), middle))?;
        }
        Ok(())
    }
}

fn dot(area: &Area<'_>, at: (i32, i32)) -> Drawn {
    let fine = px(1) as i32;
    let at = (fine * at.0, fine * at.1);
    area.draw(&Circle::new(at, px(6), WHITE.filled()))?;
    area.draw(&Circle::new(at, px(6), DARK.stroke_width(px(2))))?;
    Ok(())
}

fn diamond(area: &Area<'_>, (x, y): (i32, i32)) -> Drawn {
    let fine = px(1) as i32;
    let corners = [(x - 5, y), (x, y - 5), (x + 5, y), (x, y + 5)].map(|(x, y)| (fine * x, fine * y));
    area.draw(&Polygon::new(corners, VERMILION.filled()))?;
    Ok(())
}

/// Draws the head of an arrow that points against `sign`.
fn arrow(area: &Area<'_>, (x, y): (i32, i32), sign: i32) -> Drawn {
    let fine = px(1) as i32;
    let points = [(x + 9 * sign, y - 7), (x, y), (x + 9 * sign, y + 7)].map(|(x, y)| (fine * x, fine * y));
    area.draw(&PathElement::new(points, ShapeStyle::from(&BLUE).stroke_width(px(2))))?;
    Ok(())
}

fn legend(area: &Area<'_>, level: f64, has_posterior: bool, top: i32) -> Drawn {
    let style = |color: RGBColor, width: u32| ShapeStyle::from(&color).stroke_width(px(width));
    let first = top + 22;
    dot(area, (26, first))?;
    write(area, "best fit", 14, (44, first - 7))?;
    segment(area, (120, first), (156, first), style(BLUE, 4))?;
    write(area, &format!("interval at {} % by profile likelihood", percent(level)), 14, (166, first - 7))?;
    segment(area, (440, first - 9), (440, first + 9), style(DARK, 3))?;
    write(area, "bound of the file", 14, (452, first - 7))?;
    rectangle(area, (590, first - 4), (598, first + 4), BLUE.filled())?;
    write(area, "end set by a bound or by physics", 14, (606, first - 7))?;
    if has_posterior {
        let second = top + 48;
        segment(area, (16, second), (52, second), style(VERMILION, 2))?;
        diamond(area, (34, second))?;
        write(area, &format!("posterior: median, shortest range of {} %", percent(level)), 14, (62, second - 7))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, reconstructed, size, texts};
    use super::*;
    use planar_impact_app::reconstruct::Options;

    /// A row for each quantity, and a foot for the legend, which is the last that is written.
    #[test]
    fn a_chart_is_as_high_as_its_rows() {
        let answer = reconstructed(include_str!("../../../cli/examples/reconstruct/position-a.toml"), Options::default());
        let svg = intervals(&answer, Units::Si).expect("in memory");
        let height = size(&svg, "height");
        let last = texts(&svg).iter().map(|text| text.y[1]).fold(0.0, f64::max);
        assert!(last < height && height - last < f64::from(FOOT), "{last} of {height}");
    }

    #[test]
    fn everything_known_is_on_the_scale_in_its_order() {
        let mut random = Random::new(7);
        for i in 0..500 {
            let mut known: Vec<f64> = (0..3).map(|_| random.between(-50.0, 50.0)).collect();
            known.sort_by(f64::total_cmp);
            let (open, far) = (i % 5 == 0, random.between(0.0, 500.0));
            let interval = Interval {
                level: 0.95,
                low: Some(known[0]),
                high: (!open).then_some(known[2]),
                method: "profile",
                low_limited_by: None,
                high_limited_by: None,
                narrows: true,
            };
            let bounds = [Some(known[0] - far), (i % 3 == 0).then_some(known[2] + far)];
            let row = Row { name: "x", measure: Measure::Ratio, value: Some(known[1]), interval: &interval, bounds, posterior: None };
            let shown: Vec<f64> = row.values().map(|value| row.share(value)).collect();
            assert!(shown.iter().all(|share| (-1e-12..=1.0 + 1e-12).contains(share)), "{shown:?}");
            assert!(row.share(known[0]) <= row.share(known[1]) && (open || row.share(known[1]) <= row.share(known[2])));
            // A near bound is on the scale, and a far one does not squeeze the interval into less than a third.
            assert!(open || row.share(known[2]) - row.share(known[0]) > 0.33);
            let is_near = !open && far <= known[2] - known[0];
            assert!(!is_near || bounds.into_iter().flatten().all(|bound| (-1e-12..=1.0 + 1e-12).contains(&row.share(bound))), "{bounds:?}");
        }
    }

    /// A value without a width has a twentieth on either side, and a bound is shown that is nearer than the length of the interval.
    #[test]
    fn scales_reach_to_near_bounds() {
        let scale = |[low, high]: [f64; 2], min: Option<f64>| {
            let interval = Interval {
                level: 0.95,
                low: Some(low),
                high: Some(high),
                method: "profile",
                low_limited_by: None,
                high_limited_by: None,
                narrows: true,
            };
            Row { name: "x", measure: Measure::Ratio, value: Some(low), interval: &interval, bounds: [min, None], posterior: None }.scale()
        };
        assert_eq!(scale([10.0, 10.0], None), [9.5, 10.5]);
        assert_eq!(scale([8.0, 12.0], None), [8.0, 12.0]);
        assert_eq!(scale([8.0, 12.0], Some(5.0)), [5.0, 12.0]);
        assert_eq!(scale([8.0, 12.0], Some(3.0)), [8.0, 12.0]);
    }
}
