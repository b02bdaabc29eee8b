//! An answer: its JSON, its page and its drawing.

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

/// An answer of a verb.
#[pyclass(frozen, module = "planar_impact._native")]
pub struct Answer {
    json: String,
    units: Units,
    page: Render,
    drawing: Option<Render>,
}

impl Answer {
    /// Creates an answer with its page.
    ///
    /// # Errors
    ///
    /// A defect, because an answer is plain data.
    pub fn of<T: Facts + Serialize + Send + Sync + 'static>(
        answer: &Arc<AppAnswer<T>>,
        units: Units,
        layout: Layout,
    ) -> Result<Answer, Issues> {
        let json = json::text(answer.as_ref(), layout)?;
        let answer = answer.clone();
        Ok(Answer { json, units, page: Box::new(move |units| Ok(text::render(&page::page(&answer, units)))), drawing: None })
    }

    /// Creates an answer whose page is a text.
    ///
    /// # Errors
    ///
    /// A defect, because an answer is plain data.
    pub fn of_text(answer: &impl Serialize, page: String) -> Result<Answer, Issues> {
        let json = json::text(answer, Layout::Pretty)?;
        Ok(Answer { json, units: Units::Si, page: Box::new(move |_| Ok(page.clone())), drawing: None })
    }

    /// Replaces the page.
    #[must_use]
    pub fn with_page(self, page: Render) -> Answer {
        Answer { page, ..self }
    }

    /// Adds a drawing.
    #[must_use]
    pub fn with_drawing(self, drawing: Option<Render>) -> Answer {
        Answer { drawing, ..self }
    }

    fn render(&self, py: Python<'_>, render: &Render, units: Option<&str>) -> PyResult<String> {
        let units = units::named(units).map_err(error::of)?.unwrap_or(self.units);
        Ok(py.detach(|| render(units)).map_err(|issues| Failure { issues, units, has_lines: true })?)
    }
}

#[pymethods]
impl Answer {
    /// Returns the JSON, as the command line prints it.
    #[getter]
    fn json(&self) -> &str {
        &self.json
    }

    /// Returns the page as text.
    #[pyo3(signature = (units=None))]
    fn page(&self, py: Python<'_>, units: Option<&str>) -> PyResult<String> {
        self.render(py, &self.page, units)
    }

    /// Returns the drawing as SVG; `None` if there is none.
    #[pyo3(signature = (units=None))]
    fn drawing(&self, py: Python<'_>, units: Option<&str>) -> PyResult<Option<String>> {
        self.drawing.as_ref().map(|drawing| self.render(py, drawing, units)).transpose()
    }
}
