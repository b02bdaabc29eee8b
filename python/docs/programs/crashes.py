#!/usr/bin/env python3
"""Write a table of crashes for the programs beside this file, and compare their answers.

    crashes.py 10000000 crashes.parquet
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from pyarrow import dataset

import planar_impact

CASE = planar_impact.template("t-bone")
OUTPUTS = ["vehicle.1.delta_v_magnitude", "energy.loss"]
#: Rows of a row group; an engine reads each by itself.
GROUP = 100_000


def main(rows: int, path: str) -> None:
    """Write two vehicles that mostly approach each other: some rows are refused. A path that ends in `/` is a folder of parts."""
    random = np.random.default_rng(1)
    if path.endswith("/"):
        Path(path).mkdir()
    writer = None
    for first in range(0, rows, GROUP):
        count = min(GROUP, rows - first)
        table = pa.table(
            {
                "crash": np.arange(first, first + count),
                "vehicle.1.speed [km/h]": random.uniform(-5, 90, count),
                "vehicle.2.speed [km/h]": random.uniform(0, 60, count),
                "vehicle.1.mass": random.uniform(900, 2500, count),
                "contact.restitution": random.uniform(0, 0.3, count),
            }
        )
        if path.endswith("/"):
            pq.write_table(table, f"{path}part-{first // GROUP:05}.parquet")
            continue
        writer = writer or pq.ParquetWriter(path, table.schema)
        writer.write_table(table)
    if writer:
        writer.close()


def same_bits(source: Path, target: Path) -> int:
    """Compare the answers of an engine, a file or a folder of them, with those of this process; return the number of rows."""
    whole = dataset.dataset(source)
    rows = whole.count_rows()
    expected = {name: np.empty(rows) for name in OUTPUTS}
    refused = np.empty(rows, dtype=object)
    for batch in planar_impact.solve_batch(whole.scanner().to_reader(), of=OUTPUTS, case=CASE):
        at = batch["crash"].to_numpy()
        for name in OUTPUTS:
            expected[name][at] = batch[name].to_numpy(zero_copy_only=False)
        refused[at] = batch["refusal"].to_numpy(zero_copy_only=False)
    assert 0 < sum(code is not None for code in refused) < rows / 2
    seen = np.zeros(rows, dtype=np.int64)
    for part in sorted(target.glob("**/*.parquet")) if target.is_dir() else [target]:
        table = pq.ParquetFile(part).read()
        at = table["crash"].to_numpy()
        np.add.at(seen, at, 1)
        for name in OUTPUTS:
            is_solved = np.array([code is None for code in refused[at]])
            assert (table[name].is_valid().to_numpy() == is_solved).all(), name
            found, wanted = table[name].to_numpy()[is_solved], expected[name][at][is_solved]
            assert (found.view(np.int64) == wanted.view(np.int64)).all(), name
        # A library may write no text as null or as NaN.
        assert all(one == other or one != one for one, other in zip(table["refusal"].to_pylist(), refused[at])), "refusal"
    assert (seen == 1).all(), f"{(seen == 0).sum()} rows are missing, {(seen > 1).sum()} are repeated"
    return rows


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
