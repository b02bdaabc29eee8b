//! Tables that are read part by part.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use arrow_array::builder::StringBuilder;
use arrow_array::{ArrayRef, RecordBatch, RecordBatchOptions, RecordBatchReader};
use arrow_ipc::reader::{FileReader, StreamReader};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};
use planar_impact_app::batch::{NotARow, separated_otherwise};
use planar_impact_app::check::reason;
use planar_impact_app::{Issues, decode};

use super::format::Format;
use super::lengths;
use super::quotes::Followed;
use crate::defect;
use crate::files::Counted;

const BUFFER: usize = 1 << 18;

/// Rows that are solved together.
pub struct Part {
    /// The rows.
    pub batch: RecordBatch,
    /// Those that are no rows of the table, counted from 0.
    pub unreadable: Vec<(usize, NotARow)>,
}

impl Part {
    /// Returns those of some rows that are no rows of the table, counted from the first of them.
    pub fn unreadable_in(&self, rows: Range<usize>) -> Vec<(usize, NotARow)> {
        self.unreadable.iter().filter(|(row, _)| rows.contains(row)).map(|(row, why)| (row - rows.start, *why)).collect()
    }
}

/// A table that is read part by part.
pub struct Source {
    /// The name of its file.
    pub name: String,
    schema: SchemaRef,
    rows: Rows,
    bytes: u64,
    /// Whether no column has more than one dictionary.
    has_one_dictionary: bool,
}

enum Rows {
    /// A file that is opened again when rows are read from it.
    Closed(PathBuf),
    Csv {
        reader: Box<Texts>,
        bytes: Arc<AtomicU64>,
    },
    Parquet {
        reader: ParquetRecordBatchReader,
        all: u64,
        read: u64,
    },
    Arrow {
        reader: Box<dyn RecordBatchReader>,
        rest: Option<RecordBatch>,
        bytes: Arc<AtomicU64>,
    },
}

/// First bytes of a Parquet file.
const PARQUET: &[u8] = b"PAR1";

/// First bytes of an Arrow file: of those of all formats the most.
const ARROW: &[u8] = b"ARROW1";

/// First bytes of what is no table of the format that the name of its file says, and what it is.
const FOREIGN: &[(&[u8], &str)] = &[
    (PARQUET, "is Parquet; give it as a file whose name ends in .parquet"),
    (ARROW, "is Arrow; give it as a file whose name ends in .arrow"),
    (b"FEA1", "is Feather of version 1; write version 2"),
];

type Texts = csv::Reader<Followed<Box<dyn Read>>>;

impl Source {
    /// Opens a table, to be read a number of rows at a time.
    ///
    /// # Errors
    ///
    /// If it cannot be read, or has no header.
    pub fn open(path: &Path, rows: usize) -> Result<Source, Issues> {
        let format = Format::of(path)?;
        if path.as_os_str() == "-" {
            return Source::csv("<stdin>", Box::new(io::stdin()), Arc::default(), 0);
        }
        let name = path.display().to_string();
        let unreadable = |error: &io::Error| decode::unreadable(&name, &format!("cannot be read: {}", reason(error)));
        let file = File::open(path).map_err(|error| unreadable(&error))?;
        let metadata = file.metadata().map_err(|error| unreadable(&error))?;
        if metadata.is_dir() {
            return Err(decode::unreadable(&name, "is a directory, not a table"));
        }
        if metadata.is_file() {
            let begin = begin(&file).map_err(|error| unreadable(&error))?;
            let is_own = match format {
                Format::Csv => false,
                Format::Parquet => begin.starts_with(PARQUET),
                Format::Arrow => begin == ARROW,
            };
            // Arrow without a footer begins with a length.
            let is_length = format == Format::Arrow && matches!(begin[..], [_, _, 0, 0, ..] | [0xff, 0xff, 0xff, 0xff, ..]);
            if let Some(is) = foreign(&begin).filter(|_| !is_own && !is_length) {
                return Err(decode::unreadable(&name, is));
            }
            if format == Format::Parquet && !is_own {
                return Err(decode::unreadable(&name, "is not Parquet, as its name says; let the name of a table in text end in .csv"));
            }
        }
        let size = metadata.len();
        let bytes = Arc::default();
        match format {
            Format::Csv => Source::csv(&name, Box::new(Counted::new(file, &bytes)), bytes, size),
            Format::Parquet => {
                let (reader, all) = read(&name, || {
                    let builder = ParquetRecordBatchReaderBuilder::try_new(file)?;
                    let all = builder.metadata().file_metadata().num_rows().try_into().unwrap_or(0);
                    Ok((builder.with_batch_size(rows).build()?, all))
                })?;
                // Each part that is read may have its own.
                let has_one_dictionary = all <= rows as u64;
                Ok(Source { schema: reader.schema(), rows: Rows::Parquet { reader, all, read: 0 }, bytes: size, has_one_dictionary, name })
            }
            Format::Arrow => {
                let has_footer = begin(&file).map_err(|error| unreadable(&error))? == ARROW;
                let (reader, dictionaries) = read(&name, || {
                    let dictionaries = lengths::check(&file, has_footer)?;
                    let buffered = BufReader::with_capacity(BUFFER, Counted::new(file, &bytes));
                    let reader: Box<dyn RecordBatchReader> = if has_footer {
                        Box::new(FileReader::try_new(buffered, None)?)
                    } else {
                        Box::new(StreamReader::try_new(buffered, None)?)
                    };
                    Ok((reader, dictionaries))
                })?;
                let schema = reader.schema();
                let has_one_dictionary = dictionaries <= schema.fields().iter().filter(|field| is_dictionary(field)).count();
                Ok(Source { schema, rows: Rows::Arrow { reader, rest: None, bytes }, bytes: size, has_one_dictionary, name })
            }
        }
    }

