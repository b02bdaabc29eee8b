#!/usr/bin/env python3
"""Compare `planar-impact batch` with vectorised Python on one file of Parquet.

    cargo build --release -p planar-impact-cli
    pip install -r benches/peers/requirements.txt
    benches/peers/batch.py 10000000

Two peers compute the same outputs, at the critical impulse ratio, from one definition of the mechanics, a row group at a time: NumPy and Polars. Neither
checks a row, nor waits until the file is on the disk. The answers are compared column by column, and the table that the program writes is read back by pyarrow
and by DuckDB. With TMPDIR=/dev/shm no disk takes part.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import duckdb
import numpy as np
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq

from mechanics import difference, mechanics

PROGRAM = Path(__file__).parents[2] / "target/release/planar-impact"
GROUP, TURNS = 1 << 16, 4


def generate(path, rows):
    rng = np.random.default_rng(1)
    writer = None
    for start in range(0, rows, 1 << 20):
        n = min(1 << 20, rows - start)
        table = {}
        for i in (1, 2):
            v = f"vehicle.{i}."
            table[v + "mass"] = rng.uniform(900, 2500, n)
            table[v + "yaw_inertia"] = rng.uniform(1200, 4500, n)
            table[v + "heading"] = rng.uniform(-0.5, 0.5, n) + (np.pi if i == 2 else 0)
            table[v + "speed"] = rng.uniform(2, 30, n)
            table[v + "yaw_rate"] = rng.normal(0, 0.3, n)
            table[v + "impact_center.forward"] = rng.uniform(1.2, 2.5, n)
            table[v + "impact_center.left"] = rng.uniform(-0.8, 0.8, n)
        table["contact.crush_plane"] = rng.normal(0, 0.2, n)
        table["contact.restitution"] = rng.uniform(0, 0.3, n)
        table = pa.table(table)
        writer = writer or pq.ParquetWriter(path, table.schema)
        writer.write_table(table)
    writer.close()


def with_program(source, target, *more):
    before = time.perf_counter()
    subprocess.run([PROGRAM, "batch", source, "-o", target, *more], stderr=subprocess.DEVNULL, check=True)
    return time.perf_counter() - before


def memory(source, target):
    """Return the most memory that the program had, in MiB, as the system tells it while it runs."""
    most, run = 0, subprocess.Popen([PROGRAM, "batch", source, "-o", target], stderr=subprocess.DEVNULL)
    while run.poll() is None:
        status = Path(f"/proc/{run.pid}/status").read_text()
        most = max([most, *(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM"))])
        time.sleep(0.005)
    return most / 1024


def with_numpy(source, target):
    before = time.perf_counter()
    writer = None
    for batch in pq.ParquetFile(source).iter_batches(GROUP):
        columns = {name: batch.column(name).to_numpy() for name in batch.schema.names}
        columns |= mechanics(columns.__getitem__, np.sin, np.cos, np.sqrt, np.arctan2)
        table = pa.table(columns)
        writer = writer or pq.ParquetWriter(target, table.schema, use_dictionary=False)
        writer.write_table(table)
    writer.close()
    return time.perf_counter() - before


def with_polars(source, target):
    before = time.perf_counter()
    writer = None
    arctan2 = lambda y, x: pl.DataFrame({"y": y, "x": x}).select(pl.arctan2("y", "x")).to_series()
    for batch in pq.ParquetFile(source).iter_batches(GROUP):
        frame = pl.from_arrow(batch)
        outputs = mechanics(frame.get_column, lambda x: x.sin(), lambda x: x.cos(), lambda x: x.sqrt(), arctan2)
        table = frame.with_columns(**outputs).to_arrow()
        writer = writer or pq.ParquetWriter(target, table.schema, use_dictionary=False)
        writer.write_table(table)
    writer.close()
    return time.perf_counter() - before


def main():
    rows = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        source, ours, one, numpys, polars = (os.path.join(folder, f"{name}.parquet") for name in ("in", "ours", "one", "numpy", "polars"))
        generate(source, rows)
        calls = {
            "planar-impact": lambda: with_program(source, ours),
            "planar-impact, one thread": lambda: with_program(source, ours, "--threads", "1"),
            "planar-impact, W_n alone": lambda: with_program(source, one, "--of", "W_n"),
            "NumPy": lambda: with_numpy(source, numpys),
            "Polars": lambda: with_polars(source, polars),
        }
        # In turns, so that whatever else the machine does falls on everyone; the least of each, once every file has its place in memory.
        turns = [{name: call() for name, call in calls.items()} for _ in range(TURNS)]
        seconds = {name: min(turn[name] for turn in turns[1:]) for name in calls}
        worst = compare(ours, numpys)
        print(f"{rows} rows of {pq.read_schema(source).names.__len__()} inputs, {pq.read_schema(ours).names.__len__()} columns written")
        for name, taken in seconds.items():
            print(f"{name:28} {taken:7.2f} s  {1e9 * taken / rows:7.0f} ns a row  {taken / seconds['planar-impact']:5.2f} x")
        print(f"memory of planar-impact: {memory(source, one):.0f} MiB")
        print(f"largest difference between ours and NumPy: {worst:.1e} of the natural scale")
        answer = duckdb.sql(f"""select count(*), count("energy.loss"), avg("vehicle.1.delta_v_magnitude"), min(refusal) from '{ours}'""").fetchall()
        print(f"DuckDB reads: rows, solved, mean delta-V, first refusal: {answer[0]}")


def compare(ours, theirs):
    """Return the largest difference, each output relative to the largest of its kind in its row."""
    ours, theirs = pq.ParquetFile(ours), pq.ParquetFile(theirs)
    worst = 0.0
    for one, other in zip(ours.iter_batches(GROUP), theirs.iter_batches(GROUP)):
        solved = one.column("refusal").is_null().to_numpy(zero_copy_only=False)
        assert solved.mean() > 0.99
        of = lambda table: lambda name: table.column(name).to_numpy(zero_copy_only=False)[solved]
        worst = max([worst, *(float(np.max(difference(name, of(one)(name), of(other), np.sqrt))) for name in other.schema.names)])
    return worst


if __name__ == "__main__":
    main()
