//! Writes the JavaScript that calls the engine, and the engine without what only this program reads.
//!
//!     planar-impact-bindgen ENGINE.wasm FOLDER NAME

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(engine), Some(folder), Some(name)) = (arguments.next(), arguments.next(), arguments.next()) else {
        return Err("usage: planar-impact-bindgen ENGINE.wasm FOLDER NAME".into());
    };
    let mut bindings = wasm_bindgen_cli_support::Bindgen::new();
    bindings.input_path(engine).web(true)?.typescript(true).out_name(&name).generate(folder)?;
    Ok(())
}
