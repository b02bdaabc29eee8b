//! Contours over two inputs: a panel for each output, with the values on the lines.

use contour::ContourBuilder;
use plotters::prelude::{Color, LineSeries, RGBColor, Rectangle};

use super::canvas::{Area, Axes, Chart, Digits, Drawn, px, span, with_unit, write};
use super::charted::Charted;
use super::labels::{Labels, Line};

/// Approximate number of levels in a panel.
const LEVELS: f64 = 9.0;
/// Maximum number of levels, which is reached if some values are far from the others.
const MOST_LEVELS: i32 = 24;
const LINE: RGBColor = RGBColor(0, 90, 150);
const REFUSED: RGBColor = RGBColor(214, 214, 214);
const FOOT: u32 = px(34);

fn columns(sweep: &Charted<'_>) -> usize {
    sweep.outputs.len().min(2)
}

fn panel_height(sweep: &Charted<'_>) -> u32 {
    if columns(sweep) == 1 { px(560) } else { px(400) }
}

/// Returns the height of all panels.
pub fn height(sweep: &Charted<'_>) -> u32 {
    let foot = if sweep.has_refused() { FOOT } else { 0 };
    panel_height(sweep) * sweep.outputs.len().div_ceil(columns(sweep)) as u32 + foot
}

/// Draws all panels, two in each row.
pub fn draw(sweep: &Charted<'_>, area: &Area<'_>) -> Drawn {
    let rows = sweep.outputs.len().div_ceil(columns(sweep));
    let (body, foot) = area.split_vertically(panel_height(sweep) * rows as u32);
    for (at, area) in (0..sweep.outputs.len()).zip(body.split_evenly((rows, columns(sweep)))) {
        Field::of(sweep, at).draw(sweep, &area)?;
    }
    if sweep.has_refused() {
        let fine = px(1) as i32;
        foot.draw(&Rectangle::new([(16 * fine, 8 * fine), (40 * fine, 22 * fine)], REFUSED.filled()))?;
        write(&foot, "refused by the physics", 15, (48, 7))?;
    }
    Ok(())
}

/// One output on the grid, in the units of the chart.
struct Field {
    at: usize,
    /// Row by row, the first input varying fastest; NaN where refused.
    values: Vec<f64>,
    wide: usize,
    high: usize,
    /// `true` for each axis whose values decrease; the axis itself is drawn increasing.
    falls: [bool; 2],
}

impl Field {
    fn of(sweep: &Charted<'_>, at: usize) -> Field {
        let (wide, high) = (sweep.ranges[0].si.len(), sweep.ranges[1].si.len());
        let (column, conversion) = (sweep.column(at), sweep.units.conversion(sweep.outputs[at].measure()));
        let values = transposed(&column, wide, high).map(|value| conversion.of_si(value)).collect();
        let falls = [0, 1].map(|axis| sweep.ranges[axis].shown.first() > sweep.ranges[axis].shown.last());
        Field { at, values, wide, high, falls }
    }

    fn draw(&self, sweep: &Charted<'_>, area: &Area<'_>) -> Drawn {
        let output = sweep.outputs[self.at];
        let name = output.short_name();
        let (head, body) = area.split_vertically(px(26));
        write(&head, &with_unit(&name, sweep.units.unit(output.measure())), 19, (60, 6))?;
        let [x, y] = [0, 1].map(|at| span(sweep.ranges[at].shown.iter().copied(), 0.0));
        let named = |at: usize| with_unit(&sweep.ranges[at].parameter.to_string(), &sweep.ranges[at].unit);
        let axes = Axes { x, y: y.clone(), x_name: &named(0), y_name: &named(1), left: Axes::room(&y) };
        let mut chart = axes.draw(&body)?;
        let place = |(u, v): (f64, f64)| (between(&sweep.ranges[0].shown, u), between(&sweep.ranges[1].shown, v));
        self.draw_refused(&mut chart, &place)?;
        let levels = if self.is_constant() { Vec::new() } else { levels(&self.values) };
        let mut labels = Labels::default();
        let digits = Digits::of(&span(levels.iter().copied(), 0.0));
        for level in levels {
            let lines = self.lines(level)?;
            for line in &lines {
                chart.draw_series(LineSeries::new(line.iter().map(|&point| place(point)), LINE.stroke_width(px(1) * 3 / 2)))?;
            }
            labels.of(&chart, &lines, &place, &|across, up| self.is_refused(across, up), &digits.write(level));
        }
        labels.draw(&body)?;
        if self.is_constant() {
            let value = self.values.iter().copied().find(|value| value.is_finite()).unwrap_or(f64::NAN);
            let digits = Digits::of(&span(std::iter::once(value), 0.0));
            write(&body, &format!("{} everywhere", digits.write(value)), 17, (160, 120))?;
        }
        Ok(())
    }

