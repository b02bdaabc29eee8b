//! The collision that given unknowns make, on any scalar, and what the evidence would be of it.

use super::given::Reconstruction;
use super::variable::{Variable, party};
use crate::collision::Collision;
use crate::frame::{CrushPlane, ForwardLeft, Heading};
use crate::input::{Input, Side};
use crate::scalar::Real;
use crate::vehicle::{Party, Vehicle};

/// A collision with the unknowns in their places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<T> {
    pub(super) collision: Collision<T>,
    /// The share of the crush energy that vehicle 1 has.
    pub(super) crush_share: T,
}

/// Puts unknowns in their places.
pub(super) struct Scene {
    base: Collision,
    variables: Vec<Variable>,
    /// The speed of a vehicle that drives along its heading, where it is known.
    speeds: [Option<f64>; 2],
    crush_share: f64,
}

impl Scene {
    pub(super) fn of(question: &Reconstruction) -> Self {
        let speed = |side| {
            let driven = question.drives_along_heading[side as usize];
            party(&question.collision, side).vehicle().filter(|_| driven).map(super::variable::speed)
        };
        Scene {
            base: question.collision,
            variables: question.unknowns.iter().map(|unknown| unknown.of).collect(),
            speeds: [speed(Side::One), speed(Side::Two)],
            crush_share: question.crush_share.unwrap_or(0.5),
        }
    }

    /// The collision of given values of the unknowns, in their order.
    pub(super) fn place<T: Real + Copy + From<f64>>(&self, values: &[T]) -> Placed<T> {
        let mut placed = Placed { collision: self.base.map(T::from), crush_share: T::from(self.crush_share) };
        let mut speeds = self.speeds.map(|speed| speed.map(T::from));
        for (variable, &value) in self.variables.iter().zip(values) {
            match *variable {
                Variable::CrushShare => placed.crush_share = value,
                Variable::Speed(side) => speeds[side as usize] = Some(value),
                Variable::Input(input) => put(&mut placed.collision, input, value),
            }
        }
        drive(&mut placed.collision.one, speeds[0]);
        drive(&mut placed.collision.two, speeds[1]);
        placed
    }
}

/// Lets a vehicle go at a speed along its heading.
fn drive<T: Real>(party: &mut Party<T>, speed: Option<T>) {
    if let (Party::Vehicle(vehicle), Some(forward)) = (party, speed) {
        vehicle.motion.velocity = vehicle.heading.to_ground(ForwardLeft { forward, left: T::int(0) });
    }
}

fn put<T: Real>(collision: &mut Collision<T>, input: Input, value: T) {
    match input {
        Input::CrushPlane => collision.crush_plane = CrushPlane::from_angle(value),
        Input::Restitution => collision.restitution = value,
        Input::ImpulseRatio => collision.impulse_ratio = collision.impulse_ratio.clone().map(|_| value.clone()),
        Input::Moment => collision.moment = collision.moment.clone().map(|_| value.clone()),
        _ => {
            let party = match input.side() {
                Some(Side::Two) => &mut collision.two,
                _ => &mut collision.one,
            };
            if let Party::Vehicle(vehicle) = party {
                put_in(vehicle, input, value);
            }
        }
    }
}

fn put_in<T: Real>(vehicle: &mut Vehicle<T>, input: Input, value: T) {
    let place = match input {
        Input::Heading(_) => {
            vehicle.heading = Heading::from_angle(value);
            return;
        }
        Input::Mass(_) => &mut vehicle.mass,
        Input::YawInertia(_) => &mut vehicle.yaw_inertia,
        Input::ImpactCenterForward(_) => &mut vehicle.impact_center.forward,
        Input::ImpactCenterLeft(_) => &mut vehicle.impact_center.left,
        Input::VelocityX(_) => &mut vehicle.motion.velocity.x,
        Input::VelocityY(_) => &mut vehicle.motion.velocity.y,
        Input::YawRate(_) => &mut vehicle.motion.yaw_rate,
        Input::CrushPlane | Input::Restitution | Input::ImpulseRatio | Input::Moment => return,
    };
    *place = value;
}
