//! Beside the picture of the impact: clocks, numbers and what each line means.

use planar_impact_app::scene::{Scene, VehicleInScene};
use planar_impact_app::units::{Measure, Units};

use super::view::{Frame, arrow_head};
use super::{SMALL, STYLES, dial, impact, thin};
use crate::svg::{INK, Svg, number};

const ROW: f64 = 21.0;

pub fn draw(svg: &mut Svg, scene: &Scene, units: Units, frame: Frame) {
    frame.draw(svg);
    for (i, vehicle) in scene.vehicles.iter().enumerate().filter(|(_, vehicle)| !vehicle.barrier) {
        dial::draw(svg, vehicle, i, units, (frame.x + frame.width * (0.25 + 0.5 * i as f64), frame.y + 72.0));
    }
    let mut y = frame.y + dial::HEIGHT + 26.0;
    svg.line((frame.x + 10.0, y - 20.0), (frame.x + frame.width - 10.0, y - 20.0), &thin());
    y = numbers(svg, scene, units, frame, y);
    svg.line((frame.x + 10.0, y - 10.0), (frame.x + frame.width - 10.0, y - 10.0), &thin());
    keys(svg, scene, frame, y + 12.0);
}

/// A row of numbers: what, its unit, and the number of a vehicle.
type Row<'a> = (&'a str, Measure, fn(&VehicleInScene) -> Option<f64>);

/// Draws the numbers of both vehicles. Returns where they end.
fn numbers(svg: &mut Svg, scene: &Scene, units: Units, frame: Frame, top: f64) -> f64 {
    const ROWS: [Row<'_>; 5] = [
        ("speed before", Measure::RoadSpeed, |vehicle| Some(vehicle.speed_before())),
        ("speed after", Measure::RoadSpeed, |vehicle| Some(vehicle.speed_after())),
        ("ΔV", Measure::RoadSpeed, |vehicle| Some(vehicle.delta_v_magnitude())),
        ("yaw before", Measure::YawRate, |vehicle| Some(vehicle.before.yaw_rate)),
        ("yaw after", Measure::YawRate, |vehicle| vehicle.after.yaw_rate),
    ];
    let right = |svg: &mut Svg, column: f64, y: f64, text: &str| {
        let (x, y) = (number(frame.x + column), number(y));
        svg.element_with(
            "text",
            &[("class", "number"), ("x", &x), ("y", &y), ("font-size", &number(SMALL)), ("text-anchor", "end"), ("fill", INK)],
            text,
        );
    };
    let columns = [frame.width - 74.0, frame.width - 10.0];
    for (number, column) in [1, 2].into_iter().zip(columns) {
        right(svg, column, top, &number.to_string());
    }
    let mut y = top;
    for (what, measure, value) in ROWS {
        y += ROW;
        svg.text((frame.x + 10.0, y), SMALL, "number", &format!("{what} [{}]", units.unit(measure)));
        for (vehicle, column) in scene.vehicles.iter().zip(columns) {
            let text = match (vehicle.barrier, value(vehicle)) {
                (true, _) => "fixed".to_owned(),
                (false, Some(value)) => units.number(measure, value, 1.0),
                (false, None) => "-".to_owned(),
            };
            right(svg, column, y, &text);
        }
    }
    y + ROW
}

