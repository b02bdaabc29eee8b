//! Benchmarks `planar-impact batch` from file to file: rows in a second, by format and number of threads.
//!
//! `one` reads the table, and writes it with W_n; `all` adds every output.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_ipc::writer::FileWriter;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use parquet::arrow::ArrowWriter;

const ROWS: usize = 1 << 18;

/// Runs the program, which must solve every row.
fn batch(source: &Path, target: &Path, more: &[&str]) {
    let mut call = Command::new(env!("CARGO_BIN_EXE_planar-impact"));
    call.arg("batch").arg(source).arg("-o").arg(target).args(more).stdout(Stdio::null());
    let run = call.output().expect("the program runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}

/// Returns a table of two vehicles in distinct states.
fn table() -> RecordBatch {
    // The multiples of an irrational number have the digits of measurements: nothing repeats.
    let mut share = (1..).map(|i| (f64::from(i) * 0.618_033_988_749_894_9).fract());
    let mut column = |low: f64, high: f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(share.by_ref().take(ROWS).map(|share| low + (high - low) * share)))
    };
    let mut columns = Vec::new();
    for (side, heading) in [(1, 0.0), (2, std::f64::consts::PI)] {
        let limits = [
            ("mass", 900.0, 2500.0),
            ("yaw_inertia", 1200.0, 4500.0),
            ("heading", heading - 0.5, heading + 0.5),
            ("speed", 5.0, 30.0),
            ("yaw_rate", -0.3, 0.3),
            ("impact_center.forward", 1.2, 2.5),
            ("impact_center.left", -0.8, 0.8),
        ];
        columns.extend(limits.map(|(key, low, high)| (format!("vehicle.{side}.{key}"), column(low, high))));
    }
    columns.push(("contact.crush_plane".to_owned(), column(-0.2, 0.2)));
    columns.push(("contact.restitution".to_owned(), column(0.0, 0.3)));
    RecordBatch::try_from_iter(columns).expect("columns of one length")
}

/// Writes a table in each format.
fn write(table: &RecordBatch, path: impl Fn(&str) -> PathBuf) -> Result<(), Box<dyn std::error::Error>> {
    let schema = table.schema();
    let mut csv = csv::Writer::from_path(path("in.csv"))?;
    csv.write_record(schema.fields().iter().map(|field| field.name()))?;
    for row in 0..ROWS {
        csv.write_record(table.columns().iter().map(|column| column.as_primitive::<Float64Type>().value(row).to_string()))?;
    }
    csv.flush()?;
    let mut parquet = ArrowWriter::try_new(File::create(path("in.parquet"))?, schema.clone(), None)?;
    parquet.write(table)?;
    parquet.close()?;
    let mut arrow = FileWriter::try_new(File::create(path("in.arrow"))?, &schema)?;
    arrow.write(table)?;
    Ok(arrow.finish()?)
}

fn tables(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    write(&table(), path).expect("tables");
    let mut group = c.benchmark_group("tables");
    group.sample_size(10).throughput(Throughput::Elements(ROWS as u64));
    for format in ["csv", "parquet", "arrow"] {
        let (source, target) = (path(&format!("in.{format}")), path(&format!("out.{format}")));
        for (question, of) in [("one", &["--of", "W_n"][..]), ("all", &[])] {
            for threads in ["1", "2"] {
                let more = [of, &["--threads", threads]].concat();
                group.bench_function(BenchmarkId::new(format!("{format}, {question}"), format!("{threads} threads")), |b| {
                    b.iter(|| batch(&source, &target, &more))
                });
            }
        }
    }
    group.finish();
}

criterion_group!(benches, tables);
criterion_main!(benches);
