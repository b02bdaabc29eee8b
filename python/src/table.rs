//! Tables through the Arrow C stream.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, SchemaRef};
use planar_impact_app::Issues;
use planar_impact_arrow::{Options, Plan};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use pyo3_arrow::PyTable;
use pyo3_arrow::input::AnyRecordBatch;

use crate::batch::base;
use crate::control::Signals;
use crate::error::{self, Failure};
use crate::source::Source;

/// Rows that one thread solves together.
const ROWS: usize = 1 << 16;

/// A table that any library of Arrow reads.
#[pyclass(frozen, module = "planar_impact")]
pub struct Table {
    table: Py<PyTable>,
    names: Vec<String>,
    rows: usize,
}

#[pymethods]
impl Table {
    /// Exports the table as an Arrow C stream.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(&self, py: Python<'py>, requested_schema: Option<Bound<'py, PyCapsule>>) -> PyResult<Bound<'py, PyAny>> {
        self.table.bind(py).call_method1("__arrow_c_stream__", (requested_schema,))
    }

    /// Exports the schema of the table.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.table.bind(py).call_method0("__arrow_c_schema__")
    }

    /// The names of the columns.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// The number of rows.
    #[getter]
    fn num_rows(&self) -> usize {
        self.rows
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    fn __repr__(&self) -> String {
        format!("<planar_impact.Table of {} rows and {} columns>", self.rows, self.names.len())
    }
}

/// Solves every row of a table.
#[pyfunction]
pub fn solve_table(
    py: Python<'_>,
    table: AnyRecordBatch,
    case: Option<&Source>,
    of: Vec<String>,
    wrt: Vec<String>,
    check: bool,
    threads: usize,
) -> PyResult<Table> {
    let reader = table.into_reader()?;
    let signals = Signals::new();
    let options = Options { of, wrt, check };
    let (batches, schema) = py.detach(|| -> PyResult<(Vec<RecordBatch>, SchemaRef)> {
        let has_lines = case.is_none_or(Source::has_lines);
        let plan = Plan::of(&reader.schema(), base(case)?.as_ref(), &options);
        let plan = plan.map_err(|issues| Failure { has_lines, ..issues.into() })?.with_numbers();
        let mut parts = Vec::new();
        for batch in reader {
            let batch = batch.map_err(|error| PyValueError::new_err(format!("the table cannot be read: {error}")))?;
            parts.extend((0..batch.num_rows()).step_by(ROWS).map(|first| batch.slice(first, ROWS.min(batch.num_rows() - first))));
        }
        Ok((solve(&plan, &parts, threads, &signals)?, plan.schema()))
    })?;
    let names = schema.fields().iter().map(|field| field.name().clone()).collect();
    let rows = batches.iter().map(RecordBatch::num_rows).sum();
    Ok(Table { table: Py::new(py, PyTable::try_new(batches, schema)?)?, names, rows })
}

/// Solves parts of a table on threads.
fn solve(plan: &Plan, parts: &[RecordBatch], threads: usize, signals: &Signals) -> PyResult<Vec<RecordBatch>> {
    let queue = Mutex::new(parts.iter().enumerate());
    let next = || queue.lock().ok()?.next();
    let is_stopped = AtomicBool::new(false);
    let work = |look: &dyn Fn() -> bool| {
        let mut solved: Vec<(usize, Result<RecordBatch, ArrowError>)> = Vec::new();
        while !is_stopped.load(Ordering::Relaxed) {
            let Some((place, part)) = next() else { break };
            solved.push((place, plan.solve(part)));
            if !look() {
                is_stopped.store(true, Ordering::Relaxed);
            }
        }
        solved
    };
    let mut solved = thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(parts.len())).map(|_| scope.spawn(|| work(&|| true))).collect();
        let mut solved = work(&|| signals.look());
        for other in others {
            solved.extend(other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        solved
    });
    if is_stopped.into_inner() {
        return Err(signals.stopped());
    }
    solved.sort_by_key(|(place, _)| *place);
    solved.into_iter().map(|(_, part)| part.map_err(|error| error::of(Issues::defect(error)))).collect()
}
