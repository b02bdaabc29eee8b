//! The uncertainty of outputs: for each its density with quantiles, the share of each input as bars, its mean and deviation by each method, and its
//! guaranteed range.

mod intervals;

use plotters::prelude::{Color, LineSeries, PathElement, Rectangle, ShapeStyle};

use planar_impact_app::case::CaseOutput;
use planar_impact_app::issue::Issues;
use planar_impact_app::uncertainty::{MonteCarlo, OutputUncertainty, Share, Uncertainty, ends};
use planar_impact_app::units::trim;
use planar_impact_app::{Answer, Units};

use super::canvas::{Area, Axes, BLUE, Drawn, GRAY, VERMILION, WIDTH, page, px, span, with_unit, write};
use crate::page::uncertainty::percent;
use intervals::Interval;

/// Height of a density with the bars beside it.
const DENSITY: u32 = px(300);
/// Width of the bars beside a density.
const BARS: u32 = px(350);
/// Number of inputs with a bar.
const MOST_BARS: usize = 8;

/// Draws the uncertainty of each output: its density and the shares of the inputs, its mean and deviation by each method, and its guaranteed range.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn uncertainty(answer: &Answer<Uncertainty>, units: Units) -> Result<String, Issues> {
    let panels: Vec<Panel<'_>> =
        answer.outputs.iter().zip(answer.of.iter()).map(|(of, (_, found))| Panel { of: *of, found, level: answer.level, units }).collect();
    let names: Vec<String> = answer.outputs.iter().map(ToString::to_string).collect();
    let description = format!("Densities, shares of the inputs in the variance, means and ranges of {}.", names.join(", "));
    page(&answer.title, &description, panels.iter().map(Panel::height).sum(), |body| {
        let mut rest = body.clone();
        for panel in &panels {
            let (area, below) = rest.split_vertically(panel.height());
            panel.draw(area)?;
            rest = below;
        }
        Ok(())
    })
}

struct Panel<'a> {
    of: CaseOutput,
    found: &'a OutputUncertainty,
    level: f64,
    units: Units,
}

