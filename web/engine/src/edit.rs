//! Edits of the case text by a form and by a drawing.

use planar_impact_app::case::Parameter;
use planar_impact_app::document::{Document, Edit};
use planar_impact_app::{Issue, Issues, Source, Units};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::reply::{Reply, utf16_length};

/// A replacement in the text that the page shows, in UTF-16 units.
#[derive(Serialize)]
struct Change {
    from: usize,
    to: usize,
    insert: String,
}

/// A value of the text.
#[derive(Serialize)]
struct Value {
    from: usize,
    to: usize,
    text: String,
}

fn document(name: &str, text: &str) -> Result<Document, Issues> {
    Document::parse(Source::new(name, text))
}

/// Returns the values at the paths of a JSON array, as a JSON array with `null` where there is none; an empty text if the file cannot be read.
#[wasm_bindgen]
pub fn values(name: &str, text: &str, paths: &str) -> String {
    let (Ok(document), Ok(paths)) = (document(name, text), serde_json::from_str::<Vec<String>>(paths)) else { return String::new() };
    let value = |path: &String| {
        let written = document.written(path)?;
        Some(Value { from: utf16_length(text, written.span.start), to: utf16_length(text, written.span.end), text: written.text })
    };
    serde_json::to_string(&paths.iter().map(value).collect::<Vec<_>>()).unwrap_or_default()
}

fn changes(text: &str, edits: Result<Vec<Edit>, Issues>) -> Reply {
    let change =
        |edit: Edit| Change { from: utf16_length(text, edit.span.start), to: utf16_length(text, edit.span.end), insert: edit.text };
    match edits {
        Ok(edits) => {
            let changes: Vec<Change> = edits.into_iter().map(change).collect();
            Reply { json: serde_json::to_string(&changes).unwrap_or_default(), ..Reply::default() }
        }
        Err(issues) => Reply::refusal(&issues, Units::Si),
    }
}

/// Returns the changes that write what a person has typed at a path.
#[wasm_bindgen]
pub fn write_text(name: &str, text: &str, path: &str, typed: &str) -> Reply {
    changes(text, document(name, text).and_then(|document| Ok(vec![document.write_text(path, typed)?])))
}

/// Returns the changes that move an input to a value in SI, to a resolution in SI.
#[wasm_bindgen]
pub fn write_number(name: &str, text: &str, input: &str, si: f64, resolution: f64) -> Reply {
    let edits = document(name, text).and_then(|document| {
        let unknown = || Issues::of_call(vec![Issue::of_call("input", "no input has this name", None)]);
        document.write_number(Parameter::named(input).ok_or_else(unknown)?, si, resolution)
    });
    changes(text, edits)
}

/// Returns the value in SI of an input as it stands in the text; NaN if there is none.
#[wasm_bindgen]
pub fn number_at(name: &str, text: &str, input: &str) -> f64 {
    let (Ok(document), Some(parameter)) = (document(name, text), Parameter::named(input)) else { return f64::NAN };
    document.number_at(parameter).unwrap_or(f64::NAN)
}
