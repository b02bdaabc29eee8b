//! The picture of the impact: vehicles, crush plane, impulses, velocities and rotation.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::scene::{Deviations, Scene, VehicleInScene};
use planar_impact_app::units::{Measure, Units};

use super::barrier;
use super::labels::Labels;
use super::vehicle::{self, Detail, at_impact, extent};
use super::view::{Frame, View, arrow_head};
use super::{Placing, STYLES, Style};
use crate::svg::{INK, Place, Svg, number};

/// Lengths on the ground of the longest velocity and of the impulse, over the size of the vehicles.
const VELOCITY: f64 = 0.75;
const IMPULSE: f64 = 0.5;
/// Length of the normal of the crush plane, over the size of the vehicles.
const NORMAL: f64 = 0.42;
/// Room for labels around the picture, in pixels.
const ROOM: f64 = 46.0;

/// The width of a line on which a label can be read.
const THIN: f64 = 4.0;

/// What a vector shows.
struct Vector<'a> {
    class: String,
    title: String,
    from: [f64; 2],
    to: [f64; 2],
    color: &'a str,
    width: f64,
    is_dashed: bool,
    label: String,
}

pub fn draw(svg: &mut Svg, scene: &Scene, units: Units, frame: Frame) {
    let size = size(scene);
    let vectors = vectors(scene, units, size);
    let plane = plane(scene, size);
    let view = view(scene, &vectors, plane.as_ref(), frame);
    frame.draw(svg);
    let mut labels = Labels::in_frame(frame);
    for (i, vehicle) in scene.vehicles.iter().enumerate() {
        if vehicle.barrier {
            barrier::draw(svg, &view, scene, i, size);
        } else {
            vehicle::draw(svg, &view, vehicle, i, &at_impact(vehicle), Detail::Full);
            for wheel in vehicle.outline.and_then(|outline| outline.wheels).into_iter().flatten() {
                let ends = [-0.3, 0.3].map(|by| view.place(vehicle.on_ground([wheel[0] + by, wheel[1]])));
                labels.avoid(ends[0], ends[1]);
            }
            let corners: Vec<Place> = extent(vehicle, &at_impact(vehicle)).into_iter().map(|corner| view.place(corner)).collect();
            for k in 0..corners.len() {
                labels.avoid(corners[k], corners[(k + 1) % corners.len()]);
            }
        }
    }
    if let Some(plane) = &plane {
        draw_plane(svg, &view, plane, &mut labels);
    }
    for (i, vehicle) in scene.vehicles.iter().enumerate() {
        speed_range(svg, &view, scene, vehicle, i, size);
        velocity_deviations(svg, &view, scene, vehicle, i, size);
    }
    axes_of_ellipses(scene, size).for_each(|[from, to]| labels.avoid(view.place(from), view.place(to)));
    for vector in &vectors {
        arrow(svg, &view, vector);
        let note = if vector.width > THIN { Labels::avoid_thick } else { Labels::avoid };
        note(&mut labels, view.place(vector.from), view.place(vector.to));
    }
    let point = view.place(scene.impact_point);
    svg.group(&[("class", "impact-center"), ("stroke", INK), ("stroke-width", "1.5")], |svg| {
        svg.title("impact center");
        svg.circle(point, 5.0, &[("fill", "#ffffff")]);
        svg.line((point.0 - 8.0, point.1), (point.0 + 8.0, point.1), &[]);
        svg.line((point.0, point.1 - 8.0), (point.0, point.1 + 8.0), &[]);
    });
    for (i, vehicle) in scene.vehicles.iter().enumerate().filter(|(_, vehicle)| !vehicle.barrier) {
        rotation(svg, &view, vehicle, i, units, &mut labels);
    }
    for covered in view.bar(svg, units) {
        labels.keep_clear(covered);
    }
    labels.keep_clear(Frame { x: point.0 - 9.0, y: point.1 - 9.0, width: 18.0, height: 18.0 });
    for vehicle in scene.vehicles.iter().filter(|vehicle| !vehicle.barrier) {
        let (x, y) = view.place(vehicle.position);
        labels.keep_clear(Frame { x: x - 8.0, y: y - 8.0, width: 16.0, height: 16.0 });
    }
    // The axes first, whose letters say nothing elsewhere, then the arrows on which nothing can be read.
    if let (Some(gamma), Some([tangent, normal])) = (scene.crush_plane, plane) {
        labels.want(view.place(normal[1]), "normal", format!("n (Γ = {})", units.quantity(Measure::Angle, gamma)));
        labels.want(view.place(tangent[1]), "tangent", "t".to_owned());
    }
    let (thick, thin): (Vec<_>, Vec<_>) = vectors.into_iter().partition(|vector| vector.width > THIN);
    for vector in thick.into_iter().chain(thin) {
        let tip = view.place(vector.to);
        labels.want(tip, &vector.class, vector.label);
    }
    for (number, vehicle) in (1..).zip(&scene.vehicles) {
        let at = if vehicle.barrier { barrier::behind(scene, number - 1, size) } else { tail(vehicle) };
        labels.want(view.place(at), "name", format!("{number} {}", shorten(&vehicle.name, 24)));
    }
    labels.draw(svg);
}

