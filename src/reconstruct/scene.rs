//! The collision for given unknowns, on any scalar.

use super::given::ReconstructionProblem;
use super::placed::Placed;
use super::variable::{Variable, party};
use crate::collision::Collision;
use crate::input::Side;
use crate::scalar::Real;
use crate::vehicle::Party;

/// Inserts values of the unknowns into the collision.
pub(super) struct Scene {
    base: Collision,
    variables: Vec<Variable>,
    /// The speed of a vehicle that drives along its heading, if it is known.
    speeds: [Option<f64>; 2],
    crush_share: f64,
}

impl Scene {
    pub(super) fn of(question: &ReconstructionProblem) -> Self {
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

    /// Returns the collision for given values of the unknowns, in their order.
    pub(super) fn place<T: Real + Copy + From<f64>>(&self, values: &[T]) -> Placed<T> {
        let mut placed = Placed { collision: self.base.map(T::from), crush_share: T::from(self.crush_share) };
        let mut speeds = self.speeds.map(|speed| speed.map(T::from));
        for (variable, &value) in self.variables.iter().zip(values) {
            match *variable {
                Variable::CrushShare => placed.crush_share = value,
                Variable::Speed(side) => speeds[side as usize] = Some(value),
                // An input that the collision does not have is reported by the check of the problem.
                Variable::Input(input) => drop(placed.collision.set(input, value)),
            }
        }
        drive(&mut placed.collision.one, speeds[0]);
        drive(&mut placed.collision.two, speeds[1]);
        placed
    }
}

/// Sets the velocity of a vehicle to a speed along its heading.
fn drive<T: Real + Copy>(party: &mut Party<T>, speed: Option<T>) {
    if let (Party::Vehicle(vehicle), Some(speed)) = (party, speed) {
        *vehicle = vehicle.with_speed(speed);
    }
}
