//! The collision and the crush of a case file, on any scalar type.
//!
//! Varying a parameter leaves the other keys of the file unchanged: the velocity of a vehicle given by its speed
//! turns with its heading, one given as components does not; a vehicle given by its radius of gyration changes its
//! yaw inertia with its mass; a restitution over the closing speed follows whatever changes that speed.

use planar_impact::crash3::{DamagedPair, Investigated, Surface};
use planar_impact::crush::speed_of_energy;
use planar_impact::skid::braking_speed;
use planar_impact::{
    Collision, CrushPlane, ForceDirection, ForwardLeft, Heading, Impact, Input, Moment, Motion, Output, Outputs, Party, Real, Refusals,
    Side, Vehicle, Xy,
};

use super::crush::Crush;
use super::inputs::{Inputs, moment_parameter, ratio_parameter};
use super::outputs::{CaseOutput, CaseOutputs, Crash3Key, Crash3Outputs, CrushOutputs};
use super::parameter::{Parameter, number};
use super::restitution::Restitution;
use super::vehicle::{Inertia, VehicleInputs, Velocity};

/// A collision and the crush that the file reports, on any scalar type.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup<T = f64> {
    /// The collision.
    pub collision: Collision<T>,
    /// The crush of vehicle 1 and of vehicle 2.
    pub crush: [Option<Crush<T>>; 2],
    /// The speed from which the skids before the impact bring vehicle 1 and vehicle 2 to rest.
    pub skid_speeds: [Option<T>; 2],
}

impl Inputs {
    /// Returns the collision and the crush on any scalar type, adding `by` of its key to each parameter: zero for
    /// values, an infinitesimal for derivatives. An addition to a parameter that the case does not have is ignored.
    pub fn setup<T: Real + From<f64>>(&self, mut by: impl FnMut(Parameter) -> T) -> Setup<T> {
        let mut vehicle = |i: usize, side| self.vehicles[i].as_ref().map(|vehicle| on_scalar(vehicle, side, &mut by));
        let (one, two) = (vehicle(0, Side::One).unzip(), vehicle(1, Side::Two).unzip());
        let skid_speeds = Side::ALL.map(|side| {
            let braking = self.vehicles[side as usize].as_ref()?.braking.as_ref()?;
            Some(braking.skid_speed(|key| by(Parameter::Skid(side, key))))
        });
        let party = |vehicle: Option<Vehicle<T>>| vehicle.map_or(Party::Barrier, Party::Vehicle);
        let contact = &self.contact;
        let mut plus = |value: f64, parameter| T::from(value) + by(parameter);
        let crush_plane = CrushPlane::from_angle(plus(contact.crush_plane, Parameter::Input(Input::CrushPlane)));
        let collision = Collision::new(party(one.0), party(two.0)).with_crush_plane(crush_plane);
        let restitution = match &contact.restitution {
            Restitution::Given(value) => plus(*value, Parameter::Input(Input::Restitution)),
            Restitution::OfClosingSpeed(curve) => {
                let scatter = plus(curve.scatter, Parameter::RestitutionScatter);
                curve.of(&collision, scatter) + plus(0.0, Parameter::Input(Input::Restitution))
            }
        };
        let collision = Collision {
            restitution,
            impulse_ratio: contact.impulse_ratio.map(|value| plus(value, ratio_parameter(&contact.impulse_ratio))),
            law: contact.law,
            moment: contact.moment.map(|value| plus(value, moment_parameter(&contact.moment))),
            ..collision
        };
        Setup { collision, crush: [one.1.flatten(), two.1.flatten()], skid_speeds }
    }

    /// Returns the setup with the values of the file.
    pub fn as_given(&self) -> Setup {
        self.setup(|_| 0.0)
    }
}

