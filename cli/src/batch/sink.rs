//! Tables that are written part by part, and appear when they are whole.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, RecordBatch, make_array, new_null_array};
use arrow_cast::cast;
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, DataType, Field, FieldRef, Schema, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowColumnChunk, ArrowColumnWriter, ArrowRowGroupWriterFactory, compute_leaves};
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesBuilder};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::ColumnPath;

use planar_impact_app::Issue;

use super::format::Format;
use crate::defect;
use crate::output::{self, OutputFile};

const BUFFER: usize = 1 << 18;

type File = BufWriter<OutputFile>;

/// A table that is being written.
pub struct Sink {
    rows: Rows,
}

enum Rows {
    /// Text for standard output, which gets nothing unless it is whole.
    Printed(BufWriter<std::fs::File>),
    Csv(File),
    Parquet(SerializedFileWriter<File>),
    Arrow(Box<FileWriter<File>>),
}

/// Encodes rows on any thread.
pub enum Encoder {
    /// As lines of text.
    Csv,
    /// As a row group.
    Parquet(ArrowRowGroupWriterFactory, SchemaRef),
    /// In these types: the format is that of memory.
    Arrow(SchemaRef),
}

/// Encoded rows.
pub enum Encoded {
    /// Lines of text.
    Csv(Vec<u8>),
    /// The columns of a row group.
    Parquet(Vec<ArrowColumnChunk>),
    /// The rows themselves.
    Arrow(Vec<RecordBatch>),
}

/// Returns an issue for each of the first columns that a format cannot hold.
pub fn unwritable(format: Format, schema: &SchemaRef, passing: usize) -> Vec<Issue> {
    let issue = |field: &FieldRef| {
        let reason = defect::caught(|| try_on_a_row(format, field)).unwrap_or_else(Err).err()?;
        let message = format!("its type is {}, which a table of this format does not hold: {reason}", field.data_type());
        Some(
            Issue::at("unwritable-column", field.name().clone(), message)
                .with_help("leave the column out, or write a table of another format"),
        )
    };
    schema.fields().iter().take(passing).filter_map(issue).collect()
}

/// Writes a row without a value to memory.
fn try_on_a_row(format: Format, field: &Field) -> Result<(), String> {
    let schema = SchemaRef::new(Schema::new(vec![field.clone().with_nullable(true)]));
    let row = RecordBatch::try_new(schema.clone(), vec![new_null_array(field.data_type(), 1)]).map_err(|error| error.to_string())?;
    let written = match format {
        Format::Csv => lines(&row, &mut Vec::new()),
        Format::Parquet => {
            let write = || {
                let mut writer = ArrowWriter::try_new(Vec::new(), schema, None)?;
                writer.write(&row)?;
                writer.close()
            };
            return write().map(drop).map_err(|error| error.to_string());
        }
        Format::Arrow => FileWriter::try_new(Vec::new(), &schema).and_then(|mut writer| writer.write(&row)),
    };
    written.map_err(|error| error.to_string())
}

/// Rows for standard output wait in a file until all are solved.
fn of_temporary(error: io::Error) -> io::Error {
    let (folder, why) = (std::env::temp_dir(), io::Error::from(error.kind()));
    io::Error::new(error.kind(), format!("the folder for temporary files, {}: {why}; name another one in TMPDIR", folder.display()))
}

