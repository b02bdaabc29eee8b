#!/usr/bin/env python3
"""Time the package beside its alternatives in one run: `solve` of a dict beside pycrash, and `solve_batch` beside Rust and NumPy.

    pip install ./python pycrash
    cargo build --release --manifest-path python/Cargo.toml --example rows
    python/benches/speed.py [ROWS]

Every figure is the shortest of several runs that take turns, so that a busy machine disturbs all of them alike.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import planar_impact

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benches/peers"), str(ROOT / "python/docs/programs")]
TURNS = 9


def shortest(calls: dict[str, Callable[[], object]], repeat: int = 1) -> dict[str, float]:
    """Return the shortest time of each call in seconds."""
    times = dict.fromkeys(calls, float("inf"))
    for _ in range(TURNS):
        for name, call in calls.items():
            started = time.perf_counter()
            for _ in range(repeat):
                call()
            times[name] = min(times[name], (time.perf_counter() - started) / repeat)
    return times


def columns(rows: int) -> dict[str, Any]:
    """Return two vehicles that close, all columns of float64."""
    random = np.random.default_rng(1)
    table: dict[str, Any] = {}
    for i in (1, 2):
        vehicle = f"vehicle.{i}"
        table[f"{vehicle}.mass"] = random.uniform(900, 2500, rows)
        table[f"{vehicle}.yaw_inertia"] = random.uniform(1200, 4500, rows)
        table[f"{vehicle}.heading"] = random.uniform(-0.5, 0.5, rows) + (np.pi if i == 2 else 0)
        table[f"{vehicle}.speed"] = random.uniform(2, 30, rows)
        table[f"{vehicle}.yaw_rate"] = random.normal(0, 0.3, rows)
        table[f"{vehicle}.impact_center.forward"] = random.uniform(1.2, 2.5, rows)
        table[f"{vehicle}.impact_center.left"] = random.uniform(-0.8, 0.8, rows)
    table["contact.crush_plane"] = random.normal(0, 0.2, rows)
    table["contact.restitution"] = random.uniform(0, 0.3, rows)
    return table


def one_case() -> None:
    table = columns(1)
    vehicle = lambda i, *keys: {key: float(table[f"vehicle.{i}.{key}"][0]) for key in keys}
    keys = ("mass", "yaw_inertia", "heading", "speed", "yaw_rate")
    vehicles = [{**vehicle(i, *keys), "impact_center": list(vehicle(i, "impact_center.forward", "impact_center.left").values())} for i in (1, 2)]
    contact = {key: float(table[f"contact.{key}"][0]) for key in ("crush_plane", "restitution")}
    case = {"schema": 1, "vehicle": vehicles, "contact": contact}
    text = json.dumps(case)
    many = columns(1 << 14)
    calls: dict[str, Callable[[], object]] = {
        "solve of a dict": lambda: planar_impact.solve(case),
        "solve of a dict, and one number of the answer": lambda: planar_impact.solve(case).energy.loss,
        "solve of a JSON text": lambda: planar_impact.solve(text),
    }
    with contextlib.suppress(ImportError), contextlib.redirect_stdout(io.StringIO()):
        import pycrash_program

        calls["pycrash, one collision, nothing printed"] = pycrash_program.with_pycrash
    times = shortest(calls, 300)
    mechanics = shortest({"": lambda: planar_impact.solve_batch(many, threads=1)})[""] / (1 << 14)
    print(f"mechanics of one row, all outputs               {1e6 * mechanics:8.2f} µs")
    for name, taken in times.items():
        print(f"{name:47} {1e6 * taken:8.2f} µs, {1e6 * (taken - mechanics):.1f} µs beyond the mechanics")


def batch(rows: int) -> None:
    from mechanics import mechanics

    table = columns(rows)
    threads = len(os.sched_getaffinity(0))
    numbers = b"".join(column.tobytes() for column in table.values())
    program = Path(os.environ.get("ROWS_PROGRAM", ROOT / "python/target/release/examples/rows"))
    in_rust = float("inf")
    ours = {"solve_batch": lambda: planar_impact.solve_batch(table), "one thread": lambda: planar_impact.solve_batch(table, threads=1)}
    numpy = {"NumPy": lambda: mechanics(table.__getitem__, np.sin, np.cos, np.sqrt, np.arctan2)}
    times: dict[str, float] = {}
    for _ in range(3):
        if program.exists():
            command = [program, str(threads), "5", *table]
            in_rust = min(in_rust, float(subprocess.run(command, input=numbers, capture_output=True, check=True).stdout))
        for name, taken in shortest({**ours, **numpy}).items():
            times[name] = min(times.get(name, float("inf")), taken)
    best = times["solve_batch"]
    print(f"{rows} rows of {len(table)} columns, all outputs, {threads} threads: {1e9 * best / rows:.0f} ns a row")
    print(f"  of the speed of Rust alone      {in_rust / best:6.2f}")
    print(f"  as fast as NumPy                {times['NumPy'] / best:6.1f} x; on one thread {times['NumPy'] / times['one thread']:.1f} x")


if __name__ == "__main__":
    one_case()
    batch(int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000)
