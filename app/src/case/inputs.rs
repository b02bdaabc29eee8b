//! The numbers of a case file, read and set by name.

use planar_impact::{ImpulseRatio, Input, Law, Moment, Side};

use super::braking::BrakingInputs;
use super::parameter::{self, Parameter};
use super::restitution::Restitution;
use super::vehicle::{Inertia, VehicleInputs, Velocity};

/// The numbers of a case file, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// Vehicle 1 and vehicle 2; `None` for a fixed barrier.
    pub vehicles: [Option<VehicleInputs>; 2],
    /// The contact between the vehicles.
    pub contact: ContactInputs,
}

/// The contact of a case file.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactInputs {
    /// The angle of the crush plane.
    pub crush_plane: f64,
    /// The coefficient of restitution.
    pub restitution: Restitution,
    /// The impulse ratio.
    pub impulse_ratio: ImpulseRatio,
    /// The law of the tangential impulse.
    pub law: Law,
    /// The moment impulse.
    pub moment: Moment,
}

impl Inputs {
    /// Returns every parameter of this case, in file order.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut all = Vec::new();
        for (vehicle, side) in self.vehicles.iter().zip([Side::One, Side::Two]) {
            let Some(vehicle) = vehicle else { continue };
            all.push(Parameter::Input(Input::Mass(side)));
            all.push(Parameter::Input(Input::YawInertia(side)));
            if matches!(vehicle.inertia, Inertia::Radius(_)) {
                all.push(Parameter::RadiusOfGyration(side));
            }
            all.extend([Input::Heading(side), Input::VelocityX(side), Input::VelocityY(side)].map(Parameter::Input));
            all.push(Parameter::Speed(side));
            all.extend([Input::YawRate(side), Input::ImpactCenterForward(side), Input::ImpactCenterLeft(side)].map(Parameter::Input));
            if let Some(crush) = &vehicle.crush {
                all.extend(crush.keys().into_iter().map(|key| Parameter::Crush(side, key)));
            }
            all.extend(vehicle.braking.iter().flat_map(BrakingInputs::keys).map(|key| Parameter::Skid(side, key)));
        }
        all.extend([Input::CrushPlane, Input::Restitution].map(Parameter::Input));
        if let Restitution::OfClosingSpeed(curve) = &self.contact.restitution
            && curve.has_scatter()
        {
            all.push(Parameter::RestitutionScatter);
        }
        all.push(Parameter::Input(Input::ImpulseRatio));
        if ratio_parameter(&self.contact.impulse_ratio) != Parameter::Input(Input::ImpulseRatio) {
            all.push(ratio_parameter(&self.contact.impulse_ratio));
        }
        if self.contact.moment != Moment::None {
            all.push(moment_parameter(&self.contact.moment));
        }
        all
    }

    /// Returns the parameters that are keys of the file, without alternative forms of the same quantity.
    pub fn keys(&self) -> Vec<Parameter> {
        let vehicle = |side| self.vehicle(side).expect("parameters are of vehicles");
        let is_key = |parameter: &Parameter| match *parameter {
            Parameter::Input(Input::YawInertia(side)) => matches!(vehicle(side).inertia, Inertia::Yaw(_)),
            Parameter::Input(Input::VelocityX(side) | Input::VelocityY(side)) => matches!(vehicle(side).velocity, Velocity::Components(_)),
            Parameter::Speed(side) => matches!(vehicle(side).velocity, Velocity::Speed(_)),
            Parameter::Input(Input::ImpulseRatio) => matches!(self.contact.impulse_ratio, ImpulseRatio::Given(_)),
            _ => true,
        };
        self.parameters().into_iter().filter(is_key).collect()
    }

    /// Returns the value of a parameter.
    ///
    /// # Errors
    ///
    /// Returns a message if this case does not have the parameter. The impulse ratio has no value if the file gives
    /// none, although it is listed among the parameters.
    pub fn value(&self, parameter: Parameter) -> Result<f64, String> {
        let contact = &self.contact;
        if let Some(side) = parameter.side() {
            let vehicle = self.vehicle(side).ok_or_else(|| format!("vehicle {} is a fixed barrier", parameter::number(side)))?;
            return vehicle.value(parameter);
        }
        match parameter {
            Parameter::Input(Input::CrushPlane) => Ok(contact.crush_plane),
            Parameter::RestFriction => Err("the friction of [rest] is no input of the case".to_owned()),
            Parameter::Input(Input::Restitution) => Ok(match contact.restitution {
                Restitution::Given(value) => value,
                Restitution::OfClosingSpeed(_) => self.as_given().collision.restitution,
            }),
            Parameter::RestitutionScatter => match &contact.restitution {
                Restitution::OfClosingSpeed(curve) if curve.has_scatter() => Ok(curve.scatter),
                _ => Err("the case has no restitution over the closing speed with a standard deviation".to_owned()),
            },
            Parameter::Input(Input::Moment) | Parameter::MomentOfCritical => match contact.moment {
                Moment::None => Err("the case has no moment impulse".to_owned()),
                Moment::Given(x) | Moment::OfCritical(x) if moment_parameter(&contact.moment) == parameter => Ok(x),
                _ => Err(format!("the case gives `{}`", moment_parameter(&contact.moment))),
            },
            _ => match contact.impulse_ratio {
                ImpulseRatio::Critical => Err("the case is at the critical impulse ratio".to_owned()),
                ImpulseRatio::Given(x) | ImpulseRatio::OfCritical(x) | ImpulseRatio::LimitedByFriction(x)
                    if ratio_parameter(&contact.impulse_ratio) == parameter =>
                {
                    Ok(x)
                }
                _ => Err(format!("the case gives `{}`", ratio_parameter(&contact.impulse_ratio))),
            },
        }
    }

    fn vehicle(&self, side: Side) -> Option<&VehicleInputs> {
        self.vehicles[side as usize].as_ref()
    }

    /// Checks that a parameter can be set: either the case has it, or it is the number of an impulse ratio or moment
    /// that the case leaves open.
    ///
    /// # Errors
    ///
    /// Returns a message if it cannot be set.
    pub fn can_set(&self, parameter: Parameter) -> Result<(), String> {
        let ratio = matches!(parameter, Parameter::Input(Input::ImpulseRatio) | Parameter::Friction | Parameter::RatioOfCritical);
        let moment = matches!(parameter, Parameter::Input(Input::Moment) | Parameter::MomentOfCritical);
        if ratio && self.contact.impulse_ratio == ImpulseRatio::Critical || moment && self.contact.moment == Moment::None {
            return Ok(());
        }
        self.value(parameter).map(|_| ())
    }

    /// Sets a parameter. When setting several, set headings and masses first; [`Inputs::set_all`] does so.
    fn set(&mut self, parameter: Parameter, value: f64) {
        let contact = &mut self.contact;
        match parameter {
            Parameter::Input(Input::CrushPlane) => contact.crush_plane = value,
            Parameter::Input(Input::Restitution) => contact.restitution = Restitution::Given(value),
            Parameter::RestitutionScatter => {
                if let Restitution::OfClosingSpeed(curve) = &mut contact.restitution {
                    curve.scatter = value;
                }
            }
            Parameter::Input(Input::ImpulseRatio) => contact.impulse_ratio = ImpulseRatio::Given(value),
            Parameter::RatioOfCritical => contact.impulse_ratio = ImpulseRatio::OfCritical(value),
            Parameter::Friction => contact.impulse_ratio = ImpulseRatio::LimitedByFriction(value),
            Parameter::Input(Input::Moment) => contact.moment = Moment::Given(value),
            Parameter::MomentOfCritical => contact.moment = Moment::OfCritical(value),
            _ => {
                let vehicle = parameter.side().and_then(|side| self.vehicles[side as usize].as_mut());
                vehicle.expect("a value can be set").set(parameter, value);
            }
        }
    }

    /// Returns this case with other values of some parameters, each of which [can be set](Inputs::can_set). Headings
    /// and masses are set first, because a speed is measured along the heading.
    pub fn set_all(&self, values: &[(Parameter, f64)]) -> Inputs {
        let first = |parameter: Parameter| matches!(parameter, Parameter::Input(Input::Heading(_) | Input::Mass(_)));
        let mut inputs = self.clone();
        for turn in [true, false] {
            values.iter().filter(|(parameter, _)| first(*parameter) == turn).for_each(|&(parameter, value)| inputs.set(parameter, value));
        }
        inputs
    }
}

