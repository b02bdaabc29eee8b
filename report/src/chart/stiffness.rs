//! The fit of crush stiffness: E* of each test over the crush, with the fitted lines and their band.

use planar_impact_app::issue::Issues;
use planar_impact_app::stiffness::{Fit, LinePoint, StiffnessAnswer, Test};
use planar_impact_app::units::Measure;
use planar_impact_app::{Answer, Units};
use plotters::coord::CoordTranslate;
use plotters::prelude::{Circle, Color, Cross, DrawingArea, Polygon, SVGBackend, TriangleMarker};

use super::canvas::{Area, Axes, BLUE, DARK, Drawn, GREEN, Stroke, VERMILION, WIDTH, page, px, rectangle, span, with_unit, write};
use planar_impact_app::plain_text::shorten;

const PANEL: u32 = px(430);
const LEGEND: u32 = px(250);
/// Lines of the fits on mean depths and on profiles.
const LINES: [Stroke; 2] = [Stroke::solid(BLUE, 2), Stroke::dashed(VERMILION, 2, 12, 5)];
/// Line of a stiffness from one test and the assumed onset.
const ALONE: Stroke = Stroke::dashed(GREEN, 2, 3, 4);
/// Number of vehicles that the legend names.
const MOST_NAMES: usize = 12;
/// Largest width of a name, in columns.
const NAME_WIDTH: usize = 24;

/// Draws E* of each test over its mean crush, with the fitted lines, and the band of one standard deviation of the first. Fits of tests as those of new cars have a
/// panel of their own.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn stiffness(answer: &Answer<StiffnessAnswer>, units: Units) -> Result<String, Issues> {
    let panels = panels(answer);
    let words = |panel: &Panel<'_>| {
        let of = |fit: &Fit| {
            let number = |measure, value| units.quantity(measure, value);
            let (d0, d1) = (number(Measure::RootForce, fit.forms.d0), number(Measure::RootForcePerLength, fit.forms.d1));
            format!("on {} d0 = {d0}, d1 = {d1}", fit.model)
        };
        panel.fits.iter().map(of).collect::<Vec<_>>().join("; ")
    };
    let description = format!(
        "Crush intensity of {} tests over mean crush, with the fitted lines. {}",
        answer.tests.len(),
        panels.iter().map(words).collect::<Vec<_>>().join("; ")
    );
    let title = if answer.title.is_empty() { "Stiffness".to_owned() } else { format!("Stiffness: {}", answer.title) };
    page(&title, &description, PANEL * panels.len() as u32, |area| {
        for (panel, area) in panels.iter().zip(area.split_evenly((panels.len(), 1))) {
            panel.draw(&area, units)?;
        }
        Ok(())
    })
}

/// A chart of one set of fits.
struct Panel<'a> {
    head: &'static str,
    fits: &'a [Fit],
    /// For each test its vehicle's place in `names`, its mean depth and its E*, in SI.
    points: Vec<(usize, f64, f64)>,
    /// The stiffness from the mean depth of a test alone: from its E* without crush to the test, in SI.
    alone: Vec<[(f64, f64); 2]>,
    names: Vec<&'a str>,
}

fn panels(answer: &StiffnessAnswer) -> Vec<Panel<'_>> {
    let mut names: Vec<&str> = Vec::new();
    let mut vehicles = Vec::new();
    for test in &answer.tests {
        let place = names.iter().position(|name| *name == test.vehicle).unwrap_or(names.len());
        if place == names.len() {
            names.push(&test.vehicle);
        }
        vehicles.push(place);
    }
    let panel = |head, fits: &'_ [Fit]| {
        // A fit of tests as those of new cars has other values of E* than the tests in their order.
        let observed =
            |i: usize| fits.first().and_then(|fit| fit.residuals.get(i)).map_or(answer.tests[i].crush_intensity, |of| of.observed);
        let points = vehicles.iter().enumerate().map(|(i, vehicle)| (*vehicle, answer.tests[i].mean_depth, observed(i))).collect();
        (head, points)
    };
    let mut all = Vec::new();
    for (head, fits) in [("", &answer.fits), ("as new cars", &answer.fits_as_new_cars)] {
        if head.is_empty() || !fits.is_empty() {
            let (head, points) = panel(head, fits);
            let of_test = |test: &Test| Some([(0.0, test.on_mean_depth.as_ref()?.d0), (test.mean_depth, test.crush_intensity)]);
            let alone = answer.tests.iter().filter_map(of_test).filter(|_| head.is_empty()).collect();
            all.push(Panel { head, fits, points, alone, names: names.clone() });
        }
    }
    all
}

