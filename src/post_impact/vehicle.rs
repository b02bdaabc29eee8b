//! A vehicle on four wheels, as it slides to rest.

use super::tire::{Restraint, Tires};
use crate::frame::{ForwardLeft, Heading, Xy};
use crate::scalar::Real;

/// Position and heading of a vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose<T = f64> {
    /// Position of the center of mass in ground axes, in m.
    pub position: Xy<T>,
    /// Heading from x, counter-clockwise, whole turns included, in rad.
    pub heading: T,
}

/// One wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel<T = f64> {
    /// Its restraint.
    pub restraint: Restraint<T>,
    /// Its angle to the vehicle's heading, counter-clockwise, in rad.
    pub steer: T,
}

/// A value for each of the four wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels<W> {
    /// Front left.
    pub front_left: W,
    /// Front right.
    pub front_right: W,
    /// Rear left.
    pub rear_left: W,
    /// Rear right.
    pub rear_right: W,
}

/// A rigid vehicle on four wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingVehicle<T = f64> {
    /// Mass in kg.
    pub mass: T,
    /// Yaw inertia about the vertical through the center of mass, in kg m².
    pub yaw_inertia: T,
    /// Distance of the front axle ahead of the center of mass, in m.
    pub front_axle: T,
    /// Distance of the rear axle behind the center of mass, in m.
    pub rear_axle: T,
    /// The distance between the wheels of an axle, in m.
    pub track: T,
    /// Its wheels.
    pub wheels: Wheels<Wheel<T>>,
    /// Its tires.
    pub tires: Tires<T>,
}

impl SlidingVehicle {
    /// Returns `true` if no wheel rotates: friction alone brakes it, and a motion that is k times as fast goes about k² times as far. Errors of its separation are then
    /// those of its way ([`ReconstructionProblem::separation_from_rest`](crate::reconstruct::ReconstructionProblem::separation_from_rest)).
    pub fn is_locked(&self) -> bool {
        let locks = |wheel: WheelPosition| match self.wheels.of(wheel).restraint {
            Restraint::Locked => true,
            Restraint::Braked(share) => share >= 1.0,
            Restraint::Rolling => false,
        };
        WheelPosition::ALL.into_iter().all(locks)
    }
}

/// Position of a wheel on its vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum WheelPosition {
    /// Front left.
    FrontLeft,
    /// Front right.
    FrontRight,
    /// Rear left.
    RearLeft,
    /// Rear right.
    RearRight,
}

impl WheelPosition {
    /// Every wheel.
    pub const ALL: [WheelPosition; 4] =
        [WheelPosition::FrontLeft, WheelPosition::FrontRight, WheelPosition::RearLeft, WheelPosition::RearRight];
}

#[cfg(test)]
impl SlidingVehicle {
    /// Returns a sedan with these wheels.
    pub(super) const fn sedan(wheels: Wheels<Wheel>) -> Self {
        SlidingVehicle { mass: 1500.0, yaw_inertia: 2400.0, front_axle: 1.2, rear_axle: 1.5, track: 1.5, wheels, tires: Tires::ORDINARY }
    }
}

impl<T> Pose<T> {
    /// Converts the pose to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Pose<U> {
        Pose { position: self.position.map(&mut f), heading: f(self.heading) }
    }
}

impl Wheel {
    /// A wheel that rolls straight ahead.
    pub const ROLLING: Wheel = Wheel { restraint: Restraint::Rolling, steer: 0.0 };
    /// A wheel that does not rotate.
    pub const LOCKED: Wheel = Wheel { restraint: Restraint::Locked, steer: 0.0 };

    /// Returns a wheel that is braked by a fraction of the force that friction allows.
    pub const fn braked(fraction: f64) -> Wheel {
        Wheel { restraint: Restraint::Braked(fraction), steer: 0.0 }
    }

    /// Returns the same wheel at an angle, in rad.
    #[must_use]
    pub const fn steered(self, steer: f64) -> Wheel {
        Wheel { steer, ..self }
    }
}

impl<W: Clone> Wheels<W> {
    /// Returns four equal values.
    pub fn all(wheel: W) -> Self {
        Wheels { front_left: wheel.clone(), front_right: wheel.clone(), rear_left: wheel.clone(), rear_right: wheel }
    }
}

