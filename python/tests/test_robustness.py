"""Hostile dictionaries, memory over many calls, and calls from many threads."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor

import pytest
from test_answers import tool

import planar_impact


def test_hostile_dictionaries() -> None:
    ends = tool("fuzz").fuzz(3000, 7)
    assert ends["answered"] > 30 and ends["CaseError"] > 1000, ends


@pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")
def test_memory_does_not_grow() -> None:
    pytest.importorskip("pyarrow")
    # An answer has some kilobytes: a hundredth of the answers kept would show.
    assert tool("leaks").growth(20_000) < 8


def test_many_threads() -> None:
    vehicle = {"mass": 1500, "yaw_inertia": 2500, "heading": 0, "impact_center": [2, 0]}
    contact = {"crush_plane": 0, "restitution": 0.1}
    cases = [{"schema": 1, "vehicle": [{**vehicle, "speed": speed}, {"barrier": True}], "contact": contact} for speed in range(1, 41)]
    alone = [planar_impact.solve(case).to_json() for case in cases]
    assert len(set(alone)) == len(cases)
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda case: planar_impact.solve(case).to_json(), cases * 20)) == alone * 20
