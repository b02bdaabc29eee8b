//! Edits of the text of a case, as a form and a drawing in the browser make them: what is written is what is read.

use planar_impact_app::case::Parameter;
use planar_impact_app::document::{Document, Edit};
use planar_impact_app::{Case, Issues};

use crate::bytes::Bytes;
use crate::cases;

/// Puts edits into a text.
fn applied(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.span.start));
    let mut text = text.to_owned();
    for edit in edits {
        assert!(text.get(edit.span.clone()).is_some(), "{edit:?} is no place of the text");
        text.replace_range(edit.span, &edit.text);
    }
    text
}

/// The target.
pub fn run(data: &[u8]) {
    let mut from = Bytes::new(data);
    let (with_headers, is_json) = (from.chance(128), from.chance(60));
    let typed = from.word();
    let path = from.key();
    let (target, exponent) = (from.between(-100.0, 100.0), from.below(6));
    let tree = cases::case(&mut from);
    let (name, text) = if is_json { ("case.json", tree.json()) } else { ("case.toml", tree.toml(with_headers)) };
    let Ok(document) = Document::parse(cases::source(name, text.clone())) else { return };
    for path in [path.as_str(), "vehicle.1.mass", "vehicle.2.speed", "contact.restitution", "title", &format!("vehicle.1.{path}")] {
        if let Some(written) = document.written(path) {
            assert!(text.get(written.span).is_some(), "{path}");
        }
        // What a person has typed stands there afterwards, if the file can be read again.
        match document.write_text(path, &typed) {
            Ok(edit) => {
                let edited = applied(&text, vec![edit]);
                if let Ok(again) = Document::parse(cases::source(name, edited.clone())) {
                    let typed = typed.trim();
                    let written = again.written(path).map(|written| written.text);
                    assert!(written.as_deref() == Some(typed), "{path}: {typed:?} became {written:?}\n{edited}");
                } else {
                    assert!(typed.trim().starts_with('{'), "{path}: {typed:?} breaks the file\n{text}\n{edited}");
                }
            }
            Err(issues) => cases::sound_refusal(&issues),
        }
    }
    let Ok(case) = Case::parse(cases::source(name, text.clone())) else { return };
    let resolution = 10_f64.powi(-(exponent as i32));
    for parameter in case.inputs.keys().into_iter().filter(|key| !matches!(key, Parameter::Crush(..) | Parameter::Skid(..))) {
        moved(&document, &text, name, parameter, target, resolution);
    }
}

/// Moves an input, and reads it at its new place to the resolution.
fn moved(document: &Document, text: &str, name: &str, parameter: Parameter, to: f64, resolution: f64) {
    let edits: Result<Vec<Edit>, Issues> = document.write_number(parameter, to, resolution);
    match edits {
        Err(issues) => cases::sound_refusal(&issues),
        Ok(edits) => {
            let edited = applied(text, edits);
            let again = Document::parse(cases::source(name, edited.clone())).unwrap_or_else(|issues| panic!("{issues}\n{text}\n{edited}"));
            let read = again.number_at(parameter).unwrap_or_else(|| panic!("{parameter} is gone:\n{edited}"));
            // The file has at most twelve decimals in its own unit, and the ends of a range are rounded as they were.
            let from = document.number_at(parameter).map_or(0.0, f64::abs);
            let allowed = resolution * 1.01 + (1e-9 * to.abs()).max(1e-9) + 1e-14 * from;
            assert!((read - to).abs() <= allowed, "{parameter} moved to {to} is {read} ({resolution}):\n{text}\n{edited}");
        }
    }
}
