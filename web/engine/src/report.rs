//! The report of a case: one file to hand in.

use planar_impact_app::report;
use planar_impact_app::{Issues, Units};
use planar_impact_report::{document, html};
use wasm_bindgen::prelude::*;

use crate::control::Reporter;
use crate::input::{self, Input};
use crate::reply::Reply;

/// Writes the report of a case, which is JSON.
#[wasm_bindgen]
pub fn report(case: &str) -> Reply {
    let written = input::read::<Input>(case).map_err(|issues| Reply::refusal(&issues, Units::Si)).and_then(|input| {
        let case = input.case().map_err(|issues| Reply::refusal(&issues, input.units_or(Units::Si)))?;
        let units = input.units(&case);
        let write = || -> Result<String, Issues> {
            let answer = report::report(&case, &report::Options::default(), &Reporter)?;
            Ok(html::render(&document::of_case(&answer, &document::Options { units, date: None, parts: Vec::new() })?))
        };
        write().map_err(|issues| Reply::refusal(&issues, units))
    });
    written.map_or_else(|refusal| refusal, |html| Reply { html, ..Reply::default() })
}
