//! Lines over one input: a panel for each kind of quantity, lines distinguished by their dashes.

use std::ops::Range as Span;

use plotters::coord::CoordTranslate;
use plotters::prelude::{Circle, Color, Cross, DrawingArea, SVGBackend, TriangleMarker};

use super::canvas::{Area, Axes, BLUE, Chart, DARK, Drawn, GREEN, Stroke, VERMILION, WIDTH, px, span, with_unit, write};
use super::charted::Charted;
use planar_impact_app::sweep::Range;
use planar_impact_app::units::Measure;

pub(super) const PANEL: u32 = px(300);
pub(super) const LEGEND: u32 = px(190);
/// Number of lines that dashes can distinguish.
pub(super) const LINES: usize = 4;
/// A line with more points is thinned, because a pixel shows only its extremes.
const FINEST: usize = 4000;

/// Styles that remain distinct without color.
const STYLES: [Stroke; LINES] =
    [Stroke::solid(BLUE, 2), Stroke::dashed(VERMILION, 2, 12, 5), Stroke::dashed(GREEN, 2, 3, 4), Stroke::dashed(DARK, 2, 24, 6)];

/// Returns the input along x.
fn range<'a>(sweep: &'a Charted<'_>) -> &'a Range {
    sweep.ranges.iter().find(|range| range.si.len() > 1).unwrap_or(&sweep.ranges[0])
}

/// The lines of one panel, by the indices of the outputs.
struct Panel {
    measure: Measure,
    outputs: Vec<usize>,
}

fn panels(sweep: &Charted<'_>) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for (at, output) in sweep.outputs.iter().enumerate() {
        let measure = output.measure();
        match panels.iter_mut().find(|panel| panel.measure == measure && panel.outputs.len() < LINES) {
            Some(panel) => panel.outputs.push(at),
            None => panels.push(Panel { measure, outputs: vec![at] }),
        }
    }
    panels
}

/// Returns the height of all panels.
pub fn height(sweep: &Charted<'_>) -> u32 {
    PANEL * panels(sweep).len() as u32
}

/// Draws all panels in one column.
pub fn draw(sweep: &Charted<'_>, area: &Area<'_>) -> Drawn {
    let panels = panels(sweep);
    // One width for all, so that the panels are aligned.
    let left = panels.iter().map(|panel| Axes::room(&panel.span(sweep))).max().unwrap_or(0);
    for (panel, area) in panels.iter().zip(area.split_evenly((panels.len(), 1))) {
        let (plot, legend) = area.split_horizontally(WIDTH - LEGEND);
        panel.draw(sweep, &plot, left)?;
        panel.legend(sweep, &legend)?;
    }
    Ok(())
}

impl Panel {
    /// Returns the lines in the units of the chart.
    fn lines(&self, sweep: &Charted<'_>) -> Vec<Vec<f64>> {
        let conversion = sweep.units.conversion(self.measure);
        self.outputs.iter().map(|&at| sweep.column(at).iter().map(|&value| conversion.of_si(value)).collect()).collect()
    }

    fn span(&self, sweep: &Charted<'_>) -> Span<f64> {
        span(self.lines(sweep).iter().flatten().copied(), 0.06)
    }

    fn draw(&self, sweep: &Charted<'_>, area: &Area<'_>, left: u32) -> Drawn {
        let (range, lines) = (range(sweep), self.lines(sweep));
        let unit = sweep.units.unit(self.measure);
        let y_name = match self.outputs[..] {
            [only] => sweep.outputs[only].short_name(),
            _ => noun(self.measure).to_owned(),
        };
        let axes = Axes {
            x: span(range.shown.iter().copied(), 0.0),
            y: self.span(sweep),
            x_name: &with_unit(&range.parameter.to_string(), &range.unit),
            y_name: &with_unit(&y_name, unit),
            left,
        };
        let mut chart = axes.draw(area)?;
        for (i, line) in lines.iter().enumerate() {
            for run in runs(&range.shown, line) {
                draw_run(&mut chart, &thinned(run), i)?;
            }
        }
        Ok(())
    }

    /// Draws a sample of each line with its name, beside the panel where there is free space.
    fn legend(&self, sweep: &Charted<'_>, area: &Area<'_>) -> Drawn {
        let mut rows = 0;
        for (i, &at) in self.outputs.iter().enumerate() {
            let (y, output) = (row_of(i, rows), sweep.outputs[at]);
            rows += sample(area, i, rows, &output.short_name())?;
            if runs(&range(sweep).shown, &sweep.column(at)).any(|run| run.len() == 1) {
                draw_marker(area, (px(28) as i32, y * px(1) as i32), i)?;
            }
        }
        Ok(())
    }
}

/// Returns the height of a sample in a legend, below rows of text.
pub(super) fn row_of(line: usize, rows: i32) -> i32 {
    30 + rows * 16 + 10 * line as i32
}

/// Draws a sample of a line with its name below rows of text; returns the number of rows of its name.
pub(super) fn sample(area: &Area<'_>, line: usize, rows: i32, name: &str) -> Drawn<i32> {
    sample_of(area, STYLES[line], row_of(line, rows), name)
}

