//! Tables: the same rows have the same answer from CSV, Parquet and Arrow, and any bytes are a table or an error of the file. The files are read by the source of
//! the command line itself.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch};
use planar_impact_app::{Case, Issues, Source};
use planar_impact_arrow::{Options, Plan};

use crate::bytes::Bytes;
use crate::{cases, table_files};

pub use crate::defect::install;

/// The rows of a table and the answer to them.
struct Answered {
    outputs: Vec<RecordBatch>,
}

/// Reads a table as `batch` does, and solves its rows.
fn answered(path: &Path, case: &Case) -> Result<Answered, Issues> {
    let mut source = table_files::source::Source::open(path, 64)?;
    let plan = Plan::of(source.schema(), Some(case), &Options { check: true, ..Options::default() })?.with_numbers();
    let mut outputs = Vec::new();
    while let Some(part) = source.next(64)? {
        let solved = plan.solve_with(&part.batch, part.unreadable).unwrap_or_else(|error| panic!("{error}"));
        outputs.push(solved.batch);
        assert!(source.position() <= source.bytes().max(1), "read further than the end");
    }
    Ok(Answered { outputs })
}

/// The case that supplies what no column has.
fn base() -> Case {
    let text = include_str!("../../cli/examples/position-a.toml").to_owned();
    Case::parse(Source::new("case.toml", text)).expect("an example")
}

fn temporary(extension: &str) -> tempfile::NamedTempFile {
    let folder = if Path::new("/dev/shm").is_dir() { Path::new("/dev/shm").to_owned() } else { std::env::temp_dir() };
    tempfile::Builder::new().prefix("planar-impact-fuzz-").suffix(extension).tempfile_in(folder).expect("a temporary file")
}

const COLUMNS: [(&str, f64, f64); 9] = [
    ("vehicle.1.speed [mph]", 0.0, 60.0),
    ("vehicle.2.speed", 0.0, 30.0),
    ("vehicle.1.mass", 800.0, 3000.0),
    ("vehicle.2.heading [deg]", 0.0, 180.0),
    ("contact.crush_plane", -0.5, 0.5),
    ("contact.restitution", 0.0, 0.4),
    ("contact.friction", 0.0, 1.0),
    ("vehicle.1.impact_center.left", -1.0, 1.0),
    ("anything", -1.0, 1.0),
];

/// The target of structured tables.
pub fn structured(data: &[u8]) {
    let mut from = Bytes::new(data);
    let rows = 1 + from.below(70);
    let columns: Vec<_> = COLUMNS.iter().filter(|_| from.chance(100)).collect();
    if columns.is_empty() {
        return;
    }
    let cell = |from: &mut Bytes<'_>, low, high| match from.byte() {
        0..=20 => None,
        21..=25 => Some(from.float()).filter(|value| value.is_finite()),
        _ => Some(from.between(low, high)),
    };
    let arrays = columns.iter().map(|(name, low, high)| {
        let cells: Vec<Option<f64>> = (0..rows).map(|_| cell(&mut from, *low, *high)).collect();
        (*name, Arc::new(Float64Array::from(cells)) as ArrayRef, true)
    });
    let table = RecordBatch::try_from_iter_with_nullable(arrays.collect::<Vec<_>>()).expect("columns of one length");
    let case = base();
    let answers = [csv(&table), parquet(&table), arrow(&table)].map(|file| answered(file.path(), &case));
    let mut found = answers.into_iter().map(|answer| answer.map(whole));
    match found.next() {
        Some(Ok(first)) => {
            for other in found {
                let other = other.unwrap_or_else(|issues| panic!("one format is read and another not: {issues}"));
                same(&first, &other);
            }
            // Each row by itself has the same numbers.
            let alone = Plan::of(table.schema_ref(), Some(&case), &Options { check: true, ..Options::default() })
                .expect("the same plan")
                .with_numbers();
            let last = alone.solve(&table.slice(rows - 1, 1)).expect("a row");
            same(&first.slice(rows - 1, 1), &last);
        }
        Some(Err(issues)) => {
            cases::sound_refusal(&issues);
            assert!(found.all(|other| other.is_err()), "one format is refused and another read: {issues}");
        }
        None => (),
    }
}