    fn csv(name: &str, bytes_of: Box<dyn Read>, bytes: Arc<AtomicU64>, size: u64) -> Result<Source, Issues> {
        let mut reader = csv::ReaderBuilder::new().flexible(true).buffer_capacity(BUFFER).from_reader(Followed::new(bytes_of));
        let first = reader.byte_headers().ok().and_then(|headers| headers.get(0));
        if let Some(is) = first.and_then(foreign) {
            return Err(decode::unreadable(name, is));
        }
        let headers = reader.headers().map_err(|error| match error.kind() {
            csv::ErrorKind::Utf8 { .. } => decode::unreadable(name, "has a header that is not UTF-8 text; save it as UTF-8"),
            _ => not_a_table(name, &error),
        });
        let headers = headers?.clone();
        if headers.is_empty() {
            return Err(decode::unreadable(name, "is empty; the first line of a table names its columns"));
        }
        // Of names without a comma between them.
        if let Some(wrong) = headers.get(0).filter(|_| headers.len() == 1).and_then(separated_otherwise) {
            return Err(decode::unreadable(name, &format!("cannot be read as a table: {}", wrong.join("; "))));
        }
        let text = |header: &str| Field::new(header.trim_start_matches('\u{feff}'), DataType::Utf8, true);
        let schema = Schema::new(headers.iter().map(text).collect::<Vec<_>>());
        let rows = Rows::Csv { reader: Box::new(reader), bytes };
        Ok(Source { name: name.to_owned(), schema: Arc::new(schema), rows, bytes: size, has_one_dictionary: true })
    }

    /// Returns the columns.
    pub fn schema(&self) -> &SchemaRef {
        &self.schema
    }

    /// Returns `true` if no column has more than one dictionary.
    pub fn has_one_dictionary(&self) -> bool {
        self.has_one_dictionary
    }

    /// Returns the size of the file in bytes, 0 if it is not known.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns how much of the file has been read, in bytes.
    pub fn position(&self) -> u64 {
        match &self.rows {
            Rows::Closed(_) => 0,
            Rows::Csv { bytes, .. } | Rows::Arrow { bytes, .. } => bytes.load(Ordering::Relaxed).min(self.bytes),
            Rows::Parquet { all, read, .. } => (self.bytes as f64 * (*read as f64 / (*all).max(1) as f64)) as u64,
        }
    }

    /// Closes a table, so that many do not exceed the files that a process may have open. One that is no regular file cannot be opened again, and stays open.
    pub fn close(&mut self, path: &Path) {
        if path.is_file() {
            self.rows = Rows::Closed(path.to_owned());
        }
    }

