//! Data of Figures 6 and 7: the crush of the crabbed tests compared with the linear model.

use crate::geometry::Geometry;
use crate::reconstruction::Reconstructions;
use crate::series::{Restitution, Series};
use planar_impact::barrier::{Observation, Observations, StiffnessFit};
use planar_impact::crush::{CrushStiffness, ProfileMoments};

/// A figure of the paper, drawn from computed numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its number in the paper.
    pub number: u8,
    /// Its title.
    pub title: &'static str,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Its curves, in drawing order.
    pub curves: Vec<Curve>,
}

/// An axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// The quantity.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

/// A set of related points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Its drawing style.
    pub style: Style,
    /// The points, from left to right.
    pub points: Vec<Point>,
}

/// Drawing style of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Connected by a line.
    Line,
    /// A separate mark for each: measurements.
    Marks,
}

/// A point of a figure, in the units of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
}

/// Greatest depth of the lines, in ft: slightly more than the deepest crush of the tests.
const DEEPEST: f64 = 1.2;
const STEPS: u32 = 48;

/// Computes Figures 6 and 7.
pub(crate) fn all(geometry: &Geometry, series: &Series, reconstructions: &Reconstructions) -> Vec<Figure> {
    let fitted = fitted_line(&intensities(series, reconstructions, Restitution::Measured));
    vec![energies(geometry, series, reconstructions, &fitted), lines(geometry, series, reconstructions, &fitted)]
}

/// Returns E* of the tests against the depth of crush.
pub(crate) fn intensities(series: &Series, reconstructions: &Reconstructions, restitution: Restitution) -> Vec<Point> {
    let tests = series.tests.iter().enumerate();
    tests.map(|(which, test)| Point { x: test.depth, y: reconstructions.get(which, restitution).cumulative.intensity }).collect()
}

/// Fits the line E* = d₀ + d₁ C through points of depth and E* by least squares with equal weights. Returns NaN if
/// the points determine no line.
pub(crate) fn fitted_line(points: &[Point]) -> CrushStiffness {
    let observed = |point: &Point| {
        let crush = ProfileMoments::of(1.0, &[point.x, point.x]).expect("two depths are a profile");
        Observation { crush, intensity: point.y, deviation: 1.0 }
    };
    let observations: Vec<Observation> = points.iter().map(observed).collect();
    let fit = Observations::independent(&observations).and_then(|observations| StiffnessFit::on_mean_depth(&observations));
    fit.map_or(CrushStiffness { onset: f64::NAN, slope: f64::NAN }, |fit| fit.stiffness)
}

fn curve(of: impl Fn(f64) -> f64) -> Vec<Point> {
    (0..=STEPS).map(|step| DEEPEST * f64::from(step) / f64::from(STEPS)).map(|x| Point { x, y: of(x) }).collect()
}

/// Computes Figure 6: the crush energy after a test is the sum over all tests up to it, and the linear model is a parabola.
fn energies(geometry: &Geometry, series: &Series, reconstructions: &Reconstructions, fitted: &CrushStiffness) -> Figure {
    let model = |line: &CrushStiffness| {
        curve(|depth| {
            let profile = ProfileMoments::of(geometry.crush_width, &[depth, depth]).expect("two depths are a profile");
            line.crush_energy(profile)
        })
    };
    let tests = |restitution| {
        let tests = series.tests.iter().enumerate();
        tests.map(|(which, test)| Point { x: test.depth, y: reconstructions.get(which, restitution).cumulative.energy }).collect()
    };
    Figure {
        number: 6,
        title: "Figure 6: cumulative crush energy of sequential barrier tests of one car",
        x: Axis { name: "mean residual crush C", unit: "ft" },
        y: Axis { name: "cumulative crush energy", unit: "ft lbf" },
        curves: vec![
            Curve { name: "linear model, NHTSA's line".into(), style: Style::Line, points: model(&geometry.crush) },
            Curve { name: "linear model, line fitted to the tests".into(), style: Style::Line, points: model(fitted) },
            Curve { name: "tests, measured e".into(), style: Style::Marks, points: tests(Restitution::Measured) },
            Curve { name: "tests, e = 0".into(), style: Style::Marks, points: tests(Restitution::None) },
        ],
    }
}

/// Computes Figure 7: E* = √(2 E_C/w) of the tests, compared with the straight line.
fn lines(geometry: &Geometry, series: &Series, reconstructions: &Reconstructions, fitted: &CrushStiffness) -> Figure {
    let line = |line: &CrushStiffness| format!("{:.2} + {:.1} C", line.onset, line.slope);
    Figure {
        number: 7,
        title: "Figure 7: residual crush of sequential barrier tests and the linear model",
        x: Axis { name: "mean residual crush C", unit: "ft" },
        y: Axis { name: "E* = √(2 E_C/w)", unit: "√lbf" },
        curves: vec![
            Curve {
                name: format!("NHTSA: {}", line(&geometry.crush)),
                style: Style::Line,
                points: curve(|depth| geometry.crush.crush_intensity(depth)),
            },
            Curve {
                name: format!("fitted to measured e: {}", line(fitted)),
                style: Style::Line,
                points: curve(|depth| fitted.crush_intensity(depth)),
            },
            Curve {
                name: "tests, measured e".into(),
                style: Style::Marks,
                points: intensities(series, reconstructions, Restitution::Measured),
            },
            Curve { name: "tests, e = 0".into(), style: Style::Marks, points: intensities(series, reconstructions, Restitution::None) },
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_points_on_a_line_is_that_line() {
        let points = [(0.0, 3.0), (0.5, 5.0), (2.0, 11.0)].map(|(x, y)| Point { x, y });
        let line = fitted_line(&points);
        assert!((line.onset - 3.0).abs() < 1e-12 && (line.slope - 4.0).abs() < 1e-12, "{line:?}");
        // Raising the middle point raises the mean.
        let line = fitted_line(&[points[0], Point { x: 0.5, y: 5.6 }, points[2]]);
        assert!((line.crush_intensity(2.5 / 3.0) - (19.6 / 3.0)).abs() < 1e-12);
    }

    #[test]
    fn the_figures_show_what_the_tables_hold() {
        let report = crate::run().expect("embedded");
        let table = report.table("Table B2").expect("there");
        for (number, column) in [(6, "test_E_C"), (7, "test_E*")] {
            let figure = report.figures.iter().find(|figure| figure.number == number).expect("there");
            let marks: Vec<&Curve> = figure.curves.iter().filter(|curve| curve.style == Style::Marks).collect();
            for (curve, rows) in marks.iter().zip([["1 0.18", "2 0.13", "3 0.12"], ["1 0.00", "2 0.00", "3 0.00"]]) {
                for (point, row) in curve.points.iter().zip(rows) {
                    assert_eq!(point.y, table.cell(row, column).expect("there").computed, "{number} {row}");
                }
                assert_eq!(curve.points.len(), 3);
            }
        }
    }

    #[test]
    fn the_energy_is_the_square_of_the_line() {
        let report = crate::run().expect("embedded");
        let [six, seven] = &report.figures[..] else { panic!("two figures") };
        for which in 0..2 {
            for (energy, line) in six.curves[which].points.iter().zip(&seven.curves[which].points) {
                // w = 5 ft in geometry.csv.
                assert!((energy.y / (2.5 * line.y * line.y) - 1.0).abs() < 1e-12 && energy.x == line.x);
            }
        }
    }
}
