//! The picture of what comes before and after: skids, slides to rest, rest positions.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::scene::Scene;
use planar_impact_app::slide::{RestPose, VehicleSlide};
use planar_impact_app::units::{Measure, Units};

use super::STYLES;
use super::labels::Labels;
use super::vehicle::{self, Detail, at_impact, extent};
use super::view::{Frame, View};
use crate::svg::{INK, Place, Svg, number};

/// Returns `true` if there is anything before or after the impact to show.
pub fn is_needed(scene: &Scene) -> bool {
    scene.vehicles.iter().any(|vehicle| !vehicle.skids.is_empty() || vehicle.slide.is_some() || vehicle.rest.is_some())
}

pub fn draw(svg: &mut Svg, scene: &Scene, units: Units, frame: Frame) {
    let view = View::of(points(scene).into_iter(), frame, 40.0);
    frame.draw(svg);
    let mut labels = Labels::in_frame(frame);
    svg.group(&[("class", "overview")], |svg| {
        for (which, vehicle) in scene.vehicles.iter().enumerate().filter(|(_, vehicle)| !vehicle.barrier) {
            let stroke = STYLES[which].stroke;
            for (k, [from, to]) in vehicle.skids.iter().enumerate() {
                let (a, b) = (view.place(*from), view.place(*to));
                svg.line(
                    a,
                    b,
                    &[
                        ("class", &format!("skid skid-{}", which + 1)),
                        ("stroke", "#505050"),
                        ("stroke-width", "5"),
                        ("stroke-opacity", "0.55"),
                    ],
                );
                labels.avoid(a, b);
                let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
                let middle = ((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0);
                labels.want(
                    middle,
                    "skid-length",
                    format!("skid {}of {}: {}", part(k, vehicle.skids.len()), which + 1, units.quantity(Measure::Length, length)),
                );
            }
            vehicle::draw(svg, &view, vehicle, which, &at_impact(vehicle), Detail::Faint);
            if let Some(slide) = &vehicle.slide {
                tracks(svg, &view, slide, stroke, &mut labels);
                vehicle::draw(svg, &view, vehicle, which, &slide.rest, Detail::Small);
            }
            if let Some(rest) = &vehicle.rest {
                let pose = RestPose { position: rest.position, heading: rest.heading };
                if vehicle.slide.is_none() {
                    vehicle::draw(svg, &view, vehicle, which, &pose, Detail::Small);
                }
                for point in &rest.points {
                    let name = point.wheel.map_or_else(|| "the center of mass".to_owned(), |wheel| wheel.replace('_', " "));
                    let title = format!("point that {name} passed, with two standard deviations");
                    given(svg, &view, &format!("given-point given-point-{}", which + 1), &title, point.position, point.position_sd, 3.0);
                }
                let title = "rest position of the case, with two standard deviations";
                given(svg, &view, &format!("given-rest given-rest-{}", which + 1), title, rest.position, rest.position_sd, 5.0);
            }
            let rest = vehicle.slide.as_ref().map(|slide| slide.rest.position).or(vehicle.rest.as_ref().map(|rest| rest.position));
            if let Some(rest) = rest {
                labels.want(view.place(rest), "rest", format!("{} {} at rest", which + 1, shorten(&vehicle.name, 18)));
            }
        }
        for covered in view.bar(svg, units) {
            labels.keep_clear(covered);
        }
        labels.want(view.place(scene.impact_point), "impact", "impact".to_owned());
        labels.draw(svg);
    });
}

/// Returns the number of one of several.
fn part(k: usize, count: usize) -> String {
    if count > 1 { format!("{} ", k + 1) } else { String::new() }
}

/// Returns the height of the picture, for its width.
pub fn height(scene: &Scene, width: f64, most: f64) -> f64 {
    let points = points(scene);
    let size = |k: usize| {
        let values = points.iter().map(|point| point[k]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    (width * size(1) / size(0) + 100.0).clamp(150.0, most)
}

fn points(scene: &Scene) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for vehicle in scene.vehicles.iter().filter(|vehicle| !vehicle.barrier) {
        points.extend(extent(vehicle, &at_impact(vehicle)));
        points.extend(vehicle.skids.iter().flatten());
        if let Some(slide) = &vehicle.slide {
            points.extend(slide.path.iter().flat_map(|state| state.wheels.into_iter().chain([[state.x, state.y]])));
            points.extend(extent(vehicle, &slide.rest));
        }
        if let Some(rest) = &vehicle.rest {
            points.extend(extent(vehicle, &RestPose { position: rest.position, heading: rest.heading }));
            points.extend(around(rest.position, rest.position_sd));
            points.extend(rest.points.iter().flat_map(|point| around(point.position, point.position_sd)));
        }
    }
    points
}

/// Returns the corners around the ellipse of two standard deviations.
fn around(place: [f64; 2], sd: [f64; 2]) -> [[f64; 2]; 2] {
    [-2.0, 2.0].map(|count| [0, 1].map(|axis| place[axis] + count * sd[axis]))
}

/// Draws the path of the center of mass and the tracks of the wheels.
fn tracks(svg: &mut Svg, view: &View, slide: &VehicleSlide, stroke: &str, labels: &mut Labels) {
    for wheel in 0..4 {
        let track: Vec<Place> = slide.path.iter().map(|state| view.place(state.wheels[wheel])).collect();
        track.windows(2).step_by(2).for_each(|pair| labels.avoid(pair[0], pair[1]));
        svg.points("polyline", &track, &[("class", "wheel-track"), ("fill", "none"), ("stroke", "#707070"), ("stroke-width", "1")]);
    }
    let path: Vec<Place> = slide.path.iter().map(|state| view.place([state.x, state.y])).collect();
    svg.points(
        "polyline",
        &path,
        &[("class", &format!("path path-{}", slide.vehicle)), ("fill", "none"), ("stroke", stroke), ("stroke-width", "2.5")],
    );
    for pair in path.windows(2) {
        labels.avoid(pair[0], pair[1]);
    }
}

/// Draws a place of the case as a cross of some size, with the ellipse of two standard deviations.
fn given(svg: &mut Svg, view: &View, class: &str, title: &str, position: [f64; 2], sd: [f64; 2], size: f64) {
    let (x, y) = view.place(position);
    let numbers = [x, y, (2.0 * sd[0] * view.scale).max(1.0), (2.0 * sd[1] * view.scale).max(1.0)].map(number);
    svg.group(&[("class", class), ("stroke", INK), ("stroke-width", "1.2"), ("fill", "none")], |svg| {
        svg.title(title);
        svg.element(
            "ellipse",
            &[("cx", &numbers[0]), ("cy", &numbers[1]), ("rx", &numbers[2]), ("ry", &numbers[3]), ("stroke-dasharray", "4 3")],
        );
        svg.line((x - size, y), (x + size, y), &[]);
        svg.line((x, y - size), (x, y + size), &[]);
    });
}
