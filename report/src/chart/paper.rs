//! Figures 6 and 7 of the paper as SVG, drawn from the computed numbers.

use std::ops::Range as Span;

use planar_impact_validation::{Axis, Curve, Figure, Point, Report, Style};
use plotters::coord::CoordTranslate;
use plotters::prelude::{BLACK, Circle, Color, DrawingArea, RGBColor, SVGBackend};

use super::canvas::{Area, Axes, BLUE, Drawn, GREEN, Stroke, VERMILION, page, px, span, with_unit, write};
use planar_impact_app::issue::Issues;

const HEIGHT: u32 = px(520);
const LEGEND: u32 = px(64);
/// Distance between the two columns of names in the legend.
const COLUMN: i32 = 430;

/// Style of the first and the second line.
const LINES: [Stroke; 2] = [Stroke::solid(BLUE, 2), Stroke::dashed(VERMILION, 2, 12, 5)];
/// Style of the first and the second kind of marks: color, and whether they are filled.
const MARKS: [(RGBColor, bool); 2] = [(BLACK, true), (GREEN, false)];

/// Draws figure 6 or 7.
///
/// # Errors
///
/// Fails only because of a defect: the report has no such figure, or drawing fails.
pub fn figure(report: &Report, number: u32) -> Result<String, Issues> {
    let figure = report.figures.iter().find(|figure| u32::from(figure.number) == number);
    let figure = figure.ok_or_else(|| Issues::defect(format!("there is no figure {number}")))?;
    let curves: Vec<&str> = figure.curves.iter().map(|curve| curve.name.as_str()).collect();
    let description = format!("{} over {}: {}.", figure.y.name, figure.x.name, curves.join(", "));
    page(figure.title, &description, LEGEND + HEIGHT, |area| {
        let (legend, plot) = area.split_vertically(LEGEND);
        draw_legend(figure, &legend)?;
        draw(figure, &plot)
    })
}

/// Returns each curve with the index of its style among curves of its kind.
fn styled(figure: &Figure) -> impl Iterator<Item = (&Curve, usize)> {
    let before = |which: usize, style: Style| figure.curves[..which].iter().filter(|curve| curve.style == style).count();
    figure.curves.iter().enumerate().map(move |(which, curve)| (curve, before(which, curve.style) % 2))
}

fn draw(figure: &Figure, area: &Area<'_>) -> Drawn {
    let all = |of: fn(&Point) -> f64| figure.curves.iter().flat_map(|curve| &curve.points).map(of);
    let from_zero = |span: Span<f64>| 0.0..span.end;
    let y = from_zero(span(all(|point| point.y), 0.04));
    let name = |axis: Axis| with_unit(axis.name, axis.unit);
    let (x_name, y_name) = (name(figure.x), name(figure.y));
    let left = Axes::room(&y);
    let x = from_zero(span(all(|point| point.x), 0.0));
    let mut chart = Axes { x, y, x_name: &x_name, y_name: &y_name, left }.draw(area)?;
    for (curve, which) in styled(figure) {
        let points = curve.points.iter().map(|point| (point.x, point.y));
        match curve.style {
            Style::Line => LINES[which].line(&mut chart, points)?,
            Style::Marks => {
                for point in points {
                    draw_mark(chart.plotting_area(), point, which)?;
                }
            }
        }
    }
    Ok(())
}

/// Draws a disk, or a ring that surrounds a disk at the same position.
fn draw_mark<C: CoordTranslate>(area: &DrawingArea<SVGBackend<'_>, C>, at: C::From, which: usize) -> Drawn
where
    C::From: Clone,
{
    let (color, filled) = MARKS[which];
    if filled {
        area.draw(&Circle::new(at, px(5), color.filled()))?;
    } else {
        area.draw(&Circle::new(at, px(8), color.stroke_width(px(2))))?;
    }
    Ok(())
}

/// Draws a sample of each curve with its name, above the axes.
fn draw_legend(figure: &Figure, area: &Area<'_>) -> Drawn {
    let fine = px(1) as i32;
    for (place, (curve, which)) in styled(figure).enumerate() {
        let place = place as i32;
        let (left, middle) = (20 + COLUMN * (place % 2), 18 + 26 * (place / 2));
        match curve.style {
            Style::Line => LINES[which].sample(area, left, left + 44, middle)?,
            Style::Marks => draw_mark(area, (fine * (left + 22), fine * middle), which)?,
        }
        write(area, &curve.name, 17, (left + 56, middle - 7))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_its_axes_names_and_marks() {
        let report = planar_impact_validation::run().expect("the tables can be read");
        for (number, unit) in [(6, "[ft lbf]"), (7, "[√lbf]")] {
            let text = figure(&report, number).expect("in memory");
            assert!(text.starts_with("<svg ") && text.contains("mean residual crush C [ft]") && text.contains(unit), "{text}");
            // Three tests without and three with restitution, and one of each in the legend.
            assert_eq!(text.matches("<circle ").count(), 3 + 3 + 2);
            // An apostrophe is escaped in XML.
            for part in report.figures[number as usize - 6].curves.iter().flat_map(|curve| curve.name.split('\'')) {
                assert!(text.contains(part), "{part}");
            }
        }
    }
}
