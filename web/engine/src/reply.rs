//! What the page gets.

use planar_impact_app::{Cause, Issue, Issues, Units};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The answer to a request. Every text is empty where there is none.
#[wasm_bindgen(getter_with_clone)]
#[derive(Default)]
pub struct Reply {
    /// The answer as the command line prints it.
    #[wasm_bindgen(readonly)]
    pub json: String,
    /// The answer as HTML.
    #[wasm_bindgen(readonly)]
    pub html: String,
    /// The drawing or chart as SVG.
    #[wasm_bindgen(readonly)]
    pub svg: String,
    /// The table as CSV.
    #[wasm_bindgen(readonly)]
    pub csv: String,
    /// Why there is no answer, as a JSON array of issues.
    #[wasm_bindgen(readonly)]
    pub issues: String,
    /// `input`, `physics` or `defect` with issues.
    #[wasm_bindgen(readonly)]
    pub cause: String,
}

/// An issue, with its place in the text that the page shows.
#[derive(Serialize)]
struct Shown<'a> {
    code: &'a str,
    path: &'a str,
    message: String,
    help: Option<String>,
    /// The name of the file that it is in.
    file: &'a str,
    line: Option<usize>,
    /// Offsets in UTF-16 units, as in JavaScript.
    from: Option<usize>,
    to: Option<usize>,
}

impl Reply {
    /// Returns issues in the units of the reader.
    pub fn refusal(issues: &Issues, units: Units) -> Reply {
        let show = |issue: &Issue| -> String {
            let source = issues.source_of(issue);
            let offset = |at: usize| utf16_length(&source.text, at);
            let shown = Shown {
                code: issue.code,
                path: &issue.path,
                message: units.sentence(&issue.message),
                help: issue.help.as_ref().map(|help| units.sentence(help)),
                file: &source.name,
                line: issues.line(issue),
                from: issue.span.as_ref().map(|span| offset(span.start)),
                to: issue.span.as_ref().map(|span| offset(span.end)),
            };
            serde_json::to_string(&shown).unwrap_or_default()
        };
        // A page shows no more; offsets of a large file take time.
        let list: Vec<String> = issues.list().iter().take(100).map(show).collect();
        let cause = match issues.cause() {
            Cause::Input => "input",
            Cause::Physics => "physics",
            Cause::Interrupted => "interrupted",
            Cause::Defect => "defect",
        };
        Reply { issues: format!("[{}]", list.join(",")), cause: cause.to_owned(), ..Reply::default() }
    }
}

/// Returns the UTF-16 units before a byte of a text.
pub fn utf16_length(text: &str, bytes: usize) -> usize {
    let end = (0..=bytes.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    text[..end].chars().map(char::len_utf16).sum()
}
