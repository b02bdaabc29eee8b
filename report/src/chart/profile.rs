//! The profile of the likelihood of each unknown, and of what follows from them.

use planar_impact_app::issue::Issues;
use planar_impact_app::reconstruct::{Estimated, ProfileLevel, Reconstruction};
use planar_impact_app::{Answer, Units};
use plotters::prelude::{Circle, Color};

use super::canvas::{Area, Axes, BLUE, DARK, Drawn, GRAY, Stroke, VERMILION, WIDTH, page, px, span, with_unit, write};

/// Height of a panel and of the legend, in pixels.
const PANEL: u32 = 236;
const FOOT: u32 = 34;
/// Width of the numbers and the name of the vertical axis, in pixels.
const LEFT: u32 = 52;
/// Width beside a panel, in pixels.
const RIGHT: u32 = 26;
/// Number of panels beside each other.
const COLUMNS: usize = 2;

// Solid lines that differ in width: of a broken one each dash would be an element.
const CURVE: Stroke = Stroke::solid(BLUE, 3);
const NORMAL: Stroke = Stroke::solid(VERMILION, 1);
const MARK: Stroke = Stroke::solid(GRAY, 1);
/// Heights with lines of their own: one and two standard deviations of a normal distribution.
const MARKS: [f64; 2] = [1.0, 4.0];

/// Draws the profiles; `None` without any, or if no quantity varies.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn profile(answer: &Answer<Reconstruction>, units: Units) -> Result<Option<String>, Issues> {
    let curves = curves(answer, units);
    if curves.is_empty() {
        return Ok(None);
    }
    let description = curves.iter().map(Curve::described).collect::<Vec<_>>().join("; ");
    let title = if answer.title.is_empty() { "Profiles".to_owned() } else { format!("Profiles: {}", answer.title) };
    let rows = curves.len().div_ceil(COLUMNS);
    let height = px(PANEL * rows as u32 + FOOT);
    page(&title, &format!("Profiles of the likelihood. {description}."), height, |area| {
        let (body, foot) = area.split_vertically(px(PANEL * rows as u32));
        for (curve, panel) in curves.iter().zip(body.split_evenly((rows, COLUMNS))) {
            // Half of a number may stand beyond the axis.
            curve.draw(&panel.margin(0, 0, 0, px(RIGHT)))?;
        }
        legend(&foot)
    })
    .map(Some)
}

/// The profile of one quantity, in the units of the reader.
struct Curve {
    name: String,
    best: f64,
    sd: Option<f64>,
    /// Value and height, from the least value to the greatest.
    points: Vec<(f64, f64)>,
}

fn curves(answer: &Reconstruction, units: Units) -> Vec<Curve> {
    let curve = |of: Estimated<'_>| {
        let (best, levels) = (of.value?, of.profile?);
        let convert = |si: f64| units.convert(of.measure, si);
        let ends =
            |end: fn(&ProfileLevel) -> Option<f64>| levels.iter().filter_map(move |level| Some((convert(end(level)?), level.chi_square)));
        let (below, above) = (ends(|level| level.low), ends(|level| level.high));
        let points = below.rev().chain([(convert(best), 0.0)]).chain(above).collect();
        let sd = of.sd.map(|sd| (convert(best + sd) - convert(best)).abs());
        Some(Curve { name: with_unit(of.name, units.unit(of.measure)), best: convert(best), sd, points }).filter(Curve::varies)
    };
    answer.estimates().filter_map(curve).collect()
}

impl Curve {
    /// Returns `true` if its width is more than the tolerance of exact evidence.
    fn varies(&self) -> bool {
        /// Share of the value that is tolerance.
        const EXACT: f64 = 1e-5;
        let [(low, _), .., (high, _)] = self.points[..] else { return false };
        high - low > EXACT * self.best.abs()
    }

    fn described(&self) -> String {
        let best = self.points.iter().position(|(_, height)| *height == 0.0).unwrap_or(0);
        let (below, above) = self.points.split_at(best);
        let at = |chi_square: f64| {
            let end = |side: &[(f64, f64)]| side.iter().find(|(_, height)| *height == chi_square).map(|(value, _)| *value);
            match (end(below), end(above)) {
                (Some(low), Some(high)) => format!("{low} to {high}"),
                (Some(low), None) => format!("{low} or more"),
                (None, Some(high)) => format!("{high} or less"),
                (None, None) => "any value".to_owned(),
            }
        };
        format!("{}: best {}, {} at chi-square 1, {} at chi-square 4", self.name, self.best, at(1.0), at(4.0))
    }

    fn draw(&self, area: &Area<'_>) -> Drawn {
        let top = self.points.iter().map(|(_, height)| *height).fold(0.0, f64::max);
        let axes = Axes {
            x: span(self.points.iter().map(|(value, _)| *value), 0.06),
            y: 0.0..1.04 * top,
            x_name: &self.name,
            y_name: "chi-square",
            left: LEFT,
        };
        let mut chart = axes.draw(area)?;
        for height in MARKS {
            MARK.line(&mut chart, [(axes.x.start, height), (axes.x.end, height)])?;
        }
        if let Some(sd) = self.sd.filter(|sd| *sd > 0.0) {
            NORMAL.line(&mut chart, parabola(self.best, sd, &axes.x, axes.y.end))?;
        }
        CURVE.line(&mut chart, self.points.iter().copied())?;
        chart.draw_series([Circle::new((self.best, 0.0), px(5), DARK.filled())])?;
        Ok(())
    }
}

