#!/usr/bin/env python3
"""Kill one of two workers in the middle of a job, and compare the answer with that of one process, bit by bit.

    kill_worker.py spark 10000000
    kill_worker.py ray 10000000
"""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from importlib import metadata
from pathlib import Path

import crashes
import pyarrow as pa
import ray_program
import spark_program

import planar_impact

#: Answers that are written before a worker is killed: the job is in its middle.
BEFORE = 10


def parent(process: int) -> int:
    """Return the process that started a process."""
    return int(Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[1])


def marking(folder: str, of_worker: Callable[[int], int]) -> None:
    """Write down who has solved a batch."""
    with open(os.path.join(folder, f"{of_worker(os.getpid())}"), "a", encoding="ascii") as file:
        file.write("x")


def spark(source: str, target: str, marks: str) -> None:
    def impacts(batches: Iterator[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        for batch in spark_program.impacts(batches):
            # The program in Python is a grandchild of its executor, in Java.
            marking(marks, lambda process: parent(parent(process)))
            yield batch

    session = spark_program.session("local-cluster[2,1,1024]")
    session.sparkContext.addPyFile(spark_program.__file__)
    session.conf.set("spark.sql.files.maxPartitionBytes", str(8 << 20))
    session.conf.set("spark.sql.execution.arrow.maxRecordsPerBatch", "50000")
    spark_program.read(session, source).mapInArrow(impacts, spark_program.SCHEMA).write.parquet(target)
    session.stop()


def ray(source: str, target: str, marks: str) -> None:
    import ray

    def impacts(batch: pa.Table) -> pa.Table:
        answer = ray_program.impacts(batch)
        marking(marks, lambda process: process)
        return answer

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    # Small blocks, so that both workers have some when one of them is killed.
    ray.data.DataContext.get_current().target_max_block_size = 4 << 20
    crashes = ray.data.read_parquet(source, override_num_blocks=100)
    crashes.map_batches(impacts, batch_format="pyarrow", batch_size=50_000).write_parquet(target)
    ray.shutdown()


def killer(marks: Path, killed: list[int]) -> None:
    """Kill the worker that has done most, as soon as the job is in its middle."""
    while True:
        done = {int(mark.name): mark.stat().st_size for mark in marks.iterdir()}
        if sum(done.values()) >= BEFORE:
            worker = max(done, key=lambda process: done[process])
            os.kill(worker, signal.SIGKILL)
            killed.append(worker)
            return
        time.sleep(0.02)


def main(engine: str, rows: int) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "marks").mkdir()
        source, target = folder / "crashes", folder / "solved"
        crashes.main(rows, f"{source}/")
        killed: list[int] = []
        thread = threading.Thread(target=killer, args=(folder / "marks", killed), daemon=True)
        thread.start()
        started = time.monotonic()
        {"spark": spark, "ray": ray}[engine](str(source), str(target), str(folder / "marks"))
        took = time.monotonic() - started
        thread.join(timeout=1)
        assert killed, "the job ended before a worker was killed"
        batches = {mark.name: mark.stat().st_size for mark in (folder / "marks").iterdir()}
        version = metadata.version({"spark": "pyspark", "ray": "ray"}[engine])
        print(f"{engine} {version}, planar-impact {planar_impact.__version__}, {rows} rows from Parquet to Parquet in {took:.0f} s")
        print(f"batches solved by each worker: {dict(sorted(batches.items(), key=lambda item: -item[1]))}")
        print(f"worker {killed[0]} was killed after {BEFORE} batches; those after it are of the others and of its successors")
        print(f"complete, and the same bits as one process: {crashes.same_bits(source, target)} rows", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
