//! The numbers of a vehicle in a case file.

use planar_impact::{ForwardLeft, Heading, Input, Xy};

use super::braking::BrakingInputs;
use super::crush::CrushInputs;
use super::parameter::Parameter;

/// A vehicle of a case file.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleInputs {
    /// The mass.
    pub mass: f64,
    /// The yaw inertia, or the radius of gyration.
    pub inertia: Inertia,
    /// The angle of the heading.
    pub heading: f64,
    /// The velocity, as a speed or as components.
    pub velocity: Velocity,
    /// The yaw rate.
    pub yaw_rate: f64,
    /// The impact center.
    pub impact_center: ForwardLeft,
    /// Its size on a plan, for drawings.
    pub size: Size,
    /// The crush, if the file has it.
    pub crush: Option<CrushInputs>,
    /// Its braking before the impact, if the file has it.
    pub braking: Option<BrakingInputs>,
}

/// Size of a vehicle on a plan, in m; the mechanics does not use it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    /// From bumper to bumper.
    pub length: Option<f64>,
    /// From side to side.
    pub width: Option<f64>,
    /// From the front axle to the front end.
    pub front_overhang: Option<f64>,
}

/// Form in which a file gives a yaw inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// The yaw inertia itself.
    Yaw(f64),
    /// The radius of gyration.
    Radius(f64),
}

/// Form in which a file gives a velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity {
    /// A speed along the heading.
    Speed(f64),
    /// Components in ground axes.
    Components(Xy),
}

impl Inertia {
    /// Returns the yaw inertia of a vehicle of this mass.
    pub fn of(self, mass: f64) -> f64 {
        match self {
            Inertia::Yaw(inertia) => inertia,
            Inertia::Radius(radius) => mass * (radius * radius),
        }
    }
}

impl Velocity {
    /// Returns the velocity in ground axes, of a vehicle with this heading.
    pub fn on_ground(self, heading: f64) -> Xy {
        match self {
            Velocity::Speed(speed) => Heading::from_angle(heading).to_ground(ForwardLeft { forward: speed, left: 0.0 }),
            Velocity::Components(velocity) => velocity,
        }
    }
}

impl VehicleInputs {
    /// Returns the velocity in ground axes.
    pub fn velocity(&self) -> Xy {
        self.velocity.on_ground(self.heading)
    }

    /// Returns the yaw inertia.
    pub fn yaw_inertia(&self) -> f64 {
        self.inertia.of(self.mass)
    }

    /// Returns `true` if the velocity has a component across the heading, which a speed has none of.
    pub fn moves_across(&self) -> bool {
        let Velocity::Components(velocity) = self.velocity else { return false };
        Heading::from_angle(self.heading).to_vehicle(velocity).left.abs() > 1e-9 * velocity.length()
    }

    fn ahead(&self) -> f64 {
        match self.velocity {
            Velocity::Speed(speed) => speed,
            Velocity::Components(velocity) => Heading::from_angle(self.heading).to_vehicle(velocity).forward,
        }
    }

    /// Returns the value of a parameter.
    ///
    /// # Errors
    ///
    /// Returns a message if this vehicle does not have the parameter.
    pub fn value(&self, parameter: Parameter) -> Result<f64, String> {
        let crush = || self.crush.as_ref().ok_or_else(|| "the vehicle has no crush in this case".to_owned());
        Ok(match parameter {
            Parameter::Input(Input::Mass(_)) => self.mass,
            Parameter::Input(Input::YawInertia(_)) => self.yaw_inertia(),
            Parameter::Input(Input::Heading(_)) => self.heading,
            Parameter::Input(Input::ImpactCenterForward(_)) => self.impact_center.forward,
            Parameter::Input(Input::ImpactCenterLeft(_)) => self.impact_center.left,
            Parameter::Input(Input::VelocityX(_)) => self.velocity().x,
            Parameter::Input(Input::VelocityY(_)) => self.velocity().y,
            Parameter::Input(Input::YawRate(_)) => self.yaw_rate,
            Parameter::Speed(_) => self.ahead(),
            Parameter::RadiusOfGyration(_) => match self.inertia {
                Inertia::Radius(radius) => radius,
                Inertia::Yaw(_) => return Err("the case gives `yaw_inertia` instead".to_owned()),
            },
            Parameter::Crush(_, key) => crush()?.value(key)?,
            Parameter::Skid(_, key) => self.braking.as_ref().ok_or("the vehicle has no skids in this case")?.value(key)?,
            _ => return Err("it belongs to the contact".to_owned()),
        })
    }

    /// Sets a parameter, which the vehicle must have.
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        match (parameter, &mut self.crush) {
            (Parameter::Input(Input::Mass(_)), _) => self.mass = value,
            (Parameter::Input(Input::YawInertia(_)), _) => self.inertia = Inertia::Yaw(value),
            (Parameter::RadiusOfGyration(_), _) => self.inertia = Inertia::Radius(value),
            (Parameter::Input(Input::Heading(_)), _) => self.heading = value,
            (Parameter::Input(Input::ImpactCenterForward(_)), _) => self.impact_center.forward = value,
            (Parameter::Input(Input::ImpactCenterLeft(_)), _) => self.impact_center.left = value,
            (Parameter::Input(Input::VelocityX(_)), _) => self.velocity = Velocity::Components(Xy { x: value, ..self.velocity() }),
            (Parameter::Input(Input::VelocityY(_)), _) => self.velocity = Velocity::Components(Xy { y: value, ..self.velocity() }),
            (Parameter::Input(Input::YawRate(_)), _) => self.yaw_rate = value,
            (Parameter::Speed(_), _) => {
                self.velocity = match self.velocity {
                    Velocity::Speed(_) => Velocity::Speed(value),
                    Velocity::Components(velocity) => {
                        let more = ForwardLeft { forward: value - self.ahead(), left: 0.0 };
                        Velocity::Components(velocity + Heading::from_angle(self.heading).to_ground(more))
                    }
                }
            }
            (Parameter::Crush(_, key), Some(crush)) => crush.set(key, value),
            (Parameter::Skid(_, key), _) => {
                if let Some(braking) = &mut self.braking {
                    braking.set(key, value);
                }
            }
            _ => unreachable!("a value can be set"),
        }
    }
}
