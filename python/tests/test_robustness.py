"""Hostile dictionaries, memory over many calls, and calls from many threads."""

from __future__ import annotations

import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from test_answers import tool

import planar_impact
from planar_impact import CaseError


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


class Itself:
    """Is its own plain form."""

    def tolist(self) -> Itself:
        return self


class Deeper:
    """Has a plain form that has a plain form."""

    def __init__(self, levels: int) -> None:
        self.levels = levels

    def tolist(self) -> Any:
        return Other(self.levels - 1) if self.levels else 1450.0


class Other(Deeper):
    def tolist(self) -> Any:
        return Deeper(self.levels - 1) if self.levels else 1450.0


class Whole(int):
    def __str__(self) -> str:
        return "{whole}"


def test_plain_forms_of_numbers() -> None:
    vehicle = {"mass": 1450.0, "yaw_inertia": 2500, "heading": 0, "speed": 14, "impact_center": [1.9, 0.125]}

    def solved(**keys: Any) -> str:
        contact = {"crush_plane": 0, "restitution": 0.1}
        return planar_impact.solve({"schema": 1, "vehicle": [{**vehicle, **keys}, {"barrier": True}], "contact": contact}).to_json()

    plain = solved()
    same: list[Any] = [np.longdouble(1450), np.array(1450, np.longdouble), np.float32(1450), np.int16(1450), Deeper(4), Whole(1450)]
    for mass in same:
        assert solved(mass=mass) == plain, repr(mass)
    assert solved(impact_center=np.array([1.9, 0.125], dtype=np.longdouble)) == plain
    with pytest.raises(CaseError, match=f"{2**65} kg m"):
        solved(yaw_inertia=Whole(2**65))
    refused: list[Any] = [np.clongdouble(1450), np.complex128(1450), Itself(), Deeper(100_000), np.timedelta64(1450, "ns")]
    refused += [np.datetime64(1450, "ns"), np.array(1450, dtype="m8[ns]")]
    for mass in refused:
        with pytest.raises(CaseError) as caught:
            solved(mass=mass)
        assert [(issue.code, issue.path) for issue in caught.value.issues] == [("wrong-type", "vehicle.1.mass")], repr(mass)
    for beyond in (10**400, -(10**400)):
        with pytest.raises(CaseError, match="beyond the range of floats"):
            solved(mass=beyond)


def test_what_has_no_end_is_too_large_soon() -> None:
    started = time.monotonic()
    for endless in (range(10**10), {"title": range(10**10)}):
        with pytest.raises(CaseError, match="larger than"):
            planar_impact.solve({"schema": 1, "note": endless})
    assert time.monotonic() - started < 20
