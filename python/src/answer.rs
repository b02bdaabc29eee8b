//! An answer: its JSON, its page and its figures.

use std::sync::Arc;

use planar_impact_app::json::{self, Layout};
use planar_impact_app::{Answer as AppAnswer, Issues, Units};
use planar_impact_report::page::{self, Facts};
use planar_impact_report::text;
use pyo3::prelude::*;
use serde::Serialize;

use crate::error::{self, Failure};
use crate::units;

/// Renders an answer in a system of units.
pub type Render = Box<dyn Fn(Units) -> Result<String, Issues> + Send + Sync>;

/// Draws an answer in a system of units; `None` if it has nothing to draw.
pub type Figure = Box<dyn Fn(Units) -> Result<Option<String>, Issues> + Send + Sync>;

/// Writes the JSON of an answer, when it is wanted.
type Write = Box<dyn Fn() -> Result<String, Issues> + Send + Sync>;

/// An answer of a verb.
#[pyclass(frozen, module = "planar_impact._native")]
pub struct Answer {
    json: Write,
    units: Units,
    page: Render,
    figures: Vec<(&'static str, Figure)>,
}

impl Answer {
    /// Creates an answer with its page.
    pub fn of<T: Facts + Serialize + Send + Sync + 'static>(answer: &Arc<AppAnswer<T>>, units: Units, layout: Layout) -> Answer {
        let (written, shown) = (answer.clone(), answer.clone());
        let json: Write = Box::new(move || json::text(written.as_ref(), layout));
        let page: Render = Box::new(move |units| Ok(text::render(&page::page(&shown, units))));
        Answer { json, units, page, figures: Vec::new() }
    }

    /// Creates an answer whose page is a text.
    ///
    /// # Errors
    ///
    /// A defect, because an answer is plain data.
    pub fn of_text(answer: &impl Serialize, page: String) -> Result<Answer, Issues> {
        let json = json::text(answer, Layout::Pretty)?;
        let json: Write = Box::new(move || Ok(json.clone()));
        Ok(Answer { json, units: Units::Si, page: Box::new(move |_| Ok(page.clone())), figures: Vec::new() })
    }

    /// Replaces the page.
    #[must_use]
    pub fn with_page(self, page: Render) -> Answer {
        Answer { page, ..self }
    }

    /// Adds a figure. The first is that of notebooks.
    #[must_use]
    pub fn with_figure(mut self, name: &'static str, figure: Figure) -> Answer {
        self.figures.push((name, figure));
        self
    }

    /// Adds a chart of an answer.
    #[must_use]
    pub fn with_chart<T, D>(
        self,
        name: &'static str,
        answer: &Arc<AppAnswer<T>>,
        draw: fn(&AppAnswer<T>, Units) -> Result<D, Issues>,
    ) -> Answer
    where
        T: Send + Sync + 'static,
        D: Into<Option<String>> + 'static,
    {
        let answer = answer.clone();
        self.with_figure(name, Box::new(move |units| draw(&answer, units).map(Into::into)))
    }

    fn render<T: Send>(
        &self,
        py: Python<'_>,
        render: &(dyn Fn(Units) -> Result<T, Issues> + Send + Sync),
        units: Option<&str>,
    ) -> PyResult<T> {
        let units = units::named(units).map_err(error::of)?.unwrap_or(self.units);
        Ok(py.detach(|| render(units)).map_err(|issues| Failure { issues, units, has_lines: true })?)
    }
}

#[pymethods]
impl Answer {
    /// Returns the JSON, as the command line prints it.
    #[getter]
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| (self.json)()).map_err(error::of)
    }

    /// Returns the page as text.
    #[pyo3(signature = (units=None))]
    fn page(&self, py: Python<'_>, units: Option<&str>) -> PyResult<String> {
        self.render(py, &self.page, units)
    }

    /// Returns the names of the figures.
    #[getter]
    fn figures(&self) -> Vec<&'static str> {
        self.figures.iter().map(|(name, _)| *name).collect()
    }

    /// Returns a figure as SVG, or the first; `None` if there is nothing to draw.
    #[pyo3(signature = (figure=None, units=None))]
    fn drawing(&self, py: Python<'_>, figure: Option<&str>, units: Option<&str>) -> PyResult<Option<String>> {
        let mut named = self.figures.iter().filter(|(name, _)| figure.is_none_or(|figure| figure == *name));
        match (named.next(), figure) {
            (Some((_, draw)), _) => self.render(py, draw, units),
            (None, None) => Ok(None),
            (None, Some(figure)) => {
                let accepted = self.figures.iter().map(|(name, _)| format!("{name:?}")).collect::<Vec<_>>().join(", ");
                Err(error::of(units::unknown(
                    "figure",
                    figure,
                    if accepted.is_empty() { "none: this answer has no figure" } else { &accepted },
                )))
            }
        }
    }
}