impl Sink {
    /// Begins a table, with these headers if it is text; `-` is standard output. The columns after the first `passing` are computed.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn create(path: &Path, format: Format, schema: &SchemaRef, passing: usize, headers: &[String]) -> io::Result<(Sink, Encoder)> {
        let (rows, encoder) = if path.as_os_str() == "-" {
            let mut file = BufWriter::with_capacity(BUFFER, tempfile::tempfile().map_err(of_temporary)?);
            file.write_all(&line(headers)?)?;
            (Rows::Printed(file), Encoder::Csv)
        } else {
            let file = BufWriter::with_capacity(BUFFER, OutputFile::create(path)?);
            match format {
                Format::Csv => {
                    let mut file = file;
                    file.write_all(&line(headers)?)?;
                    (Rows::Csv(file), Encoder::Csv)
                }
                Format::Parquet => {
                    let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties(schema, passing))).map_err(of_parquet)?;
                    let (writer, factory) = writer.into_serialized_writer().map_err(of_parquet)?;
                    (Rows::Parquet(writer), Encoder::Parquet(factory, schema.clone()))
                }
                Format::Arrow => {
                    let writer = FileWriter::try_new(file, schema).map_err(of_arrow)?;
                    (Rows::Arrow(Box::new(writer)), Encoder::Arrow(schema.clone()))
                }
            }
        };
        Ok((Sink { rows }, encoder))
    }

    /// Appends rows.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn write(&mut self, encoded: Encoded) -> io::Result<()> {
        match (&mut self.rows, encoded) {
            (Rows::Printed(file), Encoded::Csv(lines)) => file.write_all(&lines),
            (Rows::Csv(file), Encoded::Csv(lines)) => file.write_all(&lines),
            (Rows::Parquet(writer), Encoded::Parquet(columns)) => {
                let append = |writer: &mut SerializedFileWriter<File>| {
                    let mut group = writer.next_row_group()?;
                    columns.into_iter().try_for_each(|column| column.append_to_row_group(&mut group))?;
                    group.close().map(drop)
                };
                append(writer).map_err(of_parquet)
            }
            (Rows::Arrow(writer), Encoded::Arrow(batches)) => batches.iter().try_for_each(|batch| writer.write(batch)).map_err(of_arrow),
            _ => Err(io::Error::other("rows of another format")),
        }
    }

    /// Completes the table, and puts it at its place.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn finish(self) -> io::Result<()> {
        let file = match self.rows {
            Rows::Printed(file) => return output::copy(file.into_inner().map_err(io::IntoInnerError::into_error)?),
            Rows::Csv(file) => file,
            Rows::Parquet(writer) => writer.into_inner().map_err(of_parquet)?,
            Rows::Arrow(mut writer) => {
                writer.finish().map_err(of_arrow)?;
                writer.into_inner().map_err(of_arrow)?
            }
        };
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.keep()
    }
}

impl Encoder {
    /// Encodes rows: those of several record batches, as one part of the table.
    ///
    /// # Errors
    ///
    /// If a column is of a type that the format does not have, or if a batch is one.
    pub fn encode(&self, mut batches: impl Iterator<Item = io::Result<RecordBatch>>) -> io::Result<Encoded> {
        match self {
            Encoder::Csv => {
                let mut text = Vec::new();
                batches.try_for_each(|batch| lines(&batch?, &mut text).map_err(of_arrow))?;
                Ok(Encoded::Csv(text))
            }
            Encoder::Parquet(factory, schema) => defect::caught(|| {
                let mut writers = factory.create_column_writers(0).map_err(of_parquet)?;
                batches.try_for_each(|batch| add(&batch?, schema, &mut writers).map_err(of_parquet))?;
                let columns = writers.into_iter().map(|writer| writer.close()).collect::<Result<_, _>>();
                columns.map(Encoded::Parquet).map_err(of_parquet)
            })
            .unwrap_or_else(|said| Err(io::Error::other(said))),
            Encoder::Arrow(schema) => {
                let in_types = |batch: io::Result<RecordBatch>| {
                    let columns = batch?
                        .columns()
                        .iter()
                        .zip(schema.fields())
                        .map(|(column, field)| cast(column, field.data_type()))
                        .collect::<Result<_, _>>();
                    columns.and_then(|columns| RecordBatch::try_new(schema.clone(), columns)).map_err(of_arrow)
                };
                batches.map(in_types).collect::<Result<_, _>>().map(Encoded::Arrow)
            }
        }
    }
}

/// Returns the schema with the values of dictionaries in their place.
pub fn plain(schema: &SchemaRef) -> SchemaRef {
    let of = |field: &FieldRef| match field.data_type() {
        DataType::Dictionary(_, values) => field.as_ref().clone().with_data_type(values.as_ref().clone()).into(),
        _ => field.clone(),
    };
    Schema::new_with_metadata(schema.fields().iter().map(of).collect::<Vec<FieldRef>>(), schema.metadata().clone()).into()
}

