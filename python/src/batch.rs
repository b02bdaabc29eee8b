//! Columns of numbers: a plan from their names, and its answer on several threads.

use std::ffi::CString;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use numpy::{PyArray1, PyReadonlyArray1};
use planar_impact_app::batch::{self, Cell, Column, Header, InputColumn, Options, RowWarning, Table};
use planar_impact_app::notice::Severity;
use planar_impact_app::{Case, Notice, Units};
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyString};

use crate::control::Signals;
use crate::error::Failure;
use crate::source::Source;

/// Rows that one thread solves before it looks for more.
const ROWS: usize = 1 << 14;

/// Reads the case that supplies what no column has.
pub fn base(source: Option<&Source>) -> Result<Option<Case>, Failure> {
    let read = |source: &Source| source.case().map_err(|issues| Failure { has_lines: source.has_lines(), ..issues.into() });
    source.map(read).transpose()
}

/// Warns of columns that pass through although they may be meant as inputs; `depth` is that of the caller's line, as in `warnings.warn`.
pub fn warn(py: Python<'_>, notices: &[Notice], depth: i32) -> PyResult<()> {
    notices
        .iter()
        .filter(|notice| notice.severity == Severity::Warning)
        .try_for_each(|notice| say(py, &Units::Si.sentence(&notice.message), depth))
}

/// Warns of sizes that no road vehicle has and of rows without inputs, each once with its first row, counted from 0 as in Python.
pub fn warn_of_rows(py: Python<'_>, warnings: Vec<RowWarning>, depth: i32) -> PyResult<()> {
    RowWarning::merged(warnings).iter().try_for_each(|warning| say(py, &warning.sentence(&format!("row {}", warning.first)), depth))
}

fn say(py: Python<'_>, text: &str, depth: i32) -> PyResult<()> {
    let text = CString::new(text.replace('\0', ""))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, depth)
}

/// What is computed from columns of these names.
#[pyclass(frozen, module = "planar_impact._native")]
pub struct Plan(batch::Plan);

/// A cell as Python gives it.
pub enum Given {
    /// A bool.
    Truth(bool),
    /// Anything that converts to a float.
    Number(f64),
    /// A string.
    Text(String),
    /// `None`.
    Nothing,
    /// Anything else, with its type.
    Other(String),
}

impl FromPyObject<'_, '_> for Given {
    type Error = PyErr;

    fn extract(cell: Borrowed<'_, '_, PyAny>) -> PyResult<Given> {
        let other = || Given::Other(cell.get_type().name().map_or_else(|_| String::new(), |name| name.to_string()));
        Ok(if cell.is_none() {
            Given::Nothing
        } else if let Ok(truth) = cell.cast::<PyBool>() {
            Given::Truth(truth.is_true())
        } else if let Ok(text) = cell.cast::<PyString>() {
            text.to_cow().map_or_else(|_| other(), |text| Given::Text(text.into_owned()))
        } else {
            cell.extract().map_or_else(|_| other(), Given::Number)
        })
    }
}

/// A column as Python gives it.
#[derive(FromPyObject)]
pub enum Values<'py> {
    /// A number in every row.
    #[pyo3(transparent)]
    Numbers(PyReadonlyArray1<'py, f64>),
    /// The same cell in every row.
    #[pyo3(transparent)]
    Same((Given,)),
    /// Any cells.
    #[pyo3(transparent)]
    Cells(Vec<Given>),
}

/// A column whose parts can be read on any thread.
enum Readable<'a> {
    Numbers(&'a [f64]),
    Cells(Vec<Cell>),
    Same { cell: Cell, numbers: Vec<f64> },
}

