//! What can be evidence.

use std::f64::consts::TAU;

use super::scene::Placed;
use super::variable::{Variable, party};
use crate::collision::Collision;
use crate::impact::{Impact, Response};
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::Real;
use crate::vehicle::Party;

/// What can be known of a crash and compared with what the mechanics makes of it.
///
/// ```
/// use planar_impact::reconstruct::Measurable;
/// use planar_impact::{Output, Side};
/// assert_eq!(Measurable::named("vehicle.1.separation_yaw_rate"), Some(Measurable::Output(Output::YawRate(Side::One))));
/// assert_eq!(Measurable::DeltaVForward(Side::Two).name(), "vehicle.2.delta_v_forward");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measurable {
    /// What goes into the collision, such as a known approach speed.
    Variable(Variable),
    /// What comes out of it. After the impact the names of motions begin with `separation_`, as `vehicle.1.separation_velocity.x`.
    Output(Output),
    /// The crush energy of both vehicles, E_C = −W_n, in J (Eq 7).
    CrushEnergy,
    /// The crush energy of one vehicle, in J: its share of −W_n.
    CrushEnergyOf(Side),
    /// How fast a vehicle's center of mass leaves, in m/s.
    SeparationSpeed(Side),
    /// Which way it leaves: the angle from x, counter-clockwise, in rad.
    SeparationDirection(Side),
    /// Which way it comes, whatever its heading, as tire marks tell of a car that slides: the angle from x, counter-clockwise, in rad.
    ApproachDirection(Side),
    /// Change of velocity along the vehicle, forward positive, in m/s: the longitudinal ΔV of an event data recorder.
    DeltaVForward(Side),
    /// Change of velocity across the vehicle, to its left positive, in m/s: the lateral ΔV of an event data recorder, which counts it to the right.
    DeltaVLeft(Side),
}

/// The names that are not those of an output or of an input.
const NAMES: [(&str, Measurable); 25] = {
    use Measurable as M;
    use Side::{One, Two};
    [
        ("crush_energy", M::CrushEnergy),
        ("vehicle.1.crush_energy", M::CrushEnergyOf(One)),
        ("vehicle.1.separation_velocity.x", M::Output(Output::VelocityX(One))),
        ("vehicle.1.separation_velocity.y", M::Output(Output::VelocityY(One))),
        ("vehicle.1.separation_speed", M::SeparationSpeed(One)),
        ("vehicle.1.separation_direction", M::SeparationDirection(One)),
        ("vehicle.1.separation_yaw_rate", M::Output(Output::YawRate(One))),
        ("vehicle.1.approach_direction", M::ApproachDirection(One)),
        ("vehicle.1.delta_v_forward", M::DeltaVForward(One)),
        ("vehicle.1.delta_v_left", M::DeltaVLeft(One)),
        ("vehicle.2.crush_energy", M::CrushEnergyOf(Two)),
        ("vehicle.2.separation_velocity.x", M::Output(Output::VelocityX(Two))),
        ("vehicle.2.separation_velocity.y", M::Output(Output::VelocityY(Two))),
        ("vehicle.2.separation_speed", M::SeparationSpeed(Two)),
        ("vehicle.2.separation_direction", M::SeparationDirection(Two)),
        ("vehicle.2.separation_yaw_rate", M::Output(Output::YawRate(Two))),
        ("vehicle.2.approach_direction", M::ApproachDirection(Two)),
        ("vehicle.2.delta_v_forward", M::DeltaVForward(Two)),
        ("vehicle.2.delta_v_left", M::DeltaVLeft(Two)),
        ("contact.restitution", M::Variable(Variable::Input(Input::Restitution))),
        ("contact.impulse_ratio", M::Output(Output::ImpulseRatio)),
        ("contact.critical_impulse_ratio", M::Output(Output::CriticalImpulseRatio)),
        ("mu", M::Output(Output::ImpulseRatio)),
        ("e", M::Variable(Variable::Input(Input::Restitution))),
        ("mu0", M::Output(Output::CriticalImpulseRatio)),
    ]
};

