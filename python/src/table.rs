//! Tables and streams of record batches through the Arrow C stream.

use std::collections::VecDeque;
use std::fmt::Display;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, ThreadId};

use arrow_array::{RecordBatch, RecordBatchReader};
use arrow_schema::{ArrowError, SchemaRef};
use planar_impact_app::batch::RowWarning;
use planar_impact_app::{Issue, Issues};
use planar_impact_arrow::{Options, Plan, Solved};
use pyo3::exceptions::{PyNotImplementedError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use pyo3_arrow::input::AnyRecordBatch;
use pyo3_arrow::{PyRecordBatchReader, PyTable};

use crate::batch::{base, warn, warn_of_rows};
use crate::control::{Signals, interrupt_again};
use crate::error::{self, Failure};
use crate::source::Source;

/// Rows that one thread solves together.
const ROWS: usize = 1 << 14;

/// Parts that a stream solves for each thread before it hands them on.
const PARTS: usize = 4;

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
#[expect(clippy::too_many_arguments, reason = "the options of the verb, which Python names")]
pub fn solve_table(
    py: Python<'_>,
    table: &Bound<'_, PyAny>,
    case: Option<&Source>,
    of: Vec<String>,
    wrt: Vec<String>,
    check: bool,
    fast: bool,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Table> {
    let reader = reader(table)?;
    let signals = Signals::new(progress);
    let options = Options { of, wrt, check, fast };
    let plan = plan(py, &reader.schema(), case, &options)?;
    let (batches, warnings) = py.detach(|| -> PyResult<(Vec<RecordBatch>, Vec<RowWarning>)> {
        let mut parts = Vec::new();
        for batch in reader {
            parts.extend(split(batch.map_err(unread)?));
        }
        let solved = solve(&plan, &parts, threads, &|done| signals.look(done + 1, parts.len())).ok_or_else(|| signals.stopped())?;
        let (mut batches, mut warnings, mut first) = (Vec::new(), Vec::new(), 0);
        for part in solved {
            let Solved { batch, warnings: of_part, .. } = part.map_err(unread)?;
            warnings.extend(of_part.into_iter().map(|warning| warning.after(first)));
            first += batch.num_rows();
            batches.push(batch);
        }
        Ok((batches, warnings))
    })?;
    signals.done()?;
    warn_of_rows(py, warnings, 2)?;
    let schema = plan.schema();
    let names = schema.fields().iter().map(|field| field.name().clone()).collect();
    let rows = batches.iter().map(RecordBatch::num_rows).sum();
    Ok(Table { table: Py::new(py, PyTable::try_new(batches, schema)?)?, names, rows })
}

/// Solves a stream of record batches while its answer is read, in memory that does not grow with the number of batches.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the options of the verb, which Python names")]
pub fn solve_stream(
    py: Python<'_>,
    table: &Bound<'_, PyAny>,
    case: Option<&Source>,
    of: Vec<String>,
    wrt: Vec<String>,
    check: bool,
    fast: bool,
    threads: usize,
) -> PyResult<PyRecordBatchReader> {
    let reader = reader(table)?;
    let options = Options { of, wrt, check, fast };
    let schema = reader.schema();
    let plan = plan(py, &schema, case, &options)?;
    let (signals, owner) = (Signals::new(None), thread::current().id());
    Ok(PyRecordBatchReader::new(Box::new(Stream {
        plan,
        reader,
        threads,
        signals,
        owner,
        parts: VecDeque::new(),
        solved: VecDeque::new(),
    })))
}

fn plan(py: Python<'_>, schema: &SchemaRef, case: Option<&Source>, options: &Options) -> PyResult<Plan> {
    let plan = py.detach(|| -> Result<Plan, Failure> {
        let has_lines = case.is_none_or(Source::has_lines);
        Plan::of(schema, base(case)?.as_ref(), options).map_err(|issues| Failure { has_lines, ..issues.into() })
    })?;
    warn(py, &plan.notices(None), 2)?;
    Ok(plan)
}

/// Returns the record batches of a table. What it raises itself stays, unless it is of its values.
fn reader(table: &Bound<'_, PyAny>) -> PyResult<Box<dyn RecordBatchReader + Send>> {
    let read = table.extract::<AnyRecordBatch>().and_then(AnyRecordBatch::into_reader);
    let py = table.py();
    read.map_err(|error| {
        let is_of_table = error.is_instance_of::<PyValueError>(py)
            || error.is_instance_of::<PyTypeError>(py)
            || error.is_instance_of::<PyNotImplementedError>(py);
        if is_of_table { unread(error.value(py)) } else { error }
    })
}

fn unread(error: impl Display) -> PyErr {
    error::of(Issues::of_call(vec![Issue::of_call("columns", format!("the table cannot be read: {error}"), None)]))
}

/// Returns the error of a source of record batches. One that Ctrl+C has ended within Python hands on the traceback, whose last line says so.
fn of_source(error: ArrowError) -> ArrowError {
    if error.to_string().trim_end().ends_with("KeyboardInterrupt") {
        Python::attach(interrupt_again);
    }
    error
}

/// Cuts a record batch into parts for one thread each.
fn split(batch: RecordBatch) -> impl Iterator<Item = RecordBatch> {
    let rows = batch.num_rows();
    (0..rows).step_by(ROWS).map(move |first| batch.slice(first, ROWS.min(rows - first)))
}

/// The answer to a stream: reads, solves and hands on some parts at a time.
struct Stream {
    plan: Plan,
    reader: Box<dyn RecordBatchReader + Send>,
    threads: usize,
    signals: Signals,
    /// The thread that asked for the answer. Another one that reads it may be waited for by one that holds the interpreter, and must not ask for it.
    owner: ThreadId,
    parts: VecDeque<RecordBatch>,
    solved: VecDeque<Result<RecordBatch, ArrowError>>,
}

impl Iterator for Stream {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.solved.is_empty() {
            let most = PARTS * self.threads;
            let mut failed = None;
            while self.parts.len() < most && failed.is_none() {
                match self.reader.next() {
                    Some(Ok(batch)) => self.parts.extend(split(batch)),
                    Some(Err(error)) => failed = Some(of_source(error)),
                    None => break,
                }
            }
            let parts: Vec<RecordBatch> = self.parts.drain(..most.min(self.parts.len())).collect();
            let is_owner = thread::current().id() == self.owner;
            match solve(&self.plan, &parts, self.threads, &|done| !is_owner || self.signals.look(done, parts.len())) {
                Some(solved) => self.solved.extend(solved.into_iter().map(|part| part.map(|part| part.batch))),
                None => failed = Some(ArrowError::ExternalError(self.signals.handed_on().into())),
            }
            self.solved.extend(failed.map(Err));
        }
        self.solved.pop_front()
    }
}

impl RecordBatchReader for Stream {
    fn schema(&self) -> SchemaRef {
        self.plan.schema()
    }
}

/// Solves parts of a table on threads; `None` if `goes_on`, which gets the number of parts begun, stops it.
fn solve(plan: &Plan, parts: &[RecordBatch], threads: usize, goes_on: &dyn Fn(usize) -> bool) -> Option<Vec<Result<Solved, ArrowError>>> {
    let queue = Mutex::new(parts.iter().enumerate());
    let next = || queue.lock().ok()?.next();
    let is_stopped = AtomicBool::new(false);
    let work = |goes_on: &dyn Fn(usize) -> bool| {
        let mut solved: Vec<(usize, Result<Solved, ArrowError>)> = Vec::new();
        while !is_stopped.load(Ordering::Relaxed) {
            let Some((place, part)) = next() else { break };
            solved.push((place, plan.solve_with(part, Vec::new())));
            if !goes_on(place) {
                is_stopped.store(true, Ordering::Relaxed);
            }
        }
        solved
    };
    let mut solved = thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(parts.len())).map(|_| scope.spawn(|| work(&|_| true))).collect();
        let mut solved = work(goes_on);
        for other in others {
            solved.extend(other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        solved
    });
    solved.sort_by_key(|(place, _)| *place);
    (!is_stopped.into_inner()).then(|| solved.into_iter().map(|(_, part)| part).collect())
}
