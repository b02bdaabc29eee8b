//! Measurands: the quantities that can be evidence.

use std::f64::consts::TAU;

use super::placed::Placed;
use super::variable::{Axis, Variable, party};
use crate::collision::Collision;
use crate::crush::speed_of_energy;
use crate::impact::{Impact, Response};
use crate::input::{Input, Side};
use crate::measure::Measure;
use crate::output::Output;
use crate::scalar::Real;
use crate::skid::braking_speed;
use crate::vehicle::Party;

/// A quantity of a crash that can be measured and compared with its computed value.
///
/// ```
/// use planar_impact::reconstruct::Measurand;
/// use planar_impact::{Output, Side};
/// assert_eq!(Measurand::named("vehicle.1.separation_yaw_rate"), Some(Measurand::Output(Output::YawRate(Side::One))));
/// assert_eq!(Measurand::DeltaVForward(Side::Two).name(), "vehicle.2.delta_v_forward");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Measurand {
    /// An input of the collision, such as a known approach speed.
    Variable(Variable),
    /// An output of the collision. The names of post-impact motions begin with `separation_`, as in `vehicle.1.separation_velocity.x`.
    Output(Output),
    /// The crush energy of both vehicles, E_C = −W_n, in J (Eq 7).
    CrushEnergy,
    /// The crush energy of one vehicle, in J: its share of −W_n.
    CrushEnergyOf(Side),
    /// Equivalent energy speed of one vehicle, EES: that at which its kinetic energy is its crush energy, in m/s.
    EquivalentEnergySpeed(Side),
    /// Speed at which the vehicles approach along the normal of the contact, |v_n|, in m/s.
    ClosingSpeed,
    /// Separation speed of a vehicle's center of mass, in m/s.
    SeparationSpeed(Side),
    /// Direction of the separation velocity: the angle from x, counter-clockwise, in rad.
    SeparationDirection(Side),
    /// Direction of the approach velocity, whatever the heading, for instance from tire marks of a sliding car: the angle from x, counter-clockwise, in rad.
    ApproachDirection(Side),
    /// Speed of a vehicle when it began to brake before the impact, in m/s: √(v² + s²) of its speed v at the impact and its skid speed s.
    BrakingSpeed(Side),
    /// Change of velocity along the vehicle, forward positive, in m/s: the longitudinal ΔV of an event data recorder.
    DeltaVForward(Side),
    /// Change of velocity across the vehicle, positive to its left, in m/s: the lateral ΔV of an event data recorder, which is positive to the right.
    DeltaVLeft(Side),
}

/// Names that are not those of an output or an input.
const NAMES: [(&str, Measurand); 30] = {
    use Measurand as M;
    use Side::{One, Two};
    [
        ("crush_energy", M::CrushEnergy),
        ("vehicle.1.crush_energy", M::CrushEnergyOf(One)),
        ("vehicle.1.equivalent_energy_speed", M::EquivalentEnergySpeed(One)),
        ("vehicle.1.separation_velocity.x", M::Output(Output::VelocityX(One))),
        ("vehicle.1.separation_velocity.y", M::Output(Output::VelocityY(One))),
        ("vehicle.1.separation_speed", M::SeparationSpeed(One)),
        ("vehicle.1.separation_direction", M::SeparationDirection(One)),
        ("vehicle.1.separation_yaw_rate", M::Output(Output::YawRate(One))),
        ("vehicle.1.approach_direction", M::ApproachDirection(One)),
        ("vehicle.1.delta_v_forward", M::DeltaVForward(One)),
        ("vehicle.1.delta_v_left", M::DeltaVLeft(One)),
        ("vehicle.2.crush_energy", M::CrushEnergyOf(Two)),
        ("vehicle.2.equivalent_energy_speed", M::EquivalentEnergySpeed(Two)),
        ("vehicle.2.separation_velocity.x", M::Output(Output::VelocityX(Two))),
        ("vehicle.2.separation_velocity.y", M::Output(Output::VelocityY(Two))),
        ("vehicle.2.separation_speed", M::SeparationSpeed(Two)),
        ("vehicle.2.separation_direction", M::SeparationDirection(Two)),
        ("vehicle.2.separation_yaw_rate", M::Output(Output::YawRate(Two))),
        ("vehicle.2.approach_direction", M::ApproachDirection(Two)),
        ("vehicle.2.delta_v_forward", M::DeltaVForward(Two)),
        ("vehicle.2.delta_v_left", M::DeltaVLeft(Two)),
        ("before.vehicle.1.braking_speed", M::BrakingSpeed(One)),
        ("before.vehicle.2.braking_speed", M::BrakingSpeed(Two)),
        ("contact.closing_speed", M::ClosingSpeed),
        ("contact.restitution", M::Variable(Variable::Input(Input::Restitution))),
        ("contact.impulse_ratio", M::Output(Output::ImpulseRatio)),
        ("contact.critical_impulse_ratio", M::Output(Output::CriticalImpulseRatio)),
        ("mu", M::Output(Output::ImpulseRatio)),
        ("e", M::Variable(Variable::Input(Input::Restitution))),
        ("mu0", M::Output(Output::CriticalImpulseRatio)),
    ]
};

