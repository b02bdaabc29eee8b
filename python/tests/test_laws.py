"""Laws of mechanics through the public functions, for collisions at random."""

from __future__ import annotations

import copy
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from test_batch import lookup

import planar_impact
from planar_impact import PhysicsError
from planar_impact.answers import Solution

settings.register_profile("planar-impact", deadline=None, max_examples=150, derandomize=True)
settings.load_profile("planar-impact")

#: Rounding, as a share of the largest quantity of the same kind.
ROUNDING = 1e-11


def number(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_subnormal=False)


def vehicles(speeds: st.SearchStrategy[float]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries(
        {
            "mass": number(500, 5000),
            "yaw_inertia": number(500, 9000),
            "heading": number(-3, 3),
            "velocity": st.tuples(speeds, number(-10, 10)).map(list),
            "yaw_rate": number(-2, 2),
            "impact_center": st.tuples(number(-2.5, 2.5), number(-1, 1)).map(list),
        }
    )


#: Vehicle 1 comes from the left of the ground axis x, vehicle 2 from its right: most pairs close.
CASES = st.fixed_dictionaries(
    {
        "schema": st.just(1),
        "vehicle": st.tuples(vehicles(number(5, 30)), vehicles(number(-30, -5))).map(list),
        "contact": st.fixed_dictionaries({"crush_plane": number(-0.5, 0.5), "restitution": number(0, 0.4)}),
    }
)


def solved(case: dict[str, Any]) -> Solution:
    try:
        return planar_impact.solve(case)
    except PhysicsError:
        assume(False)
        raise


def separation(case: dict[str, Any], answer: Solution) -> list[dict[str, Any]]:
    """Return mass, inertia, and motion before and after of each vehicle."""
    pairs = zip(case["vehicle"], answer.vehicles)
    return [{**vehicle, "after": np.array(after.velocity), "yaw_after": after.yaw_rate} for vehicle, after in pairs]


def offset(vehicle: dict[str, Any]) -> Any:
    """Return the impact center from the center of mass, in ground axes."""
    (forward, left), heading = vehicle["impact_center"], vehicle["heading"]
    return np.array([forward * math.cos(heading) - left * math.sin(heading), forward * math.sin(heading) + left * math.cos(heading)])


@given(CASES)
def test_momentum_is_conserved(case: dict[str, Any]) -> None:
    pair = separation(case, solved(case))
    before = sum(v["mass"] * np.array(v["velocity"]) for v in pair)
    after = sum(v["mass"] * v["after"] for v in pair)
    size = sum(v["mass"] * np.abs(v["velocity"]).max() for v in pair)
    np.testing.assert_allclose(after, before, rtol=0, atol=ROUNDING * size)
    # Of each vehicle about the impact center: the impulse has no moment there.
    for v in pair:
        x, y = -offset(v)
        before, after = (
            v["mass"] * (x * velocity[1] - y * velocity[0]) + v["yaw_inertia"] * rate
            for velocity, rate in ((v["velocity"], v["yaw_rate"]), (v["after"], v["yaw_after"]))
        )
        scale = v["mass"] * 100 + v["yaw_inertia"] * (abs(v["yaw_rate"]) + abs(v["yaw_after"]))
        assert after == pytest.approx(before, rel=0, abs=ROUNDING * scale)


@given(CASES)
def test_the_energy_account_closes(case: dict[str, Any]) -> None:
    answer = solved(case)

    def kinetic(v: dict[str, Any], velocity: Any, rate: float) -> float:
        return 0.5 * (float(v["mass"] * np.dot(velocity, velocity)) + float(v["yaw_inertia"] * rate**2))

    pair = separation(case, answer)
    before = sum(kinetic(v, v["velocity"], v["yaw_rate"]) for v in pair)
    after = sum(kinetic(v, v["after"], v["yaw_after"]) for v in pair)
    size = ROUNDING * before
    assert answer.energy.before == pytest.approx(before, rel=ROUNDING)
    assert answer.energy.after == pytest.approx(after, abs=size)
    assert answer.energy.loss == pytest.approx(before - after, abs=size)
    assert answer.energy.loss == pytest.approx(-(answer.energy.normal_work + answer.energy.tangential_work), abs=size)
    assert answer.energy.loss >= -size


@given(CASES)
def test_restitution_and_common_tangential_velocity(case: dict[str, Any]) -> None:
    answer = solved(case)
    size = ROUNDING * 100
    contact = answer.contact
    assert contact.separation.normal == pytest.approx(-case["contact"]["restitution"] * contact.approach.normal, abs=size)
    assert contact.separation.tangential == pytest.approx(0, abs=size)


def turned(case: dict[str, Any], angle: float) -> dict[str, Any]:
    """Return the same collision in ground axes that are turned."""
    case = copy.deepcopy(case)
    for vehicle in case["vehicle"]:
        vehicle["heading"] += angle
        x, y = vehicle["velocity"]
        vehicle["velocity"] = [x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)]
    case["contact"]["crush_plane"] += angle
    return case


def same(one: Solution, other: Solution) -> None:
    """Compare what does not depend on the axes."""
    for name in ("normal_work", "tangential_work", "loss"):
        assert other.energy[name] == pytest.approx(one.energy[name], abs=1e-10 * one.energy.before), name
    for before, after in zip(one.vehicles, other.vehicles):
        assert after.delta_v_magnitude == pytest.approx(before.delta_v_magnitude, abs=1e-9)
        assert after.yaw_rate == pytest.approx(before.yaw_rate, abs=1e-9)