/// Returns the view that shows the vehicles, the vectors and the crush plane.
fn view(scene: &Scene, vectors: &[Vector<'_>], plane: Option<&[[[f64; 2]; 2]; 2]>, frame: Frame) -> View {
    let moving = scene.vehicles.iter().filter(|vehicle| !vehicle.barrier);
    let points = moving.flat_map(|vehicle| extent(vehicle, &at_impact(vehicle)));
    let points =
        points.chain(vectors.iter().flat_map(|vector| [vector.from, vector.to])).chain(plane.into_iter().flatten().flatten().copied());
    View::of(points.chain(axes_of_ellipses(scene, size(scene)).flatten()), frame, ROOM)
}

/// Returns how the picture lies on the page.
pub fn placing(scene: &Scene, units: Units, frame: Frame) -> Placing {
    let size = size(scene);
    let view = view(scene, &vectors(scene, units, size), plane(scene, size).as_ref(), frame);
    let fastest = fastest(scene);
    Placing {
        origin: view.origin(),
        scale: view.scale,
        speed: if fastest > 0.0 { VELOCITY * size / fastest } else { 0.0 },
        normal: NORMAL * size,
    }
}

/// Returns the size of the vehicles: the longest outline, in m.
pub fn size(scene: &Scene) -> f64 {
    let longest =
        scene.vehicles.iter().filter_map(|vehicle| vehicle.outline).map(|outline| outline.front + outline.rear).fold(0.0, f64::max);
    if longest > 0.0 { longest } else { 4.0 }
}

/// Where the name of a vehicle belongs: the middle of its rear half.
fn tail(vehicle: &VehicleInScene) -> [f64; 2] {
    vehicle.outline.map_or(vehicle.position, |outline| vehicle.on_ground([-0.6 * outline.rear, 0.0]))
}

/// Returns the tangent and the normal of the crush plane through the impact center, each from its tail to its tip.
fn plane(scene: &Scene, size: f64) -> Option<[[[f64; 2]; 2]; 2]> {
    let (sin, cos) = libm::sincos(scene.crush_plane?);
    let at = |along: f64, [x, y]: [f64; 2]| [scene.impact_point[0] + along * size * x, scene.impact_point[1] + along * size * y];
    Some([[at(-0.45, [-sin, cos]), at(0.5, [-sin, cos])], [at(0.0, [cos, sin]), at(NORMAL, [cos, sin])]])
}

fn draw_plane(svg: &mut Svg, view: &View, plane: &[[[f64; 2]; 2]; 2], labels: &mut Labels) {
    svg.group(&[("class", "crush-plane"), ("stroke", INK), ("fill", INK), ("stroke-width", "1.3")], |svg| {
        svg.title("crush plane with its normal n and tangent t");
        for (class, [from, to]) in ["tangent", "normal"].into_iter().zip(plane) {
            let (from, to) = (view.place(*from), view.place(*to));
            svg.line(from, to, &[("class", class), ("stroke-dasharray", "14 4 3 4")]);
            arrow_head(svg, from, to, 6.0, &[("stroke", "none")]);
            labels.avoid(from, to);
        }
    });
}

/// Returns the greatest speed, which the longest arrow shows.
fn fastest(scene: &Scene) -> f64 {
    scene.vehicles.iter().flat_map(|vehicle| [vehicle.speed_before(), vehicle.speed_after()]).fold(0.0, f64::max)
}

/// Returns the tip of an arrow, where `unit` is as long as `length`.
fn plus(from: [f64; 2], by: [f64; 2], unit: f64, length: f64) -> [f64; 2] {
    if unit > 0.0 { [from[0] + length * (by[0] / unit), from[1] + length * (by[1] / unit)] } else { from }
}

/// Draws the interval of the speed before as a band along its arrow.
fn speed_range(svg: &mut Svg, view: &View, scene: &Scene, vehicle: &VehicleInScene, which: usize, size: f64) {
    let (Some(range), speed, fastest) = (vehicle.speed_range, vehicle.speed_before(), fastest(scene)) else { return };
    if speed <= 1e-9 * fastest {
        return;
    }
    let ends = range
        .map(|end| view.place(plus(vehicle.position, vehicle.before.velocity.map(|part| part * (end / speed)), fastest, VELOCITY * size)));
    let class = format!("speed-range speed-range-{}", which + 1);
    svg.line(ends[0], ends[1], &[("class", &class), ("stroke", STYLES[which].stroke), ("stroke-opacity", "0.35"), ("stroke-width", "11")]);
}

/// Where the ellipse of two standard deviations of a velocity after is on the ground.
struct Ellipse {
    center: [f64; 2],
    /// Along the greater deviation and across it.
    semi_axes: [f64; 2],
    angle: f64,
}

/// Returns the ellipse around the tip of a velocity after.
fn ellipse(scene: &Scene, vehicle: &VehicleInScene, size: f64) -> Option<Ellipse> {
    let (Deviations { sd, angle }, fastest) = (vehicle.after.velocity_sd?, fastest(scene));
    let center = plus(vehicle.position, vehicle.after.velocity, fastest, VELOCITY * size);
    (fastest > 0.0).then(|| Ellipse { center, semi_axes: sd.map(|sd| 2.0 * sd * VELOCITY * size / fastest), angle })
}

/// Returns the ends of both axes of each ellipse.
fn axes_of_ellipses(scene: &Scene, size: f64) -> impl Iterator<Item = [[f64; 2]; 2]> {
    scene.vehicles.iter().filter_map(move |vehicle| ellipse(scene, vehicle, size)).flat_map(
        |Ellipse { center: [x, y], semi_axes, angle }| {
            let (sin, cos) = libm::sincos(angle);
            let [along, across] = semi_axes;
            [[along * cos, along * sin], [-across * sin, across * cos]].map(|[dx, dy]| [[x + dx, y + dy], [x - dx, y - dy]])
        },
    )
}

/// Draws the ellipse of two standard deviations around the tip of the velocity after.
fn velocity_deviations(svg: &mut Svg, view: &View, scene: &Scene, vehicle: &VehicleInScene, which: usize, size: f64) {
    let Some(Ellipse { center, semi_axes, angle }) = ellipse(scene, vehicle, size) else { return };
    let (x, y) = view.place(center);
    let [along, across] = semi_axes.map(|length| number(view.scale * length));
    // On the page y points down, and a positive angle turns clockwise.
    let turn = format!("rotate({} {} {})", number(-angle.to_degrees()), number(x), number(y));
    let stroke = STYLES[which].stroke;
    svg.group(&[("class", &format!("velocity-sd velocity-sd-{}", which + 1))], |svg| {
        svg.title(&format!("velocity of {} after, two standard deviations", vehicle::name(vehicle)));
        let (x, y) = (number(x), number(y));
        let place = [("cx", &*x), ("cy", &*y), ("rx", &*along), ("ry", &*across), ("transform", &*turn)];
        svg.element("ellipse", &[&place[..], &spread(stroke)].concat());
    });
}

/// Returns how an ellipse of deviations is drawn.
pub fn spread(stroke: &str) -> [(&str, &str); 4] {
    [("fill", stroke), ("fill-opacity", "0.15"), ("stroke", stroke), ("stroke-dasharray", "4 3")]
}

fn vectors(scene: &Scene, units: Units, size: f64) -> Vec<Vector<'static>> {
    let fastest = fastest(scene);
    let impulse = libm::hypot(scene.impulse[0], scene.impulse[1]);
    let mut vectors = Vec::new();
    for (i, vehicle) in scene.vehicles.iter().enumerate().filter(|(_, vehicle)| !vehicle.barrier) {
        let Style { stroke, .. } = STYLES[i];
        let motions =
            [("before", vehicle.before.velocity, vehicle.speed_before()), ("after", vehicle.after.velocity, vehicle.speed_after())];
        for (when, velocity, speed) in motions {
            if speed <= 1e-9 * fastest {
                continue;
            }
            let label = format!("{} {when}: {}", i + 1, units.quantity(Measure::RoadSpeed, speed));
            vectors.push(Vector {
                class: format!("velocity-{when}-{}", i + 1),
                title: format!("velocity of {}, {label}", vehicle::name(vehicle)),
                from: vehicle.position,
                to: plus(vehicle.position, velocity, fastest, VELOCITY * size),
                color: stroke,
                width: 3.0,
                is_dashed: when == "before",
                label,
            });
        }
        let sign = if i == 0 { 1.0 } else { -1.0 };
        if impulse > 0.0 {
            let letter = if i == 0 { "P" } else { "−P" };
            let label = format!("{letter} on {}: {}", i + 1, units.quantity(Measure::Impulse, impulse));
            vectors.push(Vector {
                class: format!("impulse-{}", i + 1),
                title: format!("impulse on {}", vehicle::name(vehicle)),
                from: scene.impact_point,
                to: plus(scene.impact_point, scene.impulse.map(|part| sign * part), impulse, IMPULSE * size),
                color: INK,
                width: 5.0,
                is_dashed: false,
                label,
            });
        }
    }
    vectors
}

