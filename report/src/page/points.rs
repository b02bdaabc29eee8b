//! Points along a path, beside the path.

use planar_impact_app::slide::PointFit;
use planar_impact_app::units::{Measure, Units};

use crate::block::Table;

/// Renders points with the places of the path that are nearest to them.
pub fn table(head: &str, points: &[PointFit], units: Units) -> Table {
    let length = |value: f64| units.number(Measure::Length, value, 1.0);
    let row = |(point, number): (&PointFit, usize)| {
        let what = point.wheel.map_or_else(|| "center of mass".to_owned(), |wheel| wheel.replace('_', " "));
        let place = |[x, y]: [f64; 2]| format!("{}, {}", length(x), length(y));
        let end = if point.is_end { " (end)" } else { "" };
        vec![
            format!("{number} {what}"),
            place(point.given),
            place(point.sd),
            format!("{}{end}", place(point.computed)),
            units.number(Measure::Time, point.time, 1.0),
            format!("{:.2}", point.standardised_residual),
        ]
    };
    let unit = units.unit(Measure::Length);
    let header = [
        head.to_owned(),
        format!("given {unit}"),
        "sd".to_owned(),
        "path".to_owned(),
        units.unit(Measure::Time).to_owned(),
        "residual".to_owned(),
    ];
    Table::new(header, "lrrrrr", points.iter().zip(1..).map(row).collect()).narrow()
}
