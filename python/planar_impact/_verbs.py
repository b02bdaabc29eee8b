"""The verbs, as on the command line."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, Union

from . import _native
from ._case import Case, names, number, source, truth, unicode, whole
from ._case import units as _units
from ._errors import CaseError, Issue
from ._progress import Progress, reporting
from .answers import (
    CheckReport,
    Comparison,
    CrushAnswer,
    Formula,
    Gradient,
    Records,
    Reconstruction,
    Slides,
    Solution,
    StiffnessAnswer,
    Sweep,
    Uncertainty,
)

#: A system of units for text and drawings: feet and pounds, SI with km/h, or SI with mph.
Units = Literal["us", "si", "uk"]

Method = Literal["linear", "second-order", "monte-carlo", "sobol", "shapley", "bounds"]
_Names = Union[str, Sequence[str], None]
_Path = Union[str, "os.PathLike[str]"]
#: From, to and step of an input: numbers in SI, or strings with units.
Range = tuple[Union[float, str], Union[float, str], Union[float, str]]


def _several(files: Any, one: tuple[type, ...]) -> list[Any]:
    if isinstance(files, Mapping) and Mapping not in one:
        raise TypeError("files is a file or a sequence of files, not a dict; write it to a file")
    several = [files] if isinstance(files, one) else list(files) if isinstance(files, Iterable) else None
    if several is None:
        raise TypeError(f"files is a file or a sequence of files, not {type(files).__name__}")
    if not several:
        raise CaseError._with([Issue("call", "files", "expected one file or more, found none")])
    return several


def solve(case: Case, *, units: Units | None = None) -> Solution:
    """Solve a collision: how both vehicles leave it, and the energy it takes.

    Args:
        case: A path, a text in TOML or JSON, or a dict with the keys of a case file. In a dict, a number is in SI and radians, and
            a string has its unit: ``{"mass": 1450}``, ``{"mass": "3200 lb"}``.
        units: Units of the text and the drawing: ``"us"``, ``"si"`` or ``"uk"``. Default: those of most values in the case.

    Returns:
        ``vehicles[i]`` with ``velocity`` and ``delta_v`` (x, y) in m/s, ``delta_v_magnitude`` in m/s, ``yaw_rate`` in rad/s, ``pdof``
        in rad; ``contact`` with ``impulse`` in N s; ``energy`` in J.

    Raises:
        CaseError: The case is wrong; ``issues`` has every problem with its line.
        PhysicsError: The vehicles move apart, the impulse is tensile, or energy is gained.

    >>> import planar_impact
    >>> answer = planar_impact.solve({
    ...     "schema": 1,
    ...     "vehicle": [
    ...         {"mass": 1500, "yaw_inertia": 2500, "heading": 0, "speed": 15, "impact_center": [2, 0]},
    ...         {"barrier": True},
    ...     ],
    ...     "contact": {"crush_plane": 0, "restitution": 0.1},
    ... })
    >>> round(answer.vehicles[0].delta_v_magnitude, 6)
    16.5
    >>> round(answer.energy.loss)
    167062
    """
    return Solution(_native.solve(source(case), _units(units)), units)


def gradient(
    case: Case, *, of: _Names = None, wrt: _Names = None, second: bool = False, units: Units | None = None
) -> Gradient:
    """Differentiate the outputs of a collision exactly.

    Args:
        case: As for :func:`solve`.
        of: Outputs by name or symbol, such as ``"energy.loss"`` or ``"dV1,T_L"``. Default: all.
        wrt: Inputs by name or symbol, such as ``"vehicle.1.speed"`` or ``"e"``. Default: all.
        second: Whether to add second derivatives.
        units: Units of the text.

    Returns:
        ``of[output].value`` and ``of[output].d[input]`` in SI; with ``second`` also ``of[output].d2[input][input]``.

    >>> import planar_impact
    >>> answer = planar_impact.gradient(planar_impact.template("barrier"), of="dV1", wrt="vehicle.1.speed")
    >>> answer.of["vehicle.1.delta_v_magnitude"].d["vehicle.1.speed"] > 1
    True
    """
    return Gradient(_native.gradient(source(case), _units(units), names(of, "of"), names(wrt, "wrt"), truth(second, "second")), units)


def sweep(
    case: Case,
    *,
    vary: str | Sequence[str] | Mapping[str, Range],
    of: _Names = None,
    progress: Progress = None,
    units: Units | None = None,
) -> Sweep:
    """Vary one or two inputs over ranges.

    Args:
        case: As for :func:`solve`.
        vary: Ranges as on the command line, ``"contact.crush_plane=-10 deg:10 deg:1 deg"``, or a dict of a first value, a last value
            and a step: ``{"contact.crush_plane": ("-10 deg", "10 deg", "1 deg")}``. Numbers without a unit are in SI.
        of: Outputs by name or symbol, a list or separated by commas. Default: the works, the energy loss and the critical impulse ratio.
        progress: A function that is called with the number of steps done and of all steps, a few times a second, or ``True`` for a
            bar of tqdm. What it raises stops the sweep.
        units: Units of the text.

    Returns:
        ``vary[input]`` and ``of[output]``, lists with a value for each point in SI; ``refusal``, the code of a point that is refused.

    >>> import planar_impact
    >>> answer = planar_impact.sweep(planar_impact.template("barrier"), vary={"contact.restitution": (0, 0.2, 0.1)}, of="T_L")
    >>> len(answer.of["energy.loss"])
    3
    """
    if isinstance(vary, Mapping):
        ranges = []
        for name, ends in vary.items():
            if isinstance(ends, (str, bytes)) or not isinstance(ends, Sequence) or len(ends) != 3:
                raise CaseError._with([Issue("call", f"vary {name}", "expected a first value, a last value and a step")])
            if len({_has_unit(end) for end in ends}) > 1:
                # A number alone is in SI, and the text of a range would give it the unit of the others.
                raise CaseError._with([Issue("call", f"vary {name}", "give all three values a unit, or none, which is SI")])
            ranges.append(f"{name}={':'.join(end if isinstance(end, str) else repr(number(end, f'vary {name}')) for end in ends)}")
    else:
        ranges = names(vary, "vary")
    if not ranges:
        raise CaseError._with([Issue("call", "vary", "expected one or two ranges, found none")])
    with reporting(progress) as report:
        return Sweep(_native.sweep(source(case), _units(units), ranges, names(of, "of"), report), units)


def _has_unit(value: object) -> bool:
    if not isinstance(value, str):
        return False
    try:
        float(value)
    except ValueError:
        return True
    return False


def crush(case: Case, *, units: Units | None = None) -> CrushAnswer:
    """Compute crush energy and equivalent speed from the residual crush of the vehicles.

    Returns:
        ``vehicles[i]`` with ``mean_depth`` in m, ``crush_energy`` in J, ``equivalent_energy_speed`` in m/s.

    >>> import planar_impact
    >>> planar_impact.crush(planar_impact.template("t-bone")).vehicles[0].crush_energy > 0
    True
    """
    return CrushAnswer(_native.crush(source(case), _units(units)), units)


def crash3(case: Case, *, units: Units | None = None) -> Comparison:
    """Compute ΔV by CRASH3 from the residual crush of the vehicles.

    Returns:
        ``vehicles[i]`` with ``corrected_energy`` in J, ``delta_v_magnitude`` in m/s.

    >>> import planar_impact
    >>> planar_impact.crash3(planar_impact.template("t-bone")).vehicles[0].delta_v_magnitude > 0
    True
    """
    return Comparison(_native.crash3(source(case), _units(units)), units)


def reconstruct(
    case: Case,
    *,
    starts: int = 64,
    seed: int = 1,
    level: float = 0.95,
    profile: bool = False,
    guaranteed: bool = False,
    bounds_sd: float = 3.0,
    posterior: bool = False,
    probability: _Names = (),
    draws: bool = False,
    progress: Progress = None,
    units: Units | None = None,
) -> Reconstruction:
    """Find the unknowns of a case from its evidence, with intervals.

    Args:
        case: As for :func:`solve`, with ``[evidence]`` and ``[unknown]``.
        starts: Number of starts of the search, from 1 to 10000.
        seed: Seed of the starts and of the posterior.
        level: Level of confidence of the intervals, from 0.5 to 0.9999.
        profile: Whether to follow the profile of the likelihood of each quantity.
        guaranteed: Whether to find the guaranteed range of each unknown, outside of which nothing meets the evidence.
        bounds_sd: Standard deviations at which ``guaranteed`` ends evidence and inputs without limits.
        posterior: Whether to draw from the posterior distribution.
        probability: Statements whose probability is wanted, such as ``"vehicle.1.speed > 50 km/h"``; with any, the posterior is drawn.
        draws: Whether to return each draw.
        progress: A function that is called with the number of steps done and of all steps, a few times a second, or ``True`` for a
            bar of tqdm. What it raises stops the search.
        units: Units of the text and the drawing.

    Returns:
        ``unknown[name]`` with ``value``, ``sd`` and ``interval`` in SI, ``derived``, ``evidence``, ``verdict``, ``solution``.

    >>> import planar_impact
    >>> answer = planar_impact.reconstruct(planar_impact.template("t-bone"), starts=8)
    >>> [interval.low < interval.high for interval in (unknown.interval for unknown in answer.unknown.values())][0]
    True
    """
    statements = names(probability, "probability")
    starts, seed = whole(starts, "starts"), whole(seed, "seed")
    question = (starts, seed, number(level, "level"), truth(profile, "profile"), truth(guaranteed, "guaranteed"), number(bounds_sd, "bounds_sd"), truth(posterior, "posterior"), statements, truth(draws, "draws"))
    with reporting(progress) as report:
        return Reconstruction(_native.reconstruct(source(case), _units(units), *question, report), units)


def uncertainty(
    case: Case,
    *,
    of: _Names = None,
    method: Method | Sequence[Method] | None = None,
    samples: int = 100_000,
    seed: int = 1,
    points: Literal["random", "sobol"] = "random",
    precision: float | None = None,
    probability: _Names = (),
    level: float = 0.95,
    bounds_sd: float = 3.0,
    progress: Progress = None,
    units: Units | None = None,
) -> Uncertainty:
    """Compute how uncertain outputs are, from inputs that are uncertain.

    Args:
        case: As for :func:`solve`, with uncertain inputs: ``"40 mph ± 2 mph"``, ``{"min": 0.1, "max": 0.3}``.
        of: Outputs by name or symbol, a list or separated by commas. Default: the principal ones.
        method: ``"linear"``, ``"second-order"``, ``"monte-carlo"``, ``"sobol"``, ``"shapley"``, ``"bounds"``. Default: all that apply.
        samples: Number of samples; with a precision, the greatest.
        seed: Seed of the samples. The same seed gives the same answer.
        points: Where samples lie: ``"random"`` or ``"sobol"``.
        precision: Standard error of every mean that is small enough, as a share, such as 0.001.
        probability: Statements whose probability is wanted, such as ``"dV1 > 25 mph"``.
        level: Level of the middle range, from 0.5 to 0.9999.
        bounds_sd: Standard deviations at which ``"bounds"`` ends inputs without limits.
        progress: A function that is called with the number of steps done and of all steps, a few times a second, or ``True`` for a
            bar of tqdm. What it raises stops the computation.
        units: Units of the text.

    Returns:
        ``of[output]`` with a key for each method, in SI; ``probabilities``.

    >>> import planar_impact
    >>> answer = planar_impact.uncertainty(planar_impact.template("t-bone"), of="dV1", method="monte-carlo", samples=1000)
    >>> answer.of["vehicle.1.delta_v_magnitude"].monte_carlo.sd > 0
    True
    """
    options: dict[str, object] = {
        "of": names(of, "of"),
        "method": names(method, "method"),
        "samples": whole(samples, "samples"),
        "seed": whole(seed, "seed"),
        "points": unicode(points, "points"),
        "precision": None if precision is None else number(precision, "precision"),
        "probability": names(probability, "probability"),
        "level": number(level, "level"),
        "bounds_sd": number(bounds_sd, "bounds_sd"),
    }
    with reporting(progress) as report:
        return Uncertainty(_native.uncertainty(source(case), _units(units), options, report), units)


def stiffness(tests: Case, *, units: Units | None = None) -> StiffnessAnswer:
    """Fit the stiffness of vehicles to barrier tests.

    Args:
        tests: A file of barrier tests: a path, a text or a dict.
        units: Units of the text.

    Returns:
        ``fits``, each with d₀ in √N, d₁ in √N/m, A = d₀ d₁ in N/m and B = d₁² in N/m²; ``tests``; ``headlines``, what to know about them.

    >>> import planar_impact
    >>> test = {"mass": 1487, "width": 1.5, "restitution": 0.1}
    >>> answer = planar_impact.stiffness({
    ...     "schema": 1,
    ...     "vehicle": [{
    ...         "name": "Cavalier",
    ...         "test": [
    ...             {**test, "speed": "18 km/h", "depths": ["3 cm", "3 cm"]},
    ...             {**test, "speed": "40 km/h", "depths": ["33 cm", "33 cm"]},
    ...         ],
    ...     }],
    ... })
    >>> fit = answer.fits[0]
    >>> round(fit.d0), round(fit.d1)
    (134, 750)
    """
    return StiffnessAnswer(_native.stiffness(source(tests), _units(units)), units)


def slide(case: Case, *, units: Units | None = None) -> Slides:
    """Follow the vehicles from separation to rest.

    Args:
        case: As for :func:`solve`, with ``[rest]``.
        units: Units of the text.

    Returns:
        ``vehicles[i]`` with ``rest.position`` in m, ``time`` in s, ``distance`` in m, ``path``.

    >>> import planar_impact
    >>> planar_impact.slide(planar_impact.template("rest")).vehicles[0].time > 0
    True
    """
    return Slides(_native.slide(source(case), _units(units)), units)


def record(files: Case | Sequence[Case], *, units: Units | None = None) -> Records:
    """Compute impulses, velocity changes and restitution from recordings of force, acceleration or distance.

    Args:
        files: A recording, or several: paths of CSV, TOML or JSON files, texts or dicts.
        units: Units of the text.

    Returns:
        ``records[i]`` with ``recorder`` (ΔV in m/s), ``barrier`` (impulses in N s), ``accelerations``, ``films`` and ``traces``.

    >>> import planar_impact
    >>> answer = planar_impact.record("time [ms],delta_v_forward [km/h]\\n0,0\\n50,-20\\n100,-31\\n150,-33\\n")
    >>> round(answer.records[0].recorder.delta_v_forward.value * 3.6)    # km/h
    -33
    """
    several = _several(files, (str, Mapping, os.PathLike))
    return Records(_native.record([source(file) for file in several], _units(units)), units)


def formula(output: str, *, wrt: str | None = None, case: Case | None = None) -> Formula:
    """Return the formula that the code computes for an output, or for its derivative.

    Args:
        output: An output by name or symbol, such as ``"T_L"``.
        wrt: An input by name or symbol, to differentiate with respect to.
        case: A case, whose kind of collision the formula is for. Default: two vehicles at the critical impulse ratio.

    Returns:
        ``definitions`` and ``inputs``, ``latex`` and ``rust``.

    >>> import planar_impact
    >>> planar_impact.formula("mu0").output
    'contact.critical_impulse_ratio'
    """
    output, wrt = unicode(output, "output"), None if wrt is None else unicode(wrt, "wrt")
    return Formula(_native.formula(output, wrt, None if case is None else source(case)))


def check(files: _Path | Sequence[_Path], *, tolerance: float | None = None) -> CheckReport:
    """Check the collision results of any program for violated laws of mechanics.

    Args:
        files: Paths of files of records: JSON, JSON lines or CSV.
        tolerance: Tolerance of records without resolutions, as a share of what is exchanged.

    Returns:
        ``records``, each with its ``verdict`` and ``findings``; ``summary``.

    >>> import json, os, planar_impact, tempfile
    >>> collision = {
    ...     "bodies": [
    ...         {"mass": 1000, "yaw_inertia": 1500, "cg": [-2, 0],
    ...          "before": {"v": [10, 0], "yaw_rate": 0}, "after": {"v": [6, 0], "yaw_rate": 0}},
    ...         {"mass": 1000, "yaw_inertia": 1500, "cg": [2, 0],
    ...          "before": {"v": [0, 0], "yaw_rate": 0}, "after": {"v": [5, 0], "yaw_rate": 0}},
    ...     ],
    ...     "contact": {"point": [0, 0], "normal_angle": 0},
    ... }
    >>> file = {"schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"},
    ...         "records": [{"id": "rear-end", "profile": "impulse", **collision}]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "records.json")
    ...     with open(path, "w") as opened:
    ...         _ = opened.write(json.dumps(file))
    ...     answer = planar_impact.check(path)
    >>> answer.records[0].verdict, answer.records[0].findings[0].rule
    ('fail', 'linear-momentum')
    """
    paths = [os.fspath(path) for path in _several(files, (str, os.PathLike))]
    return CheckReport(_native.check(paths, None if tolerance is None else number(tolerance, "tolerance")))


def draw(case: Case, *, units: Units | None = None) -> str:
    """Draw the scene of a collision as SVG.

    >>> import planar_impact
    >>> planar_impact.draw(planar_impact.template("barrier")).startswith("<svg")
    True
    """
    return _native.draw(source(case), _units(units))


def report(
    case: Case,
    *,
    verb: Literal["solve", "reconstruct", "crush", "crash3", "uncertainty"] | None = None,
    posterior: bool = False,
    date: str | None = None,
    units: Units | None = None,
    sections: _Names = None,
) -> str:
    """Write the report of a case as one HTML document. The same case gives the same bytes.

    Args:
        case: As for :func:`solve`.
        verb: What the report is about. Default: ``"reconstruct"`` for a case with unknowns, otherwise ``"solve"``.
        posterior: Whether to draw the posterior of a reconstruction too. Its last bits depend on the platform.
        date: A date in any words, printed as it is.
        units: Units of the report.
        sections: Parts of the report, such as ``["summary", "results"]``. Default: all that apply.

    >>> import planar_impact
    >>> planar_impact.report(planar_impact.template("barrier"), sections="results").startswith("<!DOCTYPE html>")
    True
    """
    date = None if date is None else unicode(date, "date")
    return _native.report(source(case), _units(units), None if verb is None else unicode(verb, "verb"), truth(posterior, "posterior"), date, names(sections, "sections"))


def template(kind: str = "t-bone") -> str:
    """Return a case file to begin with: ``t-bone``, ``head-on``, ``rear-end``, ``barrier``, ``momentum`` or ``rest``.

    >>> import planar_impact
    >>> "barrier = true" in planar_impact.template("barrier")
    True
    """
    return _native.template(unicode(kind, "kind"))
