#!/usr/bin/env python3
"""Solve hostile dictionaries: each gives an answer or an error of the package, and never ends the interpreter.

    python/tools/fuzz.py 100000
"""

from __future__ import annotations

import copy
import math
import random
import sys
from collections import Counter
from typing import Any

import planar_impact

CASE: dict[str, Any] = {
    "schema": 1,
    "title": "a case",
    "vehicle": [
        {"name": "one", "mass": "1450 kg", "yaw_inertia": 2500, "heading": "0 deg", "speed": "50 km/h", "impact_center": ["1.9 m", 0.1]},
        {"mass": 1250, "yaw_inertia": 1900, "heading": 1.5, "velocity": [0, 8], "yaw_rate": 0.1, "impact_center": [0.4, 0.75]},
    ],
    "contact": {"crush_plane": "0 deg", "restitution": {"min": 0.1, "max": 0.2}, "impulse_ratio": {"of_critical": 0.9}},
    "evidence": {"vehicle": {"1": {"delta_v_magnitude": "7 m/s ± 1 m/s"}}},
    "unknown": {"vehicle": {"1": {"speed": {"start": "50 km/h"}}}},
}
NUMBERS = [0, -1, 1, 10**400, -(2**63), 2**64, 1e308, -1e308, 5e-324, 1e-300, math.nan, math.inf, -math.inf, True, 0.1]
TEXTS = ["", " ", "\0", "\ud800", "1 kg", "1e999 m", "--", "50 km/h ± 5 %", "∞ m", "x" * 1000, "1 " + "kg" * 50, "nan", "'", '"""', "{", "[[", "🚗"]
KEYS = ["", "schema", "vehicle", "contact", "mass", "weight", "barrier", "crush", "speed", "min", "sd", "file", "\ud800", "a.b", 1, None]


def hostile(source: random.Random, depth: int = 0) -> Any:
    """Return anything."""
    kind = source.randrange(9 if depth < 4 else 5)
    if kind < 2:
        return source.choice(NUMBERS)
    if kind < 4:
        return source.choice(TEXTS)
    if kind == 4:
        return source.choice([None, b"1", object(), 1j, {1, 2}, (), range(3)])
    if kind < 7:
        return [hostile(source, depth + 1) for _ in range(source.randrange(4))]
    return {source.choice(KEYS): hostile(source, depth + 1) for _ in range(source.randrange(4))}


def mutated(source: random.Random) -> Any:
    """Return a case in which some places are changed, removed or added."""
    case = copy.deepcopy(CASE)
    for _ in range(source.randrange(1, 5)):
        at: Any = case
        while True:
            places = list(at) if isinstance(at, dict) else list(range(len(at)))
            if not places:
                break
            place = source.choice(places)
            if isinstance(at[place], (dict, list)) and source.random() < 0.7:
                at = at[place]
                continue
            change = source.random()
            if change < 0.2:
                del at[place]
            elif change < 0.4 and isinstance(at, dict):
                at[source.choice(KEYS)] = hostile(source)
            elif change < 0.7:
                at[place] = source.choice(NUMBERS)
            else:
                at[place] = hostile(source)
            break
    return case


def fuzz(count: int, seed: int) -> Counter[str]:
    """Return how many cases end in which way."""
    source = random.Random(seed)
    ends: Counter[str] = Counter()
    verbs = (planar_impact.solve, planar_impact.gradient, planar_impact.draw, planar_impact.crush, planar_impact.stiffness)
    for _ in range(count):
        case: Any = mutated(source) if source.random() < 0.9 else {source.choice(KEYS): hostile(source)}
        verb = planar_impact.solve if source.random() < 0.7 else source.choice(verbs)
        try:
            verb(case)
            ends["answered"] += 1
        except planar_impact.Error as error:
            assert error.issues, case
            ends[type(error).__name__] += 1
    return ends


if __name__ == "__main__":
    print(dict(fuzz(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)))