/// Returns points of the profile that a standard deviation alone would give, as far as they are on the chart.
fn parabola(best: f64, sd: f64, x: &std::ops::Range<f64>, top: f64) -> Vec<(f64, f64)> {
    const POINTS: i32 = 60;
    let half = sd * top.sqrt();
    let (low, high) = ((best - half).max(x.start), (best + half).min(x.end));
    let point = |i: i32| {
        let value = low + (high - low) * f64::from(i) / f64::from(POINTS);
        let root = (value - best) / sd;
        (value, root * root)
    };
    (0..=POINTS).map(point).collect()
}

/// Says what the lines are.
fn legend(area: &Area<'_>) -> Drawn {
    let entries = [(CURVE, "best fit of the rest"), (NORMAL, "by the standard deviation alone"), (MARK, "68.3 % and 95.4 %")];
    let width = (WIDTH / px(1)) as i32 / entries.len() as i32;
    for (place, (stroke, words)) in entries.into_iter().enumerate() {
        let left = 16 + width * place as i32;
        stroke.sample(area, left, left + 32, 16)?;
        write(area, words, 14, (left + 40, 9))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, hostile, reconstructed};
    use super::*;
    use planar_impact_app::reconstruct::Options;

    #[test]
    fn a_profile_rises_outwards_and_passes_the_ends_of_the_interval() {
        for text in [
            include_str!("../../../cli/examples/reconstruct/uncertain-masses.toml"),
            include_str!("../../../cli/examples/reconstruct/position-a.toml"),
        ] {
            let mut answer = reconstructed(text, Options { profile: true, ..Options::default() });
            let curves = curves(&answer, Units::Us);
            assert!(!curves.is_empty());
            for curve in &curves {
                let best = curve.points.iter().position(|point| point.1 == 0.0).expect("the best");
                let (below, above) = (&curve.points[..=best], &curve.points[best..]);
                assert!(curve.points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
                assert!(below.windows(2).all(|pair| pair[0].1 > pair[1].1) && above.windows(2).all(|pair| pair[0].1 < pair[1].1));
            }
            // The interval of 95 % ends where the profile has passed 3.84, between the heights 2.25 and 4.
            for (_, unknown) in answer.unknown.iter() {
                let (levels, interval) = (unknown.profile.as_ref().expect("a profile"), &unknown.interval);
                assert_eq!(levels.iter().map(|level| level.chi_square).collect::<Vec<_>>(), [0.25, 1.0, 2.25, 4.0, 6.25, 9.0]);
                assert!((levels[1].level - 0.682_689_492_137_086).abs() < 1e-12, "of one standard deviation");
                let slack = 1e-3 * (interval.high.expect("an end") - interval.low.expect("an end"));
                let within = |of: fn(&ProfileLevel) -> Option<f64>, end: Option<f64>| {
                    let [inner, end, outer] = [of(&levels[2]), end, of(&levels[3])].map(|end| end.expect("an end"));
                    inner.min(outer) - slack <= end && end <= inner.max(outer) + slack
                };
                assert!(within(|level| level.low, interval.low) && within(|level| level.high, interval.high));
            }
            answer.title = hostile();
            assert_legible(&profile(&answer, Units::Us).expect("in memory").expect("curves"));
        }
    }

    #[test]
    fn an_open_end_is_told_in_words() {
        let described = |points: &[(f64, f64)]| Curve { name: "x".to_owned(), best: 2.0, sd: None, points: points.to_vec() }.described();
        let (low, best, high) = ([(0.5, 4.0), (1.0, 1.0)], [(2.0, 0.0)], [(3.0, 1.0), (5.0, 4.0)]);
        assert_eq!(described(&[&low[..], &best, &high].concat()), "x: best 2, 1 to 3 at chi-square 1, 0.5 to 5 at chi-square 4");
        assert_eq!(described(&[&low[..], &best].concat()), "x: best 2, 1 or more at chi-square 1, 0.5 or more at chi-square 4");
        assert_eq!(described(&[&best[..], &high].concat()), "x: best 2, 3 or less at chi-square 1, 5 or less at chi-square 4");
        assert_eq!(described(&[&low[1..], &best].concat()), "x: best 2, 1 or more at chi-square 1, any value at chi-square 4");
    }

    #[test]
    fn a_parabola_has_the_height_of_one_at_its_standard_deviation() {
        let points = parabola(3.0, 0.5, &(0.0..10.0), 9.0);
        assert!(points.iter().all(|(x, y)| (y - ((x - 3.0) / 0.5) * ((x - 3.0) / 0.5)).abs() < 1e-9));
        assert!(((points[0].0 - 1.5).abs() < 1e-12) && ((points[0].1 - 9.0).abs() < 1e-9) && points.len() == 61);
        // No further than the chart.
        assert_eq!(parabola(3.0, 0.5, &(2.5..10.0), 9.0)[0], (2.5, 1.0));
    }
}
