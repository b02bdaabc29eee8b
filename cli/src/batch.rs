//! The verb `batch`: reads tables part by part, solves them on several threads and writes one table, in memory that does not grow with their length.

mod format;
mod in_order;
mod lengths;
mod progress;
mod quotes;
mod sink;
mod source;

use std::thread::available_parallelism;

use arrow_schema::SchemaRef;
use planar_impact_app::batch::{Header, Refused, RowWarning};
use planar_impact_app::{Cause, Issue, Issues, Units};
use planar_impact_arrow::{Options, Plan};

use crate::arguments::Batch;
use crate::exit::{Failure, Status};
use crate::output::CommandOutput;
use crate::{files, interrupt, output, verbs};
use format::Format;
use in_order::in_order;
use progress::Progress;
use sink::{Encoded, Sink};
use source::{Part, Source};

/// Solves every row of every table.
///
/// # Errors
///
/// Returns everything wrong with the call or the tables, or fails if the output cannot be written; with `--fail-fast` also the first row that is refused.
pub fn run(call: &Batch) -> Result<CommandOutput, Failure> {
    let format = Format::of(&call.output)?;
    files::is_read_once(call.files.iter().chain(&call.case))?;
    files::is_no_input(Some(&call.output), call.files.iter().chain(&call.case))?;
    let (rows, together) = (rows_of_a_part(format), rows_solved_together(format));
    let base = call.case.as_deref().map(|path| verbs::case_unless_written(path, Some(&call.output))).transpose();
    let (base, mut sources) = Issues::both(base, open(call, rows))?;
    let schema = sources[0].schema().clone();
    let options = Options { of: call.of.clone(), wrt: call.wrt.clone(), check: call.check, fast: call.fast };
    let plan = Plan::of(&schema, base.as_ref(), &options)?;
    for notice in plan.notices(base.as_ref()) {
        output::say(format_args!("{}: {}", notice.severity, Units::Si.sentence(&notice.message)));
    }
    let plan = if format == Format::Csv { plan } else { plan.with_numbers() };
    let (columns, passing, headers) = (plan.schema(), schema.fields().len(), headers(&schema, &plan));
    let unwritable = sink::unwritable(format, &columns, passing);
    if !unwritable.is_empty() {
        return Err(Issues::without_source(Cause::Input, unwritable).into());
    }
    // A file of Arrow has one dictionary for each column.
    let has_one_dictionary = sources.len() == 1 && sources[0].has_one_dictionary();
    let columns = if format == Format::Arrow && !has_one_dictionary { sink::plain(&columns) } else { columns };
    let (mut sink, encoder) = Sink::create(&call.output, format, &columns, passing, &headers).map_err(Failure::Output)?;
    interrupt::note();
    let threads = call.threads.map_or_else(|| available_parallelism().map_or(1, usize::from), usize::from);
    let bytes = if sources.iter().any(|source| source.bytes() == 0) { 0 } else { sources.iter().map(Source::bytes).sum() };
    let (mut progress, mut at, mut of_file) = (Progress::new(bytes), 0, 0);
    let read = || {
        if interrupt::is_interrupted() {
            return Err(Issues::interrupted().into());
        }
        while let Some(source) = sources.get_mut(at) {
            if let Some(part) = source.next(rows)? {
                let before: u64 = sources[..at].iter().map(Source::bytes).sum();
                let first = of_file;
                of_file += part.batch.num_rows() as u64;
                return Ok(Some((part, before + sources[at].position(), Origin { file: at, first })));
            }
            source.close(&call.files[at]);
            (at, of_file) = (at + 1, 0);
        }
        Ok(None)
    };
    let work = |(part, position, origin): (Part, u64, Origin)| {
        let rows = part.batch.num_rows();
        let (mut refused, mut warnings) = (Vec::new(), Vec::new());
        let solved = (0..rows).step_by(together).map(|first| {
            let solved = plan.solve_with(&part.batch.slice(first, together.min(rows - first)), part.unreadable_in(first..first + together));
            let solved = solved.map_err(sink::of_arrow)?;
            refused.extend(solved.refused.into_iter().map(|refused| Refused { row: first + refused.row, ..refused }));
            solved.warnings.into_iter().for_each(|warning| warning.after(first).add(&mut warnings));
            Ok(solved.batch)
        });
        let encoded = encoder.encode(solved).map_err(Failure::Output)?;
        Ok(Done { rows, refused, warnings, encoded, position, origin })
    };
    let write = |done: Result<Done, Failure>| {
        let Done { rows, refused, warnings, encoded, position, origin } = done?;
        let before = progress.rows();
        let name = |row: usize| {
            let number = |first: u64| first + row as u64 + 1;
            match &call.files[..] {
                [_] => format!("row {}", number(before)),
                // The output has the rows of all, and a reader looks for the one of his file.
                files => format!("row {} (row {} of `{}`)", number(before), number(origin.first), files[origin.file].display()),
            }
        };
        if let Some(first) = refused.first().filter(|_| call.fail_fast) {
            return Err(refused_at(name(first.row), first));
        }
        progress.warn(warnings, name);
        progress.add(rows, &refused, position, name);
        sink.write(encoded).map_err(Failure::Output)
    };
    in_order(threads, read, work, write)?;
    sink.finish().map_err(Failure::Output)?;
    let has_refused = progress.finish();
    Ok(CommandOutput::text(String::new()).with(if has_refused { Status::DoesNotHold } else { Status::Done }))
}

