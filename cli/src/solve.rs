//! The verb `solve`.

use planar_impact::Refusal;

use crate::Done;
use crate::arguments::{Format, Solve};
use crate::case::Case;
use crate::exit::Failure;
use crate::report;
use crate::solution::Solution;

/// Reads the case, solves it and prints the impact.
///
/// # Errors
///
/// Everything wrong with the file, or every reason why the physics refuses it.
pub fn run(call: &Solve) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let impact = case.collision.solve().map_err(|refusals| {
        let problems = case.place(&refusals, units);
        if refusals.reasons().iter().all(Refusal::is_physical) { Failure::Physics(problems) } else { Failure::Input(problems) }
    })?;
    let mut notes = case.notes.clone();
    notes.extend(case.cautions(&impact));
    match call.format {
        Format::Text => Ok(Done::with(report::render(&case, &impact, units, &notes))),
        Format::Json => {
            let text =
                serde_json::to_string_pretty(&Solution::of(&case, &impact, notes)).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}
