"""Errors: every problem at once, with its line; hostile input raises exceptions and nothing else."""

from __future__ import annotations

import contextlib
import pickle
import signal
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, reference

import planar_impact
from planar_impact import CaseError, Error, PhysicsError

TEXT = (EXAMPLES / "position-a.toml").read_text(encoding="utf-8")


def test_issues_have_lines() -> None:
    lines = TEXT.splitlines()
    mass = next(i for i, line in enumerate(lines) if line.startswith("mass"))
    lines[mass] = 'mass = "3 ft"'
    lines.append("unknown_key = 1")
    with pytest.raises(CaseError) as caught:
        planar_impact.solve("\n".join(lines))
    issues = caught.value.issues
    assert [(issue.code, issue.path, issue.line) for issue in issues][0] == ("quantity", "vehicle.1.mass", mass + 1)
    assert issues[-1].line == len(lines) and len(issues) == 2
    assert f"<text>:{mass + 1}: vehicle.1.mass: " in str(caught.value)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, Error)
    other = pickle.loads(pickle.dumps(caught.value))
    assert (type(other), other.issues, str(other)) == (CaseError, issues, str(caught.value))


def test_a_dict_has_no_lines() -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve({"schema": 1, "vehicle": [{"mass": "3 ft"}], "contact": {}})
    assert caught.value.issues and all(issue.line is None for issue in caught.value.issues)


def test_physics_refuses() -> None:
    codes: set[str] = set()
    for entry in reference("cases"):
        if entry["status"] == 3:
            with pytest.raises(PhysicsError) as caught:
                planar_impact.solve(entry["case"])
            codes.update(issue.code for issue in caught.value.issues)
    assert {"separating", "tensile"} <= codes


def test_files() -> None:
    with pytest.raises(CaseError, match="no such file"):
        planar_impact.solve("no_such_case.toml")
    with pytest.raises(CaseError, match="is a directory"):
        planar_impact.solve(EXAMPLES)
    with pytest.raises(CaseError, match="is empty"):
        planar_impact.solve("\n")


def test_a_text_opens_no_file(tmp_path: Path) -> None:
    secret = tmp_path / "secret.toml"
    secret.write_text("key = 'hidden'\n", encoding="utf-8")
    text = TEXT.replace("[contact]", f"[contact]\nrestitution_curve = '{secret}'\n", 1)
    with pytest.raises(CaseError) as caught:
        planar_impact.solve(text)
    assert "hidden" not in str(caught.value)


DEEP: Any = {}
for _ in range(5000):
    DEEP = {"a": DEEP}
CYCLE: dict[str, Any] = {}
CYCLE["a"] = CYCLE


TREE: dict[str, Any] = {}
TREE["a"] = [TREE, TREE]


@pytest.mark.parametrize(
    "case",
    [
        {},
        {"a": [{"b": {1, 2}}, object(), b"1", memoryview(b"1"), {2: 3}]},
        TREE,
        {"schema": float("nan")},
        {"schema": 1, "vehicle": [{"mass": float("inf")}]},
        {"schema": 10**400},
        {1: 2},
        {"schema": object()},
        {"schema": b"1"},
        {"schema": "\ud800"},
        {"\ud800": 1},
        {"a" * 10_000: "b" * 10_000},
        {"schema": 1, "vehicle": [{} for _ in range(10_000)]},
        {f"key{i}": i for i in range(100_000)},
        {"title": "x" * (5 << 20)},
        {"schema": np.array([[1.0, np.nan]])},
        DEEP,
        CYCLE,
        "",
        "\0",
        "\0\n",
        "=",
        "\ud800\n",
        "{",
        "{" * 100_000,
        "[" * 100_000 + "\n",
        "a = [" * 50_000 + "\n",
        '{"a": ' * 100_000,
        "x" * 100_000,
        "schema = 1\n" * 1000,
    ],
    ids=lambda case: f"{type(case).__name__} {str(case)[:20]!r}" if case is not DEEP and case is not CYCLE and case is not TREE else "deep",
)
def test_hostile_cases_are_case_errors(case: Any) -> None:
    for verb in (planar_impact.solve, planar_impact.gradient, planar_impact.reconstruct, planar_impact.draw, planar_impact.stiffness):
        with pytest.raises(CaseError) as caught:
            verb(case)
        assert 0 < len(caught.value.issues) <= 1000


