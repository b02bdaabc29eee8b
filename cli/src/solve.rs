//! The verb `solve`.

use crate::Done;
use crate::arguments::{Format, OfCase as Call};
use crate::bracket::Bracket;
use crate::case::Case;
use crate::exit::Failure;
use crate::report;
use crate::solution::Solution;

/// Reads the case, solves it and prints the impact.
///
/// # Errors
///
/// Everything wrong with the file, or every reason why the physics refuses it.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let impact = case.collision.solve().map_err(|refusals| case.refuse(&refusals, units))?;
    let bracket = case.bracket.as_ref().map(|bracket| Bracket::of(&case, bracket, case.setup.answers_of(&impact)));
    let mut notes = case.notes.clone();
    notes.extend(case.cautions(&impact));
    match call.format {
        Format::Text => Ok(Done::with(report::render(&case, &impact, bracket.as_ref(), units, &notes))),
        Format::Json => {
            let solution = Solution::of(&case, &impact, bracket.as_ref().map(Bracket::document), notes);
            let text = serde_json::to_string_pretty(&solution).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}