    /// Reads the next rows, at most a number of them; `None` at the end.
    ///
    /// # Errors
    ///
    /// If the file cannot be read any further.
    pub fn next(&mut self, rows: usize) -> Result<Option<Part>, Issues> {
        if let Rows::Closed(path) = &self.rows {
            let again = Source::open(path, rows)?;
            if again.schema != self.schema {
                return Err(decode::unreadable(&self.name, "has changed while other tables were read"));
            }
            *self = again;
        }
        let name = &self.name;
        let whole = |batch: RecordBatch| Part { batch, unreadable: Vec::new() };
        match &mut self.rows {
            Rows::Closed(_) => Ok(None),
            Rows::Csv { reader, .. } => texts(reader, &self.schema, rows).map_err(|error| not_a_table(name, &error)),
            Rows::Parquet { reader, read, .. } => {
                let batch = self::read(name, || Ok(reader.next().transpose()?))?;
                *read += batch.as_ref().map_or(0, |batch| batch.num_rows() as u64);
                Ok(batch.map(whole))
            }
            Rows::Arrow { reader, rest, .. } => {
                let batch = match rest.take() {
                    Some(rest) => Some(rest),
                    None => read(name, || Ok(reader.next().transpose()?))?,
                };
                let Some(batch) = batch else { return Ok(None) };
                let taken = batch.num_rows().min(rows);
                *rest = (taken < batch.num_rows()).then(|| batch.slice(taken, batch.num_rows() - taken));
                Ok(Some(whole(batch.slice(0, taken))))
            }
        }
    }
}

/// Reads rows as text, an empty cell where a row has too few. `None` without a row. Wrong quotes are an error: a cell that never ends has the rows after it.
fn texts(reader: &mut Texts, schema: &SchemaRef, rows: usize) -> Result<Option<Part>, Box<dyn std::error::Error>> {
    let columns = schema.fields().len();
    let mut builders: Vec<StringBuilder> = (0..columns).map(|_| StringBuilder::with_capacity(rows, 8 * rows)).collect();
    let (mut record, mut read, mut unreadable) = (csv::ByteRecord::new(), 0, Vec::new());
    while read < rows && reader.read_byte_record(&mut record)? {
        let mut why = (record.len() != columns).then_some(NotARow::Ragged { cells: record.len(), columns });
        for (i, builder) in builders.iter_mut().enumerate() {
            let cell = record.get(i).unwrap_or_default();
            match std::str::from_utf8(cell) {
                Ok(cell) => builder.append_value(cell),
                Err(_) => {
                    why.get_or_insert(NotARow::NotText);
                    builder.append_value(String::from_utf8_lossy(cell));
                }
            }
        }
        unreadable.extend(why.map(|why| (read, why)));
        read += 1;
    }
    if let Some(fault) = reader.get_ref().fault(read < rows) {
        return Err(fault.to_string().into());
    }
    if read == 0 {
        return Ok(None);
    }
    let arrays: Vec<ArrayRef> = builders.iter_mut().map(|builder| Arc::new(builder.finish()) as ArrayRef).collect();
    let options = RecordBatchOptions::new().with_row_count(Some(read));
    let batch = RecordBatch::try_new_with_options(schema.clone(), arrays, &options)?;
    Ok(Some(Part { batch, unreadable }))
}

fn is_dictionary(field: &Field) -> bool {
    matches!(field.data_type(), DataType::Dictionary(..))
}

/// Returns the first bytes of a file, as many as tell what it is.
fn begin(mut file: &File) -> io::Result<Vec<u8>> {
    let mut begin = Vec::new();
    file.take(ARROW.len() as u64).read_to_end(&mut begin)?;
    file.seek(SeekFrom::Start(0))?;
    Ok(begin)
}

/// Returns what a table of another format is, with a remedy.
fn foreign(begin: &[u8]) -> Option<&'static str> {
    FOREIGN.iter().find(|(magic, _)| begin.starts_with(magic)).map(|(_, is)| *is).or_else(|| decode::not_a_text(begin))
}

/// Reads of a format that its library reads, which panics on some damaged files.
fn read<T>(name: &str, read: impl FnOnce() -> Result<T, Box<dyn std::error::Error>>) -> Result<T, Issues> {
    let read = defect::reading(read).unwrap_or_else(|damage| Err(damage.into()));
    read.map_err(|error| not_a_table(name, &error))
}

