//! The phases of a collision.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Scene, VehicleInScene};
use crate::slide::RestPose;

/// The longest time before and after the impact that a phase shows, in s.
const LONGEST: f64 = 1.0;

/// The vehicles at one time.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Phase {
    /// `before`, `maximum compression`, `after` or `rest`.
    pub name: &'static str,
    /// Time since the impact in s; `null` at rest, which each vehicle reaches at its own time.
    pub time: Option<f64>,
    /// Pose of each vehicle; `null` for a barrier, and where it is not known.
    pub poses: [Option<RestPose>; 2],
    /// Velocity of each vehicle along x and y, in m/s.
    pub velocities: [[f64; 2]; 2],
}

/// Returns the phases: as long before and after the impact as the faster vehicle takes for 0.6 of the longer length, at most a second.
///
/// The impulse at maximum compression is 1/(1 + e) of the whole.
pub(super) fn phases(scene: &Scene, restitution: f64) -> Vec<Phase> {
    let speed = |vehicle: &VehicleInScene| libm::hypot(vehicle.before.velocity[0], vehicle.before.velocity[1]);
    let length = |vehicle: &VehicleInScene| vehicle.outline.map_or(4.0, |outline| outline.front + outline.rear);
    let of_both =
        |of: &dyn Fn(&VehicleInScene) -> f64| scene.vehicles.iter().filter(|vehicle| !vehicle.barrier).map(of).fold(0.0, f64::max);
    let fastest = of_both(&speed);
    let time = if fastest > 0.0 { (0.6 * of_both(&length) / fastest).min(LONGEST) } else { LONGEST };
    let share = if restitution.is_finite() { (1.0 + restitution).recip() } else { 1.0 };
    let after = |vehicle: &VehicleInScene| vehicle.after.velocity;
    let compressed = |vehicle: &VehicleInScene| [0, 1].map(|k| vehicle.before.velocity[k] + share * vehicle.delta_v[k]);
    let phase = |name, time, pose: &dyn Fn(&VehicleInScene) -> Option<RestPose>, velocity: &dyn Fn(&VehicleInScene) -> [f64; 2]| Phase {
        name,
        time,
        poses: scene.vehicles.each_ref().map(|vehicle| if vehicle.barrier { None } else { pose(vehicle) }),
        velocities: scene.vehicles.each_ref().map(velocity),
    };
    let mut phases = vec![
        phase(
            "before",
            Some(-time),
            &|vehicle| Some(moved(vehicle, vehicle.before.velocity, vehicle.before.yaw_rate, -time)),
            &|vehicle| vehicle.before.velocity,
        ),
        phase("maximum compression", Some(0.0), &|vehicle| Some(moved(vehicle, [0.0; 2], 0.0, 0.0)), &compressed),
        phase("after", Some(time), &|vehicle| Some(followed(vehicle, time)), &after),
    ];
    if scene.vehicles.iter().any(|vehicle| vehicle.slide.is_some() || vehicle.rest.is_some()) {
        phases.push(phase("rest", None, &at_rest, &|_| [0.0; 2]));
    }
    phases
}

fn at_rest(vehicle: &VehicleInScene) -> Option<RestPose> {
    let given = vehicle.rest.as_ref().map(|rest| RestPose { position: rest.position, heading: rest.heading });
    vehicle.slide.as_ref().map(|slide| slide.rest).or(given)
}

/// The pose after a time with constant velocities.
fn moved(vehicle: &VehicleInScene, velocity: [f64; 2], yaw_rate: f64, time: f64) -> RestPose {
    RestPose { position: [0, 1].map(|k| vehicle.position[k] + velocity[k] * time), heading: vehicle.heading + yaw_rate * time }
}

/// The pose after a time: on the slide to rest where there is one, otherwise with constant velocities.
fn followed(vehicle: &VehicleInScene, time: f64) -> RestPose {
    let Some(slide) = &vehicle.slide else {
        return moved(vehicle, vehicle.after.velocity, vehicle.after.yaw_rate.unwrap_or(0.0), time);
    };
    let next = slide.path.partition_point(|state| state.t < time);
    let (Some(a), Some(b)) = (slide.path.get(next.saturating_sub(1)), slide.path.get(next)) else { return slide.rest };
    let share = if b.t > a.t { (time - a.t) / (b.t - a.t) } else { 0.0 };
    let between = |from: f64, to: f64| from + share * (to - from);
    RestPose { position: [between(a.x, b.x), between(a.y, b.y)], heading: between(a.heading, b.heading) }
}