fn whole(answered: Answered) -> RecordBatch {
    let first = &answered.outputs[0];
    let columns = (0..first.num_columns()).map(|i| {
        let parts: Vec<&dyn Array> = answered.outputs.iter().map(|batch| batch.column(i).as_ref()).collect();
        arrow_concat(&parts)
    });
    RecordBatch::try_new(first.schema(), columns.collect()).expect("the same columns")
}

/// Numbers and texts one after the other.
fn arrow_concat(parts: &[&dyn Array]) -> ArrayRef {
    match parts[0].data_type() {
        arrow_schema::DataType::Float64 => {
            Arc::new(parts.iter().flat_map(|part| part.as_primitive::<Float64Type>().iter()).collect::<Float64Array>())
        }
        _ => Arc::new(parts.iter().flat_map(|part| part.as_string::<i32>().iter()).collect::<arrow_array::StringArray>()),
    }
}

/// Numbers have the same bits. A column that passes through is text in CSV.
fn same(one: &RecordBatch, other: &RecordBatch) {
    assert_eq!(one.num_rows(), other.num_rows());
    for field in one.schema().fields().iter().filter(|field| field.name() != "anything") {
        let [one, other] =
            [one, other].map(|batch| batch.column_by_name(field.name()).unwrap_or_else(|| panic!("{} is missing", field.name())));
        if let (Some(one), Some(other)) = (one.as_primitive_opt::<Float64Type>(), other.as_primitive_opt::<Float64Type>()) {
            let bits = |array: &Float64Array| array.iter().map(|value| value.map(f64::to_bits)).collect::<Vec<_>>();
            assert_eq!(bits(one), bits(other), "{}", field.name());
        } else {
            assert_eq!(one.as_string::<i32>(), other.as_string::<i32>(), "{}", field.name());
        }
    }
}

fn csv(table: &RecordBatch) -> tempfile::NamedTempFile {
    let mut file = temporary(".csv");
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(table.schema().fields().iter().map(|field| field.name())).expect("memory");
    for row in 0..table.num_rows() {
        let cell = |column: &ArrayRef| {
            let column = column.as_primitive::<Float64Type>();
            if column.is_valid(row) { format!("{:e}", column.value(row)) } else { String::new() }
        };
        writer.write_record(table.columns().iter().map(cell)).expect("memory");
    }
    file.write_all(&writer.into_inner().expect("memory")).expect("a file");
    file
}

fn parquet(table: &RecordBatch) -> tempfile::NamedTempFile {
    let file = temporary(".parquet");
    let mut writer = parquet::arrow::ArrowWriter::try_new(file.reopen().expect("a file"), table.schema(), None).expect("a schema");
    writer.write(table).expect("a file");
    writer.close().expect("a file");
    file
}

fn arrow(table: &RecordBatch) -> tempfile::NamedTempFile {
    let file = temporary(".arrow");
    let open: File = file.reopen().expect("a file");
    let mut writer = arrow_ipc::writer::FileWriter::try_new(open, table.schema_ref()).expect("a schema");
    writer.write(table).expect("a file");
    writer.finish().expect("a file");
    file
}

/// The target of bytes: the first says which format the others are.
pub fn bytes(data: &[u8]) {
    let Some((&first, bytes)) = data.split_first() else { return };
    let mut file = temporary([".csv", ".parquet", ".arrow"][usize::from(first % 3)]);
    file.write_all(bytes).expect("a file");
    match answered(file.path(), &base()) {
        Ok(answered) => {
            for batch in answered.outputs {
                let refusal = batch.column_by_name("refusal").expect("the last column").as_string::<i32>();
                for column in batch.columns().iter().skip(batch.num_columns().saturating_sub(30)) {
                    let Some(numbers) = column.as_primitive_opt::<Float64Type>() else { continue };
                    for row in 0..batch.num_rows() {
                        assert!(refusal.is_null(row) || numbers.is_null(row), "row {row} is refused and has an answer");
                    }
                }
            }
        }
        Err(issues) => cases::sound_refusal(&issues),
    }
}
