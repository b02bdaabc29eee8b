//! A vehicle on a plan: its outline, wheels, damage, heading and center of mass.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::scene::{Damage, VehicleInScene};
use planar_impact_app::slide::RestPose;

use super::view::{View, arrow_head};
use super::{STYLES, Style};
use crate::svg::{INK, Place, Svg};

/// Returns places on the page of points in the axes of a vehicle at a pose.
pub fn placed(view: &View, pose: &RestPose, points: &[[f64; 2]]) -> Vec<Place> {
    let (sin, cos) = libm::sincos(pose.heading);
    let on_ground =
        |[forward, left]: [f64; 2]| [pose.position[0] + forward * cos - left * sin, pose.position[1] + forward * sin + left * cos];
    points.iter().map(|point| view.place(on_ground(*point))).collect()
}

/// Returns the pose of a vehicle at the impact.
pub fn at_impact(vehicle: &VehicleInScene) -> RestPose {
    RestPose { position: vehicle.position, heading: vehicle.heading }
}

/// Returns the corners of a vehicle on the ground at a pose; the center of mass of a mass point.
pub fn extent(vehicle: &VehicleInScene, pose: &RestPose) -> Vec<[f64; 2]> {
    let posed = VehicleInScene { position: pose.position, heading: pose.heading, ..vehicle.clone() };
    vehicle.outline.map_or(vec![pose.position], |outline| outline.corners().map(|corner| posed.on_ground(corner)).to_vec())
}

/// Returns the name of a vehicle for a title.
pub fn name(vehicle: &VehicleInScene) -> String {
    shorten(&vehicle.name, 60)
}

/// How a vehicle is drawn.
#[derive(Clone, Copy, PartialEq)]
pub enum Detail {
    /// Everything, with the name of what it is.
    Full,
    /// Outline and heading.
    Small,
    /// The same, faint.
    Faint,
}

/// Draws vehicle 0 or 1 at a pose. What is below shows through.
pub fn draw(svg: &mut Svg, view: &View, vehicle: &VehicleInScene, which: usize, pose: &RestPose, detail: Detail) {
    let Style { stroke, fill } = STYLES[which];
    let is_full = detail == Detail::Full;
    let opacity = if detail == Detail::Faint { "0.45" } else { "1" };
    let class = format!("vehicle vehicle-{}", which + 1);
    svg.group(&[("class", &class), ("opacity", opacity)], |svg| {
        svg.title(&name(vehicle));
        let center = view.place(pose.position);
        let Some(outline) = &vehicle.outline else {
            svg.circle(center, 7.0, &[("class", "mass-point"), ("fill", fill), ("stroke", stroke), ("stroke-width", "2")]);
            return;
        };
        let place = |points: &[[f64; 2]]| placed(view, pose, points);
        let dashes = if outline.is_given { "none" } else { "7 4" };
        let (width, head) = if is_full { ("2", 8.0) } else { ("1.4", 5.0) };
        svg.points(
            "polygon",
            &place(&outline.corners()),
            &[
                ("class", "outline"),
                ("fill", fill),
                ("fill-opacity", "0.6"),
                ("stroke", stroke),
                ("stroke-width", width),
                ("stroke-dasharray", dashes),
                ("stroke-linejoin", "round"),
            ],
        );
        // The front is where the windshield is.
        let (length, half) = (outline.front + outline.rear, outline.half_width);
        let [front, rear] = [0.70, 0.60].map(|share| share * length - outline.rear);
        let glass = [[front, 0.7 * half], [front, -0.7 * half], [rear, -0.82 * half], [rear, 0.82 * half]];
        svg.points("polygon", &place(&glass), &[("class", "windshield"), ("fill", stroke), ("fill-opacity", "0.3"), ("stroke", "none")]);
        let nose = place(&[[0.0, 0.0], [outline.front, 0.0]]);
        svg.line(nose[0], nose[1], &[("class", "heading"), ("stroke", stroke), ("stroke-width", "1.2"), ("stroke-dasharray", "8 3 2 3")]);
        arrow_head(svg, nose[0], nose[1], head, &[("fill", stroke)]);
        if is_full {
            for wheel in outline.wheels.iter().flatten() {
                let rim = place(&[[wheel[0] - 0.3, wheel[1]], [wheel[0] + 0.3, wheel[1]]]);
                svg.line(rim[0], rim[1], &[("class", "wheel"), ("stroke", "#404040"), ("stroke-width", "5")]);
            }
            if let Some(damage) = &vehicle.damage {
                draw_damage(svg, &place, damage);
            }
            center_of_mass(svg, center);
        }
    });
}

/// Draws the residual crush between the undamaged surface and the crushed one, with the depth at each station.
fn draw_damage(svg: &mut Svg, place: &dyn Fn(&[[f64; 2]]) -> Vec<Place>, damage: &Damage) {
    let mut ring = place(&damage.undamaged);
    ring.extend(place(&damage.crushed).into_iter().rev());
    let class = format!("damage damage-{}", damage.surface);
    svg.points(
        "polygon",
        &ring,
        &[("class", &class), ("fill", "#303030"), ("fill-opacity", "0.35"), ("stroke", INK), ("stroke-width", "1.4")],
    );
    let stations = place(&damage.undamaged).into_iter().zip(place(&damage.crushed));
    for (surface, depth) in stations {
        svg.line(surface, depth, &[("class", "depth"), ("stroke", INK), ("stroke-width", "0.8")]);
    }
    for border in place(&damage.borders) {
        svg.circle(border, 3.0, &[("class", "zone"), ("fill", "#ffffff"), ("stroke", INK)]);
    }
}

/// The symbol of a center of mass: a circle with two dark quarters.
fn center_of_mass(svg: &mut Svg, (x, y): Place) {
    let r = 6.0;
    svg.circle((x, y), r, &[("class", "center-of-mass"), ("fill", "#ffffff"), ("stroke", INK), ("stroke-width", "1.2")]);
    let n = crate::svg::number;
    let quarter = |sign: f64| format!("M {} {} L {} {} A {r} {r} 0 0 1 {} {} Z", n(x), n(y), n(x), n(y - sign * r), n(x + sign * r), n(y));
    svg.element("path", &[("d", &quarter(1.0)), ("fill", INK)]);
    svg.element("path", &[("d", &quarter(-1.0)), ("fill", INK)]);
}