/// Rows that are solved and written.
struct Done {
    rows: usize,
    refused: Vec<Refused>,
    warnings: Vec<RowWarning>,
    encoded: Encoded,
    position: u64,
    origin: Origin,
}

/// The place of rows in their file.
#[derive(Clone, Copy)]
struct Origin {
    file: usize,
    /// The number of its rows before them.
    first: u64,
}

/// Returns the number of rows that are read and written together: lines of text are long, and row groups should be.
fn rows_of_a_part(format: Format) -> usize {
    match format {
        Format::Csv => 1 << 13,
        Format::Parquet | Format::Arrow => 1 << 16,
    }
}

/// Returns the number of rows that are solved together: few enough that an encoder finds them in the cache, or the whole part where none needs them again.
fn rows_solved_together(format: Format) -> usize {
    match format {
        Format::Parquet => 1 << 12,
        Format::Csv | Format::Arrow => rows_of_a_part(format),
    }
}

/// Opens every table, or reports what is wrong with each.
fn open(call: &Batch, rows: usize) -> Result<Vec<Source>, Issues> {
    let (mut sources, mut issues): (Vec<Source>, Vec<Issue>) = (Vec::new(), Vec::new());
    let mut stdin_is_taken = false;
    for path in &call.files {
        if path.as_os_str() == "-" && std::mem::replace(&mut stdin_is_taken, true) {
            issues.push(files::read_twice());
            continue;
        }
        match Source::open(path, rows) {
            Ok(mut source) => {
                if !sources.is_empty() {
                    source.close(path);
                }
                sources.push(source);
            }
            Err(found) => issues.extend_from_slice(found.list()),
        }
    }
    if let Some((first, others)) = sources.split_first() {
        for other in others.iter().filter(|other| other.schema().fields() != first.schema().fields()) {
            issues.push(Issue::of_file("other-columns", other_columns(first, other)));
        }
        for empty in sources.iter().filter(|source| source.schema().fields().is_empty()) {
            let help = "name the columns as in a case file, such as vehicle.1.speed or contact.restitution";
            issues.push(Issue::of_file("no-input-column", format!("`{}` has no columns", empty.name)).with_help(help));
        }
    }
    if issues.is_empty() { Ok(sources) } else { Err(Issues::without_source(Cause::Input, issues)) }
}

/// Says how the columns of two tables differ.
fn other_columns(first: &Source, other: &Source) -> String {
    let fields = || first.schema().fields().iter().zip(other.schema().fields());
    let (has_same_names, has_same_count) =
        (fields().all(|(one, other)| one.name() == other.name()), first.schema().fields().len() == other.schema().fields().len());
    match fields().find(|(one, other)| one.data_type() != other.data_type()) {
        Some((one, of_other)) if has_same_names && has_same_count => {
            let (name, here, there) = (one.name(), of_other.data_type(), one.data_type());
            format!(
                "the column {name} is {here} in `{}` and {there} in `{}`; tables of one call have columns of the same types",
                other.name, first.name
            )
        }
        _ => format!("`{}` has other columns than `{}`; tables of one call have the same, in the same order", other.name, first.name),
    }
}

/// Returns the headers of the answer as text: a unit of the table's metadata stands in brackets.
fn headers(table: &SchemaRef, plan: &Plan) -> Vec<String> {
    let header = |(i, field): (usize, &std::sync::Arc<arrow_schema::Field>)| match planar_impact_arrow::unit_of(field) {
        Some(unit) if i < table.fields().len() && Header::read(field.name()).unit.is_none() => format!("{} [{unit}]", field.name()),
        _ => field.name().clone(),
    };
    plan.schema().fields().iter().enumerate().map(header).collect()
}

fn refused_at(path: String, refused: &Refused) -> Failure {
    let cause = if refused.is_of_input { Cause::Input } else { Cause::Physics };
    let issue = Issue { path, ..Issue::of_file("refused-row", refused.reason.clone()) };
    Failure::Issues(Issues::without_source(cause, vec![issue]), Units::Si)
}