@pytest.mark.parametrize("case", [None, 1, 1.5, [], (), b"schema = 1", object(), np.zeros(3), {1, 2}])
def test_what_is_no_case_is_a_type_error(case: Any) -> None:
    with pytest.raises(TypeError, match="a case is a path, a text or a dict"):
        planar_impact.solve(case)


@pytest.mark.parametrize(
    "call",
    [
        lambda: planar_impact.solve(TEXT, units="cgs"),  # type: ignore[arg-type]
        lambda: planar_impact.gradient(TEXT, of="T_1"),
        lambda: planar_impact.gradient(TEXT, wrt="energy.loss"),
        lambda: planar_impact.gradient(TEXT, of=""),
        lambda: planar_impact.sweep(TEXT, vary="e"),
        lambda: planar_impact.sweep(TEXT, vary=[]),
        lambda: planar_impact.sweep(TEXT, vary={"e": (0, 1)}),  # type: ignore[dict-item]
        lambda: planar_impact.sweep(TEXT, vary={"v1": (10, "40 mph", "1 mph")}),
        lambda: planar_impact.sweep(TEXT, vary={"e": (0, 1, float("nan"))}),
        lambda: planar_impact.sweep(TEXT, vary={"e": (0, 1, 1e-12)}),
        lambda: planar_impact.reconstruct(TEXT),
        lambda: planar_impact.reconstruct(TEXT, starts=0),
        lambda: planar_impact.reconstruct(TEXT, starts=10**30),
        lambda: planar_impact.reconstruct(TEXT, seed=-1),
        lambda: planar_impact.reconstruct(TEXT, level=float("nan")),
        lambda: planar_impact.uncertainty(TEXT, method="magic"),  # type: ignore[arg-type]
        lambda: planar_impact.uncertainty(TEXT),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=1),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", level=2),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", bounds_sd=float("nan")),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", precision=float("nan"), samples=100),
        lambda: planar_impact.formula("no"),
        lambda: planar_impact.formula("T_L", wrt="T_L"),
        lambda: planar_impact.report(TEXT, verb="slide"),  # type: ignore[arg-type]
        lambda: planar_impact.report(TEXT, sections="none"),
        lambda: planar_impact.template("none"),
        lambda: planar_impact.slide(TEXT),
        lambda: planar_impact.crush(TEXT),
        lambda: planar_impact.record("a,b\n1,2\n"),
        lambda: planar_impact.check(EXAMPLES),
        lambda: planar_impact.check([]),
        lambda: planar_impact.record([]),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", method="linear", level=0.9),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", method=["linear", "bounds"], samples=7),
        lambda: planar_impact.uncertainty(EXAMPLES / "uncertain.toml", method="sobol", points="sobol"),
        lambda: planar_impact.reconstruct(EXAMPLES / "reconstruct/two-cars.toml", bounds_sd=2),
        lambda: planar_impact.report(TEXT, posterior=True),
        lambda: planar_impact.report(EXAMPLES / "cavalier-crush.toml", verb="crush", sections="sensitivity"),
        lambda: planar_impact.report(TEXT, date="\ud800"),
        lambda: planar_impact.formula("\ud800"),
        lambda: planar_impact.gradient(TEXT, of="\ud800"),
        lambda: planar_impact.solve_batch({"\ud800": [1.0]}, case=TEXT),
    ],
)
def test_wrong_calls_are_case_errors(call: Any) -> None:
    with pytest.raises(CaseError) as caught:
        call()
    assert caught.value.issues and not str(caught.value).startswith("--")


@pytest.mark.parametrize(
    "call",
    [
        lambda: planar_impact.gradient(TEXT, of=1),  # type: ignore[arg-type]
        lambda: planar_impact.gradient(TEXT, of=[1]),  # type: ignore[list-item]
        lambda: planar_impact.reconstruct(TEXT, seed=1.5),  # type: ignore[arg-type]
        lambda: planar_impact.solve(TEXT, "si"),  # type: ignore[call-arg]
        lambda: planar_impact.solve(TEXT, units=1),  # type: ignore[arg-type]
        lambda: planar_impact.formula(None),  # type: ignore[arg-type]
    ],
)
def test_wrong_types_are_type_errors(call: Any) -> None:
    with pytest.raises(TypeError):
        call()


