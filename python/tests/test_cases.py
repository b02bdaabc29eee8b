"""Verbs of a case: the same numbers as the command line and as the reference answers."""

from __future__ import annotations

import copy
import json
import math
import pickle
import subprocess
from collections import UserList
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, ROOT, reference

import planar_impact
from planar_impact import Answer, CaseError, PhysicsError, Units

POSITION_A = EXAMPLES / "position-a.toml"


def printed(program: str, *arguments: str) -> str:
    """Return what the command line prints."""
    done = subprocess.run([program, *arguments], capture_output=True, text=True, encoding="utf-8", check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


VERBS: list[tuple[list[str], Any]] = [
    (["solve", str(POSITION_A)], lambda: planar_impact.solve(POSITION_A)),
    (["gradient", str(POSITION_A)], lambda: planar_impact.gradient(POSITION_A)),
    (
        ["gradient", str(POSITION_A), "--of", "T_L,dV1", "--wrt", "e,Gamma", "--second"],
        lambda: planar_impact.gradient(POSITION_A, of=["T_L", "dV1"], wrt=("e", "Gamma"), second=True),
    ),
    (
        ["sweep", str(POSITION_A), "--vary", "Gamma=-10 deg:10 deg:1 deg"],
        lambda: planar_impact.sweep(POSITION_A, vary={"Gamma": ("-10 deg", "10 deg", "1 deg")}),
    ),
    (["sweep", str(POSITION_A), "--vary", "e=0:0.2:0.1"], lambda: planar_impact.sweep(POSITION_A, vary={"e": (0, 0.2, 0.1)})),
    (["crush", str(EXAMPLES / "cavalier-crush.toml")], lambda: planar_impact.crush(EXAMPLES / "cavalier-crush.toml")),
    (["crash3", str(ROOT / "app/templates/t-bone.toml")], lambda: planar_impact.crash3(ROOT / "app/templates/t-bone.toml")),
    (
        ["reconstruct", str(EXAMPLES / "reconstruct/two-cars.toml"), "--starts", "8", "--seed", "3"],
        lambda: planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", starts=8, seed=3),
    ),
    (
        ["reconstruct", str(EXAMPLES / "reconstruct/from-tests.toml")],
        lambda: planar_impact.reconstruct(str(EXAMPLES / "reconstruct/from-tests.toml")),
    ),
    (
        ["uncertainty", str(EXAMPLES / "uncertain.toml"), "--samples", "2000", "--of", "dV1", "--probability", "dV1 > 10 m/s"],
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=2000, of="dV1", probability="dV1 > 10 m/s"),
    ),
    (["slide", str(EXAMPLES / "to-rest.toml")], lambda: planar_impact.slide(EXAMPLES / "to-rest.toml")),
    (["stiffness", str(EXAMPLES / "tests/malibu.toml")], lambda: planar_impact.stiffness(EXAMPLES / "tests/malibu.toml")),
    (["record", str(EXAMPLES / "record/barrier.toml")], lambda: planar_impact.record(EXAMPLES / "record/barrier.toml")),
    (["formula", "T_L", "--wrt", "e"], lambda: planar_impact.formula("T_L", wrt="e")),
    (["formula", "mu0", "--case", str(POSITION_A)], lambda: planar_impact.formula("mu0", case=POSITION_A)),
]


@pytest.mark.parametrize(("arguments", "verb"), VERBS, ids=[" ".join(Path(word).name for word in words) for words, _ in VERBS])
def test_an_answer_is_that_of_the_command_line(program: str, arguments: list[str], verb: Any) -> None:
    answer = verb()
    output = printed(program, *arguments, "--format", "json")
    assert answer.to_json() == output
    assert answer.to_dict() == json.loads(output)
    assert str(answer) == printed(program, *arguments)


def test_drawings_and_reports_are_those_of_the_command_line(program: str, tmp_path: Path) -> None:
    assert planar_impact.draw(POSITION_A, units="si") == printed(program, "draw", str(POSITION_A), "-o", "-", "--units", "si")
    printed(program, "report", str(POSITION_A), "-o", str(tmp_path / "report.html"), "--date", "today")
    assert planar_impact.report(POSITION_A, date="today") == (tmp_path / "report.html").read_text(encoding="utf-8")