impl Measurand {
    /// Returns its name, such as `vehicle.1.separation_velocity.x`.
    pub fn name(self) -> &'static str {
        if let Some((name, _)) = NAMES.iter().find(|(_, of)| *of == self) {
            return name;
        }
        match self {
            Measurand::Variable(variable) => variable.name(),
            Measurand::Output(output) => output.name(),
            _ => "",
        }
    }

    /// Returns its measure.
    pub fn measure(self) -> Measure {
        match self {
            Measurand::Variable(variable) => variable.measure(),
            Measurand::Output(output) => output.measure(),
            Measurand::CrushEnergy | Measurand::CrushEnergyOf(_) => Measure::Energy,
            Measurand::SeparationDirection(_) | Measurand::ApproachDirection(_) => Measure::Angle,
            Measurand::ClosingSpeed | Measurand::SeparationSpeed(_) | Measurand::BrakingSpeed(_) => Measure::Speed,
            Measurand::DeltaVForward(_) | Measurand::DeltaVLeft(_) | Measurand::EquivalentEnergySpeed(_) => Measure::Speed,
        }
    }

    /// Returns the measurand with a name. A name of both an input and an output, such as `vehicle.1.velocity.x`, is that of the input: the motion before.
    pub fn named(name: &str) -> Option<Measurand> {
        if let Some((_, of)) = NAMES.iter().find(|(own, _)| *own == name) {
            return Some(*of);
        }
        if let Some(variable) = Variable::named(name) {
            return Some(Measurand::Variable(variable));
        }
        Output::named(name).map(Measurand::Output)
    }

    /// Returns every measurand once.
    pub fn all() -> impl Iterator<Item = Measurand> {
        let sides = [Side::One, Side::Two];
        let variables = Input::ALL.into_iter().filter(|input| *input != Input::ImpulseRatio).map(Variable::Input);
        let variables = variables.chain(sides.map(Variable::Speed)).chain([Variable::CrushShare]).map(Measurand::Variable);
        let outputs = Output::ALL.into_iter().filter(|output| *output != Output::Restitution).map(Measurand::Output);
        let of_side = |side| {
            use Measurand::*;
            [
                CrushEnergyOf(side),
                EquivalentEnergySpeed(side),
                SeparationSpeed(side),
                SeparationDirection(side),
                ApproachDirection(side),
                BrakingSpeed(side),
                DeltaVForward(side),
                DeltaVLeft(side),
            ]
        };
        variables.chain(outputs).chain([Measurand::CrushEnergy, Measurand::ClosingSpeed]).chain(sides.into_iter().flat_map(of_side))
    }

    /// Returns its vehicle, or `None` if it does not belong to one.
    pub fn side(self) -> Option<Side> {
        use Measurand::*;
        match self {
            Variable(variable) => variable.side(),
            Output(output) => output.side(),
            CrushEnergy | ClosingSpeed => None,
            CrushEnergyOf(side) | EquivalentEnergySpeed(side) | SeparationSpeed(side) | SeparationDirection(side) => Some(side),
            ApproachDirection(side) | BrakingSpeed(side) | DeltaVForward(side) | DeltaVLeft(side) => Some(side),
        }
    }

    /// Returns its value for an impact, or `None` if absent, such as the ΔV of a barrier.
    pub(super) fn of<T: Real>(self, placed: &Placed<T>, impact: &Impact<T>) -> Option<T> {
        let collision = &placed.collision;
        if let Some(side) = self.side() {
            party(collision, side).vehicle()?;
        }
        let response = |side| match side {
            Side::One => &impact.one,
            Side::Two => &impact.two,
        };
        let after = |side| Response::clone(response(side)).after.velocity;
        let crush_energy = || -impact.work.n.clone();
        let crush_energy_of = |side| match (side, &collision.one, &collision.two) {
            (_, Party::Barrier, _) | (_, _, Party::Barrier) => crush_energy(),
            (Side::One, ..) => placed.crush_share.clone() * crush_energy(),
            (Side::Two, ..) => (T::int(1) - placed.crush_share.clone()) * crush_energy(),
        };
        Some(match self {
            Measurand::Variable(Variable::Impulse(Axis::X)) => impact.impulse_on_ground.x.clone(),
            Measurand::Variable(Variable::Impulse(Axis::Y)) => impact.impulse_on_ground.y.clone(),
            Measurand::Variable(Variable::SkidSpeed(side)) => placed.skids[side as usize].clone()?,
            Measurand::Variable(variable) => variable.of(collision, &placed.crush_share)?,
            Measurand::Output(output) => output.of(collision, impact),
            Measurand::CrushEnergy => crush_energy(),
            Measurand::CrushEnergyOf(side) => crush_energy_of(side),
            Measurand::EquivalentEnergySpeed(side) => {
                speed_of_energy(crush_energy_of(side), party(collision, side).vehicle()?.mass.clone())
            }
            Measurand::ClosingSpeed => impact.approach.n.clone().magnitude(),
            Measurand::SeparationSpeed(side) => after(side).length(),
            Measurand::SeparationDirection(side) => {
                let velocity = after(side);
                velocity.y.arctangent(velocity.x)
            }
            Measurand::ApproachDirection(side) => {
                let velocity = &party(collision, side).vehicle()?.motion.velocity;
                velocity.y.clone().arctangent(velocity.x.clone())
            }
            Measurand::BrakingSpeed(side) => {
                let before = &party(collision, side).vehicle()?.motion.velocity;
                braking_speed(before.clone(), placed.skids[side as usize].clone()?)
            }
            Measurand::DeltaVForward(side) => response(side).delta_v_in_vehicle.forward.clone(),
            Measurand::DeltaVLeft(side) => response(side).delta_v_in_vehicle.left.clone(),
        })
    }

    /// Returns `true` if the collision has it: a barrier has no ΔV.
    pub fn is_in(self, collision: &Collision) -> bool {
        match self {
            Measurand::Variable(variable) => variable.is_in(collision),
            _ => self.side().is_none_or(|side| party(collision, side).vehicle().is_some()),
        }
    }

    /// Returns `true` if it is a share of the crush energy that the mechanics does not determine.
    pub(super) fn needs_share(self, collision: &Collision) -> bool {
        matches!(self, Measurand::CrushEnergyOf(_) | Measurand::EquivalentEnergySpeed(_)) && Variable::CrushShare.is_in(collision)
    }

    /// Returns `true` if it needs the normal of the contact, which momentum alone does not have.
    pub fn is_of_contact(self) -> bool {
        use Output::{CriticalImpulseRatio, ImpulseRatio, NormalImpulse, NormalWork, Restitution, TangentialImpulse, TangentialWork};
        match self {
            Measurand::ClosingSpeed | Measurand::CrushEnergy | Measurand::CrushEnergyOf(_) | Measurand::EquivalentEnergySpeed(_) => true,
            Measurand::Variable(Variable::Input(Input::Restitution | Input::ImpulseRatio | Input::CrushPlane | Input::Moment)) => true,
            Measurand::Variable(Variable::CrushShare) => true,
            Measurand::Output(output) => {
                matches!(
                    output,
                    Restitution | ImpulseRatio | CriticalImpulseRatio | NormalImpulse | TangentialImpulse | NormalWork | TangentialWork
                )
            }
            _ => false,
        }
    }

    /// Returns the vehicle whose skid speed it takes, if it takes one.
    pub(super) fn skid(self) -> Option<Side> {
        match self {
            Measurand::BrakingSpeed(side) | Measurand::Variable(Variable::SkidSpeed(side)) => Some(side),
            _ => None,
        }
    }

    /// Returns the period of an angle, or `None` if it is not an angle.
    pub(super) fn period(self) -> Option<f64> {
        match self {
            Measurand::Variable(variable) => variable.period(),
            Measurand::Output(Output::PrincipalDirectionOfForce(_))
            | Measurand::SeparationDirection(_)
            | Measurand::ApproachDirection(_) => Some(TAU),
            _ => None,
        }
    }

    /// Returns `true` if it is never negative.
    pub(super) fn is_magnitude(self) -> bool {
        use Output::*;
        match self {
            Measurand::CrushEnergy | Measurand::CrushEnergyOf(_) | Measurand::ClosingSpeed | Measurand::SeparationSpeed(_) => true,
            Measurand::EquivalentEnergySpeed(_) | Measurand::BrakingSpeed(_) | Measurand::Variable(Variable::SkidSpeed(_)) => true,
            Measurand::Variable(Variable::Input(input)) => matches!(input, Input::Mass(_) | Input::YawInertia(_) | Input::Restitution),
            Measurand::Variable(Variable::CrushShare) => true,
            Measurand::Output(output) => matches!(output, DeltaVMagnitude(_) | EnergyBefore | EnergyAfter | Loss),
            _ => false,
        }
    }

    /// Returns the size, in its unit, below which the size of a value does not indicate its precision.
    pub(super) fn least_size(self) -> f64 {
        use Output::*;
        match self {
            Measurand::CrushEnergy | Measurand::CrushEnergyOf(_) => 100.0,
            Measurand::Output(EnergyBefore | EnergyAfter | Loss | NormalWork | TangentialWork | MomentWork) => 100.0,
            Measurand::Output(NormalImpulse | TangentialImpulse | ImpulseX | ImpulseY | Moment) => 100.0,
            _ => 1.0,
        }
    }
}