/// Returns the parameter that the number of an impulse ratio sets.
pub(crate) fn ratio_parameter<T>(ratio: &ImpulseRatio<T>) -> Parameter {
    match ratio {
        ImpulseRatio::Critical | ImpulseRatio::Given(_) => Parameter::Input(Input::ImpulseRatio),
        ImpulseRatio::OfCritical(_) => Parameter::RatioOfCritical,
        ImpulseRatio::LimitedByFriction(_) => Parameter::Friction,
    }
}

/// Returns the parameter that the number of a moment impulse sets.
pub(crate) fn moment_parameter<T>(moment: &Moment<T>) -> Parameter {
    match moment {
        Moment::OfCritical(_) => Parameter::MomentOfCritical,
        Moment::None | Moment::Given(_) => Parameter::Input(Input::Moment),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::crush::{CrushInputs, Places, ProfileInputs};
    use crate::case::vehicle::Size;
    use planar_impact::crush::CrushStiffness;
    use planar_impact::{ForwardLeft, Xy};

    fn vehicle(inertia: Inertia, velocity: Velocity) -> VehicleInputs {
        let stiffness = CrushStiffness { onset: 3.0, slope: 4.0 };
        VehicleInputs {
            mass: 2.0,
            inertia,
            heading: 0.5,
            velocity,
            yaw_rate: 0.25,
            impact_center: ForwardLeft { forward: 1.0, left: -1.0 },
            crush: Some(CrushInputs {
                profile: ProfileInputs { places: Places::Width(1.0), depths: vec![0.5, 0.25], line: None },
                stiffness: vec![stiffness.into()],
                borders: Vec::new(),
                saturation: None,
                surface: None,
                pdof: None,
            }),
            size: Size::default(),
            braking: None,
        }
    }

    fn inputs() -> Inputs {
        let one = vehicle(Inertia::Radius(3.0), Velocity::Speed(7.0));
        let two = vehicle(Inertia::Yaw(5.0), Velocity::Components(Xy { x: -3.0, y: 1.0 }));
        let contact = ContactInputs {
            crush_plane: 0.1,
            restitution: Restitution::Given(0.2),
            impulse_ratio: ImpulseRatio::LimitedByFriction(0.3),
            law: Law::Brach,
            moment: Moment::OfCritical(0.5),
        };
        Inputs { vehicles: [Some(one), Some(two)], contact }
    }

    #[test]
    fn setting_a_value_is_adding_the_difference() {
        let inputs = inputs();
        for parameter in inputs.parameters() {
            let Ok(value) = inputs.value(parameter) else {
                assert_eq!(parameter, Parameter::Input(Input::ImpulseRatio), "the one that the file does not give");
                continue;
            };
            let set = inputs.set_all(&[(parameter, value + 0.125)]);
            assert!((set.value(parameter).expect("it has been set") - value - 0.125).abs() < 1e-14, "{parameter}");
            let added = inputs.setup(|other| if other == parameter { 0.125 } else { 0.0 });
            let (set, added) = (format!("{:?}", set.as_given().evaluate()), format!("{:?}", added.evaluate()));
            let numbers = |text: &str| -> Vec<f64> { text.split([' ', ',', '(', ')']).filter_map(|word| word.parse().ok()).collect() };
            for (a, b) in numbers(&set).into_iter().zip(numbers(&added)) {
                assert!((a - b).abs() < 1e-11 * a.abs().max(1.0), "{parameter}: {a} {b}");
            }
        }
    }

    #[test]
    fn what_others_are_measured_along_is_set_first() {
        let (heading, speed) = (Parameter::Input(Input::Heading(Side::One)), Parameter::Input(Input::VelocityX(Side::One)));
        for values in [[(heading, 1.0), (speed, 4.0)], [(speed, 4.0), (heading, 1.0)]] {
            let set = inputs().set_all(&values);
            assert_eq!((set.value(heading), set.value(speed)), (Ok(1.0), Ok(4.0)));
            let across = set.value(Parameter::Input(Input::VelocityY(Side::One))).expect("a velocity");
            assert!((across - 7.0 * 1_f64.sin()).abs() < 1e-15, "the speed has turned with the heading");
        }
    }

    #[test]
    fn keys_are_those_of_the_file() {
        let names = |parameters: Vec<Parameter>| parameters.iter().map(ToString::to_string).collect::<Vec<_>>();
        let (keys, all) = (names(inputs().keys()), names(inputs().parameters()));
        for name in ["vehicle.1.radius_of_gyration", "vehicle.1.speed", "vehicle.2.yaw_inertia", "vehicle.2.velocity.y", "contact.friction"]
        {
            assert!(keys.iter().any(|key| key == name), "{name}");
        }
        for name in ["vehicle.1.yaw_inertia", "vehicle.1.velocity.x", "vehicle.2.speed", "contact.impulse_ratio"] {
            assert!(all.iter().any(|key| key == name) && !keys.iter().any(|key| key == name), "{name}");
        }
    }

    #[test]
    fn what_a_case_does_not_have_it_says() {
        let mut inputs = inputs();
        let why = |inputs: &Inputs, name: &str| inputs.value(Parameter::named(name).expect("a name")).expect_err("not there");
        assert_eq!(why(&inputs, "contact.impulse_ratio"), "the case gives `contact.friction`");
        assert_eq!(why(&inputs, "contact.moment"), "the case gives `contact.moment.of_critical`");
        assert_eq!(why(&inputs, "vehicle.1.crush.depths.3"), "the crush has 2 depths");
        inputs.vehicles[0] = None;
        inputs.contact.moment = Moment::None;
        assert_eq!(why(&inputs, "m1"), "vehicle 1 is a fixed barrier");
        assert_eq!(why(&inputs, "M"), "the case has no moment impulse");
    }
}