def test_units_change_the_text_alone(program: str) -> None:
    every: tuple[Units, ...] = ("us", "si", "uk")
    for units in every:
        answer = planar_impact.solve(POSITION_A, units=units)
        assert repr(answer) == printed(program, "solve", str(POSITION_A), "--units", units)
        assert answer == planar_impact.solve(POSITION_A)


def close(found: Any, expected: Any, sizes: dict[str, float], path: str = "") -> None:
    """Compare with a reference: within a part of 1e12 of the largest quantity of the answer of that kind."""
    if isinstance(expected, dict):
        for key, value in expected.items():
            close(found[key], value, sizes, f"{path}.{key}")
    elif isinstance(expected, list):
        assert len(found) == len(expected)
        for one, other in zip(found, expected):
            close(one, other, sizes, path)
    elif isinstance(found, float) and isinstance(expected, str):
        size = sizes["energy"] if any(word in path for word in ("energy", "work", "before", "after", "loss")) else sizes["other"]
        assert found == pytest.approx(float(expected), rel=1e-10, abs=1e-12 * size), path


def numbers(value: Any) -> list[float]:
    """Return every number of an answer."""
    if isinstance(value, dict):
        return [number for item in value.values() for number in numbers(item)]
    if isinstance(value, list):
        return [number for item in value for number in numbers(item)]
    return [abs(value)] if isinstance(value, float) and math.isfinite(value) else []


@pytest.mark.parametrize("entry", reference("cases"), ids=lambda entry: str(entry["case"]["title"]))
def test_collisions_have_their_reference_answers(entry: dict[str, Any]) -> None:
    if entry["status"] == 3:
        with pytest.raises(PhysicsError) as refused:
            planar_impact.solve(entry["case"])
        assert refused.value.issues
        return
    answer = planar_impact.solve(entry["case"]).to_dict()
    sizes = {"energy": answer["energy"]["before"], "other": max(numbers([answer["vehicles"], answer["contact"]["impulse"]]))}
    close(answer, entry["answer"], sizes)


def test_a_case_is_a_path_a_text_or_a_dict() -> None:
    by_path = planar_impact.solve(POSITION_A)
    assert planar_impact.solve(str(POSITION_A)) == by_path
    assert planar_impact.solve(POSITION_A.read_text(encoding="utf-8")) == by_path
    for missing in ("/data/run=3/no-such.toml", "no=such.json"):
        with pytest.raises(CaseError, match="there is no such file"):
            planar_impact.solve(missing)
    case = reference("cases")[0]["case"]
    by_dict = planar_impact.solve(case)
    assert planar_impact.solve(json.dumps(case)) == by_dict
    assert planar_impact.solve("\ufeff" + json.dumps(case)) == by_dict
    case["contact"]["restitution"] = np.float64(case["contact"]["restitution"])
    case["vehicle"][1]["impact_center"] = ("1.450877 m", np.array("74.3 cm"))
    case["vehicle"][0] = MappingProxyType({**case["vehicle"][0], "mass": np.str_(case["vehicle"][0]["mass"])})
    case["vehicle"] = UserList(case["vehicle"])
    assert planar_impact.solve(MappingProxyType(case)).vehicles[0].delta_v == by_dict.vehicles[0].delta_v
    assert planar_impact.solve({**case, "schema": np.int64(1), "title": np.str_("a \"title\"\n\\ ∆")}).title == 'a "title"\n\\ ∆'


def test_every_number_of_a_dict_keeps_its_bits() -> None:
    vehicle = {"heading": 0, "yaw_inertia": 2500, "impact_center": [2, 0], "speed": 3}
    contact = {"crush_plane": 0, "restitution": 0}
    for mass in (900, 1e3, 1234.5678901234567, 0.1 + 1000.2, np.float32(1000.1), np.float64(999.9), np.int16(1200)):
        case = {"schema": 1, "vehicle": [{**vehicle, "mass": mass}, {"barrier": True}], "contact": contact}
        assert planar_impact.gradient(case, of="T_L", wrt="m1").wrt["vehicle.1.mass"] == float(mass)


