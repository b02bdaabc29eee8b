//! The outline of a vehicle on a plan.

use planar_impact::Side;
use planar_impact::crash3::Surface;
use schemars::JsonSchema;
use serde::Serialize;

use crate::case::{RestOfVehicle, VehicleInputs, vehicle_number};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Width of a symbol over its length.
const SLENDERNESS: f64 = 0.4;
/// Length of a symbol over its wheelbase.
const OVER_WHEELBASE: f64 = 1.6;
/// How far an impact center may lie outside a given outline without a warning, in m.
const OUTSIDE: f64 = 0.1;

/// A rectangle around a vehicle, in its axes, from the center of mass, in m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Outline {
    /// Distance to the front end.
    pub front: f64,
    /// Distance to the rear end.
    pub rear: f64,
    /// Half of the width.
    pub half_width: f64,
    /// `true` if the case gives length and width; otherwise it is a symbol of about the right size.
    pub is_given: bool,
    /// Places of the wheels, forward and left, where the case gives the axles: front left, front right, rear left, rear right.
    pub wheels: Option<[[f64; 2]; 4]>,
}

impl Outline {
    /// Returns the outline of a vehicle; `None` for a mass point: without any size in the case, and with momentum alone.
    ///
    /// A length that the case does not give is 1.6 wheelbases, or that of a rectangle with this mass and yaw inertia, 0.4 times as wide as long. A width that it
    /// does not give is that of a crushed front or rear, or 0.4 lengths.
    pub(super) fn of(
        inputs: &VehicleInputs,
        rest: Option<&RestOfVehicle>,
        has_inertia: bool,
        side: Side,
        notices: &mut Vec<Notice>,
    ) -> Option<Outline> {
        let (size, center) = (inputs.size, inputs.impact_center);
        let axles = rest.map(|rest| &rest.slide.vehicle);
        let crush = inputs.crush.as_ref();
        let across = crush.filter(|crush| matches!(crush.surface, None | Some(Surface::Front | Surface::Rear)));
        let of_crush = across.map(|crush| crush.profile.on_scalar(|_| 0.0).width());
        let of_wheels = axles.map(|axles| OVER_WHEELBASE * (axles.front_axle + axles.rear_axle));
        // A rectangle a by b has the radius of gyration k with a² + b² = 12 k².
        let of_inertia = has_inertia.then(|| (12.0 / (1.0 + SLENDERNESS * SLENDERNESS) * inputs.yaw_inertia() / inputs.mass).sqrt());
        let length = size.length.or(of_wheels).or(of_inertia).or(size.width.map(|width| width / SLENDERNESS))?;
        let width = size.width.unwrap_or_else(|| f64::max(of_crush.unwrap_or(0.0), SLENDERNESS * length));
        let is_given = size.length.is_some() && size.width.is_some();
        let middle = axles.map_or(0.0, |axles| (axles.front_axle - axles.rear_axle) / 2.0);
        let front = match (axles, size.front_overhang) {
            (Some(axles), Some(overhang)) => axles.front_axle + overhang,
            _ => middle + length / 2.0,
        };
        let path = format!("vehicle.{}", vehicle_number(side));
        if axles.is_none() && size.front_overhang.is_some() {
            let message = format!(
                "{path}: its front overhang is not used, because [rest] does not give its axles; the center of mass is drawn in the middle"
            );
            notices.push(Notice::note("overhang-unused", format!("{path}.front_overhang"), message));
        } else if is_given && axles.is_none() {
            let message = format!("{path}: its center of mass is drawn in the middle of its length");
            notices.push(Notice::note("center-in-middle", path.clone(), message));
        }
        let mut outline = Outline { front, rear: length - front, half_width: width / 2.0, is_given, wheels: axles.map(wheels) };
        let outside = [center.forward - outline.front, -center.forward - outline.rear, center.left.abs() - outline.half_width];
        let outside = outside.into_iter().fold(0.0, f64::max);
        if !is_given {
            let message = format!("{path}: its outline is a symbol, because the case does not give its length and width");
            notices.push(Notice::note("outline-symbol", path, message));
            outline.front = outline.front.max(center.forward);
            outline.rear = outline.rear.max(-center.forward);
            outline.half_width = outline.half_width.max(center.left.abs());
        } else if outside > OUTSIDE {
            let message = Message::from(format!("{path}: its impact center lies ")).figure(Measure::Length, outside);
            let message = message.text(" outside its outline; check its signs: forward and left of the center of mass");
            notices.push(Notice::warning("impact-center-outside", format!("{path}.impact_center"), message));
        }
        Some(outline)
    }

    /// Returns the corners, forward and left: front left, front right, rear right, rear left.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let Outline { front, rear, half_width, .. } = *self;
        [[front, half_width], [front, -half_width], [-rear, -half_width], [-rear, half_width]]
    }
}

fn wheels(vehicle: &planar_impact::post_impact::SlidingVehicle) -> [[f64; 2]; 4] {
    let (front, rear, half) = (vehicle.front_axle, -vehicle.rear_axle, vehicle.track / 2.0);
    [[front, half], [front, -half], [rear, half], [rear, -half]]
}
