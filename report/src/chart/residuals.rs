//! The residuals of evidence and priors in their standard deviations.

use planar_impact_app::issue::Issues;
use planar_impact_app::named::Named;
use planar_impact_app::reconstruct::{Evidence, Reconstruction};
use planar_impact_app::{Answer, Units};
use plotters::prelude::{Circle, Color, PathElement, Rectangle, ShapeStyle};
use plotters::style::text_anchor::VPos;

use super::canvas::{Area, Axes, BLUE, DARK, Drawn, GRAY, GRID, Stroke, VERMILION, WIDTH, Writing, page, px};
use crate::page::uncertainty::with_digits;

/// Height of a row, of the axis with its name, and of the margin above, in pixels.
const ROW: i32 = 26;
const AXIS: i32 = 56;
const MARGIN: i32 = 12;
/// Width of the names of the rows, and of their numbers.
const NAMES: i32 = 290;
const NUMBERS: i32 = 260;
/// Least end of the axis.
const LEAST: f64 = 2.5;

/// Draws the standardised residual of each piece of uncertain evidence and of each prior; `None` if all are exact.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn residuals(answer: &Answer<Reconstruction>, units: Units) -> Result<Option<String>, Issues> {
    let rows = rows(answer, units);
    if rows.is_empty() {
        return Ok(None);
    }
    let description = rows.iter().map(|row| format!("{}: {:+.2}", row.name, row.residual)).collect::<Vec<_>>().join("; ");
    let title = if answer.title.is_empty() { "Residuals".to_owned() } else { format!("Residuals: {}", answer.title) };
    let height = px((MARGIN + ROW * rows.len() as i32 + AXIS) as u32);
    page(&title, &format!("Residuals in standard deviations. {description}."), height, |area| draw(area, &rows)).map(Some)
}

/// A residual.
#[derive(Debug, PartialEq)]
struct Row {
    name: String,
    /// Given minus computed, in standard deviations.
    residual: f64,
    /// The values themselves.
    numbers: String,
}

fn rows(answer: &Reconstruction, units: Units) -> Vec<Row> {
    let row = |prefix: &str, name: &str, evidence: &Evidence| {
        let residual = evidence.standardised_residual?;
        let number = |si: f64| with_digits(units, evidence.measure, si, evidence.sd.unwrap_or(0.0));
        let numbers = format!("{}, computed {} {}", number(evidence.given), number(evidence.computed), units.unit(evidence.measure));
        Some(Row { name: format!("{prefix}{name}"), residual, numbers })
    };
    let evidence = answer.evidence.iter().filter_map(|(name, evidence)| row("", name, evidence));
    let priors = answer.priors.iter().flat_map(Named::iter).filter_map(|(name, prior)| row("prior of ", name, prior));
    evidence.chain(priors).collect()
}

fn draw(area: &Area<'_>, rows: &[Row]) -> Drawn {
    let count = rows.len() as f64;
    let most = rows.iter().map(|row| 1.08 * row.residual.abs()).filter(|most| most.is_finite()).fold(LEAST, f64::max);
    let (left, _) = area.split_horizontally(WIDTH - px(NUMBERS as u32));
    let name = "given minus computed, in standard deviations";
    let axes = Axes { x: -most..most, y: 0.0..count, x_name: name, y_name: "", left: NAMES as u32 };
    let mut chart = axes.draw(&left)?;
    chart.draw_series([Rectangle::new([(-1.0, 0.0), (1.0, count)], GRID.mix(0.45).filled())])?;
    for (marks, stroke) in [(0.0, Stroke::solid(DARK, 1)), (1.0, Stroke::dashed(GRAY, 1, 8, 4)), (2.0, Stroke::dashed(GRAY, 1, 2, 4))]
        .map(|(at, stroke)| ([-at, at], stroke))
    {
        for at in marks {
            stroke.line(&mut chart, [(at, 0.0), (at, count)])?;
        }
    }
    for (place, row) in rows.iter().enumerate() {
        let y = count - place as f64 - 0.5;
        // Beyond two standard deviations in another color, and as a ring.
        let is_far = row.residual.abs() > 2.0;
        let color = if is_far { VERMILION } else { BLUE };
        chart.draw_series([PathElement::new([(0.0, y), (row.residual, y)], ShapeStyle::from(&color).stroke_width(px(2)))])?;
        let style = if is_far { ShapeStyle::from(&color).stroke_width(px(2)) } else { color.filled() };
        chart.draw_series([Circle::new((row.residual, y), px(if is_far { 6 } else { 5 }), style)])?;
        let middle = MARGIN + ROW * place as i32 + ROW / 2;
        Writing { down: VPos::Center, ..Writing::ending() }.write(area, &row.name, (NAMES, middle))?;
        let right = WIDTH as i32 / px(1) as i32 - NUMBERS;
        Writing { down: VPos::Center, ..Writing::default() }.write(area, &row.numbers, (right, middle))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, hostile, reconstructed};
    use super::*;
    use planar_impact_app::reconstruct::Options;

    #[test]
    fn squares_of_the_residuals_add_up_to_chi_square() {
        for (text, is_correlated) in [
            (include_str!("../../../cli/examples/reconstruct/position-a.toml"), false),
            (include_str!("../../../cli/examples/reconstruct/crabbed-2.toml"), false),
            (include_str!("../../../cli/examples/reconstruct/uncertain-masses.toml"), true),
        ] {
            let mut answer = reconstructed(text, Options::default());
            let sum: f64 = rows(&answer, Units::Si).iter().map(|row| row.residual * row.residual).sum();
            assert!(is_correlated || (sum - answer.chi_square).abs() <= 1e-6 * answer.chi_square.max(1.0), "{sum} {}", answer.chi_square);
            answer.title = hostile();
            if let Some(svg) = residuals(&answer, Units::Us).expect("in memory") {
                assert_legible(&svg);
            }
            assert_legible(&super::super::intervals(&answer, Units::Us).expect("in memory"));
        }
    }

    #[test]
    fn far_residuals_are_legible_too() {
        let row = |residual: f64| Row {
            name: "vehicle.1.separation_velocity.x".to_owned(),
            residual,
            numbers: "1.0, computed 2.0 m/s".to_owned(),
        };
        for far in [0.0, 2.4, -17.3, 1e6] {
            let rows = vec![row(far), row(-1.0)];
            let height = px((MARGIN + ROW * 2 + AXIS) as u32);
            assert_legible(&page("far", "", height, |area| draw(area, &rows)).expect("in memory"));
        }
    }
}
