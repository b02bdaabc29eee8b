"""Columns of NumPy arrays: the same bits as case by case; hostile columns raise exceptions."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import planar_impact
from planar_impact import CaseError, PhysicsError

BARRIER = planar_impact.template("barrier")
ROWS = 100_000


def random_columns(rows: int = ROWS) -> dict[str, Any]:
    """Return two vehicles that mostly close."""
    random = np.random.default_rng(1)
    columns: dict[str, Any] = {}
    for i in (1, 2):
        vehicle = f"vehicle.{i}"
        columns[f"{vehicle}.mass"] = random.uniform(800, 3000, rows)
        columns[f"{vehicle}.yaw_inertia"] = random.uniform(1000, 6000, rows)
        columns[f"{vehicle}.heading"] = random.uniform(-3.1, 3.1, rows)
        columns[f"{vehicle}.speed"] = random.uniform(0, 30, rows)
        columns[f"{vehicle}.yaw_rate"] = random.normal(0, 0.5, rows)
        columns[f"{vehicle}.impact_center.forward"] = random.uniform(-2, 2, rows)
        columns[f"{vehicle}.impact_center.left"] = random.uniform(-1, 1, rows)
    columns["contact.crush_plane"] = random.uniform(-3, 3, rows)
    columns["contact.restitution"] = random.uniform(0, 0.4, rows)
    return columns


def case_of(columns: dict[str, Any], row: int) -> dict[str, Any]:
    """Return the case that a row stands for."""

    def vehicle(i: int) -> dict[str, Any]:
        def number(key: str) -> float:
            return float(columns[f"vehicle.{i}.{key}"][row])

        center = [number("impact_center.forward"), number("impact_center.left")]
        keys = ("mass", "yaw_inertia", "heading", "speed", "yaw_rate")
        return {"impact_center": center} | {key: number(key) for key in keys}

    contact = {key: float(columns[f"contact.{key}"][row]) for key in ("crush_plane", "restitution")}
    return {"schema": 1, "vehicle": [vehicle(1), vehicle(2)], "contact": contact}


def lookup(answer: dict[str, Any], name: str) -> float:
    """Return an output of `solve` by its dotted name."""
    name = name.removeprefix("result.")
    at: Any = answer
    words = name.split(".")
    if words[0] == "vehicle":
        at, words = answer["vehicles"][int(words[1]) - 1], words[2:]
    for word in words:
        at = at["xy".index(word)] if isinstance(at, list) else at[word]
    return math.nan if at is None else float(at)


def test_rows_are_solved_as_cases() -> None:
    columns = random_columns()
    answer = planar_impact.solve_batch(columns)
    outputs = [name for name in answer if name not in columns and name != "refusal"]
    assert len(outputs) >= 20 and all(answer[name].dtype == np.float64 and len(answer[name]) == ROWS for name in outputs)
    rows = np.random.default_rng(2).choice(ROWS, 200, replace=False)
    solved = 0
    for row in map(int, rows):
        try:
            alone = planar_impact.solve(case_of(columns, row)).to_dict()
        except PhysicsError as error:
            assert answer["refusal"][row] == ";".join(issue.code for issue in error.issues)
            assert all(math.isnan(answer[name][row]) for name in outputs)
            continue
        solved += 1
        assert answer["refusal"][row] is None
        for name in outputs:
            assert answer[name][row] == lookup(alone, name) or math.isnan(lookup(alone, name)), name
    assert 30 < solved < 200


def test_derivatives_are_those_of_gradient() -> None:
    columns = random_columns(50)
    answer = planar_impact.solve_batch(columns, of=["T_L", "dV1"], wrt=["vehicle.1.speed", "e"])
    compared = 0
    for row in np.flatnonzero(answer["refusal"] == None):  # noqa: E711
        alone = planar_impact.gradient(case_of(columns, int(row)), of=["T_L", "dV1"], wrt=["v1", "e"])
        for of in ("energy.loss", "vehicle.1.delta_v_magnitude"):
            for by in ("vehicle.1.speed", "contact.restitution"):
                expected = alone.of[of].d[by]
                assert answer[f"d {of} / d {by}"][row] == pytest.approx(expected, rel=1e-9, abs=1e-9 * abs(alone.of[of].value or 0))
                compared += 1
    assert compared > 40


def test_derivatives_in_an_array_are_those_in_columns() -> None:
    columns = random_columns(40_000)
    question: dict[str, Any] = {"of": ["T_L", "dV1", "mu0"], "wrt": ["e", "vehicle.1.speed"], "check": True}
    flat = planar_impact.solve_batch(columns, **question)
    answer = planar_impact.solve_batch(columns, **question, derivatives="array", threads=3)
    names = [name for name in flat if name.startswith("d ")]
    assert list(answer) == [name for name in flat if name not in names][:-2] + ["derivatives", "check", "refusal"]
    array = answer["derivatives"]
    assert array.shape == (40_000, 3, 2) and array.dtype == np.float64 and array.flags.c_contiguous
    for i, of in enumerate(("energy.loss", "vehicle.1.delta_v_magnitude", "contact.critical_impulse_ratio")):
        for j, by in enumerate(("contact.restitution", "vehicle.1.speed")):
            np.testing.assert_array_equal(array[:, i, j], flat[f"d {of} / d {by}"])
    for name in ("energy.loss", "check", "refusal"):
        np.testing.assert_array_equal(answer[name], flat[name])


def test_an_array_of_no_derivatives() -> None:
    speeds = np.array([12.0, 15.0])
    none = planar_impact.solve_batch({"vehicle.1.speed": speeds}, of="T_L", case=BARRIER, derivatives="array")
    assert none["derivatives"].shape == (2, 1, 0) and none["refusal"].tolist() == [None, None]
    empty = planar_impact.solve_batch({"vehicle.1.speed": speeds[:0]}, of="T_L", wrt="e", case=BARRIER, derivatives="array")
    assert empty["derivatives"].shape == (0, 1, 1)


def test_progress() -> None:
    steps: list[tuple[int, int]] = []
    columns = random_columns(300_000)
    planar_impact.solve_batch(columns, wrt=["e", "Gamma"], threads=1, progress=lambda done, total: steps.append((done, total)))
    parts = -(-300_000 // (1 << 14))
    assert steps[-1] == (parts, parts) and steps == sorted(steps) and all(1 <= done <= total == parts for done, total in steps)

    def fail(done: int, total: int) -> None:
        raise LookupError(f"{done} of {total}")

    with pytest.raises(LookupError, match=f"of {parts}"):
        planar_impact.solve_batch(columns, of="T_L", progress=fail)
    with pytest.raises(TypeError, match="progress"):
        planar_impact.solve_batch(columns, of="T_L", progress=1)  # type: ignore[call-overload]


def test_any_number_of_threads_gives_the_same_bits() -> None:
    columns = random_columns(70_000)
    one, many = (planar_impact.solve_batch(columns, of=["T_L", "dV1"], wrt="e", threads=threads) for threads in (1, 5))
    assert list(one) == list(many)
    for name, column in one.items():
        np.testing.assert_array_equal(column, many[name], strict=True)


def losses(**columns: Any) -> list[float]:
    answer = planar_impact.solve_batch({name.replace("__", "."): column for name, column in columns.items()}, of="T_L", case=BARRIER)
    return [float(loss) for loss in answer["energy.loss"]]


def test_a_number_is_the_same_in_every_type() -> None:
    numbers = [12.0, 13.0, 15.0]
    expected = losses(vehicle__1__speed=np.array(numbers))
    assert expected[0] < expected[1] < expected[2]
    long = np.array([12.0, 0.0, 13.0, 0.0, 15.0, 0.0])
    read_only = np.array(numbers)
    read_only.flags.writeable = False
    unaligned = np.frombuffer(b"x" + np.array(numbers).tobytes(), dtype=np.uint8)[1:].view(np.float64)
    for column in (
        numbers,
        tuple(numbers),
        np.array(numbers, dtype=np.float32),
        np.array(numbers, dtype=np.float16),
        np.array(numbers, dtype=np.longdouble),
        np.array(numbers, dtype=np.int8),
        np.array(numbers, dtype=np.uint64),
        np.array(numbers, dtype=">f8"),
        np.array(numbers, dtype=object),
        np.array(["12", " 13.0 ", "15"]),
        long[::2],
        np.array(numbers[::-1])[::-1],
        read_only,
        unaligned,
    ):
        assert losses(vehicle__1__speed=column) == expected, column


def test_scalars_hold_in_every_row() -> None:
    expected = losses(vehicle__1__speed=[12.0, 15.0])
    ones = planar_impact.solve_batch({"vehicle.1.speed": [12.0, 15.0], "contact.tangential_law": "brach"}, of="T_L", case=BARRIER)
    assert ones["energy.loss"].tolist() == expected
    assert ones["contact.tangential_law"].tolist() == ["brach", "brach"]
    for scalar in (12, 12.0, np.float32(12), np.array(12), "12"):
        alone = planar_impact.solve_batch({"vehicle.1.speed": scalar}, of="T_L", case=BARRIER)
        assert alone["energy.loss"].tolist() == expected[:1]
    assert planar_impact.solve_batch({}, of="T_L", case=BARRIER)["energy.loss"].shape == (1,)


def test_names_in_one_string_are_separated_by_commas() -> None:
    both = planar_impact.solve_batch({"vehicle.1.speed": 12.0}, of="T_L, dV1", wrt="v1,e", case=BARRIER)
    listed = planar_impact.solve_batch({"vehicle.1.speed": 12.0}, of=["T_L", "dV1"], wrt=["v1", "e"], case=BARRIER)
    assert list(both) == list(listed) and len(both) > 6
    with pytest.raises(CaseError, match="the name of an output is missing"):
        planar_impact.solve_batch({"vehicle.1.speed": 12.0}, of="T_L,,dV1", case=BARRIER)


def test_a_unit_is_in_the_name() -> None:
    columns = {"vehicle.1.speed [km/h]": np.array([54.0])}
    expected = losses(vehicle__1__speed=[15.0])
    assert planar_impact.solve_batch(columns, of="T_L", case=BARRIER)["energy.loss"].tolist() == expected


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
def test_nothing_is_that_of_the_case_and_nan_is_refused() -> None:
    masked = np.ma.MaskedArray([12.0, 99.0], mask=[False, True])
    given = losses(vehicle__1__speed=[12.0, None])
    assert given == losses(vehicle__1__speed=masked)
    assert given[1] == planar_impact.solve(BARRIER).energy.loss
    answer = planar_impact.solve_batch({"vehicle.1.speed": np.array([12.0, math.nan, math.inf, "fast", b"1"], dtype=object)}, of="T_L", case=BARRIER)
    assert answer["refusal"].tolist()[0] is None and np.isnan(answer["energy.loss"]).tolist() == [False, True, True, True, True]
    assert answer["refusal"].tolist()[1:] == ["not-finite", "not-finite", "unreadable", "unreadable"]


def test_other_columns_pass_through() -> None:
    columns = {"site": np.array(["a", "b"]), "when": np.array(["2020-01-01", "2020-01-02"], dtype="datetime64[D]")}
    answer = planar_impact.solve_batch({**columns, "vehicle.1.speed": [12.0, 15.0]}, of="T_L", case=BARRIER, check=True)
    assert list(answer) == ["site", "when", "vehicle.1.speed", "energy.loss", "check", "refusal"]
    assert answer["site"] is columns["site"] and answer["check"].tolist() == [None, None]


def test_a_column_that_may_be_meant_as_an_input_is_told() -> None:
    with pytest.warns(UserWarning, match="`e` passes through unread.* contact.restitution") as told:
        planar_impact.solve_batch({"vehicle.1.speed": [12.0], "e": [0.3]}, of="T_L", case=BARRIER)
    assert told[0].filename == __file__
    pa = pytest.importorskip("pyarrow")
    table = pa.table({"vehicle.1.speed": [12.0], "Mass [lb]": [0.3]})
    with pytest.warns(UserWarning, match=r"vehicle.1.mass \[lb\] or vehicle.2.mass \[lb\]") as told:
        planar_impact.solve_batch(table, of="T_L", case=BARRIER)
    assert told[0].filename == __file__


def test_rows_that_no_vehicle_has_are_told_with_the_first() -> None:
    masses = np.full(40_000, 1500.0)
    masses[[20_001, 39_999]] = 50.0
    message = r"vehicle.1: no road vehicle has a mass of 50 kg; check its unit \(row 20001, and 1 more\)"
    pa = pytest.importorskip("pyarrow")
    sizes = {"vehicle.1.mass": masses, "vehicle.1.yaw_inertia": 1.7 * masses}
    for columns in (sizes, pa.table(sizes)):
        for threads in (1, 3):
            with pytest.warns(UserWarning, match=message) as told:
                planar_impact.solve_batch(columns, of="T_L", case=BARRIER, threads=threads)
            assert len(told) == 1 and told[0].filename == __file__


def test_rows_without_inputs_are_told() -> None:
    pd = pytest.importorskip("pandas")
    message = r"no input of the row has a number.* \(row 1\)"
    for columns in ({"vehicle.1.speed": [12.0, None]}, pd.DataFrame({"vehicle.1.speed": [12.0, math.nan]})):
        with pytest.warns(UserWarning) as told:
            planar_impact.solve_batch(columns, of="T_L", case=BARRIER)
        assert sum(re.search(message, str(one.message)) is not None for one in told) == 1


def test_no_rows() -> None:
    answer = planar_impact.solve_batch({"vehicle.1.speed": np.empty(0)}, of="T_L", case=BARRIER)
    assert answer["energy.loss"].shape == answer["refusal"].shape == (0,)
    assert planar_impact.solve_batch({"vehicle.1.speed": []}, of="T_L", case=BARRIER)["energy.loss"].shape == (0,)


SPEEDS = np.array([12.0, 15.0])


@pytest.mark.parametrize(
    ("columns", "code"),
    [
        ({"vehicle.1.sped": SPEEDS}, "unknown-column"),
        ({"vehicle.1.speed [kg]": SPEEDS}, "invalid-unit"),
        ({"vehicle.1.speed": SPEEDS, "vehicle.1.speed [mph]": SPEEDS}, "repeated-column"),
        ({"vehicle.1.speed": SPEEDS, "refusal": SPEEDS}, "repeated-column"),
        ({"vehicle.1.speed": SPEEDS, "contact.restitution": np.zeros(3)}, "length"),
        ({"vehicle.1.speed": SPEEDS, "site": np.zeros(3)}, "length"),
        ({"vehicle.1.speed": np.zeros((2, 2))}, "wrong-type"),
        ({"vehicle.1.speed": np.array([1j])}, "wrong-type"),
        ({"vehicle.1.speed": np.array(["2020-01-01"], dtype="datetime64[D]")}, "wrong-type"),
        ({"vehicle.1.speed": np.array([b"12"])}, "wrong-type"),
        ({"vehicle.1.speed": np.zeros(2, dtype=[("a", float)])}, "wrong-type"),
        ({"vehicle.1.speed": [[1.0], [1.0, 2.0]]}, "wrong-type"),
        ({"vehicle.1.speed": (speed for speed in SPEEDS)}, "wrong-type"),
        ({"vehicle.1.speed": SPEEDS, "vehicle.1.mass": {1500.0}}, "wrong-type"),
        ({"vehicle.1.speed": {"a": 1.0}}, "wrong-type"),
        ({"vehicle.1.speed": object()}, "wrong-type"),
    ],
)
def test_wrong_columns(columns: dict[str, Any], code: str) -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve_batch(columns, of="T_L", case=BARRIER)
    assert code in [issue.code for issue in caught.value.issues]


def test_a_table_without_a_case_names_what_is_missing() -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve_batch({"vehicle.1.speed": SPEEDS})
    assert "vehicle.1.mass" in [issue.path for issue in caught.value.issues]


def test_fast_rows_differ_in_last_bits_at_most() -> None:
    columns = {"vehicle.1.speed": np.linspace(-1, 30, 1000)}
    exact, fast = (planar_impact.solve_batch(columns, case=BARRIER, fast=mode) for mode in (False, True))
    assert exact["refusal"].tolist() == fast["refusal"].tolist()
    np.testing.assert_allclose(fast["energy.loss"], exact["energy.loss"], rtol=1e-13)


def test_wrong_calls() -> None:
    columns = {"vehicle.1.speed": SPEEDS}
    with pytest.raises(CaseError, match='accepted: "columns", "array"'):
        planar_impact.solve_batch(columns, case=BARRIER, derivatives="rows")  # type: ignore[call-overload]
    with pytest.raises(CaseError, match="rename the column"):
        planar_impact.solve_batch({**columns, "derivatives": SPEEDS}, case=BARRIER, derivatives="array")
    for threads in (0, -1, 10**20):
        with pytest.raises(CaseError):
            planar_impact.solve_batch(columns, case=BARRIER, threads=threads)
    wrongs: list[Any] = [None, 1, "vehicle.1.speed", [1], SPEEDS]
    for wrong in wrongs:
        with pytest.raises(TypeError):
            planar_impact.solve_batch(wrong, case=BARRIER)
    with pytest.raises(TypeError):
        planar_impact.solve_batch({1: SPEEDS}, case=BARRIER)  # type: ignore[dict-item]
    with pytest.raises(CaseError):
        planar_impact.solve_batch(columns, case=BARRIER, of="m1")
    with pytest.raises(CaseError):
        planar_impact.solve_batch(columns, case=BARRIER, wrt="dV1")


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
@pytest.mark.parametrize("truth", [True, np.True_])
def test_a_truth_is_no_number_and_a_barrier(truth: Any) -> None:
    for column in ([truth, 14], [truth, 14.0], [truth, None], np.array([truth, 14.0], dtype=object), [truth, truth]):
        answer = planar_impact.solve_batch({"vehicle.1.speed": column}, of="dV1", case=BARRIER)
        assert answer["refusal"][0] == "unreadable"
    answer = planar_impact.solve_batch({"vehicle.2.barrier": np.array([truth, None], dtype=object)}, of="dV1", case=BARRIER)
    assert answer["refusal"].tolist() == [None, None]


def test_numbers_in_many_objects() -> None:
    numbers: list[Any] = [14, 14.0, np.float32(14), Fraction(14), Decimal(14), "14"]
    for number in numbers:
        assert planar_impact.solve_batch({"vehicle.1.speed": number}, of="dV1", case=BARRIER)["refusal"].tolist() == [None]


def test_a_column_of_objects_that_are_nothing() -> None:
    answer = planar_impact.solve_batch({"vehicle.1.speed": np.array([object(), [1.0], {}, 1j, "\ud800"], dtype=object)}, case=BARRIER)
    assert answer["refusal"].tolist() == ["unreadable"] * 5