impl<'a> Readable<'a> {
    fn of(column: &InputColumn, values: &'a Values<'_>, rows: usize) -> PyResult<Readable<'a>> {
        let readable = match values {
            Values::Numbers(numbers) => Readable::Numbers(numbers.as_slice()?),
            Values::Cells(cells) => Readable::Cells(cells.iter().map(|given| cell(column, given)).collect()),
            Values::Same((given,)) => {
                let cell = cell(column, given);
                let number = if let (Cell::Number(number), true) = (&cell, column.key.is_numeric()) { Some(*number) } else { None };
                Readable::Same { cell, numbers: number.map_or_else(Vec::new, |number| vec![number; rows.min(ROWS)]) }
            }
        };
        let found = match &readable {
            Readable::Numbers(numbers) => numbers.len(),
            Readable::Cells(cells) => cells.len(),
            Readable::Same { .. } => rows,
        };
        if found == rows { Ok(readable) } else { Err(PyValueError::new_err(format!("{}: {found} cells, not {rows}", column.key))) }
    }

    fn part(&self, column: &InputColumn, first: usize, rows: usize) -> Column<'_> {
        match self {
            Readable::Numbers(numbers) => column.of_numbers(&numbers[first..first + rows]),
            Readable::Cells(cells) => Column::Cells(cells[first..first + rows].to_vec()),
            Readable::Same { numbers, .. } if !numbers.is_empty() => Column::Numbers(numbers[..rows].into()),
            Readable::Same { cell, .. } => Column::Cells(vec![cell.clone(); rows]),
        }
    }
}

fn cell(column: &InputColumn, given: &Given) -> Cell {
    match given {
        Given::Truth(truth) => column.of_truth(*truth),
        Given::Number(number) => column.of_number(*number),
        Given::Text(text) => column.of_text(text),
        Given::Nothing => Cell::Empty,
        Given::Other(of_type) => Cell::Unreadable(of_type.as_str().into()),
    }
}

/// Words of some rows, such as the codes of refusals.
type Words = Vec<(usize, String)>;

/// The answer: a column for each number; the derivatives row by row, empty if they are columns; the violated rules if they are checked; the
/// refusals.
type Solved<'py> = (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<f64>>, Words, Words);

/// What is found of rows beside their numbers: the violated rules if they are checked, the refusals, and sizes that no road vehicle has.
#[derive(Default)]
struct Found {
    check: Words,
    refused: Words,
    warnings: Vec<RowWarning>,
}

/// Rows that are solved together, and where their numbers go.
struct Part<'a> {
    first: usize,
    rows: usize,
    columns: Vec<&'a mut [f64]>,
    /// Derivatives row by row; empty if they are columns.
    derivatives: &'a mut [f64],
}

#[pymethods]
impl Plan {
    /// Reads the names of columns.
    #[new]
    fn new(
        py: Python<'_>,
        names: Vec<String>,
        case: Option<&Source>,
        of: Vec<String>,
        wrt: Vec<String>,
        check: bool,
        fast: bool,
    ) -> PyResult<Plan> {
        let plan = py.detach(|| -> Result<Plan, Failure> {
            let headers: Vec<Header> = names.iter().map(|name| Header::read(name)).collect();
            let options = Options { of, wrt, check, fast };
            let base = base(case)?;
            let has_lines = case.is_none_or(Source::has_lines);
            let plan = batch::Plan::of(&headers, base.as_ref(), &options);
            plan.map(Plan).map_err(|issues| Failure { has_lines, ..issues.into() })
        })?;
        warn(py, &plan.0.notices(None), 3)?;
        Ok(plan)
    }

    /// Returns the places of the columns that are inputs.
    #[getter]
    fn inputs(&self) -> Vec<usize> {
        self.0.inputs().iter().map(|column| column.place).collect()
    }