impl<W> Wheels<W> {
    /// Returns the value of a wheel.
    pub fn of(&self, wheel: WheelPosition) -> &W {
        match wheel {
            WheelPosition::FrontLeft => &self.front_left,
            WheelPosition::FrontRight => &self.front_right,
            WheelPosition::RearLeft => &self.rear_left,
            WheelPosition::RearRight => &self.rear_right,
        }
    }

    /// Converts the value of each wheel.
    pub fn map<V>(self, mut f: impl FnMut(W) -> V) -> Wheels<V> {
        Wheels {
            front_left: f(self.front_left),
            front_right: f(self.front_right),
            rear_left: f(self.rear_left),
            rear_right: f(self.rear_right),
        }
    }
}

impl<T> SlidingVehicle<T> {
    /// Converts the vehicle to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> SlidingVehicle<U> {
        SlidingVehicle {
            mass: f(self.mass),
            yaw_inertia: f(self.yaw_inertia),
            front_axle: f(self.front_axle),
            rear_axle: f(self.rear_axle),
            track: f(self.track),
            wheels: self.wheels.map(|wheel| Wheel { restraint: wheel.restraint.map(&mut f), steer: f(wheel.steer) }),
            tires: self.tires.map(f),
        }
    }
}

/// A wheel on its vehicle: what restrains it, the direction in which it rolls, its position relative to the center of mass, and its load.
pub(super) struct Standing<T> {
    pub restraint: Restraint<T>,
    pub rolls_along: Heading<T>,
    pub place: ForwardLeft<T>,
    pub load: T,
}

impl<T: Real> SlidingVehicle<T> {
    /// Returns where its wheels stand in a pose, in ground axes and m.
    pub fn wheel_places(&self, pose: &Pose<T>) -> Wheels<Xy<T>> {
        let heading = Heading::from_angle(pose.heading.clone());
        self.places().map(|place| pose.position.clone() + heading.to_ground(place))
    }

    /// Returns where its wheels are relative to the center of mass.
    pub(super) fn places(&self) -> Wheels<ForwardLeft<T>> {
        let [front_left, front_right, rear_left, rear_right] = self.standing(T::int(0)).map(|standing| standing.place);
        Wheels { front_left, front_right, rear_left, rear_right }
    }

    /// Returns the wheels with their positions and loads. The load of an axle follows from its distance from the center of mass, m g b/(a + b), half of it on
    /// each side, also in motion: neither pitch nor roll changes it.
    pub(super) fn standing(&self, gravity: T) -> [Standing<T>; 4] {
        let per_wheel = (self.mass.clone() * gravity).half() / (self.front_axle.clone() + self.rear_axle.clone());
        let front = (self.front_axle.clone(), per_wheel.clone() * self.rear_axle.clone());
        let rear = (-self.rear_axle.clone(), per_wheel * self.front_axle.clone());
        let half_track = self.track.clone().half();
        let standing = |wheel: &Wheel<T>, (forward, load): (T, T), left: T| Standing {
            restraint: wheel.restraint.clone(),
            rolls_along: Heading::from_angle(wheel.steer.clone()),
            place: ForwardLeft { forward, left },
            load,
        };
        [
            standing(&self.wheels.front_left, front.clone(), half_track.clone()),
            standing(&self.wheels.front_right, front, -half_track.clone()),
            standing(&self.wheels.rear_left, rear.clone(), half_track.clone()),
            standing(&self.wheels.rear_right, rear, -half_track),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::tire::Restraint;
    use super::*;

    #[test]
    fn wheels_stand_around_the_center_of_mass_of_the_pose() {
        let vehicle = SlidingVehicle::sedan(Wheels::all(Wheel { restraint: Restraint::Locked, steer: 0.0 }));
        let pose = Pose { position: Xy { x: 10.0, y: 20.0 }, heading: 0.0 };
        let Wheels { front_left, front_right, rear_left, rear_right } = vehicle.wheel_places(&pose);
        assert_eq!([front_left, front_right], [Xy { x: 11.2, y: 20.75 }, Xy { x: 11.2, y: 19.25 }]);
        assert_eq!([rear_left, rear_right], [Xy { x: 8.5, y: 20.75 }, Xy { x: 8.5, y: 19.25 }]);
    }
}
