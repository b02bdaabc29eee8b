//! What the page gives: a case, the files that it names, and the units of the reader.

use std::collections::BTreeMap;

use planar_impact_app::{Case, Issue, Issues, Open, Source, Units, decode};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A case as the page has it.
#[derive(Deserialize)]
pub struct Input {
    /// The name of its file.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The files that it may name, by the names that it gives them.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// `us`, `si` or `uk`; those of the case if empty.
    #[serde(default)]
    pub units: String,
}

impl Input {
    /// Reads the text.
    ///
    /// # Errors
    ///
    /// A text that is too large or empty.
    pub fn source(&self) -> Result<Source, Issues> {
        decode::source(&self.name, self.text.clone().into_bytes())
    }

    /// Reads the case.
    ///
    /// # Errors
    ///
    /// Everything wrong with it and with the files that it names.
    pub fn case(&self) -> Result<Case, Issues> {
        let files = self.files.clone();
        // A page knows no folders: a file that a person has opened stands for any with its name.
        let last = |name: &str| name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
        let open: Open = Box::new(move |name| match files.get(name).or_else(|| files.get(&last(name))) {
            Some(text) => decode::source(name, text.clone().into_bytes()),
            None => Err(decode::unreadable(name, "is not open in this page; open it together with the case")),
        });
        Case::parse_with(self.source()?, open)
    }

    /// Returns the units of the reader, or else those of a case.
    pub fn units(&self, case: &Case) -> Units {
        self.units_or(case.units)
    }

    /// Returns the units of the reader, or else others.
    pub fn units_or(&self, others: Units) -> Units {
        match self.units.as_str() {
            "us" => Units::Us,
            "si" => Units::Si,
            "uk" => Units::Uk,
            _ => others,
        }
    }
}

/// Reads what the page has written as JSON.
///
/// # Errors
///
/// A defect of the page.
pub fn read<T: DeserializeOwned>(json: &str) -> Result<T, Issues> {
    serde_json::from_str(json).map_err(|error| Issues::of_call(vec![Issue::of_call("request", error.to_string(), None)]))
}