fn on_scalar<T: Real + From<f64>>(
    vehicle: &VehicleInputs,
    side: Side,
    by: &mut impl FnMut(Parameter) -> T,
) -> (Vehicle<T>, Option<Crush<T>>) {
    let mut plus = |value: f64, parameter| T::from(value) + by(parameter);
    let mut input = |value: f64, input: fn(Side) -> Input| plus(value, Parameter::Input(input(side)));
    let mass = input(vehicle.mass, Input::Mass);
    let heading = Heading::from_angle(input(vehicle.heading, Input::Heading));
    let impact_center = ForwardLeft {
        forward: input(vehicle.impact_center.forward, Input::ImpactCenterForward),
        left: input(vehicle.impact_center.left, Input::ImpactCenterLeft),
    };
    let yaw_rate = input(vehicle.yaw_rate, Input::YawRate);
    let yaw_inertia = match vehicle.inertia {
        Inertia::Yaw(inertia) => input(inertia, Input::YawInertia),
        Inertia::Radius(_) => input(0.0, Input::YawInertia),
    };
    let given = match vehicle.velocity {
        Velocity::Speed(_) => Xy { x: 0.0, y: 0.0 },
        Velocity::Components(velocity) => velocity,
    };
    let across = Xy { x: input(given.x, Input::VelocityX), y: input(given.y, Input::VelocityY) };
    let yaw_inertia = match vehicle.inertia {
        Inertia::Yaw(_) => yaw_inertia,
        Inertia::Radius(radius) => mass.clone() * plus(radius, Parameter::RadiusOfGyration(side)).squared() + yaw_inertia,
    };
    let along = match vehicle.velocity {
        Velocity::Speed(speed) => plus(speed, Parameter::Speed(side)),
        Velocity::Components(_) => plus(0.0, Parameter::Speed(side)),
    };
    let crush = vehicle.crush.as_ref().map(|crush| crush.on_scalar(|key| by(Parameter::Crush(side, key))));
    let velocity = heading.to_ground(ForwardLeft { forward: along, left: T::int(0) }) + across;
    (Vehicle { mass, yaw_inertia, heading, impact_center, motion: Motion { velocity, yaw_rate } }, crush)
}

impl<T: Real<Mask = bool>> Setup<T> {
    /// Computes the outputs without checking that the collision is possible.
    pub fn evaluate(&self) -> CaseOutputs<T> {
        self.outputs_of(&self.collision.evaluate())
    }

    /// Computes the outputs of a solved impact.
    pub fn outputs_of(&self, impact: &Impact<T>) -> CaseOutputs<T> {
        let crush = self.crush_outputs();
        CaseOutputs {
            impact: Outputs::of(&self.collision, impact),
            crash3: self.crash3_outputs(&crush),
            braking_speeds: Side::ALL.map(|side| self.braking_speed(side)),
            crush,
        }
    }

    /// Computes the crush outputs of each vehicle; `None` if its stations or depths are impossible.
    pub fn crush_outputs(&self) -> [Option<CrushOutputs<T>>; 2] {
        let is_possible = |crush: &Option<Crush<T>>| crush.as_ref().is_some_and(|crush| crush.profile.clone().checked().is_ok());
        Side::ALL.map(|side| self.crush_of(side).filter(|_| is_possible(&self.crush[side as usize])))
    }

    /// Returns the damage that CRASH3 starts from: the crush energy of every vehicle, and the direction of force
    /// given in the file or, if absent, that of the common-velocity impulse. Returns `None` if a vehicle has no
    /// crush.
    pub fn damaged_pair(&self, crush: &[Option<CrushOutputs<T>>; 2]) -> Option<DamagedPair<T>> {
        self.energies(crush).map(|energies| self.damaged_along(energies))
    }

    /// Returns the damage of given crush energies on the surfaces that the file gives or, if absent, those along the crush plane.
    pub fn damaged_along(&self, energies: [T; 2]) -> DamagedPair<T> {
        self.damaged(energies, |_, vehicle, origin| Surface::along(&self.collision.crush_plane, &vehicle.heading, origin))
    }

    /// Computes the CRASH3 results of each vehicle; `None` if a vehicle has no crush.
    pub fn crash3_outputs(&self, crush: &[Option<CrushOutputs<T>>; 2]) -> [Option<Crash3Outputs<T>>; 2] {
        self.damaged_pair(crush).map_or([None, None], Crash3Outputs::of_pair)
    }
}

/// Nothing here compares numbers to decide, so that it holds for intervals too.
impl<T: Real> Setup<T> {
    /// Computes the speed of a vehicle when it began to brake; `None` without skids.
    pub fn braking_speed(&self, side: Side) -> Option<T> {
        let (vehicle, skid) = (self.vehicle(side)?, self.skid_speeds[side as usize].clone()?);
        Some(braking_speed(vehicle.motion.velocity.clone(), skid))
    }