impl Measurable {
    /// Its name, such as `vehicle.1.separation_velocity.x`.
    pub fn name(self) -> &'static str {
        if let Some((name, _)) = NAMES.iter().find(|(_, of)| *of == self) {
            return name;
        }
        match self {
            Measurable::Variable(variable) => variable.name(),
            Measurable::Output(output) => output.name(),
            _ => "",
        }
    }

    /// What a name means as evidence. A name that is both of an input and of an output, as `vehicle.1.velocity.x`, is of the input: the motion before.
    pub fn named(name: &str) -> Option<Measurable> {
        if let Some((_, of)) = NAMES.iter().find(|(own, _)| *own == name) {
            return Some(*of);
        }
        if let Some(variable) = Variable::named(name) {
            return Some(Measurable::Variable(variable));
        }
        Output::named(name).map(Measurable::Output)
    }

    /// Every one of them, once.
    pub fn all() -> impl Iterator<Item = Measurable> {
        let sides = [Side::One, Side::Two];
        let variables = Input::ALL.into_iter().filter(|input| *input != Input::ImpulseRatio).map(Variable::Input);
        let variables = variables.chain(sides.map(Variable::Speed)).chain([Variable::CrushShare]).map(Measurable::Variable);
        let outputs = Output::ALL.into_iter().filter(|output| *output != Output::Restitution).map(Measurable::Output);
        let of_side = |side| {
            use Measurable::*;
            [
                CrushEnergyOf(side),
                SeparationSpeed(side),
                SeparationDirection(side),
                ApproachDirection(side),
                DeltaVForward(side),
                DeltaVLeft(side),
            ]
        };
        variables.chain(outputs).chain([Measurable::CrushEnergy]).chain(sides.into_iter().flat_map(of_side))
    }

    /// The vehicle that it is of, if of one.
    pub fn side(self) -> Option<Side> {
        use Measurable::*;
        match self {
            Variable(variable) => variable.side(),
            Output(output) => output.side(),
            CrushEnergy => None,
            CrushEnergyOf(side) | SeparationSpeed(side) | SeparationDirection(side) => Some(side),
            ApproachDirection(side) | DeltaVForward(side) | DeltaVLeft(side) => Some(side),
        }
    }

    /// What it is of an impact; none where there is no such thing, as the ΔV of a barrier.
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
        Some(match self {
            Measurable::Variable(variable) => variable.of(collision, &placed.crush_share)?,
            Measurable::Output(output) => output.of(collision, impact),
            Measurable::CrushEnergy => crush_energy(),
            Measurable::CrushEnergyOf(side) => match (side, &collision.one, &collision.two) {
                (_, Party::Barrier, _) | (_, _, Party::Barrier) => crush_energy(),
                (Side::One, ..) => placed.crush_share.clone() * crush_energy(),
                (Side::Two, ..) => (T::int(1) - placed.crush_share.clone()) * crush_energy(),
            },
            Measurable::SeparationSpeed(side) => after(side).length(),
            Measurable::SeparationDirection(side) => {
                let velocity = after(side);
                velocity.y.atan2(velocity.x)
            }
            Measurable::ApproachDirection(side) => {
                let velocity = &party(collision, side).vehicle()?.motion.velocity;
                velocity.y.clone().atan2(velocity.x.clone())
            }
            Measurable::DeltaVForward(side) => response(side).delta_v_in_vehicle.forward.clone(),
            Measurable::DeltaVLeft(side) => response(side).delta_v_in_vehicle.left.clone(),
        })
    }

    /// Whether the collision has it.
    pub(super) fn is_in(self, collision: &Collision) -> bool {
        match self {
            Measurable::Variable(variable) => variable.is_in(collision),
            _ => self.side().is_none_or(|side| party(collision, side).vehicle().is_some()),
        }
    }

    /// Whether it is a share of the crush energy that the mechanics does not know.
    pub(super) fn needs_share(self, collision: &Collision) -> bool {
        matches!(self, Measurable::CrushEnergyOf(_)) && Variable::CrushShare.is_in(collision)
    }

    /// The angle after which it is the same again, if it is an angle.
    pub(super) fn period(self) -> Option<f64> {
        match self {
            Measurable::Variable(variable) => variable.period(),
            Measurable::Output(Output::PrincipalDirectionOfForce(_))
            | Measurable::SeparationDirection(_)
            | Measurable::ApproachDirection(_) => Some(TAU),
            _ => None,
        }
    }

    /// Whether it is never below zero.
    pub(super) fn is_magnitude(self) -> bool {
        use Output::*;
        match self {
            Measurable::CrushEnergy | Measurable::CrushEnergyOf(_) | Measurable::SeparationSpeed(_) => true,
            Measurable::Variable(Variable::Input(input)) => matches!(input, Input::Mass(_) | Input::YawInertia(_) | Input::Restitution),
            Measurable::Variable(Variable::CrushShare) => true,
            Measurable::Output(output) => matches!(output, DeltaVMagnitude(_) | EnergyBefore | EnergyAfter | Loss),
            _ => false,
        }
    }

    /// Below this size, in its unit, the size of a value says nothing of how well it is known.
    pub(super) fn least_size(self) -> f64 {
        use Output::*;
        match self {
            Measurable::CrushEnergy | Measurable::CrushEnergyOf(_) => 100.0,
            Measurable::Output(EnergyBefore | EnergyAfter | Loss | NormalWork | TangentialWork | MomentWork) => 100.0,
            Measurable::Output(NormalImpulse | TangentialImpulse | ImpulseX | ImpulseY | Moment) => 100.0,
            _ => 1.0,
        }
    }
}