impl Panel<'_> {
    fn draw(&self, area: &Area<'_>, units: Units) -> Drawn {
        let (depth, root) = (units.conversion(Measure::Length), units.conversion(Measure::RootForce));
        let shown = |at: (f64, f64)| (depth.of_si(at.0), root.of_si(at.1));
        let lines: Vec<Vec<(f64, f64)>> =
            self.fits.iter().map(|fit| fit.line.iter().map(|of| shown((of.depth, of.crush_intensity))).collect()).collect();
        let band: Vec<(f64, f64)> = self.fits.first().map_or_else(Vec::new, |fit| edge(&fit.line)).into_iter().map(shown).collect();
        let points: Vec<(usize, (f64, f64))> = self.points.iter().map(|&(vehicle, depth, root)| (vehicle, shown((depth, root)))).collect();
        let alone: Vec<[(f64, f64); 2]> = self.alone.iter().map(|ends| ends.map(shown)).collect();
        let all = || {
            lines
                .iter()
                .flatten()
                .chain(&band)
                .copied()
                .chain(points.iter().map(|(_, at)| *at))
                .chain([(0.0, 0.0)])
                .chain(alone.iter().flatten().copied())
        };
        let (x, y) = (span(all().map(|at| at.0), 0.0), span(all().map(|at| at.1), 0.05));
        let (plot, legend) = area.split_horizontally(WIDTH - LEGEND);
        let names = [("mean residual crush C", Measure::Length), ("crush intensity E*", Measure::RootForce)];
        let [x_name, y_name] = names.map(|(name, measure)| with_unit(name, units.unit(measure)));
        let end = 1.03 * x.end;
        let axes = Axes { x: x.start..end, left: Axes::room(&y), y, x_name: &x_name, y_name: &y_name };
        let mut chart = axes.draw(&plot)?;
        if !band.is_empty() {
            chart.draw_series([Polygon::new(band.clone(), BLUE.mix(0.18))])?;
        }
        for ends in alone.iter().copied() {
            ALONE.line(&mut chart, ends)?;
        }
        for (line, stroke) in lines.iter().cloned().zip(LINES) {
            stroke.line(&mut chart, line)?;
        }
        for (vehicle, at) in points {
            marker(chart.plotting_area(), at, vehicle)?;
        }
        self.legend(&legend, !band.is_empty())
    }

    fn legend(&self, area: &Area<'_>, has_band: bool) -> Drawn {
        let fine = px(1) as i32;
        let mut y = 26;
        if !self.head.is_empty() {
            write(area, self.head, 16, (4, y - 8))?;
            y += 26;
        }
        for (fit, stroke) in self.fits.iter().zip(LINES) {
            stroke.sample(area, 4, 44, y)?;
            write(area, &format!("fitted on {}", fit.model), 15, (54, y - 7))?;
            y += 26;
        }
        if !self.alone.is_empty() {
            ALONE.sample(area, 4, 44, y)?;
            write(area, "from one test, b0 assumed", 15, (54, y - 7))?;
            y += 26;
        }
        if has_band {
            rectangle(area, (4, y - 7), (44, y + 7), BLUE.mix(0.18).filled())?;
            write(area, &format!("± 1 sd, on {}", self.fits[0].model), 15, (54, y - 7))?;
            y += 26;
        }
        y += 8;
        for (vehicle, name) in self.names.iter().take(MOST_NAMES).enumerate() {
            marker(area, (fine * 24, fine * y), vehicle)?;
            write(area, &shorten(name, NAME_WIDTH), 15, (54, y - 7))?;
            y += 24;
        }
        if self.names.len() > MOST_NAMES {
            write(area, &format!("and {} other vehicles", self.names.len() - MOST_NAMES), 15, (54, y - 7))?;
        }
        Ok(())
    }
}