    /// Returns `true` if the values differ only by rounding.
    fn is_constant(&self) -> bool {
        let finite = || self.values.iter().copied().filter(|value| value.is_finite());
        let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
        high - low <= 1e-11 * low.abs().max(high.abs())
    }

    /// Draws the refused points as gray cells, merging adjacent ones.
    fn draw_refused(&self, chart: &mut Chart<'_, '_>, place: &dyn Fn((f64, f64)) -> (f64, f64)) -> Drawn {
        let (right, top) = ((self.wide - 1) as f64, (self.high - 1) as f64);
        let mut cells = Vec::new();
        for (row, values) in self.values.chunks(self.wide).enumerate() {
            let mut end = 0;
            for run in values.chunk_by(|one, other| one.is_nan() == other.is_nan()) {
                let first = end;
                end += run.len();
                if run[0].is_nan() {
                    let low = ((first as f64 - 0.5).max(0.0), (row as f64 - 0.5).max(0.0));
                    let high = ((end as f64 - 0.5).min(right), (row as f64 + 0.5).min(top));
                    cells.push(Rectangle::new([place(low), place(high)], REFUSED.filled()));
                    // Overlaps the seam to the next row, which would otherwise be visible.
                    cells.push(Rectangle::new([place(low), place(high)], REFUSED.stroke_width(px(1))));
                }
            }
        }
        chart.draw_series(cells)?;
        Ok(())
    }

    /// Returns `true` if the nearest grid point is refused; the position is a fraction of each axis as drawn.
    fn is_refused(&self, across: f64, up: f64) -> bool {
        let nearest = |share: f64, size: usize, falls: bool| {
            let share = if falls { 1.0 - share } else { share };
            (share * (size - 1) as f64).round().clamp(0.0, (size - 1) as f64) as usize
        };
        let [x, y] = self.falls;
        self.values[nearest(up, self.high, y) * self.wide + nearest(across, self.wide, x)].is_nan()
    }

    /// Returns the lines of one level. They end at the edges of the grid and around refused points.
    fn lines(&self, level: f64) -> Drawn<Vec<Line>> {
        let finite: Vec<f64> = self.values.iter().copied().filter(|value| value.is_finite()).collect();
        let mean = finite.iter().sum::<f64>() / finite.len() as f64;
        // Cells with a refused corner are omitted below, so any number will do there.
        let filled: Vec<f64> = self.values.iter().map(|&value| if value.is_finite() { value } else { mean }).collect();
        let found = ContourBuilder::new(self.wide, self.high, true).lines(&filled, &[level])?;
        let mut lines: Vec<Line> = Vec::new();
        for ring in found.iter().flat_map(|line| &line.geometry().0) {
            // The crate measures coordinates from the corner of a cell, and closes its rings outside the grid.
            let points: Line = ring.coords().map(|point| (point.x - 0.5, point.y - 0.5)).collect();
            let mut line: Line = Vec::new();
            for pair in points.windows(2) {
                if self.is_inside(pair) {
                    if line.is_empty() {
                        line.push(pair[0]);
                    }
                    line.push(pair[1]);
                } else if !line.is_empty() {
                    lines.push(std::mem::take(&mut line));
                }
            }
            if !line.is_empty() {
                lines.push(line);
            }
        }
        Ok(lines)
    }

    /// Returns `true` if a line segment lies in a cell in which no corner is refused.
    fn is_inside(&self, pair: &[(f64, f64)]) -> bool {
        let middle = ((pair[0].0 + pair[1].0) / 2.0, (pair[0].1 + pair[1].1) / 2.0);
        let cell = |at: f64, size: usize| (0.0 <= at && at <= (size - 1) as f64).then(|| (at as usize).min(size - 2));
        let (Some(column), Some(row)) = (cell(middle.0, self.wide), cell(middle.1, self.high)) else { return false };
        let corners = [(0, 0), (0, 1), (1, 0), (1, 1)];
        corners.iter().all(|(i, j)| self.values[(row + j) * self.wide + column + i].is_finite())
    }
}