def test_options_have_their_names_in_python() -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve_batch({"vehicle.1.speed": np.array([12.0])})
    assert "give a case with `case`" in str(caught.value) and "--" not in str(caught.value)
    with pytest.raises(CaseError) as caught:
        planar_impact.uncertainty(EXAMPLES / "uncertain.toml", bounds_sd=-1)
    assert caught.value.issues[0].path == "bounds_sd"
    with pytest.raises(CaseError) as caught:
        planar_impact.uncertainty(EXAMPLES / "uncertain.toml", method="second-order", seed=3)
    [issue] = caught.value.issues
    assert issue.path == "seed" and issue.help == "add monte-carlo, sobol or shapley to `method`, or leave `seed` out"
    assert planar_impact.uncertainty(EXAMPLES / "uncertain.toml", method="linear", samples=100_000, seed=1, level=0.95).of
    # What the caller has written stays.
    with pytest.raises(CaseError, match="a--b"):
        planar_impact.gradient(TEXT, of="a--b")


def test_progress_of_a_search() -> None:
    steps: list[tuple[int, int]] = []
    case = EXAMPLES / "reconstruct/two-cars.toml"
    answer = planar_impact.reconstruct(case, starts=64, progress=lambda done, total: steps.append((done, total)))
    assert steps and steps[-1][0] == steps[-1][1] > 0 and all(0 <= done <= total for done, total in steps)
    assert answer == planar_impact.reconstruct(case, starts=64)

    def fail_in_the_intervals(done: int, total: int) -> None:
        if total != 64:
            raise LookupError(f"of {total}")

    with pytest.raises(LookupError, match="of "):
        planar_impact.reconstruct(case, starts=64, progress=fail_in_the_intervals)

    def fail(done: int, total: int) -> None:
        raise LookupError("stop")

    with pytest.raises(LookupError, match="stop"):
        planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=10**12, method="monte-carlo", progress=fail)
    calls = []

    def fail_once(done: int, total: int) -> None:
        calls.append(done)
        if len(calls) == 1:
            raise LookupError("once")

    with pytest.raises(LookupError, match="once"):
        planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=2**40, precision=1e-9, progress=fail_once)
    assert len(calls) == 1


def test_a_bar_of_tqdm(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=200_000, method="monte-carlo", of="dV1", progress=True)
    assert "step" in capsys.readouterr().err


def interrupted(call: Any) -> float:
    """Return how long a call goes on after Ctrl+C."""
    sent: list[float] = []

    def send() -> None:
        sent.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(0.3, send)
    # A shell starts what runs in the background with interrupts ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
        return time.monotonic() - sent[0]
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


def test_an_interrupt_stops_a_long_call() -> None:
    uncertain = EXAMPLES / "uncertain.toml"
    assert interrupted(lambda: planar_impact.uncertainty(uncertain, samples=10**12, method="monte-carlo")) < 5
    # What comes after the stage that was stopped stops too.
    assert interrupted(lambda: planar_impact.uncertainty(uncertain, samples=2**40, precision=1e-9)) < 5
    assert interrupted(lambda: planar_impact.uncertainty(uncertain, method="bounds", of="all")) < 5
    speeds = np.linspace(10, 20, 3_000_000)
    with_case: dict[str, Any] = {"case": planar_impact.template("barrier"), "of": "T_L", "wrt": ["e", "Gamma"], "threads": 1}
    assert interrupted(lambda: planar_impact.solve_batch({"vehicle.1.speed": speeds}, **with_case)) < 5


def test_other_threads_run_during_a_call() -> None:
    ticks = []
    done = threading.Event()

    def tick() -> None:
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    started = time.monotonic()
    planar_impact.uncertainty(EXAMPLES / "uncertain.toml", samples=1_000_000, method="monte-carlo", of="dV1")
    took = time.monotonic() - started
    done.set()
    thread.join()
    assert len(ticks) > min(20, 50 * took)


def test_what_is_wrong_with_dicts_and_names() -> None:
    for call in (lambda: planar_impact.record({}), lambda: planar_impact.stiffness({})):
        with pytest.raises(CaseError) as caught:
            call()
        assert all(issue.line is None for issue in caught.value.issues) and "<dict>" not in str(caught.value)
    with pytest.raises(CaseError) as caught:
        planar_impact.formula("nope")
    message = str(caught.value)
    assert "`nope`" in message and message.count("`") % 2 == 0 and "``" not in message and "`list`" not in message


def test_an_interrupt_stops_the_reading_of_a_whole_stream() -> None:
    pa = pytest.importorskip("pyarrow")
    batch = pa.record_batch({"vehicle.1.speed": np.linspace(1, 30, 20_000)})
    stream = pa.RecordBatchReader.from_batches(batch.schema, (batch for _ in range(10_000)))
    answer = planar_impact.solve_batch(stream, case=planar_impact.template("barrier"))

    def read() -> None:
        # The reader has an error of its own, and Python raises the interrupt after it.
        with contextlib.suppress(ValueError, OSError):
            answer.read_all()
        time.sleep(5)

    assert interrupted(read) < 4


