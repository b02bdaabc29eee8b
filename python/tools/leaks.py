#!/usr/bin/env python3
"""Call the package often, and print by how much memory grows: an answer, an error, arrays, an Arrow table and a stream in turn.

    python/tools/leaks.py 1000000
"""

from __future__ import annotations

import gc
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa

import planar_impact

CASE = planar_impact.template("barrier")
WRONG = {"schema": 1}
COLUMNS = {"vehicle.1.speed": np.linspace(10, 20, 100)}
TABLE = pa.table(COLUMNS)
CALLS = 100


def call() -> None:
    """Call the package CALLS times."""
    for _ in range(CALLS // 2):
        planar_impact.solve(CASE)
    for _ in range(CALLS // 2 - 3):
        try:
            planar_impact.solve(WRONG)
        except planar_impact.CaseError:
            pass
    planar_impact.solve_batch(COLUMNS, wrt="e", case=CASE, derivatives="array", threads=1)
    planar_impact.solve_batch(TABLE, case=CASE, threads=1)
    planar_impact.solve_batch(TABLE.to_reader(), case=CASE, threads=1).read_all()


def resident() -> float:
    """Return the memory of this process in MiB."""
    gc.collect()
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.partition("VmRSS:")[2].split()[0]) / 1024


def growth(calls: int) -> float:
    """Return the growth of memory in MiB from the first fifth of the calls to the last."""
    for _ in range(calls // CALLS // 5):
        call()
    before = resident()
    for _ in range(calls // CALLS * 4 // 5):
        call()
    return resident() - before


if __name__ == "__main__":
    calls = int(sys.argv[1])
    print(f"{calls} calls: memory grows by {growth(calls):.1f} MiB")
