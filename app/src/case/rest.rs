//! Rest positions of a case file, and the separation velocities computed from them.

use planar_impact::post_impact::{Method, NoSeparation, Pose, RestEvidence, Separation, Slide, WheelPosition};
use planar_impact::{Heading, Xy};

use super::Case;
use super::parameter::Parameter;
use super::uncertain::UncertainInput;
use super::vehicle::VehicleInputs;
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::wording;

/// The names of the wheels, in the order of `WheelPosition::ALL`.
pub const WHEELS: [&str; 4] = ["front_left", "front_right", "rear_left", "rear_right"];

/// Returns the name of a wheel in files and answers.
pub(crate) fn wheel_name(wheel: WheelPosition) -> &'static str {
    WHEELS[wheel as usize]
}

/// Rest positions of a case file.
#[derive(Clone, Debug, PartialEq)]
pub struct RestInputs {
    /// Vehicle 1 and vehicle 2; `None` if absent from the file.
    pub vehicles: [Option<RestOfVehicle>; 2],
}

/// The rest position of one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct RestOfVehicle {
    /// The vehicle and the ground it slides on.
    pub slide: Slide,
    /// The pose at separation.
    pub separation: Pose,
    /// What the file says of that pose.
    pub(super) given: GivenPose,
    /// Separation pose and rest pose; `None` if the file does not say where it came to rest.
    pub evidence: Option<RestEvidence>,
    /// Method that computes its separation.
    pub method: Method,
    /// What the slide has of a vehicle that is a point mass in the collision.
    pub(super) whole: Option<WholeVehicle>,
}

/// A vehicle as the file gives it, where the collision takes it as a point mass: its slide has its yaw inertia and its impact center.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeVehicle {
    /// Its numbers, of which inertia and impact center count.
    pub(super) inputs: VehicleInputs,
    /// Those of them that are uncertain.
    pub uncertain: Vec<UncertainInput>,
}

/// What a file says of the pose at separation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GivenPose {
    pub(super) position: Option<Xy>,
    pub(super) heading: Option<f64>,
    /// Where on the scene the vehicles met.
    pub(super) impact_point: Option<Xy>,
}

impl GivenPose {
    /// Returns the pose: what is not given is as at the impact, whose place follows from the impact point on the scene and the impact center; without an impact
    /// point it is the origin.
    pub(super) fn of(&self, inputs: Option<&VehicleInputs>) -> Pose {
        let at_impact = |(point, inputs): (Xy, &VehicleInputs)| point - Heading::from_angle(inputs.heading).to_ground(inputs.impact_center);
        Pose {
            position: self.position.or(self.impact_point.zip(inputs).map(at_impact)).unwrap_or(Xy::zero()),
            heading: self.heading.or(inputs.map(|inputs| inputs.heading)).unwrap_or(0.0),
        }
    }
}

impl RestInputs {
    /// The same rest positions of vehicles with other numbers.
    pub(crate) fn of(&self, inputs: &[Option<VehicleInputs>; 2]) -> RestInputs {
        let [one, two] =
            [0, 1].map(|i| self.vehicles[i].as_ref().map(|rest| inputs[i].as_ref().map_or(rest.clone(), |inputs| rest.of(inputs))));
        RestInputs { vehicles: [one, two] }
    }
}

impl RestOfVehicle {
    fn of(&self, inputs: &VehicleInputs) -> RestOfVehicle {
        let mut rest = self.clone();
        let whole = self.whole.as_ref().map(|WholeVehicle { inputs: own, .. }| VehicleInputs {
            inertia: own.inertia,
            impact_center: own.impact_center,
            ..inputs.clone()
        });
        let inputs = whole.as_ref().unwrap_or(inputs);
        (rest.slide.vehicle.mass, rest.slide.vehicle.yaw_inertia) = (inputs.mass, inputs.yaw_inertia());
        rest.separation = self.given.of(Some(inputs));
        if let Some(evidence) = &mut rest.evidence {
            evidence.separation = rest.separation;
        }
        rest
    }

    /// Returns the uncertain numbers that its slide alone has.
    pub fn uncertain(&self) -> &[UncertainInput] {
        self.whole.as_ref().map_or(&[], |whole| &whole.uncertain)
    }

    /// The same with another value of a number that its slide alone has, and numbers of the vehicle.
    pub fn with_own(&self, parameter: Parameter, value: f64, inputs: &VehicleInputs) -> RestOfVehicle {
        let mut rest = self.clone();
        if let Some(whole) = &mut rest.whole {
            whole.inputs.set(parameter, value);
        }
        rest.of(inputs)
    }

    /// Computes its separation from its rest position, or returns the reason why that cannot be determined; `None` without a rest position.
    pub fn separation(&self, goes_on: &dyn Fn(usize, usize) -> bool) -> Option<Result<Separation, NoSeparation>> {
        Some(self.slide.separation_while(self.evidence.as_ref()?, self.method, goes_on))
    }
}

impl Case {
    /// Computes the separation of each vehicle that has a rest position in the file.
    ///
    /// # Errors
    ///
    /// Returns an issue, at its place in the file, for each vehicle whose separation cannot be determined.
    pub fn separations_from_rest(&self, control: &dyn Control) -> Result<[Option<Separation>; 2], Issues> {
        self.separations_from_rest_of([true, true], control)
    }

    /// The same for some of the vehicles only; `None` for the others.
    ///
    /// # Errors
    ///
    /// As [`Case::separations_from_rest`].
    pub fn separations_from_rest_of(&self, is_needed: [bool; 2], control: &dyn Control) -> Result<[Option<Separation>; 2], Issues> {
        let Some(rest) = &self.rest else { return Ok([None, None]) };
        let (mut issues, mut is_stopped) = (Vec::new(), false);
        let separations = [0, 1].map(|i| {
            let path = format!("rest.vehicle.{}", i + 1);
            let Some(separation) =
                rest.vehicles[i].as_ref().filter(|_| is_needed[i])?.separation(&|done, total| control.goes_on(done + i * total, 2 * total))
            else {
                let help = "give `position` and `heading` at rest; `slide` alone does without them";
                issues.push(Issue::at("missing-key", path, "missing: where it came to rest").with_help(help));
                return None;
            };
            let issue = |why: NoSeparation| {
                is_stopped |= why == NoSeparation::Stopped;
                let issue = Issue::at("no-separation", path.clone(), why.to_string());
                issues.push(help(&why).map_or(issue.clone(), |help| issue.with_help(help)));
            };
            separation.map_err(issue).ok()
        });
        if is_stopped {
            return Err(Issues::interrupted());
        }
        if issues.is_empty() { Ok(separations) } else { Err(self.unfit(issues)) }
    }
}

fn help(why: &NoSeparation) -> Option<&'static str> {
    Some(match why {
        NoSeparation::NoRest(why) => wording::remedy_of_no_rest(why),
        NoSeparation::NotConverged { .. } => wording::NO_SLIDE_FOUND,
        NoSeparation::NotDetermined { .. } => "give the separation velocity as evidence, or more of what held the wheels",
        NoSeparation::NoPath => "leave `points` or `method` out",
        NoSeparation::NotHeld => "check `grade`, which is positive uphill, the friction, and which wheels are locked",
        NoSeparation::Driven | NoSeparation::Turned { .. } => "method = \"slide\" follows what each wheel does",
        NoSeparation::TooShort { .. } => {
            "a vehicle that hardly moved says little of its speed: give its separation velocity as evidence, about 0 with a standard deviation"
        }
        _ => return None,
    })
}
