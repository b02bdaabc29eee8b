//! The principal direction of force on a clock, 12 straight ahead.

use planar_impact_app::scene::VehicleInScene;
use planar_impact_app::units::{Measure, Units};

use super::vehicle::name;
use super::view::arrow_head;
use super::{SMALL, STYLES, Style, TEXT, thin};
use crate::svg::{INK, Place, Svg, fitting, number};

const RADIUS: f64 = 46.0;
/// Width of a dial with its numbers.
pub const WIDTH: f64 = 128.0;
pub const HEIGHT: f64 = 190.0;

/// Draws the clock of a vehicle below and around a place in its middle.
pub fn draw(svg: &mut Svg, vehicle: &VehicleInScene, which: usize, units: Units, middle: Place) {
    let Style { stroke, fill } = STYLES[which];
    let rim = |angle: f64, radius: f64| (middle.0 + radius * libm::sin(angle), middle.1 - radius * libm::cos(angle));
    let centered = |svg: &mut Svg, y: f64, size: f64, text: &str| {
        let (x, y, size) = (number(middle.0), number(y), number(size));
        svg.element_with(
            "text",
            &[("class", "label"), ("x", &x), ("y", &y), ("font-size", &size), ("text-anchor", "middle"), ("fill", INK)],
            text,
        );
    };
    svg.group(&[("class", &format!("clock clock-{}", which + 1))], |svg| {
        svg.title(&format!("principal direction of force of {}", name(vehicle)));
        svg.circle(middle, RADIUS, &[("fill", "#ffffff"), ("stroke", INK), ("stroke-width", "1.2")]);
        if let Some([low, high]) = vehicle.pdof_range.filter(|[low, high]| high - low < std::f64::consts::TAU) {
            let (from, to, r) = (rim(low, RADIUS), rim(high, RADIUS), number(RADIUS));
            let is_large = u8::from(high - low > std::f64::consts::PI);
            let n = number;
            let path = format!(
                "M {} {} L {} {} A {r} {r} 0 {is_large} 1 {} {} Z",
                n(middle.0),
                n(middle.1),
                n(from.0),
                n(from.1),
                n(to.0),
                n(to.1)
            );
            svg.element("path", &[("class", "pdof-range"), ("d", &path), ("fill", "#d8d8d8"), ("stroke", "none")]);
        }
        for hour in 0..12 {
            let angle = f64::from(hour) * std::f64::consts::FRAC_PI_6;
            let inner = if hour % 3 == 0 { 8.0 } else { 4.0 };
            svg.line(rim(angle, RADIUS), rim(angle, RADIUS - inner), &thin());
        }
        for hour in [12, 3, 6, 9] {
            let (x, y) = rim(f64::from(hour) * std::f64::consts::FRAC_PI_6, RADIUS + 9.0);
            let (x, y) = (number(x), number(y + 4.0));
            svg.element_with(
                "text",
                &[("class", "hour"), ("x", &x), ("y", &y), ("font-size", "11"), ("text-anchor", "middle"), ("fill", INK)],
                &hour.to_string(),
            );
        }
        let body: Vec<Place> =
            [(-9.0, 20.0), (-9.0, -14.0), (0.0, -22.0), (9.0, -14.0), (9.0, 20.0)].map(|(x, y)| (middle.0 + x, middle.1 + y)).to_vec();
        svg.points("polygon", &body, &[("fill", fill), ("stroke", stroke), ("stroke-width", "1.5")]);
        let (from, tip) = (rim(vehicle.pdof, RADIUS), rim(vehicle.pdof, 10.0));
        svg.line(from, rim(vehicle.pdof, 18.0), &[("class", "pdof"), ("stroke", INK), ("stroke-width", "4")]);
        arrow_head(svg, from, tip, 10.0, &[("fill", INK)]);
    });
    centered(svg, middle.1 + RADIUS + 36.0, TEXT, &fitting(&format!("{} {}", which + 1, vehicle.name), TEXT, WIDTH));
    centered(svg, middle.1 + RADIUS + 54.0, SMALL, &format!("PDOF {}", super::quantity(units, Measure::Angle, vehicle.pdof)));
    centered(svg, middle.1 + RADIUS + 70.0, SMALL, &format!("{} o'clock", vehicle.pdof_clock()));
}
