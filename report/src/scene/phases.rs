//! The phases of a collision as small pictures.

use planar_impact_app::scene::{Phase, Scene};
use planar_impact_app::slide::RestPose;
use planar_impact_app::units::{Measure, Units};

use super::vehicle::{self, Detail, extent};
use super::view::{Frame, View, arrow_head};
use super::{SMALL, STYLES, barrier, impact};
use crate::svg::Svg;

const GAP: f64 = 10.0;
/// Room for the name of a phase, in pixels.
const NAME: f64 = 24.0;

pub fn draw(svg: &mut Svg, scene: &Scene, units: Units, frame: Frame) {
    let count = scene.phases.len().max(1) as f64;
    let width = (frame.width - GAP * (count - 1.0)) / count;
    let timed: Vec<[f64; 2]> =
        scene.phases.iter().filter(|phase| phase.time.is_some()).flat_map(|phase| points(scene, phase)).chain(walls(scene)).collect();
    let arrows: Vec<_> = scene.phases.iter().flat_map(|phase| arrows(scene, phase, frame.height - NAME)).collect();
    for (i, phase) in scene.phases.iter().enumerate() {
        let frame = Frame { x: frame.x + i as f64 * (width + GAP), width, ..frame };
        let picture = Frame { y: frame.y + NAME, height: frame.height - NAME, ..frame };
        // Phases around the impact have one scale; rest has its own.
        let view = if phase.time.is_some() {
            View::with_arrows(&timed, &arrows, picture, 16.0)
        } else {
            View::of(points(scene, phase).into_iter(), picture, 26.0)
        };
        frame.draw(svg);
        let class = format!("phase phase-{}", phase.name.replace(' ', "-"));
        svg.group(&[("class", &class)], |svg| {
            let when =
                phase.time.filter(|time| *time != 0.0).map(|time| format!(", {} s", signed(&units.number(Measure::Time, time, 1.0), time)));
            svg.text((frame.x + 8.0, frame.y + 17.0), SMALL, "label", &format!("{}{}", phase.name, when.unwrap_or_default()));
            for which in (0..2).filter(|which| scene.vehicles[*which].barrier && phase.time.is_some()) {
                barrier::draw(svg, &view, scene, which, impact::size(scene));
            }
            for (which, (pose, velocity)) in phase.poses.iter().zip(phase.velocities).enumerate() {
                let Some(pose) = pose else { continue };
                vehicle::draw(svg, &view, &scene.vehicles[which], which, pose, Detail::Small);
                motion(svg, &view, scene, which, pose, velocity);
            }
            view.bar(svg, units);
        });
    }
}

fn signed(number: &str, value: f64) -> String {
    let number = number.replace('-', "−");
    if value > 0.0 { format!("+{number}") } else { number }
}

fn points(scene: &Scene, phase: &Phase) -> Vec<[f64; 2]> {
    let of = |which: usize, pose: &RestPose| extent(&scene.vehicles[which], pose);
    phase.poses.iter().enumerate().filter_map(|(which, pose)| Some(of(which, pose.as_ref()?))).flatten().collect()
}

/// Returns the corners of the barriers, which the pictures around the impact show.
fn walls(scene: &Scene) -> Vec<[f64; 2]> {
    let barriers = (0..2).filter(|which| scene.vehicles[*which].barrier);
    barriers.flat_map(|which| barrier::corners(scene, which, impact::size(scene))).collect()
}

/// Returns the arrow of a velocity, in pixels to the right and up; the fastest is as long as a quarter of the picture's height, and the slowest have none.
fn arrow(scene: &Scene, velocity: [f64; 2], height: f64) -> Option<[f64; 2]> {
    let fastest = scene.phases.iter().flat_map(|phase| phase.velocities).map(|[x, y]| libm::hypot(x, y)).fold(0.0, f64::max);
    let speed = libm::hypot(velocity[0], velocity[1]);
    let length = 0.25 * height;
    (speed > 0.02 * fastest).then(|| velocity.map(|part| length * part / fastest))
}

/// Returns where each arrow of a phase begins, and the arrow.
fn arrows(scene: &Scene, phase: &Phase, height: f64) -> Vec<([f64; 2], [f64; 2])> {
    let of_vehicles = phase.poses.iter().zip(phase.velocities);
    of_vehicles.filter_map(|(pose, velocity)| Some((pose.as_ref()?.position, arrow(scene, velocity, height)?))).collect()
}

/// Draws the velocity.
fn motion(svg: &mut Svg, view: &View, scene: &Scene, which: usize, pose: &RestPose, velocity: [f64; 2]) {
    let Some([right, up]) = arrow(scene, velocity, view.frame.height) else { return };
    let from = view.place(pose.position);
    let tip = (from.0 + right, from.1 - up);
    let class = format!("phase-velocity phase-velocity-{}", which + 1);
    svg.line(from, tip, &[("class", &class), ("stroke", STYLES[which].stroke), ("stroke-width", "2")]);
    arrow_head(svg, from, tip, 6.0, &[("fill", STYLES[which].stroke)]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_is_for_what_has_one() {
        assert_eq!([("3", 3.0), ("-3", -3.0), ("0", 0.0)].map(|(number, value)| signed(number, value)), ["+3", "−3", "0"]);
    }
}
