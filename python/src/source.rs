//! Case files as Python gives them: a path, a text or a dictionary.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use planar_impact_app::check::reason;
use planar_impact_app::{Case, Issues, Open, decode};
use pyo3::prelude::*;

use crate::plain;

/// A case file that has not been read yet.
#[pyclass(frozen, module = "planar_impact._native")]
pub struct Source(Kind);

enum Kind {
    Path(PathBuf),
    Text(String),
    Dict(String),
}

#[pymethods]
impl Source {
    /// A file. It may name files beside it.
    #[staticmethod]
    fn path(path: PathBuf) -> Source {
        Source(Kind::Path(path))
    }

    /// A text in TOML or JSON. It names no file.
    #[staticmethod]
    fn text(text: String) -> Source {
        Source(Kind::Text(text))
    }

    /// A dictionary, whose lines mean nothing.
    #[staticmethod]
    fn dict(case: &Bound<'_, PyAny>) -> PyResult<Source> {
        Ok(Source(Kind::Dict(plain::json(case)?)))
    }
}

impl Source {
    /// Returns whether lines of the text mean something to the caller.
    pub fn has_lines(&self) -> bool {
        !matches!(self.0, Kind::Dict(_))
    }

    /// Reads the text, and returns it with the opener of the files that it names.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is too large, is not UTF-8 or is empty.
    pub fn read(&self) -> Result<(planar_impact_app::Source, Open), Issues> {
        let nowhere = || -> Open {
            let help = "names a file, and only a case that is a file can; give its path";
            Box::new(move |name| Err(decode::unreadable(name, help)))
        };
        match &self.0 {
            Kind::Path(path) => Ok((file(path)?, beside(path))),
            Kind::Text(text) => Ok((decode::source("<text>", text.clone().into_bytes())?, nowhere())),
            Kind::Dict(json) => Ok((decode::source("<dict>", json.clone().into_bytes())?, nowhere())),
        }
    }

    /// Reads a case.
    ///
    /// # Errors
    ///
    /// Everything wrong with it.
    pub fn case(&self) -> Result<Case, Issues> {
        let (source, open) = self.read()?;
        if matches!(self.0, Kind::Path(_)) { Case::parse_with(source, open) } else { Case::parse(source) }
    }
}

/// Reads the text of a file, up to the maximum size.
fn file(path: &Path) -> Result<planar_impact_app::Source, Issues> {
    let name = path.display().to_string();
    let unreadable = |error: &io::Error| decode::unreadable(&name, &format!("cannot be read: {}", reason(error)));
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    if file.metadata().map_err(|error| unreadable(&error))?.is_dir() {
        return Err(decode::unreadable(&name, "is a directory, not a case file"));
    }
    let mut bytes = Vec::new();
    // One byte more, so that a file that is too large is known without its end.
    file.take(planar_impact_app::Source::LARGEST + 1).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    decode::source(&name, bytes)
}

/// Returns a function that opens a file which the file at `path` names, relative to its folder.
fn beside(path: &Path) -> Open {
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    Box::new(move |name| file(&folder.join(name)))
}
