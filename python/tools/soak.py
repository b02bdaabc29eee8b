#!/usr/bin/env python3
"""Call every verb in one process for some seconds, with the examples of the repository and with wrong input, and print memory as it goes.

    python/tools/soak.py 3600

Fails if memory grows by more than LIMIT from the first fifth of the time to the end.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import numpy as np
import pyarrow as pa
from leaks import COLUMNS, TABLE, WRONG, resident

import planar_impact as pi

EXAMPLES = Path(__file__).parents[2] / "cli/examples"
LIMIT = 16.0
TEMPLATES = [pi.template(kind) for kind in ("t-bone", "head-on", "rear-end", "barrier", "momentum", "rest")]
SOLVED, RECONSTRUCTED = pi.template("barrier"), sorted(EXAMPLES.glob("reconstruct/*.toml"))
CASES = cycle(RECONSTRUCTED)
OUTPUTS = ["T_L", "dV1", "mu0"]


def stopped() -> None:
    """Stop a long search by its own progress."""

    def stop(_done: int, _of: int) -> None:
        raise KeyboardInterrupt

    try:
        pi.reconstruct(RECONSTRUCTED[0], progress=stop)
    except KeyboardInterrupt:
        pass


def wrong() -> None:
    """Call every verb that takes a case with wrong ones."""
    for verb in (pi.solve, pi.gradient, pi.crush, pi.crash3, pi.reconstruct, pi.uncertainty, pi.slide, pi.draw, pi.report):
        for case in (WRONG, "[", "nothing.toml", {"schema": 1, "vehicle": [{"mass": float("nan")}]}):
            try:
                verb(case)
            except (pi.Error, OSError, TypeError):
                pass


def checked() -> None:
    """Check a file that is new each time, and one that is there."""
    with tempfile.TemporaryDirectory() as folder:
        records = Path(folder) / "records.json"
        records.write_text((EXAMPLES / "check/collision.json").read_text(encoding="utf-8"), encoding="utf-8")
        pi.check(records)
    pi.check(EXAMPLES / "check/engine.jsonl")


VERBS: dict[str, Callable[[], object]] = {
    "solve": lambda: [repr(pi.solve(case)) for case in sorted(EXAMPLES.glob("position-*.toml"))],
    "gradient": lambda: pi.gradient(SOLVED, of=OUTPUTS, second=True).to_json(),
    "sweep": lambda: pi.sweep(SOLVED, vary={"contact.restitution": (0, 0.5, 0.001)}, of=OUTPUTS).to_svg(),
    "crush": lambda: pi.crush(EXAMPLES / "cavalier-crush.toml").to_text(),
    "crash3": lambda: pi.crash3(EXAMPLES / "cavalier-crush.toml").to_text(),
    "reconstruct": lambda: pi.reconstruct(next(CASES), starts=4).to_text(),
    "reconstruct, profile": lambda: pi.reconstruct(RECONSTRUCTED[3], starts=4, profile=True).to_json(),
    "uncertainty": lambda: pi.uncertainty(EXAMPLES / "uncertain.toml", of=OUTPUTS, method=["linear", "monte-carlo", "sobol"], samples=2000).to_text(),
    "guaranteed range": lambda: pi.uncertainty(EXAMPLES / "uncertain.toml", of="mu0", method="bounds").to_text(),
    "stiffness": lambda: pi.stiffness(EXAMPLES / "tests/malibu.toml").to_text(),
    "slide": lambda: pi.slide(EXAMPLES / "slide.toml").to_text(),
    "record": lambda: pi.record(EXAMPLES / "record/barrier.toml").to_text(),
    "formula": lambda: pi.formula("T_L", wrt="e").to_text(),
    "check": checked,
    "draw": lambda: [pi.draw(case) for case in TEMPLATES[:1]],
    "report": lambda: pi.report(SOLVED, date="today"),
    "report of a reconstruction": lambda: pi.report(RECONSTRUCTED[0]),
    "posterior": lambda: pi.reconstruct(EXAMPLES / "reconstruct/momentum.toml", starts=4, posterior=True).to_text(),
    "batch of arrays": lambda: pi.solve_batch(COLUMNS, of=OUTPUTS, wrt="e", case=SOLVED, derivatives="array"),
    "batch of Arrow": lambda: pi.solve_batch(TABLE, case=SOLVED),
    "batch of a stream": lambda: pi.solve_batch(pa.table({"vehicle.1.speed": np.linspace(1, 30, 20_000)}).to_reader(), case=SOLVED).read_all(),
    "wrong input": wrong,
    "stopped": stopped,
}


def soak(seconds: float) -> float:
    """Return the growth of memory in MiB from the first fifth of the time to its end."""
    begin, told, rounds, settled = time.monotonic(), 0.0, 0, None
    while (elapsed := time.monotonic() - begin) < seconds:
        for verb in VERBS.values():
            verb()
        rounds += 1
        if settled is None and elapsed > seconds / 5:
            settled = resident()
        if elapsed - told >= 60:
            told = elapsed
            print(f"{elapsed / 60:4.0f} min  {rounds:6} rounds of {len(VERBS)} verbs  {resident():7.1f} MiB", flush=True)
    grown = resident() - (settled or 0.0)
    print(f"{rounds} rounds of {len(VERBS)} verbs in {seconds:.0f} s: memory grows by {grown:.1f} MiB after the first fifth, to {resident():.1f}")
    return grown


if __name__ == "__main__":
    sys.exit(soak(float(sys.argv[1])) > LIMIT)
