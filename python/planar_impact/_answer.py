"""Answers: the facts of a verb as Python has them."""

from __future__ import annotations

import html
import json
from collections.abc import Callable, Hashable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from . import _case, _native
from ._errors import CaseError, Issue

_V = TypeVar("_V", covariant=True)


class Facts(Mapping[str, _V]):
    """Part of an answer: a mapping whose keys are attributes too. Numbers are in SI and radians.

    A key that is no identifier, or that is a method of a mapping, is read with brackets: ``answer.of["energy.loss"]``.
    """

    __slots__ = ("_facts", "_part")
    #: What makes facts of the objects under a key.
    _parts: ClassVar[dict[str, _Part]] = {}
    _facts: dict[str, Any]
    _part: _Part | None

    def __init__(self, facts: dict[str, Any], part: _Part | None = None) -> None:
        object.__setattr__(self, "_facts", facts)
        object.__setattr__(self, "_part", part)

    def __getitem__(self, key: str) -> _V:
        value: _V = _wrapped(self._facts[key], self._part or self._parts.get(key, Facts))
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    # Type checkers know the attributes of each answer.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            # Copies and notebooks ask for private names, some before there are facts.
            if name.startswith("_"):
                raise AttributeError(name)
            if name in self._facts:
                return self[name]
            hint = type(self).__annotations__.get(name)
            if hint is not None:
                return [] if hint.startswith("list") else None
            raise AttributeError(f"no {name!r} here; there are {', '.join(self._facts)}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer cannot be changed")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self._facts if key.isidentifier())]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._facts!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._facts, self._part)

    def to_dict(self) -> dict[str, Any]:
        """Return the facts as plain dicts, lists, numbers and strings, which the caller may change."""
        copy: dict[str, Any] = json.loads(json.dumps(self._facts))
        return copy


_Part = Callable[[dict[str, Any]], Facts[Any]]


class Answer(Facts[Any]):
    """The answer of a verb, in SI and radians.

    ``str(answer)`` is the page that the command line prints, in the units of the case or those given as ``units``.

    >>> import planar_impact
    >>> answer = planar_impact.solve(planar_impact.template("barrier"))
    >>> answer.vehicles[0].delta_v_magnitude == answer["vehicles"][0]["delta_v_magnitude"]
    True
    """

    __slots__ = ("_native", "_read", "_units")
    _native: _Rendered
    _read: dict[str, Any] | None
    _units: str | None

    def __init__(self, native: _Rendered, units: str | None = None) -> None:
        object.__setattr__(self, "_native", native)
        object.__setattr__(self, "_part", None)
        object.__setattr__(self, "_read", None)
        object.__setattr__(self, "_units", units)

    @property
    def _facts(self) -> dict[str, Any]:  # type: ignore[override]
        # Most of the time of a single collision is that of writing and reading its JSON: only if someone looks at it.
        read = self._read
        if read is None:
            read = self.to_dict()
            object.__setattr__(self, "_read", read)
        return read

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON of the command line as a dict."""
        facts: dict[str, Any] = json.loads(self._native.json)
        return facts

    def to_json(self) -> str:
        """Return the JSON of the command line, byte for byte."""
        return self._native.json

    def to_text(self, *, units: str | None = None) -> str:
        """Return the page that the command line prints, in a system of units: ``us``, ``si`` or ``uk``."""
        return self._native.page(_case.units(units) if units is not None else self._units)

    @property
    def figures(self) -> list[str]:
        """The names of the figures of :meth:`to_svg`."""
        return list(self._native.figures)

    def to_svg(self, figure: str | None = None, *, units: str | None = None) -> str | None:
        """Return a figure, or the first: the scene of a collision, the chart of other verbs. ``None`` if there is nothing to draw.

        >>> import planar_impact
        >>> planar_impact.solve(planar_impact.template("t-bone")).figures
        ['scene', 'impulse', 'energy']
        """
        figure = None if figure is None else _case.unicode(figure, "figure")
        return self._native.drawing(figure, _case.units(units) if units is not None else self._units)

    def __repr__(self) -> str:
        return self.to_text()

    __str__ = __repr__

    def _repr_html_(self) -> str:
        return f"{self._drawn(None) or ''}<pre>{html.escape(self.to_text())}</pre>"

    def _drawn(self, figure: str | None, units: str | None = None) -> str | None:
        try:
            return self.to_svg(figure, units=units)
        except ValueError:
            # Nothing to draw: the page says everything.
            return None

    def __copy__(self) -> Answer:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> Answer:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        pages = {units: self.to_text(units=units) for units in _UNITS}
        drawn = {units: {figure: self._drawn(figure, units) for figure in self.figures} for units in _UNITS}
        return type(self), (_Stored(self.to_json(), pages, drawn), self._units)


#: Systems of units of a page; ``None`` is that of the case.
_UNITS = (None, "us", "si", "uk")


class _Stored:
    """An answer from another process, with its pages and figures as they were."""

    def __init__(self, json: str, pages: dict[str | None, str], drawn: dict[str | None, dict[str, str | None]]) -> None:
        self.json = json
        self.figures = list(drawn[None])
        self._pages = pages
        self._drawn = drawn

    def page(self, units: str | None = None) -> str:
        return self._pages[_known("units", units, self._pages)]

    def drawing(self, figure: str | None = None, units: str | None = None) -> str | None:
        drawn = self._drawn[_known("units", units, self._drawn)]
        return next(iter(drawn.values()), None) if figure is None else drawn[_known("figure", figure, drawn)]


_K = TypeVar("_K", bound=Hashable)


def _known(argument: str, value: _K, known: Mapping[_K, Any]) -> _K:
    if value not in known:
        accepted = ", ".join(json.dumps(name) for name in known if name is not None)
        raise CaseError._with([Issue("call", argument, f"unknown value {json.dumps(value)}", None, f"accepted: {accepted}")])
    return value


_Rendered = _native.Answer | _Stored


def _wrapped(value: Any, part: _Part) -> Any:
    if isinstance(value, dict):
        return part(value)
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return [_wrapped(item, part) for item in value]
    return list(value) if isinstance(value, list) else value
