//! Dictionaries of Python as the JSON of a case file.

use std::fmt::Display;

use planar_impact_app::{Cause, Issue, Issues, Source};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyByteArray, PyBytes, PyDict, PyFloat, PyInt, PyList, PyMapping, PyMemoryView, PySequence, PyString, PyTuple};

/// The deepest structure of a case; a case file has about six levels.
const DEEPEST: usize = 64;

/// Issues that are reported at most.
const MOST: usize = 1000;

/// Writes a dictionary as JSON. Scalars and arrays of NumPy become numbers and lists.
///
/// # Errors
///
/// What JSON does not have: a `CaseError` with all of it. An exception of the dictionary's own code.
pub fn json(case: &Bound<'_, PyAny>) -> PyResult<String> {
    let mut writer = Writer { json: Vec::with_capacity(1024), path: Vec::new(), depth: 0, issues: Vec::new() };
    writer.value(case)?;
    let Writer { json, issues, .. } = writer;
    if issues.is_empty() {
        String::from_utf8(json).map_err(|error| crate::error::of(Issues::defect(error)))
    } else {
        Err(crate::error::without_lines(Issues::without_source(Cause::Input, issues)))
    }
}

/// A step from a value to one within it.
enum Step<'py> {
    Key(Bound<'py, PyString>),
    /// Counted from 1.
    Item(usize),
}

struct Writer<'py> {
    json: Vec<u8>,
    path: Vec<Step<'py>>,
    /// Levels of the structure, and of plain forms of its values.
    depth: usize,
    issues: Vec<Issue>,
}

impl<'py> Writer<'py> {
    fn wrong(&mut self, message: impl Display) {
        let step = |step: &Step<'_>| match step {
            Step::Key(key) => key.to_string_lossy().into_owned(),
            Step::Item(place) => place.to_string(),
        };
        let path: Vec<String> = self.path.iter().map(step).collect();
        if self.issues.len() < MOST {
            self.issues.push(Issue::at("wrong-type", path.join("."), message.to_string()));
        }
    }

    /// Returns `true` if it is too large for a case file, which its reader says.
    fn is_full(&self) -> bool {
        self.json.len() as u64 > Source::LARGEST
    }

    fn value(&mut self, value: &Bound<'py, PyAny>) -> PyResult<()> {
        if self.is_full() {
            // A dictionary within itself has no end.
        } else if self.depth > DEEPEST {
            self.wrong(format_args!("nested more than {DEEPEST} levels deep"));
        } else if let Ok(number) = value.cast::<PyFloat>() {
            self.number(number.value());
        } else if let Ok(text) = value.cast::<PyString>() {
            self.text(text);
        } else if let Ok(dict) = value.cast::<PyDict>() {
            self.entries(dict.iter().map(Ok))?;
        } else if let Ok(list) = value.cast::<PyList>() {
            self.items(list.iter().map(Ok))?;
        } else if let Ok(truth) = value.cast::<PyBool>() {
            self.json.extend_from_slice(if truth.is_true() { b"true" } else { b"false" });
        } else if let Ok(whole) = value.cast::<PyInt>() {
            match (whole.extract::<i64>(), whole.extract::<f64>()) {
                (Ok(whole), _) => self.json.extend_from_slice(whole.to_string().as_bytes()),
                // The digits of an int, whatever a class that extends it calls itself.
                (_, Ok(_)) => {
                    let digits = whole.py().get_type::<PyInt>().call_method1("__repr__", (whole,))?;
                    self.json.extend_from_slice(digits.cast::<PyString>()?.to_str()?.as_bytes());
                }
                _ => self.wrong("expected a finite number, found an int beyond the range of floats"),
            }
        } else if value.is_none() {
            self.json.extend_from_slice(b"null");
        } else if let Ok(tuple) = value.cast::<PyTuple>() {
            self.items(tuple.iter().map(Ok))?;
        } else if let Ok(mapping) = value.cast::<PyMapping>() {
            self.entries(mapping.items()?.iter().map(|entry| entry.extract()))?;
        } else if value.hasattr("tolist")? && !value.is_instance_of::<PyMemoryView>() {
            let kind = value.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.extract::<String>()).unwrap_or_default();
            let plain = value.call_method0("tolist")?;
            // The plain form of some times is an int of any unit, and a long double is its own.
            match kind.as_str() {
                "m" | "M" => self.unknown(value)?,
                _ if !plain.get_type().is(value.get_type()) => self.within(&plain)?,
                "f" => self.number(value.extract()?),
                _ => self.unknown(value)?,
            }
        } else if value.cast::<PySequence>().is_ok() && !is_binary(value) {
            self.items(value.try_iter()?)?;
        } else {
            self.unknown(value)?;
        }
        Ok(())
    }

    fn within(&mut self, value: &Bound<'py, PyAny>) -> PyResult<()> {
        self.depth += 1;
        self.value(value)?;
        self.depth -= 1;
        Ok(())
    }

    fn unknown(&mut self, value: &Bound<'py, PyAny>) -> PyResult<()> {
        let kind = value.get_type().name()?;
        self.wrong(format_args!("expected a number, a string, a bool, a list or a dict, found {kind}"));
        Ok(())
    }

    fn number(&mut self, number: f64) {
        if number.is_finite() {
            self.json.extend_from_slice(format!("{number:?}").as_bytes());
        } else {
            let found = if number.is_nan() {
                "nan"
            } else if number > 0.0 {
                "inf"
            } else {
                "-inf"
            };
            self.wrong(format_args!("expected a finite number, found {found}"));
        }
    }

    fn text(&mut self, text: &Bound<'py, PyString>) {
        match text.to_cow() {
            Ok(text) => serde_json::to_writer(&mut self.json, &*text).expect("a vector takes everything"),
            Err(_) => self.wrong("a lone surrogate is no character of a case file"),
        }
    }

    fn entries(&mut self, entries: impl Iterator<Item = PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)>>) -> PyResult<()> {
        self.json.push(b'{');
        let mut is_first = true;
        for entry in entries {
            if self.is_full() {
                break;
            }
            let (key, value) = entry?;
            let key = match key.cast_into::<PyString>() {
                Ok(key) => key,
                Err(error) => {
                    let found = shortened(&error.into_inner())?;
                    self.wrong(format_args!("a key is a string; found {found}"));
                    continue;
                }
            };
            if !is_first {
                self.json.push(b',');
            }
            is_first = false;
            self.text(&key);
            self.json.push(b':');
            self.path.push(Step::Key(key));
            self.within(&value)?;
            self.path.pop();
        }
        self.json.push(b'}');
        Ok(())
    }

    fn items(&mut self, items: impl Iterator<Item = PyResult<Bound<'py, PyAny>>>) -> PyResult<()> {
        self.json.push(b'[');
        for (place, item) in items.enumerate() {
            if self.is_full() {
                break;
            }
            if place > 0 {
                self.json.push(b',');
            }
            self.path.push(Step::Item(place + 1));
            self.within(&item?)?;
            self.path.pop();
        }
        self.json.push(b']');
        Ok(())
    }
}

fn is_binary(value: &Bound<'_, PyAny>) -> bool {
    value.is_instance_of::<PyBytes>() || value.is_instance_of::<PyByteArray>() || value.is_instance_of::<PyMemoryView>()
}

/// Returns how a value is written in Python, at most 60 characters of it.
fn shortened(value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(value.repr()?.to_string_lossy().chars().take(60).collect())
}
