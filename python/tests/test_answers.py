"""Answers have the types that type checkers see, and figures."""

from __future__ import annotations

import importlib.util
import pickle
import typing
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from conftest import EXAMPLES, ROOT
from test_cases import VERBS

import planar_impact
from planar_impact import Answer, CaseError, Facts, answers

PACKAGE = Path(__file__).resolve().parents[1]


def tool(name: str) -> ModuleType:
    """Return a program of `tools/`."""
    spec = importlib.util.spec_from_file_location(name, PACKAGE / "tools" / f"{name}.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_classes_are_those_of_the_schemas() -> None:
    written = (PACKAGE / "planar_impact" / "answers.py").read_text(encoding="utf-8")
    assert written == tool("answers").module(), "python/tools/answers.py > python/planar_impact/answers.py"


def conforms(value: Any, hint: Any, path: str) -> int:
    """Compare a value with its annotation, all the way down, and return the number of values."""
    origin = typing.get_origin(hint)
    if str(origin) in ("typing.Union", "<class 'types.UnionType'>"):
        for choice in typing.get_args(hint):
            try:
                return conforms(value, choice, path)
            except AssertionError:
                continue
        raise AssertionError(f"{path}: {value!r} is no {hint}")
    if origin is typing.Literal:
        assert value in typing.get_args(hint), path
        return 1
    if origin is list:
        assert isinstance(value, list), path
        return 1 + sum(conforms(item, typing.get_args(hint)[0], f"{path}.{i}") for i, item in enumerate(value))
    if origin is Facts:
        assert type(value) is Facts, path
        return 1 + sum(conforms(item, typing.get_args(hint)[0], f"{path}.{key}") for key, item in value.items())
    if isinstance(hint, type) and issubclass(hint, Facts):
        assert type(value) is hint, f"{path}: {type(value)} is no {hint}"
        hints = {key: of for key, of in typing.get_type_hints(hint).items() if not key.startswith("_")}
        return 1 + sum(conforms(getattr(value, key), of, f"{path}.{key}") for key, of in hints.items())
    assert isinstance(value, (int, float) if hint is float else hint), f"{path}: {value!r} is no {hint}"
    return 1


@pytest.mark.parametrize(("arguments", "verb"), VERBS, ids=[" ".join(Path(word).name for word in words) for words, _ in VERBS])
def test_an_answer_has_its_types(arguments: list[str], verb: Any) -> None:
    answer = verb()
    assert isinstance(answer, Answer) and type(answer) is not Answer
    assert conforms(answer, type(answer), arguments[0]) > 5
    again = pickle.loads(pickle.dumps(answer))
    assert type(again) is type(answer) and again == answer and conforms(again, type(answer), arguments[0]) > 5


def test_a_key_that_may_be_missing_is_nothing() -> None:
    answer = planar_impact.solve(planar_impact.template("barrier"))
    assert "notes" not in answer and answer.notes == [] and answer.crush_plane_bracket is None
    with pytest.raises(KeyError):
        _ = answer["notes"]
    with pytest.raises(AttributeError):
        _ = answer.note  # type: ignore[attr-defined]


def test_checks_have_their_types() -> None:
    records = sorted(path for path in (EXAMPLES / "check").iterdir() if path.suffix in (".json", ".jsonl", ".csv"))
    answer = planar_impact.check(records[0])
    assert type(answer) is answers.CheckReport and conforms(answer, answers.CheckReport, "check") > 5
    assert answer.records[0].verdict


FIGURES: list[tuple[Any, list[str]]] = [
    (lambda: planar_impact.solve(ROOT / "app/templates/t-bone.toml"), ["scene", "impulse", "energy"]),
    (lambda: planar_impact.gradient(EXAMPLES / "uncertain.toml", of="dV1"), ["effects"]),
    (lambda: planar_impact.sweep(EXAMPLES / "position-a.toml", vary="e=0:0.2:0.1"), ["sweep"]),
    (lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", of="dV1", samples=1000), ["uncertainty", "effects"]),
    (
        lambda: planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", starts=8, profile=True, posterior=True),
        ["scene", "intervals", "residuals", "profile", "posterior"],
    ),
    (lambda: planar_impact.stiffness(EXAMPLES / "tests/malibu.toml"), ["stiffness"]),
    (lambda: planar_impact.record(EXAMPLES / "record/barrier.toml"), ["record"]),
]


@pytest.mark.parametrize(("verb", "names"), FIGURES, ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_figures(verb: Any, names: list[str]) -> None:
    answer = verb()
    assert answer.figures == names
    drawn = [answer.to_svg(name) for name in names]
    assert all(figure.startswith("<svg") and figure.rstrip().endswith("</svg>") for figure in drawn)
    assert len(set(drawn)) == len(names) and answer.to_svg() == drawn[0]
    assert answer.to_svg(names[0], units="us") != answer.to_svg(names[0], units="si")
    assert answer._repr_html_().startswith(drawn[0])
    with pytest.raises(CaseError, match=f'"{names[-1]}"'):
        answer.to_svg("other")
    again = pickle.loads(pickle.dumps(answer))
    assert again.figures == names and again.to_svg(names[-1]) == drawn[-1] and again.to_svg() == drawn[0]
    assert again.to_svg(names[0], units="us") == answer.to_svg(names[0], units="us")
    for wrong in ({"figure": "other"}, {"units": "furlongs"}):
        messages = []
        for one in (answer, again):
            with pytest.raises(CaseError) as caught:
                one.to_svg(**wrong)
            messages.append(caught.value.issues[0])
        assert messages[0].path == messages[1].path and messages[0].message == messages[1].message


def test_a_figure_that_an_answer_does_not_have() -> None:
    assert planar_impact.crush(EXAMPLES / "cavalier-crush.toml").figures == []
    answer = planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", starts=4)
    assert answer.to_svg("posterior") is None and answer.to_svg("profile") is None
    answer = planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", starts=4, profile=True)
    speed = answer.to_dict()["unknown"]["vehicle.1.speed"]
    assert [level["chi_square"] for level in speed["profile"]] == [0.25, 1, 2.25, 4, 6.25, 9]
    assert speed["profile"][2]["low"] > speed["interval"]["low"] > speed["profile"][3]["low"]