/// Reorders the numbers of a sweep, whose last input varies fastest, so that the first varies fastest.
fn transposed(column: &[f64], wide: usize, high: usize) -> impl Iterator<Item = f64> {
    (0..wide * high).map(move |i| column[(i % wide) * high + i / wide])
}

/// Interpolates the value of an axis between two of its values.
fn between(shown: &[f64], at: f64) -> f64 {
    let below = (at.max(0.0) as usize).min(shown.len() - 1);
    let above = (below + 1).min(shown.len() - 1);
    shown[below] + (at - below as f64) * (shown[above] - shown[below])
}

/// Returns round levels whose spacing suits most of the values: a few outliers, as near a pole, do not widen the spacing.
fn levels(values: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let quantile = |share: f64| sorted[(share * (sorted.len() - 1) as f64).round() as usize];
    let rough = match (quantile(0.95) - quantile(0.05)) / LEVELS {
        bulk if bulk > 0.0 => bulk,
        _ => (quantile(1.0) - quantile(0.0)) / LEVELS,
    };
    let power = libm::exp10(libm::log10(rough).floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|factor| factor * power).find(|&step| step >= rough / 1.2).unwrap_or(10.0 * power);
    let (first, last) = ((quantile(0.02) / step).floor(), (quantile(0.98) / step).ceil());
    // Multiplied instead of summed, so that the level zero is exact.
    (0..=MOST_LEVELS).map(|i| (first + f64::from(i)) * step).take_while(|&level| level <= last * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z = x + 10 y on 4 by 3 points.
    fn field() -> Field {
        Field {
            at: 0,
            values: (0..12).map(|i| f64::from(i % 4) + 10.0 * f64::from(i / 4)).collect(),
            wide: 4,
            high: 3,
            falls: [false, false],
        }
    }

    #[test]
    fn a_line_has_its_value_everywhere_and_ends_at_the_frame() {
        let lines = field().lines(12.0).expect("a grid");
        assert_eq!(lines.len(), 1);
        for &(x, y) in &lines[0] {
            assert!((x + 10.0 * y - 12.0).abs() < 1e-12 && (0.0..=3.0).contains(&x) && (0.0..=2.0).contains(&y), "{x} {y}");
        }
        let ends = [lines[0][0].0, lines[0][lines[0].len() - 1].0];
        assert!(ends.contains(&0.0) && ends.contains(&3.0), "{ends:?}");
    }

    #[test]
    fn a_gap_parts_the_lines() {
        let mut field = field();
        field.values[5] = f64::NAN;
        let lines = field.lines(12.0).expect("a grid");
        assert_eq!(lines.len(), 1);
        assert!(lines[0].iter().all(|point| point.0 >= 2.0), "nothing touches the gap: {lines:?}");
        assert!(!field.is_constant());
        assert!(field.is_refused(0.35, 0.5) && !field.is_refused(0.65, 0.5));
        field.falls[0] = true;
        assert!(field.is_refused(0.65, 0.5) && !field.is_refused(0.35, 0.5));
    }

    #[test]
    fn rows_become_columns() {
        let swept: Vec<f64> = (0..4).flat_map(|x| (0..3).map(move |y| f64::from(x) + 10.0 * f64::from(y))).collect();
        assert_eq!(transposed(&swept, 4, 3).collect::<Vec<_>>(), field().values);
    }

    #[test]
    fn levels_are_round() {
        let even = |low: i32, high: i32| (0..=100).map(|i| f64::from(low) + f64::from((high - low) * i) / 100.0).collect::<Vec<f64>>();
        assert_eq!(levels(&even(0, 10)), (0..=10).map(f64::from).collect::<Vec<f64>>());
        assert_eq!(levels(&even(-41_000, -22_000))[..3], [-42_000.0, -40_000.0, -38_000.0]);
        let mut pole = even(0, 10);
        pole[0] = -1e6;
        pole.push(f64::NAN);
        assert!(levels(&pole).len() < 14, "one value far out does not spread the levels");
        assert_eq!(
            levels(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0]).len(),
            10
        );
        assert_eq!(between(&[10.0, 20.0, 40.0], 1.5), 30.0);
        assert_eq!(between(&[10.0, 20.0, 40.0], 2.0), 40.0);
    }
}