fn arrow(svg: &mut Svg, view: &View, vector: &Vector<'_>) {
    let (from, tip) = (view.place(vector.from), view.place(vector.to));
    let width = number(vector.width);
    svg.group(&[("class", &format!("vector {}", vector.class))], |svg| {
        svg.title(&vector.title);
        let head = 3.0 + 2.0 * vector.width;
        // The line ends inside the head.
        let (dx, dy) = (tip.0 - from.0, tip.1 - from.1);
        let share = 1.0 - (head / libm::hypot(dx, dy).max(1e-9)).min(1.0);
        let end = (from.0 + share * dx, from.1 + share * dy);
        let dashes = if vector.is_dashed { "9 5" } else { "none" };
        svg.line(from, end, &[("stroke", vector.color), ("stroke-width", &width), ("stroke-dasharray", dashes)]);
        let fill = if vector.is_dashed { "#ffffff" } else { vector.color };
        arrow_head(svg, from, tip, head, &[("fill", fill), ("stroke", vector.color), ("stroke-width", "1.5")]);
    });
}

/// Draws the yaw rate after the impact as an arc around the center of mass; a longer one is faster.
fn rotation(svg: &mut Svg, view: &View, vehicle: &VehicleInScene, which: usize, units: Units, labels: &mut Labels) {
    let Some(rate) = vehicle.after.yaw_rate.filter(|rate| rate.abs() > 1e-6) else { return };
    let Style { stroke, .. } = STYLES[which];
    let center = view.place(vehicle.position);
    let radius = vehicle.outline.map_or(26.0, |outline| (0.72 * outline.half_width * view.scale).clamp(16.0, 60.0));
    // A quarter turn for a quarter turn a second, within what an arc can show.
    let sweep = rate.signum() * rate.abs().clamp(0.35, 4.7);
    let start = vehicle.heading + std::f64::consts::FRAC_PI_2;
    let at = |angle: f64| (center.0 + radius * libm::cos(angle), center.1 - radius * libm::sin(angle));
    let (from, tip) = (at(start), at(start + sweep));
    let is_large = u8::from(sweep.abs() > std::f64::consts::PI);
    // On the page a counter-clockwise arc has the sweep flag 0.
    let flag = u8::from(sweep < 0.0);
    let r = number(radius);
    let path = format!("M {} {} A {r} {r} 0 {is_large} {flag} {} {}", number(from.0), number(from.1), number(tip.0), number(tip.1));
    svg.group(&[("class", &format!("rotation rotation-{}", which + 1))], |svg| {
        svg.title(&format!("yaw rate of {} after", vehicle::name(vehicle)));
        svg.element("path", &[("d", &path), ("fill", "none"), ("stroke", stroke), ("stroke-width", "2")]);
        let before = at(start + sweep - rate.signum() * (14.0 / radius));
        arrow_head(svg, before, tip, 7.0, &[("fill", stroke)]);
    });
    for k in 0..8 {
        let part = |k: i32| at(start + sweep * f64::from(k) / 8.0);
        labels.avoid(part(k), part(k + 1));
    }
    labels.want(tip, &format!("yaw-rate-{}", which + 1), units.quantity(Measure::YawRate, rate));
}
