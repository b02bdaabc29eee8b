//! Variables: the quantities that can be unknown.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::collision::Collision;
use crate::frame::ForwardLeft;
use crate::input::{Input, Side};
use crate::law::ImpulseRatio;
use crate::measure::Measure;
use crate::moment::Moment;
use crate::output::Output;
use crate::scalar::Real;
use crate::vehicle::{Party, Vehicle};

/// A quantity of a collision that can be unknown and can have a prior.
///
/// ```
/// use planar_impact::reconstruct::Variable;
/// use planar_impact::{Input, Side};
/// assert_eq!(Variable::named("vehicle.1.speed"), Some(Variable::Speed(Side::One)));
/// assert_eq!(Variable::named("Gamma"), Some(Variable::Input(Input::CrushPlane)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// An input of the collision. [`Input::ImpulseRatio`] is the number that the collision specifies: the ratio μ, or the fraction of the critical one.
    Input(Input),
    /// The speed of a vehicle along its heading, before the impact. A vehicle whose speed is unknown drives along its heading.
    Speed(Side),
    /// The radius of gyration of a vehicle in yaw, k with I = m k². It is unknown instead of the yaw inertia.
    RadiusOfGyration(Side),
    /// The share of vehicle 1 in the crush energy. Stiffness determines it, not the mechanics.
    CrushShare,
    /// A component of the impulse on vehicle 1 in ground axes. With it among the unknowns momentum alone determines the impact, and restitution, impulse ratio
    /// and crush plane take no part: see [`ReconstructionProblem::by_momentum`](super::ReconstructionProblem::by_momentum).
    Impulse(Axis),
    /// The speed from which the braking of a vehicle before the impact would have brought it to rest: √(2 Σ a s) of the decelerations and distances of its
    /// skids. Tire marks and friction determine it, not the mechanics.
    SkidSpeed(Side),
}

/// An axis of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The x axis.
    X,
    /// The y axis.
    Y,
}

