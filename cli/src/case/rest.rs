//! How vehicles came to rest, as a case file gives it, and what that says of their separation.

use planar_impact::rest::{Method, NoSeparation, RestEvidence, Separation, Slide};

use super::Case;
use crate::exit::Failure;

/// What a case file gives of the rest of its vehicles.
#[derive(Clone, Debug, PartialEq)]
pub struct RestInputs {
    /// Vehicle 1 and vehicle 2, where the file has it.
    pub vehicles: [Option<RestOfVehicle>; 2],
}

/// What a case file gives of the rest of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct RestOfVehicle {
    /// The vehicle and the ground it slides on.
    pub slide: Slide,
    /// Where it separated and where it came to rest.
    pub evidence: RestEvidence,
    /// How its separation is found.
    pub method: Method,
}

impl RestOfVehicle {
    /// How it separated.
    ///
    /// # Errors
    ///
    /// Why that cannot be told.
    pub fn separation(&self) -> Result<Separation, NoSeparation> {
        self.slide.separation(&self.evidence, self.method)
    }
}

impl Case {
    /// How each vehicle separated whose rest the file has.
    ///
    /// # Errors
    ///
    /// Why that cannot be told, of each vehicle at its place in the file.
    pub fn separations_from_rest(&self) -> Result<[Option<Separation>; 2], Failure> {
        let Some(rest) = &self.rest else { return Ok([None, None]) };
        let mut problems = Vec::new();
        let separations = [0, 1].map(|i| {
            let separation = rest.vehicles[i].as_ref()?.separation();
            separation.map_err(|why| problems.push((format!("rest.vehicle.{}", i + 1), why.to_string(), help(&why)))).ok()
        });
        if problems.is_empty() { Ok(separations) } else { Err(self.unfit(problems)) }
    }
}

fn help(why: &NoSeparation) -> Option<String> {
    let help = match why {
        NoSeparation::NoRest(_) => "give it brakes or a rolling resistance",
        NoSeparation::NotConverged { .. } => "check the heading at rest, whole turns counted, and which wheels are locked",
        NoSeparation::NotDetermined { .. } => "give the separation velocity as evidence, or more of what held the wheels",
        NoSeparation::Driven | NoSeparation::Turned { .. } => "method = \"slide\" follows what each wheel does",
        NoSeparation::TooShort { .. } => "a vehicle that hardly moved says little of its speed",
        _ => return None,
    };
    Some(help.to_owned())
}
