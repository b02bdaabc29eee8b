//! The verb `crash3`: CRASH3's damage algorithm beside planar mechanics.

mod document;
mod text;

use planar_impact::crash3::{Assumptions, DamagedPair, PairEstimate};
use planar_impact::{Impact, Xy};

use crate::Done;
use crate::arguments::{Format, OfCase as Call};
use crate::case::Case;
use crate::exit::Failure;
use crate::units::Units;

/// Reads the case and prints what CRASH3 makes of its crush.
///
/// # Errors
///
/// Everything wrong with the file, a vehicle without crush, or why the physics refuses the impact that the direction of force is taken from.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let result = Result3::of(&case, units)?;
    match call.format {
        Format::Text => Ok(Done::with(text::render(&case, &result, units))),
        Format::Json => {
            let document = document::Document::of(&case, &result);
            let text = serde_json::to_string_pretty(&document).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}

/// What CRASH3 says, and what planar mechanics says beside it.
struct Result3 {
    pair: DamagedPair,
    estimate: PairEstimate,
    /// The separation velocity of each vehicle that CRASH3 goes back from: that of the evidence, or else of the case.
    separation: [Option<Xy>; 2],
    /// What both methods make of the same crush energy, where planar mechanics can be asked.
    assumptions: Option<Assumptions>,
    notes: Vec<String>,
}

impl Result3 {
    fn of(case: &Case, units: Units) -> Result<Self, Failure> {
        let parties = [&case.collision.one, &case.collision.two];
        let without = |i: &usize| parties[*i].vehicle().is_some() && case.setup.crush[*i].is_none();
        let lacking: Vec<_> = (0..2).filter(without).collect();
        if !lacking.is_empty() {
            let problem = |i: usize| {
                let help = "CRASH3 adds up the crush energy of every vehicle; one that was not crushed has depths of 0".to_owned();
                (format!("vehicle.{}.crush", i + 1), "missing".to_owned(), Some(help))
            };
            return Err(case.unfit(lacking.into_iter().map(problem)));
        }
        let mut notes = case.notes.clone();
        let given = case.setup.crush.iter().flatten().all(|crush| crush.force_origin.is_some());
        let common = case.collision.at_common_velocity().solve();
        if !given {
            common.map_err(|refusals| case.refuse(&refusals, units))?;
            notes.push("the PDOF is that of the common-velocity impulse, e = 0 and mu = mu0, which CRASH3 assumes".to_owned());
        }
        let pair = case.setup.damaged_pair().ok_or(Failure::Defect)?;
        let estimate = pair.solve().map_err(|refusals| case.refuse(&refusals, units))?;
        for (i, vehicle) in [&estimate.one, &estimate.two].into_iter().enumerate() {
            if vehicle.is_some_and(|vehicle| vehicle.correction >= 2.0) {
                notes.push(format!("vehicle.{}: the energy correction is at its limit of 2; the force comes 45 deg or more off", i + 1));
            }
        }
        let impact = case.collision.solve();
        if let Err(refusals) = &impact {
            let reasons: Vec<String> = refusals.reasons().iter().map(|refusal| crate::wording::refusal(refusal, units).1).collect();
            notes.push(format!("nothing to compare with: planar mechanics refuses the case, {}", reasons.join("; ")));
        }
        let impact: Option<Impact> = impact.ok();
        let responses = [impact.as_ref().map(|impact| &impact.one), impact.as_ref().map(|impact| &impact.two)];
        let separation = [0, 1].map(|i| case.separation[i].or_else(|| responses[i].map(|response| response.after.velocity)));
        if case.separation.iter().all(Option::is_none) && impact.is_some() {
            notes.push("the separation velocities are those that planar mechanics has for the case: the evidence has none".to_owned());
        }
        let energy = [&pair.one, &pair.two].into_iter().flatten().map(|damaged| damaged.crush_energy).sum();
        let can_be_asked = impact.is_some() && case.collision.restitution < 1.0;
        let assumptions = can_be_asked.then(|| Assumptions::from_crush_energy(&case.collision, energy)).flatten();
        Ok(Result3 { pair, estimate, separation, assumptions, notes })
    }
}