/// Returns the outline of the band of one standard deviation around a line; empty if there is none.
fn edge(line: &[LinePoint]) -> Vec<(f64, f64)> {
    let side = |sign: f64| line.iter().filter_map(move |of| Some((of.depth, of.crush_intensity + sign * of.sd?)));
    side(1.0).chain(side(-1.0).collect::<Vec<_>>().into_iter().rev()).collect()
}

/// Draws the mark of a test, with a shape for each vehicle in turn.
fn marker<C: CoordTranslate>(area: &DrawingArea<SVGBackend<'_>, C>, at: C::From, vehicle: usize) -> Drawn
where
    C::From: Clone,
{
    match vehicle % 4 {
        0 => area.draw(&Circle::new(at, px(5), DARK.filled()))?,
        1 => area.draw(&TriangleMarker::new(at, px(7), VERMILION.filled()))?,
        2 => area.draw(&Cross::new(at, px(5), GREEN.stroke_width(px(3))))?,
        _ => area.draw(&Circle::new(at, px(6), BLUE.stroke_width(px(2))))?,
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, hostile};
    use super::*;
    use planar_impact_app::stiffness::{TestFile, stiffness as fit};
    use planar_impact_app::{Source, Uncontrolled};

    fn answer(text: &str) -> Answer<StiffnessAnswer> {
        let file = TestFile::parse(Source::new("tests", text)).unwrap_or_else(|issues| panic!("{issues}"));
        fit(&file, &(), &Uncontrolled).unwrap_or_else(|issues| panic!("{issues}"))
    }

    #[test]
    fn the_line_passes_the_tests_at_their_residuals_and_lies_within_its_band() {
        let answer = answer(include_str!("../../../cli/examples/tests/struble-welsh.toml"));
        let fit = &answer.fits[0];
        for (test, residual) in answer.tests.iter().zip(&fit.residuals) {
            let after = fit.line.iter().position(|point| point.depth >= test.mean_depth).expect("within the line");
            let (from, to) = (&fit.line[after - 1], &fit.line[after]);
            let share = (test.mean_depth - from.depth) / (to.depth - from.depth);
            let fitted = from.crush_intensity + share * (to.crush_intensity - from.crush_intensity);
            assert!(
                (fitted - residual.fitted).abs() < 1e-9 * fitted
                    && (residual.observed - fitted - residual.difference).abs() < 1e-9 * fitted
            );
        }
        let edge = edge(&fit.line);
        assert_eq!(edge.len(), 2 * fit.line.len());
        for (i, point) in fit.line.iter().enumerate() {
            let (above, below) = (edge[i], edge[edge.len() - 1 - i]);
            assert_eq!((above.0, below.0), (point.depth, point.depth));
            assert!(above.1 > point.crush_intensity && (above.1 + below.1 - 2.0 * point.crush_intensity).abs() < 1e-9 * above.1);
        }
    }

    #[test]
    fn stiffness_is_legible() {
        for text in
            [include_str!("../../../cli/examples/tests/struble-welsh.toml"), include_str!("../../../cli/examples/tests/malibu.toml")]
        {
            let mut answer = answer(text);
            assert_legible(&stiffness(&answer, Units::Us).expect("in memory"));
            // A panel with a head.
            answer.facts.fits_as_new_cars = answer.facts.fits.clone();
            assert_legible(&stiffness(&answer, Units::Si).expect("in memory"));
            answer.title = hostile();
            // More vehicles than the legend names.
            let tests = answer.tests.clone();
            answer.facts.tests = (0..40).flat_map(|_| tests.clone()).collect();
            answer.facts.tests.iter_mut().enumerate().for_each(|(i, test)| test.vehicle = format!("{i}{}", hostile()));
            assert_legible(&stiffness(&answer, Units::Si).expect("in memory"));
        }
    }
}
