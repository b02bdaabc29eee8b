//! From the schema of a table to that of its answer.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use planar_impact_app::batch::{self, Header, InputColumn, NotARow, Options, Refused, RowWarning, Table};
use planar_impact_app::quantity::Kind;
use planar_impact_app::{Case, Issue, Issues, Notice};

use crate::{answer, cells};

/// The key of a field's metadata that names its unit.
pub(crate) const UNIT: &str = "unit";

/// What is computed from every record batch of a schema.
#[derive(Clone, Debug)]
pub struct Plan {
    plan: batch::Plan,
    input: SchemaRef,
    output: SchemaRef,
    /// Whether an input that is text becomes a number in the answer.
    is_typed: bool,
}

/// The answer to a record batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// The columns of the table, and those that are added.
    pub batch: RecordBatch,
    /// The rows that are refused, in order.
    pub refused: Vec<Refused>,
    /// The sizes that no road vehicle has, each once.
    pub warnings: Vec<RowWarning>,
}

impl Plan {
    /// Reads the schema of a table, with the case that supplies what no column has, and the question.
    ///
    /// # Errors
    ///
    /// Every column and name that is wrong.
    pub fn of(schema: &SchemaRef, base: Option<&Case>, options: &Options) -> Result<Plan, Issues> {
        let mut issues = Vec::new();
        let headers: Vec<Header> = schema.fields().iter().map(|field| header(field, &mut issues)).collect();
        let plan = batch::Plan::of(&headers, base, options);
        for column in plan.iter().flat_map(batch::Plan::inputs) {
            let field = schema.field(column.place);
            if !cells::is_readable(field.data_type()) {
                let message = format!("an input is a number or text; this column is {}", field.data_type());
                issues.push(Issue::at("wrong-type", column.key.to_string(), message));
            }
        }
        let of_columns = if issues.is_empty() { Ok(()) } else { Err(Issues::of_call(issues)) };
        let ((), plan) = Issues::both(of_columns, plan)?;
        let mut plan = Plan { plan, input: schema.clone(), output: schema.clone(), is_typed: false };
        plan.output = plan.negotiate();
        Ok(plan)
    }

    /// Returns the same plan, in whose answer an input that the table has as text is a number; null where it is not.
    #[must_use]
    pub fn with_numbers(self) -> Plan {
        let typed = Plan { is_typed: true, ..self };
        Plan { output: typed.negotiate(), ..typed }
    }

    /// Returns what a reader of the answer must know of the case, as [`batch::Plan::notices`].
    pub fn notices(&self, base: Option<&Case>) -> Vec<Notice> {
        self.plan.notices(base)
    }

    /// Returns the schema of every answer: the columns of the table; a column for each output, each derivative, and the check if there is one; `refusal`.
    pub fn schema(&self) -> SchemaRef {
        self.output.clone()
    }

    /// Solves every row of a record batch.
    ///
    /// # Errors
    ///
    /// [`ArrowError::SchemaError`] if the record batch has another schema than that of the plan.
    pub fn solve(&self, batch: &RecordBatch) -> Result<RecordBatch, ArrowError> {
        self.solve_with(batch, Vec::new()).map(|solved| solved.batch)
    }

    /// Solves every row of a record batch, but for those that could not be read, and says why rows are refused.
    ///
    /// # Errors
    ///
    /// [`ArrowError::SchemaError`] if the record batch has another schema than that of the plan.
    pub fn solve_with(&self, batch: &RecordBatch, unreadable: Vec<(usize, NotARow)>) -> Result<Solved, ArrowError> {
        if batch.schema_ref().fields() != self.input.fields() {
            return Err(ArrowError::SchemaError(format!("a record batch of {} for a plan of {}", batch.schema_ref(), self.input)));
        }
        let columns = self.plan.inputs().iter().map(|column| cells::read(column, batch.column(column.place)));
        let columns: Vec<_> = columns.collect::<Result<_, _>>()?;
        let table = Table { rows: batch.num_rows(), columns, unreadable };
        let answer = self.plan.solve(&table);
        let mut arrays: Vec<ArrayRef> = batch.columns().to_vec();
        for column in self.plan.inputs().iter().filter(|column| self.becomes_number(column)) {
            arrays[column.place] = cells::numbers(&arrays[column.place])?;
        }
        let (added, refused, warnings) = answer::arrays(answer, batch.num_rows());
        arrays.extend(added);
        Ok(Solved { batch: RecordBatch::try_new(self.schema(), arrays)?, refused, warnings })
    }

    fn becomes_number(&self, column: &InputColumn) -> bool {
        self.is_typed && column.key.is_numeric() && cells::is_text(self.input.field(column.place).data_type())
    }

    fn negotiate(&self) -> SchemaRef {
        let mut fields: Vec<Arc<Field>> = self.input.fields().iter().cloned().collect();
        for column in self.plan.inputs().iter().filter(|column| self.becomes_number(column)) {
            let field = &mut fields[column.place];
            *field = Arc::new(field.as_ref().clone().with_data_type(DataType::Float64).with_nullable(true));
        }
        let names = self.plan.names();
        let outputs = self.plan.outputs().len();
        let numbers = outputs * (1 + self.plan.wrt().len());
        for (i, name) in names.into_iter().enumerate() {
            let data_type = if i < numbers { DataType::Float64 } else { DataType::Utf8 };
            let unit = self.plan.outputs().get(i).map(|output| Kind::from(output.measure()).si).filter(|unit| !unit.is_empty());
            let metadata: HashMap<_, _> = unit.map(|unit| (UNIT.to_owned(), unit.to_owned())).into_iter().collect();
            fields.push(Arc::new(Field::new(name, data_type, true).with_metadata(metadata)));
        }
        Arc::new(Schema::new_with_metadata(fields, self.input.metadata().clone()))
    }
}

/// Returns the unit in the metadata of a field. Others write its key with a capital, as `units` or as `uom`: a number in an unread unit would pass for SI.
pub fn unit_of(field: &Field) -> Option<&str> {
    units_of(field).first().copied()
}

/// Returns the different units in the metadata of a field.
fn units_of(field: &Field) -> Vec<&str> {
    let is_unit = |key: &str| [UNIT, "units", "uom"].iter().any(|name| key.trim().eq_ignore_ascii_case(name));
    let mut units: Vec<&str> = field.metadata().iter().filter(|(key, _)| is_unit(key)).map(|(_, unit)| unit.as_str()).collect();
    units.sort_unstable();
    units.dedup();
    units
}

fn header(field: &Field, issues: &mut Vec<Issue>) -> Header {
    let header = Header::read(field.name());
    let units = units_of(field);
    let mut stated: Vec<&str> = header.unit.as_deref().into_iter().chain(units.iter().copied()).collect();
    stated.dedup();
    if let [one, other, ..] = stated[..] {
        let (where_one, where_other) = if header.unit.is_some() { ("the name", "and the metadata") } else { ("the metadata", "and also") };
        let message = format!("{where_one} has the unit {one}, {where_other} {other}; keep one");
        issues.push(Issue::at("invalid-unit", header.name.clone(), message));
    }
    let unit = header.unit.clone().or_else(|| units.first().map(|unit| (*unit).to_owned()));
    Header { unit, ..header }
}
