#!/usr/bin/env python3
"""Compare `planar-impact batch` with the same mechanics in 40 digits, on rows of every kind of impulse ratio, a tenth of them bad.

    cargo build --release -p planar-impact-cli
    pip install -r benches/peers/requirements.txt
    benches/peers/digits.py 10000 [SEED]

Fails if an output is 1e-12 of its natural scale off, if a bad row is solved or carries a number, or if a good one is refused.
"""

import csv
import os
import random
import subprocess
import sys
import tempfile
from math import cos, sin
from pathlib import Path

import mpmath
from mpmath import mp, mpf

from mechanics import difference, mechanics

PROGRAM = Path(__file__).parents[2] / "target/release/planar-impact"
RATIO, FRACTION, FRICTION = "contact.impulse_ratio", "contact.impulse_ratio.of_critical", "contact.friction"
RATIOS = {
    RATIO: lambda given, critical: given,
    FRACTION: lambda given, critical: given * critical,
    FRICTION: lambda given, critical: mpmath.sign(critical) * min(given, abs(critical)),
}
BAD = {"vehicle.1.mass": "0", "vehicle.2.mass": "-1500", "vehicle.1.yaw_inertia": "NaN", "vehicle.2.yaw_inertia": "-1e-3", "vehicle.2.heading": "inf", "vehicle.1.yaw_rate": "-inf",
       "vehicle.1.impact_center.left": "", "contact.restitution": "1.5", "vehicle.1.impact_center.forward": "1e999", "contact.crush_plane": "pi", "vehicle.2.speed": "fast"}


def outputs(row):
    """Return the outputs of a row in 40 digits."""
    given = next((key for key in RATIOS if row[key]), None)
    ratio = given and (lambda critical: RATIOS[given](mpf(float(row[given])), critical))
    return mechanics(lambda name: mpf(float(row[name])), mpmath.sin, mpmath.cos, mpmath.sqrt, mpmath.atan2, ratio)


def ahead(row):
    """Return how far the center of mass of vehicle 2 is from that of vehicle 1 along n."""
    along = [row[f"vehicle.{i}.heading"] - row["contact.crush_plane"] for i in (1, 2)]
    n1, n2 = (row[f"vehicle.{i}.impact_center.forward"] * cos(angle) - row[f"vehicle.{i}.impact_center.left"] * sin(angle) for i, angle in zip((1, 2), along))
    return n1 - n2


def draw(rng):
    """Return a row that physics accepts: the vehicles approach each other, and μ is at most the critical ratio."""
    while True:
        row = dict.fromkeys(RATIOS, "")
        for i in (1, 2):
            v = f"vehicle.{i}."
            row |= {v + "mass": rng.uniform(800, 20e3), v + "yaw_inertia": rng.uniform(500, 60e3), v + "heading": rng.uniform(-3.2, 3.2)}
            row |= {v + "speed": rng.uniform(0, 35), v + "yaw_rate": rng.gauss(0, 1)}
            row |= {v + "impact_center.forward": rng.uniform(-3, 3), v + "impact_center.left": rng.uniform(-1.2, 1.2)}
        row |= {"contact.crush_plane": rng.uniform(-7, 7), "contact.restitution": rng.uniform(0, 0.6)}
        out = outputs(row)
        # Far from every edge: what is refused there is another test's.
        approach, impulse = out["contact.approach.normal"], out["contact.impulse.normal"]
        if approach * ahead(row) > -1 or approach * impulse < 1 or out["energy.loss"] < 0.01 * out["energy.before"]:
            continue
        critical = float(out["contact.critical_impulse_ratio"])
        kind = rng.choice([None, *RATIOS])
        if kind:
            row[kind] = {RATIO: critical * rng.uniform(0.02, 0.98), FRACTION: rng.uniform(0.02, 0.98), FRICTION: abs(critical) * rng.uniform(0.1, 2)}[kind]
        return row


def main():
    rows, seed = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1000, int(sys.argv[2]) if len(sys.argv) > 2 else 1
    mp.dps, rng = 40, random.Random(seed)
    table = [draw(rng) for _ in range(rows)]
    bad = {row: rng.choice(list(BAD)) for row in rng.sample(range(rows), rows // 10)}
    written = [{**row, bad[i]: BAD[bad[i]]} if i in bad else row for i, row in enumerate(table)]
    with tempfile.TemporaryDirectory() as folder:
        source, target = os.path.join(folder, "in.csv"), os.path.join(folder, "out.csv")
        with open(source, "w", newline="") as file:
            lines = csv.DictWriter(file, list(table[0]))
            lines.writeheader()
            lines.writerows(written)
        subprocess.run([PROGRAM, "batch", source, "-o", target], stderr=subprocess.DEVNULL)
        with open(target, newline="") as file:
            answers = list(csv.DictReader(file))
    assert len(answers) == rows
    worst, wrong = ("", 0.0), []
    for i, (row, answer) in enumerate(zip(table, answers)):
        if bool(answer["refusal"]) != (i in bad) or (i in bad and any(answer[name] for name in answer.keys() - row.keys() - {"refusal"})):
            wrong.append((i, bad.get(i), answer["refusal"]))
        elif i not in bad:
            exact = outputs(row) | {"vehicle.1.speed": mpf(row["vehicle.1.speed"])}
            worst = max(worst, *((name, float(difference(name, mpf(float(answer[name])), exact.get, mpmath.sqrt))) for name in exact), key=lambda pair: pair[1])
    print(f"{rows} rows, {len(bad)} bad; largest difference {worst[1]:.1e} of the natural scale, in {worst[0]}; {len(wrong)} judged wrongly {wrong[:5]}")
    return worst[1] > 1e-12 or bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
