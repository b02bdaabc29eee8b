//! Progress of a long verb. The page stops one by ending the worker that it runs in.

use planar_impact_app::Control;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// A global function of the page.
    #[wasm_bindgen(js_name = planarImpactProgress)]
    fn progress(done: f64, total: f64);
}

/// Calls the function `planarImpactProgress` of the page.
pub struct Reporter;

impl Control for Reporter {
    fn goes_on(&self, done: usize, total: usize) -> bool {
        progress(done as f64, total as f64);
        true
    }
}