    /// Computes the crush outputs of a vehicle, unchecked; `None` without a crush.
    pub fn crush_of(&self, side: Side) -> Option<CrushOutputs<T>> {
        let (vehicle, crush) = (self.vehicle(side)?, self.crush[side as usize].as_ref()?);
        let (moments, energy) = (crush.profile.moments(), crush.energy());
        let equivalent_speed = speed_of_energy(energy.clone(), vehicle.mass.clone());
        Some(CrushOutputs { energy, equivalent_speed, mean_depth: moments.mean_depth(), moments })
    }

    /// Returns the crush energies of the vehicles, 0 for a barrier; `None` if a vehicle has no crush.
    pub fn energies(&self, crush: &[Option<CrushOutputs<T>>; 2]) -> Option<[T; 2]> {
        let energy = |side: Side| match &crush[side as usize] {
            Some(crush) => Some(crush.energy.clone()),
            None => self.vehicle(side).is_none().then(|| T::int(0)),
        };
        Some([energy(Side::One)?, energy(Side::Two)?])
    }

    /// Returns the damage of given crush energies. Surfaces and directions of force are those that the file gives or, if absent, those that `surface` tells and
    /// that of the common-velocity impulse.
    pub fn damaged(&self, energies: [T; 2], surface: impl Fn(Side, &Vehicle<T>, &ForceDirection<T>) -> Surface) -> DamagedPair<T> {
        let found = self.crush.each_ref().map(|crush| Investigated {
            surface: crush.as_ref().and_then(|crush| crush.surface),
            force_direction: crush.as_ref().and_then(|crush| crush.force_direction.clone()),
        });
        DamagedPair::investigated(&self.collision, energies, found, surface)
    }

    fn vehicle(&self, side: Side) -> Option<&Vehicle<T>> {
        self.collision.parties()[side as usize].vehicle()
    }
}

impl Setup {
    /// Solves the collision and computes the outputs.
    ///
    /// # Errors
    ///
    /// Returns every reason why the collision is refused.
    pub fn solve(&self) -> Result<CaseOutputs, Refusals> {
        Ok(self.outputs_of(&self.collision.solve()?))
    }

    /// Returns every output that this setup has, in the order of the JSON of `solve`.
    pub fn outputs(&self) -> Vec<CaseOutput> {
        let has_moment = self.collision.moment != Moment::None;
        let has = |output: &Output| has_moment || !matches!(output, Output::Moment | Output::MomentWork);
        let mut all = Vec::new();
        for output in Output::ALL.into_iter().filter(has) {
            all.push(CaseOutput::Impact(output));
            for (side, crush) in [Side::One, Side::Two].into_iter().zip(&self.crush) {
                if output == Output::PrincipalDirectionOfForce(side) && crush.is_some() {
                    all.extend([CaseOutput::CrushEnergy(side), CaseOutput::EquivalentEnergySpeed(side), CaseOutput::MeanDepth(side)]);
                    if self.has_crash3() {
                        all.extend(Crash3Key::ALL.map(|key| CaseOutput::Crash3(side, key)));
                    }
                }
            }
        }
        let braking = Side::ALL.into_iter().filter(|side| self.skid_speeds[*side as usize].is_some());
        all.extend(braking.map(CaseOutput::BrakingSpeed));
        all
    }

    /// Returns `true` if every vehicle has a crush.
    fn has_crash3(&self) -> bool {
        let parties = self.collision.parties();
        parties.into_iter().zip(&self.crush).all(|(party, crush)| party.vehicle().is_none() || crush.is_some())
    }

    /// Returns why this setup lacks an output, or `None` if it has it.
    pub fn lacks(&self, answer: CaseOutput) -> Option<String> {
        match answer {
            CaseOutput::Impact(Output::Moment | Output::MomentWork) if self.collision.moment == Moment::None => {
                Some("the case has no moment impulse".to_owned())
            }
            CaseOutput::CrushEnergy(side)
            | CaseOutput::EquivalentEnergySpeed(side)
            | CaseOutput::MeanDepth(side)
            | CaseOutput::Crash3(side, _)
                if self.crush[side as usize].is_none() =>
            {
                Some(format!("vehicle {} has no crush in this case", number(side)))
            }
            CaseOutput::BrakingSpeed(side) if self.skid_speeds[side as usize].is_none() => {
                Some(format!("vehicle {} has no skids in this case", number(side)))
            }
            CaseOutput::Crash3(..) if !self.has_crash3() => Some("CRASH3 needs the crush of both vehicles".to_owned()),
            _ => None,
        }
    }
}
