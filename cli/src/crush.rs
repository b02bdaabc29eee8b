//! The verb `crush`: what residual crush stands for.

mod document;
mod text;

use planar_impact::Input;
use planar_impact::reconstruct::Variable;

use crate::Done;
use crate::arguments::{Format, OfCase as Call};
use crate::case::Case;
use crate::exit::Failure;

/// Reads the case and prints what the crush of each vehicle stands for. Whether the vehicles collide does not matter.
///
/// # Errors
///
/// Everything wrong with the file, or that it has no crush.
pub fn run(call: &Call) -> Result<Done, Failure> {
    // The equivalent speed is that of a mass; how the vehicles moved does not matter.
    let needs = |of| matches!(of, Variable::Input(Input::Mass(_)));
    let case = Case::read_for(&call.case, needs).map_err(Failure::Input)?;
    if case.setup.crush.iter().all(Option::is_none) {
        let help = "a [vehicle.crush] with width, depths and stiffness under a [[vehicle]]".to_owned();
        return Err(case.unfit([("vehicle".to_owned(), "no vehicle has a crush".to_owned(), Some(help))]));
    }
    match call.format {
        Format::Text => Ok(Done::with(text::render(&case, call.units.unwrap_or(case.units)))),
        Format::Json => {
            let text = serde_json::to_string_pretty(&document::Document::of(&case)).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}