@given(CASES, number(-3, 3))
def test_ground_axes_may_turn(case: dict[str, Any], angle: float) -> None:
    same(solved(case), solved(turned(case, angle)))


@given(CASES)
def test_vehicles_may_be_swapped(case: dict[str, Any]) -> None:
    one, other = solved(case), solved({**case, "vehicle": case["vehicle"][::-1]})
    for before, after in zip(one.vehicles, other.vehicles[::-1]):
        assert after.delta_v == pytest.approx(before.delta_v, abs=1e-9)


@given(CASES)
def test_the_crush_plane_has_two_angles(case: dict[str, Any]) -> None:
    contact = {**case["contact"], "crush_plane": case["contact"]["crush_plane"] + math.pi}
    same(solved(case), solved({**case, "contact": contact}))


@given(CASES, number(-20, 20), number(-20, 20))
def test_the_observer_may_move(case: dict[str, Any], x: float, y: float) -> None:
    moved = copy.deepcopy(case)
    for vehicle in moved["vehicle"]:
        vehicle["velocity"] = [vehicle["velocity"][0] + x, vehicle["velocity"][1] + y]
    one, other = solved(case), solved(moved)
    assert other.energy.loss == pytest.approx(one.energy.loss, abs=1e-10 * (one.energy.before + other.energy.before))
    for before, after in zip(one.vehicles, other.vehicles):
        assert after.delta_v == pytest.approx(before.delta_v, abs=1e-9)


#: Inputs, with a place in a case and a step for differences.
PLACES: list[tuple[str, tuple[Any, ...], float]] = [
    ("vehicle.1.mass", ("vehicle", 0, "mass"), 0.1),
    ("vehicle.2.velocity.x", ("vehicle", 1, "velocity", 0), 1e-3),
    ("vehicle.2.heading", ("vehicle", 1, "heading"), 1e-4),
    ("vehicle.1.impact_center.left", ("vehicle", 0, "impact_center", 1), 1e-4),
    ("contact.crush_plane", ("contact", "crush_plane"), 1e-4),
    ("contact.restitution", ("contact", "restitution"), 1e-4),
]


@settings(max_examples=40)
@given(CASES, st.sampled_from(PLACES))
def test_derivatives_are_the_limit_of_differences(case: dict[str, Any], place: tuple[str, tuple[Any, ...], float]) -> None:
    name, path, step = place
    contact = case["contact"]
    contact["restitution"] = max(contact["restitution"], 2 * step)

    def at(change: float) -> Solution:
        changed = copy.deepcopy(case)
        within: Any = changed
        for key in path[:-1]:
            within = within[key]
        within[path[-1]] += change
        return solved(changed)

    outputs = ("energy.normal_work", "energy.loss", "vehicle.2.delta_v.y")
    derivatives = planar_impact.gradient(case, of=outputs, wrt=name) if solved(case) else None
    assert derivatives is not None
    ends = [at(change).to_dict() for change in (-2 * step, -step, step, 2 * step)]
    for output in outputs:
        a, b, c, d = (lookup(end, output) for end in ends)
        # Of the fourth order, with rounding.
        difference = (a - 8 * b + 8 * c - d) / (12 * step)
        scale = max(abs(a), abs(d), 1e-3 * ends[0]["energy"]["before"] if "energy" in output else 1)
        assert derivatives.of[output].d[name] == pytest.approx(difference, rel=1e-5, abs=1e-9 * scale / step), output


@pytest.mark.filterwarnings("ignore:.*(is unusual|no road vehicle has)")
@settings(max_examples=60)
@given(CASES)
def test_a_dict_a_text_and_a_row_have_the_same_bits(case: dict[str, Any]) -> None:
    alone = solved(case).to_dict()
    assert planar_impact.solve(json.dumps(case)).to_dict() == alone
    columns = {}
    for i, vehicle in enumerate(case["vehicle"], 1):
        for key in ("mass", "yaw_inertia", "heading", "yaw_rate"):
            columns[f"vehicle.{i}.{key}"] = [vehicle[key]]
        for key, names in (("velocity", ("x", "y")), ("impact_center", ("forward", "left"))):
            columns.update({f"vehicle.{i}.{key}.{name}": [vehicle[key][place]] for place, name in enumerate(names)})
    columns.update({f"contact.{key}": [value] for key, value in case["contact"].items()})
    row = planar_impact.solve_batch(columns)
    assert row["refusal"].tolist() == [None]
    for name in row:
        if name not in columns and name != "refusal":
            expected = lookup(alone, name)
            assert row[name][0] == expected or (math.isnan(row[name][0]) and math.isnan(expected)), name


@settings(max_examples=10)
@given(CASES)
def test_a_dict_a_file_and_the_command_line_have_the_same_bytes(program: str, tmp_path_factory: Any, case: dict[str, Any]) -> None:
    from test_cases import printed

    path = Path(tmp_path_factory.mktemp("case")) / "case.json"
    path.write_text(json.dumps(case), encoding="utf-8")
    answer = solved(case)
    assert planar_impact.solve(path).to_json() == answer.to_json() == printed(program, "solve", str(path), "--format", "json")