/// Draws what each kind of line means.
fn keys(svg: &mut Svg, scene: &Scene, frame: Frame, top: f64) {
    let [one, two] = STYLES;
    let mut y = top;
    let mut row = |svg: &mut Svg, sample: &dyn Fn(&mut Svg, f64, f64), text: &str| {
        sample(svg, frame.x + 12.0, y);
        svg.text((frame.x + 70.0, y + 4.0), SMALL, "key", text);
        y += ROW;
    };
    row(
        svg,
        &|svg, x, y| {
            svg.line((x, y), (x + 34.0, y), &[("stroke", one.stroke), ("stroke-width", "3"), ("stroke-dasharray", "9 5")]);
            arrow_head(svg, (x, y), (x + 46.0, y), 8.0, &[("fill", "#ffffff"), ("stroke", one.stroke), ("stroke-width", "1.5")]);
        },
        "velocity before",
    );
    row(
        svg,
        &|svg, x, y| {
            svg.line((x, y), (x + 34.0, y), &[("stroke", two.stroke), ("stroke-width", "3")]);
            arrow_head(svg, (x, y), (x + 46.0, y), 8.0, &[("fill", two.stroke)]);
        },
        "velocity after",
    );
    row(
        svg,
        &|svg, x, y| {
            svg.line((x, y), (x + 30.0, y), &[("stroke", INK), ("stroke-width", "5")]);
            arrow_head(svg, (x, y), (x + 46.0, y), 12.0, &[("fill", INK)]);
        },
        "impulse, at its own scale",
    );
    if scene.crush_plane.is_some() {
        row(
            svg,
            &|svg, x, y| svg.line((x, y), (x + 46.0, y), &[("stroke", INK), ("stroke-width", "1.3"), ("stroke-dasharray", "14 4 3 4")]),
            "crush plane: n, t",
        );
    }
    row(
        svg,
        &|svg, x, y| {
            let r = 5.0;
            svg.circle((x + 23.0, y), r, &[("fill", "#ffffff"), ("stroke", INK), ("stroke-width", "1.5")]);
            svg.line((x + 15.0, y), (x + 31.0, y), &thin());
            svg.line((x + 23.0, y - 8.0), (x + 23.0, y + 8.0), &thin());
        },
        "impact center",
    );
    if scene.vehicles.iter().any(|vehicle| vehicle.damage.is_some()) {
        row(
            svg,
            &|svg, x, y| {
                let box_ = [(x + 4.0, y - 6.0), (x + 42.0, y - 6.0), (x + 42.0, y + 4.0), (x + 4.0, y + 7.0)];
                svg.points("polygon", &box_, &[("fill", "#303030"), ("fill-opacity", "0.35"), ("stroke", INK), ("stroke-width", "1.4")]);
            },
            "residual crush",
        );
    }
    if scene.vehicles.iter().any(|vehicle| vehicle.outline.is_some_and(|outline| !outline.is_given)) {
        row(
            svg,
            &|svg, x, y| svg.line((x, y), (x + 46.0, y), &[("stroke", one.stroke), ("stroke-width", "2"), ("stroke-dasharray", "7 4")]),
            "symbol, not an outline",
        );
    }
    if scene.vehicles.iter().any(|vehicle| vehicle.pdof_range.is_some()) {
        row(
            svg,
            &|svg, x, y| svg.points("polygon", &[(x, y), (x + 44.0, y - 8.0), (x + 44.0, y + 8.0)], &[("fill", "#d8d8d8")]),
            "interval of the PDOF",
        );
    }
    if scene.vehicles.iter().any(|vehicle| vehicle.speed_range.is_some()) {
        row(
            svg,
            &|svg, x, y| svg.line((x, y), (x + 46.0, y), &[("stroke", one.stroke), ("stroke-opacity", "0.35"), ("stroke-width", "11")]),
            "interval of the speed before",
        );
    }
    if scene.vehicles.iter().any(|vehicle| vehicle.after.velocity_sd.is_some()) {
        row(
            svg,
            &|svg, x, y| {
                let (x, y) = (number(x + 23.0), number(y));
                let place = [("cx", &*x), ("cy", &*y), ("rx", "20"), ("ry", "7")];
                svg.element("ellipse", &[&place[..], &impact::spread(two.stroke)].concat());
            },
            "2 sd of the velocity after",
        );
    }
    if scene.vehicles.iter().any(|vehicle| !vehicle.skids.is_empty()) {
        row(
            svg,
            &|svg, x, y| svg.line((x, y), (x + 46.0, y), &[("stroke", "#505050"), ("stroke-opacity", "0.55"), ("stroke-width", "5")]),
            "skid before",
        );
    }
    if scene.vehicles.iter().any(|vehicle| vehicle.slide.is_some()) {
        row(svg, &|svg, x, y| svg.line((x, y), (x + 46.0, y), &[("stroke", "#707070"), ("stroke-width", "1")]), "wheel track");
    }
}