impl Panel<'_> {
    fn height(&self) -> u32 {
        self.density_height() + self.intervals().iter().map(|(_, rows)| intervals::height(rows)).sum::<u32>()
    }

    /// Returns the height of the density and the bars, of which bounds have neither.
    fn density_height(&self) -> u32 {
        let OutputUncertainty { linear, monte_carlo, sobol, shapley, .. } = self.found;
        if linear.is_some() || monte_carlo.is_some() || sobol.is_some() || shapley.is_some() { DENSITY } else { 0 }
    }

    /// Returns what each chart of intervals shows, and its rows.
    fn intervals(&self) -> Vec<(&'static str, Vec<Interval>)> {
        let of = intervals::Rows { of: self.of, found: self.found, units: self.units };
        [("mean ± sd", of.methods()), ("range", of.range())].into_iter().filter(|(_, rows)| !rows.is_empty()).collect()
    }

    fn draw(&self, area: Area<'_>) -> Drawn {
        let (top, mut rest) = area.split_vertically(self.density_height());
        if self.density_height() > 0 {
            let (density, bars) = top.split_horizontally(WIDTH - BARS);
            self.density(&density)?;
            self.bars(&bars)?;
            self.legend(&bars)?;
        }
        for (what, rows) in self.intervals() {
            let (area, below) = rest.split_vertically(intervals::height(&rows));
            intervals::draw(&area, &rows, &format!("{what} of {}", self.name()))?;
            rest = below;
        }
        Ok(())
    }

    fn name(&self) -> String {
        with_unit(&self.of.short_name(), self.units.unit(self.of.measure()))
    }

    /// Draws the density of the samples, the normal density of first derivatives, and lines at the ends of the middle range.
    fn density(&self, area: &Area<'_>) -> Drawn {
        let convert = |si: f64| self.units.convert(self.of.measure(), si);
        let bars: Vec<(f64, f64, f64)> = self.found.monte_carlo.iter().flat_map(|found| rectangles(found, &convert)).collect();
        let normal: Vec<(f64, f64)> = self.normal(&convert);
        let x = bars.iter().flat_map(|bar| [bar.0, bar.1]).chain(normal.iter().map(|point| point.0));
        let y = bars.iter().map(|bar| bar.2).chain(normal.iter().map(|point| point.1)).chain([0.0]);
        if bars.is_empty() && normal.is_empty() {
            return write(area, &format!("{} is certain, or has no finite deviation", self.name()), 17, (40, 120));
        }
        let (x, height) = (span(x, 0.0), span(y, 0.0).end);
        let unit = self.units.unit(self.of.measure());
        let y_name = if unit.is_empty() { "probability density".to_owned() } else { format!("probability per {unit}") };
        let y = 0.0..1.12 * height;
        let axes = Axes { x: x.clone(), left: Axes::room(&y), y, x_name: &self.name(), y_name: &y_name };
        let mut chart = axes.draw(area)?;
        let filled = bars.iter().map(|(start, end, density)| Rectangle::new([(*start, 0.0), (*end, *density)], BLUE.mix(0.35).filled()));
        chart.draw_series(filled)?;
        chart.draw_series(LineSeries::new(normal, ShapeStyle::from(&VERMILION).stroke_width(px(2))))?;
        if let Some(found) = &self.found.monte_carlo {
            let [low, high] = ends(self.level);
            for p in [low, 0.5, high] {
                let Some(at) = found.quantiles.get(&p.to_string()).map(|si| convert(*si)).filter(|at| x.contains(at)) else { continue };
                chart.draw_series([PathElement::new([(at, 0.0), (at, 1.06 * height)], ShapeStyle::from(&GRAY).stroke_width(px(1)))])?;
                let (left, top) = chart.plotting_area().map_coordinate(&(at, 1.06 * height));
                let (dx, dy) = area.get_base_pixel();
                let fine = px(1) as i32;
                write(area, &format!("{} %", trim(100.0 * p)), 14, ((left - dx) / fine - 16, (top - dy) / fine - 14))?;
            }
        }
        Ok(())
    }

    /// Names what the density is made of, in the lower corner beside it.
    fn legend(&self, area: &Area<'_>) -> Drawn {
        /// Height of the legend in its panel, in pixels.
        const Y: i32 = 276;
        let fine = px(1) as i32;
        if self.found.monte_carlo.is_some() {
            area.draw(&Rectangle::new([(16 * fine, (Y + 3) * fine), (36 * fine, (Y + 13) * fine)], BLUE.mix(0.35).filled()))?;
            write(area, "samples", 14, (42, Y))?;
        }
        if !self.normal(&|si| si).is_empty() {
            let line = [(116 * fine, (Y + 8) * fine), (136 * fine, (Y + 8) * fine)];
            area.draw(&PathElement::new(line, ShapeStyle::from(&VERMILION).stroke_width(px(2))))?;
            write(area, "normal, of the linear mean and sd", 14, (142, Y))?;
        }
        Ok(())
    }

    /// Returns the normal density of first derivatives.
    fn normal(&self, convert: &impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let Some(linear) = &self.found.linear else { return Vec::new() };
        let (mean, sd) = (convert(linear.mean), convert(linear.mean + linear.sd) - convert(linear.mean));
        let sd = sd.abs();
        if !(sd > 0.0 && sd.is_finite()) {
            return Vec::new();
        }
        let peak = 1.0 / (sd * (2.0 * std::f64::consts::PI).sqrt());
        (-70..=70).map(|i| f64::from(i) / 20.0).map(|z| (mean + z * sd, peak * libm::exp(-0.5 * z * z))).collect()
    }

    /// Draws the share of each input in the variance, the greatest first.
    fn bars(&self, area: &Area<'_>) -> Drawn {
        let fine = px(1) as i32;
        let OutputUncertainty { linear, sobol, shapley, .. } = self.found;
        let (title, mut shares): (_, Vec<(_, f64, Option<f64>)>) = if let Some(sobol) = sobol {
            let share = |(name, share): (_, &Share)| (name, share.total, Some(share.first));
            ("share of the variance: alone, with others", sobol.iter().map(share).collect())
        } else if let Some(shapley) = shapley {
            ("share of the variance: Shapley effects", shapley.iter().map(|(name, found)| (name, found.effect, None)).collect())
        } else if let Some(linear) = linear {
            ("share of the variance, linear", linear.shares.iter().map(|(name, share)| (name, *share, None)).collect())
        } else {
            return Ok(());
        };
        shares.retain(|(_, share, _)| share.is_finite());
        shares.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let hidden = shares.len().saturating_sub(MOST_BARS);
        shares.truncate(MOST_BARS);
        write(area, title, 15, (16, 12))?;
        for (row, (name, share, alone)) in shares.iter().enumerate() {
            let y = 40 + 26 * row as i32;
            let length = |share: f64| (130.0 * share.clamp(0.0, 1.0)) as i32;
            let bar = |share: f64, style: ShapeStyle| {
                Rectangle::new([(16 * fine, (y + 14) * fine), ((16 + length(share)) * fine, (y + 20) * fine)], style)
            };
            area.draw(&bar(*share, BLUE.mix(0.35).filled()))?;
            area.draw(&bar(alone.unwrap_or(*share), BLUE.filled()))?;
            write(area, name, 14, (16, y - 2))?;
            let number = match alone {
                Some(alone) => format!("{}, {}", percent(*alone), percent(*share)),
                None => percent(*share),
            };
            write(area, &number, 14, (232, y - 2))?;
        }
        if hidden > 0 {
            write(area, &format!("and {hidden} with smaller shares"), 14, (16, 40 + 26 * shares.len() as i32))?;
        }
        Ok(())
    }
}

/// Returns the bins of a density: start, end and height.
fn rectangles(found: &MonteCarlo, convert: &impl Fn(f64) -> f64) -> Vec<(f64, f64, f64)> {
    let edges: Vec<f64> = found.density.edges.iter().map(|edge| convert(*edge)).collect();
    let bar = |(pair, share): (&[f64], &f64)| {
        let (start, end) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
        (start, end, share / (end - start))
    };
    edges.windows(2).zip(&found.density.shares).map(bar).filter(|bar| bar.2.is_finite()).collect()
}