impl Variable {
    /// Returns its name, such as `vehicle.1.speed`.
    pub fn name(self) -> &'static str {
        match self {
            Variable::Input(input) => input.name(),
            Variable::Speed(Side::One) => "vehicle.1.speed",
            Variable::Speed(Side::Two) => "vehicle.2.speed",
            Variable::RadiusOfGyration(Side::One) => "vehicle.1.radius_of_gyration",
            Variable::RadiusOfGyration(Side::Two) => "vehicle.2.radius_of_gyration",
            Variable::CrushShare => "contact.crush_share",
            Variable::Impulse(Axis::X) => Output::ImpulseX.name(),
            Variable::Impulse(Axis::Y) => Output::ImpulseY.name(),
            Variable::SkidSpeed(Side::One) => "before.vehicle.1.skid_speed",
            Variable::SkidSpeed(Side::Two) => "before.vehicle.2.skid_speed",
        }
    }

    /// Returns its measure. For a moment that the collision gives as a fraction of the critical one it is also that of the moment.
    pub fn measure(self) -> Measure {
        match self {
            Variable::Input(input) => input.measure(),
            Variable::Speed(_) | Variable::SkidSpeed(_) => Measure::Speed,
            Variable::RadiusOfGyration(_) => Measure::Length,
            Variable::CrushShare => Measure::Ratio,
            Variable::Impulse(_) => Measure::Impulse,
        }
    }

    /// Returns the variable with a name or the paper's symbol.
    pub fn named(name: &str) -> Option<Variable> {
        match name {
            "vehicle.1.speed" | "v1" => Some(Variable::Speed(Side::One)),
            "vehicle.2.speed" | "v2" => Some(Variable::Speed(Side::Two)),
            "contact.crush_share" => Some(Variable::CrushShare),
            _ => Input::named(name).map(Variable::Input),
        }
    }

    /// Returns its vehicle, or `None` if it does not belong to one.
    pub fn side(self) -> Option<Side> {
        match self {
            Variable::Speed(side) | Variable::RadiusOfGyration(side) | Variable::SkidSpeed(side) => Some(side),
            Variable::CrushShare | Variable::Impulse(_) => None,
            Variable::Input(input) => input.side(),
        }
    }

    /// Returns the value in a collision, or `None` if absent, such as the mass of a barrier.
    pub fn of<T: Real>(self, collision: &Collision<T>, crush_share: &T) -> Option<T> {
        match self {
            Variable::Input(input) => collision.input(input),
            Variable::Speed(side) => party(collision, side).vehicle().map(speed),
            Variable::RadiusOfGyration(side) => party(collision, side).vehicle().map(Vehicle::radius_of_gyration),
            Variable::CrushShare => Some(crush_share.clone()),
            Variable::Impulse(_) | Variable::SkidSpeed(_) => None,
        }
    }

    /// Returns the period of an angle, or `None` if it is not an angle.
    pub(super) fn period(self) -> Option<f64> {
        match self {
            Variable::Input(Input::CrushPlane) => Some(PI),
            Variable::Input(Input::Heading(_)) => Some(TAU),
            _ => None,
        }
    }

    /// Returns the smallest and the largest value that the mechanics allows.
    pub(super) fn domain(self, collision: &Collision) -> (f64, f64) {
        let of_critical = matches!(collision.impulse_ratio, ImpulseRatio::OfCritical(_));
        match self {
            Variable::Input(Input::Restitution) | Variable::CrushShare => (0.0, 1.0),
            Variable::Input(Input::ImpulseRatio) if of_critical => (0.0, 1.0),
            Variable::Input(Input::Moment) if matches!(collision.moment, Moment::OfCritical(_)) => (0.0, 1.0),
            Variable::Input(Input::ImpulseRatio) if matches!(collision.impulse_ratio, ImpulseRatio::LimitedByFriction(_)) => {
                (0.0, f64::INFINITY)
            }
            Variable::Input(Input::Mass(_) | Input::YawInertia(_)) | Variable::RadiusOfGyration(_) => (f64::MIN_POSITIVE, f64::INFINITY),
            Variable::SkidSpeed(_) => (0.0, f64::INFINITY),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Returns a significant change, in its unit.
    pub(super) fn scale(self, collision: &Collision, value: f64) -> f64 {
        match self {
            Variable::Speed(_)
            | Variable::SkidSpeed(_)
            | Variable::Input(Input::VelocityX(_) | Input::VelocityY(_) | Input::YawRate(_)) => 1.0,
            // That of a change of velocity by 1 m/s.
            Variable::Impulse(_) => reduced_mass(collision),
            Variable::Input(Input::Mass(_) | Input::YawInertia(_)) | Variable::RadiusOfGyration(_) => {
                (0.1 * value.abs()).max(f64::MIN_POSITIVE)
            }
            Variable::Input(Input::Moment) if matches!(collision.moment, Moment::Given(_)) => (0.1 * value.abs()).max(100.0),
            Variable::CrushShare | Variable::Input(_) => 0.1,
        }
    }

    /// Returns the distance of other starts from the given one if no bound determines it.
    pub(super) fn spread(self, collision: &Collision, value: f64) -> f64 {
        match self {
            Variable::Speed(_) | Variable::SkidSpeed(_) | Variable::Input(Input::VelocityX(_) | Input::VelocityY(_)) => 20.0,
            Variable::Impulse(_) => 20.0 * reduced_mass(collision),
            Variable::Input(Input::YawRate(_)) => 5.0,
            Variable::Input(Input::Heading(_)) => PI,
            Variable::Input(Input::CrushPlane) => FRAC_PI_2,
            Variable::Input(Input::Mass(_) | Input::YawInertia(_)) | Variable::RadiusOfGyration(_) => 0.5 * value.abs(),
            Variable::Input(Input::Moment) if matches!(collision.moment, Moment::Given(_)) => (0.5 * value.abs()).max(1000.0),
            Variable::CrushShare | Variable::Input(_) => 1.0,
        }
    }

    /// Returns `true` if the collision has it.
    pub(super) fn is_in(self, collision: &Collision) -> bool {
        match self {
            Variable::CrushShare | Variable::Impulse(_) => collision.one.vehicle().is_some() && collision.two.vehicle().is_some(),
            Variable::Input(Input::ImpulseRatio) => collision.impulse_ratio != ImpulseRatio::Critical,
            Variable::Input(Input::Moment) => collision.moment != Moment::None,
            _ => self.side().is_none_or(|side| party(collision, side).vehicle().is_some()),
        }
    }
}

/// Returns the party of a side.
pub(super) fn party<T>(collision: &Collision<T>, side: Side) -> &Party<T> {
    match side {
        Side::One => &collision.one,
        Side::Two => &collision.two,
    }
}

/// Returns the mass that determines the relative motion of both vehicles, in kg.
fn reduced_mass(collision: &Collision) -> f64 {
    let inverse = |party: &Party| party.vehicle().map_or(0.0, |vehicle| vehicle.mass.recip());
    (inverse(&collision.one) + inverse(&collision.two)).recip()
}

/// Returns the speed of a vehicle along its heading.
pub(super) fn speed<T: Real>(vehicle: &Vehicle<T>) -> T {
    let ForwardLeft { forward, .. } = vehicle.heading.to_vehicle(vehicle.motion.velocity.clone());
    forward
}

/// Returns the whole periods in a difference, or 0 without a period.
pub(super) fn turns(difference: f64, period: Option<f64>) -> f64 {
    period.map_or(0.0, |period| period * (difference / period).round())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_is_an_unknown_where_there_is_one_in_its_own_measure() {
        let car = Vehicle::new(1500.0, 2500.0);
        let of = |moment| Collision::new(car, car).with_moment(moment);
        let moment = Variable::Input(Input::Moment);
        assert_eq!([Moment::None, Moment::Given(3.0), Moment::OfCritical(0.5)].map(|given| moment.is_in(&of(given))), [false, true, true]);
        let spread = |given, value| moment.spread(&of(given), value);
        assert_eq!(
            [spread(Moment::Given(3.0), 3.0), spread(Moment::Given(5000.0), 5000.0), spread(Moment::OfCritical(0.5), 0.5)],
            [1000.0, 2500.0, 1.0]
        );
    }
}