def test_an_interrupt_within_a_source_is_one_of_the_reader() -> None:
    pa = pytest.importorskip("pyarrow")
    batch = pa.record_batch({"vehicle.1.speed": np.linspace(1, 30, 2000)})

    def batches() -> Any:
        yield batch
        raise KeyboardInterrupt

    stream = pa.RecordBatchReader.from_batches(batch.schema, batches())
    answer = planar_impact.solve_batch(stream, case=planar_impact.template("barrier"))
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            with contextlib.suppress(ValueError, OSError):
                answer.read_all()
            time.sleep(1)
    finally:
        signal.signal(signal.SIGINT, before)


#: The package without its types, for arguments that they forbid.
UNTYPED: Any = planar_impact


@pytest.mark.parametrize(
    ("call", "argument"),
    [
        (lambda case: UNTYPED.sweep(case, vary={"e": (0, None, 1)}), "vary e"),
        (lambda case: UNTYPED.uncertainty(case, precision="a"), "precision"),
        (lambda case: UNTYPED.uncertainty(case, level="high"), "level"),
        (lambda case: UNTYPED.uncertainty(case, points=1), "points"),
        (lambda case: UNTYPED.uncertainty(case, samples="5"), "samples"),
        (lambda case: UNTYPED.reconstruct(case, bounds_sd=None), "bounds_sd"),
        (lambda case: UNTYPED.solve(case, units=1), "units"),
        (lambda case: UNTYPED.solve(case).to_text(units=[]), "units"),
        (lambda case: pickle.loads(pickle.dumps(UNTYPED.solve(case))).to_text(units=b"si"), "units"),
        (lambda case: UNTYPED.solve(case).to_svg(5), "figure"),
        (lambda case: UNTYPED.report(case, verb=5), "verb"),
        (lambda case: UNTYPED.template(5), "kind"),
        (lambda case: UNTYPED.check(5), "files"),
        (lambda case: UNTYPED.check("x", tolerance="a"), "tolerance"),
        (lambda case: UNTYPED.record(5), "files"),
        (lambda case: UNTYPED.solve_batch({"vehicle.1.speed": [1.0]}, case=case, threads="2"), "threads"),
        (lambda case: UNTYPED.solve_batch({"vehicle.1.speed": [1.0]}, case=case, threads=True), "threads"),
        (lambda case: UNTYPED.solve_batch({"vehicle.1.speed": [1.0]}, case=case, fast="no"), "fast"),
        (lambda case: UNTYPED.gradient(case, second=1), "second"),
        (lambda case: UNTYPED.sweep(case, vary={"e": (True, 0.2, 0.1)}), "vary e"),
        (lambda case: UNTYPED.check({"schema": "planar-impact-record/1"}), "files"),
    ],
)
def test_an_argument_of_another_type_is_named(call: Any, argument: str) -> None:
    with pytest.raises(TypeError, match=f"^{argument} is a .*, not "):
        call(planar_impact.template("t-bone"))


def test_a_number_beyond_the_floats_is_refused_like_any_other() -> None:
    case = planar_impact.template("barrier")
    with pytest.raises(CaseError, match="contact.restitution|vary"):
        UNTYPED.sweep(case, vary={"e": (0, 10**400, 1)})
    with pytest.raises(CaseError, match="bounds-sd|bounds_sd"):
        UNTYPED.reconstruct(planar_impact.template("t-bone"), bounds_sd=10**400, guaranteed=True)


def test_an_array_of_derivatives_has_each_input_once() -> None:
    columns, case = {"vehicle.1.speed": [10.0]}, planar_impact.template("barrier")
    asked = {"case": case, "of": "T_L", "derivatives": "array"}
    with pytest.raises(CaseError, match="wrt: 3 names of 2"):
        UNTYPED.solve_batch(columns, **asked, wrt=["e", "contact.restitution", "v1"])
    with pytest.raises(CaseError, match="of: 2 names of 1"):
        UNTYPED.solve_batch(columns, **{**asked, "of": ["T_L", "energy.loss"]}, wrt="e")
    assert UNTYPED.solve_batch(columns, **asked, wrt=["e", "v1"])["derivatives"].shape == (1, 1, 2)