    /// Returns the names of the columns that are added.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.0.names()
    }

    /// Returns the numbers of outputs and of inputs that they are differentiated with respect to.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.0.outputs().len(), self.0.wrt().len())
    }

    /// Solves rows. Derivatives are columns, or if `is_array` the rows of an array.
    fn solve<'py>(
        &self,
        py: Python<'py>,
        rows: usize,
        columns: Vec<Values<'py>>,
        threads: usize,
        is_array: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Solved<'py>> {
        let inputs = self.0.inputs();
        if columns.len() != inputs.len() {
            return Err(PyValueError::new_err(format!("{} columns, not {}", columns.len(), inputs.len())));
        }
        let columns: Vec<Readable<'_>> =
            inputs.iter().zip(&columns).map(|(column, values)| Readable::of(column, values, rows)).collect::<PyResult<_>>()?;
        let (outputs, inputs) = self.shape();
        let (count, cells) = if is_array { (outputs, rows * outputs * inputs) } else { (outputs * (1 + inputs), 0) };
        let mut numbers: Vec<Vec<f64>> = (0..count).map(|_| vec![0.0; rows]).collect();
        let mut derivatives = vec![0.0; cells];
        let signals = Signals::new(progress);
        let found = py.detach(|| self.fill(&columns, rows, &mut numbers, &mut derivatives, threads, &signals));
        let Some(Found { check, refused, warnings }) = found else { return Err(signals.stopped()) };
        signals.done()?;
        warn_of_rows(py, warnings, 3)?;
        let numbers = numbers.into_iter().map(|column| PyArray1::from_vec(py, column)).collect();
        Ok((numbers, PyArray1::from_vec(py, derivatives), check, refused))
    }
}

impl Plan {
    /// Solves rows on threads, and returns what is found of them; `None` if a signal stops it.
    fn fill(
        &self,
        columns: &[Readable<'_>],
        rows: usize,
        numbers: &mut [Vec<f64>],
        derivatives: &mut [f64],
        threads: usize,
        signals: &Signals,
    ) -> Option<Found> {
        let part = |first| Part { first, rows: ROWS.min(rows - first), columns: Vec::with_capacity(numbers.len()), derivatives: &mut [] };
        let mut parts: Vec<Part<'_>> = (0..rows).step_by(ROWS).map(part).collect();
        for column in numbers {
            parts.iter_mut().zip(column.chunks_mut(ROWS)).for_each(|(part, chunk)| part.columns.push(chunk));
        }
        if !derivatives.is_empty() {
            let cells = derivatives.len() / rows * ROWS;
            parts.iter_mut().zip(derivatives.chunks_mut(cells)).for_each(|(part, chunk)| part.derivatives = chunk);
        }
        let count = parts.len();
        let threads = threads.min(parts.len());
        let queue = Mutex::new(parts.into_iter());
        let next = || queue.lock().ok()?.next();
        let is_stopped = AtomicBool::new(false);
        let work = |goes_on: &dyn Fn(usize) -> bool| {
            let mut found = Found::default();
            while !is_stopped.load(Ordering::Relaxed) {
                let Some(part) = next() else { break };
                let place = part.first / ROWS;
                self.fill_part(columns, part, &mut found);
                if !goes_on(place) {
                    is_stopped.store(true, Ordering::Relaxed);
                }
            }
            found
        };
        let mut found = thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(|| work(&|_| true))).collect();
            let mut found = work(&|place| signals.look(place + 1, count));
            for other in others {
                let Found { check, refused, warnings } = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                found.check.extend(check);
                found.refused.extend(refused);
                found.warnings.extend(warnings);
            }
            found
        });
        found.check.sort_by_key(|(row, _)| *row);
        found.refused.sort_by_key(|(row, _)| *row);
        (!is_stopped.into_inner()).then_some(found)
    }

    fn fill_part(&self, columns: &[Readable<'_>], part: Part<'_>, found: &mut Found) {
        let Part { first, rows, columns: to, derivatives } = part;
        let inputs = self.0.inputs();
        let columns = inputs.iter().zip(columns).map(|(column, readable)| readable.part(column, first, rows)).collect();
        let answer = self.0.solve(&Table { rows, columns, unreadable: Vec::new() });
        for (to, from) in to.into_iter().zip(answer.outputs.iter().chain(&answer.derivatives)) {
            to.copy_from_slice(from);
        }
        if !derivatives.is_empty() {
            for (row, to) in derivatives.chunks_mut(answer.derivatives.len()).enumerate() {
                to.iter_mut().zip(&answer.derivatives).for_each(|(to, from)| *to = from[row]);
            }
        }
        let rules = answer.check.into_iter().flatten().enumerate();
        found.check.extend(rules.filter_map(|(row, rules)| Some((first + row, rules?))));
        found.refused.extend(answer.refused.into_iter().map(|refused| (first + refused.row, refused.codes)));
        found.warnings.extend(answer.warnings.into_iter().map(|warning| warning.after(first)));
    }
}