/// Adds rows to the columns of a row group.
fn add(batch: &RecordBatch, schema: &SchemaRef, writers: &mut [ArrowColumnWriter]) -> Result<(), ParquetError> {
    let mut next = writers.iter_mut();
    for (field, array) in schema.fields().iter().zip(batch.columns()) {
        for leaf in compute_leaves(field, array)? {
            next.next().ok_or_else(|| ParquetError::General("a column without a writer".to_owned()))?.write(&leaf)?;
        }
    }
    Ok(())
}

/// Numbers in full, since they are seldom equal, and computed ones uncompressed, since they do not become smaller; words as a list of those that occur.
fn properties(schema: &SchemaRef, passing: usize) -> WriterProperties {
    let any = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_created_by(concat!("planar-impact ", env!("CARGO_PKG_VERSION")).to_owned());
    let numbers = schema.fields().iter().enumerate().filter(|(_, field)| *field.data_type() == DataType::Float64);
    let in_full = |any: WriterPropertiesBuilder, (i, field): (usize, &FieldRef)| {
        let path = || ColumnPath::new(vec![field.name().clone()]);
        let compression = if i < passing { Compression::SNAPPY } else { Compression::UNCOMPRESSED };
        any.set_column_dictionary_enabled(path(), false).set_column_compression(path(), compression)
    };
    numbers.fold(any, in_full).build()
}

fn line(headers: &[String]) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(headers)?;
    writer.into_inner().map_err(|error| error.into_error())
}

/// Writes rows as lines, each number with as many digits as tell it from every other.
fn lines(batch: &RecordBatch, to: &mut Vec<u8>) -> Result<(), ArrowError> {
    // What cannot be written as text is an error, and no text of its own.
    let options = FormatOptions::default().with_display_error(false);
    let columns = batch.columns().iter().map(in_utc).collect::<Result<Vec<ArrayRef>, _>>()?;
    let cells: Vec<Cells<'_>> = columns
        .iter()
        .map(|column| match column.data_type() {
            DataType::Float64 => Ok(Cells::Numbers(column.as_primitive::<Float64Type>())),
            DataType::Utf8 => Ok(Cells::Texts(column.as_string())),
            _ => ArrayFormatter::try_new(column.as_ref(), &options).map(|formatter| Cells::Others(column.as_ref(), formatter)),
        })
        .collect::<Result<_, _>>()?;
    to.reserve(16 * cells.len() * batch.num_rows());
    let mut writer = csv::Writer::from_writer(to);
    let mut digits = zmij::Buffer::new();
    for row in 0..batch.num_rows() {
        for column in &cells {
            match column {
                Cells::Numbers(array) if array.is_valid(row) => writer.write_field(digits.format(array.value(row))),
                Cells::Texts(array) if array.is_valid(row) => writer.write_field(array.value(row)),
                Cells::Others(array, formatter) if array.is_valid(row) => writer.write_field(formatter.value(row).try_to_string()?),
                _ => writer.write_field(""),
            }
            .map_err(|error| ArrowError::CsvError(error.to_string()))?;
        }
        writer.write_record(None::<&[u8]>).map_err(|error| ArrowError::CsvError(error.to_string()))?;
    }
    writer.flush().map_err(|error| ArrowError::CsvError(error.to_string()))
}

/// Returns times of a named zone as the same instants in UTC: the names of zones and their rules are no part of this program.
fn in_utc(column: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    match column.data_type() {
        DataType::Timestamp(unit, Some(zone)) if !zone.starts_with(['+', '-']) => {
            let in_utc = DataType::Timestamp(*unit, Some("+00:00".into()));
            Ok(make_array(column.to_data().into_builder().data_type(in_utc).build()?))
        }
        _ => Ok(column.clone()),
    }
}

enum Cells<'a> {
    Numbers(&'a arrow_array::Float64Array),
    Texts(&'a arrow_array::StringArray),
    Others(&'a dyn Array, ArrayFormatter<'a>),
}

fn of_parquet(error: ParquetError) -> io::Error {
    io::Error::other(error)
}

/// Returns an error of Arrow as one of a file.
pub fn of_arrow(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        other => io::Error::other(other),
    }
}