def test_what_a_dict_cannot_have_is_reported_with_its_place() -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve({"vehicle": [{"mass": math.nan}, {"speed": {1, 2}, 5: 6}], "title": "\ud800", "contact": b"1"})
    assert [(issue.path, issue.message) for issue in caught.value.issues] == [
        ("vehicle.1.mass", "expected a finite number, found nan"),
        ("vehicle.2.speed", "expected a number, a string, a bool, a list or a dict, found set"),
        ("vehicle.2", "a key is a string; found 5"),
        ("title", "a lone surrogate is no character of a case file"),
        ("contact", "expected a number, a string, a bool, a list or a dict, found bytes"),
    ]


@pytest.mark.parametrize("text", ["\ud800", "\ud800 = 1", "title = '\ud800'\nschema = 1"])
def test_a_lone_surrogate_is_refused_in_any_text(text: str) -> None:
    with pytest.raises(CaseError, match="a lone surrogate is no character of a case file"):
        planar_impact.solve(text)


def test_keys_are_attributes() -> None:
    answer = planar_impact.solve(POSITION_A)
    assert answer.vehicles[0].delta_v_magnitude == answer["vehicles"][0]["delta_v_magnitude"]
    assert answer.energy.loss == answer.to_dict()["energy"]["loss"]
    assert set(answer) == set(answer.to_dict())
    assert "vehicles" in dir(answer) and "vehicles" in answer
    gradient = planar_impact.gradient(POSITION_A, of="T_L", wrt="e")
    slope = gradient.of["energy.loss"].d["contact.restitution"]
    assert slope is not None and slope < 0
    with pytest.raises(AttributeError, match="energy"):
        _ = answer.enrgy  # type: ignore[attr-defined]
    with pytest.raises(AttributeError):
        answer.title = "other"
    with pytest.raises(KeyError):
        _ = answer["enrgy"]


def test_an_answer_is_copied_and_sent_to_other_processes() -> None:
    answer = planar_impact.solve(POSITION_A)
    for other in (pickle.loads(pickle.dumps(answer)), copy.deepcopy(answer)):
        assert isinstance(other, Answer)
        assert (other.to_json(), str(other), other._repr_html_()) == (answer.to_json(), str(answer), answer._repr_html_())
        for units in ("us", "si", "uk"):
            assert other.to_text(units=units) == answer.to_text(units=units)
        with pytest.raises(CaseError, match="furlongs"):
            other.to_text(units="furlongs")
    assert answer.to_text(units="us") != answer.to_text(units="si")
    assert copy.deepcopy(answer.energy) == answer.energy


def test_a_notebook_shows_a_drawing_where_there_is_one() -> None:
    assert planar_impact.solve(POSITION_A)._repr_html_().startswith("<svg")
    case = reference("cases")[0]["case"]
    case["title"] = "<script>alert(1)</script>"
    shown = planar_impact.solve(case)._repr_html_()
    assert "<script" not in shown and "&lt;script&gt;" in shown
    assert planar_impact.crush(EXAMPLES / "cavalier-crush.toml")._repr_html_().startswith("<pre>")
    # The evidence leaves an unknown open or not: a drawing is where one collision is.
    assert "<pre>" in planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", starts=4)._repr_html_()


def test_the_caller_may_change_a_dict() -> None:
    answer = planar_impact.solve(POSITION_A)
    answer.to_dict()["energy"]["loss"] = 0
    answer.energy.to_dict()["loss"] = 0
    answer.vehicles[0].velocity.append(0)
    assert answer.energy.loss != 0 and len(answer.vehicles[0].velocity) == 2


def test_checks() -> None:
    with pytest.raises(CaseError, match="no such file"):
        planar_impact.check("/no/such.csv")