fn not_a_table(name: &str, error: &(impl std::fmt::Display + ?Sized)) -> Issues {
    let error = error.to_string();
    // The reader of Parquet names a compression that it is built without.
    match error.split_once("Disabled feature at compile time: ") {
        Some((_, compression)) => decode::unreadable(
            name,
            &format!("is compressed with {compression}; write it with snappy, gzip, lz4, zstd or without compression"),
        ),
        None => decode::unreadable(name, &format!("cannot be read as a table: {error}")),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;
    use std::path::PathBuf;

    use arrow_array::{DictionaryArray, Float64Array, StringArray, types::Int32Type};
    use arrow_ipc::CompressionType;
    use arrow_ipc::writer::{FileWriter, IpcWriteOptions, StreamWriter};
    use parquet::arrow::ArrowWriter;

    use super::*;

    /// A table in a format, with text, a dictionary and absent numbers.
    fn table(format: &str) -> Vec<u8> {
        let speeds: Float64Array = [Some(40.0), None, Some(60.0)].into_iter().collect();
        let kinds: DictionaryArray<Int32Type> = ["x", "y", "x"].into_iter().collect();
        let columns: [(&str, ArrayRef); 3] =
            [("vehicle.1.speed", Arc::new(speeds)), ("name", Arc::new(StringArray::from(vec!["a", "b", "c"]))), ("kind", Arc::new(kinds))];
        let batch = RecordBatch::try_from_iter(columns).expect("a table");
        let compressed = || IpcWriteOptions::default().try_with_compression(Some(CompressionType::LZ4_FRAME)).expect("a compression");
        let options = if format.ends_with("compressed") { compressed() } else { IpcWriteOptions::default() };
        let mut bytes = Vec::new();
        match format.split(' ').next().expect("a format") {
            "parquet" => {
                let mut writer = ArrowWriter::try_new(&mut bytes, batch.schema(), None).expect("a writer");
                writer.write(&batch).and_then(|()| writer.close()).map(drop).expect("a table");
            }
            "file" => {
                let mut writer = FileWriter::try_new_with_options(&mut bytes, &batch.schema(), options).expect("a writer");
                writer.write(&batch).and_then(|()| writer.finish()).expect("a table");
            }
            _ => {
                let mut writer = StreamWriter::try_new_with_options(&mut bytes, &batch.schema(), options).expect("a writer");
                writer.write(&batch).and_then(|()| writer.finish()).expect("a table");
            }
        }
        bytes
    }

    /// Reads a whole table.
    fn rows(path: &Path) -> Result<usize, Issues> {
        let mut source = Source::open(path, 2)?;
        let mut rows = 0;
        while let Some(part) = source.next(2)? {
            rows += part.batch.num_rows();
        }
        Ok(rows)
    }

    fn file(name: &str, ends: &str) -> PathBuf {
        std::env::temp_dir().join(format!("planar-impact-{}-{name}.{ends}", std::process::id()))
    }

    /// A byte, a length of 4 bytes or one of 8 at every place of a table is another number: that is an error, never a panic or an allocation of what it states.
    #[test]
    fn damaged_tables_are_refused() {
        crate::defect::install();
        for (format, ends) in
            [("parquet", "parquet"), ("file", "arrow"), ("stream", "arrow"), ("file compressed", "arrow"), ("stream compressed", "arrow")]
        {
            let (sound, path) = (table(format), file(&format.replace(' ', "-"), ends));
            std::fs::write(&path, &sound).expect("a file");
            assert_eq!(rows(&path).expect("a table"), 3, "{format}");
            // Rewritten in place: a file system may wait for the disk whenever a file is replaced.
            let mut damaged = std::fs::OpenOptions::new().write(true).open(&path).expect("the file is there");
            let mut refused = 0;
            let mut try_with = |bytes: &[u8]| {
                damaged
                    .rewind()
                    .and_then(|()| damaged.write_all(bytes))
                    .and_then(|()| damaged.set_len(bytes.len() as u64))
                    .expect("a file");
                refused += usize::from(rows(&path).is_err());
            };
            for at in 0..sound.len() {
                for damage in [&[0xff][..], &[0], &[0xff, 0xff, 0xff, 0x7f], &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]] {
                    let mut bytes = sound.clone();
                    let end = bytes.len().min(at + damage.len());
                    bytes[at..end].copy_from_slice(&damage[..end - at]);
                    try_with(&bytes);
                }
                try_with(&sound[..at]);
            }
            std::fs::remove_file(&path).expect("the file is there");
            assert!(refused > sound.len(), "{format}: {refused} of {}", 5 * sound.len());
        }
    }

    /// Four letters are the length of a stream's first message.
    #[test]
    fn a_text_is_no_stream() {
        let path = file("text", "arrow");
        std::fs::write(&path, "text").expect("a file");
        let refused = rows(&path).expect_err("a refusal").to_string();
        std::fs::remove_file(&path).expect("the file is there");
        assert!(refused.contains("it states 1954047348 bytes at byte 4, and has 4"), "{refused}");
    }
}