/// Draws a sample of a line with its name at a height; returns the number of rows of its name.
pub(super) fn sample_of(area: &Area<'_>, stroke: Stroke, y: i32, name: &str) -> Drawn<i32> {
    stroke.sample(area, 8, 48, y)?;
    let parts = wrapped(name);
    for (row, part) in parts.iter().enumerate() {
        write(area, part, 17, (56, y - 8 + 16 * row as i32))?;
    }
    Ok(parts.len() as i32)
}

/// Splits a long dotted name into parts that fit beside its sample.
fn wrapped(name: &str) -> Vec<String> {
    let mut parts: Vec<String> = vec![String::new()];
    for piece in name.split_inclusive(['.', '_', ' ']) {
        match parts.last_mut() {
            Some(last) if last.chars().count() + piece.chars().count() <= 15 => last.push_str(piece),
            _ => parts.push(piece.to_owned()),
        }
    }
    parts
}

pub(super) fn draw_run(chart: &mut Chart<'_, '_>, run: &[(f64, f64)], line: usize) -> Drawn {
    match run {
        [] => Ok(()),
        // A point between two gaps is not a line, but must be visible.
        [only] => draw_marker(chart.plotting_area(), *only, line),
        run => STYLES[line].line(chart, run.iter().copied()),
    }
}

/// Draws an isolated point with a different shape for each line: a disk, a triangle, a cross, a ring.
fn draw_marker<C: CoordTranslate>(area: &DrawingArea<SVGBackend<'_>, C>, at: C::From, line: usize) -> Drawn
where
    C::From: Clone,
{
    let color = STYLES[line].color;
    match line {
        0 => area.draw(&Circle::new(at, px(4), color.filled()))?,
        1 => area.draw(&TriangleMarker::new(at, px(5), color.filled()))?,
        2 => area.draw(&Cross::new(at, px(4), color.stroke_width(px(2))))?,
        _ => area.draw(&Circle::new(at, px(4), color.stroke_width(px(2))))?,
    }
    Ok(())
}

/// Returns the sections of a line between its gaps.
fn runs<'a>(x: &'a [f64], y: &'a [f64]) -> impl Iterator<Item = Vec<(f64, f64)>> + 'a {
    let points: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let runs: Vec<Vec<(f64, f64)>> = points.split(|point| !point.1.is_finite()).filter(|run| !run.is_empty()).map(<[_]>::to_vec).collect();
    runs.into_iter()
}

/// Thins a line for the screen: keeps the ends and the extremes of each of a thousand sections.
pub(super) fn thinned(run: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if run.len() <= FINEST {
        return run;
    }
    let mut kept = Vec::with_capacity(FINEST + 4);
    for stretch in run.chunks(run.len().div_ceil(FINEST / 4)) {
        let by =
            |less: fn(f64, f64) -> bool| (1..stretch.len()).fold(0, |best, i| if less(stretch[i].1, stretch[best].1) { i } else { best });
        let mut places = [0, by(|a, b| a < b), by(|a, b| a > b), stretch.len() - 1];
        places.sort_unstable();
        kept.extend(places.iter().enumerate().filter(|&(i, place)| i == 0 || *place != places[i - 1]).map(|(_, &place)| stretch[place]));
    }
    kept
}

/// Returns the quantity of a measure.
fn noun(measure: Measure) -> &'static str {
    match measure {
        Measure::Speed | Measure::RoadSpeed => "velocity",
        Measure::RootForce => "root of force",
        Measure::RootForcePerLength => "root of force per length",
        Measure::MomentImpulse => "moment impulse",
        Measure::YawRate => "yaw rate",
        Measure::YawInertia => "yaw inertia",
        Measure::ForcePerWidth => "force per width",
        Measure::ForcePerArea => "force per area",
        other => other.name(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_part_a_line() {
        let found: Vec<_> = runs(&[0.0, 1.0, 2.0, 3.0, 4.0], &[1.0, 2.0, f64::NAN, 3.0, f64::NAN]).collect();
        assert_eq!(found, [vec![(0.0, 1.0), (1.0, 2.0)], vec![(3.0, 3.0)]]);
    }

    #[test]
    fn thinning_keeps_the_ends_and_the_extremes() {
        let line: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), if i == 54_321 { 9.0 } else { f64::from(i % 2) })).collect();
        let thin = thinned(line.clone());
        assert!(thin.len() <= FINEST && thin.contains(&(54_321.0, 9.0)), "{}", thin.len());
        assert_eq!((thin[0], thin[thin.len() - 1]), (line[0], line[99_999]));
        assert!(thin.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(thinned(line[..100].to_vec()), line[..100]);
    }

    #[test]
    fn long_names_are_broken_at_their_dots() {
        assert_eq!(wrapped("W_n"), ["W_n"]);
        assert_eq!(wrapped("vehicle.1.equivalent_energy_speed"), ["vehicle.1.", "equivalent_", "energy_speed"]);
    }
}
